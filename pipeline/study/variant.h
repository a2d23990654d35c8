// A variant of a study's base: a name and the keys it sets.
#pragma once

#include <string>
#include <vector>

#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

struct Change {
  std::string path;  ///< path of the key, in the form of set_value()
  Node value;
  Where where;  ///< place in the user's file
};

struct Variant {
  std::string name;
  std::vector<Change> changes;
  std::vector<std::string> values;  ///< (varied) values of the varied keys, as in the name
};

inline constexpr std::size_t most_jobs = 100'000;  ///< largest number of jobs of a study

}  // namespace dresslife::pipeline
