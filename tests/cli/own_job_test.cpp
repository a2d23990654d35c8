// Plausible wrong inputs in an own job: a URDF, a KRL program, a dresspack of cables by data_sheet. `dresslife check` refuses each,
// warns of it or asks, with its place, the value and a remedy.
#include <fmt/format.h>

#include "tests/catch.h"
#include "tests/cli/process.h"

using namespace dresslife::tests;
using Catch::Contains;

namespace {

/// A URDF with the axes of a KUKA KR 16-2 and one box for each link.
std::string urdf() {
  struct Link {
    const char *name, *at, *size, *joint, *origin, *axis;
    double lower, upper, velocity;
  };
  const Link links[] = {
      {"base_link", "-0.06 0 0.2", "0.68 0.54 0.4", "", "", "", 0, 0, 0},
      {"link_1", "0.06 0 -0.06", "0.66 0.54 0.46", "joint_a1", "0 0 0.675", "0 0 -1", -3.229, 3.229, 2.7227},
      {"link_2", "0.34 -0.177 0", "0.86 0.2 0.22", "joint_a2", "0.26 0 0", "0 1 0", -2.705, 0.6109, 2.7227},
      {"link_3", "0.023 0.048 -0.029", "0.76 0.33 0.29", "joint_a3", "0.68 0 0", "0 1 0", -2.269, 2.688, 2.7227},
      {"link_4", "-0.1 0 0", "0.33 0.154 0.154", "joint_a4", "0.67 0 -0.035", "-1 0 0", -6.109, 6.109, 5.7596},
      {"link_5", "0.045 0.006 0", "0.2 0.2 0.12", "joint_a5", "0 0 0", "0 1 0", -2.269, 2.269, 5.7596},
      {"link_6", "0.152 0 0", "0.012 0.078 0.078", "joint_a6", "0 0 0", "-1 0 0", -6.109, 6.109, 10.734}};
  std::string text = "<robot name=\"own\">\n", before;
  for (const Link& link : links) {
    text += fmt::format(
        "<link name=\"{}\"><collision><origin xyz=\"{}\"/><geometry><box size=\"{}\"/></geometry></collision></link>\n",
        link.name, link.at, link.size);
    if (!before.empty())
      text += fmt::format(
          "<joint name=\"{}\" type=\"revolute\"><origin xyz=\"{}\"/><parent link=\"{}\"/><child link=\"{}\"/><axis xyz=\"{}\"/>"
          "<limit effort=\"0\" lower=\"{}\" upper=\"{}\" velocity=\"{}\"/></joint>\n",
          link.joint, link.origin, before, link.name, link.axis, link.lower, link.upper, link.velocity);
    before = link.name;
  }
  return text +
         "<link name=\"tool0\"/><joint name=\"tool\" type=\"fixed\"><parent link=\"link_6\"/><child link=\"tool0\"/>"
         "<origin xyz=\"0.158 0 0\" rpy=\"0 1.570796327 0\"/></joint>\n</robot>\n";
}

const std::string program =
    "DEF nod()\nBAS(#VEL_PTP,60)\nBAS(#ACC_PTP,80)\n$BASE={X 0,Y 0,Z 0,A 0,B 0,C 0}\n$TOOL={X 0,Y 0,Z 150,A 0,B 0,C 0}\n$VEL.CP=0.25\n"
    "PTP {A1 0,A2 -90,A3 90,A4 0,A5 60,A6 0}\nPTP {X 900,Y -350,Z 600,A 0,B 180,C 0,S 2,T 2}\nLIN_REL {X 100}\n"
    "PTP {A1 10,A2 -80,A3 95,A4 20,A5 45,A6 30}\nPTP {A1 -20,A2 -95,A3 85,A4 -10,A5 70,A6 -30}\nPTP {A1 0,A2 -90,A3 90,A4 0,A5 60,A6 0}\nEND\n";

const std::string job =
    "robot: {urdf: arm.urdf, accelerations_deg_per_s2: [670, 500, 1050, 4720, 4980, 9350]}\nmotion: nod.src\ndresspack: pack.yaml\nrouting:\n"
    "  base_clamp: {link: link_3, position_m: [0.071, 0.217, -0.024], direction: [0.63, 0.36, -0.69]}\n"
    "  tool_clamp: {link: link_6, position_m: [0.294, 0.037, 0.03], direction: [0.8, -0.47, 0.36]}\n"
    "  free_length_m: 1.035\nsimulation: {segments: 16, contact: false}\n";

const std::string pack =
    "name: own pack\nsource: data sheets\ndiameter_mm: 36\nhose_material: hose_polyamide\n"
    "hose_corrugation: {pitch_mm: 4.5, height_mm: 3, wall_mm: 0.7}\nleast_bend_radius_mm: 120\ncomponents:\n"
    "  - name: air hose\n    radius_mm: 4\n    helix_radius_mm: 0\n    slack_percent: 1\n    without_wires: {kind: hose, bore_mm: 5.5}\n"
    "  - name: cable\n    count: 3\n    helix_radius_mm: 9\n    slack_percent: 1\n"
    "    data_sheet: 7 x 0.5 mm2, wire 0.1 mm, lay length 60 mm, outer diameter 8.2 mm, jacket PUR 1.1 mm\n";

enum class Answer { refused, warned, asked };

struct Row {
  std::string file, from, to;
  Answer answer;
  std::string place;  ///< of the message; empty: the whole job
  std::string problem, remedy;
  std::string command = "check job.yaml";
};

/// A cable by its parts instead of its data sheet.
Row by_parts(const std::string& lay, Answer answer, const std::string& place, const std::string& problem,
             const std::string& remedy) {
  return {
      "pack.yaml",
      pack.substr(pack.find("data_sheet:")),
      "radius_mm: 4.1\n    components:\n      - {name: core, count: 7, radius_mm: 0.9, helix_radius_mm: 2.3, " + lay +
          ", components: [{name: wire, count: 19, radius_mm: 0.1, helix_radius_mm: 0.7, lay_angle_deg: 5, material: copper}]}\n",
      answer,
      place,
      problem,
      remedy};
}

Row setting(const std::string& keys, const std::string& place, const std::string& problem, const std::string& remedy) {
  return {"job.yaml", "simulation: {", keys + "\nsimulation: {", Answer::warned, place, problem, remedy};
}

Row simulation_key(const std::string& key, const std::string& problem, const std::string& remedy) {
  return {"job.yaml", "segments: 16", "segments: 16, " + key, Answer::warned, "job.yaml:8:", problem, remedy};
}

const std::string clamps_links = job.substr(job.find("link_3"), job.find("link_6") + 6 - job.find("link_3"));

const std::string too_short = job.substr(job.find("link_3"), job.find("1.035") + 5 - job.find("link_3"));

const Row rows[] = {
    // The robot
    {"job.yaml", "1050", "105", Answer::warned, "job.yaml:1:51",
     "joint_a3 takes 1.49 s from rest to its full speed by acceleration_deg_per_s2 105, the axes beside it 0.233 and 0.312 s",
     "[670, 500, 1050, 4720, 4980, 9350] if a digit is missing"},
    {"job.yaml", "4720", "472", Answer::warned, "job.yaml:1:51", "joint_a4 takes 0.699 s",
     "[670, 500, 1050, 4720, 4980, 9350] if a digit is missing"},
    {"job.yaml", "500,", "5000,", Answer::warned, "job.yaml:1:51", "an extra or exchanged digit",
     "about 840 is in proportion"},
    {"job.yaml", ", accelerations_deg_per_s2: [670, 500, 1050, 4720, 4980, 9350]", "", Answer::refused, "job.yaml:1:",
     "arm.urdf has no accelerations of joint_a1", "give accelerations_deg_per_s2 beside 'urdf', 6 numbers"},
    {"job.yaml", "urdf: arm.urdf", "urdf: arms.urdf", Answer::refused, "", "arms.urdf", "; "},
    {"job.yaml", "{urdf: arm.urdf, accelerations_deg_per_s2: [670, 500, 1050, 4720, 4980, 9350]}",
     "abb_irb6640_185_280", Answer::refused, "nod.src:", "the farthest of ",
     "the program may be one of another robot, or a URDF has other zeros than the controller: name the program's robot, or turn it"},
    {"job.yaml", "{urdf: arm.urdf, accelerations_deg_per_s2: [670, 500, 1050, 4720, 4980, 9350]}", "fanuc_m20ia",
     Answer::refused, "nod.src:", "the program nod.src is one of KUKA, and the robot is Fanuc",
     "robot: the one for which the program was written"},
    // The program
    {"nod.src", "CP=0.25", "CP=5", Answer::warned, "nod.src:6:5", "the tool's speed is 5 m/s (limit 3 m/s or less)",
     "0.5 m/s if the decimal point slipped"},
    {"nod.src", "CP=0.25", "CP=250", Answer::warned, "nod.src:6:5", "the tool's speed is 250 m/s",
     "0.25 m/s if that was mm/s"},
    {"nod.src", "CP=0.25", "CP=0.0025", Answer::warned, "nod.src:6:5", "the tool's speed is 2.5 mm/s (limit 3 or more)",
     "if the decimal point slipped"},
    {"nod.src", "CP=0.25", "CP=0,25", Answer::refused, "nod.src:6:10", "has ',' behind the end of the statement",
     "write 0.25 with a decimal point"},
    {"nod.src", "ACC_PTP,80", "ACC_PTP,0.4", Answer::warned, "nod.src:3:1",
     "the acceleration is 0.4 % (limit more than 1)", "in per cent: 40 if that was a share"},
    {"nod.src", "VEL_PTP,60", "VEL_PTP,0.6", Answer::warned, "nod.src:2:1", "speed_percent is 0.6 (limit 1 or more)",
     "60 % if that was a share"},
    {"nod.src", "ACC_PTP,80", "ACC_PTP,800", Answer::warned, "nod.src:3:1", "BAS(#acc_ptp, 800): more than 100 %",
     "a percentage up to 100"},
    {"nod.src", "A5 45", "A5 0.785", Answer::warned, "nod.src:10:1",
     "axis 5 of this target is at 0.785 deg (limit: at the other targets it is at 60 .. 70 deg)",
     "44.98 if that was radians"},
    {"nod.src", "{A1 10,A2 -80,A3 95,A4 20,A5 45,A6 30}", "{A1 0.17,A2 -1.4,A3 1.66,A4 0.35,A5 0.79,A6 0.52}",
     Answer::warned, "nod.src:10:1", "all angles of this target are below 3.15 deg", "if those were radians"},
    {"nod.src", "X 900,Y -350,Z 600,A 0,B 180,C 0,S 2,T 2}\nLIN_REL {X 100}",
     "X 90,Y -35,Z 60,A 0,B 180,C 0,S 2,T 2}\nLIN_REL {X 10}", Answer::refused, "nod.src:8:1",
     "all positions of the program lie within ", "10 times these numbers if those were centimetres"},
    {"nod.src", "Z 150", "Z -150", Answer::warned, "nod.src:5:", "lies 150 mm behind the flange, in the arm",
     "[0, 0, 150] in its declaration"},
    {"pack.yaml", "hose_material: hose_polyamide", "hose_material: copper", Answer::warned, "pack.yaml:1:1",
     "youngs_modulus_GPa of hose_material 'copper' is 117 (limit 15 or less: polymers)",
     "hose_material: hose_polyamide"},
    {"nod.src", "Z 150", "Z 0.15", Answer::warned,
     "nod.src:5:", "tool '$TOOL' lies 0.15 mm from the frame in which it is given", "[0, 0, 150] in its declaration"},
    {"job.yaml", "motion: nod.src", "motion: " DRESSLIFE_SOURCE_DIR "/config/programs/side_panel.mod", Answer::refused,
     "side_panel.mod: error: the program side_panel.mod is one of ABB", "the robot is own, whose lower arm lies flat",
     "robot: the one for which the program was written"},
    {"job.yaml", "motion: nod.src", "motion: spot_robot_1", Answer::refused, "", "the farthest of ",
     "the program may be one of another robot, or a URDF has other zeros than the controller: name the program's robot, or turn it"},
    // Clamps and length
    {"job.yaml", "link: link_3", "link: link_6", Answer::warned, "job.yaml:5:15",
     "both clamps of dresspack are on link_6",
     "routing.base_clamp.link with a link before the axes that bend the dresspack, for example link_3"},
    {"job.yaml", "[0.071, 0.217, -0.024]", "[0.331, 0.217, 1.331]", Answer::refused, "job.yaml:5:15",
     "as a place in the world in the mounting pose",
     "position_m: [0.071, 0.217, -0.024] and direction: [0.63, 0.36, -0.69], both in the frame of link_3"},
    {"job.yaml", too_short,
     replaced_all(replaced_all(replaced_all(replaced_all(too_short, "link_3", "link_X"), "link_6", "link_3"), "link_X",
                               "link_6"),
                  "1.035", "0.4"),
     Answer::refused, "job.yaml:5:15", "mm too short at ",
     "if only their links are exchanged, routing.base_clamp.link: link_3 and routing.tool_clamp.link: link_6"},
    {"job.yaml", "link: link_6", "link: link_3", Answer::warned, "job.yaml:6:15",
     "both clamps of dresspack are on link_3", "for example link_6"},
    {"job.yaml", clamps_links,
     replaced_all(replaced_all(replaced_all(clamps_links, "link_3", "link_X"), "link_6", "link_3"), "link_X", "link_6"),
     Answer::warned, "job.yaml:5:15", "routing.base_clamp is on link_6, and routing.tool_clamp on link_3",
     "routing.base_clamp.link: link_3 and routing.tool_clamp.link: link_6"},
    {"job.yaml", "link: link_3", "link: link_2", Answer::warned, "job.yaml:5:15",
     "routing.base_clamp.position_m lies 0.294 m from all shapes of link_2", "link: link_1 or link_3 if it is there"},
    {"job.yaml", "[0.071, 0.217, -0.024]", "[0, 0, 0]", Answer::warned, "job.yaml:5:15",
     "routing.base_clamp.position_m is [0, 0, 0], the origin of link_3", "in metres in the frame of link_3"},
    {"job.yaml", "[0.294, 0.037, 0.03]", "[-0.03, 0.037, 0.136]", Answer::warned, "job.yaml:6:15",
     "behind the flange (limit 0.079", "position_m: [0.294, 0.037, 0.03]"},
    {"job.yaml", "link: link_6", "link: tool0", Answer::refused, "job.yaml:6:15", "'tool0' is not a link of the robot",
     "one of: base_link, link_1"},
    {"job.yaml", "[0.071, 0.217, -0.024]", "[71, 217, -24]", Answer::refused, "job.yaml:5:15",
     "m away from the frame of link_3", "give it in metres"},
    {"job.yaml", "free_length", "mounting_pose_deg: [0, -90, 90, 0, 60, 180]\n  free_length", Answer::warned,
     "job.yaml:7:22", "joint_a6 turns by -180 deg", "routing.mounting_pose_deg with 0.0 for joint_a6"},
    {"job.yaml", "free_length", "mounting_pose_deg: [0, 0, 0, 0, 0, 0]\n  free_length", Answer::asked, "",
     "routing.mounting_pose_deg is 0 for all axes", "leave the key out"},
    {"job.yaml", "1.035", "103.5", Answer::refused, "job.yaml:5:3", "routing.free_length_m is 103.5 (limit 20 or less)",
     "routing.free_length_m: 1.035 if that was centimetres"},
    // The dresspack
    {"job.yaml", "dresspack: pack.yaml", "dresspack: pack", Answer::refused, "job.yaml:3:12",
     "'pack' is not in the catalogue", "write 'pack.yaml' for the file beside the job"},
    {"job.yaml", "dresspack: pack.yaml", "dresspack: packs", Answer::refused, "job.yaml:3:12", "'packs' is a folder",
     "such as 'packs/cables.yaml'"},
    {"pack.yaml", "hose_material: hose_polyamide\nhose_corrugation: {pitch_mm: 4.5, height_mm: 3, wall_mm: 0.7}",
     "hose_bore_mm: 28", Answer::refused, "pack.yaml:4:1", "unknown key 'dresspack.hose_bore_mm'",
     "did you mean 'inner_diameter_mm'? Then write 'inner_diameter_mm: 28'"},
    {"pack.yaml", "radius_mm: 4\n", "radius_mm: 8\n", Answer::refused, "pack.yaml:8:5",
     "'air hose' (16 mm) and 'cable' (8.2 mm) do not fit",
     "give radius_mm: 4 of 'air hose' if 8 is its outer diameter"},
    {"pack.yaml", "radius_mm: 4\n", "diameter_mm: 8\n", Answer::refused, "pack.yaml:9:5",
     "unknown key 'dresspack.components[1].diameter_mm'", "Then write 'radius_mm: 4'"},
    {"pack.yaml", "bore_mm: 5.5", "bore_mm: 2.75", Answer::warned, "pack.yaml:12:20", "bore_mm of 'air hose' is 2.75",
     "bore_mm: 5.5 if 2.75 is half the bore"},
    {"pack.yaml", "7 x 0.5 mm2", "12 x 25 mm2", Answer::refused, "pack.yaml:17:17",
     "a conductor 6.489 mm wide (the core has 1.444 mm)", "give cross_section_mm2: 0.25 if a decimal point was lost"},
    {"pack.yaml", "lay length 60 mm", "lay angle 12 deg", Answer::refused, "pack.yaml:17:17",
     "'lay angle 12 deg' of a data sheet is not understood", "over the tangent of the angle"},
    {"pack.yaml", "lay length 60 mm", "lay length 12 mm", Answer::refused, "pack.yaml:17:17",
     "do not lie beside each other on a lay of 12 mm", "or 55.8 mm if 12 is the lay angle in degrees"},
    {"pack.yaml", "7 x 0.5 mm2, wire 0.1 mm, lay length 60 mm, outer diameter 8.2 mm", "4G10, outer diameter 11.5 mm",
     Answer::refused, "pack.yaml:17:17", "4 cores of 10 mm2 need a cable about 1",
     "outer_diameter_mm is 11.5: correct one of the three numbers; "},
    {"pack.yaml", "jacket PUR 1.1 mm", "jacket PUR 0.2 mm", Answer::warned, "pack.yaml:13:5",
     "the jacket of 'cable' is 0.2 mm thick", "jacket 1.3 mm, a usual one"},
    {"pack.yaml", pack,
     replaced_all(replaced_all(pack, "diameter_mm: 36", "diameter_mm: 3.6"), "helix_radius_mm: 9", "place: auto"),
     Answer::refused, "pack.yaml:13:5", "leaves no bore in the hose (diameter_mm is 3.6)",
     "give diameter_mm: 36 if a zero was lost"},
    {"pack.yaml", pack,
     replaced_all(replaced_all(pack, "diameter_mm: 36", "diameter_mm: 0.036"), "helix_radius_mm: 9", "place: auto"),
     Answer::refused, "pack.yaml:13:5", "leaves no bore in the hose (diameter_mm is 0.036)",
     "give diameter_mm: 36 if that was metres"},
    {"pack.yaml", "pitch_mm: 4.5, height_mm: 3", "pitch_mm: 3, height_mm: 4.5", Answer::warned, "pack.yaml:5:19",
     "pitch_mm is 3 and height_mm 4.5", "pitch_mm: 4.5 and height_mm: 3 if they were exchanged"},
    {"pack.yaml", "diameter_mm: 36", "diameter_mm: 63", Answer::warned, "pack.yaml:5:19",
     "height_mm is 3, 0.048 times diameter_mm 63", "diameter_mm 25 .. 50 with this corrugation"},
    {"pack.yaml", "wall_mm: 0.7", "wall_mm: 8.75", Answer::refused, "pack.yaml:5:19",
     "wall_mm of hose_corrugation is 8.75", "give wall_mm: 0.875 if a decimal point was lost"},
    {"pack.yaml", "least_bend_radius_mm: 120", "least_bend_radius_mm: 0.2", Answer::refused, "pack.yaml:6:23",
     "least_bend_radius_mm is 0.2 (must be at least 18 mm: half of diameter_mm)",
     "give least_bend_radius_mm: 200 if that was metres"},
    {"pack.yaml", "hose_material: hose_polyamide\nhose_corrugation: {pitch_mm: 4.5, height_mm: 3, wall_mm: 0.7}",
     "inner_diameter_mm: 30", Answer::refused, "pack.yaml:1:1",
     "the wall of the hose is not known: bending_stiffness_Nm2 from the construction",
     "give hose_material: hose_polyamide and hose_corrugation: {pitch_mm: 3.38, height_mm: 3, wall_mm: 0.525} (ESTIMATE)",
     "new --robot kuka_kr16_2 --program nod.src --dresspack pack.yaml made.yaml"},
    by_parts("lay_length_mm: 60", Answer::refused, "pack.yaml:19:70",
             "unknown key 'dresspack.components[2].components[1].lay_length_mm'",
             "did you mean 'lay_angle_deg'? A lay length of 60 mm is 'lay_angle_deg: 13.5'"),
    by_parts("lay_angle_deg: 45", Answer::warned, "pack.yaml:19:9", "the 7 parts 'core' are 1.453 mm apart",
             "lay_angle_deg: 17.8 if 45 is the lay length in mm"),
    // Settings, with their lines
    setting("uncertainty: {slack: 60}", "job.yaml:8:22", "uncertainty.slack is 60 (limit 20",
            "uncertainty.slack: 1.6 if that was per cent"),
    setting("strain: {gate: 0.1}", "job.yaml:8:16", "strain.gate is 0.1 (limit 0.0002 or less: cycles below",
            "strain.gate: 0.0002, or no key"),
    simulation_key("time_step_ms: 20", "simulation.time_step_ms is 20 (limit 10 or less)",
                   "simulation.time_step_ms: 5, or auto"),
    simulation_key("sample_rate_Hz: 2", "simulation.sample_rate_Hz is 2 (limit 5 or more)",
                   "simulation.sample_rate_Hz: 25"),
    simulation_key("most_repeats: 1000", "simulation.most_repeats is 1000 (limit 100 or less)",
                   "simulation.most_repeats: 8"),
    // The command line
    {"", "", "", Answer::refused, "", "'--set' needs KEY.PATH=VALUE without spaces", "write simulation.segments=24",
     "run job.yaml --set simulation.segments = 24"},
};

}  // namespace

TEST_CASE(
    "wrong inputs in an own job of a URDF, a KRL program and data sheets: each answer has place, value and remedy") {
  static_assert(std::size(rows) >= 45);
  const auto answer_to = [](const Row& row) {
    const Scratch scratch;
    for (const auto& [file, text] : {std::pair<std::string, std::string>{"job.yaml", job},
                                     {"nod.src", program},
                                     {"pack.yaml", pack},
                                     {"arm.urdf", urdf()}})
      scratch.write(file, file == row.file ? edited(text, row.from, row.to) : text);
    scratch.write("packs/cables.yaml", pack);
    return run(scratch, "dresslife", row.command);
  };
  const Outcome right = answer_to({"", "", "", Answer::asked, "", "", ""});
  INFO(right.out << right.err);
  REQUIRE(right.status == 0);
  CHECK_THAT(right.out, Contains("job.yaml: no warnings") && !Contains("routing.mounting_pose_deg"));
  for (const Row& row : rows) {
    const Outcome answer = answer_to(row);
    const std::string text = unwrapped(answer.out + answer.err);
    CAPTURE(row.file, row.from, row.to, text);
    CHECK((answer.status == 0) == (row.answer != Answer::refused));
    if (row.answer == Answer::warned)
      CHECK_THAT(text, Contains(row.place) && Contains(": warning: ") && Contains("Likely cause: "));
    if (row.answer == Answer::refused && !row.place.empty())
      CHECK_THAT(text, Catch::StartsWith(row.place) && Contains(": error: "));
    if (row.answer == Answer::asked) CHECK_THAT(text, Contains("note: "));
    CHECK_THAT(text, Contains(row.problem) && Contains(row.remedy));
  }
}
