// libFuzzer's entry for jobs: any bytes as a job's YAML. A job that is accepted must be reproduced by its own echo. Not part of
// the tests; built by scripts/fuzz.
#include <cstdlib>
#include <fstream>

#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "tests/pipeline/sample_job.h"

using namespace dresslife::pipeline;

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  std::ofstream("corpus/sample") << sample_job;
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  std::string echo;
  try {
    echo = job_text(job_from(parse_yaml(std::string(reinterpret_cast<const char*>(data), size), "job.yaml")));
  } catch (const InputError&) {
    return 0;
  }
  // Outside the try block: a refused echo is a bug.
  const Job again = job_from(parse_yaml(echo, "job.yaml"));
  if (job_text(again) != echo) std::abort();
  for (const JobPart part : {JobPart::sim, JobPart::strain, JobPart::fatigue}) part_text(again, part);
  files_beside(again);
  return 0;
}
