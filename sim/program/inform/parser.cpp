#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>

#include "pipeline/base/text.h"
#include "sim/program/inform/inform.h"
#include "sim/program/interpreter/parser.h"

namespace dresslife::sim {
namespace {

using Kind = Statement::Kind;

bool letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' || c == '$'; }
bool digit(char c) { return c >= '0' && c <= '9'; }

/// Without what stands behind an instruction as a comment: SET P001 PX124 'start. A line that begins so is one as a whole.
std::string_view without_comment(std::string_view line) {
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    quoted ^= line[i] == '"';
    if (i > 0 && !quoted && line[i] == '\'' && (line[i - 1] == ' ' || line[i - 1] == '\t')) return line.substr(0, i);
  }
  return line;
}

/// One line: a cursor over its words, and the expressions in it.
class Words {
 public:
  Words(std::string_view text, int file, int line) : text_(text), file_(file), line_(line) {}

  bool at_end() {
    skip_blanks();
    return at_ >= text_.size();
  }
  Place place() {
    skip_blanks();
    return {file_, line_, static_cast<int>(at_) + 1};
  }
  std::string_view rest() {
    skip_blanks();
    return text_.substr(at_);
  }
  [[noreturn]] void fail(const std::string& what) { throw SyntaxError{place(), what, "correct the line"}; }

  /// Returns the next word without taking it: "MOVJ", "IN#", and "R1_HAND-OFF" if dashes are allowed.
  std::string_view peek_word(bool dashes = false) {
    skip_blanks();
    std::size_t end = at_;
    while (end < text_.size() && (letter(text_[end]) || digit(text_[end]) || text_[end] == '#' ||
                                  static_cast<unsigned char>(text_[end]) >= 0x80 || (dashes && text_[end] == '-')))
      ++end;
    return text_.substr(at_, end - at_);
  }
  std::string word(bool dashes = false) {
    const std::string_view found = peek_word(dashes);
    at_ += found.size();
    return lower_case(found);
  }
  bool take(std::string_view word) {
    if (!same_word(peek_word(), word)) return false;
    at_ += word.size();
    return true;
  }
  bool take_sign(std::string_view sign) {
    if (!rest().starts_with(sign)) return false;
    at_ += sign.size();
    return true;
  }
  /// Takes the text up to the next blank.
  std::string item() {
    const std::string_view left = rest();
    const std::size_t end = std::min(left.find_first_of(" \t"), left.size());
    at_ += end;
    return std::string(left.substr(0, end));
  }

  /// Reads a constant or a variable; after EXPRESS, a calculation.
  Expression operand() { return take("EXPRESS") ? level(precedence_of_sums, 0) : signed_value(0); }
  Expression condition() { return level(1, 0); }

 private:
  static constexpr int precedence_of_sums = 4;

  void skip_blanks() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
  }

  struct Operator {
    std::string_view written;
    const char* meaning;
    int level;
  };

  const Operator* next_operator() {
    static constexpr Operator operators[] = {{"OREXP", "or", 1}, {"ANDEXP", "and", 2}, {"<>", "<>", 3}, {"<=", "<=", 3},
                                             {">=", ">=", 3},    {"=", "=", 3},        {"<", "<", 3},   {">", ">", 3},
                                             {"+", "+", 4},      {"-", "-", 4},        {"*", "*", 5},   {"/", "/", 5}};
    for (const Operator& op : operators)
      if (letter(op.written[0]) ? same_word(peek_word(), op.written) : rest().starts_with(op.written)) return &op;
    return nullptr;
  }

  Expression level(int lowest, int depth) {
    if (depth > ImportLimits::nesting) fail(fmt::format("is nested more than {} deep", ImportLimits::nesting));
    Expression left = signed_value(depth);
    while (const Operator* op = next_operator()) {
      if (op->level < lowest) break;
      const Place at = place();
      at_ += op->written.size();
      Expression right = level(op->level + 1, depth + 1);
      left = expression_at(at, Expression::Kind::binary, op->meaning, {std::move(left), std::move(right)});
      if (left.depth > ImportLimits::nesting) fail("is an expression of too many levels");
    }
    return left;
  }

  Expression signed_value(int depth) {
    const Place at = place();
    if (!take_sign("-")) return value(depth);
    return expression_at(at, Expression::Kind::unary, "-", {value(depth)});
  }

  Expression value(int depth) {
    if (depth > ImportLimits::nesting) fail(fmt::format("is nested more than {} deep", ImportLimits::nesting));
    const Place at = place();
    const std::string_view left = rest();
    if (left.empty()) fail("ends where a value is expected");
    if (digit(left[0]) || left[0] == '.') return number(at);
    if (left[0] == '"') return text(at);
    if (take_sign("(")) {
      Expression inner = level(1, depth + 1);
      if (!take_sign(")")) fail("has a ( without )");
      return inner;
    }
    std::string name = word();
    if (name.empty()) fail(fmt::format("has '{}' where a value is expected", left.substr(0, 20)));
    if (name == "on" || name == "off") return number_at(at, name == "on");
    const bool indexed = at_ < text_.size() && text_[at_] == '[';
    const bool called = at_ < text_.size() && text_[at_] == '(';
    if (!indexed && !called) return name_at(inform_name(name), at);
    ++at_;
    Expression index = level(1, depth + 1);
    if (!take_sign(indexed ? "]" : ")")) fail("has an index that is not closed");
    if (indexed) name += "[]";
    if (index.kind == Expression::Kind::number && (indexed || name.ends_with('#')))
      return name_at(inform_name(indexed ? fmt::format("{}{:.0f}", name.substr(0, name.size() - 2), index.number)
                                         : fmt::format("{}({:.0f})", name, index.number)),
                     at);
    return expression_at(at, Expression::Kind::call, name, {std::move(index)});
  }

  Expression number(const Place& at) {
    double value = 0;
    const auto [end, failure] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (failure != std::errc() || !std::isfinite(value)) fail("has a number out of range");
    at_ = end - text_.data();
    return number_at(at, value);
  }

  Expression text(const Place& at) {
    const std::size_t close = std::min(text_.find('"', at_ + 1), text_.size());
    Expression e = expression_at(at, Expression::Kind::text, std::string(text_.substr(at_ + 1, close - at_ - 1)));
    at_ = std::min(close + 1, text_.size());
    return e;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int file_, line_;
};

/// Returns the numbers of "1,2.5,-3"; std::nullopt for other text.
std::optional<std::vector<double>> numbers_of(std::string_view text) {
  constexpr std::size_t most = 40;  // largest count in one position or RCONF
  std::vector<double> numbers;
  while (!text.empty() && numbers.size() < most) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t' || text.front() == '+')) text.remove_prefix(1);
    double value = 0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (failure != std::errc() || !std::isfinite(value)) return {};
    numbers.push_back(value);
    text.remove_prefix(end - text.data());
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
    if (!text.empty() && text.front() != ',') return {};
    if (!text.empty()) text.remove_prefix(1);
  }
  if (!text.empty() || numbers.empty()) return {};
  return numbers;
}

/// Head lines that apply to the positions after them.
struct PositionHead {
  std::string type = "pulse";  ///< pulse, angle, base, robot, user, tool, mtool
  double user = 0, tool = 0;
  std::vector<double> configuration;  ///< numbers of RCONF
};

class InformParser {
 public:
  InformParser(Code& code, int file, Problems& problems) : code_(code), file_(file), problems_(problems) {
    const std::string_view text = code.files[file].text();
    for (std::size_t begin = 0; begin <= text.size() && lines_.size() < ImportLimits::tokens;) {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      lines_.push_back(without_comment(text.substr(begin, end - begin)));
      while (!lines_.back().empty() && static_cast<unsigned char>(lines_.back().back()) <= ' ')
        lines_.back().remove_suffix(1);
      begin = end + 1;
    }
  }

  void run() {
    const std::filesystem::path path = code_.files[file_].name();
    module_ = static_cast<int>(code_.modules.size());
    code_.modules.push_back({lower_case(path.stem().string()), path.stem().string(), {file_, 1, 1}});
    const std::string end = lower_case(path.extension().string());
    if (end == ".cnd")
      frames();
    else if (end == ".dat")
      variables();
    else
      job();
  }

 private:
  static constexpr int arguments = 8;  // largest number of ARGF of a job

  bool done() const { return at_ >= lines_.size() || problems_.full(); }
  Place place(int column = 1) const { return {file_, static_cast<int>(at_) + 1, column}; }
  void complain(const std::string& what, const std::string& remedy) {
    problems_.add({code_.files[file_].name(), static_cast<int>(at_) + 1, 1}, what, remedy);
  }

  // ---- positions -----------------------------------------------------------------------------------------------

  void add_position(const std::string& name, std::string_view written, const PositionHead& head, bool local) {
    const auto numbers = numbers_of(written);
    if (!numbers) return complain(fmt::format("gives {} no list of numbers", name), "list the job again");
    const auto list = [&](const std::vector<double>& values) {
      std::vector<Expression> items;
      for (const double value : values) items.push_back(number_at(place(), value));
      return expression_at(place(), Expression::Kind::aggregate, "", std::move(items));
    };
    Expression position =
        expression_at(place(), Expression::Kind::aggregate, "",
                      {list(*numbers), expression_at(place(), Expression::Kind::text, head.type),
                       number_at(place(), head.user), number_at(place(), head.tool), list(head.configuration)});
    code_.data.push_back({declaration_at(place(), inform_name(name), "position", std::move(position)), module_, local});
  }

  /// Reads a head line (///POSTYPE USER, ///RCONF 1,0,...). Unknown head lines are skipped.
  void head_line(std::string_view line, PositionHead& head) {
    Words at(line.substr(std::min(line.find_first_not_of('/'), line.size())), file_, static_cast<int>(at_) + 1);
    const std::string word = at.word();
    const auto number = [&] {
      const auto read = numbers_of(at.rest());
      return read ? read->front() : -1;
    };
    if (word == "tool") head.tool = number();
    if (word == "user") head.user = number();
    if (word == "postype") head.type = at.word();
    if (word == "rconf") head.configuration = numbers_of(at.rest()).value_or(std::vector<double>{});
    head.configuration.resize(std::min<std::size_t>(head.configuration.size(), 24));  // an RCONF has at most 24 numbers
  }

  // ---- jobs ----------------------------------------------------------------------------------------------------

  void job() {
    Routine routine;
    PositionHead head;
    bool positions = false;
    routine.place = place();
    for (; !done(); ++at_) {
      const std::string_view line = lines_[at_];
      if (line.starts_with("//NAME")) {
        Words at(line.substr(6), file_, static_cast<int>(at_) + 1);
        routine.written = std::string(at.rest());
        routine.place = place();
      } else if (line.starts_with("//POS")) {
        positions = true;
      } else if (line == "//INST" || same_word(line, "nop")) {
        break;
      } else if (line.starts_with("///")) {
        head_line(line, head);
      } else if (line.starts_with("/")) {
        positions = false;
      } else if (const std::size_t equals = line.find('='); positions && equals != std::string_view::npos) {
        const std::string name = lower_case(line.substr(0, equals));
        add_position(name, line.substr(equals + 1), head, name.find('c') != std::string::npos);  // C, BC, EC
      }
    }
    if (done()) return complain("holds no //INST", "give a job as the controller saves it (.JBI)");
    if (routine.written.empty()) routine.written = code_.modules[module_].written;
    routine.name = "job:" + lower_case(routine.written);
    routine.module = module_;
    for (int i = 1; i <= arguments; ++i) routine.parameters.push_back({fmt::format("iarg#({})", i), true, false});
    for (; !done() && (lines_[at_].starts_with("/") || lines_[at_].empty()); ++at_) group(lines_[at_], routine);
    const std::size_t begin = at_;
    routine.body = body({});
    declare_locals(begin, routine);
    routine.last_line = static_cast<int>(lines_.size());
    code_.routines.push_back(std::move(routine));
  }

  /// Reads the robot of a job from ///GROUP1 RB1,BS1. Two robots: "rb1,rb2".
  static void group(std::string_view line, Routine& routine) {
    if (!line.starts_with("///GROUP")) return;
    for (std::size_t at = line.find("RB"); at != std::string_view::npos; at = line.find("RB", at + 1))
      routine.robot += (routine.robot.empty() ? "" : ",") + lower_case(line.substr(at, 3));
  }

  /// Declares the local variables, because they are 0 at the start of every call.
  void declare_locals(std::size_t begin, Routine& routine) {
    std::set<std::string> found;
    for (std::size_t line = begin; line < lines_.size(); ++line)
      for (std::size_t at = lines_[line].find('L'); at != std::string_view::npos; at = lines_[line].find('L', at + 1)) {
        if (at > 0 && (letter(lines_[line][at - 1]) || digit(lines_[line][at - 1]))) continue;
        Words words(lines_[line].substr(at), file_, 1);
        const std::string name = inform_name(words.word());
        if (name.size() > 4 && digit(name.back()) && std::string_view("bidrs").find(name[1]) != std::string_view::npos)
          found.insert(name);
      }
    std::vector<Statement> declared;
    for (const std::string& name : found) declared.push_back(declaration_at(routine.place, name, "number"));
    routine.body.insert(routine.body.begin(), std::make_move_iterator(declared.begin()),
                        std::make_move_iterator(declared.end()));
  }

  /// Reads statements up to a line that begins with one of the words `until`. That line is not taken.
  std::vector<Statement> body(const std::vector<const char*>& until) {
    std::vector<Statement> statements;
    if (++depth_ > ImportLimits::nesting) {
      complain(fmt::format("is nested more than {} deep", ImportLimits::nesting), "use jobs");
      at_ = lines_.size();
    }
    while (!done()) {
      const std::string word = first_word();
      if (std::ranges::any_of(until, [&](const char* end) { return word == end; })) break;
      try {
        statement(word, statements);
      } catch (const SyntaxError& error) {
        problems_.add({code_.files[file_].name(), error.place.line, error.place.column}, error.what, error.remedy);
      }
      ++at_;
    }
    if (done() && !until.empty() && !problems_.full())
      problems_.add({code_.files[file_].name(), static_cast<int>(lines_.size()), 1},
                    fmt::format("ends before {}", until.front()), "close the block");
    --depth_;
    return statements;
  }

  std::string first_word() const {
    Words at(lines_[at_], file_, static_cast<int>(at_) + 1);
    return at.word();
  }

  void statement(const std::string& word, std::vector<Statement>& into) {
    Words at(lines_[at_], file_, static_cast<int>(at_) + 1);
    const std::string_view text = at.rest();
    if (text.empty() || text[0] == '\'' || text[0] == '/' || word == "nop" || word == "comm") return;
    Statement s = statement_at(at.place(), Kind::instruction);
    if (at.take_sign("*")) {
      s.kind = Kind::label;
      s.name = lower_case(at.item());
      return into.push_back(std::move(s));
    }
    if (word.empty()) at.fail(fmt::format("has '{}' where an instruction is expected", text.substr(0, 20)));
    at.word();
    s.name = word;
    s.text = std::string(text.substr(0, word.size()));
    if (word == "end" || word == "ret" || word == "abort") {
      s.kind = word == "abort" ? Kind::finish : Kind::give_back;
      only_if(at, std::move(s), into);
    } else if (word == "jump") {
      jump(at, std::move(s), into);
    } else if (word == "call" || word == "pstart") {
      call(at, std::move(s), into);
    } else if (word == "ifthen" || word == "ifthenexp") {
      into.push_back(branch(at));
    } else if (word == "switch") {
      into.push_back(choice(at));
    } else if (word == "while" || word == "whileexp") {
      into.push_back(while_loop(at));
    } else if (word == "for") {
      into.push_back(count(at));
    } else if (word.starts_with("mov") || word == "imov" || word == "smovl" || word == "smovc" || word == "speed" ||
               word == "svspotmov") {
      move(at, s);
      into.push_back(std::move(s));
    } else {
      operation(at, std::move(s), into);
    }
  }

  /// Adds a statement; if an IF follows it, adds a branch with the statement.
  void only_if(Words& at, Statement s, std::vector<Statement>& into) {
    if (!at.take("IF") && !at.take("IFEXPRESS")) return into.push_back(std::move(s));
    const Place place = s.place;
    Statement branch = statement_at(place, Kind::branch);
    branch.branches.push_back({{at.condition()}, {std::move(s)}, place});
    into.push_back(std::move(branch));
  }

  /// Returns the labels of the job that are numbers -> their lines.
  const std::map<std::string, int>& numbered_labels() {
    if (labels_) return *labels_;
    std::map<std::string, int>& labels = labels_.emplace();
    for (std::size_t line = 0; line < lines_.size(); ++line) {
      Words at(lines_[line], file_, static_cast<int>(line) + 1);
      if (!at.take_sign("*")) continue;
      const std::string name = lower_case(at.item());
      if (!name.empty() && name.size() < 9 && name.find_first_not_of("0123456789") == std::string::npos)
        labels.emplace(name, static_cast<int>(line) + 1);
    }
    return labels;
  }

  /// Reads JUMP LABEL: B000 as a choice among the labels that are numbers. If no label has this number, the controller
  /// stops.
  Statement jump_by_number(Words& at, const Statement& s) {
    Statement made = s;
    made.kind = Kind::choose;
    const std::string written = "LABEL: " + std::string(at.peek_word());
    made.arguments.push_back(at.operand());
    const auto add_way = [&](std::vector<Expression> conditions, const std::string& label) {
      Statement to_it = s;
      to_it.kind = Kind::jump;
      to_it.name = label;
      made.branches.push_back({std::move(conditions), {std::move(to_it)}, s.place});
    };
    constexpr std::size_t most = 20'000;  // ways of all these jumps together, each a kB of memory
    ways_ += numbered_labels().size();
    if (ways_ > most) {
      labels_->clear(), ways_ = 0;  // one problem for all further jumps
      at.fail(fmt::format("makes more than {} ways of JUMP LABEL: to labels of the job", most));
    }
    for (const auto& [label, line] : numbered_labels()) {
      Expression number = Words(label, file_, s.place.line).operand();
      number.place = {file_, line, 2};  // column after the *
      add_way({std::move(number)}, label);
    }
    add_way({}, written);
    return made;
  }

  /// Reads JUMP *LABEL, JUMP LABEL: B000 or JUMP JOB:NAME, with an optional IF.
  void jump(Words& at, Statement s, std::vector<Statement>& into) {
    if (at.take_sign("*")) {
      s.kind = Kind::jump;
      s.name = lower_case(at.item());
      return only_if(at, std::move(s), into);
    }
    if (at.take("LABEL") && at.take_sign(":")) return only_if(at, jump_by_number(at, s), into);
    if (!at.take("JOB") || !at.take_sign(":"))
      at.fail("jumps to a label or job whose name is worked out while the robot runs");
    s.name = "job:" + at.word(true);
    s.text = "JUMP " + s.name;
    Statement end = s;
    end.kind = Kind::finish;
    Statement branch;  // call and end, if the condition is true
    only_if(at, std::move(s), into);
    if (into.back().kind == Kind::branch)
      into.back().branches[0].body.push_back(std::move(end));
    else
      into.push_back(std::move(end));
  }

  /// Reads CALL JOB:NAME ARGF1 ARGFB000 IF ... or PSTART JOB:NAME SUB1.
  void call(Words& at, Statement s, std::vector<Statement>& into) {
    const bool beside = s.name == "pstart";
    if (!at.take("JOB") || !at.take_sign(":")) {
      if (beside) return into.push_back(std::move(s));
      at.fail("calls a job whose name is worked out while the robot runs");
    }
    const std::string job = at.word(true);
    s.name = beside ? "pstart" : "job:" + job;
    s.text = fmt::format("{} JOB:{}", beside ? "PSTART" : "CALL", job);
    if (beside) {
      s.arguments.push_back(name_at("job:" + job, s.place));
      return into.push_back(std::move(s));
    }
    for (int i = 1; !at.at_end() && i <= arguments;) {
      const std::string_view next = at.peek_word();
      if (next.size() > 4 && same_word(next.substr(0, 4), "argf")) {
        Words argument(next.substr(4), file_, s.place.line);
        at.word();
        s.arguments.push_back(argument.operand());
        s.arguments.back().place = s.place;
        s.arguments.back().option = fmt::format("iarg#({})", i++);
      } else if (same_word(next, "argf")) {  // ARGF-5, ARGF"text"
        at.word();
        s.arguments.push_back(at.operand());
        s.arguments.back().option = fmt::format("iarg#({})", i++);
      } else {
        break;
      }
    }
    if (same_word(at.peek_word(), "uf#")) at.fail("calls a job in another user frame than it was taught in");
    only_if(at, std::move(s), into);
  }

  Statement branch(Words& at) {
    Statement s = statement_at(at.place(), Kind::branch);
    const auto add = [&](const Place& place, std::vector<Expression> conditions) {
      ++at_;
      s.branches.push_back({std::move(conditions), body({"endif", "else", "elseif", "elseifexp"}), place});
    };
    add(s.place, {at.condition()});
    while (!done() && first_word() != "endif") {
      Words next(lines_[at_], file_, static_cast<int>(at_) + 1);
      const Place place = next.place();
      if (next.word() == "else")
        add(place, {});
      else
        add(place, {next.condition()});
    }
    return s;
  }

  /// Reads SWITCH B000 CASE 1 ... CASE 2 ... DEFAULT ... ENDSWITCH. The first CASE may be on the line of SWITCH.
  Statement choice(Words& at) {
    Statement s = statement_at(at.place(), Kind::choose);
    s.arguments.push_back(at.operand());
    bool same_line = !at.at_end();
    if (!same_line) ++at_;
    while (!done() && (same_line || first_word() != "endswitch")) {
      Words line(lines_[at_], file_, static_cast<int>(at_) + 1);
      Words& next = same_line ? at : line;
      same_line = false;
      Branch other;
      other.place = next.place();
      const std::string word = next.word();
      if (word == "case") do
          other.conditions.push_back(next.operand());
        while (next.take_sign(","));
      else if (word != "default" && !word.empty())
        next.fail("has an instruction before the first CASE");
      ++at_;
      other.body = body({"endswitch", "case", "default"});
      if (!word.empty()) s.branches.push_back(std::move(other));
    }
    return s;
  }

  Statement while_loop(Words& at) {
    Statement s = statement_at(at.place(), Kind::while_loop);
    if (at.take("FOREVER"))
      s.kind = Kind::endless;
    else
      s.arguments.push_back(at.condition());
    ++at_;
    s.branches.emplace_back();
    s.branches[0].body = body({"endwhile"});
    return s;
  }

  /// Reads FOR I000 START= 1 TO 10 STEP=2 ... NEXT I000.
  Statement count(Words& at) {
    Statement s = statement_at(at.place(), Kind::count);
    s.keeps_counter = true;
    s.name = inform_name(at.word());
    const auto tag = [&](const char* word) {
      if (!at.take(word)) return false;
      at.take_sign("=");
      return true;
    };
    if (!tag("START")) at.fail("has a FOR without START");
    s.arguments.push_back(at.operand());
    if (!tag("TO")) at.fail("has a FOR without TO");
    s.arguments.push_back(at.operand());
    s.arguments.push_back(tag("STEP") ? at.operand() : number_at(s.place, 1));
    ++at_;
    s.branches.emplace_back();
    s.branches[0].body = body({"next"});
    return s;
  }

  /// Reads MOVL C00001 BC00001 V=100.0 PL=1 UNTIL IN#(1)=ON +MOVJ EC00001 VJ=5.00 //comment. The tag of each argument is
  /// its option.
  void move(Words& at, Statement& s) {
    static const std::set<std::string> numbers{"vj", "v", "vr", "ve", "pl", "cr", "acc", "dec"};
    bool beside = false;
    while (!at.at_end() && !at.rest().starts_with("//")) {
      if (at.take_sign("+")) {
        beside = true;
        at.word();
        continue;
      }
      const std::string_view next = at.peek_word();
      const std::string name = inform_name(std::string(next));
      const std::size_t letters = std::min(name.find_first_of("0123456789["), name.size());
      const std::string kind = name.substr(0, letters);
      if (numbers.contains(name)) {
        at.word();
        if (!at.take_sign("=")) at.fail(fmt::format("has {} without '='", next));
        Expression value = at.operand();
        value.option = beside ? "beside" : name;
        s.arguments.push_back(std::move(value));
      } else if (kind == "uf#" || next == "BF" || next == "RF" || next == "TF" || next == "MTF") {
        Expression frame = at.operand();
        frame.option = "frame";
        s.arguments.push_back(std::move(frame));
      } else if (kind == "c" || kind == "p" || kind == "lp" || kind == "bc" || kind == "bp" || kind == "lbp" ||
                 kind == "ec" || kind == "ex" || kind == "lex") {
        Expression target = at.operand();
        const bool robot = kind == "c" || kind == "p" || kind == "lp";
        target.option = robot                                 ? (beside ? "other_robot" : "")
                        : kind.find('b') != std::string::npos ? "base"
                                                              : "station";
        s.arguments.push_back(std::move(target));
      } else if (same_word(next, "UNTIL") || same_word(next, "FPT") || same_word(next, "NWAIT")) {
        const Place place = at.place();
        Expression word = name_at(at.word(), place);
        word.option = word.text;
        s.arguments.push_back(std::move(word));
        if (same_word(next, "UNTIL")) at.condition();
      } else {
        Expression word = expression_at(at.place(), Expression::Kind::text, at.item());
        word.option = "unknown";
        s.arguments.push_back(std::move(word));
      }
    }
  }

  /// Reads SET B000 1, ADD I000 EXPRESS I001 + 1, TIMER T=1.00, DOUT OT#(1) ON, and all other instructions.
  void operation(Words& at, Statement s, std::vector<Statement>& into) {
    static const pipeline::WordSet read = pipeline::word_set(
        "set add sub mul div inc dec clear sete gete gets din getarg timer wait sfton sftof mframe settool sqrt sin "
        "cos atan cnvrt and or not xor getpos mulmat invmat mshift getreg val len asc mid cat val2str");
    if (!read.contains(s.name)) return into.push_back(std::move(s));
    if (s.name == "timer" || s.name == "wait") {
      if (s.name == "wait" && !same_word(at.peek_word(), "t")) return into.push_back(std::move(s));
      s.name = "timer";
      if (!at.take("T") || !at.take_sign("=")) at.fail("waits without T=");
      s.arguments.push_back(at.operand());
      if (const std::string_view rest = at.rest(); !rest.empty() && !rest.starts_with("//"))
        at.fail(fmt::format("has '{}' behind a time, which counts seconds", rest));
    }
    while (!at.at_end() && !at.rest().starts_with("//")) {
      if (at.take_sign("(")) {  // SETE P000 (3) D000
        s.arguments.push_back(at.condition());
        if (!at.take_sign(")")) at.fail("has a ( without )");
      } else {
        s.arguments.push_back(at.operand());
      }
    }
    plain(s);
    into.push_back(std::move(s));
  }

  /// Converts SET, GETARG, ADD, SUB, MUL, DIV, INC and DEC of numbers to an assignment.
  static void plain(Statement& s) {
    const auto& given = s.arguments;
    const bool two = given.size() == 2 && given[0].kind == Expression::Kind::name;
    const bool one = given.size() == 1 && given[0].kind == Expression::Kind::name;
    const std::string& target = given.empty() ? s.name : given[0].text;
    const bool position =
        target.starts_with("p") || target.starts_with("lp") || target.starts_with("bp") || target.starts_with("ex");
    static const std::vector<std::pair<std::string, std::string>> calculations{
        {"add", "+"}, {"sub", "-"}, {"mul", "*"}, {"div", "/"}, {"inc", "+"}, {"dec", "-"}};
    Expression value;
    if ((s.name == "set" || s.name == "getarg") && two) {
      value = given[1];
    } else {
      const auto found =
          std::ranges::find_if(calculations, [&](const auto& calculation) { return calculation.first == s.name; });
      const bool counts = s.name == "inc" || s.name == "dec";
      if (found == calculations.end() || position || !(counts ? one : two)) return;
      value = expression_at(s.place, Expression::Kind::binary, found->second,
                            {given[0], counts ? number_at(s.place, 1) : given[1]});
    }
    const bool whole = !position && target.size() > 1 && std::string_view("bid").find(target[target[0] == 'l']) < 3;
    if (whole && value.kind != Expression::Kind::number)
      value = expression_at(s.place, Expression::Kind::call, "trunc", {value});
    s.kind = Kind::assign;
    s.arguments = {given[0], std::move(value)};
  }

  // ---- the controller's data -----------------------------------------------------------------------------------

  /// Reads TOOL.CND or UFRAME.CND: frames become positions tl#(n), uf#(n).
  void frames() {
    std::string name;
    bool taken = false;
    PositionHead head;
    head.type = "base";
    for (; !done(); ++at_) {
      std::string_view line = lines_[at_];
      if (line.starts_with("//TOOL ") || line.starts_with("//UFRAME ")) {
        const bool tool = line.starts_with("//TOOL ");
        const auto number = numbers_of(line.substr(line.find(' ')));
        name = number ? fmt::format("{}#({:.0f})", tool ? "tl" : "uf", number->front()) : "";
        taken = false;
      } else if (const std::size_t user = line.find("BUSER"); !name.empty() && user != std::string_view::npos) {
        line.remove_prefix(user + 5);
        if (line.empty() && at_ + 1 < lines_.size()) line = lines_[++at_];
        add_position(name, line, head, false);
        name.clear();
      } else if (name.starts_with("tl") && !taken && !line.starts_with("/") && !line.empty()) {
        add_position(name, line, head, false);
        taken = true;
      }
    }
  }

  /// Reads VAR.DAT: ///B, ///I, ///D, ///R with ten numbers per line, ///P with one position per line.
  void variables() {
    std::string section;
    int next = 0;
    for (; !done(); ++at_) {
      const std::string_view line = lines_[at_];
      if (line.starts_with("///")) {
        section = lower_case(line.substr(3));
        next = 0;
      } else if (line.starts_with("/")) {
        section.clear();
      } else if (section == "p") {
        position_variable(next++, line);
      } else if (section == "b" || section == "i" || section == "d" || section == "r") {
        const auto numbers = numbers_of(line);
        for (std::size_t i = 0; numbers && i < numbers->size(); ++i) {
          const std::string name = fmt::format("{}{:03}", section, next++);
          code_.data.push_back(
              {declaration_at(place(), name, "number", number_at(place(), (*numbers)[i])), module_, false, true});
        }
      }
    }
  }

  /// Reads "RECTAN"0,0,3,<24 digits>,0,16,x,y,z,...: cells are -, user frame, tool, RCONF, -, system (16 base, 17 robot,
  /// 19 user), numbers.
  void position_variable(int number, std::string_view line) {
    const bool pulses = line.starts_with("\"PULSE\"");
    if (!pulses && !line.starts_with("\"RECTAN\"")) return;
    line.remove_prefix(line.find('"', 1) + 1);
    std::vector<std::string_view> cells;
    for (std::size_t begin = 0; begin <= line.size() && cells.size() < 7;) {
      const std::size_t end = cells.size() == 6 ? line.size() : std::min(line.find(',', begin), line.size());
      cells.push_back(line.substr(begin, end - begin));
      begin = end + 1;
    }
    if (cells.size() < 7) return;
    const auto cell = [&](std::size_t i) { return numbers_of(cells[i]).value_or(std::vector<double>{-1})[0]; };
    PositionHead head;
    head.tool = cell(2);
    head.user = cell(1);
    for (const char c : cells[3].substr(0, 6)) head.configuration.push_back(c == '1');
    const double system = cell(5);
    head.type = pulses ? "pulse" : system == 16 ? "base" : system == 17 ? "robot" : system == 19 ? "user" : "unknown";
    add_position(fmt::format("p{}", number), cells[6], head, false);
    code_.data.back().by_backup = true;
  }

  Code& code_;
  int file_, module_ = -1, depth_ = 0;
  Problems& problems_;
  std::vector<std::string_view> lines_;
  std::size_t at_ = 0;
  std::optional<std::map<std::string, int>> labels_;  // see numbered_labels()
  std::size_t ways_ = 0;                              // of JUMP LABEL:
};

}  // namespace

void add_inform_types(Code& code) {
  code.records.push_back({.name = "position",
                          .fields = {"numbers", "type", "user", "tool", "configuration"},
                          .types = std::vector<const RecordType*>(5, nullptr)});
}

void parse_inform(Code& code, int file, Problems& problems) { InformParser(code, file, problems).run(); }

void name_inform_values(Code& code) {
  std::map<std::string, Expression> named;
  for (auto& [name, value] : code.values) named[inform_name(name)] = std::move(value);
  code.values = std::move(named);
}

bool moves_inform_robot(const std::string& name) {
  static const std::set<std::string> words{"movj", "movl", "movc", "movs", "imov", "smovl", "smovc", "svspotmov"};
  return words.contains(name);
}

Calls inform_calls(const SourceFile& job) {
  Code code;
  code.files.push_back(job);
  Problems ignored;  // the reader of the job reports them
  parse_inform(code, 0, ignored);
  Calls calls;
  if (code.routines.empty()) return calls;
  calls.name = code.routines[0].name.substr(std::string_view("job:").size());
  const std::function<void(const std::vector<Statement>&)> take = [&](const std::vector<Statement>& body) {
    for (const Statement& s : body) {
      const std::string& name = s.name == "pstart" && !s.arguments.empty() ? s.arguments[0].text : s.name;
      if (name.starts_with("job:")) calls.names.insert(name.substr(std::string_view("job:").size()));
      calls.moves |= moves_inform_robot(name);
      for (const Branch& branch : s.branches) take(branch.body);
    }
  };
  take(code.routines[0].body);
  return calls;
}

std::string inform_name(const std::string& written) {
  std::string name = lower_case(written);
  std::erase(name, '[');
  std::erase(name, ']');
  const std::size_t digits = std::min(name.find_first_of("0123456789"), name.size());
  const std::string letters = name.substr(0, digits);
  static const pipeline::WordSet variables =
      pipeline::word_set("b i d r s p px bp ex c bc ec lb li ld lr ls lp lpx lbp lex");
  if (digits == 0 || digits == name.size() || !variables.contains(letters)) return lower_case(written);
  const auto number = pipeline::whole_number_in<int>(std::string_view(name).substr(digits));
  if (!number) return lower_case(written);
  return fmt::format("{}{:03}", letters.ends_with("px") ? letters.substr(0, letters.size() - 1) : letters, *number);
}

}  // namespace dresslife::sim
