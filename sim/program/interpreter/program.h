// What every reader of robot programs gets from a file: the moves in the order in which the controller runs
// them.
//
// Lengths are m, angles rad, times s, whatever the language writes; quaternions are Eigen's. A pose is that
// of the tool frame in the work object's frame, the work object's that in the world (the robot's base frame,
// as the controllers take it), the tool's that in the flange frame. A stationary tool stands in the world and
// the robot carries the work object: then the tool's frame is that in the world and the work object's that in
// the flange.
//
// Problems are collected while reading and reported all at once; what a reader leaves out on purpose (input and
// output, messages, logic without moves) is listed with its line.
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

/// Which of the arms that reach a pose is meant, in the words of its controller.
struct ArmConfiguration {
  enum class Kind { any, abb, kuka, fanuc, motoman, near };
  Kind kind = Kind::any;
  /// abb: quadrants of axes 1, 4, 6 and cfx. kuka: status, turn. fanuc: wrist flipped, arm up, arm in front
  /// (1 or 0), then the turns of axes 1, 4 and 6. motoman: the first six of RCONF: wrist (0, 1: axis R within
  /// 90 deg of its zero or not; 2, 3: axis B at 0 or above, or below), arm lower, behind, and whether axes R, T
  /// and S stand 180 deg or more from zero. near: the arm nearest to these angles of the axes [deg].
  std::vector<int> numbers;

  /// "abb 0 -1 0 1", "kuka 2 35", "fanuc NUT 0 0 0", "motoman 1 0 0 0 0 0", "near 0 -90 90 0 90 0"; empty for
  /// any.
  std::string text() const;
  bool operator==(const ArmConfiguration&) const = default;
};

/// Reads what text() writes. Empty: not a configuration.
std::optional<ArmConfiguration> arm_configuration(const std::string& text);

/// Where a move leads: joint angles, or a pose of the tool.
struct Target {
  std::vector<double> joints;         ///< [rad]; empty: a pose
  Frame pose;                         ///< of the tool in the work object
  ArmConfiguration configuration;     ///< of a pose
  std::vector<double> external_axes;  ///< as programmed, mm or deg as the axis is; empty: none
  std::vector<double> circle_joints;  ///< of a circular move to joint angles: a point of its circle beyond its way [rad]
};

struct NamedFrame {
  std::string name;
  Frame frame;
  bool stationary = false;  ///< of a tool: it stands in the world, the robot carries the work object
};

struct MoveSpeed {
  std::optional<double> axis_percent;  ///< of each axis' largest speed [%]
  std::optional<double> axis;          ///< largest of the fastest axis [rad/s]
  std::optional<double> tool;          ///< largest of the tool's origin [m/s]
  std::optional<double> orientation;   ///< largest of the tool's rotation [rad/s]
  std::optional<double> duration;      ///< of the whole move [s]
  std::optional<double> axis_acceleration;  ///< largest of the fastest axis [rad/s2]
  std::optional<double> tool_acceleration;  ///< largest of the tool's origin along its path [m/s2]
};

struct MoveZone {
  double distance = 0;  ///< the tool may leave its path this near to the target [m]; 0 and percent 0: stop
  double percent = 0;  ///< of the way in which the robot would stop, where the controller blends by speed [%]
};

/// Where a part of an instruction was last given its value.
struct Origin {
  const char* part = "";  ///< "target", "tool", "work object", "speed", "zone", "via"
  std::string written;    ///< in the instruction: "p20", "Offs(p20, 0, 0, 10)"
  pipeline::Where where;  ///< of its declaration or of the last assignment; line 0: nowhere in the files
};

struct Instruction {
  enum class Kind { joint, linear, circular, dwell };
  Kind kind = Kind::joint;
  Target target;
  Frame via;             ///< of a circular move: the pose on the way
  int tool = -1;         ///< index into Program::tools; -1: the flange
  int work_object = -1;  ///< index into Program::work_objects; -1: the world
  MoveSpeed speed;
  MoveZone zone;
  double acceleration_percent = 100, jerk_percent = 100;
  double dwell = 0;  ///< [s]
  pipeline::Where where;
  std::string routine;  ///< that holds the line
  std::string text;     ///< of the line
  std::vector<Origin> origins;
};

/// The robot stands still for so long [s].
inline Instruction dwell_of(double seconds) {
  Instruction made;
  made.kind = Instruction::Kind::dwell;
  made.dwell = seconds;
  return made;
}

/// Something that the reader left out.
struct Skipped {
  pipeline::Where where;
  std::string what;       ///< "SetDO: input, output or logic": what it is, then why it is left out
  bool may_move = false;  ///< whether it may move the robot or change its motion
};

/// Begin of the reason of such a line: a percentage that counts as 100.
inline constexpr const char* above_all_speed = "more than 100 % (limit 100, which counts)";

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
  std::string name;  ///< under which the answer is given: "di1", "cell:p10", "UTOOL[1]"; of a branch its line
  std::string form;  ///< how an answer is written: "then or else", "a number"; empty: as in the program
  std::string preset = {};  ///< an answer that is safe; empty: there is none
};

struct Problem {
  pipeline::Where where;
  std::string what, remedy;
  std::string about = {};  ///< missing name of a problem that is reported once for all of its uses
  std::set<std::pair<std::string, int>> more_uses = {};  ///< files and lines
  bool decision = false;                                 ///< how a branch goes that depends on `about`
  std::string routine = {};                              ///< that holds the line
  std::vector<Question> questions = {};  ///< that solve it together; empty: the files must be mended
  bool certain = true;                   ///< false: only some ways through the program meet it
};

class Problems {
 public:
  /// `what` says what the routine, or the file, does wrong: "moves to 'p9', which no file read declares".
  void add(const pipeline::Where& where, const std::string& what, const std::string& remedy,
           const std::string& routine = "");
  /// One with `about`: what is missing, or what a branch depends on. Further uses of the same are counted behind
  /// the first one.
  void add_use(Problem problem);
  /// Those of another reading of the same program.
  void add_all(const Problems& others);
  bool empty() const { return problems_.empty(); }
  bool full() const;  ///< the largest number of problems is reached
  bool asks() const;  ///< one of them has a question
  std::size_t mistakes() const;  ///< those that have none
  const std::vector<Problem>& list() const { return problems_; }
  std::size_t count() const { return problems_.size(); }
  /// Adds to the remedies of those from the given one on.
  void hint(std::size_t from, const std::string& more);
  /// In the order of the files' lines.
  std::vector<Problem> sorted() const;
  /// Throws one Unread that words every problem on a line of its own, in that order.
  void throw_if_any() const;

 private:
  bool counted(const Problem& problem);

  std::vector<Problem> problems_;
};

/// A program that cannot be read before its files are mended or its questions are answered.
class Unread : public pipeline::InputError {
 public:
  /// lines: of the problems behind the first, each begins with a line end.
  Unread(const std::vector<Problem>& all, const std::string& lines)
      : InputError(all[0].where, all[0].what, all[0].remedy + lines), problems(all), lines_(lines) {}
  /// The same with a line more at the end.
  Unread with(const std::string& line) const { return {problems, lines_ + "\n" + line}; }
  std::vector<Problem> problems;  ///< at least one, in the order of the files' lines

 private:
  std::string lines_;
};

enum class Assumption { then_branch, else_branch };

/// The flange in the program's frame at six axis angles [rad].
using FlangeAt = std::function<Frame(const std::array<double, 6>&)>;

struct ImportOptions {
  std::string routine;  ///< where to start, "name" or "name(arguments)"; empty: the language's own start
  /// "file.mod:12" or "12" -> what an undecidable branch on that line does.
  std::map<std::string, Assumption> assume;
  /// "file.mod:12" or "12" -> the value by which an undecidable choice of several on that line goes.
  std::map<std::string, std::string> choose;
  /// Inputs, registers, persistent data, positions: name as the language writes it -> value.
  std::map<std::string, std::string> values;
  /// Names that something beside the program writes, in lower case -> what: "sps.sub".
  std::map<std::string, std::string> written_beside = {};
  int passes = 0;        ///< of an endless main loop; 0: until it begins again as it did before
  double spot_time = 1;  ///< dwell of a spot weld [s]
  /// Whether the user named the first file as the program: its routines count before those of the same name in files
  /// that lie beside it, such as a copy of an older state.
  bool first_file_counts = false;
  FlangeAt flange = {};  ///< empty: the robot is not known
};

/// Bounds on what a program may ask of its reader; past them the reading ends with a problem.
struct ImportLimits {
  static constexpr std::size_t file_bytes = 8u << 20;
  static constexpr std::size_t tokens = 2'000'000;
  static constexpr int nesting = 60;           ///< of expressions and of blocks
  static constexpr int calls = 60;             ///< routines that call routines
  static constexpr long executed = 3'000'000;  ///< statements and values
  static constexpr long guessed = 200'000;     ///< of them behind a guess, where nothing counts but questions
  static constexpr std::size_t instructions = 100'000;
  static constexpr std::size_t skipped = 20'000;
  static constexpr std::size_t values = 100'000;  ///< numbers of one variable, and variables
  static constexpr int passes = 1000;  ///< of an endless loop, in search of the one after which it repeats
};

/// A source file in memory.
class SourceFile {
 public:
  SourceFile(std::string name, std::string text);

  const std::string& name() const { return name_; }
  const std::string& text() const { return text_; }
  /// Line (from 1) without its end and the blanks around it, at most 200 characters; unprintable ones as '?'.
  std::string line(int number) const;
  /// Likewise, from a column (from 1) on.
  std::string from(int number, int column) const;

 private:
  std::string name_, text_;
  std::vector<std::size_t> starts_;  // of the lines
};

}  // namespace dresslife::sim
