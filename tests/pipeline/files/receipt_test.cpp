// Digests that one program notes for others. A noted digest is used while the file's state is the noted one; otherwise the
// digest is computed.
#include "pipeline/files/receipt.h"

#include "pipeline/base/digest.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

using namespace dresslife::pipeline;
namespace fs = std::filesystem;

TEST_CASE("a noted digest is believed of a file that is as it was, and of no other") {
  const fs::path file = fs::canonical(fs::path(DRESSLIFE_SOURCE_DIR) / "CMakeLists.txt");
  const std::string digest = xxh3_of_file(file), notes = note_digests({file, "/nowhere/at all"});
  REQUIRE(notes.starts_with(digest + " "));
  REQUIRE(std::count(notes.begin(), notes.end(), '\n') == 1);

  Digests unread;  // a different digest reveals whether the file was read
  unread.believe("noted" + notes.substr(digest.size()));
  CHECK(unread.of(file) == "noted");

  for (std::size_t word = 1; word <= 4; ++word) {  // size, both times, inode
    std::size_t at = 0;
    for (std::size_t k = 0; k < word; ++k) at = notes.find(' ', at) + 1;
    std::string changed = "noted" + notes.substr(digest.size());
    changed.insert(at + 5 - digest.size(), "1");
    Digests read;
    read.believe(changed);
    CHECK(read.of(file) == digest);
  }
  for (const std::string& nothing : {std::string(), std::string("\n\n"), notes.substr(0, digest.size() + 3),
                                     "noted -1 0 0 0 " + file.string() + "\n"}) {
    Digests read;
    read.believe(nothing);
    CHECK(read.of(file) == digest);
  }
}

TEST_CASE("a receipt is read as it was written, also texts with line ends and backslashes") {
  const Scratch scratch;
  const Receipt written{.recipe = "r",
                        .input = "i",
                        .output = "o",
                        .state = {},
                        .results = {{"name", "\n\\n\\"}},
                        .made_with = {{"\\a\nb", "digest"}}};
  write_receipt(scratch / "receipt", written, scratch.write("output", "x"));
  const std::optional<Receipt> read = read_receipt(scratch / "receipt");
  REQUIRE(read);
  CHECK(read->results == written.results);
  CHECK(read->made_with == written.made_with);
}

TEST_CASE("a file's state suffices where the file exists and the receipt is younger than its last change") {
  Receipt receipt{.recipe = "r", .input = "i", .output = "o", .state = {.size = 1, .changed_ns = 5}, .written_ns = 6};
  CHECK(receipt.state_suffices());
  receipt.written_ns = 5;  // the change may be within one tick of the clock
  CHECK_FALSE(receipt.state_suffices());
  receipt.written_ns = 6, receipt.state.size = -1;  // no file
  CHECK_FALSE(receipt.state_suffices());
}
