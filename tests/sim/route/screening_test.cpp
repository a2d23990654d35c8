// The limits of a routing that geometry alone gives, against closed forms; and routings that geometry proposes.
#include "sim/route/screening.h"

#include <cmath>
#include <filesystem>
#include <numbers>

#include "pipeline/base/installation.h"
#include "pipeline/files/files.h"
#include "pipeline/resolve/job_text.h"
#include "sim/robot/robot.h"
#include "sim/route/exercise.h"
#include "sim/route/proposal.h"
#include "sim/route/screening_file.h"
#include "sim/run/checks.h"
#include "sim/run/clamp_path.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"
#include "tests/sim/simple_job.h"

namespace dresslife::sim {
namespace {

using std::numbers::pi;

double beyond(const pipeline::Setup& setup, ScreenedLimit limit) {
  return Screener(setup).screen(setup).beyond[static_cast<std::size_t>(limit)];
}

pipeline::Routing& routing(pipeline::Job& job) { return job.dresspacks.front().routing; }

pipeline::Job shipped_job(const std::vector<std::string>& sets = {}) {
  return pipeline::read_job(std::filesystem::path(DRESSLIFE_SOURCE_DIR) / "config/jobs/irb6640_spot_welding.yaml",
                            sets);
}

}  // namespace

TEST_CASE("length is screened by the straight way and the slack that checks ask for (V1), (V2)") {
  pipeline::Job job = simple_job();  // a constant distance of 0.9 m
  for (const double length : {0.85, 0.95, 1.2, 1.6}) {
    routing(job).free_length = length;
    CHECK(beyond(job, ScreenedLimit::too_short) == Approx((0.9 - 0.98 * length) / length).margin(1e-12));
    CHECK(beyond(job, ScreenedLimit::too_long) == Approx((2.0 / 3 * length - 0.9) / length).margin(1e-12));
  }
  routing(job).free_length = 0.89;  // shorter than the distance
  CHECK(Screener(job).screen(job).rejected());
  CHECK(Screener(job).longest_ways(job).front() == Approx(0.9).epsilon(1e-12));
}

TEST_CASE("twist is counted from where the hose was clamped, whole turns too (V4)") {
  pipeline::Job job = simple_job();
  // The hose lies in a plane through the axis, so its twist is the clamp's rotation: 2 rad in 1 m.
  CHECK(beyond(job, ScreenedLimit::twist) == Approx(2 / pi - 1).margin(1e-9));
  job.motion.steps = {move_to(0), move_to(4 * pi + 1), move_to(0)};
  CHECK(beyond(job, ScreenedLimit::twist) == Approx((4 * pi + 1) / pi - 1).margin(1e-9));
  // Clamped at 9 rad, it is twisted by 9 rad at the start and by 4 pi + 1 - 9 at the end.
  routing(job).mounting_pose = {9};
  CHECK(beyond(job, ScreenedLimit::twist) == Approx(9 / pi - 1).margin(1e-9));
  routing(job).pre_twist = -2;
  CHECK(beyond(job, ScreenedLimit::twist) == Approx(11 / pi - 1).margin(1e-9));
}

TEST_CASE("bend radius is that of a smooth curve between the clamps (V3)") {
  pipeline::Job job = simple_job();
  // Half a circle of 0.3 m. A cubic of equal length through its ends has a slightly higher maximum of curvature.
  routing(job).tool_clamp->position = {0, 0.6, 0};
  routing(job).tool_clamp->direction = {-1, 0, 0};
  routing(job).free_length = 0.3 * pi;
  job.motion.steps = {move_to(0), move_to(0.001)};
  const double radius = 10 * job.dresspacks.front().dresspack.diameter;
  const double found = radius / std::exp(beyond(job, ScreenedLimit::bend));
  CHECK(found < 0.3);
  CHECK(found > 0.3 / 1.5);
}

TEST_CASE("a hose in a link is graded by how deep it lies there (V5)") {
  pipeline::Job job = simple_job();
  CHECK(beyond(job, ScreenedLimit::overlap) < -0.5);
  job.robot.links[0].capsules = {{{0.45, 0, 0.2}, {0.45, 0, 2}, 0.1}};  // a post across the hose at any sag
  const double shallow = beyond(job, ScreenedLimit::overlap);
  job.robot.links[0].capsules[0].radius = 0.2;
  CHECK(shallow > 0);
  CHECK(beyond(job, ScreenedLimit::overlap) == Approx(shallow + 0.1 / 0.04).epsilon(1e-9));
  job.simulation.contact = false;
  CHECK(beyond(job, ScreenedLimit::overlap) < -0.5);
}

TEST_CASE("a shipped routing passes the screening, and what cannot work does not") {
  const pipeline::Job job = shipped_job();
  const Screener screener(job);
  CHECK_FALSE(screener.screen(job).rejected());
  CHECK(screener.screen(shipped_job({"routing.free_length_m=1.5"})).rejected());
  CHECK(screener.screen(shipped_job({"routing.tool_clamp.direction=[-1, 0, 0.35]"})).rejected());
}

TEST_CASE("a clamp in the air or in a neighbour has no bracket (V7)") {
  pipeline::Job job = simple_job();
  const auto g = [&](std::optional<double> longest) {
    job.dresspacks.front().routing.longest_bracket = longest;
    return Screener(job, true).screen(job).beyond[static_cast<std::size_t>(ScreenedLimit::bracket)];
  };
  CHECK(g({}) == g(0.15));                                 // the default
  CHECK(std::isinf(beyond(job, ScreenedLimit::bracket)));  // no bracket was required
  const double diameter = job.dresspacks.front().dresspack.diameter;
  // A post whose surface is 0.3 m from the base clamp.
  const Vector3 clamp = routing(job).base_clamp->position;
  const auto base = static_cast<std::size_t>(find_link(job.robot, routing(job).base_clamp->link, {}));
  const auto tool = static_cast<std::size_t>(find_link(job.robot, routing(job).tool_clamp->link, {}));
  REQUIRE(base != tool);
  for (pipeline::Link& link : job.robot.links) link.capsules.clear(), link.boxes.clear();
  const Vector3 beside = routing(job).tool_clamp->position + Vector3{0, 0.03, 0};
  job.robot.links[tool].capsules = {{beside, beside, 0.01}};
  job.robot.links[base].capsules = {{clamp + Vector3{0, 0, 0.4}, clamp + Vector3{0, 0, 1}, 0.1}};
  CHECK(g(0.15) == Approx((0.3 - diameter / 2 - 0.15) / diameter));
  CHECK(Screener(job, true).screen(job).rejected());
  CHECK(g(0.3) < 0);
}

TEST_CASE("each screened candidate has its own cell, and an existing bracket is accepted in its place only (V7)") {
  const pipeline::Scratch scratch;
  const auto brackets_of = [&](const std::vector<std::string>& sets, const std::string& candidates) {
    {
      pipeline::FileWriter file(scratch / "s.h5", pipeline::screening_format());
      write_screening(shipped_job(sets), scratch.write("list.yaml", candidates), false, file);
      for (const char* name : {"job", "history", "input_sha256"}) file.attribute(name, "");
      file.commit();
    }
    const pipeline::FileReader file(scratch / "s.h5", pipeline::screening_format());
    for (const std::string& refusal : file.read<std::string>("/candidate/refusal")) CHECK(refusal == "");
    const auto beyond = file.read<double>("/candidate/beyond");
    std::vector<double> brackets;
    for (std::size_t k = static_cast<std::size_t>(ScreenedLimit::bracket); k < beyond.size(); k += screened_limits)
      brackets.push_back(beyond[k]);
    return brackets;
  };
  const std::vector<double> cells =
      brackets_of({"cell={boxes: [{position_m: [5, 0, 1], sides_m: [0.4, 0.4, 0.4]}]}"},
                  "- {}\n- {cell.boxes.1.position_m: [1.8, 0, 1.5], cell.boxes.1.sides_m: [2, 2, 2]}\n- {}\n");
  REQUIRE(cells.size() == 3);
  CHECK(cells[0] < 0);
  CHECK(cells[1] > 1);  // the clamps are inside the block
  CHECK(cells[2] == cells[0]);

  const std::vector<double> places = brackets_of({"routing.base_clamp.position_m=[-0.1, 0, 0.95]"},
                                                 "- {}\n"
                                                 "- {routing.base_clamp.position_m: [-0.1, 0, 0.949]}\n"
                                                 "- {routing.base_clamp.position_m: [-0.1, 0, 0.9499]}\n"
                                                 "- {routing.tool_clamp.position_m: [0.144, 0, 0.674]}\n"
                                                 "- {routing.base_clamp.position_m: [-0.1, 0, 0.45]}\n");
  REQUIRE(places.size() == 5);
  CHECK(places[0] == Approx(0).margin(1e-12));
  CHECK(places[1] > 1);   // 1 mm from the existing bracket: a new one, more than 0.3 m too long
  CHECK(places[2] <= 0);  // as near as no mounting is exact
  CHECK(places[3] > 1);
  CHECK(places[4] < 0);
}

TEST_CASE("the way out of a clamp's link is a limit of the bend at all clamps, if there is contact (V8)") {
  pipeline::Job job = simple_job();
  const auto bend = [&] {
    return Screener(job, true).screen(job).beyond[static_cast<std::size_t>(ScreenedLimit::bend)];
  };
  // The hose is nearly straight, and its clamp 10 mm above the surface of a capsule at one of its sides.
  routing(job).free_length = 0.92;
  routing(job).clamps = {{{"bench", {0.5, 0, 1}, {1, 0, 0}, {}, {}}, 0.51}};
  const double d = job.dresspacks.front().dresspack.diameter;
  const double limit = std::log(limits_of(job.dresspacks.front().dresspack).least_bend_radius * (d - 0.02) / (d * d));
  for (const double side : {-1, 1}) {
    job.robot.links[0].capsules = {{{0.5 + 0.02 * side, 0, 0.89}, {0.5 + 0.2 * side, 0, 0.89}, 0.1}};
    job.simulation.contact = true;
    CHECK(bend() == Approx(limit));
    job.simulation.contact = false;
    CHECK(bend() < limit - 0.1);
  }
}

TEST_CASE("proposed clamps have a bracket within the limit, and a link without such a place is refused at once") {
  pipeline::Job job = shipped_job();
  ProposalSettings settings;
  settings.tried = 60;
  constexpr auto bracket = static_cast<std::size_t>(ScreenedLimit::bracket);
  for (const double longest : {0.15, 0.06}) {
    job.dresspacks.front().routing.longest_bracket = longest;
    job.dresspacks.front().routing = propose(job, settings).front().routing;
    CHECK(Screener(job, true).screen(job).beyond[bracket] <= 0);
  }
  job.cell.boxes = {{{0, 0, 0}, {0, 0, 0}, {20, 20, 20}}};  // everything is inside a block
  CHECK_THROWS_WITH(propose(job, settings),
                    Catch::Contains("no place within 60 mm of the surface of link_3 stays clear") &&
                        Catch::Contains("inside the cell at"));
}

TEST_CASE("proposals that geometry surely excludes have no short run") {
  pipeline::Job job = shipped_job();
  job.dresspacks.front().dresspack.least_bend_radius = 20;  // [m]
  ProposalSettings settings;
  settings.tried = 100;  // twelve searches of at least ten
  settings.short_runs = 1000;
  const Proposal nearest = propose(job, settings).front();
  CHECK(nearest.short_run.refusal.find("geometry excludes all 120 routings") == 0);
  CHECK(nearest.short_run.refusal.find("bent too tightly by ") != std::string::npos);
}

TEST_CASE("short runs give as many proposals as wanted") {
  ProposalSettings settings;
  settings.count = 7;
  settings.tried = 1;
  settings.short_runs = 24;  // a hopeless search ends after a third of them
  CHECK(propose(shipped_job({"motion=easy", "simulation.segments=16"}), settings).size() == 7);
}

TEST_CASE("proposals keep what the screening asks and are the same for the same seed") {
  const pipeline::Job job = shipped_job();
  ProposalSettings settings;
  settings.count = 2;
  settings.tried = 150;
  const std::vector<Proposal> first = propose(job, settings), again = propose(job, settings);
  REQUIRE(first.size() == 2);
  CHECK_FALSE(first.front().screening.rejected());
  CHECK(first.front().missing <= first.back().missing);
  for (std::size_t k = 0; k < first.size(); ++k) {
    CHECK(first[k].routing.base_clamp->link == "link_3");
    CHECK(first[k].routing.tool_clamp->link == "link_6");
    CHECK(first[k].routing.free_length == again[k].routing.free_length);
    CHECK(first[k].routing.base_clamp->position == again[k].routing.base_clamp->position);
  }
  settings.seed = 2;
  CHECK(propose(job, settings).front().routing.base_clamp->position != first.front().routing.base_clamp->position);
}

TEST_CASE("every shipped robot has a home pose with its forearm level, and an exercise that it can run") {
  for (const auto& file : std::filesystem::directory_iterator(pipeline::shipped_catalogue() / "robots")) {
    const std::string name = file.path().stem().string();
    const std::string motoman = name.starts_with("motoman") ? "_u" : "", last = motoman.empty() ? "" : "_t";
    INFO(name);
    pipeline::Job job = shipped_job({"robot=" + name, "routing.base_clamp.link=link_3" + motoman,
                                     "routing.tool_clamp.link=link_6" + last,
                                     "motion={name: x, source: x, steps: [{joints_deg: [0, -50, 0, 0, 0, 0]}]}"});
    job.motion = exercise(job.robot);
    const RobotKinematics kinematics(job.robot);
    std::vector<double> joints = home_pose(job.robot);
    joints.resize(kinematics.axes());
    std::vector<Frame> links(kinematics.links());
    kinematics.link_frames(joints, links);
    const Vector3 upper = (links[3].position - links[2].position).normalized();
    const Vector3 forearm = (links[6].position - links[3].position).normalized();
    CHECK(upper.z() > std::cos(25 * pi / 180));              // on some robots the shoulder is beside the upper arm
    CHECK(std::abs(forearm.z()) < std::sin(15 * pi / 180));  // and the elbow above the forearm's axis
    CHECK(forearm.x() > 0.9);
    CHECK(path_of(job)->duration() > 5);
  }
}

}  // namespace dresslife::sim
