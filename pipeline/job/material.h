// The material of a wire or of the hose: its strain-life constants and cyclic curve (fatigue/theory.md).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/base/words.h"
#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

class Fields;

/// The body that rubs. On a hose: a link of the robot, a guide ring, meshes of the cell, the floor or another hose. On a cable:
/// the inside of its hose.
enum class Counterface { robot, ring, cell, floor, dresspack, hose };
constexpr std::string_view word(Counterface value) {
  return word_at({"robot", "ring", "cell", "floor", "dresspack", "hose"}, value);
}

/// Archard's wear rate of a pair of materials.
struct WearRate {
  Counterface against = Counterface::robot;
  double rate = 0;    ///< median of worn volume / (normal force * sliding distance) [m3/(N m)]
  double factor = 1;  ///< factor that is one standard deviation of the rate's logarithm
  std::string source;
};

/// One measured point of a strain-life curve.
struct StrainLifePoint {
  double strain_amplitude = 0;
  double cycles = 0;
};

struct Material {
  std::string name, source;
  double youngs_modulus = 0;  ///< E [Pa]
  double poisson_ratio = 0;
  std::optional<double> density;                    ///< [kg/m3]; absent: mass_of_part() takes that of copper
  double fatigue_strength = 0;                      ///< sigma_f' [Pa]
  double fatigue_strength_exponent = 0;             ///< b
  double fatigue_ductility = 0;                     ///< epsilon_f'
  double fatigue_ductility_exponent = 0;            ///< c
  std::optional<double> cyclic_strength;            ///< K' [Pa]; absent: sigma_f' / epsilon_f'^n'
  std::optional<double> cyclic_hardening_exponent;  ///< n'; absent: b / c
  std::optional<double> tensile_strength;           ///< at which a wire tears [Pa]
  std::optional<double> walker_exponent;            ///< gamma; absent: 0.5, that of SWT
  std::optional<double>
      relaxation_threshold_strain;                 ///< strain above which mean stress relaxes; absent: it never relaxes
  std::optional<double> relaxation_exponent;       ///< relaxation exponent at twice the threshold; absent: 0.085
  std::vector<StrainLifePoint> strain_life_table;  ///< replaces sigma_f' to n', for polymers; larger strains first
  std::vector<WearRate> wear;                      ///< of a hose, sleeve or jacket; empty: abrasion is not evaluated
  Where where;

  /// Returns whether the material has a strain-life curve; otherwise it only wears.
  bool has_strain_life() const { return fatigue_strength > 0 || !strain_life_table.empty(); }
};

void describe(Fields& f, WearRate& rate);
void describe(Fields& f, StrainLifePoint& point);
void describe(Fields& f, Material& material);

/// Errors: InputError for measured lives that do not decrease, or for two wear rates against one body.
void check_materials(const std::vector<Material>& materials);

}  // namespace dresslife::pipeline
