// Cables around the axis of a hose that turn together ((W35) in strain/theory.md).
//
// With every cable at its place in the ring, A = e^(i (phi + psi(s))) a0. The turn psi minimises the sum of the energies of the
// cables (strain/loose/cable_lines.h); psi = psi' = 0 at the clamps. A turn moves all cables, so contact between them does not
// resist. With t = J A, the direction of a cable's movement when its ring turns, the slope of the sum is the sum of
// slope . t. Its matrix is that of bending, tension and drag between these directions, minus slope . A on the diagonal, because
// places move along circles. Each cable's stretch adds a matrix of rank one (Woodbury). The friction of all cables on wall and
// core (W42) resists the turn; neighbours turn with it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "strain/loose/cable_lines.h"

namespace dresslife::strain {

/// Returns a random smooth winding of a ring, 0 with its slope at both clamps (node) [rad]. radius: of the ring. In a straight
/// hose it needs as much length as the slack (a share of the length).
std::vector<double> random_winding(std::size_t nodes, double length, double radius, double slack, std::uint64_t seed);

class Ring {
 public:
  Ring(const std::vector<LooseCable>& cables, const HoseLine& hose, double rest_curvature);
  /// Sets the turn at the start (node) [rad], 0 at both clamps. Call before the first sample.
  void wind(const std::vector<double>& turn) { psi_ = turn; }
  /// Continues from the state of another ring with the same numbers of cables and nodes. Call before the first sample.
  void go_on_from(const Ring& other);
  void feed_in(double share) { lines_.feed_in(share); }                            ///< see CableTension
  void shorten(std::size_t cable, double share) { lines_.shorten(cable, share); }  ///< see CableTension

  /// Turns to the minimum at the next sample. time: since the previous sample [s]. goes_on: starts with the turning rate of the
  /// previous sample. Returns whether the ring has come to rest.
  bool advance(const HoseLine& hose, double time, bool goes_on);
  /// Takes over the friction of its cables. numbers: their numbers among all. Call before advance().
  void take_friction(const CableLines& from, std::span<const std::size_t> numbers) {
    lines_.take_friction(from, numbers);
  }
  /// Returns the turn against the hose in the last advance() (node) [rad].
  const std::vector<double>& last_turn() const { return turned_; }
  /// Returns cosine and sine of phi + psi (node): the frame in which the places of its cables are constant.
  const std::vector<Eigen::Vector2d>& frame() const { return frame_; }

 private:
  void place(const HoseLine& hose, bool with_slope);
  Eigen::VectorXd newton_turn();
  double step(const HoseLine& hose);

  CableLines lines_;                     ///< the cables, each at its place in the ring
  std::vector<double> psi_, velocity_;   ///< (node) turn against the hose [rad], [rad/s]
  std::vector<double> before_, turned_;  ///< (node) psi_ at the previous sample, change since then
  std::vector<Eigen::Vector2d> frame_;
  std::vector<double> bands_, factors_;  ///< (row, 3) diagonal and its two neighbours; row: an inner node
  /// (row, lane) mean gains of the cables, y of L y = gains, y/D; (lane, lane); scratch memory, see RingSystem.
  LaneRows gained_, eliminated_, scaled_, products_, sums_;
  std::vector<double> slope_;  ///< (row) of the sum of the energies at the last place() with the slope
};

}  // namespace dresslife::strain
