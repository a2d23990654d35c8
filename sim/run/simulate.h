// The run of one job: from the dresspack at rest in its clamps, step by step through the motion, to samples.
//
// (R6) From rest in its mounting (mounting.h), time goes on in steps h, clamps and links follow the motion,
// and every 1/(rate h)-th state is a sample: t = k/rate, k = 0, 1, ... until the motion has ended. A motion
// that returns is repeated until two successive repeats begin alike (R8, periodic.h); the last one counts,
// the first only leads in. Memory does not grow with the motion's length.
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
#include "sim/run/checks.h"
#include "sim/run/clamp_path.h"
#include "sim/run/step_choice.h"

namespace dresslife::sim {

class Simulation;

/// What holds for all samples of a run.
struct RunDescription {
  int samples = 0;
  std::vector<std::string> dresspacks;  ///< their names; the only one's may be empty
  /// (dresspack) as it was simulated, given or from its construction [N m2], [N m2], [N]
  std::vector<double> bending_stiffness, torsional_stiffness, axial_stiffness;
  std::vector<int> dresspack;           ///< (segment) that it belongs to
  std::vector<double> segment_length;   ///< (segment) unstretched [m]
  std::vector<int> clamp_segment;       ///< (clamp) segments on its base side
  std::vector<std::string> link_names;  ///< of the robot; empty without one
  int links = 0;                        ///< of the chain
  int joints = 0;                       ///< of the robot
  std::vector<std::string> step_texts;  ///< (line) of the program
};

/// The next dresspack's name and stiffnesses.
void describe_dresspack(RunDescription& description, const pipeline::MountedDresspack& mounted);

/// One sample; the references hold until the callback returns.
struct Sample {
  double time = 0;                     ///< [s]
  int step = 0;                        ///< program line
  const RodState& state;               ///< of the chain
  const std::vector<Frame>& clamps;    ///< (clamp) where they are
  const std::vector<double>& travel;   ///< (dresspack) of retraction units [m]; empty without one
  const Pose& pose;                    ///< what the motion prescribes
  Energy energy;                       ///< [J]
  const std::vector<double>& tension;  ///< (segment) mean pull of the links at its ends [N]
  int contacts = 0;                    ///< most at a time since the sample before
  double max_depth = 0;                ///< deepest since the sample before [m]
  double net_twist = 0;                ///< turns of all links about the tangent, of all dresspacks [rad]
  const Touch& touch;                  ///< forces and rubbing since the sample before and the repeat's begin
};

/// The summary of a run.
struct RunSummary {
  int repeats = 1;        ///< of the motion that were run, the one that leads in too; the last is the result
  bool returns = false;   ///< the motion ends where it begins
  bool periodic = false;  ///< the last repeat began and ended alike
  std::optional<double> stopped_at;  ///< time of a repeat at which a sink ended the run [s]: its checks until then
  double distance = 0;    ///< between the states at the last repeat's begin and end (R8) [m]
  double time_step = 0;   ///< [s]
  /// Estimated error that the step leaves in the curvature of the last repeat's liveliest seconds (R10),
  /// relative; not a number where half the step breaks down.
  double curvature_error = 0;
  std::vector<Extreme> curvature, twist, tension;  ///< (link) of the last repeat, as in MotionChecks
  std::vector<Check> checks;                       ///< of the last repeat
  std::vector<RubbedPatch> rubbed;                 ///< of the last repeat
  std::vector<std::string> obstacles;              ///< of RubbedPatch::obstacle
};

/// The warnings of a run: skipped lines of its program, repeats that do not become alike, and
/// every check whose limit is broken.
std::vector<pipeline::Warning> warnings_of(const Simulation& simulation, const RunSummary& summary);

/// How many repeats it took; empty where there was one.
std::string repeats_note(const RunSummary& summary);

/// What a run hands its results to; only `take` is needed.
struct RunSinks {
  std::function<void(const Sample&)> take;    ///< every sample of every repeat but the one that leads in
  std::function<void(int)> begin = {};        ///< a further repeat begins: samples taken so far do not count
  std::function<void(double)> progress = {};  ///< share of the repeat that is done, 0..1
  /// Whether the run goes on after further work (World::work), of the repeat that leads in or of others.
  std::function<bool(double, bool)> goes_on = {};
  /// Whether the repeat that is evaluated goes on after the checks of its samples so far.
  std::function<bool(const MotionChecks&)> still_of_use = {};
  /// Only states and clamps are wanted: a sample's energy, tension, contacts and touch, checks, rubbing and the error of the
  /// step stay empty.
  bool places_only = false;
};

class Simulation {
 public:
  /// Finds the start. Throws InputError: what the motion's constructors throw; a motion that pulls the clamps
  /// further apart than the free length (when, in which program line, how many millimetres are missing); no
  /// equilibrium at the start.
  explicit Simulation(const pipeline::Setup& setup);
  ~Simulation();

  const RunDescription& description() const { return description_; }
  const RodState& start() const { return start_; }
  const ClampPath& path() const { return *path_; }
  const Rod& rod() const { return rod_; }
  /// Of the robot program that was read (Motion::left_out); nothing without one.
  std::vector<pipeline::Warning> doubts() const;
  std::string program_note() const;  ///< a run's note on that program; empty: none
  /// As given; simulation.time_step is the step that the run begins with.
  const pipeline::Setup& setup() const { return setup_; }
  std::string moment(double time) const;  ///< "at 1.2 s, program step 3 'text'"

  /// Runs the motion, as often as it takes. Throws InputError when the dresspack is drawn taut or the state
  /// is no longer finite.
  RunSummary run(const RunSinks& sinks) const;

 private:
  struct Repeat;  // what looks on while a repeat runs
  std::unique_ptr<World> world_at(const RodState& state, const Pose& pose, double step) const;
  std::unique_ptr<World> led_in(const RunSinks& sinks) const;
  /// The time at which it was stopped; absent: it was not.
  std::optional<double> run_once(World& world, Repeat& repeat, const RunSinks& sinks, bool last) const;
  int steps_per_sample(double step) const;
  std::vector<double> pulled_out(const RodState& state) const;
  void check_reach() const;
  std::string between_clamps(const Span& span) const;
  void check_step(const StepReport& report, double time) const;
  void check_taut(const RodState& state, double time) const;

  pipeline::Setup setup_;  // its time step is the first one if the run is to choose
  Rod rod_;
  std::unique_ptr<ClampPath> path_;
  RobotPath* robot_ = nullptr;  // path_, if it is one
  RunDescription description_;
  RodState start_;
};

}  // namespace dresslife::sim
