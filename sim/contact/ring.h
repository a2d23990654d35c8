// Guide rings: where the dresspack's axis passes a ring, and its contacts with the ring's edge.
//
// (S15) Between the centres x_i, x_j of two neighbouring segments the axis is the parabola
//   P(u) = (1-u)^2 x_i + 2u(1-u) J + u^2 x_j,  J = (x_i + a t_i + x_j - a t_j)/2,  a = l/2,
// which has the tangents of the segments at their centres. The axis is smooth, so the contact moves continuously from one
// segment to the next. Its matter moves with
//   (1-u) v_i + u v_j + w_i x (u(1-u) a t_i) - w_j x (u(1-u) a t_j).
// A force of a ring on this point is divided between both segments by the same shares. Beyond the outermost centres the
// axis is straight.
//
// The edge of a ring is a circle with the ring's clear radius. The hose touches it where the circle's distance from the axis has
// a minimum below the hose's radius. The normal has the direction of this distance, perpendicular to the tangent: without
// friction the ring does not hold the hose along its axis. A ring with a width has an edge at each side.
#pragma once

#include <vector>

#include "sim/contact/contact.h"

namespace dresslife::sim {

struct RingShape {
  Frame frame;          ///< z = its axis, from base to tool
  double radius = 0;    ///< clear inner radius [m]
  double width = 0;     ///< along its axis [m]
  double friction = 0;  ///< Coulomb
  int span = 0;         ///< the span that passes it
};

/// The axis of a span. A place on it is i + u, counted in segments from the span's first centre.
class SpanAxis {
 public:
  SpanAxis(const RodState& state, const Span& span) : state_(state), span_(span) {}

  struct Point {
    Vector3 position, slope, bend;  ///< of the axis, and its first two derivatives with respect to the place
  };
  Point at(double place) const;
  double first() const { return -0.5; }
  double last() const { return span_.segments() - 0.5; }

  /// Returns the place nearest to a point, by Newton's method from a place near it.
  double nearest(const Vector3& to, double from) const;
  /// Returns the place where the axis passes the plane through frame's origin perpendicular to its z; the one nearest to the
  /// origin.
  double passage(const Frame& frame) const;
  /// Sets segment, other, share and arms of a contact at a place. offset: from the axis to the contact's point on the surface.
  void attach(double place, const Vector3& offset, Contact& contact) const;

 private:
  const RodState& state_;
  const Span& span_;
};

/// Adds the contacts of ring `number`. frame: of the ring in the world. place: where the axis passed the ring before; is updated.
void find_ring_contacts(const Rod& rod, const RodState& state, const RingShape& ring, const Frame& frame, int number,
                        double margin, double& place, std::vector<Contact>& contacts);

}  // namespace dresslife::sim
