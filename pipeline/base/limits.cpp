#include "pipeline/base/limits.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <new>

#include "pipeline/base/whole_file.h"

namespace dresslife::pipeline {
namespace {

/// What the handler of the alarm says: all it may touch. A signal handler has no arguments of its own.
struct LastWords {
  char text[256];
  std::size_t length;
};
LastWords last_words;

extern "C" void time_is_over(int) {
  constexpr int input_is_wrong = 1;
  remove_parts_of_this_process();
  if (::write(STDERR_FILENO, last_words.text, last_words.length) < 0) ::_exit(input_is_wrong);
  ::_exit(input_is_wrong);
}

}  // namespace

void settle_streams() {
  for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream)
    if (::fcntl(stream, F_GETFD) < 0 && errno == EBADF)
      if (::open("/dev/null", stream == STDIN_FILENO ? O_RDONLY : O_WRONLY) < 0) ::_exit(3);
  std::signal(SIGXFSZ, SIG_IGN);
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
}

void end_with_parent() {
  const char* const parent = std::getenv("DRESSLIFE_PARENT");
  if (!parent) return;
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != std::strtol(parent, nullptr, 10)) ::_exit(1);  // it died before that was said
}

void limit_time(const std::string& program, std::uint64_t seconds) {
  if (seconds == 0) return;
  const std::string words = fmt::format(
      "{}: error: took longer than {} s (--job-time); look for an endless motion, or allow more\n", program,
      seconds);
  last_words.length = std::min(words.size(), sizeof last_words.text);
  std::memcpy(last_words.text, words.data(), last_words.length);
  std::signal(SIGALRM, time_is_over);
  ::alarm(static_cast<unsigned>(std::min<std::uint64_t>(seconds, 0x7fffffff)));
}

namespace {

/// The kernel ends a program whose stack may not grow: it grows before memory is limited. The lowest byte is
/// enough, all between belongs to the stack with it; pages that are never used are never cleared.
[[gnu::noinline]] void grow_stack() {
  constexpr std::size_t bytes = 1 << 20;
  volatile char stack[bytes];
  stack[0] = 0;
  static_cast<void>(stack[0]);
}

void set_memory_limit(std::uint64_t megabytes) {
  if (megabytes == 0) return;
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const rlim_t most = pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) + (megabytes << 20);
  struct rlimit limit {};
  if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur <= most) return;
  limit.rlim_cur = most;
  ::setrlimit(RLIMIT_AS, &limit);
}

}  // namespace

void limit_memory(std::uint64_t megabytes) {
  constexpr std::uint64_t least = 24;  // [MB] the smallest stage takes more: better not begun
  grow_stack();
  set_memory_limit(megabytes);
  check_memory(least);
}

void check_memory(std::uint64_t megabytes) {
  const std::size_t bytes = megabytes << 20;
  void* const tried = ::mmap(nullptr, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (tried == MAP_FAILED) throw std::bad_alloc();
  ::munmap(tried, bytes);
}

std::uint64_t installed_memory_mb() {
  return static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
             static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) >>
         20;
}

std::string shown(const std::string& text) {
  std::string made;
  made.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    // U+0080 .. U+009F, in UTF-8 after 0xC2, act on some terminals, too.
    const bool second_control =
        byte == 0xC2 && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xA0;
    if (second_control)
      made += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[++i]));
    else if ((byte < 0x20 && byte != '\n' && byte != '\t') || byte == 0x7f)
      made += fmt::format("\\x{:02x}", byte);
    else
      made += text[i];
  }
  return made;
}

void tell(const std::string& text) {
  const std::string words = shown(text);
  std::fwrite(words.data(), 1, words.size(), stderr);
  std::fflush(stderr);
}

}  // namespace dresslife::pipeline
