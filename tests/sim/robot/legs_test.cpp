#include "sim/robot/legs.h"

#include "pipeline/base/constants.h"
#include "sim/robot/inverse_kinematics.h"
#include "sim/robot/motion.h"
#include "sim/robot/tool_path.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"
#include "tests/sim/robot/small_arm.h"

using namespace dresslife;
using namespace dresslife::sim;

namespace {

using Eigen::VectorXd;
using pipeline::PathKind;

/// [rad/s, rad/s2] Roundings of 1e-16 in angles of up to 10 rad, divided once or twice by the shortest times, some ms.
constexpr double limit_margin = 1e-9;
constexpr double rounding = 1e-12;  // of a few products of numbers near 1

pipeline::Robot arm(double speed = 2, double acceleration = 8) {
  pipeline::Robot robot = small_arm();
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    robot.joints[i].speed = i < 3 ? speed : 2 * speed;
    robot.joints[i].acceleration = i < 3 ? acceleration : 4 * acceleration;
  }
  return robot;
}

pipeline::MotionStep to(PathKind path, Vector3 position, double speed, double zone) {
  pipeline::MotionStep step;
  step.path = path;
  step.position = {position.x(), position.y(), position.z()};
  const double half = std::sqrt(0.5);
  step.quaternion = {half, 0, half, 0};  // the tool forward
  step.tool_speed = speed;
  step.tool_zone = zone;
  return step;
}

pipeline::Motion motion(std::vector<pipeline::MotionStep> steps) {
  pipeline::Motion made;
  made.name = "test";
  made.steps = std::move(steps);
  return made;
}

const Vector3 corner(1.2, 0, 1.2);

}  // namespace

TEST_CASE("tool path: the circle through three points") {
  ToolPath path({}, {{1, 0, 0}, Quaternion::Identity()}, {{-1, 0, 0}, rotation({0, 0, 1})});
  path.bend({0, -1, 0});
  CHECK(path.length() == Approx(pi).epsilon(rounding));
  CHECK((path.pose(0.5).position - Vector3(0, -1, 0)).norm() < rounding);
  CHECK((path.pose(1).position - Vector3(-1, 0, 0)).norm() < rounding);
  CHECK(rotation_vector(path.pose(0.25).orientation).z() == Approx(0.25).epsilon(rounding));
  ToolPath far({}, {{1, 0, 0}, Quaternion::Identity()}, {{0, 1, 0}, Quaternion::Identity()});
  far.bend({0, -1, 0});  // the larger arc
  CHECK(far.length() == Approx(1.5 * pi).epsilon(rounding));
  ToolPath straight({}, {{1, 0, 0}, Quaternion::Identity()}, {{3, 0, 0}, Quaternion::Identity()});
  straight.bend({2, 0, 0});
  CHECK(straight.length() == Approx(2).epsilon(rounding));
}

TEST_CASE("tool path: the arc beside a point of its circle") {
  const Frame from{{1, 0, 0}, Quaternion::Identity()}, to{{0, 1, 0}, Quaternion::Identity()};
  for (const Vector3& other : {Vector3(-1, 0, 0), Vector3(0, -1, 0)}) {  // beyond its end, before its start
    ToolPath path({}, from, to);
    path.bend_beside(other);
    CHECK(path.length() == Approx(0.5 * pi).epsilon(rounding));
    CHECK((path.pose(0.5).position - Vector3(1, 1, 0) / std::sqrt(2)).norm() < rounding);
  }
  ToolPath far({}, from, to);
  const double h = std::sqrt(0.5);
  far.bend_beside({h, h, 0});  // between them: the other arc
  CHECK(far.length() == Approx(1.5 * pi).epsilon(rounding));
}

TEST_CASE("legs: circles by joint angles are those through the tool's places there") {
  const pipeline::Robot robot = arm();
  const InverseKinematics kinematics(robot);
  const Vector3 centre(1.2, 0, 1.2);
  constexpr double radius = 0.2;
  VectorXd near = VectorXd::Zero(6);
  std::vector<std::vector<double>> taught;
  for (int k = 0; k < 4; ++k) {
    const pipeline::MotionStep step =
        to(PathKind::joint, centre + radius * Vector3(0, std::cos(k * pi / 2), std::sin(k * pi / 2)), 1, 0);
    std::string reason;
    const auto joints =
        kinematics.solve({Vector3(step.position[0], step.position[1], step.position[2]),
                          Quaternion(step.quaternion[0], step.quaternion[1], step.quaternion[2], step.quaternion[3])},
                         {}, near, reason);
    REQUIRE(joints.has_value());
    near = *joints;
    taught.emplace_back(joints->data(), joints->data() + 6);
  }
  std::vector<pipeline::MotionStep> steps(4);
  for (int k = 0; k < 4; ++k) {
    steps[k].joints = taught[k];
    steps[k].path = k == 0 ? PathKind::joint : PathKind::circular;
    if (k > 0) steps[k].circle_joints = taught[k == 1 ? 2 : k - 2];
    steps[k].tool_speed = 0.3;
    steps[k].tool_zone = 0;
  }
  const JointMotion run(motion(steps), robot);
  double off = 0, leftmost = 0;
  for (double t = 0; t < run.duration(); t += 0.002) {
    const Vector3 here = kinematics.flange(run.position(t)).position - centre;
    off = std::max({off, std::abs(here.norm() - radius), std::abs(here.x())});
    leftmost = std::min(leftmost, here.y());
  }
  CHECK(off < 1e-4);                                 // points 10 mm apart on 200 mm: h^2/(8 r) = 63 um
  CHECK(leftmost == Approx(-radius).epsilon(1e-3));  // over the top, around to the bottom: three quarters
  CHECK((kinematics.flange(run.position(run.duration())).position - centre - Vector3(0, 0, -radius)).norm() < 1e-9);
}

TEST_CASE("legs: a step's own acceleration counts below those of the axes") {
  const pipeline::Robot robot = arm();
  pipeline::MotionStep line = to(PathKind::linear, {1.2, 0.5, 1.2}, 0.5, 0);
  line.tool_acceleration = 0.25;
  const Vector3 from(1.2, -0.5, 1.2);
  const JointMotion slow(motion({to(PathKind::joint, from, 1, 0), line}), robot);
  // Axis 1 moves farthest and sets the time law: ds = dy/r with r = (x^2 + y^2)/x, u' = a/r. With constant r it would be
  // v/a + d/v = 4 s. Here u^2 = 2 a int dy/r^2 from the end on, and 2 int dy/(r u) over half the path is 4.128 s. The three
  // equal control points at both ends (M10) add 3 h.
  CHECK(slow.duration() == Approx(4.128 + 3 * 0.015).epsilon(1e-3));
  pipeline::Motion by_jerk = motion({to(PathKind::joint, from, 1, 0), line});
  by_jerk.path_jerk = 5;  // 0.25 m/s2 is reached within 0.05 s = 2 h
  const JointMotion softer(by_jerk, robot);
  CHECK(softer.pieces()[softer.pieces().size() - 2].duration == Approx(0.025).epsilon(1e-9));
  CHECK(softer.duration() == Approx(4.128 + 3 * 0.025).epsilon(1e-3));
  pipeline::MotionStep a, b;
  a.joints = std::vector<double>(6, 0.0);
  b.joints = {1, 0, 0, 0, 0, 0.5};
  b.speed = 0.5;
  b.acceleration = 0.5;
  // 1 rad at 0.5 rad/s with 0.5 rad/s2: 3 s.
  CHECK(JointMotion(motion({a, b}), robot).duration() == Approx(3).epsilon(1e-9));
}

TEST_CASE("tooling: a stationary tool and its way back") {
  const Frame pose{{0.1, 0.2, 0.3}, rotation({0.3, -0.2, 1})};
  for (bool stationary : {false, true}) {
    const Tooling tooling{{{0, 0.1, 0.4}, rotation({1, 0, 0})}, {{1, 0, 0}, rotation({0, 0, 2})}, stationary};
    const Frame back = tooling.pose(tooling.flange(pose));
    CHECK((back.position - pose.position).norm() < rounding);
    CHECK(back.orientation.angularDistance(pose.orientation) < 1e-7);  // acos near 1
  }
}

TEST_CASE("legs: a long line is driven at the tool's speed, on the line, within the axes' limits") {
  const pipeline::Robot robot = arm();
  const Vector3 from(1.2, -0.5, 1.2), target(1.2, 0.5, 1.2);
  const JointMotion run(motion({to(PathKind::joint, from, 1, 0), to(PathKind::linear, target, 0.4, 0)}), robot);
  const InverseKinematics kinematics(robot);
  // From rest to rest, 1 m at 0.4 m/s: 2.5 s plus the ramps. Axis 1 turns fastest, at most 0.4/1.2 rad/s.
  CHECK(run.duration() > 2.5);
  CHECK(run.duration() < 2.5 * 1.05);
  double steady_low = 10, steady_high = 0, off = 0;
  const double h = 0.002;
  for (double t = 0; t < run.duration(); t += h) {
    const Vector3 here = kinematics.flange(run.position(t)).position;
    off = std::max(off, std::hypot(here.x() - 1.2, here.z() - 1.2));
    for (int i = 0; i < 6; ++i) {
      CHECK(std::abs(run.velocity(t)[i]) <= robot.joints[i].speed + limit_margin);
      CHECK(std::abs(run.acceleration(t)[i]) <= robot.joints[i].acceleration + limit_margin);
    }
    if (t < 0.3 || t > run.duration() - 0.3) continue;
    const double speed = (kinematics.flange(run.position(t + h)).position - here).norm() / h;
    steady_low = std::min(steady_low, speed);
    steady_high = std::max(steady_high, speed);
  }
  // Points 10 mm apart on a path of about 1 m radius in joint space: h^2/(8 r) = 13 um. The speed along a leg is constant to
  // h/r = 1 %.
  CHECK(off < 2e-5);
  CHECK(steady_high < 0.4 * 1.01);
  CHECK(steady_low > 0.4 * 0.99);
  CHECK((kinematics.flange(run.position(run.duration())).position - target).norm() < 1e-9);
}

TEST_CASE("legs: a zone cuts the corner inside its radius, without a stop, without a zone the robot stops there") {
  const pipeline::Robot robot = arm();
  const InverseKinematics kinematics(robot);
  const Vector3 from(1.2, -0.4, 1.2), target(1.2, 0, 1.6);
  const auto closest = [&](double zone, double& slowest) {
    const JointMotion run(motion({to(PathKind::joint, from, 1, 0), to(PathKind::linear, corner, 0.3, zone),
                                  to(PathKind::linear, target, 0.3, 0)}),
                          robot);
    double nearest = 10;
    slowest = 10;
    for (double t = 0.5; t < run.duration() - 0.5; t += 0.002) {
      nearest = std::min(nearest, (kinematics.flange(run.position(t)).position - corner).norm());
      slowest = std::min(slowest, run.velocity(t).norm());
    }
    return nearest;
  };
  double slowest = 0;
  CHECK(closest(0, slowest) < 2e-3);
  CHECK(slowest < 0.01);
  // For a right angle the Bezier curve passes the corner at d/(2 sqrt 2).
  CHECK(closest(0.1, slowest) == Approx(0.1 / (2 * std::sqrt(2.0))).epsilon(0.02));
  CHECK(slowest > 0.1);
}

TEST_CASE("legs: a zone of the turn lets the tool come nearer to a target's orientation than to its place") {
  // There and back by 50 deg about the tool's axis, with steps of 40 mm, and on the spot.
  constexpr double turn = 50 * degree;
  constexpr double off =
      2e-3;  // [rad]: the smoothing of a tool path (M10) and the legs of a corner cut the tip of the turn
  const pipeline::Robot robot = arm();
  const InverseKinematics kinematics(robot);
  for (const double way : {0.04, 0.0}) {
    const auto reached = [&](std::optional<double> zone_of_turn) {
      std::vector<pipeline::MotionStep> steps{to(PathKind::linear, corner, 0.2, 0),
                                              to(PathKind::linear, corner + Vector3(0, way, 0), 0.2, 0.01),
                                              to(PathKind::linear, corner + Vector3(0, 2 * way, 0), 0.2, 0)};
      const Quaternion before(steps[0].quaternion[0], steps[0].quaternion[1], steps[0].quaternion[2],
                              steps[0].quaternion[3]);
      const Quaternion turned = before * rotation({0, 0, turn});
      steps[1].quaternion = {turned.w(), turned.x(), turned.y(), turned.z()};
      steps[1].turn_zone = zone_of_turn;
      steps[0].path = PathKind::joint;
      const JointMotion run(motion(steps), robot);
      double largest = 0;
      for (double t = 0; t < run.duration(); t += 5e-4) {
        const Quaternion now = kinematics.flange(run.position(t)).orientation;
        largest = std::max(largest, rotation_vector(before.conjugate() * now).norm());
      }
      return largest;
    };
    // The path is cut by a quarter, or by a half on the spot. The middle of the curve is at three quarters of the cut turn.
    const double cut = way > 0 ? 0.25 : 0.5;
    CHECK(reached({}) == Approx(turn * (1 - cut / 2)).margin(off));
    // The middle of the window of the turn, the zone over what is cut, misses a quarter of the zone twice.
    for (const double zone : {2 * degree, 6 * degree}) CHECK(reached(zone) == Approx(turn - zone / 2).margin(off));
    CHECK(reached(0.0) == Approx(turn * (1 - cut / 2 / 16)).margin(off));  // the least window
    CHECK(reached(90 * degree) == reached({}));
  }
}

TEST_CASE("legs: a circle keeps its radius") {
  const pipeline::Robot robot = arm();
  const InverseKinematics kinematics(robot);
  pipeline::MotionStep round = to(PathKind::circular, {1.2, 0, 1.5}, 0.3, 0);
  round.via_position = {1.2, 0.15, 1.35};
  const JointMotion run(motion({to(PathKind::joint, corner, 1, 0), round}), robot);
  double worst = 0;
  for (double t = 0; t < run.duration(); t += 0.005)
    worst =
        std::max(worst, std::abs((kinematics.flange(run.position(t)).position - Vector3(1.2, 0, 1.35)).norm() - 0.15));
  CHECK(worst < 1e-4);  // chords of 10 mm on a radius of 150 mm differ from it by 83 um
  CHECK(run.duration() > pi * 0.15 / 0.3);
}

TEST_CASE("legs: a joint move never takes its tool faster than the program says, a duration is kept") {
  const pipeline::Robot robot = arm(10, 100);
  const InverseKinematics kinematics(robot);
  pipeline::MotionStep start, turn;
  start.joints = {0, 0, 0, 0, 0.5, 0};
  turn.joints = {1.5, 0, 0, 0, 0.5, 0};
  turn.tool_speed = 0.5;
  const JointMotion run(motion({start, turn}), robot);
  // A turn of 1.5 rad at a radius of 1 m, at 0.5 m/s.
  CHECK(run.duration() == Approx(3).epsilon(0.01));
  turn.tool_speed = {};
  turn.duration = 2;
  const JointMotion timed(motion({start, turn}), robot);
  CHECK(timed.duration() == Approx(2).epsilon(1e-9));
}

TEST_CASE("legs: a line must end in the configuration that its program says") {
  const auto start = to(PathKind::joint, corner, 1, 0);
  auto good = to(PathKind::linear, {1.2, -0.3, 1.2}, 0.3, 0), wrong = good;
  const InverseKinematics kinematics(arm());
  const JointMotion plain(motion({start, good}), arm());
  const ArmConfiguration reached =
      kinematics.configuration(plain.position(plain.duration()), ArmConfiguration::Kind::abb);
  good.configuration = reached.text();
  CHECK_NOTHROW(JointMotion(motion({start, good}), arm()));
  ArmConfiguration other = reached;
  other.numbers[1] += 1;  // axis 4 differs by one quadrant: the controller accepts it
  wrong.configuration = other.text();
  CHECK_NOTHROW(JointMotion(motion({start, wrong}), arm()));
  other.numbers[1] += 2;
  wrong.configuration = other.text();
  CHECK_THROWS_WITH(JointMotion(motion({start, wrong}), arm()),
                    Catch::Contains("target of 'move 2' is reached along its path in configuration " + reached.text() +
                                    ", not in " + other.text()));
}

TEST_CASE("legs: a line to joint angles ends at them, or is refused if it leads to another turn or configuration") {
  pipeline::Robot robot = arm();
  robot.joints[5].lower = -7, robot.joints[5].upper = 7;
  const auto line = [&](const std::vector<double>& from, const std::vector<double>& target) {
    pipeline::MotionStep start, end;
    start.joints = from, end.joints = target;
    end.path = PathKind::linear;
    return JointMotion(motion({start, end}), robot);
  };
  CHECK_THROWS_WITH(  // 3.4 - 2 pi = -2.883
      line({0, 0, 0, 0, 0.5, 0}, {0.05, 0.05, 0, 0, 0.5, 3.4}),
      Catch::Contains("target of 'move 2' is reached along its path with axis_6 at -165.2 deg, not 194.8"));
  CHECK_THROWS_WITH(line({0, 0, 0, -1.6, 0.5, 0}, {0.05, 0.05, 0, pi - 1.6, -0.5, pi}),
                    Catch::Contains("target of 'move 2' is reached along its path with axis_"));
  using Ends = std::pair<std::vector<double>, std::vector<double>>;
  const Ends turned = {{0, 0, 0, 0, 0.5, 2}, {0.05, 0.05, 0, 0, 0.5, 3.4}},
             straight_wrist = {{0, 0, 0, 0.3, 0.5, 0}, {0, 0, 0, 0, 0, 0.3}};
  for (const auto& [from, target] : {turned, straight_wrist}) {
    const JointMotion run = line(from, target);
    VectorXd before = run.position(0);
    double largest = 0, least = 1;
    for (double t = 0; t < run.duration() + 0.01; t += 0.001) {
      const VectorXd now = run.position(t);
      least = std::min(least, now[4]);
      largest = std::max(largest, (now - before).lpNorm<Eigen::Infinity>());
      before = now;
    }
    CHECK(largest <= 0.001 * 4 + rounding);  // 4 rad/s
    CHECK(least >= -rounding);               // the wrist does not turn over
    CHECK((before - Eigen::Map<const VectorXd>(target.data(), 6)).lpNorm<Eigen::Infinity>() < rounding);
  }
}

TEST_CASE("legs: a corner between an axis move and a line stays within its zone") {
  const pipeline::Robot robot = arm();
  const InverseKinematics kinematics(robot);
  constexpr double zone = 0.08;
  auto start = to(PathKind::joint, {1.0, -0.5, 1.0}, 1, 0), turn = to(PathKind::joint, corner, 1, zone);
  turn.tool_speed = 0.5;
  const Vector3 target(1.2, 0, 1.7);
  const JointMotion run(motion({start, turn, to(PathKind::linear, target, 0.5, 0)}), robot);
  double nearest = 10, off_line = 0, slowest = 10;
  for (double t = 0; t < run.duration(); t += 0.002) {
    const Vector3 here = kinematics.flange(run.position(t)).position;
    const double away = (here - corner).norm();
    nearest = std::min(nearest, away);
    if (t > 0.3 && t < run.duration() - 0.3) slowest = std::min(slowest, run.velocity(t).norm());
    // Beyond the zone the tool is on the line, to the 13 um of its chords and the rounding of the control points.
    if (here.z() > corner.z() + 1.1 * zone) off_line = std::max(off_line, std::hypot(here.x() - 1.2, here.y()));
  }
  CHECK(nearest < zone);
  CHECK(nearest > 0.1 * zone);  // it cuts the corner
  CHECK(off_line < 2e-4);
  CHECK(slowest > 0.05);
}

namespace {

pipeline::Robot on_track(pipeline::ExternalAxis::Carries carries) {
  pipeline::Robot robot = arm();
  pipeline::ExternalAxis track;
  track.name = "track";
  track.axis = Vector3::UnitY();
  track.carries = carries;
  track.lower = -1;
  track.upper = 2;
  track.speed = 0.5;
  track.acceleration = 1;
  robot.external_axes = {track};
  return robot;
}

}  // namespace

TEST_CASE("legs: behind a corner between unequal lines the tool is on the second line within its zone") {
  constexpr double zone = 0.05, near = 1e-3;  // [m]; if the zone were a share of the longer line it would end 11 mm off
  pipeline::MotionStep first = to(PathKind::joint, corner - Vector3(0, 0.1, 0), 0.25, 0);
  first.tool_speed.reset();
  const JointMotion motion_of_it(motion({first, to(PathKind::linear, corner, 0.25, zone),
                                         to(PathKind::linear, corner + Vector3(0, 0, 0.4), 0.25, 0)}),
                                 arm());
  const InverseKinematics kinematics(arm());
  int behind = 0, before = 0;
  for (double t = 0; t < motion_of_it.duration(); t += 1e-3) {
    const Vector3 off = kinematics.flange(motion_of_it.position(t)).position - corner;
    if (off.z() > 1.1 * zone) CHECK((++behind, std::hypot(off.x(), off.y())) < near);
    if (off.y() < -1.1 * zone) CHECK((++before, std::hypot(off.x(), off.z())) < near);
  }
  CHECK(behind > 100);
  CHECK(before > 50);
}

TEST_CASE("legs: a stop zone cuts a corner by its share of the way in which the robot would stop") {
  const auto cornering = [](std::optional<double> percent, double zone) {
    pipeline::MotionStep first = to(PathKind::joint, corner - Vector3(0, 0.3, 0), 0.5, 0),
                         line = to(PathKind::linear, corner, 0.5, zone);
    first.tool_speed.reset();
    if (percent) line.tool_zone.reset(), line.stop_zone = percent;
    return JointMotion(motion({first, line, to(PathKind::linear, corner + Vector3(0, 0, 0.3), 0.5, 0)}), arm())
        .duration();
  };
  // The deceleration that the axes allow along the line's chord in joint space, in m/s2 of the tool.
  const InverseKinematics kinematics(arm());
  const double half = std::sqrt(0.5);
  const Quaternion forward(half, 0, half, 0);
  const VectorXd middle = VectorXd::Zero(6);
  std::string reason;
  const auto from = kinematics.solve({corner - Vector3(0, 0.3, 0), forward}, {}, middle, reason);
  const auto until = kinematics.solve({corner, forward}, {}, middle, reason);
  REQUIRE((from && until));
  double brake = std::numeric_limits<double>::infinity();
  for (long i = 0; i < 6; ++i)
    brake =
        std::min(brake, arm().joints[static_cast<std::size_t>(i)].acceleration / std::abs((*until - *from)[i]) * 0.3);
  const double way = 0.5 * 0.5 / (2 * brake);
  CHECK(cornering(100, 0) == Approx(cornering({}, way)).epsilon(1e-6));
  CHECK(cornering(50, 0) == Approx(cornering({}, way / 2)).epsilon(1e-6));
  CHECK(cornering({}, way) < 0.999 * cornering({}, way / 2));  // the zone changes the time
}

TEST_CASE("legs: a track carries the robot along while its tool keeps to the line in the cell") {
  const pipeline::Robot robot = on_track(pipeline::ExternalAxis::Carries::robot);
  const InverseKinematics kinematics(robot);
  auto start = to(PathKind::joint, {1.2, 0, 1.2}, 1, 0), along = to(PathKind::linear, {1.2, 1, 1.2}, 0.3, 0),
       back = to(PathKind::linear, {1.2, 0.6, 1.2}, 0.3, 0);
  start.external_axes = {0};
  along.external_axes = {1000};
  const JointMotion run(motion({start, along, back}), robot);
  const VectorXd begin = run.position(0);
  double off = 0, bent = 0;
  for (double t = 0; t < run.duration(); t += 0.005) {
    const VectorXd axes = run.position(t);
    const Vector3 here = kinematics.flange(axes).position;
    off = std::max(off, std::hypot(here.x() - 1.2, here.z() - 1.2));
    if (run.step(t) < 2) bent = std::max(bent, (axes - begin).head(6).lpNorm<Eigen::Infinity>());
    CHECK(std::abs(run.velocity(t)[6]) <= 0.5 + limit_margin);
    CHECK(std::abs(run.acceleration(t)[6]) <= 1 + limit_margin);
  }
  CHECK(off < 2e-5);   // the third move keeps the track and bends the arm: chords, as above
  CHECK(bent < 1e-7);  // track and tool move equally: the arm keeps its pose (acos near 1)
  CHECK((kinematics.flange(run.position(run.duration())).position - Vector3(1.2, 0.6, 1.2)).norm() < 1e-9);
  CHECK(run.position(run.duration())[6] == Approx(1));
}

TEST_CASE("legs: an axis that carries nothing takes its time and keeps to its limits") {
  const pipeline::Robot robot = on_track(pipeline::ExternalAxis::Carries::nothing);
  auto start = to(PathKind::joint, corner, 1, 0);
  auto same = start;
  same.tool_speed = {};
  same.external_axes = {1500};
  const JointMotion run(motion({start, same}), robot);
  // 1.5 m at 0.5 m/s with A = 0.75 m/s2: L/v + v/A.
  CHECK(run.duration() == Approx(1.5 / 0.5 + 0.5 / 0.75).epsilon(1e-9));
  for (const double limit : {-1000.0, 2000.0}) {  // the limits themselves
    same.external_axes = {limit};
    CHECK_NOTHROW(JointMotion(motion({start, same}), robot));
  }
  same.external_axes = {2500};
  same.where = {"main.mod", 7, 1};
  CHECK_THROWS_WITH(JointMotion(motion({start, same}), robot),
                    Catch::StartsWith("main.mod:7:1: error: target of 'move 2' moves track to 2500 mm (must be "
                                      "within -1000 .. 2000); check target"));
}

TEST_CASE("legs: a joint move's speed and acceleration are the least of its axes', its tool's and its own") {
  const pipeline::Robot robot = arm(10, 100);  // the flange is 1 m from axis 1
  const VectorXd mean = VectorXd::Constant(6, 50);
  constexpr double chords = 2e-3;  // error of chords, arcs of 0.8 rad in 24 parts
  const auto leg = [&](const auto& change) {
    pipeline::MotionStep start, turn;
    start.joints = {0, 0, 0, 0, 0.5, 0}, turn.joints = {0.8, 0.4, 0, 0, 0.5, 0};
    change(turn);
    if (turn.tool_speed || turn.turn_speed || turn.tool_acceleration) turn.joints[1] = 0;
    pipeline::Motion program = motion({start, turn});
    program.speed_percent = 40;
    const Legs made = legs_of(program, robot, mean);
    REQUIRE(made.legs.size() == 1);
    CHECK(made.legs[0].length == 0.8);
    CHECK(made.legs[0].straight);
    return made.legs[0];
  };
  using Step = pipeline::MotionStep;
  CHECK(leg([](Step&) {}).cruise == Approx(4));
  CHECK(leg([](Step&) {}).acceleration == Approx(50 * leg([](Step&) {}).slowing));
  CHECK(leg([](Step& s) { s.speed_percent = 25; }).cruise == Approx(2.5));
  CHECK(leg([](Step& s) { s.speed = 0.2, s.speed_percent = 1; }).cruise == Approx(0.2));
  CHECK(leg([](Step& s) { s.tool_speed = 0.5; }).cruise == Approx(0.5).epsilon(chords));
  CHECK(leg([](Step& s) { s.turn_speed = 0.3; }).cruise == Approx(0.3).epsilon(chords));
  CHECK(leg([](Step& s) { s.turn_speed = 0.3, s.tool_speed = 0.2; }).cruise == Approx(0.2).epsilon(chords));
  CHECK(leg([](Step& s) { s.tool_speed = 9, s.speed_percent = 50; }).cruise == Approx(5));
  CHECK(leg([](Step& s) { s.tool_acceleration = 0.25, s.tool_speed = 1; }).acceleration ==
        Approx(0.25).epsilon(chords));
  CHECK(leg([](Step& s) { s.acceleration = 0.7; }).acceleration == Approx(0.7));
  const Leg half = leg([](Step& s) { s.acceleration_percent = 50; });
  CHECK(half.acceleration == Approx(25 * half.slowing));
  // From rest to rest in 4 s: L/v + v/A = 4.
  const double cruise = leg([](Step& s) { s.duration = 4; }).cruise;
  CHECK(0.8 / cruise + cruise / 50 == Approx(4));
}

TEST_CASE("legs: a tool's zone between two joint moves is as large a share of each as of its tool's way") {
  pipeline::MotionStep start, turn, lift;
  start.joints = {0, 0, 0, 0, 0.5, 0}, turn.joints = {0.6, 0, 0, 0, 0.5, 0}, lift.joints = {0.6, 0.3, 0, 0, 0.5, 0};
  for (const double zone : {0.05, 0.4}) {
    turn.tool_zone = zone;
    const Legs made = legs_of(motion({start, turn, lift}), arm(), VectorXd::Constant(6, 8));
    REQUIRE(made.legs.size() == 2);
    // The flange moves along chords of 0.6 rad at 1 m and of 0.3 rad at 1.414 m. At most half of each is blended.
    const double way = 2 * std::sin(0.3), way_behind = 2 * std::sqrt(2.0) * std::sin(0.15);
    CHECK(made.legs[0].zone == Approx(0.6 * std::min(0.5, zone / way)));
    CHECK(made.legs[0].zone_behind == Approx(0.3 * std::min(0.5, zone / way_behind)));
    CHECK(made.legs[1].zone == 0);
  }
}

TEST_CASE("legs: beside a line, two joint moves are joined by a parabola within their angular zone") {
  pipeline::MotionStep start, turn, lift, line;
  start.joints = {0, 0, 0, 0, 0.5, 0}, turn.joints = {0.6, 0, 0, 0, 0.5, 0}, lift.joints = {0.6, 0.3, 0, 0, 0.5, 0};
  line.joints = {0.65, 0.35, 0, 0, 0.5, 0};
  line.path = PathKind::linear;
  turn.zone = 0.1, lift.tool_zone = 0.02;
  const Legs made = legs_of(motion({start, turn, lift, line}), arm(), VectorXd::Constant(6, 8));
  // 0.1 / 0.6 and 0.1 / 0.3 of the tool's two paths
  const double way = 2 * std::sin(0.3) / 6, way_behind = 2 * std::sqrt(2.0) * std::sin(0.15) / 3;
  int on_curve = 0, before = 0;
  VectorXd place = made.legs[0].from;
  for (const Leg& leg : made.legs) {
    CHECK((leg.from - place).norm() < rounding);  // no gap
    place = leg.from + leg.length * leg.direction;
    CHECK(leg.path == 1);
    if (leg.from[0] < 0.5 - rounding || place[1] > 0.1 + rounding) continue;
    // Ends at 0.5, 0 and 0.6, 0.1: the second angle is 0.1 u^2.
    const double u = std::sqrt(place[1] / 0.1), first = 0.5 * (1 - u) * (1 - u) + 1.2 * u * (1 - u) + 0.6 * u * u;
    CHECK(place[0] == Approx(first).epsilon(1e-9));
    CHECK(leg.step == ((1 - u) * (1 - u) * way >= u * u * way_behind ? 1 : 2));
    ++on_curve, before += leg.step == 1;
  }
  CHECK(on_curve == int(std::ceil((way + way_behind) / 0.01)));  // points at most 10 mm apart
  CHECK(before == int(on_curve / (1 + std::sqrt(way_behind / way))));
  CHECK((place - Eigen::Map<const VectorXd>(line.joints.data(), 6)).norm() < 1e-7);  // acos near its limits
}

TEST_CASE("legs: a larger zone before a slow short line does not make the line before it slow") {
  const auto lasts = [](double zone) {
    pipeline::MotionStep first = to(PathKind::joint, corner - Vector3(0, 0.5, 0), 0.5, 0);
    first.tool_speed.reset();
    return JointMotion(motion({first, to(PathKind::linear, corner, 0.5, zone),
                               to(PathKind::linear, corner + Vector3(0, 0.02, 0), 0.02, 0)}),
                       arm())
        .duration();
  };
  // At most half of either line is in the zone. One leg of up to 10 mm across the corner has the lower speed of 20 mm/s.
  CHECK(lasts(0.25) < lasts(0.01) + 0.5);
}

TEST_CASE("legs: many targets out of reach are one problem with their number and first places") {
  std::vector<pipeline::MotionStep> steps{to(PathKind::joint, corner, 1, 0)};
  for (int line = 1; line <= 8; ++line) {
    steps.push_back(to(PathKind::linear, {5, 0, 1}, 1, 0));
    steps.back().where = {"main.mod", line, 1};
  }
  const std::string text = pipeline::message_of([&] { JointMotion(motion(steps), arm()); });
  CHECK(text.find('\n') == std::string::npos);
  CHECK(text.starts_with("main.mod:1:1: error: target of "));
  CHECK(
      text.find(
          "is out of reach, and 7 further targets (main.mod:2:1, main.mod:3:1, main.mod:4:1, main.mod:5:1, main.mod:6:1 ..); check "
          "target") != std::string::npos);
}

TEST_CASE("legs: targets out of reach are reported together, with their lines") {
  auto far = to(PathKind::linear, {5, 0, 1}, 1, 0), wrong = to(PathKind::joint, corner, 1, 0);
  far.where = {"main.mod", 12, 3};
  far.text = "main.mod:12 main: MoveL p2;";
  wrong.where = {"main.mod", 14, 3};
  wrong.configuration = "abb 1 0 0 0";
  CHECK_THROWS_WITH(
      JointMotion(motion({to(PathKind::joint, corner, 1, 0), far, wrong}), arm()),
      Catch::StartsWith(
          "main.mod:12:3: error: target of 'main.mod:12 main: MoveL p2;' is out of reach; check target") &&
          Catch::Contains("\nmain.mod:14:3: error: target of 'move 3' is not reached in configuration abb 1 0 0 0 "
                          "(but in abb"));
}
