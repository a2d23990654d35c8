#include "pipeline/base/installation.h"

#include <sys/auxv.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "pipeline/base/errors.h"
#include "pipeline/base/instruction_set.h"
#include "pipeline/base/plain_file.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

fs::path shared_folder() { return program_folder().parent_path() / "share" / "dresslife"; }

std::string first_line(const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

std::string instruction_set_names() {
  std::string names;
  for (const InstructionSet set : instruction_sets()) names += std::string(" ") + name_of(set);
  return names;
}

/// Returns the file that a shell starts for this name; empty: it finds none.
fs::path on_search_path(const std::string& name) {
  const char* const all = std::getenv("PATH");
  std::istringstream folders(all ? all : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path candidate = fs::path(folder.empty() ? "." : folder) / name;
    std::error_code failure;
    if (fs::is_regular_file(candidate, failure) && ::access(candidate.c_str(), X_OK) == 0) return candidate;
  }
  return {};
}

}  // namespace

fs::path program_called(const std::string& name) {
  const fs::path found = name.find('/') == std::string::npos ? on_search_path(name) : fs::path(name);
  std::error_code failure;
  const fs::path itself = fs::canonical(found, failure);
  if (found.empty() || failure)
    throw InputError({name.empty() ? "this program" : name},
                     "is not found again (/proc is not there, and the name does not lead to it)",
                     "mount /proc, or start it by its whole path");
  return itself;
}

fs::path program_file() {
  std::error_code failure;
  const fs::path target = fs::read_symlink("/proc/self/exe", failure);
  if (!failure) return target;
  // Reads the path that the kernel started from the auxiliary vector. A relative path is valid because no program of this project
  // changes its current folder.
  const char* const name = reinterpret_cast<const char*>(::getauxval(AT_EXECFN));
  return program_called(name ? name : "");
}

fs::path program_folder() { return program_file().parent_path(); }

fs::path shipped_catalogue() {
  if (const char* wanted = std::getenv("DRESSLIFE_CONFIG"); wanted && *wanted) {
    if (kind_of(wanted) == FileKind::folder) return wanted;
    throw InputError({"DRESSLIFE_CONFIG"}, fmt::format("names {}, which is no folder", wanted),
                     "set it to a folder that holds robots, programs, dresspacks and materials, or unset it");
  }
  const fs::path own = shared_folder() / "config";
  if (kind_of(own) == FileKind::folder) return fs::canonical(own);
  throw InputError({own.string()}, "does not exist (the catalogue is in share/, beside the programs' bin/)",
                   "move both together, or let DRESSLIFE_CONFIG name the catalogue");
}

const char* version() { return DRESSLIFE_VERSION; }

std::string version_text(const std::string& program) {
  std::string text = fmt::format("{} {}\n", program, version());
  try {
    if (const std::string commit = first_line(shared_folder() / "commit"); !commit.empty())
      text += "commit " + commit + "\n";
  } catch (const InputError&) {  // shipped_catalogue() below reports the same problem
  }
  text += "built as " DRESSLIFE_BUILD "\n";
  text += fmt::format("this machine runs the hot loops with:{}\n", instruction_set_names());
  text += "libraries: " DRESSLIFE_LIBRARIES "\n";
  try {
    text += "catalogue: " + shipped_catalogue().string();
  } catch (const InputError& problem) {
    text += problem.what();
  }
  return text;
}

}  // namespace dresslife::pipeline
