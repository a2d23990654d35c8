// Equal rounds of a program's loop: which samples are left out, and the turning points of the whole motion from the others.
#include "strain/shortening.h"

#include <algorithm>
#include <random>

#include "fatigue/rainflow.h"
#include "strain/reversals.h"
#include "tests/catch.h"

namespace dresslife::strain {
namespace {

SiteRows turning_points(const std::vector<float>& history, float gate) {
  TurningPoints points(gate);
  TurningList list;
  points.next(history, list);
  points.finish(list);
  SiteRows rows;
  for (const TurningPoint& point : list.points()) {
    rows.strain.push_back(point.strain);
    rows.sample.push_back(point.sample);
  }
  rows.turning = {list.size()};
  return rows;
}

/// Returns the counts of the ranges of at least the gate, sorted.
std::vector<std::pair<double, double>> counted(const SiteRows& rows, float gate, bool repeating) {
  std::vector<fatigue::Reversal> reversals;
  for (std::size_t k = 0; k < rows.strain.size(); ++k) reversals.push_back({rows.strain[k], rows.sample[k]});
  std::vector<std::pair<double, double>> all;
  for (const fatigue::Cycle& cycle :
       repeating ? fatigue::count_repeating(reversals) : fatigue::count_half_cycles(reversals))
    if (cycle.range() >= gate) all.emplace_back(cycle.range(), cycle.count);
  std::ranges::sort(all);
  return all;
}

std::vector<float> without_left_out(const std::vector<float>& history, const Shortening& shortening) {
  std::vector<float> kept;
  for (const Shortening::Piece& piece : shortening.pieces())
    if (piece.times > 0)
      kept.insert(kept.end(), history.begin() + std::ptrdiff_t(piece.first),
                  history.begin() + std::ptrdiff_t(piece.end));
  return kept;
}

class RandomMotion {
 public:
  explicit RandomMotion(unsigned seed) : random_(seed) {}
  std::size_t size(std::size_t least, std::size_t most) {
    return std::uniform_int_distribution<std::size_t>(least, most)(random_);
  }
  std::vector<float> walk(std::size_t samples) {
    std::vector<float> strains(samples);
    for (float& strain : strains)
      strain = std::uniform_int_distribution<int>(0, 3)(random_) == 0 && &strain != strains.data()
                   ? *(&strain - 1)  // a plateau
                   : std::normal_distribution<float>(0, 1e-3f)(random_);
    return strains;
  }

 private:
  std::mt19937 random_;
};

void append(std::vector<float>& history, const std::vector<float>& part, std::size_t times = 1) {
  for (std::size_t k = 0; k < times; ++k) history.insert(history.end(), part.begin(), part.end());
}

TEST_CASE("shortening: the turning points of the whole motion count the same cycles as those of its whole history") {
  const unsigned seed = GENERATE(range(0u, 200u));
  const float gate = GENERATE(0.0f, 5e-4f, 2e-3f, 1e-2f);
  CAPTURE(seed, gate);
  RandomMotion random(seed);
  std::vector<float> history;
  std::vector<EqualParts> parts;
  append(history, random.walk(random.size(0, 20)));
  for (std::size_t loops = random.size(1, 3); loops > 0; --loops) {
    const std::vector<float> round = random.walk(random.size(2, 30));
    const std::size_t rounds = random.size(1, 2), count = random.size(2, 6);
    append(history, round);
    parts.push_back({history.size(), rounds * round.size(), count, 0});
    append(history, round, rounds * count + 1);
    append(history, random.walk(random.size(0, 20)));
  }
  const Shortening shortening(history.size(), parts);
  REQUIRE(shortening.samples() < history.size());
  const SiteRows whole = shortening.whole(turning_points(without_left_out(history, shortening), gate));
  const SiteRows expected = turning_points(history, gate);
  REQUIRE(whole.turning == std::vector<std::uint64_t>{whole.strain.size()});
  for (const bool repeating : {false, true})
    CHECK(counted(whole, gate, repeating) == counted(expected, gate, repeating));
  CHECK(std::ranges::is_sorted(whole.sample));
  CHECK(whole.sample.back() == history.size() - 1);
  for (std::size_t k = 0; k < whole.sample.size(); ++k) CHECK(history[whole.sample[k]] == whole.strain[k]);
}

TEST_CASE("shortening: a constant history keeps its two points") {
  const Shortening shortening(60, {{10, 10, 3, 0}});
  const SiteRows whole = shortening.whole(turning_points(std::vector<float>(40, 1e-3f), 1e-4f));
  CHECK(whole.strain == std::vector<float>(2, 1e-3f));
  CHECK(whole.sample == std::vector<std::uint32_t>{0, 59});
}

TEST_CASE("shortening: pieces cover the motion, and a history keeps the samples that are followed") {
  const Shortening shortening(100, {{0, 10, 3, 0}, {40, 20, 3, 0}});
  REQUIRE(shortening.pieces().size() == 5);
  CHECK(shortening.samples() == 40);
  std::size_t next = 0;
  for (const Shortening::Piece& piece : shortening.pieces()) CHECK(piece.first == std::exchange(next, piece.end));
  CHECK(next == 100);
  DeformationHistory whole(1, 100);
  for (std::size_t t = 0; t < 100; ++t) whole.set(0, t, {double(t), 2.0 * t, 3.0 * t, 4.0 * t});
  const DeformationHistory history = shortening.shortened(whole.columns(0));
  REQUIRE(history.samples() == 40);
  const auto at = [&](std::size_t t) { return history.columns(0).curvature1[t]; };
  CHECK((at(0) == 0 && at(9) == 9 && at(10) == 30 && at(20) == 40 && at(39) == 59));
  CHECK(history.columns(0).elongation[39] == 4 * 59);
  CHECK_FALSE(Shortening(100).any());
  CHECK(Shortening(0).pieces().empty());
}

TEST_CASE("equal parts: of rounds of a whole number of samples, one round before and one behind them") {
  const auto parts = equal_parts({12.3, 50, 10}, 1);
  REQUIRE(parts);
  CHECK(parts->first == 63);
  CHECK(parts->length == 50);
  CHECK(parts->count == 8);
  CHECK(static_cast<double>(parts->end()) <= 12.3 + 9 * 50 + 1);
}

TEST_CASE("equal parts: several rounds, if one round is not a whole number of samples") {
  const auto halves = equal_parts({0, 50.5, 10}, 1);
  REQUIRE(halves);
  CHECK(halves->length == 101);
  CHECK(halves->count == 4);
  const auto drifting = equal_parts({0, 50.09, 100}, 1);  // one part less than this and the jump exceeds half a sample
  REQUIRE(drifting);
  CHECK(static_cast<double>(drifting->count - 1) * std::abs(drifting->drift) <= 0.5);
  CHECK(drifting->left_out() > 40 * 50);
}

TEST_CASE("equal parts: too few rounds, or no whole number of samples") {
  for (const std::size_t rounds : {0, 1, 2, 3}) CHECK_FALSE(equal_parts({0, 50, rounds}, 1));
  CHECK(equal_parts({0, 50, 4}, 1));
  CHECK_FALSE(equal_parts({0, 50, 4}, 2));
  CHECK_FALSE(equal_parts({0, 50.5, 5}, 1));
  CHECK_FALSE(equal_parts({0, 50.4, 6}, 1));
  CHECK_FALSE(equal_parts({0, 0.04, 1000}, 1));  // 25 rounds in a sample
}

}  // namespace
}  // namespace dresslife::strain
