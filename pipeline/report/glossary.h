// The words of tables, pages and warnings with their meanings, for the end of every HTML page.
#pragma once

#include <span>
#include <string>

namespace dresslife::pipeline {

struct GlossaryEntry {
  const char* word;
  const char* meaning;
};

/// Sorted by word.
std::span<const GlossaryEntry> glossary();

/// The end of a page: a closed list, with the anchor #words.
std::string glossary_html();

}  // namespace dresslife::pipeline
