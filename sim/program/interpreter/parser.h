// Common parts of the parsers of RAPID, KRL and URScript: a cursor over tokens, and expressions by precedence climbing:
//   or, xor < exor < and < comparisons < + - < * / div mod < : (KRL's product of frames)
// A syntax error throws SyntaxError; the parser of the statement adds a problem and continues after the statement.
#pragma once

#include "sim/program/interpreter/code.h"
#include "sim/program/interpreter/tokens.h"

namespace dresslife::sim {

struct SyntaxError {
  Place place;
  std::string what, remedy;
};

/// Returns the precedence of a binary operator, 1 for the lowest; 0: it is none.
int precedence_of(std::string_view name);

enum class Grammar { rapid, krl, urscript };

class Cursor {
 public:
  /// krl: [ ] are indices and { } aggregates with names. rapid: { } are indices and [ ] aggregates in order.
  /// urscript: [ ] are both; its indices count from 0, the indices of the tree from 1; p[...] is a call of p.
  Cursor(const std::vector<Token>& tokens, int file, Grammar grammar)
      : tokens_(tokens), file_(file), grammar_(grammar), krl_(grammar == Grammar::krl) {}

  const Token& peek(int ahead = 0) const;
  Token next();
  bool at_end() const { return peek().kind == Token::Kind::end; }
  bool at_word(std::string_view word, int ahead = 0) const;
  bool at_sign(std::string_view sign, int ahead = 0) const;
  bool take_word(std::string_view word);
  bool take_sign(std::string_view sign);
  std::string word(const char* what);  ///< takes any word; returns it in lower case
  void need_word(std::string_view word);
  void need_sign(std::string_view sign);
  Place place(int ahead = 0) const;
  std::size_t mark() const { return at_; }  ///< position for back_to()
  void back_to(std::size_t mark) { at_ = mark; }
  [[noreturn]] void fail(const std::string& what, const std::string& remedy) const;
  std::string seen() const;  ///< text of the token at the cursor, for messages

  Expression expression(int lowest = 1);
  /// Reads a name with its fields, elements and arguments.
  Expression reference();
  /// Reads arguments (a, b \Name:=c \Switch) up to the closing sign; the cursor stays before the sign.
  std::vector<Expression> arguments(std::string_view close);

 private:
  struct Deeper;
  Expression primary();
  Expression unary(int lowest);
  Expression aggregate_in_order();
  Expression aggregate_with_names();
  Expression finished(Expression e) const;  // sets and checks the depth

  const std::vector<Token>& tokens_;
  std::size_t at_ = 0;
  int file_, nesting_ = 0;
  Grammar grammar_;
  bool krl_;
};

/// Base class of the parsers of statements: blocks, nesting, and problems instead of exceptions.
class StatementParser {
 protected:
  StatementParser(Code& code, int file, const std::vector<Token>& tokens, Problems& problems, Grammar grammar)
      : code_(code), file_(file), at_(tokens, file, grammar), problems_(problems) {}

  bool at_any(const std::vector<const char*>& words) const;

  // For languages in which the end of a line ends a statement.
  void skip_line_ends() {
    while (at_.peek().kind == Token::Kind::line_end) at_.next();
  }
  void skip_line() {
    while (!at_.at_end() && at_.peek().kind != Token::Kind::line_end) at_.next();
  }
  bool line_done() const { return at_.at_end() || at_.peek().kind == Token::Kind::line_end; }

  /// Calls `read`. Returns false after a syntax error, which becomes a problem; the cursor stays at the error.
  template <class Read>
  bool attempt(const Read& read) {
    try {
      read();
      return true;
    } catch (const SyntaxError& error) {
      problems_.add({code_.files[file_].name(), error.place.line, error.place.column}, error.what, error.remedy);
      return false;
    }
  }

  /// Reads statements with `one` up to one of the words `until`; the cursor stays before that word. wrong_end: returns
  /// whether the cursor is at the end of another kind of block.
  template <class WrongEnd, class One>
  std::vector<Statement> block(const std::vector<const char*>& until, const WrongEnd& wrong_end, const One& one) {
    struct Level {
      int& depth;
      ~Level() { --depth; }
    } level{++depth_};
    if (depth_ > ImportLimits::nesting)
      at_.fail(fmt::format("is nested more than {} deep", ImportLimits::nesting), "use routines");
    std::vector<Statement> statements;
    while (!at_any(until) && !problems_.full()) {
      if (at_.at_end() || wrong_end()) fail_at_end(until[0]);
      one(statements);
    }
    return statements;
  }

  /// Reads the branches of TEST (RAPID) or SWITCH (KRL) up to the word `end`. body: reads the statements of one branch.
  template <class Body>
  void cases(Statement& s, const char* end, const Body& body) {
    while (!at_.take_word(end)) {
      Branch branch;
      branch.place = at_.place();
      if (at_.take_word("case")) {
        do branch.conditions.push_back(at_.expression());
        while (at_.take_sign(","));
      } else {
        at_.need_word("default");
      }
      branch.body = body();
      s.branches.push_back(std::move(branch));
    }
  }

  /// Returns an empty instruction at the cursor; its `text` is the word at the cursor as written.
  Statement statement_here() const;
  /// Reads the condition of an IF's first branch.
  void condition(Statement& s);
  /// Reads the first branch's body and the other branches of an IF up to the word `end`. The word `also` begins a branch with a
  /// condition, ELSE a branch without one. body: reads the statements of one branch; its argument: the branch follows ELSE.
  template <class Body>
  void arms(Statement& s, const char* end, const char* also, const Body& body) {
    s.branches[0].body = body(false);
    while (!at_.take_word(end)) {
      Branch next{{}, {}, at_.place()};
      const bool otherwise = !*also || at_.at_word("else");
      at_.need_word(otherwise ? "else" : also);
      if (!otherwise) next.conditions.push_back(at_.expression());
      next.body = body(otherwise);
      s.branches.push_back(std::move(next));
    }
  }

  /// Reads a label, or a jump to a label. Precondition: the cursor is at the label's name.
  Statement labelled(Statement::Kind kind);
  /// Gives a loop its body, and reads the word `end` behind it.
  void close_loop(Statement& s, std::vector<Statement> body, const char* end);
  /// Makes the call of a routine. called: its name, or its name with arguments. Errors: SyntaxError for any other
  /// expression.
  void call(Statement& s, Expression called) const;

  Code& code_;
  int file_;
  Cursor at_;
  Problems& problems_;

 private:
  [[noreturn]] void fail_at_end(std::string_view end) const;
  int depth_ = 0;
};

}  // namespace dresslife::sim
