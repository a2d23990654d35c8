// RAPID's records, and the speeds and zones that every controller knows by name. Units as in RAPID: mm, deg.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/program/interpreter.h"

namespace dresslife::sim {

void add_rapid_types(Code& code);
std::optional<Value> rapid_speed(const Code& code, const std::string& name);
std::optional<Value> rapid_zone(const Code& code, const std::string& name);
/// What a variable holds before anything is assigned to it: zeros.
Value rapid_initial(const Code& code, const std::string& type, int depth = 0);
/// Input, output and logic, sorted.
const std::vector<std::string>& harmless_rapid_instructions();

}  // namespace dresslife::sim
