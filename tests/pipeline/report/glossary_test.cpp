#include "pipeline/report/glossary.h"
#include "tests/catch.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

using namespace dresslife::pipeline;

TEST_CASE("glossary: words are sorted, each stands once, and a page of 60 lines holds them") {
  const auto lower = [](std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
  };
  std::vector<std::string> words;
  const std::string page = glossary_html();
  for (std::size_t at = page.find("<dt>"); at != std::string::npos; at = page.find("<dt>", at + 1))
    words.push_back(lower(page.substr(at + 4, page.find("</dt>", at) - at - 4)));
  for (std::size_t k = 1; k < words.size(); ++k) CHECK(words[k - 1] < words[k]);
  CHECK(words.size() > 20);
  CHECK(words.size() <= 60);
}
