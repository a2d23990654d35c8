// Whether the strain reliefs at the clamps hold what the cables pull.
//
// EN 50262 (today EN 62444) tests cable glands with a pull by the cable's diameter. A strain relief of type A has to hold it;
// type B holds more. Source: OBO Bettermann, "Kabelverschraubung und die DIN EN 50262", table 2A. A cable clamp that is no
// gland is not tested by it, so that a larger pull is a reason to look at the clamp and no failure. Not contained: ageing and
// heat, by which jackets yield in a clamp; a pull that comes and goes.
#pragma once

namespace dresslife::fatigue {

/// Pull that a strain relief of type A holds [N]. diameter: of the cable [m]. Up to 4 mm the standard has none for a strain
/// relief; then this is the 5 N by which a gland has to retain it.
double held_by_strain_relief(double diameter);

}  // namespace dresslife::fatigue
