// A life that depends linearly on friction, slack and strength.
#pragma once

#include "pipeline/life/life_response.h"

namespace dresslife::pipeline {

/// Returns log10 life = median +- 0.1 (10 and 90 %, scatter) - a friction - b slack + c strength. Without an effect of slack it has no
/// nodes of slack, so that samples have no residual (first_failure.h).
inline LifeResponse straight_response(double a, double b, double c, double median = 5) {
  LifeResponse response;
  response.construction = "hose", response.material = "copper";
  response.knowledge = prior_of({});
  response.planned = {{median - 0.1, median, median + 0.1}};
  response.points.clear(), response.inside.clear(), response.worst_life.clear();
  response.strength = {-2, 0, 2};
  const std::vector<double> nodes{0.0, -1.5, 1.5};
  for (const double f : nodes)
    for (const double s : b == 0 ? std::vector{0.0} : nodes) {
      auto& point = response.points.emplace_back();
      point[index_of(Uncertain::friction_inside)] = f, point[index_of(Uncertain::slack)] = s;
      response.inside.push_back(Inside::as_is);
      for (const double of_strength : response.strength)
        response.worst_life.push_back(median + 0.3 - a * f - b * s + c * of_strength);
    }
  return response;
}

}  // namespace dresslife::pipeline
