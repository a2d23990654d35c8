#include "pipeline/study/folder_lock.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <string>
#include <thread>

#include "pipeline/base/errors.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

/// The process that took the lock last; 0: not told.
long owner_of(int descriptor) {
  char text[32] = "";
  return ::pread(descriptor, text, sizeof text - 1, 0) > 0 ? std::strtol(text, nullptr, 10) : 0;
}

bool lives(long process) {
  return process <= 0 || ::kill(static_cast<pid_t>(process), 0) == 0 || errno != ESRCH;
}

[[noreturn]] void refuse(const fs::path& folder) {
  throw InputError({folder.string()}, fmt::format("cannot be written ({})", std::strerror(errno)),
                   "mend its permissions or the disk, or choose another folder with -o");
}

std::string run_of(long process) {
  return process > 0 ? fmt::format("another run (process {})", process)
                     : "a run of some of its jobs (--shard)";
}

void take(int descriptor, const fs::path& folder, int how) {
  constexpr std::chrono::milliseconds most{10'000}, pause{20};  // a killed process ends in milliseconds
  for (std::chrono::milliseconds waited{0}; ::flock(descriptor, how | LOCK_NB) != 0; waited += pause) {
    const long owner = owner_of(descriptor);
    if (lives(owner) || waited >= most)
      throw InputError({folder.string()}, "is in use by " + run_of(owner),
                       "wait for it, or choose another folder with -o");
    std::this_thread::sleep_for(pause);
  }
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder, Mode held) {
  fs::create_directories(folder);
  descriptor_ =
      ::open((folder / ".lock").c_str(), O_CREAT | O_RDWR | O_NOFOLLOW, 0644);  // passes to the stages
  if (descriptor_ < 0) refuse(folder);
  take(descriptor_, folder, held == Mode::alone ? LOCK_EX : LOCK_SH);
  // As long for every process: over an earlier one's there is room on a full disk, too, which `clean` would
  // empty.
  const std::string own = fmt::format("{:<20}\n", held == Mode::alone ? std::to_string(::getpid()) : "");
  if (::pwrite(descriptor_, own.data(), own.size(), 0) != static_cast<ssize_t>(own.size())) refuse(folder);
}

FolderLock::~FolderLock() { ::close(descriptor_); }

}  // namespace dresslife::pipeline
