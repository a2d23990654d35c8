#include "pipeline/life/visual_checks.h"

#include <cmath>

namespace dresslife::pipeline {

double found_before(double visible, double interval, double found) {
  const double checks = visible / interval, whole = std::floor(checks);
  return 1 - std::pow(1 - found, whole) * (1 - found * (checks - whole));
}

}  // namespace dresslife::pipeline
