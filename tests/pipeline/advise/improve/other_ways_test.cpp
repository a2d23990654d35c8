// Other ways to the same targets, and jobs with one deviation.
#include <Eigen/Geometry>
#include <set>

#include "pipeline/advise/improve/freedom.h"
#include "pipeline/advise/improve/nudges.h"
#include "pipeline/advise/improve/other_ways.h"
#include "pipeline/base/errors.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "tests/catch.h"
#include "tests/pipeline/arm/last_link.h"

namespace dresslife::pipeline {
namespace {

Job shipped(const std::string& robot, const std::string& motion) {
  return read_job(DRESSLIFE_SOURCE_DIR "/config/jobs/irb6640_spot_welding.yaml",
                  {"robot=" + robot, "motion=" + motion});
}

const MotionStep* step_at(const Job& job, const std::string& path) {
  const std::vector<MotionStep>* steps = &job.motion.steps;
  const MotionStep* step = nullptr;
  for (std::size_t at = path.find("steps."); at != std::string::npos; at = path.find("steps.", at + 1)) {
    step = &steps->at(std::stoul(path.substr(at + 6)) - 1);
    steps = &step->steps;
  }
  return step;
}

}  // namespace

TEST_CASE("other ways reach the same poses within the limits") {
  std::set<std::string> kinds;
  for (const char* robot : {"abb_irb6640_185_280", "abb_irb4600_60_205", "abb_irb6700_235_265"}) {
    const Job job = shipped(robot, robot == std::string("abb_irb6640_185_280") ? "hard" : "easy");
    const std::vector<OtherWay> ways = other_ways(job, std::vector<double>(13, 1.0), 13);
    CHECK(ways.size() > 10);
    for (const OtherWay& way : ways) {
      kinds.insert(way.what.substr(0, 6));
      const Job changed = read_job(DRESSLIFE_SOURCE_DIR "/config/jobs/irb6640_spot_welding.yaml", [&] {
        std::vector<std::string> sets{std::string("robot=") + robot, "motion=" + job.motion.name};
        sets.insert(sets.end(), way.sets.begin(), way.sets.end());
        return sets;
      }());
      for (const std::string& set : way.sets) {
        if (set.find("={repeat: 1, ") != std::string::npos) continue;  // inserts a point
        const std::string path = set.substr(0, set.rfind('.', set.find('=')));
        const MotionStep &before = *step_at(job, path), &after = *step_at(changed, path);
        if (before.joints.empty()) continue;
        constexpr double rounding = 1e-6;  // angles have six digits
        CHECK(pose(job.robot, after.joints).isApprox(pose(job.robot, before.joints), 10 * rounding));
        for (std::size_t k = 0; k < 6; ++k) {
          CHECK(after.joints[k] >= job.robot.joints[k].lower);
          CHECK(after.joints[k] <= job.robot.joints[k].upper);
        }
      }
    }
  }
  CHECK(kinds == std::set<std::string>{"at 50 ", "at 70 ", "axis 4", "axis 6", "by a p", "other ", "wrist "});
}

TEST_CASE("lines that cost most come first, with their numbers") {
  const Job job = shipped("abb_irb6640_185_280", "hard");
  std::vector<double> damage(14, 0.0);
  damage[5] = 2;  // the line 'roll the gun over'
  damage[1] = 1;
  damage[8] = 0.5;  // the check after 'roll it over again'
  std::vector<std::string> lines;
  for (const OtherWay& way : other_ways(job, damage, 4))
    if (!way.lines.empty() && (lines.empty() || lines.back() != way.lines.front())) lines.push_back(way.lines.front());
  CHECK(lines == std::vector<std::string>{"hard.yaml:17 'round: roll the gun over'",
                                          "hard.yaml:13 'round: gun out to the left'",
                                          "hard.yaml:19 'round: roll it over again'"});
}

TEST_CASE("a line goes by a point: arm and wrist one after the other, then the line as it was") {
  const Job job = shipped("abb_irb6640_185_280", "hard");
  std::vector<double> damage(14, 0.0);
  damage[1] = 1;  // the block's first line; the motion before it ends at the block's last line
  std::vector<OtherWay> points;
  for (const OtherWay& way : other_ways(job, damage, 1))
    if (way.what.starts_with("by a point")) points.push_back(way);
  REQUIRE(points.size() == 2);
  for (const OtherWay& way : points) {
    const bool arm_first = way.what == "by a point: axes 1 to 3 first";
    const Job changed =
        read_job(DRESSLIFE_SOURCE_DIR "/config/jobs/irb6640_spot_welding.yaml", {"motion=hard", way.sets.front()});
    const MotionStep &before = *step_at(job, "motion.steps.2.steps.1"),
                     &block = *step_at(changed, "motion.steps.2.steps.1");
    const MotionStep& from = *step_at(job, "motion.steps.2.steps.12");  // 'drawn back and rolled'
    REQUIRE(block.steps.size() == 2);
    CHECK(block.steps[1].joints == before.joints);
    CHECK(block.steps[1].text == before.text);
    for (std::size_t k = 0; k < 6; ++k)
      CHECK(block.steps[0].joints[k] == Approx(((k < 3) == arm_first ? before : from).joints[k]).margin(1e-12));
  }
}

TEST_CASE("programs without joint targets are refused") {
  const Job job = read_job(DRESSLIFE_SOURCE_DIR "/config/jobs/side_panel.yaml");
  CHECK_THROWS_WITH(other_ways(job, {1, 1}, 2), Catch::Contains("has no steps with joint targets; read the program"));
}

TEST_CASE("each clamp, the length and the turn of the end are off to both sides") {
  const auto job = std::make_shared<const Job>(shipped("abb_irb6640_185_280", "easy"));
  const std::vector<Nudge> nudges = nudges_of({{"one", job, ""}, {"two", job, ""}}, tolerance_of(10, 10));
  REQUIRE(nudges.size() == 24);
  CHECK(nudges[1].what == "length, + 10 mm");
  CHECK(nudges[1].sets == std::vector<std::string>{"routing.free_length_m=2.03"});
  CHECK(nudges[2].sets == std::vector<std::string>{"routing.pre_twist_deg=-10"});
  CHECK(nudges[4].sets == std::vector<std::string>{"routing.base_clamp.position_m=[-0.11, 0, 0.45]"});
  // Four directions around that of the base clamp, all tilted by atan(10 / 100), in opposite pairs.
  const Eigen::Vector3d own = job->dresspacks.front().routing.base_clamp->direction.normalized();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t k = 10; k < 14; ++k) {
    INFO(nudges[k].what);
    const std::string& set = nudges[k].sets.front();
    const Node value = parse_yaml(set.substr(set.find('=') + 1), "set");
    REQUIRE(set.starts_with("routing.base_clamp.direction=["));
    const Eigen::Vector3d tilted(std::stod(value.items[0].text), std::stod(value.items[1].text),
                                 std::stod(value.items[2].text));
    CHECK(std::acos(tilted.dot(own)) == Approx(std::atan(0.1)).epsilon(1e-4));  // six digits are written
    sum += tilted;
  }
  CHECK((sum / 4 - own * std::cos(std::atan(0.1))).norm() < 1e-5);
  // Without one of the tolerances the nudges of the other remain. Without both there are none.
  CHECK(nudges_of({{"one", job, ""}}, tolerance_of(10, 0)).size() == 22);
  CHECK(nudges_of({{"one", job, ""}}, tolerance_of(0, 10)).size() == 2);
  CHECK(nudges_of({{"one", job, ""}}, tolerance_of(0, 0)).empty());
  CHECK(tolerance_of(0, 0).none());
  CHECK(tolerance_of(0).none());
  CHECK(tolerance_of(10).turn == Approx(10 * std::numbers::pi / 180));
  CHECK(tolerance_text(tolerance_of(10, 10)) ==
        "a clamp or length off by 10 mm, a clamp tilted by 5.7 deg or an end turned by 10 deg");
  CHECK(tolerance_text(tolerance_of(0, 5)) == "an end turned by 5 deg");
  const auto other = std::make_shared<const Job>(read_job(DRESSLIFE_SOURCE_DIR "/config/jobs/irb6640_guided.yaml"));
  CHECK(nudges_of({{"one", job, ""}, {"two", other, ""}}, tolerance_of(10, 10)).empty());
  // Length and rotation, three clamps and a ring. The last clamp and the ring have a place on the hose.
  CHECK(nudges_of({{"guided", other, ""}}, tolerance_of(10, 10)).size() == 4 + 4 * 10 + 2 * 2);
}

TEST_CASE("every key of a routing that is freed by default has a mounting tolerance, others have none") {
  for (const char* name : {"irb6640_guided", "irb6640_two_dresspacks", "side_panel"}) {
    const Job job = read_job(DRESSLIFE_SOURCE_DIR "/config/jobs/" + std::string(name) + ".yaml");
    for (const Entry& entry : Freedom::usual(job).entries) {
      INFO(entry.key);
      CHECK(has_mounting_tolerance(entry.key));
      // Some nudge changes this key.
      const std::vector<Nudge> nudges =
          nudges_of({{"one", std::make_shared<const Job>(job), ""}}, tolerance_of(10, 10));
      CHECK(std::any_of(nudges.begin(), nudges.end(),
                        [&](const Nudge& nudge) { return nudge.sets.front().starts_with(entry.key + "="); }));
    }
  }
  for (const char* key : {"dresspack", "dresspack.diameter_mm", "motion.speed_percent", "routing.base_clamp.link"})
    CHECK_FALSE(has_mounting_tolerance(key));
}

}  // namespace dresslife::pipeline
