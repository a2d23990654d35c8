// RAPID's functions that depend only on their arguments: arithmetic, texts, poses. Units as in RAPID: mm, deg.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/program/interpreter/interpreter.h"

namespace dresslife::sim {

// ---- conversion between RAPID's records and frames. Precondition: the values have the right shape. ----------

Vector3 rapid_position(const Value& pos);
/// Returns the orientation as it is written.
Quaternion rapid_quaternion(const Value& orient);
/// Returns the normalised orientation, because programs write few digits; std::nullopt: the norm differs from 1.
std::optional<Quaternion> rapid_orientation(const Value& orient);
std::optional<Frame> rapid_frame(const Value& pose);
Value rapid_pos(const Code& code, const Vector3& position);
Value rapid_orient(const Code& code, const Quaternion& orientation);
Value rapid_pose(const Code& code, const Frame& frame);

/// An argument of a function: its name if it is given by name (\Rx), and its value.
struct RapidArgument {
  std::string option;
  Value value;
};

/// Returns the value of a function; std::nullopt: no such function. An unknown value: the arguments are unknown.
std::optional<Value> rapid_function(const Code& code, const std::string& name,
                                    const std::vector<RapidArgument>& arguments);

/// Whether a function's value depends on the robot, the operator or the clock.
bool rapid_asks_the_robot(const std::string& function);

/// Returns the number of an item of a list. Precondition: the list has the item.
inline double item_number(const Value& list, std::size_t i) { return list.items[i].number; }

}  // namespace dresslife::sim
