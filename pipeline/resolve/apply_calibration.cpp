#include "pipeline/resolve/apply_calibration.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>

#include "pipeline/base/installation.h"
#include "pipeline/job/learned_settings.h"
#include "pipeline/job/wall_strength.h"
#include "pipeline/resolve/catalogue.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/resolve/sources.h"
#include "pipeline/settings/fields.h"
#include "pipeline/settings/units.h"

namespace dresslife::pipeline {

namespace {

/// Returns the value of the parameter's key in a job's tree; null: it is not there.
const Node* value_of(const Node& job, const UncertainParameter& parameter) {
  const std::size_t dot = parameter.key.find('.');
  const Node* section = job.find(parameter.key.substr(0, dot));
  return section && section->is_map() ? section->find(parameter.key.substr(dot + 1)) : nullptr;
}

/// Returns whether a job's tree contains a value of the parameter's key that differs from the neutral value, which resolved jobs
/// contain.
bool gives(const Node& job, const UncertainParameter& parameter) {
  const Node* value = value_of(job, parameter);
  return value && value->text != shortest_text(parameter.value(0));
}

/// Returns the names of parameters that the job itself sets, by their keys or their standard deviations.
std::set<std::string> stated_by(const Node& tree, const Job& job) {
  const std::array<double, uncertain_count> usual = Uncertainty::default_spread();
  std::set<std::string> names;
  for (std::size_t p = 0; p < uncertain_count; ++p) {
    const UncertainParameter& parameter = uncertain_parameters()[p];
    if (gives(tree, parameter) || job.uncertainty.spread[p] != usual[p]) names.emplace(parameter.name);
  }
  return names;
}

/// Reads the sections with keys of uncertain parameters again.
void read_keys(const Node& tree, Job& job) {
  if (const Node* simulation = tree.find("simulation")) read_fields(*simulation, job.simulation);
  if (const Node* strain = tree.find("strain")) read_fields(*strain, job.strain);
  if (const Node* fatigue = tree.find("fatigue")) read_fields(*fatigue, job.fatigue);
}

/// Replaces the medians that put_medians() wrote by the neutral values, and forgets the calibration.
void take_medians_back(Node& tree, Job& job) {
  for (const LearnedParameter& learned : job.calibration->parameters) {
    if (is_wall_strength(learned.name)) continue;
    const UncertainParameter& parameter = uncertain_parameters()[index_of(learned.name)];
    const Node* value = value_of(tree, parameter);
    if (!value || value->text != shortest_text(parameter.value(learned.median))) continue;
    set_value(tree, std::string(parameter.key), scalar(shortest_text(parameter.value(0))), value->where);
  }
  job.calibration.reset();
  read_keys(tree, job);
}

/// Writes the medians into the keys with default values.
void put_medians(Node& tree, Job& job) {
  job.calibration->applied = true;
  for (const LearnedParameter& learned : job.calibration->parameters) {
    if (is_wall_strength(learned.name)) continue;  // this parameter has no key
    const UncertainParameter& parameter = uncertain_parameters()[index_of(learned.name)];
    if (gives(tree, parameter)) continue;
    Node value = scalar(shortest_text(parameter.value(learned.median)));
    value.where = learned.where;
    set_value(tree, std::string(parameter.key), std::move(value), job.calibration->where);
  }
  read_keys(tree, job);
}

}  // namespace

void read_calibration(Node& job) {
  Node* written = job.find("calibration");
  if (!written) return;
  if (written->is_scalar()) {
    const Node asked = *written;
    *written = read_document((folder_of(asked.where) / asked.text).lexically_normal());
    if (!written->is_map())
      throw InputError(written->where, "holds no calibration", "name a file that dresslife calibrate wrote");
  }
  Calibration calibration;
  read_fields(*written, calibration);
  check_calibration(calibration);
}

void apply_calibration(Node& tree, Job& job) {
  if (!job.calibration) return;
  const bool applied = job.calibration->applied;
  // A resolved job contains the ratings; a key that is set later may leave them out. A calibration that the job names itself has
  // settings.
  const bool rates = job.uncertainty.enabled && job.uncertainty.ratings != KnownRatings::none;
  if (applied && job.calibration->typical && job.calibration->under.settings.empty() && !rates)
    return take_medians_back(tree, job);
  if (!applied || !job.calibration->under.settings.empty())
    check_learned_settings(job);  // older resolved jobs contain no settings
  if (applied) return;
  job.calibration->residual_spread = job.calibration->own_spread;
  leave_out_foreign_parameters(job);
  put_medians(tree, job);
}

void apply_spread(Job& job) {
  Calibration& calibration = *job.calibration;
  if (calibration.residual_spread == 1) return;  // as in each job without a calibration of its own
  if (!std::ranges::all_of(files_beside(job), [](const auto& file) { return std::filesystem::exists(file); })) return;
  if (calibration.under.motions.find(motion_digest(job)) == std::string::npos) calibration.residual_spread = 1;
}

namespace {

/// Returns "strain.slip: friction (this job has free)" of a problem of check_learned_settings().
std::string setting_in(const std::string& problem) {
  const std::size_t begin = problem.find(learned_with);
  return begin == std::string::npos
             ? problem
             : problem.substr(begin + learned_with.size(), problem.find("; ", begin) - begin - learned_with.size());
}

}  // namespace

void apply_ratings(Node& tree, Job& job) {
  if (job.calibration || !job.uncertainty.enabled || job.uncertainty.ratings == KnownRatings::none) return;
  const auto without = [&] {
    job.calibration.reset();
    job.uncertainty.ratings = KnownRatings::none;
  };
  const std::filesystem::path file = shipped_catalogue() / typical_ratings_file;
  if (!std::filesystem::exists(file)) return without();  // a catalogue of the user
  Node written = read_document(file);
  Calibration& calibration = job.calibration.emplace();
  read_fields(written, calibration);
  check_calibration(calibration);
  try {
    check_learned_settings(job);
  } catch (const InputErrors& other_settings) {  // a calibration with other settings is not valid for this job
    without();
    job.uncertainty.ratings_left_out = setting_in(other_settings.problems().front().line);
    return;
  }
  leave_out_foreign_parameters(job);
  leave_out(calibration, stated_by(tree, job));
  if (calibration.parameters.empty()) return without();
  calibration.under = {};  // it was checked; a job that names no calibration is not refused later
  calibration.within = {};
  calibration.observations.clear();
  put_medians(tree, job);
}

}  // namespace dresslife::pipeline
