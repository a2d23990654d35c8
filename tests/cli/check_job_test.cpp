// dresslife check: what a run would warn of or refuse, without the run.
#include "tests/catch.h"
#include "tests/cli/process.h"

using namespace dresslife::tests;

TEST_CASE("check: a job without faults, one whose slip is a bound, one that is too short, one that is misspelt") {
  Scratch scratch;
  write_small_job(scratch);
  const Outcome bound = run(scratch, "dresslife", "check job.yaml");
  INFO(bound.out << bound.err);
  CHECK(bound.status == 0);
  CHECK(bound.out.find("strain.slip is stick") != std::string::npos);
  const Outcome too_short = run(scratch, "dresslife", "check job.yaml --set routing.free_length_m=0.7");
  CHECK(too_short.status == 1);
  CHECK(too_short.out.find("The simulation refuses the job: ") != std::string::npos);
  CHECK(too_short.out.find("too short") != std::string::npos);
  const Outcome misspelt = run(scratch, "dresslife", "check job.yaml --set routing.free_lenght_m=0.7");
  CHECK(misspelt.status == 1);
  CHECK(misspelt.err.find("did you mean 'free_length_m'?") != std::string::npos);
  const auto entries = std::distance(fs::directory_iterator(scratch.folder()), fs::directory_iterator{});
  CHECK(entries == 4);  // job, poses, .out, .err: a check leaves nothing
}
