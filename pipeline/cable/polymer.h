// Polymer properties of jackets, insulation, hoses and fillers without data from the maker.
#pragma once

namespace dresslife::pipeline {

// Polyurethanes of cables: flexural modulus 36 MPa at 82 Shore A, 149 MPa at 55 Shore D (Elasthane 80A and 55D, ASTM D790,
// maker's table). Jackets are of the softer ones.
constexpr double polymer_modulus = 50e6;  // [Pa]
// For jacket and insulation around wires, with the whole cross-section, although they do not fill it: 64 E I/(pi d^4) of
// published jacketed cables bent to 1 1/m, minus the E I of their sliding copper and their friction moment. Nine rows (charging
// cables of 15 and 20 mm, a lead of 6 mm): 3.4 7.1 7.6 9.4 9.9 14.5 18.9 19.4 31 MPa.
constexpr double jacketed_modulus = 10e6;  // [Pa]
constexpr double polymer_density = 1200;   // [kg/m3]
constexpr double torsion_of_polymer =
    2.0 / 3;  // G J / E I of a solid round bar that keeps its volume: G = E/3, J = 2 I

}  // namespace dresslife::pipeline
