// dresslife: runs studies, prints their state, reports their results and prints the manual.
#include <unistd.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "pipeline/base/errors.h"
#include "pipeline/base/installation.h"
#include "pipeline/base/limits.h"
#include "pipeline/base/ownership.h"
#include "pipeline/base/stage_failed.h"
#include "pipeline/commands/command.h"
#include "pipeline/stage/command_line.h"
#include "pipeline/stage/stage.h"

using namespace dresslife::pipeline;

namespace {

/// Becomes dresslife-import, which lies beside this program and takes the rest of the command line.
int import_program(char** arguments) {
  const std::string program = (program_folder() / "dresslife-import").string();
  ::execv(program.c_str(), arguments);
  throw InputError({program}, "cannot be started", "install dresslife's programs into one folder");
}

/// In the order of their help. `import` stands there for the help alone: it is a program of its own.
std::vector<Command> commands(const Command& program, bool& force) {
  std::vector<Command> all{
      run_command(),
      submit_command(),
      status_command(),
      report_command(),
      clean_command(),
      duty_command(),
      plan_command(),
      improve_command(),
      reprogram_command(),
      new_command(),
      show_command(),
      check_command(),
      plot_command(),
      export_command(),
      rate_command(),
      validate_command(),
      calibrate_command(),
      draw_command(),
      preview_command(),
      page_command(),
      route_command(),
      {"import",
       "write a robot program (RAPID, KRL, Fanuc, INFORM, URScript, columns, ROS) as a motion; see dresslife import "
       "--help"},
      manual_command(program)};
  constexpr std::array<std::string_view, 6> write_nothing{"status", "show", "check", "clean", "import", "manual"};
  for (Command& command : all)
    if (std::ranges::find(write_nothing, command.name) == write_nothing.end())
      command.options.push_back(
          {"--force", "", "replace files that dresslife did not write; never one that it reads", &force});
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  settle_streams();
  return guarded("dresslife", [&] {
    if (argc > 1 && std::string_view(argv[1]) == "import") return import_program(argv + 1);
    Command program{.name = "dresslife",
                    .purpose =
                        "How long does a robot's dresspack live under its programs, which wire breaks, where, and "
                        "which motion does it?",
                    .example = "dresslife run two_robots"};
    bool force = false;
    program.commands = commands(program, force);
    const Command* called = nullptr;
    if (const auto status = read_command_line(program, argc, argv, &called)) return *status;
    if (force) let_replace_files_of_others();
    try {
      return finish_output(called->act());
    } catch (const StageFailed&) {  // the stage has printed its error
      return 1;
    }
  });
}
