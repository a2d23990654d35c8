// The terminal on which a person reads.
#pragma once

#include <cstddef>

namespace dresslife::pipeline {

/// Returns the number of columns for texts: those of the terminal that shows standard output or standard error, at least 60 and at
/// most 120, because longer lines are hard to read; 120 without a terminal, so that files do not depend on one.
std::size_t screen_columns();

}  // namespace dresslife::pipeline
