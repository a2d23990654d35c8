// Cables around the axis of a hose that turn as one (README W35).
//
// With every cable at its place in the ring, A = e^(i (phi + psi(s))) a0, the turn psi is where the sum of
// their energies (strain/loose/cable_lines.h) is least; psi = psi' = 0 at the clamps. A turn takes all cables
// along, so no contact stands in its way. With t = J A, a cable's way when its ring turns, the slope of the
// sum is that of slope . t, its matrix that of bending, tension and drag between these ways, less slope . A
// on the diagonal since places go along circles; each cable's stretch adds a matrix of rank one (Woodbury).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "strain/loose/cable_lines.h"

namespace dresslife::strain {

/// A random smooth winding of a ring, 0 with its slope at both clamps (node) [rad]. radius: of the ring. It takes as much
/// length as a slack (a share of the length) in a straight hose.
std::vector<double> random_winding(std::size_t nodes, double length, double radius, double slack,
                                   std::uint64_t seed);

class Ring {
 public:
  Ring(const std::vector<LooseCable>& cables, const HoseLine& hose, double rest_curvature);
  /// Before the first sample: it begins turned by this (node) [rad], 0 at both clamps.
  void wind(const std::vector<double>& turn) { psi_ = turn; }
  /// Before the first sample: it goes on from where another ring of as many cables and nodes is.
  void go_on_from(const Ring& other);
  void feed_in(double share) { lines_.feed_in(share); }  ///< see CableTension
  void shorten(std::size_t cable, double share) {
    lines_.shorten(cable, share);
  }  ///< of its own; see CableTension

  /// Turns to the minimum at the next sample. time: since the sample before [s]. goes_on: as it turned then.
  /// Returns whether it has come to rest.
  bool advance(const HoseLine& hose, double time, bool goes_on);
  /// (node) cosine and sine of phi + psi: the frame in which its cables' places stay.
  const std::vector<Eigen::Vector2d>& frame() const { return frame_; }

 private:
  void place(const HoseLine& hose, bool with_slope);
  Eigen::VectorXd newton_turn();
  double step(const HoseLine& hose);

  CableLines lines_;                    ///< as they lie when each keeps to its place
  std::vector<double> psi_, velocity_;  ///< (node) against the hose [rad], [rad/s]
  std::vector<Eigen::Vector2d> frame_;
  std::vector<double> bands_, factors_;  ///< (row, 3) diagonal and the two beside it; row: a node inside
  LaneRows gained_, solved_,
      products_;               ///< (row, lane) of the cables' mean gains, their solutions; (lane, lane)
  std::vector<double> slope_;  ///< (row) of the sum of the energies, where place() found it last
};

}  // namespace dresslife::strain
