// The strain of a corrugated wall: closed forms, the makers' formula, and a beam integrated numerically.
#include "pipeline/cable/corrugation.h"

#include <cmath>

#include "pipeline/base/constants.h"
#include "tests/catch.h"

using namespace dresslife;
using namespace dresslife::pipeline;

namespace {

pipeline::Dresspack hose(double pitch, double height, double wall) {
  pipeline::Dresspack dresspack;
  dresspack.diameter = 0.06;
  dresspack.hose_corrugation = pipeline::Corrugation{pitch, height, wall, {}};
  return dresspack;
}

/// Computes the factors numerically: a polyline through one corrugation, bent by F = 1 along the hose.
struct Polyline {
  double factor, length;
};
Polyline polyline(double pitch, double height, double wall) {
  const double w = height - wall, r = pitch / 4, a = w / 2 - r;
  double work = 0, length = 0;
  constexpr int pieces = 20000;
  const double quarter = a + r * pi / 2, piece = quarter / pieces;
  for (int k = 0; k < pieces; ++k) {
    const double s = (k + 0.5) * piece;
    const double y = s < a ? s : a + r * std::sin((s - a) / r);
    work += y * y * piece;
    length += piece;
  }
  const double stretch = 4 * work;  // times F / D
  return {(w / 2) * (wall / 2) / (stretch / pitch), 4 * length};
}

}  // namespace

TEST_CASE("a corrugation's strain is that of a folded beam") {
  constexpr double trapezium = 1e-6;
  for (const auto [pitch, height, wall] :
       {std::array{5e-3, 4.5e-3, 0.8e-3}, std::array{4e-3, 2.5e-3, 0.4e-3}, std::array{2e-3, 6e-3, 0.3e-3}}) {
    const WallFactors factors = wall_factors(hose(pitch, height, wall));
    const Polyline beam = polyline(pitch, height, wall);
    CHECK(factors.strain == Approx(beam.factor).epsilon(trapezium));
    CHECK(factors.shear == Approx(pitch / beam.length).epsilon(trapezium));
    CHECK(factors.radius == Approx(0.03 - height / 2));
    CHECK(factors.strain < 1);  // the purpose of corrugations
  }
}

TEST_CASE("a corrugation's strain follows the bellows makers' formula") {
  // S6 = 5 E t e / (3 w^2 C_d): with crests of zero radius C_d = 1, and E is E / (1 - 0.3^2).
  const double t = 1e-5, w = 10e-3, narrow = 1e-4;
  const WallFactors flat = wall_factors(hose(narrow, w + t, t));
  constexpr double plate = 1 - 0.3 * 0.3;
  constexpr double crests = 0.03;  // r / w = 1/400, with an effect of first order
  CHECK(flat.strain / (t * narrow / (w * w)) == Approx(5.0 / 3 * plate).epsilon(crests));
  // A printed example of this formula: pitch 1 in, w 1.095 in, t 0.03 in has C_d = 1.63 from the chart.
  const double inch = 0.0254;
  pipeline::Dresspack bellows = hose(inch, (1.095 + 0.03) * inch, 0.03 * inch);
  bellows.diameter = 38 * inch;
  const double chart = 5.0 / 3 * plate * 0.03 / (1.095 * 1.095 * 1.63);
  constexpr double shell = 0.06;  // difference of the chart's shell theory and the beam
  CHECK(wall_factors(bellows).strain == Approx(chart).epsilon(shell));
}

TEST_CASE("a hose without a profile is smooth, or has the factor that is given") {
  pipeline::Dresspack dresspack;
  dresspack.diameter = 0.06;
  CHECK(wall_factors(dresspack).strain == 1);
  CHECK(wall_factors(dresspack).radius == 0.03);
  dresspack.hose_strain_factor = 0.3;
  CHECK(wall_factors(dresspack).strain == 0.3);
  CHECK(wall_factors(dresspack).shear == 0.3);
}
