// The dresspack's component tree as flat lists: layers, parts that contain parts, bundles of wires, and the position of each
// ((W5) and (W8) in strain/theory.md).
//
// Level 1 is the level directly in the dresspack. A layer is K equal parts on one helix. Parts that contain layers are listed.
// Wires are not listed: a wire layer is K evenly spaced phases. A bundle is a part (or the dresspack itself) with the wire
// layers directly in it.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "pipeline/cable/cable_force.h"
#include "pipeline/cable/cable_pull.h"
#include "pipeline/cable/helix.h"
#include "pipeline/job/dresspack.h"
#include "pipeline/job/strain.h"
#include "strain/loose/rings.h"

namespace dresslife::strain {

using namespace helices;  // for rods and placements

constexpr int dresspack_itself = -1;  ///< value of `parent` for parts and layers of level 1
constexpr int no_cable = -1;
constexpr int hose_places = 16;  ///< number of evaluated places around the hose's wall, evenly spaced

struct Layer {
  std::string name;      ///< "signal cable"; part k is "signal cable k"
  std::string label;     ///< "layer 1" if several layers have this name, else empty
  std::string material;  ///< material of wires
  bool is_wire = false;
  int level = 1;
  int parent = dresspack_itself;  ///< layer whose parts contain it
  int count = 1;                  ///< K
  double part_radius = 0;         ///< [m]
  double helix_radius = 0;        ///< R [m]
  double lay_angle = 0;           ///< negative = left hand [rad]
  double lay_tangent = 0;         ///< tangent of the lay angle, as the kinematics counts it
  double lay_cosine = 1;
  double phase = 0;             ///< of part 1 at the base clamp [rad]
  bool is_hose = false;         ///< places around the hose's wall instead of wires
  double strain_factor = 1;     ///< strain of the corrugated wall over that of a smooth one, along the hose
  double shear_factor = 1;      ///< shear by twist of the corrugated wall over that of a smooth one
  double friction = 0;          ///< Coulomb coefficient between a part and its contact partners
  double line_load = 0;         ///< radial line load from jacket and tape [N/m]
  double tension = 0;           ///< tension of a part at rest [N]
  double jacket_stiffness = 0;  ///< stiffness with which the jacket holds a part along its path [N/m2]
  double radial_stiffness = std::numeric_limits<double>::infinity();  ///< of the bed under the layer [N/m2]
  double axial_stiffness = 0;            ///< EA of a part, from its wires alone [N]; 0: a material is unknown
  bool loose = false;                    ///< a cable that lies where it rests in the hose, if it may slide
  pipeline::Laying laying;               ///< of a cable: a part of the first level that is no wire
  int component = -1;                    ///< index of the cable's component in the dresspack
  pipeline::CableForce force;            ///< of a cable
  pipeline::TwistShortening shortening;  ///< of a cable

  bool is_cable() const { return level == 1 && !is_wire; }
  double pitch() const;  ///< along the parent [m]; infinite when straight
};

struct Part {
  int layer;
  int number;          ///< 1 .. K
  int parent;          ///< part, or dresspack_itself
  std::string path;    ///< "signal cable 3/conductor 2"
  double length_rate;  ///< ideal length per length of the dresspack
};

struct Bundle {
  int part;  ///< part, or dresspack_itself
  std::vector<int> wire_layers;
};

class Construction {
 public:
  /// Errors: InputError for wires with equal names, several parts on one axis, or nesting deeper than highest_level.
  Construction(const pipeline::Dresspack& dresspack, pipeline::Kinematics kinematics,
               const pipeline::StrainFactors& factors = {});

  const std::vector<Layer>& layers() const { return layers_; }
  const std::vector<Part>& parts() const { return parts_; }  ///< parents before children
  const std::vector<Bundle>& bundles() const { return bundles_; }
  pipeline::Kinematics kinematics() const { return kinematics_; }
  int levels() const { return levels_; }  ///< level of the deepest wire
  const HoseSection& section() const { return section_; }
  /// Returns the curvature about d2 of the dresspack as delivered [1/m]. In this shape its parts are free of strain.
  double rest_curvature() const { return rest_curvature_; }

  /// Returns the cables in their order: parts of the first level that are no wires, including parts without wires.
  const std::vector<int>& cables() const { return cables_; }
  /// Returns the cable (an index into cables()) that contains the part or is the part; no_cable for the dresspack.
  int cable_of(int part) const;
  /// Returns the bending stiffness E I of the hose [N m2].
  double hose_bending_stiffness() const { return hose_bending_stiffness_; }

  /// Returns the parts from the outermost to `part` itself; empty for the dresspack.
  std::vector<int> ancestry(int part) const;
  /// Returns the ideal length of `part` per length of the dresspack.
  double length_rate(int part) const { return part == dresspack_itself ? 1 : parts_[part].length_rate; }
  /// Returns the phase theta of part `number` of `layer` in `parent` at `arc` along the dresspack [m] (W8).
  double phase(int layer, int number, int parent, double arc) const;
  /// Returns this position as numbers for the kinematics. turn: added to the phase [rad]. order: order of the parent's state.
  Placement placement(int layer, int number, int parent, double arc, double turn = 0,
                      int order = Series<double>::capacity - 1) const;
  std::string wire_path(int layer, int number, int parent) const;

 private:
  void scale(Layer& layer, const pipeline::StrainFactors& factors) const;
  /// friction_level: factor of the radial line loads, from the measured stiffness of the cable that contains it.
  void add(const pipeline::Dresspack& dresspack, const pipeline::Component& component, int parent_layer, int level,
           double friction_level = 1);
  void check(const pipeline::Component& component, int parent_layer, int level) const;
  void list_parts(int parent_layer, int parent_part);
  double lay_angle(const Layer& layer) const;

  pipeline::Kinematics kinematics_;
  double rest_curvature_ = 0;
  HoseSection section_;
  double hose_bending_stiffness_ = 0;
  std::vector<int> cables_;
  std::vector<Layer> layers_;
  std::vector<Part> parts_;
  std::vector<Bundle> bundles_;
  int levels_ = 0;
};

}  // namespace dresslife::strain
