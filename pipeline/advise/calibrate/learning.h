// Calibration of the uncertain parameters (uncertainty.h) with observations. Each observation has one or several jobs.
// A life as a function of the parameters comes from one run at a centre (pipeline/life/life_response.h). A bending test is
// run at the centre and at one step to either side along every parameter that changes it.
//
// The first centre is that of the prior; the next centre is the most likely place after the previous round; at most five rounds.
// The centre has converged if no parameter moves by more than 0.7 standard deviations of the prior (within them lives are
// interpolated), and no parameter of a bending test by more than a quarter of the remaining standard deviation. Steps are one
// standard deviation of the prior in the first round, then two remaining standard deviations.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pipeline/advise/calibrate/learned.h"

namespace dresslife::pipeline {

/// Runs the stages of a study that are not up to date. Returns its rows, in any order.
using MakeRows = std::function<std::vector<RankingRow>(const Study& study)>;

/// Calibrates the parameters. tests: from read_observed_tests(). sets: `--set` for every job. places: folder of the results of
/// make_rows. Errors: InputError at a row whose job fails or sets a parameter of the calibration.
Learned learn(const std::vector<ObservedTest>& tests, const std::vector<std::string>& sets, const StudyPlaces& places,
              const MakeRows& make_rows);

}  // namespace dresslife::pipeline
