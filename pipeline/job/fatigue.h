// Settings of dresslife-fatigue.
//
// A choice of the user is an enumeration with a word() for each value, in the order of the values. Where the
// code goes one of two ways by it, that is a named question.
#pragma once

#include <string>
#include <string_view>

#include "pipeline/base/words.h"

namespace dresslife::pipeline {

class Fields;

enum class Stress { cyclic, elastic };
constexpr std::string_view word(Stress value) { return word_at({"cyclic", "elastic"}, value); }
/// Whether stress follows the cyclic curve; else it is E times strain.
constexpr bool yields(Stress value) { return value == Stress::cyclic; }

enum class MeanStress { none, morrow, swt, walker };
constexpr std::string_view word(MeanStress value) {
  return word_at({"none", "morrow", "swt", "walker"}, value);
}

/// What becomes of the stress that a repeated history is off centre by (fatigue/README.md, F22).
enum class MeanStressRelaxation { none, power_law, complete };
constexpr std::string_view word(MeanStressRelaxation value) {
  return word_at({"none", "power_law", "complete"}, value);
}

enum class Counting { repeating, half_cycles };
constexpr std::string_view word(Counting value) { return word_at({"repeating", "half_cycles"}, value); }
/// Whether the motion repeats without end; else it happens once.
constexpr bool is_repeated(Counting value) { return value == Counting::repeating; }

struct Fatigue {
  Stress stress = Stress::cyclic;
  MeanStress mean_stress = MeanStress::swt;
  MeanStressRelaxation mean_stress_relaxation = MeanStressRelaxation::power_law;
  Counting counting = Counting::repeating;
  double endurance_strain = 0;  ///< amplitudes up to this do no damage
  std::string material;         ///< of every wire (not of the hose) instead of its own; empty: its own
  int listed_sites = 20;        ///< worst sites whose cycles are written
  double operating_hours_per_week = 80;  ///< turns hours into months
  double robot_life_hours = 40000;       ///< tables name no longer life [h]
  double scatter_log10 = 0.2;            ///< standard deviation of log10 of a wire's life
  double scatter_shared = 0.5;       ///< share of its variance that all wires of a dresspack have in common
  double failed_wires_percent = 10;  ///< a conductor fails when so many of its wires have
  bool load_sharing = false;         ///< the rest of a conductor takes over the load of its broken wires
  // What is not known (uncertainty.h); of wires, not of the hose:
  double strength_factor = 1;  ///< of strains and stresses of the strain-life curve
  double slope_change = 0;     ///< of b
  double scatter_factor = 1;   ///< of scatter_log10
  double model_factor = 1;     ///< of lives
  double motion_factor = 1;    ///< of the wires' lives, for the swing of the hose and resting places
};

/// Whether a wire's material is another than its own (uncertainty.h, changed()).
constexpr bool is_changed(const Fatigue& fatigue) {
  return fatigue.strength_factor != 1 || fatigue.slope_change != 0 || fatigue.model_factor != 1 ||
         fatigue.motion_factor != 1;
}

void describe(Fields& f, Fatigue& fatigue);

}  // namespace dresslife::pipeline
