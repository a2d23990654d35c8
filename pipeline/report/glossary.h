// Terms of tables, pages and warnings with their meanings, printed at the end of every HTML page.
#pragma once

#include <span>
#include <string>

namespace dresslife::pipeline {

struct GlossaryEntry {
  const char* word;
  const char* meaning;
};

/// Returns the entries, sorted by word.
std::span<const GlossaryEntry> glossary();

/// Returns the end of a page: a closed list with the anchor #words.
std::string glossary_html();

}  // namespace dresslife::pipeline
