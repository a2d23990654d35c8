// scripts/build in a copy of a checkout: this project's script with a small substitute project.

#include "tests/cli/process.h"

#include "tests/catch.h"

using namespace dresslife::tests;

namespace {

/// Writes a checkout whose build copies the file `source` of its own folder to build/result.
void write_checkout(const Scratch& scratch, const std::string& name) {
  scratch.write(name + "/CMakeLists.txt",
                "cmake_minimum_required(VERSION 3.25)\nproject(sample LANGUAGES NONE)\n"
                "add_custom_command(OUTPUT result DEPENDS ${PROJECT_SOURCE_DIR}/source\n"
                "  COMMAND ${CMAKE_COMMAND} -E copy ${PROJECT_SOURCE_DIR}/source result)\n"
                "add_custom_target(all_of_it ALL DEPENDS result)\n");
  fs::copy(DRESSLIFE_SOURCE_DIR "/CMakePresets.json", scratch / (name + "/CMakePresets.json"));
  scratch.write(name + "/source", "of " + name);
  fs::create_directories(scratch / (name + "/scripts"));
  fs::copy(DRESSLIFE_SOURCE_DIR "/scripts/build", scratch / (name + "/scripts/build"));
  scratch.write(name + "/scripts/bootstrap", "#!/bin/sh\n");  // nothing to install
  fs::permissions(scratch / (name + "/scripts/bootstrap"), fs::perms::owner_all);
}

Outcome build(const Scratch& scratch, const std::string& checkout) {
  const fs::path err = scratch / ".err";
  const std::string command =
      "cd / && '" + (scratch / checkout / "scripts/build").string() + "' >/dev/null 2>'" + err.string() + "'";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, "", content(err)};
}

}  // namespace

TEST_CASE("a copied or moved checkout is configured again, with a word, and builds its own sources") {
  Scratch scratch;
  write_checkout(scratch, "old");
  const Outcome first = build(scratch, "old");
  INFO(first.err);
  REQUIRE(first.status == 0);
  CHECK(first.err == "Configuring build/ (Release)\n");
  CHECK(build(scratch, "old").err.empty());

  fs::copy(scratch / "old", scratch / "new", fs::copy_options::recursive);
  scratch.write("new/source", "of new");
  const Outcome copied = build(scratch, "new");
  CHECK(copied.status == 0);
  CHECK(copied.err == "Configuring build/ (Release) again: it came from " + (scratch / "old").string() +
                          " and would build the sources there\n");
  CHECK(content(scratch / "new/build/result") == "of new");
  CHECK(build(scratch, "new").err.empty());

  fs::rename(scratch / "new", scratch / "moved");
  scratch.write("moved/source", "of moved");
  CHECK(build(scratch, "moved").status == 0);
  CHECK(content(scratch / "moved/build/result") == "of moved");
}

TEST_CASE("a build that fails says what the compiler said, and ends with 1") {
  Scratch scratch;
  write_checkout(scratch, "old");
  fs::remove(scratch / "old/source");
  const Outcome failed = build(scratch, "old");
  CHECK(failed.status == 1);
  CHECK(failed.err.find("source', needed by 'result', missing") != std::string::npos);
  CHECK(failed.err.find("scripts/build: error: the build failed") != std::string::npos);
}

TEST_CASE("a long build prints its progress now and then") {
  Scratch scratch;
  write_checkout(scratch, "old");
  scratch.write("old/CMakeLists.txt",
                "cmake_minimum_required(VERSION 3.25)\nproject(sample LANGUAGES NONE)\n"
                "add_custom_command(OUTPUT a COMMAND sleep 10.5 COMMAND ${CMAKE_COMMAND} -E touch a)\n"
                "add_custom_command(OUTPUT b DEPENDS a COMMAND ${CMAKE_COMMAND} -E touch b)\n"
                "add_custom_target(all_of_it ALL DEPENDS b)\n");
  CHECK(build(scratch, "old").err == "Configuring build/ (Release)\nBuilding:  50% 1/2\n");
}
