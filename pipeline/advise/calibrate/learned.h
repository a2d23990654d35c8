// Results of a calibration, as numbers and as text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "pipeline/advise/calibrate/learned_walls.h"
#include "pipeline/advise/calibrate/prediction.h"
#include "pipeline/job/calibration.h"

namespace dresslife::pipeline {

/// Result of one parameter; empty: no test depends on it.
struct LearnedAxis {
  bool learned = false;
  bool is_own = false;  ///< each dresspack in service has its own
  PredictedDeciles before{}, after{};  ///< value of its key
  double narrowed = 1;         ///< standard deviation of z after over that before
};

struct LearnedTest {
  Observation observation;
  PredictedDeciles before{}, after{};  ///< over all variants; after: weighted by their likelihood
  PredictedDeciles by_others{};        ///< over all variants, from the posterior of all tests but this one
  ServiceChance chance_before{}, chance_after{};  ///< of dresspacks in service
  double measured = 0;         ///< measured value; 0 for a life
  std::string fails_first{}, moved_by{};  ///< EmulatedTest
};

struct Learned {
  Posterior posterior;            ///< of the calibrated axes, in the order of uncertain_parameters()
  std::vector<LearnedAxis> axes;  ///< (parameter)
  std::vector<LearnedTest> tests;
  std::vector<LearnedWall> walls;
  Calibration calibration;
  int rounds = 0;
  bool settled = false;  ///< the centre has converged
  std::vector<std::string> notes, warnings;
};

std::vector<LearnedAxis> learned_axes(const Posterior& posterior, const Axes& axes);

/// The standard deviations by which a prediction lies on the wrong side of what was observed; 0 if it agrees.
double surprise(const LearnedTest& test);

/// Notes on limits of the result.
void add_doubts(Learned& learned, const Axes& axes);

/// Why a parameter was not learned.
std::string_view why_not_learned(const LearnedAxis& axis);

/// "120 (4,100, 120,000)": 10 %, half, 90 % have failed.
std::string words_of(const PredictedDeciles& deciles);

/// Table for the terminal: parameters before and after; observed and predicted values of each row.
std::string learned_table(const Learned& learned);

}  // namespace dresslife::pipeline
