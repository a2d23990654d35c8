#include "sim/program/interpreter/code.h"

#include <algorithm>

namespace dresslife::sim {

Expression expression_at(const Place& place, Expression::Kind kind, std::string text, std::vector<Expression> items) {
  Expression e;
  e.kind = kind;
  e.place = place;
  e.text = std::move(text);
  e.items = std::move(items);
  for (const Expression& item : e.items) e.depth = std::max(e.depth, item.depth + 1);
  return e;
}

Expression name_at(const std::string& name, const Place& place) {
  return expression_at(place, Expression::Kind::name, name);
}

Expression number_at(const Place& place, double number) {
  Expression e = expression_at(place, Expression::Kind::number);
  e.number = number;
  return e;
}

Statement statement_at(const Place& place, Statement::Kind kind, std::string name) {
  Statement s;
  s.kind = kind;
  s.place = place;
  s.name = std::move(name);
  return s;
}

Statement declaration_at(const Place& place, const std::string& name, const std::string& type, Expression value) {
  Statement s = statement_at(place, Statement::Kind::declare, name);
  s.text = type;
  s.arguments.push_back(std::move(value));
  return s;
}

void Code::index() {
  local_.assign(modules.size(), {});
  for (const Routine& routine : routines)
    (routine.local && routine.module >= 0 ? local_[routine.module] : global_)[routine.name].push_back(&routine);
}

const Routine* Code::find(const std::string& name, int module) const {
  if (module >= 0 && module < static_cast<int>(local_.size()))
    if (const auto found = local_[module].find(name); found != local_[module].end()) return found->second.front();
  const auto found = global_.find(name);
  return found == global_.end() ? nullptr : found->second.front();
}

const Routine* Code::find_in(const std::string& module, const std::string& name) const {
  for (const Routine& routine : routines)
    if (routine.name == name && routine.module >= 0 && modules[routine.module].name == module) return &routine;
  return nullptr;
}

const Code::Scope& Code::scope_of(const Routine& routine) const {
  return routine.local && routine.module >= 0 ? local_[routine.module] : global_;
}

const Routine* Code::rival(const Routine& routine) const {
  const Scope& scope = scope_of(routine);
  const auto found = scope.find(routine.name);
  if (found == scope.end() || found->second.size() < 2) return nullptr;
  return found->second[found->second[0] == &routine];
}

const RecordType* Code::record(const std::string& name) const {
  for (const RecordType& type : records)
    if (type.name == name) return &type;
  return nullptr;
}

bool Code::reaches(const std::vector<Statement>& body, int module, int levels,
                   const std::function<bool(const Statement&)>& has) const {
  return std::ranges::any_of(body, [&](const Statement& statement) {
    const bool calls = levels > 1 && statement.kind == Statement::Kind::instruction;
    const Routine* called = calls ? find(statement.name, module) : nullptr;
    return has(statement) || (called && reaches(called->body, called->module, levels - 1, has)) ||
           std::ranges::any_of(statement.branches,
                               [&](const Branch& branch) { return reaches(branch.body, module, levels, has); });
  });
}

void Code::sort_problems(int file, const Problems& found) {
  for (const Problem& problem : found.list()) {
    Routine* holder = nullptr;
    for (Routine& routine : routines)
      if (routine.place.file == file && routine.place.line <= problem.where.line &&
          problem.where.line <= routine.last_line)
        holder = &routine;
    (holder ? holder->problems : problems).push_back(problem);
  }
}

}  // namespace dresslife::sim
