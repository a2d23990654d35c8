// The bounds hold the wires that live shortest, not only those with the largest range.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "fatigue/damage.h"
#include "strain/evaluation.h"
#include "tests/strain/dresspacks.h"

using namespace dresslife::strain;
using namespace test_dresspacks;
using dresslife::pipeline::Kinematics;
using dresslife::pipeline::MeanStress;
using dresslife::pipeline::Slip;
using dresslife::pipeline::Stress;

namespace {

constexpr std::size_t segments = 6, samples = 1200;

/// A hose held bent to one side, which swings about that; some segments are pulled as well.
DeformationHistory moving() {
  DeformationHistory history(segments, samples);
  for (std::size_t i = 0; i < segments; ++i)
    for (std::size_t t = 0; t < samples; ++t) {
      const double x = (i + 0.5) / segments, y = 0.03 * t;
      history.set(
          i, t,
          {3 * std::sin(5 * x) + (1 + x) * std::sin(0.7 * y), 2 * std::cos(3 * x) + std::cos(1.1 * y + x),
           2 * std::sin(0.3 * y + x), 3e-3 * x + 1e-4 * std::sin(y)});
    }
  return history;
}

struct Shortest {
  double damage = -1;
  std::string component;
  int segment = -1;
};

struct Lives {
  Shortest sites, stick, free;
};

Lives lives_of(Slip slip, Stress stress) {
  dresslife::pipeline::Material copper;  // S. Backman's thesis (2018), table 2
  copper.youngs_modulus = 117e9;
  copper.fatigue_strength = 983e6;
  copper.fatigue_strength_exponent = -0.112;
  copper.fatigue_ductility = 2.43;
  copper.fatigue_ductility_exponent = -0.6;
  dresslife::pipeline::Fatigue fatigue_settings;
  fatigue_settings.stress = stress;
  fatigue_settings.mean_stress = MeanStress::swt;
  const dresslife::fatigue::DamageCounter counter(copper, fatigue_settings);
  dresslife::fatigue::DamageCounter::Workspace workspace;

  Dresspack dresspack = thesis_dresspack();
  dresspack.components[0].count = 3;
  const Construction construction(dresspack, Kinematics::exact);
  dresslife::pipeline::Strain settings;
  settings.slip = {slip};
  settings.gate = 1e-4;
  const DeformationHistory history = moving();
  Evaluation evaluation(construction, settings, std::vector<double>(segments, 2.0 / segments), samples);
  evaluation.add(history);
  Lives lives;
  auto keep_shortest = [&](Shortest& shortest) {
    return [&](const SiteRows& rows) {
      std::size_t first = 0;
      for (std::size_t site = 0; site < rows.segment.size(); first += rows.turning[site++]) {
        const double damage = counter(std::span(rows.strain).subspan(first, rows.turning[site]), workspace);
        if (damage > shortest.damage) shortest = {damage, rows.component[site], rows.segment[site]};
      }
    };
  };
  Sink sink;
  sink.sites = keep_shortest(lives.sites);
  sink.bound_stick = keep_shortest(lives.stick);
  sink.bound_free = keep_shortest(lives.free);
  sink.probe = [](const Probe&) {};
  for (std::size_t i = 0; i < segments; ++i) evaluation.evaluate(i, history, i, sink);
  return lives;
}

void check_agree(const Shortest& bound, const Shortest& of_all, double tolerance) {
  CAPTURE(bound.component, of_all.component);
  CHECK(bound.damage == Approx(of_all.damage).epsilon(tolerance));
  CHECK(bound.segment == of_all.segment);
}

}  // namespace

TEST_CASE("a bound's shortest life is that of all wires under that slip") {
  // strains differ by the third harmonic (W13), up to 6e-5 of their range, damage by some powers of that
  constexpr double waves = 2e-3;
  // the wires of the other slip are picked on thinned samples: a close second may be picked
  constexpr double thinned = 0.02;
  for (const Stress stress : {Stress::cyclic, Stress::elastic}) {
    const Lives stick = lives_of(Slip::stick, stress), free = lives_of(Slip::free, stress);
    check_agree(stick.stick, stick.sites, waves);
    check_agree(free.free, free.sites, waves);
    CHECK(stick.stick.component == stick.sites.component);
    CHECK(free.free.component == free.sites.component);
    check_agree(free.stick, stick.sites, thinned);
    check_agree(stick.free, free.sites, thinned);
  }
}
