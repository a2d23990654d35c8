#include "pipeline/settings/units.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <map>
#include <numbers>
#include <random>
#include <string>

#include "tests/catch.h"

namespace dresslife::pipeline {
namespace {

TEST_CASE("units: a value in another unit is converted into that of the key") {
  CHECK(converted_text("diameter_m", 0.05, "diameter_mm") == "diameter_mm: 50");
  CHECK(converted_text("diameter_cm", 5, "diameter_mm") == "diameter_mm: 50");
  CHECK(converted_text("diameter_inch", 2, "diameter_mm") == "diameter_mm: 50.8");
  CHECK(converted_text("free_length_mm", 2035, "free_length_m") == "free_length_m: 2.035");
  CHECK(converted_text("free_length_cm", 203.5, "free_length_m") == "free_length_m: 2.035");
  CHECK(converted_text("mass_g_per_m", 1200, "mass_kg_per_m") == "mass_kg_per_m: 1.2");
  CHECK(converted_text("dwell_ms", 500, "dwell_s") == "dwell_s: 0.5");
  CHECK(converted_text("angle_rad", 1, "angle_deg") == "angle_deg: 57.3");
  CHECK(converted_text("pressure_bar", 6, "pressure_MPa") == "pressure_MPa: 0.6");
  CHECK(converted_text("cross_section_awg", 20, "cross_section_mm2") == "cross_section_mm2: 0.5176");
  CHECK(converted_text("awg", 20, "cross_section_mm2") == "cross_section_mm2: 0.5176");
  CHECK(converted_text("awg", 20, "radius_mm").empty());
  CHECK(converted_text("diameter_s", 5, "diameter_mm").empty());  // another kind of unit
  CHECK(converted_text("length_m", 5, "diameter_mm").empty());    // another name before the unit
  CHECK(converted_text("segments_mm", 5, "segments").empty());
  CHECK(square_mm_of_awg(36) == Approx(0.01267).epsilon(1e-3));  // 0.127 mm by definition
  CHECK(square_mm_of_awg(0) == Approx(53.49).epsilon(1e-3));     // 8.252 mm
}

TEST_CASE("units: a length beyond its range is explained by the slips that bring it back") {
  const Meant digit = meant_length("least_bend_radius_mm", 11, 55, 1700);
  CHECK(digit.cause == "a missing digit, or centimetres");
  CHECK(digit.remedy == "least_bend_radius_mm: 110 if a digit is missing, 279.4 if that was inches");
  CHECK(meant_length("diameter_mm", 0.05, 5, 200).remedy == "diameter_mm: 50 if that was metres");
  CHECK(meant_length("diameter_mm", 480, 5, 200).remedy == "diameter_mm: 48 if there is an extra zero");
  CHECK(meant_length("diameter_mm", 42500, 5, 200).remedy == "diameter_mm: 42.5 if that was micrometres");
  for (const double none : {0.0, -50.0, 1e12, HUGE_VAL, std::nan("")})
    CHECK(meant_length("diameter_mm", none, 5, 200).cause.empty());
}

TEST_CASE("units: the unit of a key is its longest ending that is one") {
  CHECK(unit_of_key("radius_mm").name == "mm");
  CHECK(unit_of_key("free_length_m").name == "m");
  CHECK(unit_of_key("speed_deg_per_s").name == "deg/s");
  CHECK(unit_of_key("acceleration_deg_per_s2").name == "deg/s2");
  CHECK(unit_of_key("gravity_m_per_s2").name == "m/s2");
  CHECK(unit_of_key("bending_stiffness_Nm2").name == "N m2");
  CHECK(unit_of_key("time_step_ms").to_si == 1e-3);
  CHECK(unit_of_key("youngs_modulus_GPa").to_si == 1e9);
  CHECK(unit_of_key("segments").name.empty());
  CHECK(unit_of_key("m").name.empty());  // a unit alone is a name
  CHECK(unit_of_key("_mm").name.empty());
  CHECK(unit_of_key("stemm").name.empty());
}

TEST_CASE("units: each factor to SI is that of the parts of its name") {
  // a prefix is a letter before a unit: mm is not m times m, and m alone is the metre
  const std::map<std::string, double> parts{
      {"m", 1},     {"mm", 1e-3}, {"deg", M_PI / 180}, {"s", 1}, {"ms", 1e-3}, {"Hz", 1}, {"kg", 1}, {"N", 1},
      {"mN", 1e-3}, {"MPa", 1e6}, {"GPa", 1e9},        {"C", 1}, {"MB", 1e6},  {"%", 1},  {"h", 1},  {"week", 1},
      {"1", 1}};
  for (const std::string suffix :
       {"m",         "mm",        "mm2",      "mm3",        "deg",     "deg_per_s", "deg_per_s2", "deg_per_s3",
        "mm_per_s",  "mm_per_s2", "s",        "ms",         "Hz",      "m_per_s2",  "m_per_s3",   "1_per_m",
        "deg_per_m", "kg",        "kg_per_m", "N",          "N_per_m", "N_per_m2",  "Ns_per_m",   "Nm2",
        "mNm",       "MPa",       "GPa",      "mm3_per_Nm", "C",       "MB",        "percent",    "hours_per_week",
        "hours"}) {
    const Unit& unit = unit_of_key("key_" + suffix);
    REQUIRE(unit.suffix == suffix);
    double factor = 1, sign = 1;
    const std::string name(unit.name);
    for (std::size_t at = 0; at < name.size(); ++at) {
      if (name[at] == '/') sign = -1;
      if (std::string_view("/ ()").find(name[at]) != std::string_view::npos) continue;
      const std::size_t begin = at;
      while (at + 1 < name.size() && (std::isalpha(static_cast<unsigned char>(name[at + 1])))) ++at;
      const std::string part = name.substr(begin, at + 1 - begin);
      const bool has_power = at + 1 < name.size() && std::isdigit(static_cast<unsigned char>(name[at + 1]));
      const double power = has_power ? name[++at] - '0' : 1;
      INFO(suffix << ": " << part);
      factor *= std::pow(parts.at(part), sign * power);
    }
    CHECK(unit.to_si == Approx(factor).epsilon(1e-12));
  }
}

TEST_CASE("units: the stem of a key is the key without its unit") {
  CHECK(stem_of_key("radius_mm") == "radius");
  CHECK(stem_of_key("speed_deg_per_s") == "speed");
  CHECK(stem_of_key("operating_hours_per_week") == "operating");
  CHECK(stem_of_key("gate") == "gate");
}

TEST_CASE("units: what was read in any unit is written so that it reads back exactly") {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> mantissa(-1, 1), exponent(-6, 9);
  for (const char* key : {"x_m", "x_mm", "x_deg", "x_deg_per_s", "x_ms", "x_MPa", "x_GPa", "x_percent"}) {
    const Unit& unit = unit_of_key(key);
    for (int trial = 0; trial < 20000; ++trial) {
      const double written = mantissa(random) * std::pow(10, exponent(random));
      const double si = written * unit.to_si;
      const std::string text = text_in_unit(si, unit);
      if (std::stod(text) * unit.to_si != si)
        FAIL_CHECK(key << " " << shortest_text(written) << " came back as " << text);
    }
  }
}

/// Returns the shortest text that reads back to the number, by trying all.
std::string shortest_by_trying(double si, const Unit& unit) {
  const double near = si / unit.to_si;
  for (int digits = 1; digits <= 17; ++digits)
    for (const double x : {near, std::nextafter(near, INFINITY), std::nextafter(near, -INFINITY)}) {
      const double rounded = std::strtod(fmt::format("{:.{}g}", x, digits).c_str(), nullptr);
      if (rounded * unit.to_si == si) return shortest_text(rounded);
    }
  return shortest_text(near);
}

TEST_CASE("units: no shorter text of a number reads back, whatever its digits") {
  std::mt19937_64 random(13);
  std::uniform_real_distribution<double> mantissa(-1, 1), exponent(-6, 9);
  std::uniform_int_distribution<int> digits(1, 17);
  for (const char* key : {"x_m", "x_mm", "x_deg", "x_ms", "x_MPa", "x_GPa", "x_percent"}) {
    const Unit& unit = unit_of_key(key);
    for (int trial = 0; trial < 4000; ++trial) {
      const double drawn = mantissa(random) * std::pow(10, exponent(random));
      const double si = std::stod(fmt::format("{:.{}g}", drawn, digits(random))) * unit.to_si;
      if (text_in_unit(si, unit) != shortest_by_trying(si, unit))
        FAIL_CHECK(key << " " << text_in_unit(si, unit) << " where " << shortest_by_trying(si, unit) << " reads back");
    }
  }
}

TEST_CASE("units: the least of all numbers reads back, too") {
  for (const double least : {1e-320, 5e-324, -1e-310})
    CHECK(std::strtod(text_in_unit(least, unit_of_key("x_m")).c_str(), nullptr) == least);
}

TEST_CASE("units: short numbers stay as short as they were written") {
  for (const char* text :
       {"0.1", "0.075", "18.45", "2.825", "5.3", "-65", "85.1", "1175", "33.3", "1e-09", "0.001", "100000"})
    for (const char* key : {"x_m", "x_mm", "x_deg", "x_deg_per_s2", "x_ms", "x_MPa", "x_GPa"}) {
      const Unit& unit = unit_of_key(key);
      CHECK(std::stod(text_in_unit(std::stod(text) * unit.to_si, unit)) == std::stod(text));
      CHECK(text_in_unit(std::stod(text) * unit.to_si, unit).size() <= std::string(text).size() + 2);  // "100000.0"
    }
  CHECK(text_in_unit(std::numbers::pi, unit_of_key("x_deg")) == "180");
  CHECK(text_in_unit(0, unit_of_key("x_deg")) == "0");
}

TEST_CASE("units: the shortest text of any number reads back to it") {
  std::mt19937_64 random(11);
  for (int trial = 0; trial < 100000; ++trial) {
    const std::uint64_t bits = random();
    double value;
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value)) continue;
    if (std::stod(shortest_text(std::abs(value) < 1e-300 ? 1.0 : value)) != (std::abs(value) < 1e-300 ? 1.0 : value))
      FAIL_CHECK(shortest_text(value));
  }
  CHECK(shortest_text(INFINITY) == "inf");
}

}  // namespace
}  // namespace dresslife::pipeline
