#include "pipeline/advise/improve/reliefs.h"

#include "tests/catch.h"

using namespace dresslife::pipeline;

namespace {

Job clamped_job(double length) {
  Job job;
  job.simulation.segments = 50;
  job.dresspacks[0].dresspack.diameter = 0.06;
  job.dresspacks[0].dresspack.bending_stiffness = 7;
  job.dresspacks[0].routing.free_length = length;
  job.dresspacks[0].routing.base_clamp.emplace();
  job.dresspacks[0].routing.tool_clamp.emplace();
  return job;
}

Outcome lives_of(double wires, std::vector<ModeLife> modes) {
  Outcome outcome{"", wires, std::vector<double>(outcome_limits, -1.0)};
  outcome.modes = std::move(modes);
  outcome.robot_life = 40'000;
  return outcome;
}

}  // namespace

TEST_CASE(
    "reliefs: each bare clamp alone, then all, half as stiff and as stiff as the dresspack, three diameters long") {
  Job job = clamped_job(2);
  const auto ways = reliefs_of(job);
  REQUIRE(ways.size() == 6);
  CHECK(ways[0] ==
        std::vector<std::string>{"routing.base_clamp.bend_relief={length_mm: 180, bending_stiffness_Nm2: 3.5}"});
  CHECK(ways[4] ==
        std::vector<std::string>{"routing.tool_clamp.bend_relief={length_mm: 180, bending_stiffness_Nm2: 7}"});
  CHECK(ways[5].size() == 2);
  job.dresspacks[0].routing.base_clamp->bend_relief.emplace();
  CHECK(reliefs_of(job).size() == 2);
  // At least four segments, and at most half the length between two clamps.
  CHECK_THAT(reliefs_of(clamped_job(3)).front().front(), Catch::Contains("length_mm: 240,"));
  CHECK_THAT(reliefs_of(clamped_job(0.3)).front().front(), Catch::Contains("length_mm: 150,"));
  IntermediateClamp& between = job.dresspacks[0].routing.clamps.emplace_back();
  between.at_length = 1.8;
  const auto guided = reliefs_of(job);
  REQUIRE(guided.size() == 6);
  CHECK_THAT(guided[0].front(), Catch::Contains("routing.clamps.1.bend_relief={length_mm: 100,"));
}

TEST_CASE("reliefs: what fails earlier by more than a tenth, and before the robot, refuses one") {
  const Outcome without = lives_of(1280, {{"abrasion", 1070}, {"jacket wear", 6850}});
  CHECK(earlier_failures(lives_of(1280, {{"abrasion", 980}, {"jacket wear", 6850}}), without).empty());
  CHECK(earlier_failures(lives_of(45.8, {{"abrasion", 2000}, {"jacket wear", 6000}}), without) ==
        "wires after 45.8 h (without it 1,280 h), jacket wear after 6,000 h (without it 6,850 h)");
  CHECK(earlier_failures(lives_of(50'000, {{"corkscrew", 30'000}}), lives_of(90'000, {})) ==
        "corkscrew after 30,000 h (without it never)");
}

TEST_CASE("reliefs: a wire breaks beside a clamp within the length of a relief, and before the robot") {
  RankingRow row;
  row.worst_segment_from_tool = 1, row.damage_per_repeat = 1e-6, row.robot_life_hours = 40'000, row.life_hours = 1000;
  const auto breaks = [&](double from_tool) {
    row.worst_position_from_tool = from_tool;
    return breaks_beside_clamp(clamped_job(2), row);
  };
  CHECK((breaks(0) && breaks(0.17) && breaks(1.83) && breaks(2)));
  CHECK_FALSE((breaks(0.19) || breaks(1) || breaks(1.81)));
  row.life_hours = 41'000;
  CHECK_FALSE(breaks(0));
}
