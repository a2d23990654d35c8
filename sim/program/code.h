// RAPID and KRL as a tree: expressions, statements, routines. Both languages are read into it and run from
// it.
#pragma once

#include <deque>
#include <map>
#include <string>
#include <vector>

#include "sim/program/program.h"

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
  std::vector<Expression> items;
  std::vector<std::string> keys;  ///< lower case
  std::string option;             ///< of an argument given by name (\WObj:=...); lower case
  Place place;
  int depth = 1;  ///< levels of items
};

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
    declare       ///< name, type in `text`, arguments: value or none, then the dimensions
  };
  Kind kind = Kind::instruction;
  std::string name;  ///< lower case
  std::string text;
  std::vector<Expression> arguments;
  std::vector<Branch> branches;
  bool keeps_counter = false;  ///< FOR: its variable is the program's, and goes on behind the loop
  Place place;
};

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
};

/// Fields of a record, in their order; types: of records within, null for single values.
struct RecordType {
  std::string name;
  std::vector<std::string> fields;
  std::vector<const RecordType*> types;
  int optional_from = 1'000'000;  ///< fields from here on may be left out
};

struct Code {
  std::deque<SourceFile> files;  // tokens point into them
  std::vector<Routine> routines;
  std::vector<Statement> data;  ///< declarations outside of routines
  std::deque<RecordType> records;

  const Routine* find(const std::string& name) const;  ///< name in lower case
  const RecordType* record(const std::string& name) const;
  void index();  ///< to be called once when all is read

 private:
  std::map<std::string, std::size_t, std::less<>> by_name_;
};

}  // namespace dresslife::sim
