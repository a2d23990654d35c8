
#include "tests/catch.h"
#include "tests/sim/program/reading.h"

using namespace dresslife;
using namespace dresslife::sim;
using namespace dresslife::tests;

namespace {

constexpr double rounding = 1e-12;  // rounding error of a product of numbers near 1

Reading columns(const std::string& text, const std::map<std::string, std::string>& values = {}) {
  return Reader{Language::joint_columns, given(values)}({{"j.csv", text}});
}

Reading ros(const std::string& text, const std::map<std::string, std::string>& values = {}) {
  return Reader{Language::ros_trajectory, given(values)}({{"j.yaml", text}});
}

std::string point(const std::string& positions, int second) {
  return "- {positions: [" + positions + "], time_from_start: {sec: " + std::to_string(second) + ", nanosec: 0}}\n";
}

}  // namespace

TEST_CASE("columns: the unit comes from the names, where neither they nor the angles tell it, it is asked for") {
  // 1.57 is a right angle in rad and a very small angle in deg: the wrong unit gives a plausible motion.
  const std::string small = "timestamp,joint_1,joint_2\n0,0.0,-1.57\n1,0.5,-1.57\n";
  const Reading asked = columns(small);
  CHECK(asked.problem() ==
        "j.csv:1:1: error: gives angles without a unit (none is too large for radians); end the names in deg "
        "or "
        "rad (joint_1_rad), or give motion.values: [{name: unit, value: deg}] or value: rad");
  CHECK(columns(small, {{"unit", "rad"}}).move(0).target.joints[1] == -1.57);
  CHECK(columns(small, {{"unit", "deg"}}).move(0).target.joints[1] == Approx(-1.57 * degree).epsilon(rounding));
  CHECK(columns("t;a1 [rad];a2 [deg]\n0;1;90\n").move(0).target.joints == std::vector<double>{1, 90 * degree});
  // No axis turns by 98 rad.
  CHECK(columns("Time, Axis 1, Axis 2\n0, 17, -98\n").move(0).target.joints[1] ==
        Approx(-98 * degree).epsilon(rounding));
}

TEST_CASE("columns, ROS: an answer that the file does not ask for is a warning, and degrees are refused for ROS") {
  CHECK(skips(columns("time,a1 [deg]\n0,1\n", {{"spead", "1"}}), "motion.values of spead", true));
  const std::string one = "joint_names: [j1]\npoints:\n" + point("0.5", 0) + point("0.6", 1);
  CHECK(skips(ros(one, {{"spead", "1"}}), "motion.values of spead", true));
  CHECK(ros(one, {{"unit", "rad"}}).program.skipped.empty());
  CHECK(ros(one, {{"unit", "deg"}}).problem().find("whose angles are in rad") != std::string::npos);
}

TEST_CASE("ROS: a fault in a later document has its line") {
  const std::string one = "joint_names: [j1]\npoints:\n" + point("0.5", 0) + point("0.6", 1);  // four lines
  CHECK(ros(one + "---\njoint_names: [j1]\npoints:\n- {positions: [x], time_from_start: 0}\n", {{"trajectory", "2"}})
            .problem()
            .starts_with("j.yaml:8:"));
  CHECK(ros(one + "---\na: 1\na: 2\n").problem().starts_with("j.yaml:7:"));
}

TEST_CASE("columns: T is the sixth axis of S, L, U, R, B, T") {
  for (const char* names :
       {"time_s,S_deg,L_deg,U_deg,R_deg,B_deg,T_deg", "S_deg,L_deg,U_deg,R_deg,B_deg,T_deg,time_s"}) {
    const bool time_first = names[0] == 't';
    const Reading r = columns(std::string(names) + "\n" + (time_first ? "0,1,2,3,4,5,6\n" : "1,2,3,4,5,6,0\n"));
    REQUIRE(r.problem() == "no such problem");
    REQUIRE(r.move(0).target.joints.size() == 6);
    CHECK(r.move(0).target.joints[5] == Approx(6 * degree).epsilon(rounding));
  }
  CHECK(columns("T,a1 [deg]\n0,1\n2,3\n").move(1).speed.duration == 2.0);
}

TEST_CASE("columns: decimal commas in cells that semicolons separate") {
  const Reading read = columns("time;a1 [deg];a2 [deg]\n0,0;-90,5;1e1\n0,5;0,25;10\n");
  REQUIRE(read.problems.empty());
  CHECK(read.move(0).target.joints[0] == Approx(-90.5 * degree).epsilon(rounding));
  CHECK(read.move(1).target.joints[0] == Approx(0.25 * degree).epsilon(rounding));
  CHECK_FALSE(columns("time;a1 [deg]\n0;1,000,5\n").problems.empty());
}

TEST_CASE("columns: the axes stand in the order of their names") {
  const std::vector<double> expected{10 * degree, 20 * degree, 30 * degree};
  CHECK(columns("time,joint_3,joint_2,joint_1\n0,30,20,10\n").move(0).target.joints == expected);
  CHECK(columns("robot1_joint_2_l,robot1_joint_1_s,robot1_joint_3_u,time\n20,10,30,0\n").move(0).target.joints ==
        expected);
  // ROS sorts the joints of a Universal Robot alphabetically; the controller sorts them from the base.
  CHECK(columns("elbow_joint,shoulder_lift_joint,shoulder_pan_joint,wrist_1_joint,wrist_2_joint,wrist_3_joint\n"
                "30,20,10,40,50,60\n")
            .move(0)
            .target.joints[0] == Approx(10 * degree).epsilon(rounding));
  const Reading unknown = columns("time,hip,knee\n0,30,20\n");
  CHECK(
      unknown.problem() ==
      "j.csv:1:1: error: names axes without their order (hip, knee); number them in their names "
      "(joint_1 ...), or give motion.values: [{name: joints, value: 'NAME,NAME,...'}] in the order of the robot's axes");
  CHECK(columns("time,hip,knee\n0,30,20\n", {{"joints", "knee, hip"}}).move(0).target.joints ==
        std::vector<double>{20 * degree, 30 * degree});
}

TEST_CASE("columns: points are no axes, and what is no angle is left out by name") {
  const Reading points = columns("time,x1,y1,z1,x2,y2,z2\n0,1,2,3,4,5,60\n");
  REQUIRE(points.problems.size() == 1);
  CHECK(points.problems[0].what == "names points or lengths (x1, y1, z1, x2, y2, z2)");
  const Reading bag = columns(
      "%time,field.header.seq,field.header.stamp,field.name0,field.name1,field.position0,field.position1,"
      "field.velocity0,field.velocity1\n"
      "1500000000,7,1500000000,joint_a1,joint_a2,0.5,50,1,1\n2000000000,8,2000000000,joint_a1,joint_a2,0.6,"
      "51,1,1\n");
  REQUIRE(bag.problem() == "no such problem");
  REQUIRE(bag.program.instructions.size() == 2);
  CHECK(bag.move(0).target.joints.size() == 2);
  CHECK(bag.move(1).speed.duration.value() == Approx(0.5).epsilon(rounding));  // %time counts nanoseconds
  CHECK(bag.program.skipped.size() == 6);
}

TEST_CASE("columns: a clock since 1970 is recognised by its digits") {
  const auto duration = [](const std::string& name, const std::string& first, const std::string& second) {
    return columns(name + ",a1_deg\n" + first + ",1\n" + second + ",2\n").move(1).speed.duration.value();
  };
  constexpr double clock = 1e-5;  // a double near 1.7e18 ns has a resolution of 256 ns
  CHECK(duration("timestamp", "1740157761107442718", "1740157761207442718") == Approx(0.1).epsilon(clock));
  CHECK(duration("timestamp", "1740157761107", "1740157761207") == Approx(0.1).epsilon(clock));
  CHECK(duration("ros_time", "1740157761.1", "1740157761.2") == Approx(0.1).epsilon(clock));
  CHECK(duration("time_ms", "0", "100") == Approx(0.1).epsilon(rounding));
  CHECK(duration("time_min", "0", "0.5") == Approx(30).epsilon(rounding));
  CHECK(duration("time", "0", "100") == Approx(100).epsilon(rounding));
}

TEST_CASE("columns: lengths and one joint per line are no poses") {
  CHECK(columns("q1_deg,q2_deg,q3_mm\n1,2,3\n").problems.at(0).what == "names points or lengths (q3_mm)");
  CHECK(columns("ros_time,joint_name,position,velocity\n0,elbow,1,2\n").problems.at(0).what ==
        "lists one joint per line (a column of names)");
}

TEST_CASE("ROS: joint_names give the order, and several trajectories are a question") {
  const std::string first = "joint_names: [joint_2, joint_1]\npoints:\n" + point("2, 1", 0) + point("4, 3", 1);
  CHECK(ros(first).move(1).target.joints == std::vector<double>{3, 4});
  const std::string second = "joint_names: [joint_1, joint_2]\npoints:\n" + point("5, 6", 0);
  const Reading two = ros(first + "---\n" + second);
  REQUIRE(two.problems.size() == 1);
  CHECK(two.problems[0].what == "is one of 2 trajectories in the file");
  CHECK(two.problems[0].where.line > 5);
  CHECK(ros(first + "---\n" + second, {{"trajectory", "2"}}).move(0).target.joints == std::vector<double>{5, 6});
  CHECK(ros("---\n" + first).program.instructions.size() == 2);
  // MoveIt's DisplayTrajectory: a list of trajectories, each with an empty multi_dof trajectory.
  const Reading display =
      ros("trajectory:\n- multi_dof_joint_trajectory: {joint_names: [], points: []}\n"
          "  joint_trajectory:\n    joint_names: [joint_1]\n    points:\n    - {positions: [1], "
          "time_from_start: 0}\n");
  REQUIRE(display.problem() == "no such problem");
  CHECK(display.move(0).target.joints == std::vector<double>{1});
  CHECK(ros("points:\n" + point("1", 0)).problems.at(0).what == "has 0 joint_names");
  CHECK(ros("joint_names: [joint_1, joint_2]\npoints:\n" + point("1", 0)).problems.at(0).what ==
        "has no positions of 2 joints");
}
