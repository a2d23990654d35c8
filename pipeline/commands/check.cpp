#include "pipeline/commands/command.h"

#include <memory>

#include "pipeline/base/errors.h"
#include "pipeline/commands/checking.h"
#include "pipeline/commands/options.h"

namespace dresslife::pipeline {
namespace {

struct CheckOptions {
  std::string job;
  std::vector<std::string> sets;
};

int check(const CheckOptions& options) {
  const std::filesystem::path job = named_file(options.job, "jobs");
  const JobCheck check = check_of(job, options.sets);
  print_check(check);
  if (!check.refusal.empty()) return 1;
  print(check.limits + "\n");
  const std::size_t warnings = check.warnings.size();
  print(shown(fmt::format("{}: {}\n", job.string(),
                          warnings == 0   ? std::string("no warnings")
                          : warnings == 1 ? std::string("1 warning")
                                          : fmt::format("{} warnings", warnings))));
  return 0;
}

}  // namespace

Command check_command() {
  const auto options = std::make_shared<CheckOptions>();
  return {"check",
          "check a job in seconds, before its run: units, joint limits, lengths over the whole program, slack and "
          "clearance of the cables, slip",
          {{"job", "", "JOB.yaml", &options->job, {.required = true}}, sets_option("override a key", options->sets)},
          [options] { return check(*options); }};
}

}  // namespace dresslife::pipeline
