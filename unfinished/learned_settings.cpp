#include "pipeline/job/learned_settings.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "pipeline/settings/fields.h"
#include "pipeline/settings/problems.h"

namespace dresslife::pipeline {
namespace {

constexpr std::string_view any = "any", between_values = " or ";

std::vector<std::string> split(std::string_view text, std::string_view separator) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(separator, at), text.size());
    parts.emplace_back(text.substr(at, end - at));
    at = end + separator.size();
  }
  return parts;
}

std::string slip_of(const Job& job) {
  std::vector<std::string> levels;
  for (const Slip slip : job.strain.slip) levels.emplace_back(word(slip));
  const auto& packs = job.dresspacks;
  if (std::all_of(packs.begin(), packs.end(), [](const auto& mounted) { return mounted.dresspack.cable_alone; })) {
    if (levels.size() == 1) levels.push_back(levels.front());
    levels.front() = any;
  }
  return fmt::format("{}", fmt::join(levels, ", "));
}

/// Of slips one word stands for all levels, the last of a list for deeper ones.
bool agree(const std::string& key, const std::string& learned, const std::string& of_job) {
  if (key != "strain.slip") return learned == of_job;
  const std::vector<std::string> one = split(learned, ", "), other = split(of_job, ", ");
  for (std::size_t level = 0; level < std::max(one.size(), other.size()); ++level) {
    const std::string &a = one[std::min(level, one.size() - 1)], &b = other[std::min(level, other.size() - 1)];
    if (a != b && a != any && b != any) return false;
  }
  return true;
}

}  // namespace

std::vector<LearnedSetting> settings_of(const Job& job) {
  const Node strain = echo_fields(job.strain), fatigue = echo_fields(job.fatigue);
  std::vector<LearnedSetting> settings{{"strain.slip", slip_of(job)}};
  const auto add = [&](const Node& section, const std::string& name, const char* key) {
    if (const Node* value = section.find(key)) settings.push_back({name + "." + key, value->text});
  };
  for (const char* key : {"deformation", "kinematics", "equivalent", "surface_fibres"}) add(strain, "strain", key);
  for (const char* key : {"stress", "mean_stress", "mean_stress_relaxation", "counting", "endurance_strain", "material",
                          "scatter_log10", "scatter_shared", "load_sharing"})
    add(fatigue, "fatigue", key);
  return settings;
}

std::vector<LearnedSetting> settings_of(const std::vector<const Job*>& jobs) {
  std::vector<LearnedSetting> all;
  for (const Job* job : jobs)
    for (const LearnedSetting& setting : settings_of(*job)) {
      const auto known =
          std::find_if(all.begin(), all.end(), [&](const LearnedSetting& one) { return one.key == setting.key; });
      if (known == all.end()) {
        all.push_back(setting);
        continue;
      }
      const std::vector<std::string> values = split(known->value, between_values);
      if (std::find(values.begin(), values.end(), setting.value) == values.end())
        known->value += std::string(between_values) + setting.value;
    }
  return all;
}

void check_learned_settings(const Job& job) {
  if (!job.calibration) return;
  const Calibration& calibration = *job.calibration;
  if (calibration.settings.empty())
    throw InputError(calibration.where, "does not say under which settings it was learned (strain.slip and others)",
                     "run dresslife calibrate again with the same observations");
  Problems problems;
  for (const LearnedSetting& own : settings_of(job)) {
    const auto learned = std::find_if(calibration.settings.begin(), calibration.settings.end(),
                                      [&](const LearnedSetting& one) { return one.key == own.key; });
    if (learned == calibration.settings.end()) continue;  // a key that is younger than the calibration
    const std::vector<std::string> values = split(learned->value, between_values);
    if (std::any_of(values.begin(), values.end(),
                    [&](const std::string& value) { return agree(own.key, value, own.value); }))
      continue;
    problems.add(calibration.where,
                 fmt::format("was learned with {}: {} (this job has {})", own.key, learned->value, own.value),
                 fmt::format("set {} as the calibration has it, or calibrate again with --set {}={}", own.key, own.key,
                             own.value));
  }
  problems.finish();
}

}  // namespace dresslife::pipeline
