#include <algorithm>
#include <cmath>

#include "pipeline/settings/document.h"
#include "sim/program/fanuc/run.h"
#include "tests/catch.h"
#include "tests/sim/program/reading.h"

using namespace dresslife;
using namespace dresslife::sim;
using namespace dresslife::tests;

namespace {

constexpr double rounding = 1e-12;  // rounding error of a few products of numbers near 1

const std::string positions = R"(/POS
P[1]{
   GP1:
	UF : 0, UT : 0,
	J1=    10.000 deg,	J2=    20.000 deg,	J3=   -30.000 deg,
	J4=     0.000 deg,	J5=    50.000 deg,	J6=     0.000 deg
};
P[2:"weld"]{
   GP1:
	UF : 0, UT : 1,		CONFIG : 'F U T, 0, -1, 1',
	X =  1000.000  mm,	Y =   -20.500  mm,	Z =      .500  mm,
	W =   180.000 deg,	P =     0.000 deg,	R =    90.000 deg
   GP2:
	UF : 1, UT : 2,
	J1 = 45.0 deg
};
/END
)";

Reading run(const std::string& lines, const ImportOptions& options = {}, const std::string& more = "") {
  const std::vector<NamedFrame> tools{{"UTOOL[1]", {Vector3(0, 0, 0.4), Quaternion::Identity()}, false}};
  Files files{{"cell.ls", "/PROG CELL\n/ATTR\nCOMMENT = \"\";\n/MN\n" + lines + positions}};
  if (!more.empty()) files.push_back({"more.ls", "/PROG MORE\n/MN\n" + more + positions});
  return Reader{Language::fanuc, options, tools}(files);
}

}  // namespace

TEST_CASE("fanuc: an answer that the program does not ask for is a warning") {
  ImportOptions options =
      given({{"R[7]", "3"}, {"R[8]", "3"}, {"DI[9]", "ON"}, {"PR[2]", "J1 1 J2 2 J3 3 J4 4 J5 5 J6 6"}});
  options.assume["cell.ls:99"] = Assumption::then_branch;
  options.choose["cell.ls:98"] = "2";
  const Reading r = run("1:J P[1] 50% FINE ;\n2:IF R[8]>1,JMP LBL[1] ;\n3:J P[1] 20% FINE ;\n4:LBL[1] ;\n", options);
  REQUIRE(r.problem() == "no such problem");
  for (const char* answer : {"motion.values of r[7]", "motion.values of di[9]", "motion.values of pr[2]",
                             "motion.assume of cell.ls:99", "motion.assume of cell.ls:98"})
    CHECK(skips(r, answer, true));
  CHECK(!skips(r, "motion.values of r[8]", true));
}

TEST_CASE("fanuc: moves, speeds, terminations, the third axis is given against the horizontal") {
  const Reading r =
      run("   1:J P[1] 50% CNT100 ACC80   ;\n   2:  !comment; with a semicolon ;\n   3:L P[2:weld] 500mm/sec "
          "FINE SPOT[SD=1]   ;\n"
          "   4:L P[2] 30cm/min CNT50    ;\n   5:C P[2]    \n    :  P[2] 100mm/sec CNT0    ;\n   6:J P[1] "
          "2.5sec FINE ;\n   7:  WAIT    .50(sec) ;\n");
  REQUIRE(r.problem() == "no such problem");
  REQUIRE(r.program.instructions.size() == 7);
  const std::vector<double> expected{10, 20, -10, 0, 50, 0};  // q3 = J3 + J2
  for (int i = 0; i < 6; ++i) CHECK(r.move(0).target.joints[i] == Approx(expected[i] * degree).margin(rounding));
  CHECK(r.move(0).speed.axis_percent.value() == 50);
  CHECK(r.move(0).zone.percent == 100);
  CHECK(r.move(0).acceleration_percent == 80);
  CHECK((r.move(1).target.pose.position - Vector3(1, -0.0205, 0.0005)).norm() < rounding);
  CHECK(r.move(1).target.pose.orientation.isApprox(rotation({0, 0, 90 * degree}) * rotation({180 * degree, 0, 0}),
                                                   rounding));
  CHECK(r.move(1).target.configuration.text() == "fanuc FUT 0 -1 1");
  CHECK(r.program.tools.at(r.move(1).tool).name == "UTOOL[1]");
  CHECK(r.move(2).dwell == 1);
  CHECK(r.move(3).speed.tool.value() == Approx(0.005).epsilon(rounding));
  CHECK(r.move(3).zone.percent == 50);
  CHECK(r.move(4).kind == Instruction::Kind::circular);
  CHECK(r.move(5).speed.duration.value() == 2.5);
  CHECK(r.move(6).dwell == 0.5);
  CHECK(r.move(1).where.line == 7);
}

TEST_CASE("fanuc: registers, loops, labels, calls") {
  const Reading r =
      run(" 1: R[1]=0 ;\n 2: LBL[1] ;\n 3: R[1]=R[1]+1 ;\n 4: CALL MORE ;\n 5: IF R[1]<3,JMP LBL[1] ;\n 6: "
          "FOR R[2]=1 TO 2 ;\n 7:J P[1] 10% FINE ;\n 8: ENDFOR ;\n"
          " 9: SELECT R[1]=1,JMP LBL[9] ;\n10:        =3,CALL MORE ;\n11:        ELSE,JMP LBL[9] ;\n12: IF "
          "(R[1]>1 AND R[2]=2) THEN ;\n13:J P[1] 20% FINE ;\n14: ELSE ;\n"
          "15:J P[1] 30% FINE ;\n16: ENDIF ;\n17: LBL[9] ;\n18: LBL[5] ;\n19:J P[1] 40% FINE ;\n20: JMP "
          "LBL[5] ;\n",
          {}, " 1:J P[1] R[1]% FINE ;\n");
  REQUIRE(r.problem() == "no such problem");
  std::vector<double> percents;
  for (const Instruction& i : r.program.instructions) percents.push_back(i.speed.axis_percent.value());
  CHECK(percents == std::vector<double>{1, 2, 3, 10, 10, 3, 20, 40});
  CHECK(r.move(0).routine == "more");
}

TEST_CASE("fanuc: inputs are asked for, missing frames and programs named") {
  const Reading r =
      run(" 1: IF DI[3]=ON,JMP LBL[1] ;\n 2:J P[1] R[9]% FINE ;\n 3: LBL[1] ;\n 4: UTOOL_NUM=2 ;\n 5: CALL "
          "OTHER ;\n 6: DO[1]=ON ;\n 7:J P[7] 5% FINE ;\n");
  REQUIRE(r.problems.size() == 3);
  CHECK(
      r.problem(0) ==
      "cell.ls:5:4: error: branches on DI[3], which is known only while the robot runs; choose with "
      "motion.assume: [{line: 'cell.ls:5', take: then}] or take: else, or give motion.values: [{name: 'DI[3]', value: VALUE}]");
  for (const char* what :
       {"has a speed by R[9], which is known only while the robot runs", "moves to P[7], which is not listed"})
    CHECK(std::any_of(r.problems.begin(), r.problems.end(),
                      [&](const Problem& problem) { return problem.what == what; }));
  REQUIRE(r.program.skipped.size() == 2);
  CHECK(r.program.skipped[0].may_move);
  CHECK_FALSE(r.program.skipped[1].may_move);
  ImportOptions options;
  options.assume["5"] = Assumption::then_branch;
  CHECK(run(" 1: IF DI[3]=ON,JMP LBL[1] ;\n 2:J P[7] 5% FINE ;\n 3: LBL[1] ;\n 4:J P[1] 5% FINE ;\n", options)
            .program.instructions.size() == 1);
}

TEST_CASE("fanuc: every unit of speed under an override, every way to end a move") {
  const Reading r =
      run("   1:  OVERRIDE=50% ;\n   2:J P[1] 40% CNT150 ACC200 ;\n   3:L P[2] 500mm/sec CD20 ;\n"
          "   4:L P[2] 90cm/min CR30 ;\n"
          "   5:L P[2] 60inch/min FINE ;\n   6:L P[2] 90deg/sec FINE ;\n   7:J P[1] 1500msec FINE ;\n"
          "   8:J P[1] 3sec CNT0 ACC0 ;\n"
          "   9:J P[1] 250% FINE ;\n");
  REQUIRE(r.problem() == "no such problem");
  REQUIRE(r.program.instructions.size() == 8);
  CHECK(r.move(0).speed.axis_percent.value() == Approx(20));
  CHECK(r.move(0).zone.percent == 100);
  CHECK(r.move(0).acceleration_percent == 150);
  const auto is_noted = [&](const std::string& what) {
    return std::ranges::any_of(r.program.skipped,
                               [&](const Skipped& skipped) { return skipped.what == what && skipped.may_move; });
  };
  CHECK(is_noted("ACC200: outside of the controller's range 1 .. 150 (the nearest of these counts)"));
  CHECK(is_noted("ACC0: outside of the controller's range 1 .. 150 (the nearest of these counts)"));
  CHECK(r.move(1).speed.tool.value() == Approx(0.25));
  CHECK(r.move(1).zone.distance == Approx(0.02));
  CHECK(r.move(2).speed.tool.value() == Approx(0.9 / 60 / 2));
  CHECK(r.move(2).zone.distance == Approx(0.03));
  CHECK(r.move(3).speed.tool.value() == Approx(60 * 0.0254 / 60 / 2));
  CHECK(r.move(4).speed.orientation.value() == Approx(45 * degree));
  CHECK(r.move(5).speed.duration.value() == Approx(3));
  CHECK(r.move(6).speed.duration.value() == Approx(6));
  CHECK(r.move(6).acceleration_percent == 1);
  CHECK(r.move(7).speed.axis_percent.value() == Approx(50));
}

TEST_CASE("fanuc: frames as six numbers and back, also where the second turn is a right angle") {
  for (const double p : {-90.0, -35.0, 0.0, 80.0, 90.0})
    for (const double w : {-150.0, 20.0, 120.0})
      for (const double r : {-100.0, 0.0, 170.0}) {
        const Frame frame = frame_of_fanuc({100, -20, 3, w, p, r});
        const std::vector<double> numbers = fanuc_values_of(frame);
        const Frame again = frame_of_fanuc(numbers);
        CAPTURE(w, p, r);
        CHECK((again.position - frame.position).norm() < rounding);
        CHECK(std::abs(again.orientation.dot(frame.orientation)) == Approx(1).epsilon(rounding));
        CHECK((frame.position - Vector3(0.1, -0.02, 0.003)).norm() < rounding);
        constexpr double near_pole = 1e-5;  // [deg] atan2 of a cosine of 1e-16
        CHECK(numbers[4] == Approx(p).margin(near_pole));
        if (std::abs(p) < 90) CHECK(numbers[3] == Approx(w).margin(near_pole));
        if (std::abs(p) < 90) CHECK(numbers[5] == Approx(r).margin(near_pole));
      }
}

TEST_CASE("fanuc: joint angles are offset one by one, and only by joint angles") {
  const auto moved = [](const std::string& offset) {
    ImportOptions options;
    options.values["PR[1]"] = offset;
    return run("   1:J P[1] 40% FINE Offset,PR[1] ;\n", options);
  };
  const Reading r = moved("J1 1 J2 2 J3 3 J4 4 J5 5 J6 6");
  REQUIRE(r.problem() == "no such problem");
  const std::vector<double> expected{11, 22, -5, 4, 55, 6};  // q3 = J3 + J2
  for (std::size_t i = 0; i < 6; ++i) CHECK(r.move(0).target.joints[i] == Approx(expected[i] * degree));
  CHECK(moved("X 0 Y 0 Z 0 W 0 P 0 R 0").move(0).target.joints[1] == Approx(20 * degree));
  CHECK(moved("X 1 Y 0 Z 0 W 0 P 0 R 0").problems.at(0).what == "is offset in space from joint angles");
}

TEST_CASE("fanuc: a decimal comma in a position is refused") {
  std::string listing = "/PROG CELL\n/MN\n   1:J P[1] 50% FINE ;\n" + positions;
  listing.replace(listing.find("20.000"), 6, "20,5");
  const Reading r = Reader{Language::fanuc}({{"cell.ls", listing}});
  CHECK(
      r.problem() ==
      "cell.ls:5:1: error: has a decimal comma in J2; write six coordinates or the joint angles, in mm and deg, with decimal points");
}

TEST_CASE("fanuc: a position without its head is one problem, at its line") {
  std::string listing = "/PROG CELL\n/MN\n   1:J P[1] 50% FINE ;\n" + positions;
  const std::size_t head = listing.find("P[1]", listing.find("/POS"));
  listing.replace(head, listing.find('{', head) + 1 - head, "");
  const Reading r = Reader{Language::fanuc}({{"cell.ls", listing}});
  REQUIRE(r.problems.size() == 1);
  CHECK(
      r.problem() ==
      "cell.ls:6:1: error: is no position; list the program again, or write P[n]{ with its number at the begin of the position");
}

TEST_CASE("fanuc: a frame may be given as W, P, R") {
  const auto motion_of = [](const std::string& orientation) {
    return pipeline::motion_from(pipeline::parse_yaml(
        "tools: [{name: 'UTOOL[1]', position_mm: [1, 2, 3], " + orientation + "}]\n", "frames.yaml"));
  };
  const pipeline::Motion motion = motion_of("wpr_deg: [10, -20, 130]");
  const Frame frame = frame_of_fanuc({1, 2, 3, 10, -20, 130});  // the position of a listing
  const std::vector<double>& q = motion.tools.at(0).quaternion;
  REQUIRE(q.size() == 4);
  CHECK(Quaternion(q[0], q[1], q[2], q[3]).angularDistance(frame.orientation) == Approx(0).margin(1e-7));  // acos
  CHECK(
      pipeline::motion_from(pipeline::parse_yaml(pipeline::motion_text(motion), "again.yaml")).tools.at(0).quaternion ==
      q);
  CHECK_THROWS_WITH(motion_of("wpr_deg: [0, 0, 0], quaternion: [1, 0, 0, 0]"),
                    Catch::Contains("both quaternion and wpr_deg are given"));
  CHECK_THROWS_WITH(motion_of("wpr_deg: [0, 0]"), Catch::Contains("is not three angles W, P, R"));
}
