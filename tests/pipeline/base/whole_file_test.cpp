#include "pipeline/base/whole_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/resource.h>

#include <chrono>
#include <thread>

#include "pipeline/base/limits.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

/// Returns a text with the mark of this project.
std::string ours(const std::string& text) { return with_mark(text, Mark::yaml); }
void write(WholeFile& file, const std::string& text) { file.write_at(text.data(), text.size(), 0); }

TEST_CASE("whole file: text is written whole, and left untouched when nothing changed") {
  const Scratch scratch;
  const auto file = scratch / "new folder/a.txt";
  write_text_if_changed(file, ours("one"));
  CHECK(bytes_of(file) == ours("one"));
  const auto long_ago = fs::last_write_time(file) - std::chrono::hours(1);
  fs::last_write_time(file, long_ago);
  write_text_if_changed(file, ours("one"));
  CHECK(fs::last_write_time(file) == long_ago);
  write_text_if_changed(file, ours("two"));
  CHECK(fs::last_write_time(file) != long_ago);
  CHECK(bytes_of(file) == ours("two"));
  CHECK(std::distance(fs::directory_iterator(scratch / "new folder"), fs::directory_iterator()) == 1);
}

TEST_CASE("whole file: without commit nothing stays, and an older file does") {
  const Scratch scratch;
  { WholeFile file(scratch / "a"); }
  CHECK(scratch.entries() == 0);
  scratch.write("a", ours("older"));
  {
    WholeFile file(scratch / "a");
    write(file, ours("newer"));
    CHECK(scratch.entries() == 2);
    CHECK(bytes_of(scratch / "a") == ours("older"));
  }
  CHECK(bytes_of(scratch / "a") == ours("older"));
  CHECK(scratch.entries() == 1);
}

TEST_CASE("whole file: of two writers the later wins whole, and neither touches the other's part") {
  const Scratch scratch;
  WholeFile one(scratch / "a"), other(scratch / "a");
  CHECK(scratch.entries() == 2);
  write(one, ours("one, the longer"));
  write(other, ours("other"));
  one.commit();
  CHECK(bytes_of(scratch / "a") == ours("one, the longer"));
  other.commit();
  CHECK(bytes_of(scratch / "a") == ours("other"));
  CHECK(scratch.entries() == 1);
}

TEST_CASE("whole file: the user's file is not replaced, neither one that was there nor one that comes meanwhile") {
  const Scratch scratch;
  scratch.write("mine.yaml", "mine: 1\n");
  CHECK(message_of([&] { WholeFile file(scratch / "mine.yaml"); }) ==
        (scratch / "mine.yaml").string() +
            ": error: is there already and was not written by dresslife, or was changed since; move it away, name "
            "another place with -o, or replace it with --force");
  CHECK(message_of([&] { write_text_if_changed(scratch / "mine.yaml", ours("x")); }) != "");
  CHECK(message_of([&] { give_second_name(scratch.write("a", ours("a")), scratch / "mine.yaml"); }) != "");
  CHECK(bytes_of(scratch / "mine.yaml") == "mine: 1\n");
  {
    WholeFile file(scratch / "later");
    write(file, ours("x"));
    scratch.write("later", "mine");
    CHECK(message_of([&] { file.commit(); }) != "");
  }
  CHECK(bytes_of(scratch / "later") == "mine");
  write_text_if_changed(scratch.write("empty", ""), ours("x"));  // an empty file, as mktemp makes it
  CHECK(bytes_of(scratch / "empty") == ours("x"));
  // A file without the mark is not written, so every written file is recognised afterwards.
  WholeFile file(scratch / "without a mark");
  write(file, "text");
  CHECK_THROWS_AS(file.commit(), std::logic_error);
}

TEST_CASE("whole file: what was read for the user is not replaced, ours or not") {
  const Scratch scratch;
  const fs::path input = scratch.write("a.yaml", ours("a: 1\n"));
  write_text_if_changed(input, ours("a: 2\n"));
  note_input(input);
  fs::create_hard_link(input, scratch / "b.yaml");
  for (const char* name : {"a.yaml", "b.yaml"})
    CHECK(message_of([&] { WholeFile file(scratch / name); }).find("is one of the files that are read") !=
          std::string::npos);
}

TEST_CASE("whole file: a second name is the same bytes, and replaces what is ours") {
  const Scratch scratch;
  const fs::path file = scratch.write("a", ours("a"));
  give_second_name(file, scratch / "b");
  CHECK(fs::hard_link_count(file) == 2);
  give_second_name(file, scratch / "b");  // it already has this name
  scratch.write("c", ours("c"));
  give_second_name(file, scratch / "c");
  CHECK(bytes_of(scratch / "c") == ours("a"));
  CHECK(fs::hard_link_count(file) == 3);
  CHECK(scratch.entries() == 3);
}

TEST_CASE("whole file: what killed writers left goes, what is locked or named otherwise stays") {
  const Scratch scratch;
  for (const char* name : {"dresslife-12-0.part", "dresslife-12-3.part", "a.part", "a.12-0.part", "dresslife-x-0.part",
                           "dresslife-12.part", "dresslife-1-2-3.part"})
    scratch.write(name, "x");
  const int held = ::open((scratch / "dresslife-12-3.part").c_str(), O_RDWR | O_CLOEXEC);
  REQUIRE(::flock(held, LOCK_EX) == 0);
  { WholeFile file(scratch / "any"); }  // every writer in a folder removes leftovers
  CHECK_FALSE(fs::exists(scratch / "dresslife-12-0.part"));
  CHECK(scratch.entries() == 6);
  ::close(held);
  remove_leftovers(scratch / ".");
  CHECK(scratch.entries() == 5);
}

TEST_CASE("whole file: folders, links and what is no file are not replaced") {
  const Scratch scratch;
  scratch.write("target", "kept");
  fs::create_symlink("target", scratch / "link");
  CHECK(message_of([&] { WholeFile file(scratch / "link"); }).find("is a link to another file") != std::string::npos);
  CHECK(message_of([&] { write_text_if_changed(scratch / "link", ours("x")); }).find("is a link") != std::string::npos);
  CHECK(bytes_of(scratch / "target") == "kept");
  CHECK(message_of([&] { WholeFile file(scratch / "."); }).find("is a folder") != std::string::npos);
  CHECK(message_of([&] { WholeFile file("/dev/null"); }).find("is a device or a pipe") != std::string::npos);
  // A link that appears before the commit.
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
  write(file, ours("text"));
  file.write_at("x", 1, static_cast<std::uint64_t>(-1) / 2 + 1);  // at a position that no file has
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

TEST_CASE("plain file: 64 GiB are read, more are refused, and no free descriptor is the machine's fault") {
  const Scratch scratch;
  const fs::path file = scratch.write("a", "one");
  constexpr std::uintmax_t largest = std::uintmax_t{64} << 30;  // a sparse file
  fs::resize_file(file, largest);
  CHECK_NOTHROW(PlainFile(file));
  fs::resize_file(file, largest + 1);
  CHECK_THROWS_AS(PlainFile(file), InputError);
  rlimit before{};
  REQUIRE(::getrlimit(RLIMIT_NOFILE, &before) == 0);
  const rlimit none{0, before.rlim_max};
  REQUIRE(::setrlimit(RLIMIT_NOFILE, &none) == 0);
  bool machine = false;
  try {
    PlainFile{file};
  } catch (const DiskError&) {
    machine = true;
  } catch (const std::exception&) {
  }
  ::setrlimit(RLIMIT_NOFILE, &before);
  CHECK(machine);
}

TEST_CASE("shown text: nothing in it acts on a terminal or turns the text around it") {
  CHECK(shown("plain\ttext\n") == "plain\ttext\n");
  CHECK(shown("a\x1b[31mb\r\x07") == "a\\x1b[31mb\\x0d\\x07");
  CHECK(shown("K\xc3\xa4"
              "fig \xc2\x9b"
              "2J \xc2\xb5") ==
        "K\xc3\xa4"
        "fig \\x9b2J \xc2\xb5");
  // U+202E reverses the text after it: "a\u202egpj.exe" is shown as "aexe.jpg". All characters of UAX #9, and their neighbours.
  CHECK(shown("a\u202egpj.exe") == "a\\u202egpj.exe");
  for (const char* control : {"\u061c", "\u200e", "\u200f", "\u202a", "\u202b", "\u202c", "\u202d", "\u202e", "\u2066",
                              "\u2067", "\u2068", "\u2069"})
    CHECK(shown(control).size() == 6);
  for (const char* letter : {"\u061b", "\u061d", "\u200d", "\u2010", "\u2029", "\u202f", "\u2065", "\u206a", "\u2014"})
    CHECK(shown(letter) == letter);
  for (const char* cut : {"\xe2", "\xe2\x80", "\xd8", "\xc2"}) CHECK(shown(cut) == cut);
}

}  // namespace
}  // namespace dresslife::pipeline
