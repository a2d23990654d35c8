#include "sim/run/unusual_motion.h"

#include <numbers>

#include "tests/catch.h"

namespace dresslife::sim {
namespace {

constexpr double degree = std::numbers::pi / 180;

pipeline::MotionStep to(std::vector<double> degrees) {
  pipeline::MotionStep step;
  for (const double angle : degrees) step.joints.push_back(angle * degree);
  return step;
}

/// The words of the only warning; "": none.
std::string warning_of(std::vector<pipeline::MotionStep> steps) {
  pipeline::Motion motion;
  motion.steps = std::move(steps);
  const std::vector<pipeline::Warning> all = unusual_motion(motion);
  REQUIRE(all.size() <= 1);
  return all.empty() ? "" : all[0].words;
}

const std::vector<double> home{0, -65, 90, 0, 45, 0}, other{30, -50, 80, 10.5, 45, 0};

}  // namespace

TEST_CASE("unusual motion: speeds, waits and angles in another unit are named, usual ones are not") {
  pipeline::MotionStep line = to(other);
  line.text = "LIN there", line.where = {"load.src", 7};
  line.tool_speed = 7;  // vmax of fast controllers
  CHECK(warning_of({to(home), line}) == "");
  line.tool_speed = 600;
  CHECK(warning_of({to(home), line}).starts_with("'LIN there': a tool speed of 600 m/s (limit 10 m/s). Likely cause: a speed in another unit"));
  pipeline::Motion motion;
  motion.steps = {to(home), line};
  CHECK(unusual_motion(motion)[0].where == "load.src:7");

  pipeline::MotionStep crawl = to(other);
  crawl.speed_percent = 1;
  CHECK(warning_of({to(home), crawl}) == "");
  crawl.speed_percent = 0.8;
  CHECK(warning_of({to(home), crawl, crawl, crawl}).starts_with("a speed of 0.8 % of the axes' highest (limit 1 %) (and 2 more)."));

  pipeline::MotionStep wait, block;
  wait.dwell = 300;
  block.repeat = 2, block.steps = {wait};
  CHECK(warning_of({to(home), block}) == "");
  block.steps[0].dwell = 500;  // within a block, too
  CHECK(warning_of({to(home), block}).starts_with("a wait of 500 s (limit 300 s)."));

  CHECK(warning_of({to({0, -1.13, 1.48, 0, 0.785, 0}), to({0.785, -1.13, 1.48, 0, 0.785, 0})})
            .starts_with("all joint targets lie within 6.28 deg of zero. Likely cause: angles in radians"));
  CHECK(warning_of({to({0, -1, 2, 0, 1, 0}), to({1, -1, 2, 0, 1, 0})}) == "");  // small moves in whole degrees
  CHECK(warning_of({to({0, -1.13, 1.48, 0, 0.785, 0}), to(home)}) == "");
}

}  // namespace dresslife::sim
