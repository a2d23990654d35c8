// Dependence of the worst wire's life on uncertain parameters (F27): the material's constants, and strains that dresslife-strain
// computed with other friction, slack and grips (/variation of strain.h5).
#pragma once

#include <span>
#include <vector>

#include "fatigue/strain_file.h"
#include "fatigue/verdict.h"
#include "pipeline/life/life_response.h"

namespace dresslife::fatigue {

/// Histories of the likely worst wires at one point of the strain parameters.
struct VariedStrains {
  std::array<double, pipeline::strain_parameters> z{};  ///< 0 for rest
  std::size_t rest = 0;                                 ///< rest of the loose cables; 0: the job's own
  pipeline::Inside inside = pipeline::Inside::as_is;
  std::vector<std::vector<float>> strains;  ///< (wire) strains of its reversals
  std::vector<std::size_t> site;            ///< (wire) number among the job's own sites, which gives the material
};

/// Reads the points of /variation of strain.h5 without their strains; empty if the strain stage computed none.
std::vector<VariedStrains> read_variation_points(const pipeline::FileReader& strain);

/// Reads /variation of strain.h5; empty if the strain stage computed none.
std::vector<VariedStrains> read_variations(const pipeline::FileReader& strain, std::size_t sites);

/// Returns the variations with only the wires whose sites are true in `counts` (site).
std::vector<VariedStrains> only(const std::vector<VariedStrains>& varied, const std::vector<bool>& counts);

/// Returns the number of starts of loose cables at each rest, (rest); empty: the cables form no ring.
std::vector<std::size_t> read_rests(const pipeline::FileReader& strain);

/// Fills in log10 of the worst wire's life in repeats at every point and over strength and slope, (point, strength, slope). The
/// first point is the job itself with its wires `own`.
void fill_response(pipeline::LifeResponse& response, const VariedStrains& own, std::span<const VariedStrains> varied,
                   const SiteSet& sites, const TextColumn& component, const pipeline::Job& job, std::size_t threads);

/// Removes the last point, the job itself with the equivalent strains (F17) of its wires, where `own` has those across their planes
/// (F18). Adds the difference of both points to all others, which have only equivalent strains. Returns this difference at the
/// job's own strength and slope [decades]. Where either point has no damage it is 0.
double put_planes(pipeline::LifeResponse& response);

/// Returns z of hose_stiffness from which on a softer and a stiffer hose are pulled tight (attributes of strain.h5); empty: none is.
std::vector<double> read_taut_stiffnesses(const pipeline::FileReader& strain);

/// Adds a life of one repeat at these stiffnesses and beyond: there the motion tears the dresspack or pulls it out of its clamps.
/// Without it, a straight line through the other stiffnesses would give such hoses the longest lives. If no other stiffness was
/// simulated on the other side, lives there are those of the job's own stiffness.
void put_taut(pipeline::LifeResponse& response, const std::vector<double>& stiffnesses);

/// (W40) Makes the lives at the rests of loose cables a parameter of the response. The z of a rest is the normal score of its
/// life among those of all starts, minus the score of the job's own rest. The mean of the prior is reduced by the same score. The
/// effect of a variation that starts from another rest is used for the job's own rest, too (pipeline::together()). At another
/// slack lives stay as computed, because cables leave their rest there (strain/measurements.md).
/// response: at 0 and at the points of varied. starts: (rest); varied contains all rests except the first.
void put_rests(pipeline::LifeResponse& response, std::span<const VariedStrains> varied,
               const std::vector<std::size_t>& starts);

}  // namespace dresslife::fatigue
