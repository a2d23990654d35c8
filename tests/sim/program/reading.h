// Helpers for tests: reading of programs from text, access to moves, and problems as one-line texts.
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/base/constants.h"
#include "sim/program/import.h"

namespace dresslife::tests {

using Files = std::vector<std::pair<std::string, std::string>>;  ///< name, text

struct Reading {
  sim::Program program;
  std::vector<sim::Problem> problems;

  std::string problem(std::size_t i = 0) const {
    if (i >= problems.size()) return "no such problem";
    const sim::Problem& p = problems[i];
    return pipeline::InputError(p.where, p.what, p.remedy).what();
  }
  const sim::Instruction& move(std::size_t i) const { return program.instructions.at(i); }
};

/// A KRL data list with $TOOL and $BASE, for programs that do not assign them.
inline const Files::value_type held_frames{"$held.dat", "DEFDAT $HELD\n$TOOL=$NULLFRAME\n$BASE=$NULLFRAME\nENDDAT\n"};

struct Reader {
  sim::Language language;
  sim::ImportOptions options = {};
  std::vector<sim::NamedFrame> tools = {}, work_objects = {};

  Reading operator()(const Files& files) const {
    std::deque<sim::SourceFile> sources;
    for (const auto& [name, text] : files) sources.emplace_back(name, text);
    sim::Problems problems;
    Reading reading;
    reading.program = sim::read_program(language, std::move(sources), options, tools, work_objects, problems);
    reading.problems = problems.list();
    return reading;
  }
};

/// Returns the options of `dresslife import --value NAME=VALUE`.
inline sim::ImportOptions given(std::map<std::string, std::string> values) {
  sim::ImportOptions options;
  options.values = std::move(values);
  return options;
}

/// Returns the motion of a job that names this program.
inline pipeline::Motion motion_by(const std::filesystem::path& program, const std::string& routine = "") {
  pipeline::Motion motion;
  motion.program = program;
  motion.routine = routine;
  return motion;
}

/// Returns whether an instruction whose text contains `words` was skipped and its `may_move` has this value.
inline bool skips(const Reading& reading, const std::string& words, bool may_move) {
  const auto& skipped = reading.program.skipped;
  return std::any_of(skipped.begin(), skipped.end(), [&](const sim::Skipped& s) {
    return s.what.find(words) != std::string::npos && s.may_move == may_move;
  });
}

/// Returns the angles of axis 1 [deg], rounded, of all moves to joint angles.
inline std::vector<double> first_axes(const sim::Program& program) {
  std::vector<double> angles;
  for (const sim::Instruction& move : program.instructions)
    if (!move.target.joints.empty()) angles.push_back(std::round(move.target.joints[0] / degree));
  return angles;
}

}  // namespace dresslife::tests
