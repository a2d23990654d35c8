// Reader of Universal Robots' URScript (.script, .urscript), as PolyScope writes it or as programs send it.
//
// Supported: def, global and local variables, if, while, return, break, continue, halt; lists and poses p[x, y, z, rx, ry,
// rz]; movej, movel, movep, movec, servoj, servoc with a, v, t, r; get_inverse_kin with qnear, get_forward_kin,
// pose_trans, pose_inv, pose_add, pose_sub, interpolate_pose and arithmetic; set_tcp; sleep. Threads run in parallel to
// the program: their variables are unknown, and a thread that moves the robot is a warning. All other instructions are
// listed as skipped.
//
// Names that differ only in case are different names. Questions give them numbers ("count#2").
// Source: The URScript Programming Language (Universal Robots, script manual 5.11).
#pragma once

#include "sim/program/interpreter/interpreter.h"

namespace dresslife::sim {

/// Adds the record types of poses and of the results of get_inverse_kin and get_forward_kin.
void add_urscript_types(Code& code);

void parse_urscript(Code& code, int file, Problems& problems);

/// Runs the parsed scripts and adds moves and dwells to `program`. The tool "tcp" of `tools` is the tool of the
/// installation, for scripts without set_tcp. Scripts have no work objects.
void run_urscript(const Code& code, const ImportOptions& options, const std::vector<NamedFrame>& tools,
                  const std::vector<NamedFrame>& work_objects, Program& program, Problems& problems);

}  // namespace dresslife::sim
