// The life of a dresspack under several programs.
//
// Damage adds up over programs, wire by wire (Miner). With D_k the damage per repeat of program k, r_k its repeats per
// hour of operation, the damage of a failure mode m in an hour is, in each sample s of everything that is uncertain,
//     R(m, s) = max(c(m) sum over k of r_k(s) / L_k(m, s), max over k of r_k(s) / L_k(m, s))                 (D1)
// L_k(m, s): repeats until the mode fails under program k alone (life_response.h), over common samples. The programs may
// wear different places. The sum assumes one place, and c(m) <= 1 corrects it for that by the medians. No program can do less
// damage beside others than alone, which the second term states: so a program more never makes a life longer.
//     c(m) = max over places p of sum_k r_k D_k(p) / sum_k r_k max over p of D_k(p)                          (D2)
// Where the programs run in a known order, the numerator counts the changes between them (rounds.h, D8).
// A place is a conductor at a segment. Its damage is that of the wire whose break is its failure: with n wires of which a
// share q may be lost, of the n q-th wire. The dresspack fails with its first mode, after 1 / max over m of R(m, s) hours.
// Without an order, cycles that open in one program and close in another are not counted. They need a strain in one program
// that the other does not reach, and occur once per change of the program.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "pipeline/life/first_failure.h"

namespace dresslife::pipeline {

/// Damage of all wires under one program.
struct WireDamage {
  std::vector<double> damage;          ///< (site) per repeat
  std::vector<std::uint32_t> wire;     ///< (site) index; a wire at a segment has several sites around its surface
  std::vector<std::uint32_t> place;    ///< (wire) index
  std::vector<std::uint32_t> mode;     ///< (place) index into the modes
  std::vector<std::uint32_t> failing;  ///< (place) the number of broken wires that is its failure, at least 1
  std::string layout;                  ///< digest of sites and places: equal in all programs of one dresspack
  std::vector<double> worst{};         ///< (mode) damage of the place that fails first; empty: not computed yet
};
/// From a life.h5. modes: of its life response. failed_percent: share of wires that a conductor may lose. Errors:
/// InputError.
WireDamage wire_damage(const std::filesystem::path& life_file, const FailureModes& modes, double failed_percent);

/// A program as it was evaluated. Programs with the same result share modes and wires.
struct EvaluatedProgram {
  std::string job;
  double repeat_seconds = 0;
  std::shared_ptr<const FailureModes> modes;
  std::shared_ptr<const WireDamage> wires;
};

/// How often it runs in an hour of operation.
struct Rate {
  double repeats_per_hour = 0;
  double deviation_percent = 0;  ///< the factor is lognormal, its median 1
};

/// Damage per hour of operation under one duty, of common samples.
struct DutyDamage {
  /// (program) (mode, sample) c(m) r_k(s) / L_k(m, s) [1/h]
  std::vector<std::vector<std::vector<double>>> of_program;
  /// (mode) c(m), 1: all programs wear the same place most, and changes between them do no damage of their own
  std::vector<double> same_place;

  std::size_t samples() const { return of_program.front().front().size(); }
  std::size_t modes() const { return of_program.front().size(); }
  /// R of (D1)
  double in_mode(std::size_t mode, std::size_t sample) const;
  /// (sample) of the mode that fails first.
  std::vector<double> of_first_mode() const;
};

/// c(m) of one duty at any rates. Refers to the programs and the round.
class SamePlace {
 public:
  /// round: damage of a round of the order; null: none. Precondition: at least one program; all have the same modes and layout.
  explicit SamePlace(const std::vector<EvaluatedProgram>& programs, const WireDamage* round = nullptr);
  /// (mode) c(m), (D2). repeats_per_hour: (program).
  std::vector<double> at(const std::vector<double>& repeats_per_hour) const { return at(repeats_per_hour, repeats_per_hour); }
  /// The same with the numerator of (D8). in_rounds: (program, then the round).
  std::vector<double> at(const std::vector<double>& repeats_per_hour, const std::vector<double>& in_rounds) const;

 private:
  const std::vector<EvaluatedProgram>& programs_;
  const WireDamage* round_;
  std::vector<std::vector<double>> alone_;  ///< (program, mode) max over p of D_k(p)
};

/// (mode, sample) of one dresspack.
using RepeatDamage = std::vector<std::vector<double>>;
RepeatDamage damage_of_repeat(const FailureModes& modes, const std::string& dresspack, std::size_t samples);

/// (sample) r_k(s) over its median, of one dresspack.
std::vector<double> repeat_factors(const std::string& job, double deviation_percent, const std::string& dresspack, std::size_t samples);

/// Of one duty and one dresspack. share: of SamePlace. of_repeat: damage_of_repeat() of a program. factors_of:
/// repeat_factors() of a program with this deviation.
DutyDamage damage_under(const std::vector<EvaluatedProgram>& programs, const std::vector<Rate>& rates,
                        const std::vector<double>& share,
                        const std::function<const RepeatDamage&(const EvaluatedProgram&)>& of_repeat,
                        const std::function<const std::vector<double>&(const EvaluatedProgram&, double)>& factors_of);
/// (sample) DutyDamage::of_first_mode() of the same, without the damage of each program.
std::vector<double> first_mode_damage(const std::vector<EvaluatedProgram>& programs, const std::vector<Rate>& rates,
                                      const std::vector<double>& share,
                                      const std::function<const RepeatDamage&(const EvaluatedProgram&)>& of_repeat,
                                      const std::function<const std::vector<double>&(const EvaluatedProgram&, double)>& factors_of);
/// dresspack: names what only this dresspack has (first_failures()).
DutyDamage damage_under(const std::vector<EvaluatedProgram>& programs, const std::vector<Rate>& rates,
                        const std::vector<double>& share, const std::string& dresspack, std::size_t samples = life_samples);
DutyDamage damage_under(const std::vector<EvaluatedProgram>& programs, const std::vector<Rate>& rates,
                        const std::string& dresspack, std::size_t samples = life_samples);

/// What a dresspack has done before: hours under a duty.
struct PastDamage {
  const DutyDamage* duty;
  double hours;
};

struct DutyLives {
  std::vector<double> log10_hours;  ///< (sample) of operation until failure, from a new dresspack on
  LifePercentiles percentiles{};    ///< [h]
  std::vector<double> share;        ///< (program) of the damage of the mode that fails first, mean over the samples
  /// With a history: the share of samples that have survived it, and the hours until failure from now on, of those.
  double survived = 1;
  LifePercentiles remaining{};
};
DutyLives lives_under(const DutyDamage& duty, const std::vector<PastDamage>& history = {});

/// Lives [h] with `times` (program) as many repeats. share: of SamePlace at those.
LifePercentiles lives_with(const DutyDamage& duty, const std::vector<double>& times, const std::vector<double>& share);

}  // namespace dresslife::pipeline
