#include "strain/variations.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace dresslife::strain {
namespace {

std::size_t largest(const std::vector<double>& values) {
  return static_cast<std::size_t>(
      std::ranges::max_element(values, [](double a, double b) { return std::abs(a) < std::abs(b); }) - values.begin());
}

}  // namespace

VariedPulls varied_pulls(const std::vector<std::unique_ptr<Evaluation>>& spans, const Shortening& shortening) {
  VariedPulls all;
  for (const auto& evaluation : spans) {
    if (!evaluation->any_cables()) continue;
    const CablePaths& cables = evaluation->cables();
    const bool whole = evaluation->samples() != shortening.samples();
    const auto in_motion = [&](std::size_t sample) {
      return static_cast<std::uint32_t>(whole ? sample : shortening.in_motion(sample));
    };
    std::vector<pipeline::PulledCable> pulled;
    for (std::size_t k = 0; k < cables.cables(); ++k) pulled.push_back(cables.pulled(k));
    const pipeline::CablePulls pulls = pipeline::pulls_of(pulled, evaluation->samples());
    const auto first = static_cast<std::uint32_t>(all.tension.size());
    const double begin = evaluation->arcs().front() - evaluation->lengths().front() / 2;
    for (std::size_t k = 0; k < pulls.tension.size(); ++k) {
      const std::size_t at = largest(pulls.tension[k]);
      const double place = cables.place_of_force(k, at);
      all.tension.push_back(pulls.tension[k][at]);
      all.sample.push_back(in_motion(at));
      all.place.push_back(place < 0 ? place : begin + place);
    }
    const std::size_t bent = largest(pulls.moment);
    std::size_t bender = 0;
    for (std::size_t k = 1; k < pulls.tension.size(); ++k)
      if (std::abs(pulls.tension[k][bent]) > std::abs(pulls.tension[bender][bent])) bender = k;
    const std::vector<double>& of_hose = cables.hose_moment();
    all.moment.insert(all.moment.end(), {pulls.moment[bent], of_hose[largest(of_hose)]});
    all.moment_place.insert(all.moment_place.end(), {in_motion(bent), first + static_cast<std::uint32_t>(bender)});
    all.moment_tension.push_back(pulls.tension[bender][bent]);
  }
  return all;
}

namespace {

using pipeline::Inside;
using pipeline::Uncertain;

// With little slack cables become tight, and lives fall by decades from one tenth of a per cent of slack to the next. How much
// slack they need depends on the hose's stiffness.
constexpr double low_slack = -2.25;

bool any_component(const pipeline::Job& job, const std::function<bool(const pipeline::Component&)>& holds) {
  return std::ranges::any_of(job.dresspacks, [&](const pipeline::MountedDresspack& mounted) {
    return std::ranges::any_of(mounted.dresspack.components, holds);
  });
}

bool has_slack(const pipeline::Component& part) { return part.laying.slack > 0; }
bool has_grip(const pipeline::Component& part) { return part.laying.base_grip || part.laying.tool_grip; }

/// Returns whether cables rub in a dresspack with or without a hose around them. On a hose they have the friction along the hose,
/// otherwise the friction inside (Construction::scale()).
bool any_cable_rubs(const pipeline::Job& job, bool in_hose) {
  return rubs(job.strain.slip.front()) && std::ranges::any_of(job.dresspacks, [&](const auto& mounted) {
           return pipeline::inner_radius(mounted.dresspack).has_value() == in_hose &&
                  std::ranges::any_of(mounted.dresspack.components, [](const pipeline::Component& part) {
                    return !part.components.empty() && part.friction.value_or(0) > 0;
                  });
         });
}

// z of the nodes
constexpr std::array slacks{low_slack, -1.25, Variations::reach};
constexpr std::array slacks_of_other_stiffness{-1.25, Variations::reach};
constexpr std::array both_sides{-Variations::reach, Variations::reach};

/// Returns whether a parameter other than friction inside is unknown, and the job has parts whose places depend on it.
bool is_varied(const pipeline::Job& job, Uncertain parameter) {
  if (!job.uncertainty.enabled || pipeline::is_known(job.uncertainty, parameter)) return false;
  if (parameter == Uncertain::slack) return any_component(job, has_slack);
  if (parameter == Uncertain::grip) return any_component(job, has_grip);
  return any_cable_rubs(job, true);
}

/// Returns the job's factors with one strain parameter at z.
pipeline::StrainFactors moved(pipeline::StrainFactors factors, Uncertain parameter, double z) {
  const double by = pipeline::uncertain_parameters()[index_of(parameter)].value(z);
  switch (parameter) {
    case Uncertain::friction_inside:
      factors.friction *= by;
      break;
    case Uncertain::friction_hose:
      factors.hose_friction *= by;
      break;
    case Uncertain::slack:
      factors.slack *= by;
      break;
    case Uncertain::play:
      factors.play *= by;
      break;
    case Uncertain::grip:
      factors.grip *= by;
      break;
    case Uncertain::rest:
    case Uncertain::hose_stiffness:
    case Uncertain::strength:
    case Uncertain::slope:
    case Uncertain::scatter:
    case Uncertain::model:
    case Uncertain::motion:
      break;  // does not change the places of cables
  }
  return factors;
}

/// Returns `likely` and the likely worst wires of an evaluation whose cables lie elsewhere, sorted, without duplicates.
/// Segments as in Evaluation::likely_of_bent().
std::vector<Evaluation::Site> with_likely_of_bent(std::vector<Evaluation::Site> likely, Evaluation& placed,
                                                  std::size_t segment, const DeformationHistory& history,
                                                  std::size_t row) {
  const std::vector<Evaluation::Site>& own = placed.likely_of_bent(segment, history, row);
  likely.insert(likely.end(), own.begin(), own.end());
  std::ranges::sort(likely);
  likely.erase(std::unique(likely.begin(), likely.end()), likely.end());
  return likely;
}

}  // namespace

std::size_t placements_at_most(const pipeline::Job& job) {
  // z of friction inside that need their own places, alone and with another slack
  const bool rubbing = job.uncertainty.enabled && any_cable_rubs(job, false);
  const std::size_t alone = rubbing ? 3 : 0, with_slack = rubbing ? 2 : 0;
  return alone + (is_varied(job, Uncertain::slack) ? slacks.size() * (1 + with_slack) : 0) +
         (is_varied(job, Uncertain::grip) ? both_sides.size() : 0) +
         (is_varied(job, Uncertain::friction_hose) ? both_sides.size() : 0);
}

std::vector<Variations::Friction> Variations::other_frictions(const pipeline::Job& job, const Spans& spans) {
  const bool inside = std::ranges::any_of(spans, [](const auto& evaluation) { return evaluation->rubs_inside(); });
  std::vector<Friction> all;
  // Small values of friction are needed, because there lives bend toward those without damage.
  if (inside || any_cable_rubs(job, false)) all = {{-reach}, {-reach / 2}, {reach}};
  if (inside) all.insert(all.end(), {{0, Inside::glued}, {0, Inside::free}});
  return all;
}

Variations::Variations(const pipeline::Job& job, const Spans& as_given, const Shortening& shortening,
                       const Build& build)
    : enabled_(job.uncertainty.enabled), as_given_(as_given), shortening_(shortening) {
  if (!job.uncertainty.enabled) return;
  std::vector<Friction> all = other_frictions(job, as_given);
  if (!all.empty()) add(as_given, {}, all, rubbing(job, job.strain.factors, as_given, build));
  std::erase_if(all, [](const Friction& of) { return of.z == -reach / 2; });
  all.insert(all.begin(), Friction{});
  lay(job, build, Uncertain::slack, slacks, all);
  lay(job, build, Uncertain::friction_hose, both_sides, {{}});
  lay(job, build, Uncertain::grip, both_sides, {{}});
}

Variations::Variations(const pipeline::Job& job, double stiffness, const Spans& laid, const Shortening& shortening,
                       const Build& build)
    : enabled_(job.uncertainty.enabled), as_given_(laid), shortening_(shortening), stiffness_(stiffness) {
  std::vector<Friction> all = other_frictions(job, laid);
  all.insert(all.begin(), Friction{});
  add(laid, {}, all, rubbing(job, job.strain.factors, laid, build));
  std::erase_if(all, [](const Friction& of) { return of.z != 0; });  // the job's own friction, glued and free
  lay(job, build, Uncertain::slack, slacks_of_other_stiffness, all);
}

void Variations::lay(const pipeline::Job& job, const Build& build, Uncertain parameter, std::span<const double> nodes,
                     const std::vector<Friction>& friction) {
  const bool any_cables =
      std::ranges::any_of(as_given_, [](const auto& evaluation) { return evaluation->any_cables(); });
  if (!any_cables || !is_varied(job, parameter)) return;
  for (const double z : nodes) {
    Point point{};
    point[index_of(parameter)] = z;
    // Grips share the loose cables of as_given, which cost most, and so follow as many samples.
    const pipeline::StrainFactors factors = moved(job.strain.factors, parameter, z);
    const Spans& placed =
        build(factors, parameter == Uncertain::grip ? as_given_.front()->samples() : shortening_.samples());
    share_loose(placed, as_given_);
    add(placed, point, friction, rubbing(job, factors, placed, build));
  }
}

void Variations::share_loose(const Spans& spans, const Spans& others) {
  for (std::size_t span = 0; span < spans.size(); ++span)
    if (spans[span]->samples() == others[span]->samples()) spans[span]->share_loose(*others[span]);
}

Variations::Rubbing Variations::rubbing(const pipeline::Job& job, const pipeline::StrainFactors& factors,
                                        const Spans& spans, const Build& build) {
  if (!any_cable_rubs(job, false)) return nullptr;
  return [factors, &spans, &build](double z) -> const Spans& {
    const Spans& placed = build(moved(factors, Uncertain::friction_inside, z), spans.front()->samples());
    share_loose(placed, spans);
    return placed;
  };
}

void Variations::go_on() const {
  for (const Placement& placement : placements_)
    for (std::size_t span = 0; span < placement.spans->size(); ++span)
      if (placement.spans != &as_given_) (*placement.spans)[span]->go_on_from(*as_given_[span]);
}

void Variations::add(const Starts& starts) {
  if (!enabled_) return;
  for (Placement& placement : placements_)
    if (placement.spans != &as_given_)
      for (const std::size_t variation : placement.variation)
        rests_[variation] = static_cast<std::int32_t>(starts.rest_of_variations());
  for (std::size_t rest = 1; rest < starts.rests(); ++rest) {
    add(starts.spans(rest), {}, {{}}, nullptr);
    rests_.back() = static_cast<std::int32_t>(rest);
  }
}

double Variations::Friction::factor() const {
  if (inside == Inside::free) return 0;
  if (inside == Inside::glued) return ClampMeans::glued;
  return pipeline::uncertain_parameters()[index_of(Uncertain::friction_inside)].value(z);
}

void Variations::add(const Spans& spans, Point z, const std::vector<Friction>& friction, const Rubbing& rubbing) {
  Placement placement{&spans, {}, {}};
  for (const Friction& of : friction) {
    if (rubbing && of.z != 0) {
      placements_.push_back({&rubbing(of.z), {1}, {points_.size()}});
    } else {
      placement.factors.push_back(of.factor());
      placement.variation.push_back(points_.size());
    }
    z[index_of(Uncertain::friction_inside)] = of.z;
    points_.push_back(z);
    inside_.push_back(of.inside);
    rests_.push_back(0);
  }
  if (!placement.factors.empty()) placements_.push_back(std::move(placement));
}

std::vector<Evaluation*> Variations::placed(std::size_t span) const {
  std::vector<Evaluation*> all;
  for (const Placement& placement : placements_)
    if (placement.spans != &as_given_) all.push_back((*placement.spans)[span].get());
  return all;
}

bool Variations::lies_elsewhere(const Placement& placement) const {
  return placement.spans != &as_given_ || stiffness_ != 0;
}

void Variations::find_bent() const {
  for (const Placement& placement : placements_) {
    if (!lies_elsewhere(placement)) continue;
    for (const auto& evaluation : *placement.spans) evaluation->find_bent();
  }
}

std::vector<VariedPulls> Variations::pulls() const {
  std::vector<VariedPulls> all(points_.size());
  for (const Placement& placement : placements_) {
    const VariedPulls of = varied_pulls(*placement.spans, shortening_);
    for (const std::size_t variation : placement.variation) all[variation] = of;
  }
  return all;
}

void Variations::evaluate(const std::vector<Evaluation::Site>& likely, std::size_t span, std::size_t segment,
                          const DeformationHistory& history, std::size_t row, const Put& put) const {
  if (likely.empty() || placements_.empty()) return;
  std::optional<DeformationHistory> shortened;
  if (history.samples() != shortening_.samples()) shortened = shortening_.shortened(history.columns(row));
  for (const Placement& placement : placements_) {
    Evaluation& placed = *(*placement.spans)[span];
    const bool whole = placed.samples() != shortening_.samples();
    const DeformationHistory& own = whole || !shortened ? history : *shortened;
    const std::size_t own_row = &own == &history ? row : 0;
    std::vector<Evaluation::Site> wires = likely;
    if (lies_elsewhere(placement)) wires = with_likely_of_bent(std::move(wires), placed, segment, own, own_row);
    std::vector<std::size_t> sites;
    for (const Evaluation::Site site : wires) sites.push_back(as_given_[span]->row_of(segment, site));
    const std::vector<SiteRows> rows = placed.varied(wires, placement.factors, segment, own, own_row);
    for (std::size_t k = 0; k < rows.size(); ++k)
      put(placement.variation[k], sites, shortening_.any() && !whole ? shortening_.whole(rows[k]) : rows[k]);
  }
}

}  // namespace dresslife::strain
