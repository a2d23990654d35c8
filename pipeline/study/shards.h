// Shards of a study for parallel runs, if one run cannot start all stages, as in an allocation of Slurm.
#pragma once

#include <string>

#include "pipeline/study/known_study.h"

namespace dresslife::pipeline {

/// The shard `index` of `count`, 1 first.
struct Shard {
  int index = 1, count = 1;
  /// As a name of its files: "2_of_8".
  std::string name() const;
};

/// "2/8". Errors: InputError when it is none; where: origin of the text, for the message.
Shard shard_from(const std::string& text, const std::string& where);

/// Number of shards so that every run starts at most `most_stages`, counting all jobs. 1 if the stages that are not
/// up to date fit into one run.
int shards_needed(const StudyState& standing, int most_stages);

/// Removes the jobs of other shards. Every job is in one shard, independent of finished jobs; jobs with the same
/// simulation are in neighbouring places.
void keep_shard(StudyState& standing, const Shard& shard);

}  // namespace dresslife::pipeline
