#include "pipeline/advise/improve/merit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/readable.h"
#include "pipeline/job/beyond_limit.h"

namespace dresslife::pipeline {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();
constexpr double alike = 1.1;  // smallest relevant ratio of two lives; reason: (M1)

/// Returns the life below which a mode gets worse (M1).
double least_life(const ModeLife& mode, const Outcome& outcome, const Outcome& as_it_is) {
  return std::min({outcome.robot_life, outcome.hours, life_by(as_it_is, mode.mode) / alike});
}

/// Returns the share of dresspacks that may exceed a limit at other values (M1).
double most_exceeding(const Outcome& outcome, const Outcome& as_it_is) {
  if (!as_it_is.failure.empty()) return outcome.asked_exceeding;
  return as_it_is.feasible() ? std::max(as_it_is.exceeding, outcome.asked_exceeding) : 1;
}

std::vector<ModeLife> earliest_first(std::vector<ModeLife> modes) {
  std::stable_sort(modes.begin(), modes.end(), [](const ModeLife& a, const ModeLife& b) { return a.hours < b.hours; });
  return modes;
}

}  // namespace

double life_by(const Outcome& outcome, const std::string& mode) {
  if (!outcome.failure.empty()) return endless;
  const ModeLife* const of = find_in(outcome.modes, &ModeLife::mode, mode);
  return of ? of->hours : endless;
}

std::vector<ModeLife> worse_modes(const Outcome& outcome, const Outcome& as_it_is) {
  return earliest_first(
      filtered(outcome.modes, [&](const ModeLife& mode) { return mode.hours < least_life(mode, outcome, as_it_is); }));
}

bool exceeds_more(const Outcome& outcome, const Outcome& as_it_is) {
  return std::round(100 * outcome.exceeding) > std::round(100 * most_exceeding(outcome, as_it_is));
}

ModeLife first_mode(const Outcome& outcome) {
  ModeLife first{"", endless};
  for (const ModeLife& mode : outcome.modes)
    if (mode.hours < std::min(first.hours, outcome.robot_life)) first = mode;
  return first;
}

Merit merit_of(const Outcome& outcome, const Outcome& as_it_is) {
  if (!outcome.failure.empty()) return {};
  const std::vector<ModeLife> worse = worse_modes(outcome, as_it_is);
  Merit merit;
  const bool gets_worse = !worse.empty() || exceeds_more(outcome, as_it_is);
  merit.kept = !outcome.feasible() ? Kept::run : gets_worse ? Kept::limits : Kept::modes;
  merit.counted_hours = std::min(outcome.hours, outcome.robot_life);
  if (!worse.empty()) merit.counted_hours = std::min(merit.counted_hours, worse.front().hours);
  merit.first_hours = std::min(outcome.robot_life, first_mode(outcome).hours);
  merit.margin = smallest_of(outcome.beyond, endless, std::negate<>());
  merit.hours = outcome.hours;
  return merit;
}

double search_value(const Outcome& outcome, const Outcome& as_it_is) {
  static constexpr double shortest = 1e-9, longest = 1e9;  // [h] limits that keep the models finite
  const auto log_life = [](double hours) { return std::log(std::clamp(hours, shortest, longest)); };
  double value = log_life(std::min(outcome.hours, outcome.robot_life));
  if (std::isfinite(outcome.robot_life) && outcome.hours >= outcome.robot_life) {
    // 0 .. 1 for a first mode after 1 h .. the robot's life: orders trials with equal life of the wires, and is small beside
    // other gains.
    const double first = std::max(1.0, std::min(outcome.robot_life, first_mode(outcome).hours));
    value += std::log(first) / std::max(1.0, std::log(outcome.robot_life));
  }
  for (const ModeLife& mode : worse_modes(outcome, as_it_is))
    value -= log_life(least_life(mode, outcome, as_it_is)) - log_life(std::max(1.0, mode.hours));
  if (exceeds_more(outcome, as_it_is))
    value -= std::log(outcome.exceeding / std::max(least_share_beyond, most_exceeding(outcome, as_it_is)));
  return value;
}

double first_failure(const Merit& merit) { return std::min(merit.counted_hours, merit.first_hours); }

bool fails_earlier(const Merit& one, const Merit& other) {
  return one.kept == Kept::limits && first_failure(one) * alike < first_failure(other);
}

bool clearly_better(const Merit& one, const Merit& other) {
  if (fails_earlier(one, other)) return false;
  if (one.kept != other.kept) return one.kept > other.kept;
  if (one.counted_hours > other.counted_hours * alike) return true;
  return one.counted_hours * alike >= other.counted_hours && one.first_hours > other.first_hours * alike;
}

std::string mode_words(const Outcome& outcome) {
  const auto matters = [&](const ModeLife& mode) { return mode.hours < outcome.robot_life; };
  const auto words = [](const ModeLife& mode) { return fmt::format("{} from {}", mode.mode, hours_text(mode.hours)); };
  return joined(mapped(filtered(earliest_first(outcome.modes), matters), words), ", ");
}

}  // namespace dresslife::pipeline
