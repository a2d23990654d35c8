// A table of a smooth positive function of one positive argument, for the innermost loop.
//
// Nodes divide every octave [2^e, 2^(e+1)) into equal cells. The leading bits of the floating-point number x are the number of
// its cell, the trailing bits its place in the cell, so neither a logarithm nor a search is needed. In a cell the
// function is the cubic with the function's values and slopes at both ends (Hermite). Largest relative error for y = x^p:
//     |p (p-1) (p-2) (p-3)| / 384 h^4,   h = 1 / cells per octave                                     (F9)
// With the 128 cells per octave used here this is 1e-9 at p = 5, 5e-8 at p = 10 and 1.1e-6 at p = 20.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <functional>
#include <vector>

namespace dresslife::fatigue {

class LogTable {
 public:
  static constexpr int cells_per_octave_log2 = 7;

  struct Point {
    double y = 0, slope = 0;
  };
  /// Tabulates y and its slope over at least [low, high]. The function must be smooth on this range; the caller treats kinks and
  /// limits. Precondition: 0 < low < high, both normal numbers.
  LogTable(double low, double high, const std::function<Point(double)>& at);

  /// The table as plain data, for loops that read several values at a time.
  struct View {
    const double* cells = nullptr;  ///< (cell, power of the place in it); each cell starts at a multiple of 32 bytes
    std::uint64_t first = 0;        ///< number of the first cell
    double low = 0, high = 0;
  };
  View view() const { return {cells_.front().of.data(), first_, low_, high_}; }

  double low() const { return low_; }
  double high() const { return high_; }

  /// Precondition: low() <= x <= high().
  double operator()(double x) const {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    const std::array<double, 4>& c = cells_[(bits >> shift) - first_].of;
    const double t = std::bit_cast<double>(((bits << cells_per_octave_log2) & mantissa) | one) - 1;
    return c[0] + t * (c[1] + t * (c[2] + t * c[3]));
  }

 private:
  struct alignas(32) Cell {
    std::array<double, 4> of;
  };
  static constexpr int shift = 52 - cells_per_octave_log2;
  static constexpr std::uint64_t mantissa = (std::uint64_t{1} << 52) - 1;
  static constexpr std::uint64_t one = std::uint64_t{0x3ff} << 52;

  double low_, high_;
  std::uint64_t first_;
  std::vector<Cell> cells_;
};

}  // namespace dresslife::fatigue
