#include "sim/run/cures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "pipeline/base/warning_words.h"
#include "pipeline/files/check_names.h"
#include "pipeline/job/line_key.h"
#include "sim/run/equilibrium.h"
#include "sim/run/routing.h"

namespace dresslife::sim {
namespace {

namespace check_name = pipeline::check_name;
using pipeline::WarningKind;

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double degree = EIGEN_PI / 180;
constexpr int tried_lengths = 8, tried_poses = 8;  // 256 equilibria with four pairs of directions: a second
constexpr double margin = 1.05;  // of a limit at rest: a program at work adds to it
constexpr int most_segments = 32;  // of a trial: a bend radius within a few percent

std::string in_words(double value, const std::string& unit) {
  if (unit == "m") return fmt::format("{:.1f} mm", 1e3 * value);
  if (unit == "rad/m") return fmt::format("{:.4g} deg/m", value / degree);
  return fmt::format("{:.3g} {}", value, unit);
}

/// Upward and downward to millimetres, as words in metres.
std::string at_least_metres(double value) { return fmt::format("{:.3f}", std::ceil(1e3 * value) / 1e3); }
std::string at_most_metres(double value) { return fmt::format("{:.3f}", std::floor(1e3 * value) / 1e3); }

std::string key_of(const pipeline::Setup& setup, int dresspack, const std::string& key) {
  return pipeline::line_key(setup, static_cast<std::size_t>(dresspack), key);
}

const pipeline::MountedDresspack& mounted_of(const CheckedMotion& motion, const Check& check) {
  return motion.setup.dresspacks[static_cast<std::size_t>(check.dresspack)];
}

const Check* find(const std::vector<Check>& checks, std::string_view name, int dresspack) {
  const auto found = std::find_if(checks.begin(), checks.end(), [&](const Check& check) {
    return check.name == name && check.dresspack == dresspack;
  });
  return found == checks.end() ? nullptr : &*found;
}

/// Of a dresspack's spans that in which a place lies.
int span_at(const Rod& rod, const Check& check) {
  const int first = rod.first_span(check.dresspack), end = rod.first_span(check.dresspack + 1);
  for (int span = end - 1; span > first; --span)
    if (rod.spans()[span].first_arc <= check.position) return span;
  return first;
}

std::string vector_words(const Vector3& v) { return fmt::format("[{:.2f}, {:.2f}, {:.2f}]", v.x(), v.y(), v.z()); }

/// A span at rest in some poses of its program, with other lengths and directions of its clamps.
class RestTrials {
 public:
  RestTrials(const CheckedMotion& motion, const Check& broken) : span_(span_at(*motion.rod, broken)) {
    properties_ = motion.rod->spans()[static_cast<std::size_t>(span_)].properties;
    const double duration = motion.path->duration();
    std::vector<double> times{broken.time};
    for (int k = 0; k < tried_poses - 1; ++k) times.push_back(duration * k / (tried_poses - 1));
    double longest_time = 0;
    for (int k = 0; k <= 1000; ++k)
      if (const double way = way_at(motion, duration * k / 1000); way > longest_) longest_ = way, longest_time = duration * k / 1000;
    times.push_back(longest_time);
    for (const double time : times) {
      const Pose pose = motion.path->at(time);
      poses_.push_back({pose.clamps.end(2 * span_), pose.clamps.end(2 * span_ + 1)});
    }
    for (int end = 0; end < 2; ++end) chord_turn_[end] = mean_turn_to_chord(end);
  }

  double longest() const { return longest_; }
  /// turned: (end) whether that clamp points along the mean of its chords.
  double curvature(double length, const std::array<bool, 2>& turned = {}) const {
    RodProperties of = properties_;
    of.segments = std::min(of.segments, most_segments);
    of.length = length;
    double most = 0;
    for (ClampFrames clamps : poses_) {
      for (int end = 0; end < 2; ++end)
        if (turned[end]) clamps.end(end).orientation = clamps.end(end).orientation * chord_turn_[end];
      most = std::max(most, curvature_at_rest(of, clamps));
    }
    return most;
  }
  /// Of a clamp that points along the mean of its chords, in its own frame as it is now.
  Vector3 chord_direction(int end) const { return chord_turn_[end] * Vector3::UnitZ(); }
  double length() const { return properties_.length; }
  int span() const { return span_; }

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

/// "tool_clamp.direction: [0.1, 0.2, 0.97]"
std::string direction_words(const CheckedMotion& motion, const Check& broken, const RestTrials& trials, int end) {
  const pipeline::Routing& routing = mounted_of(motion, broken).routing;
  const std::optional<pipeline::Clamp>& clamp = end == 0 ? routing.base_clamp : routing.tool_clamp;
  const Vector3 direction = clamp_frame(*clamp).orientation * trials.chord_direction(end);
  return key_of(motion.setup, broken.dresspack,
                fmt::format("routing.{}.direction: {}", end == 0 ? "base_clamp" : "tool_clamp", vector_words(direction)));
}

std::string radius_words(double curvature) { return in_words(1 / curvature, "m"); }

struct Trial {
  double length = 0, curvature = infinite;
  std::array<bool, 2> turned{};
};

/// The first that keeps the limit with a margin, else the least bent of all: lengths with the clamps as they are, then
/// with one or both of them turned.
Trial best_trial(const RestTrials& trials, double limit, bool may_turn) {
  const WorkingLength range = working_length(trials.longest());
  Trial best;
  constexpr std::array<std::array<bool, 2>, 4> turns{{{false, false}, {false, true}, {true, false}, {true, true}}};
  for (const auto& turned : turns) {
    if ((turned[0] || turned[1]) && !may_turn) break;
    for (int k = 0; k < tried_lengths; ++k) {
      const double length =
          range.least * std::pow(range.most / range.least, static_cast<double>(k) / (tried_lengths - 1));
      const double curvature = trials.curvature(length, turned);
      if (curvature < best.curvature) best = {length, curvature, turned};
    }
    if (best.curvature * limit * margin <= 1) return best;
  }
  return best;
}

std::string limit_remark(const CheckedMotion& motion, const Check& broken) {
  const pipeline::Dresspack& dresspack = mounted_of(motion, broken).dresspack;
  if (dresspack.least_bend_radius) return "";
  return fmt::format("; {} is not given, so that ten diameters{} count: give the maker's",
                     key_of(motion.setup, broken.dresspack, "dresspack.least_bend_radius_mm"),
                     dresspack.hose_corrugation && !dresspack.components.empty() ? " of the parts in the hose" : "");
}

Cure bend_cure(const CheckedMotion& motion, const std::vector<Check>& checks, const Check& broken) {
  const std::string remark = limit_remark(motion, broken);
  if (!motion.rod)
    return {"the prescribed deformation bends it so", "a larger radius in motion.rig or motion.deformation" + remark};
  const int span = span_at(*motion.rod, broken);
  const RodProperties& p = motion.rod->spans()[static_cast<std::size_t>(span)].properties;
  const std::vector<RoutedRing> rings = routed_rings(motion.setup);
  const bool ringed =
      std::any_of(rings.begin(), rings.end(), [&](const RoutedRing& ring) { return ring.span == span; });
  const pipeline::Routing& routing = mounted_of(motion, broken).routing;
  if (p.tool_end == End::free || ringed || p.slider)
    return {ringed ? "it turns around the edge of a guide ring" : "its length and its clamps do not suit the motion",
            fmt::format("{}: as `dresslife improve` finds it{}",
                        key_of(motion.setup, broken.dresspack, ringed ? "routing.rings" : "routing.free_length_m"), remark)};
  const RestTrials trials(motion, broken);
  const double limit = broken.limit, k_rest = trials.curvature(trials.length()), k = 1 / broken.value;
  if (std::isinf(k_rest))
    return {"its length and its clamps do not suit the motion; no shape at rest was found for the clamps as they are",
            "the clamps or the length that `dresslife improve` finds" + remark};
  if (k_rest * limit < 1 && broken.name == check_name::bend_radius_at_rest) {
    const Check* net = find(checks, check_name::net_twist, broken.dresspack);
    const double centre = net ? net->centre : 0;
    constexpr double little = 10 * degree;  // a pre-twist below it changes no shape that a user sees
    return {fmt::format("the shape into which the program leads it: free of twist its smallest bend radius at rest is {}",
                        radius_words(k_rest)),
            (std::abs(centre) > little ? fmt::format("{}: {:.0f}, or ", key_of(motion.setup, broken.dresspack, "routing.pre_twist_deg"),
                                                     (routing.pre_twist - centre) / degree)
                                       : std::string()) +
                "the clamps or the length that `dresslife improve` finds" + remark};
  }
  if (k_rest * limit < 1) {
    const Check* touch = find(checks, check_name::contact_force, broken.dresspack);
    const bool pressed = touch && touch->value > 0 && std::abs(touch->time - broken.time) < 0.2;
    const double percent = motion.setup.motion.acceleration_percent;
    return {fmt::format("a swing{}: at rest the smallest bend radius over the program is {}",
                        pressed ? " or a contact" : "", radius_words(k_rest)),
            fmt::format("motion.acceleration_percent: {:.0f} (now {:.0f})",
                        std::max(1.0, std::floor(percent * (1 / limit - k_rest) / (k - k_rest))), percent) +
                remark};
  }
  const bool one_span = motion.rod->first_span(broken.dresspack + 1) == motion.rod->first_span(broken.dresspack) + 1;
  const bool may_turn = one_span && routing.base_clamp && routing.tool_clamp;
  const Trial best = best_trial(trials, limit, may_turn);
  const bool turned = best.turned[0] || best.turned[1];
  const std::string length =
      one_span ? fmt::format("{}: {:.3f}", key_of(motion.setup, broken.dresspack, "routing.free_length_m"), best.length)
               : fmt::format("{:.3f} m between these two clamps", best.length);
  const std::string now = fmt::format("already at rest {} over the program", radius_words(k_rest));
  if (best.curvature * limit > 1)
    return {fmt::format("distance and direction of the clamps ({})", now),
            fmt::format("{}: {:.0f} if the maker allows it; no length and no direction of these two clamps keeps the limit "
                        "at rest (best: {} m, {}), so that a clamp must move: `dresslife improve` or `dresslife route`",
                        key_of(motion.setup, broken.dresspack, "dresspack.least_bend_radius_mm"),
                        std::floor(1e3 * broken.value), at_least_metres(best.length), radius_words(best.curvature)) +
                remark};
  std::string remedy = length;
  for (int end = 0; end < 2; ++end)
    if (best.turned[end]) remedy += " and " + direction_words(motion, broken, trials, end);
  return {fmt::format("{} ({})", turned ? "directions of the clamps" : "the free length", now),
          fmt::format("{} (at rest {}; `dresslife preview` shows whether it clears the robot)", remedy,
                      radius_words(best.curvature)) +
              remark};
}

/// L of a span with least slack.
double free_length_of(const CheckedMotion& motion, const Check& check) {
  const int span = check.position < 0 ? motion.rod->first_span(check.dresspack) : span_at(*motion.rod, check);
  return motion.rod->spans()[static_cast<std::size_t>(span)].properties.length;
}

/// Net twist lies about `centre`; a pre-twist takes that away, and a longer hose spreads the rest.
Cure twist_cure(const CheckedMotion& motion, const std::vector<Check>& checks, const Check& broken) {
  if (!motion.rod)
    return {"the prescribed deformation twists it so", "less twist in motion.rig or motion.deformation"};
  const Check* net = find(checks, check_name::net_twist, broken.dresspack);
  const pipeline::Routing& routing = mounted_of(motion, broken).routing;
  const double most = net ? std::abs(net->value) : 0, centre = net ? net->centre : 0;
  const double half_range = most - std::abs(centre), length = routing.free_length;
  const std::string cause = fmt::format("the clamps turn it by {:.0f} deg, {:.0f} to either side of {:.0f}", most / degree,
                                        half_range / degree, centre / degree);
  if (half_range < broken.limit * length && std::abs(centre) > 0.02 * most)
    return {cause, fmt::format("{}: {:.0f}", key_of(motion.setup, broken.dresspack, "routing.pre_twist_deg"),
                               (routing.pre_twist - centre) / degree)};
  const double needed = std::max(half_range / broken.limit, length * std::abs(broken.value) / broken.limit);
  // Not beyond the length that the check of slack allows: a longer hose hangs into the robot.
  const Check* slack = find(checks, check_name::too_short, broken.dresspack);
  const double span = slack ? free_length_of(motion, *slack) : length;
  const double most_longer = slack ? working_length(span - slack->value).most / span : 1;
  if (needed > most_longer * length) return {cause, "the tool clamp on a link that turns less"};
  return {cause, fmt::format("{}: {} or more (now {:.3f}), or the tool clamp on a link that turns less",
                             key_of(motion.setup, broken.dresspack, "routing.free_length_m"), at_least_metres(needed), length)};
}

std::string length_key(const CheckedMotion& motion, const Check& check) {
  if (check.position < 0) return key_of(motion.setup, check.dresspack, "routing.free_length_m");
  const int clamp = span_at(*motion.rod, check) - motion.rod->first_span(check.dresspack) + 1;
  return fmt::format("length between clamps {} and {} ({})", clamp, clamp + 1,
                     key_of(motion.setup, check.dresspack, "routing.clamps.at_length_m"));
}

Cure slack_cure(const CheckedMotion& motion, const Check& broken) {
  const double length = free_length_of(motion, broken), way = length - broken.value;
  const WorkingLength range = working_length(way);
  const bool short_one = broken.name == check_name::too_short;
  const std::string cause =
      fmt::format("the clamps are {:.3f} m apart, which asks for {:.3f} .. {:.3f} m of hose; it has {:.3f} m", way, range.least,
                  range.most, length);
  return {cause, fmt::format("{}: {}", length_key(motion, broken),
                             short_one ? at_least_metres(range.least) : at_most_metres(range.most))};
}

Cure tension_cure(const CheckedMotion& motion, const std::vector<Check>& checks, const Check& broken) {
  if (!motion.rod) return {"the prescribed elongation", "less of it in motion.rig or motion.deformation"};
  const Check* slack = find(checks, check_name::too_short, broken.dresspack);
  if (slack && slack->warning) {
    const Cure longer = slack_cure(motion, *slack);
    return {"it is drawn taut: " + longer.cause, longer.remedy};
  }
  const double percent = motion.setup.motion.acceleration_percent;
  return {"its weight and the acceleration of the program",
          fmt::format("motion.acceleration_percent: {:.0f} or less (now {:.0f}), or {}: {:.0f} if the maker allows it",
                      std::max(1.0, std::floor(percent * broken.limit / broken.value)), percent,
                      key_of(motion.setup, broken.dresspack, "dresspack.most_tension_N"), std::ceil(broken.value))};
}

Cure travel_cure(const CheckedMotion& motion, const Check& broken) {
  return {"the retraction unit is pulled out to its end",
          fmt::format("{}: {} or more, or {} longer by as much as it is pulled beyond",
                      key_of(motion.setup, broken.dresspack, "routing.retraction.stroke_m"),
                      at_least_metres(1.1 * broken.limit),
                      key_of(motion.setup, broken.dresspack, "routing.free_length_m"))};
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

}  // namespace

Cure cure_of(const CheckedMotion& motion, const std::vector<Check>& checks, const Check& broken) {
  if (broken.kind == WarningKind::bend_radius) return bend_cure(motion, checks, broken);
  if (broken.kind == WarningKind::twist) return twist_cure(motion, checks, broken);
  if (broken.kind == WarningKind::tension) return tension_cure(motion, checks, broken);
  return broken.name == check_name::travel ? travel_cure(motion, broken) : slack_cure(motion, broken);
}

std::vector<pipeline::Warning> check_warnings(const CheckedMotion& motion, const std::vector<Check>& checks) {
  std::vector<pipeline::Warning> warnings;
  for (const Check& check : checks) {
    if (!check.warning) continue;
    const std::string name = pipeline::name_among(motion.setup, static_cast<std::size_t>(check.dresspack));
    const Cure cure = cure_of(motion, checks, check);
    warnings.push_back(pipeline::warning_of(
        *check.kind, "",
        fmt::format("{}{}{}: {} (limit {}{}){} {}", name, name.empty() ? "" : ", ", check.name,
                    in_words(check.value, check.unit), in_words(check.limit, check.unit), hand_words(check),
                    place_words(motion, check), motion.moment(check.time)),
        cure.cause, cure.remedy));
  }
  return warnings;
}

double curvature_at_rest(RodProperties span, const ClampFrames& clamps) {
  span.tool_end = End::swivel;
  const Rod rod(span);
  EquilibriumSettings settings;
  settings.iterations = 400;  // a stiff hose takes 20, the shipped soft one 70 to 220
  settings.tolerance = 1e-4;  // of the forces: a picture's worth
  const Equilibrium found = find_equilibrium(rod, clamps, settings);
  if (found.status != EquilibriumStatus::converged) return infinite;
  double curvature = 1e-9;
  for (int j = 0; j < rod.links(); ++j)
    curvature = std::max(curvature, rod.curvature(rod.link_state(found.state, j).turn, j));
  return curvature;
}

}  // namespace dresslife::sim
