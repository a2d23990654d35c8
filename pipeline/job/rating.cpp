#include "pipeline/job/rating.h"

#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {

void describe(Fields& f, Rating& rating) {
  f.place(rating.where);
  f.group("rig", rating.rig, Need::required, "The test, with the keys of motion.rig.");
  f.number("cycles", rating.cycles, Need::required, between(1, 1e12),
           "The number of cycles that the maker states. For rolling_flex these are round trips, half the "
           "number of single strokes.");
  f.text("source", rating.source, Need::required, "The source: data sheet and page.");
}

}  // namespace dresslife::pipeline
