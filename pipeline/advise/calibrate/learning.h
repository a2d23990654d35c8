// Calibration of the uncertain parameters (uncertainty.h) with observations. Each observation has one or several jobs.
// A life as a function of the parameters comes from one run at a centre (pipeline/life/life_response.h). A bending test is
// run at the centre and one step to either side along every parameter that changes it.
//
// The first centre is the prior's, the next one the most likely place after the round before; five rounds at most. It has
// converged if no parameter moves by more than 0.7 standard deviations of the prior, within which lives are interpolated;
// a parameter of a bending test by no more than a quarter of the remaining standard deviation. Steps are one standard
// deviation of the prior, then two remaining ones.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pipeline/advise/calibrate/learned.h"

namespace dresslife::pipeline {

/// Runs what is not up to date of a study. Returns its rows, in any order.
using MakeRows = std::function<std::vector<RankingRow>(const Study& study)>;

/// tests: of read_observed_tests(). sets: for every job. places: of the results of make_rows. Errors: InputError at a
/// row whose job fails or sets a parameter of the calibration.
Learned learn(const std::vector<ObservedTest>& tests, const std::vector<std::string>& sets,
              const StudyPlaces& places, const MakeRows& make_rows);

}  // namespace dresslife::pipeline
