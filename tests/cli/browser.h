// Opens pages in headless Chromium if Chromium is installed.
#pragma once

#include <fmt/format.h>

#include "pipeline/report/page_shell.h"
#include "tests/catch.h"
#include "tests/cli/process.h"

namespace dresslife::tests {

/// Opens `page` in a browser and runs `script` (see browser.js). Returns JSON: the script's result, the console's errors and
/// the requests. Without a browser: returns "" and prints a warning.
inline std::string in_browser(const Scratch& scratch, const std::string& page, const std::string& script) {
  if (run_shell(scratch, "command -v chromium && command -v node").status != 0) {
    WARN("chromium or node is not installed: the page is not tried in a browser");
    return "";
  }
  if (!fs::exists(dresslife::pipeline::three_folder() / "three.min.js")) {
    WARN("libjs-three is not installed: the page is not tried in a browser");
    return "";
  }
  scratch.write("script.js", script);
  const Outcome seen = run_shell(
      scratch,
      fmt::format("timeout 300 node '{}/tests/cli/browser.js' \"$(command -v chromium)\" '{}' \"$(cat script.js)\"",
                  DRESSLIFE_SOURCE_DIR, (scratch / page).string()));
  INFO(seen.err);
  REQUIRE(seen.status == 0);
  return seen.out;
}

inline std::string result_of(const std::string& seen) {
  const std::string begin = "{\"result\":\"";
  REQUIRE(seen.rfind(begin, 0) == 0);
  return seen.substr(begin.size(), seen.find('"', begin.size()) - begin.size());
}

}  // namespace dresslife::tests
