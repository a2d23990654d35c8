#include "pipeline/stage/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <limits>
#include <type_traits>

#include "pipeline/base/csv_rows.h"
#include "pipeline/base/errors.h"
#include "pipeline/base/installation.h"
#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/settings/fields.h"
#include "pipeline/stage/program_manual.h"
#include "pipeline/stage/stage.h"

namespace dresslife::pipeline {
namespace {

/// Adds an option to the parser: one function for each kind of target.
struct Adder {
  CLI::App& app;
  const Option& option;

  CLI::Option* operator()(bool* flag) const { return app.add_flag(option.names, *flag, option.meaning); }
  CLI::Option* operator()(std::string* text) const { return added(*text); }
  CLI::Option* operator()(std::vector<std::string>* list) const {
    const bool is_argument = option.names[0] != '-';
    return added(*list)->allow_extra_args(is_argument);
  }
  CLI::Option* operator()(std::filesystem::path* path) const {
    return (*this)([path](const std::string& text) { *path = text; });
  }
  CLI::Option* operator()(const std::function<void(const std::string&)>& take) const {
    return app.add_option_function<std::string>(option.names, take, option.meaning);
  }
  template <class Number>
  CLI::Option* operator()(Number* number) const {
    return within<Number>(added(*number));
  }
  template <class Number>
  CLI::Option* operator()(std::optional<Number>* number) const {
    return within<Number>(added(*number));
  }

 private:
  template <class Value>
  CLI::Option* added(Value& value) const {
    return app.add_option(option.names, value, option.meaning);
  }
  /// Refuses numbers outside of the range, and non-finite ones.
  template <class Number>
  CLI::Option* within(CLI::Option* number) const {
    const auto& range = option.rules.range;
    const Number low = range ? static_cast<Number>(range->at(0)) : std::numeric_limits<Number>::lowest();
    const Number high = range ? static_cast<Number>(range->at(1)) : std::numeric_limits<Number>::max();
    const std::string bounds = range ? fmt::format("{} .. {}", low, high) : "";
    return number->check(CLI::Validator(
        [low, high, bounds](const std::string& text) {
          Number value{};
          const bool wraps = std::is_unsigned_v<Number> && text.find('-') != std::string::npos;  // -1 to 2^64 - 1
          if (!wraps && CLI::detail::lexical_cast(text, value) && value >= low && value <= high) return std::string();
          return fmt::format("'{}' is no {}{}", text, std::is_floating_point_v<Number> ? "number" : "whole number",
                             bounds.empty() ? "" : " in " + bounds);
        },
        bounds));
  }
};

void add_options(CLI::App& app, const std::vector<Option>& options) {
  for (const Option& option : options) {
    CLI::Option* const added = std::visit(Adder{app, option}, option.target);
    if (!std::holds_alternative<bool*>(option.target)) added->type_name(option.value);
    added->required(option.rules.required)->default_str(default_text(option));
    if (!option.rules.choices.empty() && !option.rules.other_values) added->check(CLI::IsMember(option.rules.choices));
    if (!option.rules.needs.empty()) added->needs(option.rules.needs);
  }
}

void add_manual(CLI::App& app, const Command& program, const Option& manual) {
  app.add_option_function<std::string>(
         manual.names,
         [&program](const std::string& kind) {
           std::fputs(program_manual(program, kind).c_str(), stdout);
           throw CLI::Success();
         },
         manual.meaning)
      ->check(CLI::IsMember(manual.rules.choices))
      ->type_name(manual.value)
      ->trigger_on_parse();
}

/// Returns whether the first word of a command line should be a command, and is none.
bool is_no_command(const Command& program, int argc, char** argv) {
  return argc > 1 && argv[1][0] != '-' && !program.commands.empty() &&
         std::ranges::find(program.commands, argv[1], &Command::name) == program.commands.end();
}

/// Returns the option that a word of a command line names; null: none.
const Option* option_named(const Command& command, const std::string& word) {
  const auto found = std::ranges::find_if(command.options, [&](const Option& option) {
    return word.starts_with('-') && (',' + option.names + ',').find(',' + word + ',') != std::string::npos;
  });
  return found == command.options.end() ? nullptr : &*found;
}

/// Returns "'--trial' is no option of improve; did you mean '--trials'?" for the first unknown option with a similar name, or a
/// message for a number behind a flag, or for an option without its value. Empty: there is none of these.
std::string meant_option(const Command& program, int argc, char** argv) {
  const auto called = std::ranges::find_if(program.commands,
                                           [&](const Command& command) { return argc > 1 && command.name == argv[1]; });
  const Command& command = called == program.commands.end() ? program : *called;
  std::vector<std::string> names{"--help"};
  for (const Option& option : command.options)
    if (const std::size_t at = option.names.find("--"); at != std::string::npos)
      names.push_back(option.names.substr(at));
  for (int k = 1; k < argc; ++k) {
    const std::string word = std::string(argv[k]).substr(0, std::string_view(argv[k]).find('='));
    if (!word.starts_with("--") || std::ranges::find(names, word) != names.end()) continue;
    if (const std::string near = nearest_word(word, names); !near.empty())
      return fmt::format("'{}' is no option of {}; did you mean '{}'?\n", shown(word), command.name, near);
  }
  // In "run -n 2", a number follows a flag.
  for (int k = 2; k < argc; ++k) {
    const Option* const option = option_named(command, argv[k - 1]);
    if (!option) continue;
    const bool is_flag = std::holds_alternative<bool*>(option->target);
    if (is_flag && number_in(argv[k]))
      return fmt::format("'{}' takes no number ({}); leave out '{}'\n", argv[k - 1], option->meaning, argv[k]);
    const std::string word = argv[k], next = k + 1 < argc ? argv[k + 1] : "";
    if (option->value.find('=') != std::string::npos && !next.empty() &&
        (word.ends_with('=') || (word.find('=') == std::string::npos && next[0] == '=')))
      return fmt::format("'{}' needs {} without spaces: write {}{}\n", argv[k - 1], option->value, word + next,
                         next == "=" && k + 2 < argc ? argv[k + 2] : "");
    if (!is_flag && option_named(command, argv[k]))
      return fmt::format("'{}' needs {} before '{}'\n", argv[k - 1], option->value, argv[k]);
  }
  return "";
}

/// Returns "manual needs KEY, keys or files; see 'dresslife manual --help'" if that word is missing behind a command.
std::string missing_word(const Command& program, int argc, char** argv, const std::string& problem) {
  for (const Command& command : program.commands)
    for (const Option& option : command.options)
      if (argc > 1 && command.name == argv[1] && option.rules.required && option.names[0] != '-' &&
          problem == option.names + " is required")
        return fmt::format("{} needs {}; see '{} {} --help'\n", command.name, option.meaning, program.name,
                           command.name);
  return "";
}

}  // namespace

Option number_option(const std::string& names, const std::string& value, const std::string& meaning, Target target,
                     double low, double high, OptionRules rules) {
  rules.range = {{low, high}};
  return {names, value, meaning, std::move(target), std::move(rules)};
}

std::vector<Option> joined(std::initializer_list<std::vector<Option>> tables) {
  std::vector<Option> all;
  for (const std::vector<Option>& table : tables) all.insert(all.end(), table.begin(), table.end());
  return all;
}

std::string default_text(const Option& option) {
  if (option.rules.shown_default) return *option.rules.shown_default;
  const auto shown = [](const auto& target) -> std::string {
    using Value = std::decay_t<decltype(target)>;
    if constexpr (std::is_same_v<Value, std::string*> || std::is_same_v<Value, int*> ||
                  std::is_same_v<Value, std::uint64_t*> || std::is_same_v<Value, double*>)
      return fmt::format("{}", *target);
    else
      return "";
  };
  return std::visit(shown, option.target);
}

Option help_option() { return {"-h,--help", "", "print this help and exit", {}}; }

std::vector<Option> last_options(const Command& program) {
  std::vector<Option> options{{"--version", "", "print the version and exit", {}}};
  if (program.commands.empty())
    options.push_back({"--manual",
                       joined(manual_kinds(), "|"),
                       "print this program's man page, or its completion for a shell",
                       std::function<void(const std::string&)>(),
                       {.choices = manual_kinds()}});
  return options;
}

std::optional<int> read_command_line(const Command& program, int argc, char** argv, const Command** called) {
  const Option help = help_option();
  const std::vector<Option> last = last_options(program);
  const std::string example = "\n\nExample: " + program.example;
  CLI::App app(program.purpose + example, program.name);
  app.set_help_flag(help.names, help.meaning);
  add_options(app, program.options);
  app.set_version_flag(
      last[0].names, [&] { return version_text(program.name); }, last[0].meaning);
  if (program.commands.empty()) add_manual(app, program, last[1]);
  std::vector<const CLI::App*> commands;
  for (const Command& command : program.commands) {
    commands.push_back(app.add_subcommand(command.name, command.purpose));
    add_options(*app.get_subcommand(command.name), command.options);
  }
  if (!commands.empty()) app.require_subcommand(1);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    if (!commands.empty() && argc > 1 && std::string_view(argv[1]) == "help") {
      const std::vector<Command>& all = program.commands;
      const auto of = std::ranges::find_if(all, [&](const Command& one) { return argc > 2 && one.name == argv[2]; });
      fmt::print("{}", of == all.end() ? app.help() : app.get_subcommand(of->name)->help(program.name));
      return finish_output(0);
    }
    if (const std::string missing = missing_word(program, argc, argv, problem.what()); !missing.empty()) {
      fmt::print(stderr, "{}", missing);
      return finish_output(2);
    }
    if (problem.get_exit_code() != 0 && is_no_command(program, argc, argv)) {
      const std::string meant = nearest_word(argv[1], mapped(program.commands, &Command::name));
      fmt::print(stderr, "'{}' is no command of {}; {}\n", shown(argv[1]), program.name,
                 meant.empty() ? fmt::format("'{} --help' lists them", program.name)
                               : fmt::format("did you mean '{}'?", meant));
      return finish_output(2);
    }
    if (problem.get_exit_code() != 0) fmt::print(stderr, "{}", meant_option(program, argc, argv));
    return finish_output(app.exit(problem) == 0 ? 0 : 2);
  }
  for (std::size_t k = 0; k < commands.size(); ++k)
    if (commands[k]->parsed()) *called = &program.commands[k];
  return {};
}

}  // namespace dresslife::pipeline
