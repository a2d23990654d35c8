#include "pipeline/base/plain_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

namespace dresslife::pipeline {
namespace {

FileState state_from(const struct stat& status) {
  const auto nanoseconds = [](const timespec& time) { return time.tv_sec * 1'000'000'000LL + time.tv_nsec; };
  return {status.st_size, nanoseconds(status.st_mtim), nanoseconds(status.st_ctim), status.st_ino};
}

/// Returns whether the error means that the path leads to no file, or cannot be a path.
bool is_absence(int error) { return error == ENOENT || error == ENOTDIR || error == ENAMETOOLONG || error == ELOOP; }

[[noreturn]] void refuse_to_open(const std::filesystem::path& file, int error) {
  // ENXIO: a device is not connected.
  if (error == ENXIO) throw InputError({file.string()}, "is a device or a pipe, not a file", "save it as a file first");
  if (is_absence(error) || error == EACCES || error == EPERM)
    throw InputError({file.string()}, fmt::format("cannot be read ({})", std::strerror(error)), "check the path");
  throw DiskError(file.string(), error);
}

}  // namespace

FileState state_of(const std::filesystem::path& file) {
  struct stat status {};
  if (::lstat(file.c_str(), &status) != 0) {
    if (is_absence(errno)) return {};
    throw DiskError(file.string(), errno);
  }
  return S_ISREG(status.st_mode) ? state_from(status) : FileState{};
}

FileState state_of(int descriptor, const std::filesystem::path& name) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) throw DiskError(name.string(), errno);
  return S_ISREG(status.st_mode) ? state_from(status) : FileState{};
}

namespace {

/// Calls stat or lstat. Returns std::nullopt if the path is absent or not permitted.
std::optional<struct stat> status_of(const std::filesystem::path& path, int (*look)(const char*, struct stat*)) {
  struct stat status {};
  if (look(path.c_str(), &status) == 0) return status;
  if (is_absence(errno) || errno == EACCES) return std::nullopt;
  throw DiskError(path.string(), errno);
}

FileKind kind_from(const std::optional<struct stat>& status) {
  if (!status) return FileKind::absent;
  const mode_t mode = status->st_mode;
  return S_ISREG(mode)   ? FileKind::file
         : S_ISDIR(mode) ? FileKind::folder
         : S_ISLNK(mode) ? FileKind::link
                         : FileKind::other;
}

}  // namespace

FileKind kind_of(const std::filesystem::path& path) { return kind_from(status_of(path, ::stat)); }
FileKind kind_of_name(const std::filesystem::path& path) { return kind_from(status_of(path, ::lstat)); }

std::optional<std::pair<dev_t, ino_t>> inode_of(const std::filesystem::path& path) {
  const std::optional<struct stat> status = status_of(path, ::stat);
  return status ? std::optional(std::pair(status->st_dev, status->st_ino)) : std::nullopt;
}

std::vector<std::filesystem::path> entries_of(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> entries;
  std::error_code failure;
  for (std::filesystem::directory_iterator at(folder, failure), end; !failure && at != end; at.increment(failure))
    entries.push_back(at->path());
  if (failure && !is_absence(failure.value()) && failure.value() != EACCES)
    throw DiskError(folder.string(), failure.value());
  std::ranges::sort(entries);
  return entries;
}

std::vector<std::filesystem::path> files_below(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files, folders{folder};
  while (!folders.empty()) {
    const std::filesystem::path next = std::move(folders.back());
    folders.pop_back();
    for (const std::filesystem::path& entry : entries_of(next)) {
      if (kind_of_name(entry) == FileKind::folder) folders.push_back(entry);
      if (kind_of(entry) == FileKind::file) files.push_back(entry);
    }
  }
  std::ranges::sort(files);
  return files;
}

ssize_t read_some(int descriptor, void* bytes, std::size_t count, std::uint64_t offset) {
  std::size_t done = 0;
  while (done < count) {
    const ssize_t got =
        ::pread(descriptor, static_cast<char*>(bytes) + done, count - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return -1;
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  return static_cast<ssize_t>(done);
}

bool read_at(int descriptor, void* bytes, std::size_t count, std::uint64_t offset) {
  const ssize_t got = read_some(descriptor, bytes, count, offset);
  if (got >= 0 && static_cast<std::size_t>(got) < count) errno = ENODATA;
  return got == static_cast<ssize_t>(count);
}

PlainFile::PlainFile(const std::filesystem::path& file) : name_(file) {
  // Opening some devices already has an effect, so they are not opened.
  const bool may_be_opened = kind_of(file) != FileKind::other;
  if (may_be_opened) descriptor_ = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor_ < 0) refuse_to_open(file, may_be_opened ? errno : ENXIO);
  try {
    struct stat status {};
    if (::fstat(descriptor_, &status) != 0) throw DiskError(file.string(), errno);
    if (S_ISDIR(status.st_mode)) throw InputError({file.string()}, "is a folder, not a file", "name a file");
    if (!S_ISREG(status.st_mode))
      throw InputError({file.string()}, "is a device or a pipe, not a file", "save it as a file first");
    state_ = state_from(status);
    constexpr std::int64_t largest = std::int64_t{64} << 30;  // an hour of motion of 400 segments takes 14 GB
    if (state_.size > largest)
      throw InputError({file.string()}, fmt::format("has {} bytes (at most {} are read)", state_.size, largest),
                       "name a file that a robot's program or a run has made");
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

PlainFile::~PlainFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

PlainFile::PlainFile(PlainFile&& other) noexcept { *this = std::move(other); }

PlainFile& PlainFile::operator=(PlainFile&& other) noexcept {
  std::swap(name_, other.name_);
  std::swap(descriptor_, other.descriptor_);
  std::swap(state_, other.state_);
  return *this;
}

void PlainFile::read(void* bytes, std::size_t count, std::uint64_t offset) const {
  if (!read_at(descriptor_, bytes, count, offset)) throw DiskError(name_.string(), errno);
}

std::string PlainFile::beginning(std::size_t bytes) const {
  std::string begin(static_cast<std::size_t>(std::min<std::uint64_t>(bytes, size())), '\0');
  read(begin.data(), begin.size(), 0);
  return begin;
}

void PlainFile::check_is_text() const {
  constexpr std::uint64_t longest = 256 << 20;  // [bytes]; a day of recorded poses takes 100 MB
  if (size() > longest)
    throw InputError({name_.string()}, fmt::format("has {} bytes (at most {} are read)", size(), longest),
                     "split it, or leave out what is not needed");
}

std::string PlainFile::text() const {
  check_is_text();
  return beginning(static_cast<std::size_t>(size()));
}

std::filesystem::path as_seen_from(const std::filesystem::path& folder, const std::filesystem::path& file) {
  // ".." is resolved in the folder behind all links.
  const std::filesystem::path here = std::filesystem::weakly_canonical(folder.empty() ? "." : folder);
  return std::filesystem::absolute(file).lexically_normal().lexically_relative(here);
}

std::filesystem::path seen_file(const std::filesystem::path& folder, const std::filesystem::path& seen) {
  const std::filesystem::path file = (std::filesystem::weakly_canonical(folder) / seen).lexically_normal();
  return folder.is_absolute() ? file : std::filesystem::proximate(file);
}

std::string read_text(const std::filesystem::path& file) { return PlainFile(file).text(); }

std::string beginning_of(const std::filesystem::path& file, std::size_t bytes) {
  return state_of(file).exists() ? PlainFile(file).beginning(bytes) : "";
}

}  // namespace dresslife::pipeline
