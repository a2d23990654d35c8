// RAPID's records, and the predefined speeds and zones of every controller. Units as in RAPID: mm, deg.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/program/interpreter/interpreter.h"

namespace dresslife::sim {

void add_rapid_types(Code& code);
std::optional<Value> rapid_speed(const Code& code, const std::string& name);
std::optional<Value> rapid_zone(const Code& code, const std::string& name);
/// Returns the value of a variable before its first assignment: zeros.
Value rapid_initial(const Code& code, const std::string& type, int depth = 0);
/// Whether an instruction is one of input, output and logic.
bool is_harmless_in_rapid(const std::string& instruction);
/// Returns the possible effect of a skipped instruction on the motion; null: not known.
const char* rapid_named_effect(const std::string& instruction);

}  // namespace dresslife::sim
