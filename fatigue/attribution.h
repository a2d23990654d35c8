// Which joint costs the life: the damage of a wire, shared out among the robot's joints; and which clamp is
// nearest to it.
//
// A hose that hangs between two clamps is bent and twisted by how the clamps stand to each other. Only the
// joints between the two links that carry the clamps change that; every other joint carries the dresspack
// about as a whole, which strains it by gravity and swinging alone. So the wire's strain is written as a
// surface over the joints between the clamps, quadratic, fitted to the whole motion by least squares:
//     eps(t) = f(q(t)) + remainder                                                               (F19)
// A cycle opens at sample b and closes at e. Going straight from q_b to q_e, joint j changes f by exactly
//     c_j = df/dq_j((q_b + q_e)/2) (q_ej - q_bj),     sum over j of c_j = f(q_e) - f(q_b)         (F20)
// (f is quadratic), and the cycle's damage is put on joint j in the proportion c_j / (eps_e - eps_b); what
// is left over, gravity, swinging, friction and what a quadratic surface cannot follow, is the last cause:
// carrying. The shares of a cycle add up to its damage. A negative share is a joint that moved against the
// others: without its motion the cycle would have been larger.
// `explained`, the share of the strain's variance that f takes up, says how far to trust this.
//
// No motion distinguishes joints that always move together. A weak ridge then divides the damage evenly among them.
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

/// (joint) whether it lies between the links of the two clamps. Empty for a job without a robot.
std::vector<bool> joints_between_clamps(const pipeline::Setup& setup, std::size_t dresspack = 0);

/// The surface (F19).
class StrainOfJoints {
 public:
  /// position: (sample, joint) [rad]; known: where the strain is known, its sample and value; between:
  /// (joint) those that may count. Joints that stand still do not. Precondition: at least one sample, one
  /// known.
  StrainOfJoints(std::span<const double> position, std::span<const Reversal> known,
                 const std::vector<bool>& between);

  std::size_t joints() const { return scale_.size(); }
  double explained() const { return explained_; }  ///< in [0, 1]; 0 for a constant strain
  /// (joint) c_j of (F20).
  std::vector<double> change(std::size_t from, std::size_t to) const;

 private:
  Eigen::VectorXd scaled(std::size_t sample) const;

  std::span<const double> position_;
  std::vector<double> middle_, scale_;  ///< (joint)
  std::vector<std::size_t> active_;     ///< joints that count and move
  Eigen::VectorXd linear_;              ///< (active)
  Eigen::MatrixXd quadratic_;           ///< (active, active), symmetric
  double explained_ = 0;
};

struct JointDamage {
  std::vector<double> damage;   ///< (joint + 1) of all cycles; the last is carrying
  std::vector<double> by_line;  ///< (line, joint + 1) of those that close in a program line
};

/// Shares the damage of these cycles out. step: (sample) program line or -1.
JointDamage damage_by_joint(std::span<const DamagingCycle> cycles, const StrainOfJoints& surface,
                            std::span<const std::int32_t> step, std::size_t lines);

/// (clamp) the damage of the segments whose centres lie nearest to it. segment_damage, length: (segment) of
/// one dresspack, from its base clamp. clamp_at: (clamp) where they hold it, from the base clamp [m], rising;
/// at least one.
std::vector<double> damage_by_clamp(std::span<const double> segment_damage, std::span<const double> length,
                                    std::span<const double> clamp_at);

/// A clamp of a dresspack, base clamp first.
struct ClampPlace {
  std::string name;  ///< "base clamp", "clamp 1 on link_4", "tool clamp"
  double at = 0;     ///< along the dresspack, from the base clamp [m]
};

/// length: of the dresspack's segments together [m]. A free tool end has no clamp.
std::vector<ClampPlace> clamps_of(const pipeline::Routing& routing, double length);

}  // namespace dresslife::fatigue
