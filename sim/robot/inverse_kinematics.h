// Joint angles at which a robot's flange is where a program wants it, and which of the arms that reach it is
// meant.
//
// Six axes with a spherical wrist: axis 2 is perpendicular to axis 1, axis 3 parallel to axis 2, axes 4, 5, 6
// meet in one point, the wrist centre W. With axes (p_i, w_i) at zero angles, all in closed form:
// (K1) w2.R1(-q1)(W - p1) = w2.(W0 - p1): turning about axes 2 and 3 keeps W at its distance beside axis 1;
//      two q1, in front of and behind the axis.
// (K2) |W' - p2|^2 = |p3 - p2|^2 + |W0 - p3|^2 + 2 (p3 - p2).R3(q3)(W0 - p3), in the plane across w2: two q3,
//      the elbow on either side; then q2 by the angle between the two directions that it turns into one.
// (K3) w4.M w6 = w4.R5(q5) w6, M = (R1 R2 R3)^-1 R R0^-1: two q5; then q4 and q6 from what they turn. Where
//      w6 comes to lie on w4, q4 is free: it stays where the robot was.
// Each is a cos q + b sin q = c. Eight arms at most. Each axis may be whole turns away, within its limits.
//
// The axes of a URDF that was written by hand fit this nearly: 1.57 or 1.57076 for a right angle leaves axes
// 4, 5 and 6 some micrometres or a millimetre apart. Figures of two decimals are off by 5 mrad and 5 mm at
// most. Up to there the closed form gives starts, and numerical_inverse.h iterates from them, so that the
// flange of the robot as it is written reaches its target. All other arms of six turning axes (UR, CRX, GoFa)
// are solved by numerical_inverse.h alone: along a path from the arm before, for a single target from many
// starts.
//
// Which arm: front(1) = (W - p1).R1 x > 0; front(2): W in front of the line from p2 to p3, seen with the
// arm's front to the right; q5 >= 0. At zero angles of axis 1 the arm's front is x.
//   ABB    confdata: floor(q/90 deg) of axes 1, 4, 6; cfx = 4 behind(1) + 2 behind(2) + (q5 < 0).
//   KUKA   S = behind(1) + 2 front(2) + 4 (q5 < 0); bit i of T is q_i < 0.
//   Fanuc  N where q5 <= 0, U where front(2), T where front(1); turns of axes 1, 4, 6 counted from 0 at
//          +-180 deg.
//   Motoman  behind(1), lower arm = behind(2), axes R, T, S 180 deg or more from zero; of the wrist, axis R within
//          90 deg of zero or the sign of q5: controllers differ (sim/program/inform/inform.cpp).
//   near   the arm nearest to six angles by the time that its axes take (UR's qnear).
// Sources of the words: RAPID data types (confdata); KUKA System Software (status and turn); FANUC operator's
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

/// For messages: text(), of KUKA as its programs write it, "S 2, T 35".
std::string in_words(const ArmConfiguration& configuration);

class InverseKinematics {
 public:
  explicit InverseKinematics(const pipeline::Robot& robot);

  /// Empty, or why this robot cannot be solved for.
  const std::string& unsupported() const { return unsupported_; }
  /// Why no closed form fits this robot, not even nearly; empty: one does.
  const std::string& without_closed_form() const { return open_; }
  /// Whether the arm is about to lose a direction in which it can move or turn: near such a place a path asks
  /// axes to jump.
  bool singular(const Eigen::VectorXd& joints) const;

  /// The flange in the frame that programs are written in, at these values of all axes (robot.h). Any serial
  /// robot. The frame stands still: a robot on a track moves in it.
  Frame flange(const Eigen::VectorXd& axes) const;

  /// Every arm (six angles) that reaches the flange's frame while external axes are at 0, angles within
  /// (-pi, pi]; at singular wrists axis 4 as in `near`. Without a closed form: those that are found.
  std::vector<Eigen::VectorXd> arms(const Frame& flange, const Eigen::VectorXd& near) const;

  /// The arm of this configuration within the limits, else (any) the one nearest to `near` by the time to get
  /// there; all axes, the external ones as in `near`. Absent: none; `reason` says why. Without a closed form
  /// several arms may have one configuration: then none is returned.
  std::optional<Eigen::VectorXd> solve(const Frame& flange, const ArmConfiguration& configuration,
                                       const Eigen::VectorXd& near, std::string& reason) const;

  /// The arm that goes on from `near` on a path whose next point is this near; all axes.
  std::optional<Eigen::VectorXd> follow(const Frame& flange, const Eigen::VectorXd& near,
                                        std::string& reason) const;

  /// Whether a path may end with these angles where its program says `programmed`. ABB watches axes 1, 4 and
  /// 6, which may be a quadrant off (ConfL); Fanuc wants its letters and turns; others ignore it.
  bool may_end(const Eigen::VectorXd& joints, const ArmConfiguration& programmed) const;

  /// The configuration at these angles, in the words of a controller.
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
  std::string beyond_limits(const Eigen::VectorXd& arm, int turns, double* most = nullptr) const;
  std::string least_beyond(const std::vector<Eigen::VectorXd>& arms) const;
  bool matches(const Eigen::VectorXd& joints, const ArmConfiguration& wanted, bool with_sides) const;

  const pipeline::Robot robot_;
  Frame on_tracks(const Frame& flange, const Eigen::VectorXd& near) const;

  const long externals_;
  RobotKinematics kinematics_;
  Frame base_, to_program_;  // of link 0 while external axes are at 0; the programs' frame, inverted
  Frame flange_in_link_;
  std::array<Vector3, 6> point_{};   // p_i at zero, in the programs' frame
  std::array<Vector3, 6> axis_{};    // w_i
  Vector3 wrist_ = Vector3::Zero();  // W0
  Frame zero_;                       // flange at zero
  std::string unsupported_, open_;
  bool exact_ = false;  // the closed form needs no iteration
  std::optional<NumericalInverse> numerical_;
};

/// For readers of programs; empty for a robot without six axes, or with external ones, whose place it depends on.
FlangeAt flange_at(const pipeline::Robot& robot);

}  // namespace dresslife::sim
