// Strain of wires in layers that lie in long waves about a bent cable (W45).
//
// A wire of one hand in a core of the other hand turns slowly about its cable. If the bend of the cable changes within a wave, the
// wire is longer on one side of the cable than on the other, and its strain does not even out over the wave (W10). Such a wire
// slides as a line from clamp to clamp (sliding_line.h). Glued it would have the strain
//     gamma(s) = R (k1 sin Phi - k2 cos Phi),   Phi = psi + q s,                                       (W45)
// R: helix radius times the squared cosine of its lay, q: turn about the cable per length, k1, k2: curvature of the cable. All
// wires of a layer in one cable differ by psi only, also those in different cores. Three of them give the strain
//     C cos psi + S sin psi
// of every wire: opposite wires have opposite strains. Friction in short bends makes a triangle of the strain around the cable, so
// the harmonic is enlarged to the largest strain of the three, by at most pi^2/8. Ranges of the worst wire then are within 14 % of
// those of lines that another solver moves (long_waves_test.cpp).
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "strain/construction.h"
#include "strain/segment_rows.h"
#include "strain/slip.h"

namespace dresslife::strain {

/// Strain of the wires of one layer of a bundle in one segment: cos_row[t] cos(a) + sin_row[t] sin(a), a: `phase` plus the angle
/// from wire 1 [rad]. Empty rows: the layer does not lie in long waves.
struct LineWave {
  std::vector<float> cos_row, sin_row;  ///< (sample)
  double phase = 0;                     ///< psi of wire 1

  void add_to(auto* strain, double angle) const {
    const double c = std::cos(phase + angle), s = std::sin(phase + angle);
    for (std::size_t t = 0; t < cos_row.size(); ++t) strain[t] += c * cos_row[t] + s * sin_row[t];
  }
};

/// One span between two clamps. Cables are numbered as in Construction::cables().
struct BentCables {
  const std::vector<double>&lengths, &arcs, &places;  ///< of the segments; places: where their wires are evaluated [m]
  std::size_t samples;
  /// Writes samples of the curvature about d1 (0) or d2 (1) [1/m]. row: base end, segments, tool end.
  std::function<void(std::size_t cable, std::size_t row, int about, std::size_t first, std::size_t count, double* to)>
      curvature;
  /// Writes samples of the cable's strain in a segment.
  std::function<void(std::size_t cable, std::size_t segment, std::size_t first, std::size_t count, double* to)> strain;
};

/// Returns the length over which the curvature of a cable changes [m]: 2 pi rms/rms of its slope, of the part that varies in
/// time; infinite: there is no bend, or an even one.
double bend_wave(const BentCables& cables, std::size_t cable);

/// Share of `Scratch::room` that one object keeps in memory: each set of cable places has some, one for each friction factor.
constexpr double share_of_lines = 0.125;

class LongWaves {
 public:
  /// Returns the layers of wires that slide over their pitch and whose wave is longer than the limit of any of their cables.
  /// limits: (cable) [m]. Wires that a jacket of their own holds are no lines.
  static std::vector<int> layers_of(const Construction& construction, const std::vector<LayerSlip>& plan,
                                    const std::vector<double>& limits);

  /// layers: see layers_of(). friction: factor of the friction limits. The references in `cables` and `construction` must outlive
  /// this object.
  LongWaves(const Construction& construction, const std::vector<LayerSlip>& plan, const std::vector<int>& layers,
            const BentCables& cables, double friction, const Scratch& scratch);
  ~LongWaves();

  /// layer: of wires in `part`. segment: of the span. Solves the line of the layer and its cable when it is first needed; several
  /// threads may call it. Errors: InputError when the disk is full.
  LineWave of(int layer, int part, std::size_t segment) const;

 private:
  struct Line;
  void solve(Line& line) const;

  const Construction& construction_;
  BentCables cables_;
  double friction_;
  bool uniform_;                           ///< without friction all segments have the same strain
  std::vector<std::vector<int>> line_of_;  ///< (layer, cable) number of its line; -1: none
  std::vector<std::unique_ptr<Line>> lines_;
  mutable std::mutex mutex_;        ///< of the rows
  mutable SegmentRows rows_;        ///< (segment, one if uniform; cosine and sine; samples of line after line)
  mutable std::size_t solved_ = 0;  ///< number of lines in the rows
};

}  // namespace dresslife::strain
