#include "pipeline/base/errors.h"

#include <cstring>

namespace dresslife::pipeline {

std::string Where::text() const {
  if (line <= 0) return file;
  if (column <= 0) return fmt::format("{}:{}", file, line);
  return fmt::format("{}:{}:{}", file, line, column);
}

InputError::InputError(const Where& where, const std::string& what, const std::string& remedy)
    : std::runtime_error(fmt::format("{}: error: {}{}{}", where.text(), what, remedy.empty() ? "" : "; ", remedy)) {}

MachineFault::MachineFault(const Where& where, const std::string& what, const std::string& remedy)
    : InputError(where, what, remedy + then_run_again) {}

bool is_refusal(std::string_view line) {
  return line.find(": error: ") != std::string_view::npos && !line.ends_with(then_run_again);
}

DiskError::DiskError(const std::string& file, int error)
    : std::runtime_error(fmt::format("{}: error: cannot be read ({}); check the disk and its permissions{}", file,
                                     std::strerror(error), then_run_again)) {}

}  // namespace dresslife::pipeline
