#include "fatigue/varied_forces.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include "fatigue/failure_modes.h"
#include "fatigue/response.h"
#include "pipeline/base/joined.h"
#include "pipeline/base/readable.h"
#include "pipeline/base/statistics.h"
#include "pipeline/base/warning_words.h"
#include "pipeline/cable/believable.h"
#include "pipeline/cable/excess.h"
#include "pipeline/job/beyond_limit.h"

namespace dresslife::fatigue {
namespace {

using pipeline::Uncertain;
using Parameters =
    std::vector<std::size_t>;  // indices of uncertain_parameters(); starts_parameter alone: another rest of the cables

constexpr std::size_t starts_parameter = index_of(Uncertain::rest), slack_parameter = index_of(Uncertain::slack),
                      stiffness_parameter = index_of(Uncertain::hose_stiffness);

/// Forces of the cables at one variation. In a hose they do not depend on the friction inside. Those without a hose at another friction
/// inside are not compared with limits.
struct VariedForces {
  std::array<double, pipeline::strain_parameters> z{};
  std::size_t rest = 0;
  std::vector<double> tension, place, moment, moment_tension;
  std::vector<std::uint32_t> sample, moment_place;

  Parameters parameters() const {
    Parameters changed;
    for (std::size_t p = 0; p < z.size(); ++p)
      if (z[p] != 0) changed.push_back(p);
    if (changed.empty() && rest > 0) changed.push_back(starts_parameter);
    return changed;
  }
};

template <class T>
std::vector<T> row_of(const pipeline::FileReader& file, const std::string& name, std::size_t row) {
  std::vector<T> values;
  file.read_rows(name, row, 1, values);
  return values;
}

/// Errors: InputError for a sample or a cable that the file does not have.
std::vector<VariedForces> read_forces(const pipeline::FileReader& strain, std::size_t cables) {
  std::vector<VariedForces> all;
  if (!strain.has("/variation/tension")) return all;
  const std::vector<VariedStrains> varied = read_variation_points(strain);
  const std::size_t samples = strain.rows("/time");
  for (std::size_t v = 0; v < varied.size(); ++v) {
    if (varied[v].inside != pipeline::Inside::as_is || varied[v].z[index_of(Uncertain::friction_inside)] != 0) continue;
    VariedForces& of = all.emplace_back();
    of.z = varied[v].z;
    of.rest = varied[v].rest;
    of.tension = row_of<double>(strain, "/variation/tension", v);
    of.place = row_of<double>(strain, "/variation/tension_place", v);
    of.sample = row_of<std::uint32_t>(strain, "/variation/tension_sample", v);
    of.moment = row_of<double>(strain, "/variation/clamp_moment", v);
    of.moment_place = row_of<std::uint32_t>(strain, "/variation/clamp_moment_place", v);
    of.moment_tension = row_of<double>(strain, "/variation/clamp_moment_tension", v);
    bool known = std::ranges::all_of(of.sample, [&](std::uint32_t sample) { return sample < samples; });
    for (std::size_t k = 0; k < of.moment_place.size(); ++k)
      known = known && of.moment_place[k] < (k % 2 == 0 ? samples : cables);
    if (!known)
      throw pipeline::InputError(
          strain.where(),
          fmt::format(
              "/variation/tension_sample or clamp_moment_place of variation {} has a sample or a cable that is not in the file",
              v + 1),
          "make the file again with dresslife-strain");
  }
  return all;
}

/// A quantity over its limit at one variation. of: number of the cable or of the span with the largest load.
struct Load {
  double load = 0;
  std::size_t of = 0;
};

Load force_load(const VariedForces& at, const FileCables& cables) {
  Load most;
  for (std::size_t k = 0; k < at.tension.size(); ++k) {
    const double bears = pipeline::believable_share * cables.force[k].strength();
    if (bears > 0 && std::abs(at.tension[k]) > most.load * bears) most = {std::abs(at.tension[k]) / bears, k};
  }
  return most;
}

Load moment_load(const VariedForces& at, const FileCables&) {
  Load most;
  for (std::size_t span = 0; 2 * span + 1 < at.moment.size(); ++span) {
    const double bears = pipeline::believable_share * at.moment[2 * span + 1];
    if (bears > 0 && at.moment[2 * span] > most.load * bears) most = {at.moment[2 * span] / bears, span};
  }
  return most;
}

/// One or two parameters whose other values exceed a limit.
struct Cause {
  Parameters parameters;
  double share = 0;  ///< of dresspacks beyond the limit by them
  std::size_t at =
      0;  ///< variation that exceeds the limit: the one nearest to the job, of two equally near ones the larger load
  Load load{};
};

double own_value(const pipeline::Job& job, std::size_t parameter) {
  const pipeline::StrainFactors& factors = job.strain.factors;
  if (parameter == index_of(Uncertain::friction_hose)) return factors.hose_friction;
  if (parameter == slack_parameter) return factors.slack;
  if (parameter == index_of(Uncertain::play)) return factors.play;
  if (parameter == index_of(Uncertain::grip)) return factors.grip;
  if (parameter == stiffness_parameter) return job.simulation.stiffness_factor;
  return 1;
}

std::string words_of(const pipeline::Job& job, const VariedForces& at) {
  std::vector<std::string> words;
  for (const std::size_t p : at.parameters()) {
    const pipeline::UncertainParameter& parameter = pipeline::uncertain_parameters()[p];
    words.push_back(p == starts_parameter ? "another of the places at which the loose cables come to rest"
                                          : pipeline::value_words(parameter, at.z[p], own_value(job, p)));
  }
  return pipeline::joined(words, " and ");
}

/// The loads of one limit: with the job's own values, and at each variation.
struct Loads {
  double own = 0;
  std::vector<Load> varied;
};

/// How far the parameters are known, and the number of starts at each rest.
struct Known {
  pipeline::ParameterKnowledge parameters;
  std::vector<std::size_t> starts;
};

/// One limit at all variations.
class VariedLimit {
 public:
  VariedLimit(const Known& known, const std::vector<VariedForces>& all, const Loads& loads)
      : all_(all), loads_(loads.varied), own_(loads.own), knowledge_(known.parameters), starts_(known.starts) {
    std::map<Parameters, std::vector<std::size_t>> groups;
    for (std::size_t v = 0; v < all.size(); ++v)
      if (const Parameters changed = all[v].parameters(); !changed.empty()) groups[changed].push_back(v);
    for (const auto& [parameters, variations] : groups)
      if (parameters.size() == 1) add(parameters, variations);
    const std::vector<Cause> alone = causes_;
    for (const auto& [parameters, variations] : groups)
      if (parameters.size() > 1 && std::ranges::none_of(alone, [&of = parameters](const Cause& cause) {
            return std::ranges::find(of, cause.parameters.front()) != of.end();
          }))
        add(parameters, variations);
    std::ranges::stable_sort(causes_, [](const Cause& a, const Cause& b) { return a.share > b.share; });
  }

  const std::vector<Cause>& causes() const { return causes_; }  ///< the one with the largest share first
  /// Share of dresspacks beyond the limit by any cause, as if these were independent.
  double share() const {
    double within = 1;
    for (const Cause& cause : causes_) within *= 1 - cause.share;
    return 1 - within;
  }

 private:
  double mean(std::size_t p) const { return knowledge_.mean(static_cast<Eigen::Index>(p)); }
  double deviation(std::size_t p) const {
    const auto at = static_cast<Eigen::Index>(p);
    return std::sqrt(knowledge_.covariance(at, at));
  }

  void add(const Parameters& parameters, const std::vector<std::size_t>& variations) {
    std::optional<std::size_t> worst;
    for (const std::size_t v : variations) {
      if (loads_[v].load <= 1) continue;
      if (!worst || std::pair(distance(v), -loads_[v].load) < std::pair(distance(*worst), -loads_[*worst].load))
        worst = v;
    }
    if (!worst) return;
    double share = 0;
    if (parameters.front() == starts_parameter)
      share = share_of_rests(variations);
    else if (parameters.size() == 1)
      share = share_of(parameters.front(), variations);
    else
      for (const std::size_t v : variations) share = std::max(share, share_of_pair(v));
    if (share >= pipeline::least_share_beyond) causes_.push_back({parameters, share, *worst, loads_[*worst]});
  }

  double distance(std::size_t v) const {
    double sum = 0;
    for (const double z : all_[v].z) sum += z * z;
    return sum;
  }
  double share_of_rests(const std::vector<std::size_t>& variations) const {
    double beyond = 0, all = 0;
    for (const std::size_t count : starts_) all += static_cast<double>(count);
    for (const std::size_t v : variations)
      if (loads_[v].load > 1) beyond += static_cast<double>(starts_[all_[v].rest]);
    return beyond / all;
  }
  double share_of(std::size_t p, const std::vector<std::size_t>& variations) const {
    std::vector<pipeline::LoadNode> nodes{{0, own_}};
    for (const std::size_t v : variations) nodes.push_back({all_[v].z[p], loads_[v].load});
    return deviation(p) > 0 ? pipeline::share_beyond(nodes, mean(p), deviation(p)) : 0;
  }
  /// Returns the share beyond the place between the job and the variation at which the load becomes 1, in both parameters.
  double share_of_pair(std::size_t v) const {
    if (loads_[v].load <= 1) return 0;
    const double way = (1 - own_) / (loads_[v].load - own_);
    double share = 1;
    for (const std::size_t p : all_[v].parameters()) {
      const double z = all_[v].z[p];
      share *= deviation(p) > 0 ? pipeline::normal_share((mean(p) - way * z) / deviation(p) * (z > 0 ? 1 : -1)) : 0;
    }
    return share;
  }

  const std::vector<VariedForces>& all_;
  const std::vector<Load>& loads_;
  double own_;
  const pipeline::ParameterKnowledge& knowledge_;
  const std::vector<std::size_t>& starts_;
  std::vector<Cause> causes_;
};

/// Loads over the slack of all cables together, at one stiffness of the hose.
class SlackLoads {
 public:
  SlackLoads(const std::vector<VariedForces>& all, const Loads& loads, double stiffness) {
    if (stiffness == 0) nodes_.push_back({0, loads.own});
    for (std::size_t v = 0; v < all.size(); ++v) {
      const VariedForces& of = all[v];
      if (of.z[stiffness_parameter] != stiffness) continue;
      bool others = of.rest > 0 && of.z[slack_parameter] == 0;  // at another slack the cables leave their rest
      for (std::size_t p = 0; p < of.z.size(); ++p)
        others = others || (p != slack_parameter && p != stiffness_parameter && of.z[p] != 0);
      if (!others) nodes_.push_back({of.z[slack_parameter], loads.varied[v].load});
    }
    std::ranges::sort(nodes_, {}, &pipeline::LoadNode::z);
  }
  double least() const { return nodes_.front().z; }
  double most() const { return nodes_.back().z; }
  /// Loads differ by decades: between the nodes their logarithm is linear, which was 3 % below to 30 % above computed loads. Above
  /// them the load is linear. Below them cables become tight: it grows by e^3 while z falls by 1, more than all that were computed
  /// (7 to 18; a hose with seven cables on a KUKA KR 210).
  double at(double z) const {
    constexpr double tightening = 3, none = 1e-6;
    if (nodes_.empty()) return 0;
    if (z < least()) return nodes_.front().load * std::exp(tightening * (least() - z));
    if (nodes_.size() == 1) return nodes_.front().load;
    std::size_t k = 1;
    while (k + 1 < nodes_.size() && nodes_[k].z < z) ++k;
    const pipeline::LoadNode &a = nodes_[k - 1], &b = nodes_[k];
    const double way = (z - a.z) / (b.z - a.z);
    if (way > 1) return std::max(0.0, a.load + (b.load - a.load) * way);
    return std::exp(std::lerp(std::log(std::max(none, a.load)), std::log(std::max(none, b.load)), way));
  }

 private:
  std::vector<pipeline::LoadNode> nodes_;
};

/// Returns the loads of the same dresspack whose cables all have another slack, by `shift` of its z. With a variation of the slack
/// they have the slack at the sum of both. Of other variations only the job's slack was computed; their loads change as much as
/// those without them.
Loads shifted(const std::vector<VariedForces>& all, const Loads& loads, double shift) {
  // With 1.5 times the slack and more friction the load was 1.2 times that by this rule.
  constexpr double margin = 1.25;
  if (shift == 0) return loads;
  const SlackLoads own(all, loads, 0);
  std::map<double, SlackLoads> at;  // by stiffness
  for (const VariedForces& of : all) at.try_emplace(of.z[stiffness_parameter], all, loads, of.z[stiffness_parameter]);
  Loads moved{own.at(shift), loads.varied};
  for (std::size_t v = 0; v < all.size(); ++v) {
    const SlackLoads& here = at.at(all[v].z[stiffness_parameter]);
    const double z = all[v].z[slack_parameter], before = here.at(z);
    const bool computed = z != 0 || all[v].z[stiffness_parameter] != 0;
    moved.varied[v].load *= (computed ? 1 : margin) * (before > 0 ? here.at(z + shift) / before : 1);
  }
  return moved;
}

/// Moves the variations of the hose's stiffness to `share` of their change, as a run has them that knows the stiffness better. The
/// logarithm of a load is linear.
void bring_nearer(std::vector<VariedForces>& all, std::vector<Loads>& limits, double share) {
  for (Loads& loads : limits) {
    const SlackLoads own(all, loads, 0);
    for (std::size_t v = 0; v < all.size(); ++v)
      if (all[v].z[stiffness_parameter] != 0)
        loads.varied[v].load =
            std::pow(own.at(all[v].z[slack_parameter]), 1 - share) * std::pow(loads.varied[v].load, share);
  }
  for (VariedForces& of : all) of.z[stiffness_parameter] *= share;
}

/// Another slack of all cables together: the change of its z, and the share of such dresspacks beyond one of the limits.
struct OtherSlack {
  double shift = 0, share = 1;
};

/// Returns the slack with the least share; of equal ones the nearest to the job's. most: of the shift, beyond which a cable would have
/// more than largest_slack.
OtherSlack best_slack(const std::vector<VariedForces>& all, const std::vector<Loads>& limits, const Known& known,
                      double most) {
  constexpr double step = 0.05;  // 2 % of the slack: less than its rounding to two digits
  const SlackLoads computed(all, limits.front(), 0);
  OtherSlack best{0, 2};  // more than any share
  for (double size = 0; best.share > 0 && size <= std::max(computed.most(), -computed.least()); size += step)
    for (const double shift : {size, -size}) {
      if (shift < computed.least() || shift > std::min(most, computed.most())) continue;
      double share = 0;
      for (const Loads& loads : limits) {
        const Loads moved = shifted(all, loads, shift);
        share = std::max(share, moved.own > 1 ? 1 : VariedLimit(known, all, moved).share());
      }
      if (share < best.share) best = {shift, share};
    }
  return best;
}

/// Returns "; 31 % of such dresspacks exceed the limit: 18 % by ...": how many, by which parameters, and how this was computed.
std::string share_text(const pipeline::Job& job, const VariedLimit& limit, const std::vector<VariedForces>& all) {
  std::vector<std::string> others;
  for (std::size_t k = 1; k < limit.causes().size(); ++k)
    others.push_back(fmt::format("{} with {}", pipeline::percent_words(limit.causes()[k].share),
                                 words_of(job, all[limit.causes()[k].at])));
  return fmt::format(
      "; about {} of such dresspacks exceed this limit{} (interpolated linearly in the distribution of the uncertain parameters); with the "
      "job's own values none does",
      pipeline::percent_words(limit.share()),
      others.empty() ? ""
                     : fmt::format(" ({} by this parameter, {})", pipeline::percent_words(limit.causes().front().share),
                                   pipeline::joined(others, ", ")));
}

/// Returns "uncertainty.slack": the key of how well a parameter is known.
std::string spread_key(std::size_t parameter) {
  return fmt::format("uncertainty.{}", pipeline::uncertain_parameters()[parameter].name);
}

/// Returns cause and remedy of a force at a variation. tension: of the cable [N].
Cure cure_at(const pipeline::Job& job, const VariedForces& at, const CableFacts& facts,
             const pipeline::CableForce& force, double tension) {
  Cure cure = cure_of(facts, force, !slides(job.strain.slip.front()), tension < 0, job.motion.acceleration_percent);
  const double z = at.z[slack_parameter], now = facts.slack_factor * facts.component->laying.slack;
  if (z != 0 && now > 0)
    cure.cause = fmt::format("too {} slack: {:.3g} % instead of {:.3g} %", z < 0 ? "little" : "much",
                             now * pipeline::uncertain_parameters()[slack_parameter].value(z), now);
  else if (at.z[index_of(Uncertain::friction_hose)] != 0 && tension > 0)
    cure.cause = "friction keeps the cable from moving its slack to the bends that need it";
  return cure;
}

/// Returns the warning. cable: number of the cable that causes the load. what: part, value, limit, place and time.
pipeline::Warning warning_at(const pipeline::Job& job, const FileCables& cables, const VariedLimit& limit,
                             const std::vector<VariedForces>& all, std::size_t cable, double tension,
                             const std::optional<pipeline::Remedy>& together, const std::string& what) {
  const Cause& cause = limit.causes().front();
  const VariedForces& at = all[cause.at];
  const Cure cure = cure_at(job, at, cables.facts[cable], cables.force[cable], tension);
  pipeline::Remedy remedy = together.value_or(pipeline::Remedy{{}, cure.remedy});
  for (const std::size_t p : cause.parameters)
    if (!together && p != starts_parameter)  // slack_remedy() has tried the measurements
      remedy.words += pipeline::measurement_words(pipeline::uncertain_parameters()[p], job.uncertainty);
  pipeline::Warning warning = pipeline::warning_of(
      pipeline::WarningKind::other_values, "",
      fmt::format("with {} {}{}", words_of(job, at), what, share_text(job, limit, all)), cure.cause, remedy);
  warning.amount = limit.share();
  return warning;
}

std::string place_words(double place) {
  return place < 0 ? "over its whole length" : fmt::format("{:.2f} m from the base clamp", place);
}

std::vector<Loads> loads_of(const std::vector<VariedForces>& all, const FileCables& cables, const ForceShares& own) {
  std::vector<Loads> limits{{own.force / pipeline::believable_share, {}},
                            {own.moment / pipeline::believable_share, {}}};
  for (const VariedForces& at : all) {
    limits[0].varied.push_back(force_load(at, cables));
    limits[1].varied.push_back(moment_load(at, cables));
  }
  return limits;
}

}  // namespace

std::optional<pipeline::Remedy> slack_remedy(const pipeline::FileReader& strain, const pipeline::Job& job,
                                             const FileCables& cables, const ForceShares& own) {
  if (!job.uncertainty.enabled) return std::nullopt;
  std::vector<VariedForces> all = read_forces(strain, cables.force.size());
  if (std::ranges::none_of(all, [](const VariedForces& of) { return of.z[slack_parameter] != 0; })) return std::nullopt;
  const pipeline::UncertainParameter& parameter = pipeline::uncertain_parameters()[slack_parameter];
  std::vector<std::pair<std::string, double>> entries;  // of the user, who may have several cables in one; slack now
  double largest = 0;
  for (const CableFacts& facts : cables.facts) {
    const double now = facts.component->laying.slack / 100;
    const std::pair entry(cable_key(facts, "slack_percent"), now);
    if (now > 0 && std::ranges::find(entries, entry) == entries.end()) entries.push_back(entry);
    largest = std::max(largest, facts.slack_factor * now);
  }
  if (entries.empty()) return std::nullopt;
  std::vector<Loads> limits = loads_of(all, cables, own);
  const double most = parameter.z_of(std::max(1.0, pipeline::largest_slack / largest));
  Known known{knowledge_of_job(job), read_rests(strain)};
  OtherSlack best = best_slack(all, limits, known, most);
  std::vector<std::string> tests;
  std::vector<pipeline::KeyValue> measured;
  for (const std::size_t p : {slack_parameter, stiffness_parameter, index_of(Uncertain::friction_hose)}) {
    if (best.share == 0) break;
    const pipeline::UncertainParameter& measure = pipeline::uncertain_parameters()[p];
    if (pipeline::measurement_words(measure, job.uncertainty).empty()) continue;
    const auto at = static_cast<Eigen::Index>(p);
    const double z = measure.test_deviation / measure.deviation();
    known.parameters.covariance(at, at) = z * z;
    if (p == stiffness_parameter) bring_nearer(all, limits, z / measure.z_of(job.uncertainty.spread[p]));
    measured.push_back({spread_key(p), fmt::format("{:.3g}", std::exp(measure.test_deviation))});
    tests.emplace_back(measure.test);
    best = best_slack(all, limits, known, most);
  }
  const SlackLoads computed(all, limits.front(), 0);
  const std::string range = fmt::format("{:.2g} .. {:.2g} times the slack of all cables together",
                                        parameter.value(computed.least()), parameter.value(computed.most()));
  constexpr double error = 0.05;  // of a share by interpolation: slacks with 1 % by it had no warning in their own runs
  if (best.share > (best.shift == 0 ? 0 : error))
    return pipeline::Remedy{
        {},
        fmt::format(
            "no slack keeps the limits of force and moment (by the forces at {}; with the best, {:.2g} times, {} of such "
            "dresspacks exceed one): a hose with a larger bore or a stiffer wall, softer cables, or {}",
            range, parameter.value(best.shift), pipeline::percent_words(best.share), gentle_clamps)};
  pipeline::Remedy remedy;
  std::vector<std::string> before;
  if (best.shift != 0) {
    for (const auto& [key, now] : entries) {
      const double to = now * parameter.value(best.shift);
      remedy.values.push_back({key, best.shift > 0 ? pipeline::percent_above(to) : pipeline::percent_below(to)});
      before.push_back(fmt::format("{:.3g}", 100 * now));
    }
    remedy.words = fmt::format(" (now {}; all of them, by the forces at {}{})", pipeline::joined(before, ", "), range,
                               best.shift > 0 ? "; more slack rubs more, so jackets wear through sooner" : "");
  }
  if (best.share > 0)
    remedy.words += fmt::format("; run again, because {} of such dresspacks may exceed a limit then, too",
                                pipeline::percent_words(best.share));
  if (measured.empty()) return remedy;
  remedy.values.insert(remedy.values.end(), measured.begin(), measured.end());
  const bool several = tests.size() > 1;
  remedy.words +=
      fmt::format("{} if {} the job's values: {}. No slack keeps the limits without {}", best.shift != 0 ? ";" : ",",
                  several ? "these measurements confirm" : "this measurement confirms", pipeline::joined(tests, "; "),
                  several ? "them" : "it");
  return remedy;
}

std::vector<pipeline::Warning> varied_force_warnings(const pipeline::FileReader& strain, const pipeline::Job& job,
                                                     const FileCables& cables, const ForceShares& own,
                                                     const std::optional<pipeline::Remedy>& together) {
  std::vector<pipeline::Warning> warnings;
  if (!job.uncertainty.enabled) return warnings;
  const std::vector<VariedForces> all = read_forces(strain, cables.force.size());
  const std::vector<Loads> limits = loads_of(all, cables, own);
  const Known known{knowledge_of_job(job), read_rests(strain)};
  constexpr double limit = pipeline::believable_share;
  if (own.force <= limit) {
    const VariedLimit varied(known, all, limits[0]);
    if (!varied.causes().empty()) {
      const VariedForces& at = all[varied.causes().front().at];
      const std::size_t cable = varied.causes().front().load.of;
      const double tension = at.tension[cable], strength = cables.force[cable].strength();
      warnings.push_back(warning_at(
          job, cables, varied, all, cable, tension, together,
          fmt::format(
              "'{}' is {} with {:.0f} % of its breaking force: {} of {} N (limit {:.0f} %), {}, {}, which is unrealistic",
              cables.facts[cable].name, tension < 0 ? "compressed" : "pulled", 100 * std::abs(tension) / strength,
              pipeline::readable(std::abs(tension)), pipeline::readable(strength), 100 * limit,
              place_words(at.place[cable]), moment_of(strain, at.sample[cable]))));
    }
  }
  if (own.moment <= limit) {
    const VariedLimit varied(known, all, limits[1]);
    if (!varied.causes().empty()) {
      const VariedForces& at = all[varied.causes().front().at];
      const std::size_t span = varied.causes().front().load.of, cable = at.moment_place[2 * span + 1];
      const double tension = at.moment_tension[span];
      warnings.push_back(warning_at(
          job, cables, varied, all, cable, tension, together,
          fmt::format(
              "the cables{} bend a clamp with {:.2g} times the moment of the hose ({} of {} N m, limit {:g} times) {}, which is "
              "unrealistic; '{}' {} most, with {} N",
              cables.facts[cable].between, at.moment[2 * span] / at.moment[2 * span + 1],
              pipeline::readable(at.moment[2 * span]), pipeline::readable(at.moment[2 * span + 1]), limit,
              moment_of(strain, at.moment_place[2 * span]), cables.facts[cable].name, tension < 0 ? "presses" : "pulls",
              pipeline::readable(std::abs(tension)))));
    }
  }
  return warnings;
}

}  // namespace dresslife::fatigue
