// What a user may plausibly write wrong, and what the programs answer: the file and the line, the problem, and a remedy.
// Exit status 1 (2 for a wrong command line), nothing on standard output, no file left behind.
#include <fmt/format.h>

#include <algorithm>
#include "tests/catch.h"
#include "tests/cli/process.h"

using namespace dresslife::tests;
using Catch::Matchers::Contains;

namespace {

const std::string job = R"(robot: abb_irb6640_185_280
motion:
  name: nod
  source: mine
  steps:
    - {text: home, joints_deg: [0, 0, 0, 0, 30, 0]}
    - {text: nod, joints_deg: [20, 0, 0, 0, 60, 90], speed_percent: 50}
    - {text: wait, dwell_s: 0.5}
dresspack: hose.yaml
routing:
  base_clamp: {link: link_3, position_m: [-0.1, 0, 0.45], direction: [1, 0, 0.45]}
  tool_clamp: {link: link_6, position_m: [0.15, 0, 0.18], direction: [1, 0, -0.35]}
  free_length_m: 2.035
simulation: {segments: 24, contact: false}
)";

const std::string hose = R"(name: hose
source: mine
diameter_mm: 50
inner_diameter_mm: 42
mass_kg_per_m: 1.2
bending_stiffness_Nm2: 2
torsional_stiffness_Nm2: 1.6
axial_stiffness_N: 50000
damping_time_ms: 10
damping_source: a guess
components:
  - name: lead
    count: 4
    radius_mm: 4.1
    helix_radius_mm: 14
    slack_percent: 1
    components:
      - {name: core, count: 3, radius_mm: 1.2, helix_radius_mm: 1.5, lay_angle_deg: 8, components: [{name: wire, count: 19, radius_mm: 0.1, helix_radius_mm: 0.8, lay_angle_deg: 5, material: copper}]}
)";

const std::string module =
    "MODULE spot\n"
    "CONST jointtarget a:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
    "PROC main()\n  MoveAbsJ a,v1000,fine,tool0;\nENDPROC\nENDMODULE\n";

const std::string study = "base: job.yaml\nvary:\n  routing.free_length_m: [2.0, 2.1]\n";

struct Wrong {
  std::string in;              ///< file that is changed
  std::string from, to;        ///< in it; from empty: the file becomes `to`
  std::string place;           ///< begin of the answer
  std::string problem, remedy; ///< in the answer
  std::string command = "dresslife-sim job.yaml --preview -o out.h5";
  int status = 1;
};

const std::string draw = "dresslife draw hose.yaml", run_study = "dresslife run study.yaml";

const Wrong wrong[] = {
    // A job's names
    {"job.yaml", "abb_irb6640_185_280", "abb_irb6640", "job.yaml:1:8: error: ", "'abb_irb6640' is not in the catalogue", "abb_irb6640_185_280"},
    {"job.yaml", "hose.yaml", "hoses.yaml", "job.yaml:9:12: error: ", "hoses.yaml", "; "},
    {"job.yaml", "link: link_3", "link: link3", "job.yaml:11:15: error: ", "'link3' is not a link of the robot", "one of: base_link, link_1"},
    {"job.yaml", "segments: 24", "segmets: 24", "job.yaml:14:14: error: ", "unknown key 'simulation.segmets'", "did you mean 'segments'?"},
    {"job.yaml", "free_length_m: 2.035", "free_length_mm: 2035", "job.yaml:13:3: error: ", "unknown key 'routing.free_length_mm'", "its unit is m, write 'free_length_m'"},
    {"job.yaml", "dresspack: hose.yaml\n", "", "job.yaml:1:1: error: ", "dresspack is missing", "give dresspack and routing"},
    {"job.yaml", "  free_length_m: 2.035\n", "", "job.yaml:11:3: error: ", "routing.free_length_m is missing", "; "},
    {"job.yaml", "{link: link_6, position_m", "{link: link_6, positions_m", "job.yaml:12:", "unknown key 'routing.tool_clamp.positions_m'", "did you mean 'position_m'?"},
    // A job's values
    {"job.yaml", "free_length_m: 2.035", "free_length_m: 2.035 m", "job.yaml:13:18: error: ", "'2.035 m' (must be a number", "; "},
    {"job.yaml", "free_length_m: 2.035", "free_length_m: 2,035", "job.yaml:13:18: error: ", "'2,035' (must be a number", "; "},
    {"job.yaml", "free_length_m: 2.035", "free_length_m: -2.035", "job.yaml:13:18: error: ", "routing.free_length_m is -2.035 (must be > 0 m)", "; "},
    {"job.yaml", "free_length_m: 2.035", "free_length_m: .nan", "job.yaml:13:18: error: ", "(must be finite)", "; "},
    {"job.yaml", "free_length_m: 2.035", "free_length_m: 2.035\n  free_length_m: 2.1", "job.yaml:14:3: error: ", "duplicate key 'free_length_m'", "; "},
    {"job.yaml", "position_m: [-0.1, 0, 0.45]", "position_m: [-100, 0, 450]", "job.yaml:11:15: error: ", "461 m away from the frame of link_3", "give it in metres"},
    {"job.yaml", "direction: [1, 0, 0.45]", "direction: [0, 0, 0]", "job.yaml:11:15: error: ", "routing.base_clamp.direction is zero", "give where the dresspack points"},
    {"job.yaml", "position_m: [-0.1, 0, 0.45]", "position_m: [-0.1, 0.45]", "job.yaml:11:", "position_m", "; "},
    {"job.yaml", "segments: 24", "segments: 3", "job.yaml:14:24: error: ", "(must be 4 .. 2000)", "; "},
    {"job.yaml", "contact: false", "contact: maybe", "job.yaml:14:37: error: ", "simulation.contact is 'maybe'", "; "},
    {"job.yaml", "contact: false", "sample_rate_Hz: 60", "job.yaml:14:13: error: ", "leaves 3.33333 steps of 5 ms", "choose both so that it is a whole number"},
    {"job.yaml", "simulation: {", "strain: {slip: fricton}\nsimulation: {", "job.yaml:14:16: error: ", "'fricton'", "friction"},
    {"job.yaml", "simulation: {", "fatigue: {operating_hours_per_week: 400}\nsimulation: {", "job.yaml:14:37: error: ", "(must be 0.1 .. 168", "; "},
    // YAML itself
    {"job.yaml", "  base_clamp: {", "\tbase_clamp: {", "job.yaml:11:", "error: ", "; "},
    {"job.yaml", "direction: [1, 0, 0.45]}", "direction: [1, 0, 0.45]", "job.yaml:1", "error: ", "; "},
    // The routing as a whole
    {"job.yaml", "free_length_m: 2.035", "free_length_m: 1.2", "job.yaml:", "mm too short at ", "; ", "dresslife-sim job.yaml -o out.h5"},
    {"job.yaml", "  free_length_m", "  mounting_pose_deg: [0, 0]\n  free_length_m", "job.yaml:11:3: error: ", "mounting_pose_deg has 2 angles (the robot has 6 axes)", "give one angle per axis"},
    // The motion
    {"job.yaml", "[20, 0, 0, 0, 60, 90]", "[20, 0, 0, 0, 160, 90]", "job.yaml:7:7: error: ", "joint_5 to 160 deg (must be within -120 .. 120 deg)", "turn it 40 deg less"},
    {"job.yaml", "[20, 0, 0, 0, 60, 90]", "[20, 0, 0, 0, 60]", "job.yaml:7:7: error: ", "joints_deg has 5 angles (the robot has 6 axes)", "give one angle per axis"},
    {"job.yaml", "speed_percent: 50", "speed_percent: 500", "job.yaml:7:", "(must be 0.1 .. 100", "; "},
    {"job.yaml", "{text: wait, dwell_s: 0.5}", "{text: wait}", "job.yaml:8:7: error: ", "a step must be one of", "split it into steps"},
    {"job.yaml", "    - {text: home, joints_deg: [0, 0, 0, 0, 30, 0]}\n", "    - {text: rest, dwell_s: 1}\n", "job.yaml:6:7: error: ", "the program must begin with a move", "begin with joints_deg"},
    // A program on a controller
    {"module.yaml", "spot.mod", "spots.mod", "", "spots.mod", "; ", "dresslife-sim module.yaml --preview -o out.h5"},
    {"spot.mod", "fine,tool0", "fine tool0", "spot.mod:4:", "error: ", "; ", "dresslife-sim module.yaml --preview -o out.h5"},
    {"spot.mod", "MoveAbsJ a", "MoveAbsJ b", "spot.mod:4:", "'b'", "; ", "dresslife-sim module.yaml --preview -o out.h5"},
    {"spot.mod", "[[0,0,0,0,30,0]", "[[0,0,0,0,130,0]", "spot.mod:", "joint_5", "turn it 10 deg less", "dresslife-sim module.yaml --preview -o out.h5"},
    // A robot of one's own
    {"job.yaml", "robot: abb_irb6640_185_280", "robot: {urdf: arm.urdf}", "", "arm.urdf", "; "},
    // The dresspack
    {"hose.yaml", "helix_radius_mm: 14", "helix_radius_mm: 20", "hose.yaml:12:5: error: ", "'lead' reaches 24.1 mm from the axis, 3.1 mm outside the hose's bore (radius 21 mm)", "give helix_radius_mm: 16.9 or less", draw},
    {"hose.yaml", "inner_diameter_mm: 42", "inner_diameter_mm: 42\ncore_diameter_mm: 25", "hose.yaml:13:5: error: ", "2.6 mm inside the core", "helix_radius_mm: 16.6 or more", draw},
    {"hose.yaml", "inner_diameter_mm: 42", "hose_material: hose_polyamide", "hose.yaml:", "the hose's bore is not", "inner_diameter_mm: 42.5 (ESTIMATE)", draw},
    {"hose.yaml", "material: copper", "material: cooper", "hose.yaml:", "'cooper' is not in the catalogue (config/materials)", "copper", draw},
    {"hose.yaml", "    helix_radius_mm: 14\n", "    helix_radius_mm: 0\n", "hose.yaml:12:5: error: ", "4 parts 'lead' lie on the axis (helix_radius_mm is 0)", "give their distance from the axis", draw},
    {"hose.yaml", "lay_angle_deg: 8", "lay_angle_deg: 80", "hose.yaml:18:", "(must be 0 .. 60", "; ", draw},
    {"hose.yaml", "slack_percent: 1", "slack_percent: 50", "hose.yaml:16:", "(must be 0 .. 20", "; ", draw},
    {"hose.yaml", ", material: copper", "", "hose.yaml:18:", "'wire' must have either a material (a wire) or components", "give one of the two", draw},
    {"hose.yaml", "damping_source: a guess\n", "", "hose.yaml:", "damping_source is missing", "; ", draw},
    {"hose.yaml", "diameter_mm: 50\ninner", "diameter_mm: 40\ninner", "hose.yaml:", "inner_diameter_mm is 42 (diameter_mm is 40)", "the inner one is the smaller", draw},
    {"cable.yaml", "wire 0.1 mm", "wires of copper", "cable.yaml:6:17: error: ", "'wires of copper' of a data sheet is not understood", "write phrases as in '7 x 0.5 mm2", "dresslife draw cable.yaml"},
    {"cable.yaml", "outer diameter 8.2 mm", "outer diameter 4.2 mm", "cable.yaml:6:17: error: ", "wires of 0.1 mm are a conductor", "check cross_section_mm2", "dresslife draw cable.yaml"},
    {"cable.yaml", "wire 0.1 mm", "class 2", "cable.yaml:6:17: error: ", "classes 1 to 4 of IEC 60228 are for cables that lie still", "give 5 or 6", "dresslife draw cable.yaml"},
    // Studies
    {"study.yaml", "routing.free_length_m", "routing.free_lenght_m", "study.yaml:3:3: error: ", "free_lenght_m", "free_length_m", run_study},
    {"study.yaml", "base: job.yaml", "base: jobs.yaml", "study.yaml:1:7: error: ", "jobs.yaml", "; ", run_study},
    {"study.yaml", "vary:", "very:", "study.yaml:2:1: error: ", "unknown key 'very'", "did you mean 'vary'?", run_study},
    // Command lines
    {"", "", "", "none.yaml: error: ", "cannot be read (No such file or directory)", "; ", "dresslife run none.yaml"},
    {"", "", "", "--set segments: error: ", "is not key.path=value", "; ", "dresslife-sim job.yaml -o out.h5 --set segments"},
    {"", "", "", "job.yaml: error: ", "is not an HDF5 file", "; ", "dresslife-strain job.yaml -o out.h5"},
};

void write_inputs(const Scratch& scratch) {
  scratch.write("job.yaml", job);
  scratch.write("hose.yaml", hose);
  scratch.write("spot.mod", module);
  const std::size_t motion = job.find("motion:"), after = job.find("dresspack:");
  scratch.write("module.yaml", job.substr(0, motion) + "motion: {program: spot.mod}\n" + job.substr(after));
  scratch.write("study.yaml", study);
  scratch.write("cable.yaml",
                "name: c\nsource: a data sheet\ncomponents:\n  - name: cable\n    helix_radius_mm: 0\n"
                "    data_sheet: 7 x 0.5 mm2, wire 0.1 mm, outer diameter 8.2 mm, jacket 1.1 mm\n");
}

}  // namespace

TEST_CASE("the inputs that are changed below are accepted as they are") {
  const Scratch scratch;
  write_inputs(scratch);
  for (const char* command : {"dresslife-sim job.yaml --preview -o out.h5", "dresslife-sim module.yaml --preview -o out.h5"}) {
    const std::string words = command;
    const Outcome outcome = run(scratch, words.substr(0, words.find(' ')), words.substr(words.find(' ') + 1));
    INFO(outcome.err);
    CHECK(outcome.status == 0);
  }
  for (const char* pack : {"hose.yaml", "cable.yaml"}) {
    const Outcome outcome = run(scratch, "dresslife", std::string("draw ") + pack);
    INFO(outcome.err);
    CHECK(outcome.status == 0);
  }
}

TEST_CASE("45 and more plausible wrong inputs: each answer names file, line, problem and remedy") {
  REQUIRE(std::size(wrong) >= 45);
  for (const Wrong& one : wrong) {
    const Scratch scratch;
    write_inputs(scratch);
    if (!one.in.empty()) {
      std::string text = content(scratch / one.in);
      const std::size_t at = text.find(one.from);
      REQUIRE(at != std::string::npos);
      scratch.write(one.in, text.replace(at, one.from.size(), one.to));
    }
    const Outcome outcome =
        run(scratch, one.command.substr(0, one.command.find(' ')), one.command.substr(one.command.find(' ') + 1));
    CAPTURE(one.in, one.to, one.command, outcome.err);
    CHECK(outcome.status == one.status);
    CHECK((outcome.out.empty() || one.command == run_study));  // a study prints its table
    CHECK_THAT(outcome.err, Catch::StartsWith(one.place));
    CHECK_THAT(outcome.err, Contains(one.problem) && Contains(one.remedy) && Contains(": error: ") && Contains("; "));
    // Nothing is cut off. "add 'KEY: ...'" stands for a value.
    CHECK((outcome.err.find("...") == std::string::npos || outcome.err.find("...'") != std::string::npos));
    CHECK_FALSE(fs::exists(scratch / "out.h5"));
  }
}
