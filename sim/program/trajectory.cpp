#include "sim/program/trajectory.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "pipeline/job/document.h"
#include "sim/program/tokens.h"

namespace dresslife::sim {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr std::size_t most_axes = 12;

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && static_cast<unsigned char>(text.front()) <= ' ') text.remove_prefix(1);
  while (!text.empty() && static_cast<unsigned char>(text.back()) <= ' ') text.remove_suffix(1);
  return text;
}

std::optional<double> number_in(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failure != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

/// Rows of angles into moves: the first without a time, the others as long as the rows are apart.
class Rows {
 public:
  Rows(Program& program, Problems& problems) : program_(program), problems_(problems) {}

  /// False: no more rows are wanted.
  bool add(std::vector<double> joints, std::optional<double> time, const pipeline::Where& where,
           const std::string& text) {
    if (program_.instructions.size() >= ImportLimits::instructions) {
      problems_.add(where,
                    fmt::format("would be move {} (no more are allowed)", ImportLimits::instructions + 1),
                    "thin out the rows");
      return false;
    }
    if (!program_.instructions.empty() &&
        joints.size() != program_.instructions.front().target.joints.size()) {
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

struct Column {
  bool time = false;
  double factor = degree;
};

std::vector<std::string_view> cells_of(std::string_view line, char separator) {
  std::vector<std::string_view> cells;
  while (cells.size() <= most_axes + 1) {
    const std::size_t end = line.find(separator);
    cells.push_back(trimmed(line.substr(0, end)));
    if (end == std::string_view::npos) break;
    line.remove_prefix(end + 1);
  }
  return cells;
}

}  // namespace

void read_joint_columns(const SourceFile& file, Program& program, Problems& problems) {
  Rows rows(program, problems);
  std::vector<Column> columns;
  char separator = ',';
  int number = 0;
  const std::string_view all = file.text();
  for (std::size_t begin = 0; begin < all.size() && !problems.full();) {
    const std::size_t end = std::min(all.find('\n', begin), all.size());
    const std::string_view line = trimmed(all.substr(begin, end - begin));
    begin = end + 1;
    ++number;
    if (line.empty() || line.front() == '#') continue;
    const pipeline::Where where{file.name(), number, 1};
    if (columns.empty()) {
      for (char candidate : {',', ';', '\t'})
        if (line.find(candidate) != std::string_view::npos) separator = candidate;
      for (std::string_view name : cells_of(line, separator)) {
        const std::string word = lower_case(name);
        if (number_in(name))
          return problems.add(where, "begins with numbers",
                              "put a line of names first: time, axis 1, axis 2, ...");
        columns.push_back({columns.empty() && word.starts_with("t"), word.ends_with("rad") ? 1 : degree});
      }
      if (columns.size() - columns[0].time > most_axes || columns.size() == columns[0].time)
        return problems.add(where, fmt::format("names {} axes", columns.size() - columns[0].time),
                            "give one column per axis");
      continue;
    }
    const std::vector<std::string_view> cells = cells_of(line, separator);
    if (cells.size() != columns.size()) {
      problems.add(where, fmt::format("has {} cells (there are {} names)", cells.size(), columns.size()),
                   "give one number per name");
      continue;
    }
    std::vector<double> joints;
    std::optional<double> time;
    bool whole =
        std::any_of(cells.begin(), cells.end(), [](std::string_view cell) { return number_in(cell); });
    if (!whole) {
      problems.add(where, "has no numbers",
                   "put one line of names first, then a row of joint angles per line");
      continue;
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const auto value = number_in(cells[i]);
      if (!value)
        problems.add(where, fmt::format("has no number in cell {}", i + 1), "write a finite number");
      whole &= value.has_value();
      if (!value) continue;
      if (columns[i].time)
        time = *value;
      else
        joints.push_back(*value * columns[i].factor);
    }
    if (whole && !rows.add(std::move(joints), time, where, file.line(number))) return;
  }
  if (columns.empty())
    problems.add({file.name(), 1, 1}, "is empty", "give a line of names, then one row per pose");
}

namespace {

using pipeline::Node;

/// The map with `points`, at most two keys deep.
const Node* trajectory_in(const Node& node, int depth = 0) {
  if (!node.is_map() || depth > 2) return nullptr;
  if (node.find("points")) return &node;
  for (const pipeline::Entry& entry : node.entries)
    if (const Node* found = trajectory_in(entry.value, depth + 1)) return found;
  return nullptr;
}

/// Seconds, as one number or as {sec, nanosec} (ROS 2), {secs, nsecs} (ROS 1).
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

bool read_point(const Node& point, Rows& rows, Problems& problems) {
  const Node* positions = point.is_map() ? point.find("positions") : nullptr;
  if (!positions || !positions->is_list() || positions->items.empty() ||
      positions->items.size() > most_axes) {
    problems.add(point.where, "has no positions", "give one angle per joint [rad]");
    return !problems.full();
  }
  std::vector<double> joints;
  for (const Node& item : positions->items) {
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

}  // namespace

void read_ros_trajectory(const SourceFile& file, Program& program, Problems& problems) {
  std::string text = file.text();
  // What `ros2 topic echo` writes: documents parted by "---"; the first one counts.
  if (const std::size_t end = text.find("\n---"); end != std::string::npos && end > 0) text.resize(end + 1);
  Node document;
  try {
    document = pipeline::parse_yaml(text, file.name());
  } catch (const pipeline::InputError& error) {
    // The message begins with its own place.
    const std::string what = error.what();
    const std::size_t word = what.find(": error: ");
    return problems.add({file.name(), 1, 1}, what.substr(word == std::string::npos ? 0 : word + 9), "");
  }
  const Node* trajectory = trajectory_in(document);
  const Node* points = trajectory ? trajectory->find("points") : nullptr;
  if (!points || !points->is_list() || points->items.empty())
    return problems.add({file.name(), 1, 1}, "holds no trajectory with points",
                        "give a trajectory_msgs/JointTrajectory");
  Rows rows(program, problems);
  for (const Node& point : points->items)
    if (!read_point(point, rows, problems)) return;
}

}  // namespace dresslife::sim
