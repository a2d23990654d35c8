// Command lines as tables. A table binds each option of a program, or of one of its commands, to the variable that takes its
// value. The tables also give --help, the man page and the completions (program_manual.h). Only command_line.cpp includes the
// parser, because the parser takes long to compile.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace dresslife::pipeline {

/// Destination of an option's value. bool: a flag without a value. A list: several arguments, or an option that may be given several times. A function: it
/// gets the text and may throw InputError.
using Target =
    std::variant<bool*, int*, std::uint64_t*, double*, std::optional<int>*, std::optional<double>*, std::string*,
                 std::filesystem::path*, std::vector<std::string>*, std::function<void(const std::string&)>>;

struct OptionRules {
  bool required = false;
  std::optional<std::array<double, 2>> range = {};  ///< smallest and largest value of a number
  std::vector<std::string> choices = {};            ///< the values that are allowed; empty: any
  bool other_values = false;                        ///< other values are allowed too; completions offer the choices
  std::string needs = {};                           ///< another option that is required with this one
  std::optional<std::string> shown_default = {};  ///< absent: the value of the variable before the command line is read
};

/// An option, or an argument without a dash.
struct Option {
  std::string names;    ///< "-o,--output"; for an argument: "study"
  std::string value;    ///< name of the option's value: "DIR"; empty for flags and arguments
  std::string meaning;  ///< for an argument: a sentence, or one word that names it ("JOB.yaml")
  Target target;
  OptionRules rules = {};
};

/// A program, or a command of a program.
struct Command {
  std::string name;     ///< "dresslife-sim", "run"
  std::string purpose;  ///< one sentence
  std::vector<Option> options = {};
  std::function<int()> act = {};       ///< does the work of a command and returns the exit status; throws InputError
  std::string example = {};            ///< of a program: a complete command line
  std::vector<Command> commands = {};  ///< of a program: one of them is required
};

/// Returns an option whose value is a number from `low` to `high`.
Option number_option(const std::string& names, const std::string& value, const std::string& meaning, Target target,
                     double low, double high, OptionRules rules = {});

/// Returns an option that sets an enumeration by one of its words: "surrogate|random". word(Choice) returns the words.
template <class Choice>
Option choice_option(const std::string& names, const std::string& meaning, Choice& target,
                     std::initializer_list<Choice> values) {
  Option option{names, "", meaning, {}, {}};
  for (const Choice value : values) {
    option.rules.choices.emplace_back(word(value));
    option.value += (option.value.empty() ? "" : "|") + option.rules.choices.back();
  }
  option.rules.shown_default = word(target);
  option.target = [&target, values = std::vector<Choice>(values)](const std::string& text) {
    for (const Choice value : values)
      if (text == word(value)) target = value;
  };
  return option;
}

/// Joins several tables into one.
std::vector<Option> joined(std::initializer_list<std::vector<Option>> tables);

/// Returns the default that help shows for an option; empty: none.
std::string default_text(const Option& option);

/// Every program and command has --help. Every program has --version, and --manual if it has no commands. These options have no
/// target.
Option help_option();
std::vector<Option> last_options(const Command& program);

/// Reads the command line into the targets of `program` and of its command; `called` then points to that command. Returns an exit
/// status if no work remains: the line is wrong, or it has --help, --version or --manual.
std::optional<int> read_command_line(const Command& program, int argc, char** argv, const Command** called = nullptr);

}  // namespace dresslife::pipeline
