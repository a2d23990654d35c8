// Wires that slide as lines (W45): against the exact kinematics from clamp to clamp, the closed form of friction, and wires that
// another solver moves.
#include "strain/long_waves.h"

#include <cmath>

#include "pipeline/base/constants.h"
#include "strain/clamp_means.h"
#include "tests/catch.h"
#include "tests/strain/dresspacks.h"
#include "tests/strain/friction_lines.h"

using namespace dresslife;
using namespace dresslife::strain;
using namespace test_dresspacks;
using dresslife::pipeline::Kinematics;
using dresslife::pipeline::Slip;

namespace {

constexpr double length = 2, wire_radius = 75e-6, layer_radius = 0.75e-3;
constexpr std::size_t segments = 64;

/// A cable of seven conductors of the left hand with one layer of wires.
Dresspack cable(double conductor_lay, Hand of_wires, double friction = 0) {
  Component conductor = part("conductor", 7, 0.001175, 0.002825, conductor_lay, Hand::left);
  conductor.components = {wires("", 12, wire_radius, layer_radius, 5, of_wires)};
  conductor.components[0].friction = friction;
  conductor.components[0].radial_line_load = 7.5;
  Component whole = part("cable", 1, 0.0053, 0, 0);
  whole.components = {conductor};
  Dresspack dresspack;
  dresspack.components = {whole};
  dresspack.materials = {copper()};
  return dresspack;
}

/// A span whose curvature is given as a function of place and sample.
struct Span {
  std::size_t samples;
  std::function<std::array<double, 2>(double, std::size_t)> bend;
  std::vector<double> lengths = std::vector<double>(segments, length / segments), arcs;

  Span(std::size_t count, auto of) : samples(count), bend(of) {
    for (std::size_t i = 0; i < segments; ++i) arcs.push_back((static_cast<double>(i) + 0.5) * length / segments);
  }
  BentCables cables() const {
    return {lengths,
            arcs,
            arcs,
            samples,
            [this](std::size_t, std::size_t row, int about, std::size_t first, std::size_t count, double* to) {
              const double at = row == 0 ? 0 : row > segments ? length : arcs[row - 1];
              for (std::size_t t = 0; t < count; ++t) to[t] = bend(at, first + t)[about];
            },
            [](std::size_t, std::size_t, std::size_t, std::size_t count, double* to) { std::fill_n(to, count, 0.0); }};
  }
};

struct Lines {
  Construction construction;
  std::vector<LayerSlip> plan;
  std::vector<int> layers;
  LongWaves lines;

  Lines(const Dresspack& dresspack, const Span& span, Slip inside, double friction, double share = 0.01)
      : construction(dresspack, Kinematics::exact),
        plan(plan_slip(construction, {Slip::stick, inside}, length)),
        layers(LongWaves::layers_of(construction, plan, {share * bend_wave(span.cables(), 0)})),
        lines(construction, plan, layers, span.cables(), friction, {}) {}
  int layer() const { return construction.bundles()[0].wire_layers[0]; }
  /// Returns the strain of a wire (sample).
  std::vector<double> strain(int part, double angle, std::size_t segment, std::size_t samples) const {
    std::vector<double> strain(samples, 0.0);
    lines.of(layer(), part, segment).add_to(strain.data(), angle);
    return strain;
  }
};

/// A bend that moves along the cable and turns. So small that (R kappa)^2 is below 1e-3 of the strain.
std::array<double, 2> moving_bend(double at, std::size_t t) {
  const double time = static_cast<double>(t) / 40, from = at - 0.3 - 1.2 * time;
  const double size = 0.2 * std::exp(-from * from / 0.002);
  return {size * std::cos(3 * time), size * std::sin(3 * time)};
}

}  // namespace

TEST_CASE("long waves: without friction a wire has the strain of its path from clamp to clamp") {
  const Span span(40, moving_bend);
  for (const double lay : {12.0, 15.0, 20.0}) {  // waves of 0.12, 0.24 and 1.3 m
    const Lines of(cable(lay, Hand::right), span, Slip::free, 1);
    REQUIRE(of.layers.size() == 1);
    std::vector<LayerSlip> plan = of.plan;
    plan[of.layer()].sliding = Sliding::clamp_to_clamp;
    ClampMeans means(of.construction, plan, span.lengths, span.arcs, span.samples);
    DeformationHistory history(segments, span.samples);
    for (std::size_t i = 0; i < segments; ++i)
      for (std::size_t t = 0; t < span.samples; ++t) {
        const std::array<double, 2> bend = moving_bend(span.arcs[i], t);
        history.set(i, t, {bend[0], bend[1], 0, 0});
      }
    for (int round = 0; round < means.rounds(); ++round) {
      for (std::size_t i = 0; i < segments; ++i) means.add(round, i, {span.samples, history.columns(i)});
      means.end_round(round);
    }
    double most = 0, away = 0;
    for (const Bundle& bundle : of.construction.bundles())
      for (int k = 0; k < 12; ++k) {
        const double angle = 2 * pi * k / 12;
        const std::vector<double> exact = means.at_angle(bundle.part, of.layer(), angle);
        const std::vector<double> line = of.strain(bundle.part, angle, 17, span.samples);
        for (std::size_t t = 0; t < span.samples; ++t) {
          most = std::max(most, std::abs(exact[t]));
          away = std::max(away, std::abs(exact[t] - line[t]));
        }
      }
    INFO("lay " << lay << ", strain " << most);
    CHECK(most > 1e-6);
    // A core bends unlike about its two axes. Each wave has ten straight pieces.
    CHECK(away < 0.1 * most);
  }
}

TEST_CASE("long waves: in an even bend friction holds the triangle of the closed form") {
  // There and back: all pieces slide. Eight waves.
  const Span span(40, [](double, std::size_t t) { return std::array{5 * std::sin(2 * pi * t / 40.0), 0.0}; });
  const Lines of(cable(15, Hand::right, 0.3), span, Slip::friction, 1, 1e-9);
  REQUIRE(of.layers.size() == 0);  // no wave is long beside an even bend
  const LongWaves lines(of.construction, of.plan, {of.layer()}, span.cables(), 1, {});
  double most = 0;
  const int part = of.construction.bundles()[0].part;
  for (int k = 0; k < 24; ++k) {
    std::vector<double> strain(span.samples, 0.0);
    lines.of(of.layer(), part, 30).add_to(strain.data(), 2 * pi * k / 24);
    for (const double value : strain) most = std::max(most, std::abs(value));
  }
  // Friction gathers over a quarter of the wave, which has 2.5 pieces.
  CHECK(most == Approx(of.plan[of.layer()].cap.constant).epsilon(0.08));
}

TEST_CASE("long waves: wires slide with friction as lines that another solver moves") {
  const Span span(80, [](double at, std::size_t t) {
    const double time = 2 * pi * static_cast<double>(t) / 40;
    return std::array{3 * std::sin(time) * std::sin(2 * pi * at / 0.4),
                      2 * std::cos(time) * std::sin(2 * pi * at / 0.7)};
  });
  const Lines of(cable(15, Hand::right, 0.3), span, Slip::friction, 1, 0.25);
  REQUIRE(of.layers.size() == 1);
  const int part = of.construction.bundles()[0].part;
  const Layer& layer = of.construction.layers()[of.layer()];
  // the same wire in many cells, by the minimum of energy and friction in a finer mesh
  constexpr std::size_t cells = 256;
  const LineWave wave = of.lines.of(of.layer(), part, 0);
  const double turn = (std::tan(5 * degree) / layer_radius) / std::cos(15 * degree) - std::tan(15 * degree) / 0.002825;
  const double cell = length / cells / std::cos(5 * degree) / std::cos(15 * degree);
  const double radius = layer_radius * std::pow(std::cos(5 * degree), 2) * std::pow(std::cos(15 * degree), 1.5);
  for (std::size_t segment = 4; segment < segments; segment += 16) {
    double most = 0, of_line = 0;  // range of the worst wire
    for (int k = 0; k < 6; ++k) {  // opposite wires have opposite strains
      friction_lines::SlidingWire wire(cells, cell, 0.3 * 7.5 / layer.axial_stiffness);
      const double psi = wave.phase + 2 * pi * k / 12;
      const std::vector<double> line = of.strain(part, 2 * pi * k / 12, segment, span.samples);
      std::vector<double> exact;
      for (std::size_t t = 0; t < span.samples; ++t) {
        std::vector<double> glued(cells);
        for (std::size_t i = 0; i < cells; ++i) {
          const double at = (static_cast<double>(i) + 0.5) * length / cells;
          const std::array<double, 2> bend = span.bend(at, t);
          glued[i] = radius * (bend[0] * std::sin(psi + turn * at) - bend[1] * std::cos(psi + turn * at));
        }
        wire.move(glued);
        const std::size_t middle = segment * cells / segments + cells / segments / 2;
        exact.push_back((wire.strain()[middle - 1] + wire.strain()[middle]) / 2);
      }
      const auto range = [&](const std::vector<double>& strain) {
        const auto [low, high] = std::minmax_element(strain.begin() + 40, strain.end());
        return *high - *low;
      };
      most = std::max(most, range(exact));
      of_line = std::max(of_line, range(line));
    }
    CAPTURE(segment);
    CHECK(of_line == Approx(most).epsilon(0.2));  // the strain of all wires is one harmonic
  }
}
