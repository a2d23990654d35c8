#include "pipeline/job/material.h"

#include <algorithm>

#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {

void describe(Fields& f, WearRate& rate) {
  f.choice("against", rate.against, "What rubs. Counterfaces that the list leaves out wear like robot.");
  f.number("rate_mm3_per_Nm", rate.rate, Need::required, above(0),
           "The median of the worn volume over normal force times way.");
  f.number("factor", rate.factor, Need::required, between(1, 100), "The standard deviation of the rate, as a factor.");
  f.text("source", rate.source, Need::required, "The source of both.");
}

void describe(Fields& f, StrainLifePoint& point) {
  f.number("strain_amplitude", point.strain_amplitude, Need::required, between(1e-9, 10),
           "Half the strain range of the test.");
  f.number("cycles", point.cycles, Need::required, between(0.5, 1e15), "The median number of cycles to failure.");
}

void describe(Fields& f, Material& material) {
  f.place(material.where);
  f.text("name", material.name, Need::required, "The name of the material, as wires refer to it.");
  f.text("source", material.source, Need::required, "The source of the constants.");
  f.number("youngs_modulus_GPa", material.youngs_modulus, Need::required, above(0), "Young's modulus E.");
  f.maybe_number("tensile_strength_MPa", material.tensile_strength, above(0),
                 "The stress at which a wire tears. Warnings compare the forces of cables with it.");
  f.maybe_number("density_kg_per_m3", material.density, between(100, 23000),
                 "The density. Masses that are computed from wires, the hose's wall or a sleeve need it.");
  f.number("poisson_ratio", material.poisson_ratio, Need::optional, between(0, 0.5), "Poisson's ratio nu.");
  f.list("strain_life_table", material.strain_life_table, Need::optional,
         "Measured points instead of the constants below, larger strains first. The curve between them is "
         "straight in logarithms. It is meant for polymers.");
  f.list("wear", material.wear, Need::optional,
         "Wear rates, of a hose, sleeve or jacket. A material with them and without strain_life_table only wears: it "
         "has none of the constants below.");
  if (!material.wear.empty() && material.wear.front().rate > 0) return;
  const bool measured = !material.strain_life_table.empty() && material.strain_life_table.front().cycles > 0;
  if (measured) return;  // the manual describes one point with 0 cycles, so that it lists the other keys too
  f.number("fatigue_strength_MPa", material.fatigue_strength, Need::required, above(0),
           "The fatigue strength sigma_f' of equation (8).");
  f.number("fatigue_strength_exponent", material.fatigue_strength_exponent, Need::required, between(-1, -1e-3),
           "The exponent b of equation (8).");
  f.number("fatigue_ductility", material.fatigue_ductility, Need::required, above(0),
           "The fatigue ductility epsilon_f' of equation (8).");
  f.number("fatigue_ductility_exponent", material.fatigue_ductility_exponent, Need::required, between(-2, -1e-2),
           "The exponent c of equation (8).");
  f.maybe_number("cyclic_strength_MPa", material.cyclic_strength, above(0),
                 "The cyclic strength K'. Default: sigma_f'/epsilon_f'^n'.");
  f.maybe_number("cyclic_hardening_exponent", material.cyclic_hardening_exponent, between(0.01, 1),
                 "The cyclic hardening exponent n'. Default: b/c.");
  f.maybe_number("walker_exponent", material.walker_exponent, between(0, 1),
                 "The exponent gamma of mean_stress walker. Default: 0.5.");
  f.maybe_number("relaxation_threshold_strain", material.relaxation_threshold_strain, between(1e-6, 1),
                 "The strain amplitude above which mean stress relaxes, for mean_stress_relaxation power_law. Default: "
                 "it never relaxes.");
  f.maybe_number("relaxation_exponent", material.relaxation_exponent, between(0, 1),
                 "The exponent of the number of repeats at twice that amplitude. Default: 0.085.");
}

void check_materials(const std::vector<Material>& materials) {
  Problems problems;
  for (const Material& material : materials) {
    for (std::size_t i = 0; i < material.wear.size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        if (material.wear[k].against == material.wear[i].against)
          problems.add(material.where,
                       fmt::format("wear of '{}' lists '{}' twice", material.name, word(material.wear[i].against)),
                       "keep one of them");
    if (!material.wear.empty() &&
        std::ranges::none_of(material.wear, [](const WearRate& rate) { return rate.against == Counterface::robot; }))
      problems.add(material.where, fmt::format("wear of '{}' does not list 'robot'", material.name),
                   "give its rate against robot, which the other counterfaces fall back to");
    const auto& table = material.strain_life_table;
    if (table.size() == 1)
      problems.add(material.where, fmt::format("strain_life_table of '{}' has one point", material.name),
                   "give at least two");
    for (std::size_t i = 1; i < table.size(); ++i)
      if (!(table[i].strain_amplitude < table[i - 1].strain_amplitude && table[i].cycles > table[i - 1].cycles))
        problems.add(material.where,
                     fmt::format("point {} of strain_life_table of '{}' is no smaller strain with a longer life", i + 1,
                                 material.name),
                     "order the points by falling strain amplitude and rising cycles");
  }
  problems.finish();
}

}  // namespace dresslife::pipeline
