#include "pipeline/stage.h"

#include <CLI/CLI.hpp>
#include <cstdio>

#include "pipeline/files/digest.h"
#include "pipeline/installation.h"
#include "pipeline/job/job.h"
#include "pipeline/program_manual.h"
#include "pipeline/threads.h"

namespace dresslife::pipeline {
namespace {

const char* part_name(Part part) {
  switch (part) {
    case Part::sim:
      return "robot, motion, dresspack, routing or simulation";
    case Part::strain:
      return "dresspack.components or strain";
    case Part::fatigue:
      return "dresspack.materials or fatigue";
  }
  return "";
}

void check_output(const StageCall& call) {
  std::error_code failure;
  if (call.info.may_lack_output && call.output.empty()) return;
  if (std::filesystem::is_directory(call.output, failure))
    throw InputError({call.output.string()}, "is a folder (the output must be a file)",
                     "name a file after -o");
  if (std::filesystem::equivalent(call.input, call.output, failure))
    throw InputError({call.output.string()}, "is the input itself", "name another output after -o");
  const auto folder = call.output.parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder, failure))
    throw InputError({call.output.string()}, "lies in a folder that does not exist",
                     fmt::format("make {} first", folder.string()));
}

}  // namespace

int run_stage(const StageInfo& info, int argc, char** argv,
              const std::function<void(const StageCall&, Progress&)>& body) {
  StageCall call;
  call.info = info;
  CLI::App app(info.purpose + example_mark + info.example, info.program);
  std::string input, output, job_file;
  app.add_option("input", input, info.input)->required()->type_name("");
  app.add_option("-o,--output", output, "where to write " + info.output)
      ->required(!info.may_lack_output)
      ->type_name("FILE");
  if (!info.input_is_job)
    app.add_option("--job", job_file, "take the settings from this job instead of the one in the input")
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
    return app.exit(problem) == 0 ? 0 : 2;
  }
  call.input = input;
  call.output = output;
  call.job_file = job_file;

  return guarded(info.program, [&] {
    Progress progress(info.program, call.quiet);
    check_output(call);
    if (!info.input_is_job)  // jobs are short
      call.input_sha256 = beside<std::string>([file = call.input] { return sha256_of_file(file); }).share();
    body(call, progress);
    return 0;
  });
}

int guarded(const std::string& program, const std::function<int()>& body) {
  try {
    return body();
  } catch (const InputError& problem) {
    fmt::print(stderr, "{}\n", problem.what());
    return 1;
  } catch (const std::filesystem::filesystem_error& problem) {
    fmt::print(stderr, "{}: error: {}; check the folder and its permissions\n", problem.path1().string(),
               problem.code().message());
    return 1;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr,
               "{}: error: out of memory; run fewer jobs at a time or ask for fewer segments or samples\n",
               program);
    return 3;
  } catch (const std::exception& problem) {
    fmt::print(stderr, "{}: error: internal fault ({}); please report it with the job\n", program,
               problem.what());
    return 3;
  }
}

Job job_of(const StageCall& call, const FileReader& input, const std::vector<Part>& before) {
  const std::string own_text = input.text_attribute("job");
  const std::string own_name = input.where().file + " (attribute job)";
  const Job own = job_from(parse_yaml(own_text, own_name));
  const Job job = call.job_file.empty() ? job_from(parse_yaml(own_text, own_name), call.sets)
                                        : read_job(call.job_file, call.sets);
  for (Part part : before)
    if (part_text(own, part) != part_text(job, part))
      throw InputError(input.where(),
                       fmt::format("was made with other settings of {} than this job has", part_name(part)),
                       fmt::format("run the stage before again with the same --job and --set, then {}",
                                   call.info.program));
  return job;
}

void stamp(FileWriter& file, const StageCall& call, const Job& job, const std::string& earlier) {
  // The output's name stays out of the history: the same input gives the same bytes wherever they go.
  std::string line = fmt::format("{} {}: {} {}", call.info.program, version(), call.info.program,
                                 call.input.filename().string());
  if (!call.job_file.empty()) line += " --job " + call.job_file.filename().string();
  for (const std::string& set : call.sets) line += " --set " + set;
  file.attribute("job", job_text(job));
  file.attribute("history", earlier.empty() ? line : earlier + "\n" + line);
  file.attribute("input_sha256",
                 call.input_sha256.valid() ? call.input_sha256.get() : sha256_of_file(call.input));
}

}  // namespace dresslife::pipeline
