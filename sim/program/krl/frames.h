// KUKA's positions: frames {X, Y, Z, A, B, C} with angles about z, y', x'' and axis angles {A1 .. A6}. A program may
// omit components.
#pragma once

#include <algorithm>
#include <array>

#include "pipeline/base/constants.h"
#include "sim/program/interpreter/interpreter.h"

namespace dresslife::sim {

namespace krl {

constexpr const char* axis_names[] = {"a1", "a2", "a3", "a4", "a5", "a6"};
constexpr const char* frame_names[] = {"x", "y", "z", "a", "b", "c"};
constexpr const char* external_names[] = {"e1", "e2", "e3", "e4", "e5", "e6"};

/// Six numbers of a record [mm and deg], and whether the record contains each of them.
struct Coordinates {
  std::array<double, 6> numbers{};
  std::array<bool, 6> given{};
  Value unknown;  ///< unknown component with its causes; a known value: no component is unknown
  bool any() const {
    return std::ranges::any_of(given, [](bool g) { return g; });
  }
  bool all() const {
    return std::ranges::all_of(given, [](bool g) { return g; });
  }
};

/// Returns the value of a variable that is declared and not assigned.
Value unset_value();
bool is_unset(const Value& value);  ///< true: the value and all its items are unset

Coordinates coordinates(const Value& record, const char* const (&names)[6]);
Frame frame_from(const std::array<double, 6>& numbers);
std::array<double, 6> numbers_of(const Frame& frame);

}  // namespace krl

}  // namespace dresslife::sim
