// Rubbing of jackets against closed forms: a cable drawn over an arc, a cable that moves across its hose, and mesh refinement.
#include "strain/cable_rubbing.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "strain/cable_paths.h"
#include "tests/catch.h"
#include "tests/strain/dresspacks.h"

using namespace dresslife::strain;
using dresslife::pipeline::Dresspack;
using dresslife::pipeline::Kinematics;
using dresslife::pipeline::Position;
using dresslife::pipeline::Slip;

namespace {

constexpr double length = 2, friction = 0.3;

Dresspack hose() {
  Dresspack dresspack = test_dresspacks::thesis_dresspack();
  dresspack.inner_diameter = 0.051;
  dresspack.core_diameter = 0.026;
  dresspack.materials = {test_dresspacks::copper()};
  dresspack.components[0].friction = friction;
  dresspack.components[0].radial_line_load = 5;
  dresspack.components[0].laying.slack = 1;
  return dresspack;
}

/// One cable on the axis that slips through its base clamp but not through its tool clamp.
Dresspack drawn(double grip) {
  Dresspack dresspack = hose();
  dresslife::pipeline::Component& cable = dresspack.components[0];
  dresspack.core_diameter = 0;
  cable.count = 1, cable.helix_radius = 0, cable.radial_line_load = 0;
  cable.laying = {};
  cable.laying.position = Position::held, cable.laying.base_grip = grip;
  return dresspack;
}

/// motion: the deformation at an arc [m] and a sample.
template <class Motion>
struct Run {
  Construction construction;
  std::size_t segments;
  CablePaths paths;

  Run(const Dresspack& dresspack, std::size_t pieces, std::size_t samples, const Motion& motion,
      std::size_t lead_ins = 1)
      : construction(dresspack, Kinematics::exact),
        segments(pieces),
        paths(construction, plan_slip(construction, {Slip::friction, Slip::free}, length), {.rub = true},
              std::vector<double>(segments, length / static_cast<double>(segments)), arcs(), samples) {
    DeformationHistory history(segments, samples);
    for (std::size_t t = 0; t < samples; ++t)
      for (std::size_t i = 0; i < segments; ++i) history.set(i, t, motion(arcs()[i], t));
    paths.record_rubbing();
    CablePaths* const all = &paths;
    for (std::size_t k = 0; k < lead_ins; ++k) CablePaths::lead_in({&all, 1}, {history});
    paths.add({history});
    paths.finish();
  }
  std::vector<double> arcs() const {
    std::vector<double> arcs;
    for (std::size_t i = 0; i < segments; ++i)
      arcs.push_back((static_cast<double>(i) + 0.5) * length / static_cast<double>(segments));
    return arcs;
  }
  /// Returns the friction work per length, summed around the cable [N], (segment).
  std::vector<double> work_per_length(std::size_t cable) const {
    std::vector<double> of(segments);
    for (const CableRubbing::Patch& patch : paths.rubbing(cable)->patches())
      of[patch.segment] += patch.work * static_cast<double>(segments) / length;
    return of;
  }
};

}  // namespace

TEST_CASE("a cable that is drawn over an arc rubs with its tension, the arc's curvature and its way") {
  // The hose stretches and shrinks by 2 a. The cable is fixed at the tool clamp and slips through the base clamp at a force G.
  // At x from the base it slides by 2 a (L - x), with the tension G e^(mu kappa x) while the hose stretches. Under compression
  // it does not press on the hose.
  constexpr double a = 0.01, curvature = 0.8, grip = 10;
  constexpr std::size_t samples = 201, segments = 64;
  const Run run(drawn(grip), segments, samples, [](double, std::size_t t) {
    return Deformation{0, curvature, 0, a * std::sin(2 * std::numbers::pi * static_cast<double>(t) / (samples - 1))};
  });
  const std::vector<double> work = run.work_per_length(0);
  // The cable's elastic strain is below a thousandth of a. The tension of a segment differs from the tension at its middle by
  // mu kappa l / 2 = 0.4 %. The samples in which the direction changes add an error of the same size.
  constexpr double discrete = 0.015;
  for (const std::size_t i : {3u, 20u, 40u, 55u}) {
    const double x = run.arcs()[i];
    CHECK(work[i] ==
          Approx(grip * std::exp(friction * curvature * x) * curvature * 2 * a * (length - x)).epsilon(discrete));
  }
  // The cable touches on the inside of the bend. The axis bends toward (k2, -k1), which is d1 here.
  for (const CableRubbing::Patch& patch : run.paths.rubbing(0)->patches()) CHECK(patch.angle < CableRubbing::width());
}

TEST_CASE("a hose that does not move wears no jacket") {
  const auto still = [](double arc, std::size_t) { return Deformation{0.5 * arc, 0.8, 0.3, 1e-3}; };
  const Run held(drawn(10), 16, 40, still);
  CHECK(held.paths.rubbing(0)->patches().empty());
  const auto largest = [&](std::size_t lead_ins) {
    const Run run(hose(), 16, 40, still, lead_ins);
    double most = 0;
    for (std::size_t k = 0; k < run.paths.cables(); ++k)
      most = std::max(most, std::ranges::max(run.work_per_length(k)));
    return most;
  };
  // Loose cables creep into equilibrium under their drag. A lead-in lasts 1.6 s.
  const double soon = largest(1);
  CHECK(largest(100) < 0.01 * soon);
}

TEST_CASE("jackets rub by as much with twice the segments") {
  constexpr std::size_t samples = 120;
  const auto motion = [](double arc, std::size_t t) {
    const double z = arc / length, w = 2 * std::numbers::pi * static_cast<double>(t) / (samples - 1);
    return Deformation{(0.8 + 0.4 * std::sin(w)) * std::sin(std::numbers::pi * z),
                       0.5 * std::cos(w) * std::cos(std::numbers::pi * z / 2), 0.4 * std::sin(w), 1e-4 * std::cos(w)};
  };
  // The mean over a footprint of ten diameters, from which wear is computed.
  const auto largest = [&](std::size_t segments) {
    const Run run(hose(), segments, samples, motion);
    const auto wide = static_cast<std::size_t>(std::lround(0.106 * static_cast<double>(segments) / length));
    double most = 0;
    for (std::size_t k = 0; k < run.paths.cables(); ++k) {
      const std::vector<double> work = run.work_per_length(k);
      for (std::size_t i = 0; i + wide <= segments; ++i)
        most = std::max(most, std::accumulate(work.begin() + static_cast<std::ptrdiff_t>(i),
                                              work.begin() + static_cast<std::ptrdiff_t>(i + wide), 0.0) /
                                  static_cast<double>(wide));
    }
    return most;
  };
  constexpr double refined = 0.1;  // wear rates are known only to a factor of 6
  const double coarse = largest(64);
  CHECK(coarse > 0.1);  // [N]
  CHECK(largest(128) == Approx(coarse).epsilon(refined));
}

namespace {

/// A cable on a ring of 18 mm between a core and a wall.
LooseCable in_ring() {
  LooseCable cable;
  cable.place = {18e-3, 0};
  cable.nearest = 17e-3, cable.farthest = 20e-3;
  return cable;
}

/// A state whose nodes all have the same place and the same pressure.
CableState pressed_at(double x, double y, double press, std::size_t nodes) {
  CableState state;
  state.press.assign(nodes, press);
  for (std::size_t i = 0; i < nodes; ++i)
    state.offset.insert(state.offset.end(), {x - in_ring().place[0], y - in_ring().place[1]});
  return state;
}

}  // namespace

TEST_CASE("a cable that moves around its hose rubs with its pressure, on the side of the wall or the core") {
  constexpr std::size_t elements = 8, segments = 2, steps = 360;
  constexpr double press = 20, load = 5, spacing = 0.01;
  const double radius = GENERATE(17e-3, 20e-3);
  CableRubbing rubbing(segments, steps + 1);
  for (std::size_t t = 0; t <= steps; ++t) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(t) / steps;
    rubbing.move_across(t, in_ring(),
                        pressed_at(radius * std::cos(angle), radius * std::sin(angle), press, elements + 1), load,
                        spacing);
  }
  double sum = 0;
  const double whole = (press + load) * 2 * std::numbers::pi * radius * elements * spacing;
  for (const CableRubbing::Patch& patch : rubbing.patches()) {
    sum += patch.work;
    CHECK(patch.work ==
          Approx(whole / segments / CableRubbing::sectors).epsilon(0.11));  // one of ten steps at a sector's border
    // At the wall the cable touches with its outer side, at the core with its inner side.
    const double passed =
        static_cast<double>(patch.sample) * 2 * std::numbers::pi / steps + (radius > 18e-3 ? 0 : std::numbers::pi);
    CHECK(std::abs(std::remainder(passed - patch.angle, 2 * std::numbers::pi)) <= CableRubbing::width());
  }
  CHECK(sum == Approx(whole).epsilon(1e-4));  // chords of 1 degree
}

TEST_CASE("a cable that leaves one wall for another does not rub on its way") {
  CableRubbing rubbing(1, 3);
  rubbing.move_across(0, in_ring(), pressed_at(-20e-3, 0, 10, 3), 0, 0.01);
  rubbing.move_across(1, in_ring(), pressed_at(0, 0, 0, 3), 0, 0.01);
  rubbing.move_across(2, in_ring(), pressed_at(20e-3, 0, 10, 3), 0, 0.01);
  CHECK(rubbing.patches().empty());
}

TEST_CASE("a cable whose pressure rises and falls rubs by as much with a quarter of the samples") {
  const auto sum = [](std::size_t steps) {
    CableRubbing rubbing(1, steps + 1);
    for (std::size_t t = 0; t <= steps; ++t) {
      const double phase = 2 * std::numbers::pi * static_cast<double>(t) / static_cast<double>(steps);
      const double angle = 0.2 * phase, press = 10 * (1 - std::cos(5 * phase));
      rubbing.move_across(t, in_ring(), pressed_at(20e-3 * std::cos(angle), 20e-3 * std::sin(angle), press, 3), 0,
                          0.01);
    }
    double work = 0;
    for (const CableRubbing::Patch& patch : rubbing.patches()) work += patch.work;
    return work;
  };
  const double exact = 10 * 0.2 * 2 * std::numbers::pi * 20e-3 * 0.02;  // mean pressure, way, length
  for (const std::size_t steps : {40u, 160u}) CHECK(sum(steps) == Approx(exact).epsilon(1e-3));  // chords
}
