// Lock of a study's folder: one run at a time, or several runs with one shard each.
#pragma once

#include <filesystem>

namespace dresslife::pipeline {

/// Lock that is held until the program and all stages that it started have ended. Meanwhile no other run writes there.
class FolderLock {
 public:
  /// Creates the folder. Waits for the stages of an interrupted run, which end within milliseconds. Errors: InputError when
  /// another run holds the lock or the folder cannot be written.
  explicit FolderLock(const std::filesystem::path& folder) : FolderLock(folder, Mode::alone) {}
  /// with_shards: several runs hold the lock together.
  enum class Mode { alone, with_shards };
  FolderLock(const std::filesystem::path& folder, Mode held);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace dresslife::pipeline
