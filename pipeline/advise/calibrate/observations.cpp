#include "pipeline/advise/calibrate/observations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "pipeline/advise/calibrate/doubtful_rows.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/readable.h"
#include "pipeline/job/job.h"
#include "pipeline/job/learned_settings.h"
#include "pipeline/resolve/catalogue.h"
#include "pipeline/resolve/document_kind.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {
namespace {

constexpr double most_hours = 1e6;  // one century, day and night

}  // namespace

void describe(Fields& f, Observation& observation) {
  f.text("name", observation.name, Need::required, "A short name of letters, digits and _.");
  f.text("what", observation.what, Need::required, "What was done to what, in words.");
  f.text("source", observation.source, Need::required, "The source of the observation.");
  f.text("note", observation.note, Need::optional, "What is not known, and how it is varied.");
  f.maybe_number("cycles", observation.cycles, above(0), "The life in cycles.");
  f.maybe_number("hours", observation.hours, Range{0, most_hours, true},
                 "The life in hours of motion, instead of cycles.");
  f.maybe_number(
      "stiffness_Nm2", observation.stiffness, above(0),
      "The moment over curvature of the cable, bent from straight to at_curvature_1_per_m. It replaces a life.");
  f.number(
      "at_curvature_1_per_m", observation.at_curvature, Need::optional, between(1e-3, 100),
      "The curvature of stiffness_Nm2. Of decrement: the curvature beside the clamp at the end of a swing, 3.5 x deflection / "
      "length^2.");
  f.maybe_number(
      "decrement", observation.decrement, between(1e-3, 5),
      "The logarithm of the ratio of two successive swings to one side, of a piece that stands out from a clamp. It "
      "replaces a life.");
  f.number("decrement_without_slip", observation.decrement_without_slip, Need::optional, between(0, 5),
           "The part of decrement by the jacket's polymer and the air, as the smallest swings show it.");
  f.path(
      "bending", observation.bending, Need::optional,
      "A CSV of a bending test with the columns curvature_1_per_m and moment_Nm, from straight, in the order of the test. It "
      "replaces a life.");
  f.number(
      "noise_percent", observation.noise_percent, Need::optional, between(0.1, 100),
      "The standard deviation of a measured moment, stiffness or decrement. Of a curve: that of each moment, in percent of the "
      "largest one. A curve counts as at most ten independent moments.");
  f.number(
      "cycles_per_repeat", observation.cycles_per_repeat, Need::optional, above(0),
      "The number of cycles that the observer counts in one repeat of the job's motion: 2 if single strokes are counted.");
  f.choice(
      "outcome", observation.outcome,
      "The end: broken (it failed then), broken_by (no specimen lived longer), run_out (it had not failed then) or rating (its "
      "maker promises this life).");
  f.choice(
      "criterion", observation.criterion,
      "The criterion of failure: first_wire, or conductor (a share of its wires at one place, fatigue.failed_wires_percent).");
  f.integer("specimens", observation.specimens, Need::optional, between(1, 1e6),
            "The number of specimens. Of several broken ones, cycles or hours are the geometric mean.");
  f.number(
      "unshared_log10", observation.unshared_log10, Need::optional, between(0, 3),
      "The standard deviation of log10 of the life that only this test has. It is smaller for the user's own cable in the user's "
      "own test.");
}

namespace {

constexpr double endless = std::numeric_limits<double>::infinity();
constexpr std::size_t most_variants = 1000;

bool fits_a_folder(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(),
                                      [](unsigned char letter) { return std::isalnum(letter) || letter == '_'; });
}

struct Variant {
  std::string name;
  std::vector<std::pair<const Entry*, const Node*>> changes;
};

std::vector<Variant> combinations(const Node* vary, const std::string& name) {
  std::vector<Variant> variants{{name, {}}};
  if (!vary) return variants;
  if (!vary->is_map())
    throw InputError(vary->where, "vary must be a map of keys to lists of values", "write {KEY.PATH: [A, B]}");
  for (const Entry& key : vary->entries) {
    if (!key.value.is_list() || key.value.items.empty())
      throw InputError(key.where, fmt::format("vary.{} must be a list of values", key.key), "write [A, B, ...]");
    std::vector<Variant> longer;
    for (const Variant& variant : variants)
      for (std::size_t i = 0; i < key.value.items.size(); ++i) {
        longer.push_back(variant);
        longer.back().name += fmt::format("-{}", i + 1);
        longer.back().changes.emplace_back(&key, &key.value.items[i]);
      }
    variants = std::move(longer);
    if (variants.size() > most_variants)
      throw InputError(key.where, fmt::format("an observation has more than {} variants", most_variants),
                       "give fewer values");
  }
  return variants;
}

/// Throws InputError at a key that has no effect on the observed quantity.
void refuse_idle_keys(const Node& row, const Observation& observation) {
  const std::set<std::string> always{"name", "what", "source", "note", "job", "vary"};
  const std::string kind = observation.cycles      ? "cycles"
                           : observation.hours     ? "hours"
                           : observation.stiffness ? "stiffness_Nm2"
                           : observation.decrement ? "decrement"
                                                   : "bending";
  std::set<std::string> used{kind};
  if (observation.is_life()) {
    used.insert({"outcome", "criterion", "unshared_log10"});
    if (observation.outcome != ObservedEnd::rating) used.insert("specimens");
    if (observation.cycles) used.insert("cycles_per_repeat");
  } else {
    used.insert("noise_percent");
    if (observation.bending.empty()) used.insert("at_curvature_1_per_m");
    if (observation.decrement) used.insert("decrement_without_slip");
  }
  for (const Entry& entry : row.entries)
    if (!always.contains(entry.key) && !used.contains(entry.key))
      throw InputError(
          entry.where,
          fmt::format("'{}': {} has no effect on {}", observation.name, entry.key,
                      entry.key == "specimens" ? "a rating, which is a promise of one specimen" : "a row with " + kind),
          "leave it out");
}

/// Returns "line_1_b" for "line 1-b".
std::string name_that_fits(std::string name) {
  for (char& letter : name)
    if (!std::isalnum(static_cast<unsigned char>(letter))) letter = '_';
  return name;
}

Observation read_one(const Node& item) {
  if (!item.is_map()) throw InputError(item.where, "an observation must be a map", "write name, job, cycles, source");
  Node plain = item;
  std::erase_if(plain.entries, [](const Entry& e) { return e.key == "job" || e.key == "vary"; });
  Observation observation;
  read_fields(plain, observation);
  if (!fits_a_folder(observation.name))
    throw InputError(item.where, fmt::format("name '{}' is not made of letters, digits and _", observation.name),
                     fmt::format("write name: {}", name_that_fits(observation.name)));
  const int observed = observation.cycles.has_value() + observation.hours.has_value() +
                       observation.stiffness.has_value() + observation.decrement.has_value() +
                       !observation.bending.empty();
  if (observed != 1)
    throw InputError(
        item.where,
        fmt::format("'{}' must have either cycles or hours (or stiffness_Nm2, decrement or bending)", observation.name),
        "give one of them");
  if (observation.decrement && observation.decrement_without_slip >= *observation.decrement)
    throw InputError(item.where, fmt::format("'{}': nothing of decrement is left for slip", observation.name),
                     "give a decrement_without_slip below decrement");
  refuse_idle_keys(item, observation);
  if (!item.find("job"))
    throw InputError(item.where, fmt::format("'{}' has no job (what was done to it)", observation.name),
                     "give a job, or the file of one");
  return observation;
}

/// Adds the motion that is computed fastest: the bending table does not depend on the motion.
void add_still_motion(Node& job) {
  Node rig;
  rig["kind"] = scalar("axial");
  rig["elongation_percent"] = scalar("0.01");
  job["motion"]["rig"] = std::move(rig);
  place_at(*job.find("motion"), job.where);
}

}  // namespace

std::vector<ObservedTest> read_observed_tests(const std::filesystem::path& file) {
  const Node document = read_yaml(file);
  const Node* list = document.is_map() ? document.find("observations") : nullptr;
  if (!list) refuse_other_kind(document, DocumentKind::observations);
  if (!list || !list->is_list() || list->items.empty())
    throw InputError(document.where, "holds no observations",
                     "write 'observations:' and a list of rows with name, what, source, job, and cycles or hours");
  for (const Entry& entry : document.entries)
    if (entry.key != "observations" && entry.key != "cables")
      throw InputError(entry.where, fmt::format("unknown key '{}' beside observations", entry.key), "leave it out");
  const Node* const cables = document.find("cables");
  const std::string of = cables && cables->is_scalar() ? cables->text : cables ? "" : "own";
  if (of != "own" && of != "typical")
    throw InputError(cables->where, "cables must be own or typical",
                     "write own for cables of yours, typical for those of different makers");
  std::vector<ObservedTest> tests;
  std::set<std::string> names;
  for (const Node& item : list->items) {
    ObservedTest test{read_one(item), {}, of == "typical", to_yaml(item), item.where};
    const std::string& name = test.observation.name;
    if (!names.insert(name).second)
      throw InputError(item.where, fmt::format("two observations are named '{}'", name), "give each another name");
    const Node& written = *item.find("job");
    Node base = written.is_scalar() ? catalogue_entry("jobs", written.text, written.where, document.where) : written;
    if (!test.observation.is_life() && base.is_map() && !base.find("motion")) add_still_motion(base);
    for (const Variant& variant : combinations(item.find("vary"), name)) {
      test.variants.push_back({variant.name, base, ""});
      try {
        for (const auto& [key, value] : variant.changes)
          set_value(test.variants.back().job, key->key, *value, key->where);
      } catch (const InputError& problem) {
        test.variants.back().failure = problem.what();
      }
    }
    tests.push_back(std::move(test));
  }
  return tests;
}

ValidationStudy read_observations(const std::filesystem::path& file, const std::vector<std::string>& sets) {
  ValidationStudy made;
  made.study.name = "validate_" + file.stem().string();
  std::vector<std::string> all_sets{
      "uncertainty.enabled=false"};  // the model's own life, with the scatter of wires only
  all_sets.insert(all_sets.end(), sets.begin(), sets.end());
  std::vector<ObservedTest> tests = read_observed_tests(file);
  made.doubts = doubtful_rows(tests);
  for (ObservedTest& test : tests) {
    Observation& observation = test.observation;
    if (!observation.is_life()) continue;
    for (ObservedTest::Variant& variant : test.variants) {
      StudyJob job{variant.name, nullptr, variant.failure};
      try {
        if (job.failure.empty()) job.job = std::make_shared<const Job>(job_from(std::move(variant.job), all_sets));
      } catch (const InputError& problem) {
        job.failure = problem.what();
      }
      observation.jobs.push_back(made.study.jobs.size());
      made.study.jobs.push_back(std::move(job));
    }
    made.observations.push_back(std::move(observation));
  }
  if (made.observations.empty())
    throw InputError({file.string()}, "holds no observed lives", "give observations of cycles or hours");
  return made;
}

std::array<double, 3> lives_of(const Observation& observation, const RankingRow& row) {
  const auto& hours = observation.criterion == FailureCriterion::first_wire ? row.first_wire_hours
                      : row.planned()                                       ? row.by_scatter()
                                                                            : row.conductor_hours;
  const double unit =
      observation.hours || !observation.service.empty() ? 1 : 3600 / row.repeat_seconds * observation.cycles_per_repeat;
  std::array<double, 3> lives;
  // NaN: without damage there is no scatter.
  for (std::size_t i = 0; i < lives.size(); ++i) lives[i] = std::isnan(hours[i]) ? endless : hours[i] * unit;
  return lives;
}

Prediction predicted(const Observation& observation, const Study& study, const std::vector<RankingRow>& rows) {
  Prediction prediction;
  prediction.low = prediction.stuck = endless;
  std::vector<double> medians;
  for (const std::size_t index : observation.jobs) {
    const RankingRow* const row = find_in(rows, &RankingRow::job, study.jobs[index].name);
    ++prediction.variants;
    if (!row || !row->done() || !row->has_wires()) {
      if (prediction.failure.empty())
        prediction.failure = !row ? "not computed" : row->done() ? "its dresspack has no wires" : row->failure;
      ++prediction.failed;
      continue;
    }
    const std::array<double, 3> lives = lives_of(observation, *row);
    const double bound = observation.hours ? row->repeat_seconds / 3600 : observation.cycles_per_repeat;
    prediction.low = std::min(prediction.low, lives[0]);
    prediction.high = std::max(prediction.high, lives[2]);
    medians.push_back(lives[1]);
    // The bounds belong to the same quantity as the medians: a conductor, if the row has one.
    const bool of_wire = observation.criterion == FailureCriterion::first_wire || std::isnan(row->glued_hours[1]);
    const double from_hours = 3600 / row->repeat_seconds;
    prediction.stuck =
        std::min(prediction.stuck, (of_wire ? row->life_repeats_all_stick : row->glued_hours[1] * from_hours) * bound);
    prediction.free =
        std::max(prediction.free, (of_wire ? row->life_repeats_all_free : row->free_hours[1] * from_hours) * bound);
  }
  std::sort(medians.begin(), medians.end());
  if (medians.empty()) return prediction;
  prediction.shortest = medians.front();
  prediction.median = medians[medians.size() / 2];
  prediction.longest = medians.back();
  return prediction;
}

Judgement judged(const Observation& observation, const Prediction& prediction) {
  const double life = observed_life(observation);
  const bool above = bounds_above(observation.outcome), below = bounds_below(observation.outcome);
  if (below && prediction.high < life) return {Agreement::too_short, life / prediction.high};
  if (above && prediction.low > life) return {Agreement::too_long, prediction.low / life};
  if (below && above) return {Agreement::agrees, 1};
  const bool all = below ? prediction.shortest >= life : prediction.longest <= life;
  return {all ? Agreement::agrees : Agreement::open, 1};
}

std::string words_of(const Judgement& judgement) {
  const auto by = [&](const char* what) {
    return std::isinf(judgement.factor) ? fmt::format("MISS: {}, no failure predicted", what)
                                        : fmt::format("MISS: {} by {}", what, readable(judgement.factor, 2));
  };
  switch (judgement.agreement) {
    case Agreement::agrees:
      return "agrees";
    case Agreement::open:
      return "open";
    case Agreement::too_short:
      return by("too short");
    case Agreement::too_long:
      return by("too long");
  }
  return {};
}

namespace {

std::string short_life(double life) { return life_text(life, 2); }

}  // namespace

std::string observed_text(const Observation& observation) {
  if (observation.stiffness)
    return fmt::format("{} N m2 at {} 1/m", readable(*observation.stiffness, 3), readable(observation.at_curvature, 2));
  if (observation.decrement)
    return fmt::format("decrement {} at {} 1/m", readable(*observation.decrement, 2),
                       readable(observation.at_curvature, 2));
  if (!observation.bending.empty()) return observation.bending.filename().string();
  if (!observation.service.empty())
    return service_text(static_cast<std::size_t>(std::count_if(observation.service.begin(), observation.service.end(),
                                                               [](const ServiceRecord& one) { return one.failed; })),
                        observation.service.size());
  const char* sign = observation.outcome == ObservedEnd::broken      ? ""
                     : observation.outcome == ObservedEnd::broken_by ? "at most "
                                                                     : "at least ";
  const double life = observed_life(observation);
  return fmt::format("{}{}{}", sign, readable(life, 3), observation.hours ? " h" : "");
}

std::string validation_table(const ValidationStudy& validation, const std::vector<RankingRow>& rows) {
  std::string text =
      "| observation | what | observed | predicted, medians of the variants | 10 .. 90 % over all | inside glued .. free | |\n"
      "|---|---|---|---|---|---|---|\n";
  for (const Observation& observation : validation.observations) {
    const Prediction prediction = predicted(observation, validation.study, rows);
    if (prediction.failed > 0) {
      text += fmt::format("| {} | {} | {} | {} of {} variants failed: {} | | | |\n", observation.name, observation.what,
                          observed_text(observation), prediction.failed, prediction.variants, prediction.failure);
      continue;
    }
    const std::string medians = prediction.variants == 1
                                    ? short_life(prediction.median)
                                    : fmt::format("{} .. {} ({})", short_life(prediction.shortest),
                                                  short_life(prediction.longest), prediction.variants);
    text += fmt::format("| {} | {} | {}, {} | {} | {} .. {} | {} .. {} | {} |\n", observation.name, observation.what,
                        observed_text(observation), word(observation.outcome), medians, short_life(prediction.low),
                        short_life(prediction.high), short_life(prediction.stuck), short_life(prediction.free),
                        words_of(judged(observation, prediction)));
  }
  return text;
}

}  // namespace dresslife::pipeline
