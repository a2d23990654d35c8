#include "pipeline/resolve/job_text.h"

#include <algorithm>

#include "pipeline/base/digest.h"
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
    const bool of_rig = key == std::string_view("routing") && motion && motion->find("rig");
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
  check_forms(document, problems);
  resolve_job(document, problems);
  if (const Node* calibration = document.find("calibration"))
    problems.attempt("calibration", calibration->where, [&] { read_calibration(document); });
  Job job;
  if (document.find("dresspacks")) job.dresspacks.clear();
  read_fields(document, Describe([&](Fields& f) { describe(f, job); }), problems);
  const std::initializer_list<const char*> parts{"calibration", "strain",    "fatigue",
                                                 "uncertainty", "dresspack", "dresspacks"};
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

/// A job's text in two parts.
struct DividedText {
  std::string section;  ///< behind as many empty lines as the text has before it
  std::string beside;   ///< the other lines, without comments before the first key
};

/// Returns std::nullopt if the text does not look like one by stored_job_text().
std::optional<DividedText> divided(const std::string& text, const std::string& section) {
  const std::string key = '\n' + section + ":\n";
  const std::size_t before = text.find(key);
  if (before == std::string::npos) return std::nullopt;
  std::size_t end = before + key.size() - 1;
  while (end != std::string::npos && end + 1 < text.size() && text[end + 1] == ' ') end = text.find('\n', end + 1);
  if (end == std::string::npos || end + 1 >= text.size()) return std::nullopt;
  const std::size_t comment = text.starts_with('#') ? text.find('\n') : 0;
  return DividedText{std::string(static_cast<std::size_t>(std::count(
                                     text.begin(), text.begin() + static_cast<std::ptrdiff_t>(before) + 1, '\n')),
                                 '\n') +
                         text.substr(before + 1, end - before),
                     text.substr(comment, before + 1 - comment) + text.substr(end + 1)};
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

struct StoredJobs::Known {
  std::string beside;  ///< digest of DividedText::beside
  std::shared_ptr<const Job> job;
};

StoredJobs::StoredJobs() = default;
StoredJobs::~StoredJobs() = default;

std::shared_ptr<const Job> StoredJobs::read(const std::filesystem::path& file) {
  const std::optional<DividedText> text = divided(read_text(file), "motion");
  const std::string beside = text ? xxh3(text->beside) : "";
  const auto same = std::ranges::find_if(known_, [&](const auto& one) { return text && one->beside == beside; });
  if (same == known_.end()) {
    last_ = known_.size();
    return known_.emplace_back(std::make_unique<Known>(Known{beside, std::make_shared<const Job>(read_job(file))}))
        ->job;
  }
  note_input(file);
  last_ = static_cast<std::size_t>(same - known_.begin());
  Job job = *(*same)->job;
  job.motion = motion_from(*parse_yaml(text->section, file.string()).find("motion"));
  job.motion.left_out = joined(std::move(job.motion.left_out), plausibility_of_motion(job));
  take_length_of_rig(job);
  return std::make_shared<const Job>(std::move(job));
}

std::shared_ptr<const Job> StoredJobs::read_dresspacks(const std::filesystem::path& file) {
  std::string text = read_text(file);
  for (const char* section : {"motion", "routing"})
    if (std::optional<DividedText> parts = divided(text, section)) text = std::move(parts->beside);
  std::shared_ptr<const Job>& same = of_dresspacks_[xxh3(text)];
  if (!same) same = std::make_shared<const Job>(read_job(file));
  return same;
}

std::size_t StoredJobs::beside_motion() const { return last_ + 1; }

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
