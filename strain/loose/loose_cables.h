// Places of all cables of one hose, sample by sample ((W32) to (W36) in strain/theory.md). First each ring turns. Then each
// cable moves to the minimum of its energy about its place in the ring.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "strain/loose/cable_lines.h"
#include "strain/loose/line_bench.h"
#include "strain/loose/ring.h"

namespace dresslife::strain {

/// Place of the largest change of curvature in a repeat.
struct ChangedPlace {
  std::size_t cable = 0;
  double arc = 0;  ///< from the base end of the hose's axis [m]
};

struct LooseSettings {
  double length = 0;          ///< of the hose's axis between the clamps [m]
  std::size_t elements = 64;  ///< of equal length
  double rest_curvature = 0;  ///< about d2, of the hose as the cables were mounted [1/m]
  bool presses = true;        ///< computes the contact forces

  bool operator==(const LooseSettings&) const = default;
};

/// Returns the radius in which a cable can wind [m]: its play about its place, or the radius of its ring, or, for a cable alone,
/// its distance limit from the hose's axis.
double winding_radius(const LooseCable& cable);

/// Returns the number of elements that resolves the waves of cables; call fit_in_hose() before. An excess length by a share s
/// winds in a room of radius c with k c = sqrt(2 s), about a place that turns by the lay. Second differences miss (k h)^2/12
/// of its curvature. The limit is 0.25 %, so that waves of half the length, between a core and a wall that leave less room, miss at
/// most the 1 % of the warning. At least 104 elements: with 64, three programs miss 1.4 to 1.9 %
/// (strain/measurements.md); with 104, a wound ring of ten cables misses 0.97 %.
/// length: of the axis [m].
std::size_t elements_of_waves(const std::vector<LooseCable>& cables, double length);

class LooseCables {
 public:
  /// cables: of one hose, after fit_in_hose() (strain/loose/rings.h).
  LooseCables(const std::vector<LooseCable>& cables, const LooseSettings& settings);
  LooseCables(const LooseCables&) = delete;  // frames_ and in_ring_ point into this object

  std::size_t nodes() const { return hose_.nodes(); }
  std::size_t cables() const { return lines_.count(); }
  double length() const { return settings_.length; }  ///< of the hose's axis [m]
  const LooseCable& cable(std::size_t k) const { return lines_.cable(k); }
  double laid_in(std::size_t k) const { return lines_.laid_in(k); }  ///< see CableLines

  /// Returns whether these are the same cables in the same hose, which rest at the same places under the same motion.
  bool same_cables(const LooseCables& other) const;

  bool any_ring() const { return !rings_.empty(); }
  /// Winds the rings at the start, with all of their slack: by random_winding(), or by a turn (node) [rad]. Call before the first
  /// sample.
  void wind(std::uint64_t seed);
  void wind(const std::vector<double>& turn);
  /// Continues from the state of `other`, which must have the same numbers of cables, rings and nodes. Call before the first
  /// sample.
  void go_on_from(const LooseCables& other);
  /// Sets the share of the slack that is in the hose; it can exceed 1.
  void feed_in(double share);
  /// Returns the difference of curvature to the same cables from another start, over their own curvature: root mean squares
  /// over cables and nodes.
  double apart(const LooseCables& other) const;

  /// Sets the shortening of an untensioned cable by twist for the next samples, a share of its length.
  void shorten(std::size_t cable, double share);
  /// Moves all cables to their rests at the next sample. hose: (node). step: since the previous sample [s].
  void advance(std::span<const HoseNode> hose, double step);
  /// Advances several objects that share only the hose and its samples. Side by side they need less time; the results are those
  /// of separate calls. seen: updates state(), and with it what apart(), changed() and begin_repeat() use; false in samples after
  /// which nothing of this is asked for.
  static void advance(std::span<LooseCables* const> all, std::span<const HoseNode> hose, double step, bool seen = true);

  const CableState& state(std::size_t cable) const { return states_[cable]; }
  /// Begins the repeat that counts. Call at the end of a lead-in.
  void begin_repeat();
  /// Ends a repeat of a lead-in and begins the next one. further: number of repeats of the lead-in that follow.
  void end_repeat(double further);
  /// Returns whether the cables had reached a cycle at end_repeat(): the change of curvature in this repeat times the number of
  /// further repeats was below 1 %.
  bool in_cycle() const { return in_cycle_; }
  /// Returns the number of samples since begin_repeat() at which a ring or a cable did not converge in the allowed iterations, also not
  /// in the time of further samples in which the hose stands still.
  std::size_t restless() const { return restless_; }
  /// Returns the change of curvature since begin_repeat(), over the curvature: root mean squares over cables and nodes. 0 without
  /// begin_repeat().
  double changed() const;
  /// Limit of changed() beyond which cables have not reached a cycle. A tenth of the strain is a factor of two in life (slope 7 of
  /// copper), as much as the stated numerical errors of good jobs.
  static constexpr double most_change = 0.1;
  /// Returns the cable whose curvature changed most since begin_repeat(), and the node with its largest change. Precondition:
  /// changed() > 0.
  ChangedPlace most_changed() const;
  std::size_t iterations() const { return iterations_; }  ///< sum over all cables and samples
  /// Returns the share of the curvature that the distance of nodes misses, as a ratio of root mean squares over nodes and
  /// samples; the largest of all cables.
  double mesh_error() const;

 private:
  void settle(double step);
  static void relax(std::span<LooseCables* const> all, double step, bool seen);
  void begin(double step);
  void end(double step, int most, bool seen);

  LooseSettings settings_;
  HoseLine hose_;
  CableLines lines_;
  LineBench bench_;
  std::vector<Ring> rings_;
  std::vector<const CableLines::Frame*> frames_;        ///< (cable) of its place
  std::vector<std::pair<Ring*, std::size_t>> in_ring_;  ///< (cable) its ring and its number there; null: no ring
  std::vector<std::vector<std::size_t>> of_ring_;       ///< (ring) its cables
  std::vector<std::vector<double>> radii_;              ///< (ring, cable) of their places; 0: not in the ring [m]
  std::vector<CableState> states_;
  std::vector<std::vector<double>> begun_;  ///< (cable, node) curvature at begin_repeat() [1/m]
  std::size_t restless_ = 0, iterations_ = 0;
  bool started_ = false, rests_ = true, wound_ = false, in_cycle_ = false;
};

}  // namespace dresslife::strain
