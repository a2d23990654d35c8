// The hose in its untwisted frame, as input for the cables in it.
//
// The untwisted frame moves along the hose's axis without turning about it. Against the hose's own frame it is
// turned by -phi, phi' = tau. The derivative a' + tau J a in the hose's frame is simply a' in this frame, and all terms of a
// cable's bending are the same in both directions.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

namespace dresslife::strain {

/// State of the hose at one node and one sample, in its own frame.
struct HoseNode {
  double curvature1 = 0, curvature2 = 0;  ///< about d1 and d2 [1/m]
  double twist = 0;                       ///< [rad/m]
  double elongation = 0;
  std::array<double, 2> pull{};  ///< gravity minus acceleration, along d1 and d2 [m/s2]
};

struct HoseLine {
  double length = 0, spacing = 0;          ///< of the axis, of its nodes [m]
  std::vector<Eigen::Vector2d> turn;       ///< (node) cosine and sine of phi
  std::vector<Eigen::Vector2d> curvature;  ///< K = e^(i phi) (k2, -k1), in the direction in which the axis bends [1/m]
  std::vector<Eigen::Vector2d> rest;       ///< K0, of the hose as the cables were mounted [1/m]
  std::vector<Eigen::Vector2d> pull;       ///< gravity minus acceleration [m/s2]
  std::vector<double> elongation;

  HoseLine(double length, std::size_t elements);
  std::size_t nodes() const { return turn.size(); }
  /// Takes the hose's state (node) of one sample. rest_curvature: about the hose's d2 [1/m].
  void take(std::span<const HoseNode> hose, double rest_curvature);
};

/// Returns (x, y) turned by an angle, which is given by its cosine and sine.
inline Eigen::Vector2d turned(const Eigen::Vector2d& vector, const Eigen::Vector2d& by) {
  return {vector.x() * by.x() - vector.y() * by.y(), vector.x() * by.y() + vector.y() * by.x()};
}
inline Eigen::Vector2d turned_back(const Eigen::Vector2d& vector, const Eigen::Vector2d& by) {
  return {vector.x() * by.x() + vector.y() * by.y(), vector.y() * by.x() - vector.x() * by.y()};
}

}  // namespace dresslife::strain
