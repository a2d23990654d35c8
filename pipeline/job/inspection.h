// Visual checks of the dresspack in the plant: whether they see a failure before it comes (fatigue/inspection.h).
#pragma once

namespace dresslife::pipeline {

class Fields;

struct Inspection {
  double interval_weeks = 2;          ///< 0: no checks
  double found_percent = 75;          ///< of what is visible, by one check
  double visible_depth_percent = 50;  ///< share of the wall or sleeve that is worn away when a check can see it
};

void describe(Fields& f, Inspection& inspection);

}  // namespace dresslife::pipeline
