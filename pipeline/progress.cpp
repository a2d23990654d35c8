#include "pipeline/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace dresslife::pipeline {

Progress::Progress(std::string label, bool quiet)
    : label_(std::move(label)), quiet_(quiet), terminal_(::isatty(STDERR_FILENO)) {}

Progress::~Progress() { clear(); }

void Progress::show(double share) {
  const int permille = std::clamp(static_cast<int>(share * 1000), 0, 1000);
  if (permille == last_permille_) return;
  last_permille_ = permille;
  draw(fmt::format("{:5.1f} %", permille / 10.0));
}

void Progress::show(const std::string& words) { draw(words); }

void Progress::draw(const std::string& words) {
  if (quiet_ || !terminal_) return;
  fmt::print(stderr, "\r\033[K{}  {}", label_, words);
  std::fflush(stderr);
  drawn_ = true;
}

void Progress::note(const std::string& line) {
  if (quiet_) return;
  clear();
  fmt::print(stderr, "{}\n", line);
}

void Progress::clear() {
  if (!drawn_) return;
  fmt::print(stderr, "\r\033[K");
  std::fflush(stderr);
  drawn_ = false;
}

}  // namespace dresslife::pipeline
