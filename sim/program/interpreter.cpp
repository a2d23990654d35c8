// Statements; expressions are in evaluation.cpp.
#include "sim/program/interpreter.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <utility>

#include "sim/program/tokens.h"

namespace dresslife::sim {
namespace {

using Kind = Statement::Kind;

constexpr int stack_depth = 1200;  // of execute() and evaluate() in each other; a frame is below 1 kB

constexpr std::size_t instruction_work = 10;  // of a move, in statements

// In search of the pass of an endless loop after which it repeats itself: enough for a pallet of 200 boxes,
// and little beside what a program may run.
constexpr int searched_passes = 200;
constexpr long searched_work = ImportLimits::executed / 3;
constexpr std::size_t searched_moves = 20'000;

std::string passes_text(long passes) { return passes == 1 ? "one pass" : fmt::format("{} passes", passes); }

}  // namespace

struct Interpreter::Deeper {
  Deeper(Interpreter& run, const Place& place) : run_(run) {
    if (++run_.depth_ <= stack_depth) return;
    --run_.depth_;
    run_.complain(place, "is nested too deeply, routines included", "write it simpler");
    throw Stop{};
  }
  ~Deeper() { --run_.depth_; }
  Interpreter& run_;
};

/// A loop that runs, as long as this lives.
struct Interpreter::Round {
  Round(Interpreter& run, const Place& place) : run_(run), at_(run.loops_.size()) {
    run.loops_.push_back({place});
  }
  Round(const Round&) = delete;
  ~Round() { run_.loops_.resize(at_); }
  long again() {
    run_.charge(1);
    return ++run_.loops_[at_].passes;
  }
  Interpreter& run_;
  std::size_t at_;
};

/// A body that runs again and again, as long as this lives.
struct Interpreter::Again {
  Again(Interpreter& run, const std::vector<Statement>& body) : run_(run), at_(run.endless_.size()) {
    run.endless_.push_back(&body);
  }
  Again(const Again&) = delete;
  ~Again() { run_.endless_.resize(at_); }
  Interpreter& run_;
  std::size_t at_;
};

Interpreter::Interpreter(const Code& code, Dialect& dialect, const ImportOptions& options, Program& program,
                         Problems& problems)
    : code_(code), dialect_(dialect), options_(options), program_(program), problems_(problems) {}

void Interpreter::run(const Routine& routine) {
  try {
    index_data();
    for (const Datum& datum : code_.data) {  // of a KRL data list; declarations wait until they are used
      if (datum.statement.kind != Kind::assign) continue;
      module_ = datum.module;
      assign(datum.statement.arguments[0], evaluate(datum.statement.arguments[1]));
    }
    module_ = -1;
    locals_.emplace_back();
    start(routine);
  } catch (const Stop&) {
  } catch (const EndOfCycle&) {  // of what is not run again
  }
  for (const auto& [line, assumption] : options_.assume)
    if (!used_assumptions_.contains(line))
      note(routine.place, fmt::format("--assume {}: no branch on that line was to be decided", line), true);
  for (const auto& [name, expression] : code_.values)
    if (!used_values_.contains(name))
      note(expression.place, fmt::format("--value {}: nothing in the program asked for it", name), true);
}

void Interpreter::start(const Routine& routine) {
  program_.start = where(routine.place);
  if (const Routine* rival = code_.rival(routine))
    complain(
        routine.place,
        fmt::format("holds '{}', which stands in {} as well", routine.written, where(rival->place).text()),
        "leave one of the two out");
  const auto needed = [](const Parameter& parameter) { return !parameter.option; };
  const auto count = std::count_if(routine.parameters.begin(), routine.parameters.end(), needed);
  if (static_cast<long>(code_.start_arguments.size()) < count) {
    std::string names;
    for (const Parameter& parameter : routine.parameters)
      if (needed(parameter)) names += (names.empty() ? "" : ", ") + parameter.name;
    complain(routine.place, fmt::format("'{}' takes {} arguments: {}", routine.written, count, names),
             fmt::format("give them: --routine '{}({})' with their values (motion.routine)", routine.written,
                         names));
    return;
  }
  started_ = &routine;
  within_itself_.emplace(program_.instructions);
  if (dialect_.begins_again(routine) && code_.start_arguments.empty())
    run_cycles(routine);
  else
    call(routine, code_.start_arguments, routine.place);
}

pipeline::Where Interpreter::where(const Place& place) const {
  return {code_.files[place.file].name(), place.line, place.column};
}

/// The routine that holds the line; empty: none.
std::string Interpreter::routine_at(const Place& place) const {
  for (const Routine& routine : code_.routines)
    if (routine.place.file == place.file && routine.place.line <= place.line &&
        place.line <= routine.last_line)
      return routine.written;
  return "";
}

void Interpreter::complain(const Place& place, const std::string& what, const std::string& remedy) {
  problems_.add(where(place), what, remedy, routine_at(place));
}

void Interpreter::miss(const std::string& name, const Place& place, const std::string& what,
                       const std::string& remedy) {
  problems_.add_missing(name, where(place), what, remedy, routine_at(place));
}

void Interpreter::note(const Place& place, const std::string& what, bool may_move) {
  if (program_.skipped.size() >= ImportLimits::skipped) return;
  const pipeline::Where at = where(place);
  const auto same = [&](const Skipped& s) {
    return s.where.line == at.line && s.where.file == at.file && s.what == what;
  };
  if (std::any_of(program_.skipped.rbegin(), program_.skipped.rend(), same)) return;
  program_.skipped.push_back({at, what, may_move});
}

void Interpreter::charge(std::size_t work) {
  executed_ += static_cast<long>(work);
  if (executed_ <= ImportLimits::executed) return;
  // The loop that has gone round most often since it was entered runs away, not those around or within it.
  const auto longest = std::max_element(loops_.begin(), loops_.end(),
                                        [](const Loop& a, const Loop& b) { return a.passes < b.passes; });
  const Place place = longest != loops_.end() ? longest->place
                      : routines_.empty()     ? Place{}
                                              : routines_.back()->place;
  complain(place,
           fmt::format("has run {} statements without an end (a loop that input would end?)",
                       ImportLimits::executed),
           fmt::format("take one pass of the loop with --assume {0}=then, or leave it out with =else",
                       short_place(place)));
  throw Stop{};
}

std::string Interpreter::short_place(const Place& place) const {
  return fmt::format("{}:{}", std::filesystem::path(code_.files[place.file].name()).filename().string(),
                     place.line);
}

int Interpreter::frame_index(std::vector<NamedFrame>& list, const NamedFrame& frame) {
  const auto& m = frame.frame;
  for (std::size_t i = list.size(); i-- > 0;)
    if (list[i].name == frame.name && list[i].stationary == frame.stationary &&
        list[i].frame.position == m.position && list[i].frame.orientation.coeffs() == m.orientation.coeffs())
      return static_cast<int>(i);
  NamedFrame added = frame;
  int variants = 1;
  const auto taken = [&] {
    return std::any_of(list.begin(), list.end(),
                       [&](const NamedFrame& other) { return other.name == added.name; });
  };
  while (taken()) added.name = fmt::format("{} ({})", frame.name, ++variants);  // the program changed it
  list.push_back(added);
  charge(list.size());
  return static_cast<int>(list.size()) - 1;
}

void Interpreter::emit(Instruction instruction, const Statement& statement) {
  if (program_.instructions.size() >= ImportLimits::instructions) {
    complain(statement.place,
             fmt::format("would be move {} (no more are allowed)", ImportLimits::instructions + 1),
             "simulate a shorter part of the program");
    throw Stop{};
  }
  instruction.where = where(statement.place);
  instruction.routine = routines_.back()->written;
  instruction.text = code_.files[statement.place.file].line(statement.place.line);
  program_.instructions.push_back(std::move(instruction));
}

// ---- statements -------------------------------------------------------------------------------------------

Interpreter::Flow Interpreter::execute(const std::vector<Statement>& body) {
  std::optional<Round> round;  // of jumps back
  for (std::size_t i = 0; i < body.size(); ++i) {
    const Flow flow = execute(body[i]);
    if (flow == Flow::next) continue;
    if (flow != Flow::jump) return flow;
    const auto label = std::find_if(body.begin(), body.end(), [&](const Statement& statement) {
      return statement.kind == Kind::label && statement.name == jump_->name;
    });
    if (label == body.end()) return flow;  // in a block around this one
    const auto target = static_cast<std::size_t>(label - body.begin());
    if (target <= i) {
      if (!round) round.emplace(*this, jump_->place);
      const long passes = round->again();
      if (jumps_for_ever(body, target, i) && passes >= std::max(1, options_.passes)) {
        note(jump_->place, "an endless loop, of which the motion is " + passes_text(passes));
        throw Stop{};
      }
    }
    charge(1);
    i = target;
  }
  return Flow::next;
}

Interpreter::Flow Interpreter::execute_routine(const Routine& routine) {
  const Flow flow = execute(routine.body);
  if (flow != Flow::jump) return flow;
  complain(jump_->place, fmt::format("jumps to '{}', which is no label in a block around it", jump_->name),
           "mend the label, or write a loop");
  throw Stop{};
}

/// The jump stands in `body` itself, and nothing between it and its label leaves the way round.
bool Interpreter::jumps_for_ever(const std::vector<Statement>& body, std::size_t label,
                                 std::size_t jump) const {
  if (body[jump].kind != Kind::jump) return false;  // in an arm of a branch
  const std::vector<Statement> round(body.begin() + static_cast<long>(label),
                                     body.begin() + static_cast<long>(jump));
  return !holds_loop_exit(round);
}

Interpreter::Flow Interpreter::execute(const Statement& statement) {
  const Deeper deeper(*this, statement.place);
  charge(1);
  if (problems_.full()) throw Stop{};
  switch (statement.kind) {
    case Kind::assign:
      assign(statement.arguments[0], evaluate(statement.arguments[1]));
      break;
    case Kind::branch:
      return run_branch(statement);
    case Kind::choose:
      return run_choice(statement);
    case Kind::count:
      return run_count(statement);
    case Kind::while_loop:
      return run_while(statement);
    case Kind::until_loop:
      return run_until(statement);
    case Kind::endless:
      return run_endless(statement);
    case Kind::instruction:
      run_instruction(statement);
      break;
    case Kind::give_back:
      result_ = statement.arguments.empty() ? Value{} : evaluate(statement.arguments[0]);
      return Flow::give_back;
    case Kind::leave_loop:
      return Flow::leave_loop;
    case Kind::label:
      break;
    case Kind::jump:
      jump_ = &statement;
      return Flow::jump;
    case Kind::finish:
      throw Stop{};
    case Kind::end_cycle:
      throw EndOfCycle{};
    case Kind::declare:
      declare(statement);
      break;
  }
  return Flow::next;
}

/// What the user says of a line, under any of its names.
template <class Answers>
const typename Answers::mapped_type* Interpreter::answer(const Answers& answers, const Place& place) {
  if (answers.empty()) return nullptr;
  const std::string& file = code_.files[place.file].name();
  for (const std::string& key :
       {fmt::format("{}:{}", file, place.line), fmt::format("{}", place.line), short_place(place)})
    if (const auto found = answers.find(key); found != answers.end()) {
      used_assumptions_.insert(key);
      return &found->second;
    }
  return nullptr;
}

std::optional<bool> Interpreter::assumed(const Place& place) {
  const Assumption* found = answer(options_.assume, place);
  return found ? std::optional(*found == Assumption::then_branch) : std::nullopt;
}

void Interpreter::ask(const Place& place, const std::string& what, const Value& unknown,
                      const std::string& answers, const std::vector<Expression>& asked) {
  std::string values;
  std::vector<std::string> names;
  for (const Expression& expression : asked) unknown_names(expression, names);
  if (names.empty()) names.push_back(question_of(unknown));
  for (const std::string& name : names)
    if (!name.empty()) values += fmt::format("{}--value '{}=...'", values.empty() ? "" : " ", name);
  const std::string about = values.empty() ? where(place).text() : answers + values;
  if (const Cause* cause = unknown.first_cause(); cause && cause->behind)
    values += fmt::format(", or --assume {}=then or =else", cause->line);
  problems_.add_decision(
      about, where(place), what + because(unknown),
      fmt::format("choose with --assume {}={} (motion.assume in a job){}", short_place(place), answers,
                  values.empty() ? "" : fmt::format(", or give {} (motion.values)", values)),
      routine_at(place));
}

Interpreter::Flow Interpreter::run_branch(const Statement& statement) {
  for (const Branch& branch : statement.branches) {
    if (branch.conditions.empty()) return execute(branch.body);
    std::optional<bool> decision = assumed(branch.place);
    Value condition;
    const std::size_t problems = problems_.count();
    if (!decision) {
      condition = evaluate(branch.conditions[0]);
      if (condition.kind == Value::Kind::truth) decision = condition.number != 0;
    }
    if (!decision) {
      if (!matters(statement)) return leave_out(statement, condition);
      if (problems_.count() != problems) return run_both(statement);  // what makes it unknown is told
      if (const Branch* way = waited_for(statement)) return go_on(*way, condition);
      ask(branch.place, "branches on what is known only while the robot runs", condition, "then or =else",
          branch.conditions);
      return run_both(statement);
    }
    if (*decision) return execute(branch.body);
  }
  return Flow::next;
}

Interpreter::Flow Interpreter::run_choice(const Statement& statement) {
  const Expression* chosen = answer(code_.choices, statement.place);
  const Value subject = evaluate(chosen ? *chosen : statement.arguments[0]);
  for (const Branch& branch : statement.branches) {
    if (branch.conditions.empty()) return execute(branch.body);
    const std::optional<bool> decision = assumed(branch.place);
    if (decision ? *decision : false) return execute(branch.body);
    if (decision) continue;
    for (const Expression& condition : branch.conditions) {
      const Value value = evaluate(condition);
      if (!subject.known() || !value.known()) {
        const Value& unknown = subject.known() ? value : subject;
        if (!matters(statement)) return leave_out(statement, unknown);
        if (const Branch* way = waited_for(statement)) return go_on(*way, unknown);
        ask(statement.place, "chooses by what is known only while the robot runs", unknown,
            "VALUE, the value that it then has", statement.arguments);
        return run_both(statement);
      }
      if (value == subject) return execute(branch.body);
    }
  }
  return Flow::next;
}

/// An undecided branch that does not move the robot: nothing but its variables becomes unknown.
Interpreter::Flow Interpreter::leave_out(const Statement& statement, const Value& unknown) {
  const std::string line = short_place(statement.place);
  const std::shared_ptr<const Cause> cause = unknown_value(unknown).cause;
  const bool waits = std::any_of(statement.branches.begin(), statement.branches.end(),
                                 [&](const Branch& branch) { return only_waits(branch.body); });
  note(statement.place,
       fmt::format("branch {}{}: known only while the robot runs", waits ? "that waits" : "without moves",
                   cause ? fmt::format(" on '{}'", cause->name) : ""));
  Cause why{"", "hangs on the branch in " + line, line, cause && cause->behind ? cause->behind : cause};
  if (!why.behind || why.behind->name.empty()) why.behind = nullptr;
  std::set<const Routine*> done;
  for (const Branch& branch : statement.branches) forget_assigned(branch.body, why, done);
  if (!leaves(statement, false)) return Flow::next;
  // What follows in the routine may run or not, and moves nothing either (see matters()).
  forget_assigned(routines_.back()->body, why, done);
  result_ = unknown_value(unknown);
  return Flow::give_back;
}

/// The one arm of an undecided statement that moves the robot, in an endless loop that does nothing else: the
/// loop waits for it, as WaitUntil would. Null: how it goes makes another motion.
const Branch* Interpreter::waited_for(const Statement& statement) {
  if (endless_.empty()) return nullptr;
  const std::vector<Statement>& round = *endless_.back();
  if (&statement < round.data() || &statement >= round.data() + round.size()) return nullptr;
  for (const Statement& other : round)
    if (&other != &statement && !changes_nothing(other, module_)) return nullptr;
  const Branch* way = nullptr;
  for (const Branch& branch : statement.branches) {
    for (const Expression& condition : branch.conditions)
      if (moves(condition, module_)) return nullptr;
    if (changes_nothing(branch.body, module_)) continue;
    if (way || branch.conditions.empty()) return nullptr;
    way = &branch;
  }
  if (!way || statement.kind != Kind::branch) return way;
  const Value condition = evaluate(way->conditions[0]);
  return condition.kind == Value::Kind::truth && condition.number == 0 ? nullptr : way;  // it never comes
}

Interpreter::Flow Interpreter::go_on(const Branch& way, const Value& unknown) {
  const Cause* cause = unknown.first_cause();
  note(way.place, fmt::format("the robot waits{} (its loop makes no other move), and the way on is taken",
                              cause && !cause->name.empty() ? fmt::format(" for '{}'", cause->name) : ""));
  return execute(way.body);
}

/// The reading has failed; what else there is to ask or to mend in the arms is told as well.
Interpreter::Flow Interpreter::run_both(const Statement& statement) {
  for (const Branch& branch : statement.branches) execute(branch.body);
  return Flow::next;
}

Expression Interpreter::counter_of(const Statement& statement) {
  Expression counter;
  counter.kind = Expression::Kind::name;
  counter.text = statement.name;
  counter.place = statement.place;
  return counter;
}

Interpreter::Flow Interpreter::run_count(const Statement& statement) {
  const std::optional<bool> decision = assumed(statement.place);
  if (decision && !*decision) return Flow::next;
  const auto from = number(statement.arguments[0]), to = number(statement.arguments[1]);
  const Expression& written_step = statement.arguments[2];
  std::optional<double> step = from && to && *to < *from ? -1 : 1;  // RAPID counts either way
  if (written_step.kind != Expression::Kind::none) step = number(written_step);
  if (!decision && (!from || !to || !step || *step == 0)) {
    Value unknown;
    for (const Expression& bound : statement.arguments)
      if (unknown.cause == nullptr) unknown = unknown_value(evaluate(bound));
    if (!matters(statement)) return leave_out(statement, unknown);
    ask(statement.place, "counts to what is known only while the robot runs (then: one pass, else: none)",
        unknown, "then or =else", statement.arguments);
    return Flow::next;
  }
  const double first = from.value_or(1), last = decision ? first : *to, by = decision ? 1 : *step;
  Scope& variables = locals_.back();
  const auto before = variables.find(statement.name);
  const std::optional<Variable> hidden =
      before == variables.end() ? std::nullopt : std::optional(before->second);
  const auto count = [&](double value) {
    if (statement.keeps_counter) {
      assign(counter_of(statement), number_value(value));
    } else {
      variables.insert_or_assign(statement.name, Variable{.state = Variable::State::ready,
                                                          .value = number_value(value),
                                                          .written = statement.place});
    }
  };
  Round round(*this, statement.place);
  Flow flow = Flow::next;
  double value = first;
  for (long k = 0; flow == Flow::next && (by > 0 ? value <= last : value >= last);) {
    round.again();
    count(value);
    flow = execute(statement.branches[0].body);
    value = first + static_cast<double>(++k) * by;
    if (!statement.keeps_counter || flow != Flow::next) continue;
    const Value counter = evaluate(counter_of(statement));  // the body may have changed it
    if (!counter.is_number()) {
      ask(statement.place, "counts with a variable that is known only while the robot runs", counter,
          "then or =else", {});
      break;
    }
    value = counter.number + by;
  }
  if (statement.keeps_counter) {
    if (flow == Flow::next) count(value);
  } else if (hidden) {
    variables.insert_or_assign(statement.name, *hidden);
  } else {
    variables.erase(statement.name);
  }
  return flow == Flow::leave_loop ? Flow::next : flow;
}

Interpreter::Flow Interpreter::run_while(const Statement& statement) {
  const std::optional<bool> decision = assumed(statement.place);
  const Expression& condition = statement.arguments[0];
  if (!decision && condition.kind == Expression::Kind::truth && condition.number != 0)
    return run_endless(statement);
  Flow flow = Flow::next;
  Round round(*this, statement.place);
  while (flow == Flow::next) {
    if (decision && !*decision) break;
    if (!decision) {
      const Value go_on = evaluate(condition);
      if (!go_on.known()) {
        if (!matters(statement)) return leave_out(statement, go_on);
        ask(statement.place,
            "repeats while something holds that is known only while the robot runs (then: one pass, else: "
            "none)",
            go_on, "then or =else", {condition});
        return run_both(statement);
      }
      if (go_on.number == 0) break;
    }
    const long passes = round.again();
    flow = execute(statement.branches[0].body);
    if (decision && passes >= std::max(1, options_.passes)) break;
  }
  return flow == Flow::leave_loop ? Flow::next : flow;
}

Interpreter::Flow Interpreter::run_until(const Statement& statement) {
  Round round(*this, statement.place);
  while (true) {
    const Flow flow = execute(statement.branches[0].body);
    if (flow != Flow::next) return flow == Flow::leave_loop ? Flow::next : flow;
    if (assumed(statement.place)) return Flow::next;
    const Value done = evaluate(statement.arguments[0]);
    if (!done.known()) {
      note(statement.place,
           "a loop that ends when something holds that is known only while the robot runs, of which one pass "
           "is "
           "taken" +
               because(done),
           matters(statement));
      return Flow::next;
    }
    if (done.number != 0) return Flow::next;
    round.again();
  }
}

/// A sum over all that the program has assigned.
std::uint64_t Interpreter::state(bool with_locals) const {
  std::uint64_t sum = 14695981039346656037u;  // FNV-1a
  const auto take = [&](const void* bytes, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      sum = (sum ^ static_cast<const unsigned char*>(bytes)[i]) * 1099511628211u;
  };
  const std::function<void(const Value&)> value = [&](const Value& v) {
    take(&v.kind, sizeof v.kind);
    if (v.kind == Value::Kind::number || v.kind == Value::Kind::truth) take(&v.number, sizeof v.number);
    take(v.text.data(), v.text.size());
    for (const Value& item : v.items) value(item);
  };
  const auto scope = [&](const Scope& variables) {
    for (const auto& [name, variable] : variables) {
      if (!variable.assigned) continue;
      take(name.data(), name.size() + 1);
      value(variable.value);
    }
  };
  scope(globals_);
  for (const Scope& variables : module_data_) scope(variables);
  if (with_locals)
    for (const Scope& variables : locals_) scope(variables);
  return sum;
}

/// The endless loop of a main program is one cycle of the motion; nothing can follow it.
Interpreter::Flow Interpreter::run_endless(const Statement& statement) {
  const bool leaves = holds_loop_exit(statement.branches[0].body);
  const std::size_t wanted = options_.passes > 0 ? options_.passes : assumed(statement.place) ? 1 : 0;
  const std::size_t before = program_.instructions.size();
  const long work_before = executed_;
  Round round(*this, statement.place);
  const Again again(*this, statement.branches[0].body);
  Passes passes(program_.instructions);
  while (true) {
    const std::size_t problems = problems_.count();
    const Flow flow = execute(statement.branches[0].body);
    if (flow != Flow::next) return flow == Flow::leave_loop ? Flow::next : flow;
    passes.add(state());
    round.again();
    if (problems_.count() > problems) {
      if (passes.count() > 1)
        problems_.hint(problems,
                       fmt::format("in pass {} of the loop in {}: --passes {} ends before", passes.count(),
                                   short_place(statement.place), passes.count() - 1));
      throw Stop{};
    }
    if (passes.count() == wanted || (!wanted && passes.repeats())) break;
    const bool searched = passes.count() >= searched_passes || executed_ - work_before > searched_work ||
                          program_.instructions.size() - before > searched_moves;
    if (!wanted && !leaves && searched) break;
  }
  if (!wanted && program_.instructions.size() == before) {
    const bool could_move = moves(statement, module_);
    note(statement.place,
         could_move
             ? "an endless loop that makes none of its moves: what it hangs on is written from outside; "
               "choose with --assume"
             : "an endless loop: what stands behind it is never run",
         could_move);
    throw Stop{};
  }
  const std::size_t kept = passes.kept(wanted);
  const bool cut = !wanted && !passes.repeats() && passes.by_motion() == 0;
  program_.instructions.resize(passes.end(kept));
  note(statement.place,
       fmt::format(
           "an endless loop, of which the motion is {}{}", passes_text(static_cast<long>(kept)),
           cut ? " (its passes differ and none repeats an earlier one; take more with --passes N)" : ""),
       cut);
  throw Stop{};
}

/// Runs the routine; true: it ended the program instead of itself.
bool Interpreter::ends_within(const Routine& routine) {
  within_itself_.emplace(program_.instructions);
  try {
    call(routine, {}, routine.place);
  } catch (const Stop&) {
    leave_all_routines();
    return true;
  } catch (const EndOfCycle&) {
    leave_all_routines();
  }
  return false;
}

void Interpreter::leave_all_routines() {
  locals_.resize(1);
  routines_.clear();
  loops_.clear();
  module_ = -1;
}

/// Single values that another task's module gives and this program writes, too: how tasks wait for each
/// other.
std::string Interpreter::shared_and_written() const {
  std::string names;
  for (const auto& [name, variable] : globals_)
    if (variable.datum && variable.datum->statement.elsewhere && variable.assigned &&
        variable.value.items.empty())
      names += (names.empty() ? "" : ", ") + name;
  return names;
}

/// A routine that begins again at its end: as an endless loop around it. What cannot be told of a later cycle
/// does not take away the first one.
void Interpreter::run_cycles(const Routine& routine) {
  const std::size_t wanted = options_.passes;
  const std::uint64_t state_before = state();
  const long work_before = executed_;
  const Again again(*this, routine.body);
  Passes passes(program_.instructions);
  while (true) {
    const Problems told = problems_;
    const bool ended = ends_within(routine);
    constexpr std::size_t few_moves = 2;  // make no motion
    const bool one_cycle = passes.count() > 0 && passes.end(passes.count()) >= few_moves;
    if (problems_.count() > told.count() && one_cycle && !passes.only_lines_of_the_first())
      return problems_.hint(told.count(), fmt::format("in pass {} of {}: --passes {} ends before",
                                                      passes.count() + 1, routine.written, passes.count()));
    if (problems_.count() > told.count() && one_cycle) {
      const Problem& first = problems_.list()[told.count()];
      const std::string why = fmt::format("{} ({})", first.what, first.where.text());
      problems_ = told;
      const std::size_t kept = passes.by_motion() ? passes.by_motion() : 1;
      program_.instructions.resize(passes.end(kept));
      return note(routine.place,
                  fmt::format("{} begins again at its end, and its next cycle {}; the motion is {}",
                              routine.written, why, passes_text(static_cast<long>(kept))),
                  true);
    }
    if (ended || problems_.count() > told.count()) return;
    passes.add(state());
    if (passes.count() == 1 && wanted <= 1 && state() == state_before) return;
    if (passes.count() == wanted || (!wanted && passes.repeats())) break;
    if (!wanted && (passes.count() >= searched_passes || executed_ - work_before > searched_work ||
                    program_.instructions.size() > searched_moves))
      break;
  }
  const std::size_t last = passes.count();
  if (!wanted && passes.repeats() && passes.end(last) == passes.end(last - 1))
    if (const std::string shared = shared_and_written(); !shared.empty())
      note(routine.place,
           fmt::format("{} ends in passes without a move, and another task may write what has no value here "
                       "({}): choose with --assume what it decides",
                       routine.written, shared),
           true);
  const std::size_t kept = passes.kept(wanted);
  const bool cut = !wanted && !passes.repeats() && passes.by_motion() == 0;
  program_.instructions.resize(passes.end(kept));
  if (kept > 1 || cut)
    note(routine.place,
         fmt::format(
             "{} begins again at its end; the motion is {}{}", routine.written,
             passes_text(static_cast<long>(kept)),
             cut ? " (its passes differ and none repeats an earlier one; take more with --passes N)" : ""),
         cut);
}

bool Interpreter::present(const Expression& argument) {
  return argument.kind != Expression::Kind::name || find(argument.text) != nullptr;
}

void Interpreter::run_instruction(const Statement& statement) {
  if (statement.name == late_binding) return run_late(statement);
  if (const Routine* routine = routine_named(statement.name, statement.place)) {
    call(*routine, statement.arguments, statement.place);
    return;
  }
  charge(instruction_work);
  if (dialect_.instruction(statement, *this)) return;
  forget_arguments(statement.name, statement.arguments, statement.place);
  if (dialect_.harmless(statement.name))
    note(statement.place, statement.text + ": input, output or logic");
  else
    note(statement.place, statement.text + ": not a routine of the files read and not a known instruction",
         true);
}

/// %"step" + ValToStr(n)% x: the name is worked out.
void Interpreter::run_late(const Statement& statement) {
  const Value name = evaluate(statement.arguments[0]);
  if (name.kind != Value::Kind::text) {
    const std::string value = remedy_for(name);
    complain(statement.place, "runs a routine whose name is known only while the robot runs" + because(name),
             value.empty() ? "write its name" : "give " + value);
    return;
  }
  run_named(name.text, {statement.arguments.begin() + 1, statement.arguments.end()}, statement.place);
}

void Interpreter::run_named(const std::string& name, const std::vector<Expression>& arguments,
                            const Place& place) {
  const std::string lower = lower_case(name);
  if (const Routine* routine = routine_named(lower.substr(lower.find(':') + 1), place)) {
    call(*routine, arguments, place);
    return;
  }
  forget_arguments(lower, arguments, place);
  note(place, name + ": not a routine of the files read and not a known instruction", true);
}

/// What an instruction that is left out may write to is unknown from here on.
void Interpreter::forget_arguments(const std::string& name, const std::vector<Expression>& arguments,
                                   const Place& place) {
  int position = 0;
  for (const Expression& argument : arguments) {
    const int at = argument.option.empty() ? position++ : -1;
    if (dialect_.writes(name, at, argument))
      make_unknown(argument, {"", fmt::format("may be written by {} ({})", name, short_place(place))});
  }
}

/// What two files have in common is told once for the two.
std::string Interpreter::rivals(const Place& a, const Place& b) const {
  return fmt::format("{} and {}", code_.files[a.file].name(), code_.files[b.file].name());
}

/// The routine of a name, at its use; null: there is none.
const Routine* Interpreter::routine_named(const std::string& name, const Place& place) {
  const Routine* routine = code_.find(name, module_);
  if (!routine) return nullptr;
  if (const Routine* rival = code_.rival(*routine))
    miss(rivals(routine->place, rival->place), place,
         fmt::format("runs '{}', which stands both in {} and in {}", routine->written,
                     where(routine->place).text(), where(rival->place).text()),
         "leave one of the two files out");
  return routine;
}

void Interpreter::declare(const Statement& statement) {
  if (statement.arguments[0].kind == Expression::Kind::none)
    for (const Parameter& parameter : routines_.back()->parameters)
      if (parameter.name == statement.name) return declare_parameter(statement);
  locals_.back().insert_or_assign(statement.name, Variable{.state = Variable::State::ready,
                                                           .value = declared_value(statement),
                                                           .written = statement.place});
}

/// KRL declares its parameters' types inside the routine.
void Interpreter::declare_parameter(const Statement& statement) {
  const auto given = locals_.back().find(statement.name);
  if (given == locals_.back().end() || statement.arguments.size() > 1) return;
  Value typed = dialect_.initial(statement.text);
  dialect_.store(typed, std::move(given->second.value));
  given->second.value = std::move(typed);
}

Value Interpreter::declared_value(const Statement& statement) {
  const RecordType* type = dialect_.type_of(statement.text);
  const Expression& written = statement.arguments[0];
  if (written.kind != Expression::Kind::none) {
    Value value = evaluate(written);
    if (type && statement.arguments.size() == 1 && value.kind == Value::Kind::list && !shape(value, type))
      complain(written.place,
               fmt::format("has not the {} components of a {}", type->fields.size(), type->name),
               "write all of them");
    if (statement.arguments.size() > 1) {
      if (type) shape_elements(value, type, statement.arguments.size() - 1);
      return value;
    }
    Value stored = dialect_.initial(statement.text);
    dialect_.store(stored, std::move(value));
    return stored;
  }
  Value value = dialect_.initial(statement.text);
  double count = 1;
  for (std::size_t i = statement.arguments.size(); i-- > 1;) {
    const double size = number(statement.arguments[i]).value_or(0);
    count *= size;
    if (!(size >= 1) || !(count * static_cast<double>(value.weight()) <= ImportLimits::values)) return {};
    charge(static_cast<std::size_t>(count));
    value = list_value(std::vector<Value>(static_cast<std::size_t>(size), value));
  }
  if (!statement.elsewhere) return value;
  static const std::string why = "is a PERS without a value here: another task's module gives it";
  return forgotten(std::move(value), std::make_shared<const Cause>(Cause{statement.name, why}));
}

/// Of an array: a list of so many levels.
void Interpreter::shape_elements(Value& value, const RecordType* type, std::size_t levels) const {
  if (levels == 0 || value.kind != Value::Kind::list) {
    shape(value, type);
    return;
  }
  for (Value& item : value.items) shape_elements(item, type, levels - 1);
}

/// The parameter that an argument goes to, by its name or as the next; null: there is none.
const Parameter* Interpreter::parameter_of(const Routine& routine, const Expression& argument,
                                           std::size_t& position) {
  if (!argument.option.empty()) {
    for (const Parameter& parameter : routine.parameters)
      if (parameter.name == argument.option) return &parameter;
    return nullptr;
  }
  while (position < routine.parameters.size() && routine.parameters[position].option) ++position;
  return position < routine.parameters.size() ? &routine.parameters[position++] : nullptr;
}

Value Interpreter::call(const Routine& routine, const std::vector<Expression>& arguments,
                        const Place& place) {
  if (&routine == started_ && !routines_.empty()) call_within_itself(routine);
  if (static_cast<int>(routines_.size()) >= ImportLimits::calls) {
    if (within_itself_->by_motion() > 0) end_within_itself(*started_);  // its data count, its motion repeats
    complain(place,
             fmt::format("calls {} {} routines deep (without end?)", routine.written, ImportLimits::calls),
             "mend the recursion");
    throw Stop{};
  }
  for (const Problem& problem : routine.problems)
    problems_.add(problem.where, problem.what, problem.remedy, routine.written);
  tell_handler(routine);
  Scope variables;
  std::vector<std::pair<const Parameter*, const Expression*>> given;
  std::size_t position = 0;
  for (const Expression& argument : arguments) {
    if (argument.if_present && !present(argument)) continue;
    const Parameter* parameter = parameter_of(routine, argument, position);
    if (!parameter) {
      complain(argument.place, fmt::format("is no argument that {} takes", routine.written), "mend the call");
      continue;
    }
    Variable& variable = variables[parameter->name];
    variable.state = Variable::State::ready;
    variable.value = argument.kind == Expression::Kind::none ? truth_value(true) : evaluate(argument);
    variable.written = origin(argument);
    if (parameter->given_back) given.emplace_back(parameter, &argument);
  }
  const int module = std::exchange(module_, routine.module);
  routines_.push_back(&routine);
  locals_.push_back(std::move(variables));
  result_ = Value{};
  const Flow flow = execute_routine(routine);
  const Value result =
      flow == Flow::give_back
          ? result_
          : unknown_value(
                "", fmt::format("is given back by '{}' behind a branch that is undecided", routine.written));
  variables = std::move(locals_.back());
  locals_.pop_back();
  routines_.pop_back();
  module_ = module;
  for (const auto& [parameter, argument] : given)
    if (argument->kind == Expression::Kind::name || argument->kind == Expression::Kind::field ||
        argument->kind == Expression::Kind::element)
      assign(*argument, variables[parameter->name].value);
  return result;
}

/// Where main is called again with the data as they were at an earlier call, or where its motion repeats, it
/// is called for ever: that is a cycle, and nothing behind the calls is ever run.
void Interpreter::call_within_itself(const Routine& routine) {
  Passes& passes = *within_itself_;
  constexpr bool with_locals = false;  // those of the calls around are never seen again
  passes.add(state(with_locals));
  const auto wanted = static_cast<std::size_t>(options_.passes);
  if (wanted ? passes.count() >= wanted : passes.repeats()) end_within_itself(routine);
}

void Interpreter::end_within_itself(const Routine& routine) {
  const std::size_t kept = within_itself_->kept(static_cast<std::size_t>(options_.passes));
  program_.instructions.resize(within_itself_->end(kept));
  note(routine.place, fmt::format("{} is called within itself for ever; the motion is {}", routine.written,
                                  passes_text(static_cast<long>(kept))));
  throw Stop{};
}

// ---- what a branch may do ---------------------------------------------------------------------------------

/// A function of the program may move the robot before it gives back its value.
bool Interpreter::moves(const Expression& expression, int module) {
  const Routine* called =
      expression.kind == Expression::Kind::call ? code_.find(expression.text, module) : nullptr;
  return (called && moves(*called)) ||
         std::any_of(expression.items.begin(), expression.items.end(),
                     [&](const Expression& item) { return moves(item, module); });
}

bool Interpreter::moves(const Statement& statement, int module) {
  const auto in_any = [&](const std::vector<Expression>& expressions) {
    return std::any_of(expressions.begin(), expressions.end(),
                       [&](const Expression& expression) { return moves(expression, module); });
  };
  if (in_any(statement.arguments)) return true;
  if (statement.kind == Kind::instruction) {
    const Routine* routine = code_.find(statement.name, module);
    if (routine ? moves(*routine) : statement.name == late_binding || dialect_.matters(statement.name))
      return true;
  }
  return std::any_of(statement.branches.begin(), statement.branches.end(), [&](const Branch& branch) {
    return in_any(branch.conditions) ||
           std::any_of(branch.body.begin(), branch.body.end(),
                       [&](const Statement& inner) { return moves(inner, module); });
  });
}

bool Interpreter::moves(const Routine& routine) {
  const auto [known, is_new] = routine_moves_.emplace(&routine, false);  // a recursion adds nothing
  if (is_new)
    known->second = std::any_of(routine.body.begin(), routine.body.end(),
                                [&](const Statement& inner) { return moves(inner, routine.module); });
  return known->second;
}

/// Whether it makes a difference to the motion how an undecided statement goes: it moves the robot, or it
/// leaves a loop, jumps or returns in a routine that does. A branch that ends the program is none of its
/// cycle.
bool Interpreter::matters(const Statement& statement) {
  return moves(statement, module_) || (leaves(statement, false) && moves(*routines_.back()));
}

/// Somewhere in it time passes, and nothing moves.
bool Interpreter::only_waits(const std::vector<Statement>& body) const {
  return std::any_of(body.begin(), body.end(), [&](const Statement& statement) {
    return (statement.kind == Kind::instruction && dialect_.only_waits(statement.name)) ||
           std::any_of(statement.branches.begin(), statement.branches.end(),
                       [&](const Branch& branch) { return only_waits(branch.body); });
  });
}

/// However often it runs, the robot stands and the program's data are as before, but for what an instruction
/// of input writes.
bool Interpreter::changes_nothing(const Statement& statement, int module, int depth) {
  constexpr int deepest = 4;  // calls
  charge(1);
  if (depth > deepest || moves(statement, module) || leaves(statement, false)) return false;
  switch (statement.kind) {
    case Kind::assign: {  // KRL's outputs
      const std::string& name = base_name(statement.arguments[0]);
      const Expression::Kind value = statement.arguments[1].kind;
      return (name == "$out" || name == "$anout") &&
             (value == Expression::Kind::truth || value == Expression::Kind::number);
    }
    case Kind::count:
    case Kind::finish:
    case Kind::end_cycle:
    case Kind::label:
      return false;
    case Kind::instruction: {
      const Routine* routine = code_.find(statement.name, module);
      return routine ? changes_nothing(routine->body, routine->module, depth + 1)
                     : dialect_.only_waits(statement.name) || dialect_.harmless(statement.name);
    }
    default:
      return std::all_of(statement.branches.begin(), statement.branches.end(),
                         [&](const Branch& branch) { return changes_nothing(branch.body, module, depth); });
  }
}

bool Interpreter::changes_nothing(const std::vector<Statement>& body, int module, int depth) {
  return std::all_of(body.begin(), body.end(),
                     [&](const Statement& statement) { return changes_nothing(statement, module, depth); });
}

/// A handler runs on an error alone. What it may move is told once.
void Interpreter::tell_handler(const Routine& routine) {
  if (routine.handler_words.empty() || !told_handlers_.insert(&routine).second) return;
  const bool may_move =
      std::any_of(routine.handler_words.begin(), routine.handler_words.end(), [&](const std::string& word) {
        const Routine* called = code_.find(word, routine.module);
        return called ? moves(*called) : dialect_.matters(word);
      });
  if (may_move)
    note(routine.handler,
         routine.written + ": its handler of errors moves the robot; errors are taken not to happen");
}

/// All that the statements may write to is unknown from here on.
void Interpreter::forget_assigned(const std::vector<Statement>& body, const Cause& why,
                                  std::set<const Routine*>& done) {
  for (const Statement& statement : body) {
    charge(1);
    if (statement.kind == Kind::assign) make_unknown(statement.arguments[0], why);
    if (statement.kind == Kind::count && statement.keeps_counter) make_unknown(counter_of(statement), why);
    if (statement.kind == Kind::instruction) forget_written(statement, why, done);
    for (const Branch& branch : statement.branches) forget_assigned(branch.body, why, done);
  }
}

void Interpreter::forget_writes_of(const Statement& call, int module, const std::string& why) {
  std::set<const Routine*> done;
  const int here = std::exchange(module_, module);
  forget_written(call, {"", why}, done);
  module_ = here;
}

/// Of a call: what the routine assigns to data outside of it, and the arguments that it gives back.
void Interpreter::forget_written(const Statement& statement, const Cause& why,
                                 std::set<const Routine*>& done) {
  const Routine* routine = code_.find(statement.name, module_);
  std::size_t position = 0;
  for (const Expression& argument : statement.arguments) {
    const int at = static_cast<int>(position);
    const Parameter* parameter = routine ? parameter_of(*routine, argument, position) : nullptr;
    if (!routine && argument.option.empty()) ++position;
    const bool written = routine
                             ? parameter && parameter->given_back
                             : dialect_.writes(statement.name, argument.option.empty() ? at : -1, argument);
    if (written) make_unknown(argument, why);
  }
  if (!routine || !done.insert(routine).second) return;
  Scope own;  // names of the routine hide those outside
  for (const Parameter& parameter : routine->parameters) own[parameter.name].state = Variable::State::ready;
  for (const Statement& inner : routine->body)
    if (inner.kind == Kind::declare) own[inner.name].state = Variable::State::ready;
  const int module = std::exchange(module_, routine->module);
  locals_.push_back(std::move(own));
  forget_assigned(routine->body, why, done);
  locals_.pop_back();
  module_ = module;
}

/// Whether a statement may go elsewhere than behind itself, within the program.
bool Interpreter::leaves(const Statement& statement, bool in_loop) const {
  if (statement.kind == Kind::give_back || statement.kind == Kind::jump) return true;
  if (statement.kind == Kind::leave_loop) return !in_loop;
  const bool loop = in_loop || (statement.kind != Kind::branch && statement.kind != Kind::choose);
  return std::any_of(statement.branches.begin(), statement.branches.end(), [&](const Branch& branch) {
    return std::any_of(branch.body.begin(), branch.body.end(),
                       [&](const Statement& inner) { return leaves(inner, loop); });
  });
}

bool Interpreter::holds_loop_exit(const std::vector<Statement>& body) const {
  for (const Statement& statement : body) {
    if (statement.kind == Kind::leave_loop || statement.kind == Kind::give_back ||
        statement.kind == Kind::jump || statement.kind == Kind::finish || statement.kind == Kind::end_cycle)
      return true;
    if (statement.kind != Kind::branch && statement.kind != Kind::choose) continue;
    for (const Branch& branch : statement.branches)
      if (holds_loop_exit(branch.body)) return true;
  }
  return false;
}

}  // namespace dresslife::sim
