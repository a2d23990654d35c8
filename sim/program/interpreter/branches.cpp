// Branches: choice of the arm, or a question to the user.
#include <algorithm>

#include "sim/program/interpreter/interpreter.h"
#include "sim/program/interpreter/job_words.h"
#include "sim/program/interpreter/tokens.h"

namespace dresslife::sim {
namespace {

using Kind = Statement::Kind;

}  // namespace

/// Returns the user's answer for a line, under any of the line's names; null: none.
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

/// Whether a condition contains a known variable that the program assigns, for example a counter.
bool Interpreter::compares_known(const Expression& condition) {
  if (condition.kind == Expression::Kind::name || condition.kind == Expression::Kind::element ||
      condition.kind == Expression::Kind::field) {
    const Variable* variable = base_of(condition);
    return variable && !is_constant(*variable) && variable->assigned && evaluate(condition).known();
  }
  return condition.kind != Expression::Kind::call &&
         std::ranges::any_of(condition.items, [&](const Expression& item) { return compares_known(item); });
}

/// Adds the values of the known variables in a condition that the program assigns.
void Interpreter::add_compared(const Expression& condition, std::vector<Value>& values) {
  if (condition.kind == Expression::Kind::call) return;
  for (const Expression& item : condition.items) add_compared(item, values);
  if (condition.items.empty() && compares_known(condition)) values.push_back(evaluate(condition));
}

/// Notes the arm of a decided branch. The number of arms means that it took none.
void Interpreter::take_arm(const Statement& statement, std::size_t arm) {
  const auto [at, is_new] = arms_.try_emplace(&statement);
  Arms& arms = at->second;
  if (is_new) {
    arms.first = arm;
    for (std::size_t other = 0; other < statement.branches.size(); ++other)
      arms.others_move |= other != arm && std::ranges::any_of(statement.branches[other].body,
                                                              [&](const Statement& of) { return moves(of, module_); });
  }
  if (!arms.others_move) return;
  arms.several |= arm != arms.first;
  if (arms.several || (!is_new && arms.pass == pass_)) return;
  arms.pass = pass_;
  std::vector<Value> compared;
  for (const Expression& argument : statement.arguments) add_compared(argument, compared);
  for (const Branch& branch : statement.branches)
    for (const Expression& condition : branch.conditions) add_compared(condition, compared);
  arms.changes += !is_new && compared != arms.compared;
  arms.compared = std::move(compared);
}

/// Returns the beginning of a sentence about a branch that took the same arm in all passes of a loop, although the values that it compares are
/// new in each pass: a later pass may take another arm. Empty: no such branch.
std::string Interpreter::same_arm_in_all(const Passes& passes) const {
  for (const auto& [statement, arms] : arms_)
    if (!arms.several && arms.changes > 1 && arms.changes + 2 >= passes.count())
      return fmt::format(
          "; {} compares a value that is new in each pass, and no pass of {} made the moves of its other arm, so ",
          short_place(statement->place), passes.count());
  return "";
}

namespace {

/// Returns the form of the value `asked` in a condition, from the value that it is compared with. Empty: not known.
std::string form_within(const Expression& condition, const std::string& asked) {
  using Is = Expression::Kind;
  if (condition.kind == Is::call) return lower_case(asked).starts_with(condition.text) ? "TRUE or FALSE" : "";
  const auto plain = [](const Expression& e) {
    return e.kind == Is::name || e.kind == Is::element || e.kind == Is::field;
  };
  const bool joins = condition.text == "and" || condition.text == "or" || condition.text == "not";
  if (plain(condition)) return "TRUE or FALSE";
  if (condition.kind == Is::unary && joins) return form_within(condition.items[0], asked);
  if (condition.kind != Is::binary) return "";
  if (joins) {
    const std::string first = form_within(condition.items[0], asked);
    const std::string second = form_within(condition.items[1], asked);
    return first == second ? first : "";
  }
  for (const Expression& side : condition.items) {
    if (side.kind == Is::truth) return "TRUE or FALSE";
    if (side.kind == Is::text) return "a text in double quotes";
    if (side.kind == Is::number) return "a number";
  }
  return "";
}

/// Returns "one of 1, 2, 5": the values of all cases.
std::string form_of_cases(const Interpreter& run, const Statement& choice) {
  std::string values;
  for (const Branch& branch : choice.branches)
    for (const Expression& value : branch.conditions) {
      std::string written = run.written(value);
      written.resize(written.find_last_not_of(": ") + 1);  // the ':' of RAPID's CASE 1:
      values += (values.empty() ? "" : ", ") + written;
    }
  return values.empty() ? "" : "one of " + values;
}

}  // namespace

/// Asks for the name that decides a statement, or for the arm itself. Returns the arm (0 .. ways - 1) for this reading.
int Interpreter::ask(const Place& place, const std::string& what, const Value& unknown, const std::string& answers,
                     int ways, bool by_value, const std::string& form) {
  const std::string line = short_place(place);
  const std::vector<const Cause*> causes = unknown.causes();
  std::vector<std::string> names;
  for (const Cause* cause : causes)
    if (!cause->asked().empty()) names.push_back(cause->asked());
  std::string values = names.empty() ? "" : values_of_job(names);
  const std::string about = values.empty() ? where(place).text() : answers + values;
  for (const Cause* cause : causes)
    if (cause->behind) values += ", or " + assume_of_job(cause->line);
  std::vector<Question> questions = questions_for(unknown, form);
  if (questions.empty() || (questions.size() > 1 && ways == 2) || !by_value)
    questions = {{Question::Kind::branch, line, ways == 2 ? "then or else" : form.empty() ? answers : form}};
  miss(about, place, what + because(unknown),
       fmt::format("choose with {}{}", assume_of_job(line, answers), values.empty() ? "" : ", or give " + values),
       std::move(questions), true);
  return guess(place, ways);
}

int Interpreter::guess(const Place& place, int ways) {
  if (guessed_at_ < 0) guessed_at_ = executed_;
  return exploration_.choose(fmt::format("{}:{}", place.file, place.line), ways);
}

Interpreter::Flow Interpreter::run_branch(const Statement& statement) {
  bool is_known = true;
  for (const Branch& branch : statement.branches) {
    if (branch.conditions.empty()) {
      if (is_known) take_arm(statement, static_cast<std::size_t>(&branch - statement.branches.data()));
      return execute(branch.body);
    }
    std::optional<bool> decision = assumed(branch.place);
    is_known &= !decision;
    Value condition;
    const std::size_t problems = problem_count();
    if (!decision) {
      condition = evaluate(branch.conditions[0]);
      if (condition.kind == Value::Kind::truth || condition.is_number()) decision = condition.number != 0;
    }
    if (!decision) {
      is_known = false;
      if (!matters(statement) && !exploration_.follows(short_place(statement.place)))
        return leave_out(statement, condition);
      if (const Branch* way = waited_for(statement)) return go_on(*way, condition);
      const Cause* cause = condition.first_cause();
      decision = problem_count() != problems  // the cause is reported already
                     ? guess(branch.place, 2) == 0
                     : ask(branch.place, "branches on a condition that is known only while the robot runs", condition,
                           then_or_else, 2, true, form_within(branch.conditions[0], cause ? cause->asked() : "")) == 0;
    }
    if (!*decision) continue;
    if (is_known) take_arm(statement, static_cast<std::size_t>(&branch - statement.branches.data()));
    return execute(branch.body);
  }
  if (is_known) take_arm(statement, statement.branches.size());
  return Flow::next;
}

Interpreter::Flow Interpreter::run_choice(const Statement& statement) {
  const Expression* chosen = answer(code_.choices, statement.place);
  const Value subject = evaluate(chosen ? *chosen : statement.arguments[0]);
  for (const Branch& branch : statement.branches) {
    const auto arm = static_cast<std::size_t>(&branch - statement.branches.data());
    if (branch.conditions.empty()) {
      take_arm(statement, arm);
      return execute(branch.body);
    }
    const std::optional<bool> decision = assumed(branch.place);
    if (decision ? *decision : false) return execute(branch.body);
    if (decision) continue;
    for (const Expression& condition : branch.conditions) {
      const Value value = evaluate(condition);
      if (!subject.known() || !value.known()) {
        const Value& unknown = subject.known() ? value : subject;
        if (!matters(statement) && !exploration_.follows(short_place(statement.place)))
          return leave_out(statement, unknown);
        if (const Branch* way = waited_for(statement)) return go_on(*way, unknown);
        const int ways = static_cast<int>(statement.branches.size());
        const int way = ask(statement.place, "chooses by a value that is known only while the robot runs", unknown,
                            "VALUE, the value that it then has", ways + 1, true, form_of_cases(*this, statement));
        return way < ways ? execute(statement.branches[way].body) : Flow::next;
      }
      if (value != subject) continue;
      take_arm(statement, arm);
      return execute(branch.body);
    }
  }
  take_arm(statement, statement.branches.size());
  return Flow::next;
}

/// Skips an undecided branch that does not move the robot: the variables that it assigns become unknown.
Interpreter::Flow Interpreter::leave_out(const Statement& statement, const Value& unknown) {
  const std::string line = short_place(statement.place);
  const std::shared_ptr<const Cause> cause = unknown_value(unknown).cause;
  ++quiet_;  // no problems about indices in statements that may not run
  const bool waits =
      std::ranges::any_of(statement.branches, [&](const Branch& branch) { return only_waits(branch.body); });
  note(statement.place,
       fmt::format("branch {}{}: known only while the robot runs", waits ? "that waits" : "without moves",
                   cause ? fmt::format(" on '{}'", cause->name) : ""));
  // If one name decides the branch, the question is that name, else the branch.
  const bool alone = cause && cause->others.empty();
  Cause why{"", "depends on the branch in " + line, line,
            alone && cause->behind ? cause->behind
            : alone                ? cause
                                   : nullptr};
  if (!why.behind || why.behind->name.empty()) why.behind = nullptr;
  std::set<const Routine*> done;
  if (statement.kind == Kind::count && statement.keeps_counter)
    make_unknown(name_at(statement.name, statement.place), why);
  for (const Branch& branch : statement.branches) forget_assigned(branch.body, why, done);
  const bool goes = leaves(statement, false);
  // The rest of the routine may run or not. It does not move the robot (see matters()).
  if (goes) forget_assigned(routines_.back()->body, why, done);
  --quiet_;
  if (!goes) return Flow::next;
  result_ = unknown_value(std::move(why));
  return Flow::give_back;
}

/// Returns the only arm of an undecided statement that moves the robot, if the rest of its endless loop has no
/// effect: the loop waits for this arm, like WaitUntil. Null: the arms give different motions.
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
  return condition.kind == Value::Kind::truth && condition.number == 0 ? nullptr
                                                                       : way;  // the condition is always false
}

Interpreter::Flow Interpreter::go_on(const Branch& way, const Value& unknown) {
  const Cause* cause = unknown.first_cause();
  note(way.place, fmt::format("the robot waits{} (its loop makes no other move), and the way on is taken",
                              cause && !cause->name.empty() ? fmt::format(" for '{}'", cause->name) : ""));
  return execute(way.body);
}

}  // namespace dresslife::sim
