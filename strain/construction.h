// The dresspack's component tree as flat lists: layers, parts that hold parts, bundles of wires, and where
// each of them lies (README W5, W8).
//
// Level 1 lies in the dresspack. A layer is K equal parts on one helix; its parts that hold further layers
// are listed, its wires are not (they are K evenly spaced phases). A bundle is a part (or the dresspack
// itself) together with the wire layers directly in it.
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

using namespace helices;  // rods and placements are the words of this stage

constexpr int dresspack_itself = -1;  ///< as the parent of a part or layer
constexpr int no_cable = -1;
constexpr int hose_places = 16;  ///< around the hose's wall, evenly spaced

struct Layer {
  std::string name;      ///< "signal cable"; part k is "signal cable k"
  std::string label;     ///< "layer 1" where layers share a name, else empty
  std::string material;  ///< of wires
  bool is_wire = false;
  int level = 1;
  int parent = dresspack_itself;  ///< layer in whose parts it lies
  int count = 1;                  ///< K
  double part_radius = 0;         ///< [m]
  double helix_radius = 0;        ///< R [m]
  double lay_angle = 0;           ///< negative = left hand [rad]
  double lay_tangent = 0;         ///< of the lay angle as the kinematics counts it
  double lay_cosine = 1;
  double phase = 0;             ///< of part 1 at the base clamp [rad]
  bool is_hose = false;         ///< places around the hose's wall instead of wires
  double strain_factor = 1;     ///< of the corrugated wall over a smooth one, along the hose
  double shear_factor = 1;      ///< the same of its shear by twist
  double friction = 0;          ///< Coulomb, of a part on what it lies against
  double line_load = 0;         ///< radial, from jacket and tape [N/m]
  double tension = 0;           ///< of a part at rest [N]
  double jacket_stiffness = 0;  ///< that holds a part along its path [N/m2]
  double radial_stiffness = std::numeric_limits<double>::infinity();  ///< of what the layer lies on [N/m2]
  double axial_stiffness = 0;            ///< EA of a part, of its wires alone [N]; 0: a material is not known
  bool loose = false;                    ///< lies where it rests in the hose, if it may slide
  pipeline::Laying laying;               ///< of a cable: a part of the first level that is no wire
  int component = -1;                    ///< of the dresspack, which a cable is
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
  int part;  ///< or dresspack_itself
  std::vector<int> wire_layers;
};

class Construction {
 public:
  /// Errors: InputError for wires with equal names, several parts on one axis, nesting beyond
  /// highest_level.
  Construction(const pipeline::Dresspack& dresspack, pipeline::Kinematics kinematics,
               const pipeline::StrainFactors& factors = {});

  const std::vector<Layer>& layers() const { return layers_; }
  const std::vector<Part>& parts() const { return parts_; }  ///< parents before children
  const std::vector<Bundle>& bundles() const { return bundles_; }
  pipeline::Kinematics kinematics() const { return kinematics_; }
  int levels() const { return levels_; }  ///< of the deepest wire
  const HoseSection& section() const { return section_; }
  /// Of the delivered dresspack, about d2 [1/m]: the shape in which its parts are free of strain.
  double rest_curvature() const { return rest_curvature_; }

  /// Cables: parts of the first level that are no wires, in their order. Those without wires lie among them.
  const std::vector<int>& cables() const { return cables_; }
  /// The cable, as an index into cables(), in which a part lies or that it is; no_cable for the dresspack.
  int cable_of(int part) const;
  /// E I of the hose [N m2].
  double hose_bending_stiffness() const { return hose_bending_stiffness_; }

  /// Parts from the outermost to `part` itself; empty for the dresspack.
  std::vector<int> ancestry(int part) const;
  /// Ideal length of `part` per length of the dresspack.
  double length_rate(int part) const { return part == dresspack_itself ? 1 : parts_[part].length_rate; }
  /// theta of part `number` of `layer` in `parent` at `arc` along the dresspack [m] (W8).
  double phase(int layer, int number, int parent, double arc) const;
  /// The same as a place to compute with. turn: added to the phase [rad]. order: of the parent's state.
  Placement placement(int layer, int number, int parent, double arc, double turn = 0,
                      int order = Series<double>::capacity - 1) const;
  std::string wire_path(int layer, int number, int parent) const;

 private:
  void scale(Layer& layer, const pipeline::StrainFactors& factors) const;
  /// friction_level: factor of the radial line loads, from a measured stiffness of what it lies in.
  void add(const pipeline::Dresspack& dresspack, const pipeline::Component& component, int parent_layer,
           int level, double friction_level = 1);
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
