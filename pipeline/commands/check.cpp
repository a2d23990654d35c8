#include "pipeline/commands/command.h"

#include <memory>

#include "pipeline/base/errors.h"
#include "pipeline/base/lists.h"
#include "pipeline/commands/as_json.h"
#include "pipeline/commands/checking.h"
#include "pipeline/commands/options.h"

namespace dresslife::pipeline {
namespace {

struct CheckOptions {
  std::string job;
  std::vector<std::string> sets;
  bool json = false;
};

int check(const CheckOptions& options) {
  const std::filesystem::path job = named_file(options.job, "jobs");
  JobCheck check = check_of(job, options.sets);
  add_cable_warnings(check, job, options.sets);
  if (options.json) {
    print(Json{{"job", job.string()},
               {"refusal", check.refusal.empty() ? Json(std::nan("")) : Json(check.refusal)},
               {"warnings", mapped(check.warnings, [](const Warning& warning) { return json_of(warning); })},
               {"notes", check.notes},
               {"estimates", check.estimates},
               {"not_checked", check.limits}}
              .text +
          "\n");
    return check.refusal.empty() ? 0 : 1;
  }
  print_check(check);
  if (!check.refusal.empty()) return 1;
  print(paragraph(check.limits));
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
          {{"job", "", "JOB.yaml", &options->job, {.required = true}},
           json_option(options->json),
           sets_option("override a key", options->sets)},
          [options] { return check(*options); }};
}

}  // namespace dresslife::pipeline
