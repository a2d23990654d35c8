// Which geometry of nested helices counts (strain/README.md, W5 to W9).
#pragma once

#include <string_view>

#include "pipeline/base/words.h"

namespace dresslife::pipeline {

enum class Kinematics { exact, thesis };
constexpr std::string_view word(Kinematics value) { return word_at({"exact", "thesis"}, value); }
/// Whether (12) to (23) are used as they are printed; else the geometry itself.
constexpr bool is_thesis(Kinematics value) { return value == Kinematics::thesis; }

}  // namespace dresslife::pipeline
