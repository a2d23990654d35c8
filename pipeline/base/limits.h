// Limits of a program: time, memory and its parent process. Also its streams, which may be closed.
#pragma once

#include <cstdint>
#include <string>

namespace dresslife::pipeline {

/// Limits of each stage of a job.
struct StageLimits {
  std::uint64_t seconds = 0, megabytes = 0;  ///< 0: no limit
};

/// Opens standard input, output and error if they are closed: otherwise a file opened later would get their number, and messages
/// would be written into it. Standard output is written line by line, so no line of standard error is inside of one if both go to
/// one file. A write beyond the limit of file size fails and does not end the program. Signals that end the program run the
/// cleanup first (last_moment.h).
void settle_streams();

/// Ends this program when its parent ends, for any reason. The environment variable DRESSLIFE_PARENT is the parent's process id.
void end_with_parent();

/// After `seconds`, prints on standard error that the job took too long and ends the program with exit status 1. 0: no limit.
void limit_time(const std::string& program, std::uint64_t seconds);
/// Limits the memory beyond the amount in use at the call. More memory ends the program (out_of_memory.cpp). 0: no limit.
void limit_memory(std::uint64_t megabytes);
std::uint64_t installed_memory_mb();

/// Returns the text in a form that is safe to display. Control characters except line feeds and tabs become \x1b and the like, so
/// they have no effect on a terminal. Characters that change the writing direction become \u202e and the like.
std::string shown(const std::string& text);

/// Writes to standard error. Throws nothing if standard error is full or closed.
void write_stderr(const std::string& text);

}  // namespace dresslife::pipeline
