#include <algorithm>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>

#include "sim/program/interpreter/parser.h"
#include "sim/program/urscript/urscript.h"

namespace dresslife::sim {
namespace {

using Kind = Statement::Kind;

constexpr TokenRules rules{'#', "$", true, true};

/// Inside brackets a statement goes on behind the line's end.
std::vector<Token> without_inner_line_ends(std::vector<Token> tokens) {
  int depth = 0;
  std::vector<Token> kept;
  for (const Token& token : tokens) {
    if (token.kind == Token::Kind::sign && (token.text == "(" || token.text == "[")) ++depth;
    if (token.kind == Token::Kind::sign && (token.text == ")" || token.text == "]")) depth = std::max(0, depth - 1);
    if (token.kind != Token::Kind::line_end || depth == 0) kept.push_back(token);
  }
  return kept;
}

class ScriptParser : StatementParser {
 public:
  ScriptParser(Code& code, int file, const std::vector<Token>& tokens, Problems& problems)
      : StatementParser(code, file, tokens, problems, Grammar::urscript) {}

  void run() {
    module_ = static_cast<int>(code_.modules.size());
    const std::filesystem::path path = code_.files[file_].name();
    code_.modules.push_back({lower_case(path.stem().string()), path.stem().string(), {file_, 1, 1}});
    Routine script;  // the statements outside functions
    script.written = path.stem().string();
    script.name = "script:" + lower_case(script.written);
    script.place = {file_, 1, 1};
    script.module = module_;
    while (!at_.at_end() && !problems_.full()) {
      skip_line_ends();
      if (!at_.at_end()) guarded([&] { statement(script.body); });
    }
    script.last_line = at_.place().line;
    code_.routines.push_back(std::move(script));  // before the functions, which own the lines within its range
    for (const std::size_t index : around_others_)
      if (!is_within_another(index)) {  // "variables on the first scope level are treated as global"
        globals_.insert(assigned_[index].begin(), assigned_[index].end());
        globals_.insert(locals_[index].begin(), locals_[index].end());
        locals_[index].clear();
      }
    for (std::size_t i = 0; i < routines_.size(); ++i) {
      declare_locals(i);
      code_.routines.push_back(std::move(routines_[i]));
    }
    for (const auto& [name, thread] : written_by_threads_)
      if (globals_.contains(name)) code_.written_beside.emplace(name, "the thread " + thread);
  }

 private:
  template <class Read>
  void guarded(const Read& read) {
    const std::size_t before = at_.mark();
    if (attempt(read)) return;
    skip_line();
    if (at_.mark() == before) at_.next();
  }

  std::vector<Statement> body(const std::vector<const char*>& until) {
    skip_line_ends();
    return block(
        until, [] { return false; },
        [&](std::vector<Statement>& statements) {
          guarded([&] { statement(statements); });
          skip_line_ends();
        });
  }

  void statement(std::vector<Statement>& into) {
    if (at_.at_sign("$") || at_.peek().text.starts_with("$"))
      return skip_line();  // line of PolyScope: $ 3 "Waypoint_1"
    Statement s = statement_here();
    if (at_.at_word("def") || at_.at_word("thread") || at_.at_word("sec")) return routine();
    if (at_.take_word("if")) {
      if_statement(s);
    } else if (at_.take_word("while")) {
      while_statement(s);
    } else if (at_.take_word("return")) {
      s.kind = Kind::give_back;
      if (!line_done()) s.arguments.push_back(at_.expression());
    } else if (at_.take_word("break")) {
      s.kind = Kind::leave_loop;
    } else if (at_.take_word("continue")) {  // a jump to the end of the loop's body
      if (loops_.empty()) at_.fail("has a continue outside of loops", "remove it");
      s.kind = Kind::jump;
      s.name = loops_.back();
    } else if (at_.take_word("halt")) {
      s.kind = Kind::finish;
    } else if (at_.take_word("pass")) {
      return;
    } else if (!assignment(s)) {
      call_or_thread(s);
    }
    if (!line_done() && at_.peek().kind != Token::Kind::word)  // one line may hold several statements
      at_.fail(fmt::format("has {} behind the end of the statement", at_.seen()), "correct the line");
    into.push_back(std::move(s));
  }

  /// Reads [global, local] name = value or name[i] = value. Returns false if the line is not an assignment.
  bool assignment(Statement& s) {
    const std::size_t begin = at_.mark();
    const bool global = at_.take_word("global"), local = !global && at_.take_word("local");
    Expression target = at_.reference();
    if (!at_.take_sign("=")) {
      if (global || local) at_.fail("declares a variable without a value", "write = and its value");
      at_.back_to(begin);
      return false;
    }
    const Expression* base = &target;
    while (base->kind == Expression::Kind::field || base->kind == Expression::Kind::element) base = &base->items[0];
    if (base->kind != Expression::Kind::name) at_.fail("assigns to what is no variable", "correct the line");
    if (global || routines_here_.empty())
      globals_.insert(base->text);
    else if (local)
      locals_[routines_here_.back()].insert(base->text);
    else
      assigned_[routines_here_.back()].insert(base->text);
    if (threads_ > 0) written_by_threads_.emplace(base->text, routines_[routines_here_.back()].written);
    s.kind = Kind::assign;
    s.arguments.push_back(std::move(target));
    s.arguments.push_back(at_.at_word("run") ? run_thread(s) : at_.expression());
    return true;
  }

  /// Reads run name(). Its value is the handle of the thread.
  Expression run_thread(Statement& s) {
    at_.need_word("run");
    Expression call = at_.reference();
    call.kind = Expression::Kind::call;
    call.items.clear();
    call.text = "run " + call.text;
    call.place = s.place;
    return call;
  }

  void call_or_thread(Statement& s) {
    if (at_.at_word("run")) {
      const Expression thread = run_thread(s);
      s.name = "run";
      s.text = thread.text;
      return;
    }
    for (const char* word : {"kill", "join"})
      if (at_.take_word(word)) {
        s.name = word;
        return skip_line();
      }
    call(s, at_.reference());
  }

  /// Reads def name(a, b=1): ... end or thread name(): ... end.
  void routine() {
    const bool thread = at_.at_word("thread");
    at_.next();
    const std::size_t index = routines_.size();
    routines_.emplace_back();
    Routine read;
    read.place = at_.place();
    read.written = std::string(at_.peek().text);
    read.name = at_.word("the function's name");
    read.module = module_;
    std::vector<Statement> usual;  // default values of parameters
    if (thread) read.robot = "thread";
    if (at_.take_sign("("))
      while (!at_.take_sign(")")) {
        if (at_.take_sign(",")) continue;
        if (line_done()) at_.fail("ends in a list of parameters", "close it");
        const Place place = at_.place();
        read.parameters.push_back({at_.word("a parameter"), false, false});
        if (at_.take_sign("="))
          usual.push_back(declaration_at(place, read.parameters.back().name, "", at_.expression()));
      }
    at_.take_sign(":");
    routines_[index].written = read.written;
    if (!routines_here_.empty()) around_others_.insert(routines_here_.back());
    routines_here_.push_back(index);
    threads_ += thread;
    const std::vector<std::string> loops = std::move(loops_);
    loops_.clear();
    const bool whole = attempt([&] {
      read.body = body({"end"});
      at_.need_word("end");
    });
    loops_ = loops;
    threads_ -= thread;
    routines_here_.pop_back();
    if (!whole) skip_line();
    read.last_line = at_.place().line;
    read.body.insert(read.body.begin(), usual.begin(), usual.end());
    routines_[index] = std::move(read);
  }

  void if_statement(Statement& s) {
    condition(s);
    arms(s, "end", "elif", [&](bool) {
      at_.take_sign(":");
      return body({"end", "elif", "else"});
    });
  }

  void while_statement(Statement& s) {
    s.kind = Kind::while_loop;
    s.arguments.push_back(at_.expression());
    at_.take_sign(":");
    loops_.push_back(fmt::format("continue {}", s.place.line));
    s.branches.emplace_back();
    s.branches[0].body = body({"end"});
    s.branches[0].body.push_back(statement_at(at_.place(), Kind::label, loops_.back()));
    loops_.pop_back();
    at_.need_word("end");
  }

  bool is_within_another(std::size_t index) const {  // routines_ is in the order of their first lines
    return std::any_of(routines_.begin(), routines_.begin() + static_cast<long>(index),
                       [&](const Routine& other) { return other.last_line >= routines_[index].last_line; });
  }

  /// Declares the local variables of a function: its `local` names, and names that it assigns and that are not global.
  void declare_locals(std::size_t index) {
    Routine& routine = routines_[index];
    std::set<std::string> own = locals_[index];
    for (const std::string& name : assigned_[index])
      if (!globals_.contains(name)) own.insert(name);
    for (const Parameter& parameter : routine.parameters) own.erase(parameter.name);
    for (const std::string& name : own)
      routine.body.insert(routine.body.begin(), declaration_at(routine.place, name, ""));
  }

  int module_ = -1, threads_ = 0;
  std::vector<Routine> routines_;
  std::vector<std::size_t> routines_here_;  // open routines, the innermost last
  std::set<std::size_t> around_others_;     // routines that contain other routines
  std::vector<std::string> loops_;          // end labels of the open loops
  std::set<std::string> globals_;
  std::map<std::size_t, std::set<std::string>> assigned_, locals_;
  std::map<std::string, std::string> written_by_threads_;
};

/// Makes names that differ only in case different, because URScript distinguishes case and the tree does not. All
/// spellings of a name but one get a number: "count#2". The spelling in small letters keeps its name, because the words
/// of the language are small. `names` stores the new names. Precondition: it lives as long as the tokens.
void number_spellings(const Code& code, std::vector<Token>& tokens, std::deque<std::string>& names) {
  static const pipeline::WordSet words = pipeline::word_set(
      "true false none def end if elif else while return global local thread break continue and or not xor run");
  std::map<std::string, std::set<std::string, std::greater<>>> spellings;  // descending ASCII: small letters first
  Problems ignored;                                                        // the parser reports them
  for (const SourceFile& source : code.files)
    for (const Token& token : tokens_of(source, rules, ignored))
      if (token.kind == Token::Kind::word) spellings[lower_case(token.text)].emplace(token.text);
  for (Token& token : tokens) {
    if (token.kind != Token::Kind::word) continue;
    const std::string name = lower_case(token.text);
    const auto& all = spellings[name];
    const auto place = std::distance(all.begin(), all.find(std::string(token.text)));
    if (place == 0 || words.contains(name)) continue;
    names.push_back(fmt::format("{}#{}", name, place + 1));
    token.text = names.back();
  }
}

}  // namespace

void add_urscript_types(Code& code) {
  const auto record = [&](const char* name, std::vector<std::string> fields, bool indexed) {
    const std::size_t count = fields.size();
    code.records.push_back(
        {.name = name, .fields = std::move(fields), .types = std::vector<const RecordType*>(count, nullptr)});
    code.records.back().indexed = indexed;
  };
  record("pose", {"x", "y", "z", "rx", "ry", "rz"}, true);
  record("inverse", {"pose", "near"}, false);
  record("forward", {"joints"}, false);
}

void parse_urscript(Code& code, int file, Problems& problems) {
  std::vector<Token> tokens = without_inner_line_ends(tokens_of(code.files[file], rules, problems));
  std::deque<std::string> names;
  number_spellings(code, tokens, names);
  ScriptParser(code, file, tokens, problems).run();
}

}  // namespace dresslife::sim
