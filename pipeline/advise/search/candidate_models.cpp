#include "pipeline/advise/search/candidate_models.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "pipeline/base/lists.h"

namespace dresslife::pipeline {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Shape = GaussianProcess::Shape;

namespace {

constexpr std::size_t most_short_runs = 250;  // in a model: the cost grows with the cube of their number
constexpr Index most_for_shape = 120;         // for a fit of the shapes: the same growth of cost
constexpr int shape_evaluations = 60;
constexpr double same = 1e-9;  // values and places with a smaller difference are equal

/// Returns (Q3) sign(g) ln(1 + |g|). NaN stays NaN.
double tamed(double g) {
  constexpr double far_kept = -1, far_beyond = 20;
  const double bounded = std::clamp(g, far_kept, far_beyond);
  return std::copysign(std::log1p(std::abs(bounded)), bounded);
}

constexpr GaussianProcess::Scale missed_by_short_runs{0.1, 3};

enum ShapeOf : std::size_t { of_aim, of_failure, of_limits };

Shape& shape_of(CandidateModels::Shapes& shapes, std::size_t limit, bool difference) {
  return shapes[of_limits + 2 * limit + (difference ? 1 : 0)];
}

/// Returns the short runs at places of results first, then those nearest to the centre.
std::vector<const Candidate*> chosen(const std::vector<Candidate>& short_runs, const std::vector<Candidate>& evaluated,
                                     const VectorXd& centre) {
  std::vector<std::pair<double, const Candidate*>> some;
  for (const Candidate& short_run : short_runs) {
    const auto is_here = [&](const Candidate& candidate) {
      return (candidate.place - short_run.place).cwiseAbs().maxCoeff() < same;
    };
    const bool is_evaluated = std::any_of(evaluated.begin(), evaluated.end(), is_here);
    some.emplace_back(is_evaluated ? -1 : (short_run.place - centre).squaredNorm(), &short_run);
  }
  std::stable_sort(some.begin(), some.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  if (some.size() > most_short_runs) some.resize(most_short_runs);
  return mapped(some, &std::pair<double, const Candidate*>::second);
}

VectorXd pieces_of(const Candidate& candidate, std::size_t limit) {
  if (limit >= candidate.pieces.size() || candidate.pieces[limit].empty())
    return VectorXd::Constant(1, tamed(candidate.beyond[limit]));
  const std::vector<double>& pieces = candidate.pieces[limit];
  VectorXd of(static_cast<Index>(pieces.size()));
  std::transform(pieces.begin(), pieces.end(), of.begin(), tamed);
  return of;
}

double failure_of(const Candidate& candidate) { return candidate.ran ? -1 : 1 + tamed(candidate.violation()); }

}  // namespace

void CandidateModels::FunctionModel::add(const VectorXd& place, const VectorXd& pieces) {
  const Index row = places.rows();
  if (row > 0 && values.cols() != pieces.size()) throw std::logic_error("a limit has pieces of another number");
  places.conservativeResize(row + 1, place.size());
  places.row(row) = place.transpose();
  values.conservativeResize(row + 1, pieces.size());
  values.row(row) = pieces.transpose();
}

void CandidateModels::FunctionModel::add(const VectorXd& place, double value) {
  add(place, VectorXd::Constant(1, value));
}

void CandidateModels::FunctionModel::build(const Shape& shape, const GaussianProcess::Scale& scale) {
  if (places.rows() > 0) model.emplace(places, values, shape, scale);
}

GaussianProcess::Prediction CandidateModels::Limit::at(const VectorXd& place, double deviations) const {
  GaussianProcess::Prediction predicted;
  if (by_short_run.model) {
    const GaussianProcess::Predictions each = by_short_run.model->of_each(place);
    Index largest = 0;
    (each.means + deviations * each.deviations).maxCoeff(&largest);
    predicted = {each.means[largest], each.deviations[largest]};
  }
  if (difference.model) {
    const GaussianProcess::Prediction missed = difference.model->at(place);
    predicted = {predicted.mean + missed.mean, std::hypot(predicted.deviation, missed.deviation)};
  }
  return predicted;
}

CandidateModels::CandidateModels(const std::vector<Candidate>& evaluated, const std::vector<Candidate>& short_runs,
                                 const VectorXd& centre, Shapes shapes)
    : shapes_(std::move(shapes)) {
  std::size_t limits = 0;
  for (const std::vector<Candidate>* list : {&evaluated, &short_runs})
    for (const Candidate& candidate : *list)
      if (candidate.ran) limits = candidate.beyond.size();
  limits_.resize(limits);
  shapes_.resize(of_limits + 2 * limits, GaussianProcess::usual_shape(centre.size()));
  for (const Candidate& candidate : evaluated) {
    failed_.add(candidate.place, failure_of(candidate));
    any_failed_ = any_failed_ || !candidate.ran;
    any_feasible_ = any_feasible_ || candidate.feasible();
    if (!candidate.ran) continue;
    aim_.add(candidate.place, candidate.aims.front());
    for (std::size_t k = 0; k < limits; ++k) limits_[k].evaluated.add(candidate.place, tamed(candidate.beyond[k]));
  }
  for (const Candidate* short_run : chosen(short_runs, evaluated, centre)) add_short_run(*short_run);
  build_all();
}

bool CandidateModels::holds(const VectorXd& place) const {
  for (Index k = 0; k < failed_.places.rows(); ++k)
    if ((failed_.places.row(k).transpose() - place).cwiseAbs().maxCoeff() < same) return true;
  return false;
}

/// Adds a short run. If the same place has a result, only the result determines whether the place runs.
void CandidateModels::add_short_run(const Candidate& short_run) {
  if (!holds(short_run.place)) {
    failed_.add(short_run.place, failure_of(short_run));
    any_failed_ = any_failed_ || !short_run.ran;
  }
  if (!short_run.ran) return;
  for (std::size_t k = 0; k < limits_.size(); ++k)
    if (!std::isnan(short_run.beyond[k])) limits_[k].by_short_run.add(short_run.place, pieces_of(short_run, k));
}

void CandidateModels::fit() {
  const auto refit = [](Shape& shape, const FunctionModel& of, Index most) {
    const Index n = std::min(most, of.places.rows());
    if (n > 1)
      shape = GaussianProcess::likeliest_shape(of.places.topRows(n), of.values.topRows(n), shape, shape_evaluations);
  };
  const Index evaluated = aim_.places.rows();
  refit(shapes_[of_aim], aim_, evaluated);
  if (any_failed_) refit(shapes_[of_failure], failed_, std::max(evaluated, most_for_shape));
  for (std::size_t k = 0; k < limits_.size(); ++k) {
    if (!limits_[k].varies) continue;
    refit(shape_of(shapes_, k, false), limits_[k].by_short_run, most_for_shape);
    refit(shape_of(shapes_, k, true), limits_[k].difference, evaluated);
  }
  build_all();
}

void CandidateModels::build_all() {
  aim_.build(shapes_[of_aim]);
  if (any_failed_) failed_.build(shapes_[of_failure]);
  for (Limit& limit : limits_) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const FunctionModel* known : {&limit.by_short_run, &limit.evaluated})
      if (known->places.rows() > 0) {
        const VectorXd largest = known->values.rowwise().maxCoeff();
        low = std::min(low, largest.minCoeff()), high = std::max(high, largest.maxCoeff());
      }
    limit.varies = high - low > same;
  }
  build_limits();
}

void CandidateModels::build_limits() {
  for (std::size_t k = 0; k < limits_.size(); ++k) {
    Limit& limit = limits_[k];
    if (!limit.varies) continue;
    limit.by_short_run.build(shape_of(shapes_, k, false));
    limit.difference = {limit.evaluated.places, limit.evaluated.values};
    if (limit.by_short_run.model)
      for (Index i = 0; i < limit.difference.places.rows(); ++i) {
        const auto by_short_run = limit.by_short_run.model->of_each(limit.evaluated.places.row(i).transpose());
        limit.difference.values(i, 0) -= by_short_run.means.maxCoeff();
      }
    limit.difference.build(shape_of(shapes_, k, true),
                           limit.by_short_run.model ? missed_by_short_runs : GaussianProcess::Scale{});
  }
}

void CandidateModels::believe(const VectorXd& place) {
  if (aim_.model) aim_.add(place, aim_at(place, 0));
  for (Limit& limit : limits_)
    if (limit.varies && limit.difference.model) limit.evaluated.add(place, limit.at(place, 0).mean);
  if (failed_.model) failed_.add(place, failed_.model->at(place).mean);
  build_all();
}

void CandidateModels::believe_short_run(const VectorXd& place) {
  for (Limit& limit : limits_)
    if (limit.varies && limit.by_short_run.model)
      limit.by_short_run.add(place, limit.by_short_run.model->of_each(place).means);
  if (failed_.model) failed_.add(place, failed_.model->at(place).mean);
  build_all();
}

void CandidateModels::learn(const std::vector<Candidate>& short_runs) {
  for (const Candidate& short_run : short_runs) add_short_run(short_run);
  build_all();
}

VectorXd CandidateModels::beyond(const VectorXd& place, double deviations) const {
  std::vector<double> g;
  const auto bound = [&](const GaussianProcess::Prediction& predicted) {
    g.push_back(predicted.mean + deviations * predicted.deviation);
  };
  for (const Limit& limit : limits_)
    if (limit.varies) bound(limit.at(place, deviations));
  if (failed_.model) bound(failed_.model->at(place));
  return Eigen::Map<const VectorXd>(g.data(), static_cast<Index>(g.size()));
}

double CandidateModels::excess(const VectorXd& place, double deviations) const {
  return beyond(place, deviations).cwiseMax(0.0).sum();
}

double CandidateModels::aim_at(const VectorXd& place, double deviations) const {
  if (!aim_.model) return 0;
  const GaussianProcess::Prediction predicted = aim_.model->at(place);
  return predicted.mean - deviations * predicted.deviation;
}

}  // namespace dresslife::pipeline
