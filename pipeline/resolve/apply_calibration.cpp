#include "pipeline/resolve/apply_calibration.h"

#include <algorithm>

#include "pipeline/job/calibration.h"
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

void apply_calibration(Node& job) {
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
  if (calibration.applied) return;
  (*written)["applied"] = scalar("true");
  const Where where = written->where;
  for (const LearnedParameter& learned : calibration.parameters) {
    const UncertainParameter& parameter = uncertain_parameters()[index_of(learned.name)];
    if (gives(job, parameter)) continue;
    Node value = scalar(shortest_text(parameter.value(learned.median)));
    value.where = learned.where;
    set_value(job, std::string(parameter.key), std::move(value), where);
  }
}

}  // namespace dresslife::pipeline
