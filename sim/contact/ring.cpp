#include "sim/contact/ring.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dresslife::sim {
namespace {

constexpr int newton_steps = 6;
constexpr double last_step = 1e-10;  // [segments]
constexpr int alternations = 8;      // between the nearest points of the axis and of the circle
constexpr double same_side = 0.9;    // cosine: contact points less than 25 deg apart are merged

}  // namespace

SpanAxis::Point SpanAxis::at(double place) const {
  const int n = span_.segments(), first = span_.first_segment;
  const double l = span_.segment_length;
  const auto straight = [&](int i) {
    const Vector3 t = tangent(state_.orientation[first + i]);
    return Point{state_.position[first + i] + (place - i) * l * t, l * t, Vector3::Zero()};
  };
  if (place <= 0) return straight(0);
  if (place >= n - 1) return straight(n - 1);
  const int i = std::min(static_cast<int>(place), n - 2), a = first + i;
  const double u = place - i;
  const Vector3 &from = state_.position[a], &to = state_.position[a + 1];
  const Vector3 joint =
      (from + to + (l / 2) * (tangent(state_.orientation[a]) - tangent(state_.orientation[a + 1]))) / 2;
  return {(1 - u) * (1 - u) * from + 2 * u * (1 - u) * joint + u * u * to,
          2 * ((1 - u) * (joint - from) + u * (to - joint)), 2 * (from - 2 * joint + to)};
}

double SpanAxis::nearest(const Vector3& to, double from) const {
  double place = from;
  for (int k = 0; k < newton_steps; ++k) {
    const Point p = at(place);
    const Vector3 off = p.position - to;
    const double slope = off.dot(p.slope), squared = p.slope.squaredNorm();
    const double step = -slope / std::max(squared + off.dot(p.bend), 0.2 * squared);
    place = std::clamp(place + std::clamp(step, -1.0, 1.0), first(), last());
    if (std::abs(step) < last_step) break;
  }
  return place;
}

double SpanAxis::passage(const Frame& frame) const {
  const Vector3 axis = tangent(frame.orientation);
  double best = std::numeric_limits<double>::infinity(), place = 0;
  const int n = span_.segments();
  for (int i = 0; i < n; ++i) {
    const Vector3 off = state_.position[span_.first_segment + i] - frame.position;
    const double away = off.squaredNorm();
    if (away < best) best = away, place = i;
  }
  for (int k = 0; k < newton_steps; ++k) {
    const Point p = at(place);
    const double through = p.slope.dot(axis);
    if (std::abs(through) < 0.1 * p.slope.norm()) break;  // along the plane: the present place is accurate enough
    place =
        std::clamp(place - std::clamp((p.position - frame.position).dot(axis) / through, -1.0, 1.0), first(), last());
  }
  return place;
}

void SpanAxis::attach(double place, const Vector3& offset, Contact& contact) const {
  const int n = span_.segments(), first = span_.first_segment;
  if (place <= 0 || place >= n - 1) {
    contact.segment = first + (place <= 0 ? 0 : n - 1);
    contact.other = -1;
    return;
  }
  const int i = std::min(static_cast<int>(place), n - 2), a = first + i;
  const double u = place - i, lean = u * (1 - u) * span_.segment_length / 2;
  contact.segment = a;
  if (u <= 0) return;
  contact.other = a + 1;
  contact.share = u;
  contact.arm = lean * tangent(state_.orientation[a]) + (1 - u) * offset;
  contact.other_arm = -lean * tangent(state_.orientation[a + 1]) + u * offset;
}

namespace {

/// One edge of a ring: a circle about z of the frame.
class Edge {
 public:
  Edge(const SpanAxis& axis, const Frame& frame, double radius, double hose_radius)
      : axis_(axis), frame_(frame), radius_(radius), hose_radius_(hose_radius), z_(tangent(frame.orientation)) {}

  /// Finds the contacts on both sides of the direction in which the axis is off centre and, for an inclined axis, on both sides
  /// of its inclination.
  void find(double passage, const Contact& ring, double margin, std::vector<Contact>& contacts) const {
    const SpanAxis::Point p = axis_.at(passage);
    const Vector3 off = across(p.position - frame_.position), askew = across(p.slope) / p.slope.norm();
    std::vector<Vector3> sides;
    for (const auto& [way, least] : {std::pair{off, 1e-9}, std::pair{askew, 1e-3}})
      if (way.norm() > least)
        for (const double sign : {1.0, -1.0}) lean(sign * way.normalized(), passage, ring, margin, sides, contacts);
  }

 private:
  Vector3 across(const Vector3& v) const { return v - v.dot(z_) * z_; }

  void lean(Vector3 side, double place, Contact contact, double margin, std::vector<Vector3>& sides,
            std::vector<Contact>& contacts) const {
    Vector3 edge, on_axis;
    for (int k = 0; k < alternations; ++k) {
      edge = frame_.position + radius_ * side;
      place = axis_.nearest(edge, place);
      on_axis = axis_.at(place).position;
      const Vector3 next = across(on_axis - frame_.position);
      if (next.dot(side) <= 0) break;  // the far side is a minimum only if the axis is inclined
      const double size = next.norm();
      if (size < 1e-6 * radius_) break;
      side = next / size;
    }
    for (const Vector3& known : sides)
      if (known.dot(side) > same_side) return;
    const Vector3 way = on_axis - edge;
    const bool outside = across(on_axis - frame_.position).norm() > radius_;
    const double distance = outside ? -way.norm() : way.norm();
    contact.depth = hose_radius_ - distance;
    if (contact.depth < -margin || way.norm() < 1e-9) return;
    contact.normal = way / distance;
    contact.point = on_axis - hose_radius_ * contact.normal;
    axis_.attach(place, -hose_radius_ * contact.normal, contact);
    sides.push_back(side);
    contacts.push_back(contact);
  }

  const SpanAxis& axis_;
  const Frame frame_;
  const double radius_, hose_radius_;
  const Vector3 z_;
};

}  // namespace

void find_ring_contacts(const Rod& rod, const RodState& state, const RingShape& ring, const Frame& frame, int number,
                        double margin, double& place, std::vector<Contact>& contacts) {
  const Span& span = rod.spans()[ring.span];
  const SpanAxis axis(state, span);
  Contact contact;
  contact.obstacle = first_ring - number;
  contact.friction = ring.friction;
  const Vector3 z = tangent(frame.orientation);
  const auto at_edge = [&](double offset) {
    const Frame edge{frame.position + offset * z, frame.orientation};
    const double along = offset / span.segment_length;
    Edge(axis, edge, ring.radius, span.properties.diameter / 2)
        .find(axis.nearest(edge.position, place + along), contact, margin, contacts);
  };
  place = std::isnan(place) ? axis.passage(frame) : axis.nearest(frame.position, place);
  if (ring.width == 0) return at_edge(0);
  at_edge(-ring.width / 2);
  at_edge(ring.width / 2);
}

}  // namespace dresslife::sim
