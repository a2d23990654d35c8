#include "sim/program/backup.h"
#include "sim/program/tokens.h"

namespace dresslife::sim {

namespace fs = std::filesystem;

Backup fanuc_backup(const fs::path& folder, const std::vector<fs::path>& files, const std::string& routine) {
  Backup backup{Language::fanuc, files, ""};
  const auto main = std::find_if(files.begin(), files.end(), [&](const fs::path& file) {
    return lower_case(file.stem().string()) == lower_case(routine.empty() ? "main" : routine) &&
           lower_case(file.extension().string()) == ".ls";
  });
  if (main == files.end())
    throw pipeline::InputError({folder.string()},
                               routine.empty() ? "holds no main.ls" : fmt::format("holds no {}.ls", routine),
                               "name the program: its .ls file, or --routine");
  std::rotate(backup.files.begin(), backup.files.begin() + (main - files.begin()),
              backup.files.begin() + (main - files.begin()) + 1);
  return backup;
}

}  // namespace dresslife::sim
