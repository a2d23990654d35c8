#include "pipeline/commands/command.h"

#include <memory>

#include "pipeline/commands/options.h"
#include "pipeline/files/files.h"
#include "pipeline/job/cluster.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/settings/fields.h"
#include "pipeline/stage/program_manual.h"
#include "pipeline/study/ranking_columns.h"
#include "pipeline/study/study.h"
namespace dresslife::pipeline {
namespace {

int manual(const Command& program, const std::string& what) {
  if (what == "keys")
    print(study_manual() + "\n" + job_manual() + field_manual<Cluster>("cluster"));
  else if (what == "ranking.csv")
    print(ranking_manual());
  else
    print(what == "files" ? file_manual() : program_manual(program, what));
  return 0;
}

}  // namespace

Command manual_command(const Command& program) {
  const auto what = std::make_shared<std::string>();
  std::vector<std::string> references{"keys", "files", "ranking.csv"};
  references.insert(references.end(), manual_kinds().begin(), manual_kinds().end());
  return {"manual",
          "print a reference: of all keys, all files or the columns of ranking.csv (Markdown), the man page, a shell's "
          "completion",
          {{"what", "", "which one", what.get(), {.required = true, .choices = references}}},
          [&program, what] { return manual(program, *what); }};
}

}  // namespace dresslife::pipeline
