#include "pipeline/report/glossary.h"
#include "tests/catch.h"

#include <algorithm>
#include <cctype>
#include <string>

using namespace dresslife::pipeline;

TEST_CASE("glossary: words are sorted, each stands once, and a page of 60 lines holds them") {
  const auto lower = [](std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
  };
  const auto entries = glossary();
  for (std::size_t k = 1; k < entries.size(); ++k) CHECK(lower(entries[k - 1].word) < lower(entries[k].word));
  CHECK(entries.size() <= 60);
  for (const GlossaryEntry& entry : entries)
    CHECK(glossary_html().find(std::string("<dt>") + entry.word + "</dt>") != std::string::npos);
}
