#include "sim/rod/start_curve.h"

#include "tests/sim/rod/rod_problems.h"

using namespace dresslife::sim;
using namespace dresslife::sim::test;

TEST_CASE("start curve: segments point along it, evenly twisted from the one clamp to the other") {
  const int n = 40;
  const double roll = 0.8;
  const Rod rod(hose(n));
  ClampFrames clamps{planar_frame(0, 1, 0), planar_frame(1.4, 1, 0)};
  clamps.tool.orientation = clamps.tool.orientation * Quaternion(Eigen::AngleAxisd(roll, Vector3::UnitZ()));
  const StartCurve curve = start_curve(rod, clamps);
  CHECK(curve.roll_to_tool == Approx(roll).epsilon(1e-9));
  const RodState& state = curve.state;
  for (int i = 0; i < n; ++i) {
    CAPTURE(i);
    // In a plane, transported frames have no twist: only the twist turns the second axis away from the plane's normal.
    CHECK((state.orientation[i] * Vector3::UnitX()).y() == Approx(std::sin(roll * (i + 0.5) / n)).margin(1e-9));
    if (i == 0 || i == n - 1) continue;
    const Vector3 along = (state.position[i + 1] - state.position[i - 1]).normalized();
    CHECK((state.orientation[i] * Vector3::UnitZ()).dot(along) > 0.99);  // neighbours turn by less than 8 deg
  }
}
