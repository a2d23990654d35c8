#include "sim/program/fanuc_parser.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "sim/program/tokens.h"

namespace dresslife::sim {
namespace {

bool blank(char c) { return static_cast<unsigned char>(c) <= ' '; }
bool digit(char c) { return c >= '0' && c <= '9'; }
bool wordly(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || digit(c) || c == '_' || c == '$';
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

class ListingParser {
 public:
  ListingParser(const SourceFile& source, int file, Problems& problems)
      : source_(source), problems_(problems) {
    listing_.file = file;
  }

  FanucListing run() {
    for (next_line(); !done_; next_line()) {
      const std::string_view line = trimmed(line_);
      if (line.starts_with("/PROG")) {
        FanucCursor name(line.substr(5));
        listing_.name = name.word();
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

  /// "  12:  L P[1] ... ;" over as many lines as it takes to the ';'. A continued line begins with blanks and
  /// ':'.
  void statement() {
    const std::size_t colon = line_.find(':');
    const std::string_view before = trimmed(line_.substr(0, std::min(colon, line_.size())));
    if (colon == std::string_view::npos || !std::all_of(before.begin(), before.end(), digit)) {
      complain("is no statement (a number, ':', the statement, ';')", "list the program again");
      return;
    }
    FanucStatement made;
    made.line = number_;
    const std::size_t first = begin_ + colon + 1;
    made.column = static_cast<int>(colon) + 2;
    std::size_t last = semicolon(line_);
    int continued = 0;
    while (last == std::string_view::npos && continued < 100) {
      const std::size_t resume = next_;
      const int number = number_;
      const std::size_t begun = begin_;
      next_line();
      const std::string_view more = trimmed(line_);
      if (done_ || more.starts_with("/")) {  // the ';' is missing: the section ends
        problems_.add({source_.name(), made.line, made.column}, "has no ';' at the end of the statement",
                      "write it");
        next_ = done_ ? source_.text().size() : resume;
        number_ = number;
        begin_ = begun;
        done_ = false;
        return;
      }
      ++continued;
      last = semicolon(line_);
    }
    if (last == std::string_view::npos) {
      complain("ends a statement of more than 100 lines", "write the ';'");
      return;
    }
    made.text = trimmed(std::string_view(source_.text()).substr(first, begin_ + last - first));
    if (!made.text.empty()) listing_.statements.push_back(made);
  }

  static std::size_t semicolon(std::string_view line) {
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (line[i] == '\'') quoted = !quoted;
      if (line[i] == ';' && !quoted) return i;
    }
    return quoted ? line.rfind(';') : std::string_view::npos;
  }

  /// P[1:"name"]{ GP1: UF : 0, UT : 1, CONFIG : 'N U T, 0, 0, 0', X = 1.0 mm, ... GP2: ... };
  void position() {
    FanucCursor head(line_);
    if (!head.take("P") || !head.take_sign('[')) {
      complain("is no position P[n]{...}", "list the program again");
      return;
    }
    const auto number = head.number();
    const int line = number_;
    constexpr std::size_t longest = 10'000;  // characters of one position
    const std::string_view window = std::string_view(source_.text()).substr(begin_, longest);
    const std::size_t open = window.find('{'), close = std::min(window.find('}'), window.size());
    if (!number || open == std::string_view::npos || open > close) {
      complain("is no position P[n]{...}", "list the program again");
      return;
    }
    FanucPosition read;
    read.line = line;
    const std::string_view body = window.substr(open + 1, close - open - 1);
    const std::size_t end = begin_ + close;
    while (!done_ && next_ <= end) next_line();  // to the line that closes it
    if (close == window.size()) complain("ends in a position", "close it with }");
    if (std::string problem = fields(body, read); !problem.empty()) {
      problems_.add({source_.name(), line, 1}, problem,
                    "write six coordinates or the joint angles, in mm and deg");
      return;
    }
    listing_.positions[static_cast<int>(std::clamp(*number, 0.0, 1e6))] = std::move(read);
  }

  /// Empty, or what is wrong.
  static std::string fields(std::string_view body, FanucPosition& read) {
    FanucCursor at(body);
    constexpr std::string_view names = "xyzwpr";
    bool seen[6] = {};
    int group = 1;
    while (!at.at_end()) {
      const std::string name = at.word();
      if (name.empty()) {
        at.move_to(at.offset() + 1);  // a comma, or what this reader does not know
        continue;
      }
      if (name.starts_with("gp")) {
        group = name.size() > 2 && digit(name[2]) ? name[2] - '0' : 0;
        continue;
      }
      if (!at.take_sign(':') && !at.take_sign('=')) continue;
      if (name == "config") {
        if (!at.take_sign('\'')) return "has no CONFIG in quotes";
        const std::string_view rest = at.rest();
        const std::size_t quote = rest.find('\'');
        if (quote == std::string_view::npos) return "has a CONFIG without its closing quote";
        if (group == 1 && !configuration(rest.substr(0, quote), read.configuration))
          return "has a CONFIG like none of 'N U T, 0, 0, 0'";
        at.move_to(at.offset() + quote + 1);
        continue;
      }
      const auto number = at.number();
      if (name == "uf" || name == "ut") {
        if (group == 1)
          (name == "uf" ? read.frame : read.tool) =
              number ? static_cast<int>(std::clamp(*number, 0.0, 1e6)) : -1;
        continue;
      }
      if (!number) {
        if (name.size() <= 2) return "has " + name + " without a number";  // ****: not taught
        continue;
      }
      const std::size_t which = name.size() == 1 ? names.find(name[0]) : std::string_view::npos;
      if (which != std::string_view::npos && group == 1) {
        read.pose[which] = *number;
        seen[which] = true;
      } else if (name.size() == 2 && name[0] == 'j' && digit(name[1]) && group == 1) {
        const std::size_t axis = static_cast<std::size_t>(name[1] - '0');
        if (axis != read.joints.size() + 1) return "has joint angles out of order";
        read.joints.push_back(*number);
      } else if (name.size() == 2 && (name[0] == 'e' || name[0] == 'j') && read.external_axes.size() < 12) {
        read.external_axes.push_back(*number);
      }
    }
    const bool pose = std::all_of(std::begin(seen), std::end(seen), [](bool s) { return s; });
    return pose || !read.joints.empty() ? "" : "has neither joint angles nor six coordinates";
  }

  /// N U T, 0, 0, 0: wrist not flipped (F), arm up (D), arm in front (B); turns of axes 1, 4, 6 (or 4, 5, 6).
  static bool configuration(std::string_view text, ArmConfiguration& read) {
    FanucCursor at(text);
    read.kind = ArmConfiguration::Kind::fanuc;
    read.numbers = {0, 1, 1};
    for (std::string letter = at.word(); !letter.empty(); letter = at.word()) {
      for (char c : letter) {
        if (c == 'f' || c == 'n')
          read.numbers[0] = c == 'f';
        else if (c == 'u' || c == 'd')
          read.numbers[1] = c == 'u';
        else if (c == 't' || c == 'b')
          read.numbers[2] = c == 't';
        else if (c != 'l' && c != 'r')
          return false;
      }
    }
    while (at.take_sign(',')) {
      const auto turns = at.number();
      if (!turns || std::abs(*turns) > 9 || read.numbers.size() >= 6) return false;
      read.numbers.push_back(static_cast<int>(*turns));
    }
    read.numbers.resize(6, 0);
    return at.at_end();
  }

  const SourceFile& source_;
  Problems& problems_;
  FanucListing listing_;
  Section section_ = Section::none;
  std::string_view line_;
  std::size_t begin_ = 0, next_ = 0;
  int number_ = 0;
  bool done_ = false;
};

}  // namespace

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

bool FanucCursor::take_sign(char sign) {
  skip_blanks();
  if (at_ >= text_.size() || text_[at_] != sign) return false;
  ++at_;
  return true;
}

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

std::string_view FanucCursor::rest() { return text_.substr(std::min(at_, text_.size())); }

FanucListing parse_fanuc(const SourceFile& source, int file, Problems& problems) {
  return ListingParser(source, file, problems).run();
}

}  // namespace dresslife::sim
