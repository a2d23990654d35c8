// Surrogate models of the present results: the objective, each constraint, and whether a candidate runs.
// A "result" comes from a full evaluation, a short run is a low-fidelity evaluation.
//
// (Q5) A constraint that short runs compute is modelled in two parts, g(x) = r(x) + d(x): r from short runs near the
//      centre of the search, d from the differences between results and r. Both are independent Gaussian processes
//      (Q4), so their variances add up (M. Kennedy and A. O'Hagan, Biometrika 87 (2000) 1, eq. 2 with rho = 1). r is
//      known at places with a short run. Before the first results d has a standard deviation of about 0.1, in the units of
//      the constraints. Other constraints and the objective are modelled from the results only.
//
// (Q7) If short runs give a constraint in pieces, each piece is modelled and r is the maximum. The maximum has an edge
//      where another piece becomes the largest, which a smooth function cannot follow; the pieces have no edges (composite
//      Bayesian optimization: R. Astudillo and P. Frazier, ICML 2019). A bound of r at c deviations is the largest of the
//      pieces' bounds.
#pragma once

#include <optional>
#include <vector>

#include "pipeline/advise/search/gaussian_process.h"
#include "pipeline/advise/search/search.h"

namespace dresslife::pipeline {

class CandidateModels {
 public:
  using Shapes = std::vector<GaussianProcess::Shape>;

  /// Builds the models from the results `evaluated` and the short runs. Uses at most the 250 short runs nearest to
  /// `centre`. shapes: shapes() of an earlier model; empty: default shapes.
  /// Precondition: at least one candidate or short run ran.
  CandidateModels(const std::vector<Candidate>& evaluated, const std::vector<Candidate>& short_runs,
                  const Eigen::VectorXd& centre, Shapes shapes);

  /// Maximises the likelihood of the shapes.
  void fit();
  const Shapes& shapes() const { return shapes_; }

  /// Adds the expected result at this place, so that the next candidate lies elsewhere.
  void believe(const Eigen::VectorXd& place);
  void believe_short_run(const Eigen::VectorXd& place);
  void learn(const std::vector<Candidate>& short_runs);

  bool any_feasible() const { return any_feasible_; }  ///< whether a result is feasible
  /// Returns whether the models contain a result or short run at this place.
  bool holds(const Eigen::VectorXd& place) const;

  /// Returns (constraint that varies) mean + deviations x standard deviation, transformed by tamed(). The last entry is <= 0 if
  /// the candidate is expected to run.
  Eigen::VectorXd beyond(const Eigen::VectorXd& place, double deviations) const;
  double excess(const Eigen::VectorXd& place, double deviations) const;  ///< sum of the positive entries of beyond()
  /// Returns the objective: mean - deviations x standard deviation; 0 if no candidate ran.
  double aim_at(const Eigen::VectorXd& place, double deviations) const;

 private:
  /// Data and model of a function, or of the pieces of which it is the maximum.
  struct FunctionModel {
    Eigen::MatrixXd places, values;  // (place, variable), (place, piece)
    std::optional<GaussianProcess> model{};

    void add(const Eigen::VectorXd& place, const Eigen::VectorXd& pieces);
    void add(const Eigen::VectorXd& place, double value);
    void build(const GaussianProcess::Shape& shape, const GaussianProcess::Scale& scale = {});
  };
  struct Limit {
    FunctionModel by_short_run, evaluated;  // evaluated: values of g from results
    FunctionModel difference{};
    bool varies = false;
    /// Returns the prediction of the piece with the largest bound.
    GaussianProcess::Prediction at(const Eigen::VectorXd& place, double deviations) const;
  };

  void add_short_run(const Candidate& short_run);
  void build_limits();
  void build_all();

  std::vector<Limit> limits_;
  FunctionModel aim_, failed_;  // failed_: -1 if the candidate ran; else 1 + its violation
  Shapes shapes_;               // objective, failed, then short run and difference of each limit
  bool any_failed_ = false, any_feasible_ = false;
};

}  // namespace dresslife::pipeline
