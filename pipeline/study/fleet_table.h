// A fleet as a table: a CSV file with one job per row, in the form of a plant's spreadsheet.
//
//   name,robot,program,dresspack,routing,simulation.segments
//   body_017_weld,abb_irb6700_235_265,spot_robot_1,spot_welding,,60
//
// `name` names the job. Every other column is a key path of the job. Its values are written as in YAML; an
// empty cell keeps the value of the base. `program` means `motion`, or `motion.program` if the cell
// names a controller's file (a name with an ending other than .yaml). Cells are separated by commas, or by
// semicolons or tabs if the first line contains some and no comma; quotes after RFC 4180. Blank lines and
// lines that begin with # are ignored.
#pragma once

#include <filesystem>
#include <vector>

#include "pipeline/study/variant.h"

namespace dresslife::pipeline {

/// Returns the rows as variants, in their order. Errors: InputError with line and column of the cell.
std::vector<Variant> table_variants(const std::filesystem::path& file);

}  // namespace dresslife::pipeline
