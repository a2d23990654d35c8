// What the parsers of RAPID, KRL and URScript share: a cursor over tokens, and expressions by precedence climbing:
//   or, xor < and < comparisons < + - < * / div mod < : (KRL's product of frames)
// A syntax error is a thrown SyntaxError inside; the statement's reader makes a problem of it and goes on
// behind it.
#pragma once

#include "sim/program/interpreter/code.h"
#include "sim/program/interpreter/tokens.h"

namespace dresslife::sim {

struct SyntaxError {
  Place place;
  std::string what, remedy;
};

enum class Grammar { rapid, krl, urscript };

class Cursor {
 public:
  /// krl: [ ] are indices and { } aggregates with names. rapid: { } are indices and [ ] aggregates in order.
  /// urscript: [ ] are both; indices count from 0, and the tree's from 1; p[...] is a call of p.
  Cursor(const std::vector<Token>& tokens, int file, Grammar grammar)
      : tokens_(tokens), file_(file), grammar_(grammar), krl_(grammar == Grammar::krl) {}

  const Token& peek(int ahead = 0) const;
  Token next();
  bool at_end() const { return peek().kind == Token::Kind::end; }
  bool at_word(std::string_view word, int ahead = 0) const;
  bool at_sign(std::string_view sign, int ahead = 0) const;
  bool take_word(std::string_view word);
  bool take_sign(std::string_view sign);
  std::string word(const char* what);  ///< any word, in lower case
  void need_word(std::string_view word);
  void need_sign(std::string_view sign);
  Place place(int ahead = 0) const;
  std::size_t mark() const { return at_; }  ///< to come back to
  void back_to(std::size_t mark) { at_ = mark; }
  [[noreturn]] void fail(const std::string& what, const std::string& remedy) const;
  std::string seen() const;  ///< the token at the cursor, for messages

  Expression expression(int lowest = 1);
  /// A name with its fields, elements and arguments.
  Expression reference();
  /// Arguments up to the closing sign, which is not taken: a, b \Name:=c \Switch.
  std::vector<Expression> arguments(std::string_view close);

 private:
  struct Deeper;
  Expression primary();
  Expression unary(int lowest);
  Expression aggregate_in_order();
  Expression aggregate_with_names();
  Expression finished(Expression e) const;  // sets the depth, checks it

  const std::vector<Token>& tokens_;
  std::size_t at_ = 0;
  int file_, nesting_ = 0;
  Grammar grammar_;
  bool krl_;
};

/// What the statements of both languages are read with: blocks, nesting, and problems instead of errors.
class StatementParser {
 protected:
  StatementParser(Code& code, int file, const std::vector<Token>& tokens, Problems& problems, Grammar grammar)
      : code_(code), file_(file), at_(tokens, file, grammar), problems_(problems) {}

  bool at_any(const std::vector<const char*>& words) const;

  // Of languages in which a line's end ends a statement.
  void skip_line_ends() {
    while (at_.peek().kind == Token::Kind::line_end) at_.next();
  }
  void skip_line() {
    while (!at_.at_end() && at_.peek().kind != Token::Kind::line_end) at_.next();
  }
  bool line_done() const { return at_.at_end() || at_.peek().kind == Token::Kind::line_end; }

  /// False: there was a syntax error, which is now a problem; the cursor stands where it was found.
  template <class Read>
  bool attempt(const Read& read) {
    try {
      read();
      return true;
    } catch (const SyntaxError& error) {
      problems_.add({code_.files[file_].name(), error.place.line, error.place.column}, error.what,
                    error.remedy);
      return false;
    }
  }

  /// Statements, read by `one`, up to one of these words, which is not taken. wrong_end: whether the cursor
  /// is at the end of something else.
  template <class WrongEnd, class One>
  std::vector<Statement> block(const std::vector<const char*>& until, const WrongEnd& wrong_end,
                               const One& one) {
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

  /// The branches of TEST (RAPID) and SWITCH (KRL), up to the word `end`. body: reads the statements of one.
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

  /// An instruction that begins here, with its first word as it is written.
  Statement statement_here() const;
  /// IF: the condition of its first branch.
  void condition(Statement& s);
  /// The body of an IF's first branch, and the other branches up to the word `end`: behind `also`, with a condition, or behind
  /// ELSE. body: reads the statements of one; it is given whether that is the one behind ELSE.
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

  /// A label or a jump to one, at its name.
  Statement labelled(Statement::Kind kind);

  Code& code_;
  int file_;
  Cursor at_;
  Problems& problems_;

 private:
  [[noreturn]] void fail_at_end(std::string_view end) const;
  int depth_ = 0;
};

}  // namespace dresslife::sim
