// The tension of a cable between two clamps from the stretch of its path, with what its clamps let through
// (README W33).
//
// The cable is gripped at both ends and slides along its path in between:
//     strain = (1 + g) / ((1 + slack) (1 + g0) (1 - s)) - 1 - slipped,   T = E A strain,   |T| <= grip,
// g the mean gain of its path, g0 that of its path at installation, s what twist takes from its
// length (W37). Where T would exceed the grip, the cable slips: it has another free length from then on.
#pragma once

#include "strain/loose/cable.h"

namespace dresslife::strain {

class CableTension {
 public:
  /// laid_in: mean gain of the cable's path at installation.
  explicit CableTension(const LooseCable& cable, double laid_in = 0);

  double laid_in() const { return laid_in_; }
  double free_length_rate() const { return free_length_rate_; }  ///< free length over that of the hose
  double slipped() const { return slipped_; }  ///< through the clamps, over the cable's length; > 0: let out
  double most_strain() const { return held_ ? without_limit : most_; }  ///< at the grip, pulled or pressed

  /// mean_gain: of a path. Returns its strain there, and remembers what slipped: the sample is over.
  double settle(double mean_gain);

  /// What slipped through the clamps is that of another.
  void go_on_from(const CableTension& other) { slipped_ = other.slipped_; }

  /// As if only this share of the slack were in the hose yet; 1: all of it. It is installed by hand, and
  /// clamps let nothing through before all of it is there.
  void feed_in(double share);

  /// What twist takes from its length at this sample, over it, if nothing pulls (README W37).
  void shorten(double share);

 private:
  double slack_, laid_in_, free_length_rate_, fed_in_ = 1, shortened_ = 0;
  double most_ = without_limit;
  double slipped_ = 0;
  bool held_ = false;  ///< while slack is fed in
};

}  // namespace dresslife::strain
