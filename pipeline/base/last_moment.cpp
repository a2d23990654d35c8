#include "pipeline/base/last_moment.h"

#include <pthread.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <initializer_list>
#include <stdexcept>

namespace dresslife::pipeline {
namespace {

// The table is static because a signal handler takes no arguments, allocates nothing and waits for no lock. A program writes one
// or two files and starts one program at a time. dresslife-strain has up to 12 more files for each span between two clamps.
constexpr std::size_t most_places = 256, longest_name = 4096;
struct Place {
  std::atomic<bool> taken{false}, filled{false};
  char path[longest_name] = "";  ///< empty: the place is of a process
  pid_t process = 0;
};
Place places[most_places];
std::atomic<bool> tidied{false};
pid_t owner =
    0;  ///< id of the program; a child that has not become another program yet has another id and cleans up nothing

constexpr std::initializer_list<int> ending_signals{SIGINT, SIGTERM, SIGHUP};

std::size_t take_place() {
  for (std::size_t k = 0; k < most_places; ++k)
    if (bool no = false; places[k].taken.compare_exchange_strong(no, true)) return k;
  throw std::logic_error("more unfinished files and programs at a time than there are places for");
}

void give_back(std::size_t place) {
  places[place].filled = false;
  places[place].path[0] = '\0';
  places[place].taken = false;
}

extern "C" void end_tidily(int signal) {
  tidy_at_the_end();
  ::raise(signal);  // now with its default effect
}

sigset_t signals_that_end() {
  sigset_t set;
  ::sigemptyset(&set);
  for (const int signal : ending_signals) ::sigaddset(&set, signal);
  return set;
}

}  // namespace

RemovedAtTheEnd::RemovedAtTheEnd(const std::filesystem::path& path) : place_(take_place()) {
  const std::string& name = path.native();
  if (name.size() < longest_name) {
    std::memcpy(places[place_].path, name.c_str(), name.size() + 1);
    places[place_].filled = true;
  }
}
RemovedAtTheEnd::~RemovedAtTheEnd() { give_back(place_); }

EndedAtTheEnd::EndedAtTheEnd(pid_t process) : place_(take_place()) {
  places[place_].process = process;
  places[place_].filled = true;
}
EndedAtTheEnd::~EndedAtTheEnd() { give_back(place_); }

SignalsHeld::SignalsHeld() {
  const sigset_t set = signals_that_end();
  ::pthread_sigmask(SIG_BLOCK, &set, nullptr);
}
SignalsHeld::~SignalsHeld() { release_signals(); }

void release_signals() {
  const sigset_t set = signals_that_end();
  ::pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
}

void tidy_at_the_end() noexcept {
  if (tidied.exchange(true) || (owner != 0 && owner != ::getpid())) return;
  for (Place& place : places)
    if (place.filled && place.path[0] == '\0') ::kill(place.process, SIGTERM);
  for (Place& place : places)
    while (place.filled && place.path[0] == '\0' && ::waitpid(place.process, nullptr, 0) < 0 && errno == EINTR) {
    }
  for (Place& place : places)
    if (place.filled && place.path[0] != '\0') ::unlink(place.path);
  for (Place& place : places)
    if (place.filled && place.path[0] != '\0') ::rmdir(place.path);
}

void end_tidily_at_signals() {
  owner = ::getpid();
  for (const int signal : ending_signals) {
    struct sigaction action {};
    if (::sigaction(signal, nullptr, &action) != 0 || action.sa_handler == SIG_IGN) continue;
    action.sa_handler = end_tidily;
    action.sa_flags = static_cast<int>(SA_RESETHAND | SA_NODEFER);  // a second signal of this kind acts at once
    ::sigaction(signal, &action, nullptr);
  }
}

void end_without_memory() noexcept {
  static std::atomic<bool> said{false};
  while (said.exchange(true)) ::pause();  // another thread is already ending the program
  constexpr std::size_t words = sizeof out_of_memory_words - 1;
  char line[256];
  std::size_t length = ::strnlen(program_invocation_short_name, sizeof line - words - 2);
  const auto add = [&](const char* text, std::size_t count) {
    std::memcpy(line + length, text, count);
    length += count;
  };
  std::memcpy(line, program_invocation_short_name, length);
  add(": ", 2);
  add(out_of_memory_words, words);
  constexpr int failed = 1;
  tidy_at_the_end();
  if (::write(STDERR_FILENO, line, length) < 0) ::_exit(failed);
  ::_exit(failed);
}

}  // namespace dresslife::pipeline
