// dresslife-sim: a job in, motion.h5 out.
#include <optional>

#include "pipeline/job/job.h"
#include "pipeline/stage.h"
#include "sim/memory.h"
#include "sim/motion_file.h"
#include "sim/preview.h"
#include "sim/prescribed.h"
#include "sim/simulate.h"

using namespace dresslife;

namespace {

void preview(const pipeline::StageCall& call, const pipeline::Job& job) {
  if (job.motion.is_prescribed())
    throw pipeline::InputError(job.motion.where, "a prescribed deformation has no cell to preview (nothing moves)",
                               "run it, and look at its page");
  pipeline::FileWriter file(call.output, pipeline::preview_format());
  sim::write_preview(job, file);
  pipeline::stamp(file, call, job, "");
  file.commit();
}

void prescribe(const pipeline::StageCall& call, const pipeline::Job& job, pipeline::Progress& progress) {
  pipeline::FileWriter file(call.output, pipeline::motion_format());
  pipeline::note_warnings(file, call, progress,
                          sim::write_prescribed(job, file, [&](double share) { progress.show(share); }));
  pipeline::stamp(file, call, job, "");
  file.commit();
}

void simulate(const pipeline::StageCall& call, const pipeline::Job& job, pipeline::Progress& progress) {
  const sim::Simulation simulation(job);
  pipeline::heed_memory(call, sim::memory_of(simulation), progress);
  std::optional<pipeline::FileWriter> file;
  std::optional<sim::MotionFile> motion;
  const auto begin = [&](int) {  // a repeat that does not count leaves nothing
    motion.reset();
    file.reset();
    file.emplace(call.output, pipeline::motion_format());
    motion.emplace(*file, simulation.description());
  };
  begin(1);
  const sim::RunSummary summary = simulation.run({[&](const sim::Sample& sample) { motion->add(sample); }, begin,
                                                  [&](double share) { progress.show(share); }});
  motion->finish(summary, [&](double time) { return simulation.path().step(time); });
  if (const std::string note = sim::repeats_note(summary); !note.empty()) progress.note(note);
  pipeline::note_warnings(*file, call, progress, sim::warnings_of(simulation, summary));
  pipeline::stamp(*file, call, job, "");
  file->commit();
}

}  // namespace

int main(int argc, char** argv) {
  const pipeline::StageInfo info{
      .program = "dresslife-sim",
      .purpose = "Simulates how a robot's dresspack moves while the robot runs its program.",
      .input = "JOB.yaml",
      .output = "motion.h5",
      .example = "dresslife-sim config/jobs/irb6640_spot_welding.yaml -o motion.h5",
      .input_is_job = true,
      .options = {{"--preview", "",
                   "simulate nothing; write what stands where, and which lengths suit (preview.h5)"}},
      .part = pipeline::Part::sim};
  return pipeline::run_stage(info, argc, argv,
                             [](const pipeline::StageCall& call, pipeline::Progress& progress) {
                               const pipeline::Job job = pipeline::read_job(call.input, call.sets);
                               if (!call.options.front().empty()) return preview(call, job);
                               return job.motion.is_prescribed() ? prescribe(call, job, progress)
                                                                 : simulate(call, job, progress);
                             });
}
