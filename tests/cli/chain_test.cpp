// The stages as a user runs them: one after the other from the command line, twice, and through a study.
#include <catch2/catch.hpp>
#include <cmath>

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
