#include "pipeline/base/csv_rows.h"

#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

using namespace dresslife::pipeline;

namespace {

/// Returns all cells in brackets, rows by line number.
std::string all_of(CsvReader reader) {
  std::string text;
  for (CsvRow row = reader.next(); !row.empty(); row = reader.next()) {
    text += std::to_string(reader.line()) + ":";
    for (const CsvCell& cell : row) text += "[" + cell.text + "]";
    text += " ";
  }
  return text;
}

}  // namespace

TEST_CASE("CSV: cells without blanks, comments, blank lines and rows of empty cells do not count") {
  CHECK(all_of({"\xEF\xBB\xBF a , b\r\n# c\n\n ,,\n 1,\t2 \n  # d\n,3", "f"}) == "1:[a][b] 5:[1][2] 7:[][3] ");
  CHECK(all_of({"", "f"}) == "");
  CHECK(all_of({"\n\n", "f"}) == "");
}

TEST_CASE("CSV: a comma separates, else the tabs or semicolons of the first line") {
  CHECK(all_of({"a;b\n1,5;2\n", "f"}) == "1:[a][b] 2:[1,5][2] ");
  CHECK(all_of({"a\tb c\n\t2\n", "f"}) == "1:[a][b c] 2:[][2] ");
  CHECK(all_of({"a;b,c\n1;2,3\n", "f"}) == "1:[a;b][c] 2:[1;2][3] ");
  CHECK(all_of({"\"a, b\";c\n1,5;2\n", "f"}) == "1:[a, b][c] 2:[1,5][2] ");
  CHECK(all_of({"a;b\n1,2\n", "f", ","}) == "1:[a;b] 2:[1][2] ");
  CHECK(all_of({"\xEF\xBB\xBFsep=;\r\na,b;c\n", "f"}) == "2:[a,b][c] ");
  CHECK(all_of({"sep=\na\n", "f"}) == "1:[sep=] 2:[a] ");
  CHECK(all_of({"sep=x\na\n", "f"}) == "1:[sep=x] 2:[a] ");
}

TEST_CASE("CSV: quotes hold separators and quotes, and a cell knows its place") {
  CHECK(all_of({"\"a, b\" ,\"say \"\"x\"\"\"\n", "f"}) == "1:[a, b][say \"x\"] ");
  CsvReader reader("a\n1,  22", "f.csv");
  reader.next();
  const CsvRow row = reader.next();
  CHECK(reader.where(row[1]).line == 2);
  CHECK(reader.where(row[1]).column == 5);
  CHECK_THROWS_WITH(all_of({"a,\"b\nc\"", "f.csv"}),
                    "f.csv:1:3: error: a quote that opens here is never closed in its line; close it");
  CHECK_THROWS_WITH(all_of({"\"a\"b,c", "f.csv"}),
                    "f.csv:1:4: error: text follows a closing quote; write a quote within quotes twice");
}

TEST_CASE("CSV: a row that is too long has the remedy of decimal commas if it shows them") {
  const auto remedy = [](const std::string& row, std::size_t titles) {
    CsvReader reader(row + "\n", "t.csv");
    const CsvRow cells = reader.next();
    const std::string refused = message_of([&] { check_width(reader, CsvRow(titles), cells); });
    return refused.substr(refused.find("; ") + 2);
  };
  CHECK(remedy("R01,fast,80,5,900", 4) ==
        "if 80,5 is one number with a decimal comma, write 80.5 or quote it: \"80,5\"");
  CHECK_THAT(remedy("R01,fast,80,5", 5), Catch::StartsWith("fill its cells"));
  CHECK_THAT(remedy("R01,fast,b,5", 3), Catch::StartsWith("fill its cells"));
  CHECK_THAT(remedy("R01;80;5", 2), Catch::StartsWith("fill its cells"));
}

TEST_CASE("CSV: a number is one whole decimal number") {
  CHECK(number_in("+1.5e3") == 1500);
  CHECK(number_in("-2") == -2);
  for (const char* none : {"", "1 2", "1,5", "0x1", "two"}) CHECK_FALSE(number_in(none));
}

TEST_CASE("CSV: what is written is read again, and no spreadsheet takes it for a formula") {
  for (const char* as_it_is : {"", "plain", "5", "-5", "+1.5e3", "-.5", "1=2", "a-b"})
    CHECK(harmless(as_it_is) == as_it_is);
  for (const char* formula : {"=1+2", "-a", "+a", "@x", "-5 m", "="})
    CHECK(harmless(formula) == std::string("'") + formula);
  CHECK(csv_cell("plain") == "plain");
  CHECK(csv_cell("a,b") == "\"a,b\"");
  CHECK(csv_cell("#7") == "\"#7\"");  // a line that begins with # is a comment
  CHECK(csv_cell("say \"x\"") == "\"say \"\"x\"\"\"");
  const std::vector<std::string> cells{"a,b", "\"", "\"\"", ",", "x\"y,z\"", "one"};
  std::string line;
  for (const std::string& cell : cells) line += (line.empty() ? "" : ",") + csv_cell(cell);
  CsvReader reader(line + "\n", "f.csv");
  const CsvRow row = reader.next();
  REQUIRE(row.size() == cells.size());
  for (std::size_t k = 0; k < cells.size(); ++k) CHECK(row[k].text == cells[k]);
}

TEST_CASE("CSV: a file that is read in parts has the rows of its text") {
  std::string text =
      "\xEF\xBB\xBF"
      "a,b\n";
  for (int k = 0; k < 300'000; ++k)
    text += std::to_string(k) + ",\"" + std::to_string(7 * k) + "\"\n";  // fills several parts
  const Scratch scratch;
  CsvReader whole(text, "f.csv"), parts(PlainFile(scratch.write("f.csv", text)), ",");
  std::size_t rows = 0;
  for (CsvRow row = whole.next(), other = parts.next(); !row.empty() || !other.empty();
       row = whole.next(), other = parts.next()) {
    REQUIRE(row.size() == other.size());
    for (std::size_t i = 0; i < row.size(); ++i) REQUIRE(row[i].text == other[i].text);
    REQUIRE(whole.line() == parts.line());
    if (++rows == 9) CHECK(parts.share_read() < 0.5);  // one of five parts is in memory
  }
  CHECK(rows == 300'001);
  CHECK(parts.share_read() == 1);
  CsvReader endless(PlainFile(scratch.write("long.csv", std::string(2'000'000, 'x'))), ",");
  CHECK(message_of([&] { endless.next(); }).find("has a line of more than") != std::string::npos);
}
