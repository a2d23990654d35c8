#include "pipeline/base/installation.h"

#include <cstdlib>

#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::pipeline {
namespace {

/// Sets an environment variable for one test and restores it afterwards.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) {
    if (const char* was = std::getenv(name)) before_ = was;
    ::setenv(name, value.c_str(), 1);
  }
  ~Variable() {
    if (before_.empty())
      ::unsetenv(name_);
    else
      ::setenv(name_, before_.c_str(), 1);
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::string before_;
};

}  // namespace

TEST_CASE("installation: the program's folder is where this test lies") {
  CHECK(std::filesystem::exists(program_folder() / "test_pipeline_base"));
}

TEST_CASE("installation: without /proc a program is found by its path, or where a shell finds it") {
  const Scratch scratch;
  const auto program = scratch.write("bin/some-program", "");
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  std::filesystem::create_symlink(program, scratch / "link");
  CHECK(program_called(program) == program);
  CHECK(program_called(scratch / "link") == program);
  const Variable path("PATH", "/nowhere::" + (scratch / "bin").string());
  CHECK(program_called("some-program") == program);
  CHECK(message_of([] { program_called("absent-program"); }) ==
        "absent-program: error: is not found again (/proc is not there, and the name does not lead to it); mount "
        "/proc, or start it by its whole path");
  CHECK(message_of([] { program_called(""); }).starts_with("this program: error: is not found again"));
}

TEST_CASE("installation: the catalogue of a build folder is that of the sources") {
  const Variable none("DRESSLIFE_CONFIG", "");
  CHECK(shipped_catalogue() == std::filesystem::canonical(DRESSLIFE_SOURCE_DIR "/config"));
}

TEST_CASE("installation: DRESSLIFE_CONFIG goes before the catalogue that came with the program") {
  const Scratch scratch;
  const Variable own("DRESSLIFE_CONFIG", (scratch / ".").string());
  CHECK(shipped_catalogue() == scratch / ".");
}

TEST_CASE("installation: a DRESSLIFE_CONFIG that is no folder is refused, and does not hide the version") {
  const Scratch scratch;
  const std::string lost = (scratch / "none").string();
  const Variable wrong("DRESSLIFE_CONFIG", lost);
  const std::string words = "DRESSLIFE_CONFIG: error: names " + lost +
                            ", which is no folder; set it to a folder that holds robots, programs, dresspacks and "
                            "materials, or unset it";
  CHECK(message_of([] { shipped_catalogue(); }) == words);
  CHECK(version_text("dresslife-sample").find(words) != std::string::npos);
}

TEST_CASE("installation: the version comes first, then what the program was built from") {
  const std::string text = version_text("dresslife-sample");
  CHECK(text.rfind(std::string("dresslife-sample ") + version() + "\n", 0) == 0);
  for (const char* fact : {"\nbuilt as ", "\nthis machine runs the hot loops with: portable", "\nlibraries: ODE 0.",
                           "Eigen 3.", "HDF5 1.", "\ncatalogue: "})
    CHECK(text.find(fact) != std::string::npos);
}

}  // namespace dresslife::pipeline
