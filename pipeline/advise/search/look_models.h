// Models of all looks so far: of the aim, of each limit, and of whether a place runs.
//
// (Q5) A limit that rehearsals compute is modelled in two parts, g(x) = r(x) + d(x): r through all rehearsals
//      near the centre of the search, d through the differences between looks and r. Both are Gaussian
//      processes (Q4), independent, so that their variances add up (M. Kennedy and A. O'Hagan, Biometrika 87
//      (2000) 1, eq. 2 with rho = 1). Where a place was rehearsed, r is known. Before the first looks, d has
//      a deviation of about a tenth, in the units in which limits are graded. Other limits, and the aim, are
//      modelled through the looks alone.
//
// (Q7) Where rehearsals give a limit in pieces, each piece is modelled and r is the largest of them: the
//      largest has an edge wherever another piece takes over, which no smooth function follows, its pieces
//      have none (composite Bayesian optimization: R. Astudillo and P. Frazier, ICML 2019). A bound of r at
//      c deviations is the largest of the pieces' bounds.
#pragma once

#include <optional>
#include <vector>

#include "pipeline/advise/search/gaussian_process.h"
#include "pipeline/advise/search/search.h"

namespace dresslife::pipeline {

/// (Q3): near 0 as it is, far from it only so far. Not a number stays none.
double tamed(double g);

class LookModels {
 public:
  using Shapes = std::vector<GaussianProcess::Shape>;

  /// At least one look or rehearsal that ran. Of more rehearsals than a few hundred those nearest to `centre`
  /// count. shapes: as shapes() of an earlier one told; empty: usual ones.
  LookModels(const std::vector<Look>& looks, const std::vector<Look>& rehearsals,
             const Eigen::VectorXd& centre, Shapes shapes);

  /// Looks for likelier shapes.
  void fit();
  const Shapes& shapes() const { return shapes_; }

  /// As if the place had been looked at, or rehearsed, and been as expected, so that the next pick goes
  /// elsewhere.
  void believe(const Eigen::VectorXd& place);
  void believe_rehearsal(const Eigen::VectorXd& place);
  void learn(const std::vector<Look>& rehearsals);

  bool any_feasible() const { return any_feasible_; }  ///< among the looks
  /// Whether a place that was looked at or rehearsed is among those that count: elsewhere the models guess.
  bool holds(const Eigen::VectorXd& place) const;
  bool knows_aim() const { return aim_.model.has_value(); }

  /// (limit that is not everywhere the same) mean + deviations x deviation, tamed; last whether it runs, <=
  /// 0: it does.
  Eigen::VectorXd beyond(const Eigen::VectorXd& place, double deviations) const;
  double excess(const Eigen::VectorXd& place, double deviations) const;  ///< sum of what of that is above 0
  /// mean - deviations x deviation; 0 where no look ran.
  double aim_at(const Eigen::VectorXd& place, double deviations) const;

 private:
  /// A function, or the pieces whose largest it is, and what is known of it.
  struct Known {
    Eigen::MatrixXd places, values;  // (place, variable), (place, piece)
    std::optional<GaussianProcess> model{};

    void add(const Eigen::VectorXd& place, const Eigen::VectorXd& pieces);
    void add(const Eigen::VectorXd& place, double value);
    void build(const GaussianProcess::Shape& shape, const GaussianProcess::Scale& scale = {});
  };
  struct Limit {
    Known rehearsed, looked;  // looked: g, not the difference
    Known difference{};
    bool varies = false;
    /// Of the piece whose bound at so many deviations is the largest.
    GaussianProcess::Prediction at(const Eigen::VectorXd& place, double deviations) const;
  };

  void add_rehearsal(const Look& rehearsal);
  void build_limits();
  void build_all();

  std::vector<Limit> limits_;
  Known aim_, failed_;  // failed: -1: it ran; else 1 and how far it was from that
  Shapes shapes_;       // aim, failed, then rehearsed and difference of each limit
  bool any_failed_ = false, any_feasible_ = false;
};

}  // namespace dresslife::pipeline
