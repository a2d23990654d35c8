// Reader of KUKA KRL: .src files with the .dat files that declare their data. The first routine runs, unless the user
// requests another one.
//
// A program and the data list of its name are one module. Its first DEF and its GLOBAL names are visible to all
// modules, other names only inside the module. The data lists of the system ($CONFIG.DAT, Mada) are visible to all.
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

/// Name of the instruction at which the controller's advance run waits for the robot ($OUT, $IN, WAIT without CONTINUE before
/// it). A program cannot use this name.
inline constexpr const char* advance_stop = "advance stop";
Statement stop_of_advance(const Place& place);

/// Adds the structures and system variables of every controller as the last file. To be called before parsing.
void add_krl_types(Code& code);

void parse_krl(Code& code, int file, Problems& problems);

/// Adds an advance stop before each statement with a SIGNAL name of an input or output, or with an imported variable.
/// To be called after all files are read, because a data list may declare the names. An undeclared name that gets TRUE
/// or FALSE, like an output, may be a SIGNAL: the stop before it has the name as its argument.
void stop_at_signals(Code& code);

void run_krl(const Code& code, const ImportOptions& options, const std::vector<NamedFrame>& tools,
             const std::vector<NamedFrame>& work_objects, Program& program, Problems& problems);

/// Returns the KRL program among `files` of `folder`. routine: the requested routine; empty: none. Errors: InputError that
/// names the choices if there are several programs.
Backup krl_backup(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& files,
                  const std::string& routine);

}  // namespace dresslife::sim
