#include "sim/program/interpreter/exploration.h"

#include <algorithm>
#include <cstddef>

namespace dresslife::sim {
namespace {

// Every reading takes other ways, so the first readings find almost all questions. Programs with some hundred branches need
// a hundred readings; a reading of a large backup takes some hundredths of a second.
constexpr int most_readings = 150;
constexpr long most_work = ImportLimits::executed;  // work of all readings together: one or two seconds
constexpr int barren_in_a_row = 30;                 // readings in a row without anything new that end the search
constexpr std::size_t remembered_ways =
    12;  // largest number of ways that lead to something new only together (conditions of one state)

}  // namespace

bool Exploration::next_reading() {
  if (readings_ > 0) barren_ = news_ == news_before_ ? barren_ + 1 : 0;
  news_before_ = news_;
  guessing_ = false;
  if (news_ > news_printed_) report_ways();
  last_ways_.clear();
  taken_here_.clear();
  return ++readings_ <= most_readings && barren_ < barren_in_a_row && spent_ <= most_work;
}

int Exploration::choose(const std::string& place, int ways) {
  guessing_ = true;
  // Late readings: a branch keeps its way for a few visits, because inputs keep their values for a while.
  constexpr int late = 10, same_times = 10;
  auto& [before, times] = taken_here_.try_emplace(place, -1, 0).first->second;
  if (barren_ >= late && before >= 0 && before < ways && ++times < same_times) return before;
  std::vector<Way>& known = ways_[place];
  known.resize(std::max(known.size(), static_cast<std::size_t>(ways)));
  const auto begin = known.begin(), end = begin + ways;
  auto way = std::find_if(begin, end, [](const Way& w) { return !w.taken; });
  if (way != end)
    ++news_;
  else if (lot_() % 2 == 0)
    way = std::max_element(begin, end, [](const Way& a, const Way& b) { return a.led_to < b.led_to; });
  else
    way = begin + static_cast<std::ptrdiff_t>(lot_() % static_cast<unsigned long>(ways));
  way->taken = true;
  if (last_ways_.size() == remembered_ways) last_ways_.pop_front();
  last_ways_.emplace_back(&known, way - begin);
  if (news_ > news_printed_) report_ways();
  return before = static_cast<int>(way - begin);
}

/// Records that the last ways led to something new.
void Exploration::report_ways() {
  news_printed_ = news_;
  for (const auto& [known, way] : last_ways_) (*known)[static_cast<std::size_t>(way)].led_to = news_;
}

void Exploration::follow(const std::string& line) {
  if (followed_.insert(line).second) ++news_;
}

}  // namespace dresslife::sim
