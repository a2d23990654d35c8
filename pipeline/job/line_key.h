// Keys as a line of a job and --set name them.
#pragma once

#include <string>

#include "pipeline/job/setup.h"

namespace dresslife::pipeline {

/// A key of one of its dresspacks ("routing.free_length_m", "dresspack.components.2.slack_percent"): itself, or in a job
/// with a list "dresspacks.1.routing.free_length_m".
inline std::string line_key(const Setup& setup, std::size_t dresspack, const std::string& key) {
  const bool list = setup.dresspacks.size() > 1 || !setup.dresspacks.front().name.empty();
  return list ? fmt::format("dresspacks.{}.{}", dresspack + 1, key) : key;
}

}  // namespace dresslife::pipeline
