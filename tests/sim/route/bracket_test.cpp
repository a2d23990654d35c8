#include "sim/route/bracket.h"

#include <cmath>

#include "tests/catch.h"
#include "tests/pipeline/scratch.h"
#include "tests/sim/simple_job.h"

namespace dresslife::sim {
namespace {

Frame at(double x, double y, double z) { return {{x, y, z}, Quaternion::Identity()}; }

/// Returns a job with two links: a horizontal capsule of 1 m and radius 0.1, and a cube of 0.2 m.
pipeline::Job two_links() {
  pipeline::Job job = simple_job();
  job.robot.links[0].capsules = {{{0, 0, 0}, {1, 0, 0}, 0.1}};
  job.robot.links[1].boxes = {{{0, 0, 0}, {0, 0, 0}, {0.2, 0.2, 0.2}}};
  return job;
}

TEST_CASE("bracket: its length is from the link's surface to that of the dresspack") {
  const pipeline::Job job = two_links();
  const Surfaces surfaces(job);
  const std::vector<std::vector<Frame>> poses{{at(0, 0, 0), at(5, 0, 0)}};
  // 0.25 m above the axis: 0.15 m above the surface, minus 0.02 m of hose.
  BracketFit fit = fit_of({0, {0.5, 0, 0.25}, 0.02}, job.robot, surfaces, poses);
  CHECK(fit.length == Approx(0.13));
  CHECK(std::isinf(fit.clearance));
  CHECK(fit.beyond(0.15, 0.04) < 0);
  CHECK(fit.beyond(0.1, 0.04) == Approx(0.03 / 0.04));
  CHECK(fit_of({0, {0.5, 0, 0.12}, 0.02}, job.robot, surfaces, poses).length == Approx(0).margin(1e-12));
  CHECK(fit_of({0, {0.5, 0, 0.05}, 0.02}, job.robot, surfaces, poses).length == 0);  // inside its own link
}

TEST_CASE("bracket: no clamp is built inside its own link or the adapter of the tool") {
  const pipeline::Job job = two_links();
  const Surfaces surfaces(job);
  const std::vector<std::vector<Frame>> poses{{at(0, 0, 0), at(5, 0, 0)}};
  const auto beyond = [&](int link, const Vector3& position) {
    return fit_of({link, position, 0.02}, job.robot, surfaces, poses).beyond(1, 0.04);
  };
  CHECK(beyond(0, {0.5, 0, 0.11}) < 0);
  CHECK(beyond(0, {0.5, 0, 0.09}) == Approx(0.01 / 0.04));
  // Beside the axis of the flange, in front of it: the adapter has 20 mm, the dresspack 20 mm.
  const Eigen::Quaterniond turn = pipeline::from_roll_pitch_yaw(job.robot.flange_orientation);
  const auto beside = [&](double off) { return Vector3(job.robot.flange_position + turn * Vector3(off, 0, 0.3)); };
  CHECK(beyond(1, beside(0.05)) < 0);
  CHECK(beyond(1, beside(0.03)) == Approx(0.01 / 0.04));
  CHECK(beyond(0, beside(0.03)) < 0);
}

TEST_CASE(
    "bracket: a dresspack that leads into its clamp's link comes out with the curvature of a circular arc at least") {
  pipeline::Job job = two_links();
  const Surfaces surfaces(job);
  CHECK(way_out(surfaces, 0, {0.5, 0, 0.121}, {1, 0, 0}, 0.04) == 0);
  CHECK(way_out(surfaces, 0, {0.5, 0, 0.11}, {2, 0, 0}, 0.04) == Approx(2 * 0.01 / (0.04 * 0.04)));
  CHECK(way_out(surfaces, 0, {0.5, 0, 0.15}, {0, 0, -1}, 0.04) == Approx(2 * 0.01 / (0.04 * 0.04)));
  CHECK(way_out(surfaces, 0, {0.5, 0, 0.11}, {0, 0, 1}, 0.04) == 0);

  auto& clamp = job.dresspacks[0].routing.base_clamp;
  clamp->position = {0.5, 0, 0.11};
  clamp->direction = {1, 0, 0};
  job.dresspacks[0].routing.tool_clamp->position = {0, 0, 0.13};
  job.dresspacks[0].routing.tool_clamp->direction = {0, 0, -1};  // it comes from above
  const double radius = 0.04 * 0.04 / (2 * 0.01);
  job.dresspacks[0].dresspack.least_bend_radius = 0.99 * radius;
  CHECK(way_out_warnings(job).empty());
  job.dresspacks[0].dresspack.least_bend_radius = 1.01 * radius;
  REQUIRE(way_out_warnings(job).size() == 1);
  CHECK_THAT(way_out_warnings(job)[0].words,
             Catch::Contains(
                 "10.0 mm inside bench at one diameter from the clamp: it comes out with a bend radius of 80.0 mm"));
  clamp->direction = {0, 0, 1};
  CHECK(way_out_warnings(job).empty());
  job.dresspacks[0].routing.tool_clamp->direction = {0, 0, 1};  // through the tool
  CHECK(way_out_warnings(job).size() == 1);
  // An intermediate clamp across the surface leads into it at one side, and its key is that of a list of dresspacks.
  job.dresspacks[0].name = "hose";
  job.dresspacks[0].routing.clamps = {{{"bench", {0.5, 0, 0.15}, {0, 0, 1}, {}, {}}, 0.5}};
  REQUIRE(way_out_warnings(job).size() == 2);
  CHECK_THAT(way_out_warnings(job)[0].words, Catch::Contains("dresspacks.1.routing.clamps.1.position_m "));
  job.simulation.contact = false;
  CHECK(way_out_warnings(job).empty());
}

TEST_CASE("bracket: no clamp is built inside a closed mesh of its own link") {
  pipeline::Job job = two_links();
  const pipeline::Scratch scratch;
  std::string cube = "solid cube\n";  // corners at 0 and 1
  for (const char* of : {"000 011 010", "000 001 011", "100 110 111", "100 111 101", "000 100 101", "000 101 001",
                         "010 111 110", "010 011 111", "000 110 100", "000 010 110", "001 101 111", "001 111 011"}) {
    cube += "facet normal 0 0 0\nouter loop\n";
    for (int k = 0; k < 3; ++k) cube += fmt::format("vertex {} {} {}\n", of[4 * k], of[4 * k + 1], of[4 * k + 2]);
    cube += "endloop\nendfacet\n";
  }
  job.robot.links[0].capsules.clear();
  job.robot.links[0].meshes = {{scratch.write("cube.stl", cube + "endsolid\n"), 0.4, {-0.2, -0.2, -0.2}, {0, 0, 0}}};
  const Surfaces surfaces(job);
  CHECK(surfaces.of_link(0, {0, 0, 0}, 1) == Approx(-0.2));  // also on the diagonals of the faces
  CHECK(surfaces.of_link(0, {0.1, 0.02, -0.15}, 1) == Approx(-0.05));
  CHECK(surfaces.of_link(0, {0.1, 0.02, -0.25}, 1) == Approx(0.05));
  CHECK(surfaces.of_link(0, {0.3, 0, 0}, 1) == Approx(0.1));
  const std::vector<std::vector<Frame>> poses{{at(0, 0, 0), at(5, 0, 0)}};
  CHECK(fit_of({0, {0, 0, 0.1}, 0.02}, job.robot, surfaces, poses).beyond(1, 0.04) == Approx(0.1 / 0.04));
}

TEST_CASE("bracket: clearance is the least over the motion, and names link and moment") {
  const pipeline::Job job = two_links();
  const Surfaces surfaces(job);
  std::vector<std::vector<Frame>> poses;
  for (const double height : {0.6, 0.4, 0.8}) poses.push_back({at(0, 0, 0), at(0.5, 0, height)});
  const BracketFit fit = fit_of({0, {0.5, 0, 0.2}, 0.02}, job.robot, surfaces, poses);
  CHECK(fit.clearance == Approx(0.4 - 0.1 - 0.2 - 0.02));
  CHECK(fit.neighbour == 1);
  CHECK(fit.moment == 1);
  poses.push_back({at(0, 0, 0), at(0.5, 0, 0.25)});
  const BracketFit inside = fit_of({0, {0.5, 0, 0.2}, 0.02}, job.robot, surfaces, poses);
  CHECK(inside.clearance == Approx(-0.05 - 0.02));
  CHECK(inside.beyond(1, 0.04) == Approx(0.07 / 0.04));
}

TEST_CASE("bracket: a link without shapes limits nothing, and the cell counts as a neighbour") {
  pipeline::Job job = two_links();
  job.robot.links[0].capsules.clear();
  job.cell.boxes = {{{0, 0, 1}, {0, 0, 0}, {4, 4, 0.2}}};
  const Surfaces surfaces(job);
  CHECK_FALSE(surfaces.has_shapes(0));
  const BracketFit fit =
      fit_of({0, {0, 0, 0.7}, 0.05}, job.robot, surfaces, std::vector<std::vector<Frame>>{{at(0, 0, 0), at(9, 0, 0)}});
  CHECK(fit.length == 0);
  CHECK(fit.clearance == Approx(0.9 - 0.7 - 0.05));
  CHECK(fit.neighbour == -1);
}

TEST_CASE("bracket: the space of a tool without a shape is not known, and the proposed line makes it known") {
  pipeline::Job job = two_links();
  job.robot.flange_orientation = {0, EIGEN_PI / 2, 0};  // its z along x of the link
  job.robot.flange_position = {0.1, 0, 0};
  job.simulation.contact = true;
  job.robot.links[1].boxes.clear();
  const auto space = [&](const std::vector<Vector3>& tools) { return unknown_tool_space(job, tools); };
  CHECK_FALSE(space({}));
  CHECK_FALSE(space({{0, 0, 0.1}}));  // a measuring tip
  CHECK_THAT(tool_space_note(space({{0, 0, 0.05}, {0, 0, 0.4}})),
             Catch::Contains("it works 400 mm from the flange, and spindle has no shape there") &&
                 Catch::Contains("robot.links.2.capsules: [{from_m: [0.14, 0, "));
  CHECK(space({{0, 0.3, 0.4}})->line.value.starts_with("[{from_m: [0.14, 0.03, "));  // a tool at an angle
  job.robot.links[1].capsules = {{{0.14, 0, 0}, {0.42, 0, 0}, 0.06}};
  CHECK_FALSE(space({{0, 0, 0.4}}));
  CHECK(space({{0, 0, 2}})->line.key == "robot.links.2.boxes");
  // The adapter of a tool 2 m long, along x of the link
  auto& clamp = job.dresspacks[0].routing.tool_clamp;
  clamp->position = {0.12, 0.01, 0};
  REQUIRE(tool_clamp_warnings(job, space({{0, 0, 2}})).size() == 1);
  CHECK_THAT(tool_clamp_warnings(job, space({{0, 0, 2}}))[0].words,
             Catch::Contains("is 10 mm beside the axis of the flange (limit 40 mm)"));
  clamp->position = {0.12, 0.05, 0};
  CHECK(tool_clamp_warnings(job, space({{0, 0, 2}})).empty());
  job.robot.links[1].boxes = {{{0.14, 0, 0}, {0, 0, 0}, {0.1, 0.1, 0.1}}};
  CHECK(space({{0, 0, 2}})->line.key.empty());
  CHECK_THAT(tool_space_note(space({{0, 0, 2}})), Catch::Contains("Add the shape of your tool to those of this link"));
  job.simulation.contact = false;
  CHECK_FALSE(space({{0, 0, 2}}));
  job.simulation.contact = true;
  job.robot.links.clear();
  CHECK_FALSE(space({{0, 0, 0.4}}));
}

}  // namespace
}  // namespace dresslife::sim
