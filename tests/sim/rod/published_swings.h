// Published swings of eight hanging charging cables: Tiburzio, Coleman, Feliu-Talegon, Della Santina, arXiv 2402.16114 and its
// public data, recomputed from the curvatures of its videos. Only half swings that begin at a mean curvature above 0.3 1/m:
// below it the scatter of the damping ratios is as large as the ratios.
#pragma once

#include <string>
#include <vector>

namespace dresslife::sim::test {

struct HalfSwing {
  double curvature;  ///< mean along the cable at the begin of the half swing [1/m]
  double ratio;      ///< damping ratio from the curvature at the end of the half swing
  double duration;   ///< [s]
};

struct PublishedSwing {
  std::string name;
  double length;           ///< [m]
  double tip_mass;         ///< [kg]
  double mass_per_length;  ///< [kg/m]
  double stiffness;        ///< E I from the cable's shapes at rest [N m2]
  double friction;         ///< half of the hysteresis of the moment at rest [N m]
  std::vector<HalfSwing> half_swings;
};

inline const std::vector<PublishedSwing> published_swings = {
    {"black unweighted",
     0.6,
     0.03,
     1,
     0.136,
     0.037,
     {{2.29, 0.205, 0.53}, {1.186, 0.126, 0.5}, {0.797, 0.131, 0.5}, {0.526, 0.167, 0.53}, {0.31, 0.266, 0.5}}},
    {"black weighted",
     0.6,
     0.23,
     1,
     0.118,
     0.037,
     {{1.992, 0.119, 0.67},
      {1.367, 0.075, 0.6},
      {1.08, 0.033, 0.67},
      {0.975, 0.075, 0.6},
      {0.77, 0.079, 0.67},
      {0.601, 0.08, 0.6},
      {0.467, 0.111, 0.6},
      {0.329, 0.098, 0.63}}},
    {"black short unweighted",
     0.4,
     0.03,
     1.05,
     0.144,
     0.039,
     {{2.718, 0.329, 0.37}, {0.909, 0.084, 0.33}, {0.699, 0.658, 0.27}}},
    {"black short weighted",
     0.4,
     0.23,
     1.05,
     0.101,
     0.047,
     {{2.546, 0.131, 0.5},
      {1.683, 0.139, 0.47},
      {1.082, 0.041, 0.47},
      {0.95, 0.227, 0.43},
      {0.457, 0.034, 0.53},
      {0.411, 0.572, 0.3}}},
    {"orange unweighted",
     0.75,
     0.03,
     0.533,
     0.084,
     0.035,
     {{1.307, 0.215, 0.57}, {0.654, 0.139, 0.6}, {0.421, 0.111, 0.6}}},
    {"orange weighted",
     0.75,
     0.23,
     0.533,
     0.057,
     0.025,
     {{1.062, 0.168, 0.77},
      {0.622, 0.04, 0.73},
      {0.548, 0.054, 0.77},
      {0.463, 0.047, 0.73},
      {0.399, 0.054, 0.77},
      {0.337, 0.035, 0.73},
      {0.302, 0.079, 0.73}}},
    {"orange short unweighted",
     0.45,
     0.03,
     0.556,
     0.121,
     0.029,
     {{2.834, 0.341, 0.37}, {0.907, 0.168, 0.4}, {0.531, 0.402, 0.23}}},
    {"orange short weighted",
     0.45,
     0.23,
     0.556,
     0.081,
     0.019,
     {{2.454, 0.152, 0.53},
      {1.516, 0.088, 0.53},
      {1.147, 0.107, 0.53},
      {0.818, 0.104, 0.53},
      {0.59, 0.099, 0.53},
      {0.432, 0.164, 0.5},
      {0.323, 0.34, 0.43}}},
};

}  // namespace dresslife::sim::test
