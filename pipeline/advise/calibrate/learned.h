// Results of a calibration, as numbers and as text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "pipeline/advise/calibrate/learned_walls.h"
#include "pipeline/advise/calibrate/own_spread.h"
#include "pipeline/advise/calibrate/prediction.h"
#include "pipeline/advise/calibrate/service_fit.h"
#include "pipeline/job/calibration.h"

namespace dresslife::pipeline {

/// Result for one parameter; empty if no test depends on it.
struct LearnedAxis {
  bool learned = false;
  bool is_own = false;                 ///< each dresspack in service has its own value
  PredictedDeciles before{}, after{};  ///< deciles of the key's value
  double narrowed = 1;                 ///< ratio of the standard deviation of z after to that before
};

struct LearnedTest {
  Observation observation;
  PredictedDeciles before{}, after{};  ///< predictions over all variants; after: weighted by their likelihood
  PredictedDeciles by_others{};        ///< prediction over all variants, from the posterior of all other tests
  ServiceChance chance_before{}, chance_after{};  ///< for dresspacks in service
  ServiceFit fit{};                               ///< for dresspacks in service
  double measured = 0;                            ///< measured value; 0 for a life
  double misfit = 0, usual_misfit = 0;    ///< of a bending test after the calibration (prediction.h); 0 for a life
  std::string fails_first{}, moved_by{};  ///< from EmulatedTest
};

struct Learned {
  Posterior posterior;            ///< of the calibrated axes, in the order of uncertain_parameters()
  std::vector<LearnedAxis> axes;  ///< (parameter)
  std::vector<LearnedTest> tests;
  std::vector<LearnedWall> walls;
  std::optional<OwnSpread> own_spread;  ///< absent: not learned
  Calibration calibration;
  int rounds = 0;
  bool settled = false;  ///< the centre has converged
  std::vector<std::string> notes, warnings;
};

/// Returns the warning of a test whose records contradict the prediction after the calibration; absent: they do not.
std::optional<Warning> contradiction_of(const LearnedTest& test);

std::vector<LearnedAxis> learned_axes(const Posterior& posterior, const Axes& axes);

/// Returns the standard deviations between the prediction before any observation and the observation, if it lies on the wrong
/// side; 0 if they agree; infinite for a moment in the other direction.
double surprise(const LearnedTest& test);
/// Returns the same for the prediction from all other observations.
double surprise_by_others(const LearnedTest& test);

/// Returns the doubt of an observation that is more than `surprising` standard deviations from its prediction, without it or by the
/// others; empty: none.
std::string doubt_of(const LearnedTest& test, double surprising);
/// Returns the warning of a row that the model does not reproduce even after it learned from it: a bending test beyond usual_misfit,
/// a life beyond three standard deviations of its prediction (1 of 370); empty: it does.
std::string misfit_of(const LearnedTest& test);
/// Adds notes on the limits of the result.
void add_doubts(Learned& learned, const Axes& axes);

/// Returns the reason why a parameter was not learned.
std::string_view why_not_learned(const LearnedAxis& axis);

/// Returns "120 (4,100, 120,000)": the values by which 10 %, half and 90 % have failed.
std::string words_of(const PredictedDeciles& deciles);

/// Returns a table for the terminal: parameters before and after; observed and predicted values of each row.
std::string learned_table(const Learned& learned);

}  // namespace dresslife::pipeline
