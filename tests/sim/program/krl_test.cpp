#include "sim/program/krl/spline.h"

#include <cmath>

#include "tests/catch.h"
#include "tests/sim/program/reading.h"

using namespace dresslife;
using namespace dresslife::sim;
using namespace dresslife::tests;

namespace {

constexpr double rounding = 1e-12;  // rounding error of a few products of numbers near 1

Reading run(const std::string& body, const std::string& data = "", const std::vector<NamedFrame>& tools = {}) {
  Files files{{"cell.src", "&ACCESS RVP\nDEF cell()\n" + body + "\nEND\n"}};
  if (!data.empty()) files.push_back({"cell.dat", "DEFDAT cell PUBLIC\n" + data + "\nENDDAT\n"});
  files.push_back(held_frames);
  return Reader{Language::krl, {}, tools}(files);
}

}  // namespace

TEST_CASE("krl: axes, frames with status and turn, circles") {
  const Reading r =
      run("$VEL.CP=0.5\n$TOOL={X 0,Y 0,Z 200,A 0,B 0,C 0}\nPTP {A1 10,A2 -90,A3 90,A4 0,A5 30,A6 0}\n"
          "PTP {X 1000,Y 0,Z 900,A 90,B 0,C 180,S 'B010',T 'B100011'} C_PTP\nLIN {Z 800} C_DIS\nCIRC {X "
          "1000,Y 50,Z 750},{X 1000,Y 0,Z 700}\nLIN_REL {X 5}\nWAIT SEC 0.5");
  REQUIRE(r.problem() == "no such problem");
  REQUIRE(r.program.instructions.size() == 6);
  CHECK(r.move(0).target.joints[4] == Approx(30 * degree).epsilon(rounding));
  CHECK(r.move(0).speed.axis_percent.value() == 100);
  CHECK(r.move(1).target.configuration.text() == "kuka 2 35");
  const Quaternion q = rotation({0, 0, 90 * degree}) * rotation({180 * degree, 0, 0});
  CHECK(r.move(1).target.pose.orientation.isApprox(q, rounding));
  CHECK((r.move(2).target.pose.position - Vector3(1, 0, 0.8)).norm() <
        rounding);  // coordinates that are left out do not change
  CHECK(r.move(2).speed.tool.value() == 0.5);
  CHECK(r.move(3).kind == Instruction::Kind::circular);
  CHECK((r.move(3).via.position - Vector3(1, 0.05, 0.75)).norm() < rounding);
  CHECK(r.move(4).target.pose.position.x() == Approx(1.005).epsilon(rounding));
  CHECK(r.move(5).dwell == 0.5);
  CHECK(r.program.tools.at(r.move(2).tool).frame.position.z() == Approx(0.2).epsilon(rounding));
}

TEST_CASE("krl: what the controller's editor writes, with its data list") {
  const std::string data =
      "DECL E6POS XP1={X 800,Y 100,Z 900,A 0,B 90,C 0,S 2,T 2,E1 0.0,E2 0.0}\nDECL FDAT FP1={TOOL_NO "
      "1,BASE_NO 0,IPO_FRAME #BASE,POINT2[] \" \"}\n"
      "DECL PDAT PPDAT1={VEL 100.0,ACC 60.0,APO_DIST 50.0}\nDECL LDAT LCPDAT1={VEL 2.0,ACC 100.0,APO_DIST "
      "25.0}\n"
      "DECL FRAME TOOL_DATA[16]\nTOOL_DATA[1]={X 10,Y 0,Z 300,A 0,B 0,C 0}";
  const Reading r =
      run(";FOLD PTP P1 CONT Vel=30 % PDAT1 Tool[1] "
          "Base[0];%{PE}\n$BWDSTART=FALSE\nPDAT_ACT=PPDAT1\nFDAT_ACT=FP1\nBAS(#PTP_PARAMS,30)\nPTP XP1 "
          "C_PTP\n;ENDFOLD\n"
          ";FOLD LIN P1\nLDAT_ACT=LCPDAT1\nFDAT_ACT=FP1\nBAS(#CP_PARAMS,0.25)\nLIN XP1 C_DIS C_DIS\n;ENDFOLD\n"
          "SLIN XP1 WITH $VEL.CP=SVEL_CP(0.1, ,LCPDAT1), $TOOL=STOOL2(FP1), $APO=SAPO(LCPDAT1)\nLIN XP1",
          data);
  REQUIRE(r.problem() == "no such problem");
  REQUIRE(r.program.instructions.size() == 4);
  CHECK(r.move(0).speed.axis_percent.value() == 30);
  CHECK(r.move(0).acceleration_percent == 60);
  CHECK(r.move(0).zone.percent == 50);
  CHECK(r.program.tools.at(r.move(0).tool).frame.position.z() == Approx(0.3).epsilon(rounding));
  CHECK(r.move(1).speed.tool.value() == 0.25);
  CHECK(r.move(1).zone.distance == Approx(0.025).epsilon(rounding));
  CHECK(r.move(2).speed.tool.value() == 0.1);
  CHECK(r.move(3).speed.tool.value() == 0.25);  // WITH applies to one move only
}

TEST_CASE("krl: loops, calls, splines") {
  const Reading r =
      run("INT i\n$VEL.CP=1\nPTP {X 500,Y 0,Z 500,A 0,B 0,C 0}\nFOR i=1 TO 3\n  step(i*10)\nENDFOR\nSPLINE "
          "WITH $VEL.CP=0.2\n SPL {X 1}\n SLIN {X 2}\nENDSPLINE\n"
          "LOOP\n i=i+1\n IF i>3 THEN\n  EXIT\n ENDIF\nENDLOOP\nREPEAT\n PTP {A1 0,A2 0,A3 0,A4 0,A5 0,A6 "
          "i}\n i=i-1\nUNTIL i<2\nEND\nDEF step(x:IN)\nDECL REAL x\nLIN {X x}");
  REQUIRE(r.problem() == "no such problem");
  REQUIRE(r.program.instructions.size() >= 6);
  CHECK(r.move(1).target.pose.position.x() == Approx(0.01).epsilon(rounding));
  CHECK(r.move(3).target.pose.position.x() == Approx(0.03).epsilon(rounding));
  CHECK(r.move(1).routine == "step");
  CHECK(r.move(4).zone.percent == 100);
  CHECK(r.move(5).zone.percent == 0);
}

TEST_CASE("krl: SPL points lie on a smooth curve") {
  // A quarter circle of 300 mm with a point every 30 deg, chords c of 155 mm: unit slopes along the circle give
  // arcs of the height c/4 sin(15 deg) = 10.05 mm; arcs of the circle have 10.22 mm.
  std::string block = "$VEL.CP=1\nLIN {X 300,Y 0,Z 0,A 0,B 0,C 0}\nSPLINE\n";
  for (int angle = 30; angle <= 90; angle += 30)
    block +=
        fmt::format(" SPL {{X {:.6f},Y {:.6f}}}\n", 300 * std::cos(angle * degree), 300 * std::sin(angle * degree));
  const Reading r = run(block + "ENDSPLINE\nLIN {X 0}");
  REQUIRE(r.problem() == "no such problem");
  REQUIRE(r.program.instructions.size() > 20);
  double off = 0, longest = 0;
  for (std::size_t k = 1; k + 1 < r.program.instructions.size(); ++k) {
    const Vector3 here = r.move(k).target.pose.position;
    off = std::max(off, std::abs(here.norm() - 0.3));
    longest = std::max(longest, (here - r.move(k - 1).target.pose.position).norm());
  }
  CHECK(off < 2e-4);
  CHECK(longest < 0.04);
  CHECK(r.move(5).kind == Instruction::Kind::linear);
  CHECK(r.move(5).zone.percent == 100);
  CHECK(r.move(5).where.line == 6);
}

TEST_CASE("krl: between SPL points lie cubics with the slopes of parabolas through three of them") {
  std::vector<Instruction> moves(7);
  const std::vector<Vector3> at{{0, 0, 0}, {0.1, 0, 0.02}, {0.3, 0.1, 0}, {0.35, 0.25, 0.05}, {0.2, 0.3, 0}};
  for (std::size_t k = 0; k < at.size(); ++k) {
    moves[k].kind = Instruction::Kind::linear;
    moves[k].target.pose = {at[k], rotation({0, 0, 0.3 * double(k)})};
    moves[k].zone = {0.01 * double(k), 0};
  }
  moves[5] = moves[4], moves[5].kind = Instruction::Kind::dwell;  // a dwell ends the curve
  moves[6] = moves[4], moves[6].target.pose.position.x() += 0.1;
  Program program;
  program.instructions = moves;
  bend_splines({1, 2, 3, 4, 6}, program);
  const std::vector<Instruction>& bent = program.instructions;
  // The parameter is the length of the chords. The slope at a point is that of the Lagrange parabola through three points.
  // The slope at an end is that of the neighbour, mirrored at the middle of the chord.
  const auto chord = [&](std::size_t k) { return Vector3(at[k + 1] - at[k]); };
  const auto slope = [&](std::size_t k) {
    const double a = chord(k - 1).norm(), b = chord(k).norm();
    return Vector3(-b / (a * (a + b)) * at[k - 1] + (b - a) / (a * b) * at[k] + a / (b * (a + b)) * at[k + 1])
        .normalized();
  };
  const auto mirrored = [&](const Vector3& of, std::size_t k) {
    const Vector3 along = chord(k).normalized();
    return Vector3(2 * along.dot(of) * along - of);
  };
  std::size_t next = 1;
  for (std::size_t k = 0; k + 1 < at.size(); ++k) {
    const double length = chord(k).norm();
    const Vector3 begin = length * (k == 0 ? mirrored(slope(1), 0) : slope(k)),
                  finish = length * (k == 3 ? mirrored(slope(3), 3) : slope(k + 1));
    const int steps = int(length / 0.02);
    for (int step = 1; step <= steps; ++step, ++next) {
      const double u = double(step) / steps;
      // Evaluates the cubic as a Bezier curve.
      const Vector3 b1 = at[k] + begin / 3, b2 = at[k + 1] - finish / 3;
      const Vector3 here = std::pow(1 - u, 3) * at[k] + 3 * u * (1 - u) * (1 - u) * b1 + 3 * u * u * (1 - u) * b2 +
                           u * u * u * at[k + 1];
      REQUIRE(next < bent.size());
      CHECK((bent[next].target.pose.position - here).norm() < rounding);
      CHECK(rotation_vector(bent[next].target.pose.orientation).z() == Approx(0.3 * (double(k) + u)));
      CHECK(bent[next].zone.percent == (step < steps ? 100 : 0));
      CHECK(bent[next].zone.distance == (step < steps ? 0 : moves[k + 1].zone.distance));
    }
  }
  CHECK(bent.size() == next + 2);  // the move after the dwell stays: its curve has no start point
  // Two points give a line. A curve cannot start at a point in another frame.
  program.instructions = {moves[0], moves[1]};
  bend_splines({1}, program);
  CHECK(program.instructions.size() == 2);
  program.instructions = {moves[0], moves[1], moves[2], moves[3]};
  program.instructions[2].tool = program.instructions[3].tool = 0;
  bend_splines({1, 2, 3}, program);
  CHECK(program.instructions.size() == 4);
}

TEST_CASE("krl: comparisons come after AND, EXOR and OR in the manual, and before them in most programs") {
  const auto decides = [](const std::string& condition) {
    return run("INT n\nBOOL no,yes\nn=5\nno=FALSE\nyes=TRUE\nPTP {A1 1,A2 -90,A3 90,A4 0,A5 30,A6 0}\nIF " + condition +
               " THEN\nPTP {A1 2}\nENDIF");
  };
  const auto holds = [&](const std::string& condition) {
    const Reading r = decides(condition);
    REQUIRE(r.problem() == "no such problem");
    return r.program.instructions.size() == 2;
  };
  // EXOR binds closer than OR: TRUE OR (FALSE EXOR TRUE). The other order gives FALSE.
  CHECK(holds("yes OR no EXOR yes"));
  // One of the orders combines a number with a truth value.
  CHECK(holds("n == 5 AND yes"));
  CHECK(!holds("n > 5 OR n == 4 AND yes"));
  CHECK(holds("n B_AND 4 == 4"));
  // Both orders have the value: (FALSE == FALSE) AND TRUE, FALSE == (FALSE AND TRUE).
  CHECK(holds("no == FALSE AND yes"));
  // (FALSE == TRUE) AND FALSE is FALSE, FALSE == (TRUE AND FALSE) is TRUE.
  const Reading asked = decides("no == yes AND no");
  REQUIRE(asked.problems.size() == 1);
  CHECK(asked.problem().find("is TRUE with comparisons after AND, EXOR and OR (KRL's priorities), and FALSE with "
                             "comparisons first") != std::string::npos);
  CHECK(!holds("(no == yes) AND no"));
  CHECK(holds("no == (yes AND no)"));
}

TEST_CASE("krl: jumps over moves and back to a label, and an endless one is one pass") {
  const std::string start = "INT i\n$VEL.CP=1\nPTP {X 500,Y 0,Z 500,A 0,B 0,C 0}\n";
  const Reading over = run(start + "GOTO done\nLIN {X 1}\ndone:\nLIN {X 2}");
  REQUIRE(over.problem() == "no such problem");
  REQUIRE(over.program.instructions.size() == 2);
  CHECK(over.move(1).target.pose.position.x() == Approx(0.002).epsilon(rounding));
  const Reading back = run(start + "i=0\nagain:\ni=i+1\nLIN {X i}\nIF i<4 THEN\n GOTO again\nENDIF\nLIN {X 9}");
  REQUIRE(back.problem() == "no such problem");
  REQUIRE(back.program.instructions.size() == 6);
  CHECK(back.move(4).target.pose.position.x() == Approx(0.004).epsilon(rounding));
  const Reading endless = run(start + "again:\nLIN {X 1}\nLIN {X 2}\nGOTO again\nLIN {X 9}");
  REQUIRE(endless.problem() == "no such problem");
  CHECK(endless.program.instructions.size() == 3);
  REQUIRE(endless.program.skipped.size() == 1);
  CHECK(endless.program.skipped[0].what == "an endless loop; the motion is one pass");
  CHECK(run(start + "GOTO nowhere").problem() ==
        "cell.src:6:6: error: jumps to 'nowhere', which is no label in a block around it; correct the label, or "
        "write a loop");
  const Reading asked = run(start + "IF $IN[1] THEN\n GOTO done\nENDIF\nLIN {X 1}\ndone:\nLIN {X 2}");
  CHECK(asked.problems.size() == 1);
}

TEST_CASE("krl: external axes are kept where one of them is used") {
  const Reading unused =
      run("PTP {A1 0,A2 -90,A3 90,A4 0,A5 0,A6 0,E1 0,E2 0}\nPTP {A1 1,A2 -90,A3 90,A4 0,A5 0,A6 0,E1 0,E2 0}");
  CHECK(unused.move(0).target.external_axes.empty());
  const Reading used =
      run("PTP {A1 0,A2 -90,A3 90,A4 0,A5 0,A6 0,E1 500,E2 0}\nPTP {A1 1,A2 -90,A3 90,A4 0,A5 0,A6 0,E1 0,E2 0}");
  REQUIRE(used.move(1).target.external_axes.size() == 2);
  CHECK(used.move(0).target.external_axes[0] == 500);
  CHECK(used.move(1).target.external_axes[0] == 0);
}

TEST_CASE("krl: each external axis keeps its own place, also where it is moved by a way") {
  const std::string axes = "A1 0,A2 -90,A3 90,A4 0,A5 0,A6 0";
  const Reading r =
      run("PTP {" + axes + ",E1 10,E3 30}\nPTP_REL {E3 5}\nPTP_REL {A1 1,E2 -2,E1 1}\nPTP {" + axes + ",E2 7}");
  REQUIRE(r.program.instructions.size() == 4);
  CHECK(r.move(0).target.external_axes == std::vector<double>{10, 0, 30});
  CHECK(r.move(1).target.external_axes == std::vector<double>{10, 0, 35});
  CHECK(r.move(2).target.external_axes == std::vector<double>{11, -2, 35});
  CHECK(r.move(3).target.external_axes == std::vector<double>{11, 7, 35});
}

TEST_CASE("krl: problems name what is missing and where") {
  const Reading r =
      run("PTP XP7\nLIN {X 1,Y 0,Z 0,A 0,B 0,C 0}\nBAS(#TOOL,3)\n$VEL.CP=1\nLIN {X 1,Y 0,Z 0,A 0,B 0,C "
          "0}\nIF $IN[1] THEN\nPTP {A1 0,A2 0,A3 0,A4 0,A5 0,A6 0}\nENDIF");
  REQUIRE(r.problems.size() == 4);
  CHECK(r.problem(0) ==
        "cell.src:3:5: error: moves to 'xp7', which no file read declares; give the .dat file that declares "
        "it, write the target as a constant, or motion.values: [{name: 'cell:xp7', value: '{X ...}'}]");
  CHECK(r.problems[1].what == "moves along a path before $VEL.CP is assigned (its value lies in the controller)");
  CHECK(r.problems[2].what == "moves with TOOL_DATA[3], which no file read declares");
  CHECK(r.problems[3].where.line == 8);
  const Reading given = run("BAS(#TOOL,3)\n$VEL.CP=1\nLIN {X 1,Y 0,Z 0,A 0,B 0,C 0}", "",
                            {{"TOOL_DATA[3]", {Vector3(0, 0, 1), Quaternion::Identity()}, false}});
  CHECK(given.problems.empty());
}
