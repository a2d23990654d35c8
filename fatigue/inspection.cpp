#include "fatigue/inspection.h"

#include <cmath>
#include <limits>

namespace dresslife::fatigue {

Inspected inspected(const std::vector<double>& lives, double repeat, double visible_from,
                    const pipeline::Inspection& inspection, const pipeline::Fatigue& fatigue) {
  const double interval = inspection.interval_weeks * fatigue.operating_hours_per_week;
  double failed = 0, found = 0;
  for (const double life : lives) {
    const double age = std::pow(10, life) * repeat / 3600;
    if (!(age <= fatigue.robot_life_hours)) continue;
    failed += 1;
    found += pipeline::found_before((1 - visible_from) * age, interval, inspection.found_percent / 100);
  }
  const auto all = static_cast<double>(lives.size());
  return {failed / all, failed > 0 ? found / failed : std::numeric_limits<double>::quiet_NaN(), (failed - found) / all};
}

}  // namespace dresslife::fatigue
