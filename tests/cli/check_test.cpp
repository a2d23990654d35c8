// scripts/check guards the arrows between the rooms: it refuses a copy of the tree in which one arrow is broken.

#include "tests/cli/process.h"

#include "tests/catch.h"

using namespace dresslife::tests;

namespace {

const fs::path source = DRESSLIFE_SOURCE_DIR;

/// Copies the folders with code and the pages of the current tree.
void copy_tree(const Scratch& scratch) {
  for (const char* folder : {"sim", "strain", "fatigue", "pipeline", "config", "scripts", "tests", ".ci"})
    fs::copy(source / folder, scratch / folder, fs::copy_options::recursive);
  for (const auto& file : fs::directory_iterator(source))
    if (file.is_regular_file()) fs::copy(file.path(), scratch / file.path().filename().string());
}

void add_line(const Scratch& scratch, const std::string& file, const std::string& line) {
  REQUIRE(fs::exists(scratch / file));
  scratch.write(file, content(scratch / file) + line + "\n");
}

Outcome check(const Scratch& scratch) {
  const fs::path err = scratch / ".err";
  const std::string command = "'" + (source / "scripts/check").string() + "' '" + scratch.folder().string() +
                              "' >/dev/null 2>'" + err.string() + "'";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, "", content(err)};
}

}  // namespace

TEST_CASE("scripts/check passes on the tree as it is") {
  Scratch scratch;
  copy_tree(scratch);
  const Outcome outcome = check(scratch);
  CHECK(outcome.err == "");
  CHECK(outcome.status == 0);
}

TEST_CASE("scripts/check refuses what breaks an arrow, a home or a rule, and says where") {
  struct Case {
    std::string file, line, words;
  };
  const Case cases[] = {
      {"strain/slip.cpp", "#include \"sim/rod/rod.h\"", "strain may include itself and: strain/kernels"},
      {"sim/rod/rod.h", "#include \"sim/run/simulate.h\"", "sim/rod may include itself\n"},
      {"sim/program/krl/krl.cpp", "#include \"sim/robot/robot.h\"",
       "sim/program/krl may include itself and: sim/program/interpreter"},
      {"fatigue/kernels/lockstep.h", "#include \"fatigue/damage.h\"", "fatigue/kernels may include itself and: "},
      {"pipeline/job/job.cpp", "#include \"pipeline/files/files.h\"",
       "pipeline/job may include itself and: settings base"},
      {"pipeline/base/threads.cpp", "#include \"pipeline/job/job.h\"", "pipeline/base may include itself\n"},
      {"pipeline/stage/stage.cpp", "#include \"pipeline/study/study.h\"",
       "pipeline/stage may include itself and: files resolve job settings base"},
      {"fatigue/damage.cpp", "#include <hdf5.h>", "'hdf5' is included outside its home"},
      {"sim/run/simulate.cpp", "#include <ode/ode.h>", "'ode/' is included outside its home"},
      {"pipeline/cable/helix.h", "  printf(\"x\");", "printing or exiting outside a main"},
      {"sim/README.md", "See [the rod](rod/gone.h).", "a page links to what is not there"},
      {"README.md", "It lives in `sim/gone.cpp`.", "names a file that is not there"},
      {"sim/rod/rod.h",
       "// A first line so full that a formatter with a smaller limit of columns has to wrap its last words,\n"
       "// only these\n//     before the line that was to stand below them.",
       "a formatter broke a comment"},
  };
  Scratch scratch;
  copy_tree(scratch);
  CHECK(check(scratch).status == 0);
  for (const Case& broken : cases) add_line(scratch, broken.file, broken.line);
  const Outcome outcome = check(scratch);
  INFO(outcome.err);
  CHECK(outcome.status == 1);
  CHECK(outcome.err.rfind("scripts/check: error: ", 0) == 0);
  for (const Case& broken : cases) {
    INFO(broken.file << ": " << broken.line);
    CHECK(outcome.err.find(broken.file, outcome.err.find(broken.words)) != std::string::npos);
  }
}

TEST_CASE("scripts/check lets a short comment line end a paragraph or a sentence, or stand in a table") {
  const std::string full =
      "// A first line so full that a formatter with a smaller limit of columns would have to wrap its words,";
  const std::string ends[] = {"// its end", "// its end\n//\n// and a paragraph", "// it ends.\n// So another.",
                              "// the list:\n//   an item", "//   a row\n//   another row"};
  Scratch scratch;
  copy_tree(scratch);
  for (const std::string& end : ends) add_line(scratch, "sim/rod/rod.h", "\n" + full + "\n" + end);
  const Outcome outcome = check(scratch);
  CHECK(outcome.err == "");
  CHECK(outcome.status == 0);
}

TEST_CASE("scripts/check refuses a folder with code that it does not know") {
  Scratch scratch;
  copy_tree(scratch);
  scratch.write("sim/attic/old.h", "#pragma once\n");
  const Outcome outcome = check(scratch);
  CHECK(outcome.status == 1);
  CHECK(outcome.err.find("sim/attic is no known room") != std::string::npos);
}
