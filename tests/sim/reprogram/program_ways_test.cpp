#include "sim/reprogram/program_ways.h"

#include <filesystem>
#include <set>

#include "pipeline/resolve/job_text.h"
#include "sim/reprogram/patched_program.h"
#include "tests/catch.h"

using namespace dresslife;
using namespace dresslife::pipeline;
using namespace dresslife::sim;

namespace {

Job shipped(const std::string& job) {
  return read_job(std::string(DRESSLIFE_SOURCE_DIR) + "/config/jobs/" + job);
}

}  // namespace

TEST_CASE("program ways: those of the shipped program read back as the program but for what they change") {
  const Job job = shipped("side_panel.yaml");
  const ReadProgram read = read_job_program(job);
  // Sixteen spots with their dwells on lines of their own.
  const std::vector<double> damage(30, 1.0);
  const std::vector<ProgramWay> ways = program_ways(job, read, damage, 30);
  REQUIRE(ways.size() > 20);
  std::set<std::string> kinds;
  for (const ProgramWay& way : ways) {
    kinds.insert(way.what.substr(0, way.what.find(' ')));
    const PatchedProgram made = patched(job, read, way);
    INFO(way.what << "\n" << made.patch);
    CHECK(other_difference(read.motion, made.motion, way.changes) == "");
    CHECK(other_difference(read.motion, made.motion, {}) != "");
    CHECK(made.patch.find("--- a/side_panel.mod\n") == 0);
    for (const sim::LineChange& change : way.changes)
      CHECK(made.patch.find("! " + change.reason) != std::string::npos);
  }
  CHECK(kinds.contains("wrist"));
  CHECK(kinds.contains("by"));
  CHECK(kinds.contains("at"));
}

TEST_CASE("program ways: a line that runs again and again is changed for all of its moves") {
  Job job = shipped("side_panel.yaml");
  job.motion.program = std::string(DRESSLIFE_SOURCE_DIR) + "/config/programs/pick_and_place.src";
  const ReadProgram read = read_job_program(job);
  // As the line 'PTP pick' with the same target four times.
  std::size_t moves = 0;
  for (const MotionStep& step : read.motion.steps) moves += step.text.find("PTP pick") != std::string::npos;
  CHECK(moves == 4);
  ProgramWay way{"slower", {}, {}};
  for (const sim::Instruction& i : read.program.instructions)
    if (i.text.find("PTP pick") != std::string::npos && way.changes.empty())
      way.changes.push_back({.where = i.where, .speed = 0.5, .reason = "slower"});
  const PatchedProgram made = patched(job, read, way);
  std::size_t slow = 0;
  for (const MotionStep& step : made.motion.steps) slow += step.speed_percent == 30.0;
  CHECK(slow == 4);
}
