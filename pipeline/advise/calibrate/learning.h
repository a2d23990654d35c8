// What observations teach of what is not known (uncertainty.h): each could have been one of several jobs,
// whose lives over the parameters come from few runs, at a centre and one step to either side along every
// axis that moves them.
//
// The centre is where nothing is known, then what is most likely after the round before, until that moves by
// less than a quarter of what is left to know; five rounds at most. Steps are one deviation of the prior,
// then twice what is left.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pipeline/advise/calibrate/learned.h"

namespace dresslife::pipeline {

/// Runs what is not up to date of a study. Returns its rows, in any order.
using MakeRows = std::function<std::vector<RankingRow>(const Study& study)>;

/// tests: of read_observed_tests(). sets: for every job. places: where make_rows leaves results. Errors:
/// InputError at a row whose job fails, or gives what is to be learned.
Learned learn(const std::vector<ObservedTest>& tests, const std::vector<std::string>& sets,
              const StudyPlaces& places, const MakeRows& make_rows);

}  // namespace dresslife::pipeline
