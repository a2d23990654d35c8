// One run at a time in a study's folder, or several runs with one shard each.
#pragma once

#include <filesystem>

namespace dresslife::pipeline {

/// Held until the program and all stages that it started have ended. Meanwhile no other run writes there.
class FolderLock {
 public:
  /// Makes the folder. Waits for the stages of an interrupted run, which end a moment later. Errors: InputError when
  /// another run holds the lock or the folder cannot be written.
  explicit FolderLock(const std::filesystem::path& folder) : FolderLock(folder, Mode::alone) {}
  /// shards: several runs hold the lock together.
  enum class Mode { alone, with_shards };
  FolderLock(const std::filesystem::path& folder, Mode held);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace dresslife::pipeline
