// The user's options (values, choices, the routine and its arguments), read as expressions of the program's
// language.
#pragma once

#include "sim/program/interpreter/code.h"
#include "sim/program/interpreter/parser.h"

namespace dresslife::sim {

/// Returns the key of a value: lower case, no blanks, indices in the form of path_of() ("z[2][3]").
std::string value_key(const std::string& name);

/// Fills code.values, choices, start and start_arguments. An option that cannot be read becomes a problem.
void add_requests(Code& code, const ImportOptions& options, Grammar grammar, Problems& problems);

/// Splits "name(a, b)" or "name a, b" into name and arguments, both as written.
std::pair<std::string, std::string> routine_and_arguments(const std::string& written);

}  // namespace dresslife::sim
