#include "pipeline/commands/checking.h"

#include <fmt/format.h>

#include <cerrno>
#include <sstream>

#include "pipeline/base/warning_words.h"
#include "pipeline/cable/excess.h"
#include "pipeline/commands/options.h"
#include "pipeline/commands/results.h"
#include "pipeline/files/files.h"
#include "pipeline/job/job.h"
#include "pipeline/report/preview_page.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/study/stage_program.h"

namespace dresslife::pipeline {
namespace {

/// Bounds are no best estimates: lives of glued or freely sliding parts lie decades apart.
void add_slip(const Job& job, std::vector<Warning>& warnings) {
  for (const Slip slip : job.strain.slip)
    if (!rubs(slip)) {
      warnings.push_back(warning_of(
          WarningKind::strain, "",
          fmt::format("strain.slip is {} at one level or more: the life is a bound, not a best estimate", word(slip)),
          "the job overrides the default", "strain.slip: friction, or leave the key out"));
      return;
    }
}

}  // namespace

JobCheck check_of(const std::filesystem::path& file, const std::vector<std::string>& sets) {
  const Job job = read_job(file, sets);
  JobCheck check;
  for (const MountedDresspack& mounted : job.dresspacks)
    for (Warning warning : construction_warnings(mounted.dresspack, slides(job.strain.slip.front()))) {
      if (!mounted.name.empty()) warning.where = mounted.name;
      check.warnings.push_back(warning);
    }
  add_slip(job, check.warnings);
  check.limits = "Not checked: limits of the deformation, strains and forces of the cables. A run may also warn of them.";
  if (job.motion.is_prescribed()) return check;
  check.limits =
      "The dresspack was checked at rest and in a short run. A run may also warn of tension, and of strains and forces of its "
      "cables.";
  const PassingFile told("preview.h5");
  if (tell_preview(file, sets, {}, told.path()) != 0)
    throw InputError({file.string()}, "its motion cannot be computed (see above)", "mend what is named there");
  try {
    check.refusal = refusal_of(told.path());
    const FileReader preview(told.path(), preview_format(), FileReader::Scope::attributes);
    check.warnings = joined(std::move(check.warnings), warnings_from(preview.text_attribute("warnings")));
    check.notes = length_words(told.path());
    std::istringstream notes(preview.text_attribute("notes"));
    for (std::string note; std::getline(notes, note);) check.notes.push_back("note: " + note);
  } catch (const InputError&) {  // it was written just now: no fault of the job
    throw DiskError(told.path().string(), EIO);
  }
  return check;
}

}  // namespace dresslife::pipeline
