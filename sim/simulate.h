// The run of one job: from the dresspack at rest in its clamps, step by step through the motion, to samples.
//
// (R6) From rest in its mounting (mounting.h), time goes on in steps h, clamps and links follow the motion,
// and every 1/(rate h)-th state is a sample: t = k/rate, k = 0, 1, ... until the motion has ended. Memory
// does not grow with the motion's length.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "pipeline/job.h"
#include "sim/clamp_path.h"
#include "sim/world.h"

namespace dresslife::sim {

/// What holds for all samples of a run.
struct RunDescription {
  int samples = 0;
  std::vector<double> segment_length;   ///< (segment) unstretched [m]
  std::vector<std::string> link_names;  ///< of the robot; empty without one
  int joints = 0;                       ///< of the robot
  std::vector<std::string> step_texts;  ///< (line) of the program
};

/// One sample; the references hold until the callback returns.
struct Sample {
  double time = 0;                     ///< [s]
  int step = 0;                        ///< program line
  const RodState& state;               ///< of the chain
  const Pose& pose;                    ///< what the motion prescribes
  Energy energy;                       ///< [J]
  const std::vector<double>& tension;  ///< (segment) mean pull of the links at its ends [N]
  int contacts = 0;                    ///< most at a time since the sample before
  double max_depth = 0;                ///< deepest since the sample before [m]
};

class Simulation {
 public:
  /// Finds the start. Throws InputError: what the motion's constructors throw; a motion that pulls the clamps
  /// further apart than the free length (when, in which program line, how many millimetres are missing); no
  /// equilibrium at the start.
  explicit Simulation(const pipeline::Job& job);
  ~Simulation();

  const RunDescription& description() const { return description_; }
  const RodState& start() const { return start_; }
  const ClampPath& path() const { return *path_; }
  const Rod& rod() const { return rod_; }

  /// Runs the whole motion and hands every sample to `take`; `progress`, if any, gets the share done, 0..1.
  /// Throws InputError when the dresspack is drawn taut or the state is no longer finite.
  void run(const std::function<void(const Sample&)>& take,
           const std::function<void(double)>& progress = {}) const;

 private:
  void check_reach() const;
  std::string moment(double time) const;
  void check_step(const StepReport& report, const RodState& state, double time) const;

  const pipeline::Job job_;
  Rod rod_;
  std::unique_ptr<ClampPath> path_;
  RobotPath* robot_ = nullptr;  // path_, if it is one
  RunDescription description_;
  RodState start_;
};

}  // namespace dresslife::sim
