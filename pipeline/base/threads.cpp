#include "pipeline/base/threads.h"

#include <algorithm>
#include <cassert>
#include <condition_variable>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <new>
#include <string_view>
#include <system_error>
#include <thread>
#include <vector>

#include "pipeline/base/errors.h"
#include "pipeline/base/text.h"

namespace dresslife::pipeline {

std::size_t thread_count() {
  const char* const wanted = std::getenv("DRESSLIFE_THREADS");
  if (!wanted) return std::max(1u, std::thread::hardware_concurrency());
  const std::string_view text = wanted;
  const auto count = whole_number_in<std::size_t>(text);
  constexpr std::size_t most = 1024;
  if (!count || *count < 1 || *count > most)
    throw InputError(Where{"DRESSLIFE_THREADS"}, fmt::format("is '{}' (must be a whole number, 1 .. {})", text, most),
                     "set it to the threads that each stage may use, or unset it");
  return *count;
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
  std::size_t started = std::min<std::size_t>(parts, 1);
  try {
    others.reserve(parts);
    for (; started < parts; ++started) others.emplace_back(guarded, started);
  } catch (const std::system_error&) {  // the system refuses a thread: this thread does the remaining parts
  } catch (const std::bad_alloc&) {
  }
  if (parts > 0) guarded(0);
  for (; started < parts; ++started) guarded(started);
  for (std::thread& other : others) other.join();
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

namespace {

/// State shared by the threads of in_order().
class Conveyor {
 public:
  using Work = std::function<void(std::size_t, std::size_t)>;

  Conveyor(std::size_t count, std::size_t ahead, const Work& work)
      : count_(count), ahead_(ahead), work_(work), done_(ahead, false), failed_(ahead) {}

  /// Works as one of the threads that do not call use().
  void run(std::size_t part) {
    std::unique_lock lock(mutex_);
    for (;;) {
      changed_.wait(lock, [&] { return stopped_ || next_ == count_ || has_room(); });
      if (stopped_ || next_ == count_) return;
      work_on_next(part, lock);
    }
  }

  /// Works and calls use() as the caller's thread, part 0.
  void run_and_use(const std::function<void(std::size_t)>& use) {
    std::unique_lock lock(mutex_);
    while (used_ < count_) {
      if (const std::size_t place = used_ % ahead_; done_[place]) {
        if (failed_[place]) std::rethrow_exception(failed_[place]);
        lock.unlock();
        use(used_);
        lock.lock();
        done_[place] = false;
        ++used_;
        changed_.notify_all();
      } else if (next_ < count_ && has_room()) {
        work_on_next(0, lock);
      } else {
        changed_.wait(lock);
      }
    }
  }

  void stop() {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    changed_.notify_all();
  }

 private:
  bool has_room() const { return next_ < used_ + ahead_; }

  void work_on_next(std::size_t part, std::unique_lock<std::mutex>& lock) {
    const std::size_t k = next_++;
    lock.unlock();
    std::exception_ptr failure;
    try {
      work_(part, k);
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    failed_[k % ahead_] = failure;
    done_[k % ahead_] = true;
    changed_.notify_all();
  }

  const std::size_t count_, ahead_;
  const Work& work_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t next_ = 0, used_ = 0;
  bool stopped_ = false;
  std::vector<bool> done_;
  std::vector<std::exception_ptr> failed_;
};

}  // namespace

void in_order(std::size_t threads, std::size_t count, std::size_t ahead, const Conveyor::Work& work,
              const std::function<void(std::size_t)>& use) {
  assert(threads > 0 && ahead > 0);
  Conveyor conveyor(count, ahead, work);
  in_parallel(std::min(threads, std::max<std::size_t>(count, 1)), [&](std::size_t part) {
    if (part > 0) return conveyor.run(part);
    try {
      conveyor.run_and_use(use);
    } catch (...) {
      conveyor.stop();
      throw;
    }
  });
}

}  // namespace dresslife::pipeline
