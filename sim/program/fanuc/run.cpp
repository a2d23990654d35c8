#include "sim/program/fanuc/run.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>
#include <utility>

#include "pipeline/base/joined.h"
#include "sim/program/interpreter/job_words.h"
#include "sim/program/interpreter/tokens.h"

namespace dresslife::sim {
namespace {

/// Returns the unit [s] of a time "0.50(sec)" from the text behind its number; std::nullopt: another text.
std::optional<double> fanuc_unit_of_time(std::string_view text) {
  std::string unit;
  for (const char c : lower_case(text))
    if (c != '(' && c != ')' && static_cast<unsigned char>(c) > ' ') unit += c;
  if (unit.empty() || unit == "sec" || unit == "sek" || unit == "s") return 1;
  if (unit == "msec" || unit == "msek" || unit == "ms") return 1e-3;
  return {};
}

std::string file_of(const std::string& path) { return path.substr(path.find_last_of('/') + 1); }

/// Returns the names of the values that differ between two texts of FanucValues::deciding_state().
std::string changed_names(const std::string& before, const std::string& after) {
  std::string names;
  std::istringstream entries(after);
  for (std::string entry; entries >> entry;)
    if ((" " + before).find(" " + entry + " ") == std::string::npos)
      names += (names.empty() ? "" : ", ") + entry.substr(0, entry.find('='));
  return names.empty() ? "a value" : names;
}

}  // namespace

FanucRun::FanucRun(const Surroundings& around, Program& program, Problems& problems, Exploration& exploration)
    : around_(around),
      program_(program),
      problems_(problems),
      exploration_(exploration),
      values_(around.variables, around.options.values, problems),
      outlook_(around.listings, around.variables.macros) {}

void FanucRun::run(const FanucListing& listing, const std::string& arguments) {
  FanucCursor at(arguments);
  try {
    call(listing, arguments_in(at));
  } catch (const Stop&) {
  }
  exploration_.spend(executed_ + values_.charged());
  const pipeline::Where begin{around_.files[listing.file].name(), 1, 1};
  const auto note_unused = [&](const std::string& line) {
    if (!used_lines_.contains(line)) program_.skipped.push_back({begin, unused_assumption(line), true});
  };
  for (const auto& [line, assumption] : around_.options.assume) note_unused(line);
  for (const auto& [line, chosen] : around_.options.choose) note_unused(line);
  for (const std::string& name : values_.unused()) program_.skipped.push_back({begin, unused_value(name), true});
}

// ---- words -----------------------------------------------------------------------------------------------

const FanucStatement& FanucRun::statement() const {
  const Routine& r = routines_.back();
  return r.listing->statements[std::min(r.at, r.listing->statements.size() - 1)];
}

pipeline::Where FanucRun::where() const {
  return {around_.files[routines_.back().listing->file].name(), statement().line, statement().column};
}

std::string FanucRun::line_name() const { return fmt::format("{}:{}", file_of(where().file), where().line); }

/// Returns the name of the running program in capitals.
std::string FanucRun::program_name() const { return upper_case(routines_.back().listing->name); }

void FanucRun::complain(const std::string& what, const std::string& remedy) {
  if (!exploration_.guessing()) problems_.add(where(), what, remedy, program_name());
}

bool FanucRun::refuse(const std::string& what, const std::string& remedy) {
  complain(what, remedy);
  return false;
}

void FanucRun::missing(const std::string& name, const std::string& what, const std::string& remedy,
                       std::vector<Question> questions, bool decision) {
  if (questions.empty() && exploration_.guessing()) return;
  for (const Question& question : questions) exploration_.meet_question(question.name);
  problems_.add_use({.where = where(),
                     .what = what,
                     .remedy = remedy,
                     .about = name,
                     .decision = decision,
                     .routine = program_name(),
                     .questions = std::move(questions),
                     .certain = !exploration_.guessing()});
}

namespace {

std::string form_of(const std::string& name) {
  if (name.starts_with("PR[") && name.find(',') == std::string::npos)
    return "X .. Y .. Z .. W .. P .. R .. in mm and deg, or J1 .. J2 .. J3 .. J4 .. J5 .. J6 ..";
  if (name.find(' ') != std::string::npos) return "nothing, or the registers that it sets: R[5]=3 R[6]=0";
  for (const char* signal : {"DI[", "DO[", "RI[", "RO[", "UI[", "UO[", "SI[", "SO[", "WI[", "WO[", "F[", "M["})
    if (name.starts_with(signal)) return "ON or OFF";
  return "a number";
}

/// Returns the names of all causes: "DI[3] and R[5]".
std::string names_in(const FanucCauses& causes) {
  std::string names;
  for (const FanucCause& cause : causes)
    if (const bool call = cause.name.find(' ') != std::string::npos; !cause.name.empty())
      names += fmt::format("{}{}{}", names.empty() ? "" : " and ", call ? "a register behind " : "", cause.name);
  return names;
}

std::string options_for(const FanucCauses& causes) {
  std::vector<std::string> names;
  for (const FanucCause& cause : causes)
    if (!cause.name.empty()) names.push_back(cause.name);
  return values_of_job(names);
}

}  // namespace

/// Returns the questions for the causes of an unknown value: the name of a cause, or the left-out branch of a cause
/// without a name.
std::vector<Question> FanucRun::questions_for(const FanucCauses& causes) {
  std::vector<Question> questions;
  for (const FanucCause& cause : causes) {
    if (!cause.line.empty()) exploration_.follow(cause.line);
    if (!cause.name.empty())
      questions.push_back({Question::Kind::value, cause.name, form_of(cause.name)});
    else if (!cause.line.empty())
      questions.push_back({Question::Kind::branch, cause.line, "then or else"});
  }
  return questions;
}

/// Asks for the causes of an unknown value (values_.causes()) that the statement needs.
void FanucRun::missing_value(const std::string& what) {
  const FanucCauses& causes = values_.causes();
  const std::vector<Question> questions = questions_for(causes);
  const std::string names = names_in(causes), name = causes.empty() ? "" : causes[0].name;
  if (questions.empty())
    return missing("a value", fmt::format("{} a value, which is known only while the robot runs", what),
                   "write it as a constant", {});
  missing(names, fmt::format("{} {}, which is known only while the robot runs", what, names),
          fmt::format("give it with {}{}", options_for(causes),
                      name.starts_with("PR")   ? ", or posreg.va of the backup"
                      : name.starts_with("R[") ? ", or numreg.va of the backup"
                                               : ""),
          questions);
}

void FanucRun::note(const std::string& what, bool may_move) {
  const pipeline::Where at = where();
  if (!noted_.insert(fmt::format("{}:{} {}", at.file, at.line, what)).second) return;
  if (program_.skipped.size() < ImportLimits::skipped) program_.skipped.push_back({at, what, may_move});
}

void FanucRun::charge(long steps) {
  executed_ += steps;
  if (exploration_.guessing() && executed_ - guessed_at_ > ImportLimits::guessed) throw Stop{};
  if (executed_ + values_.charged() <= ImportLimits::executed) return;
  const pipeline::Where at = last_jump_.line > 0 ? last_jump_ : where();
  const std::string end = last_decision_.line > 0
                              ? assume_of_job(fmt::format("{}:{}", file_of(last_decision_.file), last_decision_.line))
                              : "a statement that leaves it";
  if (!exploration_.guessing())
    problems_.add(at, fmt::format("goes back again and again: {} statements and no end", ImportLimits::executed),
                  fmt::format("decide what ends the loop: {}, or motion.values with what it depends on", end));
  throw Stop{};
}

std::optional<bool> FanucRun::assumed(int line) {
  const std::string file = where().file;
  for (const std::string& key :
       {fmt::format("{}:{}", file, line), fmt::format("{}:{}", file_of(file), line), fmt::format("{}", line)})
    if (const auto found = around_.options.assume.find(key); found != around_.options.assume.end()) {
      used_lines_.insert(key);
      return found->second == Assumption::then_branch;
    }
  return {};
}

// ---- programs --------------------------------------------------------------------------------------------

void FanucRun::call(const FanucListing& listing, std::vector<FanucValues::Stored> arguments) {
  if (static_cast<int>(routines_.size()) >= ImportLimits::calls) {
    complain(fmt::format("calls {} programs deep (without end?)", ImportLimits::calls), "correct the recursion");
    throw Stop{};
  }
  if (const Problems& parsing = around_.parsing[listing.file]; !parsing.empty()) {
    if (!exploration_.guessing())
      for (const Problem& problem : parsing.list()) problems_.add(problem.where, problem.what, problem.remedy);
    throw Stop{};
  }
  routines_.push_back({&listing, 0, {}, {}});
  values_.enter(std::move(arguments));
  while (routine().at < listing.statements.size()) {
    charge();
    const std::size_t before = routine().at;
    values_.forget_missing();
    exploration_.meet(&listing.statements[before]);
    execute(listing.statements[before]);
    if (routine().at == before) ++routine().at;
    if (problems_.full()) throw Stop{};
  }
  values_.leave();
  routines_.pop_back();
}

std::vector<FanucValues::Stored> FanucRun::arguments_in(FanucCursor& at) {
  std::vector<FanucValues::Stored> read;
  if (!at.take_sign('(')) return read;
  while (!at.at_end() && !at.take_sign(')') && read.size() < 100) {
    values_.forget_missing();
    const FanucNumber value = values_.expression(at);
    read.push_back({value, value ? FanucCauses{} : values_.causes()});
    if (!at.take_sign(',') && !at.at_end() && !at.rest().starts_with(')')) at.move_to(at.offset() + 1);
  }
  values_.forget_missing();
  return read;
}

/// Runs CALL name(arguments). For RUN name (`beside`), makes unknown what the parallel program may write.
void FanucRun::call_statement(const std::string& text, bool beside) {
  FanucCursor at(text);
  const std::string written(at.name()), name = lower_case(written);
  const FanucListing* listing = outlook_.program(name);
  if (beside) {
    note(fmt::format("RUN {}: runs beside this program", name), listing != nullptr);
    if (listing) return forget(outlook_.effects(*listing, 0, listing->statements.size()), {});
    values_.take_effect("RUN " + written);
    return;
  }
  if (!listing) return unread("CALL " + written);
  call(*listing, arguments_in(at));
}

/// Applies the effects of a program without a file. The position of the robot is unknown afterwards.
void FanucRun::unread(const std::string& what) {
  if (values_.take_effect(what))
    note(what + ": not among the files read; its registers are as motion.values says", true);
  else
    note(what + ": not among the files read; registers may be others behind it", true);
  last_.reset();
}

// ---- statements ------------------------------------------------------------------------------------------

void FanucRun::execute(const FanucStatement& s) {
  const std::string& text = s.text;
  FanucCursor at(text);
  const std::string word = at.word();
  if (fanuc_word(word) == FanucWord::motion && !at.rest().starts_with("[")) {
    if (word == "a" || word == "s") note("an arc or spline by A or S moves: read as straight lines", true);
    return move(at, word == "j"   ? Instruction::Kind::joint
                    : word == "c" ? Instruction::Kind::circular
                                  : Instruction::Kind::linear);
  }
  if (word == "if") return if_statement(at);
  if (word == "select") return select();
  if (word == "lbl") endless(routine().at);  // its first pass begins here
  if (word == "lbl" || (word.empty() && !at.take_sign('='))) return;
  if (word.empty() || (word == "else" && !fanuc_action(text).empty()))
    return;  // a case of a SELECT that chose another case
  action(text);
}

void FanucRun::action(const std::string& text) {
  FanucCursor at(text);
  const std::string word = at.word();
  if (word == "for") return for_statement(at);
  if (word == "endfor" || word == "else" || word == "end" || word == "endif") return block(word);
  if (word == "jmp") return jump(at, true);
  if (word == "call" || word == "run") return call_statement(std::string(at.rest()), word == "run");
  if (word == "wait") return wait(at);
  if (word == "monitor") {  // the monitored program is a list of WHEN condition, action
    const std::string name = "MONITOR " + std::string(at.name());
    note(name + ": what it does may come at any time, and is left out", true);
    values_.take_effect(name);
    return;
  }
  if (word == "abort") {
    note("ABORT: the program ends here");
    throw Stop{};
  }
  if (word == "offset" || word == "tool_offset") {  // CONDITION PR[n]
    at.take("CONDITION");
    (word == "offset" ? offset_condition_ : tool_offset_condition_) = std::string(at.rest());
    return;
  }
  if (word == "skip" && at.take("CONDITION")) {
    skip_condition_ = std::string(at.rest());
    return note("SKIP: input, output or logic");
  }
  if (word == "spot") return emit(dwell_of(around_.options.spot_time));
  assignment(word, at);
}

void FanucRun::assignment(const std::string& word, FanucCursor& at) {
  if (word == "r") return assign_register(at);
  if (word == "pr") return assign_position(at);
  if (word == "uframe" || word == "utool") return assign_frame(word, at);
  const std::string text = statement().text;
  const std::string left = plain_fanuc_name(std::string_view(text).substr(0, text.find('=')));
  if (const std::size_t group = left.find("[gp"); group != std::string::npos && left.substr(group, 4) != "[gp1")
    return note(word + ": of another group than the robot");
  if (word == "override" || word == "uframe_num" || word == "utool_num" || left == "$mcr.$genoverride" ||
      left == "$prgoverride") {
    at.skip_to('=');
    FanucNumber number = values_.expression(at);
    at.take_sign('%');
    if (number && !read_whole(at)) number.reset();
    return values_.set_named(left == "$mcr.$genoverride" ? "override" : left.starts_with("$") ? left : word, number);
  }
  if (left.starts_with("$mnuframe[") || left.starts_with("$mnutool[")) {  // [group,number]
    const FanucSetting setting = fanuc_setting(text);
    const bool tool = left.starts_with("$mnutool["), whole_frame = left.ends_with("]");
    at.skip_to('=');
    if (setting.number > 0 && whole_frame) return set_frame(tool, setting.number, at);
    if (setting.number > 0 && setting.component > 0)
      return set_frame_component(tool, setting.number, setting.component, at);
    if (setting.number == 0) return forget_frames(tool, values_.causes());
    return note(word + ": changes a frame of the controller", true);
  }
  switch (fanuc_word(word)) {
    case FanucWord::logic:
    case FanucWord::motion:
      return note(word + ": input, output or logic");
    case FanucWord::shapes_motion:
      return note(word + ": changes how the robot moves; what it does lies in the controller", true);
    case FanucWord::other:
      break;
  }
  if (const FanucListing* macro = outlook_.macro(text)) {
    const std::size_t open = text.find('(');
    FanucCursor arguments(std::string_view(text).substr(std::min(open, text.size())));
    return call(*macro, arguments_in(arguments));
  }
  unread(macro_name(text));
}

/// Executes ENDFOR, ELSE, ENDIF or END of a running block.
void FanucRun::block(const std::string& word) {
  if (word == "endfor") end_for();
  if (word == "else") routine().at = statement().end + 1;  // the THEN arm has run
  if (word == "end") routine().at = routine().listing->statements.size();
}

void FanucRun::jump(FanucCursor& at, bool certain) {
  if (!at.take("LBL")) return complain("jumps to no LBL[n]", "correct the statement");
  const auto label = values_.index(at);
  const auto& labels = routine().listing->labels;
  if (!label || !label->number) {
    if (whole_program_no_matter()) return;
    missing_value("jumps to a label by");
    if (labels.empty()) throw Stop{};
    return jump_to(std::next(labels.begin(), guess(static_cast<int>(labels.size())))->second, false);
  }
  const auto found = labels.find(whole_number(*label->number));
  if (found == labels.end())
    return complain(fmt::format("jumps to LBL[{}], which is not there", *label->number), "correct the label");
  jump_to(found->second, certain);
}

void FanucRun::jump_to(std::size_t target, bool certain) {
  const std::size_t here = routine().at;
  if (const FanucListing& listing = *routine().listing; listing.doubled.contains(target))
    note(fmt::format("{}: {}; the jump leads to line {}", listing.statements[target].text, doubled_label,
                     listing.statements[target].line),
         true);
  if (target <= here) last_jump_ = where();
  const bool looking = exploration_.guessing();
  if (looking && target <= here && !still_new(target)) throw Stop{};
  if (certain && target <= here && !looking) {
    bool exit = false;  // a decision in the loop may leave it: the loop runs until then
    for (auto d = routine().decided.lower_bound(target); d != routine().decided.end() && *d <= here; ++d)
      exit |= outlook_.leads_out(*routine().listing, *d, target, here);
    if (!exit && !goes_on(target)) {
      note("repeats without end: the motion ends where it repeats itself");
      throw Stop{};
    }
  }
  if (!certain && target <= here && !looking && waits(target)) {
    note(
        "waits in a loop that changes nothing, until the condition of this branch changes; the motion continues after it");
    return;
  }
  routine().at = target;  // the label, not the statement after it, which may be the jump itself
}

/// Returns whether a pass of a loop made no move and changed no value: all further passes would be the same.
bool FanucRun::waits(std::size_t label) {
  Endless& loop = endless(label);
  const auto& made = program_.instructions;
  const bool moved = std::any_of(made.begin() + static_cast<std::ptrdiff_t>(std::min(loop.begin, made.size())),
                                 made.end(), [](const Instruction& i) { return i.kind != Instruction::Kind::dwell; });
  loop.begin = made.size();
  ++loop.passes;
  // A state is a long text. It is stored after passes 1, 2, 4, 8 ... and compared after the pass that follows each.
  const auto is_power_of_two = [](int number) { return (number & (number - 1)) == 0; };
  const bool again = !moved && is_power_of_two(loop.passes - 1) && loop.states.contains(values_.state());
  loop.states.clear();
  if (is_power_of_two(loop.passes) && !again) loop.states.insert(values_.state());
  return again;
}

/// Returns whether one of the last three passes of a loop met new statements or questions. Only while guessing.
bool FanucRun::still_new(std::size_t label) {
  constexpr int enough = 3;  // consecutive passes without news
  Endless& loop = endless(label);
  loop.barren = loop.news == exploration_.news() ? loop.barren + 1 : 0;
  loop.news = exploration_.news();
  return loop.barren < enough;
}

FanucRun::Endless& FanucRun::endless(std::size_t label) {
  return endless_.try_emplace({routine().listing, label}, program_.instructions).first->second;
}

/// Returns whether an endless loop that is back at its label runs another pass. It runs options.passes passes if given.
/// Otherwise it ends when a pass has the moves of an earlier one and the same values that decide. A counter that
/// decides may never return to an earlier value: after a long search the moves alone count, with a warning. Without
/// a period of moves it ends, with a problem, after ImportLimits::passes.
bool FanucRun::goes_on(std::size_t label) {
  Endless& loop = endless(label);
  ++loop.passes;
  if (around_.options.passes > 0) return loop.passes < around_.options.passes;
  const std::string before = std::exchange(loop.last, values_.deciding_state());
  loop.all.add(std::hash<std::string>{}(loop.last));
  loop.begin = program_.instructions.size();
  const bool last = loop.passes >= ImportLimits::passes, repeats = loop.all.repeats();
  const bool searched = last || executed_ + values_.charged() > ImportLimits::searched_work ||
                        program_.instructions.size() > ImportLimits::searched_moves;
  const std::size_t kept = repeats ? loop.all.kept(0) : searched ? loop.all.by_motion() : 0;
  if (kept > 0) program_.instructions.resize(loop.all.end(kept));
  if (kept > 0 && !repeats)
    note(fmt::format(
             "repeats without end; the motion is {}; {} decides and has other values after each of {} passes, so {}",
             passes_text(static_cast<long>(kept)), changed_names(before, loop.last), loop.passes, later_passes_differ),
         true);
  if (kept > 0) return false;
  if (last)
    complain(fmt::format("does not repeat itself within {} passes", ImportLimits::passes),
             "say how many are wanted: motion.passes: N");
  return !last;
}

void FanucRun::wait(FanucCursor& at) {
  const std::size_t begin = at.offset();
  const std::string written(at.rest());
  FanucNumber time = at.number();
  if (!time && (at.take("R") || at.take("AR"))) {
    at.move_to(begin);
    time = values_.value(at);
    if (const bool alone = at.at_end() || at.rest().starts_with("("); alone && !time)
      return missing_value("waits for the time");
    else if (!alone)
      time.reset();
  }
  if (!time) {
    at.move_to(begin);
    const auto met = values_.condition(at);
    if (met && !*met) {  // another program must change a register to make the condition true
      const std::string text = statement().text;
      for (std::size_t found = text.find("R["); found != std::string::npos; found = text.find("R[", found + 1)) {
        FanucCursor name(std::string_view(text).substr(found + 1));
        if (const auto index = values_.index(name); index && index->number)
          values_.forget_register(whole_number(*index->number), {});
      }
    }
    return note("WAIT: input");
  }
  const auto unit = fanuc_unit_of_time(at.rest());
  if (!unit)
    return complain(fmt::format("waits for a time in a form that is not read: '{}'", trimmed(written)),
                    "write it in seconds, with a decimal point: WAIT 0.50(sec)");
  if (*time < 0) return complain("waits for a time below 0", "correct the time");
  if (*time > 0) emit(dwell_of(*time * *unit));
}

// ---- assignments -----------------------------------------------------------------------------------------

/// Returns whether an expression was read to the end of its line. If not, its value is unknown, with a warning.
bool FanucRun::read_whole(FanucCursor& at) {
  if (at.at_end()) return true;
  note(fmt::format("{}: {}", at.rest(), unread_rest), true);
  values_.forget_missing();
  return false;
}

void FanucRun::assign_register(FanucCursor& at) {
  const auto index = values_.index(at);
  at.skip_to('=');
  values_.forget_missing();
  const bool known = index && index->number;
  FanucNumber value = known ? values_.source(whole_number(*index->number), at) : values_.expression(at);
  if (known && value && !read_whole(at)) {
    value.reset();
    values_.miss({{fmt::format("R[{}]", whole_number(*index->number))}});
  }
  if (known) return values_.set_register(whole_number(*index->number), value);
  values_.forget_registers(values_.causes());
  note("R: writes a register whose number is known only while the robot runs");
}

/// Executes PR[1]=PR[2]+PR[3], =P[1], =LPOS, =JPOS, =UFRAME[1] or PR[1,3]=number.
void FanucRun::assign_position(FanucCursor& at) {
  const auto index = values_.index(at);
  at.skip_to('=');
  if (index && index->group != 1) return note("PR: of another group than the robot");
  if (!index || !index->number) {
    values_.forget_registers(values_.causes());
    return note("PR: writes a position register whose number is known only while the robot runs");
  }
  const int number = whole_number(*index->number);
  values_.forget_missing();
  if (index->part) {
    FanucNumber value = values_.expression(at);
    if (value && !read_whole(at)) {
      value.reset();
      values_.miss({FanucCause{}});
    }
    return values_.set_component(number, whole_number(*index->part), value);
  }
  auto sum = position_sum(at);
  if (sum && sum->known() && !read_whole(at)) {
    sum.reset();
    values_.miss({{fmt::format("PR[{}]", number)}});
  }
  const bool known = values_.given(fmt::format("pr[{}]", number)).has_value();  // used if the sum is unknown
  if (sum && sum->known()) return values_.set_position(number, *sum);
  values_.forget_position(number, known ? FanucCauses{} : values_.causes());
}

std::optional<FanucPosition> FanucRun::position_sum(FanucCursor& at) {
  std::optional<FanucPosition> sum;
  for (double sign = 1;;) {
    charge();
    const std::size_t begin = at.offset();
    const std::string word = at.word();
    std::optional<FanucPosition> read;
    if (word == "lpos" || word == "jpos") {
      const auto form = word == "lpos" ? FanucPosition::Form::pose : FanucPosition::Form::joints;
      FanucPosition unknown;
      unknown.form = form;
      unknown.values.assign(6, NAN);
      const bool here = last_ && last_->form == form &&
                        (word == "jpos" || (values_.named("uframe_num") == FanucNumber(last_->frame) &&
                                            values_.named("utool_num") == FanucNumber(last_->tool)));
      read = here ? *last_ : unknown;
    } else if (word == "uframe" || word == "utool") {
      const auto index = values_.index(at);
      const auto known = index && index->number ? frame(word == "utool", whole_number(*index->number)) : std::nullopt;
      if (!known) return {};
      read.emplace();
      read->form = FanucPosition::Form::pose;
      read->values = fanuc_values_of(known->frame);
    } else {
      at.move_to(begin);
      const WrittenPosition written = position(at);
      read = written.position;
      if (read && !read->known() && written.registered) values_.miss_position(*written.number);
    }
    if (!read) return {};
    read->frame = read->tool = -1;
    if (!sum) {
      sum = read;
    } else {
      if (sum->form != read->form || sum->values.size() != read->values.size() || sum->remote != read->remote)
        return {};
      for (std::size_t i = 0; i < sum->values.size(); ++i) sum->values[i] += sign * read->values[i];
    }
    if (at.take_sign('+'))
      sign = 1;
    else if (at.take_sign('-'))
      sign = -1;
    else
      return sum;
  }
}

void FanucRun::assign_frame(const std::string& word, FanucCursor& at) {
  const auto index = values_.index(at);
  at.skip_to('=');
  if (!index || index->group != 1) return note(word + ": a frame of another group", true);
  if (!index->number) return forget_frames(word == "utool", values_.causes());
  if (whole_number(*index->number) == 0)
    return note(word + "[0] is fixed, nothing can be assigned to it: the controller stops here", true);
  set_frame(word == "utool", whole_number(*index->number), at);
}

/// Assigns a frame. Six components that a program wrote are taken as a pose. An unknown value makes the frame unknown.
void FanucRun::set_frame(bool tool, int number, FanucCursor& at) {
  values_.forget_missing();
  std::optional<FanucPosition> read = position_sum(at);
  if (read && read->known() && !read_whole(at)) {
    read.reset();
    values_.miss({FanucCause{}});
  }
  if (read && read->form != FanucPosition::Form::joints && read->known() && read->values.size() == 6)
    frames_[{tool, number}] = {frame_of_fanuc(read->values), {}};
  else
    frames_[{tool, number}] = {{}, values_.causes()};
}

/// Assigns one component of a frame. The frame is asked for if its other components are unknown.
void FanucRun::set_frame_component(bool tool, int number, int component, FanucCursor& at) {
  values_.forget_missing();
  FanucNumber value = values_.expression(at);
  if (value && !read_whole(at)) {
    value.reset();
    values_.miss({FanucCause{}});
  }
  const FanucCauses why = values_.causes();
  const auto before = frame(tool, number);
  if (!before) return;
  if (!value) {
    frames_[{tool, number}] = {{}, why};
    return;
  }
  std::vector<double> values = fanuc_values_of(before->frame);
  values[static_cast<std::size_t>(component) - 1] = *value;
  frames_[{tool, number}] = {frame_of_fanuc(values), {}};
}

// ---- branches and loops ----------------------------------------------------------------------------------

/// Asks which of its `ways` an undecided statement takes, and returns the guessed one, 0 .. ways - 1. The question is the
/// value of the only cause; if there are several or none, it is the line of the statement.
int FanucRun::ask(const std::string& what, int ways, const std::string& answers) {
  const FanucCauses& causes = values_.causes();
  const std::string names = names_in(causes);
  std::vector<Question> questions = questions_for(causes);
  if (questions.size() != 1)
    questions = {{Question::Kind::branch, line_name(), answers == then_or_else ? "then or else" : answers}};
  missing(names.empty() ? line_name() : names,
          fmt::format("{} {} is known only while the robot runs", what, names.empty() ? "what" : names + ", which"),
          fmt::format("choose with {}{}", assume_of_job(line_name(), answers),
                      names.empty() ? "" : fmt::format(", or give {}", options_for(causes))),
          questions, true);
  return guess(ways);
}

int FanucRun::guess(int ways) {
  if (!exploration_.guessing()) guessed_at_ = executed_;
  return exploration_.choose(line_name(), ways);
}

/// Returns whether undecided statements with these effects can be left out. If so, the values that they may write become
/// unknown. False: they move the robot, may jump out, or a later question depends on this line.
bool FanucRun::no_matter(const FanucEffects& effects) {
  if (effects.moves || effects.leaves || exploration_.follows(line_name())) return false;
  if (effects.waits)
    note("IF, SELECT, FOR: waits on a condition that is known only while the robot runs; left out", true);
  else
    note("IF, SELECT, FOR: a branch on a condition that is known only while the robot runs, without moves");
  for (const std::string& name : effects.unread)
    note(name + ": not among the files read; a branch calls it on a condition that is known only while the robot runs",
         true);
  FanucCauses why = values_.causes();
  for (FanucCause& cause : why) cause.line = line_name();
  if (why.empty()) why = {{"", line_name()}};
  forget(effects, why);
  return true;
}

/// Makes all values that `effects` may write unknown.
void FanucRun::forget(const FanucEffects& effects, const FanucCauses& why) {
  for (const std::string& name : effects.written) {
    FanucCursor at(name);
    const std::string word = at.word();
    const auto number = at.take_sign('[') ? at.number() : std::nullopt;
    if (word == "r" || word == "pr") {
      if (!number)
        values_.forget_registers(why);
      else if (word == "r")
        values_.forget_register(whole_number(*number), why);
      else
        values_.forget_position(whole_number(*number), why);
    } else if (number) {
      frames_[{word == "utool", whole_number(*number)}] = {{}, why};
    } else if (name.ends_with("[]")) {
      forget_frames(word == "utool", why);
    } else {
      values_.set_named(name, {});
    }
  }
}

/// Makes all user frames or all tools unknown, because one with an unknown number was assigned.
void FanucRun::forget_frames(bool tool, const FanucCauses& why) {
  for (auto& [frame, assigned] : frames_)
    if (frame.first == tool) assigned = {{}, why};
  frames_[{tool, any_frame}] = {{}, why};
}

/// Returns whether the running called program has no move, timed wait or ABORT in any branch. If so, the program ends
/// here, and all values that it may write become unknown.
bool FanucRun::whole_program_no_matter() {
  if (routines_.size() < 2) return false;
  const FanucListing& listing = *routine().listing;
  const auto aborts = [](const FanucStatement& s) {
    const std::string action = fanuc_action(s.text);
    return FanucCursor(action).word() == "abort";
  };
  if (std::ranges::any_of(listing.statements, aborts)) return false;
  FanucEffects effects = outlook_.effects(listing, 0, listing.statements.size());
  effects.leaves = false;  // jumps stay within a program
  if (effects.waits || !no_matter(effects)) return false;
  routine().at = listing.statements.size();
  return true;
}

void FanucRun::if_statement(FanucCursor& at) {
  const FanucStatement& s = statement();
  const bool block = lower_case(s.text).ends_with("then");
  const std::string rest = block ? "" : fanuc_action(s.text);
  std::optional<bool> decision = values_.condition(at);
  while (at.take_sign(')')) {  // one too many, which controllers accept
  }
  at.skip_blanks();
  const bool whole = at.rest().starts_with(",") || at.rest() == rest || FanucCursor(at.rest()).take("THEN");
  if (decision && !whole && !read_whole(at)) decision.reset();
  if (decision) {
    routine().decided.insert(routine().at);
    last_decision_ = where();
  }
  if (const auto known = assumed(s.line)) decision = known;
  if (!block && rest.empty()) return complain("is no IF condition,action", "correct the statement");
  if (!decision) decision = undecided(rest);
  if (!decision) return;
  if (block && !*decision) routine().at = s.other + 1;
  if (!block && *decision) conditional_action(rest);
}

void FanucRun::conditional_action(const std::string& text) {
  FanucCursor at(text);
  const std::string word = at.word();
  if (word == "jmp") return jump(at, false);
  if (fanuc_word(word) == FanucWord::motion && !at.rest().starts_with("["))
    return complain("moves behind a condition", "list the program again");
  action(text);
}

/// Decides an IF with an unknown condition. action: empty for a block. std::nullopt: the action or block is left out.
/// ABORT is always left out.
std::optional<bool> FanucRun::undecided(const std::string& action) {
  const std::size_t here = routine().at;
  const FanucListing& listing = *routine().listing;
  FanucCursor at(action);
  const std::string word = at.word();
  if (word == "abort") {
    note("ABORT: on a condition that is taken not to be met");
    return {};
  }
  std::size_t target = action.empty() ? statement().end : word == "end" ? listing.statements.size() : here;
  bool leaves = false;
  if (word == "jmp" && at.take("LBL")) {
    const auto label = values_.index(at);
    const auto found =
        label && label->number ? listing.labels.find(whole_number(*label->number)) : listing.labels.end();
    leaves = found == listing.labels.end();
    if (!leaves) target = found->second;
  }
  FanucEffects effects = target == here  ? outlook_.effects(action)
                         : target > here ? outlook_.effects(listing, here + 1, target)
                                         : outlook_.effects(listing, target, here);
  effects.leaves |= leaves;
  if (no_matter(effects)) {
    routine().at = std::max(target, here);
    return {};
  }
  if (whole_program_no_matter()) return {};
  return ask("branches on", 2, then_or_else) == 0;
}

/// Executes SELECT R[1]=1,JMP LBL[1] ; =2,CALL X ; ELSE,JMP LBL[3] as one decision.
void FanucRun::select() {
  const std::size_t here = routine().at;
  const auto& statements = routine().listing->statements;
  FanucCursor at(statement().text);
  at.word();
  const FanucNumber selected = values_.value(at);
  std::vector<Case> cases;
  std::size_t behind = here;
  for (bool first = true; behind < statements.size(); ++behind, first = false) {
    const std::string& text = statements[behind].text;
    FanucCursor next = first ? at : FanucCursor(text);
    const bool otherwise = !first && next.take("ELSE");
    if (!otherwise && !next.take_sign('=')) break;
    cases.push_back({behind, otherwise ? FanucNumber{} : values_.expression(next), otherwise, fanuc_action(text)});
    if (otherwise) {
      ++behind;
      break;
    }
  }
  auto which = chosen(cases, selected);
  if (which) {
    routine().decided.insert(here);
    last_decision_ = where();
  } else {
    which = undecided_select(cases, behind);
  }
  if (!which) return;
  routine().at = behind;
  if (*which >= cases.size()) return;  // no case applies
  routine().at = cases[*which].statement;
  conditional_action(cases[*which].action);
  if (routine().at == cases[*which].statement) routine().at = behind;
}

/// Returns the index of the case that runs; cases.size(): no case applies; std::nullopt: unknown.
std::optional<std::size_t> FanucRun::chosen(const std::vector<Case>& cases, FanucNumber selected) {
  const std::string file = where().file;
  FanucNumber value = selected;
  for (const std::string& key :
       {line_name(), fmt::format("{}:{}", file, where().line), fmt::format("{}", where().line)})
    if (const auto known = around_.options.choose.find(key); known != around_.options.choose.end()) {
      used_lines_.insert(key);
      FanucCursor at(known->second);  // --assume FILE:LINE=2
      value = at.number();
    }
  if (assumed(where().line) == std::optional(false))  // --assume FILE:LINE=else with the line of the SELECT
    return cases.empty() || !cases.back().otherwise ? cases.size() : cases.size() - 1;
  std::vector<std::optional<bool>> known;  // --assume FILE:LINE=then with the line of one case
  for (const Case& one : cases) known.push_back(assumed(routine().listing->statements[one.statement].line));
  if (const auto taken = std::ranges::find(known, true); taken != known.end())
    return static_cast<std::size_t>(taken - known.begin());
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (known[i]) continue;
    if (cases[i].otherwise) return value ? std::optional(i) : std::nullopt;
    if (!value || !cases[i].value) return {};
    if (as_single(*value) == as_single(*cases[i].value)) return i;
  }
  return value ? std::optional(cases.size()) : std::nullopt;
}

/// Asks for the case of an undecided SELECT and returns its guessed index. std::nullopt: the SELECT is left out.
std::optional<std::size_t> FanucRun::undecided_select(const std::vector<Case>& cases, std::size_t behind) {
  const FanucListing& listing = *routine().listing;
  FanucEffects effects;
  std::vector<std::string> values;
  std::size_t furthest = behind;
  for (const Case& one : cases) {
    values.push_back(one.otherwise ? "else" : one.value ? fmt::format("{}", *one.value) : "?");
    FanucCursor at(one.action);
    const bool jumps = at.take("JMP") && at.take("LBL");
    const auto label = jumps ? values_.index(at) : std::nullopt;
    const auto found =
        label && label->number ? listing.labels.find(whole_number(*label->number)) : listing.labels.end();
    if (jumps && (found == listing.labels.end() || found->second < behind)) effects.leaves = true;
    if (jumps && found != listing.labels.end()) furthest = std::max(furthest, found->second);
    if (!jumps) effects.add(outlook_.effects(one.action));
  }
  effects.add(outlook_.effects(listing, behind, furthest));
  if (no_matter(effects)) {
    routine().at = furthest;
    return {};
  }
  if (whole_program_no_matter()) return {};
  const int ways = static_cast<int>(cases.size()) + 1;
  return static_cast<std::size_t>(ask("selects by", ways, fmt::format("VALUE ({})", pipeline::joined(values, ", "))));
}

void FanucRun::for_statement(FanucCursor& at) {
  const std::size_t here = routine().at, end = statement().end;
  std::optional<FanucValues::Index> index;
  if (at.take("R")) index = values_.index(at);
  at.skip_to('=');
  const FanucNumber from = values_.expression(at);
  const bool down = at.take("DOWNTO");
  if (!down) at.take("TO");
  FanucNumber to = values_.expression(at);
  if (to && !read_whole(at)) to.reset();
  if (!index || !index->number || !from || !to) {
    const bool left_out = no_matter(outlook_.effects(*routine().listing, here + 1, end));
    if (!left_out) missing_value("counts by");
    if (left_out || guess(2) == 1 || !index || !index->number) {
      routine().at = end + 1;
      return;
    }
    values_.set_register(whole_number(*index->number), from.value_or(1));
    routine().loops[here] = {whole_number(*index->number), from.value_or(1),
                             1.0};  // a single pass to find further questions
    return;
  }
  const int number = whole_number(*index->number);
  values_.set_register(number, *from);
  if (down ? *from < *to : *from > *to)
    routine().at = end + 1;
  else
    routine().loops[here] = {number, *to, down ? -1.0 : 1.0};
}

/// Executes ENDFOR. The counter changes only until it reaches its last value, and keeps that value after the loop.
void FanucRun::end_for() {
  const auto found = routine().loops.find(statement().end);
  if (found == routine().loops.end()) return complain("has no FOR that runs", "enter the loop by its FOR");
  const Loop loop = found->second;
  values_.forget_missing();
  const std::string name = fmt::format("R[{}]", loop.register_number);
  FanucCursor at(name);
  const FanucNumber counter = values_.value(at);
  if (!counter) {
    routine().loops.erase(found);
    return missing_value("counts by");
  }
  if (loop.step > 0 ? *counter < loop.last : *counter > loop.last) {
    values_.set_register(loop.register_number, *counter + loop.step);
    last_jump_ = where();
    routine().at = statement().end + 1;
  } else {
    routine().loops.erase(found);
  }
}

}  // namespace dresslife::sim
