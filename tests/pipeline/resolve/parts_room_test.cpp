// Parts outside the bore or the dresspack, or inside its core: refused with a distance in mm, however the bore is known.
#include "pipeline/job/parts_room.h"

#include "pipeline/cable/overlap.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "tests/catch.h"
#include "tests/pipeline/sample_job.h"
#include "tests/pipeline/scratch.h"

using namespace dresslife::pipeline;
using Catch::Contains;

namespace {

/// Returns a dresspack with these keys and one cable of 11 mm at a distance from the axis.
std::string pack(const std::string& keys, double helix_radius_mm, const std::string& parts = "") {
  return "name: hose\nsource: made up\ndiameter_mm: 60\nbending_stiffness_Nm2: 20\n" + keys + "components:\n" + parts +
         fmt::format(
             "  - {{name: cable, radius_mm: 5.5, helix_radius_mm: {}, components: [{{name: core, radius_mm: 2, "
             "helix_radius_mm: 0, components: [{{name: wire, count: 6, radius_mm: 0.2, helix_radius_mm: 1, "
             "lay_angle_deg: 5, material: copper}}]}}]}}\n",
             helix_radius_mm);
}

std::string refusal(const std::string& text) {
  const Scratch scratch;
  return message_of([&] { read_dresspack(scratch.write("hose.yaml", text)); });
}

}  // namespace

TEST_CASE("parts room: a cable outside the bore is refused with how far, and the remedy cures it") {
  const std::string words = refusal(pack("inner_diameter_mm: 52\n", 23.75));
  CHECK_THAT(words,
             Contains("hose.yaml:7:5: error: 'cable' reaches 29.25 mm from the axis, 3.25 mm outside the hose's bore "
                      "(radius 26 mm); give helix_radius_mm: 20.5 or less, or inner_diameter_mm: 58.5 or more"));
  CHECK(refusal(pack("inner_diameter_mm: 52\n", 20.5)) == "");
  CHECK(refusal(pack("inner_diameter_mm: 58.5\n", 23.75)) == "");
  CHECK_THAT(refusal(pack("hose_corrugation: {pitch_mm: 5, height_mm: 4.5, wall_mm: 0.8}\n", 23.75)),
             Contains("3.75 mm outside the hose's bore") && Contains("or diameter_mm: 67.5 or more"));
  CHECK_THAT(
      refusal(pack("inner_diameter_mm: 52\nhose_corrugation: {pitch_mm: 5, height_mm: 4, wall_mm: 0.8}\n", 23.75)),
      Contains("or inner_diameter_mm: 58.5 and diameter_mm: 66.5 or more"));
  // A caliper's error, 2 % of 11 mm, is accepted.
  CHECK(refusal(pack("inner_diameter_mm: 52\n", 20.71)) == "");
  CHECK_THAT(refusal(pack("inner_diameter_mm: 52\n", 20.73)), Contains("outside the hose's bore"));
}

TEST_CASE("parts room: a cable in the core, or outside of a dresspack without a hose, is refused with how far") {
  CHECK_THAT(refusal(pack("inner_diameter_mm: 52\ncore_diameter_mm: 26\n", 17)),
             Contains("'cable' begins 11.5 mm from the axis, 1.5 mm inside the core (core_diameter_mm is 26); give "
                      "helix_radius_mm: 18.5 or more, or core_diameter_mm: 23 or less"));
  CHECK(refusal(pack("inner_diameter_mm: 52\ncore_diameter_mm: 26\n", 18.5)) == "");
  CHECK_THAT(refusal("name: c\nsource: s\ndiameter_mm: 10\ncomponents:\n  - {name: core, count: 3, radius_mm: 2, "
                     "helix_radius_mm: 3.5, components: [{name: wire, count: 6, radius_mm: 0.2, helix_radius_mm: 1, "
                     "lay_angle_deg: 5, material: copper}]}\n"),
             Contains("'core' reaches 5.5 mm from the axis, 0.5 mm outside the dresspack (radius 5 mm)"));
}

TEST_CASE("parts room: parts that have no room wherever they are put are refused at once, and the remedy is final") {
  const auto two = [](const std::string& bore, const std::string& lead, const std::string& other) {
    return refusal("name: hose\nsource: test\ndiameter_mm: 40\nhose_material: hose_polyamide\n" + bore +
                   "\ncomponents:\n  - {name: lead, " + lead +
                   ", data_sheet: '12 x 1.5 mm2, OD 14 mm'}\n"
                   "  - {name: tube, radius_mm: 4, " +
                   other + ", without_wires: {kind: hose, bore_mm: 5.5}}\n");
  };
  const std::string narrow = "inner_diameter_mm: 23";
  for (const auto& [lead, tube] : {std::pair{"5", "7"}, {"0", "7"}, {"0", "11"}, {"7", "11"}}) {
    CAPTURE(lead, tube);
    const std::string words =
        two(narrow, "helix_radius_mm: " + std::string(lead), "phase_deg: 180, helix_radius_mm: " + std::string(tube));
    CHECK_THAT(words, Contains("'lead' (14 mm) and 'tube' (8 mm) do not fit into the bore of 23 mm") &&
                          Contains("around 'lead' in the middle are 4.5 mm") &&
                          Contains("inner_diameter_mm: 28.1 or more") && !Contains("give helix_radius_mm"));
  }
  CHECK(two("inner_diameter_mm: 28.1", "place: auto", "place: auto") == "");
  // The parts do not fit at their given places, but they fit at other places.
  CHECK_THAT(two("inner_diameter_mm: 29", "helix_radius_mm: 0", "helix_radius_mm: 10"),
             Contains("do not fit into the bore of 29 mm as they lie") && Contains("write place: auto for both"));
  CHECK(two("inner_diameter_mm: 29", "place: auto", "place: auto") == "");
  CHECK_THAT(two("inner_diameter_mm: 30\ncore_diameter_mm: 10\ncore_bending_stiffness_Nm2: 0.1", "helix_radius_mm: 8",
                 "helix_radius_mm: 9"),
             Contains("'lead' is 14 mm thick (between the core of 10 mm and the bore of 30 mm are 10 mm)") &&
                 Contains("inner_diameter_mm: 38 or more"));
  // If a cable is thicker than the bore, the message is not about its cores.
  const std::string thick =
      refusal("name: hose\nsource: test\ndiameter_mm: 29\nhose_material: hose_polyamide\n" + narrow +
              "\ncomponents:\n  - {name: lead, helix_radius_mm: 0, data_sheet: '7 x 0.5 mm2, OD 25 mm'}\n");
  CHECK_THAT(thick, Contains("the cable is 25 mm thick (the hose is 23 mm wide inside)") && !Contains("core"));
}

TEST_CASE(
    "parts room: the bore of a hose is asked for, and that of cables in something is an ESTIMATE that is marked") {
  CHECK_THAT(
      refusal(pack("hose_material: hose_polyamide\n", 10)),
      Contains("hose_material is given and the hose's bore is not") &&
          Contains("usually hose_corrugation: {pitch_mm: 5.06, height_mm: 4.5, wall_mm: 0.787} (ESTIMATE). Of a smooth "
                   "pipe give inner_diameter_mm alone"));
  const Scratch scratch;
  const auto warnings_at = [&](double helix_radius_mm) {
    return overlap_warnings(read_dresspack(scratch.write("hose.yaml", pack("", helix_radius_mm))));
  };
  CHECK(warnings_at(20).empty());
  const auto warnings = warnings_at(22);
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0].words, Contains("2 mm outside a bore of 25.5 mm radius, which is an ESTIMATE") &&
                                    Contains("Likely cause: the bore is not given") &&
                                    Contains("Remedy: give inner_diameter_mm as measured"));
  // A single cable in its jacket is as wide as its dresspack.
  const Dresspack alone = read_dresspack(DRESSLIFE_SOURCE_DIR "/config/dresspacks/control_cable.yaml");
  CHECK_FALSE(room_of_parts(alone).estimated);
  CHECK(room_of_parts(alone).bore == alone.diameter / 2);
}
