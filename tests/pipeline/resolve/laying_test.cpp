// Laying of cables in a hose: which cables are loose by default, and refused inputs.

#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "tests/catch.h"
#include "tests/pipeline/sample_job.h"
#include "tests/pipeline/scratch.h"

using namespace dresslife::pipeline;

namespace {

Job job_with(const std::vector<std::string>& sets) { return job_from(parse_yaml(sample_job, "job.yaml"), sets); }

std::string refusal(const std::vector<std::string>& sets) {
  return message_of([&] { job_with(sets); });
}

bool is_loose(const std::vector<std::string>& sets) {
  const Dresspack dresspack = job_with(sets).dresspacks[0].dresspack;
  return lies_loose(dresspack, dresspack.components[0]);
}

const std::string cable = "dresspack.components.1.", free_cables = "strain.slip=free";

}  // namespace

TEST_CASE("laying: cables are loose in a hose whose inside is known, and else only on request") {
  CHECK_FALSE(is_loose({free_cables}));
  CHECK(is_loose({free_cables, "dresspack.inner_diameter_mm=50"}));
  CHECK(is_loose({free_cables, "dresspack.hose_corrugation={pitch_mm: 5, height_mm: 4.5, wall_mm: 0.8}"}));
  CHECK_FALSE(is_loose({free_cables, "dresspack.inner_diameter_mm=50", cable + "position=held"}));
  CHECK(is_loose({free_cables, "dresspack.inner_diameter_mm=50", cable + "lay_angle_deg=20"}));
  CHECK_FALSE(is_loose({free_cables, "dresspack.inner_diameter_mm=50", cable + "lay_angle_deg=20.1"}));
  CHECK(is_loose({free_cables, cable + "position=loose", cable + "play_mm=3"}));
  const Dresspack given = job_with({free_cables, "dresspack.inner_diameter_mm=50"}).dresspacks[0].dresspack;
  CHECK(*inner_radius(given) == Approx(0.025));
}

TEST_CASE("laying: what cannot be is refused with its place and a remedy") {
  using Catch::Contains;
  CHECK_THAT(refusal({cable + "components.1.slack_percent=1"}),
             Contains("--set " + cable) && Contains("this is a wire"));
  CHECK_THAT(refusal({free_cables, cable + "position=loose"}),
             Contains("how much room it has is not known") && Contains("inner_diameter_mm or its play_mm"));
  CHECK_THAT(refusal({free_cables, cable + "position=loose", cable + "play_mm=3", cable + "lay_angle_deg=30"}),
             Contains("lay angle of 30 deg") && Contains("up to 20 deg"));
  CHECK_THAT(refusal({"strain.slip=stick", cable + "position=loose", cable + "play_mm=3"}),
             Contains("is loose, and sticks to the hose (strain.slip of its level is stick)"));
  CHECK_THAT(refusal({"dresspack.inner_diameter_mm=70"}), Contains("the inner one is the smaller"));
  CHECK_THAT(refusal({"dresspack.inner_diameter_mm=50", "dresspack.core_diameter_mm=51"}),
             Contains("the hose is 50 wide inside"));
  CHECK_THAT(refusal({cable + "slack_percent=-1"}), Contains("slack_percent"));
  CHECK_THAT(refusal({cable + "base_grip_N=0"}), Contains("base_grip_N"));
}

TEST_CASE("laying: a tension without effect is refused, the one of a part with a lay in a cable is not") {
  using Catch::Contains;
  const std::string wire = cable + "components.1.", hose = "dresspack.inner_diameter_mm=50";
  for (const std::string place : {"position=held", "position=loose", "position=auto", "lay_angle_deg=10"}) {
    CAPTURE(place);
    CHECK_THAT(refusal({free_cables, hose, cable + place, cable + "tension_N=2000"}),
               Contains("is 2000 (limit 0: a part right in the dresspack") && Contains("slack_percent"));
  }
  CHECK_THAT(refusal({wire + "lay_angle_deg=0", wire + "tension_N=2"}),
             Contains("is 2 (limit 0: a part without a lay does not press") && Contains("give lay_angle_deg"));
  CHECK(refusal({wire + "lay_angle_deg=5", wire + "tension_N=2"}) == "");
  CHECK(refusal({cable + "tension_N=0"}) == "");
  CHECK_THAT(refusal({hose, "dresspack.core_diameter_mm=8",
                      "dresspack.core_components=[{name: tube, radius_mm: 4, helix_radius_mm: 0, tension_N: 5, "
                      "without_wires: {kind: hose}}]"}),
             Contains("'tube' of core_components has more than a life"));
}
