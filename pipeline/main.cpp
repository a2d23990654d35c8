// dresslife: runs studies, tells how they stand, reports their results and prints the manual.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <string_view>

#include "pipeline/base/errors.h"
#include "pipeline/base/installation.h"
#include "pipeline/base/limits.h"
#include "pipeline/base/ownership.h"
#include "pipeline/commands/command.h"
#include "pipeline/stage/program_manual.h"
#include "pipeline/stage/stage.h"

using namespace dresslife::pipeline;

namespace {

/// Becomes dresslife-import, which lies beside this program and takes the rest of the command line.
int import_program(char** arguments) {
  const std::string program = (program_folder() / "dresslife-import").string();
  ::execv(program.c_str(), arguments);
  throw InputError({program}, "cannot be started", "install dresslife's programs into one folder");
}

/// In the order of their help. `import` is told of for the help alone: it is a program of its own.
std::vector<Command> add_commands(CLI::App& program) {
  std::vector<Command> commands{add_run(program),       add_submit(program), add_status(program),
                                add_report(program),    add_clean(program),  add_improve(program),
                                add_reprogram(program), add_show(program),   add_plot(program),
                                add_export(program),    add_rate(program),   add_validate(program),
                                add_calibrate(program), add_draw(program),   add_preview(program),
                                add_page(program),      add_route(program)};
  program.add_subcommand(
      "import",
      "write a robot program (RAPID, KRL, Fanuc, columns, ROS) as a motion; see dresslife import --help");
  constexpr std::array<std::string_view, 3> write_nothing{"status", "show", "clean"};
  for (const Command& command : commands)
    if (std::find(write_nothing.begin(), write_nothing.end(), command.words->get_name()) == write_nothing.end())
      command.words->add_flag_callback("--force", let_replace_files_of_others,
                                       "replace files that dresslife did not write; never one that it reads");
  commands.push_back(add_manual(program));
  return commands;
}

}  // namespace

int main(int argc, char** argv) {
  settle_streams();
  CLI::App program(
      std::string("How long does a robot's dresspack live under its programs, which wire breaks, where, and "
                  "which motion does it?") +
          example_mark + "dresslife run two_robots",
      "dresslife");
  program.set_version_flag("--version", [] { return version_text("dresslife"); });
  program.require_subcommand(1);
  const std::vector<Command> commands = add_commands(program);
  if (argc > 1 && std::string_view(argv[1]) == "import")
    return guarded("dresslife", [&] { return import_program(argv + 1); });
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    return finish_output(program.exit(problem) == 0 ? 0 : 2);
  }
  return finish_output(guarded("dresslife", [&] {
    for (const Command& command : commands)
      if (command.words->parsed()) return command.act();
    return 0;  // not reached: one command is required
  }));
}
