// Expressions: evaluation, variables, assignment.
#include <algorithm>
#include <cmath>

#include "sim/program/interpreter.h"

namespace dresslife::sim {
namespace {

using Kind = Expression::Kind;

constexpr int value_depth = 12;  // levels of records in records
constexpr std::size_t text_length = 1000;

}  // namespace

/// Counts the levels of evaluation in each other, which the parser's and the calls' bounds keep below the
/// stack.
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
    case Kind::none:
      return {};
    case Kind::number:
      return number_value(expression.number);
    case Kind::text:
      return text_value(expression.text);
    case Kind::truth:
      return truth_value(expression.number != 0);
    case Kind::unary:
      return unary(expression);
    case Kind::binary:
      return binary(expression);
    case Kind::aggregate:
      return aggregate(expression);
    case Kind::call:
      if (const Routine* routine = code_.find(expression.text))
        return call(*routine, expression.items, expression.place);
      if (std::optional<Value> value = dialect_.function(expression, *this)) return *value;
      for (const Expression& argument : expression.items) evaluate(argument);
      return {};
    case Kind::name:
    case Kind::element:
    case Kind::field:
      return name_value(expression);
  }
  return {};
}

std::optional<double> Interpreter::number(const Expression& expression) {
  const Value value = evaluate(expression);
  return value.is_number() ? std::optional(value.number) : std::nullopt;
}

const Value* Interpreter::variable(const std::string& name) const {
  if (!locals_.empty())
    if (const auto local = locals_.back().find(name); local != locals_.back().end()) return &local->second;
  const auto global = globals_.find(name);
  return global == globals_.end() ? nullptr : &global->second;
}

void Interpreter::set(const std::string& name, Value value) {
  charge(value.weight());
  globals_.insert_or_assign(name, std::move(value));
}

void Interpreter::forget(const std::string& name) {
  if (const auto found = globals_.find(name); found != globals_.end()) globals_.erase(found);
}

/// The variable, or the part of one, that an expression names; null: not there.
Value* Interpreter::locate(const Expression& expression) {
  charge(1);
  if (expression.kind == Kind::name) return const_cast<Value*>(variable(expression.text));
  if (expression.kind != Kind::field && expression.kind != Kind::element) return nullptr;
  // Indices first: a function in one may change what a place found earlier lies in.
  std::vector<std::size_t> indices;
  for (std::size_t i = 1; expression.kind == Kind::element && i < expression.items.size(); ++i) {
    const auto index = number(expression.items[i]);
    if (!index || !(*index >= 1 && *index <= static_cast<double>(ImportLimits::values))) return nullptr;
    indices.push_back(static_cast<std::size_t>(*index) - 1);
  }
  Value* whole = locate(expression.items[0]);
  if (!whole) return nullptr;
  if (expression.kind == Kind::field) return const_cast<Value*>(whole->field(expression.text));
  for (std::size_t index : indices) {
    if (index >= whole->items.size()) return nullptr;
    whole = &whole->items[index];
  }
  return whole;
}

std::string Interpreter::path_of(const Expression& expression) {
  if (expression.kind == Kind::name) return expression.text;
  if (expression.kind != Kind::field && expression.kind != Kind::element) return "";
  std::string path = path_of(expression.items[0]);
  if (path.empty() || path.size() > text_length) return "";
  if (expression.kind == Kind::field) return path + "." + expression.text;
  for (std::size_t i = 1; i < expression.items.size(); ++i) {
    const auto index = number(expression.items[i]);
    if (!index || !(std::abs(*index) < 1e9)) return "";
    path += fmt::format("[{}]", static_cast<long>(*index));
  }
  return path;
}

Value Interpreter::name_value(const Expression& expression) {
  if (expression.kind != Kind::name) {
    if (const std::string path = path_of(expression); !path.empty()) {
      if (const Value* value = variable(path)) return *value;
      if (std::optional<Value> value = dialect_.constant(path)) return *value;
    }
    // A part of an element that is kept by its path.
    const Value whole = locate(expression.items[0]) ? Value{} : name_value(expression.items[0]);
    if (expression.kind == Kind::field && whole.kind == Value::Kind::list)
      if (const Value* part = whole.field(expression.text)) return *part;
  }
  if (const Value* value = locate(expression)) {
    charge(value->weight());
    return *value;
  }
  if (expression.kind == Kind::name)
    if (std::optional<Value> value = dialect_.constant(expression.text)) return *value;
  return {};
}

bool Interpreter::shape(Value& value, const RecordType* type) const {
  if (value.kind != Value::Kind::list) return value.kind == Value::Kind::unknown;
  if (value.type) return true;  // KRL: the aggregate named its own components
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
    complain(target.place, "grows without end", "mend the assignment");
    value = {};
  }
  if (Value* place = locate(target)) {
    if (place->type && value.kind == Value::Kind::list && !value.type) shape(value, place->type);
    *place = std::move(value);
    return;
  }
  const std::string path = path_of(target);
  if (path.empty()) return;
  if (globals_.size() >= ImportLimits::values) {
    complain(target.place, "is one variable too many", "mend the loop that makes them");
    throw Stop{};
  }
  if (value.kind == Value::Kind::list && value.type)  // $VEL = {CP 1, ...} is $VEL.CP = 1, ...
    for (std::size_t i = 0; i < value.items.size(); ++i)
      globals_.insert_or_assign(path + "." + value.type->fields[i], value.items[i]);
  globals_.insert_or_assign(path, std::move(value));
}

Value Interpreter::aggregate(const Expression& expression) {
  std::vector<Value> items;
  for (const Expression& item : expression.items) items.push_back(evaluate(item));
  if (expression.keys.empty()) return list_value(std::move(items));
  std::string name;
  for (const std::string& key : expression.keys) name += key + " ";
  const RecordType*& type = record_of_[name];
  if (!type) {
    records_.push_back(
        {name, expression.keys, std::vector<const RecordType*>(expression.keys.size(), nullptr)});
    type = &records_.back();
  }
  Value value = list_value(std::move(items), type);
  if (value.depth() <= value_depth) return value;
  complain(expression.place, "grows without end", "mend the assignment");
  return {};
}

Value Interpreter::unary(const Expression& expression) {
  const Value value = evaluate(expression.items[0]);
  if (expression.text == "not" && value.kind == Value::Kind::truth) return truth_value(value.number == 0);
  if (expression.text == "-" && value.is_number()) return number_value(-value.number);
  if (expression.text == "-" && value.kind == Value::Kind::list && value.depth() == 1) {
    Value negative = value;
    for (Value& item : negative.items) item.number = -item.number;
    return negative;
  }
  if (expression.text == "+") return value;
  return {};
}

namespace {

Value compared(const std::string& op, const Value& a, const Value& b) {
  const bool equal = a.kind == Value::Kind::text ? a.text == b.text : a.number == b.number;
  if (op == "=" || op == "==") return truth_value(equal);
  if (op == "<>") return truth_value(!equal);
  if (!a.is_number()) return {};
  if (op == "<") return truth_value(a.number < b.number);
  if (op == ">") return truth_value(a.number > b.number);
  if (op == "<=") return truth_value(a.number <= b.number);
  if (op == ">=") return truth_value(a.number >= b.number);
  return {};
}

Value computed(const std::string& op, double a, double b) {
  double value = NAN;
  if (op == "+") value = a + b;
  if (op == "-") value = a - b;
  if (op == "*") value = a * b;
  if (op == "/") value = a / b;
  if (op == "div") value = std::trunc(a / b);
  if (op == "mod") value = std::fmod(a, b);
  return std::isfinite(value) ? number_value(value) : Value{};
}

/// pos + pos, pos - pos, pos * number, number * pos, pos * pos (vector product).
Value computed_lists(const std::string& op, const Value& a, const Value& b) {
  const Value& list = a.kind == Value::Kind::list ? a : b;
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
  for (Value& item : result.items)
    item.number = op == "*" ? item.number * factor.number : item.number / factor.number;
  return result;
}

}  // namespace

Value Interpreter::binary(const Expression& expression) {
  const std::string& op = expression.text;
  if (op == ":") return dialect_.function(expression, *this).value_or(Value{});
  const Value a = evaluate(expression.items[0]), b = evaluate(expression.items[1]);
  if (op == "and" || op == "or") {  // one side can be enough
    const bool deciding = op == "or";
    for (const Value* side : {&a, &b})
      if (side->kind == Value::Kind::truth && (side->number != 0) == deciding) return truth_value(deciding);
  }
  if (a.kind == Value::Kind::unknown || b.kind == Value::Kind::unknown) return {};
  if (a.kind == Value::Kind::list || b.kind == Value::Kind::list) return computed_lists(op, a, b);
  if (a.kind != b.kind) return {};
  if (op == "and" || op == "or") return a.kind == Value::Kind::truth ? truth_value(op == "and") : Value{};
  if (op == "xor" || op == "exor")
    return a.kind == Value::Kind::truth ? truth_value(a.number != b.number) : Value{};
  if (a.kind == Value::Kind::text && op == "+") return text_value((a.text + b.text).substr(0, text_length));
  if (const Value relation = compared(op, a, b); relation.known()) return relation;
  return a.is_number() ? computed(op, a.number, b.number) : Value{};
}

}  // namespace dresslife::sim
