#include "sim/program/fanuc/parser.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "sim/program/fanuc/words.h"
#include "sim/program/interpreter/tokens.h"

namespace dresslife::sim {
namespace {

bool blank(char c) { return static_cast<unsigned char>(c) <= ' '; }
bool digit(char c) { return c >= '0' && c <= '9'; }
bool wordly(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || digit(c) || c == '_' || c == '$'; }

class ListingParser {
 public:
  ListingParser(const SourceFile& source, int file, Program& program, Problems& problems)
      : source_(source), program_(program), problems_(problems) {
    listing_.file = file;
  }

  FanucListing run() {
    for (next_line(); !done_; next_line()) {
      const std::string_view line = trimmed(line_);
      if (line.starts_with("/PROG")) {
        const std::string_view name = trimmed(line.substr(5));  // "NAME", or "NAME  Macro"
        listing_.name = lower_case(name.substr(0, name.find_first_of(" \t")));
      } else if (line.starts_with("/MN")) {
        section_ = Section::statements;
      } else if (line.starts_with("/POS")) {
        section_ = Section::positions;
      } else if (line.starts_with("/END")) {
        break;
      } else if (line.starts_with("/")) {
        section_ = Section::none;
      } else if (section_ == Section::statements && !line.empty()) {
        statement();
      } else if (section_ == Section::positions && !line.empty()) {
        position();
      }
      if (listing_.statements.size() > ImportLimits::instructions ||
          listing_.positions.size() > ImportLimits::instructions) {
        complain("has too many lines", "split the program");
        break;
      }
    }
    if (listing_.name.empty())
      problems_.add({source_.name(), 1, 1}, "holds no /PROG", "give a listing (.ls), not a .tp file");
    index();
    return std::move(listing_);
  }

 private:
  enum class Section { none, statements, positions };

  void next_line() {
    const std::string_view all = source_.text();
    if (next_ >= all.size()) {
      done_ = true;
      return;
    }
    begin_ = next_;
    const std::size_t end = std::min(all.find('\n', begin_), all.size());
    line_ = all.substr(begin_, end - begin_);
    next_ = end + 1;
    ++number_;
  }

  void complain(const std::string& what, const std::string& remedy, int column = 1) {
    problems_.add({source_.name(), number_, column}, what, remedy);
  }

  /// Returns the number before the ':' of a line; empty in copies without numbers. std::nullopt: no ':', or other text.
  static std::optional<std::string_view> number_of(std::string_view line) {
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos) return {};
    const std::string_view before = trimmed(line.substr(0, colon));
    return std::ranges::all_of(before, digit) ? std::optional(before) : std::nullopt;
  }

  /// Reads a statement "  12:  L P[1] ... ;" and its continued lines up to the ';'.
  void statement() {
    const std::string_view line = trimmed(line_);
    if (line.starts_with("---")) return;  // closes the lines that a move runs at its end
    if (line == ";") return;              // an empty line whose number an editor has removed
    if (!number_of(line_)) {
      complain("is no statement (a number, ':', the statement, ';')", "list the program again");
      return;
    }
    const std::size_t colon = line_.find(':');
    FanucStatement made;
    made.line = number_;
    made.column = static_cast<int>(colon) + 2;
    const std::size_t first = begin_ + colon + 1;
    std::size_t end = begin_ + line_.size();
    std::size_t last = semicolon(line_.substr(colon + 1));
    if (last != std::string_view::npos) end = first + last;
    for (int continued = 0; last == std::string_view::npos && continues(); ++continued) {
      if (continued == 100) return complain("ends a statement of more than 100 lines", "write the ';'");
      next_line();
      last = semicolon(line_);
      end = begin_ + (last == std::string_view::npos ? line_.size() : last);
    }
    const std::string_view text = trimmed(std::string_view(source_.text()).substr(first, end - first));
    const bool comment = text.starts_with("!") || text.starts_with("--") || text.starts_with("//");
    if (text.empty() || comment) return;
    if (last == std::string_view::npos && program_.skipped.size() < ImportLimits::skipped)
      program_.skipped.push_back(
          {{source_.name(), made.line, made.column}, "no ';' at the end: the statement ends with its line"});
    made.text = fanuc_in_english(text);
    listing_.statements.push_back(std::move(made));
  }

  /// Returns whether the next line continues this statement: it has no number.
  bool continues() const {
    const std::string_view all = source_.text();
    if (next_ >= all.size()) return false;
    const std::string_view next = all.substr(next_, std::min(all.find('\n', next_), all.size()) - next_);
    const std::string_view line = trimmed(next);
    if (line.starts_with("/") || line.starts_with("---")) return false;
    const auto number = number_of(next);
    return !line.empty() && (!number || number->empty());
  }

  /// Returns the offset of the ';' that ends a statement; npos: none. A comment in brackets may contain one: R[5:count;].
  static std::size_t semicolon(std::string_view line) {
    bool quoted = false, bracket = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (line[i] == '\'') quoted = !quoted;
      if (line[i] == '[' || line[i] == ']') bracket = line[i] == '[';
      if (line[i] == ';' && !quoted && !(bracket && line.find(']', i) != std::string_view::npos)) return i;
    }
    return quoted ? line.rfind(';') : std::string_view::npos;
  }

  /// Finds the labels, the ELSE and ENDIF of each IF, and the ENDFOR of each FOR.
  void index() {
    std::vector<std::size_t> ifs, loops;
    auto& statements = listing_.statements;
    for (FanucStatement& s : statements) s.other = s.end = statements.size();
    for (std::size_t i = 0; i < statements.size(); ++i) {
      FanucCursor at(statements[i].text);
      const std::string word = at.word();
      if (word == "lbl" && at.take_sign('[')) {
        const auto number = at.number();
        if (const auto [first, added] =
                number ? listing_.labels.try_emplace(whole_number(*number), i) : std::pair(listing_.labels.end(), true);
            !added)
          listing_.doubled.insert(first->second);
      } else if (word == "if" && lower_case(statements[i].text).ends_with("then")) {
        ifs.push_back(i);
      } else if (word == "else" && at.at_end() && !ifs.empty()) {
        statements[ifs.back()].other = i;
      } else if (word == "endif" && !ifs.empty()) {
        FanucStatement& opened = statements[ifs.back()];
        opened.end = i;
        if (opened.other < i) statements[opened.other].end = i;
        opened.other = std::min(opened.other, i);
        ifs.pop_back();
      } else if (word == "for") {
        loops.push_back(i);
      } else if (word == "endfor" && !loops.empty()) {
        statements[loops.back()].end = i;
        statements[i].end = loops.back();
        loops.pop_back();
      }
    }
    for (std::size_t open : ifs) unclosed(open, "ENDIF");
    for (std::size_t open : loops) unclosed(open, "ENDFOR");
  }

  void unclosed(std::size_t open, const char* end) {
    const FanucStatement& s = listing_.statements[open];
    problems_.add({source_.name(), s.line, s.column}, fmt::format("has no {}", end), "write it");
  }

  /// Reads P[1:"name"]{ GP1: UF : 0, UT : 1, CONFIG : 'N U T, 0, 0, 0', X = 1.0 mm, ... GP2: ... };
  void position() {
    FanucCursor head(line_);
    const bool begins = head.take("P") && head.take_sign('[');
    const auto number = begins ? head.number() : std::nullopt;
    const int line = number_;
    constexpr std::size_t longest = 10'000;  // characters of one position
    const std::string_view window = std::string_view(source_.text()).substr(begin_, longest);
    const std::size_t open = window.find('{'), close = std::min(window.find('}'), window.size());
    if (!number || open == std::string_view::npos || open > close) {
      complain("is no position", "list the program again, or write P[n]{ with its number at the begin of the position");
      // Skips the rest of the position, so that it does not cause further problems.
      while (line_.find('}') == std::string_view::npos && !next_begins_position()) next_line();
      return;
    }
    FanucPosition read;
    const std::string_view body = window.substr(open + 1, close - open - 1);
    const std::size_t end = begin_ + close;
    while (!done_ && next_ <= end) next_line();  // up to the line with the closing }
    if (close == window.size()) complain("ends in a position", "close it with }");
    if (std::string problem = PositionFields(body, read).run(); !problem.empty()) {
      problems_.add({source_.name(), line, 1}, problem,
                    "write six coordinates or the joint angles, in mm and deg, with decimal points");
      return;
    }
    if (!listing_.positions.try_emplace(whole_number(*number), std::move(read)).second)
      problems_.add({source_.name(), line, 1}, fmt::format("is a second P[{}]", whole_number(*number)),
                    "keep one of them");
  }

  /// Returns whether the remaining text begins with a position or a section, or is empty.
  bool next_begins_position() const {
    const std::string_view next =
        trimmed(std::string_view(source_.text()).substr(std::min(next_, source_.text().size())));
    return next.empty() || next.starts_with("P[") || next.starts_with("/");
  }

  /// Parser of the fields between { and } of a position.
  class PositionFields {
   public:
    PositionFields(std::string_view body, FanucPosition& read) : at_(body), read_(read) {}

    /// Reads all fields. Returns the error message; empty: no error.
    std::string run() {
      while (!at_.at_end()) {
        const std::string name = at_.word();
        if (name.empty()) {
          at_.move_to(at_.offset() + 1);  // a comma, a star, or an unknown character
          continue;
        }
        if (name.starts_with("gp")) {
          group_ = name.size() > 2 && digit(name[2]) ? name[2] - '0' : 0;
          continue;
        }
        if (!at_.take_sign(':') && !at_.take_sign('=')) continue;
        const bool letters = name == "config" || name == "konfig";  // konfig: German listings
        const std::string problem = letters ? configuration() : field(name);
        if (!problem.empty()) return problem;
      }
      const bool pose = std::ranges::all_of(seen_, [](bool s) { return s; });
      const bool any = std::ranges::any_of(seen_, [](bool s) { return s; });
      if (!joints_.empty()) {
        read_.form = FanucPosition::Form::joints;
        read_.values = joints_;
      } else if (pose) {
        const bool taught = std::ranges::any_of(pose_, [](double v) { return std::isfinite(v); });
        if (taught && read_.configuration.kind == ArmConfiguration::Kind::any) return "has a pose without CONFIG";
        read_.form = FanucPosition::Form::pose;
        read_.values.assign(std::begin(pose_), std::end(pose_));
      } else if (any) {
        return "has neither joint angles nor six coordinates";
      } else {
        read_.form = others_ ? FanucPosition::Form::other_groups : FanucPosition::Form::unknown;
      }
      return "";
    }

   private:
    std::string configuration() {
      if (!at_.take_sign('\'')) return "has no CONFIG in quotes";
      const std::string_view rest = at_.rest();
      const std::size_t quote = rest.find('\'');
      if (quote == std::string_view::npos) return "has a CONFIG without its closing quote";
      at_.move_to(at_.offset() + quote + 1);
      if (group_ != 1) return "";
      const auto read = fanuc_configuration(rest.substr(0, quote));
      if (!read) return "has a CONFIG like none of 'N U T, 0, 0, 0'";
      read_.configuration = *read;
      return "";
    }

    std::string field(const std::string& name) {
      const auto number = at_.number();
      if (const std::string_view rest = at_.rest(); number && rest.size() > 1 && rest[0] == ',' && digit(rest[1]))
        return fmt::format("has a decimal comma in {}", upper_case(name));
      for (const char* unit : {"rad", "m", "cm", "inch"})  // a controller lists mm and deg
        if (FanucCursor(at_).take(unit)) return fmt::format("has {} in {}", upper_case(name), unit);
      if (name == "uf" || name == "ut") {
        if (group_ == 1) (name == "uf" ? read_.frame : read_.tool) = number ? whole_number(*number) : -1;
        return "";
      }
      const double value = number.value_or(NAN);  // ****: not taught
      constexpr std::string_view names = "xyzwpr";
      const bool remote = name.size() == 2 && name[0] == 'r';
      const std::size_t which = name.size() == 1 || remote ? names.find(name.back()) : std::string_view::npos;
      if (group_ != 1) others_ = true;
      if (which != std::string_view::npos && group_ == 1) {
        pose_[which] = value;
        seen_[which] = true;
        read_.remote |= remote;
      } else if (name.size() == 2 && name[0] == 'j' && digit(name[1]) && group_ == 1) {
        if (static_cast<std::size_t>(name[1] - '0') != joints_.size() + 1) return "has joint angles out of order";
        joints_.push_back(value);
      } else if (name.size() == 2 && (name[0] == 'e' || name[0] == 'j') && digit(name[1]) &&
                 read_.external_axes.size() < 12) {
        read_.external_axes.push_back(value);
      }
      return "";
    }

    FanucCursor at_;
    FanucPosition& read_;
    int group_ = 1;
    double pose_[6] = {};
    bool seen_[6] = {}, others_ = false;
    std::vector<double> joints_;
  };

  const SourceFile& source_;
  Program& program_;
  Problems& problems_;
  FanucListing listing_;
  Section section_ = Section::none;
  std::string_view line_;
  std::size_t begin_ = 0, next_ = 0;
  int number_ = 0;
  bool done_ = false;
};

}  // namespace

bool FanucPosition::known() const {
  const auto finite = [](double value) { return std::isfinite(value); };
  return !values.empty() && std::ranges::all_of(values, finite) && std::ranges::all_of(external_axes, finite);
}

/// "N U T, 0, 0, 0": wrist not flipped (F: flipped), arm up (D: down), arm in front (B: behind); turns of axes 1, 4, 6.
std::optional<ArmConfiguration> fanuc_configuration(std::string_view text) {
  ArmConfiguration read;
  FanucCursor at(text);
  read.kind = ArmConfiguration::Kind::fanuc;
  read.numbers = {0, 1, 1};
  for (std::string letters = at.word(); !letters.empty(); letters = at.word()) {
    for (char c : letters) {
      if (c == 'f' || c == 'n')
        read.numbers[0] = c == 'f';
      else if (c == 'u' || c == 'd')
        read.numbers[1] = c == 'u';
      else if (c == 't' || c == 'b')
        read.numbers[2] = c == 't';
      else if (c != 'l' && c != 'r')
        return {};
    }
  }
  while (at.take_sign(',')) {
    const auto turns = at.number();
    if (!turns || std::abs(*turns) > 9 || read.numbers.size() >= 6) return {};
    read.numbers.push_back(static_cast<int>(*turns));
  }
  read.numbers.resize(6, 0);
  return at.at_end() ? std::optional(read) : std::nullopt;
}

int whole_number(double number) { return static_cast<int>(std::clamp(std::trunc(number), 0.0, 1e6)); }

void FanucCursor::skip_blanks() {
  while (at_ < text_.size() && blank(text_[at_])) ++at_;
}

bool FanucCursor::at_end() {
  skip_blanks();
  return at_ >= text_.size();
}

bool FanucCursor::take(std::string_view word) {
  skip_blanks();
  if (!same_word(text_.substr(at_, word.size()), word)) return false;
  const std::size_t after = at_ + word.size();
  if (after < text_.size() && wordly(word.back()) && wordly(text_[after]) &&
      !(digit(text_[after]) && !digit(word.back())))
    return false;
  at_ = after;
  return true;
}

bool FanucCursor::take_sign(char sign) { return take_signs({&sign, 1}); }

bool FanucCursor::take_signs(std::string_view signs) {
  skip_blanks();
  if (!rest().starts_with(signs)) return false;
  at_ += signs.size();
  return true;
}

void FanucCursor::skip_to(char sign) { at_ = std::min(text_.find(sign, at_), text_.size() - 1) + 1; }

std::optional<double> FanucCursor::number() {
  skip_blanks();
  std::size_t begin = at_;
  if (begin < text_.size() && text_[begin] == '+') ++begin;
  double value = 0;
  const auto [end, failure] =
      std::from_chars(text_.data() + begin, text_.data() + text_.size(), value, std::chars_format::fixed);
  if (failure != std::errc() || !std::isfinite(value)) return {};
  at_ = end - text_.data();
  return value;
}

std::string FanucCursor::word() {
  skip_blanks();
  const std::size_t begin = at_;
  while (at_ < text_.size() && wordly(text_[at_])) ++at_;
  return lower_case(text_.substr(begin, at_ - begin));
}

std::string_view FanucCursor::name() {
  skip_blanks();
  const std::size_t begin = at_;
  while (at_ < text_.size() && (wordly(text_[at_]) || text_[at_] == '-')) ++at_;
  return text_.substr(begin, at_ - begin);
}

std::string_view FanucCursor::rest() { return text_.substr(std::min(at_, text_.size())); }

FanucListing parse_fanuc(const SourceFile& source, int file, Program& program, Problems& problems) {
  return ListingParser(source, file, program, problems).run();
}

}  // namespace dresslife::sim
