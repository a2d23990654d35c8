// A search that looks where it is told to expect most: asked for places, told what was seen there.
//
// Places have their variables between 0 and 1. A search is a function of its seed and of what it was told:
// who tells a new one the same again is asked for the same, which is how a search that was killed goes on.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace dresslife::pipeline {

/// What was seen at a place.
struct Look {
  Eigen::VectorXd place;       ///< (variable) 0 .. 1
  bool ran = false;            ///< else only the place and how far it is beyond what is known beforehand hold
  std::vector<double> aims;    ///< (aim) to be small
  std::vector<double> beyond;  ///< (limit) <= 0: kept
  /// (limit)(piece) what the limit is the largest of, when that is told: pieces are smoother functions of the
  /// place than their largest. As many of each limit in all looks; shorter, or none: not told.
  std::vector<std::vector<double>> pieces{};

  double violation() const;  ///< sum of what is beyond; 0: all limits are kept
  bool feasible() const { return ran && violation() == 0; }
};

/// Whether a is to be preferred, by its first aim: what ran before what did not; less beyond its limits; a
/// smaller aim, where there are aims.
bool better(const Look& a, const Look& b);

/// Indices of the feasible looks than which none is as good in all aims and better in one, by their first
/// aim.
std::vector<std::size_t> front(const std::vector<Look>& looks);

/// (place) how far each is surely beyond its limits, before anything runs; 0: it may work.
using Screen = std::function<std::vector<double>(const std::vector<Eigen::VectorXd>&)>;

/// (place) what a cheaper look tells of each: whether it runs, and limits in the order of Look::beyond, which
/// err; not a number: of that limit it knows nothing. Without aims. Equal places, equal answers.
using Rehearse = std::function<std::vector<Look>(const std::vector<Eigen::VectorXd>&)>;

class Search {
 public:
  virtual ~Search() = default;
  /// So many places to look at next, none of them asked for before. None at all: the search gives up.
  virtual std::vector<Eigen::VectorXd> ask(int count) = 0;
  virtual void tell(const std::vector<Look>& looks) = 0;
};

}  // namespace dresslife::pipeline
