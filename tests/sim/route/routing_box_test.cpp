// Routings as places of a box: closed forms of where clamps are, how they point and how long the dresspack is.
#include "sim/route/routing_box.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <limits>
#include <vector>

#include "pipeline/resolve/job_text.h"
#include "sim/run/clamp_path.h"
#include "tests/sim/simple_job.h"

namespace dresslife::sim {
namespace {

constexpr std::size_t variables = 11;
constexpr double of_places = 1e-3, of_directions = 1e-2;  // they are rounded to

pipeline::Job shipped_job() {
  return pipeline::read_job(std::filesystem::path(DRESSLIFE_SOURCE_DIR) / "config/jobs/irb6640_spot_welding.yaml");
}

/// Between 0 and 1, without a pattern: multiples of the golden ratio.
std::vector<double> some_place(int which, std::size_t count = variables) {
  std::vector<double> place;
  for (std::size_t k = 0; k < count; ++k)
    place.push_back(std::fmod(0.6180339887498949 * static_cast<double>(which * 16 + k + 1), 1.0));
  return place;
}

double distance_to(const pipeline::Capsule& shape, const Vector3& point) {
  return distance_to_axis(point, shape.from, shape.to) - shape.radius;
}

}  // namespace

TEST_CASE("a clamp lies beside its link, as far as its variable says") {
  const pipeline::Job job = shipped_job();
  const Screener screener(job);
  const RoutingBox box(job, screener, "");
  REQUIRE(box.variables() == variables);
  const double diameter = job.dresspacks.front().dresspack.diameter;
  const std::vector<pipeline::Capsule>& shapes =
      job.robot.links[static_cast<std::size_t>(find_link(job.robot, "link_3", {}))].capsules;
  REQUIRE(!shapes.empty());
  for (int which = 0; which < 20; ++which) {
    std::vector<double> place = some_place(which);
    const pipeline::Routing routing = box.routing_at(place);
    CHECK(routing.base_clamp->link == "link_3");
    CHECK(routing.tool_clamp->link == "link_6");
    double nearest = std::numeric_limits<double>::infinity();
    for (const pipeline::Capsule& shape : shapes)
      nearest = std::min(nearest, distance_to(shape, routing.base_clamp->position));
    const double asked = (0.8 + 3.2 * place[2]) * diameter;
    CHECK(nearest <= asked + of_places);  // another shape of the link may be nearer
    bool as_asked = false;
    for (const pipeline::Capsule& shape : shapes)
      as_asked |= std::abs(distance_to(shape, routing.base_clamp->position) - asked) < of_places;
    CHECK(as_asked);
  }
}

TEST_CASE("in the middle of their variables clamps point along one line, and half a unit aside is 90 deg") {
  const pipeline::Job job = shipped_job();
  const Screener screener(job);
  const RoutingBox box(job, screener, "");
  const std::vector<Frame> links = path_of(job)->at(0).links;
  const auto direction = [&](const pipeline::Clamp& clamp) {
    return Vector3((links[static_cast<std::size_t>(find_link(job.robot, clamp.link, {}))].orientation *
                    clamp.direction)
                       .normalized());
  };
  std::vector<double> place(variables, 0.5);
  const pipeline::Routing straight = box.routing_at(place);
  const Vector3 way = direction(*straight.base_clamp);
  CHECK((way - direction(*straight.tool_clamp)).norm() < 4 * of_directions);
  place[3] = 1;  // of the base clamp
  CHECK(std::abs(direction(*box.routing_at(place).base_clamp).dot(way)) < 4 * of_directions);
  CHECK((direction(*box.routing_at(place).tool_clamp) - way).norm() < 4 * of_directions);
}

TEST_CASE("the length leaves the slack of the last variable where the way is longest") {
  const pipeline::Job job = shipped_job();
  const Screener screener(job);
  const RoutingBox box(job, screener, "");
  for (int which = 0; which < 20; ++which) {
    std::vector<double> place = some_place(which);
    pipeline::Job placed = job;
    placed.dresspacks.front().routing = box.routing_at(place);
    const double length = placed.dresspacks.front().routing.free_length;
    const double slack = 1 - screener.longest_ways(placed).front() / length;
    constexpr double step = 0.005;  // [m] to which lengths are rounded up
    CHECK(slack >= 0.02 + 0.3 * place.back() - 1e-9);
    CHECK(slack <= 0.02 + 0.3 * place.back() + step / length);
  }
}

TEST_CASE("a guide ring adds five variables, and what is no place of the box is refused") {
  const pipeline::Job job = shipped_job();
  const Screener screener(job);
  const RoutingBox box(job, screener, "link_4");
  REQUIRE(box.variables() == 16);
  const pipeline::Routing routing = box.routing_at(some_place(1, 16));
  REQUIRE(routing.rings.size() == 1);
  CHECK(routing.rings.front().link == "link_4");
  CHECK_THROWS_AS(box.routing_at(some_place(1)), pipeline::InputError);
  std::vector<double> outside = some_place(1, 16);
  outside[4] = 1.01;
  CHECK_THROWS_AS(box.routing_at(outside), pipeline::InputError);
  CHECK_THROWS_AS(RoutingBox(job, screener, "link_9"), pipeline::InputError);
}

}  // namespace dresslife::sim
