#include "sim/program/inform/inform.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "pipeline/base/constants.h"
#include "sim/program/fanuc/run.h"
#include "sim/program/interpreter/arc.h"
#include "sim/program/interpreter/job_words.h"
#include "sim/program/interpreter/tokens.h"

namespace dresslife::sim {
namespace {

/// Default position levels PL=0 .. 8 of the controllers (SC.PRM, S1CxG033 .. 040) [m].
constexpr double position_levels[] = {0, 0.0125, 0.025, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5};

/// Returns the unit of a variable behind a tag. A variable is an integer in the last digit that the tag shows: 0.1 mm/s for
/// V=I000, 0.1 mm for CR=I000, 0.01 % for VJ=I000, 0.01 s for T=I000, 1 for PL=B000 and ACC=I000.
double unit_of_variable(const std::string& tag) {
  return tag == "v" || tag == "vr" || tag == "cr" ? 0.1 : tag == "vj" || tag == "t" ? 0.01 : 1;
}

/// A position value of the tree (add_inform_types).
struct Position {
  std::vector<double> numbers;  ///< [pulses], [deg], or [mm] and [deg]
  std::string type;             ///< pulse, angle, base, robot, user
  int user = 0, tool = 0;
  std::vector<int> configuration;

  bool joints() const { return type == "pulse" || type == "angle"; }
  bool pose() const { return (type == "base" || type == "robot" || type == "user") && numbers.size() >= 6; }
};

std::optional<Position> position_in(const Value& value) {
  if (value.kind != Value::Kind::list || value.items.size() != 5 || !value.known()) return {};
  Position read;
  for (const Value& item : value.items[0].items) read.numbers.push_back(item.number);
  read.type = value.items[1].text;
  read.user = static_cast<int>(std::clamp(value.items[2].number, -1.0, 999.0));
  read.tool = static_cast<int>(std::clamp(value.items[3].number, -1.0, 999.0));
  for (const Value& item : value.items[4].items) read.configuration.push_back(item.number != 0);
  return read;
}

/// The form of a position that the user gives: the fields of its record in the tree.
constexpr const char* position_form =
    "[[x, y, z, Rx, Ry, Rz], \"base\", 0, TOOL NUMBER, [0, 0, 0, 0, 0, 0]] in mm and deg";

class Inform final : public Dialect {
 public:
  Inform(const Code& code, const std::vector<NamedFrame>& tools, const std::vector<NamedFrame>& frames,
         const Routine& start)
      : code_(code), tools_(tools), frames_(frames), robot_(start.robot) {}

  std::optional<Value> constant(const std::string& name) override {
    if (name == "on" || name == "off") return number_value(name == "on");
    if (std::optional<Value> value = run_->given(name)) return value;
    const std::string shown = upper_case(name);
    if (name.find('#') != std::string::npos) return unknown_value(shown, "is an input of the controller");
    if (!is_variable(name)) return {};
    return unknown_value(shown, "has its value in the controller (VAR.DAT of the backup)");
  }

  std::optional<Value> function(const Expression& call) override {
    if (call.items.size() != 1) return {};
    const Value value = run_->evaluate(call.items[0]);
    if (!value.is_number()) return unknown_value(value);
    if (call.text.ends_with("[]") || call.text.ends_with('#'))
      return run_->evaluate(name_at(indexed(call.text, value.number), call.place));
    if (call.text == "trunc") return number_value(std::trunc(value.number));
    if (call.text == "sin") return number_value(std::sin(value.number * degree));
    if (call.text == "cos") return number_value(std::cos(value.number * degree));
    if (call.text == "atan") return number_value(std::atan(value.number) / degree);
    if (call.text == "sqrt" && value.number >= 0) return number_value(std::sqrt(value.number));
    return {};
  }

  bool instruction(const Statement& statement) override {
    const std::string& name = statement.name;
    if (moves_inform_robot(name)) return move(statement), true;
    if (name == "speed") return speed(statement), true;
    if (name == "timer") return wait(statement), true;
    if (name == "spot" || name.starts_with("svspot")) return weld(statement), true;
    if (name == "sfton" || name == "sftof") return shift(statement), true;
    if (name == "settool" || name == "mframe") return set_frame(statement), true;
    if (name == "clear") return clear(statement), true;
    if (calculates(name)) return calculate(statement), true;
    if (name == "gete" && read_element(statement)) return true;
    if (name == "pstart") return start_beside(statement), true;
    if (name == "wvon")
      return run_->note(statement.place, "WVON: the torch swings about its path, which is followed without it", true),
             true;
    if (name.starts_with("job:")) {
      run_->forget_numbers(fmt::format("may be written by {}, which no file read holds ({})", statement.text,
                                       run_->short_place(statement.place)));
      run_->note(statement.place,
                 statement.text + ": not among the files read; variables may have other values behind it", true);
      return true;
    }
    if (const auto& given = statement.arguments;
        !given.empty() && given[0].kind == Expression::Kind::name && harmless(name) && !run_->variable(given[0].text) &&
        !run_->given(given[0].text) && is_variable(given[0].text))  // its value is in no file
      run_->set(given[0].text,
                unknown_value(upper_case(given[0].text), fmt::format("may be written by {} ({})", statement.text,
                                                                     run_->short_place(statement.place))));
    return false;
  }

  bool matters(const std::string& name) const override {
    return moves_inform_robot(name) || name == "speed" || name == "sfton" || name == "sftof" || name == "settool" ||
           name == "mframe" || name == "formcut" || name == "call" || name == "pstart";
  }
  bool only_waits(const std::string& name) const override { return name == "timer"; }
  bool harmless(const std::string& name) const override {
    static const pipeline::WordSet words = pipeline::word_set(
        "dout din wait pulse aout aration aratiof antout pause cwait msg advinit advstop arcon arcof arcset arccts "
        "arccte aweld vweld hand hsen guncl toolon toolof setualm dialog almchk tsync setreg getreg setfile getfile "
        "stroke strwait wvof refp gets gete getpos cnvrt mulmat invmat pwait val len asc mid cat val2str sqrt sin "
        "cos atan and or not xor shckset shckrst retry antstk replay skillsnd pop push");
    return words.contains(name);
  }
  bool writes(const std::string&, int position, const Expression&) const override { return position == 0; }
  const RecordType* type_of(const std::string& name) const override { return code_.record(name); }
  /// A job contains a copy of the controller's P variables. Their values are those at the time when the job was saved.
  std::optional<std::string> form_of_copies(const std::string& name) const override {
    return name.starts_with("p") ? std::optional<std::string>(position_form) : std::nullopt;
  }
  std::string form_of(const std::string& type) const override { return type == "number" ? "a number" : ""; }
  Value initial(const std::string& type) const override { return type == "number" ? number_value(0) : Value{}; }

  /// Returns the indices of the instructions that MOVC made -> whether the MOVC has FPT.
  const std::map<std::size_t, bool>& arc_points() const { return arc_points_; }

 private:
  static bool is_variable(const std::string& name) {
    return inform_name(name) == name && name.find_first_of("0123456789") != std::string::npos &&
           name.find('#') == std::string::npos;
  }
  static bool calculates(const std::string& name) {
    static const std::set<std::string> words{"set", "add", "sub", "mul", "div", "inc", "dec", "sete"};
    return words.contains(name);
  }

  /// Returns the name of an indexed variable: "b[]" and 3 give b003; "in#" and 3 give in#(3).
  static std::string indexed(const std::string& text, double index) {
    return inform_name(text.ends_with("[]") ? fmt::format("{}{:.0f}", text.substr(0, text.size() - 2), index)
                                            : fmt::format("{}({:.0f})", text, index));
  }

  void ask(const std::string& name, const Place& place, const std::string& what, const std::string& remedy,
           const std::string& form, Question::Kind kind = Question::Kind::value) {
    run_->miss(name, place, what, remedy, {{kind, name, form}});
  }

  /// Returns a number that a move or a wait needs. Asks for it if it is unknown.
  std::optional<double> needed(const Expression& written, const char* what) {
    const Value value = run_->answered(written);
    if (value.is_number()) return value.number;
    run_->ask_for(value, written.place, fmt::format("has a {} that is known only while the robot runs", what), "",
                  "a number");
    return {};
  }

  std::optional<double> tag(const Statement& statement, const char* option) {
    for (const Expression& argument : statement.arguments) {
      if (argument.option != option) continue;
      const auto number = needed(argument, option);
      if (!number || argument.kind == Expression::Kind::number) return number;
      const std::string_view name = option;
      if (name == "cr" || name == "acc" || name == "dec")
        run_->note(statement.place,
                   fmt::format("{}: a variable as {} is read in units of {} without a source; write the number into a "
                               "copy of the job if this is wrong",
                               statement.text, upper_case(option), name == "cr" ? "0.1 mm" : "1 %"),
                   true);
      return *number * unit_of_variable(option);
    }
    return {};
  }
  static const Expression* argument_of(const Statement& statement, const std::string& option) {
    for (const Expression& argument : statement.arguments)
      if (argument.option == option) return &argument;
    return nullptr;
  }

  // ---- frames -----------------------------------------------------------------------------------------------------

  /// Returns TL#(n) or UF#(n): the value of SETTOOL, MFRAME, TOOL.CND or UFRAME.CND, else that of the user.
  std::optional<NamedFrame> frame(bool tool, int number, const Place& place) {
    const std::string name = fmt::format("{}#({})", tool ? "TL" : "UF", number);
    if (const Value* value = run_->variable(lower_case(name))) {
      const auto read = position_in(*value);
      if (read && read->pose()) return NamedFrame{name, frame_of_fanuc(read->numbers)};
    }
    for (const NamedFrame& given : tool ? tools_ : frames_)
      if (same_word(given.name, name)) return given;
    ask(name, place, fmt::format("moves {} {}, which no file read holds", tool ? "with" : "in", name),
        fmt::format("give {} of the backup ({}), or motion.{} with the name '{}'", tool ? "TOOL.CND" : "UFRAME.CND",
                    modules_of_job, tool ? "tools" : "work_objects", name),
        "", tool ? Question::Kind::tool : Question::Kind::work_object);
    return {};
  }

  /// Executes SETTOOL TL#(1) P000 or MFRAME UF#(1) P000 P001 P002 (origin, a point on x, a point in the xy plane).
  void set_frame(const Statement& statement) {
    const auto& given = statement.arguments;
    std::vector<Position> points;
    for (std::size_t i = 1; i < given.size(); ++i)
      if (auto point = position_in(run_->evaluate(given[i])); point && point->pose() && point->type != "user")
        points.push_back(*std::move(point));
    const bool tool = statement.name == "settool";
    if (given.size() < 2 || points.size() + 1 != given.size() || (!tool && points.size() != 1 && points.size() < 3)) {
      if (!given.empty())
        run_->make_unknown(given[0], {"", fmt::format("is set by {} from positions that are not known ({})",
                                                      statement.text, run_->short_place(statement.place))});
      return;
    }
    std::vector<double> numbers = points[0].numbers;
    if (points.size() >= 3) {
      const auto at = [&](std::size_t i) {
        return Vector3(points[i].numbers[0], points[i].numbers[1], points[i].numbers[2]);
      };
      const Vector3 x = (at(1) - at(0)).normalized(), z = x.cross(at(2) - at(0)).normalized();
      Matrix3 axes;
      axes << x, z.cross(x), z;
      if (!axes.allFinite())
        return run_->complain(statement.place, "sets a frame by points that lie on a line", "correct the points");
      numbers = fanuc_values_of({millimetre * at(0), Quaternion(axes)});
    }
    Value value = run_->evaluate(given[1]);
    value.items[0].items.clear();
    for (const double number : numbers) value.items[0].items.push_back(number_value(number));
    run_->assign(given[0], std::move(value));
  }

  /// Executes SFTON P000 UF#(1), which shifts the positions of the following moves, or SFTOF, which ends the shift.
  void shift(const Statement& statement) {
    shift_.reset();
    if (statement.name == "sftof") return;
    if (statement.arguments.empty())
      return run_->note(statement.place, "SFTON: names no position, so the moves behind it are not shifted", true);
    shift_ = {statement.arguments[0],
              statement.arguments.size() > 1 ? frame_name(statement.arguments.back(), statement) : ""};
    shift_value_ = run_->evaluate(statement.arguments[0]);
  }

  /// Returns the name of the frame of a SFTON or IMOV: bf, rf, tf or uf#(1). Another one is read as bf, with a warning.
  std::string frame_name(const Expression& written, const Statement& statement) const {
    std::string name = written.text;
    if (written.kind == Expression::Kind::call && written.items.size() == 1)
      if (const auto number = run_->number(written.items[0])) name = indexed(name, *number);
    if (name == "bf" || name == "rf" || name == "tf" || name.starts_with("uf#(")) return name;
    run_->note(statement.place,
               fmt::format("{}: what {} does to the move is not read; read as BF", statement.text, upper_case(name)),
               true);
    return "bf";
  }

  /// Returns `pose` (tool in the robot's base frame) shifted by the numbers of `by` in the frame `frame_name`.
  std::optional<Frame> shifted(const Frame& pose, const Position& by, const std::string& frame_name,
                               const Place& place) {
    const Frame step = frame_of_fanuc(by.numbers);
    if (frame_name == "tf" || (frame_name.empty() && by.type == "tool")) return pose * step;
    Frame system;
    if (frame_name.starts_with("uf#") || (frame_name.empty() && by.type == "user")) {
      const int number = frame_name.empty() ? by.user : std::atoi(frame_name.c_str() + 4);
      const auto found = frame(false, number, place);
      if (!found) return {};
      system = found->frame;
    }
    const Quaternion turn = system.orientation * step.orientation * system.orientation.conjugate();
    return Frame{pose.position + system.orientation * step.position, turn * pose.orientation};
  }

  // ---- positions as targets ---------------------------------------------------------------------------------------

  /// Returns the counts per degree of the robot's axes. Empty: the user has not given them, and they are a question.
  std::vector<double> counts(const Place& place) {
    std::vector<double> read;
    if (const auto given = run_->given("pulses_per_degree");
        given && given->kind == Value::Kind::list && given->known())
      for (const Value& item : given->items)
        if (item.is_number() && item.number != 0) read.push_back(item.number);
    if (read.size() >= 4) return read;
    ask("pulses_per_degree", place,
        "moves to a position in pulses, and no file contains the pulses per degree of each axis",
        "give motion.values: [{name: pulses_per_degree, value: '[S,L,U,R,B,T]'}], counts with their signs: two positions of "
        "the pendant, shown once in pulses and once in degrees, give them",
        "[S, L, U, R, B, T], counts of a degree with their signs");
    return {};
  }

  bool read_joints(const Position& position, const Place& place, std::vector<double>& joints) {
    std::vector<double> per_degree(position.numbers.size(), 1);
    if (position.type == "pulse") {
      per_degree = counts(place);
      if (per_degree.empty()) return false;
    }
    for (std::size_t i = 0; i < position.numbers.size(); ++i) {
      if (i < per_degree.size() && (position.type == "pulse" || joints.size() < 6))
        joints.push_back(position.numbers[i] / per_degree[i] * degree);
      else if (position.numbers[i] != 0)
        return run_->complain(place, fmt::format("moves to a position of {} axes", position.numbers.size()),
                              "only the robot's own axes are read; pulses_per_degree has one value for each"),
               false;
    }
    if (joints.size() < per_degree.size() && position.type == "pulse")
      return run_->complain(place,
                            fmt::format("moves to a position of {} axes, and pulses_per_degree has {}",
                                        position.numbers.size(), per_degree.size()),
                            "give one count for each axis of the robot"),
             false;
    return true;
  }

  /// Converts RCONF to the configuration of the robot's kinematics. The meaning of its first number (wrist) depends on the
  /// controller (sim/program/inform/README.md). The user chooses it by rconf_flip. Default: the sign of axis B if RCONF has more than 8
  /// numbers, else axis R, with a warning.
  ArmConfiguration configuration(const Position& position, const Place& place) {
    if (position.configuration.size() < 6) return {};
    ArmConfiguration made{ArmConfiguration::Kind::motoman,
                          {position.configuration.begin(), position.configuration.begin() + 6}};
    const auto rule = run_->given("rconf_flip");
    const bool by_b = rule ? rule->text == "B" || rule->text == "b" : position.configuration.size() > 8;
    if (by_b) made.numbers[0] += 2;
    if (!rule && !flip_reported_) {
      flip_reported_ = true;
      constexpr std::array<const char*, 2> meanings{"axis R within 90 deg of its zero, as on an NX100",
                                                    "the sign of axis B, as on a YRC1000"};
      constexpr std::array<const char*, 2> answers{"\"R\"", "\"B\""};
      run_->note(place,
                 fmt::format("RCONF: its first number (flip) is taken as {}; controllers differ. If so, {} "
                             "confirms it; if it is {}, give {}",
                             meanings[by_b], values_of_job({"rconf_flip"}, answers[by_b]), meanings[!by_b],
                             values_of_job({"rconf_flip"}, answers[!by_b])),
                 true);
    }
    return made;
  }

  std::optional<Position> position(const Expression& written) {
    const Value value = run_->answered(written);
    if (auto read = position_in(value)) return read;
    run_->ask_for(
        value, written.place,
        fmt::format("moves to {}, which is known only while the robot runs", upper_case(written.text)),
        "give VAR.DAT of the backup (motion.modules: [{file: FILE}]), or the job that holds its value (///NPOS)",
        position_form);
    for (const int tool : tools_of_jobs()) frame(true, tool, written.place);  // asks for the tool in the same round
    return {};
  }

  /// Returns the numbers of the tools of all taught positions; {0} if no position is taught.
  std::set<int> tools_of_jobs() const {
    std::set<int> numbers;
    for (const Datum& datum : code_.data) {
      const std::vector<Expression>& written = datum.statement.arguments;
      const bool position = datum.statement.text == "position" && datum.statement.name.find('#') == std::string::npos &&
                            !written.empty() && written[0].items.size() == 5;
      if (const double tool = position ? written[0].items[3].number : -1; tool >= 0)
        numbers.insert(static_cast<int>(tool));
    }
    return numbers.empty() ? std::set<int>{0} : numbers;
  }

  /// The position of the robot: the last target.
  struct Reached {
    Position position;
    Frame base;  ///< pose of the tool in the robot's base frame, if `position` is a pose
  };

  /// Reads the target of a move. Stores the position that gives the number of the tool in `taught`, if it is known.
  bool read_target(const Statement& statement, Instruction& move, std::optional<Position>& taught) {
    const Expression* written = argument_of(statement, "");
    if (!written) return run_->complain(statement.place, "moves to no position", "teach it"), false;
    std::optional<Position> read = position(*written);
    if (!read) return false;
    if (statement.name == "imov") {
      const bool known = relative(statement, *read, move);
      if (known) taught = reached_->position;
      return known;
    }
    taught = read;
    Frame base;
    if (read->pose()) {
      const std::optional<NamedFrame> object =
          read->type == "user" ? frame(false, read->user, written->place) : std::optional(NamedFrame{});
      if (!object) return false;
      base = object->frame * frame_of_fanuc(read->numbers);
      if (!shift_onto(base, *written)) return false;
      if (read->type == "user") move.work_object = run_->frame_index(run_->program().work_objects, *object);
      move.target.pose = shift_ ? inverse(object->frame) * base : frame_of_fanuc(read->numbers);
      move.target.configuration = configuration(*read, written->place);
    } else if (!read->joints()) {
      return run_->complain(written->place, fmt::format("moves to a position of the type {}", read->type),
                            "teach it in pulses, BASE, ROBOT or USER"),
             false;
    } else if (shift_) {
      return run_->miss("SFTON", written->place,
                        "shifts a position that is given in pulses (SFTON): the place is known only with the robot",
                        "store the positions as BASE or USER (a relative job)"),
             false;
    } else if (!read_joints(*read, written->place, move.target.joints)) {
      return false;
    }
    reached_ = {*read, base};
    return true;
  }

  bool shift_onto(Frame& base, const Expression& written) {
    if (!shift_) return true;
    const auto by = position_in(shift_value_);
    if (!by || by->numbers.size() < 6 || by->joints()) {
      run_->ask_for(shift_value_, written.place, "is shifted by a position that is not known in mm",
                    "give the job or VAR.DAT that holds it", position_form);
      return false;
    }
    const auto moved = shifted(base, *by, shift_->second, written.place);
    if (moved) base = *moved;
    return moved.has_value();
  }

  /// Sets the target of IMOV P000 V=100.0 BF: the position of the robot plus `by`.
  bool relative(const Statement& statement, const Position& by, Instruction& move) {
    const Expression* system = argument_of(statement, "frame");
    if (reached_ && by.joints() && reached_->position.type == by.type && !system) {
      Position target = reached_->position;
      for (std::size_t i = 0; i < std::min(target.numbers.size(), by.numbers.size()); ++i)
        target.numbers[i] += by.numbers[i];
      reached_->position = target;
      return read_joints(target, statement.place, move.target.joints);
    }
    if (!reached_ || reached_->position.joints() || by.joints() || by.numbers.size() < 6)
      return run_->complain(statement.place,
                            reached_
                                ? "moves from joint angles by a distance in space (IMOV): the target is known only "
                                  "with the robot"
                                : "moves by a distance from the robot's start position (IMOV)",
                            "store the position before it as BASE or USER"),
             false;
    const auto moved = shifted(reached_->base, by, system ? frame_name(*system, statement) : "", statement.place);
    if (!moved) return false;
    reached_->base = move.target.pose = *moved;
    reached_->position.type = "base";
    return true;
  }

  bool read_tool(const Statement& statement, const Position& position, Instruction& move) {
    const bool free = statement.name == "movj" && position.joints() && move.zone.distance == 0;
    const std::string name = fmt::format("TL#({})", position.tool);
    const bool known = run_->variable(lower_case(name)) ||
                       std::ranges::any_of(tools_, [&](const NamedFrame& t) { return same_word(t.name, name); });
    if (free && !known) return true;  // a move of the axes does not need the tool
    const auto tool = frame(true, position.tool, statement.place);
    if (!tool) return false;
    if (tool->stationary || tool->frame.position != Vector3::Zero() || !tool->frame.orientation.vec().isZero(0))
      move.tool = run_->frame_index(run_->program().tools, *tool);
    return true;
  }

  // ---- moves ------------------------------------------------------------------------------------------------------

  void speed(const Statement& statement) {
    unread_words(statement);
    for (const char* option : {"vj", "v", "vr"})
      if (const auto number = tag(statement, option)) default_speed_[option] = *number;
  }

  std::optional<double> speed_of(const Statement& statement, const char* option) {
    if (argument_of(statement, option)) return tag(statement, option);
    const auto found = default_speed_.find(option);
    return found == default_speed_.end() ? std::nullopt : std::optional(found->second);
  }

  bool read_speed(const Statement& statement, Instruction& move) {
    const bool axes = move.kind == Instruction::Kind::joint;
    const char* option = axes ? "vj" : "v";
    auto number = speed_of(statement, option);
    const bool own = argument_of(statement, option), own_turn = !axes && argument_of(statement, "vr");
    if (!number && own) return false;  // tag() has asked for it
    if (own_turn && !own) number = std::nullopt;
    std::optional<double> turn;  // V or VR of the line replaces both of SPEED
    if (own_turn || (!axes && !own)) turn = speed_of(statement, "vr");
    if (!number && !turn) {
      if (const auto given = run_->given(option); given && given->is_number()) number = given->number;
      if (!number)
        return ask(option, statement.place, fmt::format("has no {}=, and no SPEED before it", axes ? "VJ" : "V"),
                   fmt::format("give {}, {}", values_of_job({option}, "NUMBER"), axes ? "in %" : "in mm/s"),
                   axes ? "a number, in %" : "a number, in mm/s"),
               false;
    }
    if (number && !(*number > 0))
      return run_->complain(statement.place, "has a speed that is not above 0", "correct the speed"), false;
    if (axes) move.speed.axis_percent = run_->within(*number, 0, 100, "VJ", statement.place);
    if (!axes && number) move.speed.tool = *number * unit_of_v(statement.place);
    if (turn && *turn > 0) move.speed.orientation = *turn * degree;
    return true;
  }

  /// Returns the unit of V= [m/s]: mm/s, the default of the controllers, or cm/min by the user's speed_unit.
  double unit_of_v(const Place& place) {
    const auto given = run_->given("speed_unit");
    if (!given && !unit_reported_)
      run_->note(place, std::string(unit_of_speeds) + "; where the controller counts cm/min give " +
                            values_of_job({"speed_unit"}, "\"cm/min\""));
    unit_reported_ = true;
    if (!given || given->text == "mm/s") return millimetre;
    if (given->text == "cm/min") return 10 * millimetre / 60;
    run_->complain(place, fmt::format("has '{}' as speed_unit", given->text), "give \"mm/s\" or \"cm/min\"");
    return millimetre;
  }

  bool read_zone(const Statement& statement, Instruction& move) {
    const auto radius = tag(statement, "cr"), level = tag(statement, "pl");
    if ((!radius && argument_of(statement, "cr")) || (!level && argument_of(statement, "pl"))) return false;
    constexpr double highest = std::size(position_levels) - 1;
    if (level && !(*level >= 0 && *level <= highest))
      return run_->complain(statement.place, fmt::format("has PL={} (0 .. 8)", *level), "correct the position level"),
             false;
    if (radius)
      move.zone.distance = std::max(0.0, *radius) * millimetre;
    else if (level)
      move.zone.distance = position_levels[static_cast<int>(*level)];
    else
      move.zone.percent = 100;  // the next move begins while this move brakes
    return true;
  }

  void move(const Statement& statement) {
    if (!of_this_robot(statement)) return;
    const std::string& name = statement.name;
    Instruction move;
    const bool spots = name == "svspotmov";
    const bool axes = name == "movj" || (spots && argument_of(statement, "vj"));
    move.kind = axes ? Instruction::Kind::joint : Instruction::Kind::linear;
    for (const char* option : {"acc", "dec"})
      if (const auto percent = tag(statement, option))
        move.acceleration_percent =
            std::min(move.acceleration_percent, run_->within(*percent, 1, 100, upper_case(option), statement.place));
    const Expression* station = argument_of(statement, "station");
    if (!argument_of(statement, "") && station)
      return run_->note(statement.place, statement.text + ": moves a station alone, not the robot", true);
    std::optional<Position> taught;
    const bool zone = read_zone(statement, move), speed = read_speed(statement, move);
    bool whole = read_target(statement, move, taught) && zone && speed;
    if (taught) whole &= read_tool(statement, *taught, move);
    if (!whole) return;
    externals(statement);
    notes(statement);
    if (name == "movc" || name == "smovc")
      arc_points_[run_->program().instructions.size()] = argument_of(statement, "fpt") != nullptr;
    if (const Expression* target = argument_of(statement, ""))
      run_->add_origin(move, "target", *target, upper_case(target->text));
    run_->emit(move, statement);
    if (spots) weld(statement);
  }

  /// Returns whether a move belongs to the robot of the start job. Notes moves of another robot (RB2); refuses moves of two.
  bool of_this_robot(const Statement& statement) {
    const Routine* job = nullptr;
    for (const Routine& routine : code_.routines)
      if (routine.module == run_->module()) job = &routine;
    const bool two = argument_of(statement, "other_robot") || (job && job->robot.find(',') != std::string::npos);
    if (two) {
      run_->miss("two robots", statement.place, "moves two robots at once",
                 "give a job that moves one of them (///GROUP1 RB1)");
      return false;
    }
    if (!job || job->robot.empty() || robot_.empty() || job->robot == robot_) return true;
    run_->note(statement.place, fmt::format("{}: moves {}, another robot than {}", statement.text, job->robot, robot_),
               true);
    return false;
  }

  /// Leaves base and station axes out of a move. Warns once if they do not stand still.
  void externals(const Statement& statement) {
    for (const char* option : {"base", "station"}) {
      const Expression* written = argument_of(statement, option);
      if (!written) continue;
      const auto at = position_in(run_->evaluate(*written));
      // Taught values of an axis that stands still differ by a few pulses.
      constexpr double same_place = 50;  // [pulses]; other positions: 0.05 mm or deg
      const auto& before = externals_[option];
      bool moved = !at || (!before.empty() && before.size() != at->numbers.size());
      for (std::size_t i = 0; !moved && i < before.size(); ++i)
        moved = std::abs(at->numbers[i] - before[i]) > (at->type == "pulse" ? same_place : same_place / 1000);
      if (moved && !reported_.contains(option))
        run_->note(statement.place,
                   fmt::format("{}: {} axes move with the robot, and are left out: the {} is taken to stand still",
                               statement.text, option, std::string_view(option) == "base" ? "robot's base" : "station"),
                   true);
      if (moved) reported_.insert(option);
      if (at && before.empty()) externals_[option] = at->numbers;
    }
  }

  void notes(const Statement& statement) {
    if (statement.name == "movs") run_->note(statement.place, "MOVS: a spline, read as straight lines", true);
    if (statement.name.starts_with("smov"))
      run_->note(statement.place, statement.text + ": the station turns the work meanwhile; it is taken to stand still",
                 true);
    if (argument_of(statement, "until"))
      run_->note(statement.place, statement.text + ": an input may end the move; it is taken to its end", true);
    unread_words(statement);
  }

  void unread_words(const Statement& statement) {
    for (const Expression& argument : statement.arguments)
      if (argument.option == "unknown")
        run_->note(statement.place,
                   fmt::format("{}: what {} does to the move is not read", statement.text, argument.text), true);
  }

  void wait(const Statement& statement) {
    if (statement.arguments.empty()) return;
    const Expression& written = statement.arguments[0];
    const auto number = needed(written, "time");
    if (number && *number < 0) return run_->complain(statement.place, "waits for a time below 0", "correct the time");
    if (!number || *number == 0) return;
    run_->emit(dwell_of(*number * (written.kind == Expression::Kind::number ? 1 : unit_of_variable("t"))), statement);
  }

  void weld(const Statement& statement) {
    if (run_->options().spot_time > 0) run_->emit(dwell_of(run_->options().spot_time), statement);
  }

  void start_beside(const Statement& statement) {
    const std::string job = statement.arguments.empty() ? "" : statement.arguments[0].text;
    run_->note(statement.place,
               fmt::format("{}: runs beside this job, and is left out; motion.routine: {} reads it alone",
                           statement.text, job.substr(std::min<std::size_t>(job.find(':') + 1, job.size()))),
               true);
    run_->forget_numbers(fmt::format("may be written by {}, which runs beside", statement.text));
  }

  // ---- variables --------------------------------------------------------------------------------------------------

  /// Executes CLEAR B003 10: sets 10 variables from B003 on to 0. CLEAR B003 ALL: all variables from B003 on.
  void clear(const Statement& statement) {
    const auto& given = statement.arguments;
    if (given.empty() || given[0].kind != Expression::Kind::name || given[0].text == "stack") return;
    const std::string& first = given[0].text;
    const std::size_t digits = std::min(first.find_first_of("0123456789"), first.size());
    if (digits == first.size()) return;
    constexpr int every = 1000;  // variable numbers are 000 .. 999
    const auto number =
        given.size() > 1 && given[1].text != "all" ? run_->number(given[1]) : std::optional<double>(every);
    const int from = std::atoi(first.c_str() + digits);
    const int count = static_cast<int>(std::clamp(number.value_or(1), 1.0, static_cast<double>(every)));
    for (int i = from; i < from + count && i < every; ++i)
      run_->assign(name_at(fmt::format("{}{:03}", first.substr(0, digits), i), statement.place), number_value(0));
  }

  /// Returns what one count of the number `which` of a position is in SETE and GETE: 1 pulse, 0.001 mm or 0.0001 deg.
  static double unit_of_element(const Position& position, double which) {
    return position.type == "pulse" ? 1 : which <= 3 ? 1e-3 : 1e-4;
  }

  /// Returns the variable that an instruction writes to: B003, or B[I000] with its number. Reports an unknown number.
  std::optional<Expression> target_of(const Expression& written, const Statement& statement) {
    if (written.kind != Expression::Kind::call) return written;
    const auto index = written.items.size() == 1 ? run_->number(written.items[0]) : std::nullopt;
    if (index) return name_at(indexed(written.text, *index), statement.place);
    run_->complain(statement.place, "writes to a variable whose number is known only while the robot runs",
                   "write its number");
    return {};
  }

  /// Executes GETE D000 P000 (3). Returns false if the position or the number is not known.
  bool read_element(const Statement& statement) {
    const auto& given = statement.arguments;
    const auto target = given.size() == 3 ? target_of(given[0], statement) : std::nullopt;
    if (!target) return given.size() == 3;
    const auto position = position_in(run_->evaluate(given[1]));
    const auto which = run_->number(given[2]);
    if (!position || !which || *which < 1 || *which > static_cast<double>(position->numbers.size())) return false;
    const double number = position->numbers[static_cast<std::size_t>(*which) - 1];
    run_->assign(*target, number_value(std::round(number / unit_of_element(*position, *which))));
    return true;
  }

  /// Executes calculations that are not assignments in the tree: arithmetic of positions, one number of a position (SETE),
  /// and variables with an index.
  void calculate(const Statement& statement) {
    const auto& given = statement.arguments;
    if (given.empty()) return;
    const auto written = target_of(given[0], statement);
    if (!written) return;
    const Expression& target = *written;
    const Value with = given.size() > 1 ? run_->evaluate(given.back()) : number_value(1);
    if (statement.name == "set") return run_->assign(target, with);
    Value value = run_->evaluate(target);
    const bool list = value.kind == Value::Kind::list && value.items.size() == 5;
    if (statement.name == "sete") {
      std::optional<double> which;
      if (given.size() == 3) which = run_->number(given[1]);
      const auto read = position_in(value);
      if (!which || !read || !with.is_number() || *which < 1 || *which > static_cast<double>(read->numbers.size()))
        return run_->make_unknown(target,
                                  {"", fmt::format("is set in part by SETE ({})", run_->short_place(statement.place))});
      const double unit = unit_of_element(*read, *which);
      value.items[0].items[static_cast<std::size_t>(*which) - 1] = number_value(with.number * unit);
      return run_->assign(target, std::move(value));
    }
    const auto combined = [&](double a, double b) {
      return statement.name == "sub" || statement.name == "dec" ? a - b
             : statement.name == "mul"                          ? a * b
             : statement.name == "div"                          ? a / b
                                                                : a + b;
    };
    const Value* by = list && with.kind == Value::Kind::list && with.items.size() == 5 ? &with.items[0] : nullptr;
    if (list && (by || with.is_number()) && value.known() && with.known()) {
      auto& numbers = value.items[0].items;
      for (std::size_t i = 0; i < numbers.size(); ++i)
        numbers[i].number = combined(numbers[i].number, !by                    ? with.number
                                                        : i < by->items.size() ? by->items[i].number
                                                                               : 0);
    } else if (value.is_number() && with.is_number()) {
      value.number = combined(value.number, with.number);
    } else {
      value = unknown_value(value.known() ? with : value);
    }
    const bool finite =
        value.kind == Value::Kind::unknown || (value.is_number() && std::isfinite(value.number)) ||
        (list && std::ranges::all_of(value.items[0].items, [](const Value& v) { return std::isfinite(v.number); }));
    run_->assign(target, finite ? std::move(value) : Value{});
  }

  const Code& code_;
  const std::vector<NamedFrame>& tools_;
  const std::vector<NamedFrame>& frames_;
  const std::string robot_;
  std::map<std::string, double> default_speed_;
  std::optional<std::pair<Expression, std::string>> shift_;  // position of SFTON and name of its frame
  Value shift_value_;
  std::optional<Reached> reached_;
  std::map<std::size_t, bool> arc_points_;
  std::map<std::string, std::vector<double>> externals_;  // "base", "station" -> first position of their axes
  std::set<std::string> reported_;
  bool unit_reported_ = false, flip_reported_ = false;
};

/// Converts consecutive MOVC to arcs. The first MOVC is a straight line to the first point of the circle. The second one
/// is an arc through the points (k-1, k, k+1), each further one through (k-2, k-1, k). FPT ends a circle.
void bend_arcs(const std::map<std::size_t, bool>& points, Program& program, Problems& problems) {
  auto& moves = program.instructions;
  for (auto first = points.begin(); first != points.end();) {
    auto last = first;
    while (!last->second && std::next(last) != points.end() && std::next(last)->first == last->first + 1) ++last;
    const std::size_t begin = first->first, end = std::min(last->first + 1, moves.size());
    const bool joined = first != points.begin() && std::prev(first)->second && std::prev(first)->first + 1 == begin;
    const std::size_t start =
        joined ? begin - 1 : begin;  // after FPT this circle begins at the last point of the previous one
    first = std::next(last);
    if (end <= start) continue;
    if (end - start < 3) {
      program.skipped.push_back(
          {moves[start].where, "MOVC: fewer than three points of a circle: read as straight lines", true});
      continue;
    }
    for (std::size_t k = start + 1; k < end; ++k) {
      const std::size_t third = k == start + 1 ? k + 1 : k - 2;
      Instruction& move = moves[k];
      const Instruction &before = moves[k - 1], &other = moves[third];
      const bool poses = move.target.joints.empty() && before.target.joints.empty() && other.target.joints.empty();
      const bool axes = !move.target.joints.empty() && !before.target.joints.empty() && !other.target.joints.empty();
      const bool together = move.tool == before.tool && move.tool == other.tool &&
                            move.work_object == before.work_object && move.work_object == other.work_object;
      if (!(poses || axes) || !together) {
        problems.add(move.where, "has a MOVC through positions of several kinds, tools or frames",
                     "store the positions of one circle in pulses, BASE or USER, with one tool");
        return;
      }
      if (axes) {
        move.kind = Instruction::Kind::circular;
        move.target.circle_joints = other.target.joints;
        continue;
      }
      const Vector3 a = before.target.pose.position, b = move.target.pose.position, c = other.target.pose.position;
      const auto arc = krl::arc_through(a, b, c);  // the order a, b, c: c is not between a and b
      if (!arc) continue;                          // points on a line: a straight move
      const Vector3 from = a - arc->centre;
      double angle = std::atan2(arc->axis.dot(from.cross(b - arc->centre)), from.dot(b - arc->centre));
      if (angle <= 0) angle += 2 * std::numbers::pi;
      move.kind = Instruction::Kind::circular;
      move.via = move.target.pose;
      move.via.position = arc->centre + Quaternion(Eigen::AngleAxisd(angle / 2, arc->axis)) * from;
    }
  }
}

/// Returns the start job: the requested one, else that of the first file; null: none.
const Routine* start_of(const Code& code) {
  for (const Routine& routine : code.routines)
    if (code.start.empty() ? routine.place.file == 0 : routine.name == "job:" + code.start) return &routine;
  return nullptr;
}

}  // namespace

void run_inform(const Code& code, const ImportOptions& options, const std::vector<NamedFrame>& tools,
                const std::vector<NamedFrame>& work_objects, Program& program, Problems& problems) {
  const Routine* start = start_of(code);
  if (!start && code.start.empty() && !code.problems.empty()) {
    const Problem& why = code.problems[0];
    return problems.add(why.where, why.what, why.remedy);
  }
  if (!start) {
    std::string names;
    for (const Routine& routine : code.routines)
      if (names.size() < 1000) names += (names.empty() ? "" : ", ") + routine.written;
    problems.add(
        {code.files[0].name(), 1, 1},
        options.routine.empty() ? std::string("holds no job") : fmt::format("has no job '{}'", options.routine),
        names.empty() ? "give a job (.JBI)" : fmt::format("name one of: {}", names));
    return;
  }
  explore(
      [&](Exploration& exploration, Program& made, Problems& found) {
        Inform inform(code, tools, work_objects, *start);
        Interpreter(code, inform, options, made, found, exploration).run(*start);
        if (found.empty()) bend_arcs(inform.arc_points(), made, found);
      },
      program, problems);
}

}  // namespace dresslife::sim
