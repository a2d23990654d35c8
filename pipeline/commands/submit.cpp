#include "pipeline/commands/command.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <cstdio>
#include <memory>
#include <optional>

#include "pipeline/base/errors.h"
#include "pipeline/base/installation.h"
#include "pipeline/base/text.h"
#include "pipeline/base/whole_file.h"
#include "pipeline/commands/options.h"
#include "pipeline/job/cluster.h"
#include "pipeline/study/folder_source.h"
#include "pipeline/study/shards.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

struct SubmitOptions : StudyOptions {
  std::string cluster = "slurm";
  std::optional<int> tasks;
  bool only_write = false;
};

/// Returns the batch script: the same `dresslife run` as on one machine, with a launcher. In an array of allocations each
/// allocation runs its shard. An allocation that is started again continues.
std::string script_of(const SubmitOptions& options, const Cluster& cluster, const StudyState& standing) {
  constexpr double megabyte = 1e6;
  const int tasks = options.tasks.value_or(cluster.tasks);
  const auto memory = static_cast<long>(cluster.memory / megabyte);
  const auto whole = [](const fs::path& file) { return shell_word(fs::absolute(file).string()); };
  const fs::path log = standing.places.folder / "submit.log";
  std::string text = "#!/bin/sh\n# Written by dresslife submit. Submitted again, it continues the study.\n";
  text += fmt::format(
      "#SBATCH --job-name={}\n#SBATCH --ntasks={} --cpus-per-task=1 --mem-per-cpu={}\n#SBATCH --requeue --output=/dev/null\n",
      standing.study.name, tasks, memory);
  if (!cluster.options.empty()) text += fmt::format("#SBATCH {}\n", cluster.options);
  text += fmt::format("cd {} && exec >>{} 2>&1 || exit 1\n", shell_word(fs::current_path().string()), whole(log));
  text +=
      fmt::format("exec {} run {} -o {}", whole(program_file()), whole(request_of(options).file), whole(options.out));
  for (const std::string& set : options.sets) text += " --set " + shell_word(set);
  text += fmt::format(" \\\n  --quiet --jobs {} --job-memory {} --launcher {} \\\n", tasks, memory,
                      shell_word(cluster.launcher));
  return text + "  ${SLURM_ARRAY_TASK_ID:+--shard \"$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT\"}\n";
}

/// Submits the script. Returns its name in the queue. Errors: InputError when the queue does not accept it.
std::string submitted(const Cluster& cluster, const std::string& more, const fs::path& script) {
  const std::string command = cluster.submit + more + ' ' + shell_word(fs::absolute(script).string());
  std::fflush(nullptr);
  std::FILE* const said = ::popen(command.c_str(), "r");
  std::string name;
  for (int c = 0; said && (c = std::fgetc(said)) != EOF;)
    if (name.size() < 100) name += static_cast<char>(c);
  const int status = said ? ::pclose(said) : -1;
  name = name.substr(0, name.find_first_of(";\n"));  // "17;cluster"
  if (status == 0 && !name.empty() && name.find_first_not_of("0123456789") == std::string::npos) return name;
  throw InputError(
      {script.string()},
      fmt::format("'{}' did not take it ({})", cluster.submit,
                  WIFEXITED(status) && WEXITSTATUS(status) != 0 ? fmt::format("exit status {}", WEXITSTATUS(status))
                                                                : "it printed no number"),
      "see what it said, and the options of the cluster's file (--cluster)");
}

int submit(const SubmitOptions& options) {
  const Cluster cluster = read_cluster(named_file(options.cluster, "clusters"));
  const StudyRequest request = request_of(options);
  check_source(request.out / study_name(request.file), request.file);
  const StudyState standing = expanded(request);
  if (standing.all_done()) {
    print(shown(fmt::format("{}: nothing to do; see dresslife report\n", standing.study.name)));
    return 0;
  }
  const int shards = shards_needed(standing, cluster.most_stages);
  const fs::path script = standing.places.folder / "submit.sh";
  fs::create_directories(standing.places.folder);
  claim_folder(standing.places.folder, request.file);
  write_text_if_changed(script, with_mark(script_of(options, cluster, standing), Mark::script));
  const std::string array = shards > 1 ? fmt::format(" --array=1-{}", shards) : "";
  if (options.only_write) {
    print(shown(fmt::format(
        "{0} is written; submit it: {1}{2} {0}{3}\n", script.string(), cluster.submit, array,
        shards > 1
            ? fmt::format(
                  "\nThen the rest and the ranking, with the number that this prints: {} --dependency=afterany:NUMBER {}",
                  cluster.submit, script.string())
            : "")));
    return 0;
  }
  std::string last = submitted(cluster, array, script);
  std::string message = fmt::format("{}: job {}", standing.study.name, last);
  if (shards > 1) {  // a last allocation runs the missing stages and ranks the jobs
    last = submitted(cluster, " --dependency=afterany:" + last, script);
    message += fmt::format(" of {} shards, ranked by job {}", shards, last);
  }
  print(shown(fmt::format("{}\nFollow it: dresslife status {}; its messages: {}\n", message, options.study,
                          (standing.places.folder / "submit.log").string())));
  return 0;
}

}  // namespace

Command submit_command() {
  const auto options = std::make_shared<SubmitOptions>();
  return {"submit", "let a cluster's queue run a study: the same graph, each stage behind the cluster's launcher",
          joined({{study_or_job(*options),
                   {"--cluster", "", "YAML of config/clusters, or a file", &options->cluster},
                   number_option("-n,--tasks", "N", "stages at a time, a core each; default: the cluster's tasks",
                                 &options->tasks, 1, 1024),
                   {"--only-write", "", "write the batch script, and submit nothing", &options->only_write}},
                  study_options(*options)}),
          [options] { return submit(*options); }};
}

}  // namespace dresslife::pipeline
