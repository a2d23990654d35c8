#include "pipeline/base/whole_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <utility>
#include <vector>

#include "pipeline/base/errors.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

constexpr mode_t readable_by_all = 0644;
constexpr std::size_t block_bytes = 1 << 16;  // larger ones cost short files more to clear than to read

fs::path folder_of(const fs::path& file) {
  const fs::path folder = file.parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

/// Whether `name` is "FINAL.PROCESS-NUMBER.part".
bool is_part_of(const std::string& name, const std::string& final_name) {
  constexpr std::string_view end = ".part";
  if (name.size() <= final_name.size() + 1 + end.size() || !name.starts_with(final_name + ".") ||
      !name.ends_with(end))
    return false;
  const std::string middle =
      name.substr(final_name.size() + 1, name.size() - final_name.size() - 1 - end.size());
  const std::size_t dash = middle.find('-');
  return dash != std::string::npos && dash > 0 && dash + 1 < middle.size() &&
         middle.find_first_not_of("0123456789-") == std::string::npos &&
         middle.find('-', dash + 1) == std::string::npos;
}

/// Makes and locks a file under a name that nobody has. Nothing: errno tells why.
std::pair<int, fs::path> make_part(const fs::path& final_name) {
  constexpr int most_names = 1000;
  for (int number = 0; number < most_names; ++number) {
    fs::path part = final_name;
    part += "." + std::to_string(::getpid()) + "-" + std::to_string(number) + ".part";
    const int made =
        ::open(part.c_str(), O_CREAT | O_EXCL | O_NOFOLLOW | O_RDWR | O_CLOEXEC, readable_by_all);
    if (made < 0 && errno == EEXIST) continue;
    if (made < 0) return {-1, {}};
    // Somebody who tidies up may have taken it for left behind before it was locked.
    struct stat status {};
    if (::flock(made, LOCK_EX | LOCK_NB) == 0 && ::fstat(made, &status) == 0 && status.st_nlink == 1)
      return {made, part};
    ::close(made);
  }
  errno = EEXIST;
  return {-1, {}};
}

/// Names of this process's parts. A signal's handler takes no argument and may not allocate; a place is taken
/// by the last letter that is written to it, and a stage writes a file or two at a time.
constexpr std::size_t most_parts = 8, longest_name = 4096;
char parts[most_parts][longest_name];

void remember(const fs::path& part) {
  const std::string& name = part.native();
  for (auto& place : parts)
    if (place[0] == '\0' && name.size() < longest_name) {
      name.copy(place + 1, name.size() - 1, 1);
      place[name.size()] = '\0';
      place[0] = name[0];
      return;
    }
}

void forget(const fs::path& part) {
  for (auto& place : parts)
    if (part.native() == place) place[0] = '\0';
}

bool same_bytes(int one, const fs::path& path) {
  const int other = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (other < 0) return false;
  struct stat status {};
  const std::int64_t size = state_of(one).size;
  bool same = ::fstat(other, &status) == 0 && S_ISREG(status.st_mode) && status.st_size == size;
  std::vector<char> a(block_bytes), b(block_bytes);
  for (std::int64_t at = 0; same && at < size; at += block_bytes) {
    const auto count = static_cast<std::size_t>(std::min<std::int64_t>(block_bytes, size - at));
    const auto offset = static_cast<std::uint64_t>(at);
    same = read_at(one, a.data(), count, offset) && read_at(other, b.data(), count, offset) &&
           std::memcmp(a.data(), b.data(), count) == 0;
  }
  ::close(other);
  return same;
}

/// 0, or errno.
int sync_folder(const fs::path& folder) {
  const int opened = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (opened < 0) return errno == EACCES ? 0 : errno;  // one may write into a folder that one may not read
  const int error = ::fsync(opened) == 0 || errno == EINVAL ? 0 : errno;  // some file systems sync no folders
  ::close(opened);
  return error;
}

FileState state_from(const struct stat& status) {
  const auto nanoseconds = [](const timespec& time) { return time.tv_sec * 1'000'000'000LL + time.tv_nsec; };
  return {status.st_size, nanoseconds(status.st_mtim), nanoseconds(status.st_ctim), status.st_ino};
}

}  // namespace

WholeFile::WholeFile(fs::path final_name) : final_name_(std::move(final_name)) {
  check_replaceable(final_name_);
  remove_leftovers(final_name_);
  auto [descriptor, part] = make_part(final_name_);
  if (descriptor < 0) fail(errno);
  descriptor_ = descriptor;
  part_ = std::move(part);
  remember(part_);
}

WholeFile::~WholeFile() {
  if (!committed_) ::unlink(part_.c_str());
  forget(part_);
  ::close(descriptor_);  // with it goes the lock; what it could tell, commit() has asked for
}

void WholeFile::fail(int error) const {
  const std::string remedy = error == ENOSPC || error == EDQUOT || error == EFBIG
                                 ? "free space on the disk or choose another place"
                                 : "check the folder, its permissions and the disk";
  throw InputError({final_name_.string()}, fmt::format("cannot be written ({})", std::strerror(error)),
                   remedy);
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

void WholeFile::give_up() noexcept { given_up_ = true; }

void WholeFile::commit(Sync when) {
  check();
  if (same_bytes(descriptor_, final_name_)) return;  // the part goes with this object
  if (when == Sync::now && ::fsync(descriptor_) != 0) fail(errno);
  // Closing is the last moment at which a file system tells of a failed write; the lock stays on the other
  // one.
  const int other = ::dup(descriptor_);
  if (other < 0 || ::close(other) != 0) fail(errno);
  check_replaceable(final_name_);
  if (::rename(part_.c_str(), final_name_.c_str()) != 0) fail(errno);
  committed_ = true;
  if (when == Sync::never) return;
  if (const int error = sync_folder(folder_of(final_name_))) {
    ::unlink(final_name_.c_str());  // the name may not outlive a crash: better none
    fail(error);
  }
}

void write_text_if_changed(const fs::path& file, const std::string& text, Sync when) {
  const int known = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (known >= 0) {
    const FileState state = state_of(known);
    std::string held(text.size(), '\0');
    const bool same = state.size == static_cast<std::int64_t>(text.size()) &&
                      read_at(known, held.data(), held.size(), 0) && held == text;
    ::close(known);
    if (same) return;
  }
  if (!file.parent_path().empty()) fs::create_directories(file.parent_path());
  WholeFile whole(file);
  whole.write_at(text.data(), text.size(), 0);
  whole.commit(when);
}

void remove_parts_of_this_process() noexcept {
  for (const auto& place : parts)
    if (place[0] != '\0') ::unlink(place);
}

void remove_leftovers(const fs::path& final_name) {
  std::error_code failure;
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder_of(final_name), failure))
    if (is_part_of(entry.path().filename().string(), final_name.filename().string()))
      found.push_back(entry.path());
  for (const fs::path& part : found) {
    const int opened = ::open(part.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (opened < 0) continue;
    if (::flock(opened, LOCK_EX | LOCK_NB) == 0) ::unlink(part.c_str());
    ::close(opened);
  }
}

void check_replaceable(const fs::path& file) {
  std::error_code failure;
  const fs::file_status status = fs::symlink_status(file, failure);
  if (!fs::exists(status) || fs::is_regular_file(status)) return;
  const char* what = fs::is_directory(status) ? "is a folder"
                     : fs::is_symlink(status) ? "is a link to another file"
                                              : "is a device or a pipe";
  throw InputError({file.string()}, fmt::format("{} (a result only replaces a plain file)", what),
                   "name a file of its own");
}

FileState state_of(const fs::path& file) {
  struct stat status {};
  if (::lstat(file.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return {};
  return state_from(status);
}

FileState state_of(int descriptor) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) return {};
  return state_from(status);
}

bool read_at(int descriptor, void* bytes, std::size_t count, std::uint64_t offset) {
  char* to = static_cast<char*>(bytes);
  while (count > 0) {
    const ssize_t got = ::pread(descriptor, to, count, static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return false;
    if (got == 0) {
      std::memset(to, 0, count);
      return true;
    }
    to += got;
    count -= static_cast<std::size_t>(got);
    offset += static_cast<std::uint64_t>(got);
  }
  return true;
}

}  // namespace dresslife::pipeline
