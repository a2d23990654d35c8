// The life of a dresspack under several programs.
//
// Damage adds up over programs, wire by wire (Miner). D_k: damage per repeat of program k. r_k: its repeats per hour of
// operation. In each sample s of all uncertain values, the damage of a failure mode m per hour is
//     R(m, s) = max(c(m) sum over k of r_k(s) / L_k(m, s), max over k of r_k(s) / L_k(m, s))                 (D1)
// L_k(m, s): repeats until the mode fails under program k alone (life_response.h), over common samples. The programs may
// wear different places. The sum assumes one place, and c(m) <= 1 corrects this with the medians. A program does not do less
// damage beside others than alone; the second term ensures this, so an additional program never makes a life longer.
//     c(m) = max over places p of sum_k r_k D_k(p) / sum_k r_k max over p of D_k(p)                          (D2)
// If the programs run in a known order, the numerator includes the changes between them (rounds.h, D8).
// A place is a conductor at a segment. Its damage is that of the wire whose break makes the place fail: with n wires, of which
// a share q may be lost, the n q-th wire. The dresspack fails by its first mode, after 1 / max over m of R(m, s) hours.
// Without an order, cycles that open in one program and close in another are not counted. Such cycles need a strain in one
// program that the other does not reach, and occur once per change of the program.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "pipeline/life/first_failure.h"

namespace dresslife::pipeline {

/// Division of a dresspack's sites into wires and places.
struct WireLayout {
  std::vector<std::uint32_t>
      wire;  ///< (site) index of the wire; a wire at a segment has several sites around its surface
  std::vector<std::uint32_t> place;    ///< (wire) index of the place
  std::vector<std::uint32_t> mode;     ///< (place) index of the mode
  std::vector<std::uint32_t> failing;  ///< (place) number of broken wires at which the place fails, at least 1
  std::string digest{};                ///< of sites and places: equal in all programs of one dresspack
  // From sort_sites():
  std::vector<std::uint32_t> sites{};        ///< sites of the first place, then those of the next one, ..
  std::vector<std::uint32_t> sites_begin{};  ///< (place) its first element of `sites`; the last: end

  void sort_sites();
};

/// Damage of all wires under one program.
struct WireDamage {
  /// layout: after sort_sites(). damage: (site) damage per repeat. modes: number of modes.
  WireDamage(std::shared_ptr<const WireLayout> layout, const std::vector<double>& damage, std::size_t modes);
  /// Returns the damage of the wire whose break makes a place fail, if each site of the place has this damage. damage: (element of
  /// WireLayout::sites, from the place's first one).
  static double of_place(const WireLayout& layout, std::size_t place, const double* damage);

  std::shared_ptr<const WireLayout> layout;  ///< programs with equal sites share it
  std::vector<double> in_order;              ///< (element of WireLayout::sites) damage per repeat
  std::vector<double> worst;                 ///< (mode) damage of the place that fails first
  std::vector<double> largest;               ///< (place) largest damage of its wires
};

/// What a life.h5 states about its sites, and what divides them into places.
struct WireSites {
  struct Mode {
    std::string name, dresspack;
    bool operator==(const Mode&) const = default;
  };
  std::vector<std::int32_t> segment;               ///< (site)
  std::vector<std::string> component, conductors;  ///< (site), (conductor)
  std::vector<Mode> modes;
  double failed_percent = 0;  ///< share of wires that a conductor may lose
  bool operator==(const WireSites&) const = default;
};

/// Reads life.h5 files. The programs of a plant mostly have equal sites, which are read and divided into places once.
class WireDamages {
 public:
  /// modes: modes of the file's life response. Errors: InputError, also for a mode with damage and without a conductor.
  WireDamage read(const std::filesystem::path& life_file, const FailureModes& modes, double failed_percent);

 private:
  // Of the previous file:
  WireSites sites_;           ///< without `component`
  std::string stored_names_;  ///< FileReader::stored() of `component`
  std::shared_ptr<const WireLayout> layout_;
};

/// A program with its results. Programs with the same result share modes and wires.
struct EvaluatedProgram {
  std::string job;
  double repeat_seconds = 0;
  std::shared_ptr<const FailureModes> modes;
  std::shared_ptr<const WireDamage> wires;
};

/// Number of repeats of a program in an hour of operation.
struct Rate {
  double repeats_per_hour = 0;
  double deviation_percent = 0;  ///< standard deviation of a lognormal factor with median 1
};

/// Damage per hour of operation under one duty, over common samples.
struct DutyDamage {
  /// (program) (mode, sample) c(m) r_k(s) / L_k(m, s) [1/h]
  std::vector<std::vector<std::vector<double>>> of_program;
  /// (mode) c(m); 1: all programs wear the same place most, and changes between them cause no damage
  std::vector<double> same_place;

  std::size_t samples() const { return of_program.front().front().size(); }
  std::size_t modes() const { return of_program.front().size(); }
  /// Returns R of (D1).
  double in_mode(std::size_t mode, std::size_t sample) const;
  /// Returns, (sample), the damage of the mode that fails first.
  std::vector<double> of_first_mode() const;
};

/// Computes c(m) of one duty at any rates. Keeps references to the damage of the programs and of the round.
class SamePlace {
 public:
  /// round: damage of a round of the order; null: no order. Preconditions: one program or more, with equal modes and layout.
  explicit SamePlace(const std::vector<EvaluatedProgram>& programs, const WireDamage* round = nullptr);
  /// Returns c(m), (mode), by (D2). repeats_per_hour: (program).
  std::vector<double> at(const std::vector<double>& repeats_per_hour) const {
    return at(repeats_per_hour, repeats_per_hour);
  }
  /// Returns c(m), (mode), with the numerator of (D8). in_rounds: (program, then the round).
  std::vector<double> at(const std::vector<double>& repeats_per_hour, const std::vector<double>& in_rounds) const;

 private:
  double at_place(std::uint32_t place, const std::vector<double>& in_rounds) const;

  std::size_t modes_;
  std::vector<const WireDamage*> programs_;  ///< (program, then the round)
  std::size_t program_count_;
};

/// (mode, sample) damage of one repeat for one dresspack.
using RepeatDamage = std::vector<std::vector<double>>;
RepeatDamage damage_of_lives(std::vector<std::vector<double>> log10_lives);  ///< log10_lives: (mode, sample)

/// Returns r_k(s) over its median, (sample), for one dresspack. memory: a list that is no longer needed; the result takes its memory.
std::vector<double> repeat_factors(const std::string& job, double deviation_percent, const std::string& dresspack,
                                   std::size_t samples, std::vector<double> memory = {});

/// Returns the damage under one duty for one dresspack. share: c(m) of SamePlace. of_repeat: returns the damage of one repeat
/// of a program. factors_of: returns repeat_factors() of a program with this deviation.
DutyDamage damage_under(const std::vector<EvaluatedProgram>& programs, const std::vector<Rate>& rates,
                        const std::vector<double>& share,
                        const std::function<const RepeatDamage&(const EvaluatedProgram&)>& of_repeat,
                        const std::function<const std::vector<double>&(const EvaluatedProgram&, double)>& factors_of);
/// Returns DutyDamage::of_first_mode(), (sample), without storing the damage of each program.
std::vector<double> first_mode_damage(
    const std::vector<EvaluatedProgram>& programs, const std::vector<Rate>& rates, const std::vector<double>& share,
    const std::function<const RepeatDamage&(const EvaluatedProgram&)>& of_repeat,
    const std::function<const std::vector<double>&(const EvaluatedProgram&, double)>& factors_of);
/// Returns the damage under one duty. dresspack: name for values that only this dresspack has (first_failures()).
DutyDamage damage_under(const std::vector<EvaluatedProgram>& programs, const std::vector<Rate>& rates,
                        const std::vector<double>& share, const std::string& dresspack,
                        std::size_t samples = life_samples);

/// Damage of a dresspack in the past: hours under a duty.
struct PastDamage {
  const DutyDamage* duty;
  double hours;
};

struct DutyLives {
  std::vector<double> log10_hours;  ///< (sample) hours of operation from a new dresspack until failure
  LifePercentiles percentiles{};    ///< [h]
  std::vector<double> share;  ///< (program) share of the damage of the mode that fails first, mean over the samples
  /// With a history: share of the samples that have survived it, and for these samples the hours from now until failure.
  double survived = 1;
  LifePercentiles remaining{};
};
DutyLives lives_under(const DutyDamage& duty, const std::vector<PastDamage>& history = {});

/// Returns lives [h] with `times` (program) as many repeats. share: c(m) of SamePlace for these repeats.
LifePercentiles lives_with(const DutyDamage& duty, const std::vector<double>& times, const std::vector<double>& share);

}  // namespace dresslife::pipeline
