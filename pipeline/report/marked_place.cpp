#include "pipeline/report/marked_place.h"

#include <algorithm>
#include <vector>

#include "pipeline/files/motion_layout.h"

namespace dresslife::pipeline {

std::optional<MarkedPlace> marked_place(const FileReader& life) {
  const bool fails =
      life.has_attribute("failing_segment_from_tool") && life.number_attribute("failing_segment_from_tool") >= 1;
  const std::string of = fails ? "failing_" : "worst_";
  MarkedPlace place;
  place.from_tool = static_cast<int>(life.number_attribute(of + "segment_from_tool"));
  if (place.from_tool < 1) return {};
  if (life.has_attribute(of + "dresspack")) place.dresspack = life.text_attribute(of + "dresspack");
  place.time = life.number_attribute(of + "time");
  place.fails_first = fails;
  const std::vector<std::string> names = dresspack_names(life);
  const auto named = std::ranges::find(names, place.dresspack);
  const std::size_t dresspack = named == names.end() ? 0 : static_cast<std::size_t>(named - names.begin());
  const std::vector<std::size_t> of_segments = dresspack_of_segments(life);
  const auto end = std::ranges::upper_bound(of_segments, dresspack) - of_segments.begin();
  place.segment = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, end - place.from_tool));
  return place;
}

}  // namespace dresslife::pipeline
