// Strain, counting and damage of every wire on one core, against plain three-point counting of stored histories.
//
// The job: the thesis' dresspack, 6440 wires, in some segments over 2500 samples with swings like those of a robot, all parts
// free. One wire-sample is one wire at one sample. Two motions: `wire_...` is busy: 4.6 % of its wire-samples are turning points
// above the gate, as many as in the most demanding shipped job. `wire_calm_...` has 0.4 %, as many as the two robots.
//   wire_gsamples_per_s            Evaluation (strain, turning points, bounds, probes) and DamageCounter.
//   wire_strain_gsamples_per_s     Evaluation alone.
//   wire_scan_gsamples_per_s       Its part that finds strains and turning points in memory: no bounds, no probes,
//                                  no tables of sites.
//   wire_reference_gsamples_per_s  Every sample of stored histories through a turning-point test, a stack, two
//                                  comparisons and a sum of ranges: no strain, no damage. The fastest public
//                                  counters do this.
// The instruction set is the widest one, or the one named by DRESSLIFE_KERNELS.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "fatigue/damage.h"
#include "strain/evaluation.h"
#include "tests/bench/best_seconds.h"
#include "tests/strain/dresspacks.h"

namespace {

using namespace dresslife;

constexpr std::size_t segments = 6, samples = 2500;

/// Returns moves of about two seconds between poses, each followed by a swing of the dresspack. size: of the moves.
strain::DeformationHistory moving(double size) {
  strain::DeformationHistory history(segments, samples);
  for (std::size_t i = 0; i < segments; ++i)
    for (std::size_t t = 0; t < samples; ++t) {
      const double x = (i + 0.5) / segments, time = 0.04 * t, since = std::fmod(time, 2.0);
      const double swing = 0.2 * std::exp(-2 * since) * std::sin(9 * since);
      history.set(
          i, t,
          {size * (2 * std::sin(6 * x + 0.7 * time) + 1 + swing), size * (2 * std::cos(3 * x - 0.5 * time) + swing),
           size * 3 * std::sin(0.3 * time + x), size * 1e-4 * std::sin(time)});
    }
  return history;
}

/// Counts ranges: a turning-point test of every sample, then three-point counting.
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

pipeline::Material copper() {  // S. Backman's thesis (2018), table 2
  pipeline::Material material;
  material.youngs_modulus = 117e9;
  material.fatigue_strength = 983e6;
  material.fatigue_strength_exponent = -0.112;
  material.fatigue_ductility = 2.43;
  material.fatigue_ductility_exponent = -0.6;
  return material;
}

volatile double keep = 0;

class Bench {
 public:
  explicit Bench(double size) : history_(moving(size)) { settings_.slip = {pipeline::Slip::free}; }

  /// Computes strain and damage; without `damage` only strain.
  void evaluate(bool damage) {
    strain::Evaluation evaluation(construction_, settings_, lengths_, samples);
    sites_ = static_cast<double>(evaluation.sites());
    points_ = 0;
    evaluation.add({history_});
    strain::Sink sink;
    sink.bound_free = sink.bound_stick = [](const strain::SiteRows&) {};
    sink.probe = [](const strain::Probe&) {};
    sink.sites = [&](const strain::SiteRows& rows) {
      points_ += static_cast<double>(rows.strain.size());
      if (!damage) return;
      lists_.clear();
      std::size_t first = 0;
      for (std::size_t site = 0; site < rows.segment.size(); first += rows.turning[site++])
        lists_.push_back({rows.strain.data() + first, static_cast<std::size_t>(rows.turning[site])});
      damage_.resize(lists_.size());
      counter_(lists_, damage_, workspace_);
      keep = keep + damage_.back();
    };
    for (std::size_t i = 0; i < segments; ++i) evaluation.evaluate(i, history_, i, sink);
  }

  /// Computes strains and turning points only.
  void scan() {
    strain::BundleScan scan(construction_, {1, static_cast<float>(settings_.gate), false, false});
    const auto plan = strain::plan_slip(construction_, settings_.slip, 0.3 * segments);
    const std::vector<double> clamp_strain(strain::padded(samples), 1e-4);
    strain::PartStates cable;
    for (std::size_t i = 0; i < segments; ++i)
      for (const strain::Bundle& bundle : construction_.bundles()) {
        const double arc = 0.3 * (static_cast<double>(i) + 0.5);
        const strain::Part& part = construction_.parts()[bundle.part];
        if (part.number == 1) {
          strain::BundleNesting to_cable =
              strain::nesting_to(construction_, plan, part.parent, arc, strain::surface_fibres(1));
          to_cable.order = 1;
          to_cable.steps[0].slide.clamp_strain = clamp_strain.data();
          cable.fill(to_cable, history_.columns(i), samples, false);
        }
        strain::BundleNesting nesting =
            strain::nesting_to(construction_, plan, bundle.part, arc, strain::surface_fibres(1));
        for (const int layer : bundle.wire_layers)
          strain::add_wire_layer(construction_, plan, nesting, layer, bundle.part, arc);
        strain::BundlePointers from = pointers(nesting);
        cable.lend(from);
        scan.run(bundle, plan, from, false, history_.columns(i), samples);
      }
  }

  void print(const char* name) {
    const double whole = best_seconds([&] { evaluate(true); });
    const double strain_alone = best_seconds([&] { evaluate(false); });
    const double scan_alone = best_seconds([&] { scan(); });
    const auto line = [&](const char* what, double seconds) {
      std::printf("%s%s_per_s %.3f\n", name, what, sites_ * samples / seconds * 1e-9);
    };
    line("_gsamples", whole);
    line("_strain_gsamples", strain_alone);
    line("_scan_gsamples", scan_alone);
    std::printf("%s_turning_percent %.2f\n", name, 100 * points_ / (sites_ * samples));
  }

  const strain::DeformationHistory& history() const { return history_; }

 private:
  const strain::Construction construction_{test_dresspacks::thesis_dresspack(), pipeline::Kinematics::exact};
  const std::vector<double> lengths_ = std::vector<double>(segments, 0.3);
  strain::DeformationHistory history_;
  pipeline::Strain settings_;
  const fatigue::DamageCounter counter_{copper(), {}};
  fatigue::DamageCounter::Workspace workspace_;
  std::vector<fatigue::StrainList> lists_;
  std::vector<double> damage_;
  double sites_ = 0, points_ = 0;
};

/// Returns the seconds per sample of the reference, over histories like those of wires.
double reference(const strain::DeformationHistory& history) {
  std::vector<std::vector<float>> stored(2000, std::vector<float>(samples));
  for (std::size_t k = 0; k < stored.size(); ++k)
    for (std::size_t t = 0; t < samples; ++t) {
      const strain::DeformationColumns c = history.columns(k % segments);
      const double angle = 0.1 * static_cast<double>(k);
      stored[k][t] =
          static_cast<float>(0.003 * (c.curvature1[t] * std::sin(angle) - c.curvature2[t] * std::cos(angle)));
    }
  return best_seconds([&] {
           for (const auto& wire : stored) keep = keep + three_point_ranges(wire);
         }) /
         static_cast<double>(stored.size() * samples);
}

}  // namespace

int main() {
  constexpr double busy = 1, calm = 0.12;
  Bench(calm).print("wire_calm");
  Bench bench(busy);
  bench.print("wire");
  std::printf("wire_reference_gsamples_per_s %.3f\n", 1e-9 / reference(bench.history()));
}
