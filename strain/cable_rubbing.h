// Where the jacket of one cable rubs on the hose and on its neighbours: normal force times sliding distance in one repeat (W41).
//
// A cable that presses with q [N/m] and slides by ds within a sample does the work q ds per length. Sliding along the hose
// follows from friction (W34), sliding across it from the change of the cable's place (W32). The two works are added, which is
// too much by a factor of at most sqrt(2) where they occur together. Across the hose the smaller of the pressures before and
// after the sample counts, so that a cable that jumps from wall to wall does no work on its way. Around the hose's axis their
// mean counts: with the smaller one, samples at 25 Hz lost 37 % of the work that those at 200 Hz have in a thin hose with room.
// The cable does not turn about itself against the hose. It touches the hose's wall with its outer side, or the parts around
// the axis with its inner side, whichever is nearer. A held cable touches on the inside of the bend.
//
// Not contained: rolling, which would spare the jacket; the step from the last sample to the first one across the hose;
// parts that do not rub (strain.slip).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "strain/loose/cable.h"

namespace dresslife::strain {

class CableRubbing {
 public:
  static constexpr std::size_t sectors = 36;  ///< evenly around the cable

  CableRubbing(std::size_t segments, std::size_t samples)
      : segments_(segments), side_(segments * samples), slid_(segments), across_(segments), along_(segments) {}

  /// Sets the side on which the cable touches: direction (x, y) toward d1 and d2 of the hose.
  void touch(std::size_t segment, std::size_t sample, double x, double y) {
    const std::size_t before = sample > 0 ? side_[(sample - 1) * segments_ + segment] : 0;
    side_[sample * segments_ + segment] = static_cast<std::uint8_t>(sector_of(x, y, before));
  }
  /// Starts a repeat of the motion for sliding along the hose. The last repeat counts.
  void begin_repeat() { along_ = Sums(segments_); }
  /// slid: sum of sliding up to this sample [m]. force: contact force of the segment [N].
  void slide_along(std::size_t segment, std::size_t sample, double slid, double force) {
    along_.add(segment, side_[sample * segments_ + segment], sample, force * std::abs(slid - slid_[segment]));
    slid_[segment] = slid;
  }
  /// Adds the next sample of a loose cable. line_load: added to its contact force [N/m]. spacing: of nodes [m].
  void move_across(std::size_t sample, const LooseCable& cable, const CableState& state, double line_load,
                   double spacing);

  /// A place that rubs: one segment and sector.
  struct Patch {
    std::size_t segment;
    double angle;        ///< of its middle, from d1 toward d2 [rad]
    double work;         ///< in one repeat [J]
    std::size_t sample;  ///< sample with the largest work
  };
  std::vector<Patch> patches() const;
  static double width();  ///< of a patch [rad]

 private:
  static std::size_t sector_of(double x, double y, std::size_t guess);

  /// Work of all samples and largest work of one sample [J]; `at` is this sample. Stored together, because each update uses all.
  struct Sum {
    double work = 0, largest = 0;
    std::size_t at = 0;
  };
  struct Sums {
    std::vector<Sum> of;  ///< (segment, sector)
    explicit Sums(std::size_t segments) : of(segments * sectors) {}
    void add(std::size_t segment, std::size_t sector, std::size_t sample, double of_sample) {
      Sum& sum = of[segment * sectors + sector];
      sum.work += of_sample;
      if (of_sample > sum.largest) sum.largest = of_sample, sum.at = sample;
    }
  };

  std::size_t segments_;
  std::vector<std::uint8_t> side_;  ///< (sample, segment) sector
  std::vector<double> slid_;        ///< (segment) slide at the previous sample [m]
  Sums across_, along_;
  std::vector<std::array<double, 2>> laid_;  ///< (element) its own place in the hose [m]
  std::vector<std::uint8_t> sector_;         ///< (element) sector in which it rubbed last
  std::vector<double> pressed_, offset_;     ///< (node) and (node, 2) at the previous sample
};

}  // namespace dresslife::strain
