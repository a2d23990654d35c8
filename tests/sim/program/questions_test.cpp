// Questions of a program: all are asked in one round, with unique names, in a file that the user can fill in.
#include "sim/program/answers.h"

#include <utility>

#include "tests/catch.h"
#include "tests/pipeline/scratch.h"
#include "tests/sim/program/reading.h"

using namespace dresslife;
using namespace dresslife::sim;
using namespace dresslife::tests;

namespace {

/// Returns all questions of a reading as "kind name".
std::set<std::string> questions(const Reading& reading) {
  std::set<std::string> names;
  for (const Problem& problem : reading.problems)
    for (const Question& question : problem.questions)
      names.insert((question.kind == Question::Kind::branch  ? "branch "
                    : question.kind == Question::Kind::value ? "value "
                                                             : "frame ") +
                   question.name);
  return names;
}

/// Answers all questions in `reader`. The bits of `pick` choose then or else, TRUE or FALSE, ON or OFF, 1 or 2.
void answer(const Reading& reading, unsigned pick, Reader& reader) {
  std::set<std::string> done;
  for (const Problem& problem : reading.problems)
    for (const Question& question : problem.questions) {
      if (!done.insert(question.name).second) continue;
      const bool first = pick & 1u;
      pick = pick >> 1u | (pick & 1u) << 15u;
      const std::string& form = question.form;
      const auto has = [&](const char* words) { return form.find(words) != std::string::npos; };
      if (question.kind == Question::Kind::branch)
        reader.options.assume[question.name] = first ? Assumption::then_branch : Assumption::else_branch;
      else if (question.kind == Question::Kind::tool)
        reader.tools.push_back({question.name, {{0, 0, 0.1}, Quaternion::Identity()}, false});
      else if (question.kind == Question::Kind::work_object)
        reader.work_objects.push_back({question.name, {{1, 0, 0}, Quaternion::Identity()}, false});
      else
        reader.options.values[question.name] = has("TRUE or FALSE") ? first ? "TRUE" : "FALSE"
                                               : has("ON or OFF")   ? first ? "ON" : "OFF"
                                               : has("[cf1")
                                                   ? "[[600,0,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"
                                               : has("[[a1")      ? "[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"
                                               : has("{X ..")     ? "{X 900,Y 0,Z 900,A 0,B 90,C 0}"
                                               : has("{A1 ..")    ? "{A1 0,A2 -90,A3 90,A4 0,A5 30,A6 0}"
                                               : has("X .. Y ..") ? "X 600 Y 0 Z 500 W 180 P 0 R 0"
                                               : has("nothing")   ? "nothing"
                                               : first            ? "1"
                                                                  : "2";
    }
}

/// Returns a question of the second round for any of 1024 sets of answers; empty: one round is always enough.
std::string second_round(Language language, const Files& files) {
  const Reading asked = Reader{language}(files);
  if (questions(asked).empty()) return "nothing is asked at all";
  for (unsigned pick = 0; pick < 1u << 10u; ++pick) {
    Reader reader{language};
    answer(asked, pick, reader);
    const Reading again = reader(files);
    for (const std::string& question : questions(again))
      if (!questions(asked).contains(question)) return question;
    if (!questions(again).empty()) return "the same again: " + *questions(again).begin();
  }
  return "";
}

const std::string axes = "[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]]";

/// Returns a Fanuc listing of these statements, with four positions in user frame 0 and tool 0.
std::string listing(const std::string& name, const std::vector<std::string>& statements) {
  std::string text = "/PROG " + name + "\n/MN\n";
  for (std::size_t i = 0; i < statements.size(); ++i) text += fmt::format("{}: {} ;\n", i + 1, statements[i]);
  text += "/POS\n";
  for (int p = 1; p <= 4; ++p)
    text += fmt::format(
        "P[{}]{{\n GP1:\n UF : 0, UT : 0, CONFIG : 'N U T, 0, 0, 0',\n X = {} mm, Y = 0 mm, Z = 500 mm,\n W = 180 deg, P = 0 "
        "deg, R = 0 deg\n}};\n",
        p, 600 + 10 * p);
  return text + "/END\n";
}

}  // namespace

TEST_CASE("questions: one round of answers is enough for RAPID, whatever the answers are") {
  // Branches in branches, after an exit, in a choice and in a routine; a count set in a branch without moves; data, a tool
  // and a work object that no file contains.
  const std::string text =
      "MODULE m\nCONST jointtarget j:=" + axes +
      ";\nVAR num k;\nPROC main()\nIF di1=1 THEN\nk:=gi1;\nENDIF\nFOR i FROM 1 TO k DO\nMoveAbsJ j,v100,fine,tool0;\nENDFOR\n"
      "IF di2=1 THEN\nIF di3=1 AND di4=0 THEN\nMoveJ home,v100,fine,gun;\nELSE\nMoveAbsJ j,v100,fine,tool0;\nEXIT;\nENDIF\n"
      "ELSE\nsub;\nENDIF\nTEST style\nCASE 1:\nMoveL home,v100,fine,tool0\\WObj:=table;\nCASE 2:\nMoveJ "
      "park,v100,fine,tool0;\nENDTEST\nENDPROC\nPROC sub()\nWHILE di5=0 DO\nMoveJ away,v100,z10,tool0;\nENDWHILE\nWaitTime "
      "pause;\nENDPROC\nENDMODULE\n";
  const Reading asked = Reader{Language::rapid}({{"m.mod", text}});
  CHECK(questions(asked) == std::set<std::string>{"value di1", "value gi1", "value di2", "branch m.mod:12",
                                                  "value home", "frame gun", "value style", "frame table", "value park",
                                                  "branch m.mod:29", "value away", "value pause"});
  CHECK(second_round(Language::rapid, {{"m.mod", text}}) == "");
}

TEST_CASE("questions: one round of answers is enough for a machine of states") {
  // Each state has its own question and runs only after the previous state.
  const std::string states =
      "MODULE m\nCONST jointtarget j:=" + axes +
      ";\nVAR num state:=1;\nPROC main()\nWHILE TRUE DO\nTEST state\nCASE 1:\nIF di1=1 THEN\nMoveAbsJ "
      "j,v100,fine,tool0;\nENDIF\nstate:=2;\nCASE 2:\nMoveJ first,v100,fine,tool0;\nstate:=3;\nCASE 3:\nMoveJ "
      "second,v100,fine,tool0;\nstate:=1;\nENDTEST\nENDWHILE\nENDPROC\nENDMODULE\n";
  CHECK(questions(Reader{Language::rapid}({{"m.mod", states}})) ==
        std::set<std::string>{"value di1", "value first", "value second"});
  CHECK(second_round(Language::rapid, {{"m.mod", states}}) == "");
}

TEST_CASE("questions: one round of answers is enough where ways must come together") {
  // The value that an arm without moves sets is used in only one arm of a later branch.
  const std::string together =
      "MODULE m\nCONST jointtarget j:=" + axes +
      ";\nVAR num k;\nPROC main()\nIF di1=1 THEN\nk:=gi1;\nENDIF\nIF di2=1 THEN\nMoveAbsJ j,v100,fine,tool0;\nRETURN;\nENDIF\n"
      "IF k=0 MoveAbsJ j,v200,fine,tool0;\nMoveAbsJ j,v300,fine,tool0;\nENDPROC\nENDMODULE\n";
  CHECK(questions(Reader{Language::rapid}({{"m.mod", together}})) ==
        std::set<std::string>{"value di1", "value di2", "value gi1"});
  CHECK(second_round(Language::rapid, {{"m.mod", together}}) == "");
  // The cycle restarts unless all of eight inputs are ON: 1 of 256 random ways leads to the last question.
  std::string lines = "*START\nMOVJ C00000 VJ=10.00\n";
  std::set<std::string> wanted{"value IN#(9)"};
  for (int i = 1; i <= 8; ++i) {
    lines += fmt::format("JUMP *START IF IN#({})=OFF\n", i);
    wanted.insert(fmt::format("value IN#({})", i));
  }
  lines += "JUMP *START IF IN#(9)=OFF\nMOVJ C00000 VJ=20.00\n";
  const std::string work =
      "/JOB\n//NAME A\n//POS\n///NPOS 1,0,0,0,0,0\n///TOOL 0\n///POSTYPE ANGLE\n///ANGLE\n"
      "C00000=10,0,0,0,-90,0\n//INST\n///ATTR SC,RW\n///GROUP1 RB1\nNOP\n" +
      lines + "END\n";
  CHECK(questions(Reader{Language::inform}({{"A.JBI", work}})) == wanted);
}

TEST_CASE("questions: one round of answers is enough for KRL, whatever the answers are") {
  const std::string text =
      "DEF m()\nDECL INT n\nn=0\nIF $IN[1] THEN\nn=count\nENDIF\nFOR i=1 TO n\nPTP {A1 0,A2 -90,A3 90,A4 0,A5 0,A6 "
      "0}\nENDFOR\nSWITCH style\nCASE 1\n$TOOL=TOOL_DATA[1]\n$BASE=BASE_DATA[2]\nLIN xp1\nCASE 2\nsub()\nENDSWITCH\nWHILE "
      "$IN[2]\nPTP xp2\nENDWHILE\nLIN {Z 500}\nEND\nDEF sub()\nREPEAT\nPTP xp3\nUNTIL $IN[3]\nPTP {A1 5}\nEND\n";
  CHECK(second_round(Language::krl, {{"m.src", text}}) == "");
}

TEST_CASE("questions: one round of answers is enough for Fanuc, whatever the answers are") {
  const std::string text =
      listing("M", {"LBL[1]", "IF DI[1]=ON,JMP LBL[2]", "J P[1] 50% FINE", "IF DI[2]=ON THEN", "R[1]=GI[1]", "ENDIF",
                    "FOR R[2]=1 TO R[1]", "L P[2] 100mm/sec FINE", "ENDFOR", "LBL[2]", "SELECT R[5]=1,CALL PART",
                    "=2,JMP LBL[3]", "ELSE,JMP LBL[1]", "LBL[3]", "PR[1,3]=GI[2]",
                    "L P[3] R[7]mm/sec FINE Offset,PR[1]", "J PR[3] 20% FINE"});
  const std::string part =
      listing("PART", {"CALL GRIP", "IF R[9]=1,JMP LBL[1]", "J P[1] 50% FINE", "LBL[1]", "J P[4] 20% FINE"});
  CHECK(second_round(Language::fanuc, {{"m.ls", text}, {"part.ls", part}}) == "");
}

TEST_CASE("questions: a mistake behind a guess counts only where the program gets there") {
  const std::string text = "MODULE m\nCONST jointtarget j:=" + axes +
                           ";\nVAR num a{5};\nVAR num k:=0;\nPROC main()\nIF di1=1 THEN\na{k}:=1;\nMoveAbsJ "
                           "j,v100,fine,tool0;\nENDIF\nMoveAbsJ j,v200,fine,tool0;\nENDPROC\nENDMODULE\n";
  CHECK(questions(Reader{Language::rapid}({{"m.mod", text}})) == std::set<std::string>{"value di1"});
  CHECK(Reader{Language::rapid}({{"m.mod", text}}).problems.size() == 1);
  Reader no{Language::rapid}, yes{Language::rapid};
  no.options.values["di1"] = "0";
  yes.options.values["di1"] = "1";
  CHECK(no({{"m.mod", text}}).problems.empty());
  CHECK_THAT(yes({{"m.mod", text}}).problem(), Catch::Contains("m.mod:7") && Catch::Contains("index 0 of a list of 5"));
  // In a branch without moves the error does not occur, because the branch is left out.
  const std::string still = "MODULE m\nCONST jointtarget j:=" + axes +
                            ";\nVAR num a{5};\nVAR num k:=0;\nPROC main()\nIF di1=1 THEN\na{k}:=1;\nENDIF\nMoveAbsJ "
                            "j,v200,fine,tool0;\nENDPROC\nENDMODULE\n";
  CHECK(Reader{Language::rapid}({{"m.mod", still}}).problems.empty());
}

TEST_CASE("questions: all that one value depends on is asked for together") {
  const std::string text = "MODULE m\nCONST jointtarget j:=" + axes +
                           ";\nVAR num n;\nPROC main()\nn:=gi1+2*gi2-gi3;\nWaitTime n;\nMoveAbsJ "
                           "j,v100,fine,tool0;\nENDPROC\nENDMODULE\n";
  CHECK(questions(Reader{Language::rapid}({{"m.mod", text}})) ==
        std::set<std::string>{"value gi1", "value gi2", "value gi3"});
}

TEST_CASE("questions: an answer's form is that of what is asked for, not of what is computed from it") {
  const auto form = [](const std::string& target) {
    const Reading asked = Reader{Language::rapid}(
        {{"m.mod",
          "MODULE m\nCONST robtarget p:=[[10,20,30],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\nPROC main()\nMoveL " +
              target + ",v100,fine,tool0;\nENDPROC\nENDMODULE\n"}});
    return asked.problems.empty() || asked.problems[0].questions.empty() ? "nothing is asked"
                                                                         : asked.problems[0].questions[0].form;
  };
  CHECK(form("Offs(p,0,0,10*GInput(gi1))") == "a number");
  CHECK(form("home").starts_with("[[x, y, z], [q1"));
}

TEST_CASE("questions: what decides a branch is asked for in its own form") {
  const auto form = [](const std::string& lines) {
    const Reading asked =
        Reader{Language::rapid}({{"m.mod", "MODULE m\nPROC main()\nMoveAbsJ " + axes + ",v50,fine,tool0;\n" + lines +
                                               "MoveAbsJ " + axes + ",v100,fine,tool0;\nENDIF\nENDPROC\nENDMODULE\n"}});
    return asked.problems.empty() || asked.problems[0].questions.empty() ? "nothing is asked"
                                                                         : asked.problems[0].questions[0].form;
  };
  CHECK(form("IF is_clear() THEN\n") == "TRUE or FALSE");
  CHECK(form("IF NOT is_clear() THEN\n") == "TRUE or FALSE");
  CHECK(form("IF parts()>2 THEN\n") == "a number");
  // Constants of dialogs belong to the language: the question is the dialog itself.
  const Reading dialog = Reader{Language::rapid}(
      {{"m.mod",
        "MODULE m\nPROC main()\nTEST UIMessageBox(\\Buttons:=btnOKCancel\\Icon:=iconInfo)\nCASE resOK:\nMoveAbsJ " +
            axes + ",v100,fine,tool0;\nCASE resCancel:\nMoveAbsJ " + axes +
            ",v50,fine,tool0;\nENDTEST\nENDPROC\nENDMODULE\n"}});
  CHECK(questions(dialog) == std::set<std::string>{"value uimessagebox"});
  REQUIRE(dialog.problems.size() == 1);
  CHECK(dialog.problems[0].questions[0].form == "one of resOK, resCancel");
}

TEST_CASE("questions: data of inline forms are asked for as wholes, in their forms") {
  const std::string spline =
      "SPTP XPICK WITH $VEL_AXIS[1]=SVEL_JOINT(100.0),$TOOL=STOOL2(FPICK),$BASE=SBASE(FPICK.BASE_NO),$IPO_MODE=SIPO_MODE("
      "FPICK.IPO_FRAME),$ACC_AXIS[1]=SACC_JOINT(PPDAT1),$APO=SAPO_PTP(PPDAT1)\nSLIN XPICK WITH "
      "$VEL=SVEL_CP(0.5,,LCPDAT1),$TOOL=STOOL2(FPICK),$BASE=SBASE(FPICK.BASE_NO),$ACC=SACC_CP(LCPDAT1),$APO=SAPO(LCPDAT1) C_Spl\n";
  const std::string classic =
      "FDAT_ACT=FPICK\nPDAT_ACT=PPDAT1\nBAS(#PTP_PARAMS,60)\nPTP XPICK C_PTP\nLDAT_ACT=LCPDAT1\nBAS(#CP_PARAMS,0.5)\nLIN XPICK "
      "C_DIS\n";
  for (const std::string& lines : {spline, classic}) {
    const Files files = {{"m.src", "DEF m()\n" + lines + "END\n"}};
    const Reading asked = Reader{Language::krl}(files);
    std::map<std::string, Question> by_name;
    for (const Problem& problem : asked.problems)
      for (const Question& question : problem.questions) by_name[question.name] = question;
    INFO(lines);
    CHECK(questions(asked) ==
          std::set<std::string>{"value m:fpick", "value m:ppdat1", "value m:lcpdat1", "value m:xpick"});
    CHECK(by_name["m:fpick"].form == "{TOOL_NO .., BASE_NO .., IPO_FRAME #BASE}");
    CHECK(by_name["m:fpick"].preset.empty());  // no default, because the tool is unknown
    CHECK(by_name["m:ppdat1"].form.starts_with("{VEL .., ACC .., APO_DIST .."));
    CHECK(by_name["m:ppdat1"].preset == "{VEL 100, ACC 100, APO_DIST 100}");
    CHECK(by_name["m:lcpdat1"].preset == "{VEL 2, ACC 100, APO_DIST 100}");
    Reader reader{Language::krl};
    reader.options.values = {{"m:fpick", "{TOOL_NO 0, BASE_NO 0, IPO_FRAME #BASE}"},
                             {"m:xpick", "{X 900, Y 0, Z 900, A 0, B 90, C 0}"}};
    for (const char* name : {"m:ppdat1", "m:lcpdat1"}) reader.options.values[name] = by_name[name].preset;
    const Reading read = reader(files);
    REQUIRE(read.problem() == "no such problem");
    CHECK(read.program.instructions.size() == 2);
    CHECK(read.move(1).zone.distance == Approx(0.1));
  }
}

TEST_CASE("questions: names are unique by module and by routine") {
  const Files krl = {{"m.src", "DEF m()\na()\nb()\nEND\n"},
                     {"a.src", "DEF a()\nPTP xp1\nEND\n"},
                     {"b.src", "DEF b()\nPTP xp1\nEND\n"},
                     dresslife::tests::held_frames};
  CHECK(questions(Reader{Language::krl}(krl)) == std::set<std::string>{"value a:xp1", "value b:xp1"});
  Reader own{Language::krl};
  own.options.values = {{"a:xp1", "{A1 1,A2 0,A3 0,A4 0,A5 0,A6 0}"}, {"b:xp1", "{A1 2,A2 0,A3 0,A4 0,A5 0,A6 0}"}};
  const Reading read = own(krl);
  REQUIRE(read.problem() == "no such problem");
  CHECK(read.move(0).target.joints[0] * 2 == Approx(read.move(1).target.joints[0]));
  Reader shared{Language::krl};
  shared.options.values = {{"xp1", "{A1 1,A2 0,A3 0,A4 0,A5 0,A6 0}"}};
  CHECK(questions(shared(krl)) == std::set<std::string>{"value a:xp1", "value b:xp1"});
  // Local variables of two routines and LOCAL data of two modules with the same name.
  const Files rapid = {
      {"a.mod",
       "MODULE a\nLOCAL VAR num t;\nPROC main()\nVAR num n;\nTPReadNum n,\"\";\nTPReadNum t,\"\";\nWaitTime n+t;\nMoveAbsJ " +
           axes + ",v100,fine,tool0;\nother;\nENDPROC\nENDMODULE\n"},
      {"b.mod",
       "MODULE b\nLOCAL VAR num t;\nPROC other()\nVAR num n;\nTPReadNum n,\"\";\nTPReadNum t,\"\";\nWaitTime n+t;\nENDPROC\nENDMODULE\n"}};
  CHECK(questions(Reader{Language::rapid}(rapid)) ==
        std::set<std::string>{"value main:n", "value other:n", "value a:t", "value b:t"});
  Reader times{Language::rapid};
  times.options.values = {{"main:n", "1"}, {"other:n", "20"}, {"a:t", "300"}, {"b:t", "4000"}};
  const Reading waits = times(rapid);
  REQUIRE(waits.problem() == "no such problem");
  CHECK(waits.move(0).dwell == 301);
  CHECK(waits.move(2).dwell == 4020);
}

TEST_CASE("questions: where the robot stands is asked for line by line") {
  const std::string text =
      "MODULE m\nVAR jointtarget j;\nPROC main()\nj:=CJointT();\nMoveAbsJ j,v100,fine,tool0;\nMoveJ "
      "[[600,0,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\nj:=CJointT();\nMoveAbsJ "
      "j,v100,fine,tool0;\nENDPROC\nENDMODULE\n";
  CHECK(questions(Reader{Language::rapid}({{"m.mod", text}})) ==
        std::set<std::string>{"value m.mod:4:cjointt", "value m.mod:7:cjointt"});
  Reader reader{Language::rapid};
  reader.options.values = {{"m.mod:4:cjointt", "[[1,0,0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"},
                           {"m.mod:7:cjointt", "[[2,0,0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"}};
  const Reading read = reader({{"m.mod", text}});
  REQUIRE(read.problem() == "no such problem");
  CHECK(read.move(2).target.joints[0] == Approx(2 * read.move(0).target.joints[0]));
}

TEST_CASE("questions: a Fanuc CALL of a program in no file is asked for by its name") {
  const Files files = {{"m.ls", listing("M", {"R[30]=0", "LBL[1]", "J P[1] 50% FINE", "J P[2] 50% FINE", "CALL NAILER",
                                              "R[30]=R[30]+1", "IF R[30]<4,JMP LBL[1]"})}};
  CHECK(questions(Reader{Language::fanuc}(files)) == std::set<std::string>{"value CALL NAILER"});
  // The user's value of a register does not replace a value that the program has set.
  Reader by_register{Language::fanuc};
  by_register.options.values["R[30]"] = "3";
  CHECK(questions(by_register(files)) == std::set<std::string>{"value CALL NAILER"});
  const std::pair<const char*, std::size_t> effects[] = {{"nothing", 8}, {"R[30]=3", 2}};
  for (const auto& [effect, moves] : effects) {
    Reader reader{Language::fanuc};
    reader.options.values["CALL NAILER"] = effect;
    INFO(effect);
    CHECK(reader(files).program.instructions.size() == moves);
  }
  // If the program did not set the register, the called program may have set it: the user's value is used.
  const Files answer = {{"m.ls", listing("M", {"CALL ASK", "FOR R[1]=1 TO R[5]", "J P[1] 50% FINE", "ENDFOR"})}};
  Reader reader{Language::fanuc};
  reader.options.values["R[5]"] = "3";
  CHECK(reader(answer).program.instructions.size() == 3);
}

TEST_CASE("questions: Fanuc SkipJump goes to its label when the condition comes, Skip when it does not") {
  for (const bool jumps : {true, false}) {
    const Files files = {
        {"m.ls", listing("M", {"SKIP CONDITION RI[1]=ON",
                               std::string("L P[1] 100mm/sec FINE ") + (jumps ? "SkipJump" : "Skip") + ",LBL[1]",
                               "J P[2] 50% FINE", "ABORT", "LBL[1]", "L P[3] 100mm/sec FINE"})}};
    const auto second_target = [&](const char* comes) {
      Reader reader{Language::fanuc};
      reader.options.values["RI[1]"] = comes;
      const Reading read = reader(files);
      REQUIRE(read.problem() == "no such problem");
      return std::lround(read.move(1).target.pose.position.x() * 1e3);
    };
    CHECK(second_target("ON") == (jumps ? 630 : 620));
    CHECK(second_target("OFF") == (jumps ? 620 : 630));
    const Reading unanswered = Reader{Language::fanuc}(files);
    if (jumps) CHECK(questions(unanswered) == std::set<std::string>{"value RI[1]"});
    if (!jumps) CHECK(unanswered.program.instructions.size() == 2);  // with a warning
  }
}

TEST_CASE("questions: a component of a Fanuc position register is asked for by what it was computed from") {
  const Files files = {{"m.ls", listing("M", {"PR[1,3]=GI[6]*2", "L P[1] 100mm/sec FINE Offset,PR[1]"})}};
  CHECK(questions(Reader{Language::fanuc}(files)) == std::set<std::string>{"value GI[6]", "value PR[1]"});
  Reader reader{Language::fanuc};
  reader.options.values = {{"GI[6]", "25"}, {"PR[1]", "X 1 Y 2 Z 999 W 0 P 0 R 0"}};
  const Reading read = reader(files);
  REQUIRE(read.problem() == "no such problem");
  CHECK(read.move(0).target.pose.position.isApprox(Vector3(0.611, 0.002, 0.55), 1e-12));
}

TEST_CASE("questions: what a program writes to a given tool or work object counts as if a file had declared it") {
  const std::string body =
      "CONST robtarget p:=[[10,20,30],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\nPROC main()\nMoveL "
      "p,v100,fine,t\\WObj:=w;\nw.oframe.trans.x:=500;\nMoveL p,v100,fine,t\\WObj:=w;\nt.tframe.trans.z:=333;\nMoveL "
      "p,v100,fine,t\\WObj:=w;\nw.uframe:=[[0,0,999],[1,0,0,0]];\nMoveL p,v100,fine,t\\WObj:=w;\nENDPROC\nENDMODULE\n";
  const Reading declared = Reader{Language::rapid}(
      {{"m.mod",
        "MODULE m\nPERS tooldata t:=[TRUE,[[0,0,111],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];\nPERS wobjdata "
        "w:=[FALSE,TRUE,\"\",[[1000,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];\n" +
            body}});
  const Reading given = Reader{Language::rapid,
                               {},
                               {{"t", {{0, 0, 0.111}, Quaternion::Identity()}, false}},
                               {{"w", {{1, 0, 0}, Quaternion::Identity()}, false}}}({{"m.mod", "MODULE m\n" + body}});
  REQUIRE(declared.problem() == "no such problem");
  REQUIRE(given.problem() == "no such problem");
  for (std::size_t i = 0; i < 4; ++i) {
    const auto frame = [&](const Reading& r, bool tool) {
      const Instruction& move = r.move(i);
      return tool ? r.program.tools[move.tool].frame : r.program.work_objects[move.work_object].frame;
    };
    for (const bool tool : {true, false}) {
      CHECK(frame(given, tool).position.isApprox(frame(declared, tool).position, 1e-12));
      CHECK(frame(given, tool).orientation.isApprox(frame(declared, tool).orientation, 1e-12));
    }
  }
  Reader krl{Language::krl};
  krl.tools = {{"TOOL_DATA[1]", {{0, 0, 0.1}, Quaternion::Identity()}, false}};
  krl.work_objects = {{"BASE_DATA[1]", {{1, 2, 3}, Quaternion::Identity()}, false}};
  const Reading kuka =
      krl({{"k.src",
            "DEF k()\n$VEL.CP=1\nBASE_DATA[1].X=5000\n$TOOL=TOOL_DATA[1]\n$BASE=BASE_DATA[1]\nLIN {X 1,Y 2,Z 3,A "
            "0,B 0,C 0}\nTOOL_DATA[1].Z=777\n$TOOL=TOOL_DATA[1]\nLIN {X 1,Y 2,Z 3,A 0,B 0,C 0}\nEND\n"}});
  REQUIRE(kuka.problem() == "no such problem");
  CHECK(kuka.program.work_objects.at(kuka.move(0).work_object).frame.position.isApprox(Vector3(5, 2, 3), 1e-12));
  CHECK(kuka.program.tools.at(kuka.move(0).tool).frame.position.isApprox(Vector3(0, 0, 0.1), 1e-12));
  CHECK(kuka.program.tools.at(kuka.move(1).tool).frame.position.isApprox(Vector3(0, 0, 0.777), 1e-12));
}

TEST_CASE("questions: a constant that an unknown instruction takes stays what it is") {
  const std::string text =
      "MODULE A\nCONST robtarget p:=[[10,20,30],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\nPROC main()\nUnknown_1D "
      "p;\nMoveJ p,v100,fine,tool0;\nENDPROC\nENDMODULE\n";
  const Reading read = Reader{Language::rapid}({{"A.mod", text}});
  REQUIRE(read.problem() == "no such problem");
  CHECK(read.move(0).target.pose.position.x() == Approx(0.01));
}

TEST_CASE("questions: KUKA's speed along paths and its approximation are given by the names of the messages") {
  const std::string text =
      "DEF m()\n$TOOL={X 0,Y 0,Z 100,A 0,B 0,C 0}\n$BASE=$NULLFRAME\nLIN {X 1500,Y 0,Z 1500,A 0,B 90,C 0} C_DIS\nLIN {X "
      "1500,Y 300,Z 1500,A 0,B 90,C 0}\nEND\n";
  CHECK(questions(Reader{Language::krl}({{"m.src", text}})) == std::set<std::string>{"value $vel.cp"});
  Reader reader{Language::krl};
  reader.options.values["$VEL.CP"] = "0.2";
  const Reading stops = reader({{"m.src", text}});
  REQUIRE(stops.problem() == "no such problem");
  CHECK(stops.move(0).speed.tool == std::optional(0.2));
  CHECK(stops.move(0).zone.distance == 0);
  REQUIRE(stops.program.skipped.size() >= 1);
  CHECK_THAT(stops.program.skipped[0].what, Catch::Contains("motion.values: [{name: $APO.CDIS, value: VALUE}]"));
  reader.options.values["$APO.CDIS"] = "5";
  CHECK(reader({{"m.src", text}}).move(0).zone.distance == Approx(0.005));
}

TEST_CASE("questions: the file of answers can be filled in and is read back as it was filled") {
  const std::string text =
      "MODULE m\nCONST jointtarget j:=" + axes +
      ";\nPROC main()\nIF di1=1 THEN\t!  - {name: 'x', value: '1'}\nMoveAbsJ j,v100,fine,gun;\nENDIF\nWHILE "
      "ui1 DO\nMoveJ home,v100,fine,tool0;\nENDWHILE\nENDPROC\nENDMODULE\n";
  const Reading asked = Reader{Language::rapid}({{"m.mod", text}});
  pipeline::Motion before;
  before.values.push_back({"o'clock", "'12'"});
  std::string file = answers_text(asked.problems, before);
  INFO(file);
  CHECK(question_count(asked.problems) == 4);
  const pipeline::Scratch scratch;
  const auto read_back = [&] {
    pipeline::Motion motion;
    add_answers(scratch.write("answers.yaml", file), motion);
    return motion;
  };
  const auto value_of = [](const pipeline::Motion& motion, const std::string& name) {
    for (const auto& value : motion.values)
      if (value.name == name) return value.value;
    return std::string("none");
  };
  const std::string asked_file = std::exchange(file, file + "routine: other\n");
  CHECK(pipeline::message_of(read_back).find("has 'routine', which is no answer") != std::string::npos);
  file = asked_file;
  const pipeline::Motion empty = read_back();  // an empty answer is no answer
  CHECK(value_of(empty, "di1").empty());
  CHECK(value_of(empty, "o'clock") == "'12'");
  CHECK(empty.tools.empty());
  const auto fill = [&](const std::string& key, const std::string& from, const std::string& to) {
    const std::size_t at = file.find(from, file.find(key));
    REQUIRE(at != std::string::npos);
    file.replace(at, from.size(), to);
  };
  fill("{name: 'di1'", "''}", "'1'}");
  fill("{name: 'home'", "''}", "'[[600,0,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]'}");
  fill("{line: 'm.mod:7'", "''}", "'then'}");
  fill("{name: 'gun'", "[]", "[0, 0, 111]");
  const pipeline::Motion filled = read_back();
  CHECK(value_of(filled, "di1") == "1");
  REQUIRE(filled.assume.size() == 1);
  CHECK(filled.assume[0].line == "m.mod:7");
  REQUIRE(filled.tools.size() == 1);
  CHECK(filled.tools[0].position.z() == Approx(0.111));
}

TEST_CASE("questions: the list is asked for beside its unknown index where nothing of it is known, with its form") {
  Reader reader{Language::rapid};
  const std::string own = "MODULE m\nPERS jointtarget way{2};\nPERS num at;\nVAR num known{2}:=[10,20];\nPROC main()\n",
                    end = "ENDPROC\nENDMODULE\n";
  const Reading list = reader({{"m.mod", own + "MoveAbsJ way{at},v100,fine,tool0;\n" + end}});
  CHECK(questions(list) == std::set<std::string>{"value at", "value way"});
  for (const Problem& problem : list.problems)
    for (const Question& question : problem.questions)
      if (question.name == "way")
        CHECK(question.form == "[.., ..], 2 times [[a1, a2, a3, a4, a5, a6], [9E9, 9E9, 9E9, 9E9, 9E9, 9E9]] in deg");
  const Reading index =
      reader({{"m.mod", own + "MoveAbsJ [[known{at},0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\n" + end}});
  CHECK(questions(index) == std::set<std::string>{"value at"});
  Reader answered = reader;
  answered.options.values = {
      {"at", "2"}, {"way", "[[[1,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],[[2,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]]]"}};
  CHECK(answered({{"m.mod", own + "MoveAbsJ way{at},v100,fine,tool0;\n" + end}}).problem() == "no such problem");
}

TEST_CASE("questions: a position that is not known asks for the tools of the job, too") {
  const std::string job =
      "/JOB\n//NAME A\n//POS\n///NPOS 1,0,0,0,0,0\n///TOOL 3\n///POSTYPE BASE\n///RECTAN\n///RCONF 0,0,0,0,0,0,0,0\n"
      "C00000=1,2,3,0,0,0\n//INST\n///DATE 2020/01/01 00:00\n///ATTR SC,RW\n"
      "///GROUP1 RB1\nNOP\nMOVL P005 V=10.0\nEND\n";
  CHECK(questions(Reader{Language::inform}({{"A.JBI", job}})) == std::set<std::string>{"frame TL#(3)", "value P005"});
}

TEST_CASE(
    "questions: a routine by an unknown name is one of those that move, and what they need is asked for as well") {
  const std::string program =
      "MODULE m\nPERS string command;\nPERS robtarget p;\nPROC main()\nWaitTime 1;\n%command%;\nENDPROC\nPROC go()\n"
      "MoveJ p,v100,fine,tool0;\nENDPROC\nPROC say()\nTPWrite \"x\";\nENDPROC\nPROC by(num n)\n"
      "MoveJ p,v100,fine,tool0;\nENDPROC\nENDMODULE\n";
  Reader reader{Language::rapid};
  const Reading asked = reader({{"m.mod", program}});
  CHECK(questions(asked) == std::set<std::string>{"value command", "value p"});
  for (const Problem& problem : asked.problems)
    for (const Question& question : problem.questions)
      if (question.name == "command") CHECK(question.form == "one of \"go\"");
  reader.options.values = {{"command", "\"go\""}, {"p", "[[1,2,3],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"}};
  CHECK(reader({{"m.mod", program}}).problem() == "no such problem");
  // A server that runs routines by received names: only the first message of the buffer is a question.
  const Reading server = Reader{Language::rapid}(
      {{"m.mod",
        "MODULE m\nVAR num i:=0;\nPROC main()\nWHILE TRUE DO\nIncr i;\n%command{i}%;\nENDWHILE\nENDPROC\n"
        "PROC go()\nMoveJ p{i},v100,fine,tool0;\nENDPROC\nENDMODULE\n"}});
  CHECK(questions(server) == std::set<std::string>{"value command[1]", "value p[1]"});
}

TEST_CASE(
    "questions: what stands behind several inputs that are read again and again is asked for in the first round") {
  std::string program = "MODULE m\nVAR num code;\nPROC main()\n";
  std::set<std::string> wanted{"value di9"};
  for (int k = 1; k <= 6; ++k)
    program += fmt::format(
        "check;\nIF code<>0 THEN\nRETURN;\nENDIF\nMoveAbsJ [[{},0,0,0,30,0],"
        "[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\n",
        k);
  program +=
      "IF di9=1 THEN\nMoveAbsJ [[9,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\nENDIF\n"
      "ENDPROC\nPROC check()\ncode:=0;\n";
  for (int i = 1; i <= 5; ++i) {
    program += fmt::format("IF di{0}={1} THEN\ncode:={0};\nRETURN;\nENDIF\n", i, i % 2);
    wanted.insert(fmt::format("value di{}", i));
  }
  CHECK(questions(Reader{Language::rapid}({{"m.mod", program + "ENDPROC\nENDMODULE\n"}})) == wanted);
}
