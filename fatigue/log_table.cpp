#include "fatigue/log_table.h"

#include <cassert>

namespace dresslife::fatigue {

LogTable::LogTable(double low, double high, const std::function<Point(double)>& at)
    : low_(low), high_(high), first_(std::bit_cast<std::uint64_t>(low) >> shift) {
  assert(0 < low && low < high);
  const std::uint64_t last = std::bit_cast<std::uint64_t>(high) >> shift;
  const auto node = [](std::uint64_t cell) { return std::bit_cast<double>(cell << shift); };
  cells_.reserve(last - first_ + 1);
  double x0 = node(first_);
  Point begin = at(x0);
  for (std::uint64_t cell = first_; cell <= last; ++cell) {
    const double x1 = node(cell + 1), h = x1 - x0;
    const Point end = at(x1);
    const double rise = end.y - begin.y;
    cells_.push_back({{begin.y, h * begin.slope, 3 * rise - h * (2 * begin.slope + end.slope),
                       h * (begin.slope + end.slope) - 2 * rise}});
    x0 = x1, begin = end;
  }
}

}  // namespace dresslife::fatigue
