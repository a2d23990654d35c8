// Strains of wires are smooth functions of the keys of their cables: no jump between neighbouring values of any key, at any
// value of the others. Wires of two cables with two conductors each, through the whole evaluation.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "pipeline/base/constants.h"
#include "strain/evaluation.h"
#include "tests/catch.h"
#include "tests/strain/dresspacks.h"

using namespace dresslife;
using namespace dresslife::strain;
using namespace test_dresspacks;
using dresslife::pipeline::Kinematics;
using dresslife::pipeline::Position;
using dresslife::pipeline::Slip;

namespace {

constexpr double length = 2;
constexpr std::size_t segments = 16, samples = 24;

Dresspack two_cables(Position position) {
  Component conductor = part("conductor", 2, 0.001175, 0.002825, 20, Hand::left);
  // In a loose cable 1 % more play moves its bends by up to a sixth of a radian of their wave along 2 m. Wires in long waves (W45)
  // compare bends far apart, so their strain may change by as much. Wires of the hand of their conductor have short waves.
  const Hand hand = position == Position::loose ? Hand::left : Hand::right;
  conductor.components = {wires("layer 1", 6, 75e-6, 0.00075, 5, hand)};
  conductor.components[0].friction = conductor.friction = 0.3;
  conductor.components[0].radial_line_load = 20, conductor.radial_line_load = 100;
  conductor.radial_stiffness = 1e9, conductor.jacket_stiffness = 1e7;
  Component cable = part("cable", 2, 0.0053, 0.01845, 0);
  cable.components = {conductor};
  cable.friction = 0.3, cable.radial_line_load = 5;
  cable.measured_bending_stiffness = 0.06, cable.polymer_bending_stiffness = 0.03;
  cable.laying.position = position;
  cable.laying.slack = 0.5;
  cable.laying.base_grip = cable.laying.tool_grip = 200;
  if (position == Position::loose) cable.laying.play = 4e-3;
  Dresspack dresspack;
  dresspack.components = {cable};
  dresspack.bending_stiffness = 25;
  dresspack.inner_diameter = 0.051;
  dresspack.materials = {copper()};
  return dresspack;
}

/// Returns the deformation of a hose on a wrist that swings from side to side and twists.
DeformationHistory swinging() {
  DeformationHistory history(segments, samples);
  for (std::size_t i = 0; i < segments; ++i)
    for (std::size_t t = 0; t < samples; ++t) {
      const double z = (i + 0.5) / segments, w = 2 * pi * t / (samples - 1);
      history.set(i, t,
                  {(1.2 + 0.8 * std::sin(w)) * std::sin(pi * z), 0.8 * std::cos(w) * std::cos(pi * z / 2),
                   0.8 * std::sin(w), 1e-4 * std::cos(w)});
    }
  return history;
}

double largest_range(const Dresspack& dresspack) {
  static const DeformationHistory history = swinging();
  const Construction construction(dresspack, Kinematics::exact);
  dresslife::pipeline::Strain settings;
  settings.slip = {Slip::friction};
  settings.gate = 0;
  settings.cable_elements = 2;  // the same mesh for all jobs; the mesh for waves would change in steps of whole pieces
  Evaluation evaluation(construction, settings, std::vector<double>(segments, length / segments), samples);
  evaluation.add({history});
  if (evaluation.wants_again()) evaluation.end_first_pass(), evaluation.add_again(history);
  double largest = 0;
  Sink sink;
  sink.sites = [&](const SiteRows& rows) {
    std::size_t first = 0;
    for (std::size_t site = 0; site < rows.segment.size(); first += rows.turning[site++]) {
      const auto own = std::span(rows.strain).subspan(first, rows.turning[site]);
      const auto [low, high] = std::minmax_element(own.begin(), own.end());
      largest = std::max<double>(largest, *high - *low);
    }
  };
  sink.bound_stick = sink.bound_free = [](const SiteRows&) {};
  sink.probe = [](const Probe&) {};
  for (std::size_t i = 0; i < segments; ++i) evaluation.evaluate(i, history, i, sink);
  return largest;
}

struct Key {
  const char* name;
  double low, high;
  std::function<void(Component& cable, double value)> set;
};

std::vector<Key> keys(Position position) {
  std::vector<Key> all{
      {"slack_percent", 0.2, 2, [](Component& c, double v) { c.laying.slack = v; }},
      {"grip_N", 30, 1000, [](Component& c, double v) { c.laying.base_grip = c.laying.tool_grip = v; }},
      {"friction_coefficient", 0.05, 0.6, [](Component& c, double v) { c.friction = v; }},
      {"radial_line_load_N_per_m", 1, 100, [](Component& c, double v) { c.radial_line_load = v; }},
      {"measured_bending_stiffness_Nm2", 0.05, 0.08, [](Component& c, double v) { c.measured_bending_stiffness = v; }},
      {"radial_stiffness_N_per_m2", 1e9, 1e11, [](Component& c, double v) { c.components[0].radial_stiffness = v; }},
      {"jacket_stiffness_N_per_m2", 1e5, 3e7, [](Component& c, double v) { c.components[0].jacket_stiffness = v; }},
      {"lay_angle_rad", 0.5 * degree, 8 * degree, [](Component& c, double v) { c.lay_angle = v; }}};
  if (position == Position::loose)
    all.push_back({"play_m", 1e-3, 8e-3, [](Component& c, double v) { c.laying.play = v; }});
  return all;
}

}  // namespace

TEST_CASE(
    "a lay of nearly nothing is none, in a hose that says where its cables lie and in one that leaves it to them") {
  for (const Position position : {Position::automatic, Position::held}) {
    Dresspack dresspack = two_cables(position);
    const double straight = largest_range(dresspack);
    // Strains are proportional to the turn of a place along the length, 0.002 rad here, not to its root.
    dresspack.components[0].lay_angle = 0.001 * degree;
    CHECK(largest_range(dresspack) == Approx(straight).epsilon(0.01));
  }
}

TEST_CASE("strains of wires move smoothly with every key of loose and held cables, whatever another is at") {
  constexpr double step = 0.01;
  // Strains grow at most with the cube of a key. The force that presses a cable into waves follows the square of its play
  // (4 E I delta / c^2). The turn of a lay follows the square of its angle. Friction from a measured stiffness follows that
  // stiffness minus the polymer's (0.05 / 0.02), and each of these changes friction again. A law with a switch would exceed this.
  constexpr double steepest = 3;
  // Excess length can rest in several shapes, in which dry friction holds it (W42). Small differences select one of them: the strain goes
  // back and forth between them by up to 23 % in one of twenty comparisons, and this does not add up. The effect of a law with a switch
  // would be there whatever the other keys are, so the median over them at each value of the key shows it: twice the friction above 0.6
  // gives 5.4 % there, and 0.6 % in the median over both values.
  constexpr double other_shape = 0.3;
  for (const Position position : {Position::loose, Position::held}) {
    const std::vector<Key> all = keys(position);
    const double allowed = position == Position::loose ? other_shape : steepest * step;
    std::vector<std::array<std::vector<double>, 2>> changes(all.size());  // (key, low or high, values of the others)
    for (std::size_t a = 0; a < all.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        for (const bool high_a : {false, true})
          for (const bool high_b : {false, true}) {
            const double at_a = high_a ? all[a].high : all[a].low, at_b = high_b ? all[b].high : all[b].low;
            const auto range = [&](double by_a, double by_b) {
              Dresspack dresspack = two_cables(position);
              all[a].set(dresspack.components[0], by_a * at_a);
              all[b].set(dresspack.components[0], by_b * at_b);
              return largest_range(dresspack);
            };
            const double here = range(1, 1), by_a = range(1 + step, 1), by_b = range(1, 1 + step);
            INFO(all[a].name << " " << at_a << ", " << all[b].name << " " << at_b);
            INFO((position == Position::held ? "held" : "loose"));
            CHECK(by_a == Approx(here).epsilon(allowed));
            CHECK(by_b == Approx(here).epsilon(allowed));
            changes[a][high_a].push_back(std::abs(by_a / here - 1));
            changes[b][high_b].push_back(std::abs(by_b / here - 1));
          }
    for (std::size_t key = 0; key < all.size(); ++key)
      for (const bool high : {false, true}) {
        std::vector<double>& of = changes[key][high];
        std::ranges::sort(of);
        INFO(all[key].name << " " << (high ? all[key].high : all[key].low));
        CHECK(of[of.size() / 2] < steepest * step);
      }
  }
}
