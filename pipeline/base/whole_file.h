// Writes a file that is complete or absent, however the writing ends. It replaces only files of ours (ownership.h).
//
// The file is written under a temporary name, dresslife-PROCESS-NUMBER.part, in the folder of its final name. It is created
// exclusively, never through a link, and locked while its writer lives. commit() syncs it, closes a duplicate of its descriptor
// to get delayed write errors, renames it in one step and syncs the folder. If two writers use one name, the later one replaces
// the whole file. A signal removes the temporary file (last_moment.h). Temporary files of killed writers are not locked, and the
// next writer in that folder removes them. On a file system without locks they stay.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "pipeline/base/last_moment.h"
#include "pipeline/base/ownership.h"
#include "pipeline/base/plain_file.h"

namespace dresslife::pipeline {

/// Whether the bytes of a file reach the disk before its final name. Files that every run compares and corrects anyway need no
/// sync: ten thousand jobs have ten thousand such files.
enum class Sync { now, never };

/// Returns whether `name` is that of a temporary file, "dresslife-PROCESS-NUMBER.part".
bool is_part(std::string_view name);

class WholeFile {
 public:
  /// Opens the temporary file. Errors: InputError if it cannot be created, or would replace a file that is not ours.
  explicit WholeFile(std::filesystem::path final_name);
  /// Removes the temporary file unless commit() was called.
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  /// Writes bytes. Throws nothing, because libraries that call it cannot handle exceptions: the first failure is stored, later
  /// writes do nothing, and commit() and check() throw it.
  void write_at(const void* bytes, std::size_t count, std::uint64_t offset) noexcept;
  void set_length(std::uint64_t bytes) noexcept;
  /// Reads written bytes. Returns false if they cannot be read; this counts as a failed write.
  bool read_back(void* bytes, std::size_t count, std::uint64_t offset) noexcept;
  /// Makes later writes do nothing, because the file is not needed.
  void give_up() noexcept;
  /// Errors: InputError if a write has failed.
  void check() const;

  /// Makes this the final file. If the final file has the same bytes already, it stays unchanged, with its time. Errors:
  /// InputError; then no final file was made. std::logic_error: the file has no mark of ours.
  void commit(Sync when = Sync::now);

  int descriptor() const { return descriptor_; }
  const std::filesystem::path& final_name() const { return final_name_; }

 private:
  [[noreturn]] void fail(int error) const;
  void check_mark() const;
  std::filesystem::path final_name_, part_;
  std::optional<RemovedAtTheEnd> removed_at_the_end_;
  int descriptor_ = -1;
  int error_ = 0;  ///< errno of the first failure
  bool given_up_ = false, committed_ = false;
};

/// Writes a whole text file; leaves it unchanged if it has this text already. Errors: InputError if the folder or the file cannot
/// be written.
void write_text_if_changed(const std::filesystem::path& file, const std::string& text, Sync when = Sync::now);

/// Copies a plain file completely or not at all. Does nothing if `from` is absent. Errors: InputError, DiskError.
void copy_if_there(const std::filesystem::path& from, const std::filesystem::path& to);

/// Makes `name` a hard link to a complete file and replaces a file of ours there. Copies the file if the file system has no hard
/// links. Errors: InputError, DiskError.
void give_second_name(const std::filesystem::path& file, const std::filesystem::path& name);

/// Removes temporary files of killed writers in a folder.
void remove_leftovers(const std::filesystem::path& folder);

enum class LockState { taken, held_by_another, not_known_here };
/// Tries to lock a file without waiting (operation: of flock). Throws nothing; returns not_known_here for a file system without
/// locks.
LockState take_lock(int descriptor, int operation);

}  // namespace dresslife::pipeline
