// An independent model of cables in a hose: chains of rigid segments in space. ODE's own ball joints and motors hold them
// together, ODE's own contact joints stop them, and ODE's own step solves the equations.
//
// The model is not reduced to a hose's cross-section. The hose is a tube around a curve, which is integrated from its
// curvature and twist. A cable is a chain whose ends are clamped in the frames of the tube's ends. Ball joints are springs
// of E A / l. Motors are springs of E I / l and G J / l (of the rotation vector). Walls yield with the same stiffness per
// length as in strain/loose. There is no inertia: every step starts from rest. With masses / h^2 as a drag, one step is a
// backward Euler step down the energy. Cables are at rest where no segment moves any more.
#pragma once

#include <ode/ode.h>

#include <Eigen/Geometry>
#include <functional>
#include <vector>

#include "strain/loose/loose_cables.h"

namespace dresslife::strain::test {

/// The axis of a hose in space, from its base clamp, with its frames (columns d1, d2, d3).
class HoseCurve {
 public:
  HoseCurve(double length, const std::function<HoseNode(double)>& hose);

  struct Frame {
    Eigen::Vector3d at;
    Eigen::Matrix3d axes;
  };
  Frame end(bool tool) const { return tool ? frames_.back() : frames_.front(); }
  /// Returns the frame of the axis whose normal plane contains `point`. near: where the search starts, share of the length.
  Frame beside(const Eigen::Vector3d& point, double near) const;

 private:
  double length_;
  std::vector<Frame> frames_;
};

/// Positions of a chain's segments in the hose's cross-section, and their bending.
struct OdeState {
  std::vector<Eigen::Vector2d> place;      ///< (segment) toward d1 and d2 [m]
  std::vector<Eigen::Vector2d> curvature;  ///< (inner link) about the hose's d1 and d2 [1/m]
  double strain = 0;                       ///< mean over the joints of gap / length of the joint's segments
};

class OdeCables {
 public:
  /// cables: only their places, stiffnesses, contact stiffness and play (without_limit: none) are used. twisting: G J / (E I).
  /// inner_radius, core_radius: the wall and the core, for cables without a limit of play [m].
  OdeCables(const std::vector<LooseCable>& cables, double length, int segments, double twisting, double inner_radius,
            double core_radius);
  ~OdeCables();
  OdeCables(const OdeCables&) = delete;
  OdeCables& operator=(const OdeCables&) = delete;

  /// Moves the hose to its next shape and lets the cables follow for `steps` steps. Returns the largest displacement in the
  /// last step [m].
  double follow(const HoseCurve& hose, const std::function<HoseNode(double)>& nodes, int steps);
  OdeState state(std::size_t cable, const HoseCurve& hose) const;

 private:
  struct Chain {
    LooseCable cable;
    std::vector<dBodyID> bodies;  ///< the first and the last are clamps
    std::vector<dJointID> balls, motors;
  };

  void add_chain(const LooseCable& cable, double twisting);
  double spring_length(int link) const;
  void clamp(const Chain& chain, const HoseCurve& hose);
  void bend(const Chain& chain);
  void meet(const HoseCurve& hose);
  void push(const Chain& chain, int segment, const Eigen::Vector3d& normal, double depth);
  Eigen::Vector3d position(dBodyID body) const;
  Eigen::Quaterniond orientation(dBodyID body) const;
  Eigen::Vector3d turn(const Chain& chain, int link) const;

  double length_, l_, inner_radius_, core_radius_;
  int segments_;
  dWorldID world_;
  dThreadingImplementationID threading_;
  dJointGroupID contacts_;
  std::vector<Chain> chains_;
};

}  // namespace dresslife::strain::test
