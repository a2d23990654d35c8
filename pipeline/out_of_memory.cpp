// In every program, not in tests: a failed allocation ends the program with one line and exit status 1, in our code
// and in libraries. HDF5, the YAML parser and the C library do not survive it, or report a damaged file.
//
// These functions replace those of the C library. They call those of a preloaded library.
#include <dlfcn.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdint>

#include "pipeline/base/last_moment.h"

// The sanitizers' allocators are their own, and report what fails.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
}

namespace {

/// More than any machine has. The caller has read a damaged number and reports it.
constexpr std::size_t absurd_bytes = std::size_t{1} << 46;

thread_local bool looking_up = false;  // dlsym() may allocate

template <class Function>
Function* next(std::atomic<Function*>& known, const char* name, Function* own) {
  if (Function* const found = known.load(std::memory_order_relaxed)) return found;
  if (looking_up) return own;
  looking_up = true;
  auto* found = reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
  looking_up = false;
  if (!found) found = own;
  known.store(found, std::memory_order_relaxed);
  return found;
}

void* checked(void* bytes, std::size_t count) {
  if (bytes == nullptr && count > 0 && count < absurd_bytes) dresslife::pipeline::end_without_memory();
  return bytes;
}

}  // namespace

extern "C" {

void* malloc(std::size_t count) {
  static std::atomic<void* (*)(std::size_t)> known;
  return checked(next(known, "malloc", __libc_malloc)(count), count);
}
void* calloc(std::size_t count, std::size_t each) {
  static std::atomic<void* (*)(std::size_t, std::size_t)> known;
  std::size_t bytes = 0;
  if (__builtin_mul_overflow(count, each, &bytes)) bytes = SIZE_MAX;
  return checked(next(known, "calloc", __libc_calloc)(count, each), bytes);
}
void* realloc(void* bytes, std::size_t count) {
  static std::atomic<void* (*)(void*, std::size_t)> known;
  return checked(next(known, "realloc", __libc_realloc)(bytes, count), count);
}
void* memalign(std::size_t alignment, std::size_t count) {
  static std::atomic<void* (*)(std::size_t, std::size_t)> known;
  return checked(next(known, "memalign", __libc_memalign)(alignment, count), count);
}
void* aligned_alloc(std::size_t alignment, std::size_t count) {
  static std::atomic<void* (*)(std::size_t, std::size_t)> known;
  return checked(next(known, "aligned_alloc", __libc_memalign)(alignment, count), count);
}
int posix_memalign(void** bytes, std::size_t alignment, std::size_t count) {
  static std::atomic<int (*)(void**, std::size_t, std::size_t)> known;
  const auto own = [](void** made, std::size_t aligned, std::size_t wanted) -> int {
    *made = __libc_memalign(aligned, wanted);
    return *made ? 0 : ENOMEM;
  };
  const int status = next<int(void**, std::size_t, std::size_t)>(known, "posix_memalign", own)(bytes, alignment, count);
  if (status == ENOMEM) checked(nullptr, count);
  return status;
}
}

#endif
