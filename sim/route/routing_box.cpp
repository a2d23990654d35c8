#include "sim/route/routing_box.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "pipeline/base/errors.h"
#include "sim/robot/robot.h"
#include "sim/run/clamp_path.h"

namespace dresslife::sim {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double farthest = 4;              // of a clamp from the shapes of its link [diameters]
constexpr double nearest = 0.8;             // likewise: the hose lies beside the link
constexpr double nearest_of_flange = 1.5;   // the tool lies about the flange's axis
constexpr double least_slack = 0.02, most_slack = 0.32;  // shares of the length that the checks ask for, nearly
constexpr double least_length = 0.1;        // [m]
constexpr double steps_per_metre = 200;     // of a length as people cut it

double between(double low, double high, double share) { return low + (high - low) * share; }

/// As people write places (mm) and directions.
Vector3 rounded(const Vector3& v, double step) { return (v / step).array().round() * step; }

/// Some direction across the axis.
Vector3 across(const Vector3& axis) {
  int least = 0;
  axis.cwiseAbs().minCoeff(&least);
  return axis.cross(Vector3::Unit(least)).normalized();
}

Vector3 axis_of(const pipeline::Capsule& shape) {
  const Vector3 along = shape.to - shape.from;
  return along.norm() > 1e-6 ? Vector3(along.normalized()) : Vector3(Vector3::UnitZ());
}

}  // namespace

RoutingBox::RoutingBox(const pipeline::Setup& setup, const Screener& screener, std::string ring_link)
    : setup_(setup), screener_(screener) {
  setup_.dresspacks.resize(1);
  const pipeline::Routing& given = setup_.dresspacks.front().routing;
  if (!given.base_clamp || !given.tool_clamp)
    throw pipeline::InputError(setup.motion.where,
                               "clamps are proposed on the links of a robot, and this motion has none",
                               "name a robot and its program");
  diameter_ = setup_.dresspacks.front().dresspack.diameter;
  links_ = {given.base_clamp->link, given.tool_clamp->link, std::move(ring_link)};
  const std::unique_ptr<ClampPath> path = path_of(setup_);
  const Pose start = path->at(0);
  std::array<Vector3, 3> centre;
  for (std::size_t k = 0; k < used(); ++k) {
    link_[k] = find_link(setup_.robot, links_[k], given.where);
    start_[k] = start.links[link_[k]];
    const pipeline::Capsule shape = shapes_of(k).front();
    centre[k] = start_[k].point(0.5 * (shape.from + shape.to));
  }
  const Vector3 way = centre[tool] - centre[base];
  way_ = way.norm() > 1e-6 ? Vector3(way.normalized()) : Vector3(Vector3::UnitX());
  across_ = across(way_);
  up_ = way_.cross(across_);
}

bool RoutingBox::is_flange(std::size_t place) const {
  return link_[place] + 1 == static_cast<int>(setup_.robot.links.size());
}

/// What of the link a clamp is beside: its capsules; of the last link the flange, where tools have their
/// brackets, as a line as long as those reach.
std::vector<pipeline::Capsule> RoutingBox::shapes_of(std::size_t place) const {
  const pipeline::Link& link = setup_.robot.links[link_[place]];
  if (!is_flange(place) && !link.capsules.empty()) return link.capsules;
  const Vector3 from = is_flange(place) ? setup_.robot.flange_position : Vector3::Zero();
  const Vector3 axis = from_roll_pitch_yaw(setup_.robot.flange_orientation) * Vector3::UnitZ();
  return {{from + 0.5 * diameter_ * axis, from + farthest * diameter_ * axis, 0}};
}

Vector3 RoutingBox::position(std::size_t place, std::span<const double> of) const {
  const std::vector<pipeline::Capsule> shapes = shapes_of(place);
  const auto extent = [](const pipeline::Capsule& shape) { return (shape.to - shape.from).norm() + shape.radius; };
  double left = 0;
  for (const pipeline::Capsule& shape : shapes) left += extent(shape);
  left *= of[0];
  std::size_t k = 0;
  while (k + 1 < shapes.size() && left > extent(shapes[k])) left -= extent(shapes[k++]);
  const pipeline::Capsule& shape = shapes[k];
  const double along = extent(shape) > 0 ? std::min(1.0, left / extent(shape)) : 0;
  const Vector3 axis = axis_of(shape), one = across(axis), other = axis.cross(one);
  const double angle = 2 * pi * of[1];
  const double off =
      shape.radius + between(is_flange(place) ? nearest_of_flange : nearest, farthest, of[2]) * diameter_;
  return shape.from + along * (shape.to - shape.from) + off * (std::cos(angle) * one + std::sin(angle) * other);
}

Vector3 RoutingBox::direction(std::size_t place, std::span<const double> of) const {
  const double a = between(-pi / 2, pi / 2, of[3]), b = between(-pi / 2, pi / 2, of[4]);
  const double angle = std::hypot(a, b);
  const Vector3 aside = angle > 0 ? Vector3((a * across_ + b * up_) / angle) : across_;
  return start_[place].orientation.conjugate() * (std::cos(angle) * way_ + std::sin(angle) * aside);
}

pipeline::Routing RoutingBox::routing_at(std::span<const double> place) const {
  if (place.size() != variables() ||
      !std::all_of(place.begin(), place.end(), [](double u) { return u >= 0 && u <= 1; }))
    throw pipeline::InputError(setup_.dresspacks.front().routing.where,
                               fmt::format("routing_at is not {} numbers from 0 to 1", variables()),
                               "write as many");
  pipeline::Setup setup = setup_;
  pipeline::Routing& routing = setup.dresspacks.front().routing;
  const auto of = [&](std::size_t k) { return place.subspan(k * per_place, per_place); };
  const auto clamp = [&](std::size_t k) {
    return pipeline::Clamp{links_[k], rounded(position(k, of(k)), 1e-3), rounded(direction(k, of(k)), 1e-2), {}, {}};
  };
  routing.base_clamp = clamp(base);
  routing.tool_clamp = clamp(tool);
  routing.rings.clear();
  if (used() > ring) {
    pipeline::GuideRing& guide = routing.rings.emplace_back();
    guide.link = links_[ring];
    guide.position = rounded(position(ring, of(ring)), 1e-3);
    guide.direction = rounded(direction(ring, of(ring)), 1e-2);
    guide.radius = 0.75 * diameter_;
    guide.width = diameter_;
    guide.friction = setup.dresspacks.front().dresspack.friction;
  }
  routing.free_length = 1;
  const double way = screener_.longest_ways(setup).front();
  const double slack = between(least_slack, most_slack, place.back());
  routing.free_length =
      std::max(least_length, std::ceil(steps_per_metre * way / (1 - slack)) / steps_per_metre);
  return routing;
}

}  // namespace dresslife::sim
