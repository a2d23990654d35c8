
#include "tests/catch.h"
#include "tests/sim/program/reading.h"

using namespace dresslife;
using namespace dresslife::sim;
using namespace dresslife::tests;

namespace {

constexpr double rounding = 1e-12;  // rounding error of a few products of numbers near 1

const std::string data = R"(MODULE Data
  PERS tooldata gun:=[TRUE,[[100,0,250],[1,0,0,0]],[40,[0,0,100],[1,0,0,0],0,0,0]];
  PERS wobjdata jig:=[FALSE,TRUE,"",[[1000,0,500],[0.70710678,0,0,0.70710678]],[[10,0,0],[1,0,0,0]]];
  CONST robtarget p1:=[[100,200,300],[0,1,0,0],[0,-1,2,1],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget home:=[[0,-10,10,0,40,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
ENDMODULE
)";

Reading run(const std::string& body, const ImportOptions& options = {}, const std::string& more = "") {
  return Reader{Language::rapid, options}(
      {{"main.mod", "MODULE Main\n PROC main()\n" + body + "\n ENDPROC\n" + more + "ENDMODULE\n"}, {"data.mod", data}});
}

ImportOptions assuming(const std::string& line, Assumption what) {
  ImportOptions options;
  options.assume[line] = what;
  return options;
}

}  // namespace

TEST_CASE("rapid: a linear move with everything, in SI units") {
  const Reading r = run("MoveL p1\\V:=250, v1000, z10\\Z:=15, gun\\WObj:=jig;");
  REQUIRE(r.problems.empty());
  REQUIRE(r.program.instructions.size() == 1);
  const Instruction& move = r.move(0);
  CHECK(move.kind == Instruction::Kind::linear);
  CHECK((move.target.pose.position - Vector3(0.1, 0.2, 0.3)).norm() < rounding);
  CHECK(move.target.pose.orientation.isApprox(Quaternion(0, 1, 0, 0), rounding));
  CHECK(move.target.configuration.text() == "abb 0 -1 2 1");
  CHECK(move.target.external_axes.empty());
  CHECK(move.speed.tool.value() == Approx(0.25).epsilon(rounding));
  CHECK(move.speed.orientation.value() == Approx(500 * degree).epsilon(rounding));
  CHECK(move.zone.distance == Approx(0.015).epsilon(rounding));
  CHECK(move.zone.turn.value() == Approx(1.5 * degree).epsilon(rounding));
  const NamedFrame& tool = r.program.tools.at(move.tool);
  CHECK(tool.name == "gun");
  CHECK((tool.frame.position - Vector3(0.1, 0, 0.25)).norm() < rounding);
  // uframe turns by 90 deg about z: the object frame's 10 mm in x lie in y.
  const Frame& jig = r.program.work_objects.at(move.work_object).frame;
  constexpr double written = 1e-8;  // 0.70710678 has eight digits
  CHECK((jig.position - Vector3(1, 0.01, 0.5)).norm() < written);
  CHECK(move.where.file == "main.mod");
  CHECK(move.where.line == 3);
  CHECK(move.routine == "main");
  CHECK(move.text == "MoveL p1\\V:=250, v1000, z10\\Z:=15, gun\\WObj:=jig;");
}

TEST_CASE("rapid: NOT applies to all operands of AND, also after OR") {
  const auto holds = [](const std::string& condition) {
    return run("MoveAbsJ home,v100,fine,tool0;\nIF " + condition + " MoveAbsJ home,v200,fine,tool0;", {},
               "VAR bool f:=FALSE;\n")
               .program.instructions.size() == 2;
  };
  CHECK(holds("NOT f AND f"));
  CHECK(holds("f OR NOT f AND f"));
  CHECK(!holds("(NOT f) AND f"));
}

TEST_CASE("rapid: every kind of move") {
  const Reading r =
      run("MoveAbsJ home\\NoEOffs,v500,fine,tool0;\nMoveJ p1,v100\\T:=2,z50,tool0;\nMoveC "
          "Offs(p1,50,50,0),Offs(p1,100,0,0),v200,z1,tool0;\n"
          "TriggL Offs(p1,1,0,0),v300,trig1,fine,gun;\nSearchL\\Stop,di1,found,Offs(p1,0,0,9),v20,gun;\nMoveL "
          "found,v5,z0,gun;\n"
          "SpotL Offs(p1,2,0,0),v1000,gun1,spot7,gun;\nWaitTime\\InPos,0.25;\nMoveLDO "
          "p1,v80,z20,gun,do1,1;\nMoveL p1,vmax,z200,tool0;",
          {}, "VAR robtarget found; VAR triggdata trig1;\n");
  CHECK(r.problem() == "no such problem");
  REQUIRE(r.program.instructions.size() == 11);
  CHECK(r.move(0).target.joints.size() == 6);
  CHECK(r.move(0).target.joints[1] == Approx(-10 * degree).epsilon(rounding));
  CHECK(r.move(0).zone.distance == 0);
  CHECK(r.move(1).kind == Instruction::Kind::joint);
  CHECK(r.move(1).speed.duration.value() == 2);
  CHECK(r.move(2).kind == Instruction::Kind::circular);
  CHECK((r.move(2).via.position - Vector3(0.15, 0.25, 0.3)).norm() < rounding);
  CHECK(r.move(3).zone.distance == 0);
  CHECK(r.move(4).target.pose.position.z() == Approx(0.309).epsilon(rounding));
  CHECK(r.move(5).target.pose.position.z() == Approx(0.309).epsilon(rounding));  // where the search ended
  CHECK(r.move(5).zone.distance == Approx(0.0003).epsilon(rounding));
  CHECK(r.move(7).kind == Instruction::Kind::dwell);
  CHECK(r.move(7).dwell == 1);
  CHECK(r.move(8).dwell == 0.25);
  CHECK(r.move(9).speed.tool.value() == Approx(0.08).epsilon(rounding));
  CHECK_FALSE(r.move(10).speed.tool.has_value());
  REQUIRE(r.program.skipped.size() == 1);
  CHECK(r.program.skipped[0].what == "SearchL: the search goes to its end point");
}

TEST_CASE("rapid: Offs shifts in the work object, RelTool in the tool") {
  const Reading r = run("MoveL RelTool(p1,0,0,10\\Rz:=90),v100,fine,tool0;\nMoveL Offs(p1,0,0,10),v100,fine,tool0;");
  REQUIRE(r.program.instructions.size() == 2);
  // The tool of p1 is turned by 180 deg about x: its z points down. A turn about it has the opposite sign about the
  // world's z.
  CHECK((r.move(0).target.pose.position - Vector3(0.1, 0.2, 0.29)).norm() < rounding);
  CHECK(r.move(0).target.pose.orientation.isApprox(Quaternion(0, 1, 0, 0) * rotation({0, 0, 90 * degree}), rounding));
  CHECK((r.move(1).target.pose.position - Vector3(0.1, 0.2, 0.31)).norm() < rounding);
  // Rotations about x, then about the rotated y axis, then about the rotated z axis.
  const Reading turned = run("MoveL RelTool(p1,0,0,0\\Rx:=30\\Ry:=20\\Rz:=40),v100,fine,tool0;");
  const Quaternion expected = Quaternion(0, 1, 0, 0) * Eigen::AngleAxisd(30 * degree, Vector3::UnitX()) *
                              Eigen::AngleAxisd(20 * degree, Vector3::UnitY()) *
                              Eigen::AngleAxisd(40 * degree, Vector3::UnitZ());
  CHECK(turned.move(0).target.pose.orientation.isApprox(expected, rounding));
}

TEST_CASE("rapid: loops, procedures with arguments, functions, arrays and records") {
  const Reading r =
      run("VAR num x{2}:=[5,7];\nFOR i FROM 1 TO 3 DO\n  row i,x{2}\\deep:=2;\nENDFOR\nFOR k FROM 2 TO 1 DO "
          "MoveL there(k),v5,fine,tool0; ENDFOR\n"
          "row 0,s.side;",
          {},
          "RECORD shape num side; num top; ENDRECORD\nVAR shape s:=[40,1];\n"
          "PROC row(num i,num y\\num deep)\n IF Present(deep) MoveL p1,v5,fine,tool0;\n MoveL "
          "Offs(p1,10*i,y,0),v5,fine,tool0;\nENDPROC\n"
          "FUNC robtarget there(num k)\n VAR robtarget q;\n q:=p1;\n q.trans.x:=k*100;\n RETURN q;\nENDFUNC\n");
  REQUIRE(r.problem() == "no such problem");
  REQUIRE(r.program.instructions.size() >= 6);
  std::vector<double> xs;
  for (const Instruction& i : r.program.instructions) xs.push_back(1000 * i.target.pose.position.x());
  const std::vector<double> expected{100, 110, 100, 120, 100, 130, 200, 100, 100};
  REQUIRE(xs.size() == expected.size());
  for (std::size_t i = 0; i < xs.size(); ++i) CHECK(xs[i] == Approx(expected[i]).epsilon(rounding));
  CHECK(r.move(8).target.pose.position.y() == Approx(0.24).epsilon(rounding));
  CHECK(r.move(0).where.line == r.move(2).where.line);
  CHECK(r.move(0).routine == "row");
}

TEST_CASE("rapid: a branch on an input is asked for, with its line, and all of them at once") {
  const std::string body =
      "IF di1=1 THEN\n MoveJ p1,v5,fine,tool0;\nELSE\n MoveAbsJ home,v5,fine,tool0;\nENDIF\nWHILE di2=0 DO\n "
      "MoveJ p1,v5,fine,tool0;\nENDWHILE\n"
      "IF di3=1 THEN\n SetDO do1,1;\nENDIF\n";
  const Reading r = run(body);
  REQUIRE(r.problems.size() == 2);
  CHECK(r.problem(0) ==
        "main.mod:3:1: error: branches on a condition that is known only while the robot runs: 'di1' is a name that no "
        "file "
        "read declares; choose with motion.assume: [{line: 'main.mod:3', take: then}] or take: else, or give "
        "motion.values: [{name: di1, value: VALUE}]");
  CHECK(r.problems[1].where.line == 8);
  REQUIRE(r.program.skipped.size() == 1);  // the branch without moves needs no answer
  CHECK(r.program.skipped[0].where.line == 11);

  ImportOptions options = assuming("main.mod:3", Assumption::else_branch);
  options.assume["8"] = Assumption::then_branch;
  const Reading answered = run(body, options);
  CHECK(answered.problems.empty());
  REQUIRE(answered.program.instructions.size() == 2);
  CHECK(answered.move(0).target.joints.size() == 6);
  CHECK(answered.move(1).target.joints.empty());
}

TEST_CASE("rapid: an endless main loop is one pass, a known condition ends a loop") {
  const Reading r =
      run("VAR num n:=0;\nWHILE n<3 DO\n MoveJ p1,v5,fine,tool0;\n n:=n+1;\nENDWHILE\nWHILE TRUE DO\n "
          "MoveAbsJ home,v5,fine,tool0;\nENDWHILE\n"
          "MoveJ p1,v5,fine,tool0;");
  CHECK(r.problems.empty());
  CHECK(r.program.instructions.size() == 4);
  REQUIRE(r.program.skipped.size() == 1);
  CHECK(r.program.skipped[0].what == "an endless loop; the motion is one pass");
}

TEST_CASE("rapid: a loop over a flag that nothing writes to is an endless main loop") {
  // The counter differs in each pass, so that the data never repeat. The motion repeats after two passes.
  const std::string body =
      "WHILE go DO\n IF n MOD 2=0 THEN\n MoveJ p1,v5,fine,tool0;\n ELSE\n MoveAbsJ home,v5,fine,tool0;\n ENDIF\n "
      "n:=n+1;\nENDWHILE";
  const std::string flag = "PERS bool go:=TRUE; VAR num n:=0;\n";
  const Reading r = run(body, {}, flag);
  REQUIRE(r.problem() == "no such problem");
  CHECK(r.program.instructions.size() == 2);
  REQUIRE(r.program.skipped.size() == 1);
  CHECK(r.program.skipped[0].what == "an endless loop; the motion is 2 passes");
  std::string stop = body;
  stop.replace(stop.find("go"), 2, "NOT stop");
  CHECK(run(stop, {}, "PERS bool stop:=FALSE; VAR num n:=0;\n").program.instructions.size() == 2);
  // A loop that the program ends by its flag ends there, also if a routine writes to its argument.
  CHECK(run("WHILE go DO\n MoveJ p1,v5,fine,tool0;\n n:=n+1;\n go:=n<3;\nENDWHILE", {}, flag)
            .program.instructions.size() == 3);
  CHECK(run("WHILE go DO\n MoveJ p1,v5,fine,tool0;\n n:=n+1;\n decide go;\nENDWHILE", {},
            flag + "PROC decide(INOUT bool b)\n b:=n<3;\nENDPROC\n")
            .program.instructions.size() == 3);
}

TEST_CASE("rapid: a loop that begins often in a long program ends by its counter") {
  std::string before = "VAR num n:=0;\nVAR num i:=0;\nPROC unused()\n";
  for (int line = 0; line < 3000; ++line) before += "n:=n+1;\n";
  const Reading r =
      run("FOR k FROM 1 TO 2000 DO\n i:=0;\n WHILE i<2 DO\n i:=i+1;\n ENDWHILE\nENDFOR\nMoveJ p1,v5,fine,tool0;", {},
          before + "ENDPROC\n");
  CHECK(r.problem() == "no such problem");
  CHECK(r.program.instructions.size() == 1);
}

TEST_CASE("rapid: problems are collected, with place, reason and remedy") {
  const Reading r =
      run("MoveL p9,v100,fine,tool0;\nMoveL p1,v100,z77,tool0;\nMoveL p1,v100,fine,torch;\nMoveL "
          "CRobT(),v1,fine,tool0;\nMoveL p1;");
  REQUIRE(r.problems.size() == 5);
  CHECK(r.problem(0) ==
        "main.mod:3:7: error: names a target 'p9' that no module read declares; give the module that "
        "declares it "
        "too (motion.modules: [{file: FILE}]), or motion.values: [{name: p9, value: VALUE}]");
  CHECK(r.problems[1].what == "names a zone 'z77' that no module read declares");
  CHECK(r.problems[2].what == "names a tool 'torch' that no module read declares");
  CHECK(r.problems[3].what == "names a speed 'v1' that no module read declares");
  CHECK_THAT(r.problems[1].remedy,
             Catch::StartsWith("write one of RAPID's own zones, z0 .. z200 and fine, or give the module"));
  CHECK_THAT(r.problems[3].remedy,
             Catch::StartsWith("write one of RAPID's own speeds, v5 .. v7000 and vmax, or give the module"));
  CHECK(r.problems[4].what == "gives MoveL 1 arguments, too few");
  const Reading broken = run("MoveL p1,,v100 v5;\nIF TRUE THEN\n MoveL (p1,v5,fine,tool0;\n");
  CHECK(broken.problems.size() >= 2);
}

TEST_CASE("rapid: GOTO jumps to labels of its routine") {
  const Reading r =
      run("VAR num i:=0;\nMoveJ p1,v100,fine,tool0;\nagain:\ni:=i+1;\nIF i>2 THEN\n GOTO done;\nENDIF\nMoveL "
          "Offs(p1,i,0,0),v100,fine,tool0;\nGOTO again;\ndone:\nWaitTime 1;");
  REQUIRE(r.problem() == "no such problem");
  REQUIRE(r.program.instructions.size() == 4);
  CHECK((r.move(2).target.pose.position - r.move(1).target.pose.position).x() == Approx(0.001).epsilon(1e-9));
  CHECK(r.move(3).dwell == 1);
  CHECK(run("GOTO far;").problems.at(0).what == "jumps to 'far', which is no label in a block around it");
}

TEST_CASE("rapid: loops and recursion without end are stopped") {
  const Reading loop = run("VAR num n:=0;\nWHILE n<1 DO\n n:=n*1;\nENDWHILE");
  REQUIRE(loop.problems.size() == 1);
  CHECK(loop.problems[0].what == "has run 3000000 statements without an end (a loop that input would end?)");
  const Reading deep = run("again;", {}, "PROC again()\n again;\nENDPROC\n");
  REQUIRE(deep.problems.size() == 1);
  CHECK(deep.problems[0].what == "calls again 60 routines deep (without end?)");
  CHECK(run("x:=" + std::string(5000, '(') + "1;").problems.size() >= 1);
  CHECK(run("x:=1" +
            [] {
              std::string s;
              for (int i = 0; i < 5000; ++i) s += "+1";
              return s;
            }() +
            ";")
            .problems.size() >= 1);
}

TEST_CASE("rapid: settings, displacement, unknown instructions") {
  const Reading r =
      run("AccSet 40,55;\nVelSet 50,600;\nPDispSet [[0,0,100],[1,0,0,0]];\nMoveL "
          "p1,v2000,fine,tool0;\nPDispOff;\nConfL\\Off;\nMoveL p1,v100,fine,tool0;\n"
          "SetDO do1,1;\nGripperClose 3;");
  REQUIRE(r.program.instructions.size() == 2);
  CHECK(r.move(0).acceleration_percent == 40);
  CHECK(r.move(0).jerk_percent == 55);
  CHECK(r.move(0).speed.tool.value() == Approx(0.6).epsilon(rounding));
  CHECK(r.move(0).target.pose.position.z() == Approx(0.4).epsilon(rounding));
  CHECK(r.move(1).speed.tool.value() == Approx(0.05).epsilon(rounding));
  CHECK(r.move(1).target.configuration.kind == ArmConfiguration::Kind::any);
  REQUIRE(r.program.skipped.size() == 2);
  CHECK_FALSE(r.program.skipped[0].may_move);
  CHECK(r.program.skipped[1].may_move);
}

TEST_CASE("rapid: an override makes the time of a move longer, and a limit of the speed does not") {
  const Reading r =
      run("VelSet 50,1;\nMoveL p1,v100\\T:=5,fine,tool0;\nVelSet 100,5000;\nSpeedRefresh 25;\n"
          "MoveL p1,v100\\T:=5,fine,tool0;");
  REQUIRE(r.program.instructions.size() == 2);
  CHECK(r.move(0).speed.duration.value() == Approx(10).epsilon(rounding));
  CHECK(r.move(1).speed.duration.value() == Approx(20).epsilon(rounding));
}

TEST_CASE("rapid: a typing error in the name of a move is the first problem, and asks for nothing else") {
  const Reading r = run("MoveAbs home, v1000, z10, gun;\nMoveJ p1, v1000, fine, gun;");
  REQUIRE(r.problems.size() == 1);
  CHECK_THAT(r.problem(), Catch::Contains("main.mod:3:") &&
                              Catch::Contains("runs 'MoveAbs', which is neither an instruction") &&
                              Catch::Contains("did you mean MoveAbsJ?") && Catch::Contains("motion.modules"));
  CHECK(run("Mover home, 7;\nMoveJ p1, v1000, fine, gun;").program.instructions.size() ==
        1);  // Mover has no tool: not a move
}

TEST_CASE("rapid: a quaternion of another length is one problem for all of its uses, with the numbers that are meant") {
  const std::string targets =
      "CONST robtarget bad:=[[100,900,400],[0,0.5,0.923880,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
      "CONST robtarget none:=[[100,900,400],[0,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
      "PERS tooldata bent:=[TRUE,[[0,0,100],[2,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];\n";
  const Reading r = run(
      "MoveJ home_,v100,fine,tool0;\nMoveJ bad,v100,fine,tool0;\nMoveL Offs(bad,0,0,50),v100,fine,tool0;\nMoveJ bad,v100,z10,tool0;",
      {}, targets + "CONST robtarget home_:=[[1,2,3],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n");
  REQUIRE(r.problems.size() == 1);
  CHECK_THAT(
      r.problem(),
      Catch::Contains("main.mod:4") &&
          Catch::Contains("whose quaternion [0,0.5,0.92388,0] has the length 1.0505 (must be 1) in main.mod:8") &&
          Catch::Contains("write [0.000000,0.475963,0.879465,0.000000] for the same direction"));
  CHECK_THAT(r.problem(), !Catch::Contains("only while the robot runs"));
  const Reading tool = run("MoveJ p1,v100,fine,bent;", {}, targets);
  REQUIRE(tool.problems.size() == 1);
  CHECK_THAT(tool.problem(), Catch::Contains("has a tool 'bent' whose quaternion [2,0,0,0] has the length 2") &&
                                 Catch::Contains("write [1.000000,0.000000,0.000000,0.000000]"));
  CHECK(run("MoveJ none,v100,fine,tool0;", {}, targets).problems.size() == 1);
  CHECK(run("MoveJ p1,v100,fine,gun\\WObj:=jig;")
            .problems.empty());  // a quaternion rounded to eight decimals is accepted
}

TEST_CASE("rapid: a wait of less than 0 s says so") {
  const Reading r = run("MoveJ p1,v100,fine,tool0;\nWaitTime -0.6;");
  REQUIRE(r.problems.size() == 1);
  CHECK_THAT(r.problem(), Catch::Contains("main.mod:4") &&
                              Catch::Contains("waits for -0.6 s (must be 0 or more); write 0.6 if the sign is a slip"));
  CHECK(run("MoveJ p1,v100,fine,tool0;\nWaitTime 0;").problems.empty());
}
