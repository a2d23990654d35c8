#include "pipeline/resolve/job_text.h"

#include <algorithm>

#include "pipeline/base/joined.h"
#include "pipeline/base/ownership.h"
#include "pipeline/base/plain_file.h"
#include "pipeline/cable/overlap.h"
#include "pipeline/cable/stiffness.h"
#include "pipeline/job/job_forms.h"
#include "pipeline/resolve/apply_calibration.h"
#include "pipeline/resolve/catalogue.h"
#include "pipeline/resolve/check_job.h"
#include "pipeline/resolve/complete.h"
#include "pipeline/resolve/data_sheet.h"
#include "pipeline/resolve/document_kind.h"
#include "pipeline/resolve/plausible_job.h"
#include "pipeline/resolve/sources.h"
#include "pipeline/resolve/urdf_request.h"
#include "pipeline/settings/fields.h"
#include "pipeline/settings/problems.h"

namespace dresslife::pipeline {

namespace {

/// Checks that a job has exactly one of the two forms of dresspacks; if it has both, keeps the list.
void check_forms(Node& document, Problems& problems) {
  const Node* list = document.find("dresspacks");
  for (const char* key : {"dresspack", "routing"}) {
    const Node* alone = document.find(key);
    if (list && alone)
      problems.add(alone->where,
                   fmt::format("both dresspacks and {0} are given (each of the list has its own {0})", key),
                   "keep one of the two");
    const Node* motion = document.find("motion");
    const bool of_rig = key == std::string_view("routing") && motion && (motion->find("rig") || !motion->is_map());
    if (!list && !alone && !of_rig)
      problems.add(document.where, fmt::format("{} is missing (and there is no list dresspacks)", key),
                   "give dresspack and routing, or a list dresspacks of name, dresspack, routing", key);
  }
  if (!list) return;
  if (!list->is_list() || list->items.empty())
    problems.add(list->where, "dresspacks holds no dresspack", "write a list of name, dresspack and routing",
                 "dresspacks");
  std::erase_if(document.entries, [](const Entry& e) { return e.key == "dresspack" || e.key == "routing"; });
}

void take_length_of_rig(Job& job) {
  if (job.motion.rig)
    job.dresspacks.front().routing.free_length = rig_length(*job.motion.rig, job.dresspacks.front().dresspack.diameter);
}

/// Reads a job. Resolves the names in the document.
Job resolved_job(Node& document, const std::vector<std::string>& sets) {
  if (!document.is_map()) throw InputError(document.where, "holds no job", "write robot, motion, dresspack, routing");
  if (document.find("base") || (!document.find("robot") && !document.find("motion")))
    refuse_other_kind(document, DocumentKind::job);
  Problems problems;
  problems.attempt("", document.where, [&] { apply_lines(document); });
  for (const std::string& set : sets) problems.attempt("", {"--set " + set}, [&] { apply_set(document, set); });
  resolve_job(document, problems);
  check_forms(document, problems);
  if (const Node* calibration = document.find("calibration"))
    problems.attempt("calibration", calibration->where, [&] { read_calibration(document); });
  Job job;
  if (document.find("dresspacks")) job.dresspacks.clear();
  read_fields(document, Describe([&](Fields& f) { describe(f, job); }), problems);
  const std::initializer_list<const char*> parts{"calibration", "simulation", "strain",    "fatigue",
                                                 "uncertainty", "dresspack",  "dresspacks"};
  if (std::ranges::none_of(parts, [&](const char* part) { return problems.touch(part); }))
    problems.attempt("calibration", document.where, [&] {
      apply_calibration(document, job);
      apply_ratings(document, job);
    });
  complete_job(job, document, problems);
  check_job(job, document, problems);
  problems.finish(document.where.file);
  take_length_of_rig(job);
  if (job.calibration) apply_spread(job);
  return job;
}

}  // namespace

Job job_from(Node document, const std::vector<std::string>& sets) { return resolved_job(document, sets); }

Job read_job(const std::filesystem::path& file, const std::vector<std::string>& sets) {
  return job_from(read_document(file), sets);
}

Job read_job(const std::filesystem::path& file, const std::vector<std::string>& sets, Node& document) {
  document = read_document(file);
  return resolved_job(document, sets);
}

Setup setup_from(Node document) { return job_from(std::move(document)); }

std::string job_text(const Job& job) { return to_yaml(echo_fields(job)); }

std::string stored_job_text(const Job& job, const std::filesystem::path& folder) {
  const PathText seen = [&](const std::filesystem::path& file) { return as_seen_from(folder, file).string(); };
  return to_yaml(echo_fields(Describe([copy = job](Fields& f) mutable { describe(f, copy); }), seen));
}

std::string job_text(const std::filesystem::path& file, const std::vector<std::string>& sets) {
  return job_text(read_job(file, sets));
}

Dresspack read_dresspack(const std::filesystem::path& file) {
  std::string faults;
  Dresspack dresspack = read_dresspack(file, faults);
  if (faults.empty()) return dresspack;
  throw InputErrors({{{file.string()}, "", faults}});
}

Dresspack read_dresspack(const std::filesystem::path& file, std::string& faults) {
  Node job, whole = read_yaml(file);
  if (!whole.is_map())
    throw InputError({file.string()}, "holds no dresspack", "name a file of the keys of job.dresspack, or a job");
  if (const Node* const list = whole.find("dresspacks"); list && list->is_list()) {
    std::vector<std::string> names;
    for (const Node& item : list->items)
      if (const Node* const of = item.is_map() ? item.find("dresspack") : nullptr; of && of->is_scalar())
        names.push_back(of->text);
    throw InputError(list->where, fmt::format("is a job with {} dresspacks (one is drawn)", list->items.size()),
                     names.empty() ? "write one of them into a file of its own, and name that"
                                   : "name one of them: " + joined(names, ", "));
  }
  const bool is_job = whole.find("dresspack");
  if (is_job) apply_lines(whole);
  job["dresspack"] = is_job ? *whole.find("dresspack") : std::move(whole);
  job.where = {file.string()};
  resolve_job(job);
  Dresspack dresspack;
  read_fields(*job.find("dresspack"), dresspack);
  check_materials(dresspack.materials);
  Problems problems;
  problems.attempt("", dresspack.where, [&] { check_dresspack(dresspack, {Slip::free}); });
  problems.attempt("", dresspack.where, [&] { refuse_gross_overlap(dresspack); });
  try {
    problems.finish(file.string());
    take_from_construction(dresspack);
  } catch (const InputErrors& refused) {
    faults = refused.what();
  }
  return dresspack;
}

std::vector<KeyRow> job_keys() {
  const Describe both_forms = [](Fields& f) {
    Job job;
    describe_keys(f, job, {true, true});
  };
  std::vector<KeyRow> rows = key_rows("job", both_forms);
  for (const std::vector<KeyRow>& more :
       {key_rows<UrdfRequest>("robot from a URDF"), key_rows<DataSheet>("dresspack.components[].data_sheet")})
    rows.insert(rows.end(), more.begin(), more.end());
  return rows;
}

}  // namespace dresslife::pipeline
