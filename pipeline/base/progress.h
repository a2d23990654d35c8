// How far a piece of work is: a line on a terminal that is drawn again, elsewhere a line per minute, so that a log shows
// that the work goes on and how long it still takes. Quiet: nothing.
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

  /// share: of the work done, 0..1; the remaining time follows from what was done since the first call. A smaller share begins
  /// another piece of work.
  void show(double share, const std::string& words = "");
  void show(const std::string& words);  ///< of work whose share is not known
  void note(const std::string& line);   ///< a lasting line; also where there is no terminal, unless quiet
  void clear();
  /// Between two lines of a log, of all Progress of a program together: short pieces of work follow each other for long.
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

/// "3 min left", "2.5 h left"; empty while too little is done to tell (less than two seconds or a hundredth).
/// seconds: since `begun` of the work was done; share: that is done now.
std::string remaining_words(double seconds, double begun, double share);

}  // namespace dresslife::pipeline
