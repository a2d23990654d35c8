// Shards of a study: parts for parallel runs, for the case that one run cannot start all stages (an allocation of Slurm).
#pragma once

#include <string>

#include "pipeline/study/known_study.h"

namespace dresslife::pipeline {

/// Shard `index` of `count`; the first index is 1.
struct Shard {
  int index = 1, count = 1;
  /// Returns the name for its files: "2_of_8".
  std::string name() const;
};

/// Reads a shard from text such as "2/8". where: origin of the text, for the message. Errors: InputError for other text.
Shard shard_from(const std::string& text, const std::string& where);

/// Returns the number of shards with which every run starts at most `most_stages` stages, counting all jobs. 1 if the stages
/// that are not up to date fit into one run.
int shards_needed(const StudyState& standing, int most_stages);

/// Removes the jobs of other shards. Every job belongs to one shard, independent of finished jobs; jobs with the same
/// simulation belong to the same or neighbouring shards.
void keep_shard(StudyState& standing, const Shard& shard);

}  // namespace dresslife::pipeline
