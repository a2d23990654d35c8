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

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "strain/loose/cable.h"

namespace dresslife::strain {

class CableRubbing {
 public:
  static constexpr std::size_t sectors = 36;  ///< around the cable

  CableRubbing(std::size_t segments, std::size_t samples)
      : segments_(segments),
        side_(segments * samples),
        work_(segments * sectors),
        largest_(work_),
        at_(work_.size()) {}

  /// The side on which it touches: the direction (x, y) toward d1 and d2 of the hose.
  void touch(std::size_t segment, std::size_t sample, double x, double y) {
    side_[sample * segments_ + segment] = static_cast<std::uint8_t>(sector_of(x, y));
  }
  /// work: within the sample, sliding along the hose [J].
  void slide_along(std::size_t segment, std::size_t sample, double work) {
    add(segment, side_[sample * segments_ + segment], sample, work);
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
  static std::size_t sector_of(double x, double y);
  void add(std::size_t segment, std::size_t sector, std::size_t sample, double work);

  std::size_t segments_;
  std::vector<std::uint8_t> side_;        ///< (sample, segment) sector
  std::vector<double> work_, largest_;    ///< (segment, sector) [J]
  std::vector<std::size_t> at_;           ///< (segment, sector) sample of the largest
  std::vector<double> pressed_, offset_;  ///< (node), (node, 2) at the sample before
};

}  // namespace dresslife::strain
