// The tree of a program: expressions, statements, routines. The parsers write it and the interpreter runs it.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "sim/program/interpreter/program.h"

namespace dresslife::sim {

struct Place {
  int file = 0, line = 0, column = 0;
};

struct Expression {
  enum class Kind {
    none,  ///< no value: a switch (option without value), an empty index []
    number,
    text,
    truth,  ///< number 0 or 1
    name,
    unary,     ///< text: operator, items[0]
    binary,    ///< text: operator, items[0], items[1]
    call,      ///< text: name, items: arguments
    element,   ///< items[0]: the list, items[1], ...: the indices (count from 1)
    field,     ///< text: name of the field, items[0]: the record
    aggregate  ///< items: the components; keys: their names; keys empty: in the record's order
  };
  Kind kind = Kind::none;
  std::string text;  ///< lower case, except the contents of Kind::text
  double number = 0;
  bool whole = false;  ///< the number is written as an INT of KRL
  std::vector<Expression> items;
  std::vector<std::string> keys;  ///< lower case
  std::string option;             ///< name of an argument given by name (\WObj:=...); lower case
  bool in_parentheses = false;
  bool mixes_levels = false;  ///< KRL: comparisons and logical operators without parentheses (Interpreter::mixed)
  bool if_present = false;    ///< argument \name?value: given only if the routine got the argument `value`
  Place place;
  int depth = 1;  ///< levels of items
};

/// Returns an expression; its depth is one more than the largest depth of its items.
Expression expression_at(const Place& place, Expression::Kind kind, std::string text = "",
                         std::vector<Expression> items = {});
/// Returns an expression that names a variable.
Expression name_at(const std::string& name, const Place& place);
Expression number_at(const Place& place, double number);

struct Statement;

struct Branch {
  std::vector<Expression> conditions;  ///< IF: one condition; TEST, SWITCH: values of the case; empty: ELSE, DEFAULT
  std::vector<Statement> body;
  Place place;
};

struct Statement {
  enum class Kind {
    assign,       ///< arguments: target, value
    branch,       ///< IF: branches
    choose,       ///< TEST, SWITCH: arguments[0], branches
    count,        ///< FOR: name, arguments: from, to, step (may be left out); branches[0].body
    while_loop,   ///< arguments[0]; branches[0].body
    until_loop,   ///< arguments[0]; branches[0].body
    endless,      ///< branches[0].body
    instruction,  ///< name, arguments: a routine of the program or a word of the language
    give_back,    ///< RETURN, arguments[0] or none
    leave_loop,   ///< KRL's EXIT
    label,        ///< name
    jump,         ///< GOTO; name: a label in one of the enclosing blocks of the routine
    finish,       ///< end of the program
    end_cycle,    ///< start of the next cycle (RAPID's ExitCycle)
    declare       ///< name, type in `text`, arguments: value or none, then the dimensions
  };
  Kind kind = Kind::instruction;
  std::string name;  ///< lower case
  std::string text;
  std::vector<Expression> arguments;
  std::vector<Branch> branches;
  bool keeps_counter = false;  ///< FOR: the counter is a variable of the program and keeps its value after the loop
  bool elsewhere = false;      ///< declare: no value here, because another task's module gives it
  bool constant = false;       ///< declare: the program cannot write to it
  bool continued = false;      ///< KRL's CONTINUE precedes the statement
  Place place;
};

Statement statement_at(const Place& place, Statement::Kind kind, std::string name = "");
/// Returns a declaration. value of Expression::Kind::none: the variable has no value.
Statement declaration_at(const Place& place, const std::string& name, const std::string& type, Expression value = {});

struct Parameter {
  std::string name;
  bool option = false;      ///< the caller gives it by its name
  bool given_back = false;  ///< an assignment to it changes the caller's variable
};

struct Routine {
  std::string name, written;  ///< lower case, as written
  std::vector<Parameter> parameters;
  std::vector<Statement> body;
  Place place;
  int last_line = 0;                       ///< last line of the routine
  int module = -1;                         ///< index into Code::modules; -1: none
  bool local = false;                      ///< visible only in its module
  std::vector<Problem> problems;           ///< problems of its lines; they are reported if the routine runs
  Place handler;                           ///< place of the error handler (RAPID's ERROR, UNDO, BACKWARD)
  std::vector<std::string> handler_words;  ///< words of the handler, in lower case; the handler does not run
  std::string robot;  ///< robots that an INFORM job moves: "rb1", "rb1,rb2"; empty: the job names none
};

/// A scope of names: a RAPID module, or a KRL program with the data list of its name.
struct Module {
  std::string name, written;  ///< lower case, as written
  Place place;
  bool whole = true;  ///< all its files are read: another module declares the names that it does not declare
};

/// A declaration or assignment outside of routines.
struct Datum {
  Statement statement;
  int module = -1;
  bool local = false;      ///< visible only in its module
  bool by_backup = false;  ///< value at the time of the backup; used if no program assigns a value
};

/// Name of the instruction that calls the routine named by its first argument: %"step" + ValToStr(n)%.
inline constexpr const char* late_binding = "%";

/// Name of the instruction for an empty placeholder (<SMT>). The program ends at it.
inline constexpr const char* unwritten_statement = "<SMT>";

/// Fields of a record in their order.
struct RecordType {
  std::string name;
  std::vector<std::string> fields;
  std::vector<const RecordType*> types;    ///< types of the fields that are records; null: single value
  std::vector<std::string> field_types{};  ///< type names of a KRL structure, in lower case; else empty
  std::vector<int> sizes{};                ///< list sizes of a KRL structure; 0: the field is not a list
  int optional_from = 1'000'000;           ///< index of the first field that an aggregate may omit
  bool indexed = false;                    ///< fields can be accessed by number, too: URScript's pose[2]
};

/// A safe answer: the value with which controllers are delivered.
struct Preset {
  std::string text;
  Expression value;
};

struct Code {
  std::deque<SourceFile> files;  // tokens point into them
  std::vector<Module> modules;
  std::deque<Routine> routines;
  std::deque<Datum> data;
  std::deque<RecordType> records;
  std::vector<Problem> problems;             ///< problems outside of routines
  std::map<std::string, Expression> values;  ///< the user's values; names in lower case, without blanks
  /// "file.mod:12" or "12" -> the value for an undecided TEST or SWITCH.
  std::map<std::string, Expression> choices;
  std::map<std::string, Preset> presets;              ///< safe answers for names that the user may give
  std::map<std::string, std::string> written_beside;  ///< ImportOptions::written_beside, and submit programs
  std::string start;  ///< routine to run, in lower case; empty: the default of the language
  std::vector<Expression> start_arguments;

  /// Returns the routine of a name: the module's local routine, else the routine of all modules; null: none.
  const Routine* find(const std::string& name, int module) const;
  /// Returns the routine `name` of the module `module`; null: none.
  const Routine* find_in(const std::string& module, const std::string& name) const;
  /// Returns another routine with the same name and scope; null: none.
  const Routine* rival(const Routine& routine) const;
  const RecordType* record(const std::string& name) const;
  /// Returns whether a statement of a body, or of a routine that the body calls, has a property. levels: of nested calls.
  bool reaches(const std::vector<Statement>& body, int module, int levels,
               const std::function<bool(const Statement&)>& has) const;
  /// Builds the tables of find(). To be called once after all files are read.
  void index();
  /// Moves the problems of a file to the routines that contain their lines, the others to `problems`.
  void sort_problems(int file, const Problems& found);

 private:
  using Scope = std::map<std::string, std::vector<const Routine*>, std::less<>>;
  const Scope& scope_of(const Routine& routine) const;
  Scope global_;
  std::vector<Scope> local_;
};

}  // namespace dresslife::sim
