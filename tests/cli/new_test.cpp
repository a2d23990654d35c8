// dresslife new: a user's first job, which `check` accepts or which lists the entries to fill in.
#include <algorithm>
#include <sstream>

#include "tests/catch.h"
#include "tests/cli/process.h"
#include "tests/sim/program/samples.h"

using namespace dresslife::tests;

namespace {

bool has(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

Outcome make(const Scratch& scratch, const std::string& options) { return run(scratch, "dresslife", "new " + options); }

/// While it exists, programs take this catalogue.
class CatalogueOf {
 public:
  explicit CatalogueOf(const fs::path& folder) { ::setenv("DRESSLIFE_CONFIG", folder.c_str(), 1); }
  ~CatalogueOf() { ::unsetenv("DRESSLIFE_CONFIG"); }
};

/// Writes a program of three targets. For a program of three minutes `new` would try every pose.
void write_short_program(const Scratch& scratch) {
  scratch.write("mine.yaml",
                "name: mine\nsource: a test\nspeed_percent: 50\nsteps:\n  - {joints_deg: [0, 0, 0, 0, 30, 0]}\n"
                "  - {joints_deg: [40, 10, 10, 0, 60, 90]}\n  - {joints_deg: [0, 0, 0, 0, 30, 0]}\n");
}

}  // namespace

TEST_CASE("new: without options it lists what can be chosen, and writes nothing") {
  Scratch scratch;
  const Outcome listed = make(scratch, "");
  CHECK(listed.status == 0);
  CHECK(has(listed.out, "  easy                    Gentle handling\n"));
  for (const char* shelf : {"robots", "programs", "dresspacks"})
    for (const auto& entry : fs::directory_iterator(fs::path(DRESSLIFE_SOURCE_DIR) / "config" / shelf))
      if (entry.path().extension() == ".yaml") CHECK(has(listed.out, "  " + entry.path().stem().string() + " "));
  const Outcome lacking = make(scratch, "job.yaml");
  CHECK(lacking.status == 1);
  CHECK(has(lacking.err, "lacks --robot (nothing was written)"));
  CHECK(!fs::exists(scratch / "job.yaml"));
}

TEST_CASE("new: a routing that exceeds a limit with other values only is better than one that does with its own") {
  Scratch scratch;
  const Outcome made = make(scratch, "--robot kuka_kr16_2 --program '" DRESSLIFE_SOURCE_DIR
                                     "/config/programs/pick_and_place.src' --dresspack control_cable job.yaml");
  INFO(made.out);
  REQUIRE(made.status == 0);
  CHECK(has(unwrapped(made.out), "warning: with 0.4 times the stiffness of the dresspack"));
  CHECK(!has(made.out, "warning: smallest bend radius"));
}

TEST_CASE("new: the clamps of a job of the catalogue with this robot, if check has no warning with them") {
  Scratch scratch;
  write_short_program(scratch);
  const std::string options = "--robot abb_irb6640_185_280 --program mine.yaml ";
  fs::copy(fs::path(DRESSLIFE_SOURCE_DIR) / "config", scratch / "config", fs::copy_options::recursive);
  fs::remove_all(scratch / "config/jobs");
  const CatalogueOf own(scratch / "config");
  REQUIRE(make(scratch, options + "first.yaml").status == 0);
  const std::string first = content(scratch / "first.yaml");
  REQUIRE(has(first, "# Clamps: proposed from the robot's shape"));
  scratch.write("config/jobs/brackets.yaml", replaced_all(first, "mine.yaml", "easy"));
  REQUIRE(make(scratch, options + "second.yaml").status == 0);
  const std::string second = content(scratch / "second.yaml");
  CHECK(has(second, "# Clamps: as in config/jobs/brackets.yaml."));
  CHECK(second.substr(second.find("routing:")) == first.substr(first.find("routing:")));
  CHECK(std::count(second.begin(), second.end(), '\n') <= 15);
}

TEST_CASE("new: a job is the user's once it is edited") {
  Scratch scratch;
  write_short_program(scratch);
  const std::string options = "--robot abb_irb6640_185_280 --program mine.yaml job.yaml";
  REQUIRE(make(scratch, options).status == 0);
  const std::string text = content(scratch / "job.yaml");
  CHECK(make(scratch, options).status == 0);
  scratch.write("job.yaml", text + "# mine\n");
  const Outcome edited = make(scratch, options);
  CHECK(edited.status == 1);
  CHECK(has(edited.err, "job.yaml: error: is there already"));
  CHECK(make(scratch, options + " --force").status == 0);
  CHECK(content(scratch / "job.yaml") == text);
}

TEST_CASE("new: proposed clamps pass check, and files are named from the job's folder") {
  Scratch scratch;
  write_short_program(scratch);
  int without_warnings = 0;  // the search takes seconds, so it may end beside a limit for one of three robots
  for (const std::string robot : {"abb_irb2600_12_165", "abb_irb4600_60_205", "fanuc_m20ia"}) {
    const std::string job = "cell/" + robot + ".yaml";
    const Outcome made = make(scratch, "--robot " + robot + " --program mine.yaml --dresspack handling " + job);
    INFO(made.out << made.err);
    REQUIRE(made.status == 0);
    CHECK(has(content(scratch / job), "motion: ../mine.yaml"));
    CHECK(has(content(scratch / job), "# Clamps: proposed from the robot's shape; put your brackets here."));
    const Outcome check = run(scratch, "dresslife", "check " + job);
    INFO(check.out << check.err);
    CHECK(check.status == 0);
    without_warnings += has(check.out, "no warnings");
    CHECK(has(made.out + made.err, "warning: ") != has(check.out, "no warnings"));  // new states what check does
  }
  CHECK(without_warnings >= 2);
}

TEST_CASE("new: what the search refuses names no temporary file") {
  Scratch scratch;
  write_short_program(scratch);
  const std::string robot = content(fs::path(DRESSLIFE_SOURCE_DIR) / "config/robots/kuka_kr16_2.yaml");
  scratch.write("fat.yaml", replaced_all(robot, "radius_mm: 77}",
                                         "radius_mm: 900}"));  // its link_4 encloses all places for a clamp
  const Outcome made = make(scratch, "--robot ./fat.yaml --program mine.yaml --dresspack handling job.yaml");
  INFO(made.err);
  CHECK(made.status == 1);
  CHECK(made.err.starts_with("no place within 150 mm of the surface of link_3 stays clear"));
  CHECK(has(made.err, "dresslife route has the options --bracket, --from and --to"));
  CHECK_FALSE(has(made.err, "draft.yaml"));
  CHECK(!fs::exists(scratch / "job.yaml"));
}

TEST_CASE("new: the space of a tool without a shape is kept clear, as a line of the job") {
  Scratch scratch;
  scratch.write("mine.mod", R"(MODULE mine
PERS tooldata gun := [TRUE,[[0,0,250],[1,0,0,0]],[3,[0,0,50],[1,0,0,0],0,0,0]];
CONST jointtarget a := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
CONST jointtarget b := [[30,10,5,0,40,20],[9E9,9E9,9E9,9E9,9E9,9E9]];
PROC main()
MoveAbsJ a,v500,fine,gun;
MoveAbsJ b,v500,fine,gun;
MoveAbsJ a,v500,fine,gun;
ENDPROC
ENDMODULE
)");
  const Outcome made = make(scratch, "--robot abb_irb2600_12_165 --program mine.mod --dresspack handling job.yaml");
  INFO(made.out << made.err);
  REQUIRE(made.status == 0);
  CHECK(has(unwrapped(made.out), "ESTIMATE: the shape of the tool, robot.links.7."));
  const std::string job = content(scratch / "job.yaml");
  CHECK(has(job, "\n# ESTIMATE: the space of the tool"));
  CHECK(has(job, "\nrobot.links.7."));
  const Outcome check = run(scratch, "dresslife", "check job.yaml");
  INFO(check.out << check.err);
  CHECK(check.status == 0);
  CHECK_FALSE(has(check.out, "The space of the tool is not known"));
}

TEST_CASE("new and check say of a dresspack what no routing cures, and list what its data sheet leaves out") {
  Scratch scratch;
  scratch.write(
      "hose.yaml",
      "name: hose\nsource: a catalogue\ndiameter_mm: 29\ninner_diameter_mm: 23\nhose_material: hose_polyamide\n"
      "least_bend_radius_mm: 110\ncomponents:\n"
      "  - {name: lead, helix_radius_mm: 0, data_sheet: '7 x 0.5 mm2, outer diameter 8.2 mm'}\n");
  write_short_program(scratch);
  const std::string
      doubt = "hose.yaml:1:1: warning: the smooth wall of the hose (29 mm outside, 23 mm inside) has E I 34.6 N m2",
      estimate =
          "ESTIMATE, not in the dresspack: data_sheet of lead: conductor_class 6 (class 5 has wires of 0.2 mm: lives in bending 2 to about 4 times shorter), "
          "wire_diameter_mm 0.15, ";
  const Outcome made = make(scratch, "--robot kuka_kr16_2 --program mine.yaml --dresspack hose.yaml job.yaml");
  INFO(made.out << made.err);
  REQUIRE(made.status == 0);
  CHECK(has(unwrapped(made.out), doubt));
  CHECK(has(unwrapped(made.out), estimate));
  const Outcome check = run(scratch, "dresslife", "check job.yaml");
  INFO(check.out << check.err);
  CHECK(has(unwrapped(check.out), doubt));
  CHECK(has(unwrapped(check.out), estimate));
}

TEST_CASE(
    "new: where no routing keeps all limits, the warnings that remain stand on the terminal and in the job, as check gives them") {
  Scratch scratch;
  write_short_program(scratch);
  std::string hose = content(fs::path(DRESSLIFE_SOURCE_DIR) / "config/dresspacks/spot_welding.yaml");
  hose.insert(hose.find("\ndiameter_mm:"),
              "\nleast_bend_radius_mm: 400");  // more than a swinging hose keeps; at rest there are routings
  scratch.write("hose.yaml", hose);
  const Outcome made = make(scratch, "--robot abb_irb6640_185_280 --program mine.yaml --dresspack hose.yaml job.yaml");
  INFO(made.out << made.err);
  REQUIRE(made.status == 0);
  CHECK(has(unwrapped(made.out), " above, or dresslife route job.yaml, which searches longer."));
  CHECK(has(unwrapped(made.out), "longer than `dresslife new`") == has(unwrapped(made.out), "other clamps"));
  int warnings = 0;
  std::istringstream lines(unwrapped(run(scratch, "dresslife", "check job.yaml").out));
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("warning: ")) continue;
    ++warnings;
    CHECK(has(unwrapped(made.out), line + "\n"));
    CHECK(has(content(scratch / "job.yaml"), "# " + line + "\n"));
  }
  CHECK(warnings > 0);  // of a short run, whose radius depends on the number of segments
}

TEST_CASE("new: a length that leads to other warnings is written if their remedies leave none") {
  Scratch scratch;
  const Outcome made =
      make(scratch, "--robot abb_irb6640_185_280 --dresspack sensor_cable --program '" DRESSLIFE_SOURCE_DIR
                    "/config/programs/side_panel.mod' job.yaml");
  INFO(made.out << made.err);
  REQUIRE(made.status == 0);
  CHECK_FALSE(has(made.out, "keeps all limits"));
  // Of the longer hose, the side and the bend at a clamp cause warnings. Reliefs at the clamps are a remedy of the second.
  CHECK(has(content(scratch / "job.yaml"), "bend_relief: {length_mm: "));
  CHECK(has(content(scratch / "job.yaml"), "  side: "));
  CHECK(has(run(scratch, "dresslife", "check job.yaml").out, "job.yaml: no warnings"));
}

TEST_CASE("new: a slack that check proposes stands in the job, and check of the job has no warnings") {
  Scratch scratch;
  write_short_program(scratch);
  std::string hose = content(fs::path(DRESSLIFE_SOURCE_DIR) / "config/dresspacks/spot_welding.yaml");
  const std::size_t slack = hose.find("slack_percent: ");
  REQUIRE(slack != std::string::npos);
  hose.replace(slack, hose.find('\n', slack) - slack, "slack_percent: 0.05");
  scratch.write("hose.yaml", hose);
  const Outcome made = make(scratch, "--robot abb_irb6640_185_280 --program mine.yaml --dresspack hose.yaml job.yaml");
  INFO(made.out << made.err);
  REQUIRE(made.status == 0);
  CHECK_FALSE(has(made.out, "warning: "));
  CHECK(has(content(scratch / "job.yaml"), "\ndresspack.components.1.slack_percent: "));
  CHECK(has(run(scratch, "dresslife", "check job.yaml").out, "job.yaml: no warnings"));
}

TEST_CASE("new: clamps of which none runs are left to be filled in, without a place in a file that is gone") {
  Scratch scratch;
  scratch.write("hose.yaml",
                "name: hose\nsource: a guess\ndiameter_mm: 190\nmass_kg_per_m: 40\nbending_stiffness_Nm2: 400\n"
                "torsional_stiffness_Nm2: 400\naxial_stiffness_N: 1e5\ndamping_time_ms: 20\ndamping_source: a guess\n");
  // An arm of bare cylinders with the lengths of a KR 16: a hose of 190 mm cannot pass its wrist.
  struct Axis {
    const char *name, *place, *axis;
    double limit, speed;
  };
  std::string arm = "<robot name=\"arm\"><link name=\"base_link\"/>";
  std::string parent = "base_link";
  for (const Axis& of : {Axis{"1", "0 0 0.675", "0 0 -1", 3.2289, 2.7227},
                         {"2", "0.26 0 0", "0 1 0", 2.7053, 2.7227},
                         {"3", "0.68 0 0", "0 1 0", 2.6878, 2.7227},
                         {"4", "0.67 0 -0.035", "-1 0 0", 6.1087, 5.7596},
                         {"5", "0 0 0", "0 1 0", 2.2689, 5.7596},
                         {"6", "0.158 0 0", "-1 0 0", 6.1087, 10.7338}}) {
    const std::string link = std::string("link_") + of.name;
    arm += "<link name=\"" + link +
           "\"><collision><geometry><cylinder radius=\"0.08\" length=\"0.3\"/></geometry></collision></link>";
    arm += "<joint name=\"joint_" + std::string(of.name) + "\" type=\"revolute\"><parent link=\"" + parent +
           "\"/><child link=\"" + link + "\"/><origin xyz=\"" + of.place + "\"/><axis xyz=\"" + of.axis +
           "\"/><limit effort=\"1\" lower=\"" + std::to_string(-of.limit) + "\" upper=\"" + std::to_string(of.limit) +
           "\" velocity=\"" + std::to_string(of.speed) + "\"/></joint>";
    parent = link;
  }
  scratch.write("arm.urdf", arm + "</robot>\n");
  const std::string hard = content(fs::path(DRESSLIFE_SOURCE_DIR) / "config/programs/hard.yaml");
  scratch.write("round.yaml", edited(hard, "repeat: 12", "repeat: 1"));
  const Outcome made = make(scratch, "--robot arm.urdf --program round.yaml --dresspack hose.yaml mine.yaml");
  INFO(made.out << made.err);
  REQUIRE(made.status == 0);
  const std::string text = content(scratch / "mine.yaml");
  INFO(text);
  CHECK(has(made.out, "Fill in its clamps, or let dresslife route mine.yaml search"));
  CHECK(has(text, "# FILL IN clamps, or let dresslife route mine.yaml search. No routing that was tried runs."));
  CHECK(has(text, "\n# routing:\n#   base_clamp: "));
  for (const std::string& words : {made.out, text}) CHECK_FALSE(has(words, "job.yaml"));
}

TEST_CASE("new: what is missing is to be filled in, and check asks for it") {
  Scratch scratch;
  REQUIRE(make(scratch, "--robot abb_irb6640_185_280 job.yaml").status == 0);
  CHECK(has(content(scratch / "job.yaml"), "# FILL IN your program"));
  const Outcome check = run(scratch, "dresslife", "check job.yaml");
  CHECK(check.status == 1);
  CHECK(has(check.err, "motion is missing"));
  scratch.write("arm.urdf", edited(palletizer, "upper=\"6\" effort=\"0\" velocity=\"6\"",
                                   "upper=\"6\" effort=\"0\" velocity=\"180\""));  // deg/s
  const Outcome urdf = make(scratch, "--robot arm.urdf --dresspack sensor_cable arm.yaml");
  INFO(urdf.err);
  REQUIRE(urdf.status == 0);
  const std::string job = content(scratch / "arm.yaml");
  CHECK(has(job, "# A URDF has no accelerations. These are an ESTIMATE"));
  CHECK(has(job, "\nrobot: {urdf: arm.urdf, accelerations_deg_per_s2: ["));
  CHECK(has(urdf.out, "ESTIMATE: the accelerations of its axes"));
  CHECK(has(urdf.out, "arm.urdf:28: warning: velocity of j4 is 180 rad/s"));
  CHECK(has(urdf.out, "velocity=\"3.142\" if that was deg/s"));
  CHECK_FALSE(has(run(scratch, "dresslife", "check arm.yaml").err, "accelerations"));
}

TEST_CASE("new: names that are no names are answered with those that are near") {
  Scratch scratch;
  const auto refused = [&](const std::string& options) {
    const Outcome made = make(scratch, options + " job.yaml");
    CHECK(made.status == 1);
    CHECK(!fs::exists(scratch / "job.yaml"));
    return made.err;
  };
  CHECK(has(refused("--robot kuka_kr162"),
            "--robot: error: 'kuka_kr162' is not in the catalogue (config/robots); did "
            "you mean 'kuka_kr16_2'? one of: "));
  CHECK(has(refused("--robot kuka_kr16_2 --dresspack spotwelding"), "did you mean 'spot_welding'?"));
  CHECK(has(refused("--robot kuka_kr16_2 --program hrad"), "--program: error: 'hrad' is not in the catalogue"));
  CHECK(has(refused("--robot nowhere.urdf"), "nowhere.urdf"));
  // A program that the robot cannot run.
  CHECK(has(
      refused("--robot kuka_kr210_l150 --program easy"),
      "nothing was written; correct the errors above; dresslife route has the options --bracket, --from and --to; for keys "
      "motion.KEY write {program: FILE, KEY: VALUE, ...} into a file MOTION.yaml, and give --program MOTION.yaml"));
}
