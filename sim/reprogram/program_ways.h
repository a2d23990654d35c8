// What the lines of a robot program could do instead, without another place of the tool at any target and without
// another linear or circular path: a joint move and the paths behind it, up to the next joint move, by another
// configuration of wrist or arm; a joint move by a point, so that arm and wrist move one after the other; a move more
// slowly. A line that runs several times is changed for all of them.
#pragma once

#include <string>
#include <vector>

#include "pipeline/job/job.h"
#include "sim/program/import.h"
#include "sim/program/rewrite.h"

namespace dresslife::sim {

/// A job's program as it was read.
struct ReadProgram {
  Language language = Language::rapid;
  Program program;
  pipeline::Motion motion;  ///< of it: a step for each instruction, in their order
};

/// Errors: those of reading it. Precondition: job.motion.program is set.
ReadProgram read_job_program(const pipeline::Job& job);

struct ProgramWay {
  std::string what;                ///< "axis 6 turned by +360 deg"
  std::vector<std::string> lines;  ///< "side_panel.mod:54"; empty: all
  std::vector<LineChange> changes;
};

/// line_damage: (line of the motion, as the simulation numbers them) what each costs. most_lines: of those that cost
/// most. Errors: InputError where the robot does not reach a target.
std::vector<ProgramWay> program_ways(const pipeline::Job& job, const ReadProgram& read,
                                     const std::vector<double>& line_damage, std::size_t most_lines);

}  // namespace dresslife::sim
