#include "pipeline/threads.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <exception>
#include <string_view>
#include <thread>
#include <vector>

#include "pipeline/errors.h"

namespace dresslife::pipeline {

std::size_t thread_count() {
  const char* const wanted = std::getenv("DRESSLIFE_THREADS");
  if (!wanted) return std::max(1u, std::thread::hardware_concurrency());
  const std::string_view text = wanted;
  std::size_t count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  constexpr std::size_t most = 1024;
  if (error != std::errc{} || end != text.data() + text.size() || count < 1 || count > most)
    throw InputError(Where{"DRESSLIFE_THREADS"},
                     fmt::format("is '{}' (must be a whole number, 1 .. {})", text, most),
                     "set it to the threads that each stage may use, or unset it");
  return count;
}

void in_parallel(std::size_t parts, const std::function<void(std::size_t)>& work) {
  std::vector<std::exception_ptr> failures(parts);
  const auto guarded = [&](std::size_t part) {
    try {
      work(part);
    } catch (...) {
      failures[part] = std::current_exception();
    }
  };
  std::vector<std::thread> others;
  for (std::size_t part = 1; part < parts; ++part) others.emplace_back(guarded, part);
  if (parts > 0) guarded(0);
  for (std::thread& other : others) other.join();
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

}  // namespace dresslife::pipeline
