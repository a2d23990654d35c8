#include "pipeline/advise/calibrate/doubtful_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/advise/calibrate/measured_bending.h"
#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/warning_words.h"

namespace dresslife::pipeline {
namespace {

constexpr double fewest_cycles = 100;     // a cable that fails earlier is overloaded, not worn
constexpr double fewest_hours = 1;        // rows of one hour are sometimes used as placeholders to predict a life
constexpr double likely_hours = 175'000;  // 20 years day and night
constexpr double most_specimens = 200;    // tests of cables have 1 to 20
constexpr double most_cycles_per_repeat = 10, fewest_cycles_per_repeat = 0.1;
constexpr double largest_unshared = 1;           // a factor of 10: such a row contains no information
constexpr double least_unshared = 0.005;         // 1 %: two tests never agree so well
constexpr double stiffest = 10, softest = 1e-5;  // [N m2]: 35 mm2 of glued copper; a lead of 1 mm
constexpr double least_noise = 1;                // [%]: scales and rulers have errors of 2 % and more
constexpr double tightest = 50, widest = 0.05;   // [1/m]: radii of 20 mm and of 20 m
constexpr std::size_t most_points = 300;         // a loop by hand has 20 to 100
constexpr std::size_t few_points = 4;            // more: the first branch has points at small bends
constexpr double from_straight = 0.5;            // of the largest bend: the first of three points lies below it
constexpr double straight = 0.02;                // of the largest bend: the error of a ruler
constexpr double largest_zero = 0.1;             // of the largest moment: twice the usual noise of 5 %
constexpr double largest_decrement = 2;          // a swing that ends after one turn

class Doubts {
 public:
  void of(const ObservedTest& test) {
    const Observation& row = test.observation;
    if (!row.service.empty()) return;  // the table was checked when it was read
    if (row.cycles)
      number(test, "cycles", *row.cycles, {fewest_cycles}, {{1e6, "millions or thousands of cycles", "millions"}});
    if (row.hours)
      number(test, "hours", *row.hours, {fewest_hours, likely_hours, ": 20 years day and night"},
             {{1e3, "years, or thousands of hours", "thousands of hours"},
              {1 / 60.0, "minutes, seconds or cycles", "minutes"}},
             {.also = *row.hours > likely_hours ? fmt::format(", or cycles: {:g}", *row.hours) : ""});
    number(test, "specimens", row.specimens, {0, most_specimens}, {},
           {"cycles in the wrong key", "the number of pieces that were tested"});
    number(test, "cycles_per_repeat", row.cycles_per_repeat, {fewest_cycles_per_repeat, most_cycles_per_repeat}, {},
           {"a number per minute or per hour", "cycles_per_repeat: 1, or 2 if single strokes are counted"});
    if (const double unshared = row.unshared_log10; row.is_life())
      number(test, "unshared_log10", unshared, {least_unshared, largest_unshared, ": 1 % .. a factor of 10"},
             {{std::log10(unshared) / unshared, "a factor instead of its logarithm", "a factor"}},
             {"a share instead of a logarithm", "unshared_log10: 0.1 for your own cable in a test that you know"});
    if (row.stiffness)
      number(test, "stiffness_Nm2", *row.stiffness, {softest, stiffest}, {{1e-6, "N mm2 instead of N m2", "N mm2"}},
             {"another unit", "stiffness_Nm2: the moment in N m times the bend radius in m"});
    if (!row.bending.empty()) table(test);
    if (!row.is_life())
      number(test, "noise_percent", row.noise_percent, {least_noise},
             {{100, "a share instead of per cent", "a share"}});
    if (const double bend = row.at_curvature; row.stiffness || row.decrement)
      number(test, "at_curvature_1_per_m", bend, {widest, tightest},
             {{1e3 / (bend * bend), "a radius in mm", "a radius in mm"}, {1e3, "1/mm instead of 1/m", "1/mm"}});
    if (row.decrement)
      number(test, "decrement", *row.decrement, {0, largest_decrement},
             {{std::log(*row.decrement) / *row.decrement,
               "per cent, or the ratio of two swings instead of its logarithm", "the ratio"}});
  }

  void of(const ObservedTest& test, const ObservedTest& earlier) {
    const Observation &row = test.observation, &other = earlier.observation;
    if (!same_test(test, earlier)) return;
    if (row.cycles == other.cycles && row.hours == other.hours && row.stiffness == other.stiffness &&
        row.decrement == other.decrement && row.bending == other.bending && row.at_curvature == other.at_curvature &&
        row.outcome == other.outcome && row.cycles_per_repeat == other.cycles_per_repeat &&
        row.service == other.service) {
      warn(test.where, fmt::format("the observation and the job of '{}' are those of '{}'", row.name, other.name),
           "a row that was copied",
           row.is_life() ? "one of the two rows; with specimens: 2 if two were tested" : "one of the two rows");
      return;
    }
    if (!row.is_life() || row.cycles.has_value() != other.cycles.has_value() ||
        row.cycles_per_repeat != other.cycles_per_repeat)
      return;
    const Observation& upper = row.outcome == ObservedEnd::broken_by ? row : other;
    const Observation& lower = &upper == &row ? other : row;
    if (upper.outcome == ObservedEnd::broken_by && bounds_below(lower.outcome) &&
        lower.outcome != ObservedEnd::rating && observed_life(lower) > observed_life(upper))
      warn(test.where,
           fmt::format("'{}' lived {}, and of the same test '{}' states that no specimen lived longer than {}",
                       lower.name, observed_text(lower), upper.name, observed_text(upper)),
           "exchanged outcomes", fmt::format("outcome: broken, or run_out, of '{}'", upper.name));
  }

  std::vector<Warning> warnings;

 private:
  /// Checks the largest bend of a measured curve, and its stiffness.
  void table(const ObservedTest& test) {
    const std::vector<BendingPoint> points = read_bending(test.observation.bending);
    const BendingPoint tight = *std::max_element(
        points.begin(), points.end(),
        [](const BendingPoint& a, const BendingPoint& b) { return std::abs(a.curvature) < std::abs(b.curvature); });
    number(test, "the number of points of the curve", double(points.size()), {0, most_points}, {},
           {"all readings of a testing machine, with which the result takes long",
            "means of neighbouring readings, 20 to 100 over the loop"});
    const BendingPoint& first = points.front();
    const double first_bend = std::abs(first.curvature / tight.curvature);
    double largest_moment = 0;
    for (const BendingPoint& point : points) largest_moment = std::max(largest_moment, std::abs(point.moment));
    if (points.size() > few_points)
      number(
          test, "the first curvature_1_per_m over the largest one", first_bend,
          {0, from_straight, ": a test begins with a straight cable"}, {},
          {"a sorted table, or one without its first branch", "all readings in the order of the test, from straight"});
    if (first_bend <= straight && largest_moment > 0)
      number(test, "the moment of the straight cable over the largest one", std::abs(first.moment) / largest_moment,
             {0, largest_zero}, {},
             {"a scale that was not set to zero, or a cable that is bent by itself",
              fmt::format("each moment_Nm less {:.3g}", first.moment)});
    const double curvature = std::abs(tight.curvature), stiffness = std::abs(tight.moment / tight.curvature);
    if (curvature > tightest || curvature < widest)
      number(test, "the largest curvature_1_per_m", curvature, {widest, tightest}, {},
             {curvature < widest ? "1/mm instead of 1/m, or exchanged columns" : "a radius in mm, or exchanged columns",
              "curvature_1_per_m: 1000 over the bend radius in mm"});
    else if (stiffness > 0)
      number(test, "the largest moment over its curvature, in N m2,", stiffness, {softest, stiffest}, {},
             {stiffness > stiffest ? "N mm instead of N m" : "another unit",
              stiffness > stiffest ? fmt::format("moment_Nm: {:g} instead of {:g}", 1e-3 * tight.moment, tight.moment)
                                   : "moment_Nm in N m"});
  }

  static std::string jobs_of(const ObservedTest& test) {
    return joined(mapped(test.variants, [](const ObservedTest::Variant& variant) { return to_yaml(variant.job); }), "");
  }
  static bool same_test(const ObservedTest& a, const ObservedTest& b) {
    return a.observation.criterion == b.observation.criterion && jobs_of(a) == jobs_of(b);
  }

  void number(const ObservedTest& test, const char* key, double value, const Limits& limits,
              std::initializer_list<OtherUnit> units, const Otherwise& otherwise = {}) const {
    warn.number(test.where, key, fmt::format(" of '{}'", test.observation.name), value, limits, units, otherwise);
  }

  const WarningsOfKind warn{warnings, WarningKind::calibration};
};

}  // namespace

std::vector<Warning> doubtful_rows(const std::vector<ObservedTest>& tests) {
  Doubts doubts;
  for (std::size_t t = 0; t < tests.size(); ++t) {
    doubts.of(tests[t]);
    for (std::size_t earlier = 0; earlier < t; ++earlier) doubts.of(tests[t], tests[earlier]);
  }
  return doubts.warnings;
}

}  // namespace dresslife::pipeline
