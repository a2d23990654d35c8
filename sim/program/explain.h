// The explanation of an imported program: its moves with tool, work object, speed and zone, and the origin of each.
#pragma once

#include "sim/program/interpreter/program.h"

namespace dresslife::sim {

/// One line (wrapped here) for each move and dwell, in their order:
/// "cell.mod:40 main: MoveL p20,v500,z10,gun\WObj:=jig;
///  | linear to 100 200 300 mm, abb 0 -1 2 1 (p20: data.mod:4)
///  | tool gun 0 0 250 mm (gun: data.mod:2) | work object ... | 500 mm/s (v500) | zone 10 mm (z10)"
std::vector<std::string> explanation(const Program& program);

}  // namespace dresslife::sim
