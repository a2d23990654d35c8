// Why a result is not of the settings of now: which keys, files or programs changed since it was made.
#pragma once

#include <string>
#include <vector>

#include "pipeline/study/build_graph.h"

namespace dresslife::pipeline {

struct Node;

/// The keys whose values differ between two documents, in the order of the first:
/// "routing.free_length_m 2.035 -> 2.1". Lists of one length are compared item by item
/// ("motion.steps[3].dwell_s 0 -> 2"), others by their lengths.
std::vector<std::string> changed_keys(const Node& was, const Node& now);

/// Says in `changed` of jobs with a last result what changed since, of the first 50: the settings in its
/// life.h5 are compared key by key with those of now, the files and programs of its receipts by their
/// digests.
void tell_changes(const Study& study, const StudyPlaces& places, std::vector<JobState>& states);

}  // namespace dresslife::pipeline
