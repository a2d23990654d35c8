// Visual checks of the dresspack in the plant: whether they find damage before a failure (fatigue/inspection.h).
#pragma once

namespace dresslife::pipeline {

class Fields;

struct Inspection {
  double interval_weeks = 2;          ///< 0: no checks
  double found_percent = 75;          ///< share of visible damage that one check finds
  double visible_depth_percent = 50;  ///< share of the wall or sleeve that must be worn for a check to see it
};

void describe(Fields& f, Inspection& inspection);

}  // namespace dresslife::pipeline
