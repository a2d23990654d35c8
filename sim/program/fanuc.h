// Fanuc TP programs as listings (.ls): the first file is run, CALL finds the others by their names.
//
// Read: J, L, C and A moves to P[n] and PR[n] with %, mm/sec, cm/min, inch/min, deg/sec, sec and registers;
// FINE, CNT, ACC, Offset and Tool_Offset with a PR; UFRAME_NUM, UTOOL_NUM, UFRAME[n], UTOOL[n]; R[n] and
// PR[n]; LBL, JMP, IF, SELECT, FOR, CALL, END; WAIT with a time; SPOT. Everything else is listed as skipped.
// The controller gives J3 against the horizontal: q3 = J3 + J2. Angles W, P, R turn about the fixed axes x,
// y, z. Frames of numbers above 0 lie in the controller: give them as tools "UTOOL[n]" and work objects
// "UFRAME[n]". Source: FANUC R-30iB operator's manual, chapters on program structure and instructions.
#pragma once

#include <deque>

#include "sim/program/program.h"

namespace dresslife::sim {

void read_fanuc(const std::deque<SourceFile>& files, const ImportOptions& options,
                const std::vector<NamedFrame>& tools, const std::vector<NamedFrame>& work_objects,
                Program& program, Problems& problems);

}  // namespace dresslife::sim
