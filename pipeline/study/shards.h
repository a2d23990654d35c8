// Shards of a study: parts for parallel runs, for the case that one run cannot start all stages (an allocation of Slurm).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "pipeline/study/study_state.h"
#include "pipeline/study/variant.h"

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

/// Returns the indices of the shard's variants, in increasing order. Every variant belongs to one shard, independent of finished
/// jobs. Variants that differ only in keys of `strain` and `fatigue` belong to the same or neighbouring shards, because they
/// have the same simulation.
std::vector<std::size_t> part_of(const std::vector<Variant>& variants, const Shard& shard);

/// Read and expand only the jobs of a shard. The rest is as in read_study() and expanded() of the whole study.
Study read_study(const std::filesystem::path& file, const std::vector<std::string>& sets, const Shard& shard);
StudyState expanded(const StudyRequest& request, const Shard& shard);

}  // namespace dresslife::pipeline
