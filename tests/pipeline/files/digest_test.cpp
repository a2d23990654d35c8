#include "pipeline/base/digest.h"

#include "pipeline/files/checksum.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::pipeline {
namespace {

// Examples of FIPS 180-4.
constexpr const char* digest_of_nothing = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
constexpr const char* digest_of_abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
constexpr const char* digest_of_million_a = "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0";

TEST_CASE("digest: the published examples of SHA-256") {
  CHECK(sha256("") == digest_of_nothing);
  CHECK(sha256("abc") == digest_of_abc);
  CHECK(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq") ==
        "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  CHECK(sha256(std::string(1000000, 'a')) == digest_of_million_a);
}

TEST_CASE("digest: a file's is that of its bytes, also beyond one block") {
  const Scratch scratch;
  CHECK(digested_file(scratch.write("empty", ""), 0).sha256 == digest_of_nothing);
  CHECK(digested_file(scratch.write("abc", "abc"), 0).sha256 == digest_of_abc);
  const std::string large(3'000'001, 'z');
  CHECK(digested_file(scratch.write("large", large), 0).sha256 == sha256(large));
}

TEST_CASE("digest: a reading of a file with a checksum is held to that, in its first bytes and behind them") {
  const Scratch scratch;
  std::string rest(200'000, 'z');
  const std::string whole = checksum_block(xxh3(rest), rest.size()) + rest;
  CHECK(sha256_as_checked(scratch.write("whole", whole)) == sha256(whole));
  CHECK(sha256_as_checked(scratch.write("plain", rest)) == sha256(rest));
  for (const std::size_t at : {std::size_t{30}, std::size_t{511}, std::size_t{512}, whole.size() - 1}) {
    std::string turned = whole;
    turned[at] ^= 4;
    CHECK_THAT(message_of([&] { sha256_as_checked(scratch.write("turned", turned)); }),
               Catch::Contains("holds other bytes now than when it was checked"));
  }
  CHECK_THAT(message_of([&] { sha256_as_checked(scratch.write("cut", whole.substr(0, 300))); }),
             Catch::Contains("holds other bytes now"));
}

TEST_CASE("digest: what cannot be read has none") {
  const Scratch scratch;
  CHECK(message_of([&] { digested_file(scratch / "absent", 0).sha256; }) ==
        (scratch / "absent").string() + ": error: cannot be read (No such file or directory); check the path");
  CHECK(message_of([&] { digested_file(scratch / ".", 0).sha256; }) ==
        (scratch / ".").string() + ": error: is a folder, not a file; name a file");
}

}  // namespace
}  // namespace dresslife::pipeline
