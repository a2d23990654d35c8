#include "pipeline/base/program_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>

#include "pipeline/base/errors.h"

namespace dresslife::pipeline {

namespace {

namespace fs = std::filesystem;

std::string lower(const fs::path& name) {
  std::string text = name.string();
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

std::string lower_extension(const fs::path& file) { return lower(file.extension()); }

bool ends_like_a_program(const fs::path& file) {
  static const std::set<std::string> ends{".mod", ".modx", ".prg", ".sys", ".sysx", ".pgf",
                                          ".src", ".dat",  ".sub", ".ls",  ".va",   ".jbi", ".cnd"};
  return ends.contains(lower_extension(file)) || lower(file.filename()) == "backinfo.txt";  // ABB's contents
}

constexpr std::size_t most_files = 20'000;  // of a folder: many times a controller's backup

bool is_krl(const fs::path& file) {
  static const std::set<std::string> ends{".src", ".dat", ".sub"};
  return ends.contains(lower_extension(file));
}

/// The folder R1 of the KUKA backup that a file lies in; empty: none.
fs::path krl_robot_of(const fs::path& file) {
  for (fs::path at = file.parent_path(); !at.empty() && at != at.parent_path(); at = at.parent_path())
    if (at.filename() == "R1" || at.filename() == "r1") return at;
  return {};
}

/// What the controller sees beside a program: in a backup all of the robot, else its folder.
std::vector<fs::path> krl_files_beside(const fs::path& program) {
  std::vector<fs::path> files;
  std::error_code failure;
  const fs::path robot = krl_robot_of(program);
  const fs::path folder = !robot.empty() ? robot : program.has_parent_path() ? program.parent_path() : ".";
  for (fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied, failure),
       end;
       !failure && at != end && files.size() < most_files; at.increment(failure)) {
    if (robot.empty() && at->is_directory(failure)) at.disable_recursion_pending();
    if (!at->is_regular_file(failure) || !is_krl(at->path())) continue;
    const fs::path file = folder == "." ? at->path().filename() : at->path();
    if (!fs::equivalent(file, program, failure)) files.push_back(file);
  }
  return files;
}

}  // namespace

std::vector<fs::path> program_files(const fs::path& program) {
  std::vector<fs::path> files;
  std::error_code failure;
  const bool listed = lower_extension(program) == ".pgf";
  if (fs::is_directory(program, failure) || listed) {
    const fs::path folder = !listed ? program : program.has_parent_path() ? program.parent_path() : ".";
    for (fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied, failure),
         end;
         !failure && at != end; at.increment(failure)) {
      if (!at->is_regular_file(failure) || !ends_like_a_program(at->path())) continue;
      files.push_back(at->path());
      if (files.size() > most_files)
        throw InputError({program.string()}, fmt::format("holds more than {} program files", most_files),
                         "name the folder of one controller");
    }
  } else if (is_krl(program)) {
    files = krl_files_beside(program);
  }
  if (lower_extension(program) == ".jbi")  // the controller's other jobs, its frames and variables
    for (const fs::directory_entry& beside :
         fs::directory_iterator(program.has_parent_path() ? program.parent_path() : ".", failure)) {
      const fs::path file = program.has_parent_path() ? beside.path() : beside.path().filename();
      const std::string end = lower_extension(file);
      if ((end == ".jbi" || end == ".cnd" || lower(file.filename()) == "var.dat") && file != program &&
          files.size() < most_files)
        files.push_back(file);
    }
  if (lower_extension(program) == ".ls" &&
      !fs::is_directory(program, failure))  // what it calls, and its registers
    for (const fs::path folder = program.has_parent_path() ? program.parent_path() : ".";
         const fs::path& place : {folder, folder / ".."})
      for (const fs::directory_entry& beside : fs::directory_iterator(place, failure)) {
        const std::string end = lower_extension(beside.path());
        if ((end == ".va" || (end == ".ls" && place == folder)) && beside.path() != program &&
            files.size() < most_files)
          files.push_back(beside.path());
      }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace dresslife::pipeline
