// The reasons why a result is stale: the keys, files or programs that changed after it was made.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/base/errors.h"
#include "pipeline/study/build_graph.h"

namespace dresslife::pipeline {

struct Node;

/// A file that a search needs changed while the search ran: lives before and after the change are not comparable.
class FilesChanged : public MachineFault {
 public:
  using MachineFault::MachineFault;
};

/// The robot programs, meshes and recorded poses of a search's jobs, as they were at the start of the search.
class FilesAtStart {
 public:
  explicit FilesAtStart(std::vector<std::shared_ptr<const Job>> jobs);
  /// Compares the files with their state at the start. Errors: FilesChanged with the name of a changed file; DiskError.
  void check() const;

 private:
  std::vector<std::shared_ptr<const Job>> jobs_;
  std::map<std::filesystem::path, std::pair<FileState, std::string>> files_;  ///< state, digest
};

/// Returns the keys whose values differ between two documents, in the order of the first document:
/// "routing.free_length_m 2.035 -> 2.1". Lists of equal length are compared item by item
/// ("motion.steps[3].dwell_s 0 -> 2"), other lists by their lengths.
std::vector<std::string> changed_keys(const Node& was, const Node& now);

/// Sets `changed` of the first 50 stale jobs: compares the settings in life.h5 with the present ones key by key, and
/// the files and programs of the receipts by their digests.
void report_changes(const Study& study, const StudyPlaces& places, std::vector<JobState>& states);

}  // namespace dresslife::pipeline
