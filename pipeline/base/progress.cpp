#include "pipeline/base/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "pipeline/base/limits.h"

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
  std::fputs(fmt::format("\r\033[K{}  {}", shown(label_), shown(words)).c_str(), stderr);
  std::fflush(stderr);
  drawn_ = true;
}

void Progress::note(const std::string& line) {
  if (quiet_) return;
  clear();
  tell(line + "\n");
}

void Progress::clear() {
  if (!drawn_) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  drawn_ = false;
}

}  // namespace dresslife::pipeline
