#include <catch2/catch.hpp>
#include <numbers>
#include <random>

#include "pipeline/job.h"
#include "tests/program/fuzz_target.h"
#include "tests/program/reading.h"

using namespace dresslife;
using namespace dresslife::sim;
using dresslife::tests::Reader;
using dresslife::tests::Reading;

namespace {

constexpr double rounding = 1e-12;  // of a few products of numbers near 1

/// One program per language, with most of what its reader knows.
const std::vector<std::pair<Language, std::string>>& samples() {
  static const std::vector<std::pair<Language, std::string>> list{
      {Language::rapid,
       "MODULE M\nRECORD r num a; pos b; ENDRECORD\nPERS tooldata "
       "t:=[TRUE,[[0,0,1],[1,0,0,0]],[1,[0,0,0],[1,0,0,0],0,0,0]];\nCONST robtarget "
       "p:=[[1,2,3],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\nVAR num a{3}:=[1,2,3];\nPROC "
       "main()\nFOR i FROM 1 TO 3 DO\nMoveL "
       "Offs(p,a{i},0,-i)\\T:=2,v100,z10,t\\WObj:=wobj0;\nENDFOR\nIF di1=1 THEN\nMoveJ "
       "p,v5,fine,tool0;\nELSEIF FALSE THEN\nsub 1\\x:=2;\nENDIF\nTEST "
       "a{1}\nCASE 1,2:\nWaitTime 1;\nDEFAULT:\nExit;\nENDTEST\nMoveC "
       "p,RelTool(p,1,2,3\\Rx:=4),v50,z1,tool0;\nENDPROC\nPROC sub(num y\\num "
       "x)\na{2}:=a{2}+y DIV 2;\nWHILE a{2}<9 DO\na{2}:=a{2}*2;\nENDWHILE\nENDPROC\nFUNC num f(num "
       "z)\nRETURN -z;\nENDFUNC\nENDMODULE\n"},
      {Language::krl,
       "&ACCESS RVP\nDEF m()\nDECL E6POS P[2]\nINT i\nP[1]={X 1,Y 2,Z 3,A 0,B 0,C 0,S 2,T "
       "35}\n$VEL.CP=0.5\nBAS(#VEL_PTP,50)\nPTP P[1] C_PTP\nFOR i=1 TO 3 STEP "
       "1\nLIN {X i} C_DIS\nENDFOR\nCIRC {X 1,Y 2,Z 4},P[1]\nSPLINE WITH $VEL.CP=1\nSPL P[1]\nENDSPLINE\nIF "
       "$IN[1]==TRUE THEN\nPTP XHOME\nELSE\nHALT\nENDIF\nWAIT SEC 1\nSWITCH i\nCASE "
       "1,2\nf(i)\nDEFAULT\nENDSWITCH\nLOOP\nEXIT\nENDLOOP\n$BASE={X 1,Y 0,Z 0,A 0,B 0,C 0}:{X 0,Y 1,Z 0,A "
       "9,B 8,C 7}\nEND\nDEF f(x:IN)\nREPEAT\nx=x+1\nUNTIL x>4\nEND\n"},
      {Language::fanuc,
       "/PROG M\n/MN\n 1:J P[1] 100% CNT100 ;\n 2: R[1]=1+2*3 ;\n 3: FOR R[2]=1 TO 3 ;\n 4:L P[2] R[1]mm/sec "
       "FINE Offset,PR[1] ;\n 5: ENDFOR ;\n 6: IF (R[1]>3 AND !DI[1]=ON) THEN "
       ";\n 7: WAIT 1.0(sec) ;\n 8: ELSE ;\n 9: ENDIF ;\n10: SELECT R[1]=1,JMP LBL[1] ;\n11: ELSE,CALL M "
       ";\n12: LBL[1:x] ;\n13:C P[2]\n   : P[2] 10cm/min CNT50 ;\n14: PR[1,3]=5 ;\n15: JMP "
       "LBL[1] ;\n/POS\nP[1]{\n GP1:\n UF : 0, UT : 0,\n J1= 1 deg, J2= 2 deg, J3= 3 deg, J4= 4 deg, J5= 5 "
       "deg, J6= 6 deg\n};\nP[2]{\n GP1:\n UF : 0, UT : 0, CONFIG : 'N U T, 0, 0, 0',\n X = 1 mm, "
       "Y = 2 mm, Z = 3 mm,\n W = 4 deg, P = 5 deg, R = 6 deg\n};\n/END\n"},
      {Language::joint_columns, "time, axis 1, axis 2\n0, 1, 2\n0.5, 1.5, 2.5\n# note\n1, 2, 3\n"},
      {Language::ros_trajectory,
       R"({"joint_names": ["a", "b"], "points": [{"positions": [0, 1], "time_from_start": {"sec": 0, "nanosec": 0}}, {"positions": [0.5, 1], "time_from_start": 1.5}]})"}};
  return list;
}

std::string mutated(const std::string& seed, std::mt19937& random) {
  std::string text = seed;
  const auto below = [&](std::size_t n) {
    return static_cast<std::size_t>(random() % std::max<std::size_t>(n, 1));
  };
  for (int k = static_cast<int>(below(6)) + 1; k-- > 0 && !text.empty();) {
    const std::size_t at = below(text.size()),
                      length = below(std::min<std::size_t>(40, text.size() - at)) + 1;
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

TEST_CASE("import: joint columns and ROS trajectories") {
  const Reading columns = Reader{Language::joint_columns}({{"j.csv", samples()[3].second}});
  REQUIRE(columns.problems.empty());
  REQUIRE(columns.program.instructions.size() == 3);
  CHECK(columns.move(1).target.joints[0] == Approx(1.5 * std::numbers::pi / 180).epsilon(rounding));
  CHECK(columns.move(1).speed.duration.value() == 0.5);
  CHECK(columns.move(2).where.line == 5);
  const Reading ros = Reader{Language::ros_trajectory}({{"j.json", samples()[4].second}});
  REQUIRE(ros.problems.empty());
  REQUIRE(ros.program.instructions.size() == 2);
  CHECK(ros.move(1).target.joints[0] == 0.5);
  CHECK(ros.move(1).speed.duration.value() == 1.5);
  const Reading bad = Reader{Language::joint_columns}({{"j.csv", "t, a\n0, 1\n0, 2\n1, x\n1, 2, 3\n"}});
  REQUIRE(bad.problems.size() == 3);
  CHECK(bad.problem(0) ==
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
  CHECK(pipeline::motion_text(again) == text);
}

TEST_CASE("import: all problems come in one message, in the order of the lines") {
  Problems problems;
  problems.add({"a.mod", 9, 1}, "second", "mend");
  problems.add({"a.mod", 2, 1}, "first", "mend");
  problems.add({"a.mod", 9, 1}, "second", "mend");
  CHECK_THROWS_WITH(problems.throw_if_any(), "a.mod:2:1: error: first; mend\na.mod:9:1: error: second; mend");
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
      const std::string fault = tests::fault_of_reading(language, text);
      INFO(text);
      REQUIRE(fault == "");
      Reader reader{language};
      refused += !reader({{"p", text}}).problems.empty();
      ++runs;
    }
  CHECK(refused > runs / 4);  // the mutations do hurt
  CHECK(refused < runs);
}

TEST_CASE("import: the example programs read without a problem") {
  const std::string folder = std::string(DRESSLIFE_SOURCE_DIR) + "/config/programs/";
  // Home twice, two approaches, sixteen spots with their welds, two ways out; start, four times eight, end;
  // start, twice four, a wait, end.
  const std::pair<const char*, std::size_t> examples[] = {
      {"side_panel.mod", 38}, {"pick_and_place.src", 34}, {"frame_weld.ls", 11}};
  for (const auto& [name, count] : examples) {
    pipeline::Motion motion;
    motion.program = folder + name;
    CHECK(read_program(motion).instructions.size() == count);
  }
}
