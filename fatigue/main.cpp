// dresslife-fatigue: reads strain.h5 and writes life.h5.
#include "fatigue/life_file.h"
#include "fatigue/memory.h"
#include "pipeline/base/threads.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/resolve/plausible_job.h"
#include "pipeline/stage/stage.h"

int main(int argc, char** argv) {
  using namespace dresslife;
  const pipeline::StageInfo info{
      .program = "dresslife-fatigue",
      .purpose = "Predicts the life of every wire of a dresspack, and which wire breaks first.",
      .input = "strain.h5",
      .output = "life.h5",
      .example = "dresslife-fatigue strain.h5 -o life.h5 --set fatigue.stress=elastic",
      .part = pipeline::JobPart::fatigue,
      .results = [](const std::filesystem::path& life) { return pipeline::results_in(life, pipeline::life_format()); }};
  return pipeline::run_stage(info, argc, argv, [](const pipeline::StageCall& call, pipeline::Progress& progress) {
    const pipeline::FileReader strain(call.input, pipeline::strain_format());
    const pipeline::Job job = pipeline::job_of(call, strain, {pipeline::JobPart::sim, pipeline::JobPart::strain});
    pipeline::require_memory(call, fatigue::memory_of(strain, pipeline::thread_count()), progress);
    pipeline::FileWriter life(call.output, pipeline::life_format());
    const fatigue::Notes notes =
        fatigue::write_life(strain, job, life, pipeline::thread_count(), [&](double share) { progress.show(share); });
    // Warnings on settings and descriptions are written here, because this stage runs again if any key changes. In the file of an
    // earlier stage they would become outdated.
    const auto warnings =
        pipeline::joined(pipeline::plausibility_of_lives(job), pipeline::warnings_of_descriptions(job));
    pipeline::note_warnings(life, call, progress, pipeline::joined(warnings, notes.warnings), &strain);
    pipeline::stamp(life, call, job, strain.text_attribute("history"));
    life.commit();
    progress.note(notes.summary);
  });
}
