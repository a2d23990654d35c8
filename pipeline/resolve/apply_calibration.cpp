#include "pipeline/resolve/apply_calibration.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>

#include "pipeline/base/csv_rows.h"
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
  return value && number_in(value->text) != parameter.value(0);
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

/// Returns whether the parameter's key still has the median that put_medians() wrote.
bool has_median(const Node& tree, const LearnedParameter& learned) {
  const UncertainParameter& parameter = uncertain_parameters()[index_of(learned.name)];
  const Node* value = value_of(tree, parameter);
  return value && number_in(value->text) == parameter.value(learned.median);
}

/// Replaces the medians that put_medians() wrote by the neutral values, for parameters that are no longer in the calibration.
void take_medians_back(Node& tree, Job& job, const std::vector<LearnedParameter>& before) {
  for (const LearnedParameter& learned : before) {
    if (is_wall_strength(learned.name) || !has_median(tree, learned)) continue;
    if (job.calibration && std::ranges::count(job.calibration->parameters, learned.name, &LearnedParameter::name) > 0)
      continue;
    const UncertainParameter& parameter = uncertain_parameters()[index_of(learned.name)];
    set_value(tree, std::string(parameter.key), scalar(shortest_text(parameter.value(0))),
              value_of(tree, parameter)->where);
  }
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

/// Removes the ratings from a job. setting: that excludes them; empty: none does.
void remove_ratings(Job& job, const std::string& setting = "") {
  job.calibration.reset();
  job.uncertainty.ratings = KnownRatings::none;
  job.uncertainty.ratings_left_out = setting;
}

/// Returns the names of the learned parameters that a resolved job states itself, since the ratings were applied.
std::set<std::string> stated_since(const Node& tree, const Job& job) {
  const std::array<double, uncertain_count> usual = Uncertainty::default_spread();
  std::set<std::string> names;
  for (const LearnedParameter& learned : job.calibration->parameters)
    if (const std::size_t p = index_of(learned.name);
        job.uncertainty.spread[p] != usual[p] || !has_median(tree, learned))
      names.insert(learned.name);
  return names;
}

/// Checks again what of an applied calibration is valid, because keys of a resolved job may have been changed since.
void update_calibration(Node& tree, Job& job) {
  Calibration& calibration = *job.calibration;
  const std::vector<LearnedParameter> before = calibration.parameters;
  // A job that names a calibration keeps its observations, and is refused with other settings.
  const bool by_default = calibration.typical && calibration.observations.empty();
  if (by_default && (!job.uncertainty.enabled || job.uncertainty.ratings == KnownRatings::none)) {
    job.calibration.reset();
  } else if (calibration.under.settings.empty()) {
    return;  // an older resolved job contains no settings
  } else if (!by_default) {
    check_learned_settings(job);
    const std::string earlier = calibration.within.left_out;
    leave_out_foreign_parameters(job);
    std::string& words = calibration.within.left_out;
    words = earlier + (earlier.empty() || words.empty() ? "" : "; ") + words;
  } else if (const std::vector<OtherSetting> others = other_settings(job); !others.empty()) {
    remove_ratings(job, others.front().what);
  } else {
    leave_out_foreign_parameters(job);
    leave_out(calibration, stated_since(tree, job));
    calibration.within = {};
    if (calibration.parameters.empty()) remove_ratings(job);
  }
  take_medians_back(tree, job, before);
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
  Calibration& calibration = *job.calibration;
  if (calibration.applied) return update_calibration(tree, job);
  check_learned_settings(job);
  calibration.residual_spread = calibration.own_spread;
  leave_out_foreign_parameters(job);
  put_medians(tree, job);
}

void apply_spread(Job& job) {
  Calibration& calibration = *job.calibration;
  if (calibration.residual_spread == 1) return;  // as in each job without a calibration of its own
  if (!std::ranges::all_of(files_beside(job), [](const auto& file) { return std::filesystem::exists(file); })) return;
  if (calibration.under.motions.find(motion_digest(job)) == std::string::npos) calibration.residual_spread = 1;
}

void apply_ratings(Node& tree, Job& job) {
  if (job.calibration || !job.uncertainty.enabled || job.uncertainty.ratings == KnownRatings::none) return;
  const std::filesystem::path file = shipped_catalogue() / typical_ratings_file;
  if (!std::filesystem::exists(file)) return remove_ratings(job);  // a catalogue of the user
  if (std::ranges::all_of(job.dresspacks,
                          [](const MountedDresspack& mounted) { return mounted.dresspack.components.empty(); }))
    return remove_ratings(job);  // no cable to which a rating applies
  Node written = read_document(file);
  Calibration& calibration = job.calibration.emplace();
  read_fields(written, calibration);
  check_calibration(calibration);
  if (const std::vector<OtherSetting> others = other_settings(job); !others.empty())
    return remove_ratings(job, others.front().what);
  leave_out_foreign_parameters(job);
  leave_out(calibration, stated_by(tree, job));
  if (calibration.parameters.empty()) return remove_ratings(job);
  calibration.within = {};
  calibration.observations.clear();
  put_medians(tree, job);
}

}  // namespace dresslife::pipeline
