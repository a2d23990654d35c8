#include "sim/run/cures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "pipeline/base/constants.h"
#include "pipeline/base/warning_words.h"
#include "pipeline/cable/bend_limit.h"
#include "pipeline/files/check_names.h"
#include "pipeline/job/line_key.h"
#include "pipeline/resolve/plausible_job.h"
#include "sim/run/equilibrium.h"

namespace dresslife::sim {
namespace {

namespace check_name = pipeline::check_name;
using pipeline::Remedy;
using pipeline::WarningKind;

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr int tried_poses = 8;
/// (pair of directions) number of lengths: 320 equilibria, one second. A change of length only is the easiest remedy, so its
/// steps are finer, 3 %.
constexpr std::array<int, 4> tried_lengths{16, 8, 8, 8};
constexpr double margin = 1.05;  // of a limit at rest and in a short run: the full program bends the hose more
constexpr std::array<std::size_t, 4> most_tried{
    5, 3, 3, 3};                   // (pair of directions) trials by the checks, up to two seconds each
constexpr double most_work = 1e7;  // of all trials of one job, in the unit of World::work: ten seconds
constexpr int most_segments = 32;  // of a trial: the bend radius has an error of a few percent

std::string in_words(double value, const std::string& unit) {
  if (unit == "m") return fmt::format("{:.1f} mm", 1e3 * value);
  if (unit == "rad/m") return fmt::format("{:.4g} deg/m", value / degree);
  return fmt::format("{:.3g} {}", value, unit);
}

/// Returns the value in metres, rounded up to millimetres.
std::string at_least_metres(double value) { return fmt::format("{:.3f}", std::ceil(1e3 * value) / 1e3); }

std::string key_of(const pipeline::Setup& setup, int dresspack, const std::string& key) {
  return pipeline::line_key(setup, static_cast<std::size_t>(dresspack), key);
}

const pipeline::MountedDresspack& mounted_of(const CheckedMotion& motion, const Check& check) {
  return motion.setup.dresspacks[static_cast<std::size_t>(check.dresspack)];
}

const Check* find(const std::vector<Check>& checks, std::string_view name, int dresspack) {
  const auto found = std::ranges::find_if(
      checks, [&](const Check& check) { return check.name == name && check.dresspack == dresspack; });
  return found == checks.end() ? nullptr : &*found;
}

/// Returns the span of a dresspack that contains the place of a check.
int span_at(const Rod& rod, const Check& check) {
  const int first = rod.first_span(check.dresspack), end = rod.first_span(check.dresspack + 1);
  for (int span = end - 1; span > first; --span)
    if (rod.spans()[span].first_arc <= check.position) return span;
  return first;
}

std::string vector_words(const Vector3& v) { return fmt::format("[{:.2f}, {:.2f}, {:.2f}]", v.x(), v.y(), v.z()); }

/// Equilibria of a span in some poses of its program, with other lengths and directions of its clamps.
class RestTrials {
 public:
  RestTrials(const CheckedMotion& motion, const Check& broken) : span_(span_at(*motion.rod, broken)) {
    properties_ = motion.rod->spans()[static_cast<std::size_t>(span_)].properties;
    const double duration = motion.path->duration();
    std::vector<double> times{broken.time};
    for (int k = 0; k < tried_poses - 1; ++k) times.push_back(duration * k / (tried_poses - 1));
    double longest_time = 0;
    for (int k = 0; k <= 1000; ++k)
      if (const double way = way_at(motion, duration * k / 1000); way > longest_)
        longest_ = way, longest_time = duration * k / 1000;
    times.push_back(longest_time);
    for (const double time : times) {
      const Pose pose = motion.path->at(time);
      poses_.push_back({pose.clamps.end(2 * span_), pose.clamps.end(2 * span_ + 1)});
    }
    for (int end = 0; end < 2; ++end) chord_turn_[end] = mean_turn_to_chord(end);
  }

  double longest() const { return longest_; }
  /// turned: (end) whether the clamp points along the mean of its chords. reversed: end that points in the opposite direction;
  /// -1: none. enough: a result above this value may be too small, because the remaining poses are left out.
  double curvature(double length, const std::array<bool, 2>& turned = {}, int reversed = -1,
                   double enough = infinite) const {
    RodProperties of = properties_;
    of.segments = std::min(of.segments, most_segments);
    of.length = length;
    double most = 0;
    for (ClampFrames clamps : poses_) {
      for (int end = 0; end < 2; ++end)
        if (turned[end]) clamps.end(end).orientation = clamps.end(end).orientation * chord_turn_[end];
      if (reversed >= 0) clamps.end(reversed).orientation = clamps.end(reversed).orientation * Quaternion(0, 1, 0, 0);
      most = std::max(most, curvature_at_rest(of, clamps));
      if (most > enough) break;
    }
    return most;
  }
  /// Returns the direction of a clamp along the mean of its chords, in the clamp's present frame.
  Vector3 chord_direction(int end) const { return chord_turn_[end] * Vector3::UnitZ(); }
  double length() const { return properties_.length; }

 private:
  double way_at(const CheckedMotion& motion, double time) const {
    const Pose pose = motion.path->at(time);
    return (pose.clamps.end(2 * span_ + 1).position - pose.clamps.end(2 * span_).position).norm();
  }
  Quaternion mean_turn_to_chord(int end) const {
    Vector3 mean = Vector3::Zero();
    for (const ClampFrames& clamps : poses_)
      mean += clamps.end(end).orientation.conjugate() * (clamps.tool.position - clamps.base.position).normalized();
    return mean.norm() < 0.1 ? Quaternion::Identity() : turn_between(Vector3::UnitZ(), mean);
  }

  int span_;
  RodProperties properties_;
  std::vector<ClampFrames> poses_;
  std::array<Quaternion, 2> chord_turn_;
  double longest_ = 0;
};

std::string radius_words(double curvature) { return in_words(1 / curvature, "m"); }

/// The search for other clamps.
constexpr const char* by_route =
    "(`dresslife route` searches for them, longer than `dresslife new`; where `dresslife route` proposed these clamps, it finds no others)";

std::string no_other_words(const CheckedMotion& motion, const std::string& limit) {
  return fmt::format(
      "other clamps {}: with these two clamps{} no length and no direction that was tried{} keeps the limit{}",
      by_route,
      motion.other_places ? fmt::format(", also if they are moved by up to {:.0f} mm,", 1e3 * same_place) : "",
      motion.work > most_work ? " in the time of a check" : "",
      // A refused job has no moments; its check, too, leaves the clamps where they are.
      limit + (motion.other_places || motion.own_stiffness != 1 || !motion.moment
                   ? ""
                   : fmt::format(" (`dresslife check` also moves them by up to {:.0f} mm)", 1e3 * same_place)));
}

using Kinds = std::vector<WarningKind>;
bool is_among(const Kinds& kinds, const Check& check) {
  return check.kind && std::ranges::find(kinds, *check.kind) != kinds.end();
}

/// Results of the checks of a changed job.
struct Trial {
  bool keeps =
      false;  ///< it keeps the limits of the requested kinds, and exceeds no limit that the job does not exceed now
  bool cured = false;             ///< the same, with the margin
  double radius = 0;              ///< smallest bend radius in the short run [m]; 0: no short run
  std::string other;              ///< name of a check other than bend radius with an exceeded limit; empty: none
  std::string refusal;            ///< reason why the short run ended; empty: it did not end early
  std::optional<double> until{};  ///< time at which the short run ended because of its duration [s]; absent: it did not
};

/// least_radius: radius above which a trial is better than the previous ones [m].
Trial trial_of(const CheckedMotion& motion, const pipeline::Setup& changed, const Kinds& kinds, int dresspack,
               const std::vector<Check>& now, double least_radius = 0) {
  if (motion.work > most_work) return {};
  const auto keeps = [&](const Check& check) {
    return check.dresspack != dresspack || !check.warning ||
           (!is_among(kinds, check) && std::ranges::any_of(now, [&](const Check& before) {
             return before.warning && before.kind == check.kind && before.dresspack == dresspack;
           }));
  };
  const auto rejects = [&](const QuickFindings& found) { return !std::ranges::all_of(found.checks, keeps); };
  const double limit = limits_of(changed.dresspacks[static_cast<std::size_t>(dresspack)].dresspack).least_bend_radius;
  const QuickFindings found = findings_unless(changed, rejects, std::min(least_radius, limit), dresspack);
  motion.work += found.run.work;
  Trial trial;
  trial.refusal = found.run.refusal;
  if (!trial.refusal.empty()) return trial;
  if (const Check* const bend = find(found.run.checks, check_name::bend_radius, dresspack)) trial.radius = bend->value;
  trial.until = found.run.stopped_at;
  trial.keeps = !rejects(found);
  if (trial.keeps && motion.own_stiffness != 1) {
    pipeline::Setup own = changed;
    own.simulation.stiffness_factor *= motion.own_stiffness;
    const QuickFindings as_it_is = findings_unless(own, rejects, limit, dresspack);
    motion.work += as_it_is.run.work;
    trial.keeps = as_it_is.run.refusal.empty() && !rejects(as_it_is);
  }
  trial.cured = trial.keeps && std::ranges::none_of(found.checks, [&](const Check& check) {
                  return check.dresspack == dresspack && is_among(kinds, check) &&
                         check.name == check_name::bend_radius && check.value < margin * check.limit;
                });
  for (const Check& check : found.checks)
    if (check.dresspack == dresspack && check.warning && check.kind != WarningKind::bend_radius)
      trial.other = check.name;
  return trial;
}

bool cures(const CheckedMotion& motion, const pipeline::Setup& changed, const Kinds& kinds, int dresspack,
           const std::vector<Check>& now) {
  return trial_of(motion, changed, kinds, dresspack, now).cured;
}

/// A change of the routing between the same links.
struct Change {
  double length = 0, pre_twist = 0;  // [m], [rad]
  std::array<bool, 2> turned{};      // (end)
  double curvature = infinite;       // at rest [1/m]
  Trial trial{};
};

/// Searches for a routing that keeps the limits of some kinds.
class RemedySearch {
 public:
  RemedySearch(const CheckedMotion& motion, const std::vector<Check>& checks, const RestTrials& trials, int dresspack,
               Kinds kinds = {WarningKind::bend_radius, WarningKind::slack})
      : motion_(motion), checks_(checks), trials_(trials), dresspack_(dresspack), kinds_(std::move(kinds)) {}

  /// Returns the first routing that keeps them; empty: no tried routing does. All warnings of a dresspack name the same one.
  Remedy remedy() {
    Remedy& known = motion_.remedies[{dresspack_, kinds_}];
    if (known.empty()) known = found();
    return known;
  }
  /// Returns a routing with clamps at other places of their links; empty: none was found.
  Remedy elsewhere() const { return motion_.other_places ? motion_.other_places() : Remedy{}; }
  /// Returns " (best of those tried: 1.250 m, bend radius 210.3 mm at rest, 187.2 mm in a short run; required: 200.0 mm)": the
  /// routing with the least bend of those that ran; if none ran, at rest. now: smallest bend radius of the job [m]. Empty: none
  /// has an equilibrium.
  std::string best_words(double now) const {
    const Trial& trial = best_.trial;
    if (trial.radius == 0 && std::isinf(best_.curvature)) return "";
    const bool as_it_is = best_.length == routing().free_length && !best_.turned[0] && !best_.turned[1];
    if (as_it_is || (trial.radius > 0 && trial.radius <= now))
      return " (none of those tried bends less than it does now)";
    const std::string in_run = trial.radius > 0                ? in_words(trial.radius, "m") + " in a short run"
                               : !trial.refusal.empty()        ? "and its short run ends: " + trial.refusal
                               : best_.curvature * limit() > 1 ? "too little for a short run"
                                                               : "not tried in a short run";
    return fmt::format(
        " (best of those tried: {} m{}, bend radius {} at rest, {}; required: {}{})", at_least_metres(best_.length),
        best_.turned[0] || best_.turned[1] ? " with another direction of a clamp" : "", radius_words(best_.curvature),
        in_run, in_words(limit(), "m"), trial.other.empty() ? "" : "; it passes another limit: " + trial.other);
  }

 private:
  Remedy found() {
    const Check* net = find(checks_, check_name::net_twist, dresspack_);
    constexpr double little = 10 * degree;  // a smaller pre-twist does not visibly change the shape
    if (net && std::abs(net->centre) > little) {
      Change change{routing().free_length, std::round((routing().pre_twist - net->centre) / degree) * degree};
      change.curvature = trials_.curvature(change.length);
      change.trial = tried_with(change);
      if (change.trial.keeps) return remedy_of(change);
    }
    constexpr std::array<std::array<bool, 2>, 4> turns{{{false, false}, {false, true}, {true, false}, {true, true}}};
    for (std::size_t turn = 0; turn < turns.size(); ++turn) {
      std::size_t tried = 0;
      std::optional<Change> kept;  // keeps the limits, but not with the margin
      for (const double length : lengths(tried_lengths[turn])) {
        if (tried == most_tried[turn] && best_.trial.radius > 0) break;
        Change change{length, routing().pre_twist, turns[turn]};
        // A shape that exceeds the limit counts only as the straightest so far, before a short run has a radius.
        const double enough = std::max(1 / limit(), best_.trial.radius == 0 ? best_.curvature : 0);
        change.curvature = trials_.curvature(length, change.turned, -1, enough);
        const bool is_straightest = best_.trial.radius == 0 && change.curvature < best_.curvature;
        if (is_straightest) best_ = change;
        if (change.curvature * limit() > 1 || tried == most_tried[turn]) continue;
        ++tried;
        change.trial = tried_with(change);
        if (is_straightest) best_ = change;
        if (change.trial.cured) return remedy_of(change);
        if (change.trial.keeps && (!kept || change.trial.radius > kept->trial.radius)) kept = change;
        if (change.trial.radius > best_.trial.radius) best_ = change;
      }
      if (kept) return remedy_of(*kept);
    }
    return {};
  }
  const pipeline::MountedDresspack& mounted() const {
    return motion_.setup.dresspacks[static_cast<std::size_t>(dresspack_)];
  }
  const pipeline::Routing& routing() const { return mounted().routing; }
  double limit() const { return limits_of(mounted().dresspack).least_bend_radius; }

  /// Returns the lengths, sorted by their distance from the present one.
  std::vector<double> lengths(int count) const {
    const WorkingLength range = working_length(trials_.longest());
    const double least = std::ceil(1e3 * range.least) / 1e3, most = std::floor(1e3 * range.most) / 1e3;
    const double now = routing().free_length;
    std::vector<double> all;
    if (now >= range.least && now <= range.most) all.push_back(now);
    for (int k = 0; k < count; ++k)
      all.push_back(std::round(1e3 * least * std::pow(most / least, static_cast<double>(k) / (count - 1))) / 1e3);
    std::ranges::stable_sort(
        all, [&](double a, double b) { return std::abs(std::log(a / now)) < std::abs(std::log(b / now)); });
    return all;
  }

  const pipeline::Clamp& clamp(int end) const { return end == 0 ? *routing().base_clamp : *routing().tool_clamp; }
  /// Returns the direction as it is written, rounded to hundredths.
  Vector3 direction(int end) const {
    const Vector3 of = clamp_frame(clamp(end)).orientation * trials_.chord_direction(end);
    return (1e2 * of).array().round() / 1e2;
  }

  Trial tried_with(const Change& change) const {
    const bool same = change.length == routing().free_length && change.pre_twist == routing().pre_twist;
    if (same && !change.turned[0] && !change.turned[1]) return {};
    pipeline::Setup changed = motion_.setup;
    pipeline::Routing& to = changed.dresspacks[static_cast<std::size_t>(dresspack_)].routing;
    to.free_length = change.length;
    to.pre_twist = change.pre_twist;
    if (change.turned[0]) to.base_clamp->direction = direction(0);
    if (change.turned[1]) to.tool_clamp->direction = direction(1);
    return trial_of(motion_, changed, kinds_, dresspack_, checks_, best_.trial.radius);
  }

  Remedy remedy_of(const Change& change) const {
    Remedy remedy;
    const auto add = [&](const std::string& key, const std::string& value) {
      remedy.values.push_back({key_of(motion_.setup, dresspack_, "routing." + key), value});
    };
    if (change.length != routing().free_length) add("free_length_m", fmt::format("{:.3f}", change.length));
    if (change.pre_twist != routing().pre_twist) add("pre_twist_deg", fmt::format("{:.0f}", change.pre_twist / degree));
    for (int end = 0; end < 2; ++end)
      if (change.turned[static_cast<std::size_t>(end)])
        add(end == 0 ? "base_clamp.direction" : "tool_clamp.direction", vector_words(direction(end)));
    const std::string near =
        change.trial.cured ? "" : fmt::format(", the bend radius by little: {}", in_words(change.trial.radius, "m"));
    const std::string until = change.trial.until ? fmt::format(" of the first {:.0f} s", *change.trial.until) : "";
    remedy.words = fmt::format(" (bend radius at rest {}; keeps the limits in a short run{}{})",
                               radius_words(change.curvature), until, near);
    return remedy;
  }

  const CheckedMotion& motion_;
  const std::vector<Check>& checks_;
  const RestTrials& trials_;
  int dresspack_;
  Kinds kinds_;
  Change best_;
};

/// Returns whether its length and the directions of its clamps can be tried: one span between two clamps of a robot, without
/// rings and without a retraction unit.
bool can_be_tried(const CheckedMotion& motion, int dresspack) {
  const pipeline::Routing& routing = motion.setup.dresspacks[static_cast<std::size_t>(dresspack)].routing;
  return motion.rod && routing.base_clamp && routing.tool_clamp && routing.clamps.empty() && routing.rings.empty() &&
         !routing.retraction;
}

std::string limit_remark(const CheckedMotion& motion, const Check& broken) {
  const pipeline::Dresspack& dresspack = mounted_of(motion, broken).dresspack;
  if (dresspack.least_bend_radius) return "";
  return fmt::format("; {} is not given, so that {}: give the maker's radius",
                     key_of(motion.setup, broken.dresspack, "dresspack.least_bend_radius_mm"),
                     pipeline::bend_rule(dresspack));
}

/// Returns a remark if the bend is near a clamp without a relief.
std::string relief_remark(const CheckedMotion& motion, const Check& broken) {
  const pipeline::Routing& routing = mounted_of(motion, broken).routing;
  std::vector<std::pair<double, std::string>> bare;
  const auto add = [&](const std::optional<pipeline::Clamp>& clamp, double at, const std::string& key) {
    const double away = std::abs(at - broken.position);
    if (clamp && !clamp->bend_relief && away < broken.limit) bare.emplace_back(away, key);
  };
  add(routing.base_clamp, 0, "routing.base_clamp");
  for (std::size_t k = 0; k < routing.clamps.size(); ++k)
    add(routing.clamps[k].clamp, routing.clamps[k].at_length, fmt::format("routing.clamps.{}", k + 1));
  add(routing.tool_clamp, routing.free_length, "routing.tool_clamp");
  if (broken.position < 0 || bare.empty()) return "";
  const pipeline::Dresspack& dresspack = mounted_of(motion, broken).dresspack;
  const pipeline::BendRelief relief = pipeline::first_relief(dresspack.diameter, dresspack.bending_stiffness, 0);
  const int now = motion.setup.simulation.segments;
  const double segments = std::ceil(pipeline::fewest_relief_segments * routing.free_length / relief.length);
  // improve changes no mesh, because lives of two meshes differ by more than a relief may cost
  const pipeline::BendRelief tried =
      pipeline::first_relief(dresspack.diameter, dresspack.bending_stiffness, routing.free_length / now);
  return fmt::format(
      "; a sleeve or spring beside the clamp may spread the bend, which dresslife improve tries: {}.bend_relief: {}{}",
      key_of(motion.setup, broken.dresspack, std::ranges::min_element(bare)->second), pipeline::relief_text(relief),
      segments > now ? fmt::format(" and simulation.segments: {:.0f} (with {} it tries four segments, {:.0f} mm)",
                                   segments, now, 1e3 * tried.length)
                     : "");
}

/// Returns "a repeat takes 12.3 s instead of 11.0 s" for another acceleration.
std::string cycle_words(const CheckedMotion& motion, double percent) {
  pipeline::Setup changed = motion.setup;
  changed.motion.acceleration_percent = percent;
  return fmt::format("a repeat takes {:.1f} s instead of {:.1f} s", path_of(changed)->program_duration(),
                     motion.path->program_duration());
}

/// Returns a slower program that keeps the limit, with the longer repeat; empty: none was found. first: acceleration to try first [%].
Remedy slower(const CheckedMotion& motion, const std::vector<Check>& checks, const Check& broken, double first) {
  constexpr int most = 3;
  constexpr double less = 0.8;  // ratio to the previous acceleration
  double next = std::floor(first);
  for (int k = 0; k < most && next >= 1; ++k, next = std::floor(less * next)) {
    pipeline::Setup changed = motion.setup;
    changed.motion.acceleration_percent = next;
    if (!cures(motion, changed, {*broken.kind}, broken.dresspack, checks)) continue;
    return {{{"motion.acceleration_percent", fmt::format("{:.0f}", next)}},
            fmt::format(" (now {:.0f}; tried in a short run; {})", motion.setup.motion.acceleration_percent,
                        cycle_words(motion, next)),
            fmt::format("other clamps for the present program {}; or a slower program, ", by_route)};
  }
  return {};
}

Cure bend_cure(const CheckedMotion& motion, const std::vector<Check>& checks, const Check& broken) {
  const std::string warmth = warmth_words(motion.setup);
  const std::string remark = (motion.rod ? relief_remark(motion, broken) : "") + limit_remark(motion, broken) +
                             (!motion.rod || warmth.empty() ? "" : "; check " + warmth);
  if (!motion.rod)
    return {"the prescribed deformation bends it so",
            {{}, "a larger radius in motion.rig or motion.deformation" + remark}};
  const pipeline::Routing& routing = mounted_of(motion, broken).routing;
  if (!can_be_tried(motion, broken.dresspack))
    return {!routing.rings.empty()
                ? "it turns around the edge of a guide ring, or its length and its clamps do not suit the motion"
                : "its length and its clamps do not suit the motion",
            {{},
             fmt::format("the {} that `dresslife improve` finds{}",
                         !routing.rings.empty() ? "routing.rings" : "lengths and clamps", remark)}};
  const RestTrials trials(motion, broken);
  const double k_rest = trials.curvature(trials.length());
  const bool at_rest = k_rest * broken.limit >= 1, swings = !at_rest && broken.name == check_name::bend_radius;
  RemedySearch search(motion, checks, trials, broken.dresspack);
  Remedy remedy = search.remedy();
  std::string cause;
  if (std::isinf(k_rest)) {
    cause = "its length and its clamps do not suit the motion; no shape at rest was found for the clamps as they are";
  } else if (at_rest) {
    const bool turns =
        std::ranges::any_of(remedy.values, [](const pipeline::KeyValue& of) { return of.key.ends_with(".direction"); });
    cause = remedy.empty() ? "distance and direction of the clamps"
            : turns        ? "directions of the clamps"
                           : "the free length";
    // The warning of the check at rest already contains its own radius, with more segments and with twist.
    if (broken.name == check_name::bend_radius)
      cause += fmt::format(" (already at rest and without the robot its bend radius is {} over the program)",
                           radius_words(k_rest));
  } else if (swings) {
    const Check* touch = find(checks, check_name::contact_force, broken.dresspack);
    const bool pressed = touch && touch->value > 0 && std::abs(touch->time - broken.time) < 0.2;
    cause = fmt::format("a swing{}: at rest and free of twist the smallest bend radius over the program is {}",
                        pressed ? " or a contact" : " or its winding around the robot", radius_words(k_rest));
  } else {
    cause =
        fmt::format("the shape into which the program leads it: free of twist its smallest bend radius at rest is {}",
                    radius_words(k_rest));
  }
  // a clamp that points away from the other one, and would keep the limit in the opposite direction
  for (const int end : {0, 1}) {
    if (!at_rest || !remedy.empty() || trials.chord_direction(end).z() >= 0) continue;
    const double reversed = trials.curvature(trials.length(), {}, end, 1 / broken.limit);
    if (reversed * broken.limit > 1) continue;
    const std::string key = fmt::format("routing.{}_clamp", end == 0 ? "base" : "tool");
    cause = fmt::format("a wrong sign: {}.direction points away from the other clamp", key);
    const Vector3 direction = Vector3::Zero() - (end == 0 ? routing.base_clamp : routing.tool_clamp)->direction;
    remedy = {{{key_of(motion.setup, broken.dresspack, key + ".direction"), vector_words(direction)}},
              fmt::format(" if so (bend radius at rest {})", radius_words(reversed))};
  }
  if (remedy.empty()) remedy = search.elsewhere();
  if (remedy.empty() && swings)
    remedy =
        slower(motion, checks, broken,
               motion.setup.motion.acceleration_percent * (1 / broken.limit - k_rest) / (1 / broken.value - k_rest));
  if (remedy.empty()) {
    double least = broken.value;  // a limit that both the checks at rest and the short run would keep
    for (const Check& check : checks)
      if (check.kind == WarningKind::bend_radius && check.dresspack == broken.dresspack)
        least = std::min(least, check.value);
    remedy.words = no_other_words(motion, search.best_words(least));
    if (least >= pipeline::tightest_bend_radius(mounted_of(motion, broken).dresspack))
      remedy.words += fmt::format("; or {}: {:.0f} if the maker allows it",
                                  key_of(motion.setup, broken.dresspack, "dresspack.least_bend_radius_mm"),
                                  std::floor(1e3 * least));
  }
  remedy.words += remark;
  return {cause, remedy};
}

/// Returns L of the span with the least slack.
double free_length_of(const CheckedMotion& motion, const Check& check) {
  const int span = check.position < 0 ? motion.rod->first_span(check.dresspack) : span_at(*motion.rod, check);
  return motion.rod->spans()[static_cast<std::size_t>(span)].properties.length;
}

/// Returns the cure of a net twist: a pre-twist moves its centre to zero, and a longer hose distributes the remaining twist.
Cure twist_cure(const CheckedMotion& motion, const std::vector<Check>& checks, const Check& broken) {
  if (!motion.rod)
    return {"the prescribed deformation twists it so", {{}, "less twist in motion.rig or motion.deformation"}};
  const Check* net = find(checks, check_name::net_twist, broken.dresspack);
  const pipeline::Routing& routing = mounted_of(motion, broken).routing;
  const double most = net ? std::abs(net->value) : 0, centre = net ? net->centre : 0;
  const double half_range = most - std::abs(centre), length = routing.free_length;
  const std::string cause = fmt::format("the clamps turn it by {:.0f} deg, {:.0f} to either side of {:.0f}",
                                        most / degree, half_range / degree, centre / degree);
  // Bend limits that are already exceeded have their own warning.
  const auto keeps = [&](double free_length, double pre_twist) {
    pipeline::Setup changed = motion.setup;
    pipeline::Routing& to = changed.dresspacks[static_cast<std::size_t>(broken.dresspack)].routing;
    to.free_length = free_length;
    to.pre_twist = pre_twist;
    return cures(motion, changed, {WarningKind::twist}, broken.dresspack, checks);
  };
  const std::string other_link = "the tool clamp on a link that turns less";
  if (half_range < broken.limit * length && std::abs(centre) > 0.02 * most &&
      keeps(length, std::round((routing.pre_twist - centre) / degree) * degree))
    return {cause,
            {{{key_of(motion.setup, broken.dresspack, "routing.pre_twist_deg"),
               fmt::format("{:.0f}", (routing.pre_twist - centre) / degree)}}}};
  const double needed = std::max(half_range / broken.limit, length * std::abs(broken.value) / broken.limit);
  // At most the length that the check of slack allows, because a longer hose would hang into the robot.
  const Check* slack = find(checks, check_name::too_short, broken.dresspack);
  const double span = slack ? free_length_of(motion, *slack) : length;
  const double most_longer = slack ? working_length(span - slack->value).most / span : 1;
  if (needed > most_longer * length || !keeps(std::ceil(1e3 * needed) / 1e3, routing.pre_twist))
    return {cause, {{}, other_link}};
  return {cause,
          {{{key_of(motion.setup, broken.dresspack, "routing.free_length_m"), at_least_metres(needed)}},
           fmt::format(" (now {:.3f}; tried in a short run), or {}", length, other_link)}};
}

/// Returns the remedy of a span whose length is not `wanted` [m].
Remedy other_length(const CheckedMotion& motion, const Check& check, double wanted) {
  if (check.position < 0)
    return {{{key_of(motion.setup, check.dresspack, "routing.free_length_m"), fmt::format("{:.3f}", wanted)}}};
  const auto piece = static_cast<std::size_t>(span_at(*motion.rod, check) - motion.rod->first_span(check.dresspack));
  return {{},
          fmt::format("length{} ({}): {:.3f}", pipeline::between_clamps(mounted_of(motion, check).routing, piece),
                      key_of(motion.setup, check.dresspack, "routing.clamps.at_length_m"), wanted)};
}

Cure slack_cure(const CheckedMotion& motion, const std::vector<Check>& checks, const Check& broken) {
  const double length = free_length_of(motion, broken), way = length - broken.value;
  const WorkingLength range = working_length(way);
  const bool short_one = broken.name == check_name::too_short;
  const std::string cause =
      fmt::format("the clamps are {:.3f} m apart, which asks for {:.3f} .. {:.3f} m of hose; it has {:.3f} m", way,
                  range.least, range.most, length);
  const double wanted = short_one ? std::ceil(1e3 * range.least) / 1e3 : std::floor(1e3 * range.most) / 1e3;
  Remedy alone = other_length(motion, broken, wanted);
  // Another unit has its own warning, so nothing is tried.
  if (length > pipeline::longest_hose && !short_one) {
    for (const double meant : {length / 1e2, length / 1e3})  // centimetres, millimetres
      if (meant >= range.least && meant <= range.most) return {cause, other_length(motion, broken, meant)};
    alone.words += fmt::format(" or less, {:.3f} or more, between these clamps", range.least);
    return {cause, alone};
  }
  if (!can_be_tried(motion, broken.dresspack)) return {cause, alone};
  const RestTrials trials(motion, broken);
  RemedySearch search(motion, checks, trials, broken.dresspack);
  Remedy remedy = search.remedy();
  if (remedy.empty()) remedy = search.elsewhere();
  if (!remedy.empty()) return {cause, remedy};
  alone.words += " for the slack alone; " + no_other_words(motion, " of the bend radius");
  return {cause, alone};
}

Cure tension_cure(const CheckedMotion& motion, const std::vector<Check>& checks, const Check& broken) {
  if (!motion.rod) return {"the prescribed elongation", {{}, "less of it in motion.rig or motion.deformation"}};
  const Check* slack = find(checks, check_name::too_short, broken.dresspack);
  if (slack && slack->warning) {
    const Cure longer = slack_cure(motion, checks, *slack);
    return {"it is pulled tight: " + longer.cause, longer.remedy};
  }
  Remedy remedy;
  if (can_be_tried(motion, broken.dresspack)) {
    const RestTrials trials(motion, broken);
    RemedySearch search(motion, checks, trials, broken.dresspack,
                        {WarningKind::tension, WarningKind::bend_radius, WarningKind::slack});
    remedy = search.remedy();
    if (remedy.empty()) remedy = search.elsewhere();
  }
  if (remedy.empty())
    remedy = slower(motion, checks, broken, motion.setup.motion.acceleration_percent * broken.limit / broken.value);
  if (remedy.empty())
    remedy.words =
        fmt::format("other clamps {}: no length, direction or slower program that was tried keeps the limit", by_route);
  remedy.words +=
      fmt::format("; or {}: {:.0f} if the maker allows it",
                  key_of(motion.setup, broken.dresspack, "dresspack.most_tension_N"), std::ceil(broken.value));
  return {"its weight and the acceleration of the program", remedy};
}

Cure travel_cure(const CheckedMotion& motion, const Check& broken) {
  return {
      "the retraction unit is pulled out to its end",
      {{{key_of(motion.setup, broken.dresspack, "routing.retraction.stroke_m"), at_least_metres(1.1 * broken.limit)}},
       fmt::format(" or more, or {} longer by as much as it is pulled beyond",
                   key_of(motion.setup, broken.dresspack, "routing.free_length_m"))}};
}

std::string place_words(const CheckedMotion& motion, const Check& check) {
  if (check.position < 0) return "";
  const double length = pipeline::free_lengths(motion.setup)[static_cast<std::size_t>(check.dresspack)];
  return fmt::format(", {:.2f} m from the base clamp ({:.2f} m from the tool clamp),", check.position,
                     length - check.position);
}

std::string hand_words(const Check& check) {
  return check.kind == WarningKind::twist ? (check.value > 0 ? ", right-hand" : ", left-hand") : "";
}

/// Returns a remedy for a dresspack that cannot be clamped or is pulled tight at this time. untried: remedy if no routing can be
/// tried.
Remedy remedy_for(const CheckedMotion& motion, int dresspack, double time, const std::string& untried) {
  if (!can_be_tried(motion, dresspack)) return {{}, untried};
  Check refused;
  refused.time = time;
  refused.dresspack = dresspack;
  const RestTrials trials(motion, refused);
  const std::vector<Check> none;
  if (trials.length() > pipeline::longest_hose) {
    refused.value = trials.length() - trials.longest();
    return slack_cure(motion, none, refused).remedy;
  }
  RemedySearch search(motion, none, trials, dresspack);
  Remedy remedy = search.remedy();
  if (remedy.empty()) remedy = search.elsewhere();
  return remedy.empty() ? Remedy{{}, untried + "; " + no_other_words(motion, "s")} : remedy;
}

}  // namespace

Cure cure_of(const CheckedMotion& motion, const std::vector<Check>& checks, const Check& broken) {
  if (broken.kind == WarningKind::bend_radius) return bend_cure(motion, checks, broken);
  if (broken.kind == WarningKind::twist) return twist_cure(motion, checks, broken);
  if (broken.kind == WarningKind::tension) return tension_cure(motion, checks, broken);
  return broken.name == check_name::travel ? travel_cure(motion, broken) : slack_cure(motion, checks, broken);
}

std::string obstacle_words(const pipeline::Setup& setup) {
  const pipeline::Cell cell = surroundings(setup);
  return cell.capsules.empty() && cell.boxes.empty() && cell.meshes.empty() ? "the robot"
                                                                            : "the robot or an obstacle of the cell";
}

pipeline::Warning taut_warning(const CheckedMotion& motion, const ShortRun& run) {
  return pipeline::warning_of(WarningKind::slack, "", run.refusal,
                              fmt::format("it lies on {}, around which its way is longer than from clamp to clamp",
                                          obstacle_words(motion.setup)),
                              remedy_for(motion, run.dresspack, *run.taut_at,
                                         "give it more free length, or move a clamp (dresslife preview shows it)"));
}

std::string refusal_remedy(const pipeline::Setup& setup, const RoutingRefusal& refusal) {
  const Rod rod = rod_of(setup);
  const std::unique_ptr<ClampPath> path = path_of(setup);
  const pipeline::Routing& routing = setup.dresspacks[static_cast<std::size_t>(refusal.dresspack)].routing;
  if (pipeline::clamps_exchanged(routing, setup.robot))
    return fmt::format(
        "exchange base_clamp and tool_clamp; or, if only their links are exchanged, routing.base_clamp.link: {} and "
        "routing.tool_clamp.link: {}",
        routing.tool_clamp->link, routing.base_clamp->link);
  if (const auto* robot = dynamic_cast<const RobotPath*>(path.get()); robot && robot->clamps_in_world())
    return "give the places of the clamps in the frames of their links (dresslife check computes them)";
  return remedy_for({setup, {}, &rod, path.get()}, refusal.dresspack, refusal.time.value_or(0), refusal.remedy).text();
}

std::string check_words(const CheckedMotion& motion, const Check& check) {
  const std::string name = pipeline::name_among(motion.setup, static_cast<std::size_t>(check.dresspack));
  return fmt::format("{}{}{}: {} (limit {}{}){} {}", name, name.empty() ? "" : ", ", check.name,
                     in_words(check.value, check.unit), in_words(check.limit, check.unit), hand_words(check),
                     place_words(motion, check), motion.moment(check.time));
}

/// Warns of segments that are too long beside a pulled clamp. From a clamp, the bend of a hose decays over d = sqrt(E I/T). With
/// segments of h d, the chain misses h^2/24 of the bend at the clamp, and the parabola that gives its value there (W39)
/// 13/28 (1 - exp(-h))^3 (strain/measurements.md). That is 13 % at h = 0.9, where lives that go with the fifth power of strain are
/// twice too long, and 2 % at 0.37, where they are a tenth too long.
std::optional<pipeline::Warning> mesh_warning(const CheckedMotion& motion, const Check& pull) {
  constexpr double coarse = 0.9, fine = 0.37;
  const pipeline::MountedDresspack& mounted = mounted_of(motion, pull);
  const std::string name = pipeline::name_among(motion.setup, static_cast<std::size_t>(pull.dresspack));
  const int segments = motion.setup.simulation.segments;
  const double length = mounted.routing.free_length / segments;
  const double decay = pull.value > 0 ? std::sqrt(mounted.dresspack.bending_stiffness / pull.value) : infinite;
  if (length <= coarse * decay) return {};
  return pipeline::warning_of(
      WarningKind::mesh, "",
      fmt::format(
          "simulation.segments is {}: a segment{} is {:.0f} mm long (limit {:.0f} mm: {:g} of the length over which a bend decays from "
          "a clamp under the largest pull, {:.0f} N {}), so that strains at the clamps are at least 13 % too small and lives there about "
          "twice too long or longer",
          segments, name.empty() ? "" : " of " + name, 1e3 * length, 1e3 * coarse * decay, coarse, pull.value,
          motion.moment(pull.time)),
      "a coarse mesh, or a bending stiffness that is too small",
      {{{"simulation.segments", fmt::format("{:.0f}", std::ceil(mounted.routing.free_length / (fine * decay)))}},
       ": lives within a tenth"});
}

/// Warns of a smallest bend radius at a clamp that depends on the segments. A resolved bend goes nearly straight on from the next two
/// links. A bend that decays as exp(-s/d) exceeds this line by half with segments of 0.87 d, as in mesh_warning(). A contact beside
/// a clamp bends the hose over about one diameter, where contact with the clamp's link begins: half a diameter gave a radius of
/// 12.3 mm, a quarter 11.7 mm, and two diameters 41.6 mm (cable of 9.8 mm). So the radius is at most about four times too large.
std::optional<pipeline::Warning> clamp_mesh_warning(const CheckedMotion& motion, const Check& bend) {
  constexpr double above_line = 1.5, too_large = 4;
  if (!bend.line || bend.value * *bend.line * above_line >= 1 || bend.value > too_large * bend.limit) return {};
  const pipeline::MountedDresspack& mounted = mounted_of(motion, bend);
  const double length = std::min(bend.segment, mounted.dresspack.diameter) / 2;
  const double needed = std::ceil(mounted.routing.free_length / length);
  if (needed <= motion.setup.simulation.segments) return {};  // a short run has fewer segments than the job
  const std::string name = pipeline::name_among(motion.setup, static_cast<std::size_t>(bend.dresspack));
  return pipeline::warning_of(
      WarningKind::mesh, "",
      fmt::format(
          "the segments{} are {:.0f} mm long, and the smallest bend radius, {}{} is {:.2g} times as sharp as the bend of the "
          "next segments leads to (limit {:g}): the radius that is computed may be up to {:g} times too large",
          name.empty() ? "" : " of " + name, 1e3 * bend.segment, in_words(bend.value, bend.unit),
          place_words(motion, bend), 1 / (bend.value * std::max(*bend.line, 0.1 / bend.value)), above_line, too_large),
      "a contact or a pull that bends the dresspack within one segment of the clamp",
      {{{"simulation.segments", fmt::format("{:.0f}", needed)}},
       "; or a clamp or direction that keeps the dresspack off the link of its clamp"});
}

std::vector<pipeline::Warning> check_warnings(const CheckedMotion& motion, const std::vector<Check>& checks) {
  std::vector<pipeline::Warning> warnings;
  for (const Check& check : checks) {
    if (motion.rod && check.name == check_name::tension)
      if (std::optional<pipeline::Warning> mesh = mesh_warning(motion, check)) warnings.push_back(*std::move(mesh));
    const auto pulled = [&](const Check& other) {  // which states the larger number
      return other.name == check_name::tension && other.dresspack == check.dresspack && mesh_warning(motion, other);
    };
    if (motion.rod && check.name == check_name::bend_radius && std::ranges::none_of(checks, pulled))
      if (std::optional<pipeline::Warning> mesh = clamp_mesh_warning(motion, check))
        warnings.push_back(*std::move(mesh));
    if (!check.warning) continue;
    const Cure cure = cure_of(motion, checks, check);
    warnings.push_back(pipeline::warning_of(*check.kind, "", check_words(motion, check), cure.cause, cure.remedy));
  }
  return warnings;
}

double curvature_at_rest(RodProperties span, const ClampFrames& clamps) {
  span.tool_end = End::swivel;
  const Rod rod(span);
  EquilibriumSettings settings;
  settings.iterations = 400;  // a stiff hose takes 20 iterations, the shipped soft one 70 to 220
  settings.tolerance = 1e-4;  // of the forces: accurate enough for a picture
  const Equilibrium found = find_equilibrium(rod, clamps, settings);
  if (found.status != EquilibriumStatus::converged) return infinite;
  double curvature = 1e-9;
  for (int j = 0; j < rod.links(); ++j)
    curvature = std::max(curvature, rod.curvature(rod.link_state(found.state, j).turn, j));
  return curvature;
}

}  // namespace dresslife::sim
