#include "sim/reprogram/program_ways.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "pipeline/arm/other_turns.h"
#include "pipeline/base/constants.h"
#include "pipeline/base/plain_file.h"
#include "pipeline/resolve/job_text.h"
#include "sim/reprogram/patched_program.h"
#include "sim/robot/legs.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

using namespace dresslife;
using namespace dresslife::pipeline;
using namespace dresslife::sim;

namespace {

Job shipped(const std::string& job) { return read_job(std::string(DRESSLIFE_SOURCE_DIR) + "/config/jobs/" + job); }

}  // namespace

TEST_CASE("program ways: those of the shipped program read back as the program but for what they change") {
  const Job job = shipped("side_panel.yaml");
  const ReadProgram read = read_job_program(job);
  // Sixteen spots whose dwells are on separate lines.
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
    CHECK(made.patch.find("\n--- a/side_panel.mod\n") == made.patch.find('\n'));
    for (const sim::LineChange& change : way.changes) CHECK(made.patch.find("! " + change.reason) != std::string::npos);
  }
  CHECK(kinds.contains("wrist"));
  CHECK(kinds.contains("by"));
  CHECK(kinds.contains("at"));
  Motion moved = read.motion;
  const auto linear = std::find_if(moved.steps.begin(), moved.steps.end(),
                                   [](const MotionStep& step) { return !step.position.empty(); });
  REQUIRE(linear != moved.steps.end());
  linear->position[2] -= 1e-6;
  CHECK(other_difference(read.motion, moved, {}).ends_with(": position"));
}

TEST_CASE("program ways: a line is changed for what it and the stands behind it cost, a point moves arm or wrist") {
  Job job = shipped("side_panel.yaml");
  const Scratch scratch;
  const std::string no_more = ",[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\n";
  job.motion.program = scratch.write(
      "m.mod", "MODULE m\nPROC main()\nMoveAbsJ [[0,-10,10,20,40,0]" + no_more + "MoveAbsJ [[30,0,20,-40,30,60]" +
                   no_more + "WaitTime 1;\nMoveAbsJ [[30,0,20,10,50,90]" + no_more + "ENDPROC\nENDMODULE\n");
  const ReadProgram read = read_job_program(job);
  REQUIRE(read.motion.steps.size() == 4);
  const auto slowed = [&](const std::vector<double>& damage, std::size_t most) {
    std::vector<std::string> lines;
    for (const ProgramWay& way : program_ways(job, read, damage, most))
      if (way.what == "at 50 % of its speed") lines.push_back(way.lines.at(0));
    return lines;
  };
  using Names = std::vector<std::string>;
  CHECK(slowed({0, 1, 0, 0}, 5) == Names{"m.mod:4"});
  CHECK(slowed({0, 0, 1, 0}, 5) == Names{"m.mod:4"});  // damage while the robot is at rest belongs to the move before
  CHECK(slowed({0, 0, 0, 1}, 5) == Names{"m.mod:6"});
  CHECK(slowed({0, 1, 0, 2}, 5) == Names{"m.mod:6", "m.mod:4"});
  CHECK(slowed({0, 1, 1.5, 2}, 5) == Names{"m.mod:4", "m.mod:6"});
  CHECK(slowed({0, 1, 0, 2}, 1) == Names{"m.mod:6"});
  CHECK(slowed({0, 0, 0, 0}, 5).empty());
  std::map<std::string, std::vector<double>> points;
  for (const ProgramWay& way : program_ways(job, read, {1, 1, 1, 1}, 5))
    if (way.what.starts_with("by a point")) {
      REQUIRE(way.changes.size() == 1);
      CHECK(way.lines == Names{"m.mod:4"});  // line 6 moves only the wrist, and the robot starts at line 3
      points[way.what] = way.changes[0].point;
    }
  REQUIRE(points.size() == 2);
  const std::vector<double> arm{30, 0, 20, 20, 40, 0}, wrist{0, -10, 10, -40, 30, 60};
  for (std::size_t axis = 0; axis < 6; ++axis) {
    CHECK(points["by a point: axes 1 to 3 first"][axis] == Approx(degree * arm[axis]).margin(1e-12));
    CHECK(points["by a point: axes 4 to 6 first"][axis] == Approx(degree * wrist[axis]).margin(1e-12));
  }
}

TEST_CASE("program ways: the speed of a weld or a bead belongs to the process") {
  const Scratch scratch;
  const auto slowed = [](const Job& job) {
    const ReadProgram read = read_job_program(job);
    std::set<std::string> lines;
    for (const ProgramWay& way : program_ways(job, read, std::vector<double>(30, 1.0), 30))
      if (way.what == "at 50 % of its speed") lines.insert(way.lines.at(0));
    return lines;
  };
  std::string weld = read_text(DRESSLIFE_SOURCE_DIR "/config/programs/frame_weld.ls");
  for (const char* process : {"Arc", "Weld"}) {
    for (const char* words : {"Arc Start", "Arc End"})
      if (const std::size_t at = weld.find(words); at != std::string::npos) weld.replace(at, 3, process);
    scratch.write("frame_weld.ls", weld);
    const std::set<std::string> lines =
        slowed(read_job(scratch.write("job.yaml",
                                      "robot: fanuc_m20ia\nmotion: {program: frame_weld.ls}\ndresspack: handling\n"
                                      "routing:\n"
                                      "  base_clamp: {link: link_3, position_m: [0, 0, 0.3], direction: [1, 0, 0]}\n"
                                      "  tool_clamp: {link: link_6, position_m: [0, 0.1, 0], direction: [1, 0, 0]}\n"
                                      "  free_length_m: 1.5\n")));
    CHECK(lines.contains("frame_weld.ls:12"));
    CHECK(!lines.contains("frame_weld.ls:14"));
    CHECK(lines.contains("frame_weld.ls:16"));
  }
  Job job = shipped("side_panel.yaml");
  job.motion.program = scratch.write(
      "bead.mod",
      "MODULE m\nCONST jointtarget a:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
      "CONST jointtarget b:=[[-20,10,0,40,50,60],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
      "CONST robtarget p:=[[1400,200,1500],[0.5,0,0.8660254,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\nPROC main()\n"
      "ConfL\\Off; ConfJ\\Off;\nMoveAbsJ a,v1000,fine,tool0;\nMoveJ p,v1000,fine,tool0;\n"
      "  DISPL Offs(p,0,-400,0),v200,bead1,z10,tool0; ! bead: left side\nMoveAbsJ b,v1000,fine,tool0;\nENDPROC\nENDMODULE\n");
  CHECK(slowed(job) == std::set<std::string>{"bead.mod:7", "bead.mod:8", "bead.mod:10"});
}

TEST_CASE(
    "program ways: answers stay at their lines when a way adds lines, and a patch names the folder of all its files") {
  const Scratch scratch;
  const std::string frame = "[9E9,9E9,9E9,9E9,9E9,9E9]]";
  const auto joints = [&](const char* name, const char* angles) {
    return fmt::format("CONST jointtarget {}:=[[{}],{};\n", name, angles, frame);
  };
  const std::string text = "MODULE m\n" + joints("a", "0,-20,20,60,30,20") + joints("b", "30,0,10,-60,-40,-50") +
                           joints("c", "-20,10,0,40,50,60") +
                           "PROC main()\nMoveAbsJ a,v1000,z50,tool0;\nMoveAbsJ b,v1000,z50,tool0;\nIF di5=1 THEN\n"
                           "MoveAbsJ c,v1000,fine,tool0;\nENDIF\nENDPROC\nENDMODULE\n";
  Job job = shipped("side_panel.yaml");
  job.motion.program = scratch.write("job/m.mod", text);
  for (const char* line : {"m.mod:8", "8"}) {
    job.motion.assume = {{line, "then"}};
    const ReadProgram read = read_job_program(job);
    REQUIRE(read.motion.steps.size() == 3);
    const ProgramWay way{"by a point", {}, {{.where = read.motion.steps[1].where, .point = {0.1, 0, 0, 0, 0, 0}}}};
    CHECK(patched(job, read, way).motion.steps.size() == 4);
  }
  job.motion.program = scratch.write("job/start.mod", "MODULE s\nPROC start()\nmain;\nENDPROC\nENDMODULE\n");
  job.motion.routine = "start";
  job.motion.modules = {{scratch.write("lib/m.mod", text)}};
  const ReadProgram read = read_job_program(job);
  const ProgramWay slower{"slower", {}, {{.where = read.motion.steps[0].where, .speed = 0.5}}};
  const PatchedProgram made = patched(job, read, slower);
  CHECK(made.motion.steps[0].tool_speed == Approx(0.5 * *read.motion.steps[0].tool_speed));
  CHECK(made.patch.starts_with("for patch -p1 in " + std::filesystem::proximate(scratch.folder()).string() + "\n"));
  CHECK(made.patch.find("\n--- a/lib/m.mod\n+++ b/lib/m.mod\n") != std::string::npos);
}

TEST_CASE("program ways: a line that runs again and again is changed for all of its moves") {
  Job job = shipped("side_panel.yaml");
  job.motion.program = std::string(DRESSLIFE_SOURCE_DIR) + "/config/programs/pick_and_place.src";
  const ReadProgram read = read_job_program(job);
  // The line 'PTP pick' occurs four times with the same target.
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

TEST_CASE("program ways: a turn leads all moves to the same poses by its angles, in the words of each maker") {
  for (const auto& [program, robot] : {std::pair{"side_panel.mod", "abb_irb6640_185_280"},
                                       {"pick_and_place.src", "kuka_kr16_2"},
                                       {"frame_weld.ls", "fanuc_m20ia"}}) {
    INFO(program);
    Job job = read_job(DRESSLIFE_SOURCE_DIR "/config/jobs/irb6640_spot_welding.yaml", {std::string("robot=") + robot});
    job.motion.program = std::string(DRESSLIFE_SOURCE_DIR "/config/programs/") + program;
    const ReadProgram read = read_job_program(job);
    constexpr double digits = 1e-5 * degree;  // of angles written into a line
    const auto angles = [&](const Motion& motion) {
      Eigen::VectorXd accelerations = Eigen::VectorXd::Ones(6);
      return legs_of(motion, job.robot, accelerations).targets;
    };
    const std::vector<Eigen::VectorXd> before = angles(read.motion);
    std::size_t turned = 0;
    for (const ProgramWay& way : program_ways(job, read, std::vector<double>(read.motion.steps.size(), 1.0), 0))
      for (const NamedTurn& turn : other_turns(job.robot)) {
        if (way.what != turn.name) continue;
        INFO(turn.name);
        ++turned;
        const std::vector<Eigen::VectorXd> after = angles(patched(job, read, way).motion);
        REQUIRE(after.size() == before.size());
        for (std::size_t k = 0; k < after.size(); ++k) {
          const auto expected = turn.turn({before[k].data(), before[k].data() + 6});
          REQUIRE(expected);
          CHECK((after[k] - Eigen::Map<const Eigen::VectorXd>(expected->data(), 6)).norm() < digits);
        }
      }
    CHECK(turned > 0);
  }
}
