#include "pipeline/job/fatigue.h"

#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {

void describe(Fields& f, Fatigue& fatigue) {
  f.choice("stress", fatigue.stress,
           "The relation of stress and strain: cyclic (Ramberg-Osgood with Masing memory) or elastic (E "
           "times strain).");
  f.choice("mean_stress", fatigue.mean_stress, "The correction of the strain-life curve for mean stress.");
  f.choice("mean_stress_relaxation", fatigue.mean_stress_relaxation,
           "The relaxation of the mean stress of a repeated history: none; by the power law of materials "
           "that have relaxation_threshold_strain; or complete before the first cycle.");
  f.choice("counting", fatigue.counting,
           "The rainflow count: of an endlessly repeated motion, or of one run with half cycles.");
  f.number("endurance_strain", fatigue.endurance_strain, Need::optional, between(0, 0.1),
           "The strain amplitude up to which a cycle does no damage.");
  f.text("material", fatigue.material, Need::optional,
         "The material of all wires instead of their own. The hose keeps hose_material.");
  f.integer("listed_sites", fatigue.listed_sites, Need::optional, between(1, 10000),
            "The number of worst places for which the cycles are written.");
  f.number("operating_hours_per_week", fatigue.operating_hours_per_week, Need::optional, between(0.1, 168),
           "The hours of motion per week. They convert hours into months.");
  f.number(
      "robot_life_hours", fatigue.robot_life_hours, Need::optional, between(1, 1e7),
      "The life of the robot. Tables print longer lives as longer than this, ranking.csv in hours. `improve` counts no "
      "longer life of the wires as a gain. ESTIMATE: robots are overhauled or replaced after 20,000 to 40,000 h.");
  f.number("scatter_log10", fatigue.scatter_log10, Need::optional, between(0, 1),
           "The standard deviation of log10 of a wire's life. ESTIMATE: lives of 20 equal wires cover 0.75 of a "
           "decade.");
  f.number("scatter_shared", fatigue.scatter_shared, Need::optional, between(0, 1),
           "The share of the variance of scatter_log10 that all wires of a dresspack have in common, as one "
           "spool or batch. ESTIMATE.");
  f.number("failed_wires_percent", fatigue.failed_wires_percent, Need::optional, between(0, 100),
           "The share of broken wires at which a conductor fails. 0: with the first wire.");
  f.boolean("load_sharing", fatigue.load_sharing, Need::optional,
            "Whether the other wires of a conductor take over the load of its broken wires.");
  f.number("strength_factor", fatigue.strength_factor, Need::optional, between(0.01, 100),
           "A factor on strains and stresses of the wires' strain-life curve, for trials.");
  f.number("slope_change", fatigue.slope_change, Need::optional, between(-0.1, 0.1),
           "A change of the exponent b of the wires' strain-life curve about 1e5 cycles, for trials.");
  f.number("scatter_factor", fatigue.scatter_factor, Need::optional, between(0, 5),
           "A factor on scatter_log10, for trials.");
  f.number("model_factor", fatigue.model_factor, Need::optional, between(1e-4, 1e4),
           "A factor on the wires' lives for effects that no stage models, for trials.");
  f.number("motion_factor", fatigue.motion_factor, Need::optional, between(1e-4, 1e4),
           "A factor on the wires' lives for the swing of the hose and the resting places of its cables, "
           "for trials.");
}

}  // namespace dresslife::pipeline
