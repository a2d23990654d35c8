// Largest credible forces and slack. Above these limits, a stage and the ranking warn.
#pragma once

namespace dresslife::pipeline {

/// Limit as a share of a cable's breaking force, and of the moment that a hose transmits at its clamps. Cables may be pulled with
/// a fifth of the 230 N/mm2 of annealed copper during installation (50 N/mm2, DIN VDE 0298-3; 15 in service), so no dresspack
/// bears more in every repeat. If cables took a fifth of the hose's moment, the hose would be a fifth stiffer than it was
/// measured and simulated.
constexpr double believable_share = 0.2;

/// Slack of a loose cable as a share of its path. Dresspacks are installed with 1 to 2 %. More slack than largest_slack causes a
/// warning, and no remedy proposes it.
constexpr double usual_slack = 0.01, largest_slack = 0.05;

}  // namespace dresslife::pipeline
