// The tension of a cable between two clamps from the stretch of its path, with what clamps and friction keep
// in memory (README W31).
//
// The cable is gripped at both ends and slides along its path in between:
//     T = E A ((1 + g) / ((1 + slack) (1 + g0)) - 1 - slipped),  |T| <= grip at the clamps,
// g the path's gain, g0 that of the path on which it was laid in.
#pragma once

#include <span>
#include <vector>

#include "strain/loose/cable.h"

namespace dresslife::strain {

/// How the tension answers to the path of one sample.
struct Pull {
  double mean = 0;              ///< force [N]
  double stiffness = 0;         ///< what `mean` gains per mean gain of the path [N]
  double strain = 0;            ///< of the cable's length, mean
  std::vector<double> tension;  ///< (element) [N]
};

class CableTension {
 public:
  /// length: of the hose's axis between the clamps [m]. elements: of equal length. laid_in: mean gain of the
  /// path on which the cable was laid in.
  CableTension(const LooseCable& cable, double length, std::size_t elements, double laid_in = 0);

  /// gain: of the path per element. press: on what the cable lies against, per node [N/m]. Changes nothing,
  /// so that a solver can ask as often as it likes.
  void answer(std::span<const double> gain, std::span<const double> press, Pull& pull) const;

  /// The same, and remembers what slipped: the sample is over.
  void settle(std::span<const double> gain, std::span<const double> press, Pull& pull);

  double slipped() const { return slipped_; }  ///< through the clamps, over the cable's length; > 0: let out

 private:
  double stiffness_, free_length_rate_, grip_;
  double slipped_ = 0;
};

}  // namespace dresslife::strain
