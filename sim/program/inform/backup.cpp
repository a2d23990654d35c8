#include "pipeline/base/plain_file.h"
#include "sim/program/inform/inform.h"
#include "sim/program/interpreter/encoding.h"
#include "sim/program/interpreter/tokens.h"

namespace dresslife::sim {

namespace fs = std::filesystem;

Backup inform_backup(const fs::path& folder, const std::vector<fs::path>& files, const std::string& routine) {
  Backup backup{Language::inform, files, routine};
  CallGraph graph;
  std::map<std::string, fs::path> file_of;
  for (const fs::path& file : files)
    if (lower_case(file.extension().string()) == ".jbi") {
      Calls calls = inform_calls(SourceFile(file.string(), decoded_text(pipeline::read_text(file))));
      file_of[calls.name] = file;
      graph[calls.name] = std::move(calls);
    }
  if (routine.empty()) backup.routine = only_start(folder, uncalled_programs(graph), "job");
  put_first(file_of[lower_case(backup.routine)], backup);
  return backup;
}

}  // namespace dresslife::sim
