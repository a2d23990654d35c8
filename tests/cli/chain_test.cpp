// The stages as a user runs them: one after the other on the command line, twice, and in a study.
#include <algorithm>
#include <cstdlib>

#include "pipeline/files/files.h"
#include "tests/catch.h"
#include "tests/cli/process.h"

using namespace dresslife::tests;

namespace {

Outcome sim(const Scratch& s, const std::string& more = "", const std::string& out = "motion.h5") {
  return run(s, "dresslife-sim", "job.yaml -o " + out + " " + more);
}
Outcome strain(const Scratch& s, const std::string& more = "", const std::string& out = "strain.h5") {
  return run(s, "dresslife-strain", "motion.h5 -o " + out + " " + more);
}
Outcome fatigue(const Scratch& s, const std::string& more = "", const std::string& out = "life.h5") {
  return run(s, "dresslife-fatigue", "strain.h5 -o " + out + " " + more);
}

}  // namespace

TEST_CASE("the three stages run one after the other, and the same input gives the same bytes") {
  Scratch scratch;
  write_small_job(scratch);
  for (const auto& outcome : {sim(scratch), strain(scratch), fatigue(scratch)}) {
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    CHECK(outcome.out.empty());
  }
  REQUIRE(sim(scratch, "--quiet", "again.h5").status == 0);
  CHECK(content(scratch / "motion.h5") == content(scratch / "again.h5"));
  REQUIRE(strain(scratch, "--quiet", "again.h5").status == 0);
  CHECK(content(scratch / "strain.h5") == content(scratch / "again.h5"));
  REQUIRE(fatigue(scratch, "--quiet", "again.h5").status == 0);
  CHECK(content(scratch / "life.h5") == content(scratch / "again.h5"));
}

TEST_CASE("the option --quiet says nothing, and --set reaches every stage") {
  Scratch scratch;
  write_small_job(scratch);
  REQUIRE(sim(scratch, "--quiet --set simulation.segments=8").err.empty());
  REQUIRE(strain(scratch, "--quiet --set strain.slip=free").err.empty());
  REQUIRE(fatigue(scratch, "--quiet --set fatigue.stress=elastic").err.empty());
  const std::string elastic = content(scratch / "life.h5");
  REQUIRE(fatigue(scratch, "--quiet").status == 0);
  CHECK(content(scratch / "life.h5") != elastic);
}

TEST_CASE("help and version exit with 0 and say what the program is for") {
  Scratch scratch;
  for (const std::string program : {"dresslife", "dresslife-sim", "dresslife-strain", "dresslife-fatigue"}) {
    const Outcome help = run(scratch, program, "--help");
    CHECK(help.status == 0);
    CHECK(help.out.find("Example: ") != std::string::npos);
    const Outcome version = run(scratch, program, "--version");
    CHECK(version.status == 0);
    CHECK(version.out.rfind(program + " ", 0) == 0);
  }
}

TEST_CASE("a wrong command line exits with 2") {
  Scratch scratch;
  write_small_job(scratch);
  CHECK(run(scratch, "dresslife-sim", "job.yaml").status == 2);
  CHECK(run(scratch, "dresslife-sim", "job.yaml -o a.h5 --fast").status == 2);
  CHECK(run(scratch, "dresslife-strain", "").status == 2);
  CHECK(run(scratch, "dresslife", "fly").status == 2);
  CHECK(run(scratch, "dresslife", "").status == 2);
}

TEST_CASE("a stage refuses settings that its input was not made with") {
  Scratch scratch;
  write_small_job(scratch);
  REQUIRE(sim(scratch).status == 0);
  const Outcome outcome = strain(scratch, "--set simulation.segments=9");
  CHECK(outcome.status == 1);
  CHECK(outcome.err.find("motion.h5: error: was made with other settings of robot, motion, dresspack, "
                         "routing or simulation") == 0);
  CHECK_FALSE(fs::exists(scratch / "strain.h5"));
}

TEST_CASE("a hose with a profile and critical planes from a job file to the life") {
  Scratch scratch;
  write_small_job(scratch);
  std::string job = content(scratch / "job.yaml");
  const std::string components = "  components:\n    - name: cable";
  REQUIRE(job.find(components) != std::string::npos);
  job.replace(job.find(components), 0,
              "  hose_material: hose_polyamide\n"
              "  hose_corrugation: {pitch_mm: 4, height_mm: 3.5, wall_mm: 0.6}\n");
  job.replace(job.find("strain: {slip: stick}"), std::string::npos,
              "strain: {slip: stick, equivalent: critical_plane}\n");
  scratch.write("job.yaml", job);
  REQUIRE(sim(scratch, "--quiet").status == 0);
  REQUIRE(strain(scratch, "--quiet").status == 0);
  const Outcome told = fatigue(scratch);
  REQUIRE(told.status == 0);
  CHECK(told.err.find("hose's wall ") != std::string::npos);
  namespace pipeline = dresslife::pipeline;
  const pipeline::FileReader planes(scratch / "life.h5", pipeline::life_format());
  CHECK(planes.number_attribute("hose_life_hours") > 0);
  CHECK(planes.text_attribute("hose_component").starts_with("hose "));
  CHECK(planes.text_attribute("worst_component").starts_with("cable "));
  CHECK(planes.has_attribute("worst_plane_angle"));
  CHECK(planes.rows("/plane/site") >= 12);  // at least one wire of each segment
  const auto site = planes.read<std::uint32_t>("/plane/site");
  const auto damage = planes.read<double>("/damage"), judged = planes.read<double>("/plane/damage");
  double worst = 0;
  for (std::size_t k = 0; k < site.size(); ++k) {
    CHECK(damage[site[k]] == judged[k]);
    worst = std::max(worst, judged[k]);
  }
  CHECK(planes.number_attribute("damage_per_repeat") == worst);

  // The plane across the axis is among the evaluated planes: no wire lives longer than by its strain alone, apart from the effect
  // of the gate.
  REQUIRE(strain(scratch, "--quiet --set strain.equivalent=axial --set strain.gate=0", "axial.h5").status == 0);
  must_run(scratch, "dresslife-fatigue", "axial.h5 -o axial_life.h5 --quiet");
  const auto axial = pipeline::FileReader(scratch / "axial_life.h5", pipeline::life_format()).read<double>("/damage");
  REQUIRE(axial.size() == damage.size());
  constexpr double single = 1e-4;  // strains in single precision by two algorithms, times the slope of the life curve
  for (std::size_t k = 0; k < site.size(); ++k) CHECK(judged[k] >= axial[site[k]] * (1 - single));

  const Outcome wrong = strain(scratch, "--set strain.equivalent=planes");
  CHECK(wrong.status == 1);
  CHECK(wrong.err.find("critical_plane") != std::string::npos);
}

TEST_CASE("friction gives the same bytes twice and with any number of threads") {
  Scratch scratch;
  write_small_job(scratch);
  std::string job = content(scratch / "job.yaml");
  for (const std::string part : {"helix_radius_mm: 10\n", "lay_angle_deg: 15, "}) {
    const bool own_line = part.ends_with('\n');
    const std::string friction = own_line ? "      friction_coefficient: 0.3\n      radial_line_load_N_per_m: 30\n"
                                          : "friction_coefficient: 0.3, radial_line_load_N_per_m: 5, ";
    job.insert(job.find(part) + part.size(), friction);
  }
  job.replace(job.find("slip: stick"), std::string("slip: stick").size(), "slip: friction");
  scratch.write("job.yaml", job);
  REQUIRE(sim(scratch, "--quiet").status == 0);
  const Outcome first = strain(scratch, "--quiet");
  INFO(first.err);
  REQUIRE(first.status == 0);
  const std::string once = content(scratch / "strain.h5");
  for (const char* threads : {"1", "2", "5"}) {
    ::setenv("DRESSLIFE_THREADS", threads, 1);
    REQUIRE(strain(scratch, "--quiet").status == 0);
    const bool same = content(scratch / "strain.h5") == once;
    CHECK(same);
  }
  ::unsetenv("DRESSLIFE_THREADS");
}
