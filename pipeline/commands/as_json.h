// What commands print, as JSON for other programs (--json).
#pragma once

#include <string>

#include "pipeline/report/json.h"

namespace dresslife::pipeline {

struct Node;

/// A list with an object for each row of a CSV text of ours, by the titles of its columns. Cells of numbers are numbers,
/// empty cells null; "inf" is text, because JSON has no infinity. Names of jobs and digests are text always.
Json json_of_csv(const std::string& csv);

/// A YAML document: numbers, true and false as such, all else as text.
Json json_of(const Node& document);

/// Jobs and their states on standard output: a line each, or all as one list in JSON.
class JobList {
 public:
  explicit JobList(bool json) : json_(json) {}
  void add(const std::string& job, const std::string& state);
  /// Prints words below the lines, or the list instead.
  void end(const std::string& words) const;

 private:
  bool json_;
  std::vector<Json> jobs_;
};

}  // namespace dresslife::pipeline
