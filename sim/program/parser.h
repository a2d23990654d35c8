// What the parsers of RAPID and KRL share: a cursor over tokens, and expressions by precedence climbing:
//   or, xor < and < comparisons < + - < * / div mod < : (KRL's product of frames)
// A syntax error is a thrown SyntaxError inside; the statement's reader makes a problem of it and goes on
// behind it.
#pragma once

#include "sim/program/code.h"
#include "sim/program/tokens.h"

namespace dresslife::sim {

struct SyntaxError {
  Place place;
  std::string what, remedy;
};

class Cursor {
 public:
  /// krl: [ ] are indices and { } aggregates with names; else { } are indices and [ ] aggregates in order.
  Cursor(const std::vector<Token>& tokens, int file, bool krl) : tokens_(tokens), file_(file), krl_(krl) {}

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
  Expression unary();
  Expression aggregate_in_order();
  Expression aggregate_with_names();
  Expression finished(Expression e) const;  // sets the depth, checks it

  const std::vector<Token>& tokens_;
  std::size_t at_ = 0;
  int file_, nesting_ = 0;
  bool krl_;
};

}  // namespace dresslife::sim
