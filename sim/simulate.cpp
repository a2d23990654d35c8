#include "sim/simulate.h"

#include <algorithm>
#include <cmath>

#include "sim/mounting.h"

namespace dresslife::sim {
namespace {

using pipeline::InputError;

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
  start_ = mount(job_, rod_, *path_, robot_);
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
  const std::unique_ptr<World> world = make_world(job_, rod_, robot_, start_, pose);
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
