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
/// What an instruction that is not followed may do to the motion; null: nothing is known of it.
const char* rapid_told_effect(const std::string& instruction);

}  // namespace dresslife::sim
