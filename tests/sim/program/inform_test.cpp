#include <numbers>

#include "tests/catch.h"
#include "tests/sim/program/reading.h"

using namespace dresslife;
using namespace dresslife::sim;
using namespace dresslife::tests;

namespace {

constexpr double rounding = 1e-12;  // rounding error of a few products of numbers near 1

const std::string rconf = "///RCONF 1,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0\n";
const std::string base = "///TOOL 1\n///POSTYPE BASE\n///RECTAN\n" + rconf;
const std::string pulses = "///TOOL 0\n///POSTYPE PULSE\n///PULSE\n";
const std::string three = base +
                          "C00000=1000.000,0.000,500.000,180.0000,0.0000,0.0000\n"
                          "C00001=1000.000,200.000,500.000,180.0000,0.0000,0.0000\n"
                          "C00002=1000.000,200.000,300.000,180.0000,0.0000,0.0000\n";
const std::pair<std::string, std::string> frames{
    "TOOL.CND",
    "//TOOL 0\n///NAME STANDARD\n0.000,0.000,0.000,0.0000,0.0000,0.0000\n1.0,2.0,3.0\n7.5\n//TOOL 1\n///CRC 12\n"
    "///NAME\n10.000,20.000,300.000,0.0000,0.0000,90.0000\n0.000,0.000,0.000\n"};

std::string job(const std::string& name, const std::string& positions, const std::string& lines,
                const std::string& group = "///GROUP1 RB1\n") {
  return "/JOB\r\n//NAME " + name + "\r\n//POS\n///NPOS 9,0,0,9,0,0\n" + positions +
         "//INST\n///DATE 2026/11/22 14:00\n///ATTR SC,RW\n" + group + "NOP\n" + lines + "END\n";
}

Reading run(const std::string& positions, const std::string& lines, const ImportOptions& options = {},
            Files more = {frames}) {
  more.insert(more.begin(), {"A.JBI", job("A", positions, lines)});
  return Reader{Language::inform, options}(more);
}

/// Returns the lines of all moves, in the order of the run.
std::vector<int> lines_of(const Reading& r) {
  std::vector<int> lines;
  for (const Instruction& i : r.program.instructions) lines.push_back(i.where.line);
  return lines;
}

const std::map<std::string, std::string> counts{{"pulses_per_degree", "[1000,2000,-500,100,100,50]"}};

}  // namespace

TEST_CASE("inform: pulses become angles by the controller's counts, which are asked for") {
  const std::string taught = pulses + "C00000=90000,-20000,1500,100,-250,25\n";
  const Reading asked = run(taught, "MOVJ C00000 VJ=50.00\nMOVJ C00000 VJ=40.00\n");
  REQUIRE(asked.problems.size() == 1);
  CHECK(asked.problem().find("A.JBI:14:6: error: moves to a position in pulses") != std::string::npos);
  CHECK(asked.problem().find("{name: pulses_per_degree, value: '[S,L,U,R,B,T]'}") != std::string::npos);
  const Reading r = run(taught, "MOVJ C00000 VJ=50.00\n", given(counts));
  REQUIRE(r.problem() == "no such problem");
  const double expected[] = {90, -10, -3, 1, -2.5, 0.5};
  for (int i = 0; i < 6; ++i) CHECK(r.move(0).target.joints.at(i) == Approx(expected[i] * degree).margin(rounding));
  CHECK(r.move(0).speed.axis_percent.value() == 50);
  CHECK(r.move(0).tool == -1);
  const Reading fewer = run(pulses + "C00000=1,2,3,4,5\n", "MOVJ C00000 VJ=50.00\n", given(counts));
  CHECK(fewer.problem().find("position of 5 axes, and pulses_per_degree has 6") != std::string::npos);
  const Reading more = run(pulses + "C00000=1,2,3,4,5,6,7\n", "MOVJ C00000 VJ=50.00\n", given(counts));
  CHECK(more.problem().find("position of 7 axes") != std::string::npos);
  CHECK(run(pulses + "C00000=1,2,3,4,5,6,0,0\n", "MOVJ C00000 VJ=1\n", given(counts)).problem() == "no such problem");
  const Reading angles = run("///TOOL 0\n///POSTYPE ANGLE\n///ANGLE\nC00000=10.5,0,0,0,-90,0\n", "MOVJ C00000 VJ=1\n");
  CHECK(angles.move(0).target.joints.at(0) == Approx(10.5 * degree));
}

TEST_CASE("inform: Cartesian positions turn about the fixed axes x, y, z, tools and frames come from the backup") {
  const std::string taught = base +
                             "C00000=100.000,200.000,300.000,90.0000,0.0000,90.0000\n///USER 2\n///POSTYPE USER\n" +
                             "C00001=1.000,2.000,3.000,0.0000,0.0000,0.0000\n";
  const std::pair<std::string, std::string> user{"UFRAME.CND",
                                                 "//UFRAME 2\n///NAME S1\n////RORG C000=1,2,3\n"
                                                 "////BUSER 841.000,-619.000,-14.000,0.0000,0.0000,90.0000\n"};
  const Reading r = run(taught, "MOVL C00000 V=150.0\nMOVL C00001 V=150.0\n", {}, {frames, user});
  REQUIRE(r.problem() == "no such problem");
  const Frame& pose = r.move(0).target.pose;
  CHECK((pose.position - Vector3(0.1, 0.2, 0.3)).norm() < rounding);
  CHECK((pose.orientation * Vector3::UnitX() - Vector3::UnitY()).norm() < rounding);
  CHECK((pose.orientation * Vector3::UnitY() - Vector3::UnitZ()).norm() < rounding);
  const NamedFrame& tool = r.program.tools.at(r.move(0).tool);
  CHECK(tool.name == "TL#(1)");
  CHECK((tool.frame.position - Vector3(0.01, 0.02, 0.3)).norm() < rounding);
  const NamedFrame& object = r.program.work_objects.at(r.move(1).work_object);
  CHECK(object.name == "UF#(2)");
  CHECK((object.frame.point(r.move(1).target.pose.position) - Vector3(0.839, -0.618, -0.011)).norm() < rounding);
  const Reading without = run(taught, "MOVL C00000 V=150.0\nMOVL C00001 V=150.0\n", {}, {});
  REQUIRE(without.problems.size() == 2);
  CHECK(without.problem(0).find("moves with TL#(1), which no file read holds") != std::string::npos);
  CHECK(without.problem(1).find("moves in UF#(2)") != std::string::npos);
  Reader by_user{Language::inform};
  by_user.tools = {{"TL#(1)", {Vector3(0, 0, 0.1), Quaternion::Identity()}, false}};
  by_user.work_objects = {{"UF#(2)", {Vector3(1, 0, 0), Quaternion::Identity()}, false}};
  CHECK(by_user({{"A.JBI", job("A", taught, "MOVL C00001 V=150.0\n")}}).problem() == "no such problem");
}

TEST_CASE("inform: speeds, accelerations and position levels") {
  const Reading r =
      run(three,
          "MOVJ C00000 VJ=12.50 PL=0\nMOVL C00001 V=276.0 PL=4 ACC=60 DEC=40\nMOVL C00002 VR=30.0 CR=12.5\n"
          "SPEED VJ=20.00 V=100.0\nMOVJ C00000\nMOVL C00001\nSET I000 2500\nMOVL C00002 V=I000\nTIMER T=1.50\n"
          "SET I001 30\nTIMER T=I001\nWAIT T=2.00\nWAIT IN#(3)=ON T=9.00\n");
  REQUIRE(r.problem() == "no such problem");
  REQUIRE(r.program.instructions.size() == 9);
  CHECK(r.move(0).speed.axis_percent.value() == 12.5);
  CHECK((r.move(0).zone.distance == 0 && r.move(0).zone.percent == 0));
  CHECK(r.move(1).speed.tool.value() == Approx(0.276));
  CHECK(r.move(1).zone.distance == 0.1);  // PL=4
  CHECK(r.move(1).acceleration_percent == 40);
  CHECK(r.move(2).speed.orientation.value() == Approx(30 * degree));
  CHECK(!r.move(2).speed.tool);
  CHECK(r.move(2).zone.distance == Approx(0.0125));
  CHECK(r.move(3).speed.axis_percent.value() == 20);
  CHECK(r.move(4).speed.tool.value() == Approx(0.1));
  CHECK(r.move(4).zone.percent == 100);  // without PL the robot does not stop
  CHECK(r.move(5).speed.tool.value() == Approx(0.25));
  CHECK(r.move(6).dwell == 1.5);
  CHECK(r.move(7).dwell == Approx(0.3));
  CHECK(r.move(8).dwell == 2);
  CHECK(run(three, "MOVL C00000 V=60.0\n", given({{"speed_unit", "\"cm/min\""}})).move(0).speed.tool.value() ==
        Approx(0.01));
  CHECK(skips(r, "note: V= counts mm/s", false));
  CHECK(run(three, "MOVL C00000\n").problem().find("has no V=, and no SPEED before it") != std::string::npos);
  CHECK(run(three, "MOVL C00000\n", given({{"v", "250"}})).move(0).speed.tool.value() == Approx(0.25));
  // A position level counts levels. The other units are assumed, because no manual was available; a warning says so.
  const Reading variables = run(
      three, "SET B000 3\nSET I000 250\nSET I001 60\nMOVL C00000 V=9.0 PL=B000\nMOVL C00001 V=9.0 CR=I000 ACC=I001\n");
  REQUIRE(variables.problem() == "no such problem");
  CHECK(variables.move(0).zone.distance == 0.05);
  CHECK(variables.move(1).zone.distance == Approx(0.025));
  CHECK(variables.move(1).acceleration_percent == 60);
  CHECK(skips(variables, "a variable as CR is read in units of 0.1 mm", true));
  CHECK(!skips(variables, "a variable as PL", true));
  CHECK(run(three, "MOVL C00000 V=100.0 PL=9\n").problem().find("has PL=9 (0 .. 8)") != std::string::npos);
}

TEST_CASE("inform: MOVC leads straight to its first point, then round the circle of its neighbours") {
  const std::string quarters = base +
                               "C00000=100.0,0.0,50.0,180.0,0.0,0.0\nC00001=0.0,100.0,50.0,180.0,0.0,0.0\n"
                               "C00002=-100.0,0.0,50.0,180.0,0.0,0.0\nC00003=0.0,-100.0,50.0,180.0,0.0,0.0\n";
  const std::string round = "MOVC C00000 V=50.0\nMOVC C00001 V=50.0\nMOVC C00002 V=50.0\nMOVC C00003 V=50.0\n";
  const Reading r = run(quarters, round);
  REQUIRE(r.problem() == "no such problem");
  CHECK(r.move(0).kind == Instruction::Kind::linear);
  const double h = 0.1 / std::numbers::sqrt2;  // 45 deg on the circle of 100 mm
  const Vector3 on_the_way[] = {{h, h, 0.05}, {-h, h, 0.05}, {-h, -h, 0.05}};
  for (int i = 1; i < 4; ++i) {
    CHECK(r.move(i).kind == Instruction::Kind::circular);
    CHECK((r.move(i).via.position - on_the_way[i - 1]).norm() < 1e-9);
  }
  // After FPT a second circle begins at the end of the first one.
  const Reading two = run(quarters,
                          "MOVC C00000 V=50.0\nMOVC C00001 V=50.0\nMOVC C00002 V=50.0 FPT\nMOVC C00003 V=50.0\n"
                          "MOVC C00000 V=50.0\n");
  REQUIRE(two.problem() == "no such problem");
  CHECK(two.move(3).kind == Instruction::Kind::circular);
  CHECK((two.move(3).via.position - on_the_way[2]).norm() < 1e-9);
  CHECK(skips(run(quarters, "MOVC C00000 V=50.0\nMOVC C00001 V=50.0\n"), "fewer than three points", true));
  const Reading axes = run(pulses + "C00000=1000,0,0,0,0,0\nC00001=0,2000,0,0,0,0\nC00002=0,0,500,0,0,0\n",
                           "MOVC C00000 V=9\nMOVC C00001 V=9\nMOVC C00002 V=9\n", given(counts));
  REQUIRE(axes.problem() == "no such problem");
  CHECK(axes.move(1).target.circle_joints == axes.move(2).target.joints);
  CHECK(axes.move(2).target.circle_joints == axes.move(0).target.joints);
}

TEST_CASE("inform: an endless main loop is one cycle, also where it is left and jumped into") {
  const std::string loop = "MOVJ C00000 VJ=9\n*LOOP\nMOVJ C00001 VJ=9\nMOVJ C00002 VJ=9\nJUMP *LOOP\n";
  CHECK(lines_of(run(three, loop)) == std::vector<int>{17, 19, 20});
  ImportOptions twice;
  twice.passes = 2;
  CHECK(lines_of(run(three, loop, twice)) == std::vector<int>{17, 19, 20, 19, 20});
  // The loop counts down and restarts: three different passes, then the first one again.
  const Reading parts =
      run(three,
          "SET I000 2\n*LOOP\nIFTHENEXP I000<=0\n\tSET I000 2\n\tJUMP *RESET\nENDIF\nMOVJ C00001 VJ=9\n"
          "DEC I000\nJUMP *LOOP\n*RESET\nMOVJ C00002 VJ=9\nJUMP *LOOP\n");
  REQUIRE(parts.problem() == "no such problem");
  CHECK(lines_of(parts) == std::vector<int>{23, 23, 27});
  CHECK(skips(parts, "an endless loop; the motion is", false));
  const Reading counted = run(three,
                              "FOR I000 START= 1 TO 3\nMOVJ C00000 VJ=9\nNEXT I000\nWHILE I000>2\nMOVL C00001 V=9\n"
                              "DEC I000\nENDWHILE\nSWITCH I000 CASE 1\nMOVJ C00000 VJ=1\nCASE 2\nMOVJ C00002 VJ=1\n"
                              "DEFAULT\nMOVJ C00001 VJ=1\nENDSWITCH\n");
  REQUIRE(counted.problem() == "no such problem");
  CHECK(lines_of(counted) == std::vector<int>{18, 18, 18, 21, 21, 27});
}

TEST_CASE("inform: what inputs and unknown variables decide is asked, with the name to give") {
  const Reading input = run(three, "JUMP *END IF IN#(3)=ON\nMOVJ C00000 VJ=9\n*END\n");
  REQUIRE(input.problems.size() == 1);
  CHECK(input.problem().find("'IN#(3)' is an input of the controller") != std::string::npos);
  CHECK(input.problem().find("{name: 'IN#(3)', value: VALUE}") != std::string::npos);
  CHECK(lines_of(run(three, "JUMP *END IF IN#(3)=ON\nMOVJ C00000 VJ=9\n*END\nMOVJ C00001 VJ=9\n",
                     given({{"in#(3)", "ON"}}))) == std::vector<int>{20});
  const std::string variable =
      "IFTHENEXP B003=1 ANDEXP B004<>2\nMOVJ C00000 VJ=9\nELSEIFEXP B003=2\nMOVJ C00001 VJ=9\nELSE\n"
      "MOVJ C00002 VJ=9\nENDIF\n";
  CHECK(run(three, variable).problem().find("{name: B003, value: VALUE}") != std::string::npos);
  CHECK(lines_of(run(three, variable, given({{"B3", "1"}, {"B004", "0"}}))) == std::vector<int>{18});
  CHECK(lines_of(run(three, variable, given({{"B3", "2"}, {"B004", "0"}}))) == std::vector<int>{20});
  const std::pair<std::string, std::string> values{"VAR.DAT",
                                                   "//VAR\n///SHARE 9,9\n///B\n0,0,0,7,0,0,0,0,0,0\n///I\n5\n///P\n"
                                                   "\"PULSE\"0,0,3,000000,0,0,1000,0,0,0,0,0,0,0\n"};
  CHECK(lines_of(run(three, variable, {}, {frames, values})) == std::vector<int>{22});
  const Reading place = run("", "MOVJ P000 VJ=9\n", given(counts), {frames, values});
  CHECK(place.move(0).target.joints.at(0) == Approx(degree));
  const Reading unread = run(three, "DIN B003 IN#(1)\nIFTHENEXP B003=1\nMOVJ C00000 VJ=9\nENDIF\n");
  CHECK(unread.problem().find("may be written by din (A.JBI:17)") != std::string::npos);
}

TEST_CASE("inform: positions are computed with, moved on from and shifted") {
  const std::string taught = three +
                             "P00001=10.000,20.000,30.000,0.0000,0.0000,0.0000\n"
                             "P00002=0.000,0.000,5.000,0.0000,0.0000,0.0000\n";
  const Reading r = run(taught,
                        "SET P003 P001\nSET D000 3\nMUL P002 D000\nADD P003 P002\nSETE P003 (1) 500000\nMOVL P003 V=9\n"
                        "IMOV P002 V=9 BF\nIMOV P002 V=9 TF\nSFTON P001 BF\nMOVL C00000 V=9\nSFTOF\nMOVL C00000 V=9\n"
                        "GETE D001 P003 (2)\n");
  REQUIRE(r.problem() == "no such problem");
  const auto at = [&](int i) { return Vector3(1000 * r.move(i).target.pose.position); };
  CHECK((at(0) - Vector3(500, 20, 45)).norm() < 1e-9);
  CHECK((at(1) - Vector3(500, 20, 60)).norm() < 1e-9);
  CHECK((at(2) - Vector3(500, 20, 75)).norm() < 1e-9);
  CHECK((at(3) - Vector3(1010, 20, 530)).norm() < 1e-9);
  CHECK((at(4) - Vector3(1000, 0, 500)).norm() < 1e-9);
  // In the frame of a tool that points down, z has the opposite direction.
  const Reading down = run(taught, "MOVL C00000 V=9\nIMOV P002 V=9 TF\n");
  CHECK(down.move(1).target.pose.position.z() == Approx(0.495));
  const Reading joints = run(pulses + "C00000=1,2,3,4,5,6\n" + base + "P00001=0,0,1,0,0,0\n",
                             "MOVJ C00000 VJ=9\nIMOV P001 V=9 BF\nSFTON P001\nMOVJ C00000 VJ=9\n", given(counts));
  REQUIRE(joints.problems.size() == 2);
  CHECK(joints.problem(0).find("moves from joint angles by a distance in space (IMOV)") != std::string::npos);
  CHECK(joints.problem(1).find("shifts a position that is given in pulses (SFTON)") != std::string::npos);
}

TEST_CASE("inform: jobs call jobs with arguments, a job that is not there leaves variables unknown") {
  const std::string called = job("B-1", three, "GETARG LB000 IARG#(1)\nRET IF LB000=2\nMOVJ C00001 VJ=9\nINC B007\n");
  const std::string calls =
      "SET B007 0\nCALL JOB:B-1 ARGF1\nCALL JOB:B-1 ARGF2\nMOVJ C00000 VJ=9 //comment\n"
      "IFTHENEXP B007=1\nJUMP JOB:B-1\nENDIF\nMOVJ C00002 VJ=9\n";
  const Reading r = run(three, calls, {}, {frames, {"B-1.JBI", called}});
  CHECK(r.problem().find("'IARG#(1)'") != std::string::npos);  // JUMP gives no argument
  const Reading given_all = run(three,
                                "SET B007 0\nCALL JOB:B-1 ARGF1\nCALL JOB:B-1 ARGF2\nCALL JOB:B-1 ARGFB007\n"
                                "MOVJ C00000 VJ=9\n",
                                {}, {frames, {"B-1.JBI", called}});
  REQUIRE(given_all.problem() == "no such problem");
  REQUIRE(given_all.program.instructions.size() == 3);
  CHECK(given_all.move(0).routine == "B-1");
  CHECK(given_all.move(2).where.line == 21);
  const Reading missing = run(three, "SET B000 1\nCALL JOB:GONE\nMOVJ C00000 VJ=9\n");
  CHECK(missing.program.instructions.size() == 1);
  CHECK(skips(missing, "CALL JOB:gone: not among the files read", true));
  CHECK(run(three, "SET B000 1\nCALL JOB:GONE\nMOVJ C00000 VJ=9 IF B000=1\nIFTHENEXP B000=1\nMOVJ C00001 VJ=9\nENDIF\n")
            .problem()
            .find("may be written by CALL JOB:gone, which no file read holds") != std::string::npos);
  ImportOptions other;
  other.routine = "B-1";
  const Reading start = run(three, calls, other, {frames, {"B-1.JBI", called}});
  CHECK(start.problem().find("'IARG#(1)'") != std::string::npos);
}

TEST_CASE("inform: another robot's moves, stations and two robots at once are reported") {
  const std::string second = job("SECOND", three, "MOVJ C00001 VJ=9\n", "///GROUP1 RB2\n");
  const Reading r = run(three, "MOVJ C00000 VJ=9\nCALL JOB:SECOND\n", {}, {frames, {"S.JBI", second}});
  CHECK(r.program.instructions.size() == 1);
  CHECK(skips(r, "moves rb2, another robot than rb1", true));
  CHECK(Reader{Language::inform}(
            {{"A.JBI", job("A", three, "MOVJ C00000 VJ=9\n", "///GROUP1 RB1\n///GROUP2 RB2\n")}, frames})
            .problem()
            .find("moves two robots at once") != std::string::npos);
  const std::string station = three + "///POSTYPE PULSE\n///PULSE\nEC00000=100\nEC00001=101\nEC00002=90000\n";
  const Reading still = run(station, "MOVJ C00000 VJ=9 +MOVJ EC00000 VJ=9\nMOVJ C00001 VJ=9 +MOVJ EC00001 VJ=9\n");
  REQUIRE(still.problem() == "no such problem");
  CHECK(!skips(still, "station", true));
  const Reading turned = run(station, "MOVJ C00000 VJ=9 +MOVJ EC00000 VJ=9\nMOVJ C00001 EC00002 VJ=9\n");
  CHECK(skips(turned, "station axes move with the robot", true));
  CHECK(skips(run(three, "PSTART JOB:SECOND SUB1\nMOVJ C00000 VJ=9\n", {}, {frames, {"S.JBI", second}}),
              "PSTART JOB:second: runs beside this job", true));
}

TEST_CASE("inform: RCONF says which arm, the meaning of its first number is reported and can be given") {
  const std::string old =
      "///TOOL 1\n///POSTYPE BASE\n///RECTAN\n///RCONF 1,0,1,0,1,0,0,0\nC00000=1.0,2.0,3.0,0.0,0.0,0.0\n";
  const Reading r = run(old, "MOVJ C00000 VJ=9\n");
  CHECK(r.move(0).target.configuration.text() == "motoman 1 0 1 0 1 0");
  CHECK(skips(r, "taken as axis R within 90 deg of its zero", true));
  const Reading newer = run(three, "MOVJ C00000 VJ=9\n");
  CHECK(newer.move(0).target.configuration.text() == "motoman 3 0 0 0 0 0");
  CHECK(skips(newer, "taken as the sign of axis B", true));
  for (const char* answer : {"\"B\"", "\"R\""}) {  // the note names both, and each ends it
    CHECK(skips(newer, "{name: rconf_flip, value: '" + std::string(answer) + "'}", true));
    CHECK(!skips(run(three, "MOVJ C00000 VJ=9\n", given({{"rconf_flip", answer}})), "RCONF", true));
  }
  const Reading told = run(three, "MOVJ C00000 VJ=9\n", given({{"rconf_flip", "\"R\""}}));
  CHECK(told.move(0).target.configuration.text() == "motoman 1 0 0 0 0 0");
  CHECK(arm_configuration("motoman 3 0 0 0 0 0").value() == newer.move(0).target.configuration);
  CHECK(!arm_configuration("motoman 3 0 0"));
}

TEST_CASE("inform: what is wrong in a job has its line, and counts where the job runs") {
  CHECK(run(three, "MOVJ C00009 VJ=9\n").problem().find("A.JBI:17:6: error: moves to C009") != std::string::npos);
  CHECK(run(three, "JUMP *NOWHERE\n").problem().find("jumps to 'nowhere'") != std::string::npos);
  CHECK(run(three, "IFTHENEXP B000=1\nMOVJ C00000 VJ=9\n").problem().find("before endif") != std::string::npos);
  CHECK(run(three, "SET B000 (1\n").problem().find("has a ( without )") != std::string::npos);
  CHECK(run(three + "C00003=1,x,3\n", "MOVJ C00000 VJ=9\n").problem().find("gives c00003 no list of numbers") !=
        std::string::npos);
  CHECK(Reader{Language::inform}({{"A.JBI", "/JOB\n//NAME A\n"}}).problem().find("holds no //INST") !=
        std::string::npos);
  CHECK(skips(run(three, "MOVJ C00000 VJ=9\nWVON WEV#(1)\nFORMCUT FCF#(1)\nDOUT OT#(1) ON\n"), "FORMCUT", true));
}

TEST_CASE("inform: a jump to the label of a number leads there") {
  // A subroutine without CALL: a number stores the label to return to.
  const std::string lines =
      "SET B000 4\nJUMP *SUB\n*4\nMOVL C00000 V=100.0\nSET B000 5\nJUMP *SUB\n*5\nMOVL C00001 V=100.0\nJUMP *LAST\n*SUB\nMOVL "
      "C00002 V=100.0\nJUMP LABEL: B000\nMOVL C00000 V=1.0\n*LAST\n";
  const Reading r = run(three, lines);
  REQUIRE(r.problem() == "no such problem");
  const int first = r.move(0).where.line;
  CHECK(lines_of(r) == std::vector<int>{first, first - 7, first, first - 3});
  CHECK(run(three, "SET B000 9\nJUMP LABEL: B000\n*4\nMOVL C00000 V=1.0\n")
            .problem()
            .find("jumps to 'LABEL: B000', which is no label") != std::string::npos);
  const Reading asked =
      run(three, "GETARG B000 IARG#(1)\nJUMP LABEL: B000\nMOVL C00000 V=1.0\n*7\nMOVL C00001 V=1.0\n");
  REQUIRE(asked.problems.size() == 1);
  CHECK(asked.problem().find("IARG#(1)") != std::string::npos);
  const Reading chosen =
      run(three, "JUMP LABEL: B098\nMOVL C00000 V=1.0\n*7\nMOVL C00001 V=1.0\n*12\nMOVL C00002 V=1.0\n");
  REQUIRE(chosen.problems.size() == 1);
  REQUIRE(chosen.problems[0].questions.size() == 1);
  CHECK(chosen.problems[0].questions[0].name == "B098");
  CHECK(chosen.problems[0].questions[0].form == "one of 12, 7");
}

TEST_CASE("inform: a comment behind an instruction ends its line, one in a text does not") {
  const Reading r = run(three, "MOVL C00000 V=100.0 'first\nMSG \"it's here\"\nMOVL C00001 V=100.0\t' MOVL C00002\n");
  REQUIRE(r.problem() == "no such problem");
  CHECK(r.program.instructions.size() == 2);
  CHECK(lines_of(run(three, "SET S000 \"ab\"\nJUMP *END IF S000=\"ab\"\nMOVJ C00000 VJ=9\n*END\nMOVJ C00001 VJ=9\n")) ==
        std::vector<int>{21});
}

TEST_CASE("inform: a position that several jobs hold is asked for where they differ") {
  const auto other = [](const char* y) {
    return std::pair<std::string, std::string>{
        "B.JBI", job("B", base + "P00005=1000.000," + y + ",500.000,180.0000,0.0000,0.0000\n", "MOVL P005 V=50.0\n")};
  };
  const std::string own = base + "P00005=1000.000,0.000,500.000,180.0000,0.0000,0.0000\n",
                    lines = "MOVL P005 V=100.0\nCALL JOB:B\n";
  CHECK(run(own, lines, {}, {frames, other("0.000")}).problem() == "no such problem");
  const Reading asked = run(own, lines, {}, {frames, other("7.000")});
  REQUIRE(asked.problems.size() == 1);
  REQUIRE(asked.problems[0].questions.size() == 1);
  CHECK(asked.problems[0].questions[0].name == "P005");
  const Reading told =
      run(own, lines, given({{"P005", "[[1000, 9, 500, 180, 0, 0], \"base\", 0, 1, [0, 0, 0, 0, 0, 0]]"}}),
          {frames, other("7.000")});
  REQUIRE(told.problem() == "no such problem");
  REQUIRE(told.program.instructions.size() == 2);
  for (int i : {0, 1}) CHECK(told.move(i).target.pose.position.y() == Approx(0.009).epsilon(rounding));
}

TEST_CASE("inform: V of a line replaces both speeds of SPEED") {
  const Reading r = run(three, "SPEED V=300.0 VR=20.0\nMOVL C00000 V=100.0\nMOVL C00001 VR=30.0\nMOVL C00002\n");
  REQUIRE(r.problem() == "no such problem");
  CHECK(r.move(0).speed.tool.value() == Approx(0.1));
  CHECK(!r.move(0).speed.orientation);
  CHECK(!r.move(1).speed.tool);
  CHECK(r.move(1).speed.orientation.value() == Approx(30 * degree));
  CHECK(r.move(2).speed.tool.value() == Approx(0.3));
  CHECK(r.move(2).speed.orientation.value() == Approx(20 * degree));
}

TEST_CASE("inform: times of TIMER are seconds") {
  CHECK_THAT(run(three, "MOVJ C00000 VJ=9\nTIMER T=500ms\n").problem(),
             Catch::Contains("has 'ms' behind a time, which counts seconds"));
  for (const char* time : {"TIMER T=-1\n", "SET I000 -1\nTIMER T=I000\n"})
    CHECK_THAT(run(three, "MOVJ C00000 VJ=9\n" + std::string(time)).problem(),
               Catch::Contains("waits for a time below 0"));
  CHECK(run(three, "MOVJ C00000 VJ=9\nTIMER T=0.00 //none\n").problem() == "no such problem");
}

TEST_CASE("inform: frames of SFTON and IMOV that are not read, and words of SPEED, are named") {
  const std::string taught = three + "P00001=10.000,20.000,30.000,0.0000,0.0000,0.0000\n";
  const auto lines = [&](const std::string& first) {
    return run(taught, "MOVL C00000 V=9\n" + first + "MOVL C00001 V=9\n");
  };
  CHECK(skips(lines("SFTON P001 XF\n"), "SFTON: what XF does to the move is not read", true));
  CHECK(skips(lines("SFTON P001 MTF\n"), "SFTON: what MTF does to the move is not read", true));
  CHECK(skips(lines("IMOV P001 V=9 MTF\n"), "IMOV: what MTF does to the move is not read", true));
  CHECK(skips(lines("IMOV P001 V=9 XF\n"), "IMOV: what XF does to the move is not read", true));
  CHECK(skips(lines("SFTON\n"), "SFTON: names no position", true));
  CHECK(skips(lines("SPEED VV=30\n"), "SPEED: what VV=30 does to the move is not read", true));
  for (const char* first :
       {"SFTON P001\n", "SFTON P001 BF\n", "SFTON P001 RF\n", "SFTON P001 TF\n", "SPEED VJ=9 V=9 VR=9 VE=9\n"}) {
    INFO(first);
    CHECK(!skips(lines(first), "is not read", true));
  }
}

TEST_CASE("inform: GETE reads a number of a position in counts of SETE") {
  const std::string taught = three + "P00001=10.000,20.000,30.500,0.0000,0.0000,1.5000\n";
  const auto read = [&](const std::string& gete, const std::string& count) {
    return lines_of(run(taught, gete + "JUMP *END IF D001=" + count + "\nMOVJ C00000 VJ=9\n*END\nMOVJ C00001 VJ=9\n"));
  };
  CHECK(read("GETE D001 P001 (3)\n", "30500").size() == 1);
  CHECK(read("GETE D001 P001 (6)\n", "15000").size() == 1);
  CHECK(read("SET I000 1\nGETE D[I000] P001 (1)\n", "10000").size() == 1);
  CHECK(run(taught, "GETE D001 P009 (3)\nJUMP *END IF D001=1\nMOVJ C00000 VJ=9\n*END\n")
            .problem()
            .find("may be written by gete") != std::string::npos);
}

TEST_CASE("inform: jumps to a label by number have a limit of their ways") {
  std::string lines;
  for (int k = 0; k < 200; ++k) lines += fmt::format("*{}\nJUMP LABEL: B000\n", k);
  const Reading r = run(three, "JUMP *END\n" + lines + "*END\nMOVJ C00000 VJ=9\n");
  REQUIRE(r.problems.size() == 1);
  CHECK(r.problem().find("more than 20000 ways") != std::string::npos);
}
