// Alternatives for the lines of a robot program that keep the tool's pose at every target and every linear or circular path:
// a joint move, with the paths behind it up to the next joint move, in another configuration of wrist or arm; a joint move
// through a point, so that arm and wrist move one after the other; a slower move. A line that runs several times is changed for
// all of its runs.
#pragma once

#include <string>
#include <vector>

#include "pipeline/job/job.h"
#include "sim/program/import.h"
#include "sim/program/rewrite.h"

namespace dresslife::sim {

/// A job's program after reading.
struct ReadProgram {
  Language language = Language::rapid;
  Program program;
  pipeline::Motion motion;  ///< motion of the program: a step for each instruction, in their order
};

/// Reads the program of a job. Errors: those of reading it. Precondition: job.motion.program is set.
ReadProgram read_job_program(const pipeline::Job& job);

struct ProgramWay {
  std::string what;                ///< "axis 6 turned by +360 deg"
  std::vector<std::string> lines;  ///< "side_panel.mod:54"; empty: all lines
  std::vector<LineChange> changes;
};

/// Returns the alternatives. line_damage: (line of the motion, numbered as in the simulation) damage of each line. most_lines:
/// number of lines, most damaging first. Errors: InputError if the robot does not reach a target.
std::vector<ProgramWay> program_ways(const pipeline::Job& job, const ReadProgram& read,
                                     const std::vector<double>& line_damage, std::size_t most_lines);

}  // namespace dresslife::sim
