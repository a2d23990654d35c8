// A maker's rating of a cable: a number of cycles in a test rig.
#pragma once

#include <string>

#include "pipeline/job/rig.h"

namespace dresslife::pipeline {

class Fields;

struct Rating {
  Rig rig;
  double cycles = 0;   ///< of the rig; for rolling_flex: round trips
  std::string source;  ///< data sheet, page
  Where where;
};

void describe(Fields& f, Rating& rating);

}  // namespace dresslife::pipeline
