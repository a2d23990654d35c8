// Motoman INFORM: jobs (.JBI) of one controller, run from one of them.
//
// Read: positions C, BC, EC and variables P, BP, EX in pulses, degrees or mm (BASE, ROBOT, USER); MOVJ, MOVL, MOVC,
// MOVS, IMOV with VJ, V, VR, PL, CR, ACC, DEC; SPEED, TIMER, SFTON, SFTOF, SETTOOL, MFRAME; variables B, I, D, R, S
// and their local ones; SET, SETE, GETE, ADD, SUB, MUL, DIV, INC, DEC, CLEAR, EXPRESS; IFTHEN, SWITCH, WHILE, FOR,
// JUMP, CALL, RET; TOOL.CND, UFRAME.CND and VAR.DAT of a backup. All else is listed as skipped.
//
// Pulses become angles by the controller's counts per degree, which no job holds: --value pulses_per_degree=[..].
// Source of the words: job data format and manipulator types of the NX100 and DX100 operator's manuals (149235-1CD,
// 156191-1CD); position levels as in the SC.PRM of public backups.
#pragma once

#include "sim/program/interpreter/interpreter.h"
#include "sim/program/interpreter/program_folder.h"

namespace dresslife::sim {

/// Record of a position, and of tools and user frames.
void add_inform_types(Code& code);

/// Parses a job or a file of the controller's data into `code`.
void parse_inform(Code& code, int file, Problems& problems);

/// What a job calls.
Calls inform_calls(const SourceFile& job);

/// "B3", "b003" and "B[3]" are one variable: its name in the tree. Others: as they are, in lower case.
std::string inform_name(const std::string& written);

/// The user's values under the names of the tree.
void name_inform_values(Code& code);

/// Runs what was parsed.
void run_inform(const Code& code, const ImportOptions& options, const std::vector<NamedFrame>& tools,
                const std::vector<NamedFrame>& work_objects, Program& program, Problems& problems);

/// The programs of this language among `files` of `folder`. routine: the requested one; empty: none. Errors: InputError that names the
/// choices if there are several programs.
Backup inform_backup(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& files,
                 const std::string& routine);

}  // namespace dresslife::sim
