// Values as text behind the = of --set.
#pragma once

#include <string>

#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

/// Returns a value in one line, in braces and brackets, quoted if YAML requires it.
std::string set_text(const Node& value);

}  // namespace dresslife::pipeline
