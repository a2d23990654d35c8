#include "strain/loose/line_bench.h"

#include <algorithm>
#include <cassert>

namespace dresslife::strain {
namespace {

// Cables whose iterations at the previous sample differ by less stay in the order of their batches, where the numbers of
// neighbours share a cache line. A sort by each iteration costs 6 % more time (robot 1).
constexpr std::int32_t alike = 8;

/// Rows of cables on the bench that are not copied: one value per lane, and several numbers per node.
constexpr double* LineBatch::*pulls[] = {&LineBatch::strain, &LineBatch::tension, &LineBatch::stiffness};
struct OfNode {
  double* LineBatch::*row;
  std::size_t numbers;
};
constexpr OfNode on_the_way[] = {{&LineBatch::solved, 2}, {&LineBatch::soft, 2},  {&LineBatch::step, 2},
                                 {&LineBatch::from, 2},   {&LineBatch::going, 2}, {&LineBatch::factors, 7}};

}  // namespace

LineBench::LineBench(const HoseLine& hose) {
  bench_.nodes = hose.nodes();
  bench_.lanes = bench_lanes;
  bench_.length = hose.length;
  bench_.spacing = hose.spacing;
  const auto room = [&](std::size_t numbers) {
    rows_.emplace_back().assign(numbers, bench_lanes);
    return rows_.back().data();
  };
  for (const auto row : what_cables_are) bench_.*row = room(1);
  for (const auto row : pulls) bench_.*row = room(1);
  for (const auto row : where_cables_are) bench_.*row = room(2 * bench_.nodes);
  for (const auto row : how_cables_rub) bench_.*row = room(2 * bench_.nodes);
  for (const OfNode& of : on_the_way) bench_.*of.row = room(of.numbers * bench_.nodes);
}

void LineBench::relax(std::span<CableLines* const> lines, int most) {
  const LineBatch& hose = lines.front()->batch();
  bench_.curvature = hose.curvature, bench_.pull = hose.pull, bench_.elongation = hose.elongation;
  waiting_.clear();
  for (CableLines* const of : lines) {
    assert(of->batch().nodes == bench_.nodes);
    for (std::size_t k = 0; k < of->count(); ++k) waiting_.push_back({&of->batch(), k, &of->iterations()[k]});
  }
  std::ranges::stable_sort(waiting_, std::ranges::greater(),
                           [](const WaitingCable& cable) { return *cable.iterations / alike; });
  loose_kernels().relax(bench_, waiting_.data(), waiting_.size(), most);
}

}  // namespace dresslife::strain
