// What a maker promises of a cable: so many cycles in a test rig.
#pragma once

#include <string>

#include "pipeline/job/rig.h"

namespace dresslife::pipeline {

class Fields;

struct Rating {
  Rig rig;
  double cycles = 0;   ///< of the rig; rolling_flex: round trips
  std::string source;  ///< data sheet, page
  Where where;
};

void describe(Fields& f, Rating& rating);

}  // namespace dresslife::pipeline
