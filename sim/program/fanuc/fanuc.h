// Reader of Fanuc TP programs: listings (.ls) in English or German. The first file is run. CALL and macros find the
// other listings by name. Variable files (.va) among the files give values stored in the controller (backup.h).
//
// Supported: J, L, C and A moves to P[n] and PR[n] with %, mm/sec, cm/min, inch/min, deg/sec, sec, registers,
// WELD_SPEED; FINE, CNT, CD, ACC, Offset and Tool_Offset with a PR or a condition, RTCP; UFRAME_NUM,
// UTOOL_NUM, UFRAME[n], UTOOL[n], OVERRIDE; R[n], PR[n], PR[n,m], AR[n], LPOS, JPOS, mixed logic; LBL, JMP,
// IF, SELECT, FOR, CALL with arguments, macros, END; WAIT with a time; SPOT. All other instructions are listed as
// skipped. Instructions that may shape the motion by data of the controller (weaving, tracking, COORD, skip
// conditions) are warnings.
//
// J3 of a listing is the angle to the horizontal: q3 = J3 + J2. Angles W, P, R turn about the fixed axes x, y, z.
// P is the pose of the tool frame UT in the user frame UF, O an Offset, T a Tool_Offset: the flange is at
// UF O P T UT^-1. Positions RX, RY ... (remote tool) are the pose of UF in UT: P is its inverse.
// UF 0 is the world and UT 0 is the flange. Other frames come from the program, the job (tools "UTOOL[n]", work
// objects "UFRAME[n]") or the backup.
//
// A value that a program without a listing (KAREL) may write is unknown after its call. Branches and targets that
// depend on it are questions (run.h). An endless loop runs until it repeats itself. Source: FANUC R-30iB operator's
// manual, chapters on program structure and instructions; turns of axes 1, 4, 6 and RX as in public backups.
#pragma once

#include <deque>

#include "sim/program/interpreter/program.h"

namespace dresslife::sim {

/// Runs the first listing, or the program `options.routine`, and adds its moves and dwells to `program`. Errors and
/// questions are added to `problems`.
void read_fanuc(const std::deque<SourceFile>& files, const ImportOptions& options, const std::vector<NamedFrame>& tools,
                const std::vector<NamedFrame>& work_objects, Program& program, Problems& problems);

}  // namespace dresslife::sim
