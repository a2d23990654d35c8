// Instructions, calls of routines, and declarations.
#include <algorithm>
#include <utility>

#include "sim/program/interpreter/interpreter.h"
#include "sim/program/interpreter/tokens.h"

namespace dresslife::sim {
namespace {

constexpr std::size_t instruction_work = 10;  // work of a move, in statements

}  // namespace

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
  if (dialect_.instruction(statement)) return;
  if (const std::string meant = dialect_.move_meant(statement); !meant.empty() && !dialect_.harmless(statement.name)) {
    complain(
        statement.place,
        fmt::format("runs '{}', which is neither an instruction nor a routine of the files read", statement.text),
        fmt::format("did you mean {}? Else give the module that declares it, too (motion.modules: [{{file: FILE}}])",
                    meant));
    return;
  }
  forget_arguments(statement.name, statement.arguments, statement.place);
  if (dialect_.harmless(statement.name))
    note(statement.place, statement.text + ": input, output or logic");
  else
    note(statement.place, statement.text + ": not a routine of the files read and not a known instruction", true);
}

/// Whether a call by a computed name, with this number of arguments, can start a routine that moves the robot. Routines
/// that already run do not count.
bool Interpreter::is_command(const Routine& routine, std::size_t arguments) {
  const auto needed = std::ranges::count_if(routine.parameters, [](const Parameter& p) { return !p.option; });
  const bool runs = std::ranges::find(routines_, &routine) != routines_.end();
  return !routine.local && !runs && &routine != started_ && static_cast<std::size_t>(needed) == arguments &&
         moves(routine) && code_.find(routine.name, module_) == &routine;
}

/// Runs a call by a computed name: %"step" + ValToStr(n)% x.
void Interpreter::run_late(const Statement& statement) {
  const Value name = evaluate(statement.arguments[0]);
  if (name.kind != Value::Kind::text) {
    // A server of messages: its commands are the routines that it may run. The missing values of these routines are
    // questions, too.
    std::vector<const Routine*> commands;
    std::string names;
    for (const Routine& routine : code_.routines)
      if (is_command(routine, statement.arguments.size() - 1)) {
        commands.push_back(&routine);
        names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", routine.written);
      }
    const std::string form = commands.empty() ? "the routine's name, in quotes" : "one of " + names;
    Value unknown = name;
    if (const std::vector<const Cause*> causes = name.causes(); causes.size() == 1 && causes[0]->line.empty()) {
      Cause named = *causes[0];
      named.form = form;
      unknown.cause = std::make_shared<const Cause>(std::move(named));
    }
    ask_for(unknown, statement.place,
            fmt::format("runs a routine whose name is known only while the robot runs{}",
                        commands.empty() ? "" : fmt::format(" (of those that move: {})", names)),
            "write its name", form);
    if (commands.empty()) return;
    const int ways = static_cast<int>(commands.size());
    call(*commands[static_cast<std::size_t>(guess(statement.place, ways))],
         {statement.arguments.begin() + 1, statement.arguments.end()}, statement.place);
    if (!loops_.empty()) throw Stop{};  // further messages give the same question
    return;
  }
  run_named(name.text, {statement.arguments.begin() + 1, statement.arguments.end()}, statement.place);
}

void Interpreter::run_named(const std::string& name, const std::vector<Expression>& arguments, const Place& place) {
  const std::string lower = lower_case(name);
  const std::size_t colon = lower.find(':');
  const Routine* routine = colon == std::string::npos ? routine_named(lower, place)
                                                      : code_.find_in(lower.substr(0, colon), lower.substr(colon + 1));
  if (routine) {
    call(*routine, arguments, place);
    return;
  }
  forget_arguments(lower, arguments, place);
  note(place, name + ": not a routine of the files read and not a known instruction", true);
}

/// Makes the arguments unknown that a skipped instruction may write to.
void Interpreter::forget_arguments(const std::string& name, const std::vector<Expression>& arguments,
                                   const Place& place) {
  int position = 0;
  for (const Expression& argument : arguments) {
    const int at = argument.option.empty() ? position++ : -1;
    if (dialect_.writes(name, at, argument))
      make_unknown(argument, {"", fmt::format("may be written by {} ({})", name, short_place(place))});
  }
}

/// Returns "a.mod and b.mod". A name that two files define is reported once, with both files.
std::string Interpreter::rivals(const Place& a, const Place& b) const {
  return fmt::format("{} and {}", code_.files[a.file].name(), code_.files[b.file].name());
}

/// Returns another routine of the same name, if the user must choose between them; null: none.
const Routine* Interpreter::rival_of(const Routine& routine) {
  const Routine* const rival = code_.rival(routine);
  if (!rival || !options_.first_file_counts || routine.place.file != 0 || rival->place.file == 0) return rival;
  note(routine.place,
       fmt::format("'{}' is also in {}, which is not read", routine.written, where(rival->place).text()));
  return nullptr;
}

/// Returns the routine of a name that is used at `place`; null: none.
const Routine* Interpreter::routine_named(const std::string& name, const Place& place) {
  const Routine* routine = code_.find(name, module_);
  if (!routine) return nullptr;
  if (const Routine* rival = rival_of(*routine))
    miss(rivals(routine->place, rival->place), place,
         fmt::format("runs '{}', which is both in {} and in {}", routine->written, where(routine->place).text(),
                     where(rival->place).text()),
         "leave one of the two files out");
  return routine;
}

void Interpreter::declare(const Statement& statement) {
  const bool valued = statement.arguments[0].kind != Expression::Kind::none;
  for (const Parameter& parameter : routines_.back()->parameters) {
    if (parameter.name != statement.name) continue;
    if (!valued) return declare_parameter(statement);
    if (locals_.back().contains(parameter.name))
      return;  // URScript: the default value counts only if the caller gives none
  }
  locals_.back().insert_or_assign(statement.name, Variable{.state = Variable::State::ready,
                                                           .value = declared_value(statement),
                                                           .written = statement.place,
                                                           .declaration = &statement});
}

/// Applies the declared type of a KRL parameter; KRL declares it inside the routine.
void Interpreter::declare_parameter(const Statement& statement) {
  const auto given = locals_.back().find(statement.name);
  if (given == locals_.back().end() || statement.arguments.size() > 1) return;
  Value typed = dialect_.initial(statement.text);
  dialect_.store(typed, std::move(given->second.value));
  given->second.value = std::move(typed);
  given->second.declaration = &statement;
}

Value Interpreter::declared_value(const Statement& statement) {
  const RecordType* type = dialect_.type_of(statement.text);
  const Expression& written = statement.arguments[0];
  if (written.kind != Expression::Kind::none) {
    Value value = evaluate(written);
    if (type && statement.arguments.size() == 1 && value.kind == Value::Kind::list && !shape(value, type))
      complain(written.place, fmt::format("has not the {} components of a {}", type->fields.size(), type->name),
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
  return forgotten(std::move(value), std::make_shared<const Cause>(Cause{answer_name(statement.name), why}));
}

/// Gives the elements of an array with `levels` dimensions their record type.
void Interpreter::shape_elements(Value& value, const RecordType* type, std::size_t levels) const {
  if (levels == 0 || value.kind != Value::Kind::list) {
    shape(value, type);
    return;
  }
  for (Value& item : value.items) shape_elements(item, type, levels - 1);
}

/// Returns the parameter of an argument, by its name or by its position; null: none.
const Parameter* Interpreter::parameter_of(const Routine& routine, const Expression& argument, std::size_t& position) {
  if (!argument.option.empty()) {
    for (const Parameter& parameter : routine.parameters)
      if (parameter.name == argument.option) return &parameter;
    return nullptr;
  }
  while (position < routine.parameters.size() && routine.parameters[position].option) ++position;
  return position < routine.parameters.size() ? &routine.parameters[position++] : nullptr;
}

Value Interpreter::call(const Routine& routine, const std::vector<Expression>& arguments, const Place& place) {
  if (&routine == started_ && !routines_.empty()) call_within_itself(routine);
  if (static_cast<int>(routines_.size()) >= ImportLimits::calls) {
    if (within_itself_->by_motion() > 0) end_within_itself(*started_);  // its data change, its motion repeats
    complain(place, fmt::format("calls {} {} routines deep (without end?)", routine.written, ImportLimits::calls),
             "correct the recursion");
    throw Stop{};
  }
  for (const Problem& problem : routine.problems)
    problems_.add(problem.where, problem.what, problem.remedy, routine.written);
  report_handler(routine);
  Scope variables;
  std::vector<std::pair<const Parameter*, const Expression*>> given;
  std::size_t position = 0;
  for (const Expression& argument : arguments) {
    if (argument.if_present && !present(argument)) continue;
    const Parameter* parameter = parameter_of(routine, argument, position);
    if (!parameter) {
      complain(argument.place, fmt::format("is no argument that {} takes", routine.written), "correct the call");
      continue;
    }
    Variable& variable = variables[parameter->name];
    variable.state = Variable::State::ready;
    variable.value = argument.kind == Expression::Kind::none ? truth_value(true) : evaluate(argument);
    variable.written = origin(argument);
    variable.alias = name_of(argument);
    if (parameter->given_back) given.emplace_back(parameter, &argument);
  }
  const Place here = here_;
  const int module = std::exchange(module_, routine.module);
  routines_.push_back(&routine);
  locals_.push_back(std::move(variables));
  result_ = Value{};
  const Flow flow = execute_routine(routine);
  const Value result =
      flow == Flow::give_back
          ? result_
          : unknown_value("", fmt::format("is given back by '{}' behind a branch that is undecided, or not at all",
                                          routine.written));
  variables = std::move(locals_.back());
  locals_.pop_back();
  routines_.pop_back();
  module_ = module;
  here_ = here;
  for (const auto& [parameter, argument] : given)
    if (argument->kind == Expression::Kind::name || argument->kind == Expression::Kind::field ||
        argument->kind == Expression::Kind::element)
      assign(*argument, variables[parameter->name].value);
  return result;
}

/// Handles a call of the started routine by itself. If the data equal those of an earlier call, or if the motion
/// repeats, the calls never end: they are a cycle, and the statements after the calls never run.
void Interpreter::call_within_itself(const Routine& routine) {
  Passes& passes = *within_itself_;
  constexpr bool with_locals = false;  // the locals of the outer calls are never used again
  end_pass(passes, with_locals);
  const auto wanted = static_cast<std::size_t>(options_.passes);
  if (wanted ? passes.count() >= wanted : passes.repeats()) end_within_itself(routine);
}

void Interpreter::end_within_itself(const Routine& routine) {
  const auto wanted = static_cast<std::size_t>(options_.passes);
  const std::size_t kept = within_itself_->kept(wanted);
  const std::string doubt = doubt_about(*within_itself_, wanted);
  program_.instructions.resize(within_itself_->end(kept));
  note(routine.place,
       fmt::format("{} calls itself without end; the motion is {}{}", routine.written,
                   passes_text(static_cast<long>(kept)), doubt),
       !doubt.empty());
  throw Stop{};
}

}  // namespace dresslife::sim
