#include "pipeline/search/surrogate_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

namespace dresslife::pipeline {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double first_width = 0.3, most_width = 0.5, least_width = 1e-4;  // half a side of the trust region
constexpr int hits_to_widen = 3, least_misses_to_narrow = 4;
constexpr double near = 1e-6;  // places nearer than that are one
constexpr int candidate_count = 200, polish_evaluations = 150, shape_evaluations = 60;
constexpr double moved_at_once = 6;  // variables of a candidate that differ from the best look, on average
constexpr std::size_t screened_at_once = 24;

/// (Q3), no further than any limit matters.
double tamed(double g) {
  constexpr double far_kept = -1, far_beyond = 20;
  const double bounded = std::clamp(g, far_kept, far_beyond);
  return std::copysign(std::log1p(std::abs(bounded)), bounded);
}

/// Whether a limit is worth a model: it is not the same for all looks.
bool varies(const VectorXd& values) { return values.maxCoeff() - values.minCoeff() > 1e-9; }

const Look& best_of(const std::vector<Look>& looks) {
  return *std::min_element(looks.begin(), looks.end(), better);
}

MatrixXd places_of(const std::vector<const Look*>& looks) {
  MatrixXd rows(static_cast<Index>(looks.size()), looks.front()->place.size());
  for (std::size_t k = 0; k < looks.size(); ++k) rows.row(static_cast<Index>(k)) = looks[k]->place.transpose();
  return rows;
}

/// (look) of the numbers that `of` tells of each.
template <class Of>
VectorXd numbers_of(const std::vector<const Look*>& looks, const Of& of) {
  VectorXd numbers(static_cast<Index>(looks.size()));
  for (std::size_t k = 0; k < looks.size(); ++k) numbers[static_cast<Index>(k)] = of(*looks[k]);
  return numbers;
}

SearchBox around(const VectorXd& centre, double width) {
  return {(centre.array() - width).max(0.0).matrix(), (centre.array() + width).min(1.0).matrix()};
}

}  // namespace

/// Of the aim, of each limit that some look came near, and of whether a job runs.
struct SurrogateSearch::Models {
  MatrixXd ran, all;                // (look, variable)
  VectorXd aim;                     // (look that ran)
  std::vector<VectorXd> limits;     // (limit)(look that ran)
  VectorXd failed;                  // (look) -1: it ran; else 1 and how far it was from that; empty: all ran
  std::vector<GaussianProcess::Shape> shapes;
  std::optional<GaussianProcess> of_aim, of_failure;
  std::vector<GaussianProcess> of_limits;
  bool any_feasible = false;

  explicit Models(const std::vector<Look>& looks);
  void fit(std::vector<GaussianProcess::Shape>& known);
  void build();
  void believe(const VectorXd& place);

  VectorXd beyond(const VectorXd& place, double deviations) const;
  double aim_at(const VectorXd& place, double deviations) const {
    const GaussianProcess::Told told = of_aim->at(place);
    return told.mean - deviations * told.deviation;
  }
};

SurrogateSearch::Models::Models(const std::vector<Look>& looks) {
  std::vector<const Look*> those, everyone;
  for (const Look& look : looks) {
    everyone.push_back(&look);
    if (look.ran) those.push_back(&look);
    any_feasible = any_feasible || look.feasible();
  }
  ran = places_of(those);
  all = places_of(everyone);
  aim = numbers_of(those, [](const Look& look) { return look.aims.front(); });
  for (std::size_t k = 0; k < those.front()->beyond.size(); ++k) {
    const VectorXd g = numbers_of(those, [k](const Look& look) { return tamed(look.beyond[k]); });
    if (varies(g)) limits.push_back(g);
  }
  if (those.size() < everyone.size())
    failed = numbers_of(everyone, [](const Look& look) { return look.ran ? -1 : 1 + tamed(look.violation()); });
}

void SurrogateSearch::Models::fit(std::vector<GaussianProcess::Shape>& known) {
  known.resize(limits.size() + 2, GaussianProcess::usual_shape(all.cols()));
  const auto refit = [](GaussianProcess::Shape& shape, const MatrixXd& points, const VectorXd& values) {
    shape = GaussianProcess::likeliest_shape(points, values, shape, shape_evaluations);
  };
  refit(known[0], ran, aim);
  if (failed.size() > 0) refit(known[1], all, failed);
  for (std::size_t k = 0; k < limits.size(); ++k) refit(known[k + 2], ran, limits[k]);
  shapes = known;
}

void SurrogateSearch::Models::build() {
  of_aim.emplace(ran, aim, shapes[0]);
  if (failed.size() > 0) of_failure.emplace(all, failed, shapes[1]);
  of_limits.clear();
  for (std::size_t k = 0; k < limits.size(); ++k) of_limits.emplace_back(ran, limits[k], shapes[k + 2]);
}

/// As if the place had been looked at and been as expected, so that the next pick goes elsewhere.
void SurrogateSearch::Models::believe(const VectorXd& place) {
  const auto longer = [](VectorXd& values, double value) {
    values.conservativeResize(values.size() + 1);
    values[values.size() - 1] = value;
  };
  longer(aim, of_aim->at(place).mean);
  for (std::size_t k = 0; k < limits.size(); ++k) longer(limits[k], of_limits[k].at(place).mean);
  if (failed.size() > 0) longer(failed, of_failure->at(place).mean);
  for (MatrixXd* places : {&ran, &all}) {
    places->conservativeResize(places->rows() + 1, Eigen::NoChange);
    places->row(places->rows() - 1) = place.transpose();
  }
  build();
}

VectorXd SurrogateSearch::Models::beyond(const VectorXd& place, double deviations) const {
  const auto limits_of = static_cast<Index>(of_limits.size());
  VectorXd g(limits_of + (of_failure ? 1 : 0));
  const auto bound = [&](const GaussianProcess& model) {
    const GaussianProcess::Told told = model.at(place);
    return told.mean + deviations * told.deviation;
  };
  for (Index k = 0; k < limits_of; ++k) g[k] = bound(of_limits[static_cast<std::size_t>(k)]);
  if (of_failure) g[limits_of] = bound(*of_failure);
  return g;
}

SurrogateSearch::SurrogateSearch(Index variables, const SurrogateSettings& settings, Screen screen)
    : variables_(variables),
      settings_(settings),
      screen_(std::move(screen)),
      numbers_(settings.seed) {
  if (settings_.first_looks == 0) settings_.first_looks = static_cast<int>(2 * variables + 2);
  if (settings_.aims == 1)
    regions_ = {{1, first_width}};
  else
    for (const double weight : {1.0, 0.5, 0.8, 0.2, 0.9}) regions_.push_back({weight, first_width});
}

/// Far from all looks, and not rejected where that is possible.
VectorXd SurrogateSearch::first_look() {
  constexpr int drawn = 40;
  std::vector<VectorXd> some;
  for (int k = 0; k < drawn; ++k) {
    VectorXd place(variables_);
    for (double& u : place) u = numbers_.uniform();
    some.push_back(std::move(place));
  }
  const auto distance = [&](const VectorXd& place) {
    double least = static_cast<double>(variables_);
    for (const Look& look : looks_) least = std::min(least, (look.place - place).squaredNorm());
    for (const VectorXd& other : pending_) least = std::min(least, (other - place).squaredNorm());
    return least;
  };
  const std::vector<double> beyond = screen_(some);
  std::size_t best = 0;
  for (std::size_t k = 1; k < some.size(); ++k)
    if (beyond[k] < beyond[best] || (beyond[k] == beyond[best] && distance(some[k]) > distance(some[best]))) best = k;
  return some[best];
}

bool SurrogateSearch::is_known(const VectorXd& place) const {
  const auto same = [&](const VectorXd& other) { return (other - place).cwiseAbs().maxCoeff() < near; };
  return std::any_of(looks_.begin(), looks_.end(), [&](const Look& look) { return same(look.place); }) ||
         std::any_of(pending_.begin(), pending_.end(), same);
}

/// A share of the variables, at least one, lie anywhere in the box, the others as at the centre.
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

/// The first that is neither known nor rejected; if all are rejected, the one that is least.
VectorXd SurrogateSearch::allowed(const std::vector<VectorXd>& by_merit) {
  std::vector<VectorXd> some;
  for (const VectorXd& place : by_merit)
    if (some.size() < screened_at_once && !is_known(place)) some.push_back(place);
  if (some.empty()) return first_look();
  const std::vector<double> beyond = screen_(some);
  return some[static_cast<std::size_t>(std::min_element(beyond.begin(), beyond.end()) - beyond.begin())];
}

VectorXd SurrogateSearch::pick(const Models& models, const VectorXd& best, double width, const Trust& trust) {
  const SearchBox box = trust.anywhere ? SearchBox{VectorXd::Zero(variables_), VectorXd::Ones(variables_)} : around(best, width);
  const auto excess = [&](const VectorXd& place) {
    return models.beyond(place, trust.of_limits).cwiseMax(0.0).sum();
  };
  const auto aim = [&](const VectorXd& place) {
    return models.any_feasible ? models.aim_at(place, trust.of_aim) : excess(place);
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
  if (models.any_feasible) {
    limits.count = static_cast<int>(models.beyond(best, 0).size());
    limits.beyond = [&](const VectorXd& place) { return models.beyond(place, trust.of_limits); };
  }
  const double step = 0.2 * (box.high - box.low).maxCoeff();
  rank(minimised(aim, limits, box, std::get<2>(some.front()), step, polish_evaluations));
  std::stable_sort(some.begin(), some.end(), better_one);
  std::vector<VectorXd> by_merit;
  for (Ranked& one : some) by_merit.push_back(std::move(std::get<2>(one)));
  return allowed(by_merit);
}

/// The looks with one aim made of two: the larger of both, each as a share of what it spans among the best, weighed;
/// and a little of their sum (J. Knowles, ParEGO, IEEE Trans. Evolutionary Computation 10 (2006) 50).
std::vector<Look> SurrogateSearch::by_weight(double weight) const {
  std::vector<Look> looks = looks_;
  if (settings_.aims == 1) return looks;
  const bool any_feasible = std::any_of(looks.begin(), looks.end(), [](const Look& look) { return look.feasible(); });
  std::array<double, 2> low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
  for (const Look& look : looks)
    for (std::size_t k = 0; look.ran && look.feasible() == any_feasible && k < 2; ++k) {
      low[k] = std::min(low[k], look.aims[k]);
      high[k] = std::max(high[k], look.aims[k]);
    }
  for (Look& look : looks) {
    if (!look.ran) continue;
    const auto share = [&](std::size_t k) { return (look.aims[k] - low[k]) / std::max(high[k] - low[k], near); };
    constexpr double of_sum = 0.05;
    const double a = weight * share(0), b = (1 - weight) * share(1);
    look.aims = {std::max(a, b) + of_sum * (a + b)};
  }
  return looks;
}

std::vector<VectorXd> SurrogateSearch::ask(int count) {
  std::vector<VectorXd> places;
  const auto take = [&](VectorXd place) {
    pending_.push_back(place);
    places.push_back(std::move(place));
    ++asked_;
  };
  const auto wanted = static_cast<std::size_t>(count);
  const bool any_ran = std::any_of(looks_.begin(), looks_.end(), [](const Look& look) { return look.ran; });
  while (places.size() < wanted && (!any_ran || asked_ < settings_.first_looks)) take(first_look());
  if (places.size() == wanted) return places;

  region_ = (region_ + 1) % regions_.size();
  const std::vector<Look> looks = by_weight(regions_[region_].weight);
  Models models(looks);
  models.fit(shapes_);
  models.build();
  for (const VectorXd& place : pending_) models.believe(place);
  const VectorXd best = best_of(looks).place;
  while (places.size() < wanted) {
    static constexpr Trust trusts[] = {{0, 0, false}, {1, 1, false}, {1, -1, false}, {2, 0, true}};
    const Trust& trust = trusts[static_cast<std::size_t>(picks_++) % std::size(trusts)];
    take(pick(models, best, regions_[region_].width, trust));
    if (places.size() < wanted) models.believe(places.back());
  }
  return places;
}

void SurrogateSearch::tell(const std::vector<Look>& looks) {
  Region& region = regions_[region_];
  const std::size_t before = looks_.size();
  looks_.insert(looks_.end(), looks.begin(), looks.end());
  pending_.clear();
  if (picks_ == 0 || before == 0) return;
  const std::vector<Look> now = by_weight(region.weight);
  const auto old_end = now.begin() + static_cast<std::ptrdiff_t>(before);
  const Look& old = *std::min_element(now.begin(), old_end, better);
  const bool hit = std::any_of(old_end, now.end(), [&](const Look& look) { return better(look, old); });
  region.hits = hit ? region.hits + 1 : 0;
  region.misses = hit ? 0 : region.misses + static_cast<int>(looks.size());
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
