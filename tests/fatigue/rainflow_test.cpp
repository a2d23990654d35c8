// Cycle counting against published histories, an independent definition, and its invariances.
#include "fatigue/rainflow.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <sstream>

#include "pipeline/base/errors.h"
#include "tests/catch.h"
#include "tests/fatigue/four_point.h"

using namespace dresslife;
using namespace dresslife::fatigue;

namespace {

constexpr double two_sines_rounding = 1e-9;  // their published lists; pi i in double has an error of 1e-13
constexpr double exact = 0;                  // integers, and values that are only copied

using Numbers = std::vector<double>;
using History = std::map<std::string, Numbers>;

std::ifstream open_data(const std::string& name) {
  std::ifstream file(fmt::format("{}/tests/fatigue/data/{}", DRESSLIFE_SOURCE_DIR, name));
  REQUIRE(file);
  return file;
}

Numbers two_sines() {
  Numbers series;
  for (int i = 0; i <= 1000; ++i) {
    series.push_back(0.8 * std::sin(0.01 * std::numbers::pi * i) + 0.2 * std::sin(0.032 * std::numbers::pi * i));
  }
  return series;
}

std::map<std::string, History> counted_histories() {
  std::map<std::string, History> histories;
  std::string name;
  auto file = open_data("counted_histories.txt");
  for (std::string line; std::getline(file, line);) {
    std::istringstream text(line);
    std::string key;
    if (!(text >> key) || key == "source:" || key.front() == '#') continue;
    if (key == "history:") {
      text >> name;
      continue;
    }
    Numbers& values = histories[name][key.substr(0, key.size() - 1)];
    for (double value = 0; text >> value;) values.push_back(value);
    if (key == "series:" && values.empty()) values = two_sines();
  }
  return histories;
}

Numbers long_series() {
  Numbers series;
  double value = 0;
  auto file = open_data("long_series.txt");
  for (std::string line; std::getline(file, line);) {
    if (line.front() == '#') continue;
    std::istringstream text(line);
    for (double difference = 0; text >> difference;) series.push_back(value += difference);
  }
  return series;
}

void check_equal(const Numbers& found, const Numbers& expected, double tolerance) {
  REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) CHECK(std::fabs(found[i] - expected[i]) <= tolerance);
}

struct FourPoint {
  std::vector<Cycle> closed;
  std::vector<Reversal> residue;
};

FourPoint four_point(std::span<const Reversal> reversals) {
  FourPoint result;
  FourPointCounter counter;
  for (const Reversal& r : reversals) counter.push(r, result.closed);
  result.residue = counter.residue();
  return result;
}

Numbers from_to(const std::vector<Cycle>& cycles) {
  Numbers result;
  for (const Cycle& c : cycles) result.insert(result.end(), {c.begin.strain, c.end.strain});
  return result;
}

/// Returns ranges and means sorted by range, then mean. Ranges closer than the tolerance are equal.
Numbers sorted_range_mean(std::vector<std::pair<double, double>> pairs, double tolerance) {
  const auto key = [&](const std::pair<double, double>& p) {
    return std::pair{tolerance > 0 ? std::round(p.first / tolerance) : p.first, p.second};
  };
  std::sort(pairs.begin(), pairs.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
  Numbers result;
  for (const auto& [range, mean] : pairs) result.insert(result.end(), {range, mean});
  return result;
}

std::vector<std::pair<double, double>> range_mean(const std::vector<Cycle>& cycles) {
  std::vector<std::pair<double, double>> result;
  for (const Cycle& c : cycles) result.emplace_back(c.range(), c.mean());
  return result;
}

std::vector<std::pair<double, double>> in_pairs(const Numbers& numbers) {
  std::vector<std::pair<double, double>> result;
  for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) result.emplace_back(numbers[i], numbers[i + 1]);
  return result;
}

Numbers ranges(const std::vector<Cycle>& cycles) {
  Numbers result;
  for (const Cycle& c : cycles) result.push_back(c.range());
  std::sort(result.begin(), result.end());
  return result;
}

Numbers random_walk(std::mt19937& random, int samples, int levels) {
  std::uniform_int_distribution<int> level(-levels, levels);
  Numbers series;
  for (int i = 0; i < samples; ++i) series.push_back(level(random));
  return series;
}

/// Rychlik's definition (1987) on the periodic history, without a stack: a maximum M is paired with the higher of the two
/// lowest values between it and the nearest crossing of its level on either side. Precondition: no maxima are equal. The
/// global maximum is paired with the global minimum.
Numbers rychlik_ranges(const Numbers& period) {
  const int n = static_cast<int>(period.size());
  const auto at = [&](int i) { return period[((i % n) + n) % n]; };
  Numbers result;
  for (int i = 0; i < n; ++i) {
    if (!(at(i) > at(i - 1) && at(i) > at(i + 1))) continue;
    const auto lowest_toward = [&](int step) {
      double lowest = at(i);
      for (int k = 1; k < n && at(i + step * k) <= at(i); ++k) lowest = std::min(lowest, at(i + step * k));
      return lowest;
    };
    result.push_back(at(i) - std::max(lowest_toward(-1), lowest_toward(1)));
  }
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace

TEST_CASE("published histories: reversals, four-point, residue, repeating and half cycles") {
  const auto histories = counted_histories();
  REQUIRE(histories.size() == 9);
  for (const auto& [name, h] : histories) {
    INFO(name);
    const double tolerance = name == "rainflow_case3_two_sines" ? two_sines_rounding : exact;
    const auto reversals = find_reversals(h.at("series"));
    Numbers points;
    for (const Reversal& r : reversals) points.insert(points.end(), {double(r.sample), r.strain});
    check_equal(points, h.at("turning_points"), tolerance);

    const FourPoint four = four_point(reversals);
    check_equal(from_to(four.closed), h.at("closed"), tolerance);
    Numbers samples, residue, half;
    for (const Cycle& c : four.closed) samples.insert(samples.end(), {double(c.begin.sample), double(c.end.sample)});
    check_equal(samples, h.at("closed_index"), exact);
    for (const Reversal& r : four.residue) residue.push_back(r.strain);
    check_equal(residue, h.at("residue"), tolerance);
    check_equal(from_to(repeat_residue(four.residue)), h.at("residue_repeated"), tolerance);

    check_equal(sorted_range_mean(range_mean(count_repeating(reversals)), tolerance),
                sorted_range_mean(in_pairs(h.at("repeating")), tolerance), tolerance);
    for (const Cycle& c : count_half_cycles(reversals)) {
      half.insert(half.end(), {c.range(), c.mean(), c.count, double(c.begin.sample), double(c.end.sample)});
    }
    check_equal(half, h.at("half_cycles"), tolerance);
  }
}

TEST_CASE("a measured history of 10001 samples: numbers, residue and power sums of its cycles") {
  const Numbers series = long_series();
  REQUIRE(series.size() == 10001);
  const auto reversals = find_reversals(series);
  CHECK(reversals.size() == 4728);
  const FourPoint four = four_point(reversals);
  CHECK(four.closed.size() == 2358);
  Numbers residue;
  for (const Reversal& r : four.residue) residue.push_back(r.strain);
  check_equal(residue, {0, 142, -609, 2950, -2000, 2170, 1845, 2159, 1894, 2101, 1991, 2061}, exact);
  const auto repeated = repeat_residue(four.residue);
  check_equal(ranges(repeated), {70, 142, 207, 314, 2779, 4950}, exact);

  constexpr double sum_rounding = 1e-12;  // relative; 2358 positive terms
  const auto power_sum = [](const std::vector<Cycle>& cycles, double power) {
    double sum = 0;
    for (const Cycle& c : cycles) sum += c.count * std::pow(c.range(), power);
    return sum;
  };
  CHECK(power_sum(four.closed, 1) == 122583);
  CHECK(power_sum(four.closed, 2) == 32200971);
  CHECK(power_sum(four.closed, 5) == Approx(3.78998254244298e+16).epsilon(sum_rounding));
  const auto repeating = count_repeating(reversals);
  CHECK(power_sum(repeating, 5) == Approx(3.1754931002615987e+18).epsilon(sum_rounding));
  CHECK(ranges(repeating).back() == 4950);
  double halves = 0, fulls = 0;
  for (const Cycle& c : count_half_cycles(reversals)) (c.count == 1 ? fulls : halves) += c.count;
  CHECK(halves == 5.5);
  CHECK(fulls == 2358);
}

TEST_CASE("residue 2 7 of 2 5 3 7: one cycle when repeated, half a cycle when not") {
  const auto reversals = find_reversals(Numbers{2, 5, 3, 7});
  const FourPoint four = four_point(reversals);
  check_equal(from_to(four.closed), {5, 3}, exact);
  REQUIRE(four.residue.size() == 2);
  check_equal(from_to(repeat_residue(four.residue)), {7, 2}, exact);
  const auto half = count_half_cycles(reversals);
  REQUIRE(half.size() == 2);
  CHECK(half[1].count == 0.5);
  check_equal(from_to({half[1]}), {2, 7}, exact);
}

TEST_CASE("half cycles are refused where rises and falls do not alternate") {
  const std::vector<Reversal> rises_twice{{0, 0}, {1, 1}, {1, 2}, {3, 3}, {2, 4}};
  CHECK_THROWS_WITH(count_half_cycles(rises_twice),
                    Catch::Contains("reversal 3 of a strain history continues from 1 to 3 in the direction of the "
                                    "one before"));
  const std::vector<Reversal> plateau{{0, 0}, {3, 1}, {3, 2}, {2, 3}};
  CHECK(count_half_cycles(plateau).size() == 2);
  CHECK(count_half_cycles(std::vector<Reversal>{}).empty());
}

TEST_CASE("plateaus stand at their first sample, ends are kept") {
  const auto reversals =
      find_reversals(Numbers{32, 32, 32.1, 32.9, 33, 33, 33, 33, 33, 32.5, 32, 32, 32.7, 37.2, 40, 35.2, 33});
  const std::vector<Reversal> expected{{32, 0}, {33, 4}, {32, 10}, {40, 14}, {33, 16}};
  CHECK(reversals == expected);
  CHECK(find_reversals(Numbers{}).empty());
  CHECK(find_reversals(Numbers{7, 7, 7}) == std::vector<Reversal>{{7, 0}});
  CHECK(find_reversals(Numbers{1, 2, 2}) == std::vector<Reversal>{{1, 0}, {2, 1}});
}

TEST_CASE("cutting a history into pieces changes nothing") {
  const std::vector<Numbers> list{{0, 1, 0, 1, -1, 1, 0, 1, -1, 1, 0},
                                  {2, 5, 3, 6, 2, 3, 1, 6, 1, 4, 2, 3, 1, 4, 2, 5, 3, 4, 2},
                                  {1, 7, 4, 3, 4, 2, 5, 3, 6, 1, 2},
                                  {4, 3, 6, 4, 5, 2, 5, 3, 1, 2},
                                  {1, 6, 2, 5, 3, 4, 1}};
  for (const Numbers& series : list) {
    const FourPoint whole = four_point(find_reversals(series));
    for (std::size_t a = 0; a <= series.size(); ++a) {
      for (std::size_t b = a; b <= series.size(); ++b) {
        ReversalFinder finder;  // state continues over pieces [0, a), [a, b), [b, end), each counted at once
        FourPointCounter counter;
        std::vector<Cycle> closed;
        for (const auto& [from, to] : {std::pair{std::size_t{0}, a}, {a, b}, {b, series.size()}}) {
          std::vector<Reversal> piece;
          for (std::size_t i = from; i < to; ++i) {
            if (const auto reversal = finder.push(series[i])) piece.push_back(*reversal);
          }
          for (const Reversal& r : piece) counter.push(r, closed);
        }
        counter.push(finder.finish().value(), closed);
        CHECK(from_to(closed) == from_to(whole.closed));
        CHECK(counter.residue() == whole.residue);
      }
    }
  }
}

TEST_CASE("repeating history agrees with Rychlik's definition") {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> value(-1, 1);
  for (int trial = 0; trial < 300; ++trial) {
    Numbers series;
    for (int i = 0; i < 3 + trial % 40; ++i) series.push_back(value(random));
    check_equal(ranges(count_repeating(find_reversals(series))), rychlik_ranges(series), exact);
  }
}

TEST_CASE("repeating history: four-point with its residue repeated, and every start of the period, give the same") {
  std::mt19937 random(12);
  for (int trial = 0; trial < 300; ++trial) {
    Numbers series = random_walk(random, 3 + trial % 40, 6);  // few levels: many ties
    const auto repeating = ranges(count_repeating(find_reversals(series)));
    const FourPoint four = four_point(find_reversals(series));
    auto all = four.closed;
    const auto repeated = repeat_residue(four.residue);
    all.insert(all.end(), repeated.begin(), repeated.end());
    CHECK(ranges(all) == repeating);
    std::rotate(series.begin(), series.begin() + 1 + trial % (series.size() - 1), series.end());
    CHECK(ranges(count_repeating(find_reversals(series))) == repeating);
  }
}

TEST_CASE("every range of a history is in exactly one cycle") {
  std::mt19937 random(13);
  for (int trial = 0; trial < 100; ++trial) {
    const auto reversals = find_reversals(random_walk(random, 50, 20));
    double path = 0, counted = 0, closed_path = 0, closed = 0;
    for (std::size_t i = 1; i < reversals.size(); ++i) path += std::fabs(reversals[i].strain - reversals[i - 1].strain);
    for (const Cycle& c : count_half_cycles(reversals)) counted += 2 * c.count * c.range();
    CHECK(counted == path);
    const auto period = rotate_to_largest(reversals);
    for (std::size_t i = 1; i < period.size(); ++i) closed_path += std::fabs(period[i].strain - period[i - 1].strain);
    for (const Cycle& c : count_repeating(reversals)) closed += 2 * c.range();
    CHECK(closed == closed_path);
  }
}

TEST_CASE("the period starts at the largest |strain|, also when that is a compression") {
  const auto period = rotate_to_largest(find_reversals(Numbers{0, 2, -1, 1, -3, 0}));
  const std::vector<Reversal> expected{{-3, 4}, {2, 1}, {-1, 2}, {1, 3}, {-3, 4}};
  CHECK(period == expected);
  CHECK(rotate_to_largest(std::vector<Reversal>{{5, 0}}).size() == 1);
}

TEST_CASE("differences far below what their product can hold still turn the history") {
  constexpr double tiny = 1e-300;
  const auto reversals = find_reversals(Numbers{0, tiny, -tiny, 2 * tiny, 0});
  CHECK(reversals.size() == 5);
  check_equal(ranges(count_repeating(reversals)), {1 * tiny, 3 * tiny}, exact);
}

TEST_CASE("numbers that are not finite are refused") {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    CHECK_THROWS_WITH(find_reversals(Numbers{0, 1, bad, 0}),
                      Catch::Contains("sample 2 of a strain history is") && Catch::Contains("must be finite"));
  }
}
