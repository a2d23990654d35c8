// Attribution of a wire's damage to the robot's joints, and of the damage of segments to the nearest clamp.
//
// The relative pose of its two clamps bends and twists a hose. Only the joints between the two links with clamps change this
// pose. Every other joint moves the dresspack as a whole, and strains it only by gravity and swinging. The wire's strain is
// therefore written as a quadratic function of the joints between the clamps, fitted to the whole motion by least squares:
//     eps(t) = f(q(t)) + remainder                                                               (F19)
// A cycle opens at sample b and closes at e. On a straight path from q_b to q_e, joint j changes f by exactly
//     c_j = df/dq_j((q_b + q_e)/2) (q_ej - q_bj),     sum over j of c_j = f(q_e) - f(q_b)         (F20)
// (f is quadratic). Joint j gets the share c_j / (eps_e - eps_b) of the cycle's damage. The remainder (gravity, swinging,
// friction, and deviations from a quadratic function) is assigned to the last cause, `carrying`. The shares of a cycle add up to
// its damage. A negative share means that a joint moved against the others: without its motion the cycle would be larger.
// `explained`, the share of the strain's variance that f explains, shows how reliable the shares are.
//
// The motion does not distinguish joints that always move together. A weak ridge divides the damage evenly among them.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "fatigue/damage.h"
#include "pipeline/job/routing.h"

namespace dresslife::pipeline {
struct Setup;
}

namespace dresslife::fatigue {

/// Returns whether each driven axis moves a joint between the links of the two clamps, (axis). A joint that follows another one
/// counts for the axis that it follows. Empty for a job without a robot.
std::vector<bool> joints_between_clamps(const pipeline::Setup& setup, std::size_t dresspack = 0);

/// The fitted function (F19).
class StrainOfJoints {
 public:
  /// position: (sample, joint) of the driven joints [rad]. known: samples with known strain, and the strain. between: (joint) joints
  /// that may contribute; joints that stand still do not. Precondition: at least one sample, and one known strain.
  StrainOfJoints(std::span<const double> position, std::span<const Reversal> known, const std::vector<bool>& between);

  std::size_t joints() const { return scale_.size(); }
  double explained() const { return explained_; }  ///< in [0, 1]; 0 for a constant strain
  /// Returns c_j of (F20), (joint).
  std::vector<double> change(std::size_t from, std::size_t to) const;

 private:
  Eigen::VectorXd scaled(std::size_t sample) const;

  std::span<const double> position_;
  std::vector<double> middle_, scale_;  ///< (joint)
  std::vector<std::size_t> active_;     ///< joints that contribute and move
  Eigen::VectorXd linear_;              ///< (active)
  Eigen::MatrixXd quadratic_;           ///< (active, active), symmetric
  double explained_ = 0;
};

struct JointDamage {
  std::vector<double> damage;   ///< (joint + 1) of all cycles; the last one is `carrying`
  std::vector<double> by_line;  ///< (line, joint + 1) of the cycles that close in a program line
};

/// Divides the damage of these cycles among the joints. step: (sample) program line or -1.
JointDamage damage_by_joint(std::span<const DamagingCycle> cycles, const StrainOfJoints& surface,
                            std::span<const std::int32_t> step, std::size_t lines);

/// Returns the damage of the segments whose centres are nearest to each clamp, (clamp). segment_damage, length: (segment) of one
/// dresspack, from its base clamp. clamp_at: (clamp) distance from the base clamp [m], rising. Precondition: at least one clamp.
std::vector<double> damage_by_clamp(std::span<const double> segment_damage, std::span<const double> length,
                                    std::span<const double> clamp_at);

/// A clamp of a dresspack, base clamp first.
struct ClampPlace {
  std::string name;  ///< "base clamp", "clamp 1 on link_4", "tool clamp"
  double at = 0;     ///< along the dresspack, from the base clamp [m]
};

/// Returns the clamps of a dresspack. length: sum of its segments [m]. A free tool end has no clamp.
std::vector<ClampPlace> clamps_of(const pipeline::Routing& routing, double length);

}  // namespace dresslife::fatigue
