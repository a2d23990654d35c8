// Equal rounds of a program's loop. Some of them are followed and stand for the others ((W43) in strain/theory.md).
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "strain/evaluation.h"
#include "strain/history.h"
#include "strain/motion_reader.h"

namespace dresslife::strain {

/// A loop of the program, in samples. Rounds begin between samples.
struct ProgramLoop {
  double begin = 0, round = 0;
  std::size_t rounds = 0;
  double end() const { return begin + static_cast<double>(rounds) * round; }
};

/// Successive equal parts of a motion, each of a few rounds. The first one stands for all.
struct EqualParts {
  std::size_t first = 0;   ///< sample
  std::size_t length = 0;  ///< samples of one part
  std::size_t count = 0;
  double drift = 0;  ///< length of a part less that of its rounds [samples]
  std::size_t end() const { return first + count * length; }
  std::size_t left_out() const { return (count - 1) * length; }
};

/// Returns the parts of a loop that leave out most samples; none if no part of whole rounds is nearly a whole number of samples.
/// lead: number of rounds before the first part, at least 1. At least one round follows the last part. So the turning points of a part
/// are the same between any two parts: before a part and behind it is the same round.
std::optional<EqualParts> equal_parts(const ProgramLoop& loop, std::size_t lead);

/// Samples of a motion without those of equal parts after the first one.
class Shortening {
 public:
  /// Samples [first, end) of the motion. at: number of the first one in the shortened motion. times: number of equal parts for
  /// which they stand; 0: they are left out.
  struct Piece {
    std::size_t first, end, at, times;
  };

  /// parts: in the order of time, without overlap.
  explicit Shortening(std::size_t samples, const std::vector<EqualParts>& parts = {});
  bool any() const { return pieces_.size() > 1; }
  const std::vector<Piece>& pieces() const { return pieces_; }  ///< they cover the motion
  std::size_t samples() const { return samples_; }              ///< of the shortened motion
  /// Returns the number of a sample of the shortened motion in the whole motion.
  std::size_t in_motion(std::size_t sample) const;
  /// Returns the history of a segment in the shortened motion, from that in the whole motion.
  DeformationHistory shortened(const DeformationColumns& whole) const;
  /// Returns the turning points of the whole motion from those of the shortened motion; only strain, sample and turning. Rises and
  /// falls alternate. Ranges below the gate can remain where one part follows the other.
  SiteRows whole(const SiteRows& rows) const;

 private:
  std::vector<Piece> pieces_;
  std::size_t samples_ = 0;
};

/// Returns the shortening of a motion by the loops of its program (/program/loop). A part is left out only if the hose moves in it as
/// in the part before (same_rms, same_sample in the source).
Shortening shortening_of(const pipeline::FileReader& file, MotionReader& motion, const pipeline::Job& job);

}  // namespace dresslife::strain
