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
#include "pipeline/base/limits.h"
#include "pipeline/base/whole_file.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

constexpr const char* lock_name = ".lock";

constexpr std::size_t note_bytes = 21;  // a process number, blanks and a line feed

/// Returns the process that took the lock last; 0: not known. Errors: InputError when the lock is not a plain file.
long owner_of(int descriptor, const fs::path& file) {
  char text[note_bytes + 2] = "";
  const bool is_plain = state_of(descriptor, file).exists();
  const ssize_t got = is_plain ? read_some(descriptor, text, note_bytes + 1, 0) : 0;
  if (got < 0) throw DiskError(file.string(), errno);
  if (!is_plain || got > static_cast<ssize_t>(note_bytes) || text[std::strspn(text, "0123456789 \n")] != '\0')
    throw InputError({file.string()}, "is there already and is no lock of dresslife's",
                     "move it away, or choose another folder with -o");
  return std::strtol(text, nullptr, 10);
}

bool lives(long process) { return process <= 0 || ::kill(static_cast<pid_t>(process), 0) == 0 || errno != ESRCH; }

[[noreturn]] void refuse(const fs::path& folder) {
  throw InputError({folder.string()}, fmt::format("cannot be written ({})", std::strerror(errno)),
                   "correct its permissions or the disk, or choose another folder with -o");
}

std::string run_of(long process) {
  return process > 0 ? fmt::format("another run (process {})", process) : "a run of some of its jobs (--shard)";
}

void take(int descriptor, const fs::path& folder, int how) {
  constexpr std::chrono::milliseconds most{10'000}, pause{20};  // a killed process ends in milliseconds
  for (std::chrono::milliseconds waited{0};; waited += pause) {
    const LockState state = take_lock(descriptor, how);
    if (state == LockState::taken) return;
    if (state == LockState::not_known_here)
      return write_stderr(fmt::format(
          "note: {} lies on a file system without locks: let no two runs write there at a time\n", folder.string()));
    const long owner = owner_of(descriptor, folder / lock_name);
    if (lives(owner) || waited >= most)
      throw InputError({folder.string()}, "is in use by " + run_of(owner),
                       "wait for it, or choose another folder with -o");
    std::this_thread::sleep_for(pause);
  }
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder, Mode held) {
  fs::create_directories(folder);
  descriptor_ = ::open((folder / lock_name).c_str(), O_CREAT | O_RDWR | O_NOFOLLOW | O_NONBLOCK,
                       0644);  // the stages inherit the descriptor
  if (descriptor_ < 0) refuse(folder);
  owner_of(descriptor_, folder / lock_name);
  take(descriptor_, folder, held == Mode::alone ? LOCK_EX : LOCK_SH);
  // Every note has the same length, so that it overwrites an earlier note also on a full disk, where `clean` must run.
  const std::string own = fmt::format("{:<20}\n", held == Mode::alone ? std::to_string(::getpid()) : "");
  if (::pwrite(descriptor_, own.data(), own.size(), 0) != static_cast<ssize_t>(own.size())) refuse(folder);
  remove_leftovers(folder);
}

FolderLock::~FolderLock() { ::close(descriptor_); }

}  // namespace dresslife::pipeline
