// KUKA KRL: .src files with the .dat files that declare their data, run from the first routine unless asked
// otherwise.
//
// A program and the data list of its name are one module: the first DEF and what says GLOBAL is everybody's,
// the rest its own; the data lists of the system ($CONFIG.DAT, Mada) are everybody's.
//
// Read: DEF, DEFFCT, DEFDAT, STRUC, declarations, assignment, IF, FOR, WHILE, REPEAT, LOOP, SWITCH, RETURN;
// PTP, LIN, CIRC, PTP_REL, LIN_REL, SPTP, SLIN, SCIRC, SPL and SPLINE blocks with WITH, C_PTP, C_DIS, C_VEL;
// BAS; $VEL, $ACC, $VEL_AXIS, $ACC_AXIS, $APO, $OV_PRO, $TOOL, $BASE, $ROBROOT; WAIT SEC. FOLD lines are
// comments. Everything else is listed as skipped. SPL points of a block are joined by a smooth curve of
// cubics, cut into lines. Angles A, B, C turn about z, y', x''. Source: KUKA System Software, operating and
// programming instructions for system integrators.
#pragma once

#include "sim/program/interpreter/interpreter.h"
#include "sim/program/interpreter/program_folder.h"

namespace dresslife::sim {

/// The instruction where the controller, which runs ahead of the robot, waits for it (in a $OUT, $IN, WAIT without CONTINUE
/// before it): no name that a program can have.
inline constexpr const char* advance_stop = "advance stop";
Statement stop_of_advance(const Place& place);

/// The structures and system variables of every controller, as a last file; to be called before parsing.
void add_krl_types(Code& code);

void parse_krl(Code& code, int file, Problems& problems);

/// Writes a stop of the advance before each statement that names an input or output by its SIGNAL, or an imported
/// variable. To be called when all files are read, because a data list may declare the names. A name that no file
/// declares, and that is written as outputs are, may be one: the stop before it has the name as its argument.
void stop_at_signals(Code& code);

void run_krl(const Code& code, const ImportOptions& options, const std::vector<NamedFrame>& tools,
             const std::vector<NamedFrame>& work_objects, Program& program, Problems& problems);

/// The programs of this language among `files` of `folder`. routine: the requested one; empty: none. Errors: InputError that names the
/// choices if there are several programs.
Backup krl_backup(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& files,
                 const std::string& routine);

}  // namespace dresslife::sim
