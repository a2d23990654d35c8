// The commands of dresslife. Each has a table of options and its own source file.
#pragma once

#include "pipeline/stage/command_line.h"

namespace dresslife::pipeline {

// Studies
Command run_command();
Command submit_command();
Command status_command();
Command report_command();
Command clean_command();
Command duty_command();
Command plan_command();
Command improve_command();
Command reprogram_command();
// Cables and their tests
Command rate_command();
Command validate_command();
Command calibrate_command();
// One job, one dresspack
Command new_command();
Command show_command();
Command check_command();
Command preview_command();
Command route_command();
Command draw_command();
Command page_command();
Command plot_command();
Command export_command();
// The program itself. Precondition: `program` outlives the command.
Command manual_command(const Command& program);

}  // namespace dresslife::pipeline
