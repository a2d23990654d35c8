// Force that the strain reliefs at the clamps must hold.
//
// EN 50262 (now EN 62444) tests cable glands with a pull that depends on the cable's diameter. A strain relief of type A has to
// hold it; type B holds more. Source: OBO Bettermann, "Kabelverschraubung und die DIN EN 50262", table 2A. The standard does not
// test cable clamps that are not glands, so a larger pull is a reason to check the clamp, not a failure. Not contained: ageing
// and heat, by which jackets yield in a clamp; alternating pulls.
#pragma once

namespace dresslife::fatigue {

/// Returns the pull that a strain relief of type A holds [N]. diameter: of the cable [m]. Up to 4 mm the standard has no value
/// for a strain relief; then the result is the 5 N with which a gland has to retain the cable.
double held_by_strain_relief(double diameter);

}  // namespace dresslife::fatigue
