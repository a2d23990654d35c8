#include <algorithm>
#include <filesystem>

#include "sim/program/krl.h"
#include "sim/program/parser.h"

namespace dresslife::sim {
namespace {

using Kind = Statement::Kind;

constexpr const char* moves[] = {"ptp",  "lin",   "circ", "ptp_rel",  "lin_rel",  "circ_rel", "sptp",
                                 "slin", "scirc", "spl",  "sptp_rel", "slin_rel", "spl_rel",  "scirc_rel"};
constexpr const char* ends[] = {"end",      "endfct",    "enddat",    "endif", "endfor",
                                "endwhile", "endloop",   "else",      "case",  "default",
                                "until",    "endswitch", "endspline", "def",   "deffct"};

class KrlParser : StatementParser {
 public:
  KrlParser(Code& code, int file, const std::vector<Token>& tokens, Problems& problems)
      : StatementParser(code, file, tokens, problems, true) {}

  void run() {
    module_ = static_cast<int>(code_.modules.size());
    const std::string stem = std::filesystem::path(code_.files[file_].name()).stem().string();
    code_.modules.push_back({lower_case(stem), stem, at_.place()});
    skip_line_ends();
    while (!at_.at_end() && !problems_.full()) {
      guarded([&] { member(); });
      skip_line_ends();
    }
  }

 private:
  int module_ = -1;

  void skip_line_ends() {
    while (at_.peek().kind == Token::Kind::line_end) at_.next();
  }
  void skip_line() {
    while (!at_.at_end() && at_.peek().kind != Token::Kind::line_end) at_.next();
  }
  bool line_done() const { return at_.at_end() || at_.peek().kind == Token::Kind::line_end; }
  void need_line_end() {
    if (!line_done())
      at_.fail(fmt::format("has {} behind the end of the statement", at_.seen()), "mend the line");
    skip_line_ends();
  }

  template <class Read>
  void guarded(const Read& read) {
    const Place before = at_.place();
    if (attempt(read)) return;
    const Place now = at_.place();
    if (now.line == before.line || now.column > 1) skip_line();
    skip_line_ends();
    const Place after = at_.place();
    if (after.line == before.line && after.column == before.column) at_.next();
  }

  void member() {
    if (at_.at_sign("&")) return skip_line();  // &ACCESS, &REL: of the file system
    if (at_.at_word("global") && (at_.at_word("def", 1) || at_.at_word("deffct", 1))) at_.next();
    if (at_.at_word("def") || at_.at_word("deffct")) return routine();
    if (at_.at_word("defdat") || at_.at_word("enddat")) return skip_line();
    std::vector<Statement> statements;
    statement(statements);
    for (Statement& s : statements)
      if (s.kind == Kind::declare || s.kind == Kind::assign)
        code_.data.push_back({std::move(s), module_, false});
  }

  void routine() {
    Routine routine;
    const bool function = at_.at_word("deffct");
    at_.next();
    if (function) at_.word("a type");
    if (at_.at_sign("[")) skip_index();
    routine.place = at_.place();
    routine.written = std::string(at_.peek().text);
    routine.name = at_.word("the routine's name");
    if (at_.take_sign("("))
      while (!at_.take_sign(")")) {
        if (at_.take_sign(",") || at_.take_sign(":")) continue;
        if (line_done()) at_.fail("ends in a list of parameters", "close it");
        const std::string name = at_.word("a parameter");
        if (at_.at_sign("[")) skip_index();
        if ((name == "in" || name == "out") && !routine.parameters.empty())
          routine.parameters.back().given_back = name == "out";
        else
          routine.parameters.push_back({name, false, false});
      }
    need_line_end();
    const char* end = function ? "endfct" : "end";
    routine.body = body({end});
    at_.need_word(end);
    routine.module = module_;
    routine.last_line = at_.place().line;
    code_.routines.push_back(std::move(routine));
  }

  void skip_index() {
    while (!at_.take_sign("]")) {
      if (line_done()) at_.fail("ends in an index", "close it with ]");
      at_.next();
    }
  }

  std::vector<Statement> body(const std::vector<const char*>& until) {
    skip_line_ends();
    return block(
        until,
        [&] {
          return at_any({std::begin(ends), std::end(ends)});
        },
        [&](std::vector<Statement>& statements) {
          guarded([&] { statement(statements); });
          skip_line_ends();
        });
  }

  void statement(std::vector<Statement>& into) {
    Statement s;
    s.place = at_.place();
    s.text = std::string(at_.peek().text);
    if (at_.take_word("global") || at_.take_word("decl") || at_.take_word("const")) {
      while (at_.take_word("global") || at_.take_word("decl") || at_.take_word("const")) {
      }
      if (at_.at_word("interrupt") || at_.at_word("struc") || at_.at_word("enum")) return skip_line();
      return declaration(into);
    }
    for (const char* word :
         {"signal", "enum", "struc", "ext", "extfct", "extp", "extfctp", "import", "interrupt", "trigger",
          "channel", "anin", "anout", "pulse", "brake", "resume", "cwrite", "cread"})
      if (at_.at_word(word)) return left_out(s, into);
    if (at_.peek().kind != Token::Kind::word)
      at_.fail(fmt::format("has {} where a statement is expected", at_.seen()), "mend the line");
    if (at_.take_word("if"))
      if_statement(s);
    else if (at_.take_word("for"))
      for_statement(s);
    else if (at_.take_word("while"))
      loop(s, Kind::while_loop, "endwhile", true);
    else if (at_.take_word("loop"))
      loop(s, Kind::endless, "endloop", false);
    else if (at_.take_word("repeat"))
      repeat_statement(s);
    else if (at_.take_word("switch"))
      switch_statement(s);
    else if (at_.take_word("spline") || at_.take_word("ptp_spline"))
      return spline(into);
    else if (at_.take_word("return"))
      return_statement(s);
    else if (at_.take_word("exit"))
      s.kind = Kind::leave_loop;
    else if (at_.take_word("continue"))
      return;
    else if (at_.at_word("wait"))
      wait_statement(s);
    else if (at_.at_word("halt"))
      return left_out(s, into);
    else if (at_.take_word("goto"))
      s = labelled(Kind::jump);
    else if (is_move())
      move(s);
    else if (at_.peek(1).kind == Token::Kind::word && !line_done())
      return declaration_or_unknown(s, into);
    else if (at_.at_sign(":", 1)) {
      s = labelled(Kind::label);
      at_.next();
    } else
      assignment_or_call(s);
    need_line_end();
    into.push_back(std::move(s));
  }

  bool is_move() const {
    return std::any_of(std::begin(moves), std::end(moves),
                       [&](const char* word) { return at_.at_word(word); });
  }

  void left_out(Statement& s, std::vector<Statement>& into) {
    s.name = lower_case(at_.peek().text);
    skip_line();
    into.push_back(std::move(s));
  }

  /// INT A, B[3] = 2 without DECL; anything else with two words is no statement that is read.
  void declaration_or_unknown(Statement& s, std::vector<Statement>& into) {
    const std::size_t begin = at_.mark(), known = into.size();
    try {
      return declaration(into);
    } catch (const SyntaxError&) {
      at_.back_to(begin);
      into.resize(known);
    }
    left_out(s, into);
  }

  void declaration(std::vector<Statement>& into) {
    const std::string type = at_.word("a type");
    do {
      Statement s;
      s.kind = Kind::declare;
      s.text = type;
      s.place = at_.place();
      s.name = at_.word("a name");
      s.arguments.emplace_back();
      if (at_.take_sign("[")) {
        while (!at_.take_sign("]")) {
          if (at_.take_sign(",")) continue;
          s.arguments.push_back(at_.expression());
        }
      }
      if (at_.take_sign("=")) s.arguments[0] = at_.expression(4);
      into.push_back(std::move(s));
    } while (at_.take_sign(","));
    need_line_end();
  }

  void if_statement(Statement& s) {
    s.kind = Kind::branch;
    Branch branch;
    branch.place = s.place;
    branch.conditions.push_back(at_.expression());
    at_.need_word("then");
    branch.body = body({"endif", "else"});
    s.branches.push_back(std::move(branch));
    if (at_.at_word("else")) {
      Branch otherwise;
      otherwise.place = at_.place();
      at_.next();
      otherwise.body = body({"endif"});
      s.branches.push_back(std::move(otherwise));
    }
    at_.need_word("endif");
  }

  void for_statement(Statement& s) {
    s.kind = Kind::count;
    s.keeps_counter = true;
    s.name = at_.word("the loop's variable");
    at_.need_sign("=");
    s.arguments.push_back(at_.expression(4));
    at_.need_word("to");
    s.arguments.push_back(at_.expression(4));
    Expression step;  // KRL counts up unless told otherwise
    step.kind = Expression::Kind::number;
    step.number = 1;
    s.arguments.push_back(at_.take_word("step") ? at_.expression(4) : step);
    s.branches.emplace_back();
    s.branches[0].body = body({"endfor"});
    at_.need_word("endfor");
  }

  void loop(Statement& s, Kind kind, const char* end, bool condition) {
    s.kind = kind;
    if (condition) s.arguments.push_back(at_.expression());
    s.branches.emplace_back();
    s.branches[0].body = body({end});
    at_.need_word(end);
  }

  void repeat_statement(Statement& s) {
    s.kind = Kind::until_loop;
    s.branches.emplace_back();
    s.branches[0].body = body({"until"});
    at_.need_word("until");
    s.arguments.push_back(at_.expression());
  }

  void switch_statement(Statement& s) {
    s.kind = Kind::choose;
    s.arguments.push_back(at_.expression());
    skip_line_ends();
    while (!at_.take_word("endswitch")) {
      Branch branch;
      branch.place = at_.place();
      if (at_.take_word("case")) {
        do branch.conditions.push_back(at_.expression());
        while (at_.take_sign(","));
      } else {
        at_.need_word("default");
      }
      branch.body = body({"endswitch", "case", "default"});
      s.branches.push_back(std::move(branch));
    }
  }

  /// The moves of the block with the mark "in_spline"; what WITH sets for the block comes before.
  void spline(std::vector<Statement>& into) {
    if (at_.take_word("with")) with(into);
    skip_line_ends();
    std::vector<Statement> inside = body({"endspline"});
    at_.need_word("endspline");
    std::string end_zone;
    if (at_.peek().kind == Token::Kind::word) end_zone = at_.word("an approximation");
    skip_line();
    Statement* last = nullptr;
    for (Statement& s : inside) {
      if (s.kind != Kind::instruction) continue;
      s.text += " in_spline";
      last = &s;
    }
    if (last && end_zone.empty()) last->text += " last";
    for (Statement& s : inside) into.push_back(std::move(s));
  }

  /// WITH $VEL.CP = 0.5, $APO.CDIS = 10: assignments before the move.
  void with(std::vector<Statement>& into) {
    do {
      Statement s;
      s.kind = Kind::assign;
      s.place = at_.place();
      s.arguments.push_back(at_.reference());
      at_.need_sign("=");
      s.arguments.push_back(at_.expression());
      into.push_back(std::move(s));
    } while (at_.take_sign(","));
  }

  void return_statement(Statement& s) {
    s.kind = Kind::give_back;
    if (!line_done()) s.arguments.push_back(at_.expression());
  }

  void wait_statement(Statement& s) {
    at_.next();
    s.name = "wait";
    if (at_.take_word("sec")) {
      s.name = "wait_sec";
      s.arguments.push_back(at_.expression());
    } else {
      skip_line();
    }
  }

  /// PTP target [C_PTP [C_DIS]], CIRC via, target [, CA angle] [C_DIS], SLIN target [WITH ...] [C_DIS]
  void move(Statement& s) {
    s.name = at_.word("a move");
    s.text = s.name;
    s.arguments.push_back(at_.expression());
    while (!line_done()) {
      if (at_.take_sign(",")) {
        if (at_.take_word("ca")) {
          Expression angle = at_.expression();
          angle.option = "ca";
          s.arguments.push_back(std::move(angle));
        } else {
          s.arguments.push_back(at_.expression());
        }
      } else if (at_.take_word("with")) {
        Branch settings;  // for this move alone
        with(settings.body);
        s.branches.push_back(std::move(settings));
      } else {
        const std::string word = at_.word("an approximation (C_PTP, C_DIS, ...)");
        s.text += " " + word;
      }
    }
  }

  void assignment_or_call(Statement& s) {
    Expression target = at_.reference();
    if (at_.take_sign("=")) {
      s.kind = Kind::assign;
      s.arguments.push_back(std::move(target));
      s.arguments.push_back(at_.expression());
      return;
    }
    if (target.kind != Expression::Kind::call && target.kind != Expression::Kind::name)
      at_.fail("is neither an assignment nor a call", "mend the line");
    s.name = target.text;
    s.text = target.text;
    if (target.kind == Expression::Kind::call) s.arguments = std::move(target.items);
  }
};

}  // namespace

void parse_krl(Code& code, int file, Problems& problems) {
  const std::vector<Token> tokens = tokens_of(code.files[file], {';', "$#", true, true}, problems);
  KrlParser(code, file, tokens, problems).run();
}

}  // namespace dresslife::sim
