// The words of a warning: what is wrong, why, and what to do.
#pragma once

#include "pipeline/base/warnings.h"

namespace dresslife::pipeline {

/// A warning as every stage writes it: "WHAT. Likely cause: CAUSE. Remedy: REMEDY". what: the part, the value with its
/// limit, the place and the time, as far as they apply. remedy: a key with a value that would cure it.
Warning warning_of(WarningKind kind, std::string where, const std::string& what, const std::string& cause,
                   const std::string& remedy);

}  // namespace dresslife::pipeline
