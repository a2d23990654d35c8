// Settings of dresslife-fatigue.
#pragma once

#include <string>

namespace dresslife::pipeline {

class Fields;

enum class Stress { cyclic, elastic };
enum class MeanStress { none, morrow, swt, walker };
enum class Counting { repeating, half_cycles };

struct Fatigue {
  Stress stress = Stress::cyclic;
  MeanStress mean_stress = MeanStress::swt;
  Counting counting = Counting::repeating;
  double endurance_strain = 0;  ///< amplitudes up to this do no damage
  std::string material;         ///< of every wire (not of the hose) instead of its own; empty: its own
  int listed_sites = 20;        ///< worst sites whose cycles are written
  double operating_hours_per_week = 80;  ///< turns hours into months
  double scatter_log10 = 0.2;            ///< standard deviation of log10 of a wire's life
  double failed_wires_percent = 10;      ///< a conductor fails when so many of its wires have
  bool load_sharing = false;             ///< the rest of a conductor takes over the load of its broken wires
};

void describe(Fields& f, Fatigue& fatigue);

}  // namespace dresslife::pipeline
