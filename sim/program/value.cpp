#include <algorithm>

#include "sim/program/interpreter.h"

namespace dresslife::sim {

bool Value::known() const {
  return kind != Kind::unknown &&
         std::all_of(items.begin(), items.end(), [](const Value& item) { return item.known(); });
}

const Value* Value::field(const std::string& name) const {
  if (!type) return nullptr;
  for (std::size_t i = 0; i < type->fields.size() && i < items.size(); ++i)
    if (type->fields[i] == name) return &items[i];
  return nullptr;
}

std::size_t Value::weight() const {
  std::size_t sum = 1;
  for (const Value& item : items) sum += item.weight();
  return sum;
}

int Value::depth() const {
  int deepest = 0;
  for (const Value& item : items) deepest = std::max(deepest, item.depth() + 1);
  return deepest;
}

const Cause* Value::first_cause() const {
  if (kind == Kind::unknown) return cause.get();
  for (const Value& item : items)
    if (const Cause* found = item.first_cause()) return found;
  return nullptr;
}

bool Value::operator==(const Value& other) const {
  return kind == other.kind && (kind == Kind::unknown || kind == Kind::list || number == other.number) &&
         text == other.text && items == other.items;
}

Value unknown_value(std::string name, std::string why) {
  Value value;
  value.cause = std::make_shared<const Cause>(Cause{std::move(name), std::move(why)});
  return value;
}

Value unknown_value(const Value& because) {
  Value value;
  if (because.kind == Value::Kind::unknown) value.cause = because.cause;
  for (const Value& item : because.items)
    if (!value.cause) value.cause = unknown_value(item).cause;
  return value;
}

Value forgotten(Value value, const std::shared_ptr<const Cause>& cause) {
  if (value.kind == Value::Kind::list) {
    for (Value& item : value.items) item = forgotten(std::move(item), cause);
    return value;
  }
  value = Value{};
  value.cause = cause;
  return value;
}

Value number_value(double number) {
  Value value;
  value.kind = Value::Kind::number;
  value.number = number;
  return value;
}

Value truth_value(bool truth) {
  Value value;
  value.kind = Value::Kind::truth;
  value.number = truth;
  return value;
}

Value text_value(std::string text) {
  Value value;
  value.kind = Value::Kind::text;
  value.text = std::move(text);
  return value;
}

Value list_value(std::vector<Value> items, const RecordType* type) {
  Value value;
  value.kind = Value::Kind::list;
  value.items = std::move(items);
  value.type = type;
  return value;
}

}  // namespace dresslife::sim
