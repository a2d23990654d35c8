#include "sim/program/krl.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "sim/program/tokens.h"

namespace dresslife::sim {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double millimetre = 1e-3;

constexpr const char* axis_names[] = {"a1", "a2", "a3", "a4", "a5", "a6"};
constexpr const char* frame_names[] = {"x", "y", "z", "a", "b", "c"};
constexpr const char* harmless_names[] = {"wait",   "halt",    "interrupt", "trigger",   "pulse",   "signal",
                                          "ext",    "extfct",  "extp",      "extfctp",   "import",  "enum",
                                          "struc",  "channel", "anin",      "anout",     "brake",   "resume",
                                          "cwrite", "cread",   "gripper",   "err_raise", "eb_test", "sync"};

/// Axes of the target, or the position and angles of its frame, of which a program may give some only.
struct Coordinates {
  std::array<double, 6> numbers{};
  std::array<bool, 6> given{};
  bool any() const {
    return std::any_of(given.begin(), given.end(), [](bool g) { return g; });
  }
};

/// Absent: one of them is unknown.
std::optional<Coordinates> coordinates(const Value& record, const char* const (&names)[6]) {
  Coordinates read;
  for (int i = 0; i < 6; ++i) {
    const Value* part = record.field(names[i]);
    if (!part || part->kind == Value::Kind::unknown) continue;
    if (!part->is_number()) return {};
    read.numbers[i] = part->number;
    read.given[i] = true;
  }
  return read;
}

Frame frame_from(const std::array<double, 6>& n) {
  return {
      millimetre * Vector3(n[0], n[1], n[2]),
      rotation({0, 0, n[3] * degree}) * rotation({0, n[4] * degree, 0}) * rotation({n[5] * degree, 0, 0})};
}

std::array<double, 6> numbers_of(const Frame& frame) {
  const Matrix3 r = frame.orientation.toRotationMatrix();
  const double b = std::atan2(-r(2, 0), std::hypot(r(0, 0), r(1, 0)));
  const bool pole = std::abs(std::cos(b)) < 1e-9;
  const double a = pole ? std::atan2(-r(0, 1), r(1, 1)) : std::atan2(r(1, 0), r(0, 0));
  const double c = pole ? 0 : std::atan2(r(2, 1), r(2, 2));
  const Vector3 p = frame.position / millimetre;
  return {p.x(), p.y(), p.z(), a / degree, b / degree, c / degree};
}

class Krl final : public Dialect {
 public:
  Krl(const std::vector<NamedFrame>& tools, const std::vector<NamedFrame>& work_objects)
      : tools_(tools), work_objects_(work_objects) {
    frame_type_ = {"frame", {frame_names, frame_names + 6}, std::vector<const RecordType*>(6, nullptr)};
    axis_type_ = {"axis", {axis_names, axis_names + 6}, std::vector<const RecordType*>(6, nullptr)};
  }

  std::optional<Value> constant(const std::string& name) override {
    if (name.starts_with("#")) return text_value(name);
    if (name == "$nullframe" || name == "$world" || name == "$robroot") return frame_value(Frame{});
    if (name == "xhome") return record({0, -90, 90, 0, 0, 0}, &axis_type_);
    if (name == "$pos_act") return last_pose_ ? std::optional(frame_value(*last_pose_)) : Value{};
    return {};
  }
  std::optional<Value> function(const Expression& call, Interpreter& run) override;
  bool instruction(const Statement& statement, Interpreter& run) override;
  bool matters(const std::string& name) const override {
    return kind_of(name).has_value() || name == "wait_sec" || name == "bas";
  }
  bool harmless(const std::string& name) const override {
    return std::find(std::begin(harmless_names), std::end(harmless_names), name) != std::end(harmless_names);
  }
  const RecordType* type_of(const std::string&) const override { return nullptr; }
  Value initial(const std::string&) const override { return {}; }

  /// Indices of the instructions that are SPL points of spline blocks.
  const std::set<std::size_t>& spline_points() const { return spline_points_; }

 private:
  static std::optional<Instruction::Kind> kind_of(const std::string& name) {
    std::string plain = name.starts_with("s") ? name.substr(1) : name;
    if (plain.ends_with("_rel")) plain.resize(plain.size() - 4);
    if (plain == "ptp") return Instruction::Kind::joint;
    if (plain == "lin" || plain == "pl") return Instruction::Kind::linear;
    if (plain == "circ") return Instruction::Kind::circular;
    return {};
  }

  Value record(const std::array<double, 6>& numbers, const RecordType* type) const {
    std::vector<Value> items;
    for (double number : numbers) items.push_back(number_value(number));
    return list_value(std::move(items), type);
  }
  Value frame_value(const Frame& frame) const { return record(numbers_of(frame), &frame_type_); }

  bool move(Instruction::Kind kind, const Statement& statement, Interpreter& run);
  static bool has(const Statement& statement, const char* word) {
    return (" " + statement.text + " ").find(fmt::format(" {} ", word)) != std::string::npos;
  }
  bool read_target(const Expression& written, bool relative, Instruction& move, Interpreter& run);
  bool read_frames(const Statement& statement, Instruction& move, Interpreter& run);
  bool read_speed(const Statement& statement, Instruction& move, Interpreter& run);
  void read_zone(const Statement& statement, Instruction& move, Interpreter& run);
  void basics(const Statement& statement, Interpreter& run);
  void parameters(bool joint, std::optional<double> speed, Interpreter& run);
  std::optional<double> setting(const std::string& name, Interpreter& run) const;
  Value numbered(const char* list, double number, Interpreter& run);
  std::optional<Frame> current(const char* variable, const std::vector<NamedFrame>& given, std::string& name,
                               const Statement& statement, Interpreter& run);

  const std::vector<NamedFrame>& tools_;
  const std::vector<NamedFrame>& work_objects_;
  RecordType frame_type_, axis_type_;
  std::array<double, 6> last_axes_{}, last_numbers_{};
  bool has_axes_ = false;
  std::optional<Frame> last_pose_;
  std::string tool_name_ = "$TOOL", base_name_ = "$BASE";
  std::set<std::size_t> spline_points_;
};

/// A number that a variable or an assigned part of one holds.
std::optional<double> Krl::setting(const std::string& name, Interpreter& run) const {
  const Value* value = run.variable(name);
  return value && value->is_number() ? std::optional(value->number) : std::nullopt;
}

bool Krl::read_target(const Expression& written, bool relative, Instruction& move, Interpreter& run) {
  const Value value = run.evaluate(written);
  const auto axes = value.kind == Value::Kind::list ? coordinates(value, axis_names) : std::nullopt;
  const auto frame = value.kind == Value::Kind::list ? coordinates(value, frame_names) : std::nullopt;
  const bool joint = axes && axes->any();
  if (!joint && !(frame && frame->any())) {
    const bool named = written.kind == Expression::Kind::name;
    run.complain(written.place,
                 named ? fmt::format("moves to '{}', which no file read declares", written.text)
                       : "moves to a place that is known only while the robot runs",
                 "give the .dat file that declares it, or write the target as a constant");
    return false;
  }
  const Coordinates& read = joint ? *axes : *frame;
  std::array<double, 6>& numbers = joint ? last_axes_ : last_numbers_;
  const bool whole = std::all_of(read.given.begin(), read.given.end(), [](bool g) { return g; });
  if ((!whole || relative) && (joint ? !has_axes_ : !last_pose_)) {
    run.complain(written.place, "gives some coordinates only (the others of the place before are not known)",
                 "write all six");
    return false;
  }
  for (int i = 0; i < 6; ++i)
    if (read.given[i]) numbers[i] = read.numbers[i] + (relative ? numbers[i] : 0);
  if (joint) {
    for (double number : numbers) move.target.joints.push_back(number * degree);
    has_axes_ = true;
    last_pose_.reset();
  } else {
    move.target.pose = frame_from(numbers);
    last_pose_ = move.target.pose;
    has_axes_ = false;
    const Value *status = value.field("s"), *turn = value.field("t");
    if (move.kind == Instruction::Kind::joint && status && turn && status->is_number() && turn->is_number())
      move.target.configuration = {ArmConfiguration::Kind::kuka,
                                   {static_cast<int>(std::clamp(status->number, 0.0, 63.0)),
                                    static_cast<int>(std::clamp(turn->number, 0.0, 63.0))}};
  }
  for (const char* name : {"e1", "e2", "e3", "e4", "e5", "e6"})
    if (const Value* axis = value.field(name); axis && axis->is_number())
      move.target.external_axes.push_back(axis->number);
  return true;
}

/// Contents of $TOOL or $BASE; the null frame before anything is assigned, as after a start of the
/// controller.
std::optional<Frame> Krl::current(const char* variable, const std::vector<NamedFrame>& given,
                                  std::string& name, const Statement& statement, Interpreter& run) {
  const Value* value = run.variable(variable);
  if (!value) return Frame{};
  const auto read = value->kind == Value::Kind::list ? coordinates(*value, frame_names) : std::nullopt;
  if (read && std::all_of(read->given.begin(), read->given.end(), [](bool g) { return g; }))
    return frame_from(read->numbers);
  if (value->kind == Value::Kind::text) {  // the name of one that the files do not hold
    name = value->text;
    for (const NamedFrame& frame : given)
      if (lower_case(frame.name) == lower_case(name)) return frame.frame;
    run.complain(statement.place, fmt::format("moves with {}, which no file read declares", name),
                 fmt::format("give the file that declares it ($config.dat), or motion.{} with the name '{}'",
                             std::string(variable) == "$tool" ? "tools" : "work_objects", name));
    return {};
  }
  run.complain(statement.place,
               fmt::format("moves with {} that is known only while the robot runs", variable),
               "assign a constant frame");
  return {};
}

bool Krl::read_frames(const Statement& statement, Instruction& move, Interpreter& run) {
  tool_name_ = "$TOOL", base_name_ = "$BASE";
  const auto tool = current("$tool", tools_, tool_name_, statement, run);
  const auto base = current("$base", work_objects_, base_name_, statement, run);
  if (!tool || !base) return false;
  const Value* mode = run.variable("$ipo_mode");
  const bool stationary = mode && mode->kind == Value::Kind::text && mode->text == "#tcp";
  const auto trivial = [](const Frame& f) { return f.position.isZero(0) && f.orientation.vec().isZero(0); };
  // #TCP: the tool stands in $BASE, the work is held at $TOOL.
  const Frame& tool_frame = stationary ? *base : *tool;
  const Frame& object_frame = stationary ? *tool : *base;
  if (stationary || !trivial(tool_frame))
    move.tool =
        run.frame_index(run.program().tools, {stationary ? base_name_ : tool_name_, tool_frame, stationary});
  if (stationary || !trivial(object_frame))
    move.work_object = run.frame_index(run.program().work_objects,
                                       {stationary ? tool_name_ : base_name_, object_frame, stationary});
  return true;
}

bool Krl::read_speed(const Statement& statement, Instruction& move, Interpreter& run) {
  const auto above_zero = [&](const std::string& name) -> std::optional<double> {
    const Value* value = run.variable(name);
    if (!value) return {};
    if (value->is_number() && value->number > 0) return value->number;
    run.complain(statement.place, fmt::format("moves with {} that is not a known number above 0", name),
                 "assign a constant");
    return {};
  };
  if (move.kind == Instruction::Kind::joint) {
    double speed = 100, acceleration = 100;
    for (int axis = 1; axis <= 6; ++axis) {  // the slowest counts: axes move together
      if (const auto percent = above_zero(fmt::format("$vel_axis[{}]", axis)))
        speed = std::min(speed, *percent);
      if (const auto percent = above_zero(fmt::format("$acc_axis[{}]", axis)))
        acceleration = std::min(acceleration, *percent);
    }
    move.speed.axis_percent = speed;
    move.acceleration_percent = std::max(1.0, acceleration);
    return true;
  }
  move.speed.tool = above_zero("$vel.cp");
  if (const auto turn = above_zero("$vel.ori1")) move.speed.orientation = *turn * degree;
  if (move.speed.tool) return true;
  if (!run.variable("$vel.cp"))
    run.complain(statement.place,
                 "moves along a path before $VEL.CP is assigned (its value lies in the controller)",
                 "assign $VEL.CP in m/s");
  return false;
}

void Krl::read_zone(const Statement& statement, Instruction& move, Interpreter& run) {
  const auto has = [&](const char* word) { return Krl::has(statement, word); };
  if (has("in_spline") && !has("last")) {
    move.zone.percent = 100;  // a spline does not stop between its points
    return;
  }
  if (has("c_dis") || has("c_ori") || has("c_spl")) {
    move.zone.distance = std::max(0.0, setting("$apo.cdis", run).value_or(0)) * millimetre;
    if (move.zone.distance == 0)
      run.note(statement.place, "approximates without $APO.CDIS: the robot stops at the target");
  } else if (has("c_ptp")) {
    move.zone.percent = std::clamp(setting("$apo.cptp", run).value_or(0), 0.0, 100.0);
  } else if (has("c_vel")) {
    move.zone.percent = std::clamp(setting("$apo.cvel", run).value_or(100), 0.0, 100.0);
  }
}

bool Krl::move(Instruction::Kind kind, const Statement& statement, Interpreter& run) {
  std::vector<std::pair<std::string, std::optional<Value>>> before;  // WITH counts for this move only
  for (const Branch& settings : statement.branches)
    for (const Statement& s : settings.body) {
      const Expression& target = s.arguments[0];
      const std::string path = run.path_of(target);
      if (!path.empty()) {
        const Value* old = run.variable(path);
        before.emplace_back(path, old ? std::optional(*old) : std::nullopt);
      }
      run.assign(target, run.evaluate(s.arguments[1]));
    }
  Instruction move;
  move.kind = kind;
  const bool relative = statement.name.ends_with("_rel");
  const Expression* target = nullptr;
  const Expression* via = nullptr;
  for (const Expression& argument : statement.arguments) {
    if (argument.option == "ca") {
      run.complain(argument.place, "CIRC with CA ends elsewhere than at its target",
                   "write the end of the arc as the target, without CA");
    } else {
      via = target;
      target = &argument;
    }
  }
  bool whole = target != nullptr;
  if (kind == Instruction::Kind::circular && !via) {
    run.complain(statement.place, "CIRC needs a point on the way and a target", "write both");
    whole = false;
  }
  if (whole && via && kind == Instruction::Kind::circular) {
    Instruction way = move;
    whole &= read_target(*via, relative, way, run);
    if (whole && !way.target.joints.empty()) {
      run.complain(via->place, "CIRC goes by axis angles", "write a frame");
      whole = false;
    }
    move.via = way.target.pose;
  }
  whole = whole && read_target(*target, relative, move, run);
  whole = whole && read_frames(statement, move, run) && read_speed(statement, move, run);
  if (whole) {
    read_zone(statement, move, run);
    if (statement.name.starts_with("spl") && has(statement, "in_spline"))
      spline_points_.insert(run.program().instructions.size());
    run.emit(move, statement);
  }
  for (auto& [path, value] : before) value ? run.set(path, *value) : run.forget(path);
  return true;
}

// ---- BAS and the forms that the controller's editor writes
// ---------------------------------------------------

/// TOOL_DATA[n] or BASE_DATA[n]; its name where no file holds it.
Value Krl::numbered(const char* list, double number, Interpreter& run) {
  if (number == 0) return frame_value(Frame{});
  Expression element, name, index;
  name.kind = Expression::Kind::name;
  name.text = lower_case(list);
  index.kind = Expression::Kind::number;
  index.number = std::clamp(number, 0.0, 1e6);
  element.kind = Expression::Kind::element;
  element.items = {name, index};
  const Value known = run.evaluate(element);
  if (known.kind != Value::Kind::unknown) return known;
  return text_value(fmt::format("{}[{}]", list, static_cast<long>(index.number)));
}

/// BAS(#PTP_PARAMS, v), BAS(#CP_PARAMS, v): what PDAT_ACT or LDAT_ACT and FDAT_ACT hold, at the speed v.
void Krl::parameters(bool joint, std::optional<double> speed, Interpreter& run) {
  const char* data = joint ? "pdat_act" : "ldat_act";
  if (joint) {
    for (int axis = 1; axis <= 6; ++axis) {
      if (speed) run.set(fmt::format("$vel_axis[{}]", axis), number_value(*speed));
      if (const auto acc = setting(fmt::format("{}.acc", data), run))
        run.set(fmt::format("$acc_axis[{}]", axis), number_value(*acc));
    }
  } else if (speed) {
    run.set("$vel.cp", number_value(*speed));
  }
  if (const auto distance = setting(fmt::format("{}.apo_dist", data), run)) {
    run.set("$apo.cdis", number_value(*distance));
    run.set("$apo.cptp", number_value(*distance));
  }
}

void Krl::basics(const Statement& statement, Interpreter& run) {
  if (statement.arguments.empty()) return;
  const Value what = run.evaluate(statement.arguments[0]);
  std::optional<double> number;
  if (statement.arguments.size() > 1) number = run.number(statement.arguments[1]);
  const auto axes = [&](const char* name) {
    for (int axis = 1; axis <= 6 && number; ++axis)
      run.set(fmt::format("{}[{}]", name, axis), number_value(*number));
  };
  const auto frames = [&](const char* variable, const char* list, double index) {
    run.set(variable, numbered(list, index, run));
  };
  if (what.text == "#vel_ptp")
    axes("$vel_axis");
  else if (what.text == "#acc_ptp")
    axes("$acc_axis");
  else if (what.text == "#vel_cp" && number)
    run.set("$vel.cp", number_value(*number));
  else if (what.text == "#acc_cp" && number)
    run.set("$acc.cp", number_value(*number));
  else if (what.text == "#tool" && number)
    frames("$tool", "TOOL_DATA", *number);
  else if (what.text == "#base" && number)
    frames("$base", "BASE_DATA", *number);
  else if (what.text == "#ptp_params" || what.text == "#cp_params")
    parameters(what.text == "#ptp_params", number, run);
  if (what.text == "#ptp_params" || what.text == "#cp_params" || what.text == "#frames") {
    if (const auto tool = setting("fdat_act.tool_no", run)) frames("$tool", "TOOL_DATA", *tool);
    if (const auto base = setting("fdat_act.base_no", run)) frames("$base", "BASE_DATA", *base);
  }
}

bool Krl::instruction(const Statement& statement, Interpreter& run) {
  if (const auto kind = kind_of(statement.name)) return move(*kind, statement, run);
  if (statement.name == "bas") {
    basics(statement, run);
    return true;
  }
  if (statement.name != "wait_sec") return false;
  const auto time = run.number(statement.arguments[0]);
  if (!time || !(*time >= 0)) {
    run.complain(statement.place, "waits for a time that is known only while the robot runs",
                 "write it as a constant");
  } else if (*time > 0) {
    Instruction wait;
    wait.kind = Instruction::Kind::dwell;
    wait.dwell = *time;
    run.emit(wait, statement);
  }
  return true;
}

std::optional<Value> Krl::function(const Expression& call, Interpreter& run) {
  std::vector<Value> values;
  for (const Expression& argument : call.items) values.push_back(run.evaluate(argument));
  const auto part = [&](const char* field) {
    const Value* value = values.empty() ? nullptr : values[0].field(field);
    return value ? *value : Value{};
  };
  if (call.text == ":" && values.size() == 2) {  // the second frame, given in the first
    std::array<Frame, 2> frames;
    for (int i = 0; i < 2; ++i) {
      const auto read = coordinates(values[i], frame_names);
      if (!read || !read->any()) return Value{};
      frames[i] = frame_from(read->numbers);
    }
    return frame_value(frames[0] * frames[1]);
  }
  const double x = values.size() == 1 && values[0].is_number() ? values[0].number : NAN;
  const auto finite = [](double y) { return std::isfinite(y) ? number_value(y) : Value{}; };
  if (call.text == "abs") return finite(std::abs(x));
  if (call.text == "sqrt") return finite(std::sqrt(x));
  if (call.text == "sin") return finite(std::sin(x * degree));
  if (call.text == "cos") return finite(std::cos(x * degree));
  if (call.text == "tan") return finite(std::tan(x * degree));
  if (call.text == "acos") return finite(std::acos(x) / degree);
  if (call.text == "atan2" && values.size() == 2 && values[0].is_number() && values[1].is_number())
    return finite(std::atan2(values[0].number, values[1].number) / degree);
  // What the editor writes behind WITH.
  if (call.text == "svel_joint" || call.text == "svel_cp") return values.empty() ? Value{} : values[0];
  if (call.text == "sacc_joint" || call.text == "sacc_cp") return part("acc");
  if (call.text == "sapo" || call.text == "sapo_ptp") return part("apo_dist");
  const auto frame = [&](const char* list, const Value& number) {
    return number.is_number() ? numbered(list, number.number, run) : Value{};
  };
  if (call.text == "stool2") return frame("TOOL_DATA", part("tool_no"));
  if (call.text == "sbase") return frame("BASE_DATA", values.empty() ? Value{} : values[0]);
  if (call.text == "sipo_mode") return part("ipo_frame");
  return {};
}

// ---- spline blocks
// ---------------------------------------------------

constexpr double spline_step = 0.02;  // between points that stand for the curve [m]
constexpr int most_steps = 50;        // from one SPL point to the next

/// Unit slope at point k of the curve through the points, of the parabola through three of them over the
/// length of the chords.
Vector3 slope_at(const std::vector<Frame>& points, std::size_t k) {
  const auto chord = [&](std::size_t i) { return Vector3(points[i + 1].position - points[i].position); };
  const auto along = [&](std::size_t i) { return Vector3(chord(i) / std::max(chord(i).norm(), 1e-12)); };
  if (points.size() < 3) return along(0);
  const auto mirrored = [](const Vector3& slope, const Vector3& across) {
    return Vector3(2 * across.dot(slope) * across - slope);
  };
  if (k == 0) return mirrored(slope_at(points, 1), along(0));
  if (k + 1 == points.size()) return mirrored(slope_at(points, k - 1), along(k - 1));
  const double before = chord(k - 1).norm(), behind = chord(k).norm();
  return (behind * along(k - 1) + before * along(k)).normalized();
}

/// KUKA does not tell its splines' law; here: cubics between the points, smooth where they meet. Each becomes
/// lines.
void bend_splines(const std::set<std::size_t>& spline_points, Program& program) {
  std::vector<Instruction> bent;
  for (std::size_t i = 0; i < program.instructions.size(); ++i) {
    std::size_t end = i;
    while (spline_points.contains(end)) ++end;
    std::vector<Frame> points;  // from the one before the first SPL on
    if (end > i && i > 0 && program.instructions[i - 1].target.joints.empty()) {
      for (std::size_t k = i - 1; k < end; ++k) points.push_back(program.instructions[k].target.pose);
      for (std::size_t k = 0; k + 1 < points.size(); ++k) {
        const Frame &from = points[k], &to = points[k + 1];
        const double length = (to.position - from.position).norm();
        const int steps =
            points.size() < 3 ? 1 : std::clamp(static_cast<int>(length / spline_step), 1, most_steps);
        const Vector3 begin = length * slope_at(points, k), finish = length * slope_at(points, k + 1);
        for (int step = 1; step <= steps; ++step) {
          const double u = static_cast<double>(step) / steps, v = 1 - u;
          Instruction part = program.instructions[i + k];
          if (step < steps) {
            part.zone = {0, 100};
            part.target.pose = {v * v * (1 + 2 * u) * from.position + u * u * (1 + 2 * v) * to.position +
                                    u * v * (v * begin - u * finish),
                                from.orientation.slerp(u, to.orientation)};
          }
          bent.push_back(std::move(part));
        }
      }
      i = end - 1;
      continue;
    }
    bent.push_back(program.instructions[i]);
  }
  program.instructions = std::move(bent);
}

}  // namespace

void run_krl(const Code& code, const ImportOptions& options, const std::vector<NamedFrame>& tools,
             const std::vector<NamedFrame>& work_objects, Program& program, Problems& problems) {
  const Routine* routine = nullptr;
  if (!options.routine.empty())
    routine = code.find(code.start, -1);
  else if (!code.routines.empty())
    routine = &code.routines[0];
  if (!routine) {
    std::vector<std::string> names;
    for (const Routine& other : code.routines)
      if (names.size() < 40) names.push_back(other.written);
    problems.add(
        {code.files.empty() ? "" : code.files[0].name(), 1, 1},
        options.routine.empty() ? std::string("holds no DEF")
                                : fmt::format("has no routine '{}'", options.routine),
        names.empty() ? "give the .src file too" : fmt::format("name one of: {}", fmt::join(names, ", ")));
    return;
  }
  Krl krl(tools, work_objects);
  Interpreter(code, krl, options, program, problems).run(*routine);
  bend_splines(krl.spline_points(), program);
  // KUKA writes zeros for axes that are not there.
  const auto at_zero = [](double e) { return e == 0; };
  const auto unused = [&](const Instruction& i) {
    return std::all_of(i.target.external_axes.begin(), i.target.external_axes.end(), at_zero);
  };
  if (std::all_of(program.instructions.begin(), program.instructions.end(), unused))
    for (Instruction& instruction : program.instructions) instruction.target.external_axes.clear();
}

}  // namespace dresslife::sim
