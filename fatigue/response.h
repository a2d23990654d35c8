// How the worst wire's life answers to what is not known: its material's constants, and strains that
// dresslife-strain worked out with other friction, slack, play and grips (/variation of strain.h5). README
// (F27).
#pragma once

#include <span>
#include <vector>

#include "fatigue/strain_file.h"
#include "fatigue/verdict.h"
#include "pipeline/life/life_response.h"

namespace dresslife::fatigue {

/// Histories of the wires that may be the worst, at one point of the strain side.
struct VariedStrains {
  std::array<double, pipeline::strain_parameters> z{};  ///< 0 of rest
  std::size_t rest = 0;                                 ///< where loose cables rest; 0: the job's own place
  pipeline::Inside inside = pipeline::Inside::as_is;
  std::vector<std::vector<float>> strains;  ///< (wire) of its reversals
  std::vector<std::size_t> site;            ///< (wire) of the job's own set: it gives the material
};

/// strain.h5's /variation; nothing where the strain stage tried none.
std::vector<VariedStrains> read_variations(const pipeline::FileReader& strain, std::size_t sites);

/// Of those, the wires of sites that `counts` (site).
std::vector<VariedStrains> only(const std::vector<VariedStrains>& varied, const std::vector<bool>& counts);

/// (rest) how many starts of loose cables came to each place of rest; empty: no ring of them.
std::vector<std::size_t> read_rests(const pipeline::FileReader& strain);

/// log10 of the worst wire's life in repeats at every point and over strength and slope, (point, strength,
/// slope); the first point is as the job stands, `own` its wires. starts: (rest), see read_rests() and put_rests().
void fill_response(pipeline::LifeResponse& response, const VariedStrains& own,
                   std::span<const VariedStrains> varied, const std::vector<std::size_t>& starts,
                   const SiteSet& sites, const TextColumn& component, const pipeline::Job& job,
                   std::size_t threads);

/// (W40) Lives at the rests of loose cables become a parameter of the response: the z of a rest is the normal score of its
/// life among those of all starts less that of the job's own rest, and the mean of what is known is less by that of the
/// job's own. What a variation changes from another rest it changes from the job's own, too (pipeline::together()). At
/// another slack lives stay as computed: cables leave their rest there (strain/measurements.md).
/// response: at 0 and at the points of varied. starts: (rest), of which varied has all but the first.
void put_rests(pipeline::LifeResponse& response, std::span<const VariedStrains> varied,
               const std::vector<std::size_t>& starts);

}  // namespace dresslife::fatigue
