// Closed forms of friction (W16, W17, W29) against wires that slide as lines in space.
#include "tests/strain/friction_lines.h"

#include <functional>
#include <random>

#include "pipeline/base/constants.h"
#include "pipeline/cable/cable_bending.h"
#include "pipeline/cable/shares.h"
#include "strain/friction.h"
#include "strain/slip.h"
#include "tests/catch.h"
#include "tests/pipeline/cable/space_curve.h"
#include "tests/strain/dresspacks.h"

using namespace dresslife;
using namespace dresslife::strain;
using dresslife::pipeline::CableBending;
using dresslife::pipeline::friction_level;
using friction_lines::SlidingWire;
using namespace test_dresspacks;

namespace {

/// Wires of one layer of a part that lies straight or on a helix in a straight cable. All wires have the same wave of strain
/// along themselves, so one long wire represents them all.
struct WiresInSpace {
  double radius, lay_angle;                           // of the wires; lay angles signed [m], [rad]
  double part_radius = 0, part_lay = 0;               // of the part
  double EA = 117e9 * pi * 75e-6 * 75e-6, limit = 0;  // limit: mu p/(E A) [1/m]
  double cell, per_cable_length;                      // [m] of wire; wire per length of the cable
  std::vector<double> by_bend1, by_bend2;             // glued strain per curvature, (cell) [m]
  std::size_t first = 0, last = 0;                    // cells of whole waves, far from the ends

  WiresInSpace(double at_radius, double lay_deg, double of_part, double part_lay_deg, double wave,
               std::size_t cells_in_wave, int waves)
      : radius(at_radius), lay_angle(lay_deg * degree), part_radius(of_part), part_lay(part_lay_deg * degree) {
    per_cable_length = 1 / (std::cos(lay_angle) * std::cos(part_lay));
    cell = wave / static_cast<double>(cells_in_wave);
    const std::size_t cells = cells_in_wave * waves;
    first = cells_in_wave * (waves / 2), last = first + cells_in_wave;
    for (std::size_t i = 0; i < cells; ++i) {
      const double along = (static_cast<double>(i) + 0.5) * cell;
      by_bend1.push_back(rate(along, {1, 0, 0}));
      by_bend2.push_back(rate(along, {0, 1, 0}));
    }
  }

  /// Returns the glued wire's strain minus the strain of the part, which slides and keeps its mean.
  double rate(double along, const space_curve::Vector& bend) const {
    const double in_part = along * std::cos(lay_angle), in_cable = in_part * std::cos(part_lay);
    std::vector<space_curve::Level> levels;
    if (part_radius > 0) levels.push_back({part_radius, part_lay, in_cable * std::tan(part_lay) / part_radius});
    const auto strain = [&] {
      constexpr long double little = 1e-4L;
      const space_curve::Curves rest{1, space_curve::Vector(0, 0, 0), levels}, bent{1, bend * little, levels};
      return levels.empty() ? 0.0L : (bent.stretch_of_last() / rest.stretch_of_last() - 1) / little;
    };
    const long double of_part = strain();
    levels.push_back({radius, lay_angle, in_part * std::tan(lay_angle) / radius});
    return static_cast<double>(strain() - std::pow(std::cos(lay_angle), 2) * of_part);
  }

  std::vector<double> glued(double bend1, double bend2) const {
    std::vector<double> strain(by_bend1.size());
    for (std::size_t i = 0; i < strain.size(); ++i) strain[i] = bend1 * by_bend1[i] + bend2 * by_bend2[i];
    return strain;
  }
  /// Returns the moment about bend1 that the held strain of one wire causes [N m].
  double moment(const SlidingWire& wire) const {
    double sum = 0;
    for (std::size_t i = first; i < last; ++i) sum += wire.strain()[i] * by_bend1[i];
    return EA * per_cable_length * sum / static_cast<double>(last - first);
  }
  SlidingWire wire() const { return {by_bend1.size(), cell, limit}; }
};

dresslife::pipeline::Material elastic_copper() {
  dresslife::pipeline::Material copper;
  copper.name = "copper";
  copper.youngs_modulus = 117e9;
  copper.poisson_ratio = 0.34;
  return copper;
}

/// Twelve wires at 10 degrees around the axis of a cable.
constexpr int wire_count = 12;
constexpr double wire_radius = 0.0003, wire_lay = 10, line_load = 400, friction = 0.3;
Dresspack strand() {
  Dresspack dresspack = thesis_dresspack();
  dresspack.materials = {elastic_copper()};
  Component& cable = dresspack.components[0];
  cable.components = {wires("layer 1", wire_count, 75e-6, wire_radius, wire_lay, Hand::right)};
  cable.components[0].friction = friction;
  cable.components[0].radial_line_load = line_load;
  return dresspack;
}
/// waves: number of waves, so large that the ends, which do not slide, do not influence the wave in the middle.
WiresInSpace wires_of_strand(int waves) {
  WiresInSpace wires(wire_radius, wire_lay, 0, 0, 2 * pi * wire_radius / std::sin(wire_lay * degree), 96, waves);
  wires.limit = friction * line_load / wires.EA;
  return wires;
}

// Cells of 1/96 of a wave: the length over which friction acts is known to half a cell in 24.
constexpr double cells = 0.015;
// Share of the cap by which the strain of a wire near the neutral axis may exceed its slider's.
constexpr double other_wires = 0.25;

}  // namespace

TEST_CASE("moment of a strand: the closed form is that of wires that slide as lines, there and back") {
  const Dresspack dresspack = strand();
  const CableBending bending(dresspack, dresspack.components[0]);
  const WiresInSpace wires = wires_of_strand(9);
  const auto held = [&](double curvature) {
    return bending.moment(curvature, 1) - bending.free_stiffness() * curvature;
  };
  SlidingWire wire = wires.wire();
  const double most = 3.0, glued = held(1e-4) / 1e-4;
  CHECK(held(most) < 0.3 * glued * most);  // all cells slide
  for (double curvature = 0.1; curvature < most * 1.001; curvature += 0.1) {
    wire.move(wires.glued(curvature, 0));
    CHECK(wire_count * wires.moment(wire) == Approx(held(curvature)).epsilon(cells));
  }
  const double top = held(most);
  for (double curvature = most; curvature > -most * 1.001; curvature -= 0.1) {
    wire.move(wires.glued(curvature, 0));  // Masing: twice the curve of the first bend, from the tip
    CHECK(wire_count * wires.moment(wire) == Approx(top - 2 * held((most - curvature) / 2)).margin(cells * top));
  }
}

TEST_CASE("a strand of known friction, measured by bending its lines, has that friction by its stiffness") {
  Dresspack dresspack = strand();
  Component& cable = dresspack.components[0];
  const double own = CableBending(dresspack, cable).free_stiffness();
  for (const double level : {0.2, 1.0, 5.0})
    for (const double curvature : {0.5, 1.0, 3.0}) {
      WiresInSpace wires = wires_of_strand(11);
      wires.limit *= level;
      SlidingWire wire = wires.wire();
      for (int step = 1; step <= 20; ++step) wire.move(wires.glued(curvature * step / 20, 0));
      const double stiffness = own + wire_count * wires.moment(wire) / curvature;
      // Where nearly all wires stick, the stiffness contains little information about the friction.
      if (stiffness > 0.9 * CableBending(dresspack, cable).stuck_stiffness()) continue;
      cable.measured_bending_stiffness = stiffness;
      cable.measured_at_curvature = curvature;
      CHECK(friction_level(dresspack, cable) == Approx(level).epsilon(2 * cells));
    }
}

TEST_CASE(
    "nested lays: wires of a conductor even out over the sum of both turns, of the same hand and of opposite ones") {
  struct Case {
    double part_lay, lay, radius;  // [deg] of the conductor, of its wires; [m]
    double evening;                // [mm]
    double least, most;            // bounds of (moment of the lines) / (moment of the closed form)
  };
  // The strain also contains the wave of the difference of both turns: a conductor at lay angle a bends by cos a (1 + sin^2 a)
  // about its normal and by cos^2 a cos 2a about its binormal. At 10, 15, 25 degrees the second wave has 0.05, 0.12, 0.34 of
  // the size of the first. If it is the longer one (same hand), friction is larger than in the closed form.
  constexpr double part_radius = 0.002825;
  for (const Case& of : {Case{-15, 5, 0.00075, 252, 0.96, 1.04}, Case{-15, 5, 0.00045, 61.4, 0.96, 1.04},
                         Case{-25, 5, 0.00075, 191, 0.87, 1.04}, Case{10, 5, 0.00075, 35.4, 0.95, 1.06},
                         Case{25, 5, 0.00045, 18.3, 1.0, 1.5}}) {
    CAPTURE(of.part_lay, of.radius);
    const double in_part = turning(0, of.part_lay * degree, part_radius);
    const double sum = std::abs(turning(in_part, of.lay * degree, of.radius)),
                 other = std::abs(turning(-in_part, of.lay * degree, of.radius));
    CHECK(1e3 * evening_length(sum, 9) == Approx(of.evening).epsilon(5e-3));
    CHECK(evening_length(sum, 0.01) == 0.01);
    const double longest = 2 * pi / std::min(sum, other), shortest = 2 * pi / std::max(sum, other);
    WiresInSpace wires(of.radius, of.lay, part_radius, of.part_lay, longest,
                       static_cast<std::size_t>(32 * longest / shortest), 5);
    Dresspack dresspack = thesis_dresspack();
    dresspack.materials = {elastic_copper()};
    Component& cable = dresspack.components[0];
    Component& conductor = cable.components[0];
    conductor.lay_angle = std::abs(of.part_lay) * degree;
    conductor.hand = of.part_lay > 0 ? Hand::right : Hand::left;
    conductor.components = {test_dresspacks::wires("layer 1", 10, 75e-6, of.radius, of.lay, Hand::right)};
    Component& layer = conductor.components[0];
    layer.friction = 0.3;
    layer.radial_line_load = 100;
    const CableBending bending(dresspack, cable);
    wires.limit = 0.3 * 100 / wires.EA;
    const double cap = wires.limit * evening_length(sum, 9) / 4;
    const double glued = bending.stuck_stiffness(1) - bending.free_stiffness();
    const double amplitude = std::sqrt(2 * glued / (70 * wires.EA * wires.per_cable_length));
    for (const double size : {0.5, 1.0, 2.0, 4.0}) {
      SlidingWire wire = wires.wire();
      const double curvature = size * cap / amplitude;
      for (int step = 1; step <= 8; ++step) wire.move(wires.glued(curvature * step / 8, 0));
      const double closed = bending.moment(curvature, 1) - bending.free_stiffness() * curvature;
      CAPTURE(size);
      CHECK(70 * wires.moment(wire) > of.least * closed);
      CHECK(70 * wires.moment(wire) < of.most * closed);
    }
  }
}

TEST_CASE("a bend that changes along the cable: the closed form where a wave is a quarter of the bend's") {
  // e = A cos(2 pi x/L) cos(2 pi x/s), to and fro. Compared: range at the worst place / range of a slider with the cap.
  constexpr double bend = 1, limit = 1e-3;
  const auto over_slider = [&](double wave, double size) {
    const double cell = std::min(wave, bend) / 32, cap = limit * std::min(wave, bend) / 4;
    const auto many = static_cast<std::size_t>(4 * std::max(bend, std::min(wave, 2 * bend)) / cell);
    SlidingWire wire(many, cell, limit);
    std::vector<double> low(many, 1e9), high(many, -1e9), glued(many);
    for (int t = 0; t <= 30; ++t) {
      const double reach = t <= 6 ? t / 6.0 : t <= 18 ? 1 - (t - 6) / 6.0 : -1 + (t - 18) / 6.0;
      for (std::size_t i = 0; i < many; ++i) {
        const double at = (static_cast<double>(i) + 0.5) * cell;
        glued[i] = size * cap * reach * std::cos(2 * pi * at / bend + 0.2) * std::cos(2 * pi * at / wave + 0.3);
      }
      wire.move(glued);
      for (std::size_t i = many / 4; t >= 6 && i < 3 * many / 4; ++i)
        low[i] = std::min(low[i], wire.strain()[i]), high[i] = std::max(high[i], wire.strain()[i]);
    }
    double worst = 0;
    for (std::size_t i = many / 4; i < 3 * many / 4; ++i) worst = std::max(worst, high[i] - low[i]);
    return worst / (2 * cap * std::min(size, 1.0));
  };
  for (const double size : {0.5, 1.0, 2.0, 4.0}) {
    CAPTURE(size);
    for (const double wave : {0.1, believable_evening}) {
      CHECK(over_slider(wave, size) > 0.95);
      CHECK(over_slider(wave, size) < 1.2);
    }
    for (const double wave : {0.5, 0.8, 1.3, 2.0, 8.0}) {  // the statement of the warning
      CHECK(over_slider(wave, size) > 0.95);
      CHECK(over_slider(wave, size) < 2.55);
    }
  }
}

TEST_CASE("any history of bending: sliders follow the worst wire of a layer, and no wire sees more than they say") {
  const WiresInSpace wires = wires_of_strand(5);
  const double amplitude = std::hypot(wires.by_bend1[0], wires.by_bend2[0]);
  const double cap = wires.limit * wires.cell * 96 / 4;  // (W16)
  struct History {
    const char* name;
    std::function<std::pair<double, double>(double)> at;  // curvatures at a share of the repeat, in amplitudes
  };
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(-1, 1);
  std::vector<History> histories{
      {"in one plane", [](double x) { return std::pair(std::sin(2 * pi * x), 0.0); }},
      {"round", [](double x) { return std::pair(std::cos(2 * pi * x), std::sin(2 * pi * x)); }},
      {"ellipse", [](double x) { return std::pair(std::cos(2 * pi * x), 0.3 * std::sin(2 * pi * x)); }},
      {"round, off centre", [](double x) { return std::pair(2 + std::cos(2 * pi * x), std::sin(2 * pi * x)); }}};
  for (int k = 0; k < 4; ++k) {
    std::array<double, 12> c;
    for (double& value : c) value = part(random);
    histories.push_back({"random", [c](double x) {
                           std::pair<double, double> sum(c[10], c[11]);
                           for (int n = 1; n <= 2; ++n) {
                             const double phase = 2 * pi * n * x;
                             sum.first += c[4 * n - 4] * std::cos(phase) + c[4 * n - 3] * std::sin(phase);
                             sum.second += c[4 * n - 2] * std::cos(phase) + c[4 * n - 1] * std::sin(phase);
                           }
                           return sum;
                         }});
  }
  constexpr int samples = 60;
  double least = 1e9, largest = 0;  // range of the sliders / range of the lines, both of the worst wire
  for (const History& history : histories)
    for (const double size : {0.8, 1.5, 4.0}) {  // glued strain's amplitude / cap
      CAPTURE(history.name, size);
      SlidingWire wire = wires.wire();
      const std::size_t around = wires.last - wires.first;
      std::vector<Slider> sliders(around);
      std::vector<double> low(around, 1e9), high(around, -1e9), slider_low(low), slider_high(high);
      for (int t = 0; t < 2 * samples; ++t) {
        const auto [bend1, bend2] = history.at(static_cast<double>(t) / samples);
        const double scale = size * cap / amplitude;
        const std::vector<double> glued = wires.glued(bend1 * scale, bend2 * scale);
        wire.move(glued);
        for (std::size_t i = 0; i < around; ++i) {
          const double held = sliders[i].next(glued[wires.first + i], cap), line = wire.strain()[wires.first + i];
          if (t < samples) continue;  // friction settles in the first repeat
          low[i] = std::min(low[i], line), high[i] = std::max(high[i], line);
          slider_low[i] = std::min(slider_low[i], held), slider_high[i] = std::max(slider_high[i], held);
        }
      }
      double worst = 0, slider_worst = 0;
      for (std::size_t i = 0; i < around; ++i) {
        const double range = high[i] - low[i], slider_range = slider_high[i] - slider_low[i];
        worst = std::max(worst, range), slider_worst = std::max(slider_worst, slider_range);
        CHECK(range < slider_range + other_wires * cap);
      }
      largest = std::max(largest, slider_worst / worst), least = std::min(least, slider_worst / worst);
    }
  INFO("sliders over lines " << least << " .. " << largest);
  CHECK(least > 0.95);
  CHECK(largest < 1.2);
}
