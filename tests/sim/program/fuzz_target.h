// Fuzz targets: any bytes as a program of any language. The reader must return, and all its problems must have a place.
#pragma once

#include <string>

#include "pipeline/job/robot.h"
#include "pipeline/settings/fields.h"
#include "pipeline/urdf/urdf.h"
#include "sim/program/import.h"

namespace dresslife::pipeline {
void describe(Fields& f, Robot& robot);
}

namespace dresslife::tests {

inline const char* name_of(sim::Language language) {
  switch (language) {
    case sim::Language::rapid:
      return "p.mod";
    case sim::Language::krl:
      return "p.src";
    case sim::Language::fanuc:
      return "p.ls";
    case sim::Language::inform:
      return "p.jbi";
    case sim::Language::urscript:
      return "p.script";
    case sim::Language::joint_columns:
      return "p.csv";
    case sim::Language::ros_trajectory:
      break;
  }
  return "p.json";
}

/// Reads `text` as a program. Returns the fault of the reader; empty: none. has_problems: receives whether it has problems.
inline std::string fault_of_reading(sim::Language language, const std::string& text, bool* has_problems = nullptr) {
  std::deque<sim::SourceFile> files;
  files.emplace_back(name_of(language), text);
  if (language == sim::Language::fanuc) files.emplace_back("p.va", text);  // the same bytes as variables of a backup
  if (language == sim::Language::inform) {  // the same bytes as condition and variable files
    files.emplace_back("p.cnd", text);
    files.emplace_back("var.dat", text);
  }
  sim::ImportOptions options;
  if (language == sim::Language::inform) options.values["pulses_per_degree"] = "[1,2,3,4,5,6]";
  options.assume["3"] = sim::Assumption::then_branch;
  sim::Problems problems;
  const sim::Program program = sim::read_program(language, std::move(files), options, {}, {}, problems);
  if (has_problems) *has_problems = !problems.empty();
  for (const sim::Problem& problem : problems.list())
    if (problem.where.file.empty() || problem.what.empty()) return "a problem without a file or words";
  for (const sim::Instruction& instruction : program.instructions) {
    if (instruction.where.line < 1) return "a move without a line";
    for (double angle : instruction.target.joints)
      if (!std::isfinite(angle)) return "a target that is not finite";
    if (!instruction.target.pose.position.allFinite()) return "a pose that is not finite";
    if (instruction.target.configuration.kind != sim::ArmConfiguration::Kind::any &&
        sim::arm_configuration(instruction.target.configuration.text()) != instruction.target.configuration)
      return "a configuration that does not read back";
  }
  if (problems.empty()) sim::motion_of(program, {});
  return "";
}

/// Reads `text` as a URDF. The result must be a robot or a message with the name of the file. Returns the fault; empty: none.
inline std::string fault_of_urdf(const std::string& text) {
  pipeline::UrdfRequest request;
  request.urdf = "p.urdf";
  request.accelerations.assign(7, 1);
  try {
    pipeline::Robot robot;
    pipeline::read_fields(pipeline::robot_from_urdf(request, text), robot);
    if (robot.links.size() != robot.joints.size() + 1) return "another number of links than joints and one";
    if (robot.axes() < 4 || robot.axes() > 7) return "a number of axes that is refused";
  } catch (const pipeline::InputError& error) {
    if (!std::string(error.what()).starts_with("p.urdf")) return "a message without its file";
  }
  return "";
}

}  // namespace dresslife::tests
