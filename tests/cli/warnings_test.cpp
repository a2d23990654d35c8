// Every warning of a stage, from jobs that provoke it to all outputs that show it.

#include <regex>
#include <set>

#include "pipeline/base/warnings.h"
#include "pipeline/files/files.h"
#include "tests/catch.h"
#include "tests/cli/process.h"

using namespace dresslife::tests;
using namespace dresslife::pipeline;
using Catch::Contains;

namespace {

/// Six wires too many in a layer, of a material whose constants contradict each other.
const std::string dresspack = R"(dresspack:
  name: test hose
  source: made for the tests
  diameter_mm: 40
  mass_kg_per_m: 1.5
  bending_stiffness_Nm2: 2
  torsional_stiffness_Nm2: 2
  axial_stiffness_N: 50000
  damping_time_ms: 20
  damping_source: made for the tests
  materials:
    - {name: odd, source: made for the tests, youngs_modulus_GPa: 117, tensile_strength_MPa: 220, cyclic_strength_MPa: 100,
       fatigue_strength_MPa: 564, fatigue_strength_exponent: -0.1, fatigue_ductility: 0.475,
       fatigue_ductility_exponent: -0.6}
  components:
    - name: cable
      count: 2
      radius_mm: 5
      helix_radius_mm: 10
      lay_angle_deg: 10
      components:
        - {name: wire, count: 66, radius_mm: 0.1, helix_radius_mm: 2, lay_angle_deg: 15, material: odd}
)";

void write_jobs(const Scratch& scratch) {
  write_small_job(scratch);  // for its poses
  const std::string small_steps = "segments: 12, sample_rate_Hz: 50, most_repeats: 2";
  scratch.write("cable.yaml", "motion: {clamp_poses: poses.csv}\n" + dresspack +
                                  "routing: {free_length_m: 0.9}\nsimulation: {" + small_steps +
                                  "}\nstrain: {slip: stick}\n");
  scratch.write("spot.mod",
                "MODULE spot\n"
                "CONST jointtarget a:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
                "CONST jointtarget b:=[[5,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
                "PROC main()\n  MoveAbsJ a,v1000,fine,tool0;\n  SpeedRefresh 0;\n  MoveAbsJ b,v1000,fine,tool0;\n"
                "  MoveAbsJ a,v1000,fine,tool0;\nENDPROC\nENDMODULE\n");
  scratch.write("robot.yaml",
                "robot: abb_irb6640_185_280\nmotion: {program: spot.mod}\n" + dresspack +
                    "routing:\n"
                    "  base_clamp: {link: link_3, position_m: [-0.1, 0, 0.45], direction: [1, 0, 0.45]}\n"
                    "  tool_clamp: {link: link_6, position_m: [0.15, 0, 0.18], direction: [1, 0, -0.35]}\n"
                    "  free_length_m: 2.035\nsimulation: {contact: false, floor: false, " +
                    small_steps + "}\nstrain: {slip: stick}\n");
}

std::vector<Warning> warnings_in(const fs::path& life) {
  return warnings_from(FileReader(life, life_format(), FileReader::Scope::attributes).text_attribute("warnings"));
}

/// Returns the lines of a job that the remedies of warnings propose: "strain.friction_factor: 2.5".
std::set<std::string> lines_in(const std::string& warnings) {
  static const std::regex line(R"(([a-z][a-zA-Z_0-9]*(\.[a-zA-Z_0-9]+)+: )(\[[^\]]*\]|\{[^}]*\}|[^ ,;()]+))");
  std::set<std::string> lines;
  for (std::size_t at = 0; (at = warnings.find("Remedy: ", at)) != std::string::npos; ++at) {
    const std::string remedy = warnings.substr(at, warnings.find('\n', at) - at);
    for (std::sregex_iterator found(remedy.begin(), remedy.end(), line), end; found != end; ++found)
      lines.insert(found->str(1) + found->str(3));
  }
  return lines;
}

}  // namespace

TEST_CASE("a warning on a setting appears when only this setting changes, and goes with it") {
  Scratch scratch;
  write_small_job(scratch);
  must_run(scratch, "dresslife", "run job.yaml");
  const auto warned = [&](const std::string& sets, const std::string& words) {
    must_run(scratch, "dresslife", "run job.yaml" + sets);
    for (const Warning& warning : warnings_in(scratch / "runs/job/job/life.h5"))
      if (warning.words.find(words) != std::string::npos) return true;
    return false;
  };
  for (const auto& [set, words] :
       {std::pair<std::string, std::string>{"strain.gate=0.0003", "strain.gate is 0.0003"},
        {"fatigue.endurance_strain=0.03", "fatigue.endurance_strain is 0.03"},
        {"uncertainty.slack=80", "uncertainty.slack is 80"},
        {"'dresspack.sleeve={thickness_mm: 0.001, material: polyurethane}'", "thickness_mm of the sleeve"}}) {
    CAPTURE(set);
    CHECK_FALSE(warned("", words));
    CHECK(warned(" --set " + set, words));
  }
  CHECK_FALSE(warned("", "thickness_mm of the sleeve"));
}

TEST_CASE("run names file, line and column of a setting that causes a warning") {
  Scratch scratch;
  write_small_job(scratch);
  scratch.write("job.yaml", replaced_all(content(scratch / "job.yaml"), "strain: {slip: stick}",
                                         "strain: {slip: stick, gate: 0.0003}"));
  CHECK_THAT(must_run(scratch, "dresslife", "run job.yaml").err,
             Contains("job: warning: job.yaml:24:29: strain.gate is 0.0003"));
}

TEST_CASE("a remedy is a line that the job takes: of a shipped dresspack, of one of several, of a part of a cable") {
  const Scratch scratch;
  write_jobs(scratch);
  const std::string job = content(scratch / "robot.yaml");
  const std::size_t begin = job.find("dresspack:"), routing = job.find("routing:"), end = job.find("simulation:");
  const std::string shipped = job.substr(0, begin) + "dresspack: handling\n" + job.substr(routing);
  std::string nested = job.substr(routing, end - routing);
  for (std::size_t at = 0; (at = nested.find('\n', at)) != std::string::npos; at += 5) nested.replace(at, 1, "\n    ");
  const std::string several = job.substr(0, begin) + "dresspacks:\n  - name: main hose\n    dresspack: handling\n    " +
                              nested + "\n" + job.substr(end);
  const auto tight = [](const std::string& pack) {  // no room for this slack
    return fmt::format("{0}.components.2.slack_percent: 2\n{0}.components.2.play_mm: 0.5\n", pack);
  };
  std::size_t pasted = 0;
  for (const auto& [text, pack] :
       {std::pair{shipped, std::string("dresspack")}, {several, std::string("dresspacks.1.dresspack")}}) {
    scratch.write("job.yaml", text + tight(pack));
    const Outcome before =
        run(scratch, "dresslife", "run job.yaml --set strain.slip=friction --set uncertainty.enabled=false");
    CAPTURE(text, before.out, before.err);
    REQUIRE(before.status == 0);
    CHECK(before.err.find(pack + ".components.2: 'control cable' is compressed with ") != std::string::npos);
    const std::set<std::string> lines = lines_in(before.err);
    CHECK(lines.contains(pack + ".components.2.slack_percent: 0.14"));  // from the warning whose place is this part
    for (const std::string& remedy : lines) {
      const std::string key = remedy.substr(0, remedy.find(':') + 1);
      std::string changed = content(scratch / "job.yaml");
      if (const std::size_t at = changed.find(key); at != std::string::npos)
        changed.erase(at, changed.find('\n', at) + 1 - at);
      scratch.write("pasted.yaml", changed + remedy + "\n");
      const Outcome after = run(scratch, "dresslife", "check pasted.yaml");
      CAPTURE(remedy, after.out, after.err);
      CHECK((after.status == 0 || after.out.find("The simulation refuses the job: ") != std::string::npos));
      ++pasted;
    }
  }
  CHECK(pasted >= 4);
}

TEST_CASE("a cable without slack: check proposes a value, with which neither check nor run warns") {
  const Scratch scratch;
  write_jobs(scratch);
  const std::string job = content(scratch / "robot.yaml");
  scratch.write("job.yaml",
                job.substr(0, job.find("dresspack:")) + "dresspack: handling\n" + job.substr(job.find("routing:")));
  const std::string proposed = "dresspack.components.2.slack_percent: 1";
  for (const double slack : {0.0, 1.0}) {
    const std::string sets = fmt::format(
        "job.yaml --set strain.slip=friction --set uncertainty.enabled=false --set strain.surface_fibres=0 "
        "--set strain.cable_elements_per_segment=1 --set dresspack.components.2.slack_percent={}",
        slack);
    const Outcome check = run(scratch, "dresslife", "check " + sets), ran = run(scratch, "dresslife", "run " + sets);
    CAPTURE(slack, check.out, ran.out, ran.err);
    CHECK(lines_in(check.out).contains(proposed) == (slack < 1));
    CHECK(((check.out + ran.err).find("slack_percent") != std::string::npos) == (slack < 1));
  }
}

TEST_CASE("every warning of a stage reaches its log, the terminal, ranking.csv and the report") {
  struct Provoked {
    std::string job, sets, kind, words;
  };
  const std::vector<Provoked> all{
      {"robot", "", "program", "spot.mod:6:"},
      {"cable", "--set dresspack.least_bend_radius_mm=2000", "bend_radius", "smallest bend radius: "},
      {"cable", "--set dresspack.most_twist_deg_per_m=0.01", "twist", "(limit 0.01 deg/m, "},
      {"cable", "--set dresspack.most_tension_N=0.01 --set dresspack.bending_stiffness_Nm2=0.02", "tension",
       "largest tension: "},
      {"cable", "--set routing.free_length_m=1.3", "slack", "least slack, length too long"},
      {"cable", "--set simulation.periodic_tolerance_mm=1e-9", "periodic", "after 2 repeats the motion still begins"},
      {"cable", "", "overlap", "the 66 parts 'wire' are 0.1839 mm apart"},
      {"robot", "", "force", "that is unrealistic: do not plan with the hours"},
      {"cable", "", "material", "material odd: K' 100 MPa"},
      // the softer hose bends to 134 mm, the job's own to 142 mm
      {"cable", "--set dresspack.least_bend_radius_mm=138", "other_values",
       "with 0.4 times the stiffness of the dresspack"},
  };
  const Scratch scratch;
  write_jobs(scratch);
  for (const Provoked& one : all) {
    const Outcome outcome = run(scratch, "dresslife", "run " + one.job + ".yaml " + one.sets);
    CAPTURE(one.kind, outcome.out, outcome.err);
    REQUIRE(outcome.status == 0);
    const fs::path folder = scratch / ("runs/" + one.job);
    const std::vector<Warning> warnings = warnings_in(folder / one.job / "life.h5");
    std::string text, words;
    for (const Warning& warning : warnings)
      if (word(warning.kind) == one.kind && text.find(one.words) == std::string::npos)
        text = warning.text(), words = warning.words;
    REQUIRE_THAT(text, Contains(one.words));
    CHECK_THAT(text, Contains(". Likely cause: ") && Contains(". Remedy: ") && !Contains("..."));
    CHECK_THAT(content(folder / one.job / "log"), Contains("warning: ") && Contains(one.words));
    // The terminal names the line of the user's file, not that of the resolved job.
    const std::string place = text.starts_with("dresspack") ? one.job + R"(\.yaml:\d+:\d+: )" : "";
    CHECK(std::regex_search(outcome.err, std::regex(one.job + ": warning: " + place)));
    CHECK_THAT(outcome.err, Contains(words + "\n"));
    CHECK_THAT(outcome.out, Contains("\n   WARNING: "));
    CHECK_THAT(content(folder / "report.html"), Contains(one.words.substr(0, one.words.find('\''))));
    const std::string csv = content(folder / "ranking.csv");
    std::istringstream lines(csv);
    std::string title, row;
    std::getline(lines, title);
    std::getline(lines, row);
    CHECK_THAT(row, Contains(text));
    CHECK_THAT(title, Contains("," + one.kind + "_ok"));
  }
}

TEST_CASE("a log keeps the warnings of a stage whose result was there already, and of one that ran again") {
  const Scratch scratch;
  write_jobs(scratch);
  must_run(scratch, "dresslife", "run cable.yaml");
  const fs::path folder = scratch / "runs/cable/cable";
  const std::vector<Warning> before = warnings_in(folder / "life.h5");
  REQUIRE(before.size() >= 2);  // overlap and material
  must_run(scratch, "dresslife", "run cable.yaml --set fatigue.operating_hours_per_week=40");
  CHECK(warnings_in(folder / "life.h5") == before);
  const std::string log = content(folder / "log");
  for (const Warning& warning : before) CHECK_THAT(log, Contains(warning.line() + "\n"));
  fs::remove(folder / "strain.h5");  // its stage computes an identical file, so the last stage has nothing to do
  must_run(scratch, "dresslife", "run cable.yaml --set fatigue.operating_hours_per_week=40");
  CHECK(content(folder / "log") == log);
}
