// A routing as a point of a box, for a search: clamps on two links, a guide ring on a third one if wanted,
// and a length.
//
// Every variable lies between 0 and 1. A clamp or ring has five: its place along the shapes of its link, the
// angle about them, the distance from them (up to four diameters of the dresspack, where a bracket can hold
// it), and its direction as two angles to 90 deg either way, about the line from link to link in the first
// pose. Beside the flange on the last link. The order is base clamp, tool clamp, ring. The last variable is
// the slack where the way between the clamps is longest (V1), from 0.02 to 0.32 of the length.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "pipeline/job/setup.h"
#include "sim/route/screening.h"

namespace dresslife::sim {

class RoutingBox {
 public:
  /// setup: its first dresspack's clamps name the links; all else of its routing stays as it is. screener: of
  /// this setup, and lives as long. ring_link: of a guide ring; empty: none. Errors: InputError for a link
  /// that the robot has not, and for a motion without a robot.
  RoutingBox(const pipeline::Setup& setup, const Screener& screener, std::string ring_link);

  std::size_t variables() const { return per_place * used() + 1; }

  /// Places in whole millimetres, directions in hundredths, the length in steps of 5 mm. Errors: InputError
  /// for a place of other variables than variables(), or beyond the box.
  pipeline::Routing routing_at(std::span<const double> place) const;

 private:
  static constexpr std::size_t per_place = 5;
  enum Place { base, tool, ring };

  std::size_t used() const { return links_[ring].empty() ? 2 : 3; }
  bool is_flange(std::size_t place) const;
  std::vector<pipeline::Capsule> shapes_of(std::size_t place) const;
  Vector3 position(std::size_t place, std::span<const double> of) const;
  Vector3 direction(std::size_t place, std::span<const double> of) const;

  pipeline::Setup setup_;  // of one dresspack
  const Screener& screener_;
  double diameter_ = 0;
  std::array<std::string, 3> links_;  // (place)
  std::array<int, 3> link_{};
  std::array<Frame, 3> start_;  // (place) of the links at the begin of the motion
  Vector3 way_, across_, up_;   // from link to link in the first pose, and two directions across
};

}  // namespace dresslife::sim
