// The tension of a cable between two clamps from the stretch of its path, with what its clamps let through
// (README W33).
//
// The cable is gripped at both ends and slides along its path in between:
//     strain = (1 + g) / ((1 + slack) (1 + g0)) - 1 - slipped,   T = E A strain,   |T| <= grip,
// g the mean gain of its path, g0 that of the path on which it was laid in. Where T would exceed the grip,
// the cable slips: it has another free length from then on.
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
  /// laid_in: mean gain of the path on which the cable was laid in.
  explicit CableTension(const LooseCable& cable, double laid_in = 0);

  /// gain: of the path per element, all of equal length. Changes nothing, so that a solver can ask as often
  /// as it likes.
  void answer(std::span<const double> gain, Pull& pull) const;

  /// The same, and remembers what slipped: the sample is over.
  void settle(std::span<const double> gain, Pull& pull);

  /// As if only this share of the slack were in the hose yet; 1: all of it. It is laid in by hand, and
  /// clamps let nothing through before all of it is there.
  void feed_in(double share);

  double slipped() const { return slipped_; }  ///< through the clamps, over the cable's length; > 0: let out

 private:
  double stretch(std::span<const double> gain) const;

  double axial_stiffness_, slack_, laid_in_, free_length_rate_;
  double most_;  ///< strain at the grip, pulled or pressed
  double slipped_ = 0;
  bool held_ = false;  ///< while slack is fed in
};

}  // namespace dresslife::strain
