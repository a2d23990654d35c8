// A file that is whole or absent, however its writing ends, and that replaces only what is ours (ownership.h).
//
// It is written under a name of its own, dresslife-PROCESS-NUMBER.part in the folder of its final name, made
// exclusively and never through a link, and locked while its writer lives. commit() syncs it, lets the file system
// report what it has kept back, gives it its final name in one step and syncs the folder. Of two writers of one name
// the later wins whole. A signal removes the part (last_moment.h). What killed writers left is not locked: the next
// writer in that folder removes it. On a file system without locks it stays.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "pipeline/base/last_moment.h"
#include "pipeline/base/ownership.h"
#include "pipeline/base/plain_file.h"

namespace dresslife::pipeline {

/// Whether a file's bytes reach the disk before its final name does. What every run compares and mends anyway
/// needs no sync, and ten thousand jobs have ten thousand such files.
enum class Sync { now, never };

class WholeFile {
 public:
  /// Errors: InputError when it cannot be made there, or would replace what is not ours.
  explicit WholeFile(std::filesystem::path final_name);
  /// Without commit() nothing stays behind.
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  /// For libraries that cannot be thrown through: the first failure is kept and later writes do nothing;
  /// commit() and check() throw it.
  void write_at(const void* bytes, std::size_t count, std::uint64_t offset) noexcept;
  void set_length(std::uint64_t bytes) noexcept;
  /// What was written there; false where it cannot be read back, which is a failure like that of a write.
  bool read_back(void* bytes, std::size_t count, std::uint64_t offset) noexcept;
  /// Later writes do nothing: the file is not wanted any more.
  void give_up() noexcept;
  /// Errors: InputError when a write has failed.
  void check() const;

  /// Makes it the final file; a final file of the same bytes stays untouched, with its time.
  /// Errors: InputError; nothing has been made then. std::logic_error: it has no mark that it is ours.
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

/// Writes a whole text file; leaves it untouched when it holds just that text.
/// Errors: InputError when the folder or the file cannot be written.
void write_text_if_changed(const std::filesystem::path& file, const std::string& text, Sync when = Sync::now);

/// Copies a plain file, whole or not at all. Nothing where there is none. Errors: InputError, DiskError.
void copy_if_there(const std::filesystem::path& from, const std::filesystem::path& to);

/// Gives a file that is whole a second name, which replaces what is ours there; where the file system has no second
/// names, a copy. Errors: InputError, DiskError.
void give_second_name(const std::filesystem::path& file, const std::filesystem::path& name);

/// Removes what killed writers left in a folder.
void remove_leftovers(const std::filesystem::path& folder);

enum class LockState { taken, held_by_another, not_known_here };
/// Takes a lock of a file without waiting for it (operation: of flock). Errors: none; a file system without locks is
/// not_known_here.
LockState take_lock(int descriptor, int operation);

}  // namespace dresslife::pipeline
