#include "pipeline/stage/command_line.h"

#include "pipeline/base/errors.h"
#include "pipeline/stage/program_manual.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

using namespace dresslife::pipeline;

namespace {

enum class Colour { red, green };
constexpr std::string_view word(Colour colour) { return colour == Colour::red ? "red" : "green"; }

/// One variable for each kind of target.
struct Values {
  bool flag = false;
  int whole = 4;
  std::uint64_t seed = 1, limit = 0;
  double length = 0.5;
  std::optional<int> count;
  std::optional<double> time;
  std::string text = "runs", argument;
  std::filesystem::path file;
  std::vector<std::string> list;
  std::string called;
  Colour colour = Colour::red;
};

std::vector<Option> options_of(Values& values) {
  return {{"argument", "", "INPUT", &values.argument},
          {"-f,--flag", "", "a flag", &values.flag},
          {"--whole", "N", "a whole number", &values.whole, {.range = {{1, 8}}}},
          {"--seed", "N", "no negative number", &values.seed, {.range = {{0, 1e9}}}},
          {"--limit", "N", "no negative number", &values.limit},
          {"--length", "M", "a number", &values.length, {.range = {{0, 1}}}},
          {"--count", "N", "a number that may be absent", &values.count, {.range = {{1, 8}}}},
          {"--time", "S", "a number that may be absent", &values.time, {.needs = "--count"}},
          {"--text", "WORD", "a text", &values.text},
          {"--file", "FILE", "a file", &values.file},
          {"--list", "WORD", "may be repeated", &values.list},
          {"--set", "KEY=VALUE", "sets a key", &values.list},
          {"--call", "WORD", "is handed over",
           [&values](const std::string& text) {
             if (text == "bad") throw InputError({"--call"}, "is bad", "write another word");
             values.called = text;
           }},
          choice_option("--colour", "a choice", values.colour, {Colour::red, Colour::green})};
}

std::optional<int> read(const Command& program, std::vector<std::string> line, const Command** called = nullptr) {
  line.insert(line.begin(), program.name);
  std::vector<char*> words;
  for (std::string& word : line) words.push_back(word.data());
  return read_command_line(program, static_cast<int>(words.size()), words.data(), called);
}

std::optional<int> read(Values& values, const std::vector<std::string>& line) {
  return read({.name = "sample", .purpose = "Tries options.", .options = options_of(values), .example = "sample x"},
              line);
}

}  // namespace

TEST_CASE("command line: each kind of target receives its value") {
  Values values;
  CHECK_FALSE(read(values, {"in",      "-f",  "--whole", "8",   "--seed", "1000000000", "--length", "0.25",
                            "--count", "3",   "--time",  "2.5", "--text", "other",      "--file",   "a/b.h5",
                            "--list",  "one", "--list",  "two", "--call", "me",         "--colour", "green"}));
  CHECK(values.argument == "in");
  CHECK(values.flag);
  CHECK(values.whole == 8);
  CHECK(values.seed == 1'000'000'000);
  CHECK(values.length == 0.25);
  CHECK(values.count == 3);
  CHECK(values.time == 2.5);
  CHECK(values.text == "other");
  CHECK(values.file == "a/b.h5");
  CHECK(values.list == std::vector<std::string>{"one", "two"});
  CHECK(values.called == "me");
  CHECK(values.colour == Colour::green);
}

TEST_CASE("command line: an empty line leaves every variable as it was") {
  Values values;
  CHECK_FALSE(read(values, {}));
  CHECK_FALSE(values.flag);
  CHECK(values.whole == 4);
  CHECK_FALSE(values.count);
  CHECK(values.text == "runs");
  CHECK(values.colour == Colour::red);
}

TEST_CASE("command line: values outside their rules end with status 2") {
  for (const std::vector<std::string>& line : std::vector<std::vector<std::string>>{{"--whole", "0"},
                                                                                    {"--whole", "9"},
                                                                                    {"--whole", "2.5"},
                                                                                    {"--whole", "two"},
                                                                                    {"--seed", "-1"},
                                                                                    {"--seed", "1000000001"},
                                                                                    {"--limit", "-1"},
                                                                                    {"--length", "1.01"},
                                                                                    {"--length", "nan"},
                                                                                    {"--count", "3", "--time", "inf"},
                                                                                    {"--count", "0"},
                                                                                    {"--time", "2.5"},
                                                                                    {"--colour", "blue"},
                                                                                    {"--text"},
                                                                                    {"--unknown"},
                                                                                    {"in", "more"}}) {
    Values values;
    INFO(line[0] << " " << line.back());
    CHECK(read(values, line) == 2);
  }
}

TEST_CASE("command line: only a number right behind a flag is named as one that the flag does not take") {
  for (const auto& [line, named] :
       std::vector<std::pair<std::vector<std::string>, bool>>{{{"in", "-f", "2"}, true},
                                                              {{"in", "--flag", "2"}, true},
                                                              {{"in", "-f", "more"}, false},
                                                              {{"in", "--whole", "9"}, false},
                                                              {{"in", "2"}, false}}) {
    Values values;
    Captured errors(STDERR_FILENO);
    const std::optional<int> status = read(values, line);
    const std::string words = errors.text();
    INFO(line[1] << "\n" << words);
    CHECK(status == 2);
    CHECK((words.find(fmt::format("leave out '{}'", line.back())) != std::string::npos) == named);
  }
}

TEST_CASE("command line: a key and its value with spaces around = are shown without spaces") {
  for (const auto& [line, shown] :
       std::vector<std::pair<std::vector<std::string>, std::string>>{{{"in", "--set", "a", "=", "24"}, "write a=24\n"},
                                                                     {{"in", "--set", "a=", "24"}, "write a=24\n"},
                                                                     {{"in", "--set", "a", "=24"}, "write a=24\n"},
                                                                     {{"in", "--set", "a", "="}, "write a=\n"}}) {
    Values values;
    Captured errors(STDERR_FILENO);
    const std::optional<int> status = read(values, line);
    const std::string words = errors.text();
    INFO(words);
    CHECK(status == 2);
    CHECK(words.find("'--set' needs KEY=VALUE without spaces: " + shown) != std::string::npos);
  }
}

TEST_CASE("command line: a function may refuse its text as an input error") {
  Values values;
  CHECK_THROWS_WITH(read(values, {"--call", "bad"}), "--call: error: is bad; write another word");
}

TEST_CASE("command line: help shows the value of a variable as default, unless the table gives another text") {
  Values values;
  std::vector<Option> options = options_of(values);
  const auto text = [&](const std::string& names) {
    for (const Option& option : options)
      if (option.names == names) return default_text(option);
    return std::string("no such option");
  };
  CHECK(text("--whole") == "4");
  CHECK(text("--length") == "0.5");
  CHECK(text("--text") == "runs");
  CHECK(text("--colour") == "red");
  for (const char* without : {"argument", "-f,--flag", "--count", "--time", "--file", "--list", "--call"})
    CHECK(text(without).empty());
  options[2].rules.shown_default = "one per core";
  CHECK(text("--whole") == "one per core");
}

TEST_CASE("command line: the command that is called gets its options, and a program with commands needs one") {
  Values values;
  Command program{.name = "sample", .purpose = "Has commands.", .example = "sample run"};
  program.commands = {{"run", "runs", {{"--whole", "N", "a whole number", &values.whole}}, [] { return 7; }},
                      {"stop", "stops", {}, [] { return 8; }}};
  const Command* called = nullptr;
  CHECK_FALSE(read(program, {"run", "--whole", "3"}, &called));
  REQUIRE(called);
  CHECK(called->name == "run");
  CHECK(called->act() == 7);
  CHECK(values.whole == 3);
  CHECK_FALSE(read(program, {"stop"}, &called));
  CHECK(called->name == "stop");
  CHECK(read(program, {}, &called) == 2);
  CHECK(read(program, {"stop", "--whole", "3"}, &called) == 2);
  CHECK(read(program, {"walk"}, &called) == 2);
}

TEST_CASE("command line: the man page explains an argument whose meaning is more than its name") {
  Values values;
  const Command program{.name = "sample",
                        .purpose = "Reads.",
                        .options = {{"PLACE", "", "where it is", &values.text}, {"file", "", "INPUT", &values.file}},
                        .example = "sample x"};
  CHECK_THAT(program_manual(program, "man"),
             Catch::Contains(".TP\n\\fIPLACE\\fR\nwhere it is") && !Catch::Contains(".TP\n\\fIINPUT"));
}
