#include <cmath>

#include "pipeline/base/constants.h"
#include "tests/catch.h"
#include "tests/sim/program/reading.h"

using namespace dresslife;
using namespace dresslife::sim;
using namespace dresslife::tests;

namespace {

constexpr double rounding = 1e-12;  // rounding error of a few products of numbers near 1

Reading run(const std::string& text, const ImportOptions& options = {}) {
  return Reader{Language::urscript, options}({{"s.script", text}});
}

/// Reads these lines in a function, after a set_tcp of 100 mm.
Reading program(const std::string& lines, const ImportOptions& options = {}) {
  return run("def main():\nset_tcp(p[0,0,0.1,0,0,0])\n" + lines + "end\n", options);
}

std::vector<double> first_axes(const Reading& r) {
  std::vector<double> first;
  for (const Instruction& i : r.program.instructions)
    if (!i.target.joints.empty()) first.push_back(i.target.joints[0]);
  return first;
}

const std::string go = "(a):\n  movej([a,0,0,0,0,0])\nend\n";

}  // namespace

TEST_CASE("urscript: moves with their speeds, accelerations, times and blends") {
  const Reading r = program(
      "movej([0.1,-1.2,1.3,0,0.5,0], a=1.4, v=1.05)\nmovel(p[0.4,-0.2,0.3,0,pi_,0], 0.8, 0.3, 0, 0.02)\n"
      "movej(p[0.4,0.2,0.3,0,0,0], t=2.5)\nmovep(p[0.5,0.2,0.3,0,0,0], v=0.1, r=0.01)\n"
      "movec(p[0.6,0.3,0.3,0,0,0], p[0.7,0.2,0.3,0,0,0], v=0.2)\nmovej([0,0,0,0,0,0])\nsleep(0.75)\n"
      "servoj([0,0,0,0,0,0.1], t=0.1)\nmovel([0,0,0,0,0,0.2])\nservoj([0,0,0,0,0,0.2], 1, 1, gain=500)\n",
      given({{"pi_", "3.141592653589793"}}));
  REQUIRE(r.problem() == "no such problem");
  REQUIRE(r.program.instructions.size() == 10);
  CHECK(r.move(0).target.joints == std::vector<double>{0.1, -1.2, 1.3, 0, 0.5, 0});
  CHECK(r.move(0).speed.axis.value() == 1.05);
  CHECK(r.move(0).speed.axis_acceleration.value() == 1.4);
  CHECK((r.move(0).zone.distance == 0 && r.move(0).zone.percent == 0));
  CHECK(r.move(1).kind == Instruction::Kind::linear);
  CHECK(r.move(1).speed.tool.value() == 0.3);
  CHECK(r.move(1).speed.tool_acceleration.value() == 0.8);
  CHECK(r.move(1).zone.distance == 0.02);
  CHECK((r.move(1).target.pose.orientation * Vector3::UnitZ() + Vector3::UnitZ()).norm() < rounding);
  CHECK(r.program.tools.at(r.move(1).tool).frame.position.z() == 0.1);
  CHECK(r.move(2).kind == Instruction::Kind::joint);
  CHECK(r.move(2).speed.duration.value() == 2.5);
  CHECK(!r.move(2).speed.axis);
  CHECK(r.move(3).speed.tool.value() == 0.1);
  CHECK(r.move(3).speed.tool_acceleration.value() == 1.2);
  CHECK(r.move(4).kind == Instruction::Kind::circular);
  CHECK((r.move(4).via.position - Vector3(0.6, 0.3, 0.3)).norm() < rounding);
  CHECK((r.move(4).target.pose.position - Vector3(0.7, 0.2, 0.3)).norm() < rounding);
  CHECK(r.move(5).speed.axis.value() == 1.05);
  CHECK(r.move(6).dwell == 0.75);
  CHECK(r.move(7).zone.percent == 100);
  CHECK(r.move(7).speed.duration.value() == 0.1);
  CHECK(r.move(8).kind == Instruction::Kind::linear);
  CHECK(r.move(8).speed.tool.value() == 0.25);
  CHECK(r.move(9).speed.duration.value() == 0.002);  // the default; a and v of servoj do nothing
  CHECK(!r.move(9).speed.axis);
}

TEST_CASE("urscript: what PolyScope writes: waypoints with the joint angles that were taught") {
  const Reading r =
      run("def Robot_Program():\n  set_tcp(p[.0,.0,.0,.0,.0,.0])\n  global Waypoint_1_p=p[.4,-.4,.5,1.5,.5,.5]\n"
          "  global Waypoint_1_q=[1.99, -1.66, 1.93, -0.27, 1.32, 0.003]\n  while (True):\n    $ 2 \"MoveJ\"\n"
          "    $ 3 \"Waypoint_1\" \"breakAfter\"\n"
          "    movej(get_inverse_kin(Waypoint_1_p, qnear=Waypoint_1_q), a=1.3962634015954636, v=1.0471975511965976)\n"
          "  end\nend\n");
  REQUIRE(r.problem() == "no such problem");
  REQUIRE(r.program.instructions.size() == 1);
  CHECK(r.move(0).tool == -1);
  CHECK((r.move(0).target.pose.position - Vector3(0.4, -0.4, 0.5)).norm() < rounding);
  CHECK(rotation_vector(r.move(0).target.pose.orientation).isApprox(Vector3(1.5, 0.5, 0.5), 1e-12));
  CHECK(r.move(0).target.configuration.text() == "near 114 -95 111 -15 76 0");
  CHECK(arm_configuration("near 114 -95 111 -15 76 0").value() == r.move(0).target.configuration);
  CHECK(skips(r, "an endless loop", false));
  for (const char* tool : {"[0,0,0,0,0,0],1e-10,1e-10,p[0,0,0.4,0,0,0]", "[0,0,0,0,0,0],tcp=p[0,0,0.4,0,0,0]"})
    CHECK(program(fmt::format("movej(get_inverse_kin(p[.4,.1,.5,0,3.14,0],{}))\n", tool))
              .problem()
              .find("the inverse kinematics of another tool") != std::string::npos);
}

TEST_CASE("urscript: poses are composed as the manual says") {
  const Reading r = program(
      "a = p[1,2,3,0,0,d2r(90)]\nb = p[0.1,0,0,d2r(90),0,0]\nmovel(pose_trans(a, b))\nmovel(pose_add(a, b))\n"
      "movel(pose_trans(pose_inv(a), a))\nmovel(pose_sub(a, b))\nmovel(interpolate_pose(a, "
      "p[3,2,3,0,0,0], 0.5))\na[2] = a[2] + norm([3,4])\nmovel(a)\nmovel(get_forward_kin([0,0,0,0,0,1]))\n"
      "movej([1,2,3,4,5,6])\nq = get_actual_joint_positions()\nq[0] = q[0] + sqrt(4)\nmovej(q)\n"
      "movel(a)\nmovel(pose_trans(get_actual_tcp_pose(), p[0,0,1,0,0,0]))\n");
  REQUIRE(r.problem() == "no such problem");
  const auto position = [&](std::size_t i) { return r.move(i).target.pose.position; };
  CHECK((position(0) - Vector3(1, 2.1, 3)).norm() < rounding);
  // The first rotation moves z to y, the second one is 90 deg about the new x: z of the result is x of the base.
  CHECK((r.move(0).target.pose.orientation * Vector3::UnitZ() - Vector3::UnitX()).norm() < rounding);
  CHECK((position(1) - Vector3(1.1, 2, 3)).norm() < rounding);
  CHECK((r.move(1).target.pose.orientation * Vector3::UnitZ() - Vector3::UnitX()).norm() < rounding);
  CHECK(position(2).norm() < rounding);
  CHECK((position(3) - Vector3(0.9, 2, 3)).norm() < rounding);
  CHECK((position(4) - Vector3(2, 2, 3)).norm() < rounding);
  CHECK(rotation_vector(r.move(4).target.pose.orientation).z() == Approx(pi / 4));
  CHECK((position(5) - Vector3(1, 2, 8)).norm() < rounding);
  CHECK(r.move(6).target.joints.at(5) == 1);
  CHECK(r.move(8).target.joints.at(0) == 3);
  CHECK((position(10) - Vector3(1, 2, 9)).norm() < rounding);
}

TEST_CASE("urscript: roll, pitch and yaw are about the axes of the base, one after the other") {
  // 90 deg about x, then 90 deg about z: z moves to -y, then to x; x stays, then moves to y. The axis is (1,1,1).
  const Reading r = program(
      "v = rpy2rotvec([pi/2,0,pi/2])\nw = rotvec2rpy([0.3,0,0])\nu = rotvec2rpy(rpy2rotvec([0.4,-0.5,0.6]))\n"
      "movej([v[0],v[1],v[2],w[0],w[1],w[2]])\nmovej([u[0],u[1],u[2],0,0,0])\n");
  REQUIRE(r.problem() == "no such problem");
  const std::vector<double> first = r.move(0).target.joints, second = r.move(1).target.joints;
  const double third = 2 * pi / 3 / std::sqrt(3.0);
  for (int i = 0; i < 3; ++i) {
    CHECK(first[i] == Approx(third).margin(rounding));
    CHECK(first[3 + i] == Approx(i == 0 ? 0.3 : 0).margin(rounding));
    CHECK(second[i] == Approx(std::vector{0.4, -0.5, 0.6}[i]).margin(rounding));
  }
}

TEST_CASE("urscript: functions give the numbers of the manual's examples, and operators take lists item by item") {
  // Script manual, modules urmath and "matrix and array expressions"; its numbers have five digits.
  const Reading r = program(
      "movel(inv(p[.2,.5,.1,1.57,0,3.14]))\nmovel(pose_trans(p[.2,.5,.1,1.57,0,0], p[.2,.5,.6,1.57,0,0]))\n"
      "movej([norm(-5.3),norm(p[-.2,.2,-.2,-1.57,0,3.14]),log(10.,4.),0,0,0])\n"
      "a = [10,20,30] * [1,2,3]\nb = [10,20,30] / [1,2,5] + 1\nmovej([a[0],a[1],a[2],b[0],b[1],b[2]])\n"
      "movej([1,2,3,4,5,6] - 2 * [0,0,0,1,1,1])\n"
      "f = p[1,2,3,0,0,d2r(90)]\nt = p[4,5,6,d2r(90),0,0]\nmovel(pose_add(f, pose_sub(t, f)))\nmovel(pose_sub(t, f))\n");
  REQUIRE(r.problem() == "no such problem");
  constexpr double digits = 5e-5;
  const auto turn = [&](std::size_t i) { return rotation_vector(r.move(i).target.pose.orientation); };
  CHECK((r.move(0).target.pose.position - Vector3(0.19324, 0.41794, -0.29662)).norm() < digits);
  CHECK((turn(0) - Vector3(1.23993, 0, 2.47985)).norm() < digits);
  CHECK((r.move(1).target.pose.position - Vector3(0.4, -0.0996, 0.60048)).norm() < digits);
  CHECK((turn(1) - Vector3(3.14, 0, 0)).norm() < digits);
  CHECK(r.move(2).target.joints[0] == Approx(5.3));
  CHECK(r.move(2).target.joints[1] == Approx(3.52768).margin(digits));
  CHECK(r.move(2).target.joints[2] == Approx(0.60206).margin(digits));
  CHECK(r.move(3).target.joints == std::vector<double>{10, 40, 90, 11, 11, 7});
  CHECK(r.move(4).target.joints == std::vector<double>{1, 2, 3, 2, 3, 4});
  CHECK((r.move(5).target.pose.position - Vector3(4, 5, 6)).norm() < rounding);
  CHECK((turn(5) - Vector3(pi / 2, 0, 0)).norm() < rounding);
  // t as seen from f: -90 deg about z after 90 deg about x. x of t is -y of f, z of t is -y of the base and -x of f.
  CHECK((r.move(6).target.pose.orientation * Vector3::UnitX() + Vector3::UnitY()).norm() < rounding);
  CHECK((r.move(6).target.pose.orientation * Vector3::UnitZ() + Vector3::UnitX()).norm() < rounding);
}

TEST_CASE("urscript: the pose after a move to joint angles is that of the job's robot with its tool") {
  ImportOptions on_robot;
  on_robot.flange = [](const std::array<double, 6>& q) { return Frame{{q[0], q[1], 1}, rotation({0, 0, pi / 2})}; };
  const std::string lines =
      "movej([0.5,0.25,0,0,0,0])\nmovel(pose_trans(get_actual_tcp_pose(), p[0.1,0,0.2,0,0,0]))\n"
      "place = get_forward_kin([0.3,0.4,0,0,0,0])\nplace[2] = place[2] + 1\nmovel(place)\n";
  const Reading r = program(lines, on_robot);
  REQUIRE(r.problem() == "no such problem");
  // The flange's x is the base's y, and the tool is 0.1 m long.
  CHECK((r.move(1).target.pose.position - Vector3(0.5, 0.35, 1.3)).norm() < rounding);
  CHECK((r.move(2).target.pose.position - Vector3(0.3, 0.4, 2.1)).norm() < rounding);
  CHECK(program(lines).problem().find("'get_actual_tcp_pose()'") != std::string::npos);
  CHECK(program("movel(get_forward_kin([0,0,0,0,0,0], tcp=p[0,0,1,0,0,0]))\n", on_robot)
            .problem()
            .find("the forward kinematics of another tool") != std::string::npos);
}

TEST_CASE("urscript: functions, their variables and loops run as on the controller") {
  const std::string functions = "def go" + go + "def twice(x):\n  local n = x\n  m = n + n\n  n = m\n  return n\nend\n";
  const Reading r = run(
      functions +
      "n = 1\ni = 0\nwhile i < 5:\n  i = i + 1\n  if i == 2 or i == 3:\n    continue\n  elif not i < 5:\n    break\n"
      "  end\n  go(i + twice(n))\nend\nl = [7, 8, 9]\ngo(l[2] % 4)\nl[0] = -1\ngo(l[0])\ngo(get_list_length(l))\n");
  REQUIRE(r.problem() == "no such problem");
  // twice() has its own variables n and m.
  CHECK(first_axes(r) == std::vector<double>{3, 6, 1, -1, 3});
  const Reading beyond = run("l = [1,2]\nmovej([l[2],0,0,0,0,0])\n");
  CHECK(beyond.problem().find("has the index 2 of a list of 2") != std::string::npos);
  const Reading nested =
      run("def main():\n  global speed = 1\n  def faster():\n    speed = speed + 1\n  end\n  faster()\n  faster()\n"
          "  movej([speed,0,0,0,0,0])\n  halt\n  movej([9,0,0,0,0,0])\nend\n");
  CHECK(first_axes(nested) == std::vector<double>{3});
  const Reading own =
      run("def main():\n  speed = 1\n  def faster():\n    speed = 5\n  end\n  faster()\n"
          "  movej([speed,0,0,0,0,0])\nend\n");
  CHECK(first_axes(own) == std::vector<double>{5});  // the program's variables are global
  const Reading hidden =
      run("def main():\n  speed = 1\n  def faster():\n    local speed = 5\n  end\n  faster()\n"
          "  movej([speed,0,0,0,0,0])\nend\n");
  CHECK(first_axes(hidden) == std::vector<double>{1});
  const Reading cycle =
      run("def main():\n  k = 0\n  while True:\n    k = (k + 1) % 3\n    movej([k,0,0,0,0,0])\n  end\nend\n");
  CHECK(first_axes(cycle) == std::vector<double>{1, 2, 0});
}

TEST_CASE("urscript: arguments may be left out or named, and a line may hold several statements") {
  const Reading r = run(
      "def turn(a, b=0.5, slow=False):\nif slow: movej([a,b,0,0,0,0], v=0.1)\nelse: movej([a,b,0,0,0,0], v=1) end\nend\n"
      "def main():\nw = 0.1\nturn(w) w = -w\nturn(w, 2)\nturn(w, slow=True, b=3) turn(4)\nend\n");
  REQUIRE(r.problem() == "no such problem");
  REQUIRE(r.program.instructions.size() == 4);
  const double expected[4][3] = {{0.1, 0.5, 1}, {-0.1, 2, 1}, {-0.1, 3, 0.1}, {4, 0.5, 1}};
  for (std::size_t k = 0; k < 4; ++k) {
    CHECK(r.move(k).target.joints[0] == expected[k][0]);
    CHECK(r.move(k).target.joints[1] == expected[k][1]);
    CHECK(r.move(k).speed.axis.value() == expected[k][2]);
  }
}

TEST_CASE("urscript: inputs are asked for by their calls, threads are named") {
  const std::string text =
      "if get_standard_digital_in(2) == True:\nmovej([1,0,0,0,0,0])\nelse:\nmovej([2,0,0,0,0,0])\nend\n";
  const Reading asked = run(text);
  REQUIRE(asked.problems.size() == 1);
  CHECK(asked.problem().find("'get_standard_digital_in(2)' is known only while the robot runs") != std::string::npos);
  CHECK(asked.problem().find("{name: 'get_standard_digital_in(2)', value: VALUE}") != std::string::npos);
  CHECK(first_axes(run(text, given({{"get_standard_digital_in(2)", "True"}}))) == std::vector<double>{1});
  const Reading place = run("movel(get_inverse_kin(camera_pose()))\n");
  CHECK(place.problem().find("'camera_pose()'") != std::string::npos);
  const std::string threads =
      "def main():\n  global count = 0\n  thread step():\n    while True:\n      count = count + 1\n      sync()\n"
      "    end\n  end\n  run step()\n  movej([0.5,0,0,0,0,0])\n  if count > 3:\n    movej([1,0,0,0,0,0])\n  end\nend\n";
  const Reading beside = run(threads);
  CHECK(beside.problem().find("may be written by the thread step, which runs beside") != std::string::npos);
  CHECK(first_axes(run(threads, given({{"count", "9"}}))) == std::vector<double>{0.5, 1});
  for (const char* handle : {"", "h = "})
    CHECK(skips(run(fmt::format("def main():\n  thread wave():\n    movej([3,0,0,0,0,0])\n  end\n  {}run wave()\n"
                                "  movej([1,0,0,0,0,0])\nend\n",
                                handle)),
                "thread wave: runs beside the program, and is left out", true));
  ImportOptions alone;
  alone.routine = "wave";
  CHECK(
      first_axes(run(
          "def main():\n  thread wave():\n    movej([3,0,0,0,0,0])\n  end\n  run wave()\n  movej([1,0,0,0,0,0])\nend\n",
          alone)) == std::vector<double>{3});
}

TEST_CASE("urscript: what is missing or not read is reported with its place") {
  CHECK(
      run("movel(p[1,2,3,0,0,0])\n").problem().find("s.script:1:1: error: moves the tool, and no set_tcp before it") !=
      std::string::npos);
  Reader with{Language::urscript};
  with.tools = {{"tcp", {Vector3(0, 0, 0.2), Quaternion::Identity()}, false}};
  CHECK(with({{"s.script", "movel(p[1,2,3,0,0,0])\n"}}).problem() == "no such problem");
  CHECK(run("movej([1,2,3,0,0,0],v=0)\n").problem().find("has a speed of 0") != std::string::npos);
  CHECK(run("movej([1,2])\n").problem().find("neither a pose nor a list of joint angles") != std::string::npos);
  CHECK(run("movej(nowhere)\n").problem().find("'nowhere' is a name that no file read declares") != std::string::npos);
  CHECK(run("def a():\nmovej([1,0,0,0,0,0])\nend\ndef b():\nmovej([2,0,0,0,0,0])\nend\n")
            .problem()
            .find("holds several functions, and none that calls them") != std::string::npos);
  CHECK(run("while True:\nmovej([1,0,0,0,0,0])\n").problem().find("before END") != std::string::npos);
  const Reading led =
      run("movej([1,0,0,0,0,0])\nspeedl([0,0,0.1,0,0,0],0.5,1)\nurcap_grip(1)\ntextmsg(\"a\")\nsync()\n");
  REQUIRE(led.problem() == "no such problem");
  CHECK(skips(led, "speedl: leads the robot in a way that is not followed", true));
  CHECK(skips(led, "urcap_grip: not a routine of the files read", true));
  CHECK(skips(led, "textmsg: input, output or logic", false));
}

TEST_CASE("urscript: the case of names counts, that of the language's own words does not") {
  const Reading read =
      run("P = p[0.1,0.2,0.3,0,3.14,0]\nCount = 1\ncount = 2\ndef Movej(x):\n  movej([x,0,0,0,0,0])\nend\nif True and "
          "(TRUE):\n  Movej(Count)\n  Movej(count)\nend\nset_tcp(p[0,0,0.1,0,0,0])\nmovel(P)\n");
  REQUIRE(read.problem() == "no such problem");
  CHECK(first_axes(read).size() >= 2);
  CHECK(read.move(0).target.joints[0] == 1);
  CHECK(read.move(1).target.joints[0] == 2);
  CHECK(read.move(2).target.pose.position.x() == Approx(0.1));
  // A question names the spelling by its number.
  const Reading asked =
      run("Go = read_port_bit(1)\ngo = 1\nif Go:\n  movej([1,0,0,0,0,0])\nend\nmovej([go,0,0,0,0,0])\n");
  REQUIRE(asked.problems.size() == 1);
  CHECK(asked.problems[0].what.find("read_port_bit(1)") != std::string::npos);
}

TEST_CASE(
    "urscript: functions in a function, as PolyScope writes them, share its variables, the outer one is the program") {
  const std::string text =
      "def cell():\n  started = False\n  count = 0\n  thread watch():\n    started = True\n  end\n  def unused():\n    return 1\n"
      "  end\n  def next():\n    count = count + 1\n    i = 9\n    return count\n  end\n  run watch()\n  while not started:\n"
      "    sync()\n  end\n  i = 4\n  movej([next(),0,0,0,0,0])\n  movej([next(),0,0,0,0,i])\nend\n";
  const Reading read = run(text);
  REQUIRE(read.problem() == "no such problem");
  CHECK(first_axes(read) == std::vector<double>{1, 2});
  CHECK(read.move(1).target.joints[5] == 9);  // the inner function writes to the variable of the outer function
  std::string own = text;
  own.replace(own.find("    i = 9"), 9, "    local i = 9");
  CHECK(run(own).move(1).target.joints[5] == 4);
}
