#include "pipeline/stage/program_manual.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <stdexcept>

#include "pipeline/base/installation.h"

namespace dresslife::pipeline {
namespace {

using Words = std::vector<std::string>;

/// One option or positional argument, out of the parser's own description of it.
struct Argument {
  Words names;        ///< "-o", "--output"; of a positional one: what stands for it, "JOB.yaml"
  std::string value;  ///< what an option takes: "FILE"; "" of a flag
  Words choices;      ///< the words that it may take, when only some are allowed
  std::string meaning, by_default;
  bool positional = false, repeatable = false;
};

/// The program itself, or one of its commands.
struct Command {
  std::string name, purpose, example;
  std::vector<Argument> arguments;
  std::vector<Command> commands;
};

/// Of "{man,bash,zsh}", as the parser describes a check against a list.
Words listed_words(const std::string& type) {
  const std::size_t begin = type.find('{'), end = type.rfind('}');
  if (begin == std::string::npos || end == std::string::npos) return {};
  return CLI::detail::split(type.substr(begin + 1, end - begin - 1), ',');
}

Argument argument_of(const CLI::Option& option) {
  Argument argument;
  const std::string type = option.get_type_name();
  argument.positional = !option.nonpositional();
  argument.meaning = option.get_description();
  argument.choices = listed_words(type);
  argument.by_default = option.get_default_str();
  argument.repeatable = option.get_items_expected_max() > 1;
  if (argument.positional) {
    const bool stands_for_it = argument.meaning.find(' ') == std::string::npos;
    argument.names = {stands_for_it ? argument.meaning : option.get_name(true)};
    if (stands_for_it) argument.meaning.clear();
    return argument;
  }
  for (const std::string& name : option.get_snames()) argument.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) argument.names.push_back("--" + name);
  if (option.get_items_expected_max() > 0) argument.value = type.substr(0, type.find(':'));
  return argument;
}

Command command_of(const CLI::App& app) {
  Command command{app.get_name(), app.get_description(), "", {}, {}};
  if (const std::size_t mark = command.purpose.find(example_mark); mark != std::string::npos) {
    command.example = command.purpose.substr(mark + std::string(example_mark).size());
    command.purpose.resize(mark);
  }
  for (const CLI::Option* option : app.get_options()) command.arguments.push_back(argument_of(*option));
  for (const CLI::App* inner : app.get_subcommands([](const CLI::App*) { return true; }))
    command.commands.push_back(command_of(*inner));
  return command;
}

std::string replaced(std::string text, char what, const std::string& by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, 1, by);
  return text;
}

// ---- troff ------------------------------------------------------------------------------------------------

std::string troff(const std::string& text) {
  std::string escaped = replaced(replaced(text, '\\', "\\e"), '-', "\\-");
  if (escaped.starts_with('.') || escaped.starts_with('\'')) escaped = "\\&" + escaped;
  return escaped;
}

std::string man_synopsis(const std::string& words, const Command& command) {
  std::string line = fmt::format("\\fB{}\\fR [\\fIoptions\\fR]", troff(words));
  for (const Argument& argument : command.arguments)
    if (argument.positional) line += fmt::format(" \\fI{}\\fR", troff(argument.names[0]));
  return line + "\n";
}

std::string man_arguments(const Command& command) {
  std::string text;
  for (const Argument& argument : command.arguments) {
    if (argument.positional && argument.meaning.empty()) continue;  // its name says all
    std::string names;
    for (const std::string& name : argument.names)
      names += fmt::format("{}\\f{}{}\\fR", names.empty() ? "" : ", ", argument.positional ? 'I' : 'B',
                           troff(name));
    if (!argument.value.empty()) names += " \\fI" + troff(argument.value) + "\\fR";
    std::string meaning = troff(argument.meaning);
    if (!argument.choices.empty()) meaning += fmt::format(" ({})", fmt::join(argument.choices, ", "));
    if (!argument.by_default.empty()) meaning += fmt::format(" (default: {})", troff(argument.by_default));
    text += fmt::format(".TP\n{}\n{}\n", names, meaning);
  }
  return text;
}

constexpr const char* man_common = R"(.SH EXIT STATUS
0 done; 1 the input is wrong; 2 the command line is wrong; 3 a fault of the program.
.SH ENVIRONMENT
.TP
\fBDRESSLIFE_CONFIG\fR
a folder to take as the catalogue instead of the one that came with the programs
.TP
\fBDRESSLIFE_THREADS\fR
how many threads a stage may use; by default as many as there are cores
.TP
\fBDRESSLIFE_KERNELS\fR
the instruction set of the hot loops: portable, avx2 or avx512; by default the widest of the machine
.SH FILES
.TP
\fI../share/dresslife/config\fR
seen from the program's folder: the catalogue of robots, programs, dresspacks, materials, jobs and studies
.TP
\fI../share/doc/dresslife\fR
seen from there: what every key means, and what every file holds
)";

/// As a list of programs has it: "simulates how ...", without an end.
std::string in_short(std::string purpose) {
  if (purpose.ends_with('.')) purpose.pop_back();
  if (!purpose.empty()) purpose[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(purpose[0])));
  return purpose;
}

std::string man_page(const Command& program) {
  std::string name = program.name, synopsis, commands;
  for (char& c : name) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  if (program.commands.empty()) synopsis = man_synopsis(program.name, program);
  for (const Command& command : program.commands) {
    synopsis += (synopsis.empty() ? "" : ".br\n") + man_synopsis(program.name + " " + command.name, command);
    commands +=
        fmt::format(".SS {}\n{}.\n{}", troff(command.name), troff(command.purpose), man_arguments(command));
  }
  return fmt::format(
      ".TH {} 1 \"\" \"dresslife {}\" \"dresslife\"\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n{}.SH "
      "DESCRIPTION\n{}\n"
      ".SH OPTIONS\n{}{}{}{}.SH EXAMPLE\n.EX\n{}\n.EE\n",
      troff(name), version(), troff(program.name), troff(in_short(program.purpose)), synopsis,
      troff(program.purpose), man_arguments(program), commands.empty() ? "" : ".SH COMMANDS\n", commands,
      man_common, troff(program.example));
}

// ---- bash -------------------------------------------------------------------------------------------------

/// Cases of `case "$level" in` and of `case "$level $before" in` for a program or a command.
void add_bash_cases(const std::string& level, const Command& command, std::string& options,
                    std::string& values) {
  Words names, words;
  for (const Argument& argument : command.arguments) {
    if (argument.positional) {
      words.insert(words.end(), argument.choices.begin(), argument.choices.end());
      continue;
    }
    names.insert(names.end(), argument.names.begin(), argument.names.end());
    if (argument.choices.empty()) continue;
    for (const std::string& name : argument.names)
      values += fmt::format("    '{} {}') words='{}' ;;\n", level, name, fmt::join(argument.choices, " "));
  }
  for (const Command& inner : command.commands) words.push_back(inner.name);
  options += fmt::format("    '{}') options='{}' words='{}' ;;\n", level, fmt::join(names, " "),
                         fmt::join(words, " "));
}

std::string function_name(const Command& program) { return "_" + replaced(program.name, '-', "_"); }

std::string bash_completion(const Command& program) {
  std::string options, values;
  add_bash_cases(program.name, program, options, values);
  for (const Command& command : program.commands)
    add_bash_cases(program.name + " " + command.name, command, options, values);
  const std::string find_command = program.commands.empty() ? "" : R"(  for ((k = 1; k < COMP_CWORD; ++k)); do
    [[ ${COMP_WORDS[k]} == -* ]] || { level+=" ${COMP_WORDS[k]}" && break; }
  done
)";
  // Where no word is offered, bash completes file names (-o default).
  return fmt::format(R"(# Completion of {0} for bash, made from its own options.
{1}() {{
  local k level={0} options= words= word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}}
{2}  case $level in
{3}  esac
  case "$level $before" in
{4}  esac
  [[ $word == -* ]] && words=$options
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
}}
complete -o default -F {1} {0}
)",
                     program.name, function_name(program), find_command, options, values);
}

// ---- zsh --------------------------------------------------------------------------------------------------

/// Inside '...' and inside the [...] or between the : of a specification.
std::string zsh_text(const std::string& text) {
  std::string escaped = replaced(text, '\'', "'\\''");
  for (const char special : {'[', ']', ':'})
    escaped = replaced(escaped, special, std::string("\\") + special);
  return escaped;
}

std::string zsh_value(const Argument& argument, const std::string& what) {
  const std::string action = argument.choices.empty() ? std::string("_files")
                                                      : fmt::format("({})", fmt::join(argument.choices, " "));
  return fmt::format(":{}:{}", zsh_text(what), action);
}

/// The words after `_arguments`, one line each.
std::string zsh_arguments(const Command& command, const std::string& indent) {
  std::string text;
  for (const Argument& argument : command.arguments) {
    const std::string& last = argument.names.back();
    if (argument.positional) {
      text += fmt::format(" \\\n{}'1{}'", indent, zsh_value(argument, last));
      continue;
    }
    const std::string value = argument.value.empty() ? "" : zsh_value(argument, argument.value);
    for (const std::string& name : argument.names) {
      const std::string others =
          argument.repeatable ? "*" : fmt::format("({})", fmt::join(argument.names, " "));
      text += fmt::format(" \\\n{}'{}{}[{}]{}'", indent, others, name, zsh_text(argument.meaning), value);
    }
  }
  return text;
}

std::string zsh_completion(const Command& program) {
  const std::string head =
      fmt::format("#compdef {0}\n# Completion of {0} for zsh, made from its own options.\n", program.name);
  if (program.commands.empty()) return head + "_arguments" + zsh_arguments(program, "  ") + "\n";
  std::string names, cases;
  for (const Command& command : program.commands) {
    names += fmt::format("  '{}:{}'\n", command.name, zsh_text(command.purpose));
    cases += fmt::format("  {}) _arguments{} ;;\n", command.name, zsh_arguments(command, "      "));
  }
  return fmt::format(
      "{}local state line\nlocal -a commands=(\n{})\n_arguments -C{} \\\n  '1: :->command' \\\n"
      "  '*:: :->rest'\n[[ $state == command ]] && _describe command commands\n"
      "[[ $state == rest ]] && case $words[1] in\n{}esac\n",
      head, names, zsh_arguments(program, "  "), cases);
}

}  // namespace

const std::vector<std::string>& manual_kinds() {
  static const Words kinds{"man", "bash", "zsh"};
  return kinds;
}

std::string program_manual(const CLI::App& program, const std::string& kind) {
  const Command command = command_of(program);
  if (kind == "man") return man_page(command);
  if (kind == "bash") return bash_completion(command);
  if (kind == "zsh") return zsh_completion(command);
  throw std::logic_error("no manual of kind '" + kind + "'");
}

}  // namespace dresslife::pipeline
