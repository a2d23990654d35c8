// Limits that a dresspack keeps with the job's own values and exceeds with other values of an uncertain parameter.
//
// A stage computes the limited quantity at a few values of the parameter (nodes). load = quantity / limit, or limit / quantity for
// a least value, so that above 1 the limit is exceeded. Between the nodes load is linear in z. Beyond the outermost ones it has
// the same slope. The lives of the fatigue stage are interpolated in the same way (pipeline/life/life_response.h).
#pragma once

#include <string>
#include <vector>

#include "pipeline/job/uncertainty.h"

namespace dresslife::pipeline {

struct LoadNode {
  double z = 0, load = 0;
};

/// Returns the share of dresspacks above the limit, if z is normal with this mean and deviation. nodes: with different z; at least
/// one.
double share_beyond(std::vector<LoadNode> nodes, double mean, double deviation);

/// Below this share there is no warning: a result for 1 of 10 dresspacks does not depend on fewer than 1 of 100.
inline constexpr double least_share_beyond = 0.01;
/// Returns "2.8 times the friction of the cables on their hose (strain.hose_friction_factor: 2.83)". own: the job's value of the key.
std::string value_words(const UncertainParameter& parameter, double z, double own);
/// Returns "19 %".
std::string percent_words(double share);

/// Returns a further remedy by knowledge: "; or ", the measurement, and the spread of the parameter after it; empty if the job knows
/// the parameter as well already.
std::string measurement_words(const UncertainParameter& parameter, const Uncertainty& known);

}  // namespace dresslife::pipeline
