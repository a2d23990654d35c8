#include "pipeline/commands/checking.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "pipeline/base/installation.h"
#include "pipeline/base/stage_failed.h"
#include "pipeline/cable/excess.h"
#include "pipeline/commands/options.h"
#include "pipeline/commands/results.h"
#include "pipeline/files/files.h"
#include "pipeline/job/job.h"
#include "pipeline/job/line_key.h"
#include "pipeline/job/parts_room.h"
#include "pipeline/report/preview_page.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/resolve/plausible_job.h"
#include "pipeline/study/stage_program.h"

namespace dresslife::pipeline {
namespace {

/// Adds a note if the job's slip gives a bound and no best estimate: lives with glued and with freely sliding parts differ by
/// decades. A run does not repeat it, because the job asks for this slip.
void add_slip(const Job& job, std::vector<std::string>& notes) {
  for (const Slip slip : job.strain.slip)
    if (!rubs(slip)) {
      notes.push_back(fmt::format(
          "note: strain.slip is {} at one level or more, so that the life is a bound without the ratings of cable makers. "
          "strain.slip: friction, or no key, gives the best estimate with these ratings, which may be longer than an upper bound "
          "without them",
          word(slip)));
      return;
    }
}

/// Returns whether a place lies in the shipped catalogue, which users do not edit.
bool is_shipped(const Where& where) {
  const std::filesystem::path catalogue = shipped_catalogue();
  return !as_seen_from(catalogue, where.file).string().starts_with("..");
}

[[noreturn]] void fail_motion(const std::filesystem::path& file) {
  throw StageFailed({file.string()}, "its motion cannot be computed (see above)", "correct the errors above");
}

/// Runs a stage that writes `output`. Returns whether it ran.
bool runs(const char* program, const std::filesystem::path& input, const std::filesystem::path& output,
          const std::vector<std::string>& sets) {
  std::vector<std::string> arguments{input.string(), "-o", output.string(), "--quiet"};
  for (const std::string& set : sets) arguments.insert(arguments.end(), {"--set", set});
  return run_stage_program(program, arguments) == 0;
}

std::vector<Warning> warnings_in(const std::filesystem::path& file, const Format& format) {
  return warnings_from(FileReader(file, format, FileReader::Scope::attributes).text_attribute("warnings"));
}

/// Returns the warnings of a prescribed deformation, which needs no simulation: dresslife-sim writes it in less than a second.
std::vector<Warning> warnings_of_prescribed(const std::filesystem::path& file, const std::vector<std::string>& sets) {
  const PassingFile motion("motion.h5");
  if (!runs("dresslife-sim", file, motion.path(), sets)) fail_motion(file);
  return warnings_in(motion.path(), motion_format());
}

}  // namespace

std::string estimate_line(const std::string& dresspack, const std::string& estimates) {
  return fmt::format("ESTIMATE, not in the dresspack{}{}: {}", dresspack.empty() ? "" : " ", dresspack, estimates);
}

JobCheck check_of(const std::filesystem::path& file, const std::vector<std::string>& sets,
                  const std::filesystem::path& preview_file) {
  Node document;
  const Job job = read_job(file, sets, document);
  JobCheck check;
  for (std::size_t d = 0; d < job.dresspacks.size(); ++d) {
    const Dresspack& dresspack = job.dresspacks[d].dresspack;
    const bool may_slide = slides(job.strain.slip.front());
    check.warnings = joined(std::move(check.warnings),
                            is_shipped(dresspack.where)
                                ? construction_warnings_at(line_key(job, d, "dresspack"), dresspack, may_slide)
                                : construction_warnings(dresspack, may_slide));
    if (may_slide && job.motion.needs_robot())
      check.warnings =
          joined(std::move(check.warnings), tight_warnings(line_key(job, d, "dresspack"), job.dresspacks[d]));
  }
  check.warnings = joined(std::move(check.warnings), plausibility_of_lives(job));
  add_slip(job, check.notes);
  for (std::size_t d = 0; d < job.dresspacks.size(); ++d)
    if (const std::string& estimates = job.dresspacks[d].dresspack.estimates; !estimates.empty())
      check.estimates.push_back(estimate_line(name_among(job, d), estimates));
  if (job.motion.is_prescribed()) {
    check.limits = "Not checked: strains and forces of the cables. A run may also warn of them.";
    check.warnings = located(joined(std::move(check.warnings), warnings_of_prescribed(file, sets)), document);
    check.ran = true;
    return check;
  }
  check.limits =
      "The dresspack was checked at rest and in short runs, also with a softer and a stiffer hose. A run may also warn of strains and "
      "forces of its cables, of limits at other values of slack and friction, of repeats that differ, and of modes by contact (abrasion).";
  if (print_preview(file, sets, {}, preview_file) != 0) fail_motion(file);
  try {
    check.refusal = refusal_of(preview_file);
    const FileReader preview(preview_file, preview_format(), FileReader::Scope::attributes);
    check.warnings =
        located(joined(std::move(check.warnings), warnings_from(preview.text_attribute("warnings"))), document);
    for (std::string& words : length_words(preview_file)) check.notes.push_back(std::move(words));
    const std::string followed = preview.text_attribute("short_run");
    check.ran = check.refusal.empty() && followed == "whole";
    if (followed == "none") check.limits = "The motion of the dresspack was not checked (see the note).";
    std::istringstream notes(preview.text_attribute("notes"));
    for (std::string note; std::getline(notes, note);) {
      if (note.starts_with("ESTIMATE"))
        check.estimates.push_back(note);
      else
        check.notes.push_back("note: " + note);
    }
  } catch (const InputError&) {  // the file was written just now, so its faults are no fault of the job
    throw DiskError(preview_file.string(), EIO);
  }
  return check;
}

JobCheck check_of(const std::filesystem::path& file, const std::vector<std::string>& sets) {
  return check_of(file, sets, PassingFile("preview.h5").path());
}

void add_cable_warnings(JobCheck& check, const std::filesystem::path& file, const std::vector<std::string>& sets) {
  Node document;
  const Job job = read_job(file, sets, document);
  if (!check.ran ||
      !std::ranges::all_of(job.dresspacks, [](const MountedDresspack& of) { return is_single_cable(of.dresspack); }))
    return;
  std::vector<std::string> of_run = sets;
  of_run.insert(of_run.end(), {"uncertainty.enabled=false", "simulation.most_repeats=2"});
  const PassingFile motion("motion.h5"), strain("strain.h5");
  if (!runs("dresslife-sim", file, motion.path(), of_run) ||
      !runs("dresslife-strain", motion.path(), strain.path(), {})) {
    check.notes.emplace_back(
        "note: the strains of the cable were not checked (see the error above); a run will refuse the job, too");
    return;
  }
  const std::vector<Warning> before = warnings_in(motion.path(), motion_format());
  std::vector<Warning> own = warnings_in(strain.path(), strain_format());
  std::erase_if(own, [&](const Warning& of) { return std::ranges::find(before, of) != before.end(); });
  check.warnings = joined(std::move(check.warnings), located(std::move(own), document));
}

void print_check(const JobCheck& check) {
  for (const Warning& warning : check.warnings) print(shown(warning.paragraph()));
  for (const std::string& note : check.notes) print(shown(paragraph(note)));
  for (const std::string& estimate : check.estimates) print(shown(paragraph(estimate)));
  if (!check.refusal.empty()) print(shown("The simulation refuses the job: " + check.refusal + "\n"));
}

}  // namespace dresslife::pipeline
