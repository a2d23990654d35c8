// What observations teach of what is not known (uncertainty.h): each could have been one of several jobs, whose lives
// over the parameters come from few runs, at a centre and one step to either side along every axis that moves them.
//
// The centre is where nothing is known, then what is most likely after the round before, until that moves by less than a
// quarter of what is left to know; five rounds at most. Steps are one deviation of the prior, then twice what is left.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pipeline/job/calibration.h"
#include "pipeline/statistics/posterior.h"
#include "pipeline/study/observations.h"

namespace dresslife::pipeline {

/// A life or a number by its distribution: 10, 50, 90 %.
using Foretold = std::array<double, 3>;

/// What was learned of one parameter; nothing: no test hangs on it.
struct LearnedAxis {
  bool learned = false;
  Foretold before{}, after{};  ///< of its key
  double narrowed = 1;         ///< deviation of z after, over that before
};

struct LearnedTest {
  Observation observation;
  /// Over parameters and variants: of one specimen's life with its scatter, in the observer's unit; of a bending test the
  /// moment at its largest curvature, or the stiffness [N m], [N m2].
  Foretold before{}, after{};
  double measured = 0;  ///< the same as it was measured; 0 for a life
};

struct Learned {
  Posterior posterior;            ///< of the axes that were learned, in the order of uncertain_parameters()
  std::vector<LearnedAxis> axes;  ///< (parameter)
  std::vector<LearnedTest> tests;
  Calibration calibration;
  int rounds = 0;
  bool settled = false;  ///< the centre had ceased to move
  std::vector<std::string> notes;
};

/// Runs what is not up to date of a study. Returns its rows, in any order.
using MakeRows = std::function<std::vector<RankingRow>(const Study& study)>;

/// tests: of read_observed_tests(). sets: for every job. places: where make_rows leaves results. Errors: InputError at a row
/// whose job fails, or gives what is to be learned.
Learned learn(const std::vector<ObservedTest>& tests, const std::vector<std::string>& sets, const StudyPlaces& places,
              const MakeRows& make_rows);

/// For a terminal: parameters before and after, each row foretold before and after beside what was seen.
std::string learned_table(const Learned& learned);

}  // namespace dresslife::pipeline
