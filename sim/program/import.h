// Reads robot programs of all languages (by file extension) and converts them to motions.
#pragma once

#include <deque>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "pipeline/base/warnings.h"
#include "pipeline/job/motion.h"
#include "pipeline/job/robot.h"
#include "sim/program/interpreter/program.h"

namespace dresslife::sim {

/// Returns the language of a file by its extension. Errors: InputError for an unknown extension.
Language language_of(const std::filesystem::path& file);

/// Reads and runs a program. tools, work_objects: frames that the program names but does not define. Problems are
/// added to `problems`, not thrown.
Program read_program(Language language, std::deque<SourceFile> files, const ImportOptions& options,
                     const std::vector<NamedFrame>& tools, const std::vector<NamedFrame>& work_objects,
                     Problems& problems);

/// Reads the program of a motion (`program`, `modules`, `routine`, `assume`, `tools`, `work_objects`). flange: see
/// ImportOptions. instead: file name as in the program's places -> contents that replace those of the file.
/// Precondition: motion.program is set. Errors: one InputError with all problems.
Program read_program(const pipeline::Motion& motion, const FlangeAt& flange = {},
                     const std::map<std::string, std::string>& instead = {});

/// Returns the language of a motion's program. Precondition: motion.program is set.
Language language_of(const pipeline::Motion& motion);

/// Returns the program as steps, one for each move and dwell. `defaults` gives the speeds and zones that the program
/// does not set.
pipeline::Motion motion_of(const Program& program, const pipeline::Motion& defaults);

/// The motion of a run, and a note about its program; empty: no note.
struct RunMotion {
  pipeline::Motion motion;
  std::string note;
  std::vector<std::string> assumed = {};  ///< notes about values that neither the program nor the job gives
};

/// Returns the motion itself, or the motion of its program. flange: see ImportOptions.
RunMotion run_motion_of(const pipeline::Motion& motion, const FlangeAt& flange = {});

/// Returns "3 waits for signals count 0 s ...": the lines that wait for an event outside of the program; empty: none.
std::string waits_note(const Program& program);

/// Returns the skipped statements that may move the robot or change its motion: each kind once, with all its lines.
std::vector<pipeline::Warning> moves_left_out(const Program& program);

/// Returns all skipped statements, one line for each: "file:line: skipped: what".
std::vector<std::string> skipped_lines(const Program& program);

}  // namespace dresslife::sim
