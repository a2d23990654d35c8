// Runs the tree of a RAPID or KRL program as the controller would, as far as that can be known offline, and
// collects the moves. What comes from inputs is an unknown value: it spreads through expressions, and where a
// branch hangs on it, the branch is left out if nothing in it moves or changes the robot, and asked for
// otherwise (ImportOptions::assume).
//
// An endless main loop is run once: the simulated motion is one cycle. A loop that a known condition keeps
// going is run as often as it says, within ImportLimits.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim/program/code.h"

namespace dresslife::sim {

struct Value {
  enum class Kind { unknown, number, truth, text, list };
  Kind kind = Kind::unknown;
  double number = 0;
  std::string text;
  std::vector<Value> items;
  const RecordType* type = nullptr;

  bool known() const;  ///< with everything in it
  bool is_number() const { return kind == Kind::number; }
  const Value* field(const std::string& name) const;  ///< null: none of that name
  std::size_t weight() const;                         ///< values in it
  int depth() const;                                  ///< levels of lists in it
};

Value number_value(double number);
Value truth_value(bool truth);
Value text_value(std::string text);
Value list_value(std::vector<Value> items, const RecordType* type = nullptr);

class Interpreter;

/// What RAPID and KRL do differently. Names are in lower case.
class Dialect {
 public:
  virtual ~Dialect() = default;
  /// Value of a name that the program does not declare.
  virtual std::optional<Value> constant(const std::string& name) = 0;
  /// Value of a function of the language; absent: there is no such function.
  virtual std::optional<Value> function(const Expression& call, Interpreter& run) = 0;
  /// Runs an instruction of the language; false: it is none that matters.
  virtual bool instruction(const Statement& statement, Interpreter& run) = 0;
  /// Whether an instruction moves the robot or changes how it will move.
  virtual bool matters(const std::string& instruction) const = 0;
  /// Whether an unknown instruction is known to be input, output or logic.
  virtual bool harmless(const std::string& instruction) const = 0;
  virtual const RecordType* type_of(const std::string& name) const = 0;
  /// Value of a declared variable without one.
  virtual Value initial(const std::string& type) const = 0;
};

class Interpreter {
 public:
  Interpreter(const Code& code, Dialect& dialect, const ImportOptions& options, Program& program,
              Problems& problems);

  void run(const Routine& routine);

  // ---- for the dialects --------------------------------------------------------------------------------
  Value evaluate(const Expression& expression);
  std::optional<double> number(const Expression& expression);  ///< absent: unknown, or no number
  /// The variable as it stands; null: not declared.
  const Value* variable(const std::string& name) const;
  void set(const std::string& name, Value value);  ///< of the module
  void forget(const std::string& name);
  void assign(const Expression& target, Value value);
  /// "$vel.cp", "p[3].x": under which a part of an undeclared variable is kept; empty: an index is unknown.
  std::string path_of(const Expression& expression);
  void emit(Instruction instruction, const Statement& statement);
  void note(const Place& place, const std::string& what, bool may_move = false);
  void complain(const Place& place, const std::string& what, const std::string& remedy);
  pipeline::Where where(const Place& place) const;
  const ImportOptions& options() const { return options_; }
  Program& program() { return program_; }
  /// Index of the frame in the list; added when it is new.
  int frame_index(std::vector<NamedFrame>& list, const NamedFrame& frame);
  /// Gives a list its record's type, fields in their order; false: it does not fit.
  bool shape(Value& value, const RecordType* type) const;

 private:
  enum class Flow { next, leave_loop, give_back, jump };
  struct Stop {};  // thrown: the program ends, or goes past a limit
  struct Deeper;

  Flow execute(const std::vector<Statement>& body);
  Flow execute_routine(const Routine& routine);
  Flow execute(const Statement& statement);
  Flow run_branch(const Statement& statement);
  Flow run_choice(const Statement& statement);
  Flow run_count(const Statement& statement);
  Flow run_while(const Statement& statement);
  Flow run_until(const Statement& statement);
  Flow run_endless(const Statement& statement);
  Flow run_both(const Statement& statement);
  Flow leave_out(const Statement& statement);
  void run_instruction(const Statement& statement);
  void declare(const Statement& statement);
  Value call(const Routine& routine, const std::vector<Expression>& arguments, const Place& place);
  void ask(const Place& place, const std::string& what);
  std::optional<bool> assumed(const Place& place) const;

  bool matters(const std::vector<Statement>& body, int depth = 0) const;
  void forget_assigned(const std::vector<Statement>& body);
  bool holds_loop_exit(const std::vector<Statement>& body) const;
  bool jumps_for_ever(const std::vector<Statement>& body, std::size_t label, std::size_t jump) const;

  Value evaluate_inner(const Expression& expression);
  Value name_value(const Expression& expression);
  Value unary(const Expression& expression);
  Value binary(const Expression& expression);
  Value aggregate(const Expression& expression);
  Value* locate(const Expression& expression);
  void charge(std::size_t work);

  const Code& code_;
  Dialect& dialect_;
  const ImportOptions& options_;
  Program& program_;
  Problems& problems_;
  std::map<std::string, Value, std::less<>> globals_;
  std::deque<std::map<std::string, Value, std::less<>>>
      locals_;  // stay where they are while routines are called
  std::vector<const Routine*> routines_;
  Value result_;
  const Statement* jump_ = nullptr;  // on its way to its label
  std::deque<RecordType> records_;   // of aggregates with names
  std::map<std::string, const RecordType*> record_of_;
  std::map<std::string, int> frames_;
  long executed_ = 0;
  int depth_ = 0;
};

}  // namespace dresslife::sim
