#include "pipeline/job/simulation.h"

#include <cmath>

#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {

void describe(Fields& f, SimulationSettings& simulation) {
  f.integer("segments", simulation.segments, Need::optional, between(4, 2000),
            "rigid segments of each dresspack's chain");
  f.number_or_word(
      "time_step_ms", simulation.time_step, simulation.choose_time_step, "auto", Need::optional,
      between(0.01, 20),
      "integration step; auto: the first repeat chooses the one that keeps to curvature_error_percent");
  f.number(
      "curvature_error_percent", simulation.curvature_error, Need::optional, above(0),
      "largest estimated rms error of the curvature that a chosen step may leave in the liveliest seconds");
  f.number("sample_rate_Hz", simulation.sample_rate, Need::optional, between(0.1, 10000),
           "of motion.h5; a whole number of steps lies between samples");
  f.vector("gravity_m_per_s2", simulation.gravity, Need::optional, "acceleration of free fall in the world");
  f.boolean("contact", simulation.contact, Need::optional, "whether the dresspack touches the robot's links");
  f.boolean("self_contact", simulation.self_contact, Need::optional,
            "whether dresspacks touch themselves and each other");
  f.boolean("floor", simulation.floor, Need::optional, "whether the plane z = 0 is a floor");
  f.number("periodic_tolerance_mm", simulation.periodic_tolerance, Need::optional, above(0),
           "a motion that returns is repeated until the dresspack begins two repeats this much alike; the "
           "last one counts");
  f.integer("most_repeats", simulation.most_repeats, Need::optional, between(1, 1000),
            "of the motion, also when they do not begin alike");
}

void check_simulation(const SimulationSettings& simulation, const Where& where) {
  if (simulation.choose_time_step) return;  // the choice fits the rate
  const double steps = 1 / (simulation.sample_rate * simulation.time_step);
  if (steps < 0.999 || std::abs(steps - std::round(steps)) > 1e-6 * steps)
    throw InputError(where,
                     fmt::format("simulation.sample_rate_Hz {} leaves {:.6g} steps of {} ms between samples",
                                 simulation.sample_rate, steps, 1e3 * simulation.time_step),
                     "choose both so that it is a whole number");
}

}  // namespace dresslife::pipeline
