// Lengths of a cable that its data sheet leaves out, by the rules of the standards: ESTIMATES, since a maker may choose
// others within them.
//
//   wire        IEC 60228, tables 3 and 4: the thickest wire that class 5 or 6 allows at a section. Strands are drawn to
//               0.01 mm less (16 x 0.20 for 0.5 mm2 of class 5, 28 x 0.15 of class 6). Below 0.5 mm2, where the standard
//               has no entry, class 6 has 0.10 mm (18 x 0.10 for 0.14 mm2, VDE 0812) and class 5 0.15 mm.
//   insulation  EN 50525-2-31, table 1, of PVC for 450/750 V, 0.6 mm up to 1 mm2 (300/500 V); below 0.5 mm2 0.3 mm, as of
//               electronic cables by VDE 0812.
//   jacket      IEC 60502-1, clause 13.3.3: 0.035 D + 1.0 mm around a bundle of width D, without its least value, which
//               is that of cables in the ground.
#pragma once

namespace dresslife::pipeline {

inline constexpr int flexible_class = 5, fine_class = 6;

/// Thickest wire of a class at a section of a core [m2]; 0: the class has no entry so large. [m]
double thickest_wire(int conductor_class, double section);
/// As strands are drawn; precondition: thickest_wire() is not 0. [m]
double usual_wire(int conductor_class, double section);
/// Of a core of this section [m2]. [m]
double usual_insulation(double section);
/// Around a bundle of this width [m]. [m]
double usual_jacket(double bundle);
/// Width of the bundle in a cable of this diameter, the inverse of bundle + 2 usual_jacket(bundle); negative: the cable
/// is too thin for such a jacket. [m]
double bundle_in(double outer_diameter);

}  // namespace dresslife::pipeline
