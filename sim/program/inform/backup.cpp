#include "pipeline/base/plain_file.h"
#include "sim/program/inform/inform.h"
#include "sim/program/interpreter/encoding.h"
#include "sim/program/interpreter/tokens.h"

namespace dresslife::sim {

namespace fs = std::filesystem;

Backup inform_backup(const fs::path& folder, const std::vector<fs::path>& files, const std::string& routine) {
  Backup backup{Language::inform, {}, routine};
  CallGraph graph;
  std::map<std::string, fs::path> file_of;
  for (const fs::path& file : files)
    if (lower_case(file.extension().string()) == ".jbi") {
      Calls calls = inform_calls(SourceFile(file.string(), decoded_text(pipeline::read_text(file))));
      file_of[calls.name] = file;
      graph[calls.name] = std::move(calls);
    }
  if (routine.empty()) backup.routine = only_start(folder, uncalled_programs(graph), "job");
  const auto first = file_of.find(lower_case(backup.routine));
  if (first != file_of.end()) backup.files.push_back(first->second);  // the first file gives the motion its name
  for (const fs::path& file : files)
    if (first == file_of.end() || file != first->second) backup.files.push_back(file);
  return backup;
}

}  // namespace dresslife::sim
