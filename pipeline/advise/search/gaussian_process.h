// A smooth function through values at some places, with its uncertainty between the places.
//
// (Q4) values = m + f + noise, f a Gaussian process: cov f(x) f(x') = s^2 k(r),
//      r^2 = sum ((x_i - x'_i)/l_i)^2, k(r) = (1 + sqrt(5) r + 5 r^2/3) exp(-sqrt(5) r)  (Matern 5/2;
//      Rasmussen and Williams, Gaussian Processes for Machine Learning, 2006, eq. 4.17), noise variance
//      s^2 n. m is the mean of the values, s^2 its most likely value given the other parameters; l and n maximise the
//      likelihood (eq. 5.8) times a wide lognormal prior on each.
//
// Several functions at the same places share k, l and n; each has its own m and s. The likelihood is the mean over the
// functions, because they are not independent of each other.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace dresslife::pipeline {

class GaussianProcess {
 public:
  /// Parameters: ln l_i, then ln n.
  using Shape = Eigen::VectorXd;
  static Shape usual_shape(Eigen::Index variables);

  /// Prior of s: a standard deviation, with a weight in number of values.
  struct Scale {
    double deviation = 0, worth = 0;
  };

  /// points: (place, variable); values: (place, function). Precondition: all values are finite; at least one place.
  GaussianProcess(const Eigen::MatrixXd& points, const Eigen::MatrixXd& values, const Shape& shape)
      : GaussianProcess(points, values, shape, Scale{}) {}
  GaussianProcess(const Eigen::MatrixXd& points, const Eigen::MatrixXd& values, const Shape& shape, const Scale& scale);

  /// Returns the most likely shape, searched from `start` with at most `evaluations` evaluations.
  static Shape likeliest_shape(const Eigen::MatrixXd& points, const Eigen::MatrixXd& values, const Shape& start,
                               int evaluations);

  struct Prediction {
    double mean = 0, deviation = 0;  ///< of the function without noise
  };
  Prediction at(const Eigen::VectorXd& place) const;  ///< prediction of the first function
  struct Predictions {
    Eigen::VectorXd means, deviations;  ///< (function)
  };
  Predictions of_each(const Eigen::VectorXd& place) const;

 private:
  Eigen::MatrixXd scaled_;  // (place, variable) / l
  Eigen::VectorXd per_length_;
  Eigen::MatrixXd weights_;  // (place, function)
  Eigen::LLT<Eigen::MatrixXd> covariance_;
  Eigen::VectorXd mean_, deviation_;  // (function) m and s
};

}  // namespace dresslife::pipeline
