// Runs the tree of a program as the controller would, as far as the files determine it, and collects the moves.
// Inputs, and data that a skipped instruction may write, are unknown values. An unknown value holds its cause
// and makes each expression unknown that uses it. A branch on an unknown value is skipped if its statements do
// not move the robot or change its motion. Otherwise the branch is a question to the user
// (ImportOptions::assume, values), and the run continues along one of the arms (exploration.h).
//
// Names: a name of the routine hides the same name of its module; a name of the module hides the same name of
// all modules. Data outside of routines is evaluated at its first use. A name that two files define differently
// is an error at its use.
//
// An endless main loop runs until the program's variables have the values that they had after an earlier pass.
// This is one cycle of the machine. If the variables never return to earlier values, the motion is one pass, or
// ImportOptions::passes passes. A loop with a known condition runs as often as the condition says, within
// ImportLimits. RAPID's main starts again at its end and keeps its variables; it is an endless loop, too.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "sim/program/interpreter/code.h"
#include "sim/program/interpreter/exploration.h"
#include "sim/program/interpreter/passes.h"

namespace dresslife::sim {

/// Why a value is unknown.
struct Cause {
  std::string name;    ///< key in ImportOptions::values that makes the value known; empty: none
  std::string why;     ///< "is read by TPReadNum (m.mod:9)", "is no name that a file declares"
  std::string line{};  ///< "m.mod:9", the line of an undecided branch that the value depends on
  std::shared_ptr<const Cause> behind = nullptr;       ///< cause of that branch; its own `behind` is null
  std::vector<std::shared_ptr<const Cause>> others{};  ///< further causes, if several unknown values are combined
  std::string form{};                                  ///< form of the value's text; empty: not known
  std::string standard{};  ///< name of the delivered value (Code::presets) that is a safe answer; empty: `name`

  /// Returns the name of the missing value; empty: none.
  const std::string& asked() const { return behind ? behind->name : name; }
};

struct Value {
  enum class Kind { unknown, number, truth, text, list };
  /// Type of a KRL number or of the variable that holds it. Division of two INT values truncates.
  enum class Numeric : unsigned char { any, integer, real };
  Kind kind = Kind::unknown;
  Numeric numeric = Numeric::any;
  double number = 0;
  std::string text{};
  std::vector<Value> items{};
  const RecordType* type = nullptr;
  std::shared_ptr<const Cause> cause{};  ///< why the value is unknown; null: the cause is not known

  bool known() const;  ///< true: the value and all its items are known
  bool is_number() const { return kind == Kind::number; }
  const Value* field(const std::string& name) const;  ///< null: no field of that name
  std::size_t weight() const;                         ///< number of values in it
  int depth() const;                                  ///< levels of nested lists
  const Cause* first_cause() const;                   ///< cause of the first unknown part; null: none
  std::vector<const Cause*> causes() const;           ///< causes of all unknown parts, each asked() name once
  bool operator==(const Value& other) const;          ///< two unknown values are equal, whatever their causes
};

Value number_value(double number);
Value truth_value(bool truth);
Value text_value(std::string text);
Value list_value(std::vector<Value> items, const RecordType* type = nullptr);
Value unknown_value(std::string name, std::string why, std::string form = "");
Value unknown_value(Cause cause);
Value unknown_value(const Value& because);  ///< an unknown value with the causes of `because`
Value unknown_value(const Value& because, const Value& and_because);
/// Returns a value with the lists of `value` in which every single value is unknown because of `cause`.
Value forgotten(Value value, const std::shared_ptr<const Cause>& cause);

class Interpreter;

/// Interface to the rules of one language. Names are in lower case.
class Dialect {
 public:
  virtual ~Dialect() = default;
  /// Stores the run that uses this dialect. Precondition of all other members.
  void attach(Interpreter& run) { run_ = &run; }
  /// Returns the value of a name that the program does not declare; std::nullopt: the language has no such name.
  virtual std::optional<Value> constant(const std::string& name) = 0;
  /// Returns the value of a function of the language; std::nullopt: the language has no such function.
  virtual std::optional<Value> function(const Expression& call) = 0;
  /// Runs an instruction of the language. Returns false if the instruction has no effect on the motion.
  virtual bool instruction(const Statement& statement) = 0;
  /// Whether an instruction moves the robot or changes its later motion.
  virtual bool matters(const std::string& instruction) const = 0;
  /// Whether an instruction only waits.
  virtual bool only_waits(const std::string& instruction) const = 0;
  /// Whether an instruction that is not read is certainly input, output or logic.
  virtual bool harmless(const std::string& instruction) const = 0;
  /// Returns the move that an unknown instruction probably is (typing error), in the language's spelling; empty: none.
  virtual std::string move_meant(const Statement&) const { return ""; }
  /// Whether a skipped instruction or an unknown function may write to this argument.
  virtual bool writes(const std::string& instruction, int /*position*/, const Expression& /*argument*/) const {
    return !harmless(instruction);
  }
  /// Whether the controller starts this routine again after its end.
  virtual bool begins_again(const Routine&) const { return false; }
  virtual const RecordType* type_of(const std::string& name) const = 0;
  /// Returns the form of an answer of a type: "a number"; empty: as the program writes such a value.
  virtual std::string form_of(const std::string& type) const = 0;
  /// Whether the user can give a whole list as one value.
  virtual bool gives_lists() const { return true; }
  /// Returns the form of an answer for data of which several files hold copies. Copies saved at different times differ; then the
  /// user is asked for the value. std::nullopt: two different declarations are an error.
  virtual std::optional<std::string> form_of_copies(const std::string&) const { return {}; }
  /// Returns the number of a text of one letter; std::nullopt: the language does not convert letters.
  virtual std::optional<double> letter(const Value&) const { return {}; }
  /// Whether the controller computes with numbers of single precision: a loop that adds 0.1 ends after ten passes at 1.
  virtual bool has_single_precision() const { return true; }
  /// Whether operators take lists item by item, also a list and a number.
  virtual bool computes_by_item() const { return false; }
  /// Handles an instruction of an undecided branch: it may have run or not.
  virtual void may_have_run(const Statement&, const Cause&) {}
  /// Returns the value of a variable that is declared without a value.
  virtual Value initial(const std::string& type) const = 0;
  /// Assigns a value to a variable or to a part of a variable.
  virtual void store(Value& place, Value value) const { place = std::move(value); }
  /// Gives warnings of the components of an aggregate that no position has.
  virtual void check_components(const Expression& /*aggregate*/) {}
  /// Handles an assignment to a component that the record does not have.
  virtual void no_such_component(const Expression& /*target*/, const RecordType& /*record*/) {}
  /// Returns the index of a list's first element in the language.
  virtual int first_index() const { return 1; }
  /// Whether all modules share a name that this module uses and that no file declares.
  virtual bool shares(const std::string& /*name*/, int /*module*/) const { return true; }
  /// Whether an undeclared name that is not shared is a separate variable in each module.
  virtual bool is_of_module(const std::string&) const { return false; }

 protected:
  Interpreter* run_ = nullptr;
};

class Interpreter {
 public:
  Interpreter(const Code& code, Dialect& dialect, const ImportOptions& options, Program& program, Problems& problems,
              Exploration& exploration);

  void run(const Routine& routine);

  // ---- for the dialects --------------------------------------------------------------------------------
  Value evaluate(const Expression& expression);
  std::optional<double> number(const Expression& expression);  ///< std::nullopt: unknown, or not a number
  /// Returns the value of an argument. If the value has no other name, the question names it by line and text.
  Value answered(const Expression& expression);
  /// Returns the current value of a variable; null: not declared.
  const Value* variable(const std::string& name);
  /// Returns the user's value for a name or path; std::nullopt: none.
  std::optional<Value> given(const std::string& name);
  /// Returns the user's value for a text in the current line ("cell.mod:12:cjointt"), else for the text ("cjointt").
  std::optional<Value> given_here(const std::string& what);
  std::string name_here(const std::string& what) const;
  /// Returns the name by which the user gives a variable or a part of it. The name contains the module or routine
  /// if several of them declare it.
  std::string answer_name(const std::string& path);
  /// Returns the place where the first variable of an expression was last written; line 0: not in the files.
  Place origin(const Expression& expression);
  /// Returns the name of the data in an expression; for a parameter, the caller's name. Empty: not a name.
  std::string name_of(const Expression& expression);
  /// Whether the program has written to the first variable of an expression.
  bool was_assigned(const Expression& expression) const;
  /// Returns the expression's text in its file, up to the argument's end.
  std::string written(const Expression& expression) const;
  /// Adds to a move the origin of a part: the place where the first variable of an expression was last written.
  void add_origin(Instruction& move, const char* part, const Expression& from, const std::string& written);
  void add_origin(Instruction& move, const char* part, const Expression& from) {
    add_origin(move, part, from, written(from));
  }
  /// Runs a routine by its name, "name" or "module:name".
  void run_named(const std::string& name, const std::vector<Expression>& arguments, const Place& place);
  /// Whether the caller of the current routine gave the argument that \name?value names.
  bool present(const Expression& argument);
  /// Makes a variable unknown because of `cause`, or assigns the user's value to it.
  void make_unknown(const Expression& target, Cause cause);
  /// Makes all data unknown that a call may write to. module: the module whose names the call sees.
  void forget_writes_of(const Statement& call, int module, const std::string& why);
  /// Makes every number and text of all modules unknown, because a skipped statement may have written it. Lists stay known.
  void forget_numbers(const std::string& why);
  /// Sets a variable of all modules. written: the place of the assignment.
  void set(const std::string& name, Value value, const Place& written = {});
  void forget(const std::string& name);
  void assign(const Expression& target, Value value);
  /// Returns the key of a part of an undeclared variable: "$vel.cp", "p[3].x"; empty: an index is unknown.
  std::string path_of(const Expression& expression);
  void emit(Instruction instruction, const Statement& statement);
  void note(const Place& place, const std::string& what, bool may_move = false);
  /// Gives a warning of a word that `of` does not have: a switch, a component, a mark. known: its words.
  void unread(const Place& place, const std::string& word, const std::string& of,
              const std::vector<std::string>& known);
  /// Returns the nearest value within a range, and notes a value outside of it. name: of the number, for the note.
  double within(double value, double low, double high, const std::string& name, const Place& place);
  void complain(const Place& place, const std::string& what, const std::string& remedy);
  /// Reports a missing value, once for all its uses. decision: the missing value is the arm of a branch.
  void miss(const std::string& name, const Place& place, const std::string& what, const std::string& remedy,
            std::vector<Question> questions = {}, bool decision = false);
  /// Asks the user for all causes of an unknown value. remedy: text before "motion.values: ..."; form: the form of the
  /// value's text.
  void ask_for(const Value& unknown, const Place& place, const std::string& what, const std::string& remedy,
               const std::string& form);
  /// Returns ": k is read by TPReadNum (m.mod:9)"; empty: the cause is not known.
  std::string because(const Value& unknown) const;
  /// Returns the keys that make the value known: "motion.values: [{name: k, value: VALUE}]"; empty: none.
  std::string remedy_for(const Value& unknown) const;
  std::vector<Question> questions_for(const Value& unknown, const std::string& form);
  /// Returns the number of problems, including those that are dropped because they follow a guess.
  std::size_t problem_count() const { return problems_.count() + dropped_; }
  pipeline::Where where(const Place& place) const;
  std::string short_place(const Place& place) const;  ///< "main.mod:12"
  std::string routine_at(const Place& place) const;
  const ImportOptions& options() const { return options_; }
  int module() const { return module_; }  ///< module whose names are visible; -1: none
  Program& program() { return program_; }
  /// Returns the index of the frame in the list; adds a new frame.
  int frame_index(std::vector<NamedFrame>& list, const NamedFrame& frame);
  /// Gives a list the type of its record and sorts its fields. Returns false if the list does not fit.
  bool shape(Value& value, const RecordType* type) const;

 private:
  enum class Flow { next, leave_loop, give_back, jump };
  struct Stop {};        // thrown: the program ends or exceeds a limit
  struct EndOfCycle {};  // thrown: the controller starts its routine again
  struct Variable {
    enum class State { declared, being_read, ready };
    const Datum* datum = nullptr;  // null: made by an assignment
    const Datum* rival = nullptr;  // another declaration of the same name with another value
    State state = State::declared;
    Value value;
    Place written;                           // place of the declaration or of the last assignment; line 0: none
    bool assigned = false;                   // assigned after its declaration: part of the program's state
    bool counter = false;                    // counter of a running FOR; only the FOR writes to it
    std::string alias{};                     // for a parameter: the caller's name of the data
    const Statement* declaration = nullptr;  // null: a parameter, or made by an assignment
  };
  using Scope = std::map<std::string, Variable, std::less<>>;
  struct Deeper;
  struct Round;
  struct Again;

  void start(const Routine& routine);
  void run_cycles(const Routine& routine);
  std::string shared_and_written() const;
  bool ends_within(const Routine& routine);
  void leave_all_routines();
  Flow execute(const std::vector<Statement>& body);
  Flow execute_routine(const Routine& routine);
  std::string rivals(const Place& a, const Place& b) const;
  const Routine* rival_of(const Routine& routine);
  const Routine* routine_named(const std::string& name, const Place& place);
  Flow execute(const Statement& statement);
  Flow run_branch(const Statement& statement);
  Flow run_choice(const Statement& statement);
  Flow run_count(const Statement& statement);
  Flow run_while(const Statement& statement);
  Flow run_until(const Statement& statement);
  Flow run_endless(const Statement& statement);
  Flow go_on(const Branch& way, const Value& unknown);
  Flow leave_out(const Statement& statement, const Value& unknown);
  void run_instruction(const Statement& statement);
  void run_late(const Statement& statement);
  bool is_command(const Routine& routine, std::size_t arguments);
  void declare(const Statement& statement);
  static const Parameter* parameter_of(const Routine& routine, const Expression& argument, std::size_t& position);
  Value call(const Routine& routine, const std::vector<Expression>& arguments, const Place& place);
  std::uint64_t state(bool with_locals = true) const;
  void call_within_itself(const Routine& routine);
  [[noreturn]] void end_within_itself(const Routine& routine);
  int ask(const Place& place, const std::string& what, const Value& unknown, const std::string& answers, int ways,
          bool by_value, const std::string& form);
  int guess(const Place& place, int ways);
  std::string form_of(const std::string& name);
  bool compares_known(const Expression& condition);
  void add_compared(const Expression& condition, std::vector<Value>& values);
  template <class Answers>
  const typename Answers::mapped_type* answer(const Answers& answers, const Place& place);
  std::optional<bool> assumed(const Place& place);

  bool moves(const Expression& expression, int module);
  bool moves(const Statement& statement, int module);
  bool moves(const Routine& routine);
  bool matters(const Statement& statement);
  bool only_waits(const std::vector<Statement>& body) const;
  bool changes_nothing(const Statement& statement, int module, int depth = 0);
  bool changes_nothing(const std::vector<Statement>& body, int module, int depth = 0);
  const Branch* waited_for(const Statement& statement);
  void report_handler(const Routine& routine);
  bool leaves(const Statement& statement, bool in_loop) const;
  void forget_assigned(const std::vector<Statement>& body, const Cause& why, std::set<const Routine*>& done);
  void forget_written(const Statement& statement, const Cause& why, std::set<const Routine*>& done);
  void forget_arguments(const std::string& name, const std::vector<Expression>& arguments, const Place& place);
  bool may_be_written(const std::string& name);
  bool stays_the_same(const Expression& condition);
  bool holds_loop_exit(const std::vector<Statement>& body) const;
  bool jumps_for_ever(const std::vector<Statement>& body, std::size_t label, std::size_t jump) const;
  void end_where_it_repeats(Passes& passes, const Place& place, bool for_ever);
  void end_pass(Passes& passes, bool with_locals = true);
  void take_arm(const Statement& statement, std::size_t arm);
  std::string same_arm_in_all(const Passes& passes) const;
  std::string doubt_about(const Passes& passes, std::size_t wanted) const;

  Value evaluate_inner(const Expression& expression);
  Value name_value(const Expression& expression);
  Value call_value(const Expression& expression);
  Value unknown_index(const Expression& expression);
  std::optional<Value> character_of(const Expression& expression);
  std::optional<Value> value_written_beside(const Expression& expression);
  Value why_unknown(const std::vector<Expression>& expressions);
  Value unary(const Expression& expression);
  Value binary(const Expression& expression);
  Value mixed(const Expression& expression);
  Value applied(const std::string& op, Value a, Value b, const Place& place);
  Value by_item(const std::string& op, const Value& a, const Value& b, const Place& place);
  Value aggregate(const Expression& expression);
  void shape_elements(Value& value, const RecordType* type, std::size_t levels) const;
  Value* locate(const Expression& expression);
  std::shared_ptr<const Cause> typed_cause(const Value& unknown, const RecordType* type) const;
  Value* part_of_given(Value& whole, const Expression& part);
  Value* given_part(const Expression& expression);
  Variable* find(const std::string& name);
  Scope& scope_of(const std::string& path);
  static const std::string& base_name(const Expression& expression);
  Variable* base_of(const Expression& expression);
  static bool is_constant(const Variable& variable);
  Value* ready(Variable& variable);
  void assign_somewhere(const Expression& target);
  Value declared_value(const Statement& statement);
  void declare_parameter(const Statement& statement);
  void index_data();
  void count_holders();
  std::optional<Value> given_for(const Datum& datum);
  bool same_declaration(const Datum& a, const Datum& b) const;
  void charge(std::size_t work);

  const Code& code_;
  std::map<std::string, bool> written_;  ///< may_be_written() of each name that was asked for
  Dialect& dialect_;
  const ImportOptions& options_;
  Program& program_;
  Problems& problems_;
  Scope globals_;
  std::vector<Scope> module_data_;  // LOCAL data of each module
  std::deque<Scope> locals_;        // of each running routine; a deque keeps addresses valid during calls
  int module_ = -1;                 // module whose names are visible
  Exploration& exploration_;
  std::set<std::string> used_values_, used_assumptions_;
  std::map<std::string, std::string> given_to_;  // name of a value without its module -> full name of its first use
  std::map<std::string, int> holders_;           // name -> number of routines and modules that declare it
  int modules_apart_ = 0;                        // number of modules with undeclared names of their own
  std::size_t dropped_ = 0;                      // number of problems after a guess
  int quiet_ = 0;                                // above 0: problems and notes are not reported
  long guessed_at_ = -1;                         // executed_ at the first guess; -1: no guess yet
  Place here_;                                   // place of the current statement
  std::map<const Routine*, bool> routine_moves_;
  struct Loop {
    Place place;
    long passes = 0;
  };
  const Routine* started_ = nullptr;
  std::optional<Passes> within_itself_;                 // passes of the started routine that end with a call of itself
  std::vector<Loop> loops_;                             // running loops, outermost first
  std::vector<const std::vector<Statement>*> endless_;  // bodies of running endless loops, outermost first
  /// Arms that a decided branch took, and the values that it compared at its first run in a pass.
  struct Arms {
    std::size_t first = 0, pass = 0;
    bool others_move = false, several = false;  // others_move: an arm other than `first` moves the robot
    std::size_t changes = 0;                    // number of passes with other values than in the pass before
    std::vector<Value> compared{};
  };
  std::map<const Statement*, Arms> arms_;
  std::size_t pass_ = 0;  // number of ended passes of all endless loops
  std::set<const Routine*> reported_handlers_;
  std::vector<const Routine*> routines_;
  Value result_;
  const Statement* jump_ = nullptr;  // the GOTO whose label is searched
  std::deque<RecordType> records_;   // types of aggregates with named components
  std::map<std::string, const RecordType*> record_of_;
  std::map<std::string, int> frames_;          // name and contents -> index in the program's list
  std::map<std::string, int> frame_variants_;  // name -> number of different contents
  long executed_ = 0;
  int depth_ = 0;
};

}  // namespace dresslife::sim
