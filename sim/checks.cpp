#include "sim/checks.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dresslife::sim {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

const Extreme& largest(const std::vector<Extreme>& places) {
  return *std::max_element(places.begin(), places.end(),
                           [](const Extreme& a, const Extreme& b) { return a.value < b.value; });
}

const Extreme& largest_by_size(const std::vector<Extreme>& places) {
  return *std::max_element(places.begin(), places.end(), [](const Extreme& a, const Extreme& b) {
    return std::abs(a.value) < std::abs(b.value);
  });
}

}  // namespace

void Extreme::see(double candidate, bool larger, double when, int where) {
  if (seen && !larger) return;
  value = candidate;
  time = when;
  place = where;
  seen = true;
}

MotionLimits limits_of(const pipeline::Dresspack& dresspack) {
  return {dresspack.least_bend_radius.value_or(least_bend_diameters * dresspack.diameter),
          dresspack.most_twist.value_or(most_twist)};
}

MotionChecks::MotionChecks(const Rod& rod, const MotionLimits& limits)
    : rod_(rod),
      limits_(limits),
      curvature_(rod.links()),
      twist_(rod.links()),
      tension_(rod.links()),
      least_slack_(rod.spans().size()),
      most_slack_(rod.spans().size()),
      travel_(rod.spans().size()) {}

void MotionChecks::see(const RodState& state, const std::vector<Contact>& contacts, double time,
                       const std::vector<double>& ways) {
  net_twist_ = 0;
  const std::vector<double> pull = rod_.tensions(state);
  for (int j = 0; j < rod_.links(); ++j) {
    const Vector3 turn = rod_.link_state(state, j).turn;
    net_twist_ += turn.z();
    const double curvature = turn.head<2>().norm() / rod_.bending_length(j);
    const double twist = turn.z() / rod_.bending_length(j);
    curvature_[j].see(curvature, curvature > curvature_[j].value, time, j);
    twist_[j].see(twist, std::abs(twist) > std::abs(twist_[j].value), time, j);
    tension_[j].see(pull[j], pull[j] > tension_[j].value, time, j);
  }
  for (int k = 0; k < static_cast<int>(rod_.spans().size()); ++k) {
    const RodProperties& p = rod_.spans()[k].properties;
    if (p.slider) travel_[k].see(state.travel[k].way, state.travel[k].way > travel_[k].value, time, k);
    if (p.tool_end == End::free) continue;
    const Vector3 way = state.clamps.end(2 * k + 1).position - state.clamps.end(2 * k).position;
    const double slack = p.length - (ways.empty() ? way.norm() : ways[k]);
    least_slack_[k].see(slack, slack < least_slack_[k].value, time, k);
    most_slack_[k].see(slack, slack > most_slack_[k].value, time, k);
  }
  most_net_twist_.see(net_twist_, std::abs(net_twist_) > std::abs(most_net_twist_.value), time, -1);
  for (const Contact& contact : contacts) {
    if (contact.depth > depth_.value) depth_.see(contact.depth, true, time, contact.segment);
    if (contact.normal_force > force_.value) force_.see(contact.normal_force, true, time, contact.segment);
  }
  if (!begun_) net_twist_at_begin_ = net_twist_;
  begun_ = true;
  end_ = time;
}

std::vector<Check> MotionChecks::table() const {
  const auto link = [&](const Extreme& e) { return rod_.link_arc(e.place); };
  const auto segment = [&](const Extreme& e) {
    return e.place < 0 ? -1 : rod_.span_of(e.place).arc(e.place);
  };
  const auto length = [&](const Extreme& e) { return rod_.spans()[e.place].properties.length; };
  const auto share = [&](const Extreme& e) { return e.value / length(e); };
  const auto middle = [&](const Extreme& e) {
    return rod_.spans().size() == 1 ? -1 : rod_.spans()[e.place].first_arc + length(e) / 2;
  };
  const Extreme &bend = largest(curvature_), &twist = largest_by_size(twist_), &pull = largest(tension_);
  const double radius = bend.value > 0 ? 1 / bend.value : unlimited;
  std::vector<Check> checks = {
      {"smallest bend radius", "m", radius, limits_.least_bend_radius, radius < limits_.least_bend_radius,
       bend.time, link(bend)},
      {"largest twist", "rad/m", twist.value, limits_.most_twist, std::abs(twist.value) > limits_.most_twist,
       twist.time, link(twist)},
      {"largest net twist", "rad", most_net_twist_.value, unlimited, false, most_net_twist_.time, -1},
      {"net twist left by a repeat", "rad", net_twist_ - net_twist_at_begin_, unlimited, false, end_, -1},
      {"largest tension", "N", pull.value, unlimited, false, pull.time, link(pull)},
      {"deepest contact", "m", depth_.value, unlimited, false, depth_.time, segment(depth_)},
      {"largest contact force", "N", force_.value, unlimited, false, force_.time, segment(force_)},
  };
  const Extreme *tight = nullptr, *loose = nullptr, *most = nullptr;
  for (size_t k = 0; k < least_slack_.size(); ++k) {
    const Extreme &least = least_slack_[k], &greatest = most_slack_[k];
    if (!least.seen) continue;  // a free end
    if (!tight || share(least) < share(*tight)) tight = &least;
    if (!loose || share(least) > share(*loose)) loose = &least;
    if (!most || share(greatest) > share(*most)) most = &greatest;
  }
  if (tight) {
    const double shortest = least_slack_share * length(*tight), longest = most_slack_share * length(*loose);
    checks.push_back({"least slack: too short below", "m", tight->value, shortest, tight->value < shortest,
                      tight->time, middle(*tight)});
    checks.push_back({"least slack: too long above", "m", loose->value, longest, loose->value > longest,
                      loose->time, middle(*loose)});
    checks.push_back({"most slack", "m", most->value, unlimited, false, most->time, middle(*most)});
  }
  for (const Extreme& travel : travel_)
    if (travel.seen) {
      const double stroke = rod_.spans()[travel.place].properties.slider->stroke;
      checks.push_back({"travel of the retraction unit", "m", travel.value, stroke, travel.value >= stroke,
                        travel.time, rod_.spans()[travel.place].first_arc});
    }
  return checks;
}

}  // namespace dresslife::sim
