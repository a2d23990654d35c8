#include "sim/program/exploration.h"

#include <algorithm>

namespace dresslife::sim {
namespace {

// Every reading takes other ways, so the first readings find nearly everything. Programs with some hundred branches need a
// hundred readings; a reading of a large backup takes some hundredths of a second.
constexpr int most_readings = 150;
constexpr long most_work = ImportLimits::executed;  // of all readings together: a second or two
constexpr int barren_in_a_row = 8;  // readings that met nothing new, before it is taken that there is nothing

}  // namespace

bool Exploration::next_reading() {
  if (readings_ > 0) barren_ = news_ == news_before_ ? barren_ + 1 : 0;
  news_before_ = news_;
  guessing_ = false;
  return ++readings_ <= most_readings && barren_ < barren_in_a_row && spent_ <= most_work;
}

int Exploration::choose(const std::string& place, int ways) {
  guessing_ = true;
  std::vector<int>& taken = taken_[place];
  taken.resize(std::max(taken.size(), static_cast<std::size_t>(ways)));
  // By lot once all were taken: in turns, two places that follow each other would always take the same of their ways together.
  auto way = std::find(taken.begin(), taken.begin() + ways, 0);
  if (way == taken.begin() + ways)
    way = taken.begin() + static_cast<std::ptrdiff_t>(lot_() % static_cast<unsigned long>(ways));
  else
    ++news_;
  ++*way;
  return static_cast<int>(way - taken.begin());
}

void Exploration::follow(const std::string& line) {
  if (followed_.insert(line).second) ++news_;
}

}  // namespace dresslife::sim
