#include "pipeline/urdf/urdf.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/base/constants.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/settings/fields.h"
#include "tests/catch.h"
#include "tests/pipeline/sample_job.h"
#include "tests/pipeline/scratch.h"
#include "tests/sim/program/samples.h"

namespace dresslife::pipeline {

void describe(Fields& f, Robot& robot);

namespace {

using tests::palletizer;

constexpr double rounding = 1e-12;  // a few products of numbers about 1

UrdfRequest request(const std::string& file = "palletizer.urdf") {
  UrdfRequest made;
  made.urdf = file;
  made.accelerations = {1, 2, 3, 4};
  return made;
}

Robot robot_of(const std::string& text, UrdfRequest asked = request()) {
  Robot robot;
  read_fields(robot_from_urdf(asked, text), robot);
  return robot;
}

std::string line_of(const std::string& text, const std::string& needle) {
  const auto end = text.begin() + static_cast<long>(text.find(needle));
  return std::to_string(1 + std::count(text.begin(), end, '\n'));
}

std::string changed(const std::string& from, const std::string& to) { return edited(palletizer, from, to); }

}  // namespace

TEST_CASE("urdf: the chain from root to tip becomes joints and links and what is fixed goes with its carrier") {
  const Robot robot = robot_of(palletizer);
  CHECK(robot.name == "palletizer");
  REQUIRE(robot.joints.size() == 5);
  CHECK(robot.axes() == 4);
  REQUIRE(robot.links.size() == 6);
  CHECK(robot.links[0].name == "floor");
  CHECK(robot.links[4].name == "wrist");
  // The stand's 0.3 m are included in the first joint's origin and in the base's box.
  CHECK((robot.joints[0].origin - Vector3d(0, 0, 0.8)).norm() < rounding);
  REQUIRE(robot.links[0].boxes.size() == 1);
  CHECK((robot.links[0].boxes[0].position - Vector3d(0, 0, 0.4)).norm() < rounding);
  CHECK((robot.links[0].boxes[0].sides - Vector3d(0.4, 0.5, 0.2)).norm() < rounding);
  // The rail turns by 90 deg about z: -0.7 m along its y are 0.7 m along the forearm's x.
  CHECK((robot.joints[3].origin - Vector3d(0.3 + 0.7, 0, 0)).norm() < rounding);
  CHECK((robot.joints[3].orientation - Vector3d(0, 0, 90 * degree)).norm() < rounding);
  REQUIRE(robot.links[3].capsules.size() == 1);  // the bracket's sphere on the forearm
  CHECK((robot.links[3].capsules[0].from - Vector3d(0.3, 0, 0.1)).norm() < rounding);
  CHECK(robot.links[3].capsules[0].to == robot.links[3].capsules[0].from);
  CHECK(robot.links[3].capsules[0].radius == Approx(0.05));
  CHECK((robot.flange_position - Vector3d(0, 0, -0.05)).norm() < rounding);
  for (const Link& link : robot.links)
    CHECK(link.boxes.size() != 2);  // the finger moves independently, so it is left out
}

TEST_CASE("urdf: limits and a joint that mimics another") {
  const Robot robot = robot_of(palletizer);
  CHECK(robot.joints[0].upper == Approx(200 * std::numbers::pi));  // continuous: 100 turns
  const Joint& level = robot.joints[3];
  CHECK(level.follows == "j2");
  CHECK(level.ratio == -1);
  CHECK(level.offset == Approx(0.1));
  // level = 0.1 - j2 within -3 .. 0.8 limits j2 to -0.7 .. 3.1; j2's own limits are -1 .. 1.5.
  CHECK(robot.joints[1].lower == Approx(-0.7));
  CHECK(robot.joints[1].upper == Approx(1.5));
  CHECK(robot.joints[4].acceleration == Approx(4));
  CHECK(robot.joints[4].speed == Approx(6));
}

TEST_CASE("urdf: a joint that mimics another by a factor bounds its range and its speed by that factor") {
  for (const double ratio : {-0.5, 0.5}) {
    const std::string slower = edited(changed("multiplier=\"-1\"", fmt::format("multiplier=\"{}\"", ratio)),
                                      "lower=\"-3\" upper=\"0.8\" effort=\"0\" velocity=\"9\"",
                                      "lower=\"-0.3\" upper=\"0.5\" effort=\"0\" velocity=\"0.6\"");
    const Robot robot = robot_of(slower);
    CHECK(robot.joints[3].ratio == ratio);
    CHECK(robot.joints[3].offset == Approx(0.1));
    // level = 0.1 + ratio j2 within -0.3 .. 0.5.
    CHECK(robot.joints[1].lower == Approx(-0.8));
    CHECK(robot.joints[1].upper == Approx(0.8));
    CHECK(robot.joints[1].speed == Approx(1.2));
  }
}

TEST_CASE("urdf: a joint that follows with factor 0 keeps its place and bounds nothing") {
  // level stays at 0.1, outside its own range, at every angle of j2.
  const Robot robot = robot_of(edited(changed("multiplier=\"-1\"", "multiplier=\"0\""), "lower=\"-3\" upper=\"0.8\"",
                                      "lower=\"0.5\" upper=\"0.8\""));
  CHECK(robot.joints[3].ratio == 0);
  CHECK(robot.joints[3].offset == Approx(0.1));
  CHECK(robot.joints[1].lower == Approx(-1));
  CHECK(robot.joints[1].upper == Approx(1.5));
}

TEST_CASE("urdf: an element in a comment does not count, also where it ends the comment") {
  CHECK(robot_of(changed("<link name=\"turret\"/>", "<!-- <a>--><link name=\"turret\"/>")).joints.size() == 5);
}

TEST_CASE("urdf: turns of fixed joints are kept as three angles, also at a right angle") {
  for (const Vector3d& angles : {Vector3d(0.3, 0.4, 0.5), Vector3d(-2, 1, 3), Vector3d(0.3, std::numbers::pi / 2, 0.5),
                                 Vector3d(1, -std::numbers::pi / 2, 0)}) {
    const Robot robot =
        robot_of(changed("<origin xyz=\"0 0 0.3\"/>",
                         fmt::format("<origin xyz=\"0 0 0.3\" rpy=\"{} {} {}\"/>", angles[0], angles[1], angles[2])));
    const Eigen::Matrix3d wanted = from_roll_pitch_yaw(angles).toRotationMatrix();
    constexpr double written = 1e-9;  // of angles as texts in degrees
    CHECK((from_roll_pitch_yaw(robot.joints[0].orientation).toRotationMatrix() - wanted).norm() < written);
    CHECK((from_roll_pitch_yaw(robot.links[0].boxes[0].orientation).toRotationMatrix() - wanted).norm() < written);
    CHECK((robot.joints[0].origin - wanted * Vector3d(0, 0, 0.5) - Vector3d(0, 0, 0.3)).norm() < written);
    if (std::abs(angles[1]) < 1.5) CHECK((robot.joints[0].orientation - angles).norm() < written);
  }
}

TEST_CASE("urdf: a cylinder is a capsule and an octagon inside it") {
  const Robot robot = robot_of(palletizer);
  const Link& arm = robot.links[2];
  REQUIRE(arm.capsules.size() == 1);
  CHECK((arm.capsules[0].from - Vector3d(0, 0, 0.1)).norm() < rounding);
  CHECK((arm.capsules[0].to - Vector3d(0, 0, 0.9)).norm() < rounding);
  REQUIRE(arm.boxes.size() == 4);
  for (const Box& box : arm.boxes) {
    CHECK(box.sides.z() == Approx(1));
    CHECK(std::hypot(box.sides.x(), box.sides.y()) == Approx(0.2));  // the box's corners lie on the cylinder
    CHECK((box.position - Vector3d(0, 0, 0.5)).norm() < rounding);
  }
  const Robot flat = robot_of(changed("length=\"1\" radius=\"0.1\"", "length=\"0.1\" radius=\"0.1\""));
  CHECK(flat.links[2].capsules.empty());
  CHECK(flat.links[2].boxes.size() == 4);
  UrdfRequest bare = request();
  bare.collision = UrdfRequest::Collision::drop;
  for (const Link& link : robot_of(palletizer, bare).links) CHECK(link.capsules.size() + link.boxes.size() == 0);
}

TEST_CASE("urdf: a joint without <axis> turns about x, the default of the specification") {
  const std::string given = "<origin xyz=\"0 0 1\"/>\n    <axis xyz=\"0 1 0\"/>";
  const auto axis_of = [](const std::string& text) {
    const Robot robot = robot_of(text);
    return std::find_if(robot.joints.begin(), robot.joints.end(), [](const Joint& joint) { return joint.name == "j3"; })
        ->axis;
  };
  CHECK(axis_of(palletizer) == Vector3d::UnitY());
  CHECK(axis_of(changed(given, "<origin xyz=\"0 0 1\"/>")) == Vector3d::UnitX());
}

TEST_CASE("urdf: a base that slides is an external axis under the robot") {
  const std::string on_track = changed("<joint name=\"stand\" type=\"fixed\">",
                                       "<joint name=\"stand\" type=\"prismatic\"><axis xyz=\"1 0 0\"/>"
                                       "<limit lower=\"-2\" upper=\"3\" effort=\"0\" velocity=\"1.2\"/>");
  UrdfRequest asked = request();
  Node tree = robot_from_urdf(asked, on_track);
  tree["external_axes"].items[0]["acceleration_mm_per_s2"] = scalar("1500");
  Robot robot;
  read_fields(tree, robot);
  REQUIRE(robot.external_axes.size() == 1);
  CHECK(robot.external_axes[0].upper == Approx(3));
  CHECK(robot.external_axes[0].speed == Approx(1.2));
  CHECK((robot.external_axes[0].origin - Vector3d(0, 0, 0.3)).norm() < rounding);
  CHECK((robot.joints[0].origin - Vector3d(0, 0, 0.5)).norm() < rounding);
  CHECK(robot.links[0].name == "base_link");
  CHECK(robot.fixed_links.empty());  // the floor has no shape
}

TEST_CASE("urdf: shapes before a track stand still in the world, and those between two tracks are named") {
  const std::string slide =
      "type=\"prismatic\"><axis xyz=\"1 0 0\"/><limit lower=\"-2\" upper=\"3\" effort=\"0\" velocity=\"1\"/>";
  const std::string shape =
      "<collision><origin xyz=\"0 1 0\"/><geometry><box size=\"6 0.4 0.2\"/></geometry></collision>";
  const std::string stand = "<joint name=\"stand\" type=\"fixed\">";
  const std::string bed = "<link name=\"world\"/><link name=\"bed\">" + shape +
                          "</link><joint name=\"feet\" type=\"fixed\"><origin xyz=\"0 0 0.7\"/><parent link=\"world\"/>"
                          "<child link=\"bed\"/></joint>";
  const auto on = [&](const std::string& joints) {
    return edited(changed(stand, "<joint name=\"stand\" " + slide), "<link name=\"floor\"/>",
                  "<link name=\"floor\"/>" + bed + joints);
  };
  const auto joint = [](const std::string& kind) {
    return "<joint name=\"on\" " + kind + "<parent link=\"bed\"/><child link=\"floor\"/></joint>";
  };
  Node tree = robot_from_urdf(request(), on(joint("type=\"fixed\">")));
  REQUIRE(tree.find("fixed_links"));
  REQUIRE(tree.find("fixed_links")->items.size() == 1);
  Link world;
  read_fields(tree.find("fixed_links")->items[0], world);
  CHECK(world.name == "world");
  REQUIRE(world.boxes.size() == 1);
  CHECK((world.boxes[0].position - Vector3d(0, 1, 0.7)).norm() < rounding);
  CHECK(!tree.find("links_left_out"));
  const std::string bridge =
      edited(on(joint(slide)), "<link name=\"floor\"/>", "<link name=\"floor\">" + shape + "</link>");
  tree = robot_from_urdf(request(), bridge);
  CHECK(tree.find("external_axes")->items.size() == 2);
  CHECK(tree.find("fixed_links")->items.size() == 1);
  REQUIRE(tree.find("links_left_out"));
  CHECK(tree.find("links_left_out")->text == "floor");
}

TEST_CASE("urdf: meshes are found beside the file and in their packages") {
  const Scratch scratch;
  const std::string stl = "solid s\nendsolid s\n";
  scratch.write("cell/arm_support/urdf/arm.urdf", "");
  scratch.write("cell/arm_support/urdf/plain.STL", stl);
  scratch.write("cell/arm_support/meshes/upper.stl", stl);
  const auto with_mesh = [&](const std::string& mesh) {
    return changed("<box size=\"0.4 0.5 0.2\"/>", "<mesh filename=\"" + mesh + "\" scale=\"0.001 0.001 0.001\"/>");
  };
  const UrdfRequest asked = request((scratch / "cell/arm_support/urdf/arm.urdf").string());
  const Robot packaged = robot_of(with_mesh("package://arm_support/meshes/upper.stl"), asked);
  REQUIRE(packaged.links[0].meshes.size() == 1);
  CHECK(packaged.links[0].meshes[0].file == scratch / "cell/arm_support/meshes/upper.stl");
  CHECK(packaged.links[0].meshes[0].scale == Approx(0.001));
  CHECK((packaged.links[0].meshes[0].position - Vector3d(0, 0, 0.4)).norm() < rounding);
  CHECK(robot_of(with_mesh("plain.STL"), asked).links[0].meshes[0].file == scratch / "cell/arm_support/urdf/plain.STL");

  const std::string missing = with_mesh("package://arm_support/meshes/lower.stl");
  CHECK(message_of([&] { robot_of(missing, asked); }) ==
        asked.urdf.string() + ":" + line_of(missing, "<link name=\"base_link\"") +
            ": error: mesh 'package://arm_support/meshes/lower.stl' is not there (looked for " +
            (scratch / "cell/arm_support/arm_support/meshes/lower.stl").string() +
            "); give 'package_folder', or leave the URDF's shapes out with 'collision: drop'");
  scratch.write("elsewhere/arm_support/meshes/lower.stl", stl);
  UrdfRequest told = asked;
  told.package_folder = scratch / "elsewhere";
  CHECK(robot_of(missing, told).links[0].meshes.size() == 1);
  for (const char* uneven : {"0.001 0.0005 0.001", "0.001 0.002 0.001", "0.001 0.001 0.0005", "-0.001 -0.001 -0.001"})
    CHECK_THAT(message_of([&] {
                 robot_of(changed("<box size=\"0.4 0.5 0.2\"/>",
                                  fmt::format("<mesh filename=\"plain.STL\" scale=\"{}\"/>", uneven)),
                          asked);
               }),
               Catch::Contains("mesh 'plain.STL' is scaled by different factors"));
  scratch.write("cell/arm_support/urdf/colour.dae", "");
  CHECK_THAT(message_of([&] { robot_of(with_mesh("colour.dae"), asked); }),
             Catch::Contains("mesh 'colour.dae' is neither STL nor OBJ; convert it"));
}

TEST_CASE("urdf: what is wrong is reported with its line") {
  const auto told = [](const std::string& text, const std::string& needle, const std::string& words,
                       const UrdfRequest& asked) {
    const std::string place = needle.empty() ? "palletizer.urdf" : "palletizer.urdf:" + line_of(text, needle);
    CHECK_THAT(message_of([&] { robot_of(text, asked); }), Catch::StartsWith(place + ": error: " + words));
  };
  const auto refused = [&](const std::string& from, const std::string& to, const std::string& needle,
                           const std::string& words) { told(changed(from, to), needle, words, request()); };
  refused("</collision></link>\n  <link name=\"turret\"/>", "</link>\n  <link name=\"turret\"/>",
          "</link>\n  <link name=\"turret", "</link> closes nothing that is open; correct the XML");
  refused("</robot>", "", "<robot", "<robot> is not closed; correct the XML");
  refused("made-up palletizer -->", "made-up palletizer", "<!--", "a comment is not closed");
  refused("lower=\"-1\" upper=\"1.5\"", "lower=\"abc\" upper=\"1.5\"", "", "is no URDF that can be read (urdfdom: ");
  refused("<limit lower=\"-6\" upper=\"6\" effort=\"0\" velocity=\"6\"/>", "", "<joint name=\"j4\"",
          "is no URDF that can be read (urdfdom: ");
  refused("<mimic joint=\"j2\"", "<mimic joint=\"grip\"", "<joint name=\"level\"",
          "joint 'level' mimics 'grip', which is no axis of the chain; choose another tip");
  refused("<mimic joint=\"j2\"", "<mimic joint=\"level\"", "<joint name=\"level\"",
          "joint 'level' mimics itself, directly or through others; let one joint of the circle mimic none");
  refused("<joint name=\"stand\" type=\"fixed\">",
          "<joint name=\"stand\" type=\"prismatic\"><limit effort=\"0\" velocity=\"1\"/><mimic joint=\"j2\"/>",
          "<joint name=\"stand\"", "joint 'stand' slides and mimics 'j2'");
  refused("<joint name=\"j4\" type=\"revolute\">", "<joint name=\"j4\" type=\"prismatic\">", "<joint name=\"j4\"",
          "joint 'j4' does not turn (only the base may slide); choose another tip");
  refused("lower=\"-6\" upper=\"6\" effort=\"0\" velocity=\"6\"",
          "lower=\"-6\" upper=\"6\" effort=\"0\" velocity=\"0\"", "<joint name=\"j4\"",
          "joints[5].speed_deg_per_s is 0 (must be > 0 deg/s); give the highest speed");
  refused("<link name=\"turret\"/>", "<xacro:arm name=\"turret\"/>", "<xacro:arm",
          "is xacro, from which a URDF is made (<xacro:arm>); run xacro first: xacro palletizer.urdf > robot.urdf");
  refused("rpy=\"0 0 1.5707963267948966\"", "rpy=\"0 0 90\"", "<origin xyz=\"0.3 0 0.1\"",
          "rpy=\"0 0 90\" turns by more than 6.3 rad; write rpy=\"0 0 1.5708\" if those were degrees");
  CHECK_NOTHROW(robot_of(changed("rpy=\"0 0 1.5707963267948966\"", "rpy=\"0 0 -6.2832\"")));
  // Millimetres instead of metres. Only a floor beside the base may be that large.
  refused(
      "<origin xyz=\"0 0 1\"/>\n    <axis", "<origin xyz=\"0 0 -1000\"/>\n    <axis", "<joint name=\"j3\"",
      "the origin of joint 'j3' has 1000 m (at most 10 in a link that moves); write origin xyz=\"0 0 -1\" if those were millimetres");
  refused(
      "length=\"1\" radius=\"0.1\"", "length=\"1000\" radius=\"100\"", "<link name=\"lower_arm\"",
      "a cylinder of link 'lower_arm' has 1000 m (at most 10 in a link that moves); write radius=\"0.1\" length=\"1\" if those were");
  refused("<origin xyz=\"0 0 0.5\"/><geometry>", "<origin xyz=\"0 0 500\"/><geometry>", "<link name=\"lower_arm\"",
          "the origin of a shape of link 'lower_arm' has 500 m");
  refused(
      "<sphere radius=\"0.05\"/>", "<box size=\"180 130 150\"/>", "<link name=\"bracket\"",
      "a box of link 'bracket' has 180 m (at most 10 in a link that moves); write box size=\"0.18 0.13 0.15\" if those were");
  CHECK(robot_of(changed("0.4 0.5 0.2", "40 50 0.2")).links[0].boxes.size() == 1);
  UrdfRequest slow = request();
  slow.accelerations.pop_back();
  told(palletizer, "<joint name=\"j4\"", "joints[5].acceleration_deg_per_s2 is missing", slow);
  UrdfRequest short_tip = request();
  short_tip.tip = "forearm";
  told(palletizer, "", "has 3 axes between its root and its tip (a robot has 4 to 7); choose another tip", short_tip);
  UrdfRequest wrong = request();
  wrong.tip = "nose";
  told(palletizer, "", "has no link 'nose' for the tip; one of: base_link, bracket", wrong);
  const std::string forked = edited(changed("tool0\"/>\n    <origin", "grasp\"/>\n    <origin"),
                                    "<link name=\"tool0\"/>", "<link name=\"grasp\"/><link name=\"camera\"/>");
  const std::string ends =
      edited(edited(forked, "<parent link=\"tool0\"/>", "<parent link=\"grasp\"/>"), "</robot>",
             "<joint name=\"eye\" type=\"fixed\"><parent link=\"hand\"/><child link=\"camera\"/></joint></robot>");
  told(ends, "", "has several ends and none is called tool0 or flange; choose one with 'tip': camera, finger",
       request());
  std::string deep;
  for (int i = 0; i < 60; ++i) deep += "<robot>";
  told(deep, "<robot>", "elements lie more than 50 deep in each other", request());
  std::string crowd = "<robot name=\"crowd\">\n";
  for (int i = 0; i < 2001; ++i) crowd += fmt::format("<link name=\"l{}\"/>\n", i);
  told(crowd + "</robot>", "<link name=\"l2000\"", "has more than 2000 links and joints", request());
}

TEST_CASE("urdf: a small YAML beside it adds what a URDF lacks, by the names of joints and links") {
  const Scratch scratch;
  scratch.write("palletizer.urdf", palletizer);
  scratch.write("robots/mine.yaml",
                "urdf: ../palletizer.urdf\naccelerations_deg_per_s2: [100, 200, 300, 400]\nbase_position_m: [1, 0, 0]\n"
                "joints:\n  - {name: j2, upper_deg: 60}\n"
                "links:\n  - {name: forearm, capsules: [{from_m: [0, 0, 0], to_m: [1, 0, 0], radius_mm: 90}]}\n");
  const auto job_file = scratch.write("job.yaml", "robot: mine\nmotion: {steps: [{joints_deg: [0, 0, 0, 0]}]}\n" +
                                                      sample_job.substr(sample_job.find("dresspack:")));
  const auto with_links = [&](std::vector<std::string> sets = {}) {
    sets.push_back("routing.mounting_pose_deg=[0, 0, 0, 0]");
    for (const char* end : {"base_clamp.link=turret", "tool_clamp.link=hand"})
      sets.push_back(std::string("routing.") + end);
    return read_job(job_file, sets);
  };
  const Job job = with_links();
  CHECK(job.robot.joints[1].upper == Approx(60 * degree));
  CHECK(job.robot.joints[1].lower == Approx(-0.7));
  CHECK(job.robot.joints[1].acceleration == Approx(200 * degree));
  CHECK(job.robot.base_position.x() == 1);
  REQUIRE(job.robot.links[3].capsules.size() == 1);
  CHECK(job.robot.links[3].capsules[0].radius == Approx(0.09));
  CHECK(job.robot.links[2].boxes.size() == 4);
  // The written job reads back to the same job without the URDF.
  CHECK(job_text(job_from(parse_yaml(job_text(job), "echo.yaml"))) == job_text(job));
  CHECK(job_text(with_links({"robot={urdf: " + (scratch / "palletizer.urdf").string() +
                             ", accelerations_deg_per_s2: [1, 1, 1, 1]}"})) != job_text(job));
  const std::string slow = "robot.accelerations_deg_per_s2=[1, 1, 1, 1]";
  for (const std::string& robot : {std::string("robot=mine"), "robot=" + (scratch / "palletizer.urdf").string(),
                                   "robot={urdf: " + (scratch / "palletizer.urdf").string() + "}"})
    CHECK(with_links({robot, slow}).robot.joints[1].acceleration == Approx(1 * degree));
  CHECK_THAT(message_of([&] { with_links({"robot=" + (scratch / "palletizer.urdf").string()}); }),
             Catch::Contains("has no accelerations of j1"));
  const std::string five = (scratch / "palletizer.urdf").string() + ", accelerations_deg_per_s2: [1, 1, 1, 1, 1]}";
  CHECK_THAT(message_of([&] { with_links({"robot={urdf: " + five}); }),
             Catch::Contains("accelerations_deg_per_s2 has 5 numbers (the robot of ") &&
                 Catch::Contains("has 4 axes); give 4 numbers"));
}

}  // namespace dresslife::pipeline
