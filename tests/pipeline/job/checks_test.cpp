// Combinations of entries in a job: every combination of entries that exclude each other.
#include <functional>

#include "pipeline/base/errors.h"
#include "pipeline/job/calibration.h"
#include "pipeline/job/job.h"
#include "pipeline/job/learned_settings.h"
#include "pipeline/job/motion.h"
#include "pipeline/job/plain_part.h"
#include "pipeline/job/robot.h"
#include "pipeline/job/routing.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

using namespace dresslife::pipeline;

namespace {

Robot two_axes() {
  Robot robot;
  robot.joints.resize(2);
  for (const char* name : {"base", "arm", "hand"}) robot.links.emplace_back().name = name;
  return robot;
}

bool is_refused(const std::function<void()>& check) { return !message_of(check).empty(); }

bool is_refused(const MotionStep& step) {
  Motion motion;
  MotionStep start;
  start.joints = {0, 0};
  motion.steps = {start, step};
  return is_refused([&] { check_motion(motion, two_axes()); });
}

MotionStep move() {
  MotionStep step;
  step.joints = {0.1, 0.2};
  return step;
}

Clamp clamp_on(const std::string& link) {
  Clamp clamp;
  clamp.link = link;
  return clamp;
}

}  // namespace

TEST_CASE("checks: a motion has exactly one source and begins with a move") {
  for (int given = 0; given < 32; ++given) {
    Motion motion;
    if (given & 1) motion.steps = {move()};
    if (given & 2) motion.program = "main.mod";
    if (given & 4) motion.clamp_poses = "poses.csv";
    if (given & 8) motion.deformation = "curve.csv";
    if (given & 16) motion.rig.emplace();
    CAPTURE(given);
    CHECK(is_refused([&] { check_motion(motion, two_axes()); }) == (__builtin_popcount(unsigned(given)) != 1));
  }
  Motion rig;
  rig.rig.emplace();
  rig.override_percent = 50, rig.tools.emplace_back().name = "gun", rig.name = "bench", rig.source = "test";
  CHECK_THAT(
      message_of([&] { check_motion(rig, {}); }),
      Catch::Contains("keys beside motion.rig, which moves no robot, have no effect: override_percent, tools; leave"));
  MotionStep dwell;
  dwell.dwell = 1;
  Motion motion;
  motion.steps = {dwell, move()};
  CHECK(is_refused([&] { check_motion(motion, two_axes()); }));
  std::swap(motion.steps[0], motion.steps[1]);
  CHECK_FALSE(is_refused([&] { check_motion(motion, two_axes()); }));
  for (const double length : {0.9985, 0.9995, 1.0005, 1.0015})
    for (const bool tool : {true, false}) {
      Motion with = motion;
      (tool ? with.tools : with.work_objects).emplace_back().quaternion = {0, length, 0, 0};
      CHECK(is_refused([&] { check_motion(with, two_axes()); }) == (std::abs(length - 1) > 1e-3));
    }
}

TEST_CASE("checks: a joint that follows another one cannot be held") {
  Robot robot = two_axes();
  robot.joints[0].name = "lift", robot.joints[1].name = "rod";
  robot.joints[1].follows = "lift";
  Motion motion;
  motion.steps.emplace_back().joints = {0.1};
  motion.hold_joint = "rod";
  CHECK_THAT(message_of([&] { check_motion(motion, robot); }),
             Catch::Contains("hold_joint: 'rod' follows lift and cannot be held alone; name one of lift"));
  motion.hold_joint = "lift";
  CHECK(message_of([&] { check_motion(motion, robot); }).empty());
}

TEST_CASE("checks: of a move's speeds and zones there is at most one of each") {
  for (int given = 0; given < 8; ++given) {
    MotionStep speed = move(), zone = move();
    if (given & 1) speed.speed = 1, zone.zone = 1;
    if (given & 2) speed.speed_percent = 50, zone.tool_zone = 0.1;
    if (given & 4) speed.duration = 2, zone.stop_zone = 50;
    CAPTURE(given);
    CHECK(is_refused(speed) == (__builtin_popcount(unsigned(given)) > 1));
    CHECK(is_refused(zone) == (__builtin_popcount(unsigned(given)) > 1));
  }
  MotionStep dwell;
  dwell.dwell = 1;
  CHECK_FALSE(is_refused(dwell));
  for (std::optional<double> MotionStep::*key :
       {&MotionStep::speed, &MotionStep::speed_percent, &MotionStep::zone, &MotionStep::tool_speed,
        &MotionStep::tool_zone, &MotionStep::stop_zone, &MotionStep::duration, &MotionStep::acceleration,
        &MotionStep::tool_acceleration}) {
    MotionStep with = dwell, moves = move();
    with.*key = 1, moves.*key = 1;
    CHECK(is_refused(with));
    CHECK_FALSE(is_refused(moves));
  }
}

TEST_CASE("checks: a step is a move, a dwell or a block, and a move has one target") {
  for (int given = 0; given < 8; ++given) {
    MotionStep step;
    if (given & 1) step = move();
    if (given & 2) step.dwell = 1;
    if (given & 4) step.repeat = 2, step.steps = {move()};
    CAPTURE(given);
    CHECK(is_refused(step) == (__builtin_popcount(unsigned(given)) != 1));
  }
  MotionStep empty_block, once;
  empty_block.repeat = 2, once.steps = {move()};
  CHECK(is_refused(empty_block));
  CHECK(is_refused(once));
  MotionStep block;
  block.repeat = 1, block.steps = {move()};
  CHECK_FALSE(is_refused(block));
  block.steps[0].joints.push_back(0);  // also inside a block
  CHECK(is_refused(block));
  MotionStep pose;
  pose.position = {1, 0, 1}, pose.quaternion = {1, 0, 0, 0};
  CHECK_FALSE(is_refused(pose));
  pose.quaternion = {1, 0, 0, 0, 0};
  CHECK(is_refused(pose));
  pose.quaternion = {1, 0, 0, 0}, pose.position = {1, 0};
  CHECK(is_refused(pose));
  pose.position = {1, 0, 1}, pose.joints = {0, 0};
  CHECK(is_refused(pose));
}

TEST_CASE("checks: a circular move has one point on its way, and no other move has any") {
  for (const PathKind path : {PathKind::joint, PathKind::linear, PathKind::circular})
    for (const std::size_t via : {0, 2, 3})
      for (const std::size_t angles : {0, 1, 2}) {
        MotionStep step = move();
        step.path = path;
        step.via_position.assign(via, 0.5), step.circle_joints.assign(angles, 0.1);
        const bool fits = path == PathKind::circular ? (via == 3 && angles == 0) || (via == 0 && angles == 2)
                                                     : via == 0 && angles == 0;
        CAPTURE(int(path), via, angles);
        CHECK(is_refused(step) == !fits);
      }
}

TEST_CASE("checks: clamps and rings stand in their order on links of the robot, and let the hose through") {
  Routing routing;
  routing.free_length = 2;
  routing.base_clamp = clamp_on("base"), routing.tool_clamp = clamp_on("hand");
  const auto refused = [](const Routing& of, bool recorded = false) {
    return is_refused([&] { check_routing(of, 0.06, two_axes(), recorded); });
  };
  CHECK_FALSE(refused(routing));
  const auto with_places = [&](double first, double second, bool rings) {
    Routing of = routing;
    for (const double at : {first, second}) {
      GuideRing ring;
      ring.link = "arm", ring.radius = 0.031, ring.at_length = at;
      if (rings)
        of.rings.push_back(ring);
      else
        of.clamps.push_back({clamp_on("arm"), at});
    }
    return of;
  };
  for (const bool rings : {true, false}) {
    CHECK_FALSE(refused(with_places(0.5, 1.9, rings)));
    CHECK(refused(with_places(0, 1, rings)));
    CHECK(refused(with_places(1, 1, rings)));
    CHECK(refused(with_places(1.5, 1, rings)));
    CHECK(refused(with_places(1, 2, rings)));
    CHECK(refused(with_places(0.5, 1.9, rings), true));
  }
  Routing of = with_places(0.5, 1.9, true);
  of.rings[1].at_length.reset();
  CHECK_FALSE(refused(of));
  of.clamps.push_back({clamp_on("arm"), 1});  // then the clamps on either side of a ring are unknown
  CHECK(refused(of));
  of = with_places(0.5, 1.9, true);
  of.rings[1].radius = 0.03;
  CHECK(refused(of));
  of = routing;
  of.tool_clamp->link = "foot";
  CHECK(refused(of));
  of = routing;
  of.tool_mass = 1;
  CHECK(refused(of));
  of.tool_end = ToolEnd::free;
  CHECK(refused(of));  // a clamp at a free end
  of.tool_clamp.reset();
  CHECK_FALSE(refused(of));
  of.pre_twist = 0.1;
  CHECK(refused(of));
  of = routing;
  of.mounting_pose = {0, 0, 0};
  CHECK(refused(of));
  of.mounting_pose = {0, 0};
  CHECK_FALSE(refused(of));
}

TEST_CASE(
    "checks: only a hose or a cable without described wires has a damage exponent, and ratings that bend or twist it") {
  for (const PlainKind kind : {PlainKind::filler, PlainKind::hose, PlainKind::fibre, PlainKind::cable}) {
    PlainPart part;
    part.kind = kind, part.damage_exponent = 4;
    CHECK(is_refused([&] { check_plain_part(part, 0.004, "part"); }) ==
          (kind != PlainKind::cable && kind != PlainKind::hose));
    for (const RigKind rig : {RigKind::torsion, RigKind::rolling_flex, RigKind::two_pulley, RigKind::tick_tock,
                              RigKind::swivel, RigKind::axial})
      for (const bool has_mass : {false, true}) {
        Rating rating;
        rating.rig.kind = rig, rating.cycles = 1e6;
        if (rig == RigKind::torsion) rating.rig.twist = 3;
        if (rig == RigKind::rolling_flex) rating.rig.radius = 0.1, rating.rig.travel = 1;
        if (rig == RigKind::two_pulley) rating.rig.pulley_diameter = 0.2;
        if (rig == RigKind::tick_tock) rating.rig.radius = 0.1;
        if (rig == RigKind::swivel) rating.rig.angle = 1, rating.rig.weight = 1;
        if (rig == RigKind::axial) rating.rig.elongation = 0.1;
        Dresspack dresspack;
        dresspack.diameter = 0.05, dresspack.inner_diameter = 0.04;
        Component& cable = dresspack.components.emplace_back();
        cable.name = "power cable", cable.radius = 0.004;
        cable.plain.emplace(), cable.plain->kind = kind;
        if (has_mass) cable.laying.mass = 0.1;
        cable.ratings = {rating};
        // only a cable needs its mass: that of a hose follows from its bore
        const bool rated = (kind == PlainKind::cable && has_mass) || kind == PlainKind::hose;
        const bool fits = rated && rig != RigKind::swivel && rig != RigKind::axial;
        CHECK(is_refused([&] { check_dresspack(dresspack, {Slip::free}); }) == !fits);
      }
  }
}

TEST_CASE("checks: no test bends a cable to less than half its diameter") {
  Dresspack dresspack;
  dresspack.diameter = 0.05, dresspack.inner_diameter = 0.04;
  Component& cable = dresspack.components.emplace_back();
  cable.name = "power cable", cable.radius = 0.004, cable.laying.mass = 0.1;
  cable.plain.emplace(), cable.plain->kind = PlainKind::cable;
  Rating& rating = cable.ratings.emplace_back();
  rating.rig.kind = RigKind::rolling_flex, rating.rig.travel = 1, rating.cycles = 1e6;
  const auto refusal = [&] { return message_of([&] { check_dresspack(dresspack, {Slip::free}); }); };
  rating.rig.radius = 0.00401;
  CHECK(refusal() == "");
  rating.rig.radius = 0.08e-3;
  CHECK_THAT(refusal(), Catch::Contains("bends the axis to 0.08 mm (must be at least 4 mm: half the diameter") &&
                            Catch::Contains("give radius_mm: 80 if that was metres"));
  rating.rig.radius.reset(), rating.rig.radius_diameters = 0.49;
  CHECK_THAT(refusal(), Catch::Contains("bends the axis to 3.92 mm"));
  rating.rig.radius_diameters = 0.51;
  CHECK(refusal() == "");
}

TEST_CASE("checks: only a hose has a bore or a filling, and its bore is the smaller diameter") {
  for (const PlainKind kind : {PlainKind::filler, PlainKind::hose, PlainKind::fibre, PlainKind::cable})
    for (const double bore : {0.0, 0.0079, 0.008, 0.009})
      for (const Medium medium : {Medium::air, Medium::water}) {
        PlainPart part;
        part.kind = kind, part.medium = medium;
        if (bore > 0) part.bore = bore;
        const bool fits = kind == PlainKind::hose ? bore < 0.008 : bore == 0 && medium == Medium::air;
        CHECK(is_refused([&] { check_plain_part(part, 0.004, "part"); }) == !fits);
      }
}

TEST_CASE("checks: a job is beyond its calibration by more than the margins only") {
  LearnedWithin within;
  CHECK(beyond(within, {1, 100, 100}).empty());  // without information about its tests
  within.largest_strain_range = 0.01, within.least_strain_range = 0.002, within.largest_curvature = 8,
  within.largest_twist = 4;
  const auto count = [&](double strain, double curvature, double twist) {
    return beyond(within, {strain, curvature, twist}).size();
  };
  CHECK(count(0.0124, 8.39, 4.19) == 0);
  CHECK(count(0.0126, 8.39, 4.19) == 1);
  CHECK(count(0.0124, 8.41, 4.19) == 1);
  CHECK(count(0.0124, 8.39, 4.21) == 1);
  CHECK(count(0.00161, 0, 0) == 0);
  CHECK(count(0.00159, 0, 0) == 1);
  CHECK(count(0, 0, 0) == 0);  // no wire was evaluated
  within.left_out = "rubbing was left out";
  CHECK(beyond(within, {}) == std::vector<std::string>{"rubbing was left out"});
}

TEST_CASE("learned: what lies in a hose is a cable by its own name, a dresspack without one is the cable") {
  Job job;
  Dresspack& dresspack = job.dresspacks[0].dresspack;
  dresspack.name = "pack";
  Component cable, wire;
  cable.name = "cable", wire.name = "wire", wire.material = "copper", wire.radius = 1e-4;
  cable.components = {wire};
  dresspack.components = {cable};
  for (const bool bore : {false, true})
    for (const bool material : {false, true}) {
      dresspack.inner_diameter = bore ? std::optional(0.05) : std::nullopt;
      dresspack.hose_material = material ? "polyamide" : "";
      const std::vector<LearnedCable> cables = learned_under({&job}).cables;
      REQUIRE(cables.size() == 1);
      CHECK(cables[0].name == (bore || material ? "cable" : "pack"));
    }
}
