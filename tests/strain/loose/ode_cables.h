// An independent engine for cables in a hose: chains of rigid segments in space, held together by ODE's own
// ball joints and motors, stopped by ODE's own contact joints, solved by ODE's own step.
//
// Nothing is reduced to a hose's cross-section: the hose is a tube around a curve that is put together from
// its curvature and twist, a cable is a chain whose ends are clamped in the frames of the tube's ends. Ball
// joints are springs of E A / l, motors springs of E I / l and G J / l (of the rotation vector), walls give
// with the same stiffness per length as in strain/loose. In place of inertia every step starts from rest:
// with masses over h^2 as a drag, a step is one of backward Euler down the energy, and where nothing moves
// any more is where cables rest.
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
  /// Where the plane across the axis goes through a point; near: share of the length to look from.
  Frame beside(const Eigen::Vector3d& point, double near) const;

 private:
  double length_;
  std::vector<Frame> frames_;
};

/// Where a chain's segments are in the hose's cross-section, and how they bend.
struct OdeState {
  std::vector<Eigen::Vector2d> place;      ///< (segment) toward d1 and d2 [m]
  std::vector<Eigen::Vector2d> curvature;  ///< (inner link) about the hose's d1 and d2 [1/m]
  double strain = 0;                       ///< mean of the joints' gaps over the length of their segments
};

class OdeCables {
 public:
  /// cables: their places, stiffnesses, contact stiffness and play (without_limit: none) count. twisting: G J
  /// over E I. section: the wall and what fills the middle, for those without play.
  OdeCables(const std::vector<LooseCable>& cables, double length, int segments, double twisting,
            double inner_radius, double core_radius);
  ~OdeCables();
  OdeCables(const OdeCables&) = delete;
  OdeCables& operator=(const OdeCables&) = delete;

  /// Takes the hose to its next shape and lets cables follow for some steps; returns the last step's largest
  /// way [m].
  double follow(const HoseCurve& hose, const std::function<HoseNode(double)>& nodes, int steps);
  /// Whether contacts rub across the cables from now on, by the cables' coefficients; not before.
  void rub(bool rubs) { rubs_ = rubs; }
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
  bool rubs_ = false;
  dWorldID world_;
  dThreadingImplementationID threading_;
  dJointGroupID contacts_;
  std::vector<Chain> chains_;
};

}  // namespace dresslife::strain::test
