#include "fatigue/unvalidated.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <span>

#include "fatigue/corkscrew.h"
#include "fatigue/damage.h"
#include "fatigue/inspection.h"
#include "fatigue/life_distribution.h"
#include "fatigue/rated_cables.h"
#include "fatigue/response.h"
#include "fatigue/verdict.h"
#include "fatigue/wear.h"
#include "pipeline/base/readable.h"
#include "pipeline/base/statistics.h"
#include "pipeline/base/warning_words.h"
#include "pipeline/cable/kink.h"
#include "pipeline/cable/warmth.h"
#include "pipeline/files/motion_layout.h"
#include "pipeline/job/job.h"
#include "pipeline/life/first_failure.h"

namespace dresslife::fatigue {
namespace {

/// Returns "signal cable 3" for one of several equal cables, "power cable" for a single one. path: of a cable in the job.
std::string cable_in_words(const pipeline::Job& job, const std::string& path) {
  return path_in_job(job, path_in_words(job, path)).inside;
}

using pipeline::FileReader;
using pipeline::LifeResponse;
using pipeline::UnvalidatedMode;

constexpr const char *table_of_work = "/rubbing/work", *work_of_jackets = "/jacket/work";

/// Throws InputError for invalid patches. group: of the file, "/rubbing".
class PatchCheck {
 public:
  PatchCheck(const FileReader& strain, std::string group, std::span<const double> place)
      : strain_(strain), group_(std::move(group)), place_(place) {}

  [[noreturn]] void refuse(const std::string& what) const {
    throw pipeline::InputError(strain_.where(), group_ + ": " + what, "make the file again with dresslife-strain");
  }
  /// Checks one patch. owner: number of its dresspack or cable in the file; owners: how many the file has.
  void see(std::size_t row, std::int32_t owner, std::size_t owners, double work) {
    const double* const p = place_.data() + 4 * row;
    const auto is_length = [](double value, double longest) { return value > 0 && value <= longest; };
    if (owner < 0 || static_cast<std::size_t>(owner) >= owners || !(work >= 0) || !is_length(p[0], most) ||
        !is_length(p[1], most) || !(p[2] >= 0 && p[2] <= turn) || !is_length(p[3], turn) || p[3] != place_[3])
      refuse(fmt::format("row {} is no patch of a dresspack", row + 1));
    shortest_ = std::min(shortest_, p[1]), end_ = std::max(end_, p[0] + p[1]);
  }
  void finish() const {
    constexpr double most_patches = 5e7;  // 0.4 GB
    if (!place_.empty() && end_ / shortest_ * turn / place_[3] > most_patches)
      refuse("its patches are too small to hold");
  }

 private:
  static constexpr double turn = 2 * std::numbers::pi, most = 1e3;  // most: largest length of a dresspack [m]
  const FileReader& strain_;
  std::string group_;
  std::span<const double> place_;
  double shortest_ = most, end_ = 0;
};

/// Returns the patches of each dresspack, (dresspack).
std::vector<std::vector<RubbedPatch>> patches_of(const FileReader& strain, std::size_t dresspacks) {
  const auto dresspack = strain.read<std::int32_t>("/rubbing/dresspack");
  const auto place = strain.read<double>("/rubbing/place"), work = strain.read<double>(table_of_work),
             time = strain.read<double>("/rubbing/time");
  const auto obstacle = strain.read<std::string>("/rubbing/obstacle");
  std::vector<std::vector<RubbedPatch>> patches(dresspacks);
  PatchCheck check(strain, "/rubbing", place);
  for (std::size_t k = 0; k < work.size(); ++k) {
    const double* const p = &place[4 * k];
    check.see(k, dresspack[k], dresspacks, work[k]);
    patches[static_cast<std::size_t>(dresspack[k])].push_back({p[0], p[1], p[2], p[3], obstacle[k], work[k], time[k]});
  }
  check.finish();
  return patches;
}

/// Returns the patches of each jacket, (rest, cable of the file). rests: number of rests of the loose cables.
std::vector<std::vector<std::vector<RubbedPatch>>> patches_of_jackets(const FileReader& strain, std::size_t rests,
                                                                      std::size_t cables,
                                                                      const std::vector<double>& time) {
  const auto cable = strain.read<std::int32_t>("/jacket/cable");
  const auto place = strain.read<double>("/jacket/place"), work = strain.read<double>(work_of_jackets);
  const auto sample = strain.read<std::uint32_t>("/jacket/sample");
  const auto rest = strain.read<std::int32_t>("/jacket/rest");
  std::vector patches(rests, std::vector<std::vector<RubbedPatch>>(cables));
  PatchCheck check(strain, "/jacket", place);
  for (std::size_t k = 0; k < work.size(); ++k) {
    const double* const p = &place[4 * k];
    check.see(k, cable[k], cables, work[k]);
    if (sample[k] >= time.size()) check.refuse(fmt::format("row {} is of no sample", k + 1));
    if (rest[k] < 0 || static_cast<std::size_t>(rest[k]) >= rests)
      check.refuse(fmt::format("row {} is of no rest of the cables", k + 1));
    patches[static_cast<std::size_t>(rest[k])][static_cast<std::size_t>(cable[k])].push_back(
        {p[0], p[1], p[2], p[3], std::string(word(pipeline::Counterface::hose)), work[k], time[sample[k]]});
  }
  check.finish();
  return patches;
}

/// Input of every mode, and the modes found so far.
struct Search {
  const FileReader& strain;
  const pipeline::Job& job;
  const std::vector<double>& lives;  ///< (sample) log10 repeats by the validated modes
  std::vector<double> time = strain.read<double>("/time");
  std::vector<std::int32_t> step = strain.read<std::int32_t>("/program/step");
  std::vector<std::string> text = strain.read<std::string>("/program/text");
  /// (rest of the loose cables) number of starts that came to it; empty: there is one rest.
  std::vector<std::size_t> starts = read_rests(strain);
  std::vector<UnvalidatedMode> modes = {};
  std::vector<std::string> left_out = {};  ///< modes of some dresspack that are not evaluated
  std::vector<pipeline::Warning> warnings = {};

  UnvalidatedMode& add(const char* mode, std::size_t dresspack) {
    UnvalidatedMode& added = modes.emplace_back();
    added.mode = mode;
    added.dresspack = pipeline::name_among(job, dresspack);
    return added;
  }

  double repeat() const { return time.empty() ? 0 : time.back() - time.front(); }  ///< [s]
  std::vector<double> never() const {
    return std::vector<double>(lives.size(), std::numeric_limits<double>::infinity());
  }

  /// Returns lives over the samples of the validated modes. repeats: at each rest of the loose cables, the job's own first (W40);
  /// a mode that does not depend on the rest has one value. log10_spread: standard deviation of log10 of repeats, sampled
  /// independently of them. of: a part; modes with equal mode and part have the same samples of the spread.
  std::vector<double> own_lives(const UnvalidatedMode& mode, std::span<const double> repeats, double log10_spread,
                                const std::string& of = "") const {
    if (std::ranges::none_of(repeats, [](double at) { return std::isfinite(at); })) return never();
    LifeResponse response;
    response.mode = mode.mode + of;
    response.dresspack = mode.dresspack;
    response.knowledge = pipeline::prior_of(job.uncertainty);
    if (!job.uncertainty.enabled) response.knowledge.covariance.setZero();
    response.worst_life.clear();
    for (const double at : repeats) response.worst_life.push_back(std::min(std::log10(at), LifeResponse::undamaged));
    const double median = response.worst_life.front();
    response.bound = {median, median, median};
    response.planned.resize(1);
    for (std::size_t i = 0; i < percentiles.size(); ++i)
      response.planned[0][i] = median + pipeline::normal_quantile(percentiles[i]) * log10_spread;
    response.scatter_shared = 0;
    response.residual_spread = 0;  // the residual is that of the lives of wires
    if (repeats.size() > 1) {
      response.points.resize(repeats.size()), response.inside.resize(repeats.size(), pipeline::Inside::as_is);
      std::vector<VariedStrains> others(repeats.size() - 1);
      for (std::size_t rest = 1; rest < repeats.size(); ++rest) others[rest - 1].rest = rest;
      put_rests(response, others, starts);
    }
    return pipeline::first_failures({response}, "", lives.size());
  }

  void put_lives(UnvalidatedMode& mode, std::vector<double> own) const {
    set_lives(mode, std::move(own), lives, repeat());
  }

  /// Sets segments and distance from a place to the tool clamp, and the program line.
  void put_place(UnvalidatedMode& mode, std::size_t dresspack, double position, std::size_t sample) const {
    const auto length = strain.read<double>("/segment/length");
    const auto of = pipeline::dresspack_of_segments(strain);
    double whole = 0;
    for (std::size_t k = 0; k < length.size(); ++k)
      if (of[k] == dresspack && (whole += length[k]) > position) ++mode.segment_from_tool;
    mode.position_from_tool = std::max(0.0, whole - position);
    if (sample < step.size() && step[sample] >= 0) mode.step = text[static_cast<std::size_t>(step[sample])];
  }

  /// Sets the place of the worst patch.
  void put_worn_place(UnvalidatedMode& mode, std::size_t dresspack, const Abrasion& worn) const {
    if (std::isfinite(worn.repeats))
      put_place(mode, dresspack, worn.position,
                static_cast<std::size_t>(std::ranges::lower_bound(time, worn.time) - time.begin()));
  }
};

/// Returns the components of a dresspack and those of its core.
std::vector<const pipeline::Component*> parts_of(const pipeline::Dresspack& dresspack) {
  std::vector<const pipeline::Component*> parts;
  for (const auto* const of : {&dresspack.components, &dresspack.core_components})
    for (const pipeline::Component& part : *of) parts.push_back(&part);
  return parts;
}

bool is_rated(const pipeline::Component& part) { return part.plain && !part.ratings.empty(); }

/// Deformation of one dresspack. If wires are evaluated at the clamps, its outermost segments have the deformation there.
struct HoseMotion {
  std::vector<SegmentMotion> segments;
  std::vector<double> position;  ///< (segment) from the base clamp [m]

  HoseMotion(const FileReader& strain, std::size_t dresspack) {
    const auto curvature = strain.read<double>("/deformation/curvature"),
               twist = strain.read<double>("/deformation/twist"), length = strain.read<double>("/segment/length"),
               at = strain.read<double>("/segment/wires_at");
    const auto of = pipeline::dresspack_of_segments(strain);
    double end = 0;
    for (std::size_t k = 0; k < of.size(); ++k) {
      if (of[k] != dresspack) continue;
      SegmentMotion& segment = segments.emplace_back();
      for (std::size_t row = k; row < twist.size(); row += of.size()) {
        segment.curvature1.push_back(curvature[2 * row]), segment.curvature2.push_back(curvature[2 * row + 1]);
        segment.twist.push_back(twist[row]);
      }
      end += length[k];
      position.push_back(at[k]);
    }
    if (segments.size() < 3) return;
    constexpr double rounding = 1e-9;  // [m]
    if (position.front() < rounding) move_to_clamp(segments[0], segments[1]);
    if (end - position.back() < rounding) move_to_clamp(segments.back(), segments[segments.size() - 2]);
  }
  /// Extrapolates the curvature linearly from the centres of the two segments.
  static void move_to_clamp(SegmentMotion& nearest, const SegmentMotion& next) {
    for (std::size_t t = 0; t < nearest.twist.size(); ++t) {
      nearest.curvature1[t] += (nearest.curvature1[t] - next.curvature1[t]) / 2;
      nearest.curvature2[t] += (nearest.curvature2[t] - next.curvature2[t]) / 2;
    }
  }
};

std::string rating_words(const RatedLife& rated) {
  if (!rated.bends) return "Its rating is of twist alone: bending is not evaluated.";
  if (!rated.twists) return "Its rating is of bending alone: twist is not evaluated.";
  return std::isinf(rated.repeats) ? "" : fmt::format("{:.0f} % of that is twist.", 100 * rated.twist_share);
}

/// Returns the share of the life after which abrasion is visible.
double visible_from(const WornMaterial& material, const Abrasion& worn, const pipeline::Inspection& inspection) {
  const WornLayer& layer = material.layer;
  return layer.area(inspection.visible_depth_percent / 100 * layer.thickness, worn.arc) /
         layer.area(layer.thickness, worn.arc);
}

void put_inspection(UnvalidatedMode& mode, const std::vector<double>& own, const std::vector<double>& lives,
                    double repeat, const pipeline::Job& job) {
  const Inspected result = inspected(own, lives, repeat, mode.visible_from, job.inspection, job.fatigue);
  mode.found_share = result.found_share, mode.unseen_share = result.unseen_share;
  constexpr double said = 0.01;  // smallest reported share of failures
  constexpr double least = 0.1;  // [%] smaller shares are reported as "less than"
  if (result.failed_share < said) return;
  const double found = 100 * result.found_share, unseen = 100 * result.unseen_share;
  mode.note = fmt::format(
      "By the model {:.0f} % of the dresspacks wear through before they are replaced. A visual check every {:g} weeks finds {} % of "
      "these before; {} % of all wear through unseen. No check sees broken wires.",
      100 * result.failed_share, job.inspection.interval_weeks,
      found > 100 - least ? fmt::format("more than {:g}", 100 - least) : pipeline::readable(found),
      unseen < least ? fmt::format("less than {:g}", least) : pipeline::readable(unseen, 2));
}

/// Returns whether the law of kinks applies to the hose.
bool is_smooth_hose(const pipeline::Dresspack& dresspack) {
  return dresspack.inner_diameter && !dresspack.hose_corrugation;
}

bool has_shape(const pipeline::Link& link) {
  return !link.capsules.empty() || !link.boxes.empty() || !link.meshes.empty();
}

/// Returns whether the simulation had every contact that wears a dresspack. Without shapes of the robot nothing would seem to rub.
bool knows_contacts(const FileReader& strain, const pipeline::Job& job) {
  return strain.has(table_of_work) && job.simulation.contact && job.simulation.self_contact &&
         (job.robot.links.empty() || std::ranges::any_of(job.robot.links, has_shape));
}

/// Returns the names of the links that must have a body and have no shape. A link whose two joints are near each other can lie
/// within its neighbours. The last link can be a frame without a body.
std::vector<std::string> links_without_shape(const pipeline::Robot& robot) {
  constexpr double housing = 0.1;  // width of the housing of a small robot's axis [m]; ESTIMATE
  std::vector<std::string> names;
  for (std::size_t k = 0; k < std::min(robot.links.size(), robot.joints.size()); ++k)
    if (!has_shape(robot.links[k]) && robot.joints[k].origin.norm() > housing) names.push_back(robot.links[k].name);
  return names;
}

/// Abrasion of each dresspack whose contacts are known, and whose thickness and wear rates are known.
void find_abrasion(Search& found) {
  const FileReader& strain = found.strain;
  const pipeline::Job& job = found.job;
  if (!knows_contacts(strain, job)) return;
  const auto patches = patches_of(strain, job.dresspacks.size());
  for (std::size_t d = 0; d < job.dresspacks.size(); ++d) {
    std::optional<WornMaterial> material = worn_of(job.dresspacks[d].dresspack);
    if (!material) continue;
    material->warm = pipeline::wear_at(job.cell.temperature);
    const Abrasion worn = abrasion(*material, patches[d]);
    UnvalidatedMode& mode = found.add(UnvalidatedMode::abrasion, d);
    mode.place = worn.obstacle;
    mode.time = worn.time;
    found.put_worn_place(mode, d, worn);
    std::vector<double> own = found.own_lives(mode, {&worn.repeats, 1}, worn.log10_spread);
    mode.visible_from = visible_from(*material, worn, job.inspection);
    if (job.inspection.interval_weeks > 0)
      put_inspection(mode, own, job.dresspacks.size() > 1 ? found.never() : found.lives, found.repeat(), job);
    found.put_lives(mode, std::move(own));
  }
}

/// Wear of the jackets in each hose: of the cable that is worn through first. Jackets without thickness or wear rates are left
/// out.
void find_jackets(Search& found) {
  const FileReader& strain = found.strain;
  const pipeline::Job& job = found.job;
  if (!strain.has(work_of_jackets)) return;
  const auto names = strain.read<std::string>("/cable/name");
  const auto dresspack = strain.read<std::int32_t>("/cable/dresspack"),
             component = strain.read<std::int32_t>("/cable/component");
  auto patches = patches_of_jackets(strain, std::max<std::size_t>(1, found.starts.size()), names.size(), found.time);
  // With a known rest, only the job's own rest counts.
  if (!job.uncertainty.enabled || pipeline::is_known(job.uncertainty, pipeline::Uncertain::rest)) patches.resize(1);
  const std::size_t rests = patches.size();
  for (std::size_t d = 0; d < job.dresspacks.size(); ++d) {
    const pipeline::Dresspack& mounted = job.dresspacks[d].dresspack;
    if (!is_hose(mounted)) continue;
    std::optional<std::size_t> first;
    Abrasion worst;                                                               // of all rests that count
    std::vector<double> repeats(rests, std::numeric_limits<double>::infinity());  // (rest) of the first worn jacket
    for (std::size_t k = 0; k < names.size(); ++k) {
      const auto part = static_cast<std::size_t>(component[k]);
      if (static_cast<std::size_t>(dresspack[k]) != d || part >= mounted.components.size()) continue;
      std::optional<WornMaterial> jacket = jacket_of(mounted, mounted.components[part]);
      if (!jacket) continue;
      jacket->warm = pipeline::wear_at(job.cell.temperature);
      for (std::size_t rest = 0; rest < rests; ++rest) {
        const Abrasion worn = abrasion(*jacket, patches[rest][k]);
        repeats[rest] = std::min(repeats[rest], worn.repeats);
        if (!first || worn.repeats < worst.repeats) first = k, worst = worn;
      }
    }
    if (!first) continue;
    UnvalidatedMode& mode = found.add(UnvalidatedMode::jacket, d);
    if (std::isfinite(worst.repeats)) mode.place = cable_in_words(job, names[*first]), mode.time = worst.time;
    found.put_worn_place(mode, d, worst);
    found.put_lives(mode, found.own_lives(mode, repeats, worst.log10_spread));
  }
}

/// Warns of motion far beyond the tests. At twice the range, one deviation of the damage exponent is a factor of 2.8 on the life.
void doubt_extrapolation(const RatedLife& rated, const std::string& part, std::vector<pipeline::Warning>& warnings) {
  constexpr double most = 2;
  for (const auto& [times, bends] : {std::pair{rated.bend_times, true}, {rated.twist_times, false}})
    if (times > most)
      warnings.push_back(pipeline::warning_of(
          pipeline::WarningKind::material, "",
          fmt::format(
              "the motion {} '{}' with {} times the range of its maker's test (limit {:g}): its life by the rating "
              "is extrapolated",
              bends ? "bends" : "twists", part, pipeline::readable(times, 2), most),
          bends ? "a bend that is tighter than in the test, or a rig with a radius in another unit"
                : "more twist than in the test, or a rig with a twist in another unit",
          fmt::format("the rating of a test with {}, or a motion with less", bends ? "tighter bends" : "more twist")));
}

/// The life by the makers' ratings of hoses and cables without described wires (rated_cables.h), one mode for each. The damage
/// exponent is sampled in addition to the samples of the validated modes.
void find_ratings(Search& found) {
  for (std::size_t d = 0; d < found.job.dresspacks.size(); ++d) {
    std::optional<HoseMotion> hose;
    for (const pipeline::Component* const part : parts_of(found.job.dresspacks[d].dresspack)) {
      if (!is_rated(*part)) continue;
      if (!hose) hose.emplace(found.strain, d);
      const RatedLife rated = rated_life(*part, hose->segments);
      doubt_extrapolation(rated, part->name, found.warnings);
      UnvalidatedMode& mode = found.add(UnvalidatedMode::rating, d);
      mode.place = part->name;
      mode.note = rating_words(rated);
      if (std::isfinite(rated.repeats)) {
        found.put_place(mode, d, hose->position[rated.segment], rated.sample);
        mode.time = found.time[rated.sample];
      }
      found.put_lives(mode, found.own_lives(mode, {&rated.repeats, 1}, rated.log10_spread, " of " + part->name));
    }
  }
}

/// Returns "corkscrew (welding hose)"; without the name if the job has one dresspack.
std::string of_dresspack(const std::string& mode, const pipeline::Job& job, std::size_t dresspack) {
  const std::string name = pipeline::name_among(job, dresspack);
  return name.empty() ? mode : fmt::format("{} ({})", mode, name);
}

/// Corkscrew of each dresspack with loose cables: of the cable with the smallest margin. tension: see corkscrew.h.
void find_corkscrews(Search& found, const std::vector<std::vector<double>>& tension) {
  for (std::size_t d = 0; d < found.job.dresspacks.size(); ++d) {
    const std::optional<Corkscrew> worst = corkscrew(found.strain, found.job, d, tension);
    if (!worst) {
      found.left_out.push_back(of_dresspack(UnvalidatedMode::corkscrew, found.job, d));
      continue;
    }
    if (!worst->knows_turn) found.left_out.push_back(of_dresspack("corkscrew after many repeats", found.job, d));
    UnvalidatedMode& mode = found.add(UnvalidatedMode::corkscrew, d);
    mode.place = cable_in_words(found.job, found.strain.read<std::string>("/cable/name")[worst->cable]);
    mode.time = found.time[worst->sample];
    found.put_place(mode, d, worst->position, worst->sample);
    mode.note =
        worst->margin < BoredCable::largest_margin
            ? fmt::format("Forces and twist {} times as large would wind it.", pipeline::readable(worst->margin, 2))
            : "Neither its forces nor its twist would wind it.";
    if (worst->turn_left > 0)
      mode.note += fmt::format(" A repeat leaves {} degrees of twist.",
                               pipeline::readable(180 / std::numbers::pi * worst->turn_left, 2));
    if (!worst->knows_turn)
      mode.note +=
          " The motion does not end in its first pose, so whether repeats add up to more twist is not evaluated.";
    constexpr double spread = 0.3;  // deviation: stiffnesses of a cable are known to a factor of two; ESTIMATE
    std::vector<double> own = found.own_lives(mode, {&worst->repeats, 1}, spread);
    const std::vector<double> stiffness =
        pipeline::standard_normals("margin of " + mode.mode + " " + mode.dresspack, own.size());
    for (std::size_t s = 0; s < own.size(); ++s)
      if (worst->margin * std::pow(10.0, spread * stiffness[s]) <= 1) own[s] = 0;  // in the first repeat
    found.put_lives(mode, std::move(own));
  }
}

/// A tube that can kink.
struct SmoothTube {
  std::string name;
  double offset;  ///< of its axis from that of the dresspack [m]
  pipeline::KinkRadius kinks;
};

std::vector<SmoothTube> tubes_of(const pipeline::Dresspack& dresspack) {
  std::vector<SmoothTube> tubes;
  for (const pipeline::Component* const part : parts_of(dresspack))
    if (part->plain && part->plain->kind == pipeline::PlainKind::hose)
      tubes.push_back({part->name, part->helix_radius, pipeline::kink_radius(*part)});
  if (is_smooth_hose(dresspack))
    tubes.push_back({"the hose", 0,
                     dresspack.least_bend_radius
                         ? pipeline::KinkRadius{*dresspack.least_bend_radius, 0}
                         : pipeline::kink_radius(pipeline::Tube{dresspack.diameter, *dresspack.inner_diameter})});
  return tubes;
}

/// The tightest bend of a dresspack's axis.
struct TightestBend {
  double radius = std::numeric_limits<double>::infinity();  ///< [m]
  std::size_t segment = 0, sample = 0;
};

TightestBend tightest_bend(const HoseMotion& hose) {
  double most = 0;
  TightestBend bend;
  for (std::size_t k = 0; k < hose.segments.size(); ++k)
    for (std::size_t t = 0; t < hose.segments[k].curvature1.size(); ++t) {
      const double curvature = std::hypot(hose.segments[k].curvature1[t], hose.segments[k].curvature2[t]);
      if (curvature > most) most = curvature, bend = {1 / curvature, k, t};
    }
  return bend;
}

/// Kinks of smooth tubes in each dresspack and of a smooth hose (pipeline/cable/kink.h): of the tube with the smallest margin in
/// the tightest bend of the dresspack's axis. A tube that kinks does so in the first repeat. Waves and coils of a loose tube in
/// the hose are left out.
void find_kinks(Search& found) {
  for (std::size_t d = 0; d < found.job.dresspacks.size(); ++d) {
    const std::vector<SmoothTube> tubes = tubes_of(found.job.dresspacks[d].dresspack);
    if (tubes.empty()) continue;
    const HoseMotion hose(found.strain, d);
    const TightestBend bend = tightest_bend(hose);
    // the radius on the inner side of the bend
    const auto radius_of = [&](const SmoothTube& tube) { return std::max(0.0, bend.radius - tube.offset); };
    const auto margin_of = [&](const SmoothTube& tube) { return radius_of(tube) / tube.kinks.median; };
    const SmoothTube& worst = *std::ranges::min_element(tubes, {}, margin_of);
    UnvalidatedMode& mode = found.add(UnvalidatedMode::kink, d);
    mode.place = worst.name;
    mode.margin = margin_of(worst);
    std::vector<double> own = found.never();
    if (std::isfinite(bend.radius)) {
      const std::vector<double> scatter = pipeline::standard_normals(mode.mode + " of " + worst.name, own.size());
      for (std::size_t s = 0; s < own.size(); ++s)
        if (mode.margin < std::pow(10.0, worst.kinks.log10_spread * scatter[s])) own[s] = 0;  // in the first repeat
      found.put_place(mode, d, hose.position[bend.segment], bend.sample);
      mode.time = found.time[bend.sample];
      const bool spreads = worst.kinks.log10_spread > 0;
      mode.note = fmt::format("Its tightest bend has a radius of {} mm. {} {} mm{}.",
                              pipeline::readable(1e3 * radius_of(worst), 3),
                              spreads ? "By its two diameters half of such tubes kink at" : "Its maker allows",
                              pipeline::readable(1e3 * worst.kinks.median, 3), spreads ? "" : " or more");
      constexpr double other_polymers = 5;  // times as large are the largest published radii (kink.h)
      if (spreads && mode.margin < other_polymers)
        mode.note +=
            " Tubes of PTFE with thick walls kink at up to five times that: give least_bend_radius_mm of such a hose.";
    }
    found.put_lives(mode, std::move(own));
  }
}

/// Returns the parts and modes of the job that have no life, in words. left_out: modes that this function does not determine.
std::string not_evaluated(const FileReader& strain, const pipeline::Job& job,
                          const std::vector<std::string>& left_out) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  };
  const auto add_plain = [&](const pipeline::Component& part) {
    const auto twisted = [](const pipeline::Rating& rating) { return rating.rig.kind == pipeline::RigKind::torsion; };
    const auto of_twist = std::ranges::count_if(part.ratings, twisted);
    const bool hose = part.plain->kind == pipeline::PlainKind::hose;
    const bool pressed = part.plain->pressure && part.plain->most_pressure;  // compared with its maker's limit
    if (part.ratings.empty())
      return add((!hose ? "" : pressed ? "fatigue of " : "fatigue and pressure of ") + part.name);
    if (hose && !pressed) add("pressure of " + part.name);
    if (of_twist == 0) add("twist of " + part.name);
    if (of_twist == std::ssize(part.ratings)) add("bending of " + part.name);
  };
  std::vector<std::string> bare;  // cables whose jackets have no life
  std::size_t cables = 0;
  std::vector<std::string> kinks;
  for (std::size_t d = 0; d < job.dresspacks.size(); ++d) {
    const pipeline::Dresspack& dresspack = job.dresspacks[d].dresspack;
    for (const pipeline::Component* const part : parts_of(dresspack))
      if (part->plain) add_plain(*part);
    if (is_hose(dresspack) && !is_smooth_hose(dresspack)) kinks.push_back(of_dresspack("kinks of the hose", job, d));
    if (!dresspack.core_parts.empty())
      add(dresspack.core_parts);
    else if (dresspack.core_diameter > 0 && dresspack.core_components.empty())
      add(fmt::format("the core of {:.4g} mm", 1e3 * dresspack.core_diameter));
    if (is_hose(dresspack) && dresspack.hose_material.empty()) add(UnvalidatedMode::wall);
    for (const pipeline::Component* const each : parts_of(dresspack)) {
      const pipeline::Component& part = *each;
      if (is_surface(dresspack, part)) continue;
      if (part.components.empty() && !(part.plain && part.plain->kind == pipeline::PlainKind::cable)) continue;
      ++cables;
      // The work of a cable without friction is not in the file.
      const bool rubs = !part.components.empty() && strain.has(work_of_jackets) && part.friction.value_or(0) > 0;
      if (!rubs || !is_hose(dresspack) || !jacket_of(dresspack, part)) bare.push_back(part.name);
    }
  }
  const bool worn = knows_contacts(strain, job) && std::ranges::all_of(job.dresspacks, [](const auto& mounted) {
                      return worn_of(mounted.dresspack).has_value();
                    });
  if (!worn) add(UnvalidatedMode::abrasion);
  const auto bodiless = links_without_shape(job.robot);
  if (worn && !bodiless.empty()) add(fmt::format("abrasion on {}", fmt::join(bodiless, " and ")));
  if (!bare.empty() && bare.size() == cables)
    add("jackets of the cables");
  else
    for (const std::string& cable : bare) add("jacket of " + cable);
  for (const std::string& hose : kinks) add(hose);
  for (const std::string& mode : left_out) add(mode);
  for (const char* always : {"fretting and grip at clamps", "connectors"}) add(always);
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

void set_lives(UnvalidatedMode& mode, std::vector<double> own, const std::vector<double>& lives, double repeat) {
  std::vector<double> together(lives.size());
  std::size_t first = 0;
  for (std::size_t s = 0; s < lives.size(); ++s) first += own[s] < lives[s], together[s] = std::min(own[s], lives[s]);
  mode.first_share = static_cast<double>(first) / static_cast<double>(lives.size());
  const auto repeats = pipeline::percentiles_of(std::move(own));
  for (std::size_t i = 0; i < repeats.size(); ++i) mode.hours[i] = hours(repeats[i], repeat);
  mode.together_p10 = hours(pipeline::percentiles_of(std::move(together))[0], repeat);
}

Unvalidated unvalidated_modes(const FileReader& strain, const pipeline::Job& job, const std::vector<double>& lives,
                              const std::vector<std::vector<double>>& tension) {
  Search found{strain, job, lives};
  find_abrasion(found);
  find_jackets(found);
  find_ratings(found);
  find_corkscrews(found, tension);
  find_kinks(found);
  std::string rest = not_evaluated(strain, job, found.left_out);
  return {std::move(found.modes), std::move(rest), std::move(found.warnings)};
}

}  // namespace dresslife::fatigue
