// The tension of a cable between two clamps, from the stretch of its path and from its slip through the clamps ((W33) in
// strain/theory.md).
//
// The cable is gripped at both ends and slides along its path in between:
//     strain = (1 + g) / ((1 + slack) (1 + g0) (1 - s)) - 1 - slipped,   T = E A strain,   |T| <= grip,
// g is the mean gain of its path, g0 that of its path at installation, s the shortening by twist (W37). When T would exceed the
// grip, the cable slips, and its free length is different from then on.
#pragma once

#include "strain/loose/cable.h"

namespace dresslife::strain {

class CableTension {
 public:
  /// laid_in: mean gain of the cable's path at installation.
  explicit CableTension(const LooseCable& cable, double laid_in = 0);

  double laid_in() const { return laid_in_; }
  double free_length_rate() const { return free_length_rate_; }  ///< free length over that of the hose
  double slipped() const { return slipped_; }  ///< length through the clamps over the cable's length; > 0: let out
  double most_strain() const { return held_ ? without_limit : most_; }  ///< strain at the grip, pulled or pressed

  /// Returns whether the cable can slip, or has slipped, through a clamp.
  bool slips() const { return most_strain() < without_limit || slipped_ != 0; }

  /// Returns the strain of a path with the given mean gain, and stores the slip. Call once per sample, at its end.
  double settle(double mean_gain);

  /// Takes over the slip of another cable.
  void go_on_from(const CableTension& other) { slipped_ = other.slipped_; }

  /// Sets the share of the slack that is in the hose; 1: all of it. Below 1 the clamps do not slip, because a cable is installed
  /// by hand.
  void feed_in(double share);

  /// Sets the shortening by twist of an untensioned cable at this sample, over its length (W37).
  void shorten(double share);

 private:
  double slack_, laid_in_, free_length_rate_, fed_in_ = 1, shortened_ = 0;
  double most_ = without_limit;
  double slipped_ = 0;
  bool held_ = false;  ///< true while slack is fed in
};

}  // namespace dresslife::strain
