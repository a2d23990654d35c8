#include "sim/program/urscript/urscript.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <set>

#include "pipeline/base/constants.h"
#include "sim/program/interpreter/arc.h"
#include "sim/program/interpreter/request.h"
#include "sim/program/interpreter/tokens.h"

namespace dresslife::sim {
namespace {

/// A move of the language: names of its arguments in their order, and default values (script manual).
struct Signature {
  const char* name;
  Instruction::Kind kind;
  std::vector<const char*> arguments;
  double acceleration, speed;  ///< defaults; [rad/s2, rad/s] of joint moves, else [m/s2, m/s]
  double least_time = 0;       ///< of a call [s], which is also its default; 0: the speed counts
};

const Signature* move_of(const std::string& name) {
  using Kind = Instruction::Kind;
  static const std::vector<Signature> moves{
      {"movej", Kind::joint, {"q", "a", "v", "t", "r"}, 1.4, 1.05},
      {"movel", Kind::linear, {"pose", "a", "v", "t", "r"}, 1.2, 0.25},
      {"movep", Kind::linear, {"pose", "a", "v", "r"}, 1.2, 0.25},
      {"movec", Kind::circular, {"pose_via", "pose_to", "a", "v", "r", "mode"}, 1.2, 0.25},
      {"servoj", Kind::joint, {"q", "a", "v", "t", "lookahead_time", "gain"}, 0, 0, 0.002},
      {"servoc", Kind::linear, {"pose", "a", "v", "r"}, 1.2, 0.25}};
  const auto found = std::ranges::find_if(moves, [&](const Signature& m) { return name == m.name; });
  return found == moves.end() ? nullptr : &*found;
}

bool begins_with_any(const std::string& name, std::initializer_list<std::string_view> list) {
  return std::ranges::any_of(list, [&](std::string_view begin) { return name.starts_with(begin); });
}

class Script final : public Dialect {
 public:
  Script(const Code& code, const std::vector<NamedFrame>& tools) : code_(code) {
    for (const NamedFrame& tool : tools)
      if (same_word(tool.name, "tcp")) tcp_ = tool;
  }

  std::optional<Value> constant(const std::string& name) override {
    if (name == "pi" || name == "math.pi") return number_value(std::numbers::pi);
    if (std::optional<Value> value = run_->given(name)) return value;
    return {};
  }

  std::optional<Value> function(const Expression& call) override {
    std::vector<Value> values;
    for (const Expression& argument : call.items)
      if (argument.option.empty()) values.push_back(run_->evaluate(argument));
    if (call.text == "p") return values.size() == 6 ? std::optional(list_value(values, record("pose"))) : Value{};
    if (call.text.starts_with("run ")) return run_thread(call.text, call.place), Value{};
    if (call.text == "get_inverse_kin") return inverse_kinematics(call, values);
    if (call.text == "get_forward_kin") return forward_kinematics(call, values);
    if (std::optional<Value> known = arithmetic(call.text, values)) return known;
    if (begins_with_any(call.text, {"get_actual_tcp_pose", "get_target_tcp_pose"})) {
      if (standing_) return *standing_;
      if (const auto pose = axes_ ? pose_at(*axes_) : std::nullopt) return *pose;
    }
    if (begins_with_any(call.text, {"get_actual_joint_positions", "get_target_joint_positions"}) && axes_)
      return *axes_;
    if (begins_with_any(call.text, {"get_actual_", "get_target_"}))
      return given_or_unknown(call, "reads the robot's position");
    return given_or_unknown(call, "is known only while the robot runs");
  }

  bool instruction(const Statement& statement) override {
    const std::string& name = statement.name;
    if (const Signature* signature = move_of(name)) return move(*signature, statement), true;
    if (name == "sleep") return sleep(statement), true;
    if (name == "set_tcp") return set_tcp(statement), true;
    if (name == "run") return run_thread(statement.text, statement.place), true;
    if (begins_with_any(name, {"speedj", "speedl", "force_mode", "freedrive_mode", "teach_mode", "path_offset",
                               "conveyor_", "track_conveyor"}) &&
        !name.ends_with("_stop") && !name.starts_with("end_")) {
      standing_.reset(), axes_.reset();
      return run_->note(statement.place, statement.text + ": leads the robot in a way that is not followed", true),
             true;
    }
    return false;
  }

  bool matters(const std::string& name) const override {
    return move_of(name) || name == "set_tcp" || name == "speedj" || name == "speedl" ||
           name.starts_with("force_mode") || name.starts_with("optimove");
  }
  bool only_waits(const std::string& name) const override { return name == "sleep"; }
  bool harmless(const std::string& name) const override {
    static const pipeline::WordSet words = pipeline::word_set(
        "textmsg popup sync stopj stopl kill join halt end_force_mode zero_ftsensor enter_critical exit_critical "
        "powerdown servo_stop end_freedrive_mode end_teach_mode write_output protective_stop varmsg "
        "request_boolean_from_primary_client tool_contact");
    return words.contains(name) || begins_with_any(name, {"set_", "get_", "socket_", "modbus_", "write_", "read_",
                                                          "rtde_", "reset_", "blocking_"});
  }
  bool writes(const std::string&, int, const Expression&) const override {
    return false;
  }  // arguments are passed by value
  const RecordType* type_of(const std::string&) const override { return nullptr; }
  std::string form_of(const std::string&) const override { return ""; }  // variables have no declared types
  Value initial(const std::string&) const override { return {}; }
  int first_index() const override { return 0; }
  bool has_single_precision() const override { return false; }
  bool computes_by_item() const override { return true; }

 private:
  const RecordType* record(const char* name) const { return code_.record(name); }
  bool is(const Value& value, const char* type) const {
    return value.kind == Value::Kind::list && value.type == record(type) && value.known();
  }

  std::optional<Frame> pose_in(const Value& value) const {
    if (!is(value, "pose")) return {};
    const auto& n = value.items;
    for (const Value& item : n)
      if (!item.is_number()) return {};
    return Frame{{n[0].number, n[1].number, n[2].number}, rotation({n[3].number, n[4].number, n[5].number})};
  }
  Value pose_value(const Frame& frame) const {
    const Vector3 turn = rotation_vector(frame.orientation);
    std::vector<Value> items;
    for (const Vector3& part : {frame.position, turn})
      for (int i = 0; i < 3; ++i) items.push_back(number_value(part[i]));
    return list_value(std::move(items), record("pose"));
  }
  static std::optional<std::vector<double>> joints_in(const Value& value) {
    if (value.kind != Value::Kind::list || value.type || value.items.size() < 4 || !value.known()) return {};
    std::vector<double> joints;
    for (const Value& item : value.items)
      if (item.is_number()) joints.push_back(item.number);
    return joints.size() == value.items.size() ? std::optional(joints) : std::nullopt;
  }

  // ---- functions --------------------------------------------------------------------------------------------------

  /// Returns the user's value of a call such as "get_digital_in(3)"; otherwise an unknown value.
  Value given_or_unknown(const Expression& call, const char* why) {
    std::string name = run_->written(call);
    std::erase(name, ' ');
    if (std::optional<Value> value = run_->given(value_key(name))) return *value;
    for (const Expression& argument : call.items)
      if (const Value value = run_->evaluate(argument); !value.known() && value.first_cause())
        return unknown_value(value);
    return unknown_value(name, why);
  }

  /// Returns the result of get_inverse_kin as a record of pose and nearby angles, because the robot is not known here.
  Value inverse_kinematics(const Expression& call, const std::vector<Value>& values) {
    Value near = values.size() > 1 ? values[1] : list_value({});
    bool another_tool = values.size() > 4;  // x, qnear, two tolerances, tcp
    for (const Expression& argument : call.items) {
      if (argument.option == "qnear") near = run_->evaluate(argument);
      another_tool |= argument.option == "tcp";
    }
    if (another_tool) return unknown_value("", "is the inverse kinematics of another tool");
    if (values.empty() || !values[0].known()) return values.empty() ? Value{} : unknown_value(values[0]);
    return near.known() ? list_value({values[0], near}, record("inverse")) : unknown_value(near);
  }

  /// Returns the tool's pose at joint angles; std::nullopt: the robot of six axes or its tool is not known.
  std::optional<Value> pose_at(const Value& axes) const {
    const auto angles = joints_in(axes);
    if (!angles || angles->size() != 6 || !tcp_ || !run_->options().flange) return {};
    std::array<double, 6> six;
    std::ranges::copy(*angles, six.begin());
    return pose_value(run_->options().flange(six) * tcp_->frame);
  }

  Value forward_kinematics(const Expression& call, const std::vector<Value>& values) {
    if (call.items.size() > 1) return unknown_value("", "is the forward kinematics of another tool");
    const std::optional<Value> axes = call.items.empty() ? axes_
                                      : values.empty()   ? run_->evaluate(call.items[0])
                                                         : values[0];
    if (const auto pose = axes ? pose_at(*axes) : std::nullopt) return *pose;
    if (axes && axes->known()) return list_value({*axes}, record("forward"));
    if (!axes && standing_) return *standing_;
    return axes ? unknown_value(*axes) : unknown_value("", "asks for the robot's kinematics");
  }

  std::optional<Value> arithmetic(const std::string& name, const std::vector<Value>& values) {
    static const std::map<std::string, double (*)(double)> plain{
        {"sin", [](double x) { return std::sin(x); }},   {"cos", [](double x) { return std::cos(x); }},
        {"tan", [](double x) { return std::tan(x); }},   {"asin", [](double x) { return std::asin(x); }},
        {"acos", [](double x) { return std::acos(x); }}, {"atan", [](double x) { return std::atan(x); }},
        {"sqrt", [](double x) { return std::sqrt(x); }}, {"floor", [](double x) { return std::floor(x); }},
        {"ceil", [](double x) { return std::ceil(x); }}, {"d2r", [](double x) { return x * degree; }},
        {"r2d", [](double x) { return x / degree; }},    {"log10", [](double x) { return std::log10(x); }},
        {"norm", [](double x) { return std::abs(x); }}};
    const auto unknown = std::ranges::find_if(values, [](const Value& v) { return !v.known(); });
    const bool pose_function = begins_with_any(name, {"pose_", "interpolate_pose"}) || name == "inv";
    const auto function = plain.find(name);
    const bool two = name == "atan2" || name == "pow" || name == "log";
    const bool list = name == "norm" || name == "length" || name == "get_list_length" || name == "point_dist";
    const bool turn = name == "rpy2rotvec" || name == "rotvec2rpy";
    if (function == plain.end() && !pose_function && !two && !list && !turn) return {};
    if (unknown != values.end()) return unknown_value(*unknown);
    const auto number = [](double value) { return std::isfinite(value) ? number_value(value) : Value{}; };
    if (function != plain.end() && values.size() == 1 && values[0].is_number())
      return number(function->second(values[0].number));
    if (two && values.size() == 2 && values[0].is_number() && values[1].is_number()) {
      const double a = values[0].number, b = values[1].number;
      return number(name == "pow" ? std::pow(a, b) : name == "log" ? std::log(b) / std::log(a) : std::atan2(a, b));
    }
    if (list && values.size() == 1 && values[0].kind == Value::Kind::list) {
      double squares = 0;
      for (const Value& item : values[0].items) squares += item.number * item.number;
      return number(name == "norm" ? std::sqrt(squares) : static_cast<double>(values[0].items.size()));
    }
    if (turn) return values.size() == 1 ? turn_arithmetic(name, values[0]) : Value{};
    return pose_arithmetic(name, values);
  }

  /// Converts roll, pitch, yaw about the axes of the base to a rotation vector (rpy2rotvec), or back (rotvec2rpy).
  static Value turn_arithmetic(const std::string& name, const Value& value) {
    const auto n = [&](std::size_t i) { return value.items[i].number; };
    if (value.kind != Value::Kind::list || value.items.size() != 3)
      return unknown_value("", "is no list of three angles");
    Vector3 result = rotation_vector(rotation({0, 0, n(2)}) * rotation({0, n(1), 0}) * rotation({n(0), 0, 0}));
    if (name == "rotvec2rpy") {
      const Eigen::Matrix3d r = rotation({n(0), n(1), n(2)}).toRotationMatrix();
      result = {std::atan2(r(2, 1), r(2, 2)), std::atan2(-r(2, 0), std::hypot(r(0, 0), r(1, 0))),
                std::atan2(r(1, 0), r(0, 0))};
    }
    return list_value({number_value(result[0]), number_value(result[1]), number_value(result[2])});
  }

  Value pose_arithmetic(const std::string& name, const std::vector<Value>& values) const {
    const auto a = values.empty() ? std::nullopt : pose_in(values[0]);
    const auto b = values.size() < 2 ? std::nullopt : pose_in(values[1]);
    if (a && (name == "pose_inv" || name == "inv")) return pose_value(inverse(*a));
    if (!a || !b) return unknown_value("", fmt::format("is {} of what is no pose", name));
    if (name == "pose_trans") return pose_value(*a * *b);
    if (name == "pose_add") return pose_value({a->position + b->position, a->orientation * b->orientation});
    if (name == "pose_sub")  // pose_add(b, pose_sub(a, b)) is a
      return pose_value({a->position - b->position, b->orientation.conjugate() * a->orientation});
    if (name == "point_dist") return number_value((a->position - b->position).norm());
    if (name == "interpolate_pose" && values.size() == 3 && values[2].is_number()) {
      const double u = values[2].number;
      return pose_value({(1 - u) * a->position + u * b->position, a->orientation.slerp(u, b->orientation)});
    }
    return unknown_value("", fmt::format("is {}, which is not read", name));
  }

  // ---- moves ------------------------------------------------------------------------------------------------------

  const Expression* argument(const Signature& signature, const Statement& statement, std::string_view name) const {
    std::size_t position = 0;
    for (const Expression& given : statement.arguments) {
      if (given.option == name) return &given;
      if (given.option.empty() && position < signature.arguments.size() && signature.arguments[position++] == name)
        return &given;
    }
    return nullptr;
  }

  /// Returns a number of a move; `otherwise` if it is not given; std::nullopt, with a problem, if it is unknown or negative.
  std::optional<double> number(const Signature& signature, const Statement& statement, const char* name,
                               double otherwise) {
    const Expression* written = argument(signature, statement, name);
    if (!written) return otherwise;
    const Value value = run_->answered(*written);
    if (value.is_number() && value.number >= 0) return value.number;
    if (value.known())
      run_->complain(written->place, fmt::format("has no number from 0 on as {}", name), "correct it");
    else
      run_->ask_for(value, written->place,
                    fmt::format("has a value of {} that is known only while the robot runs", name), "", "a number");
    return {};
  }

  /// Reads a target: joint angles, a pose, or the result of get_inverse_kin or get_forward_kin.
  bool read_target(const Expression& written, Instruction& move, Value& value) {
    value = run_->answered(written);
    run_->add_origin(move, "target", written);
    const Value& pose = is(value, "inverse") ? value.items[0] : value;
    const Value& joints = is(value, "forward") ? value.items[0] : value;
    if (const auto angles = joints_in(joints)) {
      move.target.joints = *angles;
    } else if (const auto frame = pose_in(pose)) {
      move.target.pose = *frame;
      if (is(value, "inverse"))
        if (const auto near = joints_in(value.items[1]); near && near->size() == 6) {
          move.target.configuration.kind = ArmConfiguration::Kind::near;
          for (const double angle : *near)
            move.target.configuration.numbers.push_back(
                static_cast<int>(std::lround(std::clamp(angle, -100.0, 100.0) / degree)));
        }
    } else {
      if (value.known())
        run_->complain(written.place, "moves to what is neither a pose nor a list of joint angles",
                       "correct the target");
      else
        run_->ask_for(value, written.place, "moves to a place that is known only while the robot runs", "",
                      "p[x, y, z, rx, ry, rz] in m and rad, or joint angles [a, b, c, d, e, f] in rad");
      return false;
    }
    return true;
  }

  bool read_speed(const Signature& signature, const Statement& statement, Instruction& move) {
    const auto a = number(signature, statement, "a", signature.acceleration),
               v = number(signature, statement, "v", signature.speed), t = number(signature, statement, "t", 0),
               r = number(signature, statement, "r", 0);
    if (!a || !v || !t || !r) return false;
    const bool joints = signature.kind == Instruction::Kind::joint;
    const double time = std::max(*t, signature.least_time);
    if (time > 0) {
      move.speed.duration = time;
    } else if (*v > 0) {
      (joints ? move.speed.axis : move.speed.tool) = *v;
    } else {
      run_->complain(statement.place, "has a speed of 0", "write a speed above 0");
      return false;
    }
    if (time == 0 && *a > 0) (joints ? move.speed.axis_acceleration : move.speed.tool_acceleration) = *a;
    move.zone.distance = *r;
    if (std::string_view(signature.name).starts_with("servo"))
      move.zone = {0, 100};  // a stream of targets has no stops
    return true;
  }

  bool read_tool(const Statement& statement, Instruction& move) {
    const bool free = move.kind == Instruction::Kind::joint && !move.target.joints.empty() && move.zone.distance == 0;
    if (!tcp_ && free) return true;  // a move of the axes does not need the tool
    if (!tcp_) {
      run_->miss("tcp", statement.place, "moves the tool, and no set_tcp before it says where that is",
                 "write set_tcp(p[...]) before it, or give motion.tools with the name 'tcp'",
                 {{Question::Kind::tool, "tcp", ""}});
      return false;
    }
    const Frame& f = tcp_->frame;
    if (f.position != Vector3::Zero() || !f.orientation.vec().isZero(0))
      move.tool = run_->frame_index(run_->program().tools, *tcp_);
    return true;
  }

  void move(const Signature& signature, const Statement& statement) {
    Instruction move;
    move.kind = signature.kind;
    const Expression* target = argument(signature, statement,
                                        signature.kind == Instruction::Kind::circular ? "pose_to"
                                        : signature.kind == Instruction::Kind::joint  ? "q"
                                                                                      : "pose");
    if (!target) return run_->complain(statement.place, fmt::format("gives {} no target", statement.text), "write it");
    Value value;
    bool whole = read_target(*target, move, value);
    if (signature.kind == Instruction::Kind::circular) whole &= read_via(signature, statement, move);
    whole &= read_speed(signature, statement, move);
    if (whole || move.kind != Instruction::Kind::joint) whole &= read_tool(statement, move);
    standing_.reset(), axes_.reset();  // later moves must not use the old position of the robot
    if (!whole) return;
    if (move.target.joints.empty())
      standing_ = pose_value(move.target.pose);
    else
      axes_ = is(value, "forward") ? value.items[0] : value;
    run_->emit(move, statement);
  }

  bool read_via(const Signature& signature, const Statement& statement, Instruction& move) {
    const Expression* written = argument(signature, statement, "pose_via");
    const Value value = written ? run_->answered(*written) : Value{};
    const auto via = pose_in(value);
    if (written && !value.known()) {
      run_->ask_for(value, written->place, "has a circle through a place that is known only while the robot runs", "",
                    "p[x, y, z, rx, ry, rz] in m and rad");
      return false;
    }
    if (!via || !move.target.joints.empty()) {
      run_->complain(written ? written->place : statement.place, "has a circle that is not given by two poses",
                     "write p[...] for both");
      return false;
    }
    move.via = *via;
    const auto mode = number(signature, statement, "mode", 0);
    if (mode && *mode == 1)
      run_->note(statement.place, "movec with mode=1: the tool turns with the circle; it is turned evenly", true);
    return mode.has_value();
  }

  void sleep(const Statement& statement) {
    const Value time = statement.arguments.empty() ? Value{} : run_->answered(statement.arguments[0]);
    if (!time.known())
      return run_->ask_for(time, statement.place, "waits for a time that is known only while the robot runs", "",
                           "a number, in s");
    if (!time.is_number() || !(time.number >= 0))
      return run_->complain(statement.place, "waits for what is no time", "write seconds from 0 on");
    if (time.number > 0) run_->emit(dwell_of(time.number), statement);
  }

  void set_tcp(const Statement& statement) {
    const Value value = statement.arguments.empty() ? Value{} : run_->answered(statement.arguments[0]);
    const auto frame = pose_in(value);
    if (!frame && value.known())
      return run_->complain(statement.place, "sets a tool by what is no pose", "write p[x, y, z, rx, ry, rz]");
    if (!frame)
      return run_->ask_for(value, statement.place, "sets a tool that is known only while the robot runs", "",
                           "p[x, y, z, rx, ry, rz] in m and rad");
    tcp_ = NamedFrame{"tcp", *frame};
    standing_.reset();  // the pose belongs to the previous tool
  }

  /// call: "run NAME"
  void run_thread(const std::string& call, const Place& place) {
    constexpr int deepest = 8;  // largest depth of calls
    const Routine* const thread = code_.find(call.substr(std::string_view("run ").size()), -1);
    const auto steers = [&](const Statement& s) { return s.kind == Statement::Kind::instruction && matters(s.name); };
    const std::string name = thread ? thread->written : call;
    run_->note(place,
               fmt::format("thread {}: runs beside the program, and is left out; motion.routine: {} reads it alone",
                           name, name),
               !thread || code_.reaches(thread->body, thread->module, deepest, steers));
  }

  const Code& code_;
  std::optional<NamedFrame> tcp_;
  std::optional<Value> standing_, axes_;  // target of the last move: pose, or joint angles
};

/// Returns the first parse error; null: none.
const Problem* first_problem(const Code& code) {
  if (!code.problems.empty()) return &code.problems[0];
  for (const Routine& routine : code.routines)
    if (!routine.problems.empty()) return &routine.problems[0];
  return nullptr;
}

/// Returns whether a function is defined within another one. PolyScope writes one function around all others.
bool is_within_another(const Routine& routine, const Code& code) {
  return std::ranges::any_of(code.routines, [&](const Routine& other) {
    return other.place.file == routine.place.file && !other.name.starts_with("script:") &&
           other.place.line < routine.place.line && other.last_line >= routine.last_line;
  });
}

void take_calls(const std::vector<Statement>& body, std::set<std::string>& names) {
  const std::function<void(const Expression&)> in = [&](const Expression& e) {
    if (e.kind == Expression::Kind::call) names.insert(e.text);
    for (const Expression& item : e.items) in(item);
  };
  for (const Statement& s : body) {
    if (s.kind == Statement::Kind::instruction) names.insert(s.name);
    for (const Expression& e : s.arguments) in(e);
    for (const Branch& branch : s.branches) {
      for (const Expression& e : branch.conditions) in(e);
      take_calls(branch.body, names);
    }
  }
}

}  // namespace

void run_urscript(const Code& code, const ImportOptions& options, const std::vector<NamedFrame>& tools,
                  const std::vector<NamedFrame>&, Program& program, Problems& problems) {
  std::set<std::string> called;
  for (const Routine& routine : code.routines) take_calls(routine.body, called);
  // The statements outside functions run first, then the only function that they do not call.
  const Routine *script = nullptr, *function = nullptr;
  std::string names;
  int uncalled = 0;
  for (const Routine& routine : code.routines) {
    if (routine.name.starts_with("script:")) {
      if (routine.place.file == 0) script = &routine;
      continue;
    }
    if (names.size() < 1000) names += (names.empty() ? "" : ", ") + routine.written;
    if (code.start.empty() ? routine.robot != "thread" && routine.place.file == 0 && !called.contains(routine.name) &&
                                 !is_within_another(routine, code)
                           : routine.name == code.start) {
      function = &routine;
      ++uncalled;
    }
  }
  std::set<std::string> script_calls;
  if (script) take_calls(script->body, script_calls);
  const bool runs_itself = !script_calls.empty() && code.start.empty();
  if (runs_itself) function = nullptr;
  if (!runs_itself && uncalled == 0 && code.start.empty())
    if (const Problem* why = first_problem(code)) return problems.add(why->where, why->what, why->remedy);
  if (!runs_itself && (uncalled == 0 || (uncalled > 1 && code.start.empty()))) {
    const char* what = uncalled > 1 ? "holds several functions, and none that calls them" : "holds no program";
    problems.add({code.files[0].name(), 1, 1},
                 options.routine.empty() ? std::string(what) : fmt::format("has no function '{}'", options.routine),
                 names.empty() ? "give a script with moves" : fmt::format("name one in motion.routine: {}", names));
    return;
  }
  const Routine* routine = function ? function : script;
  Routine both;
  if (function && script) {
    both = *function;
    both.body.insert(both.body.begin(), script->body.begin(), script->body.end());
    both.problems.insert(both.problems.begin(), script->problems.begin(), script->problems.end());
    routine = &both;
  }
  explore(
      [&](Exploration& exploration, Program& made, Problems& found) {
        Script rules(code, tools);
        Interpreter(code, rules, options, made, found, exploration).run(*routine);
      },
      program, problems);
}

}  // namespace dresslife::sim
