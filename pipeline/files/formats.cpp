// The file formats, dataset by dataset: the public interface between the stages.
#include <algorithm>
#include <initializer_list>
#include <stdexcept>

#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/files/files.h"

namespace dresslife::pipeline {
namespace {

using enum Type;

/// Properties of a dataset or an attribute, and the storage of a dataset (Dataset in files.h).
enum Traits : unsigned {
  always = 0,
  maybe = 1,         ///< optional: it does not apply to every file, or older files lack it
  endless = 2,       ///< its values may be infinite
  deflated = 4,      ///< repetitive
  decimals_7 = 8,    ///< for strains: one five-thousandth of the default gate
  lists = 16,        ///< increasing lists
  decimals_12 = 32,  ///< for positions and orientations: the elongation of links of 20 mm is accurate to 1e-10
  decimals_4 = 64,   ///< for forces in N
};
constexpr Traits operator|(Traits a, Traits b) { return Traits(unsigned(a) | unsigned(b)); }

struct Row {
  const char* path;
  Type type;
  const char *shape, *unit;
  Traits traits;
  const char* meaning;
};
struct AttributeRow {
  const char* name;
  Type type;
  Traits traits;
  const char* meaning;
};

/// Adds datasets. group: prefix of every path. set: prefix of the axes that count sites and reversals.
void add(Format& format, std::initializer_list<Row> rows, const std::string& group = "", const std::string& set = "") {
  for (const Row& row : rows) {
    Dataset& dataset = format.datasets.emplace_back();
    dataset = {group + row.path, row.type, {}, row.unit, row.meaning};
    for (std::string_view rest = row.shape; !rest.empty();) {
      const std::string axis(rest.substr(0, rest.find(',')));
      rest.remove_prefix(std::min(rest.size(), axis.size() + 2));
      const bool counts = axis.starts_with("site") || axis.starts_with("reversal");
      dataset.shape.push_back((counts ? set : "") + axis);
    }
    dataset.may_be_absent = row.traits & maybe;
    dataset.may_be_infinite = row.traits & endless;
    dataset.deflate = row.traits & deflated;
    dataset.lists = row.traits & lists;
    if (row.traits & decimals_4) dataset.decimals = 4;
    if (row.traits & decimals_7) dataset.decimals = 7;
    if (row.traits & decimals_12) dataset.decimals = 12;
  }
}

void add(Format& format, std::initializer_list<AttributeRow> rows) {
  for (const AttributeRow& row : rows)
    format.attributes.push_back({row.name, row.meaning, row.type == text, (row.traits & maybe) != 0});
}

// clang-format off

/// Adds the datasets that assign segments and clamps to dresspacks.
void add_dresspacks(Format& format) {
  add(format, {
    {"/segment/dresspack", i32,  "segment",   "1",    maybe,
     "dresspack that each segment belongs to, 0 first: one after the other, each from base to tool; absent: one "
     "dresspack"},
    {"/dresspack/name",    text, "dresspack", "1",    maybe,
     "names of the dresspacks; empty: the only one of a job without a list"},
  });
}

/// Adds sites with their reversals. strain.h5 has three sets: that of the job and those of the two bounds.
void add_sites(Format& format, const std::string& group, const std::string& set) {
  add(format, {
    {"/site/segment",    i32,  "site",           "1",    deflated,
     "segment of the site, counted from the base, 0 first"},
    {"/site/component",  text, "site",           "1",    deflated,
     "path of the wire, outermost part first; before it, among several, the dresspack's name"},
    {"/site/helix",      f32,  "site, level, 3", "m, rad, rad", deflated,
     "helix radius, lay angle (negative: left hand), phase at the segment's centre; outermost level first"},
    {"/site/fibre",      f64,  "site, 2",        "m, rad", deflated,
     "radius and angle of the fibre on the wire, from the inward normal; 0 0: the wire's axis"},
    {"/site/material",   text, "site",           "1",    deflated, "material of the wire"},
    {"/reversal/offset", u64,  "site+1",         "1",    deflated,
     "turning points of site k are [offset k, offset k+1)"},
    {"/reversal/strain", f32,  "reversal",       "1",    decimals_7, "strain at the turning point, kept to 5e-8"},
    {"/reversal/sample", u32,  "reversal",       "1",    lists, "sample of the turning point"},
  }, group, set);
}

/// Adds the datasets of the rubbed surface of the dresspacks.
void add_rubbing(Format& format) {
  add(format, {
    {"/rubbing/dresspack", i32,  "patch",    "1",    maybe | deflated,
     "dresspack of each patch of surface that is rubbed, 0 first; absent: the motion has no contact, or an older file"},
    {"/rubbing/place",     f64,  "patch, 4", "m, m, rad, rad", maybe | deflated,
     "middle of the patch from the base clamp along the dresspack, its length; its middle around the hose from d1 toward "
     "d2, its width"},
    {"/rubbing/obstacle",  text, "patch",    "1",    maybe | deflated,
     "what rubs: a link of the robot, floor, dresspack (itself or another), cell, ring 1 .."},
    {"/rubbing/work",      f64,  "patch",    "J",    maybe | deflated,
     "normal force times sliding distance, of one repeat (S23)"},
    {"/rubbing/time",      f64,  "patch",    "s",    maybe | deflated,
     "sample until which this obstacle rubs this place of the dresspack most"},
  });
}

Format make_motion_format() {
  Format format{"dresslife-motion", 1, "dresslife-sim", "how the dresspack moves", {}, {}};
  add(format, {
    {"/time",                  f64,  "sample",             "s",    always, "time of each sample"},
    {"/segment/position",      f64,  "sample, segment, 3", "m",    decimals_12,
     "segment centres in the world, kept to 5e-13 m"},
    {"/segment/orientation",   f64,  "sample, segment, 4", "1",    decimals_12,
     "unit quaternion w x y z, body to world, kept to 5e-13; body z is the tangent toward the tool"},
    {"/segment/length",        f64,  "segment",            "m",    always, "rest length"},
    {"/clamp/position",        f64,  "sample, clamp, 3",   "m",    always,
     "clamps in the world, dresspack by dresspack: base side first, tool side last"},
    {"/clamp/orientation",     f64,  "sample, clamp, 4",   "1",    always, "unit quaternion w x y z of the clamps"},
    {"/clamp/segment",         i32,  "clamp",              "1",    maybe,
     "segments of the file before each clamp: 0 at the first, all at the last; where a further dresspack begins, "
     "its base clamp repeats the number of the tool clamp before it; absent: two clamps, at the ends"},
    {"/clamp/travel",          f64,  "sample, dresspack",  "m",    maybe,
     "travel of each dresspack's base clamp in its retraction unit; absent without one"},
    {"/robot/joint_position",  f64,  "sample, joint",      "rad",  maybe, "joint angles"},
    {"/robot/link_pose",       f64,  "sample, link, 7",    "m, 1", maybe | decimals_12,
     "position and quaternion w x y z of each link, kept to 5e-13; attribute `links` names them, comma-separated"},
    {"/program/step",          i32,  "sample",             "1",    always,
     "index of the program line being executed"},
    {"/program/text",          text, "line",               "1",    always, "the lines of the program"},
    {"/program/loop",          f64,  "loop, 3",            "s, s, 1", maybe,
     "loops of equal rounds in the program: begin of the first round, duration of a round, number of rounds (at least 3); absent: "
     "none, or an older file"},
    {"/contact/count",         i32,  "sample",             "1",    always,
     "largest number of contacts of the dresspack since the sample before"},
    {"/contact/max_depth",     f64,  "sample",             "m",    always,
     "deepest penetration since the sample before; 0 without contact"},
    {"/contact/force",         f32,  "sample, segment",    "N",    maybe | deflated,
     "largest normal force on each segment since the sample before"},
    {"/contact/obstacle",      i32,  "sample, segment",    "1",    maybe | deflated,
     "obstacle of that force: index into the attribute `obstacles` of /contact/work; -1: none"},
    {"/contact/rubbing",       f32,  "sample, segment",    "J",    maybe | deflated,
     "work of friction on each segment since the sample before"},
    {"/contact/work",          f64,  "segment, obstacle",  "J",    maybe,
     "work of friction over the motion; attribute `obstacles` names the robot's links, floor, dresspack (itself or "
     "another), cell, guide rings"},
    {"/contact/largest_force", f64,  "segment, obstacle",  "N",    maybe, "largest normal force over the motion"},
    {"/energy",                f64,  "sample, 3",          "J",    always, "kinetic, elastic, gravitational"},
    {"/tension",               f64,  "sample, segment",    "N",    decimals_4,
     "axial force in each segment, kept to 5e-5 N"},
  });
  for (const char* group : {"/softer", "/stiffer"})
    add(format, {
      {"/segment/position",    f64, "sample, segment, 3", "m", maybe | decimals_12,
       "as /segment/position, with another bending stiffness of each hose (uncertainty.hose_stiffness)"},
      {"/segment/orientation", f64, "sample, segment, 4", "1", maybe | decimals_12, "as /segment/orientation"},
      {"/clamp/position",      f64, "sample, clamp, 3",   "m", maybe, "as /clamp/position"},
      {"/clamp/orientation",   f64, "sample, clamp, 4",   "1", maybe, "as /clamp/orientation"},
    }, group);
  add_dresspacks(format);
  add_rubbing(format);
  add(format, {
    {"/dresspack/bending_stiffness", f64,  "dresspack", "N m2", maybe,
     "E I as it was simulated, given or from the construction"},
    {"/dresspack/torsional_stiffness", f64,  "dresspack", "N m2", maybe, "G J as it was simulated, given or from the construction"},
    {"/dresspack/axial_stiffness",   f64,  "dresspack", "N",    maybe, "E A as it was simulated, given or from the construction"},
    {"/check/name",                  text, "check",     "1",    maybe | endless, "what is checked"},
    {"/check/value",                 f64,  "check",     "see /check/unit", maybe | endless,
     "its worst value; inf: a bend radius without any bend"},
    {"/check/unit",                  text, "check",     "1",    maybe | endless, "unit of value and limit"},
    {"/check/limit",                 f64,  "check",     "see /check/unit", maybe | endless,
     "the limit; inf: none"},
    {"/check/warning",               i32,  "check",     "1",    maybe | endless, "1: the limit is broken"},
    {"/check/time",                  f64,  "check",     "s",    maybe | endless, "time of the worst value"},
    {"/check/step",                  i32,  "check",     "1",    maybe | endless,
     "index of the program line being executed then"},
    {"/check/position",              f64,  "check",     "m",    maybe | endless,
     "distance from the base clamp along the dresspack; -1: the whole dresspack"},
    {"/check/dresspack",             i32,  "check",     "1",    maybe | endless,
     "index of the dresspack; absent: there is only one"},
    {"/check/curvature",             f64,  "hose_link", "1/m",  maybe | endless,
     "largest bending curvature of each elastic link, every step counted: at the joints of the segments, with one "
     "on either side of a clamp between two spans"},
    {"/check/curvature_time",        f64,  "hose_link", "s",    maybe | endless, "its time"},
    {"/check/twist",                 f64,  "hose_link", "rad/m", maybe | endless,
     "largest twist by size, with its sign"},
    {"/check/twist_time",            f64,  "hose_link", "s",    maybe | endless, "its time"},
    {"/check/tension",               f64,  "hose_link", "N",    maybe | endless, "largest pull"},
    {"/check/tension_time",          f64,  "hose_link", "s",    maybe | endless, "its time"},
    {"/check/net_twist",             f64,  "sample",    "rad",  maybe | endless,
     "twist of the whole dresspack, whole turns counted; of several the sum"},
  });
  add(format, {
    {"repeats", f64, maybe, "repeats of the motion that were run; the last one is in the file"},
    {"repeat_distance", f64, maybe,
     "distance between the dresspack's places at the start and at the end of the repeat, m; absent if the motion "
     "does not return"},
    {"time_step", f64, maybe, "integration step of the last repeat, s"},
    {"softer_z", f64, maybe, "standardised value of hose_stiffness in /softer (pipeline/job/uncertainty.h)"},
    {"stiffer_z", f64, maybe, "the same of /stiffer"},
    {"softer_taut_z", f64, maybe,
     "standardised value of hose_stiffness from which on softer hoses are pulled tight, the nearest simulated one; absent: none is"},
    {"stiffer_taut_z", f64, maybe, "the same of stiffer hoses"},
    {"curvature_error", f64, maybe,
     "estimated relative rms error of the curvature by the time step, in the most dynamic seconds"},
    {"tool_note", text, maybe, "note about a tool whose space is not known; absent: none"},
    {"assumed", text, maybe, "values of the robot program that are assumed, one per line; absent: none"},
    {"warnings", text, maybe,
     "warnings of this stage and those before it, one per line: kind, place, words and each KEY: VALUE of the remedy, "
     "separated by tabs; empty: none"},
  });
  return format;
}

Format make_strain_format() {
  Format format{"dresslife-strain", 2, "dresslife-strain", "the strain of every wire", {}, {}};
  add(format, {
    {"/time",                   f64,  "sample",             "s",    always, "time of each sample"},
    {"/program/step",           i32,  "sample",             "1",    always,
     "index of the program line being executed"},
    {"/program/text",           text, "line",               "1",    always, "the lines of the program"},
    {"/robot/joint_position",   f64,  "sample, joint",      "rad",  maybe, "joint angles, as in the motion file"},
    {"/segment/length",         f64,  "segment",            "m",    always, "rest length"},
    {"/segment/wires_at",       f64,  "segment",            "m",    always,
     "arc from the base clamp of its dresspack at which its wires are evaluated: its centre, or the clamp beside it"},
    {"/deformation/curvature",  f32,  "sample, segment, 2", "1/m",  always, "about d1 and d2 of the segment"},
    {"/deformation/twist",      f32,  "sample, segment",    "rad/m", always, "about the tangent"},
    {"/deformation/elongation", f32,  "sample, segment",    "1",    always, "relative change of length"},
  });
  add_dresspacks(format);
  add_rubbing(format);
  add_sites(format, "", "");
  add_sites(format, "/bound_stick", "stick_");
  add_sites(format, "/bound_free", "free_");
  add(format, {
    {"/cable/name",              text, "cable",              "1",    maybe,
     "cables: parts of the dresspack that have parts themselves; once per span between two clamps"},
    {"/cable/span",              i32,  "cable",              "1",    maybe,
     "index of its span in /cable_span"},
    {"/cable/dresspack",         i32,  "cable",              "1",    maybe,
     "index of its dresspack in the job, 0 first"},
    {"/cable/component",         i32,  "cable",              "1",    maybe,
     "index of its component in that dresspack, 0 first"},
    {"/cable/strain",            f64,  "sample, cable, 3",   "1",    maybe | decimals_12,
     "strain that belongs to its force: the largest along the cable by size, at its base clamp, at its tool clamp"},
    {"/cable/clamp_place",       f64,  "cable, 2, 2",        "m",    maybe,
     "its axis at its base and its tool clamp, toward d1 and d2 of the dresspack"},
    {"/cable/grip_slip",         f64,  "cable, 2",           "m",    maybe,
     "length that slips through its base and its tool clamp per repeat, sum of both directions"},
    {"/cable/room",              f64,  "cable",              "m",    maybe | endless,
     "radius of the largest helix that it can form; 0: it is held"},
    {"/cable/curvature",         f64,  "cable",              "1/m",  maybe,
     "largest curvature of its path in the motion, at a clamp or at the centre of a segment; 0: it is held; absent: an older file"},
    {"/cable/path_gain",         f64,  "cable, 2",           "1",    maybe,
     "smallest and largest gain in length of its path over the motion, without its slack and after it has moved "
     "within its room; a slack between the two is never too long nor too short"},
    {"/cable/offset_sample",     u32,  "picture",            "1",    maybe, "samples of /cable/offset"},
    {"/cable/offset",            f64,  "picture, cable, segment, 2", "m",    maybe,
     "displacement of loose cables from their places, toward d1 and d2; only with one span"},
    {"/jacket/cable",            i32,  "jacket_patch",       "1",    maybe | deflated,
     "cable of each patch of jacket that rubs in the hose; absent: no cable has friction"},
    {"/jacket/rest",             i32,  "jacket_patch",       "1",    maybe | deflated,
     "place of rest, a number of /start/rest"},
    {"/jacket/place",            f64,  "jacket_patch, 4",    "m, m, rad, rad", maybe | deflated,
     "middle of the patch from the base clamp along the dresspack, its length; its middle around the cable from d1 toward "
     "d2, its width"},
    {"/jacket/work",             f64,  "jacket_patch",       "J",    maybe | deflated,
     "normal force times sliding distance, of one repeat (W41)"},
    {"/jacket/sample",           u32,  "jacket_patch",       "1",    maybe | deflated, "sample in which it rubs most"},
    {"/cable_span/hose_moment",  f64,  "sample, cable_span", "N m",  maybe,
     "bending moment that the simulated hose carries at the clamps of each span with cables, by its E I: the "
     "larger of both"},
    {"/bending/curvature",       f64,  "bend",               "1/m",  maybe,
     "curvatures of a single cable that is bent from straight, in one plane"},
    {"/bending/moment",          f64,  "bend",               "N m",  maybe,
     "its moment: polymer, wires and friction (W29)"},
    {"/probe/site",              u32,  "probe",              "1",    always, "site of each probe"},
    {"/probe/strain",            f32,  "probe, sample",      "1",    decimals_7,
     "whole strain history of each probe, kept to 5e-8"},
    {"/probe/shear",             f32,  "probe, sample",      "1",    maybe | decimals_7,
     "shear strain gamma of its surface, by the wire's torsion, kept to 5e-8"},
    {"/plane/site",              u32,  "plane",              "1",    maybe,
     "likely worst wires of each segment and layer; with strain.equivalent critical_plane only"},
    {"/plane/strain",            f32,  "plane, sample",      "1",    maybe, "strain along their fibre"},
    {"/plane/shear",             f32,  "plane, sample",      "1",    maybe, "their shear strain gamma"},
    {"/variation/z",             f64,  "variation, 5",       "1",    maybe,
     "variations for which the strains of likely worst wires are evaluated: standardised values of "
     "friction_inside, friction_hose, slack, play and grip (pipeline/job/uncertainty.h); only if uncertainty is "
     "enabled"},
    {"/variation/inside",        i32,  "variation",          "1",    maybe,
     "slip inside the cables: 0 with that friction, 1 none (glued), 2 free"},
    {"/variation/rest",          i32,  "variation",          "1",    maybe,
     "rest of its loose cables, a number of /start/rest"},
    {"/variation/stiffness",     f64,  "variation",          "1",    maybe,
     "standardised value of hose_stiffness"},
    {"/variation/tension",       f64,  "variation, cable",   "N",    maybe,
     "largest force of each cable over the motion by size, with its sign; absent in older files"},
    {"/variation/tension_sample", u32, "variation, cable",   "1",    maybe, "the sample of that force"},
    {"/variation/tension_place", f64,  "variation, cable",   "m",    maybe,
     "its place, from the base clamp of the dresspack; -1: the force is the same along the cable"},
    {"/variation/clamp_moment",  f64,  "variation, cable_span, 2", "N m", maybe,
     "largest moment of all cables on the hose at a clamp, and largest one that the hose carries there"},
    {"/variation/clamp_moment_place", u32, "variation, cable_span, 2", "1", maybe,
     "sample of that moment of the cables, and the cable with the largest force then"},
    {"/variation/clamp_moment_tension", f64, "variation, cable_span", "N", maybe, "the force of that cable"},
    {"/start/rest",              i32,  "start",              "1",    maybe,
     "place of rest to which each start of the rings of loose cables came; 0: the job's own; absent: no ring (W40)"},
    {"/variation/row/variation", u32,  "variation_row",      "1",    maybe,
     "variation of each row; a row is one wire in one variation"},
    {"/variation/row/site",      u32,  "variation_row",      "1",    maybe, "its site"},
    {"/variation/row/turning",   u32,  "variation_row",      "1",    maybe,
     "its number of turning points in /variation/strain, which holds one row after the other"},
    {"/variation/strain",        f32,  "variation_turn",     "1",    maybe | decimals_7, "strain at its turning points, kept to 5e-8"},
  });
  add(format, {
    {"largest_force_share", f64, maybe, "as in the life file, in files without /cable/strain"},
    {"clamp_moment_share", f64, maybe, "as in the life file, in files without /cable/strain"},
    {"softer_taut_z", f64, maybe, "as in the motion file"},
    {"stiffer_taut_z", f64, maybe, "as in the motion file"},
    {"loose_mesh_error", f64, maybe,
     "estimated share of the curvature of loose cables that their mesh misses (strain.cable_elements_per_segment): "
     "rms over the motion, of the worst cable; absent: no loose cable"},
    {"moving_places", f64, maybe,
     "number of places of loose cables besides the job's own (starts, variations) at which the cables do not end the repeat where "
     "they began it (strain/theory.md, W42); absent: no other places"},
    {"warnings", text, maybe, "as in the motion file, then those of this stage"},
  });
  return format;
}

Format make_life_format() {
  Format format{"dresslife-life", 1, "dresslife-fatigue", "how long every wire lives", {}, {}};
  add(format, {
    {"/site/segment",          i32,  "site",            "1",    always,
     "segment of the site, counted from the base, 0 first"},
    {"/site/component",        text, "site",            "1",    deflated, "path of the wire, outermost part first"},
    {"/site/helix",            f32,  "site, level, 3",  "m, rad, rad", deflated,
     "helix radius, lay angle (negative: left hand), phase at the segment's centre; outermost level first"},
    {"/site/fibre",            f64,  "site, 2",         "m, rad", always,
     "radius and angle of the fibre on the wire"},
    {"/site/material",         text, "site",            "1",    deflated, "material of the wire"},
    {"/damage",                f64,  "site",            "1",    always, "damage per repeat of the motion"},
    {"/life",                  f64,  "site",            "1",    endless, "repeats to failure; inf without damage"},
    {"/cycles/site",           u32,  "cycle",           "1",    always,
     "site of the cycle; the worst sites only, worst first"},
    {"/cycles/range",          f64,  "cycle",           "1",    always, "strain range"},
    {"/cycles/mean",           f64,  "cycle",           "1",    always, "mean strain"},
    {"/cycles/count",          f64,  "cycle",           "1",    always, "1 or 0.5"},
    {"/cycles/begin",          u32,  "cycle",           "1",    always, "sample at which the cycle opens"},
    {"/cycles/end",            u32,  "cycle",           "1",    always, "sample at which its range is reached"},
    {"/cycles/damage",         f64,  "cycle",           "1",    always, "its share of the damage per repeat"},
    {"/damage_rate",           f64,  "segment, sample", "1",    always,
     "damage of each segment's worst site, on the sample at which its cycles close"},
    {"/damage_rate_opened",    f64,  "segment, sample", "1",    maybe,
     "the same damage on the sample at which its cycles open"},
    {"/segment/length",        f64,  "segment",         "m",    always, "rest length"},
    {"/segment/worst_site",    u32,  "segment",         "1",    always,
     "site with the largest damage in each segment; 4294967295: none"},
    {"/segment/damage",        f64,  "segment",         "1",    always, "its damage per repeat"},
    {"/layer/component",       text, "layer",           "1",    always,
     "path of a layer of wires: /site/component without part numbers"},
    {"/layer/worst_site",      u32,  "layer",           "1",    always,
     "site with the largest damage in the layer"},
    {"/layer/damage",          f64,  "layer",           "1",    always, "its damage per repeat"},
    {"/hose/worst_site",       u32,  "segment",         "1",    maybe,
     "place of the hose's wall with the largest damage in each segment; only with dresspack.hose_material"},
    {"/hose/damage",           f64,  "segment",         "1",    maybe, "its damage per repeat"},
    {"/conductor/component",   text, "conductor",       "1",    maybe, "path of each part that holds wires"},
    {"/conductor/wires",       u32,  "conductor",       "1",    maybe, "its wires"},
    {"/conductor/worst_site",  u32,  "conductor",       "1",    maybe, "its site with the largest damage"},
    {"/conductor/life",        f64,  "conductor, 3, 3", "1",    maybe | endless,
     "repeats until its first wire, fatigue.failed_wires_percent of them, and all have broken (rows), in 10, 50 "
     "and 90 % of cases (columns)"},
    {"/conductor/place_life",  f64,  "conductor",       "1",    maybe | endless,
     "repeats until fatigue.failed_wires_percent of its wires have broken in one segment, all lives median and no "
     "load shared"},
    {"/worst/strain",          f64,  "sample",          "1",    always,
     "strain history of the worst site: its probe, or straight between its turning points"},
    {"/worst/stress",          f64,  "sample",          "Pa",   maybe,
     "stress of the worst site along that history, as fatigue.stress has it, after its mean has relaxed; only "
     "where a wire was evaluated"},
    {"/plane/site",            u32,  "plane",           "1",    maybe,
     "wires with evaluated planes; with strain.equivalent critical_plane only"},
    {"/plane/angle",           f64,  "plane",           "rad",  maybe,
     "angle between the wire's axis and the normal of the plane with the largest damage"},
    {"/plane/damage",          f64,  "plane",           "1",    maybe, "its damage per repeat"},
    {"/time",                  f64,  "sample",          "s",    always, "time of each sample"},
    {"/program/step",          i32,  "sample",          "1",    always, "index of the program line being executed"},
    {"/program/text",          text, "line",            "1",    always, "the lines of the program"},
    {"/program/damage",        f64,  "line",            "1",    always,
     "damage of the worst site by the program line that closes the cycles"},
    {"/program/damage_opened", f64,  "line",            "1",    maybe,
     "the same damage by the program line that opens the cycles"},
    {"/joint/name",            text, "cause",           "1",    maybe,
     "the robot's joints, then `carrying`: motion of the dresspack as a whole, and the rest"},
    {"/joint/damage",          f64,  "cause",           "1",    maybe,
     "damage of the worst site by cause: what moved between opening and closing of its cycles; below 0: the cause "
     "reduces the damage"},
    {"/program/joint_damage",  f64,  "line, cause",     "1",    maybe, "/program/damage by cause"},
    {"/clamp/name",            text, "clamp",           "1",    maybe,
     "base clamp, those between the ends with their links, tool clamp"},
    {"/clamp/damage",          f64,  "clamp",           "1",    maybe,
     "sum of /segment/damage over the segments to which this clamp of their dresspack is the nearest"},
  });
  add_dresspacks(format);
  add(format, {
    {"/dresspack/worst_site", u32,  "dresspack",     "1",    maybe,
     "its wire's site with the largest damage; 4294967295: none"},
    {"/dresspack/damage",     f64,  "dresspack",     "1",    maybe, "its damage per repeat"},
    {"/cable/name",           text, "cable",         "1",    maybe, "cables, as in the strain file"},
    {"/cable/tension",        f64,  "sample, cable", "N",    maybe,
     "force of each, by the cyclic curve of its wires; where it differs along it, the largest"},
    {"/clamp/cable_moment",   f64,  "sample",        "N m",  maybe,
     "moment of all cables on the hose by their forces, at the clamp and in the span with the largest share of the "
     "hose's moment"},
    {"/clamp/hose_moment",    f64,  "sample",        "N m",  maybe,
     "bending moment that the simulated hose carries there, by its E I"},
  });
  add(format, {
    {"life_repeats", f64, always, "repeats of the motion until the worst wire breaks"},
    {"life_hours", f64, always, "the same in hours of motion"},
    {"life_months", f64, always, "the same at the job's operating hours per week"},
    {"damage_per_repeat", f64, always, "of the worst site"},
    {"repeat_seconds", f64, always, "duration of one repeat"},
    {"life_repeats_all_stick", f64, always,
     "bound: everything in the cables glued, compression without effect (F38); cables themselves as in the job, which may glue them, too"},
    {"life_repeats_all_free", f64, always,
     "bound: everything in the cables slipping freely; cables themselves as in the job"},
    {"life_hours_all_stick", f64, always, "the bound in hours of motion"},
    {"life_hours_all_free", f64, always, "the bound in hours of motion"},
    {"largest_force_share", f64, maybe,
     "largest force of a cable over that at which it tears (materials' tensile_strength_MPa; 0: not known)"},
    {"clamp_moment_share", f64, maybe,
     "largest moment of all cables on the hose at a clamp, over the largest that the simulated hose carries there"},
    {"strain_relief_share", f64, maybe,
     "largest pull of a cable at a clamp over what EN 50262 asks a strain relief of type A to hold (fatigue/strain_relief.h); "
     "a check, no life"},
    {"loose_mesh_error", f64, maybe, "as in the strain file"},
    {"moving_places", f64, maybe, "as in the strain file"},
    {"worst_site", f64, always, "index of the worst site"},
    {"worst_segment_from_tool", f64, always, "its segment, counted from the tool, 1 first"},
    {"worst_position_from_tool", f64, always, "its distance from the tool clamp along the dresspack, m"},
    {"worst_component", text, always, "path of its wire"},
    {"worst_time", f64, always, "time at which its most damaging cycle closes, s"},
    {"worst_step", text, always, "program line being executed then"},
    {"life_hours_mean_stress_kept", f64, maybe, "the same wire's life if none of its mean stress relaxed"},
    {"life_hours_without_mean_stress", f64, maybe, "the same wire's life by (8), mean stress left out"},
    {"mean_stress_left", f64, maybe,
     "share of its mean stress that remains after relaxation, averaged over its life (F22)"},
    {"worst_dresspack", text, maybe,
     "its dresspack, among several; worst_segment_from_tool is counted in it"},
    {"life_hours_p10", f64, maybe,
     "the life to plan with: by then 10 % of such dresspacks have a conductor that has lost "
     "fatigue.failed_wires_percent of its wires in one segment, over the uncertain parameters (section "
     "uncertainty) and the scatter of wires. In files without first_wire_life_hours_p10 these three are lives of "
     "the first broken wire"},
    {"life_hours_p50", f64, maybe, "the same for 50 %"},
    {"life_hours_p90", f64, maybe, "the same for 90 %"},
    {"scatter_life_hours_p10", f64, maybe,
     "life_hours_p10 with the scatter of wires only; only if uncertainty is enabled"},
    {"scatter_life_hours_p50", f64, maybe, "the same for 50 %"},
    {"scatter_life_hours_p90", f64, maybe, "the same for 90 %"},
    {"life_response", text, maybe,
     "life as a function of the uncertain parameters, by failure mode (pipeline/life/first_failure.h)"},
    {"life_hours_p10_all_glued", f64, maybe,
     "life_hours_p10 if everything inside the cables were glued, over the same samples"},
    {"life_hours_p50_all_glued", f64, maybe, "life_hours_p50 under the same condition"},
    {"life_hours_p90_all_glued", f64, maybe, "life_hours_p90 under the same condition"},
    {"life_hours_p10_all_free", f64, maybe,
     "life_hours_p10 if everything inside the cables slipped without friction, over the same samples"},
    {"life_hours_p50_all_free", f64, maybe, "life_hours_p50 under the same condition"},
    {"life_hours_p90_all_free", f64, maybe, "life_hours_p90 under the same condition"},
    {"failing_mode", text, maybe, "the part that fails first in most of the samples with a failure"},
    {"failing_mode_share", f64, maybe, "in which share of them"},
    {"best_test", text, maybe,
     "the parameter (pipeline/job/uncertainty.h) whose measurement narrows life_hours_p10 .. _p90 most; empty: none does"},
    {"best_test_life_hours_p10", f64, maybe, "life_hours_p10 after that measurement, if it confirms today's median"},
    {"best_test_life_hours_p90", f64, maybe, "life_hours_p90 after that measurement, if it confirms today's median"},
    {"life_error_p10", f64, maybe,
     "standard error of life_hours_p10 by the number of samples and by the response between computed lives, as a factor "
     "(pipeline/life/first_failure.h); absent: a life without end"},
    {"life_error_p50", f64, maybe, "the same of life_hours_p50"},
    {"life_error_p90", f64, maybe, "the same of life_hours_p90"},
    {"life_shares", text, maybe,
     "shares of the variance of log life by cause (Shapley effects), largest first; they add up to 100 %"},
    {"measure_next", text, maybe, "the parameter with the largest share; empty: the scatter of wires has it"},
    {"measure_next_share", f64, maybe, "its share, 0 to 1"},
    {"life_months_p10", f64, maybe, "life_hours_p10 at the job's operating hours per week"},
    {"robot_life_hours", f64, maybe, "fatigue.robot_life_hours of the job; absent: no robot moves"},
    {"failing_conductor", text, maybe,
     "path of the conductor of failing_mode that loses the share of its wires first, by median lives"},
    {"failing_position_from_tool", f64, maybe, "distance of that place from the tool clamp along the dresspack, m"},
    {"failing_segment_from_tool", f64, maybe, "its segment, counted from the tool, 1 first; 0: no conductor can fail"},
    {"failing_time", f64, maybe, "time at which the most damaging cycle of that conductor's wires closes there, s"},
    {"failing_dresspack", text, maybe, "its dresspack, among several"},
    {"first_wire_life_hours_p10", f64, maybe,
     "by then 10 % of such dresspacks have a broken wire (fatigue.scatter_log10)"},
    {"first_wire_life_hours_p50", f64, maybe,
     "the same for 50 %; earlier than life_hours, because any of many wires may be the first"},
    {"first_wire_life_hours_p90", f64, maybe, "the same for 90 %"},
    {"worst_shear_range", f64, maybe,
     "largest less smallest shear strain of the worst site's surface, by its wire's torsion"},
    {"worst_plane_angle", f64, maybe, "/plane/angle of the worst site, rad; absent if it was not evaluated"},
    {"joint_explained", f64, maybe,
     "share of the variance of the worst site's strain that the joints between the clamps explain; near 1: "
     "/joint/damage is reliable"},
    {"worst_joint", text, maybe, "the cause in /joint/name with the largest damage"},
    {"worst_joint_share", f64, maybe, "its share of the worst site's damage; above 1 if other causes reduce it"},
    {"hose_life_repeats", f64, maybe,
     "repeats until the hose's wall cracks (not validated), with dresspack.hose_material only; the attributes and tables "
     "without `hose` are about wires"},
    {"hose_life_hours", f64, maybe, "the same in hours of motion (not validated)"},
    {"hose_life_months", f64, maybe, "the same at the job's operating hours per week (not validated)"},
    {"hose_damage_per_repeat", f64, maybe, "of the wall's worst place"},
    {"hose_component", text, maybe, "that place: hose 1 to hose 16 around the wall"},
    {"hose_segment_from_tool", f64, maybe, "its segment, counted from the tool, 1 first"},
    {"hose_position_from_tool", f64, maybe, "its distance from the tool clamp along the dresspack, m"},
    {"wall_response", text, maybe, "its life over the strength of its material, for each dresspack, in the form of life_response"},
    {"hose_time", f64, maybe, "time at which its most damaging cycle closes, s"},
    {"hose_step", text, maybe, "program line being executed then"},
    {"unvalidated_modes", text, maybe,
     "failure modes that are not in life_hours_p10 .. _p90, because no test validates their laws: a line each with tabs "
     "between mode, dresspack among several, hours until it has failed in 10, 50, 90 % of cases (nan: not known), share of "
     "samples in which it fails before the wires, life_hours_p10 if it counted, segment from the tool, distance from the "
     "tool m, what rubs, place around the hose, rated or coiled cable, time s, program line, of the wall by its law the bends "
     "from straight to the limit of the bend radius, further sentences, share of the failures before the replacement that visual checks find in time (nan: not known), share of "
     "all that fail unseen, share of the life after which a check can see it (nan: never), of a kink the radius of the tightest bend over that at which the tube kinks (0: another mode); a maker's rating is a lower bound of a life"},
    {"not_evaluated", text, maybe, "parts of the dresspacks and failure modes without a life"},
    {"conductor_life_hours_p10", f64, maybe,
     "by then 10 % of such dresspacks have a conductor with fatigue.failed_wires_percent of its wires broken"},
    {"conductor_life_hours_p50", f64, maybe, "the same for 50 %"},
    {"conductor_life_hours_p90", f64, maybe, "the same for 90 %"},
    {"estimates", text, maybe,
     "keys that the dresspacks leave out, with the values that dresslife estimated (config/defaults.md); empty: none"},
    {"warnings", text, maybe, "as in the strain file, then those of this stage"},
  });
  return format;
}

Format make_preview_format() {
  Format format{"dresslife-preview", 1, "dresslife-sim --preview", "robot, clamps and hose before a run", {}, {}};
  for (const char* as_in_motion :
       {"/time", "/segment/position", "/segment/length", "/segment/dresspack", "/dresspack/name",
        "/clamp/position", "/clamp/segment", "/robot/joint_position", "/robot/link_pose", "/program/step",
        "/program/text"})
    format.datasets.push_back(motion_format().find(as_in_motion));
  format.datasets[1].meaning = "segment centres of smooth curves of the right lengths between the clamps, in the world";
  add(format, {
    {"/span/dresspack",      i32,  "span",         "1",    always,
     "dresspack of each span between two clamps that hold it"},
    {"/span/name",           text, "span",         "1",    always, "its clamps; empty: the only span"},
    {"/span/length",         f64,  "span",         "m",    always, "length of dresspack in it, unstretched"},
    {"/span/way",            f64,  "sample, span", "m",    always,
     "straight distance between its clamps, through its rings; 0 at a free end"},
    {"/span/working_length", f64,  "span, 4",      "m",    always,
     "smallest and largest length with the slack that the checks require: in the first pose, then over the "
     "program; 0: a free end"},
    {"/scan/span",           i32,  "scan",         "1",    maybe, "span of each length that was tried"},
    {"/scan/length",         f64,  "scan",         "m",    maybe, "length"},
    {"/scan/bend_radius",    f64,  "scan",         "m",    maybe,
     "smallest bend radius of the dresspack at rest in some poses of the program, with its weight, without "
     "contact; 0: no equilibrium"},
  });
  add(format, {
    {"refusal", text, always, "why the simulation refuses the job; empty: it accepts it"},
    {"refusal_time", f64, maybe, "time of the refusal, s; absent: it has none"},
    {"warnings", text, maybe,
     "warnings of geometry, statics and a short run, one per line: kind, place, words and each KEY: VALUE of the remedy, "
     "separated by tabs"},
    {"notes", text, maybe, "several shapes at rest, one per line"},
    {"short_run", text, always, "how much of the program the short run of the checks followed: whole, begin or none"},
  });
  return format;
}

Format make_screening_format() {
  Format format{"dresslife-screening", 1, "dresslife-sim --screen or --propose",
                "geometric limits and short runs of routings", {}, {}};
  add(format, {
    {"/limit/name",         text, "limit",            "1",    always,
     "too short, too long, bent too tightly, twisted too far, in the robot, pulled too hard, bracket"},
    {"/candidate/changes",  text, "candidate",        "1",    always,
     "YAML: the changes of the job, or the proposed routing"},
    {"/candidate/refusal",  text, "candidate",        "1",    always,
     "why it is no job, or does not run; empty: it runs"},
    {"/candidate/rejected", i32,  "candidate",        "1",    always, "1: cannot work, 0: may"},
    {"/candidate/beyond",   f64,  "candidate, limit", "1",    endless,
     "excess over each limit, (V1) to (V7) in sim/route/screening.h, of the last short run if there was one; <= 0: "
     "within the limit; 0 if it is no job"},
    {"/candidate/time",     f64,  "candidate, limit", "s",    always, "its time"},
    {"/candidate/bend",     f64,  "candidate, bend",  "1",    maybe,
     "short runs: (V3) of each dresspack, part of the motion and part of the hose (sim/route/short_run.h); 0 if it "
     "does not run"},
  });
  add(format, {
    {"motion", text, always, "YAML of the motion for which routings are proposed; empty: the job's own"},
  });
  return format;
}

Format make_ways_format() {
  Format format{"dresslife-ways", 1, "dresslife-import --ways", "alternatives for lines of a robot program", {}, {}};
  add(format, {
    {"/way/what",      text, "way",     "1", always, "\"axis 6 +360 deg\""},
    {"/way/lines",     text, "way",     "1", always, "the lines that it changes, one below the other: side_panel.mod:54; empty: all"},
    {"/way/motion",    text, "way",     "1", always, "YAML: the motion of the patched program"},
    {"/way/patch",     text, "way",     "1", always, "a line with a folder, then the unified diff of the files below it"},
    {"/refusal/words", text, "refusal", "1", always, "why a way cannot be written in the program's language, one for each such way"},
  });
  return format;
}

// clang-format on

const char* type_text(Type type) {
  constexpr const char* texts[] = {"float64", "float32", "int32", "uint32", "uint64", "text"};
  return texts[static_cast<int>(type)];
}

template <Format (*make)()>
const Format& made() {
  static const Format format = make();
  return format;
}

}  // namespace

const Dataset& Format::find(std::string_view path) const {
  if (const Dataset* const found = find_in(datasets, &Dataset::path, path)) return *found;
  throw std::logic_error(fmt::format("{} has no dataset {}", name, path));
}

const Format& motion_format() { return made<make_motion_format>(); }
const Format& strain_format() { return made<make_strain_format>(); }
const Format& life_format() { return made<make_life_format>(); }
const Format& preview_format() { return made<make_preview_format>(); }
const Format& screening_format() { return made<make_screening_format>(); }
const Format& ways_format() { return made<make_ways_format>(); }

std::string file_manual() {
  std::string text;
  for (const Format* format : {&motion_format(), &strain_format(), &life_format()}) {
    text += fmt::format("### {} version {}: {} (written by {})\n\n", format->name, format->version, format->purpose,
                        format->made_by);
    text += "| dataset | type | shape | unit | meaning |\n|---|---|---|---|---|\n";
    for (const Dataset& dataset : format->datasets) {
      if (dataset.path.starts_with("/bound_")) continue;  // the text below the table describes them
      text += fmt::format("| `{}` | {}{} | {} | {} | {} |\n", dataset.path, type_text(dataset.type),
                          dataset.may_be_absent ? ", optional" : "", joined(dataset.shape, ", "), dataset.unit,
                          dataset.meaning);
    }
    if (format == &strain_format())
      text +=
          "\n`/bound_stick/site/...`, `/bound_stick/reversal/...`: the same with everything in the cables glued. "
          "`/bound_free/...`: with everything slipping freely.\n";
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
