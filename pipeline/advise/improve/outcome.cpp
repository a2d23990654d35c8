#include "pipeline/advise/improve/outcome.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <stdexcept>

#include "pipeline/base/errors.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/readable.h"
#include "pipeline/base/statistics.h"
#include "pipeline/base/warning_words.h"
#include "pipeline/cable/believable.h"
#include "pipeline/files/check_names.h"
#include "pipeline/files/checks.h"
#include "pipeline/files/receipt.h"
#include "pipeline/settings/fields.h"
#include "pipeline/study/row_warnings.h"
#include "pipeline/study/row_words.h"

namespace dresslife::pipeline {
namespace {

constexpr double unasked = -1e3;  // value of a limit that is not set: far from violation, and finite for the models

enum Limit {
  bend,
  twist,
  too_short,
  too_long,
  pull,
  contact,
  stroke,
  believable,
  abrasion,
  wall,
  rating,
  jacket,
  corkscrew,
  kink,
  periodic,
  bracket
};
static_assert(bracket == bracket_limit && bend == bend_limit);

/// reached: value and limit as text.
void see(Outcome& outcome, Limit limit, double g, const std::string& reached = "") {
  if (!(g > outcome.beyond[limit])) return;  // NaN: not known
  outcome.beyond[limit] = g;
  outcome.reached[limit] = reached;
}

/// Returns "353 mm, at least 600 mm". scale: converts the values to the unit.
std::string at_least(double value, double limit, const char* unit, double scale = 1) {
  return fmt::format("{}{}, at least {}{}", readable(scale * value), unit, readable(scale * limit), unit);
}
std::string at_most(double value, double limit, const char* unit, double scale = 1) {
  return fmt::format("{}{}, at most {}{}", readable(scale * value), unit, readable(scale * limit), unit);
}

double log_ratio(double value, double limit) {
  return value > 0 ? std::clamp(std::log(value / limit), unasked, -unasked) : unasked;
}

/// A limit of a mode that the planner's hours do not include.
struct ModeLimit {
  const char* key;
  const char* mode;
  Limit limit;
  std::optional<double> AskedLimits::*least;
  const char* meaning = "least hours of motion until 1 of 10 has failed by it";
  double value(const UnvalidatedMode& of) const { return limit == kink ? of.margin : of.early_hours(); }
};
constexpr std::array<ModeLimit, 6> mode_limits{
    {{"abrasion_life_h", UnvalidatedMode::abrasion, abrasion, &AskedLimits::abrasion},
     {"wall_life_h", UnvalidatedMode::wall, wall, &AskedLimits::wall},
     {"rating_life_h", UnvalidatedMode::rating, rating, &AskedLimits::rating,
      "least hours of motion that makers' ratings cover in 9 of 10 samples"},
     {"jacket_life_h", UnvalidatedMode::jacket, jacket, &AskedLimits::jacket},
     {"corkscrew_life_h", UnvalidatedMode::corkscrew, corkscrew, &AskedLimits::corkscrew},
     {"kink_margin", UnvalidatedMode::kink, kink, &AskedLimits::kink,
      "least radius of a bend, over that at which a tube in the dresspack kinks"}}};

void see_modes(Outcome& outcome, const RankingRow& row, const AskedLimits& asked) {
  for (const ModeLimit& of : mode_limits)
    for (const UnvalidatedMode& mode : row.unvalidated)
      if (asked.*of.least && mode.mode == of.mode)
        see(outcome, of.limit, log_ratio(*(asked.*of.least), of.value(mode)),
            at_least(of.value(mode), *(asked.*of.least), of.limit == kink ? " times" : " h"));
}

/// Keeps the shortest life by each mode of each dresspack.
void see_lives(std::vector<ModeLife>& lives, const ModeLife& of) {
  if (ModeLife* const same = find_in(lives, &ModeLife::mode, of.mode))
    same->hours = std::min(same->hours, of.hours);
  else
    lives.push_back(of);
}

/// Adds the violation of the required slack, as a share of the length. The limit is also a share of the length, which gives the
/// length.
void see_slack(Outcome& outcome, const std::string& name, double slack, double limit) {
  constexpr double least_share = 0.02, most_share = 1.0 / 3;  // shares of a length that the checks require as slack
  if (name == check_name::too_short)
    see(outcome, too_short, least_share * (limit - slack) / limit, at_least(slack, limit, " mm of slack", 1e3));
  if (name == check_name::too_long)
    see(outcome, too_long, most_share * (slack - limit) / limit, at_most(slack, limit, " mm of slack", 1e3));
}

void see_check(Outcome& outcome, const CheckedValue& check, const AskedLimits& asked) {
  const auto& [name, value, limit] = check;
  if (std::find(check_name::all.begin(), check_name::all.end(), name) == check_name::all.end())
    throw std::logic_error(fmt::format("'{}' is a check that no search knows (check_names.h)", name));
  see_slack(outcome, name, value, limit);
  if (name == check_name::bend_radius) see(outcome, bend, log_ratio(limit, value), at_least(value, limit, " mm", 1e3));
  constexpr double degrees = 180 / std::numbers::pi;
  if (name == check_name::twist)
    see(outcome, twist, std::abs(value) / limit - 1, at_most(std::abs(value), limit, " deg", degrees));
  if (name == check_name::tension) see(outcome, pull, log_ratio(value, limit), at_most(value, limit, " N"));
  if (name == check_name::tension && asked.tension)
    see(outcome, pull, log_ratio(value, *asked.tension), at_most(value, *asked.tension, " N"));
  if (name == check_name::contact_force && asked.contact_force)
    see(outcome, contact, log_ratio(value, *asked.contact_force), at_most(value, *asked.contact_force, " N"));
  constexpr double at_its_end = 1e-9;  // a retraction at the end of its stroke does not hold the hose any more
  if (name == check_name::travel)
    see(outcome, stroke, value / limit - 1 + at_its_end, at_most(value, limit, " mm", 1e3));
}

}  // namespace

const std::vector<std::string>& outcome_limit_names() {
  static const std::vector<std::string> names{"bend radius", "twist",         "too short",           "too long",
                                              "tension",     "contact force", "retraction's stroke", "forces in cables",
                                              "abrasion",    "hose's wall",   "maker's rating",      "jacket wear",
                                              "corkscrew",   "kink",          "repeatability",       "bracket"};
  return names;
}

std::string passed_text(std::size_t limit, double beyond) {
  const auto percent = [](double share, const char* of = "") {
    return fmt::format("{} %{}", readable(100 * share, 2), of);
  };
  switch (static_cast<Limit>(limit)) {
    case too_short:
    case too_long:
      return percent(beyond, " of the length");
    case bracket:
      return percent(beyond, " of the diameter");
    case twist:
    case stroke:
      return percent(beyond);
    case pull:
    case contact:
    case believable:
    case periodic:
      return beyond < std::log(2.0) ? percent(std::expm1(beyond)) : readable(std::exp(beyond), 2) + " times the limit";
    case bend:
    case abrasion:
    case wall:
    case rating:
    case jacket:
    case corkscrew:
    case kink:
      return percent(-std::expm1(-beyond));
  }
  throw std::logic_error("a limit without a unit");
}

namespace {

const std::map<std::string, Limit>& limit_of_screened() {
  static const std::map<std::string, Limit> limit_of{{"bent too tightly", bend}, {"twisted too far", twist},
                                                     {"too short", too_short},   {"too long", too_long},
                                                     {"pulled too hard", pull},  {"bracket", bracket}};
  return limit_of;
}

}  // namespace

std::string passed_text(const std::string& screened, double beyond) {
  const auto found = limit_of_screened().find(screened);
  // (V5), inside the robot: a share of the diameter, as (V7).
  return passed_text(found == limit_of_screened().end() ? bracket : found->second, beyond);
}

std::vector<double> limits_of_short_run(const std::vector<std::string>& names, const std::vector<double>& beyond) {
  const std::map<std::string, Limit>& limit_of = limit_of_screened();
  std::vector<double> of(outcome_limits, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t k = 0; k < names.size(); ++k)
    if (const auto found = limit_of.find(names[k]); found != limit_of.end())
      of[found->second] = std::clamp(beyond[k], unasked, -unasked);
  return of;
}

void add_bends(std::vector<std::vector<double>>& pieces, const std::vector<double>& bends) {
  pieces.resize(std::max<std::size_t>(pieces.size(), bend + 1));
  pieces[bend].insert(pieces[bend].end(), bends.begin(), bends.end());
}

bool Outcome::feasible() const { return failure.empty() && violation() == 0; }

double Outcome::violation() const { return sum_above_zero(beyond); }

std::string Outcome::words() const {
  if (!failure.empty()) return failure;
  std::string text;
  for (std::size_t k = 0; k < beyond.size(); ++k)
    if (beyond[k] > 0)
      text += fmt::format("{}{} violated by {}{}", text.empty() ? "" : ", ", outcome_limit_names()[k],
                          passed_text(k, beyond[k]),
                          k < reached.size() && !reached[k].empty() ? " (" + reached[k] + ")" : "");
  return text;
}

Outcome outcome_of(const RankingRow& row, const std::filesystem::path& folder, const AskedLimits& asked) {
  Outcome outcome;
  outcome.beyond.assign(outcome_limits, unasked);
  outcome.reached.resize(outcome_limits);
  outcome.failure = row.failure;
  if (!row.done() && !is_refusal(row.failure))
    throw MachineFault({folder.string()}, "has no result (" + row.failure + ")", "correct that");
  if (!row.done()) return outcome;
  outcome.hours = row.headline_hours();
  outcome.robot_life = row.robot_life_hours;
  for (const UnvalidatedMode& mode : row.unvalidated)
    if (is_credible(mode) && !std::isnan(mode.early_hours()))
      see_lives(outcome.modes,
                {mode.dresspack.empty() ? mode.mode : mode.mode + " of " + mode.dresspack, mode.early_hours()});
  const double share = std::max(row.largest_force_share.value_or(0), row.clamp_moment_share.value_or(0));
  see(outcome, believable, log_ratio(share, believable_share));
  // Lives of a motion or of loose cables without a cycle are wrong: plans refuse them, too (spoils_plan()).
  for (const Warning& warning : warnings_of(row)) {
    if (warning.kind == WarningKind::periodic)
      see(outcome, periodic, log_ratio(warning.amount.value_or(1), 1), "remedy: " + parts_of(warning.words).remedy);
    if (warning.kind == WarningKind::other_values)
      outcome.exceeding = std::max(outcome.exceeding, warning.amount.value_or(0));
  }
  outcome.asked_exceeding = asked.other_values.value_or(0) / 100;
  see_modes(outcome, row, asked);
  constexpr std::size_t simulation = 0;
  const std::filesystem::path receipt = folder / files_of_stage(simulation).receipt;
  if (const std::optional<Receipt> made = read_receipt(receipt))
    for (const CheckedValue& check : checks_in(made->results)) see_check(outcome, check, asked);
  else
    throw MachineFault({receipt.string()}, "is damaged", "remove it");
  return outcome;
}

void check_evaluated(const AskedLimits& asked, const RankingRow& row) {
  for (const ModeLimit& of : mode_limits)
    if (asked.*of.least && row.done() && !row.unvalidated_mode(of.mode))
      throw InputError(
          asked.where, fmt::format("{} is a limit of '{}', which is not evaluated", of.key, of.mode),
          fmt::format("leave it out, or give the dresspack what it needs{}",
                      row.not_evaluated.empty() ? "" : " (all that is not evaluated: " + row.not_evaluated + ")"));
}

void describe(Fields& f, AskedLimits& limits) {
  f.place(limits.where);
  f.maybe_number("contact_force_N", limits.contact_force, above(0), "largest of the dresspack on robot and cell");
  f.maybe_number("tension_N", limits.tension, above(0), "largest of the hose, besides its maker's");
  for (const ModeLimit& of : mode_limits) f.maybe_number(of.key, limits.*of.least, above(0), of.meaning);
  f.maybe_number("other_values_percent", limits.other_values, {0, 100, true},
                 "largest share of dresspacks that may exceed a limit at other values of stiffness, slack or friction");
}

Outcome worst_of(const std::vector<Outcome>& jobs) {
  Outcome worst;
  worst.hours = std::numeric_limits<double>::infinity();
  worst.beyond.assign(outcome_limits, unasked);
  worst.reached.resize(outcome_limits);
  for (const Outcome& job : jobs) {
    if (worst.failure.empty()) worst.failure = job.failure;
    worst.hours = std::min(worst.hours, job.hours);
    worst.robot_life = std::min(worst.robot_life, job.robot_life);
    worst.exceeding = std::max(worst.exceeding, job.exceeding);
    worst.asked_exceeding = std::max(worst.asked_exceeding, job.asked_exceeding);
    for (const ModeLife& mode : job.modes) see_lives(worst.modes, mode);
    for (std::size_t k = 0; k < worst.beyond.size(); ++k)
      see(worst, static_cast<Limit>(k), job.beyond[k], k < job.reached.size() ? job.reached[k] : "");
  }
  return worst;
}

}  // namespace dresslife::pipeline
