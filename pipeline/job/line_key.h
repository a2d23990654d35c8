// Names of keys in a line of a job and in --set.
#pragma once

#include <string>

#include "pipeline/job/setup.h"

namespace dresslife::pipeline {

/// Returns the name of a dresspack's key ("routing.free_length_m", "dresspack.components.2.slack_percent"): unchanged, or
/// "dresspacks.1.routing.free_length_m" for a job with a list of dresspacks.
inline std::string line_key(const Setup& setup, std::size_t dresspack, const std::string& key) {
  const bool list = setup.dresspacks.size() > 1 || !setup.dresspacks.front().name.empty();
  return list ? fmt::format("dresspacks.{}.{}", dresspack + 1, key) : key;
}

}  // namespace dresslife::pipeline
