// Reader of ABB RAPID: the modules of one task, run from a routine (by default main).
//
// Read: MODULE with CONST, VAR, PERS data, RECORD, PROC, FUNC and TRAP; assignment, IF, FOR, WHILE, TEST,
// RETURN; every Move, Trigg, Search, Arc, Spot, Disp and EGMMove instruction as a move; \T \V \Z \WObj; Offs,
// RelTool, PoseMult, PoseInv, OrientZYX and arithmetic; WaitTime; AccSet, VelSet, PDispSet, ConfL, ConfJ.
// Everything else is listed as skipped. A search goes to its end point. Source: Technical reference manual
// RAPID instructions, functions and data types (3HAC050917) for the meaning of the instructions.
#pragma once

#include "sim/program/interpreter/interpreter.h"
#include "sim/program/interpreter/program_folder.h"

namespace dresslife::sim {

/// Parses modules into `code`; sources must stay alive in code.files.
void parse_rapid(Code& code, int file, Problems& problems);

/// Runs the parsed modules. tools, work_objects: frames that the program names but does not define.
void run_rapid(const Code& code, const ImportOptions& options, const std::vector<NamedFrame>& tools,
               const std::vector<NamedFrame>& work_objects, Program& program, Problems& problems);

/// Returns the RAPID program among `files` of `folder`. routine: the requested routine; empty: none. Errors: InputError that
/// names the choices if there are several programs.
Backup rapid_backup(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& files,
                    const std::string& routine);

}  // namespace dresslife::sim
