// dresslife-fatigue: reads strain.h5 and writes life.h5.
#include "fatigue/life_file.h"
#include "fatigue/memory.h"
#include "pipeline/base/threads.h"
#include "pipeline/cable/excess.h"
#include "pipeline/job/job.h"
#include "pipeline/job/line_key.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/resolve/plausible_job.h"
#include "pipeline/stage/stage.h"

namespace {

using namespace dresslife;

/// Returns warnings on the descriptions of the dresspacks and on settings, independent of the motion. They belong to this stage,
/// because it runs again if a key of any stage changes; in the file of an earlier stage they would become outdated.
std::vector<pipeline::Warning> description_warnings(const pipeline::Job& job) {
  std::vector<pipeline::Warning> all = pipeline::plausibility_of_lives(job);
  for (std::size_t d = 0; d < job.dresspacks.size(); ++d)
    all = pipeline::joined(std::move(all), pipeline::construction_warnings_at(pipeline::line_key(job, d, "dresspack"), job.dresspacks[d].dresspack,
                                                                              pipeline::slides(job.strain.slip.front())));
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace dresslife;
  const pipeline::StageInfo info{
      .program = "dresslife-fatigue",
      .purpose = "Predicts the life of every wire of a dresspack, and which wire breaks first.",
      .input = "strain.h5",
      .output = "life.h5",
      .example = "dresslife-fatigue strain.h5 -o life.h5 --set fatigue.stress=elastic",
      .part = pipeline::JobPart::fatigue,
      .results = [](const std::filesystem::path& life) {
        return pipeline::results_in(life, pipeline::life_format());
      }};
  return pipeline::run_stage(
      info, argc, argv, [](const pipeline::StageCall& call, pipeline::Progress& progress) {
        const pipeline::FileReader strain(call.input, pipeline::strain_format());
        const pipeline::Job job =
            pipeline::job_of(call, strain, {pipeline::JobPart::sim, pipeline::JobPart::strain});
        pipeline::require_memory(call, fatigue::memory_of(strain, pipeline::thread_count()), progress);
        pipeline::FileWriter life(call.output, pipeline::life_format());
        const fatigue::Notes notes = fatigue::write_life(strain, job, life, pipeline::thread_count(),
                                                         [&](double share) { progress.show(share); });
        pipeline::note_warnings(life, call, progress, pipeline::joined(description_warnings(job), notes.warnings), &strain);
        pipeline::stamp(life, call, job, strain.text_attribute("history"));
        life.commit();
        progress.note(notes.summary);
      });
}
