// Programs in tests: read from text, moves and problems as one-line texts.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sim/program/import.h"

namespace dresslife::tests {

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
inline const std::pair<std::string, std::string> held_frames{
    "$held.dat", "DEFDAT $HELD\n$TOOL=$NULLFRAME\n$BASE=$NULLFRAME\nENDDAT\n"};

struct Reader {
  sim::Language language;
  sim::ImportOptions options = {};
  std::vector<sim::NamedFrame> tools = {}, work_objects = {};

  Reading operator()(const std::vector<std::pair<std::string, std::string>>& files) const {
    std::deque<sim::SourceFile> sources;
    for (const auto& [name, text] : files) sources.emplace_back(name, text);
    sim::Problems problems;
    Reading reading;
    reading.program = sim::read_program(language, std::move(sources), options, tools, work_objects, problems);
    reading.problems = problems.list();
    return reading;
  }
};

}  // namespace dresslife::tests
