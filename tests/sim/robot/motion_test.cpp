#include "sim/robot/motion.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

using namespace dresslife;
using namespace dresslife::sim;

namespace {

using Eigen::VectorXd;

/// [rad/s, rad/s2] Roundings of 1e-16 in angles of up to 10 rad, divided once or twice by the shortest times, some ms.
constexpr double limit_margin = 1e-9;
/// Some tens of roundings of times of up to 100 s and angles of up to 10 rad.
constexpr double rounding = 1e-12;
/// Mean acceleration / largest acceleration if both ramps take a quarter of the time.
constexpr double mean_share = 0.75;

pipeline::Robot robot_with(std::vector<double> speeds, std::vector<double> accelerations) {
  pipeline::Robot robot;
  robot.name = "test robot";
  robot.links.resize(speeds.size() + 1);
  for (size_t k = 0; k < speeds.size(); ++k) {
    pipeline::Joint joint;
    joint.name = "joint_" + std::to_string(k + 1);
    joint.lower = -10;
    joint.upper = 10;
    joint.speed = speeds[k];
    joint.acceleration = accelerations[k];
    robot.joints.push_back(joint);
  }
  return robot;
}

pipeline::MotionStep move_to(std::vector<double> joints, std::optional<double> zone = {}) {
  pipeline::MotionStep step;
  step.joints = std::move(joints);
  step.zone = zone;
  return step;
}

pipeline::MotionStep dwell(double seconds) {
  pipeline::MotionStep step;
  step.dwell = seconds;
  return step;
}

pipeline::Motion motion_of(std::vector<pipeline::MotionStep> steps) {
  pipeline::Motion motion;
  motion.name = "test";
  motion.steps = std::move(steps);
  return motion;
}

pipeline::Motion random_program(unsigned seed, int joints, int moves, double zone) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  pipeline::Motion motion = motion_of({});
  std::vector<double> place(joints, 0.0);
  motion.steps.push_back(move_to(place));
  for (int m = 0; m < moves; ++m) {
    const double reach = std::pow(10, -3 * uniform(random));  // legs of 1 mrad to 1 rad
    for (double& q : place)
      if (uniform(random) < 0.6) q = std::clamp(q + reach * (2 * uniform(random) - 1), -5.0, 5.0);
    motion.steps.push_back(move_to(place, uniform(random) < 0.2 ? 0 : zone * uniform(random)));
    if (uniform(random) < 0.3) motion.steps.back().speed_percent = 10 + 90 * uniform(random);
    if (uniform(random) < 0.1) motion.steps.push_back(dwell(0.2));
    if (uniform(random) < 0.2) motion.steps.back().jerk_percent = 10 + 90 * uniform(random);
  }
  return motion;
}

TEST_CASE("motion: one long move takes the time of the trapezoidal law") {
  // L/c + c/A with A = 3/4 a: 3 rad at 2 rad/s, a = 4.
  const JointMotion motion(motion_of({move_to({0}), move_to({3})}), robot_with({2}, {4}));
  CHECK(motion.duration() == Approx(3 / 2.0 + 2 / (mean_share * 4)).epsilon(rounding));
  CHECK(motion.position(motion.duration() / 2)[0] == Approx(1.5).epsilon(rounding));
  CHECK(motion.velocity(motion.duration() / 2)[0] == Approx(2).epsilon(rounding));
  CHECK(motion.position(1e9)[0] == 3);
  CHECK(motion.position(-1)[0] == 0);
}

TEST_CASE("motion: moves to where the robot stands already keep their durations, as rows of a recorded wait do") {
  const auto row = [](double place, double duration) {
    pipeline::MotionStep step = move_to({place});
    step.stop_zone = 100;
    step.duration = duration;
    return step;
  };
  pipeline::Motion motion = motion_of({move_to({0}), row(1, 1), row(1, 0.04), row(1, 2.96), row(0, 1), row(0, 0.5)});
  for (const bool jerk : {false, true}) {
    if (jerk) motion.jerk = 1e4;
    const JointMotion made(motion, robot_with({2}, {40}));
    // The blend with the wait begins half its time before the row. Only the start from rest adds the other half of its own.
    CHECK(made.duration() == Approx(5.5).margin(1 / (mean_share * 40)));
    CHECK(made.position(2.5)[0] == 1);
    CHECK(made.velocity(2.5)[0] == 0);
    CHECK(made.position(4.5)[0] == Approx(0.5).margin(1 / (mean_share * 40)));
  }
}

TEST_CASE("motion: one short move is a triangle of speed") {
  // Top speed sqrt(A L), time 2 sqrt(L/A).
  const JointMotion motion(motion_of({move_to({0}), move_to({-0.3})}), robot_with({2}, {4}));
  CHECK(motion.duration() == Approx(2 * std::sqrt(0.3 / 3)).epsilon(rounding));
  CHECK(motion.velocity(motion.duration() / 2)[0] == Approx(-std::sqrt(3 * 0.3)).epsilon(rounding));
  double largest = 0;
  for (double t = 0; t < motion.duration(); t += 1e-4) largest = std::max(largest, std::abs(motion.acceleration(t)[0]));
  CHECK(largest == Approx(4).epsilon(rounding));  // the limit is used fully
}

TEST_CASE("motion: acceleration rises and falls in a quarter of each speed change") {
  const JointMotion motion(motion_of({move_to({0}), move_to({3})}), robot_with({2}, {4}));
  const double rise = 2 / (mean_share * 4);
  CHECK(motion.acceleration(rise / 8)[0] == Approx(2).epsilon(rounding));
  CHECK(motion.acceleration(rise / 4)[0] == Approx(4).epsilon(rounding));
  CHECK(motion.acceleration(rise * 7 / 8)[0] == Approx(2).epsilon(rounding));
  CHECK(motion.acceleration(rise)[0] == Approx(0).margin(rounding));
}

TEST_CASE("motion: a share of the jerk builds the acceleration up as much slower, up to a triangle") {
  // A change of 2 rad/s with 4 rad/s2, whose ramps take a quarter of 2/3 s.
  const double jerk = 4 / (0.25 * 2 / 3.0);
  for (const double share : {1.0, 0.5, 1 / 3.0, 0.2, 0.1}) {
    CAPTURE(share);
    pipeline::Motion program = motion_of({move_to({0}), move_to({9})});
    program.steps[1].jerk_percent = 100 * share;
    const JointMotion motion(program, robot_with({2}, {4}));
    // From rest to 2 rad/s: with the full acceleration 2/4 s plus one ramp, otherwise a triangle with this jerk.
    const double ramp = share > 0.33 ? 4 / (share * jerk) : std::sqrt(2 / (share * jerk));
    const double highest = share * jerk * ramp, rise = 2 / highest + ramp;
    CHECK(motion.duration() == Approx(9 / 2.0 + rise).epsilon(1e-9));
    CHECK(motion.acceleration(ramp / 2)[0] == Approx(highest / 2).epsilon(1e-9));
    CHECK(motion.acceleration(ramp)[0] == Approx(highest).epsilon(1e-9));
    CHECK(motion.velocity(rise)[0] == Approx(2).epsilon(1e-9));
  }
}

TEST_CASE("motion: with a jerk the acceleration takes the same time to build up for every change of speed") {
  for (const double jerk : {200.0, 20.0, 5.0}) {  // rad/s3; at 5 the acceleration does not reach 4 rad/s2
    CAPTURE(jerk);
    for (const double share : {1.0, 0.5}) {
      pipeline::Motion program = motion_of({move_to({0}), move_to({9})});
      program.jerk = jerk / share;
      program.steps[1].jerk_percent = 100 * share;
      const JointMotion motion(program, robot_with({2}, {4}));
      const double highest = std::min(4.0, std::sqrt(2 * jerk)), ramp = highest / jerk;
      CHECK(motion.duration() == Approx(9 / 2.0 + 2 / highest + ramp).epsilon(rounding));
      CHECK(motion.acceleration(ramp / 2)[0] == Approx(highest / 2).epsilon(rounding));
      CHECK(motion.acceleration(ramp)[0] == Approx(highest).epsilon(rounding));
    }
  }
}

TEST_CASE("motion: a short move with a jerk reaches the speed that its way allows") {
  // Four parts of constant jerk: with ramps of a third of half the path the acceleration would exceed 4 rad/s2.
  pipeline::Motion program = motion_of({move_to({0}), move_to({0.1})});
  program.jerk = 20;
  const JointMotion motion(program, robot_with({2}, {4}));
  CHECK(motion.duration() == Approx(4 * std::cbrt(0.1 / (2 * 20))).epsilon(1e-9));  // bisected
  CHECK(motion.position(motion.duration())[0] == Approx(0.1).epsilon(1e-9));
}

TEST_CASE("motion: no axis exceeds its acceleration nor its jerk, in moves and in blends") {
  const std::vector<double> accelerations{4, 5, 6};
  for (unsigned seed = 1; seed <= 5; ++seed) {
    pipeline::Motion program = random_program(seed, 3, 40, 0.2);
    program.jerk = 30;
    const JointMotion motion(program, robot_with({2, 1, 3}, accelerations));
    double over_acceleration = 0, over_jerk = 0, gap = 0;
    for (const MotionPiece& piece : motion.pieces()) {
      const double tau = piece.duration, r = piece.ramp;
      for (long i = 0; i < 3; ++i) {
        const double highest = std::abs(piece.velocity_change[i]) / (tau * (1 - r));
        over_acceleration = std::max(over_acceleration, highest / accelerations[static_cast<std::size_t>(i)]);
        over_jerk = std::max(over_jerk, highest / (r * tau) / 30);
      }
      if (&piece != &motion.pieces().front())
        gap = std::max(gap, (motion.position(piece.start) - motion.position(piece.start - 1e-9)).cwiseAbs().maxCoeff());
    }
    CHECK(over_acceleration < 1 + limit_margin);
    CHECK(over_jerk < 1 + limit_margin);
    CHECK(gap < 1e-8);  // 3 rad/s for 1e-9 s, and legs bisected to 2^-50 of a speed
  }
}

TEST_CASE("motion: a move with a duration takes it with a jerk, too") {
  pipeline::Motion program = motion_of({move_to({0}), move_to({1})});
  program.steps[1].duration = 2.5;
  program.jerk = 20;
  CHECK(JointMotion(program, robot_with({2}, {4})).duration() == Approx(2.5).epsilon(1e-9));
}

TEST_CASE("motion: the ramps are the program's share of each change of speed") {
  for (const double percent : {2.0, 25.0, 50.0}) {
    pipeline::Motion program = motion_of({move_to({0}), move_to({3})});
    program.ramp_percent = percent;
    const JointMotion motion(program, robot_with({2}, {4}));
    const double rise = 2 / ((1 - percent / 100) * 4);
    CHECK(motion.duration() == Approx(3 / 2.0 + rise).epsilon(rounding));
    CHECK(motion.acceleration(rise * percent / 200)[0] == Approx(2).epsilon(rounding));
  }
}

TEST_CASE("motion: position is the integral of velocity, velocity that of acceleration") {
  const JointMotion motion(random_program(3, 3, 12, 0.2), robot_with({2, 1, 3}, {4, 5, 6}));
  // Central differences of pieces with bounded third derivative: h^2/6 times the jerk (some 100 rad/s3 for the shortest moves,
  // larger only within h of a piece's end).
  constexpr double h = 1e-6, difference_error = 1e-3;
  double worst_velocity = 0, worst_acceleration = 0;
  for (double t = 0.0137; t < motion.duration(); t += 0.0231) {
    const VectorXd v = (motion.position(t + h) - motion.position(t - h)) / (2 * h);
    const VectorXd a = (motion.velocity(t + h) - motion.velocity(t - h)) / (2 * h);
    worst_velocity = std::max(worst_velocity, (v - motion.velocity(t)).lpNorm<Eigen::Infinity>());
    worst_acceleration = std::max(worst_acceleration, (a - motion.acceleration(t)).lpNorm<Eigen::Infinity>());
  }
  CHECK(worst_velocity < difference_error);
  CHECK(worst_acceleration < difference_error);
}

TEST_CASE("motion: all axes of a move start and end together, the slowest sets the time") {
  const JointMotion motion(motion_of({move_to({0, 0}), move_to({1, 2})}), robot_with({2, 1}, {4, 3}));
  CHECK(motion.duration() == Approx(2 / 1.0 + 1 / (mean_share * 3)).epsilon(rounding));
  for (double t = 0; t <= motion.duration(); t += 0.01)
    CHECK(motion.position(t)[1] == Approx(2 * motion.position(t)[0]).margin(rounding));
}

TEST_CASE("motion: speed is a percentage of the axes' or that of the fastest axis") {
  const pipeline::Robot robot = robot_with({2, 1}, {400, 400});
  pipeline::Motion motion = motion_of({move_to({0, 0}), move_to({4, 1})});
  motion.speed_percent = 50;
  CHECK(JointMotion(motion, robot).velocity(2)[0] == Approx(1).epsilon(rounding));
  motion.steps[1].speed_percent = 25;
  CHECK(JointMotion(motion, robot).velocity(2)[0] == Approx(0.5).epsilon(rounding));
  motion.steps[1].speed = 1.25;
  CHECK(JointMotion(motion, robot).velocity(2)[0] == Approx(1.25).epsilon(rounding));
  motion.steps[1].speed = 100;  // no axis exceeds its limit
  CHECK(JointMotion(motion, robot).velocity(1)[0] == Approx(2).epsilon(rounding));
}

TEST_CASE("motion: the controller's override multiplies each kind of speed and leaves accelerations and dwells") {
  const pipeline::Robot robot = robot_with({2}, {4});
  const auto time = [&](auto set) {
    pipeline::Motion motion = motion_of({move_to({0}), move_to({3}), dwell(0.8)});
    motion.override_percent = 50;
    set(motion.steps[1]);
    return JointMotion(motion, robot).duration();
  };
  const auto law = [](double speed) { return 3 / speed + speed / (mean_share * 4) + 0.8; };
  CHECK(time([](auto&) {}) == Approx(law(1)).epsilon(rounding));
  CHECK(time([](auto& step) { step.speed_percent = 50; }) == Approx(law(0.5)).epsilon(rounding));
  CHECK(time([](auto& step) { step.speed = 1.5; }) == Approx(law(0.75)).epsilon(rounding));
  CHECK(time([](auto& step) { step.duration = 10; }) == Approx(20 + 0.8).epsilon(rounding));
}

TEST_CASE("motion: a smaller share of acceleration takes the closed form's time") {
  pipeline::Motion motion = motion_of({move_to({0}), move_to({6})});
  motion.acceleration_percent = 40;
  CHECK(JointMotion(motion, robot_with({2}, {4})).duration() ==
        Approx(6 / 2.0 + 2 / (mean_share * 1.6)).epsilon(rounding));
}

TEST_CASE("motion: velocity is continuous and no limit is exceeded anywhere") {
  const std::vector<double> speeds{2, 1, 3}, accelerations{4, 9, 30};
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const JointMotion motion(random_program(seed, 3, 40, 0.3), robot_with(speeds, accelerations));
    const double step = motion.duration() / 20000;
    VectorXd before = motion.velocity(0), place = motion.position(0);
    double over_speed = -1, over_acceleration = -1, jump = 0, leap = 0;
    for (int k = 1; k <= 20000; ++k) {
      const VectorXd v = motion.velocity(k * step), a = motion.acceleration(k * step);
      const VectorXd q = motion.position(k * step);
      for (int i = 0; i < 3; ++i) {
        over_speed = std::max(over_speed, std::abs(v[i]) - speeds[i]);
        over_acceleration = std::max(over_acceleration, std::abs(a[i]) - accelerations[i]);
        jump = std::max(jump, std::abs(v[i] - before[i]) - accelerations[i] * step);
        leap = std::max(leap, std::abs(q[i] - place[i]) - speeds[i] * step);
      }
      before = v;
      place = q;
    }
    INFO("seed " << seed);
    CHECK(over_speed < limit_margin);
    CHECK(over_acceleration < limit_margin);
    CHECK(jump < limit_margin);  // a jump of velocity would exceed acceleration times step
    CHECK(leap < limit_margin);
  }
}

TEST_CASE("motion: pieces join without a gap in place or speed") {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const JointMotion motion(random_program(seed, 4, 60, 0.5), robot_with({2, 1, 3, 2}, {4, 9, 30, 50}));
    double gap = 0, jump = 0;
    for (size_t k = 1; k < motion.pieces().size(); ++k) {
      const MotionPiece &a = motion.pieces()[k - 1], &b = motion.pieces()[k];
      const VectorXd end = a.position + a.duration * (a.velocity_before + a.velocity_change / 2);
      gap = std::max(gap, (end - b.position).lpNorm<Eigen::Infinity>());
      jump = std::max(jump, (a.velocity_before + a.velocity_change - b.velocity_before).lpNorm<Eigen::Infinity>());
    }
    INFO("seed " << seed);
    CHECK(gap < rounding);
    CHECK(jump < rounding);
  }
}

double deviation_from_legs(const JointMotion& motion, const std::vector<VectorXd>& waypoints) {
  double worst = 0;
  for (double t = 0; t < motion.duration(); t += 1e-3) {
    const VectorXd q = motion.position(t);
    double nearest = INFINITY;
    for (size_t k = 0; k + 1 < waypoints.size(); ++k) {
      const VectorXd way = waypoints[k + 1] - waypoints[k];
      const double s = std::clamp((q - waypoints[k]).dot(way) / way.squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (q - waypoints[k] - s * way).lpNorm<Eigen::Infinity>());
    }
    worst = std::max(worst, nearest);
  }
  return worst;
}

TEST_CASE("motion: a blended path stays within the zone and leaves the legs") {
  const pipeline::Robot robot = robot_with({2, 2}, {6, 6});
  const std::vector<VectorXd> waypoints{VectorXd{{0, 0}}, VectorXd{{2, 0}}, VectorXd{{2, 2}}, VectorXd{{0, 1}}};
  const auto program = [&](double zone) {
    return motion_of({move_to({0, 0}), move_to({2, 0}, zone), move_to({2, 2}, zone), move_to({0, 1})});
  };
  double longer = JointMotion(program(0), robot).duration();
  CHECK(deviation_from_legs(JointMotion(program(0), robot), waypoints) < rounding);
  for (const double zone : {0.02, 0.1, 0.4}) {
    const JointMotion motion(program(zone), robot);
    const double deviation = deviation_from_legs(motion, waypoints);
    CHECK(deviation < zone);
    CHECK(deviation > zone / 20);
    CHECK(motion.duration() < longer);  // a larger zone reduces the time
    longer = motion.duration();
  }
}

TEST_CASE("motion: a blend takes at most half of either leg, whatever its zone") {
  for (const double first : {1.0, 0.1}) {  // the length of the second leg is the other one
    const double second = first == 1 ? 0.1 : 1;
    const JointMotion motion(motion_of({move_to({0, 0}), move_to({first, 0}, 3), move_to({first, second})}),
                             robot_with({2, 2}, {4, 4}));
    double begins = first, ends = 0;
    for (double t = 0; t < motion.duration(); t += 1e-4) {
      const VectorXd place = motion.position(t), speed = motion.velocity(t);
      if (speed[1] > 0) begins = std::min(begins, place[0]);
      if (speed[0] > 0) ends = std::max(ends, place[1]);
    }
    CHECK(begins >= first / 2 * (1 - rounding));
    CHECK(ends <= second / 2 * (1 + rounding));
    // The short leg limits the blend. A step of the search above is a few per mil of its path.
    CHECK((first < second ? begins - first / 2 : second / 2 - ends) < 0.01 * std::min(first, second));
  }
  // The second axis decelerates eight times as hard: more than half of its leg could be blended, but half is the limit.
  const JointMotion motion(motion_of({move_to({0, 0}), move_to({1, 0}, 3), move_to({1, 0.1}, 0.01), move_to({2, 0.1})}),
                           robot_with({2, 2}, {1, 8}));
  double ends = 0;
  for (double t = 1e-4; motion.velocity(t)[0] > 0; t += 1e-4) ends = motion.position(t)[1];
  CHECK(ends <= 0.05 * (1 + rounding));
  CHECK(ends > 0.049);
}

TEST_CASE("motion: a right-angled blend takes the closed form's time") {
  // Both axes change by w in tau = w/A, which uses w tau/2 = z of each leg, so w = sqrt(2 A z). The rest of each leg, L - z,
  // is a move between 0 and w by (M3).
  const double length = 1, speed = 100, acceleration = 4, zone = 0.1, mean = mean_share * acceleration;
  const JointMotion motion(motion_of({move_to({0, 0}), move_to({length, 0}, zone), move_to({length, length})}),
                           robot_with({speed, speed}, {acceleration, acceleration}));
  const double w = std::sqrt(2 * mean * zone), tau = w / mean;
  const double top = std::sqrt((2 * mean * (length - zone) + w * w) / 2);
  CHECK(motion.duration() == Approx(2 * (top / mean + (top - w) / mean) + tau).epsilon(1e-9));
}

TEST_CASE("motion: a waypoint inside a straight run costs no time") {
  const pipeline::Robot robot = robot_with({2}, {4});
  const JointMotion whole(motion_of({move_to({0}), move_to({3})}), robot);
  const JointMotion passed(motion_of({move_to({0}), move_to({1.7}, 0.05), move_to({3})}), robot);
  CHECK(passed.duration() == Approx(whole.duration()).epsilon(rounding));
  CHECK(passed.step(0.5) == 1);
  CHECK(passed.step(whole.duration() - 0.5) == 2);
}

TEST_CASE("motion: a dwell stops the robot and lasts as long as it says") {
  const pipeline::Robot robot = robot_with({2}, {4});
  const JointMotion motion(motion_of({move_to({0}), move_to({1}, 0.5), dwell(0.8), move_to({2})}), robot);
  const double leg = 2 * std::sqrt(1 / 3.0);
  CHECK(motion.duration() == Approx(2 * leg + 0.8).epsilon(rounding));
  CHECK(motion.step(leg + 0.4) == 2);
  CHECK(motion.position(leg + 0.4)[0] == Approx(1).epsilon(rounding));
  CHECK(motion.velocity(leg + 0.4)[0] == 0);
}

TEST_CASE("motion: a block runs as often as it says and keeps its program lines") {
  pipeline::MotionStep block;
  block.repeat = 3;
  block.text = "weld";
  block.steps = {move_to({1}), dwell(0.5), move_to({0})};
  block.steps[1].text = "spot";
  const pipeline::Robot robot = robot_with({2}, {4});
  const JointMotion motion(motion_of({move_to({0}), block, dwell(1)}), robot);
  const double leg = 2 * std::sqrt(1 / 3.0), round = 2 * leg + 0.5;
  CHECK(motion.duration() == Approx(3 * round + 1).epsilon(rounding));
  CHECK(motion.step_texts() ==
        std::vector<std::string>{"move 1", "weld: move 2", "weld: spot", "weld: move 4", "dwell 5"});
  for (int k = 0; k < 3; ++k) {
    CHECK(motion.step(k * round + leg / 2) == 1);
    CHECK(motion.step(k * round + leg + 0.25) == 2);
    CHECK(motion.step(k * round + 1.5 * leg + 0.5) == 3);
  }
  CHECK(motion.step(3 * round + 0.5) == 4);
}

TEST_CASE("motion: a program that goes nowhere stands") {
  const JointMotion motion(motion_of({move_to({0.5}), move_to({0.5})}), robot_with({2}, {4}));
  CHECK(motion.duration() == 0);
  CHECK(motion.position(0)[0] == 0.5);
  CHECK(motion.velocity(1)[0] == 0);
}

TEST_CASE("motion: a waypoint beyond a limit is reported where it stands") {
  pipeline::MotionStep block;
  block.repeat = 2;
  block.text = "panel A";
  block.steps = {move_to({0, -10.5})};
  block.steps[0].where = {"program.yaml", 7, 9};
  CHECK_THROWS_WITH(JointMotion(motion_of({move_to({0, 0}), block}), robot_with({2, 2}, {4, 4})),
                    "program.yaml:7:9: error: waypoint 'panel A: move 2' turns joint_2 to -601.606 deg (must be "
                    "within -572.958 .. 572.958 deg); turn it 28.65 deg more, inside the limits of test robot");
}

TEST_CASE("motion: of many waypoints beyond the limits of an axis the farthest is reported, with their number") {
  std::vector<pipeline::MotionStep> steps{move_to({0, 0})};
  for (const auto& [line, angles] : {std::pair{2, std::vector{11.0, 0.0}}, {3, {12.0, 10.5}}, {4, {-10.5, 0.0}}}) {
    steps.push_back(move_to(angles));
    steps.back().where = {"program.yaml", line, 9};
  }
  const std::string text = pipeline::message_of([&] { JointMotion(motion_of(steps), robot_with({2, 2}, {4, 4})); });
  CHECK(std::count(text.begin(), text.end(), '\n') == 1);
  CHECK(
      text.find(
          "program.yaml:3:9: error: waypoint 'move 3' turns joint_1 to 687.549 deg (must be within -572.958 .. 572.958 deg), the "
          "farthest of 3 targets outside of its limits; the program may be one of another robot, or a URDF has other zeros than the controller: name the program's robot, or turn it 114.6 deg less") !=
      std::string::npos);
  CHECK(
      text.find(
          "program.yaml:3:9: error: waypoint 'move 3' turns joint_2 to 601.606 deg (must be within -572.958 .. 572.958 deg); turn it "
          "28.65 deg less") != std::string::npos);
}

TEST_CASE("motion: a program has to begin with a move") {
  pipeline::Motion motion = motion_of({dwell(1)});
  motion.steps[0].where = {"program.yaml", 4, 5};
  CHECK_THROWS_WITH(JointMotion(motion, robot_with({2}, {4})),
                    "program.yaml:4:5: error: motion 'test' does not begin with a move; begin with the "
                    "joints_deg at which the robot starts");
}

TEST_CASE("motion: an axis that is held stands at the middle of its way, and the others move as before") {
  const pipeline::Robot robot = robot_with({1, 2, 3}, {2, 3, 4});
  const pipeline::Motion program = motion_of({move_to({0, 1, 0}), move_to({1, -3, 2}), dwell(0.5), move_to({0, 1, 0})});
  const JointMotion whole(program, robot);
  JointMotion held(program, robot);
  held.hold(1);
  CHECK(held.duration() == whole.duration());
  for (int k = 0; k <= 100; ++k) {
    const double time = whole.duration() * k / 100;
    CHECK(held.position(time)[1] == -1);
    CHECK(held.velocity(time)[1] == 0);
    CHECK(held.acceleration(time)[1] == 0);
    for (const int other : {0, 2}) CHECK(held.position(time)[other] == whole.position(time)[other]);
    CHECK(held.step(time) == whole.step(time));
  }
}

TEST_CASE("motion: long waits are shortened, and moves before and behind them stay the same at the program's times") {
  pipeline::MotionStep block;
  block.repeat = 2;
  block.steps = {move_to({1.0}), dwell(30), move_to({0.0}), dwell(7), dwell(6), dwell(2)};
  const pipeline::Robot robot = robot_with({2}, {4});
  const JointMotion whole(motion_of({move_to({0.0}), dwell(3), block}), robot);
  JointMotion cut = whole;
  cut.shorten_waits(10);
  // 20 s of 30 s, and 5 s of three successive waits of 15 s; twice. The last wait is missing completely.
  CHECK(cut.duration() == Approx(whole.duration() - 2 * (20 + 5)));
  CHECK(cut.program_time(cut.duration()) == Approx(whole.duration()));
  CHECK(cut.program_time(-1) == -1);
  for (int k = 0; k <= 1000; ++k) {
    const double time = cut.duration() * k / 1000, of_program = cut.program_time(time);
    CHECK(cut.position(time)[0] == Approx(whole.position(of_program)[0]).margin(1e-9));
    CHECK(cut.velocity(time)[0] == Approx(whole.velocity(of_program)[0]).margin(1e-9));
  }
  for (std::size_t k = 1; k < cut.pieces().size(); ++k)
    CHECK(cut.pieces()[k].start == Approx(cut.pieces()[k - 1].start + cut.pieces()[k - 1].duration));
}

TEST_CASE("motion: rows of a recording are a spline at rest where two rows are equal") {
  const auto row = [](double angle, double seconds) {
    pipeline::MotionStep step = move_to({angle});
    if (seconds > 0) step.duration = seconds;
    return step;
  };
  // t^2 (3 - 2 t) at the rows' times, then 2 s at rest, and back in 1 s.
  pipeline::Motion motion = motion_of({row(0, 0), row(0.104, 0.2), row(0.784, 0.5), row(1, 0.3), row(1, 2), row(0, 1)});
  motion.rows = pipeline::RecordedRows::spline;
  const JointMotion joint(motion, robot_with({0.1}, {0.1}));  // limits do not apply
  CHECK(joint.duration() == Approx(4).epsilon(rounding));
  for (double t = 0; t < 1; t += 0.03) {
    CHECK(joint.position(t)[0] == Approx(t * t * (3 - 2 * t)).margin(rounding));
    CHECK(joint.velocity(t)[0] == Approx(6 * t * (1 - t)).margin(rounding));
    CHECK(joint.acceleration(t)[0] == Approx(6 - 12 * t).margin(100 * rounding));
    CHECK(joint.position(3 + t)[0] == Approx(1 - t * t * (3 - 2 * t)).margin(rounding));
  }
  CHECK(joint.position(2)[0] == 1);
  JointMotion held(motion, robot_with({0.1}, {0.1}));
  held.hold(0);
  for (double t = 0; t < 4; t += 0.1) CHECK(held.position(t)[0] == 0.5);
  CHECK(held.velocity(0.5)[0] == 0);
  motion.steps.insert(motion.steps.begin() + 1, dwell(1));
  CHECK_THROWS_WITH(JointMotion(motion, robot_with({2}, {4})), Catch::Contains("is no joint move with a duration"));
}

}  // namespace
