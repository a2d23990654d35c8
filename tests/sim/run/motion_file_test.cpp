#include "sim/run/motion_file.h"

#include <algorithm>
#include <cmath>

#include "tests/catch.h"
#include "tests/pipeline/scratch.h"
#include "tests/sim/simple_job.h"

namespace dresslife::sim {
namespace {

TEST_CASE("motion file: what the run hands over can be read back") {
  const pipeline::Scratch scratch;
  const auto name = scratch / "motion.h5";
  pipeline::Job job = simple_job();
  job.simulation.most_repeats = 1;
  const Simulation simulation(job);
  std::vector<double> times, positions, clamps, joints;
  std::vector<std::int32_t> steps;
  {
    pipeline::FileWriter file(name, pipeline::motion_format());
    MotionFile motion(file, simulation.description());
    const RunSummary summary = simulation.run({[&](const Sample& sample) {
      motion.add(sample);
      times.push_back(sample.time);
      steps.push_back(sample.step);
      for (const Vector3& x : sample.state.position) positions.insert(positions.end(), x.begin(), x.end());
      for (const Frame& f : {sample.pose.clamps.base, sample.pose.clamps.tool})
        clamps.insert(clamps.end(), {f.orientation.w(), f.orientation.x(), f.orientation.y(), f.orientation.z()});
      joints.push_back(sample.pose.joints[0]);
    }});
    motion.finish(summary, [&](double time) { return simulation.path().step(time); });
    file.attribute("job", "");
    file.attribute("history", "");
    file.attribute("input_sha256", "");
    file.commit();
  }
  const pipeline::FileReader file(name, pipeline::motion_format());
  CHECK(file.length("sample") == times.size());
  CHECK(file.length("segment") == 20);
  CHECK(file.length("clamp") == 2);
  CHECK(file.read<double>("/time") == times);
  const auto kept = file.read<double>("/segment/position");
  REQUIRE(kept.size() == positions.size());
  constexpr double half_decimal = 0.5e-12 + 1e-15;  // of the twelve decimals in the file, and rounding of 1 m in double
  for (std::size_t k = 0; k < kept.size(); ++k) REQUIRE(std::abs(kept[k] - positions[k]) <= half_decimal);
  CHECK(file.read<double>("/segment/length") == std::vector<double>(20, 0.05));
  CHECK(file.read<double>("/clamp/orientation") == clamps);
  CHECK(file.read<double>("/robot/joint_position") == joints);
  CHECK(file.dataset_attribute("/robot/link_pose", "links") == "bench,spindle");
  CHECK(file.read<std::int32_t>("/program/step") == steps);
  CHECK(file.read<std::string>("/program/text") == std::vector<std::string>{"start", "turn", "dwell 3", "back"});
  CHECK(file.rows("/energy") == times.size());
  CHECK(file.rows("/tension") == times.size());
  CHECK(file.rows("/contact/max_depth") == times.size());
  CHECK(file.rows("/contact/force") == times.size());
  CHECK(file.rows("/contact/rubbing") == times.size());
  CHECK(file.read<double>("/contact/work") == std::vector<double>(20 * 5));  // the hose hangs free
  CHECK(file.dataset_attribute("/contact/work", "obstacles") == "bench,spindle,floor,dresspack,cell");
  CHECK(file.rows("/check/net_twist") == times.size());
  CHECK(file.rows("/check/curvature") == 21);
  CHECK(file.number_attribute("repeats") == 1);
  CHECK(file.number_attribute("repeat_distance") > 0);
  const auto names = file.read<std::string>("/check/name"), units = file.read<std::string>("/check/unit");
  const auto values = file.read<double>("/check/value"), curvature = file.read<double>("/check/curvature");
  const auto check_steps = file.read<std::int32_t>("/check/step");
  REQUIRE(names.front() == "smallest bend radius");
  CHECK(units.front() == "m");
  CHECK(values.front() == 1 / *std::max_element(curvature.begin(), curvature.end()));
  CHECK(check_steps.size() == names.size());
  CHECK(file.read<std::int32_t>("/check/warning").size() == names.size());
  CHECK_FALSE(file.has("/program/loop"));
}

TEST_CASE("motion file: the loops of the program") {
  pipeline::Job job = simple_job();
  pipeline::MotionStep loop;
  loop.repeat = 6;
  loop.steps = {move_to(1), move_to(0)};
  job.motion.steps = {move_to(0), loop};
  const Simulation simulation(job);
  const pipeline::Scratch scratch;
  {
    pipeline::FileWriter writer(scratch / "motion.h5", pipeline::motion_format());
    MotionFile motion(writer, simulation.description());
    const RunSummary summary = simulation.run({[&](const Sample& sample) { motion.add(sample); }});
    motion.finish(summary, [&](double time) { return simulation.path().step(time); });
    for (const char* name : {"job", "history", "input_sha256"}) writer.attribute(name, "");
    writer.commit();
  }
  const auto kept =
      pipeline::FileReader(scratch / "motion.h5", pipeline::motion_format()).read<double>("/program/loop");
  REQUIRE(kept.size() == 3);
  CHECK(kept[2] >= 5);  // the first round begins with another move
  for (int round = 0; round < static_cast<int>(kept[2]); ++round)
    CHECK(simulation.path().at(kept[0] + round * kept[1]).joints[0] ==
          Approx(simulation.path().at(kept[0]).joints[0]).margin(1e-9));
}

}  // namespace
}  // namespace dresslife::sim
