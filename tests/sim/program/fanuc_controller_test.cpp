// Rules of a Fanuc controller for its listings. Each test gives the reason of its rule.

#include "tests/catch.h"
#include "tests/sim/program/reading.h"

using namespace dresslife;
using namespace dresslife::sim;
using namespace dresslife::tests;

namespace {

constexpr double rounding = 1e-9;  // rounding error of millimetres and angles after a dozen products

const std::string joints = R"(P[1]{
   GP1:
	UF : 0, UT : 0,
	J1= 1.000 deg,	J2= 0.0 deg,	J3= 0.0 deg,
	J4= 0.0 deg,	J5= -30.0 deg,	J6= 0.0 deg
};
P[2]{
   GP1:
	UF : 0, UT : 0,
	J1= 2.000 deg,	J2= 0.0 deg,	J3= 0.0 deg,
	J4= 0.0 deg,	J5= -30.0 deg,	J6= 0.0 deg
};
)";
const std::string poses = R"(P[3]{
   GP1:
	UF : 3, UT : 2,	CONFIG : 'N U T, 0, 0, 0',
	X = 1000.0 mm,	Y = 0.0 mm,	Z = 300.0 mm,
	W = 180.0 deg,	P = 0.0 deg,	R = 0.0 deg
};
P[4]{
   GP1:
	UF : 3, UT : 2,	CONFIG : 'N U T, 0, 0, 0',
	RX = 100.0 mm,	RY = 0.0 mm,	RZ = 300.0 mm,
	RW = 0.0 deg,	RP = 0.0 deg,	RR = 90.0 deg
};
P[5]{
   GP1:
	UF : 3, UT : 2,	CONFIG : 'N U T, 0, 0, 0',
	X = ********  mm,	Y = ********  mm,	Z = ********  mm,
	W = ******** deg,	P = ******** deg,	R = ******** deg
};
P[7]{
   GP1:
	UF : 3, UT : 2,	KONFIG : 'F U T, 0, 1, 0',
	X = 1000.0 mm,	Y = 0.0 mm,	Z = 300.0 mm,
	W = 180.0 deg,	P = 0.0 deg,	R = 0.0 deg
};
P[8]{
   GP1:
	UF : 3, UT : 2,	CONFIG : 'N U T, 0, 0, 0',
	X = 1000.0 mm,	Y = 0.0 mm,	Z = 400.0 mm,
	W = 180.0 deg,	P = 0.0 deg,	R = 0.0 deg
   GP2:
	UF : 3, UT : 2,
	J1= 90.0 deg
};
P[6]{
   GP2:
	UF : 0, UT : 1,
	J1= 45.0 deg
};
)";

struct Asked {
  std::map<std::string, std::string> values = {}, choose = {};
  std::map<std::string, Assumption> assume = {};
  int passes = 0;
  std::string routine = "";
};

/// Reads these lines as the program CELL, with further files (name, text).
Reading run(const std::string& lines, const Asked& asked = {}, const Files& more = {}) {
  ImportOptions options;
  options.values = asked.values;
  options.choose = asked.choose;
  options.assume = asked.assume;
  options.passes = asked.passes;
  options.routine = asked.routine;
  const std::vector<NamedFrame> tools{{"UTOOL[2]", {Vector3(0, 0, 0.4), Quaternion::Identity()}, false}};
  const std::vector<NamedFrame> objects{{"UFRAME[3]", {Vector3(1, 0, 0), Quaternion::Identity()}, false}};
  Files files{{"cell.ls", "/PROG  CELL\n/ATTR\n/MN\n" + lines + "/POS\n" + joints + poses + "/END\n"}};
  files.insert(files.end(), more.begin(), more.end());
  return Reader{Language::fanuc, options, tools, objects}(files);
}

/// Returns the angle of axis 1 [deg] of each move to joint angles.
std::vector<int> stops(const Reading& reading) {
  std::vector<int> list;
  for (const Instruction& i : reading.program.instructions)
    if (i.kind != Instruction::Kind::dwell && !i.target.joints.empty())
      list.push_back(static_cast<int>(std::lround(i.target.joints[0] / degree)));
  return list;
}

std::string listing(const std::string& name, const std::string& lines) {
  return "/PROG  " + name + "\n/MN\n" + lines + "/POS\n" + joints + "/END\n";
}

std::vector<std::string> warnings(const Reading& reading) {
  std::vector<std::string> list;
  for (const Skipped& s : reading.program.skipped)
    if (s.may_move) list.push_back(s.what);
  return list;
}

}  // namespace

TEST_CASE("fanuc lines: one without a semicolon ends where the next number begins") {
  // A controller does not load this listing. Its meaning is clear, and no line may become part of another line.
  const Reading moves = run("   1:J P[1] 100% FINE\n   2:J P[2] 100% FINE ;\n   3:\n   4:J P[1] 100% FINE ;\n");
  CHECK(moves.problem() == "no such problem");
  CHECK(stops(moves) == std::vector<int>{1, 2, 1});
  REQUIRE(moves.program.skipped.size() == 1);
  CHECK(moves.program.skipped[0].what == "no ';' at the end: the statement ends with its line");
  CHECK(stops(run("   1:  !don't stop; here\n   2:J P[1] 100% FINE ;\n")) == std::vector<int>{1});
}

TEST_CASE("fanuc lines: what VW robots run at the end of a move") {
  const Reading r =
      run("   1:J P[1] 100% CNT0 ACC100 TB   0.00sec,P-SPS    ;\n      1:  DO[23]=(OFF) ;\n      2:  WAIT    "
          ".10(sec) ;\n       ------ ;\n   2:J P[2] 100% FINE    ;\n");
  CHECK(r.problem() == "no such problem");
  CHECK(stops(r) == std::vector<int>{1, 2});
  CHECK(r.move(1).dwell == 0.1);
}

TEST_CASE("fanuc lines: German listings are the same program") {
  const Reading r =
      run("   1:  BENUTZER_NUM=3 ;\n   2:  WKZ_NUM=2 ;\n   3:  A[79]=AN ;\n   4:  i[5:Zahl]=2 ;\n   5:J P[1] "
          "100% "
          "CNT0 ACC100 ZEIT VOR    .10sek,P-SPS    ;\n      1:  WARTE (E[9] [&] M[3:Tuer] [+] !E[10])    ;\n "
          "     2:  "
          "AUFRUF UP1    ;\n       ------ ;\n   6:  WENN i[5]=2,SPRUNG LABEL[7] ;\n   7:J P[2] 100% FINE ;\n "
          "  8:  "
          "LABEL[7] ;\n   9:L P[3] 500mm/sek CNT0 WKZ_Offset ,PR[1] Offset,PR[2]    ;\n  10:  IST    "
          "i[5]=1,SPRUNG "
          "LABEL[8] ;\n  11:         =2,AUFRUF UP1 ;\n  12:         SONST,SPRUNG LABEL[8] ;\n  13:  LABEL[8] "
          ";\n  14:  "
          "WARTE   0.50(sec) ;\n  15:  ENDE ;\n  16:J P[2] 100% FINE ;\n",
          {.values = {{"PR[1]", "0,0,0,0,0,0"}, {"PR[2]", "X 10 Y 0 Z 0 W 0 P 0 R 0"}}},
          {{"up1.ls", listing("UP1", "   1:J P[2] 50% FINE ;\n")}});
  REQUIRE(r.problem() == "no such problem");
  REQUIRE(r.program.instructions.size() == 5);
  CHECK(stops(r) == std::vector<int>{1, 2, 2});
  CHECK(r.move(2).target.pose.position.x() == Approx(1.01).epsilon(rounding));  // Offset, in mm
  CHECK(r.move(2).speed.tool.value() == Approx(0.5).epsilon(rounding));
  CHECK(r.program.work_objects.at(r.move(2).work_object).name == "UFRAME[3]");
  CHECK(r.move(4).dwell == 0.5);
  CHECK(run("   1:J P[7] 100% FINE ;\n").move(0).target.configuration.text() == "fanuc FUT 0 1 0");
}

TEST_CASE("fanuc positions: what is not taught matters only where a move needs it") {
  CHECK(stops(run("   1:J P[1] 100% FINE ;\n")) == std::vector<int>{1});
  const Reading untaught = run("   1:J P[5] 100% FINE ;\n   2:J P[5] 10% FINE ;\n   3:J P[9] 5% FINE ;\n");
  REQUIRE(untaught.problems.size() == 2);  // one per position; no questions about frames, which a listing contains
  CHECK(untaught.problems[0].what == "moves to P[5], which is not taught");
  CHECK(untaught.problems[1].what == "moves to P[9], which is not listed");
  // P[6] moves only a positioner.
  const Reading positioner = run("   1:J P[1] 100% FINE ;\n   2:J P[6] 100% FINE ;\n");
  CHECK(stops(positioner) == std::vector<int>{1});
}

TEST_CASE("fanuc positions: a remote tool stands in the user frame, the robot carries the work") {
  // RX ... is the pose of UF in UT: 100 mm and 300 mm away, turned by 90 deg about z. The pose of UT in UF is its
  // inverse. The flange is at UF P^-1 UT^-1 with and without RTCP.
  const Reading r =
      run("   1:J P[4] 100% FINE ;\n   2:L P[4] 100mm/sec FINE RTCP ;\n   3:L P[3] 100mm/sec FINE RTCP ;\n");
  REQUIRE(r.problem() == "no such problem");
  const auto flange = [&](const Instruction& i) {
    const NamedFrame &tool = r.program.tools.at(i.tool), &object = r.program.work_objects.at(i.work_object);
    const auto inverse = [](const Frame& f) {
      return Frame{f.orientation.conjugate() * Vector3(-f.position), f.orientation.conjugate()};
    };
    return tool.stationary ? tool.frame * inverse(object.frame * i.target.pose)
                           : object.frame * i.target.pose * inverse(tool.frame);
  };
  // UF at x = 1 m; P^-1: position -Rz(-90) (0.1, 0, 0.3) = (0, 0.1, -0.3); the tool is 0.4 m long.
  const Vector3 expected(1, 0.1, -0.7);
  for (int i : {0, 1}) CHECK((flange(r.move(i)).position - expected).norm() < rounding);
  CHECK_FALSE(r.program.tools.at(r.move(0).tool).stationary);
  CHECK(r.program.tools.at(r.move(1).tool).stationary);
  CHECK(r.program.tools.at(r.move(1).tool).name == "UFRAME[3]");
  // A remote move to a position X, Y ...: (2, 0, 0.3) with the tool pointing down; the flange is 0.4 m above.
  CHECK((flange(r.move(2)).position - Vector3(2, 0, 0.7)).norm() < rounding);
}

TEST_CASE("fanuc loops: one that changes nothing waits, and the motion goes on behind it") {
  // The user gives the value of DI[1], but not the time at which it changes.
  for (const char* wait : {"", "   2:  WAIT .10(sec) ;\n", "   2:  R[5]=3 ;\n   2:  F[1]=OFF ;\n"}) {
    const Reading r =
        run(std::string("   1:  LBL[1] ;\n") + wait + "   3:  IF DI[1]=OFF,JMP LBL[1] ;\n   4:J P[1] 100% FINE ;\n",
            {.values = {{"DI[1]", "OFF"}}});
    INFO(wait << r.problem());
    REQUIRE(r.problems.empty());
    CHECK(stops(r) == std::vector<int>{1});
    INFO(r.program.skipped.size());
    CHECK(std::any_of(r.program.skipped.begin(), r.program.skipped.end(),
                      [](const Skipped& s) { return s.what.find("waits in a loop") == 0; }));
  }
  // Statements after a loop without a condition never run.
  CHECK(stops(run("   1:J P[1] 100% FINE ;\n   2:  LBL[1] ;\n   3:  JMP LBL[1] ;\n   4:J P[2] 100% FINE ;\n")) ==
        std::vector<int>{1});
  // A loop that counts or moves runs until its own end.
  CHECK(stops(run("   1:  R[1]=0 ;\n   2:  LBL[1] ;\n   3:  R[1]=R[1]+1 ;\n   4:  IF R[1]<900,JMP LBL[1] ;\n   "
                  "5:J P[1] R[1]msec FINE ;\n")) == std::vector<int>{1});
  CHECK(
      stops(
          run("   1:  R[1]=0 ;\n   2:  LBL[1] ;\n   3:J P[1] 100% FINE ;\n   4:  R[1]=R[1]+1 ;\n   5:  IF R[1]<5,JMP LBL[1] ;\n"))
          .size() == 5);
}

TEST_CASE("fanuc positions: an offset adds up in the form of the position, or is a frame before it") {
  const auto moved = [](const std::string& offset, Asked asked = {}, const std::string& to = "P[3]") {
    asked.values["PR[1]"] = offset;
    const Reading r = run("   1:L " + to + " 100mm/sec FINE Offset,PR[1] ;\n", asked);
    REQUIRE(r.problem() == "no such problem");
    return r.move(0).target.pose;
  };
  const Vector3 place = run("   1:L P[3] 100mm/sec FINE ;\n").move(0).target.pose.position;
  const std::string turn = "X 10 Y 0 Z 0 W 0 P 0 R 90";
  CHECK((moved(turn).position - place - Vector3(0.01, 0, 0)).norm() < rounding);
  const Asked frames{.values = {{"$OFFSET_CART", "TRUE"}}};
  CHECK((moved(turn, frames).position - Vector3(0.01 - place.y(), place.x(), place.z())).norm() < rounding);
  // Both forms give the same orientation, because R is the last rotation.
  CHECK(std::abs(moved(turn).orientation.dot(moved(turn, frames).orientation)) == Approx(1).epsilon(rounding));
  // The value of a backup is used.
  const Reading backup = run("   1:L P[3] 100mm/sec FINE Offset,PR[1] ;\n", {.values = {{"PR[1]", turn}}},
                             {{"system.va", "[*SYSTEM*]$OFFSET_CART  Storage: CMOS  Access: RW  : BOOLEAN = TRUE\n"}});
  CHECK((backup.move(0).target.pose.position - moved(turn, frames).position).norm() < rounding);
  // RX of the remote tool becomes 110 mm instead of 100 mm. The pose is the inverse.
  CHECK((moved("X 10 Y 0 Z 0 W 0 P 0 R 0", {}, "P[4]").position - Vector3(0, 0.11, -0.3)).norm() < rounding);
  CHECK(run("   1:L P[4] 100mm/sec FINE Offset,PR[1] ;\n", {.values = {{"PR[1]", turn}, {"$OFFSET_CART", "TRUE"}}})
            .problems.at(0)
            .what == "is offset on a remote tool by a frame");
  // Tool_Offset is in the axes of the tool: 10 mm along z of the tool that the robot carries.
  const Reading tool = run("   1:L P[4] 100mm/sec FINE ;\n   2:L P[4] 100mm/sec FINE Tool_Offset,PR[1] ;\n",
                           {.values = {{"PR[1]", "X 0 Y 0 Z 10 W 0 P 0 R 0"}}});
  const Frame &before = tool.move(0).target.pose, &after = tool.move(1).target.pose;
  CHECK((before.orientation.conjugate() * (after.position - before.position) - Vector3(0, 0, 0.01)).norm() < rounding);
}

TEST_CASE("fanuc values: KAREL programs and macros may write registers") {
  const Reading asked =
      run("   1:  R[1]=3 ;\n   2:  CALL GETCOUNT(1) ;\n   3:  FOR R[2]=1 TO R[1] ;\n   4:J P[1] 100% FINE "
          ";\n   5:  "
          "ENDFOR ;\n");
  REQUIRE(asked.problems.size() == 1);
  CHECK(
      asked.problem() ==
      "cell.ls:6:6: error: counts by a register behind CALL GETCOUNT, which is known only while the robot runs; give it "
      "with motion.values: [{name: 'CALL GETCOUNT', value: VALUE}]");
  for (const auto& [answer, moves] : {std::pair{"R[1]=2", 2}, {"nothing", 3}}) {
    const Reading told =
        run("   1:  R[1]=3 ;\n   2:  CALL GETCOUNT(1) ;\n   3:  FOR R[2]=1 TO R[1] ;\n   4:J P[1] 100% FINE "
            ";\n   5:  ENDFOR ;\n",
            {.values = {{"CALL GETCOUNT", answer}}});
    CHECK(stops(told) == std::vector<int>(static_cast<std::size_t>(moves), 1));
  }
  CHECK(run("   1:  R[1]=30 ;\n   2:  OPEN GRIPPER ;\n   3:J P[1] R[1]% FINE ;\n").problems.size() == 1);
  CHECK(run("   1:  R[1]=30 ;\n   2:  DO[1]=ON ;\n   3:J P[1] R[1]% FINE ;\n").problems.empty());
}

TEST_CASE("fanuc values: components of position registers, with names and in sums") {
  const Asked known{.values = {{"PR[1]", "X 500 Y 0 Z 100 W 180 P 0 R 0"}, {"UFRAME_NUM", "3"}, {"UTOOL_NUM", "2"}}};
  const Reading r =
      run("   1:  PR[2:place]=PR[1:pick] ;\n   2:  R[188:step]=25 ;\n   3:  "
          "PR[2,3:place]=PR[2,3:place]+R[188:step]*2  "
          "  ;\n   4:L PR[2:place] 100mm/sec FINE ;\n   5:  PR[3]=PR[2]-PR[1] ;\n   6:L PR[1] 100mm/sec FINE "
          "Offset,PR[3] ;\n   7:  PR[4]=LPOS ;\n   8:  PR[4,1]=PR[4,1]-100 ;\n   9:L PR[4] 100mm/sec FINE "
          ";\n  10:  "
          "PR[GP1:4,2]=7 ;\n  11:L PR[4] 100mm/sec FINE ;\n",
          known);
  REQUIRE(r.problem() == "no such problem");
  const double z[] = {0.15, 0.15, 0.15, 0.15}, x[] = {0.5, 0.5, 0.4, 0.4}, y[] = {0, 0, 0, 0.007};
  for (int i = 0; i < 4; ++i) {
    INFO(i);
    CHECK((r.move(i).target.pose.position - Vector3(x[i], y[i], z[i])).norm() < rounding);
  }
  CHECK(run("   1:  UTOOL_NUM[GP2]=5 ;\n   2:L PR[1] 100mm/sec FINE ;\n", known)
            .problems.empty());  // the tool number of the positioner
  Asked jig = known;
  jig.values["UFRAME_NUM"] = "4";
  const Reading frame =
      run("   1:  UFRAME[4:jig]=PR[1] ;\n   2:L PR[1] 100mm/sec FINE ;\n   3:  $MNUFRAME[1,4]=PR[5] ;\n   "
          "4:L PR[1] "
          "100mm/sec FINE ;\n",
          jig);
  CHECK(frame.program.work_objects.at(0).frame.position.x() == Approx(0.5).epsilon(rounding));
  REQUIRE(frame.problems.size() == 1);  // PR[5] is unknown, so the frame is unknown after the second assignment
  CHECK(frame.problems[0].what == "uses UFRAME[4], which depends on PR[5], which is known only while the robot runs");
  // If a program assigns one component of an unknown register, the other components stay unknown and are not 0.
  const Reading unknown = run("   1:  PR[9,3]=50 ;\n   2:L PR[9] 100mm/sec FINE ;\n", known);
  CHECK(unknown.problems.at(0).what == "moves to PR[9], which is known only while the robot runs");
  CHECK(run("   1:L PR[1] 100mm/sec FINE ;\n", {.values = {{"PR[1]", "1,2,3,4,5,6"}}}).problems.at(0).what ==
        "moves in the active user frame, and no line chooses it (UFRAME_NUM)");
}

TEST_CASE("fanuc frames: a system variable's component is written, the others stay") {
  const Asked known{.values = {{"PR[1]", "X 500 Y 0 Z 100 W 180 P 0 R 0"}, {"UFRAME_NUM", "3"}, {"UTOOL_NUM", "2"}}};
  const Reading r =
      run("   1:  $MNUTOOL[1,2].$Z=77 ;\n   2:  $MNUFRAME[1,3].$R=90 ;\n   3:L PR[1] 100mm/sec FINE ;\n", known);
  REQUIRE(r.problem() == "no such problem");
  const Frame tool = r.program.tools.at(r.move(0).tool).frame,
              object = r.program.work_objects.at(r.move(0).work_object).frame;
  CHECK((tool.position - Vector3(0, 0, 0.077)).norm() < rounding);  // X and Y are those of the tool in run()
  CHECK((object.position - Vector3(1, 0, 0)).norm() < rounding);
  CHECK((object.orientation * Vector3::UnitX() - Vector3::UnitY()).norm() < rounding);
}

TEST_CASE("fanuc frames: an assignment by an unknown number may be to any of the list, until one is assigned") {
  const Asked known{.values = {{"PR[1]", "X 0 Y 0 Z 50 W 0 P 0 R 0"}}};
  const std::string move = "   9:L P[8] 100mm/sec FINE ;\n";
  CHECK(run("   1:  UTOOL[R[1]]=PR[1] ;\n" + move, known).problem(0).find("uses UTOOL[2], which depends on R[1]") !=
        std::string::npos);
  CHECK(run("   1:  UTOOL[2]=PR[1] ;\n   2:  UTOOL[GI[1]]=PR[1] ;\n" + move, known).problem(0).find("GI[1]") !=
        std::string::npos);
  CHECK(run("   1:  UTOOL[GI[1]]=PR[1] ;\n   2:  UTOOL[2]=PR[1] ;\n" + move, known).problem() == "no such problem");
  CHECK(run("   1:  UTOOL[R[1]]=PR[1] ;\n" + move, {.values = {{"PR[1]", "X 0 Y 0 Z 50 W 0 P 0 R 0"}, {"R[1]", "5"}}})
            .problem() == "no such problem");
}

TEST_CASE(
    "fanuc: what an undecided branch may set is asked for where a move needs it, whatever was given or backed up") {
  const Files backup{
      {"sysframe.va",
       "[*SYSTEM*]$MNUTOOL  Storage: CMOS  Access: RW  : ARRAY[1,9] OF POSITION\n     [1,2] =\n  Group: 1   "
       "Config: N D B, 0, 0, 0\n  X:     0.000   Y:     0.000   Z:   100.000\n  W:     0.000   P:     0.000   "
       "R:     0.000\n"}};
  for (const auto& [sets, what] :
       {std::pair("$MCR.$GENOVERRIDE=10", "moves under an OVERRIDE that is known only while the robot runs"),
        std::pair("$PRGOVERRIDE=10", "moves under an $PRGOVERRIDE that is known only while the robot runs"),
        std::pair("OVERRIDE=10%", "moves under an OVERRIDE that is known only while the robot runs"),
        std::pair("$MNUTOOL[1,2]=PR[1]",
                  "uses UTOOL[2], which depends on DI[1], which is known only while the robot runs"),
        std::pair("$MNUTOOL[1,2].$Z=5",
                  "uses UTOOL[2], which depends on DI[1], which is known only while the robot runs"),
        std::pair("UTOOL[2]=PR[1]", "uses UTOOL[2], which depends on DI[1], which is known only while the robot runs"),
        std::pair("UTOOL[R[1]]=PR[1]",
                  "uses UTOOL[2], which depends on DI[1], which is known only while the robot runs"),
        std::pair("$MNUTOOL[1,R[1]]=PR[1]",
                  "uses UTOOL[2], which depends on DI[1], which is known only while the robot runs"),
        std::pair("UFRAME[R[1]]=PR[1]",
                  "uses UFRAME[3], which depends on DI[1], which is known only while the robot runs")}) {
    INFO(sets);
    const std::string lines = fmt::format(
        "   1:L P[3] 100mm/sec FINE ;\n   2:  IF (DI[1]=ON) THEN ;\n   3:  {} ;\n"
        "   4:  ENDIF ;\n   5:L P[8] 100mm/sec FINE ;\n",
        sets);
    const Asked known{.values = {{"PR[1]", "X 0 Y 0 Z 50 W 0 P 0 R 0"}}};
    for (const auto& files : {Files{}, backup}) {
      const Reading r = run(lines, known, files);
      REQUIRE(!r.problems.empty());
      CHECK(r.problems[0].what == what);
      Asked told = known;
      told.values[r.problems[0].questions.at(0).name] = r.problems[0].questions[0].name == "DI[1]" ? "OFF" : "100";
      CHECK(run(lines, told, files).problem() == "no such problem");
    }
  }
}

TEST_CASE("fanuc values: arguments, and the program that is named with them") {
  const std::string sub = listing("SUB", "   1:J P[AR[1]] AR[2]% FINE ;\n");
  const Reading r =
      run("   1:  R[7]=20 ;\n   2:  CALL SUB(2,R[7]+5) ;\n   3:  CALL SUB(1,10) ;\n", {}, {{"sub.ls", sub}});
  REQUIRE(r.problem() == "no such problem");
  CHECK(stops(r) == std::vector<int>{2, 1});
  CHECK(r.move(0).speed.axis_percent.value() == 25);
  CHECK(stops(run("", {.routine = "sub(2, 50)"}, {{"sub.ls", sub}})) == std::vector<int>{2});
  CHECK(run("   1:  CALL SUB(2) ;\n", {}, {{"sub.ls", sub}}).problems.at(0).what ==
        "has a speed by AR[2], which is known only while the robot runs");
}

TEST_CASE("fanuc values: AND binds closer than OR") {
  const auto taken = [](const std::string& condition) {
    return stops(run("   1:  R[1]=1 ;\n   2:  R[2]=2 ;\n   3:  IF (" + condition +
                     ") THEN ;\n   4:J P[1] 100% FINE ;\n   5:  ELSE ;\n   6:J P[2] 100% FINE ;\n   7:  "
                     "ENDIF ;\n"))
               .at(0) == 1;
  };
  CHECK(taken("R[1]=1 OR R[1]=0 AND R[2]=0"));
  CHECK_FALSE(taken("(R[1]=1 OR R[1]=0) AND R[2]=0"));
  CHECK(taken("R[1]+1=R[2] AND !(R[1]>R[2])"));
  CHECK(taken("R[1]<>R[2]"));
  CHECK(taken("R[1]=1 OR DI[5]"));  // true for every value of the input
}

TEST_CASE("fanuc branches: no question where no arm moves, one question for a SELECT") {
  const Reading logic =
      run("   1:J P[1] 100% FINE ;\n   2:  IF DI[5]=OFF,JMP LBL[1] ;\n   3:  DO[3]=ON ;\n   4:  LBL[1] ;\n   5:J "
          "P[2] "
          "100% FINE ;\n   6:  LBL[2] ;\n   7:  WAIT DI[7]=ON ;\n   8:  IF DI[8]=OFF,JMP LBL[2] ;\n   9:  SELECT "
          "GI[1]=1,JMP LBL[3] ;\n  10:         =2,JMP LBL[3] ;\n  11:  LBL[3] ;\n  12:  IF (DI[9])R[5]=(1) ;\n");
  CHECK(logic.problem() == "no such problem");
  CHECK(stops(logic) == std::vector<int>{1, 2});
  // A timed wait in an undecided branch is left out, with a warning.
  const Reading wait =
      run("   1:J P[1] 100% FINE ;\n   2:  IF (!F[59]),JMP LBL[1] ;\n   3:  WAIT   1.00(sec) ;\n   4:  "
          "LBL[1] ;\n   5:J P[2] 100% FINE ;\n");
  CHECK(wait.problem() == "no such problem");
  CHECK(stops(wait) == std::vector<int>{1, 2});
  CHECK(warnings(wait).size() == 1);
  // Values that the arms may write are unknown after the branch.
  CHECK(run("   1:  R[5]=20 ;\n   2:  IF (DI[9])R[5]=(1) ;\n   3:J P[1] R[5]% FINE ;\n").problems.at(0).what ==
        "has a speed by DI[9], which is known only while the robot runs");

  // A called program without moves is left out if its jumps depend on unknown values.
  const std::string told =
      "   1:  IF SO[4]=ON,JMP LBL[7] ;\n   2:  JMP LBL[AR[1]] ;\n   3:  LBL[1] ;\n   4:  R[5]=1 ;\n   5:  "
      "END ;\n   6:  "
      "LBL[7] ;\n   7:  MESSAGE[LOW] ;\n";
  const std::string main = "   1:J P[1] 100% FINE ;\n   2:  R[5]=50 ;\n   3:  CALL TEXT(R[9]) ;\n   4:J P[2] ";
  const Reading text = run(main + "20% FINE ;\n", {}, {{"text.ls", listing("TEXT", told)}});
  CHECK(text.problem() == "no such problem");
  CHECK(stops(text) == std::vector<int>{1, 2});
  CHECK_THAT(run(main + "R[5]% FINE ;\n", {}, {{"text.ls", listing("TEXT", told)}}).problem(),
             Catch::Contains("has a speed by SO[4]"));
  for (const char* more : {"   8:J P[1] 50% FINE ;\n", "   8:  ABORT ;\n", "   8:  WAIT   2.00(sec) ;\n"})
    CHECK_THAT(run(main + "20% FINE ;\n", {}, {{"text.ls", listing("TEXT", told + more)}}).problem(),
               Catch::Contains("SO[4], which is known only while the robot runs") ||
                   Catch::Contains("AR[1], which is known only while the robot runs") ||
                   Catch::Contains("R[9], which is known only while the robot runs"));

  const std::string choice =
      "   1:J P[1] 100% FINE ;\n   2:  SELECT R[1]=1,JMP LBL[1] ;\n   3:         =2,JMP LBL[2] ;\n   4:      "
      "   "
      "ELSE,JMP LBL[9] ;\n   5:  LBL[1] ;\n   6:J P[2] 100% FINE ;\n   7:  JMP LBL[9] ;\n   8:  LBL[2] ;\n   "
      "9:J P[1] "
      "50% FINE ;\n  10:  LBL[9] ;\n";
  const Reading asked = run(choice);
  REQUIRE(asked.problems.size() == 1);
  CHECK(
      asked.problem() ==
      "cell.ls:5:6: error: selects by R[1], which is known only while the robot runs; choose with "
      "motion.assume: [{line: 'cell.ls:5', take: VALUE}] (1, 2, else), or give motion.values: [{name: 'R[1]', value: VALUE}]");
  CHECK(stops(run(choice, {.choose = {{"cell.ls:5", "1"}}})) == std::vector<int>{1, 2});
  CHECK(stops(run(choice, {.choose = {{"5", "2"}}})) == std::vector<int>{1, 1});
  CHECK(stops(run(choice, {.assume = {{"cell.ls:5", Assumption::else_branch}}})) == std::vector<int>{1});
  CHECK(stops(run(choice, {.choose = {{"cell.ls:5", "7"}}})) == std::vector<int>{1});
  CHECK(stops(run(choice, {.values = {{"R[1]", "1"}}})) == std::vector<int>{1, 2});
  CHECK(stops(run(choice, {.assume = {{"cell.ls:6", Assumption::then_branch}}})) == std::vector<int>{1, 1});
  // A case calls a program or jumps. A controller accepts no move there.
  const Reading moving =
      run("   1:J P[1] 50% FINE ;\n   2:  SELECT R[1]=1,J P[2] 50% FINE ;\n", {.values = {{"R[1]", "1"}}});
  CHECK(moving.problem() == "cell.ls:5:6: error: moves behind a condition; list the program again");
}

TEST_CASE("fanuc loops: a FOR leaves its counter at the last value, and a counter that the body changes counts") {
  // ENDFOR changes the counter only until it reaches its last value (FANUC operator's manual).
  const Reading r =
      run("   1:  FOR R[1]=1 TO 3 ;\n   2:J P[1] 10% FINE ;\n   3:  ENDFOR ;\n   4:J P[2] R[1]% FINE ;\n   "
          "5:  FOR R[2]=5 "
          "DOWNTO 1 ;\n   6:J P[1] R[2]% FINE ;\n   7:  R[2]=R[2]-1 ;\n   8:  ENDFOR ;\n   9:  FOR R[3]=2 TO "
          "1 ;\n  10:J P[2] "
          "100% FINE ;\n  11:  ENDFOR ;\n");
  REQUIRE(r.problem() == "no such problem");
  CHECK(stops(r) == std::vector<int>{1, 1, 1, 2, 1, 1, 1});
  CHECK(r.move(3).speed.axis_percent.value() == 3);
  CHECK(r.move(5).speed.axis_percent.value() == 3);
}

TEST_CASE("fanuc loops: an endless one runs until it repeats itself, or as often as is asked") {
  // A state machine whose first pass has no move.
  const std::string states =
      "   1:  R[1]=0 ;\n   2:  LBL[1] ;\n   3:  IF R[1]=1,JMP LBL[3] ;\n   4:  IF R[1]=2,JMP LBL[4] ;\n   5: "
      " R[1]=1 ;\n  "
      " 6:  JMP LBL[1] ;\n   7:  LBL[3] ;\n   8:J P[1] 100% FINE ;\n   9:  R[1]=2 ;\n  10:  JMP LBL[1] ;\n  "
      "11:  LBL[4] "
      ";\n  12:J P[2] 100% FINE ;\n  13:  R[1]=0 ;\n  14:  JMP LBL[1] ;\n";
  const Reading machine = run(states);
  CHECK(machine.problem() == "no such problem");
  CHECK(stops(machine) == std::vector<int>{1, 2});
  // A counter of parts does not change the motion.
  const std::string parts =
      "   1:  R[9]=0 ;\n   2:  LBL[1] ;\n   3:J P[1] 100% FINE ;\n   4:J P[2] 100% FINE ;\n   5:  "
      "R[9]=R[9]+1 ;\n   6:  "
      "JMP LBL[1] ;\n";
  CHECK(stops(run(parts)) == std::vector<int>{1, 2});
  CHECK(stops(run(parts, {.passes = 3})) == std::vector<int>{1, 2, 1, 2, 1, 2});
  // Two kinds of parts alternate: the second pass has other moves, the third pass has those of the first.
  const std::string turns =
      "   1:  R[1]=0 ;\n   2:  LBL[1] ;\n   3:J P[1] 100% FINE ;\n   4:  IF R[1]=1,JMP LBL[2] ;\n   5:  R[1]=1 ;\n"
      "   6:  JMP LBL[3] ;\n   7:  LBL[2] ;\n   8:J P[2] 100% FINE ;\n   9:  R[1]=0 ;\n  10:  LBL[3] ;\n  11:  JMP LBL[1] ;\n";
  CHECK(stops(run(turns)) == std::vector<int>{1, 1, 2});
  // The first part is of another kind, and the following passes repeat without it. The first pass is kept.
  const std::string start =
      "   1:  R[1]=2 ;\n   2:  LBL[1] ;\n   3:J P[1] 100% FINE ;\n   4:  IF R[1]=1,JMP LBL[2] ;\n"
      "   5:  IF R[1]=0,JMP LBL[4] ;\n   6:J P[2] 100% FINE ;\n   7:  LBL[4] ;\n   8:  R[1]=1 ;\n"
      "   9:  JMP LBL[3] ;\n  10:  LBL[2] ;\n  11:J P[2] 100% FINE ;\n  12:J P[2] 100% FINE ;\n"
      "  13:  R[1]=0 ;\n  14:  LBL[3] ;\n  15:  JMP LBL[1] ;\n";
  CHECK(stops(run(start)) == std::vector<int>{1, 2, 1, 2, 2, 1});
  // A loop that only counts is reported with the line of its condition.
  const std::string counts =
      "   1:  R[1]=1 ;\n   2:  R[2]=0 ;\n   3:  LBL[1] ;\n   4:  R[2]=R[2]+1 ;\n   5:  IF R[1]=1,JMP LBL[1] "
      ";\n   6:J P[1] "
      "100% FINE ;\n";
  CHECK_THAT(run(counts).problem(), Catch::Contains("goes back again and again") &&
                                        Catch::Contains("motion.assume: [{line: 'cell.ls:8', take: then}]"));
  // A palletizer: all passes differ until the first one repeats.
  const std::string pallet =
      "   1:  LBL[1] ;\n   2:  R[1]=0 ;\n   3:  LBL[2] ;\n   4:  PR[2]=PR[1] ;\n   5:  "
      "PR[2,3]=PR[2,3]+R[1]*10 ;\n   6:L "
      "PR[2] 100mm/sec FINE ;\n   7:  R[1]=R[1]+1 ;\n   8:  IF R[1]<4,JMP LBL[2] ;\n   9:  JMP LBL[1] ;\n";
  CHECK(run(pallet, {.values = {{"PR[1]", "1,2,3,4,5,6"}, {"UFRAME_NUM", "0"}, {"UTOOL_NUM", "0"}}})
            .program.instructions.size() == 4);
}

TEST_CASE("fanuc loops: an endless one has all passes of a counter that decides") {
  // Every fourth pass cleans the torch. Another counter decides nothing.
  const auto loop = [](const std::string& decision) {
    return "   1:  R[1]=0 ;\n   2:  R[9]=0 ;\n   3:  LBL[1] ;\n   4:J P[1] 100% FINE ;\n   5:  R[9]=R[9]+1 ;\n"
           "   6:  R[1]=R[1]+1 ;\n" +
           decision + "   8:  CALL CLEAN ;\n   9:  R[1]=0 ;\n  10:  LBL[9] ;\n  11:  JMP LBL[1] ;\n";
  };
  const Files clean{{"clean.ls", listing("CLEAN", "   1:J P[2] 100% FINE ;\n")}};
  const Reading reset = run(loop("   7:  IF R[1]<4,JMP LBL[9] ;\n"), {}, clean);
  CHECK(reset.problem() == "no such problem");
  CHECK(stops(reset) == std::vector<int>{1, 1, 1, 1, 2});
  CHECK(warnings(reset).empty());
  // The decision reads a register that is computed from the counter.
  CHECK(stops(run(loop("   7:  R[2]=R[1]*2 ;\n   7:  IF R[2]<8,JMP LBL[9] ;\n"), {}, clean)) ==
        std::vector<int>{1, 1, 1, 1, 2});
  // The counter is never set back: the moves alone have a period. A limit that no search reaches is a warning.
  const Reading modulo = run(loop("   7:  IF (R[9] MOD 4<>0),JMP LBL[9] ;\n"), {}, clean);
  CHECK(stops(modulo) == std::vector<int>{1, 1, 1, 1, 2});
  const Reading far = run(loop("   7:  IF R[1]<100000,JMP LBL[9] ;\n"), {}, clean);
  CHECK(far.problem() == "no such problem");
  CHECK(stops(far) == std::vector<int>{1});
  REQUIRE(warnings(far).size() == 1);
  CHECK_THAT(warnings(far)[0], Catch::Contains("R[1] decides and has other values after each of 1000 passes"));
}

TEST_CASE("fanuc moves: what changes a target is followed, or named") {
  const Asked known{.values = {{"PR[1]", "X 0 Y 0 Z 50 W 0 P 0 R 0"}, {"PR[2]", "0,0,0,0,0,0"}}};
  const Reading r =
      run("   1:L P[3] 100mm/sec FINE Offset,PR[1] ;\n   2:L P[3] 100mm/sec FINE Tool_Offset,PR[1] ;\n   3:  "
          "OFFSET "
          "CONDITION PR[1] ;\n   4:L P[3] 100mm/sec FINE Offset ;\n   5:J P[1] 50% FINE Offset,PR[2] ;\n",
          known);
  REQUIRE(r.problem() == "no such problem");
  // The tool points down: 50 mm up in the frame, 50 mm down along the tool.
  const double z[] = {0.35, 0.25, 0.35};
  for (int i = 0; i < 3; ++i) CHECK(r.move(i).target.pose.position.z() == Approx(z[i]).epsilon(rounding));
  CHECK(run("   1:J P[1] 50% FINE Offset,PR[1] ;\n", known).problems.at(0).what ==
        "is offset in space from joint angles");
  CHECK(run("   1:L P[3] 100mm/sec FINE Offset,PR[8] ;\n", known).problems.at(0).what ==
        "is offset by PR[8], which is known only while the robot runs");
  CHECK(run("   1:L P[3] 100mm/sec FINE VOFFSET,VR[1] ;\n").problems.size() == 1);
  CHECK(warnings(run("   1:L P[3] 100mm/sec CNT100 COORD ;\n   2:L P[3] 100mm/sec CNT100 COORD ;\n")).empty());
  CHECK(warnings(run("   1:L P[3] 100mm/sec CNT100 COORD ;\n   2:J P[1] 5% FINE ;\n   3:L P[8] 9mm/sec FINE "
                     "COORD ;\n"))
            .at(0)
            .starts_with("COORD: "));
  CHECK(warnings(run("   1:  Weave Sine[1] ;\n   2:J P[1] 100% FINE ;\n")).at(0).starts_with("weave: "));
  CHECK(run("   1:L P[3] WELD_SPEED FINE ;\n").problem() ==
        "cell.ls:4:6: error: moves with WELD_SPEED, which lies in the controller's weld schedule; give it with "
        "motion.values: [{name: WELD_SPEED, value: '8mm/sec'}]");
  CHECK(run("   1:L P[3] WELD_SPEED FINE ;\n", {.values = {{"WELD_SPEED", "60cm/min"}}}).move(0).speed.tool.value() ==
        Approx(0.01).epsilon(rounding));
  CHECK(run("   1:J P[1] 100% CNT R[4] ;\n").problems.at(0).what ==
        "goes over into the next move by CNT R[4], which is known only while the robot runs");
}

TEST_CASE("fanuc: a value of WELD_SPEED that is no speed is named as the user's") {
  const std::string seam = "   1:L P[3] WELD_SPEED CNT100 ;\n";
  const auto weld = [&](const std::string& value) { return run(seam, {.values = {{"WELD_SPEED", value}}}); };
  for (const char* value : {"9", "8 mm/s", "0mm/sec", "fast"})
    CHECK_THAT(weld(value).problem(), Catch::Contains(fmt::format("whose value '{}' in motion.values ", value)) &&
                                          Catch::Contains("write it with its unit: 8mm/sec"));
  // A value of as many characters as the rest of the line takes nothing from it.
  REQUIRE(weld("8mm/sec").problem() == "no such problem");
  CHECK(weld("8mm/sec").move(0).zone.percent == weld("08mm/sec").move(0).zone.percent);
}

TEST_CASE("fanuc programs: names with hyphens, logs beside, doubles, faults in programs that never run") {
  const Files one{{"-bcked2-.ls", listing("-BCKED2-\t  Macro", "   1:J P[1] 100% FINE ;\n")}};
  CHECK(Reader{Language::fanuc}(one).program.instructions.size() == 1);
  CHECK(stops(run("   1:  CALL -BCKED2- ;\n", {}, one)) == std::vector<int>{1});
  const std::string broken = "/PROG  BROKEN\n/MN\n   1:  FOR R[1]=1 TO 3 ;\n/END\n";
  CHECK(run("   1:J P[1] 100% FINE ;\n", {}, {{"broken.ls", broken}}).problems.empty());
  CHECK(run("   1:  CALL BROKEN ;\n", {}, {{"broken.ls", broken}}).problems.at(0).what == "has no ENDFOR");
  CHECK(run("   1:J P[1] 100% FINE ;\n", {}, {{"other.ls", listing("CELL", "   1:J P[2] 100% FINE ;\n")}})
            .problems.at(0)
            .what == "is the program 'cell', as cell.ls is");
}

TEST_CASE("fanuc: an empty line may have lost its number") {
  // Listings of vision programs contain " ;" between two statements.
  CHECK(stops(run("   1:J P[1] 50% FINE ;\n ;\n   3:J P[2] 50% FINE ;\n")) == std::vector<int>{1, 2});
}

TEST_CASE("fanuc: a program without a file is named where an undecided branch calls it, too") {
  const std::string ends = "   2:J P[1] 50% FINE ;\n";
  const Reading skipped = run("   1:  IF R[1]<10,JMP LBL[9] ;\n   1:  CALL CLEAN ;\n   1:  LBL[9] ;\n" + ends);
  CHECK(stops(skipped) == std::vector<int>{1});
  REQUIRE(warnings(skipped).size() == 1);
  CHECK_THAT(warnings(skipped)[0], Catch::StartsWith("CALL CLEAN: not among the files read"));
  const Reading called = run("   1:  CALL OUTER ;\n" + ends, {},
                             {{"outer.ls", listing("OUTER", "   1:  IF DI[1]=ON,CALL CLEAN ;\n   2:  OPEN GUN ;\n")}});
  REQUIRE(warnings(called).size() == 2);
  CHECK_THAT(warnings(called)[0], Catch::StartsWith("CALL CLEAN: not among the files read"));
  CHECK_THAT(warnings(called)[1], Catch::StartsWith("MACRO OPEN GUN: not among the files read"));
  const Reading read =
      run("   1:  IF DI[1]=ON,CALL CLEAN ;\n" + ends, {}, {{"clean.ls", listing("CLEAN", "   1:  R[5]=1 ;\n")}});
  CHECK(warnings(read).empty());
}

TEST_CASE("fanuc: frame 0 cannot be assigned") {
  const Reading r = run("   1:  UTOOL[0]=PR[1] ;\n   2:J P[1] 50% FINE ;\n");
  CHECK(stops(r) == std::vector<int>{1});
  REQUIRE(warnings(r).size() == 1);
  CHECK(warnings(r)[0].find("[0] is fixed") != std::string::npos);
}

TEST_CASE("fanuc: what programs beside and condition handlers write is unknown") {
  // BESIDE writes R[1] while CELL moves. A handler that MONITOR starts may run at any time.
  const std::string choice = "   3:  IF R[1]=1,JMP LBL[1] ;\n   4:J P[2] 50% FINE ;\n   5:  LBL[1] ;\n";
  const std::string beside = "/PROG  BESIDE\n/MN\n   1:  R[1]=1 ;\n/POS\n/END\n";
  const std::string other = "/PROG  BESIDE\n/MN\n   1:  R[2]=1 ;\n/POS\n/END\n";
  const std::string start = "   1:  R[1]=0 ;\n   2:  RUN BESIDE ;\n";
  CHECK(run(start + choice, {}, {{"beside.ls", beside}}).problems.size() == 1);
  CHECK(stops(run(start + choice, {}, {{"beside.ls", other}})) == std::vector<int>{2});
  CHECK(run(start + choice).problems.size() == 1);  // not among the files
  CHECK(run("   1:  R[1]=0 ;\n   2:  MONITOR WATCH ;\n" + choice).problems.size() == 1);
}

TEST_CASE("fanuc: the remedy of a position of another frame than the active one chooses its frame") {
  const Reading r = run("   1:  UFRAME_NUM=1 ;\n   2:  UTOOL_NUM=2 ;\n   3:J P[3] 100% FINE ;\n");
  const std::vector<pipeline::Warning> lines = moves_left_out(r.program);
  REQUIRE(lines.size() == 1);
  CHECK_THAT(lines[0].line(), Catch::Contains("taught in user frame 3 and 1 is active"));
  CHECK_THAT(lines[0].line(), Catch::Contains("Remedy: UFRAME_NUM= or UTOOL_NUM= before the move"));
  CHECK_THAT(lines[0].line(), !Catch::Contains("motion.values"));
}

TEST_CASE("fanuc: all that a move lacks is asked for in one round") {
  // The move needs a position, a speed, a blend, an offset, and the frames of the position.
  const Reading r = run("   1:L PR[9] R[7]mm/sec CNT R[8] Offset,PR[4] ;\n");
  std::string all;
  for (std::size_t i = 0; i < r.problems.size(); ++i) all += r.problem(i) + "\n";
  for (const char* name : {"PR[9]", "R[7]", "R[8]", "PR[4]", "UFRAME_NUM", "UTOOL_NUM"})
    CHECK_THAT(all, Catch::Contains(name));
}

TEST_CASE("fanuc: a position register that is given counts where the program copies one that nobody knows") {
  Asked asked;
  asked.values["PR[4]"] = "X 500 Y 0 Z 300 W 180 P 0 R 0";
  const Reading r =
      run("   1:  UFRAME_NUM=0 ;\n   2:  UTOOL_NUM=0 ;\n   3:  PR[4]=PR[5] ;\n"
          "   4:  PR[4,3]=400 ;\n   5:L PR[4] 100mm/sec FINE ;\n",
          asked);
  REQUIRE(r.problem() == "no such problem");
  CHECK(r.move(0).target.pose.position.x() == Approx(0.5).epsilon(rounding));
  CHECK(r.move(0).target.pose.position.z() == Approx(0.4).epsilon(rounding));
}

TEST_CASE("fanuc: a word behind a move that no reader knows is named, with the nearest word") {
  const Asked known{.values = {{"PR[1]", "X 0 Y 0 Z 50 W 0 P 0 R 0"}}};
  const auto is_unused_value = [](const std::string& w) { return w.find("asked for it") != std::string::npos; };
  const auto behind = [&](const std::string& words) {
    std::vector<std::string> all = warnings(run("   1:J P[1] 50% " + words + " ;\n   2:  LBL[1] ;\n", known));
    std::erase_if(all, is_unused_value);
    return all;
  };
  for (const auto& [words, warned] :
       {std::pair("FINE Ofset,PR[1]", "Ofset: not read, because there is no such word in the options of a move"),
        std::pair("FINE Ofset,PR[1]", "; the nearest one is Offset"), std::pair("CTN50", "CTN: not read"),
        std::pair("CNTT50", "; the nearest one is CNT"), std::pair("CNT50 ACCEL50", "; the nearest one is ACC"),
        std::pair("FIN", "; the nearest one is FINE"), std::pair("FINE INKR", "INKR: not read"),
        std::pair("FINE Search[X]", "search: changes how the robot moves"),
        std::pair("FINE FPLIN", "fplin: changes how the robot moves")}) {
    INFO(words);
    REQUIRE(behind(words).size() == 1);
    CHECK_THAT(behind(words)[0], Catch::Contains(warned));
  }
  // What listings of controllers contain there.
  for (const char* words :
       {"FINE", "CNT100 ACC100", "CNT R[1] ACC R[1]", "CD50", "CR10", "CNT50 TB   0.00sec,P-SPS",
        "CNT50 TB .10sec,CALL SUB(1,'a',R[2])", "CNT50 TA   0.00sec,AO[1]=R[5]", "CNT50 DB    0.0mm,POINT_LOGIC",
        "CNT50 TIME BEFORE .10sec,DO[3:gun]=ON", "CNT50 ZEIT VOR    .10sek,P-SPS", "FINE PTH",
        "CNT50 RT_LD50 AP_LD R[1]", "CNT50 RT_LDR[1] BREAK", "FINE SPOT[SD=1,P=1]", "FINE\n    :  Arc Start[6]",
        "FINE COORD[2:L]", "CNT50 DB 10.0mm,DO[3]=PULSE,0.5sec"}) {
    INFO(words);
    Asked asked = known;
    asked.values["R[1]"] = "50";
    asked.values["CALL SUB"] = "nothing";
    std::vector<std::string> all = warnings(run(std::string("   1:J P[1] 50% ") + words + " ;\n", asked));
    std::erase_if(all, [&](const std::string& w) { return w.starts_with("CALL SUB") || is_unused_value(w); });
    CHECK(all.empty());
  }
  CHECK(skips(run("   1:J P[1] 50% FINE PTH ;\n"), "change the path at corners, not read", false));
  const std::vector<pipeline::Warning> lines = moves_left_out(run("   1:J P[1] 50% CTN50 ;\n").program);
  REQUIRE(lines.size() == 1);
  CHECK_THAT(lines[0].line(), Catch::Contains("Likely cause: a mistyped word"));
}

TEST_CASE("fanuc: CNT without a number is refused by name, not asked as a value") {
  for (const char* words : {"CNT", "CNT Offset,PR[1]", "ACC"}) {
    INFO(words);
    const Reading r = run(std::string("   1:J P[1] 50% ") + words + " ;\n", {.values = {{"PR[1]", "0,0,0,0,0,0"}}});
    REQUIRE(r.problems.size() == 1);
    CHECK_THAT(r.problem(), Catch::Contains("without a number") && !Catch::Contains("motion.values"));
  }
}

TEST_CASE("fanuc: a speed of another kind of move is a warning") {
  for (const char* move : {"L P[3] 50% FINE", "J P[1] 100mm/sec FINE", "J P[1] 10cm/min FINE"}) {
    INFO(move);
    const Reading r = run(fmt::format("   1:{} ;\n", move));
    REQUIRE(warnings(r).size() == 1);
    CHECK_THAT(moves_left_out(r.program)[0].line(), Catch::Contains("a speed of other moves"));
  }
  for (const char* move : {"L P[3] 2sec FINE", "J P[1] 2sec FINE", "J P[1] 200msec FINE", "L P[3] 5deg/sec FINE",
                           "J P[1] 5deg/sec FINE", "L P[3] 5inch/min FINE", "L P[3] max_speed FINE"}) {
    INFO(move);
    CHECK(warnings(run(fmt::format("   1:{} ;\n", move))).empty());
  }
}

TEST_CASE("fanuc: times of WAIT have their units") {
  const auto dwell = [](const char* time) {
    const Reading r = run(fmt::format("   1:  R[1]=2 ;\n   2:  WAIT   {} ;\n   3:J P[1] 50% FINE ;\n", time));
    REQUIRE(r.problem() == "no such problem");
    return r.move(0).dwell;
  };
  for (const char* time : {".50(sec)", "0.5", "500(msec)", "0.50 (sec)", ".5(SEC)"}) {
    INFO(time);
    CHECK(dwell(time) == 0.5);
  }
  CHECK(dwell("R[1]") == 2);
  CHECK(dwell("R[1](sec)") == 2);
  for (const char* time : {"0,5(sec)", "2(min)", "2 FOO"}) {
    INFO(time);
    const Reading r = run(fmt::format("   1:  WAIT   {} ;\n   2:J P[1] 50% FINE ;\n", time));
    REQUIRE(r.problems.size() == 1);
    CHECK_THAT(r.problem(), Catch::Contains(fmt::format("in a form that is not read: '{}'", time)));
  }
  CHECK(run("   1:  WAIT -1(sec) ;\n   2:J P[1] 50% FINE ;\n").problems.at(0).what == "waits for a time below 0");
}

TEST_CASE("fanuc: a second position of one number is refused, a second label is a warning where a jump leads to it") {
  const std::string twice = "/PROG  CELL\n/MN\n   1:J P[1] 50% FINE ;\n/POS\n" + joints + joints + "/END\n";
  const Reading positions = Reader{Language::fanuc}({{"cell.ls", twice}});
  REQUIRE(positions.problems.size() == 2);
  CHECK(positions.problems[0].what == "is a second P[1]");
  const std::string labels = "   2:J P[1] 50% FINE ;\n   3:  LBL[1] ;\n   4:J P[2] 50% FINE ;\n   5:  LBL[1] ;\n";
  CHECK(warnings(run(labels)).empty());
  const Reading jump = run("   1:  JMP LBL[1] ;\n" + labels);
  CHECK(stops(jump) == std::vector<int>{2});
  REQUIRE(warnings(jump).size() == 1);
  CHECK(warnings(jump)[0] == "LBL[1]: stands twice in the program; the jump leads to line 6");
}

TEST_CASE("fanuc: an expression that is not read to its end gives no value") {
  const Asked known{.values = {{"PR[1]", "X 500 Y 0 Z 100 W 180 P 0 R 0"},
                               {"PR[2]", "X 0 Y 0 Z 50 W 0 P 0 R 0"},
                               {"UFRAME_NUM", "3"},
                               {"UTOOL_NUM", "2"}}};
  for (const char* sum : {"PR[1]*PR[2]", "PR[1]*2", "PR[1]:PR[2]"}) {
    INFO(sum);
    const std::string lines = fmt::format("   1:  PR[3]={} ;\n   2:L PR[3] 100mm/sec FINE ;\n", sum);
    const Reading r = run(lines, known);
    REQUIRE(r.problems.size() == 1);
    CHECK_THAT(r.problem(), Catch::Contains("motion.values: [{name: 'PR[3]', value: 'X ... Y"));
    Asked given_value = known;
    given_value.values["PR[3]"] = "X 600 Y 0 Z 100 W 180 P 0 R 0";
    CHECK(run(lines, given_value).move(0).target.pose.position.x() == Approx(0.6).epsilon(rounding));
    CHECK(skips(run(lines, given_value), "the rest of an expression is not read", true));
  }
  for (const char* sum : {"2^3", "5 FOO 3", "0,5", "R[2]=1"}) {
    INFO(sum);
    const std::string lines = fmt::format("   1:  R[2]=1 ;\n   2:  R[1]={} ;\n   3:J P[1] R[1]% FINE ;\n", sum);
    const Reading r = run(lines);
    REQUIRE(r.problems.size() == 1);
    CHECK_THAT(r.problem(), Catch::Contains("has a speed by R[1]") &&
                                Catch::Contains("motion.values: [{name: 'R[1]', value: VALUE}]"));
    CHECK(run(lines, {.values = {{"R[1]", "8"}}}).move(0).speed.axis_percent.value() == 8);
  }
  CHECK_THAT(run("   1:  PR[1,3]=2^3 ;\n   2:L PR[1] 100mm/sec FINE ;\n", known).problem(),
             Catch::Contains("moves to PR[1], which depends on a value") && Catch::Contains("write it as a constant"));
  CHECK_THAT(run("   1:  UTOOL[2]=PR[1]*2 ;\n   2:L PR[1] 100mm/sec FINE ;\n", known).problem(),
             Catch::Contains("uses UTOOL[2]"));
  CHECK(run("   1:  IF R[1]=2^3,JMP LBL[1] ;\n   2:J P[1] 50% FINE ;\n   3:  LBL[1] ;\n   4:J P[2] 50% FINE ;\n",
            {.values = {{"R[1]", "8"}}})
            .problems.size() == 1);
  CHECK(run("   1:  FOR R[1]=1 TO 2^3 ;\n   2:J P[1] 50% FINE ;\n   3:  ENDFOR ;\n").problems.size() == 1);
  CHECK(run("   1:  R[1]= ;\n   2:J P[1] R[1]% FINE ;\n").problem().find("{name: 'a value") == std::string::npos);
  // Expressions of controllers are read to their end.
  const Reading whole =
      run("   1:  R[1:count]=(R[2]+1)*2 DIV 2    ;\n   2:  OVERRIDE=50% ;\n   3:  IF (R[1]=2 AND !(R[2]>5)) THEN ;\n"
          "   4:  IF R[1]=2,JMP LBL[1] ;\n   5:  ENDIF ;\n   6:  LBL[1] ;\n   7:  IF (R[1]=2)R[3]=(-R[2]) ;\n"
          "   8:  PR[3:x]=PR[1:y]-PR[2]    ;\n   9:  FOR R[4]=1 TO 2 ;\n  10:  ENDFOR ;\n  11:J P[1] 50% FINE ;\n",
          {.values = {{"R[2]", "1"}, {"PR[1]", "1,2,3,4,5,6"}, {"PR[2]", "1,2,3,4,5,6"}}});
  CHECK(whole.problem() == "no such problem");
  CHECK(warnings(whole).empty());
}

TEST_CASE("fanuc: registers hold single precision") {
  // Ten sums of 0.1 are 1.0000001 in single precision and 0.99999999999999989 in double precision.
  const Reading loop =
      run("   1:  R[1]=0 ;\n   2:  LBL[1] ;\n   3:J P[1] 50% FINE ;\n   4:  R[1]=R[1]+0.1 ;\n"
          "   5:  IF R[1]<1,JMP LBL[1] ;\n");
  REQUIRE(loop.problem() == "no such problem");
  CHECK(stops(loop).size() == 10);
  const auto taken = [](const std::string& condition) {
    return stops(
               run("   1:  R[1]=0.1 ;\n   2:  R[2]=R[1]*3 ;\n   3:  R[3]=123456789 ;\n   4:  R[3]=R[3]+1 ;\n   5:  IF (" +
                   condition +
                   ") THEN ;\n   6:J P[1] 50% FINE ;\n   7:  ELSE ;\n   8:J P[2] 50% FINE ;\n   9:  ENDIF ;\n"))
               .at(0) == 1;
  };
  CHECK(taken("R[1]=0.1"));
  CHECK(taken("R[3]=123456790"));  // integers stay exact
  CHECK(stops(run("   1:  R[1]=0.05*2 ;\n   2:  SELECT R[1]=0.1,JMP LBL[1] ;\n   3:J P[1] 50% FINE ;\n   4:  LBL[1] ;\n"
                  "   5:J P[2] 50% FINE ;\n")) == std::vector<int>{2});
}

TEST_CASE("fanuc lines: a comment in brackets may contain a semicolon, and a condition one parenthesis too many") {
  // Both stand in backups of controllers.
  const Reading r = run("   1:  R[1:count;]=30    ;\n   2:J P[1] R[1:count;]% FINE    ;\n   3:J P[2] 50% FINE ;\n");
  REQUIRE(r.problem() == "no such problem");
  CHECK(stops(r) == std::vector<int>{1, 2});
  CHECK(r.move(0).speed.axis_percent.value() == 30);
  const std::string lines =
      "   1:  IF (DO[1:x]=ON)),JMP LBL[1] ;\n   2:J P[1] 50% FINE ;\n   3:  LBL[1] ;\n   4:J P[2] 50% FINE ;\n";
  CHECK(stops(run(lines, {.values = {{"DO[1]", "ON"}}})) == std::vector<int>{2});
  CHECK(stops(run(lines, {.values = {{"DO[1]", "OFF"}}})) == std::vector<int>{1, 2});
}
