#include "pipeline/settings/units.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>

#include "pipeline/base/constants.h"

namespace dresslife::pipeline {
namespace {

/// A unit that no key has. One of it is `factor` in the unit `known`.
struct ForeignUnit {
  std::string_view suffix, known;
  double factor;
};
constexpr double inch = 25.4;  // [mm]
constexpr ForeignUnit foreign_units[] = {{"cm", "mm", 10},
                                         {"um", "mm", 1e-3},
                                         {"inch", "mm", inch},
                                         {"in", "mm", inch},
                                         {"ft", "m", 0.3048},
                                         {"cm2", "mm2", 100},
                                         {"rad", "deg", 1 / degree},
                                         {"rad_per_s", "deg_per_s", 1 / degree},
                                         {"rad_per_m", "deg_per_m", 1 / degree},
                                         {"min", "s", 60},
                                         {"us", "ms", 1e-3},
                                         {"m_per_s", "mm_per_s", 1e3},
                                         {"kHz", "Hz", 1e3},
                                         {"g", "kg", 1e-3},
                                         {"g_per_m", "kg_per_m", 1e-3},
                                         {"kg_per_km", "kg_per_m", 1e-3},
                                         {"kN", "N", 1e3},
                                         {"N_per_mm", "N_per_m", 1e3},
                                         {"Nmm2", "Nm2", 1e-6},
                                         {"bar", "MPa", 0.1},
                                         {"N_per_mm2", "MPa", 1},
                                         {"1_per_mm", "1_per_m", 1e3},
                                         {"days", "hours", 24},
                                         {"years", "hours", 8760}};

/// Returns the base unit of a kind, such as length or time. Empty: no other unit is of this kind.
std::string_view base_of(std::string_view suffix) {
  struct Kind {
    std::string_view suffix, base;
  };
  for (const Kind& kind : {Kind{"mm", "m"}, Kind{"ms", "s"}, Kind{"mm_per_s", "m_per_s"}, Kind{"mm_per_s2", "m_per_s2"},
                           Kind{"GPa", "MPa"}, Kind{"N_per_m2", "MPa"}})
    if (kind.suffix == suffix) return kind.base;
  return suffix;
}

constexpr Unit dimensionless{"", "", 1, 1e12};
constexpr std::array units{
    Unit{"m", "m", 1, 1e3},  // a hall
    Unit{"mm", "mm", 1e-3, 1e6},
    Unit{"mm2", "mm2", 1e-6, 1e12},
    Unit{"mm3", "mm3", 1e-9, 1e9},
    Unit{"deg", "deg", degree, 1e6},          // 2,800 turns of an endless axis
    Unit{"deg_per_s", "deg/s", degree, 1e5},  // a grinding spindle
    Unit{"deg_per_s2", "deg/s2", degree, 1e7},
    Unit{"deg_per_s3", "deg/s3", degree, 1e9},  // 1e7 deg/s2 within 10 ms
    Unit{"mm_per_s", "mm/s", 1e-3, 1e6},
    Unit{"mm_per_s2", "mm/s2", 1e-3, 1e8},
    Unit{"s", "s", 1, 1e6},  // twelve days of one repeat
    Unit{"ms", "ms", 1e-3, 1e9},
    Unit{"Hz", "Hz", 1, 1e5},
    Unit{"m_per_s2", "m/s2", 1, 1e3},  // a hundred times the earth's
    Unit{"m_per_s3", "m/s3", 1, 1e6},  // 1e3 m/s2 within a millisecond
    Unit{"1_per_m", "1/m", 1, 1e4},
    Unit{"deg_per_m", "deg/m", degree, 1e6},
    Unit{"kg", "kg", 1, 1e5},
    Unit{"kg_per_m", "kg/m", 1, 1e4},
    Unit{"N", "N", 1, 1e10},  // E A of a steel bar of 0.25 m
    Unit{"N_per_m", "N/m", 1, 1e10},
    Unit{"N_per_m2", "N/m2", 1, 1e15},
    Unit{"Ns_per_m", "N s/m", 1, 1e8},
    Unit{"Nm2", "N m2", 1, 1e7},  // E I of the same bar
    Unit{"mNm", "mN m", 1e-3, 1e9},
    Unit{"MPa", "MPa", 1e6, 1e7},
    Unit{"bar", "bar", 1e5, 1e5},
    Unit{"GPa", "GPa", 1e9, 1e4},                // diamond: 1e3
    Unit{"mm3_per_Nm", "mm3/(N m)", 1e-9, 1e3},  // abrasive cloth: 0.1
    Unit{"C", "C", 1, 1e4},
    Unit{"MB", "MB", 1e6, 1e7},
    Unit{"percent", "%", 1, 1e6},
    Unit{"hours_per_week", "h/week", 1, 168},
    Unit{"hours", "h", 1, 1e7},  // a thousand years; the limit of every time in hours
};

}  // namespace

const Unit& unit_of_key(std::string_view key) {
  const Unit* longest = &dimensionless;
  for (const Unit& unit : units)
    if (key.size() > unit.suffix.size() + 1 && key.back() == unit.suffix.back() && key.ends_with(unit.suffix) &&
        key[key.size() - unit.suffix.size() - 1] == '_' && unit.suffix.size() > longest->suffix.size())
      longest = &unit;
  return *longest;
}

std::string_view stem_of_key(std::string_view key) {
  const Unit& unit = unit_of_key(key);
  return unit.suffix.empty() ? key : key.substr(0, key.size() - unit.suffix.size() - 1);
}

double square_mm_of_awg(double gauge) {
  const double diameter =
      0.127 * std::pow(92.0, (36 - gauge) / 39);  // [mm], by the definition of the gauge (ASTM B258)
  return std::numbers::pi / 4 * diameter * diameter;
}

std::string converted_text(std::string_view written, double value, std::string_view known) {
  const Unit& to = unit_of_key(known);
  if (to.suffix.empty()) return "";
  const std::string stem(stem_of_key(known));
  const auto text = [&](double converted) { return fmt::format("{}: {:.4g}", known, converted); };
  if (written == "awg" || written == stem + "_awg") return to.suffix == "mm2" ? text(square_mm_of_awg(value)) : "";
  if (!written.starts_with(stem + "_")) return "";
  const std::string_view suffix = written.substr(stem.size() + 1);
  for (const ForeignUnit& unit : foreign_units)
    if (unit.suffix == suffix)
      for (const Unit& of : units)
        if (of.suffix == unit.known && base_of(of.suffix) == base_of(to.suffix))
          return text(value * unit.factor * of.to_si / to.to_si);
  for (const Unit& of : units)
    if (of.suffix == suffix && base_of(suffix) == base_of(to.suffix)) return text(value * of.to_si / to.to_si);
  return "";
}

Meant meant_length(std::string_view key, double value, double low, double high) {
  struct Slip {
    double factor;
    const char *cause, *condition;
  };
  constexpr Slip slips[] = {{10, "a missing digit, or centimetres", "a digit is missing"},
                            {1e3, "metres instead of millimetres", "that was metres"},
                            {inch, "inches instead of millimetres", "that was inches"},
                            {0.1, "an extra zero", "there is an extra zero"},
                            {1e-3, "micrometres instead of millimetres", "that was micrometres"}};
  Meant meant;
  for (const Slip& slip : slips) {
    const double other = value * slip.factor;
    if (!(other >= low && other <= high)) continue;
    meant.remedy += meant.remedy.empty() ? fmt::format("{}: {:.4g} if {}", key, other, slip.condition)
                                         : fmt::format(", {:.4g} if {}", other, slip.condition);
    if (meant.cause.empty()) meant.cause = slip.cause;
  }
  return meant;
}

std::string shortest_text(double value) { return fmt::format("{}", value); }

std::string text_in_unit(double si, const Unit& unit) {
  // A value from a text is x * to_si for a decimal x with few digits. Then si / to_si differs from x by at most two roundings,
  // 2.3e-16 relative. Decimals of up to 15 digits are at least 1e-15 apart, so x is the nearest one. A longer x is a rounded
  // value of the quotient or of one of its neighbours.
  using Limits = std::numeric_limits<double>;
  const double near = si / unit.to_si;
  // For most values, x is the quotient itself; then its text is short.
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
