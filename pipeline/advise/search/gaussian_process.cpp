#include "pipeline/advise/search/gaussian_process.h"

#include <algorithm>
#include <cmath>

#include "pipeline/advise/search/minimise.h"

namespace dresslife::pipeline {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double least_noise =
    1e-8;  // share of the variance: with this noise a Cholesky factor of hundreds of close places exists
constexpr double flat = 1e-12;  // functions with a smaller variance are constant

double correlation(double squared) {
  const double r = std::sqrt(5 * squared);
  return (1 + r + r * r / 3) * std::exp(-r);
}

MatrixXd correlations(const MatrixXd& scaled, double noise) {
  const Index n = scaled.rows();
  MatrixXd k(n, n);
  const MatrixXd columns = scaled.transpose();
  for (Index i = 0; i < n; ++i) {
    k(i, i) = 1 + noise;
    for (Index j = 0; j < i; ++j) k(i, j) = k(j, i) = correlation((columns.col(i) - columns.col(j)).squaredNorm());
  }
  return k;
}

VectorXd per_length(const GaussianProcess::Shape& shape) { return (-shape.head(shape.size() - 1)).array().exp(); }

double noise_of(const GaussianProcess::Shape& shape) { return std::exp(shape[shape.size() - 1]) + least_noise; }

MatrixXd centred_at(const MatrixXd& values, const VectorXd& mean) { return values.rowwise() - mean.transpose(); }

VectorXd mean_of(const MatrixXd& values) { return values.colwise().mean().transpose(); }

/// Returns -2 ln(likelihood x prior) up to constants, with the most likely s^2 of each function.
double unlikeliness(const MatrixXd& points, const MatrixXd& centred, const GaussianProcess::Shape& shape) {
  constexpr double length_spread = 1.2, noise_spread = 3;  // standard deviations of ln l and ln n
  const Eigen::LLT<MatrixXd> factor(correlations(points * per_length(shape).asDiagonal(), noise_of(shape)));
  const auto n = static_cast<double>(centred.rows());
  const VectorXd squares = centred.cwiseProduct(factor.solve(centred)).colwise().sum().cwiseMax(flat).transpose();
  const double determinant = 2 * factor.matrixLLT().diagonal().array().log().sum();
  VectorXd off = (shape - GaussianProcess::usual_shape(points.cols())) / length_spread;
  off[off.size() - 1] *= length_spread / noise_spread;
  return n * (squares.array() / n).log().mean() + determinant + off.squaredNorm();
}

}  // namespace

GaussianProcess::Shape GaussianProcess::usual_shape(Index variables) {
  Shape shape(variables + 1);
  shape.setConstant(std::log(0.5 * std::sqrt(static_cast<double>(variables))));  // half of the diagonal of the unit box
  shape[variables] = std::log(1e-4);
  return shape;
}

GaussianProcess::GaussianProcess(const MatrixXd& points, const MatrixXd& values, const Shape& shape, const Scale& scale)
    : scaled_(points * per_length(shape).asDiagonal()),
      per_length_(per_length(shape)),
      covariance_(correlations(scaled_, noise_of(shape))),
      mean_(mean_of(values)) {
  const MatrixXd centred = centred_at(values, mean_);
  weights_ = covariance_.solve(centred);
  const double believed = scale.worth * scale.deviation * scale.deviation;
  const VectorXd squares = centred.cwiseProduct(weights_).colwise().sum().transpose();
  deviation_ = ((believed + squares.array()) / (scale.worth + static_cast<double>(values.rows()))).max(flat).sqrt();
}

GaussianProcess::Shape GaussianProcess::likeliest_shape(const MatrixXd& points, const MatrixXd& values,
                                                        const Shape& start, int evaluations) {
  const MatrixXd centred = centred_at(values, mean_of(values));
  if (centred.squaredNorm() <= flat) return start;
  constexpr double widest = 5;  // largest difference of a logarithm from its usual value
  const Shape usual = usual_shape(points.cols());
  SearchBox box{usual.array() - widest, usual.array() + widest};
  box.low[usual.size() - 1] = std::log(least_noise);
  box.high[usual.size() - 1] = 0;
  return minimised([&](const VectorXd& shape) { return unlikeliness(points, centred, shape); }, {}, box, start, 0.5,
                   evaluations);
}

GaussianProcess::Predictions GaussianProcess::of_each(const VectorXd& place) const {
  const VectorXd here = place.cwiseProduct(per_length_);
  VectorXd k(scaled_.rows());
  for (Index i = 0; i < k.size(); ++i) k[i] = correlation((scaled_.row(i).transpose() - here).squaredNorm());
  const double explained = covariance_.matrixL().solve(k).squaredNorm();
  return {mean_ + weights_.transpose() * k, std::sqrt(std::max(0.0, 1 - explained)) * deviation_};
}

GaussianProcess::Prediction GaussianProcess::at(const VectorXd& place) const {
  const Predictions predicted = of_each(place);
  return {predicted.means[0], predicted.deviations[0]};
}

}  // namespace dresslife::pipeline
