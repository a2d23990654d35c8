#include "sim/program/krl/krl.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/base/joined.h"
#include "sim/program/interpreter/arc.h"
#include "sim/program/interpreter/job_words.h"
#include "sim/program/interpreter/tokens.h"
#include "sim/program/krl/dialect.h"
#include "sim/program/krl/spline.h"

namespace dresslife::sim {

using namespace krl;

namespace {

bool is_standing(const std::string& name) {
  static const pipeline::WordSet names =
      pipeline::word_set("$axis_act $axis_act_meas $pos_act $pos_act_mes $axis_int $pos_int $axis_ret $pos_ret");
  return names.contains(name);
}

/// Whether a move has a mark: C_DIS, #TOOL, in_spline.
bool has(const Statement& statement, const char* word) {
  return (" " + statement.text + " ").find(fmt::format(" {} ", word)) != std::string::npos;
}

/// Whether the spline planner plans a move. Only this planner uses $GEAR_JERK and $JERK.
bool is_spline(const Statement& statement) { return statement.name.starts_with("s") || has(statement, "in_spline"); }

/// Distance of SAPO_PTP [mm] from which only the percentage counts.
constexpr double no_distance = 1e5;

constexpr const char* target_form =
    "{X .., Y .., Z .., A .., B .., C .., S .., T ..} in mm and deg, or {A1 .., A2 .., A3 .., A4 .., A5 .., A6 ..}";

constexpr double usual_turn_acceleration = 100;  // [deg/s2] least $ACC.ORI1 of public programs

constexpr double most_angle = 3600;  // largest CA [deg]

}  // namespace

Krl::Krl(const Code& code, const std::vector<NamedFrame>& tools, const std::vector<NamedFrame>& work_objects)
    : code_(code), tools_(tools), work_objects_(work_objects) {}

std::optional<Instruction::Kind> Krl::kind_of(const std::string& name) {
  std::string plain = name.starts_with("s") ? name.substr(1) : name;
  if (plain.ends_with("_rel")) plain.resize(plain.size() - 4);
  if (plain == "ptp") return Instruction::Kind::joint;
  if (plain == "lin" || plain == "pl") return Instruction::Kind::linear;
  if (plain == "circ") return Instruction::Kind::circular;
  return {};
}

bool Krl::matters(const std::string& name) const { return kind_of(name).has_value() || name == "bas"; }

std::optional<Value> Krl::constant(const std::string& name) {
  if (name.starts_with("#")) return text_value(name);
  if (name == "$nullframe" || name == "$world") return frame_value(Frame{});
  if (name == "$num_ax") return number_value(6);
  if (name == "$t1" || name == "$t2") return truth_value(false);  // cables wear in automatic operation
  if (name == "$on_path") return truth_value(false);              // a program runs from its first line
  const bool axes = name == "$axis_act" || name == "$axis_act_meas" || name == "$axis_int";
  if (!axes && name != "$pos_act" && name != "$pos_act_mes" && name != "$pos_int") return named_frame(name);
  const auto numbers = axes ? axes_ : place_before(current_frames());
  if (numbers) {
    Value place = record(*numbers, axes ? "e6axis" : "e6pos");
    for (std::size_t i = 0; i < external_.size(); ++i)
      if (const Value* part = external_[i] ? place.field(external_names[i]) : nullptr)
        store(const_cast<Value&>(*part), number_value(*external_[i]));
    return place;
  }
  if (std::optional<Value> given = run_->given_here(name)) return given;
  return place_here(axes);
}

// ---- targets ----------------------------------------------------------------------------------------------

void Krl::ask_for_target(const Expression& written, const Value& value) {
  const std::string path = run_->path_of(written), answer = path.empty() ? "" : run_->answer_name(path);
  const std::string name = path.empty() ? std::string("a position") : fmt::format("'{}'", path);
  const Cause* cause = value.first_cause();
  std::vector<Question> questions;
  if (!path.empty()) questions = {{Question::Kind::value, answer, target_form}};
  if (is_unset(value)) {
    run_->miss(answer.empty() ? name : answer, written.place, fmt::format("moves to {}, which has no value yet", name),
               "assign it before the move, give the file that holds its value (.dat), or " +
                   values_of_job({path.empty() ? "NAME" : answer}, "{X ...}"),
               questions);
  } else if (!path.empty() && cause && cause->name == answer) {
    run_->miss(
        answer, written.place, fmt::format("moves to {}, which no file read declares", name),
        "give the .dat file that declares it, write the target as a constant, or " + values_of_job({answer}, "{X ...}"),
        questions);
  } else {
    Coordinates none;
    none.unknown = value;
    ask_for_part(written, none);
  }
}

/// Asks for all missing parts of a target in one problem, so that one round of answers is enough.
void Krl::ask_for_part(const Expression& written, const Coordinates& read) {
  const Value value = run_->evaluate(written);
  const bool whole = value.kind == Value::Kind::unknown;
  run_->ask_for(read.unknown, written.place, "moves to a place that is known only while the robot runs", "",
                whole ? target_form : "a number");
}

/// Returns the robot's position that the user gives for the current line: "cell.src:12:$pos_act"; std::nullopt: none.
std::optional<std::array<double, 6>> Krl::given_place(bool axes) {
  const auto value = run_->given_here(axes ? "$axis_act" : "$pos_act");
  const Coordinates read =
      value ? axes ? coordinates(*value, axis_names) : coordinates(*value, frame_names) : Coordinates{};
  return read.all() ? std::optional(read.numbers) : std::nullopt;
}

/// Asks for the position before the move: components that a target omits keep their values.
void Krl::ask_for_place_before(const Expression& written, bool axes) {
  if (axes)
    return run_->ask_for(
        place_here(axes), written.place,
        "gives some axes only, from a place whose other axis angles are not known: the move before goes "
        "to a pose or is not known",
        "write PTP {A1 .., A2 .., A3 .., A4 .., A5 .., A6 ..} here, or move to axis angles before", "");
  run_->ask_for(
      place_here(axes), written.place,
      "gives some coordinates only, from a place whose other coordinates are not known: the move before goes to axis "
      "angles or is not known",
      run_->options().flange
          ? "move to a pose with X, Y, Z, A, B, C before"
          : "move to a pose with X, Y, Z, A, B, C before, name the program in a job, whose robot of six "
            "axes gives them",
      "");
}

/// Returns an unknown position of the robot. The question includes the causes of the last move's unknown target, because
/// the user may know these instead.
Value Krl::place_here(bool axes) const {
  const Value here = unknown_value(run_->name_here(axes ? "$axis_act" : "$pos_act"), "is the robot's position",
                                   form_of(axes ? "axis" : "frame"));
  return lost_.cause ? unknown_value(lost_, here) : here;
}

/// Returns the position before the move, in the frames of the move. After a move to axis angles the robot's kinematics
/// give the pose (ImportOptions::flange). std::nullopt: not known.
std::optional<std::array<double, 6>> Krl::place_before(const Frames& frames) const {
  if (axes_ && frames.unknown.known() && run_->options().flange) {
    std::array<double, 6> angles = *axes_;
    for (double& angle : angles) angle *= degree;
    return numbers_of(frames.pose(run_->options().flange(angles)));
  }
  if (!numbers_ || frames.same(numbers_in_)) return numbers_;
  if (!frames.unknown.known() || !numbers_in_.unknown.known()) return numbers_;  // the frames are a question
  return numbers_of(frames.pose(numbers_in_.flange(frame_from(*numbers_))));
}

bool Krl::read_external(const Expression& written, const Value& value, bool relative, Instruction& move) {
  const Coordinates read = coordinates(value, external_names);
  if (!read.unknown.known()) {
    ask_for_part(written, read);
    return false;
  }
  std::size_t count = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    if (read.given[i]) external_[i] = read.numbers[i] + (relative ? external_[i].value_or(0) : 0);
    if (external_[i]) count = i + 1;
  }
  for (std::size_t i = 0; i < count; ++i) move.target.external_axes.push_back(external_[i].value_or(0));
  return true;
}

namespace {

/// Returns a target in the frame of the move, from its components and the position before; std::nullopt: not known.
std::optional<std::array<double, 6>> moved(const Coordinates& read, Krl::From from,
                                           const std::optional<std::array<double, 6>>& before) {
  if (read.all() && from == Krl::From::origin) return read.numbers;
  if (!before) return {};
  std::array<double, 6> numbers = *before;
  if (from == Krl::From::origin) {
    for (int i = 0; i < 6; ++i)
      if (read.given[i]) numbers[i] = read.numbers[i];
  } else if (from == Krl::From::tool) {
    numbers = numbers_of(frame_from(*before) * frame_from(read.numbers));
  } else {
    for (int i = 0; i < 6; ++i) numbers[i] += read.numbers[i];
  }
  return numbers;
}

}  // namespace

bool Krl::read_via(const Expression& via, From from, const Frames& frames, Instruction& move) {
  const Value value = run_->evaluate(via);
  const Coordinates read = coordinates(value, frame_names);
  if (coordinates(value, axis_names).any()) {
    run_->complain(via.place, "has a CIRC by axis angles", "write a frame");
    return false;
  }
  if (!read.unknown.known() || !read.any()) {
    read.unknown.known() ? ask_for_target(via, value) : ask_for_part(via, read);
    return false;
  }
  auto before = place_before(frames);
  if (!before) before = given_place(false);
  const auto numbers = moved(read, from, before);
  if (!numbers) {
    ask_for_place_before(via, false);
    return false;
  }
  move.via = frame_from(*numbers);
  return true;
}

/// Asks for the value of a setting (#VAR, #BASE) that is unknown.
void Krl::ask_for_kind(const Value* kind, const char* what, const Place& place) {
  if (kind && kind->kind == Value::Kind::unknown && !is_unset(*kind))
    run_->ask_for(*kind, place, fmt::format("{} that is known only while the robot runs", what), "assign a constant",
                  "a name");
}

/// Gives a warning of a word that an enumeration does not have. of: the variable; known: its words in capitals.
void Krl::check_word(const Value* word, const char* of, const std::vector<std::string>& known, const Place& place) {
  if (!word || word->kind != Value::Kind::text) return;
  const std::string written = upper_case(word->text);
  if (std::ranges::find(known, written) == known.end()) run_->unread(place, written, of, known);
}

/// Gives a warning of a mark after the target (C_DIST) that no move has.
void Krl::check_marks(const Statement& statement) {
  static const pipeline::WordSet known = pipeline::word_set("c_ptp c_dis c_vel c_ori c_spl #tool #base in_spline last");
  const std::vector<std::string_view> words = pipeline::words_in(statement.text);
  for (std::size_t i = 1; i < words.size(); ++i)  // after the move
    if (!known.contains(words[i]))
      run_->unread(statement.place, upper_case(words[i]), "the marks of a move",
                   {"C_PTP", "C_DIS", "C_VEL", "C_ORI", "C_SPL", "#TOOL", "#BASE"});
}

/// Whether $ORI_TYPE is #CONSTANT: the tool keeps its orientation, and the target's orientation is ignored. unknown: the
/// position before the move is not known; then returns false with a warning.
bool Krl::keeps_orientation(const Place& place, bool unknown) {
  const Value* type = run_->variable("$ori_type");
  ask_for_kind(type, "turns the tool by an $ORI_TYPE", place);
  check_word(type, "$ORI_TYPE", {"#VAR", "#CONSTANT", "#JOINT", "#IGNORE"}, place);
  const std::string kind = type && type->kind == Value::Kind::text ? type->text : "";
  if (kind == "#joint")
    run_->note(place, "turns the tool by the wrist's axes ($ORI_TYPE #JOINT): it is turned evenly", true);
  if (kind == "#ignore")
    run_->note(place, "ignores the orientation of its point ($ORI_TYPE #IGNORE): the tool is turned to it", true);
  if (kind != "#constant") return false;
  if (unknown)
    run_->note(place, "keeps the orientation ($ORI_TYPE #CONSTANT) of an unknown place: the target's is taken", true);
  return !unknown;
}

bool Krl::read_target(const Expression& written, From from, const Frames& frames, Instruction& move) {
  if (read_known_target(written, from, frames, move)) {
    lost_ = {};
    return true;
  }
  numbers_.reset(), axes_.reset();
  lost_ = unknown_value(run_->evaluate(written));
  return false;
}

bool Krl::read_known_target(const Expression& written, From from, const Frames& frames, Instruction& move) {
  const Value value = run_->answered(written);
  const Coordinates axes = coordinates(value, axis_names), frame = coordinates(value, frame_names);
  for (const Coordinates* read : {&axes, &frame})
    if (!read->unknown.known()) {
      ask_for_part(written, *read);
      return false;
    }
  const bool outside = coordinates(value, external_names).any();  // PTP {E1 200}: the robot's axes do not move
  const bool joint = axes.any() || (!frame.any() && outside && axes_);
  if (!joint && !frame.any() && !outside) {
    ask_for_target(written, value);
    return false;
  }
  if (joint && move.kind != Instruction::Kind::joint) {
    run_->complain(written.place, "goes along a path to axis angles (the controller stops here)", "write a frame");
    return false;
  }
  if (from == From::place && !joint && (frame.numbers[4] != 0 || frame.numbers[5] != 0)) {
    run_->complain(written.place, "turns about B or C by a relative amount (in $BASE the law is not public)",
                   "write the target's angles, or #TOOL");
    return false;
  }
  constexpr double likely_metres = 1, no_move = 0.02;  // [mm]
  const double way = std::hypot(frame.numbers[0], frame.numbers[1], frame.numbers[2]);
  if (from != From::origin && way >= no_move && way < likely_metres)
    run_->note(written.place, fmt::format("{:.3g} mm: {}", way, tiny_move), true);
  const auto before = joint ? axes_ : place_before(frames);
  const Coordinates& read = joint ? axes : frame;
  auto numbers = moved(read, from, before);
  if (!numbers) numbers = moved(read, from, given_place(joint));
  if (numbers && move.kind != Instruction::Kind::joint && keeps_orientation(written.place, !before))
    std::copy(before->begin() + 3, before->end(), numbers->begin() + 3);
  if (!numbers) {
    ask_for_place_before(written, joint);
    return false;
  }
  if (!read_external(written, value, from != From::origin, move)) return false;
  if (joint) {
    for (double number : *numbers) move.target.joints.push_back(number * degree);
    axes_ = numbers;
    numbers_.reset();
    return true;
  }
  move.target.pose = frame_from(*numbers);
  numbers_ = numbers;
  numbers_in_ = frames;
  axes_.reset();
  const Value *status = value.field("s"), *turn = value.field("t");
  if (move.kind == Instruction::Kind::joint && status && turn && status->is_number() && turn->is_number())
    move.target.configuration = {ArmConfiguration::Kind::kuka,
                                 {static_cast<int>(std::clamp(status->number, 0.0, 63.0)),
                                  static_cast<int>(std::clamp(turn->number, 0.0, 63.0))}};
  return true;
}

// ---- speed and zone ---------------------------------------------------------------------------------------

/// Returns the number in a system variable or in a field of it; std::nullopt: not known.
std::optional<double> Krl::setting(const std::string& name, const char* field) {
  const Value* value = run_->variable(name);
  if (value && *field) value = value->field(field);
  return value && value->is_number() ? std::optional(value->number) : std::nullopt;
}

/// Gives a warning of a setting, at its last assignment; at the move if the files do not contain it.
void Krl::note_setting(const char* variable, const std::string& what, const Place& place) {
  const Place assigned = run_->origin(name_at(variable, {}));
  run_->note(assigned.line > 0 ? assigned : place, what, true);
}

/// Returns the smaller one of $VEL.ORI1 (swivel) and $VEL.ORI2 (turn about the tool) [deg/s]; std::nullopt: none is known.
std::optional<double> Krl::turn_speed(const Place& place) {
  std::optional<double> slowest;
  for (const char* field : {"ori1", "ori2"}) {
    const auto speed = setting("$vel", field);
    if (!speed || !(*speed > 0)) continue;
    if (slowest && *slowest != *speed)
      note_setting("$vel", fmt::format("$VEL.ORI1 {:g} and $VEL.ORI2 {:g}: {}", *slowest, *speed, unlike_turns), place);
    slowest = std::min(*speed, slowest.value_or(*speed));
  }
  return slowest;
}

bool Krl::read_axis_speed(const Statement& statement, Instruction& move) {
  const auto slowest = [&](const char* list) -> std::optional<double> {  // the slowest axis limits a joint move
    double percent = 100;
    const Value* values = run_->variable(list);
    for (std::size_t axis = 0; values && axis < 6 && axis < values->items.size(); ++axis) {
      const Value& value = values->items[axis];
      if (is_unset(value)) continue;
      if (!value.is_number() || !(value.number > 0)) {
        run_->ask_for(value, statement.place,
                      fmt::format("moves with {}[{}] that is not a known number above 0", list, axis + 1),
                      value.causes().empty() ? "assign a constant"
                                             : "give the file that holds it (PDEFAULT and its like: $CONFIG.DAT)",
                      "a number in %");
        return {};
      }
      percent = std::min(percent, run_->within(value.number, 0, 100, fmt::format("{}[{}]", upper_case(list), axis + 1),
                                               statement.place));
    }
    return percent;
  };
  const auto speed = slowest("$vel_axis"), acceleration = slowest("$acc_axis");
  if (!speed || !acceleration) return false;
  move.speed.axis_percent = *speed;
  move.acceleration_percent = std::max(0.1, *acceleration);  // least of a step in YAML
  const Value* jerks = run_->variable("$gear_jerk");
  for (std::size_t axis = 0; is_spline(statement) && jerks && axis < 6 && axis < jerks->items.size(); ++axis)
    if (const Value& jerk = jerks->items[axis]; jerk.is_number() && jerk.number > 0)
      move.jerk_percent = std::clamp(jerk.number, 1.0, move.jerk_percent);
  return true;
}

bool Krl::read_path_speed(const Statement& statement, Instruction& move) {
  const Value* velocity = run_->variable("$vel");
  const Value* held = velocity ? velocity->field("cp") : nullptr;
  std::optional<Value> speed;
  if (held && !is_unset(*held))
    speed = *held;
  else
    speed = run_->given("$vel.cp");
  if (!speed) {
    run_->miss("$vel.cp", statement.place,
               "moves along a path before $VEL.CP is assigned (its value lies in the controller)",
               "assign $VEL.CP in m/s, or give " + values_of_job({"$VEL.CP"}),
               {{Question::Kind::value, "$vel.cp", "a speed in m/s"}});
    return false;
  }
  if (!speed->is_number() || !(speed->number > 0)) {
    run_->ask_for(*speed, statement.place, "moves along a path at a $VEL.CP that is not a known number above 0",
                  "assign a constant in m/s, give $config.dat", "a speed in m/s");
    return false;
  }
  move.speed.tool = speed->number;
  if (const auto turn = turn_speed(statement.place)) move.speed.orientation = *turn * degree;
  for (const char* field : {"ori1", "ori2"})
    if (const auto turn = setting("$acc", field); turn && *turn < usual_turn_acceleration)
      note_setting("$acc", fmt::format("$ACC.{} {:g}: {}", upper_case(field), *turn, turn_acceleration),
                   statement.place);
  const Value* accelerations = run_->variable("$acc");
  const Value* path = accelerations ? accelerations->field("cp") : nullptr;
  if (path && path->kind == Value::Kind::unknown && !is_unset(*path) && path->first_cause()) {
    run_->ask_for(*path, statement.place, "moves along a path at an $ACC.CP that is known only while the robot runs",
                  "assign a constant in m/s2", "an acceleration in m/s2");
    return false;
  }
  const auto acceleration = setting("$acc", "cp"), whole = setting("def_acc_cp", "");
  if (acceleration && *acceleration > 0) {
    const double most = whole.value_or(standard_path_acceleration);
    move.acceleration_percent = run_->within(100 * *acceleration / most, 1, 100,
                                             fmt::format("$ACC.CP in % of {:g} m/s2", most), statement.place);
  }
  if (const auto jerk = setting("$jerk", "cp"); is_spline(statement) && jerk && *jerk > 0)
    move.jerk_percent = std::clamp(100 * *jerk / standard_path_jerk, 1.0, 100.0);
  return true;
}

/// Applies the override $OV_PRO to the speed of a move.
bool Krl::read_override(const Statement& statement, Instruction& move) {
  if (const auto percent = setting("$red_vel", ""); percent && *percent < 100)
    note_setting("$red_vel", fmt::format("$RED_VEL {:g}: {}", *percent, reduced_speed), statement.place);
  const Value* value = run_->variable("$ov_pro");
  if (!value || is_unset(*value)) return true;
  if (!value->is_number() || !(value->number > 0)) {
    run_->ask_for(*value, statement.place, "moves at an override $OV_PRO that is not a known number above 0",
                  "assign a constant in %", "a number in %");
    return false;
  }
  const double share = std::min(value->number, 100.0) / 100;
  for (std::optional<double>* speed : {&move.speed.axis_percent, &move.speed.tool, &move.speed.orientation})
    if (*speed) **speed *= share;
  move.speed.override_share = share;
  return true;
}

bool Krl::read_speed(const Statement& statement, Instruction& move) {
  const bool read =
      move.kind == Instruction::Kind::joint ? read_axis_speed(statement, move) : read_path_speed(statement, move);
  return read && read_override(statement, move);
}

void Krl::read_zone(const Statement& statement, Instruction& move) {
  const auto known = [&](const char* field, const char* written) {
    auto number = setting("$apo", field);
    if (const auto given = number ? std::nullopt : run_->given(lower_case(written)); given && given->is_number())
      number = given->number;
    const Value part = number ? Value{} : run_->evaluate(field_at("$apo", field, statement.place));
    const Cause* cause = is_unset(part) ? nullptr : part.first_cause();
    if (!number && cause && !cause->asked().empty() && !cause->asked().starts_with("$apo"))
      run_->ask_for(part, statement.place,
                    fmt::format("approximates by {}, which is known only while the robot runs", written),
                    "assign a constant", "a number");
    else if (!number)
      run_->note(statement.place,
                 fmt::format("approximation by {}: no file sets it, so that the robot stops at the target (give {})",
                             written, values_of_job({written})),
                 true);
    return number;
  };
  if (has(statement, "in_spline") && !has(statement, "last")) {
    move.zone.percent = 100;  // a spline does not stop between its points
    return;
  }
  if (const auto ahead = setting("$advance", ""); ahead && *ahead <= 0)
    return;  // without advance the controller does not blend
  const bool joint = move.kind == Instruction::Kind::joint,
             by_distance = has(statement, "c_dis") || has(statement, "c_spl");
  const auto distance = setting("$apo", "cdis");
  if (has(statement, "c_ptp") || (joint && by_distance && distance && *distance >= no_distance)) {
    move.zone.percent = run_->within(known("cptp", "$APO.CPTP").value_or(0), 0, 100, "$APO.CPTP", statement.place);
  } else if (by_distance) {
    move.zone.distance = std::max(0.0, known("cdis", "$APO.CDIS").value_or(0)) * millimetre;
  } else if (has(statement, "c_vel")) {
    // Blending begins at the share v of the speed V: at (v V)^2 / 2a of the braking distance V^2 / 2a.
    const double share = std::clamp(known("cvel", "$APO.CVEL").value_or(0), 0.0, 100.0) / 100;
    move.zone.percent = 100 * share * share;
  } else if (has(statement, "c_ori")) {
    run_->note(statement.place, "approximation by an angle (C_ORI): the robot stops at the target", true);
  }
}

/// Writes the origins of a move's parts.
void Krl::add_origins(const Expression& target, const Frames& frames, Instruction& move) {
  const auto add = [&](const char* part, const std::string& written, const Expression& from) {
    run_->add_origin(move, part, from, written);
  };
  const bool joint = move.kind == Instruction::Kind::joint;
  run_->add_origin(move, "target", target);
  if (move.tool >= 0) add("tool", frames.stationary ? frames.base_name : frames.tool_name, name_at("$tool", {}));
  if (move.work_object >= 0)
    add("work object", frames.stationary ? frames.tool_name : frames.base_name, name_at("$base", {}));
  add("speed", joint ? "$VEL_AXIS" : "$VEL.CP", name_at(joint ? "$vel_axis" : "$vel", {}));
  add("acceleration", joint ? "$ACC_AXIS" : "$ACC.CP", name_at(joint ? "$acc_axis" : "$acc", {}));
  if (move.zone.distance > 0 || move.zone.percent > 0) add("zone", "$APO", name_at("$apo", {}));
}

// ---- moves ------------------------------------------------------------------------------------------------

/// Whether a move goes to the current position ($AXIS_ACT). Before the first move, a variable that contains it counts, too.
bool Krl::stands_still(const Expression& target) const {
  if (target.kind != Expression::Kind::name) return false;
  if (is_standing(target.text)) return true;
  const auto moves = [](const Instruction& i) { return i.kind != Instruction::Kind::dwell; };
  const auto& made = run_->program().instructions;
  if (std::ranges::any_of(made, moves)) return false;
  const Place last = run_->origin(target);  // the line "p = $AXIS_ACT", if no part of p was written later
  if (last.line == 0) return false;
  std::string line = lower_case(code_.files[last.file].from(last.line, last.column));
  line.resize(std::min(line.find(';'), line.size()));
  std::erase(line, ' ');
  return line.starts_with(target.text + "=") && is_standing(line.substr(target.text.size() + 1));
}

void Krl::set_frames(const Frames& frames, Instruction& move) {
  const auto trivial = [](const Frame& f) { return f.position.isZero(0) && f.orientation.vec().isZero(0); };
  // #TCP: the tool stands at $BASE, the robot carries the work object at $TOOL.
  const bool turned = frames.stationary;
  const NamedFrame tool{turned ? frames.base_name : frames.tool_name, turned ? frames.base : frames.tool, turned};
  const NamedFrame object{turned ? frames.tool_name : frames.base_name, turned ? frames.tool : frames.base, turned};
  if (turned || !trivial(tool.frame)) move.tool = run_->frame_index(run_->program().tools, tool);
  if (turned || !trivial(object.frame)) move.work_object = run_->frame_index(run_->program().work_objects, object);
}

bool Krl::ask_for_frames(const Frames& frames, const Statement& statement) {
  if (frames.unknown.known()) return false;
  ask_for_frame(frames.unknown, statement);
  if (!frames.base_too.known()) ask_for_frame(frames.base_too, statement);
  return true;
}

void Krl::ask_for_frame(const Value& unknown, const Statement& statement) {
  const Cause* cause = unknown.first_cause();
  const bool listed = cause && (cause->name.starts_with("TOOL_DATA[") || cause->name.starts_with("BASE_DATA["));
  if (listed) {
    const bool tool = cause->name[0] == 'T';
    const auto kind = tool ? Question::Kind::tool : Question::Kind::work_object;
    run_->miss(cause->name, statement.place, fmt::format("moves with {}, which no file read declares", cause->name),
               fmt::format("give the file that declares it ($config.dat), or motion.{} with the name '{}'",
                           tool ? "tools" : "work_objects", cause->name),
               {{kind, cause->name, ""}});
  } else {
    run_->ask_for(unknown, statement.place, "moves with a $TOOL or $BASE that the files do not contain",
                  "assign a constant frame", "{X .., Y .., Z .., A .., B .., C ..} in mm and deg");
  }
}

/// Emits the moves of a circular move. whole_angle: the angle CA of the arc; null: the arc ends at the target. With
/// $CIRC_TYPE #PATH and a constant orientation the tool turns with the path.
void Krl::go_round(const Statement& statement, const Expression* whole_angle,
                   const std::optional<std::array<double, 6>>& start, Instruction move) {
  const Value* type = run_->variable("$circ_type");
  ask_for_kind(type, "turns the tool on its arc by a $CIRC_TYPE", statement.place);
  check_word(type, "$CIRC_TYPE", {"#BASE", "#PATH"}, statement.place);
  const bool by_path = type && type->kind == Value::Kind::text && type->text == "#path";
  const bool turning = by_path && start && keeps_orientation(statement.place, false);
  if (by_path && !turning)
    run_->note(statement.place, "turns the tool with the way ($CIRC_TYPE #PATH): it is turned evenly", true);
  if (!whole_angle && !turning) return run_->emit(move, statement);
  const Value given = whole_angle ? run_->evaluate(*whole_angle) : number_value(0);
  if (!given.is_number())
    return run_->ask_for(given, statement.place, "goes round by a CA that is known only while the robot runs",
                         "write a constant", "an angle in deg");
  if (!start)
    return run_->complain(statement.place, "goes round by CA from a place that is not known", "write a LIN before");

  const Frame from = frame_from(*start), to = move.target.pose;
  const auto arc = arc_through(from.position, move.via.position, to.position);
  constexpr double taught_alike = 0.1 * degree;  // [rad] accuracy of taught points
  if (!arc || std::abs(given.number) > most_angle) {
    run_->complain(
        statement.place,
        arc ? "goes round by more than ten turns" : "has no circle: its points lie on a line, or two are one",
        "correct the points");
  } else if (!turning && from.orientation.angularDistance(to.orientation) > taught_alike) {
    run_->complain(statement.place, "turns the tool while it goes round by CA (KUKA's law is not public)",
                   "write the end of the arc as the target, without CA");
  } else {
    const std::vector<Frame> poses = poses_along(*arc, from, whole_angle ? given.number * degree : arc->angle, turning);
    const MoveZone zone = move.zone;
    for (std::size_t i = 0; i + 1 < poses.size(); i += 2) {
      move.via = poses[i], move.target.pose = poses[i + 1];
      move.zone = i + 2 < poses.size() ? MoveZone{0, 100} : zone;
      run_->emit(move, statement);
    }
    if (!poses.empty()) numbers_ = numbers_of(poses.back());
  }
}

void Krl::move_now(Instruction::Kind kind, const Statement& statement) {
  Instruction move;
  move.kind = kind;
  const From from = !statement.name.ends_with("_rel") ? From::origin
                    : has(statement, "#tool")         ? From::tool
                                                      : From::place;
  const Expression* target = nullptr;
  const Expression* via = nullptr;
  const Expression* angle = nullptr;  // CA, the angle of the whole arc
  for (const Expression& argument : statement.arguments) {
    if (argument.option == "ca") {
      angle = &argument;
      continue;
    }
    via = target;
    target = &argument;
  }
  if (!target || (kind == Instruction::Kind::circular && !via)) {
    run_->complain(statement.place, "has a CIRC without a point on the way and a target", "write both");
    return;
  }
  if (stands_still(*target)) {
    run_->note(statement.place, "the robot is already there: no move");
    return;
  }
  check_marks(statement);
  check_word(run_->variable("$ipo_mode"), "$IPO_MODE", {"#BASE", "#TCP", "#NONE"}, statement.place);
  const Frames frames = current_frames();
  const auto start = place_before(frames);
  bool whole = kind != Instruction::Kind::circular || read_via(*via, from, frames, move);
  whole &= read_target(*target, from, frames, move);
  if (!whole) ask_for_frames(frames, statement);  // a pose needs the frames
  const bool has_speed = read_speed(statement, move);
  read_zone(statement, move);  // all missing values of the move are one round of questions
  if (!has_speed || !whole) return;
  // Axis angles need no frames, unless the blend begins at a distance of the tool.
  const bool free = !move.target.joints.empty() && move.zone.distance == 0;
  if (frames.unknown.known())
    set_frames(frames, move);
  else if (!free && ask_for_frames(frames, statement))
    return;
  if (statement.name.starts_with("spl") && has(statement, "in_spline"))
    spline_points_.insert(run_->program().instructions.size());
  add_origins(*target, frames, move);
  if (kind == Instruction::Kind::circular)
    go_round(statement, angle, start, move);
  else
    run_->emit(move, statement);
  for (const long number : braking_) handlers_happen(number);
}

// ---- interrupts -------------------------------------------------------------------------------------------

/// Makes the variables unknown that an interrupt's handler writes, because the handler may have run.
void Krl::handlers_happen(long number) {
  const auto handler = handlers_.find(number);
  if (handler == handlers_.end()) return;
  const Statement& call = *handler->second.call;
  run_->forget_writes_of(
      call, handler->second.module,
      fmt::format("may be written by the interrupt {} (declared in {})", call.text, run_->short_place(call.place)));
}

/// Handles an interrupt statement. Interrupts are assumed not to happen; one that stops moves gives a warning.
void Krl::interrupt(const Statement& statement) {
  const Value number = statement.arguments.empty() ? number_value(0) : run_->evaluate(statement.arguments[0]);
  const long key = number.is_number() ? static_cast<long>(std::clamp(number.number, -1e6, 1e6)) : -1;
  if (statement.name == "interrupt_decl") {
    const Statement& call = statement.branches[0].body[0];
    if (call.name == "ir_stopm") return;  // handler of a stop by the operator
    handlers_[key] = {&call, run_->module()};
  } else if (statement.name == "interrupt_off") {
    statement.arguments.empty() ? braking_.clear() : static_cast<void>(braking_.erase(key));
  } else if (const auto handler = handlers_.find(key); handler != handlers_.end()) {
    handlers_happen(key);
    constexpr int deepest = 4;  // levels of calls in handlers
    const auto brakes = [](const Statement& of) { return of.name == "brake" || of.name == "resume"; };
    if (!code_.reaches({*handler->second.call}, handler->second.module, deepest, brakes)) return;
    braking_.insert(key);
    run_->note(
        statement.place,
        fmt::format("an interrupt that may stop a move ({}): it is taken not to happen", handler->second.call->text),
        true);
  }
}

/// Runs a move. The settings of WITH apply to this move only.
void Krl::move(Instruction::Kind kind, const Statement& statement) {
  std::map<std::string, std::pair<Value, Place>> before;
  const auto keep = [&](const std::string& name) {
    if (const Value* value = run_->variable(name))
      before.emplace(name, std::pair(*value, run_->origin(name_at(name, {}))));
  };
  for (const Branch& settings : statement.branches)
    for (const Statement& s : settings.body) {
      for (const char* list : {"$vel_axis", "$acc_axis", "$gear_jerk"})
        keep(list);  // SVEL_JOINT and similar functions set all elements
      const Expression* base = &s.arguments[0];
      while (base->kind != Expression::Kind::name) base = &base->items[0];
      keep(base->text);
      Value value = run_->evaluate(s.arguments[1]);
      if (s.arguments[0].kind == Expression::Kind::field)  // $VEL.CP = SVEL_CP(...)
        if (const Value* part = value.field(s.arguments[0].text)) value = Value(*part);
      run_->assign(s.arguments[0], std::move(value));
    }
  move_now(kind, statement);
  for (auto& [name, kept] : before) run_->set(name, std::move(kept.first), kept.second);
}

void Krl::wait(const Statement& statement) {
  const Value time = run_->answered(statement.arguments[0]);
  if (!time.is_number()) {
    run_->ask_for(time, statement.place, "waits for a time that is known only while the robot runs",
                  "write it as a constant", "a time in s");
  } else if (statement.continued && !run_->program().instructions.empty()) {
    run_->note(statement.place, "CONTINUE: the time passes while the robot moves, and is not added to the motion",
               true);
  } else if (time.number > 0) {  // the controller does not wait for 0 and less
    run_->emit(dwell_of(time.number), statement);
  }
}

namespace {

/// Returns the last move if it ends in a blend; null: it does not.
Instruction* blending(Program& program) {
  auto& made = program.instructions;
  if (made.empty() || made.back().kind == Instruction::Kind::dwell) return nullptr;
  const MoveZone& zone = made.back().zone;
  return zone.distance > 0 || zone.percent > 0 ? &made.back() : nullptr;
}

}  // namespace

/// Removes the blend of the last move, because the controller waits for the robot. If a name may be a SIGNAL, gives a
/// warning instead.
void Krl::wait_for_robot(const Statement& statement) {
  Instruction* const before = blending(run_->program());
  if (!before) return;
  if (statement.arguments.empty()) {
    before->zone = {};
    return;
  }
  run_->note(statement.place,
             fmt::format(
                 "'{}' is declared in no file read: if it is a SIGNAL, the robot stops at the target before, where its "
                 "blend is taken; give the $config.dat that declares it",
                 statement.arguments[0].text),
             true);
}

void Krl::may_have_run(const Statement& statement, const Cause& why) {
  if (statement.name == advance_stop && !why.line.empty() && blending(run_->program()))
    run_->note(statement.place,
               fmt::format("the robot stops at the target before if the branch in {} leads here: its blend is taken",
                           why.line),
               true);
}

bool Krl::instruction(const Statement& statement) {
  const std::string& name = statement.name;
  if (const auto kind = kind_of(name)) return move(*kind, statement), true;
  if (name == "wait_sec") return wait(statement), true;
  if (name == advance_stop) return wait_for_robot(statement), true;
  if (name == "bas") return basics(statement), true;
  if (name.starts_with("interrupt_")) return interrupt(statement), true;
  if (name == "asyptp")
    return run_->note(statement.place, "ASYPTP: external axes move on their own, beside the robot", true), true;
  if (name == "rsi_movecorr") {
    numbers_.reset(), axes_.reset();
    lost_ = {};
    return run_->note(statement.place, "RSI_MOVECORR: a sensor leads the robot", true), true;
  }
  if (name == "trigger") {  // its action runs during a move, before or after the next statements
    const Statement& inner = statement.branches[0].body[0];
    const std::string why = fmt::format("is written by the TRIGGER in {}", run_->short_place(statement.place));
    if (inner.kind == Statement::Kind::assign)
      run_->make_unknown(inner.arguments[0], {"", why});
    else
      run_->forget_writes_of(inner, run_->module(), why);
    run_->note(statement.place, "TRIGGER: input, output or logic");
    return true;
  }
  if (name == "p00") {  // the line's controller gives the program number
    run_->make_unknown(name_at("pgno", statement.place),
                       {"", "is the program's number that the line's controller sends"});
    run_->note(statement.place, "P00: input, output or logic");
    return true;
  }
  return false;
}

// ---- the program ------------------------------------------------------------------------------------------

namespace {

/// Removes the external axes if all their positions are 0, because KUKA writes 0 for missing axes.
void leave_out_unused_axes(Program& program) {
  const auto unused = [](const Instruction& i) {
    return std::ranges::all_of(i.target.external_axes, [](double e) { return e == 0; });
  };
  if (std::ranges::all_of(program.instructions, unused))
    for (Instruction& instruction : program.instructions) instruction.target.external_axes.clear();
}

/// Returns the start routine: the requested one, else the first one of the first file or of its module; null: none.
const Routine* start_of(const Code& code) {
  if (code.start.empty()) {
    const Routine* of_module = nullptr;
    for (const Routine& routine : code.routines) {
      if (routine.place.file == 0) return &routine;
      if (!of_module && routine.module == 0) of_module = &routine;
    }
    return of_module;
  }
  if (const Routine* routine = code.find(code.start, -1)) return routine;
  for (const Routine& routine : code.routines)  // a local routine, if no global one has the name
    if (routine.name == code.start) return &routine;
  return nullptr;
}

}  // namespace

void run_krl(const Code& code, const ImportOptions& options, const std::vector<NamedFrame>& tools,
             const std::vector<NamedFrame>& work_objects, Program& program, Problems& problems) {
  const Routine* routine = start_of(code);
  if (!routine) {
    std::vector<std::string> names;
    for (const Routine& other : code.routines)
      if (names.size() < 40) names.push_back(other.written);
    if (options.routine.empty())  // routines of other files do not count
      problems.add({code.files.empty() ? "" : code.files[0].name(), 1, 1}, "holds no DEF",
                   "name the .src file that holds the program, or write DEF NAME() .. END");
    else
      problems.add(
          {code.files.empty() ? "" : code.files[0].name(), 1, 1}, fmt::format("has no routine '{}'", options.routine),
          names.empty() ? "give the .src file too" : fmt::format("name one of: {}", pipeline::joined(names, ", ")));
    return;
  }
  explore(
      [&](Exploration& exploration, Program& made, Problems& found) {
        Krl krl(code, tools, work_objects);
        Interpreter(code, krl, options, made, found, exploration).run(*routine);
        bend_splines(krl.spline_points(), made);
        leave_out_unused_axes(made);
      },
      program, problems);
}

}  // namespace dresslife::sim
