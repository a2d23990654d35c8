// Bending at clamps: what a bend relief takes off the strain there, and what strain reliefs hold.
//
// A rod of bending stiffness E I under the pull T that leaves a clamp by an angle a is bent most there and straightens over a
// boundary layer, curvature = (a / lambda) exp(-s / lambda), lambda = sqrt(E I / T). A bend relief of length l that is tapered
// so that it bends evenly shares the angle between itself and the layer beyond it, a = k (l + lambda):
//     curvature with / without relief = 1 / (1 + l / lambda)                                                (F32)
// Pull is not the only cause of such a layer (contact in the hose is another), so lambda is taken from the strains themselves.
// With S at the clamp and S' at the distance d, of which an unknown part c <= S' belongs to the path beyond the layer:
//     lambda(c) = d / ln[(S - c) / (S' - c)],   relieved S = max over c in [0, S'] of c + (S - c) / (1 + l / lambda(c))   (F33)
// the least help that is possible. A strain that does not fall away from the clamp is not relieved.
//
// Not contained: fretting at the edge, crushing, the turn of a clamp that is not rigid, steps in a relief that is not tapered.
#pragma once

namespace dresslife::fatigue {

/// (F33). distance, relief [m]; not negative, distance > 0.
double relieved_strain(double at_clamp, double beside, double distance, double relief);

/// Pull that a strain relief of EN 50262, type A (to 4 mm: what retains a cable), withstands by the diameter of its cable [m],
/// [N]: table 2A as OBO Bettermann prints it.
double strain_relief_force(double diameter);

}  // namespace dresslife::fatigue
