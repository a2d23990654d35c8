// Default limit for the distance of a clamp from the link that carries it.
#pragma once

namespace dresslife::pipeline {

/// Between the link's surface and the dresspack [m]. ESTIMATE: the longest bracket that plants bolt to a link without swinging. A
/// job sets another limit with routing.longest_bracket_mm.
inline constexpr double usual_longest_bracket = 0.15;

}  // namespace dresslife::pipeline
