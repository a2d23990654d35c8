// The chain: rigid segments tied by elastic links, in one or more spans between clamps, and one step of its
// motion.
//
// Rod is built once and never changes; RodState is what advances; RodSolver holds the factorised step matrix.
// Segment i = 0..n-1 of a span has its centre at s = (i + 1/2) l, link j = 0..n sits at s = j l; links 0 and
// n tie the end segments to the clamps. Body z of a segment and of a clamp frame is the tangent, from base to
// tool. A clamp between two spans is the tool end of one and the base end of the next: each span moves as a
// dresspack of its own, and only contacts join them. Segments, links and ends count through: span 0 first.
//
// (S1) gap     g = (x_b - c a t_b) - (x_a + c a t_a),  a = l/2;   force f = EA/len g       [N]
// (S17)        c = 1 + (1 - t_a.t_b)/12 between two segments, 1 at a clamp
// (S2) turn    phi = log(R_a^T R_b);   energy  1/2 (phi - phi_0)^T diag(EI, EI, GJ)/len (phi - phi_0)  [J]
// (S3) step    (M + theta h C + beta h^2 K) dv = h (f(x_n) - C v_n),   v += dv,  x += h v
// Second order in h and l. sim/rod/theory.md derives the end links' lengths, the weights and the tension.
// Assumptions: round hose with equal bending stiffness both ways, stretch and shear equally stiff, small
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

/// How an end of the hose is held. A pinned end turns freely, a free end (tool side only) also moves freely.
/// A swivel holds position and direction but turns freely about its tangent.
enum class End { clamped, pinned, swivel, free };

/// A base clamp that slides along its direction and is pulled back: spring-returned slack (S14).
struct SlidingClamp {
  double force = 0;     ///< against its direction, at travel 0 [N]
  double spring = 0;    ///< more per travel [N/m]
  double stroke = 0;    ///< travel goes from 0 to this, where it meets stops [m]
  double damping = 0;   ///< [N s/m]
  double friction = 0;  ///< Coulomb [N]
  double mass = 1;      ///< of the clamp [kg]
};

/// Makes the hose stiffer beside an end (S24).
struct StiffEnd {
  double length = 0;             ///< from the end [m]
  double bending_stiffness = 0;  ///< elastic, beside the hose's own [N m2]
};

struct RodProperties {
  int segments = 50;               ///< n >= 2
  double length = 0;               ///< unstretched, clamp to clamp [m]
  double mass_per_length = 0;      ///< [kg/m]
  double diameter = 0;             ///< outer [m]
  double bending_stiffness = 0;    ///< EI, without friction; with a loss factor at 1 Hz [N m2]
  double torsional_stiffness = 0;  ///< GJ [N m2]
  double axial_stiffness = 0;      ///< EA [N]
  double damping_time = 0;         ///< Kelvin-Voigt tau of twist and, without a loss factor, of bending [s]
  std::vector<FrictionElement> friction{};  ///< of bending, beside EI; at most BendMemory::frictions (S20)
  double loss_factor = 0;                   ///< of EI, up to most_loss_factor (S21)
  Vector3 gravity{0, 0, -9.81};    ///< [m/s2]
  Vector3 rest_curvature =
      Vector3::Zero();  ///< unloaded kappa1, kappa2, twist in the segment's frame [rad/m]
  End base_end = End::clamped;
  End tool_end = End::clamped;
  double tip_mass = 0;             ///< a point at the tip of a free tool end [kg]
  std::optional<SlidingClamp> slider{};  ///< of the base end
  std::array<StiffEnd, 2> stiff_ends{};  ///< at the base and at the tool end

  bool is_hysteretic() const { return !friction.empty() || loss_factor > 0; }
};

/// A span of a Rod and where it lies among the others.
struct Span {
  RodProperties properties;
  int first_segment = 0, first_link = 0;
  int dresspack = 0;     ///< spans of one dresspack follow each other, and only they do
  double first_arc = 0;  ///< of its base end, from the dresspack's base clamp [m]
  double segment_length = 0, segment_mass = 0;
  double axial_inertia = 0, transverse_inertia = 0;  ///< about the tangent; about d1 or d2 [kg m2]

  int segments() const { return properties.segments; }
  int last_link() const { return first_link + properties.segments; }
  double arc(int segment) const { return first_arc + (segment - first_segment + 0.5) * segment_length; }
};

/// The ends of all spans at one time: end 2k is the base end of span k, 2k + 1 its tool end. The tool frame
/// is not used while the tool end is free.
struct ClampFrames {
  Frame base, tool;              ///< the first and the last
  std::vector<Frame> between{};  ///< all others; empty for one span

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

/// How far a sliding base clamp is pulled out.
struct Travel {
  enum class Mode { sliding, held, at_home, at_end };
  double way = 0;             ///< at the positions' time [m]
  double speed = 0;           ///< at the velocities' time [m/s]
  Mode mode = Mode::sliding;  ///< over the last step; held: by friction
  int sense = 0;              ///< of the sliding against which friction acts: -1, 0 (no friction), 1
};

/// Everything that advances. Velocities belong to half a step before the positions' time (leapfrog).
struct RodState {
  std::vector<Vector3> position;          ///< (segment) centres [m]
  std::vector<Quaternion> orientation;    ///< (segment)
  std::vector<Vector3> velocity;          ///< (segment) [m/s]
  std::vector<Vector3> angular_velocity;  ///< (segment) world axes [rad/s]
  ClampFrames clamps;                     ///< at the positions' time
  std::vector<Vector3> clamp_velocity = std::vector<Vector3>(2, Vector3::Zero());          ///< (end) [m/s]
  std::vector<Vector3> clamp_angular_velocity = std::vector<Vector3>(2, Vector3::Zero());  ///< (end) [rad/s]
  std::vector<Travel> travel;       ///< (span) of sliding base clamps; others stay 0
  std::vector<Vector3> link_force;  ///< (link) pull of link j on segment j - 1 over the last step, (S9) [N]
  std::vector<BendMemory> memory;   ///< (link) of hysteretic bending; empty: no element is stretched
};

/// The deformation of a link, in its mid-frame.
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
  /// One span. Precondition: segments >= 2; length, mass, diameter and stiffnesses > 0.
  explicit Rod(const RodProperties& properties);
  /// Several, in this order. first_of_dresspack: spans at which a further dresspack begins.
  explicit Rod(const std::vector<RodProperties>& spans, const std::vector<int>& first_of_dresspack = {});

  const std::vector<Span>& spans() const { return spans_; }
  int dresspacks() const { return spans_.back().dresspack + 1; }
  /// Its first span; that of `dresspacks()` is the number of spans.
  int first_span(int dresspack) const;
  const Span& span_of(int segment) const { return spans_[span_of_segment_[segment]]; }
  const Span& span_of_link(int link) const { return spans_[span_of_link_[link]]; }
  int segments() const { return static_cast<int>(span_of_segment_.size()); }
  int links() const { return static_cast<int>(span_of_link_.size()); }
  // Of the first span:
  const RodProperties& properties() const { return spans_.front().properties; }
  double segment_length() const { return spans_.front().segment_length; }
  double segment_mass() const { return spans_.front().segment_mass; }
  double axial_inertia() const { return spans_.front().axial_inertia; }
  double transverse_inertia() const { return spans_.front().transverse_inertia; }

  double gap_stiffness(int link) const { return gap_stiffness_[link]; }            ///< [N/m], 0: not tied
  const Vector3& turn_stiffness(int link) const { return turn_stiffness_[link]; }  ///< [N m/rad]
  const Vector3& rest_turn(int link) const { return rest_turn_[link]; }            ///< [rad]
  double bending_length(int link) const { return bending_length_[link]; }  ///< compliance length (S5) [m]
  /// Of a link that turns so (LinkState::turn), about both of its transverse axes [1/m].
  double curvature(const Vector3& turn, int link) const {
    return turn.head<2>().norm() / bending_length_[link];
  }
  bool is_hysteretic() const { return hysteretic_; }  ///< any span
  double link_arc(int link) const;  ///< from the dresspack's base clamp [m]

  /// A straight, unloaded chain at rest from the base frame along its tangent; all clamps in place.
  RodState straight(const Frame& base) const;
  LinkState link_state(const RodState& state, int link) const;
  Vector3 turn(const RodState& state, int link) const;  ///< LinkState::turn alone
  Energy energy(const RodState& state) const;
  /// Of stretch, bending, twist and gravity, from positions alone (S11): what an equilibrium minimises [J].
  double potential_energy(const RodState& state) const;
  /// Mean over a span of the stretch along the tangents [m/m]; > 0: pulled longer than the free length.
  double mean_elongation(const RodState& state, const Span& span) const;
  /// The span that is stretched most, and how much.
  const Span& most_stretched(const RodState& state) const;
  double mean_elongation(const RodState& state) const {
    return mean_elongation(state, most_stretched(state));
  }
  /// Pull along the tangent in each link, from RodState::link_force [N].
  std::vector<double> tensions(const RodState& state) const;
  /// End of the last segment: the tip of a free end [m].
  Vector3 tip(const RodState& state) const { return tip_frame(state, spans_.back()).position; }
  Frame tip_frame(const RodState& state, const Span& span) const;
  /// The clamps with every sliding one where it is at travel 0.
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

/// Length of the straight way from the base end of span k through the points to its tool end [m]. A sliding base
/// clamp is pulled out as far as that shortens the way.
double shortest_way(const Rod& rod, const ClampFrames& clamps, int k, std::span<const Vector3> through = {});

/// By how much the distance between the ends of span k exceeds its free length [m]; 0 when it does not.
/// The caller stops when this is > 0 or Rod::mean_elongation exceeds longest_elongation.
double missing_length(const Rod& rod, const ClampFrames& clamps, int k = 0);

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

/// Several of them side by side, which hides what each operation waits for the one before: (row, which).
struct Twists {
  static constexpr int count = 4;
  using Row = double __attribute__((vector_size(count * sizeof(double))));
  Row value[6];
};

/// One step of (S3): a 6x6 block tridiagonal system, factored once, O(n). Between spans its blocks are not
/// coupled.
class RodSolver {
 public:
  explicit RodSolver(const Rod& rod);
  ~RodSolver();
  RodSolver(const RodSolver&) = delete;
  RodSolver& operator=(const RodSolver&) = delete;

  /// Velocity changes over the step h [s] while the clamps go from state.clamps to `end` (sliding ones: their
  /// places at travel 0); loads: none or one per segment. Returns false when the matrix is not positive
  /// definite (a state that is not finite).
  bool solve(const RodState& state, const ClampFrames& end, double h, std::span<const Load> loads = {});
  std::span<const Twist6> velocity_change() const;

  /// x: impulses, 0 in the blocks before `foremost`. Overwritten by A^-1 x, in blocks >= first only; A is the matrix of the
  /// last solve().
  void respond(int foremost, int first, std::span<Twists> x) const;
  /// Adds the answer A^-1 p to generalised impulses p to the velocity changes; p is overwritten. [N s, N m s]
  void apply_impulses(std::span<Twist6> impulses);

  /// Writes what belongs to the step but not to the segments: link forces (S9), clamps and their velocities.
  /// The caller has moved, or will move, the segments by v += dv, x += h v.
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
