#include "pipeline/base/screen.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>

namespace dresslife::pipeline {

std::size_t screen_columns() {
  constexpr std::size_t least = 60, most = 120;
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) {
    struct winsize size {};
    if (::isatty(stream) && ::ioctl(stream, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
      return std::clamp<std::size_t>(size.ws_col, least, most);
  }
  return most;
}

}  // namespace dresslife::pipeline
