#include "sim/contact/self_contact.h"

#include <algorithm>
#include <limits>
#include <numbers>

namespace dresslife::sim {
namespace {

// Neighbouring centres are at most this many lengths apart; a hose is stopped at 2 % elongation.
constexpr double stretched = 1.1;
// At a smaller share of the diameter the distance of two axes has no defined direction.
constexpr double coincident = 1e-6;

class Search {
 public:
  Search(const Rod& rod, const RodState& state, double reach, std::vector<Contact>& contacts)
      : rod_(rod), state_(state), reach_(reach), contacts_(contacts) {}

  double run() {
    const auto& spans = rod_.spans();
    for (size_t a = 0; a < spans.size(); ++a)
      for (size_t b = a; b < spans.size(); ++b) run(spans[a], spans[b]);
    return clear_;
  }

 private:
  void run(const Span& a, const Span& b) {
    const double l = b.segment_length, half_lengths = (a.segment_length + l) / 2;
    diameter_ = (a.properties.diameter + b.properties.diameter) / 2;
    near_ = diameter_ + reach_;
    const double step = stretched * l;
    const bool same = a.dresspack == b.dresspack;
    const double neighbourhood = std::numbers::pi / 2 * diameter_;  // along the hose, between the nearer ends
    const int end = b.first_segment + b.segments();
    for (int i = a.first_segment; i < a.first_segment + a.segments(); ++i) {
      int j = b.first_segment;
      if (same) j += std::max(0, static_cast<int>((a.arc(i) + neighbourhood - b.first_arc) / l + 1.5));
      for (; j < end;) {
        const double free_way = (state_.position[j] - state_.position[i]).norm() - half_lengths - near_;
        if (free_way < 0) touch(i, j);
        // Skipped segments are at least a step away.
        clear_ = std::min(clear_, reach_ + std::min(free_way, step));
        j += std::max(1, static_cast<int>(free_way / step));
      }
    }
  }

  /// Half of a segment, from its centre.
  Vector3 arm(int segment) const {
    return (rod_.span_of(segment).segment_length / 2) * tangent(state_.orientation[segment]);
  }

  // Adds the nearest points, and for pieces side by side each end against the other piece, because a piece on one point would
  // rock.
  void touch(int i, int j) {
    const Vector3 arm_i = arm(i), arm_j = arm(j);
    const Vector3 a0 = state_.position[i] - arm_i, a1 = state_.position[i] + arm_i;
    const Vector3 b0 = state_.position[j] - arm_j, b1 = state_.position[j] + arm_j;
    const size_t first = contacts_.size();
    const NearestPoints nearest = nearest_points(a0, a1, b0, b1);
    keep(i, j, a0 + nearest.a * (a1 - a0), b0 + nearest.b * (b1 - b0), first);
    for (const Vector3& end : {a0, a1}) along(i, j, end, b0, b1, first, true);
    for (const Vector3& end : {b0, b1}) along(i, j, end, a0, a1, first, false);
  }

  void along(int i, int j, const Vector3& end, const Vector3& from, const Vector3& to, size_t first, bool of_i) {
    const Vector3 way = to - from;
    const double share = (end - from).dot(way) / way.squaredNorm();
    if (share <= 0 || share >= 1) return;
    const Vector3 foot = from + share * way;
    keep(i, j, of_i ? end : foot, of_i ? foot : end, first);
  }

  void keep(int i, int j, const Vector3& on_i, const Vector3& on_j, size_t first) {
    const Vector3 way = on_i - on_j;
    const double distance = way.norm();
    if (distance > near_ || distance < coincident * diameter_) return;
    Contact contact;
    contact.segment = i, contact.other = j, contact.obstacle = hose_obstacle;
    contact.normal = way / distance;
    contact.depth = diameter_ - distance;
    contact.point = (on_i + on_j) / 2;
    for (size_t k = first; k < contacts_.size(); ++k)
      if ((contacts_[k].point - contact.point).norm() < rod_.span_of(i).segment_length / 4) return;
    contacts_.push_back(contact);
  }

  const Rod& rod_;
  const RodState& state_;
  const double reach_;
  std::vector<Contact>& contacts_;
  double diameter_ = 0, near_ = 0;  // of the two present spans
  double clear_ = std::numeric_limits<double>::infinity();
};

}  // namespace

NearestPoints nearest_points(const Vector3& a0, const Vector3& a1, const Vector3& b0, const Vector3& b1) {
  const Vector3 u = a1 - a0, v = b1 - b0, w = a0 - b0;
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v), uw = u.dot(w), vw = v.dot(w);
  const double determinant = uu * vv - uv * uv;
  constexpr double parallel = 1e-12;  // sin^2 of the angle between them
  const auto on = [](double numerator, double length2) {
    return length2 > 0 ? std::clamp(numerator / length2, 0.0, 1.0) : 0.0;
  };
  NearestPoints nearest;
  nearest.a = determinant > parallel * uu * vv ? std::clamp((uv * vw - vv * uw) / determinant, 0.0, 1.0) : 0.5;
  nearest.b = on(vw + nearest.a * uv, vv);
  nearest.a = on(nearest.b * uv - uw, uu);
  return nearest;
}

double find_self_contacts(const Rod& rod, const RodState& state, double reach, std::vector<Contact>& contacts) {
  return Search(rod, state, reach, contacts).run();
}

}  // namespace dresslife::sim
