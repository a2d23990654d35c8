#include "strain/kernels/lane_groups.h"

#include <algorithm>
#include <numeric>

#include "strain/kernels/sizes.h"
#include "tests/catch.h"

using namespace dresslife::strain;

namespace {

int registers(const std::vector<LaneGroup>& groups, int at_once) {
  int sum = 0;
  for (const LaneGroup& group : groups) sum += (static_cast<int>(group.wires.size()) + at_once - 1) / at_once;
  return sum;
}

}  // namespace

TEST_CASE("every wire of a layer is scanned once and images stand opposite their wires") {
  for (const int at_once : {4, 8, 16})
    for (int count = 1; count <= 100; ++count) {
      const std::vector<LaneGroup> groups = lane_groups(count, at_once);
      std::vector<int> seen;
      for (std::size_t k = 0; k < groups.size(); ++k) {
        const std::vector<int>& wires = groups[k].wires;
        REQUIRE(!wires.empty());
        REQUIRE(wires.size() <= lanes);
        seen.insert(seen.end(), wires.begin(), wires.end());
        if (!groups[k].mirrors) continue;
        REQUIRE(k > 0);
        REQUIRE(wires.size() <= groups[k - 1].wires.size());
        for (std::size_t j = 0; j < wires.size(); ++j) CHECK(wires[j] + groups[k - 1].wires[j] == count);
      }
      std::sort(seen.begin(), seen.end());
      std::vector<int> all(count);
      std::iota(all.begin(), all.end(), 0);
      CHECK(seen == all);
      CHECK(registers(groups, at_once) <= (count + at_once - 1) / at_once);
    }
}

TEST_CASE("images are kept with their wires where they fill registers") {
  const std::vector<LaneGroup> of_31 = lane_groups(31, 16);  // 15 pairs, and wire 0, which is its own image
  REQUIRE(of_31.size() == 2);
  CHECK(of_31[0].wires.size() == 16);
  CHECK(of_31[1].mirrors);
  CHECK(of_31[1].wires.size() == 15);
  CHECK(lane_groups(12, 16).size() == 1);  // one register holds all wires
  CHECK(lane_groups(12, 8).size() == 2);
}
