// The text of a structure, for thousands of structures with mostly equal sections.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {

/// Keys of the root with their texts, in the order of the structure. An empty text: the key is left out.
using EchoSections = std::vector<std::pair<std::string, std::string>>;

/// Returns the sections of echo_text(). Keeps their texts of earlier calls of this thread, and finds them by digests of their
/// values. Calls `described` once or twice.
EchoSections echo_sections(const Describe& described, const PathText& path_text);
/// Returns to_yaml(echo_fields(described, path_text)).
std::string echo_text(const Describe& described, const PathText& path_text);
/// Returns a digest of everything that determines echo_fields(described).
std::string echo_digest(const Describe& described);
/// Returns the text of all sections.
std::string joined_text(const EchoSections& sections);

}  // namespace dresslife::pipeline
