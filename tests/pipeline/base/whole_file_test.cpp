#include "pipeline/base/whole_file.h"

#include <fcntl.h>
#include <sys/file.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "pipeline/base/limits.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

void write(WholeFile& file, const std::string& text) { file.write_at(text.data(), text.size(), 0); }

TEST_CASE("whole file: text is written whole, and left untouched when nothing changed") {
  const Scratch scratch;
  const auto file = scratch / "new folder/a.txt";
  write_text_if_changed(file, "one");
  CHECK(bytes_of(file) == "one");
  const auto long_ago = fs::last_write_time(file) - std::chrono::hours(1);
  fs::last_write_time(file, long_ago);
  write_text_if_changed(file, "one");
  CHECK(fs::last_write_time(file) == long_ago);
  write_text_if_changed(file, "two");
  CHECK(fs::last_write_time(file) != long_ago);
  CHECK(bytes_of(file) == "two");
  CHECK(std::distance(fs::directory_iterator(scratch / "new folder"), fs::directory_iterator()) == 1);
}

TEST_CASE("whole file: without commit nothing stays, and an older file does") {
  const Scratch scratch;
  { WholeFile file(scratch / "a"); }
  CHECK(scratch.entries() == 0);
  scratch.write("a", "older");
  {
    WholeFile file(scratch / "a");
    write(file, "newer");
    CHECK(scratch.entries() == 2);
    CHECK(bytes_of(scratch / "a") == "older");
  }
  CHECK(bytes_of(scratch / "a") == "older");
  CHECK(scratch.entries() == 1);
}

TEST_CASE("whole file: of two writers the later wins whole, and neither touches the other's part") {
  const Scratch scratch;
  WholeFile one(scratch / "a"), other(scratch / "a");
  CHECK(scratch.entries() == 2);
  write(one, "one, the longer");
  write(other, "other");
  one.commit();
  CHECK(bytes_of(scratch / "a") == "one, the longer");
  other.commit();
  CHECK(bytes_of(scratch / "a") == "other");
  CHECK(scratch.entries() == 1);
}

TEST_CASE("whole file: what killed writers left goes, what is locked or named otherwise stays") {
  const Scratch scratch;
  for (const char* name :
       {"a.12-0.part", "a.12-3.part", "a.part", "b.12-0.part", "a.x-0.part", "a.12-.part", "a.1-2-3.part"})
    scratch.write(name, "x");
  const int held = ::open((scratch / "a.12-3.part").c_str(), O_RDWR | O_CLOEXEC);
  REQUIRE(::flock(held, LOCK_EX) == 0);
  remove_leftovers(scratch / "a");
  CHECK_FALSE(fs::exists(scratch / "a.12-0.part"));
  CHECK(scratch.entries() == 6);
  ::close(held);
  remove_leftovers(scratch / "a");
  CHECK(scratch.entries() == 5);
}

TEST_CASE("whole file: folders, links and what is no file are not replaced") {
  const Scratch scratch;
  scratch.write("target", "kept");
  fs::create_symlink("target", scratch / "link");
  CHECK(message_of([&] { WholeFile file(scratch / "link"); }).find("is a link to another file") !=
        std::string::npos);
  CHECK(message_of([&] { write_text_if_changed(scratch / "link", "x"); }).find("is a link") !=
        std::string::npos);
  CHECK(bytes_of(scratch / "target") == "kept");
  CHECK(message_of([&] { WholeFile file(scratch / "."); }).find("is a folder") != std::string::npos);
  CHECK(message_of([&] { WholeFile file("/dev/null"); }).find("is a device or a pipe") != std::string::npos);
  // One that appears meanwhile.
  WholeFile file(scratch / "later");
  fs::create_symlink("target", scratch / "later");
  CHECK(message_of([&] { file.commit(); }).find("is a link") != std::string::npos);
  CHECK(message_of([&] { WholeFile lost(scratch / "none/a"); }).find("cannot be written (No such file") !=
        std::string::npos);
}

TEST_CASE("whole file: the first failure is kept, later writes do nothing") {
  const Scratch scratch;
  WholeFile file(scratch / "a");
  file.check();
  write(file, "text");
  file.write_at("x", 1, static_cast<std::uint64_t>(-1) / 2 + 1);  // at no place of a file
  CHECK(message_of([&] { file.check(); }).find("cannot be written (Invalid argument)") != std::string::npos);
  CHECK(message_of([&] { file.commit(); }).find("cannot be written (Invalid argument)") != std::string::npos);
  CHECK_FALSE(fs::exists(scratch / "a"));
}

TEST_CASE("file state: after a tick of the clock every change shows, whatever times are set") {
  const Scratch scratch;
  for (int k = 0; k < 10; ++k) {
    const fs::path file = scratch.write("a", "one");
    std::this_thread::sleep_for(std::chrono::milliseconds(12));  // ticks are 1 .. 10 ms
    const FileState state = state_of(file);
    const fs::file_time_type time = fs::last_write_time(file);
    scratch.write("a", "two");
    fs::last_write_time(file, time);
    CHECK_FALSE(state == state_of(file));
  }
  CHECK_FALSE(state_of(scratch / "absent").exists());
  CHECK_FALSE(state_of(scratch / ".").exists());
}

TEST_CASE("shown text: nothing in it acts on a terminal") {
  CHECK(shown("plain\ttext\n") == "plain\ttext\n");
  CHECK(shown("a\x1b[31mb\r\x07") == "a\\x1b[31mb\\x0d\\x07");
  CHECK(shown("K\xc3\xa4"
              "fig \xc2\x9b"
              "2J \xc2\xb5") ==
        "K\xc3\xa4"
        "fig \\x9b2J \xc2\xb5");
}

}  // namespace
}  // namespace dresslife::pipeline
