#include "sim/program/fanuc.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "sim/program/fanuc_parser.h"
#include "sim/program/tokens.h"

namespace dresslife::sim {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double millimetre = 1e-3;

struct Stop {};

/// A number, on or off (1 or 0), or unknown.
using Number = std::optional<double>;

Frame frame_from(const double (&n)[6]) {  // W, P, R about the fixed axes x, y, z
  return {
      millimetre * Vector3(n[0], n[1], n[2]),
      rotation({0, 0, n[5] * degree}) * rotation({0, n[4] * degree, 0}) * rotation({n[3] * degree, 0, 0})};
}

class Run {
 public:
  Run(const std::deque<SourceFile>& files, const std::vector<FanucListing>& listings,
      const ImportOptions& options, const std::vector<NamedFrame>& tools,
      const std::vector<NamedFrame>& objects, Program& program, Problems& problems)
      : files_(files),
        listings_(listings),
        options_(options),
        tools_(tools),
        objects_(objects),
        program_(program),
        problems_(problems) {}

  void run(const FanucListing& listing) {
    try {
      call(listing);
    } catch (const Stop&) {
    }
  }

 private:
  struct Loop {
    std::size_t begin;  // of the FOR
    int register_number;
    double last, step;
  };
  struct Routine {
    const FanucListing* listing;
    std::size_t at = 0;
    std::vector<Loop> loops;
    Number selected;
    bool select_open = false;
    std::set<std::size_t> decided;  // statements that branched on known values
  };

  void call(const FanucListing& listing) {
    if (static_cast<int>(routines_.size()) >= ImportLimits::calls) {
      complain(fmt::format("calls {} programs deep (without end?)", ImportLimits::calls),
               "mend the recursion");
      throw Stop{};
    }
    routines_.push_back({&listing, 0, {}, {}, false, {}});
    while (routines_.back().at < listing.statements.size()) {
      charge();
      const std::size_t before = routines_.back().at;
      execute(listing.statements[before]);
      if (routines_.back().at == before) ++routines_.back().at;
      if (problems_.full()) throw Stop{};
    }
    routines_.pop_back();
  }

  Routine& routine() { return routines_.back(); }
  const FanucStatement& statement() const {
    const Routine& r = routines_.back();
    return r.listing->statements[std::min(r.at, r.listing->statements.size() - 1)];
  }
  pipeline::Where where() const {
    const Routine& r = routines_.back();
    if (r.listing->statements.empty()) return {files_[r.listing->file].name(), 1, 1};
    return {files_[r.listing->file].name(), statement().line, statement().column};
  }
  void complain(const std::string& what, const std::string& remedy) { problems_.add(where(), what, remedy); }
  void note(const std::string& what, bool may_move = false) {
    const pipeline::Where at = where();
    for (const Skipped& s : program_.skipped)
      if (s.where.line == at.line && s.where.file == at.file) return;
    if (program_.skipped.size() < ImportLimits::skipped) program_.skipped.push_back({at, what, may_move});
  }
  void charge() {
    if (++executed_ <= ImportLimits::executed) return;
    complain(fmt::format("is still running after {} statements (a loop that input would end?)",
                         ImportLimits::executed),
             "decide the loop's IF with --assume LINE=then or =else");
    throw Stop{};
  }

  void execute(const FanucStatement& s);
  bool execute_logic(FanucCursor& at, const std::string& word);
  void if_statement(FanucCursor& at);
  void select(FanucCursor& at, bool first);
  void for_statement(FanucCursor& at);
  void end_for();
  void action(FanucCursor& at, const std::string& word);
  void jump(FanucCursor& at, bool certain);
  void call_statement(FanucCursor& at);
  void wait(FanucCursor& at);
  void assign_register(FanucCursor& at);
  void assign_position(FanucCursor& at);
  std::size_t matching(std::size_t from, const char* opening, const char* middle, const char* closing) const;
  bool moves_between(std::size_t from, std::size_t to) const;
  bool moves(const FanucListing& listing, int depth) const;
  std::optional<bool> assumed() const;

  Number expression(FanucCursor& at, int depth = 0);
  Number term(FanucCursor& at, int depth);
  Number value(FanucCursor& at, int depth);
  std::optional<bool> condition(FanucCursor& at, int depth = 0);
  std::optional<bool> relation(FanucCursor& at, int depth);

  void move(FanucCursor& at, Instruction::Kind kind);
  bool read_position(FanucCursor& at, Instruction& move, Target& target, bool frames);
  bool read_speed(FanucCursor& at, Instruction& move);
  void read_options(FanucCursor& at, Instruction& move);
  bool read_frame(int number, bool tool, Instruction& move);
  std::optional<FanucPosition> position(FanucCursor& at);
  void emit(const Instruction& instruction);

  const std::deque<SourceFile>& files_;
  const std::vector<FanucListing>& listings_;
  const ImportOptions& options_;
  const std::vector<NamedFrame>& tools_;
  const std::vector<NamedFrame>& objects_;
  Program& program_;
  Problems& problems_;
  std::vector<Routine> routines_;
  std::map<int, double> registers_;
  std::map<int, FanucPosition> position_registers_;
  std::map<std::pair<bool, int>, Frame> frames_;  // (tool?, number), assigned by the program
  int frame_ = 0, tool_ = 0;
  double override_ = 1;
  long executed_ = 0;
};

// ---- values ----------------------------------------------------------------------------------------------

Number Run::value(FanucCursor& at, int depth) {
  if (depth > ImportLimits::nesting) return {};
  if (at.take_sign('(')) {
    const Number inner = expression(at, depth + 1);
    at.take_sign(')');
    return inner;
  }
  if (at.take_sign('-')) {
    const Number inner = value(at, depth + 1);
    return inner ? Number(-*inner) : inner;
  }
  if (const Number number = at.number()) return number;
  const std::string word = at.word();
  if (word == "on") return 1;
  if (word == "off") return 0;
  if (!at.take_sign('[')) return {};
  const Number index = expression(at, depth + 1);
  if (at.take_sign(',')) {
    const Number part = expression(at, depth + 1);
    at.take_sign(']');
    if (word != "pr" || !index || !part) return {};
    const auto found = position_registers_.find(static_cast<int>(std::clamp(*index, 0.0, 1e6)));
    if (found == position_registers_.end() || !(*part >= 1 && *part <= 6)) return {};
    const std::size_t which = static_cast<std::size_t>(*part) - 1;
    const auto& joints = found->second.joints;
    if (joints.empty()) return found->second.pose[which];
    return which < joints.size() ? Number(joints[which]) : Number{};
  }
  while (!at.at_end() && !at.take_sign(']')) at.move_to(at.offset() + 1);  // ": comment]"
  if (word != "r" || !index) return {};
  const auto found = registers_.find(static_cast<int>(std::clamp(*index, 0.0, 1e6)));
  return found == registers_.end() ? Number{} : Number(found->second);
}

Number Run::term(FanucCursor& at, int depth) {
  Number left = value(at, depth);
  while (true) {
    charge();
    char op = 0;
    if (at.take_sign('*'))
      op = '*';
    else if (at.take_sign('/'))
      op = '/';
    else if (at.take("DIV"))
      op = 'd';
    else if (at.take("MOD"))
      op = 'm';
    else
      return left;
    const Number right = value(at, depth);
    if (!left || !right) {
      left.reset();
      continue;
    }
    double result = NAN;
    if (op == '*') result = *left * *right;
    if (op == '/') result = *left / *right;
    if (op == 'd') result = std::trunc(*left / *right);
    if (op == 'm') result = std::fmod(*left, *right);
    left = std::isfinite(result) ? Number(result) : Number{};
  }
}

Number Run::expression(FanucCursor& at, int depth) {
  if (depth > ImportLimits::nesting) return {};
  Number left = term(at, depth);
  while (true) {
    charge();
    const bool plus = at.take_sign('+');
    if (!plus && !at.take_sign('-')) return left;
    const Number right = term(at, depth);
    left = left && right ? Number(plus ? *left + *right : *left - *right) : Number{};
  }
}

std::optional<bool> Run::relation(FanucCursor& at, int depth) {
  if (depth > ImportLimits::nesting) return {};
  if (at.take_sign('!')) {
    const auto inner = relation(at, depth + 1);
    return inner ? std::optional(!*inner) : inner;
  }
  const std::size_t begin = at.offset();
  if (at.take_sign('(')) {  // of a condition or of a number
    const auto inner = condition(at, depth + 1);
    if (at.take_sign(')') && !at.take_sign('=') && !at.take_sign('<') && !at.take_sign('>')) return inner;
    at.move_to(begin);
  }
  const Number left = expression(at, depth + 1);
  const bool less = at.take_sign('<'), greater = at.take_sign('>'), equal = at.take_sign('=');
  if (!less && !greater && !equal) return left ? std::optional(*left != 0) : std::nullopt;
  const Number right = expression(at, depth + 1);
  if (!left || !right) return {};
  return (less && *left < *right) || (greater && *left > *right) || (equal && *left == *right);
}

std::optional<bool> Run::condition(FanucCursor& at, int depth) {
  std::optional<bool> result = relation(at, depth);
  while (true) {
    charge();
    const bool both = at.take("AND");
    if (!both && !at.take("OR")) return result;
    const auto right = relation(at, depth);
    const bool deciding = !both;  // either side can be enough
    if ((result && *result == deciding) || (right && *right == deciding))
      result = deciding;
    else if (!result || !right)
      result.reset();
    else
      result = both;
  }
}

// ---- statements ------------------------------------------------------------------------------------------

std::optional<bool> Run::assumed() const {
  const pipeline::Where at = where();
  const std::string file = at.file.substr(at.file.find_last_of('/') + 1);
  for (const std::string& key : {fmt::format("{}:{}", at.file, at.line), fmt::format("{}:{}", file, at.line),
                                 fmt::format("{}", at.line)})
    if (const auto found = options_.assume.find(key); found != options_.assume.end())
      return found->second == Assumption::then_branch;
  return {};
}

void Run::emit(const Instruction& instruction) {
  if (program_.instructions.size() >= ImportLimits::instructions) {
    complain(fmt::format("would be move {} (no more are allowed)", ImportLimits::instructions + 1),
             "simulate a shorter part");
    throw Stop{};
  }
  program_.instructions.push_back(instruction);
  Instruction& added = program_.instructions.back();
  added.where = where();
  added.routine = routine().listing->name;
  added.text = files_[routine().listing->file].line(statement().line);
}

void Run::execute(const FanucStatement& s) {
  FanucCursor at(s.text);
  if (s.text.starts_with("!") || s.text.starts_with("--") || s.text.starts_with("//")) return;
  if (at.take("J")) return move(at, Instruction::Kind::joint);
  if (at.take("L")) return move(at, Instruction::Kind::linear);
  if (at.take("C")) return move(at, Instruction::Kind::circular);
  if (at.take("A")) {
    note("an arc by A moves: read as straight lines", true);
    return move(at, Instruction::Kind::linear);
  }
  if (at.take_sign('=')) return select(at, false);
  const std::string word = at.word();
  if (word == "else" && at.take_sign(',')) return select(at, false);
  if (word != "select") routine().select_open = false;
  if (word == "if") return if_statement(at);
  if (word == "select") return select(at, true);
  if (word == "lbl" || word.empty()) return;
  if (execute_logic(at, word)) return;
  action(at, word);
}

/// Loops and blocks. False: something else.
bool Run::execute_logic(FanucCursor& at, const std::string& word) {
  if (word == "for")
    for_statement(at);
  else if (word == "endfor")
    end_for();
  else if (word == "else")
    routine().at = matching(routine().at + 1, "IF", nullptr, "ENDIF") + 1;  // behind the arm that ran
  else if (word == "end")
    routine().at = routine().listing->statements.size();
  else if (word != "endif")
    return false;
  return true;
}

void Run::action(FanucCursor& at, const std::string& word) {
  const auto indexed = [&]() -> Number {
    if (!at.take_sign('[')) return {};
    const Number index = expression(at);
    while (!at.at_end() && !at.take_sign(']')) at.move_to(at.offset() + 1);
    return index;
  };
  const auto assigned = [&]() -> Number { return at.take_sign('=') ? expression(at) : Number{}; };
  if (word == "jmp") return jump(at, true);
  if (word == "call" || word == "run") return call_statement(at);
  if (word == "wait") return wait(at);
  if (word == "r") return assign_register(at);
  if (word == "pr") return assign_position(at);
  if (word == "uframe_num" || word == "utool_num") {
    const Number number = assigned();
    if (!number)
      complain("sets a frame by a number that is known only while the robot runs", "write it as a constant");
    else
      (word == "utool_num" ? tool_ : frame_) = static_cast<int>(std::clamp(*number, 0.0, 1e6));
  } else if (word == "uframe" || word == "utool") {
    const Number index = indexed();
    at.take_sign('=');
    const auto read = position(at);
    if (index && read && read->joints.empty())
      frames_[{word == "utool", static_cast<int>(std::clamp(*index, 0.0, 1e6))}] = frame_from(read->pose);
    else
      complain("sets a frame to what is known only while the robot runs",
               "give the frame as a constant PR or in motion.tools");
  } else if (word == "override") {
    const Number percent = assigned();
    if (percent && *percent > 0 && *percent <= 100)
      override_ = *percent / 100;
    else
      complain("OVERRIDE is no known number in 0 .. 100 %", "write it as a constant");
  } else if (word == "spot") {
    Instruction weld;
    weld.kind = Instruction::Kind::dwell;
    weld.dwell = options_.spot_time;
    emit(weld);
  } else if (word == "abort") {
    throw Stop{};
  } else {
    note(word + ": input, output or logic");
  }
}

void Run::jump(FanucCursor& at, bool certain) {
  if (!at.take("LBL") || !at.take_sign('[')) return complain("jumps to no LBL[n]", "mend the statement");
  const Number number = expression(at);
  if (!number)
    return complain("jumps to a label that is known only while the robot runs", "write its number");
  const auto& statements = routine().listing->statements;
  for (std::size_t i = 0; i < statements.size(); ++i) {
    FanucCursor label(statements[i].text);
    if (!label.take("LBL") || !label.take_sign('[') || label.number() != number) continue;
    const std::size_t here = routine().at;
    if (certain && i <= here) {
      // Nothing that the program knows ends this loop: the motion is one pass.
      const auto decision = routine().decided.lower_bound(i);
      if (decision == routine().decided.end() || *decision > here) {
        note("repeats for ever: the motion is one pass");
        throw Stop{};
      }
    }
    executed_ += static_cast<long>(statements.size() / 16);
    routine().at = i + 1;
    return;
  }
  complain(fmt::format("jumps to LBL[{}], which is not there", *number), "mend the label");
}

void Run::call_statement(FanucCursor& at) {
  const std::string name = at.word();
  for (const FanucListing& listing : listings_)
    if (listing.name == name) {
      call(listing);
      return;
    }
  note(fmt::format("CALL {}: not among the files read", name), true);
}

void Run::wait(FanucCursor& at) {
  const std::size_t begin = at.offset();
  Number time = at.number();
  if (!time) {
    at.move_to(begin);
    if (at.take("R")) {
      at.move_to(begin);
      time = value(at, 0);
      if (!time)
        return complain("waits for a time that is known only while the robot runs", "write it as a constant");
    }
  }
  if (!time) return note("WAIT for input");
  if (*time <= 0) return;
  Instruction wait;
  wait.kind = Instruction::Kind::dwell;
  wait.dwell = *time;
  emit(wait);
}

void Run::assign_register(FanucCursor& at) {
  Number index;
  if (at.take_sign('[')) index = expression(at);
  while (!at.at_end() && !at.take_sign('=')) at.move_to(at.offset() + 1);
  const Number value = expression(at);
  if (!index) return note("a register that is known only while the robot runs");
  const int number = static_cast<int>(std::clamp(*index, 0.0, 1e6));
  if (value && std::isfinite(*value))
    registers_[number] = *value;
  else
    registers_.erase(number);
}

void Run::assign_position(FanucCursor& at) {
  Number index, part;
  if (at.take_sign('[')) index = expression(at);
  if (at.take_sign(',')) part = expression(at);
  while (!at.at_end() && !at.take_sign('=')) at.move_to(at.offset() + 1);
  if (!index) return note("a position register that is known only while the robot runs");
  const int number = static_cast<int>(std::clamp(*index, 0.0, 1e6));
  if (part) {
    const Number value = expression(at);
    FanucPosition& read = position_registers_[number];
    if (value && *part >= 1 && *part <= 6 && read.joints.empty())
      read.pose[static_cast<int>(*part) - 1] = *value;
    else
      position_registers_.erase(number);
    return;
  }
  if (auto read = position(at))
    position_registers_[number] = *read;
  else
    position_registers_.erase(number);
}

// ---- branches and loops ----------------------------------------------------------------------------------

/// Index of the statement that closes (or, with `middle`, parts) the block whose inside begins at `from`.
std::size_t Run::matching(std::size_t from, const char* opening, const char* middle,
                          const char* closing) const {
  const auto& statements = routines_.back().listing->statements;
  int depth = 0;
  for (std::size_t i = from; i < statements.size(); ++i) {
    FanucCursor at(statements[i].text);
    if (at.take(opening)) {
      depth += std::string_view(opening) == "FOR" || lower_case(statements[i].text).ends_with("then");
    } else if (at.take(closing)) {
      if (depth-- == 0) return i;
    } else if (depth == 0 && middle && at.take(middle)) {
      return i;
    }
  }
  return statements.size();
}

bool Run::moves(const FanucListing& listing, int depth) const {
  if (depth > 8) return true;
  for (const FanucStatement& s : listing.statements) {
    FanucCursor at(s.text);
    if (at.take("J") || at.take("L") || at.take("C") || at.take("A") || at.take("WAIT") || at.take("SPOT"))
      return true;
    if (!at.take("CALL")) continue;
    const std::string name = at.word();
    for (const FanucListing& other : listings_)
      if (other.name == name && moves(other, depth + 1)) return true;
  }
  return false;
}

bool Run::moves_between(std::size_t from, std::size_t to) const {
  FanucListing part;
  const auto& statements = routines_.back().listing->statements;
  for (std::size_t i = from; i < std::min(to, statements.size()); ++i) {
    part.statements.push_back(statements[i]);
    FanucCursor at(statements[i].text);
    if (at.take("JMP") || at.take("END") || at.take("IF")) return true;
  }
  return moves(part, 0);
}

void Run::if_statement(FanucCursor& at) {
  const std::size_t here = routine().at;
  std::optional<bool> decision = condition(at);
  if (decision) routine().decided.insert(here);
  if (const auto told = assumed()) decision = told;
  const bool block = at.take("THEN");
  at.take_sign(',');
  if (block) {
    const std::size_t other = matching(here + 1, "IF", "ELSE", "ENDIF"),
                      end = matching(here + 1, "IF", nullptr, "ENDIF");
    executed_ += static_cast<long>((end - here) / 16);
    if (!decision) {
      if (moves_between(here + 1, end))
        complain("branches on what is known only while the robot runs",
                 fmt::format("choose with --assume {}:{}=then or =else (motion.assume in a job)",
                             where().file.substr(where().file.find_last_of('/') + 1), where().line));
      else
        note("a branch on what is known only while the robot runs, without moves");
      routine().at = end;
    } else if (!*decision) {
      routine().at = other + 1;
    }
    return;
  }
  FanucCursor peek = at;
  const std::string word = peek.word();
  if (!decision) {
    const bool leads = word == "jmp" || word == "call" || word == "end";
    if (leads)
      complain("branches on what is known only while the robot runs",
               fmt::format("choose with --assume {}:{}=then or =else (motion.assume in a job)",
                           where().file.substr(where().file.find_last_of('/') + 1), where().line));
    else
      note("a branch on what is known only while the robot runs, without moves");
    return;
  }
  if (!*decision) return;
  at = peek;
  if (word == "jmp")
    jump(at, false);
  else if (word == "end")
    routine().at = routine().listing->statements.size();
  else
    action(at, word);
}

/// SELECT R[1]=1,JMP LBL[1]; =2,CALL X; ELSE,JMP LBL[3]: one statement or several.
void Run::select(FanucCursor& at, bool first) {
  if (first) {
    routine().selected = value(at, 0);
    routine().select_open = true;
    at.take_sign('=');
  }
  if (!routine().select_open) return;
  const bool otherwise = !first && statement().text.starts_with("ELSE");
  const Number case_value = otherwise ? Number{} : expression(at);
  std::optional<bool> decision = otherwise;
  if (!otherwise)
    decision =
        routine().selected && case_value ? std::optional(*routine().selected == *case_value) : std::nullopt;
  if (const auto told = assumed()) decision = told;
  at.take_sign(',');
  const std::string word = at.word();
  if (!decision) {
    complain("selects by what is known only while the robot runs",
             fmt::format("choose with --assume {}:{}=then or =else (motion.assume in a job)",
                         where().file.substr(where().file.find_last_of('/') + 1), where().line));
    return;
  }
  if (!*decision) return;
  routine().select_open = false;
  if (word == "jmp")
    jump(at, false);
  else
    action(at, word);
}

void Run::for_statement(FanucCursor& at) {
  const std::size_t here = routine().at, end = matching(here + 1, "FOR", nullptr, "ENDFOR");
  executed_ += static_cast<long>((end - here) / 16);
  Number index;
  if (at.take("R") && at.take_sign('[')) index = expression(at);
  while (!at.at_end() && !at.take_sign('=')) at.move_to(at.offset() + 1);
  const Number from = expression(at);
  const bool down = at.take("DOWNTO");
  if (!down) at.take("TO");
  const Number to = expression(at);
  if (!index || !from || !to) {
    if (moves_between(here + 1, end))
      complain("counts to what is known only while the robot runs",
               "write the bounds of the FOR as constants");
    routine().at = end + 1;
    return;
  }
  const int number = static_cast<int>(std::clamp(*index, 0.0, 1e6));
  registers_[number] = *from;
  if (down ? *from < *to : *from > *to) {
    routine().at = end + 1;
    return;
  }
  if (routine().loops.size() < 100) routine().loops.push_back({here, number, *to, down ? -1.0 : 1.0});
}

void Run::end_for() {
  if (routine().loops.empty()) return complain("has no FOR", "write it, or remove ENDFOR");
  const Loop& loop = routine().loops.back();
  const auto counter = registers_.find(loop.register_number);
  if (counter == registers_.end()) {
    routine().loops.pop_back();
    return complain("ends a FOR whose register has become unknown", "leave the register alone in the loop");
  }
  counter->second += loop.step;
  if (loop.step > 0 ? counter->second <= loop.last : counter->second >= loop.last)
    routine().at = loop.begin + 1;
  else
    routine().loops.pop_back();
}

// ---- moves -----------------------------------------------------------------------------------------------

/// P[3:name] or PR[4], also as an operand of an assignment. Absent: not there or not known.
std::optional<FanucPosition> Run::position(FanucCursor& at) {
  const bool registered = at.take("PR");
  if (!registered && !at.take("P")) return {};
  if (!at.take_sign('[')) return {};
  const Number index = expression(at);
  while (!at.at_end() && !at.take_sign(']')) at.move_to(at.offset() + 1);
  if (!index) return {};
  const auto& list = registered ? position_registers_ : routine().listing->positions;
  const auto found = list.find(static_cast<int>(std::clamp(*index, 0.0, 1e6)));
  if (found == list.end()) return {};
  FanucPosition read = found->second;
  if (registered) read.frame = read.tool = -1;
  return read;
}

bool Run::read_frame(int number, bool tool, Instruction& move) {
  if (number < 0) number = tool ? tool_ : frame_;
  if (number == 0) return true;
  NamedFrame frame{fmt::format("{}[{}]", tool ? "UTOOL" : "UFRAME", number), {}, false};
  if (const auto own = frames_.find({tool, number}); own != frames_.end()) {
    frame.frame = own->second;
  } else {
    const auto& given = tool ? tools_ : objects_;
    const auto known = std::find_if(given.begin(), given.end(),
                                    [&](const NamedFrame& f) { return same_word(f.name, frame.name); });
    if (known == given.end()) {
      complain(fmt::format("uses {}, which lies in the controller", frame.name),
               fmt::format("give it in motion.{} (--frames of dresslife import) with the name '{}'",
                           tool ? "tools" : "work_objects", frame.name));
      return false;
    }
    frame = *known;
  }
  auto& list = tool ? program_.tools : program_.work_objects;
  int& index = tool ? move.tool : move.work_object;
  for (std::size_t i = 0; i < list.size(); ++i)
    if (list[i].name == frame.name && list[i].frame.position == frame.frame.position &&
        list[i].frame.orientation.coeffs() == frame.frame.orientation.coeffs())
      index = static_cast<int>(i);
  if (index >= 0) return true;
  for (int variant = 2;
       std::any_of(list.begin(), list.end(), [&](const NamedFrame& f) { return f.name == frame.name; });
       ++variant)
    frame.name = fmt::format("{}[{}] ({})", tool ? "UTOOL" : "UFRAME", number, variant);
  list.push_back(frame);
  index = static_cast<int>(list.size()) - 1;
  executed_ += static_cast<long>(list.size());
  return true;
}

bool Run::read_position(FanucCursor& at, Instruction& move, Target& target, bool frames) {
  const auto read = position(at);
  if (!read) {
    complain("moves to a position that is not listed",
             "list the program with its positions, or assign the PR a constant");
    return false;
  }
  target.external_axes = read->external_axes;
  if (!read->joints.empty()) {
    for (double angle : read->joints) target.joints.push_back(angle * degree);
    if (target.joints.size() >= 3) target.joints[2] += target.joints[1];  // q3 = J3 + J2
    return true;
  }
  target.pose = frame_from(read->pose);
  target.configuration = read->configuration;
  return !frames || (read_frame(read->frame, false, move) && read_frame(read->tool, true, move));
}

bool Run::read_speed(FanucCursor& at, Instruction& move) {
  const std::size_t begin = at.offset();
  const bool from_register = at.take("R");
  at.move_to(begin);
  if (at.take("max_speed")) return true;
  const Number speed = value(at, 0);
  if (!speed || !(*speed > 0)) {
    complain(from_register ? "has a speed that is known only while the robot runs" : "has no speed above 0",
             "write it as a constant");
    return false;
  }
  if (at.take_sign('%'))
    move.speed.axis_percent = std::min(*speed, 100.0) * override_;
  else if (at.take("mm/sec"))
    move.speed.tool = *speed * millimetre * override_;
  else if (at.take("cm/min"))
    move.speed.tool = *speed * 0.01 / 60 * override_;
  else if (at.take("inch/min"))
    move.speed.tool = *speed * 0.0254 / 60 * override_;
  else if (at.take("deg/sec"))
    move.speed.orientation = *speed * degree * override_;
  else if (at.take("msec"))
    move.speed.duration = *speed * 1e-3 / override_;
  else if (at.take("sec"))
    move.speed.duration = *speed / override_;
  else {
    complain("has a speed without a known unit", "write %, mm/sec, cm/min, inch/min, deg/sec or sec");
    return false;
  }
  return true;
}

void Run::read_options(FanucCursor& at, Instruction& move) {
  while (!at.at_end()) {
    charge();
    at.take_sign(',');
    at.take_sign(':');
    if (at.take("FINE"))
      move.zone = {};
    else if (at.take("CNT"))
      move.zone.percent = std::clamp(value(at, 0).value_or(100), 0.0, 100.0);
    else if (at.take("CD"))
      move.zone.distance = std::max(0.0, value(at, 0).value_or(0)) * millimetre;
    else if (at.take("ACC"))
      move.acceleration_percent = std::clamp(value(at, 0).value_or(100), 1.0, 150.0);
    else if (at.take("OFFSET")) {
      at.take_sign(',');
      if (const auto by = position(at))
        move.target.pose = frame_from(by->pose) * move.target.pose;
      else
        complain("is offset by what is known only while the robot runs", "assign the PR a constant");
    } else if (at.take("TOOL_OFFSET")) {
      at.take_sign(',');
      if (const auto by = position(at))
        move.target.pose = move.target.pose * frame_from(by->pose);
      else
        complain("is offset by what is known only while the robot runs", "assign the PR a constant");
    } else if (at.take("INC")) {
      complain("is an incremental move", "write the target itself");
      return;
    } else if (at.take("SKIP")) {
      note("SKIP: the move goes to its end");
      return;
    } else if (at.word().empty()) {
      at.move_to(at.offset() + 1);
    }
  }
}

void Run::move(FanucCursor& at, Instruction::Kind kind) {
  Instruction move;
  move.kind = kind;
  Target first;
  if (kind == Instruction::Kind::circular) {
    if (!read_position(at, move, first, false)) return;
    at.take_sign(':');
  }
  if (!read_position(at, move, move.target, true)) return;
  move.via = first.pose;
  if (kind != Instruction::Kind::joint && (!first.joints.empty() || !move.target.joints.empty()) &&
      kind == Instruction::Kind::circular) {
    complain("is an arc through joint angles", "teach its points in Cartesian form");
    return;
  }
  if (!read_speed(at, move)) return;
  const bool spot = lower_case(at.rest()).find("spot[") != std::string::npos;
  read_options(at, move);
  emit(move);
  if (!spot) return;
  Instruction weld;
  weld.kind = Instruction::Kind::dwell;
  weld.dwell = options_.spot_time;
  emit(weld);
}

}  // namespace

void read_fanuc(const std::deque<SourceFile>& files, const ImportOptions& options,
                const std::vector<NamedFrame>& tools, const std::vector<NamedFrame>& work_objects,
                Program& program, Problems& problems) {
  std::vector<FanucListing> listings;
  for (std::size_t i = 0; i < files.size(); ++i)
    listings.push_back(parse_fanuc(files[i], static_cast<int>(i), problems));
  if (!problems.empty() || listings.empty()) return;
  const FanucListing* start = &listings[0];
  if (!options.routine.empty()) {
    start = nullptr;
    for (const FanucListing& listing : listings)
      if (listing.name == lower_case(options.routine)) start = &listing;
    if (!start)
      return problems.add({files[0].name(), 1, 1}, fmt::format("is not the program '{}'", options.routine),
                          "give the listing of that program");
  }
  Run(files, listings, options, tools, work_objects, program, problems).run(*start);
}

}  // namespace dresslife::sim
