// The path to equilibrium: first guesses along round walls, and full Newton steps.
#include <array>
#include <cmath>

#include "strain/loose/cable_lines.h"
#include "strain/loose/hose_line.h"
#include "tests/catch.h"
#include "tests/strain/loose/hoses.h"

using namespace dresslife::strain;
using dresslife::strain::test::hose;
using dresslife::strain::test::signal_cable;
using Eigen::Vector2d;

namespace {

constexpr double rounding = 1e-14;  // of some products of numbers below 10

/// Returns (path, before, place) of node 1 of three after begin(), for a cable at `at` whose displacement in the last sample
/// is `way`, in the frame `frame`.
std::array<Vector2d, 3> begun(const Vector2d& at, const Vector2d& way, const Vector2d& laid, const Vector2d& frame,
                              bool goes_on = true) {
  constexpr std::size_t nodes = 3;
  constexpr double step = 0.04;
  LaneRows zero, laid_rows, frames, velocity, rest, place, before, path, play, around;
  for (LaneRows* const rows : {&zero, &laid_rows, &frames, &velocity, &rest, &place, &before, &path})
    rows->assign(2 * nodes, most_lanes);
  const auto fill = [](LaneRows& rows, const Vector2d& value) {
    for (std::size_t row = 0; row < 2 * nodes; ++row)
      for (std::size_t k = 0; k < most_lanes; ++k) rows[row * most_lanes + k] = value[row % 2];
  };
  fill(laid_rows, laid), fill(frames, frame), fill(velocity, way / step), fill(path, at);
  play.assign(1, most_lanes), around.assign(2 * nodes, most_lanes);
  LineBatch batch;
  batch.play = play.data(), batch.around = around.data();
  batch.nodes = nodes, batch.lanes = batch.cables = most_lanes;
  batch.rest = rest.data(), batch.place = place.data(), batch.before = before.data(), batch.path = path.data();
  const std::array<double, 2 * nodes> straight{}, unturned{1, 0, 1, 0, 1, 0};
  loose_kernels().begin(batch, {laid_rows.data(), zero.data(), frames.data(), velocity.data()},
                        {unturned.data(), straight.data()}, goes_on ? step : 0);
  const auto of = [](const LaneRows& rows, std::size_t node) {
    return Vector2d(rows[2 * node * most_lanes], rows[(2 * node + 1) * most_lanes]);
  };
  for (const std::size_t clamp : {0, 2}) CHECK(of(path, clamp) == of(place, clamp));
  return {of(path, 1), of(before, 1), of(place, 1)};
}

}  // namespace

TEST_CASE("the first guess goes on along a round wall, in the frame of the cable") {
  const Vector2d at(3, 4), unturned(1, 0), laid(2, 1);  // 5 from the axis
  const auto guess = [&](const Vector2d& before) { return begun(at, at - before, laid, unturned)[0]; };
  // The distance from the axis continues linearly. The direction is that of the straight continuation.
  for (const double distance : {4.5, 5.0, 5.3}) {
    const Vector2d before = distance * Vector2d(std::cos(0.8), std::sin(0.8)), straight = 2 * at - before;
    const Vector2d found = guess(before);
    CHECK(found.norm() == Approx(2 * 5 - distance).epsilon(rounding));
    CHECK(found.normalized().dot(straight.normalized()) == Approx(1).epsilon(rounding));
  }
  // The guess is the straight continuation if this ends nearer to the axis than half the distance, or if the linear
  // distance would be negative.
  CHECK((guess({4, 6.8}) - Vector2d(2, 1.2)).norm() < rounding * 5);
  CHECK((guess({-8, 7}) - Vector2d(14, 1)).norm() < rounding * 14);
  // A cable at rest stays at its place. A cable that begins also stays.
  CHECK((guess(at) - at).norm() < rounding * 5);
  CHECK(begun(at, {1, 1}, laid, unturned, false)[0] == at);
  // The whole guess turns with the frame.
  const Vector2d frame(0.8, 0.6);
  const auto plain = begun(at, {-0.4, 0.3}, laid, unturned), in_frame = begun(at, {-0.4, 0.3}, laid, frame);
  CHECK(plain[1] == at);
  CHECK(plain[2] == laid);
  for (std::size_t k = 0; k < 3; ++k) CHECK((in_frame[k] - turned(plain[k], frame)).norm() < rounding * 5);
}

TEST_CASE("steps of at most a millimetre are taken whole, and longer ones stop where nodes meet a wall") {
  // Without stiffness each node moves alone: by m w / drag in free space, and by m w / (drag + stiffness of the wall) inside the
  // wall. Full steps find the wall, then the place in it, then that the node is at rest: three. The wall is at a different
  // share of each node's displacement, so shorter steps need more iterations.
  constexpr double step = 0.04, room = 1e-4;
  const auto iterations = [&](double longest_way) {
    LooseCable cable = signal_cable(0.01);
    cable.axial_stiffness = cable.bending_stiffness = 1e-9;
    cable.farthest = 0.01 + room;
    LooseCables cables({cable}, {2, 32});
    cables.advance(hose(32, [](double) { return HoseNode(); }), step);
    const std::size_t before = cables.iterations();
    const double pull = longest_way * cable.drag / step / cable.mass_per_length;
    cables.advance(hose(32, [&](double z) { return HoseNode{.pull = {pull * (0.3 + 0.7 * z), 0}}; }), step);
    for (std::size_t i = 1; i < 32; ++i) CHECK(cables.state(0).offset[2 * i] == Approx(room).epsilon(0.01));
    return cables.iterations() - before;
  };
  CHECK(iterations(0.97e-3) == 3);
  CHECK(iterations(1.07e-3) > 3);
}
