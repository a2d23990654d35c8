// Cleanup when a signal, a time limit or a memory limit ends a program: it ends the programs that it has started, waits for them,
// and removes incomplete files. The cleanup uses only functions that are allowed in a signal handler.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>

namespace dresslife::pipeline {

/// While this object lives, the cleanup removes this file (or this folder, if it is empty then).
class RemovedAtTheEnd {
 public:
  explicit RemovedAtTheEnd(const std::filesystem::path& path);
  ~RemovedAtTheEnd();
  RemovedAtTheEnd(const RemovedAtTheEnd&) = delete;
  RemovedAtTheEnd& operator=(const RemovedAtTheEnd&) = delete;

 private:
  std::size_t place_;
};

/// While this object lives, the cleanup ends this child process (SIGTERM) and waits for it.
class EndedAtTheEnd {
 public:
  explicit EndedAtTheEnd(pid_t process);
  ~EndedAtTheEnd();
  EndedAtTheEnd(const EndedAtTheEnd&) = delete;
  EndedAtTheEnd& operator=(const EndedAtTheEnd&) = delete;

 private:
  std::size_t place_;
};

/// While this object lives, signals that would end the program wait. So a new file or process is registered before a signal acts.
class SignalsHeld {
 public:
  SignalsHeld();
  ~SignalsHeld();
  SignalsHeld(const SignalsHeld&) = delete;
  SignalsHeld& operator=(const SignalsHeld&) = delete;
};

/// Unblocks the signals in a child process before it becomes another program.
void release_signals();

/// Runs the whole cleanup. Only the first call has an effect.
void tidy_at_the_end() noexcept;

/// Installs the cleanup for the signals of Ctrl-C, of `kill` and of a closed terminal. A signal that was ignored before stays
/// ignored.
void end_tidily_at_signals();

/// The words end like those of every error of the machine (errors.h).
inline constexpr char out_of_memory_words[] =
    "error: out of memory; run fewer jobs at a time, ask for fewer segments or samples, or allow more, then run again\n";
/// Prints that memory has run out and ends the program with exit status 1. Allocates nothing.
[[noreturn]] void end_without_memory() noexcept;

}  // namespace dresslife::pipeline
