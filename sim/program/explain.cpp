#include "sim/program/explain.h"

#include <filesystem>

#include "pipeline/base/constants.h"
#include "pipeline/base/readable.h"

namespace dresslife::sim {
namespace {

/// Returns a number with at most four decimals, as controllers write it.
std::string number(double value) { return pipeline::short_decimal(value, 4); }

std::string position(const Vector3& p) {
  return fmt::format("{} {} {} mm", number(p.x() / millimetre), number(p.y() / millimetre), number(p.z() / millimetre));
}

std::string frame(const Frame& f) {
  const Quaternion& q = f.orientation;
  return fmt::format("{}, quaternion {} {} {} {}", position(f.position), number(q.w()), number(q.x()), number(q.y()),
                     number(q.z()));
}

/// Returns " (p20: data.mod:4)"; empty: the origin is not known.
std::string from(const Instruction& instruction, std::string_view part) {
  for (const Origin& origin : instruction.origins) {
    if (origin.part != part) continue;
    const std::string file = std::filesystem::path(origin.where.file).filename().string();
    const std::string place = origin.where.line > 0 ? fmt::format("{}:{}", file, origin.where.line) : "";
    if (origin.written.empty() && place.empty()) return "";
    return fmt::format(" ({}{}{})", origin.written, origin.written.empty() || place.empty() ? "" : ": ", place);
  }
  return "";
}

std::string target(const Instruction& instruction) {
  const Target& t = instruction.target;
  std::string text;
  if (!t.joints.empty()) {
    for (double angle : t.joints) text += (text.empty() ? "" : " ") + number(angle / degree);
    text = "axes " + text + " deg";
  } else {
    text = frame(t.pose);
    if (const std::string arm = t.configuration.text(); !arm.empty()) text += ", " + arm;
  }
  if (!t.external_axes.empty()) {
    text += ", external";
    for (double axis : t.external_axes) text += " " + number(axis);
  }
  return text;
}

std::string speed(const Instruction& instruction) {
  const MoveSpeed& s = instruction.speed;
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (s.duration) add(fmt::format("{} s", number(*s.duration)));
  if (!s.duration && s.axis_percent) add(fmt::format("{} %", number(*s.axis_percent)));
  if (!s.duration && s.axis) add(fmt::format("{} deg/s of the fastest axis", number(*s.axis / degree)));
  if (!s.duration && s.tool) add(fmt::format("{} mm/s", number(*s.tool / millimetre)));
  if (!s.duration && s.orientation) add(fmt::format("{} deg/s", number(*s.orientation / degree)));
  if (text.empty()) text = "as fast as the axes can";
  if (s.axis_acceleration) add(fmt::format("{} deg/s2 of the fastest axis", number(*s.axis_acceleration / degree)));
  if (s.tool_acceleration) add(fmt::format("{} mm/s2", number(*s.tool_acceleration / millimetre)));
  if (instruction.acceleration_percent != 100)
    add(fmt::format("acceleration {} %", number(instruction.acceleration_percent)));
  if (instruction.jerk_percent != 100) add(fmt::format("jerk {} %", number(instruction.jerk_percent)));
  return text;
}

std::string zone(const Instruction& instruction) {
  if (instruction.zone.percent > 0) return fmt::format("zone {} %", number(instruction.zone.percent));
  if (instruction.zone.distance == 0) return "stop";
  const std::string turn =
      instruction.zone.turn ? fmt::format(", {} deg", number(*instruction.zone.turn / degree)) : "";
  return fmt::format("zone {} mm{}", number(instruction.zone.distance / millimetre), turn);
}

std::string named(const char* what, const std::vector<NamedFrame>& list, int index, const char* none) {
  if (index < 0) return fmt::format("{} {}", what, none);
  const NamedFrame& f = list[index];
  return fmt::format("{} {}{} {}", what, f.name, f.stationary ? ", stationary," : "", frame(f.frame));
}

}  // namespace

std::vector<std::string> explanation(const Program& program) {
  std::vector<std::string> lines;
  for (const Instruction& i : program.instructions) {
    std::string line = fmt::format("{}:{}{}: {}", std::filesystem::path(i.where.file).filename().string(), i.where.line,
                                   i.routine.empty() ? "" : " " + i.routine, i.text);
    if (i.kind == Instruction::Kind::dwell) {
      lines.push_back(line + fmt::format(" | waits {} s", number(i.dwell)));
      continue;
    }
    static constexpr const char* paths[] = {"axes", "line", "circle"};
    line += fmt::format(" | {} to {}{}", paths[static_cast<int>(i.kind)], target(i), from(i, "target"));
    if (i.kind == Instruction::Kind::circular && i.target.circle_joints.empty())
      line += fmt::format(" | by {}{}", position(i.via.position), from(i, "via"));
    line += fmt::format(" | {}{}", named("tool", program.tools, i.tool, "flange"), from(i, "tool"));
    line += fmt::format(" | {}{}", named("work object", program.work_objects, i.work_object, "robot base"),
                        from(i, "work object"));
    line += fmt::format(" | {}{} | {}{}", speed(i), from(i, "speed"), zone(i), from(i, "zone"));
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace dresslife::sim
