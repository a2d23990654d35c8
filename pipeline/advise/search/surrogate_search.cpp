#include "pipeline/advise/search/surrogate_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "pipeline/base/lists.h"

namespace dresslife::pipeline {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double first_width = 0.3, most_width = 0.5, least_width = 1e-4;  // half a side of the trust region
constexpr int hits_to_widen = 3, least_misses_to_narrow = 4;
constexpr double near = 1e-6;  // places with a smaller distance are equal
constexpr int candidate_count = 200, polish_evaluations = 150;
constexpr double moved_at_once = 6;  // mean number of variables in which a candidate differs from the best one
constexpr std::size_t screened_at_once = 24;
constexpr std::size_t short_runs_per_candidate = 4;
constexpr int short_runs_together = 8;
constexpr int short_runs_again =
    24;  // per evaluation while none is feasible; together they take about as long as an evaluation
// one of this number among the first evaluations is spread, because feasible places may have no common region
constexpr int spread_share = 4;
constexpr double cautious = 1;        // deviations of the constraints while no candidate is feasible
constexpr double least_ahead = 0.02;  // smallest width; below it the search starts again at another place
// Violation of a hopeless search: a bend of half the least radius (ln 2). In searches of better_hard and
// better_side_panel, three seeds each, the smallest violation of the short runs was at most 0.64 after 27 of 480, and 0.16
// after a third of them.
constexpr double hopeless = 0.7;
constexpr double least_gain = 1e-3;  // smallest gain of a constraint that counts as progress
constexpr double much_more = 1.3;    // ratio of the number of data that causes a new fit of the shapes

const Candidate& best_of(const std::vector<Candidate>& candidates) {
  return *std::min_element(candidates.begin(), candidates.end(), better);
}

/// Smaller is better.
using Merit = std::pair<double, double>;

/// Returns the order by predicted violation: first the mean, then the cautious bound.
Merit nearness(const CandidateModels& models, const VectorXd& place) {
  return {models.excess(place, 0), models.excess(place, cautious)};
}
bool clearly_less(const Merit& a, const Merit& b) {
  return a.first < b.first - least_gain || (a.first <= b.first && a.second < b.second - least_gain);
}

bool any_ran(const std::vector<Candidate>& candidates) {
  return std::any_of(candidates.begin(), candidates.end(), [](const Candidate& candidate) { return candidate.ran; });
}

SearchBox around(const VectorXd& centre, double width) {
  return {(centre.array() - width).max(0.0).matrix(), (centre.array() + width).min(1.0).matrix()};
}

}  // namespace

SurrogateSearch::SurrogateSearch(Index variables, const SurrogateSettings& settings, Screen screen,
                                 ShortRuns make_short_runs)
    : variables_(variables),
      settings_(settings),
      screen_(std::move(screen)),
      make_short_runs_(std::move(make_short_runs)),
      numbers_(settings.seed),
      ahead_width_(first_width) {
  if (settings_.first_candidates == 0) settings_.first_candidates = static_cast<int>(2 * variables + 2);
  if (settings_.short_runs == 0) settings_.short_runs = static_cast<int>(40 * variables);
  if (settings_.aims == 1)
    regions_ = {{1, first_width}};
  else
    for (const double weight : {1.0, 0.5, 0.8, 0.2, 0.9}) regions_.push_back({weight, first_width});
}

/// Returns a place far from all candidates, and not rejected by the screen if possible.
VectorXd SurrogateSearch::first_candidate() {
  constexpr int drawn = 40;
  std::vector<VectorXd> some;
  for (int k = 0; k < drawn; ++k) {
    VectorXd place(variables_);
    for (double& u : place) u = numbers_.uniform();
    some.push_back(std::move(place));
  }
  const std::vector<double> beyond = make_short_runs_ ? std::vector<double>(some.size(), 0.0) : screen_(some);
  std::size_t best = 0;
  for (std::size_t k = 1; k < some.size(); ++k)
    if (beyond[k] < beyond[best] ||
        (beyond[k] == beyond[best] && distance_to_known(some[k]) > distance_to_known(some[best])))
      best = k;
  return some[best];
}

/// Returns the squared distance to the nearest candidate with or without a result.
double SurrogateSearch::distance_to_known(const VectorXd& place) const {
  const auto away = [&](const VectorXd& other) { return (other - place).squaredNorm(); };
  const double of_evaluated = smallest_of(evaluated_, static_cast<double>(variables_),
                                          [&](const Candidate& candidate) { return away(candidate.place); });
  return smallest_of(pending_, of_evaluated, away);
}

bool SurrogateSearch::is_known(const VectorXd& place) const {
  const auto same = [&](const VectorXd& other) { return (other - place).cwiseAbs().maxCoeff() < near; };
  return std::any_of(evaluated_.begin(), evaluated_.end(),
                     [&](const Candidate& candidate) { return same(candidate.place); }) ||
         std::any_of(pending_.begin(), pending_.end(), same);
}

/// Returns candidates: a share of the variables, at least one, are anywhere in the box, the others equal those of the centre.
std::vector<VectorXd> SurrogateSearch::candidates(const SearchBox& box, const VectorXd& centre, double share) {
  std::vector<VectorXd> some;
  while (some.size() < candidate_count) {
    VectorXd place = centre;
    const auto certain = static_cast<Index>(numbers_.uniform() * static_cast<double>(variables_));
    for (Index i = 0; i < variables_; ++i)
      if (i == certain || numbers_.uniform() < share)
        place[i] = box.low[i] + numbers_.uniform() * (box.high[i] - box.low[i]);
    some.push_back(std::move(place));
  }
  return some;
}

/// Returns the first place that is neither known nor rejected; if all are rejected, the one with the smallest violation.
VectorXd SurrogateSearch::allowed(const std::vector<VectorXd>& by_merit) {
  std::vector<VectorXd> some;
  for (const VectorXd& place : by_merit)
    if (some.size() < screened_at_once && !is_known(place)) some.push_back(place);
  if (some.empty()) return first_candidate();
  const std::vector<double> beyond = screen_(some);
  return some[static_cast<std::size_t>(std::min_element(beyond.begin(), beyond.end()) - beyond.begin())];
}

/// Returns places around the best one, and results of local searches from them, sorted by violation, then by objective.
std::vector<VectorXd> SurrogateSearch::ranked(const CandidateModels& models, const VectorXd& best, double width,
                                              const Trust& trust) {
  const SearchBox whole{VectorXd::Zero(variables_), VectorXd::Ones(variables_)};
  const SearchBox box = trust.anywhere ? whole : around(best, width);
  const auto excess = [&](const VectorXd& place) { return models.excess(place, trust.of_limits); };
  const auto aim = [&](const VectorXd& place) {
    return models.any_feasible() ? models.aim_at(place, trust.of_aim) : excess(place);
  };
  using Ranked = std::tuple<double, double, VectorXd>;
  std::vector<Ranked> some;
  const auto rank = [&](VectorXd place) { some.emplace_back(excess(place), aim(place), std::move(place)); };
  const double share = trust.anywhere ? 1 : std::min(1.0, moved_at_once / static_cast<double>(variables_));
  for (VectorXd& place : candidates(box, best, share)) rank(std::move(place));
  const auto better_one = [](const Ranked& a, const Ranked& b) {
    return std::tie(std::get<0>(a), std::get<1>(a)) < std::tie(std::get<0>(b), std::get<1>(b));
  };
  std::stable_sort(some.begin(), some.end(), better_one);

  LimitFunctions limits;
  if (models.any_feasible()) {
    limits.count = static_cast<int>(models.beyond(best, 0).size());
    limits.beyond = [&](const VectorXd& place) { return models.beyond(place, trust.of_limits); };
  }
  const double step = 0.2 * (box.high - box.low).maxCoeff();
  rank(minimised(aim, limits, box, std::get<2>(some.front()), step, polish_evaluations));
  std::stable_sort(some.begin(), some.end(), better_one);
  return mapped(some, [](Ranked& one) { return std::move(std::get<2>(one)); });
}

bool SurrogateSearch::has_short_run(const VectorXd& place) const {
  return std::any_of(short_runs_.begin(), short_runs_.end(),
                     [&](const Candidate& one) { return (one.place - place).cwiseAbs().maxCoeff() < near; });
}

void SurrogateSearch::make_short_runs(const std::vector<VectorXd>& places) {
  for (Candidate& made : make_short_runs_(places)) short_runs_.push_back(std::move(made));
}

/// Makes short runs of candidates that were evaluated without one, so that the difference is known at their places.
void SurrogateSearch::make_runs_of_evaluated(const std::vector<Candidate>& candidates) {
  std::vector<VectorXd> places;
  for (const Candidate& candidate : candidates)
    if (!has_short_run(candidate.place)) places.push_back(candidate.place);
  if (!places.empty()) make_short_runs(places);
}

/// Makes short runs at the first few places, then returns the best of all places with a short run by the new models.
VectorXd SurrogateSearch::pick_by_short_runs(CandidateModels& models, const std::vector<VectorXd>& by_merit,
                                             const Trust& trust) {
  std::vector<VectorXd> some;
  for (const VectorXd& place : by_merit)
    if (some.size() < short_runs_per_candidate && !is_known(place) && !has_short_run(place)) some.push_back(place);
  const auto before = static_cast<std::ptrdiff_t>(short_runs_.size());
  make_short_runs(some);
  models.learn({short_runs_.begin() + before, short_runs_.end()});
  Merit least;
  const Candidate* best = nullptr;
  for (const Candidate& short_run : short_runs_) {
    if (is_known(short_run.place) || !short_run.ran || !models.holds(short_run.place)) continue;
    const Merit merit = models.any_feasible() ? Merit{models.excess(short_run.place, trust.of_limits),
                                                      models.aim_at(short_run.place, trust.of_aim)}
                                              : nearness(models, short_run.place);
    if (!best || merit < least) least = merit, best = &short_run;
  }
  return best ? best->place : first_candidate();
}

/// Returns places with a short run and without a full evaluation, most likely feasible first.
std::vector<VectorXd> SurrogateSearch::promising(const CandidateModels& models) const {
  std::vector<VectorXd> places;
  for (const Candidate& short_run : short_runs_)
    if (short_run.ran && !is_known(short_run.place) && models.holds(short_run.place) &&
        models.excess(short_run.place, cautious) == 0)
      places.push_back(short_run.place);
  return places;
}

/// Returns the short run from `first` on that runs and has the smallest predicted violation. Precondition: at least one ran.
VectorXd SurrogateSearch::nearest_short_run(const CandidateModels& models, std::size_t first) const {
  Merit least;
  const Candidate* nearest = nullptr;
  for (std::size_t k = first; k < short_runs_.size(); ++k) {
    const Candidate& short_run = short_runs_[k];
    if (!short_run.ran || !models.holds(short_run.place)) continue;
    const Merit merit = nearness(models, short_run.place);
    if (!nearest || merit < least) least = merit, nearest = &short_run;
  }
  return nearest->place;
}

std::vector<Candidate> SurrogateSearch::short_runs_from(std::size_t first) const {
  return {short_runs_.begin() + static_cast<std::ptrdiff_t>(first), short_runs_.end()};
}

/// Makes `count` short runs, far from each other and from all candidates. The search starts at the best of them.
void SurrogateSearch::make_spread_runs(int count) {
  ahead_from_ = short_runs_.size();
  ahead_width_ = first_width;
  std::vector<VectorXd> spread;
  while (static_cast<int>(spread.size()) < count) {
    spread.push_back(first_candidate());
    pending_.push_back(spread.back());
  }
  pending_.clear();
  make_short_runs(spread);
}

/// Returns the next short runs, each at the smallest predicted violation, given the expected results of the earlier ones.
std::vector<VectorXd> SurrogateSearch::next_short_runs(CandidateModels& models, const VectorXd& centre,
                                                       std::size_t count) {
  static constexpr Trust trusts[] = {{0, 0, false}, {0, cautious, false}, {0, -1, false}, {0, 0, true}};
  std::vector<VectorXd> batch;
  while (batch.size() < count) {
    const std::vector<VectorXd> some = ranked(models, centre, ahead_width_, trusts[batch.size() % std::size(trusts)]);
    const auto is_new = [&](const VectorXd& place) { return !is_known(place) && !has_short_run(place); };
    const auto found = std::find_if(some.begin(), some.end(), is_new);
    batch.push_back(found == some.end() ? first_candidate() : *found);
    models.believe_short_run(batch.back());
  }
  return batch;
}

/// Returns whether no result is near feasibility after a third of the short runs before the first evaluation.
bool SurrogateSearch::is_hopeless() const {
  const auto misses = [](const Candidate& candidate) { return !candidate.ran || candidate.violation() > hopeless; };
  return asked_ == 0 &&
         static_cast<int>(short_runs_.size()) >= std::max(settings_.short_runs / 3, settings_.first_candidates) &&
         std::all_of(short_runs_.begin(), short_runs_.end(), misses) &&
         std::all_of(evaluated_.begin(), evaluated_.end(), misses);
}

/// Makes short runs near feasibility by (Q6).
void SurrogateSearch::make_runs_ahead(int wanted) {
  int left = asked_ == 0 ? settings_.short_runs : short_runs_again * wanted;
  const auto spread = [&] {
    const int count = std::min(settings_.first_candidates, left);
    make_spread_runs(count);
    left -= count;
  };
  if (asked_ == 0) spread();
  while (asked_ == 0 && left > 0 && !any_ran(short_runs_) && !is_hopeless()) spread();
  Merit nearest;
  bool has_nearest = false;
  while (left > 0 && any_ran(short_runs_) && !is_hopeless()) {
    if (ahead_width_ < least_ahead || !any_ran(short_runs_from(ahead_from_))) {
      spread();
      has_nearest = false;
      continue;
    }
    CandidateModels models = models_of(evaluated_, ahead_from_);
    if (models.any_feasible() || static_cast<int>(promising(models).size()) >= wanted) return;
    const VectorXd centre = nearest_short_run(models, ahead_from_);
    const Merit now = nearness(models, centre);
    if (has_nearest)
      ahead_width_ = clearly_less(now, nearest) ? std::min(most_width, 1.5 * ahead_width_) : 0.7 * ahead_width_;
    nearest = now;
    has_nearest = true;
    const int count = std::min(short_runs_together, left);
    make_short_runs(next_short_runs(models, centre, static_cast<std::size_t>(count)));
    left -= count;
  }
}

/// Returns the results with one objective made of two: the larger of both, each weighted and as a share of its range among the
/// best, plus a small part of their sum (J. Knowles, ParEGO, IEEE Trans. Evolutionary Computation 10 (2006) 50).
std::vector<Candidate> SurrogateSearch::by_weight(double weight) const {
  std::vector<Candidate> candidates = evaluated_;
  if (settings_.aims == 1) return candidates;
  const bool any_feasible = std::any_of(candidates.begin(), candidates.end(),
                                        [](const Candidate& candidate) { return candidate.feasible(); });
  std::array<double, 2> low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
  for (const Candidate& candidate : candidates)
    for (std::size_t k = 0; candidate.ran && candidate.feasible() == any_feasible && k < 2; ++k) {
      low[k] = std::min(low[k], candidate.aims[k]);
      high[k] = std::max(high[k], candidate.aims[k]);
    }
  for (Candidate& candidate : candidates) {
    if (!candidate.ran) continue;
    const auto share = [&](std::size_t k) { return (candidate.aims[k] - low[k]) / std::max(high[k] - low[k], near); };
    constexpr double of_sum = 0.05;
    const double a = weight * share(0), b = (1 - weight) * share(1);
    candidate.aims = {std::max(a, b) + of_sum * (a + b)};
  }
  return candidates;
}

/// Returns models of the results, and of the short runs from `first` on near the best known place. The shapes are fitted again
/// after the number of data has grown by the factor much_more.
CandidateModels SurrogateSearch::models_of(const std::vector<Candidate>& candidates, std::size_t first) {
  const bool by_results = !any_ran(short_runs_) || (!candidates.empty() && best_of(candidates).feasible());
  const std::vector<Candidate> those = by_results ? candidates : short_runs_from(first);
  CandidateModels models(candidates, short_runs_, best_of(those).place, shapes_);
  const auto known = static_cast<double>(candidates.size() + short_runs_.size());
  if (candidates.size() != shapes_of_evaluated_ || known > much_more * shapes_of_) {
    models.fit();
    shapes_ = models.shapes();
    shapes_of_evaluated_ = candidates.size();
    shapes_of_ = known;
  }
  return models;
}

/// Returns a promising place that is farthest from all candidates, for the first few evaluations of a search with short runs.
std::optional<VectorXd> SurrogateSearch::spread_candidate(const CandidateModels& models) const {
  std::optional<VectorXd> farthest;
  double most = -1;
  for (const VectorXd& place : promising(models))
    if (const double distance = distance_to_known(place); distance > most) most = distance, farthest = place;
  return farthest;
}

std::vector<VectorXd> SurrogateSearch::ask(int count) {
  std::vector<VectorXd> places;
  const auto take = [&](VectorXd place) {
    pending_.push_back(place);
    places.push_back(std::move(place));
    ++asked_;
  };
  const auto wanted = static_cast<std::size_t>(count);
  if (make_short_runs_) make_runs_ahead(count);
  if (make_short_runs_ && is_hopeless()) return {};
  const bool can_model = any_ran(evaluated_) || any_ran(short_runs_);
  while (places.size() < wanted && (!can_model || (!make_short_runs_ && asked_ < settings_.first_candidates)))
    take(first_candidate());
  if (places.size() == wanted) return places;

  region_ = (region_ + 1) % regions_.size();
  const std::vector<Candidate> candidates = by_weight(regions_[region_].weight);
  CandidateModels models = models_of(candidates);
  for (const VectorXd& place : pending_) models.believe(place);
  const bool by_results = models.any_feasible() || !any_ran(short_runs_);
  const VectorXd best = by_results ? best_of(candidates).place : nearest_short_run(models);
  while (places.size() < wanted) {
    static constexpr Trust trusts[] = {{0, 0, false}, {1, 1, false}, {1, -1, false}, {2, 0, true}};
    std::optional<VectorXd> place;
    if (make_short_runs_ && asked_ < settings_.first_candidates / spread_share) place = spread_candidate(models);
    if (!place) {
      const Trust& trust = trusts[static_cast<std::size_t>(picks_++) % std::size(trusts)];
      const std::vector<VectorXd> by_merit = ranked(models, best, regions_[region_].width, trust);
      place = make_short_runs_ ? pick_by_short_runs(models, by_merit, trust) : allowed(by_merit);
    }
    take(std::move(*place));
    if (places.size() < wanted) models.believe(places.back());
  }
  return places;
}

void SurrogateSearch::tell(const std::vector<Candidate>& candidates) {
  Region& region = regions_[region_];
  const std::size_t before = evaluated_.size();
  evaluated_.insert(evaluated_.end(), candidates.begin(), candidates.end());
  pending_.clear();
  if (make_short_runs_) make_runs_of_evaluated(candidates);
  if (picks_ == 0 || before == 0) return;
  const std::vector<Candidate> now = by_weight(region.weight);
  const auto old_end = now.begin() + static_cast<std::ptrdiff_t>(before);
  const Candidate& old = *std::min_element(now.begin(), old_end, better);
  const bool hit = std::any_of(old_end, now.end(), [&](const Candidate& candidate) { return better(candidate, old); });
  region.hits = hit ? region.hits + 1 : 0;
  region.misses = hit ? 0 : region.misses + static_cast<int>(candidates.size());
  if (region.hits == hits_to_widen) {
    region.width = std::min(most_width, 2 * region.width);
    region.hits = 0;
  }
  if (region.misses >= std::max<int>(least_misses_to_narrow, static_cast<int>(variables_))) {
    region.width = region.width < least_width ? first_width : region.width / 2;
    region.misses = 0;
  }
}

}  // namespace dresslife::pipeline
