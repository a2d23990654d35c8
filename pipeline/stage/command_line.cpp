#include "pipeline/stage/command_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "pipeline/base/installation.h"
#include "pipeline/stage/program_manual.h"

namespace dresslife::pipeline {

std::optional<int> read_command_line(const StageInfo& info, int argc, char** argv, StageCall& call,
                                     StageFlags& flags) {
  call.info = info;
  CLI::App app(info.purpose + example_mark + info.example, info.program);
  std::string input, output, job_file, receipt, likes;
  CLI::Option* job = nullptr;
  app.add_option("input", input, info.input)->required()->type_name("");
  app.add_option("-o,--output", output, "where to write " + info.output)
      ->required(!info.may_lack_output)
      ->type_name("FILE");
  if (!info.input_is_job)
    job = app.add_option("--job", job_file, "take the settings from this job instead of the one in the input")
              ->type_name("JOB.yaml");
  app.add_option("--set", call.sets,
                 "override a key of the job, for example simulation.segments=80; may be repeated")
      ->type_name("KEY.PATH=VALUE")
      ->allow_extra_args(false);
  call.options.resize(info.options.size());
  for (std::size_t i = 0; i < info.options.size(); ++i)
    if (info.options[i].value.empty())
      app.add_flag_callback(
          info.options[i].name, [&call, i] { call.options[i].emplace_back(); }, info.options[i].meaning);
    else
      app.add_option(info.options[i].name, call.options[i], info.options[i].meaning)
          ->type_name(info.options[i].value)
          ->allow_extra_args(false);
  app.add_flag("--force", flags.force, "replace files that dresslife did not write; never one that it reads");
  if (info.part) {
    CLI::Option* noted =
        app.add_option("--receipt", receipt,
                       "note there from what the output is made, and make it only when that has changed")
            ->type_name("FILE");
    if (job) noted->needs(job);
    app.add_option("--likes", likes,
                   "a list of folders that get the same output and note, each under its name")
        ->type_name("FILE")
        ->needs(noted);
  }
  app.add_option("--job-time", call.limits.seconds, "give up after so long")->type_name("SECONDS");
  app.add_option("--job-memory", call.limits.megabytes, "take no more memory than this")->type_name("MB");
  app.add_flag("--quiet", call.quiet, "no progress, no notes");
  app.set_version_flag("--version", [&info] { return version_text(info.program); });
  app.add_option_function<std::string>(
         "--manual",
         [&app](const std::string& kind) {
           std::fputs(program_manual(app, kind).c_str(), stdout);
           throw CLI::Success();
         },
         "print this program's man page, or its completion for a shell")
      ->check(CLI::IsMember(manual_kinds()))
      ->type_name(fmt::format("{}", fmt::join(manual_kinds(), "|")))
      ->trigger_on_parse();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    return finish_output(app.exit(problem) == 0 ? 0 : 2);
  }
  call.input = input;
  call.output = output;
  call.job_file = job_file;
  flags.receipt = receipt;
  flags.likes = likes;
  call.of_a_study = !receipt.empty();
  return {};
}

}  // namespace dresslife::pipeline
