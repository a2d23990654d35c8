#include "pipeline/study/study.h"

#include <algorithm>
#include <set>

#include "pipeline/job/catalogue.h"
#include "pipeline/job/fields.h"
#include "pipeline/job/job.h"
#include "pipeline/job/sources.h"

namespace dresslife::pipeline {
namespace {

constexpr std::size_t most_jobs = 100'000;

struct Change {
  std::string path;
  Node value;
  Where where;
};

/// One way to deviate from the base: a name and the keys it sets.
struct Variant {
  std::string name;
  std::vector<Change> changes;
};

bool fits_a_folder(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' || c == '.' || c == '+' ||
         c == '=';
}

std::string folder_name(std::string text) {
  for (char& c : text)
    if (!fits_a_folder(c)) c = '_';
  // Neither hidden nor a way out of the results, no option of a program and no formula of a spreadsheet.
  if (!text.empty() && std::string_view(".-+=").find(text[0]) != std::string_view::npos) text[0] = '_';
  return text;
}

/// "easy" for `motion: easy`, "segments=80" for a number, "routing=2" for the second of values that are no
/// words.
std::string value_name(const std::string& path, const Node& value, std::size_t index) {
  const std::string word = path.substr(path.rfind('.') == std::string::npos ? 0 : path.rfind('.') + 1);
  if (!value.is_scalar()) return fmt::format("{}={}", word, index + 1);
  const bool starts_with_letter =
      !value.text.empty() && std::isalpha(static_cast<unsigned char>(value.text[0]));
  const bool speaks = starts_with_letter && value.text != "true" && value.text != "false";
  const std::string text = speaks && value.text.find('/') != std::string::npos
                               ? std::filesystem::path(value.text).stem().string()
                               : value.text;
  return speaks ? text : fmt::format("{}={}", word, text);
}

std::vector<Variant> named_changes(const Node* jobs) {
  if (!jobs) return {Variant{}};
  if (!jobs->is_map() || jobs->entries.empty())
    throw InputError(jobs->where, "jobs must be a map of names to changed keys",
                     "write 'jobs: {NAME: {KEY.PATH: VALUE}}'");
  std::vector<Variant> variants;
  for (const Entry& job : jobs->entries) {
    Variant variant{job.key, {}};
    if (job.value.kind != Node::Kind::map && job.value.kind != Node::Kind::null)
      throw InputError(job.value.where, fmt::format("job '{}' must be a map of keys to values", job.key),
                       "write {KEY.PATH: VALUE}");
    for (const Entry& change : job.value.entries)
      variant.changes.push_back({change.key, change.value, change.where});
    variants.push_back(std::move(variant));
  }
  return variants;
}

std::vector<Variant> all_combinations(std::vector<Variant> variants, const Node* vary) {
  if (!vary) return variants;
  if (!vary->is_map())
    throw InputError(vary->where, "vary must be a map of keys to lists of values",
                     "write 'vary: {KEY.PATH: [A, B]}'");
  for (const Entry& key : vary->entries) {
    if (!key.value.is_list() || key.value.items.empty())
      throw InputError(key.value.where, fmt::format("vary.{} must be a list of values", key.key),
                       "write [A, B, ...]");
    if (variants.size() * key.value.items.size() > most_jobs)
      throw InputError(key.where, fmt::format("the study has more than {} jobs", most_jobs), "split it");
    std::vector<Variant> longer;
    for (const Variant& variant : variants)
      for (std::size_t i = 0; i < key.value.items.size(); ++i) {
        Variant next = variant;
        const std::string name = value_name(key.key, key.value.items[i], i);
        next.name += (next.name.empty() ? "" : "-") + name;
        next.changes.push_back({key.key, key.value.items[i], key.where});
        longer.push_back(std::move(next));
      }
    variants = std::move(longer);
  }
  return variants;
}

StudyJob make_job(const Node& base, const Variant& variant, const std::string& fallback_name,
                  const std::vector<std::string>& sets) {
  StudyJob made;
  made.name = folder_name(variant.name.empty() ? fallback_name : variant.name);
  try {
    Node document = base;
    for (const Change& change : variant.changes) set_value(document, change.path, change.value, change.where);
    made.job = std::make_shared<const Job>(job_from(std::move(document), sets));
  } catch (const InputError& problem) {
    made.failure = problem.what();
  }
  return made;
}

void check_keys(const Node& study) {
  if (!study.is_map()) throw InputError(study.where, "holds no study", "write base: and vary: or jobs:");
  const std::vector<std::string> known{"name", "base", "vary", "jobs"};
  for (const Entry& entry : study.entries) {
    if (std::find(known.begin(), known.end(), entry.key) != known.end()) continue;
    const std::string near = nearest_word(entry.key, known);
    throw InputError(
        entry.where, fmt::format("unknown key '{}' of a study", entry.key),
        near.empty() ? "keys here: name, base, vary, jobs" : fmt::format("did you mean '{}'?", near));
  }
  if (!study.find("base"))
    throw InputError(study.where, "base is missing",
                     "add 'base: ...': a job of config/jobs, a file, or the job itself");
}

void check_name(const std::string& job, const Where& where) {
  for (const char* own : {"build.ninja", "ranking.csv", "report.html"})
    if (job == own)
      throw InputError(where, fmt::format("a job is named '{}' (a file of the study itself)", own),
                       "give it another name");
}

/// A job by itself is a study of one.
bool is_job(const Node& document) {
  if (!document.is_map() || document.find("base")) return false;
  return document.find("motion") || document.find("robot") || document.find("routing");
}

/// The job from which the others deviate.
Node base_of(const Node& study) {
  const Node& written = *study.find("base");
  return written.is_scalar() ? catalogue_entry("jobs", written.text, written.where, study.where) : written;
}

std::string name_of(const Node& document, const std::filesystem::path& file) {
  const Node* name = document.find("name");
  return folder_name(name && name->is_scalar() && !name->text.empty() ? name->text : file.stem().string());
}

}  // namespace

std::string study_name(const std::filesystem::path& file) {
  const Node document = read_document(file);
  if (!is_job(document)) check_keys(document);
  return is_job(document) ? folder_name(file.stem().string()) : name_of(document, file);
}

Study read_study(const std::filesystem::path& file, const std::vector<std::string>& sets) {
  const Node document = read_document(file);
  Study study;
  if (is_job(document)) {
    study.name = folder_name(file.stem().string());
    check_name(study.name, document.where);
    study.jobs.push_back(make_job(document, Variant{}, study.name, sets));
    return study;
  }
  check_keys(document);
  study.name = name_of(document, file);

  const Node base = base_of(document);
  std::set<std::string> names;
  for (const Variant& variant :
       all_combinations(named_changes(document.find("jobs")), document.find("vary"))) {
    study.jobs.push_back(make_job(base, variant, study.name, sets));
    check_name(study.jobs.back().name, document.where);
    if (!names.insert(study.jobs.back().name).second)
      throw InputError(document.where, fmt::format("two jobs are named '{}'", study.jobs.back().name),
                       "give each combination another name");
  }
  return study;
}

std::string study_manual() {
  return "### study\n\n| key | allowed | default | meaning |\n|---|---|---|---|\n"
         "| `name` | text | name of the file | folder of the results under `runs/` |\n"
         "| `base` | a name of config/jobs, a file, or the job itself | required | the job from which all "
         "others deviate |\n"
         "| `vary` | map of key paths to lists of values | none | every combination of the values becomes a "
         "job |\n"
         "| `jobs` | map of names to maps of key paths and values | none | named deviations from the base; "
         "with `vary`, each of them is varied |\n";
}

}  // namespace dresslife::pipeline
