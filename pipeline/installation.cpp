#include "pipeline/installation.h"

#include <cstdlib>
#include <fstream>

#include "pipeline/errors.h"
#include "pipeline/instruction_set.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

fs::path shared_folder() { return program_folder().parent_path() / "share" / "dresslife"; }

bool is_folder(const fs::path& path) {
  std::error_code failure;
  return fs::is_directory(path, failure);
}

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

}  // namespace

fs::path program_folder() { return fs::read_symlink("/proc/self/exe").parent_path(); }

fs::path shipped_catalogue() {
  if (const char* wanted = std::getenv("DRESSLIFE_CONFIG"); wanted && *wanted) {
    if (is_folder(wanted)) return wanted;
    throw InputError({"DRESSLIFE_CONFIG"}, fmt::format("names {}, which is no folder", wanted),
                     "set it to a folder that holds robots, programs, dresspacks and materials, or unset it");
  }
  const fs::path own = shared_folder() / "config";
  if (is_folder(own)) return fs::canonical(own);
  throw InputError({own.string()}, "is not there (the catalogue stands in share/ beside the programs' bin/)",
                   "move both together, or let DRESSLIFE_CONFIG name the catalogue");
}

const char* version() { return DRESSLIFE_VERSION; }

std::string version_text(const std::string& program) {
  std::string text = fmt::format("{} {}\n", program, version());
  if (const std::string commit = first_line(shared_folder() / "commit"); !commit.empty())
    text += "commit " + commit + "\n";
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
