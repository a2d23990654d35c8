// How far a clamp may stand from the link that carries it.
#pragma once

namespace dresslife::pipeline {

/// Between the link's surface and the dresspack's [m]. ESTIMATE: as far as plants let a bracket reach that is bolted to
/// a link and must not swing. `route` and `improve` take another by --bracket.
inline constexpr double longest_bracket = 0.15;

}  // namespace dresslife::pipeline
