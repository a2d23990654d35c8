#include "fatigue/inspection.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipeline/life/first_failure.h"

namespace dresslife::fatigue {

Inspected inspected(const std::vector<double>& lives, const std::vector<double>& wires, double repeat,
                    double visible_from, const pipeline::Inspection& inspection, const pipeline::Fatigue& fatigue) {
  const double interval = inspection.interval_weeks * fatigue.operating_hours_per_week;
  const double planned = std::log10(pipeline::percentiles_of(wires)[0]);
  double failed = 0, found = 0;
  for (std::size_t s = 0; s < lives.size(); ++s) {
    const double age = std::pow(10, lives[s]) * repeat / 3600;
    if (!(age <= fatigue.robot_life_hours && lives[s] < std::min(planned, wires[s]))) continue;
    failed += 1;
    found += pipeline::found_before((1 - visible_from) * age, interval, inspection.found_percent / 100);
  }
  const auto all = static_cast<double>(lives.size());
  return {failed / all, failed > 0 ? found / failed : std::numeric_limits<double>::quiet_NaN(), (failed - found) / all};
}

}  // namespace dresslife::fatigue
