// Strain, counting and damage of every wire on one core, against plain three-point counting of stored
// histories.
//
// The job: the thesis' dresspack, 6440 wires, in some segments over 2500 samples that swing as a robot's do,
// all free. wire_gsamples_per_s: wires times samples over the time of Evaluation (turning points, bounds and
// probes included) and DamageCounter. wire_reference_gsamples_per_s: every sample of stored histories through
// a turning-point test, a stack and two comparisons, ranges summed: no strain, no damage; what the fastest
// public counters do. wire_strain_gsamples_per_s: Evaluation alone. machines: the same with each instruction
// set are in the tests, not here.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <memory>
#include <vector>

#include "fatigue/damage.h"
#include "strain/evaluation.h"
#include "tests/strain/dresspacks.h"

namespace {

using namespace dresslife;

constexpr std::size_t segments = 6, samples = 2500;

/// Moves of about two seconds between poses, a swing of the dresspack after each.
strain::DeformationHistory moving() {
  strain::DeformationHistory history(segments, samples);
  for (std::size_t i = 0; i < segments; ++i)
    for (std::size_t t = 0; t < samples; ++t) {
      const double x = (i + 0.5) / segments, time = 0.04 * t, since = std::fmod(time, 2.0);
      const double swing = 0.2 * std::exp(-2 * since) * std::sin(9 * since);
      history.set(i, t,
                  {2 * std::sin(6 * x + 0.7 * time) + 1 + swing, 2 * std::cos(3 * x - 0.5 * time) + swing,
                   3 * std::sin(0.3 * time + x), 1e-4 * std::sin(time)});
    }
  return history;
}

/// Every sample through a turning-point test, then three-point counting.
float three_point_ranges(const std::vector<float>& history) {
  static std::vector<float> open;
  open.clear();
  float sum = 0, last = history[0], before = history[0];
  auto turn = [&](float next) {
    while (open.size() >= 3) {
      const float top = open.back(), below = open[open.size() - 2];
      if (std::fabs(next - top) < std::fabs(top - below)) break;
      sum += std::fabs(top - below);
      open.resize(open.size() - 2);
    }
    open.push_back(next);
  };
  for (const float x : history) {
    if ((x - last) * (last - before) < 0) turn(last);
    if (x != last) {
      before = last;
      last = x;
    }
  }
  turn(last);
  return sum;
}

double best_seconds(const std::function<void()>& work) {
  double best = 1e300;
  for (int repeat = 0; repeat < 5; ++repeat) {
    const std::clock_t begin = std::clock();
    work();
    best = std::min(best, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  return best;
}

}  // namespace

int main() {
  const strain::Construction construction(test_dresspacks::thesis_dresspack(), pipeline::Kinematics::exact);
  const strain::DeformationHistory history = moving();
  pipeline::Strain settings;
  settings.slip = {pipeline::Slip::free};
  pipeline::Material copper;  // S. Backman's thesis (2018), table 2
  copper.youngs_modulus = 117e9;
  copper.fatigue_strength = 983e6;
  copper.fatigue_strength_exponent = -0.112;
  copper.fatigue_ductility = 2.43;
  copper.fatigue_ductility_exponent = -0.6;
  const fatigue::DamageCounter counter(copper, {});
  fatigue::DamageCounter::Workspace workspace;
  volatile double keep = 0;

  double sites = 0;
  auto evaluate = [&](bool damage) {
    strain::Evaluation evaluation(construction, settings, std::vector<double>(segments, 0.3), samples);
    sites = static_cast<double>(evaluation.sites());
    evaluation.add(history);
    strain::Sink sink;
    sink.bound_free = sink.bound_stick = [](const strain::SiteRows&) {};
    sink.probe = [](const strain::Probe&) {};
    sink.sites = [&](const strain::SiteRows& rows) {
      std::size_t first = 0;
      for (std::size_t site = 0; site < rows.segment.size(); first += rows.turning[site++])
        if (damage)
          keep = keep + counter(std::span(rows.strain).subspan(first, rows.turning[site]), workspace);
    };
    for (std::size_t i = 0; i < segments; ++i) evaluation.evaluate(i, history, i, sink);
  };
  const double strain_alone = best_seconds([&] { evaluate(false); });
  const double whole = best_seconds([&] { evaluate(true); });

  std::vector<std::vector<float>> stored(2000, std::vector<float>(samples));
  for (std::size_t k = 0; k < stored.size(); ++k)
    for (std::size_t t = 0; t < samples; ++t) {
      const strain::DeformationColumns c = history.columns(k % segments);
      const double angle = 0.1 * static_cast<double>(k);
      stored[k][t] =
          static_cast<float>(0.003 * (c.curvature1[t] * std::sin(angle) - c.curvature2[t] * std::cos(angle)));
    }
  const double reference = best_seconds([&] {
    for (const auto& wire : stored) keep = keep + three_point_ranges(wire);
  });
  std::printf("wire_gsamples_per_s %.3f\n", sites * samples / whole * 1e-9);
  std::printf("wire_strain_gsamples_per_s %.3f\n", sites * samples / strain_alone * 1e-9);
  std::printf("wire_reference_gsamples_per_s %.3f\n",
              static_cast<double>(stored.size()) * samples / reference * 1e-9);
}
