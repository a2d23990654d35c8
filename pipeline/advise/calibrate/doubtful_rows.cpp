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
    if (row.cycles && *row.cycles < fewest_cycles)
      add(test, "cycles", *row.cycles, fmt::format("{:g} or more", fewest_cycles), "millions or thousands of cycles",
          fmt::format("cycles: {:g} if that was millions", 1e6 * *row.cycles));
    if (row.hours && *row.hours < fewest_hours)
      add(test, "hours", *row.hours, fmt::format("{:g} or more", fewest_hours), "years, or thousands of hours",
          fmt::format("hours: {:g} if that was thousands of hours", 1e3 * *row.hours));
    if (row.hours && *row.hours > likely_hours)
      add(test, "hours", *row.hours, fmt::format("{:g} or less: 20 years day and night", likely_hours),
          "minutes, seconds or cycles",
          fmt::format("hours: {:.4g} if that was minutes, or cycles: {:g}", *row.hours / 60, *row.hours));
    if (row.specimens > most_specimens)
      add(test, "specimens", row.specimens, fmt::format("{:g} or less", most_specimens), "cycles in the wrong key",
          "the number of pieces that were tested");
    if (row.cycles_per_repeat > most_cycles_per_repeat || row.cycles_per_repeat < fewest_cycles_per_repeat)
      add(test, "cycles_per_repeat", row.cycles_per_repeat,
          fmt::format("{:g} .. {:g}", fewest_cycles_per_repeat, most_cycles_per_repeat),
          "a number per minute or per hour", "cycles_per_repeat: 1, or 2 if single strokes are counted");
    if (row.is_life() && row.unshared_log10 > largest_unshared)
      add(test, "unshared_log10", row.unshared_log10, fmt::format("{:g} or less: a factor of 10", largest_unshared),
          "a factor instead of its logarithm",
          fmt::format("unshared_log10: {:.2g} if that was a factor", std::log10(row.unshared_log10)));
    if (row.is_life() && row.unshared_log10 < least_unshared)
      add(test, "unshared_log10", row.unshared_log10, fmt::format("{:g} or more: 1 %", least_unshared),
          "a share instead of a logarithm", "unshared_log10: 0.1 for your own cable in a test that you know");
    if (row.stiffness && (*row.stiffness > stiffest || *row.stiffness < softest))
      add(test, "stiffness_Nm2", *row.stiffness, fmt::format("{:g} .. {:g}", softest, stiffest),
          *row.stiffness > stiffest ? "N mm2 instead of N m2" : "another unit",
          *row.stiffness > stiffest ? fmt::format("stiffness_Nm2: {:g} if that was N mm2", 1e-6 * *row.stiffness)
                                    : "stiffness_Nm2: the moment in N m times the bend radius in m");
    if (!row.bending.empty()) table(test);
    if (!row.is_life() && row.noise_percent < least_noise)
      add(test, "noise_percent", row.noise_percent, fmt::format("{:g} or more", least_noise),
          "a share instead of per cent",
          fmt::format("noise_percent: {:g} if that was a share", 100 * row.noise_percent));
    if (row.stiffness || row.decrement) curvature(test);
    if (row.decrement && *row.decrement > largest_decrement)
      add(test, "decrement", *row.decrement, fmt::format("{:g} or less", largest_decrement),
          "per cent, or the ratio of two swings instead of its logarithm",
          fmt::format("decrement: {:.3g} if that was the ratio", std::log(*row.decrement)));
  }

  void of(const ObservedTest& test, const ObservedTest& earlier) {
    const Observation &row = test.observation, &other = earlier.observation;
    if (!same_test(test, earlier)) return;
    if (row.cycles == other.cycles && row.hours == other.hours && row.stiffness == other.stiffness &&
        row.decrement == other.decrement && row.bending == other.bending && row.at_curvature == other.at_curvature &&
        row.outcome == other.outcome && row.cycles_per_repeat == other.cycles_per_repeat &&
        row.service == other.service) {
      warn(test, fmt::format("the observation and the job of '{}' are those of '{}'", row.name, other.name),
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
      warn(test,
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
    if (points.size() > most_points)
      add(test, "the number of points of the curve", double(points.size()), fmt::format("{} or less", most_points),
          "all readings of a testing machine, with which the result takes long",
          "means of neighbouring readings, 20 to 100 over the loop");
    const BendingPoint& first = points.front();
    const double first_bend = std::abs(first.curvature / tight.curvature);
    double largest_moment = 0;
    for (const BendingPoint& point : points) largest_moment = std::max(largest_moment, std::abs(point.moment));
    if (points.size() > few_points && first_bend > from_straight)
      add(test, "the first curvature_1_per_m over the largest one", first_bend,
          fmt::format("{:g} or less: a test begins with a straight cable", from_straight),
          "a sorted table, or one without its first branch", "all readings in the order of the test, from straight");
    if (first_bend <= straight && std::abs(first.moment) > largest_zero * largest_moment)
      add(test, "the moment of the straight cable over the largest one", std::abs(first.moment) / largest_moment,
          fmt::format("{:g} or less", largest_zero),
          "a scale that was not set to zero, or a cable that is bent by itself",
          fmt::format("each moment_Nm less {:.3g}", first.moment));
    const double curvature = std::abs(tight.curvature), stiffness = std::abs(tight.moment / tight.curvature);
    if (curvature > tightest || curvature < widest)
      add(test, "the largest curvature_1_per_m", curvature, fmt::format("{:g} .. {:g}", widest, tightest),
          curvature < widest ? "1/mm instead of 1/m, or exchanged columns" : "a radius in mm, or exchanged columns",
          "curvature_1_per_m: 1000 over the bend radius in mm");
    else if (stiffness > stiffest || (stiffness < softest && stiffness > 0))
      add(test, "the largest moment over its curvature, in N m2,", stiffness,
          fmt::format("{:g} .. {:g}", softest, stiffest), stiffness > stiffest ? "N mm instead of N m" : "another unit",
          stiffness > stiffest ? fmt::format("moment_Nm: {:g} instead of {:g}", 1e-3 * tight.moment, tight.moment)
                               : "moment_Nm in N m");
  }
  void curvature(const ObservedTest& test) {
    const double value = test.observation.at_curvature;
    if (value > tightest)
      add(test, "at_curvature_1_per_m", value, fmt::format("{:g} .. {:g}", widest, tightest), "a radius in mm",
          fmt::format("at_curvature_1_per_m: {:.3g} if that was a radius in mm", 1e3 / value));
    if (value < widest)
      add(test, "at_curvature_1_per_m", value, fmt::format("{:g} .. {:g}", widest, tightest), "1/mm instead of 1/m",
          fmt::format("at_curvature_1_per_m: {:g} if that was 1/mm", 1e3 * value));
  }

  static std::string jobs_of(const ObservedTest& test) {
    return joined(mapped(test.variants, [](const ObservedTest::Variant& variant) { return to_yaml(variant.job); }), "");
  }
  static bool same_test(const ObservedTest& a, const ObservedTest& b) {
    return a.observation.criterion == b.observation.criterion && jobs_of(a) == jobs_of(b);
  }

  void add(const ObservedTest& test, const char* key, double value, const std::string& limit, const std::string& cause,
           const std::string& remedy) {
    warn(test, fmt::format("{} of '{}' is {:.6g} (limit {})", key, test.observation.name, value, limit), cause, remedy);
  }
  void warn(const ObservedTest& test, const std::string& what, const std::string& cause, const std::string& remedy) {
    warnings.push_back(warning_of(WarningKind::calibration, test.where.text(), what, cause, remedy));
  }
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
