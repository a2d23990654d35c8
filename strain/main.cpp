// dresslife-strain: reads motion.h5 and writes strain.h5.
#include "pipeline/base/threads.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/stage/stage.h"
#include "strain/memory.h"
#include "strain/strain_file.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

int main(int argc, char** argv) {
  using namespace dresslife;
#ifdef __GLIBC__
  // Blocks of the motion are allocated and freed again and again. The system would clear their pages each time.
  constexpr int kept_bytes = 32 << 20;  // largest value that glibc accepts for the first limit
  mallopt(M_MMAP_THRESHOLD, kept_bytes), mallopt(M_TRIM_THRESHOLD, 8 * kept_bytes);
#endif
  const pipeline::StageInfo info{.program = "dresslife-strain",
                                 .purpose = "Computes the strain of every wire of a dresspack while the robot moves.",
                                 .input = "motion.h5",
                                 .output = "strain.h5",
                                 .example = "dresslife-strain motion.h5 -o strain.h5 --set strain.slip=stick",
                                 .part = pipeline::JobPart::strain};
  return pipeline::run_stage(info, argc, argv, [](const pipeline::StageCall& call, pipeline::Progress& progress) {
    const pipeline::FileReader motion(call.input, pipeline::motion_format());
    const pipeline::Job job = pipeline::job_of(call, motion, {pipeline::JobPart::sim});
    pipeline::require_memory(call, strain::memory_of(motion, job, pipeline::thread_count()), progress);
    pipeline::FileWriter file(call.output, pipeline::strain_format());
    const strain::Notes notes =
        strain::write_strain(motion, job, file, pipeline::thread_count(), [&](double share) { progress.show(share); });
    pipeline::note_warnings(file, call, progress, notes.warnings, &motion);
    pipeline::stamp(file, call, job, motion.text_attribute("history"));
    file.commit();
    progress.note(notes.summary);
  });
}
