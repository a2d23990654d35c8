#include "pipeline/base/errors.h"

#include <cstring>

namespace dresslife::pipeline {

std::string Where::text() const {
  if (line <= 0) return file;
  if (column <= 0) return fmt::format("{}:{}", file, line);
  return fmt::format("{}:{}:{}", file, line, column);
}

InputError::InputError(const Where& where, const std::string& what, const std::string& remedy)
    : std::runtime_error(
          fmt::format("{}: error: {}{}{}", where.text(), what, remedy.empty() ? "" : "; ", remedy)) {}

DiskError::DiskError(const std::string& file, int error)
    : std::runtime_error(fmt::format("{}: error: cannot be read ({}); check the disk and its permissions", file,
                                     std::strerror(error))) {}

}  // namespace dresslife::pipeline
