// Threads inside one program. Work is cut into parts by its own nature, never by the number of threads'
// timing: results are the same bytes for any number.
#pragma once

#include <cstddef>
#include <functional>

namespace dresslife::pipeline {

/// How many threads a stage may use: the environment variable DRESSLIFE_THREADS, which the study runner sets
/// to its cores shared among its jobs; without it all of the machine. Errors: InputError when it is no
/// number.
std::size_t thread_count();

/// Calls work(part) for every part below `parts` at the same time, the first on the caller's own thread, and
/// returns when all are done. An exception of a part is thrown here, of the lowest part that threw.
void in_parallel(std::size_t parts, const std::function<void(std::size_t)>& work);

}  // namespace dresslife::pipeline
