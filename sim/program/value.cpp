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
