// Threads of one program. The division of the work into parts does not depend on the number of threads or on timing, so the
// results have the same bytes for any number of threads.
#pragma once

#include <cstddef>
#include <functional>
#include <future>
#include <system_error>

namespace dresslife::pipeline {

/// Returns the number of threads that a stage may use: the environment variable DRESSLIFE_THREADS, which the study runner sets to
/// its cores divided among its jobs; without it, all processors of the machine. Errors: InputError if the variable is no number.
std::size_t thread_count();

/// Calls work(part) for every part below `parts` in parallel, the first on the caller's thread, and returns when all are done. If
/// the system refuses a thread, the caller's thread does the remaining parts one after the other. If parts throw, rethrows the
/// exception of the lowest part.
void in_parallel(std::size_t parts, const std::function<void(std::size_t)>& work);

/// Calls work(part, k) once for every k below `count` on `threads` threads; `part` is the number of the thread. Calls use(k) on
/// the caller's thread in the order of k, in parallel with later work. At most `ahead` items are in work or wait for use(): item
/// k is in slot k % ahead. The caller's thread also works if no item is ready to be used. An exception of work() is rethrown when
/// its k would be used; no later item is used.
void in_order(std::size_t threads, std::size_t count, std::size_t ahead,
              const std::function<void(std::size_t part, std::size_t k)>& work,
              const std::function<void(std::size_t k)>& use);

/// Starts work in another thread if a stage may use several threads. With one thread, the work is done when its result is
/// requested.
template <class T>
std::future<T> beside(const std::function<T()>& work) {
  try {
    if (thread_count() > 1) return std::async(std::launch::async, work);
  } catch (const std::system_error&) {  // the system refuses a thread
  }
  return std::async(std::launch::deferred, work);
}

}  // namespace dresslife::pipeline
