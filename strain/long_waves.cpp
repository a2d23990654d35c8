#include "strain/long_waves.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "pipeline/base/constants.h"
#include "pipeline/base/threads.h"
#include "strain/sliding_line.h"

namespace dresslife::strain {
namespace {

// Wires per half turn. Strains are a harmonic around the cable, or a triangle, which has its third harmonic in addition.
constexpr int phases = 3;
// Pieces of equal strain have (pi/10)^2/6 = 1.6 % less strain than the wave. With 24 pieces and 8 wires the lives of
// spot_robot_1 and hard change by less than 13 %, see strain/measurements.md.
constexpr double pieces_of_a_wave = 10;
// For waves longer than the dresspack. The bends of such a wire then have pieces of a length like that of the segments.
constexpr double least_pieces = 32;

/// Returns the turn of a wire about the bent cable per length of the dresspack [rad/m].
double turn_of(const Construction& construction, const std::vector<LayerSlip>& plan, int layer, int part) {
  const Layer& of = construction.layers()[layer];
  double turn = construction.length_rate(part) * of.lay_tangent / of.helix_radius;
  for (const int above : construction.ancestry(part)) {
    const Part& in = construction.parts()[above];
    const Layer& helix = construction.layers()[in.layer];
    if (helix.helix_radius > 0 && !plan[in.layer].loose)  // a loose cable does not turn about itself
      turn += construction.length_rate(in.parent) * helix.lay_tangent / helix.helix_radius;
  }
  return turn;
}

/// Samples of the curvature, read in blocks so that memory does not grow with the motion's length.
struct Bends {
  static constexpr std::size_t block = 1024;
  std::size_t rows;
  std::vector<double> k1, k2;  // (sample of the block, row)

  explicit Bends(const BentCables& cables) : rows(cables.lengths.size() + 2), k1(rows * block), k2(k1), one_(block) {}
  void read(const BentCables& cables, std::size_t cable, std::size_t first, std::size_t count) {
    for (std::size_t row = 0; row < rows; ++row)
      for (const int about : {0, 1}) {
        cables.curvature(cable, row, about, first, count, one_.data());
        for (std::size_t t = 0; t < count; ++t) (about == 0 ? k1 : k2)[t * rows + row] = one_[t];
      }
  }

 private:
  std::vector<double> one_;
};

/// Returns the places of the rows of the curvature [m].
std::vector<double> knots_of(const BentCables& cables) {
  std::vector<double> knots{cables.arcs.front() - cables.lengths.front() / 2};
  knots.insert(knots.end(), cables.arcs.begin(), cables.arcs.end());
  knots.push_back(cables.arcs.back() + cables.lengths.back() / 2);
  return knots;
}

struct Variance {
  double sum = 0, squares = 0;
  void add(double value) { sum += value, squares += value * value; }
  double over(std::size_t samples) const {
    const auto count = static_cast<double>(samples);
    return std::max(0.0, squares / count - std::pow(sum / count, 2));
  }
};

/// Returns the largest strain of the three wires over that of their harmonic, which has 0.81 of the peak of a triangle.
double peak_scale(const std::array<double, phases>& strains, double c, double s) {
  double peak = 0, of_harmonic = 0;
  for (int phase = 0; phase < phases; ++phase) {
    const double angle = pi * phase / phases;
    peak = std::max(peak, std::abs(strains[phase]));
    of_harmonic = std::max(of_harmonic, std::abs(c * std::cos(angle) + s * std::sin(angle)));
  }
  return of_harmonic > 0 ? std::clamp(peak / of_harmonic, 1.0, pi * pi / 8) : 1;
}

bool can_be_line(const Construction& construction, const std::vector<LayerSlip>& plan, const Bundle& bundle,
                 int layer) {
  const Layer& of = construction.layers()[layer];
  return plan[layer].sliding == Sliding::over_pitch && construction.cable_of(bundle.part) != no_cable &&
         of.helix_radius > 0 && !(plan[layer].friction && of.jacket_stiffness > 0);
}

}  // namespace

double bend_wave(const BentCables& cables, std::size_t cable) {
  const std::size_t segments = cables.lengths.size();
  std::vector<Variance> bends(2 * segments), slopes(2 * segments);
  Bends of(cables);
  for (std::size_t first = 0; first < cables.samples; first += Bends::block) {
    const std::size_t count = std::min(Bends::block, cables.samples - first);
    of.read(cables, cable, first, count);
    for (std::size_t t = 0; t < count; ++t)
      for (std::size_t i = 0; i < segments; ++i)
        for (const int about : {0, 1}) {
          const double* const k = &(about == 0 ? of.k1 : of.k2)[t * of.rows + i + 1];
          bends[2 * i + about].add(k[0]);
          if (i + 1 < segments) slopes[2 * i + about].add(k[1] - k[0]);
        }
  }
  double bend = 0, slope = 0, length = 0;
  for (std::size_t i = 0; i < segments; ++i) {
    length += cables.lengths[i];
    for (const int about : {0, 1}) {
      bend += cables.lengths[i] * bends[2 * i + about].over(cables.samples);
      if (i + 1 < segments) slope += slopes[2 * i + about].over(cables.samples) / (cables.arcs[i + 1] - cables.arcs[i]);
    }
  }
  // 1e-6 1/m strains a wire 5 mm from the axis by 5e-9.
  return bend > 1e-12 * length && slope > 0 ? 2 * pi * std::sqrt(bend / slope) : HUGE_VAL;
}

struct LongWaves::Line {
  int layer;
  std::size_t cable;
  double turn, length_rate;  // per length of the dresspack
  double radius;             // strain per curvature [m]
  LayerSlip slip{};
  std::once_flag once{};
  std::size_t first = 0;  // of its samples in the rows
};

std::vector<int> LongWaves::layers_of(const Construction& construction, const std::vector<LayerSlip>& plan,
                                      const std::vector<double>& limits) {
  std::vector<int> layers;
  for (const Bundle& bundle : construction.bundles())
    for (const int layer : bundle.wire_layers)
      if (can_be_line(construction, plan, bundle, layer) && std::ranges::find(layers, layer) == layers.end() &&
          limits[construction.cable_of(bundle.part)] * std::abs(turn_of(construction, plan, layer, bundle.part)) <
              2 * pi)
        layers.push_back(layer);
  return layers;
}

LongWaves::LongWaves(const Construction& construction, const std::vector<LayerSlip>& plan,
                     const std::vector<int>& layers, const BentCables& cables, double friction, const Scratch& scratch)
    : construction_(construction),
      cables_(cables),
      friction_(friction),
      uniform_(friction == 0 || std::ranges::none_of(layers, [&](int layer) { return plan[layer].friction; })),
      line_of_(construction.layers().size(), std::vector<int>(construction.cables().size(), -1)),
      rows_(uniform_ ? 1 : cables.lengths.size(), 2, layers.size() * construction.cables().size() * cables.samples,
            scratch) {
  for (const Bundle& bundle : construction.bundles())
    for (const int layer : bundle.wire_layers) {
      if (std::ranges::find(layers, layer) == layers.end() || !can_be_line(construction, plan, bundle, layer)) continue;
      const int cable = construction.cable_of(bundle.part);
      if (line_of_[layer][cable] >= 0) continue;
      line_of_[layer][cable] = static_cast<int>(lines_.size());
      const Layer& of = construction.layers()[layer];
      // A core on a helix bends by the squared cosine of its lay about its binormal, and by the cosine about its normal.
      double bent = of.lay_cosine * of.lay_cosine;
      for (const int part : construction.ancestry(bundle.part))
        if (const Layer& above = construction.layers()[construction.parts()[part].layer]; !above.is_cable())
          bent *= std::pow(above.lay_cosine, 1.5);
      auto& line = *lines_.emplace_back(std::make_unique<Line>());
      line.layer = layer;
      line.cable = static_cast<std::size_t>(cable);
      line.turn = turn_of(construction, plan, layer, bundle.part);
      line.length_rate = construction.length_rate(bundle.part) / of.lay_cosine;
      line.radius = of.helix_radius * bent * plan[layer].radial_share;
      line.slip = plan[layer];
    }
}

LongWaves::~LongWaves() = default;

void LongWaves::solve(Line& of) const {
  const Layer& layer = construction_.layers()[of.layer];
  const std::size_t segments = cables_.lengths.size(), samples = cables_.samples;
  const std::vector<double> knots = knots_of(cables_);
  const double length = knots.back() - knots.front();
  const auto count = static_cast<std::size_t>(
      std::max(least_pieces, std::ceil(length * pieces_of_a_wave * std::abs(of.turn) / (2 * pi))));
  const double piece = length / static_cast<double>(count);
  struct Piece {
    std::size_t segment, row;                      // row: of the curvature before it
    std::array<double, 2> of_sine{}, of_cosine{};  // radius times sine and cosine, of this row and the next one
  };
  std::vector<Piece> pieces;
  for (std::size_t k = 0, segment = 0, row = 0; k < count; ++k) {
    const double at = knots.front() + (static_cast<double>(k) + 0.5) * piece;
    while (at > knots[row + 1]) ++row;
    while (at > cables_.arcs[segment] + cables_.lengths[segment] / 2 && segment + 1 < segments) ++segment;
    const double next = (at - knots[row]) / (knots[row + 1] - knots[row]);
    const double sine = of.radius * std::sin(of.turn * at), cosine = of.radius * std::cos(of.turn * at);
    pieces.push_back({segment, row, {(1 - next) * sine, next * sine}, {(1 - next) * cosine, next * cosine}});
  }
  const std::vector<double> lengths(count, of.length_rate * piece);
  // (segment) the piece before the place of its wires, and the share of the next one: forces change evenly between them
  std::vector<std::pair<std::size_t, double>> at_wires;
  for (const double place : cables_.places) {
    const double at = std::clamp((place - knots.front()) / piece - 0.5, 0.0, static_cast<double>(count - 1));
    const auto before = std::min(static_cast<std::size_t>(at), count - 2);
    at_wires.emplace_back(before, at - static_cast<double>(before));
  }
  const std::size_t stored = uniform_ ? 1 : segments;
  const double sine = std::sin(layer.lay_angle), press = sine * sine / layer.helix_radius;  // per tension [1/m]
  const double coefficient = of.slip.friction ? friction_ * layer.friction : 0;
  std::vector<SlidingLine> lines(phases, {lengths, layer.axial_stiffness, without_limit, without_limit});
  std::vector<double> limits(count, 0.0), glued1(count), glued2(count), slides(count);
  std::vector<double> pressed(segments);  // friction limit per length
  std::vector<double> c(segments), s(segments), cable_strain(segments * Bends::block);
  std::vector<std::array<double, phases>> strains(segments);  // of the three wires
  std::vector<float> rows(stored * 2 * samples);
  Bends bends(cables_);
  const auto step = [&](std::size_t t, std::size_t sample, bool counts) {
    const double *const k1 = &bends.k1[t * bends.rows], *const k2 = &bends.k2[t * bends.rows];
    for (std::size_t k = 0; k < count; ++k) {
      const Piece& p = pieces[k];
      const double *const one = k1 + p.row, *const other = k2 + p.row;
      glued1[k] = one[0] * p.of_sine[0] + one[1] * p.of_sine[1] - other[0] * p.of_cosine[0] - other[1] * p.of_cosine[1];
      glued2[k] = one[0] * p.of_cosine[0] + one[1] * p.of_cosine[1] + other[0] * p.of_sine[0] + other[1] * p.of_sine[1];
    }
    if (coefficient == 0) {  // the strain is even
      double mean1 = 0, mean2 = 0;
      for (std::size_t k = 0; k < count; ++k) mean1 += glued1[k], mean2 += glued2[k];
      for (std::size_t i = 0; i < stored; ++i) {
        rows[2 * i * samples + sample] = static_cast<float>(mean1 / static_cast<double>(count));
        rows[(2 * i + 1) * samples + sample] = static_cast<float>(mean2 / static_cast<double>(count));
      }
      return;
    }
    for (std::size_t i = 0; i < segments; ++i) {
      const double tension = layer.tension + layer.axial_stiffness * cable_strain[i * Bends::block + t];
      pressed[i] = coefficient * std::max(0.0, layer.line_load + tension * press);
    }
    for (std::size_t k = 0; k < count; ++k) limits[k] = pressed[pieces[k].segment] * lengths[k];
    std::ranges::fill(c, 0.0);
    std::ranges::fill(s, 0.0);
    for (int phase = 0; phase < phases; ++phase) {
      const double cosine = std::cos(pi * phase / phases), across = std::sin(pi * phase / phases);
      for (std::size_t k = 0; k < count; ++k) slides[k] = cosine * glued1[k] + across * glued2[k];
      lines[phase].next(slides, limits);
      for (std::size_t i = 0; i < stored && counts; ++i) {
        const auto [before, next] = at_wires[i];
        strains[i][phase] = std::lerp(lines[phase].strain(before), lines[phase].strain(before + 1), next);
        c[i] += 2.0 / phases * cosine * strains[i][phase];
        s[i] += 2.0 / phases * across * strains[i][phase];
      }
    }
    for (std::size_t i = 0; i < stored && counts; ++i) {
      const double scale = peak_scale(strains[i], c[i], s[i]);
      rows[2 * i * samples + sample] = static_cast<float>(scale * c[i]);
      rows[(2 * i + 1) * samples + sample] = static_cast<float>(scale * s[i]);
    }
  };
  for (const bool counts : {false, true}) {  // the last quarter of the repeat leads to its first state
    if (!counts && coefficient == 0) continue;
    for (std::size_t first = counts ? 0 : samples - samples / 4; first < samples; first += Bends::block) {
      const std::size_t here = std::min(Bends::block, samples - first);
      bends.read(cables_, of.cable, first, here);
      for (std::size_t i = 0; i < segments && coefficient > 0; ++i)
        cables_.strain(of.cable, i, first, here, &cable_strain[i * Bends::block]);
      for (std::size_t t = 0; t < here; ++t) step(t, first + t, counts);
    }
  }
  const std::lock_guard lock(mutex_);
  of.first = samples * solved_++;
  rows_.append(std::move(rows), samples);
}

LineWave LongWaves::of(int layer, int part, std::size_t segment) const {
  const int cable = construction_.cable_of(part), number = cable == no_cable ? -1 : line_of_[layer][cable];
  if (number < 0) return {};
  Line& line = *lines_[number];
  std::call_once(line.once, [&] { solve(line); });
  LineWave wave{std::vector<float>(cables_.samples), std::vector<float>(cables_.samples),
                construction_.phase(layer, 1, part, 0)};
  for (const int above : construction_.ancestry(part)) {
    // Each level counts from the inward direction of the level above.
    const Part& in = construction_.parts()[above];
    wave.phase += construction_.phase(in.layer, in.number, in.parent, 0) + pi;
  }
  std::vector<double> read(cables_.samples);
  const std::lock_guard lock(mutex_);
  for (const auto& [row, to] : {std::pair(0, &wave.cos_row), std::pair(1, &wave.sin_row)}) {
    rows_.read(uniform_ ? 0 : segment, row, line.first, cables_.samples, read.data());
    std::ranges::copy(read, to->begin());
  }
  return wave;
}

}  // namespace dresslife::strain
