// Logarithm, exponential and the map from angular velocity to the link's rotation vector.
#include "sim/rod/rotation.h"

#include <numbers>

#include "sim/rod/link.h"
#include "tests/catch.h"

using namespace dresslife::sim;

TEST_CASE("log undoes exp for every turn below half a turn") {
  const double rounding = 1e-14;
  const Vector3 axis = Vector3(0.3, -0.8, 0.5).normalized();
  for (const double angle : {0.0, 1e-12, 1e-9, 1e-5, 0.0099, 0.0101, 0.5, 2.0, 3.1}) {
    CAPTURE(angle);
    const Vector3 r = angle * axis;
    CHECK((rotation_vector(rotation(r)) - r).norm() < rounding);
    const Quaternion expected(Eigen::AngleAxisd(angle, axis));
    CHECK((rotation(r).coeffs() - expected.coeffs()).norm() < rounding);
  }
}

TEST_CASE("the turn between two directions is the smallest, up to half a turn") {
  const double rounding = 1e-12;        // 1e-16 / (1 + cosine), which is 8e-4 where the rotation is not split in two
  const double turned_in_two = 1.4e-6;  // [rad] below half a turn; there cosines differ from -1 by 1e-12
  const Vector3 from(0.3, -0.8, 0.5), across = from.unitOrthogonal();
  for (const double less : {std::numbers::pi, std::numbers::pi - 1e-9, 2.0, 1.0, 0.04, 1e-7, 0.0}) {
    CAPTURE(less);
    const double angle = std::numbers::pi - less;
    const Vector3 to = Quaternion(Eigen::AngleAxisd(angle, across)) * (2 * from);
    const Quaternion turn = turn_between(from, to);
    CHECK((turn * from - to / 2).norm() < rounding);
    CHECK(std::abs(turn.w() - std::cos(angle / 2)) < (less < turned_in_two ? turned_in_two / 2 : rounding));
    CHECK(turn.norm() == Approx(1).epsilon(rounding));
  }
}

TEST_CASE("the tangent is the rotated z axis and a roll leaves it alone") {
  const Frame frame{{1, 2, 3}, rotation({0.4, -1.1, 0.7})};
  CHECK((tangent(frame.orientation) - frame.orientation * Vector3::UnitZ()).norm() < 1e-15);
  CHECK((tangent(rolled(frame, 1.3).orientation) - tangent(frame.orientation)).norm() < 1e-15);
}

TEST_CASE("a link's turn alone is that of its whole state") {
  RodProperties p;
  p.segments = 4, p.length = 1, p.mass_per_length = 1, p.diameter = 0.05;
  p.bending_stiffness = p.torsional_stiffness = 1, p.axial_stiffness = 1e4;
  RodProperties hanging = p;
  hanging.tool_end = End::free;
  const Rod rod(std::vector<RodProperties>{p, hanging});
  RodState state = rod.straight(Frame{});
  for (int i = 0; i < rod.segments(); ++i) state.orientation[i] = rotation(Vector3(0.2 * i, -0.3, 0.1 * i * i));
  state.clamps.end(1).orientation = rotation({0.3, 0, 0});
  state.clamps.end(2).orientation = rotation({0, 0.4, 0});
  for (int j = 0; j < rod.links(); ++j) CHECK(rod.turn(state, j) == rod.link_state(state, j).turn);
  CHECK(rod.turn(state, rod.links() - 1) == Vector3::Zero());
}

TEST_CASE("a link's map G gives the rate of its rotation vector") {
  // Central differences of log(R_a^T R_b) while the second body rotates: their error is of order step^2.
  const double step = 1e-5, tolerance = 1e-9;
  const Quaternion a = rotation({0.2, 0.9, -0.4});
  for (const double size : {1e-3, 0.1, 0.29, 0.31, 1.0, 2.5}) {
    CAPTURE(size);
    const Quaternion b = a * rotation(size * Vector3(0.6, -0.48, 0.64));
    const LinkTurn turn = link_turn(a, b);
    for (int k = 0; k < 3; ++k) {
      const Vector3 spin = step * Vector3::Unit(k);
      const Vector3 rate = (link_turn(a, rotation(spin) * b).phi - link_turn(a, rotation(-spin) * b).phi) / (2 * step);
      CHECK((turn.map.transpose().col(k) - rate).norm() < tolerance);
    }
    const Matrix3 square =
        turn.stretch * turn.stretch * Matrix3::Identity() + turn.axis_excess * turn.axis * turn.axis.transpose();
    CHECK((turn.map * turn.map.transpose() - square).norm() < 1e-13);
  }
}
