#include "sim/run/simulate.h"

#include <algorithm>
#include <cmath>

#include "pipeline/base/lists.h"
#include "pipeline/base/warning_words.h"
#include "sim/run/cures.h"
#include "sim/run/longest_way.h"
#include "sim/run/mounting.h"
#include "sim/run/periodic.h"
#include "sim/run/routing.h"

namespace dresslife::sim {

using pipeline::InputError;

void check_size(const pipeline::Setup& setup, double duration, int segments) {
  constexpr double most_steps = 1e8, most_values = 1e9;  // 0.8 GB of memory, 140 GB of disk
  const pipeline::SimulationSettings& settings = setup.simulation;
  const double steps = duration / settings.time_step, values = duration * settings.sample_rate * segments;
  if (!(steps <= most_steps))
    throw InputError(setup.motion.where,
                     fmt::format("one repeat of the motion takes {:.6g} s, {:.3g} steps of {:.4g} ms (at most {:.0e})",
                                 duration, steps, 1e3 * settings.time_step, most_steps),
                     "look for a long dwell or many repeats, or choose a longer simulation.time_step_ms");
  if (!(values <= most_values))
    throw InputError(setup.motion.where,
                     fmt::format("one repeat of the motion takes {:.6g} s: {:.3g} samples of {} segments, {:.0f} GB",
                                 duration, duration * settings.sample_rate, segments, 136e-9 * values),
                     "choose a lower simulation.sample_rate_Hz or fewer segments, or split the motion");
}

int intervals(double duration, double rate) { return static_cast<int>(std::ceil(duration * rate - 1e-9)); }

namespace {

constexpr double same_step = 1e-9, rounding = 1e-9;  // [s]
constexpr double exact_lead = 0.1;  // share of the lead-in repeat, at its end, that has the motion's own step

std::vector<MotionLimits> limits_of(const pipeline::Setup& setup) {
  return pipeline::mapped(setup.dresspacks, [](const auto& mounted) { return sim::limits_of(mounted.dresspack); });
}

}  // namespace

void describe_dresspack(RunDescription& description, const pipeline::MountedDresspack& mounted) {
  description.dresspacks.push_back(mounted.name);
  description.bending_stiffness.push_back(mounted.dresspack.bending_stiffness);
  description.torsional_stiffness.push_back(mounted.dresspack.torsional_stiffness);
  description.axial_stiffness.push_back(mounted.dresspack.axial_stiffness);
}

Simulation::Simulation(const pipeline::Setup& setup) : setup_(setup), rod_(rod_of(setup_)), path_(path_of(setup_)) {
  if (setup_.simulation.choose_time_step) setup_.simulation.time_step = first_step(setup_.simulation.sample_rate);
  robot_ = dynamic_cast<RobotPath*>(path_.get());
  check_size(setup_, path_->program_duration(), rod_.segments());
  description_.samples = intervals(path_->duration(), setup_.simulation.sample_rate) + 1;
  for (const pipeline::MountedDresspack& mounted : setup_.dresspacks) describe_dresspack(description_, mounted);
  for (double& stiffness : description_.bending_stiffness) stiffness *= setup_.simulation.stiffness_factor;
  for (int i = 0; i < rod_.segments(); ++i) {
    description_.dresspack.push_back(rod_.span_of(i).dresspack);
    description_.segment_length.push_back(rod_.span_of(i).segment_length);
  }
  description_.clamp_segment = clamp_segments(rod_);
  description_.links = rod_.links();
  description_.joints = static_cast<int>(robot_ ? setup_.robot.axes() : 0);
  description_.step_texts = path_->step_texts();
  if (robot_) description_.loops = loops_of(robot_->motion());
  if (robot_)
    for (const pipeline::Link& link : setup_.robot.links) description_.link_names.push_back(link.name);
  check_reach();
  start_ = mount(setup_, rod_, *path_, robot_);
}

Simulation::~Simulation() = default;

std::vector<pipeline::Warning> Simulation::doubts() const {
  return robot_ ? robot_->doubts() : std::vector<pipeline::Warning>{};
}

std::string Simulation::program_note() const { return robot_ ? robot_->note() : ""; }
std::vector<std::string> Simulation::assumed() const { return robot_ ? robot_->assumed() : std::vector<std::string>{}; }

/// Checks that the free length reaches the distance between the ends of each span at every moment; reports the worst
/// moment.
void Simulation::check_reach() const {
  const std::vector<LongestWay> longest = longest_ways(setup_, rod_, *path_, setup_.simulation.time_step);
  double worst = 0, when = 0;
  size_t where = 0;
  for (size_t span = 0; span < longest.size(); ++span)
    if (const double missing = longest[span].way - rod_.spans()[span].properties.length; missing > worst)
      worst = missing, when = longest[span].time, where = span;
  if (worst == 0) return;
  const Span& span = rod_.spans()[where];
  const double length = span.properties.length;
  const std::string between = between_clamps(span);
  throw RoutingRefusal(setup_.dresspacks[span.dresspack].routing.where,
                       fmt::format("{} is {:.1f} mm too short {} ({} {}, the clamps are {:.4f} m apart there)",
                                   pipeline::dresspack_words(setup_, span.dresspack), 1e3 * worst, moment(when),
                                   between.empty() ? "routing.free_length_m is" : "its length" + between + " is",
                                   length, length + worst),
                       "give it more free length, with slack to bend, or move a clamp (dresslife preview shows it)",
                       span.dresspack, when);
}

std::string Simulation::between_clamps(const Span& span) const {
  const auto piece = static_cast<std::size_t>(&span - rod_.spans().data() - rod_.first_span(span.dresspack));
  return pipeline::between_clamps(setup_.dresspacks[static_cast<std::size_t>(span.dresspack)].routing, piece);
}

void Simulation::check_step(const StepReport& report, double time) const {
  if (!report.finite)
    throw InputError({setup_.dresspacks.front().routing.where.file},
                     fmt::format("the simulation broke down {} (the state is not finite)", moment(time)),
                     "choose a smaller simulation.time_step_ms, or check the dresspack's stiffness and mass");
}

void Simulation::check_taut(const RodState& state, double time) const {
  const Span& span = rod_.most_stretched(state);
  const double elongation = rod_.mean_elongation(state, span);
  if (elongation <= longest_elongation) return;
  RoutingRefusal refusal(
      setup_.dresspacks[span.dresspack].routing.where,
      fmt::format("{} is pulled tight{} {}: {:.1f} mm are missing (it is stretched by {:.1f} %)",
                  pipeline::dresspack_words(setup_, span.dresspack), between_clamps(span), moment(time),
                  1e3 * elongation * span.properties.length, 1e2 * elongation),
      fmt::format(
          "give it more free length, or keep the motion from winding it around {} (dresslife preview shows the clamps)",
          obstacle_words(setup_)),
      span.dresspack, time);
  refusal.taut = true;
  throw refusal;
}

std::unique_ptr<World> Simulation::world_at(const RodState& state, const Pose& pose, double step) const {
  pipeline::Setup setup = setup_;
  setup.simulation.time_step = step;
  return make_world(setup, rod_, robot_, state, pose);
}

int Simulation::steps_per_sample(double step) const {
  return std::max(1, static_cast<int>(std::lround(1 / (setup_.simulation.sample_rate * step))));
}

struct Simulation::Repeat {
  Repeat(const Simulation& s, double step)
      : checks(s.rod_, limits_of(s.setup_)),
        error(
            s.rod_, *s.path_,
            [&s](const RodState& state, const Pose& pose, double h) { return s.world_at(state, pose, h); }, step,
            (s.description_.samples - 1) * s.steps_per_sample(step)) {}
  MotionChecks checks;
  StepError error;
  std::vector<RubbedPatch> rubbed;
  std::vector<std::string> obstacles;
  double seconds = 0;
};

double RunSummary::rubbing_power() const {
  double work = 0;
  for (const RubbedPatch& patch : rubbed) work += patch.work;
  return seconds > 0 ? work / seconds : 0;
}

// (R8) Errors that a repeat forgets are allowed: the first repeat of a motion that ends at its begin only leads into the
// cycle. It has twice the step, except for its last tenth, and leaves out equal rounds of loops. The result is judged like that
// of any two repeats.
// Returns null if it broke down, pulled the dresspack taut or was stopped; then the motion runs from rest, which finds the place.
std::unique_ptr<World> Simulation::led_in(const RunSinks& sinks) const {
  const double h = setup_.simulation.time_step;
  const int steps = (description_.samples - 1) * steps_per_sample(h);
  const int coarse = static_cast<int>((1 - exact_lead) * steps / 2) * 2;
  const int taut_steps = 2 * steps_per_sample(h);  // for both steps; a run with samples checks at the same distance
  std::unique_ptr<World> world = world_at(start_, path_->at(0), 2 * h);
  RodState before;
  LeftOutRounds rounds(rod_, *path_, setup_.simulation.periodic_tolerance);
  double left_out = 0;  // [s]
  int at = 0;
  const auto time = [&] { return at * h + left_out; };
  const auto advance = [&](int by) {
    at += by;
    const Pose pose = path_->at(time());
    if (by == 2) before = world->state();
    if (sinks.progress) sinks.progress(time() / (steps * h));
    const double before_step = world->work();
    const bool goes_on = world->advance(pose.clamps, pose.links).finite &&
                         (at % taut_steps != 0 || rod_.mean_elongation(world->state()) <= longest_elongation) &&
                         (!sinks.goes_on || sinks.goes_on(world->work() - before_step, true));
    if (goes_on) left_out += rounds.see(time(), by * h, world->state());
    return goes_on;
  };
  while (time() + 2 * h <= coarse * h + rounding)
    if (!advance(2)) return nullptr;
  if (at > 0)
    world = world_at(with_half_step(world->state(), before), path_->at(time()), h);
  else
    world = world_at(start_, path_->at(0), h);
  while (time() + h <= steps * h + rounding)
    if (!advance(1)) return nullptr;
  return world;
}

RunSummary Simulation::run(const RunSinks& sinks) const {
  const pipeline::SimulationSettings& settings = setup_.simulation;
  RunSummary summary;
  summary.returns = returns(*path_);
  summary.time_step = settings.time_step;
  bool choose = settings.choose_time_step;
  std::unique_ptr<World> world;
  if (summary.returns && !choose && settings.most_repeats > 1) world = led_in(sinks);
  summary.repeats = world ? 2 : 1;
  if (!world) world = world_at(start_, path_->at(0), summary.time_step);
  for (bool first = true;; first = false) {  // (R8)
    const RodState begin = world->state();
    if (!first && sinks.begin) sinks.begin(summary.repeats);
    Repeat repeat(*this, summary.time_step);
    const bool last = !summary.returns || summary.repeats >= settings.most_repeats;
    if (const std::optional<double> stop = run_once(*world, repeat, sinks, last)) {
      if (first || (last && sinks.still_of_use && !sinks.still_of_use(repeat.checks)))
        summary.stopped_at = stop, summary.checks = repeat.checks.table();
      return summary;
    }
    summary.checks = repeat.checks.table();
    summary.distance = state_distance(rod_, begin, world->state());
    summary.periodic = summary.returns && summary.distance <= settings.periodic_tolerance;
    if (choose) {  // (R11), once, after the first repeat
      choose = false;
      const double step =
          chosen_step(summary.time_step, repeat.error.estimate(), settings.curvature_error / 100, settings.sample_rate);
      if (std::abs(step - summary.time_step) > same_step) {
        summary.time_step = step;
        world = world_at(summary.returns ? world->state() : start_, path_->at(0), step);
        summary.repeats += summary.returns;  // without a return the motion begins again at its start
        continue;
      }
    }
    if (summary.returns && !summary.periodic && summary.repeats < settings.most_repeats) {
      ++summary.repeats;
      continue;
    }
    if (sinks.wanted == Wanted::everything) summary.curvature_error = repeat.error.estimate();
    summary.curvature = repeat.checks.curvature();
    summary.twist = repeat.checks.twist();
    summary.tension = repeat.checks.tension();
    summary.rubbed = std::move(repeat.rubbed);
    summary.obstacles = std::move(repeat.obstacles);
    summary.seconds = repeat.seconds;
    return summary;
  }
}

std::vector<double> Simulation::pulled_out(const RodState& state) const {
  const auto slides = [](const Span& span) { return span.properties.slider.has_value(); };
  if (std::ranges::none_of(rod_.spans(), slides)) return {};
  std::vector<double> ways;
  for (int d = 0; d < rod_.dresspacks(); ++d) ways.push_back(state.travel[rod_.first_span(d)].way);
  return ways;
}

std::optional<double> Simulation::run_once(World& world, Repeat& repeat, const RunSinks& sinks, bool last) const {
  const double step = world.time_step();
  const int per_sample = steps_per_sample(step);
  MotionChecks& checks = repeat.checks;
  Pose pose = path_->at(0);
  std::vector<double> tension(rod_.segments());
  StepReport since;
  Touch touch(rod_.segments(), description_.link_names, static_cast<int>(pose.rings.size()));
  Rubbing rubbing(rod_);
  const auto hand_over = [&](double time) {
    const RodState& state = world.state();
    const bool all = sinks.wanted == Wanted::everything;
    const std::vector<double> pull = all ? rod_.tensions(state) : std::vector<double>{};
    for (const Span& span : rod_.spans())
      for (int i = 0; all && i < span.segments(); ++i)
        tension[span.first_segment + i] = (pull[span.first_link + i] + pull[span.first_link + i + 1]) / 2;
    const std::vector<Frame> clamps = listed_clamps(rod_, state.clamps);
    const std::vector<double> travel = pulled_out(state);
    sinks.take({time, path_->step(time), state, clamps, travel, pose, all ? rod_.energy(state) : Energy{}, tension,
                since.touching, since.max_depth, checks.net_twist(), touch});
    since = {};
    touch.begin_sample();
    rubbing.end_sample(time);
  };
  const auto ways = [&] {
    return pose.rings.empty() ? std::vector<double>{} : shortest_ways(setup_, rod_, world.state().clamps, pose.rings);
  };
  checks.see(world.state(), {}, 0, ways());
  repeat.error.see(0, world.state());
  hand_over(0);
  LeftOutRounds rounds(rod_, *path_, setup_.simulation.periodic_tolerance);
  double left_out = 0;  // [s]
  const auto ended = [&](double time, bool stopped) -> std::optional<double> {
    if (sinks.wanted != Wanted::places_and_checks) {
      repeat.rubbed = rubbing.patches(touch);
      repeat.obstacles = touch.obstacles();
    }
    repeat.seconds = (time - left_out) * (time > 0 ? path_->program_time(time) / time : 1);  // with the whole waits
    return stopped ? std::optional(time) : std::nullopt;
  };
  double time = 0;
  for (int sample = 1; sample < description_.samples; ++sample) {  // (R6)
    const double before = world.work();
    for (int k = 1; k <= per_sample; ++k) {
      const int count = (sample - 1) * per_sample + k;
      time = count * step + left_out;
      pose = path_->at(time);
      const StepReport report = world.advance(pose.clamps, pose.links);
      check_step(report, time);
      checks.see(world.state(), world.contacts(), time, ways());
      if (sinks.wanted == Wanted::places_and_checks) continue;
      touch.add(world.contacts(), step);
      rubbing.add(world.contacts(), world.state(), step);
      if (sinks.wanted == Wanted::checks) {
        left_out += rounds.see(time, step, world.state());
        continue;
      }
      repeat.error.see(count, world.state());
      since.touching = std::max(since.touching, report.touching);
      since.max_depth = std::max(since.max_depth, report.max_depth);
    }
    time = sample / setup_.simulation.sample_rate + left_out;
    check_taut(world.state(), time);
    hand_over(time);
    if (sinks.progress) sinks.progress((sample + 1.0) / description_.samples);
    if (sinks.goes_on && !sinks.goes_on(world.work() - before, false)) return ended(time, true);
    if (last && sinks.still_of_use && !sinks.still_of_use(checks)) return ended(time, true);
    if (left_out > 0 && time >= path_->duration()) break;
  }
  return ended(time, false);
}

std::vector<pipeline::Warning> warnings_of(const Simulation& simulation, const RunSummary& summary) {
  std::vector<pipeline::Warning> warnings = simulation.doubts();
  const pipeline::SimulationSettings& settings = simulation.setup().simulation;
  if (summary.returns && !summary.periodic) {
    warnings.push_back(pipeline::warning_of(
        pipeline::WarningKind::periodic, "",
        fmt::format("after {} repeats the motion still begins {:.1f} mm from where it began the repeat before (limit "
                    "simulation.periodic_tolerance_mm {:.3g}); the last repeat is evaluated",
                    summary.repeats, 1e3 * summary.distance, 1e3 * settings.periodic_tolerance),
        "friction and contact leave the dresspack several resting places",
        fmt::format("simulation.most_repeats: {}, or simulation.periodic_tolerance_mm: {:g} if repeats may differ so",
                    std::min(1000, 2 * settings.most_repeats), std::ceil(2e4 * summary.distance) / 10)));
    warnings.back().amount = summary.distance / settings.periodic_tolerance;
  }
  warnings = pipeline::joined(std::move(warnings), one_link_warnings(simulation.setup()));
  return pipeline::joined(warnings,
                          check_warnings({simulation.setup(), [&](double time) { return simulation.moment(time); },
                                          &simulation.rod(), &simulation.path()},
                                         summary.checks));
}

std::string repeats_note(const RunSummary& summary) {
  if (summary.repeats < 2 || !summary.periodic) return "";
  return fmt::format("note: the motion is periodic after {} repeats ({:.2g} mm apart); the last one is evaluated",
                     summary.repeats, 1e3 * summary.distance);
}

}  // namespace dresslife::sim
