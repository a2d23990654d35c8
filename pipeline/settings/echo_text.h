// The text of a structure by its top-level keys.
#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {

using EchoKeys = std::set<std::string, std::less<>>;
/// Keys of the root with their texts, in the order of the structure.
using EchoSections = std::vector<std::pair<std::string, std::string>>;

/// Returns the sections of to_yaml(echo_fields(described, path_text)). omitted: groups of the root that are left out.
EchoSections echo_sections(const Describe& described, const PathText& path_text, const EchoKeys& omitted = {});
/// Returns the text of all sections.
std::string joined_text(const EchoSections& sections);

}  // namespace dresslife::pipeline
