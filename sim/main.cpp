// dresslife-sim: a job in, motion.h5 out.
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
      .input_is_job = true};
  return pipeline::run_stage(info, argc, argv,
                             [](const pipeline::StageCall& call, pipeline::Progress& progress) {
                               const pipeline::Job job = pipeline::read_job(call.input, call.sets);
                               const sim::Simulation simulation(job);
                               pipeline::FileWriter file(call.output, pipeline::motion_format());
                               sim::MotionFile motion(file, simulation.description());
                               simulation.run([&](const sim::Sample& sample) { motion.add(sample); },
                                              [&](double share) { progress.show(share); });
                               pipeline::stamp(file, call, job, "");
                               file.commit();
                             });
}
