#include "pipeline/job.h"

#include <algorithm>
#include <cmath>

#include "pipeline/fields.h"
#include "pipeline/urdf.h"

namespace dresslife::pipeline {

void resolve_job(Node& job);  // catalogue.cpp

// ---- one describe() per struct ----------------------------------------------------------------------------

std::size_t Robot::axes() const {
  return static_cast<std::size_t>(
      std::count_if(joints.begin(), joints.end(), [](const Joint& joint) { return joint.follows.empty(); }));
}

void describe(Fields& f, UrdfRequest& request) {
  f.path("urdf", request.urdf, Need::required,
         "a URDF from which the robot is made; all other keys of a robot go beside it and count more, joints "
         "and "
         "links by their names");
  f.text("tip", request.tip, Need::optional,
         "link of the URDF at the flange; without it tool0, flange, or the only end");
  f.path("package_folder", request.package_folder, Need::optional,
         "folder that holds the packages of package:// names; without it those above the URDF");
  f.choice("collision", request.collision, {"keep", "drop"},
           "whether the URDF's collision shapes are the links' shapes");
  f.numbers("accelerations_deg_per_s2", request.accelerations, Need::optional,
            "highest accelerations of the axes, in their order: a URDF has none");
}

void describe(Fields& f, Joint& joint) {
  f.place(joint.where);
  f.text("name", joint.name, Need::required, "name of the joint");
  f.vector("origin_m", joint.origin, Need::required,
           "origin of the joint frame in the frame of the link before");
  f.vector("rpy_deg", joint.orientation, Need::optional,
           "roll, pitch, yaw of the joint frame, fixed axes x, y, z");
  f.vector("axis", joint.axis, Need::required, "axis of rotation in the joint frame");
  f.text("follows", joint.follows, Need::optional,
         "name of the joint that moves this one through a rod; it has then no limits and drive of its own");
  f.number("ratio", joint.ratio, Need::optional, any_number(),
           "of a joint that follows: its angle over the other's");
  f.number("offset_deg", joint.offset, Need::optional, any_number(),
           "of a joint that follows: its angle at 0");
  if (!joint.follows.empty()) return;
  f.number("lower_deg", joint.lower, Need::required, any_number(), "lowest angle");
  f.number("upper_deg", joint.upper, Need::required, any_number(), "highest angle");
  f.number("speed_deg_per_s", joint.speed, Need::required, above(0), "highest speed");
  f.number("acceleration_deg_per_s2", joint.acceleration, Need::required, above(0), "highest acceleration");
}

void describe(Fields& f, ExternalAxis& axis) {
  f.place(axis.where);
  f.text("name", axis.name, Need::required, "name of the axis");
  f.choice("kind", axis.kind, {"linear", "rotary"}, "slides along, or turns about its axis");
  f.choice("carries", axis.carries, {"robot", "nothing"},
           "what it moves: the robot's base, or nothing that matters here but the time that it takes");
  f.vector("origin_m", axis.origin, Need::optional,
           "of its frame in the world, or on the axis before that carries");
  f.vector("rpy_deg", axis.orientation, Need::optional, "roll, pitch, yaw of its frame");
  f.vector("axis", axis.axis, Need::optional, "its direction in its frame");
  const bool manual = axis.name.empty();
  if (axis.kind == ExternalAxis::Kind::linear) {
    f.number("lower_mm", axis.lower, Need::required, any_number(), "lowest position");
    f.number("upper_mm", axis.upper, Need::required, any_number(), "highest position");
    f.number("speed_mm_per_s", axis.speed, Need::required, above(0), "highest speed");
    f.number("acceleration_mm_per_s2", axis.acceleration, Need::required, above(0), "highest acceleration");
  }
  if (axis.kind == ExternalAxis::Kind::linear && !manual) return;
  const Need need = manual ? Need::optional : Need::required;
  f.number("lower_deg", axis.lower, need, any_number(), "of a rotary axis, likewise");
  f.number("upper_deg", axis.upper, need, any_number(), "likewise");
  f.number("speed_deg_per_s", axis.speed, need, above(0), "likewise");
  f.number("acceleration_deg_per_s2", axis.acceleration, need, above(0), "likewise");
}

void describe(Fields& f, Capsule& capsule) {
  f.vector("from_m", capsule.from, Need::required, "one end of the capsule's axis, in the link's frame");
  f.vector("to_m", capsule.to, Need::required, "the other end");
  f.number("radius_mm", capsule.radius, Need::required, above(0), "radius of the capsule");
}

void describe(Fields& f, Box& box) {
  f.vector("position_m", box.position, Need::optional, "of the box's centre");
  f.vector("rpy_deg", box.orientation, Need::optional, "roll, pitch, yaw of the box");
  f.vector("sides_m", box.sides, Need::required, "its full lengths along its own axes");
}

void describe(Fields& f, MeshFile& mesh) {
  f.path("file", mesh.file, Need::required, "triangles as STL or OBJ");
  f.number("scale", mesh.scale, Need::optional, above(0),
           "metres per unit of the file: 0.001 for millimetres");
  f.vector("position_m", mesh.position, Need::optional, "of the file's origin");
  f.vector("rpy_deg", mesh.orientation, Need::optional, "roll, pitch, yaw of the file's axes");
}

void describe(Fields& f, MountingPoint& point) {
  f.text("name", point.name, Need::required, "by which clamps refer to it");
  f.text("link", point.link, Need::required, "link of the robot that carries it");
  f.vector("position_m", point.position, Need::required, "in the link's frame");
  f.vector("direction", point.direction, Need::required,
           "of the dresspack there, from base to tool, in the link's frame");
}

void describe(Fields& f, Cell& cell) {
  f.list("capsules", cell.capsules, Need::optional, "posts, pipes and round edges, in the world's frame");
  f.list("boxes", cell.boxes, Need::optional, "tables and cabinets, in the world's frame");
  f.list("meshes", cell.meshes, Need::optional, "fixtures, in the world's frame");
}

void describe(Fields& f, Link& link) {
  f.text("name", link.name, Need::required, "name of the link, by which clamps refer to it");
  f.list("capsules", link.capsules, Need::optional, "shape of the link for contact with the dresspack");
  f.list("boxes", link.boxes, Need::optional, "more of its shape, in the link's frame");
  f.list("meshes", link.meshes, Need::optional, "more of its shape, in the link's frame");
}

void describe(Fields& f, Robot& robot) {
  f.text("name", robot.name, Need::required, "type designation");
  f.text("source", robot.source, Need::required, "where the numbers come from");
  f.vector("base_position_m", robot.base_position, Need::optional, "of the base link in the world");
  f.vector("base_rpy_deg", robot.base_orientation, Need::optional,
           "roll, pitch, yaw of the base link in the world");
  f.vector("program_base_m", robot.program_base, Need::optional,
           "origin of the frame that robot programs are written in, in the base link (Fanuc: at the height "
           "of axis 2)");
  f.vector("flange_position_m", robot.flange_position, Need::optional,
           "of the flange frame (tool0) in the last link");
  f.vector("flange_rpy_deg", robot.flange_orientation, Need::optional,
           "its roll, pitch, yaw; z leaves the flange");
  f.list("external_axes", robot.external_axes, Need::optional,
         "drives besides the robot's own; tracks under it from the world on");
  f.list("joints", robot.joints, Need::required, "the axes, from the base to the flange");
  f.list("links", robot.links, Need::required, "base link first, then the link that each joint moves");
  f.list("mounting_points", robot.mounting_points, Need::optional, "places to which dresspacks are clamped");
}

void describe(Fields& f, MotionStep& step) {
  f.place(step.where);
  f.text("text", step.text, Need::optional, "what the step is, for reports");
  f.choice("path", step.path, {"joint", "linear", "circular"}, "how a move gets to its target");
  f.numbers("joints_deg", step.joints, Need::optional, "target of a joint move, one angle per axis");
  f.numbers("position_mm", step.position, Need::optional,
            "target of the tool in the work object: x, y, z, instead of joints_deg");
  f.numbers("quaternion", step.quaternion, Need::optional, "orientation of the tool there: w, x, y, z");
  f.numbers("via_position_mm", step.via_position, Need::optional, "of a circular move: a point on the way");
  f.text(
      "configuration", step.configuration, Need::optional,
      "which arm reaches the pose: abb CF1 CF4 CF6 CFX, kuka S T, fanuc NUT 0 0 0; without it the nearest");
  f.numbers("external_axes", step.external_axes, Need::optional,
            "targets of external axes, mm or deg; without them they stay");
  f.text("tool", step.tool, Need::optional, "a name of tools; without it the flange");
  f.text("work_object", step.work_object, Need::optional,
         "a name of work_objects; without it the robot's base frame");
  f.maybe_number("speed_percent", step.speed_percent, between(0.1, 100),
                 "speed of the move, of each axis' highest");
  f.maybe_number("speed_deg_per_s", step.speed, above(0),
                 "speed of the axis that moves farthest, instead of a percentage");
  f.maybe_number("speed_mm_per_s", step.tool_speed, above(0), "highest speed of the tool");
  f.maybe_number("turn_deg_per_s", step.turn_speed, above(0),
                 "highest speed of the tool's rotation on a path");
  f.maybe_number("duration_s", step.duration, above(0), "of the whole move, instead of a speed");
  f.maybe_number("acceleration_percent", step.acceleration_percent, between(1, 150),
                 "of this move, besides the program's");
  f.maybe_number("zone_mm", step.tool_zone, at_least(0),
                 "the tool leaves its path this near to the target; 0: stop");
  f.maybe_number("zone_percent", step.stop_zone, between(0, 100),
                 "the next move begins at this share of the way in which the robot would stop");
  f.maybe_number("zone_deg", step.zone, at_least(0),
                 "the next move begins when every axis is this near; 0: stop");
  f.number("dwell_s", step.dwell, Need::optional, at_least(0), "standstill instead of a move");
  f.integer("repeat", step.repeat, Need::optional, at_least(0),
            "how often the block of `steps` runs; 0: not a block");
  f.list("steps", step.steps, Need::optional, "the block");
}

void describe(Fields& f, MotionFrame& frame) {
  f.text("name", frame.name, Need::required, "name of the tool or work object");
  f.vector("position_mm", frame.position, Need::optional, "of its origin");
  f.numbers("quaternion", frame.quaternion, Need::optional, "its orientation: w, x, y, z");
  f.boolean("stationary", frame.stationary, Need::optional,
            "the tool stands still and the robot carries the work object");
}

void describe(Fields& f, BranchAssumption& assumption) {
  f.text("line", assumption.line, Need::required, "of the branch: FILE:LINE, or LINE alone");
  f.choice("take", assumption.take, {"then", "else"}, "what the branch does");
}

void describe(Fields& f, ProgramFile& file) {
  f.path("file", file.file, Need::required, "a module or data file");
}

void describe(Fields& f, Motion& motion) {
  f.place(motion.where);
  f.text("name", motion.name, Need::optional, "name of the program");
  f.text("source", motion.source, Need::optional, "who wrote it");
  f.number("speed_percent", motion.speed_percent, Need::optional, between(0.1, 100),
           "speed of moves that name none");
  f.number("acceleration_percent", motion.acceleration_percent, Need::optional, between(1, 100),
           "of each axis' highest acceleration, for all moves");
  f.number("zone_deg", motion.zone, Need::optional, at_least(0),
           "zone of moves that name none; 0: stop at each target");
  f.list("steps", motion.steps, Need::optional,
         "the program; it starts at rest at the target of the first step");
  f.list("tools", motion.tools, Need::optional,
         "tools, in the flange's frame; also those that a program names but does not hold");
  f.list("work_objects", motion.work_objects, Need::optional,
         "work objects, in the robot's base frame; likewise");
  f.path("program", motion.program, Need::optional,
         "a robot program instead of steps: RAPID (.mod, .prg, .sys), KRL (.src), Fanuc (.ls), joints "
         "(.csv), ROS (.yaml, .json)");
  f.list("modules", motion.modules, Need::optional,
         "further files of the program: modules, .dat files, called programs");
  f.text("routine", motion.routine, Need::optional, "of the program to run; without it main, or the first");
  f.list("assume", motion.assume, Need::optional, "how branches of the program go that hang on inputs");
  f.number("spot_time_s", motion.spot_time, Need::optional, at_least(0),
           "dwell of a spot weld of the program");
  f.path("clamp_poses", motion.clamp_poses, Need::optional,
         "CSV with the poses of both clamps instead of steps: t, then x y z qw qx qy qz of base and tool "
         "clamp (s, m)");
}

void describe(Fields& f, StrainLifePoint& point) {
  f.number("strain_amplitude", point.strain_amplitude, Need::required, between(1e-9, 10),
           "half the strain range of the test");
  f.number("cycles", point.cycles, Need::required, between(0.5, 1e15), "to failure, median");
}

void describe(Fields& f, Material& material) {
  f.place(material.where);
  f.text("name", material.name, Need::required, "name, as the wires call it");
  f.text("source", material.source, Need::required, "where the constants come from");
  f.number("youngs_modulus_GPa", material.youngs_modulus, Need::required, above(0), "E");
  f.number("poisson_ratio", material.poisson_ratio, Need::optional, between(0, 0.5), "nu");
  f.list(
      "strain_life_table", material.strain_life_table, Need::optional,
      "measured points, larger strains first, instead of the keys below: for polymers; log-log between them");
  const bool measured = !material.strain_life_table.empty() && material.strain_life_table.front().cycles > 0;
  if (measured) return;  // the manual's one point is without cycles: there the other keys follow
  f.number("fatigue_strength_MPa", material.fatigue_strength, Need::required, above(0), "sigma_f' of (8)");
  f.number("fatigue_strength_exponent", material.fatigue_strength_exponent, Need::required,
           between(-1, -1e-3), "b of (8)");
  f.number("fatigue_ductility", material.fatigue_ductility, Need::required, above(0), "epsilon_f' of (8)");
  f.number("fatigue_ductility_exponent", material.fatigue_ductility_exponent, Need::required,
           between(-2, -1e-2), "c of (8)");
  f.maybe_number("cyclic_strength_MPa", material.cyclic_strength, above(0),
                 "K'; without it sigma_f'/epsilon_f'^n'");
  f.maybe_number("cyclic_hardening_exponent", material.cyclic_hardening_exponent, between(0.01, 1),
                 "n'; without it b/c");
  f.maybe_number("walker_exponent", material.walker_exponent, between(0, 1),
                 "gamma of mean_stress walker; without it 0.5");
}

void describe(Fields& f, Component& component) {
  f.place(component.where);
  f.text("name", component.name, Need::required, "what the part is; equal parts are numbered from 1");
  f.text("layer", component.layer, Need::optional,
         "name of the layer, where layers of equal parts lie over each other");
  f.integer("count", component.count, Need::optional, between(1, 1000), "equal parts in the layer (K)");
  f.number("radius_mm", component.radius, Need::required, above(0), "of the part");
  f.number("helix_radius_mm", component.helix_radius, Need::required, at_least(0),
           "from the parent's axis to the part's (R)");
  f.number("lay_angle_deg", component.lay_angle, Need::optional, between(0, 60),
           "angle to the parent's axis (alpha)");
  f.choice("hand", component.hand, {"right", "left"}, "of the helix: right (Z) or left (S)");
  f.number("phase_deg", component.phase, Need::optional, between(-360, 360),
           "angle of part 1 at the base clamp");
  f.maybe_number("friction_coefficient", component.friction, between(0, 1e6),
                 "Coulomb, of the part on what it lies against; needed where strain.slip is friction");
  f.maybe_number(
      "radial_line_load_N_per_m", component.radial_line_load, at_least(0),
      "presses the part on what it lies against, by jacket and tape; needed where strain.slip is friction");
  f.number("tension_N", component.tension, Need::optional, at_least(0),
           "of the part in the dresspack at rest");
  f.text("material", component.material, Need::optional,
         "of a wire: a name of config/materials; a part with parts has none");
  f.list("components", component.components, Need::optional, "the layers of parts inside");
}

void describe(Fields& f, Corrugation& corrugation) {
  f.place(corrugation.where);
  f.number("pitch_mm", corrugation.pitch, Need::required, above(0), "of one corrugation along the hose");
  f.number("height_mm", corrugation.height, Need::required, above(0),
           "half the difference of outer and inner diameter");
  f.number("wall_mm", corrugation.wall, Need::required, above(0), "thickness of the material");
}

void describe(Fields& f, Dresspack& dresspack) {
  f.text("name", dresspack.name, Need::required, "name of the dresspack");
  f.text("source", dresspack.source, Need::required, "where the numbers come from");
  f.number("diameter_mm", dresspack.diameter, Need::required, above(0), "outer diameter of the hose");
  f.number("mass_kg_per_m", dresspack.mass_per_length, Need::required, above(0), "of the filled hose");
  f.number("bending_stiffness_Nm2", dresspack.bending_stiffness, Need::required, above(0),
           "EI of the filled hose");
  f.number("torsional_stiffness_Nm2", dresspack.torsional_stiffness, Need::required, above(0),
           "GJ of the filled hose");
  f.number("axial_stiffness_N", dresspack.axial_stiffness, Need::required, above(0), "EA of the filled hose");
  f.number("rest_curvature_1_per_m", dresspack.rest_curvature, Need::optional, any_number(),
           "of the delivered hose when nothing pulls on it, toward the x axis of its base clamp, which "
           "base_clamp.roll_deg turns; its parts are free of strain in that shape");
  f.number("damping_time_ms", dresspack.damping_time, Need::required, at_least(0),
           "Kelvin-Voigt time of bending and twist, from a decay test");
  f.text("damping_source", dresspack.damping_source, Need::required,
         "where the damping comes from: life depends on it");
  f.number("friction_coefficient", dresspack.friction, Need::optional, between(0, 2),
           "Coulomb, hose against robot; between two dresspacks the smaller of theirs counts");
  f.maybe_number("least_bend_radius_mm", dresspack.least_bend_radius, above(0),
                 "that the maker allows in motion; tighter is warned of; without it ten diameters");
  f.maybe_number("most_twist_deg_per_m", dresspack.most_twist, above(0),
                 "that the maker allows in motion; more is warned of; without it 180");
  f.text("hose_material", dresspack.hose_material, Need::optional,
         "of the hose's wall, a name of config/materials; without it the hose's strain is not evaluated");
  f.maybe_number(
      "hose_strain_factor", dresspack.hose_strain_factor, between(1e-3, 100),
      "strain of the wall over that of a smooth hose of the same diameter; without it 1, or that of "
      "hose_corrugation");
  f.maybe_group("hose_corrugation", dresspack.hose_corrugation,
                "profile of the hose's wall, which gives the factor of its strain");
  f.list("components", dresspack.components, Need::optional, "what lies in the hose; none: motion only");
  f.list("materials", dresspack.materials, Need::optional, "materials that are not in config/materials");
}

void describe(Fields& f, Clamp& clamp) {
  f.place(clamp.where);
  f.text("mounting_point", clamp.mounting_point, Need::optional,
         "name of one of the robot's, instead of link, position_m and direction");
  const Need need = clamp.mounting_point.empty() ? Need::required : Need::optional;
  f.text("link", clamp.link, need, "link of the robot that carries the clamp");
  f.vector("position_m", clamp.position, need, "of the clamp in the link's frame");
  f.vector("direction", clamp.direction, need,
           "of the dresspack there, from base to tool, in the link's frame");
  f.maybe_number("roll_deg", clamp.roll, between(-360, 360),
                 "about the direction; without it 0 at the base clamp and free of twist at the others");
}

void describe(Fields& f, IntermediateClamp& between) {
  describe(f, between.clamp);
  f.number("at_length_m", between.at_length, Need::required, above(0),
           "of the dresspack from the base clamp to this one, unstretched");
}

void describe(Fields& f, GuideRing& ring) {
  f.place(ring.where);
  f.text("link", ring.link, Need::required, "link of the robot that carries the ring");
  f.vector("position_m", ring.position, Need::required, "of the ring's centre in the link's frame");
  f.vector("direction", ring.direction, Need::required,
           "of the ring's axis, from base to tool, in the link's frame");
  f.number("radius_mm", ring.radius, Need::required, above(0), "clear inner radius");
  f.number("friction_coefficient", ring.friction, Need::optional, between(0, 2),
           "Coulomb, dresspack against ring");
  f.number("width_mm", ring.width, Need::optional, at_least(0),
           "of the ring along its axis: it guides at both edges");
  f.maybe_number(
      "at_length_m", ring.at_length, above(0),
      "of dresspack from the base clamp to the ring when mounted; without it so that all pieces have slack "
      "alike");
}

void describe(Fields& f, Retraction& retraction) {
  f.place(retraction.where);
  f.number("force_N", retraction.force, Need::required, at_least(0),
           "pulls the base clamp back against its direction, where it is not pulled out");
  f.number("spring_N_per_m", retraction.spring, Need::optional, at_least(0), "more force per way pulled out");
  f.number("stroke_m", retraction.stroke, Need::required, above(0), "largest way along its direction");
  f.number("damping_Ns_per_m", retraction.damping, Need::optional, at_least(0), "of the sliding clamp");
  f.number("friction_N", retraction.friction, Need::optional, at_least(0), "Coulomb, of the sliding clamp");
  f.number("mass_kg", retraction.mass, Need::optional, above(0),
           "of what slides with the clamp, without the dresspack between the clamps");
}

void describe(Fields& f, Routing& routing) {
  f.place(routing.where);
  f.number("free_length_m", routing.free_length, Need::required, above(0),
           "free length of dresspack between the clamps");
  f.maybe_group("base_clamp", routing.base_clamp, "the clamp nearer to the robot's base");
  f.maybe_group("tool_clamp", routing.tool_clamp, "the clamp nearer to the tool");
  f.list("clamps", routing.clamps, Need::optional,
         "further clamps between the two, in their order along the dresspack, which grip it in place, "
         "direction and "
         "twist");
  f.list("rings", routing.rings, Need::optional,
         "guide rings in which the dresspack slides and turns, in their order along it");
  f.maybe_group("retraction", routing.retraction,
                "spring-returned slack: the base clamp slides along its direction and is pulled back");
  f.number("pre_twist_deg", routing.pre_twist, Need::optional, between(-36000, 36000),
           "by which the tool clamp is turned when it is mounted, on top of what its roll_deg says");
  f.choice("tool_end", routing.tool_end, {"clamped", "free"},
           "free: the dresspack hangs from its last clamp, without a tool_clamp");
  f.number("tool_mass_kg", routing.tool_mass, Need::optional, at_least(0),
           "hung at the end of a dresspack whose tool_end is free");
  f.numbers("mounting_pose_deg", routing.mounting_pose, Need::optional,
            "joint angles at which the dresspack was clamped free of twist; without it the first target; of "
            "several dresspacks all that give one give the same, and all are clamped in it");
}

void describe(Fields& f, Simulation& simulation) {
  f.integer("segments", simulation.segments, Need::optional, between(4, 2000),
            "rigid segments of each dresspack's chain");
  f.number_or_auto(
      "time_step_ms", simulation.time_step, simulation.choose_time_step, between(0.01, 20),
      "integration step; auto: the first repeat chooses the one that keeps to curvature_error_percent");
  f.number(
      "curvature_error_percent", simulation.curvature_error, Need::optional, above(0),
      "largest estimated rms error of the curvature that a chosen step may leave in the liveliest seconds");
  f.number("sample_rate_Hz", simulation.sample_rate, Need::optional, between(0.1, 10000),
           "of motion.h5; a whole number of steps lies between samples");
  f.vector("gravity_m_per_s2", simulation.gravity, Need::optional, "acceleration of free fall in the world");
  f.boolean("contact", simulation.contact, Need::optional, "whether the dresspack touches the robot's links");
  f.boolean("self_contact", simulation.self_contact, Need::optional,
            "whether dresspacks touch themselves and each other");
  f.boolean("floor", simulation.floor, Need::optional, "whether the plane z = 0 is a floor");
  f.number("periodic_tolerance_mm", simulation.periodic_tolerance, Need::optional, above(0),
           "a motion that returns is repeated until the dresspack begins two repeats this much alike; the "
           "last one counts");
  f.integer("most_repeats", simulation.most_repeats, Need::optional, between(1, 1000),
            "of the motion, also when they do not begin alike");
}

void describe(Fields& f, Probe& probe) {
  f.integer("segment_from_tool", probe.segment_from_tool, Need::required, at_least(1),
            "segment, counted from the tool");
  f.text("component", probe.component, Need::required, "path of a wire, as in /site/component");
}

void describe(Fields& f, Strain& strain) {
  f.choice("deformation", strain.deformation, {"rotation_vector", "thesis"},
           "how curvature and twist are measured");
  f.choice("kinematics", strain.kinematics, {"exact", "thesis"},
           "nested helices: the geometry itself, or (12)..(23)");
  f.choices("slip", strain.slip, {"free", "stick", "friction"},
            "between a part and its parent; one word, or one per level, outermost first");
  f.choice(
      "equivalent", strain.equivalent, {"axial", "shear_included", "critical_plane"},
      "strain that is counted: along the fibre; with the shear of the wire's torsion, signed "
      "sqrt(eps^2 + gamma^2/3); or the latter and, for the likely worst wires, that across the plane that it "
      "damages most");
  f.integer("surface_fibres", strain.surface_fibres, Need::optional, between(0, 64),
            "fibres on each wire's surface: 1 the outward one, more equally spaced, 0 the axis");
  f.number("gate", strain.gate, Need::optional, between(0, 0.1),
           "turning points of smaller strain ranges are dropped");
  f.list("probes", strain.probes, Need::optional, "wires whose whole strain history is kept");
}

void describe(Fields& f, Fatigue& fatigue) {
  f.choice("stress", fatigue.stress, {"cyclic", "elastic"},
           "Ramberg-Osgood with Masing memory, or E times strain");
  f.choice("mean_stress", fatigue.mean_stress, {"none", "morrow", "swt", "walker"},
           "correction of the strain-life curve");
  f.choice("counting", fatigue.counting, {"repeating", "half_cycles"},
           "rainflow of an endlessly repeated motion, or of one run");
  f.number("endurance_strain", fatigue.endurance_strain, Need::optional, between(0, 0.1),
           "amplitudes up to this do no damage");
  f.text("material", fatigue.material, Need::optional,
         "of every wire, instead of its own; the hose keeps hose_material");
  f.integer("listed_sites", fatigue.listed_sites, Need::optional, between(1, 10000),
            "worst sites whose cycles are written");
  f.number("operating_hours_per_week", fatigue.operating_hours_per_week, Need::optional, between(0.1, 168),
           "turns hours of motion into months");
  f.number(
      "scatter_log10", fatigue.scatter_log10, Need::optional, between(0, 1),
      "standard deviation of log10 of a wire's life; ESTIMATE: lives of 20 equal wires spread over 0.75 of a "
      "decade");
  f.number("failed_wires_percent", fatigue.failed_wires_percent, Need::optional, between(0, 100),
           "a conductor fails when so many of its wires are broken; 0: with the first");
  f.boolean("load_sharing", fatigue.load_sharing, Need::optional,
            "whether the rest of a conductor takes over the load of its broken wires");
}

void describe(Fields& f, MountedDresspack& mounted) {
  f.place(mounted.where);
  f.text("name", mounted.name, Need::required, "a name that tells it from the others, without '/'");
  f.group("dresspack", mounted.dresspack, Need::required,
          "a name of config/dresspacks, a file, or the entry itself");
  f.group("routing", mounted.routing, Need::required, "clamps and free length");
}

namespace {

/// How a job gives its dresspacks: one by two keys of its own, or a list. The manual tells of both.
struct Forms {
  bool one = true, list = false;
};
/// Precondition of reading: the job's list is empty when the document has one.
Forms forms_of(const Job& job) {
  const bool one = job.dresspacks.size() == 1 && job.dresspacks.front().name.empty();
  return {one, !one};
}

void describe_keys(Fields& f, Job& job, const Forms& forms) {
  // The motion first: whether it brings its own clamp poses decides whether a robot is needed.
  f.group("motion", job.motion, Need::required, "a name of config/programs, a file, or the entry itself");
  f.group("robot", job.robot, job.motion.clamp_poses.empty() ? Need::required : Need::optional,
          "a name of config/robots, a file, or the entry itself", !job.robot.joints.empty());
  if (forms.one) {
    MountedDresspack& only = job.dresspacks.front();
    f.group("dresspack", only.dresspack, Need::required,
            "a name of config/dresspacks, a file, or the entry itself");
    f.group("routing", only.routing, Need::required, "clamps and free length");
  }
  if (forms.list)
    f.list("dresspacks", job.dresspacks, forms.one ? Need::optional : Need::required,
           "several on one robot, instead of dresspack and routing");
  f.group("cell", job.cell, Need::optional, "what stands still around the robot: obstacles of the dresspack");
  f.group("simulation", job.simulation, Need::optional, "settings of dresslife-sim");
  f.group("strain", job.strain, Need::optional, "settings of dresslife-strain");
  f.group("fatigue", job.fatigue, Need::optional, "settings of dresslife-fatigue");
}

}  // namespace

void describe(Fields& f, Job& job) { describe_keys(f, job, forms_of(job)); }

namespace {

// ---- checks across keys -----------------------------------------------------------------------------------

void check_direction(const Vector3d& axis, const std::string& name, const Where& where) {
  if (!(axis.norm() > 1e-9))
    throw InputError(where, fmt::format("axis of {} is zero", name), "give its direction");
}

void check_range(double lower, double upper, const std::string& name, const Where& where) {
  if (!(lower < upper))
    throw InputError(where, fmt::format("limits of {} are empty (lower >= upper)", name), "mend them");
}

void check_joint(const Joint& joint, const Robot& robot) {
  check_direction(joint.axis, joint.name, joint.where);
  if (joint.follows.empty()) return check_range(joint.lower, joint.upper, joint.name, joint.where);
  const bool driven = std::any_of(robot.joints.begin(), robot.joints.end(), [&](const Joint& other) {
    return other.name == joint.follows && other.follows.empty();
  });
  if (!driven)
    throw InputError(joint.where,
                     fmt::format("{} follows '{}', which is no driven joint", joint.name, joint.follows),
                     "name a joint that follows no other");
}

void check_robot(const Robot& robot, const Where& where) {
  if (robot.links.size() != robot.joints.size() + 1)
    throw InputError(where,
                     fmt::format("robot has {} joints and {} links (must be one link more)",
                                 robot.joints.size(), robot.links.size()),
                     "list the base link and one link per joint");
  for (const Joint& joint : robot.joints) check_joint(joint, robot);
  for (const ExternalAxis& axis : robot.external_axes) {
    if (axis.name.empty()) throw InputError(axis.where, "an external axis has no name", "name it");
    check_direction(axis.axis, axis.name, axis.where);
    check_range(axis.lower, axis.upper, axis.name, axis.where);
  }
}

void check_pose(const std::vector<double>& position, const std::vector<double>& quaternion,
                const Where& where) {
  if (position.size() != 3)
    throw InputError(where, fmt::format("position_mm has {} numbers", position.size()), "give x, y, z");
  double squares = 0;
  for (double part : quaternion) squares += part * part;
  constexpr double rounding = 1e-3;  // of quaternions written with four decimals
  if (quaternion.size() != 4 || std::abs(std::sqrt(squares) - 1) > rounding)
    throw InputError(where, "quaternion is not four numbers w, x, y, z of length 1",
                     "give the orientation of the pose");
}

void check_move(const MotionStep& step, const Robot& robot) {
  const Where& where = step.where;
  if (!step.joints.empty() && step.joints.size() != robot.axes())
    throw InputError(
        where,
        fmt::format("joints_deg has {} angles (the robot has {} axes)", step.joints.size(), robot.axes()),
        "give one angle per axis");
  if (!step.joints.empty() && !step.position.empty())
    throw InputError(where, "both joints_deg and position_mm are given", "keep one of the two");
  if (!step.position.empty()) check_pose(step.position, step.quaternion, where);
  if ((step.path == PathKind::circular) != !step.via_position.empty() ||
      (!step.via_position.empty() && step.via_position.size() != 3))
    throw InputError(where, "via_position_mm belongs to a circular move, which must have it",
                     "give x, y, z, or change the path");
  if (step.speed.has_value() + step.speed_percent.has_value() + step.duration.has_value() > 1)
    throw InputError(where,
                     step.duration ? "duration_s is given beside a speed"
                                   : "both speed_percent and speed_deg_per_s are given",
                     "keep one of the two");
  if (step.zone.has_value() + step.tool_zone.has_value() + step.stop_zone.has_value() > 1)
    throw InputError(where, "more than one of zone_deg, zone_mm, zone_percent is given", "keep one of them");
}

void check_step(const MotionStep& step, const Robot& robot) {
  const bool move = step.is_move(), dwell = step.dwell > 0, block = step.repeat > 0 || !step.steps.empty();
  if (move + dwell + block != 1)
    throw InputError(step.where,
                     "a step must be one of: joints_deg or position_mm (a move), dwell_s, repeat with steps",
                     "split it into steps");
  if (block && (step.repeat < 1 || step.steps.empty()))
    throw InputError(step.where, "a block needs both repeat (at least 1) and steps", "give both");
  if (move) check_move(step, robot);
  if (!move && (step.speed || step.speed_percent || step.zone || step.tool_speed || step.tool_zone ||
                step.stop_zone || step.duration))
    throw InputError(step.where, "speed and zone belong to a move", "take them out of this step");
  for (const MotionStep& inner : step.steps) check_step(inner, robot);
}

void check_frames(const Motion& motion) {
  for (const std::vector<MotionFrame>* frames : {&motion.tools, &motion.work_objects})
    for (const MotionFrame& frame : *frames) check_pose({0, 0, 0}, frame.quaternion, motion.where);
}

void check_motion(const Motion& motion, const Robot& robot) {
  if (!motion.clamp_poses.empty() + !motion.steps.empty() + !motion.program.empty() != 1)
    throw InputError(motion.where, "motion must have one of steps, program or clamp_poses",
                     "give one of the three");
  check_frames(motion);
  for (const MotionStep& step : motion.steps) check_step(step, robot);
  if (!motion.steps.empty() && !motion.steps.front().is_move())
    throw InputError(motion.steps.front().where,
                     "the program must begin with a move (where the robot starts)", "begin with joints_deg");
}

/// A clamp at a mounting point becomes one with link, position and direction.
void place_clamp(Clamp& clamp, const Robot& robot) {
  if (clamp.mounting_point.empty()) return;
  if (!clamp.link.empty())
    throw InputError(clamp.where, "a clamp has both a mounting_point and a link", "keep one of the two");
  std::vector<std::string> names;
  for (const MountingPoint& point : robot.mounting_points) {
    names.push_back(point.name);
    if (point.name != clamp.mounting_point) continue;
    clamp.link = point.link;
    clamp.position = point.position;
    clamp.direction = point.direction;
    clamp.mounting_point.clear();
    return;
  }
  throw InputError(clamp.where, fmt::format("the robot has no mounting point '{}'", clamp.mounting_point),
                   names.empty() ? "give link, position_m and direction of the clamp"
                                 : fmt::format("one of: {}", fmt::join(names, ", ")));
}

void check_place(const std::string& link, const Vector3d& direction, const std::string& name,
                 const Where& where, const Robot& robot) {
  if (!(direction.norm() > 1e-9))
    throw InputError(where, fmt::format("routing.{}.direction is zero", name),
                     "give where the dresspack points");
  std::vector<std::string> names;
  for (const Link& of_robot : robot.links) names.push_back(of_robot.name);
  if (std::find(names.begin(), names.end(), link) == names.end())
    throw InputError(where, fmt::format("routing.{}.link '{}' is not a link of the robot", name, link),
                     fmt::format("one of: {}", fmt::join(names, ", ")));
}

void check_clamp(const std::optional<Clamp>& clamp, const std::string& name, const Routing& routing,
                 const Robot& robot) {
  if (!clamp)
    throw InputError(routing.where, fmt::format("routing.{} is missing", name),
                     "give link, position_m and direction of the clamp");
  check_place(clamp->link, clamp->direction, name, clamp->where, robot);
}

/// What the robot's links carry cannot go with recorded poses.
void check_robot_only(const Routing& routing) {
  const auto refuse = [&](bool given, const char* key, const Where& where) {
    if (given)
      throw InputError(
          where, fmt::format("routing.{} needs a robot (motion.clamp_poses brings two poses only)", key),
          "describe the motion by a robot, or leave it out");
  };
  if (!routing.clamps.empty()) refuse(true, "clamps", routing.clamps.front().clamp.where);
  if (!routing.rings.empty()) refuse(true, "rings", routing.rings.front().where);
  if (routing.retraction) refuse(true, "retraction", routing.retraction->where);
  refuse(routing.tool_end == ToolEnd::free, "tool_end: free", routing.where);
  refuse(routing.pre_twist != 0, "pre_twist_deg", routing.where);
}

void check_rings(const MountedDresspack& mounted, const Robot& robot) {
  const Routing& routing = mounted.routing;
  double before = 0;
  for (std::size_t k = 0; k < routing.rings.size(); ++k) {
    const GuideRing& ring = routing.rings[k];
    const std::string name = fmt::format("rings[{}]", k + 1);
    check_place(ring.link, ring.direction, name, ring.where, robot);
    if (2 * ring.radius <= mounted.dresspack.diameter)
      throw InputError(ring.where,
                       fmt::format("routing.{}.radius_mm is {} (the dresspack's own radius is {} mm)", name,
                                   1e3 * ring.radius, 1e3 * mounted.dresspack.diameter / 2),
                       "give a ring that lets it through");
    if (!ring.at_length) continue;
    if (!(*ring.at_length > before && *ring.at_length < routing.free_length))
      throw InputError(
          ring.where,
          fmt::format("routing.{}.at_length_m is {} (must lie between {} and {}, the ring or clamp before "
                      "it and the dresspack's end)",
                      name, *ring.at_length, before, routing.free_length),
          "list the rings in their order along the dresspack");
    before = *ring.at_length;
  }
  if (!routing.rings.empty() && !routing.clamps.empty())
    for (const GuideRing& ring : routing.rings)
      if (!ring.at_length)
        throw InputError(ring.where,
                         "a ring beside routing.clamps has no at_length_m (it tells between which clamps)",
                         "give the length of dresspack from the base clamp to the ring");
}

void check_intermediate_clamps(const Routing& routing, const Robot& robot) {
  double before = 0;
  for (std::size_t k = 0; k < routing.clamps.size(); ++k) {
    const auto& [clamp, at_length] = routing.clamps[k];
    check_clamp(clamp, fmt::format("clamps[{}]", k + 1), routing, robot);
    if (!(at_length > before && at_length < routing.free_length))
      throw InputError(
          clamp.where,
          fmt::format("routing.clamps[{}].at_length_m is {} (must lie between {} and {}, the clamps "
                      "before and after it)",
                      k + 1, at_length, before, routing.free_length),
          "list the clamps in their order along the dresspack");
    before = at_length;
  }
}

void check_routing(const MountedDresspack& mounted, const Job& job) {
  const Routing& routing = mounted.routing;
  if (job.motion.clamp_poses.empty()) {
    check_clamp(routing.base_clamp, "base_clamp", routing, job.robot);
    if (routing.tool_end == ToolEnd::clamped)
      check_clamp(routing.tool_clamp, "tool_clamp", routing, job.robot);
  } else if (routing.base_clamp || routing.tool_clamp) {
    throw InputError(routing.where, "clamps are given although motion.clamp_poses brings their poses",
                     "keep one of the two");
  }
  if (!job.motion.clamp_poses.empty()) check_robot_only(routing);
  check_intermediate_clamps(routing, job.robot);
  check_rings(mounted, job.robot);
  if (routing.tool_end == ToolEnd::free && routing.tool_clamp)
    throw InputError(routing.tool_clamp->where,
                     "routing.tool_clamp is given although routing.tool_end is free", "keep one of the two");
  if (routing.tool_end == ToolEnd::free && routing.pre_twist != 0)
    throw InputError(routing.where, "routing.pre_twist_deg is given although routing.tool_end is free",
                     "keep one of the two");
  if (routing.tool_mass > 0 && routing.tool_end == ToolEnd::clamped)
    throw InputError(routing.where, "routing.tool_mass_kg is given although the tool end is clamped",
                     "add tool_end: free, or leave the mass out");
  if (!routing.mounting_pose.empty() && routing.mounting_pose.size() != job.robot.axes())
    throw InputError(routing.where,
                     fmt::format("mounting_pose_deg has {} angles (the robot has {} axes)",
                                 routing.mounting_pose.size(), job.robot.axes()),
                     "give one angle per axis");
}

int check_component(const Component& component, const Component* parent) {
  const Where& where = component.where;
  if (component.components.empty() == component.material.empty())
    throw InputError(where,
                     fmt::format("'{}' must have either a material (a wire) or components", component.name),
                     "give one of the two");
  if (component.count > 1 && component.helix_radius == 0)
    throw InputError(
        where,
        fmt::format("{} parts '{}' lie on the axis (helix_radius_mm is 0)", component.count, component.name),
        "give their distance from the axis");
  if (component.helix_radius == 0 && component.lay_angle != 0)
    throw InputError(where, fmt::format("'{}' on the axis has a lay angle", component.name),
                     "set lay_angle_deg to 0");
  if (component.name.find('/') != std::string::npos || component.layer.find('/') != std::string::npos)
    throw InputError(where, fmt::format("name '{}' holds a '/'", component.name), "choose another name");
  if (parent && component.helix_radius + component.radius > parent->radius * 1.02)
    throw InputError(
        where,
        fmt::format("'{}' reaches {:.4g} mm from the axis of '{}', whose radius is {:.4g} mm", component.name,
                    1e3 * (component.helix_radius + component.radius), parent->name, 1e3 * parent->radius),
        "check helix_radius_mm and radius_mm");
  int depth = 0;
  for (const Component& inner : component.components)
    depth = std::max(depth, check_component(inner, &component));
  return depth + 1;
}

/// A thin wall with round crests and roots fits the profile (strain/corrugation.h).
void check_hose(const Dresspack& dresspack) {
  if (!dresspack.hose_corrugation) return;
  const Corrugation& c = *dresspack.hose_corrugation;
  if (dresspack.hose_strain_factor)
    throw InputError(c.where, "both hose_strain_factor and hose_corrugation are given",
                     "keep one of the two");
  if (c.height - c.wall < c.pitch / 2 || c.wall > c.pitch / 4 || c.height > dresspack.diameter / 2)
    throw InputError(
        c.where,
        fmt::format(
            "a corrugation of pitch {:.4g}, height {:.4g} and wall {:.4g} mm is not evaluated (height "
            "less wall must be at least half the pitch, the wall at most a quarter of it)",
            1e3 * c.pitch, 1e3 * c.height, 1e3 * c.wall),
        "check the three, or give hose_strain_factor");
}

/// Friction needs to know what presses the parts together. level: of `component`, 1 = in the dresspack.
void check_friction(const Component& component, const std::vector<Slip>& slip, std::size_t level) {
  if (slip[std::min(level, slip.size()) - 1] == Slip::friction &&
      !(component.friction && component.radial_line_load))
    throw InputError(component.where,
                     fmt::format("'{}' has no {} (strain.slip of its level is friction)", component.name,
                                 component.friction ? "radial_line_load_N_per_m" : "friction_coefficient"),
                     "give both, or slip: free or stick");
  for (const Component& inner : component.components) check_friction(inner, slip, level + 1);
}

/// Levels of parts in it.
int check_dresspack(const Dresspack& dresspack, const std::vector<Slip>& slip) {
  Component hose;
  hose.name = "hose";
  hose.radius = dresspack.diameter / 2;
  int depth = 0;
  for (const Component& component : dresspack.components)
    depth = std::max(depth, check_component(component, &hose));
  check_hose(dresspack);
  for (const Component& component : dresspack.components) check_friction(component, slip, 1);
  return depth;
}

void check_materials(const std::vector<Material>& materials) {
  for (const Material& material : materials) {
    const auto& table = material.strain_life_table;
    if (table.size() == 1)
      throw InputError(material.where, fmt::format("strain_life_table of '{}' has one point", material.name),
                       "give at least two");
    for (std::size_t i = 1; i < table.size(); ++i)
      if (!(table[i].strain_amplitude < table[i - 1].strain_amplitude &&
            table[i].cycles > table[i - 1].cycles))
        throw InputError(
            material.where,
            fmt::format("point {} of strain_life_table of '{}' is no smaller strain with a longer life",
                        i + 1, material.name),
            "order the points by falling strain amplitude and rising cycles");
  }
}

void check_names(const std::vector<MountedDresspack>& dresspacks) {
  for (std::size_t d = 0; d < dresspacks.size(); ++d) {
    const MountedDresspack& mounted = dresspacks[d];
    if (mounted.name.find('/') != std::string::npos)
      throw InputError(mounted.where, fmt::format("name '{}' holds a '/'", mounted.name),
                       "choose another: it begins the paths of the dresspack's wires");
    for (std::size_t other = 0; other < d; ++other)
      if (dresspacks[other].name == mounted.name)
        throw InputError(mounted.where, fmt::format("two dresspacks are named '{}'", mounted.name),
                         "give each another name");
  }
}

/// What all dresspacks of a robot share: one pose in which they are clamped, one material of each name.
void check_shared(const std::vector<MountedDresspack>& dresspacks) {
  const MountedDresspack* posed = nullptr;
  std::vector<const Material*> known;
  for (const MountedDresspack& mounted : dresspacks) {
    if (!mounted.routing.mounting_pose.empty()) {
      if (posed && posed->routing.mounting_pose != mounted.routing.mounting_pose)
        throw InputError(mounted.routing.where,
                         fmt::format("mounting_pose_deg differs from that of dresspack '{}' (all are clamped "
                                     "in one pose)",
                                     posed->name),
                         "give the same, or give it once");
      posed = &mounted;
    }
    for (const Material& material : mounted.dresspack.materials) {
      const auto same = std::find_if(known.begin(), known.end(),
                                     [&](const Material* other) { return other->name == material.name; });
      if (same == known.end())
        known.push_back(&material);
      else if (to_yaml(echo_fields(**same)) != to_yaml(echo_fields(material)))
        throw InputError(
            material.where,
            fmt::format("material '{}' is another than that of the dresspack before", material.name),
            "give one of the two another name");
    }
  }
}

void check_dresspacks(const Job& job, const Where& strain) {
  if (!forms_of(job).one) check_names(job.dresspacks);
  if (job.dresspacks.size() > 1 && !job.motion.clamp_poses.empty())
    throw InputError(job.motion.where,
                     fmt::format("motion.clamp_poses brings the clamps of one dresspack (there are {})",
                                 job.dresspacks.size()),
                     "describe the motion by a robot, or keep one dresspack");
  int depth = 0;
  for (const MountedDresspack& mounted : job.dresspacks) {
    check_routing(mounted, job);
    depth = std::max(depth, check_dresspack(mounted.dresspack, job.strain.slip));
    check_materials(mounted.dresspack.materials);
  }
  check_shared(job.dresspacks);
  if (job.strain.slip.size() > 1 && static_cast<int>(job.strain.slip.size()) != depth)
    throw InputError(
        strain,
        fmt::format("strain.slip lists {} levels (the dresspack has {})", job.strain.slip.size(), depth),
        "give one word, or one per level, outermost first");
}

void check_simulation(const Simulation& simulation, const Where& where) {
  if (simulation.choose_time_step) return;  // the choice fits the rate
  const double steps = 1 / (simulation.sample_rate * simulation.time_step);
  if (steps < 0.999 || std::abs(steps - std::round(steps)) > 1e-6 * steps)
    throw InputError(where,
                     fmt::format("simulation.sample_rate_Hz {} leaves {:.6g} steps of {} ms between samples",
                                 simulation.sample_rate, steps, 1e3 * simulation.time_step),
                     "choose both so that it is a whole number");
}

void check_boxes(const std::vector<Box>& boxes, const Where& where) {
  for (const Box& box : boxes)
    if (!(box.sides.minCoeff() > 0))
      throw InputError(where, "a box has a side of length 0 or less", "mend its sides_m");
}

void check(const Job& job, const Node& document) {
  auto where = [&](const char* key) {
    return document.find(key) ? document.find(key)->where : document.where;
  };
  if (job.motion.clamp_poses.empty()) check_robot(job.robot, where("robot"));
  for (const Link& link : job.robot.links) check_boxes(link.boxes, where("robot"));
  check_boxes(job.cell.boxes, where("cell"));
  check_motion(job.motion, job.robot);
  check_dresspacks(job, where("strain"));
  check_simulation(job.simulation, where("simulation"));
}

/// Exactly one of the two forms in which a job gives its dresspacks.
void check_forms(const Node& document) {
  const Node* list = document.find("dresspacks");
  for (const char* key : {"dresspack", "routing"}) {
    const Node* alone = document.find(key);
    if (list && alone)
      throw InputError(
          alone->where,
          fmt::format("both dresspacks and {0} are given (each of the list has its own {0})", key),
          "keep one of the two");
    if (!list && !alone)
      throw InputError(document.where, fmt::format("{} is missing (and there is no list dresspacks)", key),
                       "give dresspack and routing, or a list dresspacks of name, dresspack, routing");
  }
  if (list && (!list->is_list() || list->items.empty()))
    throw InputError(list->where, "dresspacks holds no dresspack",
                     "write a list of name, dresspack and routing");
}

}  // namespace

// ---- reading and writing jobs -----------------------------------------------------------------------------

Job job_from(Node document, const std::vector<std::string>& sets) {
  if (!document.is_map())
    throw InputError(document.where, "holds no job", "write robot, motion, dresspack, routing");
  for (const std::string& set : sets) apply_set(document, set);
  check_forms(document);
  resolve_job(document);
  Job job;
  if (document.find("dresspacks")) job.dresspacks.clear();
  read_fields(document, job);
  for (MountedDresspack& mounted : job.dresspacks) {
    Routing& routing = mounted.routing;
    for (std::optional<Clamp>* clamp : {&routing.base_clamp, &routing.tool_clamp})
      if (*clamp) place_clamp(**clamp, job.robot);
    for (IntermediateClamp& between : routing.clamps) place_clamp(between.clamp, job.robot);
  }
  check(job, document);
  return job;
}

Job read_job(const std::filesystem::path& file, const std::vector<std::string>& sets) {
  return job_from(read_yaml(file), sets);
}

std::string job_text(const Job& job) { return to_yaml(echo_fields(job)); }

namespace {

/// What of a dresspack decides the strain of its parts.
struct StrainKeys {
  MountedDresspack mounted;
  bool friction = false;
};

void describe(Fields& echo, StrainKeys& keys) {
  Dresspack& dresspack = keys.mounted.dresspack;
  if (!keys.mounted.name.empty()) echo.text("name", keys.mounted.name, Need::required, "");
  echo.list("components", dresspack.components, Need::optional, "");
  if (keys.friction)  // stiffness of the wires
    echo.list("materials", dresspack.materials, Need::optional, "");
  if (dresspack.rest_curvature != 0)
    echo.number("rest_curvature_1_per_m", dresspack.rest_curvature, Need::optional, any_number(), "");
  if (dresspack.hose_material.empty()) return;
  echo.text("hose_material", dresspack.hose_material, Need::optional, "");
  echo.maybe_number("hose_strain_factor", dresspack.hose_strain_factor, any_number(), "");
  echo.maybe_group("hose_corrugation", dresspack.hose_corrugation, "");
  echo.number("diameter_mm", dresspack.diameter, Need::optional, any_number(), "");
}

/// What of a dresspack decides its lives.
struct FatigueKeys {
  MountedDresspack mounted;
};

void describe(Fields& echo, FatigueKeys& keys) {
  if (!keys.mounted.name.empty()) echo.text("name", keys.mounted.name, Need::required, "");
  echo.list("materials", keys.mounted.dresspack.materials, Need::optional, "");
}

/// As in the job: the only one's keys stand alone, those of several in a list.
template <class Keys>
void describe_each(Fields& echo, const Forms& forms, std::vector<Keys> keys) {
  if (forms.one)
    describe(echo, keys.front());
  else
    echo.list("dresspacks", keys, Need::required, "");
}

void describe_sim(Fields& echo, Job copy) {
  const Forms forms = forms_of(copy);
  for (MountedDresspack& mounted : copy.dresspacks) {
    Dresspack& dresspack = mounted.dresspack;
    dresspack.components.clear();
    dresspack.materials.clear();
    dresspack.hose_material.clear();
    dresspack.hose_strain_factor.reset();
    dresspack.hose_corrugation.reset();
  }
  echo.group("motion", copy.motion, Need::required, "");
  echo.group("robot", copy.robot, Need::optional, "", !copy.robot.joints.empty());
  if (forms.one) {
    echo.group("dresspack", copy.dresspacks.front().dresspack, Need::required, "");
    echo.group("routing", copy.dresspacks.front().routing, Need::required, "");
  } else {
    echo.list("dresspacks", copy.dresspacks, Need::required, "");
  }
  echo.group("cell", copy.cell, Need::optional, "");
  echo.group("simulation", copy.simulation, Need::optional, "");
}

void describe_strain(Fields& echo, Job copy) {
  const bool friction = std::count(copy.strain.slip.begin(), copy.strain.slip.end(), Slip::friction) > 0;
  std::vector<StrainKeys> keys;
  for (const MountedDresspack& mounted : copy.dresspacks) keys.push_back({mounted, friction});
  describe_each(echo, forms_of(copy), keys);
  echo.group("strain", copy.strain, Need::optional, "");
}

void describe_fatigue(Fields& echo, Job copy) {
  std::vector<FatigueKeys> keys;
  for (const MountedDresspack& mounted : copy.dresspacks) keys.push_back({mounted});
  describe_each(echo, forms_of(copy), keys);
  echo.group("fatigue", copy.fatigue, Need::optional, "");
}

}  // namespace

std::string part_text(const Job& job, Part part) {
  const auto described = part == Part::sim      ? describe_sim
                         : part == Part::strain ? describe_strain
                                                : describe_fatigue;
  return to_yaml(echo_fields(Describe([&](Fields& f) { described(f, job); })));
}

std::vector<std::filesystem::path> files_beside(const Job& job) {
  std::vector<std::filesystem::path> files;
  for (const auto& file : {job.motion.clamp_poses, job.motion.program})
    if (!file.empty()) files.push_back(file);
  for (const ProgramFile& module : job.motion.modules) files.push_back(module.file);
  const std::filesystem::path& program = job.motion.program;
  if (program.extension() == ".src" || program.extension() == ".SRC")
    for (const char* end : {".dat", ".DAT"}) {  // KRL reads a program's data list by itself
      const std::filesystem::path data = std::filesystem::path(program).replace_extension(end);
      std::error_code failure;
      if (std::filesystem::is_regular_file(data, failure)) files.push_back(data);
    }
  for (const Link& link : job.robot.links)
    for (const MeshFile& mesh : link.meshes) files.push_back(mesh.file);
  for (const MeshFile& mesh : job.cell.meshes) files.push_back(mesh.file);
  return files;
}

std::string motion_text(const Motion& motion) { return to_yaml(echo_fields(motion)); }

Motion motion_from(const Node& document) {
  Motion motion;
  read_fields(document, motion);
  check_frames(motion);
  return motion;
}

std::string job_manual() {
  const Describe both_forms = [](Fields& f) {
    Job job;
    describe_keys(f, job, {true, true});
  };
  return field_manual("job", both_forms) + field_manual<UrdfRequest>("job.robot from a URDF");
}

namespace {

const Material& resolved_material(const Job& job, const std::string& wanted) {
  for (const MountedDresspack& mounted : job.dresspacks)
    for (const Material& material : mounted.dresspack.materials)
      if (material.name == wanted) return material;
  throw std::logic_error("material '" + wanted + "' was not resolved");
}

}  // namespace

const Material& material_of(const Job& job, const std::string& name) {
  return resolved_material(job, job.fatigue.material.empty() ? name : job.fatigue.material);
}

const Material& hose_material_of(const Job& job, const Dresspack& dresspack) {
  return resolved_material(job, dresspack.hose_material);
}

std::string name_among(const Job& job, std::size_t dresspack) {
  return job.dresspacks.size() > 1 ? job.dresspacks[dresspack].name : "";
}

std::string dresspack_words(const Job& job, std::size_t dresspack) {
  const std::string name = name_among(job, dresspack);
  return name.empty() ? "dresspack" : fmt::format("dresspack '{}'", name);
}

bool is_hose_wall(const Dresspack& dresspack, std::string_view component) {
  return !dresspack.hose_material.empty() && component.starts_with(hose_wall_name) &&
         component.find_first_not_of("0123456789", hose_wall_name.size() + 1) == std::string_view::npos &&
         component.size() > hose_wall_name.size() + 1 && component[hose_wall_name.size()] == ' ';
}

}  // namespace dresslife::pipeline
