#include "pipeline/study/study.h"

#include <algorithm>
#include <atomic>
#include <set>
#include <unordered_map>

#include "pipeline/base/joined.h"
#include "pipeline/base/order.h"
#include "pipeline/base/threads.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/catalogue.h"
#include "pipeline/resolve/document_kind.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/resolve/sources.h"
#include "pipeline/settings/fields.h"
#include "pipeline/study/fleet_table.h"
#include "pipeline/study/sampling.h"
#include "pipeline/study/shards.h"

namespace dresslife::pipeline {
namespace {

bool fits_a_folder(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' || c == '.' || c == '+' || c == '=';
}

std::string folder_name(std::string text) {
  for (char& c : text)
    if (!fits_a_folder(c)) c = '_';
  // Prevents hidden files, paths out of the results folder, options of programs and formulas of spreadsheets.
  if (!text.empty() && std::string_view(".-+=").find(text[0]) != std::string_view::npos) text[0] = '_';
  return text;
}

/// Returns the name of a value: "easy" for `motion: easy`, "segments=80" for a number, "routing=2" for the second of values
/// that are not words.
std::string value_name(const std::string& path, const Node& value, std::size_t index) {
  const std::string word = path.substr(path.rfind('.') == std::string::npos ? 0 : path.rfind('.') + 1);
  if (!value.is_scalar()) return fmt::format("{}={}", word, index + 1);
  const bool starts_with_letter = !value.text.empty() && std::isalpha(static_cast<unsigned char>(value.text[0]));
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
    Variant variant{job.key, {}, {job.key}};
    if (job.value.kind != Node::Kind::map && job.value.kind != Node::Kind::null)
      throw InputError(job.value.where, fmt::format("job '{}' must be a map of keys to values", job.key),
                       "write {KEY.PATH: VALUE}");
    for (const Entry& change : job.value.entries) variant.changes.push_back({change.key, change.value, change.where});
    variants.push_back(std::move(variant));
  }
  return variants;
}

/// Returns whether a value for `key` states the key at a path: it is the key, or lies in a part that the value writes out.
bool states(const std::string& key, const Node& value, const std::string& path) {
  return path == key || (path.starts_with(key + ".") && value_at(value, path.substr(key.size() + 1)));
}

[[noreturn]] void refuse_twice(const std::string& path, const Where& where, const Where& other) {
  throw InputError(
      where,
      fmt::format("{} is also set at {}: one would replace the other, and names of jobs would state values that the "
                  "jobs do not have",
                  path, other.text()),
      "keep one of the two");
}

/// Combines every variant with every one of `others`; the index of `others` varies fastest. where: section for error messages.
std::vector<Variant> combined(const std::vector<Variant>& variants, const std::vector<Variant>& others,
                              const Where& where) {
  if (variants.size() * others.size() > most_jobs)
    throw InputError(where, fmt::format("the study has more than {} jobs", most_jobs), "split it");
  std::vector<Variant> longer;
  longer.reserve(variants.size() * others.size());
  for (const Variant& variant : variants)
    for (const Variant& other : others) {
      for (const Change& own : variant.changes)
        for (const Change& change : other.changes)
          if (states(own.path, own.value, change.path)) refuse_twice(change.path, change.where, own.where);
      Variant& next = longer.emplace_back(variant);
      next.name += (next.name.empty() ? "" : "-") + other.name;
      next.changes.insert(next.changes.end(), other.changes.begin(), other.changes.end());
      next.values.push_back(other.name);
    }
  return longer;
}

std::vector<Variant> all_combinations(std::vector<Variant> variants, const Node* vary) {
  if (!vary) return variants;
  if (!vary->is_map())
    throw InputError(vary->where, "vary must be a map of keys to lists of values", "write 'vary: {KEY.PATH: [A, B]}'");
  for (const Entry& key : vary->entries) {
    if (!key.value.is_list() || key.value.items.empty())
      throw InputError(key.value.where, fmt::format("vary.{} must be a list of values", key.key), "write [A, B, ...]");
    std::vector<Variant> values;
    for (std::size_t i = 0; i < key.value.items.size(); ++i)
      values.push_back({value_name(key.key, key.value.items[i], i), {{key.key, key.value.items[i], key.where}}, {}});
    variants = combined(variants, values, key.where);
  }
  return variants;
}

/// Returns the keys of `vary` and `sample`, whose values make the names of jobs.
std::vector<Entry> varied_keys(const Node& study) {
  std::vector<Entry> keys;
  if (const Node* vary = study.find("vary")) keys = vary->entries;
  const Node* sample = study.find("sample");
  if (const Node* sampled = sample ? sample->find("keys") : nullptr)
    keys.insert(keys.end(), sampled->entries.begin(), sampled->entries.end());
  return keys;
}

/// Returns whether one of the values of a varied key states the key at a path.
bool varies(const Entry& key, const std::string& path) {
  const bool sampled = key.value.is_map() && !key.value.entries.empty();  // {!choice: [...]}
  const std::vector<Node>& values = sampled ? key.value.entries.front().value.items : key.value.items;
  return std::ranges::any_of(values, [&](const Node& value) { return states(key.key, value, path); });
}

/// Returns the variants by name: those of `jobs` and `table`.
std::vector<Variant> named_variants(const Node& study) {
  std::vector<Variant> variants = named_changes(study.find("jobs"));
  if (const Node* table = study.find("table")) {
    if (!table->is_scalar()) throw InputError(table->where, "table must be a file", "write 'table: FLEET.csv'");
    variants = combined(variants, table_variants(folder_of(table->where) / table->text), table->where);
  }
  return variants;
}

std::vector<Variant> variants_of(const Node& study) {
  std::vector<Variant> variants = named_variants(study);
  const std::vector<Entry> keys = varied_keys(study);
  for (const Entry& key : keys)
    for (const Entry& other : keys)
      if (&key != &other && varies(other, key.key)) refuse_twice(key.key, key.where, other.where);
  variants = all_combinations(std::move(variants), study.find("vary"));
  if (const Node* sample = study.find("sample"))
    variants = combined(variants, sampled_variants(*sample), sample->where);
  return variants;
}

/// Returns the names of the parts that variants_of() combines, in its order.
std::vector<std::string> varied_of(const Node& study) {
  std::vector<std::string> varied;
  for (const char* part : {"jobs", "table"})
    if (study.find(part)) varied.push_back(part);
  if (const Node* vary = study.find("vary"))
    for (const Entry& key : vary->entries) varied.push_back(key.key);
  if (study.find("sample")) varied.push_back("sample");
  return varied;
}

/// Longest name of a job's folder. File systems allow 255 letters, and files of a job have longer names than its folder.
constexpr std::size_t longest_name = 200;

/// A job with a piece, and the number of the piece.
struct KnownPiece {
  std::shared_ptr<const Job> job;
  std::size_t number = 0;
};
/// Known pieces by the changes that make them from the base: (Piece) changes as text.
using KnownPieces = std::array<std::unordered_map<std::string, KnownPiece>, piece_count>;
using PieceTextsOfChanges = std::array<std::string, piece_count>;

/// Returns the changes of each piece as text; std::nullopt: a change concerns several pieces.
std::optional<PieceTextsOfChanges> changes_of_pieces(const std::vector<Change>& changes) {
  PieceTextsOfChanges texts;
  for (const Change& change : changes) {
    const std::optional<Piece> piece = piece_of(change.path);
    if (!piece) return std::nullopt;
    // The places are in the text because parts of a job know theirs.
    texts[index_of(*piece)] += fmt::format("{}\n{}\n{}\n{}", change.path, change.where.text(),
                                           change.value.where.text(), to_yaml(change.value));
  }
  texts[index_of(Piece::routing)] += '\n' + texts[index_of(Piece::robot)];
  return texts;
}

bool is_of_routing(std::string_view path) { return piece_of(path) == Piece::routing; }

/// Returns the base with changes and sets.
Job changed_job(Node base, const std::vector<Change>& changes, const std::vector<std::string>& sets) {
  for (const Change& change : changes) set_value(base, change.path, change.value, change.where);
  return job_from(std::move(base), sets);
}

/// Returns the routing that the base, changes and sets give, in a tree; std::nullopt: it must be read with the whole job.
std::optional<Node> routing_of(const Node& base, const std::vector<Change>& changes,
                               const std::vector<std::string>& sets) {
  Node document;
  document.kind = Node::Kind::map;
  document.where = base.where;
  std::ranges::copy_if(base.entries, std::back_inserter(document.entries),
                       [](const Entry& entry) { return is_of_routing(entry.key); });
  try {
    apply_lines(document);
    for (const Change& change : changes)
      if (is_of_routing(change.path)) set_value(document, change.path, change.value, change.where);
    for (const std::string& set : sets)
      if (is_of_routing(set.substr(0, set.find('=')))) apply_set(document, set);
  } catch (const InputError&) {  // job_from() collects it with the other problems of the job
    return std::nullopt;
  }
  const Node* const routing = document.find("routing");
  return routing ? std::optional(*routing) : std::nullopt;
}

/// Returns the job of these changes from known pieces; null: it must be read as a whole.
SharedJob from_known(const KnownPieces& known, const PieceTextsOfChanges& texts, const Node& base,
                     const std::vector<Change>& changes, const std::vector<std::string>& sets) {
  SharedJob::Lenders lenders;
  PieceNumbers numbers{};
  for (std::size_t k = 0; k < piece_count; ++k)
    if (const auto found = known[k].find(texts[k]); found != known[k].end())
      lenders[k] = found->second.job, numbers[k] = found->second.number;
    else if (k != index_of(Piece::routing))
      return nullptr;
  if (lenders[index_of(Piece::routing)]) return pieces_fit(lenders) ? SharedJob(lenders, numbers) : nullptr;
  const std::optional<Node> routing = routing_of(base, changes, sets);
  if (!routing) return nullptr;
  std::array<const Job*, piece_count> pieces;
  std::ranges::transform(lenders, pieces.begin(), [](const auto& lender) { return lender.get(); });
  std::optional<Job> job = job_from_pieces(pieces, &*routing);
  return job ? std::make_shared<const Job>(*std::move(job)) : nullptr;
}

/// Returns a whole job with the numbers of its pieces, and notes those that are new.
SharedJob numbered(std::shared_ptr<const Job> job, PieceTextsOfChanges texts, KnownPieces& known) {
  static std::atomic<std::size_t> last = 0;
  if (!has_pieces(*job)) return job;
  PieceNumbers numbers;
  for (std::size_t k = 0; k < piece_count; ++k) {
    const auto [piece, is_new] = known[k].try_emplace(std::move(texts[k]));
    if (is_new) piece->second = {job, ++last};
    numbers[k] = piece->second.number;
  }
  return {std::move(job), numbers};
}

StudyJob make_job(const Node& base, const std::string& name, const Variant& variant,
                  const std::vector<std::string>& sets, KnownPieces& known) {
  StudyJob made;
  made.name = name;
  made.values = variant.values;
  try {
    if (made.name.size() > longest_name)
      throw InputError(
          base.where,
          fmt::format("a job's name has {} letters (at most {} fit a folder)", made.name.size(), longest_name),
          "name it under 'jobs', or shorten the values that make its name");
    // Sets a section before its keys: otherwise `vary: {motion: ..}` would overwrite a job's motion.ramp_percent.
    std::vector<Change> changes = variant.changes;
    std::ranges::stable_sort(changes, {}, [](const Change& change) { return std::ranges::count(change.path, '.'); });
    std::optional<PieceTextsOfChanges> texts = changes_of_pieces(changes);
    if (texts) made.job = from_known(known, *texts, base, changes, sets);
    if (!made.job) made.job = std::make_shared<const Job>(changed_job(base, changes, sets));
    if (texts && made.job.numbers() == PieceNumbers{}) made.job = numbered(made.job, *std::move(texts), known);
  } catch (const InputError& problem) {
    made.failure = problem.what();
  }
  return made;
}

void check_keys(const Node& study) {
  if (!study.is_map()) throw InputError(study.where, "holds no study", "write base: and vary: or jobs:");
  refuse_other_kind(study, DocumentKind::study);
  const std::vector<std::string> known{"name", "base", "vary", "jobs", "table", "sample", "keep", "free", "limits"};
  for (const Entry& entry : study.entries) {
    if (std::ranges::find(known, entry.key) != known.end()) continue;
    const std::string near = nearest_word(entry.key, known);
    throw InputError(entry.where, fmt::format("unknown key '{}' of a study", entry.key),
                     near.empty() ? "keys here: name, base, vary, jobs, table, sample, keep, free, limits"
                                  : fmt::format("did you mean '{}'?", near));
  }
  if (!study.find("base"))
    throw InputError(study.where, "base is missing",
                     "add 'base: ...': a job of config/jobs, a file, or the job itself");
}

void check_name(const std::string& job, const Where& where) {
  for (const char* own : {"build.ninja", "ranking.csv", "report.html", "submit.sh", "submit.log"})
    if (job == own)
      throw InputError(where, fmt::format("a job is named '{}' (a file of the study itself)", own),
                       "give it another name");
}

struct Disk {
  Keep keep = Keep::all;
};

void describe(Fields& f, Disk& disk) { f.choice("keep", disk.keep, ""); }

/// Returns the settings of a study itself.
Disk disk_of(const Node& study) {
  Disk disk;
  if (const Node* keep = study.find("keep")) {
    Node root;
    root["keep"] = *keep;
    root.where = study.where;
    read_fields(root, disk);
  }
  return disk;
}

/// Returns whether a document is a job, which is then a study of one job.
bool is_job(const Node& document) {
  if (!document.is_map() || document.find("base")) return false;
  return document.find("motion") || document.find("robot") || document.find("routing");
}

/// Returns the base job, from which the other jobs deviate.
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

namespace {

/// shard: null for all jobs.
Study read_jobs_of(const std::filesystem::path& file, const std::vector<std::string>& sets, const Shard* shard) {
  const Node document = read_document(file);
  Study study;
  if (is_job(document)) {
    KnownPieces known;
    study.name = folder_name(file.stem().string());
    check_name(study.name, document.where);
    if (!shard || !part_of({Variant{}}, *shard).empty())
      study.jobs.push_back(make_job(document, study.name, Variant{}, sets, known));
    return study;
  }
  check_keys(document);
  study.name = name_of(document, file);
  study.keep = disk_of(document).keep;
  study.varied = varied_of(document);

  const Node base = base_of(document);
  const std::vector<Variant> variants = variants_of(document);
  std::vector<std::string> names;
  std::set<std::string> seen;
  for (const Variant& variant : variants) {
    names.push_back(folder_name(variant.name.empty() ? study.name : variant.name));
    check_name(names.back(), document.where);
    if (!seen.insert(names.back()).second)
      throw InputError(document.where, fmt::format("two jobs are named '{}'", names.back()),
                       "give each combination another name");
  }
  const std::vector<std::size_t> indices = shard ? part_of(variants, *shard) : indices_of(variants.size());
  study.jobs.resize(indices.size());
  // Neighbours are in one part, because they often have the same dresspack, whose stiffness is computed once (complete.cpp).
  const std::size_t parts = std::min(thread_count(), indices.size());
  Sources* const sources = Sources::of_this_thread();
  in_parallel(parts, [&](std::size_t part) {
    const Sources::Guest guest(sources);
    KnownPieces known;
    for (std::size_t i = part * indices.size() / parts; i < (part + 1) * indices.size() / parts; ++i)
      study.jobs[i] = make_job(base, names[indices[i]], variants[indices[i]], sets, known);
  });
  return study;
}

}  // namespace

Study read_study(const std::filesystem::path& file, const std::vector<std::string>& sets) {
  return read_jobs_of(file, sets, nullptr);
}

Study read_study(const std::filesystem::path& file, const std::vector<std::string>& sets, const Shard& shard) {
  return read_jobs_of(file, sets, &shard);
}

std::string replaced_by_sets(const std::filesystem::path& file, const std::vector<std::string>& sets) {
  const Node study = sets.empty() ? Node{} : read_document(file);
  if (sets.empty() || is_job(study)) return "";
  std::string notes;
  const std::vector<Entry> varied = varied_keys(study);
  const std::vector<Variant> named = named_variants(study);
  for (const std::string& set : sets) {
    const std::string path = set.substr(0, set.find('='));
    const auto replaced = [&](const std::string& key) { return (key + ".").starts_with(path + "."); };
    for (const Entry& key : varied)
      if (replaced(key.key) || varies(key, path))
        throw InputError({"--set " + set},
                         fmt::format("replaces the values of {}, which the study varies: the names of its jobs would "
                                     "state values that the jobs do not have",
                                     key.key),
                         fmt::format("leave it out, or change the values at {}", key.where.text()));
      else if (path.starts_with(key.key + "."))
        notes += fmt::format("note: --set {} changes all values of {}, which the study varies\n", path, key.key);
    std::vector<std::string> jobs;
    for (const Variant& variant : named)
      if (std::ranges::any_of(variant.changes, [&](const Change& change) {
            return replaced(change.path) || states(change.path, change.value, path);
          }))
        jobs.push_back(variant.name);
    constexpr std::size_t most = 3;  // jobs that are named
    const std::size_t more = jobs.size() - std::min(jobs.size(), most);
    jobs.resize(jobs.size() - more);
    if (!jobs.empty())
      notes += fmt::format("note: --set {} replaces the own value of {}{}\n", path, joined(jobs, ", "),
                           more > 0 ? fmt::format(" and {} more jobs", more) : "");
  }
  return notes;
}

std::vector<KeyRow> study_keys() {
  std::vector<KeyRow> rows{
      {"study", "name", "", "text", "name of the file", "The folder of the results under `runs/`."},
      {"study", "base", "", "a name of config/jobs, a file, or the job itself", "required",
       "The job. All jobs of the study are variants of it."},
      {"study", "vary", "", "map of key paths to lists of values", "none",
       "The values of keys. Every combination of the values becomes a job."},
      {"study", "jobs", "", "map of names to maps of key paths and values", "none",
       "The changes of single named jobs. With `vary`, each of them is varied."},
      {"study", "table", "", "a CSV file", "none",
       "A table with one job per row. It has a column `name`. The title of every other column is a key path, or "
       "`program` for `motion`. An empty cell leaves the base unchanged."},
      {"study", "keep", "", "all | histories | lives", "all",
       "The files that stay after a job is done. histories: strain.h5 and life.h5. lives: only the rows of the ranking. "
       "A missing file alone does not start a job again."},
      {"study", "free", "", "map of key paths to ranges", "none",
       "The keys that `dresslife improve` may change, each with a range: `LOW .. HIGH`, `SPREAD around` the job's "
       "value, `ANGLE deg around` a direction, `LOW .. HIGH along LINK` for a position, or a list of values."},
      {"study", "limits", "",
       "contact_force_N, tension_N, abrasion_life_h, wall_life_h, rating_life_h, jacket_life_h, corkscrew_life_h, "
       "kink_margin, other_values_percent",
       "none",
       "Further limits of `dresslife improve`: largest forces, and least lives (p10) by modes that are not validated. "
       "kink_margin: the least ratio of a bend's radius to the radius at which a tube kinks. other_values_percent: the "
       "share of dresspacks that may exceed a limit at other values of stiffness, slack or friction; else, or if that is "
       "larger, as many as of the original job."},
      {"study", "sample", "", "map", "none",
       "The keys that are sampled at random for each of the other jobs: its `keys` are key paths with `!normal`, "
       "`!uniform` or `!choice`."}};
  const std::vector<KeyRow> sampling = sampling_keys();
  rows.insert(rows.end(), sampling.begin(), sampling.end());
  return rows;
}

}  // namespace dresslife::pipeline
