// Response of a dresspack's life by one failure mode to the uncertain parameters (uncertainty.h).
//
// z of all parameters and u are standard normal. log10 of a life in repeats is
//     P(z_scatter, u) + W(z) - W(0) + log10 of the model's factor,
// P is the life over the scatter of wires, interpolated linearly between its percentiles. W is log10 of the worst wire's life,
// computed at some points of z, and at each of them for strength and slope of the material. Friction inside, slack and the hose's
// stiffness have one table with all combinations of their nodes. Combinations that were not computed follow from together():
// friction and slack combine at the stiffness of the combination, slack and stiffness at the job's own friction. Every other
// parameter of the strain side is computed alone, and together() adds its change. W is interpolated linearly along each axis and
// extrapolated with the same slope. A life above `endless` counts as infinite.
//
// The same data exist for the bounds: cables whose parts are glued, and cables whose parts slip without friction. There friction
// has no effect. W is shifted so that at z = 0 it is the life of the bound's worst wire. A bound that was not computed at a slack
// or a stiffness changes there as the job does.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "pipeline/job/uncertainty.h"

namespace dresslife::pipeline {

/// Number of parameters of the strain side, the first of uncertain_parameters().
constexpr std::size_t strain_parameters = 7;

using ParameterPoint = std::array<double, uncertain_count>;  ///< (parameter) z

/// Returns log10 of a life that several causes change together. Each cause alone changes it from `base` to one of `alone`. With a
/// strain ~ life^(-1/5), and r_i the ratio of strains by one cause,
///     life = base r^-5,   r = product of all r_i < 1 + sum over all r_i > 1 of (r_i - 1).
/// A cause that reduces a life from 1e20 to 1e9 repeats adds the strain of 1e9 repeats. Subtracting eleven decades from an
/// already short life would be wrong. Measured for friction and slack, whose combinations are computed, in 20 jobs of
/// config/studies/two_robots with different dwell, stiffness, ramp, damping and sample rate: if friction shortens the life, the
/// rms error is 0.28 decades for 60 lives, in total 1.5 for 180; adding decades has 2.4 in both cases. Exponents of 1/3 to 1/7
/// give similar results. (Squares of strains that are not in phase add up, which would be 1/4.5 for copper.)
double together(double base, std::span<const double> alone);

struct LifeResponse {
  /// log10 repeats of an infinite life. No robot repeats a motion 1e9 times.
  static constexpr double endless = 18;
  /// Upper limit of W in log10 repeats. Changes are relative to W(0), so real values of W(0) must be below the limit. In the
  /// shipped jobs W is at most 13, with other ramps and dampings 19. The strain of together() at 25 is a sixteenth of that at 19,
  /// and 1/1,600 of that at 1e9 repeats.
  static constexpr double undamaged = 25;
  static constexpr double farthest = 3.5;  ///< largest |z|; beyond, no knowledge exists

  std::string mode;       ///< name of the mode: "wires of signal cable"
  std::string dresspack;  ///< name of the dresspack, if there are several; empty: the only one
  /// Names in which a deviation is shared with other jobs (SharedBy).
  std::string construction, material;
  ParameterKnowledge knowledge;
  /// z on the strain side of each point, (point); the first point is 0.
  std::vector<std::array<double, strain_parameters>> points{{}};
  std::vector<Inside> inside{Inside::as_is};  ///< (point); the first is as_is
  std::vector<double> strength{0}, slope{0};  ///< z of the nodes of W, increasing, including 0
  std::vector<double> worst_life{undamaged};  ///< W (point, strength, slope)
  /// W(0) of the bounds, (Inside); the value of as_is is not used.
  std::array<double, inside_count> bound{undamaged, undamaged, undamaged};
  std::vector<double> scatter{0};              ///< z of the scatter, like strength
  std::vector<std::array<double, 3>> planned;  ///< (scatter) log10 repeats until 10, 50, 90 % have failed
  double residual_spread = 1;  ///< factor of the residual between dresspacks (Calibration::residual_spread)
  double scatter_shared = 1;   ///< share of u's variance that all modes of one dresspack have in common

  /// text returns the response as text for an attribute of a file; from_text reads it back. Errors: std::invalid_argument for any
  /// other text.
  std::string text() const;
  static LifeResponse from_text(const std::string& text);
};

/// A response prepared for many evaluations.
class LifeSurface {
 public:
  /// log10 of the factors of lives that do not depend on the response: of the model, and of the motion.
  using Factors = std::array<double, 2>;
  static Factors factors_at(const ParameterPoint& z);

  /// Keeps a reference to the response.
  explicit LifeSurface(const LifeResponse& response);
  /// Returns W(z) - W(0) plus log10 of the model's factor.
  double change(const ParameterPoint& z, Inside inside = Inside::as_is) const {
    return change(z, factors_at(z), inside);
  }
  /// Returns log10 of the life in repeats; infinity for an infinite life.
  double log10_life(const ParameterPoint& z, double u, Inside inside = Inside::as_is) const {
    return log10_life(z, u, factors_at(z), inside);
  }
  /// factors: factors_at(z), which many responses share.
  double log10_life(const ParameterPoint& z, double u, const Factors& factors, Inside inside = Inside::as_is) const;
  /// Returns whether a parameter has any effect.
  bool depends_on(std::size_t parameter) const;

 private:
  struct Place {
    std::size_t below = 0;
    double share = 0;
  };
  /// W at all combinations of the crossed parameters, for one kind of slip.
  struct Table {
    std::vector<double> friction, slack, stiffness;  ///< z of the nodes, increasing
    std::vector<double> worst;                       ///< (friction, slack, stiffness, strength, slope)
  };
  double change(const ParameterPoint& z, const Factors& factors, Inside inside) const;
  static Place place_among(const std::vector<double>& nodes, double z);
  bool depends_on_strain(std::size_t parameter) const;
  /// Returns W at a point of a list (point, strength, slope).
  double worst(const std::vector<double>& lives, std::size_t point, const Place& strength, const Place& slope) const;
  double crossed_worst(const Table& of, const ParameterPoint& z, const Place& strength, const Place& slope) const;
  /// Returns W for a point at which only this parameter has a z other than 0.
  double alone(std::size_t parameter, const ParameterPoint& z, const Place& strength, const Place& slope) const;

  const LifeResponse& response_;
  // Of the parameters that are not crossed:
  std::array<std::vector<double>, strain_parameters> nodes_;       ///< (parameter, node) z of the points with as_is
  std::array<std::vector<std::size_t>, strain_parameters> alone_;  ///< (parameter, node) point
  std::array<Table, inside_count> tables_;
  double at_zero_ = 0;
};

}  // namespace dresslife::pipeline
