// dresslife-import: a robot program in, the same motion as YAML out.
#include <fmt/format.h>

#include <cstdio>

#include "pipeline/stage.h"
#include "sim/program/import.h"

namespace {

using namespace dresslife;

pipeline::BranchAssumption assumption_of(const std::string& written) {
  const std::size_t equals = written.rfind('=');
  const std::string take = equals == std::string::npos ? "" : written.substr(equals + 1);
  if (take != "then" && take != "else")
    throw pipeline::InputError({"--assume " + written}, "is not LINE=then or LINE=else",
                               "write for example --assume main.mod:12=then");
  return {written.substr(0, equals), take == "then" ? pipeline::BranchAssumption::Take::then_branch
                                                    : pipeline::BranchAssumption::Take::else_branch};
}

pipeline::Motion request(const pipeline::StageCall& call) {
  pipeline::Motion motion;
  if (!call.options[3].empty()) motion = pipeline::motion_from(pipeline::read_yaml(call.options[3].back()));
  motion.program = call.input;
  motion.source = "imported from " + call.input.filename().string();
  if (!call.options[0].empty()) motion.routine = call.options[0].back();
  for (const std::string& written : call.options[1]) motion.assume.push_back(assumption_of(written));
  for (const std::string& file : call.options[2]) motion.modules.push_back({file});
  return motion;
}

}  // namespace

int main(int argc, char** argv) {
  const pipeline::StageInfo info{
      .program = "dresslife-import",
      .purpose =
          "Reads a robot program (RAPID, KRL, Fanuc, joint columns, ROS) and writes its motion as YAML.",
      .input = "PROGRAM",
      .output = "motion.yaml",
      .example = "dresslife-import config/programs/side_panel.mod -o motion.yaml",
      .input_is_job = true,
      .options = {
          {"--routine", "NAME", "where to start; without it main, or the first routine"},
          {"--assume", "LINE=then|else", "how a branch goes that hangs on inputs; LINE may be FILE:LINE"},
          {"--module", "FILE", "a further module, data file or called program"},
          {"--frames", "FILE.yaml", "tools and work_objects that lie in the controller"}}};
  return pipeline::run_stage(
      info, argc, argv, [](const pipeline::StageCall& call, pipeline::Progress& progress) {
        const pipeline::Motion asked = request(call);
        const sim::Program program = sim::read_program(asked);
        progress.clear();
        if (!call.quiet)
          for (const std::string& line : sim::skipped_lines(program)) fmt::print(stderr, "{}\n", line);
        pipeline::write_text_if_changed(call.output, pipeline::motion_text(sim::motion_of(program, asked)));
        progress.note(
            fmt::format("{}: {} moves and dwells", call.output.string(), program.instructions.size()));
      });
}
