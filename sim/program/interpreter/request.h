// The user's options beside the files: values, choices, the routine and its arguments, as expressions of the
// program's language.
#pragma once

#include "sim/program/interpreter/code.h"
#include "sim/program/interpreter/parser.h"

namespace dresslife::sim {

/// Name under which a value is kept: lower case, no blanks, indices as path_of() writes them ("z[2][3]").
std::string value_key(const std::string& name);

/// Fills code.values, choices, start and start_arguments; what cannot be read becomes a problem.
void add_requests(Code& code, const ImportOptions& options, Grammar grammar, Problems& problems);

/// "name(a, b)" or "name a, b" as name and arguments, both as written.
std::pair<std::string, std::string> routine_and_arguments(const std::string& written);

}  // namespace dresslife::sim
