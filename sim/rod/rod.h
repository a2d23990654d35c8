// The chain: rigid segments connected by elastic links, in one or more spans between clamps, and one step of its motion.
//
// Rod is built once and never changes. RodState is what a step changes. RodSolver has the factored matrix of a step.
// Segment i = 0..n-1 of a span has its centre at s = (i + 1/2) l, link j = 0..n is at s = j l. Links 0 and n connect the end
// segments to the clamps. Body z of a segment and of a clamp frame is the tangent, from base to tool. A clamp between two
// spans is the tool end of one span and the base end of the next. Each span moves as a dresspack of its own; only contacts
// couple spans. Segments, links and ends are numbered through all spans.
//
// (S1) gap     g = (x_b - c a t_b) - (x_a + c a t_a),  a = l/2;   force f = EA/len g       [N]
// (S17)        c = 1 + (1 - t_a.t_b)/12 between two segments, 1 at a clamp
// (S2) turn    phi = log(R_a^T R_b);   energy  1/2 (phi - phi_0)^T diag(EI, EI, GJ)/len (phi - phi_0)  [J]
// (S3) step    (M + theta h C + beta h^2 K) dv = h (f(x_n) - C v_n),   v += dv,  x += h v
// Second order in h and l. sim/rod/theory.md derives the lengths of the end links, the weights and the tension.
// Assumptions: round hose with equal bending stiffness about both axes, stretch and shear equally stiff, small
// strain in each link, any rotation. SI units.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "sim/rod/hysteresis.h"
#include "sim/rod/rotation.h"

namespace dresslife::sim {

/// Support of an end of the hose. pinned: position is held, rotation is free. swivel: position and direction are held, rotation
/// about the tangent is free. free (tool end only): not held.
enum class End { clamped, pinned, swivel, free };

/// A base clamp that slides along its direction and is pulled back by a spring (S14).
struct SlidingClamp {
  double force = 0;     ///< against its direction, at travel 0 [N]
  double spring = 0;    ///< increase of the force per travel [N/m]
  double stroke = 0;    ///< largest travel; stops limit it to 0 .. stroke [m]
  double damping = 0;   ///< [N s/m]
  double friction = 0;  ///< Coulomb [N]
  double mass = 1;      ///< of the clamp [kg]
};

/// Additional bending stiffness near an end (S24).
struct StiffEnd {
  double length = 0;             ///< from the end [m]
  double bending_stiffness = 0;  ///< elastic, in addition to that of the hose [N m2]
};

struct RodProperties {
  int segments = 50;                         ///< n >= 2
  double length = 0;                         ///< unstretched, clamp to clamp [m]
  double mass_per_length = 0;                ///< [kg/m]
  double diameter = 0;                       ///< outer [m]
  double bending_stiffness = 0;              ///< EI, without friction; with a loss factor: at 1 Hz [N m2]
  double torsional_stiffness = 0;            ///< GJ [N m2]
  double axial_stiffness = 0;                ///< EA [N]
  double damping_time = 0;                   ///< Kelvin-Voigt tau of twist, and of bending without a loss factor [s]
  std::vector<FrictionElement> friction{};   ///< of bending, in addition to EI; at most BendMemory::frictions (S20)
  double loss_factor = 0;                    ///< of EI, at most most_loss_factor (S21)
  Vector3 gravity{0, 0, -9.81};              ///< [m/s2]
  Vector3 rest_curvature = Vector3::Zero();  ///< unloaded kappa1, kappa2, twist in the segment's frame [rad/m]
  End base_end = End::clamped;
  End tool_end = End::clamped;
  double tip_mass = 0;                   ///< point mass at the tip of a free tool end [kg]
  std::optional<SlidingClamp> slider{};  ///< of the base end
  std::array<StiffEnd, 2> stiff_ends{};  ///< at the base and at the tool end

  bool is_hysteretic() const { return !friction.empty() || loss_factor > 0; }
};

/// A span of a Rod and its position among the others.
struct Span {
  RodProperties properties;
  int first_segment = 0, first_link = 0;
  int dresspack = 0;     ///< all spans of one dresspack are adjacent
  double first_arc = 0;  ///< arc of its base end, from the dresspack's base clamp [m]
  double segment_length = 0, segment_mass = 0;
  double axial_inertia = 0, transverse_inertia = 0;  ///< about the tangent; about d1 or d2 [kg m2]

  int segments() const { return properties.segments; }
  int last_link() const { return first_link + properties.segments; }
  double arc(int segment) const { return first_arc + (segment - first_segment + 0.5) * segment_length; }
};

/// The ends of all spans at one time: end 2k is the base end of span k, 2k + 1 its tool end. The tool frame is not used while
/// the tool end is free.
struct ClampFrames {
  Frame base, tool;              ///< the first and the last end
  std::vector<Frame> between{};  ///< all other ends; empty for one span

  const Frame& end(int e) const {
    return e == 0 ? base : e <= static_cast<int>(between.size()) ? between[e - 1] : tool;
  }
  Frame& end(int e) { return const_cast<Frame&>(std::as_const(*this).end(e)); }
  int ends() const { return 2 + static_cast<int>(between.size()); }
};

/// Force [N] and torque about the segment's centre [N m], world axes.
struct Load {
  Vector3 force = Vector3::Zero();
  Vector3 torque = Vector3::Zero();
};

/// Travel of a sliding base clamp.
struct Travel {
  enum class Mode { sliding, held, at_home, at_end };
  double way = 0;             ///< at the time of the positions [m]
  double speed = 0;           ///< at the time of the velocities [m/s]
  Mode mode = Mode::sliding;  ///< during the last step; held: by friction
  int sense = 0;              ///< direction of the sliding that friction opposes: -1, 1; 0: no friction
};

/// The state of the chain. Velocities belong to half a step before the time of the positions (leapfrog).
struct RodState {
  std::vector<Vector3> position;                                                   ///< (segment) centres [m]
  std::vector<Quaternion> orientation;                                             ///< (segment)
  std::vector<Vector3> velocity;                                                   ///< (segment) [m/s]
  std::vector<Vector3> angular_velocity;                                           ///< (segment) world axes [rad/s]
  ClampFrames clamps;                                                              ///< at the time of the positions
  std::vector<Vector3> clamp_velocity = std::vector<Vector3>(2, Vector3::Zero());  ///< (end) [m/s]
  std::vector<Vector3> clamp_angular_velocity = std::vector<Vector3>(2, Vector3::Zero());  ///< (end) [rad/s]
  std::vector<Travel> travel;       ///< (span) of sliding base clamps; 0 for others
  std::vector<Vector3> link_force;  ///< (link) force of link j on segment j - 1 during the last step, (S9) [N]
  std::vector<BendMemory> memory;   ///< (link) of hysteretic bending; empty: no element is stretched
};

/// The deformation of a link, in its mid-frame.
struct LinkState {
  Vector3 gap;     ///< world axes [m]
  Vector3 turn;    ///< rotation vector phi [rad]
  Vector3 moment;  ///< elastic part, about d1, d2, d3 [N m]
};

struct Energy {
  double kinetic = 0, elastic = 0, gravitational = 0;  ///< [J]; gravitational: 0 at the origin of the world
  double total() const { return kinetic + elastic + gravitational; }
};

class Rod {
 public:
  /// One span. Preconditions: segments >= 2; length, mass, diameter and stiffnesses > 0.
  explicit Rod(const RodProperties& properties);
  /// Several spans, in this order. first_of_dresspack: spans with which a further dresspack begins.
  explicit Rod(const std::vector<RodProperties>& spans, const std::vector<int>& first_of_dresspack = {});

  const std::vector<Span>& spans() const { return spans_; }
  int dresspacks() const { return spans_.back().dresspack + 1; }
  /// Returns the first span of a dresspack; for `dresspacks()` the number of spans.
  int first_span(int dresspack) const;
  const Span& span_of(int segment) const { return spans_[span_of_segment_[segment]]; }
  const Span& span_of_link(int link) const { return spans_[span_of_link_[link]]; }
  int segments() const { return static_cast<int>(span_of_segment_.size()); }
  int links() const { return static_cast<int>(span_of_link_.size()); }
  // Properties of the first span:
  const RodProperties& properties() const { return spans_.front().properties; }
  double segment_length() const { return spans_.front().segment_length; }
  double segment_mass() const { return spans_.front().segment_mass; }
  double axial_inertia() const { return spans_.front().axial_inertia; }
  double transverse_inertia() const { return spans_.front().transverse_inertia; }

  double gap_stiffness(int link) const { return gap_stiffness_[link]; }            ///< [N/m], 0: not connected
  const Vector3& turn_stiffness(int link) const { return turn_stiffness_[link]; }  ///< [N m/rad]
  const Vector3& rest_turn(int link) const { return rest_turn_[link]; }            ///< [rad]
  double bending_length(int link) const { return bending_length_[link]; }          ///< compliance length (S5) [m]
  /// Returns the curvature of a link with this turn (LinkState::turn), from both transverse axes [1/m].
  double curvature(const Vector3& turn, int link) const { return turn.head<2>().norm() / bending_length_[link]; }
  bool is_hysteretic() const { return hysteretic_; }  ///< true for any hysteretic span
  double link_arc(int link) const;                    ///< from the dresspack's base clamp [m]

  /// Returns a straight, unloaded chain at rest from the base frame along its tangent, with all clamps at its ends.
  RodState straight(const Frame& base) const;
  LinkState link_state(const RodState& state, int link) const;
  Vector3 turn(const RodState& state, int link) const;  ///< LinkState::turn only
  Energy energy(const RodState& state) const;
  /// Returns the energy of stretch, bending, twist and gravity, from positions only (S11) [J]. An equilibrium minimises it.
  double potential_energy(const RodState& state) const;
  /// Returns the mean stretch of a span along the tangents [m/m]; > 0: longer than the free length.
  double mean_elongation(const RodState& state, const Span& span) const;
  /// Returns the span with the largest mean stretch. mean_elongation(state) is this stretch.
  const Span& most_stretched(const RodState& state) const;
  double mean_elongation(const RodState& state) const { return mean_elongation(state, most_stretched(state)); }
  /// Returns the tension along the tangent in each link, from RodState::link_force [N].
  std::vector<double> tensions(const RodState& state) const;
  /// Returns the end of the last segment: the tip of a free end [m].
  Vector3 tip(const RodState& state) const { return tip_frame(state, spans_.back()).position; }
  Frame tip_frame(const RodState& state, const Span& span) const;
  /// Returns the clamps, with every sliding one at travel 0.
  ClampFrames home(const RodState& state) const;
  bool finite(const RodState& state) const;

 private:
  void add(const RodProperties& properties, bool new_dresspack);
  void add_ends(const RodState& state, int k, Energy& energy) const;
  double stored_in_elements(const RodState& state) const;

  std::vector<Span> spans_;
  std::vector<int> span_of_segment_, span_of_link_;
  std::vector<double> gap_stiffness_, bending_length_;
  std::vector<Vector3> turn_stiffness_, rest_turn_;
  bool hysteretic_ = false;
};

/// Returns the length of the straight path from the base end of span k through the points to its tool end [m]. A sliding base
/// clamp is pulled out to the travel with the shortest path.
double shortest_way(const Rod& rod, const ClampFrames& clamps, int k, std::span<const Vector3> through = {});

/// Returns the excess of the distance between the ends of span k over its free length [m]; 0: no excess.
/// The caller stops when this is > 0 or Rod::mean_elongation exceeds longest_elongation.
double missing_length(const Rod& rod, const ClampFrames& clamps, int k = 0);

/// A hose with a larger mean stretch is taut: the motion needs more length. (A corrugated hose is far softer than its cables,
/// which reach 2 % only when they break or slip out of the clamps.)
inline constexpr double longest_elongation = 0.02;

struct RodSystem;  // matrix and right-hand side of one step: rod.cpp

/// Velocity change of one segment: linear [m/s], angular [rad/s].
struct Twist6 {
  double value[6];
  Vector3 linear() const { return {value[0], value[1], value[2]}; }
  Vector3 angular() const { return {value[3], value[4], value[5]}; }
};

/// Several twists side by side, (row, twist): independent operations use the processor's latency.
struct Twists {
  static constexpr int count = 4;
  using Row = double __attribute__((vector_size(count * sizeof(double))));
  Row value[6];
};

/// One step of (S3): a 6x6 block tridiagonal system, factored once, O(n). Blocks of different spans are not coupled.
class RodSolver {
 public:
  explicit RodSolver(const Rod& rod);
  ~RodSolver();
  RodSolver(const RodSolver&) = delete;
  RodSolver& operator=(const RodSolver&) = delete;

  /// Computes the velocity changes over the step h [s] while the clamps move from state.clamps to `end` (for sliding clamps:
  /// their positions at travel 0). loads: none or one per segment. Returns false if the matrix is not positive definite (the
  /// state is not finite).
  bool solve(const RodState& state, const ClampFrames& end, double h, std::span<const Load> loads = {});
  std::span<const Twist6> velocity_change() const;

  /// Replaces x by A^-1 x, in blocks >= first only. A is the matrix of the last solve(). x: impulses, 0 in the blocks before
  /// `foremost`.
  void respond(int foremost, int first, std::span<Twists> x) const;
  /// Adds the response A^-1 p to generalised impulses p [N s, N m s] to the velocity changes. Overwrites p.
  void apply_impulses(std::span<Twist6> impulses);

  /// Updates the state of the step apart from the segments: link forces (S9), clamps and their velocities.
  /// The caller moves the segments by v += dv, x += h v, before or after this call.
  void finish(RodState& state);

 private:
  void prepare_hysteresis(double h);
  int solve_span(const RodState& state, int k, std::span<const Load> loads);
  int solve_sliding(const RodState& state, int k, std::span<const Load> loads);
  double travel_change(int k) const;
  bool choose_mode(const RodState& state, int k);

  const Rod& rod_;
  std::unique_ptr<RodSystem> system_;
};

}  // namespace dresslife::sim
