#include "sim/run/equilibrium.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "sim/rod/block_tridiagonal.h"
#include "sim/rod/link.h"
#include "sim/rod/start_curve.h"

namespace dresslife::sim {
namespace {

constexpr double largest_turn = 0.5;  // rotation of a segment in one iteration [rad]
constexpr double saddle_turn = 0.02;  // rotation of a chain at a saddle point [rad]
constexpr int most_saddles = 10;
constexpr double least_gain = 1e-4;      // a step must release at least this share of its expected work
constexpr double shift_factor = 4;       // factor by which the shift increases and decreases
constexpr double smallest_step = 1e-13;  // share of the length: rounding of positions
constexpr double settling_work =
    5;  // ESTIMATE: allowed work per step, in steps without contact; a search with more contacts ends earlier
constexpr double energy_rounding = 1e-12;  // share of the energies, summed over some hundred links

/// The tangent stiffness and the unbalanced forces of one state, and the Newton step from it.
class Statics {
 public:
  Statics(const Rod& rod, std::span<const Load> loads)
      : rod_(rod), loads_(loads), block_(rod.segments()), step_(rod.segments()), pull_(rod.links(), Vector3::Zero()) {}

  /// Computes the unbalanced force and torque of every segment; returns EquilibriumSettings::residual.
  double unbalance(const RodState& state);
  /// Solves (K + shift M) step = unbalanced. Returns the number of pivots of K + shift M that are not positive.
  int solve(const RodState& state, double shift);
  /// Returns the change of (S11) between two states; the second is the first one moved by `step` times `part`.
  double energy_change(const RodState& from, const RodState& to, double part) const;

  std::span<const Twist6> step() const { return step_; }
  /// Replaces the step by a small one that bends the chain in its weakest direction; deterministic.
  void bend_softly(const RodState& state, double shift);

  /// Returns the work of the unbalanced forces over the step: twice the energy that it is expected to release [J].
  double expected_work() const;
  /// Computes the link forces after the step, to first order, for the geometric stiffness.
  void predict_pull(const RodState& state, double part);
  void start_pull(const RodState& state);

 private:
  void add_link(const RodState& state, int j);

  const Rod& rod_;
  std::span<const Load> loads_;
  std::vector<TridiagonalBlock> block_;
  std::vector<Twist6> step_, unbalanced_;
  std::vector<Vector3> pull_;
};

void add_block(double* m, const Matrix3& x) {
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) m[6 * r + c] += x(r, c);
}

double Statics::unbalance(const RodState& state) {
  const int n = rod_.segments();
  unbalanced_.assign(n, Twist6{});
  const auto push = [&](int i, const Vector3& force, const Vector3& torque) {
    for (int k = 0; k < 3; ++k) unbalanced_[i].value[k] += force[k], unbalanced_[i].value[3 + k] += torque[k];
  };
  double scale = rod_.segment_mass() * rod_.properties().gravity.norm();
  for (int i = 0; i < n; ++i) {
    push(i, rod_.segment_mass() * rod_.properties().gravity, Vector3::Zero());
    if (!loads_.empty()) push(i, loads_[i].force, loads_[i].torque);
  }
  if (const double mass = rod_.properties().tip_mass; mass > 0) {
    const Vector3 arm = rod_.tip(state) - state.position.back(), weight = mass * rod_.properties().gravity;
    push(n - 1, weight, arm.cross(weight));
    scale = std::max(scale, weight.norm());
  }
  for (int j = 0; j <= n; ++j) {
    if (rod_.gap_stiffness(j) == 0) continue;
    const LinkEnds ends = link_ends(rod_, state, j);
    const LinkArms arms = ends.arms();
    const LinkState link = rod_.link_state(state, j);
    const Vector3 force = rod_.gap_stiffness(j) * link.gap;
    const Vector3 moment = link_turn(*ends.orientation_a, *ends.orientation_b).map * link.moment -
                           force.dot(arms.lengthening) * arms.normal;
    scale = std::max({scale, force.norm(), moment.norm() / rod_.properties().length});
    if (j > 0) push(j - 1, force, arms.a.cross(force) + moment);
    if (j < n) push(j, -force, arms.b.cross(force) - moment);
  }
  double largest = 0;
  for (const Twist6& u : unbalanced_)
    largest = std::max({largest, u.linear().norm(), u.angular().norm() / rod_.segment_length()});
  return largest / std::max(scale, 1e-12);
}

// Computes m . d2(phi)/d(delta)2 in the world, for log(e^(phi/2) e^delta e^(phi/2)) in the mid-frame. With u =
// phi/theta, p = delta . u, q = delta - p u, the second order is  c u q.q + s' p q. The first term follows from
// cos(theta'/2) = cos(theta/2) cos(q/2), c = cot(theta/2)/4 - s^2/(2 theta). The second follows because p only changes
// theta in s(theta) q.
Matrix3 turn_curvature(const LinkTurn& turn, const Vector3& moment) {
  const double theta = turn.phi.norm(), s = turn.stretch;
  if (theta < 1e-12) return Matrix3::Zero();
  const bool small = theta < 0.02;  // series: the next terms are below 1e-11
  const double cotangent = small ? 0 : 1 / std::tan(theta / 2);
  const double c = small ? -theta / 12 - theta * theta * theta / 360 : cotangent / 4 - s * s / (2 * theta);
  const double slope = small ? theta / 12 + 7 * theta * theta * theta / 1440 : s / theta * (1 - theta / 2 * cotangent);
  const Vector3 u = turn.phi / theta, world_u = turn.axis.normalized();
  const double along = moment.dot(u);
  const Vector3 across = turn.map * (moment - along * u) / s;  // G = R s across u
  return 2 * c * along * (Matrix3::Identity() - world_u * world_u.transpose()) +
         slope * (world_u * across.transpose() + across * world_u.transpose());
}

/// f . d2(gap) by the lengthening of the arms, for rotations of the segments before (a) and after (b) a link,
/// in addition to the part by the arms' own length. (S18)
struct LengtheningStiffness {
  Matrix3 aa, bb, ab;
};
LengtheningStiffness lengthening_stiffness(const LinkArms& arms, const Vector3& f) {
  const Vector3 t_a = arms.a.normalized(), t_b = arms.b.normalized(), &n = arms.normal;
  const Vector3 half = arms.lengthening * 12 / (1 + t_a.dot(t_b));  // (t_a + t_b) a/(1 + cosine)
  const double length = half.dot(t_a), pull = f.dot(arms.lengthening), cosine = t_a.dot(t_b);
  const Vector3 u_a = length / 12 * t_a.cross(f), u_b = length / 12 * t_b.cross(f);
  const Matrix3 turn = cosine * Matrix3::Identity();
  const Matrix3 own = 0.5 * (t_a * t_b.transpose() + t_b * t_a.transpose()) - turn;
  return {pull * own + n * u_a.transpose() + u_a * n.transpose(),
          pull * own - n * u_b.transpose() - u_b * n.transpose(),
          pull * (turn - t_b * t_a.transpose()) + n * u_b.transpose() - u_a * n.transpose()};
}

// (S12), derived in sim/rod/theory.md. With arms a, b, link force f, world moment m and rotations da, db of the
// segments: gap: k B^T B and (f.a) 1 - sym(f a^T) for the rotation of each segment; rotation: H = G K G^T + (sym(m
// phi^T) - (m.phi) 1)/6 for da - db, and the antisymmetric half of m in the coupling.
void Statics::add_link(const RodState& state, int j) {
  if (rod_.gap_stiffness(j) == 0) return;
  const LinkEnds ends = link_ends(rod_, state, j);
  const LinkTurn turn = link_turn(*ends.orientation_a, *ends.orientation_b);
  const Vector3& stiffness = rod_.turn_stiffness(j);
  const Vector3 local_moment = stiffness.cwiseProduct(turn.phi - rod_.rest_turn(j));
  const Vector3 moment = turn.map * local_moment, f = pull_[j];
  const LinkArms arms = ends.arms();
  const double k = rod_.gap_stiffness(j);
  const Matrix3 h = turn.map * stiffness.asDiagonal() * turn.map.transpose() + turn_curvature(turn, local_moment) +
                    k * arms.excess * arms.normal * arms.normal.transpose();
  const bool between = j > 0 && j < rod_.segments();
  const LengtheningStiffness lengthening =
      between ? lengthening_stiffness(arms, f)
              : LengtheningStiffness{Matrix3::Zero(), Matrix3::Zero(), Matrix3::Zero()};
  const Matrix3 along = k * arms.lengthening * arms.normal.transpose();
  const auto own = [&](int i, const Vector3& arm, double side, const Matrix3& second) {
    const Matrix3 s = skew(arm);
    double* d = block_[i].diagonal;
    add_block(d, k * Matrix3::Identity());
    add_block(d + 3, -side * k * s - along);
    add_block(d + 21, h + second - k * s * s + f.dot(arm) * Matrix3::Identity() -
                          0.5 * (f * arm.transpose() + arm * f.transpose()));
  };
  if (j > 0) own(j - 1, arms.a, 1, lengthening.aa);
  if (j < rod_.segments()) own(j, arms.b, -1, lengthening.bb);
  if (!between) return;
  const Matrix3 sa = skew(arms.a), sb = skew(arms.b);
  double* u = block_[j - 1].upper;
  std::fill(u, u + 36, 0.0);
  add_block(u, -k * Matrix3::Identity());
  add_block(u + 3, -k * sb + along);
  add_block(u + 18, -k * sa + along.transpose());
  add_block(u + 21, -k * sa * sb - h + lengthening.ab + 0.5 * skew(moment));
}

int Statics::solve(const RodState& state, double shift) {
  const int n = rod_.segments();
  for (int i = 0; i < n; ++i) {
    const Vector3 t = tangent(state.orientation[i]);
    const double transverse = rod_.transverse_inertia(), excess = rod_.axial_inertia() - transverse;
    std::fill(block_[i].diagonal, block_[i].diagonal + 36, 0.0);
    add_block(block_[i].diagonal, shift * rod_.segment_mass() * Matrix3::Identity());
    add_block(block_[i].diagonal + 21, shift * (transverse * Matrix3::Identity() + excess * t * t.transpose()));
    std::copy_n(unbalanced_[i].value, 6, block_[i].value);
  }
  for (int j = 0; j <= n; ++j) add_link(state, j);
  if (const double mass = rod_.properties().tip_mass; mass > 0) {  // its weight acts like a link force (S12)
    const Vector3 arm = rod_.tip(state) - state.position.back(), f = mass * rod_.properties().gravity;
    add_block(block_[n - 1].diagonal + 21,
              f.dot(arm) * Matrix3::Identity() - 0.5 * (f * arm.transpose() + arm * f.transpose()));
  }
  int not_positive = 0;
  for (int i = 0; i < n; ++i) not_positive += eliminate(block_[i], i + 1 < n ? &block_[i + 1] : nullptr);
  for (int i = n - 1; i >= 0; --i) {
    double* x = step_[i].value;
    std::copy_n(block_[i].value, 6, x);
    if (i + 1 < n) carry_up(block_[i].diagonal, block_[i].upper, step_[i + 1].value, x);
    solve_lower_transposed(block_[i].diagonal, x);
  }
  return not_positive;
}

// Computes (K + shift M)^-1 of an irregular torque, scaled to saddle_turn. The result has large parts in the directions in which
// K is negative.
void Statics::bend_softly(const RodState& state, double shift) {
  unsigned number = 12345;
  for (Twist6& u : unbalanced_)
    for (int k = 3; k < 6; ++k) {
      number = 1664525u * number + 1013904223u;
      u.value[k] = number / 4294967296.0 - 0.5;
    }
  double growing = shift;
  while (solve(state, growing) > 0) growing *= 2;
  double turn = 0;
  for (const Twist6& s : step_) turn = std::max(turn, s.angular().norm());
  for (Twist6& s : step_)
    for (double& x : s.value) x *= saddle_turn / turn;
}

double Statics::expected_work() const {
  double work = 0;
  for (size_t i = 0; i < step_.size(); ++i)
    for (int k = 0; k < 6; ++k) work += step_[i].value[k] * unbalanced_[i].value[k];
  return work;
}

double Statics::energy_change(const RodState& from, const RodState& to, double part) const {
  double change = rod_.potential_energy(to) - rod_.potential_energy(from);
  for (size_t i = 0; i < loads_.size(); ++i)
    change -= part * (loads_[i].force.dot(step_[i].linear()) + loads_[i].torque.dot(step_[i].angular()));
  return change;
}

void Statics::start_pull(const RodState& state) {
  for (int j = 0; j < rod_.links(); ++j) pull_[j] = rod_.gap_stiffness(j) * rod_.link_state(state, j).gap;
}

void Statics::predict_pull(const RodState& state, double part) {
  const int n = rod_.segments();
  for (int j = 0; j <= n; ++j) {
    const LinkEnds ends = link_ends(rod_, state, j);
    const Twist6 none{};
    const Twist6 &before = j > 0 ? step_[j - 1] : none, &after = j < n ? step_[j] : none;
    const Vector3 change = gap_change(ends.arms(), before.linear(), before.angular(), after.linear(), after.angular());
    pull_[j] = rod_.gap_stiffness(j) * (rod_.link_state(state, j).gap + part * change);
  }
}

RodState moved(const RodState& state, std::span<const Twist6> step, double part) {
  RodState next = state;
  for (size_t i = 0; i < step.size(); ++i) {
    next.position[i] += part * step[i].linear();
    next.orientation[i] = (rotation(part * step[i].angular()) * state.orientation[i]).normalized();
  }
  return next;
}

// Returns the share of the step, at most 1, at which the largest rotation of a segment equals largest_turn.
double allowed_part(std::span<const Twist6> step) {
  double turn = 0;
  for (const Twist6& s : step) turn = std::max(turn, s.angular().norm());
  return turn > largest_turn ? largest_turn / turn : 1;
}

// Returns the largest displacement of an end of a segment of length l.
double furthest(std::span<const Twist6> step, double l) {
  double far = 0;
  for (const Twist6& s : step) far = std::max(far, s.linear().norm() + l * s.angular().norm());
  return far;
}

void take_to_rest(const Rod& rod, RodState& state) {
  for (int i = 0; i < rod.segments(); ++i) state.velocity[i].setZero(), state.angular_velocity[i].setZero();
  state.clamp_velocity.assign(2, Vector3::Zero());
  state.clamp_angular_velocity.assign(2, Vector3::Zero());
  for (int j = 0; j < rod.links(); ++j) state.link_force[j] = rod.gap_stiffness(j) * rod.link_state(state, j).gap;
}

// Levenberg-Marquardt on (S11). Two properties allow large rotations although stretch is much stiffer than
// bending. First, the geometric stiffness uses the link forces that the last step predicted, not k g, because the second order of
// the rotations of that step changes g (as with Lagrange multipliers). Second, the shift is a multiple of
// the mass matrix, so the steps are those of an implicit motion through a viscous medium.
class Descent {
 public:
  Descent(const Rod& rod, const ClampFrames& clamps, const RodState& start, std::span<const Load> loads,
          const EquilibriumSettings& settings)
      : rod_(rod), settings_(settings), statics_(rod, loads) {
    const RodProperties& p = rod.properties();
    // The slowest bending mode of a clamped hose has a frequency^2 of 5000 times this value.
    least_shift_ = 0.1 * p.bending_stiffness / (p.mass_per_length * std::pow(p.length, 4));
    result_.state = start;
    result_.state.clamps = clamps;
    take_to_rest(rod, result_.state);
    restart();
  }

  Equilibrium run() {
    while (result_.iterations < settings_.iterations && result_.status != EquilibriumStatus::converged) {
      ++result_.iterations;
      iterate();
    }
    RodState& state = result_.state;
    take_to_rest(rod_, state);
    restart();
    result_.negative_pivots = statics_.solve(state, 0);
    if (missing_length(rod_, state.clamps) > longest_elongation * rod_.properties().length ||
        rod_.mean_elongation(state) > longest_elongation)
      result_.status = EquilibriumStatus::too_short;
    return result_;
  }

 private:
  void restart() {
    statics_.start_pull(result_.state);
    result_.residual = statics_.unbalance(result_.state);
  }
  void raise_shift() { shift_ = std::max(shift_factor * shift_, least_shift_); }

  void iterate() {
    const bool positive = statics_.solve(result_.state, shift_) == 0;
    if (positive || settings_.also_unstable) {
      if (balanced())
        result_.status = EquilibriumStatus::converged;
      else
        step();
    } else if (shift_ >= least_shift_ && result_.residual < settings_.tolerance && saddles_++ < most_saddles) {
      // A symmetric start may lead to a saddle point: a disturbance lets the chain move to a stable side.
      statics_.bend_softly(result_.state, least_shift_);
      result_.state = moved(result_.state, statics_.step(), 1);
      restart();
    } else {
      raise_shift();
    }
  }

  // A chain that can rotate without energy (a ring about its clamps' tangent) needs a shift until the end.
  bool balanced() const {
    const double far = furthest(statics_.step(), rod_.segment_length());
    return shift_ <= shift_factor * least_shift_ &&
           (result_.residual < settings_.tolerance || far < smallest_step * rod_.properties().length);
  }

  void step() {
    RodState& state = result_.state;
    const double part = allowed_part(statics_.step()), work = part * statics_.expected_work();
    RodState next = moved(state, statics_.step(), part);
    const Energy energy = rod_.energy(state);
    const double rounding = energy_rounding * (energy.elastic + std::abs(energy.gravitational));
    if (!settings_.also_unstable && statics_.energy_change(state, next, part) > -least_gain * work + rounding) {
      raise_shift();
      statics_.start_pull(state);
      return;
    }
    statics_.predict_pull(state, part);
    state = std::move(next);
    result_.residual = statics_.unbalance(state);
    shift_ = shift_ < 2 * least_shift_ ? 0 : shift_ / shift_factor;
  }

  const Rod& rod_;
  const EquilibriumSettings settings_;
  Statics statics_;
  Equilibrium result_;
  double shift_ = 0, least_shift_ = 0;
  int saddles_ = 0;
};

}  // namespace

Equilibrium find_equilibrium(const Rod& rod, const ClampFrames& clamps, const RodState& start,
                             std::span<const Load> loads, const EquilibriumSettings& settings) {
  assert(rod.spans().size() == 1);
  assert(loads.empty() || static_cast<int>(loads.size()) == rod.segments());
  return Descent(rod, clamps, start, loads, settings).run();
}

Equilibrium find_equilibrium(const Rod& rod, const ClampFrames& clamps, const EquilibriumSettings& settings) {
  return find_equilibrium(rod, clamps, start_curve(rod, clamps).state, {}, settings);
}

// A swivel at the tool end carries no torsion; its hose settles at some roll, to which the clamp is then
// rotated. The link's rotation vector couples bending and a large roll, so this is repeated until the roll is constant.
TwistFreeClamp twist_free_roll(const Rod& rod, const ClampFrames& clamps, const TwistFreeClamp& near,
                               const EquilibriumSettings& settings) {
  constexpr int repeats = 20;
  constexpr double no_roll = 1e-10;  // [rad]
  RodProperties properties = rod.properties();
  properties.tool_end = End::swivel;
  const Rod swivel(properties);
  TwistFreeClamp result;
  result.roll = near.roll;
  ClampFrames turned{clamps.base, rolled(clamps.tool, result.roll)};
  RodState state = near.equilibrium.state;
  int iterations = 0;
  double gain = 1, roll_before = 0;
  for (int k = 0; k < repeats; ++k) {
    result.equilibrium = find_equilibrium(swivel, turned, state, {}, settings);
    state = result.equilibrium.state;
    iterations += result.equilibrium.iterations;
    const double roll = swivel.link_state(state, swivel.segments()).turn.z();
    if (std::abs(roll) < no_roll || result.equilibrium.status != EquilibriumStatus::converged) break;
    const double fall = roll_before - roll;
    if (k > 0 && std::abs(fall) > 1e-3 * std::abs(roll)) gain *= roll_before / fall;
    roll_before = roll;
    result.roll -= gain * roll;
    turned.tool = rolled(clamps.tool, result.roll);
  }
  result.roll = std::remainder(result.roll, 2 * M_PI);
  turned.tool = rolled(clamps.tool, result.roll);
  if (result.equilibrium.status == EquilibriumStatus::converged) {
    result.equilibrium = find_equilibrium(rod, turned, state, {}, settings);
    iterations += result.equilibrium.iterations;
  }
  result.equilibrium.iterations = iterations;
  return result;
}

TwistFreeClamp twist_free_roll(const Rod& rod, const ClampFrames& clamps, const EquilibriumSettings& settings) {
  TwistFreeClamp start;
  start.roll = -start_curve(rod, clamps).roll_to_tool;
  start.equilibrium.state = start_curve(rod, {clamps.base, rolled(clamps.tool, start.roll)}).state;
  return twist_free_roll(rod, clamps, start, settings);
}

std::vector<TwistFreeClamp> rest_shapes(const RodProperties& hose, const ClampFrames& clamps, bool twist_free,
                                        const EquilibriumSettings& settings) {
  constexpr double same = 0.5;  // share of the diameter
  const Rod rod(hose);
  const Vector3 g = hose.gravity, chord = clamps.tool.position - clamps.base.position;
  Vector3 side = chord.cross(g);
  if (side.norm() > 0) side *= g.norm() / side.norm();
  std::vector<TwistFreeClamp> shapes;
  for (const Vector3& gravity : {g, Vector3(-g), side, Vector3(-side)}) {
    RodProperties held = hose;
    held.gravity = gravity;
    TwistFreeClamp clamped = twist_free ? twist_free_roll(Rod(held), clamps, settings)
                                        : TwistFreeClamp{0, find_equilibrium(Rod(held), clamps, settings)};
    if (clamped.equilibrium.status != EquilibriumStatus::converged) continue;
    const RodState from = clamped.equilibrium.state;
    clamped.equilibrium = find_equilibrium(rod, from.clamps, from, {}, settings);
    if (clamped.equilibrium.status != EquilibriumStatus::converged) continue;
    const bool known = std::ranges::any_of(shapes, [&](const TwistFreeClamp& shape) {
      double most = 0;
      for (int i = 0; i < rod.segments(); ++i)
        most = std::max(most, (shape.equilibrium.state.position[i] - clamped.equilibrium.state.position[i]).norm());
      return most < same * hose.diameter;
    });
    if (!known) shapes.push_back(std::move(clamped));
  }
  return shapes;
}

Equilibrium settle(World& world, std::span<const Frame> links, int steps, double speed) {
  const Rod& rod = world.rod();
  const ClampFrames clamps = rod.home(world.state());
  Equilibrium result;
  double energy_before = 0, speed_before = 0;
  const double most_work = world.work() + settling_work * steps * rod.segments();
  for (result.iterations = 1; result.iterations <= steps && world.work() <= most_work; ++result.iterations) {
    if (!world.advance(clamps, links).finite) {
      result.residual = INFINITY;
      return result;
    }
    double fastest = 0;
    for (const Vector3& v : world.state().velocity) fastest = std::max(fastest, v.norm());
    for (const Travel& travel : world.state().travel) fastest = std::max(fastest, std::abs(travel.speed));
    const double kinetic = rod.energy(world.state()).kinetic;
    if (kinetic >= energy_before) {
      energy_before = kinetic, speed_before = fastest;
      if (result.iterations > 1 || fastest > speed) continue;
    }
    // A maximum of the kinetic energy: the hose passes through the equilibrium.
    result.residual = std::max(speed_before, fastest);
    if (result.residual < speed) result.status = EquilibriumStatus::converged;
    RodState state = world.state();
    for (int i = 0; i < rod.segments(); ++i) state.velocity[i].setZero(), state.angular_velocity[i].setZero();
    for (Travel& travel : state.travel) travel.speed = 0;
    world.set_state(state);
    energy_before = speed_before = 0;
    if (result.status == EquilibriumStatus::converged) break;
  }
  result.state = world.state();
  if (rod.mean_elongation(result.state) > longest_elongation) result.status = EquilibriumStatus::too_short;
  return result;
}

}  // namespace dresslife::sim
