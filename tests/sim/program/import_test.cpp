#include <numbers>
#include <random>

#include "pipeline/job/job.h"
#include "pipeline/job/motion.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/settings/fields.h"
#include "sim/robot/motion.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"
#include "tests/sim/program/fuzz_target.h"
#include "tests/sim/program/reading.h"
#include "tests/sim/program/samples.h"

using namespace dresslife;
using namespace dresslife::sim;
using namespace dresslife::tests;

namespace {

constexpr double rounding = 1e-12;  // rounding error of a few products of numbers near 1

std::string mutated(const std::string& seed, std::mt19937& random) {
  std::string text = seed;
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % std::max<std::size_t>(n, 1)); };
  for (int k = static_cast<int>(below(6)) + 1; k-- > 0 && !text.empty();) {
    const std::size_t at = below(text.size()), length = below(std::min<std::size_t>(40, text.size() - at)) + 1;
    switch (below(6)) {
      case 0:
        text[at] = static_cast<char>(random());
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, text.substr(below(text.size()), length));
        break;
      case 3:
        text.insert(at, std::string(below(200), "([{,-+1 \n"[below(9)]));
        break;
      case 4:
        text.insert(at, "99999999999");
        break;
      default:
        std::swap(text[at], text[below(text.size())]);
    }
  }
  return text;
}

}  // namespace

namespace {

std::string sample(Language language) {
  for (const auto& [of, text] : samples())
    if (of == language) return text;
  return "";
}

}  // namespace

TEST_CASE("import: joint columns and ROS trajectories") {
  const Reading columns = Reader{Language::joint_columns}({{"j.csv", sample(Language::joint_columns)}});
  REQUIRE(columns.problems.empty());
  REQUIRE(columns.program.instructions.size() == 3);
  CHECK(columns.move(1).target.joints[0] == Approx(1.5 * std::numbers::pi / 180).epsilon(rounding));
  CHECK(columns.move(1).speed.duration.value() == 0.5);
  CHECK(columns.move(2).where.line == 5);
  const Reading ros = Reader{Language::ros_trajectory}({{"j.json", sample(Language::ros_trajectory)}});
  REQUIRE(ros.problems.empty());
  REQUIRE(ros.program.instructions.size() == 2);
  CHECK(ros.move(1).target.joints[0] == 0.5);
  CHECK(ros.move(1).speed.duration.value() == 1.5);
  const Reading bad = Reader{Language::joint_columns}({{"j.csv", "t, a1 deg\n0, 1\n1, x\n1, 2, 3\n"}});
  REQUIRE(bad.problems.size() == 2);
  CHECK(bad.problem(0) == "j.csv:3:1: error: has no number in cell 2 (a1 deg); write a finite number");
  const Reading back = Reader{Language::joint_columns}({{"j.csv", "t, a1 deg\n0, 1\n0, 2\n"}});
  REQUIRE(back.problems.size() == 1);
  CHECK(back.problem(0) ==
        "j.csv:3:1: error: has the time 0 s, not after the one before; order the rows by increasing times");
}

TEST_CASE("import: a program becomes a motion that reads back as it was written") {
  ImportOptions options;
  options.assume["10"] = Assumption::then_branch;
  const Reading reading = Reader{Language::rapid, options}({{"m.mod", samples()[0].second}});
  REQUIRE(reading.problem() == "no such problem");
  const pipeline::Motion motion = motion_of(reading.program, {});
  REQUIRE(motion.steps.size() == reading.program.instructions.size());
  CHECK(motion.steps[0].text == "m.mod:8 main: MoveL Offs(p,a{i},0,-i)\\T:=2,v100,z10,t\\WObj:=wobj0;");
  CHECK(motion.steps[0].duration.value() == 2);
  CHECK(motion.steps[0].tool == "t");
  const std::string text = pipeline::motion_text(motion);
  const pipeline::Motion again = pipeline::motion_from(pipeline::parse_yaml(text, "again.yaml"));
  CHECK(pipeline::to_yaml(pipeline::echo_fields(again)) == pipeline::to_yaml(pipeline::echo_fields(motion)));
  for (const char* fallback :
       {"rows: blended", "passes: 0", "speed_percent: 100\n", "repeat: 0", "path: joint", "stationary: false"})
    CHECK_THAT(text, !Catch::Contains(fallback));
}

TEST_CASE("import: waits before the first move are kept, where the robot stands then") {
  const std::string target = "[[10,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\n";
  const Reading reading =
      Reader{Language::rapid}({{"m.mod", "MODULE m\nPROC main()\nWaitTime 3;\nWaitTime 4;\nMoveAbsJ " + target +
                                             "WaitTime 2;\nMoveAbsJ " + target + "ENDPROC\nENDMODULE\n"}});
  const pipeline::Motion motion = motion_of(reading.program, {});
  REQUIRE(motion.steps.size() == 5);
  CHECK(motion.steps[0].is_move());
  double waits = 0;
  for (const pipeline::MotionStep& step : motion.steps) waits += step.dwell;
  CHECK(waits == 9);
  CHECK(motion.steps[1].dwell == 3);
  CHECK(motion.steps[2].dwell == 4);
}

TEST_CASE("import: external axes that move are named with the entry that a job's robot needs") {
  const auto module = [](double to) {
    return fmt::format(
        "MODULE m\nPROC main()\nMoveAbsJ [[0,0,0,0,30,0],[0,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\nMoveAbsJ "
        "[[0,0,0,0,30,0],[{},9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\nENDPROC\nENDMODULE\n",
        to);
  };
  const auto lines = skipped_lines(Reader{Language::rapid}({{"m.mod", module(500)}}).program);
  REQUIRE(lines.size() == 1);
  CHECK_THAT(lines[0], Catch::Contains("note: external axes move: 1 from 0 to 500") &&
                           Catch::Contains("external_axes: [{name: external_1, kind: linear, carries: robot") &&
                           Catch::Contains("lower_mm: 0, upper_mm: 500"));
  CHECK(skipped_lines(Reader{Language::rapid}({{"m.mod", module(0)}}).program).empty());
  // The robot's YAML accepts the proposed entry.
  const std::size_t open = lines[0].find("external_axes: ["), close = lines[0].find("]}.", open);
  pipeline::Robot robot;
  pipeline::Node axis =
      *pipeline::parse_yaml("{" + lines[0].substr(open, close + 1 - open) + "}", "entry.yaml").find("external_axes");
  pipeline::ExternalAxis read;
  pipeline::read_fields(axis.items.at(0), read);
  CHECK(read.upper == Approx(0.5));
  CHECK(read.axis.isApprox(pipeline::Vector3d::UnitX(), rounding));
}

TEST_CASE("import: all problems come in one message, in the order of the lines") {
  Problems problems;
  problems.add({"a.mod", 9, 1}, "second", "correct");
  problems.add({"a.mod", 2, 1}, "first", "correct");
  problems.add({"a.mod", 9, 1}, "second", "correct");
  CHECK_THROWS_WITH(problems.throw_if_any(), "a.mod:2:1: error: first; correct\na.mod:9:1: error: second; correct");
}

TEST_CASE("import: configurations are written and read back") {
  for (const char* text : {"abb 0 -1 2 1", "kuka 2 35", "fanuc NUT 0 0 0", "fanuc FDB -1 0 2"}) {
    const auto read = arm_configuration(text);
    REQUIRE(read.has_value());
    CHECK(read->text() == text);
  }
  for (const char* text : {"abb 0 0 0", "kuka 2", "fanuc NUX 0 0 0", "staubli 1", "abb 0 0 0 x"})
    CHECK_FALSE(arm_configuration(text).has_value());
}

TEST_CASE("import: mutated programs never break a reader") {
  std::mt19937 random(7);  // the same programs each time
  int refused = 0, runs = 0;
  for (int round = 0; round < 400; ++round)
    for (const auto& [language, seed] : samples()) {
      const std::string text = mutated(seed, random);
      bool has_problems = false;
      const std::string fault = tests::fault_of_reading(language, text, &has_problems);
      INFO(text);
      REQUIRE(fault == "");
      refused += has_problems;
      ++runs;
    }
  CHECK(refused > runs / 4);  // many mutations cause errors
  CHECK(refused < runs);
}

TEST_CASE("import: a damaged URDF becomes a robot or a message") {
  REQUIRE(tests::fault_of_urdf(tests::palletizer) == "");
  std::mt19937 random(13);
  for (int k = 0; k < 300; ++k) {
    const std::string text = mutated(tests::palletizer, random);
    const std::string fault = tests::fault_of_urdf(text);
    INFO(text);
    REQUIRE(fault == "");
  }
}

TEST_CASE("import: the example programs read without a problem") {
  const std::string folder = std::string(DRESSLIFE_SOURCE_DIR) + "/config/programs/";
  // Instructions of each program: 2 home, 2 approaches, 16 spots with 16 welds, 2 departures; start, 4 x 8, end;
  // start, 2 x 4, a wait, end; home, 2 x (8 moves, 2 waits, a circle of 5 moves), home; home, 4 x (5 moves, a wait),
  // home.
  const std::pair<const char*, std::size_t> examples[] = {{"side_panel.mod", 38},
                                                          {"pick_and_place.src", 34},
                                                          {"frame_weld.ls", 11},
                                                          {"door_handling.jbi", 32},
                                                          {"tray_filling.script", 26}};
  for (const auto& [name, count] : examples) {
    pipeline::Motion motion;
    motion.program = folder + name;
    CHECK(read_program(motion).instructions.size() == count);
  }
}

TEST_CASE("import: a copy beside the named program does not count") {
  const pipeline::Scratch scratch;
  const auto program = [&](const std::string& file, int z) {
    return scratch.write(
        file, fmt::format("DEF load()\n PTP {{A1 0,A2 -90,A3 90,A4 0,A5 {0},A6 0}}\n sub()\nEND\nDEF sub()\n "
                          "PTP {{A1 {0},A2 -90,A3 90,A4 0,A5 {0},A6 0}}\nEND\n",
                          z));
  };
  pipeline::Motion motion;
  motion.program = program("load.src", 10);
  program("load_old.src", 20);
  const Program read = read_program(motion);
  REQUIRE(read.instructions.size() == 2);
  for (const Instruction& move : read.instructions)
    CHECK(std::filesystem::path(move.where.file).filename() == "load.src");
  CHECK(moves_left_out(read).empty());  // a note, not a warning
  REQUIRE(!read.skipped.empty());
  CHECK(read.skipped[0].what.find("load_old.src:1") != std::string::npos);
}

TEST_CASE("import: waits for signals count no time, and are counted, in every language") {
  const pipeline::Scratch scratch;
  const auto note = [&](const std::string& file, const std::string& text) {
    pipeline::Motion motion;
    motion.program = scratch.write(file, text);
    return run_motion_of(motion).note;
  };
  const std::string rest =
      " 0 s: the cycle is shorter than in the plant. Count no waits in fatigue.operating_hours_per_week, "
      "or write their times into a copy of the program";
  const std::string joints = "[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\n";
  CHECK(note("w.mod",
             "MODULE w\nPROC main()\nMoveAbsJ " + joints +
                 "FOR i FROM 1 TO 9 DO\nWaitDI di1,1;\nENDFOR\nWaitUntil di2=1;\nWaitTime 2;\nSetDO do1,1;\nMoveAbsJ " +
                 joints + "ENDPROC\nENDMODULE\n") == "2 waits for signals count" + rest);
  CHECK(note("w.src", "DEF w()\nPTP {A1 0,A2 -90,A3 90,A4 0,A5 0,A6 0}\nWAIT FOR $IN[1]\nWAIT SEC 1\nEND\n") ==
        "1 wait for signals counts" + rest);
  CHECK(
      note(
          "w.ls",
          "/PROG W\n/MN\n 1:J P[1] 100% FINE ;\n 2:  WAIT DI[1]=ON ;\n 3:  WAIT .50(sec) ;\n/POS\nP[1]{\n GP1:\n UF : 0, "
          "UT : 1,\n J1=0 deg,J2=0 deg,J3=0 deg,J4=0 deg,J5=0 deg,J6=0 deg\n};\n/END\n") ==
      "1 wait for signals counts" + rest);
  CHECK(
      note("w.jbi",
           "/JOB\n//NAME W\n//POS\n///NPOS 1,0,0,0,0,0\n///TOOL 0\n///POSTYPE ANGLE\n///ANGLE\nC00000=10,0,0,0,-90,0\n"
           "//INST\n///ATTR SC,RW\n///GROUP1 RB1\nNOP\nMOVJ C00000 VJ=1\nWAIT IN#(1)=ON\nTIMER T=1.00\nEND\n") ==
      "1 wait for signals counts" + rest);
  CHECK(note("without.mod", "MODULE w\nPROC main()\nMoveAbsJ " + joints + "WaitTime 2;\nENDPROC\nENDMODULE\n") == "");
}

TEST_CASE("import: assumed units of speeds and durations of spot welds are notes of a run") {
  const pipeline::Scratch scratch;
  const std::string begin =
      "/JOB\n//NAME W\n//POS\n///NPOS 2,0,0,0,0,0\n///TOOL 0\n///POSTYPE ANGLE\n///ANGLE\nC00000=10,0,0,0,-90,0\n"
      "C00001=12,0,0,0,-90,0\n//INST\n///ATTR SC,RW\n///GROUP1 RB1\nNOP\nMOVJ C00000 VJ=1\n";
  pipeline::Motion motion;
  motion.program = scratch.write(
      "w.jbi",
      begin + "SVSPOT GUN#(1) PRESS#(1) WTM=1 WST=1\nMOVJ C00001 VJ=1\nSVSPOT GUN#(1) PRESS#(1) WTM=1 WST=1\nEND\n");
  CHECK(run_motion_of(motion).assumed ==
        std::vector<std::string>{
            "ESTIMATE, not in the job: motion.spot_time_s: 1 (each of 2 spot welds in the program)"});
  motion.spot_time_where.line = 3;  // the job has the key
  CHECK(run_motion_of(motion).assumed.empty());
  pipeline::Motion rapid;
  rapid.program =
      scratch.write("s.mod",
                    "MODULE s\nPROC main()\nMoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\n"
                    "SpotL [[900,0,1200],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,gun1,spot1,tool0;\n"
                    "ENDPROC\nENDMODULE\n");
  CHECK(run_motion_of(rapid).assumed ==
        std::vector<std::string>{"ESTIMATE, not in the job: motion.spot_time_s: 1 (1 spot weld in the program)"});
}

TEST_CASE("import: the cycle times of the example programs") {
  // Reference values from the program; motion_cycle_time_test has times derived by hand. A fault in a corner, a zone or a
  // wait changes these times. Such a fault changed the life of one program by 40 %.
  struct {
    const char *program, *robot;
    double duration;  // [s]
  } const examples[] = {{"side_panel.mod", "abb_irb6640_185_280", 23.56},
                        {"pick_and_place.src", "kuka_kr16_2", 15.50},
                        {"frame_weld.ls", "fanuc_m20ia", 123.83}};
  for (const auto& [program, robot, duration] : examples) {
    INFO(program);
    pipeline::Motion motion;
    motion.program = std::string(DRESSLIFE_SOURCE_DIR "/config/programs/") + program;
    const pipeline::Job job = pipeline::read_job(DRESSLIFE_SOURCE_DIR "/config/jobs/irb6640_spot_welding.yaml",
                                                 {std::string("robot=") + robot});
    CHECK(JointMotion(run_motion_of(motion).motion, job.robot).duration() == Approx(duration).epsilon(1e-3));
  }
}
