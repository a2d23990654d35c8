// Rules of an ABB controller for its modules. Each test gives the rule and its reason.

#include "tests/catch.h"
#include "tests/sim/program/reading.h"

using namespace dresslife;
using namespace dresslife::sim;
using namespace dresslife::tests;

namespace {

constexpr double rounding = 1e-12;  // rounding error of a few products of numbers near 1

/// Returns axis angles whose first value identifies the move.
std::string axes(double first) { return fmt::format("[[{},0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]]", first); }
std::string go(double first) { return "MoveAbsJ " + axes(first) + ",v1000,fine,tool0;\n"; }
const std::string pose = "CONST robtarget p:=[[1000,0,1000],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n";

Reading run(const std::string& body, const std::string& more = "", const ImportOptions& options = {}) {
  return Reader{Language::rapid,
                options}({{"m.mod", "MODULE m\nPROC main()\n" + body + "ENDPROC\n" + more + "ENDMODULE\n"}});
}

using Angles = std::vector<double>;

/// Returns the angles of axis 1 [deg]. Checks that the reading has no problems.
std::vector<double> first_axes(const Reading& reading) {
  INFO(reading.problem());
  CHECK(reading.problems.empty());
  return tests::first_axes(reading.program);
}

/// Returns whether a skipped instruction contains `words`, as a warning or as a note.
bool told(const Reading& reading, const std::string& words) {
  return skips(reading, words, true) || skips(reading, words, false);
}

}  // namespace

TEST_CASE("rapid controller: LOCAL data and routines are their module's own") {
  // Both modules have a LOCAL j and a LOCAL step. Each module uses its own, in any order of reading.
  const auto module = [](const std::string& name, double at, const std::string& routine, const std::string& call) {
    return "MODULE " + name + "\nLOCAL CONST jointtarget j:=" + axes(at) + ";\nPROC " + routine +
           "()\nMoveAbsJ j,v1000,fine,tool0;\nstep;\n" + call + "ENDPROC\nLOCAL PROC step()\n" + go(at + 1) +
           "ENDPROC\nENDMODULE\n";
  };
  const std::pair<std::string, std::string> a{"a.mod", module("a", 1, "main", "other;\n")},
      b{"b.mod", module("b", 11, "other", "")};
  CHECK(first_axes(Reader{Language::rapid}({a, b})) == Angles{1, 2, 11, 12});
  CHECK(first_axes(Reader{Language::rapid}({b, a})) == Angles{1, 2, 11, 12});
}

TEST_CASE("rapid controller: one name for two global things is refused where it is used") {
  // A controller does not load the second module. The intended one of the two is unknown.
  const std::string twice =
      "MODULE m\nPROC main()\n" + go(1) + "ENDPROC\nPROC main()\n" + go(2) + "ENDPROC\nENDMODULE\n";
  CHECK_THAT(Reader{Language::rapid}({{"m.mod", twice}}).problem(),
             Catch::Contains("contains 'main', which is also in m.mod"));
  const auto data = [](double at) { return "MODULE d\nCONST jointtarget j:=" + axes(at) + ";\nENDMODULE\n"; };
  const std::pair<std::string, std::string> user{
      "m.mod", "MODULE m\nPROC main()\nMoveAbsJ j,v1000,fine,tool0;\nENDPROC\nENDMODULE\n"};
  CHECK_THAT(Reader{Language::rapid}({user, {"d.mod", data(1)}, {"e.mod", data(2)}}).problem(),
             Catch::Contains("gives 'j' another value than"));
  CHECK(first_axes(Reader{Language::rapid}({user, {"d.mod", data(1)}, {"e.mod", data(1)}})) == Angles{1});
}

TEST_CASE("rapid controller: what an instruction that is left out writes is unknown behind it") {
  // k is 0 in the file, but the operator types its value: neither the branch nor the count may use 0.
  for (const char* reads : {"TPReadNum k,\"how many?\";", "TPReadFK k,\"which?\",\"A\",\"B\",stEmpty,stEmpty,stEmpty;",
                            "GetNumber k;", "found:=StrToVal(typed,k);", "UnpackRawBytes raw,1,k\\Float4;"}) {
    CAPTURE(reads);
    const std::string declared = "VAR num k:=0;\nVAR bool found;\n";
    const Reading branch = run(declared + reads + std::string("\nIF k=1 THEN\n") + go(1) + "ENDIF\n" + go(2));
    CHECK_THAT(branch.problem(),
               Catch::Contains("branches on a condition that is known only while the robot runs: 'k'"));
    CHECK_THAT(branch.problem(), Catch::Contains("motion.values: [{name: k, value: VALUE}]"));
    const Reading count = run(declared + reads + std::string("\nFOR i FROM 1 TO k DO\n") + go(1) + "ENDFOR\n" + go(2));
    CHECK_THAT(count.problem(), Catch::Contains("counts to a number that is known only while the robot runs"));
    CHECK(first_axes(run(declared + reads + std::string("\nFOR i FROM 1 TO k DO\n") + go(1) + "ENDFOR\n", "",
                         given({{"k", "3"}}))) == Angles{1, 1, 1});
  }
}

TEST_CASE("rapid controller: Incr, Decr, Add and Clear are arithmetic") {
  CHECK(first_axes(run("VAR num n:=0;\nWHILE n<3 DO\n" + go(1) + "Incr n;\nENDWHILE\n")) == Angles{1, 1, 1});
  CHECK(first_axes(run("VAR num n:=3;\nClear n;\nIF n=3 THEN\n" + go(1) + "ELSE\n" + go(2) + "ENDIF\n")) == Angles{2});
  CHECK(first_axes(run("VAR num n:=5;\nDecr n;\nAdd n,-2;\nIF n=2 THEN\n" + go(1) + "ENDIF\n")) == Angles{1});
}

TEST_CASE("rapid controller: FOR counts down by itself where the end is smaller") {
  CHECK(first_axes(run("FOR i FROM 3 TO 1 DO\nMoveAbsJ "
                       "[[i,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,tool0;\nENDFOR\n")) == Angles{3, 2, 1});
}

TEST_CASE("rapid controller: the counter of a FOR is known in its loop alone, and nothing else writes to it") {
  const std::string move = "MoveAbsJ [[i,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,tool0;\n";
  const std::string loop = "FOR i FROM 1 TO 2 DO\n" + move + "ENDFOR\n";
  CHECK(first_axes(run("VAR num i:=7;\n" + loop + move)) == Angles{1, 2, 7});
  CHECK_THAT(run(loop + move).problem(), Catch::Contains("'i'"));
  for (const char* writes : {"i:=i+1;\n", "Incr i;\n"})
    CHECK_THAT(run("FOR i FROM 1 TO 2 DO\n" + move + writes + "ENDFOR\n").problem(),
               Catch::Contains("which only its FOR may do"));
  CHECK(first_axes(run("FOR i FROM 1 TO 2 DO\nTPWrite \"x\"\\Num:=i;\nunread i;\n" + move + "ENDFOR\n")) ==
        Angles{1, 2});
}

TEST_CASE("rapid controller: ConfL and ConfJ in an undecided branch are asked for") {
  for (const char* sets : {"ConfL\\Off", "ConfJ\\Off"}) {
    const std::string body =
        fmt::format("MoveJ p,v1000,fine,tool0;\nIF di1=1 THEN\n{};\nENDIF\nMoveL p,v100,fine,tool0;\n", sets);
    CHECK_THAT(run(body, pose).problem(), Catch::Contains("di1"));
    CHECK(run(body, pose, given({{"di1", "0"}})).problem() == "no such problem");
  }
}

TEST_CASE("rapid controller: a record takes no single value") {
  for (const char* wrong : {"j.robax:=1;\n", "j.robax:=given;\n"})
    CHECK_THAT(
        run("VAR jointtarget j;\n" + std::string(wrong) + "MoveAbsJ j,v100,fine,tool0;\n", "", given({{"given", "1"}}))
            .problem(),
        Catch::Contains("is given a value that is no robjoint"));
}

TEST_CASE("rapid controller: frames of passes that are cut off are none of the motion") {
  const Reading r = run("w.oframe.trans.x:=w.oframe.trans.x+1;\nMoveL p,v100,fine,tool0\\WObj:=w;\n",
                        pose + "PERS wobjdata w:=[FALSE,TRUE,\"\",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];\n");
  REQUIRE(r.problem() == "no such problem");
  REQUIRE(r.program.instructions.size() == 1);
  CHECK(r.move(0).work_object == 0);
  REQUIRE(r.program.work_objects.size() == 1);
  CHECK(r.program.work_objects[0].frame.position.x() == Approx(0.001));
}

TEST_CASE("rapid controller: ConfL frees lines, ConfJ joint moves") {
  const Reading lines = run("ConfL\\Off;\nMoveJ p,v1000,fine,tool0;\nMoveL Offs(p,0,0,-100),v1000,fine,tool0;\n", pose);
  REQUIRE(lines.problem() == "no such problem");
  CHECK(lines.move(0).target.configuration.text() == "abb 0 0 0 0");
  CHECK(lines.move(1).target.configuration.kind == ArmConfiguration::Kind::any);
  const Reading joints =
      run("ConfJ\\Off;\nMoveJ p,v1000,fine,tool0;\nMoveL Offs(p,0,0,-100),v1000,fine,tool0;\n", pose);
  CHECK(joints.move(0).target.configuration.kind == ArmConfiguration::Kind::any);
  CHECK(joints.move(1).target.configuration.text() == "abb 0 0 0 0");
}

TEST_CASE("rapid controller: an index out of range and a division by zero stop the program") {
  const Reading r = run("VAR num z{3}:=[1,2,3];\nVAR num y:=7;\nz{4}:=9;\nz{0}:=8;\ny:=1/0;\n" + go(1));
  REQUIRE(r.problems.size() == 3);
  CHECK_THAT(r.problem(0), Catch::Contains("m.mod:5:") && Catch::Contains("the index 4 of a list of 3"));
  CHECK_THAT(r.problem(1), Catch::Contains("the index 0 of a list of 3"));
  CHECK_THAT(r.problem(2), Catch::Contains("divides by zero"));
  // A value that is unknown because of this error is not a second problem.
  const Reading target =
      run("VAR robtarget t{2};\nMoveJ t{3},v1000,fine,tool0;\nIF t{3}.trans.x>0 THEN\n" + go(1) + "ENDIF\n");
  REQUIRE(target.problems.size() == 2);
  CHECK_THAT(target.problem(1), Catch::Contains("the index 3 of a list of 2"));
}

TEST_CASE("rapid controller: behind ExitCycle main begins again, with the data as they are") {
  CHECK(first_axes(run(go(1) + "ExitCycle;\n" + go(2))) == Angles{1});
  // The first pass ends in a routine that main calls. The next passes run completely.
  const std::string step = "PROC step()\nIF n=1 ExitCycle;\n" + go(2) + "IF n=3 EXIT;\nENDPROC\nVAR num n:=0;\n";
  CHECK(first_axes(run(go(1) + "n:=n+1;\nstep;\n" + go(3), step)) == Angles{1, 1, 2, 3, 1, 2});
  // ExitCycle in an endless loop: a state machine with two states.
  CHECK(first_axes(run(
            "WHILE TRUE DO\n" + go(1) + "IF s THEN\ns:=FALSE;\nExitCycle;\nENDIF\n" + go(2) + "s:=TRUE;\nENDWHILE\n",
            "VAR bool s:=TRUE;\n")) == Angles{1, 1, 2, 1});
}

TEST_CASE("rapid controller: elements of a list of records have its components") {
  const std::string record = "RECORD part\nnum n;\nrobtarget p;\nENDRECORD\n";
  const std::string target = "[[{},0,1000],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]";
  const Reading r = Reader{Language::rapid}(
      {{"m.mod", "MODULE m\n" + record + "PERS part list{2}:=[[1," + fmt::format(fmt::runtime(target), 100) + "],[2," +
                     fmt::format(fmt::runtime(target), 200) +
                     "]];\nPROC main()\nIF list{1}.n=1 MoveL list{2}.p,v100,fine,tool0;\nENDPROC\nENDMODULE\n"}});
  REQUIRE(r.problem() == "no such problem");
  CHECK(std::abs(r.move(0).target.pose.position.x() - 0.2) < rounding);
}

TEST_CASE("rapid controller: orientations multiply, the second within the first") {
  // 90 deg about z, then 180 deg about the new y: (c, 0, 0, s)(0, 0, 1, 0) = (0, -s, c, 0), c = s =
  // sqrt(1/2).
  const Reading r = run("q.rot:=OrientZYX(90,0,0)*q.rot;\nMoveL q,v100,fine,tool0;\n",
                        "VAR robtarget q:=[[1000,0,1000],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n");
  REQUIRE(r.problem() == "no such problem");
  const double half = std::sqrt(0.5);
  CHECK(r.move(0).target.pose.orientation.isApprox(Quaternion(0, -half, half, 0)));
}

TEST_CASE("rapid controller: NoEOffs leaves the offsets of external axes out") {
  const std::string at = "[[0,0,0,0,30,0],[100,9E9,9E9,9E9,9E9,9E9]]";
  const Reading r = run("EOffsSet [50,9E9,9E9,9E9,9E9,9E9];\nMoveAbsJ " + at + ",v100,fine,tool0;\nMoveAbsJ " + at +
                        "\\NoEOffs,v100,fine,tool0;\nMoveAbsJ " + at + ",v100,fine,tool0;\n");
  REQUIRE(r.problem() == "no such problem");
  CHECK(r.move(0).target.external_axes == std::vector<double>{150});
  CHECK(r.move(1).target.external_axes == std::vector<double>{100});
  CHECK(r.move(2).target.external_axes == std::vector<double>{150});
}

TEST_CASE("rapid controller: RAISE is reported, its handlers are not followed") {
  const Reading r = run(go(1) + "RAISE e;\n" + go(2) + "ERROR\nTRYNEXT;\n", "VAR errnum e:=-1;\n");
  CHECK(first_axes(r) == Angles{1, 2});
  CHECK(skips(r, "RAISE", true));
}

TEST_CASE("rapid controller: a weave is reported, the line is followed") {
  const Reading r = run("ArcL p,v100,sm1,wd1\\Weave:=wv1,fine,tool0;\n",
                        pose +
                            "PERS seamdata sm1:=[1,1,0,0];\nPERS welddata "
                            "wd1:=[8,0,[5,0,24,0,0,0,0,0,0],[0,0,0,0,0,0,0,0,0]];\n"
                            "PERS weavedata wv1:=[1,0,3,4,0,0,0,0,0,0,0,0,0,0,0];\n");
  REQUIRE(r.problem() == "no such problem");
  CHECK(skips(r, "the torch swings", true));
  CHECK(r.move(0).speed.tool.value() == Approx(0.008).epsilon(rounding));  // welddata begins with 8 mm/s
}

TEST_CASE("rapid controller: a loop that moves in one arm alone waits for it, as WaitUntil would") {
  const auto loop = [&](const std::string& body) { return run("WHILE TRUE DO\n" + body + "ENDWHILE\n"); };
  const std::string then = "IF di1=1 THEN\nSet do1;\n" + go(1) + go(2);
  const Reading waits = loop("Reset do1;\n" + then + "ELSE\nTPWrite \"waiting\";\nWaitTime 1;\nENDIF\n");
  CHECK(first_axes(waits) == Angles{1, 2});
  CHECK_FALSE(waits.program.skipped.empty());
  CHECK(told(waits, "the robot waits for 'di1'"));
  // Main restarts at its end and is a loop, too. So is a loop that is left by GOTO.
  CHECK(first_axes(run(then + "ENDIF\n")) == Angles{1, 2});
  CHECK(first_axes(run("WHILE TRUE DO\nIF di1=1 GOTO on;\nENDWHILE\non:\n" + go(3))) == Angles{3});
  // The branch is a question if another arm or the rest of the loop moves, or if an idle pass changes data.
  const std::string asks = "branches on a condition that is known only while the robot runs";
  CHECK_THAT(loop(then + "ELSE\n" + go(3) + "ENDIF\n").problem(), Catch::Contains(asks));
  CHECK_THAT(loop(then + "ELSEIF di2=1 THEN\n" + go(3) + "ENDIF\n").problem(), Catch::Contains(asks));
  CHECK_THAT(loop(then + "ENDIF\n" + go(3)).problem(), Catch::Contains(asks));
  CHECK_THAT(run("VAR num n:=0;\nWHILE TRUE DO\nn:=n+1;\n" + then + "ENDIF\nENDWHILE\n").problem(),
             Catch::Contains(asks));
  CHECK_THAT(loop("IF di1=1 THEN\nSet do1;\nELSEIF FALSE THEN\n" + go(1) + "ENDIF\n").problem(), Catch::Contains(asks));
  CHECK_THAT(run("FOR i FROM 1 TO 3 DO\n" + then + "ENDIF\nENDFOR\n").problem(), Catch::Contains(asks));
}

TEST_CASE("rapid controller: a branch that only waits is no question") {
  const Reading r = run(go(1) + "IF di1=1 WaitTime 2;\nWHILE di2=0 DO\nWaitTime 0.1;\nENDWHILE\n" + go(2));
  CHECK(first_axes(r) == Angles{1, 2});
  CHECK(told(r, "branch that waits on 'di1'"));
}

TEST_CASE("rapid controller: a handler of errors is not run, and reported where it moves the robot") {
  const std::string away = "PROC away()\n" + go(9) + "ENDPROC\n";
  const Reading r = run(go(1) + "ERROR\naway;\nTRYNEXT;\n", away);
  CHECK(first_axes(r) == Angles{1});
  CHECK(told(r, "main: its handler of errors moves the robot"));
  CHECK_FALSE(told(run(go(1) + "ERROR\nTPWrite \"away\";\nTRYNEXT;\n", away), "handler of errors"));
}

TEST_CASE("rapid controller: what a trap moves is read by its name") {
  ImportOptions trap;
  trap.routine = "flee";
  CHECK(first_axes(run(go(1), "TRAP flee\n" + go(9) + "ENDTRAP\n", trap)) == Angles{9});
}

TEST_CASE("rapid controller: values behind one branch are one question, the one that decides the branch") {
  const Reading r =
      run("VAR num x:=0;\nVAR num y:=0;\nIF gi1=2 THEN\nx:=1;\ny:=1;\nENDIF\n"
          "MoveL Offs(p,x,0,0),v100,fine,tool0;\nMoveL Offs(p,0,y,0),v100,fine,tool0;\n",
          pose);
  REQUIRE(r.problems.size() == 1);
  CHECK_THAT(
      r.problem(),
      Catch::Contains("'x' depends on the branch in m.mod:5, that on 'gi1', which is a name") &&
          Catch::Contains(
              "give motion.values: [{name: gi1, value: VALUE}], or motion.assume: [{line: 'm.mod:5', take: then}] or take: else"));
  const Reading answered = run("VAR num x:=0;\nIF gi1=2 THEN\nx:=1;\nENDIF\nMoveL Offs(p,x,0,0),v100,fine,tool0;\n",
                               pose, given({{"gi1", "2"}}));
  REQUIRE(answered.problem() == "no such problem");
}

TEST_CASE("rapid controller: a refusal names the routine and all that its condition lacks") {
  const Reading r = run("step;\n", "PROC step()\nIF di1=1 AND di2=0 THEN\n" + go(1) +
                                       "ENDIF\nIF di1=1 AND di2=0 THEN\n" + go(2) + "ENDIF\nENDPROC\n");
  REQUIRE(r.problems.size() == 1);
  CHECK_THAT(r.problem(), Catch::Contains("motion.values: [{name: di1, value: VALUE}, {name: di2, value: VALUE}]"));
  Problems problems;
  for (const Problem& p : r.problems) problems.add_use(p);
  Problem again = r.problems[0];
  again.where.line = 90;
  problems.add_use(again);
  CHECK_THROWS_WITH(problems.throw_if_any(),
                    Catch::Contains("error: step branches on") && Catch::Contains("m.mod:90)"));
}

TEST_CASE("rapid controller: an offset of a target without a value asks for the target") {
  CHECK_THAT(run("VAR robtarget t;\nMoveL Offs(t,0,0,50),v100,fine,tool0;\n").problem(),
             Catch::Contains("'t' was never given a value (all of it is 0)") &&
                 Catch::Contains("motion.values: [{name: t, value: VALUE}]"));
  CHECK_THAT(run("VAR iodev io;\nMoveL Offs(p,0,0,ReadNum(io)),v100,fine,tool0;\n", pose).problem(),
             Catch::Contains("'readnum' is a function of what the robot meets"));
}

TEST_CASE("rapid controller: a mistake counts where it runs") {
  CHECK(first_axes(run(go(1), "PROC unused()\n<SMT>\nENDPROC\n")) == Angles{1});
  CHECK_THAT(run(go(1) + "unused;\n", "PROC unused()\nx:=;\nENDPROC\n").problem(), Catch::Contains("m.mod:"));
}

TEST_CASE("rapid controller: a statement that nobody wrote stops the program where it stands") {
  const Reading called = run(go(1) + "unused;\n" + go(2), "PROC unused()\n<SMT>\nENDPROC\n");
  CHECK(first_axes(called) == Angles{1});
  CHECK(skips(called, "<SMT>: no statement is written", true));
  const Reading behind = run(go(1) + go(2) + "<SMT>\n");
  CHECK(first_axes(behind) == Angles{1, 2});
  CHECK(skips(behind, "<SMT>", true));
  CHECK_FALSE(skips(run(go(1) + "EXIT;\n<SMT>\n"), "<SMT>", true));
}

TEST_CASE("rapid controller: numbers may be written with the base 16, 8 or 2") {
  for (const auto& [written, value] :
       {std::pair{"0x1F", 31}, {"0Xff", 255}, {"0b101", 5}, {"0o17", 15}, {"0", 0}, {"10", 10}})
    CHECK(first_axes(run(fmt::format(
              "VAR num n:={};\nMoveAbsJ [[n,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\n", written))) ==
          Angles{static_cast<double>(value)});
}

TEST_CASE("rapid controller: a routine is called late by its name, or by its module and its name") {
  const std::string step = "PROC step()\n" + go(1) + "ENDPROC\n";
  CHECK(first_axes(run("%\"step\"%;\n%\"m:step\"%;\n%\"m\"+\":step\"%;\n", step)) == Angles{1, 1, 1});
  const Reading two = Reader{Language::rapid}(
      {{"a.mod", "MODULE a\nPROC main()\n%\"b:step\"%;\n%\"a:step\"%;\nENDPROC\nLOCAL PROC step()\n" + go(1) +
                     "ENDPROC\nENDMODULE\n"},
       {"b.mod", "MODULE b\nLOCAL PROC step()\n" + go(2) + "ENDPROC\nENDMODULE\n"}});
  CHECK(first_axes(two) == Angles{2, 1});
  CHECK(skips(run("%\"other:step\"%;\n" + go(3), step), "other:step: not a routine", true));
}

TEST_CASE("rapid controller: a frame that a routine takes as an argument is one frame, however often it is called") {
  const std::string data =
      "PERS tooldata A:=[TRUE,[[0,0,500],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];\nPERS tooldata "
      "B:=[TRUE,[[0,0,900],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];\nPERS wobjdata "
      "W:=[FALSE,TRUE,\"\",[[500,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];\n";
  const Reading calls =
      run("FOR i FROM 1 TO 3000 DO\ngo A,W;\ngo B,W;\nENDFOR\nEXIT;\n",
          pose + data + "PROC go(PERS tooldata t,PERS wobjdata o)\nMoveJ p,v100,fine,t\\WObj:=o;\nENDPROC\n");
  REQUIRE(calls.problem() == "no such problem");
  CHECK(calls.program.instructions.size() == 6000);
  REQUIRE(calls.program.tools.size() == 2);
  CHECK(calls.program.tools[0].name == "a");
  CHECK(calls.program.tools[1].name == "b");
  REQUIRE(calls.program.work_objects.size() == 1);
  CHECK(calls.program.work_objects[0].name == "w");
}

TEST_CASE("rapid controller: values of records and lists are compared with all that is in them") {
  const std::string data =
      "CONST pos a:=[1,2,3];\nVAR pos b;\nCONST pose q:=[[1,2,3],[1,0,0,0]];\nVAR pose r;\nVAR robtarget t;\nVAR num "
      "l{2}:=[1,2];\nVAR num k{2}:=[1,3];\n";
  const std::string body = "b:=a;\nr:=q;\nt:=p;\nIF b=a THEN\n" + go(1) + "ENDIF\nIF r=q THEN\n" + go(2) +
                           "ENDIF\nIF t=p THEN\n" + go(3) + "ENDIF\nIF l=k THEN\n" + go(4) +
                           "ENDIF\nk{2}:=2;\nIF l=k THEN\n" + go(5) + "ENDIF\nb.z:=4;\nIF b<>a THEN\n" + go(6) +
                           "ENDIF\nr.trans:=b;\nIF r=q THEN\n" + go(7) + "ENDIF\nEXIT;\n";
  CHECK(first_axes(run(body, data + pose)) == Angles{1, 2, 3, 5, 6});
  // Values that differ in a known part are different for all values of the unknown parts.
  CHECK(first_axes(run("VAR pos u;\nu:=[gi1,2,3];\nIF u=[9,9,9] THEN\n" + go(1) + "ENDIF\n" + go(2))) == Angles{2});
  CHECK_THAT(run("VAR pos u;\nu:=[gi1,2,3];\nIF u=[9,2,3] THEN\n" + go(1) + "ENDIF\n" + go(2)).problem(),
             Catch::Contains("'gi1'"));
}

TEST_CASE("rapid controller: switches that exclude each other are all optional") {
  const std::string q = "PROC q(\\switch first|switch second)\nIF Present(first) THEN\n" + go(1) +
                        "ENDIF\nIF Present(second) THEN\n" + go(2) + "ENDIF\n" + go(3) + "ENDPROC\n";
  CHECK(first_axes(run("q;\nq\\first;\nq\\second;\n", q)) == Angles{3, 1, 3, 2, 3});
  Reader lone{Language::rapid};
  lone.options.routine = "q";
  CHECK(first_axes(lone({{"m.mod", "MODULE m\n" + q + "ENDMODULE\n"}})) == Angles{3});
}

TEST_CASE("rapid controller: moves of several robots together are named") {
  const Reading together = run("SyncMoveOn s1,tasks;\nMoveL p\\ID:=10,v100,fine,tool0;\nSyncMoveOff s2;\n", pose);
  CHECK(together.program.instructions.size() == 1);
  CHECK(skips(together, "SyncMoveOn: several robots or positioners", true));
  CHECK(skips(together, "\\ID: another robot", true));
  CHECK_FALSE(skips(run("MoveL p,v100,fine,tool0;\n", pose), "robot", true));
}

TEST_CASE("rapid controller: optional arguments are handed on, arguments may have names") {
  const std::string routines =
      "PROC first(\\switch fast)\nstep \\fast?fast;\nENDPROC\nPROC step(\\switch fast)\nIF Present(fast) "
      "THEN\n" +
      go(1) + "ELSE\n" + go(2) + "ENDIF\nENDPROC\n";
  CHECK(first_axes(run("first \\fast;\nfirst;\n", routines)) == Angles{1, 2});
  const Reading named = run("MoveJ p,v1000,fine,Tool:=tool0;\n", pose);
  REQUIRE(named.problem() == "no such problem");
  CHECK(named.program.instructions.size() == 1);
}

TEST_CASE("rapid controller: a routine's name may be worked out") {
  CHECK(first_axes(run("VAR num n:=1;\n%\"step\"+ValToStr(n)%;\nCallByVar \"step\",2;\n",
                       "PROC step1()\n" + go(1) + "ENDPROC\nPROC step2()\n" + go(2) + "ENDPROC\n")) == Angles{1, 2});
}

TEST_CASE("rapid controller: CJointT stands where the last joint move led") {
  const Reading r = run("VAR jointtarget j;\n" + go(5) +
                        "j:=CJointT();\nj.robax.rax_6:=j.robax.rax_6+90;\nMoveAbsJ j,v1000,fine,tool0;\n");
  REQUIRE(r.problem() == "no such problem");
  CHECK(r.move(1).target.joints[0] == Approx(5 * degree).epsilon(rounding));
  CHECK(r.move(1).target.joints[5] == Approx(90 * degree).epsilon(rounding));
  CHECK_THAT(run("VAR jointtarget j;\nMoveJ p,v1000,fine,tool0;\nj:=CJointT();\nMoveAbsJ j,v1000,fine,tool0;\n", pose)
                 .problem(),
             Catch::Contains("asks for the axes at a target that is a pose"));
}

TEST_CASE("rapid controller: inputs are given by their names, arguments behind the routine's") {
  const std::string lift = "MoveL Offs(p,0,0,10*GInput(gi1)),v1000,fine,tool0;\n";
  CHECK_THAT(run(lift, pose).problem(), Catch::Contains("give motion.values: [{name: gi1, value: VALUE}]"));
  CHECK(run(lift, pose, given({{"gi1", "2"}})).move(0).target.pose.position.z() == Approx(1.02).epsilon(rounding));
  ImportOptions routine;
  routine.routine = "drill(3)";
  CHECK(first_axes(run(go(1),
                       "PROC drill(num at)\nMoveAbsJ "
                       "[[at,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,tool0;\nENDPROC\n",
                       routine)) == Angles{3});
}

TEST_CASE("rapid controller: the loop that runs away is named, not the routine that it called") {
  const Reading r =
      run("VAR num n:=0;\nWHILE n<10 DO\nsignals;\nENDWHILE\n", "PROC signals()\nSetDO do1,1;\nENDPROC\n");
  CHECK_THAT(r.problem(),
             Catch::Contains("m.mod:4:") && Catch::Contains("motion.assume: [{line: 'm.mod:4', take: then}]"));
}

TEST_CASE("rapid controller: what is missing is reported once, with the number of its other places") {
  const Reading frames =
      run("FOR i FROM 1 TO 3 DO\nMoveJ p,v1000,fine,grip\\WObj:=pallet;\nMoveL "
          "p,v1000,fine,grip\\WObj:=pallet;\nENDFOR\n",
          pose);
  REQUIRE(frames.problems.size() == 2);
  for (const Problem& problem : frames.problems)
    CHECK(problem.more_uses.size() == 1);  // counted per line, not per pass
  CHECK_THAT(frames.problem(0), Catch::Contains("'grip'") && Catch::Contains("motion.tools or motion.work_objects"));
  const Reading parts =
      run("MoveJ Offs(p,0,0,height),v1000,fine,tool0;\nMoveL Offs(p,0,0,height+5),v1000,fine,tool0;\n", pose);
  REQUIRE(parts.problems.size() == 1);
  CHECK_THAT(parts.problem(), Catch::Contains("'height' is a name that no file read declares"));
  CHECK(parts.problems[0].more_uses.size() == 1);
}

TEST_CASE("rapid controller: one question for one decision, whatever it depends on") {
  const Reading r =
      run("wait di1;\nwait di2;\n", "PROC wait(VAR signaldi input)\nIF input=1 THEN\n" + go(1) + "ENDIF\nENDPROC\n");
  REQUIRE(r.problems.size() == 1);
  CHECK_THAT(r.problem(), Catch::Contains("motion.assume: [{line: 'm.mod:7', take: then}]"));
}

TEST_CASE("rapid controller: encoded modules are reported as encoded, and matter only where they are called") {
  std::string encoded;
  for (int i = 0; i < 2000; ++i) encoded += static_cast<char>(i * 37 % 256);
  const auto with = [&](const std::string& body) {
    return Reader{Language::rapid}(
        {{"m.mod", "MODULE m\nPROC main()\n" + body + "ENDPROC\nENDMODULE\n"}, {"secret.mod", encoded}});
  };
  CHECK(first_axes(with(go(1))) == Angles{1});
  const Reading failed = with("MoveJ hidden,v1000,fine,tool0;\n");
  REQUIRE(failed.problems.size() == 2);
  CHECK_THAT(failed.problem(1), Catch::Contains("secret.mod:1:1: error: is encoded"));
}

TEST_CASE("rapid controller: production is meant where a program asks for the operating mode") {
  const std::string choice = "IF OpMode()<>OP_AUTO THEN\n" + go(1) + "ELSE\n" + go(2) + "ENDIF\n";
  CHECK(first_axes(run(choice)) == Angles{2});
  CHECK(first_axes(run(choice, "", given({{"opmode", "2"}}))) == Angles{1});
}

TEST_CASE("rapid controller: SpeedRefresh slows down, 0 lets the robot stand until a trap lets it go on") {
  const Reading r = run("SpeedRefresh 50;\n" + go(1) + "SpeedRefresh 0;\n" + go(2));
  REQUIRE(r.problem() == "no such problem");
  CHECK(r.move(0).speed.tool.value() == Approx(0.5).epsilon(rounding));
  CHECK(r.move(1).speed.tool.value() == Approx(0.5).epsilon(rounding));
  CHECK(skips(r, "SpeedRefresh 0", true));
}

TEST_CASE("rapid controller: what a trap writes is unknown, one that moves the robot is reported") {
  // An interrupt may occur at any time. A variable that a trap writes is known again after the program writes to it.
  const std::string traps =
      "VAR bool stopped:=FALSE;\nVAR intnum number;\nTRAP halt\nstopped:=TRUE;\nENDTRAP\nTRAP "
      "flee\nStopMove;\n" +
      go(9) + "ENDTRAP\n";
  const std::string branch = "IF stopped THEN\n" + go(1) + "ELSE\n" + go(2) + "ENDIF\n";
  CHECK_THAT(run("CONNECT number WITH halt;\nISignalDI di1,1,number;\n" + branch, traps).problem(),
             Catch::Contains("'stopped' may be written by the trap halt (m.mod:3)"));
  CHECK(first_axes(run("CONNECT number WITH halt;\nstopped:=FALSE;\n" + branch, traps)) == Angles{2});
  CHECK(
      skips(run("CONNECT number WITH flee;\n" + go(1), traps),
            "flee: a trap that moves or stops the robot on its interrupt, which is taken not to come; motion.routine: "
            "flee reads it alone",
            true));
  CHECK_FALSE(skips(run("CONNECT number WITH halt;\n" + go(1), traps), "a trap", true));
}

TEST_CASE("rapid controller: main begins again at its end") {
  // State machines without a loop need the restart of main: 1 once, then 2, 3, 2, 3, ...
  const std::string machine = "TEST state\nCASE 0:\n" + go(1) + "state:=1;\nCASE 1:\n" + go(2) +
                              "state:=2;\nCASE 2:\n" + go(3) + "state:=1;\nENDTEST\n";
  CHECK(first_axes(run(machine, "VAR num state:=0;\n")) == Angles{1, 2, 3});
  ImportOptions five;
  five.passes = 5;
  CHECK(first_axes(run(machine, "VAR num state:=0;\n", five)) == Angles{1, 2, 3, 2, 3});
  // Variables of main are initialized in each cycle, a counter of parts changes no move, and EXIT is the end.
  CHECK(first_axes(run("VAR num state:=0;\n" + machine)) == Angles{1});
  CHECK(first_axes(run(go(1) + "Incr parts;\n", "VAR num parts:=0;\n")) == Angles{1});
  CHECK(first_axes(run(go(1) + "Incr parts;\nIF parts=3 EXIT;\n", "VAR num parts:=0;\n")) == Angles{1, 1, 1});
  // If the next cycle is unknown, the motion is the first one, with a warning.
  const std::string next = "IF again THEN\n" + go(2) + "ENDIF\n" + go(1);
  const std::string typed = "TPReadNum n,\"\";\nagain:=n>0;\n", data = "VAR bool again:=FALSE;\nVAR num n;\n";
  const Reading asks = run(next + go(3) + typed, data);
  CHECK(first_axes(asks) == Angles{1, 3});
  CHECK(skips(asks, "its next cycle branches on a condition that is known only while the robot runs", true));
  // A motion with a single position is not accepted: the unknown value is a question.
  CHECK_THAT(run(next + typed, data).problem(), Catch::Contains("'n' may be written by tpreadnum"));
  // A routine other than main runs once.
  ImportOptions step;
  step.routine = "step";
  CHECK(first_axes(run(go(9), "VAR num state:=0;\nPROC step()\n" + machine + "ENDPROC\n", step)) == Angles{1});
}

TEST_CASE("rapid controller: one state of a machine is no motion") {
  // The third state depends on an input: the two states before it are known, the following ones are not.
  const std::string machine = "TEST state\nCASE 0:\n" + go(1) + go(2) + "state:=1;\nCASE 1:\n" + go(3) +
                              "state:=2;\nCASE 2:\nIF di1=1 state:=3;\nCASE 3:\n" + go(4) + "ENDTEST\n",
                    data = "VAR num state:=0;\n";
  CHECK_THAT(run(machine, data).problem(), Catch::Contains("in pass 4 of main: motion.passes: 3 ends before"));
  ImportOptions three;
  three.passes = 3;
  CHECK(first_axes(run(machine, data, three)) == Angles{1, 2, 3});
  // Two states whose positions shift in every cycle are one cycle, not only the first state.
  const std::string shift =
      "TEST state\nCASE 0:\nMoveL Offs(p,0,y,0),v100,fine,tool0;\nstate:=1;\nCASE 1:\n"
      "MoveL Offs(p,0,0,y),v100,fine,tool0;\nstate:=0;\ny:=y+1;\nENDTEST\n";
  const Reading cycle = run(shift, pose + "VAR num state:=0;\nVAR num y:=0;\n");
  CHECK(cycle.problem() == "no such problem");
  CHECK(cycle.program.instructions.size() == 2);
  CHECK(skips(cycle, "its passes differ, and no pass repeats an earlier one within 200 passes", true));
}

TEST_CASE("rapid controller: a PERS without a value has it from another task's module") {
  const std::string turn = "MoveAbsJ [[a,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,tool0;\n";
  const std::string words = "'a' is a PERS without a value here: another task's module gives it";
  CHECK_THAT(run(turn, "PERS num a;\n").problem(), Catch::Contains(words));
  CHECK(first_axes(run(turn, "PERS num a;\n", given({{"a", "7"}}))) == Angles{7});
  CHECK(first_axes(run("a:=3;\n" + turn, "PERS num a;\n")) == Angles{3});
  // The rule applies to each element of a list.
  const std::string list = "MoveAbsJ [[b{2},0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,tool0;\n";
  CHECK(run(list, "PERS num b{3};\n").problems.size() == 1);
  CHECK(first_axes(run("b{2}:=4;\n" + list, "PERS num b{3};\n")) == Angles{4});
  CHECK(first_axes(run(list, "VAR num b{3};\n")) == Angles{0});
  // Two tasks that wait for each other: this task stands still until the other task sets the variable that it cleared.
  const std::string waits = "TEST state\nCASE 0:\n" + go(1) +
                            "a:=0;\nstate:=1;\nCASE 1:\nIF a=1 state:=2;\n"
                            "CASE 2:\n" +
                            go(2) + "ENDTEST\n";
  CHECK(skips(run(waits, "PERS num a;\nVAR num state;\n"), "another task may write what has no value here (a)", true));
  CHECK_FALSE(skips(run(waits, "VAR num a;\nVAR num state;\n"), "another task", true));
}

TEST_CASE("rapid controller: a file of another language is reported in a line") {
  const Reading other = Reader{Language::rapid}({{"arm.prg", "#!/usr/bin/env python3\nprint(f'{x!r}')  # ?\n"}});
  CHECK(other.problems.size() == 2);  // a missing routine and a missing module
  CHECK_THAT(other.problem(0) + other.problem(1), Catch::Contains("holds no MODULE"));
}

TEST_CASE("rapid controller: a function may move the robot where a condition or an assignment calls it") {
  const std::string step =
      "FUNC bool step(num at)\nMoveAbsJ [[at,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,tool0;\n"
      "RETURN at<2;\nENDFUNC\nVAR bool more;\nVAR num n:=0;\n";
  CHECK(first_axes(run("more:=TRUE;\nWHILE more DO\nIncr n;\nmore:=step(n);\nENDWHILE\n", step)) == Angles{1, 2});
  for (const char* body : {"WHILE di1=1 DO\nmore:=step(1);\nENDWHILE\n", "IF di1=1 more:=step(1);\n",
                           "IF di1=1 THEN\nIF step(1) THEN\nSet do1;\nENDIF\nENDIF\n"})
    CHECK_THAT(run(go(1) + go(2) + body, step).problem(),
               Catch::Contains("'di1' is a name that no file read declares"));
}

TEST_CASE("rapid controller: what a branch without moves decides can be had by answering that branch") {
  const std::string body = "VAR num k:=0;\nIF di1=1 THEN\nk:=1;\nENDIF\nIF k=1 THEN\n" + go(1) + "ENDIF\n" + go(2);
  CHECK_THAT(
      run(body).problem(),
      Catch::Contains("'k' depends on the branch in m.mod:4, that on 'di1', which is a name") &&
          Catch::Contains(
              "or give motion.values: [{name: di1, value: VALUE}], or motion.assume: [{line: 'm.mod:4', take: then}] or take: else"));
  ImportOptions answered;
  answered.assume["m.mod:4"] = Assumption::then_branch;
  CHECK(first_axes(run(body, "", answered)) == Angles{1, 2});
}

TEST_CASE("rapid controller: a main that is called at the end of each job is a cycle") {
  // main -> job -> main -> ...: the controller continues until its memory is full. Statements after the calls never run.
  const std::string job = "PROC job()\n" + go(1) + go(2) + "main;\n" + go(9) + "ENDPROC\n";
  CHECK(first_axes(run("job;\n" + go(8), job)) == Angles{1, 2});
  // A counter that no branch uses does not prevent the repetition.
  CHECK(first_axes(run("n:=n+1;\njob;\n", job + "VAR num n:=0;\n")) == Angles{1, 2});
  // A recursion with an end runs to its end.
  CHECK(first_axes(run("n:=n+1;\n" + go(1) + "IF n<6 main;\n" + go(7) + "n:=0;\n" + "Stop;\nEXIT;\n",
                       "VAR num n:=0;\n")) == Angles{1, 1, 1, 1, 1, 1, 7});
}

TEST_CASE("rapid controller: bits of bytes count") {
  const auto taken = [](const std::string& condition) {
    return first_axes(run(go(0) + "IF " + condition + " THEN\n" + go(1) + "ENDIF\n")).size() == 2;
  };
  CHECK(taken("BitAnd(12,10)=8"));
  CHECK(taken("BitOr(1,BitLSh(1,2))=5"));
  CHECK(taken("BitXOr(12,10)=6"));
  CHECK(taken("BitLSh(255,1)=254"));
  CHECK(taken("BitRSh(8,3)=1"));
  CHECK(taken("BitNeg(1)=254"));
  CHECK(taken("BitCheck(4,3)"));
  CHECK_FALSE(taken("BitCheck(4,2)"));
}

TEST_CASE("rapid controller: a GOTO that loops forever has all passes of a counter that decides") {
  const auto loop = [](const std::string& reset) {
    return "VAR num n:=0;\ntop:\n" + go(1) + "n:=n+1;\n" + reset + "GOTO top;\n";
  };
  CHECK(first_axes(run(loop("IF n>=3 THEN\n" + go(2) + "n:=0;\nENDIF\n"))) == Angles{1, 1, 1, 2});
  CHECK(first_axes(run(loop("IF n MOD 3=0 THEN\n" + go(2) + "ENDIF\n"))) == Angles{1, 1, 1, 2});
  CHECK(first_axes(run(loop(""))) == Angles{1});  // a counter of parts
}

TEST_CASE("rapid controller: moves that come after more passes than are searched are a warning") {
  const auto body = [](const std::string& condition) {
    return go(1) + "n:=n+1;\nIF " + condition + " THEN\n" + go(2) + "ENDIF\n";
  };
  const std::string data = "VAR num n:=0;\n", words = "compares a value that is new in each pass";
  for (const auto& [begin, end] :
       {std::pair("WHILE TRUE DO\n", "ENDWHILE\n"), {"top:\n", "GOTO top;\n"}, {"", ""}, {"", "main;\n"}}) {
    INFO(begin);
    const Reading seldom = run(begin + body("n>=1000") + end, data);
    CHECK(first_axes(seldom) == Angles{1});
    CHECK(skips(seldom, words, true));
    CHECK_THAT(moves_left_out(seldom.program).front().line(), Catch::Contains("Remedy: motion.passes: N, with"));
    // the other arm does not move, or the values of the comparison return: no doubt
    CHECK_FALSE(skips(run(begin + body("n>0") + end, data), words, true));
    CHECK_FALSE(skips(run(begin + body("n MOD 3=0") + end, data), words, true));
    CHECK_FALSE(skips(run(begin + std::string("FOR i FROM 1 TO 3 DO\nIF i=5 THEN\n") + go(2) + "ENDIF\nENDFOR\n" +
                              go(1) + "n:=n+1;\n" + end,
                          data),
                      words, true));
  }
}

TEST_CASE("rapid controller: numbers have single precision, so a loop that adds 0.1 ends at 1") {
  const std::string loop = "x:=0;\nWHILE x<1 DO\n" + go(1) + "x:=x+0.1;\nENDWHILE\n", data = "VAR num x:=0;\n";
  CHECK(first_axes(run(loop, data)).size() ==
        10);  // the sum of ten 0.1 is 1.0000001; in double precision it is below 1
  CHECK(first_axes(run("x:=0.1;\nx:=x+0.2;\nIF x=0.3 THEN\n" + go(1) + "ELSE\n" + go(2) + "ENDIF\n", data)) ==
        Angles{1});
  // whole numbers above 2^24 stay exact
  CHECK(first_axes(run("x:=16777217;\nIF x-1=16777216 THEN\n" + go(1) + "ELSE\n" + go(2) + "ENDIF\n", data)) ==
        Angles{1});
}

TEST_CASE("rapid controller: a displacement by a quaternion that is not of length 1 is refused") {
  const auto moved = [](const std::string& displacement) {
    return run(displacement + "\nMoveL p,v100,fine,tool0;\n", pose +
                                                                  "CONST pose half:=[[0,0,100],[0.5,0.5,0,0]];\n"
                                                                  "CONST pose none:=[[0,0,100],[0,0,0,0]];\n");
  };
  const std::string reached = "[[0,0,0],{},[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]";
  for (const std::string& half :
       {std::string("PDispSet half;"),
        "PDispOn\\Rot\\ExeP:=" + fmt::format(fmt::runtime(reached), "[0.5,0.5,0,0]") + ",p,tool0;"})
    CHECK_THAT(moved(half).problem(), Catch::Contains("has the length 0.70711 (must be 1)") &&
                                          Catch::Contains("write [0.707107,0.707107,0.000000,0.000000]"));
  for (const std::string& none : {std::string("PDispSet none;"),
                                  "PDispOn\\ExeP:=" + fmt::format(fmt::runtime(reached), "[0,0,0,0]") + ",p,tool0;"})
    CHECK_THAT(moved(none).problem(),
               Catch::Contains("with the quaternion [0,0,0,0]") && Catch::Contains("give its orientation"));
  CHECK(moved("PDispSet [[0,0,100],[1,0,0,0]];").problem() == "no such problem");
}

TEST_CASE("rapid controller: tool and work object that are both held, or both stand, are a warning") {
  const std::string data = pose +
                           "PERS tooldata held:=[TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];\n"
                           "PERS tooldata stands:=[FALSE,[[900,0,900],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];\n"
                           "PERS wobjdata table:=[FALSE,TRUE,\"\",[[1,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];\n"
                           "PERS wobjdata part:=[TRUE,TRUE,\"\",[[1,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];\n";
  const auto warned = [&](const std::string& frames, const char* words) {
    const Reading reading = run("MoveL p,v100,fine," + frames + ";\n", data);
    CHECK(reading.problem() == "no such problem");
    return skips(reading, words, true);
  };
  CHECK(warned("held\\WObj:=part", two_robholds));
  CHECK(warned("stands\\WObj:=table", no_robhold));
  CHECK(warned("stands", no_robhold));
  for (const char* fits : {"held", "held\\WObj:=table", "stands\\WObj:=part"}) {
    CHECK_FALSE(warned(fits, two_robholds));
    CHECK_FALSE(warned(fits, no_robhold));
  }
  const Reading both = run("MoveL p,v100,fine,held\\WObj:=part;\n", data);
  CHECK_THAT(moves_left_out(both.program).at(0).line(), Catch::Contains("Remedy: robhold FALSE in the work object"));
}

TEST_CASE("rapid controller: switches and arguments that an instruction does not have are a warning") {
  const std::string data = pose +
                           "PERS wobjdata wo:=[FALSE,TRUE,\"\",[[1,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];\n"
                           "VAR robtarget q;\nVAR pose d;\n";
  const auto warnings = [&](const std::string& body) {
    const Reading reading = run(body + "\nMoveL p,v100,fine,tool0;\n", data);
    CHECK(reading.problem() == "no such problem");
    std::string lines;
    for (const pipeline::Warning& warning : moves_left_out(reading.program)) lines += warning.line() + "\n";
    return lines;
  };
  for (const auto& [body, word] : std::map<std::string, std::string>{
           {"MoveL p,v100,fine,tool0\\WObjj:=wo;", "write \\WObj if this is meant"},
           {"MoveL p,v100,fine,tool0,wo;", "wo: not read, because there is no such word in MoveL after its argument 4"},
           {"MoveL p,v100\\Tt:=3,fine,tool0;", "write \\T if this is meant"},
           {"MoveL RelTool(p,1,2,3\\Rxx:=5),v100,fine,tool0;", "write \\Rx if this is meant"},
           {"MoveL Offs(p,1,2,3,4),v100,fine,tool0;", "4: not read, because there is no such word in Offs"},
           {"PDispOn\\Rott\\ExeP:=p,p,tool0;", "write \\Rot if this is meant"},
           {"MoveL p,v100,fine,tool0;\nq:=CRobT(\\Tol:=tool0);", "write \\Tool if this is meant"},
           {"WaitTime\\Foo,3;", "\\foo: not read, because there is no such word in WaitTime"},
           {"MoveL p,v100,fine,tool0\\Corr;", "\\Corr: path corrections"}}) {
    INFO(body);
    CHECK_THAT(warnings(body), Catch::Contains(word));
  }
  for (const char* legal :
       {"MoveL\\Conc,p,v100\\V:=50,z10\\Z:=5\\Inpos:=inpos50,tool0\\WObj:=wo\\TLoad:=load0;",
        "MoveJ\\Conc,p,v100\\T:=3,z10,tool0\\WObj:=wo;", "MoveC p,Offs(p,1,1,1),v100,z10,tool0\\WObj:=wo;",
        "MoveAbsJ [[1,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]]\\NoEOffs,v100,fine,tool0\\WObj:=wo;",
        "TriggL p,v100,t1\\T2:=t2\\T3:=t3,z10,tool0\\WObj:=wo;", "MoveLDO p,v100,z10,tool0\\WObj:=wo,do1,1;",
        "MoveLSync p,v100,z10,tool0\\WObj:=wo,\"sync\";", "MoveLGO p,v100,z10,tool0,go1\\Value:=3;",
        "WaitTime\\InPos,3;", "AccSet 50,50\\FinePointRamp:=50;", "PDispOn\\Rot\\ExeP:=p,p,tool0\\WObj:=wo;",
        "ConfL\\Off;", "MoveL RelTool(p,1,2,3\\Rx:=5\\Ry:=5\\Rz:=5),v100,fine,tool0;"}) {
    INFO(legal);
    CHECK(warnings(legal) == "");
  }
}

TEST_CASE("rapid controller: a shift by a text is named as the fault") {
  const Reading reading = run("by \"x\";\n", pose + "PROC by(num n)\nMoveL Offs(p,n,0,0),v100,fine,tool0;\nENDPROC\n");
  CHECK_THAT(reading.problem(), Catch::Contains("gives offs no number as its argument 2"));
}
