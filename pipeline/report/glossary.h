// Terms of tables, pages and warnings with their meanings, printed at the end of every HTML page.
#pragma once

#include <string>

namespace dresslife::pipeline {

/// Returns the end of a page: a closed list with the anchor #words.
std::string glossary_html();

}  // namespace dresslife::pipeline
