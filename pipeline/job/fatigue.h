// Settings of dresslife-fatigue.
//
// A choice of the user is an enumeration with a word() for each value, in the order of the values. A named function answers each
// question that the code asks about it.
#pragma once

#include <string>
#include <string_view>

#include "pipeline/base/words.h"

namespace dresslife::pipeline {

class Fields;

enum class Stress { cyclic, elastic };
constexpr std::string_view word(Stress value) { return word_at({"cyclic", "elastic"}, value); }
/// Returns whether stress follows the cyclic curve; otherwise it is E times strain.
constexpr bool yields(Stress value) { return value == Stress::cyclic; }

enum class MeanStress { none, morrow, swt, walker };
constexpr std::string_view word(MeanStress value) { return word_at({"none", "morrow", "swt", "walker"}, value); }

/// Relaxation of the offset of stress in a repeated history (fatigue/theory.md, F22).
enum class MeanStressRelaxation { none, power_law, complete };
constexpr std::string_view word(MeanStressRelaxation value) {
  return word_at({"none", "power_law", "complete"}, value);
}

enum class Counting { repeating, half_cycles };
constexpr std::string_view word(Counting value) { return word_at({"repeating", "half_cycles"}, value); }
/// Returns whether the motion repeats without end; otherwise it happens once.
constexpr bool is_repeated(Counting value) { return value == Counting::repeating; }

struct Fatigue {
  Stress stress = Stress::cyclic;
  MeanStress mean_stress = MeanStress::swt;
  MeanStressRelaxation mean_stress_relaxation = MeanStressRelaxation::power_law;
  Counting counting = Counting::repeating;
  double endurance_strain = 0;  ///< amplitudes up to this value cause no damage
  std::string material;         ///< replaces the material of every wire (not of the hose); empty: each wire has its own
  int listed_sites = 20;        ///< number of worst sites whose cycles are written
  double operating_hours_per_week = 80;  ///< converts hours into months
  double robot_life_hours = 40000;       ///< longest life that tables show [h]
  double scatter_log10 = 0.2;            ///< standard deviation of log10 of a wire's life
  double scatter_shared = 0.5;           ///< share of that variance that all wires of a dresspack have in common
  double failed_wires_percent = 10;      ///< share of broken wires at which a conductor fails [%]
  bool load_sharing = false;             ///< the remaining wires of a conductor take the load of its broken wires
  // Uncertain parameters (uncertainty.h) of wires, not of the hose:
  double strength_factor = 1;  ///< factor of strains and stresses of the strain-life curve
  double slope_change = 0;     ///< addend of b
  double scatter_factor = 1;   ///< factor of scatter_log10
  double model_factor = 1;     ///< factor of lives
  double motion_factor = 1;    ///< factor of the wires' lives for uncertain swinging and rest positions
};

/// Returns whether these settings change a wire's material (uncertainty.h, changed()).
constexpr bool is_changed(const Fatigue& fatigue) {
  return fatigue.strength_factor != 1 || fatigue.slope_change != 0 || fatigue.model_factor != 1 ||
         fatigue.motion_factor != 1;
}

void describe(Fields& f, Fatigue& fatigue);

}  // namespace dresslife::pipeline
