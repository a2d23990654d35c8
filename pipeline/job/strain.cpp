#include "pipeline/job/strain.h"

#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {

void describe(Fields& f, ProbeRequest& probe) {
  f.integer("segment_from_tool", probe.segment_from_tool, Need::required, at_least(1),
            "The number of the segment, from the tool.");
  f.text("component", probe.component, Need::required, "The path of a wire, as in /site/component.");
}

void describe(Fields& f, Strain& strain) {
  f.choice("deformation", strain.deformation, "The measure of curvature and twist.");
  f.choice("kinematics", strain.kinematics,
           "The model of nested helices: the exact geometry, or equations (12) to (23) of the thesis.");
  f.choices("slip", strain.slip,
            "The slip between a part and its parent: one word, or one per level from the outermost. "
            "friction is the best estimate; free and stick are its bounds.");
  f.choice("equivalent", strain.equivalent,
           "The strain that is counted. axial: along the fibre. shear_included: with the shear of the wire's "
           "torsion, signed sqrt(eps^2 + gamma^2/3). critical_plane: across the plane with the largest damage, for "
           "the likely worst wires.");
  f.integer("surface_fibres", strain.surface_fibres, Need::optional, between(0, 64),
            "The number of fibres on each wire's surface. 1: the outer one. 0: the axis.");
  f.number("gate", strain.gate, Need::optional, between(0, 0.1),
           "The strain range below which turning points are dropped. Lives whose cycles lie below it are endless.");
  f.integer(
      "cable_elements_per_segment", strain.cable_elements, Need::optional, between(0, most_cable_elements),
      "The number of elements of a loose cable per segment. 0: it follows from slack and room, at least 2 per segment "
      "and 104 in all. Twice as many take twice the time and have a quarter of the error (loose_mesh_error of "
      "strain.h5).");
  const auto factor = [&](const char* key, double& value, const char* meaning) {
    f.number(key, value, Need::optional, between(1e-3, 1e3), meaning);
  };
  factor(
      "friction_factor", strain.factors.friction,
      "A factor on friction times pressure inside the cables, for trials. It also holds where a measured stiffness sets them.");
  factor("hose_friction_factor", strain.factors.hose_friction,
         "A factor on the friction of cables in a hose, for trials.");
  factor("slack_factor", strain.factors.slack, "A factor on slack_percent, for trials.");
  factor("play_factor", strain.factors.play, "A factor on the distance that loose cables can move, for trials.");
  factor("grip_factor", strain.factors.grip, "A factor on base_grip_N and tool_grip_N, for trials.");
  f.number(
      "rest", strain.rest, Need::optional, between(-5, 5),
      "The place where loose cables come to rest, as a standard normal quantile of the lives over several starts, for "
      "trials. 0: that with the median life.");
  f.list("probes", strain.probes, Need::optional, "The wires whose whole strain history is kept.");
}

}  // namespace dresslife::pipeline
