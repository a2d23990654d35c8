#include "fatigue/wall_life.h"

#include <algorithm>
#include <cmath>

#include "fatigue/damage.h"
#include "fatigue/life_distribution.h"
#include "fatigue/strain_life.h"
#include "pipeline/base/statistics.h"
#include "pipeline/cable/bend_limit.h"
#include "pipeline/cable/corrugation.h"
#include "pipeline/job/job.h"
#include "pipeline/job/wall_strength.h"
#include "pipeline/life/first_failure.h"
#include "pipeline/life/unvalidated_modes.h"

namespace dresslife::fatigue {

using pipeline::LifeResponse;

LifeResponse wall_response(std::span<const Reversal> worst_place, const pipeline::Job& job, std::size_t dresspack) {
  const pipeline::Dresspack& of = job.dresspacks[dresspack].dresspack;
  const pipeline::Material& material = pipeline::hose_material_of(job, of);
  LifeResponse response;
  response.mode = pipeline::UnvalidatedMode::wall;
  response.dresspack = pipeline::name_among(job, dresspack);
  response.construction = of.name;
  response.material = pipeline::wall_strength_of(material);
  response.knowledge = pipeline::wall_knowledge(job, material);
  response.strength = {-4, -2, 0, 2, 4};
  response.worst_life.clear();
  for (const double z : response.strength) {
    pipeline::Fatigue stronger;
    stronger.strength_factor = std::pow(pipeline::wall_strength_step, z);
    const DamageCounter counter(changed(material, stronger), job.fatigue, pipeline::instruction_set(),
                                2 * std::pow(10, LifeResponse::undamaged));
    const double damage = sum_of_damage(counter.cycles(worst_place));
    response.worst_life.push_back(damage > 0 ? std::min(-std::log10(damage), LifeResponse::undamaged)
                                             : LifeResponse::undamaged);
  }
  const double median = response.worst_life[response.strength.size() / 2];
  response.bound.fill(median);
  response.planned.resize(1);
  for (std::size_t i = 0; i < percentiles.size(); ++i)
    response.planned[0][i] =
        median + pipeline::normal_quantile(percentiles[i]) * job.fatigue.scatter_log10 * job.fatigue.scatter_factor;
  response.scatter_shared = 0;
  return response;
}

double wall_bends_at_limit(const LifeResponse& wall, const pipeline::Job& job, std::size_t dresspack) {
  const pipeline::Dresspack& of = job.dresspacks[dresspack].dresspack;
  const pipeline::Material& material = pipeline::hose_material_of(job, of);
  if (material.strain_life_table.size() < 2) return 0;
  const pipeline::WallFactors factors = pipeline::wall_factors(of);
  const double range = factors.strain * factors.radius / pipeline::least_bend_radius(of),
               z = wall.knowledge.mean(static_cast<Eigen::Index>(index_of(pipeline::Uncertain::strength)));
  return StrainLifeTable(material.strain_life_table).cycles(range / 2 / std::pow(pipeline::wall_strength_step, z));
}

}  // namespace dresslife::fatigue
