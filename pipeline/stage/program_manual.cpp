#include "pipeline/stage/program_manual.h"

#include <fmt/format.h>

#include <stdexcept>

#include "pipeline/base/installation.h"
#include "pipeline/base/joined.h"
#include "pipeline/base/text.h"

namespace dresslife::pipeline {
namespace {

using Words = std::vector<std::string>;

bool is_argument(const Option& option) { return !option.names.starts_with('-'); }

/// Returns the meaning of an option. Empty for an argument whose meaning is one word, because this word is its name.
std::string meaning_of(const Option& option) {
  return is_argument(option) && option.meaning.find(' ') == std::string::npos ? "" : option.meaning;
}

/// Returns the options, including those that every program has.
std::vector<Option> all_options(const Command& command, bool is_program) {
  return joined({{help_option()}, command.options, is_program ? last_options(command) : std::vector<Option>{}});
}

/// Returns the two names of "-o,--output"; for an argument, the word that names it.
Words names_of(const Option& option) {
  if (is_argument(option)) return {meaning_of(option).empty() ? option.meaning : option.names};
  const std::size_t comma = option.names.find(',');
  if (comma == std::string::npos) return {option.names};
  return {option.names.substr(0, comma), option.names.substr(comma + 1)};
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
  for (const Option& option : command.options)
    if (is_argument(option)) line += fmt::format(" \\fI{}\\fR", troff(names_of(option)[0]));
  return line + "\n";
}

std::string man_options(const std::vector<Option>& options) {
  std::string text;
  for (const Option& option : options) {
    if (is_argument(option) && meaning_of(option).empty()) continue;  // the list of arguments shows its name already
    std::string names;
    for (const std::string& name : names_of(option))
      names += fmt::format("{}\\f{}{}\\fR", names.empty() ? "" : ", ", is_argument(option) ? 'I' : 'B', troff(name));
    if (!option.value.empty()) names += " \\fI" + troff(option.value) + "\\fR";
    std::string meaning = troff(option.meaning);
    const Words& choices = option.rules.choices;
    if (!choices.empty()) meaning += fmt::format(" ({})", joined(choices, ", "));
    const std::string by_default = default_text(option);
    if (!by_default.empty()) meaning += fmt::format(" (default: {})", troff(by_default));
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

/// Returns a purpose in the form of a list of programs: "simulates how ...", without a full stop.
std::string in_short(std::string purpose) {
  if (purpose.ends_with('.')) purpose.pop_back();
  if (!purpose.empty()) purpose[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(purpose[0])));
  return purpose;
}

std::string man_page(const Command& program) {
  const std::string name = upper_case(program.name);
  std::string synopsis, commands;
  if (program.commands.empty()) synopsis = man_synopsis(program.name, program);
  for (const Command& command : program.commands) {
    synopsis += (synopsis.empty() ? "" : ".br\n") + man_synopsis(program.name + " " + command.name, command);
    commands += fmt::format(".SS {}\n{}.\n{}", troff(command.name), troff(command.purpose),
                            man_options(all_options(command, false)));
  }
  return fmt::format(
      ".TH {} 1 \"\" \"dresslife {}\" \"dresslife\"\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n{}.SH "
      "DESCRIPTION\n{}\n"
      ".SH OPTIONS\n{}{}{}{}.SH EXAMPLE\n.EX\n{}\n.EE\n",
      troff(name), version(), troff(program.name), troff(in_short(program.purpose)), synopsis, troff(program.purpose),
      man_options(all_options(program, true)), commands.empty() ? "" : ".SH COMMANDS\n", commands, man_common,
      troff(program.example));
}

// ---- bash -------------------------------------------------------------------------------------------------

/// Adds the cases of `case "$level" in` and of `case "$level $before" in` for a program or a command.
void add_bash_cases(const std::string& level, const Command& command, bool is_program, std::string& options,
                    std::string& values) {
  Words names, words;
  for (const Option& option : all_options(command, is_program)) {
    const Words& choices = option.rules.choices;
    if (is_argument(option)) {
      words.insert(words.end(), choices.begin(), choices.end());
      continue;
    }
    for (const std::string& name : names_of(option)) {
      names.push_back(name);
      if (choices.empty()) continue;
      values += fmt::format("    '{} {}') words='{}' ;;\n", level, name, joined(choices, " "));
    }
  }
  for (const Command& inner : command.commands) words.push_back(inner.name);
  options += fmt::format("    '{}') options='{}' words='{}' ;;\n", level, joined(names, " "), joined(words, " "));
}

std::string function_name(const Command& program) { return "_" + replaced(program.name, '-', "_"); }

std::string bash_completion(const Command& program) {
  std::string options, values;
  add_bash_cases(program.name, program, true, options, values);
  for (const Command& command : program.commands)
    add_bash_cases(program.name + " " + command.name, command, false, options, values);
  const std::string find_command = program.commands.empty() ? "" : R"(  for ((k = 1; k < COMP_CWORD; ++k)); do
    [[ ${COMP_WORDS[k]} == -* ]] || { level+=" ${COMP_WORDS[k]}" && break; }
  done
)";
  // If no word is offered, bash completes file names (-o default).
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

/// Escapes a text for '...' and for the [...] or the parts between : of a specification.
std::string zsh_text(const std::string& text) {
  std::string escaped = replaced(text, '\'', "'\\''");
  for (const char special : {'[', ']', ':'}) escaped = replaced(escaped, special, std::string("\\") + special);
  return escaped;
}

std::string zsh_value(const Option& option, const std::string& what) {
  const Words& choices = option.rules.choices;
  const std::string action = choices.empty() ? std::string("_files") : fmt::format("({})", joined(choices, " "));
  return fmt::format(":{}:{}", zsh_text(what), action);
}

/// Returns the words behind `_arguments`, one per line.
std::string zsh_options(const std::vector<Option>& options, const std::string& indent) {
  std::string text;
  for (const Option& option : options) {
    const Words names = names_of(option);
    if (is_argument(option)) {
      text += fmt::format(" \\\n{}'1{}'", indent, zsh_value(option, names[0]));
      continue;
    }
    const bool repeatable = std::holds_alternative<std::vector<std::string>*>(option.target);
    const std::string value = option.value.empty() ? "" : zsh_value(option, option.value);
    for (const std::string& name : names) {
      const std::string others = repeatable ? "*" : fmt::format("({})", joined(names, " "));
      text += fmt::format(" \\\n{}'{}{}[{}]{}'", indent, others, name, zsh_text(option.meaning), value);
    }
  }
  return text;
}

std::string zsh_completion(const Command& program) {
  const std::string head =
      fmt::format("#compdef {0}\n# Completion of {0} for zsh, made from its own options.\n", program.name);
  if (program.commands.empty()) return head + "_arguments" + zsh_options(all_options(program, true), "  ") + "\n";
  std::string names, cases;
  for (const Command& command : program.commands) {
    names += fmt::format("  '{}:{}'\n", command.name, zsh_text(command.purpose));
    cases += fmt::format("  {}) _arguments{} ;;\n", command.name, zsh_options(all_options(command, false), "      "));
  }
  return fmt::format(
      "{}local state line\nlocal -a commands=(\n{})\n_arguments -C{} \\\n  '1: :->command' \\\n"
      "  '*:: :->rest'\n[[ $state == command ]] && _describe command commands\n"
      "[[ $state == rest ]] && case $words[1] in\n{}esac\n",
      head, names, zsh_options(all_options(program, true), "  "), cases);
}

}  // namespace

const std::vector<std::string>& manual_kinds() {
  static const Words kinds{"man", "bash", "zsh"};
  return kinds;
}

std::string program_manual(const Command& program, const std::string& kind) {
  if (kind == "man") return man_page(program);
  if (kind == "bash") return bash_completion(program);
  if (kind == "zsh") return zsh_completion(program);
  throw std::logic_error("no manual of kind '" + kind + "'");
}

}  // namespace dresslife::pipeline
