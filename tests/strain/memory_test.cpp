#include "strain/memory.h"

#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

using namespace dresslife;

TEST_CASE("memory: samples and sites beyond what strain.h5 numbers are refused with the key to change") {
  const auto refusal = [](double samples, double sites) {
    return pipeline::message_of([&] { strain::check_counts({"motion.h5"}, samples, sites); });
  };
  CHECK(refusal(4294967294.0, 4294967294.0) == "");  // larger than an int
  CHECK(refusal(2147483648.0, 2147483648.0) == "");
  CHECK(refusal(4294967295.0, 1) ==
        "motion.h5: error: holds 4.295e+09 samples (strain.h5 numbers at most 4294967294); choose a lower "
        "simulation.sample_rate_Hz, or split the motion");
  CHECK(refusal(1, 4294967295.0) ==
        "motion.h5: error: has 4.295e+09 sites, fibres of wires in segments (strain.h5 numbers at most 4294967294); "
        "choose fewer simulation.segments or strain.surface_fibres, or split the dresspack");
}
