// A study cut into shards, which runs beside each other make: where one run may not start all of its stages,
// as in an allocation of Slurm.
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

/// "2/8". Errors: InputError when it is none; `where` tells whose words these are.
Shard shard_from(const std::string& text, const std::string& where);

/// How many shards keep every run within so many stages: of all jobs, as shards do not shrink while they are
/// made. 1 where the stages that are not up to date fit.
int shards_needed(const Standing& standing, int most_stages);

/// Leaves of a study the shard's jobs. All shards together have every job once, whatever has been made
/// meanwhile, and jobs with the same simulation lie side by side.
void keep_shard(Standing& standing, const Shard& shard);

}  // namespace dresslife::pipeline
