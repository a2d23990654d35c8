// The run of one job: from the dresspack at rest in its clamps, step by step through the motion, to samples.
//
// (R6) From rest in its mounting (mounting.h), time advances in steps h, clamps and links follow the motion,
// and every 1/(rate h)-th state is a sample: t = k/rate, k = 0, 1, ... until the end of the motion. A motion
// that ends at its begin is repeated until two successive repeats begin in the same state (R8, periodic.h). The last repeat is
// evaluated; the first is only a lead-in. Memory does not grow with the motion's length.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/job/setup.h"
#include "sim/contact/rubbing.h"
#include "sim/contact/touch.h"
#include "sim/contact/world.h"
#include "sim/robot/loops.h"
#include "sim/run/checks.h"
#include "sim/run/clamp_path.h"
#include "sim/run/step_choice.h"

namespace dresslife::sim {

class Simulation;

/// Data that are valid for all samples of a run.
struct RunDescription {
  int samples = 0;
  std::vector<std::string> dresspacks;  ///< names; the name of a single dresspack may be empty
  /// (dresspack) simulated stiffnesses, given or from the construction [N m2], [N m2], [N]
  std::vector<double> bending_stiffness, torsional_stiffness, axial_stiffness;
  std::vector<int> dresspack;           ///< (segment) index of its dresspack
  std::vector<double> segment_length;   ///< (segment) unstretched [m]
  std::vector<int> clamp_segment;       ///< (clamp) segments on its base side
  std::vector<std::string> link_names;  ///< links of the robot; empty without a robot
  int links = 0;                        ///< number of links of the chain
  int joints = 0;                       ///< number of joints of the robot
  std::vector<std::string> step_texts;  ///< (line) texts of the program
  std::vector<MotionLoop> loops;        ///< equal rounds of the program
};

/// Adds the name and stiffnesses of the next dresspack.
void describe_dresspack(RunDescription& description, const pipeline::MountedDresspack& mounted);

/// One sample; the references are valid until the callback returns.
struct Sample {
  double time = 0;                     ///< [s]
  int step = 0;                        ///< program line
  const RodState& state;               ///< state of the chain
  const std::vector<Frame>& clamps;    ///< (clamp) frames
  const std::vector<double>& travel;   ///< (dresspack) travel of the retraction units [m]; empty without one
  const Pose& pose;                    ///< poses that the motion prescribes
  Energy energy;                       ///< [J]
  const std::vector<double>& tension;  ///< (segment) mean tension of the links at its ends [N]
  int contacts = 0;                    ///< largest number at one time since the previous sample
  double max_depth = 0;                ///< largest depth since the previous sample [m]
  double net_twist = 0;                ///< rotation of all links about the tangent, sum of all dresspacks [rad]
  const Touch& touch;                  ///< forces since the previous sample, and rubbing since the begin of the repeat
};

/// Returns the number of intervals of a rate [Hz] that cover a motion [s]. A duration that is a whole number of intervals up to
/// rounding gets no additional one. One repeat in motion.h5 takes so many.
int intervals(double duration, double rate);

/// Checks the size of a run before memory or time is used. The acceleration of each step of a repeat is kept, 8 bytes each;
/// each sample is written with at least 136 bytes per segment. Errors: InputError for a motion that is too long.
void check_size(const pipeline::Setup& setup, double duration, int segments);

/// The summary of a run.
struct RunSummary {
  int repeats = 1;        ///< number of repeats that were run, including the lead-in; the last one is the result
  bool returns = false;   ///< the motion ends at its begin
  bool periodic = false;  ///< the last repeat began and ended in the same state
  std::optional<double>
      stopped_at;        ///< time of a repeat at which a sink ended the run [s]: the checks are valid until then
  double distance = 0;   ///< distance of the states at the last repeat's begin and end (R8) [m]
  double time_step = 0;  ///< [s]
  /// Estimated relative error of curvature by the step, in the liveliest seconds of the last repeat (R10);
  /// NaN: the simulation with half the step breaks down.
  double curvature_error = 0;
  std::vector<Extreme> curvature, twist, tension;  ///< (link) of the last repeat, as in MotionChecks
  std::vector<Check> checks;                       ///< of the last repeat
  std::vector<RubbedPatch> rubbed;                 ///< of the last repeat without the rounds that were left out
  std::vector<std::string> obstacles;              ///< names, indexed by RubbedPatch::obstacle
  double seconds = 0;                              ///< duration of what was simulated of the last repeat [s]

  /// Returns the mean power of rubbing, normal force times sliding speed (S23) [W].
  double rubbing_power() const;
};

/// Returns the warnings of a run: skipped lines of its program, repeats that do not converge, and
/// every check with an exceeded limit.
std::vector<pipeline::Warning> warnings_of(const Simulation& simulation, const RunSummary& summary);

/// Returns a note with the number of repeats; empty: one repeat.
std::string repeats_note(const RunSummary& summary);

/// What a run computes beside states and clamps.
enum class Wanted {
  everything,
  /// checks: a sample's energy and tension and the error of the step stay empty. Rounds of a loop are left out as soon as two
  /// successive ones begin in the same state (R8): the remaining ones are equal to the last.
  checks,
  places_and_checks,  ///< as checks, but all rounds are there, and rubbing stays empty
};

/// Callbacks for the results of a run; only `take` is required.
struct RunSinks {
  std::function<void(const Sample&)> take;    ///< every sample of every repeat except the lead-in
  std::function<void(int)> begin = {};        ///< a further repeat begins: earlier samples are replaced
  std::function<void(double)> progress = {};  ///< finished share of the repeat, 0..1
  /// Returns whether the run continues after further work (World::work). Second argument: whether this is the lead-in repeat.
  std::function<bool(double, bool)> goes_on = {};
  /// Returns whether the evaluated repeat continues, given the checks of its samples so far.
  std::function<bool(const MotionChecks&)> still_of_use = {};
  Wanted wanted = Wanted::everything;
};

class Simulation {
 public:
  /// Finds the start. Throws InputError: errors of the motion's constructors; a motion in which the distance of the clamps
  /// exceeds the free length (with time, program line and missing millimetres); no
  /// equilibrium at the start.
  explicit Simulation(const pipeline::Setup& setup);
  ~Simulation();

  const RunDescription& description() const { return description_; }
  const RodState& start() const { return start_; }
  const ClampPath& path() const { return *path_; }
  const Rod& rod() const { return rod_; }
  /// Returns warnings about the robot program (Motion::left_out); empty without one.
  std::vector<pipeline::Warning> doubts() const;
  std::string program_note() const;          ///< note of a run about the program; empty: none
  std::vector<std::string> assumed() const;  ///< RunMotion::assumed
  /// Returns the given setup; its simulation.time_step is the first step of the run.
  const pipeline::Setup& setup() const { return setup_; }
  std::string moment(double time) const { return path_->moment(time); }

  /// Runs the motion, with as many repeats as necessary. Throws InputError when the dresspack is pulled taut or the state
  /// is no longer finite.
  RunSummary run(const RunSinks& sinks) const;

 private:
  struct Repeat;  // callbacks and checks during a repeat
  std::unique_ptr<World> world_at(const RodState& state, const Pose& pose, double step) const;
  std::unique_ptr<World> led_in(const RunSinks& sinks) const;
  /// Returns the time at which it was stopped; absent: it was not.
  std::optional<double> run_once(World& world, Repeat& repeat, const RunSinks& sinks, bool last) const;
  int steps_per_sample(double step) const;
  std::vector<double> pulled_out(const RodState& state) const;
  void check_reach() const;
  std::string between_clamps(const Span& span) const;
  void check_step(const StepReport& report, double time) const;
  void check_taut(const RodState& state, double time) const;

  pipeline::Setup setup_;  // its time step is the first one if the run chooses the step
  Rod rod_;
  std::unique_ptr<ClampPath> path_;
  RobotPath* robot_ = nullptr;  // path_ if it is a robot's path, else null
  RunDescription description_;
  RodState start_;
};

}  // namespace dresslife::sim
