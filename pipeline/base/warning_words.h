// The text of a warning: problem, cause and remedy.
#pragma once

#include "pipeline/base/warnings.h"

namespace dresslife::pipeline {

/// Returns a warning in the form of every stage: "WHAT. Likely cause: CAUSE. Remedy: REMEDY". what: the part, the value with its
/// limit, the place and the time, if they apply. remedy: a key with a value that would solve the problem.
Warning warning_of(WarningKind kind, std::string where, const std::string& what, const std::string& cause,
                   const std::string& remedy);

}  // namespace dresslife::pipeline
