// Shows the progress of a piece of work. On a terminal, one line is rewritten. Elsewhere a line is printed every minute, so that
// a log shows that the work continues and how long it takes. `quiet`: prints nothing.
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace dresslife::pipeline {

class Progress {
 public:
  using Clock = std::chrono::steady_clock;

  Progress(std::string label, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Shows the share of the work that is done, 0 .. 1. The remaining time is estimated from the progress since the first call. A
  /// smaller share than before starts another piece of work.
  void show(double share, const std::string& words = "");
  void show(const std::string& words);  ///< for work whose share is unknown
  void note(const std::string& line);   ///< prints a line that stays; also without a terminal, unless quiet
  void clear();
  /// Sets the time between two lines of a log. It is common to all Progress objects, because many short pieces of work may follow
  /// each other.
  static void set_log_interval(std::chrono::milliseconds interval);

 private:
  struct Mark {
    double share;
    Clock::time_point time;
  };
  void draw(const std::string& words);
  struct Log {
    std::chrono::milliseconds interval{std::chrono::minutes{1}};
    Clock::time_point next_line = Clock::now() + interval;
  };
  static Log& log();

  std::string label_;
  bool quiet_, terminal_;
  std::string last_words_;
  int last_permille_ = -1;
  double last_share_ = 0;
  bool drawn_ = false;
  std::optional<Mark> first_;
};

/// Returns "3 min left" or "2.5 h left"; empty if less than two seconds or one percent are done. seconds: time since the share
/// `begun` was done. share: the share that is done now.
std::string remaining_words(double seconds, double begun, double share);

}  // namespace dresslife::pipeline
