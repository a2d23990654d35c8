// What forces behind strains and what slack are believed: above, a stage and the ranking warn.
#pragma once

namespace dresslife::pipeline {

/// Of the force at which a cable tears, and of the moment that a hose carries at its clamps. A fifth of
/// annealed copper's 230 N/mm2 is what cables may be pulled with while they are laid (50 N/mm2, DIN VDE
/// 0298-3; 15 in service): no dresspack bears more in every repeat. Cables that took a fifth of the hose's
/// moment would make it that much stiffer than it was measured and simulated.
constexpr double believable_share = 0.2;

/// Of the slack of a loose cable, as a share of its path: dresspacks are laid with 1 to 2 %. More causes a warning, and no
/// remedy proposes it.
constexpr double usual_slack = 0.01, largest_slack = 0.05;

}  // namespace dresslife::pipeline
