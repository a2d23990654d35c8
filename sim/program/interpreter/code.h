// RAPID and KRL as a tree: expressions, statements, routines. Both languages are read into it and run from
// it.
#pragma once

#include <deque>
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
    none,  ///< left out: an optional argument's switch, an index []
    number,
    text,
    truth,  ///< number 0 or 1
    name,
    unary,     ///< text: operator, items[0]
    binary,    ///< text: operator, items[0], items[1]
    call,      ///< text: name, items: arguments
    element,   ///< items[0]: of what, then the indices from 1
    field,     ///< text: its name, items[0]: of what
    aggregate  ///< items, with their names in `keys` or in their order
  };
  Kind kind = Kind::none;
  std::string text;  ///< lower case, but for texts
  double number = 0;
  bool whole = false;  ///< of a number: written as an INT of KRL
  std::vector<Expression> items;
  std::vector<std::string> keys;  ///< lower case
  std::string option;             ///< of an argument given by name (\WObj:=...); lower case
  bool if_present = false;        ///< of an argument \name?value: given only if the value's name is
  Place place;
  int depth = 1;  ///< levels of items
};

/// An expression whose depth is that of its items and one more.
Expression expression_at(const Place& place, Expression::Kind kind, std::string text = "",
                         std::vector<Expression> items = {});
/// The variable of that name.
Expression name_at(const std::string& name, const Place& place);
Expression number_at(const Place& place, double number);

struct Statement;

struct Branch {
  std::vector<Expression>
      conditions;  ///< of IF: one; of TEST and SWITCH: the case's values; empty: otherwise
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
    jump,         ///< GOTO name: a label of the routine, in one of the blocks around
    finish,       ///< the program ends here
    end_cycle,    ///< what the controller runs again and again starts over (RAPID's ExitCycle)
    declare       ///< name, type in `text`, arguments: value or none, then the dimensions
  };
  Kind kind = Kind::instruction;
  std::string name;  ///< lower case
  std::string text;
  std::vector<Expression> arguments;
  std::vector<Branch> branches;
  bool keeps_counter = false;  ///< FOR: its variable is the program's, and goes on behind the loop
  bool elsewhere = false;      ///< declare: without a value here because another task's module gives it
  bool constant = false;       ///< declare: nothing can write to it
  bool continued = false;      ///< KRL's CONTINUE stands before it
  Place place;
};

Statement statement_at(const Place& place, Statement::Kind kind, std::string name = "");
/// value: Expression::Kind::none: it has none.
Statement declaration_at(const Place& place, const std::string& name, const std::string& type, Expression value = {});

struct Parameter {
  std::string name;
  bool option = false;      ///< given by its name
  bool given_back = false;  ///< what the routine assigns to it, the caller's variable gets
};

struct Routine {
  std::string name, written;  ///< lower case, as written
  std::vector<Parameter> parameters;
  std::vector<Statement> body;
  Place place;
  int last_line = 0;                       ///< of the lines that belong to it
  int module = -1;                         ///< index into Code::modules; -1: none
  bool local = false;                      ///< known in its module alone
  std::vector<Problem> problems;           ///< of its lines; they count when it is run
  Place handler;                           ///< of errors (RAPID's ERROR, UNDO, BACKWARD)
  std::vector<std::string> handler_words;  ///< in it, in lower case; it is not run
  std::string robot;  ///< of an INFORM job: "rb1" that it moves, "rb1,rb2"; empty: none is named
};

/// What has names of its own: a RAPID module; a KRL program with the data list of its name.
struct Module {
  std::string name, written;  ///< lower case, as written
  Place place;
  bool whole = true;  ///< no file of it is missing: what it does not declare, another module does
};

/// A declaration or assignment outside of routines.
struct Datum {
  Statement statement;
  int module = -1;
  bool local = false;      ///< known in its module alone
  bool by_backup = false;  ///< a value of the time of the backup: it counts where no program gives one
};

/// Name of an instruction whose first argument names the routine that it calls: %"step" + ValToStr(n)%;
inline constexpr const char* late_binding = "%";

/// Name of the instruction for an empty placeholder (<SMT>); the program ends there.
inline constexpr const char* unwritten_statement = "<SMT>";

/// Fields of a record, in their order; types: of records within, null for single values.
struct RecordType {
  std::string name;
  std::vector<std::string> fields;
  std::vector<const RecordType*> types;
  std::vector<std::string> field_types{};  ///< of a KRL structure, in lower case; else empty
  std::vector<int> sizes{};                ///< of a KRL structure: of fields that are lists, else 0
  int optional_from = 1'000'000;           ///< fields from here on may be left out
  bool indexed = false;                    ///< its fields have numbers, too: URScript's pose[2]
};

/// An answer that is safe: what controllers are delivered with.
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
  std::vector<Problem> problems;             ///< outside of routines
  std::map<std::string, Expression> values;  ///< that the user gives; names in lower case, without blanks
  /// "file.mod:12" or "12" -> the value by which an undecided TEST or SWITCH chooses.
  std::map<std::string, Expression> choices;
  std::map<std::string, Preset> presets;              ///< safe answers for names that the user may give
  std::map<std::string, std::string> written_beside;  ///< ImportOptions::written_beside, and submit programs
  std::string start;  ///< routine to run, in lower case; empty: the language's own
  std::vector<Expression> start_arguments;

  /// The routine that a name means within a module: its own local one, else the one of all modules.
  const Routine* find(const std::string& name, int module) const;
  /// The routine of that name which stands in that module; null: there is none.
  const Routine* find_in(const std::string& module, const std::string& name) const;
  /// Another routine that the same name means as well; null: there is none.
  const Routine* rival(const Routine& routine) const;
  const RecordType* record(const std::string& name) const;
  /// To be called once when all is read.
  void index();
  /// Gives the problems of a file's reading to the routines that hold their lines, the others to `problems`.
  void sort_problems(int file, const Problems& found);

 private:
  using Scope = std::map<std::string, std::vector<const Routine*>, std::less<>>;
  const Scope& scope_of(const Routine& routine) const;
  Scope global_;
  std::vector<Scope> local_;
};

}  // namespace dresslife::sim
