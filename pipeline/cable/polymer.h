// What jackets, insulation, hoses and fillers are of, where a maker's sheet does not tell.
#pragma once

namespace dresslife::pipeline {

// ESTIMATES: polyurethane, PVC or TPE, of which 50 MPa is a soft one at a bend's small strain.
constexpr double polymer_modulus = 50e6;  // [Pa]
constexpr double polymer_density = 1200;  // [kg/m3]
constexpr double torsion_of_polymer =
    2.0 / 3;  // G J over E I of a round that keeps its volume: G = E/3, J = 2 I

}  // namespace dresslife::pipeline
