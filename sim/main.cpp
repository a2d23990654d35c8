// dresslife-sim: a job in, motion.h5 out.
#include <optional>
#include <string>

#include "pipeline/files/checks.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/stage/stage.h"
#include "sim/route/exercise.h"
#include "sim/route/preview.h"
#include "sim/route/screening_file.h"
#include "sim/run/memory.h"
#include "sim/run/motion_file.h"
#include "sim/run/prescribed.h"
#include "sim/run/simulate.h"

using namespace dresslife;

namespace {

enum Option { preview, screen, rehearse, ring, exercise };

/// What is asked for without a run. Returns false when it is the run that is asked for.
bool told_at_rest(const pipeline::StageCall& call, pipeline::Job& job) {
  const auto asked = [&](Option option) { return !call.options[option].empty(); };
  if (!asked(preview) && !asked(screen)) return false;
  if (job.motion.is_prescribed())
    throw pipeline::InputError(job.motion.where,
                               "a prescribed deformation has no cell to preview (nothing moves)",
                               "run it, and look at its page");
  if (asked(exercise)) job.motion = sim::exercise(job.robot);
  pipeline::FileWriter file(call.output,
                            asked(preview) ? pipeline::preview_format() : pipeline::screening_format());
  if (asked(preview))
    sim::write_preview(job, file);
  else
    sim::write_screening(job,
                         {call.options[screen].back(), asked(rehearse), asked(exercise),
                          asked(ring) ? call.options[ring].back() : std::string()},
                         file);
  pipeline::stamp(file, call, job, "");
  file.commit();
  return true;
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
  const sim::RunSummary summary = simulation.run({[&](const sim::Sample& sample) { motion->add(sample); },
                                                  begin, [&](double share) { progress.show(share); }});
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
      .options =
          {{"--preview", "",
            "simulate nothing; write what stands where, and which lengths suit (preview.h5)"},
           {"--screen", "LIST.yaml",
            "simulate nothing; write what geometry says of the job with each of these changes (screening.h5)"},
           {"--rehearse", "", "with --screen: run each with few segments, and write what was seen"},
           {"--ring", "LINK",
            "with --screen: routings of the routing box (routing_at) have a guide ring on this link, too"},
           {"--exercise", "", "with these: instead of the job's motion one that moves the wrist about"}},
      .part = pipeline::Part::sim,
      .told = pipeline::told_checks};
  return pipeline::run_stage(
      info, argc, argv, [](const pipeline::StageCall& call, pipeline::Progress& progress) {
        pipeline::Job job = pipeline::read_job(call.input, call.sets);
        if (told_at_rest(call, job)) return;
        return job.motion.is_prescribed() ? prescribe(call, job, progress) : simulate(call, job, progress);
      });
}
