#include "pipeline/job/rating.h"

#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {

void describe(Fields& f, Rating& rating) {
  f.place(rating.where);
  f.group("rig", rating.rig, Need::required, "the test, as in motion.rig");
  f.number("cycles", rating.cycles, Need::required, between(1, 1e12),
           "that the maker names; of rolling_flex round trips: half of the single strokes");
  f.text("source", rating.source, Need::required, "where it stands: data sheet, page");
}

}  // namespace dresslife::pipeline
