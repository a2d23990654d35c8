// Cycle times calculated by hand, and the axes' motion on a line by geometry.
//
// With a_i the largest acceleration of an axis, the mean acceleration of a change of speed is A = 0.75 a_i (motion.h: M2). A
// move of L from rest to rest at the speed c takes L/c + c/A, or 2 sqrt(L/A) if it does not reach c (L < c^2/A).
#include <cmath>
#include <optional>
#include <random>

#include "pipeline/base/constants.h"
#include "sim/program/import.h"
#include "sim/robot/inverse_kinematics.h"
#include "sim/robot/motion.h"
#include "tests/catch.h"
#include "tests/sim/robot/small_arm.h"

namespace dresslife::sim {
namespace {

constexpr double closed_form = 1e-9;  // of seconds, where the calculation by hand uses the program's own formula
/// Where the calculation neglects the tool's acceleration by the axes: some hundredths of a second at each stop. Stops are at
/// least a second apart.
constexpr double by_hand = 0.05;

/// 100, 90, 90, 170, 140, 190 deg/s, 400 deg/s2 for the arm, 2000 deg/s2 for the wrist.
pipeline::Robot arm() {
  pipeline::Robot robot = small_arm();
  const double speeds[] = {100, 90, 90, 170, 140, 190};
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    robot.joints[i].speed = speeds[i] * degree;
    robot.joints[i].acceleration = (i < 3 ? 400 : 2000) * degree;
  }
  return robot;
}

JointMotion run(const std::string& main) {
  std::deque<SourceFile> files;
  const std::string target =
      "CONST robtarget p0:=[[1200,0,1200],[0.70710678,0,0.70710678,0],[0,0,0,0],"
      "[9E9,9E9,9E9,9E9,9E9,9E9]];\n";
  files.emplace_back("cell.mod", "MODULE cell\nCONST speeddata v250:=[250,500,5000,1000];\n" + target +
                                     "PROC main()\nConfL \\Off;\nConfJ \\Off;\n" + main + "ENDPROC\nENDMODULE\n");
  Problems problems;
  const Program program = read_program(Language::rapid, std::move(files), {}, {}, {}, problems);
  problems.throw_if_any();
  return {motion_of(program, {}), arm()};
}

std::string axes(double q1, double q2, double q3) {
  return fmt::format("MoveAbsJ [[{},{},{},0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],vmax,fine,tool0;\n", q1, q2, q3);
}

std::string line(double x, double y, double z, const char* speed, const char* zone) {
  return fmt::format("MoveL Offs(p0,{},{},{}),{},{},tool0;\n", x, y, z, speed, zone);
}

}  // namespace

TEST_CASE("cycle time: axis moves with stops and a dwell") {
  // Axis 1 by 90 deg: A = 300, c^2/A = 33 < 90: 90/100 + 100/300 s.
  // Axes 1 and 2 back by 90 and 10 deg: axis 1 is slower, so the time is equal.
  // Axis 2 by 10 deg: c^2/A = 27 > 10: 2 sqrt(10/300) s.
  const double ninety = 0.9 + 1.0 / 3, ten = 2 * std::sqrt(10.0 / 300);
  const JointMotion motion = run(axes(0, 0, 0) + axes(90, 0, 0) + "WaitTime 0.75;\n" + axes(90, 10, 0) + axes(0, 0, 0));
  CHECK(motion.duration() == Approx(ninety + 0.75 + ten + ninety).epsilon(closed_form));
}

TEST_CASE("cycle time: a speed in mm/s on an axis move") {
  // The wrist turns with axis 1 at 1 m from it (axis 5 at 30 deg adds no distance there): v500 is 0.5 rad/s.
  // 90 deg = 1.5708 rad: 1.5708/0.5 + 0.5/(300 deg/s2 = 5.236 rad/s2) = 3.237 s.
  const JointMotion motion =
      run(axes(0, 0, 0) + "MoveAbsJ [[90,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v500,fine,tool0;\n");
  CHECK(motion.duration() == Approx(1.5708 / 0.5 + 0.5 / 5.236).epsilon(1e-3));  // the path of the tool's fastest part
}

TEST_CASE("cycle time: a line at the tool's speed") {
  // 800 mm at 400 mm/s, from rest to rest. Across the arm at 1.2 m, axis 1 accelerates the tool by
  // 5.236 rad/s2 x 1.2 m = 6.3 m/s2: 0.8/0.4 + 0.4/6.3 = 2.064 s.
  const JointMotion across = run("MoveJ Offs(p0,0,-400,0),vmax,fine,tool0;\n" + line(0, 400, 0, "v400", "fine"));
  CHECK(across.duration() == Approx(2.064).epsilon(by_hand));
  // To and fro with a dwell of half a second, spot by spot: 5 x (100 mm at 200 mm/s, 0.5 s).
  // 0.1/0.2 + 0.2/6.3 + 0.5 = 1.032 s each.
  std::string spots = "MoveJ Offs(p0,0,-250,0),vmax,fine,tool0;\n";
  for (int k = 1; k <= 5; ++k) spots += line(0, -250 + 100 * k, 0, "v200", "fine") + "WaitTime 0.5;\n";
  CHECK(run(spots).duration() == Approx(5 * 1.032).epsilon(by_hand));
}

TEST_CASE("cycle time: zones save the stops and cut the corners") {
  // A square of 400 mm in the plane x = 1.2 m at 250 mm/s. With stops: 4 x (0.4/0.25 + 0.25/A_tool), A_tool about 6 m/s2 in
  // horizontal and 3 in vertical direction (two axes lift): 4 x 1.6 + 2 x 0.042 + 2 x 0.083 = 6.65 s.
  const auto square = [](const char* zone) {
    return run("MoveJ Offs(p0,0,-200,0),vmax,fine,tool0;\n" + line(0, 200, 0, "v250", zone) +
               line(0, 200, 400, "v250", zone) + line(0, -200, 400, "v250", zone) + line(0, -200, 0, "v250", "fine"));
  };
  const double stopped = square("fine").duration();
  CHECK(stopped == Approx(6.65).epsilon(by_hand));
  // z50: at each of three corners 100 mm less of the lines and a curve of 50 mm x 1.6232 (the length of (M6) at a right
  // angle) more; one start and one stop: (1.6 - 3 x 0.1 + 3 x 0.0812)/0.25 + 0.042/2 + 0.083/2 = 6.24 s.
  const double rounded = square("z50").duration();
  CHECK(rounded == Approx(6.24).epsilon(by_hand));
  CHECK(rounded < stopped);
}

TEST_CASE("cycle time: on a long line the axes do what geometry says, and nothing else") {
  // x = 1.2 m, y = y0 + v t: q_1 = atan(y/x), q_1' = v x/(x^2 + y^2), q_1'' = -2 x y v^2/(x^2 + y^2)^2.
  const double x = 1.2, v = 0.8, half = 0.6;
  const JointMotion motion = run("MoveJ Offs(p0,0,-600,0),vmax,fine,tool0;\n" + line(0, 600, 0, "v800", "fine"));
  const InverseKinematics arm_of_it(arm());
  constexpr double margin = 0.25;           // [s] of acceleration at either end
  constexpr double speed_tolerance = 2e-4;  // [rad/s] of 0.67: control points 12 mm apart, (h u)^2/(24 r^2)
  constexpr double bend_tolerance = 1e-3;   // [rad/s2] of up to 0.35; (h u)^2/12 r^2 of it, and the ends of the legs
  double steady = 0, unsteady = 0;
  for (double t = margin; t < motion.duration() - margin; t += 1e-3) {
    const double y = arm_of_it.flange(motion.position(t)).position.y(), r2 = x * x + y * y;
    steady = std::max(steady, std::abs(motion.velocity(t)[0] - v * x / r2));
    unsteady = std::max(unsteady, std::abs(motion.acceleration(t)[0] + 2 * x * y * v * v / (r2 * r2)));
  }
  CHECK(steady < speed_tolerance);
  CHECK(unsteady < bend_tolerance);
  CHECK(half / v < motion.duration());
}

TEST_CASE("cycle time: random programs of lines and axis moves exceed no limit nor jerk without bound") {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const pipeline::Robot robot = arm();
  constexpr double limit_margin = 1e-9;  // [rad/s, rad/s2] roundings of 1e-16 in angles, over times of some ms squared
  int run_through = 0;
  for (int program = 0; program < 25; ++program) {
    std::string text = "MoveJ Offs(p0,0,0,0),vmax,fine,tool0;\n";
    for (int move = 0; move < 12; ++move) {
      const char* zones[] = {"fine", "z1", "z10", "z50", "z100", "z200"};
      const char* speeds[] = {"v50", "v200", "v800", "v2500", "vmax"};
      text +=
          fmt::format("{} RelTool(p0,{:.1f},{:.1f},{:.1f}\\Rx:={:.1f}\\Rz:={:.1f}),{},{},tool0;\n",
                      uniform(random) < 0.3 ? "MoveL" : "MoveJ", 250 * uniform(random), 400 * uniform(random),
                      250 * uniform(random), 25 * uniform(random), 60 * uniform(random),
                      speeds[std::lround(2 + 2 * uniform(random))], zones[std::lround(2.5 + 2.5 * uniform(random))]);
    }
    CAPTURE(text);
    std::optional<JointMotion> motion;
    try {
      motion.emplace(run(text));
    } catch (const pipeline::InputError&) {
      continue;  // the wrist would turn over on a line
    }
    ++run_through;
    double over_speed = -1, over_acceleration = -1, sharpest = 0;
    for (const MotionPiece& piece : motion->pieces())
      for (long i = 0; i < piece.jerk.size(); ++i)
        sharpest = std::max(sharpest, std::abs(piece.jerk[i]) / robot.joints[i].acceleration);
    const double step = 5e-4;
    for (double t = 0; t < motion->duration(); t += step) {
      const Eigen::VectorXd v = motion->velocity(t), a = motion->acceleration(t);
      for (int i = 0; i < 6; ++i) {
        over_speed = std::max(over_speed, std::abs(v[i]) - robot.joints[i].speed);
        over_acceleration = std::max(over_acceleration, std::abs(a[i]) - robot.joints[i].acceleration);
      }
    }
    CHECK(over_speed < limit_margin);
    CHECK(over_acceleration < limit_margin);
    CHECK(sharpest < 2 / 0.015 * (1 + 1e-9));  // from one limit to the other within one step of the control points
  }
  CHECK(run_through > 10);
}

TEST_CASE("cycle time: a larger zone makes no program longer, also where two zones meet within a move") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  // Each change of direction may cost a control step, because the curve through its points turns more tightly than the zone.
  constexpr double of_a_zone = 0.03;  // [s]
  int run_through = 0;
  for (int program = 0; program < 60; ++program) {
    std::vector<std::string> moves;
    for (int move = 0; move < 4; ++move) {
      const auto grid = [&] {
        return 150 * std::lround(1.5 * uniform(random));
      };  // equal distances, so that zones meet
      moves.push_back(fmt::format("{} Offs(p0,{},{},{}),{},", uniform(random) < 0 ? "MoveL" : "MoveJ", grid(), grid(),
                                  grid(), uniform(random) < 0 ? "v500" : "v2000"));
    }
    double shorter = 0;
    for (const char* zone : {"z200", "z150", "z100", "z50", "z10"}) {
      std::string text = "MoveJ Offs(p0,0,0,0),vmax,fine,tool0;\n";
      for (const std::string& move : moves) text += move + zone + ",tool0;\n";
      CAPTURE(text);
      try {
        const double duration = run(text).duration();
        CHECK(duration > shorter - of_a_zone);
        shorter = duration;
        ++run_through;
      } catch (const pipeline::InputError&) {
        break;  // the wrist would turn over on a line
      }
    }
  }
  CHECK(run_through > 100);
}

TEST_CASE("cycle time: a path speeds up once and slows down once") {
  // The hose responds to every change of sign of an axis' acceleration. On a line away from singular positions axis 1 has
  // three: acceleration, the middle of the line, deceleration.
  const JointMotion motion = run("MoveJ Offs(p0,0,-600,0),vmax,fine,tool0;\n" + line(0, 600, 0, "v800", "fine"));
  int changes = 0;
  double before = 0;
  for (double t = 0; t < motion.duration(); t += 1e-3) {
    const double now = motion.acceleration(t)[0];
    if (std::abs(now) < 1e-3) continue;  // [rad/s2]: at rest, and rounding of the joint angles
    changes += before * now < 0;
    before = now;
  }
  CHECK(changes <= 3);
}

TEST_CASE("cycle time: a path is smoothed longer by its key and by the second argument of AccSet") {
  const std::string moves = "MoveJ Offs(p0,0,-300,0),vmax,fine,tool0;\n" + line(0, 300, 0, "v800", "fine");
  const auto sharpest = [](const JointMotion& motion) {  // largest jerk of any axis / its largest acceleration [1/s]
    double most = 0;
    for (const MotionPiece& piece : motion.pieces())
      for (long i = 0; i < piece.jerk.size(); ++i)
        most = std::max(most, std::abs(piece.jerk[i]) / arm().joints[i].acceleration);
    return most;
  };
  const JointMotion plain = run(moves), soft = run("AccSet 100,25;\n" + moves),
                    softest = run("AccSet 100,5;\n" + moves);
  // Four and ten times smaller, apart from the effect of the axes' limits.
  CHECK(sharpest(soft) < sharpest(plain) / 3);
  CHECK(sharpest(softest) < sharpest(plain) / 8);  // 10 % is the lower limit of the setting
  CHECK(soft.duration() > plain.duration());
}

}  // namespace dresslife::sim
