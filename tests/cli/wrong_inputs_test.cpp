// Plausible mistakes in inputs, and the programs' answers: the file and the line, the problem, and a remedy. Exit status 1 (2
// for a wrong command line), no standard output, no file left behind.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "pipeline/cable/excess.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/resolve/plausible_job.h"
#include "tests/catch.h"
#include "tests/cli/process.h"

using namespace dresslife;
using namespace dresslife::tests;
using Catch::Contains;

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
uncertainty: {hose_stiffness: 1}
routing.side: left
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
least_bend_radius_mm: 300
)";

const std::string module =
    "MODULE spot\n"
    "CONST jointtarget a:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
    "PROC main()\n  MoveAbsJ a,v1000,fine,tool0;\nENDPROC\nENDMODULE\n";

const std::string krl =
    "DEF nod()\nBAS(#VEL_PTP,60)\nBAS(#ACC_PTP,80)\n$BASE={X 0,Y 0,Z 0,A 0,B 0,C 0}\n$TOOL={X 0,Y 0,Z 150,A 0,B 0,C 0}\n$VEL.CP=0.25\n$APO.CDIS=20\n"
    "PTP {A1 0,A2 -90,A3 90,A4 0,A5 60,A6 0}\nPTP {X 900,Y -350,Z 600,A 0,B 180,C 0,S 2,T 2}\nLIN_REL {Z -120} C_DIS\nLIN_REL {X 100}\nWAIT SEC 0.3\nPTP {A1 0,A2 -90,A3 90,A4 0,A5 60,A6 0}\nEND\n";
const std::string krl_job =
    "robot: kuka_kr16_2\nmotion: nod.src\ndresspack: control_cable\nrouting:\n"
    "  base_clamp: {link: link_3, position_m: [-0.199, 0.133, -0.163], direction: [0.84, -0.29, -0.46]}\n"
    "  tool_clamp: {link: link_6, position_m: [0.167, -0.016, 0.02], direction: [-0.21, -0.11, 0.97]}\n"
    "  free_length_m: 1.135\nsimulation: {segments: 24, contact: false}\nuncertainty: {hose_stiffness: 1}\n";

const std::string study = "base: job.yaml\nvary:\n  routing.free_length_m: [2.0, 2.1]\n";

const std::string axes =
    "t_s,joint_1_deg,joint_2_deg,joint_3_deg,joint_4_deg,joint_5_deg,joint_6_deg\n0,0,0,0,0,30,0\n1,20,0,0,0,60,90\n2,0,0,0,0,30,0\n";
const std::string listing =
    "/PROG NOD\n/MN\n   1:J P[1] 60% FINE ;\n   2:L P[2] 250mm/sec CNT50 ;\n   3:J P[1] 60% FINE ;\n/POS\nP[1]{\n"
    " GP1: UF : 1, UT : 1, J1= 0 deg, J2= 0 deg, J3= 0 deg, J4= 0 deg, J5= -90 deg, J6= 0 deg\n};\nP[2]{\n"
    " GP1: UF : 0, UT : 0, CONFIG : 'N U T, 0, 0, 0',\n X = 950 mm, Y = -300 mm, Z = 500 mm, W = 180 deg, P = 0 deg, R = 0 deg\n};\n/END\n";
const std::string arc =
    "MODULE arc\nCONST robtarget p1:=[[1500,-300,1200],[0,0,1,0],[-1,-1,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
    "CONST robtarget p2:=[[1600,0,1200],[0,0,1,0],[0,-1,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
    "CONST robtarget p3:=[[1500,300,1200],[0,0,1,0],[0,-1,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
    "PROC main()\n  MoveJ p1,v1000,fine,tool0;\n  MoveC p2,p3,v200,fine,tool0;\nENDPROC\nENDMODULE\n";
/// One swing of axes 5 and 6 in 8 s.
const std::string log_rows = [] {
  std::string text = "t;J1;J2;J3;J4;J5;J6\n";
  for (int k = 0; k <= 8; ++k)
    text += fmt::format("{};0;-10;10;0;{};{}\n", k, k < 4 ? 35 - 2 * k : 19 + 2 * k, 10 * (4 - std::abs(k - 4)));
  return text;
}();
const std::string duties =
    "study: job.yaml\nduties:\n  - name: nod\n    hours_per_week: 80\n    programs:\n      - {job: job, percent_of_time: 50}\n"
    "    history:\n      - {duty: nod, from: 2025-01-13, to: 2026-06-30}\n";
const std::string plant =
    "name,duty,installed,planned_cost,unplanned_cost\nside 1,nod,2025-01-13,1200,9500\nside 2,nod,2025-08-04,1200,9500\n";

const std::string fleet = "name,routing.free_length_m\nR1,2.03\nR2,2.05\n";

struct Wrong {
  std::string in;               ///< file that is changed
  std::string from, to;         ///< replaced text and its replacement; from empty: the file becomes `to`
  std::string place;            ///< begin of the answer
  std::string problem, remedy;  ///< parts of the answer
  std::string command = "dresslife-sim job.yaml --preview -o out.h5";
  int status = 1;
};

const std::string
    check_listing = "dresslife check listing.yaml",
    check_arc = "dresslife check arc.yaml", run_duty = "dresslife duty duties.yaml",
    read_log = "dresslife import log.csv --log job.yaml -o shift.yaml",
    run_plan = "dresslife plan plant.csv --today 2026-11-25 --duties duties.yaml --windows 2027-07-12..2027-08-01";
const std::string run_fleet = "dresslife run fleet.yaml";
const std::string draw = "dresslife draw hose.yaml", run_study = "dresslife run study.yaml";
std::string free_as(const std::string& range) { return "dresslife improve job.yaml --trials 2 --free '" + range + "'"; }

const Wrong wrong[] = {
    // A job's names
    {"job.yaml", "abb_irb6640_185_280", "abb_irb6640", "job.yaml:1:8: error: ", "'abb_irb6640' is not in the catalogue",
     "abb_irb6640_185_280"},
    {"job.yaml", "hose.yaml", "hoses.yaml", "job.yaml:9:12: error: ", "hoses.yaml", "; "},
    {"job.yaml", "link: link_3", "link: link3", "job.yaml:11:15: error: ", "'link3' is not a link of the robot",
     "one of: base_link, link_1"},
    {"job.yaml", "free_length_m: 2.035", "free_length_m: 2035",
     "job.yaml:13:18: error: ", "routing.free_length_m is 2035", "or 2.035 if 2035 is in millimetres"},
    {"job.yaml", "robot: abb_irb6640_185_280", "robot: KR16", "job.yaml:1:8: error: ", "'KR16' is not in the catalogue",
     "did you mean 'kuka_kr16_2'?"},
    {"job.yaml", "robot: abb_irb6640_185_280", "robot: KUKA KR 16-2",
     "job.yaml:1:8: error: ", "is not in the catalogue", "did you mean 'kuka_kr16_2'?"},
    {"job.yaml", "segments: 24", "segmets: 24", "job.yaml:14:14: error: ", "unknown key 'simulation.segmets'",
     "did you mean 'segments'?"},
    {"job.yaml", "free_length_m: 2.035", "free_length_mm: 2035",
     "job.yaml:13:3: error: ", "unknown key 'routing.free_length_mm'", "its unit is m, write 'free_length_m: 2.035'"},
    {"job.yaml", "dresspack: hose.yaml\n", "", "job.yaml:1:1: error: ", "dresspack is missing",
     "give dresspack and routing"},
    {"job.yaml", "  free_length_m: 2.035\n", "", "job.yaml:11:3: error: ", "routing.free_length_m is missing", "; "},
    {"job.yaml", "{link: link_6, position_m", "{link: link_6, positions_m",
     "job.yaml:12:", "unknown key 'routing.tool_clamp.positions_m'", "did you mean 'position_m'?"},
    // A job's values
    {"job.yaml", "free_length_m: 2.035", "free_length_m: 2.035 m",
     "job.yaml:13:18: error: ", "'2.035 m' (must be a number", "; "},
    {"job.yaml", "free_length_m: 2.035", "free_length_m: -2.035",
     "job.yaml:13:18: error: ", "routing.free_length_m is -2.035 (must be > 0 m)", "; "},
    {"job.yaml", "free_length_m: 2.035", "free_length_m: .nan", "job.yaml:13:18: error: ", "(must be finite)", "; "},
    {"job.yaml", "free_length_m: 2.035", "free_length_m: 2.035\n  free_length_m: 2.1",
     "job.yaml:14:3: error: ", "duplicate key 'free_length_m'", "; "},
    {"job.yaml", "direction: [1, 0, 0.45]", "direction: [0, 0, 0]",
     "job.yaml:11:15: error: ", "routing.base_clamp.direction is zero", "give where the dresspack points"},
    {"job.yaml", "position_m: [-0.1, 0, 0.45]", "position_m: [-0.1, 0.45]", "job.yaml:11:", "position_m", "; "},
    {"job.yaml", "segments: 24", "segments: 3", "job.yaml:14:24: error: ", "(must be 4 .. 2000)", "; "},
    {"job.yaml", "contact: false", "contact: maybe", "job.yaml:14:37: error: ", "simulation.contact is 'maybe'", "; "},
    {"job.yaml", "contact: false", "sample_rate_Hz: 60", "job.yaml:14:13: error: ", "leaves 3.33333 steps of 5 ms",
     "choose both so that it is a whole number"},
    {"job.yaml", "simulation: {", "strain: {slip: fricton}\nsimulation: {", "job.yaml:14:16: error: ", "'fricton'",
     "friction"},
    {"job.yaml", "simulation: {", "fatigue: {operating_hours_per_week: 400}\nsimulation: {",
     "job.yaml:14:37: error: ", "(must be 0.1 .. 168", "; "},
    // YAML itself
    {"job.yaml", "  base_clamp: {", "\tbase_clamp: {", "job.yaml:11:", "error: ", "; "},
    {"job.yaml", "direction: [1, 0, 0.45]}", "direction: [1, 0, 0.45]", "job.yaml:1", "error: ", "; "},
    // The routing as a whole
    {"job.yaml", "free_length_m: 2.035", "free_length_m: 1.2", "job.yaml:", "mm too short at ", "; ",
     "dresslife-sim job.yaml -o out.h5"},
    {"job.yaml", "  free_length_m", "  mounting_pose_deg: [0, 0]\n  free_length_m",
     "job.yaml:11:3: error: ", "mounting_pose_deg has 2 angles (the robot has 6 axes)", "give one angle per axis"},
    // The motion
    {"job.yaml", "[20, 0, 0, 0, 60, 90]", "[20, 0, 0, 0, 160, 90]",
     "job.yaml:7:7: error: ", "joint_5 to 160 deg (must be within -120 .. 120 deg)", "turn it 40 deg less"},
    {"job.yaml", "[20, 0, 0, 0, 60, 90]", "[20, 0, 0, 0, 60]",
     "job.yaml:7:7: error: ", "joints_deg has 5 angles (the robot has 6 axes)", "give one angle per axis"},
    {"job.yaml", "speed_percent: 50", "speed_percent: 500", "job.yaml:7:", "(must be 0.1 .. 100", "; "},
    {"job.yaml", "{text: wait, dwell_s: 0.5}", "{text: wait}", "job.yaml:8:7: error: ", "a step must be one of",
     "split it into steps"},
    {"job.yaml", "    - {text: home, joints_deg: [0, 0, 0, 0, 30, 0]}\n", "    - {text: rest, dwell_s: 1}\n",
     "job.yaml:6:7: error: ", "the program must begin with a move", "begin with joints_deg"},
    // A program on a controller
    {"module.yaml", "spot.mod", "spots.mod", "", "spots.mod", "; ", "dresslife-sim module.yaml --preview -o out.h5"},
    {"spot.mod", "fine,tool0", "fine tool0", "spot.mod:4:", "error: ", "; ",
     "dresslife-sim module.yaml --preview -o out.h5"},
    {"spot.mod", "[[0,0,0,0,30,0]", "[[0,0,0,0,130,0]", "spot.mod:", "joint_5", "turn it 10 deg less",
     "dresslife-sim module.yaml --preview -o out.h5"},
    // A robot of one's own
    {"job.yaml", "robot: abb_irb6640_185_280", "robot: {urdf: arm.urdf}", "", "arm.urdf", "; "},
    // The dresspack
    {"hose.yaml", "helix_radius_mm: 14", "helix_radius_mm: 20",
     "hose.yaml:12:5: error: ", "'lead' reaches 24.1 mm from the axis, 3.1 mm outside the hose's bore (radius 21 mm)",
     "give helix_radius_mm: 16.9 or less", draw},
    {"hose.yaml", "inner_diameter_mm: 42", "inner_diameter_mm: 42\ncore_diameter_mm: 25",
     "hose.yaml:13:5: error: ", "2.6 mm inside the core", "helix_radius_mm: 16.6 or more", draw},
    {"hose.yaml", "inner_diameter_mm: 42", "hose_material: hose_polyamide", "hose.yaml:", "the hose's bore is not",
     "hose_corrugation: {pitch_mm: 4.22, height_mm: 3.75, wall_mm: 0.656} (ESTIMATE)", draw},
    {"hose.yaml", "material: copper", "material: cooper",
     "hose.yaml:", "'cooper' is not in the catalogue (config/materials)", "copper", draw},
    {"hose.yaml", "    helix_radius_mm: 14\n", "    helix_radius_mm: 0\n", "hose.yaml:12:5: error: ",
     "4 parts 'lead' lie on the axis (helix_radius_mm is 0)", "give their distance from the axis", draw},
    {"hose.yaml", "lay_angle_deg: 8", "lay_angle_deg: 80", "hose.yaml:18:", "(must be 0 .. 60", "; ", draw},
    {"hose.yaml", "slack_percent: 1", "slack_percent: 50", "hose.yaml:16:", "(must be 0 .. 20", "; ", draw},
    {"hose.yaml", ", material: copper", "",
     "hose.yaml:18:", "'wire' must have either a material (a wire) or components", "give one of the two", draw},
    {"hose.yaml", "damping_source: a guess\n", "", "hose.yaml:", "damping_source is missing", "; ", draw},
    {"hose.yaml", "diameter_mm: 50\ninner", "diameter_mm: 40\ninner",
     "hose.yaml:", "inner_diameter_mm is 42 (diameter_mm is 40)", "the inner one is the smaller", draw},
    {"cable.yaml", "wire 0.1 mm", "wires of copper", "cable.yaml:6:17: error: ",
     "'wires of copper' of a data sheet is not understood", "lengths as in '7 x 0.5 mm2", "dresslife draw cable.yaml"},
    {"cable.yaml", "outer diameter 8.2 mm", "outer diameter 4.2 mm", "cable.yaml:6:17: error: ",
     "wires of 0.1 mm are a conductor", "check cross_section_mm2", "dresslife draw cable.yaml"},
    {"cable.yaml", "wire 0.1 mm", "class 2", "cable.yaml:6:17: error: ",
     "classes 1 to 4 of IEC 60228 are for cables that lie still", "give 5 or 6", "dresslife draw cable.yaml"},
    // Studies
    {"study.yaml", "routing.free_length_m", "routing.free_lenght_m", "study.yaml:3:3: error: ", "free_lenght_m",
     "free_length_m", run_study},
    {"study.yaml", "base: job.yaml", "base: jobs.yaml", "study.yaml:1:7: error: ", "jobs.yaml", "; ", run_study},
    {"study.yaml", "vary:", "very:", "study.yaml:2:1: error: ", "unknown key 'very'", "did you mean 'vary'?",
     run_study},
    {"study.yaml", "[2.0, 2.1]", "2.0 .. 2.1",
     "study.yaml:3:26: error: ", "vary.routing.free_length_m must be a list of values", "write [A, B, ...]", run_study},
    {"study.yaml", "[2.0, 2.1]", "[2.0, 2.0]", "study.yaml:1:1: error: ", "two jobs are named 'free_length_m=2.0'",
     "give each combination another name", run_study},
    // A file of another kind
    {"job.yaml", "dresspack: hose.yaml", "dresspack: study.yaml",
     "study.yaml:1:1: error: ", "is a study (it has the key 'base'), no dresspack", "give it to dresslife run"},
    {"job.yaml", "robot: abb_irb6640_185_280", "robot: hose.yaml",
     "hose.yaml:1:1: error: ", "is a dresspack (it has the key 'components'), no robot", "after 'dresspack:'"},
    {"", "", "", "study.yaml:1:1: error: ", "is a study (it has the key 'base'), no job", "give it to dresslife run",
     "dresslife check study.yaml"},
    {"", "", "", "hose.yaml:1:1: error: ", "is a dresspack (it has the key 'components'), no job", "after 'dresspack:'",
     "dresslife preview hose.yaml"},
    {"", "", "", "hose.yaml:1:1: error: ", "is a dresspack (it has the key 'components'), no study",
     "after 'dresspack:'", "dresslife run hose.yaml"},
    {"", "", "", "hose.yaml:1:1: error: ", "is a dresspack (it has the key 'components'), no job", "after 'dresspack:'",
     "dresslife route hose.yaml"},
    {"", "", "", "job.yaml:1:1: error: ", "is a job (it has the key 'routing'), no list of observations",
     "give it to dresslife run", "dresslife calibrate job.yaml"},
    {"", "", "", "job.yaml:1:1: error: ", "is a job (it has the key 'routing'), no file of duties",
     "give it to dresslife run", "dresslife duty job.yaml"},
    {"", "", "", "control_cabel: error: ", "is no file", "did you mean 'control_cable'?",
     "dresslife rate control_cabel"},
    {"", "", "", "irb6640: error: ", "is no file", "did you mean 'irb6640_guided'?", "dresslife check irb6640"},
    {"module.yaml", "spot.mod", "hose.yaml", "hose.yaml:1:1: error: ", "holds no trajectory with points",
     "give a trajectory_msgs/JointTrajectory", "dresslife-sim module.yaml --preview -o out.h5"},
    {"job.yaml", "dwell_s: 0.5", "dwell_s: -0.5",
     "job.yaml:8:29: error: ", "motion.steps[3].dwell_s is -0.5 (must be >= 0 s)", "; "},
    {"hose.yaml", "count: 4", "count: 4.5", "hose.yaml:13:12: error: ", "count is 4.5 (must be a whole number)", "; ",
     draw},
    {"hose.yaml", "count: 4\n", "count: 400\n", "hose.yaml:12:5: error: ", "the 400 parts 'lead' are 0.2199 mm apart",
     "give count: 10 or less", draw},
    // Spreadsheets, units and typing habits
    {"job.yaml", "free_length_m: 2.035", "free_length_m: 2,035", "job.yaml:13:18: error: ", "'2,035' (must be a number",
     "write 2.035 with a point, or 2035 if the comma separates thousands"},
    {"job.yaml", "dwell_s: 0.5", "dwell_s: 0,5", "job.yaml:8:", "unknown key 'motion.steps[3].5'",
     "write 'dwell_s: 0.5' with a decimal point"},
    {"job.yaml", "free_length_m: 2.035", "free_length_m: \"2.035\"",
     "job.yaml:13:18: error: ", "'2.035' (must be a number", "; "},
    {"job.yaml", "position_m: [-0.1, 0",
     "position_m: [\xE2\x88\x92"
     "0.1, 0",
     "job.yaml:11:43: error: ", "(must be a number", "; "},
    {"job.yaml", "dwell_s: 0.5", "dwell_ms: 500", "job.yaml:8:", "unknown key", "; ",
     "dresslife-sim job.yaml --preview -o out.h5"},
    {"job.yaml", "simulation: {", "simulation: {gravity_m_per_s2: [0, 0, -9810], ",
     "job.yaml:14:", "gravity_m_per_s2 is -9810 (its size must be 0 .. 1000 m/s2)", "; "},
    {"job.yaml", "simulation: {", "simulation: {time_step_ms: 0.005, ",
     "job.yaml:14:", "time_step_ms is 0.005 (must be 0.01 .. 20 ms)", "; "},
    {"job.yaml", "simulation: {", "motion.acceleration_percent: 0.5\nsimulation: {",
     "job.yaml:14:", "acceleration_percent is 0.5 (must be 1 .. 100 %)", "; "},
    {"job.yaml", "simulation: {", "routing.free_lenght_m: 2\nsimulation: {",
     "job.yaml:14:", "unknown key 'routing.free_lenght_m'", "did you mean 'free_length_m'?"},
    {"job.yaml", "simulation: {", "dresspack.components.7.count: 2\nsimulation: {",
     "job.yaml:14:", "'7' of dresspack.components.7.count is not an item", "items count from 1 to 1"},
    {"job.yaml", "simulation: {", "dresspack.data_sheet: 7 x 0.5 mm2\nsimulation: {",
     "job.yaml:14:", "data_sheet describes a cable, and stands among the keys of a hose", "write 'cable: {name: NAME"},
    {"job.yaml", "simulation: {", "motion.program: spot.mod\nsimulation: {", "job.yaml:", "(it has steps and program)",
     "keep one of them"},
    {"job.yaml", "", std::string("PK\x03\x04 a spreadsheet"), "job.yaml:1:1: error: ", "holds no job", "; "},
    {"hose.yaml", "mass_kg_per_m: 1.2", "mass_kg_per_m: 1,2", "hose.yaml:5:16: error: ", "'1,2' (must be a number",
     "write 1.2 with a point", draw},
    {"hose.yaml", "slack_percent: 1", "slack_percent: 1\n    tension_N: 50",
     "hose.yaml:12:5: error: ", "tension_N of 'lead' is 50 (limit 0", "; remove it, or give slack_percent", draw},
    {"hose.yaml", "slack_percent: 1", "slack_percent: -1", "hose.yaml:16:20: error: ", "slack_percent is -1", "; ",
     draw},
    {"hose.yaml", "radius_mm: 4.1", "radius_mm: 8.2", "hose.yaml:12:5: error: ", "1.2 mm outside the hose's bore",
     "helix_radius_mm: 12.8 or less", draw},
    {"hose.yaml", "radius_mm: 4.1", "radius_mm: 22", "hose.yaml:12:5: error: ",
     "'lead' is 44 mm thick (the hose is 42 mm wide inside)", "take a hose with inner_diameter_mm: 44 or more", draw},
    {"hose.yaml", "helix_radius_mm: 14", "helix_radius_mm: 0.014",
     "hose.yaml:12:5: error: ", "'lead' covers the axis by 4.09 mm", "give helix_radius_mm: 4.1 or more", draw},
    {"hose.yaml", "  - name: lead\n    count: 4\n    radius_mm: 4.1\n    helix_radius_mm: 14\n",
     "  - {name: filler, radius_mm: 7, place: auto, without_wires: {kind: filler}}\n  - name: lead\n    count: 2.5\n    radius_mm: 4.1\n    place: auto\n",
     "hose.yaml:14:12: error: ", "count is '2.5' (must be a whole number)", "; ", draw},
    {"hose.yaml", "name: lead", "name: lead/1", "hose.yaml:12:5: error: ", "holds a '/'", "choose another name", draw},
    {"hose.yaml", "count: 19, radius_mm: 0.1", "count: 19, radius_mm: 1", "hose.yaml:18:101: error: ", "outside it",
     "check helix_radius_mm and radius_mm", draw},
    {"cable.yaml", "outer diameter 8.2 mm", "outer diameter 82 mm", "cable.yaml:6:17: error: ", "times its conductor",
     "give outer_diameter_mm: 8.2 if a decimal point was lost", "dresslife draw cable.yaml"},
    {"cable.yaml", "outer diameter 8.2 mm", "outer diameter 0.0082 mm", "cable.yaml:6:17: error: ", "leaves no room",
     "give outer_diameter_mm: 8.2 if that was metres", "dresslife draw cable.yaml"},
    {"cable.yaml", "7 x 0.5 mm2", "7 x 20 mm2", "cable.yaml:6:17: error: ", "a conductor 5.807 mm wide",
     "give cross_section_mm2: 0.518 if 20 is a wire gauge (AWG)", "dresslife draw cable.yaml"},
    {"cable.yaml", "7 x 0.5 mm2", "0.5 x 7 mm2", "cable.yaml:6:17: error: ",
     "'0.5 x 7 mm2' of a data sheet is not understood", "write '7 x 0.5 mm2'", "dresslife draw cable.yaml"},
    {"hose.yaml", "diameter_mm: 50\ninner", "diameter_m: 0.05\ninner",
     "hose.yaml:3:1: error: ", "unknown key 'dresspack.diameter_m'", "its unit is mm, write 'diameter_mm: 50'"},
    {"job.yaml", "simulation: {segments: 24, contact: false}",
     "cell: {meshes: [{file: box.obj}]}\nsimulation: {segments: 24}", "",
     "box.obj: error: the mesh is 300 m long with scale 1 (limit 30 m)",
     "give the mesh scale: 0.001 if its unit is the millimetre (in a URDF scale=\"0.001 0.001 0.001\")",
     "dresslife-sim job.yaml -o out.h5"},
    {"hose.yaml", "mass_kg_per_m: 1.2", "mass_g_per_m: 1200",
     "hose.yaml:5:1: error: ", "unknown key 'dresspack.mass_g_per_m'", "write 'mass_kg_per_m: 1.2'"},
    {"axes.csv", "", "t,a,b,c,d,e,f" + axes.substr(axes.find('\n')),
     "axes.csv:1:1: error: ", "names axes without their order",
     "motion.values: [{name: joints, value: 'NAME,NAME,...'}]", "dresslife check axes.yaml"},
    {"spot.mod", "MoveAbsJ a", "MoveAbsJ b", "spot.mod:4:", "'b'", "motion.values: [{name: b, value: VALUE}]",
     "dresslife check module.yaml"},
    {"cable.yaml", "wire 0.1 mm", "wire 1 mm", "cable.yaml:6:17: error: ", "0.5 mm2 are 0.637 wires of 1 mm",
     "check cross_section_mm2", "dresslife draw cable.yaml"},
    {"cable.yaml", "wire 0.1 mm", "wire 0.001 mm", "cable.yaml:6:17: error: ", "wires of 0.001 mm",
     "check cross_section_mm2", "dresslife draw cable.yaml"},
    {"cable.yaml", "7 x 0.5 mm2", "7 x AWG 20", "cable.yaml:6:17: error: ",
     "'7 x awg 20' of a data sheet is not understood", "write '7 x 0.518 mm2' for AWG 20", "dresslife draw cable.yaml"},
    {"cable.yaml", "jacket 1.1 mm", "jacket 11 mm", "cable.yaml:6:17: error: ", "leaves no room in 8.2 mm",
     "check jacket_thickness_mm", "dresslife draw cable.yaml"},
    {"axes.csv", "", replaced_all(axes, "_deg", "_rad"), "axes.csv:3:1: error: ", "turns joint_5 to 3437.75 deg", "; ",
     "dresslife-sim axes.yaml --preview -o out.h5"},
    {"axes.csv", "", replaced_all(axes, "1,20", "3,20"), "axes.csv:4:1: error: ",
     "has the time 2 s, not after the one before", "; ", "dresslife-sim axes.yaml --preview -o out.h5"},
    {"axes.csv", "", replaced_all(axes, "1,20", "1,#REF!"), "axes.csv:3:1: error: ", "has no number in cell 2", "; ",
     "dresslife-sim axes.yaml --preview -o out.h5"},
    {"axes.csv", "", axes.substr(axes.find('\n') + 1), "axes.csv:1:1: error: ", "begins with numbers",
     "put a line of names first", "dresslife-sim axes.yaml --preview -o out.h5"},
    {"axes.csv", "", replaced_all(replaced_all(axes, "joint_6_deg", "joint_6_deg,joint_7_deg"), "30,0", "30,0,0"),
     "axes.csv:3:1: error: ", "has 7 cells (there are 8 names)", "; ", "dresslife-sim axes.yaml --preview -o out.h5"},
    {"fleet.csv", "", "PK\x03\x04", "fleet.csv: error: ", "is no text in UTF-8", "save it as CSV in UTF-8", run_fleet},
    {"fleet.csv", "name,", "Name,", "fleet.csv:1:1: error: ", "the table has no column 'name' (it has 'Name')",
     "write 'name' instead of 'Name'", run_fleet},
    {"fleet.csv", "R1,2.03", "R1,2,03", "fleet.csv:2:6: error: ", "a row of 3 cells (the table has 2 columns)", "; ",
     run_fleet},
    {"fleet.csv", "R2", "R1", "fleet.csv:3:1: error: ", "'R1' is the name of line 2", "; ", run_fleet},
    {"fleet.csv", "free_length_m", "free_length_m,", "fleet.csv:1:28: error: ", "a column has no title", "; ",
     run_fleet},
    // Files and names of another kind
    {"", "", "", "machine.urdf: error: ", "is a robot description (URDF)", "dresslife new --robot FILE JOB.yaml",
     "dresslife run machine.urdf"},
    {"", "", "", "machine.xacro: error: ", "is a robot description (URDF)", "dresslife new --robot FILE JOB.yaml",
     "dresslife check machine.xacro"},
    {"", "", "", "x.urscript: error: ", "is a robot program, not a YAML file", "dresslife new --program FILE JOB.yaml",
     "dresslife run x.urscript"},
    {"", "", "", "x.SYSX: error: ", "is a robot program, not a YAML file", "dresslife new --program FILE JOB.yaml",
     "dresslife check x.SYSX"},
    {"", "", "", "x.sub: error: ", "is a robot program, not a YAML file", "dresslife new --program FILE JOB.yaml",
     "dresslife run x.sub"},
    {"job.yaml", "dresspack: hose.yaml", "dresspack: machine.urdf",
     "job.yaml:9:12: error: ", "'machine.urdf' is a robot description (URDF)", "write it after 'robot:'"},
    {"job.yaml", "dresspack: hose.yaml", "dresspack: spot.mod",
     "job.yaml:9:12: error: ", "'spot.mod' is a robot program or a table", "write a program after 'motion:'"},
    {"hose.yaml", "mass_kg_per_m: 1.2", "mass_g: 1200", "hose.yaml:5:1: error: ", "unknown key 'dresspack.mass_g'",
     "did you mean 'mass_kg_per_m'? Its unit is kg/m"},
    {"spot.mod", "MoveAbsJ a", "WaitTime -0.6;\n  MoveAbsJ a", "spot.mod:4:", "waits for -0.6 s (must be 0 or more)",
     "write 0.6 if the sign is a slip", "dresslife-sim module.yaml --preview -o out.h5"},
    // Programs of KUKA
    {"nod.src", "BAS(#VEL_PTP,60)", "BAS(#VEL_PTP)", "nod.src:2:1: error: ", "has BAS(#vel_ptp) without a number",
     "write BAS(#vel_ptp, NUMBER)", "dresslife check krl.yaml"},
    {"nod.src", "S 2,T 2", "S 2,T 35", "nod.src:9:1: error: ", "is not reached in configuration S 2, T 35 (but in ",
     "check target, tool", "dresslife check krl.yaml"},
    {"nod.src", "LIN_REL {Z -120} C_DIS", "CIRC {X 900,Y -350,Z 600,A 0,B 180,C 0}, {X 900,Y -350,Z 500,A 0,B 180,C 0}",
     "nod.src:10:1: error: ", "has no circle", "or write a straight move", "dresslife check krl.yaml"},
    {"nod.src", "LIN_REL {Z -120} C_DIS", "CIRC {X 900,Y -350,Z 550,A 0,B 180,C 0}, {X 900,Y -350,Z 500,A 0,B 180,C 0}",
     "nod.src:10:1: error: ", "lie on a line", "correct the point on the way", "dresslife check krl.yaml"},
    {"nod.src", "PTP {X 900,Y -350,Z 600,A 0,B 180,C 0,S 2,T 2}\n", "",
     "nod.src:9:9: error: ", "gives some coordinates only",
     "name the program in a job, whose robot of six axes gives them", "dresslife-import nod.src -o out.h5"},
    {"hose.yaml", "inner_diameter_mm: 42", "hose_corrugation: {pitch_mm: 4.5, height_mm: 4, wall_mm: 7}",
     "hose.yaml:4:19: error: ", "wall_mm of hose_corrugation is 7 (must be at most 1.125 mm", "measure the profile",
     draw},
    // Programs of Fanuc
    {"nod.ls", "L P[2]", "L P[7]", "nod.ls:4:6: error: ", "NOD moves to P[7], which is not listed",
     "list the program with its positions (/POS)", check_listing},
    {"nod.ls", "P[2]{\n", "", "nod.ls:10:1: error: ", "is no position", "write P[n]{ with its number at the begin",
     check_listing},
    {"nod.ls", "J5= -90 deg", "J5= -1.57 rad", "nod.ls:7:1: error: ", "has J5 in rad", "in mm and deg", check_listing},
    {"nod.ls", "X = 950 mm", "X = 950,5 mm", "nod.ls:10:1: error: ", "has a decimal comma in X", "with decimal points",
     check_listing},
    {"nod.ls", "X = 950 mm", "X = 9500 mm", "nod.ls:4:6: error: ", "is out of reach", "check target, tool",
     check_listing},
    {"nod.ls", "250mm/sec", "25m/sec", "nod.ls:4:6: error: ", "has a speed without a known unit", "write %, mm/sec",
     check_listing},
    {"nod.ls", "UF : 0, UT : 0", "UF : 0, UT : 2", "nod.ls:4:6: error: ", "uses UTOOL[2], which lies in the controller",
     "[{name: 'UTOOL[2]', position_mm: [X, Y, Z], wpr_deg: [W, P, R]}]", check_listing},
    // Circles of RAPID
    {"arc.mod", "p2:=[[1600,0", "p2:=[[1500,0",
     "arc.mod:7:3: error: ", "has no circle: its start, the point on the way and its end lie on a line",
     "correct the point on the way", check_arc},
    {"arc.mod", "MoveC p2,p3", "MoveC p3", "arc.mod:7:3: error: ", "gives MoveC 4 arguments, too few",
     "give target, speed", check_arc},
    {"arc.mod", "MoveC p2,p3", "MoveC p2,p1", "arc.mod:7:3: error: ", "has no circle", "or write a straight move",
     check_arc},
    // Logs, duties and plans
    {"log.csv", "J1;J2;J3;J4;J5;J6", "J1;J2;J3;J4;J5;J5", "",
     "log.csv:1:1: error: the log has no 6 columns that are the angles", "give --value joints=", read_log},
    {"log.csv", "35", "135", "", "the row turns joint_5 to 135 deg (must be within -120 .. 120 deg)",
     "--value unit=deg", read_log},
    {"", "", "", "--log: error: ", "needs a file of duties to write", "-o shift.yaml",
     "dresslife import log.csv --log job.yaml"},
    {"duties.yaml", "percent_of_time: 50", "percent_of_time: 500",
     "duties.yaml:6:37: error: ", "percent_of_time is 500 (must be 0 .. 100)", "give the share of the hours", run_duty},
    {"duties.yaml", "percent_of_time: 50", "repeats_per_hour: 9000",
     "duties.yaml:3:5: error: ", "take 228.0 minutes of each hour", "give fewer repeats", run_duty},
    {"duties.yaml", "{job: job,", "{job: jobs,", "duties.yaml:6:9: error: ", "has no job 'jobs'", "did you mean 'job'?",
     run_duty},
    {"duties.yaml", "to: 2026-06-30", "to: 2024-06-30", "duties.yaml:8:9: error: ",
     "the history ends on 2024-06-30, before it begins", "exchange the two dates", run_duty},
    {"plant.csv", "1200,9500", "1200 EUR,9500", "plant.csv:2:23: error: ", "planned_cost is '1200 EUR'",
     "write 1200, without unit", run_plan},
    {"plant.csv", "2025-01-13", "2035-01-13", "plant.csv:2:12: error: ", "'side 1' was installed after today, 20",
     "correct the date", run_plan},
    {"plant.csv", "side 1,nod", "side 1,nodd", "plant.csv:2:1: error: ", "there is no duty 'nodd'",
     "did you mean 'nod'?", run_plan},
    {"", "", "", "--windows: error: ", "ends before it begins", "exchange its two dates",
     replaced_all(run_plan, "2027-07-12..2027-08-01", "2027-08-01..2027-07-12")},
    // Keys that a search may change
    {"", "", "", "job.yaml: error: ",
     "no value of what is free makes a job: --set routing.lenght=2.05: error: unknown key 'routing.lenght'",
     "correct `free`, or --free", free_as("routing.lenght=2 .. 2.1")},
    {"", "", "", "job.yaml: error: ", "no value of what is free makes a job: --set routing.free_length_m=2050: error: ",
     "correct `free`, or --free", free_as("routing.free_length_m=2000 .. 2100")},
    {"", "", "", "job.yaml: error: ", "no value of what is free makes a job: ", "items count from 1 to 1",
     free_as("dresspack.components.9.slack_percent=0.1 .. 2")},
    {"", "", "", "--free routing.free_length_m=2.1 .. 2.0: error: ", "which holds nothing",
     "write the smaller number first", free_as("routing.free_length_m=2.1 .. 2.0")},
    // Command lines
    {"", "", "", "none.yaml: error: ", "cannot be read (No such file or directory)", "; ", "dresslife run none.yaml"},
    {"", "", "", "--set segments: error: ", "is not key.path=value", "; ",
     "dresslife-sim job.yaml -o out.h5 --set segments"},
    {"", "", "", "job.yaml: error: ", "is not an HDF5 file", "; ", "dresslife-strain job.yaml -o out.h5"},
};

void write_inputs(const Scratch& scratch) {
  scratch.write("job.yaml", job);
  scratch.write("hose.yaml", hose);
  scratch.write("spot.mod", module);
  scratch.write("nod.src", krl);
  scratch.write("krl.yaml", krl_job);
  scratch.write("machine.urdf", "<robot name=\"arm\"/>\n");
  scratch.write("machine.xacro", "<robot name=\"arm\"/>\n");
  for (const char* program : {"x.urscript", "x.SYSX", "x.sub"}) scratch.write(program, "");
  const std::size_t motion = job.find("motion:"), after = job.find("dresspack:");
  scratch.write("module.yaml", job.substr(0, motion) + "motion: {program: spot.mod}\n" + job.substr(after));
  scratch.write("axes.yaml", job.substr(0, motion) + "motion: {program: axes.csv}\n" + job.substr(after));
  scratch.write("axes.csv", axes);
  scratch.write("nod.ls", listing);
  scratch.write("listing.yaml", replaced_all(krl_job, "kuka_kr16_2\nmotion: nod.src", "fanuc_m20ia\nmotion: nod.ls"));
  scratch.write("arc.mod", arc);
  scratch.write("arc.yaml", job.substr(0, motion) + "motion: {program: arc.mod}\n" + job.substr(after));
  scratch.write("log.csv", log_rows);
  scratch.write("duties.yaml", duties);
  scratch.write("plant.csv", plant);
  scratch.write("fleet.yaml", "base: job.yaml\ntable: fleet.csv\n");
  scratch.write("fleet.csv", fleet);
  scratch.write("study.yaml", study);
  scratch.write("box.obj", "v 0 0 0\nv 300 0 0\nv 0 200 100\nf 1 2 3\n");
  scratch.write("cable.yaml",
                "name: c\nsource: a data sheet\ncomponents:\n  - name: cable\n    helix_radius_mm: 0\n"
                "    data_sheet: 7 x 0.5 mm2, wire 0.1 mm, outer diameter 8.2 mm, jacket 1.1 mm\n");
}

}  // namespace

TEST_CASE("the inputs that are changed below are accepted as they are") {
  const Scratch scratch;
  write_inputs(scratch);
  for (const char* command :
       {"dresslife-sim job.yaml --preview -o out.h5", "dresslife-sim module.yaml --preview -o out.h5",
        "dresslife-sim axes.yaml --preview -o out.h5", "dresslife-sim listing.yaml --preview -o out.h5",
        "dresslife-sim arc.yaml --preview -o out.h5", read_log.c_str(), "dresslife run -n fleet.yaml"}) {
    const std::string words = command;
    const Outcome outcome = run(scratch, words.substr(0, words.find(' ')), words.substr(words.find(' ') + 1));
    INFO(outcome.err);
    CHECK(outcome.status == 0);
  }
  scratch.write("thick.yaml",
                edited(content(scratch / "cable.yaml"),
                       "7 x 0.5 mm2, wire 0.1 mm, outer diameter 8.2 mm, jacket 1.1 mm", "7 x 50 mm2, class 6"));
  const Outcome thick = run(scratch, "dresslife", "draw thick.yaml");  // its innermost wires have a small lay angle
  CHECK_THAT(thick.out + thick.err, !Contains("warning: "));
  for (const char* pack : {"hose.yaml", "cable.yaml"}) {
    const Outcome outcome = run(scratch, "dresslife", std::string("draw ") + pack);
    INFO(outcome.err);
    CHECK(outcome.status == 0);
  }
}

TEST_CASE("wrong inputs: a relative move behind axis angles is none, its place follows from the job's robot") {
  const Scratch scratch;
  write_inputs(scratch);
  scratch.write("nod.src", edited(krl, "PTP {X 900,Y -350,Z 600,A 0,B 180,C 0,S 2,T 2}\n", ""));
  const Outcome relative = run(scratch, "dresslife", "check krl.yaml");
  CAPTURE(relative.out, relative.err);
  CHECK(relative.status == 0);
  // The same motion to the pose of the robot at these axis angles.
  scratch.write("nod.src", edited(krl, "PTP {X 900,Y -350,Z 600,A 0,B 180,C 0,S 2,T 2}\nLIN_REL {Z -120} C_DIS\n",
                                  "PTP $POS_ACT\nLIN_REL {Z -120} C_DIS\n"));
  const std::string absolute = unwrapped(run(scratch, "dresslife", "check krl.yaml").out);
  CHECK(replaced_all(absolute, "nod.src:10", "nod.src:9") == unwrapped(relative.out));
  scratch.write("nod.src", edited(krl, "VEL_PTP,60", "VEL_PTP"));
  CHECK(count_of(run(scratch, "dresslife", "check krl.yaml").err, "error: ") == 1);
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
      scratch.write(one.in, one.from.empty() ? one.to : text.replace(at, one.from.size(), one.to));
    }
    const Outcome outcome =
        run(scratch, one.command.substr(0, one.command.find(' ')), one.command.substr(one.command.find(' ') + 1));
    CAPTURE(one.in, one.to, one.command, outcome.err);
    CHECK(outcome.status == one.status);
    CHECK((outcome.out.empty() || one.command == run_study));  // a study prints its table
    CHECK_THAT(outcome.err, Catch::StartsWith(one.place));
    CHECK_THAT(outcome.err, Contains(one.problem) && Contains(one.remedy) && Contains(": error: ") && Contains("; "));
    // The message is complete. "add 'KEY: ...'" and "[A, B, ...]" contain placeholders.
    CHECK((outcome.err.find("...") == std::string::npos || outcome.err.find("...'") != std::string::npos ||
           outcome.err.find("...]") != std::string::npos));
    CHECK_FALSE(fs::exists(scratch / "out.h5"));
  }
}

namespace {

/// An input that is accepted, because it may be correct, but warned of with place, value, limit and remedy.
struct Doubtful {
  std::string in, from, to;
  std::string place, problem, remedy;
  std::string command = "check job.yaml";
};

/// Settings in the job, before its simulation.
Doubtful setting(const std::string& keys, const std::string& problem, const std::string& remedy) {
  return {"job.yaml", "simulation: {", keys + "\nsimulation: {", "", problem, remedy};
}
Doubtful simulation_key(const std::string& key, const std::string& problem, const std::string& remedy) {
  return {"job.yaml", "simulation: {", "simulation: {" + key + ", ", "", problem, remedy};
}

/// A material of the user's own for the wires.
Doubtful own_metal(const std::string& modulus, const std::string& strength, const std::string& b,
                   const std::string& ductility, const std::string& c, const std::string& problem,
                   const std::string& remedy) {
  return {"job.yaml",
          "simulation: {",
          fmt::format(
              "dresspack.materials: [{{name: mine, source: a test, youngs_modulus_GPa: {}, fatigue_strength_MPa: {}, "
              "fatigue_strength_exponent: {}, fatigue_ductility: {}, fatigue_ductility_exponent: {}}}]\n"
              "dresspack.components.1.components.1.components.1.material: mine\nsimulation: {{",
              modulus, strength, b, ductility, c),
          "",
          problem,
          remedy};
}

const Doubtful doubtful[] = {
    {"job.yaml", "2.035", "985", "job.yaml:11:3",
     "routing.free_length_m is 985 (limit 20 or less). Likely cause: millimetres", "routing.free_length_m: 0.985 if"},
    {"job.yaml", "[-0.1, 0, 0.45]", "[-10, 0, 20]", "job.yaml:11:15", "routing.base_clamp.position_m lies 22.36",
     "[-0.1, 0, 0.2] if those were centimetres"},
    setting("motion.speed_percent: 0.5", "motion.speed_percent is 0.5 (limit 1 or more). Likely cause: a share",
            "motion.speed_percent: 50 if"),
    setting("cell: {boxes: [{position_m: [0, 0, 0.5], sides_m: [1, 1, 1]}]}",
            "cell.boxes[1] contains joint_1 in the zero pose", "position_m of its centre"),
    {"hose.yaml", "least_bend_radius_mm: 300",
     "  - {name: tube, radius_mm: 3, helix_radius_mm: 0, mass_kg_per_m: 0.00003, without_wires: {kind: hose, bore_mm: 0.004}}",
     "hose.yaml:19:5", "mass_kg_per_m of 'tube' is 3e-05 (limit 0.001414 or more: foam)", "mass_kg_per_m: 0.03 if"},
    {"hose.yaml", "least_bend_radius_mm: 300",
     "  - {name: tube, radius_mm: 3, helix_radius_mm: 0, without_wires: {kind: hose, bore_mm: 0.004}}",
     "hose.yaml:19:67", "bore_mm of 'tube' is 0.004, and it is 6 mm wide outside by radius_mm 3 (limits 2.52 .. 5.52",
     "bore_mm: 4 if that was metres"},
    {"job.yaml", "30, 0]}\n    - {text: nod, joints_deg: [20, 0, 0, 0, 60, 90]",
     "0.52, 0]}\n    - {text: nod, joints_deg: [0.35, 0, 0, 0, 1.05, 1.57]", "job.yaml:6:7",
     "no joint angle of the motion is larger than 1.57 deg (limit 6.28 or more). Likely cause: radians",
     "joints_deg in degrees"},
    {"job.yaml", "speed_percent: 50", "speed_percent: 0.5", "job.yaml:7:7",
     "speed_percent is 0.5 (limit 1 or more). Likely cause: a share", "speed_percent: 50 if that was a share"},
    {"job.yaml", "dwell_s: 0.5", "dwell_s: 500", "job.yaml:8:7",
     "dwell_s is 500 (limit 100 or less). Likely cause: milliseconds", "dwell_s: 0.5 if"},
    {"hose.yaml", "mass_kg_per_m: 1.2", "mass_kg_per_m: 120", "hose.yaml:1:1",
     "mass_kg_per_m is 120 (limit 5.91: its parts, and diameter_mm filled",
     "mass_kg_per_m: 0.12 if that was g/m, 1 by its parts and wall"},
    {"hose.yaml", "mass_kg_per_m: 1.2", "mass_kg_per_m: 15", "hose.yaml:1:1", "mass_kg_per_m is 15 (limit 5.91",
     "1 by its parts and wall"},
    {"hose.yaml", "mass_kg_per_m: 1.2", "mass_kg_per_m: 0.12", "hose.yaml:1:1",
     "mass_kg_per_m is 0.12 (limit 0.301: 30 % of what its parts and its wall weigh", "from_construction (1)"},
    {"hose.yaml", "bending_stiffness_Nm2: 2", "bending_stiffness_Nm2: 2000000", "",
     "bending_stiffness_Nm2 is 2e+06 (limits 0.016 .. 1.08e+03)", "bending_stiffness_Nm2: 0.0321 or from_construction"},
    {"hose.yaml", "damping_time_ms: 10", "damping_time_ms: 0.01", "hose.yaml:1:1",
     "damping_time_ms is 0.01 (limits 0.88 .. 177", "as measured"},
    {"hose.yaml", "damping_time_ms: 10", "damping_time_ms: 10000", "hose.yaml:1:1",
     "damping_time_ms is 1e+04 (limits 0.88 .. 177", "as measured"},
    {"hose.yaml", "radius_mm: 0.1, ", "radius_mm: 0.0001, ", "hose.yaml:18:101",
     "radius_mm of 'wire' is 0.0001 (limit 0.01 or more for a wire). Likely cause: metres",
     "radius_mm: 0.1 if that was metres"},
    {"hose.yaml", "lay_angle_deg: 8", "lay_angle_deg: 0.14", "hose.yaml:18:9",
     "lay_angle_deg of 'core' is 0.14, a turn in 3.86 m (limit 0, or 0.6 deg or more). Likely cause: radians",
     "lay_angle_deg: 8.02 if that was radians"},
    {"hose.yaml", "components:\n  - name: lead",
     "components:\n  - {name: lead, radius_mm: 4.1, helix_radius_mm: 0, components: [{name: wire, count: 19, radius_mm: 0.1, helix_radius_mm: 0.8, lay_angle_deg: 5, material: copper}]}\n  - name: lead",
     "hose.yaml:13:5", "two parts side by side are named 'lead' (the other: line 12)", "another name"},
    {"hose.yaml", "torsional_stiffness_Nm2: 1.6", "torsional_stiffness_Nm2: 1600000", "hose.yaml:1:1",
     "torsional_stiffness_Nm2 is 1.6e+06 (limit 2.761e+04 or less: solid copper of diameter_mm)", "as measured"},
    {"hose.yaml", "axial_stiffness_N: 50000", "axial_stiffness_N: 50", "hose.yaml:1:1",
     "axial_stiffness_N is 50 (limit 589 or more: 2 % of stretch by the weight of a metre)",
     "axial_stiffness_N: 5e+04 if that was kN"},
    {"hose.yaml", "slack_percent: 1", "slack_percent: 1\n    play_mm: 400", "hose.yaml:12:5",
     "play_mm of 'lead' is 400 (limit 25 or less: half of diameter_mm)", "it follows from the bore"},
    {"hose.yaml", "slack_percent: 1",
     "slack_percent: 1\n    friction_coefficient: 0.3\n    radial_line_load_N_per_m: 5e6", "hose.yaml:12:5",
     "radial_line_load_N_per_m of 'lead' is 5e+06, 610 MPa on its width (limit 10: jackets yield)",
     "0.17 MPa times the part's width"},
    {"job.yaml", "free_length_m: 2.035", "free_length_m: 203.5", "", "least slack, length too long",
     "routing.free_length_m: 2.035"},
    simulation_key("gravity_m_per_s2: [0, 0, 9.81]", "the upward part of simulation.gravity_m_per_s2 is 9.81",
                   "simulation.gravity_m_per_s2: [0, 0, -9.81]"),
    simulation_key("gravity_m_per_s2: [0, 0, -1]",
                   "the size of simulation.gravity_m_per_s2 is 1 (limits 9.709 .. 9.905). Likely cause: multiples of g",
                   "simulation.gravity_m_per_s2: [0, 0, -9.81]"),
    simulation_key("gravity_m_per_s2: [0, -9.81, 0]", "the upward part of simulation.gravity_m_per_s2 is 0",
                   "a wall or a ceiling"),
    simulation_key("periodic_tolerance_mm: 1000", "simulation.periodic_tolerance_mm is 1000 (limit 50 or less)",
                   "simulation.periodic_tolerance_mm: 1"),
    setting("fatigue: {failed_wires_percent: 0.1}", "fatigue.failed_wires_percent is 0.1 (limits 1 .. 30, or 0)",
            "fatigue.failed_wires_percent: 10"),
    setting("fatigue: {failed_wires_percent: 60}", "fatigue.failed_wires_percent is 60 (limits 1 .. 30, or 0)",
            "fatigue.failed_wires_percent: 10"),
    setting("fatigue: {robot_life_hours: 10}",
            "fatigue.robot_life_hours is 10 (limit 1000 or more). Likely cause: years",
            "fatigue.robot_life_hours: 40000"),
    setting("fatigue: {operating_hours_per_week: 0.5}", "fatigue.operating_hours_per_week is 0.5 (limit more than 24)",
            "fatigue.operating_hours_per_week: 84 if that was a share"),
    setting("fatigue: {operating_hours_per_week: 8}",
            "fatigue.operating_hours_per_week is 8 (limit more than 24). Likely cause: hours of a day",
            "fatigue.operating_hours_per_week: 40 if"),
    setting("inspection: {found_percent: 0.75}",
            "inspection.found_percent is 0.75 (limit 0, or more than 1). Likely cause: a share",
            "inspection.found_percent: 75"),
    setting("inspection: {visible_depth_percent: 0.5}", "inspection.visible_depth_percent is 0.5 (limit 0",
            "inspection.visible_depth_percent: 50"),
    setting("fatigue: {endurance_strain: 0.05}", "fatigue.endurance_strain is 0.05 (limit 0.005 or less)",
            "fatigue.endurance_strain: 0.0005"),
    setting("fatigue: {strength_factor: 100}", "fatigue.strength_factor is 100 (limits 0.03333 .. 30)",
            "fatigue.strength_factor: 1 if that was per cent"),
    setting("strain: {friction_factor: 0.01}", "strain.friction_factor is 0.01 (limits 0.03333 .. 30)",
            "strain.friction_factor: 1"),
    setting("motion.spot_time_s: 1000", "motion.spot_time_s is 1000 (limit 10 or less). Likely cause: milliseconds",
            "motion.spot_time_s: 1 if"),
    setting("motion.zone_deg: 100", "motion.zone_deg is 100 (limit 30 or less)", "motion.zone_deg: 0"),
    {"job.yaml", "[20, 0, 0, 0, 60, 90]", "[0, 0, 0, 0, 30, 0]", "job.yaml:6:7",
     "no axis moves by more than 0 deg (limit 0.1 or more)", "joints_deg: the angles of each target"},
    {"hose.yaml", "diameter_mm: 50\ninner", "diameter_mm: 480\ninner", "hose.yaml:1:1",
     "diameter_mm is 480 (limits 1 .. 200)", "diameter_mm: 48 if"},
    {"hose.yaml", "inner_diameter_mm: 42", "inner_diameter_mm: 49.99", "hose.yaml:1:1", "the wall is 0.005 mm thick",
     "inner_diameter_mm: 42.5 (ESTIMATE)"},
    {"hose.yaml", "torsional_stiffness_Nm2: 1.6", "torsional_stiffness_Nm2: 0.000016", "hose.yaml:1:1",
     "torsional_stiffness_Nm2 is 8e-06 times bending_stiffness_Nm2", "torsional_stiffness_Nm2: from_construction"},
    {"hose.yaml", "least_bend_radius_mm: 300", "least_bend_radius_mm: 5000", "hose.yaml:1:1",
     "least_bend_radius_mm is 5000 (limits 50 .. 2000: 1 to 40 diameters)", "least_bend_radius_mm: 500 if"},
    {"hose.yaml", "least_bend_radius_mm: 300", "least_bend_radius_mm: 600", "hose.yaml:1:1",
     "least_bend_radius_mm is 600, 12 diameters (limits 3 .. 10 of a moved hose). Likely cause: the bend diameter",
     "least_bend_radius_mm: 300 if that was the diameter"},
    {"hose.yaml", "least_bend_radius_mm: 300", "least_bend_radius_mm: 100", "hose.yaml:1:1",
     "least_bend_radius_mm is 100, 2 diameters (limits 3 .. 10 of a moved hose). Likely cause: half of the radius",
     "least_bend_radius_mm: 200 if that was half"},
    {"hose.yaml", "slack_percent: 1", "slack_percent: 15", "hose.yaml:12:5",
     "slack_percent of 'lead' is 15 (limits 0.05 .. 5, or 0). Likely cause: millimetres in a metre",
     "slack_percent: 1.5"},
    {"hose.yaml", "slack_percent: 1", "slack_percent: 1\n    friction_coefficient: 30\n    radial_line_load_N_per_m: 5",
     "hose.yaml:12:5", "friction_coefficient of 'lead' is 30 (limit 1.5 or less)", "friction_coefficient: 0.3"},
    {"hose.yaml", "slack_percent: 1", "slack_percent: 1\n    base_grip_N: 1e9", "hose.yaml:12:5",
     "base_grip_N of 'lead' is 1e+09 (limits 1 .. 100000)", "no base_grip_N"},
    {"axes.csv", "", replaced_all(replaced_all(axes, "\n1,", "\n1000,"), "\n2,", "\n2000,"), "axes.csv:2:1",
     "no axis is faster than 0.09 deg/s", "times in seconds", "check axes.yaml"},
    {"axes.csv", "", replaced_all(replaced_all(axes, "20,0,0,0,60,90", "0.35,0,0,0,1.05,1.57"), "30,0", "0.52,0"),
     "axes.csv:2:1", "no joint angle of the motion is larger than 1.57 deg", "joints_deg in degrees",
     "check axes.yaml"},
    // Limits, parts and materials
    {"hose.yaml", "damping_source: a guess", "damping_source: a guess\nmost_twist_deg_per_m: 1.5", "hose.yaml:1:1",
     "most_twist_deg_per_m is 1.5 (limits 5 .. 3600)",
     "most_twist_deg_per_m: 85.94 if that was rad/m, 540 if that was turns/m"},
    {"hose.yaml", "damping_source: a guess", "damping_source: a guess\nmost_tension_N: 0.5", "hose.yaml:1:1",
     "most_tension_N is 0.5 (limits 5 .. 100000)", "most_tension_N: 500 if that was kN"},
    {"hose.yaml", "damping_source: a guess", "damping_source: a guess\nfriction_coefficient: 2", "hose.yaml:1:1",
     "friction_coefficient is 2 (limit 1.5 or less)", "friction_coefficient: 0.5"},
    {"hose.yaml", "damping_source: a guess", "damping_source: a guess\nconstruction_curvature_1_per_m: 100",
     "hose.yaml:1:1", "construction_curvature_1_per_m is 100 (limit 50)", "10 if that was a radius in mm"},
    {"hose.yaml", "damping_source: a guess",
     "damping_source: a guess\nsleeve: {thickness_mm: 0.001, material: polyurethane}", "hose.yaml:1:1",
     "thickness_mm of the sleeve is 0.001 (limits 0.05 .. 12.5)", "thickness_mm: 1 if that was metres"},
    {"hose.yaml", "slack_percent: 1", "slack_percent: 1\n    base_grip_N: 0.05", "hose.yaml:12:5",
     "base_grip_N of 'lead' is 0.05 (limits 1 .. 100000)", "base_grip_N: 50 if that was kN"},
    {"hose.yaml", "lay_angle_deg: 8", "lay_angle_deg: 8, tension_N: 10000", "hose.yaml:18:9",
     "tension_N of 'core' is 10000 (limit 904.8 or less: 200 MPa on its section)", "no tension_N"},
    {"hose.yaml", "slack_percent: 1", "slack_percent: 1\n    mass_kg_per_m: 90", "hose.yaml:12:5",
     "mass_kg_per_m of 'lead' is 90 (limit 0.4732 or less: solid copper)", "mass_kg_per_m: 0.09 if that was g/m"},
    {"hose.yaml", "slack_percent: 1", "slack_percent: 1\n    mass_kg_per_m: 0.0001", "hose.yaml:12:5",
     "mass_kg_per_m of 'lead' is 0.0001", "kg/km over 1000"},
    {"hose.yaml", "slack_percent: 1",
     "slack_percent: 1\n    ratings: [{rig: {kind: torsion, length_m: 1, twist_deg_per_m: 180}, cycles: 5, source: x}]",
     "hose.yaml:17:15", "cycles of a rating of 'lead' is 5 (limit 100 or more)", "cycles: 5e+06 if that was millions"},
    {"hose.yaml", "slack_percent: 1",
     "slack_percent: 1\n    ratings: [{rig: {kind: rolling_flex, radius_mm: 7.5, travel_m: 1}, cycles: 1e6, source: x}]",
     "hose.yaml:17:21", "radius_mm in a rating of 'lead' is 7.5: its axis is bent to 0.915 diameters (limits 2 .. 100)",
     "radius_diameters: 7.5 if so"},
    own_metal("0.115", "500", "-0.1", "0.3", "-0.6",
              "youngs_modulus_GPa of the wires' material 'mine' is 0.115 (limits 10 .. 450)",
              "youngs_modulus_GPa: 115 if that was TPa"),
    own_metal("115", "0.5", "-0.1", "0.3", "-0.6",
              "fatigue_strength_MPa of the wires' material 'mine' is 0.5 (limits 30 .. 10000). Likely cause: GPa",
              "fatigue_strength_MPa: 500"),
    own_metal("115", "500", "-0.1", "30", "-0.6",
              "fatigue_ductility of the wires' material 'mine' is 30 (limit 10 or less)",
              "fatigue_ductility: 0.3 if that was per cent"),
    own_metal("115", "500", "-0.6", "0.3", "-0.1",
              "fatigue_strength_exponent of 'mine' is -0.6, and fatigue_ductility_exponent -0.1",
              "fatigue_strength_exponent: -0.1 and fatigue_ductility_exponent: -0.6"),
    own_metal("115", "500", "-0.4", "0.3", "-0.6",
              "fatigue_strength_exponent of the wires' material 'mine' is -0.4 (limits -0.3 .. 0)",
              "-0.05 to -0.15 for metals"),
    // Routing, robot, cell, moves
    {"job.yaml", "free_length_m: 2.035", "free_length_m: 2.035\n  pre_twist_deg: 3.14", "job.yaml:11:3",
     "routing.pre_twist_deg is 3.14 (limits 6.28 .. 3600)", "routing.pre_twist_deg: 179.9 if that was radians"},
    {"job.yaml", "free_length_m: 2.035", "free_length_m: 2.035\n  longest_bracket_mm: 0.15", "job.yaml:11:3",
     "routing.longest_bracket_mm is 0.15", "routing.longest_bracket_mm: 150 if that was metres"},
    {"job.yaml", "free_length_m: 2.035", "free_length_m: 2.035\n  longest_bracket_mm: 9000", "job.yaml:11:3",
     "routing.longest_bracket_mm is 9000", "routing.longest_bracket_mm: 150"},
    {"job.yaml", "free_length_m: 2.035", "free_length_m: 2.035\n  retraction: {force_N: 50, stroke_m: 300}",
     "job.yaml:14:15", "stroke_m of the retraction unit is 300 (limit 5 or less)",
     "stroke_m: 0.3 if that was millimetres"},
    {"job.yaml", "free_length_m: 2.035", "free_length_m: 2.035\n  retraction: {force_N: 0, stroke_m: 0.3}",
     "job.yaml:14:15", "force_N of the retraction unit is 0, and it has no spring", "force_N: 20 to 100 N"},
    {"job.yaml", "free_length_m: 2.035", "free_length_m: 2.035\n  retraction: {force_N: 50000, stroke_m: 0.3}",
     "job.yaml:14:15", "force_N of the retraction unit is 50000 (limit 2000 or less)", "force_N: 50 if that was mN"},
    setting("robot.base_position_m: [0, 0, 500]", "robot.base_position_m lies 500 m from the origin (limit 20)",
            "robot.base_position_m: [0, 0, 0.5]"),
    setting("robot.joints.1.speed_deg_per_s: 2", "speed_deg_per_s of joint_1 is 2 (limits 5 .. 3000)",
            "speed_deg_per_s: 114.6 if that was rad/s"),
    setting("robot.joints.1.speed_deg_per_s: 10000", "speed_deg_per_s of joint_1 is 10000",
            "speed_deg_per_s: 166.7 if that was deg/min"),
    setting("robot.joints.1.acceleration_deg_per_s2: 5", "joint_1 takes 20 s from rest to its full speed",
            "acceleration_deg_per_s2: 286.5 if that was rad/s2"),
    setting("robot.joints.1.acceleration_deg_per_s2: 1e6", "joint_1 takes 0.0001 s from rest to its full speed",
            "full speed in half a second"),
    setting("cell: {boxes: [{position_m: [50, 0, 0], sides_m: [1, 1, 1]}]}",
            "cell.boxes[1] lies 48.27 m from the origin (limit 20)", "position_m in metres"),
    setting("cell: {capsules: [{from_m: [3, 0, 0], to_m: [3, 0, 1], radius_mm: 0.05}]}",
            "radius_mm of cell.capsules[1] is 0.05 (limit 1 or more)", "radius_mm: 50 if that was metres"),
    {"job.yaml", "{text: wait, dwell_s: 0.5}", "{text: wait, repeat: 1200, steps: [{text: pause, dwell_s: 0.01}]}",
     "job.yaml:8:7", "repeat is 1200 (limit 1000 or less)", "no repeat"},
    {"job.yaml", "speed_percent: 50", "speed_deg_per_s: 0.1", "job.yaml:7:7",
     "speed_deg_per_s is 0.1 (limit 0.2 or more)", "speed_deg_per_s: 5.73 if that was rad/s"},
    {"job.yaml", "speed_percent: 50", "speed_mm_per_s: 0.5", "job.yaml:7:7",
     "the tool's speed is 0.5 mm/s (limit 3 or more)", "speed_mm_per_s: 500 if that was m/s"},
    {"hose.yaml", "least_bend_radius_mm: 300", "least_bend_radius_mm: 30", "hose.yaml:1:1",
     "least_bend_radius_mm is 30 (limits 50 .. 2000", "least_bend_radius_mm: 300 if a digit is missing"},
    {"hose.yaml", "least_bend_radius_mm: 300",
     "  - {name: tube, radius_mm: 6, helix_radius_mm: 0, without_wires: {kind: hose, bore_mm: 4}}", "hose.yaml:19:67",
     "it is 12 mm wide outside by radius_mm 6", "radius_mm: 3 if 6 is the outer diameter"},
    {"job.yaml", "position_m: [0.15, 0, 0.18]", "position_m: [1.5, 0, 0.18]", "job.yaml:12:15",
     "routing.tool_clamp.position_m lies 1.5 m from all shapes of link_6",
     "position_m: [0.15, 0, 0.18] if a decimal point slipped"},
    setting("cell: {boxes: [{position_m: [50, 0, 0], sides_m: [800, 600, 10]}]}",
            "cell.boxes[1] is 800 m long (limit 60)", "sides_m: [0.8, 0.6, 0.01] if those were millimetres"),
    setting("robot.joints.3.upper_deg: 4010.7", "joint_3 turns from -180 to 4010.7 deg (limit 4 turns)",
            "lower_deg: -3.1416 and upper_deg: 70"),
    {"job.yaml", "direction: [1, 0, 0.45]", "direction: [90, 0, 45]", "job.yaml:11:15",
     "routing.base_clamp.direction is [90, 0, 45] (limit: numbers below 5). Likely cause: angles",
     "direction: [0.894, 0, 0.447] if it points there"},
    {"job.yaml", "[-0.1, 0, 0.45]", "[0.45, 0, -0.1]", "job.yaml:11:15",
     "routing.base_clamp.position_m lies 0.271 m from all shapes of link_3 (limit 0.175). Likely cause: exchanged coordinates",
     "position_m: [-0.1, 0, 0.45] if coordinates are exchanged"},
    {"job.yaml", "direction: [1, 0, -0.35]", "direction: [-1, 0, 0.35]", "",
     "Likely cause: a wrong sign: routing.tool_clamp.direction points away from the other clamp",
     "routing.tool_clamp.direction: [1.00, 0.00, -0.35] if so"},
    {"job.yaml", "direction: [1, 0, 0.45]", "direction: [-1, 0, -0.45]", "",
     "Likely cause: a wrong sign: routing.base_clamp.direction points away",
     "routing.base_clamp.direction: [1.00, 0.00, 0.45] if so"},
    {"job.yaml", "segments: 24", "segments: 8", "job.yaml:11:3",
     "a segment is 0.254 m long (limit 0.15 m: 0.5 of the least bend radius)", "simulation.segments: 64"},
    {"job.yaml", "speed_percent: 50", "speed_mm_per_s: 2.5", "job.yaml:7:7",
     "the tool's speed is 2.5 mm/s (limit 3 or more)", "10 or 100 times as much if the decimal point slipped"},
    {"hose.yaml", "least_bend_radius_mm: 300",
     "  - {name: air, radius_mm: 10, helix_radius_mm: 0, without_wires: {kind: hose, bore_mm: 8}}", "hose.yaml:19:67",
     "bore_mm of 'air' is 8, and it is 20 mm wide outside", "radius_mm: 5 if 10 is the outer diameter"},
    {"cable.yaml", "wire 0.1 mm, outer diameter 8.2 mm, jacket 1.1 mm", "class 6, jacket PVC 3 mm", "cable.yaml:4:5",
     "the jacket of 'cable' is 3 mm thick (limit 2.45: 2 times a usual one)", "jacket 1.5 mm if that was both walls",
     "draw cable.yaml"},
    setting("motion.override_percent: 1", "motion.override_percent is 1 (limit more than 1)",
            "motion.override_percent: 100"),
    {"nod.ls", "CNT50", "CNT500", "nod.ls:4:6", "CNT500: more than 100 % (limit 100, which counts)",
     "a percentage up to 100", "check listing.yaml"},
    // Programs of KUKA
    {"nod.src", "VEL_PTP,60", "VEL_PTP,350", "nod.src:2:1",
     "BAS(#vel_ptp, 350): more than 100 % (limit 100, which counts)", "a percentage up to 100", "check krl.yaml"},
    {"nod.src", "CDIS=20", "CDIS=3000", "nod.src:10:1", "the zone is 3000 mm (limit 500 or less)",
     "a zone of 30 mm if there are zeros too many", "check krl.yaml"},
};

}  // namespace

TEST_CASE("a program of another maker's robot is warned of, one of its own is not") {
  for (const auto& [program, text] :
       {std::pair{
            "nod.src",
            "DEF nod()\nPTP {A1 0, A2 0, A3 0, A4 0, A5 30, A6 0}\nPTP {A1 20, A2 0, A3 0, A4 0, A5 60, A6 90}\nEND\n"},
        {"nod.mod",
         "MODULE nod\nPROC main()\nMoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;\n"
         "MoveAbsJ [[20,0,0,0,60,90],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;\nENDPROC\nENDMODULE\n"}}) {
    const Scratch scratch;
    write_inputs(scratch);
    scratch.write(program, text);
    const Outcome outcome = run(scratch, "dresslife", std::string("check job.yaml --set motion=") + program);
    CAPTURE(outcome.out, outcome.err);
    CHECK(outcome.status == 0);
    const bool warned =
        outcome.out.find("the program nod.src is one of KUKA, and the robot is ABB IRB 6640-185/2.80") !=
        std::string::npos;
    CHECK(warned == (std::string(program) == "nod.src"));
    const Outcome made =
        run(scratch, "dresslife",
            std::string("new --robot abb_irb6640_185_280 --dresspack spot_welding new.yaml --program ") + program);
    CAPTURE(made.out, made.err);
    CHECK(made.status == 0);
    CHECK((made.out.find("the program nod.src is one of KUKA") != std::string::npos) == warned);
  }
}

TEST_CASE("a program is compared with the zero pose of a robot whose maker is not known") {
  const std::string rapid =
      "MODULE nod\nPROC main()\nMoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;\n"
      "MoveAbsJ [[20,-20,20,0,60,90],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;\nENDPROC\nENDMODULE\n";
  const std::string krl =
      "DEF nod()\nPTP {A1 0, A2 -20, A3 20, A4 0, A5 30, A6 0}\nPTP {A1 20, A2 -20, A3 20, A4 0, A5 60, A6 90}\nEND\n";
  const std::string fanuc =
      "/PROG NOD\n/MN\n1:J P[1] 60% FINE ;\n2:J P[2] 60% FINE ;\n/POS\nP[1]{GP1: UF:0,UT:1,J1=0 deg,J2=0 deg,J3=0 deg,"
      "J4=0 deg,J5=-30 deg,J6=0 deg};\nP[2]{GP1: UF:0,UT:1,J1=20 deg,J2=0 deg,J3=0 deg,J4=0 deg,J5=-60 deg,J6=9 deg};\n/END\n";
  const auto output = [&](const char* file, const std::string& text, const char* robot, const char* name = "own") {
    const Scratch scratch;
    write_inputs(scratch);
    scratch.write(file, text);
    const Outcome outcome =
        run(scratch, "dresslife",
            fmt::format("check job.yaml --set robot={} --set robot.name='{}' --set motion={}", robot, name, file));
    return unwrapped(outcome.out + outcome.err);
  };
  const char *upright = "abb_irb6640_185_280", *flat = "kuka_kr16_2";
  CHECK_THAT(
      output("nod.src", krl, upright),
      Contains(
          "nod.src: warning: the program nod.src is one of KUKA, and the robot is own, whose lower arm stands upright where all axes "
          "are at 0") &&
          Contains("or robot.name: KUKA own, if its controller has these zeros"));
  // The name of a URDF does not say that its axes have the controller's zeros. A maker's name with a capital is given by hand.
  CHECK_THAT(output("nod.src", krl, upright, "kuka_kr16"),
             Contains("the robot is kuka_kr16, whose lower arm stands upright") &&
                 Contains("a URDF with other zeros and directions of its axes"));
  CHECK_THAT(output("nod.src", krl, upright, "KUKA KR 16"), !Contains("is one of KUKA"));
  CHECK_THAT(output("nod.src", krl, flat, "kuka_kr16"), !Contains("is one of KUKA"));
  CHECK_THAT(output("nod.mod", rapid, upright), !Contains("is one of ABB"));
  CHECK_THAT(output("nod.src", krl, flat), !Contains("is one of KUKA"));
  CHECK_THAT(output("nod.mod", rapid, flat),
             Contains("is one of ABB, and the robot is own, whose lower arm lies flat"));
  CHECK_THAT(output("nod.ls", fanuc, upright),
             Contains("is one of Fanuc, and the robot is own, whose maker is not known; joint_3 is taken as J3 + J2") &&
                 Contains("or robot.name: Fanuc own"));
}

TEST_CASE("plausible mistakes that make a job are warned of, with place, limit and remedy, the job as it is is not") {
  // Warnings of the description alone. `dresslife check` begins with them; then it moves the dresspack, which takes a second.
  const auto described = [](const fs::path& file) {
    const pipeline::Job job = pipeline::read_job(file);
    std::string text;
    for (const auto& warnings : {pipeline::construction_warnings(job.dresspacks[0].dresspack, true),
                                 job.motion.left_out, pipeline::plausibility_of_lives(job)})
      for (const pipeline::Warning& warning : warnings) text += warning.line() + "\n";
    return text;
  };
  int by_description = 0;
  const auto checked = [&](const Doubtful* one) {
    const Scratch scratch;
    write_inputs(scratch);
    if (one) {
      std::string text = content(scratch / one->in);
      const std::size_t at = text.find(one->from);
      REQUIRE(at != std::string::npos);
      scratch.write(one->in, one->from.empty() ? one->to : text.replace(at, one->from.size(), one->to));
      if (one->command == "check job.yaml") {
        const std::string warnings = described(scratch / "job.yaml");
        constexpr int every = 10;  // is nevertheless checked by the command
        if (warnings.find(one->problem) != std::string::npos && by_description++ % every != 0) return warnings;
      }
    }
    const Outcome outcome = run(scratch, "dresslife", one ? one->command : "check job.yaml");
    return unwrapped(outcome.out + outcome.err);
  };
  CHECK(checked(nullptr).find("warning: ") == std::string::npos);
  const Doubtful unchanged{"nod.src", "END", "END", "", "", "", "check krl.yaml"};
  CHECK(checked(&unchanged).find("warning: ") == std::string::npos);
  for (const Doubtful& one : doubtful) {
    const std::string answer = checked(&one);
    CAPTURE(one.in, one.to, answer);
    CHECK_THAT(answer, Contains(one.place + (one.place.empty() ? "" : ": ") + "warning: ") && Contains(one.problem) &&
                           Contains("Remedy: ") && Contains(one.remedy));
  }
}

TEST_CASE("waits of a program that take more than half of its cycle are named with their share, others are not") {
  const auto answer_to = [](const std::string& wait) {
    const Scratch scratch;
    write_inputs(scratch);
    scratch.write(
        "spot.mod",
        replaced_all(module, "ENDPROC",
                     "  WaitTime " + wait +
                         ";\n  MoveAbsJ [[20,0,0,0,60,90],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,tool0;\nENDPROC"));
    return run(scratch, "dresslife", "check module.yaml").out;
  };
  CHECK_THAT(answer_to("60"), Contains("note: The waits of the program take 60 s, 9") &&
                                  Contains("the longest one is 60 s, at spot.mod:5:"));
  // A long wait is also named in a long program.
  const std::string loop =
      ";\n  FOR i FROM 1 TO 100 DO\n  MoveAbsJ [[20,0,0,0,60,90],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,tool0;\n  MoveAbsJ a,v1000,fine,tool0;\n  ENDFOR\n  WaitTime 0.1";
  CHECK_THAT(answer_to("30" + loop),
             Contains("note: The waits of the program take 30.1 s, 1") && Contains("the longest one is 30 s"));
  CHECK_THAT(answer_to("10" + loop), !Contains("The waits of the program"));
  CHECK_THAT(answer_to("0.06"), !Contains("The waits of the program"));
}

TEST_CASE("files as other systems write them are read: byte order marks, line ends, letters, separators") {
  const auto is_quiet = [](const std::string& file, const std::string& text, const std::string& command) {
    const Scratch scratch;
    write_inputs(scratch);
    scratch.write(file, text);
    const Outcome outcome = run(scratch, "dresslife", command);
    CAPTURE(file, text, outcome.out, outcome.err);
    CHECK(outcome.status == 0);
    CHECK(outcome.out.find("warning: ") == std::string::npos);
  };
  for (const std::string& text : {"\xEF\xBB\xBF" + job, replaced_all(job, "\n", "\r\n"),
                                  replaced_all(job, "name: nod",
                                               "name: \xC3\x96"
                                               "ffnen")})
    is_quiet("job.yaml", text, "check job.yaml");
  for (const std::string& text : {"\xEF\xBB\xBF" + axes, replaced_all(axes, "\n", "\r\n"), replaced_all(axes, ",", ";"),
                                  replaced_all(axes, ",", "\t")})
    is_quiet("axes.csv", text, "check axes.yaml");
  for (const std::string& text :
       {"\xEF\xBB\xBF" + fleet, replaced_all(fleet, "\n", "\r\n"), replaced_all(fleet, ",", ";"), fleet + "\n,\n"})
    is_quiet("fleet.csv", text, "run -n fleet.yaml");
}

TEST_CASE("a misspelt option is answered with the nearest one, a dry run names jobs that are refused") {
  const Scratch scratch;
  write_inputs(scratch);
  const auto answer = [&](const std::string& program, const std::string& words) {
    const Outcome outcome = run(scratch, program, words);
    CHECK(outcome.status == 2);
    return outcome.err.substr(0, outcome.err.find('\n'));
  };
  CHECK(answer("dresslife", "improve job.yaml --trial 2") ==
        "'--trial' is no option of improve; did you mean '--trials'?");
  CHECK(answer("dresslife", "run job.yaml --job=2") == "'--job' is no option of run; did you mean '--jobs'?");
  CHECK(answer("dresslife", "import log.csv --log -o shift.yaml") == "'--log' needs JOB.yaml before '-o'");
  CHECK(answer("dresslife", "run job.yaml -n 2") ==
        "'-n' takes no number (print what would be made and why, and run nothing); leave out '2'");
  CHECK(answer("dresslife-import", "spot.mod --anwsers x") ==
        "'--anwsers' is no option of dresslife-import; did you mean '--answers'?");
  // Options that do nothing beside the others are refused.
  for (const std::string option : {"--ring link_3", "--tried 9", "--short-runs 9", "--further 9", "--seed 9"})
    CHECK(answer("dresslife-sim", "job.yaml -o m.h5 " + option) ==
          option.substr(0, option.find(' ')) + " requires --propose");
  CHECK(answer("dresslife-sim", "job.yaml -o s.h5 --by-short-runs") == "--by-short-runs requires --screen");
  for (const auto& [program, words, message] :
       {std::tuple("dresslife-import", "spot.mod -o m.yaml --set simulation.segments=3",
                   "--set simulation.segments=3: error: changes a job"),
        std::tuple("dresslife-import", "job.yaml -o w.h5 --ways l.h5 --explain",
                   "--explain: error: does nothing with --ways"),
        std::tuple("dresslife-sim", "job.yaml -o p.h5 --preview --propose 3",
                   "--propose: error: does nothing with --preview"),
        std::tuple("dresslife-sim", "job.yaml -o d.yaml --duration --exercise",
                   "--exercise: error: does nothing without --preview")}) {
    const Outcome outcome = run(scratch, program, words);
    CHECK(outcome.status == 1);
    CHECK_THAT(outcome.err, Contains(message));
  }
  scratch.write("study.yaml", "base: job.yaml\nvary:\n  routing.free_length_m: [2.0, 2100]\n");
  const Outcome dry = run(scratch, "dresslife", "run -n study.yaml");
  CHECK(dry.status == 1);
  CHECK_THAT(dry.out, Contains(" refused  study.yaml:3:32: error: routing.free_length_m is 2100 (its size must be ") &&
                          Contains("1 of 2 jobs to make; nothing was run\n"));
}

TEST_CASE("wrong inputs: a refused diameter of the hose gives no further errors") {
  const Scratch scratch;
  scratch.write("hose.yaml", edited(hose, "diameter_mm: 50", "diameter_mm: 50,5"));
  const Outcome outcome = run(scratch, "dresslife", "draw hose.yaml");
  INFO(outcome.err);
  CHECK(outcome.status == 1);
  CHECK_THAT(outcome.err, Contains("write 50.5 with a point"));
  CHECK(count_of(outcome.err, "error: ") == 1);
}

TEST_CASE("wrong inputs: a job with a robot program is warned of its settings, too") {
  const Scratch scratch;
  scratch.write("hose.yaml", hose);
  scratch.write("spot.mod", module);
  const std::size_t begin = job.find("motion:"), end = job.find("dresspack:");
  scratch.write("job.yaml", edited(job, job.substr(begin, end - begin), "motion: spot.mod\n") +
                                "fatigue: {operating_hours_per_week: 0.5}\n");
  const Outcome outcome = run(scratch, "dresslife", "check job.yaml");
  INFO(outcome.err << outcome.out);
  CHECK_THAT(outcome.err + outcome.out, Contains("fatigue.operating_hours_per_week is 0.5"));
}
