// dresslife-import: a robot program in, the same motion as YAML out.
#include <fmt/format.h>

#include <charconv>
#include <cstdio>
#include <filesystem>

#include "pipeline/base/limits.h"
#include "pipeline/base/whole_file.h"
#include "pipeline/stage/stage.h"
#include "sim/program/explain.h"
#include "sim/program/import.h"

namespace {

using namespace dresslife;

enum Option { routine, assume, module, frames, value, passes, explain };

/// "NAME=VALUE" cut at its first or last '='.
std::pair<std::string, std::string> halves(const std::string& option, const std::string& written,
                                           std::size_t equals, const std::string& example) {
  if (equals == std::string::npos || equals == 0 || equals + 1 == written.size())
    throw pipeline::InputError({option + " " + written}, "has nothing before or behind '='",
                               "write for example " + option + " " + example);
  return {written.substr(0, equals), written.substr(equals + 1)};
}

pipeline::Motion request(const pipeline::StageCall& call) {
  const auto& given = call.options;
  pipeline::Motion motion;
  if (!given[frames].empty()) motion = pipeline::motion_from(pipeline::read_yaml(given[frames].back()));
  motion.program = call.input;
  const std::filesystem::path input = std::filesystem::absolute(call.input).lexically_normal();
  motion.source = "imported from " + (input.has_filename() ? input : input.parent_path()).filename().string();
  if (!given[routine].empty()) motion.routine = given[routine].back();
  for (const std::string& written : given[assume]) {
    const auto [line, take] = halves("--assume", written, written.rfind('='), "main.mod:12=then");
    motion.assume.push_back({line, take});
  }
  for (const std::string& file : given[module]) motion.modules.push_back({file});
  for (const std::string& written : given[value]) {
    const auto [name, text] = halves("--value", written, written.find('='), "di5=1");
    motion.values.push_back({name, text});
  }
  if (!given[passes].empty()) {
    const std::string& written = given[passes].back();
    const char* end = written.data() + written.size();
    const auto read = std::from_chars(written.data(), end, motion.passes);
    if (read.ec != std::errc() || read.ptr != end || motion.passes < 1)
      throw pipeline::InputError({"--passes " + written}, "is no number of passes",
                                 "write a whole number from 1 on");
  }
  return motion;
}

}  // namespace

int main(int argc, char** argv) {
  const pipeline::StageInfo info{
      .program = "dresslife-import",
      .purpose =
          "Reads a robot program (RAPID, KRL, Fanuc, joint columns, ROS), or the folder of a controller's "
          "backup, "
          "and writes its motion as YAML.",
      .input = "PROGRAM or FOLDER",
      .output = "motion.yaml",
      .example = "dresslife-import config/programs/side_panel.mod -o motion.yaml",
      .input_is_job = true,
      .may_lack_output = true,
      .options = {{"--routine", "NAME",
                   "where to start, with arguments where it takes some: 'name(1, p20)'; without it "
                   "main, or the first routine"},
                  {"--assume", "LINE=then|else|VALUE",
                   "how a branch goes that hangs on inputs, or the value by which a "
                   "choice of several goes; LINE may be FILE:LINE"},
                  {"--module", "FILE", "a further module, data file or called program"},
                  {"--frames", "FILE.yaml", "tools and work_objects that lie in the controller"},
                  {"--value", "NAME=VALUE",
                   "an input, register, variable or position that only the running robot knows"},
                  {"--passes", "N", "of an endless main loop; without it until the program repeats itself"},
                  {"--explain", "",
                   "print each move with tool, work object, speed and zone, and where each comes from"}}};
  return pipeline::run_stage(
      info, argc, argv, [](const pipeline::StageCall& call, pipeline::Progress& progress) {
        if (call.output.empty() && call.options[explain].empty())
          throw pipeline::InputError({call.input.string()}, "would be read for nothing",
                                     "name a file with -o, or ask for --explain");
        const pipeline::Motion asked = request(call);
        const sim::Program program = sim::read_program(asked);
        progress.clear();
        if (!call.options[explain].empty())
          for (const std::string& line : sim::explanation(program)) fmt::print("{}\n", line);
        if (!call.quiet)
          for (const std::string& line : sim::skipped_lines(program)) pipeline::tell(line + "\n");
        if (call.output.empty()) return;
        pipeline::write_text_if_changed(
            call.output,
            pipeline::with_mark(pipeline::motion_text(sim::motion_of(program, asked)), pipeline::Mark::yaml));
        progress.note(
            fmt::format("{}: {} moves and dwells", call.output.string(), program.instructions.size()));
      });
}
