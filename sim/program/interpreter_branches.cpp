// Branches: which arm, or whom to ask.
#include <algorithm>

#include "sim/program/interpreter.h"

namespace dresslife::sim {
namespace {

using Kind = Statement::Kind;

}  // namespace

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

}  // namespace dresslife::sim
