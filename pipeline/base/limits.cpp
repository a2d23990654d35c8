#include "pipeline/base/limits.h"

#include <fcntl.h>
#include <fmt/format.h>
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
#include <string_view>

#include "pipeline/base/last_moment.h"

namespace dresslife::pipeline {
namespace {

/// Text that the handler of the alarm prints. It is static because a signal handler takes no arguments.
struct LastWords {
  char text[256];
  std::size_t length;
};
LastWords last_words;

extern "C" void time_is_over(int) {
  constexpr int input_is_wrong = 1;
  tidy_at_the_end();
  if (::write(STDERR_FILENO, last_words.text, last_words.length) < 0) ::_exit(input_is_wrong);
  ::_exit(input_is_wrong);
}

}  // namespace

void settle_streams() {
  for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream)
    if (::fcntl(stream, F_GETFD) < 0 && errno == EBADF)
      if (::open("/dev/null", stream == STDIN_FILENO ? O_RDONLY : O_WRONLY) < 0) ::_exit(3);
  std::signal(SIGXFSZ, SIG_IGN);
  end_tidily_at_signals();
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
}

void end_with_parent() {
  const char* const parent = std::getenv("DRESSLIFE_PARENT");
  if (!parent) return;
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);  // with SIGTERM the program can remove incomplete files
  if (::getppid() != std::strtol(parent, nullptr, 10)) ::_exit(1);  // the parent ended before prctl()
}

void limit_time(const std::string& program, std::uint64_t seconds) {
  if (seconds == 0) return;
  const std::string words = fmt::format(
      "{}: error: took longer than {} s (--job-time); look for an endless motion, or allow more\n", program, seconds);
  last_words.length = std::min(words.size(), sizeof last_words.text);
  std::memcpy(last_words.text, words.data(), last_words.length);
  std::signal(SIGALRM, time_is_over);
  ::alarm(static_cast<unsigned>(std::min<std::uint64_t>(seconds, 0x7fffffff)));
}

namespace {

/// The kernel ends a program whose stack cannot grow, so the stack grows before memory is limited. Writing the lowest byte is
/// enough: all pages above belong to the stack then, and unused pages take no memory.
[[gnu::noinline]] void grow_stack() {
  constexpr std::size_t bytes = 1 << 20;
  volatile char stack[bytes];
  stack[0] = 0;
  static_cast<void>(stack[0]);
}

void set_memory_limit(std::uint64_t megabytes) {
  // [MB] Addresses of 60 bits. No processor has longer ones, so a larger limit does not limit anything.
  constexpr std::uint64_t all_memory = std::uint64_t{1} << 40;
  if (megabytes == 0 || megabytes >= all_memory) return;
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
  grow_stack();
  set_memory_limit(megabytes);
}

std::uint64_t installed_memory_mb() {
  return static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) >>
         20;
}

namespace {

/// A character that hides the text around it or changes its direction: its bytes in UTF-8 and its code point. 0 bytes: the text
/// has no such character at this position.
struct InvisibleCharacter {
  std::size_t bytes;
  unsigned code;
};
InvisibleCharacter unseen_at(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t k) { return at + k < text.size() ? static_cast<unsigned char>(text[at + k]) : 0u; };
  const unsigned two = (byte(0) & 0x1f) << 6 | (byte(1) & 0x3f);
  const unsigned three = (byte(0) & 0x0f) << 12 | (byte(1) & 0x3f) << 6 | (byte(2) & 0x3f);
  // U+0080 .. U+009F act on some terminals. U+061C, U+200E .. U+200F, U+202A .. U+202E and U+2066 .. U+2069 change the writing
  // direction (UAX #9).
  if (byte(0) == 0xc2 && byte(1) < 0xa0 && byte(1) >= 0x80) return {2, two};
  if (byte(0) == 0xd8 && byte(1) == 0x9c) return {2, two};
  const bool turns = three == 0x200e || three == 0x200f || (three >= 0x202a && three <= 0x202e) ||
                     (three >= 0x2066 && three <= 0x2069);
  return byte(0) == 0xe2 && turns ? InvisibleCharacter{3, three} : InvisibleCharacter{0, 0};
}

}  // namespace

std::string shown(const std::string& text) {
  std::string made;
  made.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if (const InvisibleCharacter unseen = unseen_at(text, i); unseen.bytes > 0) {
      made += unseen.code < 0x100 ? fmt::format("\\x{:02x}", unseen.code) : fmt::format("\\u{:04x}", unseen.code);
      i += unseen.bytes - 1;
    } else if ((byte < 0x20 && byte != '\n' && byte != '\t') || byte == 0x7f) {
      made += fmt::format("\\x{:02x}", byte);
    } else {
      made += text[i];
    }
  }
  return made;
}

void write_stderr(const std::string& text) {
  const std::string words = shown(text);
  std::fwrite(words.data(), 1, words.size(), stderr);
  std::fflush(stderr);
}

}  // namespace dresslife::pipeline
