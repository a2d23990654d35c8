#include "strain/kernels/lane_groups.h"

#include <algorithm>
#include <cassert>

#include "strain/kernels/sizes.h"

namespace dresslife::strain {
namespace {

int registers(int wires, int at_once) { return (wires + at_once - 1) / at_once; }

/// Adds a group of wires `first` to `last` and a group of their images. The wires `alone` have no images and join the first
/// group.
void add_mirrored(std::vector<LaneGroup>& groups, int count, int first, int last, const std::vector<int>& alone) {
  LaneGroup wires, images;
  for (int wire = first; wire <= last; ++wire) {
    wires.wires.push_back(wire);
    images.wires.push_back(count - wire);
  }
  wires.wires.insert(wires.wires.end(), alone.begin(), alone.end());
  images.mirrors = true;
  groups.push_back(wires);
  groups.push_back(images);
}

}  // namespace

std::vector<LaneGroup> lane_groups(int count, int at_once) {
  assert(count > 0 && at_once > 0);
  const int pairs = (count - 1) / 2;
  const std::vector<int> alone = count % 2 == 0 ? std::vector{0, count / 2} : std::vector{0};

  std::vector<LaneGroup> groups;
  int next = 1;
  for (; next + lanes - 1 <= pairs; next += lanes) add_mirrored(groups, count, next, next + lanes - 1, {});

  const int left = pairs - next + 1, others = static_cast<int>(alone.size());
  const int mirrored = registers(left + others, at_once) + registers(left, at_once);
  if (left + others <= lanes && left > 0 && mirrored <= registers(2 * left + others, at_once)) {
    add_mirrored(groups, count, next, pairs, alone);
    return groups;
  }
  std::vector<int> wires = alone;
  for (int wire = next; wire <= pairs; ++wire) wires.insert(wires.end(), {wire, count - wire});
  std::sort(wires.begin(), wires.end());
  for (std::size_t first = 0; first < wires.size(); first += lanes) {
    const std::size_t end = std::min<std::size_t>(first + lanes, wires.size());
    groups.push_back({{wires.begin() + first, wires.begin() + end}, false});
  }
  return groups;
}

}  // namespace dresslife::strain
