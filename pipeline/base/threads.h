// Threads inside one program. Work is cut into parts by its own nature, never by the number of threads'
// timing: results are the same bytes for any number.
#pragma once

#include <cstddef>
#include <functional>
#include <future>
#include <system_error>

namespace dresslife::pipeline {

/// How many threads a stage may use: the environment variable DRESSLIFE_THREADS, which the study runner sets
/// to its cores shared among its jobs; without it all of the machine. Errors: InputError when it is no
/// number.
std::size_t thread_count();

/// Calls work(part) for every part below `parts` at the same time, the first on the caller's own thread, and
/// returns when all are done. Parts for which the system has no thread are done on the caller's own, one
/// after the other. An exception of a part is thrown here, of the lowest part that threw.
void in_parallel(std::size_t parts, const std::function<void(std::size_t)>& work);

/// Calls work(part, k) once for every k below `count`, on `threads` threads (part: which), and use(k) on the
/// caller's own for one k after the other, while the others work on. At most `ahead` of them are worked on or
/// wait to be used: their places are k % ahead. The caller's thread works, too, when there is nothing to use.
/// An exception is thrown here when its k comes up; nothing after it is used.
void in_order(std::size_t threads, std::size_t count, std::size_t ahead,
              const std::function<void(std::size_t part, std::size_t k)>& work,
              const std::function<void(std::size_t k)>& use);

/// Starts work beside the caller's, where a stage may use several threads; with one it is done when its
/// result is asked for.
template <class T>
std::future<T> beside(const std::function<T()>& work) {
  try {
    if (thread_count() > 1) return std::async(std::launch::async, work);
  } catch (const std::system_error&) {  // no more threads here
  }
  return std::async(std::launch::deferred, work);
}

}  // namespace dresslife::pipeline
