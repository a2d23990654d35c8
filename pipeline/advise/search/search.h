// The interface of a search: ask() returns the next candidates, tell() receives their results.
//
// A candidate is a place with variables between 0 and 1. A search is a function of its seed and of the results that
// it received. A new search with the same results returns the same candidates, so an interrupted search continues.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace dresslife::pipeline {

/// Result of a candidate.
struct Candidate {
  Eigen::VectorXd place;       ///< (variable) 0 .. 1
  bool ran = false;            ///< false: only `place` and the constraints known from the screen are valid
  std::vector<double> aims;    ///< (aim) objectives, to be minimised
  std::vector<double> beyond;  ///< (limit) constraints, <= 0: satisfied
  /// (limit, piece) values whose maximum is the constraint. They are smoother functions of the place than the
  /// maximum. Every result has the same number of pieces per constraint; fewer pieces or none: not known.
  std::vector<std::vector<double>> pieces{};

  double violation() const;  ///< sum of the violations; 0: all constraints are satisfied
  bool feasible() const { return ran && violation() == 0; }
};

/// Returns whether a is better than b. First criterion: it ran. Second: smaller violation. Third: smaller first objective, if
/// an objective exists.
bool better(const Candidate& a, const Candidate& b);

/// Returns the indices of the Pareto-optimal feasible candidates, sorted by the first objective.
std::vector<std::size_t> front(const std::vector<Candidate>& candidates);

/// Returns, (place), a lower bound of the violation of each candidate, without running it; 0: it may be feasible.
using Screen = std::function<std::vector<double>(const std::vector<Eigen::VectorXd>&)>;

/// Returns, (place), the result of a low-fidelity evaluation: whether the candidate runs, and approximate constraints in the
/// order of Candidate::beyond; NaN: unknown; no objectives. The same places give the same results.
using ShortRuns = std::function<std::vector<Candidate>(const std::vector<Eigen::VectorXd>&)>;

class Search {
 public:
  virtual ~Search() = default;
  /// Returns at most `count` next candidates, all of them new. Empty: the search has ended.
  virtual std::vector<Eigen::VectorXd> ask(int count) = 0;
  virtual void tell(const std::vector<Candidate>& candidates) = 0;
};

}  // namespace dresslife::pipeline
