#include "pipeline/job/simulation.h"

#include <cmath>

#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {

void describe(Fields& f, SimulationSettings& simulation) {
  f.integer("segments", simulation.segments, Need::optional, between(4, 2000),
            "The number of rigid segments of each dresspack.");
  f.number_or_word("time_step_ms", simulation.time_step, simulation.choose_time_step, "auto", Need::optional,
                   between(0.01, 20),
                   "The integration step. auto: the first repeat chooses the step by curvature_error_percent.");
  f.number("curvature_error_percent", simulation.curvature_error, Need::optional, above(0),
           "The largest estimated rms error of the curvature in the fastest seconds, for an automatic step.");
  f.number("sample_rate_Hz", simulation.sample_rate, Need::optional, between(0.1, 10000),
           "The sample rate of motion.h5. The time between samples is a whole number of steps.");
  f.number("stiffness_factor", simulation.stiffness_factor, Need::optional, between(0.01, 100),
           "A factor on the bending stiffness of each hose and on the moments of its friction.");
  f.vector("gravity_m_per_s2", simulation.gravity, Need::optional, "The gravity in the world.");
  f.boolean("contact", simulation.contact, Need::optional, "Whether the dresspack touches the robot's links.");
  f.boolean("self_contact", simulation.self_contact, Need::optional,
            "Whether dresspacks touch themselves and each other.");
  f.boolean("floor", simulation.floor, Need::optional, "Whether the plane z = 0 is a floor.");
  f.number("periodic_tolerance_mm", simulation.periodic_tolerance, Need::optional, above(0),
           "The largest difference of the dresspack at the beginning of two repeats. A periodic motion is "
           "repeated until it is met, and the last repeat counts.");
  f.integer("most_repeats", simulation.most_repeats, Need::optional, between(1, 1000),
            "The largest number of repeats of the motion.");
}

void check_simulation(const SimulationSettings& simulation, const Where& where) {
  if (simulation.choose_time_step) return;  // the chosen step fits the sample rate
  const double steps = 1 / (simulation.sample_rate * simulation.time_step);
  if (steps < 0.999 || std::abs(steps - std::round(steps)) > 1e-6 * steps)
    throw InputError(where,
                     fmt::format("simulation.sample_rate_Hz {} leaves {:.6g} steps of {} ms between samples",
                                 simulation.sample_rate, steps, 1e3 * simulation.time_step),
                     "choose both so that it is a whole number");
}

}  // namespace dresslife::pipeline
