// The result of every reader of robot programs: the moves in the order in which the controller runs them.
//
// Units are m, rad and s in all languages; quaternions are Eigen's. The pose of a target is the tool frame in the
// work object's frame. The work object's frame is given in the world (the robot's base frame, as on the
// controllers), the tool's frame in the flange frame. A stationary tool stands in the world and the robot carries
// the work object: then the tool's frame is given in the world and the work object's frame in the flange frame.
//
// Problems are collected during reading and reported together. Statements that a reader skips on purpose (input
// and output, messages, logic without moves) are listed with their lines.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/base/errors.h"
#include "sim/rod/rotation.h"

namespace dresslife::sim {

enum class Language { rapid, krl, fanuc, inform, urscript, joint_columns, ros_trajectory };

/// The arm configuration of a pose (one of several that reach it), in the numbers of its controller.
struct ArmConfiguration {
  enum class Kind { any, abb, kuka, fanuc, motoman, near };
  Kind kind = Kind::any;
  /// abb: quadrants of axes 1, 4, 6 and cfx. kuka: status, turn. fanuc: wrist flipped, arm up, arm in front
  /// (1 or 0), then the turns of axes 1, 4 and 6. motoman: the first six of RCONF: wrist (0, 1: axis R within
  /// 90 deg of its zero or not; 2, 3: axis B >= 0 or < 0), arm lower, behind, and whether axes R, T and S
  /// are 180 deg or more from zero. near: the configuration nearest to these axis angles [deg].
  std::vector<int> numbers;

  /// Returns "abb 0 -1 0 1", "kuka 2 35", "fanuc NUT 0 0 0", "motoman 1 0 0 0 0 0" or "near 0 -90 90 0 90 0";
  /// empty for Kind::any.
  std::string text() const;
  bool operator==(const ArmConfiguration&) const = default;
};

/// Reads a text of ArmConfiguration::text(). std::nullopt: not a configuration.
std::optional<ArmConfiguration> arm_configuration(const std::string& text);

/// The target of a move: joint angles, or a pose of the tool.
struct Target {
  std::vector<double> joints;         ///< [rad]; empty: the target is a pose
  Frame pose;                         ///< tool frame in the work object's frame
  ArmConfiguration configuration;     ///< arm configuration of the pose
  std::vector<double> external_axes;  ///< as programmed: [mm] of a linear axis, [deg] of a rotary one; empty: none
  std::vector<double> circle_joints;  ///< circular move to joint angles: a point of the circle outside of the arc [rad]
};

struct NamedFrame {
  std::string name;
  Frame frame;
  bool stationary = false;  ///< the tool stands in the world and the robot carries the work object
};

struct MoveSpeed {
  std::optional<double> axis_percent;       ///< share of each axis' largest speed [%]
  std::optional<double> axis;               ///< largest speed of the fastest axis [rad/s]
  std::optional<double> tool;               ///< largest speed of the tool's origin [m/s]
  std::optional<double> orientation;        ///< largest angular velocity of the tool [rad/s]
  std::optional<double> duration;           ///< duration of the whole move [s]
  std::optional<double> axis_acceleration;  ///< largest acceleration of the fastest axis [rad/s2]
  std::optional<double> tool_acceleration;  ///< largest acceleration of the tool's origin along its path [m/s2]
  double override_share = 1;                ///< KRL: $OV_PRO, which the speeds contain
};

struct MoveZone {
  double distance = 0;  ///< distance to the target at which the tool may leave its path [m]; 0 and percent 0: stop
  double percent = 0;   ///< share of the braking distance, if the controller blends by speed [%]
  /// angle to the target at which the tool may leave its turn [rad]; absent: the turn is cut by the same share as the path
  std::optional<double> turn{};
};

/// The place where a part of an instruction last got its value.
struct Origin {
  const char* part = "";  ///< "target", "tool", "work object", "speed", "acceleration", "zone", "via"
  std::string written;    ///< the part's text in the instruction: "p20", "Offs(p20, 0, 0, 10)"
  pipeline::Where where;  ///< place of the declaration or of the last assignment; line 0: not in the files
};

struct Instruction {
  enum class Kind { joint, linear, circular, dwell };
  Kind kind = Kind::joint;
  Target target;
  Frame via;             ///< circular move: the pose on the arc
  int tool = -1;         ///< index into Program::tools; -1: the flange
  int work_object = -1;  ///< index into Program::work_objects; -1: the world
  MoveSpeed speed;
  MoveZone zone;
  double acceleration_percent = 100, jerk_percent = 100;
  double dwell = 0;  ///< [s]
  pipeline::Where where;
  std::string routine;  ///< routine that contains the line
  std::string text;     ///< text of the line
  std::vector<Origin> origins;
};

/// Returns an instruction that stops the robot for `seconds` [s].
inline Instruction dwell_of(double seconds) {
  Instruction made;
  made.kind = Instruction::Kind::dwell;
  made.dwell = seconds;
  return made;
}

/// A statement that the reader skipped.
struct Skipped {
  pipeline::Where where;
  std::string what;       ///< the statement and the reason: "SetDO: input, output or logic"
  bool may_move = false;  ///< the statement may move the robot or change its motion
};

/// Words in Skipped::what for an endless loop whose later passes may differ from those that are kept.
inline constexpr const char* later_passes_differ = "later passes may differ";
/// First words of Skipped::what for speeds whose unit is set in the controller.
inline constexpr const char* unit_of_speeds = "note: V= counts mm/s";
/// First words of the reason in Skipped::what for a percentage above 100, which is read as 100.
inline constexpr const char* above_all_speed = "more than 100 % (limit 100, which counts)";
/// First words of the reason in Skipped::what for a position whose tool or user frame is not the active one.
inline constexpr const char* other_frame = "the position is taught in";
/// First words of the reason in Skipped::what for another number outside of the controller's range, whose nearest end counts.
inline constexpr const char* beyond_range = "outside of the controller's range";
std::string beyond_range_words(double low, double high);
/// Reason in Skipped::what for a relative move that is shorter than those of plants' programs. Robots repeat a position within
/// 0.05 mm, and numbers up to 1 mm are likely metres.
inline constexpr const char* tiny_move = "a relative move of less than 1 mm";
/// First words of the reason in Skipped::what for a speed in a unit that belongs to another kind of move.
inline constexpr const char* other_speed = "a speed of other moves";
/// First words of the reason in Skipped::what for a jump to a label that a program has twice.
inline constexpr const char* doubled_label = "stands twice in the program";
/// Reason in Skipped::what for the rest of an expression that is not read.
inline constexpr const char* unread_rest = "the rest of an expression is not read, so its value is unknown";

/// Reasons in Skipped::what for a tool and a work object of RAPID whose robhold do not fit together.
inline constexpr const char* two_robholds = "the robot holds the tool and the work object";
inline constexpr const char* no_robhold = "the tool stands in the cell, and no work object is held by the robot";

/// First words of reasons in Skipped::what for settings of KRL that are not read as the controller does.
inline constexpr const char* given_twice = "given twice in one position";
inline constexpr const char* unlike_turns = "two speeds of turns; the smaller one counts";
inline constexpr const char* reduced_speed = "a reduced speed that is not read";
inline constexpr const char* turn_acceleration = "a low acceleration of turns that is not read";
inline constexpr const char* fast_path = "a path speed above that of any robot";

/// First words of the reason in Skipped::what for a word that its instruction, function, record or system variable does not
/// have. The reader ignores the word. The nearest known word follows nearest_known.
inline constexpr const char* unread_word = "not read, because there is no such word in";
inline constexpr const char* nearest_known = "; the nearest one is ";
/// Returns the word with this reason. of: what does not have the word; known: its words. The nearest one has few other letters, or begins
/// with `word` (#CONST).
std::string unread_reason(const std::string& word, const std::string& of, const std::vector<std::string>& known);

/// Returns the value of a number in single precision, with which controllers compute; whole numbers up to 2^31 stay exact.
double as_single(double number);
/// Returns the shortest decimal number with the same value in single precision: 53.7, not 53.70000076.
double shortest_single(double number);

struct Program {
  std::string name;
  std::vector<Instruction> instructions;
  std::vector<NamedFrame> tools, work_objects;
  std::vector<Skipped> skipped;
  pipeline::Where start;  ///< the routine that was run
};

/// A value that the files do not contain and the user knows.
struct Question {
  enum class Kind { value, branch, tool, work_object };
  Kind kind = Kind::value;
  std::string name;         ///< key of the answer: "di1", "cell:p10", "UTOOL[1]"; for a branch: its line
  std::string form;         ///< form of the answer: "then or else", "a number"; empty: as in the program
  std::string preset = {};  ///< a safe answer; empty: none
};

struct Problem {
  pipeline::Where where;
  std::string what, remedy;
  std::string about = {};  ///< missing name; the problem is reported once for all uses of the name
  std::set<std::pair<std::string, int>> more_uses = {};  ///< file and line of each further use
  bool decision = false;                                 ///< the arm of a branch depends on `about`
  std::string routine = {};                              ///< routine that contains the line
  std::vector<Question> questions = {};  ///< their answers together solve the problem; empty: the files are wrong
  bool certain = true;                   ///< false: only some ways through the program have this problem
};

class Problems {
 public:
  /// Adds a problem. what: the fault of the routine or file: "moves to 'p9', which no file read declares".
  void add(const pipeline::Where& where, const std::string& what, const std::string& remedy,
           const std::string& routine = "");
  /// Adds a problem with `about` (the missing name, or the name that a branch depends on). Further uses of the same
  /// name are counted in the first problem.
  void add_use(Problem problem);
  /// Adds the problems of another reading of the same program.
  void add_all(const Problems& others);
  bool empty() const { return problems_.empty(); }
  bool full() const;             ///< the largest number of problems is reached
  bool asks() const;             ///< at least one problem has a question
  std::size_t mistakes() const;  ///< number of problems without a question
  const std::vector<Problem>& list() const { return problems_; }
  std::size_t count() const { return problems_.size(); }
  /// Appends `more` to the remedies of the problems from index `from` on.
  void hint(std::size_t from, const std::string& more);
  /// Returns the problems in the order of the files' lines.
  std::vector<Problem> sorted() const;
  /// Throws one Unread with all problems, one line for each, in the order of sorted().
  void throw_if_any() const;

 private:
  bool counted(const Problem& problem);

  std::vector<Problem> problems_;
};

/// Error: the program cannot be read before its files are corrected or its questions are answered.
class Unread : public pipeline::InputError {
 public:
  /// lines: one line for each problem after the first; each begins with a line end.
  Unread(const std::vector<Problem>& all, const std::string& lines)
      : InputError(all[0].where, all[0].what, all[0].remedy + lines), problems(all), lines_(lines) {}
  /// Returns a copy of the error with one more line at its end.
  Unread with(const std::string& line) const { return {problems, lines_ + "\n" + line}; }
  std::vector<Problem> problems;  ///< at least one, in the order of the files' lines

 private:
  std::string lines_;
};

enum class Assumption { then_branch, else_branch };

/// Returns the flange frame in the robot's base frame at six axis angles [rad].
using FlangeAt = std::function<Frame(const std::array<double, 6>&)>;

struct ImportOptions {
  std::string routine;  ///< first routine: "name" or "name(arguments)"; empty: the default of the language
  /// "file.mod:12" or "12" -> the arm of an undecided branch on that line.
  std::map<std::string, Assumption> assume;
  /// "file.mod:12" or "12" -> the value for an undecided TEST or SWITCH on that line.
  std::map<std::string, std::string> choose;
  /// Inputs, registers, persistent data, positions: name in the language's spelling -> value.
  std::map<std::string, std::string> values;
  /// Names in lower case that another program writes at the same time -> that program: "sps.sub".
  std::map<std::string, std::string> written_beside = {};
  int passes = 0;        ///< passes of an endless main loop; 0: until the loop repeats
  double spot_time = 1;  ///< dwell of a spot weld [s]
  /// The user named the first file as the program. Its routines have priority over routines of the same name in the
  /// other files of its folder, for example in an older copy.
  bool first_file_counts = false;
  FlangeAt flange = {};  ///< empty: the robot is not known
};

/// Limits of a program's size and work. A program that exceeds one of them is a problem, and its reading ends.
struct ImportLimits {
  static constexpr std::size_t file_bytes = 8u << 20;
  static constexpr std::size_t tokens = 2'000'000;
  static constexpr int nesting = 60;           ///< levels of nested expressions and of nested blocks
  static constexpr int calls = 60;             ///< levels of nested calls
  static constexpr long executed = 3'000'000;  ///< executed statements and values
  static constexpr long guessed = 200'000;     ///< those after a guess, which only serve to find questions
  static constexpr std::size_t instructions = 100'000;
  static constexpr std::size_t skipped = 20'000;
  static constexpr std::size_t values = 100'000;  ///< numbers in one variable; number of variables
  static constexpr int passes = 1000;             ///< passes of an endless loop in the search for its repetition
  /// The search for the repetition of an endless loop: a small part of the work that a program may need.
  static constexpr long searched_work = executed / 3;
  static constexpr std::size_t searched_moves = 20'000;
};

/// A source file in memory.
class SourceFile {
 public:
  SourceFile(std::string name, std::string text);

  const std::string& name() const { return name_; }
  const std::string& text() const { return text_; }
  /// Returns a line (counted from 1) without blanks at its ends, at most 200 characters; unprintable characters as '?'.
  std::string line(int number) const;
  /// Returns the rest of a line from a column (counted from 1) on, in the form of line().
  std::string from(int number, int column) const;

 private:
  std::string name_, text_;
  std::vector<std::size_t> starts_;  // index of the first character of each line
};

}  // namespace dresslife::sim
