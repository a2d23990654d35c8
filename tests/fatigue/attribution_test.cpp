// Damage attributed to joints, on histories with known causes.
#include "fatigue/attribution.h"
#include "pipeline/job/job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "tests/catch.h"
#include "tests/fatigue/materials.h"

using namespace dresslife;
using namespace dresslife::fatigue;
using namespace dresslife::fatigue_tests;

namespace {

constexpr double same_sum = 1e-12;   // relative: equal terms in another order
constexpr double ridge_pull = 1e-4;  // the ridge of 1e-6 against the least varied term of these motions

/// A motion of three joints, each with its own frequency, that drift apart.
struct Wandering {
  std::size_t samples = 900;
  std::vector<double> position;
  Wandering() {
    for (std::size_t t = 0; t < samples; ++t) {
      const double s = 2 * std::numbers::pi * double(t) / double(samples);
      position.insert(position.end(), {0.9 * std::sin(3 * s), 0.4 + 0.7 * std::cos(5 * s), 0.5 * std::sin(7 * s + 1)});
    }
  }
  double at(std::size_t t, std::size_t joint) const { return position[3 * t + joint]; }
  template <class Strain>
  std::vector<double> strain(const Strain& of) const {
    std::vector<double> values;
    for (std::size_t t = 0; t < samples; ++t) values.push_back(of(at(t, 0), at(t, 1), at(t, 2)));
    return values;
  }
};

std::vector<DamagingCycle> cycles_of(const std::vector<double>& strain) {
  return evaluate_cycles(find_reversals(strain), copper(), {});
}

/// Returns a reversal for every sample.
std::vector<Reversal> known(const std::vector<double>& strain) {
  std::vector<Reversal> all;
  for (const double value : strain) all.push_back({value, static_cast<std::int64_t>(all.size())});
  return all;
}

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

}  // namespace

TEST_CASE("attribution: joints of a linear strain cost what they contribute") {
  const Wandering motion;
  const auto strain = motion.strain([](double a, double b, double) { return 0.01 * a - 0.004 * b; });
  const StrainOfJoints surface(motion.position, known(strain), {true, true, true});
  CHECK(surface.explained() == Approx(1).epsilon(ridge_pull));
  for (const auto& [from, to] : {std::pair<std::size_t, std::size_t>{0, 140}, {500, 20}, {899, 1}}) {
    const std::vector<double> change = surface.change(from, to);
    CHECK(change[0] == Approx(0.01 * (motion.at(to, 0) - motion.at(from, 0))).margin(0.01 * ridge_pull));
    CHECK(change[1] == Approx(-0.004 * (motion.at(to, 1) - motion.at(from, 1))).margin(0.01 * ridge_pull));
    CHECK(change[2] == Approx(0).margin(0.01 * ridge_pull));
  }
}

TEST_CASE("attribution: a quadratic strain is followed exactly from any sample to any other") {
  const Wandering motion;
  const auto strain = motion.strain(
      [](double a, double b, double c) { return 0.003 + 0.01 * a + 0.02 * a * b - 0.005 * c * c + 0.004 * b; });
  const StrainOfJoints surface(motion.position, known(strain), {true, true, true});
  std::mt19937 random(5);
  for (int draw = 0; draw < 200; ++draw) {
    const std::size_t from = random() % motion.samples, to = random() % motion.samples;
    CHECK(sum(surface.change(from, to)) == Approx(strain[to] - strain[from]).margin(0.02 * ridge_pull));
  }
}

TEST_CASE("attribution: the explained share is that of the variance which joints cause") {
  const Wandering motion;
  // 0.009 of the first joint, and as much of a swing whose frequency no product of two joints has
  std::vector<double> strain = motion.strain([](double a, double, double) { return 0.01 * a; });
  for (std::size_t t = 0; t < strain.size(); ++t)
    strain[t] += 0.009 * std::sin(2 * std::numbers::pi * 40 * double(t) / double(motion.samples));
  CHECK(StrainOfJoints(motion.position, known(strain), {true, true, true}).explained() ==
        Approx(0.5).margin(ridge_pull));
}

TEST_CASE("attribution: a few known samples make the same surface") {
  const Wandering motion;
  const auto strain = motion.strain([](double a, double b, double) { return 0.01 * a - 0.02 * a * b; });
  std::vector<Reversal> few;
  for (std::size_t t = 0; t < motion.samples; t += 37) few.push_back({strain[t], static_cast<std::int64_t>(t)});
  const StrainOfJoints all(motion.position, known(strain), {true, true, true});
  const StrainOfJoints some(motion.position, few, {true, true, true});
  for (std::size_t joint = 0; joint < 3; ++joint)
    CHECK(some.change(11, 333)[joint] == Approx(all.change(11, 333)[joint]).margin(0.02 * ridge_pull));
}

TEST_CASE("attribution: shares of the joints and of carrying add up to the damage") {
  const Wandering motion;
  // The third joint lies outside the clamps. The last term represents swinging.
  std::vector<double> strain =
      motion.strain([](double a, double b, double c) { return 0.012 * a + 0.006 * b * b + 0.004 * c; });
  for (std::size_t t = 0; t < motion.samples; ++t) strain[t] += 0.001 * std::sin(0.37 * double(t));
  const auto cycles = cycles_of(strain);
  const StrainOfJoints surface(motion.position, known(strain), {true, true, false});
  std::vector<std::int32_t> step;
  for (std::size_t t = 0; t < motion.samples; ++t) step.push_back(t < 30 ? -1 : static_cast<int>(t / 300));
  const JointDamage by_joint = damage_by_joint(cycles, surface, step, 3);
  const double total = sum_of_damage(cycles);
  REQUIRE(total > 0);
  REQUIRE(by_joint.damage.size() == 4);
  CHECK(sum(by_joint.damage) == Approx(total).epsilon(same_sum));
  CHECK(by_joint.damage[2] == 0);
  CHECK(by_joint.damage[0] > 0.5 * total);
  CHECK(by_joint.damage[3] > 0.01 * total);
  // and line by line
  const auto by_line = damage_by_step(damage_over_time(cycles, motion.samples, Moment::closes), step, 3);
  for (std::size_t line = 0; line < 3; ++line)
    CHECK(std::accumulate(by_joint.by_line.begin() + 4 * line, by_joint.by_line.begin() + 4 * (line + 1), 0.0) ==
          Approx(by_line[line]).epsilon(same_sum));
}

TEST_CASE("attribution: a joint that moves against the others relieves") {
  // One swing: the first joint contributes 3, the second -1.
  std::vector<double> position, strain;
  for (int t = 0; t <= 40; ++t) {
    const double s = std::sin(2 * std::numbers::pi * t / 40), wiggle = 0.3 * std::sin(2 * std::numbers::pi * t / 8);
    position.insert(position.end(), {s, s + wiggle});
    strain.push_back(0.003 * s - 0.001 * (s + wiggle));
  }
  const auto cycles = cycles_of(strain);
  const StrainOfJoints surface(position, known(strain), {true, true});
  const JointDamage by_joint = damage_by_joint(cycles, surface, std::vector<std::int32_t>(41, 0), 1);
  CHECK(by_joint.damage[0] > sum_of_damage(cycles));
  CHECK(by_joint.damage[1] < 0);
  CHECK(std::abs(by_joint.damage[2]) < 1e-3 * sum_of_damage(cycles));
}

TEST_CASE("attribution: joints that always move together share evenly and those that stand cost nothing") {
  std::vector<double> position, strain;
  for (int t = 0; t <= 40; ++t) {
    const double s = std::sin(2 * std::numbers::pi * t / 40);
    position.insert(position.end(), {s, 2 * s, 0.7});
    strain.push_back(0.004 * s);
  }
  const StrainOfJoints surface(position, known(strain), {true, true, true});
  const std::vector<double> change = surface.change(0, 10);
  constexpr double numerics = 1e-5;
  CHECK(change[0] == Approx(0.002).epsilon(numerics));
  CHECK(change[1] == Approx(0.002).epsilon(numerics));
  CHECK(change[2] == 0);
  // No motion, or no strain.
  const StrainOfJoints still(std::vector<double>(12, 0.1), known({1e-3, 2e-3, 0, 1e-3}), {true, true, true});
  CHECK(still.explained() == 0);
  CHECK(still.change(0, 1) == std::vector<double>{0, 0, 0});
  const StrainOfJoints calm(position, known(std::vector<double>(41, 0.0)), {true, true, true});
  CHECK(calm.explained() == 0);
  CHECK(calm.change(3, 17) == std::vector<double>{0, 0, 0});
}

TEST_CASE("attribution: only joints between the clamps' links bend the dresspack") {
  pipeline::Job job;
  job.robot.joints.resize(6);
  for (int k = 0; k <= 6; ++k) job.robot.links.push_back({"link_" + std::to_string(k), {}, {}, {}});
  CHECK(joints_between_clamps(job) == std::vector<bool>(6, false));
  job.dresspacks[0].routing.base_clamp.emplace().link = "link_3";
  job.dresspacks[0].routing.tool_clamp.emplace().link = "link_6";
  const std::vector<bool> wrist{false, false, false, true, true, true};
  CHECK(joints_between_clamps(job) == wrist);
  std::swap(job.dresspacks[0].routing.base_clamp, job.dresspacks[0].routing.tool_clamp);
  CHECK(joints_between_clamps(job) == wrist);
  job.dresspacks[0].routing.base_clamp->link = "link_3";
  job.dresspacks[0].routing.tool_clamp->link = "link_3";
  CHECK(joints_between_clamps(job) == std::vector<bool>(6, false));
}

TEST_CASE("attribution: a joint that follows another one counts for its axis") {
  pipeline::Job job;
  job.robot.joints.resize(4);
  for (int k = 0; k <= 4; ++k) job.robot.links.push_back({"link_" + std::to_string(k), {}, {}, {}});
  for (int k = 0; k < 4; ++k) job.robot.joints[k].name = "joint_" + std::to_string(k + 1);
  job.robot.joints[2].follows = "joint_1";
  job.dresspacks[0].routing.base_clamp.emplace().link = "link_2";
  job.dresspacks[0].routing.tool_clamp.emplace().link = "link_3";
  CHECK(joints_between_clamps(job) == std::vector<bool>{true, false, false});
  job.dresspacks[0].routing.tool_clamp->link = "link_4";
  CHECK(joints_between_clamps(job) == std::vector<bool>{true, false, true});
}

TEST_CASE("attribution: segments count for the nearest clamp") {
  const std::vector<double> length{0.1, 0.2, 0.3, 0.4}, damage{1, 2, 4, 8};
  // centres at 0.05, 0.2, 0.45 and 0.8 of 1 m
  CHECK(damage_by_clamp(damage, length, std::vector{0.0, 1.0}) == std::vector<double>{7, 8});
  CHECK(damage_by_clamp(damage, length, std::vector{0.0, 0.3, 0.6, 1.0}) == std::vector<double>{1, 2, 4, 8});
  CHECK(damage_by_clamp(damage, length, std::vector{0.0, 0.3}) == std::vector<double>{1, 14});
  CHECK(damage_by_clamp(damage, length, std::vector{0.0, 0.9}) == std::vector<double>{3, 12});  // 0.45 is half-way
  CHECK(damage_by_clamp(damage, length, std::vector{0.0, 0.01, 1.0}) == std::vector<double>{0, 7, 8});
}

TEST_CASE("attribution: damage by clamp is that of the nearest one and adds up to the whole") {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> share(0, 1);
  for (int round = 0; round < 100; ++round) {
    std::vector<double> length(40), damage(40), at{0};
    for (double& l : length) l = 0.01 + share(random);
    for (double& d : damage) d = share(random);
    const double total = std::accumulate(length.begin(), length.end(), 0.0);
    for (int k = 0; k < round % 5; ++k) at.push_back(total * share(random));
    at.push_back(total);
    std::sort(at.begin(), at.end());
    std::vector<double> nearest(at.size(), 0.0);
    double centre = 0;
    for (std::size_t k = 0; k < length.size(); ++k) {
      centre += length[k] / 2;
      const auto best = std::min_element(
          at.begin(), at.end(), [&](double a, double b) { return std::abs(a - centre) < std::abs(b - centre); });
      nearest[best - at.begin()] += damage[k];
      centre += length[k] / 2;
    }
    const std::vector<double> each = damage_by_clamp(damage, length, at);
    CHECK(each == nearest);
    CHECK(std::accumulate(each.begin(), each.end(), 0.0) ==
          Approx(std::accumulate(damage.begin(), damage.end(), 0.0)).epsilon(same_sum));
  }
}

TEST_CASE("attribution: clamps between the ends are reported with their links and a free end has none") {
  pipeline::Routing routing;
  routing.clamps.resize(2);
  routing.clamps[0].clamp.link = "link_4";
  routing.clamps[0].at_length = 0.5;
  routing.clamps[1].clamp.link = "link_5";
  routing.clamps[1].at_length = 1.25;
  const auto told = [&] {
    std::string text;
    for (const ClampPlace& clamp : clamps_of(routing, 2)) text += fmt::format("{} at {}; ", clamp.name, clamp.at);
    return text;
  };
  CHECK(told() == "base clamp at 0; clamp 1 on link_4 at 0.5; clamp 2 on link_5 at 1.25; tool clamp at 2; ");
  routing.tool_end = pipeline::ToolEnd::free;
  CHECK(told() == "base clamp at 0; clamp 1 on link_4 at 0.5; clamp 2 on link_5 at 1.25; ");
}
