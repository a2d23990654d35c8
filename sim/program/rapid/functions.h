// RAPID's functions of values alone: arithmetic, texts, poses. Units as in RAPID: mm, deg.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/program/interpreter/interpreter.h"

namespace dresslife::sim {

// ---- between RAPID's records and frames; the values' shapes have been checked
// ------------------------------

Vector3 rapid_position(const Value& pos);
/// Written with a few digits, hence normalised; absent when it is none.
std::optional<Quaternion> rapid_orientation(const Value& orient);
std::optional<Frame> rapid_frame(const Value& pose);
Value rapid_pos(const Code& code, const Vector3& position);
Value rapid_orient(const Code& code, const Quaternion& orientation);
Value rapid_pose(const Code& code, const Frame& frame);

/// An argument of a function: its name where it was given by name (\Rx), and its value.
struct RapidArgument {
  std::string option;
  Value value;
};

/// Absent: there is no such function. An unknown value: its arguments are unknown.
std::optional<Value> rapid_function(const Code& code, const std::string& name,
                                    const std::vector<RapidArgument>& arguments);

/// Functions whose value depends on the robot, the operator or the clock, sorted.
bool rapid_asks_the_robot(const std::string& function);

/// The number of an item of a list. Precondition: the list has the item.
inline double item_number(const Value& list, std::size_t i) { return list.items[i].number; }

}  // namespace dresslife::sim
