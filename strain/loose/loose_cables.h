// Where all cables of one hose lie, sample by sample (README W32 to W36): first each ring turns, then each
// cable goes to the minimum of its energy about its place there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "strain/loose/cable_lines.h"
#include "strain/loose/line_bench.h"
#include "strain/loose/ring.h"

namespace dresslife::strain {

struct LooseSettings {
  double length = 0;          ///< of the hose's axis between the clamps [m]
  std::size_t elements = 64;  ///< of equal length
  double rest_curvature = 0;  ///< about d2, of the hose in which the cables were laid [1/m]
  bool presses = true;        ///< computes how they press on what they lie against

  bool operator==(const LooseSettings&) const = default;
};

/// Radius in which a cable can wind: by its play about its place, or with its whole ring, or alone, about the hose's
/// axis [m].
double winding_radius(const LooseCable& cable);

/// Pieces into which cables as fit_in_hose() leaves them are to be cut for their waves to be seen. What is
/// too long by a share s winds in a room of radius c with k c = sqrt(2 s), about a place that its lay turns,
/// and second differences miss (k h)^2/12 of its curvature: 0.5 % at most, so that waves half as long,
/// between a core and a wall that leave less room, still miss no more than the 2 % that are warned of. At
/// least 64: with 32 the worst wire of `side_panel` was wrong by decades. length: of the axis [m].
std::size_t elements_of_waves(const std::vector<LooseCable>& cables, double length);

class LooseCables {
 public:
  /// cables: of one hose; those that meet each other as fit_in_hose() leaves them (strain/loose/rings.h).
  LooseCables(const std::vector<LooseCable>& cables, const LooseSettings& settings);
  LooseCables(const LooseCables&) = delete;  // its cables know its frames

  std::size_t nodes() const { return hose_.nodes(); }
  std::size_t cables() const { return lines_.count(); }
  double length() const { return settings_.length; }  ///< of the hose's axis [m]
  const LooseCable& cable(std::size_t k) const { return lines_.cable(k); }
  double laid_in(std::size_t k) const { return lines_.laid_in(k); }  ///< see CableLines

  /// Whether these are the same cables in the same hose: under the same motion they rest at the same places.
  bool same_cables(const LooseCables& other) const;

  bool any_ring() const { return !rings_.empty(); }
  /// Before the first sample: the ring begins wound with all of its cables' slack, by random_winding() or by a turn (node) [rad].
  void wind(std::uint64_t seed);
  void wind(const std::vector<double>& turn);
  /// Before the first sample: cables go on from where those of `other` are, which may differ in all but number, rings and
  /// nodes.
  void go_on_from(const LooseCables& other);
  /// As if only this share of the slack were in the hose; above 1: more of it.
  void feed_in(double share);
  /// By how much curvatures differ from those of the same cables that began otherwise, over their own: root mean squares
  /// over cables and nodes.
  double apart(const LooseCables& other) const;

  /// At the samples to come twist takes this share of a cable's length, if nothing pulls.
  void shorten(std::size_t cable, double share);
  /// Takes all cables to where they rest at the next sample. hose: (node). step: since the sample before [s].
  void advance(std::span<const HoseNode> hose, double step);
  /// The same for several that share nothing but the hose and its samples: side by side they take less time,
  /// and lie as they would alone.
  static void advance(std::span<LooseCables* const> all, std::span<const HoseNode> hose, double step);

  const CableState& state(std::size_t cable) const { return states_[cable]; }
  /// Samples at which a ring or a cable was still moving when the work was cut short, since forget_restless().
  std::size_t restless() const { return restless_; }
  void forget_restless() { restless_ = 0; }
  std::size_t iterations() const { return iterations_; }  ///< of all cables so far
  /// Share of the curvature of cables that their nodes are too far apart to see, root of mean squares over
  /// nodes and samples; the largest of all cables.
  double mesh_error() const;

 private:
  void settle(double step);
  static void relax(std::span<LooseCables* const> all, double step);
  void begin(double step);
  void end(double step, int most);

  LooseSettings settings_;
  HoseLine hose_;
  CableLines lines_;
  LineBench bench_;
  std::vector<Ring> rings_;
  std::vector<const CableLines::Frame*> frames_;        ///< (cable)
  std::vector<std::pair<Ring*, std::size_t>> in_ring_;  ///< (cable) its ring and number there; null: in none
  std::vector<CableState> states_;
  std::size_t restless_ = 0, iterations_ = 0;
  bool started_ = false, rests_ = true, wound_ = false;
};

}  // namespace dresslife::strain
