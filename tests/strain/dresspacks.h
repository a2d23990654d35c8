// Constructions shared by the tests of this folder.
#pragma once

#include "pipeline/base/constants.h"
#include "pipeline/job/dresspack.h"
#include "strain/evaluation.h"

namespace test_dresspacks {

using namespace dresslife;
using dresslife::pipeline::Component;
using dresslife::pipeline::Dresspack;
using dresslife::pipeline::Hand;

inline Component part(const std::string& name, int count, double radius, double helix_radius, double lay_angle_deg,
                      Hand hand = Hand::right) {
  Component component;
  component.name = name;
  component.count = count;
  component.radius = radius;
  component.helix_radius = helix_radius;
  component.lay_angle = lay_angle_deg * degree;
  component.hand = hand;
  return component;
}

inline Component wires(const std::string& label, int count, double radius, double helix_radius, double lay_angle_deg,
                       Hand hand) {
  Component component = part("wire", count, radius, helix_radius, lay_angle_deg, hand);
  component.layer = label;
  component.material = "copper";
  return component;
}

/// Copper of the thesis' table 2, with the strength of annealed wire.
inline dresslife::pipeline::Material copper() {
  dresslife::pipeline::Material copper;
  copper.name = "copper";
  copper.youngs_modulus = 117e9;
  copper.fatigue_strength = 983e6;
  copper.fatigue_strength_exponent = -0.112;
  copper.fatigue_ductility = 2.43;
  copper.fatigue_ductility_exponent = -0.6;
  copper.tensile_strength = 230e6;
  return copper;
}

/// The welding dresspack of the thesis' table 1, all wire layers.
inline Dresspack thesis_dresspack() {
  Component conductor = part("conductor", 7, 0.001175, 0.002825, 25);
  const int counts[] = {31, 25, 18, 12, 6};
  for (int k = 0; k < 5; ++k)
    conductor.components.push_back(
        wires("layer " + std::to_string(k + 1), counts[k], 75e-6, 0.00075 - 0.00015 * k, 5, Hand::left));
  Component cable = part("signal cable", 10, 0.0053, 0.01845, 0);
  cable.components = {conductor};
  Dresspack dresspack;
  dresspack.components = {cable};
  return dresspack;
}

/// Returns the place of a span of this length whose cable is longer by a rounding error, as in a rig that shows a part of its cable: no
/// wire is a line (W45), so the laws of one place, (W10) and (W16), hold exactly.
inline dresslife::strain::SpanPlace part_of_rig(double length = 2) {
  dresslife::strain::SpanPlace place;
  place.clamped_length = length * (1 + 1e-12);
  return place;
}

}  // namespace test_dresspacks
