#include "pipeline/settings/units.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>

namespace dresslife::pipeline {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr Unit dimensionless{"", "", 1, 1e12};
constexpr std::array units{
    Unit{"m", "m", 1, 1e3},  // a hall
    Unit{"mm", "mm", 1e-3, 1e6},
    Unit{"mm2", "mm2", 1e-6, 1e12},
    Unit{"deg", "deg", degree, 1e6},          // 2,800 turns of an endless axis
    Unit{"deg_per_s", "deg/s", degree, 1e5},  // a grinding spindle
    Unit{"deg_per_s2", "deg/s2", degree, 1e7},
    Unit{"mm_per_s", "mm/s", 1e-3, 1e6},
    Unit{"mm_per_s2", "mm/s2", 1e-3, 1e8},
    Unit{"s", "s", 1, 1e6},  // twelve days of one repeat
    Unit{"ms", "ms", 1e-3, 1e9},
    Unit{"Hz", "Hz", 1, 1e5},
    Unit{"m_per_s2", "m/s2", 1, 1e3},  // a hundred times the earth's
    Unit{"1_per_m", "1/m", 1, 1e4},
    Unit{"deg_per_m", "deg/m", degree, 1e6},
    Unit{"kg", "kg", 1, 1e5},
    Unit{"kg_per_m", "kg/m", 1, 1e4},
    Unit{"N", "N", 1, 1e10},  // E A of a steel bar of 0.25 m
    Unit{"N_per_m", "N/m", 1, 1e10},
    Unit{"N_per_m2", "N/m2", 1, 1e15},
    Unit{"Ns_per_m", "N s/m", 1, 1e8},
    Unit{"Nm2", "N m2", 1, 1e7},  // E I of the same bar
    Unit{"MPa", "MPa", 1e6, 1e7},
    Unit{"GPa", "GPa", 1e9, 1e4},  // diamond: 1e3
    Unit{"mm3_per_Nm", "mm3/(N m)", 1e-9, 1e3},  // abrasive cloth: 0.1
    Unit{"MB", "MB", 1e6, 1e7},
    Unit{"percent", "%", 1, 1e6},
    Unit{"hours_per_week", "h/week", 1, 168},
    Unit{"hours", "h", 1, 1e7},  // as hours everywhere: a thousand years
};

}  // namespace

const Unit& unit_of_key(std::string_view key) {
  const Unit* longest = &dimensionless;
  for (const Unit& unit : units)
    if (key.size() > unit.suffix.size() + 1 && key.back() == unit.suffix.back() &&
        key.ends_with(unit.suffix) && key[key.size() - unit.suffix.size() - 1] == '_' &&
        unit.suffix.size() > longest->suffix.size())
      longest = &unit;
  return *longest;
}

std::string_view stem_of_key(std::string_view key) {
  const Unit& unit = unit_of_key(key);
  return unit.suffix.empty() ? key : key.substr(0, key.size() - unit.suffix.size() - 1);
}

std::string shortest_text(double value) { return fmt::format("{}", value); }

std::string text_in_unit(double si, const Unit& unit) {
  // A value that came from text is x * to_si for some short x, of which si / to_si is within two
  // roundings, 2.3e-16. Decimals of up to 15 digits lie 1e-15 and more apart: such an x is the nearest of
  // them. Of more digits it is one of the roundings of the quotient's neighbours.
  using Limits = std::numeric_limits<double>;
  const double near = si / unit.to_si;
  // Most are the quotient itself, and tell so by being short.
  if (std::string text = shortest_text(near);
      near * unit.to_si == si && (unit.to_si == 1 || text.size() <= Limits::digits10))
    return text;
  for (int digits = Limits::digits10; digits <= Limits::max_digits10; ++digits)
    for (const double x : {near, std::nextafter(near, INFINITY), std::nextafter(near, -INFINITY)}) {
      const double rounded = std::strtod(fmt::format("{:.{}g}", x, digits).c_str(), nullptr);
      if (rounded * unit.to_si == si) return shortest_text(rounded);
    }
  return shortest_text(near);
}

}  // namespace dresslife::pipeline
