#include "sim/reprogram/ways_file.h"

#include "pipeline/base/joined.h"
#include "pipeline/settings/fields.h"
#include "sim/reprogram/patched_program.h"

namespace dresslife::sim {
namespace {

/// Returns, (line), the damage of the cycles that a line closes plus that of the cycles that it opens.
std::vector<double> cost_of_lines(const std::filesystem::path& life_file) {
  const pipeline::FileReader life(life_file, pipeline::life_format());
  std::vector<double> cost = life.read<double>("/program/damage");
  if (!life.has("/program/damage_opened")) return cost;
  const std::vector<double> opened = life.read<double>("/program/damage_opened");
  for (std::size_t k = 0; k < cost.size(); ++k) cost[k] += opened[k];
  return cost;
}

}  // namespace

void write_ways(const pipeline::Job& job, const std::filesystem::path& life_file, std::size_t most_lines,
                pipeline::FileWriter& file) {
  if (job.motion.program.empty())
    throw pipeline::InputError(job.motion.where, "the motion is no robot program",
                               "give a job with motion: {program: FILE}; dresslife reprogram takes steps, too");
  const std::vector<double> cost = cost_of_lines(life_file);
  const ReadProgram read = read_job_program(job);
  std::vector<std::string> whats, lines, motions, patches, refused;
  for (const ProgramWay& way : program_ways(job, read, cost, most_lines)) {
    try {
      PatchedProgram made = patched(job, read, way);
      whats.push_back(way.what);
      lines.push_back(pipeline::joined(way.lines, "\n"));
      motions.push_back(to_yaml(pipeline::echo_fields(made.motion)));
      patches.push_back(std::move(made.patch));
    } catch (const pipeline::InputError& error) {
      refused.push_back(error.what());
    }
  }
  file.append("/way/what", whats);
  file.append("/way/lines", lines);
  file.append("/way/motion", motions);
  file.append("/way/patch", patches);
  file.append("/refusal/words", refused);
}

}  // namespace dresslife::sim
