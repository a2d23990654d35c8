// Likelihood of an observation at the parameters z: of lives, censored lives and measured quantities.
//
// A life is lognormal about the model's median m(z), with the spread s(z) of what failed (a wire, a conductor
// that lost its share of wires). Of s^2 the share w is common to all specimens of a test, one spool or batch;
// u^2 is what the test has of its own that the model does not know and no other test shares; the variance between
// makers' cables adds to it. With x = ln(observed), c^2 = w s^2 + u^2, o^2 = (1 - w) s^2 and n specimens:
//     broken     n lives, x is their mean:  N(x; m, c^2 + o^2/n)                             (P2)
//     at least   n not failed until then:   integral of Phi((m + c y - x)/o)^n phi(y) dy     (P3)
//     at most    none lived longer:         integral of Phi((x - m - c y)/o)^n phi(y) dy
// A rating is an "at least" of one specimen.
//
// Dresspacks in service differ by what each has for itself. Of that there are some values j of equal probability, each with
// its own m_j(z) and s_j(z). S(x) is the mean over j of Phi((m_j - x)/s_j), f(x) that of phi((m_j - x)/s_j)/s_j. With x of a
// dresspack's end and e of its age at the begin of the records:
//     failed        f(x)/S(e)                                                            (P5)
//     not failed    S(x)/S(e)
//
// A test with unknown values has several variants of equal probability. Its likelihood is the mean of theirs.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "pipeline/advise/calibrate/emulator.h"

namespace dresslife::pipeline {

/// ln of a likelihood over z, up to a constant.
using LogLikelihood = std::function<double(const Eigen::VectorXd& z)>;

enum class LifeEnd { broken, at_least, at_most };

struct LifeAt {
  double log_median = 0;  ///< ln m(z)
  double spread = 0;      ///< s(z), of ln life, > 0
  double between = 0;     ///< of ln life, between makers' cables at typical parameters z (typical_cables.h)
};
using LifeVariant = std::function<LifeAt(const Eigen::VectorXd& z)>;

/// A factor of (P5) to the power of a number of dresspacks.
struct ServiceFactor {
  double log_age = 0;   ///< x or e
  bool failed = false;  ///< f(x), else S
  int count = 1;        ///< of dresspacks; below 0: of those that S(e) divides
};

struct ObservedLife {
  double log_life = 0;  ///< x
  LifeEnd end = LifeEnd::broken;
  int specimens = 1;
  double common_share = 0;     ///< w, 0 .. 1
  double unshared_spread = 0;  ///< u, of ln life
  std::vector<LifeVariant> variants;
  std::vector<ServiceFactor> service{};  ///< instead of one life; then the variants are the values j
};

/// (P2), (P3) or (P5). Precondition: at least one variant.
double log_likelihood(const ObservedLife& observed, const Eigen::VectorXd& z);

/// A measured number as a sum of quantities of the model: value = sum of factor x exp(log of quantity(z)).
struct MeasuredNumber {
  struct Term {
    std::size_t quantity;
    double factor;
  };
  double value = 0, deviation = 1;  ///< measured; standard deviation of its error, > 0
  std::vector<Term> parts;
};

/// Numbers with normal errors, from quantities > 0 whose logarithms are emulated.
struct Measurement {
  std::vector<Emulator> log_quantities;
  std::vector<MeasuredNumber> numbers;
};
double said_by_model(const Measurement& measurement, const MeasuredNumber& number, const Eigen::VectorXd& z);
double log_likelihood(const Measurement& measurement, const Eigen::VectorXd& z);

/// ln of the mean of exp(terms). Precondition: at least one.
double log_mean(const std::vector<double>& terms);

}  // namespace dresslife::pipeline
