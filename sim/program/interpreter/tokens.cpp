#include "sim/program/interpreter/tokens.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace dresslife::sim {
namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// Whether two bytes of UTF-8 are a letter of ISO 8859-1, Latin Extended-A or -B (U+00C0 .. U+024F).
bool is_latin_letter(std::string_view text, std::size_t at) {
  if (at + 1 >= text.size()) return false;
  const auto first = static_cast<unsigned char>(text[at]), second = static_cast<unsigned char>(text[at + 1]);
  return first >= 0xC3 && first <= 0xC9 && (second & 0xC0) == 0x80 &&
         !(first == 0xC3 && (second == 0x97 || second == 0xB7));  // not the signs of multiplication and division
}

class Cutter {
 public:
  Cutter(const SourceFile& source, const TokenRules& rules, Problems& problems)
      : name_(source.name()), text_(source.text()), rules_(rules), problems_(problems) {}

  std::vector<Token> run() {
    while (at_ < text_.size()) {
      if (tokens_.size() >= ImportLimits::tokens) {
        complain(at_, fmt::format("has more than {} words", ImportLimits::tokens), "split the program");
        break;
      }
      step();
    }
    add(Token::Kind::end, text_.size(), text_.size());
    return std::move(tokens_);
  }

 private:
  char peek(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }

  Token& add(Token::Kind kind, std::size_t begin, std::size_t end) {
    tokens_.push_back({kind, text_.substr(begin, end - begin), 0, line_, static_cast<int>(begin - line_begin_) + 1});
    return tokens_.back();
  }

  void complain(std::size_t place, const std::string& what, const std::string& remedy) {
    problems_.add({name_, line_, static_cast<int>(place - line_begin_) + 1}, what, remedy);
  }

  void step() {
    const char c = text_[at_];
    if (c == '\n') {
      if (rules_.line_ends) add(Token::Kind::line_end, at_, at_);
      ++line_;
      line_begin_ = ++at_;
    } else if (static_cast<unsigned char>(c) <= ' ') {
      ++at_;
    } else if (c == rules_.comment) {
      at_ = std::min(text_.find('\n', at_), text_.size());
    } else if (is_letter(c) || is_latin_letter(text_, at_) || rules_.extra.find(c) != std::string_view::npos) {
      word();
    } else if (is_digit(c) || (c == '.' && is_digit(peek(1)))) {
      number();
    } else if (c == '"') {
      quoted();
    } else if (rules_.based_numbers && c == '\'') {
      based_number();
    } else {
      sign();
    }
  }

  void word() {
    const std::size_t begin = at_;
    at_ += is_latin_letter(text_, at_) ? 2 : 1;
    while (true) {
      if (is_letter(peek()) || is_digit(peek()) || (rules_.extra.find('$') != std::string_view::npos && peek() == '$'))
        ++at_;
      else if (is_latin_letter(text_, at_))
        at_ += 2;
      else
        break;
    }
    add(Token::Kind::word, begin, at_);
  }

  /// Reads a number of RAPID with a prefix: 0x1F, 0b101, 0o17. Returns false if there is none.
  bool prefixed_number() {
    const char letter = lower(peek(1));
    const int base = letter == 'x' ? 16 : letter == 'b' ? 2 : letter == 'o' ? 8 : 0;
    if (rules_.based_numbers || peek() != '0' || base == 0) return false;
    unsigned long value = 0;
    const char* first = text_.data() + at_ + 2;
    const auto [end, failure] = std::from_chars(first, text_.data() + text_.size(), value, base);
    if (failure != std::errc()) return false;
    const std::size_t begin = std::exchange(at_, static_cast<std::size_t>(end - text_.data()));
    add(Token::Kind::number, begin, at_).number = static_cast<double>(value);
    return true;
  }

  void number() {
    if (prefixed_number()) return;
    const std::size_t begin = at_;
    double value = 0;
    const auto [end, failure] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    at_ = end - text_.data();
    if (failure != std::errc() || !std::isfinite(value)) {
      complain(begin, "is a number out of range", "write a number that a robot can have");
      value = 0;
    }
    add(Token::Kind::number, begin, at_).number = value;
  }

  void quoted() {
    const std::size_t begin = ++at_;
    while (at_ < text_.size() && peek() != '\n') {
      if (peek() == '"' && peek(1) == '"') {
        at_ += 2;
      } else if (peek() == '"') {
        add(Token::Kind::text, begin, at_++);
        return;
      } else {
        ++at_;
      }
    }
    complain(begin - 1, "opens a text that does not end on its line", "close it with \"");
  }

  void based_number() {  // KRL: 'H1F', 'B0110'
    const std::size_t begin = at_;
    const std::size_t close = text_.find('\'', at_ + 1);
    const int base = lower(peek(1)) == 'h' ? 16 : 2;
    unsigned value = 0;
    const char* first = text_.data() + at_ + 2;
    if (close != std::string_view::npos && close > at_ + 2 && (lower(peek(1)) == 'h' || lower(peek(1)) == 'b')) {
      const auto [end, failure] = std::from_chars(first, text_.data() + close, value, base);
      if (failure == std::errc() && end == text_.data() + close) {
        at_ = close + 1;
        add(Token::Kind::number, begin, at_).number = value;
        return;
      }
    }
    if (close < text_.find('\n', at_)) {  // 'A' is a text
      add(Token::Kind::text, begin + 1, close);
      at_ = close + 1;
      return;
    }
    complain(begin, "opens no number of the form 'H1F' or 'B0110'", "correct or remove it");
    ++at_;
  }

  void sign() {
    static constexpr std::string_view pairs[] = {":=", "<>", "<=", ">=", "==", "!="};
    for (std::string_view pair : pairs)
      if (text_.substr(at_, 2) == pair) {
        add(Token::Kind::sign, at_, at_ + 2);
        at_ += 2;
        return;
      }
    static constexpr std::string_view singles = "+-*/=<>()[]{},;:.\\%|?!&@^";
    if (singles.find(text_[at_]) == std::string_view::npos) {
      complain(at_, "holds a character that does not belong to the language", "remove it");
      at_ = std::min(text_.find('\n', at_), text_.size());  // binary data: one problem per line
      return;
    }
    add(Token::Kind::sign, at_, at_ + 1);
    ++at_;
  }

  const std::string& name_;
  std::string_view text_;
  TokenRules rules_;
  Problems& problems_;
  std::vector<Token> tokens_;
  std::size_t at_ = 0, line_begin_ = 0;
  int line_ = 1;
};

}  // namespace

std::vector<Token> tokens_of(const SourceFile& source, const TokenRules& rules, Problems& problems) {
  return Cutter(source, rules, problems).run();
}

}  // namespace dresslife::sim
