// How the worst wire's life answers to what is not known: its material's constants, and strains that
// dresslife-strain worked out with other friction, slack, play and grips (/variation of strain.h5). README
// (F27).
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "fatigue/strain_file.h"
#include "fatigue/verdict.h"
#include "pipeline/life/life_response.h"

namespace dresslife::fatigue {

/// Histories of the wires that may be the worst, at one point of the strain side.
struct VariedStrains {
  std::array<double, pipeline::strain_parameters> z{};
  pipeline::Inside inside = pipeline::Inside::as_is;
  std::vector<std::vector<float>> strains;  ///< (wire) of its reversals
  std::vector<std::size_t> site;            ///< (wire) of the job's own set: says of which material it is
};

/// strain.h5's /variation; nothing where the strain stage tried none.
std::vector<VariedStrains> read_variations(const pipeline::FileReader& strain, std::size_t sites);

/// Of those, the wires of sites that `counts` (site).
std::vector<VariedStrains> only(const std::vector<VariedStrains>& varied, const std::vector<bool>& counts);

/// log10 of the worst wire's life in repeats at every point and over strength and slope, (point, strength,
/// slope); the first point is as the job stands, `own` its wires.
void fill_response(pipeline::LifeResponse& response, const VariedStrains& own,
                   std::span<const VariedStrains> varied, const SiteSet& sites, const TextColumn& component,
                   const pipeline::Job& job, std::size_t threads);

}  // namespace dresslife::fatigue
