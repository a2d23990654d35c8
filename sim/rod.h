// The chain: n rigid segments between two clamp frames, tied by n + 1 elastic links, and one step of its
// motion.
//
// Rod is built once and never changes; RodState is what advances; RodSolver holds the factorised step matrix.
// Segment i = 0..n-1 has its centre at s = (i + 1/2) l, link j = 0..n sits at s = j l; links 0 and n tie the
// end segments to the clamps. Body z of a segment and of a clamp frame is the tangent, from base to tool.
//
// (S1) gap     g = (x_b - a t_b) - (x_a + a t_a),  a = l/2;   force f = EA/len g           [N]
// (S2) turn    phi = log(R_a^T R_b);   energy  1/2 (phi - phi_0)^T diag(EI, EI, GJ)/len (phi - phi_0)  [J]
// (S3) step    (M + theta h C + beta h^2 K) dv = h (f(x_n) - C v_n),   v += dv,  x += h v
// Second order in h and l. sim/README.md derives the end links' lengths, the weights and the tension.
// Assumptions: round hose with equal bending stiffness both ways, stretch and shear equally stiff, small
// strain in each link, any rotation. SI units.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "sim/rotation.h"

namespace dresslife::sim {

/// How an end of the hose is held. A pinned end turns freely, a free end (tool side only) also moves freely.
/// A swivel holds position and direction but turns freely about its tangent.
enum class End { clamped, pinned, swivel, free };

struct RodProperties {
  int segments = 50;               ///< n >= 2
  double length = 0;               ///< unstretched, clamp to clamp [m]
  double mass_per_length = 0;      ///< [kg/m]
  double diameter = 0;             ///< outer [m]
  double bending_stiffness = 0;    ///< EI [N m2]
  double torsional_stiffness = 0;  ///< GJ [N m2]
  double axial_stiffness = 0;      ///< EA [N]
  double damping_time = 0;         ///< Kelvin-Voigt tau of bending and twist [s]
  Vector3 gravity{0, 0, -9.81};    ///< [m/s2]
  Vector3 rest_curvature =
      Vector3::Zero();  ///< unloaded kappa1, kappa2, twist in the segment's frame [rad/m]
  End base_end = End::clamped;
  End tool_end = End::clamped;
};

/// The two ends at one time. The tool frame is not used while the tool end is free.
struct ClampFrames {
  Frame base, tool;
};

/// Force [N] and torque about the segment's centre [N m], world axes.
struct Load {
  Vector3 force = Vector3::Zero();
  Vector3 torque = Vector3::Zero();
};

/// Everything that advances. Velocities belong to half a step before the positions' time (leapfrog).
struct RodState {
  std::vector<Vector3> position;                                            ///< (segment) centres [m]
  std::vector<Quaternion> orientation;                                      ///< (segment)
  std::vector<Vector3> velocity;                                            ///< (segment) [m/s]
  std::vector<Vector3> angular_velocity;                                    ///< (segment) world axes [rad/s]
  ClampFrames clamps;                                                       ///< at the positions' time
  std::array<Vector3, 2> clamp_velocity{Vector3::Zero(), Vector3::Zero()};  ///< base, tool [m/s]
  std::array<Vector3, 2> clamp_angular_velocity{Vector3::Zero(), Vector3::Zero()};  ///< [rad/s]
  std::vector<Vector3> link_force;  ///< (link) pull of link j on segment j - 1 over the last step, (S9) [N]
};

/// What a link feels, in its mid-frame.
struct LinkState {
  Vector3 gap;     ///< world axes [m]
  Vector3 turn;    ///< rotation vector phi [rad]
  Vector3 moment;  ///< elastic part, about d1, d2, d3 [N m]
};

struct Energy {
  double kinetic = 0, elastic = 0, gravitational = 0;  ///< [J]; gravitational: 0 at the world's origin
  double total() const { return kinetic + elastic + gravitational; }
};

class Rod {
 public:
  /// Precondition: segments >= 2; length, mass, diameter and stiffnesses > 0.
  explicit Rod(const RodProperties& properties);

  const RodProperties& properties() const { return properties_; }
  int segments() const { return properties_.segments; }
  int links() const { return properties_.segments + 1; }
  double segment_length() const { return segment_length_; }
  double segment_mass() const { return segment_mass_; }
  double axial_inertia() const { return axial_inertia_; }                ///< about the tangent [kg m2]
  double transverse_inertia() const { return transverse_inertia_; }      ///< about d1 or d2 [kg m2]
  double gap_stiffness(int link) const { return gap_stiffness_[link]; }  ///< [N/m], 0: not tied
  const Vector3& turn_stiffness(int link) const { return turn_stiffness_[link]; }  ///< [N m/rad]
  const Vector3& rest_turn(int link) const { return rest_turn_[link]; }            ///< [rad]
  double bending_length(int link) const { return bending_length_[link]; }  ///< compliance length (S5) [m]

  /// A straight, unloaded chain at rest from the base frame along its tangent; both clamps in place.
  RodState straight(const Frame& base) const;
  LinkState link_state(const RodState& state, int link) const;
  Energy energy(const RodState& state) const;
  /// Of stretch, bending, twist and gravity, from positions alone (S11): what an equilibrium minimises [J].
  double potential_energy(const RodState& state) const;
  /// Mean over the chain of the stretch along the tangents [m/m]; > 0: pulled longer than the free length.
  double mean_elongation(const RodState& state) const;
  /// Pull along the tangent in each link, from RodState::link_force [N].
  std::vector<double> tensions(const RodState& state) const;
  /// End of the last segment: the tip of a free end [m].
  Vector3 tip(const RodState& state) const;
  bool finite(const RodState& state) const;

 private:
  RodProperties properties_;
  double segment_length_, segment_mass_, axial_inertia_, transverse_inertia_;
  std::vector<double> gap_stiffness_, bending_length_;
  std::vector<Vector3> turn_stiffness_, rest_turn_;
};

/// By how much the distance between the clamps exceeds the free length [m]; 0 when it does not.
/// The caller stops when this is > 0 or Rod::mean_elongation exceeds longest_elongation.
double missing_length(const Rod& rod, const ClampFrames& clamps);

/// A hose stretched by more than this in the mean is taut: the motion needs more length. (A corrugated hose
/// is far softer than its cables, which reach 2 % only when they break or pull out of the clamps.)
inline constexpr double longest_elongation = 0.02;

struct RodSystem;  // matrix and right-hand side of one step: rod.cpp

/// Velocity change of one segment: linear [m/s], angular [rad/s].
struct Twist6 {
  double value[6];
  Vector3 linear() const { return {value[0], value[1], value[2]}; }
  Vector3 angular() const { return {value[3], value[4], value[5]}; }
};

/// One step of (S3): a 6x6 block tridiagonal system, factored once, O(n).
class RodSolver {
 public:
  explicit RodSolver(const Rod& rod);
  ~RodSolver();
  RodSolver(const RodSolver&) = delete;
  RodSolver& operator=(const RodSolver&) = delete;

  /// Velocity changes over the step h [s] while the clamps go from state.clamps to `end`; loads: none or one
  /// per segment. Returns false when the matrix is not positive definite (a state that is not finite).
  bool solve(const RodState& state, const ClampFrames& end, double h, std::span<const Load> loads = {});
  std::span<const Twist6> velocity_change() const;

  /// x = A^-1 (e in block `segment`, e_other in block `other` unless that is < 0, 0 elsewhere), for blocks >=
  /// first only; A is the matrix of the last solve().
  void unit_response(int segment, const Twist6& e, int other, const Twist6& e_other, int first,
                     std::span<Twist6> x) const;
  /// Adds the answer A^-1 p to generalised impulses p to the velocity changes; p is overwritten. [N s, N m s]
  void apply_impulses(std::span<Twist6> impulses);

  /// Writes what belongs to the step but not to the segments: link forces (S9), clamps and their velocities.
  /// The caller has moved, or will move, the segments by v += dv, x += h v.
  void finish(RodState& state) const;

 private:
  const Rod& rod_;
  std::unique_ptr<RodSystem> system_;
};

/// solve(), v += dv, x += h v, finish() without ODE: for closed forms and for relaxation. False as solve().
bool advance_rod(const Rod& rod, RodSolver& solver, RodState& state, const ClampFrames& end, double h,
                 std::span<const Load> loads = {});

}  // namespace dresslife::sim
