// Reader of Motoman INFORM: jobs (.JBI) of one controller. One job is the start of the run.
//
// Supported: positions C, BC, EC and variables P, BP, EX in pulses, degrees or mm (BASE, ROBOT, USER); MOVJ, MOVL, MOVC,
// MOVS, IMOV with VJ, V, VR, PL, CR, ACC, DEC; SPEED, TIMER, SFTON, SFTOF, SETTOOL, MFRAME; variables B, I, D, R, S
// and their local ones; SET, SETE, GETE, ADD, SUB, MUL, DIV, INC, DEC, CLEAR, EXPRESS; IFTHEN, SWITCH, WHILE, FOR,
// JUMP, CALL, RET; TOOL.CND, UFRAME.CND and VAR.DAT of a backup. All other instructions are listed as skipped.
//
// Pulses are converted by the controller's counts per degree. No job contains them: --value pulses_per_degree=[..].
// Sources: job data format and manipulator types of the NX100 and DX100 operator's manuals (149235-1CD, 156191-1CD);
// position levels of the SC.PRM of public backups.
#pragma once

#include "sim/program/interpreter/interpreter.h"
#include "sim/program/interpreter/program_folder.h"

namespace dresslife::sim {

/// Adds the record type of positions, which tools and user frames use, too.
void add_inform_types(Code& code);

/// Parses a job (.JBI) or a data file of the controller (.CND, .DAT) into `code`.
void parse_inform(Code& code, int file, Problems& problems);

/// Returns whether an instruction moves the robot. name: in small letters.
bool moves_inform_robot(const std::string& name);

/// Returns the jobs that a job calls or starts, and whether it moves the robot.
Calls inform_calls(const SourceFile& job);

/// Returns the tree's name of a variable: "b003" for "B3", "b003" and "B[3]". Returns other names in lower case.
std::string inform_name(const std::string& written);

/// Renames the user's values (code.values) to the names of the tree.
void name_inform_values(Code& code);

/// Runs the parsed jobs and adds moves and dwells to `program`. Errors and questions are added to `problems`.
void run_inform(const Code& code, const ImportOptions& options, const std::vector<NamedFrame>& tools,
                const std::vector<NamedFrame>& work_objects, Program& program, Problems& problems);

/// Returns the INFORM jobs among `files` of `folder`. routine: the requested job; empty: no request.
/// Errors: throws InputError, with the choices if there are several start jobs.
Backup inform_backup(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& files,
                     const std::string& routine);

}  // namespace dresslife::sim
