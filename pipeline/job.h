// What a user describes: robot, motion, dresspack, routing and the settings of each stage.
//
// Every struct below has one describe() in job.cpp that lists its keys once: name with unit, range, default
// and meaning. That list reads, checks, echoes and documents the key (see fields.h). All values here are SI;
// the unit in a YAML key is the unit of the file. Robot, motion, dresspack and material are catalogue
// entries: a job names a file of config/ or holds the entry itself, and `from: NAME` starts from a catalogue
// entry.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/document.h"

namespace dresslife::pipeline {

using Eigen::Vector3d;

// ---- robot ------------------------------------------------------------------------------------------------

/// A turning joint. One that follows another (a parallelogram's rod) has no drive: q = ratio q_other +
/// offset.
struct Joint {
  std::string name;
  Vector3d origin = Vector3d::Zero();       ///< in the frame of the link before [m]
  Vector3d orientation = Vector3d::Zero();  ///< roll, pitch, yaw of the joint frame, fixed axes x, y, z [rad]
  Vector3d axis = Vector3d::UnitZ();        ///< in the joint frame
  double lower = 0, upper = 0;              ///< [rad]
  double speed = 0;                         ///< largest [rad/s]
  double acceleration = 0;                  ///< largest [rad/s2]
  std::string follows;                      ///< name of the joint whose angle moves it; empty: a driven axis
  double ratio = 1, offset = 0;             ///< of a joint that follows [1, rad]
  Where where;
};

/// A drive besides the robot's axes: a track that carries the robot, or one that only takes its time.
struct ExternalAxis {
  std::string name;
  enum class Kind { linear, rotary } kind = Kind::linear;
  enum class Carries { robot, nothing } carries = Carries::robot;
  Vector3d origin = Vector3d::Zero();       ///< in the world, or on the axis before that carries [m]
  Vector3d orientation = Vector3d::Zero();  ///< roll, pitch, yaw [rad]
  Vector3d axis = Vector3d::UnitX();        ///< slides along or turns about it
  double lower = 0, upper = 0;              ///< [m or rad, as all below]
  double speed = 0, acceleration = 0;
  Where where;
};

struct Capsule {
  Vector3d from = Vector3d::Zero(), to = Vector3d::Zero();  ///< ends of its axis, in the link's frame [m]
  double radius = 0;                                        ///< [m]
};

struct Box {
  Vector3d position = Vector3d::Zero();     ///< of its centre, in the link's frame [m]
  Vector3d orientation = Vector3d::Zero();  ///< roll, pitch, yaw [rad]
  Vector3d sides = Vector3d::Zero();        ///< full lengths along its own axes [m]
};

struct MeshFile {
  std::filesystem::path file;               ///< STL or OBJ
  double scale = 1;                         ///< metres per unit of the file
  Vector3d position = Vector3d::Zero();     ///< of the file's origin, in the link's frame [m]
  Vector3d orientation = Vector3d::Zero();  ///< roll, pitch, yaw [rad]
};

struct Link {
  std::string name;  ///< link k > 0 is moved by joint k - 1 (counted from 0); link 0 is the base
  std::vector<Capsule> capsules;
  std::vector<Box> boxes{};
  std::vector<MeshFile> meshes{};
};

/// A place on a link to which dresspacks are clamped.
struct MountingPoint {
  std::string name, link;
  Vector3d position = Vector3d::Zero();    ///< in the link's frame [m]
  Vector3d direction = Vector3d::UnitZ();  ///< of the dresspack there, base to tool
};

/// What stands still around the robot, in the world's frame.
struct Cell {
  std::vector<Capsule> capsules;
  std::vector<Box> boxes;
  std::vector<MeshFile> meshes;
};

struct Robot {
  std::string name, source;
  Vector3d base_position = Vector3d::Zero();     ///< of link 0 in the world [m]
  Vector3d base_orientation = Vector3d::Zero();  ///< roll, pitch, yaw [rad]
  Vector3d program_base = Vector3d::Zero();  ///< origin of the frame programs are written in, in link 0 [m]
  Vector3d flange_position = Vector3d::Zero();     ///< of the flange frame in the last link [m]
  Vector3d flange_orientation = Vector3d::Zero();  ///< roll, pitch, yaw; its z axis leaves the flange [rad]
  std::vector<ExternalAxis> external_axes;         ///< those that carry the robot from the world on
  std::vector<Joint> joints;                       ///< serial, from the base
  std::vector<Link> links;                         ///< joints + 1
  std::vector<MountingPoint> mounting_points;

  std::size_t axes() const;  ///< joints that follow no other
};

// ---- motion -----------------------------------------------------------------------------------------------

enum class PathKind { joint, linear, circular };

/// One line of a robot program: a move, a dwell, or a block repeated `repeat` times. A move leads to joint
/// angles or to a pose of the tool in the work object.
struct MotionStep {
  PathKind path = PathKind::joint;    ///< how a move gets there; linear and circular: by a pose
  std::vector<double> joints;         ///< target of a joint move [rad]; empty: a pose, or not a move
  std::vector<double> position;       ///< target of the tool: x, y, z [m]; empty: none
  std::vector<double> quaternion;     ///< of the tool: w, x, y, z
  std::vector<double> via_position;   ///< of a circular move: a point on the way [m]
  std::string configuration;          ///< "abb 0 -1 0 1", "kuka 2 35", "fanuc NUT 0 0 0"; empty: the nearest
  std::vector<double> external_axes;  ///< as programmed: mm or deg, in the order of the robot's
  std::string tool, work_object;      ///< names in Motion; empty: flange, robot base
  std::optional<double> speed_percent;         ///< of each axis' largest speed [%]
  std::optional<double> speed;                 ///< of the fastest axis [rad/s]
  std::optional<double> tool_speed;            ///< largest of the tool's origin [m/s]
  std::optional<double> turn_speed;            ///< largest of the tool's rotation [rad/s]
  std::optional<double> duration;              ///< of the whole move [s]
  std::optional<double> acceleration_percent;  ///< of each axis' largest acceleration, besides Motion's [%]
  std::optional<double> zone;  ///< blending begins this far from the target, largest axis [rad]; 0 = stop
  std::optional<double> tool_zone;  ///< blending begins this far from the target, tool [m]; 0 = stop
  std::optional<double>
      stop_zone;     ///< blending begins at this share of the way in which the robot would stop [%]
  double dwell = 0;  ///< [s]
  int repeat = 0;    ///< 0: not a block
  std::vector<MotionStep> steps;  ///< of a block
  std::string text;               ///< what the step is, for reports
  Where where;

  bool is_move() const { return !joints.empty() || !position.empty(); }
};

/// A tool in the flange's frame, or a work object in the frame of the robot's base.
struct MotionFrame {
  std::string name;
  Vector3d position = Vector3d::Zero();  ///< [m]
  std::vector<double> quaternion{1, 0, 0, 0};
  bool stationary = false;  ///< a tool that stands in the base frame while the flange carries the work object
};

/// A line of a program on which a branch hangs on what is known only while the robot runs.
struct BranchAssumption {
  std::string line;  ///< "file.mod:12" or "12"
  enum class Take { then_branch, else_branch } take = Take::then_branch;
};

struct ProgramFile {
  std::filesystem::path file;
};

struct Motion {
  std::string name, source;
  double speed_percent = 100;  ///< default of the moves [%]
  double acceleration_percent = 100;
  double zone = 0;  ///< default of the moves [rad]
  std::vector<MotionFrame> tools, work_objects;
  std::vector<MotionStep> steps;     ///< the first is a move: the robot starts there, at rest
  std::filesystem::path program;     ///< a robot program instead of steps (sim/program); empty: none
  std::vector<ProgramFile> modules;  ///< more files of the program
  std::string routine;               ///< of the program; empty: its start
  std::vector<BranchAssumption> assume;
  double spot_time = 1;               ///< dwell of a spot weld in a program [s]
  std::filesystem::path clamp_poses;  ///< CSV with both clamps' poses instead of steps; empty: none
  Where where;
};

// ---- dresspack --------------------------------------------------------------------------------------------

/// One measured point of a strain-life curve.
struct StrainLifePoint {
  double strain_amplitude = 0;
  double cycles = 0;
};

struct Material {
  std::string name, source;
  double youngs_modulus = 0;  ///< E [Pa]
  double poisson_ratio = 0;
  double fatigue_strength = 0;                      ///< sigma_f' [Pa]
  double fatigue_strength_exponent = 0;             ///< b
  double fatigue_ductility = 0;                     ///< epsilon_f'
  double fatigue_ductility_exponent = 0;            ///< c
  std::optional<double> cyclic_strength;            ///< K' [Pa]; absent: sigma_f' / epsilon_f'^n'
  std::optional<double> cyclic_hardening_exponent;  ///< n'; absent: b / c
  std::optional<double> walker_exponent;            ///< gamma; absent: 0.5, that of SWT
  std::vector<StrainLifePoint>
      strain_life_table;  ///< instead of sigma_f' to n', for polymers; larger strains first
  Where where;
};

enum class Hand { right, left };

/// K equal parts on one helix, each of which may hold further layers of parts (physics.md 1).
struct Component {
  std::string name;         ///< "signal cable"; parts are numbered "signal cable 1", ...
  std::string layer;        ///< set where several layers of parts share a name: "layer 1"; else empty
  int count = 1;            ///< K
  double radius = 0;        ///< of the part [m]
  double helix_radius = 0;  ///< R, from the parent's axis to the part's [m]
  double lay_angle = 0;     ///< alpha >= 0 [rad]
  Hand hand = Hand::right;
  double phase = 0;                ///< theta_layer: angle of part 1 at the base clamp [rad]
  std::optional<double> friction;  ///< Coulomb, on what it lies against; needed where slip is `friction`
  std::optional<double> radial_line_load;  ///< that presses the part on what it lies against [N/m]; likewise
  double tension = 0;                      ///< of the part in the dresspack at rest [N]
  std::string material;  ///< of a wire; a key of Dresspack::materials; empty for a part with parts
  std::vector<Component> components;
  Where where;
};

/// The profile of a hose's wall, as a caliper finds it.
struct Corrugation {
  double pitch = 0;   ///< of one corrugation along the hose [m]
  double height = 0;  ///< half the difference of outer and inner diameter [m]
  double wall = 0;    ///< thickness of the material [m]
  Where where;
};

struct Dresspack {
  std::string name, source;
  double diameter = 0;                          ///< outer, of the hose [m]
  double mass_per_length = 0;                   ///< of the filled hose [kg/m]
  double bending_stiffness = 0;                 ///< EI [N m2]
  double torsional_stiffness = 0;               ///< GJ [N m2]
  double axial_stiffness = 0;                   ///< EA [N]
  double rest_curvature = 0;                    ///< of the unloaded hose, toward x of its base clamp [1/m]
  double damping_time = 0;                      ///< Kelvin-Voigt tau of bending and twist [s]
  std::string damping_source;                   ///< where the damping was measured or why it is guessed
  double friction = 0;                          ///< Coulomb, hose against robot
  std::optional<double> least_bend_radius;      ///< allowed in motion [m]; absent: ten diameters
  std::optional<double> most_twist;             ///< allowed in motion [rad/m]; absent: 180 deg/m
  std::string hose_material;                    ///< of the hose's wall; empty: its strain is not evaluated
  std::optional<double> hose_strain_factor;     ///< strain of the wall over that of a smooth hose
  std::optional<Corrugation> hose_corrugation;  ///< gives that factor instead; neither: a smooth hose
  std::vector<Component> components;
  std::vector<Material> materials;  ///< those that the wires name, looked up in the catalogue
};

/// The hose's wall as a part of the dresspack: "hose 1" to "hose 16" are places around it.
constexpr std::string_view hose_wall_name = "hose";
/// Whether a part's path in this dresspack names a place of the hose's wall, not a wire.
bool is_hose_wall(const Dresspack& dresspack, std::string_view component);

// ---- routing ----------------------------------------------------------------------------------------------

struct Clamp {
  std::string link;                        ///< of the robot
  Vector3d position = Vector3d::Zero();    ///< in the link's frame [m]
  Vector3d direction = Vector3d::UnitZ();  ///< of the dresspack there, base to tool, in the link's frame
  std::optional<double> roll;  ///< about the direction [rad]; absent: 0 at the base clamp, else twist-free
  Where where;
  std::string mounting_point{};  ///< of the robot, instead of link, position, direction; empty once read
};

/// A clamp between the two ends: the dresspack is gripped there, in position, direction and twist.
struct IntermediateClamp {
  Clamp clamp;
  double at_length = 0;  ///< of the dresspack from the base clamp, unstretched [m]
};

/// A ring through which the dresspack slides and turns.
struct GuideRing {
  std::string link;
  Vector3d position = Vector3d::Zero();    ///< of its centre, in the link's frame [m]
  Vector3d direction = Vector3d::UnitZ();  ///< of its axis, base to tool, in the link's frame
  double radius = 0;                       ///< clear inner [m]
  double friction = 0;                     ///< Coulomb
  double width = 0;                        ///< along its axis: a short tube [m]
  std::optional<double> at_length;         ///< of dresspack from the base clamp to the ring when mounted [m]
  Where where;
};

/// Spring-returned slack: the base clamp slides along its direction and is pulled back.
struct Retraction {
  double force = 0;     ///< at travel 0 [N]
  double spring = 0;    ///< more per way pulled out [N/m]
  double stroke = 0;    ///< [m]
  double damping = 0;   ///< [N s/m]
  double friction = 0;  ///< Coulomb [N]
  double mass = 1;      ///< of what slides, without the hose between the clamps [kg]
  Where where;
};

enum class ToolEnd { clamped, free };

struct Routing {
  double free_length = 0;                       ///< of dresspack between the clamps, unstretched [m]
  std::optional<Clamp> base_clamp, tool_clamp;  ///< absent with clamp_poses only
  std::vector<IntermediateClamp> clamps;        ///< between them, in order along the dresspack
  std::vector<GuideRing> rings;                 ///< in order along the dresspack
  std::optional<Retraction> retraction;         ///< of the base clamp
  double pre_twist = 0;                         ///< of the tool clamp on top of twist-free [rad]
  ToolEnd tool_end = ToolEnd::clamped;          ///< free: it hangs from its last clamp, no tool_clamp
  double tool_mass = 0;                         ///< at a free end [kg]
  std::vector<double>
      mounting_pose;  ///< joints when the dresspack was clamped free of twist [rad]; empty: start
  Where where;
};

/// One of the robot's dresspacks as it is clamped.
struct MountedDresspack {
  std::string name;  ///< empty: the only one, given by the job's own keys `dresspack` and `routing`
  Dresspack dresspack;
  Routing routing;
  Where where;
};

// ---- settings of the stages -------------------------------------------------------------------------------

struct Simulation {
  int segments = 50;                 ///< of each dresspack
  double time_step = 0.005;          ///< [s]
  bool choose_time_step = false;     ///< time_step_ms: auto; time_step is then where the choice begins
  double curvature_error = 0.5;      ///< that a chosen step may leave [%]
  double sample_rate = 25;           ///< of motion.h5 [Hz]; 1/rate is a multiple of the step
  Vector3d gravity{0, 0, -9.81};     ///< [m/s2]
  bool contact = true;               ///< with the robot's links
  bool self_contact = true;          ///< of dresspacks with themselves and each other
  bool floor = true;                 ///< contact with the plane z = 0 too
  double periodic_tolerance = 1e-3;  ///< a motion is repeated until repeats begin this much alike [m]
  int most_repeats = 8;              ///< of the motion, also when they do not
};

enum class DeformationMeasure { rotation_vector, thesis };
enum class Kinematics { exact, thesis };
enum class Slip { free, stick, friction };
enum class Equivalent { axial, shear_included, critical_plane };

struct Probe {
  int segment_from_tool = 1;
  std::string component;  ///< path of a wire
};

struct Strain {
  DeformationMeasure deformation = DeformationMeasure::rotation_vector;
  Kinematics kinematics = Kinematics::exact;
  std::vector<Slip> slip{Slip::free};         ///< one for every level, or one per level, outermost first
  Equivalent equivalent = Equivalent::axial;  ///< which strain of a fibre is counted
  int surface_fibres = 1;                     ///< per wire; 0: the wire's axis
  double gate = 5e-4;                         ///< turning points of a smaller strain range are dropped
  std::vector<Probe> probes;
};

enum class Stress { cyclic, elastic };
enum class MeanStress { none, morrow, swt, walker };
enum class Counting { repeating, half_cycles };

struct Fatigue {
  Stress stress = Stress::cyclic;
  MeanStress mean_stress = MeanStress::swt;
  Counting counting = Counting::repeating;
  double endurance_strain = 0;  ///< amplitudes up to this do no damage
  std::string material;         ///< of every wire (not of the hose) instead of its own; empty: its own
  int listed_sites = 20;        ///< worst sites whose cycles are written
  double operating_hours_per_week = 80;  ///< turns hours into months
  double scatter_log10 = 0.2;            ///< standard deviation of log10 of a wire's life
  double failed_wires_percent = 10;      ///< a conductor fails when so many of its wires have
  bool load_sharing = false;             ///< the rest of a conductor takes over the load of its broken wires
};

struct Job {
  Robot robot;  ///< no joints with clamp_poses
  Motion motion;
  std::vector<MountedDresspack> dresspacks = std::vector<MountedDresspack>(1);  ///< at least one
  Cell cell;
  Simulation simulation;
  Strain strain;
  Fatigue fatigue;
};

/// Reads a job, looks up the catalogue entries that it names, applies `--set key.path=value` in their order,
/// checks everything that can be checked without running. Errors: InputError.
Job read_job(const std::filesystem::path& file, const std::vector<std::string>& sets = {});

/// The same for a job that is a tree already: a study's, or the `job` attribute of a file.
Job job_from(Node document, const std::vector<std::string>& sets = {});

/// The resolved job as YAML: catalogue entries written out, defaults filled in. Reads back to the same job.
std::string job_text(const Job& job);

/// What of the job each stage's result depends on; equal text (and equal files beside it), equal result.
enum class Part { sim, strain, fatigue };
std::string part_text(const Job& job, Part part);

/// Files beyond the job and the catalogue that dresslife-sim reads.
std::vector<std::filesystem::path> files_beside(const Job& job);

/// What tells a dresspack from the others: its name, or nothing where it is the only one; and the same as the
/// subject of a sentence: "dresspack 'main hose'", "dresspack".
std::string name_among(const Job& job, std::size_t dresspack);
std::string dresspack_words(const Job& job, std::size_t dresspack);

/// The material that a wire of material `name` has under these settings, and that of a hose's wall, which
/// fatigue.material leaves alone. Dresspacks share their materials: one name, one material. Precondition: the
/// job was read above.
const Material& material_of(const Job& job, const std::string& name);
const Material& hose_material_of(const Job& job, const Dresspack& dresspack);

/// Folders of the catalogue: "robots", "programs", "dresspacks", "materials". A name is looked up beside the
/// file that names it and in its parents (FOLDER/NAME.yaml, config/FOLDER/NAME.yaml; the working folder for
/// --set), then in the same way beside the job (a study or --set may change a job of another place), then in
/// the catalogue that comes with dresslife (the environment variable DRESSLIFE_CONFIG names another). Errors:
/// InputError with the near names.
Node catalogue_entry(const std::string& folder, const std::string& name, const Where& named_at,
                     const Where& job);

/// Sets the value at a key path (`simulation.segments`, `dresspacks.2.routing.free_length_m`); where: who
/// asks for it.
void set_value(Node& job, const std::string& path, Node value, const Where& where);

/// Sets the value at `key.path=value` in a job's tree; list items count from 1. Errors: InputError.
void apply_set(Node& job, const std::string& set);

/// One motion as YAML, and from a document that holds nothing else (checked key by key, not against a robot).
std::string motion_text(const Motion& motion);
Motion motion_from(const Node& document);

/// Every key of a job, as Markdown tables.
std::string job_manual();

}  // namespace dresslife::pipeline
