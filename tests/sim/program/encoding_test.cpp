#include "sim/program/interpreter/encoding.h"

#include <cstring>

#include "pipeline/base/text.h"
#include "tests/catch.h"
#include "tests/sim/program/reading.h"

using namespace dresslife::sim;
using namespace dresslife::tests;

namespace {

/// Returns an ASCII or ISO 8859-1 text with two bytes per character.
std::string utf16(const std::string& text, bool big_endian) {
  std::string bytes;
  for (const char c : text) bytes += big_endian ? std::string{'\0', c} : std::string{c, '\0'};
  return bytes;
}

}  // namespace

TEST_CASE("encoding: marks are taken away, UTF-16 and single bytes become UTF-8") {
  const std::string program = "DEF p()\r\nEND\r\n";
  CHECK(decoded_text(program) == program);
  CHECK(decoded_text("\xEF\xBB\xBF" + program) == program);
  CHECK(decoded_text("\xFF\xFE" + utf16(program, false)) == program);
  CHECK(decoded_text("\xFE\xFF" + utf16(program, true)) == program);
  CHECK(decoded_text(utf16(program, false)) == program);
  CHECK(decoded_text(utf16(program, true)) == program);
  CHECK(decoded_text("gr\xF6\xDF"
                     "e") ==
        "gr\xC3\xB6\xC3\x9F"
        "e");
  CHECK(decoded_text("5 \x80") == "5 \xE2\x82\xAC");  // the euro sign of Windows-1252
  CHECK(decoded_text("gr\xC3\xB6\xC3\x9F"
                     "e") ==
        "gr\xC3\xB6\xC3\x9F"
        "e");
  CHECK(decoded_text("") == "");
}

TEST_CASE("encoding: pairs of UTF-16 become one letter, halves of them the replacement letter") {
  CHECK(decoded_text(std::string("\xFF\xFE\x3D\xD8\x00\xDE", 6)) == "\xF0\x9F\x98\x80");  // U+1F600
  CHECK(decoded_text(std::string("\xFF\xFE\x3D\xD8"
                                 "A\0",
                                 6)) ==
        "\xEF\xBF\xBD"
        "A");
  CHECK(decoded_text(std::string("\xFF\xFE"
                                 "A\0B",
                                 5)) == "A");  // the last character has only one byte
}

TEST_CASE("encoding: text that is not well-formed UTF-8 is recognised") {
  for (const char* whole : {"", "a", "\xC3\xB6", "\xE2\x82\xAC", "\xF0\x9F\x98\x80", "\xF4\x8F\xBF\xBF"})
    CHECK(dresslife::pipeline::first_no_utf8(whole) == std::strlen(whole));
  // A continuation byte alone, a lead byte alone, two overlong forms, a surrogate, a code point above U+10FFFF.
  for (const char* broken : {"\xB6", "\xC3", "\xC0\x80", "\xE0\x80\x80", "\xED\xA0\x80", "\xF4\x90\x80\x80"})
    CHECK(dresslife::pipeline::first_no_utf8(std::string("a\n") + broken) == 2);
}

TEST_CASE("encoding: letters beyond ASCII belong to names, and their case does not count") {
  const Reading rapid = Reader{Language::rapid}(
      {{"m.mod", decoded_text("MODULE m\n CONST jointtarget gr\xF6\xDF"
                              "e:=[[5,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n PROC main()\n  MoveAbsJ "
                              "GR\xD6\xDF"
                              "E,v100,fine,tool0;\n ENDPROC\nENDMODULE\n")}});
  REQUIRE(rapid.problem() == "no such problem");
  CHECK(rapid.program.instructions.size() == 1);
}

TEST_CASE("encoding: KRL's constants may stand apart from their sign") {
  const Reading krl = Reader{Language::krl}({{"s.src",
                                              "DEF s()\nDECL INT n\nn=# Start\nIF n==#START THEN\nPTP {A1 0,A2 "
                                              "-90,A3 90,A4 0,A5 30,A6 0}\nENDIF\nEND\n"}});
  REQUIRE(krl.problem() == "no such problem");
  CHECK(krl.program.instructions.size() == 1);
}
