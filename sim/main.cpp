// dresslife-sim: a job in, motion.h5 out.
#include <optional>

#include "pipeline/job/job.h"
#include "pipeline/stage.h"
#include "sim/motion_file.h"
#include "sim/simulate.h"

int main(int argc, char** argv) {
  using namespace dresslife;
  const pipeline::StageInfo info{
      .program = "dresslife-sim",
      .purpose = "Simulates how a robot's dresspack moves while the robot runs its program.",
      .input = "JOB.yaml",
      .output = "motion.h5",
      .example = "dresslife-sim config/jobs/irb6640_spot_welding.yaml -o motion.h5",
      .input_is_job = true,
      .part = pipeline::Part::sim};
  return pipeline::run_stage(info, argc, argv,
                             [](const pipeline::StageCall& call, pipeline::Progress& progress) {
                               const pipeline::Job job = pipeline::read_job(call.input, call.sets);
                               const sim::Simulation simulation(job);
                               std::optional<pipeline::FileWriter> file;
                               std::optional<sim::MotionFile> motion;
                               const auto begin = [&](int) {  // a repeat that does not count leaves nothing
                                 motion.reset();
                                 file.reset();
                                 file.emplace(call.output, pipeline::motion_format());
                                 motion.emplace(*file, simulation.description());
                               };
                               begin(1);
                               const sim::RunSummary summary =
                                   simulation.run({[&](const sim::Sample& sample) { motion->add(sample); },
                                                   begin, [&](double share) { progress.show(share); }});
                               motion->finish(simulation, summary);
                               for (const std::string& line : sim::remarks(simulation, summary))
                                 progress.note(line);
                               pipeline::stamp(*file, call, job, "");
                               file->commit();
                             });
}
