// The text of a structure, for thousands of structures with mostly equal sections.
#pragma once

#include <string>

#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {

/// Returns to_yaml(echo_fields(described, path_text)). Keeps the texts of sections (keys of the root) of earlier calls of this
/// thread, and finds them by digests of their values. Calls `described` once or twice.
std::string echo_text(const Describe& described, const PathText& path_text);

}  // namespace dresslife::pipeline
