#include "sim/robot/inverse_kinematics.h"

#include "pipeline/base/constants.h"
#include "pipeline/base/joined.h"
#include "sim/robot/robot.h"

#include <algorithm>
#include <cmath>

namespace dresslife::sim {
namespace {

using Eigen::VectorXd;

constexpr double alignment =
    1e-6;  // tolerance with which a closed form takes axes as parallel, perpendicular or intersecting [1, m]
/// The same tolerance for numbers with two decimals (1.57 for a right angle), where the closed form only gives
/// starts.
constexpr double rounded_alignment = 5e-3;
constexpr double no_direction =
    1e-3;  // of the singular values: an axis would move a thousand times as fast as the flange
constexpr double singular_wrist = 1e-9;  // sine between axes 4 and 6 below which q4 is free
constexpr double out_of_reach = 1e-9;    // of a cosine: rounding at a stretched arm

Quaternion turn(const Vector3& axis, double angle) { return Quaternion(Eigen::AngleAxisd(angle, axis)); }

/// Returns the angle of the rotation about `axis` from `from` to `to`, both projected along the axis.
double turned(const Vector3& axis, const Vector3& from, const Vector3& to) {
  const Vector3 a = from - axis.dot(from) * axis, b = to - axis.dot(to) * axis;
  return std::atan2(axis.dot(a.cross(b)), a.dot(b));
}

/// Returns q with a cos q + b sin q = c: none, or two (equal at the limit of reach).
std::vector<double> angles(double a, double b, double c) {
  const double radius = std::hypot(a, b);
  if (radius < 1e-12) return {};
  const double cosine = c / radius;
  if (std::abs(cosine) > 1 + out_of_reach) return {};
  const double middle = std::atan2(b, a), half = std::acos(std::clamp(cosine, -1.0, 1.0));
  return {middle + half, middle - half};
}

}  // namespace

InverseKinematics::InverseKinematics(const pipeline::Robot& robot)
    : robot_(robot),
      externals_(static_cast<long>(robot.external_axes.size())),
      kinematics_(robot),
      flange_in_link_{robot.flange_position, from_roll_pitch_yaw(robot.flange_orientation)} {
  const VectorXd zero = VectorXd::Zero(kinematics_.axes());
  std::vector<Frame> frames(static_cast<std::size_t>(kinematics_.links()));
  kinematics_.link_frames({zero.data(), static_cast<std::size_t>(zero.size())}, frames);
  base_ = frames[0];
  to_program_ = inverse(base_ * Frame{robot.program_base, from_roll_pitch_yaw(robot.program_orientation)});
  zero_ = flange(zero);
  check_geometry();
}

Frame InverseKinematics::flange(const VectorXd& axes) const {
  std::vector<Frame> frames(static_cast<std::size_t>(kinematics_.links()));
  kinematics_.link_frames({axes.data(), static_cast<std::size_t>(axes.size())}, frames);
  return to_program_ * frames.back() * flange_in_link_;
}

/// Returns the pose of the flange if all external axes were at 0.
Frame InverseKinematics::on_tracks(const Frame& flange, const VectorXd& near) const {
  if (externals_ == 0 || near.size() != kinematics_.axes()) return flange;
  std::vector<Frame> frames(static_cast<std::size_t>(kinematics_.links()));
  kinematics_.link_frames({near.data(), static_cast<std::size_t>(near.size())}, frames);
  return to_program_ * base_ * inverse(frames[0]) * inverse(to_program_) * flange;
}

void InverseKinematics::check_geometry() {
  if (robot_.joints.size() != 6 || robot_.axes() != 6) {
    unsupported_ =
        robot_.axes() == 6 ? "a rod moves some of its joints" : fmt::format("it has {} axes, not six", robot_.axes());
    return;
  }
  const VectorXd zero = VectorXd::Zero(kinematics_.axes());
  std::vector<Frame> frames(7);
  kinematics_.link_frames({zero.data(), static_cast<std::size_t>(zero.size())}, frames);
  for (int i = 0; i < 6; ++i) {
    const Frame joint = to_program_ * frames[i + 1];
    point_[i] = joint.position;
    axis_[i] = joint.orientation * robot_.joints[i].axis.normalized();
  }
  NumericalInverse::Angles lower, upper;
  for (int i = 0; i < 6; ++i) {
    lower[i] = robot_.joints[i].lower;
    upper[i] = robot_.joints[i].upper;
  }
  numerical_.emplace(point_, axis_, zero_, lower, upper);
  // The wrist centre lies on axis 5, where axis 4 is nearest; axis 6 must also pass through it.
  const Vector3 across = axis_[3].cross(axis_[4]);
  wrist_ = point_[4];
  if (across.norm() > rounded_alignment)
    wrist_ = point_[4] +
             axis_[4] * (point_[3] - point_[4]).cross(axis_[3]).dot(axis_[4].cross(axis_[3])) / across.squaredNorm();
  const auto off = [&](int i) { return (wrist_ - point_[i]).cross(axis_[i]).norm(); };
  const double leaning = std::abs(axis_[0].dot(axis_[1])), skewed = axis_[1].cross(axis_[2]).norm(),
               apart = std::max({off(3), off(4), off(5)});
  exact_ = std::max({leaning, skewed, apart}) <= alignment;
  if (leaning > rounded_alignment)
    open_ = "axis 2 is not perpendicular to axis 1";
  else if (skewed > rounded_alignment)
    open_ = "axis 3 is not parallel to axis 2";
  else if (across.norm() <= rounded_alignment || apart > rounded_alignment)
    open_ = "axes 4, 5 and 6 do not meet in one point";
}

bool InverseKinematics::singular(const VectorXd& joints) const {
  return numerical_ && numerical_->dexterity(joints.head<6>()) < no_direction;
}

std::vector<VectorXd> InverseKinematics::arms(const Frame& flange, const VectorXd& near) const {
  if (!unsupported_.empty()) return {};
  if (exact_) return closed_arms(flange, near);
  NumericalInverse::Angles start = NumericalInverse::Angles::Zero();
  if (near.size() >= 6) start = near.head<6>();
  std::vector<VectorXd> found;
  if (!open_.empty()) {
    for (const auto& arm : numerical_->arms(flange, start)) found.push_back(arm);
    return found;
  }
  for (const VectorXd& nearly : closed_arms(flange, near))
    if (auto arm = numerical_->solve(flange, nearly.head<6>())) {
      for (double& angle : *arm) angle = wrapped(angle);
      found.push_back(*arm);
    }
  if (auto arm = found.empty() ? numerical_->solve(flange, start) : std::nullopt) {  // e.g. at a singular wrist
    for (double& angle : *arm) angle = wrapped(angle);
    found.push_back(*arm);
  }
  return found;
}

std::vector<VectorXd> InverseKinematics::closed_arms(const Frame& flange, const VectorXd& near) const {
  std::vector<VectorXd> found;
  // The flange's frame determines the wrist centre.
  const Vector3 wrist = flange.point(inverse(zero_).point(wrist_));
  const Vector3 w1 = axis_[0], w2 = axis_[1], w3 = axis_[2];
  const Vector3 from = wrist - point_[0];
  // (K1): w2.R1(-q) v = w2.(v cos q + (v x w1) sin q) for the part of v perpendicular to w1; the part along w1 has no share in
  // w2.
  const double beside = w2.dot(wrist_ - point_[0]);
  for (double q1 : angles(w2.dot(from), w2.dot(from.cross(w1)), beside)) {
    const Vector3 in_plane = point_[0] + turn(w1, -q1) * from;  // W' of (K2)
    const auto flat = [&](const Vector3& v) { return Vector3(v - w2.dot(v) * w2); };
    const Vector3 lower = flat(point_[2] - point_[1]), upper = flat(wrist_ - point_[2]),
                  reach = flat(in_plane - point_[1]);
    const double c = (reach.squaredNorm() - lower.squaredNorm() - upper.squaredNorm()) / 2;
    for (double q3 : angles(lower.dot(upper), lower.dot(w3.cross(upper)), c)) {
      const double q2 = turned(w2, lower + turn(w3, q3) * upper, reach);
      add_wrists(flange, q1, q2, q3, near, found);
    }
  }
  return found;
}

void InverseKinematics::add_wrists(const Frame& flange, double q1, double q2, double q3, const VectorXd& near,
                                   std::vector<VectorXd>& found) const {
  const Vector3 w4 = axis_[3], w5 = axis_[4], w6 = axis_[5];
  const Quaternion arm = turn(axis_[0], q1) * turn(axis_[1], q2) * turn(axis_[2], q3);
  const Quaternion m = arm.conjugate() * flange.orientation * zero_.orientation.conjugate();  // M of (K3)
  const Vector3 along = w5.dot(w6) * w5, across = w6 - along;  // R5 w6 = along + across cos + (w5 x w6) sin
  for (double q5 : angles(w4.dot(across), w4.dot(w5.cross(w6)), w4.dot(m * w6) - w4.dot(along))) {
    VectorXd joints(6);
    const Vector3 end = turn(w5, q5) * w6;
    double q4, q6;
    if (w4.cross(end).norm() < singular_wrist) {
      q4 = near.size() >= 6 ? near[3] : 0;
      const Quaternion rest = (turn(w4, q4) * turn(w5, q5)).conjugate() * m;
      const Vector3 probe = std::abs(w6.x()) < 0.5 ? Vector3::UnitX() : Vector3::UnitY();
      q6 = turned(w6, probe, rest * probe);
    } else {
      q4 = turned(w4, end, m * w6);
      q6 = -turned(w6, turn(w5, -q5) * w4, m.conjugate() * w4);
    }
    joints << wrapped(q1), wrapped(q2), wrapped(q3), wrapped(q4), wrapped(q5), wrapped(q6);
    found.push_back(joints);
  }
}

InverseKinematics::Sides InverseKinematics::sides(const VectorXd& joints) const {
  const Quaternion first = turn(axis_[0], joints[0]);
  const Vector3 front = first * Vector3::UnitX();
  const Vector3 left = axis_[0].z() < 0 ? Vector3(front.cross(axis_[0])) : Vector3(axis_[0].cross(front));
  const Quaternion second = first * turn(axis_[1], joints[1]);
  const Vector3 elbow = point_[0] + first * (point_[1] - point_[0]) + second * (point_[2] - point_[1]);
  const Vector3 shoulder = point_[0] + first * (point_[1] - point_[0]);
  const Vector3 wrist = elbow + second * turn(axis_[2], joints[2]) * (wrist_ - point_[2]);
  const Vector3 lower = elbow - shoulder;
  return {(wrist - point_[0]).dot(front) >= 0, lower.cross(wrist - elbow).dot(left) >= 0, joints[4] >= 0};
}

ArmConfiguration InverseKinematics::configuration(const VectorXd& joints, ArmConfiguration::Kind kind) const {
  const Sides side = sides(joints);
  ArmConfiguration made{kind, {}};
  const auto quadrant = [&](int axis) { return static_cast<int>(std::floor(joints[axis] / (pi / 2))); };
  const auto turns = [&](int axis) { return static_cast<int>(std::lround(joints[axis] / (2 * pi))); };
  switch (kind) {
    case ArmConfiguration::Kind::any:
      break;
    case ArmConfiguration::Kind::near:
      for (int axis = 0; axis < 6; ++axis)
        made.numbers.push_back(static_cast<int>(std::lround(joints[axis] * 180 / pi)));
      break;
    case ArmConfiguration::Kind::motoman: {
      const auto far = [&](int axis) { return std::abs(joints[axis]) > pi; };
      made.numbers = {std::cos(joints[3]) < 0, !side.front_of_arm, !side.front_of_axis, far(3), far(5), far(0)};
      break;
    }
    case ArmConfiguration::Kind::abb:
      made.numbers = {quadrant(0), quadrant(3), quadrant(5),
                      4 * !side.front_of_axis + 2 * !side.front_of_arm + !side.wrist_positive};
      break;
    case ArmConfiguration::Kind::kuka: {
      int turn_bits = 0;
      for (int axis = 0; axis < 6; ++axis) turn_bits |= (joints[axis] < 0) << axis;
      made.numbers = {!side.front_of_axis + 2 * side.front_of_arm + 4 * !side.wrist_positive, turn_bits};
      break;
    }
    case ArmConfiguration::Kind::fanuc:
      made.numbers = {joints[4] > 0, side.front_of_arm, side.front_of_axis, turns(0), turns(3), turns(5)};
  }
  return made;
}

std::vector<VectorXd> InverseKinematics::with_turns(const VectorXd& arm) const {
  std::vector<VectorXd> list{arm};
  for (long axis = 0; axis < 6; ++axis) {
    const pipeline::Joint& joint = robot_.joints[axis];
    std::vector<VectorXd> more;
    for (const VectorXd& joints : list)
      for (int k = -3; k <= 3; ++k) {
        const double angle = joints[axis] + 2 * pi * k;
        if (angle < joint.lower - limit_rounding || angle > joint.upper + limit_rounding) continue;
        more.push_back(joints);
        more.back()[axis] = angle;
      }
    list = std::move(more);
  }
  return list;
}

/// Returns "joint_4 at 361.2 deg, 11.2 deg above its 350". turns: number of full turns by which an axis may be rotated toward its
/// limits. most: receives the largest excess.
std::string InverseKinematics::beyond_limits(const VectorXd& arm, int turns, Excess* most) const {
  std::string words;
  for (long axis = 0; axis < 6; ++axis) {
    const pipeline::Joint& joint = robot_.joints[axis];
    const auto excess = [&](double angle) { return std::max(joint.lower - angle, angle - joint.upper); };
    double best = arm[axis];
    for (int k = -turns; k <= turns; ++k)
      if (const double angle = arm[axis] + 2 * pi * k; excess(angle) < excess(best)) best = angle;
    if (excess(best) <= limit_rounding) continue;
    if (most && excess(best) > most->angle) *most = {joint.name, excess(best)};
    const bool above = best > joint.upper;
    words += fmt::format("{}{} at {:.1f} deg, {:.1f} deg {} its {:.6g}", words.empty() ? "" : "; ", joint.name,
                         best * 180 / pi, excess(best) * 180 / pi, above ? "above" : "below",
                         (above ? joint.upper : joint.lower) * 180 / pi);
  }
  return words;
}

/// Returns the text of the arm with the least excess. of_it: receives its excess.
std::string InverseKinematics::least_beyond(const std::vector<VectorXd>& arms, Excess* of_it) const {
  std::string words;
  double least = INFINITY;
  for (const VectorXd& arm : arms) {
    Excess most;
    const std::string own = beyond_limits(arm, 3, &most);
    if (most.angle >= least) continue;
    least = most.angle, words = own;
    if (of_it) *of_it = most;
  }
  return words;
}

InverseKinematics::Excess InverseKinematics::excess(const Frame& flange, const VectorXd& near) const {
  Excess least;
  if (unsupported_.empty()) least_beyond(arms(on_tracks(flange, near), near), &least);
  return least;
}

/// Returns whether the angles match. Angles near a boundary of a quadrant or sign match on either side, because programs have few
/// digits.
bool InverseKinematics::matches(const VectorXd& joints, const ArmConfiguration& wanted, bool with_sides) const {
  constexpr double blur = 1e-3;  // [rad]
  const Sides side = sides(joints);
  const auto& n = wanted.numbers;
  const auto in_quadrant = [&](int axis, int quadrant) {
    return joints[axis] >= quadrant * pi / 2 - blur && joints[axis] <= (quadrant + 1) * pi / 2 + blur;
  };
  const auto negative = [&](int axis, bool wish) { return wish ? joints[axis] < blur : joints[axis] > -blur; };
  switch (wanted.kind) {
    case ArmConfiguration::Kind::any:
    case ArmConfiguration::Kind::near:
      return true;
    case ArmConfiguration::Kind::motoman: {
      const auto within = [&](int axis, bool far) {
        return far ? std::abs(joints[axis]) > pi - blur : std::abs(joints[axis]) < pi + blur;
      };
      const double turned = std::cos(joints[3]);
      const bool wrist = n[0] >= 2 ? negative(4, n[0] == 3) : n[0] == 1 ? turned < blur : turned > -blur;
      return wrist && (!with_sides || (side.front_of_arm == !n[1] && side.front_of_axis == !n[2])) && within(3, n[3]) &&
             within(5, n[4]) && within(0, n[5]);
    }
    case ArmConfiguration::Kind::abb:
      if (!in_quadrant(0, n[0]) || !in_quadrant(3, n[1]) || !in_quadrant(5, n[2])) return false;
      return !with_sides ||
             (side.front_of_axis == !(n[3] & 4) && side.front_of_arm == !(n[3] & 2) && negative(4, n[3] & 1));
    case ArmConfiguration::Kind::kuka:
      for (int axis = 0; axis < 6; ++axis)
        if (!negative(axis, n[1] >> axis & 1)) return false;
      return side.front_of_axis == !(n[0] & 1) && side.front_of_arm == bool(n[0] & 2) && negative(4, n[0] & 4);
    case ArmConfiguration::Kind::fanuc:
      break;
  }
  const auto turns = [&](int axis, int number) { return std::abs(joints[axis] - 2 * pi * number) < pi + blur; };
  return negative(4, !n[0]) && side.front_of_arm == bool(n[1]) && side.front_of_axis == bool(n[2]) && turns(0, n[3]) &&
         turns(3, n[4]) && turns(5, n[5]);
}

bool InverseKinematics::may_end(const VectorXd& joints, const ArmConfiguration& programmed) const {
  if (programmed.kind == ArmConfiguration::Kind::fanuc) return matches(joints, programmed, true);
  if (programmed.kind != ArmConfiguration::Kind::abb) return true;
  const ArmConfiguration reached = configuration(joints, programmed.kind);
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(reached.numbers[axis] - programmed.numbers[axis]) > 1) return false;
  return true;
}

VectorXd InverseKinematics::whole(const VectorXd& joints, const VectorXd& near) const {
  VectorXd all = VectorXd::Zero(6 + externals_);
  if (near.size() == all.size()) all = near;
  all.head(6) = joints;
  return all;
}

std::optional<VectorXd> InverseKinematics::follow(const Frame& flange, const VectorXd& near,
                                                  std::string& reason) const {
  if (open_.empty() || !unsupported_.empty()) return solve(flange, {}, near, reason);
  const auto arm = numerical_->solve(on_tracks(flange, near), near.head<6>());
  if (!arm) {
    reason = "is out of reach";
    return {};
  }
  if (const std::string beyond = beyond_limits(*arm, 0); !beyond.empty()) {
    reason = "is reached only outside the joint limits: " + beyond;
    return {};
  }
  return whole(*arm, near);
}

std::optional<VectorXd> InverseKinematics::solve(const Frame& flange, const ArmConfiguration& configuration,
                                                 const VectorXd& near, std::string& reason) const {
  if (!unsupported_.empty()) {
    reason = fmt::format("the arm cannot be solved for ({})", unsupported_);
    return {};
  }
  const std::vector<VectorXd> reaching = arms(on_tracks(flange, near), near);
  const bool chosen = configuration.kind == ArmConfiguration::Kind::near;
  const auto from = [&](long axis) {
    return chosen ? configuration.numbers[axis] * pi / 180 : near.size() >= 6 ? near[axis] : 0.0;
  };
  std::optional<VectorXd> best;
  double least = INFINITY;
  std::vector<std::string> others;
  bool within_limits = false;
  for (bool with_sides : {true, false}) {
    if (best || (!with_sides && configuration.kind != ArmConfiguration::Kind::abb))
      break;            // cfx is 0 in old ABB programs
    int different = 0;  // number of arms with this configuration
    for (const VectorXd& arm : reaching) {
      bool fits = false;
      for (const VectorXd& joints : with_turns(arm)) {
        within_limits = true;
        if (!matches(joints, configuration, with_sides)) {
          if (with_sides) others.push_back(in_words(this->configuration(joints, configuration.kind)));
          continue;
        }
        fits = true;
        // The time of the slowest axis, plus a small share of every axis' time, so that no axis makes an unnecessary turn.
        constexpr double share_of_others = 1e-3;
        double time = 0, sum = 0;
        for (long axis = 0; axis < 6; ++axis) {
          const double way = std::abs(joints[axis] - from(axis));
          time = std::max(time, way / robot_.joints[axis].speed);
          sum += way / robot_.joints[axis].speed;
        }
        time += share_of_others * sum;
        if (time < least) {
          least = time;
          best = joints;
        }
      }
      different += fits;
    }
    if (different > 1 && !open_.empty() && !chosen && configuration.kind != ArmConfiguration::Kind::any) {
      reason = fmt::format("is reached by {} arms of configuration {}: {}; only joint angles distinguish them",
                           different, in_words(configuration), open_);
      return {};
    }
  }
  if (best) return whole(*best, near);
  std::ranges::sort(others);
  others.erase(std::unique(others.begin(), others.end()), others.end());
  if (others.size() > 8) others.resize(8);
  if (reaching.empty())
    reason = "is out of reach";
  else if (!within_limits)
    reason = "is reached only outside the joint limits: " + least_beyond(reaching);
  else
    reason = fmt::format("is not reached in configuration {} (but in {})", in_words(configuration),
                         pipeline::joined(others, "; "));
  return {};
}

std::string in_words(const ArmConfiguration& configuration) {
  return configuration.kind == ArmConfiguration::Kind::kuka
             ? fmt::format("S {}, T {}", configuration.numbers[0], configuration.numbers[1])
             : configuration.text();
}

FlangeAt flange_at(const pipeline::Robot& robot) {
  if (!robot.external_axes.empty() || RobotKinematics(robot).axes() != 6) return {};
  return [arm = InverseKinematics(robot)](const std::array<double, 6>& angles) {
    return arm.flange(Eigen::Map<const VectorXd>(angles.data(), 6));
  };
}

}  // namespace dresslife::sim
