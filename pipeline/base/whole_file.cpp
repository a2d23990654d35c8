#include "pipeline/base/whole_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "pipeline/base/errors.h"
#include "pipeline/base/plain_file.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

constexpr mode_t readable_by_all = 0644;

fs::path folder_of(const fs::path& file) {
  const fs::path folder = file.parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

constexpr std::string_view part_begin = "dresslife-", part_end = ".part";

constexpr int most_parts = 1000;  // limit for one process in one folder
std::string part_name(int number) { return fmt::format("{}{}-{}{}", part_begin, ::getpid(), number, part_end); }

/// Creates and locks a file under a new name. Returns -1 on failure: see errno.
std::pair<int, fs::path> make_part(const fs::path& folder) {
  for (int number = 0; number < most_parts; ++number) {
    fs::path part = folder / part_name(number);
    const int made = ::open(part.c_str(), O_CREAT | O_EXCL | O_NOFOLLOW | O_RDWR | O_CLOEXEC, readable_by_all);
    if (made < 0 && errno == EEXIST) continue;
    if (made < 0) return {-1, {}};
    // Another program may have removed the file as a leftover before it was locked.
    const bool locked = take_lock(made, LOCK_EX) != LockState::held_by_another;
    struct stat status {};
    const bool known = ::fstat(made, &status) == 0;
    const int error = errno;
    if (locked && known && status.st_nlink == 1)
      return {made, std::move(part)};  // nothing throws before its registration
    ::close(made);
    if (!locked || known) continue;
    ::unlink(part.c_str());
    errno = error;
    return {-1, {}};
  }
  errno = EEXIST;
  return {-1, {}};
}

/// Returns whether a plain file of this name has the same bytes. Errors: DiskError.
bool same_bytes(const WholeFile& one, const fs::path& path) {
  const FileState there = state_of(path);
  const std::int64_t size = there.exists() ? state_of(one.descriptor(), one.final_name()).size : 0;
  if (!there.exists() || there.size != size) return false;
  const PlainFile other(path);
  std::vector<char> a(read_block_bytes), b(read_block_bytes);
  for (std::int64_t at = 0; at < size; at += read_block_bytes) {
    const auto count = static_cast<std::size_t>(std::min<std::int64_t>(read_block_bytes, size - at));
    const auto offset = static_cast<std::uint64_t>(at);
    if (!read_at(one.descriptor(), a.data(), count, offset)) throw DiskError(one.final_name().string(), errno);
    other.read(b.data(), count, offset);
    if (std::memcmp(a.data(), b.data(), count) != 0) return false;
  }
  return true;
}

/// Syncs a folder. Returns 0 or errno.
int sync_folder(const fs::path& folder) {
  const int opened = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (opened < 0) return errno == EACCES ? 0 : errno;                     // a folder may be writable but not readable
  const int error = ::fsync(opened) == 0 || errno == EINVAL ? 0 : errno;  // some file systems cannot sync folders
  ::close(opened);
  return error;
}

}  // namespace

bool is_part(std::string_view name) {
  if (!name.starts_with(part_begin) || !name.ends_with(part_end)) return false;
  const std::string_view middle = name.substr(part_begin.size(), name.size() - part_begin.size() - part_end.size());
  return !middle.empty() && middle.find_first_not_of("0123456789-") == std::string_view::npos &&
         std::ranges::count(middle, '-') == 1;
}

WholeFile::WholeFile(fs::path final_name) : final_name_(std::move(final_name)) {
  check_replaceable(final_name_);
  remove_leftovers(folder_of(final_name_));
  const SignalsHeld until_it_is_noted;
  auto [descriptor, part] = make_part(folder_of(final_name_));
  if (descriptor < 0) fail(errno);
  descriptor_ = descriptor;
  part_ = std::move(part);
  removed_at_the_end_.emplace(part_);
}

WholeFile::~WholeFile() {
  if (!committed_) ::unlink(part_.c_str());
  ::close(descriptor_);  // this releases the lock; commit() has already asked for delayed errors
}

void WholeFile::fail(int error) const {
  const std::string remedy = error == ENOSPC || error == EDQUOT || error == EFBIG
                                 ? "free space on the disk or choose another place"
                                 : "check the folder, its permissions and the disk";
  throw MachineFault({final_name_.string()}, fmt::format("cannot be written ({})", std::strerror(error)), remedy);
}

void WholeFile::check() const {
  if (error_ != 0) fail(error_);
}

void WholeFile::write_at(const void* bytes, std::size_t count, std::uint64_t offset) noexcept {
  const char* from = static_cast<const char*>(bytes);
  while (count > 0 && error_ == 0 && !given_up_) {
    const ssize_t written = ::pwrite(descriptor_, from, count, static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      error_ = written < 0 ? errno : EIO;
      return;
    }
    from += written;
    count -= static_cast<std::size_t>(written);
    offset += static_cast<std::uint64_t>(written);
  }
}

void WholeFile::set_length(std::uint64_t bytes) noexcept {
  if (error_ != 0 || given_up_) return;
  if (::ftruncate(descriptor_, static_cast<off_t>(bytes)) != 0) error_ = errno;
}

bool WholeFile::read_back(void* bytes, std::size_t count, std::uint64_t offset) noexcept {
  if (read_at(descriptor_, bytes, count, offset)) return true;
  if (error_ == 0) error_ = errno;
  return false;
}

void WholeFile::give_up() noexcept { given_up_ = true; }

void WholeFile::check_mark() const {
  std::string begin(ownership_bytes, '\0');
  const ssize_t got = read_some(descriptor_, begin.data(), begin.size(), 0);
  if (got < 0) fail(errno);
  begin.resize(static_cast<std::size_t>(got));
  if (!begin.empty() && !begins_as_ours(begin) && !lies_in_notes(final_name_))
    throw std::logic_error(final_name_.string() + " is written without a mark of ours (pipeline/base/ownership.h)");
}

void WholeFile::commit(Sync when) {
  check();
  check_mark();
  if (same_bytes(*this, final_name_)) return;  // the destructor removes the temporary file
  if (when == Sync::now && ::fsync(descriptor_) != 0) fail(errno);
  // A file system reports a failed write at the latest when a descriptor is closed. The lock stays on the other descriptor.
  const int other = ::dup(descriptor_);
  if (other < 0 || ::close(other) != 0) fail(errno);
  check_replaceable(final_name_);
  if (::rename(part_.c_str(), final_name_.c_str()) != 0) fail(errno);
  committed_ = true;
  removed_at_the_end_.reset();
  if (when == Sync::never) return;
  if (const int error = sync_folder(folder_of(final_name_))) {
    ::unlink(final_name_.c_str());  // the name might be lost in a crash, so the file is removed
    fail(error);
  }
}

void write_text_if_changed(const fs::path& file, const std::string& text, Sync when) {
  if (state_of(file).size == static_cast<std::int64_t>(text.size()) && PlainFile(file).text() == text) return;
  if (!file.parent_path().empty()) fs::create_directories(file.parent_path());
  WholeFile whole(file);
  whole.write_at(text.data(), text.size(), 0);
  whole.commit(when);
}

void copy_if_there(const fs::path& from, const fs::path& to) {
  if (!state_of(from).exists()) return;
  const PlainFile source(from);
  WholeFile copy(to);
  std::vector<char> block(read_block_bytes);
  for (std::uint64_t at = 0; at < source.size(); at += block.size()) {
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(block.size(), source.size() - at));
    source.read(block.data(), count, at);
    copy.write_at(block.data(), count, at);
  }
  copy.commit(Sync::never);
}

void give_second_name(const fs::path& file, const fs::path& name) {
  check_replaceable(name);
  // The new link has a temporary name first, so the old file is replaced in one step.
  const fs::path part = folder_of(name) / part_name(most_parts);
  const RemovedAtTheEnd removed(part);
  ::unlink(part.c_str());
  if (::link(file.c_str(), part.c_str()) != 0) return copy_if_there(file, name);
  const bool given = ::rename(part.c_str(), name.c_str()) == 0;
  const int error = errno;
  ::unlink(part.c_str());  // a rename between two links of one file keeps both names
  if (!given)
    throw MachineFault({name.string()}, fmt::format("cannot be written ({})", std::strerror(error)),
                       "check the folder and the disk");
}

void remove_leftovers(const fs::path& folder) {
  std::error_code failure;
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder, failure))
    if (is_part(entry.path().filename().native())) found.push_back(entry.path());
  for (const fs::path& part : found) {
    const int opened = ::open(part.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (opened < 0) continue;
    if (take_lock(opened, LOCK_EX) == LockState::taken) ::unlink(part.c_str());
    ::close(opened);
  }
}

LockState take_lock(int descriptor, int operation) {
  while (::flock(descriptor, operation | LOCK_NB) != 0) {
    if (errno == EWOULDBLOCK) return LockState::held_by_another;
    if (errno != EINTR) return LockState::not_known_here;
  }
  return LockState::taken;
}

}  // namespace dresslife::pipeline
