// A stage of a study that computes nothing but does all file handling of a real stage. Its name at the start selects
// dresslife-sim, -strain or -fatigue.
//
// Its output contains its settings and its input's checksum. It appends a line to `calls` beside the output for each run, and
// it reads control files there: fail-STAGE: it fails; silent-STAGE: it ends without a message; wait-STAGE: it waits until this
// file is removed.
#include <filesystem>
#include <fstream>
#include <thread>

#include "pipeline/files/checksum.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/stage/stage.h"
#include "tests/pipeline/sample_life.h"

using namespace dresslife::pipeline;
namespace fs = std::filesystem;

namespace {

Format fake_format(const std::string& name) {
  Format format{"dresslife-" + name, 1, "dresslife-" + name, "tests", {}, {}};
  format.datasets = {{"/content", Type::text, {"line"}, "1", "what it was made from"}};
  return format;
}

void make(const StageCall& call, const std::string& stage) {
  const fs::path folder = call.output.parent_path();
  std::ofstream(folder / "calls", std::ios::app) << stage << '\n';
  while (fs::exists(folder / ("wait-" + stage))) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  if (fs::exists(folder / ("fail-" + stage))) throw InputError({"job.yaml", 1, 1}, stage + " broke", "correct it");
  if (fs::exists(folder / ("silent-" + stage))) std::_Exit(3);
  const Job job = read_job(call.info.input_is_job ? call.input : call.job_file, call.sets);
  std::string made = part_text(job, *call.info.part);
  for (const fs::path& file : files_beside(job)) made += read_text(file);
  if (!call.info.input_is_job) made += checksum_of(call.input).value();
  if (stage == "fatigue") return write_sample_life(call.output, {.segments = 4, .samples = 100, .job = made});
  const Format format = fake_format(stage);
  FileWriter file(call.output, format);
  file.append("/content", std::span<const std::string>(std::vector<std::string>{made}));
  stamp(file, call, job, "");
  file.commit();
}

}  // namespace

int main(int argc, char** argv) {
  const std::string program = fs::path(argv[0]).filename().string();
  const std::string stage = program.substr(program.rfind('-') + 1);
  const StageInfo info{.program = program,
                       .purpose = "Stands for a stage in the tests.",
                       .input = "INPUT",
                       .output = "OUTPUT",
                       .example = program + " INPUT -o OUTPUT",
                       .input_is_job = stage == "sim",
                       .part = stage == "sim"      ? JobPart::sim
                               : stage == "strain" ? JobPart::strain
                                                   : JobPart::fatigue,
                       .results = [&](const fs::path& output) {
                         return stage == "fatigue" ? results_in(output, life_format()) : std::vector<ResultValue>();
                       }};
  return run_stage(info, argc, argv, [&](const StageCall& call, Progress&) { make(call, stage); });
}
