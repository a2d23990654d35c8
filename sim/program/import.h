// Robot programs of any language that is read, by the ends of their files' names; and what becomes of them: a
// motion.
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

/// By extension. Errors: InputError for one that no reader knows.
Language language_of(const std::filesystem::path& file);

/// Runs the program. tools, work_objects: those that it names but does not hold. Problems are added, not
/// thrown.
Program read_program(Language language, std::deque<SourceFile> files, const ImportOptions& options,
                     const std::vector<NamedFrame>& tools, const std::vector<NamedFrame>& work_objects,
                     Problems& problems);

/// The program of a motion (`program`, `modules`, `routine`, `assume`, `tools`, `work_objects`). flange: of its robot
/// (ImportOptions). instead: contents of files other than they have, by the names in the program's places.
/// Errors: one InputError with all problems. Precondition: motion.program is set.
Program read_program(const pipeline::Motion& motion, const FlangeAt& flange = {},
                     const std::map<std::string, std::string>& instead = {});

/// The language of a motion's program. Precondition: motion.program is set.
Language language_of(const pipeline::Motion& motion);

/// The program as steps, one for each move and dwell; speeds and zones that the program leaves out are
/// `defaults`'.
pipeline::Motion motion_of(const Program& program, const pipeline::Motion& defaults);

/// The motion that is run, and what a run notes of its program; empty: nothing.
struct RunMotion {
  pipeline::Motion motion;
  std::string note;
};

/// The motion itself, or its program's. flange: of its robot.
RunMotion run_motion_of(const pipeline::Motion& motion, const FlangeAt& flange = {});

/// "3 waits for signals count 0 s ...": lines whose wait ends when something outside of the program happens; empty: none.
std::string waits_note(const Program& program);

/// What was skipped and may move the robot, or change how it moves: each thing once, with the lines where it
/// stands.
std::vector<pipeline::Warning> moves_left_out(const Program& program);

/// These and all else that was skipped, one line each: "file:line: skipped: what".
std::vector<std::string> skipped_lines(const Program& program);

}  // namespace dresslife::sim
