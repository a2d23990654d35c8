// Where the jacket of one cable rubs on what it lies in: normal force times sliding distance of one repeat (W41).
//
// A cable that presses with q [N/m] and slides by ds within a sample does the work q ds per length. Sliding along the hose
// follows from friction (W34), sliding across it from the change of the cable's place (W32). Both are added, at most
// sqrt(2) too much where they come together. Across, the smaller of the pressures before and after counts, so that a cable
// that jumps from wall to wall does not rub on its way.
// The cable does not turn about itself against the hose. It touches the hose's wall on its outer side, or what lies around
// the axis on its inner side, whichever is nearer. A cable that keeps its place touches on the inside of the bend.
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
  static constexpr std::size_t sectors = 36;  ///< around the cable

  CableRubbing(std::size_t segments, std::size_t samples)
      : segments_(segments),
        side_(segments * samples),
        slid_(segments),
        across_(segments),
        along_(segments) {}

  /// The side on which it touches: the direction (x, y) toward d1 and d2 of the hose.
  void touch(std::size_t segment, std::size_t sample, double x, double y) {
    const std::size_t before = sample > 0 ? side_[(sample - 1) * segments_ + segment] : 0;
    side_[sample * segments_ + segment] = static_cast<std::uint8_t>(sector_of(x, y, before));
  }
  /// Sliding along the hose: the motion is repeated, and its last repeat counts.
  void begin_repeat() { along_ = Sums(segments_); }
  /// slid: from its place until this sample [m]. force: with which the segment presses [N].
  void slide_along(std::size_t segment, std::size_t sample, double slid, double force) {
    along_.add(segment, side_[sample * segments_ + segment], sample, force * std::abs(slid - slid_[segment]));
    slid_[segment] = slid;
  }
  /// The next sample of a loose cable, whose `line_load` [N/m] comes besides how it presses. spacing: of nodes [m].
  void move_across(std::size_t sample, const LooseCable& cable, const CableState& state, double line_load,
                   double spacing);

  /// A place that rubs.
  struct Patch {
    std::size_t segment;
    double angle;        ///< of its middle, from d1 toward d2 [rad]
    double work;         ///< of one repeat [J]
    std::size_t sample;  ///< of the largest work
  };
  std::vector<Patch> patches() const;
  static double width();  ///< of a patch [rad]

 private:
  static std::size_t sector_of(double x, double y, std::size_t guess);

  /// Work of all samples and of the one with the most [J], which is `at`. Side by side in memory: a cable adds to one place.
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
  std::vector<double> slid_;        ///< (segment) until the sample before [m]
  Sums across_, along_;
  std::vector<std::array<double, 2>> laid_;  ///< (element) its place in the hose [m]
  std::vector<std::uint8_t> sector_;         ///< (element) in which it rubbed last
  std::vector<double> pressed_, offset_;  ///< (node), (node, 2) at the sample before
};

}  // namespace dresslife::strain
