#include "strain/reversals.h"
#include "tests/strain/all_kernels.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "pipeline/base/constants.h"
#include "tests/catch.h"

using namespace dresslife;
using namespace dresslife::strain;

namespace {

struct Kept {
  std::vector<float> strain;
  std::vector<std::uint32_t> sample;
};

Kept kept(const TurningList& list) {
  Kept all;
  for (const TurningPoint& point : list.points()) {
    all.strain.push_back(point.strain);
    all.sample.push_back(point.sample);
  }
  return all;
}

Kept filter(const std::vector<float>& history, float gate) {
  TurningPoints points(gate);
  TurningList list;
  points.next(history, list);
  points.finish(list);
  for (const std::size_t piece : {1, 7}) {  // the result does not depend on the block size
    TurningPoints again(gate);
    TurningList in_pieces;
    for (std::size_t first = 0; first < history.size(); first += piece)
      again.next(std::span(history).subspan(first, std::min(piece, history.size() - first)), in_pieces);
    again.finish(in_pieces);
    CHECK(kept(in_pieces).strain == kept(list).strain);
    CHECK(kept(in_pieces).sample == kept(list).sample);
  }
  return kept(list);
}

/// Returns the ranges of the full cycles and of the residue's half cycles of a sequence. Repeatedly removes the innermost
/// cycle: b c of four successive points a b c d with |b - c| <= |a - b| and |b - c| <= |c - d|.
std::vector<float> rainflow_ranges(std::vector<float> points) {
  std::vector<float> turning;
  for (const float p : points) {
    while (turning.size() >= 2 && (turning.back() - turning[turning.size() - 2]) * (p - turning.back()) >= 0)
      turning.pop_back();
    turning.push_back(p);
  }
  std::vector<float> ranges, stack;
  for (const float p : turning) {
    stack.push_back(p);
    while (stack.size() >= 4) {
      const auto top = stack.end();
      const float inner = std::abs(top[-2] - top[-3]);
      if (inner > std::abs(top[-3] - top[-4]) || inner > std::abs(top[-1] - top[-2])) break;
      ranges.push_back(inner);
      stack.erase(top - 3, top - 1);
    }
  }
  for (std::size_t k = 1; k < stack.size(); ++k) ranges.push_back(-std::abs(stack[k] - stack[k - 1]));
  std::sort(ranges.begin(), ranges.end());
  return ranges;
}

std::vector<float> at_least(std::vector<float> ranges, float gate) {
  std::erase_if(ranges, [&](float r) { return std::abs(r) < gate; });
  return ranges;
}

/// Returns a random walk on a coarse grid, which contains many ties and plateaus.
std::vector<float> random_history(std::mt19937& engine, std::size_t length) {
  std::uniform_int_distribution<int> step(-3, 3);
  std::vector<float> history(length);
  int value = 0;
  for (float& strain : history) strain = static_cast<float>(value += step(engine));
  return history;
}

}  // namespace

TEST_CASE("turning points keep both ends, drop small ranges and count a plateau at its first sample") {
  const Kept list = filter({0, 2, 5, 5, 5, 4.5f, 5, 1, 1, 3, 3}, 1);
  CHECK(list.strain == std::vector<float>{0, 5, 1, 3, 3});
  CHECK(list.sample == std::vector<std::uint32_t>{0, 2, 7, 9, 10});
}

TEST_CASE("a dip before the first rise is kept: the cycle to the next peak starts there") {
  const Kept list = filter({0, -0.5f, 3, 0}, 1);
  CHECK(list.strain == std::vector<float>{0, -0.5f, 3, 0});
}

TEST_CASE("a history that never moves by the gate keeps its ends") {
  const Kept list = filter({1, 1.2f, 0.9f, 1.1f}, 1);
  CHECK(list.strain == std::vector<float>{1, 1.1f});
  CHECK(filter({1}, 1).strain == std::vector<float>{1});
}

TEST_CASE("gate zero keeps every turning point once") {
  const Kept list = filter({0, 1, 1, 0, 0, 2}, 0);
  CHECK(list.strain == std::vector<float>{0, 1, 0, 2});
  CHECK(list.sample == std::vector<std::uint32_t>{0, 1, 3, 5});
}

TEST_CASE("rainflow counting finds the same cycles above the gate with and without the filter") {
  std::mt19937 engine(7);
  for (int k = 0; k < 2000; ++k) {
    const auto history = random_history(engine, 5 + k % 200);
    const float gate = static_cast<float>(k % 6);
    const Kept filtered = filter(history, gate);
    CHECK(at_least(rainflow_ranges(history), std::max(gate, 0.5f)) ==
          at_least(rainflow_ranges(filtered.strain), std::max(gate, 0.5f)));
  }
}

TEST_CASE("sixteen wires side by side turn where each turns alone") {
  std::mt19937 engine(11);
  std::normal_distribution<float> noise(0, 1);
  for (const Kernels* machine : kernels_of_this_machine())
    for (const std::size_t wires : {1, 6, 16})
      for (const float gate : {0.0f, 0.3f, 3.0f, 50.0f}) {
        const std::size_t samples = 700;
        std::array<std::vector<float>, waves_per_layer> wave;
        for (auto& w : wave) {
          w.resize(samples);
          float value = 0;
          for (float& x : w) x = value = 0.98f * value + noise(engine);
        }
        std::vector<double> angles(wires);
        for (std::size_t j = 0; j < wires; ++j) angles[j] = 2 * pi * static_cast<double>(j) / 16;
        LaneScan scan(angles, gate);
        std::vector<TurningList> lists(wires);
        for (std::size_t from = 0; from < samples;) {  // in uneven blocks
          const std::size_t count = std::min<std::size_t>(samples - from, 1 + from % 97);
          LaneRun run = scan.next(count, lists);
          std::vector<float> block(waves_per_layer * block_samples);
          for (int w = 0; w < waves_per_layer; ++w)
            std::copy_n(wave[w].begin() + static_cast<std::ptrdiff_t>(from), count, block.begin() + w * block_samples);
          run.waves = block.data();
          machine->scan(&run, 1, count);
          scan.done(lists);
          from += count;
        }
        scan.finish(lists);
        for (std::size_t j = 0; j < wires; ++j) {
          std::vector<float> history(samples);
          for (std::size_t t = 0; t < samples; ++t)
            history[t] =
                static_cast<float>(wave[0][t] + wave[1][t] * std::sin(angles[j]) + wave[2][t] * std::cos(angles[j]) +
                                   wave[3][t] * std::sin(2 * angles[j]) + wave[4][t] * std::cos(2 * angles[j]));
          const Kept alone = filter(history, gate);
          constexpr float float_rounding = 2e-5f;  // five products of order ten in single precision
          const Kept together = kept(lists[j]);
          REQUIRE(together.sample == alone.sample);
          for (std::size_t k = 0; k < alone.strain.size(); ++k)
            CHECK(std::abs(together.strain[k] - alone.strain[k]) < float_rounding);
        }
      }
}

TEST_CASE("wires and their mirror images turn together where they turn apart") {
  std::mt19937 engine(13);
  std::normal_distribution<float> noise(0, 1);
  const std::size_t samples = block_samples - 3;
  std::vector<float> waves;
  float value = 0;
  for (std::size_t k = 0; k < waves_per_layer * block_samples; ++k)
    waves.push_back(value = 0.98f * value + noise(engine));
  for (const Kernels* machine : kernels_of_this_machine())
    for (const std::size_t images : {0, 1, 5, 9, 16})
      for (const float gate : {0.0f, 0.3f, 3.0f}) {
        std::vector<double> angles(std::min<std::size_t>(images + 2, lanes)), opposite;
        for (std::size_t j = 0; j < angles.size(); ++j) angles[j] = 0.1 + 0.3 * static_cast<double>(j);
        for (std::size_t j = 0; j < images; ++j) opposite.push_back(-angles[j]);
        const auto lists = [&](bool together) {
          std::vector<LaneScan> scans{{angles, gate}};
          std::vector<std::vector<TurningList>> of(1);
          if (images > 0) scans.emplace_back(opposite, gate), of.emplace_back(images);
          of[0].resize(angles.size());
          std::vector<LaneRun> runs;
          for (std::size_t k = 0; k < scans.size(); ++k) {
            LaneRun& run = runs.emplace_back(scans[k].next(samples, of[k]));
            run.waves = waves.data();
            run.mirrors = together && k == 1;
          }
          machine->scan(runs.data(), runs.size(), samples);
          std::vector<Kept> all;
          for (std::size_t k = 0; k < scans.size(); ++k) {
            scans[k].done(of[k]);
            scans[k].finish(of[k]);
            for (const TurningList& list : of[k]) all.push_back(kept(list));
          }
          return all;
        };
        const std::vector<Kept> together = lists(true), apart = lists(false);
        REQUIRE(together.size() == angles.size() + images);
        for (std::size_t j = 0; j < apart.size(); ++j) {
          CHECK(together[j].sample == apart[j].sample);
          CHECK(together[j].strain == apart[j].strain);
        }
      }
}

TEST_CASE("wires ranked without turning points have the measures of their turning points") {
  std::mt19937 engine(12);
  std::normal_distribution<float> noise(0, 1);
  const auto cube = [](double x) { return x * x * x; };
  for (const Kernels* machine : kernels_of_this_machine())
    for (const float gate : {0.0f, 0.3f, 3.0f}) {
      const std::size_t wires = 16, samples = 600, half = 300;
      std::vector<std::vector<float>> history(wires, std::vector<float>(samples));
      std::vector<float> strain(samples * lanes);
      for (std::size_t j = 0; j < wires; ++j)
        for (std::size_t t = 0; t < samples; ++t)
          strain[t * lanes + j] = history[j][t] =
              (t == 0 ? 0 : 0.95f * history[j][t - 1]) + noise(engine) + (j % 3 == 0 ? 0.2f : -0.1f);
      LaneScan scan(std::vector<double>(wires, 0.0), gate);
      for (std::size_t from = 0; from < samples; from += half) {
        LaneRun run = scan.next_to_rank();
        run.strain = strain.data() + from * lanes;
        machine->rank_strains(&run, 1, half);
      }
      for (std::size_t j = 0; j < wires; ++j) {
        const std::vector<float> points = filter(history[j], gate).strain;
        double sum = 0, of_ranges = 0, largest = 0;
        for (std::size_t k = 1; k < points.size(); ++k)
          of_ranges += cube(std::abs(points[k] - points[k - 1])),
              sum += cube(std::abs(std::max({points[k - 1], points[k], 0.0f}) * (points[k] - points[k - 1])));
        for (const float point : points) largest = std::max<double>(largest, std::abs(point));
        const StrainMeasures of = scan.measures(j);
        CHECK(of.lowest == *std::min_element(history[j].begin(), history[j].end()));
        CHECK(of.highest == *std::max_element(history[j].begin(), history[j].end()));
        constexpr double rounding = 1e-4;  // some hundred sums of third powers in single precision
        // The scan guesses a wire's first direction. If the wire first goes the other way by less than the gate, the scan misses
        // the first turning point of the list. Its first range then begins at the first sample instead.
        const double next = points.size() > 2 ? std::abs(points[2] - points[1]) : 0.0f;
        const double first = std::max<double>(std::abs(points[1] - points[0]), next) + gate;
        CHECK(std::abs(of.cycle_sum - sum) <=
              rounding * sum + cube(largest * (first + gate)) - cube(largest * std::max(0.0, first - 2 * gate)));
        CHECK(std::abs(of.range_sum - of_ranges) <=
              rounding * of_ranges + cube(first + gate) - cube(std::max(0.0, first - 2 * gate)));
      }
    }
}
