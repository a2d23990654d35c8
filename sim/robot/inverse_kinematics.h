// Joint angles for a pose of a robot's flange, and the choice among the arms that reach the pose. "Arm" means one solution: six
// joint angles.
//
// Six axes with a spherical wrist: axis 2 is perpendicular to axis 1, axis 3 parallel to axis 2, axes 4, 5, 6
// meet in one point, the wrist centre W. With axes (p_i, w_i) at zero angles, all solutions have closed forms:
// (K1) w2.R1(-q1)(W - p1) = w2.(W0 - p1): rotations about axes 2 and 3 do not change the offset of W from axis 1;
//      two q1, in front of and behind the axis.
// (K2) |W' - p2|^2 = |p3 - p2|^2 + |W0 - p3|^2 + 2 (p3 - p2).R3(q3)(W0 - p3), in the plane perpendicular to w2: two q3,
//      the elbow on either side; then q2 is the angle between the directions before and after its rotation.
// (K3) w4.M w6 = w4.R5(q5) w6, M = (R1 R2 R3)^-1 R R0^-1: two q5; then q4 and q6 from the rotations that remain. If
//      w6 is parallel to w4, q4 is free: it keeps its previous value.
// Each equation has the form a cos q + b sin q = c. At most eight arms. Each axis may have additional full turns within its
// limits.
//
// The axes of a URDF that was written by hand fulfil these conditions only nearly: with 1.57 or 1.57076 for a right angle the
// axes 4, 5 and 6 miss each other by micrometres or a millimetre. Numbers with two decimals have errors of at most 5 mrad and 5
// mm. Up to these errors the closed form gives starting values, and numerical_inverse.h iterates from them, so that the
// flange of the robot as written reaches its target. All other arms of six rotary axes (UR, CRX, GoFa)
// are solved by numerical_inverse.h only: along a path from the previous arm, for a single target from many
// starts.
//
// Configuration of an arm: front(1) = (W - p1).R1 x > 0; front(2): W in front of the line from p2 to p3, seen with the
// arm's front to the right; q5 >= 0. At zero angle of axis 1 the arm's front is x.
//   ABB    confdata: floor(q/90 deg) of axes 1, 4, 6; cfx = 4 behind(1) + 2 behind(2) + (q5 < 0).
//   KUKA   S = behind(1) + 2 front(2) + 4 (q5 < 0); bit i of T is q_i < 0.
//   Fanuc  N if q5 <= 0, U if front(2), T if front(1); turns of axes 1, 4, 6 counted from 0 at
//          +-180 deg.
//   Motoman  behind(1), lower arm = behind(2), axes R, T, S 180 deg or more from zero; for the wrist, axis R within
//          90 deg of zero or the sign of q5: controllers differ (sim/program/inform/inform.cpp).
//   near   the arm nearest to six given angles, measured by the travel time of its axes (UR's qnear).
// Sources of these definitions: RAPID data types (confdata); KUKA System Software (status and turn); FANUC operator's
// manual.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/job/robot.h"
#include "sim/program/interpreter/program.h"
#include "sim/robot/numerical_inverse.h"
#include "sim/robot/robot.h"

namespace dresslife::sim {

/// Returns a configuration for messages: text(); for KUKA in the notation of its programs, "S 2, T 35".
std::string in_words(const ArmConfiguration& configuration);

class InverseKinematics {
 public:
  explicit InverseKinematics(const pipeline::Robot& robot);

  /// Returns the reason why this robot has no solution; empty: it can be solved.
  const std::string& unsupported() const { return unsupported_; }
  /// Returns the reason why no closed form fits this robot, not even nearly; empty: a closed form exists.
  const std::string& without_closed_form() const { return open_; }
  /// Returns whether the arm nearly loses a direction of motion or rotation. Near such a pose a path requires very fast axes.
  bool singular(const Eigen::VectorXd& joints) const;

  /// Returns the flange in the frame of the programs at these values of all axes (robot.h). Valid for any serial
  /// robot. The frame does not move: a robot on a track moves in it.
  Frame flange(const Eigen::VectorXd& axes) const;

  /// Returns every arm (six angles) that reaches the flange's frame while external axes are at 0, angles within
  /// (-pi, pi]; at singular wrists axis 4 as in `near`. Without a closed form: the arms that the iteration finds.
  std::vector<Eigen::VectorXd> arms(const Frame& flange, const Eigen::VectorXd& near) const;

  /// Returns the arm of this configuration within the limits; for `any` the arm with the shortest travel time from `near`. All
  /// axes; external axes as in `near`. Absent: no such arm; `reason` contains the cause. Without a closed form
  /// several arms may have one configuration: then the result is absent.
  std::optional<Eigen::VectorXd> solve(const Frame& flange, const ArmConfiguration& configuration,
                                       const Eigen::VectorXd& near, std::string& reason) const;

  /// Returns the arm that continues a path from `near` to a close next point; all axes.
  std::optional<Eigen::VectorXd> follow(const Frame& flange, const Eigen::VectorXd& near, std::string& reason) const;

  /// The axis that is farthest outside of its limits. axis: empty: none is.
  struct Excess {
    std::string axis;
    double angle = 0;  ///< [rad]
  };
  /// Returns the excess of the arm that reaches the flange's frame with the least excess.
  Excess excess(const Frame& flange, const Eigen::VectorXd& near) const;

  /// Returns whether a path may end with these angles if its program states `programmed`. ABB monitors axes 1, 4 and
  /// 6, which may differ by a quadrant (ConfL); Fanuc requires equal letters and turns; others ignore it.
  bool may_end(const Eigen::VectorXd& joints, const ArmConfiguration& programmed) const;

  /// Returns the configuration of these angles in the notation of a controller.
  ArmConfiguration configuration(const Eigen::VectorXd& joints, ArmConfiguration::Kind kind) const;

 private:
  struct Sides {
    bool front_of_axis, front_of_arm, wrist_positive;
  };
  void check_geometry();
  std::vector<Eigen::VectorXd> closed_arms(const Frame& flange, const Eigen::VectorXd& near) const;
  Eigen::VectorXd whole(const Eigen::VectorXd& joints, const Eigen::VectorXd& near) const;
  Sides sides(const Eigen::VectorXd& joints) const;
  void add_wrists(const Frame& flange, double q1, double q2, double q3, const Eigen::VectorXd& near,
                  std::vector<Eigen::VectorXd>& found) const;
  std::vector<Eigen::VectorXd> with_turns(const Eigen::VectorXd& arm) const;
  std::string beyond_limits(const Eigen::VectorXd& arm, int turns, Excess* most = nullptr) const;
  std::string least_beyond(const std::vector<Eigen::VectorXd>& arms, Excess* most = nullptr) const;
  bool matches(const Eigen::VectorXd& joints, const ArmConfiguration& wanted, bool with_sides) const;

  const pipeline::Robot robot_;
  Frame on_tracks(const Frame& flange, const Eigen::VectorXd& near) const;

  const long externals_;
  RobotKinematics kinematics_;
  Frame base_, to_program_;  // base_: link 0 while external axes are at 0; to_program_: inverse of the programs' frame
  Frame flange_in_link_;
  std::array<Vector3, 6> point_{};   // p_i at zero, in the programs' frame
  std::array<Vector3, 6> axis_{};    // w_i
  Vector3 wrist_ = Vector3::Zero();  // W0
  Frame zero_;                       // flange at zero angles
  std::string unsupported_, open_;
  bool exact_ = false;  // the closed form needs no iteration
  std::optional<NumericalInverse> numerical_;
};

/// Returns the flange for readers of programs; empty for a robot without six axes or with external axes, on which the flange
/// would depend.
FlangeAt flange_at(const pipeline::Robot& robot);

}  // namespace dresslife::sim
