// The material of a wire or of the hose: its strain-life constants and cyclic curve (fatigue/README.md).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

class Fields;

/// One measured point of a strain-life curve.
struct StrainLifePoint {
  double strain_amplitude = 0;
  double cycles = 0;
};

struct Material {
  std::string name, source;
  double youngs_modulus = 0;  ///< E [Pa]
  double poisson_ratio = 0;
  double fatigue_strength = 0;                        ///< sigma_f' [Pa]
  double fatigue_strength_exponent = 0;               ///< b
  double fatigue_ductility = 0;                       ///< epsilon_f'
  double fatigue_ductility_exponent = 0;              ///< c
  std::optional<double> cyclic_strength;              ///< K' [Pa]; absent: sigma_f' / epsilon_f'^n'
  std::optional<double> cyclic_hardening_exponent;    ///< n'; absent: b / c
  std::optional<double> tensile_strength;             ///< at which a wire tears [Pa]
  std::optional<double> walker_exponent;              ///< gamma; absent: 0.5, that of SWT
  std::optional<double> relaxation_threshold_strain;  ///< above it mean stress relaxes; absent: never
  std::optional<double> relaxation_exponent;          ///< at twice the threshold; absent: 0.085
  std::vector<StrainLifePoint>
      strain_life_table;  ///< instead of sigma_f' to n', for polymers; larger strains first
  Where where;
};

void describe(Fields& f, StrainLifePoint& point);
void describe(Fields& f, Material& material);

/// Errors: InputError where a table of measured lives does not fall.
void check_materials(const std::vector<Material>& materials);

}  // namespace dresslife::pipeline
