#include "pipeline/base/ownership.h"

#include <map>

#include "pipeline/base/whole_file.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

/// A text of each kind in its writer's form.
const std::map<Mark, std::string> texts{
    {Mark::yaml, "name: a\n"},
    {Mark::script, "#!/bin/sh\necho\n"},
    {Mark::xml, "<?xml version=\"1.0\" ?>\n<Xdmf/>\n"},
    {Mark::page, "<!DOCTYPE html>\n<html></html>\n"},
    {Mark::png, std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\1\0\0\0\1\x08\2\0\0\0\x90wS\xde", 33) + "rest"}};

TEST_CASE("ownership: a marked text is ours, as a text and as a file") {
  const Scratch scratch;
  for (const auto& [mark, text] : texts) {
    const std::string marked = with_mark(text, mark);
    CHECK_FALSE(begins_as_ours(text));
    CHECK(begins_as_ours(marked));
    CHECK_FALSE(is_ours(scratch.write("theirs", text)));
    CHECK(is_ours(scratch.write("ours", marked)));
    CHECK((mark == Mark::png || is_as_marked(marked)));
  }
  CHECK(without_mark(with_mark("name: a\n", Mark::yaml)) == "name: a\n");
  CHECK(without_mark("name: a\n") == "name: a\n");
  // The mark is not content, neither in a browser nor in a parser.
  CHECK(with_mark(texts.at(Mark::page), Mark::page).starts_with("<!DOCTYPE html>\n<!-- "));
  CHECK(with_mark(texts.at(Mark::script), Mark::script).starts_with("#!/bin/sh\n# "));
  CHECK(with_mark(texts.at(Mark::xml), Mark::xml).starts_with("<?xml version=\"1.0\" ?>\n<!-- "));
}

TEST_CASE("ownership: each byte that a user changes makes a text that people edit theirs, a page stays ours, damaged") {
  const Scratch scratch;
  for (const auto& [mark, text] : texts) {
    if (mark == Mark::png) continue;
    const std::string marked = with_mark(text, mark);
    for (std::size_t at = marked.size() - without_mark(marked).size(); at < marked.size(); ++at) {
      std::string changed = marked;
      changed[at] ^= 1;
      CHECK_FALSE(is_as_marked(changed));
      CHECK(is_ours(scratch.write("changed", changed)) == (mark == Mark::page));
    }
    CHECK(is_ours(scratch.write("longer", marked + '\n')) == (mark == Mark::page));
  }
}

TEST_CASE("ownership: files without a comment line are known by their first bytes, similar files are not ours") {
  const Scratch scratch;
  const auto ours = [&](const std::string& name, const std::string& text) {
    return is_ours(scratch.write(name, text));
  };
  CHECK(ours("life.h5", "dresslife file\nxxh3-128 0"));
  CHECK(ours("build.ninja", "ninja_required_version = 1.8\nbuilddir = .stage\n"));
  CHECK_FALSE(ours("build.ninja", "ninja_required_version = 1.8\nbuilddir = mine\n"));
  CHECK(ours("log", "== dresslife-sim\n"));
  CHECK_FALSE(ours("log", "my notes of dresslife-sim\n"));
  CHECK(ours("ranking.csv", "job,life_repeats,life_hours,worst_segment_from_tool,worst_component\n"));
  CHECK_FALSE(ours("ranking.csv", "job,life_hours\n"));
  CHECK_FALSE(ours("report.html", "<!DOCTYPE html>\n<html lang=\"en\">\n<head><title>dresspacks</title>"));
}

TEST_CASE("ownership: files go when they are ours, folders of notes when they were made by us") {
  const Scratch scratch;
  scratch.write("mine", "mine");
  scratch.write("empty", "");
  fs::create_symlink(scratch.write("target", with_mark("a", Mark::yaml)), scratch / "link");
  for (const char* name : {"mine", "empty", "link"}) {
    CHECK_FALSE(remove_ours(scratch / name));
    CHECK(fs::exists(scratch / name));
  }
  CHECK(remove_ours(scratch.write("ours", with_mark("a", Mark::yaml))));
  CHECK_FALSE(fs::exists(scratch / "ours"));
  CHECK(remove_ours(scratch / "absent"));

  scratch.write("theirs/.stage/sim.log", "mine");
  CHECK(message_of([&] { make_notes(scratch / "theirs/.stage"); }).find("was not made by dresslife") !=
        std::string::npos);
  remove_notes(scratch / "theirs/.stage");
  CHECK(bytes_of(scratch / "theirs/.stage/sim.log") == "mine");
  scratch.write("killed/.stage/dresslife-12-0.part", "# Wri");  // by a program that was killed before it wrote the mark
  make_notes(scratch / "killed/.stage");
  CHECK_FALSE(fs::exists(scratch / "killed/.stage/dresslife-12-0.part"));
  make_notes(scratch / "new/.stage");
  make_notes(scratch / "new/.stage");
  scratch.write("new/.stage/sim.log", "what a stage says");
  CHECK(is_ours(scratch / "new/.stage/sim.log"));
  remove_notes(scratch / "new/.stage");
  CHECK_FALSE(fs::exists(scratch / "new/.stage"));
}

}  // namespace
}  // namespace dresslife::pipeline
