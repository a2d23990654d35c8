#include "sim/program/rapid.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/program/rapid_types.h"
#include "sim/program/tokens.h"

namespace dresslife::sim {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double millimetre = 1e-3;
constexpr double no_axis = 9e8;  // 9E9 means: no such axis

/// Where an instruction keeps its arguments: indices among those without a name, -1: none, -2: the last.
struct Signature {
  const char* name;
  Instruction::Kind kind;
  bool joints;  ///< the target is a jointtarget
  int via, target, speed, zone, tool;
};

constexpr auto J = Instruction::Kind::joint;
constexpr auto L = Instruction::Kind::linear;
constexpr auto C = Instruction::Kind::circular;

constexpr Signature signatures[] = {
    {"moveabsj", J, true, -1, 0, 1, 2, 3},    {"movej", J, false, -1, 0, 1, 2, 3},
    {"movel", L, false, -1, 0, 1, 2, 3},      {"movec", C, false, 0, 1, 2, 3, 4},
    {"triggabsj", J, true, -1, 0, 1, 3, 4},   {"triggj", J, false, -1, 0, 1, 3, 4},
    {"triggl", L, false, -1, 0, 1, 3, 4},     {"triggc", C, false, 0, 1, 2, 4, 5},
    {"trigglios", L, false, -1, 0, 1, 2, 3},  {"triggjios", J, false, -1, 0, 1, 2, 3},
    {"searchl", L, false, -1, 2, 3, -1, 4},   {"searchc", C, false, 2, 3, 4, -1, 5},
    {"movejdo", J, false, -1, 0, 1, 2, 3},    {"moveldo", L, false, -1, 0, 1, 2, 3},
    {"movecdo", C, false, 0, 1, 2, 3, 4},     {"movejao", J, false, -1, 0, 1, 2, 3},
    {"movelao", L, false, -1, 0, 1, 2, 3},    {"movecao", C, false, 0, 1, 2, 3, 4},
    {"movejgo", J, false, -1, 0, 1, 2, 3},    {"movelgo", L, false, -1, 0, 1, 2, 3},
    {"movecgo", C, false, 0, 1, 2, 3, 4},     {"movejsync", J, false, -1, 0, 1, 2, 3},
    {"movelsync", L, false, -1, 0, 1, 2, 3},  {"movecsync", C, false, 0, 1, 2, 3, 4},
    {"egmmovel", L, false, -1, 1, 2, 3, 4},   {"egmmovec", C, false, 1, 2, 3, 4, 5},
    {"arcl", L, false, -1, 0, 1, -3, -2},     {"arclstart", L, false, -1, 0, 1, -3, -2},
    {"arclend", L, false, -1, 0, 1, -3, -2},  {"arcc", C, false, 0, 1, 2, -3, -2},
    {"arccstart", C, false, 0, 1, 2, -3, -2}, {"arccend", C, false, 0, 1, 2, -3, -2},
    {"arcmovel", L, false, -1, 0, 1, 2, 3},   {"arcmovej", J, false, -1, 0, 1, 2, 3},
    {"arcmovec", C, false, 0, 1, 2, 3, 4},    {"displ", L, false, -1, 0, 1, -3, -2},
    {"dispc", C, false, 0, 1, 2, -3, -2},     {"spotl", L, false, -1, 0, 1, -1, -2},
    {"spotj", J, false, -1, 0, 1, -1, -2},    {"spotml", L, false, -1, 0, 1, -1, -2},
    {"spotmj", J, false, -1, 0, 1, -1, -2},
};

const Signature* signature_of(const std::string& name) {
  for (const Signature& signature : signatures)
    if (name == signature.name) return &signature;
  return nullptr;
}

bool is_weld(const std::string& name) { return name.starts_with("arc") && !name.starts_with("arcmove"); }

// ---- numbers of a known value; its shape has been checked
// ---------------------------------------------------

double at(const Value& value, std::size_t i) { return value.items[i].number; }

Vector3 position_of(const Value& pos) { return millimetre * Vector3(at(pos, 0), at(pos, 1), at(pos, 2)); }

/// Written with a few digits, hence normalised; absent when it is none.
std::optional<Quaternion> orientation_of(const Value& orient) {
  const Quaternion q(at(orient, 0), at(orient, 1), at(orient, 2), at(orient, 3));
  constexpr double rounding = 0.02;  // of a norm: components written with two decimals
  if (!(std::abs(q.norm() - 1) < rounding)) return {};
  return q.normalized();
}

std::optional<Frame> frame_of(const Value& pose) {
  const auto q = orientation_of(pose.items[1]);
  if (!q) return {};
  return Frame{position_of(pose.items[0]), *q};
}

std::vector<double> external_of(const Value& extax) {
  std::vector<double> axes;
  for (const Value& axis : extax.items)
    if (std::abs(axis.number) < no_axis) axes.push_back(axis.number);
  return axes;
}

class Rapid final : public Dialect {
 public:
  Rapid(const Code& code, const std::vector<NamedFrame>& tools, const std::vector<NamedFrame>& work_objects)
      : code_(code), tools_(tools), work_objects_(work_objects) {}

  std::optional<Value> constant(const std::string& name) override {
    if (name == "pi") return number_value(std::numbers::pi);
    if (name == "tool0") return tool_value(NamedFrame{});
    if (name == "wobj0") return work_object_value(NamedFrame{});
    if (name == "vmax") return rapid_speed(code_, "v7000");
    if (name == "load0") return rapid_initial(code_, "loaddata");
    for (const NamedFrame& tool : tools_)
      if (same(name, tool.name)) return tool_value(tool);
    for (const NamedFrame& object : work_objects_)
      if (same(name, object.name)) return work_object_value(object);
    if (auto speed = rapid_speed(code_, name)) return speed;
    return rapid_zone(code_, name);
  }

  std::optional<Value> function(const Expression& call, Interpreter& run) override;
  bool instruction(const Statement& statement, Interpreter& run) override;

  bool matters(const std::string& name) const override {
    return signature_of(name) || name == "waittime" || name == "accset" || name == "velset" ||
           name == "pdispset" || name == "pdispon" || name == "pdispoff" || name.starts_with("move");
  }
  bool harmless(const std::string& name) const override {
    const auto& names = harmless_rapid_instructions();
    return std::binary_search(names.begin(), names.end(), name);
  }
  const RecordType* type_of(const std::string& name) const override { return code_.record(name); }
  Value initial(const std::string& type) const override { return rapid_initial(code_, type); }

 private:
  static bool same(const std::string& lower, const std::string& written) {
    return lower == lower_case(written);
  }

  Value frame_value(const Frame& frame) const {
    Value pose = rapid_initial(code_, "pose");
    for (int i = 0; i < 3; ++i) pose.items[0].items[i] = number_value(frame.position[i] / millimetre);
    const Quaternion& q = frame.orientation;
    const double parts[] = {q.w(), q.x(), q.y(), q.z()};
    for (int i = 0; i < 4; ++i) pose.items[1].items[i] = number_value(parts[i]);
    return pose;
  }
  Value tool_value(const NamedFrame& tool) const {
    Value value = rapid_initial(code_, "tooldata");
    value.items[0] = truth_value(!tool.stationary);
    value.items[1] = frame_value(tool.frame);
    return value;
  }
  Value work_object_value(const NamedFrame& object) const {
    Value value = rapid_initial(code_, "wobjdata");
    value.items[0] = truth_value(object.stationary);
    value.items[1] = truth_value(true);
    value.items[3] = frame_value(object.frame);
    value.items[4] = frame_value(Frame{});
    return value;
  }

  bool move(const Signature& signature, const Statement& statement, Interpreter& run);
  bool read_target(const Expression& written, bool joints, Instruction& move, Interpreter& run);
  std::optional<Frame> read_via(const Expression& written, Interpreter& run);
  bool read_speed(const Expression& written, Instruction& move, Interpreter& run);
  bool read_weld_speed(const Statement& statement, Instruction& move, Interpreter& run);
  bool read_zone(const Expression& written, Instruction& move, Interpreter& run);
  bool read_tool(const Expression& written, Instruction& move, Interpreter& run);
  bool read_work_object(const Expression& written, Instruction& move, Interpreter& run);
  void read_options(const Statement& statement, Instruction& move, Interpreter& run);
  static bool is_frame(std::string_view type) { return type == "tooldata" || type == "wobjdata"; }
  std::optional<Value> typed(const Expression& written, const char* type, const char* what, Interpreter& run);
  void settings(const Statement& statement, Interpreter& run);
  Value offset(const Expression& call, bool in_tool, Interpreter& run);

  const Code& code_;
  const std::vector<NamedFrame>& tools_;
  const std::vector<NamedFrame>& work_objects_;
  double acceleration_percent_ = 100;
  double speed_factor_ = 1, speed_limit_ = INFINITY;  // of VelSet; [m/s]
  Frame displacement_;                                // of PDispSet
  bool check_configuration_ = true;
  Value last_target_;
};

std::optional<Value> Rapid::typed(const Expression& written, const char* type, const char* what,
                                  Interpreter& run) {
  Value value = run.evaluate(written);
  if (!value.known()) {
    const std::string remedy = run.remedy_for(value);
    if (written.kind == Expression::Kind::name && !run.variable(written.text))
      run.miss(
          written.text, written.place,
          fmt::format("names {} '{}' that no module read declares", what, written.text),
          fmt::format("give the module that declares it too (--module, motion.modules), or {}",
                      is_frame(type) ? "its frame in --frames FILE.yaml (motion.tools, motion.work_objects)"
                                     : remedy + " (motion.values)"));
    else
      run.complain(written.place,
                   fmt::format("has {} that is known only while the robot runs", what) + run.because(value),
                   remedy.empty() ? fmt::format("write {} as a constant", what)
                                  : fmt::format("give {} (motion.values)", remedy));
    return {};
  }
  const RecordType* record = code_.record(type);
  if (value.type == record || (!value.type && value.kind == Value::Kind::list && run.shape(value, record)))
    return value;
  run.complain(written.place, fmt::format("has no {} where {} is expected", type, what), "mend the argument");
  return {};
}

bool Rapid::read_target(const Expression& written, bool joints, Instruction& move, Interpreter& run) {
  const auto value = typed(written, joints ? "jointtarget" : "robtarget", "a target", run);
  if (!value) return false;
  if (joints) {
    for (const Value& axis : value->items[0].items)
      if (std::abs(axis.number) < no_axis) move.target.joints.push_back(axis.number * degree);
    move.target.external_axes = external_of(value->items[1]);
    return true;
  }
  const auto q = orientation_of(value->items[1]);
  if (!q) {
    run.complain(written.place, "has a target whose quaternion has not the length 1", "mend its orientation");
    return false;
  }
  move.target.pose = displacement_ * Frame{position_of(value->items[0]), *q};
  const Value& conf = value->items[2];
  if (check_configuration_) {
    move.target.configuration.kind = ArmConfiguration::Kind::abb;
    for (const Value& number : conf.items)
      move.target.configuration.numbers.push_back(static_cast<int>(std::clamp(number.number, -1e6, 1e6)));
  }
  move.target.external_axes = external_of(value->items[3]);
  last_target_ = *value;
  return true;
}

std::optional<Frame> Rapid::read_via(const Expression& written, Interpreter& run) {
  const auto value = typed(written, "robtarget", "a circle point", run);
  if (!value) return {};
  const auto q = orientation_of(value->items[1]);
  return displacement_ * Frame{position_of(value->items[0]), q.value_or(Quaternion::Identity())};
}

bool Rapid::read_speed(const Expression& written, Instruction& move, Interpreter& run) {
  const auto value = typed(written, "speeddata", "a speed", run);
  if (!value) return false;
  if (!(at(*value, 0) > 0) && !(at(*value, 1) > 0)) {
    run.complain(written.place, "has a speed that is not above 0", "give v_tcp in mm/s");
    return false;
  }
  const bool largest = written.kind == Expression::Kind::name && written.text == "vmax";
  if (!largest && at(*value, 0) > 0)
    move.speed.tool = std::min(at(*value, 0) * millimetre * speed_factor_, speed_limit_);
  if (!largest && at(*value, 1) > 0) move.speed.orientation = at(*value, 1) * degree * speed_factor_;
  return true;
}

/// ArcL and ArcC weld at the speed of their welddata; on the way to the seam that of the instruction counts.
bool Rapid::read_weld_speed(const Statement& statement, Instruction& move, Interpreter& run) {
  if (statement.name.ends_with("start")) return true;
  for (std::size_t i = 3; i + 2 < statement.arguments.size() + 1; ++i) {
    const Expression& argument = statement.arguments[i < statement.arguments.size() ? i : 0];
    if (!argument.option.empty()) continue;
    const Value value = run.evaluate(argument);
    // welddata begins with the speed and three more parts; seamdata begins with times, a zone is typed.
    if (value.kind != Value::Kind::list || value.type || value.items.size() < 2 ||
        !value.items[0].is_number())
      continue;
    if (value.items[0].number > 0) move.speed.tool = value.items[0].number * millimetre;
  }
  return true;
}

bool Rapid::read_zone(const Expression& written, Instruction& move, Interpreter& run) {
  const auto value = typed(written, "zonedata", "a zone", run);
  if (!value) return false;
  move.zone.distance = value->items[0].number != 0 ? 0 : std::max(0.0, at(*value, 1)) * millimetre;
  return true;
}

bool Rapid::read_tool(const Expression& written, Instruction& move, Interpreter& run) {
  if (written.kind == Expression::Kind::name && written.text == "tool0") return true;
  const auto value = typed(written, "tooldata", "a tool", run);
  if (!value) return false;
  const auto frame = frame_of(value->items[1]);
  if (!frame) {
    run.complain(written.place, "has a tool whose quaternion has not the length 1", "mend its tframe");
    return false;
  }
  const std::string name = written.kind == Expression::Kind::name ? written.text : "tool";
  move.tool = run.frame_index(run.program().tools, {name, *frame, value->items[0].number == 0});
  return true;
}

bool Rapid::read_work_object(const Expression& written, Instruction& move, Interpreter& run) {
  if (written.kind == Expression::Kind::name && written.text == "wobj0") return true;
  const auto value = typed(written, "wobjdata", "a work object", run);
  if (!value) return false;
  const auto user = frame_of(value->items[3]), object = frame_of(value->items[4]);
  if (!user || !object) {
    run.complain(written.place, "has a work object whose quaternion has not the length 1", "mend its frames");
    return false;
  }
  const bool held = value->items[0].number != 0;
  if (value->items[1].number == 0)
    run.note(written.place, "a work object that another mechanical unit moves: it is taken to stand still",
             true);
  const std::string name = written.kind == Expression::Kind::name ? written.text : "work object";
  move.work_object = run.frame_index(run.program().work_objects, {name, *user * *object, held});
  return true;
}

void Rapid::read_options(const Statement& statement, Instruction& move, Interpreter& run) {
  for (const Expression& argument : statement.arguments) {
    if (argument.option == "wobj") read_work_object(argument, move, run);
    if (argument.option != "t" && argument.option != "v" && argument.option != "z") continue;
    const auto number = run.number(argument);
    if (!number || !(*number >= 0) || (*number == 0 && argument.option != "z")) {
      run.complain(argument.place, fmt::format("has no number above 0 after \\{}", argument.option),
                   "write it as a constant");
      continue;
    }
    if (argument.option == "t") move.speed.duration = *number;
    if (argument.option == "v")
      move.speed.tool = std::min(*number * millimetre * speed_factor_, speed_limit_);
    if (argument.option == "z") move.zone.distance = *number * millimetre;
  }
}

bool Rapid::move(const Signature& signature, const Statement& statement, Interpreter& run) {
  std::vector<const Expression*> given;
  for (const Expression& argument : statement.arguments)
    if (argument.option.empty() && argument.kind != Expression::Kind::none) given.push_back(&argument);
  const int count = static_cast<int>(given.size());
  const auto index = [&](int written) {
    return written == -2 ? count - 1 : written == -3 ? count - 2 : written;
  };
  const int zone = index(signature.zone), tool = index(signature.tool);
  if (std::max({signature.target, signature.speed, zone, tool}) >= count || tool <= signature.speed) {
    run.complain(statement.place, fmt::format("{} has {} arguments, too few", statement.text, count),
                 "give target, speed, zone and tool");
    return true;
  }
  Instruction move;
  move.kind = signature.kind;
  move.acceleration_percent = acceleration_percent_;
  bool whole = read_target(*given[signature.target], signature.joints, move, run);
  if (signature.via >= 0) {
    const auto via = read_via(*given[signature.via], run);
    whole &= via.has_value();
    if (via) move.via = *via;
  }
  whole &= read_speed(*given[signature.speed], move, run);
  if (zone > signature.speed) whole &= read_zone(*given[zone], move, run);
  whole &= read_tool(*given[tool], move, run);
  read_options(statement, move, run);
  if (is_weld(statement.name)) whole &= read_weld_speed(statement, move, run);
  if (!whole) return true;
  if (statement.name.starts_with("search")) {
    run.note(statement.place, statement.text + ": the search goes to its end point");
    run.assign(*given[1], last_target_);
  }
  run.emit(move, statement);
  if (!statement.name.starts_with("spot")) return true;
  Instruction weld = move;
  weld.kind = Instruction::Kind::dwell;
  weld.dwell = run.options().spot_time;
  run.emit(weld, statement);
  return true;
}

void Rapid::settings(const Statement& statement, Interpreter& run) {
  std::vector<std::optional<double>> numbers;
  for (const Expression& argument : statement.arguments)
    if (argument.option.empty()) numbers.push_back(run.number(argument));
  const auto needed = [&](std::size_t i, double low, double high) {
    if (i < numbers.size() && numbers[i] && *numbers[i] >= low && *numbers[i] <= high) return *numbers[i];
    run.complain(statement.place,
                 fmt::format("{} has no number in {} .. {} as argument {}", statement.text, low, high, i + 1),
                 "write it as a constant");
    return high;
  };
  if (statement.name == "accset") acceleration_percent_ = std::max(20.0, needed(0, 0, 100));
  if (statement.name == "velset") {
    speed_factor_ = needed(0, 0.1, 100) / 100;
    speed_limit_ = needed(1, 0.1, 1e6) * millimetre;
  }
}

bool Rapid::instruction(const Statement& statement, Interpreter& run) {
  const std::string& name = statement.name;
  if (const Signature* signature = signature_of(name)) return move(*signature, statement, run);
  if (name == "accset" || name == "velset") {
    settings(statement, run);
  } else if (name == "waittime") {
    Instruction wait;
    wait.kind = Instruction::Kind::dwell;
    std::optional<double> time;
    for (const Expression& argument : statement.arguments)
      if (argument.option.empty()) time = run.number(argument);
    if (!time || !(*time >= 0))
      run.complain(statement.place, "waits for a time that is known only while the robot runs",
                   "write it as a constant");
    else if (*time > 0) {
      wait.dwell = *time;
      run.emit(wait, statement);
    }
  } else if (name == "pdispset" && !statement.arguments.empty()) {
    if (const auto pose = typed(statement.arguments[0], "pose", "a displacement", run))
      if (const auto frame = frame_of(*pose)) displacement_ = *frame;
  } else if (name == "pdispoff") {
    displacement_ = Frame{};
  } else if (name == "pdispon") {
    run.complain(statement.place, "PDispOn displaces by where the robot happens to be",
                 "write the displacement with PDispSet");
  } else if (name == "confl" || name == "confj") {
    for (const Expression& argument : statement.arguments) check_configuration_ = argument.option != "off";
  } else {
    return false;
  }
  return true;
}

// ---- functions
// ----------------------------------------------------------------------------------------------

/// Offs(target, x, y, z) in the work object; RelTool(target, x, y, z \Rx \Ry \Rz) in the tool [mm, deg].
Value Rapid::offset(const Expression& call, bool in_tool, Interpreter& run) {
  if (call.items.size() < 4) {
    run.complain(call.place, fmt::format("{} has too few arguments", call.text), "give a target and x, y, z");
    return {};
  }
  Value target = run.evaluate(call.items[0]);
  if (!target.type && target.kind == Value::Kind::list) run.shape(target, code_.record("robtarget"));
  double by[3], turn[3] = {0, 0, 0};
  if (!target.known() || target.type != code_.record("robtarget")) return {};
  int k = 0;
  for (std::size_t i = 1; i < call.items.size(); ++i) {
    const auto number = run.number(call.items[i]);
    if (!number) return {};
    const std::string& option = call.items[i].option;
    if (option.size() == 2 && option[0] == 'r' && option[1] >= 'x' && option[1] <= 'z')
      turn[option[1] - 'x'] = *number * degree;
    else if (k < 3)
      by[k++] = *number;
  }
  if (k < 3) return {};
  const auto q = orientation_of(target.items[1]);
  if (!q) return {};
  Vector3 shift(by[0], by[1], by[2]);
  Quaternion turned = *q;
  if (in_tool) {  // turned about x, then y, then z of the tool (RelTool)
    shift = *q * shift;
    turned = *q * rotation({turn[0], 0, 0}) * rotation({0, turn[1], 0}) * rotation({0, 0, turn[2]});
  }
  for (int i = 0; i < 3; ++i) target.items[0].items[i].number += shift[i];
  const double parts[] = {turned.w(), turned.x(), turned.y(), turned.z()};
  for (int i = 0; i < 4; ++i) target.items[1].items[i].number = parts[i];
  return target;
}

namespace {

/// Functions of one number.
std::optional<double> simple_function(const std::string& name, double x) {
  if (name == "abs") return std::abs(x);
  if (name == "sqrt") return std::sqrt(x);
  if (name == "sin") return std::sin(x * degree);
  if (name == "cos") return std::cos(x * degree);
  if (name == "tan") return std::tan(x * degree);
  if (name == "asin") return std::asin(x) / degree;
  if (name == "acos") return std::acos(x) / degree;
  if (name == "atan") return std::atan(x) / degree;
  if (name == "exp") return std::exp(x);
  if (name == "round") return std::round(x);
  if (name == "trunc") return std::trunc(x);
  if (name == "dnumtonum" || name == "numtodnum") return x;
  return {};
}

Value finite(double x) { return std::isfinite(x) ? number_value(x) : Value{}; }

}  // namespace

std::optional<Value> Rapid::function(const Expression& call, Interpreter& run) {
  const std::string& name = call.text;
  if (name == "offs") return offset(call, false, run);
  if (name == "reltool") return offset(call, true, run);
  if (name == "crobt") return last_target_;
  if (name == "present" && call.items.size() == 1 && call.items[0].kind == Expression::Kind::name)
    return truth_value(run.variable(call.items[0].text) != nullptr);
  std::vector<Value> values;
  for (const Expression& argument : call.items)
    values.push_back(argument.option.empty() || argument.kind != Expression::Kind::none
                         ? run.evaluate(argument)
                         : Value{});
  if (values.size() == 1 && values[0].is_number())
    if (const auto result = simple_function(name, values[0].number)) return finite(*result);
  if (values.size() == 2 && values[0].is_number() && values[1].is_number()) {
    if (name == "pow") return finite(std::pow(values[0].number, values[1].number));
    if (name == "atan2") return finite(std::atan2(values[0].number, values[1].number) / degree);
    if (name == "max") return number_value(std::max(values[0].number, values[1].number));
    if (name == "min") return number_value(std::min(values[0].number, values[1].number));
  }
  if (name == "orientzyx" && values.size() == 3) {
    for (const Value& value : values)
      if (!value.is_number()) return Value{};
    const Quaternion q = rotation({0, 0, values[0].number * degree}) *
                         rotation({0, values[1].number * degree, 0}) *
                         rotation({values[2].number * degree, 0, 0});
    Value orient = rapid_initial(code_, "orient");
    const double parts[] = {q.w(), q.x(), q.y(), q.z()};
    for (int i = 0; i < 4; ++i) orient.items[i].number = parts[i];
    return orient;
  }
  if ((name == "poseinv" && values.size() == 1) || (name == "posemult" && values.size() == 2)) {
    std::vector<Frame> frames;
    for (Value& value : values) {
      if (!value.known() || (!value.type && !run.shape(value, code_.record("pose"))) ||
          value.type != code_.record("pose"))
        return Value{};
      const auto frame = frame_of(value);
      if (!frame) return Value{};
      frames.push_back(*frame);
    }
    if (name == "posemult") return frame_value(frames[0] * frames[1]);
    const Quaternion back = frames[0].orientation.conjugate();
    return frame_value({back * Vector3(-frames[0].position), back});
  }
  if (name == "dim" && values.size() == 2 && values[1].is_number()) {
    const Value* list = &values[0];
    for (double k = 1; k < values[1].number && !list->items.empty() && k < 4; ++k) list = &list->items[0];
    return list->kind == Value::Kind::list ? number_value(static_cast<double>(list->items.size())) : Value{};
  }
  return {};
}

}  // namespace

void run_rapid(const Code& code, const ImportOptions& options, const std::vector<NamedFrame>& tools,
               const std::vector<NamedFrame>& work_objects, Program& program, Problems& problems) {
  const std::string start = code.start.empty() ? "main" : code.start;
  const Routine* routine = code.find(start, -1);
  for (const Routine& other : code.routines)  // a local one is meant where there is no other
    if (!routine && other.name == start) routine = &other;
  if (!routine && options.routine.empty() && code.routines.size() == 1) routine = &code.routines[0];
  if (!routine) {
    std::vector<std::string> names;
    for (const Routine& other : code.routines)
      if (names.size() < 40) names.push_back(other.written);
    problems.add(
        {code.files.empty() ? "" : code.files[0].name(), 1, 1}, fmt::format("has no routine '{}'", start),
        fmt::format("name one with --routine (motion.routine in a job): {}", fmt::join(names, ", ")));
    return;
  }
  Rapid rapid(code, tools, work_objects);
  Interpreter(code, rapid, options, program, problems).run(*routine);
}

}  // namespace dresslife::sim
