// Lengths of a cable that are missing in its data sheet, by the rules of standards. They are ESTIMATES, because the standards
// allow makers other lengths.
//
//   wire        IEC 60228, tables 3 and 4: the thickest wire of class 5 or 6 at a section. Real strands are 0.01 mm
//               thinner (16 x 0.20 for 0.5 mm2 of class 5, 28 x 0.15 of class 6). Below 0.5 mm2, where the standard
//               has no entry, class 6 has 0.10 mm (18 x 0.10 for 0.14 mm2, VDE 0812) and class 5 0.15 mm.
//   insulation  EN 50525-2-31, table 1, for PVC of 450/750 V; 0.6 mm up to 1 mm2 (300/500 V); 0.3 mm below 0.5 mm2,
//               like electronic cables of VDE 0812.
//   jacket      IEC 60502-1, clause 13.3.3: 0.035 D + 1.0 mm around a bundle of width D, without the least value,
//               which is for cables in the ground.
#pragma once

namespace dresslife::pipeline {

inline constexpr int flexible_class = 5, fine_class = 6;

/// Returns the thickest wire [m] of a class for a core's section [m2]; 0: the class has no entry for this section.
double thickest_wire(int conductor_class, double section);
/// Returns the diameter of real strands [m]. Precondition: thickest_wire() is not 0.
double usual_wire(int conductor_class, double section);
/// Returns the thickness of the insulation [m] of a core of this section [m2].
double usual_insulation(double section);
/// Returns the thickness of the jacket [m] around a bundle of this width [m].
double usual_jacket(double bundle);
/// Returns the width of the bundle [m] in a cable of this diameter, the inverse of bundle + 2 usual_jacket(bundle); negative: the
/// cable is too thin for such a jacket.
double bundle_in(double outer_diameter);

}  // namespace dresslife::pipeline
