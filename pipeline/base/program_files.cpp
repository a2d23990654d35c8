#include "pipeline/base/program_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>

#include "pipeline/base/errors.h"
#include "pipeline/base/plain_file.h"
#include "pipeline/base/text.h"

namespace dresslife::pipeline {

namespace {

namespace fs = std::filesystem;

std::string lower_extension(const fs::path& file) { return lower_case(file.extension().string()); }

bool ends_like_a_program(const fs::path& file) {
  static const std::set<std::string> ends{".mod", ".modx", ".prg", ".sys", ".sysx", ".pgf", ".src",
                                          ".dat", ".sub",  ".ls",  ".va",  ".jbi",  ".cnd"};
  return ends.contains(lower_extension(file)) ||
         lower_case(file.filename().string()) == "backinfo.txt";  // ABB's contents
}

constexpr std::size_t most_files = 20'000;  // limit for one folder, many times the size of a controller's backup

/// Returns the folder R1 of the KUKA backup that contains the file; empty: the file is in no backup.
fs::path krl_robot_of(const fs::path& file) {
  for (fs::path at = file.parent_path(); !at.empty() && at != at.parent_path(); at = at.parent_path())
    if (at.filename() == "R1" || at.filename() == "r1") return at;
  return {};
}

fs::path folder_of_program(const fs::path& program) {
  return program.has_parent_path() ? program.parent_path() : fs::path(".");
}

/// Returns the files that the controller can use beside a program: in a backup all files of the robot, else those in its folder.
std::vector<fs::path> krl_files_beside(const fs::path& program) {
  std::vector<fs::path> files;
  const fs::path robot = krl_robot_of(program);
  const fs::path folder = robot.empty() ? folder_of_program(program) : robot;
  for (const fs::path& entry : robot.empty() ? entries_of(folder) : files_below(folder)) {
    if (files.size() == most_files) break;
    if (!is_krl(entry) || kind_of(entry) != FileKind::file) continue;
    const fs::path file = folder == "." ? entry.filename() : entry;
    if (inode_of(file) != inode_of(program)) files.push_back(file);
  }
  return files;
}

}  // namespace

bool is_krl(const fs::path& file) {
  static const std::set<std::string> ends{".src", ".dat", ".sub"};
  return ends.contains(lower_extension(file));
}

std::vector<fs::path> program_files(const fs::path& program) {
  std::vector<fs::path> files;
  const bool listed = lower_extension(program) == ".pgf", is_folder = kind_of(program) == FileKind::folder;
  const fs::path folder = is_folder && !listed ? program : folder_of_program(program);
  if (is_folder || listed) {
    for (const fs::path& file : files_below(folder)) {
      if (!ends_like_a_program(file)) continue;
      files.push_back(file);
      if (files.size() > most_files)
        throw InputError({program.string()}, fmt::format("holds more than {} program files", most_files),
                         "name the folder of one controller");
    }
  } else if (is_krl(program)) {
    files = krl_files_beside(program);
  }
  if (lower_extension(program) == ".jbi")  // the controller's other jobs, frames and variables
    for (const fs::path& beside : entries_of(folder_of_program(program))) {
      const fs::path file = program.has_parent_path() ? beside : beside.filename();
      const std::string end = lower_extension(file);
      if ((end == ".jbi" || end == ".cnd" || lower_case(file.filename().string()) == "var.dat") && file != program &&
          files.size() < most_files)
        files.push_back(file);
    }
  if (lower_extension(program) == ".ls" && !is_folder)  // programs that it may call, and its registers
    for (const fs::path& place : {folder, folder / ".."})
      for (const fs::path& beside : entries_of(place)) {
        const std::string end = lower_extension(beside);
        if ((end == ".va" || (end == ".ls" && place == folder)) && beside != program && files.size() < most_files)
          files.push_back(beside);
      }
  std::ranges::sort(files);
  return files;
}

}  // namespace dresslife::pipeline
