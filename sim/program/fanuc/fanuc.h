// Fanuc TP programs as listings (.ls), English or German: the first file is run, CALL and macros find the
// others by their names; variable files (.va) among the files give what lay in the controller
// (backup.h).
//
// Read: J, L, C and A moves to P[n] and PR[n] with %, mm/sec, cm/min, inch/min, deg/sec, sec, registers,
// WELD_SPEED; FINE, CNT, CD, ACC, Offset and Tool_Offset with a PR or a condition, RTCP; UFRAME_NUM,
// UTOOL_NUM, UFRAME[n], UTOOL[n], OVERRIDE; R[n], PR[n], PR[n,m], AR[n], LPOS, JPOS, mixed logic; LBL, JMP,
// IF, SELECT, FOR, CALL with arguments, macros, END; WAIT with a time; SPOT. Everything else is listed: what
// lies in the controller and may shape the motion (weaving, tracking, COORD, skip conditions) as a warning.
//
// The controller gives J3 against the horizontal: q3 = J3 + J2. Angles W, P, R turn about the fixed axes x,
// y, z. With P the pose of the tool frame UT in the user frame UF, O an Offset and T a Tool_Offset, the
// flange is at UF O P T UT^-1. Positions RX, RY ... (remote tool) are those of UF in UT: P is their inverse.
// Frames 0 are the world and the flange; others come from the program, the job (tools "UTOOL[n]", work
// objects "UFRAME[n]") or the backup.
//
// What programs that are not read (KAREL) may write is unknown behind them; branches and targets that need it
// are asked for (run.h). An endless loop runs until it repeats itself. Source: FANUC R-30iB operator's
// manual, chapters on program structure and instructions; turns of axes 1, 4, 6 and RX as in public backups.
#pragma once

#include <deque>

#include "sim/program/interpreter/program.h"

namespace dresslife::sim {

void read_fanuc(const std::deque<SourceFile>& files, const ImportOptions& options,
                const std::vector<NamedFrame>& tools, const std::vector<NamedFrame>& work_objects,
                Program& program, Problems& problems);

}  // namespace dresslife::sim
