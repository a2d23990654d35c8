// One loose cable between two clamps: where it rests (README W32 to W36).
//
// At A(s) in the hose's untwisted frame (strain/loose/hose_line.h) it has the energy
//     Pi = L W(mean g) + int E I |K - K0 + A''|^2 / 2 - w . A + eta |A - A_before|^2 / 2 + contact ds,
//     g = e - K . A + |A'|^2 / 2,
// W that of its tension (strain/loose/tension.h), w weight and inertia per length, eta |..| what holds it
// sideways (W36), contact k_w depth^2 / 2 with the hose's wall, its core, and the bounds of its place. At the
// clamps it stays at its place, along the hose's end whatever the hose's twist (b = 0, A' = 0).
//
// Newton's method: bending and tension tie a node to the two next ones, so the matrix has two bands of 2 x 2
// blocks, and the stretch of the free length adds a matrix of rank one (Sherman and Morrison).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "strain/loose/cable.h"
#include "strain/loose/hose_line.h"
#include "strain/loose/tension.h"

namespace dresslife::strain {

class CableLine {
 public:
  CableLine(const LooseCable& cable, const HoseLine& hose, double rest_curvature);

  const LooseCable& cable() const { return cable_; }
  const std::vector<Eigen::Vector2d>& path() const { return path_; }  ///< A [m]

  /// The next sample. frame: (node) the directions in which its place stays, cosine and sine against the
  /// untwisted frame: the hose's, or those of its ring. step: since the
  /// sample before [s]. goes_on: moves in the frame as it did then, else it stays as it was there.
  void begin(const HoseLine& hose, const std::vector<Eigen::Vector2d>& frame, double step, bool goes_on);
  /// Moves to the minimum of the energy. Returns the iterations, at most `most`.
  int relax(const HoseLine& hose, int most);
  /// The sample is over. frame: as in begin(). step: since the sample before [s]; 0: there was none.
  void end(const HoseLine& hose, const std::vector<Eigen::Vector2d>& frame, double step, CableState& state);

  void feed_in(double share) { tension_.feed_in(share); }  ///< see CableTension

  /// What the distance h of the nodes leaves out of a path's waves: second differences have their curvature a by h^2 a'' /
  /// 12 wrong. Both squared and summed over nodes and samples so far.
  double bent() const { return bent_sum_; }      ///< of the cable's curvature, the hose's with it [1/m2]
  double missed() const { return missed_sum_; }  ///< of h^2 a'' / 12 [1/m2]

  // What a ring needs of a cable that it takes along (strain/loose/ring.h).
  void measure(const HoseLine& hose);
  void smooth_slope(const HoseLine& hose);  ///< of all but contact, to slope()
  const std::vector<Eigen::Vector2d>& slope() const { return slope_; }
  const std::vector<Eigen::Vector2d>& gained() const { return gained_; }  ///< by L times the mean gain
  const Pull& pull() const { return pull_; }
  double drag() const { return drag_; }
  void move(std::size_t node, const Eigen::Vector2d& to) { path_[node] = to; }

  static constexpr int most_iterations = 60;             ///< enough from one sample to the next
  static constexpr int most_iterations_at_start = 2000;  ///< from its place to where it rests

 private:
  struct Block {  ///< symmetric
    double xx = 0, xy = 0, yy = 0;
  };
  struct Factor {  ///< of one node
    Block inverse;
    double e_xx, e_xy, e_yx, e_yy;  ///< inverse times what ties it to the next node
  };

  void contacts(const HoseLine& hose);
  void touch(std::size_t node, const Eigen::Vector2d& normal, double depth, double across);
  std::size_t factor(const HoseLine& hose, double shift);
  void substitute(std::vector<Eigen::Vector2d>& right) const;
  double newton_step(const HoseLine& hose);
  void go(double share);
  void judge_mesh(const HoseLine& hose);

  LooseCable cable_;
  double rest_curvature_;
  CableTension tension_;
  Pull pull_;
  double drag_ = 0;
  std::vector<Eigen::Vector2d> path_, before_, velocity_, place_;  ///< (node); place_: A0
  std::vector<double> gain_, press_;
  std::vector<Eigen::Vector2d> bent_, slope_, gained_, step_, soft_, from_, going_;
  std::vector<Block> blocks_;  ///< of contact
  std::vector<Factor> factors_;
  double bent_sum_ = 0, missed_sum_ = 0;
  double tied2_ = 0;  ///< what ties a node to the second next [N/m]
};

}  // namespace dresslife::strain
