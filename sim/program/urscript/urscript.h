// Universal Robots' URScript (.script, .urscript), as PolyScope writes it or as programs send it.
//
// Read: def, global and local variables, if, while, return, break, continue, halt; lists and poses p[x, y, z, rx, ry,
// rz]; movej, movel, movep, movec, servoj, servoc with a, v, t, r; get_inverse_kin with qnear, get_forward_kin,
// pose_trans, pose_inv, pose_add, pose_sub, interpolate_pose and arithmetic; set_tcp; sleep. Threads run beside the
// program: values that they write are unknown, and one that moves the robot is named. All else is listed as skipped.
//
// Names that differ only in case are different names; questions number them ("count#2").
// Source of the meaning: The URScript Programming Language (Universal Robots, script manual 5.11).
#pragma once

#include "sim/program/interpreter/interpreter.h"

namespace dresslife::sim {

/// Records of poses and of what get_inverse_kin and get_forward_kin give.
void add_urscript_types(Code& code);

void parse_urscript(Code& code, int file, Problems& problems);

/// tools: "tcp" is that of the installation, for scripts without set_tcp.
void run_urscript(const Code& code, const ImportOptions& options, const std::vector<NamedFrame>& tools,
                  Program& program, Problems& problems);

}  // namespace dresslife::sim
