// Straight cables under tension and twist, against unrolled helices and curves in space.
#include "pipeline/cable/cable_pull.h"

#include <cmath>

#include "pipeline/base/constants.h"
#include "pipeline/cable/cable_bending.h"
#include "pipeline/cable/cable_force.h"
#include "pipeline/cable/plain_properties.h"
#include "tests/catch.h"
#include "tests/pipeline/cable/space_curve.h"

using namespace dresslife;
using namespace dresslife::pipeline;

namespace {

constexpr double modulus = 117e9, rounding = 1e-12;

Dresspack copper_only() {
  Dresspack dresspack;
  Material copper;
  copper.name = "copper", copper.youngs_modulus = modulus, copper.poisson_ratio = 0.34;
  dresspack.materials = {copper};
  return dresspack;
}

Component part(int count, double radius, double helix_radius, double lay_angle, Hand hand = Hand::right) {
  Component one;
  one.name = "part";
  one.count = count, one.radius = radius, one.helix_radius = helix_radius, one.lay_angle = lay_angle, one.hand = hand;
  one.material = "copper";
  return one;
}

Component holding(Component outer, std::vector<Component> inner) {
  outer.material.clear();
  outer.components = std::move(inner);
  return outer;
}

/// Returns the length of an unrolled helix, divided by its undeformed length.
double unrolled(double R, double a, double elongation, double twist) {
  return std::hypot(std::cos(a) * (1 + elongation), std::sin(a) + std::cos(a) * R * twist);
}

}  // namespace

TEST_CASE("cable pull: a layer's wires strain as unrolled helices do, and each layer adds its pull") {
  const Dresspack dresspack = copper_only();
  const double r = 1e-4, R = 2e-3, a = 0.3, area = pi * r * r, elongation = 2e-3;
  double sum = 0;
  for (const Hand hand : {Hand::right, Hand::left})
    for (const double twist : {-4.0, 0.0, 4.0}) {
      const double strain = unrolled(R, sign_of(hand) * a, elongation, twist) - 1;
      const double pull = pull_of_wires(dresspack, {part(12, r, R, a, hand)}, elongation, twist);
      CAPTURE(twist);
      CHECK(pull == Approx(12 * modulus * area * std::cos(a) * strain).epsilon(1e-9));  // rounding of a strain of 1e-3
      if (twist > 0) sum += pull;
    }
  CHECK(pull_of_wires(dresspack, {part(12, r, R, a), part(12, r, R, a, Hand::left)}, elongation, 4) ==
        Approx(sum).epsilon(rounding));
  // On a soft bed a helix keeps 1 / (1 + E A sin^4(a) / (R^2 k)) of any strain (W31). A part on the axis has no bed.
  Component soft = part(12, r, R, a), straight = part(1, r, 0, 0);
  soft.radial_stiffness = straight.radial_stiffness = 2e5;
  const double left = 1 / (1 + modulus * area * std::pow(std::sin(a), 4) / (R * R * 2e5));
  REQUIRE(left < 0.8);
  for (const double twist : {-4.0, 0.0, 4.0})
    CHECK(pull_of_wires(dresspack, {soft}, elongation, twist) ==
          Approx(left * pull_of_wires(dresspack, {part(12, r, R, a)}, elongation, twist)).epsilon(1e-9));
  CHECK(pull_of_wires(dresspack, {straight}, elongation, 4) == Approx(modulus * area * elongation));
  // E A of the cable and its force include the bed, to second order in the strain of 1e-6.
  const Component cable = holding(part(1, 4e-3, 0, 0), {soft, straight});
  CHECK(axial_stiffness(dresspack, cable) == Approx(modulus * area * (1 + 12 * left * std::pow(std::cos(a), 3))));
  CHECK(CableForce(dresspack, cable).force(1e-6) ==
        Approx(pull_of_wires(dresspack, cable.components, 1e-6, 0)).epsilon(1e-5));
  // A soft bed reduces the shortening of a cable that is twisted about a straight wire.
  CHECK(-elongation_under(dresspack, {straight, soft}, 0, 4) <
        -0.9 * elongation_under(dresspack, {straight, part(12, r, R, a)}, 0, 4));
  CHECK(pull_of_wires(dresspack, {part(1, r, 0, 0)}, elongation, 4) == Approx(modulus * area * elongation));
  Component unknown = part(1, r, 0, 0);
  unknown.material = "polymer without a name";
  CHECK(pull_of_wires(dresspack, {unknown}, elongation, 0) == 0);
}

TEST_CASE("cable pull: wires in strands in layers strain as curves in space do") {
  // The strand's bending is neglected. It strains a wire by at most r sin(a)^2 / R of the strain from twist and stretch.
  const Dresspack dresspack = copper_only();
  const double r = 1e-4, R = 8e-3, a = 0.25, inner = 1.5e-4, b = 0.35, elongation = 1e-3, bent = 2e-3;
  const Component cable = holding(part(3, 3e-4, R, a, Hand::left), {part(5, r, inner, b)});
  for (const double twist : {-6.0, 5.0}) {
    double strain = 0;
    constexpr int phases = 16;
    for (int k = 0; k < phases; ++k) {
      const std::vector<space_curve::Level> levels{{R, -a, 0}, {inner, b, 2 * pi * k / phases}};
      const space_curve::Curves now{1 + elongation, {0, 0, twist}, levels}, rest{1, {0, 0, 0}, levels};
      strain += static_cast<double>(now.stretch_of_last() / rest.stretch_of_last() - 1) / phases;
    }
    const double expected = 15 * modulus * pi * r * r * std::cos(a) * std::cos(b) * strain;
    CHECK(pull_of_wires(dresspack, {cable}, elongation, twist) == Approx(expected).epsilon(bent));
  }
  // A strand on the axis does not change the result. Neither does a core that is the whole strand.
  const double straight = pull_of_wires(dresspack, {part(5, r, inner, b)}, elongation, 5);
  CHECK(pull_of_wires(dresspack, {holding(part(1, 3e-4, 0, 0), {part(5, r, inner, b)})}, elongation, 5) ==
        Approx(straight).epsilon(rounding));
  const double laid = pull_of_wires(dresspack, {part(3, r, R, a)}, elongation, 5);
  CHECK(pull_of_wires(dresspack, {holding(part(3, r, R, a), {part(1, r, 0, 0)})}, elongation, 5) ==
        Approx(laid).epsilon(1e-9));
}

TEST_CASE("cable pull: the elongation under a pull is its inverse, and a twisted layer shortens by Pythagoras") {
  const Dresspack dresspack = copper_only();
  const double R = 2e-3, a = 0.3;
  const std::vector<Component> layers{part(12, 1e-4, R, a), part(6, 1e-4, 1e-3, 0.2, Hand::left), part(1, 1e-4, 0, 0)};
  for (const double twist : {-10.0, 0.0, 30.0})
    for (const double elongation : {-0.3, -1e-3, 0.0, 2e-3, 0.4}) {
      const double pull = pull_of_wires(dresspack, layers, elongation, twist);
      CHECK(elongation_under(dresspack, layers, pull, twist) == Approx(elongation).margin(1e-9));
    }
  for (const Hand hand : {Hand::right, Hand::left}) {
    const Component cable = holding(part(1, 3e-3, 0, 0), {part(12, 1e-4, R, a, hand)});
    // sqrt(1 - (sin a + R t cos a)^2) = cos a (1 - shortening)
    const auto shortening = [&](double twist) {
      const double across = std::sin(sign_of(hand) * a) + R * twist * std::cos(a);
      return 1 - std::sqrt(1 - across * across) / std::cos(a);
    };
    const TwistShortening of = twist_shortening(dresspack, cable);
    for (const double twist : {-1.0, 1.0}) CHECK(of.at(twist) == Approx(shortening(twist)).epsilon(1e-9));
    CHECK(of.linear == Approx(sign_of(hand) * R * std::tan(a)).epsilon(1e-4));  // the cubic: (R t)^2
    CHECK(of.quadratic == Approx(R * R / 2 / std::pow(std::cos(a), 2)).epsilon(1e-4));
    CHECK(of.at(20) == Approx(of.linear * 20 + of.quadratic * 400));
  }
  Component empty = holding(part(1, 3e-3, 0, 0), {});
  CHECK(twist_shortening(dresspack, empty).linear == 0);
  CHECK(twist_shortening(dresspack, empty).quadratic == 0);
}

TEST_CASE("cable pull: the hose's bending stiffness is its own, or that of wires, cables and plain parts added up") {
  Dresspack dresspack = copper_only();
  const Component wire = part(7, 2e-4, 1e-3, 0.2);
  dresspack.components = {wire};
  const double of_wires = 7 * modulus * pi / 4 * std::pow(2e-4, 4);
  CHECK(bending_stiffness(dresspack) == Approx(of_wires));
  Component hose = part(2, 5e-3, 0.01, 0);
  hose.plain = PlainPart{};
  hose.plain->bending_stiffness = 0.03;
  const Component cable = holding(part(3, 3e-3, 0.01, 0.1), {part(4, 1e-4, 1e-3, 0.2)});
  dresspack.components = {wire, hose, cable};
  CHECK(bending_stiffness(dresspack) ==
        Approx(of_wires + 2 * properties_of(*hose.plain, hose.radius).bending + 3 * cable_stiffness(dresspack, cable)));
  dresspack.bending_stiffness = 5;
  CHECK(bending_stiffness(dresspack) == 5);
}
