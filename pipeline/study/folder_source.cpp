#include "pipeline/study/folder_source.h"

#include <fmt/format.h>

#include "pipeline/base/errors.h"
#include "pipeline/base/ownership.h"
#include "pipeline/base/plain_file.h"
#include "pipeline/base/whole_file.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

fs::path note_of(const fs::path& folder) { return folder / ".stage" / "source"; }

}  // namespace

void check_source(const fs::path& folder, const fs::path& file) {
  if (replaces_files_of_others() || !state_of(note_of(folder)).exists()) return;
  std::error_code failure;  // a path that cannot be resolved is not an existing other file
  const fs::path other = fs::weakly_canonical(folder, failure) / read_text(note_of(folder));
  if (kind_of(other) != FileKind::file || inode_of(other) == inode_of(file)) return;
  throw InputError({folder.string()},
                   fmt::format("holds the results of another file, {}, not of {}",
                               fs::proximate(other.lexically_normal()).string(), file.string()),
                   "choose another folder with -o FOLDER; to replace those results, run with --force");
}

void claim_folder(const fs::path& folder, const fs::path& file) {
  check_source(folder, file);
  make_notes(folder / ".stage");
  // A relative path stays valid in a copy of the folder together with its file.
  write_text_if_changed(note_of(folder), fs::proximate(fs::canonical(file), fs::canonical(folder)).string(),
                        Sync::never);
}

}  // namespace dresslife::pipeline
