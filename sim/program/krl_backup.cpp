#include "sim/program/backup.h"
#include "sim/program/tokens.h"

namespace dresslife::sim {

namespace fs = std::filesystem;

Backup krl_backup(const fs::path& folder, const std::vector<fs::path>& files, const std::string& routine) {
  Backup backup{Language::krl, {}, routine};
  for (const fs::path& file : files)  // the program first
    if (lower_case(file.extension().string()) == ".src") {
      if (!backup.files.empty() && routine.empty())
        throw pipeline::InputError({folder.string()}, "holds more than one KRL program",
                                   "name one: its .src file, or --routine");
      backup.files.push_back(file);
    }
  for (const fs::path& file : files)
    if (lower_case(file.extension().string()) != ".src") backup.files.push_back(file);
  return backup;
}

}  // namespace dresslife::sim
