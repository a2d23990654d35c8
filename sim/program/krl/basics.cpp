// The definitions of a controller's BAS.SRC and $CONFIG.DAT: the current frames, BAS and its cases, and the functions
// that the editor writes after WITH. Source: bas.src of KSS 5 to 8.
#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/program/interpreter/tokens.h"
#include "sim/program/krl/dialect.h"
#include "sim/program/krl/krl.h"

namespace dresslife::sim {

using namespace krl;

namespace {

const pipeline::WordSet harmless_names = pipeline::word_set(
    "wait halt interrupt trigger pulse signal ext extfct extp extfctp import enum struc channel anin anout brake "
    "resume cwrite cread copen cclose gripper err_raise err_clear eb_test sync on_error_proceed continue sread "
    "swrite sopen strclear stradd strcopy strfind h50 $timer $timer_flag clear_krlmsg ir_stopm $cycflag $in $anin "
    "$err ciostate");
constexpr const char* harmless_beginnings[] = {"eki_", "msg", "set_krl", "exists_krl", "diag_"};
/// Harmless functions that write to their arguments.
const pipeline::WordSet writing_names =
    pipeline::word_set("cread sread copen sopen swrite cwrite cclose strcopy stradd strclear msgdialog exists_krldlg");

/// Fields of an FDAT that inline forms use.
constexpr const char* fdat_fields[] = {".tool_no", ".base_no", ".ipo_frame"};

Value scaled(const Value& value, double factor) {
  return value.is_number() ? number_value(value.number * factor) : value;
}

/// Returns the smaller of a value and `most`, if both are known, else the value.
Value at_most(const Value& value, const std::optional<double>& most) {
  return value.is_number() && most && value.number > *most ? number_value(*most) : value;
}

}  // namespace

namespace krl {

Expression field_at(const std::string& name, const std::string& field, const Place& place) {
  return expression_at(place, Expression::Kind::field, field, {name_at(name, place)});
}

Expression element_at(const std::string& name, int index, const Place& place) {
  return expression_at(place, Expression::Kind::element, "", {name_at(name, place), number_at(place, index)});
}

}  // namespace krl

bool Krl::harmless(const std::string& name) const {
  return name == advance_stop || harmless_names.contains(name) ||
         std::ranges::any_of(harmless_beginnings, [&](const char* beginning) { return name.starts_with(beginning); });
}

bool Krl::writes(const std::string& name, int, const Expression&) const {
  if (kind_of(name) || name == "bas" || name == "asyptp") return false;  // moves read their targets
  const bool writing = writing_names.contains(name);
  return writing || name.starts_with("eki_") || !harmless(name);
}

// ---- values -----------------------------------------------------------------------------------------------

Value Krl::record(const std::array<double, 6>& numbers, const char* type) const {
  Value value = initial(type);
  for (std::size_t i = 0; i < 6 && i < value.items.size(); ++i) value.items[i] = number_value(numbers[i]);
  return value;
}

const RecordType* Krl::type_of(const std::string&) const { return nullptr; }  // store() applies the type

Value Krl::initial(const std::string& type) const { return prototype(type, 0); }

/// Returns the value of a variable before its first assignment: the lists of its type with unset values.
Value Krl::prototype(const std::string& type, int depth) const {
  constexpr int deepest = 6;  // levels of nested structures
  if (type == "signal") return unknown_value("", "is a signal of inputs or outputs");
  if (type == "import") return unknown_value("", "is imported from another module");
  Value value = unset_value();
  if (type == "int" || type == "real") {
    value.numeric = type == "int" ? Value::Numeric::integer : Value::Numeric::real;
    return value;
  }
  if (const auto known = prototypes_.find(type); known != prototypes_.end()) return known->second;
  const RecordType* record = depth < deepest ? code_.record(type) : nullptr;
  std::vector<Value> items;
  std::size_t weight = 0;
  for (std::size_t i = 0; record && i < record->fields.size() && weight < ImportLimits::values; ++i) {
    const Value item = prototype(record->field_types[i], depth + 1);
    const bool list = record->sizes[i] > 0 && record->field_types[i] != "char";  // a text is one value
    const std::size_t count = list ? static_cast<std::size_t>(record->sizes[i]) : 1;
    weight += count * item.weight();
    if (weight < ImportLimits::values) items.push_back(list ? list_value(std::vector<Value>(count, item)) : item);
  }
  if (record && weight < ImportLimits::values) value = list_value(std::move(items), record);
  return prototypes_.emplace(type, value).first->second;
}

namespace {

/// Whether a field is an external axis at zero. Such an axis stays at zero if an aggregate omits it.
bool is_idle_axis(const std::string& field, const Value& value) {
  return value.is_number() && value.number == 0 && std::ranges::find(external_names, field) != std::end(external_names);
}

}  // namespace

/// Assigns like the controller: components by their names; a REAL is rounded for an INT.
void Krl::store(Value& place, Value value) const {
  const bool both = place.kind == Value::Kind::list && value.kind == Value::Kind::list;
  if (both && place.type && value.type) {
    for (std::size_t i = 0; i < place.items.size() && i < place.type->fields.size(); ++i) {
      Value& item = place.items[i];
      if (const Value* part = value.field(place.type->fields[i]))
        store(item, *part);
      else if (!is_unset(item) && !is_idle_axis(place.type->fields[i], item))
        item = forgotten(item, unknown_value(place.type->fields[i], "is left out of the aggregate").cause);
    }
  } else if (both && !place.type && !value.type && place.items.size() == value.items.size()) {
    for (std::size_t i = 0; i < place.items.size(); ++i) store(place.items[i], value.items[i]);
  } else {
    const Value::Numeric numeric = place.numeric;
    place = std::move(value);
    if (numeric == Value::Numeric::any) return;
    if (const auto code = letter(place)) place = number_value(*code);
    place.numeric = numeric;
    if (place.is_number() && numeric == Value::Numeric::integer) place.number = std::round(place.number);
  }
}

namespace {

std::vector<std::string> upper_cases(std::vector<std::string> words) {
  for (std::string& word : words) word = upper_case(word);
  return words;
}

}  // namespace

/// Only aggregates with a component of a position are checked, and short names, because the STRUC of another aggregate may
/// be in a file that is not read.
void Krl::check_components(const Expression& aggregate) {
  const std::vector<std::string>& keys = aggregate.keys;
  constexpr std::size_t longest = 2;  // letters of a position's component
  const auto any = [&](const char* const(&names)[6]) {
    return std::ranges::any_of(
        keys, [&](const std::string& key) { return std::ranges::find(names, key) != std::end(names); });
  };
  const bool joint = any(axis_names);
  // $WORKSPACE and $CYLWORKSPACE: a frame, the numbers of a space (X1, R) and its MODE
  const bool space = std::ranges::find(keys, "x1") != keys.end() ||
                     std::ranges::any_of(keys, [](const std::string& key) { return key.size() > longest; });
  if (space || (!joint && !any(frame_names))) return;
  std::vector<std::string> missing;
  for (const std::string name : joint ? axis_names : frame_names)
    if (std::ranges::find(keys, name) == keys.end()) missing.push_back(name);
  for (auto key = keys.begin(); key != keys.end(); ++key) {
    const auto has = [&](const RecordType& record) {
      return std::ranges::find(record.fields, *key) != record.fields.end();
    };
    if (std::find(keys.begin(), key, *key) != key)
      run_->note(aggregate.place, fmt::format("{}: {}; the first one counts", upper_case(*key), given_twice), true);
    else if (std::ranges::none_of(code_.records, has))
      run_->unread(aggregate.place, upper_case(*key), "a position", upper_cases(missing));
  }
}

/// Only records whose components are all known are checked.
void Krl::no_such_component(const Expression& target, const RecordType& record) {
  static const std::set<std::string> whole{"cp", "cont", "frame", "pos", "e3pos", "e6pos", "axis", "e3axis", "e6axis"};
  if (whole.contains(record.name))
    run_->unread(target.place, upper_case(target.text), upper_case(run_->path_of(target.items[0])),
                 upper_cases(record.fields));
}

/// Returns the character code of a text of one letter, because a KRL CHAR is a number.
std::optional<double> Krl::letter(const Value& text) const {
  if (text.kind != Value::Kind::text || text.text.size() != 1) return {};
  return static_cast<unsigned char>(text.text[0]);
}

std::string Krl::form_of(const std::string& type) const {
  if (type == "int" || type == "real") return "a number";
  if (type == "bool") return "TRUE or FALSE";
  if (type == "char") return "a letter in double quotes";
  if (type == "frame") return "{X .., Y .., Z .., A .., B .., C ..} in mm and deg";
  if (type == "pos" || type == "e3pos" || type == "e6pos")
    return "{X .., Y .., Z .., A .., B .., C .., S .., T ..} in mm and deg";
  if (type == "pdat") return "{VEL .., ACC .., APO_DIST ..} in % and mm";
  if (type == "ldat") return "{VEL .., ACC .., APO_DIST ..} in m/s, % and mm";
  if (type == "fdat") return "{TOOL_NO .., BASE_NO .., IPO_FRAME #BASE}";
  if (type == "axis" || type == "e3axis" || type == "e6axis")
    return "{A1 .., A2 .., A3 .., A4 .., A5 .., A6 ..} in deg";
  return "";
}

/// An undeclared name is in $CONFIG.DAT, except in a module whose data list is missing.
bool Krl::shares(const std::string& name, int module) const {
  return name.starts_with("$") || code_.modules[module].whole;
}

/// Whether the editor of inline forms writes a name into the program's data list. Other undeclared names are assumed to
/// be in $CONFIG.DAT.
bool Krl::is_of_module(const std::string& name) const {
  static const std::set<std::string> of_all{"fhome", "xhome", "xhome1", "xhome2", "xhome3", "xhome4", "xhome5"};
  const auto numbered = [&](const char* beginning) {
    return name.starts_with(beginning) && !name.empty() && name.back() >= '0' && name.back() <= '9';
  };
  return !of_all.contains(name) && (name.starts_with("x") || name.starts_with("f") || numbered("ppdat") ||
                                    numbered("lcpdat") || numbered("cpdat") || numbered("pdat") || numbered("ldat"));
}

/// Returns the unknown value of an inline form with a question for its whole FDAT, PDAT or LDAT. The editor gives a new
/// PDAT and LDAT the values of PDEFAULT and LDEFAULT, which are the safe answers.
Value Krl::of_form(const Value& value, const char* type) const {
  const std::string kind = type, form = form_of(kind);
  const Cause* known = value.kind == Value::Kind::unknown ? value.cause.get() : nullptr;
  if (!known || known->name.empty() || known->behind || !known->others.empty() ||
      (!known->form.empty() && known->form != form) || known->name.find("_act") != std::string::npos)
    return value;
  Cause cause = *known;
  if (kind == "fdat")
    for (const std::string field : fdat_fields)
      if (cause.name.ends_with(field)) cause.name.resize(cause.name.size() - field.size());
  cause.form = form;
  cause.standard = kind == "pdat" ? "pdefault" : kind == "ldat" ? "ldefault" : "";
  return unknown_value(std::move(cause));
}

// ---- frames -----------------------------------------------------------------------------------------------

bool Krl::Frames::same(const Frames& other) const {
  const auto equal = [](const Frame& a, const Frame& b) {
    return a.position == b.position && a.orientation.coeffs() == b.orientation.coeffs();
  };
  return unknown.known() && other.unknown.known() && stationary == other.stationary && equal(tool, other.tool) &&
         equal(base, other.base);
}

Frame Krl::Frames::flange(const Frame& pose) const {
  if (!stationary) return base * pose * inverse(tool);
  return base * inverse(pose) *
         inverse(tool);  // the flange carries the work object at `tool`, the tool stands at `base`
}

Frame Krl::Frames::pose(const Frame& flange) const {
  if (!stationary) return inverse(base) * flange * tool;
  return inverse(flange * tool) * base;
}

/// Returns the user's frame for TOOL_DATA[n] or BASE_DATA[n], else an unknown value with this name. std::nullopt: another
/// name, or the files contain the frame.
std::optional<Value> Krl::named_frame(const std::string& path) {
  const bool tool = path.starts_with("tool_data["), base = path.starts_with("base_data[");
  if ((!tool && !base) || path.find_first_of(".]") != path.size() - 1) return {};
  const Value* list = run_->variable(path.substr(0, 9));
  const std::size_t index = static_cast<std::size_t>(std::clamp(std::atof(path.c_str() + 10), 0.0, 1e6));
  if (list && index >= 1 && index <= list->items.size() && !is_unset(list->items[index - 1])) return {};
  for (const NamedFrame& frame : tool ? tools_ : work_objects_)
    if (lower_case(frame.name) == path) return frame_value(frame.frame);
  if (std::optional<Value> given = run_->given(path)) return given;
  return unknown_value(fmt::format("{}[{}]", tool ? "TOOL_DATA" : "BASE_DATA", index), "is in no file read");
}

/// Returns TOOL_DATA[n] or BASE_DATA[n]; n <= 0 is the flange or the world.
Value Krl::numbered(const char* list, const Value& number) {
  if (!number.is_number()) return unknown_value(number);
  if (number.number <= 0) return frame_value(Frame{});
  return run_->evaluate(element_at(list, static_cast<int>(std::min(number.number, 1e6)), Place{}));
}

/// Returns the name of the element of TOOL_DATA or BASE_DATA with these numbers, preferably the current one; else $TOOL
/// or $BASE.
std::string Krl::name_of(const char* list, const std::array<double, 6>& numbers) {
  const bool tool = std::string(list) == "tool_data";
  const auto number = setting(tool ? "$act_tool" : "$act_base", "");
  const Value* data = run_->variable(list);
  std::string name;
  const auto add = [&](double index, const std::array<double, 6>& contents) {
    if (contents == numbers && (name.empty() || (number && *number == index)))
      name = fmt::format("{}[{}]", tool ? "TOOL_DATA" : "BASE_DATA", index);
  };
  for (std::size_t i = 0; data && i < data->items.size(); ++i)
    if (const Coordinates read = coordinates(data->items[i], frame_names); read.all())
      add(static_cast<double>(i + 1), read.numbers);
  for (const NamedFrame& frame : tool ? tools_ : work_objects_)
    if (const std::string path = lower_case(frame.name); path.starts_with(fmt::format("{}[", list)))
      add(std::atof(path.c_str() + 10), numbers_of(frame.frame));
  return name.empty() ? (tool ? "$TOOL" : "$BASE") : name;
}

/// Returns $TOOL or $BASE. Before an assignment the controller keeps an earlier value, which the user must give.
Frame Krl::current(const char* variable, const char* list, Frames& frames, std::string& name) {
  const Value* value = run_->variable(variable);
  Coordinates read = value ? coordinates(*value, frame_names) : Coordinates{};
  if (read.unknown.known() && !read.all())
    if (const std::optional<Value> held = run_->given(variable)) {
      const Coordinates given = coordinates(*held, frame_names);
      for (std::size_t i = 0; i < read.numbers.size(); ++i)
        if (!std::exchange(read.given[i], read.given[i] || given.given[i])) read.numbers[i] = given.numbers[i];
    }
  if (!read.all()) {
    Value& why = frames.unknown.known() ? frames.unknown : frames.base_too;
    const char* none = read.any() ? "is set in part only" : "is assigned nowhere before: the controller holds it";
    why = read.unknown.known() ? unknown_value(run_->answer_name(variable), none, form_of("frame")) : read.unknown;
    return {};
  }
  name = name_of(list, read.numbers);
  return frame_from(read.numbers);
}

Krl::Frames Krl::current_frames() {
  Frames frames;
  frames.tool_name = "$TOOL", frames.base_name = "$BASE";
  frames.unknown = frames.base_too = truth_value(true);
  frames.tool = current("$tool", "tool_data", frames, frames.tool_name);
  frames.base = current("$base", "base_data", frames, frames.base_name);
  const Value* mode = run_->variable("$ipo_mode");
  frames.stationary = mode && mode->kind == Value::Kind::text && mode->text == "#tcp";
  if (mode && mode->kind == Value::Kind::unknown && !is_unset(*mode) && frames.unknown.known()) frames.unknown = *mode;
  // $BASE is given in $WORLD; $ROBROOT is the robot's place in it.
  if (const Value* root = run_->variable("$robroot")) {
    if (const Coordinates place = coordinates(*root, frame_names); place.all())
      frames.base = inverse(frame_from(place.numbers)) * frames.base;
    else if (!place.unknown.known() && frames.unknown.known())
      frames.unknown = place.unknown;
  }
  return frames;
}

// ---- BAS --------------------------------------------------------------------------------------------------

/// Returns the speed [%] of an axis' largest speed, from a percentage of DEF_VEL_PTP.
Value Krl::axis_speed(const Value& percent) {
  return scaled(at_most(percent, 100), setting("def_vel_ptp", "").value_or(100) / 100);
}

/// Returns the acceleration [%] of an axis. Controllers that adapt accelerations to the load use the percentage itself,
/// others the percentage of DEF_ACC_PTP.
Value Krl::axis_acceleration(const Value& percent) {
  const Value* adapts = run_->variable("$adap_acc");
  const bool whole = !adapts || adapts->kind != Value::Kind::text || adapts->text != "#none";
  return whole ? at_most(percent, 100) : scaled(at_most(percent, 100), setting("def_acc_ptp", "").value_or(100) / 100);
}

Value Krl::path_speed(const Value& speed) {
  const auto most = setting("def_vel_cp", "");
  if (most && speed.is_number() && speed.number > *most) return number_value(*most);
  return scaled(speed, setting("def_vel_fact", "").value_or(1));
}

void Krl::set_axes(const char* list, const Value& percent, const Place& place) {
  for (int axis = 1; axis <= 6; ++axis) run_->assign(element_at(list, axis, place), percent);
}

void Krl::set_path_acceleration(const Value& percent, const Place& place) {
  const double whole = setting("def_acc_cp", "").value_or(standard_path_acceleration);
  run_->assign(field_at("$acc", "cp", place), scaled(at_most(percent, 100), whole / 100));
}

void Krl::use_tool(const Value& number, const Place& place) {
  run_->assign(name_at("$tool", place), numbered("tool_data", number));
  run_->assign(name_at("$act_tool", place), number);
}

void Krl::use_base(const Value& number, const Place& place) {
  run_->assign(name_at("$base", place), numbered("base_data", number));
  run_->assign(name_at("$act_base", place), number);
  if (!number.is_number() || number.number < 1) return;
  const auto machine = [&](const char* field, Expression whole) {
    return run_->evaluate(expression_at(place, Expression::Kind::field, field, {std::move(whole)}));
  };
  if (!run_->variable("machine_frame_dat") || !run_->variable("machine_def")) return;
  const Value unit = machine("mach_def_index", element_at("machine_frame_dat", static_cast<int>(number.number), place));
  if (!unit.is_number() || unit.number < 1) return;
  const Value kind = machine("mech_type", element_at("machine_def", static_cast<int>(unit.number), place));
  if (kind.kind == Value::Kind::text && kind.text != "#none" && kind.text != "#robot")
    run_->note(place, fmt::format("BASE_DATA[{}] lies on an external axis: it is taken to stand still", number.number),
               true);
}

/// Returns a part of FDAT_ACT, PDAT_ACT or LDAT_ACT.
Value Krl::part_of_form(const std::string& type, const char* field, const Place& place) {
  return of_form(run_->evaluate(field_at(type + "_act", field, place)), type.c_str());
}

void Krl::form_frames(const Place& place) {
  const auto part = [&](const char* field) { return part_of_form("fdat", field, place); };
  use_tool(part("tool_no"), place);
  use_base(part("base_no"), place);
  run_->assign(name_at("$ipo_mode", place), part("ipo_frame"));
}

void Krl::joint_data(const Place& place) {
  const auto part = [&](const char* field) { return part_of_form("pdat", field, place); };
  set_axes("$acc_axis", axis_acceleration(part("acc")), place);
  const Value distance = part("apo_dist");
  const Value mode = part("apo_mode");
  if (mode.kind == Value::Kind::text && mode.text == "#cdis")
    run_->assign(field_at("$apo", "cdis", place), distance);
  else
    run_->assign(field_at("$apo", "cptp", place), at_most(distance, 100));
}

void Krl::path_data(const Place& place) {
  const auto part = [&](const char* field) { return part_of_form("ldat", field, place); };
  set_path_acceleration(part("acc"), place);
  run_->assign(field_at("$apo", "cdis", place), part("apo_dist"));
  run_->assign(name_at("$ori_type", place), part("ori_typ"));
  run_->assign(name_at("$circ_type", place), part("circ_typ"));
}

/// Runs BAS(#INITMOV, 0): sets the initial values of $CONFIG.DAT. Only a missing speed is a question.
void Krl::initialise(const Place& place) {
  const auto standard = [&](const char* name) {
    const Value value = run_->evaluate(name_at(name, place));
    return value.known() ? value : unset_value();
  };
  set_axes("$acc_axis", axis_acceleration(number_value(100)), place);
  set_axes("$vel_axis", axis_speed(number_value(100)), place);
  set_path_acceleration(number_value(100), place);
  run_->assign(field_at("$vel", "cp", place), path_speed(run_->evaluate(name_at("def_vel_cp", place))));
  run_->assign(field_at("$vel", "ori1", place), standard("def_vel_ori1"));
  run_->assign(field_at("$vel", "ori2", place), standard("def_vel_ori2"));
  for (const char* field : {"cptp", "cdis", "cvel", "cori"})
    run_->assign(field_at("$apo", field, place), standard(fmt::format("def_apo_{}", field).c_str()));
  run_->assign(name_at("$ipo_mode", place), text_value("#base"));
  run_->assign(name_at("$ori_type", place), text_value("#var"));
  run_->assign(name_at("$circ_type", place), text_value("#base"));
  use_base(number_value(0), place);
  if (run_->variable("def_vel_cp") && !run_->variable("tool_data")) {
    run_->note(place, "BAS(#INITMOV) takes TOOL_DATA[1], which $CONFIG.DAT does not hold: the flange is taken", true);
    use_tool(number_value(0), place);
  } else {
    use_tool(number_value(1), place);
  }
}

void Krl::basics(const Statement& statement) {
  if (statement.arguments.empty()) return;
  const Place& place = statement.place;
  const std::string what = run_->evaluate(statement.arguments[0]).text;
  const Value number = statement.arguments.size() > 1 ? run_->evaluate(statement.arguments[1]) : Value{};
  static const pipeline::WordSet with_number =
      pipeline::word_set("#vel_ptp #acc_ptp #vel_cp #acc_cp #acc_glue #tool #base #ex_base #ptp_params #cp_params");
  if (statement.arguments.size() < 2 && with_number.contains(what))
    return run_->complain(place, fmt::format("has BAS({}) without a number", what),
                          fmt::format("write BAS({}, NUMBER)", what));
  const auto set_speed = [&](const Value& speed) { run_->assign(field_at("$vel", "cp", place), path_speed(speed)); };
  if (number.is_number() && number.number > 100 &&
      (what == "#vel_ptp" || what == "#acc_ptp" || what == "#acc_cp" || what == "#acc_glue" || what == "#ptp_params"))
    run_->note(place, fmt::format("BAS({}, {:g}): {}", what, number.number, above_all_speed), true);
  if (what == "#initmov") {
    initialise(place);
  } else if (what == "#vel_ptp") {
    set_axes("$vel_axis", axis_speed(number), place);
  } else if (what == "#acc_ptp") {
    set_axes("$acc_axis", axis_acceleration(number), place);
  } else if (what == "#vel_cp") {
    const auto most = setting("def_vel_cp", "");  // hides the slip; else the job warns of the speed
    if (number.is_number() && number.number > fastest_path && most && *most < number.number)
      run_->note(place, fmt::format("BAS({}, {:g}): {}", what, number.number, fast_path), true);
    set_speed(number);
  } else if (what == "#acc_cp" || what == "#acc_glue") {
    set_path_acceleration(number, place);
  } else if (what == "#tool") {
    use_tool(number, place);
  } else if (what == "#base" || what == "#ex_base") {
    use_base(number, place);
  } else if (what == "#frames") {
    form_frames(place);
  } else if (what == "#ptp_dat" || what == "#ptp_params") {
    joint_data(place);
    if (what == "#ptp_params") form_frames(place);
    const Value percent = what == "#ptp_params" ? number : part_of_form("pdat", "vel", place);
    set_axes("$vel_axis", axis_speed(percent), place);
  } else if (what == "#cp_dat" || what == "#cp_params") {
    path_data(place);
    if (what == "#cp_params") form_frames(place);
    set_speed(what == "#cp_params" ? number : part_of_form("ldat", "vel", place));
  } else if (!what.starts_with("#out_") && what != "#group") {
    run_->note(place, fmt::format("BAS({}): not a known case", what.empty() ? "?" : what), true);
  }
}

// ---- functions --------------------------------------------------------------------------------------------

/// Returns the value of a function that the editor writes after WITH; std::nullopt: another function.
std::optional<Value> Krl::spline_function(const Expression& call, const std::vector<Value>& values) {
  const std::string& name = call.text;
  const auto is = [&](std::initializer_list<const char*> names) {
    return std::ranges::any_of(names, [&](const char* other) { return name == other; });
  };
  const bool of_whole = !call.items.empty() && call.items[0].kind == Expression::Kind::field;
  const char* data = is({"stool2"}) || (of_whole && is({"sbase", "sipo_mode"})) ? "fdat"
                     : is({"sacc_joint", "sapo_ptp"})                           ? "pdat"
                     : is({"sacc_cp", "sapo", "sori_typ", "scirc_typ"})         ? "ldat"
                                                                                : "";
  const Value first = values.empty() ? Value{} : *data ? of_form(values[0], data) : values[0];
  const auto part = [&](const Value& whole, const char* field) {
    const Value* value = whole.field(field);
    return value ? *value : unknown_value(whole);
  };
  const auto with = [&](const char* type, std::initializer_list<std::pair<const char*, Value>> fields) {
    Value value = initial(type);
    for (const auto& [field, content] : fields)
      if (const Value* place = value.field(field)) store(const_cast<Value&>(*place), content);
    return value;
  };
  if (name == "svel_joint" || name == "sacc_joint") {
    const bool speed = name == "svel_joint";
    const Value percent = speed ? axis_speed(first) : axis_acceleration(part(first, "acc"));
    set_axes(speed ? "$vel_axis" : "$acc_axis", percent, call.place);
    return percent;
  }
  if (name == "svel_cp")
    return with("cp", {{"cp", at_most(first, setting("def_vel_cp", ""))},
                       {"ori1", run_->evaluate(name_at("def_vel_oris", call.place))}});
  if (name == "sacc_cp") {
    const double whole = setting("def_acc_cp", "").value_or(standard_path_acceleration);
    return with("cp", {{"cp", scaled(at_most(part(first, "acc"), 100), whole / 100)}});
  }
  if (name == "sapo") return with("cont", {{"cdis", part(first, "apo_dist")}, {"cptp", number_value(100)}});
  if (name == "sapo_ptp") {
    const bool by_distance = part(first, "apo_mode").text == "#cdis";
    return with("cont", {{"cdis", by_distance ? part(first, "apo_dist") : number_value(1e6)},
                         {"cptp", by_distance ? number_value(100) : part(first, "apo_dist")}});
  }
  if (name == "stool2") {
    run_->assign(name_at("$act_tool", call.place), part(first, "tool_no"));
    run_->assign(name_at("$act_base", call.place), part(first, "base_no"));
    return numbered("tool_data", part(first, "tool_no"));
  }
  if (name == "stool") return numbered("tool_data", first);
  if (name == "sbase") return numbered("base_data", first);
  if (name == "sipo_mode") return first.kind == Value::Kind::list ? part(first, "ipo_frame") : first;
  if (name == "sori_typ") return part(first, "ori_typ");
  if (name == "scirc_typ") return part(first, "circ_typ");
  if (name == "sgear_jerk") {
    const Value* percent = first.field("gear_jerk");
    if (!percent || !percent->is_number()) return unset_value();
    set_axes("$gear_jerk", at_most(*percent, 100), call.place);
    return *percent;
  }
  if (name == "sjerk") {
    const Value* percent = first.field("jerk_fac");
    if (!percent || !percent->is_number()) return unset_value();
    const double whole = setting("def_jerk_struc", "cp").value_or(standard_path_jerk);
    return with("jerk_struc", {{"cp", scaled(at_most(*percent, 100), whole / 100)}});
  }
  for (const char* other : {"sload", "scirc_m", "s_exax_ign"})
    if (name == other) return unset_value();
  return {};
}

/// Returns VARSTATE("name"). A name that no file declares may be in a missing file.
Value Krl::state_of(const Value& name) {
  if (name.kind != Value::Kind::text) return unknown_value(name);
  const Value* value = run_->variable(lower_case(name.text));
  if (!value)
    return run_->variable("def_vel_cp") ? text_value("#unknown") : unknown_value(name.text, "is in no file read");
  if (is_unset(*value)) return text_value("#declared");
  return value->known() ? text_value("#initialized") : unknown_value(*value);
}

std::optional<Value> Krl::arithmetic(const Expression& call, const std::vector<Value>& values) {
  const double x = values.size() == 1 && values[0].is_number() ? values[0].number : NAN;
  const auto finite = [&](double y) {
    return std::isfinite(y) ? number_value(y) : values.empty() ? Value{} : unknown_value(values[0]);
  };
  if (call.text == "abs") {
    Value absolute = finite(std::abs(x));
    if (!values.empty()) absolute.numeric = values[0].numeric;
    return absolute;
  }
  if (call.text == "sqrt") return finite(std::sqrt(x));
  if (call.text == "sin") return finite(std::sin(x * degree));
  if (call.text == "cos") return finite(std::cos(x * degree));
  if (call.text == "tan") return finite(std::tan(x * degree));
  if (call.text == "acos") return finite(std::acos(x) / degree);
  if (call.text == "atan2" && values.size() == 2 && values[0].is_number() && values[1].is_number())
    return finite(std::atan2(values[0].number, values[1].number) / degree);
  return {};
}

std::optional<Value> Krl::function(const Expression& call) {
  static const std::set<std::string> known{
      ":",          "inv_pos", "abs",        "sqrt",      "sin",     "cos",        "tan",   "acos",       "atan2",
      "svel_joint", "svel_cp", "sacc_joint", "sacc_cp",   "sapo",    "sapo_ptp",   "stool", "stool2",     "sbase",
      "sipo_mode",  "sload",   "sori_typ",   "scirc_typ", "scirc_m", "sgear_jerk", "sjerk", "s_exax_ign", "varstate"};
  if (!known.contains(call.text)) return {};
  std::vector<Value> values;
  for (const Expression& argument : call.items) values.push_back(run_->evaluate(argument));
  if (call.text == ":" || call.text == "inv_pos") {  // ":": the second frame is given in the first
    Frame product;
    for (const Value& value : values) {
      const Coordinates read = coordinates(value, frame_names);
      if (!read.unknown.known() || !read.any()) return unknown_value(read.unknown.known() ? value : read.unknown);
      product = product * frame_from(read.numbers);
    }
    return frame_value(call.text == ":" ? product : inverse(product));
  }
  if (call.text == "varstate") return state_of(values.empty() ? Value{} : values[0]);
  if (auto value = arithmetic(call, values)) return value;
  return spline_function(call, values);
}

}  // namespace dresslife::sim
