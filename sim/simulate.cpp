#include "sim/simulate.h"

#include <algorithm>
#include <cmath>

namespace dresslife::sim {
namespace {

using pipeline::InputError;

/// Between equilibria on the way from the mounting pose to the first waypoint, largest axis: a quarter turn
/// would still find its branch, this is far from it.
constexpr double equilibrium_step = 5 * EIGEN_PI / 180;  // [rad]

RodProperties properties_of(const pipeline::Job& job) {
  const pipeline::Dresspack& hose = job.dresspack;
  RodProperties properties;
  properties.segments = job.simulation.segments;
  properties.length = job.routing.free_length;
  properties.mass_per_length = hose.mass_per_length;
  properties.diameter = hose.diameter;
  properties.bending_stiffness = hose.bending_stiffness;
  properties.torsional_stiffness = hose.torsional_stiffness;
  properties.axial_stiffness = hose.axial_stiffness;
  properties.damping_time = hose.damping_time;
  properties.gravity = job.simulation.gravity;
  return properties;
}

std::unique_ptr<ClampPath> path_of(const pipeline::Job& job) {
  if (!job.motion.clamp_poses.empty()) return std::make_unique<RecordedPath>(job.motion.clamp_poses);
  return std::make_unique<RobotPath>(job);
}

int steps_per_sample(const pipeline::Simulation& settings) {
  return std::max(1, static_cast<int>(std::lround(1 / (settings.sample_rate * settings.time_step))));
}

/// Intervals that cover the motion; a duration that is a whole number of them up to rounding takes no further
/// one.
int intervals(double duration, double rate) { return static_cast<int>(std::ceil(duration * rate - 1e-9)); }

}  // namespace

Simulation::Simulation(const pipeline::Job& job)
    : job_(job), rod_(properties_of(job_)), path_(path_of(job_)) {
  robot_ = dynamic_cast<RobotPath*>(path_.get());
  description_.samples = intervals(path_->duration(), job_.simulation.sample_rate) + 1;
  description_.segment_length.assign(rod_.segments(), rod_.segment_length());
  description_.joints = static_cast<int>(robot_ ? job_.robot.joints.size() : 0);
  description_.step_texts = path_->step_texts();
  if (robot_)
    for (const pipeline::Link& link : job_.robot.links) description_.link_names.push_back(link.name);
  check_reach();
  start_ = settled(mounted());
}

Simulation::~Simulation() = default;

std::string Simulation::moment(double time) const {
  const int step = path_->step(time);
  return fmt::format("at {:.3f} s, program step {} '{}'", time, step + 1, path_->step_texts()[step]);
}

/// The straight line between the clamps is the least length that every moment needs; the worst one is
/// reported.
void Simulation::check_reach() const {
  double worst = 0, when = 0;
  const int steps = intervals(path_->duration(), 1 / job_.simulation.time_step);
  for (int k = 0; k <= steps; ++k) {
    const double time = k * job_.simulation.time_step;
    const double missing = missing_length(rod_, path_->at(time).clamps);
    if (missing > worst) worst = missing, when = time;
  }
  if (worst == 0) return;
  throw InputError(
      job_.routing.where,
      fmt::format("dresspack is {:.1f} mm too short {} (routing.free_length_m is {}, the clamps are "
                  "{:.4f} m apart there)",
                  1e3 * worst, moment(when), job_.routing.free_length, job_.routing.free_length + worst),
      "give it more free length, with slack to bend, or move a clamp");
}

/// At rest in the clamps of the first waypoint, without obstacles.
RodState Simulation::mounted() {
  if (!robot_) return find_equilibrium(rod_, path_->at(0).clamps).state;
  const Eigen::VectorXd from = robot_->mounting_pose(), way = robot_->motion().position(0) - from;
  const ClampFrames clamps = robot_->pose(from).clamps;
  RodState state;
  if (job_.routing.tool_clamp->roll) {
    state = find_equilibrium(rod_, clamps).state;
  } else {
    TwistFreeClamp free = twist_free_roll(rod_, clamps);
    robot_->turn_tool_clamp(free.roll);
    state = std::move(free.equilibrium.state);
  }
  const int steps = static_cast<int>(std::ceil(way.lpNorm<Eigen::Infinity>() / equilibrium_step));
  for (int k = 1; k <= steps; ++k)
    state = find_equilibrium(rod_, robot_->pose(from + way * k / steps).clamps, state).state;
  return state;
}

std::unique_ptr<World> Simulation::make_world(const RodState& state, const Pose& pose) const {
  WorldSettings settings;
  settings.time_step = job_.simulation.time_step;
  settings.friction = job_.dresspack.friction;
  settings.floor = job_.simulation.floor;
  if (robot_) {
    settings.base_link = robot_->base_link();
    settings.tool_link = robot_->tool_link();
  }
  auto world = std::make_unique<World>(rod_, settings, state, pose.links);
  if (robot_ && job_.simulation.contact)
    for (size_t link = 0; link < job_.robot.links.size(); ++link)
      for (const pipeline::Capsule& capsule : job_.robot.links[link].capsules)
        world->add(static_cast<int>(link), CapsuleShape{capsule.from, capsule.to, capsule.radius});
  return world;
}

/// Where the mounted dresspack comes to rest among the robot's links and on the floor.
RodState Simulation::settled(const RodState& state) const {
  const Pose pose = path_->at(0);
  const std::unique_ptr<World> world = make_world(state, pose);
  const Equilibrium rest = settle(*world, pose.links);
  if (rest.status == EquilibriumStatus::converged) return rest.state;
  const std::string what =
      rest.status == EquilibriumStatus::too_short
          ? "dresspack is drawn taut at the start"
          : fmt::format("dresspack does not come to rest at the start (still moves at {:.3g} m/s)",
                        rest.residual);
  throw InputError(job_.routing.where, what, "check the free length and the clamps' places and directions");
}

void Simulation::check_step(const StepReport& report, const RodState& state, double time) const {
  if (!report.finite)
    throw InputError({job_.routing.where.file},
                     fmt::format("the simulation broke down {} (the state is not finite)", moment(time)),
                     "choose a smaller simulation.time_step_ms, or check the dresspack's stiffness and mass");
  const double elongation = rod_.mean_elongation(state);
  if (elongation <= longest_elongation) return;
  throw InputError(
      job_.routing.where,
      fmt::format("dresspack is drawn taut {}: {:.1f} mm are missing (it is stretched by {:.1f} %)",
                  moment(time), 1e3 * elongation * job_.routing.free_length, 1e2 * elongation),
      "give it more free length, or keep the motion from winding it around the robot");
}

void Simulation::run(const std::function<void(const Sample&)>& take,
                     const std::function<void(double)>& progress) const {
  const int per_sample = steps_per_sample(job_.simulation);
  Pose pose = path_->at(0);
  const std::unique_ptr<World> world = make_world(start_, pose);
  std::vector<double> tension(rod_.segments());
  StepReport since;
  const auto hand_over = [&](int sample) {
    const double time = sample / job_.simulation.sample_rate;
    const RodState& state = world->state();
    const std::vector<double> pull = rod_.tensions(state);
    for (int i = 0; i < rod_.segments(); ++i) tension[i] = (pull[i] + pull[i + 1]) / 2;
    take(
        {time, path_->step(time), state, pose, rod_.energy(state), tension, since.touching, since.max_depth});
    since = {};
    if (progress) progress((sample + 1.0) / description_.samples);
  };
  hand_over(0);
  for (int sample = 1; sample < description_.samples; ++sample) {  // (R6)
    for (int k = 1; k <= per_sample; ++k) {
      const double time = ((sample - 1.0) * per_sample + k) * job_.simulation.time_step;
      pose = path_->at(time);
      const StepReport report = world->advance(pose.clamps, pose.links);
      check_step(report, world->state(), time);
      since.touching = std::max(since.touching, report.touching);
      since.max_depth = std::max(since.max_depth, report.max_depth);
    }
    hand_over(sample);
  }
}

}  // namespace dresslife::sim
