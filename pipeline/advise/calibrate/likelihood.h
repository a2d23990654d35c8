// Likelihood of an observation at the parameters z: of lives, censored lives and measured quantities.
//
// A life is lognormal with the model's median m(z) and the standard deviation s(z) of the failed part (a wire, or a conductor
// that lost its share of wires). The share w of s^2 is common to all specimens of a test, such as one spool or batch.
// u^2 is the variance of one test that the model does not include and no other test shares; the variance between
// makers' cables is added to it. With x = ln(observed), c^2 = w s^2 + u^2, o^2 = (1 - w) s^2 and n specimens:
//     broken     n lives, x is their mean:  N(x; m, c^2 + o^2/n)                             (P2)
//     at least   n not failed until then:   integral of Phi((m + c y - x)/o)^n phi(y) dy     (P3)
//     at most    none lived longer:         integral of Phi((x - m - c y)/o)^n phi(y) dy
// A rating is an "at least" of one specimen.
//
// Dresspacks in service differ by individual values. These are represented by some values j of equal probability, each with
// its own m_j(z) and s_j(z). S(x) is the mean over j of Phi((m_j - x)/s_j), f(x) the mean of phi((m_j - x)/s_j)/s_j. With x for
// the end of a dresspack and e for its age at the begin of the records:
//     failed        f(x)/S(e)                                                            (P5)
//     not failed    S(x)/S(e)
//
// A test with unknown values has several variants of equal probability. Its likelihood is the mean of their likelihoods.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "pipeline/advise/calibrate/emulator.h"

namespace dresslife::pipeline {

/// Returns ln of a likelihood at z, up to a constant.
using LogLikelihood = std::function<double(const Eigen::VectorXd& z)>;

enum class LifeEnd { broken, at_least, at_most };

struct LifeAt {
  double log_median = 0;  ///< ln m(z)
  double spread = 0;      ///< s(z), standard deviation of ln life, > 0
  double between =
      0;  ///< standard deviation of ln life between makers' cables at typical parameters z (typical_cables.h)
  double residual = 0;  ///< standard deviation of the response's residual of ln life (first_failure.h)
};
using LifeVariant = std::function<LifeAt(const Eigen::VectorXd& z)>;

/// A factor of (P5) with an exponent.
struct ServiceFactor {
  double log_age = 0;   ///< x or e
  bool failed = false;  ///< f(x), else S
  int count = 1;        ///< exponent: number of dresspacks; below 0: number of dresspacks that have S(e) as divisor
};

struct ObservedLife {
  double log_life = 0;  ///< x
  LifeEnd end = LifeEnd::broken;
  int specimens = 1;
  double common_share = 0;     ///< w, 0 .. 1
  double unshared_spread = 0;  ///< u, standard deviation of ln life
  std::vector<LifeVariant> variants;
  std::vector<ServiceFactor> service{};  ///< many dresspacks instead of one life; then the variants are the values j
};

/// Returns ln of (P2), (P3) or (P5). Precondition: at least one variant.
double log_likelihood(const ObservedLife& observed, const Eigen::VectorXd& z);

/// A measured number as a sum of quantities of the model: value = sum of factor x exp(log of quantity(z)).
struct MeasuredNumber {
  struct Term {
    std::size_t quantity;
    double factor;
  };
  double value = 0, deviation = 1;  ///< measured value; standard deviation of its error, > 0
  std::vector<Term> parts;
};

/// Measured numbers with normal errors, predicted from positive quantities whose logarithms are emulated.
struct Measurement {
  std::vector<Emulator> log_quantities;
  std::vector<MeasuredNumber> numbers;
};
double said_by_model(const Measurement& measurement, const MeasuredNumber& number, const Eigen::VectorXd& z);
double log_likelihood(const Measurement& measurement, const Eigen::VectorXd& z);

/// Returns ln of the mean of exp(terms). Precondition: at least one term.
double log_mean(const std::vector<double>& terms);

}  // namespace dresslife::pipeline
