#include "sim/run/clamp_path.h"
#include "pipeline/base/constants.h"
#include "pipeline/job/job.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::sim {
namespace {

/// Some tens of roundings of numbers near 1.
constexpr double rounding = 1e-13;

const std::string unit_pose = ",0,0,0,1,0,0,0";

std::string row(double time, const std::string& base = unit_pose, const std::string& tool = unit_pose) {
  return fmt::format("{}{}{}\n", time, base, tool);
}

/// Returns the error's message without the name of the folder.
std::string message_of(const std::string& name, const std::string& text) {
  const pipeline::Scratch scratch;
  const std::string message = pipeline::message_of([&] { RecordedPath(scratch.write(name, text)); });
  const std::string folder = scratch.folder().string() + "/";
  REQUIRE(message.starts_with(folder));
  return message.substr(folder.size());
}

TEST_CASE("clamp path: recorded poses are met at their rows and turn smoothly between") {
  std::string text = "t,x,y,z,qw,qx,qy,qz,x,y,z,qw,qx,qy,qz\n# a turn about z at 1 rad/s, signs as they come\n";
  for (int k = 0; k <= 80; ++k) {
    const double t = 0.1 * k;
    Quaternion q(Eigen::AngleAxisd(t, Vector3::UnitZ()));
    if (q.w() < 0) q.coeffs() = -q.coeffs();  // the sign that many programs write
    text += fmt::format("{}, {},0,0,1,0,0,0, 1,0,{},{},{},{},{}\r\n", t, std::sin(t), std::cos(t), q.w(), q.x(), q.y(),
                        q.z());
  }
  const pipeline::Scratch scratch;
  const RecordedPath path(scratch.write("turn.csv", text));
  CHECK(path.duration() == Approx(8));
  CHECK(path.step_texts() == std::vector<std::string>{"clamp poses of turn.csv"});
  // Spline error of sin(t) with step 0.1: 5/384 h^4 = 1.3e-6 inside, several times larger in the end intervals.
  constexpr double spline_error = 1e-5;
  Quaternion before = path.at(0).clamps.tool.orientation;
  for (double t = 0; t <= 8; t += 0.013) {
    const Pose pose = path.at(t);
    CHECK(std::abs(pose.clamps.base.position.x() - std::sin(t)) < spline_error);
    CHECK(std::abs(pose.clamps.tool.position.z() - std::cos(t)) < spline_error);
    const Quaternion& q = pose.clamps.tool.orientation;
    CHECK(rotation_vector(q.conjugate() * Quaternion(Eigen::AngleAxisd(t, Vector3::UnitZ()))).norm() < spline_error);
    CHECK(q.dot(before) > 0.999);  // no jump of sign
    CHECK(std::abs(q.norm() - 1) < rounding);
    before = q;
  }
}

TEST_CASE("clamp path: a bad cell is named by line and column") {
  CHECK(message_of("a.csv", row(0) + "0.1,0,0,zero,1,0,0,0" + unit_pose + "\n") ==
        "a.csv:2:9: error: 'zero' is not a finite number (z of the base clamp); write a "
        "decimal "
        "number");
  CHECK(message_of("b.csv", row(0) + row(0.1, ",0, nan,0,1,0,0,0")) ==
        "b.csv:2:8: error: 'nan' is not a finite number (y of the base clamp); write a "
        "decimal "
        "number");
  CHECK(message_of("c.csv", row(0, ",,0,0,1,0,0,0")) ==
        "c.csv:1:3: error: '' is not a finite number (x of the base clamp); write a "
        "decimal "
        "number");
  CHECK(message_of("d.csv", "t,x,y\n" + row(0) + "1,2,3\n") ==
        "d.csv:3:5: error: row has 3 cells (must be 15, separated by commas); write t, "
        "then x y z "
        "qw qx qy qz of the base clamp and of the tool clamp");
  CHECK(message_of("e.csv", row(0) + "#\n\n" + row(0.5) + row(0.5)) ==
        "e.csv:5:1: error: time 0.5 s does not follow 0.5 s (must increase); sort the "
        "rows and "
        "drop repeated ones");
  CHECK(message_of("f.csv", row(1)) == "f.csv:1:1: error: first time is 1 s (must be 0); subtract it from every row");
  CHECK(message_of("g.csv", row(0, unit_pose, ",0,0,0,0.9,0,0,0")) ==
        "g.csv:1:23: error: quaternion has length 0.9 (must be 1 within 0.001); write a "
        "unit "
        "quaternion, w first");
  CHECK(message_of("h.csv", row(0) + row(1, ",0,0,0,0,0,0,1")) ==
        "h.csv:2:9: error: clamp turns by 180.0 deg from the row before (more than 120: "
        "which way "
        "is not clear); write rows closer in time");
  CHECK(message_of("i.csv", "t,x\n\n") == "i.csv:2: error: clamp_poses holds no row; write t and 14 numbers per row");
}

TEST_CASE("clamp path: a file that is not there is named") {
  CHECK_THROWS_WITH(RecordedPath("no/such.csv"),
                    "no/such.csv: error: cannot be read (No such file or directory); check the path");
}

TEST_CASE("clamp path: a clamp's frame has z along the hose and x toward the link's z") {
  pipeline::Clamp clamp;
  clamp.position = {1, 2, 3};
  clamp.direction = {2, 0, 0};
  Matrix3 expected;
  expected << 0, 0, 1, 0, -1, 0, 1, 0, 0;  // columns x = link z, y, z = link x
  CHECK((clamp_frame(clamp).orientation.toRotationMatrix() - expected).norm() < rounding);
  CHECK(clamp_frame(clamp).position == clamp.position);
  clamp.direction = {0, 0, -1};  // along the link's z: then x is toward the link's x
  CHECK((clamp_frame(clamp).orientation * Vector3::UnitX() - Vector3::UnitX()).norm() < rounding);
  clamp.roll = pi / 2;  // right-handed about -z
  CHECK((clamp_frame(clamp).orientation * Vector3::UnitX() + Vector3::UnitY()).norm() < rounding);
  CHECK((clamp_frame(clamp).orientation * Vector3::UnitZ() + Vector3::UnitZ()).norm() < rounding);
}

/// A job with one joint about z at the origin, the base clamp on the base and the tool clamp on the turning link.
pipeline::Job turning_job() {
  pipeline::Job job;
  job.robot.name = "turntable";
  pipeline::Joint joint;
  joint.name = "table";
  joint.lower = -20;
  joint.upper = 20;
  joint.speed = 2;
  joint.acceleration = 4;
  job.robot.joints = {joint};
  job.robot.links = {{"base", {}}, {"table", {}}};
  for (const double angle : {0.0, 5 * pi}) {
    pipeline::MotionStep step;
    step.joints = {angle};
    job.motion.steps.push_back(step);
  }
  job.dresspacks[0].routing.base_clamp = pipeline::Clamp{"base", {0, 0, 1}, {0, 0, 1}, {}, {"job.yaml", 8, 3}};
  job.dresspacks[0].routing.tool_clamp = pipeline::Clamp{"table", {1, 0, 2}, {1, 0, 0}, 0.25, {"job.yaml", 9, 3}};
  return job;
}

TEST_CASE("clamp path: the joint that is held is the named one, also behind a joint that follows another") {
  pipeline::Job job = turning_job();
  std::vector<pipeline::Joint> joints(4, job.robot.joints[0]);
  joints[1].name = "rod", joints[2].name = "arm", joints[3].name = "hand";
  joints[1].follows = "table";
  job.robot.joints = joints;
  job.robot.links = {{"base", {}}, {"table", {}}, {"rod", {}}, {"arm", {}}, {"hand", {}}};
  job.motion.steps[0].joints = {0, 0, 0};
  job.motion.steps[1].joints = {1, 1, 1};
  job.motion.hold_joint = "arm";
  const RobotPath path(job);
  CHECK(path.at(0).joints == Eigen::Vector3d(0, 0.5, 0));
  CHECK((path.at(path.duration()).joints - Eigen::Vector3d(1, 0.5, 1)).norm() < rounding);
}

TEST_CASE("clamp path: the tool clamp goes round with its link for more than two turns without a jump") {
  const RobotPath path(turning_job());
  CHECK(path.end_links() == std::vector<int>{0, 1});
  Quaternion before = path.at(0).clamps.tool.orientation;
  for (double t = 0; t <= path.duration(); t += 0.01) {
    const Pose pose = path.at(t);
    const double angle = pose.joints[0];
    CHECK((pose.clamps.tool.position - Vector3(std::cos(angle), std::sin(angle), 2)).norm() < rounding);
    CHECK((tangent(pose.clamps.tool.orientation) - Vector3(std::cos(angle), std::sin(angle), 0)).norm() < rounding);
    CHECK(pose.clamps.tool.orientation.dot(before) > 0.9999);
    CHECK(pose.clamps.base.position == Vector3(0, 0, 1));
    before = pose.clamps.tool.orientation;
  }
}

TEST_CASE("clamp path: the tool clamp can be turned about its direction") {
  RobotPath path(turning_job());
  const Quaternion before = path.at(0).clamps.tool.orientation;
  path.turn_clamp(1, 0.5);
  const Vector3 turn = rotation_vector(before.conjugate() * path.at(0).clamps.tool.orientation);
  CHECK((turn - Vector3(0, 0, 0.5)).norm() < rounding);
}

TEST_CASE("clamp path: the pose of mounting is the first waypoint or what the routing says") {
  pipeline::Job job = turning_job();
  CHECK(RobotPath(job).mounting_pose()[0] == 0);
  job.dresspacks[0].routing.mounting_pose = {1.5};
  CHECK(RobotPath(job).mounting_pose()[0] == 1.5);
  job.dresspacks[0].routing.mounting_pose = {30};
  job.dresspacks[0].routing.where = {"job.yaml", 7, 1};
  CHECK_THROWS_WITH(RobotPath(job),
                    "job.yaml:7:1: error: routing.mounting_pose_deg turns table to 1718.87 deg (must be within "
                    "-1145.92 .. 1145.92 deg); turn it 573 deg less, inside the limits of turntable");
}

TEST_CASE("clamp path: external axes that the motion moves and the robot does not have are named") {
  pipeline::Job job = turning_job();
  CHECK(RobotPath(job).doubts().empty());
  for (pipeline::MotionStep& step : job.motion.steps) step.external_axes = {7, 100};
  CHECK(RobotPath(job).doubts().empty());  // the external axes are at rest
  job.motion.steps.back().external_axes = {7, 600};
  const auto named = RobotPath(job).doubts();
  REQUIRE(named.size() == 1);
  CHECK(named[0].words.find("moves external axis 2 from 100 to 600 (mm or deg)") != std::string::npos);
  pipeline::ExternalAxis still, track;
  still.name = "turntable", track.name = "track";
  still.lower = track.lower = -1, still.upper = track.upper = 1;
  still.speed = track.speed = still.acceleration = track.acceleration = 1;
  job.robot.external_axes = {still, track};
  CHECK(RobotPath(job).doubts().empty());
}

TEST_CASE("clamp path: times that an axis cannot keep are named, the worst with axis, time, speed and limit") {
  pipeline::Job job = turning_job();  // 2 rad/s = 114.6 deg/s
  const auto doubts = [&](const std::vector<double>& angles) {
    pipeline::MotionStep step = job.motion.steps[0];
    job.motion.steps = {step};
    for (const double angle : angles) {
      step.joints = {angle};
      step.duration = 0.5;
      step.where = {"log.csv", static_cast<int>(job.motion.steps.size()) + 2, 1};
      job.motion.steps.push_back(step);
    }
    return RobotPath(job).doubts();
  };
  CHECK(doubts({1, 2, 1}).empty());  // at the limit
  const auto named = doubts({1.2, 0, 1.5});
  REQUIRE(named.size() == 1);
  CHECK(named[0].where == "log.csv:5:1");
  CHECK(named[0].words.starts_with(
      "table is to move at 171.9 deg/s up to 1.5 s (limit 114.6 deg/s), and 2 further steps are too "
      "fast: the robot takes longer"));
  CHECK(named[0].words.find("Remedy: ") != std::string::npos);
}

TEST_CASE("clamp path: a program of another maker that the robot cannot follow is named beside the error") {
  const pipeline::Scratch scratch;
  const auto program = scratch.write("far.src", "DEF far()\nPTP {A1 0,A2 0,A3 0,A4 0,A5 0,A6 0}\nEND\n");
  pipeline::Job job = turning_job();
  job.motion = {};
  job.motion.program = program;
  const auto words = [&](const std::string& robot) {
    job.robot.name = robot;
    return pipeline::message_of([&] { RobotPath{job}; });
  };
  CHECK(words("KUKA KR 16").find("error: ") != std::string::npos);
  CHECK(words("KUKA KR 16").find("is one of KUKA") == std::string::npos);
  CHECK(words("Fanuc M-20iA").find("is one of KUKA, and the robot is Fanuc M-20iA") != std::string::npos);
}

TEST_CASE("clamp path: a clamp on no link is named") {
  pipeline::Job job = turning_job();
  job.dresspacks[0].routing.tool_clamp->link = "tabel";
  CHECK_THROWS_WITH(RobotPath(job), "job.yaml:9:3: error: turntable has no link 'tabel'; use one of base, table");
}

}  // namespace
}  // namespace dresslife::sim
