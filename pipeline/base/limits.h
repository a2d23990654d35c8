// What a program of ours holds itself to, and how it meets the world: streams that are closed, a parent that
// dies, time and memory that end.
#pragma once

#include <cstdint>
#include <string>

namespace dresslife::pipeline {

/// Each stage of a job may take so much.
struct StageLimits {
  std::uint64_t seconds = 0, megabytes = 0;  ///< 0: no limit
};

/// Opens standard input, output and error where they are closed: a file opened later would take its number, and
/// what is said would go into it. Lines of standard output leave whole, so that none of standard error lands
/// within one where both go into one file. A file that may not grow any more fails its write instead of
/// ending the program. Signals that end the program let it tidy up first (last_moment.h).
void settle_streams();

/// A program ends with the process that the environment variable DRESSLIFE_PARENT names as its parent,
/// however that ends.
void end_with_parent();

/// Says on standard error that this program's job took too long, and ends it with exit status 1. 0: no limit.
void limit_time(const std::string& program, std::uint64_t seconds);
/// Memory beyond what the program began with; more ends it (out_of_memory.cpp). 0: no limit.
void limit_memory(std::uint64_t megabytes);
std::uint64_t installed_memory_mb();

/// Text as it is shown: control characters but line feeds and tabs as \x1b, so that none acts on a terminal, and
/// those that turn the direction of writing as \u202e, so that text reads as it is.
std::string shown(const std::string& text);

/// Writes to standard error; nothing is thrown where it is full or gone.
void tell(const std::string& text);

}  // namespace dresslife::pipeline
