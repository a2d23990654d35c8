// How the life of a dresspack by one failure mode follows from what is uncertain (uncertainty.h).
//
// With z of all parameters and u, both standard normal, log10 of a life in repeats is
//     P(z_scatter, u) + W(z) - W(0) + log10 of the model's factor,
// P: the life over the scatter of wires, straight between its percentiles; W: log10 of the worst wire's life,
// computed at some points of z: over friction and slack at all their combinations, over every other parameter of
// the strain side by itself, and at each of these points over strength and slope of the material. Changes that
// were computed by themselves are put together as strains: together(). Between points W is straight along each
// axis, and goes on so beyond them. A life beyond `endless` counts as without end.
//
// The same is known for cables whose inside is glued, and for cables whose inside slips without friction:
// the bounds. There friction has no effect, W is known over slack, and it is shifted so that W at z = 0 is
// the life of the bound's worst wire.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "pipeline/job/uncertainty.h"

namespace dresslife::pipeline {

/// Parameters of the strain side: the first of uncertain_parameters().
constexpr std::size_t strain_parameters = 7;

using ParameterPoint = std::array<double, uncertain_count>;  ///< (parameter) z

/// log10 of a life that several causes change together. Each changes it from `base` to one of `alone` by itself.
/// With a strain ~ life^(-1/5), and r_i the ratio of strains by one cause,
///     life = base r^-5,   r = product of all r_i < 1 + sum over all r_i > 1 of (r_i - 1).
/// A cause that takes a life from 1e20 to 1e9 repeats adds the strain of 1e9 repeats. Eleven decades from a life that
/// is short already would be impossible. Measured on friction and slack, whose combinations are computed, in 20 jobs of
/// config/studies/two_robots with dwell, stiffness, ramp, damping and sample rate varied: where friction shortens the
/// life, the rms error is 0.28 decades of 60 lives, in all 1.5 of 180; of decades that add up both are 2.4. Exponents
/// 1/3 to 1/7 differ little. (Squares of strains that are not in phase add up, which would be 1/4.5 for copper.)
double together(double base, std::span<const double> alone);

struct LifeResponse {
  /// log10 repeats of a sample. No robot repeats a motion 1e9 times.
  static constexpr double endless = 18;
  /// log10 repeats that W goes up to. Changes are relative to W(0), which must therefore not be cut off at lives that
  /// occur. Of the shipped jobs it is 13 at most, 19 with other ramps and dampings. The strain of together() at 25 is a
  /// sixteenth of that at 19, and 1/1,600 of that at 1e9 repeats.
  static constexpr double undamaged = 25;

  std::string mode;       ///< what fails: "wires of signal cable"
  std::string dresspack;  ///< in which, among several; empty: the only one
  /// Of what a deviation is shared with other jobs (SharedBy).
  std::string construction, material;
  ParameterKnowledge knowledge;
  /// (point) z on the strain side; the first is 0.
  std::vector<std::array<double, strain_parameters>> points{{}};
  std::vector<Inside> inside{Inside::as_is};  ///< (point) the first is as_is
  std::vector<double> strength{0}, slope{0};  ///< z that W is known at, rising, 0 among them
  std::vector<double> worst_life{undamaged};  ///< W (point, strength, slope)
  /// W(0) of the bounds, (Inside); that of as_is is not used.
  std::array<double, inside_count> bound{undamaged, undamaged, undamaged};
  std::vector<double> scatter{0};              ///< z of the scatter, as strength
  std::vector<std::array<double, 3>> planned;  ///< (scatter) log10 repeats until 10, 50, 90 % have failed
  double scatter_shared = 1;  ///< share of u's variance that all modes of one dresspack have in common

  /// W(z) - W(0) and the model's factor.
  double change(const ParameterPoint& z, Inside inside = Inside::as_is) const;
  /// log10 of the life in repeats; infinite: without end.
  double log10_life(const ParameterPoint& z, double u, Inside inside = Inside::as_is) const;

  /// As one text, for an attribute of a file; and back. Errors: std::invalid_argument for a text that is no
  /// response.
  std::string text() const;
  static LifeResponse from_text(const std::string& text);
};

/// A response prepared for many evaluations.
class LifeSurface {
 public:
  /// response: stays the caller's.
  explicit LifeSurface(const LifeResponse& response);
  double change(const ParameterPoint& z, Inside inside) const;
  double log10_life(const ParameterPoint& z, double u, Inside inside) const;
  /// Whether a parameter has any effect.
  bool depends_on(std::size_t parameter) const;

 private:
  struct Place {
    std::size_t below = 0;
    double share = 0;
  };
  /// W over friction and slack, of one way of slipping.
  struct Core {
    std::vector<double> friction, slack;  ///< z, rising
    std::vector<std::size_t> grid;        ///< (friction, slack) point; empty: not all combinations are known
    double shift = 0;
  };
  static Place place_among(const std::vector<double>& nodes, double z);
  Core core_of(Inside inside) const;
  bool depends_on_strain(std::size_t parameter) const;
  double worst(std::size_t point, const Place& strength, const Place& slope) const;
  double core(const Core& of, const ParameterPoint& z, const Place& strength, const Place& slope) const;
  /// W where z of one parameter only is not 0.
  double alone(std::size_t parameter, const ParameterPoint& z, const Place& strength,
               const Place& slope) const;

  const LifeResponse& response_;
  std::array<std::vector<double>, strain_parameters> nodes_;        ///< (parameter, node) z of as_is
  std::array<std::vector<std::size_t>, strain_parameters> alone_;   ///< (parameter, node) point
  std::array<Core, inside_count> cores_;
  double at_zero_ = 0;
};

}  // namespace dresslife::pipeline
