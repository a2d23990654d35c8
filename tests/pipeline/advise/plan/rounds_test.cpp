// Rounds of programs: numbers of repeats by hand, cycles of a long motion by the closed form, moves within their limits.
#include "pipeline/advise/plan/rounds.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/settings/document.h"
#include "tests/catch.h"

using namespace dresslife::pipeline;

namespace {

constexpr double rounding = 1e-12;

Duty duty_of(const std::vector<std::string>& programs, const std::vector<std::pair<std::string, int>>& order) {
  Duty duty;
  for (const std::string& job : programs) duty.programs.emplace_back().job = job;
  for (const auto& [job, repeats] : order) duty.order.push_back({{}, job, repeats});
  return duty;
}

/// Returns the ranges of the cycles of a periodic motion: the largest value is put first, then each hysteresis loop of three
/// turning points is removed until none remains.
std::vector<double> cycles_of(std::vector<double> values) {
  std::rotate(values.begin(), std::max_element(values.begin(), values.end()), values.end());
  values.push_back(values.front());
  std::vector<double> ranges, open;
  for (const double value : values) {
    while (open.size() >= 2 && (value - open.back()) * (open.back() - open[open.size() - 2]) >= 0) open.pop_back();
    open.push_back(value);
    while (open.size() >= 3) {
      const double before = std::abs(open[open.size() - 2] - open[open.size() - 3]),
                   last = std::abs(open.back() - open[open.size() - 2]);
      if (before > last) break;
      ranges.push_back(before);
      open.erase(open.end() - 3, open.end() - 1);
    }
  }
  return ranges;
}

double damage_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double range : cycles_of(values)) sum += std::pow(range, 5);
  return sum;
}

std::vector<double> joined(const std::vector<std::vector<double>>& parts) {
  std::vector<double> all;
  for (const std::vector<double>& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

std::vector<std::vector<double>> rows_of_csv(const std::string& text) {
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  CHECK(line == "time_s,axis_1_deg,axis_2_deg");
  std::vector<std::vector<double>> rows;
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(std::stod(cell));
  }
  return rows;
}

}  // namespace

TEST_CASE("every repeat is in a round or outside of all rounds") {
  const Duty duty = duty_of({"a", "b", "c"}, {{"a", 20}, {"b", 5}, {"a", 10}});
  CHECK(round_name(duty) == "a+b+a");
  const std::vector<double> repeats = repeats_in_rounds(duty, {60, 8, 3});
  REQUIRE(repeats.size() == 4);
  CHECK(repeats[3] == Approx(1.6).epsilon(rounding));  // 8 of b in groups of five; a would be enough for 2
  CHECK(repeats[0] == Approx(60 - 2 * 1.6).epsilon(rounding));
  CHECK(repeats[1] == Approx(8 - 1.6).epsilon(rounding));
  CHECK(repeats[2] == 3);
  CHECK(repeats_in_rounds(duty, {60, 0, 3}) == std::vector<double>{60, 0, 3, 0});
  const Duty in_turns = duty_of({"a", "b"}, {{"a", 1}, {"b", 1}});
  CHECK(repeats_in_rounds(in_turns, {7, 7}) == std::vector<double>{0, 0, 7});
  CHECK(repeats_in_rounds(duty_of({"a", "b"}, {}), {7, 9}) == std::vector<double>{7, 9});
}

TEST_CASE("by repeats and one round, the damage of batches is that of one long motion, with cycles across the change") {
  const std::vector<double> a{0, 3, 1, 4, 0}, b{0, -5, -2, -4, 0};
  const Duty duty = duty_of({"a", "b"}, {{"a", 3}, {"b", 2}});
  const std::vector<double> repeats = repeats_in_rounds(duty, {3, 2});
  const double by_rounds =
      repeats[0] * damage_of(a) + repeats[1] * damage_of(b) + repeats[2] * damage_of(joined({a, b}));
  CHECK(by_rounds == Approx(damage_of(joined({a, a, a, b, b}))).epsilon(rounding));
  // Without the change, the range of 9 between the programs is missing.
  CHECK(3 * damage_of(a) + 2 * damage_of(b) < 0.2 * by_rounds);
}

TEST_CASE("between programs all axes move together, within their shares of speed and acceleration") {
  constexpr double degrees = 180 / std::numbers::pi, interval = 0.04, digits = 1e-5;
  std::vector<Joint> axes(2);
  axes[0].speed = 2, axes[0].acceleration = 5, axes[1].speed = 0.5, axes[1].acceleration = 20;
  const JointCourse one{{0, interval, 2 * interval}, {0, 0, 0.01, 0, 0.02, 0.01}},
      other{{0, interval}, {0.8, -0.3, 0.79, -0.3}};
  const auto rows = rows_of_csv(round_csv({one, other}, axes));
  double fastest[2] = {0, 0}, hardest[2] = {0, 0};
  for (std::size_t k = 1; k < rows.size(); ++k) CHECK(rows[k][0] - rows[k - 1][0] == Approx(interval).margin(1e-6));
  const auto begin = std::find_if(rows.begin() + 3, rows.end(),
                                  [&](const auto& row) { return std::abs(row[1] - 0.8 * degrees) < digits; });
  REQUIRE(begin != rows.end());
  const auto second = static_cast<std::size_t>(begin - rows.begin());
  CHECK(rows[3][1] == rows[2][1]);  // at rest
  CHECK(rows[second + 1][1] == rows[second][1]);
  CHECK(rows[second + 2][1] == Approx(0.79 * degrees).margin(digits));
  for (std::size_t k = 4; k < second; ++k)
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double before = rows[k - 1][axis + 1], at = rows[k][axis + 1], after = rows[k + 1][axis + 1];
      fastest[axis] = std::max(fastest[axis], std::abs(after - before) / (2 * interval * degrees * axes[axis].speed));
      hardest[axis] = std::max(
          hardest[axis], std::abs(after - 2 * at + before) / (interval * interval * degrees * axes[axis].acceleration));
    }
  const double most = std::max({fastest[0] / 0.5, fastest[1] / 0.5, hardest[0] / 0.25, hardest[1] / 0.25});
  CHECK(most <= 1 + 1e-3);                            // differences of rounded angles
  CHECK(most > 0.9);                                  // whole intervals make the move slower by up to a tenth
  CHECK(rows.back()[1] == Approx(0).margin(digits));  // the motion returns to the first program
}

TEST_CASE("the job of a round keeps the medians of makers' ratings when the stages read it again") {
  Job job = job_from(
      parse_yaml("motion: {rig: {kind: torsion, length_m: 1, twist_deg_per_m: 180}}\ndresspack: {cable: control_cable}",
                 "job.yaml"));
  REQUIRE(job.calibration);
  const double strength = job.fatigue.strength_factor;
  REQUIRE(strength > 1);
  evaluate_at_medians(job);
  const Job again = job_from(parse_yaml(job_text(job), "again.yaml"));
  CHECK(again.fatigue.strength_factor == strength);
  CHECK(job_text(again) == job_text(job));
}
