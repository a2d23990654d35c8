// Values as they follow the = of --set.
#pragma once

#include <string>

#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

/// In one line, in braces and brackets, quoted where YAML needs it.
std::string set_text(const Node& value);

}  // namespace dresslife::pipeline
