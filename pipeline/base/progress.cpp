#include "pipeline/base/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "pipeline/base/limits.h"

namespace dresslife::pipeline {
std::string remaining_words(double seconds, double begun, double share) {
  const double done = share - begun;
  if (seconds < 2 || done < 0.01 || share >= 1) return "";
  const double left = seconds / done * (1 - share);
  if (left < 90) return fmt::format("{:.0f} s left", std::max(1.0, left));
  if (left < 5400) return fmt::format("{:.0f} min left", left / 60);
  return fmt::format("{:.1f} h left", left / 3600);
}

Progress::Progress(std::string label, bool quiet)
    : label_(std::move(label)), quiet_(quiet), terminal_(::isatty(STDERR_FILENO)) {
  log();  // the first minute begins with the first Progress object
}

Progress::Log& Progress::log() {
  static Log log;
  return log;
}

void Progress::set_log_interval(std::chrono::milliseconds interval) { log() = {interval, Clock::now() + interval}; }

Progress::~Progress() { clear(); }

void Progress::show(double share, const std::string& words) {
  const int permille = std::clamp(static_cast<int>(share * 1000), 0, 1000);
  if (permille == last_permille_ && words == last_words_) return;
  last_permille_ = permille;
  last_words_ = words;
  const Clock::time_point now = Clock::now();
  if (!first_ || share < last_share_) first_ = Mark{share, now};
  last_share_ = share;
  const std::string left =
      remaining_words(std::chrono::duration<double>(now - first_->time).count(), first_->share, share);
  draw(fmt::format("{:5.1f} %{}{}{}{}", permille / 10.0, left.empty() ? "" : ", ", left, words.empty() ? "" : "  ",
                   words));
}

void Progress::show(const std::string& words) { draw(words); }

void Progress::draw(const std::string& words) {
  if (quiet_) return;
  if (!terminal_) {
    if (Clock::now() < log().next_line) return;
    log().next_line = Clock::now() + log().interval;
    write_stderr(fmt::format("{}: {}\n", label_, words));
    return;
  }
  std::fputs(fmt::format("\r\033[K{}  {}", shown(label_), shown(words)).c_str(), stderr);
  std::fflush(stderr);
  drawn_ = true;
}

void Progress::note(const std::string& line) {
  if (quiet_) return;
  clear();
  write_stderr(line + "\n");
}

void Progress::clear() {
  if (!drawn_) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  drawn_ = false;
}

}  // namespace dresslife::pipeline
