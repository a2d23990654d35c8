#include "sim/program/interpreter/request.h"

#include "sim/program/interpreter/parser.h"

namespace dresslife::sim {
namespace {

const TokenRules& rules_of(Grammar grammar) {
  static constexpr TokenRules krl_rules{';', "$#", true, true}, rapid_rules{'!', "", false, false},
      script_rules{'#', "$", true, true};
  return grammar == Grammar::krl ? krl_rules : grammar == Grammar::rapid ? rapid_rules : script_rules;
}

/// Adds the text as a separate source file and calls `read` for it.
template <class Read>
void read_text(Code& code, const std::string& name, const std::string& text, Grammar grammar, Problems& problems,
               const Read& read) {
  code.files.emplace_back(name, text);
  const int file = static_cast<int>(code.files.size()) - 1;
  const std::vector<Token> tokens = tokens_of(code.files[file], rules_of(grammar), problems);
  Cursor at(tokens, file, grammar);
  try {
    read(at);
    if (!at.at_end()) at.fail(fmt::format("has {} behind its end", at.seen()), "give it as in a program");
  } catch (const SyntaxError& error) {
    problems.add({name, error.place.line, error.place.column}, error.what, error.remedy);
  }
}

}  // namespace

std::string value_key(const std::string& name) {
  std::string key;
  for (char c : lower_case(name)) {
    if (static_cast<unsigned char>(c) <= ' ') continue;
    if (c == ',')
      key += "][";
    else
      key += c == '{' ? '[' : c == '}' ? ']' : c;
  }
  return key;
}

std::pair<std::string, std::string> routine_and_arguments(const std::string& written) {
  const std::size_t end = std::min(written.find_first_of("( \t"), written.size());
  std::string arguments = written.substr(end);
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!arguments.empty() && blank(arguments.front())) arguments.erase(0, 1);
  while (!arguments.empty() && blank(arguments.back())) arguments.pop_back();
  if (arguments.size() >= 2 && arguments.front() == '(' && arguments.back() == ')')
    arguments = arguments.substr(1, arguments.size() - 2);
  return {written.substr(0, end), arguments};
}

namespace {

/// Values of $CONFIG.DAT as delivered by KUKA. 11 of 11 public backups have this PDEFAULT and LDEFAULT, 10 this FHOME.
constexpr std::pair<const char*, const char*> delivered[] = {{"pdefault", "{VEL 100, ACC 100, APO_DIST 100}"},
                                                             {"ldefault", "{VEL 2, ACC 100, APO_DIST 100}"},
                                                             {"fhome", "{TOOL_NO 1, BASE_NO 0, IPO_FRAME #BASE}"},
                                                             {"def_vel_cp", "2"}};

}  // namespace

void add_requests(Code& code, const ImportOptions& options, Grammar grammar, Problems& problems) {
  for (const auto& [name, text] : options.values)
    read_text(code, "value " + name, text, grammar, problems,
              [&, &name = name](Cursor& at) { code.values[value_key(name)] = at.expression(); });
  for (const auto& [line, text] : options.choose)
    read_text(code, "assumption " + line, text, grammar, problems,
              [&, &line = line](Cursor& at) { code.choices[line] = at.expression(); });
  for (const auto& [name, text] : delivered)
    if (grammar == Grammar::krl)
      read_text(code, std::string("delivered ") + name, text, grammar, problems,
                [&, &name = name, &text = text](Cursor& at) {
                  code.presets[name] = {text, at.expression()};
                });
  const auto [routine, arguments] = routine_and_arguments(options.routine);
  code.start = lower_case(routine);
  if (!arguments.empty())
    read_text(code, "routine " + routine, arguments, grammar, problems,
              [&](Cursor& at) { code.start_arguments = at.arguments(""); });
}

}  // namespace dresslife::sim
