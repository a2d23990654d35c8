#include "fatigue/log_table.h"

#include <cassert>

namespace dresslife::fatigue {

LogTable::LogTable(double low, double high, const std::function<double(double)>& y,
                   const std::function<double(double)>& slope)
    : low_(low), high_(high), first_(std::bit_cast<std::uint64_t>(low) >> shift) {
  assert(0 < low && low < high);
  const std::uint64_t last = std::bit_cast<std::uint64_t>(high) >> shift;
  const auto node = [](std::uint64_t cell) { return std::bit_cast<double>(cell << shift); };
  cells_.reserve(last - first_ + 1);
  double x0 = node(first_), y0 = y(x0), d0 = slope(x0);
  for (std::uint64_t cell = first_; cell <= last; ++cell) {
    const double x1 = node(cell + 1), y1 = y(x1), d1 = slope(x1), h = x1 - x0, rise = y1 - y0;
    cells_.push_back({{y0, h * d0, 3 * rise - h * (2 * d0 + d1), h * (d0 + d1) - 2 * rise}});
    x0 = x1, y0 = y1, d0 = d1;
  }
}

}  // namespace dresslife::fatigue
