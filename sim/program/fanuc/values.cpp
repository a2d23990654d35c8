#include "sim/program/fanuc/values.h"

#include <algorithm>
#include <cmath>

#include "pipeline/base/constants.h"
#include "sim/program/interpreter/job_words.h"
#include "sim/program/interpreter/tokens.h"

namespace dresslife::sim {
namespace {

/// Parses "X 100 Y 0 Z 50 W 180 P 0 R 0", "J1 0 J2 ..." or six numbers X Y Z W P R. Commas are optional.
std::optional<FanucPosition> position_in(const std::string& text) {
  FanucPosition made;
  made.frame = made.tool = -1;
  FanucCursor at(text);
  constexpr std::string_view names = "xyzwpr";
  std::vector<double> joints, plain;
  double pose[6] = {NAN, NAN, NAN, NAN, NAN, NAN};
  while (!at.at_end()) {
    const std::string name = at.word();
    const bool number_only = !name.empty() && (name[0] < 'a' || name[0] > 'z');
    if (number_only) at.move_to(at.offset() - name.size());
    if (!number_only) at.take_sign('=');
    const auto value = at.number();
    if (!value || plain.size() > 6) return {};
    at.take_sign(',');
    if (name.empty() || number_only)
      plain.push_back(*value);
    else if (name.size() == 1 && names.find(name[0]) != std::string_view::npos)
      pose[names.find(name[0])] = *value;
    else if (name.size() == 2 && name[0] == 'j' && name[1] - '1' == static_cast<int>(joints.size()))
      joints.push_back(*value);
    else
      return {};
  }
  if (plain.size() == 6) std::ranges::copy(plain, std::begin(pose));
  made.form = joints.empty() ? FanucPosition::Form::pose : FanucPosition::Form::joints;
  made.values = joints.empty() ? std::vector<double>(std::begin(pose), std::end(pose)) : joints;
  return made.known() ? std::optional(made) : std::nullopt;
}

FanucNumber number_in(const std::string& text) {
  if (same_word(text, "ON")) return 1;
  if (same_word(text, "OFF")) return 0;
  FanucCursor at(text);
  const auto number = at.number();
  return at.at_end() ? number : std::nullopt;
}

}  // namespace

void add_causes(FanucCauses& to, const FanucCauses& more) {
  constexpr std::size_t most = 12;  // largest number of causes of a value
  for (const FanucCause& cause : more)
    if (to.size() < most && std::ranges::find(to, cause) == to.end()) to.push_back(cause);
}

std::string plain_fanuc_name(std::string_view written) {
  std::string plain;
  bool comment = false;
  for (char c : lower_case(written)) {
    if (c == ']') comment = false;
    if (c == ':' && plain.find('[') != std::string::npos) comment = true;
    if (!comment && static_cast<unsigned char>(c) > ' ') plain += c;
  }
  return plain;
}

FanucValues::FanucValues(const FanucVariables& backup, const std::map<std::string, std::string>& given,
                         Problems& problems)
    : positions_(backup.position_registers) {
  for (const auto& [number, value] : backup.registers) registers_[number].value = value;
  if (backup.frame_number) named_["uframe_num"] = *backup.frame_number;
  if (backup.tool_number) named_["utool_num"] = *backup.tool_number;
  for (const auto& [number, position] : positions_)
    if (position.known()) taught_.insert(number);
  for (const auto& [name, text] : given) take(plain_fanuc_name(name), text, problems);
}

/// Stores a value of the user. It replaces the value of the backup.
void FanucValues::take(const std::string& name, const std::string& text, Problems& problems) {
  given_[name] = text;
  FanucCursor at(name);
  const std::string word = at.word();
  const auto number = at.take_sign('[') ? at.number() : std::nullopt;
  const int index = whole_number(number.value_or(0));
  if (word == "pr" && number && name.find(',') == std::string::npos) {
    if (const auto position = position_in(text))
      positions_[index] = *position, taught_.insert(index);
    else
      problems.add({values_of_job({name}, text)}, "is no position",
                   "write 'X 100 Y 0 Z 50 W 180 P 0 R 0' [mm, deg] or 'J1 0 J2 10 ...' [deg]");
  } else if (word == "r" && number) {
    if (const auto value = number_in(text))
      registers_[index].value = value;
    else
      problems.add({values_of_job({name}, text)}, "is no number", "write for example R[5]=3");
  } else if (named_.contains(name)) {
    named_.erase(name);
  }
}

std::optional<std::string> FanucValues::given(const std::string& name) const {
  const auto found = given_.find(name);
  if (found == given_.end()) return {};
  used_.insert(name);
  return found->second;
}

std::vector<std::string> FanucValues::unused() const {
  std::vector<std::string> names;
  for (const auto& [name, text] : given_)
    if (!used_.contains(name)) names.push_back(name);
  return names;
}

std::optional<FanucPosition> FanucValues::given_position(const std::string& name) const {
  const auto text = given(plain_fanuc_name(name));
  return text ? position_in(*text) : std::nullopt;
}

FanucNumber FanucValues::unknown(const std::string& name) {
  if (const auto text = given(plain_fanuc_name(name)))
    if (const auto number = number_in(*text)) return number;
  add_causes(missing_, {{name}});
  return {};
}

void FanucValues::set_register(int number, FanucNumber value) {
  if (written_.size() < ImportLimits::values) written_.insert(number);
  if (value && !std::isfinite(*value)) value.reset();
  if (registers_.contains(number) || registers_.size() < ImportLimits::values)
    registers_[number] = {value, value ? FanucCauses{} : missing_};
}

void FanucValues::forget_register(int number, const FanucCauses& why) {
  if (!registers_.contains(number) && registers_.size() >= ImportLimits::values) return;
  Stored& forgotten = registers_[number];
  forgotten.value.reset();
  add_causes(forgotten.causes, why);
}

void FanucValues::set_position(int number, const FanucPosition& position) {
  taught_.erase(number);
  position_causes_.erase(number);
  if (positions_.size() < ImportLimits::values) positions_[number] = position;
}

void FanucValues::forget_position(int number, const FanucCauses& why) {
  positions_.erase(number);
  taught_.erase(number);
  if (position_causes_.contains(number) || position_causes_.size() < ImportLimits::values)
    position_causes_[number] = {{whole_position, why}};
}

void FanucValues::set_component(int number, int part, FanucNumber value) {
  if (part < 1 || part > 9) return;
  FanucPosition position = position_register(number);
  if (position.values.size() < 6) position.values.resize(6, NAN);
  if (part <= static_cast<int>(position.values.size())) position.values[part - 1] = value.value_or(NAN);
  taught_.erase(number);
  if (positions_.size() < ImportLimits::values) positions_[number] = position;
  position_causes_[number].erase(part);
  if (!value) position_causes_[number][part] = missing_;
}

/// Returns why a component of a position register, or the whole, is unknown; null: the program did not make it unknown.
const FanucCauses* FanucValues::position_causes(int number, int part) const {
  const auto found = position_causes_.find(number);
  if (found == position_causes_.end() || !found->second.contains(part)) return nullptr;
  return &found->second.at(part);
}

void FanucValues::miss_position(int number) {
  const FanucPosition position = position_register(number);
  bool whole = position.values.empty();
  const auto add = [&](int part) {
    const FanucCauses* causes = position_causes(number, part);
    if (causes) add_causes(missing_, *causes);
    return causes && !causes->empty();
  };
  for (std::size_t i = 0; i < position.values.size(); ++i)
    if (!std::isfinite(position.values[i])) whole |= !add(static_cast<int>(i) + 1);
  if (whole && !add(whole_position)) add_causes(missing_, {{fmt::format("PR[{}]", number)}});
}

bool FanucValues::take_effect(const std::string& call) {
  const auto text = given(plain_fanuc_name(call));
  if (!text) {
    forget_registers({{call}});
    return false;
  }
  FanucCursor at(*text);
  while (at.take("R")) {
    const auto number = at.take_sign('[') ? at.number() : std::nullopt;
    at.skip_to('=');
    const auto value = at.number();
    if (!number || !value) break;
    set_register(whole_number(*number), value);
    at.take_sign(',');
  }
  return true;
}

FanucPosition FanucValues::position_register(int number) const {
  const auto text = given_.empty() ? std::nullopt : given(fmt::format("pr[{}]", number));
  if (const auto found = positions_.find(number); found != positions_.end()) return found->second;
  if (text)
    if (const auto position = position_in(*text)) return *position;
  FanucPosition none;
  none.frame = none.tool = -1;
  return none;
}

void FanucValues::set_named(const std::string& name, FanucNumber value) {
  if (named_.size() < ImportLimits::values) named_[name] = value;
}

bool FanucValues::has_named(const std::string& name) const {
  const auto found = named_.find(name);
  return (found != named_.end() && found->second) || given(name);
}

FanucNumber FanucValues::named(const std::string& name) {
  const auto found = named_.find(name);
  if (found != named_.end() && found->second) return found->second;
  return unknown(upper_case(name));
}

FanucNumber FanucValues::override_percent(const std::string& name) const {
  const auto found = named_.find(name);
  if (found != named_.end() && found->second) return found->second;
  const auto text = given(name);
  return text ? number_in(*text) : found == named_.end() ? FanucNumber(100) : FanucNumber{};
}

void FanucValues::forget_registers(const FanucCauses& why) {
  for (auto& [number, stored] : registers_) {
    stored.value.reset();
    add_causes(stored.causes, why);
  }
  add_causes(forgotten_by_, why);
  std::erase_if(positions_, [&](const auto& entry) { return !taught_.contains(entry.first); });
  doubt_ = true;
}

bool FanucValues::doubtful(int position_register) const {
  return doubt_ && taught_.contains(position_register) && !given(fmt::format("pr[{}]", position_register));
}

std::string FanucValues::state() const {
  std::string text;
  for (const auto& [number, stored] : registers_)
    if (stored.value) text += fmt::format("{}={} ", number, *stored.value);
  for (const auto& [number, position] : positions_)
    text += fmt::format("p{}={} ", number, fmt::join(position.values, ","));
  for (const auto& [name, value] : named_) text += fmt::format("{}={} ", name, value.value_or(NAN));
  return text;
}

void FanucValues::read_for(int read) {
  if (std::set<int>& known = reads_[reader_]; known.size() < ImportLimits::values) known.insert(read);
}

FanucNumber FanucValues::source(int number, FanucCursor& at) {
  reader_ = number;
  const FanucNumber value = expression(at);
  reader_ = program_key;
  return value;
}

std::string FanucValues::deciding_state() const {
  std::set<int> deciding;
  std::vector<int> open{program_key};
  while (!open.empty()) {
    const auto found = reads_.find(open.back());
    open.pop_back();
    if (found == reads_.end()) continue;
    for (int read : found->second)
      if (deciding.insert(read).second) open.push_back(read);
  }
  std::string text;
  for (const auto& [number, stored] : registers_)
    if (stored.value && deciding.contains(number)) text += fmt::format("R[{}]={} ", number, *stored.value);
  if (deciding.contains(positions_key))
    for (const auto& [number, position] : positions_)
      text += fmt::format("PR[{}]={} ", number, fmt::join(position.values, ","));
  for (const auto& [name, value] : named_) text += fmt::format("{}={} ", upper_case(name), value.value_or(NAN));
  return text;
}

// ---- expressions -----------------------------------------------------------------------------------------

std::optional<FanucValues::Index> FanucValues::index(FanucCursor& at, int depth) {
  if (!at.take_sign('[')) return {};
  Index made;
  const std::size_t begin = at.offset();
  const std::string word = at.word();
  if (word.size() == 3 && word.starts_with("gp") && at.take_sign(':'))
    made.group = word[2] - '0';
  else
    at.move_to(begin);
  made.number = expression(at, depth + 1);
  if (at.take_sign(',')) made.part = expression(at, depth + 1);
  at.skip_to(']');  // skips a comment in the brackets
  return made;
}

FanucNumber FanucValues::function(const std::string& word, FanucNumber of) const {
  if (!of) return {};
  double result = NAN;
  if (word == "abs") result = std::abs(*of);
  if (word == "sqrt") result = std::sqrt(*of);
  if (word == "sin") result = std::sin(*of * degree);
  if (word == "cos") result = std::cos(*of * degree);
  if (word == "tan") result = std::tan(*of * degree);
  if (word == "round") result = std::round(*of);
  if (word == "trunc") result = std::trunc(*of);
  return std::isfinite(result) ? FanucNumber(shortest_single(result)) : FanucNumber{};
}

/// Returns the value of an unknown register from the user. If the program has set the register and a call without a file
/// may have changed it, the call is the question. If the program has not set the register, the register is the question.
FanucNumber FanucValues::register_value(int number) {
  const auto own = registers_.find(number);
  if (!given_.empty()) given(fmt::format("r[{}]", number));  // marks the user's value as used
  if (own != registers_.end()) read_for(number);
  if (own != registers_.end() && own->second.value) return own->second.value;
  const FanucCauses& causes = own != registers_.end() ? own->second.causes : forgotten_by_;
  const bool calls =
      std::ranges::any_of(causes, [](const FanucCause& cause) { return cause.name.find(' ') != std::string::npos; });
  if (causes.empty() || (calls ? !written_.contains(number) : given(fmt::format("r[{}]", number)).has_value()))
    return unknown(fmt::format("R[{}]", number));
  add_causes(missing_, causes);
  return {};
}

/// Reads a register or another name: R[5], PR[1,3], DI[3:part], AR[1], F[2], $MCR.$GENOVERRIDE, SIN[R[1]].
FanucNumber FanucValues::operand(FanucCursor& at, int depth) {
  const std::size_t begin = at.offset();
  const std::string word = at.word();
  if (word.empty()) {  // an error of the program, no value that the user can give
    add_causes(missing_, {FanucCause{}});
    return {};
  }
  if (word == "on") return 1;
  if (word == "off") return 0;
  if (word[0] == '$') {  // a system variable with its fields
    while (at.take_sign('.') || at.take_sign('['))
      if (at.rest().starts_with("$") || !at.name().empty()) at.take_sign(']');
    const std::string written(at.from(begin));
    if (plain_fanuc_name(written) == "$mcr.$genoverride") return override_percent("override");
    return unknown(written);
  }
  static const auto functions = {"abs", "sqrt", "sin", "cos", "tan", "round", "trunc"};
  const auto read = index(at, depth);
  if (std::ranges::find(functions, word) != functions.end()) return read ? function(word, read->number) : FanucNumber{};
  const std::string name = upper_case(word);
  if (!read || begin == at.offset()) return unknown(name);
  if (!read->number) return {};
  const int number = whole_number(*read->number);
  if (read->group != 1) return unknown(fmt::format("{}[GP{}:{}]", name, read->group, number));
  if (word == "pr" && read->part) {
    read_positions();
    const FanucPosition position = position_register(number);
    const int part = whole_number(*read->part);
    if (part >= 1 && part <= static_cast<int>(position.values.size()) && std::isfinite(position.values[part - 1]))
      return position.values[part - 1];
    const std::string component = fmt::format("PR[{},{}]", number, part);
    const FanucCauses* computed = position_causes(number, part);
    if (given(plain_fanuc_name(component)) || (!computed && !position_causes(number, whole_position)))
      return unknown(component);
    if (computed)
      add_causes(missing_, *computed);
    else
      miss_position(number);
    return {};
  }
  if (word == "ar") {
    const bool there =
        !arguments_.empty() && number >= 1 && static_cast<std::size_t>(number) <= arguments_.back().size();
    if (there && arguments_.back()[number - 1].value) return arguments_.back()[number - 1].value;
    if (there && !given(fmt::format("ar[{}]", number)) && !arguments_.back()[number - 1].causes.empty()) {
      add_causes(missing_, arguments_.back()[number - 1].causes);
      return {};
    }
  }
  if (word == "r") return register_value(number);
  return unknown(fmt::format("{}[{}]", name, number));
}

FanucNumber FanucValues::value(FanucCursor& at, int depth) {
  if (depth > ImportLimits::nesting) return {};
  if (at.take_sign('(')) {
    const FanucNumber inner = level(at, 1, depth + 1);
    at.take_sign(')');
    return inner;
  }
  if (at.take_sign('-')) {
    const FanucNumber inner = value(at, depth + 1);
    return inner ? FanucNumber(-*inner) : inner;
  }
  if (at.take_sign('!')) {
    const FanucNumber inner = value(at, depth + 1);
    return inner ? FanucNumber(*inner == 0) : inner;
  }
  if (const FanucNumber number = at.number()) return number;
  if (at.take_sign('\'')) {
    at.skip_to('\'');
    return {};
  }
  return operand(at, depth);
}

namespace {

struct FanucOperator {
  std::string_view written;
  int level;
};
constexpr int conjunctions = 2, comparisons = 3, sums = 4, products = 5;
constexpr FanucOperator fanuc_operators[] = {
    {"OR", 1},          {"AND", conjunctions}, {"<>", comparisons}, {"<=", comparisons}, {">=", comparisons},
    {"<", comparisons}, {">", comparisons},    {"=", comparisons},  {"+", sums},         {"-", sums},
    {"*", products},    {"/", products},       {"DIV", products},   {"MOD", products}};

/// Takes the operator at the cursor if its level is lowest .. highest. Returns null if no such operator follows.
const FanucOperator* next_operator(FanucCursor& at, int lowest, int highest) {
  for (const FanucOperator& op : fanuc_operators) {
    if (op.level < lowest || op.level > highest) continue;
    if (op.written[0] >= 'A' ? at.take(op.written) : at.take_signs(op.written)) return &op;
  }
  return nullptr;
}

/// Applies `op`. One known side of AND or OR can decide the result; other operators need both sides.
FanucNumber combined(std::string_view op, FanucNumber a, FanucNumber b) {
  if (const bool either = op == "OR"; either || op == "AND") {
    for (const FanucNumber& side : {a, b})
      if (side && (*side != 0) == either) return FanucNumber(either);
    return a && b ? FanucNumber(!either) : FanucNumber{};
  }
  if (!a || !b) return {};
  const double x = as_single(*a), y = as_single(*b);
  const double result = op == "+"     ? x + y
                        : op == "-"   ? x - y
                        : op == "*"   ? x * y
                        : op == "/"   ? x / y
                        : op == "DIV" ? std::trunc(x / y)
                        : op == "MOD" ? std::fmod(x, y)
                        : x < y       ? op[0] == '<'  // <, <=, <>
                        : x > y       ? op.back() == '>' || op == ">="
                                      : op.back() == '=';
  return std::isfinite(result) ? FanucNumber(shortest_single(result)) : FanucNumber{};
}

}  // namespace

/// Evaluates operators of level `lowest` and above by precedence climbing. Comparisons cannot be chained (a < b < c).
FanucNumber FanucValues::level(FanucCursor& at, int lowest, int depth) {
  if (depth > ImportLimits::nesting) return {};
  ++charged_;
  FanucNumber left = value(at, depth);
  int highest = products;
  while (const FanucOperator* op = next_operator(at, lowest, highest)) {
    ++charged_;
    left = combined(op->written, left, level(at, op->level + 1, depth));
    if (op->level <= comparisons) highest = conjunctions;
  }
  return left;
}

FanucNumber FanucValues::expression(FanucCursor& at, int depth) { return level(at, sums, depth); }

std::optional<bool> FanucValues::condition(FanucCursor& at) {
  const FanucNumber result = level(at, 1, 0);
  return result ? std::optional(*result != 0) : std::nullopt;
}

}  // namespace dresslife::sim
