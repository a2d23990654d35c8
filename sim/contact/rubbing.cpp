#include "sim/contact/rubbing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dresslife::sim {
namespace {

constexpr double sector_width = 2 * std::numbers::pi / Rubbing::sectors;

/// Returns the place of a point beside a segment, at the begin of the step of h [s], in segments of the rod: the segment's base
/// end is at the segment's number.
double place_beside(const Rod& rod, const RodState& state, int segment, const Vector3& point, double h) {
  const Vector3 centre = state.position[segment] - h * state.velocity[segment];
  const double along = (point - centre).dot(tangent(state.orientation[segment]));
  return segment + 0.5 + std::clamp(along / rod.span_of(segment).segment_length, -0.5, 0.5);
}

}  // namespace

Rubbing::Rubbing(const Rod& rod) : rod_(rod) {
  for (int d = 0; d < rod.dresspacks(); ++d) {
    const Span& span = rod.spans()[rod.first_span(d)];
    Cells& cells = cells_.emplace_back();
    cells.first_segment = span.first_segment;
    for (int k = rod.first_span(d); k < rod.first_span(d + 1); ++k) cells.segments += rod.spans()[k].segments();
    const double cell = std::max(least_cell, cell_share * span.properties.diameter);
    cells.per_segment = std::max(1, static_cast<int>(std::lround(span.segment_length / cell)));
    cells.first = cells_in_all_;
    cells_in_all_ += cells.count();
  }
}

const Rubbing::Cells& Rubbing::cells_of(int segment) const { return cells_[rod_.span_of(segment).dresspack]; }

// place: in segments of the rod. toward: direction from the axis to the obstacle.
void Rubbing::rub(Field& field, int segment, double place, bool spread, const Vector3& toward, const RodState& state,
                  double work) {
  const Cells& cells = cells_of(segment);
  const Vector3 local = state.orientation[segment].conjugate() * toward;
  double turn = std::atan2(local.y(), local.x()) / sector_width;
  if (turn < 0) turn += sectors;
  const int sector = std::min(static_cast<int>(turn), sectors - 1);
  const double at = (place - cells.first_segment) * cells.per_segment;
  const auto put = [&](int cell, double part) {
    const int k = cells.first + std::clamp(cell, 0, cells.count() - 1);
    field.work[static_cast<size_t>(k) * sectors + sector] += part;
    field.sample[k] += part;
  };
  if (!spread) return put(static_cast<int>(at), work);
  const double length = cells.per_segment;
  const double from = std::clamp(at - length / 2, 0.0, cells.count() - length), to = from + length;
  for (int cell = static_cast<int>(from); cell < to; ++cell)
    put(cell, work * (std::min<double>(to, cell + 1) - std::max<double>(from, cell)) / length);
}

void Rubbing::add(const std::vector<Contact>& contacts, const RodState& state, double h) {
  for (const Contact& c : contacts) {
    const double work = c.normal_force * c.sliding_speed * h;
    if (!(work > 0)) continue;
    Field& field = fields_[c.obstacle];
    if (field.work.empty()) {
      field.work.resize(static_cast<size_t>(cells_in_all_) * sectors);
      field.sample.resize(cells_in_all_), field.largest.resize(cells_in_all_), field.time.resize(cells_in_all_);
    }
    if (c.obstacle <= first_ring) {
      const bool between = c.share > 0;
      const double place = between ? c.segment + 0.5 + c.share : place_beside(rod_, state, c.segment, c.point, h);
      rub(field, between && c.share > 0.5 ? c.other : c.segment, place, false, -c.normal, state, work);
      continue;
    }
    rub(field, c.segment, place_beside(rod_, state, c.segment, c.point, h), true, -c.normal, state, work);
    if (c.other >= 0) rub(field, c.other, place_beside(rod_, state, c.other, c.point, h), true, c.normal, state, work);
  }
}

void Rubbing::end_sample(double time) {
  for (auto& [obstacle, field] : fields_)
    for (size_t k = 0; k < field.sample.size(); ++k) {
      if (field.sample[k] > field.largest[k]) field.largest[k] = field.sample[k], field.time[k] = time;
      field.sample[k] = 0;
    }
}

std::vector<RubbedPatch> Rubbing::patches(const Touch& obstacles) const {
  double largest = 0;
  for (const auto& [obstacle, field] : fields_)
    largest = std::max(largest, *std::max_element(field.work.begin(), field.work.end()));
  std::vector<RubbedPatch> patches;
  for (const auto& [obstacle, field] : fields_)
    for (size_t d = 0; d < cells_.size(); ++d)
      for (int k = 0; k < cells_[d].count(); ++k) {
        const Span& span = rod_.span_of(cells_[d].first_segment + k / cells_[d].per_segment);
        const double length = span.segment_length / cells_[d].per_segment;
        const int in_span = k - (span.first_segment - cells_[d].first_segment) * cells_[d].per_segment;
        for (int sector = 0; sector < sectors; ++sector) {
          const size_t cell = static_cast<size_t>(cells_[d].first + k);
          const double work = field.work[cell * sectors + static_cast<size_t>(sector)];
          if (!(work > 1e-6 * largest)) continue;
          patches.push_back({static_cast<int>(d), span.first_arc + (in_span + 0.5) * length, length,
                             (sector + 0.5) * sector_width, sector_width, obstacles.column(obstacle), work,
                             field.time[cell]});
        }
      }
  return patches;
}

}  // namespace dresslife::sim
