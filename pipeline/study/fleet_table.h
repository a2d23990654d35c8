// A fleet as a table: a CSV file with one job per row, as a plant's spreadsheet has them.
//
//   name,robot,program,dresspack,routing,simulation.segments
//   body_017_weld,abb_irb6700_235_265,spot_robot_1,spot_welding,,60
//
// `name` names the job. Every other column is a key path of the job, whose values are written as in YAML; an
// empty cell leaves the base as it is. `program` stands for `motion`, or for `motion.program` where the cell
// names a controller's file (a name that ends in anything but .yaml). Cells are separated by commas, or by
// semicolons or tabs where the first line has some and no comma; quotes after RFC 4180. Blank lines, and
// lines that begin with #, do not count.
#pragma once

#include <filesystem>
#include <vector>

#include "pipeline/study/variant.h"

namespace dresslife::pipeline {

/// The rows as variants, in their order. Errors: InputError at line and column of the cell.
std::vector<Variant> table_variants(const std::filesystem::path& file);

}  // namespace dresslife::pipeline
