// The three file formats, dataset by dataset: the public contract between the stages.
#include <algorithm>
#include <stdexcept>

#include "pipeline/files/files.h"

namespace dresslife::pipeline {
namespace {

/// A set of sites with their turning points; strain.h5 holds three: the job's own under "" and the two
/// bounds.
void add_site_set(std::vector<Dataset>& datasets, const std::string& group, const std::string& of) {
  const std::string site = of + "site", reversal = of + "reversal";
  datasets.push_back({group + "/site/segment",
                      Type::i32,
                      {site},
                      "1",
                      "segment of the site, counted from the base, 0 first"});
  datasets.push_back(
      {group + "/site/component",
       Type::text,
       {site},
       "1",
       "path of the wire, outermost part first; before it, among several, the dresspack's name"});
  datasets.push_back({group + "/site/helix",
                      Type::f64,
                      {site, "level", "3"},
                      "m, rad, rad",
                      "helix radius, lay angle (negative: left hand), phase at the segment's centre; "
                      "outermost level first"});
  datasets.push_back(
      {group + "/site/fibre",
       Type::f64,
       {site, "2"},
       "m, rad",
       "radius and angle of the fibre on the wire, from the inward normal; 0 0: the wire's axis"});
  datasets.push_back({group + "/site/material", Type::text, {site}, "1", "material of the wire"});
  for (auto table = datasets.end() - 5; table != datasets.end(); ++table) table->deflate = true;
  datasets.push_back({group + "/reversal/offset",
                      Type::u64,
                      {site + "+1"},
                      "1",
                      "turning points of site k are [offset k, offset k+1)"});
  datasets.push_back(
      {group + "/reversal/strain", Type::f32, {reversal}, "1", "strain at the turning point, kept to 5e-8"});
  datasets.back().decimals = 7;  // a five-thousandth of the default gate
  datasets.push_back({group + "/reversal/sample", Type::u32, {reversal}, "1", "sample of the turning point"});
  datasets.back().lists = true;
}

/// Which dresspack is where, as in the motion file. Absent in older files.
void add_dresspacks(std::vector<Dataset>& datasets) {
  datasets.push_back(
      {"/segment/dresspack",
       Type::i32,
       {"segment"},
       "1",
       "dresspack that each segment belongs to, 0 first: one after the other, each from base to tool; "
       "absent: one dresspack",
       false,
       true});
  datasets.push_back({"/dresspack/name",
                      Type::text,
                      {"dresspack"},
                      "1",
                      "names of the dresspacks; empty: the only one of a job without a list",
                      false,
                      true});
}

/// What a cell designer asks of the motion: one table, and along the dresspack. Absent in older files.
void add_checks(std::vector<Dataset>& datasets) {
  const auto add = [&](const char* path, Type type, const char* axis, const char* unit, const char* meaning) {
    datasets.push_back({path, type, {axis}, unit, meaning, true, true});
  };
  const char *line = "check", *link = "hose_link";
  add("/check/name", Type::text, line, "1", "what is checked");
  add("/check/value", Type::f64, line, "see /check/unit",
      "its worst value; inf: a bend radius without any bend");
  add("/check/unit", Type::text, line, "1", "unit of value and limit");
  add("/check/limit", Type::f64, line, "see /check/unit", "what is warned of; inf: no limit");
  add("/check/warning", Type::i32, line, "1", "1: the limit is broken");
  add("/check/time", Type::f64, line, "s", "when the value stood");
  add("/check/step", Type::i32, line, "1", "index of the program line being executed then");
  add("/check/position", Type::f64, line, "m",
      "where, from the base clamp along the dresspack; -1: of the whole");
  add("/check/dresspack", Type::i32, line, "1", "of which dresspack; absent: there is only one");
  add("/check/curvature", Type::f64, link, "1/m",
      "largest bending curvature of each elastic link, every step counted: at the joints of the segments, "
      "with one on either side of a clamp between two spans");
  add("/check/curvature_time", Type::f64, link, "s", "when");
  add("/check/twist", Type::f64, link, "rad/m", "largest twist by size, with its sign");
  add("/check/twist_time", Type::f64, link, "s", "when");
  add("/check/tension", Type::f64, link, "N", "largest pull");
  add("/check/tension_time", Type::f64, link, "s", "when");
  add("/check/net_twist", Type::f64, "sample", "rad",
      "twist of the whole dresspack, whole turns counted; of several the sum");
}

Format make_motion_format() {
  Format format{"dresslife-motion", 1, "dresslife-sim", "how the dresspack moves", {}, {}};
  format.datasets = {
      {"/time", Type::f64, {"sample"}, "s", "time of each sample"},
      {"/segment/position", Type::f64, {"sample", "segment", "3"}, "m", "segment centres in the world"},
      {"/segment/orientation",
       Type::f64,
       {"sample", "segment", "4"},
       "1",
       "unit quaternion w x y z, body to world; body z is the tangent toward the tool"},
      {"/segment/length", Type::f64, {"segment"}, "m", "rest length"},
      {"/clamp/position",
       Type::f64,
       {"sample", "clamp", "3"},
       "m",
       "clamps in the world, dresspack by dresspack: base side first, tool side last"},
      {"/clamp/orientation",
       Type::f64,
       {"sample", "clamp", "4"},
       "1",
       "unit quaternion w x y z of the clamps"},
      {"/clamp/segment",
       Type::i32,
       {"clamp"},
       "1",
       "segments of the file before each clamp: 0 at the first, all at the last; where a further dresspack "
       "begins, its base clamp repeats the number of the tool clamp before it; absent: two clamps, at the "
       "ends",
       false,
       true},
      {"/clamp/travel",
       Type::f64,
       {"sample", "dresspack"},
       "m",
       "how far a retraction unit has let each dresspack's base clamp out; absent without one",
       false,
       true},
      {"/robot/joint_position", Type::f64, {"sample", "joint"}, "rad", "joint angles", false, true},
      {"/robot/link_pose",
       Type::f64,
       {"sample", "link", "7"},
       "m, 1",
       "position and quaternion w x y z of each link; attribute `links` names them, comma-separated",
       false,
       true},
      {"/program/step", Type::i32, {"sample"}, "1", "index of the program line being executed"},
      {"/program/text", Type::text, {"line"}, "1", "the lines of the program"},
      {"/contact/count",
       Type::i32,
       {"sample"},
       "1",
       "contacts of the dresspack, most at a time since the sample before"},
      {"/contact/max_depth",
       Type::f64,
       {"sample"},
       "m",
       "deepest penetration since the sample before; 0 without contact"},
      {"/contact/force",
       Type::f32,
       {"sample", "segment"},
       "N",
       "largest normal force on each segment since the sample before",
       false,
       true,
       true},
      {"/contact/obstacle",
       Type::i32,
       {"sample", "segment"},
       "1",
       "what pressed it then: index into the attribute `obstacles` of /contact/work; -1: nothing",
       false,
       true,
       true},
      {"/contact/rubbing",
       Type::f32,
       {"sample", "segment"},
       "J",
       "work of friction on each segment since the sample before",
       false,
       true,
       true},
      {"/contact/work",
       Type::f64,
       {"segment", "obstacle"},
       "J",
       "work of friction over the motion; attribute `obstacles` names the robot's links, floor, dresspack "
       "(itself or another), cell, guide rings",
       false,
       true},
      {"/contact/largest_force",
       Type::f64,
       {"segment", "obstacle"},
       "N",
       "largest normal force over the motion",
       false,
       true},
      {"/energy", Type::f64, {"sample", "3"}, "J", "kinetic, elastic, gravitational"},
      {"/tension", Type::f64, {"sample", "segment"}, "N", "axial force in each segment"},
  };
  add_dresspacks(format.datasets);
  const auto stiffness = [&](const char* path, const char* unit, const char* meaning) {
    format.datasets.push_back({path, Type::f64, {"dresspack"}, unit, meaning, false, true});
  };
  stiffness("/dresspack/bending_stiffness", "N m2", "E I as it was simulated, given or from the construction");
  stiffness("/dresspack/torsional_stiffness", "N m2", "G J, likewise");
  stiffness("/dresspack/axial_stiffness", "N", "E A, likewise");
  add_checks(format.datasets);
  format.attributes = {
      {"repeats", "repeats of the motion that were run; the last one is in the file", false, true},
      {"repeat_distance",
       "how far from where it began the dresspack ended it, m; absent where the motion does not return",
       false, true},
      {"time_step", "integration step of the last repeat, s", false, true},
      {"curvature_error",
       "estimated relative rms error that the step leaves in the curvature of the liveliest seconds", false,
       true},
      {"warnings",
       "what a person should look at before believing the results: a line each, kind, place and words between tabs, of "
       "the stages before, too; empty: nothing; absent in files that do not tell",
       true, true},
  };
  return format;
}

/// Cables that run from clamp to clamp: what makes their forces, and where loose ones lie. Absent where none slides.
void add_cables(std::vector<Dataset>& datasets) {
  const auto add = [&](const char* path, Type type, std::vector<std::string> axes, const char* unit,
                       const char* meaning) { datasets.push_back({path, type, axes, unit, meaning, false, true}); };
  add("/cable/name", Type::text, {"cable"}, "1",
      "cables: parts right in the dresspack that hold parts; of each span between two clamps anew");
  add("/cable/span", Type::i32, {"cable"}, "1", "of /cable_span between whose clamps each lies");
  add("/cable/dresspack", Type::i32, {"cable"}, "1", "of the job's dresspacks, 0 first");
  add("/cable/component", Type::i32, {"cable"}, "1", "of that dresspack's components, 0 first");
  add("/cable/strain", Type::f64, {"sample", "cable", "3"}, "1",
      "strain that makes its force: the largest along it by size, that at its base clamp, that at its tool clamp");
  add("/cable/clamp_place", Type::f64, {"cable", "2", "2"}, "m",
      "its axis at its base and its tool clamp, toward d1 and d2 of the dresspack");
  add("/cable/grip_slip", Type::f64, {"cable", "2"}, "m",
      "length that slips through its base and its tool clamp per repeat, both ways added up");
  datasets.push_back({"/cable/room", Type::f64, {"cable"}, "m",
                      "radius of the helix into which it can wind; 0: it is held", true, true});
  add("/cable/path_gain", Type::f64, {"cable", "2"}, "1",
      "least and most that its path gains over the motion, without its slack and where it has moved within its room: a "
      "slack between the two is neither too long nor too short at any time");
  add("/cable/offset_sample", Type::u32, {"picture"}, "1", "samples at which /cable/offset tells");
  add("/cable/offset", Type::f64, {"picture", "cable", "segment", "2"}, "m",
      "where loose cables lie, from their places toward d1 and d2; only with one span");
  add("/cable_span/hose_moment", Type::f64, {"sample", "cable_span"}, "N m",
      "bending moment that the simulated hose carries at the clamps of each span with cables, by its E I: "
      "the larger of both");
}

/// Forces of those cables by the metals of the job.
void add_cable_forces(std::vector<Dataset>& datasets) {
  const auto add = [&](const char* path, Type type, std::vector<std::string> axes, const char* unit,
                       const char* meaning) { datasets.push_back({path, type, axes, unit, meaning, false, true}); };
  add("/cable/name", Type::text, {"cable"}, "1", "cables, as in the strain file");
  add("/cable/tension", Type::f64, {"sample", "cable"}, "N",
      "force of each, by the cyclic curve of its wires; where it differs along it, the largest");
  add("/clamp/cable_moment", Type::f64, {"sample"}, "N m",
      "of all cables on the hose by their forces, the larger of both clamps; of the span where they ask most "
      "of the hose");
  add("/clamp/hose_moment", Type::f64, {"sample"}, "N m",
      "bending moment that the simulated hose carries there, by its E I");
}

/// Of a cable by itself whose parts rub.
void add_bending(std::vector<Dataset>& datasets) {
  datasets.push_back({"/bending/curvature", Type::f64, {"bend"}, "1/m",
                      "curvatures to which a cable by itself is bent from straight, in one plane", false, true});
  datasets.push_back({"/bending/moment", Type::f64, {"bend"}, "N m",
                      "the moment that this takes: polymer, wires, and what friction holds (W29)", false, true});
}

Format make_strain_format() {
  Format format{"dresslife-strain", 1, "dresslife-strain", "what every wire feels", {}, {}};
  format.datasets = {
      {"/time", Type::f64, {"sample"}, "s", "time of each sample"},
      {"/program/step", Type::i32, {"sample"}, "1", "index of the program line being executed"},
      {"/program/text", Type::text, {"line"}, "1", "the lines of the program"},
      {"/robot/joint_position",
       Type::f64,
       {"sample", "joint"},
       "rad",
       "joint angles, as in the motion file",
       false,
       true},
      {"/segment/length", Type::f64, {"segment"}, "m", "rest length"},
      {"/deformation/curvature",
       Type::f64,
       {"sample", "segment", "2"},
       "1/m",
       "about d1 and d2 of the segment"},
      {"/deformation/twist", Type::f64, {"sample", "segment"}, "rad/m", "about the tangent"},
      {"/deformation/elongation", Type::f64, {"sample", "segment"}, "1", "relative change of length"},
  };
  add_dresspacks(format.datasets);
  add_site_set(format.datasets, "", "");
  add_site_set(format.datasets, "/bound_stick", "stick_");
  add_site_set(format.datasets, "/bound_free", "free_");
  add_cables(format.datasets);
  add_bending(format.datasets);
  for (const char* share : {"largest_force_share", "clamp_moment_share"})
    format.attributes.push_back({share, "as in the life file, in files without /cable/strain", false, true});
  format.attributes.push_back(
      {"loose_mesh_error",
       "share of loose cables' curvature that the length of their pieces (strain.cable_elements_per_segment) leaves out: an "
       "estimate, root of mean squares over the motion, of the worst cable; absent: none lies loose",
       false, true});
  format.attributes.push_back({"warnings", "as in the motion file, this stage's behind them", true, true});
  format.datasets.push_back({"/probe/site", Type::u32, {"probe"}, "1", "site of each probe"});
  format.datasets.push_back(
      {"/probe/strain", Type::f64, {"probe", "sample"}, "1", "whole strain history of each probe"});
  format.datasets.push_back({"/probe/shear",
                             Type::f64,
                             {"probe", "sample"},
                             "1",
                             "shear strain gamma of its surface, by the wire's torsion",
                             false,
                             true});
  format.datasets.push_back(
      {"/plane/site",
       Type::u32,
       {"plane"},
       "1",
       "likely worst wires of each segment and layer; with strain.equivalent critical_plane only",
       false,
       true});
  format.datasets.push_back(
      {"/plane/strain", Type::f32, {"plane", "sample"}, "1", "strain along their fibre", false, true});
  format.datasets.push_back(
      {"/plane/shear", Type::f32, {"plane", "sample"}, "1", "their shear strain gamma", false, true});
  const auto varied = [&](const char* path, Type type, std::vector<std::string> shape, const char* meaning) {
    format.datasets.push_back({path, type, std::move(shape), "1", meaning, false, true});
  };
  varied("/variation/z", Type::f64, {"variation", "5"},
         "further ways in which the strains of likely worst wires were worked out: the standardised variables of "
         "friction_inside, friction_hose, slack, play and grip (pipeline/job/uncertainty.h); only where "
         "uncertainty is enabled");
  varied("/variation/inside", Type::i32, {"variation"},
         "how parts inside the cables slip then: 0 with that friction, 1 not at all (glued), 2 freely");
  varied("/variation/row/variation", Type::u32, {"variation_row"}, "variation of a row: one wire, so varied");
  varied("/variation/row/site", Type::u32, {"variation_row"}, "its site");
  varied("/variation/row/turning", Type::u32, {"variation_row"},
         "how many turning points it has: they follow each other, row by row");
  varied("/variation/strain", Type::f32, {"variation_turn"}, "strain at its turning points");
  return format;
}

Format make_life_format() {
  Format format{"dresslife-life", 1, "dresslife-fatigue", "how long every wire lives", {}, {}};
  const std::string site = "site";
  format.datasets = {
      {"/site/segment", Type::i32, {site}, "1", "segment of the site, counted from the base, 0 first"},
      {"/site/component", Type::text, {site}, "1", "path of the wire, outermost part first"},
      {"/site/helix",
       Type::f64,
       {site, "level", "3"},
       "m, rad, rad",
       "helix radius, lay angle (negative: left hand), phase at the segment's centre; outermost level first"},
      {"/site/fibre", Type::f64, {site, "2"}, "m, rad", "radius and angle of the fibre on the wire"},
      {"/site/material", Type::text, {site}, "1", "material of the wire"},
      {"/damage", Type::f64, {site}, "1", "damage per repeat of the motion"},
      {"/life", Type::f64, {site}, "1", "repeats to failure; inf without damage", true},
      {"/cycles/site", Type::u32, {"cycle"}, "1", "site of the cycle; the worst sites only, worst first"},
      {"/cycles/range", Type::f64, {"cycle"}, "1", "strain range"},
      {"/cycles/mean", Type::f64, {"cycle"}, "1", "mean strain"},
      {"/cycles/count", Type::f64, {"cycle"}, "1", "1 or 0.5"},
      {"/cycles/begin", Type::u32, {"cycle"}, "1", "sample at which the cycle opens"},
      {"/cycles/end", Type::u32, {"cycle"}, "1", "sample at which its range is reached"},
      {"/cycles/damage", Type::f64, {"cycle"}, "1", "its share of the damage per repeat"},
      {"/damage_rate",
       Type::f64,
       {"segment", "sample"},
       "1",
       "damage of each segment's worst site, on the sample at which its cycles close"},
      {"/damage_rate_opened",
       Type::f64,
       {"segment", "sample"},
       "1",
       "the same damage on the sample at which its cycles open",
       false,
       true},
      {"/segment/length", Type::f64, {"segment"}, "m", "rest length"},
      {"/segment/worst_site",
       Type::u32,
       {"segment"},
       "1",
       "site with the largest damage in each segment; 4294967295: none"},
      {"/segment/damage", Type::f64, {"segment"}, "1", "its damage per repeat"},
      {"/layer/component",
       Type::text,
       {"layer"},
       "1",
       "path of a layer of wires: /site/component without part numbers"},
      {"/layer/worst_site", Type::u32, {"layer"}, "1", "site with the largest damage in the layer"},
      {"/layer/damage", Type::f64, {"layer"}, "1", "its damage per repeat"},
      {"/hose/worst_site",
       Type::u32,
       {"segment"},
       "1",
       "place of the hose's wall with the largest damage in each segment; only with dresspack.hose_material",
       false,
       true},
      {"/hose/damage", Type::f64, {"segment"}, "1", "its damage per repeat", false, true},
      {"/conductor/component",
       Type::text,
       {"conductor"},
       "1",
       "path of each part that holds wires",
       false,
       true},
      {"/conductor/wires", Type::u32, {"conductor"}, "1", "its wires", false, true},
      {"/conductor/worst_site",
       Type::u32,
       {"conductor"},
       "1",
       "its site with the largest damage",
       false,
       true},
      {"/conductor/life",
       Type::f64,
       {"conductor", "3", "3"},
       "1",
       "repeats until its first wire, fatigue.failed_wires_percent of them, and all have broken (rows), in "
       "10, 50 and 90 % of cases (columns)",
       true,
       true},
      {"/conductor/place_life",
       Type::f64,
       {"conductor"},
       "1",
       "repeats until fatigue.failed_wires_percent of its wires have broken in one segment, all lives median "
       "and no load shared",
       true,
       true},
      {"/worst/strain",
       Type::f64,
       {"sample"},
       "1",
       "strain history of the worst site: its probe, or straight between its turning points"},
      {"/worst/stress",
       Type::f64,
       {"sample"},
       "Pa",
       "stress of the worst site along that history, as fatigue.stress has it, after its mean has relaxed; only where a wire "
       "was evaluated",
       false,
       true},
      {"/plane/site",
       Type::u32,
       {"plane"},
       "1",
       "wires whose planes were judged; with strain.equivalent critical_plane only",
       false,
       true},
      {"/plane/angle",
       Type::f64,
       {"plane"},
       "rad",
       "of the normal of the plane that is damaged most to the wire's axis",
       false,
       true},
      {"/plane/damage", Type::f64, {"plane"}, "1", "its damage per repeat", false, true},
      {"/time", Type::f64, {"sample"}, "s", "time of each sample"},
      {"/program/step", Type::i32, {"sample"}, "1", "index of the program line being executed"},
      {"/program/text", Type::text, {"line"}, "1", "the lines of the program"},
      {"/program/damage",
       Type::f64,
       {"line"},
       "1",
       "damage of the worst site by the program line that closes the cycles"},
      {"/program/damage_opened",
       Type::f64,
       {"line"},
       "1",
       "the same damage by the program line that opens the cycles",
       false,
       true},
      {"/joint/name",
       Type::text,
       {"cause"},
       "1",
       "the robot's joints, then `carrying`: what moves the dresspack as a whole, and the rest",
       false,
       true},
      {"/joint/damage",
       Type::f64,
       {"cause"},
       "1",
       "damage of the worst site by what moved between opening and closing of its cycles; below 0: moved "
       "against the others",
       false,
       true},
      {"/program/joint_damage",
       Type::f64,
       {"line", "cause"},
       "1",
       "/program/damage by what moved",
       false,
       true},
      {"/clamp/name",
       Type::text,
       {"clamp"},
       "1",
       "base clamp, those between the ends with their links, tool clamp",
       false,
       true},
      {"/clamp/damage",
       Type::f64,
       {"clamp"},
       "1",
       "sum of /segment/damage over the segments to which this clamp of their dresspack is the nearest",
       false,
       true},
  };
  format.datasets[1].deflate = format.datasets[2].deflate = format.datasets[4].deflate = true;
  add_dresspacks(format.datasets);
  format.datasets.push_back({"/dresspack/worst_site",
                             Type::u32,
                             {"dresspack"},
                             "1",
                             "its wire's site with the largest damage; 4294967295: none",
                             false,
                             true});
  format.datasets.push_back(
      {"/dresspack/damage", Type::f64, {"dresspack"}, "1", "its damage per repeat", false, true});
  add_cable_forces(format.datasets);
  format.attributes = {
      {"life_repeats", "repeats of the motion until the worst wire breaks"},
      {"life_hours", "the same in hours of motion"},
      {"life_months", "the same at the job's operating hours per week"},
      {"damage_per_repeat", "of the worst site"},
      {"repeat_seconds", "duration of one repeat"},
      {"life_repeats_all_stick",
       "bound: everything in the cables glued; cables themselves as in the job, which may glue them, too"},
      {"life_repeats_all_free", "bound: everything in the cables slipping freely; cables themselves likewise"},
      {"life_hours_all_stick", "the bound in hours of motion"},
      {"life_hours_all_free", "the bound in hours of motion"},
      {"largest_force_share",
       "largest force of a cable over that at which it tears (materials' tensile_strength_MPa; 0: not known)", false, true},
      {"clamp_moment_share",
       "largest moment of all cables on the hose at a clamp, over the largest that the simulated hose carries there",
       false, true},
      {"loose_mesh_error", "as in the strain file", false, true},
      {"worst_site", "index of the worst site"},
      {"worst_segment_from_tool", "its segment, counted from the tool, 1 first"},
      {"worst_position_from_tool", "its distance from the tool clamp along the dresspack, m"},
      {"worst_component", "path of its wire", true},
      {"worst_time", "time at which its most damaging cycle closes, s"},
      {"worst_step", "program line being executed then", true},
      {"life_hours_mean_stress_kept", "the same wire's life if none of its mean stress relaxed", false, true},
      {"life_hours_without_mean_stress", "the same wire's life by (8), mean stress left out", false, true},
      {"mean_stress_left",
       "mean over its life of the share that is left of the stress by which it is off centre (fatigue/README.md, F22)",
       false, true},
      {"worst_dresspack", "the dresspack that it lies in, among several; the segment above is counted in it",
       true, true},
      {"life_hours_p10",
       "the planner's: by then 10 % of such dresspacks have a conductor that has lost fatigue.failed_wires_percent of its "
       "wires in one segment, over all that is not known (section uncertainty) and the scatter of wires. In "
       "files without first_wire_life_hours_p10 these three tell of the first broken wire",
       false, true},
      {"life_hours_p50", "the same of half of them", false, true},
      {"life_hours_p90", "the same of 90 %", false, true},
      {"scatter_life_hours_p10",
       "the same over the scatter of wires alone; only where uncertainty is enabled", false, true},
      {"scatter_life_hours_p50", "the same of half of them", false, true},
      {"scatter_life_hours_p90", "the same of 90 %", false, true},
      {"life_response", "how the life depends on what is uncertain, by failure mode (pipeline/life/first_failure.h)", true,
       true},
      {"life_hours_p10_all_glued",
       "life_hours_p10 if everything inside the cables were glued, over the same samples; likewise p50, p90, and _all_free "
       "if it slipped without friction",
       false, true},
      {"life_hours_p50_all_glued", "likewise", false, true},
      {"life_hours_p90_all_glued", "likewise", false, true},
      {"life_hours_p10_all_free", "likewise", false, true},
      {"life_hours_p50_all_free", "likewise", false, true},
      {"life_hours_p90_all_free", "likewise", false, true},
      {"failing_mode", "what fails first in most of the samples", true, true},
      {"failing_mode_share", "in which share of those with a failure", false, true},
      {"best_test",
       "the parameter (pipeline/job/uncertainty.h) whose measurement narrows life_hours_p10 .. _p90 most; empty: none does",
       true, true},
      {"best_test_life_hours_p10", "life_hours_p10 after that measurement, if it confirms today's median", false, true},
      {"best_test_life_hours_p90", "likewise", false, true},
      {"life_shares",
       "shares of the variance of log life by cause (Shapley effects), largest first; they add up to 100 %", true, true},
      {"measure_next", "the parameter that explains most; empty: the scatter of wires does", true, true},
      {"measure_next_share", "how much, 0 to 1", false, true},
      {"life_months_p10", "the first of them at the job's operating hours per week", false, true},
      {"failing_conductor", "where a share of wires breaks soonest by their medians: path of the conductor", true, true},
      {"failing_position_from_tool", "and its distance from the tool clamp along the dresspack, m", false, true},
      {"first_wire_life_hours_p10", "by then 10 % of such dresspacks have a broken wire (fatigue.scatter_log10)", false,
       true},
      {"first_wire_life_hours_p50",
       "the same of half of them: earlier than life_hours, since any of many wires may be the first", false, true},
      {"first_wire_life_hours_p90", "the same of 90 %", false, true},
      {"worst_shear_range",
       "largest less smallest shear strain of the worst site's surface, by its wire's torsion", false, true},
      {"worst_plane_angle", "/plane/angle of the worst site, rad; absent where it was not judged", false,
       true},
      {"joint_explained",
       "share of the variance of the worst site's strain that follows from the joints between the clamps; "
       "how "
       "far to trust /joint/damage",
       false, true},
      {"worst_joint", "the cause in /joint/name that costs most", true, true},
      {"worst_joint_share", "its share of the worst site's damage; above 1 where other joints relieve", false,
       true},
      {"hose_life_repeats",
       "repeats until the hose's wall cracks, with dresspack.hose_material only; the attributes and tables "
       "without `hose` are about wires",
       false, true},
      {"hose_life_hours", "the same in hours of motion", false, true},
      {"hose_life_months", "the same at the job's operating hours per week", false, true},
      {"hose_damage_per_repeat", "of the wall's worst place", false, true},
      {"hose_component", "that place: hose 1 to hose 16 around the wall", true, true},
      {"hose_segment_from_tool", "its segment, counted from the tool, 1 first", false, true},
      {"hose_position_from_tool", "its distance from the tool clamp along the dresspack, m", false, true},
      {"hose_time", "time at which its most damaging cycle closes, s", false, true},
      {"hose_step", "program line being executed then", true, true},
      {"conductor_life_hours_p10",
       "by then 10 % of such dresspacks have a conductor with fatigue.failed_wires_percent of its wires "
       "broken",
       false, true},
      {"conductor_life_hours_p50", "the same of half of them", false, true},
      {"conductor_life_hours_p90", "the same of 90 %", false, true},
      {"estimates",
       "keys that the dresspacks leave out, with the values that dresslife estimated (config/defaults.md); empty: none",
       true, true},
      {"warnings", "as in the strain file, this stage's behind them: all of the job's", true, true},
  };
  return format;
}

std::string shape_text(const Dataset& dataset) {
  std::string text;
  for (const std::string& axis : dataset.shape) text += (text.empty() ? "" : ", ") + axis;
  return text;
}

const char* type_text(Type type) {
  switch (type) {
    case Type::f64:
      return "float64";
    case Type::f32:
      return "float32";
    case Type::i32:
      return "int32";
    case Type::u32:
      return "uint32";
    case Type::u64:
      return "uint64";
    case Type::text:
      return "text";
  }
  return "";
}

/// What the motion and the preview file both hold, as in the motion file.
void copy_from_motion(Format& format) {
  for (const char* path :
       {"/time", "/segment/position", "/segment/length", "/segment/dresspack", "/dresspack/name",
        "/clamp/position", "/clamp/segment", "/robot/joint_position", "/robot/link_pose", "/program/step",
        "/program/text"})
    format.datasets.push_back(motion_format().find(path));
}

Format make_preview_format() {
  Format format{"dresslife-preview", 1, "dresslife-sim --preview", "what stands where before a run", {}, {}};
  copy_from_motion(format);
  for (Dataset& dataset : format.datasets)
    if (dataset.path == "/segment/position")
      dataset.meaning = "segment centres of smooth curves of the right lengths between the clamps, in the world";
  const auto add = [&](Dataset dataset) { format.datasets.push_back(std::move(dataset)); };
  add({"/span/dresspack", Type::i32, {"span"}, "1", "dresspack of each span between two clamps that hold it"});
  add({"/span/name", Type::text, {"span"}, "1", "between which clamps; empty: the only span"});
  add({"/span/length", Type::f64, {"span"}, "m", "length of dresspack in it, unstretched"});
  add({"/span/way", Type::f64, {"sample", "span"}, "m",
      "straight way between its clamps, through its rings; 0 at a free end"});
  add({"/span/working_length",
       Type::f64,
       {"span", "4"},
       "m",
       "least and most length with the slack that the checks ask for: in the first sample's pose, then over the program; "
       "0: a free end"});
  add({"/scan/span", Type::i32, {"scan"}, "1", "span of each length that was tried", false, true});
  add({"/scan/length", Type::f64, {"scan"}, "m", "length", false, true});
  add({"/scan/bend_radius",
       Type::f64,
       {"scan"},
       "m",
       "least bend radius of the dresspack at rest in some poses of the program, with its weight, without contact; "
       "0: it finds no rest",
       false,
       true});
  format.attributes = {
      {"refusal", "why the simulation refuses the job; empty: it takes it", true},
      {"refusal_time", "when, s; absent: not at a time of the program", false, true},
      {"warnings",
       "what geometry and statics warn of, a line each: kind, place and words between tabs; absent in files of older programs",
       true, true},
  };
  return format;
}

Format make_screening_format() {
  Format format{"dresslife-screening", 1, "dresslife-sim --screen or --propose",
                "what geometry alone, or a short run, says of routings", {}, {}};
  const auto add = [&](Dataset dataset) { format.datasets.push_back(std::move(dataset)); };
  add({"/limit/name", Type::text, {"limit"}, "1",
      "too short, too long, bent too tightly, twisted too far, in the robot, pulled too hard"});
  add({"/candidate/changes", Type::text, {"candidate"}, "1",
      "YAML: what was changed in the job, or the routing that is proposed"});
  add({"/candidate/refusal", Type::text, {"candidate"}, "1", "why it is no job, or does not run; empty: it is one"});
  add({"/candidate/rejected", Type::i32, {"candidate"}, "1", "1: cannot work, 0: may"});
  add({"/candidate/beyond", Type::f64, {"candidate", "limit"}, "1",
       "how far beyond each limit, (V1) to (V6) in sim/route/screening.h, of the last run where there were "
       "rehearsals; <= 0: kept; 0 where it is no job", true});
  add({"/candidate/time", Type::f64, {"candidate", "limit"}, "s", "when"});
  Dataset bend{"/candidate/bend", Type::f64, {"candidate", "bend"}, "1",
               "of short runs: (V3) of each dresspack, each part of the motion's time, each part of the hose "
               "(sim/route/rehearsal.h); 0 where it does not run"};
  bend.may_be_absent = true;
  add(bend);
  format.attributes = {{"motion", "YAML of the motion for which routings are proposed; empty: the job's own", true}};
  return format;
}

}  // namespace

const Dataset& Format::find(std::string_view path) const {
  const auto found =
      std::find_if(datasets.begin(), datasets.end(), [&](const Dataset& d) { return d.path == path; });
  if (found == datasets.end()) throw std::logic_error(fmt::format("{} has no dataset {}", name, path));
  return *found;
}

const Format& motion_format() {
  static const Format format = make_motion_format();
  return format;
}
const Format& strain_format() {
  static const Format format = make_strain_format();
  return format;
}
const Format& life_format() {
  static const Format format = make_life_format();
  return format;
}

const Format& preview_format() {
  static const Format format = make_preview_format();
  return format;
}

const Format& screening_format() {
  static const Format format = make_screening_format();
  return format;
}

std::string file_manual() {
  std::string text;
  for (const Format* format :
       {&motion_format(), &strain_format(), &life_format(), &preview_format(), &screening_format()}) {
    text += fmt::format("### {} version {}: {} (written by {})\n\n", format->name, format->version,
                        format->purpose, format->made_by);
    text += "| dataset | type | shape | unit | meaning |\n|---|---|---|---|---|\n";
    for (const Dataset& dataset : format->datasets)
      text += fmt::format("| `{}` | {} | {} | {} | {}{} |\n", dataset.path, type_text(dataset.type),
                          shape_text(dataset), dataset.unit, dataset.meaning,
                          dataset.may_be_absent ? " (may be absent)" : "");
    if (!format->attributes.empty()) {
      text += "\n| root attribute | meaning |\n|---|---|\n";
      for (const AttributeInfo& attribute : format->attributes)
        text += fmt::format("| `{}` | {} |\n", attribute.name, attribute.meaning);
    }
    text += "\n";
  }
  return text;
}

}  // namespace dresslife::pipeline
