// Expressions: evaluation, variables, assignment.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>

#include "sim/program/interpreter/interpreter.h"
#include "sim/program/interpreter/job_words.h"
#include "sim/program/interpreter/parser.h"
#include "sim/program/interpreter/request.h"

namespace dresslife::sim {
namespace {

using Form = Expression::Kind;

constexpr int value_depth = 12;  // levels of nested records
constexpr std::size_t text_length = 1000;

/// Returns what the fields and elements of a reference are parts of: `a` of a.b[3].
const Expression& reference_base(const Expression& reference) {
  const Expression* base = &reference;
  while (base->kind == Form::field || base->kind == Form::element) base = &base->items[0];
  return *base;
}

}  // namespace

/// Counts the levels of nested evaluation. The limits of the parser and of calls keep them within the stack.
Value Interpreter::evaluate(const Expression& expression) {
  struct Level {
    int& depth;
    ~Level() { --depth; }
  } level{++depth_};
  charge(1);
  if (depth_ > 4000) {
    complain(expression.place, "is nested too deeply, functions included", "write it simpler");
    throw Stop{};
  }
  return evaluate_inner(expression);
}

Value Interpreter::evaluate_inner(const Expression& expression) {
  switch (expression.kind) {
    case Form::none:
      return {};
    case Form::number: {
      Value value = number_value(expression.number);
      if (expression.whole) value.numeric = Value::Numeric::integer;
      return value;
    }
    case Form::text:
      return text_value(expression.text);
    case Form::truth:
      return truth_value(expression.number != 0);
    case Form::unary:
      return unary(expression);
    case Form::binary:
      return binary(expression);
    case Form::aggregate:
      return aggregate(expression);
    case Form::call:
      return call_value(expression);
    case Form::name:
    case Form::element:
    case Form::field:
      return name_value(expression);
  }
  return {};
}

std::optional<double> Interpreter::number(const Expression& expression) {
  const Value value = evaluate(expression);
  return value.is_number() ? std::optional(value.number) : std::nullopt;
}

Value Interpreter::answered(const Expression& expression) {
  const std::size_t problems = problem_count();
  Value value = evaluate(expression);
  // The parts of a list have their own questions; in KRL some parts may be unset.
  if (value.known() || value.kind == Value::Kind::list || problem_count() != problems) return value;
  const std::string text = written(expression);
  if (std::optional<Value> known = given_here(text)) return *known;
  const std::vector<const Cause*> causes = value.causes();
  const bool named =
      std::ranges::any_of(causes, [](const Cause* cause) { return !cause->asked().empty() || !cause->line.empty(); });
  if (named || text.empty()) return value;
  return unknown_value(name_here(text), causes.empty() ? "is not known offline" : causes[0]->why);
}

Value Interpreter::call_value(const Expression& expression) {
  if (const Routine* routine = routine_named(expression.text, expression.place))
    return call(*routine, expression.items, expression.place);
  std::optional<Value> value = dialect_.function(expression);
  if (value && value->known()) return *value;
  // A function that reads an input, or a routine of a missing file: the user may give the value.
  if (std::optional<Value> known = given_here(expression.text)) return *known;
  if (value && value->first_cause()) return *value;
  if (const Value cause = why_unknown(expression.items); cause.cause) return cause;
  if (value) return unknown_value(expression.text, "is a function of what the robot meets");
  forget_arguments(expression.text, expression.items, expression.place);
  return unknown_value(expression.text, "is a function that no file read holds");
}

/// Returns an unknown value with the causes of the expressions. Does not run a function a second time.
Value Interpreter::why_unknown(const std::vector<Expression>& expressions) {
  Value why;
  for (const Expression& e : expressions) {
    const bool data = e.kind == Form::name || e.kind == Form::field || e.kind == Form::element;
    why = unknown_value(why, data ? evaluate(e) : why_unknown(e.items));
  }
  return why;
}

// ---- variables --------------------------------------------------------------------------------------------

/// Separates data of all modules from data of one module, and finds names that are declared twice.
void Interpreter::index_data() {
  module_data_.assign(code_.modules.size(), {});
  std::map<std::string, std::set<const Scope*>, std::less<>> scopes;  // scopes of the names that the user gives
  for (const Datum& datum : code_.data) {
    if (datum.statement.kind != Statement::Kind::declare) continue;
    Scope& scope = datum.local && datum.module >= 0 ? module_data_[datum.module] : globals_;
    if (code_.values.contains(datum.statement.name)) scopes[datum.statement.name].insert(&scope);
    Variable& variable = scope[datum.statement.name];
    if (variable.datum && datum.by_backup) continue;
    if (!variable.datum || variable.datum->by_backup) {
      variable.datum = &datum;
      variable.written = datum.statement.place;
    } else if (!variable.rival && !same_declaration(*variable.datum, datum)) {
      variable.rival = &datum;
    }
  }
  for (const auto& [name, holders] : scopes)
    if (holders.size() > 1)
      complain(code_.values.at(name).place,
               fmt::format("is a name that {} modules have each for themselves", holders.size()),
               "write " + values_of_job({"MODULE:" + name}));
  count_holders();
}

/// Counts the routines and modules that declare each name.
void Interpreter::count_holders() {
  for (const Scope& scope : module_data_)
    for (const auto& [name, variable] : scope) ++holders_[name];
  for (const auto& [name, variable] : globals_) ++holders_[name];
  for (const Routine& routine : code_.routines) {
    std::set<std::string> names;
    for (const Parameter& parameter : routine.parameters) names.insert(parameter.name);
    for (const Statement& statement : routine.body)
      if (statement.kind == Statement::Kind::declare) names.insert(statement.name);
    for (const std::string& name : names) ++holders_[name];
  }
  for (int module = 0; module < static_cast<int>(code_.modules.size()); ++module)
    modules_apart_ += !dialect_.shares("name", module);
}

namespace {

bool same_expression(const Expression& a, const Expression& b) {
  return a.kind == b.kind && a.text == b.text && a.number == b.number && a.keys == b.keys &&
         std::equal(a.items.begin(), a.items.end(), b.items.begin(), b.items.end(), same_expression);
}

}  // namespace

bool Interpreter::same_declaration(const Datum& a, const Datum& b) const {
  const auto& x = a.statement.arguments;
  const auto& y = b.statement.arguments;
  return a.statement.text == b.statement.text && std::equal(x.begin(), x.end(), y.begin(), y.end(), same_expression);
}

Interpreter::Variable* Interpreter::find(const std::string& name) {
  const auto within = [&](Scope& scope) {
    const auto found = scope.find(name);
    return found == scope.end() ? nullptr : &found->second;
  };
  if (!locals_.empty())
    if (Variable* local = within(locals_.back())) return local;
  if (module_ >= 0)
    if (Variable* own = within(module_data_[module_])) return own;
  return within(globals_);
}

/// Returns the value of a variable. The first use evaluates its declaration in the variable's own module.
Value* Interpreter::ready(Variable& variable) {
  using State = Variable::State;
  if (variable.state == State::ready) return &variable.value;
  if (variable.state == State::being_read) {
    complain(variable.written, fmt::format("gives '{}' a value that depends on itself", variable.datum->statement.name),
             "write it as a constant");
    return &variable.value;
  }
  const Statement& statement = variable.datum->statement;
  const auto copies = variable.rival ? dialect_.form_of_copies(statement.name) : std::nullopt;
  if (variable.rival && !copies)
    miss(rivals(statement.place, variable.rival->statement.place), statement.place,
         fmt::format("gives '{}' another value than {} does", statement.name,
                     where(variable.rival->statement.place).text()),
         "leave one of the two files out, or make the names those of their modules alone (LOCAL)");
  variable.state = State::being_read;
  const int module = std::exchange(module_, variable.datum->module);
  locals_.emplace_back();  // a declaration outside of routines sees no routine's variables
  std::optional<Value> value = given_for(*variable.datum);
  if (!value && copies) {
    value = unknown_value(upper_case(statement.name),
                          fmt::format("is another one in {}", where(variable.rival->statement.place).text()), *copies);
  }
  if (!value) value = declared_value(statement);
  locals_.pop_back();
  module_ = module;
  variable.value = *std::move(value);
  variable.state = State::ready;
  return &variable.value;
}

/// Returns the user's value for declared data, by "name", or by "module:name" if several modules declare the name.
std::optional<Value> Interpreter::given_for(const Datum& datum) {
  const Statement& statement = datum.statement;
  std::optional<Value> value;
  if (datum.module >= 0) value = given(fmt::format("{}:{}", code_.modules[datum.module].name, statement.name));
  if (!value) value = given(statement.name);
  if (!value && statement.elsewhere) value = dialect_.constant(statement.name);  // a frame that the user gives
  if (const RecordType* type = dialect_.type_of(statement.text); value && type && statement.arguments.size() == 1)
    if (!shape(*value, type))
      complain(statement.place,
               fmt::format("is given a value that has not the {} components of a {}", type->fields.size(), type->name),
               "write all of them in " + values_of_job({statement.name}));
  return value;
}

const Value* Interpreter::variable(const std::string& name) {
  Variable* found = find(name);
  return found ? ready(*found) : nullptr;
}

std::string Interpreter::answer_name(const std::string& path) {
  const std::string base = path.substr(0, path.find_first_of(".["));
  const auto known = holders_.find(base);
  const int holders = known == holders_.end() ? 0 : known->second;
  if (!locals_.empty() && !routines_.empty() && locals_.back().contains(base))
    return holders > 1 ? routines_.back()->name + ":" + path : path;
  if (module_ < 0 || path.starts_with("$")) return path;
  const bool own = module_data_[module_].contains(base);
  const bool apart = !own && !globals_.contains(base) && modules_apart_ > 1 && dialect_.is_of_module(base) &&
                     !dialect_.shares(base, module_);
  return (own && holders > 1) || apart ? code_.modules[module_].name + ":" + path : path;
}

std::optional<Value> Interpreter::given(const std::string& name) {
  if (exploration_.supposes_any())
    if (const std::string* standard = exploration_.supposed(answer_name(name)))
      return evaluate(code_.presets.at(*standard).value);
  if (code_.values.empty()) return {};
  const std::string unique = answer_name(name);
  const auto own = code_.values.find(unique);
  const auto found = own != code_.values.end() ? own : code_.values.find(name);
  if (found == code_.values.end()) return {};
  used_values_.insert(found->first);
  const std::string& first = given_to_.emplace(found->first, unique).first->second;
  if (found->first != unique && first != unique)
    miss("shared " + name, found->second.place,
         fmt::format("is a name that {} and {} mean each for themselves", first, unique),
         "give each its own value: " + values_of_job({first, unique}),
         {{Question::Kind::value, first, form_of(name)}, {Question::Kind::value, unique, form_of(name)}});
  return evaluate(found->second);
}

std::string Interpreter::name_here(const std::string& what) const { return short_place(here_) + ":" + what; }

std::optional<Value> Interpreter::given_here(const std::string& what) {
  if (code_.values.empty()) return {};
  for (const std::string& name : {value_key(name_here(what)), value_key(what)})
    if (const auto found = code_.values.find(name); found != code_.values.end()) {
      used_values_.insert(name);
      return evaluate(found->second);
    }
  return {};
}

Place Interpreter::origin(const Expression& expression) {
  const Expression& base = reference_base(expression);
  if (base.kind == Form::call && !base.items.empty()) return origin(base.items[0]);
  const Variable* found = base.kind == Form::name ? find(base.text) : nullptr;
  return found ? found->written : Place{};
}

void Interpreter::add_origin(Instruction& move, const char* part, const Expression& from, const std::string& written) {
  const Place place = origin(from);
  move.origins.push_back({part, written, place.line > 0 ? where(place) : pipeline::Where{}});
}

std::string Interpreter::written(const Expression& expression) const {
  const Expression* first = &expression;  // the first operand precedes the operator
  while ((first->kind == Form::binary || first->kind == Form::field || first->kind == Form::element) &&
         !first->items.empty())
    first = &first->items[0];
  const std::string line = code_.files[first->place.file].from(first->place.line, first->place.column);
  int depth = 0;
  std::size_t end = 0;
  for (; end < line.size(); ++end) {
    const char c = line[end];
    if (c == '(' || c == '[' || c == '{') ++depth;
    if ((c == ')' || c == ']' || c == '}') && --depth < 0) break;
    if (expression.kind == Form::call && depth == 0 && (c == ')' || c == ']')) {
      ++end;
      break;
    }
    if (depth == 0 && (c == ',' || c == ';' || c == '\\')) break;
  }
  while (end > 0 && line[end - 1] == ' ') --end;
  return line.substr(0, end);
}

void Interpreter::set(const std::string& name, Value value, const Place& written) {
  charge(value.weight());
  Variable& variable = globals_[name];
  variable.state = Variable::State::ready;
  variable.assigned = true;
  variable.written = written;
  variable.value = std::move(value);
}

void Interpreter::forget(const std::string& name) {
  if (const auto found = globals_.find(name); found != globals_.end()) globals_.erase(found);
}

/// Returns the variable, or the part of a variable, that an expression names; null: it does not exist.
Value* Interpreter::locate(const Expression& expression) {
  charge(1);
  if (expression.kind == Form::name) return const_cast<Value*>(variable(expression.text));
  if (expression.kind != Form::field && expression.kind != Form::element) return nullptr;
  // Indices first: a function in an index may change the variable and make a reference to its part invalid.
  std::vector<double> indices;
  for (std::size_t i = 1; expression.kind == Form::element && i < expression.items.size(); ++i) {
    const auto index = number(expression.items[i]);
    if (!index) return nullptr;
    indices.push_back(*index);
  }
  Value* whole = locate(expression.items[0]);
  if (!whole) return nullptr;
  if (expression.kind == Form::field) return const_cast<Value*>(whole->field(expression.text));
  for (double index : indices) {
    if (whole->kind != Value::Kind::list || (whole->type && !whole->type->indexed)) return nullptr;
    const auto count = static_cast<double>(whole->items.size());
    if (!(index >= 1 && index <= count) || index != std::trunc(index)) {
      complain(expression.place,
               fmt::format("has the index {} of a list of {}", index - 1 + dialect_.first_index(), count),
               "correct the index (the controller stops here)");
      return nullptr;
    }
    whole = &whole->items[static_cast<std::size_t>(index) - 1];
  }
  return whole;
}

std::string Interpreter::path_of(const Expression& expression) {
  if (expression.kind == Form::name) return expression.text;
  if (expression.kind != Form::field && expression.kind != Form::element) return "";
  std::string path = path_of(expression.items[0]);
  if (path.empty() || path.size() > text_length) return "";
  if (expression.kind == Form::field) return path + "." + expression.text;
  for (std::size_t i = 1; i < expression.items.size(); ++i) {
    const auto index = number(expression.items[i]);
    if (!index || !(std::abs(*index) < 1e9)) return "";
    path += fmt::format("[{}]", static_cast<long>(*index));
  }
  return path;
}

/// Returns the value of a variable that another program may write: the user's, else unknown. std::nullopt: none writes it.
std::optional<Value> Interpreter::value_written_beside(const Expression& expression) {
  const std::string& name = reference_base(expression).text;
  const auto written = code_.written_beside.find(name);
  const bool own = !locals_.empty() && locals_.back().contains(name);  // data lists are evaluated outside of routines
  if (written == code_.written_beside.end() || own) return {};
  const std::string path = path_of(expression);
  if (std::optional<Value> value = given(path)) return value;
  return unknown_value(answer_name(path.empty() ? name : path),
                       fmt::format("may be written by {}, which runs beside", written->second));
}

namespace {

/// Whether a value is unknown and its cause has no name (an input, a variable that was never written).
bool unset(const Value& value) {
  if (value.kind == Value::Kind::unknown) return value.cause && value.cause->name.empty();
  return value.kind == Value::Kind::list && !value.items.empty() && std::ranges::all_of(value.items, unset);
}

}  // namespace

Value Interpreter::name_value(const Expression& expression) {
  if (!code_.written_beside.empty())
    if (std::optional<Value> value = value_written_beside(expression)) return *value;
  if (expression.kind != Form::name) {
    if (const std::string path = path_of(expression); !path.empty()) {
      if (const Value* value = variable(path)) return *value;
      if (std::optional<Value> value = dialect_.constant(path)) return *value;
    }
    // A part of an element that is stored under its path.
    const Value whole = locate(expression.items[0]) ? Value{} : name_value(expression.items[0]);
    if (const Value* part = part_of_given(const_cast<Value&>(whole), expression)) return *part;
    if (whole.kind == Value::Kind::unknown && expression.items[0].text.starts_with("$") &&
        dialect_.constant(expression.items[0].text))  // the robot's position as a whole, not its parts
      if (std::optional<Value> part = given(path_of(expression)); part || whole.cause) return part ? *part : whole;
    if (std::optional<Value> character = character_of(expression)) return *character;
  }
  if (const Value* value = locate(expression)) {
    charge(value->weight());
    if (!code_.values.empty() && unset(*value))
      if (std::optional<Value> known = given(path_of(expression))) return *known;
    const bool unnamed = value->kind == Value::Kind::unknown && value->cause && value->cause->name.empty();
    return unnamed ? unknown_value(answer_name(path_of(expression)), value->cause->why) : *value;
  }
  if (expression.kind == Form::name)
    if (std::optional<Value> value = dialect_.constant(expression.text)) return *value;
  const std::string path = path_of(expression);
  if (path.empty()) return unknown_index(expression);
  if (std::optional<Value> value = given(path)) return *value;
  return unknown_value(answer_name(path), path.starts_with("$") ? "is a variable of the system that no file read sets"
                                                                : "is a name that no file read declares");
}

/// Returns s[2] of a KRL text that was assigned to s[]; std::nullopt: not an element of a text.
std::optional<Value> Interpreter::character_of(const Expression& expression) {
  if (expression.kind != Form::element || expression.items.size() != 2) return {};
  const Value* whole = locate(expression.items[0]);
  if (!whole || whole->kind != Value::Kind::text) return {};
  const std::string text = whole->text;
  const auto index = number(expression.items[1]);
  if (!index || !(*index >= 1 && *index <= static_cast<double>(text.size()))) return {};
  return text_value(text.substr(static_cast<std::size_t>(*index) - 1, 1));
}

/// Returns the value of an element with an unknown index: unknown, with the causes of the index.
Value Interpreter::unknown_index(const Expression& expression) {
  if (expression.kind == Form::field) return unknown_index(expression.items[0]);
  for (std::size_t i = 1; expression.kind == Form::element && i < expression.items.size(); ++i)
    if (const Value index = evaluate(expression.items[i]); !index.known()) {
      // If no part of the list is known, the element is a question in the same round, too.
      const Value list = evaluate(expression.items[0]);
      const bool empty = list.kind == Value::Kind::unknown || std::ranges::none_of(list.items, [](const Value& item) {
                           return item.kind != Value::Kind::unknown && item.first_cause() == nullptr;
                         });
      return empty && list.first_cause() ? unknown_value(index, list) : unknown_value(index);
    }
  return {};
}

bool Interpreter::shape(Value& value, const RecordType* type) const {
  if (value.kind != Value::Kind::list) return value.kind == Value::Kind::unknown;
  if (value.type) return true;  // KRL: the aggregate names its components
  const std::size_t count = value.items.size(), fields = type->fields.size();
  if (count > fields || (count < fields && static_cast<int>(count) < type->optional_from)) return false;
  for (std::size_t i = 0; i < count; ++i)
    if (type->types[i] && !shape(value.items[i], type->types[i])) return false;
  value.type = type;
  return true;
}

void Interpreter::assign(const Expression& target, Value value) {
  charge(value.weight());
  if (value.depth() + target.depth > value_depth || value.weight() > ImportLimits::values) {
    complain(target.place, "grows without end", "correct the assignment");
    value = {};
  }
  Value* place = locate(target);
  if (!place) place = given_part(target);
  if (const Variable* variable = place ? base_of(target) : nullptr; variable && variable->counter)
    complain(target.place, fmt::format("writes to '{}', which only its FOR may do", base_name(target)),
             "write to another variable");
  if (place) {
    if (place->type && value.kind == Value::Kind::list && !value.type) shape(value, place->type);
    if (value.kind == Value::Kind::unknown) value = forgotten(*place, typed_cause(value, place->type));
    dialect_.store(*place, std::move(value));
    if (Variable* variable = base_of(target)) {
      variable->written = target.place;
      variable->assigned = true;
    }
    return;
  }
  if (Value* whole = target.kind == Form::element ? locate(target.items[0]) : nullptr;
      whole && whole->kind == Value::Kind::text) {  // KRL: one letter of a text
    *whole = unknown_value(answer_name(path_of(target.items[0])), "is written letter by letter");
    return;
  }
  if (target.kind == Form::field)
    if (const Value* record = locate(target.items[0]); record && record->type)
      dialect_.no_such_component(target, *record->type);
  const std::string path = path_of(target);
  if (path.empty()) return assign_somewhere(target);
  if (globals_.size() >= ImportLimits::values) {
    complain(target.place, "is one variable too many", "correct the loop that makes them");
    throw Stop{};
  }
  Scope& scope = scope_of(path);
  for (const char* part : {".", "["}) {  // parts that are stored under their own paths
    const auto begin = scope.lower_bound(path + part);
    auto end = begin;
    while (end != scope.end() && end->first.starts_with(path + part)) ++end;
    scope.erase(begin, end);
  }
  scope.insert_or_assign(
      path,
      Variable{.state = Variable::State::ready, .value = std::move(value), .written = target.place, .assigned = true});
}

/// Returns the cause of an unknown value that is assigned to a record, with the form of the record's type.
std::shared_ptr<const Cause> Interpreter::typed_cause(const Value& unknown, const RecordType* type) const {
  if (!unknown.cause || !type || !unknown.cause->form.empty() || unknown.cause->behind) return unknown.cause;
  Cause cause = *unknown.cause;
  cause.form = dialect_.form_of(type->name);
  return std::make_shared<const Cause>(std::move(cause));
}

/// Returns a component or an element of a value that the user gave; null: none of that name or number. A list
/// without a type gets the type of the record that has this component.
Value* Interpreter::part_of_given(Value& whole, const Expression& part) {
  if (whole.kind != Value::Kind::list) return nullptr;
  if (part.kind == Form::field) {
    for (const RecordType& type : code_.records)
      if (!whole.type && std::ranges::find(type.fields, part.text) != type.fields.end()) shape(whole, &type);
    return const_cast<Value*>(whole.field(part.text));
  }
  Value* found = &whole;
  for (std::size_t i = 1; i < part.items.size(); ++i) {
    const auto index = number(part.items[i]);
    if (!index || found->type || !(*index >= 1 && *index <= static_cast<double>(found->items.size()))) return nullptr;
    found = &found->items[static_cast<std::size_t>(*index) - 1];
  }
  return found;
}

/// Returns a part of a value that the user gave, for an assignment. The value becomes a variable of the program.
Value* Interpreter::given_part(const Expression& expression) {
  if (expression.kind != Form::field && expression.kind != Form::element) return nullptr;
  const Expression& outer = expression.items[0];
  Value* whole = locate(outer);
  if (const std::string path = whole ? "" : path_of(outer); !path.empty()) {
    Variable* kept = find(path);
    std::optional<Value> value;
    if (!kept) value = dialect_.constant(path);
    if (!kept && (!value || !value->known())) value = given(path);
    if (value && value->kind == Value::Kind::list) {
      kept = &scope_of(path)[path];
      kept->state = Variable::State::ready;
      kept->value = *std::move(value);
      kept->assigned = true;
    }
    if (kept) whole = ready(*kept);
  }
  if (!whole) whole = given_part(outer);
  return whole ? part_of_given(*whole, expression) : nullptr;
}

/// Returns the scope that stores a path: the scope of the path's variable.
Interpreter::Scope& Interpreter::scope_of(const std::string& path) {
  const std::string base = path.substr(0, path.find_first_of(".["));
  if (!locals_.empty() && locals_.back().contains(base)) return locals_.back();
  if (module_ >= 0 && module_data_[module_].contains(base)) return module_data_[module_];
  if (globals_.contains(base) || module_ < 0 || dialect_.shares(base, module_)) return globals_;
  return module_data_[module_];
}

const std::string& Interpreter::base_name(const Expression& expression) { return reference_base(expression).text; }

bool Interpreter::was_assigned(const Expression& expression) const {
  const Variable* variable = const_cast<Interpreter*>(this)->base_of(expression);
  return variable && variable->assigned;
}

bool Interpreter::is_constant(const Variable& variable) {
  const Statement* declared = variable.datum ? &variable.datum->statement : variable.declaration;
  return variable.counter || (declared && declared->constant);
}

Interpreter::Variable* Interpreter::base_of(const Expression& expression) {
  const Expression& base = reference_base(expression);
  return base.kind == Form::name ? find(base.text) : nullptr;
}

/// Handles an assignment to an element with an unknown index: every element may have been written.
void Interpreter::assign_somewhere(const Expression& target) {
  const Value cause = unknown_index(target);
  if (Variable* variable = base_of(target)) {
    Value* whole = ready(*variable);
    *whole = forgotten(std::move(*whole), cause.cause);
    variable->assigned = true;
  }
}

void Interpreter::make_unknown(const Expression& target, Cause cause) {
  if (target.kind != Form::name && target.kind != Form::field && target.kind != Form::element) return;
  const std::string path = path_of(target);
  cause.name = answer_name(path);
  if (const Variable* variable = base_of(target); variable && is_constant(*variable)) return;
  if (std::optional<Value> value = given(path)) return assign(target, *value);
  if (!locate(target)) return;
  assign(target, unknown_value(std::move(cause)));
}

void Interpreter::forget_numbers(const std::string& why) {
  charge(globals_.size());
  const auto cause = std::make_shared<const Cause>(Cause{"", why});
  for (auto& [name, variable] : globals_) {
    const bool list = variable.datum ? dialect_.type_of(variable.datum->statement.text) != nullptr
                                     : variable.value.kind == Value::Kind::list;
    if (list) continue;
    variable.state = Variable::State::ready;
    variable.value = {.cause = cause};
    variable.assigned = true;
  }
}

std::string Interpreter::because(const Value& unknown) const {
  const Cause* cause = unknown.first_cause();
  if (!cause) return "";
  const std::string why = cause->name.empty() ? ": " + cause->why : fmt::format(": '{}' {}", cause->name, cause->why);
  return cause->behind ? fmt::format("{}, that on '{}', which {}", why, cause->behind->name, cause->behind->why) : why;
}

std::string Interpreter::remedy_for(const Value& unknown) const {
  std::vector<std::string> names;
  std::string lines;
  for (const Cause* cause : unknown.causes()) {
    if (cause->asked().empty()) continue;
    names.push_back(cause->asked());
    if (!cause->line.empty()) lines += ", or " + assume_of_job(cause->line);
  }
  return names.empty() ? "" : values_of_job(names) + lines;
}

std::vector<Question> Interpreter::questions_for(const Value& unknown, const std::string& form) {
  std::vector<Question> questions;
  const std::vector<const Cause*> causes = unknown.causes();
  for (const Cause* cause : causes) {
    if (!cause->line.empty()) exploration_.follow(cause->line);
    const bool by_line = !cause->line.empty() && !cause->behind;
    const std::string name = by_line ? cause->line : cause->asked();
    if (name.empty()) continue;
    const std::string own = cause->behind || cause->form.empty() ? form_of(cause->asked()) : cause->form;
    const bool itself = causes.size() == 1 && cause->line.empty() && own.empty();
    Question question{by_line ? Question::Kind::branch : Question::Kind::value, name,
                      by_line  ? "then or else"
                      : itself ? form
                               : own};
    const std::string& standard = cause->standard.empty() ? name : cause->standard;
    if (const auto preset = code_.presets.find(standard); preset != code_.presets.end() && !by_line) {
      question.preset = preset->second.text;
      exploration_.suppose(name, standard);
    }
    questions.push_back(std::move(question));
  }
  return questions;
}

/// Returns the form of a value of the name's declared type; empty: not known.
std::string Interpreter::form_of(const std::string& name) {
  const std::string path = name.substr(name.find_last_of(':') + 1);
  const bool part = path.find_first_of(".[") != std::string::npos;
  const Variable* variable = part ? nullptr : find(path);
  const Statement* declared = !variable         ? nullptr
                              : variable->datum ? &variable->datum->statement
                                                : variable->declaration;
  if (!declared) return "";
  const std::string form = dialect_.form_of(declared->text);
  if (declared->arguments.size() == 1) return form;
  std::string sizes;  // of the dimensions
  for (std::size_t i = 1; i < declared->arguments.size(); ++i) {
    const auto size = number(declared->arguments[i]);
    if (!size) return "";
    sizes += fmt::format("{}{}", i > 1 ? " x " : "", *size);
  }
  return dialect_.gives_lists() && !form.empty() ? fmt::format("[.., ..], {} times {}", sizes, form) : "";
}

Value Interpreter::aggregate(const Expression& expression) {
  std::vector<Value> items;
  for (const Expression& item : expression.items) items.push_back(evaluate(item));
  if (expression.keys.empty()) return list_value(std::move(items));
  dialect_.check_components(expression);
  std::string name;
  for (const std::string& key : expression.keys) name += key + " ";
  const RecordType*& type = record_of_[name];
  if (!type) {
    records_.push_back({.name = name,
                        .fields = expression.keys,
                        .types = std::vector<const RecordType*>(expression.keys.size(), nullptr)});
    type = &records_.back();
  }
  Value value = list_value(std::move(items), type);
  if (value.depth() <= value_depth) return value;
  complain(expression.place, "grows without end", "correct the assignment");
  return {};
}

Value Interpreter::unary(const Expression& expression) {
  Value value = evaluate(expression.items[0]);
  if (expression.text == "not" && value.kind == Value::Kind::truth) return truth_value(value.number == 0);
  if (expression.text == "+") return value;
  const bool numbers = value.is_number() || (value.kind == Value::Kind::list && value.depth() == 1);
  if (expression.text == "-" && numbers) {
    value.number = -value.number;
    for (Value& item : value.items) item.number = -item.number;
    return value;
  }
  if (expression.text == "b_not" && value.numeric == Value::Numeric::integer && value.is_number()) {
    value.number = -value.number - 1;  // bitwise NOT in two's complement
    return value;
  }
  return unknown_value(value);
}

namespace {

/// Whether two values with unknown parts are equal. False if known parts differ; std::nullopt: not known.
std::optional<bool> alike(const Value& a, const Value& b) {
  using Type = Value::Kind;
  if (a.kind == Type::unknown || b.kind == Type::unknown) return {};
  if (a.kind != b.kind || a.items.size() != b.items.size()) return false;
  if (a.kind != Type::list) return a.kind == Type::text ? a.text == b.text : a.number == b.number;
  bool known = true;
  for (std::size_t i = 0; i < a.items.size(); ++i) {
    const auto part = alike(a.items[i], b.items[i]);
    if (part == std::optional(false)) return false;
    known &= part.has_value();
  }
  return known ? std::optional(true) : std::nullopt;
}

Value compared(const std::string& op, const Value& a, const Value& b) {
  if (op == "=" || op == "==" || op == "<>")
    if (const auto equal = alike(a, b)) return truth_value(*equal == (op != "<>"));
  if (!a.is_number()) return {};
  if (op == "<") return truth_value(a.number < b.number);
  if (op == ">") return truth_value(a.number > b.number);
  if (op == "<=") return truth_value(a.number <= b.number);
  if (op == ">=") return truth_value(a.number >= b.number);
  return {};
}

constexpr double widest = 4294967295.0;  // largest whole number for KRL's bit operators

Value computed(const std::string& op, const Value& first, const Value& second) {
  using Numeric = Value::Numeric;
  const double a = first.number, b = second.number;
  const bool whole = first.numeric == Numeric::integer && second.numeric == Numeric::integer;
  double value = NAN;
  if (op == "+") value = a + b;
  if (op == "-") value = a - b;
  if (op == "*") value = a * b;
  if (op == "/") value = whole ? std::trunc(a / b) : a / b;
  if (op == "div") value = std::trunc(a / b);
  if (op == "mod") value = std::fmod(a, b);
  if (op.starts_with("b_") && whole && std::abs(a) <= widest && std::abs(b) <= widest) {
    const auto bits = static_cast<std::int64_t>(a), others = static_cast<std::int64_t>(b);
    value = static_cast<double>(op == "b_and" ? bits & others : op == "b_or" ? bits | others : bits ^ others);
  }
  if (!std::isfinite(value)) return {};
  Value result = number_value(value);
  const bool typed = first.numeric != Numeric::any && second.numeric != Numeric::any;
  if (typed) result.numeric = whole ? Numeric::integer : Numeric::real;
  return result;
}

/// Returns orient * orient: the rotation a, then the rotation b in the frame of a.
Value computed_turns(const Value& a, const Value& b) {
  const auto turn = [](const Value& v) {
    return Quaternion(v.items[0].number, v.items[1].number, v.items[2].number, v.items[3].number);
  };
  const Quaternion product = turn(a) * turn(b);
  Value result = a;
  const double parts[] = {product.w(), product.x(), product.y(), product.z()};
  for (std::size_t i = 0; i < 4; ++i) result.items[i].number = parts[i];
  return result;
}

/// Returns pos + pos, pos - pos, pos * number, number * pos, pos * pos (vector product) or orient * orient.
Value computed_lists(const std::string& op, const Value& a, const Value& b) {
  const Value& list = a.kind == Value::Kind::list ? a : b;
  const bool turns = op == "*" && a.items.size() == 4 && b.items.size() == 4;
  if (turns && a.depth() == 1 && b.depth() == 1 && a.known() && b.known()) return computed_turns(a, b);
  if (list.items.size() != 3 || list.depth() != 1 || !a.known() || !b.known()) return {};
  Value result = list;
  if (a.kind == b.kind && b.items.size() == 3) {
    const auto at = [](const Value& v, int i) { return v.items[i % 3].number; };
    for (int i = 0; i < 3; ++i) {
      double& item = result.items[i].number;
      if (op == "+")
        item = at(a, i) + at(b, i);
      else if (op == "-")
        item = at(a, i) - at(b, i);
      else if (op == "*")
        item = at(a, i + 1) * at(b, i + 2) - at(a, i + 2) * at(b, i + 1);
      else
        return {};
    }
    return result;
  }
  const Value& factor = a.kind == Value::Kind::list ? b : a;
  if (!factor.is_number() || (op != "*" && !(op == "/" && &factor == &b && factor.number != 0))) return {};
  for (Value& item : result.items) item.number = op == "*" ? item.number * factor.number : item.number / factor.number;
  return result;
}

/// Returns an unknown value with the form "a number", if it is calculated or compared with a number.
Value as_number(const Value& value, const Value& other) {
  if (value.kind != Value::Kind::unknown || !other.is_number() || !value.cause || !value.cause->form.empty() ||
      !value.cause->line.empty() || !value.cause->others.empty() || value.cause->behind)
    return value;
  Cause cause = *value.cause;
  cause.form = "a number";
  return unknown_value(std::move(cause));
}

}  // namespace

/// Returns the value of a KRL expression that mixes comparisons with AND, EXOR or OR without parentheses. KRL
/// compares after them: a == b AND c is a == (b AND c). Programs also rely on the order of other languages, (a == b) AND c.
/// If both orders are possible and their values differ, the value is unknown.
Value Interpreter::mixed(const Expression& expression) {
  std::vector<Value> operands;
  std::vector<const Expression*> operators;
  const int comparisons = precedence_of("==");
  const std::function<void(const Expression&)> take = [&](const Expression& e) {
    const bool is_part = e.kind == Form::binary && (&e == &expression || !e.in_parentheses);
    if (!is_part || precedence_of(e.text) > comparisons) return operands.push_back(evaluate(e));
    take(e.items[0]);
    operators.push_back(&e);
    take(e.items[1]);
  };
  take(expression);
  int compared_at = comparisons;  // precedence of comparisons
  // Returns the value of operands first .. last; std::nullopt: an operator does not accept the kinds of its operands.
  const std::function<std::optional<Value>(std::size_t, std::size_t)> read =
      [&](std::size_t first, std::size_t last) -> std::optional<Value> {
    if (first == last) return operands[first];
    const auto level = [&](std::size_t k) {
      const int usual = precedence_of(operators[k]->text);
      return usual == comparisons ? compared_at : usual;
    };
    std::size_t split = first;  // the last one of the lowest precedence
    for (std::size_t k = first; k < last; ++k)
      if (level(k) <= level(split)) split = k;
    const auto a = read(first, split), b = read(split + 1, last);
    if (!a || !b) return {};
    const std::string& op = operators[split]->text;
    const Value::Kind kind = op.starts_with("b_") ? Value::Kind::number : Value::Kind::truth;
    const auto fits = [&](const Value& side) { return side.kind == Value::Kind::unknown || side.kind == kind; };
    if (precedence_of(op) != comparisons && !(fits(*a) && fits(*b))) return {};
    Value made = applied(op, *a, *b, operators[split]->place);
    return a->known() && b->known() && !made.known() ? std::nullopt : std::optional(std::move(made));
  };
  const std::optional<Value> usual = read(0, operators.size());
  compared_at = 0;
  const std::optional<Value> manual = read(0, operators.size());
  if (!usual || !manual) return usual.value_or(manual.value_or(Value{}));
  if (!usual->known() || *usual == *manual) return *usual;
  if (!manual->known()) return *manual;
  return unknown_value("", fmt::format("is {} with comparisons after AND, EXOR and OR (KRL's priorities), and {} with "
                                       "comparisons first; parentheses in a copy of the program decide",
                                       manual->number != 0 ? "TRUE" : "FALSE", usual->number != 0 ? "TRUE" : "FALSE"));
}

Value Interpreter::binary(const Expression& expression) {
  if (expression.text == ":") return dialect_.function(expression).value_or(Value{});
  if (expression.mixes_levels) return mixed(expression);
  const Value first = evaluate(expression.items[0]);
  return applied(expression.text, first, evaluate(expression.items[1]), expression.place);
}

/// Returns the value of an operator on two lists of one length, or on a list and a number. Records and products of matrices are
/// not read.
Value Interpreter::by_item(const std::string& op, const Value& a, const Value& b, const Place& place) {
  const Value& list = a.kind == Value::Kind::list ? a : b;
  const bool two_lists = a.kind == b.kind, matrices = op == "*" && a.depth() + b.depth() > 2;
  if (a.type || b.type || matrices || (two_lists && a.items.size() != b.items.size())) return {};
  std::vector<Value> items;
  for (std::size_t i = 0; i < list.items.size(); ++i)
    items.push_back(
        applied(op, two_lists || &list == &a ? a.items[i] : a, two_lists || &list == &b ? b.items[i] : b, place));
  return list_value(std::move(items));
}

Value Interpreter::applied(const std::string& op, Value a, Value b, const Place& place) {
  const auto round = [&](Value& value, double (*rounded)(double)) {
    if (dialect_.has_single_precision() && value.is_number()) value.number = rounded(value.number);
  };
  round(a, as_single), round(b, as_single);
  if (op == "and" || op == "or") {  // one known side can be enough
    const bool deciding = op == "or";
    for (const Value* side : {&a, &b})
      if (side->kind == Value::Kind::truth && (side->number != 0) == deciding) return truth_value(deciding);
  }
  if (a.kind == Value::Kind::unknown || b.kind == Value::Kind::unknown)
    return unknown_value(as_number(a, b), as_number(b, a));
  if (a.kind == Value::Kind::list || b.kind == Value::Kind::list) {
    if (const Value relation = compared(op, a, b); relation.known()) return relation;
    const bool items = dialect_.computes_by_item();
    if (Value result = items ? by_item(op, a, b, place) : computed_lists(op, a, b); result.known()) return result;
    return unknown_value(a, b);
  }
  if (a.kind != b.kind || (a.kind == Value::Kind::text && op != "+")) {  // KRL: a CHAR is the number of its letter
    const auto first = dialect_.letter(a), second = dialect_.letter(b);
    const bool letters = (first || a.is_number()) && (second || b.is_number());
    const Value relation =
        letters ? compared(op, number_value(first.value_or(a.number)), number_value(second.value_or(b.number)))
                : Value{};
    if (relation.known() || a.kind != b.kind) return relation;
  }
  if (op == "and" || op == "or") return a.kind == Value::Kind::truth ? truth_value(op == "and") : Value{};
  if (op == "xor" || op == "exor") return a.kind == Value::Kind::truth ? truth_value(a.number != b.number) : Value{};
  if (a.kind == Value::Kind::text && op == "+") return text_value((a.text + b.text).substr(0, text_length));
  if (b.is_number() && b.number == 0 && (op == "/" || op == "div" || op == "mod")) {
    complain(place, "divides by zero", "correct the line (the controller stops here)");
    return {};
  }
  if (const Value relation = compared(op, a, b); relation.known()) return relation;
  Value result = a.is_number() ? computed(op, a, b) : Value{};
  round(result, shortest_single);
  return result;
}

}  // namespace dresslife::sim
