// Cables around the axis of a hose that turn as one (README W35).
//
// With every cable at its place in the ring, A = e^(i (phi + psi(s))) a0, the turn psi is where the sum of
// their energies (strain/loose/cable_lines.h) is least; psi = psi' = 0 at the clamps. A turn takes all cables
// along, so no contact stands in its way. With t = J A, a cable's way when its ring turns, the slope of the
// sum is that of slope . t, its matrix that of bending, tension and drag between these ways, less slope . A
// on the diagonal since places go along circles; each cable's stretch adds a matrix of rank one (Woodbury).
//
// With friction A = e^(i (phi + psi)) (a0 + b): each cable keeps the offset b of the sample before, and its friction
// (W36) is part of its energy.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "strain/loose/cable_lines.h"

namespace dresslife::strain {

class Ring {
 public:
  Ring(const std::vector<LooseCable>& cables, const HoseLine& hose, double rest_curvature);
  void feed_in(double share) { lines_.feed_in(share); }  ///< see CableTension
  void shorten(std::size_t cable, double share) {
    lines_.shorten(cable, share);
  }  ///< of its own; see CableTension

  /// Cables `members` of `all`, whose ring it is.
  struct Lying {
    const CableLines& all;
    std::span<const std::size_t> members;
  };
  /// Turns to the minimum at the next sample. time: since the sample before [s]. goes_on: as it turned then.
  /// lying: with friction, from where its cables lie; else as if each kept to its place. Returns whether it has come to
  /// rest.
  bool advance(const HoseLine& hose, double time, bool goes_on, const Lying* lying = nullptr);
  /// (node) cosine and sine of phi + psi: the frame in which its cables' places stay.
  const std::vector<Eigen::Vector2d>& frame() const { return frame_; }

 private:
  void turn_frame(const HoseLine& hose);
  void place(const HoseLine& hose);
  Eigen::VectorXd newton_turn();
  double step(const HoseLine& hose);

  CableLines lines_;                    ///< as they lie when each keeps to its place
  std::vector<double> psi_, velocity_;  ///< (node) against the hose [rad], [rad/s]
  std::vector<Eigen::Vector2d> frame_;
  std::vector<double> bands_, factors_;  ///< (row, 3) diagonal and the two beside it; row: a node inside
  LaneRows gained_, solved_,
      products_;               ///< (row, lane) of the cables' mean gains, their solutions; (lane, lane)
  std::vector<double> slope_;  ///< (row) of the sum of the energies
};

}  // namespace dresslife::strain
