#include "fatigue/corkscrew.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "pipeline/base/halving.h"
#include "pipeline/cable/believable.h"
#include "pipeline/cable/cable_bending.h"
#include "pipeline/cable/cable_force.h"
#include "pipeline/cable/polymer.h"
#include "pipeline/files/motion_layout.h"

namespace dresslife::fatigue {
namespace {

constexpr double tightest_diameters = 5;

BoredCable bored(const pipeline::Dresspack& dresspack, const pipeline::Component& cable,
                 const pipeline::CableForce& force, double room, double length) {
  return {force.bending_stiffness(),
          pipeline::pull_and_twist(dresspack, cable).relaxed() +
              pipeline::torsion_of_polymer * pipeline::polymer_bending(cable),
          room, 1 / (tightest_diameters * 2 * cable.radius), length};
}

/// Returns whether the robot ends in its first pose, except for whole turns of its joints. Otherwise the next repeat
/// starts with a move that is not in the motion, and the remaining twist is unknown.
bool returns(const pipeline::FileReader& strain) {
  if (!strain.has("/robot/joint_position")) return false;
  const auto angle = strain.read<double>("/robot/joint_position");
  const std::size_t joints = angle.size() / strain.length("sample");
  constexpr double turn = 2 * std::numbers::pi;
  for (std::size_t k = 0; k < joints; ++k)
    if (std::abs(std::remainder(angle[angle.size() - joints + k] - angle[k], turn)) > least_turn_left) return false;
  return true;
}

/// Segments, length and remaining twist of a dresspack.
struct Shape {
  std::vector<std::size_t> segment;  ///< numbers in the file
  std::vector<double> middle;        ///< from the base clamp [m]
  double length = 0, turn_left = 0;  ///< [m], [rad]
  bool knows_turn = true;            ///< see Corkscrew

  Shape(const pipeline::FileReader& strain, std::size_t dresspack, const std::vector<double>& twist) {
    const auto lengths = strain.read<double>("/segment/length");
    const auto of = pipeline::dresspack_of_segments(strain);
    for (std::size_t k = 0; k < of.size(); ++k) {
      if (of[k] != dresspack) continue;
      segment.push_back(k), middle.push_back(length + lengths[k] / 2);
      length += lengths[k];
      turn_left += lengths[k] * (twist[twist.size() - of.size() + k] - twist[k]);
    }
    turn_left = std::abs(turn_left);
    knows_turn = turn_left < least_turn_left || returns(strain);
    if (turn_left < least_turn_left || !knows_turn) turn_left = 0;
  }
};

}  // namespace

double BoredCable::torque_to_coil(double compression, double curvature) const {
  const double k = std::abs(compression) * curvature / room;
  // The slope over q is zero where E I q^4 + P q^2 = 3 k.
  const double free = (std::sqrt(compression * compression + 12 * bending * k) - compression) / (2 * bending);
  const double q = std::max(std::sqrt(free), 2 * std::numbers::pi / length);
  return bending * q + k / (q * q * q) - compression / q;
}

double BoredCable::torque_to_tighten(double compression) const {
  const double q = std::sqrt(tightest / room);
  return (4 * bending * q * q - 2 * compression) / (3 * q);
}

double BoredCable::critical_torque(double compression, double curvature) const {
  return std::max(torque_to_coil(compression, curvature), torque_to_tighten(compression));
}

double BoredCable::margin(double compression, double torque, double curvature) const {
  constexpr int to_rounding = 50;
  const auto holds = [&](double margin) {
    return !(margin * torque >= critical_torque(margin * compression, curvature));
  };
  return pipeline::halved(0, largest_margin, to_rounding, holds).high;
}

std::optional<Corkscrew> corkscrew(const pipeline::FileReader& strain, const pipeline::Job& job, std::size_t dresspack,
                                   const std::vector<std::vector<double>>& tension) {
  if (tension.empty() || !strain.has("/cable/room")) return {};
  const auto room = strain.read<double>("/cable/room");
  const auto of = strain.read<std::int32_t>("/cable/dresspack"),
             component = strain.read<std::int32_t>("/cable/component");
  const auto curvature = strain.read<double>("/deformation/curvature"),
             twist = strain.read<double>("/deformation/twist");
  const std::size_t segments = strain.length("segment");
  const Shape shape(strain, dresspack, twist);
  const pipeline::Dresspack& mounted = job.dresspacks[dresspack].dresspack;
  std::optional<Corkscrew> worst;
  for (std::size_t k = 0; k < tension.size(); ++k) {
    if (static_cast<std::size_t>(of[k]) != dresspack || !(room[k] > 0)) continue;
    if (std::isinf(room[k])) return {};
    const pipeline::Component& part = mounted.components[static_cast<std::size_t>(component[k])];
    const pipeline::CableForce force(mounted, part);
    const double most =
        force.strength() > 0 ? pipeline::believable_share * force.strength() : std::numeric_limits<double>::infinity();
    if (std::ranges::any_of(tension[k], [&](double pull) { return std::abs(pull) > most; })) return {};
    const BoredCable cable = bored(mounted, part, force, room[k], shape.length);
    const double growth = cable.torsion * shape.turn_left / shape.length;  // increase of the torque per repeat
    if (!worst)
      worst = Corkscrew{k, BoredCable::largest_margin, std::numeric_limits<double>::infinity(), shape.turn_left,
                        shape.knows_turn};
    for (std::size_t t = 0; t < tension[k].size(); ++t)
      for (std::size_t i = 0; i < shape.segment.size(); ++i) {
        const std::size_t row = t * segments + shape.segment[i];
        const double compression = -tension[k][t], torque = cable.torsion * std::abs(twist[row]);
        // A smaller margin needs a place that is beyond both limits under the forces and the twist of the smallest margin so far.
        const bool tight = worst->margin * torque >= cable.torque_to_tighten(worst->margin * compression);
        if (!tight && growth == 0) continue;
        const double bend = std::hypot(curvature[2 * row], curvature[2 * row + 1]);
        if (growth > 0)
          worst->repeats =
              std::min(worst->repeats, std::max(1.0, (cable.critical_torque(compression, bend) - torque) / growth));
        if (!tight || worst->margin * torque < cable.torque_to_coil(worst->margin * compression, bend)) continue;
        worst->margin = cable.margin(compression, torque, bend);
        worst->cable = k, worst->position = shape.middle[i], worst->sample = t;
      }
  }
  return worst;
}

}  // namespace dresslife::fatigue
