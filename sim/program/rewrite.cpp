#include "sim/program/rewrite.h"

#include <algorithm>
#include <cmath>

#include "pipeline/base/constants.h"
#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/readable.h"
#include "pipeline/base/text.h"
#include "sim/program/fanuc/run.h"
#include "sim/program/interpreter/encoding.h"
#include "sim/program/interpreter/parser.h"
#include "sim/program/interpreter/tokens.h"
#include "sim/program/krl/frames.h"
#include "sim/program/rapid/dialect.h"

namespace dresslife::sim {
namespace {

/// The lines of a file without their line ends, and their changes.
class Lines {
 public:
  Lines(const std::string& file, const std::string& bytes) : file_(file) {
    for (std::size_t begin = 0; begin < bytes.size();) {
      const std::size_t end = std::min(bytes.find('\n', begin), bytes.size());
      std::string line = bytes.substr(begin, end - begin);
      const bool has_return = line.ends_with('\r');
      if (has_return) line.pop_back();
      lines_.push_back({line, {line}, has_return ? "\r" : ""});
      ends_with_newline_ = end < bytes.size();
      begin = end + 1;
    }
  }

  int count() const { return static_cast<int>(lines_.size()); }
  const std::string& at(int line) const { return line_at(line).before; }
  /// Returns the changed line, without the lines added before and after it.
  std::string& now(int line) { return line_at(line).now.at(line_at(line).own); }
  /// Returns the line as it is now, with the lines added before and after it.
  const std::vector<std::string>& written(int line) const { return line_at(line).now; }
  void before(int line, std::string text) {
    Line& l = line_at(line);
    l.now.insert(l.now.begin() + static_cast<long>(l.own++), std::move(text));
  }
  void behind(int line, std::string text) { line_at(line).now.push_back(std::move(text)); }
  /// Puts a byte order mark before the first line.
  void mark(const std::string& bytes) {
    if (lines_.empty()) return;
    lines_[0].before.insert(0, bytes), lines_[0].now[0].insert(0, bytes);
  }

  /// Renumbers a listing's statements in lines first .. end - 1 after lines were added.
  void renumber(int first, int end) {
    int next = 0;
    for (int line = first; line < end; ++line)
      for (std::string& text : line_at(line).now) {
        const std::size_t colon = text.find(':');
        if (colon == std::string::npos || colon == 0 || text.find_first_not_of(" 0123456789") != colon ||
            text.find_first_of("0123456789") > colon)
          continue;
        text.replace(0, colon, fmt::format("{:>{}}", ++next, colon));
      }
  }

  /// Returns the numbers that the lines have in the changed file.
  std::vector<int> numbers() const {
    std::vector<int> made;
    std::size_t before = 0;
    for (const Line& line : lines_) {
      made.push_back(static_cast<int>(before + line.own) + 1);
      before += line.now.size();
    }
    return made;
  }

  std::string text() const {
    std::string made;
    for (const Line& line : lines_)
      for (const std::string& now : line.now) made += now + line.end + "\n";
    if (!ends_with_newline_) made.pop_back();
    return made;
  }

  /// Returns the unified diff, with three lines of context around each change.
  std::string patch() const {
    constexpr std::size_t around = 3;
    std::string made = fmt::format("--- a/{0}\n+++ b/{0}\n", file_);
    std::size_t added = 0;  // number of lines added by the earlier hunks
    for (std::size_t i = 0; i < lines_.size();) {
      if (!lines_[i].changed()) {
        ++i;
        continue;
      }
      const std::size_t begin = i - std::min(i, around);
      std::size_t end = i, quiet = 0;
      for (; end < lines_.size() && quiet < 2 * around; ++end) quiet = lines_[end].changed() ? 0 : quiet + 1;
      end -= quiet - std::min(quiet, around);
      std::string body;
      std::size_t now = 0;
      for (std::size_t k = begin; k < end; ++k) {
        const Line& line = lines_[k];
        const bool kept = line.now[line.own] == line.before, last = k + 1 == lines_.size();
        if (!kept) body += row('-', line.before + line.end, last);
        for (std::size_t n = 0; n < line.now.size(); ++n)
          body += row(kept && n == line.own ? ' ' : '+', line.now[n] + line.end, last && n + 1 == line.now.size());
        now += line.now.size();
      }
      made += fmt::format("@@ -{},{} +{},{} @@\n", begin + 1, end - begin, begin + 1 + added, now) + body;
      added += now - (end - begin);
      i = end;
    }
    return made;
  }

 private:
  struct Line {
    std::string before;
    std::vector<std::string> now;
    const char* end;      // "\\r" or nothing: before the newline
    std::size_t own = 0;  // index of the line itself among them
    bool changed() const { return now.size() > 1 || now[0] != before; }
  };
  Line& line_at(int line) { return lines_.at(static_cast<std::size_t>(line) - 1); }
  const Line& line_at(int line) const { return lines_.at(static_cast<std::size_t>(line) - 1); }
  std::string row(char mark, const std::string& line, bool last) const {
    return mark + line + "\n" + (last && !ends_with_newline_ ? "\\ No newline at end of file\n" : "");
  }

  std::string file_;
  std::vector<Line> lines_;
  bool ends_with_newline_ = true;
};

[[noreturn]] void refuse(const LineChange& change, const std::string& what) {
  throw pipeline::InputError(change.where, "cannot be changed by itself: " + what, "change it by hand");
}

std::string in_degrees(const std::vector<double>& joints) {
  return pipeline::joined(
      pipeline::mapped(joints, [](double angle) { return pipeline::short_decimal(angle / degree, 6); }), ",");
}

/// Returns the number times `factor`: "500" -> "350"; std::nullopt: not a number.
std::optional<std::string> scaled(std::string_view number, double factor) {
  const auto value = pipeline::whole_number_in<double>(number);
  return value ? std::optional(pipeline::short_decimal(*value * factor, 6)) : std::nullopt;
}

std::string indentation(const std::string& line) {
  return line.substr(0, std::min(line.find_first_not_of(" \t"), line.size()));
}

/// Common data of the writers of all languages: the file, its tokens, and access to a change's instruction.
struct Writer {
  Lines& lines;
  const SourceFile& source;
  const std::vector<Token>& tokens;
  const Program& program;

  const Instruction& instruction(const LineChange& change) const {
    const Instruction* found = nullptr;
    for (const Instruction& i : program.instructions) {
      if (i.where.file != change.where.file || i.where.line != change.where.line || i.kind == Instruction::Kind::dwell)
        continue;
      if (found && (found->target.joints != i.target.joints || found->target.pose.position != i.target.pose.position) &&
          (change.configuration || !change.joints.empty() || !change.point.empty()))
        refuse(change, "it is run with several targets");
      found = &i;
    }
    if (!found) refuse(change, "no move was read from it");
    return *found;
  }

  /// Returns the index of the instruction's first token.
  std::size_t begin(const LineChange& change) const {
    for (std::size_t i = 0; i < tokens.size(); ++i)
      if (tokens[i].line == change.where.line && tokens[i].column == change.where.column) return i;
    refuse(change, "its words are not found");
  }

  /// Refuses an additional line before the instruction unless the instruction begins its line and is a statement by itself:
  /// otherwise the added line would run without the condition or the wait before the instruction.
  void need_own_line(std::size_t name, const LineChange& change) const {
    if (name == 0) return;
    const Token& before = tokens[name - 1];
    static const pipeline::WordSet ends =
        pipeline::word_set("; : then do else error undo endif endfor endwhile endtest");
    // The last parenthesis of PROC main(): the word before the name is PROC.
    std::size_t open = name - 1;
    while (before.text == ")" && open > 2 && tokens[open].text != "(") --open;
    const bool header = before.text == ")" && open > 1 && same_word(tokens[open - 2].text, "proc");
    if (before.kind != Token::Kind::line_end && !header &&
        (before.line == tokens[name].line || !ends.contains(lower_case(before.text))))
      refuse(change, "a line before it would run without what the program does right before it");
  }

  std::string_view text(std::size_t first, std::size_t last) const {  // tokens first .. last
    const char* from = tokens[first].text.data() - (tokens[first].kind == Token::Kind::text);
    return {from, static_cast<std::size_t>(tokens[last].text.data() + tokens[last].text.size() - from) +
                      (tokens[last].kind == Token::Kind::text)};
  }

  /// Replaces tokens first .. last. Errors: refuses the change if they are on several lines.
  void replace(std::size_t first, std::size_t last, const std::string& with, const LineChange& change) {
    if (tokens[first].line != tokens[last].line) refuse(change, "the changed text is on several lines");
    const int line = tokens[first].line;
    std::string& now = lines.now(line);
    const std::string old(text(first, last));
    // Replacements go from the line's end to its begin, so the text up to this column is still the original.
    const std::size_t at = now.rfind(old, static_cast<std::size_t>(tokens[first].column) - 1);
    if (at == std::string::npos || at != static_cast<std::size_t>(tokens[first].column) - 1)
      refuse(change, "it holds other than plain characters");
    now.replace(at, old.size(), with);
  }
};

// ---- RAPID --------------------------------------------------------------------------------------------------------

struct Argument {
  std::size_t first, last;      // tokens
  std::size_t expression_last;  // last token of the expression, before its options
  bool option;                  // an option without an expression
};

/// Returns the arguments of an instruction. end: index of the token after the last argument.
std::vector<Argument> arguments_of(const std::vector<Token>& tokens, std::size_t name, std::size_t& end) {
  std::vector<Argument> found;
  int depth = 0;
  std::size_t first = name + 1;
  bool options = false;
  const auto close = [&](std::size_t behind) {
    if (behind > first) found.push_back({first, behind - 1, behind - 1, tokens[first].text == "\\"});
    if (behind > first && options && !found.back().option)
      for (std::size_t i = first, level = 0; i < behind; ++i) {
        level += tokens[i].text == "[" || tokens[i].text == "(" || tokens[i].text == "{";
        level -= tokens[i].text == "]" || tokens[i].text == ")" || tokens[i].text == "}";
        if (level == 0 && tokens[i].text == "\\") {
          found.back().expression_last = i - 1;
          break;
        }
      }
    first = behind + 1;
    options = false;
  };
  std::size_t i = name + 1;
  for (; i < tokens.size() && tokens[i].kind != Token::Kind::end; ++i) {
    const std::string_view text = tokens[i].kind == Token::Kind::sign ? tokens[i].text : std::string_view();
    if (text == "[" || text == "(" || text == "{") ++depth;
    if (text == "]" || text == ")" || text == "}") --depth;
    options |= depth == 0 && text == "\\";
    if (depth == 0 && (text == "," || text == ";")) close(i);
    if (depth == 0 && text == ";") break;
  }
  end = i;
  return found;
}

std::string rapid_speed(const Writer& w, const Argument& speed, double factor, const LineChange& change) {
  if (w.tokens[speed.first].kind == Token::Kind::word && speed.first == speed.expression_last)
    return fmt::format("[{0}*{1}.v_tcp,{0}*{1}.v_ori,{1}.v_leax,{1}.v_reax]", pipeline::short_decimal(factor, 3),
                       w.tokens[speed.first].text);
  std::vector<std::string> parts;
  for (std::size_t i = speed.first + 1; i < speed.expression_last; ++i)
    if (w.tokens[i].text != ",") parts.emplace_back(w.tokens[i].text);
  if (w.tokens[speed.first].text != "[" || parts.size() != 4)
    refuse(change, "its speed is neither a name nor four numbers");
  for (std::size_t i = 0; i < 2; ++i) {
    const auto number = scaled(parts[i], factor);
    if (!number) refuse(change, "its speed is neither a name nor four numbers");
    parts[i] = *number;
  }
  return fmt::format("[{}]", fmt::join(parts, ","));
}

std::string rapid_external(const Target& target) {
  std::vector<std::string> axes;
  for (std::size_t i = 0; i < 6; ++i)
    axes.push_back(i < target.external_axes.size() ? pipeline::short_decimal(target.external_axes[i], 4) : "9E9");
  return fmt::format("[{}]", fmt::join(axes, ","));
}

void change_rapid(Writer& w, const LineChange& change) {
  const std::size_t name = w.begin(change);
  const Signature* signature = rapid_move(lower_case(w.tokens[name].text));
  if (!signature) refuse(change, "it is no move instruction");
  std::size_t end = 0;
  std::vector<Argument> given;
  for (const Argument& argument : arguments_of(w.tokens, name, end))
    if (!argument.option) given.push_back(argument);
  if (w.tokens[end].kind == Token::Kind::end) refuse(change, "it has no end");
  const int count = static_cast<int>(given.size());
  const auto index = [&](int written) { return written == -2 ? count - 1 : written == -3 ? count - 2 : written; };
  if (std::max(signature->target, signature->speed) >= count || index(signature->tool) >= count)
    refuse(change, "it has other arguments than are read");
  const Argument &target = given[static_cast<std::size_t>(signature->target)],
                 &speed = given[static_cast<std::size_t>(signature->speed)],
                 &tool = given[static_cast<std::size_t>(index(signature->tool))];
  const Instruction& read = w.instruction(change);
  const std::string target_text(w.text(target.first, target.expression_last));
  const bool named = target.first == target.expression_last && w.tokens[target.first].kind == Token::Kind::word;
  const std::string old_speed(w.text(speed.first, speed.last)), old_tool(w.text(tool.first, tool.last));
  // From the line's end to its begin, so that the columns of the tokens stay valid.
  w.lines.now(w.tokens[end].line) += " ! " + change.reason;
  if (change.speed) {
    for (std::size_t i = speed.expression_last + 1; i < speed.last; ++i)
      if (w.tokens[i].text == "\\") refuse(change, "its speed has an option (\\T or \\V)");
    w.replace(speed.first, speed.expression_last, rapid_speed(w, speed, *change.speed, change), change);
  }
  if (change.configuration && read.target.joints.empty()) {
    const auto& n = change.configuration->numbers;
    const Frame& pose = read.target.pose;
    const Vector3 p = pose.position / millimetre;
    const Quaternion& q = pose.orientation;
    w.replace(target.first, target.expression_last,
              named ? fmt::format("[{0}.trans,{0}.rot,[{1}],{0}.extax]", target_text, fmt::join(n, ","))
                    : fmt::format("[[{},{},{}],[{},{},{},{}],[{}],{}]", pipeline::short_decimal(p.x(), 6),
                                  pipeline::short_decimal(p.y(), 6), pipeline::short_decimal(p.z(), 6),
                                  pipeline::short_decimal(q.w(), 9), pipeline::short_decimal(q.x(), 9),
                                  pipeline::short_decimal(q.y(), 9), pipeline::short_decimal(q.z(), 9),
                                  fmt::join(n, ","), rapid_external(read.target)),
              change);
  }
  if (!change.joints.empty())
    w.replace(target.first, target.expression_last,
              fmt::format("[[{}],{}]", in_degrees(change.joints),
                          named ? target_text + ".extax" : rapid_external(read.target)),
              change);
  if (change.point.empty()) return;
  if (!read.target.external_axes.empty()) refuse(change, "external axes move with it");
  w.need_own_line(name, change);
  w.lines.before(w.tokens[name].line, fmt::format("{}MoveAbsJ [[{}],[9E9,9E9,9E9,9E9,9E9,9E9]],{},z50,{}; ! {}",
                                                  indentation(w.lines.at(w.tokens[name].line)),
                                                  in_degrees(change.point), old_speed, old_tool, change.reason));
}

// ---- KRL ----------------------------------------------------------------------------------------------------------

std::string krl_axes(const std::vector<double>& joints) {
  std::string list;
  for (std::size_t i = 0; i < joints.size(); ++i)
    list += fmt::format("{}A{} {}", list.empty() ? "" : ",", i + 1, pipeline::short_decimal(joints[i] / degree, 6));
  return list;
}

void change_krl(Writer& w, const LineChange& change) {
  const std::size_t name = w.begin(change);
  const Instruction& read = w.instruction(change);
  const bool joint_move = lower_case(w.tokens[name].text) == "ptp";
  if (!joint_move) refuse(change, "only PTP is changed");
  std::size_t last = name;  // last token of the target
  int depth = 0;
  for (std::size_t i = name + 1; w.tokens[i].kind != Token::Kind::line_end && w.tokens[i].kind != Token::Kind::end;
       ++i) {
    if (w.tokens[i].text == "{" || w.tokens[i].text == "[") ++depth;
    if (w.tokens[i].text == "}" || w.tokens[i].text == "]") --depth;
    if (depth == 0 && w.tokens[i].kind == Token::Kind::word && lower_case(w.tokens[i].text).starts_with("c_")) break;
    last = i;
  }
  if (last == name) refuse(change, "its target is not found");
  if (change.speed || !change.point.empty()) w.need_own_line(name, change);
  const int line = w.tokens[name].line;
  const std::string margin = indentation(w.lines.at(line)), comment = " ; " + change.reason;
  w.lines.now(line) += comment;
  std::string external;
  for (std::size_t i = 0; i < read.target.external_axes.size(); ++i)
    external += fmt::format(",E{} {}", i + 1, pipeline::short_decimal(read.target.external_axes[i], 4));
  if (change.configuration && read.target.joints.empty()) {
    const auto n = krl::numbers_of(read.target.pose);
    std::string frame;
    constexpr const char* names[] = {"X", "Y", "Z", "A", "B", "C"};
    for (std::size_t i = 0; i < 6; ++i)
      frame += fmt::format("{}{} {}", i == 0 ? "" : ",", names[i], pipeline::short_decimal(n[i], 6));
    w.replace(name + 1, last,
              fmt::format("{{{},S {},T {}{}}}", frame, change.configuration->numbers.at(0),
                          change.configuration->numbers.at(1), external),
              change);
  }
  if (!change.joints.empty())
    w.replace(name + 1, last, fmt::format("{{{}{}}}", krl_axes(change.joints), external), change);
  if (!change.point.empty())
    w.lines.before(line, fmt::format("{}PTP {{{}}}{}", margin, krl_axes(change.point), comment));
  if (!change.speed) return;
  if (!read.speed.axis_percent) refuse(change, "its speed is not one percentage of all axes");
  const double written = *read.speed.axis_percent / read.speed.override_share;
  const auto basics = [&](double percent) {
    return fmt::format("{}BAS(#VEL_PTP,{})", margin, pipeline::short_decimal(percent, 4));
  };
  w.lines.before(line, basics(written * *change.speed) + comment);
  w.lines.behind(line, basics(written) + " ; as before");
}

// ---- Fanuc --------------------------------------------------------------------------------------------------------

/// Returns the index after "12:" in a listing's line.
std::size_t behind_number(const std::string& line) {
  const std::size_t colon = line.find(':');
  return colon == std::string::npos ? line.size() : colon + 1;
}

/// Returns the index of P[3:name] in a line, from `from` on; npos: none. PR[3] (a register) does not match.
std::size_t find_position(const std::string& line, std::size_t from) {
  for (std::size_t at = line.find("P[", from); at != std::string::npos; at = line.find("P[", at + 1))
    if (at == 0 || !(std::isalnum(static_cast<unsigned char>(line[at - 1])) || line[at - 1] == '_')) return at;
  return std::string::npos;
}

int position_number(const std::string& line, std::size_t at) { return std::atoi(line.c_str() + at + 2); }

/// Returns the first line of the positions.
int positions_begin(const Lines& lines) {
  for (int line = 1; line <= lines.count(); ++line)
    if (lines.at(line).starts_with("/POS")) return line;
  return lines.count() + 1;
}

/// Changes CONFIG or the joint angles of P[number], in place or as a new position after all others.
void change_fanuc_position(Writer& w, const LineChange& change, int number) {
  const int begin = positions_begin(w.lines);
  int uses = 0, highest = 0, first = 0, last = 0;
  for (int line = 1; line <= w.lines.count(); ++line) {
    const std::string& text = w.lines.at(line);
    for (std::size_t at = find_position(text, 0); at != std::string::npos; at = find_position(text, at + 1)) {
      const int found = position_number(text, at);
      if (line > begin && found == number) first = line;
      if (line < begin && found == number) ++uses;
    }
    if (first > 0 && last == 0 && line >= first && text.find("};") != std::string::npos) last = line;
    // an earlier change may have added a position
    if (line > begin)
      for (const std::string& now : w.lines.written(line))
        if (const std::size_t at = find_position(now, 0); at != std::string::npos)
          highest = std::max(highest, position_number(now, at));
  }
  if (first == 0 || last == 0) refuse(change, fmt::format("P[{}] is not found", number));
  const bool own = uses == 1;
  std::vector<std::string> block;
  int angle = 0;
  for (int line = first; line <= last; ++line) {
    std::string text = w.lines.at(line);
    if (!own && line == first) text = fmt::format("P[{}]{{", highest + 1);
    const std::size_t quote = text.find("CONFIG : '");
    if (change.configuration && quote != std::string::npos) {
      const std::size_t from = quote + 10, to = std::min(text.find('\'', from), text.size());
      const auto& n = change.configuration->numbers;
      text.replace(from, to - from,
                   fmt::format("{} {} {}, {}, {}, {}", n.at(0) ? 'F' : 'N', n.at(1) ? 'U' : 'D', n.at(2) ? 'T' : 'B',
                               n.at(3), n.at(4), n.at(5)));
    }
    for (std::size_t at = text.find("J", 0); !change.joints.empty() && at != std::string::npos;
         at = text.find("J", at + 1)) {
      const std::size_t equals = text.find('=', at);
      if (equals == std::string::npos || at + 2 >= text.size() ||
          !std::isdigit(static_cast<unsigned char>(text[at + 1])))
        continue;
      const auto axis = static_cast<std::size_t>(text[at + 1] - '1');
      const std::size_t unit = text.find("deg", equals);
      if (axis >= change.joints.size() || unit == std::string::npos) continue;
      // Fanuc's J3 is measured from the horizontal: it is axis 3 minus axis 2.
      const double degrees = (change.joints[axis] - (axis == 2 ? change.joints[1] : 0)) / degree;
      text.replace(equals + 1, unit - equals - 1, fmt::format("{:>10.3f} ", degrees));
      ++angle;
    }
    block.push_back(std::move(text));
  }
  if (!change.joints.empty() && angle != 6) refuse(change, fmt::format("P[{}] has not six angles", number));
  if (own) {
    for (int line = first; line <= last; ++line)
      if (block[static_cast<std::size_t>(line - first)] != w.lines.at(line))
        w.lines.now(line) = block[static_cast<std::size_t>(line - first)];
    return;
  }
  for (std::string& text : block) w.lines.behind(last, std::move(text));
  std::string& now = w.lines.now(change.where.line);
  const std::size_t at = find_position(now, behind_number(now));
  now.replace(at, now.find(']', at) + 1 - at, fmt::format("P[{}]", highest + 1));
}

void change_fanuc(Writer& w, const LineChange& change) {
  const Instruction& read = w.instruction(change);
  const int line = change.where.line;
  const std::string old = w.lines.at(line);
  if (!change.point.empty()) refuse(change, "points on the way are not written in listings");
  if (change.configuration || !change.joints.empty()) {
    const std::size_t at = find_position(old, behind_number(old));
    if (at == std::string::npos || read.kind == Instruction::Kind::circular)
      refuse(change, "its target is no P[n] on its line");
    change_fanuc_position(w, change, position_number(old, at));
  }
  if (change.speed) {
    std::string& now = w.lines.now(line);
    const std::size_t behind = now.find(']', find_position(now, behind_number(now)));
    const std::size_t unit = now.find_first_of("%", behind == std::string::npos ? 0 : behind);
    std::size_t end = unit;
    for (const char* word : {"mm/sec", "cm/min", "inch/min", "deg/sec"})
      if (const std::size_t at = now.find(word, behind); at != std::string::npos) end = std::min(end, at);
    std::size_t from = end;
    while (from > behind + 1 && from != std::string::npos &&
           (std::isdigit(static_cast<unsigned char>(now[from - 1])) || now[from - 1] == '.'))
      --from;
    if (end == std::string::npos || from == end)
      refuse(change, "its speed is no number with %, mm/sec, cm/min, inch/min or deg/sec");
    const double value = std::atof(now.substr(from, end - from).c_str());
    now.replace(from, end - from, fmt::format("{:.0f}", std::max(1.0, std::round(value * *change.speed))));
  }
  constexpr std::size_t longest = 32;  // characters in a remark
  w.lines.before(line, fmt::format("{}  !{} ;", old.substr(0, behind_number(old)), change.reason.substr(0, longest)));
}

// ---- INFORM and URScript --------------------------------------------------------------------------------------------

void change_inform(Writer& w, const LineChange& change) {
  if (!change.speed || change.configuration || !change.joints.empty() || !change.point.empty())
    refuse(change, "of a job only speeds are changed");
  const Instruction& read = w.instruction(change);
  const bool axes = read.kind == Instruction::Kind::joint;
  std::string& now = w.lines.now(change.where.line);
  const std::string tag = axes ? " VJ=" : " V=";
  const std::size_t comment = std::min(now.find("//"), now.size());
  const std::size_t at = now.find(tag);
  if (at < comment) {
    const std::size_t from = at + tag.size(), to = std::min(now.find_first_of(" \t", from), now.size());
    const auto number = scaled(std::string_view(now).substr(from, to - from), *change.speed);
    if (!number) refuse(change, "its speed is a variable");
    now.replace(from, to - from, fmt::format("{:.2f}", std::atof(number->c_str())));
  } else if (axes && read.speed.axis_percent) {  // of SPEED
    const std::size_t behind = now.find_first_of(" \t", now.find_first_not_of(" \t", now.find("MOVJ") + 4));
    now.insert(std::min(behind, now.size()), fmt::format(" VJ={:.2f}", *read.speed.axis_percent * *change.speed));
  } else {
    refuse(change, "its speed is not on this line");
  }
  constexpr std::size_t longest = 32;  // characters of a comment
  if (comment == w.lines.at(change.where.line).size()) now += "  //" + change.reason.substr(0, longest);
}

void change_script(Writer& w, const LineChange& change) {
  if (!change.speed || change.configuration || !change.joints.empty() || !change.point.empty())
    refuse(change, "of a script only speeds are changed");
  const std::size_t name = w.begin(change);
  const Instruction& read = w.instruction(change);
  const auto speed = read.kind == Instruction::Kind::joint ? read.speed.axis : read.speed.tool;
  if (!speed) refuse(change, "it has a time instead of a speed");
  int depth = 0, position = 0;
  std::size_t first = 0, last = 0, end = 0;  // tokens of the argument v
  for (std::size_t i = name + 1; i < w.tokens.size() && w.tokens[i].kind != Token::Kind::end; ++i) {
    const std::string_view text = w.tokens[i].text;
    if (text == "(" || text == "[") ++depth;
    if (text == ")" || text == "]") --depth;
    if (depth == 1 && (text == "," || i == name + 1)) {
      position += text == ",";
      const bool option = w.tokens[i + 2].text == "=";
      const bool is_v =
          option ? w.tokens[i + 1].text == "v" : position == (read.kind == Instruction::Kind::circular ? 3 : 2);
      if (is_v) first = i + (option ? 3 : 1);
    }
    if (first > 0 && last == 0 && i >= first &&
        (depth == 0 || (depth == 1 && i + 1 < w.tokens.size() && w.tokens[i + 1].text == ",")))
      last = depth == 0 ? i - 1 : i;
    if (depth == 0) {
      end = i;
      break;
    }
  }
  if (end == 0) refuse(change, "its arguments are not found");
  w.lines.now(w.tokens[end].line) += "  # " + change.reason;
  const std::string value = pipeline::short_decimal(*speed * *change.speed, 6);
  if (first > 0 && last >= first) return w.replace(first, last, value, change);
  w.replace(end, end, fmt::format(", v={})", value), change);
}

}  // namespace

Rewritten rewritten(Language language, const std::string& file, const std::string& bytes, const Program& program,
                    const std::vector<LineChange>& changes, const std::string& shown) {
  const std::string text = decoded_text(bytes), mark(bytes.starts_with(utf8_mark) ? utf8_mark : "");
  if (mark + text != bytes)
    throw pipeline::InputError({file}, "is not plain UTF-8 (another encoding, or no line feeds)",
                               "save it as UTF-8 first");
  Lines lines(shown, text);
  const SourceFile source(file, text);
  Problems problems;
  const TokenRules rules = language == Language::krl        ? TokenRules{';', "$#", true, true}
                           : language == Language::urscript ? TokenRules{'#', "$", true, true}
                                                            : TokenRules{'!', "", false, false};
  const std::vector<Token> tokens = tokens_of(source, rules, problems);
  Writer writer{lines, source, tokens, program};
  for (const LineChange& change : changes) {
    if (change.where.file != file) continue;
    switch (language) {
      case Language::rapid:
        change_rapid(writer, change);
        break;
      case Language::krl:
        change_krl(writer, change);
        break;
      case Language::fanuc:
        change_fanuc(writer, change);
        break;
      case Language::inform:
        change_inform(writer, change);
        break;
      case Language::urscript:
        change_script(writer, change);
        break;
      case Language::joint_columns:
      case Language::ros_trajectory:
        refuse(change, "recorded angles have no lines of their own");
    }
  }
  if (language == Language::fanuc) lines.renumber(1, positions_begin(lines));
  lines.mark(mark);
  return {lines.text(), lines.patch(), lines.numbers()};
}

}  // namespace dresslife::sim
