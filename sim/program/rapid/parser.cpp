#include <algorithm>
#include <utility>

#include "sim/program/interpreter/parser.h"
#include "sim/program/rapid/rapid.h"

namespace dresslife::sim {
namespace {

using Kind = Statement::Kind;

class RapidParser : StatementParser {
 public:
  RapidParser(Code& code, int file, const std::vector<Token>& tokens, Problems& problems)
      : StatementParser(code, file, tokens, problems, Grammar::rapid) {}

  void run() {
    while (!at_.at_end() && !at_.at_word("module")) at_.next();  // skips %%% VERSION and LANGUAGE %%%
    while (!at_.at_end() && !problems_.full()) module();
  }

 private:
  void module() {
    if (!at_.take_word("module")) {
      at_.next();
      return;
    }
    Module module;
    module.place = at_.place();
    module.written = std::string(at_.peek().text);
    module.name = lower_case(module.written);
    module_ = static_cast<int>(code_.modules.size());
    code_.modules.push_back(std::move(module));
    guarded([&] {
      at_.word("the module's name");
      if (at_.take_sign("("))
        while (!at_.at_end() && !at_.take_sign(")")) at_.next();
    });
    while (!at_.at_end() && !at_.take_word("endmodule")) {
      if (problems_.full()) return;
      guarded([&] { member(); });
    }
  }

  /// Runs `read`. A syntax error becomes a problem, and the parser continues after the statement.
  template <class Read>
  void guarded(const Read& read) {
    const Place before = at_.place();
    if (attempt(read)) return;
    while (!at_.at_end() && !at_.at_sign(";") && !opens_or_closes()) at_.next();
    at_.take_sign(";");
    if (const Place now = at_.place(); now.line == before.line && now.column == before.column) at_.next();
  }

  /// Whether the cursor is at a word that begins or ends a block: the parser continues there after an error.
  bool opens_or_closes() const {
    return at_any({"endproc", "endfunc", "endtrap", "endmodule", "endif", "endfor", "endwhile", "endtest", "proc",
                   "func", "else", "elseif", "case", "default"});
  }

  void member() {
    const bool local = at_.take_word("local");
    if (!local) at_.take_word("task");
    if (at_.at_word("proc") || at_.at_word("func") || at_.at_word("trap")) return routine(local);
    if (at_.take_word("record")) return record();
    if (at_.at_word("const") || at_.at_word("var") || at_.at_word("pers")) {
      code_.data.push_back({declaration(), module_, local});
      return;
    }
    if (at_.take_word("alias")) {
      while (!at_.at_end() && !at_.at_sign(";")) at_.next();
      at_.need_sign(";");
      return;
    }
    at_.fail(fmt::format("has {} where a declaration or a routine is expected", at_.seen()), "correct the module");
  }

  void record() {
    RecordType type;
    type.name = at_.word("the record's name");
    while (!at_.take_word("endrecord")) {
      const RecordType* inner = code_.record(at_.word("a type"));
      type.fields.push_back(at_.word("a component"));
      type.types.push_back(inner);
      at_.need_sign(";");
    }
    code_.records.push_back(std::move(type));
  }

  Statement declaration() {
    const bool persistent = at_.at_word("pers");
    const bool constant = at_.at_word("const");
    at_.next();  // CONST, VAR, PERS
    const std::string type = at_.word("a type");
    const Place place = at_.place();
    Statement statement = declaration_at(place, at_.word("a name"), type);
    statement.constant = constant;
    if (at_.take_sign("{")) {
      do statement.arguments.push_back(at_.expression());
      while (at_.take_sign(","));
      at_.need_sign("}");
    }
    if (at_.take_sign(":="))
      statement.arguments[0] = at_.expression();
    else
      statement.elsewhere = persistent;
    at_.need_sign(";");
    return statement;
  }

  /// Reads a routine. A routine with an error is kept, so that a call of it reports the error.
  void routine(bool local) {
    Routine& routine = code_.routines.emplace_back();
    routine.module = module_;
    routine.local = local;
    routine.place = at_.place();
    routine.last_line = routine.place.line;
    try {
      routine_lines(routine);
    } catch (const SyntaxError&) {
      if (!routine.name.empty() && !at_end_of_routine()) skip_routine();
      routine.last_line = at_.place().line;
      throw;
    }
  }

  bool at_end_of_routine() const { return at_any({"endmodule", "proc", "func", "trap"}) || at_.at_end(); }
  void skip_routine() {
    bool ended = false;
    while (!ended && !at_end_of_routine()) {
      ended = at_any({"endproc", "endfunc", "endtrap"});
      at_.next();
    }
  }

  void routine_lines(Routine& routine) {
    const bool function = at_.at_word("func");
    const std::string end = function ? "endfunc" : at_.at_word("trap") ? "endtrap" : "endproc";
    at_.next();
    if (function) at_.word("a type");
    routine.place = at_.place();
    routine.written = std::string(at_.peek().text);
    routine.name = at_.word("the routine's name");
    if (at_.take_sign("(")) parameters(routine);
    routine.body = body({end.c_str(), "error", "undo", "backward"});
    routine.handler = at_.place();
    while (!at_.at_end() && !at_.at_word(end)) {  // error handlers are not part of the normal cycle
      if (at_.at_word("endmodule") || at_.at_word("proc") || at_.at_word("func")) break;
      if (at_.peek().kind == Token::Kind::word) routine.handler_words.push_back(lower_case(at_.peek().text));
      at_.next();
    }
    routine.last_line = at_.place().line;
    at_.need_word(end);
  }

  void parameters(Routine& routine) {
    bool alternative = false;  // alternative to the previous optional parameter: \switch a|switch b
    while (!at_.take_sign(")")) {
      if (at_.take_sign(",")) continue;
      if (at_.take_sign("|")) {
        alternative = true;
        continue;
      }
      Parameter parameter;
      parameter.option = at_.take_sign("\\") || alternative;
      alternative = false;
      parameter.given_back = at_.take_word("inout") || at_.take_word("var") || at_.take_word("pers");
      if (!at_.take_word("switch")) at_.word("a type");
      parameter.name = at_.word("a parameter");
      if (at_.take_sign("{"))
        while (!at_.take_sign("}")) {
          if (at_.at_end()) at_.fail("ends in a list of parameters", "close it");
          at_.next();
        }
      routine.parameters.push_back(std::move(parameter));
    }
  }

  /// Reads statements up to one of the words `until`; the cursor stays before that word.
  std::vector<Statement> body(const std::vector<const char*>& until) {
    return block(
        until,
        [&] {
          return at_any({"endmodule", "endproc", "endfunc", "proc", "func"});
        },
        [&](std::vector<Statement>& statements) { guarded([&] { statement(statements); }); });
  }

  void statement(std::vector<Statement>& into) {
    if (at_.take_sign(";")) return;
    if (at_.at_sign("<") && at_.at_word("smt", 1) && at_.at_sign(">", 2)) return placeholder(into);
    if (at_.peek().kind == Token::Kind::word && at_.at_sign(":", 1)) {
      into.push_back(labelled(Kind::label));
      at_.next();
      return;
    }
    Statement s = statement_here();
    if (at_.at_word("const") || at_.at_word("var") || at_.at_word("pers")) {
      into.push_back(declaration());
      return;
    }
    if (at_.take_word("if"))
      if_statement(s);
    else if (at_.take_word("for"))
      for_statement(s);
    else if (at_.take_word("while"))
      while_statement(s);
    else if (at_.take_word("test"))
      test_statement(s);
    else if (at_.take_word("return"))
      return_statement(s);
    else if (at_.take_word("exit"))
      simple(s, Kind::finish);
    else if (at_.take_word("exitcycle"))
      simple(s, Kind::end_cycle);
    else if (at_.take_word("goto"))
      goto_statement(s);
    else if (at_.take_word("connect"))
      connect_statement(s);
    else if (at_.at_sign("%"))
      late_call(s);
    else
      assignment_or_call(s);
    into.push_back(std::move(s));
  }

  /// Reads <SMT>, an empty placeholder of the editor. The controller stops at it.
  void placeholder(std::vector<Statement>& into) {
    Statement s = statement_at(at_.place(), Kind::instruction, unwritten_statement);
    s.text = s.name;
    for (int k = 0; k < 3; ++k) at_.next();
    at_.take_sign(";");
    into.push_back(s);
    s.kind = Kind::finish;
    into.push_back(std::move(s));
  }

  void simple(Statement& s, Kind kind) {
    s.kind = kind;
    at_.need_sign(";");
  }

  void if_statement(Statement& s) {
    condition(s);
    if (!at_.take_word("then")) return statement(s.branches[0].body);  // the compact IF
    bool begun = true;                                                 // first branch; its THEN is taken already
    arms(s, "endif", "elseif", [&](bool otherwise) {
      if (!std::exchange(begun, false) && !otherwise) at_.need_word("then");
      return body({"endif", "else", "elseif"});
    });
  }

  void loop_body(Statement& s, const char* end) {
    at_.need_word("do");
    close_loop(s, body({end}), end);
  }

  void for_statement(Statement& s) {
    s.kind = Kind::count;
    s.name = at_.word("the loop's variable");
    at_.need_word("from");
    s.arguments.push_back(at_.expression());
    at_.need_word("to");
    s.arguments.push_back(at_.expression());
    s.arguments.push_back(at_.take_word("step") ? at_.expression() : Expression{});
    loop_body(s, "endfor");
  }

  void while_statement(Statement& s) {
    s.kind = Kind::while_loop;
    s.arguments.push_back(at_.expression());
    loop_body(s, "endwhile");
  }

  void test_statement(Statement& s) {
    s.kind = Kind::choose;
    s.arguments.push_back(at_.expression());
    cases(s, "endtest", [&] {
      at_.need_sign(":");
      return body({"endtest", "case", "default"});
    });
  }

  void return_statement(Statement& s) {
    s.kind = Kind::give_back;
    if (!at_.at_sign(";")) s.arguments.push_back(at_.expression());
    at_.need_sign(";");
  }

  void goto_statement(Statement& s) {
    s = labelled(Kind::jump);
    at_.need_sign(";");
  }

  int module_ = -1;

  /// Reads CONNECT number WITH trap; the call of the trap becomes a branch.
  void connect_statement(Statement& s) {
    s.name = "connect";
    while (!at_.at_end() && !at_.at_sign(";") && !at_.at_word("with")) at_.next();
    if (at_.take_word("with")) {
      Statement call = statement_here();
      call.name = at_.word("a trap");
      s.branches.push_back({{}, {std::move(call)}, {}});
    }
    while (!at_.at_end() && !at_.at_sign(";")) at_.next();
    at_.need_sign(";");
  }

  void late_call(Statement& s) {  // %"routine"% arguments;
    at_.next();
    Expression name = at_.expression();
    at_.need_sign("%");
    const bool constant =
        name.kind == Expression::Kind::text && name.text.find(':') == std::string::npos;  // "module:routine"
    s.name = constant ? lower_case(name.text) : late_binding;
    s.text = name.text;
    s.arguments = at_.arguments(";");
    if (s.name == late_binding) s.arguments.insert(s.arguments.begin(), std::move(name));
    at_.need_sign(";");
  }

  void assignment_or_call(Statement& s) {
    if (at_.at_sign(":=", 1) || at_.at_sign(".", 1) || at_.at_sign("{", 1)) {
      s.kind = Kind::assign;
      s.arguments.push_back(at_.reference());
      at_.need_sign(":=");
      s.arguments.push_back(at_.expression());
      at_.need_sign(";");
      return;
    }
    s.name = at_.word("a statement");
    s.arguments = at_.arguments(";");
    at_.need_sign(";");
  }
};

/// Whether a module is encoded by ABB: it has many control characters.
bool is_encoded(const std::string& text) {
  const auto is_control = [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < ' ' && byte != '\t' && byte != '\n' && byte != '\r' && byte != '\f' && byte != 0x1a;
  };
  constexpr std::ptrdiff_t one_in = 50;  // random bytes have one in ten, text has none
  return std::ranges::count_if(text, is_control) * one_in > static_cast<std::ptrdiff_t>(text.size());
}

}  // namespace

void parse_rapid(Code& code, int file, Problems& problems) {
  if (is_encoded(code.files[file].text()))
    return problems.add({code.files[file].name(), 1, 1}, "is encoded: its routines and data cannot be read",
                        "give the module as text where the program needs it");
  Problems in_words;
  const std::vector<Token> tokens = tokens_of(code.files[file], {'!', "", false, false}, in_words);
  const auto opens = [](const Token& token) { return lower_case(token.text) == "module"; };
  if (std::ranges::none_of(tokens, opens))
    return problems.add({code.files[file].name(), 1, 1}, "holds no MODULE", "give a RAPID module (.mod, .prg, .sys)");
  for (const Problem& problem : in_words.list()) problems.add(problem.where, problem.what, problem.remedy);
  RapidParser(code, file, tokens, problems).run();
}

}  // namespace dresslife::sim
