#include "sim/program/interpreter/passes.h"

#include <algorithm>
#include <tuple>

namespace dresslife::sim {
namespace {

constexpr int repeats_for_certainty = 3;

/// Whether two moves give the same motion; their lines may differ.
bool alike_moves(const Instruction& a, const Instruction& b) {
  const auto same_pose = [](const Frame& x, const Frame& y) {
    return x.position == y.position && x.orientation.coeffs() == y.orientation.coeffs();
  };
  const auto settings = [](const Instruction& i) {
    return std::tie(i.kind, i.target.joints, i.target.circle_joints, i.target.configuration, i.target.external_axes,
                    i.tool, i.work_object, i.speed.axis_percent, i.speed.axis, i.speed.tool, i.speed.orientation,
                    i.speed.duration, i.speed.axis_acceleration, i.speed.tool_acceleration, i.zone.distance,
                    i.zone.percent, i.acceleration_percent, i.jerk_percent, i.dwell);
  };
  return settings(a) == settings(b) && same_pose(a.target.pose, b.target.pose) && same_pose(a.via, b.via);
}

}  // namespace

void Passes::add(std::uint64_t state) {
  ends_.push_back(moves_->size());
  states_.push_back(state);
}

bool Passes::same_motion(std::size_t a, std::size_t b) const {
  const auto at = [&](std::size_t pass) { return moves_->begin() + static_cast<long>(ends_[pass]); };
  return std::equal(at(a - 1), at(a), at(b - 1), at(b), alike_moves);
}

bool Passes::repeats() const {
  const std::size_t last = count();
  for (std::size_t pass = 1; pass < last; ++pass)
    if (states_[pass - 1] == states_[last - 1] && same_motion(pass, last)) return true;
  return false;
}

template <class Same>
std::size_t Passes::period(const Same& same) const {
  const std::size_t last = count();
  for (std::size_t period = 1; period * (repeats_for_certainty + 1) <= last; ++period) {
    std::size_t first =
        last - period;  // one before the first pass from which each pass equals the pass one period later
    while (first >= 1 && same(first, first + period)) --first;
    if (first + 1 + repeats_for_certainty * period <= last) return first + period;
  }
  return 0;
}

std::size_t Passes::by_motion() const {
  return period([this](std::size_t a, std::size_t b) { return same_motion(a, b); });
}

std::set<Passes::Line> Passes::lines(std::size_t begin, std::size_t end) const {
  std::set<Line> found;
  for (std::size_t i = begin; i < end; ++i) found.emplace((*moves_)[i].where.file, (*moves_)[i].where.line);
  return found;
}

std::size_t Passes::by_lines() const {
  std::vector<std::set<Line>> of;
  for (std::size_t pass = 1; pass <= count(); ++pass) of.push_back(lines(ends_[pass - 1], ends_[pass]));
  return period([&](std::size_t a, std::size_t b) { return of[a - 1] == of[b - 1]; });
}

bool Passes::only_lines_of_the_first() const {
  const std::set<Line> first = lines(ends_[0], ends_[1]), later = lines(ends_[1], ends_.back());
  return std::includes(first.begin(), first.end(), later.begin(), later.end());
}

std::size_t Passes::kept(std::size_t wanted) const {
  if (wanted) return wanted;
  if (repeats()) return count() - 1;
  if (const std::size_t periodic = by_motion()) return periodic;
  if (const std::size_t periodic = by_lines()) return periodic;
  if (count() > 1 && !only_lines_of_the_first()) return count();
  std::size_t first = 1;  // first pass with a move
  while (first < count() && end(first) == end(0)) ++first;
  return first;
}

std::string passes_text(long passes) { return passes == 1 ? "one pass" : fmt::format("{} passes", passes); }

}  // namespace dresslife::sim
