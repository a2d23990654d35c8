// Command lines as tables. A table binds each option of a program, or of one of its commands, to the variable that
// takes its value. The same tables give --help, the man page and the completions (program_manual.h).
// Only command_line.cpp includes the parser, because the parser takes long to compile.
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

/// Where the value of an option goes. bool: a flag, which takes no value. A list: the option may be given several
/// times. A function: it receives the text, and may throw InputError.
using Target = std::variant<bool*, int*, std::uint64_t*, double*, std::optional<int>*, std::optional<double>*,
                            std::string*, std::filesystem::path*, std::vector<std::string>*,
                            std::function<void(const std::string&)>>;

struct OptionRules {
  bool required = false;
  std::optional<std::array<double, 2>> range = {};  ///< smallest and largest value of a number
  std::vector<std::string> choices = {};            ///< the values that are allowed; empty: any
  bool other_values = false;                        ///< beside the choices, which completions offer
  std::string needs = {};                           ///< another option, which must be given as well
  std::optional<std::string> shown_default = {};    ///< absent: the value of the variable before the line is read
};

/// An option, or an argument without a dash.
struct Option {
  std::string names;    ///< "-o,--output"; of an argument: "study"
  std::string value;    ///< what the option takes: "DIR"; empty for flags and arguments
  std::string meaning;  ///< of an argument: a sentence, or one word that stands for it ("JOB.yaml")
  Target target;
  OptionRules rules = {};
};

/// A program, or a command of a program.
struct Command {
  std::string name;     ///< "dresslife-sim", "run"
  std::string purpose;  ///< one sentence
  std::vector<Option> options = {};
  std::function<int()> act = {};        ///< does the work of a command; returns the exit status. Errors: InputError
  std::string example = {};             ///< of a program: a command that can be typed
  std::vector<Command> commands = {};   ///< of a program: one of them must be called
};

/// An option that sets an enumeration by one of its words: "surrogate|random". word(Choice) gives them.
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

/// One table out of several.
std::vector<Option> joined(std::initializer_list<std::vector<Option>> tables);

/// What help shows for an option that is absent from the line; empty: nothing.
std::string default_text(const Option& option);

/// Every program and command has --help. Every program has --version, and --manual unless it has commands. These
/// options have no target.
Option help_option();
std::vector<Option> last_options(const Command& program);

/// Reads the command line into the targets of `program` and of the command that is called, to which `called` then
/// points. Returns the exit status when nothing remains to be done: the line is wrong, or it asked for --help, --version or
/// --manual.
std::optional<int> read_command_line(const Command& program, int argc, char** argv, const Command** called = nullptr);

}  // namespace dresslife::pipeline
