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

MotionChecks::MotionChecks(const Rod& rod)
    : rod_(rod), curvature_(rod.links()), twist_(rod.links()), tension_(rod.links()) {}

void MotionChecks::see(const RodState& state, const std::vector<Contact>& contacts, double time) {
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
  const double slack =
      rod_.properties().length - (state.clamps.tool.position - state.clamps.base.position).norm();
  least_slack_.see(slack, slack < least_slack_.value, time, -1);
  most_slack_.see(slack, slack > most_slack_.value, time, -1);
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
  const double l = rod_.segment_length(), length = rod_.properties().length;
  const auto link = [&](const Extreme& e) { return e.place * l; };
  const auto segment = [&](const Extreme& e) { return e.place < 0 ? -1 : (e.place + 0.5) * l; };
  const Extreme &bend = largest(curvature_), &twist = largest_by_size(twist_), &pull = largest(tension_);
  const double radius = bend.value > 0 ? 1 / bend.value : unlimited;
  const double least_radius = least_bend_diameters * rod_.properties().diameter;
  const double least = least_slack_share * length, most = most_slack_share * length;
  return {
      {"smallest bend radius", "m", radius, least_radius, radius < least_radius, bend.time, link(bend)},
      {"largest twist", "rad/m", twist.value, most_twist, std::abs(twist.value) > most_twist, twist.time,
       link(twist)},
      {"largest net twist", "rad", most_net_twist_.value, unlimited, false, most_net_twist_.time, -1},
      {"net twist left by a repeat", "rad", net_twist_ - net_twist_at_begin_, unlimited, false, end_, -1},
      {"largest tension", "N", pull.value, unlimited, false, pull.time, link(pull)},
      {"deepest contact", "m", depth_.value, unlimited, false, depth_.time, segment(depth_)},
      {"largest contact force", "N", force_.value, unlimited, false, force_.time, segment(force_)},
      {"least slack: too short below", "m", least_slack_.value, least, least_slack_.value < least,
       least_slack_.time, -1},
      {"least slack: too long above", "m", least_slack_.value, most, least_slack_.value > most,
       least_slack_.time, -1},
      {"most slack", "m", most_slack_.value, unlimited, false, most_slack_.time, -1},
  };
}

}  // namespace dresslife::sim
