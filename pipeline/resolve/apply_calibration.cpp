#include "pipeline/resolve/apply_calibration.h"

#include "pipeline/job/learned_settings.h"
#include "pipeline/resolve/catalogue.h"
#include "pipeline/resolve/sources.h"
#include "pipeline/settings/fields.h"
#include "pipeline/settings/units.h"

namespace dresslife::pipeline {

namespace {

/// Whether a job's tree says another value than the one that changes nothing, which resolved jobs write out.
bool gives(const Node& job, const UncertainParameter& parameter) {
  const std::size_t dot = parameter.key.find('.');
  const Node* section = job.find(parameter.key.substr(0, dot));
  const Node* value = section && section->is_map() ? section->find(parameter.key.substr(dot + 1)) : nullptr;
  return value && value->text != shortest_text(parameter.value(0));
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
  if (!applied || !job.calibration->under.settings.empty())
    check_learned_settings(job);  // older resolved jobs have none
  if (applied) return;
  leave_out_foreign_parameters(job);
  job.calibration->applied = true;
  for (const LearnedParameter& learned : job.calibration->parameters) {
    const UncertainParameter& parameter = uncertain_parameters()[index_of(learned.name)];
    if (gives(tree, parameter)) continue;
    Node value = scalar(shortest_text(parameter.value(learned.median)));
    value.where = learned.where;
    set_value(tree, std::string(parameter.key), std::move(value), job.calibration->where);
  }
  if (const Node* strain = tree.find("strain")) read_fields(*strain, job.strain);
  if (const Node* fatigue = tree.find("fatigue")) read_fields(*fatigue, job.fatigue);
}

}  // namespace dresslife::pipeline
