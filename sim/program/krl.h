// KUKA KRL: .src files with the .dat files that declare their data, run from the first routine unless told
// otherwise.
//
// Read: DEF, DEFFCT, DEFDAT, declarations, assignment, IF, FOR, WHILE, REPEAT, LOOP, SWITCH, RETURN; PTP,
// LIN, CIRC with CA, PTP_REL, LIN_REL, SPTP, SLIN, SCIRC, SPL and SPLINE blocks with WITH, C_PTP, C_DIS,
// C_VEL, C_ORI; BAS; $VEL, $ACC, $VEL_AXIS, $ACC_AXIS, $APO, $TOOL, $BASE; WAIT SEC. FOLD lines are comments.
// Everything else is listed as skipped. SPL points of a block are joined by a smooth curve of cubics, cut into lines.
// Angles A, B, C turn about z, y', x''. Source: KUKA System Software, operating and programming instructions
// for system integrators.
#pragma once

#include "sim/program/interpreter.h"

namespace dresslife::sim {

void parse_krl(Code& code, int file, Problems& problems);

void run_krl(const Code& code, const ImportOptions& options, const std::vector<NamedFrame>& tools,
             const std::vector<NamedFrame>& work_objects, Program& program, Problems& problems);

}  // namespace dresslife::sim
