// How far a clamp may stand from the link that carries it.
#pragma once

namespace dresslife::pipeline {

/// Between the link's surface and the dresspack's [m]. ESTIMATE: as far as plants let a bracket reach that is bolted to
/// a link and must not swing. A job says another by routing.longest_bracket_mm.
inline constexpr double usual_longest_bracket = 0.15;

}  // namespace dresslife::pipeline
