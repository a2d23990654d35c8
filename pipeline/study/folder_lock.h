// One run at a time in a study's folder, or several of which each makes its own shard of it.
#pragma once

#include <filesystem>

namespace dresslife::pipeline {

/// Held until the program and all that it has started have ended: the stages of a run hold the lock with it,
/// and while one of them lives nobody else writes there.
class FolderLock {
 public:
  /// Makes the folder. Waits for stages whose run was broken off, which end a moment later. Errors:
  /// InputError when another run holds it or the folder cannot be written.
  explicit FolderLock(const std::filesystem::path& folder) : FolderLock(folder, Mode::alone) {}
  /// shards: beside others that hold it so.
  enum class Mode { alone, with_shards };
  FolderLock(const std::filesystem::path& folder, Mode held);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace dresslife::pipeline
