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

constexpr std::size_t starts_parameter = index_of(Uncertain::rest);

/// Forces of the cables at one variation. Forces do not depend on the friction inside cables.
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
  if (parameter == index_of(Uncertain::slack)) return factors.slack;
  if (parameter == index_of(Uncertain::play)) return factors.play;
  if (parameter == index_of(Uncertain::grip)) return factors.grip;
  if (parameter == index_of(Uncertain::hose_stiffness)) return job.simulation.stiffness_factor;
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

/// One limit at all variations.
class VariedLimit {
 public:
  VariedLimit(const pipeline::FileReader& strain, const pipeline::Job& job, const std::vector<VariedForces>& all,
              double own, const std::vector<Load>& loads)
      : all_(all), loads_(loads), own_(own), knowledge_(knowledge_of_job(job)), starts_(read_rests(strain)) {
    std::map<Parameters, std::vector<std::size_t>> groups;
    for (std::size_t v = 0; v < all.size(); ++v)
      if (const Parameters changed = all[v].parameters(); !changed.empty()) groups[changed].push_back(v);
    for (const auto& [parameters, variations] : groups)
      if (parameters.size() == 1) add(parameters, variations);
    const std::vector<Cause> alone = causes_;
    for (const auto& [parameters, variations] : groups)
      if (parameters.size() > 1 && std::none_of(alone.begin(), alone.end(), [&](const Cause& cause) {
            return std::find(parameters.begin(), parameters.end(), cause.parameters.front()) != parameters.end();
          }))
        add(parameters, variations);
    std::stable_sort(causes_.begin(), causes_.end(), [](const Cause& a, const Cause& b) { return a.share > b.share; });
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
  pipeline::ParameterKnowledge knowledge_;
  std::vector<std::size_t> starts_;
  std::vector<Cause> causes_;
};

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

/// Returns a slack_percent for the cable as a line of the job, and why; empty: none up to the largest usual slack.
std::string slack_line(const CableFacts& facts, double by, const std::string& why) {
  const double now = facts.component->laying.slack / 100;
  if (now == 0 || by * now > pipeline::largest_slack) return "";
  return fmt::format("{}: {} (now {:.3g}; {})", cable_key(facts, "slack_percent"),
                     by > 1 ? pipeline::percent_above(by * now) : pipeline::percent_below(by * now), 100 * now, why);
}

/// Returns cause and remedy of a force at a variation. tension: of the cable [N].
Cure cure_at(const pipeline::Job& job, const VariedForces& at, const CableFacts& facts,
             const pipeline::CableForce& force, double tension) {
  const auto& slack = pipeline::uncertain_parameters()[index_of(Uncertain::slack)];
  const double z = at.z[index_of(Uncertain::slack)], now = facts.slack_factor * facts.component->laying.slack;
  if (z != 0) {
    const std::string line =
        slack_line(facts, 1 / slack.value(z), "then such a dresspack has the slack that keeps the limit now");
    if (!line.empty())
      return {fmt::format("too {} slack: {:.3g} % instead of {:.3g} %", z < 0 ? "little" : "much", now * slack.value(z),
                          now),
              line};
  }
  if (at.z[index_of(Uncertain::friction_hose)] != 0 && tension > 0) {
    // With it `hard` at 2.83 times the friction pulls a cable with 0.03 instead of 0.25 of its breaking force.
    constexpr double less_than_most = -1.25;  // z of a slack that 9 of 10 dresspacks exceed
    const std::string line = slack_line(facts, 1 / slack.value(less_than_most), "not tried");
    if (!line.empty()) return {"friction keeps the cable from moving its slack to the bends that need it", line};
  }
  return cure_of(facts, force, !slides(job.strain.slip.front()), tension < 0, job.motion.acceleration_percent);
}

/// Returns the warning. cable: number of the cable that causes the load. what: part, value, limit, place and time.
pipeline::Warning warning_at(const pipeline::Job& job, const FileCables& cables, const VariedLimit& limit,
                             const std::vector<VariedForces>& all, std::size_t cable, double tension,
                             const std::string& what) {
  const Cause& cause = limit.causes().front();
  const VariedForces& at = all[cause.at];
  const Cure cure = cure_at(job, at, cables.facts[cable], cables.force[cable], tension);
  std::string remedy = cure.remedy;
  for (const std::size_t p : cause.parameters)
    if (p != starts_parameter)
      remedy += pipeline::measurement_words(pipeline::uncertain_parameters()[p], job.uncertainty);
  pipeline::Warning warning = pipeline::warning_of(
      pipeline::WarningKind::other_values, "",
      fmt::format("with {} {}{}", words_of(job, at), what, share_text(job, limit, all)), cure.cause, remedy);
  warning.amount = limit.share();
  return warning;
}

std::string place_words(double place) {
  return place < 0 ? "over its whole length" : fmt::format("{:.2f} m from the base clamp", place);
}

}  // namespace

std::vector<pipeline::Warning> varied_force_warnings(const pipeline::FileReader& strain, const pipeline::Job& job,
                                                     const FileCables& cables, const ForceShares& own) {
  std::vector<pipeline::Warning> warnings;
  if (!job.uncertainty.enabled) return warnings;
  const std::vector<VariedForces> all = read_forces(strain, cables.force.size());
  const auto loads_by = [&](Load (*load)(const VariedForces&, const FileCables&)) {
    std::vector<Load> loads;
    for (const VariedForces& at : all) loads.push_back(load(at, cables));
    return loads;
  };
  constexpr double limit = pipeline::believable_share;
  if (own.force <= limit) {
    const std::vector<Load> loads = loads_by(force_load);
    const VariedLimit varied(strain, job, all, own.force / limit, loads);
    if (!varied.causes().empty()) {
      const VariedForces& at = all[varied.causes().front().at];
      const std::size_t cable = varied.causes().front().load.of;
      const double tension = at.tension[cable], strength = cables.force[cable].strength();
      warnings.push_back(warning_at(
          job, cables, varied, all, cable, tension,
          fmt::format(
              "'{}' is {} with {:.0f} % of its breaking force: {} of {} N (limit {:.0f} %), {}, {}, which is unrealistic",
              cables.facts[cable].name, tension < 0 ? "compressed" : "pulled", 100 * std::abs(tension) / strength,
              pipeline::readable(std::abs(tension)), pipeline::readable(strength), 100 * limit,
              place_words(at.place[cable]), moment_of(strain, at.sample[cable]))));
    }
  }
  if (own.moment <= limit) {
    const std::vector<Load> loads = loads_by(moment_load);
    const VariedLimit varied(strain, job, all, own.moment / limit, loads);
    if (!varied.causes().empty()) {
      const VariedForces& at = all[varied.causes().front().at];
      const std::size_t span = varied.causes().front().load.of, cable = at.moment_place[2 * span + 1];
      const double tension = at.moment_tension[span];
      warnings.push_back(warning_at(
          job, cables, varied, all, cable, tension,
          fmt::format(
              "the cables bend a clamp with {:.2g} times the moment of the hose ({} of {} N m, limit {:g} times) {}, which is "
              "unrealistic; '{}' {} most, with {} N",
              at.moment[2 * span] / at.moment[2 * span + 1], pipeline::readable(at.moment[2 * span]),
              pipeline::readable(at.moment[2 * span + 1]), limit, moment_of(strain, at.moment_place[2 * span]),
              cables.facts[cable].name, tension < 0 ? "presses" : "pulls", pipeline::readable(std::abs(tension)))));
    }
  }
  return warnings;
}

}  // namespace dresslife::fatigue
