#include "sim/run/memory.h"

#include <fmt/format.h>

#include "pipeline/files/files.h"
#include "sim/run/simulate.h"

namespace dresslife::sim {

pipeline::MemoryNeed memory_of(const Simulation& simulation, const pipeline::Uncertainty& uncertainty) {
  constexpr double program =
      24 << 20;  // bytes of the program, its libraries, the catalogue, robot and world of a small job
  constexpr double of_a_segment =
      50'000;  // bytes: bodies, shapes and contacts, blocks of the equations, and the same with half the step; the rubbed surface
  const RunDescription& run = simulation.description();
  const pipeline::SimulationSettings& settings = simulation.setup().simulation;
  const double steps = simulation.path().duration() / settings.time_step;
  const std::size_t segments = run.segment_length.size();
  pipeline::MemoryNeed need;
  need.add(program, "the program");
  need.add(of_a_segment * static_cast<double>(segments), fmt::format("{} segments", segments),
           "fewer simulation.segments");
  // Acceleration of each step; curvature of every link in the compared half of the windows.
  constexpr double compared = 0.5 / 30, value = sizeof(double);
  need.add(2 * steps * value + steps * compared * run.links * value, fmt::format("the error of {:.0f} steps", steps),
           "a longer simulation.time_step_ms, or a shorter motion");
  constexpr double
      of_a_frame = 7 * value,
      grown = 1.5;  // position and orientation; a list that grows by doubling has on average 1.5 times its size
  if (other_stiffness(uncertainty) != 0)
    need.add(grown * of_a_frame * run.samples * static_cast<double>(segments + run.clamp_segment.size()),
             "a motion with another stiffness of the hose",
             "uncertainty.hose_stiffness: 1, or a lower simulation.sample_rate_Hz");
  need.add(pipeline::file_buffers(pipeline::motion_format(), {{"sample", static_cast<std::size_t>(run.samples)},
                                                              {"segment", segments},
                                                              {"clamp", run.clamp_segment.size()},
                                                              {"joint", static_cast<std::size_t>(run.joints)},
                                                              {"link", run.link_names.size()},
                                                              {"hose_link", static_cast<std::size_t>(run.links)},
                                                              {"line", run.step_texts.size()}}),
           "what is being written");
  return need;
}

}  // namespace dresslife::sim
