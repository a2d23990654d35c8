// Possible effects of statements on the robot and on data, found without running them.
#include <algorithm>
#include <functional>
#include <utility>

#include "sim/program/interpreter/interpreter.h"

namespace dresslife::sim {
namespace {

using Kind = Statement::Kind;

}  // namespace

/// Whether the evaluation of an expression moves the robot: a function of the program may do this.
bool Interpreter::moves(const Expression& expression, int module) {
  const Routine* called = expression.kind == Expression::Kind::call ? code_.find(expression.text, module) : nullptr;
  return (called && moves(*called)) ||
         std::ranges::any_of(expression.items, [&](const Expression& item) { return moves(item, module); });
}

bool Interpreter::moves(const Statement& statement, int module) {
  const auto in_any = [&](const std::vector<Expression>& expressions) {
    return std::ranges::any_of(expressions, [&](const Expression& expression) { return moves(expression, module); });
  };
  if (in_any(statement.arguments)) return true;
  if (statement.kind == Kind::instruction) {
    const Routine* routine = code_.find(statement.name, module);
    if (routine ? moves(*routine) : statement.name == late_binding || dialect_.matters(statement.name)) return true;
  }
  return std::ranges::any_of(statement.branches, [&](const Branch& branch) {
    return in_any(branch.conditions) ||
           std::ranges::any_of(branch.body, [&](const Statement& inner) { return moves(inner, module); });
  });
}

bool Interpreter::moves(const Routine& routine) {
  const auto [known, is_new] = routine_moves_.emplace(&routine, false);  // false ends a recursion
  if (is_new)
    known->second =
        std::ranges::any_of(routine.body, [&](const Statement& inner) { return moves(inner, routine.module); });
  return known->second;
}

/// Whether the arm of an undecided statement affects the motion: the statement moves the robot, or it leaves a loop,
/// jumps or returns in a routine that moves the robot. A branch that ends the program does not belong to the cycle.
bool Interpreter::matters(const Statement& statement) {
  return moves(statement, module_) || (leaves(statement, false) && moves(*routines_.back()));
}

/// Whether the statements, or their branches, contain a wait.
bool Interpreter::only_waits(const std::vector<Statement>& body) const {
  return std::ranges::any_of(body, [&](const Statement& statement) {
    return (statement.kind == Kind::instruction && dialect_.only_waits(statement.name)) ||
           std::ranges::any_of(statement.branches, [&](const Branch& branch) { return only_waits(branch.body); });
  });
}

/// Whether a statement, run any number of times, moves nothing and keeps the program's data. Data that an
/// input instruction writes are an exception.
bool Interpreter::changes_nothing(const Statement& statement, int module, int depth) {
  constexpr int deepest = 4;  // levels of nested calls
  charge(1);
  if (depth > deepest || moves(statement, module) || leaves(statement, false)) return false;
  switch (statement.kind) {
    case Kind::assign: {  // KRL writes outputs by assignment
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
      return std::ranges::all_of(statement.branches,
                                 [&](const Branch& branch) { return changes_nothing(branch.body, module, depth); });
  }
}

bool Interpreter::changes_nothing(const std::vector<Statement>& body, int module, int depth) {
  return std::ranges::all_of(body,
                             [&](const Statement& statement) { return changes_nothing(statement, module, depth); });
}

/// Reports once that a routine's error handler may move the robot. A handler runs only after an error.
void Interpreter::report_handler(const Routine& routine) {
  if (routine.handler_words.empty() || !reported_handlers_.insert(&routine).second) return;
  const bool may_move = std::ranges::any_of(routine.handler_words, [&](const std::string& word) {
    const Routine* called = code_.find(word, routine.module);
    return called ? moves(*called) : dialect_.matters(word);
  });
  if (may_move)
    note(routine.handler, routine.written + ": its handler of errors moves the robot; errors are taken not to happen");
}

/// Makes all data unknown that the statements may write to.
void Interpreter::forget_assigned(const std::vector<Statement>& body, const Cause& why,
                                  std::set<const Routine*>& done) {
  for (const Statement& statement : body) {
    charge(1);
    if (statement.kind == Kind::assign) make_unknown(statement.arguments[0], why);
    if (statement.kind == Kind::count && statement.keeps_counter)
      make_unknown(name_at(statement.name, statement.place), why);
    if (statement.kind == Kind::instruction) {
      dialect_.may_have_run(statement, why);
      forget_written(statement, why, done);
    }
    for (const Branch& branch : statement.branches) forget_assigned(branch.body, why, done);
  }
}

void Interpreter::forget_writes_of(const Statement& call, int module, const std::string& why) {
  std::set<const Routine*> done;
  const int here = std::exchange(module_, module);
  forget_written(call, {"", why}, done);
  module_ = here;
}

/// Makes all data unknown that a call may write to: data outside of the routine, and its returned arguments.
void Interpreter::forget_written(const Statement& statement, const Cause& why, std::set<const Routine*>& done) {
  const Routine* routine = code_.find(statement.name, module_);
  std::size_t position = 0;
  for (const Expression& argument : statement.arguments) {
    const int at = static_cast<int>(position);
    const Parameter* parameter = routine ? parameter_of(*routine, argument, position) : nullptr;
    if (!routine && argument.option.empty()) ++position;
    const bool written = routine ? parameter && parameter->given_back
                                 : dialect_.writes(statement.name, argument.option.empty() ? at : -1, argument);
    if (written) make_unknown(argument, why);
  }
  if (!routine || !done.insert(routine).second) return;
  Scope own;  // names of the routine hide outer names
  for (const Parameter& parameter : routine->parameters) own[parameter.name].state = Variable::State::ready;
  for (const Statement& inner : routine->body)
    if (inner.kind == Kind::declare) own[inner.name].state = Variable::State::ready;
  const int module = std::exchange(module_, routine->module);
  locals_.push_back(std::move(own));
  forget_assigned(routine->body, why, done);
  locals_.pop_back();
  module_ = module;
}

/// Whether a statement may jump, return or leave a loop. in_loop: a loop inside of the statement encloses it.
bool Interpreter::leaves(const Statement& statement, bool in_loop) const {
  if (statement.kind == Kind::give_back || statement.kind == Kind::jump) return true;
  if (statement.kind == Kind::leave_loop) return !in_loop;
  const bool loop = in_loop || (statement.kind != Kind::branch && statement.kind != Kind::choose);
  return std::ranges::any_of(statement.branches, [&](const Branch& branch) {
    return std::ranges::any_of(branch.body, [&](const Statement& inner) { return leaves(inner, loop); });
  });
}

/// Whether a statement of the program may write to data of this name. Each mention in an assignment or a call counts,
/// because a routine may return a value through its argument.
bool Interpreter::may_be_written(const std::string& name) {
  const auto [at, is_new] = written_.try_emplace(name);  // a loop may begin a thousand times, and the code is long
  if (!is_new) return at->second;
  const std::function<bool(const Expression&)> mentions = [&](const Expression& expression) {
    return (expression.kind == Expression::Kind::name && expression.text == name) ||
           std::ranges::any_of(expression.items, mentions);
  };
  const std::function<bool(const Statement&)> writes = [&](const Statement& statement) {
    charge(1);
    const bool takes = statement.kind == Kind::assign || statement.kind == Kind::instruction;
    return statement.name == name || (takes && std::ranges::any_of(statement.arguments, mentions)) ||
           std::ranges::any_of(statement.branches,
                               [&](const Branch& branch) { return std::ranges::any_of(branch.body, writes); });
  };
  return at->second = std::ranges::any_of(
             code_.routines, [&](const Routine& routine) { return std::ranges::any_of(routine.body, writes); });
}

/// Whether a condition of constants and of data that no statement may write to.
bool Interpreter::stays_the_same(const Expression& condition) {
  switch (condition.kind) {
    case Expression::Kind::truth:
    case Expression::Kind::number:
      return true;
    case Expression::Kind::name:
      return !may_be_written(condition.text);
    case Expression::Kind::unary:
    case Expression::Kind::binary:
      return std::ranges::all_of(condition.items, [&](const Expression& item) { return stays_the_same(item); });
    default:
      return false;
  }
}

bool Interpreter::holds_loop_exit(const std::vector<Statement>& body) const {
  for (const Statement& statement : body) {
    if (statement.kind == Kind::leave_loop || statement.kind == Kind::give_back || statement.kind == Kind::jump ||
        statement.kind == Kind::finish || statement.kind == Kind::end_cycle)
      return true;
    if (statement.kind != Kind::branch && statement.kind != Kind::choose) continue;
    for (const Branch& branch : statement.branches)
      if (holds_loop_exit(branch.body)) return true;
  }
  return false;
}

}  // namespace dresslife::sim
