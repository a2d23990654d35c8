#include "sim/rod.h"

#include <algorithm>
#include <cassert>

#include "sim/block_tridiagonal.h"
#include "sim/link.h"

namespace dresslife::sim {
namespace {

// Weights of (S3). For one oscillator of frequency w, beta >= 1/4 is stable for every h w; 0.3 damps its
// ringing.
constexpr double turn_beta = 0.3, turn_theta = 0.5;
// The gap's waves are far faster than the step and of no interest: C = gap_damping h K takes their energy,
// and beta grows by half of that (the damping is explicit, so stability asks beta >= 1/4 + gap_damping/2).
constexpr double gap_beta = 0.55, gap_damping = 0.5;
// Damping of bending below this many steps leaves the fastest bending waves ringing.
constexpr double least_damping_steps = 0.25;
// Geometric stiffness of a taut chain: its lateral waves run at sqrt(T/rho); leapfrog alone is stable while
// T < rho l^2/h^2, and the stiffness is added from 0.3 of that on.
constexpr double tension_beta = 0.3, free_tension = 0.3;
// Radius of gyration squared over radius squared: between a solid (0.5) and a thin tube (1).
constexpr double inertia_shape = 0.75;

// (S5) End links: the sum over links of energy * length is a quadrature of the integral of m^2/EI from clamp
// to clamp. Half lengths at the ends (trapezoid rule) err by l^2; Gregory's first correction -l/12 (m_1 -
// m_0) turns the weights 1/2, 1 into 5/12, 13/12. Where the moment vanishes (free end) the plain weights do.
double compliance_length(const RodProperties& p, int link, double l) {
  const int n = p.segments;
  if (link == 0 || link == n) return l * 5 / 12;
  if (link == 1 || (link == n - 1 && p.tool_end != End::free)) return l * (n == 2 ? 14.0 : 13.0) / 12;
  return l;
}

Vector3 end_mask(const RodProperties& p, int link) {
  const End end = link == 0 ? p.base_end : link == p.segments ? p.tool_end : End::clamped;
  switch (end) {
    case End::clamped:
      return {1, 1, 1};
    case End::swivel:
      return {1, 1, 0};
    default:
      return {0, 0, 0};
  }
}

}  // namespace

// ---- what is built once -----------------------------------------------------------------------------------

Rod::Rod(const RodProperties& p) : properties_(p) {
  assert(p.segments >= 2 && p.length > 0 && p.mass_per_length > 0 && p.diameter > 0);
  assert(p.bending_stiffness > 0 && p.torsional_stiffness > 0 && p.axial_stiffness > 0 &&
         p.damping_time >= 0);
  assert(p.base_end != End::free);
  const int n = p.segments;
  const double l = p.length / n, radius2 = p.diameter * p.diameter / 4;
  segment_length_ = l;
  segment_mass_ = p.mass_per_length * l;
  axial_inertia_ = segment_mass_ * inertia_shape * radius2;
  transverse_inertia_ = segment_mass_ * (l * l / 12 + inertia_shape * radius2 / 2);
  for (int j = 0; j <= n; ++j) {
    const bool end = j == 0 || j == n, tied = j < n || p.tool_end != End::free;
    const double length = compliance_length(p, j, l);
    const Vector3 stiffness{p.bending_stiffness, p.bending_stiffness, p.torsional_stiffness};
    bending_length_.push_back(length);
    gap_stiffness_.push_back(tied ? p.axial_stiffness / (end ? l / 2 : l) : 0);
    turn_stiffness_.push_back(end_mask(p, j).cwiseProduct(stiffness) / length);
    rest_turn_.push_back(p.rest_curvature * length);
  }
}

// ---- what the state says ----------------------------------------------------------------------------------

RodState Rod::straight(const Frame& base) const {
  RodState state;
  const Vector3 t = tangent(base.orientation);
  for (int i = 0; i < segments(); ++i) {
    state.position.push_back(base.position + t * (segment_length_ * (i + 0.5)));
    state.orientation.push_back(base.orientation);
  }
  state.velocity.assign(segments(), Vector3::Zero());
  state.angular_velocity.assign(segments(), Vector3::Zero());
  state.link_force.assign(links(), Vector3::Zero());
  state.clamps = {base, {base.position + t * properties_.length, base.orientation}};
  return state;
}

LinkState Rod::link_state(const RodState& state, int link) const {
  const LinkEnds ends = link_ends(*this, state, link);
  if (gap_stiffness_[link] == 0) return {Vector3::Zero(), Vector3::Zero(), Vector3::Zero()};
  const LinkTurn turn = link_turn(*ends.orientation_a, *ends.orientation_b);
  return {(*ends.position_b - ends.arm_b) - (*ends.position_a + ends.arm_a), turn.phi,
          turn_stiffness_[link].cwiseProduct(turn.phi - rest_turn_[link])};
}

double Rod::potential_energy(const RodState& state) const {
  double energy = 0;
  for (const Vector3& x : state.position) energy -= segment_mass_ * properties_.gravity.dot(x);
  for (int j = 0; j < links(); ++j) {
    const LinkState link = link_state(state, j);
    energy += 0.5 * (gap_stiffness_[j] * link.gap.squaredNorm() + link.moment.dot(link.turn - rest_turn_[j]));
  }
  return energy;
}

// Stretch from the link force that acted, f^2/(2 k): the gaps themselves carry what a turn within one step
// adds to them in second order, which the next step takes away and which is no stretch of the hose.
Energy Rod::energy(const RodState& state) const {
  Energy energy;
  for (int i = 0; i < segments(); ++i) {
    const Vector3& w = state.angular_velocity[i];
    const double axial = w.dot(tangent(state.orientation[i]));
    energy.kinetic +=
        0.5 * (segment_mass_ * state.velocity[i].squaredNorm() +
               transverse_inertia_ * (w.squaredNorm() - axial * axial) + axial_inertia_ * axial * axial);
    energy.gravitational -= segment_mass_ * properties_.gravity.dot(state.position[i]);
  }
  for (int j = 0; j < links(); ++j) {
    if (gap_stiffness_[j] == 0) continue;
    const LinkState link = link_state(state, j);
    energy.elastic += 0.5 * (state.link_force[j].squaredNorm() / gap_stiffness_[j] +
                             link.moment.dot(link.turn - rest_turn_[j]));
  }
  return energy;
}

double Rod::mean_elongation(const RodState& state) const {
  double stretch = 0;
  for (int j = 0; j < links(); ++j) {
    const LinkEnds ends = link_ends(*this, state, j);
    const Vector3 t = tangent(*ends.orientation_a) + tangent(*ends.orientation_b);
    stretch += link_state(state, j).gap.dot(t) / std::max(t.norm(), 1e-12);
  }
  return stretch / properties_.length;
}

std::vector<double> Rod::tensions(const RodState& state) const {
  std::vector<double> tension(links());
  for (int j = 0; j < links(); ++j) {
    const LinkEnds ends = link_ends(*this, state, j);
    const Vector3 t = tangent(*ends.orientation_a) + tangent(*ends.orientation_b);
    tension[j] = state.link_force[j].dot(t) / std::max(t.norm(), 1e-12);
  }
  return tension;
}

Vector3 Rod::tip(const RodState& state) const {
  return state.position.back() + tangent(state.orientation.back()) * (segment_length_ / 2);
}

bool Rod::finite(const RodState& state) const {
  // A sum is finite only if all of its terms are.
  double sum = 0;
  for (int i = 0; i < segments(); ++i)
    sum += state.position[i].sum() + state.velocity[i].sum() + state.angular_velocity[i].sum() +
           state.orientation[i].coeffs().sum();
  return std::isfinite(sum);
}

double missing_length(const Rod& rod, const ClampFrames& clamps) {
  if (rod.properties().tool_end == End::free) return 0;
  return std::max(0.0, (clamps.tool.position - clamps.base.position).norm() - rod.properties().length);
}

// ---- one step ---------------------------------------------------------------------------------------------

struct RodSystem {
  std::vector<TridiagonalBlock> block;
  std::vector<Twist6> change;                         ///< (segment) dv
  std::vector<Vector3> arm;                           ///< (segment) l/2 along its tangent
  std::vector<Vector3> force;                         ///< (link) explicit part of the gap's force
  ClampFrames end;                                    ///< clamps at the end of the step
  std::array<Vector3, 2> velocity, angular_velocity;  ///< of the clamps over the step
  double step = 0;
};

namespace {

// A vector's three numbers added to a block's right-hand side.
inline void add(double* value, const Vector3& x) {
  for (int k = 0; k < 3; ++k) value[k] += x[k];
}

// Adds skew(x) to the 3x3 part of a row-major 6x6 that begins at m.
inline void add_skew(double* m, const Vector3& x) {
  m[1] -= x[2], m[2] += x[1];
  m[6] += x[2], m[8] -= x[0];
  m[12] -= x[1], m[13] += x[0];
}

// Adds c (x y^T) to a 3x3 part.
inline void add_outer(double* m, double c, const Vector3& x, const Vector3& y) {
  for (int r = 0; r < 3; ++r)
    for (int k = 0; k < 3; ++k) m[6 * r + k] += c * x[r] * y[k];
}

inline void add_diagonal(double* m, double c) { m[0] += c, m[7] += c, m[14] += c; }

/// One step's assembly. Written as a class so that each part sees the same names.
class Assembly {
 public:
  Assembly(const Rod& rod, const RodState& state, RodSystem& system, double h)
      : rod_(rod), state_(state), system_(system), h_(h), p_(rod.properties()) {
    damping_ = std::max(p_.damping_time, least_damping_steps * h);
    const double l = rod.segment_length();
    free_force_ = free_tension * p_.mass_per_length * l * l / (h * h);
  }

  // Inertia, gravity, the gyroscopic torque -w x (I w), external load.
  void begin_segment(int i, std::span<const Load> loads) {
    TridiagonalBlock& b = system_.block[i];
    const Vector3 t = tangent(state_.orientation[i]);
    const double m = rod_.segment_mass(), transverse = rod_.transverse_inertia();
    const double excess = rod_.axial_inertia() - transverse;
    system_.arm[i] = (rod_.segment_length() / 2) * t;
    std::fill(b.diagonal, b.diagonal + 36, 0.0);
    add_diagonal(b.diagonal, m);
    add_diagonal(b.diagonal + 21, transverse);
    add_outer(b.diagonal + 21, excess, t, t);
    const Vector3& w = state_.angular_velocity[i];
    Vector3 force = m * p_.gravity, torque = -(excess * t.dot(w)) * w.cross(t);
    if (!loads.empty()) force += loads[i].force, torque += loads[i].torque;
    for (int k = 0; k < 3; ++k) b.value[k] = h_ * force[k], b.value[3 + k] = h_ * torque[k];
  }

  void add_link(int j) {
    if (rod_.gap_stiffness(j) == 0) {
      system_.force[j].setZero();
      return;
    }
    const int n = rod_.segments();
    const bool has_a = j > 0, has_b = j < n;
    const Side a = has_a ? segment_side(j - 1) : clamp_side(state_.clamps.base, 0);
    const Side b = has_b ? segment_side(j) : clamp_side(state_.clamps.tool, 1);
    const LinkTurn turn = link_turn(*a.orientation, *b.orientation);
    const Vector3 moment = turn_moment(j, turn, *b.angular_velocity - *a.angular_velocity);
    const Vector3 force = gap_force(j, a, b);
    const TurnMatrix turning = turn_matrix(j, turn);
    const double k = rod_.gap_stiffness(j) * gap_beta * h_ * h_;
    const double taut_a = tautness(j, a.arm), taut_b = tautness(j, b.arm);
    if (has_a) add_own(j - 1, k, a.arm, 1, force, moment, turning, taut_a);
    if (has_b) add_own(j, k, b.arm, -1, force, moment, turning, taut_b);
    if (has_a && has_b) couple(j - 1, k, a.arm, b.arm, turning);
    if (!has_a) drive(0, k, b.arm, -1, turning);
    if (!has_b) drive(1, k, a.arm, 1, turning);
  }

 private:
  struct Side {
    const Vector3 *position, *velocity, *angular_velocity;
    const Quaternion* orientation;
    Vector3 arm;
  };
  Side segment_side(int i) const {
    return {&state_.position[i], &state_.velocity[i], &state_.angular_velocity[i], &state_.orientation[i],
            system_.arm[i]};
  }
  Side clamp_side(const Frame& frame, int which) const {
    return {&frame.position, &state_.clamp_velocity[which], &state_.clamp_angular_velocity[which],
            &frame.orientation, Vector3::Zero()};
  }

  // (S6) f = k (g + c h dg/dt), the pull on the segment before.
  Vector3 gap_force(int j, const Side& a, const Side& b) {
    const Vector3 gap = (*b.position - b.arm) - (*a.position + a.arm);
    const Vector3 rate =
        (*b.velocity - b.angular_velocity->cross(b.arm)) - (*a.velocity + a.angular_velocity->cross(a.arm));
    const Vector3 force = rod_.gap_stiffness(j) * (gap + (gap_damping * h_) * rate);
    system_.force[j] = force;
    return force;
  }

  // (S7) m = G K (phi - phi_0 + tau dphi/dt), the moment on the segment before.
  Vector3 turn_moment(int j, const LinkTurn& turn, const Vector3& rate) const {
    const Vector3 strain = turn.phi - rod_.rest_turn(j) + damping_ * (turn.map.transpose() * rate);
    return turn.map * rod_.turn_stiffness(j).cwiseProduct(strain);
  }

  // G diag(k) G^T (beta h^2 + theta h tau) with k1 = k2: G G^T = s^2 1 + (1 - s^2) u u^T, so
  // k1 (s^2 1 + (1 - s^2) u u^T) + (k3 - k1) g3 g3^T.
  struct TurnMatrix {
    double value[9];
  };
  TurnMatrix turn_matrix(int j, const LinkTurn& turn) const {
    const double weight = turn_beta * h_ * h_ + turn_theta * h_ * damping_;
    const Vector3& stiffness = rod_.turn_stiffness(j);
    const double k1 = weight * stiffness[0], k3 = weight * stiffness[2];
    const Vector3 g3 = turn.map.col(2);
    const double axis = k1 * turn.axis_excess, third = k3 - k1, sphere = k1 * turn.stretch * turn.stretch;
    TurnMatrix m;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        m.value[3 * r + c] =
            axis * turn.axis[r] * turn.axis[c] + third * g3[r] * g3[c] + (r == c ? sphere : 0);
    return m;
  }

  // (S8) Tension-only geometric stiffness a T (1 - t t^T) on the turning of a segment; arm = a t.
  double tautness(int j, const Vector3& arm) const {
    const double a = rod_.segment_length() / 2;
    const double excess = state_.link_force[j].dot(arm) - free_force_ * a;
    return excess > 0 ? tension_beta * h_ * h_ * excess : 0;
  }

  // A link's part in its segment's own block. side +1: the link follows the segment, -1: precedes it. The end
  // moves with v + side w x arm, hence rows (k 1, -side k S), (.., -k S S) with S = skew(arm).
  void add_own(int i, double k, const Vector3& arm, double side, const Vector3& force, const Vector3& moment,
               const TurnMatrix& turning, double taut) {
    TridiagonalBlock& b = system_.block[i];
    const double a2 = rod_.segment_length() * rod_.segment_length() / 4;
    add_diagonal(b.diagonal, k);
    add_skew(b.diagonal + 3, (-side * k) * arm);
    double* m = b.diagonal + 21;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) m[6 * r + c] += turning.value[3 * r + c];
    add_diagonal(m, k * a2 + taut);
    add_outer(m, -(k + taut / a2), arm, arm);
    add(b.value, (side * h_) * force);
    add(b.value + 3, h_ * (arm.cross(force) + side * moment));
  }

  // The coupling of segments i and i + 1: S_a S_b = b a^T - (a.b) 1.
  void couple(int i, double k, const Vector3& arm_a, const Vector3& arm_b, const TurnMatrix& turning) {
    double* u = system_.block[i].upper;
    std::fill(u, u + 36, 0.0);
    add_diagonal(u, -k);
    add_skew(u + 3, -k * arm_b);
    add_skew(u + 18, -k * arm_a);
    add_outer(u + 21, -k, arm_b, arm_a);
    add_diagonal(u + 21, k * arm_a.dot(arm_b));
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) u[21 + 6 * r + c] -= turning.value[3 * r + c];
  }

  // A clamp moves as prescribed: its velocity change goes to the right-hand side.
  void drive(int which, double k, const Vector3& arm, double side, const TurnMatrix& turning) {
    TridiagonalBlock& b = which == 0 ? system_.block.front() : system_.block.back();
    const Vector3 change = k * (system_.velocity[which] - state_.clamp_velocity[which]);
    const Vector3 spin = system_.angular_velocity[which] - state_.clamp_angular_velocity[which];
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> m(turning.value);
    add(b.value, change);
    add(b.value + 3, side * arm.cross(change) + m * spin);
  }

  const Rod& rod_;
  const RodState& state_;
  RodSystem& system_;
  double h_, damping_, free_force_;
  const RodProperties& p_;
};

}  // namespace

RodSolver::RodSolver(const Rod& rod) : rod_(rod), system_(std::make_unique<RodSystem>()) {
  system_->block.resize(rod.segments());
  system_->change.resize(rod.segments());
  system_->arm.resize(rod.segments());
  system_->force.resize(rod.links());
}

RodSolver::~RodSolver() = default;

std::span<const Twist6> RodSolver::velocity_change() const { return system_->change; }

bool RodSolver::solve(const RodState& state, const ClampFrames& end, double h, std::span<const Load> loads) {
  RodSystem& s = *system_;
  const Frame* before[2] = {&state.clamps.base, &state.clamps.tool};
  const Frame* after[2] = {&end.base, &end.tool};
  for (int k = 0; k < 2; ++k) {
    s.velocity[k] = (after[k]->position - before[k]->position) / h;
    s.angular_velocity[k] = rotation_vector(after[k]->orientation * before[k]->orientation.conjugate()) / h;
  }
  s.end = end;
  s.step = h;
  Assembly assembly(rod_, state, s, h);
  const int n = rod_.segments();
  int not_positive = 0;
  assembly.begin_segment(0, loads);
  assembly.add_link(0);
  for (int i = 0; i < n; ++i) {
    if (i + 1 < n) assembly.begin_segment(i + 1, loads);
    assembly.add_link(i + 1);
    not_positive += eliminate(s.block[i], i + 1 < n ? &s.block[i + 1] : nullptr);
  }
  for (int i = n - 1; i >= 0; --i) {
    double* x = s.change[i].value;
    std::copy_n(s.block[i].value, 6, x);
    if (i + 1 < n) carry_up(s.block[i].diagonal, s.block[i].upper, s.change[i + 1].value, x);
    solve_lower_transposed(s.block[i].diagonal, x);
  }
  return not_positive == 0;
}

void RodSolver::unit_response(int segment, const Twist6& e, int other, const Twist6& e_other, int first,
                              std::span<Twist6> x) const {
  const auto& block = system_->block;
  const int n = rod_.segments(), foremost = other < 0 ? segment : std::min(segment, other);
  for (int i = first; i < n; ++i) std::fill_n(x[i].value, 6, 0.0);
  x[segment] = e;
  if (other >= 0) x[other] = e_other;
  for (int i = foremost; i < n; ++i) {
    double* value = x[i].value;
    solve_lower(block[i].diagonal, value);
    scale_by_pivots(block[i].diagonal, value);
    if (i + 1 < n) carry_down(block[i].upper, value, x[i + 1].value);
  }
  for (int i = n - 1; i >= first; --i) {
    if (i + 1 < n) carry_up(block[i].diagonal, block[i].upper, x[i + 1].value, x[i].value);
    solve_lower_transposed(block[i].diagonal, x[i].value);
  }
}

void RodSolver::apply_impulses(std::span<Twist6> impulses) {
  const auto& block = system_->block;
  const int n = rod_.segments();
  for (int i = 0; i < n; ++i) {
    double* value = impulses[i].value;
    solve_lower(block[i].diagonal, value);
    scale_by_pivots(block[i].diagonal, value);
    if (i + 1 < n) carry_down(block[i].upper, value, impulses[i + 1].value);
  }
  for (int i = n - 1; i >= 0; --i) {
    double* value = impulses[i].value;
    if (i + 1 < n) carry_up(block[i].diagonal, block[i].upper, impulses[i + 1].value, value);
    solve_lower_transposed(block[i].diagonal, value);
    for (int k = 0; k < 6; ++k) system_->change[i].value[k] += value[k];
  }
}

// (S9) lambda = f + beta h^2 K B dv / h: the force that acted over the step. k g alone rings by O(h^2).
void RodSolver::finish(RodState& state) const {
  const RodSystem& s = *system_;
  const int n = rod_.segments();
  for (int j = 0; j <= n; ++j) {
    const Vector3 after = j < n ? Vector3(s.change[j].linear() - s.change[j].angular().cross(s.arm[j]))
                                : Vector3(s.velocity[1] - state.clamp_velocity[1]);
    const Vector3 before =
        j > 0 ? Vector3(s.change[j - 1].linear() + s.change[j - 1].angular().cross(s.arm[j - 1]))
              : Vector3(s.velocity[0] - state.clamp_velocity[0]);
    state.link_force[j] = s.force[j] + (rod_.gap_stiffness(j) * gap_beta * s.step) * (after - before);
  }
  state.clamps = s.end;
  state.clamp_velocity = s.velocity;
  state.clamp_angular_velocity = s.angular_velocity;
}

bool advance_rod(const Rod& rod, RodSolver& solver, RodState& state, const ClampFrames& end, double h,
                 std::span<const Load> loads) {
  if (!solver.solve(state, end, h, loads)) return false;
  const std::span<const Twist6> change = solver.velocity_change();
  for (int i = 0; i < rod.segments(); ++i) {
    state.velocity[i] += change[i].linear();
    state.angular_velocity[i] += change[i].angular();
    state.position[i] += h * state.velocity[i];
    state.orientation[i] = (rotation(h * state.angular_velocity[i]) * state.orientation[i]).normalized();
  }
  solver.finish(state);
  return true;
}

}  // namespace dresslife::sim
