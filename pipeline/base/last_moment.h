// What a program does in its last moment, when a signal, its time or its memory ends it: it ends the programs that
// it has started, waits for them, and removes files that are not whole. Only what a signal's handler may do is done.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>

namespace dresslife::pipeline {

/// While it lives, this file (or folder, when it is empty then) is removed in the program's last moment.
class RemovedAtTheEnd {
 public:
  explicit RemovedAtTheEnd(const std::filesystem::path& path);
  ~RemovedAtTheEnd();
  RemovedAtTheEnd(const RemovedAtTheEnd&) = delete;
  RemovedAtTheEnd& operator=(const RemovedAtTheEnd&) = delete;

 private:
  std::size_t place_;
};

/// While it lives, this child process is ended (SIGTERM) and waited for in the program's last moment.
class EndedAtTheEnd {
 public:
  explicit EndedAtTheEnd(pid_t process);
  ~EndedAtTheEnd();
  EndedAtTheEnd(const EndedAtTheEnd&) = delete;
  EndedAtTheEnd& operator=(const EndedAtTheEnd&) = delete;

 private:
  std::size_t place_;
};

/// While it lives, signals that would end the program wait: what is made is noted before one of them acts.
class SignalsHeld {
 public:
  SignalsHeld();
  ~SignalsHeld();
  SignalsHeld(const SignalsHeld&) = delete;
  SignalsHeld& operator=(const SignalsHeld&) = delete;
};

/// In a child that becomes another program: signals no longer wait.
void release_signals();

/// Does all of it, once.
void tidy_at_the_end() noexcept;

/// From now on the signals of Ctrl-C, of `kill` and of a closed terminal end the program in this way, if it did not
/// ignore them before.
void end_tidily_at_signals();

/// They end as those of every error of the machine (errors.h).
inline constexpr char out_of_memory_words[] =
    "error: out of memory; run fewer jobs at a time, ask for fewer segments or samples, or allow more, then run again\n";
/// Says that memory has run out and ends the program with exit status 1. Allocates nothing.
[[noreturn]] void end_without_memory() noexcept;

}  // namespace dresslife::pipeline
