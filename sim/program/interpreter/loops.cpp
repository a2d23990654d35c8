// Loops, backward jumps, and routines that start again at their end: number of passes, search for a repetition.
#include <algorithm>
#include <functional>

#include "sim/program/interpreter/interpreter.h"
#include "sim/program/interpreter/job_words.h"

namespace dresslife::sim {
namespace {

using Kind = Statement::Kind;

// Passes in the search for the repetition of an endless loop: enough for a pallet of 200 boxes.
constexpr int searched_passes = 200;

}  // namespace

/// Entry of a running loop in `loops_`; the destructor removes it.
struct Interpreter::Round {
  Round(Interpreter& run, const Place& place) : run_(run), at_(run.loops_.size()) { run.loops_.push_back({place}); }
  Round(const Round&) = delete;
  ~Round() { run_.loops_.resize(at_); }
  long again() {
    run_.charge(1);
    return ++run_.loops_[at_].passes;
  }
  Interpreter& run_;
  std::size_t at_;
};

namespace {

/// End criterion of passes that only search for further questions.
class Barren {
 public:
  explicit Barren(const Exploration& exploration) : exploration_(exploration), news_(exploration.news()) {}
  /// Counts a pass. Returns true if the last three passes found nothing new.
  bool again() {
    constexpr int enough = 3;
    count_ = exploration_.news() == news_ ? count_ + 1 : 0;
    news_ = exploration_.news();
    return count_ >= enough;
  }

 private:
  const Exploration& exploration_;
  long news_;
  int count_ = 0;
};

}  // namespace

/// Entry of a repeated body in `endless_`; the destructor removes it.
struct Interpreter::Again {
  Again(Interpreter& run, const std::vector<Statement>& body) : run_(run), at_(run.endless_.size()) {
    run.endless_.push_back(&body);
  }
  Again(const Again&) = delete;
  ~Again() { run_.endless_.resize(at_); }
  Interpreter& run_;
  std::size_t at_;
};

Interpreter::Flow Interpreter::execute(const std::vector<Statement>& body) {
  std::optional<Round> round;            // loop of backward jumps
  std::map<std::size_t, Passes> passes;  // index of a label -> passes from the label back to it
  for (std::size_t i = 0; i < body.size(); ++i) {
    if (body[i].kind == Kind::label) passes.try_emplace(i, program_.instructions);
    const Flow flow = execute(body[i]);
    if (flow == Flow::next) continue;
    if (flow != Flow::jump) return flow;
    const auto label = std::ranges::find_if(body, [&](const Statement& statement) {
      return statement.kind == Kind::label && statement.name == jump_->name;
    });
    if (label == body.end()) return flow;  // the label is in an enclosing block
    const auto target = static_cast<std::size_t>(label - body.begin());
    if (target <= i) {
      if (!round) round.emplace(*this, jump_->place);
      const long count = round->again();
      const bool for_ever = jumps_for_ever(body, target, i);
      const bool asks = problems_.count() > 0 || exploration_.guessing();  // one pass finds its questions
      if (for_ever && (options_.passes > 0 ? count >= options_.passes : asks)) {
        note(jump_->place, "an endless loop; the motion is " + passes_text(count));
        throw Stop{};
      }
      end_where_it_repeats(passes.try_emplace(target, program_.instructions).first->second, jump_->place, for_ever);
    }
    charge(1);
    i = target;
  }
  return Flow::next;
}

/// Returns words on why later passes of an endless loop may differ from those that are kept. wanted: the user's number of
/// passes, 0: none.
std::string Interpreter::doubt_about(const Passes& passes, std::size_t wanted) const {
  if (wanted > 0 || passes.repeats()) return "";
  const std::string reason =
      passes.by_motion() == 0
          ? fmt::format("; its passes differ, and no pass repeats an earlier one within {} passes, so ", passes.count())
          : same_arm_in_all(passes);
  return reason.empty() ? "" : reason + later_passes_differ;
}

void Interpreter::end_pass(Passes& passes, bool with_locals) {
  passes.add(state(with_locals));
  ++pass_;
}

/// At a backward jump: ends the program if the data equal those at an earlier jump, because everything then repeats. A
/// jump that loops forever (for_ever) also ends it after a long search: a counter never returns to an earlier value.
void Interpreter::end_where_it_repeats(Passes& passes, const Place& place, bool for_ever) {
  if (passes.count() >= searched_passes) return;
  end_pass(passes);
  const auto wanted = static_cast<std::size_t>(options_.passes);
  const bool repeats = passes.repeats();
  const bool searched = passes.count() >= searched_passes || executed_ > ImportLimits::searched_work ||
                        program_.instructions.size() > ImportLimits::searched_moves;
  if (!(repeats || (for_ever && searched)) || passes.count() < wanted) return;
  const std::size_t kept = passes.kept(wanted);
  const std::string doubt = doubt_about(passes, wanted);
  program_.instructions.resize(passes.end(kept));
  note(place, fmt::format("an endless loop; the motion is {}{}", passes_text(static_cast<long>(kept)), doubt),
       !doubt.empty());
  throw Stop{};
}

/// Whether a jump loops forever: it is a statement of `body` itself, and no statement from its label on leaves the loop.
bool Interpreter::jumps_for_ever(const std::vector<Statement>& body, std::size_t label, std::size_t jump) const {
  if (body[jump].kind != Kind::jump) return false;  // the jump is in an arm of a branch
  const std::vector<Statement> round(body.begin() + static_cast<long>(label), body.begin() + static_cast<long>(jump));
  return !holds_loop_exit(round);
}

Interpreter::Flow Interpreter::run_count(const Statement& statement) {
  std::optional<bool> decision = assumed(statement.place);
  const auto end_unknown = [&] {  // the counter's value after a loop with an unknown end
    if (statement.keeps_counter)
      make_unknown(name_at(statement.name, statement.place),
                   {"", "is the counter of the loop in " + short_place(statement.place)});
    return Flow::next;
  };
  if (decision && !*decision) return end_unknown();
  const auto from = number(statement.arguments[0]), to = number(statement.arguments[1]);
  const Expression& written_step = statement.arguments[2];
  std::optional<double> step = from && to && *to < *from ? -1 : 1;  // RAPID counts up or down without STEP
  if (written_step.kind != Expression::Kind::none) step = number(written_step);
  if (!decision && (!from || !to || !step || *step == 0)) {
    Value unknown;
    for (const Expression& bound : statement.arguments) unknown = unknown_value(unknown, evaluate(bound));
    if (!matters(statement) && !exploration_.follows(short_place(statement.place)))
      return leave_out(statement, unknown);
    decision =
        ask(statement.place, "counts to a number that is known only while the robot runs (then: one pass, else: none)",
            unknown, then_or_else, 2, true, "a number") == 0;
    if (!*decision) return end_unknown();
  }
  const double first = from.value_or(1), last = decision ? first : *to, by = decision ? 1 : *step;
  Scope& variables = locals_.back();
  const auto before = variables.find(statement.name);
  const std::optional<Variable> hidden = before == variables.end() ? std::nullopt : std::optional(before->second);
  const auto count = [&](double value) {
    if (statement.keeps_counter) {
      assign(name_at(statement.name, statement.place), number_value(value));
    } else {
      variables.insert_or_assign(statement.name, Variable{.state = Variable::State::ready,
                                                          .value = number_value(value),
                                                          .written = statement.place,
                                                          .counter = true});
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
    const Value counter = evaluate(name_at(statement.name, statement.place));  // the body may have changed it
    if (!counter.is_number()) {
      ask(statement.place, "counts with a variable that is known only while the robot runs", counter, then_or_else, 2,
          true, "a number");
      break;
    }
    value = counter.number + by;
  }
  if (statement.keeps_counter) {
    if (flow == Flow::next) decision ? static_cast<void>(end_unknown()) : count(value);
  } else if (hidden) {
    variables.insert_or_assign(statement.name, *hidden);
  } else {
    variables.erase(statement.name);
  }
  return flow == Flow::leave_loop ? Flow::next : flow;
}

Interpreter::Flow Interpreter::run_while(const Statement& statement) {
  std::optional<bool> decision = assumed(statement.place);
  const Expression& condition = statement.arguments[0];
  if (!decision && stays_the_same(condition)) {
    const Value always = evaluate(condition);
    if (always.known() && always.number != 0) return run_endless(statement);
  }
  Flow flow = Flow::next;
  Round round(*this, statement.place);
  while (flow == Flow::next) {
    if (decision && !*decision) break;
    if (!decision) {
      const Value go_on = evaluate(condition);
      if (!go_on.known()) {
        if (!matters(statement) && !exploration_.follows(short_place(statement.place)))
          return leave_out(statement, go_on);
        decision = ask(statement.place,
                       "repeats while a condition holds that is known only while the robot runs (then: one "
                       "pass, else: none)",
                       go_on, then_or_else, 2, compares_known(condition), "") == 0;
        if (!*decision) break;
      } else if (go_on.number == 0) {
        break;
      }
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
           "a loop that ends by a condition that is known only while the robot runs, of which one pass "
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

/// Returns a checksum of all assigned variables. with_locals: includes the variables of the running routines.
std::uint64_t Interpreter::state(bool with_locals) const {
  std::uint64_t sum = 14695981039346656037u;  // FNV-1a
  const auto take = [&](const void* bytes, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) sum = (sum ^ static_cast<const unsigned char*>(bytes)[i]) * 1099511628211u;
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

/// Runs the endless loop of a main program: the motion is its cycle. The program ends, because no statement follows.
Interpreter::Flow Interpreter::run_endless(const Statement& statement) {
  const bool leaves = holds_loop_exit(statement.branches[0].body);
  const std::size_t wanted = options_.passes > 0 ? options_.passes : assumed(statement.place) ? 1 : 0;
  const std::size_t before = program_.instructions.size();
  const long work_before = executed_;
  Round round(*this, statement.place);
  const Again again(*this, statement.branches[0].body);
  Passes passes(program_.instructions);
  const std::size_t problems = problems_.count();
  bool hinted = false;
  Barren barren(exploration_);
  while (true) {
    const Flow flow = execute(statement.branches[0].body);
    if (flow != Flow::next) return flow == Flow::leave_loop ? Flow::next : flow;
    end_pass(passes);
    round.again();
    if (problems_.count() > problems || exploration_.guessing()) {  // the questions of further passes are needed, too
      if (passes.count() > 1 && !hinted)
        problems_.hint(problems, fmt::format("in pass {} of the loop in {}: motion.passes: {} ends before",
                                             passes.count(), short_place(statement.place), passes.count() - 1));
      hinted = true;
      const bool mistaken = !exploration_.guessing() && problems_.mistakes() > 0;
      if (mistaken || barren.again() || (wanted && passes.count() >= wanted)) throw Stop{};
      continue;
    }
    if (passes.count() == wanted || (!wanted && passes.repeats())) break;
    const bool searched = passes.count() >= searched_passes || executed_ - work_before > ImportLimits::searched_work ||
                          program_.instructions.size() - before > ImportLimits::searched_moves;
    if (!wanted && !leaves && searched) break;
  }
  if (!wanted && program_.instructions.size() == before) {
    const bool could_move = moves(statement, module_);
    note(statement.place,
         could_move ? "an endless loop that makes none of its moves: what it depends on is written from outside; "
                      "choose with motion.assume"
                    : "an endless loop: the lines after it never run",
         could_move);
    throw Stop{};
  }
  const std::size_t kept = passes.kept(wanted);
  const std::string doubt = doubt_about(passes, wanted);
  program_.instructions.resize(passes.end(kept));
  note(statement.place, fmt::format("an endless loop; the motion is {}{}", passes_text(static_cast<long>(kept)), doubt),
       !doubt.empty());
  throw Stop{};
}

/// Runs the routine. Returns true if the routine ended the program.
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

/// Returns the names of single values that another task's module declares and this program writes. Tasks use them to
/// wait for each other.
std::string Interpreter::shared_and_written() const {
  std::string names;
  for (const auto& [name, variable] : globals_)
    if (variable.datum && variable.datum->statement.elsewhere && variable.assigned && variable.value.items.empty())
      names += (names.empty() ? "" : ", ") + name;
  return names;
}

/// Runs a routine that starts again at its end, like an endless loop around it. Problems in a later cycle do not
/// discard the first cycle.
void Interpreter::run_cycles(const Routine& routine) {
  const std::size_t wanted = options_.passes;
  const std::uint64_t state_before = state();
  const long work_before = executed_;
  const Again again(*this, routine.body);
  Passes passes(program_.instructions);
  Barren barren(exploration_);
  bool asking = false;
  while (true) {
    const Problems before = problems_;
    const bool ended = ends_within(routine);
    constexpr std::size_t few_moves = 2;  // fewer moves are not a cycle
    const bool one_cycle = passes.count() > 0 && passes.end(passes.count()) >= few_moves;
    if (!asking && problems_.count() > before.count() && one_cycle && !passes.only_lines_of_the_first()) {
      problems_.hint(before.count(), fmt::format("in pass {} of {}: motion.passes: {} ends before", passes.count() + 1,
                                                 routine.written, passes.count()));
      asking = true;
    }
    if (!asking && problems_.count() > before.count() && one_cycle) {
      const Problem& first = problems_.list()[before.count()];
      const std::string why = fmt::format("{} ({})", first.what, first.where.text());
      problems_ = before;
      const std::size_t kept = passes.by_motion() ? passes.by_motion() : 1;
      program_.instructions.resize(passes.end(kept));
      return note(routine.place,
                  fmt::format("{} begins again at its end, and its next cycle {}; the motion is {}", routine.written,
                              why, passes_text(static_cast<long>(kept))),
                  true);
    }
    asking |= problems_.count() > before.count() || exploration_.guessing();
    if (ended) return;
    end_pass(passes);
    if (asking) {  // the questions of later cycles are needed, too
      const bool mistaken = !exploration_.guessing() && problems_.mistakes() > 0;
      if (mistaken || barren.again() || (wanted && passes.count() >= wanted)) return;
      continue;
    }
    if (passes.count() == 1 && wanted <= 1 && state() == state_before) return;
    if (passes.count() == wanted || (!wanted && passes.repeats())) break;
    if (!wanted && (passes.count() >= searched_passes || executed_ - work_before > ImportLimits::searched_work ||
                    program_.instructions.size() > ImportLimits::searched_moves))
      break;
  }
  const std::size_t last = passes.count();
  if (!wanted && passes.repeats() && passes.end(last) == passes.end(last - 1))
    if (const std::string shared = shared_and_written(); !shared.empty())
      note(routine.place,
           fmt::format("{} ends in passes without a move, and another task may write what has no value here "
                       "({}): choose with motion.assume what it decides",
                       routine.written, shared),
           true);
  const std::size_t kept = passes.kept(wanted);
  const std::string doubt = doubt_about(passes, wanted);
  program_.instructions.resize(passes.end(kept));
  if (kept > 1 || !doubt.empty())
    note(routine.place,
         fmt::format("{} begins again at its end; the motion is {}{}", routine.written,
                     passes_text(static_cast<long>(kept)), doubt),
         !doubt.empty());
}

}  // namespace dresslife::sim
