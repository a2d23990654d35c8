#include "pipeline/job/fatigue.h"

#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {

void describe(Fields& f, Fatigue& fatigue) {
  f.choice("stress", fatigue.stress, "Ramberg-Osgood with Masing memory, or E times strain");
  f.choice("mean_stress", fatigue.mean_stress, "correction of the strain-life curve");
  f.choice("mean_stress_relaxation", fatigue.mean_stress_relaxation,
           "of a repeated history's mean stress: never; by the power law of the materials that have a "
           "relaxation_threshold_strain; or all of it before the first cycle");
  f.choice("counting", fatigue.counting, "rainflow of an endlessly repeated motion, or of one run");
  f.number("endurance_strain", fatigue.endurance_strain, Need::optional, between(0, 0.1),
           "amplitudes up to this do no damage");
  f.text("material", fatigue.material, Need::optional,
         "of every wire, instead of its own; the hose keeps hose_material");
  f.integer("listed_sites", fatigue.listed_sites, Need::optional, between(1, 10000),
            "worst sites whose cycles are written");
  f.number("operating_hours_per_week", fatigue.operating_hours_per_week, Need::optional, between(0.1, 168),
           "turns hours of motion into months");
  f.number("robot_life_hours", fatigue.robot_life_hours, Need::optional, between(1, 1e7),
           "a longer life is shown as longer than the robot's in tables; the hours themselves stay in ranking.csv and in the "
           "lines below the table. ESTIMATE: robots are overhauled or replaced after 20,000 to 40,000 h");
  f.number(
      "scatter_log10", fatigue.scatter_log10, Need::optional, between(0, 1),
      "standard deviation of log10 of a wire's life; ESTIMATE: lives of 20 equal wires spread over 0.75 of a "
      "decade");
  f.number(
      "scatter_shared", fatigue.scatter_shared, Need::optional, between(0, 1),
      "share of the variance of scatter_log10 that all wires of a dresspack, one spool or batch, have in "
      "common; ESTIMATE");
  f.number("failed_wires_percent", fatigue.failed_wires_percent, Need::optional, between(0, 100),
           "a conductor fails when so many of its wires are broken; 0: with the first");
  f.boolean("load_sharing", fatigue.load_sharing, Need::optional,
            "whether the rest of a conductor takes over the load of its broken wires");
  f.number("strength_factor", fatigue.strength_factor, Need::optional, between(0.01, 100),
           "of strains and stresses of the wires' strain-life curve, to try what is not known");
  f.number("slope_change", fatigue.slope_change, Need::optional, between(-0.1, 0.1),
           "added to b of the wires' strain-life curve, about 1e5 cycles; likewise");
  f.number("scatter_factor", fatigue.scatter_factor, Need::optional, between(0, 5),
           "of scatter_log10; likewise");
  f.number("model_factor", fatigue.model_factor, Need::optional, between(1e-4, 1e4),
           "of the wires' lives, for what no stage knows; likewise");
  f.number("motion_factor", fatigue.motion_factor, Need::optional, between(1e-4, 1e4),
           "of the wires' lives, for how the hose swings and where its cables come to rest; likewise");
}

}  // namespace dresslife::pipeline
