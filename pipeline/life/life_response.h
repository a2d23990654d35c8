// How the life of a dresspack by one failure mode follows from what is uncertain (uncertainty.h).
//
// With z of all parameters and u, both standard normal, log10 of a life in repeats is
//     P(z_scatter, u) + W(z) - W(0) + log10 of the model's factor,
// P: the life over the scatter of wires, straight between its percentiles; W: log10 of the worst wire's life,
// computed at some points of z and put together: over friction and slack from all their combinations, every
// other parameter of the strain side by itself, and at each of these points over strength and slope of the
// material. Between points W is straight along each axis, and goes on so beyond them. A life beyond `endless`
// counts as without end.
//
// The same is known for cables whose inside is glued, and for cables whose inside slips without friction:
// the bounds. There friction has no effect, W is known over slack, and it is shifted so that W at z = 0 is
// the life of the bound's worst wire.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "pipeline/job/uncertainty.h"

namespace dresslife::pipeline {

/// Parameters of the strain side: the first of uncertain_parameters().
constexpr std::size_t strain_parameters = 6;

using ParameterPoint = std::array<double, uncertain_count>;  ///< (parameter) z

struct LifeResponse {
  /// log10 repeats. No robot repeats a motion 1e9 times. Friction, slack and material change a life by up to nine decades,
  /// and these changes are relative to lives that must therefore not be cut off before.
  static constexpr double endless = 18;

  std::string mode;       ///< what fails: "wires of signal cable"
  std::string dresspack;  ///< in which, among several; empty: the only one
  /// Of what a deviation is shared with other jobs (SharedBy).
  std::string construction, material;
  ParameterKnowledge knowledge;
  /// (point) z on the strain side; the first is 0.
  std::vector<std::array<double, strain_parameters>> points{{}};
  std::vector<Inside> inside{Inside::as_is};  ///< (point) the first is as_is
  std::vector<double> strength{0}, slope{0};  ///< z that W is known at, rising, 0 among them
  std::vector<double> worst_life{endless};    ///< W (point, strength, slope)
  /// W(0) of the bounds, (Inside); that of as_is is not used.
  std::array<double, inside_count> bound{endless, endless, endless};
  std::vector<double> scatter{0};              ///< z of the scatter, as strength
  std::vector<std::array<double, 3>> planned;  ///< (scatter) log10 repeats until 10, 50, 90 % have failed
  double scatter_shared = 1;  ///< share of u's variance that all modes of one dresspack have in common

  /// W(z) - W(0) and the model's factor; infinite: nothing is damaged at z.
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

  const LifeResponse& response_;
  std::array<std::vector<double>, strain_parameters> nodes_;        ///< (parameter, node) z of as_is
  std::array<std::vector<std::size_t>, strain_parameters> alone_;   ///< (parameter, node) point
  std::array<Core, inside_count> cores_;
  double at_zero_ = 0;
};

}  // namespace dresslife::pipeline
