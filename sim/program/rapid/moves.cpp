// RAPID's moves: target, speed, zone, tool, work object, and displacements.
#include <algorithm>
#include <map>

#include "pipeline/base/constants.h"
#include "pipeline/settings/fields.h"
#include "sim/program/interpreter/job_words.h"
#include "sim/program/interpreter/tokens.h"
#include "sim/program/rapid/dialect.h"
#include "sim/program/rapid/functions.h"
#include "sim/program/rapid/types.h"

namespace dresslife::sim {
namespace {

constexpr double no_axis = 9e8;  // larger values (9E9) mean: no such axis

/// Returns the remedy for an undeclared name in the style of predefined data (v15000, z500); empty: another name.
std::string predefined(const std::string& type, const std::string& name) {
  const bool speed = type == "speeddata";
  if ((!speed && type != "zonedata") || name.size() < 2 || name[0] != (speed ? 'v' : 'z') ||
      name.find_first_not_of("0123456789", 1) != name.npos)
    return "";
  return speed ? "write one of RAPID's own speeds, v5 .. v7000 and vmax, or "
               : "write one of RAPID's own zones, z0 .. z200 and fine, or ";
}

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

/// Switches of the moves of RobotWare and of its options for welding, gluing and spot welding.
const std::vector<std::string_view> move_switches = pipeline::words_in(
    "Conc ID V T Z Inpos WObj Corr TLoad NoEOffs T1 T2 T3 T4 T5 T6 T7 T8 TriggData1 TriggData2 TriggData3 Stop "
    "PStop SStop Sup Flanks PosFlank NegFlank HighLevel LowLevel Value DValue NoCorr Weave SeamName Track AdvData "
    "PreProcessTracking Time NoProcess On Off D NoConc Retract OpenHLift CloseHLift QuickRelease G1 G2 G3 G4 Gun "
    "Gun1 Gun2 Gun3 Gun4 TrackLock");

/// Returns the largest number of arguments without a name of a move; -1: any number.
int most_arguments(const Signature& signature) {
  const std::string name = signature.name;
  if (signature.tool < 0) return -1;
  const bool value = name.starts_with("move") && (name.ends_with("do") || name.ends_with("ao"));  // signal and value
  const bool one = name.starts_with("move") && (name.ends_with("go") || name.ends_with("sync"));
  return signature.tool + 1 + (value ? 2 : one ? 1 : 0);
}

bool is_weld(const std::string& name) { return name.starts_with("arc") && !name.starts_with("arcmove"); }

bool is_frame(std::string_view type) { return type == "tooldata" || type == "wobjdata"; }

std::vector<double> external_of(const Value& extax, const std::vector<double>& shift) {
  std::vector<double> axes;
  for (std::size_t i = 0; i < extax.items.size(); ++i)
    if (const double axis = extax.items[i].number; std::abs(axis) < no_axis)
      axes.push_back(axis + (i < shift.size() ? shift[i] : 0));
  return axes;
}

}  // namespace

/// Gives a warning of each switch that an instruction or function does not have, and of arguments after the last one.
/// most: its number of arguments without a name; -1: any number.
void Rapid::check_arguments(const std::string& of, const std::vector<Expression>& arguments, int most,
                            const std::vector<std::string_view>& switches) {
  std::vector<std::string> known;
  for (const std::string_view name : switches) known.push_back("\\" + std::string(name));
  int count = 0;
  for (const Expression& argument : arguments) {
    const auto same = [&](std::string_view name) { return argument.option == lower_case(name); };
    if (argument.option.empty() && ++count > most && most >= 0)
      run_->unread(argument.place, run_->written(argument), fmt::format("{} after its argument {}", of, most), {});
    else if (!argument.option.empty() && std::ranges::none_of(switches, same))
      run_->unread(argument.place, "\\" + argument.option, of, known);
  }
}

std::string Rapid::move_meant(const Statement& statement) const {
  constexpr std::ptrdiff_t fewest = 4;  // target, speed, zone, tool
  const auto given =
      std::ranges::count_if(statement.arguments, [](const Expression& argument) { return argument.option.empty(); });
  if (given < fewest || !statement.name.starts_with("mov")) return "";
  static const std::map<std::string, std::string> moves{
      {"moveabsj", "MoveAbsJ"}, {"movej", "MoveJ"}, {"movel", "MoveL"}, {"movec", "MoveC"}};
  std::vector<std::string> names;
  for (const auto& [name, written] : moves) names.push_back(name);
  const std::string nearest = pipeline::nearest_word(statement.name, names);
  return nearest.empty() ? "" : moves.at(nearest);
}

const Signature* rapid_move(const std::string& instruction) {
  for (const Signature& signature : signatures)
    if (instruction == signature.name) return &signature;
  return nullptr;
}

std::optional<Value> Rapid::typed(const Expression& written, const char* type, const char* what) {
  const std::size_t problems = run_->problem_count();
  Value value = run_->answered(written);
  if (!value.known() && run_->problem_count() != problems) return {};  // the cause is reported already
  if (!value.known()) {
    const std::vector<const Cause*> causes = value.causes();
    const std::string name = causes.size() == 1 && causes[0]->line.empty() ? causes[0]->asked() : "";
    if (is_frame(type) && !name.empty() && name.find(':') == std::string::npos && !run_->variable(name)) {
      const auto kind = type == std::string("tooldata") ? Question::Kind::tool : Question::Kind::work_object;
      run_->miss(name, written.place, fmt::format("names {} '{}' that no module read declares", what, name),
                 "give the module that declares it too (motion.modules: [{file: FILE}]), or its frame in "
                 "motion.tools or motion.work_objects",
                 {{kind, name, ""}});
    } else if (written.kind == Expression::Kind::name && !run_->variable(written.text)) {
      run_->miss(written.text, written.place,
                 fmt::format("names {} '{}' that no module read declares", what, written.text),
                 predefined(type, written.text) + fmt::format("give the module that declares it too ({}), or {}",
                                                              modules_of_job, run_->remedy_for(value)),
                 run_->questions_for(value, form_of(type)));
    } else {
      // The form of another name that the argument depends on differs from the argument's form.
      const bool itself =
          name == run_->answer_name(run_->path_of(written)) || name == run_->name_here(run_->written(written));
      run_->ask_for(value, written.place, fmt::format("has {} that is known only while the robot runs", what), "",
                    itself ? form_of(type) : "");
    }
    return {};
  }
  const RecordType* record = code_.record(type);
  if (value.type == record || (!value.type && value.kind == Value::Kind::list && run_->shape(value, record)))
    return value;
  run_->complain(written.place, fmt::format("has no {} where {} is expected", type, what), "correct the argument");
  return {};
}

std::optional<Quaternion> Rapid::checked(const Value& orient, const char* what, const Expression& written) {
  if (const auto q = rapid_orientation(orient)) return q;
  const Quaternion q = rapid_quaternion(orient);
  if (!(q.norm() > 0)) return {};
  const Quaternion unit = q.normalized();
  const Place declared = run_->origin(written);
  const std::string name = run_->name_of(written);
  run_->miss(
      "quaternion of " + (name.empty() ? run_->short_place(written.place) : name), written.place,
      fmt::format("has {}{} whose quaternion [{:.6g},{:.6g},{:.6g},{:.6g}] has the length {:.5g} (must be 1){}", what,
                  name.empty() ? "" : fmt::format(" '{}'", name), q.w(), q.x(), q.y(), q.z(), q.norm(),
                  declared.line > 0 ? fmt::format(" in {}", run_->short_place(declared)) : ""),
      fmt::format("write [{:.6f},{:.6f},{:.6f},{:.6f}] for the same direction, or correct the number that is mistyped",
                  unit.w(), unit.x(), unit.y(), unit.z()));
  return unit;
}

bool Rapid::read_target(const Expression& written, bool joints, Instruction& move) {
  const auto value = typed(written, joints ? "jointtarget" : "robtarget", "a target");
  if (!value) {
    reached_.reset();
    lost_ = unknown_value(run_->evaluate(written));
    lost_by_joints_ = joints;
    return false;
  }
  run_->add_origin(move, "target", written);
  reached_ = Reached{*value, joints, displacement_, {}, {}};
  if (joints) {
    for (const Value& axis : value->items[0].items)
      if (std::abs(axis.number) < no_axis) move.target.joints.push_back(axis.number * degree);
    move.target.external_axes = external_of(value->items[1], external_shift_);
    return true;
  }
  const auto q = checked(value->items[1], "a target", written);
  if (!q) {
    const bool unset = *value == rapid_initial(code_, "robtarget");
    // A target that the program itself has set to zeros is not a question: the controller stops here.
    const std::string path = unset && !run_->was_assigned(written) ? run_->answer_name(run_->path_of(written)) : "";
    if (path.empty())
      run_->complain(
          written.place,
          unset ? "has a target that the program set to zeros" : "has a target whose quaternion is [0,0,0,0]",
          "give its orientation");
    else
      run_->miss(path, written.place, "has a target that was never given a value (all of it is 0)",
                 "give it one, in the program or with " + values_of_job({path}),
                 {{Question::Kind::value, path, form_of("robtarget")}});
    return false;
  }
  move.target.pose = displacement_ * Frame{rapid_position(value->items[0]), *q};
  const bool checked = move.kind == Instruction::Kind::joint ? configuration_of_joint_moves_ : configuration_of_paths_;
  if (checked) {
    move.target.configuration.kind = ArmConfiguration::Kind::abb;
    for (const Value& number : value->items[2].items)
      move.target.configuration.numbers.push_back(static_cast<int>(std::clamp(number.number, -1e6, 1e6)));
  }
  move.target.external_axes = external_of(value->items[3], external_shift_);
  return true;
}

std::optional<Frame> Rapid::read_via(const Expression& written) {
  const auto value = typed(written, "robtarget", "a circle point");
  if (!value) return {};
  const auto q = rapid_orientation(value->items[1]);
  return displacement_ * Frame{rapid_position(value->items[0]), q.value_or(Quaternion::Identity())};
}

bool Rapid::read_speed(const Expression& written, Instruction& move) {
  const auto value = typed(written, "speeddata", "a speed");
  if (!value) return false;
  run_->add_origin(move, "speed", written);
  if (!(item_number(*value, 0) > 0) && !(item_number(*value, 1) > 0)) {
    run_->complain(written.place, "has a speed that is not above 0", "give v_tcp in mm/s");
    return false;
  }
  const double factor = speed_factor_ * override_;
  const bool largest = written.kind == Expression::Kind::name && written.text == "vmax";
  if (!largest && item_number(*value, 0) > 0)
    move.speed.tool = std::min(item_number(*value, 0) * millimetre * factor, speed_limit_);
  if (!largest && item_number(*value, 1) > 0) move.speed.orientation = item_number(*value, 1) * degree * factor;
  return true;
}

/// Reads the speed of ArcL and ArcC from their welddata. On the way to the seam (...Start) the instruction's speed counts.
void Rapid::read_weld_speed(const Statement& statement, Instruction& move) {
  if (statement.name.ends_with("start")) return;
  for (std::size_t i = 3; i < statement.arguments.size(); ++i) {
    const Expression& argument = statement.arguments[i];
    if (!argument.option.empty()) continue;
    const Value value = run_->evaluate(argument);
    // welddata is a list of the speed and three more parts; seamdata begins with times, a zone has a type.
    if (value.kind != Value::Kind::list || value.type || value.items.size() < 2 || !value.items[0].is_number())
      continue;
    if (value.items[0].number > 0) {
      move.speed.tool = value.items[0].number * millimetre * override_;
      run_->add_origin(move, "speed", argument);
    }
  }
}

bool Rapid::read_zone(const Expression& written, Instruction& move) {
  const auto value = typed(written, "zonedata", "a zone");
  if (!value) return false;
  run_->add_origin(move, "zone", written);
  move.zone.distance = value->items[0].number != 0 ? 0 : std::max(0.0, item_number(*value, 1)) * millimetre;
  if (move.zone.distance > 0) move.zone.turn = std::max(0.0, item_number(*value, 4)) * degree;
  return true;
}

std::optional<NamedFrame> Rapid::tool_of(const Expression& written) {
  const auto value = typed(written, "tooldata", "a tool");
  if (!value) return {};
  const Value& frame = value->items[1];
  const auto q = checked(frame.items[1], "a tool", written);
  if (!q) {
    run_->complain(written.place, "has a tool whose quaternion is [0,0,0,0]",
                   "give the orientation of its tframe, [1,0,0,0] without a turn");
    return {};
  }
  const std::string name = run_->name_of(written);
  return NamedFrame{name.empty() ? "tool" : name, Frame{rapid_position(frame.items[0]), *q},
                    value->items[0].number == 0};
}

bool Rapid::read_tool(const Expression& written, Instruction& move) {
  const auto tool = tool_of(written);
  if (!tool) return false;
  run_->add_origin(move, "tool", written);
  if (reached_) reached_->tool = *tool;
  if (tool->name != "tool0") move.tool = run_->frame_index(run_->program().tools, *tool);
  return true;
}

std::optional<NamedFrame> Rapid::work_object_of(const Expression& written) {
  const auto value = typed(written, "wobjdata", "a work object");
  if (!value) return {};
  const Value &user = value->items[3], &object = value->items[4];
  const auto user_turn = checked(user.items[1], "a work object", written),
             turn = checked(object.items[1], "a work object", written);
  if (!user_turn || !turn) {
    run_->complain(written.place, "has a work object with a quaternion [0,0,0,0]",
                   "give the orientation of uframe and oframe, [1,0,0,0] without a turn");
    return {};
  }
  if (value->items[1].number == 0)
    run_->note(written.place,
               fmt::format("work object {}: another mechanical unit moves it, but it is taken to stand still",
                           run_->written(written)),
               true);
  const std::string name = run_->name_of(written);
  return NamedFrame{name.empty() ? "work object" : name,
                    Frame{rapid_position(user.items[0]), *user_turn} * Frame{rapid_position(object.items[0]), *turn},
                    value->items[0].number != 0};
}

bool Rapid::read_work_object(const Expression& written, Instruction& move) {
  const auto object = work_object_of(written);
  if (!object) return false;
  run_->add_origin(move, "work object", written);
  if (reached_) reached_->work_object = *object;
  if (object->name != "wobj0") move.work_object = run_->frame_index(run_->program().work_objects, *object);
  return true;
}

bool Rapid::read_options(const Statement& statement, Instruction& move) {
  bool whole = true;
  for (const Expression& argument : statement.arguments) {
    const std::string& option = argument.option;
    if (option == "wobj" && !(argument.if_present && !run_->present(argument)))
      whole &= read_work_object(argument, move);
    if (option != "t" && option != "v" && option != "z") continue;
    const Value given = run_->answered(argument);
    const double number = given.is_number() ? given.number : -1;
    if (!(number >= 0) || (number == 0 && option != "z")) {
      run_->ask_for(given, argument.place, fmt::format("has no number above 0 after \\{}", option),
                    "write it as a constant",
                    option == "t"   ? "a time in s"
                    : option == "v" ? "mm/s"
                                    : "mm");
      whole = false;
      continue;
    }
    if (option == "t") move.speed.duration = number / (speed_factor_ * override_);  // an override makes it longer
    if (option == "v") move.speed.tool = std::min(number * millimetre * speed_factor_ * override_, speed_limit_);
    if (option == "z") move.zone.distance = number * millimetre;
  }
  return whole;
}

/// Notes the options of a move that are not read.
void Rapid::print_options(const Statement& statement) {
  for (const Expression& argument : statement.arguments) {
    if (argument.option == "id")
      run_->note(argument.place,
                 "\\ID: another robot or a positioner moves at the same time (MultiMove), only this one is read", true);
    if (argument.option == "corr")
      run_->note(argument.place,
                 "\\Corr: path corrections (CorrWrite) move the robot off its line, which is followed without them",
                 true);
    if (argument.option == "weave")
      run_->note(argument.place,
                 fmt::format("\\Weave:={}: the torch swings about its line, which is followed without it",
                             run_->written(argument)),
                 true);
  }
}

bool Rapid::move(const Signature& signature, const Statement& statement) {
  std::vector<const Expression*> given;
  for (const Expression& argument : statement.arguments)
    if (argument.option.empty() && argument.kind != Expression::Kind::none) given.push_back(&argument);
  const int count = static_cast<int>(given.size());
  const auto index = [&](int written) { return written == -2 ? count - 1 : written == -3 ? count - 2 : written; };
  const int zone = index(signature.zone), tool = index(signature.tool);
  if (std::max({signature.target, signature.speed, zone, tool}) >= count || tool <= signature.speed) {
    run_->complain(statement.place, fmt::format("gives {} {} arguments, too few", statement.text, count),
                   "give target, speed, zone and tool");
    return true;
  }
  Instruction move;
  move.kind = signature.kind;
  move.acceleration_percent = acceleration_percent_;
  move.jerk_percent = jerk_percent_;
  const std::size_t problems = run_->problem_count();
  const bool unshifted =
      std::ranges::any_of(statement.arguments, [](const Expression& e) { return e.option == "noeoffs"; });
  const std::vector<double> shift = external_shift_;
  if (unshifted) external_shift_.clear();
  bool whole = read_target(*given[signature.target], signature.joints, move);
  external_shift_ = shift;
  if (signature.via >= 0) {
    const auto via = read_via(*given[signature.via]);
    whole &= via.has_value();
    if (via) move.via = *via;
    run_->add_origin(move, "via", *given[signature.via]);
  }
  whole &= read_speed(*given[signature.speed], move);
  if (zone > signature.speed) whole &= read_zone(*given[zone], move);
  whole &= read_tool(*given[tool], move);
  whole &= read_options(statement, move);
  if (is_weld(statement.name)) read_weld_speed(statement, move);
  if (!whole || run_->problem_count() != problems) return true;
  if (!signature.joints && reached_->tool.stationary != reached_->work_object.stationary)
    run_->note(statement.place,
               fmt::format("{}: {}", statement.text, reached_->tool.stationary ? no_robhold : two_robholds), true);
  print_options(statement);
  check_arguments(statement.text, statement.arguments, most_arguments(signature), move_switches);
  if (statement.name.starts_with("search")) {
    run_->note(statement.place, statement.text + ": the search goes to its end point", true);
    run_->assign(*given[1], reached_->target);
  }
  run_->emit(move, statement);
  if (!statement.name.starts_with("spot")) return true;
  Instruction weld = move;
  weld.kind = Instruction::Kind::dwell;
  weld.dwell = run_->options().spot_time;
  run_->emit(weld, statement);
  return true;
}

// ---- position of the robot, displacements -----------------------------------------------------------------

/// Returns the last target as a robtarget of another tool and work object (null: those of the last move), in the
/// current displacement. std::nullopt: the last move went to axis angles, no move yet, or a frame is not known.
std::optional<Value> Rapid::position_with(const Expression* tool, const Expression* work_object) {
  if (!reached_ || reached_->by_joints) return {};
  const auto new_tool = tool ? tool_of(*tool) : std::optional(reached_->tool);
  const auto new_object = work_object ? work_object_of(*work_object) : std::optional(reached_->work_object);
  const auto q = rapid_orientation(reached_->target.items[1]);
  if (!new_tool || !new_object || !q) return {};
  const bool standing =
      reached_->tool.stationary || reached_->work_object.stationary || new_tool->stationary || new_object->stationary;
  if (standing && (tool || work_object)) return {};
  const Frame written{rapid_position(reached_->target.items[0]), *q};
  const Frame seen = standing ? reached_->displacement * written
                              : inverse(new_object->frame) * reached_->work_object.frame * reached_->displacement *
                                    written * inverse(reached_->tool.frame) * new_tool->frame;
  const Frame target = inverse(displacement_) * seen;
  Value value = reached_->target;
  value.items[0] = rapid_pos(code_, target.position);
  value.items[1] = rapid_orient(code_, target.orientation);
  return value;
}

/// Returns CRobT(\Tool:=t \WObj:=w), CPos(...) or CJointT().
Value Rapid::current_position(const Expression& call) {
  const Expression *tool = nullptr, *work_object = nullptr;
  for (const Expression& argument : call.items) {
    if (argument.option == "tool") tool = &argument;
    if (argument.option == "wobj") work_object = &argument;
  }
  const bool joints = call.text == "cjointt", lost = !reached_ && lost_.cause;
  if (lost && lost_by_joints_ == joints) return lost_;  // the last target is a question already
  const std::string name = run_->name_here(call.text), form = form_of(joints ? "jointtarget" : "robtarget");
  if (joints) {
    if (reached_ && reached_->by_joints) return reached_->target;
    return unknown_value(
        name,
        reached_ || lost ? "asks for the axes at a target that is a pose" : "reads the robot's position at the start",
        form);
  }
  const auto position = position_with(tool, work_object);
  if (!position)
    return unknown_value(
        name, reached_ || lost ? "asks for the pose at axis angles" : "reads the robot's position at the start", form);
  return call.text == "cpos" ? position->items[0] : *position;
}

/// Like checked(); a quaternion of zeros is a problem, too.
std::optional<Quaternion> Rapid::turn_of_displacement(const Value& orient, const char* what,
                                                      const Expression& written) {
  const auto q = checked(orient, what, written);
  if (!q)
    run_->complain(written.place, fmt::format("displaces by {} with the quaternion [0,0,0,0]", what),
                   "give its orientation, [1,0,0,0] without a turn");
  return q;
}

/// Runs PDispOn \Rot \ExeP:=reached, programmed, tool \WObj:=w (the displacement from the programmed point to the robot's
/// position; without \Rot only a translation), PDispSet frame, PDispOff.
void Rapid::displace(const Statement& statement) {
  const std::string& name = statement.name;
  if (name == "pdispoff") displacement_ = Frame{};
  if (name == "pdispset" && !statement.arguments.empty())
    if (const auto pose = typed(statement.arguments[0], "pose", "a displacement"))
      if (const auto q = turn_of_displacement(pose->items[1], "a displacement", statement.arguments[0]))
        displacement_ = {rapid_position(pose->items[0]), *q};
  if (name != "pdispon") return;
  const Expression *programmed = nullptr, *tool = nullptr, *executed = nullptr, *work_object = nullptr;
  bool turns = false;
  for (const Expression& argument : statement.arguments) {
    if (argument.option == "exep") executed = &argument;
    if (argument.option == "wobj") work_object = &argument;
    turns |= argument.option == "rot";
    if (argument.option.empty()) (programmed ? tool : programmed) = &argument;
  }
  displacement_ = Frame{};
  if (!programmed || !tool) {
    run_->complain(statement.place, "has a PDispOn without the programmed point or the tool",
                   "correct the instruction");
    return;
  }
  const Expression world = name_at("wobj0", statement.place);  // without \WObj
  std::optional<Value> from = typed(*programmed, "robtarget", "a programmed point");
  std::optional<Value> to = executed ? typed(*executed, "robtarget", "a point that was reached")
                                     : position_with(tool, work_object ? work_object : &world);
  if (!executed && !to) to = run_->given_here("crobt");
  if (to && to->type == nullptr && !run_->shape(*to, code_.record("robtarget"))) to.reset();
  if (!executed && !to)
    run_->ask_for(reached_ || !lost_.cause ? unknown_value(run_->name_here("crobt"), "is the robot's position") : lost_,
                  statement.place,
                  "displaces by the robot's position, which is known only with the robot "
                  "(axis angles, or the start)",
                  "give the point as \\ExeP, write the displacement with PDispSet", form_of("robtarget"));
  const auto q = from ? turn_of_displacement(from->items[1], "a programmed point", *programmed) : std::nullopt;
  const auto p =
      to ? turn_of_displacement(to->items[1], "a point that was reached", executed ? *executed : *tool) : std::nullopt;
  if (!q || !p) return;
  const Frame written{rapid_position(from->items[0]), *q}, reached{rapid_position(to->items[0]), *p};
  displacement_ =
      turns ? reached * inverse(written) : Frame{reached.position - written.position, Quaternion::Identity()};
}

/// Runs EOffsSet shift; EOffsOn \ExeP:=reached, programmed; EOffsOff. The shift is added to the external axes of all targets.
void Rapid::shift_external_axes(const Statement& statement) {
  external_shift_.clear();
  if (statement.name == "eoffsoff") return;
  const auto axes = [&](const Value& target) { return target.items.back(); };  // extjoint of either target
  const auto target = [&](const Expression& written) {
    Value value = run_->evaluate(written);
    const bool joints = value.type == code_.record("jointtarget");
    return typed(written, joints ? "jointtarget" : "robtarget", "a point");
  };
  const Expression *first = nullptr, *executed = nullptr;
  for (const Expression& argument : statement.arguments) {
    if (argument.option == "exep") executed = &argument;
    if (argument.option.empty() && !first) first = &argument;
  }
  if (!first) return;
  if (statement.name == "eoffsset") {
    if (const auto shift = typed(*first, "extjoint", "an offset"))
      for (const Value& axis : shift->items)
        external_shift_.push_back(std::abs(axis.number) < no_axis ? axis.number : 0);
    return;
  }
  const auto programmed = target(*first);
  const auto reached = executed ? target(*executed) : reached_ ? std::optional(reached_->target) : std::nullopt;
  if (programmed && !reached && !lost_.cause)
    run_->complain(statement.place, "shifts external axes (EOffsOn) by where the external axes stand at the start",
                   "give the point as \\ExeP, or write the offset with EOffsSet");
  if (!programmed || !reached) return;
  const Value from = axes(*programmed), to = axes(*reached);
  for (std::size_t i = 0; i < from.items.size() && i < to.items.size(); ++i) {
    const double a = item_number(from, i), b = item_number(to, i);
    external_shift_.push_back(std::abs(a) < no_axis && std::abs(b) < no_axis ? b - a : 0);
  }
}

}  // namespace dresslife::sim
