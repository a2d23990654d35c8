// Rules of a KUKA controller for its programs. Each test gives the rule and its reason.

#include "tests/catch.h"
#include "tests/sim/program/reading.h"

using namespace dresslife;
using namespace dresslife::sim;
using namespace dresslife::tests;

namespace {

constexpr double rounding = 1e-12;  // rounding error of a few products of numbers near 1

const std::string config =
    "DEFDAT $CONFIG\nREAL DEF_VEL_CP=2.0\nREAL DEF_VEL_FACT=1.0\nINT DEF_VEL_PTP=100\nREAL DEF_ACC_CP=2.3\n"
    "REAL DEF_VEL_ORI1=200.0\nREAL DEF_VEL_ORIS=180.0\nINT DEF_APO_CPTP=50\nREAL DEF_APO_CDIS=3.0\nINT "
    "DEF_APO_CVEL=50\nDECL FDAT FDAT_ACT\nDECL PDAT PDAT_ACT\nDECL LDAT LDAT_ACT\nDECL FRAME "
    "TOOL_DATA[16]\nTOOL_DATA[1]={X 0.0,Y 0.0,Z 775.0,A 0.0,B 0.0,C 0.0}\nTOOL_DATA[2]={X 0.0,Y 0.0,Z "
    "100.0,A "
    "0.0,B 0.0,C 0.0}\nDECL FRAME BASE_DATA[32]\nBASE_DATA[1]={X 10.0,Y 20.0,Z 30.0,A 0.0,B 0.0,C "
    "0.0}\nENDDAT\n";

Reading run(const std::string& body, const std::string& data = "", const Files& more = {},
            const Reader& reader = {Language::krl}) {
  Files files{{"p.src", "DEF p()\n" + body + "\nEND\n"}};
  if (!data.empty()) files.push_back({"p.dat", "DEFDAT p\n" + data + "\nENDDAT\n"});
  files.insert(files.end(), more.begin(), more.end());
  files.insert(files.end(), held_frames);
  return reader(files);
}

std::string axes(double first) { return fmt::format("{{A1 {},A2 -90,A3 90,A4 0,A5 30,A6 0}}", first); }
const std::string pose = "{X 1000,Y 0,Z 1000,A 0,B 90,C 0}";

double tool_length(const Reading& reading, std::size_t move) {
  const int tool = reading.move(move).tool;
  return tool < 0 ? 0 : reading.program.tools.at(tool).frame.position.norm();
}

}  // namespace

TEST_CASE("krl controller: a CHAR is the number of its letter") {
  const auto counts = [](const std::string& condition) {
    return run("DECL INT i\nDECL CHAR c\nDECL CHAR a[3]\nc=\"3\"\ni=c\na[]=\"321\"\nIF " + condition + " THEN\nPTP " +
               axes(1) + "\nENDIF\nPTP " + axes(2))
        .program.instructions.size();
  };
  for (const char* holds : {"i==51", "i>50", "c==51", "a[1]>a[3]", "a[3]==\"1\"", "c==a[1]", "c<>a[2]"}) {
    INFO(holds);
    CHECK(counts(holds) == 2);
  }
  for (const char* fails : {"i==3", "a[1]<a[3]", "c==50"}) CHECK(counts(fails) == 1);
}

TEST_CASE("krl: inline forms reach FDAT_ACT, PDAT_ACT and LDAT_ACT that $CONFIG.DAT declares") {
  // BAS(#PTP_PARAMS, v) sets acceleration and approximation of PDAT_ACT, frames of FDAT_ACT and v % of the speed.
  const Reading r =
      run("PDAT_ACT=PP1\nFDAT_ACT=FP1\nBAS(#PTP_PARAMS,60)\nPTP " + pose +
              " C_PTP\nLDAT_ACT=LP1\nFDAT_ACT=FP1\nBAS(#CP_PARAMS,0.5)\nLIN {X 900} C_DIS",
          "DECL FDAT FP1={TOOL_NO 1,BASE_NO 1,IPO_FRAME #BASE,POINT2[] \" \"}\nDECL PDAT PP1={VEL 100.0,ACC "
          "40.0,APO_DIST 70.0}\nDECL LDAT LP1={VEL 2.0,ACC 50.0,APO_DIST 12.0}",
          {{"$config.dat", config}});
  REQUIRE(r.problem() == "no such problem");
  REQUIRE(r.program.instructions.size() == 2);
  CHECK(r.move(0).speed.axis_percent.value() == 60);
  CHECK(r.move(0).acceleration_percent == 40);
  CHECK(r.move(0).zone.percent == 70);
  CHECK(r.program.tools.at(r.move(0).tool).name == "TOOL_DATA[1]");
  CHECK(tool_length(r, 0) == Approx(0.775).epsilon(rounding));
  CHECK(r.program.work_objects.at(r.move(0).work_object).name == "BASE_DATA[1]");
  CHECK(r.move(1).speed.tool.value() == 0.5);
  CHECK(r.move(1).zone.distance == Approx(0.012).epsilon(rounding));
  CHECK(r.move(1).acceleration_percent == Approx(50).epsilon(rounding));
}

TEST_CASE("krl: a data list's names are its program's own") {
  // Both lists declare XP1, and each program uses its own. Without the list of kb, XP1 is unknown in kb.
  const std::pair<std::string, std::string> ka{"ka.src", "DEF ka()\nPTP XP1\nkb()\nPTP XP1\nEND\n"},
      kb{"kb.src", "DEF kb()\nPTP XP1\nEND\n"},
      ka_list{"ka.dat", "DEFDAT ka\nDECL E6AXIS XP1=" + axes(1) + "\nENDDAT\n"},
      kb_list{"KB.DAT", "DEFDAT kb\nDECL E6AXIS XP1=" + axes(11) + "\nENDDAT\n"};
  const Reading both = Reader{Language::krl}({ka, kb, ka_list, kb_list});
  REQUIRE(both.problem() == "no such problem");
  CHECK(first_axes(both.program) == std::vector<double>{1, 11, 1});
  const Reading one = Reader{Language::krl}({ka, kb, ka_list, held_frames});
  REQUIRE(one.problems.size() == 1);
  CHECK(one.problem().starts_with("kb.src:2:5: error: moves to 'xp1', which no file read declares"));
}

TEST_CASE("krl: what says GLOBAL, and the system's lists, are everybody's") {
  const Files others{{"vars.dat", "DEFDAT vars PUBLIC\nDECL GLOBAL E6AXIS G1=" + axes(5) +
                                      "\nDECL E6AXIS L1=" + axes(6) + "\nENDDAT\n"}};
  const Reading global = run("PTP G1", "", others);
  REQUIRE(global.problem() == "no such problem");
  CHECK(first_axes(global.program) == std::vector<double>{5});
  CHECK(run("PTP L1", "", others).problems.size() == 1);
}

TEST_CASE("krl: routines behind the first of a file are its own unless they say GLOBAL") {
  const Reading r = run("a()\nb()\nhelp()\nEND\nDEF help()\nPTP " + axes(0), "",
                        {{"a.src", "DEF a()\nhelp()\nEND\nDEF help()\nPTP " + axes(1) + "\nEND\n"},
                         {"b.src", "DEF b()\nhelp()\nEND\nDEF help()\nPTP " + axes(2) + "\nEND\n"}});
  REQUIRE(r.problem() == "no such problem");
  CHECK(first_axes(r.program) == std::vector<double>{1, 2, 0});
  const Reading missing =
      run("help()\nPTP " + axes(0), "", {{"a.src", "DEF a()\nEND\nDEF help()\nPTP " + axes(1) + "\nEND\n"}});
  REQUIRE(missing.program.skipped.size() == 1);
  CHECK(missing.program.skipped[0].may_move);
}

TEST_CASE("krl: one program twice is refused where it runs, two values of one name where they are used") {
  const std::string sub = "DEF sub()\nPTP " + axes(1) + "\nEND\n";
  const Files twice{{"x/sub.src", sub}, {"y/sub.src", sub}};
  CHECK(run("PTP " + axes(0), "", twice).problems.empty());
  CHECK(run("sub()", "", twice).problem().starts_with("p.src:2:1: error: runs 'sub', which is both in"));
  const Files lists{{"$a.dat", "DEFDAT $A\nE6AXIS G=" + axes(1) + "\nENDDAT\n"},
                    {"$b.dat", "DEFDAT $B\nE6AXIS G=" + axes(2) + "\nENDDAT\n"}};
  CHECK(run("PTP " + axes(0), "", lists).problems.empty());
  CHECK_FALSE(run("PTP G", "", lists).problems.empty());
}

TEST_CASE("krl: what a program writes to an undeclared name stays in it while its data list is missing") {
  // The name may belong to the missing list, so its use in another program has no effect.
  const Reading r = run("n=1\nsub()", "", {{"sub.src", "DEF sub()\nIF n==1 THEN\nPTP " + axes(1) + "\nENDIF\nEND\n"}});
  REQUIRE(r.problems.size() == 1);
  CHECK(r.problems[0].what.find("'n' is a name that no file read declares") != std::string::npos);
}

TEST_CASE("krl: INT divides in whole numbers, REAL does not, and INT takes REAL rounded") {
  // 7/2 of INT is 3; one REAL makes it 3.5; an INT takes 2.5 as 3 (to the nearest, half upwards).
  const Reading r =
      run("INT a,b\nREAL x\na=1\nb=a-(3*(a/3))\nPTP {A1 b,A2 0,A3 0,A4 0,A5 0,A6 0}\nPTP {A1 "
          "7/2}\nx=7\nPTP {A1 10*(x/2)}\na=2.5\nPTP {A1 a}\na=-7\nPTP {A1 a/2}\nPTP {A1 7.0/2*2}");
  REQUIRE(r.problem() == "no such problem");
  CHECK(first_axes(r.program) == std::vector<double>{1, 3, 35, 3, -3, 7});
}

TEST_CASE("krl: parameters take the types of their declarations, and come back unless they only go in") {
  const Reading r =
      run("INT n\nn=1\nup(n)\nPTP {A1 n,A2 0,A3 0,A4 0,A5 0,A6 0}\nkeep(n)\nPTP {A1 n}\nhalf(3)\nEND\nDEF "
          "up(k)\nINT k\nk=k+1\nEND\nDEF keep(k:IN)\nINT k\nk=k+5\nEND\nDEF half(x:IN)\nREAL x\nPTP {A1 "
          "20*(x/2)}");
  REQUIRE(r.problem() == "no such problem");
  CHECK(first_axes(r.program) == std::vector<double>{2, 2, 30});
}

TEST_CASE("krl: FOR goes on from what its body makes of the counter") {
  const Reading r = run("INT n\nFOR n=1 TO 6\nPTP {A1 n,A2 0,A3 0,A4 0,A5 0,A6 0}\nn=n+1\nENDFOR\nPTP {A1 n}");
  REQUIRE(r.problem() == "no such problem");
  CHECK(first_axes(r.program) == std::vector<double>{1, 3, 5, 7});
}

TEST_CASE("krl: the counter behind a FOR whose end is not known is not known") {
  const std::string loop = "INT n,m\nn=3\nPTP " + axes(9) + "\nFOR n=1 TO m\n";
  const std::string use = "ENDFOR\nIF n==2 THEN\nPTP " + axes(2) + "\nENDIF";
  ImportOptions one_pass;
  one_pass.assume["p.src:5"] = Assumption::then_branch;
  for (const std::string body : {"PTP {A1 n}\n", "$FLAG[1]=TRUE\n"}) {
    INFO(body);
    CHECK(run(loop + body + use, "", {}, {Language::krl, one_pass}).problems.size() == 1);
    ImportOptions none = one_pass;
    none.assume["p.src:5"] = Assumption::else_branch;
    CHECK(run(loop + body + use, "", {}, {Language::krl, none}).problems.size() == 1);
  }
  CHECK(run(loop + "$FLAG[1]=TRUE\n" + use).problems.size() == 1);
  CHECK(
      first_axes(run("INT n\nFOR n=1 TO 1\n$FLAG[1]=TRUE\nENDFOR\nIF n==2 THEN\nPTP " + axes(2) + "\nENDIF").program) ==
      std::vector<double>{2});
}

TEST_CASE("krl: WITH sets speed, approximation, tool and base for its move alone") {
  const Reading r =
      run("$VEL.CP=1.5\nSPTP " + pose +
              " WITH $VEL_AXIS[1]=SVEL_JOINT(40.0),$ACC_AXIS[1]=SACC_JOINT(PP1),$APO=SAPO_PTP(PP1) C_SPL\nSLIN "
              "{X 900} "
              "WITH $VEL=SVEL_CP(0.1, "
              ",LP1),$TOOL=STOOL2(FP1),$BASE=SBASE(FP1.BASE_NO),$IPO_MODE=SIPO_MODE(FP1.IPO_FRAME),"
              "$ACC=SACC_CP(LP1),$APO=SAPO(LP1) C_SPL\nSLIN {X 800}\nSLIN {X 700} WITH $VEL=SVEL_CP(9.0, ,LP1)",
          "DECL FDAT FP1={TOOL_NO 1,BASE_NO 1,IPO_FRAME #BASE}\nDECL PDAT PP1={VEL 100.0,ACC 30.0,APO_DIST "
          "60.0,APO_MODE #CPTP}\nDECL LDAT LP1={VEL 2.0,ACC 25.0,APO_DIST 8.0,APO_FAC 50.0}",
          {{"$config.dat", config}});
  REQUIRE(r.problem() == "no such problem");
  REQUIRE(r.program.instructions.size() == 4);
  CHECK(r.move(0).speed.axis_percent.value() == 40);
  CHECK(r.move(0).acceleration_percent == 30);
  CHECK(r.move(0).zone.percent == 60);
  CHECK(r.move(1).speed.tool.value() == 0.1);
  CHECK(r.move(1).speed.orientation.value() == Approx(180 * degree).epsilon(rounding));
  CHECK(r.move(1).zone.distance == Approx(0.008).epsilon(rounding));
  CHECK(r.move(1).acceleration_percent == Approx(25).epsilon(rounding));
  CHECK(tool_length(r, 1) == Approx(0.775).epsilon(rounding));
  CHECK(r.move(2).speed.tool.value() == 1.5);
  CHECK(r.move(2).tool == -1);
  CHECK(r.move(2).zone.distance == 0);
  CHECK(r.move(3).speed.tool.value() == 2.0);  // DEF_VEL_CP is the limit
}

TEST_CASE("krl: moves of the spline planner take their jerk from $GEAR_JERK and $JERK, others do not") {
  const Reading r = run("$VEL.CP=1\nSPTP " + pose +
                            " WITH $GEAR_JERK[1]=SGEAR_JERK(PP1)\nSLIN {X 900} WITH $JERK=SJERK(LP1)\nSLIN {X 800}\n"
                            "$GEAR_JERK[2]=60\n$JERK.CP=125\nPTP " +
                            pose + "\nLIN {X 850}\nSPTP " + pose + "\nSLIN {X 820}",
                        "DECL PDAT PP1={VEL 100.0,ACC 100.0,APO_DIST 60.0,APO_MODE #CPTP,GEAR_JERK 50.0}\n"
                        "DECL LDAT LP1={VEL 2.0,ACC 100.0,APO_DIST 8.0,APO_FAC 50.0,JERK_FAC 40.0}",
                        {{"$config.dat", config}});
  REQUIRE(r.problem() == "no such problem");
  REQUIRE(r.program.instructions.size() == 7);
  const double expected[] = {50, 40, 100, 100, 100, 60, 25};  // 25: 125 of the 500 m/s3 of the machine data
  for (int k = 0; k < 7; ++k) {
    CAPTURE(k);
    CHECK(r.move(k).jerk_percent == Approx(expected[k]).epsilon(rounding));
  }
}

TEST_CASE("krl: what a SPLINE block sets WITH ends with the block") {
  const Reading r = run("$VEL.CP=1\nLIN " + pose +
                        "\nSPLINE WITH $VEL.CP=0.2\nSLIN {X 900}\nSLIN {X 800} WITH "
                        "$VEL.CP=0.1\nENDSPLINE\nLIN {X 700}");
  REQUIRE(r.problem() == "no such problem");
  REQUIRE(r.program.instructions.size() == 4);
  CHECK(r.move(1).speed.tool.value() == 0.2);
  CHECK(r.move(2).speed.tool.value() == 0.1);
  CHECK(r.move(3).speed.tool.value() == 1);
}

TEST_CASE("krl: every case of BAS") {
  const std::string data =
      "DECL PDAT PP1={VEL 50.0,ACC 40.0,APO_DIST 150.0}\nDECL LDAT LP1={VEL 0.4,ACC "
      "100.0,APO_DIST 9.0}\nDECL FDAT FP1={TOOL_NO 2,BASE_NO 0,IPO_FRAME #BASE}";
  const Files system{{"$config.dat", config}};
  // PTP_DAT sets the speed of the data, too. The approximation is limited to 100 %.
  const Reading joint = run("PDAT_ACT=PP1\nBAS(#PTP_DAT)\nFDAT_ACT=FP1\nBAS(#FRAMES)\nPTP " + pose +
                                " C_PTP\n"
                                "BAS(#VEL_PTP,60)\nBAS(#ACC_PTP,20)\nPTP {X 900}",
                            data, system);
  REQUIRE(joint.problem() == "no such problem");
  CHECK(joint.move(0).speed.axis_percent.value() == 50);
  CHECK(joint.move(0).acceleration_percent == 40);
  CHECK(joint.move(0).zone.percent == 100);
  CHECK(tool_length(joint, 0) == Approx(0.1).epsilon(rounding));
  CHECK(joint.move(1).speed.axis_percent.value() == 60);
  CHECK(joint.move(1).acceleration_percent == 20);
  const Reading path = run("LDAT_ACT=LP1\nBAS(#CP_DAT)\nBAS(#TOOL,1)\nBAS(#BASE,1)\nLIN " + pose +
                               " C_DIS\nBAS(#VEL_CP,0.7)\nBAS(#ACC_CP,10)\nBAS(#TOOL,0)\nBAS(#BASE,0)\nLIN {X 900}",
                           data, system);
  REQUIRE(path.problem() == "no such problem");
  CHECK(path.move(0).speed.tool.value() == 0.4);
  CHECK(path.move(0).zone.distance == Approx(0.009).epsilon(rounding));
  CHECK(tool_length(path, 0) == Approx(0.775).epsilon(rounding));
  CHECK(path.move(1).speed.tool.value() == 0.7);
  CHECK(path.move(1).acceleration_percent == Approx(10).epsilon(rounding));
  CHECK(path.move(1).tool == -1);
  CHECK(path.move(1).work_object == -1);
}

TEST_CASE("krl: BAS(#INITMOV,0) starts with the values of $CONFIG.DAT") {
  // Values of speed, approximation, the first tool and the world frame.
  const std::string body = "BAS(#INITMOV,0)\nPTP " + pose + " C_PTP\nLIN {X 900} C_DIS\nLIN {X 800} C_VEL";
  const Reading r = run(body, "", {{"$config.dat", config}});
  REQUIRE(r.problem() == "no such problem");
  REQUIRE(r.program.instructions.size() == 3);
  CHECK(r.move(0).zone.percent == 50);
  CHECK(tool_length(r, 0) == Approx(0.775).epsilon(rounding));
  CHECK(r.move(1).speed.tool.value() == 2);
  CHECK(r.move(1).speed.orientation.value() == Approx(200 * degree).epsilon(rounding));
  CHECK(r.move(1).zone.distance == Approx(0.003).epsilon(rounding));
  CHECK(r.move(2).zone.percent == 25);  // below half the speed: a quarter of the braking distance
  const Reading without = run(body);
  REQUIRE(without.problems.size() == 2);
  CHECK(without.problems[0].what == "moves with TOOL_DATA[1], which no file read declares");
  CHECK(without.problems[1].what.find("'def_vel_cp' is a name that no file read declares") != std::string::npos);
}

TEST_CASE("krl: a move to where the robot stands is none") {
  // PTP $AXIS_ACT and PTP $POS_ACT are the block coincidence run of hand-written programs.
  for (const char* here : {"PTP $AXIS_ACT", "PTP $POS_ACT", "SPTP $AXIS_ACT", "LIN $POS_ACT"}) {
    const Reading r = run(std::string("$VEL.CP=1\n") + here + "\nPTP " + axes(3));
    REQUIRE(r.problem() == "no such problem");
    CHECK(first_axes(r.program) == std::vector<double>{3});
  }
  const Reading kept = run("DECL E6AXIS h\nh = $AXIS_ACT_MEAS ; here\nPTP h\nPTP " + axes(3));
  REQUIRE(kept.problem() == "no such problem");
  CHECK(first_axes(kept.program) == std::vector<double>{3});
  CHECK(run("DECL E6AXIS h\nh=$AXIS_ACT\nPTP " + axes(3) + "\nPTP h").problems.size() ==
        1);  // back to the unknown start
  const Reading known = run("DECL E6AXIS h\nPTP " + axes(3) + "\nh=$AXIS_ACT\nh.A1=h.A1+4\nPTP h");
  REQUIRE(known.problem() == "no such problem");
  CHECK(first_axes(known.program) == std::vector<double>{3, 7});
  CHECK(run("DECL E6AXIS h\nh=$AXIS_ACT\nh.A1=h.A1+4\nPTP h").problems.size() == 1);
}

TEST_CASE("krl: a relative move in metres is warned of, one in millimetres is not") {
  const std::string begin = "$VEL.CP=1\nPTP {X 1000,Y 0,Z 1000,A 0,B 0,C 0}\n";
  const auto warnings = [&](const std::string& move) { return moves_left_out(run(begin + move).program); };
  const auto of_metres = warnings("LIN_REL {Z -0.15}\nLIN_REL {Y 0.12} #TOOL");
  REQUIRE(of_metres.size() == 2);
  CHECK_THAT(of_metres[0].text(), Catch::Contains(":4:") &&
                                      Catch::Contains("0.15 mm: a relative move of less than 1 mm") &&
                                      Catch::Contains("a thousand times these numbers if they were metres"));
  CHECK(warnings("LIN_REL {Z -150}\nLIN_REL {Z 0}\nLIN_REL {A 0.5}\nLIN {X 0.5}").empty());
}

TEST_CASE("krl: what a target leaves out comes from where the robot stands, in the frames in use") {
  // The robot is at z = 1000 in the world. The new base is 30 mm above it, so the position in this base is 970.
  const Reading r =
      run("$VEL.CP=1\nPTP {X 1000,Y 0,Z 1000,A 0,B 0,C 0}\n$BASE={X 0,Y 0,Z 30,A 0,B 0,C 0}\nLIN {X "
          "900}\n$TOOL={X 0,Y 0,Z 50,A 0,B 0,C 0}\nLIN_REL {X 10}");
  REQUIRE(r.problem() == "no such problem");
  CHECK((r.move(1).target.pose.position - Vector3(0.9, 0, 0.97)).norm() < rounding);
  CHECK((r.move(2).target.pose.position - Vector3(0.91, 0, 1.02)).norm() < rounding);
}

TEST_CASE("krl: relative moves along the tool, and those whose law is not public") {
  const Reading tool = run("$VEL.CP=1\nPTP " + pose + "\nLIN_REL {Z 100} #TOOL\nLIN_REL {C 90} #TOOL");
  REQUIRE(tool.problem() == "no such problem");  // the tool's z points along the base's x
  CHECK((tool.move(1).target.pose.position - Vector3(1.1, 0, 1)).norm() < rounding);
  const Quaternion turned = rotation({0, 90 * degree, 0}) * rotation({90 * degree, 0, 0});
  CHECK(tool.move(2).target.pose.orientation.angularDistance(turned) < 1e-9);  // acos near 1 loses half of the digits
  CHECK(run("$VEL.CP=1\nPTP " + pose + "\nLIN_REL {C 90}").problems.size() == 1);
}

TEST_CASE("krl: the robot's own place in the world counts") {
  // $ROBROOT of Mada/$MACHINE.DAT: targets are in the world frame, 500 mm below the robot's foot.
  const Reading r = run("PTP " + pose, "",
                        {{"$machine.dat",
                          "DEFDAT $MACHINE\nFRAME $ROBROOT={X 0.0,Y 0.0,Z 500.0,A 0.0,B 0.0,C "
                          "0.0}\nENDDAT\n"}});
  REQUIRE(r.problem() == "no such problem");
  CHECK(r.program.work_objects.at(r.move(0).work_object).frame.position.z() == Approx(-0.5).epsilon(rounding));
}

TEST_CASE("krl: bases and tools that only the user has") {
  const std::vector<NamedFrame> bases{{"BASE_DATA[1]", {Vector3(1, 2, 3), Quaternion::Identity()}, false}};
  for (const char* body : {"$BASE=BASE_DATA[1]", "FDAT_ACT={TOOL_NO 0,BASE_NO 1,IPO_FRAME #BASE}\nBAS(#FRAMES)",
                           "BAS(#BASE,1)", "$BASE=$NULLFRAME:BASE_DATA[1]"}) {
    const std::string program = std::string(body) + "\nPTP " + pose;
    const Reading given = run(program, "", {}, {Language::krl, {}, {}, bases});
    REQUIRE(given.problem() == "no such problem");
    CHECK((given.program.work_objects.at(given.move(0).work_object).frame.position - Vector3(1, 2, 3)).norm() <
          rounding);
    const Reading missing = run(program);
    REQUIRE(missing.problems.size() == 1);
    CHECK(missing.problems[0].what == "moves with BASE_DATA[1], which no file read declares");
    CHECK(missing.problems[0].remedy.find("motion.work_objects with the name 'BASE_DATA[1]'") != std::string::npos);
    // A list that is declared without the element does not give it a value.
    const Reading declared =
        run(program, "", {{"$c.dat", "DEFDAT $C\nDECL FRAME BASE_DATA[9]\nENDDAT\n"}}, {Language::krl, {}, {}, bases});
    CHECK(declared.problem() == "no such problem");
    // A move to axis angles does not need a base.
    CHECK(run(std::string(body) + "\nPTP " + axes(1)).problems.empty());
  }
}

TEST_CASE("krl: a target without a value is distinguished from one without a declaration") {
  CHECK(run("DECL E6POS pa\nPTP pa").problem() ==
        "p.src:3:5: error: moves to 'pa', which has no value yet; assign it before the move, give the file "
        "that "
        "holds its value (.dat), or motion.values: [{name: pa, value: '{X ...}'}]");
  // The user's value is used until the program writes to the name. The same rule applies to an input.
  Reader given{Language::krl};
  given.options.values = {{"pa", axes(7)}, {"gi", "3"}};
  CHECK(first_axes(run("DECL E6AXIS pa\nPTP pa\npa=" + axes(8) + "\nPTP pa", "", {}, given).program) ==
        std::vector<double>{7, 8});
  CHECK(first_axes(
            run("SIGNAL gi $IN[1] TO $IN[8]\nDECL REAL r\nr=gi\nPTP {A1 r,A2 -90,A3 90,A4 0,A5 30,A6 0}", "", {}, given)
                .program) == std::vector<double>{3});
  // All uses of a missing name are one problem.
  const Reading missing = run("PTP xa\nPTP xa\nPTP xb\nPTP xa");
  CHECK(missing.problems.size() == 2);
}

TEST_CASE("krl: a loop that only waits for an input goes on, outputs or not") {
  const std::string loop = "LOOP\n$OUT[1]=FALSE\nIF $IN[1]==TRUE THEN\n$OUT[1]=TRUE\nPTP " + axes(1) + "\nENDIF\n";
  const Reading r = run(loop + "ENDLOOP");
  REQUIRE(r.problem() == "no such problem");
  CHECK(first_axes(r.program) == std::vector<double>{1});
  CHECK_THAT(run("DECL INT n\nn=0\n" + loop + "n=n+1\nENDLOOP").problem(),
             Catch::Contains("branches on a condition that is known"));
}

TEST_CASE("krl: frames of an undeclared FDAT are asked for by its name") {
  CHECK_THAT(run("$VEL.CP=1\nFDAT_ACT=FHOME\nBAS(#FRAMES)\nLIN " + pose).problem(),
             Catch::Contains("'fhome' is a name that no file read declares") &&
                 Catch::Contains("or give motion.values: [{name: fhome, value: VALUE}]"));
}

TEST_CASE("krl: a coordinate that input decides asks, also beside known ones") {
  const Reading r =
      run("DECL POS p1\n$VEL.CP=1\nPTP " + pose + "\np1={X 1,Y 2,Z 3,A 0,B 0,C 0}\np1.X=$ANIN[1]\nLIN p1");
  REQUIRE(r.problems.size() == 1);
  CHECK(r.problems[0].what.starts_with("moves to a place that is known only while the robot runs"));
  const Reading written = run("REAL x\n$VEL.CP=1\nx=5\nEKI_GetReal(\"a\",\"b\",x)\nPTP " + pose + "\nLIN {X x}");
  CHECK(written.problems.size() == 1);
}

TEST_CASE("krl: an assignment by aggregate leaves nothing of the value before") {
  // E1 was known and is left out of the second aggregate. The controller's rule for this is not known.
  const Reading r = run("DECL E6POS p1\np1={X 1,Y 2,Z 3,A 0,B 0,C 0,E1 7}\np1={X 1,Y 2,Z 4,A 0,B 0,C 0}\nPTP p1");
  CHECK(r.problems.size() == 1);
  const Reading unset = run("DECL E6POS p1\np1={X 1,Y 2,Z 3,A 0,B 0,C 0}\np1={X 1,Y 2,Z 4,A 0,B 0,C 0}\nPTP p1");
  CHECK(unset.problem() == "no such problem");
}

TEST_CASE("krl: the robot stops where the controller, which runs ahead, waits for it") {
  const auto blends = [](const std::string& between) {
    const Reading r = run("$VEL.CP=1\n$APO.CDIS=10\nLIN " + pose + " C_DIS\n" + between + "\nLIN {X 900}");
    INFO(between);
    REQUIRE(r.problem() == "no such problem");
    return r.move(0).zone.distance > 0;
  };
  for (const char* waits : {"WAIT SEC 0", "$OUT[1]=TRUE", "PULSE($OUT[1],TRUE,0.5)", "HALT", "WAIT FOR $IN[1]",
                            "IF $IN[1] THEN\n$FLAG[1]=TRUE\nENDIF", "CONTINUE\n$OUT[1]=TRUE\n$OUT[2]=TRUE",
                            "CONTINUE\n\n$OUT[1]=TRUE", "ANOUT OFF a1", "f=$POS_INT"})
    CHECK_FALSE(blends(waits));
  for (const char* goes_on :
       {"", "; a comment with $OUT[1]", "CONTINUE\n$OUT[1]=TRUE", "CONTINUE\nWAIT FOR $IN[1]", "$FLAG[1]=TRUE",
        "TRIGGER WHEN DISTANCE=0 DELAY=0 DO $OUT[1]=TRUE", "INTERRUPT DECL 9 WHEN $IN[1] DO halted()"})
    CHECK(blends(goes_on));
  // A timed wait after CONTINUE runs while the robot moves.
  const Reading ahead =
      run("$VEL.CP=1\n$APO.CDIS=10\nCONTINUE\nWAIT SEC 2\nLIN " + pose + " C_DIS\nCONTINUE\nWAIT SEC 1\nLIN {X 900}");
  REQUIRE(ahead.program.instructions.size() == 3);
  CHECK(ahead.move(0).dwell == 2);
  CHECK(ahead.move(1).zone.distance > 0);
  CHECK(ahead.program.skipped.at(0).may_move);
  // Without the advance run ($ADVANCE=0) no move is approximated.
  const Reading none =
      run("$VEL.CP=1\n$APO.CDIS=10\n$ADVANCE=0\nLIN " + pose + " C_DIS\n$ADVANCE=3\nLIN {X 900} C_DIS\nLIN {X 800}");
  CHECK(none.move(0).zone.distance == 0);
  CHECK(none.move(1).zone.distance == Approx(0.01));
}

TEST_CASE("krl: names of inputs, outputs and imported variables stop the advance as these do") {
  const Files list{
      {"$config.dat", "DEFDAT $CONFIG\nSIGNAL GRIP $OUT[7]\nGLOBAL SIGNAL PART $IN[3] TO $IN[5]\nBOOL done\nENDDAT\n"}};
  const auto reading = [&](const std::string& between, const Files& files) {
    return run("SIGNAL lamp $OUT[9]\nDECL BOOL own\n$VEL.CP=1\n$APO.CDIS=10\nLIN " + pose + " C_DIS\n" + between +
                   "\nLIN {X 900}",
               "SIGNAL valve $OUT[8]\nIMPORT INT other IS /R1/q..n", files);
  };
  const auto blends = [&](const std::string& between) {
    const Reading r = reading(between, list);
    INFO(between);
    REQUIRE(r.problem() == "no such problem");
    CHECK(r.program.skipped.empty() == (between.find("IF") == std::string::npos));
    return r.move(0).zone.distance > 0;
  };
  for (const char* waits : {"grip=TRUE", "lamp=FALSE", "VALVE=NOT valve", "own=part==3", "own=other>2",
                            "IF part==3 THEN\nown=TRUE\nENDIF", "CONTINUE\nown=TRUE\ngrip=TRUE"})
    CHECK_FALSE(blends(waits));
  for (const char* goes_on : {"done=TRUE", "own=FALSE", "CONTINUE\ngrip=TRUE"}) CHECK(blends(goes_on));
  // Without the list the name may be a SIGNAL or a variable.
  const Reading unknown = reading("grip=TRUE", {});
  REQUIRE(unknown.program.skipped.size() == 1);
  CHECK(unknown.program.skipped[0].may_move);
  CHECK(unknown.program.skipped[0].what.starts_with("'grip' is declared in no file read"));
  CHECK(reading("grip=1", {}).program.skipped.empty());
}

TEST_CASE("krl: a condition that waits for the robot waits in every pass of its loop") {
  const std::string begin = "DECL INT i\n$VEL.CP=1\n$APO.CDIS=10\ni=0\n", step = "LIN " + pose + " C_DIS\ni=i+1\n";
  const auto stops = [&](const std::string& loop) {
    const Reading r = run(begin + loop + "LIN {X 800}");
    REQUIRE(r.problem() == "no such problem");
    return r.move(0).zone.distance == 0 && r.move(1).zone.distance == 0;
  };
  CHECK(stops("WHILE i<2 AND ($OUT[1] OR TRUE)\n" + step + "ENDWHILE\n"));
  CHECK(stops("REPEAT\n" + step + "UNTIL i>1 OR ($OUT[1] AND FALSE)\n"));
  CHECK_FALSE(stops("WHILE i<2\n" + step + "ENDWHILE\n"));
}

TEST_CASE("krl: a stop in a branch that is left out is reported where a blend depends on it") {
  const std::string branch = "IF n>1 THEN\n$OUT[1]=TRUE\nENDIF\nLIN {X 900}";
  const auto warnings = [&](const std::string& zone) {
    const Reading r = run("$VEL.CP=1\n$APO.CDIS=10\nLIN " + pose + zone + "\n" + branch);
    return std::count_if(r.program.skipped.begin(), r.program.skipped.end(),
                         [](const Skipped& s) { return s.may_move; });
  };
  CHECK(warnings(" C_DIS") == 1);
  CHECK(warnings("") == 0);
}

TEST_CASE("krl: what an undecided branch may set is asked for where a move needs it") {
  for (const char* sets : {"$VEL.CP=0.1", "$ACC.CP=0.5", "$APO.CDIS=50", "$ORI_TYPE=#CONSTANT", "$CIRC_TYPE=#PATH",
                           "$IPO_MODE=#TCP", "$TOOL.Z=200", "$BASE=$NULLFRAME", "$ROBROOT={X 0,Y 0,Z 500,A 0,B 0,C 0}",
                           "$ROBROOT.Z=500", "$OV_PRO=50", "$VEL_AXIS[1]=10", "f.X=950", "slow()"}) {
    INFO(sets);
    const std::string body =
        "DECL FRAME f\n$TOOL={X 0,Y 0,Z 100,A 0,B 0,C 0}\n$BASE=$NULLFRAME\n$VEL.CP=0.5\n$ACC.CP=1\n"
        "$APO.CDIS=10\nf={X 900,Y 0,Z 900,A 0,B 80,C 0}\nPTP " +
        axes(0) + "\nIF $IN[1] THEN\n" + sets + "\nENDIF\nLIN " + pose +
        "\nCIRC {X 950,Y 0,Z 1000,A 0,B 80,C 0},f C_DIS\nPTP " + axes(5) + "\nEND\nDEF slow()\n$VEL.CP=0.01";
    const Reading r = run(body);
    REQUIRE(!r.problems.empty());
    const auto& questions = r.problems[0].questions;
    CHECK(std::any_of(questions.begin(), questions.end(), [](const Question& q) { return q.name == "$in[1]"; }));
    Reader answered{Language::krl};
    answered.options.values = {{"$IN[1]", "FALSE"}};
    CHECK(run(body, "", {}, answered).problem() == "no such problem");
  }
}

TEST_CASE("krl: the override of the program slows its moves down") {
  const Reading r = run("$OV_PRO=50\n$VEL.CP=1\nPTP " + pose + "\nLIN {X 900}");
  REQUIRE(r.problem() == "no such problem");
  CHECK(r.move(0).speed.axis_percent.value() == 50);
  CHECK(r.move(1).speed.tool.value() == 0.5);
}

TEST_CASE("krl: arrays are handed over, and mistakes count where they run") {
  const Reading r = run("DECL REAL lr[2,2]\nlr[1,1]=5\nPTP " + axes(0) +
                        "\nsub(lr[,])\nEND\nDEF sub(x[,]:OUT)\nDECL "
                        "REAL x[,]\nPTP {A1 x[1,1]}\nEND\nDEF never()\nPTP ((\nIF TRUE THEN\n");
  REQUIRE(r.problem() == "no such problem");
  CHECK(first_axes(r.program) == std::vector<double>{0, 5});
  CHECK_FALSE(run("never()\nEND\nDEF never()\nPTP ((").problems.empty());
}

TEST_CASE("krl: a program's number from the line's controller is asked for") {
  const std::string cell = "INT PGNO\nLOOP\nP00(#EXT_PGNO,#PGNO_GET,DMY[],0)\nSWITCH PGNO\nCASE 1\nPTP " + axes(1) +
                           "\nCASE 2\nPTP " + axes(2) + "\nENDSWITCH\nENDLOOP";
  const Reading asked = run(cell);
  REQUIRE(asked.problems.size() == 1);
  CHECK(asked.problems[0].what.find("program's number") != std::string::npos);
  Reader with{Language::krl};
  with.options.values["PGNO"] = "2";
  const Reading given = run(cell, "", {}, with);
  REQUIRE(given.problem() == "no such problem");
  CHECK(first_axes(given.program) == std::vector<double>{2});
}

TEST_CASE("krl: structures of the program's own") {
  const Reading r =
      run("DECL place q\nq.at={A1 4,A2 0,A3 0,A4 0,A5 0,A6 0}\nq.n=2.6\nPTP q.at\nPTP {A1 q.n}\nPTP {A1 "
          "q.list[2]}",
          "STRUC place AXIS at,INT n,list[3]\nDECL place r", {});
  CHECK(first_axes(r.program) == std::vector<double>{4, 3});
  CHECK(r.problems.size() == 1);  // list[2] has no value
}

TEST_CASE("krl: signals and what has no value are named where a branch depends on them") {
  const Reading signal = run("IF ready THEN\nPTP " + axes(1) + "\nENDIF", "SIGNAL ready $IN[5]");
  REQUIRE(signal.problems.size() == 1);
  CHECK(signal.problems[0].what.find("'ready' is a signal") != std::string::npos);
  const Reading unset = run("BOOL b\nIF b THEN\nPTP " + axes(1) + "\nENDIF");
  REQUIRE(unset.problems.size() == 1);
  CHECK(unset.problems[0].what.find("'b' has no value yet") != std::string::npos);
}

TEST_CASE("krl: automatic operation, waiting loops and the states of variables ask nothing") {
  const Reading r = run("INT n\nIF $T1 THEN\nPTP " + axes(1) +
                        "\nENDIF\nWHILE NOT $IN[1]\nWAIT SEC 0.1\nENDWHILE\n"
                        "IF VARSTATE(\"n\")==#DECLARED THEN\nPTP " +
                        axes(2) + "\nENDIF\nn='H1E'/4\nPTP {A1 n}");
  REQUIRE(r.problem() == "no such problem");
  CHECK(first_axes(r.program) == std::vector<double>{2, 7});
}

TEST_CASE("krl: structures that would fill the memory are left without values") {
  std::string list;
  for (int level = 0; level < 6; ++level) list += fmt::format("STRUC s{} s{} a[30],b[30],c[30]\n", level, level + 1);
  CHECK(run("PTP " + axes(1) + "\nPTP big.a[1]", list + "STRUC s6 REAL x[30]\nDECL s0 big").problems.size() == 1);
}

TEST_CASE("krl: what an interrupt writes is unknown while it may happen, and a search is reported") {
  const std::string handler = "\nEND\nDEF found()\nBRAKE\nhit=TRUE\nRESUME";
  const std::string start = "INTERRUPT DECL 21 WHEN $IN[1] DO found()\n$VEL.CP=1\nPTP " + pose +
                            "\nINTERRUPT ON 21\nhit=FALSE\nLIN {X 900}\nINTERRUPT OFF 21\n";
  const Reading asked = run(start + "IF hit THEN\nLIN {X 800}\nENDIF" + handler, "BOOL hit=FALSE");
  REQUIRE(asked.problems.size() == 1);
  CHECK(asked.problems[0].what.find("'hit' may be written by the interrupt found") != std::string::npos);
  const Reading told = run(start + "hit=FALSE\nIF hit THEN\nLIN {X 800}\nENDIF" + handler, "BOOL hit=FALSE");
  REQUIRE(told.problem() == "no such problem");
  REQUIRE(told.program.skipped.size() == 1);
  CHECK(told.program.skipped[0].may_move);
  CHECK(told.program.instructions.size() == 2);
  // The handler belongs to the module that declares the interrupt, not to the module that switches it on.
  const Reading elsewhere = run("search()\nIF hit THEN\nPTP " + axes(1) + "\nENDIF" + handler, "GLOBAL BOOL hit=FALSE",
                                {{"s.src", "DEF search()\nINTERRUPT ON 21\nPTP " + axes(2) + "\nEND\n"}});
  CHECK(first_axes(elsewhere.program) == std::vector<double>{2});
  const Reading other =
      run("INTERRUPT DECL 21 WHEN $IN[1] DO found()\nsearch()\nIF hit THEN\nPTP " + axes(1) + "\nENDIF" + handler,
          "GLOBAL BOOL hit=FALSE", {{"s.src", "DEF search()\nINTERRUPT ON 21\nPTP " + axes(2) + "\nEND\n"}});
  CHECK(other.problems.size() == 1);
}

TEST_CASE("krl: what a TRIGGER sets is unknown behind it") {
  // A TRIGGER runs during a move, before or after the following statements.
  const Reading r = run("BOOL b\nb=FALSE\n$VEL.CP=1\nPTP " + pose +
                        "\nTRIGGER WHEN DISTANCE=0 DELAY=20 DO b=TRUE PRIO=-1\n"
                        "LIN {X 900}\nIF b THEN\nLIN {X 800}\nENDIF");
  REQUIRE(r.problems.size() == 1);
  CHECK(r.problems[0].what.find("'b' is written by the TRIGGER in p.src:6") != std::string::npos);
}

TEST_CASE("krl: frames that the controller holds are asked for, and waiting alone is no motion") {
  const auto reading = [](const std::string& body, const std::map<std::string, std::string>& values) {
    Reader reader{Language::krl};
    reader.options.values = values;
    return reader({{"p.src", "DEF p()\n" + body + "\nEND\n"}});
  };
  const std::string held = "PTP " + pose + "\nPTP {Z 900}";
  const Reading asked = reading(held, {});
  std::set<std::string> names;
  for (const Problem& problem : asked.problems)
    for (const Question& question : problem.questions) {
      names.insert(question.name);
      CHECK(question.form == "{X .., Y .., Z .., A .., B .., C ..} in mm and deg");
      CHECK(question.preset.empty());  // no default, because the null frame may be wrong
    }
  CHECK(names == std::set<std::string>{"$tool", "$base"});
  const std::string tool = "{X 0,Y 0,Z 100,A 0,B 0,C 0}";
  const Reading given = reading(held, {{"$tool", tool}, {"$base", "$NULLFRAME"}});
  REQUIRE(given.problem() == "no such problem");
  CHECK(tool_length(given, 0) == Approx(0.1).epsilon(rounding));
  CHECK(tool_length(reading("$TOOL.X=0\n$TOOL.Y=0\n" + held, {{"$tool", tool}, {"$base", "$NULLFRAME"}}), 0) ==
        Approx(0.1).epsilon(rounding));
  CHECK(reading("$TOOL=$NULLFRAME\n$BASE=$WORLD\n" + held, {}).problems.empty());
  CHECK(reading("PTP " + axes(1), {}).problems.empty());
  CHECK(run("WAIT SEC 2").problem().find("moves the robot nowhere") != std::string::npos);
}

TEST_CASE("krl: an interrupt's handler that moves does not write to its targets") {
  // PTP home in a handler only reads `home`: it stays known in the main program after INTERRUPT ON.
  const Reading r =
      run("INTERRUPT DECL 20 WHEN $IN[1] DO away()\nINTERRUPT ON 20\nPTP home\nEND\n"
          "DEF away()\nBRAKE\nPTP home\nRESUME",
          "DECL AXIS home=" + axes(7));
  CHECK(r.problem() == "no such problem");
  CHECK(first_axes(r.program) == std::vector<double>{7});
}

TEST_CASE("krl: CIRC with CA goes round by the angle, not to its target") {
  // Circle of 100 mm about (1100, 0, 1000), from (1000, 0) over (1100, 100) to (1200, 0).
  const std::string ready = "$TOOL=$NULLFRAME\n$BASE=$NULLFRAME\n$VEL.CP=0.1\nLIN {X 1000,Y 0,Z 1000,A 0,B 0,C 0}\n";
  const auto end_of = [&](const std::string& angle) {
    const Reading r = run(ready + "CIRC {X 1100,Y 100},{X 1200,Y 0}, CA " + angle + "\nLIN_REL {Z 10}");
    INFO(r.problem());
    REQUIRE(r.problems.empty());
    for (const Instruction& move : r.program.instructions)
      if (move.kind == Instruction::Kind::circular)
        CHECK(std::abs((move.via.position - Vector3(1.1, 0, 1)).norm() - 0.1) < rounding);
    return Vector3(r.program.instructions.back().target.pose.position);
  };
  CHECK((end_of("90") - Vector3(1.1, 0.1, 1.01)).norm() < rounding);
  CHECK((end_of("-90") - Vector3(1.1, -0.1, 1.01)).norm() < rounding);
  CHECK((end_of("360") - Vector3(1.0, 0, 1.01)).norm() < rounding);
  CHECK((end_of("450") - Vector3(1.1, 0.1, 1.01)).norm() < rounding);
  // The rotation of the tool is not public if CA does not end at the target.
  CHECK(run(ready + "CIRC {X 1100,Y 100},{X 1200,Y 0,A 90}, CA 90").problem().find("turns the tool") !=
        std::string::npos);
  CHECK(run(ready + "CIRC {X 1100},{X 1200}, CA 90").problem().find("no circle") != std::string::npos);
}

TEST_CASE("krl: $ORI_TYPE #CONSTANT keeps the tool as it is, on circles by #PATH it turns with them") {
  const std::string ready = "$TOOL=$NULLFRAME\n$BASE=$NULLFRAME\n$VEL.CP=0.1\nLIN {X 1000,Y 0,Z 1000,A 0,B 0,C 0}\n";
  const Reading line = run(ready + "$ORI_TYPE=#CONSTANT\nLIN {X 1100,Y 0,Z 1000,A 90,B 0,C 0}");
  REQUIRE(line.problem() == "no such problem");
  CHECK(line.move(1).target.pose.orientation.isApprox(Quaternion::Identity()));
  // A half circle, counterclockwise from below: the path turns by -180 deg about z, and the tool turns with it.
  const Reading circle = run(ready + "$ORI_TYPE=#CONSTANT\n$CIRC_TYPE=#PATH\nCIRC {X 1100,Y 100},{X 1200,Y 0}");
  REQUIRE(circle.problem() == "no such problem");
  const Frame& end = circle.program.instructions.back().target.pose;
  CHECK((end.position - Vector3(1.2, 0, 1)).norm() < rounding);
  CHECK(std::abs(end.orientation.z()) > 1 - rounding);
  // #JOINT ends at the orientation of the target, but the orientation on the way differs from the reader's.
  const Reading wrist = run(ready + "$ORI_TYPE=#JOINT\nLIN {X 1100,Y 0,Z 1000,A 90,B 0,C 0}");
  REQUIRE(wrist.program.skipped.size() == 1);
  CHECK(wrist.program.skipped[0].may_move);
  // An inline form sets $ORI_TYPE by its data (ORI_TYP).
  const Reading form =
      run("LDAT_ACT=L1\nFDAT_ACT={TOOL_NO 0,BASE_NO 0,IPO_FRAME #BASE}\nBAS(#CP_PARAMS,0.1)\nLIN " + pose +
              "\nLIN {X 900,Y 0,Z 1000,A 0,B 0,C 0}",
          "DECL LDAT L1={VEL 2.0,ACC 100.0,APO_DIST 10.0,ORI_TYP #CONSTANT}", {{"$config.dat", config}});
  REQUIRE(form.problem() == "no such problem");
  CHECK(form.move(0).target.pose.orientation.isApprox(form.move(1).target.pose.orientation));
}

TEST_CASE("krl: what dialogues and text functions write is unknown behind them") {
  const std::string choice = "IF n==1 THEN\nPTP " + axes(1) + "\nENDIF";
  for (const std::string call :
       {"MsgDialog(n,\"on?\",\"app\",,\"yes\")", "WHILE Exists_KrlDlg(3,n)\nWAIT SEC 0.1\nENDWHILE"}) {
    const Reading r = run("n=0\nPTP " + axes(2) + "\n" + call + "\n" + choice, "INT n");
    REQUIRE(r.problems.size() == 1);
    CHECK(r.problem().find("'n' may be written by") != std::string::npos);
  }
  CHECK(run("s[]=\"ab\"\nSTRCOPY(s[],\"cd\")\nIF s[]==\"ab\" THEN\nPTP " + axes(1) + "\nENDIF", "CHAR s[8]")
            .problems.size() == 1);
}

TEST_CASE("krl: bits and letters count") {
  const auto taken = [](const std::string& before, const std::string& condition) {
    const Reading r = run("INT a\nCHAR s[8]\n" + before + "\nPTP " + axes(0) + "\nIF " + condition + " THEN\nPTP " +
                          axes(1) + "\nENDIF");
    INFO(r.problem());
    CHECK(r.problems.empty());
    return first_axes(r.program).size() == 2;
  };
  CHECK(taken("a='B1010'", "(a B_AND 'B0110')==2"));
  CHECK(taken("a=10 B_OR 1", "a==11"));
  CHECK(taken("a=12 B_EXOR 10", "a==6"));
  CHECK(taken("a=B_NOT 10", "a==-11"));
  CHECK(taken("s[]=\"AB\"", "s[2]==\"B\""));
  CHECK_FALSE(taken("s[]=\"AB\"", "s[1]==\"B\""));
}

TEST_CASE("krl: external axes move alone, and are where the robot stands") {
  // PTP {E1 5} does not move the robot. $POS_ACT in an E6POS contains the external axes.
  const Reading alone = run("PTP {A1 1,A2 -90,A3 90,A4 0,A5 0,A6 0,E1 3}\nPTP {E1 5}\nASYPTP {E1 9}");
  REQUIRE(alone.problem() == "no such problem");
  CHECK(first_axes(alone.program) == std::vector<double>{1, 1});
  CHECK(alone.move(1).target.external_axes == std::vector<double>{5});
  REQUIRE(alone.program.skipped.size() == 2);  // the second one names the axis that the robot of the job needs
  CHECK(alone.program.skipped[0].may_move);
  const Reading stands =
      run("E6POS here\nhere={X 1,Y 2,Z 3,A 0,B 0,C 0,E1 7}\nPTP " + pose + "\nhere=$POS_ACT\nhere.Z=1100\nPTP here");
  CHECK(stands.problem() == "no such problem");
  CHECK(std::abs(stands.move(1).target.pose.position.z() - 1.1) < rounding);
}

TEST_CASE("krl: SPL points of passes that are cut off are none of the motion") {
  // The loop is run twice to see that it repeats itself; one pass of two SPL points is kept.
  const std::string spl = "\nSPL {X 1100,Y 50,Z 1000,A 0,B 90,C 0}\nSPL {X 1200,Y 0,Z 1000,A 0,B 90,C 0}\n";
  const std::string ready = "$TOOL=$NULLFRAME\n$BASE=$NULLFRAME\n$VEL.CP=1\n";
  const Reading r = run(ready + "LOOP\nSLIN " + pose + "\nSPLINE" + spl + "ENDSPLINE\nENDLOOP");
  REQUIRE(r.problem() == "no such problem");
  const Reading once = run(ready + "SLIN " + pose + "\nSPLINE" + spl + "ENDSPLINE");
  CHECK(r.program.instructions.size() == once.program.instructions.size());
  CHECK(r.program.instructions.size() > 3);
}

TEST_CASE("krl: nothing behind an endless loop is run, and one that makes none of its moves is reported") {
  // The controller never runs statements after the loop. `n` may be written over the network, which is reported.
  const Reading quiet = run("PTP " + axes(1) + "\nLOOP\nn=1\nENDLOOP\nPTP " + axes(2), "INT n");
  REQUIRE(quiet.problem() == "no such problem");
  CHECK(first_axes(quiet.program) == std::vector<double>{1});
  const std::string machine = "PTP " + axes(1) + "\nn=0\nLOOP\nIF n==1 THEN\nPTP " + axes(2) + "\nENDIF\nENDLOOP";
  const Reading waits = run(machine, "INT n");
  REQUIRE(waits.problem() == "no such problem");
  CHECK(first_axes(waits.program) == std::vector<double>{1});
  REQUIRE(waits.program.skipped.size() == 1);
  CHECK(waits.program.skipped[0].may_move);
  ImportOptions chosen;
  chosen.assume["5"] = Assumption::then_branch;
  CHECK(first_axes(run(machine, "INT n", {}, {Language::krl, chosen}).program) == std::vector<double>{1, 2});
}

TEST_CASE("krl: what a submit program writes to may have any value") {
  // sps.sub runs repeatedly in parallel to the robot program: the value of the data list is not used. Its local names do
  // not change those of the program.
  const std::string body =
      "PTP " + axes(1) + "\nIF ready THEN\nPTP " + axes(2) + "\nENDIF\nIF mine THEN\nPTP " + axes(3) + "\nENDIF";
  const std::string data = "BOOL ready=FALSE\nBOOL mine=TRUE\nDECL BOOL a[2]\na[1]=TRUE\na[2]=a[1]";
  const Files submit{{"sps.sub",
                      "DEF sps()\nDECL BOOL mine\nLOOP\nmine=FALSE\nIF $IN[1]==TRUE THEN\nready = "
                      "TRUE\nENDIF\nENDLOOP\nEND\n"}};
  const Reading r = run(body, data, submit);
  REQUIRE(r.problems.size() == 1);
  CHECK(r.problem().find("'ready' may be written by the submit program sps.sub") != std::string::npos);
  ImportOptions given;
  given.values["ready"] = "TRUE";
  CHECK(first_axes(run(body, data, submit, {Language::krl, given}).program) == std::vector<double>{1, 2, 3});
  CHECK(first_axes(run(body, data).program) == std::vector<double>{1, 3});
}

TEST_CASE("krl: all that a move lacks is asked for in one round") {
  const Reading frames = run("$TOOL=TOOL_DATA[3]\n$BASE=BASE_DATA[4]\nPTP " + pose);
  REQUIRE(frames.problems.size() == 2);
  CHECK_THAT(frames.problem(0) + frames.problem(1),
             Catch::Contains("moves with TOOL_DATA[3]") && Catch::Contains("moves with BASE_DATA[4]"));
  // Three components depend on inputs: one problem names all of them.
  const Reading place = run("DECL FRAME f\nf=" + pose +
                            "\nf.X=$ANIN[1]\nf.Y=$ANIN[2]\nf.Z=$ANIN[3]\n$TOOL=$NULLFRAME\nBAS(#BASE,0)\n"
                            "PTP f");
  REQUIRE(place.problems.size() == 1);
  CHECK_THAT(place.problem(), Catch::Contains("{name: '$anin[1]', value: VALUE}") &&
                                  Catch::Contains("{name: '$anin[2]', value: VALUE}") &&
                                  Catch::Contains("{name: '$anin[3]', value: VALUE}"));
}

TEST_CASE("krl: RSI_MOVECORR leads the robot away, and back where the program says") {
  const Reading led = run("PTP " + axes(1) + "\nRSI_MOVECORR()\nPTP " + axes(2));
  CHECK(first_axes(led.program) == std::vector<double>{1, 2});
  REQUIRE_FALSE(led.program.skipped.empty());
  CHECK(led.program.skipped[0].may_move);
  CHECK(led.program.skipped[0].what == "RSI_MOVECORR: a sensor leads the robot");
  // The axes that the move leaves out are unknown.
  CHECK_THAT(run("PTP " + axes(1) + "\nRSI_MOVECORR()\nPTP {A1 2}").problem(), Catch::Contains("gives some axes only"));
}

TEST_CASE("krl: the remedies of a move of some axes after a pose work") {
  const std::string frames = "$TOOL=$NULLFRAME\n$BASE=$NULLFRAME\n", here = frames + "PTP " + pose + "\n";
  for (const char* move : {"PTP_REL {A1 10}", "PTP {A1 0}"}) {
    const Reading asked = run(here + move);
    REQUIRE(asked.problems.size() == 1);
    CHECK_THAT(asked.problem(), Catch::Contains("the move before goes to a pose") &&
                                    Catch::Contains("or move to axis angles before") &&
                                    Catch::Contains(":$axis_act', value: VALUE}"));
    CHECK(run(here + "PTP " + axes(1) + "\n" + move).problems.empty());
  }
  CHECK(run(here + "PTP " + axes(1)).problems.empty());
}

TEST_CASE("krl controller: words that a move, a record or an enumeration does not have are a warning") {
  const auto warnings = [](const std::string& body, const std::string& move) {
    const Reading reading = run("$VEL.CP=1\n$APO.CDIS=5\n$APO.CPTP=5\nPTP " + pose + "\n" + body + "\n" + move);
    CHECK(reading.problem() == "no such problem");
    std::string lines;
    for (const pipeline::Warning& warning : moves_left_out(reading.program)) lines += warning.line() + "\n";
    return lines;
  };
  for (const auto& [move, word] : std::map<std::string, std::string>{
           {"LIN_REL {X 20} #TOOLL", "write #TOOL if this is meant"},
           {"LIN {X 900} C_DIST", "write C_DIS if this is meant"},
           {"LIN {X 900} C_FOO", "C_FOO: not read, because there is no such word in the marks of a move"},
           {"LIN {X 900,Y 0,Z 900,A 30,B 90,D 10}", "write C if this is meant"},
           {"PTP {A1 10,A2 -90,A3 90,A4 0,A5 60,A6 5}\nPTP {A1 10,A2 -90,A3 90,A4 0,A5 60,A7 20}",
            "write A6 if this is meant"},
           {"LIN {X 900,Y 0,X 800}", "X: given twice in one position; the first one counts"}}) {
    INFO(move);
    CHECK_THAT(warnings("", move), Catch::Contains(word));
  }
  for (const auto& [body, word] :
       std::map<std::string, std::string>{{"$ORI_TYPE=#CONST", "write #CONSTANT if this is meant"},
                                          {"$IPO_MODE=#BASEE", "write #BASE if this is meant"},
                                          {"$VEL.CPP=0.1", "write CP if this is meant"},
                                          {"$APO.CDISS=30", "write CDIS if this is meant"}}) {
    INFO(body);
    CHECK_THAT(warnings(body, "LIN {X 900}"), Catch::Contains(word));
  }
  for (const char* legal :
       {"PTP {X 900,Y 0,Z 900,A 0,B 90,C 0,S 2,T 35,E1 0,E2 0,E3 0,E4 0,E5 0,E6 0} C_PTP C_DIS", "LIN_REL {X 20} #BASE",
        "LIN_REL {X 20} #TOOL C_DIS", "SLIN {X 900} WITH $VEL.CP=0.5 C_SPL",
        "PTP {A1 10,A2 -90,A3 90,A4 0,A5 60,A6 0,E1 3} C_DIS", "$ORI_TYPE=#CONSTANT\n$CIRC_TYPE=#PATH\nLIN {X 900}",
        "$ORI_TYPE=#VAR\n$IPO_MODE=#BASE\nLIN {X 900} C_DIS"}) {
    INFO(legal);
    CHECK(warnings("", legal) == "");
  }
}

TEST_CASE("krl controller: a structure of the program may have components of its own") {
  const Reading reading = run(
      "STRUC spot REAL X,Y,Q\nDECL spot s\ns={X 1,Y 2,Q 3}\ns.Q=4\n$WORKSPACE[1]={X 0,Y 0,Z 0,A 0,B 0,C 0,X1 1,Y1 1,Z1 1,X2 2,Y2 2,Z2 2,MODE #OFF}\n"
      "$CYLWORKSPACE[1]={X 0,Y 0,Z 0,A 0,B 0,C 0,Z1 1,Z2 2,R 3,MODE #OFF,REFERENCE #WORLD,STATE FALSE}\nPTP " +
      axes(1));
  CHECK(reading.problem() == "no such problem");
  CHECK(moves_left_out(reading.program).empty());
}

TEST_CASE("krl controller: settings of turns, $RED_VEL and a path speed that DEF_VEL_CP limits are not silent") {
  const auto read = [](const std::string& settings) {
    return run("$VEL.CP=1\nPTP " + pose + "\n" + settings + "\nLIN {X 900}");
  };
  const Reading turns = read("$VEL.ORI1=200\n$VEL.ORI2=100");
  CHECK(turns.move(1).speed.orientation.value() == Approx(100 * degree).epsilon(rounding));
  CHECK(skips(turns, unlike_turns, true));
  const Reading alike = read("$VEL.ORI1=200\n$VEL.ORI2=200\n$ACC.ORI1=200\n$ACC.ORI2=200\n$RED_VEL=100");
  CHECK(alike.move(1).speed.orientation.value() == Approx(200 * degree).epsilon(rounding));
  CHECK(moves_left_out(alike.program).empty());
  CHECK(skips(read("$ACC.ORI2=20"), turn_acceleration, true));
  CHECK(skips(read("$RED_VEL=50"), reduced_speed, true));
  const Reading limited = run("BAS(#VEL_CP,100)\nPTP " + pose + "\nLIN {X 900}", "", {{"$config.dat", config}});
  CHECK(skips(limited, fast_path, true));
}
