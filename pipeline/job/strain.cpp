#include "pipeline/job/strain.h"

#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {

void describe(Fields& f, ProbeRequest& probe) {
  f.integer("segment_from_tool", probe.segment_from_tool, Need::required, at_least(1),
            "segment, counted from the tool");
  f.text("component", probe.component, Need::required, "path of a wire, as in /site/component");
}

void describe(Fields& f, Strain& strain) {
  f.choice("deformation", strain.deformation, "how curvature and twist are measured");
  f.choice("kinematics", strain.kinematics, "nested helices: the geometry itself, or (12)..(23)");
  f.choices("slip", strain.slip,
            "between a part and its parent; one word, or one per level, outermost first");
  f.choice(
      "equivalent", strain.equivalent,
      "strain that is counted: along the fibre; with the shear of the wire's torsion, signed "
      "sqrt(eps^2 + gamma^2/3); or the latter and, for the likely worst wires, that across the plane that it "
      "damages most");
  f.integer("surface_fibres", strain.surface_fibres, Need::optional, between(0, 64),
            "fibres on each wire's surface: 1 the outward one, more equally spaced, 0 the axis");
  f.number("gate", strain.gate, Need::optional, between(0, 0.1),
           "turning points of smaller strain ranges are dropped");
  f.integer(
      "cable_elements_per_segment", strain.cable_elements, Need::optional, between(0, most_cable_elements),
      "pieces into which loose cables are cut, which lie in shorter waves than a segment resolves; 0: as many as their "
      "slack and room ask for, at least 2, and 64 in all. Twice as many cost them twice the time and leave a quarter of "
      "the error (loose_mesh_error of strain.h5)");
  const auto factor = [&](const char* key, double& value, const char* meaning) {
    f.number(key, value, Need::optional, between(1e-3, 1e3), meaning);
  };
  factor(
      "friction_factor", strain.factors.friction,
      "of friction times pressure inside the cables, also where a measured stiffness sets it; to try what is "
      "not known");
  factor("hose_friction_factor", strain.factors.hose_friction,
         "of the friction of cables in a hose; likewise");
  factor("slack_factor", strain.factors.slack, "of slack_percent; likewise");
  factor("play_factor", strain.factors.play, "of how far loose cables can leave their places; likewise");
  factor("grip_factor", strain.factors.grip, "of base_grip_N and tool_grip_N; likewise");
  f.list("probes", strain.probes, Need::optional, "wires whose whole strain history is kept");
}

}  // namespace dresslife::pipeline
