// Statements; expressions are in evaluation.cpp.
#include "sim/program/interpreter.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace dresslife::sim {
namespace {

using Kind = Statement::Kind;

constexpr int stack_depth = 1200;  // of execute() and evaluate() in each other; a frame is below 1 kB

constexpr std::size_t instruction_work = 10;  // of a move, in statements

const char* assume_remedy = "choose with --assume {}:{}=then or =else (motion.assume in a job)";

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

Interpreter::Interpreter(const Code& code, Dialect& dialect, const ImportOptions& options, Program& program,
                         Problems& problems)
    : code_(code), dialect_(dialect), options_(options), program_(program), problems_(problems) {}

void Interpreter::run(const Routine& routine) {
  try {
    for (const Statement& statement : code_.data)
      statement.kind == Kind::declare ? declare(statement)
                                      : assign(statement.arguments[0], evaluate(statement.arguments[1]));
    locals_.emplace_back();
    routines_.push_back(&routine);
    execute_routine(routine);
  } catch (const Stop&) {
  }
}

pipeline::Where Interpreter::where(const Place& place) const {
  return {code_.files[place.file].name(), place.line, place.column};
}

void Interpreter::complain(const Place& place, const std::string& what, const std::string& remedy) {
  problems_.add(where(place), what, remedy);
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
  const Place place = routines_.empty() ? Place{} : routines_.back()->place;
  complain(place,
           fmt::format("has run {} statements without an end (a loop that input would end?)",
                       ImportLimits::executed),
           fmt::format("take one pass of the loop with --assume LINE=then, or leave it out with =else"));
  throw Stop{};
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
  for (std::size_t i = 0; i < body.size(); ++i) {
    const Flow flow = execute(body[i]);
    if (flow == Flow::next) continue;
    if (flow != Flow::jump) return flow;
    const auto label = std::find_if(body.begin(), body.end(), [&](const Statement& statement) {
      return statement.kind == Kind::label && statement.name == jump_->name;
    });
    if (label == body.end()) return flow;  // in a block around this one
    const auto target = static_cast<std::size_t>(label - body.begin());
    if (target <= i && jumps_for_ever(body, target, i)) {
      note(jump_->place, "jumps back for ever: the motion is one pass");
      throw Stop{};
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
    case Kind::declare:
      declare(statement);
      break;
  }
  return Flow::next;
}

std::optional<bool> Interpreter::assumed(const Place& place) const {
  if (options_.assume.empty()) return {};
  const std::string& file = code_.files[place.file].name();
  for (const std::string& key :
       {fmt::format("{}:{}", file, place.line), fmt::format("{}", place.line),
        fmt::format("{}:{}", std::filesystem::path(file).filename().string(), place.line)})
    if (const auto found = options_.assume.find(key); found != options_.assume.end())
      return found->second == Assumption::then_branch;
  return {};
}

void Interpreter::ask(const Place& place, const std::string& what) {
  const std::string file = std::filesystem::path(code_.files[place.file].name()).filename().string();
  complain(place, what, fmt::format(fmt::runtime(assume_remedy), file, place.line));
}

Interpreter::Flow Interpreter::run_branch(const Statement& statement) {
  for (const Branch& branch : statement.branches) {
    if (branch.conditions.empty()) return execute(branch.body);
    std::optional<bool> decision = assumed(branch.place);
    if (!decision) {
      const Value condition = evaluate(branch.conditions[0]);
      if (condition.kind == Value::Kind::truth) decision = condition.number != 0;
    }
    if (!decision) {
      if (!matters({statement})) return leave_out(statement);
      ask(branch.place, "branches on what is known only while the robot runs");
      return run_both(statement);
    }
    if (*decision) return execute(branch.body);
  }
  return Flow::next;
}

Interpreter::Flow Interpreter::run_choice(const Statement& statement) {
  const Value subject = evaluate(statement.arguments[0]);
  for (const Branch& branch : statement.branches) {
    if (branch.conditions.empty()) return execute(branch.body);
    const std::optional<bool> decision = assumed(branch.place);
    if (decision ? *decision : false) return execute(branch.body);
    if (decision) continue;
    bool unknown = !subject.known();
    for (const Expression& condition : branch.conditions) {
      const Value value = evaluate(condition);
      unknown |= !value.known();
      if (!unknown && value.kind == subject.kind && value.number == subject.number &&
          value.text == subject.text)
        return execute(branch.body);
    }
    if (!unknown) continue;
    if (!matters({statement})) return leave_out(statement);
    ask(branch.place, "is a case of what is known only while the robot runs");
  }
  return Flow::next;
}

/// An undecided branch that does not move the robot: nothing but its variables becomes unknown.
Interpreter::Flow Interpreter::leave_out(const Statement& statement) {
  note(statement.place, "a branch on what is known only while the robot runs, without moves");
  for (const Branch& branch : statement.branches) forget_assigned(branch.body);
  return Flow::next;
}

/// The reading has failed; what else there is to ask or to mend in the arms is told as well.
Interpreter::Flow Interpreter::run_both(const Statement& statement) {
  for (const Branch& branch : statement.branches) execute(branch.body);
  return Flow::next;
}

Interpreter::Flow Interpreter::run_count(const Statement& statement) {
  const std::optional<bool> decision = assumed(statement.place);
  if (decision && !*decision) return Flow::next;
  const auto from = number(statement.arguments[0]), to = number(statement.arguments[1]);
  const Expression& written_step = statement.arguments[2];
  std::optional<double> step = from && to && *to < *from ? -1 : 1;  // RAPID counts either way
  if (written_step.kind != Expression::Kind::none) step = number(written_step);
  if (!decision && (!from || !to || !step || *step == 0)) {
    if (matters({statement}))
      ask(statement.place, "counts to what is known only while the robot runs (then: one pass, else: none)");
    return Flow::next;
  }
  const double first = from.value_or(1), last = decision ? first : *to, by = decision ? 1 : *step;
  auto& variables = locals_.back();
  const auto before = variables.find(statement.name);
  const std::optional<Value> hidden =
      before == variables.end() ? std::nullopt : std::optional(before->second);
  const auto count = [&](double value) {
    if (statement.keeps_counter) {
      Expression counter;
      counter.kind = Expression::Kind::name;
      counter.text = statement.name;
      counter.place = statement.place;
      assign(counter, number_value(value));
    } else {
      variables.insert_or_assign(statement.name, number_value(value));
    }
  };
  Flow flow = Flow::next;
  double value = first;
  for (long k = 0; flow == Flow::next && (by > 0 ? value <= last : value >= last);
       value = first + static_cast<double>(++k) * by) {
    charge(1);
    count(value);
    flow = execute(statement.branches[0].body);
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
  while (flow == Flow::next) {
    if (decision && !*decision) break;
    if (!decision) {
      const Value go_on = evaluate(condition);
      if (go_on.kind == Value::Kind::unknown) {
        if (!matters({statement})) return leave_out(statement);
        ask(statement.place,
            "repeats while something holds that is known only while the robot runs (then: one pass, else: "
            "none)");
        return run_both(statement);
      }
      if (go_on.number == 0) break;
    }
    charge(1);
    flow = execute(statement.branches[0].body);
    if (decision) break;
  }
  return flow == Flow::leave_loop ? Flow::next : flow;
}

Interpreter::Flow Interpreter::run_until(const Statement& statement) {
  while (true) {
    const Flow flow = execute(statement.branches[0].body);
    if (flow != Flow::next) return flow == Flow::leave_loop ? Flow::next : flow;
    if (assumed(statement.place)) return Flow::next;
    const Value done = evaluate(statement.arguments[0]);
    if (done.kind == Value::Kind::unknown) {
      note(statement.place,
           "repeats until something holds that is known only while the robot runs: one pass is taken");
      return Flow::next;
    }
    if (done.number != 0) return Flow::next;
    charge(1);
  }
}

/// The endless loop of a main program is one cycle of the motion; nothing can follow it.
Interpreter::Flow Interpreter::run_endless(const Statement& statement) {
  const bool leaves = holds_loop_exit(statement.branches[0].body);
  while (true) {
    const std::size_t moves = program_.instructions.size();
    const Flow flow = execute(statement.branches[0].body);
    if (flow != Flow::next) return flow == Flow::leave_loop ? Flow::next : flow;
    if (!leaves || assumed(statement.place)) {
      note(statement.place, "repeats for ever: the motion is one pass");
      if (moves == program_.instructions.size() && !assumed(statement.place)) return Flow::next;
      throw Stop{};
    }
    charge(1);
  }
}

void Interpreter::run_instruction(const Statement& statement) {
  if (const Routine* routine = code_.find(statement.name)) {
    call(*routine, statement.arguments, statement.place);
    return;
  }
  charge(instruction_work);
  if (dialect_.instruction(statement, *this)) return;
  if (dialect_.harmless(statement.name))
    note(statement.place, statement.text + ": input, output or logic");
  else
    note(statement.place, statement.text + ": not a routine of the files read and not a known instruction",
         true);
}

void Interpreter::declare(const Statement& statement) {
  if (!routines_.empty() && statement.arguments[0].kind == Expression::Kind::none)
    for (const Parameter& parameter :
         routines_.back()->parameters)  // KRL declares its parameters' types inside
      if (parameter.name == statement.name) return;
  const RecordType* type = dialect_.type_of(statement.text);
  Value value;
  const Expression& written = statement.arguments[0];
  if (written.kind != Expression::Kind::none) {
    value = evaluate(written);
    if (type && statement.arguments.size() == 1 && value.kind == Value::Kind::list && !shape(value, type))
      complain(written.place,
               fmt::format("has not the {} components of a {}", type->fields.size(), type->name),
               "write all of them");
  } else {
    value = dialect_.initial(statement.text);
    double count = 1;
    for (std::size_t i = statement.arguments.size(); i-- > 1;) {
      const double size = number(statement.arguments[i]).value_or(0);
      count *= size;
      if (!(size >= 1) || !(count * static_cast<double>(value.weight()) <= ImportLimits::values)) {
        value = Value{};
        break;
      }
      charge(static_cast<std::size_t>(count));
      value = list_value(std::vector<Value>(static_cast<std::size_t>(size), value));
    }
  }
  auto& variables = locals_.empty() ? globals_ : locals_.back();
  variables.insert_or_assign(statement.name, std::move(value));
}

Value Interpreter::call(const Routine& routine, const std::vector<Expression>& arguments,
                        const Place& place) {
  if (static_cast<int>(routines_.size()) >= ImportLimits::calls) {
    complain(place,
             fmt::format("calls {} {} routines deep (without end?)", routine.written, ImportLimits::calls),
             "mend the recursion");
    throw Stop{};
  }
  std::map<std::string, Value, std::less<>> variables;
  std::vector<std::pair<const Parameter*, const Expression*>> given;
  std::size_t position = 0;
  for (const Expression& argument : arguments) {
    const Parameter* parameter = nullptr;
    if (!argument.option.empty()) {
      for (const Parameter& p : routine.parameters)
        if (p.name == argument.option) parameter = &p;
    } else {
      while (position < routine.parameters.size() && routine.parameters[position].option) ++position;
      if (position < routine.parameters.size()) parameter = &routine.parameters[position++];
    }
    if (!parameter) {
      complain(argument.place, fmt::format("is no argument that {} takes", routine.written), "mend the call");
      continue;
    }
    variables[parameter->name] =
        argument.kind == Expression::Kind::none ? truth_value(true) : evaluate(argument);
    if (parameter->given_back) given.emplace_back(parameter, &argument);
  }
  routines_.push_back(&routine);
  locals_.push_back(std::move(variables));
  result_ = Value{};
  const Flow flow = execute_routine(routine);
  const Value result = flow == Flow::give_back ? result_ : Value{};
  variables = std::move(locals_.back());
  locals_.pop_back();
  routines_.pop_back();
  for (const auto& [parameter, argument] : given)
    if (argument->kind == Expression::Kind::name || argument->kind == Expression::Kind::field ||
        argument->kind == Expression::Kind::element)
      assign(*argument, variables[parameter->name]);
  return result;
}

// ---- what a branch may do ---------------------------------------------------------------------------------

bool Interpreter::matters(const std::vector<Statement>& body, int depth) const {
  if (depth > 8) return true;
  for (const Statement& statement : body) {
    switch (statement.kind) {
      case Kind::give_back:
      case Kind::leave_loop:
      case Kind::jump:
        return true;
      case Kind::instruction:
        if (const Routine* routine = code_.find(statement.name)) {
          // A routine's own RETURN ends only itself: what counts is whether it moves.
          if (matters(routine->body, depth + 1)) return true;
        } else if (dialect_.matters(statement.name)) {
          return true;
        }
        break;
      default:
        break;
    }
    for (const Branch& branch : statement.branches)
      if (matters(branch.body, depth + 1)) return true;
  }
  return false;
}

void Interpreter::forget_assigned(const std::vector<Statement>& body) {
  for (const Statement& statement : body) {
    if (statement.kind == Kind::assign) assign(statement.arguments[0], Value{});
    for (const Branch& branch : statement.branches) forget_assigned(branch.body);
  }
}

bool Interpreter::holds_loop_exit(const std::vector<Statement>& body) const {
  for (const Statement& statement : body) {
    if (statement.kind == Kind::leave_loop || statement.kind == Kind::give_back ||
        statement.kind == Kind::jump || statement.kind == Kind::finish)
      return true;
    if (statement.kind != Kind::branch && statement.kind != Kind::choose) continue;
    for (const Branch& branch : statement.branches)
      if (holds_loop_exit(branch.body)) return true;
  }
  return false;
}

}  // namespace dresslife::sim
