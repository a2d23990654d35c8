// Advance stops at names of inputs, outputs and imported variables.
#include <algorithm>
#include <map>
#include <optional>

#include "sim/program/krl/krl.h"

namespace dresslife::sim {

Statement stop_of_advance(const Place& place) {
  Statement stop = statement_at(place, Statement::Kind::instruction, advance_stop);
  stop.text = advance_stop;
  return stop;
}

namespace {

using Kind = Statement::Kind;
using Names = std::map<std::string, bool, std::less<>>;  // declared name -> true: a signal or imported

class Marker {
 public:
  explicit Marker(const Code& code) : of_modules_(code.modules.size()) {
    for (const Datum& datum : code.data) declare(datum.statement, datum.local ? of_modules_[datum.module] : shared_);
  }

  void mark(Routine& routine) {
    own_.clear();
    module_ = routine.module;
    for (const Parameter& parameter : routine.parameters) own_[parameter.name] = false;
    for (const Statement& statement : routine.body) declare(statement, own_);
    mark(routine.body);
  }

 private:
  static void declare(const Statement& statement, Names& names) {
    if (statement.kind == Kind::declare)
      names[statement.name] |= statement.text == "signal" || statement.text == "import";
  }

  /// Whether a name is a signal or imported; std::nullopt: no file declares it.
  std::optional<bool> is_signal(const std::string& name) const {
    for (const Names* names : {&own_, &of_modules_[module_], &shared_})
      if (const auto found = names->find(name); found != names->end()) return found->second;
    return {};
  }

  bool has_signal(const Expression& expression) const {
    if (expression.kind == Expression::Kind::name && is_signal(expression.text).value_or(false)) return true;
    return std::ranges::any_of(expression.items, [&](const Expression& item) { return has_signal(item); });
  }

  /// Whether the statement's own line contains a signal; its inner blocks do not count.
  bool has_signal(const Statement& statement) const {
    const auto in = [&](const std::vector<Expression>& expressions) {
      return std::ranges::any_of(expressions, [&](const Expression& e) { return has_signal(e); });
    };
    return in(statement.arguments) ||
           std::ranges::any_of(statement.branches, [&](const Branch& branch) { return in(branch.conditions); });
  }

  void mark(std::vector<Statement>& body) const {
    std::vector<Statement> marked;
    for (Statement& statement : body) {
      // TRIGGER and INTERRUPT take effect later, a declaration only defines a name. Neither stops the advance.
      const bool later = statement.name == "trigger" || statement.name.starts_with("interrupt_");
      const bool waits = !later && statement.kind != Kind::declare && has_signal(statement);
      const bool repeats = statement.kind == Kind::while_loop || statement.kind == Kind::until_loop;
      const bool outputs = statement.kind == Kind::assign && statement.arguments[0].kind == Expression::Kind::name &&
                           statement.arguments[1].kind == Expression::Kind::truth &&
                           !statement.arguments[0].text.starts_with("$") && !is_signal(statement.arguments[0].text);
      if (!later)
        for (Branch& branch : statement.branches) mark(branch.body);
      if (waits && repeats) statement.branches[0].body.push_back(stop_of_advance(statement.place));
      if ((waits || outputs) && !statement.continued && statement.kind != Kind::until_loop)
        marked.push_back(stop_of_advance(statement.place));
      if (outputs && !statement.continued) marked.back().arguments = {statement.arguments[0]};
      marked.push_back(std::move(statement));
    }
    body = std::move(marked);
  }

  Names shared_, own_;
  std::vector<Names> of_modules_;
  int module_ = 0;
};

}  // namespace

void stop_at_signals(Code& code) {
  Marker marker(code);
  for (Routine& routine : code.routines) marker.mark(routine);
}

}  // namespace dresslife::sim
