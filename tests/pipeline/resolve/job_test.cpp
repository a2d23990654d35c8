#include "pipeline/job/job.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "pipeline/base/constants.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/settings/fields.h"
#include "tests/catch.h"
#include "tests/pipeline/sample_job.h"
#include "tests/pipeline/scratch.h"

using namespace dresslife;
using namespace dresslife::pipeline;

namespace {

Job job_of_text(const std::string& text, const std::vector<std::string>& sets = {}) {
  return job_from(parse_yaml(text, "job.yaml"), sets);
}

/// A change of the sample job, the place of its error, and the error's message from this place on.
struct Case {
  std::string from, to;
  std::string needle;  ///< text at the place of the error
  std::string message;
};

void check_case(const Case& one) {
  const std::string text = edited(sample_job, one.from, one.to);
  INFO(one.from << " -> " << one.to);
  CHECK(message_of([&] { job_of_text(text); }) == place_of(text, one.needle, "job.yaml") + ": error: " + one.message);
}

TEST_CASE("job: values arrive in SI and defaults where nothing is written") {
  const Job job = job_of_text(sample_job);
  CHECK(job.robot.joints.size() == 2);
  CHECK(job.robot.joints[1].lower == -60.1 * degree);
  CHECK(job.robot.joints[0].acceleration == 400 * degree);
  CHECK(job.robot.base_orientation.z() == 30 * degree);
  CHECK(job.robot.links[1].capsules[0].radius == 120 * 1e-3);
  CHECK(job.motion.steps.size() == 3);
  CHECK(job.motion.steps[0].zone == 0.0);
  CHECK(job.motion.steps[1].repeat == 3);
  CHECK(job.motion.steps[1].steps[0].joints == std::vector<double>{10.7 * degree, -5 * degree});
  CHECK(job.motion.steps[1].steps[1].dwell == 0.5);
  CHECK_FALSE(job.motion.steps[2].zone.has_value());
  CHECK(job.motion.zone == 2 * degree);
  CHECK(job.motion.speed_percent == 100);
  const Component& wire = job.dresspacks[0].dresspack.components[0].components[0];
  CHECK(wire.lay_angle == 25 * degree);
  CHECK(wire.hand == Hand::left);
  CHECK(job.dresspacks[0].dresspack.components[0].hand == Hand::right);
  CHECK(job.dresspacks[0].dresspack.axial_stiffness == 1e5);
  CHECK(job.dresspacks[0].routing.tool_clamp->roll == 12 * degree);
  CHECK_FALSE(job.dresspacks[0].routing.base_clamp->roll.has_value());
  CHECK(job.simulation.time_step == 5 * 1e-3);
  CHECK_FALSE(job.simulation.contact);
  CHECK(job.simulation.floor);
  CHECK(job.simulation.gravity == Vector3d(0, 0, -9.81));
  CHECK(job.strain.slip == std::vector<Slip>{Slip::stick, Slip::free});
  CHECK(job.strain.kinematics == Kinematics::exact);
  CHECK(job.strain.probes[0].component == "cable 1/wire 1");
  CHECK(job.fatigue.stress == Stress::cyclic);
}

TEST_CASE("job: steps, parts and clamps remember where they stand") {
  const Job job = job_of_text(sample_job);
  CHECK(job.motion.steps[0].where.text() == place_of(sample_job, "{text: home", "job.yaml"));
  CHECK(job.motion.steps[1].where.text() == place_of(sample_job, "repeat: 3", "job.yaml"));
  CHECK(job.dresspacks[0].dresspack.components[0].where.text() == place_of(sample_job, "name: cable", "job.yaml"));
  CHECK(job.dresspacks[0].routing.base_clamp->where.text() == place_of(sample_job, "{link: base", "job.yaml"));
}

TEST_CASE("job: unknown keys are refused with the likeliest key") {
  check_case({"segments: 20", "segmens: 20", "segmens", "unknown key 'simulation.segmens'; did you mean 'segments'?"});
  check_case({"damping_source: guessed", "damping_sorce: guessed", "damping_sorce",
              "unknown key 'dresspack.damping_sorce'; did you mean 'damping_source'?"});
  check_case({"fatigue: {", "fatige: {", "fatige: {", "unknown key 'fatige'; did you mean 'fatigue'?"});
  check_case({"gate: 1e-4", "xyzzy: 1", "xyzzy",
              "unknown key 'strain.xyzzy'; keys here: deformation, kinematics, slip, equivalent, "
              "surface_fibres, gate, cable_elements_per_segment, friction_factor, hose_friction_factor, slack_factor, "
              "play_factor, grip_factor, rest, probes"});
}

TEST_CASE("job: a key with the wrong unit is answered with the right one") {
  check_case({"radius_mm: 120", "radius_m: 0.12", "radius_m: 0.12",
              "unknown key 'robot.links[2].capsules[1].radius_m'; its unit is mm, write 'radius_mm: 120'"});
  check_case({"free_length_m: 1.2", "free_length: 1.2", "free_length: 1.2",
              "unknown key 'routing.free_length'; its unit is m, write 'free_length_m'"});
  check_case({"time_step_ms: 5", "time_step_s: 0.005", "time_step_s",
              "unknown key 'simulation.time_step_s'; its unit is ms, write 'time_step_ms: 5'"});
  check_case({"gate: 1e-4", "gate_percent: 0.01", "gate_percent",
              "unknown key 'strain.gate_percent'; this key carries no unit, write 'gate'"});
}

TEST_CASE("job: duplicate keys are refused") {
  check_case({"listed_sites: 3", "listed_sites: 3, listed_sites: 4", "listed_sites: 4",
              "duplicate key 'listed_sites'; keep one of the two"});
}

TEST_CASE("job: missing keys are named with their meaning") {
  check_case({"  damping_source: guessed\n", "", "name: test hose",
              "dresspack.damping_source is missing; add 'damping_source: ...': the source of the damping"});
  check_case({"link: arm, ", "", "{position_m: [0.4",
              "routing.tool_clamp.link is missing; add 'link: ...': the link of the robot with the clamp"});
  check_case({"  tool_clamp: {link: arm, position_m: [0.4, 0, 0], direction: [1, 0, 0], roll_deg: 12}\n", "",
              "free_length_m", "routing.tool_clamp is missing; give link, position_m and direction of the clamp"});
  check_case({"free_length_m: 1.2", "free_length_m:", "free_length_m:",
              "routing.free_length_m has no value; give the free length of the dresspack between the clamps"});
}

TEST_CASE("job: numbers out of range are refused with the range and its unit") {
  check_case(
      {"free_length_m: 1.2", "free_length_m: -1.2", "-1.2",
       "routing.free_length_m is -1.2 (must be > 0 m); give the free length of the dresspack between the clamps"});
  check_case({"segments: 20", "segments: 3", "3, time_step",
              "simulation.segments is 3 (must be 4 .. 2000); give the number of rigid segments of each dresspack"});
  check_case({"damping_time_ms: 10", "damping_time_ms: -1", "-1\n",
              "dresspack.damping_time_ms is -1 (must be >= 0 ms); give the Kelvin-Voigt time of twist and, "
              "without loss_factor, of bending, from a decay test"});
  check_case(
      {"lay_angle_deg: 25", "lay_angle_deg: 61", "61, hand",
       "dresspack.components[1].components[1].lay_angle_deg is 61 (must be 0 .. 60 deg); give the angle between the "
       "part and the parent's axis (alpha)"});
}

TEST_CASE("job: a cable alone on a robot has its mass, stiffness and damping by default") {
  const std::string routing =
      "routing:\n  base_clamp: {link: link_3, position_m: [-0.1, 0, 0.45], direction: [1, 0, 0.45]}\n"
      "  tool_clamp: {link: link_6, position_m: [0.144, 0, 0.174], direction: [1, 0, -0.45]}\n  free_length_m: 2.02\n";
  const std::string text =
      "robot: abb_irb6640_185_280\nmotion: easy\n" + routing +
      "dresspack: {name: lead, source: test, cable: {name: c, data_sheet: \"4 x 0.5 mm2, class 6, outer diameter 6.5 mm\"}}\n";
  const Job job = job_of_text(text);
  const Dresspack& lead = job.dresspacks.front().dresspack;
  CHECK(lead.mass_per_length == Approx(0.0551).epsilon(0.02));  // by hand: 2 mm2 of copper, the rest of polymer
  CHECK(lead.bending_stiffness > 0);
  CHECK(lead.torsional_stiffness > 0);
  CHECK(lead.axial_stiffness > 0);
  CHECK_THAT(lead.estimates, Catch::Contains("damping_time_ms 20"));
  CHECK(job_text(job_of_text(job_text(job))) == job_text(job));
  // A factor changes the lays that the sheet leaves out, also of a cable alone.
  const auto core = [](const Job& of) { return of.dresspacks[0].dresspack.components[0].components[0]; };
  const auto lay = [&](const Job& of) { return core(of).helix_radius / std::tan(core(of).lay_angle); };
  const std::string set = "dresspack.estimated_lay_factor=0.67";
  constexpr double widened = 0.01;  // a shorter lay leaves less room for the cores
  CHECK(lay(job_of_text(text, {set})) == Approx(0.67 * lay(job)).epsilon(widened));
  CHECK_THAT(job_of_text(text, {set}).dresspacks[0].dresspack.estimates, Catch::Contains("lay_length_mm"));
  CHECK_THAT(message_of([&] { job_of_text(text, {"dresspack.estimated_lay_factor=67"}); }),
             Catch::Contains("estimated_lay_factor is 67 (must be 0.5 .. 2)"));
  // The factor reaches a cable of a named dresspack, too. Where it cannot, it is refused.
  const Scratch scratch;
  scratch.write("lead.yaml", text.substr(text.find("{name: lead")));
  const std::string before = text.substr(0, text.find("dresspack:")), file = (scratch / "lead.yaml").string();
  CHECK(lay(job_of_text(before + "dresspack: " + file + "\n", {set})) == lay(job_of_text(text, {set})));
  CHECK(lay(job_of_text(before + "dresspack: {from: " + file + ", estimated_lay_factor: 0.67}\n")) ==
        lay(job_of_text(text, {set})));
  CHECK_THAT(message_of([&] {
               job_of_text(text, {"dresspack.least_bend_radius_mm=50", set});
             }),
             Catch::Contains("comes too late: another key of the dresspack was set before"));
  CHECK_THAT(message_of([&] { job_of_text(before + "dresspack: spot_welding\n", {set}); }),
             Catch::Contains("has no effect: no data sheet of the dresspack leaves out a lay length"));
  std::string given = text;
  given.insert(given.find(", outer diameter"), ", lay length 60 mm");
  CHECK(lay(job_of_text(given, {set})) == Approx(lay(job_of_text(given))));
  // The limits of the cable as a whole may stand beside its data sheet.
  std::string limited = text;
  limited.insert(limited.find("data_sheet"), "least_bend_radius_mm: 65, ");
  CHECK(job_of_text(limited).dresspacks.front().dresspack.least_bend_radius == 0.065);
}

TEST_CASE("job: a box on a link has sides in metres") {
  CHECK_THAT(message_of([] {
               job_of_text(sample_job, {"robot.links.1.boxes=[{position_m: [0, 0, 0], sides_m: [120, 80, 120]}]"});
             }),
             Catch::Contains("a box has a side of 120 m (at most 10); give sides_m in metres: 0.12 if that was in mm"));
}

TEST_CASE("job: numbers that are not finite are refused") {
  for (const char* word : {".nan", ".inf", "-.inf", "nan", "inf"})
    check_case({"free_length_m: 1.2", std::string("free_length_m: ") + word, std::string(word) + "\n  base_clamp",
                std::string("routing.free_length_m is ") + word +
                    " (must be finite); give the free length of the dresspack between the clamps"});
  check_case(
      {"position_m: [0, 0, 0.2]", "position_m: [0, .nan, 0.2]", ".nan",
       "routing.base_clamp.position_m is .nan (must be finite); give the position of the clamp in the link's frame"});
}

TEST_CASE("job: what is not a number is refused with a reminder of the unit") {
  check_case(
      {"free_length_m: 1.2", "free_length_m: 1.2 m", "1.2 m\n",
       "routing.free_length_m is '1.2 m' (must be a number, the unit is in the key: m); give the free length of the "
       "dresspack between the clamps"});
  check_case({"segments: 20", "segments: many", "many",
              "simulation.segments is 'many' (must be a number); give the number of rigid segments of each dresspack"});
  check_case({"segments: 20", "segments: [20]", "[20]",
              "simulation.segments is not one value (must be a number); give the number of rigid segments of each "
              "dresspack"});
  for (const char* word : {"0x10", "1_000", "1,5", "+-5", "1e", "--1", "1.2.3"}) {
    const std::string text = edited(sample_job, "gate: 1e-4", std::string("gate: '") + word + "'");
    CHECK(message_of([&] { job_of_text(text); }).find("must be a number") != std::string::npos);
    if (std::string(word) == "1,5") continue;  // a list's comma if unquoted
    const std::string bare = edited(sample_job, "gate: 1e-4", std::string("gate: ") + word);
    INFO(word);
    CHECK(message_of([&] { job_of_text(bare); }).find("must be a number") != std::string::npos);
  }
}

TEST_CASE("job: numbers may be written in every usual way") {
  for (const char* word : {"0.01", "+0.01", "1e-2", "1.0E-2", ".01", "10e-3"}) {
    INFO(word);
    CHECK(job_of_text(edited(sample_job, "gate: 1e-4", std::string("gate: ") + word)).strain.gate == 0.01);
  }
}

TEST_CASE("job: whole numbers, words, truth values, texts, maps and lists are distinguished") {
  CHECK_THAT(message_of([] { job_of_text(sample_job, {"motion.passes=2000000000"}); }),
             Catch::Contains("motion.passes is 2000000000 (must be a whole number, at most 1e+09)"));
  check_case({"segments: 20", "segments: 20.5", "20.5",
              "simulation.segments is 20.5 (must be a whole number); give the number of rigid segments of each "
              "dresspack"});
  check_case({"mean_stress: swt", "mean_stress: goodman", "goodman",
              "fatigue.mean_stress is 'goodman' (must be none | morrow | swt | walker); give the correction of the "
              "strain-life curve for mean stress"});
  check_case({"slip: [stick, free]", "slip: [stick, glued]", "glued",
              "strain.slip is 'glued' (must be free | stick | friction); give the slip between a part and its "
              "parent: one word, or one per level from the outermost"});
  check_case({"slip: [stick, free]", "slip: []", "[], gate",
              "strain.slip is an empty list; give the slip between a part and its parent: one word, or one per "
              "level from the outermost"});
  check_case({"contact: false", "contact: no", "no}",
              "simulation.contact is 'no' (must be true or false); give whether the dresspack touches the "
              "robot's links"});
  check_case(
      {"name: test hose", "name: [a, b]", "[a, b]", "dresspack.name must be text; give the name of the dresspack"});
  check_case(
      {"routing:\n", "routing: 3\nunused:\n", "3\nunused",
       "routing must be a map of settings; give the clamps and the free length\njob.yaml:45:1: error: unknown key "
       "'unused'; keys here: motion, robot, dresspack, routing, cell, simulation, strain, fatigue, inspection, uncertainty, "
       "calibration"});
  check_case({"probes: [{segment_from_tool: 2, component: cable 1/wire 1}]", "probes: all", "all}",
              "strain.probes must be a list; give the wires whose whole strain history is kept"});
  check_case({"probes: [{segment_from_tool: 2, component: cable 1/wire 1}]", "probes: [cable 1]", "cable 1]",
              "strain.probes[1] must be a map of settings; write {key: value, ...}"});
}

TEST_CASE("job: lists have the length that they must have") {
  check_case({"position_m: [0, 0, 0.2]", "position_m: [0, 0]", "[0, 0], direction",
              "routing.base_clamp.position_m must be three numbers [x, y, z]; give the position of the clamp in the "
              "link's frame"});
  check_case({"joints_deg: [10.7, -5]", "joints_deg: [10.7]", "{joints_deg: [10.7]",
              "joints_deg has 1 angles (the robot has 2 axes); give one angle per axis"});
  check_case({"mounting_pose_deg: [0, 7]", "mounting_pose_deg: [0, 7, 0]", "free_length_m",
              "mounting_pose_deg has 3 angles (the robot has 2 axes); give one angle per axis"});
  check_case({"slip: [stick, free]", "slip: [stick, free, free]", "{slip",
              "strain.slip lists 3 levels (the dresspack has 2); give one word, or one per level, outermost first"});
  check_case({"    - name: arm\n", "", "name: two axes",
              "robot has 2 joints and 2 links (must be one link more); list the base link and one link per joint"});
  check_case({"joints_deg: [10.7, -5]", "joints_deg: []", "[], speed",
              "motion.steps[2].steps[1].joints_deg must be a list of numbers; give the target of a move: one angle "
              "per axis"});
}

TEST_CASE("job: a material may be a table of measured lives instead of a metal's constants") {
  const std::string polymer =
      "  damping_source: guessed\n  materials:\n    - {name: hose, source: made for the tests, "
      "youngs_modulus_GPa: 0.4,\n"
      "       strain_life_table: [{strain_amplitude: 0.05, cycles: 1e3}, {strain_amplitude: 0.01, cycles: "
      "1e6}]}\n"
      "  components:\n";
  const std::string text = edited(edited(sample_job, "  damping_source: guessed\n  components:\n", polymer),
                                  "material: copper", "material: hose");
  const Job job = job_of_text(text);
  const Material& hose = material_of(job, "hose");
  CHECK(hose.youngs_modulus == 0.4e9);
  REQUIRE(hose.strain_life_table.size() == 2);
  CHECK(hose.strain_life_table[1].strain_amplitude == 0.01);
  CHECK(hose.strain_life_table[1].cycles == 1e6);
  const Job again = job_from(parse_yaml(job_text(job), "echo.yaml"));
  CHECK(job_text(again) == job_text(job));
  CHECK(material_of(again, "hose").strain_life_table[0].cycles == 1e3);
  const auto refused = [&](const std::string& from, const std::string& to, const std::string& words) {
    CHECK_THAT(message_of([&] { job_of_text(edited(text, from, to)); }), Catch::Contains(words));
  };
  refused("0.01, cycles", "0.06, cycles",
          "point 2 of strain_life_table of 'hose' is no smaller strain with a longer life; order the points");
  refused(", {strain_amplitude: 0.01, cycles: 1e6}", "",
          "strain_life_table of 'hose' has one point; give at least two");
  refused("youngs_modulus_GPa: 0.4", "youngs_modulus_GPa: 0.4, fatigue_ductility: 2", "fatigue_ductility");
}

TEST_CASE("job: a clamp may stand at one of the robot's mounting points") {
  const std::string robot = edited(sample_job, "robot:\n",
                                   "robot:\n  mounting_points: [{name: elbow, link: turret, position_m: [1, "
                                   "2, 3], direction: [0, 1, 0]}]\n");
  const auto begin = robot.find("base_clamp: {"), end = robot.find("}", begin);
  const auto with_clamp = [&](const std::string& clamp) {
    return robot.substr(0, begin) + "base_clamp: {" + clamp + robot.substr(end);
  };
  const Job job = job_of_text(with_clamp("mounting_point: elbow, roll_deg: 10"));
  REQUIRE(job.dresspacks[0].routing.base_clamp);
  CHECK(job.dresspacks[0].routing.base_clamp->link == "turret");
  CHECK(job.dresspacks[0].routing.base_clamp->position == Vector3d(1, 2, 3));
  CHECK(job.dresspacks[0].routing.base_clamp->direction == Vector3d(0, 1, 0));
  CHECK(*job.dresspacks[0].routing.base_clamp->roll == Approx(10 * degree));
  CHECK(job_text(job_from(parse_yaml(job_text(job), "echo.yaml"))) == job_text(job));
  const Job moved = job_of_text(with_clamp("mounting_point: elbow, position_m: [1.01, 2, 3]"));
  CHECK(moved.dresspacks[0].routing.base_clamp->link == "turret");
  CHECK(moved.dresspacks[0].routing.base_clamp->position == Vector3d(1.01, 2, 3));
  CHECK(moved.dresspacks[0].routing.base_clamp->direction == Vector3d(0, 1, 0));
  const Job tilted = job_of_text(with_clamp("mounting_point: elbow, direction: [0.1, 1, 0]"));
  CHECK(tilted.dresspacks[0].routing.base_clamp->position == Vector3d(1, 2, 3));
  CHECK(tilted.dresspacks[0].routing.base_clamp->direction == Vector3d(0.1, 1, 0));
  CHECK_THAT(message_of([&] { job_of_text(with_clamp("mounting_point: knee")); }),
             Catch::Contains("the robot has no mounting point 'knee'; one of: elbow"));
  CHECK_THAT(message_of([&] { job_of_text(with_clamp("mounting_point: elbow, link: arm")); }),
             Catch::Contains("a clamp has both a mounting_point and a link; keep one of the two"));
}

TEST_CASE("job: joints that follow and external axes") {
  const auto with = [&](const std::string& axes) {
    return edited(sample_job, "robot:\n", "robot:\n  external_axes: [" + axes + "]\n");
  };
  const Job job =
      job_of_text(with("{name: track, lower_mm: -100, upper_mm: 4000, speed_mm_per_s: 1000, "
                       "acceleration_mm_per_s2: 2000}, {name: table, "
                       "kind: rotary, carries: nothing, axis: [0, 0, 1], lower_deg: -180, upper_deg: 180, "
                       "speed_deg_per_s: 90, "
                       "acceleration_deg_per_s2: 180}"));
  REQUIRE(job.robot.external_axes.size() == 2);
  CHECK(job.robot.external_axes[0].acceleration == Approx(2));
  CHECK(job.robot.external_axes[1].upper == Approx(180 * degree));
  CHECK(job.robot.external_axes[1].carries == ExternalAxis::Carries::nothing);
  CHECK(job_text(job_from(parse_yaml(job_text(job), "echo.yaml"))) == job_text(job));
  const auto refused = [&](const std::string& text, const std::string& words) {
    CHECK_THAT(message_of([&] { job_of_text(text); }), Catch::Contains(words));
  };
  refused(with("{name: track, lower_mm: 5, upper_mm: 5, speed_mm_per_s: 1, acceleration_mm_per_s2: 1}"),
          "limits of track are empty (lower >= upper); correct them");
  refused(with("{name: track, lower_mm: 0, upper_mm: 5, speed_mm_per_s: 0, acceleration_mm_per_s2: 1}"),
          "speed_mm_per_s is 0 (must be > 0 mm/s)");
  refused(with("{name: track, lower_mm: 0, upper_mm: 5, speed_mm_per_s: 1, acceleration_mm_per_s2: 1, axis: "
               "[0, 0, 0]}"),
          "axis of track is zero; give its direction");
  refused(with("{name: track, kind: rotary, lower_mm: 0, upper_mm: 5}"), "lower_deg");
  const std::string following =
      edited(sample_job, "lower_deg: -60.1, upper_deg: 80, speed_deg_per_s: 90,\n       acceleration_deg_per_s2: 300",
             "follows: axis_1, ratio: -1, offset_deg: 5");
  refused(edited(following, "follows: axis_1", "follows: axis_2"), "axis_2 follows 'axis_2', which is no driven joint");
  refused(edited(following, "ratio: -1", "ratio: -1, lower_deg: 3"), "unknown key");
}

TEST_CASE("job: strains depend on whether slack, friction on the hose and grips are known, not on their spreads") {
  const std::string any = part_text(job_of_text(sample_job), JobPart::strain);
  for (const std::string key : {"slack", "friction_hose", "grip"}) {
    CHECK(part_text(job_of_text(sample_job, {"uncertainty." + key + "=1"}), JobPart::strain) != any);
    CHECK(part_text(job_of_text(sample_job, {"uncertainty." + key + "=1.5"}), JobPart::strain) == any);
  }
}

TEST_CASE("job: a sleeve has a material with wear rates, which wires and the hose's wall cannot be of") {
  const auto with = [&](const std::string& keys) {
    return edited(sample_job, "  damping_source: guessed\n", "  damping_source: guessed\n" + keys);
  };
  const std::string sleeve = "  sleeve: {thickness_mm: 2, material: polyurethane}\n";
  const Job job = job_of_text(with(sleeve));
  const Dresspack& dresspack = job.dresspacks[0].dresspack;
  REQUIRE(find_material(dresspack, "polyurethane"));
  CHECK(find_material(dresspack, "polyurethane")->wear[0].rate == Approx(3e-14));  // 3e-5 mm3/(N m)
  CHECK(job_text(job_from(parse_yaml(job_text(job), "echo.yaml"))) == job_text(job));
  const Job other = job_of_text(with("  sleeve: {thickness_mm: 3, material: polyurethane}\n"));
  CHECK(part_text(job, JobPart::sim) == part_text(other, JobPart::sim));
  CHECK(part_text(job, JobPart::strain) == part_text(other, JobPart::strain));
  CHECK(part_text(job, JobPart::fatigue) != part_text(other, JobPart::fatigue));
  const auto refused = [&](const std::string& keys, const std::string& words,
                           const std::vector<std::string>& sets = {}) {
    CHECK_THAT(message_of([&] { job_of_text(with(keys), sets); }), Catch::Contains(words));
  };
  refused("  sleeve: {thickness_mm: 2, material: copper}\n",
          "sleeve.material 'copper' has no wear rates; give the material");
  refused("  hose_material: polyurethane\n  inner_diameter_mm: 53\n",
          "hose_material 'polyurethane' only has wear rates (the wall's strain needs a life)");
  refused("  sleeve: {thickness_mm: 0, material: polyurethane}\n", "thickness_mm");
  refused("  sleeve: {thickness_mm: 30, material: polyurethane}\n",
          "the sleeve is 30 mm thick, the dresspack 60 mm wide; give thickness_mm of one wall");
}

TEST_CASE("job: the jacket of a cable has a material with wear rates, and only lives depend on it") {
  const auto with = [&](const std::string& jacket) {
    const std::string radius = "      helix_radius_mm: 18.45\n";
    return edited(sample_job, radius, radius + (jacket.empty() ? "" : "      jacket: " + jacket + "\n"));
  };
  const Job job = job_of_text(with("{thickness_mm: 1, material: pvc}")), bare = job_of_text(with(""));
  REQUIRE(find_material(job.dresspacks[0].dresspack, "pvc"));
  CHECK(job_text(job_from(parse_yaml(job_text(job), "echo.yaml"))) == job_text(job));
  CHECK(part_text(job, JobPart::sim) == part_text(bare, JobPart::sim));
  CHECK(part_text(job, JobPart::strain) == part_text(bare, JobPart::strain));
  CHECK(part_text(job, JobPart::fatigue) != part_text(bare, JobPart::fatigue));
  const auto refused = [&](const std::string& jacket, const std::string& words) {
    CHECK_THAT(message_of([&] { job_of_text(with(jacket)); }), Catch::Contains(words));
  };
  refused("{thickness_mm: 1, material: copper}",
          "jacket.material 'copper' has no wear rates; give the material the list wear, or leave the jacket out");
  refused("{thickness_mm: 5, material: pvc}",
          "the jacket of 'cable' is 5 mm thick, the cable 10 mm wide; give thickness_mm of one wall");
}

TEST_CASE("job: the hose's wall has a material of its own and a factor or a profile") {
  const auto with = [&](const std::string& keys) {
    return edited(sample_job, "  damping_source: guessed\n",
                  "  damping_source: guessed\n  hose_material: hose_polyamide\n" + keys);
  };
  const std::string profile = "  hose_corrugation: {pitch_mm: 4, height_mm: 3.5, wall_mm: 0.5}\n",
                    bore = "  inner_diameter_mm: 53\n";
  const Job job = job_of_text(with(profile), {"fatigue.material=copper"});
  CHECK(hose_material_of(job, job.dresspacks[0].dresspack).name == "hose_polyamide");
  CHECK(material_of(job, "hose_polyamide").name == "copper");
  REQUIRE(job.dresspacks[0].dresspack.hose_corrugation);
  CHECK(job.dresspacks[0].dresspack.hose_corrugation->height == Approx(0.0035));
  CHECK_FALSE(job.dresspacks[0].dresspack.hose_strain_factor);
  CHECK(job_text(job_from(parse_yaml(job_text(job), "echo.yaml"))) == job_text(job));
  CHECK(part_text(job, JobPart::strain) != part_text(job_of_text(with(bore)), JobPart::strain));
  // A motion depends on the wall only by the least bend radius that follows from it.
  CHECK(part_text(job, JobPart::sim) != part_text(job_of_text(with(bore)), JobPart::sim));
  const std::string given = "  least_bend_radius_mm: 300\n";
  CHECK(part_text(job_of_text(with(given + profile)), JobPart::sim) ==
        part_text(job_of_text(with(given + bore)), JobPart::sim));

  CHECK(is_hose_wall(job.dresspacks[0].dresspack, "hose 1"));
  CHECK(is_hose_wall(job.dresspacks[0].dresspack, "hose 16"));
  for (const char* other : {"hose", "hose ", "hose x", "hose 1/wire 2", "hoses 1", "a/hose 1"})
    CHECK_FALSE(is_hose_wall(job.dresspacks[0].dresspack, other));
  CHECK_FALSE(is_hose_wall(job_of_text(sample_job).dresspacks[0].dresspack, "hose 1"));

  const auto refused = [&](const std::string& keys, const std::string& words) {
    CHECK_THAT(message_of([&] { job_of_text(with(keys)); }), Catch::Contains(words));
  };
  refused(profile + "  hose_strain_factor: 0.2\n",
          "both hose_strain_factor and hose_corrugation are given; keep one of the two");
  refused("  hose_corrugation: {pitch_mm: 4, height_mm: 2, wall_mm: 0.5}\n",
          "height_mm of hose_corrugation is 2 (must be at least 2.5 mm: wall_mm plus half of the pitch;");
  refused("  hose_corrugation: {pitch_mm: 4, height_mm: 4, wall_mm: 1.5}\n",
          "wall_mm of hose_corrugation is 1.5 (must be at most 1 mm");
  refused("  hose_corrugation: {pitch_mm: 4, height_mm: 4}\n", "wall_mm");
  refused("  hose_strain_factor: 0\n", "hose_strain_factor");
}

TEST_CASE("job: a dresspack may have limits of its maker") {
  const auto with = [](const std::string& key) {
    return edited(sample_job, "  damping_source: guessed\n", "  damping_source: guessed\n  " + key + "\n");
  };
  const Job job = job_of_text(with("least_bend_radius_mm: 250\n  most_twist_deg_per_m: 90"));
  CHECK(job.dresspacks[0].dresspack.least_bend_radius.value() == Approx(0.25));
  CHECK(job.dresspacks[0].dresspack.most_twist.value() == Approx(90 * degree));
  CHECK_FALSE(job_of_text(sample_job).dresspacks[0].dresspack.most_twist);
  CHECK_THAT(message_of([&] { job_of_text(with("most_twist_deg_per_m: 0")); }),
             Catch::Contains("dresspack.most_twist_deg_per_m is 0 (must be > 0 deg/m); give the"));
}

TEST_CASE("job: what contradicts itself is refused") {
  check_case({"lower_deg: -60.1", "lower_deg: 90", "{name: axis_2",
              "limits of axis_2 are empty (lower >= upper); correct them"});
  check_case({"axis: [0, 1, 0]", "axis: [0, 0, 0]", "{name: axis_2", "axis of axis_2 is zero; give its direction"});
  check_case({"{dwell_s: 0.5}", "{dwell_s: 0.5, joints_deg: [0, 0]}", "{dwell_s",
              "a step must be one of: joints_deg or position_mm (a move), dwell_s, repeat with steps; split "
              "it into steps"});
  check_case({"{dwell_s: 0.5}", "{dwell_s: 0.5, zone_deg: 1}", "{dwell_s",
              "zone_deg belongs to a move; take it out of this step"});
  check_case(
      {"{dwell_s: 0.5}", "{dwell_s: 0.5, tool: gun}", "{dwell_s", "tool belongs to a move; take it out of this step"});
  check_case({"- name: turret", "- name: base", "name: two axes",
              "two links of the robot are named 'base'; give each another name"});
  check_case({"speed_percent: 50", "speed_percent: 50, speed_deg_per_s: 3", "{joints_deg: [10.7",
              "both speed_percent and speed_deg_per_s are given; keep one of the two"});
  check_case({"    - repeat: 3\n      text: nodding\n", "    - text: nodding\n", "text: nodding",
              "a block needs both repeat (at least 1) and steps; give both"});
  check_case({"    - {text: home, joints_deg: [0, 0], zone_deg: 0}\n", "", "repeat: 3",
              "the program must begin with a move (where the robot starts); begin with joints_deg"});
  check_case({"link: arm", "link: hand", "{link: hand",
              "routing.tool_clamp.link 'hand' is not a link of the robot; one of: base, turret, arm"});
  check_case({"direction: [1, 0, 0]", "direction: [0, 0, 0]", "{link: arm",
              "routing.tool_clamp.direction is zero; give where the dresspack points"});
  check_case({"position_m: [0.4, 0, 0], direction: [1, 0, 0]", "position_m: [0, 0, 150], direction: [1, 0, 0]",
              "{link: arm",
              "routing.tool_clamp.position_m is 150 m away from the frame of arm (at most 30); give it in "
              "metres, in the link's frame"});
  check_case({", material: copper}", "}", "{name: wire",
              "'wire' must have either a material (a wire) or components; give one of the two"});
  check_case({"helix_radius_mm: 2.5, lay_angle_deg: 25", "helix_radius_mm: 0", "{name: wire",
              "6 parts 'wire' lie on the axis (helix_radius_mm is 0); give their distance from the axis"});
  check_case({"helix_radius_mm: 2.5", "helix_radius_mm: 7.5", "{name: wire",
              "'wire' reaches 7.6 mm from the axis of 'cable', 2.6 mm outside it (radius 5 mm); check "
              "helix_radius_mm and radius_mm"});
  check_case({"name: cable", "name: a/b", "name: a/b", "name 'a/b' holds a '/'; choose another name"});
  check_case({"sample_rate_Hz: 25", "sample_rate_Hz: 30", "{segments",
              "simulation.sample_rate_Hz 30 leaves 6.66667 steps of 5 ms between samples; choose both so "
              "that it is a "
              "whole number"});
}

TEST_CASE("job: what is no job says so") {
  CHECK(
      message_of([] { job_of_text("base: job.yaml\nmotion: easy\nvary: {strain.slip: [free, stick]}\n"); }) ==
      "job.yaml:1:1: error: is a study (it has the key 'base'), no job; give it to dresslife run, improve or reprogram");
  CHECK(message_of([] { job_of_text(""); }) ==
        "job.yaml:1:1: error: holds no job; write robot, motion, dresspack, routing");
  CHECK(message_of([] { job_of_text("- a\n- b\n"); }) ==
        "job.yaml:1:1: error: holds no job; write robot, motion, dresspack, routing");
}

TEST_CASE("job: the resolved job reads back to the identical text") {
  const std::string text = job_text(job_of_text(sample_job));
  CHECK(job_text(job_of_text(text)) == text);
  CHECK(text.find("lower_deg: -60.1,") == std::string::npos);  // block style, one key per line
  CHECK(text.find("lower_deg: -60.1\n") != std::string::npos);
  CHECK(text.find("speed_deg_per_s: 33.3\n") != std::string::npos);
  CHECK(text.find("operating_hours_per_week: 80\n") != std::string::npos);  // a default, written explicitly
  CHECK(text.find("youngs_modulus_GPa: 117\n") != std::string::npos);       // copper, written explicitly
}

TEST_CASE("job: the shipped entries make a job that reads back to the identical text") {
  const std::string text =
      "robot: abb_irb6640_185_280\nmotion: easy\ndresspack: spot_welding\n"
      "routing:\n  free_length_m: 2\n"
      "  base_clamp: {link: base_link, position_m: [0, 0, 1], direction: [0, 0, 1]}\n"
      "  tool_clamp: {link: link_6, position_m: [0.1, 0, 0], direction: [1, 0, 0]}\n";
  const std::string resolved = job_text(job_of_text(text));
  CHECK(job_text(job_of_text(resolved)) == resolved);
  CHECK(resolved.find("ESTIMATE") != std::string::npos);
}

TEST_CASE("job: clamp poses make robot and clamps needless, and a given clamp wrong") {
  const Scratch scratch;
  const std::string text = sample_job.substr(sample_job.find("dresspack:"));
  const std::string without =
      edited(text, text.substr(text.find("  base_clamp"), text.find("simulation:") - text.find("  base_clamp")), "");
  const auto file = scratch.write("job.yaml", "motion: {clamp_poses: poses/p.csv}\n" + without);
  const Job job = read_job(file);
  CHECK(job.motion.clamp_poses == scratch / "poses/p.csv");  // relative to the job, independent of the working folder
  CHECK(files_beside(job) == std::vector<std::filesystem::path>{scratch / "poses/p.csv"});
  CHECK(job.robot.joints.empty());
  CHECK(job_text(job_of_text(job_text(job))) == job_text(job));
  CHECK(files_beside(job_of_text(sample_job)).empty());
  const auto both = scratch.write("both.yaml", "motion: {clamp_poses: p.csv}\n" + text);
  CHECK(message_of([&] {
          read_job(both);
        }).find("clamps are given although motion.clamp_poses brings their poses; keep one") != std::string::npos);
}

TEST_CASE("job: each stage depends on its own part of the job only") {
  const Job job = job_of_text(sample_job);
  const auto parts = [](const Job& of) {
    return std::vector<std::string>{part_text(of, JobPart::sim), part_text(of, JobPart::strain),
                                    part_text(of, JobPart::fatigue)};
  };
  const std::vector<std::string> before = parts(job);
  const auto changed = [&](const std::string& set) {
    const std::vector<std::string> after = parts(job_of_text(sample_job, {set}));
    std::string which;
    for (std::size_t i = 0; i < 3; ++i) which += after[i] == before[i] ? '-' : 'x';
    return which;
  };
  CHECK(changed("simulation.segments=21") == "x--");
  CHECK(changed("motion.steps.1.joints_deg=[1, 0]") == "x--");
  CHECK(changed("routing.free_length_m=1.3") == "x--");
  CHECK(changed("routing.longest_bracket_mm=900") == "x--");  // a warning of dresslife-sim depends on it
  CHECK(changed("dresspack.diameter_mm=61") == "x--");
  CHECK(changed("dresspack.components.1.count=4") == "-x-");
  CHECK(changed("strain.kinematics=thesis") == "-x-");
  CHECK(changed("fatigue.stress=elastic") == "--x");
  CHECK(changed("fatigue.material=aluminium_7070_t6") == "--x");
  CHECK(changed("simulation.segments=20") == "---");
}

TEST_CASE("job: strains depend on a metal's stiffness, and on its cyclic curve where a grip bounds a cable's force") {
  const auto parts = [](const std::string& constants, const std::string& curve, std::vector<std::string> sets = {},
                        const std::string& modulus = "117") {
    sets.push_back("dresspack.materials=[{name: copper, source: s, youngs_modulus_GPa: " + modulus + ", " + constants +
                   curve + "}]");
    const Job job = job_of_text(sample_job, sets);
    return std::array{part_text(job, JobPart::strain), part_text(job, JobPart::fatigue), part_text(job, JobPart::sim)};
  };
  const std::string one =
      "fatigue_strength_MPa: 400, fatigue_strength_exponent: -0.1, fatigue_ductility: 0.5, "
      "fatigue_ductility_exponent: -0.5";
  const std::string other =
      "fatigue_strength_MPa: 500, fatigue_strength_exponent: -0.12, fatigue_ductility: 0.4, "
      "fatigue_ductility_exponent: -0.6";
  const std::string curve = ", cyclic_strength_MPa: 450, cyclic_hardening_exponent: 0.2";
  for (const std::string& changed :
       {other, one + ", tensile_strength_MPa: 240", one + curve, one + ", poisson_ratio: 0.3"}) {
    CHECK(parts(one, "")[0] == parts(changed, "")[0]);
    CHECK(parts(one, "")[1] != parts(changed, "")[1]);
    CHECK(parts(one, "")[2] == parts(changed, "")[2]);
  }
  CHECK(parts(one, "")[0] != parts(one, "", {}, "118")[0]);
  CHECK_THAT(message_of([&] { parts(one, ", poisson_ratio: 0.51"); }), Catch::Contains("must be 0 .. 0.5"));
  // The largest strain that a grip holds follows from the curve, given or implied: n' is b / c, here 0.2 for both.
  for (const std::string at : {"base", "tool"}) {
    const std::vector<std::string> grip{"dresspack.components.1." + at + "_grip_N=10"};
    CHECK(parts(one, curve, grip)[0] == parts(other, curve, grip)[0]);
    CHECK(parts(one, "", grip)[0] != parts(other, "", grip)[0]);
    CHECK(parts(one, "", grip)[0].find("cyclic_hardening_exponent: 0.2\n") != std::string::npos);
    CHECK(parts(one, curve, grip)[0] !=
          parts(one, ", cyclic_strength_MPa: 451, cyclic_hardening_exponent: 0.2", grip)[0]);
  }
}

TEST_CASE("job: a wire's material is its own unless the fatigue settings name one for all") {
  const Job own = job_of_text(sample_job);
  CHECK(material_of(own, "copper").youngs_modulus == 117e9);
  const Job other = job_of_text(sample_job, {"fatigue.material=aluminium_7070_t6"});
  CHECK(material_of(other, "copper").youngs_modulus == 71e9);
}

TEST_CASE("job: the time step is a number or left to the run") {
  CHECK_FALSE(job_of_text(sample_job).simulation.choose_time_step);
  const Job chosen = job_of_text(sample_job, {"simulation.time_step_ms=auto"});
  CHECK(chosen.simulation.choose_time_step);
  const std::string text = job_text(chosen);
  CHECK(text.find("time_step_ms: auto\n") != std::string::npos);
  CHECK(job_of_text(text).simulation.choose_time_step);
  const Job fixed = job_of_text(text, {"simulation.time_step_ms=2"});
  CHECK_FALSE(fixed.simulation.choose_time_step);
  CHECK(fixed.simulation.time_step == Approx(0.002));
  const std::string message = message_of([] { job_of_text(sample_job, {"simulation.time_step_ms=fast"}); });
  CHECK(message.find("time_step_ms") != std::string::npos);
  CHECK(message.find("fast") != std::string::npos);
}

TEST_CASE("job: the manual lists every key once with range, default and meaning") {
  const std::vector<KeyRow> rows = job_keys();
  const std::string manual = key_tables(rows);
  CHECK(manual.find("### job\n") == 0);
  CHECK(manual.find("| `free_length_m` | > 0 | required | The free length of the dresspack between the clamps. |\n") !=
        std::string::npos);
  CHECK(manual.find("| `time_step_ms` | 0.01 .. 20 \\| auto | 5 | The integration step. ") != std::string::npos);
  CHECK(manual.find("| `hand` | right \\| left | right | The direction of the helix: right (Z) or left (S). |\n") !=
        std::string::npos);
  std::set<std::string> paths;
  for (const KeyRow& row : rows) {
    INFO(row.map << "." << row.key << ": " << row.meaning);
    CHECK(paths.insert(row.map + "." + row.key).second);
    CHECK((row.meaning.ends_with('.') || row.meaning.ends_with(".`")));
    // Whole sentences begin with a capital letter, unless they begin with a choice: "torsion: the length ...".
    CHECK((std::isupper(static_cast<unsigned char>(row.meaning[0])) != 0 || row.meaning.find(": ") < 20));
    CHECK(std::count_if(row.fallback.begin(), row.fallback.end(), [](char c) { return std::isdigit(c) != 0; }) < 8);
    CHECK(row.map.find("calibration") == std::string::npos);
  }
  // A struct within itself, or at a second place, refers to its first description.
  CHECK(manual.find("### motion.steps[].steps[]") == std::string::npos);
  CHECK(manual.find("### routing.tool_clamp") == std::string::npos);
  CHECK(manual.find("The clamp nearer to the tool. Its keys are those of `routing.base_clamp`.") != std::string::npos);
}

}  // namespace
