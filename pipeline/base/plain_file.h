// Files that are read, and their state in the file system.
//
// Only plain files are read. A pipe may let its reader wait without end, a device may have no end: both are refused when
// they are opened. What the file system cannot say is an error of its own (DiskError): a disk that fails must not
// pass for a file that is absent, shorter or damaged.
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

/// When a file's bytes or its name were last changed, as the file system says. Equal states of one path
/// are the same bytes, provided that the first was taken when a tick of the file system's clock (1 .. 10 ms)
/// had passed since the change.
struct FileState {
  std::int64_t size = -1, modified_ns = 0, changed_ns = 0;
  std::uint64_t inode = 0;
  bool exists() const { return size >= 0; }
  bool operator==(const FileState&) const = default;
};
/// Of a plain file itself; anything else, a link too, does not exist. Errors: DiskError.
FileState state_of(const std::filesystem::path& file);
FileState state_of(int descriptor, const std::filesystem::path& name);  ///< name: for messages

enum class FileKind { absent, file, folder, link, other };
/// Behind links, so never a link. Absent, too: what may not be looked at. Errors: DiskError.
FileKind kind_of(const std::filesystem::path& path);
/// Of the name itself. Errors: DiskError.
FileKind kind_of_name(const std::filesystem::path& path);
/// Device and inode behind links; nothing where kind_of() is absent. Errors: DiskError.
std::optional<std::pair<dev_t, ino_t>> inode_of(const std::filesystem::path& path);

/// What is in a folder, sorted; nothing where it is absent or may not be read. Errors: DiskError.
std::vector<std::filesystem::path> entries_of(const std::filesystem::path& folder);
/// Files in a folder and in the folders below it, sorted; links lead to files, but into no folder. Errors: DiskError.
std::vector<std::filesystem::path> files_below(const std::filesystem::path& folder);

/// Bytes of a block that is read at once. Larger blocks cost short files more to clear than to read.
constexpr std::size_t read_block_bytes = 1 << 16;

/// Bytes that were read, fewer than asked for at the end of the file alone; -1: errno says why.
ssize_t read_some(int descriptor, void* bytes, std::size_t count, std::uint64_t offset);
/// All of them or false: errno says why, ENODATA that the file ended before.
bool read_at(int descriptor, void* bytes, std::size_t count, std::uint64_t offset);

/// A plain file that is open.
class PlainFile {
 public:
  PlainFile() = default;
  /// Errors: InputError when it is not there, no plain file, not to be read, or larger than any that is read;
  /// DiskError.
  explicit PlainFile(const std::filesystem::path& file);
  ~PlainFile();
  PlainFile(PlainFile&& other) noexcept;
  PlainFile& operator=(PlainFile&& other) noexcept;

  int descriptor() const { return descriptor_; }
  const std::filesystem::path& name() const { return name_; }
  /// As it was when it was opened.
  const FileState& state() const { return state_; }
  std::uint64_t size() const { return static_cast<std::uint64_t>(state_.size); }
  /// Errors: DiskError, also when the file ends before.
  void read(void* bytes, std::size_t count, std::uint64_t offset) const;
  /// The first bytes, fewer where the file is shorter. Errors: DiskError.
  std::string beginning(std::size_t bytes) const;
  /// Errors: InputError when it is longer than any text that a person or a controller writes.
  void check_is_text() const;
  /// All of it. Errors: as above, DiskError.
  std::string text() const;

 private:
  std::filesystem::path name_;
  int descriptor_ = -1;
  FileState state_;
};

/// A file's path as it leads there from a folder, so that both can be moved together; both may be given relative to
/// the current folder. Errors: std::filesystem::filesystem_error.
std::filesystem::path as_seen_from(const std::filesystem::path& folder, const std::filesystem::path& file);

/// The whole of a text file. Errors: those of PlainFile.
std::string read_text(const std::filesystem::path& file);

/// The first bytes of a plain file; empty where there is none. Errors: DiskError.
std::string beginning_of(const std::filesystem::path& file, std::size_t bytes);

}  // namespace dresslife::pipeline
