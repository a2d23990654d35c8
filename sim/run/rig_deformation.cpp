#include "sim/run/rig_deformation.h"

#include <algorithm>
#include <cmath>

#include "pipeline/base/lists.h"
#include "pipeline/cable/cable_pull.h"
#include "sim/run/deformation_file.h"

namespace dresslife::sim {
namespace {

using pipeline::InputError;
using pipeline::Rig;
using pipeline::RigKind;
using State = PrescribedDeformation::State;

constexpr double gravity = 9.80665;  // acceleration on a weight [m/s2]
constexpr int quarter = 16;          // samples of a quarter of a cycle if the whole cable moves in the same way
constexpr double ramp_segments = 4;  // (D8)
constexpr double degrees = 180 / EIGEN_PI;

/// Returns 0 before -1/2, 1 after 1/2, and half a cosine between.
double ramp(double x) { return x <= -0.5 ? 0 : x >= 0.5 ? 1 : 0.5 * (1 + std::sin(EIGEN_PI * x)); }

class Expansion {
 public:
  Expansion(const Rig& rig, const pipeline::Setup& setup)
      : rig_(rig),
        dresspack_(setup.dresspacks.front().dresspack),
        segments_(setup.simulation.segments),
        way_(pipeline::bend_way(rig, dresspack_.diameter)),
        segment_(pipeline::rig_length(rig, dresspack_.diameter) / segments_),
        edge_(ramp_segments * segment_) {}

  PrescribedDeformation make() {
    result_.positions = {0};
    switch (rig_.kind) {
      case RigKind::torsion:
        torsion();
        break;
      case RigKind::rolling_flex:
        rolling_flex();
        break;
      case RigKind::two_pulley:
        two_pulley();
        break;
      case RigKind::tick_tock:
        tick_tock();
        break;
      case RigKind::swivel:
        swivel();
        break;
      case RigKind::axial:
        axial();
        break;
    }
    spread_over_cycle();
    check_turns();
    return std::move(result_);
  }

 private:
  double radius() const { return pipeline::axis_radius(rig_, dresspack_.diameter); }

  double pull_elongation(double twist) const {
    if (rig_.weight.value_or(0) == 0 && twist == 0) return 0;
    if (pipeline::pull_of_wires(dresspack_, dresspack_.components, 1e-3, 0) <= 0)
      throw InputError(rig_.where, "weight_kg pulls on a cable without wires (only wires bear it)",
                       "give the cable its wires, or leave the weight out");
    return pipeline::elongation_under(dresspack_, dresspack_.components, gravity * *rig_.weight, twist);
  }

  void line(std::string text) {
    result_.step_texts.push_back(std::move(text));
    line_ = static_cast<int>(result_.step_texts.size()) - 1;
  }
  void sample(std::vector<State> states) {
    result_.times.push_back(static_cast<double>(result_.times.size()));
    result_.steps.push_back(line_);
    result_.states.insert(result_.states.end(), states.begin(), states.end());
  }

  /// Adds 0, +1, 0, -1, 0 in equal steps, with a line of the program for each of the four parts.
  template <class AtLevel>
  void to_either_side(const std::string& there, const std::string& back, const AtLevel& at) {
    const std::string texts[] = {"to +" + there, "from +" + there + back, "to -" + there, "from -" + there + back};
    for (int way = 0; way < 4; ++way) {
      line(texts[way]);
      for (int k = way == 0 ? 0 : 1; k <= quarter; ++k) {
        const double share = static_cast<double>(k) / quarter;
        const double level = way == 0 ? share : way == 1 ? 1 - share : way == 2 ? -share : share - 1;
        sample(at(level));
      }
    }
  }

  void torsion() {
    const auto& parts = dresspack_.components;
    if (!rig_.weight) places();
    const double wave = 2 * EIGEN_PI / *rig_.length;
    const double buckling = pipeline::bending_stiffness(dresspack_) * wave * wave;
    to_either_side(fmt::format("{:.4g} deg/m", *rig_.twist * degrees), "", [&](double level) {
      const double twist = level * *rig_.twist;
      if (rig_.weight) return std::vector<State>{{{0, 0, twist}, pull_elongation(twist)}};
      const bool bows = pipeline::pull_of_wires(dresspack_, parts, 0, twist) < -buckling;
      const double elongation = bows ? pipeline::elongation_under(dresspack_, parts, -buckling, twist) : 0;
      const double most = 2 * wave * std::sqrt(std::max(0.0, elongation));
      std::vector<State> states;
      for (const double position : result_.positions) {
        const double bend = most * std::cos(wave * position), turned = twist * position;
        states.push_back({{bend * std::sin(turned), bend * std::cos(turned), twist}, elongation});
      }
      return states;
    });
  }

  void swivel() {
    const double stiffness = pipeline::bending_stiffness(dresspack_);
    if (stiffness <= 0)
      throw InputError(rig_.where, "a swivel bends a cable without bending stiffness (its bend radius is not known)",
                       "give dresspack.bending_stiffness_Nm2, or the cable its wires");
    if (*rig_.weight == 0)
      throw InputError(rig_.where, "weight_kg is 0 (what pulls on a cable in a swivel bends it at the clip)",
                       "give the weight");
    const double pull = gravity * *rig_.weight, elongation = pull_elongation(0);
    const bool edge = rig_.radius || rig_.radius_diameters;
    to_either_side(fmt::format("{:.4g} deg", *rig_.angle * degrees), "", [&](double level) {
      const double free = 2 * std::sqrt(pull / stiffness) * std::sin(std::abs(level) * *rig_.angle / 2);
      const double bend = std::copysign(edge ? std::min(free, 1 / radius()) : free, level);
      return std::vector<State>{{{0, bend, 0}, elongation}};
    });
  }

  void axial() {
    to_either_side(fmt::format("{:.4g} %", *rig_.elongation), "", [&](double level) {
      return std::vector<State>{{Vector3::Zero(), (*rig_.mean_elongation + level * *rig_.elongation) / 100}};
    });
  }

  /// Returns the number of segments if segments are too long by this factor.
  int segments_for(double factor) const { return static_cast<int>(segments_ * factor) + 1; }

  /// Refuses segments that are too long by this factor for the whole bend. where: "onto the mandrel".
  [[noreturn]] void refuse_segments(const char* where, double factor) const {
    throw InputError(rig_.where, fmt::format("{} segments cannot follow the cable {}", segments_, where),
                     fmt::format("give simulation.segments: {}", segments_for(factor)));
  }

  /// Sets places at half the distance of the chain's links.
  void places() {
    result_.positions.clear();
    for (int k = 0; k <= 2 * segments_; ++k) result_.positions.push_back(k * segment_ / 2);
  }
  template <class Bend>
  std::vector<State> along(const Bend& bend) const {
    const double elongation = rig_.weight ? pull_elongation(0) : 0;
    return pipeline::mapped(result_.positions, [&](double at) { return State{{0, bend(at), 0}, elongation}; });
  }
  double bent_between(double position, double from, double to) const {
    return ramp((position - from) / edge_) - ramp((position - to) / edge_);
  }

  /// Adds a motion there and back in steps of half a segment.
  template <class Bend>
  void sweep(const std::string& there, const std::string& back, const Bend& bend) {
    if (way_.sweep < edge_)
      throw InputError(rig_.where,
                       fmt::format("travel_m is {:.4g} (too short to bend or straighten any cable wholly, {:.4g} m of "
                                   "cable pass the bend's edge, {} segments follow {:.4g})",
                                   *rig_.travel, way_.sweep, segments_, edge_),
                       fmt::format("give simulation.segments: {} or more travel", segments_for(edge_ / way_.sweep)));
    places();
    const int steps = static_cast<int>(std::ceil(way_.sweep / (segment_ / 2)));
    for (int way = 0; way < 2; ++way) {
      line(way == 0 ? there : back);
      for (int k = way; k <= steps; ++k) {
        const double at = way_.lead + way_.sweep * (way == 0 ? k : steps - k) / steps;
        sample(along([&](double position) { return bend(position, at); }));
      }
    }
  }

  void rolling_flex() {
    const double radius = this->radius();
    const FlexShares shares = flex_shares(radius, *rig_.travel);
    sweep(fmt::format("stroke there: {:.0f} % of the cable are bent and straightened in each stroke, {:.0f} % in every "
                      "second",
                      100 * shares.each_stroke, 100 * shares.each_cycle),
          "stroke back",
          [&](double position, double at) { return bent_between(position, at, at + way_.bend) / radius; });
  }

  void two_pulley() {
    const double radius = this->radius(), half = way_.bend / 2;
    if (half < edge_) refuse_segments("around a pulley", edge_ / half);
    sweep("carriage there", "carriage back", [&](double position, double at) {
      return (bent_between(position, at, at + half) - bent_between(position, at + half, at + 2 * half)) / radius;
    });
  }

  void tick_tock() {
    if (way_.bend < 2 * edge_) refuse_segments("onto the mandrel", 2 * edge_ / way_.bend);
    const double radius = this->radius();
    places();
    to_either_side(fmt::format("{:.4g} deg", *rig_.angle * degrees), "", [&](double level) {
      const double end = way_.lead + std::abs(level) * way_.bend;
      return along([&](double position) {
        const double on = std::min(ramp((position - way_.lead) / edge_), 1 - ramp((position - end) / edge_));
        return std::copysign(on / radius, level);
      });
    });
  }

  void spread_over_cycle() {
    const double cycle = 60 / rig_.cycles_per_minute, intervals = static_cast<double>(result_.times.size() - 1);
    for (double& time : result_.times) time *= cycle / intervals;
  }

  void check_turns() const {
    double worst = 0;
    for (const State& state : result_.states) worst = std::max(worst, state.rate.norm() * segment_);
    if (worst > most_turn)
      throw InputError(rig_.where,
                       fmt::format("the rig turns a segment of {:.4g} mm by {:.4g} deg (at most 120)", 1e3 * segment_,
                                   worst * degrees),
                       fmt::format("check the rig's twist, angle and weight, or give simulation.segments: {}",
                                   segments_for(worst / most_turn)));
  }

  const Rig& rig_;
  const pipeline::Dresspack& dresspack_;
  int segments_;
  pipeline::BendWay way_;
  double segment_, edge_;
  int line_ = 0;
  PrescribedDeformation result_;
};

}  // namespace

FlexShares flex_shares(double radius, double travel) {
  const double bend = EIGEN_PI * radius, sweep = travel / 2, all = bend + sweep;
  return {std::max(0.0, sweep - bend) / all, 2 * std::min(sweep, bend) / all};
}

PrescribedDeformation rig_deformation(const Rig& rig, const pipeline::Setup& setup) {
  return Expansion(rig, setup).make();
}

}  // namespace dresslife::sim
