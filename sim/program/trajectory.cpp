#include "sim/program/trajectory.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

#include "pipeline/base/constants.h"
#include "pipeline/base/csv_rows.h"
#include "pipeline/base/joined.h"
#include "pipeline/settings/document.h"
#include "sim/program/axis_names.h"
#include "sim/program/interpreter/job_words.h"
#include "sim/program/interpreter/tokens.h"

namespace dresslife::sim {
namespace {

constexpr std::size_t most_axes = 12;

std::optional<double> number_in(std::string_view text) {
  const std::optional<double> value = pipeline::number_in(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

/// Converts rows of angles to moves: the first move has no duration, the others the time between two rows.
class Rows {
 public:
  Rows(Program& program, Problems& problems) : program_(program), problems_(problems) {}

  /// Adds a row. Returns false if no more rows are read.
  bool add(std::vector<double> joints, std::optional<double> time, const pipeline::Where& where,
           const std::string& text) {
    if (program_.instructions.size() >= ImportLimits::instructions) {
      problems_.add(where, fmt::format("would be move {} (no more are allowed)", ImportLimits::instructions + 1),
                    "thin out the rows");
      return false;
    }
    if (!program_.instructions.empty() && joints.size() != program_.instructions.front().target.joints.size()) {
      problems_.add(where,
                    fmt::format("has {} angles (the first has {})", joints.size(),
                                program_.instructions.front().target.joints.size()),
                    "give one angle per axis");
      return !problems_.full();
    }
    Instruction move;
    move.target.joints = std::move(joints);
    move.where = where;
    move.text = text;
    if (time) {
      if (last_time_ && !(*time > *last_time_)) {
        problems_.add(where, fmt::format("has the time {:.6g} s, not after the one before", *time),
                      "order the rows by increasing times");
        return !problems_.full();
      }
      if (last_time_) move.speed.duration = *time - *last_time_;
      move.zone.percent = 100;
      last_time_ = time;
    }
    program_.instructions.push_back(std::move(move));
    return true;
  }

 private:
  Program& program_;
  Problems& problems_;
  std::optional<double> last_time_;
};

/// Warns of answers of the user other than values of these names.
void note_unused(const SourceFile& file, const ImportOptions& options, const pipeline::WordSet& names,
                 Program& program) {
  const auto note = [&](const std::string& what) { program.skipped.push_back({{file.name(), 1, 1}, what, true}); };
  for (const auto& [line, assumption] : options.assume) note(unused_assumption(line));
  for (const auto& [line, chosen] : options.choose) note(unused_assumption(line));
  for (const auto& [name, value] : options.values)
    if (!names.contains(name)) note(unused_value(name));
}

std::string answer(const ImportOptions& options, const char* name) {
  const auto found = options.values.find(name);
  return found == options.values.end() ? "" : found->second;
}

/// Returns the number in a cell of a table. A comma in a cell separates no cells: it is a decimal comma.
std::optional<double> number_in_cell(std::string text) {
  if (const std::size_t comma = text.find(','); comma != text.npos) text[comma] = '.';
  return number_in(text);
}

/// Reader of a file of columns: the header, then the rows.
class Columns {
 public:
  Columns(const SourceFile& file, const ImportOptions& options, Program& program, Problems& problems)
      : file_(file), options_(options), program_(program), problems_(problems) {}

  void run() {
    pipeline::CsvReader reader(std::string(file_.text()), file_.name());
    for (pipeline::CsvRow cells = reader.next(); !cells.empty() && !problems_.full() && !stopped_;
         cells = reader.next()) {
      number_ = reader.line();
      names_.empty() ? header(cells) : row(cells);
    }
    if (names_.empty() && !stopped_)
      problems_.add({file_.name(), 1, 1}, "is empty", "give a line of names, then one row per pose");
    if (problems_.empty() && !stopped_) moves();
  }

 private:
  struct Row {
    int line;
    std::optional<double> time;
    std::vector<double> angles;  // as written, in the order of the robot's axes
  };
  pipeline::Where where() const { return {file_.name(), number_, 1}; }
  void refuse(const std::string& what, const std::string& remedy) {
    problems_.add(where(), what, remedy);
    stopped_ = true;
  }

  void header(const pipeline::CsvRow& cells) {
    header_ = number_;
    std::vector<std::string> axes;
    std::vector<std::size_t> at;
    bool points = false;
    std::vector<std::string> titles;
    for (const auto& cell : cells) titles.emplace_back(cell.text);
    const std::vector<ColumnName> kinds = column_names(titles);
    for (const std::string& name : titles) {
      if (number_in_cell(name))
        return refuse("begins with numbers", "put a line of names first: time, axis 1, axis 2 and so on");
      const ColumnName& read = kinds[names_.size()];
      if (read.kind == ColumnName::Kind::time && !time_) {
        time_ = names_.size();
        seconds_ = read.seconds;
        clock_ = !read.unit_told;
      } else if (read.kind == ColumnName::Kind::axis) {
        axes.emplace_back(name);
        at.push_back(names_.size());
      } else if (!name.empty() || read.kind != ColumnName::Kind::other) {
        points |= read.kind == ColumnName::Kind::point;
        left_out_.emplace_back(name);
      }
      names_.emplace_back(name);
      units_.push_back(read.unit);
    }
    choose(axes, at, points);
  }

  /// Chooses the columns of the axes and their order.
  void choose(const std::vector<std::string>& axes, const std::vector<std::size_t>& at, bool points) {
    if (points)
      return refuse(fmt::format("names points or lengths ({})", pipeline::joined(left_out_, ", ")),
                    "give the angles of the axes, one column each");
    const bool long_form = axes.size() == 1 && std::ranges::any_of(left_out_, [](const auto& name) {
                             return lower_case(name) == "name" || lower_case(name).ends_with("joint_name");
                           });
    if (long_form)
      return refuse("lists one joint per line (a column of names)", "give one column per axis, one line per pose");
    if (axes.empty() || axes.size() > most_axes)
      return refuse(fmt::format("names {} axes", axes.size()), "give one column per axis");
    const std::string wanted = answer(options_, "joints");
    const auto order = order_of_axes(axes, wanted);
    if (!order)
      return refuse(fmt::format("names axes without their order ({})", pipeline::joined(axes, ", ")),
                    "number them in their names (joint_1 ...), or give motion.values: [{name: joints, value: "
                    "'NAME,NAME,...'}] in the order of the robot's axes");
    for (std::size_t axis : *order) axes_.push_back(at[axis]);
    for (const std::string& name : left_out_)
      program_.skipped.push_back({where(), fmt::format("column '{}': no angle of an axis", name)});
    for (std::size_t i = 0; i < axes.size() && !wanted.empty(); ++i)
      if (std::ranges::find(*order, i) == order->end())
        program_.skipped.push_back({where(), fmt::format("column '{}': none of the axes asked for", axes[i])});
  }

  void row(const pipeline::CsvRow& cells) {
    if (cells.size() != names_.size())
      return problems_.add(where(), fmt::format("has {} cells (there are {} names)", cells.size(), names_.size()),
                           "give one number per name");
    if (std::ranges::none_of(cells, [](const auto& cell) { return number_in_cell(cell.text).has_value(); }))
      return problems_.add(where(), "has no numbers",
                           "put one line of names first, then a row of joint angles per line");
    Row made{number_, {}, {}};
    bool whole = true;
    const auto number = [&](std::size_t column) {
      const auto value = number_in_cell(cells[column].text);
      if (!value)
        problems_.add(where(), fmt::format("has no number in cell {} ({})", column + 1, names_[column]),
                      "write a finite number");
      whole &= value.has_value();
      return value.value_or(0);
    };
    if (time_) {
      const double time = number(*time_);
      if (clock_ && rows_.empty()) seconds_ = unit_of_clock(time);
      made.time = time * seconds_;
    }
    for (std::size_t column : axes_) made.angles.push_back(number(column));
    if (whole && rows_.size() <= ImportLimits::instructions) rows_.push_back(std::move(made));
  }

  /// Returns the factors that convert the axes' columns to rad; empty: not known.
  std::vector<double> factors() {
    // No axis turns more than two revolutions in one direction, except wrist axes, which are in degrees anyway.
    constexpr double widest = 4 * std::numbers::pi;
    double largest = 0;
    for (const Row& row : rows_)
      for (double angle : row.angles) largest = std::max(largest, std::abs(angle));
    const std::string answered = answer(options_, "unit");
    std::vector<double> made;
    for (std::size_t column : axes_) {
      ColumnName::Unit unit = units_[column];
      if (unit == ColumnName::Unit::unknown && largest > widest) unit = ColumnName::Unit::degrees;
      if (answered == "deg") unit = ColumnName::Unit::degrees;
      if (answered == "rad") unit = ColumnName::Unit::radians;
      if (unit == ColumnName::Unit::unknown) return {};
      made.push_back(unit == ColumnName::Unit::radians ? 1 : degree);
    }
    return made;
  }

  void moves() {
    const std::vector<double> factor = factors();
    if (factor.empty()) {
      number_ = header_;
      return problems_.add_use(
          {.where = {file_.name(), number_, 1},
           .what = "gives angles without a unit (none is too large for radians)",
           .remedy =
               "end the names in deg or rad (joint_1_rad), or give motion.values: [{name: unit, value: deg}] or value: rad",
           .about = "unit",
           .questions = {{Question::Kind::value, "unit", "deg or rad"}}});
    }
    Rows rows(program_, problems_);
    for (Row& row : rows_) {
      for (std::size_t i = 0; i < factor.size(); ++i) row.angles[i] *= factor[i];
      if (!rows.add(std::move(row.angles), row.time, {file_.name(), row.line, 1}, file_.line(row.line))) return;
    }
  }

  const SourceFile& file_;
  const ImportOptions& options_;
  Program& program_;
  Problems& problems_;
  std::vector<std::string> names_, left_out_;
  std::vector<ColumnName::Unit> units_;
  std::vector<std::size_t> axes_;  // columns in the order of the robot's axes
  std::optional<std::size_t> time_;
  double seconds_ = 1;
  bool clock_ = false;  // the times determine their unit
  std::vector<Row> rows_;
  int number_ = 0, header_ = 0;
  bool stopped_ = false;
};

}  // namespace

void read_joint_columns(const SourceFile& file, const ImportOptions& options, Program& program, Problems& problems) {
  Columns(file, options, program, problems).run();
  note_unused(file, options, pipeline::word_set("joints unit"), program);
}

namespace {

using pipeline::Node;

/// Collects the maps with non-empty `points`, at most six levels of keys and lists deep.
void trajectories_in(const Node& node, std::vector<const Node*>& found, int depth = 0) {
  if (depth > 6 || found.size() > 100) return;
  for (const Node& item : node.items) trajectories_in(item, found, depth + 1);
  const Node* points = node.is_map() ? node.find("points") : nullptr;
  if (points && points->is_list() && !points->items.empty() && points->items[0].is_map() &&
      !points->items[0].find("transforms"))
    found.push_back(&node);
  else
    for (const pipeline::Entry& entry : node.entries) trajectories_in(entry.value, found, depth + 1);
}

/// Returns a time [s] from one number, from {sec, nanosec} (ROS 2) or from {secs, nsecs} (ROS 1).
std::optional<double> time_of(const Node& node) {
  if (node.is_scalar()) return number_in(node.text);
  double time = 0;
  bool any = false;
  for (const auto& [key, factor] : {std::pair{"sec", 1.0}, {"secs", 1.0}, {"nanosec", 1e-9}, {"nsecs", 1e-9}})
    if (const Node* part = node.find(key)) {
      const auto number = part->is_scalar() ? number_in(part->text) : std::nullopt;
      if (!number) return {};
      time += *number * factor;
      any = true;
    }
  return any ? std::optional(time) : std::nullopt;
}

bool read_point(const Node& point, const std::vector<std::size_t>& order, std::size_t names, Rows& rows,
                Problems& problems) {
  const Node* positions = point.is_map() ? point.find("positions") : nullptr;
  if (!positions || !positions->is_list() || positions->items.size() != names) {
    problems.add(point.where, fmt::format("has no positions of {} joints", names), "give one angle per joint [rad]");
    return !problems.full();
  }
  std::vector<double> joints;
  for (std::size_t axis : order) {
    const Node& item = positions->items[axis];
    const auto number = item.is_scalar() ? number_in(item.text) : std::nullopt;
    if (!number) {
      problems.add(item.where, "is no finite number", "give the angle in rad");
      return !problems.full();
    }
    joints.push_back(*number);
  }
  const Node* written = point.find("time_from_start");
  const auto time = written ? time_of(*written) : std::nullopt;
  if (!time) {
    problems.add(point.where, "has no time_from_start", "give it in seconds, or as sec and nanosec");
    return !problems.full();
  }
  return rows.add(std::move(joints), time, point.where, fmt::format("point at {:.6g} s", *time));
}

void shift_lines(Node& node, int lines) {
  node.where.line += lines;
  for (Node& item : node.items) shift_lines(item, lines);
  for (pipeline::Entry& entry : node.entries) {
    entry.where.line += lines;
    shift_lines(entry.value, lines);
  }
}

constexpr std::size_t most_documents = 100;

/// Reads the first documents of a file, separated by "---" as in `ros2 topic echo`. Returns false if one is not valid YAML.
bool documents_of(const SourceFile& file, std::vector<Node>& documents, Problems& problems) {
  const std::string& text = file.text();
  int lines = 0;
  for (std::size_t begin = 0; begin < text.size() && documents.size() < most_documents;) {
    std::size_t end = begin == 0 && text.starts_with("---") ? text.find("\n---", 3) : text.find("\n---", begin);
    end = std::min(end == std::string::npos ? text.size() : end + 1, text.size());
    const std::string part = text.substr(begin, end - begin);
    const int before = std::exchange(lines, lines + static_cast<int>(std::ranges::count(part, '\n')));
    begin = end < text.size() ? std::min(text.find('\n', end), text.size()) : end;
    if (part.find_first_not_of(" \t\r\n-") == std::string::npos) continue;
    try {
      documents.push_back(pipeline::parse_yaml(part, file.name()));
      shift_lines(documents.back(), before);
    } catch (const pipeline::InputError& error) {
      // The message begins with the error's place: "FILE:LINE:COLUMN: error: ".
      const std::string what = error.what();
      const std::size_t word = what.find(": error: ");
      pipeline::Where where{file.name(), 1, 1};
      if (what.starts_with(file.name()) &&
          std::sscanf(what.c_str() + file.name().size(), ":%d:%d", &where.line, &where.column) == 2)
        where.line += before;
      problems.add(where, what.substr(word == std::string::npos ? 0 : word + 9), "");
      return false;
    }
  }
  return true;
}

/// Returns the chosen trajectory; null: none, or the choice is not known.
const Node* chosen_trajectory(const SourceFile& file, const std::vector<Node>& documents, const ImportOptions& options,
                              Problems& problems) {
  std::vector<const Node*> found;
  for (const Node& document : documents) trajectories_in(document, found);
  const auto answered = number_in(answer(options, "trajectory"));
  if (found.empty())
    problems.add({file.name(), 1, 1}, "holds no trajectory with points", "give a trajectory_msgs/JointTrajectory");
  else if (answered && *answered >= 1 && *answered <= static_cast<double>(found.size()))
    return found[static_cast<std::size_t>(*answered) - 1];
  else if (found.size() > 1)
    problems.add(found[1]->where, fmt::format("is one of {} trajectories in the file", found.size()),
                 fmt::format("choose with {} .. value: {}", values_of_job({"trajectory"}, "1"), found.size()));
  else
    return found[0];
  return nullptr;
}

}  // namespace

void read_ros_trajectory(const SourceFile& file, const ImportOptions& options, Program& program, Problems& problems) {
  if (const std::string unit = answer(options, "unit"); !unit.empty() && unit != "rad")
    return problems.add({values_of_job({"unit"}, unit)}, "is no unit of a ROS trajectory, whose angles are in rad",
                        "give the angles in rad, or as columns (.csv)");
  note_unused(file, options, pipeline::word_set("joints trajectory unit"), program);
  std::vector<Node> documents;
  if (!documents_of(file, documents, problems)) return;
  const Node* trajectory = chosen_trajectory(file, documents, options, problems);
  if (!trajectory) return;
  const Node* points = trajectory->find("points");
  const Node* names = trajectory->find("joint_names");
  std::vector<std::string> joints;
  for (const Node& name : names ? names->items : std::vector<Node>{}) joints.push_back(name.text);
  if (joints.empty() || joints.size() > most_axes)
    return problems.add(trajectory->where, fmt::format("has {} joint_names", joints.size()),
                        "name the joints in the order of their positions");
  const auto order = order_of_axes(joints, answer(options, "joints"));
  if (!order)
    return problems.add(
        names->where, fmt::format("names joints without their order on the robot ({})", pipeline::joined(joints, ", ")),
        "give motion.values: [{name: joints, value: 'NAME,NAME,...'}] in the order of the robot's axes");
  Rows rows(program, problems);
  for (const Node& point : points->items)
    if (!read_point(point, *order, joints.size(), rows, problems)) return;
}

}  // namespace dresslife::sim
