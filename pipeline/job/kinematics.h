// Geometry of nested helices (strain/theory.md, W5 to W9).
#pragma once

#include <string_view>

#include "pipeline/base/words.h"

namespace dresslife::pipeline {

enum class Kinematics { exact, thesis };
constexpr std::string_view word(Kinematics value) { return word_at({"exact", "thesis"}, value); }
/// Returns whether (12) to (23) are used as printed in the thesis; otherwise the exact geometry is used.
constexpr bool is_thesis(Kinematics value) { return value == Kinematics::thesis; }

}  // namespace dresslife::pipeline
