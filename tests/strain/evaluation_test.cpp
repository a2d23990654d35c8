#include "strain/evaluation.h"

#include <cmath>
#include <map>

#include "pipeline/base/constants.h"
#include "pipeline/base/errors.h"
#include "tests/catch.h"
#include "tests/strain/all_kernels.h"
#include "tests/strain/dresspacks.h"

using namespace dresslife;
using namespace dresslife::strain;
using namespace test_dresspacks;
using dresslife::pipeline::Kinematics;
using dresslife::pipeline::Slip;
using Settings = dresslife::pipeline::Strain;

namespace {

/// A smooth motion of every segment, up to curvatures of 5 1/m and twists of 4 rad/m.
DeformationHistory moving(std::size_t segments, std::size_t samples) {
  DeformationHistory history(segments, samples);
  for (std::size_t i = 0; i < segments; ++i)
    for (std::size_t t = 0; t < samples; ++t) {
      const double x = (i + 0.5) / segments, y = 0.05 * t;
      history.set(i, t,
                  {3 * std::sin(2 * pi * x + 0.7 * y) + 2, 3 * std::cos(3 * x - 0.5 * y), 4 * std::sin(0.3 * y + x),
                   1e-4 * std::sin(y)});
    }
  return history;
}

struct Results {
  SiteRows sites, stick, free;
  std::vector<Probe> probes;
};

void join(SiteRows& all, const SiteRows& more) {
  auto add = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  add(all.segment, more.segment);
  add(all.component, more.component);
  add(all.helix, more.helix);
  add(all.fibre, more.fibre);
  add(all.material, more.material);
  add(all.turning, more.turning);
  add(all.strain, more.strain);
  add(all.sample, more.sample);
}

Results evaluate(const Construction& construction, const Settings& settings, const DeformationHistory& history,
                 std::size_t segments, double length = 2) {
  Evaluation evaluation(construction, settings, std::vector<double>(segments, length / segments), history.samples(), 1,
                        part_of_rig(length));
  evaluation.add({history});
  Results results;
  Sink sink;
  sink.sites = [&](const SiteRows& rows) { join(results.sites, rows); };
  sink.bound_stick = [&](const SiteRows& rows) { join(results.stick, rows); };
  sink.bound_free = [&](const SiteRows& rows) { join(results.free, rows); };
  sink.probe = [&](const Probe& probe) { results.probes.push_back(probe); };
  for (std::size_t i = 0; i < segments; ++i) evaluation.evaluate(i, history, i, sink);
  return results;
}

Settings settings_with(Slip slip, Kinematics kinematics = Kinematics::exact) {
  Settings settings;
  settings.slip = {slip};
  settings.kinematics = kinematics;
  settings.gate = 0;
  return settings;
}

ComponentState<double> dresspack_rod(const DeformationHistory& history, std::size_t segment, std::size_t t, int order) {
  const DeformationColumns c = history.columns(segment);
  return uniform_rod<double>(c.elongation[t], c.curvature1[t], c.curvature2[t], c.twist[t], order);
}

/// One component of the path from the dresspack to a wire.
struct Link {
  int layer, number, parent;
};

std::vector<Link> links_to(const Construction& construction, const Bundle& bundle, int layer, int number) {
  std::vector<Link> links;
  for (const int part : construction.ancestry(bundle.part)) {
    const Part& of = construction.parts()[part];
    links.push_back({of.layer, of.number, of.parent});
  }
  links.push_back({layer, number, bundle.part});
  return links;
}

/// Returns the strain of a wire's outward fibre if everything is glued, by the plain recursion.
double glued_strain(const Construction& construction, const std::vector<Link>& links, double arc,
                    const DeformationHistory& history, std::size_t segment, std::size_t t) {
  ComponentState<double> rod = dresspack_rod(history, segment, t, 5), rest = uniform_rod<double>(0, 0, 0, 0, 5);
  for (const Link& link : links) {
    const Placement place = construction.placement(link.layer, link.number, link.parent, arc);
    rod = child(rod, place);
    rest = child(rest, place);
  }
  const double radius = construction.layers()[links.back().layer].part_radius;
  const bool exact = construction.kinematics() == Kinematics::exact;
  if (!exact) return rod.stretch.at[0] / rest.stretch.at[0] - 1 + radius * rod.bend1.at[0];
  return (rod.stretch.at[0] + radius * rod.bend2.at[0]) / (rest.stretch.at[0] + radius * rest.bend2.at[0]) - 1;
}

/// Returns the largest difference of all sites' turning points from `reference(site's links, segment, sample)`, divided by
/// the largest range.
template <class Reference>
double worst_difference(const Construction& construction, const SiteRows& rows, std::size_t segments,
                        const Reference& reference) {
  double worst = 0, low = 0, high = 0;
  std::size_t site = 0, at = 0;
  for (std::size_t segment = 0; segment < segments; ++segment)
    for (const Bundle& bundle : construction.bundles())
      for (const int layer : bundle.wire_layers)
        for (int number = 1; number <= construction.layers()[layer].count; ++number, ++site) {
          REQUIRE(rows.component[site] == construction.wire_path(layer, number, bundle.part));
          const auto links = links_to(construction, bundle, layer, number);
          for (std::uint64_t k = 0; k < rows.turning[site]; ++k, ++at) {
            const double expected = reference(links, segment, rows.sample[at]);
            worst = std::max(worst, std::abs(rows.strain[at] - expected));
            low = std::min(low, expected);
            high = std::max(high, expected);
          }
        }
  REQUIRE(site == rows.segment.size());
  return worst / (high - low);
}

constexpr std::size_t few_segments = 3, some_samples = 301;

// The strain around a layer is kept up to its second harmonic (W13). The third harmonic is 6e-5 of the range in the thesis'
// dresspack.
constexpr double wave_tolerance = 1e-4;

double centre(std::size_t segment) { return (segment + 0.5) * 2.0 / few_segments; }

}  // namespace

TEST_CASE("every wire's turning points are those of the full recursion when all is glued") {
  const DeformationHistory history = moving(few_segments, some_samples);
  for (const Kinematics kinematics : {Kinematics::exact, Kinematics::thesis}) {
    const Construction construction(thesis_dresspack(), kinematics);
    const Results results = evaluate(construction, settings_with(Slip::stick, kinematics), history, few_segments);
    REQUIRE(results.sites.segment.size() == 6440 * few_segments);
    const double difference = worst_difference(
        construction, results.sites, few_segments, [&](const auto& links, std::size_t segment, std::size_t t) {
          return glued_strain(construction, links, centre(segment), history, segment, t);
        });
    CHECK(difference < wave_tolerance);
  }
}

TEST_CASE("the waves keep their accuracy at lay angles of 30 degrees and fat wires") {
  Component strand = part("strand", 6, 0.002, 0.004, -30);
  strand.lay_angle = 30 * degree;
  strand.components = {wires("", 6, 0.0006, 0.0013, 30, Hand::left)};
  Component cable = part("cable", 3, 0.006, 0.012, 10);
  cable.components = {strand};
  Dresspack dresspack;
  dresspack.components = {cable};
  const Construction construction(dresspack, Kinematics::exact);
  const DeformationHistory history = moving(few_segments, some_samples);
  const Results results = evaluate(construction, settings_with(Slip::stick), history, few_segments);
  const double difference = worst_difference(
      construction, results.sites, few_segments, [&](const auto& links, std::size_t segment, std::size_t t) {
        return glued_strain(construction, links, centre(segment), history, segment, t);
      });
  // The third harmonic grows with lay angle and thickness. A life is about the ninth power of strain, so this tolerance is
  // about 1 % of a life, far below the scatter from wire to wire.
  constexpr double steep_tolerance = 1e-3;
  CHECK(difference < steep_tolerance);
}

TEST_CASE("free components have the mean of their glued strain and keep their own bending") {
  const DeformationHistory history = moving(few_segments, some_samples);
  const Construction construction(thesis_dresspack(), Kinematics::exact);
  const Results results = evaluate(construction, settings_with(Slip::free), history, few_segments);

  // A reference that does not use the product's slip code: averages over segments and over 48 phases.
  constexpr int phases = 48;
  const ComponentState<double> at_rest = uniform_rod<double>(0, 0, 0, 0, 5);
  auto placed = [&](const Link& link, std::size_t segment, double turn) {
    return construction.placement(link.layer, link.number, link.parent, centre(segment), turn);
  };
  auto over_phases = [&](const ComponentState<double>& rod, const Link& link, std::size_t segment) {
    double sum = 0;
    for (int m = 0; m < phases; ++m) sum += path_rate(rod, placed(link, segment, 2 * pi * m / phases));
    return sum / phases;
  };
  std::map<std::pair<int, std::size_t>, double> cable_strain;
  auto cable_mean = [&](const Link& cable, std::size_t t) {
    auto [entry, fresh] = cable_strain.insert({{cable.number, t}, 0});
    if (fresh) {
      double path = 0;
      for (std::size_t i = 0; i < few_segments; ++i)
        path += path_rate(dresspack_rod(history, i, t, 5), placed(cable, i, 0)) / few_segments;
      entry->second = path - 1;
    }
    return entry->second;
  };
  auto scaled = [](ComponentState<double> rod, double strain, const ComponentState<double>& rest) {
    // same curvature and torsion per path length, with the given strain as stretch
    const Series<double> stretch = (1 + strain) * rest.stretch, factor = stretch / rod.stretch;
    return ComponentState<double>{stretch, rod.bend1 * factor, rod.bend2 * factor, rod.twist * factor};
  };
  const double difference = worst_difference(
      construction, results.sites, few_segments, [&](const auto& links, std::size_t segment, std::size_t t) {
        const Placement in_dresspack = placed(links[0], segment, 0), in_cable = placed(links[1], segment, 0),
                        in_conductor = placed(links[2], segment, 0);
        const ComponentState<double> cable_rest = child(at_rest, in_dresspack);
        const ComponentState<double> cable =
            scaled(child(dresspack_rod(history, segment, t, 5), in_dresspack), cable_mean(links[0], t), cable_rest);
        const ComponentState<double> conductor_rest = child(cable_rest, in_cable);
        const double conductor_strain =
            over_phases(cable, links[1], segment) / over_phases(cable_rest, links[1], segment) - 1;
        const ComponentState<double> conductor = scaled(child(cable, in_cable), conductor_strain, conductor_rest);
        const ComponentState<double> wire_rest = child(conductor_rest, in_conductor);
        const double wire_strain =
            over_phases(conductor, links[2], segment) / over_phases(conductor_rest, links[2], segment) - 1;
        const ComponentState<double> wire = scaled(child(conductor, in_conductor), wire_strain, wire_rest);
        return (wire.stretch.at[0] + 75e-6 * wire.bend2.at[0]) /
                   (wire_rest.stretch.at[0] + 75e-6 * wire_rest.bend2.at[0]) -
               1;
      });
  CHECK(difference < wave_tolerance);
}

TEST_CASE("straight wires in a helical conductor take the mean of a walk along its pitch") {
  Dresspack dresspack = thesis_dresspack();
  dresspack.components[0].count = 1;
  dresspack.components[0].components[0].count = 1;
  auto& layers = dresspack.components[0].components[0].components;
  layers.resize(1);
  layers[0].lay_angle = 0;
  const Construction construction(dresspack, Kinematics::exact);
  Settings settings = settings_with(Slip::stick);
  settings.slip = {Slip::stick, Slip::stick, Slip::free};
  settings.surface_fibres = 0;
  const std::size_t samples = 40;
  const DeformationHistory history = moving(few_segments, samples);
  const Results results = evaluate(construction, settings, history, few_segments);
  const double pitch = construction.layers()[1].pitch();
  constexpr int steps = 24;
  const double difference = worst_difference(
      construction, results.sites, few_segments, [&](const auto& links, std::size_t segment, std::size_t t) {
        double path = 0, rest_path = 0;
        for (int k = 0; k < steps; ++k) {  // along one pitch of the conductor, with the deformation of this segment
          const double arc = centre(segment) + pitch * k / steps;
          ComponentState<double> rod = dresspack_rod(history, segment, t, 5), rest = uniform_rod<double>(0, 0, 0, 0, 5);
          for (const Link& link : links) {
            const Placement place = construction.placement(link.layer, link.number, link.parent, arc);
            rod = child(rod, place);
            rest = child(rest, place);
          }
          path += rod.stretch.at[0];
          rest_path += rest.stretch.at[0];
        }
        return path / rest_path - 1;
      });
  CHECK(difference < wave_tolerance);
}

TEST_CASE("straight wires that slide in a straight core that slides have its strain, too") {
  Dresspack dresspack;
  Component cable = thesis_dresspack().components[0];
  cable.count = 1;
  cable.helix_radius = 0;
  cable.components[0].lay_angle = 0;
  for (Component& wire : cable.components[0].components) wire.lay_angle = 0;
  dresspack.components = {cable};
  DeformationHistory history(few_segments, 2);
  constexpr double curvature = 10;
  for (std::size_t i = 0; i < few_segments; ++i) history.set(i, 1, {curvature, 0, 0, 0});
  const auto strains = [&](Slip slip) {
    Settings settings = settings_with(slip);
    settings.surface_fibres = 0;
    return evaluate(Construction(dresspack, Kinematics::exact), settings, history, few_segments).sites.strain;
  };
  // Everywhere the same bend: the mean from clamp to clamp is the strain of a glued wire.
  const std::vector<float> free = strains(Slip::free), glued = strains(Slip::stick);
  REQUIRE(free.size() == glued.size());
  double largest = 0, difference = 0;
  for (std::size_t k = 0; k < free.size(); ++k)
    largest = std::max<double>(largest, std::abs(glued[k])),
    difference = std::max<double>(difference, std::abs(free[k] - glued[k]));
  CHECK(largest > 0.0025 * curvature);  // most of it from the core, which is 2.8 mm from the axis
  CHECK(difference < wave_tolerance * largest);
}

TEST_CASE("at a bend radius of 100 mm a glued wire sees thirty times what a slipping one does") {
  Dresspack dresspack;
  Component cable = thesis_dresspack().components[0];
  cable.count = 1;
  cable.helix_radius = 0;
  dresspack.components = {cable};
  constexpr std::size_t places = 20;  // so many that one wire is outermost in a conductor that is outermost
  DeformationHistory history(places, 2);
  const double curvature = 10;
  for (std::size_t i = 0; i < places; ++i) history.set(i, 1, {curvature, 0, 0, 0});
  auto largest = [&](Slip slip, Kinematics kinematics, int fibres) {
    const Construction construction(dresspack, kinematics);
    Settings settings = settings_with(slip, kinematics);
    settings.surface_fibres = fibres;
    const Results results = evaluate(construction, settings, history, places);
    return *std::max_element(results.sites.strain.begin(), results.sites.strain.end());
  };
  // The thesis: cos^2(25 deg) (2.825 mm + cos^2(5 deg) 0.75 mm) / 100 mm = 2.9 %.
  CHECK(largest(Slip::stick, Kinematics::thesis, 0) == Approx(0.0293).epsilon(0.01));
  // The exact geometry: the conductor bends by cos^4(25 deg) of the cable's curvature where it is outermost, not by cos^2.
  const double cosine = std::cos(25 * degree), sine = std::sin(25 * degree);
  const double conductor = cosine * cosine * 0.002825 * curvature;
  const double bend = std::pow(cosine, 4) * curvature;
  const double own_curvature = sine * sine / 0.002825;  // of the undeformed conductor, which its stretch rotates
  const double glued = conductor + 0.00075 * (bend - own_curvature * conductor) + 75e-6 * bend;
  constexpr double second_order = 0.03;  // of the strain: products of 3 % strains with angles of the lay
  CHECK(largest(Slip::stick, Kinematics::exact, 1) == Approx(glued).epsilon(second_order));
  // After slip only the wire's own bending remains. It is largest where the change of lay angle adds to it: cos (1 + sin^2).
  constexpr double mean_stretch =
      0.05;  // of the bending: the mean over the pitch grows with the square of the curvature
  // The wire's fibre is shortest on the inside of the conductor's own curvature (W12).
  const double shortest = 1 - (0.00075 + 75e-6) * own_curvature;
  CHECK(largest(Slip::free, Kinematics::exact, 1) ==
        Approx(75e-6 * curvature * cosine * (1 + sine * sine) / shortest).epsilon(mean_stretch));
}

TEST_CASE("the bounds hold the worst wires, and each segment's worst site is a probe") {
  const DeformationHistory history = moving(few_segments, some_samples);
  const Construction construction(thesis_dresspack(), Kinematics::exact);
  Settings settings = settings_with(Slip::free);
  settings.gate = 1e-4;
  settings.probes = {{1, "signal cable 3/conductor 2/layer 1/wire 17"}};
  const Results free = evaluate(construction, settings, history, few_segments);
  settings.slip = {Slip::stick};
  const Results stick = evaluate(construction, settings, history, few_segments);
  settings.slip = {Slip::free, Slip::stick, Slip::stick};  // cables slide in a bound as they do in the job
  const Results inside = evaluate(construction, settings, history, few_segments);

  auto largest_range = [&](const SiteRows& rows, std::size_t segment) {
    float largest = 0;
    std::size_t at = 0;
    for (std::size_t site = 0; site < rows.segment.size(); at += rows.turning[site++]) {
      if (rows.segment[site] != static_cast<int>(segment)) continue;
      const auto [low, high] =
          std::minmax_element(rows.strain.begin() + at, rows.strain.begin() + at + rows.turning[site]);
      largest = std::max(largest, *high - *low);
    }
    return largest;
  };
  constexpr std::size_t most_picked =
      5 * (6 + 2 * 128);  // 5 layers of wires; in each up to 6 wires by measures and 128 by each of two sums
  for (std::size_t segment = 0; segment < few_segments; ++segment) {
    constexpr float close = 1e-3f;  // strains of all wires are waves, without a third harmonic (W13)
    CHECK(largest_range(free.stick, segment) == Approx(largest_range(inside.sites, segment)).epsilon(close));
    CHECK(largest_range(stick.stick, segment) == Approx(largest_range(stick.sites, segment)).epsilon(close));
    CHECK(largest_range(stick.free, segment) == Approx(largest_range(free.sites, segment)).epsilon(close));
    double probed = 0;
    for (const Probe& probe : free.probes) {
      const auto [low, high] = std::minmax_element(probe.strain.begin(), probe.strain.end());
      if (free.sites.segment[probe.site] == static_cast<int>(segment)) probed = std::max(probed, *high - *low);
    }
    CHECK(probed == Approx(largest_range(free.sites, segment)).epsilon(1e-3));
  }
  for (const Results* results : {&free, &stick}) {
    CHECK(results->stick.segment.size() >= 5 * few_segments);  // five layers, one to five wires of each
    CHECK(results->free.segment.size() <= most_picked * few_segments);
    // Probes of each segment: the wire with the largest range and the two with the largest sums over cycles and over ranges,
    // which may be the same wire. One more probe was named in the settings.
    REQUIRE(results->probes.size() > few_segments);
    REQUIRE(results->probes.size() <= 5 * few_segments + 1);
    CHECK(results->sites.component[results->probes.back().site] == "signal cable 3/conductor 2/layer 1/wire 17");
    CHECK(results->sites.segment[results->probes.back().site] == few_segments - 1);
  }
}

TEST_CASE("fibres around a wire: the outward one sees the most bending, opposite ones its negative") {
  const DeformationHistory history = moving(few_segments, 60);
  Dresspack dresspack = thesis_dresspack();
  dresspack.components[0].count = 2;
  const Construction construction(dresspack, Kinematics::exact);
  Settings settings = settings_with(Slip::stick);
  settings.surface_fibres = 4;
  settings.probes = {{1, "signal cable 2/conductor 5/layer 2/wire 9"}};
  const Results four = evaluate(construction, settings, history, few_segments);
  settings.surface_fibres = 0;
  const Results axis = evaluate(construction, settings, history, few_segments);
  CHECK(four.sites.segment.size() == 4 * axis.sites.segment.size());
  const std::size_t wire = axis.probes.back().site;
  CHECK(axis.sites.fibre[2 * wire] == 0);
  CHECK(four.sites.fibre[2 * 4 * wire] == 75e-6);
  CHECK(four.sites.fibre[2 * 4 * wire + 1] == Approx(pi));
  CHECK(four.probes.back().site == 4 * wire);
}

TEST_CASE("every instruction set of this machine gives the same strains") {
  const DeformationHistory history = moving(1, 64);
  const Construction construction(thesis_dresspack(), Kinematics::exact);
  const auto plan = plan_slip(construction, {Slip::stick, Slip::free}, 2.0);
  const Bundle& bundle = construction.bundles()[3];
  BundleNesting nesting = nesting_to(construction, plan, bundle.part, 0.1, surface_fibres(3));
  for (const int layer : bundle.wire_layers)
    for (int number = 1; number <= construction.layers()[layer].count; ++number)
      nesting.nodes.push_back(node_at(construction, plan, nesting, layer, number, bundle.part, 0.1, 0));
  std::vector<std::vector<double>> strains;
  for (const Kernels* set : kernels_of_this_machine()) {
    strains.emplace_back(nesting.nodes.size() * 3 * 64);
    set->node_strains(pointers(nesting), history.columns(0), 0, 64, strains.back().data(), 64);
  }
  constexpr double contraction = 1e-13;  // of stretches near one; products are fused or not
  for (const auto& of : strains)
    for (std::size_t k = 0; k < of.size(); ++k) REQUIRE(std::abs(of[k] - strains[0][k]) < contraction);
}

TEST_CASE("an instruction set can be asked for by name") {
  for (const dresslife::pipeline::InstructionSet set : dresslife::pipeline::instruction_sets()) {
    CHECK(dresslife::pipeline::instruction_set_named(name_of(set)) == set);
    CHECK(kernels_for(set).machine == std::string(name_of(set)));
  }
  CHECK_THROWS_WITH(dresslife::pipeline::instruction_set_named("mmx"),
                    Catch::StartsWith("DRESSLIFE_KERNELS: error: is 'mmx' (this machine can run "
                                      "portable"));
}

namespace {

/// Returns the thesis' dresspack, delivered bent, with lay angles of its cables.
Dresspack laid_dresspack(double cable_lay_angle_deg, double rest_curvature) {
  Dresspack dresspack = thesis_dresspack();
  dresspack.rest_curvature = rest_curvature;
  dresspack.components[0].lay_angle = cable_lay_angle_deg * degree;
  return dresspack;
}

/// Returns the largest difference of the waves of a bundle's layers, and of its nodes one by one, from the strains of their
/// nodes in double precision, divided by the largest strain. start: source of the part's state.
enum class Start { dresspack, parent, parent_in_single };
double error_of_waves(const Kernels& set, const Construction& construction, const std::vector<Slip>& slip, int fibres,
                      Start start) {
  const std::size_t samples = 250, stride = padded(samples);  // not a multiple of any register
  const DeformationHistory history = moving(1, samples);
  const auto plan = plan_slip(construction, slip, 2.0);
  const std::vector<double> clamp_strain(stride, 1e-3);
  const Bundle& bundle = construction.bundles()[12];
  const auto nesting_of = [&](int part) {
    BundleNesting nesting = nesting_to(construction, plan, part, 0.1, surface_fibres(fibres));
    for (NestingLevel& step : nesting.steps) step.slide.clamp_strain = clamp_strain.data();
    return nesting;
  };
  BundleNesting nesting = nesting_of(bundle.part);
  for (const int layer : bundle.wire_layers)
    for (int node = 0; node < waves_per_layer; ++node)
      nesting.nodes.push_back(
          node_at(construction, plan, nesting, layer, 1, bundle.part, 0.1, 2 * pi * node / waves_per_layer));
  BundlePointers from = pointers(nesting);
  std::vector<double> strains(nesting.nodes.size() * fibres * stride);
  kernels().node_strains(from, history.columns(0), 0, samples, strains.data(), stride);
  BundleNesting parent = nesting_of(construction.parts()[bundle.part].parent);
  parent.order = nesting.order + 1;
  std::vector<double> states(part_state_rows(parent.order) * stride);
  std::vector<float> rows(part_rows * stride), waves(strains.size());
  if (start == Start::parent) {
    set.part_states(pointers(parent), history.columns(0), 0, samples, states.data(), rows.data(), stride);
    from.parent = states.data(), from.parent_rows = rows.data(), from.parent_stride = stride;
  }
  if (start == Start::parent_in_single) {
    set.part_rows_of_dresspack(pointers(parent), history.columns(0), 0, samples, rows.data(), stride);
    from.parent_rows = rows.data(), from.parent_stride = stride;
  }
  set.layer_waves(from, history.columns(0), 0, samples, waves.data(), stride);
  std::vector<float> one_by_one(fibres == 1 ? strains.size() : 0);
  if (fibres == 1) set.node_strains_in_single(from, history.columns(0), 0, samples, one_by_one.data(), stride);
  double largest = 0, worst = 0;
  for (std::size_t row = 0; row < strains.size() / stride; ++row)
    for (std::size_t t = 0; t < samples; ++t) {
      const std::size_t node = row / fibres, layer = node / waves_per_layer, fibre = row % fibres;
      const float* wave = &waves[(layer * fibres + fibre) * waves_per_layer * stride + t];
      const double turn = 2 * pi * (node % waves_per_layer) / waves_per_layer;
      const double strain = wave[0] + wave[stride] * std::sin(turn) + wave[2 * stride] * std::cos(turn) +
                            wave[3 * stride] * std::sin(2 * turn) + wave[4 * stride] * std::cos(2 * turn);
      largest = std::max(largest, std::abs(strains[row * stride + t]));
      worst = std::max(worst, std::abs(strain - strains[row * stride + t]));
      if (fibres == 1) worst = std::max(worst, std::abs(one_by_one[row * stride + t] - strains[row * stride + t]));
    }
  return worst / largest;
}

}  // namespace

TEST_CASE("waves in single precision are the strains of their nodes on every instruction set") {
  constexpr double single = 3e-6;  // of the largest strain: some tens of roundings to 6e-8
  // The thesis' kinematics subtracts the strain at rest from that of the bent shape. Both are as large as the largest strain.
  constexpr double difference = 3 * single;
  const std::vector<std::vector<Slip>> slips{{Slip::stick},
                                             {Slip::free},
                                             {Slip::stick, Slip::stick, Slip::free},
                                             {Slip::free, Slip::stick, Slip::stick},
                                             {Slip::stick, Slip::free, Slip::stick}};
  for (const Kinematics kinematics : {Kinematics::exact, Kinematics::thesis})
    for (const double rest_curvature : {0.0, 2.0})
      for (const double cable_lay_angle : {0.0, 12.0}) {
        const Construction construction(laid_dresspack(cable_lay_angle, rest_curvature), kinematics);
        for (const auto& slip : slips)
          for (const int fibres : {1, 3})
            for (const Start start : {Start::dresspack, Start::parent, Start::parent_in_single})
              for (const Kernels* set : kernels_of_this_machine()) {
                const bool exact = kinematics == Kinematics::exact;
                if (start == Start::parent_in_single && !(exact && fibres == 1)) continue;
                const double error = error_of_waves(*set, construction, slip, fibres, start);
                CAPTURE(set->machine, kinematics, slip, fibres, start, rest_curvature, cable_lay_angle, error);
                CHECK(error < (rest_curvature != 0 && !exact ? difference : single));
              }
      }
}

TEST_CASE("a cable's state and its slopes in single precision are those in double precision") {
  constexpr double single = 2e-6;  // of the largest of each: some tens of roundings to 6e-8
  constexpr int second_cable = 8;  // its part number; each cable comes before its seven conductors
  const std::size_t samples = 250, stride = padded(samples);
  const DeformationHistory history = moving(1, samples);
  const std::vector<double> clamp_strain(stride, 1e-3);
  for (const double rest_curvature : {0.0, 2.0})
    for (const double lay_angle : {0.0, 12.0, -12.0})
      for (const Slip slip : {Slip::stick, Slip::free})
        for (const Kernels* set : kernels_of_this_machine()) {
          const Construction construction(laid_dresspack(lay_angle, rest_curvature), Kinematics::exact);
          BundleNesting nesting =
              nesting_to(construction, plan_slip(construction, {slip}, 2.0), second_cable, 0.1, surface_fibres(1));
          REQUIRE(nesting.steps.size() == 1);
          nesting.order = 1;
          nesting.steps[0].slide.clamp_strain = clamp_strain.data();
          std::vector<double> states(part_state_rows(1) * stride);
          std::vector<float> of_double(part_rows * stride), rows(part_rows * stride);
          set->part_states(pointers(nesting), history.columns(0), 0, samples, states.data(), of_double.data(), stride);
          set->part_rows_of_dresspack(pointers(nesting), history.columns(0), 0, samples, rows.data(), stride);
          for (std::size_t row = 0; row < part_rows; ++row) {
            double largest = 0, worst = 0;
            for (std::size_t t = 0; t < samples; ++t) {
              const double expected = of_double[row * stride + t];
              largest = std::max(largest, std::abs(expected));
              worst = std::max(worst, std::abs(rows[row * stride + t] - expected));
            }
            CAPTURE(set->machine, rest_curvature, lay_angle, slip, row, worst, largest);
            CHECK(worst <= single * largest);
            const bool none = lay_angle == 0 || (row == stretch_slope && slip == Slip::free);
            CHECK(
                (largest > 0 || none));  // the slope of a sliding part's stretch is 0; rows of straight parts may be 0
          }
        }
}

TEST_CASE("a probe that names no wire or no segment is refused") {
  const Construction construction(thesis_dresspack(), Kinematics::exact);
  Settings settings = settings_with(Slip::stick);
  auto message_of = [&](const dresslife::pipeline::ProbeRequest& probe) -> std::string {
    settings.probes = {probe};
    try {
      Evaluation(construction, settings, {0.5, 0.5}, 10);
    } catch (const dresslife::pipeline::InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  CHECK_THAT(message_of({1, "signal cable 11"}), Catch::Contains("no wire is called 'signal cable 11'"));
  CHECK_THAT(message_of({3, "signal cable 1/conductor 1/layer 1/wire 1"}),
             Catch::Contains("no segment 3 from the tool"));
}
