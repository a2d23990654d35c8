#include "sim/program/rewrite.h"

#include <sstream>

#include "sim/program/interpreter/encoding.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"
#include "tests/sim/program/reading.h"

using namespace dresslife;
using namespace dresslife::sim;
using namespace dresslife::tests;

namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// Returns the result of `patch -p1` on `text`.
std::string applied(const std::string& text, const std::string& patch) {
  const std::vector<std::string> old = lines_of(text), rows = lines_of(patch);
  std::vector<std::string> made;
  std::size_t next = 0;
  for (std::size_t i = 2; i < rows.size(); ++i) {
    int begin = 0, count = 0, now = 0, now_count = 0;
    REQUIRE(std::sscanf(rows[i].c_str(), "@@ -%d,%d +%d,%d @@", &begin, &count, &now, &now_count) == 4);
    while (next + 1 < static_cast<std::size_t>(begin)) made.push_back(old[next++]);
    CHECK(made.size() + 1 == static_cast<std::size_t>(now));
    while (count > 0 || now_count > 0) {
      const std::string& row = rows.at(++i);
      if (row[0] != '+') {
        CHECK(old.at(next) == row.substr(1));
        ++next, --count;
      }
      if (row[0] != '-') made.push_back(row.substr(1)), --now_count;
    }
  }
  while (next < old.size()) made.push_back(old[next++]);
  std::string whole;
  for (const std::string& line : made) whole += line + "\n";
  return whole;
}

struct Changed {
  Reading before, after;
  Rewritten written;
};

/// Changes the line of instruction `move` and reads the result.
Changed changed(Language language, const std::string& name, const std::string& text, std::size_t move,
                LineChange change, const ImportOptions& options = {}) {
  Changed c{Reader{language, options}({{name, decoded_text(text)}}), {}, {}};
  REQUIRE(c.before.problem() == "no such problem");
  change.where = c.before.move(move).where;
  change.reason = "spares the cable";
  c.written = rewritten(language, name, text, c.before.program, {change}, name);
  c.after = Reader{language, options}({{name, decoded_text(c.written.text)}});
  INFO(c.written.patch);
  REQUIRE(c.after.problem() == "no such problem");
  CHECK(c.written.patch.starts_with("--- a/" + name + "\n+++ b/" + name + "\n@@ -"));
  CHECK(applied(text, c.written.patch) == c.written.text);
  return c;
}

const std::string rapid = R"(MODULE m
  CONST robtarget p10:=[[500,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget home:=[[0,-10,10,0,40,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveAbsJ home\NoEOffs,v2000,fine,tool0;
    MoveJ p10,v500,z50,tool0\WObj:=wobj0; ! as taught
    MoveJ Offs(p10,0,0,100),[800,90,5000,1000],z10,tool0;
    MoveL p10,v100,fine,tool0;
  ENDPROC
ENDMODULE
)";

const std::string krl = R"(DEF m()
BAS(#INITMOV,0)
BAS(#VEL_PTP,60)
$TOOL={X 0,Y 0,Z 180,A 0,B 0,C 0}
PTP {A1 0,A2 -90,A3 90,A4 0,A5 60,A6 0}
PTP {X 900,Y -350,Z 600,A 0,B 180,C 0,S 2,T 2} C_PTP ; over the part
PTP {A1 10,A2 -90,A3 90,A4 0,A5 60,A6 0}
END
)";

const std::string fanuc =
    "/PROG  M\n/ATTR\n/MN\n   1:J P[1] 60% FINE    ;\n   2:J P[2] 50% CNT50    ;\n   3:L P[3] 400mm/sec FINE    ;\n"
    "   4:J P[2] 25% FINE    ;\n/POS\nP[1]{\n   GP1:\n\tUF : 0, UT : 0,\n\tJ1=     0.000 deg,\tJ2=    10.000 deg,\tJ3=     0.000 deg,\n"
    "\tJ4=     0.000 deg,\tJ5=   -90.000 deg,\tJ6=     0.000 deg\n};\nP[2]{\n   GP1:\n\tUF : 0, UT : 0,\t\tCONFIG : 'N U T, 0, 0, 0',\n"
    "\tX =   950.000  mm,\tY =  -300.000  mm,\tZ =   500.000  mm,\n\tW =   180.000 deg,\tP =     0.000 deg,\tR =     0.000 deg\n};\n"
    "P[3]{\n   GP1:\n\tUF : 0, UT : 0,\t\tCONFIG : 'N U T, 0, 0, 0',\n\tX =   950.000  mm,\tY =  -300.000  mm,\tZ =   300.000  mm,\n"
    "\tW =   180.000 deg,\tP =     0.000 deg,\tR =     0.000 deg\n};\n/END\n";

}  // namespace

TEST_CASE("rewrite: RAPID, each change read back, all else stays byte by byte") {
  const Changed slow = changed(Language::rapid, "m.mod", rapid, 1, {.speed = 0.7});
  CHECK(slow.after.move(1).speed.tool.value() == Approx(0.35));
  CHECK(slow.after.move(1).speed.orientation.value() == Approx(350 * degree));
  CHECK(slow.after.move(1).zone.distance == slow.before.move(1).zone.distance);
  CHECK(slow.written.text.find(
            "MoveJ p10,[0.7*v500.v_tcp,0.7*v500.v_ori,v500.v_leax,v500.v_reax],z50,tool0\\WObj:=wobj0; ! as "
            "taught ! spares the cable\n") != std::string::npos);
  const Changed literal = changed(Language::rapid, "m.mod", rapid, 2, {.speed = 0.5});
  CHECK(literal.after.move(2).speed.tool.value() == Approx(0.4));
  const Changed turned = changed(Language::rapid, "m.mod", rapid, 1,
                                 {.configuration = ArmConfiguration{ArmConfiguration::Kind::abb, {0, 2, -2, 1}}});
  CHECK(turned.after.move(1).target.configuration.text() == "abb 0 2 -2 1");
  CHECK(turned.after.move(1).target.pose.position == turned.before.move(1).target.pose.position);
  CHECK(turned.after.move(3).target.configuration.text() == "abb 0 0 0 0");
  const Changed offset = changed(Language::rapid, "m.mod", rapid, 2,
                                 {.configuration = ArmConfiguration{ArmConfiguration::Kind::abb, {0, 2, -2, 1}}});
  CHECK((offset.after.move(2).target.pose.position - Vector3(0.5, 0, 0.7)).norm() < 1e-9);
  CHECK(offset.after.move(2).target.configuration.text() == "abb 0 2 -2 1");
  const std::vector<double> joints{0.1, -0.2, 0.3, 1, 0.5, -2};
  const Changed home = changed(Language::rapid, "m.mod", rapid, 0, {.joints = joints});
  for (std::size_t i = 0; i < 6; ++i) CHECK(home.after.move(0).target.joints[i] == Approx(joints[i]).margin(1e-8));
  const Changed by = changed(Language::rapid, "m.mod", rapid, 1, {.point = joints});
  REQUIRE(by.after.program.instructions.size() == 5);
  for (std::size_t i = 0; i < 6; ++i) CHECK(by.after.move(1).target.joints[i] == Approx(joints[i]).margin(1e-8));
  CHECK(by.after.move(1).speed.tool == by.before.move(1).speed.tool);
  CHECK(by.after.move(2).target.pose.position == by.before.move(1).target.pose.position);
}

TEST_CASE("rewrite: each line keeps its line end, and the file its byte order mark") {
  std::string mixed = rapid;
  mixed.insert(mixed.find("\n    MoveJ p10"), "\r");
  const Changed slow = changed(Language::rapid, "m.mod", mixed, 1, {.speed = 0.7});
  CHECK(std::ranges::count(slow.written.text, '\r') == 1);
  const std::string mark = "\xEF\xBB\xBF";
  const Changed marked = changed(Language::rapid, "m.mod", mark + mixed, 1, {.speed = 0.7});
  CHECK(marked.written.text == mark + slow.written.text);
  const std::string script = mark + "movej([0,0,0,0,0,1], v=0.5)\n";
  CHECK(changed(Language::urscript, "m.script", script, 0, {.speed = 0.5}).written.text ==
        mark + "movej([0,0,0,0,0,1], v=0.25)  # spares the cable\n");
}

TEST_CASE("rewrite: KRL, Fanuc, INFORM and URScript") {
  const Changed slow = changed(Language::krl, "m.src", krl, 1, {.speed = 0.5});
  CHECK(slow.after.move(0).speed.axis_percent.value() == 60);
  CHECK(slow.after.move(1).speed.axis_percent.value() == 30);
  CHECK(slow.after.move(2).speed.axis_percent.value() == 60);
  const Changed overridden =
      changed(Language::krl, "m.src", std::string(krl).insert(krl.find("BAS("), "$OV_PRO=50\n"), 1, {.speed = 0.5});
  CHECK(overridden.after.move(1).speed.axis_percent.value() == 15);
  CHECK(overridden.after.move(2).speed.axis_percent.value() == 30);
  const Changed turned = changed(Language::krl, "m.src", krl, 1,
                                 {.configuration = ArmConfiguration{ArmConfiguration::Kind::kuka, {6, 58}}});
  CHECK(turned.after.move(1).target.configuration.text() == "kuka 6 58");
  CHECK((turned.after.move(1).target.pose.position - turned.before.move(1).target.pose.position).norm() < 1e-9);
  CHECK(turned.after.move(1).zone.percent == turned.before.move(1).zone.percent);
  const std::vector<double> joints{0.1, -1.2, 1.3, 1, 0.5, -2};
  const Changed by = changed(Language::krl, "m.src", krl, 1, {.point = joints});
  REQUIRE(by.after.program.instructions.size() == 4);
  for (std::size_t i = 0; i < 6; ++i) CHECK(by.after.move(1).target.joints[i] == Approx(joints[i]).margin(1e-8));

  const Changed fast = changed(Language::fanuc, "m.ls", fanuc, 0, {.speed = 0.7});
  CHECK(fast.after.move(0).speed.axis_percent.value() == 42);
  CHECK(fast.written.text.find("   1:  !spares the cable ;\n   2:J P[1] 42% FINE    ;\n   3:J P[2] 50% CNT50    ;\n") !=
        std::string::npos);
  // P[2] is used twice: the changed line uses a new position.
  const Changed other = changed(Language::fanuc, "m.ls", fanuc, 1,
                                {.configuration = ArmConfiguration{ArmConfiguration::Kind::fanuc, {1, 1, 1, 0, 1, 0}}});
  CHECK(other.after.move(1).target.configuration.text() == "fanuc FUT 0 1 0");
  CHECK(other.after.move(3).target.configuration.text() == "fanuc NUT 0 0 0");
  CHECK(other.written.text.find("J P[4] 50% CNT50") != std::string::npos);
  const Changed own = changed(Language::fanuc, "m.ls", fanuc, 2,
                              {.configuration = ArmConfiguration{ArmConfiguration::Kind::fanuc, {1, 1, 1, 0, 1, 0}}});
  CHECK(own.after.move(2).target.configuration.text() == "fanuc FUT 0 1 0");
  const std::vector<double> angles{0.1, 0.2, 0.3, 1, 0.5, -2};
  const Changed axes = changed(Language::fanuc, "m.ls", fanuc, 0, {.joints = angles});
  for (std::size_t i = 0; i < 6; ++i) CHECK(axes.after.move(0).target.joints[i] == Approx(angles[i]).margin(1e-5));

  ImportOptions counts;
  counts.values["pulses_per_degree"] = "[1,1,1,1,1,1]";
  const std::string job =
      "/JOB\n//NAME A\n//POS\n///NPOS 1,0,0,0,0,0\n///TOOL 0\n///POSTYPE PULSE\n///PULSE\nC00000=1,2,3,4,5,6\n"
      "//INST\n///ATTR SC,RW\n///GROUP1 RB1\nNOP\nSPEED VJ=40.00\nMOVJ C00000 VJ=50.00 PL=0\nMOVJ C00000 //next\nEND\n";
  const Changed tag = changed(Language::inform, "a.jbi", job, 0, {.speed = 0.7}, counts);
  CHECK(tag.after.move(0).speed.axis_percent.value() == 35);
  CHECK(tag.written.text.find("MOVJ C00000 VJ=35.00 PL=0  //spares the cable\n") != std::string::npos);
  CHECK(changed(Language::inform, "a.jbi", job, 1, {.speed = 0.5}, counts).after.move(1).speed.axis_percent.value() ==
        20);

  const std::string script =
      "def m():\n  movej([0,0,0,0,0,1], a=1.4, v=1.05, r=0)\n  movej([0,0,0,0,0,2], 1.4, 0.5)\n  movej([0,0,0,0,0,3])\n"
      "end\n";
  const double speeds[] = {1.05, 0.5, 1.05};
  for (std::size_t k = 0; k < 3; ++k) {
    const Changed c = changed(Language::urscript, "m.script", script, k, {.speed = 0.7});
    for (std::size_t i = 0; i < 3; ++i)
      CHECK(c.after.move(i).speed.axis.value() == Approx(speeds[i] * (i == k ? 0.7 : 1)));
  }
}

TEST_CASE("rewrite: what cannot be written is reported at its line") {
  const auto refusal = [](const std::string& text, std::size_t move, LineChange change) {
    const Reading r = Reader{Language::rapid}({{"m.mod", text}});
    change.where = r.move(move).where;
    return pipeline::message_of([&] { rewritten(Language::rapid, "m.mod", text, r.program, {change}, "m.mod"); });
  };
  const std::string timed =
      "MODULE m\nPROC main()\nMoveAbsJ [[0,0,0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v10\\T:=3,fine,tool0;\n"
      "FOR i FROM 1 TO 2 DO\nMoveJ [[500+i,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v500,z50,tool0;\n"
      "ENDFOR\nENDPROC\nENDMODULE\n";
  CHECK(refusal(timed, 0, {.speed = 0.7})
            .find("m.mod:3:1: error: cannot be changed by itself: its speed has an option") == 0);
  CHECK(refusal(timed, 1, {.configuration = ArmConfiguration{ArmConfiguration::Kind::abb, {0, 0, 0, 0}}})
            .find("it is run with several targets") != std::string::npos);
  CHECK(refusal(timed, 1, {.speed = 0.7}) == "");
  CHECK(pipeline::message_of([&] {
          rewritten(Language::rapid, "m.mod", "! gr\xFC\xDF\n" + timed, {}, {}, "m.mod");
        }).find("another encoding") != std::string::npos);
  // A point is an additional line: it must not run without the condition or the wait before the move.
  const std::string move = "MoveAbsJ [[0,0,0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v10,fine,tool0;\n";
  const LineChange by_a_point{.point = {0.1, 0, 0, 0, 0, 0}};
  for (const auto& [before, refused] : {std::pair<std::string, bool>{"IF TRUE ", true},
                                        {"IF (TRUE)\n", true},
                                        {"WaitTime 1; ", true},
                                        {"WaitTime 1;\n", false},
                                        {"", false},
                                        {"IF TRUE THEN\n", false}}) {
    INFO(before);
    const std::string end = before.ends_with("THEN\n") ? "ENDIF\n" : "";
    const std::string text = "MODULE m\nPROC main()\n" + before + move + end + "ENDPROC\nENDMODULE\n";
    CHECK((refusal(text, before.starts_with("Wait") ? 1 : 0, by_a_point).find("a line before it would run") !=
           std::string::npos) == refused);
  }
}
