#include "sim/rod/rod.h"

#include <algorithm>
#include <cassert>

#include "sim/rod/block_tridiagonal.h"
#include "sim/rod/hysteresis_steps.h"
#include "sim/rod/link.h"

namespace dresslife::sim {
namespace {

// Weights of (S3). For one oscillator of frequency w, beta >= 1/4 is stable for every h w; 0.3 damps its oscillation.
constexpr double turn_beta = 0.3, turn_theta = 0.5;
// The gap's waves are far faster than the step and have no influence on bending. C = gap_damping h K removes their energy, and
// beta is increased by half of gap_damping (the damping is explicit, so stability needs beta >= 1/4 + gap_damping/2).
constexpr double gap_beta = 0.55, gap_damping = 0.5;
// With less bending damping than this number of steps the fastest bending waves oscillate.
constexpr double least_damping_steps = 0.25;
// Geometric stiffness of a taut chain: its lateral waves have the speed sqrt(T/rho). Leapfrog alone is stable for
// T < rho l^2/h^2; the stiffness is added from 0.3 of this limit on.
constexpr double tension_beta = 0.3, free_tension = 0.3;
// Radius of gyration squared over radius squared: between a solid (0.5) and a thin tube (1).
constexpr double inertia_shape = 0.75;

// (S5) End links: the sum over links of energy * length is a quadrature of the integral of m^2/EI from clamp
// to clamp. Half lengths at the ends (trapezoid rule) have an error of order l^2. Gregory's first correction -l/12 (m_1 -
// m_0) changes the weights 1/2, 1 to 5/12, 13/12. At a free end the moment vanishes, so the plain weights are used.
double compliance_length(const RodProperties& p, int link, double l) {
  const int n = p.segments;
  if (link == 0 || link == n) return l * 5 / 12;
  if (link == 1 || (link == n - 1 && p.tool_end != End::free)) return l * (n == 2 ? 14.0 : 13.0) / 12;
  return l;
}

// (S24) E I of a link is that of its piece of hose as springs in series: stiff within a stiff end, bare elsewhere. In a
// span shorter than both stiff ends, the one at the base has priority.
double stiffened(const RodProperties& p, int link, double l) {
  const double begin = std::max(0.0, (link - 0.5) * l), end = std::min(p.length, (link + 0.5) * l);
  double bare = 1, compliance = 0;  // share of the piece; mean of E I/(E I + that of the stiff end)
  for (const bool at_tool : {false, true}) {
    const StiffEnd& stiff = p.stiff_ends[at_tool];
    if (stiff.bending_stiffness == 0) continue;
    const double covered = at_tool ? end - (p.length - stiff.length) : stiff.length - begin;
    const double share = std::clamp(covered / (end - begin), 0.0, bare);
    bare -= share;
    compliance += share * p.bending_stiffness / (p.bending_stiffness + stiff.bending_stiffness);
  }
  return p.bending_stiffness * (1 / (bare + compliance) - 1);
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

// ---- construction -----------------------------------------------------------------------------------------

Rod::Rod(const RodProperties& properties) { add(properties, true); }

Rod::Rod(const std::vector<RodProperties>& spans, const std::vector<int>& first_of_dresspack) {
  assert(!spans.empty());
  for (size_t k = 0; k < spans.size(); ++k)
    add(spans[k], k == 0 || std::ranges::find(first_of_dresspack, static_cast<int>(k)) != first_of_dresspack.end());
}

void Rod::add(const RodProperties& p, bool new_dresspack) {
  assert(p.segments >= 2 && p.length > 0 && p.mass_per_length > 0 && p.diameter > 0);
  assert(p.bending_stiffness > 0 && p.torsional_stiffness > 0 && p.axial_stiffness > 0 && p.damping_time >= 0);
  assert(p.base_end != End::free);
  Span span;
  span.properties = p;
  span.first_segment = segments(), span.first_link = links();
  if (!spans_.empty()) {
    const Span& before = spans_.back();
    span.dresspack = before.dresspack + (new_dresspack ? 1 : 0);
    span.first_arc = new_dresspack ? 0 : before.first_arc + before.properties.length;
  }
  const int n = p.segments;
  const double l = p.length / n, radius2 = p.diameter * p.diameter / 4;
  span.segment_length = l;
  span.segment_mass = p.mass_per_length * l;
  span.axial_inertia = span.segment_mass * inertia_shape * radius2;
  span.transverse_inertia = span.segment_mass * (l * l / 12 + inertia_shape * radius2 / 2);
  const double bending = p.bending_stiffness * polymer_loss(p.loss_factor).elastic;
  for (int j = 0; j <= n; ++j) {
    const bool end = j == 0 || j == n, tied = j < n || p.tool_end != End::free;
    const double length = compliance_length(p, j, l);
    const double stiff = bending + stiffened(p, j, l);
    const Vector3 stiffness{stiff, stiff, p.torsional_stiffness};
    bending_length_.push_back(length);
    // before a free end the last link also represents the half segment beyond it
    const bool before_free = j == n - 1 && p.tool_end == End::free;
    gap_stiffness_.push_back(tied ? p.axial_stiffness / (end ? l / 2 : before_free ? 1.5 * l : l) : 0);
    turn_stiffness_.push_back(end_mask(p, j).cwiseProduct(stiffness) / length);
    rest_turn_.push_back(p.rest_curvature * length);
  }
  span_of_segment_.insert(span_of_segment_.end(), n, static_cast<int>(spans_.size()));
  span_of_link_.insert(span_of_link_.end(), n + 1, static_cast<int>(spans_.size()));
  spans_.push_back(span);
  hysteretic_ |= p.is_hysteretic();
}

int Rod::first_span(int dresspack) const {
  return static_cast<int>(
      std::partition_point(spans_.begin(), spans_.end(), [&](const Span& span) { return span.dresspack < dresspack; }) -
      spans_.begin());
}

double Rod::link_arc(int link) const {
  const Span& span = span_of_link(link);
  return span.first_arc + (link - span.first_link) * span.segment_length;
}

// ---- quantities of a state --------------------------------------------------------------------------------

RodState Rod::straight(const Frame& base) const {
  RodState state;
  const Vector3 t = tangent(base.orientation);
  Frame frame = base;
  const int ends = 2 * static_cast<int>(spans_.size());
  state.clamps.between.resize(ends - 2);
  for (size_t k = 0; k < spans_.size(); ++k) {
    const Span& span = spans_[k];
    state.clamps.end(2 * static_cast<int>(k)) = frame;
    for (int i = 0; i < span.segments(); ++i) {
      state.position.push_back(frame.position + t * (span.segment_length * (i + 0.5)));
      state.orientation.push_back(base.orientation);
    }
    frame.position += t * span.properties.length;
    state.clamps.end(2 * static_cast<int>(k) + 1) = frame;
  }
  state.velocity.assign(segments(), Vector3::Zero());
  state.angular_velocity.assign(segments(), Vector3::Zero());
  state.link_force.assign(links(), Vector3::Zero());
  state.clamp_velocity.assign(ends, Vector3::Zero());
  state.clamp_angular_velocity.assign(ends, Vector3::Zero());
  state.travel.resize(spans_.size());
  return state;
}

ClampFrames Rod::home(const RodState& state) const {
  ClampFrames home = state.clamps;
  for (size_t k = 0; k < spans_.size(); ++k) {
    Frame& base = home.end(2 * static_cast<int>(k));
    if (spans_[k].properties.slider) base.position -= state.travel[k].way * tangent(base.orientation);
  }
  return home;
}

LinkState Rod::link_state(const RodState& state, int link) const {
  const LinkEnds ends = link_ends(*this, state, link);
  if (gap_stiffness_[link] == 0) return {Vector3::Zero(), Vector3::Zero(), Vector3::Zero()};
  const LinkTurn turn = link_turn(*ends.orientation_a, *ends.orientation_b);
  return {ends.gap(ends.arms()), turn.phi, turn_stiffness_[link].cwiseProduct(turn.phi - rest_turn_[link])};
}

Vector3 Rod::turn(const RodState& state, int link) const {
  if (gap_stiffness_[link] == 0) return Vector3::Zero();
  const Span& span = span_of_link(link);
  const int k = link - span.first_link, before = span.first_segment + k - 1;
  const int first_end = 2 * span_of_link_[link];
  const Quaternion& a = k > 0 ? state.orientation[before] : state.clamps.end(first_end).orientation;
  const Quaternion& b =
      k < span.segments() ? state.orientation[before + 1] : state.clamps.end(first_end + 1).orientation;
  return half_turn(a, b).phi();
}

double Rod::potential_energy(const RodState& state) const {
  double energy = 0;
  for (int i = 0; i < segments(); ++i)
    energy -= span_of(i).segment_mass * span_of(i).properties.gravity.dot(state.position[i]);
  for (const Span& span : spans_)
    if (span.properties.tip_mass > 0)
      energy -= span.properties.tip_mass * span.properties.gravity.dot(tip_frame(state, span).position);
  for (int j = 0; j < links(); ++j) {
    const LinkState link = link_state(state, j);
    energy += 0.5 * (gap_stiffness_[j] * link.gap.squaredNorm() + link.moment.dot(link.turn - rest_turn_[j]));
  }
  return energy;
}

// The stretch energy uses the link force of the last step, f^2/(2 k). The gaps themselves contain second-order terms from the
// rotation within one step. The next step removes these terms; they are no stretch of the hose.
Energy Rod::energy(const RodState& state) const {
  Energy energy;
  for (int i = 0; i < segments(); ++i) {
    const Vector3& w = state.angular_velocity[i];
    const Span& span = span_of(i);
    const double axial = w.dot(tangent(state.orientation[i]));
    energy.kinetic +=
        0.5 * (span.segment_mass * state.velocity[i].squaredNorm() +
               span.transverse_inertia * (w.squaredNorm() - axial * axial) + span.axial_inertia * axial * axial);
    energy.gravitational -= span.segment_mass * span.properties.gravity.dot(state.position[i]);
  }
  for (size_t k = 0; k < spans_.size(); ++k) add_ends(state, static_cast<int>(k), energy);
  for (int j = 0; j < links(); ++j) {
    if (gap_stiffness_[j] == 0) continue;
    const LinkState link = link_state(state, j);
    energy.elastic +=
        0.5 * (state.link_force[j].squaredNorm() / gap_stiffness_[j] + link.moment.dot(link.turn - rest_turn_[j]));
  }
  if (!state.memory.empty()) energy.elastic += stored_in_elements(state);
  return energy;
}

// The memory belongs to the begin of the step. The change since then is treated as instantaneous.
double Rod::stored_in_elements(const RodState& state) const {
  double energy = 0;
  for (const Span& span : spans_) {
    const RodProperties& p = span.properties;
    if (!p.is_hysteretic()) continue;
    const Hysteresis at_once(p.bending_stiffness, p.friction, p.loss_factor, 1e-9);
    for (int j = span.first_link; j <= span.last_link(); ++j) {
      if (turn_stiffness_[j][0] == 0) continue;
      BendMemory memory = state.memory[j];
      at_once.advance(memory, link_state(state, j).turn.head<2>() / bending_length_[j]);
      energy += bending_length_[j] * at_once.energy(memory);
    }
  }
  return energy;
}

// Adds the energies of a mass at the tip and of a clamp that slides at the base.
void Rod::add_ends(const RodState& state, int k, Energy& energy) const {
  const Span& span = spans_[k];
  const RodProperties& p = span.properties;
  if (p.tip_mass > 0) {
    const int last = span.first_segment + span.segments() - 1;
    const Vector3 tip = tip_frame(state, span).position, arm = tip - state.position[last];
    energy.kinetic += 0.5 * p.tip_mass * (state.velocity[last] + state.angular_velocity[last].cross(arm)).squaredNorm();
    energy.gravitational -= p.tip_mass * p.gravity.dot(tip);
  }
  if (!p.slider) return;
  const double way = state.travel[k].way;
  energy.kinetic += 0.5 * p.slider->mass * state.clamp_velocity[2 * k].squaredNorm();
  energy.elastic += (p.slider->force + 0.5 * p.slider->spring * way) * way;
  energy.gravitational -= p.slider->mass * p.gravity.dot(state.clamps.end(2 * k).position);
}

double Rod::mean_elongation(const RodState& state, const Span& span) const {
  double stretch = 0;
  for (int j = span.first_link; j <= span.last_link(); ++j) {
    const LinkEnds ends = link_ends(*this, state, j);
    if (gap_stiffness_[j] == 0) continue;
    const Vector3 t = ends.tangent_a + ends.tangent_b;
    stretch += ends.gap(ends.arms()).dot(t) / std::max(t.norm(), 1e-12);
  }
  return stretch / span.properties.length;
}

const Span& Rod::most_stretched(const RodState& state) const {
  return *std::ranges::max_element(
      spans_, [&](const Span& a, const Span& b) { return mean_elongation(state, a) < mean_elongation(state, b); });
}

std::vector<double> Rod::tensions(const RodState& state) const {
  std::vector<double> tension(links());
  for (size_t k = 0; k < spans_.size(); ++k) {
    const Span& span = spans_[k];
    const int base = 2 * static_cast<int>(k);
    Vector3 before = tangent(state.clamps.end(base).orientation);
    for (int i = 0; i <= span.segments(); ++i) {
      const int j = span.first_link + i;
      const Vector3 after = tangent(i < span.segments() ? state.orientation[span.first_segment + i]
                                                        : state.clamps.end(base + 1).orientation);
      const Vector3 t = before + after;
      tension[j] = state.link_force[j].dot(t) / std::max(t.norm(), 1e-12);
      before = after;
    }
  }
  return tension;
}

Frame Rod::tip_frame(const RodState& state, const Span& span) const {
  const int last = span.first_segment + span.segments() - 1;
  const Quaternion& orientation = state.orientation[last];
  return {state.position[last] + (span.segment_length / 2) * tangent(orientation), orientation};
}

bool Rod::finite(const RodState& state) const {
  // A sum is finite only if all its terms are finite.
  double sum = 0;
  for (int i = 0; i < segments(); ++i)
    sum += state.position[i].sum() + state.velocity[i].sum() + state.angular_velocity[i].sum() +
           state.orientation[i].coeffs().sum();
  return std::isfinite(sum);
}

double shortest_way(const Rod& rod, const ClampFrames& clamps, int k, std::span<const Vector3> through) {
  const RodProperties& p = rod.spans()[k].properties;
  const Vector3 target = through.empty() ? clamps.end(2 * k + 1).position : through.front();
  Vector3 from = clamps.end(2 * k).position;
  if (p.slider) {
    const Vector3 d = tangent(clamps.end(2 * k).orientation);
    from += std::clamp(d.dot(target - from), 0.0, p.slider->stroke) * d;
  }
  double way = 0;
  for (const Vector3& point : through) way += (point - from).norm(), from = point;
  return way + (clamps.end(2 * k + 1).position - from).norm();
}

double missing_length(const Rod& rod, const ClampFrames& clamps, int k) {
  const RodProperties& p = rod.spans()[k].properties;
  if (p.tool_end == End::free) return 0;
  return std::max(0.0, shortest_way(rod, clamps, k) - p.length);
}

// ---- one step ---------------------------------------------------------------------------------------------

namespace {

/// The equation of the change of speed w of a sliding base clamp (S14): pivot w = right + coupling e . dv_0. dv_0: of the first
/// segment. e = row: displacement of the link's far end along the clamp's direction by dv_0.
struct SlideEquation {
  double coupling = 0, pivot = 1, right = 0;
  double row[6] = {};
  Vector3 direction = Vector3::Zero();
  Travel travel;      ///< assumed mode
  double locked = 0;  ///< w if the clamp does not slide

  bool slides() const { return travel.mode == Travel::Mode::sliding; }
  /// Returns e . dv_0.
  double moved_by(const Twist6& change) const {
    double moved = 0;
    for (int r = 0; r < 6; ++r) moved += row[r] * change.value[r];
    return moved;
  }
};

}  // namespace

struct RodSystem {
  std::vector<TridiagonalBlock> block;
  std::vector<Twist6> change;                       ///< (segment) dv
  std::vector<Vector3> half;                        ///< (segment) l/2 along its tangent
  std::vector<LinkArms> arms;                       ///< (link)
  std::vector<Vector3> force;                       ///< (link) explicit part of the gap's force
  ClampFrames end;                                  ///< clamps at the end of the step
  std::vector<Vector3> velocity, angular_velocity;  ///< (end) of the clamps over the step
  std::vector<SlideEquation> slide;                 ///< (span)
  std::vector<Hysteresis> hysteresis;               ///< (span) for steps of `hysteresis_step`; empty: not hysteretic
  std::vector<BendMemory> memory;                   ///< (link) at the begin of the step
  double step = 0, hysteresis_step = 0;
};

namespace {

// Adds a vector to three numbers of a block's right-hand side.
inline void add(double* value, const Vector3& x) {
  for (int k = 0; k < 3; ++k) value[k] += x[k];
}

// Adds skew(x) to the 3x3 part of a row-major 6x6 matrix that begins at m.
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

/// Assembly of one step of one span. A class, so that all parts share the same names.
class Assembly {
 public:
  Assembly(const Rod& rod, int span, const RodState& state, RodSystem& system, double h)
      : rod_(rod),
        span_(rod.spans()[span]),
        first_end_(2 * span),
        state_(state),
        system_(system),
        h_(h),
        p_(span_.properties) {
    const double least = least_damping_steps * h, twist = std::max(p_.damping_time, least);
    if (p_.is_hysteretic()) hysteresis_ = &system.hysteresis[span];
    const double bend = p_.loss_factor > 0 ? std::max(hysteresis_->dashpot(), least) : twist;
    damping_ = {bend, bend, twist};
    const double l = span_.segment_length;
    free_force_ = free_tension * p_.mass_per_length * l * l / (h * h);
  }

  // Adds inertia, gravity, the gyroscopic torque -w x (I w) and external loads.
  void begin_segment(int i, std::span<const Load> loads) {
    TridiagonalBlock& b = system_.block[i];
    const Vector3 t = tangent(state_.orientation[i]);
    const double m = span_.segment_mass, transverse = span_.transverse_inertia;
    const double excess = span_.axial_inertia - transverse;
    system_.half[i] = (span_.segment_length / 2) * t;
    std::fill(b.diagonal, b.diagonal + 36, 0.0);
    add_diagonal(b.diagonal, m);
    add_diagonal(b.diagonal + 21, transverse);
    add_outer(b.diagonal + 21, excess, t, t);
    const Vector3& w = state_.angular_velocity[i];
    Vector3 force = m * p_.gravity, torque = -(excess * t.dot(w)) * w.cross(t);
    if (!loads.empty()) force += loads[i].force, torque += loads[i].torque;
    if (p_.tip_mass > 0 && i + 1 == span_.first_segment + span_.segments())
      hang_tip(b, w, system_.half[i], force, torque);
    for (int k = 0; k < 3; ++k) b.value[k] = h_ * force[k], b.value[3 + k] = h_ * torque[k];
  }

  void add_link(int j) {
    if (rod_.gap_stiffness(j) == 0) {
      system_.force[j].setZero();
      return;
    }
    const bool has_a = j > span_.first_link, has_b = j < span_.last_link();
    const int after = span_.first_segment + j - span_.first_link, before = after - 1;
    const Side a = has_a ? segment_side(before) : clamp_side(first_end_);
    const Side b = has_b ? segment_side(after) : clamp_side(first_end_ + 1);
    const LinkTurn turn = link_turn(*a.orientation, *b.orientation);
    const LinkArms& arms = system_.arms[j] = link_arms(a.half, b.half, span_.segment_length / 2);
    const Vector3 force = gap_force(j, a, b, arms);
    const Vector3 moment =
        turn_moment(j, turn, *b.angular_velocity - *a.angular_velocity) - force.dot(arms.lengthening) * arms.normal;
    const double k = rod_.gap_stiffness(j) * gap_beta * h_ * h_;
    const TurnMatrix turning = turn_matrix(j, turn, k, arms);
    const double taut_a = tautness(j, arms.a), taut_b = tautness(j, arms.b);
    if (has_a) add_own(before, k, arms, 1, force, moment, turning, taut_a);
    if (has_b) add_own(after, k, arms, -1, force, moment, turning, taut_b);
    if (has_a && has_b) couple(before, k, arms, turning);
    if (!has_a) drive(first_end_, after, k, arms.b, -1, turning);
    if (!has_a && p_.slider) slide(after, k, arms.b, force);
    if (!has_b) drive(first_end_ + 1, before, k, arms.a, 1, turning);
  }

 private:
  struct Side {
    const Vector3 *position, *velocity, *angular_velocity;
    const Quaternion* orientation;
    Vector3 half;
  };
  Side segment_side(int i) const {
    return {&state_.position[i], &state_.velocity[i], &state_.angular_velocity[i], &state_.orientation[i],
            system_.half[i]};
  }
  Side clamp_side(int end) const {
    const Frame& frame = state_.clamps.end(end);
    return {&frame.position, &state_.clamp_velocity[end], &state_.clamp_angular_velocity[end], &frame.orientation,
            Vector3::Zero()};
  }

  // Returns (S6), the force on the segment before the link.
  Vector3 gap_force(int j, const Side& a, const Side& b, const LinkArms& arms) {
    const Vector3 gap = (*b.position - arms.b) - (*a.position + arms.a);
    const Vector3 rate = gap_change(arms, *a.velocity, *a.angular_velocity, *b.velocity, *b.angular_velocity);
    const Vector3 force = rod_.gap_stiffness(j) * (gap + (gap_damping * h_) * rate);
    system_.force[j] = force;
    return force;
  }

  // Returns (S7), with (S19) for hysteretic bending: the moment on the segment before the link.
  Vector3 turn_moment(int j, const LinkTurn& turn, const Vector3& rate) const {
    const Vector3 strain = turn.phi - rod_.rest_turn(j) + damping_.cwiseProduct(turn.map.transpose() * rate);
    Vector3 moment = rod_.turn_stiffness(j).cwiseProduct(strain);
    if (is_hysteretic(j)) moment.head<2>() += element_moment(j, turn);
    return turn.map * moment;
  }

  bool is_hysteretic(int j) const { return hysteresis_ && rod_.turn_stiffness(j)[0] > 0; }

  // Applies (S20), (S22) from the memory of the previous step to the turn at the begin of this step.
  Eigen::Vector2d element_moment(int j, const LinkTurn& turn) const {
    const Eigen::Vector2d bend = turn.phi.head<2>() / rod_.bending_length(j);
    BendMemory& memory = system_.memory[j];
    if (state_.memory.empty())
      memory = {}, memory.bend = bend;
    else
      memory = state_.memory[j];
    return hysteresis_->advance(memory, bend);
  }

  // G diag(k) G^T (beta h^2 + theta h tau) with k1 = k2: G G^T = s^2 1 + (1 - s^2) u u^T, so the sum is
  // k1 (s^2 1 + (1 - s^2) u u^T) + (k3 - k1) g3 g3^T, plus the contribution of the gap's stiffness k through the lengthening
  // of the arms.
  struct TurnMatrix {
    double value[9];
    double along[9];  ///< k e n^T: couples rotations to displacements
  };
  TurnMatrix turn_matrix(int j, const LinkTurn& turn, double k, const LinkArms& arms) const {
    const double spring = turn_beta * h_ * h_, damper = turn_theta * h_;
    const Vector3& stiffness = rod_.turn_stiffness(j);
    const double held = is_hysteretic(j) ? spring * hysteresis_->tangent() / rod_.bending_length(j) : 0;
    const double k1 = (spring + damper * damping_[0]) * stiffness[0] + held;
    const double k3 = (spring + damper * damping_[2]) * stiffness[2];
    const Vector3 g3 = turn.map.col(2), &n = arms.normal;
    const double axis = k1 * turn.axis_excess, third = k3 - k1, sphere = k1 * turn.stretch * turn.stretch;
    const double lengthening = k * arms.excess;
    TurnMatrix m;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        m.value[3 * r + c] = axis * turn.axis[r] * turn.axis[c] + third * g3[r] * g3[c] + lengthening * n[r] * n[c] +
                             (r == c ? sphere : 0);
    const Vector3 e = k * arms.lengthening;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) m.along[3 * r + c] = e[r] * n[c];
    return m;
  }

  // (S8) Returns the geometric stiffness a T (1 - t t^T) of tension for the rotation of a segment; arm = a t.
  double tautness(int j, const Vector3& arm) const {
    const double a = span_.segment_length / 2;
    const double excess = state_.link_force[j].dot(arm) - free_force_ * a;
    return excess > 0 ? tension_beta * h_ * h_ * excess : 0;
  }

  // Adds a link's contribution to the block of its segment. side +1: the link follows the segment, -1: precedes it. The end
  // moves with v + side w x arm, hence rows (k 1, -side k S), (.., -k S S) with S = skew(arm); and with the
  // lengthening e n.w: -k e n^T.
  void add_own(int i, double k, const LinkArms& arms, double side, const Vector3& force, const Vector3& moment,
               const TurnMatrix& turning, double taut) {
    const Vector3& arm = side > 0 ? arms.a : arms.b;
    TridiagonalBlock& b = system_.block[i];
    const double a2 = arm.squaredNorm();
    add_diagonal(b.diagonal, k);
    add_skew(b.diagonal + 3, (-side * k) * arm);
    double* m = b.diagonal + 21;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) {
        b.diagonal[6 * r + 3 + c] -= turning.along[3 * r + c];
        m[6 * r + c] += turning.value[3 * r + c];
      }
    add_diagonal(m, k * a2 + taut);
    add_outer(m, -(k + taut / a2), arm, arm);
    add(b.value, (side * h_) * force);
    add(b.value + 3, h_ * (arm.cross(force) + side * moment));
  }

  // Adds the coupling of segments i and i + 1: S_a S_b = b a^T - (a.b) 1.
  void couple(int i, double k, const LinkArms& arms, const TurnMatrix& turning) {
    double* u = system_.block[i].upper;
    std::fill(u, u + 36, 0.0);
    add_diagonal(u, -k);
    add_skew(u + 3, -k * arms.b);
    add_skew(u + 18, -k * arms.a);
    add_outer(u + 21, -k, arms.b, arms.a);
    add_diagonal(u + 21, k * arms.a.dot(arms.b));
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) {
        u[3 + 6 * r + c] += turning.along[3 * r + c];
        u[18 + 6 * r + c] += turning.along[3 * c + r];
        u[21 + 6 * r + c] -= turning.value[3 * r + c];
      }
  }

  // Adds a point mass at the end of the arm, which moves with v + w x arm. (Not inlined into the loop over the segments.)
  [[gnu::noinline]] void hang_tip(TridiagonalBlock& b, const Vector3& w, const Vector3& arm, Vector3& force,
                                  Vector3& torque) const {
    const double m = p_.tip_mass;
    add_diagonal(b.diagonal, m);
    add_skew(b.diagonal + 3, -m * arm);
    add_diagonal(b.diagonal + 21, m * arm.squaredNorm());
    add_outer(b.diagonal + 21, -m, arm, arm);
    const Vector3 pull = m * (p_.gravity - w.cross(w.cross(arm)));
    force += pull, torque += arm.cross(pull);
    const double excess = pull.dot(arm) - free_force_ * arm.norm();  // (S8), as for a link at the tip
    if (excess <= 0) return;
    const double taut = tension_beta * h_ * h_ * excess;
    add_diagonal(b.diagonal + 21, taut);
    add_outer(b.diagonal + 21, -taut / arm.squaredNorm(), arm, arm);
  }

  // (S14) The clamp of mass m slides by w more than system_.velocity, along d:
  //   m (d.c + w) = h (d.f - F - spring u - damping u' + m g.d - friction) + k (e.dv_0 - d.c - w) - (..) w.
  // c: its change of velocity without w; k e.dv_0: as in drive(). Elimination of w adds -k^2/pivot e e^T to the
  // first segment's block.
  [[gnu::noinline]] void slide(int segment, double k, const Vector3& arm, const Vector3& pull) {
    const SlidingClamp& slider = *p_.slider;
    SlideEquation& s = system_.slide[first_end_ / 2];
    const Vector3 d = tangent(state_.clamps.end(first_end_).orientation), turn = -arm.cross(d);
    s.direction = d;
    for (int q = 0; q < 3; ++q) s.row[q] = d[q], s.row[3 + q] = turn[q];
    const double along = d.dot(system_.velocity[first_end_] - state_.clamp_velocity[first_end_]);
    s.coupling = k;
    s.pivot = slider.mass + k + turn_beta * h_ * h_ * slider.spring + turn_theta * h_ * slider.damping;
    s.right = h_ * (d.dot(pull) - slider.force - slider.spring * s.travel.way - slider.damping * s.travel.speed +
                    slider.mass * d.dot(p_.gravity)) -
              (slider.mass + k) * along;
    TridiagonalBlock& b = system_.block[segment];
    if (s.slides()) {
      s.right -= h_ * slider.friction * s.travel.sense;
      for (int r = 0; r < 6; ++r)
        for (int c = r; c < 6; ++c) b.diagonal[6 * r + c] -= k * k / s.pivot * s.row[r] * s.row[c];
    }
    const double share = s.slides() ? s.right / s.pivot : s.locked;
    for (int r = 0; r < 6; ++r) b.value[r] += k * share * s.row[r];
  }

  // Adds the velocity change of a prescribed clamp to the right-hand side.
  void drive(int end, int segment, double k, const Vector3& arm, double side, const TurnMatrix& turning) {
    TridiagonalBlock& b = system_.block[segment];
    const Vector3 change = k * (system_.velocity[end] - state_.clamp_velocity[end]);
    const Vector3 spin = system_.angular_velocity[end] - state_.clamp_angular_velocity[end];
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> m(turning.value);
    add(b.value, change);
    add(b.value + 3, side * arm.cross(change) + m * spin);
  }

  const Rod& rod_;
  const Span& span_;
  const int first_end_;
  const RodState& state_;
  RodSystem& system_;
  double h_, free_force_;
  Vector3 damping_;                         // tau about d1, d2, d3 [s]
  const Hysteresis* hysteresis_ = nullptr;  // of a hysteretic span
  const RodProperties& p_;
};

}  // namespace

RodSolver::RodSolver(const Rod& rod) : rod_(rod), system_(std::make_unique<RodSystem>()) {
  system_->block.resize(rod.segments());  // zero, so spans are not coupled
  system_->change.resize(rod.segments());
  system_->half.resize(rod.segments());
  system_->arms.resize(rod.links());
  system_->force.resize(rod.links());
  system_->slide.resize(rod.spans().size());
}

RodSolver::~RodSolver() = default;

std::span<const Twist6> RodSolver::velocity_change() const { return system_->change; }

void RodSolver::prepare_hysteresis(double h) {
  RodSystem& s = *system_;
  s.memory.resize(rod_.links());
  if (s.hysteresis_step == h) return;
  s.hysteresis.clear();
  for (const Span& span : rod_.spans()) {
    const RodProperties& p = span.properties;
    s.hysteresis.emplace_back(p.bending_stiffness, p.friction, p.loss_factor, h);
  }
  s.hysteresis_step = h;
}

bool RodSolver::solve(const RodState& state, const ClampFrames& end, double h, std::span<const Load> loads) {
  RodSystem& s = *system_;
  const int spans = static_cast<int>(rod_.spans().size());
  assert(state.clamps.ends() == 2 * spans && end.ends() == 2 * spans);
  s.velocity.resize(2 * spans), s.angular_velocity.resize(2 * spans);
  s.end = end;
  s.step = h;
  if (rod_.is_hysteretic()) prepare_hysteresis(h);
  for (int e = 0; e < 2 * spans; ++e) {
    const RodProperties& p = rod_.spans()[e / 2].properties;
    const Frame& before = state.clamps.end(e);
    Frame& after = s.end.end(e);
    if (e % 2 == 1 && p.tool_end == End::free) after = before;
    if (e % 2 == 0 && p.slider)
      after.position += (state.travel[e / 2].way + h * state.travel[e / 2].speed) * tangent(after.orientation);
    s.velocity[e] = (after.position - before.position) / h;
    s.angular_velocity[e] = rotation_vector(after.orientation * before.orientation.conjugate()) / h;
  }
  int not_positive = 0;
  for (int k = 0; k < spans; ++k)
    not_positive += rod_.spans()[k].properties.slider ? solve_sliding(state, k, loads) : solve_span(state, k, loads);
  return not_positive == 0;
}

// Finds by trial whether the clamp slides, in which direction, or is held. The first trial is the mode of the previous step.
int RodSolver::solve_sliding(const RodState& state, int k, std::span<const Load> loads) {
  constexpr int attempts = 8;
  SlideEquation& slide = system_->slide[k];
  slide.travel = state.travel[k];
  const double friction = rod_.spans()[k].properties.slider->friction;
  if (friction > 0 && slide.slides() && slide.travel.sense == 0) slide.travel.mode = Travel::Mode::held;
  int not_positive = 0;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    const Travel& t = slide.travel;
    const double target = t.mode == Travel::Mode::at_end ? rod_.spans()[k].properties.slider->stroke : 0;
    slide.locked = (t.mode == Travel::Mode::held ? 0 : (target - t.way) / system_->step) - t.speed;
    not_positive = solve_span(state, k, loads);
    if (not_positive > 0 || !choose_mode(state, k)) break;
  }
  return not_positive;
}

// Returns w for the present dv_0.
double RodSolver::travel_change(int k) const {
  const SlideEquation& s = system_->slide[k];
  if (!s.slides()) return s.locked;
  return (s.right + s.coupling * s.moved_by(system_->change[rod_.spans()[k].first_segment])) / s.pivot;
}

// Returns whether the result contradicts the assumed mode, and selects the next mode. `support` is the force that holds the
// clamp along its direction: stops only push, friction acts up to its limit.
bool RodSolver::choose_mode(const RodState& state, int k) {
  using Mode = Travel::Mode;
  const SlidingClamp& slider = *rod_.spans()[k].properties.slider;
  SlideEquation& s = system_->slide[k];
  const Travel& t = state.travel[k];
  const Mode mode = s.travel.mode;
  const int moving = slider.friction > 0 ? 1 : 0;
  if (mode == Mode::sliding) {
    const double speed = t.speed + travel_change(k), way = t.way + system_->step * speed;
    if (way < 0)
      s.travel.mode = Mode::at_home;
    else if (way > slider.stroke)
      s.travel.mode = Mode::at_end;
    else if (s.travel.sense * speed < 0)
      s.travel.mode = Mode::held;
    return s.travel.mode != mode;
  }
  const double moved = s.moved_by(system_->change[rod_.spans()[k].first_segment]);
  const double support = (s.pivot * s.locked - s.right - s.coupling * moved) / system_->step;
  const bool out = mode != Mode::at_end && support < -slider.friction;
  const bool in = mode != Mode::at_home && support > slider.friction;
  if (out || in) s.travel.mode = Mode::sliding, s.travel.sense = out ? moving : -moving;
  return out || in;
}

int RodSolver::solve_span(const RodState& state, int k, std::span<const Load> loads) {
  RodSystem& s = *system_;
  const Span& span = rod_.spans()[k];
  Assembly assembly(rod_, k, state, s, s.step);
  const int begin = span.first_segment, end = begin + span.segments();
  int not_positive = 0;
  assembly.begin_segment(begin, loads);
  assembly.add_link(span.first_link);
  for (int i = begin; i < end; ++i) {
    if (i + 1 < end) assembly.begin_segment(i + 1, loads);
    assembly.add_link(span.first_link + i + 1 - begin);
    not_positive += eliminate(s.block[i], i + 1 < end ? &s.block[i + 1] : nullptr);
  }
  for (int i = end - 1; i >= begin; --i) {
    double* x = s.change[i].value;
    std::copy_n(s.block[i].value, 6, x);
    if (i + 1 < end) carry_up(s.block[i].diagonal, s.block[i].upper, s.change[i + 1].value, x);
    solve_lower_transposed(s.block[i].diagonal, x);
  }
  return not_positive;
}

namespace {

/// Replaces x by A^-1 x, in blocks >= first only. A: factored. x: one or several right-hand sides, 0 before `foremost`.
template <class X>
void substitute(const std::vector<TridiagonalBlock>& block, int foremost, int first, std::span<X> x) {
  const int n = static_cast<int>(block.size());
  for (int i = foremost; i < n; ++i) {
    auto* const value = x[i].value;
    solve_lower(block[i].diagonal, value);
    scale_by_pivots(block[i].diagonal, value);
    if (i + 1 < n) carry_down(block[i].upper, value, x[i + 1].value);
  }
  for (int i = n - 1; i >= first; --i) {
    if (i + 1 < n) carry_up(block[i].diagonal, block[i].upper, x[i + 1].value, x[i].value);
    solve_lower_transposed(block[i].diagonal, x[i].value);
  }
}

}  // namespace

void RodSolver::respond(int foremost, int first, std::span<Twists> x) const {
  substitute(system_->block, foremost, first, x);
}

void RodSolver::apply_impulses(std::span<Twist6> impulses) {
  substitute(system_->block, 0, 0, impulses);
  for (std::size_t i = 0; i < system_->block.size(); ++i)
    for (int k = 0; k < 6; ++k) system_->change[i].value[k] += impulses[i].value[k];
}

// (S9) Computes the force during the step. k g alone oscillates by O(h^2).
void RodSolver::finish(RodState& state) {
  RodSystem& s = *system_;
  for (int k = 0; k < static_cast<int>(rod_.spans().size()); ++k) {
    const Span& span = rod_.spans()[k];
    if (span.properties.tool_end == End::free) s.end.end(2 * k + 1) = rod_.tip_frame(state, span);
    if (!span.properties.slider) continue;
    // system_->velocity contains the old speed of the travel
    Travel next = s.slide[k].travel;
    const double before = next.way, wanted = before + s.step * (next.speed + travel_change(k));
    next.way = std::clamp(wanted, 0.0, span.properties.slider->stroke);
    const double speed = (next.way - before) / s.step;
    Frame& clamp = s.end.end(2 * k);
    clamp.position += s.step * (speed - next.speed) * tangent(clamp.orientation);
    s.velocity[2 * k] = (clamp.position - state.clamps.end(2 * k).position) / s.step;
    next.speed = speed;
    state.travel[k] = next;
  }
  for (size_t k = 0; k < rod_.spans().size(); ++k) {
    const Span& span = rod_.spans()[k];
    for (int j = 0; j <= span.segments(); ++j) {
      const int i = span.first_segment + j, link = span.first_link + j;
      const LinkArms& arms = s.arms[link];
      const Vector3 clamp = s.velocity[2 * k + (j > 0)] - state.clamp_velocity[2 * k + (j > 0)];
      const Vector3 none = Vector3::Zero();  // a clamp has no arm, so its rotation does not count
      const Vector3 change = j == 0 ? gap_change(arms, clamp, none, s.change[i].linear(), s.change[i].angular())
                             : j == span.segments()
                                 ? gap_change(arms, s.change[i - 1].linear(), s.change[i - 1].angular(), clamp, none)
                                 : gap_change(arms, s.change[i - 1].linear(), s.change[i - 1].angular(),
                                              s.change[i].linear(), s.change[i].angular());
      state.link_force[link] = s.force[link] + (rod_.gap_stiffness(link) * gap_beta * s.step) * change;
    }
  }
  state.memory.swap(s.memory);
  state.clamps = s.end;
  state.clamp_velocity = s.velocity;
  state.clamp_angular_velocity = s.angular_velocity;
}

}  // namespace dresslife::sim
