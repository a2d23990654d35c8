// Guide rings: where the dresspack's axis passes a ring, and where it leans on the ring's edge.
//
// (S15) Between the centres x_i, x_j of two neighbouring segments the axis is the parabola
//   P(u) = (1-u)^2 x_i + 2u(1-u) J + u^2 x_j,  J = (x_i + a t_i + x_j - a t_j)/2,  a = l/2,
// which has the segments' tangents at their centres: the axis is smooth all along, so that nothing catches
// where one segment ends and the next begins. Its matter moves with
//   (1-u) v_i + u v_j + w_i x (u(1-u) a t_i) - w_j x (u(1-u) a t_j),
// and what a ring gives a point goes to both segments by the same shares. Beyond the outermost centres the
// axis is straight.
//
// The edge of a ring is a circle of its clear radius. The hose touches it where the circle's distance from
// the axis has a minimum below the hose's radius; the normal is the direction of that distance, hence across
// the tangent: without friction the ring holds nothing back. A ring with a width has an edge at either side.
#pragma once

#include <vector>

#include "sim/contact/contact.h"

namespace dresslife::sim {

struct RingShape {
  Frame frame;          ///< z = its axis, from base to tool
  double radius = 0;    ///< clear inner [m]
  double width = 0;     ///< along its axis [m]
  double friction = 0;  ///< Coulomb
  int span = 0;         ///< of the dresspack that passes it
};

/// A point of a span's axis: i + u, counted in segments from the span's first centre.
class SpanAxis {
 public:
  SpanAxis(const RodState& state, const Span& span) : state_(state), span_(span) {}

  struct Point {
    Vector3 position, slope, bend;  ///< of the axis and its first two derivatives by the place
  };
  Point at(double place) const;
  double first() const { return -0.5; }
  double last() const { return span_.segments() - 0.5; }

  /// The place nearest to a point, by Newton's method from a place near it.
  double nearest(const Vector3& to, double from) const;
  /// Where the axis passes the plane through frame's origin across its z nearest to that origin.
  double passage(const Frame& frame) const;
  /// Fills segment, other, share and arms of a contact at a place, whose surface lies at `offset` from the
  /// axis.
  void attach(double place, const Vector3& offset, Contact& contact) const;

 private:
  const RodState& state_;
  const Span& span_;
};

/// Adds the contacts of ring `number` at `frame` in the world; place: where the axis passed it last, brought
/// up to now.
void find_ring_contacts(const Rod& rod, const RodState& state, const RingShape& ring, const Frame& frame,
                        int number, double margin, double& place, std::vector<Contact>& contacts);

}  // namespace dresslife::sim
