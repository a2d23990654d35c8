// Slip with friction: its limits, its hysteresis, its energy. Shear in the equivalent strain.
#include "strain/friction.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "pipeline/base/constants.h"
#include "pipeline/cable/shares.h"
#include "strain/evaluation.h"
#include "tests/catch.h"
#include "tests/strain/dresspacks.h"

using namespace dresslife;
using namespace dresslife::strain;
using namespace test_dresspacks;
using dresslife::pipeline::Equivalent;
using dresslife::pipeline::Kinematics;
using dresslife::pipeline::Slip;
using Settings = dresslife::pipeline::Strain;

namespace {

constexpr std::size_t segments = 3, samples = 301;

Deformation deformation(std::size_t i, std::size_t t) {
  const double x = (i + 0.5) / segments, y = 2 * pi * t / (samples - 1.0);
  return {3 * std::sin(2 * pi * x + 2 * y) + 2, 3 * std::cos(3 * x - 3 * y), 4 * std::sin(y + x),
          1e-4 * std::sin(5 * y)};
}

DeformationHistory moving() {
  DeformationHistory history(segments, samples);
  for (std::size_t i = 0; i < segments; ++i)
    for (std::size_t t = 0; t < samples; ++t) history.set(i, t, deformation(i, t));
  return history;
}

void rub(std::vector<Component>& components, double friction, double line_load) {
  for (Component& component : components) {
    component.friction = friction;
    component.radial_line_load = line_load;
    rub(component.components, friction, line_load);
  }
}

/// Returns two cables of the thesis' dresspack with two wire layers, all with the same friction.
Dresspack rubbing(double friction, double line_load = 20) {
  Dresspack dresspack = thesis_dresspack();
  dresspack.components[0].count = 2;
  dresspack.components[0].components[0].components.resize(2);
  dresslife::pipeline::Material copper;
  copper.name = "copper";
  copper.youngs_modulus = 117e9;
  dresspack.materials = {copper};
  rub(dresspack.components, friction, line_load);
  return dresspack;
}

struct Results {
  std::vector<float> strain;
  std::vector<std::uint32_t> sample;
  std::vector<std::uint64_t> turning;
  std::vector<Probe> probes;
};

/// Returns the results. Precondition: all samples of `history` have been added.
Results results_of(Evaluation& evaluation, const DeformationHistory& history) {
  if (evaluation.wants_again()) evaluation.add_again(history);
  Results results;
  Sink sink;
  sink.sites = [&](const SiteRows& rows) {
    results.strain.insert(results.strain.end(), rows.strain.begin(), rows.strain.end());
    results.sample.insert(results.sample.end(), rows.sample.begin(), rows.sample.end());
    results.turning.insert(results.turning.end(), rows.turning.begin(), rows.turning.end());
  };
  sink.bound_free = sink.bound_stick = [](const SiteRows&) {};
  sink.probe = [&](const Probe& probe) { results.probes.push_back(probe); };
  for (std::size_t i = 0; i < segments; ++i) evaluation.evaluate(i, history, i, sink);
  return results;
}

/// Evaluates the motion, added in blocks of `block` samples; 0: in one block.
Results evaluate(const Dresspack& dresspack, const Settings& settings, std::size_t block = 0) {
  const Construction construction(dresspack, settings.kinematics);
  const DeformationHistory history = moving();
  Evaluation evaluation(construction, settings, std::vector<double>(segments, 2.0 / segments), samples, 1,
                        part_of_rig());
  for (std::size_t first = 0, size = block == 0 ? samples : block; first < samples; first += size) {
    const std::size_t count = std::min(size, samples - first);
    DeformationHistory part(segments, count);
    for (std::size_t i = 0; i < segments; ++i)
      for (std::size_t t = 0; t < count; ++t) part.set(i, t, deformation(i, first + t));
    evaluation.add({part});
  }
  return results_of(evaluation, history);
}

Settings settings_with(std::vector<Slip> slip, Kinematics kinematics = Kinematics::exact) {
  Settings settings;
  settings.slip = std::move(slip);
  settings.kinematics = kinematics;
  settings.gate = 1e-4;
  settings.probes = {{1, "signal cable 2/conductor 5/layer 2/wire 9"},
                     {2, "signal cable 1/conductor 1/layer 1/wire 30"}};
  return settings;
}

/// Returns the largest difference of the named wires' histories, divided by their largest strain.
double difference(const Results& a, const Results& b) {
  REQUIRE(a.probes.size() >= 2);
  double worst = 0, size = 0;
  // The two probes that the job names come after the worst wires of their segments, so probes are matched by site.
  for (const Probe& p : a.probes)
    for (const Probe& q : b.probes)
      if (p.site == q.site)
        for (std::size_t t = 0; t < samples; ++t) {
          worst = std::max(worst, std::abs(p.strain[t] - q.strain[t]));
          size = std::max(size, std::abs(q.strain[t]));
        }
  REQUIRE(size > 1e-4);
  return worst / size;
}

constexpr double no_friction = 0, endless_friction = 1e6;
constexpr double rounding = 1e-9;       // of strains computed from stretches near one
constexpr double wave_rounding = 2e-6;  // of strains in single precision
// Wires evaluated one by one use their fibre's length (W12) exactly. Waves of glued wires use its product with the strain up to
// the second harmonic. This leaves out half of a second harmonic of 1e-3 times 0.005.
constexpr double third_of_length = 2.5e-6;

}  // namespace

TEST_CASE("endless friction is stick, none is free, on every level and in both kinematics") {
  for (const Kinematics kinematics : {Kinematics::exact, Kinematics::thesis}) {
    const Results stick = evaluate(rubbing(0), settings_with({Slip::stick}, kinematics));
    const Results free = evaluate(rubbing(0), settings_with({Slip::free}, kinematics));
    const Settings friction = settings_with({Slip::friction}, kinematics);
    const Results glued = evaluate(rubbing(endless_friction, 1e6), friction);
    const Results loose = evaluate(rubbing(no_friction), friction);
    CHECK(difference(glued, stick) < rounding);
    CHECK(difference(loose, free) < rounding);
    CHECK(difference(stick, free) > 0.1);
    // all sites have the same turning points, except points within rounding of the gate
    REQUIRE(glued.turning.size() == stick.turning.size());
    REQUIRE(loose.turning.size() == free.turning.size());
    for (const auto& [a, b] : {std::pair(&glued, &stick), std::pair(&loose, &free)}) {
      std::size_t other = 0, at_a = 0, at_b = 0;
      float worst = 0;
      for (std::size_t site = 0; site < a->turning.size(); ++site) {
        if (a->turning[site] != b->turning[site])
          ++other;
        else
          for (std::uint64_t k = 0; k < a->turning[site]; ++k)
            worst = std::max(worst, std::abs(a->strain[at_a + k] - b->strain[at_b + k]));
        at_a += a->turning[site];
        at_b += b->turning[site];
      }
      CHECK(worst < wave_rounding + third_of_length);
      CHECK(other * 1000 < a->turning.size());
    }
  }
}

TEST_CASE("friction gives the same numbers twice, and however the motion comes in blocks") {
  const Settings settings = settings_with({Slip::friction});
  const Results once = evaluate(rubbing(0.5, 300), settings);
  for (const std::size_t block : {0, 7, 64, 299}) {
    const Results again = evaluate(rubbing(0.5, 300), settings, block);
    const bool same = again.strain == once.strain && again.sample == once.sample && again.turning == once.turning;
    CHECK(same);
    REQUIRE(again.probes.size() == once.probes.size());
    for (std::size_t p = 0; p < once.probes.size(); ++p) {
      const bool same_probe =
          again.probes[p].strain == once.probes[p].strain && again.probes[p].shear == once.probes[p].shear;
      CHECK(same_probe);
    }
  }
}

TEST_CASE("what friction holds of a part is the same after any other and lies where that of its level lay") {
  const Dresspack dresspack = rubbing(0.3);
  const Construction construction(dresspack, Kinematics::exact);
  const std::vector<double> lengths(segments, 2.0 / segments), arcs{1.0 / segments, 3.0 / segments, 5.0 / segments};
  ClampMeans means(construction, plan_slip(construction, {Slip::friction}, 2.0), lengths, arcs, samples);
  const DeformationHistory history = moving();
  CablePaths cables(construction, means.plan(), {.rub = true}, lengths, arcs, samples);
  cables.add({history});
  cables.finish();
  CablePaths::Keeper keeper;
  const SegmentMotion& motion = keeper.of(cables, 1, history.columns(1), 0, samples);
  REQUIRE_FALSE(means.needed());
  const int parts = static_cast<int>(construction.parts().size());
  REQUIRE(parts == 2 + 14);

  const auto rows_of = [&](HeldStrains& held, int part) {
    BundleNesting nesting = nesting_to(construction, means.plan(), part, arcs[1], surface_fibres(0));
    means.attach(nesting, part, motion);
    held.attach(nesting, part);
    return nesting;
  };
  HeldStrains one_after_other(construction, means);
  constexpr int conductor_rows = 2, scratch_rows = 3;  // powers, and the data from which they are computed
  CHECK(one_after_other.bytes(samples) == (conductor_rows + scratch_rows) * padded(samples) * sizeof(double));
  std::vector<const double*> place(construction.levels(), nullptr);
  one_after_other.begin(arcs[1], motion);
  std::mt19937 random(7);
  for (int k = 0; k < 100; ++k) {
    const int part = static_cast<int>(random() % parts);
    HeldStrains fresh(construction, means);
    fresh.begin(arcs[1], motion);
    const BundleNesting a = rows_of(one_after_other, part), b = rows_of(fresh, part);
    CHECK(a.steps[0].slide.held == nullptr);  // a cable's friction acts along the cable, not at a point
    for (std::size_t level = 1; level < a.steps.size(); ++level) {
      const double *one = a.steps[level].slide.held, *other = b.steps[level].slide.held;
      REQUIRE((one != nullptr && other != nullptr));
      CHECK(std::equal(one, one + samples, other));
      if (place[level]) CHECK(one == place[level]);  // the memory of one part per level is enough
      place[level] = one;
    }
  }
}

TEST_CASE("friction on some levels has its limits there, whatever the other levels do") {
  // One word of slip per level. Levels without friction have exactly the results of a job without friction.
  using enum Slip;
  const Results reference = evaluate(rubbing(0), settings_with({free}));
  for (const std::vector<Slip>& slip : {std::vector{free, friction, friction},
                                        {friction, free, free},
                                        {stick, friction, free},
                                        {free, stick, friction},
                                        {friction, stick, friction},
                                        {free, friction, stick}}) {
    std::vector<Slip> glued = slip, loose = slip;
    for (Slip& level : glued) level = level == friction ? stick : level;
    for (Slip& level : loose) level = level == friction ? free : level;
    CHECK(difference(evaluate(rubbing(endless_friction, 1e6), settings_with(slip)),
                     evaluate(rubbing(0), settings_with(glued))) < rounding);
    CHECK(difference(evaluate(rubbing(no_friction), settings_with(slip)), evaluate(rubbing(0), settings_with(loose))) <
          rounding);
  }
  // Between the limits: the larger the friction, the closer to stick.
  const Results stuck = evaluate(rubbing(0), settings_with({free, stick, free}));
  double last = 1e9;
  for (const double load : {0.0, 50.0, 200.0, 1000.0, 1e5, 1e7}) {
    const double away = difference(evaluate(rubbing(0.5, load), settings_with({free, friction, free})), stuck);
    CHECK(away <= last * (1 + rounding));
    last = away;
  }
  CHECK(last < rounding);
}

TEST_CASE("straight parts that slide in a straight part that rubs: its strain counts at its mean") {
  // Tests the approximation of the means along the dresspack. Its error is of second order: the deviations of the rubbing part
  // from its mean cancel along the dresspack, except their product with the curvature. (R k)^2 is 0.009 at 18 mm and 5 1/m.
  // Measured: 0.007.
  using enum Slip;
  auto straight = [](double friction, double load) {
    Dresspack dresspack = rubbing(friction, load);
    dresspack.components[0].components[0].lay_angle = 0;
    for (Component& wire : dresspack.components[0].components[0].components) wire.lay_angle = 0;
    return dresspack;
  };
  const Results exact = evaluate(straight(0, 0), settings_with({stick, free, free}));
  const Results mean = evaluate(straight(endless_friction, 1e6), settings_with({friction, free, free}));
  constexpr double second_order = 0.01;  // of the largest strain
  CHECK(difference(mean, exact) < second_order);
  CHECK(difference(evaluate(straight(no_friction, 0), settings_with({friction, free, free})),
                   evaluate(straight(0, 0), settings_with({free}))) < rounding);
}

TEST_CASE("a wire that rubs loses energy in every repeat of the motion, end to end") {
  // The parents are glued. The wire's deviation from its mean is stick minus free. The held part of it is friction minus free.
  using enum Slip;
  auto axis = [](std::vector<Slip> slip) {
    Settings settings = settings_with(std::move(slip));
    settings.surface_fibres = 0;
    return settings;
  };
  const Results held = evaluate(rubbing(0.5, 300), axis({stick, stick, friction}));
  const Results glued = evaluate(rubbing(0), axis({stick, stick, stick})),
                loose = evaluate(rubbing(0), axis({stick, stick, free}));
  double most = 0;
  int compared = 0;
  for (const Probe& probe : held.probes)
    for (const Probe& stuck : glued.probes)
      for (const Probe& slid : loose.probes) {
        if (probe.site != stuck.site || probe.site != slid.site) continue;
        double lost = 0, swing = 0;
        for (std::size_t t = 1; t < samples; ++t) {
          const auto deviation = [&](std::size_t at) { return stuck.strain[at] - slid.strain[at]; };
          const double force = probe.strain[t] - slid.strain[t];
          const double before = probe.strain[t - 1] - slid.strain[t - 1];
          const double slip = (deviation(t) - force) - (deviation(t - 1) - before);
          CHECK(force * slip >= -1e-18);  // friction only dissipates: implicit return mapping, step by step
          lost += force * slip;
          swing = std::max(swing, std::abs(deviation(t)));
        }
        CHECK(lost >= 0);
        most = std::max(most, lost / (swing * swing));
        ++compared;
      }
  CHECK(compared >= 2);
  CHECK(most > 0.01);  // some wires slide
}

TEST_CASE("straight wires in a helical conductor, too, stick by endless friction and slide without") {
  auto straight = [](double friction, double load) {
    Dresspack dresspack = rubbing(friction, load);
    for (Component& wire : dresspack.components[0].components[0].components) wire.lay_angle = 0;
    return dresspack;
  };
  const Settings friction = settings_with({Slip::friction});
  CHECK(difference(evaluate(straight(endless_friction, 1e6), friction),
                   evaluate(straight(0, 0), settings_with({Slip::stick}))) < rounding);
  CHECK(difference(evaluate(straight(no_friction, 0), friction),
                   evaluate(straight(0, 0), settings_with({Slip::free}))) < rounding);
  // A stuck conductor with sliding wires: the turned ancestors are stuck as well.
  Dresspack mixed = straight(no_friction, 0);
  mixed.components[0].friction = mixed.components[0].components[0].friction = endless_friction;
  mixed.components[0].radial_line_load = mixed.components[0].components[0].radial_line_load = 1e6;
  CHECK(difference(evaluate(mixed, friction),
                   evaluate(straight(0, 0), settings_with({Slip::stick, Slip::stick, Slip::free}))) < rounding);
}

TEST_CASE("sites and probes agree where friction holds some of the strain") {
  Settings settings = settings_with({Slip::friction});
  settings.gate = 0;
  for (const Equivalent equivalent : {Equivalent::axial, Equivalent::shear_included}) {
    settings.equivalent = equivalent;
    const Results results = evaluate(rubbing(0.5, 300), settings);
    const Results free = evaluate(rubbing(0), settings_with({Slip::free}));
    CHECK(difference(results, free) > 0.02);
    std::vector<std::size_t> begin(1, 0);
    for (const std::uint64_t count : results.turning) begin.push_back(begin.back() + count);
    // The error of the waves (W13), and the effect of this error on the slip of a slider at its cap.
    constexpr double wave_tolerance = 1e-3;
    for (const Probe& probe : results.probes) {
      const auto [low, high] = std::minmax_element(probe.strain.begin(), probe.strain.end());
      for (std::size_t k = begin[probe.site]; k < begin[probe.site + 1]; ++k)
        REQUIRE(std::abs(results.strain[k] - probe.strain[results.sample[k]]) < wave_tolerance * (*high - *low));
    }
  }
}

TEST_CASE("the cap of a helix is Papailiou's") {
  Dresspack dresspack = rubbing(0.4, 70);
  dresspack.components[0].components[0].tension = 11;
  const Construction construction(dresspack, Kinematics::exact);
  const auto plan = plan_slip(construction, {Slip::friction}, 2.0);
  const Layer& conductor = construction.layers()[1];
  const double alpha = 25 * degree, R = 0.002825, sine = std::sin(alpha), cosine = std::cos(alpha);
  // wires of the two layers: E A cos^3 per wire
  const double stiffness = 56 * 117e9 * pi * 75e-6 * 75e-6 * std::pow(std::cos(5 * degree), 3);
  CHECK(conductor.axial_stiffness == Approx(stiffness));
  for (const double mean : {0.0, 1e-4}) {
    const double T = 11 + stiffness * mean;
    const double k_slip = 0.4 * (70 + T * sine * sine / R) / (stiffness * cosine * cosine * sine);
    CHECK(cap_at(plan[1].cap, mean) == Approx(pi / 2 * k_slip * R * cosine * cosine));
  }
  CHECK(cap_at(plan[1].cap, -1.0) == 0);
  // along a cable friction acts node by node (sliding_line_test): the cable has no cap
  CHECK_FALSE(plan[0].friction);
}

TEST_CASE("closed loops of a slider lose energy and never gain it") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> part(-1, 1);
  double most_lost = 0;
  for (int loop = 0; loop < 500; ++loop) {
    // any closed path of the deviation, with a cap that changes along it
    const double cap = 0.3 * std::abs(part(random));
    std::vector<double> path(40);
    for (double& value : path) value = part(random);
    path.push_back(path.front());
    Slider slider;
    slider.next(path.front(), cap);
    double held = slider.next(path.front(), cap), stored = held * held / 2, work = 0, before = path.front();
    for (std::size_t k = 1; k < path.size(); ++k) {
      const double now = slider.next(path[k], cap * (1 + 0.5 * part(random)));
      work += now * (path[k] - before);
      // Work that is not stored is dissipated. Implicit return mapping dissipates in every step.
      const double lost = work - (now * now / 2 - stored);
      REQUIRE(lost >= -1e-12);
      before = path[k];
    }
    most_lost = std::max(most_lost, work);
    CHECK(work - (slider.next(path.back(), cap) * slider.next(path.back(), cap) / 2 - stored) >= -1e-12);
  }
  CHECK(most_lost > 0.1);
  // A triangle wave of amplitude a > cap gives a parallelogram of area 4 cap (a - cap).
  Slider slider;
  const double cap = 0.2, amplitude = 1;
  constexpr int steps = 1000;
  double work = 0, before = 0, held_before = 0;
  auto move = [&](double from, double to, bool count) {
    for (int k = 1; k <= steps; ++k) {
      const double now = from + (to - from) * k / steps, held = slider.next(now, cap);
      if (count) work += (held + held_before) / 2 * (now - before);
      before = now;
      held_before = held;
    }
  };
  move(0, amplitude, false);
  move(amplitude, -amplitude, true);
  move(-amplitude, amplitude, true);
  constexpr double corners = 1e-3;  // trapezoids cut the corners at the begin of sliding
  CHECK(work == Approx(4 * cap * (amplitude - cap)).epsilon(corners));
}

TEST_CASE("a slider's slip at the end of a repeat is found backward from its last samples") {
  constexpr double glued = std::numeric_limits<double>::infinity();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> part(-1, 1);
  for (const double most : {0.0, 0.1, 0.8, 3.0, glued}) {  // 3: no sample slides
    INFO("cap up to " << most);
    for (int history = 0; history < 50; ++history) {
      std::vector<double> deviation(100), cap(100);
      for (double& of : deviation) of = part(random);
      for (double& of : cap) of = most == 0 || most == glued ? most : most * (1 - 0.3 * std::abs(part(random)));
      Slider slider;
      for (std::size_t t = 0; t < 100; ++t) slider.next(deviation[t], cap[t]);
      const double found = settled_slip(
          100, [&](std::size_t t) { return deviation[t]; }, [&](std::size_t t) { return cap[t]; });
      CHECK(found == slider.slip());  // the same limit of the same sample; slip is not rounded while the slider sticks
    }
  }
}

TEST_CASE("a motion's slip settles: the strain at its end leads on to that at its start") {
  // The motion is closed, so a settled slider returns to its state. The first sample follows from the last.
  const Results results = evaluate(rubbing(0.5, 300), settings_with({Slip::friction}));
  for (const Probe& probe : results.probes) CHECK(std::abs(probe.strain.front() - probe.strain.back()) < 1e-12);
}

TEST_CASE("slip that only the beginning of a motion makes is found from its end") {
  // Wide swings, then small ones in which most wires stick. The samples fill more than one block of the kernels.
  constexpr std::size_t wide = 60;
  DeformationHistory history(segments, samples);
  for (std::size_t i = 0; i < segments; ++i)
    for (std::size_t t = 0; t < samples; ++t) {
      Deformation of = deformation(i, t);
      if (t >= wide) of.curvature1 *= 0.02, of.curvature2 *= 0.02, of.twist *= 0.02, of.elongation *= 0.02;
      history.set(i, t, of);
    }
  const Dresspack dresspack = rubbing(0.5, 300);
  const Construction construction(dresspack, Kinematics::exact);
  Evaluation evaluation(construction, settings_with({Slip::friction}), std::vector<double>(segments, 2.0 / segments),
                        samples);
  evaluation.add({history});
  const Results results = results_of(evaluation, history);
  REQUIRE(results.probes.size() >= 2);
  // Probes go through the motion twice, from its begin and in double precision.
  for (const Probe& probe : results.probes) {
    const auto site = static_cast<std::ptrdiff_t>(probe.site);
    std::uint64_t k = std::accumulate(results.turning.begin(), results.turning.begin() + site, std::uint64_t{0});
    const auto [low, high] = std::ranges::minmax(probe.strain);
    constexpr double waves = 2e-4;  // of the range: (W13) with friction, and single precision
    for (const std::uint64_t end = k + results.turning[probe.site]; k < end; ++k)
      CHECK(std::abs(results.strain[k] - probe.strain[results.sample[k]]) < waves * (high - low));
  }
}

TEST_CASE("shear of a wire's torsion: sqrt(3) of a twisted straight wire's, signed as the strain") {
  Dresspack dresspack;
  Component wire = wires("", 1, 0.001, 0, 0, Hand::right);
  wire.helix_radius = 0;
  dresspack.components = {wire};
  const Construction construction(dresspack, Kinematics::exact);
  Settings settings;
  settings.slip = {Slip::stick};
  settings.gate = 0;
  settings.surface_fibres = 0;
  settings.equivalent = Equivalent::shear_included;
  DeformationHistory history(1, 3);
  history.set(0, 1, {0, 0, 2.0, 1e-3});
  history.set(0, 2, {0, 0, -2.0, -1e-3});
  Evaluation evaluation(construction, settings, {0.5}, 3);
  evaluation.add({history});
  std::vector<double> strain;
  std::vector<float> turning;
  Sink sink;
  sink.sites = [&](const SiteRows& rows) { turning = rows.strain; };
  sink.bound_free = sink.bound_stick = [](const SiteRows&) {};
  sink.probe = [&](const Probe& probe) { strain = probe.strain; };
  evaluation.evaluate(0, history, 0, sink);
  const double gamma = 0.001 * 2.0, equivalent = std::sqrt(1e-6 + gamma * gamma / 3);
  REQUIRE(strain.size() == 3);
  CHECK(strain[1] == Approx(equivalent));
  CHECK(strain[2] == Approx(-equivalent));
  REQUIRE(turning.size() == 3);
  CHECK(turning[1] == Approx(equivalent));
  CHECK(turning[2] == Approx(-equivalent));

  // With planes, both parts of the same wire are returned. The count of cycles does not change.
  settings.equivalent = Equivalent::critical_plane;
  Evaluation planes(construction, settings, {0.5}, 3);
  planes.add({history});
  std::vector<double> shear_of_probe;
  std::vector<FibreHistory> fibres;
  sink.probe = [&](const Probe& probe) { shear_of_probe = probe.shear; };
  sink.fibre = [&](const FibreHistory& fibre) { fibres.push_back(fibre); };
  planes.evaluate(0, history, 0, sink);
  CHECK(turning[1] == Approx(equivalent));
  REQUIRE(fibres.size() == 1);
  CHECK(fibres[0].site == 0);
  CHECK(fibres[0].strain[1] == Approx(1e-3));
  CHECK(fibres[0].strain[2] == Approx(-1e-3));
  CHECK(fibres[0].shear[1] == Approx(gamma));
  CHECK(fibres[0].shear[2] == Approx(-gamma));
  CHECK(shear_of_probe == fibres[0].shear);
}

TEST_CASE("the hose's wall: stretch, bending and twist of a tube, times its corrugation's factor") {
  Dresspack dresspack = thesis_dresspack();
  dresspack.components[0].count = 1;
  dresspack.diameter = 0.06;
  dresspack.hose_material = "polyamide";
  dresspack.hose_strain_factor = 0.5;
  const double R = 0.03, curvature = 4, twist = 3, stretch = 1e-3;
  for (const Equivalent equivalent : {Equivalent::axial, Equivalent::shear_included}) {
    const Construction construction(dresspack, Kinematics::exact);
    Settings settings;
    settings.slip = {Slip::free};
    settings.gate = 0;
    settings.equivalent = equivalent;
    DeformationHistory history(1, 2);
    history.set(0, 1, {curvature, 0, twist, stretch});
    Evaluation evaluation(construction, settings, {0.5}, 2);
    evaluation.add({history});
    int places = 0;
    float highest = 0;
    Sink sink;
    sink.sites = [&](const SiteRows& rows) {
      std::size_t first = 0;
      for (std::size_t site = 0; site < rows.segment.size(); first += rows.turning[site++])
        if (rows.material[site] == "polyamide") {
          CHECK(rows.component[site] == "hose " + std::to_string(++places));
          CHECK(rows.fibre[2 * site] == 0);
          highest = std::max(highest, rows.strain[first + rows.turning[site] - 1]);
        }
    };
    sink.bound_free = sink.bound_stick = [](const SiteRows&) {};
    sink.probe = [](const Probe&) {};
    evaluation.evaluate(0, history, 0, sink);
    CHECK(places == hose_places);
    const double along = 1 + stretch + R * curvature, fibre = 0.5 * (std::hypot(along, R * twist) - 1);
    const double gamma = 0.5 * R * twist * (1 + stretch) / std::hypot(along, R * twist);
    const double expected = equivalent == Equivalent::axial ? fibre : std::sqrt(fibre * fibre + gamma * gamma / 3);
    constexpr double third_harmonic = 1e-3;  // of the shear of an inclined fibre
    CHECK(highest == Approx(expected).epsilon(third_harmonic));
  }
}

namespace {

/// Returns the largest difference of the probed wires' turning points (waves in single precision) from their histories (wire
/// by wire in double precision), divided by the largest strain.
double off_their_probes(const Results& results) {
  double worst = 0, size = 0;
  std::vector<std::size_t> first{0};
  for (const std::uint64_t turning : results.turning) first.push_back(first.back() + turning);
  for (const Probe& probe : results.probes)
    for (std::size_t k = first[probe.site]; k < first[probe.site + 1]; ++k) {
      const double strain = probe.strain[results.sample[k]];
      worst = std::max(worst, std::abs(results.strain[k] - strain));
      size = std::max(size, std::abs(strain));
    }
  REQUIRE(size > 1e-4);
  return worst / size;
}

// Waves leave out the third harmonic, 1e-4 of the range (evaluation_test.cpp). Sliders can enlarge it.
constexpr double third_harmonic = 1e-3;

void press_on(std::vector<Component>& components, double radial_stiffness) {
  for (Component& component : components) {
    component.radial_stiffness = radial_stiffness;
    press_on(component.components, radial_stiffness);
  }
}

void fill_gussets(std::vector<Component>& components, double jacket_stiffness) {
  for (Component& component : components) {
    component.jacket_stiffness = jacket_stiffness;
    fill_gussets(component.components, jacket_stiffness);
  }
}

}  // namespace

TEST_CASE("a jacket that gives nothing holds all, and one that gives holds its share of the deviation") {
  const Settings stick = settings_with({Slip::stick}), rubs = settings_with({Slip::friction});
  Dresspack dresspack = rubbing(0);
  fill_gussets(dresspack.components, 1e20);
  CHECK(difference(evaluate(dresspack, rubs), evaluate(rubbing(0), stick)) < 1e-9);
  fill_gussets(dresspack.components, 1e9);
  CHECK(off_their_probes(evaluate(dresspack, rubs)) < third_harmonic);
  // Other kinds of slip do not use the jacket's stiffness.
  for (const Slip slip : {Slip::stick, Slip::free})
    CHECK(evaluate(dresspack, settings_with({slip})).strain == evaluate(rubbing(0), settings_with({slip})).strain);

  CHECK(elastic_share(0, 2000, 0.05) == 0);
  // The deviation eps(x) = A sin(2 pi x/s) of a bar (E A) on a spring bed (k): E A u'' = k (u - u_parent) with
  // u_parent' = eps gives u' = A k/(k + E A (2 pi/s)^2) sin(2 pi x/s).
  const double k = 3e7, EA = 2000, s = 0.05, waves = 2 * pi / s, step = 1e-5;
  const double share = elastic_share(k, EA, s);
  const auto own = [&](double x) { return -share / waves * std::cos(waves * x); };
  const auto parent = [&](double x) { return -1 / waves * std::cos(waves * x); };
  for (const double x : {0.004, 0.011, 0.03}) {
    const double curve = (own(x + step) - 2 * own(x) + own(x - step)) / (step * step);
    CHECK(EA * curve == Approx(k * (own(x) - parent(x))).epsilon(1e-5));  // (2 pi step / s)^2 / 12
  }
}

TEST_CASE("only wires in a jacket: the strain between free and stuck is the jacket's share") {
  // The axis of wires that slide over their pitch in one straight cable that sticks.
  Settings settings = settings_with({Slip::stick, Slip::stick, Slip::friction});
  settings.surface_fibres = 0;
  Dresspack dresspack = rubbing(0);
  Component& wire = dresspack.components[0].components[0].components[1];
  wire.hand = Hand::right;  // same hand as its conductor: the wire turns by the sum
  wire.jacket_stiffness = 4e7;
  const Results in_jacket = evaluate(dresspack, settings);
  settings.slip[2] = Slip::stick;
  const Results stuck = evaluate(dresspack, settings);
  settings.slip[2] = Slip::free;
  const Results free = evaluate(dresspack, settings);
  const double EA = 117e9 * pi * std::pow(wire.radius, 2);
  const double turns = turning(turning(0, 25 * degree, 0.002825), 5 * degree, wire.helix_radius);
  const double share = elastic_share(4e7, EA, evening_length(turns, 2.0));
  CHECK(share > 0.05);
  CHECK(share < 0.95);
  int compared = 0;
  for (const Probe& probe : in_jacket.probes)
    for (const Probe& of_stuck : stuck.probes)
      for (const Probe& of_free : free.probes) {
        if (probe.site != of_stuck.site || probe.site != of_free.site) continue;
        const std::size_t per_cable = 7 * (31 + 25), per_conductor = 31 + 25;
        if (probe.site % (2 * per_cable) % per_conductor < 31) continue;  // wires of the other layer
        for (std::size_t t = 0; t < samples; ++t)
          CHECK(probe.strain[t] ==
                Approx(of_free.strain[t] + share * (of_stuck.strain[t] - of_free.strain[t])).margin(1e-12));
        ++compared;
      }
  CHECK(compared > 0);
}

TEST_CASE("a helix keeps its share of strain where its bed gives") {
  // The shipped conductors: E A sin^4/R^2 = 7.5e8 N/m2.
  const double EA = 92 * 117e9 * pi * 75e-6 * 75e-6 * std::pow(std::cos(5 * degree), 3);
  CHECK(EA * std::pow(std::sin(25 * degree), 4) / std::pow(0.002825, 2) == Approx(7.5e8).epsilon(0.01));
  constexpr double printed = 0.03;  // of two digits
  CHECK(radial_share(EA, 25 * degree, 0.002825, 1e8) == Approx(0.12).epsilon(printed));
  CHECK(radial_share(EA, 25 * degree, 0.002825, 3e8) == Approx(0.29).epsilon(printed));
  CHECK(radial_share(EA, 25 * degree, 0.002825, 1e9) == Approx(0.57).epsilon(printed));
  CHECK(radial_share(EA, 25 * degree, 0.002825, HUGE_VAL) == 1);
  CHECK(radial_share(EA, 0, 0, 1e9) == 1);
  // Equilibrium of a helix that is stretched by e and yields radially by u: its tension presses with T sin^2/R per length, and
  // the remaining strain causes this tension.
  const double a = 25 * degree, R = 0.002825, e = 1e-3, k = 3e8;
  const double left = std::pow(std::cos(a), 2) * e * radial_share(EA, a, R, k);
  const double give = EA * left * std::pow(std::sin(a), 2) / R / k;
  CHECK(left == Approx(std::pow(std::cos(a), 2) * e - std::pow(std::sin(a), 2) * give / R));
}

TEST_CASE("a bed that gives takes its share of conductors and wires in every way of sliding") {
  using enum Slip;
  for (const std::vector<Slip>& slip :
       {std::vector{stick}, {free}, {friction}, {free, stick, free}, {stick, free, stick}, {free, friction, stick}}) {
    CAPTURE(static_cast<int>(slip[0]), slip.size());
    Settings settings = settings_with(slip);
    Dresspack dresspack = rubbing(0.3);
    const Results rigid = evaluate(dresspack, settings);
    press_on(dresspack.components, 1e15);
    CHECK(difference(evaluate(dresspack, settings), rigid) < 1e-5);  // 7.5e8 / 1e15, and the slip that it causes
    press_on(dresspack.components, 3e8);
    const Results soft = evaluate(dresspack, settings);
    CHECK(off_their_probes(soft) < third_harmonic);
    settings.equivalent = Equivalent::shear_included;  // wires put together one by one
    CHECK(off_their_probes(evaluate(dresspack, settings)) < third_harmonic);
  }
  // Tension only: the remaining strain of the wires is the product of both helices' shares.
  const auto strain_of_pulled = [](const Dresspack& dresspack, Slip slip) {
    const Construction construction(dresspack, Kinematics::exact);
    Settings settings = settings_with({slip});
    settings.surface_fibres = 0;
    const bool in_cable = dresspack.components[0].name == "signal cable";
    settings.probes = {{1, (in_cable ? "signal cable 1/" : std::string()) + "conductor 1/layer 1/wire 1"}};
    Evaluation evaluation(construction, settings, {2.0}, 2);
    DeformationHistory history(1, 2);
    history.set(0, 0, {0, 0, 0, 0});
    history.set(0, 1, {0, 0, 0, 1e-5});
    evaluation.add({history});
    double strain = 0;
    Sink sink;
    sink.sites = sink.bound_free = sink.bound_stick = [](const SiteRows&) {};
    sink.probe = [&](const Probe& probe) { strain = probe.strain[1]; };
    evaluation.evaluate(0, history, 0, sink);
    return strain;
  };
  // Where all wires slide: glued wires would also feel the bending of their conductor.
  Dresspack dresspack = rubbing(0.3);
  const double rigid = strain_of_pulled(dresspack, free);
  press_on(dresspack.components, 3e8);
  const Construction construction(dresspack, Kinematics::exact);
  double share = 1;
  for (const int layer : {1, 2}) {
    const Layer& of = construction.layers()[layer];
    share *= radial_share(of.axial_stiffness, of.lay_angle, of.helix_radius, 3e8);
  }
  // The conductor's twist does not change in proportion to its stretch: the difference is 5e-4 rad/m, which changes the strain of
  // its wires by R^2 x 19 rad/m of it.
  constexpr double twisting = 2.5e-3;
  CHECK(strain_of_pulled(dresspack, free) == Approx(share * rigid).epsilon(twisting));
  // A dresspack that is a cable has the conductors at its first level: it is pulled like a cable in a hose.
  Dresspack alone = dresspack;
  alone.components = dresspack.components[0].components;
  CHECK(strain_of_pulled(alone, free) == Approx(share * rigid).epsilon(twisting));
}

TEST_CASE(
    "the length over which a hose's bend changes is the wave of a sine along it, whatever its amplitude and its mean") {
  constexpr std::size_t pieces = 64, moments = 9;
  constexpr double whole = 2, wave = 0.5;  // [m]
  const Construction construction(rubbing(0.3), Kinematics::exact);
  for (const double amplitude : {0.1, 3.0}) {
    Evaluation evaluation(construction, settings_with({Slip::friction}), std::vector<double>(pieces, whole / pieces),
                          moments);
    DeformationHistory history(pieces, moments);
    for (std::size_t i = 0; i < pieces; ++i)
      for (std::size_t t = 0; t < moments; ++t) {
        const double z = whole * (static_cast<double>(i) + 0.5) / pieces,
                     w = 2 * pi * static_cast<double>(t) / (moments - 1);
        history.set(
            i, t,
            {2 + amplitude * std::sin(w) * std::sin(2 * pi * z / wave), 0, 0, 0});  // a constant bend does not count
      }
    evaluation.add({history});
    evaluation.end_first_pass();
    // Differences of segments of h miss (pi h/wave)^2/6 of the slope, 0.6 %, and the half segments at the ends, where the slope is
    // largest, another h/whole of it, 1.6 %.
    CHECK(evaluation.evening().bend_wave == Approx(wave).epsilon(0.025));
  }
}

TEST_CASE(
    "with friction every fibre of a wire has the turning points of its own history, whatever the number of fibres") {
  const DeformationHistory history = moving();
  const Dresspack dresspack = rubbing(0.4, 100);
  const Construction construction(dresspack, Kinematics::exact);
  for (const int fibres : {0, 3, 5}) {
    Settings settings = settings_with({Slip::friction});
    settings.surface_fibres = fibres;
    Evaluation evaluation(construction, settings, std::vector<double>(segments, 2.0 / segments), samples);
    evaluation.add({history});
    if (evaluation.wants_again()) evaluation.add_again(history);
    dresslife::strain::SiteRows rows;
    Sink sink;
    sink.sites = [&](const dresslife::strain::SiteRows& of) {
      rows.strain.insert(rows.strain.end(), of.strain.begin(), of.strain.end());
      rows.turning.insert(rows.turning.end(), of.turning.begin(), of.turning.end());
    };
    sink.bound_free = sink.bound_stick = [](const dresslife::strain::SiteRows&) {};
    sink.probe = [](const Probe&) {};
    evaluation.evaluate(0, history, 0, sink);
    std::vector<Evaluation::Site> sites;
    const auto each = static_cast<std::size_t>(std::max(1, fibres));
    const std::size_t wires = evaluation.sites() / segments / each;
    for (std::size_t wire = 0; wire < wires; wire += 5)
      for (std::size_t fibre = 0; fibre < each; ++fibre) sites.push_back({wire, static_cast<int>(fibre)});
    const auto alone = evaluation.varied(sites, {1.0}, 0, history, 0).front();
    REQUIRE(rows.turning.size() == wires * each);
    std::vector<std::size_t> begin{0};  // (site)
    for (const auto turning : rows.turning) begin.push_back(begin.back() + turning);
    std::size_t at = 0;
    double differs = 0, varies = 0;
    for (std::size_t k = 0; k < sites.size(); ++k) {
      const std::size_t row = evaluation.row_of(0, sites[k]);
      const auto [low, high] = std::minmax_element(rows.strain.begin() + std::ptrdiff_t(begin[row]),
                                                   rows.strain.begin() + std::ptrdiff_t(begin[row + 1]));
      const auto [own_low, own_high] = std::minmax_element(
          alone.strain.begin() + std::ptrdiff_t(at), alone.strain.begin() + std::ptrdiff_t(at + alone.turning[k]));
      at += alone.turning[k];
      differs = std::max({differs, std::abs(double(*low) - *own_low), std::abs(double(*high) - *own_high)});
      varies = std::max(varies, double(*high) - *low);
    }
    CAPTURE(fibres);
    CHECK(differs < wave_rounding + third_of_length);
    CHECK(varies > 0.01);
  }
}
