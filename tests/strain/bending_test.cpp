// The thesis' bending test (its figures 13 to 15) in numbers: a single signal cable under increasing bending.
#include <cmath>

#include "strain/evaluation.h"
#include "tests/catch.h"
#include "tests/strain/dresspacks.h"

using namespace dresslife::strain;
using namespace test_dresspacks;
using dresslife::pipeline::Kinematics;
using dresslife::pipeline::Slip;

namespace {

constexpr double youngs_modulus = 12e10;  // [Pa], of the thesis' bending test
constexpr std::size_t samples = 81;

/// Curvature from 0 to 0.8 1/m as in figure 13.
double curvature_at(std::size_t t) { return 0.01 * static_cast<double>(t); }

struct Line {
  double slope, determination;  ///< R^2
};

Line fit(const std::vector<double>& stress) {
  double kk = 0, ks = 0, ss = 0, k = 0, s = 0;
  for (std::size_t t = 0; t < samples; ++t) {
    const double curvature = curvature_at(t);
    k += curvature, s += stress[t];
    kk += curvature * curvature, ks += curvature * stress[t], ss += stress[t] * stress[t];
  }
  const double n = samples, cross = ks - k * s / n, curvatures = kk - k * k / n, stresses = ss - s * s / n;
  return {cross / curvatures, cross * cross / (curvatures * stresses)};
}

/// Stress of the wire with the largest strain range of a bent cable.
std::vector<double> worst_stress(Kinematics kinematics, int fibres) {
  Dresspack dresspack;
  dresspack.components = thesis_dresspack().components[0].components;  // the conductors of one cable
  const Construction construction(dresspack, kinematics);
  DeformationHistory history(1, samples);
  for (std::size_t t = 0; t < samples; ++t) history.set(0, t, {curvature_at(t), 0, 0, 0});
  dresslife::pipeline::Strain settings;
  settings.slip = {Slip::stick};
  settings.kinematics = kinematics;
  settings.surface_fibres = fibres;
  Evaluation evaluation(construction, settings, {0.2}, samples);
  evaluation.add({history});
  std::vector<double> stress;
  Sink sink;
  sink.sites = sink.bound_free = sink.bound_stick = [](const SiteRows&) {};
  sink.probe = [&](const Probe& probe) { stress = probe.strain; };
  evaluation.evaluate(0, history, 0, sink);
  for (double& value : stress) value *= youngs_modulus;
  return stress;
}

}  // namespace

TEST_CASE("the stress of the worst wire of a bent cable is proportional to the curvature") {
  for (const Kinematics kinematics : {Kinematics::exact, Kinematics::thesis})
    for (const int fibres : {0, 1}) {
      const Line line = fit(worst_stress(kinematics, fibres));
      CAPTURE(static_cast<int>(kinematics), fibres);
      CHECK(line.determination > 0.99999);
      // E times the effective radius: conductor, wire in it and fibre on it, each bent by its own share of the curvature
      // (see evaluation_test)
      const double c = std::cos(25 * degree), w = std::cos(5 * degree), s = std::sin(25 * degree);
      const bool exact = kinematics == Kinematics::exact;
      const double conductor = c * c * 0.002825;
      const double bend = exact ? std::pow(c, 4) - s * s / 0.002825 * conductor : c * c;
      const double effective = conductor + w * w * 0.00075 * bend + fibres * 75e-6 * w * w * bend;
      // The worst of 7 conductors and 31 wires lies up to half a spacing from the outermost place. Its strain is at least
      // cos(180/7 deg) of the strain there.
      CHECK(std::abs(line.slope) <= youngs_modulus * effective * 1.01);
      CHECK(std::abs(line.slope) >= youngs_modulus * effective * std::cos(180.0 / 7 * degree));
    }
}

TEST_CASE("a bent wire's stretch is far above its own bending") {
  // figure 14 of the thesis: the stretch dominates; the fibre adds its radius times the curvature
  const double with_fibre = std::abs(worst_stress(Kinematics::exact, 1).back());
  const double axis = std::abs(worst_stress(Kinematics::exact, 0).back());
  CHECK(axis > 20 * (with_fibre - axis));
}
