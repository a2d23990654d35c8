#include "pipeline/advise/calibrate/posterior.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "pipeline/base/lists.h"
#include "pipeline/base/random.h"
#include "pipeline/base/statistics.h"

namespace dresslife::pipeline {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// ---- the maximum ------------------------------------------------------------------------------------------

/// Step of the differences for slope and curvature of minus ln posterior. The emulator's parabolas end at kinks, which have
/// little influence at this step.
constexpr double difference = 1e-3;

struct Local {
  VectorXd slope;
  MatrixXd curvature;
};

Local local_of(const std::vector<LogLikelihood>& terms, const VectorXd& at) {
  const Index n = at.size();
  const auto value = [&](Index i, double di, Index j, double dj) {
    VectorXd z = at;
    z[i] += di;
    z[j] += dj;
    return -log_posterior(terms, z);
  };
  const double h = difference, middle = -log_posterior(terms, at);
  Local local{VectorXd(n), MatrixXd(n, n)};
  for (Index i = 0; i < n; ++i) {
    const double up = value(i, h, i, 0), down = value(i, -h, i, 0);
    local.slope[i] = (up - down) / (2 * h);
    local.curvature(i, i) = (up - 2 * middle + down) / (h * h);
    for (Index j = 0; j < i; ++j)
      local.curvature(i, j) = local.curvature(j, i) =
          (value(i, h, j, h) - value(i, h, j, -h) - value(i, -h, j, h) + value(i, -h, j, -h)) / (4 * h * h);
  }
  return local;
}

bool is_definite(const MatrixXd& matrix) {
  const Eigen::LLT<MatrixXd> factor(matrix);
  return factor.info() == Eigen::Success && matrix.allFinite();
}

// ---- draws ------------------------------------------------------------------------------------------------

MatrixXd covariance_of(const MatrixXd& draws) {
  const MatrixXd off = draws.rowwise() - draws.colwise().mean();
  return off.transpose() * off / static_cast<double>(draws.rows() - 1);
}

class Chain {
 public:
  Chain(const std::vector<LogLikelihood>& terms, VectorXd start, const MatrixXd& shape, std::uint64_t seed)
      : terms_(terms), at_(std::move(start)), value_(log_posterior(terms, at_)), numbers_(seed) {
    set_shape(shape);
  }

  /// draws: (draw, axis), receives the samples.
  void walk(Eigen::Ref<MatrixXd> draws) {
    for (Index k = 0; k < draws.rows(); ++k) {
      const VectorXd there = at_ + step_ * numbers_.normals(VectorXd(at_.size()));
      const double value = log_posterior(terms_, there);
      if (std::log(numbers_.uniform()) < value - value_) at_ = there, value_ = value;
      draws.row(k) = at_.transpose();
    }
  }
  /// Warms up in rounds. Each round uses the covariance of the second half of all previous samples.
  void warm_up(int draws) {
    constexpr int rounds = 6;
    MatrixXd all(draws, at_.size());
    for (int round = 0, done = 0; round < rounds; ++round) {
      const int end = draws * (round + 1) / rounds;
      walk(all.middleRows(done, end - done));
      done = end;
      const MatrixXd seen = covariance_of(all.middleRows(done / 2, done - done / 2));
      constexpr double never_flat = 1e-6;
      set_shape(seen + never_flat * MatrixXd::Identity(at_.size(), at_.size()));
    }
  }

 private:
  void set_shape(const MatrixXd& shape) {
    const Eigen::LLT<MatrixXd> factor(shape);
    if (factor.info() != Eigen::Success) return;
    step_ = 2.38 / std::sqrt(static_cast<double>(shape.rows())) * MatrixXd(factor.matrixL());
  }

  const std::vector<LogLikelihood>& terms_;
  VectorXd at_;
  double value_;
  RandomNumbers numbers_;
  MatrixXd step_;
};

constexpr int chains = 4;

/// Computes split R-hat and the effective sample size of one axis. Split R-hat compares the variance between eight half chains
/// with the variance within; the sample size follows from the variance of the means of batches.
void judge(const VectorXd& axis, Posterior& posterior) {
  constexpr Index halves = 2 * chains;
  const Index length = axis.size() / halves;
  VectorXd means(halves), variances(halves);
  for (Index k = 0; k < halves; ++k) {
    const VectorXd part = axis.segment(k * length, length);
    means[k] = part.mean();
    variances[k] = (part.array() - means[k]).square().sum() / static_cast<double>(length - 1);
  }
  const double within = variances.mean();
  const double between = (means.array() - means.mean()).square().sum() / static_cast<double>(halves - 1);
  const double all = within * static_cast<double>(length - 1) / static_cast<double>(length) + between;
  posterior.chains_disagree = std::max(posterior.chains_disagree, std::sqrt(all / within));

  constexpr Index batches = 64;  // batches are much longer than the correlation between successive samples
  const Index batch = axis.size() / batches;
  VectorXd of_batches(batches);
  for (Index k = 0; k < batches; ++k) of_batches[k] = axis.segment(k * batch, batch).mean();
  const double scatter = (of_batches.array() - of_batches.mean()).square().sum() / static_cast<double>(batches - 1);
  const double worth = all / scatter * static_cast<double>(batches);
  posterior.worth = posterior.worth == 0 ? worth : std::min(posterior.worth, worth);
}

}  // namespace

void summarise(Posterior& posterior) {
  const Index axes = posterior.draws.cols();
  posterior.mean = posterior.draws.colwise().mean();
  posterior.covariance = covariance_of(posterior.draws);
  posterior.median.resize(axes);
  posterior.low.resize(axes);
  posterior.high.resize(axes);
  posterior.chains_disagree = 1;
  posterior.worth = 0;
  for (Index j = 0; j < axes; ++j) {
    const VectorXd axis = posterior.draws.col(j);
    const std::vector<double> numbers(axis.begin(), axis.end());
    posterior.low[j] = quantile(numbers, 0.1);
    posterior.median[j] = quantile(numbers, 0.5);
    posterior.high[j] = quantile(numbers, 0.9);
    judge(axis, posterior);
  }
}

LogLikelihood prior_of_deviations(const VectorXd& deviations) {
  return [excess = VectorXd(deviations.array().inverse().square() - 1)](const VectorXd& z) {
    return -excess.dot(z.cwiseAbs2()) / 2;
  };
}

double log_posterior(const std::vector<LogLikelihood>& terms, const VectorXd& z) {
  return sum_of(
      terms, [&](const LogLikelihood& term) { return term(z); }, -z.squaredNorm() / 2);
}

Laplace laplace_of(const std::vector<LogLikelihood>& terms, const VectorXd& start) {
  constexpr int most_steps = 200;
  constexpr double small = 1e-7;  // of a prior deviation; the differences are accurate to about 1e-8
  const Index n = start.size();
  const MatrixXd identity = MatrixXd::Identity(n, n);
  Laplace found{start, identity};
  double value = -log_posterior(terms, start), damping = 1e-3;
  Local local = local_of(terms, start);
  for (int k = 0; k < most_steps && !found.converged; ++k) {
    MatrixXd damped = local.curvature + damping * identity;
    while (!is_definite(damped) && damping < 1e12) damped = local.curvature + (damping *= 4) * identity;
    const VectorXd step = -damped.llt().solve(local.slope), there = found.most_likely + step;
    const double after = -log_posterior(terms, there);
    if (after <= value) {
      found.most_likely = there;
      found.converged = step.norm() < small || value - after < 1e-12;
      value = after;
      damping = std::max(damping / 8, 1e-9);
      local = local_of(terms, there);
    } else {
      found.converged = step.norm() < small;
      damping *= 8;
    }
  }
  if (is_definite(local.curvature)) found.covariance = local.curvature.inverse();
  return found;
}

Posterior posterior_of(const std::vector<LogLikelihood>& terms, const VectorXd& start,
                       const SamplerSettings& settings) {
  constexpr int most_rounds = 3;
  constexpr double agree = 1.03;
  Posterior posterior;
  posterior.laplace = laplace_of(terms, start);
  const Index axes = start.size();
  int draws = settings.draws;
  for (int round = 0; round < most_rounds; ++round, draws *= 3) {
    posterior.draws.resize(chains * draws, axes);
    const MatrixXd spread = posterior.laplace.covariance.llt().matrixL();
    for (int c = 0; c < chains; ++c) {
      RandomNumbers sides(settings.seed * 1000 + static_cast<std::uint64_t>(c));
      const VectorXd from = posterior.laplace.most_likely + 1.5 * spread * sides.normals(VectorXd(axes));
      Chain chain(terms, from, posterior.laplace.covariance,
                  settings.seed * 1000 + 100 + static_cast<std::uint64_t>(c));
      chain.warm_up(draws / 3);
      chain.walk(posterior.draws.middleRows(c * draws, draws));
    }
    summarise(posterior);
    if (posterior.chains_disagree < agree) break;
  }
  return posterior;
}

double quantile(std::vector<double> numbers, double share) {
  std::sort(numbers.begin(), numbers.end());
  return number_at(numbers, share * static_cast<double>(numbers.size() - 1));
}

}  // namespace dresslife::pipeline
