// Runs the tree of a RAPID or KRL program as the controller would, as far as that can be known offline, and
// collects the moves. What comes from inputs, or from an instruction that is left out, is an unknown value
// that remembers what made it so: it spreads through expressions, and where a branch depends on it, the branch
// is left out if nothing in it moves or changes the robot, and asked for otherwise (ImportOptions::assume,
// values). Behind such a question the run goes on along one of the ways (exploration.h).
//
// Names: those of the routine hide those of its module, which hide those of all modules. Data outside of
// routines is worked out when it is first used. A name that two files give to different things is refused
// where it is used.
//
// An endless main loop is run until the program's variables are what they were after an earlier pass: that is
// one cycle of the machine. Where they never are, it is one pass; ImportOptions::passes says how many else. A
// loop that a known condition keeps going is run as often as it says, within ImportLimits. RAPID's main
// begins again at its end, with the variables as they are: that is an endless loop, too.
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
  std::string name;    ///< under which ImportOptions::values can give it; empty: there is none
  std::string why;     ///< "is read by TPReadNum (m.mod:9)", "is no name that a file declares"
  std::string line{};  ///< "m.mod:9" of an undecided branch that it depends on
  std::shared_ptr<const Cause> behind = nullptr;  ///< why that branch is undecided; has itself none behind it
  std::vector<std::shared_ptr<const Cause>> others{};  ///< further ones, of a value of several unknown ones
  std::string form{};  ///< how its value is written; empty: it is not known
  std::string standard{};  ///< name of the delivered value (Code::presets) that is a safe answer; empty: its own name

  /// The name whose value would make it known; empty: there is none.
  const std::string& asked() const { return behind ? behind->name : name; }
};

struct Value {
  enum class Kind { unknown, number, truth, text, list };
  /// Of KRL's numbers, and of the variables that hold them: INT counts in whole numbers, also when it
  /// divides.
  enum class Numeric : unsigned char { any, integer, real };
  Kind kind = Kind::unknown;
  Numeric numeric = Numeric::any;
  double number = 0;
  std::string text;
  std::vector<Value> items;
  const RecordType* type = nullptr;
  std::shared_ptr<const Cause> cause;  ///< of an unknown one; null: not known either

  bool known() const;  ///< with everything in it
  bool is_number() const { return kind == Kind::number; }
  const Value* field(const std::string& name) const;  ///< null: none of that name
  std::size_t weight() const;                         ///< values in it
  int depth() const;                                  ///< levels of lists in it
  const Cause* first_cause() const;                   ///< of what is unknown in it; null: none
  std::vector<const Cause*> causes() const;           ///< all of them, each asked() name once
  bool operator==(const Value& other) const;          ///< unknown ones are equal, whatever made them so
};

Value number_value(double number);
Value truth_value(bool truth);
Value text_value(std::string text);
Value list_value(std::vector<Value> items, const RecordType* type = nullptr);
Value unknown_value(std::string name, std::string why, std::string form = "");
Value unknown_value(const Value& because);  ///< with the causes of that one
Value unknown_value(const Value& because, const Value& and_because);
/// The same lists with nothing known in them.
Value forgotten(Value value, const std::shared_ptr<const Cause>& cause);

class Interpreter;

/// What RAPID and KRL do differently. Names are in lower case.
class Dialect {
 public:
  virtual ~Dialect() = default;
  /// Called by the run that uses it, before anything else.
  void attach(Interpreter& run) { run_ = &run; }
  /// Value of a name that the program does not declare.
  virtual std::optional<Value> constant(const std::string& name) = 0;
  /// Value of a function of the language; absent: there is no such function.
  virtual std::optional<Value> function(const Expression& call, Interpreter& run) = 0;
  /// Runs an instruction of the language; false: it is none that matters.
  virtual bool instruction(const Statement& statement, Interpreter& run) = 0;
  /// Whether an instruction moves the robot or changes how it will move.
  virtual bool matters(const std::string& instruction) const = 0;
  /// Whether an instruction lets time pass and does nothing else.
  virtual bool only_waits(const std::string& instruction) const = 0;
  /// Whether an unknown instruction is known to be input, output or logic.
  virtual bool harmless(const std::string& instruction) const = 0;
  /// The move that an unknown instruction probably is, with a typing error, as the language writes it; empty: none.
  virtual std::string move_meant(const Statement&) const { return ""; }
  /// Whether an instruction that is left out, or a function that is not read, may write to this argument.
  virtual bool writes(const std::string& instruction, int /*position*/, const Expression& /*argument*/) const { return !harmless(instruction); }
  /// Whether the controller runs this routine again when it has ended.
  virtual bool begins_again(const Routine&) const { return false; }
  virtual const RecordType* type_of(const std::string& name) const = 0;
  /// How a value of a type is written: "a number"; empty: as it is in the program.
  virtual std::string form_of(const std::string& type) const = 0;
  /// Whether a value can be a whole list.
  virtual bool gives_lists() const { return true; }
  /// Where files hold copies of data of the controller, which differ if they were saved at different times: how such a value is
  /// written, which is asked for then. Absent: two files that differ are a mistake.
  virtual std::optional<std::string> form_of_copies(const std::string&) const { return {}; }
  /// The number that a text of one letter stands for; absent: none in this language.
  virtual std::optional<double> letter(const Value&) const { return {}; }
  /// An instruction that an undecided branch may have run.
  virtual void may_have_run(const Statement&, const Cause&, Interpreter&) {}
  /// Value of a declared variable without one.
  virtual Value initial(const std::string& type) const = 0;
  /// Assigns a value to a variable or to a part of one.
  virtual void store(Value& place, Value value) const { place = std::move(value); }
  /// Of a list, as programs write it.
  virtual int first_index() const { return 1; }
  /// Whether a name that a module uses and no file read declares belongs to all modules, not to it alone.
  virtual bool shares(const std::string& /*name*/, int /*module*/) const { return true; }
  /// Whether a name that a module does not share means something else in each module that uses it.
  virtual bool is_of_module(const std::string&) const { return false; }

 protected:
  Interpreter* run_ = nullptr;
};

class Interpreter {
 public:
  Interpreter(const Code& code, Dialect& dialect, const ImportOptions& options, Program& program,
              Problems& problems, Exploration& exploration);

  void run(const Routine& routine);

  // ---- for the dialects --------------------------------------------------------------------------------
  Value evaluate(const Expression& expression);
  std::optional<double> number(const Expression& expression);  ///< absent: unknown, or no number
  /// The value of an argument. One that nothing else makes known is asked for by its line and text.
  Value answered(const Expression& expression);
  /// The variable as it stands; null: not declared.
  const Value* variable(const std::string& name);
  /// What the user gives for a name or path; absent: nothing.
  std::optional<Value> given(const std::string& name);
  /// The same for what stands in the line that runs: "cell.mod:12:cjointt", else "cjointt".
  std::optional<Value> given_here(const std::string& what);
  std::string name_here(const std::string& what) const;
  /// The name by which the user gives a variable or a part of one: with its module or routine where others
  /// have that name, too.
  std::string answer_name(const std::string& path);
  /// Where the variable that an expression begins with was last written; line 0: not in the files.
  Place origin(const Expression& expression);
  /// Name of the data that an expression is; of a parameter, of what the caller gave. Empty: it is no name.
  std::string name_of(const Expression& expression);
  /// Whether the program has written to the data that an expression begins with.
  bool was_assigned(const Expression& expression) const;
  /// The expression as it stands in its file, up to the argument's end.
  std::string written(const Expression& expression) const;
  /// Runs a routine by its name, "name" or "module:name".
  void run_named(const std::string& name, const std::vector<Expression>& arguments, const Place& place);
  /// Whether the argument that \name?value names was given to the routine that runs.
  bool present(const Expression& argument);
  /// The variable becomes unknown, or what the user gives for it, because of `who`.
  void make_unknown(const Expression& target, Cause cause);
  /// The same for all that a call of a routine may write to, as it stands in a module.
  void forget_writes_of(const Statement& call, int module, const std::string& why);
  /// Every number and text of all modules becomes unknown: what is not read may have written it. Lists stay.
  void forget_numbers(const std::string& why);
  /// Of all modules, as it was written there.
  void set(const std::string& name, Value value, const Place& written = {});
  void forget(const std::string& name);
  void assign(const Expression& target, Value value);
  /// "$vel.cp", "p[3].x": under which a part of an undeclared variable is kept; empty: an index is unknown.
  std::string path_of(const Expression& expression);
  void emit(Instruction instruction, const Statement& statement);
  void note(const Place& place, const std::string& what, bool may_move = false);
  void complain(const Place& place, const std::string& what, const std::string& remedy);
  /// A missing value is reported once for all of its uses. decision: it is which way a statement goes.
  void miss(const std::string& name, const Place& place, const std::string& what, const std::string& remedy,
            std::vector<Question> questions = {}, bool decision = false);
  /// Asks for all that makes a value unknown. `remedy` goes before "--value ..."; `form`: how the value itself
  /// is written.
  void ask_for(const Value& unknown, const Place& place, const std::string& what, const std::string& remedy,
               const std::string& form);
  /// ": k is read by TPReadNum (m.mod:9)", or nothing.
  std::string because(const Value& unknown) const;
  /// "--value 'k=...' ", or nothing: what would make it known.
  std::string remedy_for(const Value& unknown) const;
  std::vector<Question> questions_for(const Value& unknown, const std::string& form);
  /// Problems so far, with those that count for nothing because they lie behind a guess.
  std::size_t problem_count() const { return problems_.count() + dropped_; }
  pipeline::Where where(const Place& place) const;
  std::string short_place(const Place& place) const;  ///< "main.mod:12"
  std::string routine_at(const Place& place) const;
  const ImportOptions& options() const { return options_; }
  int module() const { return module_; }  ///< whose names are seen; -1: none's
  Program& program() { return program_; }
  /// Index of the frame in the list; added when it is new.
  int frame_index(std::vector<NamedFrame>& list, const NamedFrame& frame);
  /// Gives a list its record's type, fields in their order; false: it does not fit.
  bool shape(Value& value, const RecordType* type) const;

 private:
  enum class Flow { next, leave_loop, give_back, jump };
  struct Stop {};        // thrown: the program ends, or goes past a limit
  struct EndOfCycle {};  // thrown: the controller begins its routine again
  struct Variable {
    enum class State { declared, being_read, ready };
    const Datum* datum = nullptr;  // null: made by an assignment
    const Datum* rival = nullptr;  // another declaration of the same name, with another value
    State state = State::declared;
    Value value;
    Place written;          // where it was declared or last assigned; line 0: by no line
    bool assigned = false;  // since it was declared: part of the program's state
    bool counter = false;   // of a FOR that runs, which alone writes to it
    std::string alias{};    // of a parameter: the name that the caller gave
    const Statement* declaration = nullptr;  // null: of a parameter, or made by an assignment
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
  static const Parameter* parameter_of(const Routine& routine, const Expression& argument,
                                       std::size_t& position);
  Value call(const Routine& routine, const std::vector<Expression>& arguments, const Place& place);
  std::uint64_t state(bool with_locals = true) const;
  void call_within_itself(const Routine& routine);
  [[noreturn]] void end_within_itself(const Routine& routine);
  int ask(const Place& place, const std::string& what, const Value& unknown, const std::string& answers,
          int ways, bool by_value, const std::string& form);
  int guess(const Place& place, int ways);
  std::string form_of(const std::string& name);
  bool compares_known(const Expression& condition);
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
  void forget_arguments(const std::string& name, const std::vector<Expression>& arguments,
                        const Place& place);
  bool holds_loop_exit(const std::vector<Statement>& body) const;
  bool jumps_for_ever(const std::vector<Statement>& body, std::size_t label, std::size_t jump) const;
  void end_where_it_repeats(Passes& passes, const Place& place);

  Value evaluate_inner(const Expression& expression);
  Value name_value(const Expression& expression);
  Value call_value(const Expression& expression);
  Value unknown_index(const Expression& expression);
  std::optional<Value> character_of(const Expression& expression);
  std::optional<Value> value_written_beside(const Expression& expression);
  Value why_unknown(const std::vector<Expression>& expressions);
  Value unary(const Expression& expression);
  Value binary(const Expression& expression);
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
  Dialect& dialect_;
  const ImportOptions& options_;
  Program& program_;
  Problems& problems_;
  Scope globals_;
  std::vector<Scope> module_data_;  // of LOCAL data
  std::deque<Scope> locals_;        // stay where they are while routines are called
  int module_ = -1;                 // whose names are seen
  Exploration& exploration_;
  std::set<std::string> used_values_, used_assumptions_;
  std::map<std::string, std::string> given_to_;  // a value without its module -> whose name it first was
  std::map<std::string, int> holders_;           // name -> routines and modules that declare it
  int modules_apart_ = 0;                        // modules that keep names which no file declares
  std::size_t dropped_ = 0;                      // problems behind a guess
  int quiet_ = 0;                                // above 0: nothing is reported
  long guessed_at_ = -1;                         // executed_ at the first guess; -1: there was none
  Place here_;                                   // of the statement that runs
  std::map<const Routine*, bool> routine_moves_;
  struct Loop {
    Place place;
    long passes = 0;
  };
  const Routine* started_ = nullptr;
  std::optional<Passes> within_itself_;  // of the routine that was started, by its calls of itself
  std::vector<Loop> loops_;              // that are running, outermost first
  std::vector<const std::vector<Statement>*> endless_;  // bodies that run again and again, outermost first
  std::set<const Routine*> reported_handlers_;
  std::vector<const Routine*> routines_;
  Value result_;
  const Statement* jump_ = nullptr;  // on its way to its label
  std::deque<RecordType> records_;   // of aggregates with names
  std::map<std::string, const RecordType*> record_of_;
  std::map<std::string, int> frames_;          // name and contents -> index in the program's list
  std::map<std::string, int> frame_variants_;  // name -> how many contents it had
  long executed_ = 0;
  int depth_ = 0;
};

}  // namespace dresslife::sim
