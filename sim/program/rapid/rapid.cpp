#include "sim/program/rapid/rapid.h"

#include <algorithm>
#include <map>
#include <numbers>

#include "pipeline/base/constants.h"
#include "pipeline/base/joined.h"
#include "pipeline/base/text.h"
#include "sim/program/interpreter/tokens.h"
#include "sim/program/rapid/dialect.h"
#include "sim/program/rapid/functions.h"
#include "sim/program/rapid/types.h"

namespace dresslife::sim {
namespace {

bool same(const std::string& lower, const std::string& written) { return lower == lower_case(written); }

/// The arguments of an instruction or of a function.
struct Arguments {
  std::string written;  ///< its name as RAPID's manual writes it
  int most;             ///< number of arguments without a name; -1: any number
  std::vector<std::string_view> switches;
};

/// Returns the arguments of the instructions and functions that change the motion or compute its numbers; null: another one.
const Arguments* arguments_of(const std::string& name) {
  static const std::map<std::string, Arguments> all = [] {
    std::map<std::string, Arguments> by_name;
    for (const std::string_view one : pipeline::words_in(
             "AccSet 2 FinePointRamp, VelSet 2, SpeedRefresh 1, WaitTime 1 InPos, PDispSet 1, PDispOff 0, PDispOn 2 "
             "Rot ExeP WObj, EOffsSet 1, EOffsOff 0, EOffsOn 1 ExeP, ConfL 0 On Off, ConfJ 0 On Off, Offs 4, RelTool "
             "4 Rx Ry Rz, CRobT 0 TaskRef TaskName Tool WObj, CPos 0 Tool WObj, CJointT 0 TaskRef TaskName, PoseMult "
             "2, PoseInv 1, PoseVect 2, Distance 2, DotProd 2, VectMagn 1, NOrient 1, OrientZYX 3, EulerZYX 1 X Y Z, "
             "DefFrame 3 Origin, Round 1 Dec, Trunc 1 Dec, RoundDnum 1 Dec, TruncDnum 1 Dec, Abs 1, Sqrt 1, Sin 1, "
             "Cos 1, Tan 1, ASin 1, ACos 1, ATan 1, ATan2 2, Exp 1, Pow 2",
             ",")) {
      const std::vector<std::string_view> words = pipeline::words_in(one);
      by_name[lower_case(words[0])] = {std::string(words[0]), words[1][0] - '0', {words.begin() + 2, words.end()}};
    }
    return by_name;
  }();
  const auto found = all.find(name);
  return found == all.end() ? nullptr : &found->second;
}

}  // namespace

std::optional<Value> Rapid::constant(const std::string& name) {
  if (name == "pi") return number_value(std::numbers::pi);
  if (name == "tool0") return tool_value(NamedFrame{});
  if (name == "wobj0") return work_object_value(NamedFrame{});
  if (name == "vmax") return rapid_speed(code_, "v7000");
  if (name == "load0") return rapid_initial(code_, "loaddata");
  if (name == "high" || name == "edge") return number_value(1);
  if (name == "low") return number_value(0);
  if (name == "op_undef" || name == "run_undef") return number_value(0);
  if (name == "op_auto" || name == "run_cont_cycle") return number_value(1);
  if (name == "op_man_prog" || name == "run_instr_fwd") return number_value(2);
  if (name == "op_man_test" || name == "run_instr_bwd") return number_value(3);
  static const std::map<std::string, double> dialogs{
      {"iconnone", 0},       {"iconinfo", 1},       {"iconwarning", 2}, {"iconerror", 3},      {"btnnone", -1},
      {"btnok", 0},          {"btnabrtrtryign", 1}, {"btnokcancel", 2}, {"btnretrycancel", 3}, {"btnyesno", 4},
      {"btnyesnocancel", 5}, {"resunkwn", 0},       {"resok", 1},       {"resabort", 2},       {"resretry", 3},
      {"resignore", 4},      {"rescancel", 5},      {"resyes", 6},      {"resno", 7}};
  if (const auto number = dialogs.find(name); number != dialogs.end()) return number_value(number->second);
  for (const NamedFrame& tool : tools_)
    if (same(name, tool.name)) return tool_value(tool);
  for (const NamedFrame& object : work_objects_)
    if (same(name, object.name)) return work_object_value(object);
  if (auto speed = rapid_speed(code_, name)) return speed;
  return rapid_zone(code_, name);
}

bool Rapid::matters(const std::string& name) const {
  static const pipeline::WordSet others = pipeline::word_set(
      "accset velset speedrefresh pdispset pdispon pdispoff eoffson eoffsset eoffsoff callbyvar confl confj");
  return rapid_move(name) || others.contains(name) || name.starts_with("move");
}

bool Rapid::harmless(const std::string& name) const { return is_harmless_in_rapid(name); }

bool Rapid::writes(const std::string& name, int position, const Expression& argument) const {
  static const pipeline::WordSet options = pipeline::word_set(
      "timeflag breakflag result str rawdata data value value1 value2 errornumber duration time norecbytes "
      "uielapsed bwd fwd index buttonanswer");
  if (!argument.option.empty()) return options.contains(argument.option);
  static const std::map<std::string, int> outputs{
      {"tpreadfk", 0},     {"tpreadnum", 0},    {"tpreaddnum", 0},    {"unpackrawbytes", 2}, {"readanybin", 1},
      {"readrawbytes", 1}, {"rmqfindslot", 0},  {"rmqgetmessage", 0}, {"rmqreadwait", 0},    {"rmqgetmsgdata", 1},
      {"getsysdata", 0},   {"packrawbytes", 1}, {"copyrawbytes", 2},  {"clearrawbytes", 0},  {"packdnheader", 2},
      {"readcfgdata", 2},  {"gettrapdata", 0},  {"camgetresult", 1},  {"clkread", -1},       {"bitset", 0},
      {"bitclear", 0},     {"getdataval", 1}};
  if (const auto found = outputs.find(name); found != outputs.end()) return found->second == position;
  return !harmless(name) && !rapid_named_effect(name) && !rapid_asks_the_robot(name);
}

Value Rapid::initial(const std::string& type) const { return rapid_initial(code_, type); }

/// Assigns a value. A single value for a record becomes unknown, because the controller stops at this assignment.
void Rapid::store(Value& place, Value value) const {
  if (place.type && value.kind != Value::Kind::list && value.kind != Value::Kind::unknown)
    value = forgotten(place, unknown_value("", fmt::format("is given a value that is no {}", place.type->name)).cause);
  place = std::move(value);
}

void Rapid::no_such_component(const Expression& target, const RecordType& record) {
  run_->unread(target.place, target.text, record.name, record.fields);
}

std::string Rapid::form_of(const std::string& type) const {
  static const std::map<std::string, const char*> forms{
      {"num", "a number"},
      {"dnum", "a number"},
      {"byte", "a number"},
      {"bool", "TRUE or FALSE"},
      {"string", "a text in double quotes"},
      {"pos", "[x, y, z] in mm"},
      {"orient", "[q1, q2, q3, q4]"},
      {"pose", "[[x, y, z], [q1, q2, q3, q4]] in mm"},
      {"robtarget", "[[x, y, z], [q1, q2, q3, q4], [cf1, cf4, cf6, cfx], [9E9, 9E9, 9E9, 9E9, 9E9, 9E9]] in mm"},
      {"jointtarget", "[[a1, a2, a3, a4, a5, a6], [9E9, 9E9, 9E9, 9E9, 9E9, 9E9]] in deg"},
      {"tooldata", "[TRUE, [[x, y, z], [q1, q2, q3, q4]], [1, [0, 0, 1], [1, 0, 0, 0], 0, 0, 0]] in mm"},
      {"wobjdata", "[FALSE, TRUE, \"\", [[x, y, z], [q1, q2, q3, q4]], [[0, 0, 0], [1, 0, 0, 0]]] in mm"},
      {"speeddata", "a speed's name (v100), or [mm/s, deg/s, 5000, 1000]"},
      {"zonedata", "a zone's name (z10, fine)"},
      {"robjoint", "[a1, a2, a3, a4, a5, a6] in deg"},
      {"extjoint", "[a, b, c, d, e, f] in mm or deg, 9E9 for axes that are not there"}};
  const auto found = forms.find(type);
  return found == forms.end() ? "" : found->second;
}

Value Rapid::tool_value(const NamedFrame& tool) const {
  Value value = rapid_initial(code_, "tooldata");
  value.items[0] = truth_value(!tool.stationary);
  value.items[1] = rapid_pose(code_, tool.frame);
  return value;
}

Value Rapid::work_object_value(const NamedFrame& object) const {
  Value value = rapid_initial(code_, "wobjdata");
  value.items[0] = truth_value(object.stationary);
  value.items[1] = truth_value(true);
  value.items[3] = rapid_pose(code_, object.frame);
  value.items[4] = rapid_pose(code_, Frame{});
  return value;
}

// ---- instructions -----------------------------------------------------------------------------------------

/// Runs AccSet acceleration, ramp; VelSet percent, largest; SpeedRefresh percent.
void Rapid::settings(const Statement& statement) {
  std::vector<Value> values;
  for (const Expression& argument : statement.arguments)
    if (argument.option.empty()) values.push_back(run_->answered(argument));
  const auto needed = [&](std::size_t i, double low, double high) {
    if (i < values.size() && values[i].is_number() && values[i].number >= low && values[i].number <= high)
      return values[i].number;
    const Value value = i < values.size() ? values[i] : Value{};
    run_->ask_for(value, statement.place,
                  fmt::format("gives {} no number in {} .. {} as argument {}", statement.text, low, high, i + 1),
                  "write it as a constant", fmt::format("a number in {} .. {}", low, high));
    return high;
  };
  if (statement.name == "accset") {
    acceleration_percent_ = std::max(20.0, needed(0, 0, 100));
    jerk_percent_ = std::max(10.0, needed(1, 0, 100));
  }
  if (statement.name == "speedrefresh") {
    const double percent = needed(0, 0, 100);
    if (percent > 0)
      override_ = percent / 100;
    else
      run_->note(statement.place, "SpeedRefresh 0: the robot stops until an interrupt starts it", true);
  }
  if (statement.name == "velset") {
    speed_factor_ = needed(0, 0.1, 100) / 100;
    speed_limit_ = needed(1, 0.1, 1e6) * millimetre;
  }
}

void Rapid::wait(const Statement& statement) {
  Value time;
  for (const Expression& argument : statement.arguments)
    if (argument.option.empty()) time = run_->answered(argument);
  if (time.is_number() && time.number < 0)
    run_->complain(statement.place, fmt::format("waits for {:g} s (must be 0 or more)", time.number),
                   fmt::format("write {:g} if the sign is a slip, or 0", -time.number));
  else if (!time.is_number() || !(time.number >= 0))
    run_->ask_for(time, statement.place, "waits for a time that is known only while the robot runs",
                  "write it as a constant", "a time in s");
  else if (time.number > 0)
    run_->emit(dwell_of(time.number), statement);
}

/// Runs Incr n; Decr n; Clear n; Add n, by.
bool Rapid::arithmetic(const Statement& statement) {
  const std::string& name = statement.name;
  const bool one = name == "incr" || name == "decr" || name == "clear";
  if (!one && name != "add") return false;
  if (statement.arguments.size() != (one ? 1 : 2)) {
    run_->complain(statement.place, fmt::format("gives {} another number of arguments", statement.text),
                   "correct the line");
    return true;
  }
  const Expression& target = statement.arguments[0];
  const Value before = run_->evaluate(target);
  const Value by = one ? number_value(name == "incr" ? 1 : -1) : run_->evaluate(statement.arguments[1]);
  if (name == "clear")
    run_->assign(target, number_value(0));
  else if (before.is_number() && by.is_number())
    run_->assign(target, number_value(before.number + by.number));
  else
    run_->assign(target, unknown_value(before.is_number() ? by : before));
  return true;
}

/// Runs GetDataVal "name", value or SetDataVal "name", value: access to data by a computed name.
bool Rapid::named_data(const Statement& statement) {
  const bool get = statement.name == "getdataval";
  if ((!get && statement.name != "setdataval") || statement.arguments.size() < 2) return false;
  const Value name = run_->evaluate(statement.arguments[0]);
  const Expression& value = statement.arguments.back();
  const Expression data = name_at(lower_case(name.text), statement.place);
  if (name.kind != Value::Kind::text || !run_->variable(data.text)) {
    if (get)
      run_->make_unknown(value, {"", "is read by GetDataVal under a name that no file read declares"});
    else
      run_->note(statement.place, "SetDataVal: it writes data whose name is not known offline", true);
    return true;
  }
  get ? run_->assign(value, run_->evaluate(data)) : run_->assign(data, run_->evaluate(value));
  return true;
}

/// Runs CONNECT. Interrupts are assumed not to happen. The data that the trap writes is unknown until the program writes it.
void Rapid::connect(const Statement& statement) {
  run_->note(statement.place, "CONNECT: input, output or logic");
  if (statement.branches.empty()) return;
  const Statement& call = statement.branches[0].body[0];
  run_->forget_writes_of(call, run_->module(),
                         fmt::format("may be written by the trap {} ({})", call.text, run_->short_place(call.place)));
  constexpr int deepest = 4;  // levels of calls in traps
  const auto steers = [&](const Statement& of) {
    return of.name == "stopmove" || of.name == "storepath" || matters(of.name);
  };
  if (code_.reaches({call}, run_->module(), deepest, steers))
    run_->note(statement.place,
               fmt::format("{0}: a trap that moves or stops the robot on its interrupt, which is taken not to come; "
                           "motion.routine: {0} reads it alone",
                           call.text),
               true);
}

bool Rapid::instruction(const Statement& statement) {
  const std::string& name = statement.name;
  if (const Signature* signature = rapid_move(name)) return move(*signature, statement);
  if (const Arguments* known = arguments_of(name))
    check_arguments(known->written, statement.arguments, known->most, known->switches);
  if (name == "accset" || name == "velset" || name == "speedrefresh") {
    settings(statement);
  } else if (name == "waittime") {
    wait(statement);
  } else if (name == "pdispset" || name == "pdispoff" || name == "pdispon") {
    displace(statement);
  } else if (name == "eoffsset" || name == "eoffsoff" || name == "eoffson") {
    shift_external_axes(statement);
  } else if (name == "confl" || name == "confj") {
    for (const Expression& argument : statement.arguments)
      (name == "confl" ? configuration_of_paths_ : configuration_of_joint_moves_) = argument.option != "off";
  } else if (name == "connect") {
    connect(statement);
  } else if (name == "callbyvar" && statement.arguments.size() == 2) {
    const Value routine = run_->evaluate(statement.arguments[0]);
    const Value number = run_->evaluate(statement.arguments[1]);
    if (routine.kind != Value::Kind::text || !number.is_number())
      run_->ask_for(unknown_value(routine, number), statement.place,
                    "runs a routine whose name is known only while the robot runs", "write its name",
                    "the number behind the routine's name");
    else
      run_->run_named(routine.text + fmt::format("{:g}", number.number), {}, statement.place);
  } else if (const char* effect = rapid_named_effect(name)) {
    run_->note(statement.place, fmt::format("{}: {}", statement.text, effect), true);
  } else {
    return arithmetic(statement) || named_data(statement);
  }
  return true;
}

// ---- functions --------------------------------------------------------------------------------------------

/// Returns Offs(target, x, y, z) in the work object or RelTool(target, x, y, z \Rx \Ry \Rz) in the tool [mm, deg].
Value Rapid::offset(const Expression& call, bool in_tool) {
  if (call.items.size() < 4) {
    run_->complain(call.place, fmt::format("gives {} too few arguments", call.text), "give a target and x, y, z");
    return {};
  }
  Value target = run_->evaluate(call.items[0]);
  if (!target.type && target.kind == Value::Kind::list) run_->shape(target, code_.record("robtarget"));
  double by[3], turn[3] = {0, 0, 0};
  Value unknown = target.known() ? Value{} : unknown_value(target);
  std::vector<Value> numbers;
  for (std::size_t i = 1; i < call.items.size(); ++i) {
    numbers.push_back(run_->evaluate(call.items[i]));
    if (!numbers.back().known()) unknown = unknown_value(unknown, numbers.back());
  }
  if (unknown.cause || !target.known()) return unknown;
  if (target.type != code_.record("robtarget")) return {};
  int k = 0;
  for (std::size_t i = 1; i < call.items.size(); ++i) {
    const Value& given = numbers[i - 1];
    if (given.known() && !given.is_number())
      run_->complain(call.items[i].place, fmt::format("gives {} no number as its argument {}", call.text, i + 1),
                     "correct the argument, or the call that gives its value");
    if (!given.is_number()) return unknown_value(given);
    const double number = given.number;
    const std::string& option = call.items[i].option;
    if (option.size() == 2 && option[0] == 'r' && option[1] >= 'x' && option[1] <= 'z')
      turn[option[1] - 'x'] = number * degree;
    else if (option.empty() && k < 3)
      by[k++] = number;
  }
  if (k < 3) return {};
  const auto q = checked(target.items[1], "a target", call.items[0]);
  if (!q)
    return unknown_value(run_->answer_name(run_->path_of(call.items[0])),
                         target == rapid_initial(code_, "robtarget") ? "was never given a value (all of it is 0)"
                                                                     : "has the quaternion [0,0,0,0]");
  Vector3 shift(by[0], by[1], by[2]);
  Quaternion turned = *q;
  if (in_tool) {  // RelTool: rotation about x, then y, then z of the tool
    shift = *q * shift;
    turned = *q * rotation({turn[0], 0, 0}) * rotation({0, turn[1], 0}) * rotation({0, 0, turn[2]});
  }
  for (int i = 0; i < 3; ++i) target.items[0].items[i].number += shift[i];
  target.items[1] = rapid_orient(code_, turned);
  return target;
}

/// Runs ok := StrToVal(text, value) for numbers and truth values; other data is unknown.
Value Rapid::text_to_value(const Expression& call) {
  const Value text = call.items.empty() ? Value{} : run_->evaluate(call.items[0]);
  if (call.items.size() != 2) return Value{};
  if (text.kind == Value::Kind::text) {
    const auto number = pipeline::whole_number_in<double>(text.text);
    const std::string word = lower_case(text.text);
    if (number && std::isfinite(*number)) return run_->assign(call.items[1], number_value(*number)), truth_value(true);
    if (word == "true" || word == "false")
      return run_->assign(call.items[1], truth_value(word == "true")), truth_value(true);
  }
  run_->make_unknown(call.items[1], {"", "is read from a text by StrToVal"});
  return text.known() ? Value{} : unknown_value(text);
}

std::optional<Value> Rapid::function(const Expression& call) {
  const std::string& name = call.text;
  if (const Arguments* known = arguments_of(name))
    check_arguments(known->written, call.items, known->most, known->switches);
  if (name == "offs") return offset(call, false);
  if (name == "reltool") return offset(call, true);
  if (name == "crobt" || name == "cjointt" || name == "cpos") return current_position(call);
  if (name == "opmode" && !run_->given(name)) return constant("op_auto");  // the motion is a production cycle
  if (name == "runmode" && !run_->given(name)) return constant("run_cont_cycle");
  if (name == "strtoval") return text_to_value(call);
  if (name == "present" && call.items.size() == 1) return truth_value(run_->present(call.items[0]));
  static const pipeline::WordSet signals =
      pipeline::word_set("dinput doutput ginput goutput ainput aoutput ginputdnum goutputdnum");
  if (signals.contains(name) && call.items.size() == 1) return run_->evaluate(call.items[0]);
  if (name == "testdi" && call.items.size() == 1) {
    const Value signal = run_->evaluate(call.items[0]);
    return signal.is_number() ? truth_value(signal.number != 0) : signal;
  }
  std::vector<RapidArgument> arguments;
  for (const Expression& argument : call.items)
    arguments.push_back(
        {argument.option, argument.kind == Expression::Kind::none ? Value{} : run_->evaluate(argument)});
  if (auto value = rapid_function(code_, name, arguments)) return value;
  if (name == "gettaskname") return unknown_value(name, "is the name of the task", form_of("string"));
  return rapid_asks_the_robot(name) ? std::optional(Value{}) : std::nullopt;
}

void run_rapid(const Code& code, const ImportOptions& options, const std::vector<NamedFrame>& tools,
               const std::vector<NamedFrame>& work_objects, Program& program, Problems& problems) {
  const std::string start = code.start.empty() ? "main" : code.start;
  const Routine* routine = code.find(start, -1);
  for (const Routine& other : code.routines)  // a local routine, if no global one has the name
    if (!routine && other.name == start) routine = &other;
  if (!routine && options.routine.empty() && code.routines.size() == 1) routine = &code.routines[0];
  if (!routine) {
    std::vector<std::string> names;
    for (const Routine& other : code.routines)
      if (names.size() < 40) names.push_back(other.written);
    problems.add({code.files.empty() ? "" : code.files[0].name(), 1, 1}, fmt::format("has no routine '{}'", start),
                 names.empty() ? "give the modules that hold its routines (motion.modules: [{file: FILE}])"
                               : fmt::format("name one in motion.routine: {}", pipeline::joined(names, ", ")));
    return;
  }
  explore(
      [&](Exploration& exploration, Program& made, Problems& found) {
        Rapid rapid(code, tools, work_objects);
        Interpreter(code, rapid, options, made, found, exploration).run(*routine);
      },
      program, problems);
}

}  // namespace dresslife::sim
