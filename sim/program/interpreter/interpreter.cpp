// Execution of statements, notes and problems. Other members: branches.cpp, loops.cpp, calls.cpp, effects.cpp;
// expressions: evaluation.cpp.
#include "sim/program/interpreter/interpreter.h"
#include "sim/program/interpreter/job_words.h"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace dresslife::sim {
namespace {

using Kind = Statement::Kind;

constexpr int stack_depth = 1200;  // levels of nested execute() and evaluate(); a stack frame is smaller than 1 kB

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
                         Problems& problems, Exploration& exploration)
    : code_(code),
      dialect_(dialect),
      options_(options),
      program_(program),
      problems_(problems),
      exploration_(exploration) {
  dialect_.attach(*this);
}

void Interpreter::run(const Routine& routine) {
  try {
    index_data();
    for (const Datum& datum :
         code_.data) {  // assignments of a KRL data list; a declaration is evaluated at its first use
      if (datum.statement.kind != Kind::assign) continue;
      module_ = datum.module;
      assign(datum.statement.arguments[0], evaluate(datum.statement.arguments[1]));
    }
    module_ = -1;
    locals_.emplace_back();
    start(routine);
  } catch (const Stop&) {
  } catch (const EndOfCycle&) {  // the routine does not start again
  }
  exploration_.spend(executed_);
  const auto note_unused = [&](const std::string& line) {
    if (!used_assumptions_.contains(line)) note(routine.place, unused_assumption(line), true);
  };
  for (const auto& [line, assumption] : options_.assume) note_unused(line);
  for (const auto& [line, chosen] : code_.choices) note_unused(line);
  for (const auto& [name, expression] : code_.values)
    if (!used_values_.contains(name)) note(expression.place, unused_value(name), true);
}

void Interpreter::start(const Routine& routine) {
  program_.start = where(routine.place);
  if (const Routine* rival = rival_of(routine))
    complain(routine.place,
             fmt::format("contains '{}', which is also in {}", routine.written, where(rival->place).text()),
             "leave one of the two out");
  const auto needed = [](const Parameter& parameter) { return !parameter.option; };
  const auto count = std::ranges::count_if(routine.parameters, needed);
  if (static_cast<long>(code_.start_arguments.size()) < count) {
    std::string names;
    for (const Parameter& parameter : routine.parameters)
      if (needed(parameter)) names += (names.empty() ? "" : ", ") + parameter.name;
    complain(routine.place, fmt::format("'{}' takes {} arguments: {}", routine.written, count, names),
             fmt::format("give them: motion.routine: '{}({})' with their values", routine.written, names));
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

/// Returns the name of the routine that contains the line; empty: none.
std::string Interpreter::routine_at(const Place& place) const {
  for (const Routine& routine : code_.routines)
    if (routine.place.file == place.file && routine.place.line <= place.line && place.line <= routine.last_line)
      return routine.written;
  return "";
}

void Interpreter::complain(const Place& place, const std::string& what, const std::string& remedy) {
  if (quiet_ > 0 || exploration_.guessing())
    ++dropped_;
  else
    problems_.add(where(place), what, remedy, routine_at(place));
}

void Interpreter::miss(const std::string& name, const Place& place, const std::string& what, const std::string& remedy,
                       std::vector<Question> questions, bool decision) {
  if (questions.empty() && exploration_.guessing()) {
    ++dropped_;
    return;
  }
  for (const Question& question : questions) exploration_.meet_question(question.name);
  problems_.add_use({.where = where(place),
                     .what = what,
                     .remedy = remedy,
                     .about = name,
                     .decision = decision,
                     .routine = routine_at(place),
                     .questions = std::move(questions),
                     .certain = !exploration_.guessing()});
}

void Interpreter::ask_for(const Value& unknown, const Place& place, const std::string& what, const std::string& remedy,
                          const std::string& form) {
  const std::vector<Question> questions = questions_for(unknown, form);
  if (questions.empty())
    return complain(place, what + because(unknown), remedy.empty() ? "write it as a constant" : remedy);
  std::string names;
  for (const Question& question : questions) names += question.name + " ";
  miss(names, place, what + because(unknown),
       fmt::format("{}{}give {}", remedy, remedy.empty() ? "" : ", or ", remedy_for(unknown)), questions);
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

void Interpreter::unread(const Place& place, const std::string& word, const std::string& of,
                         const std::vector<std::string>& known) {
  note(place, unread_reason(word, of, known), true);
}

double Interpreter::within(double value, double low, double high, const std::string& name, const Place& place) {
  if (value < low || value > high)
    note(place, fmt::format("{} {:g}: {}", name, value, beyond_range_words(low, high)), true);
  return std::clamp(value, low, high);
}

void Interpreter::charge(std::size_t work) {
  executed_ += static_cast<long>(work);
  if (guessed_at_ >= 0 && executed_ - guessed_at_ > ImportLimits::guessed) throw Stop{};
  if (executed_ <= ImportLimits::executed) return;
  // The endless loop is the loop with the most passes since its start, not the loops around it or inside of it.
  const auto longest = std::ranges::max_element(loops_, {}, &Loop::passes);
  const Place place = longest != loops_.end() ? longest->place : routines_.empty() ? Place{} : routines_.back()->place;
  miss(short_place(place), place,
       fmt::format("has run {} statements without an end (a loop that input would end?)", ImportLimits::executed),
       fmt::format("take one pass of the loop with {}, or leave it out with take: else",
                   assume_of_job(short_place(place), "then")),
       {{Question::Kind::branch, short_place(place), "then or else"}});
  throw Stop{};
}

std::string Interpreter::short_place(const Place& place) const {
  return fmt::format("{}:{}", std::filesystem::path(code_.files[place.file].name()).filename().string(), place.line);
}

int Interpreter::frame_index(std::vector<NamedFrame>& list, const NamedFrame& frame) {
  const Vector3& p = frame.frame.position;
  const Quaternion& q = frame.frame.orientation;
  const std::string name = fmt::format("{} {}", &list == &program_.tools ? "tool" : "object", frame.name);
  const auto [known, is_new] = frames_.emplace(fmt::format("{} {} {} {} {} {} {} {} {}", name, frame.stationary, p.x(),
                                                           p.y(), p.z(), q.w(), q.x(), q.y(), q.z()),
                                               static_cast<int>(list.size()));
  if (!is_new) return known->second;
  list.push_back(frame);
  if (const int variant = ++frame_variants_[name]; variant > 1)  // the program changed the frame
    list.back().name = fmt::format("{} ({})", frame.name, variant);
  return known->second;
}

std::string Interpreter::name_of(const Expression& expression) {
  if (expression.kind != Expression::Kind::name) return "";
  const Variable* found = find(expression.text);
  return found && !found->alias.empty() ? found->alias : expression.text;
}

void Interpreter::emit(Instruction instruction, const Statement& statement) {
  if (program_.instructions.size() >= ImportLimits::instructions) {
    complain(statement.place, fmt::format("would be move {} (no more are allowed)", ImportLimits::instructions + 1),
             "simulate a shorter part of the program");
    throw Stop{};
  }
  instruction.where = where(statement.place);
  instruction.routine = routines_.back()->written;
  instruction.text = code_.files[statement.place.file].line(statement.place.line);
  program_.instructions.push_back(std::move(instruction));
}

Interpreter::Flow Interpreter::execute_routine(const Routine& routine) {
  const Flow flow = execute(routine.body);
  if (flow != Flow::jump) return flow;
  complain(jump_->place, fmt::format("jumps to '{}', which is no label in a block around it", jump_->name),
           "correct the label, or write a loop");
  throw Stop{};
}

Interpreter::Flow Interpreter::execute(const Statement& statement) {
  const Deeper deeper(*this, statement.place);
  charge(1);
  if (problems_.full()) throw Stop{};
  exploration_.meet(&statement);
  here_ = statement.place;
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

}  // namespace dresslife::sim
