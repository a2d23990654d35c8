// A file that is whole or absent, however its writing ends.
//
// It is written under a name of its own, NAME.PROCESS-NUMBER.part in the folder of NAME, made exclusively and
// never through a link, and locked while its writer lives. commit() syncs it, lets the file system tell what
// it has kept back, gives it its final name in one step and syncs the folder. Of two writers of one name the
// later wins whole. What writers left that were killed is not locked: the next writer of that name removes
// it.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <string>

namespace dresslife::pipeline {

/// Whether a file's bytes reach the disk before its final name does. What every run compares and mends anyway
/// needs no sync, and ten thousand jobs have ten thousand such files.
enum class Sync { now, never };

class WholeFile {
 public:
  /// Errors: InputError when it cannot be made there.
  explicit WholeFile(std::filesystem::path final_name);
  /// Without commit() nothing stays behind.
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  /// For libraries that cannot be thrown through: the first failure is kept and later writes do nothing;
  /// commit() and check() throw it.
  void write_at(const void* bytes, std::size_t count, std::uint64_t offset) noexcept;
  void set_length(std::uint64_t bytes) noexcept;
  /// Later writes do nothing: the file is not wanted any more.
  void give_up() noexcept;
  /// Errors: InputError when a write has failed.
  void check() const;

  /// Makes it the final file; a final file of the same bytes stays untouched, with its time.
  /// Errors: InputError; nothing has been made then.
  void commit(Sync when = Sync::now);

  int descriptor() const { return descriptor_; }
  const std::filesystem::path& final_name() const { return final_name_; }

 private:
  [[noreturn]] void fail(int error) const;
  std::filesystem::path final_name_, part_;
  int descriptor_ = -1;
  int error_ = 0;  ///< errno of the first failure
  bool given_up_ = false, committed_ = false;
};

/// Writes a whole text file; leaves it untouched when it holds just that text.
/// Errors: InputError when the folder or the file cannot be written.
void write_text_if_changed(const std::filesystem::path& file, const std::string& text, Sync when = Sync::now);

/// Removes what killed writers of NAME left beside it.
void remove_leftovers(const std::filesystem::path& final_name);

/// Removes what this process has begun and not committed, for its last moment: a signal's handler may call
/// it.
void remove_parts_of_this_process() noexcept;

/// Refuses to replace what a result may not replace: a folder, a device, a pipe, a link.
/// Errors: InputError.
void check_replaceable(const std::filesystem::path& file);

/// When a file's bytes or its name were last changed, as the file system tells it. Equal states of one path
/// are the same bytes, provided that the first was taken when a tick of the file system's clock (1 .. 10 ms)
/// had passed since the change.
struct FileState {
  std::int64_t size = -1, modified_ns = 0, changed_ns = 0;
  std::uint64_t inode = 0;
  bool exists() const { return size >= 0; }
  bool operator==(const FileState&) const = default;
};
FileState state_of(const std::filesystem::path& file);
FileState state_of(int descriptor);

/// Fills `count` bytes from `offset`; zeros beyond the end. False: errno tells why.
bool read_at(int descriptor, void* bytes, std::size_t count, std::uint64_t offset);

}  // namespace dresslife::pipeline
