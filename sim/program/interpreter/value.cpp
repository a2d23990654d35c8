#include <algorithm>

#include "sim/program/interpreter/interpreter.h"

namespace dresslife::sim {

bool Value::known() const {
  return kind != Kind::unknown && std::ranges::all_of(items, [](const Value& item) { return item.known(); });
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

std::vector<const Cause*> Value::causes() const {
  std::vector<const Cause*> found;
  const auto add = [&](const Cause& one) {
    constexpr std::size_t most = 12;  // causes of one value; a position has six numbers
    const auto same = [&](const Cause* known) { return known->asked() == one.asked() && known->line == one.line; };
    if (found.size() < most && std::ranges::none_of(found, same)) found.push_back(&one);
  };
  if (kind == Kind::unknown && cause) {
    add(*cause);
    for (const auto& other : cause->others) add(*other);
  }
  for (const Value& item : items) {
    if (item.kind != Kind::unknown && item.items.empty()) continue;
    for (const Cause* inner : item.causes()) add(*inner);
  }
  return found;
}

bool Value::operator==(const Value& other) const {
  return kind == other.kind && (kind == Kind::unknown || kind == Kind::list || number == other.number) &&
         text == other.text && items == other.items;
}

Value unknown_value(std::string name, std::string why, std::string form) {
  return unknown_value(Cause{.name = std::move(name), .why = std::move(why), .form = std::move(form)});
}

Value unknown_value(Cause cause) { return {.cause = std::make_shared<const Cause>(std::move(cause))}; }

namespace {

Value unknown_value(const std::vector<const Cause*>& causes) {
  if (causes.empty()) return {};
  Cause all = *causes[0];
  all.others.clear();
  for (std::size_t i = 1; i < causes.size(); ++i) {
    Cause other = *causes[i];
    other.others.clear();
    all.others.push_back(std::make_shared<const Cause>(std::move(other)));
  }
  return unknown_value(std::move(all));
}

}  // namespace

Value unknown_value(const Value& because) {
  if (because.kind != Value::Kind::unknown) return unknown_value(because.causes());
  return {.cause = because.cause};
}

Value unknown_value(const Value& because, const Value& and_because) {
  std::vector<const Cause*> causes = because.causes();
  const std::vector<const Cause*> more = and_because.causes();
  if (more.empty()) return unknown_value(because);
  if (causes.empty()) return unknown_value(and_because);
  for (const Cause* cause : more)
    if (std::ranges::none_of(
            causes, [&](const Cause* known) { return known->asked() == cause->asked() && known->line == cause->line; }))
      causes.push_back(cause);
  return causes.size() == 1 ? unknown_value(because) : unknown_value(causes);
}

Value forgotten(Value value, const std::shared_ptr<const Cause>& cause) {
  if (value.kind == Value::Kind::list) {
    for (Value& item : value.items) item = forgotten(std::move(item), cause);
    return value;
  }
  return {.cause = cause};
}

Value number_value(double number) { return {.kind = Value::Kind::number, .number = number}; }

Value truth_value(bool truth) { return {.kind = Value::Kind::truth, .number = double(truth)}; }

Value text_value(std::string text) { return {.kind = Value::Kind::text, .text = std::move(text)}; }

Value list_value(std::vector<Value> items, const RecordType* type) {
  return {.kind = Value::Kind::list, .items = std::move(items), .type = type};
}

}  // namespace dresslife::sim
