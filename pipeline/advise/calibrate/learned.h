// What observations taught, in numbers and in words.
#pragma once

#include <string>
#include <vector>

#include "pipeline/advise/calibrate/foretelling.h"
#include "pipeline/job/calibration.h"

namespace dresslife::pipeline {

/// What was learned of one parameter; nothing: no test depends on it.
struct LearnedAxis {
  bool learned = false;
  Foretold before{}, after{};  ///< of its key
  double narrowed = 1;         ///< deviation of z after, over that before
};

struct LearnedTest {
  Observation observation;
  Foretold before{}, after{};  ///< over all variants, over each as likely as it then is
  Foretold by_others{};        ///< over all variants, from the posterior of all tests but this one
  double measured = 0;         ///< the same as it was measured; 0 for a life
  std::string fails_first{};   ///< EmulatedTest
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

std::vector<LearnedAxis> learned_axes(const Posterior& posterior, const Axes& axes);

/// Notes of what a user should look at before what was learned is believed.
void add_doubts(Learned& learned, const Axes& axes);

/// "120 (4,100, 120,000)": 10 %, half, 90 % have failed.
std::string words_of(const Foretold& told);

/// For a terminal: parameters before and after, each row foretold before and after beside what was seen.
std::string learned_table(const Learned& learned);

}  // namespace dresslife::pipeline
