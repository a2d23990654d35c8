// Reads files and their state in the file system.
//
// Only plain files are read. Pipes and devices are refused when they are opened, because a reader may wait for a pipe forever and
// a device may be endless. If the file system fails to answer, this is a DiskError: a failing disk must not be mistaken for a
// file that is absent, shorter or damaged.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/base/errors.h"

namespace dresslife::pipeline {

/// When the bytes or the name of a file were last changed, as the file system reports it. Equal states of one path mean equal
/// bytes, if the first state was read at least one tick of the file system's clock (1 .. 10 ms) after the change.
struct FileState {
  std::int64_t size = -1, modified_ns = 0, changed_ns = 0;
  std::uint64_t inode = 0;
  bool exists() const { return size >= 0; }
  bool operator==(const FileState&) const = default;
};
/// Returns the state of a plain file. Anything else, including a link, does not exist. Errors: DiskError.
FileState state_of(const std::filesystem::path& file);
FileState state_of(int descriptor, const std::filesystem::path& name);  ///< name: for messages

enum class FileKind { absent, file, folder, link, other };
/// Returns the kind of the file behind all links, so never `link`. Absent: also a file without permission. Errors: DiskError.
FileKind kind_of(const std::filesystem::path& path);
/// Returns the kind of the name itself, without following links. Errors: DiskError.
FileKind kind_of_name(const std::filesystem::path& path);
/// Returns device and inode of the file behind all links; std::nullopt if kind_of() is absent. Errors: DiskError.
std::optional<std::pair<dev_t, ino_t>> inode_of(const std::filesystem::path& path);

/// Returns the entries of a folder, sorted; empty if it is absent or not readable. Errors: DiskError.
std::vector<std::filesystem::path> entries_of(const std::filesystem::path& folder);
/// Returns the files in a folder and its subfolders, sorted. Follows links to files, but not to folders. Errors: DiskError.
std::vector<std::filesystem::path> files_below(const std::filesystem::path& folder);

/// Block size of reading [bytes]. With larger blocks, a short file costs more time for clearing memory than for reading.
constexpr std::size_t read_block_bytes = 1 << 16;

/// Returns the number of bytes read, less than `count` only at the end of the file; -1: see errno.
ssize_t read_some(int descriptor, void* bytes, std::size_t count, std::uint64_t offset);
/// Returns whether all bytes were read; false: see errno, ENODATA if the file is too short.
bool read_at(int descriptor, void* bytes, std::size_t count, std::uint64_t offset);

/// An open plain file.
class PlainFile {
 public:
  PlainFile() = default;
  /// Opens a file. Errors: InputError if it is absent, no plain file, not readable or larger than the limit; DiskError.
  explicit PlainFile(const std::filesystem::path& file);
  ~PlainFile();
  PlainFile(PlainFile&& other) noexcept;
  PlainFile& operator=(PlainFile&& other) noexcept;

  int descriptor() const { return descriptor_; }
  const std::filesystem::path& name() const { return name_; }
  /// State of the file when it was opened.
  const FileState& state() const { return state_; }
  std::uint64_t size() const { return static_cast<std::uint64_t>(state_.size); }
  /// Reads `count` bytes at `offset`. Errors: DiskError, also if the file is too short.
  void read(void* bytes, std::size_t count, std::uint64_t offset) const;
  /// Returns the first bytes, fewer if the file is shorter. Errors: DiskError.
  std::string beginning(std::size_t bytes) const;
  /// Errors: InputError if the file is longer than any text that a person or a controller writes.
  void check_is_text() const;
  /// Returns the whole text. Errors: those of check_is_text(), DiskError.
  std::string text() const;

 private:
  std::filesystem::path name_;
  int descriptor_ = -1;
  FileState state_;
};

/// Returns a file's path relative to a folder, so that both can be moved together. Both arguments may be relative to the current
/// folder. Errors: std::filesystem::filesystem_error.
std::filesystem::path as_seen_from(const std::filesystem::path& folder, const std::filesystem::path& file);

/// Returns the file that as_seen_from() names in a folder; relative to the current folder if the folder's name is relative. Errors:
/// std::filesystem::filesystem_error.
std::filesystem::path seen_file(const std::filesystem::path& folder, const std::filesystem::path& seen);

/// Returns the whole text of a file. Errors: those of PlainFile.
std::string read_text(const std::filesystem::path& file);

/// Returns the first bytes of a plain file; empty if the file is absent. Errors: DiskError.
std::string beginning_of(const std::filesystem::path& file, std::size_t bytes);

}  // namespace dresslife::pipeline
