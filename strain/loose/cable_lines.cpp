#include "strain/loose/cable_lines.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace dresslife::strain {

using Eigen::Vector2d;

CableLines::CableLines(const std::vector<LooseCable>& cables, const HoseLine& hose, double rest_curvature, Use use)
    : cables_(cables), rest_curvature_(rest_curvature) {
  assert(!cables.empty());
  batch_.nodes = hose.nodes();
  batch_.lanes = (cables.size() + most_lanes - 1) / most_lanes * most_lanes;
  batch_.cables = cables.size();
  batch_.length = hose.length;
  batch_.spacing = hose.spacing;
  lane_rows_.assign(OfLane::lane_rows, batch_.lanes);
  for (LaneRows& rows : node_rows_) rows.assign(2 * batch_.nodes, batch_.lanes);
  gain_.assign(batch_.nodes - 1, batch_.lanes);
  if (use == Use::presses) press_.assign(batch_.nodes, batch_.lanes);
  iterations_.assign(count(), 0);
  for (std::size_t k = 0; k < batch_.lanes; ++k) lay(k);
  for (std::size_t k = 0; k < count(); ++k) tensions_.emplace_back(cables_[k], laid_gain(k));
  for (std::size_t k = 0; k < batch_.lanes; ++k) {
    const LooseCable& cable = cables_[k < count() ? k : 0];
    const Vector2d a0(cable.place[0], cable.place[1]);
    of_lane(bending_stiffness, k) = cable.bending_stiffness;
    of_lane(axial_stiffness, k) = cable.axial_stiffness;
    of_lane(mass_per_length, k) = cable.mass_per_length;
    of_lane(wall_stiffness, k) = cable.wall_stiffness;
    of_lane(play, k) = cable.play;
    of_lane(farthest, k) = cable.farthest;
    of_lane(nearest, k) = cable.nearest;
    of_lane(gap, k) = cable.gap;
    of_lane(per_radius, k) = a0.norm() > 0 ? 1 / a0.norm() : 0;
    of_lane(friction, k) = cable.friction;
    of_lane(line_load, k) = cable.line_load;
    of_lane(counts, k) = k < count() ? 1 : 0;
    for (std::size_t i = 0; i < batch_.nodes; ++i) put(path, i, k, vector(laid, i, k));
  }
  point_at_rows();
  if (use == Use::turns) batch_.place = nullptr;
}

void CableLines::point_at_rows() {
  const auto lanes = [&](OfLane row) { return &of_lane(row, 0); };
  const auto nodes = [&](OfNode row) { return node_rows_[row].data(); };
  batch_.bending_stiffness = lanes(bending_stiffness), batch_.axial_stiffness = lanes(axial_stiffness);
  batch_.mass_per_length = lanes(mass_per_length), batch_.wall_stiffness = lanes(wall_stiffness);
  batch_.play = lanes(play), batch_.farthest = lanes(farthest), batch_.nearest = lanes(nearest);
  batch_.gap = lanes(gap), batch_.per_radius = lanes(per_radius), batch_.drag = lanes(drag);
  batch_.friction = lanes(friction), batch_.line_load = lanes(line_load), batch_.stick = lanes(stick);
  batch_.around = nodes(around), batch_.stretch = nodes(stretch), batch_.most_friction = nodes(most_friction);
  batch_.free_length_rate = lanes(free_length_rate), batch_.slipped = lanes(slipped);
  batch_.least_strain = lanes(least_strain), batch_.most_strain = lanes(most_strain), batch_.counts = lanes(counts);
  batch_.strain = lanes(strain), batch_.tension = lanes(tension), batch_.stiffness = lanes(stiffness);
  batch_.rest = nodes(rest), batch_.place = nodes(place_at), batch_.before = nodes(before), batch_.path = nodes(path);
  batch_.press = press_.data();
}

Vector2d CableLines::vector(OfNode row, std::size_t node, std::size_t k) const {
  const double* const at = node_rows_[row].data() + 2 * node * batch_.lanes + k;
  return {at[0], at[batch_.lanes]};
}

void CableLines::put(OfNode row, std::size_t node, std::size_t k, const Vector2d& value) {
  double* const at = node_rows_[row].data() + 2 * node * batch_.lanes + k;
  at[0] = value.x();
  at[batch_.lanes] = value.y();
}

/// Sets the place of a cable. A place without lay keeps its exact numbers, which a turn by 0 would not.
void CableLines::lay(std::size_t k) {
  const LooseCable& cable = cables_[k < count() ? k : 0];
  const Vector2d a0(cable.place[0], cable.place[1]);
  const std::size_t last = batch_.nodes - 1;
  const double inverse = 1 / (batch_.spacing * batch_.spacing);
  for (std::size_t i = 0; i <= last; ++i) {
    const double angle = cable.lay_rate * static_cast<double>(i) * batch_.spacing;
    put(laid, i, k, angle == 0 ? a0 : turned(a0, {std::cos(angle), std::sin(angle)}));
  }
  for (std::size_t i = 0; i <= last; ++i) {  // mirror image beyond a clamp
    const Vector2d one = vector(laid, i > 0 ? i - 1 : 1, k), other = vector(laid, i < last ? i + 1 : last - 1, k);
    put(laid_bent, i, k, inverse * (one - 2 * vector(laid, i, k) + other));
  }
}

/// Returns the mean gain of cable k's place in the hose in which it was laid.
double CableLines::laid_gain(std::size_t k) const {
  const double inverse = 1 / (batch_.spacing * batch_.spacing);
  double sum = 0;
  for (std::size_t i = 1; i < batch_.nodes; ++i) {
    const Vector2d one = vector(laid, i - 1, k), other = vector(laid, i, k);
    sum += -rest_curvature_ * (one.x() + other.x()) / 2 + (other - one).squaredNorm() * inverse / 2;
  }
  return sum / static_cast<double>(batch_.nodes - 1);
}

void CableLines::go_on_from(const CableLines& other) {
  assert(count() == other.count() && batch_.nodes == other.batch_.nodes);
  for (const OfNode row : {path, velocity, stretch, most_friction})
    std::copy_n(other.node_rows_[row].data(), 2 * batch_.nodes * batch_.lanes, node_rows_[row].data());
  for (std::size_t k = 0; k < count(); ++k) tensions_[k].go_on_from(other.tensions_[k]);
  iterations_ = other.iterations_;
}

void CableLines::feed_in(double share) {
  for (CableTension& pulled : tensions_) pulled.feed_in(share);
}

namespace {

HoseFrame frame_of(const HoseLine& hose) { return {hose.turn.front().data(), hose.rest.front().data()}; }

}  // namespace

LineMemory CableLines::memory() {
  return {node_rows_[laid].data(), node_rows_[laid_bent].data(), node_rows_[frame_at].data(),
          node_rows_[velocity].data()};
}

LineAnswer CableLines::answer() {
  return {node_rows_[bends].data(), node_rows_[hose_bends].data(), node_rows_[offset].data(), gain_.data(),
          &of_lane(mean_gain, 0),   &of_lane(bent_sum, 0),         &of_lane(missed_sum, 0)};
}

void CableLines::carry(const std::vector<double>& radii, const std::vector<double>& turned) {
  for (std::size_t i = 0; i < batch_.nodes; ++i) {
    double* const around_hose = node_rows_[stretch].data() + 2 * i * batch_.lanes;
    for (std::size_t k = 0; k < radii.size(); ++k) around_hose[k] += radii[k] * turned[i];
  }
}

void CableLines::take_friction(const CableLines& from, std::span<const std::size_t> numbers) {
  for (const OfNode row : {stretch, most_friction})
    for (std::size_t i = 0; i < batch_.nodes; ++i) {
      double* const to = node_rows_[row].data() + 2 * i * batch_.lanes;
      const double* const other = from.node_rows_[row].data() + 2 * i * from.batch_.lanes;
      for (std::size_t k = 0; k < numbers.size(); ++k) to[k] = other[numbers[k]];
    }
}

void CableLines::begin(const HoseLine& hose, std::span<const Frame* const> frames, double time, bool goes_on,
                       bool rubs) {
  batch_.curvature = hose.curvature.front().data();
  batch_.pull = hose.pull.front().data();
  batch_.elongation = hose.elongation.data();
  for (std::size_t k = 0; k < batch_.lanes; ++k) {
    const std::size_t cable = k < count() ? k : 0;
    const CableTension& pulled = tensions_[cable];
    const bool dry = rubs && cables_[cable].friction > 0;
    of_lane(drag, k) = (dry ? LooseCable::drag_beside_friction : 1) * cables_[cable].drag / time;
    of_lane(stick, k) = dry ? LooseCable::stick_stiffness : 0;
    of_lane(free_length_rate, k) = pulled.free_length_rate();
    of_lane(slipped, k) = pulled.slipped();
    of_lane(most_strain, k) = pulled.most_strain();
    of_lane(least_strain, k) = -pulled.most_strain();
  }
  const auto frame_of_lane = [&](std::size_t k) { return frames[k < count() ? k : 0]; };
  for (std::size_t k = 0, end = 0; k < batch_.lanes; k = end) {  // neighbours in one frame
    while (end < batch_.lanes && frame_of_lane(end) == frame_of_lane(k)) ++end;
    for (std::size_t i = 0; i < batch_.nodes; ++i)
      for (std::size_t d = 0; d < 2; ++d)
        std::fill_n(node_rows_[frame_at].data() + (2 * i + d) * batch_.lanes + k, end - k,
                    (*frame_of_lane(k))[i][static_cast<Eigen::Index>(d)]);
  }
  loose_kernels().begin(batch_, memory(), frame_of(hose), goes_on ? time : 0);
}

void CableLines::place(const Frame& frame) {
  loose_kernels().place(batch_, node_rows_[laid].data(), frame.front().data());
}

void CableLines::turn(const Frame& frame, const std::vector<double>& turned, const RingSystem& system) {
  loose_kernels().turn(batch_, node_rows_[laid].data(), frame.front().data(), turned.data(), system);
}

Vector2d bend_at_clamp(const Vector2d& at_clamp, const Vector2d& next, const Vector2d& after_next, double q) {
  // B' = second difference / (1 - r)^2 and (1 - r)^2 = q r; sqrt(1 + q/4) - 1 is computed without a difference of equal numbers
  const double root = std::sqrt(1 + q / 4), per_r = 1 + q / 2 + std::sqrt(q) * root;
  return at_clamp + per_r / (4 * (root + 1)) * (at_clamp - 2 * next + after_next);
}

void CableLines::put_state(const HoseLine& hose, std::size_t k, CableState& state) const {
  const std::size_t nodes = hose.nodes();
  state.gain.resize(nodes - 1);
  for (std::size_t i = 0; i + 1 < nodes; ++i) state.gain[i] = gain_[i * batch_.lanes + k];
  state.tension.assign(nodes - 1, cables_[k].axial_stiffness * state.strain);
  state.press.resize(batch_.press ? nodes : 0);
  state.offset.resize(2 * nodes);
  state.curvature.resize(2 * nodes);
  for (std::size_t i = 0; i < nodes; ++i) {
    if (batch_.press) state.press[i] = press_[i * batch_.lanes + k];
    const Vector2d of_hose = vector(hose_bends, i, k), from_place = vector(offset, i, k);
    state.curvature[2 * i] = -of_hose.y();
    state.curvature[2 * i + 1] = of_hose.x() + rest_curvature_;
    state.offset[2 * i] = from_place.x();
    state.offset[2 * i + 1] = from_place.y();
  }
  const double q = std::max(0.0, cables_[k].axial_stiffness * state.strain) * std::pow(hose.spacing, 2) /
                   cables_[k].bending_stiffness;
  for (const std::size_t clamp : {0, 1}) {
    const std::size_t at = clamp == 0 ? 0 : nodes - 1, next = clamp == 0 ? 1 : nodes - 2,
                      after = clamp == 0 ? 2 : nodes - 3;
    const Vector2d of_hose = turned_back(
        bend_at_clamp(vector(bends, at, k), vector(bends, next, k), vector(bends, after, k), q), hose.turn[at]);
    state.clamped[2 * clamp] = -of_hose.y();
    state.clamped[2 * clamp + 1] = of_hose.x() + rest_curvature_;
  }
}

/// Cables that cannot slip have nothing to store without states.
void CableLines::end(const HoseLine& hose, double time, std::span<CableState> states, bool whole) {
  const bool slip = std::ranges::any_of(tensions_, &CableTension::slips);
  if (!states.empty() || slip) loose_kernels().follow(batch_, answer());
  for (std::size_t k = 0; k < count() && (!states.empty() || slip); ++k) {
    const double settled = tensions_[k].settle(of_lane(mean_gain, k));
    if (!states.empty()) states[k].strain = settled;
  }
  if (!states.empty()) {
    const bool dry = std::ranges::any_of(cables_, [](const LooseCable& cable) { return cable.friction > 0; });
    loose_kernels().put_states(batch_, memory(), frame_of(hose), answer());
    if (dry || (whole && batch_.press)) loose_kernels().rub(batch_);
    for (std::size_t k = 0; k < count() && whole; ++k) put_state(hose, k, states[k]);
  }
  loose_kernels().end(batch_, memory(), time);
}

}  // namespace dresslife::strain
