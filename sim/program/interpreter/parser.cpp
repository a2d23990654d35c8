#include "sim/program/interpreter/parser.h"

#include <algorithm>

namespace dresslife::sim {
namespace {

using Form = Expression::Kind;

constexpr int precedence_of_signs = 7;  // of the unary operators - and +

/// Returns the precedence of a binary operator; 0: the token is not an operator.
int precedence(const Token& token, Grammar grammar) {
  if (token.kind != Token::Kind::sign && token.kind != Token::Kind::word) return 0;
  if (const int level = precedence_of(token.text)) return level;
  if (grammar == Grammar::urscript && (token.text == "%" || token.text == "!="))
    return precedence_of(token.text == "%" ? "mod" : "<>");
  return 0;
}

/// Whether the part of an expression outside of its parentheses has an operator of these precedences.
bool has_operator(const Expression& e, int from, int to) {
  if (e.kind != Form::binary || e.in_parentheses) return false;
  const int level = precedence_of(e.text);
  return (level >= from && level <= to) || has_operator(e.items[0], from, to) || has_operator(e.items[1], from, to);
}

/// Returns the expression index + 1.
Expression counted_from_one(Expression index) {
  if (index.kind == Form::number) {
    index.number += 1;
    return index;
  }
  const Place place = index.place;
  return expression_at(place, Form::binary, "+", {std::move(index), number_at(place, 1)});
}

}  // namespace

int precedence_of(std::string_view name) {
  static constexpr std::pair<std::string_view, int> table[] = {
      {"or", 1}, {"xor", 1}, {"exor", 2}, {"b_or", 1}, {"b_exor", 2}, {"and", 3}, {"b_and", 3},
      {"=", 4},  {"==", 4},  {"<>", 4},   {"<", 4},    {">", 4},      {"<=", 4},  {">=", 4},
      {"+", 5},  {"-", 5},   {"*", 6},    {"/", 6},    {"div", 6},    {"mod", 6}, {":", 7}};
  for (const auto& [known, level] : table)
    if (same_word(known, name)) return level;
  return 0;
}

struct Cursor::Deeper {
  explicit Deeper(Cursor& cursor) : cursor_(cursor) {
    if (++cursor_.nesting_ > ImportLimits::nesting) {
      --cursor_.nesting_;
      cursor_.fail(fmt::format("is nested more than {} deep", ImportLimits::nesting), "write it simpler");
    }
  }
  ~Deeper() { --cursor_.nesting_; }
  Cursor& cursor_;
};

const Token& Cursor::peek(int ahead) const { return tokens_[std::min(at_ + ahead, tokens_.size() - 1)]; }

Token Cursor::next() {
  const Token token = peek();
  if (at_ + 1 < tokens_.size()) ++at_;
  return token;
}

bool Cursor::at_word(std::string_view word, int ahead) const {
  return peek(ahead).kind == Token::Kind::word && same_word(peek(ahead).text, word);
}

bool Cursor::at_sign(std::string_view sign, int ahead) const {
  return peek(ahead).kind == Token::Kind::sign && peek(ahead).text == sign;
}

bool Cursor::take_word(std::string_view word) {
  if (!at_word(word)) return false;
  next();
  return true;
}

bool Cursor::take_sign(std::string_view sign) {
  if (!at_sign(sign)) return false;
  next();
  return true;
}

std::string Cursor::word(const char* what) {
  if (peek().kind != Token::Kind::word)
    fail(fmt::format("has {} where {} is expected", seen(), what), "correct the line");
  return lower_case(next().text);
}

void Cursor::need_word(std::string_view word) {
  if (!take_word(word)) fail(fmt::format("has {} where {} is expected", seen(), word), "correct the line");
}

void Cursor::need_sign(std::string_view sign) {
  if (!take_sign(sign)) fail(fmt::format("has {} where '{}' is expected", seen(), sign), "correct the line");
}

Place Cursor::place(int ahead) const { return {file_, peek(ahead).line, peek(ahead).column}; }

void Cursor::fail(const std::string& what, const std::string& remedy) const {
  const bool between_digits =
      at_ > 0 && at_sign(",") && tokens_[at_ - 1].kind == Token::Kind::number && peek(1).kind == Token::Kind::number;
  throw SyntaxError{
      place(), what,
      between_digits ? fmt::format("write {}.{} with a decimal point", tokens_[at_ - 1].text, peek(1).text) : remedy};
}

std::string Cursor::seen() const {
  const Token& token = peek();
  switch (token.kind) {
    case Token::Kind::end:
      return "the end of the file";
    case Token::Kind::line_end:
      return "the end of the line";
    case Token::Kind::text:
      return "a text";
    default:
      return fmt::format("'{}'", token.text.substr(0, 40));
  }
}

Expression Cursor::finished(Expression e) const {
  for (const Expression& item : e.items) e.depth = std::max(e.depth, item.depth + 1);
  if (e.depth > ImportLimits::nesting)
    fail(fmt::format("is an expression of more than {} levels", ImportLimits::nesting),
         "write it in several statements");
  return e;
}

Expression Cursor::expression(int lowest) {
  const Deeper deeper(*this);
  Expression left = unary(lowest);
  while (true) {
    const int level = precedence(peek(), grammar_);
    if (level < lowest || level == 0 || (at_sign(":") && !krl_)) {
      if (krl_ && lowest == 1 && !left.in_parentheses)
        left.mixes_levels =
            has_operator(left, 1, precedence_of("and")) && has_operator(left, precedence_of("=="), precedence_of("=="));
      return left;
    }
    Expression both = expression_at(place(), Form::binary);
    both.text = lower_case(next().text);
    if (both.text == "%" || both.text == "!=") both.text = both.text == "%" ? "mod" : "<>";
    both.items.push_back(std::move(left));
    both.items.push_back(expression(level + 1));
    left = finished(std::move(both));
  }
}

/// Reads an expression that may begin with a unary operator. RAPID's NOT applies to all operands of AND: NOT a AND b is
/// NOT (a AND b), c OR NOT a AND b is c OR NOT (a AND b).
Expression Cursor::unary(int lowest) {
  const Deeper deeper(*this);
  const bool negation = at_word("not") || at_word("b_not");
  if (!negation && !at_sign("-") && !at_sign("+")) return primary();
  Expression e = expression_at(place(), Form::unary);
  e.text = lower_case(next().text);
  const int conjunction = precedence_of("and");
  const int operand = grammar_ == Grammar::rapid && lowest <= conjunction ? conjunction : precedence_of("==");
  e.items.push_back(negation && !krl_ ? expression(operand) : unary(precedence_of_signs));
  return finished(std::move(e));
}

Expression Cursor::primary() {
  const Token& token = peek();
  Expression e;
  e.place = place();
  switch (token.kind) {
    case Token::Kind::number:
      e.kind = Form::number;
      e.whole = krl_ && (token.text[0] == '\'' || token.text.find_first_of(".eE") == std::string_view::npos);
      e.number = next().number;
      return e;
    case Token::Kind::text:
      e.kind = Form::text;
      e.text = std::string(next().text.substr(0, 1000));
      return e;
    case Token::Kind::word:
      if (at_word("true") || at_word("false")) {
        e.kind = Form::truth;
        e.number = at_word("true");
        next();
        return e;
      }
      if (krl_ && token.text == "#" && peek(1).kind == Token::Kind::word) {  // "# State" is #State
        next();
        e.kind = Form::name;
        e.text = fmt::format("#{}", lower_case(next().text));
        return e;
      }
      return reference();
    default:
      break;
  }
  if (take_sign("(")) {
    e = expression();
    e.in_parentheses = true;
    need_sign(")");
    return e;
  }
  if (at_sign("[") && !krl_) return aggregate_in_order();
  if (at_sign("{") && krl_) return aggregate_with_names();
  fail(fmt::format("has {} where a value is expected", seen()), "correct the line");
}

Expression Cursor::aggregate_in_order() {
  const Deeper deeper(*this);
  Expression e = expression_at(place(), Form::aggregate);
  need_sign("[");
  if (!at_sign("]")) {
    do e.items.push_back(expression());
    while (take_sign(","));
  }
  need_sign("]");
  return finished(std::move(e));
}

Expression Cursor::aggregate_with_names() {
  const Deeper deeper(*this);
  Expression e = expression_at(place(), Form::aggregate);
  need_sign("{");
  if (peek().kind == Token::Kind::word && at_sign(":", 1)) {  // type name: {E6POS: X 1, ...}
    e.text = word("a type");
    next();
  }
  while (!at_sign("}")) {
    std::string key = word("the name of a component");
    if (take_sign("[")) need_sign("]");  // component that is a whole array: POINT2[] " "
    e.keys.push_back(std::move(key));
    e.items.push_back(expression());
    if (!take_sign(",")) break;
  }
  need_sign("}");
  return finished(std::move(e));
}

Expression Cursor::reference() {
  const Deeper deeper(*this);
  Expression e = expression_at(place(), Form::name);
  e.text = word("a name");
  const bool rapid = grammar_ == Grammar::rapid;
  const std::string_view open = rapid ? "{" : "[", close = rapid ? "}" : "]";
  if (grammar_ == Grammar::urscript && e.text == "p" && at_sign("[")) {
    e.kind = Form::call;
    e.items = aggregate_in_order().items;
    return finished(std::move(e));
  }
  while (true) {
    Expression outer;
    outer.place = place();
    if (at_sign(".") && peek(1).kind == Token::Kind::word) {
      next();
      outer.kind = Form::field;
      outer.text = word("a component");
      outer.items.push_back(std::move(e));
    } else if (at_sign(open)) {
      next();
      outer.kind = Form::element;
      outer.items.push_back(std::move(e));
      while (!at_sign(close)) {
        if (krl_ && take_sign(",")) continue;  // NAME[,]: a whole array of two dimensions
        if (at_sign("*"))
          next();  // the open dimension of a parameter
        else
          outer.items.push_back(grammar_ == Grammar::urscript ? counted_from_one(expression()) : expression());
        if (!take_sign(",")) break;
      }
      need_sign(close);
      if (outer.items.size() == 1) {  // KRL: a whole array, NAME[]
        e = Expression(std::move(outer.items[0]));
        continue;
      }
    } else if (const bool method = grammar_ == Grammar::urscript && e.kind == Form::field;  // object.method(...)
               at_sign("(") && (method || e.kind == Form::name)) {
      next();
      outer.kind = Form::call;
      outer.text = method ? fmt::format("{}.{}", e.items[0].text, e.text) : e.text;
      outer.place = e.place;
      outer.items = arguments(")");
      need_sign(")");
    } else {
      return e;
    }
    e = finished(std::move(outer));
  }
}

std::vector<Expression> Cursor::arguments(std::string_view close) {
  std::vector<Expression> list;
  bool comma = true;  // the next token may begin an argument
  while (!at_sign(close) && !at_end() && peek().kind != Token::Kind::line_end) {
    if (take_sign(",")) {
      if (comma && krl_) list.emplace_back();  // KRL leaves arguments out: F( , 3)
      comma = true;
      continue;
    }
    if (take_sign("\\")) {
      Expression value;
      value.place = place();
      const std::string option = word("the name of an argument");
      if (take_sign(":=")) {
        value = expression();
      } else if (take_sign("?")) {  // \x?y: given if the routine got its own argument y
        value = expression();
        value.if_present = true;
      }
      value.option = option;
      list.push_back(std::move(value));
      continue;
    }
    if (!comma)
      fail(fmt::format("has {} where ',' or the end of the statement is expected", seen()), "correct the line");
    if (grammar_ == Grammar::urscript && peek().kind == Token::Kind::word &&
        at_sign("=", 1)) {  // named argument: a=1.2
      const std::string option = word("the name of an argument");
      next();
      list.push_back(expression());
      list.back().option = option;
      comma = false;
      continue;
    }
    if (!krl_ && peek().kind == Token::Kind::word && at_sign(":=", 1)) {  // Tool:=gun: its position decides
      word("the name of an argument");
      next();
    }
    list.push_back(expression());
    comma = false;
    while (at_sign("|")) next();
  }
  return list;
}

// ---- statements -------------------------------------------------------------------------------------------

bool StatementParser::at_any(const std::vector<const char*>& words) const {
  return std::ranges::any_of(words, [&](const char* word) { return at_.at_word(word); });
}

void StatementParser::fail_at_end(std::string_view end) const {
  const std::string word = upper_case(end);
  at_.fail(fmt::format("has {} before {}", at_.seen(), word), fmt::format("close the block with {}", word));
}

Statement StatementParser::statement_here() const {
  Statement s = statement_at(at_.place(), Statement::Kind::instruction);
  s.text = std::string(at_.peek().text);
  return s;
}

void StatementParser::condition(Statement& s) {
  s.kind = Statement::Kind::branch;
  s.branches.push_back({{at_.expression()}, {}, s.place});
}

Statement StatementParser::labelled(Statement::Kind kind) {
  const Place place = at_.place();
  return statement_at(place, kind, at_.word("a label"));
}

void StatementParser::close_loop(Statement& s, std::vector<Statement> body, const char* end) {
  s.branches.push_back({{}, std::move(body), {}});
  at_.need_word(end);
}

void StatementParser::call(Statement& s, Expression called) const {
  if (called.kind != Form::call && called.kind != Form::name)
    at_.fail("is neither an assignment nor a call", "correct the line");
  s.name = called.text;
  s.text = called.text;
  if (called.kind == Form::call) s.arguments = std::move(called.items);
}

}  // namespace dresslife::sim
