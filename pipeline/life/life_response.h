// How a job's life follows from what is not known of it (uncertainty.h), and lives drawn from that.
//
// With z of all parameters and u, both standard normal, log10 of a life in repeats is
//     P(z_scatter, u) + W(z) - W(0) + model's own,
// P: the planner's life over the scatter of wires, straight between its percentiles; W: log10 of the worst
// wire's life, worked out at some points of z and put together: over friction and slack from all their
// combinations, every other parameter of the strain side by itself, and at each of these points over strength
// and slope of the material. Between points W is straight along each axis, and goes on so beyond them. A life
// beyond `endless` counts as without end.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "pipeline/job/uncertainty.h"

namespace dresslife::pipeline {

/// Parameters of the strain side: the first of uncertain_parameters().
constexpr std::size_t strain_parameters = 5;

using ParameterPoint = std::array<double, uncertain_count>;  ///< (parameter) z

struct LifeResponse {
  static constexpr double endless = 12;  ///< log10 repeats: 1e12 of a minute are two million years

  /// Of what a deviation is shared with other jobs (SharedBy).
  std::string construction, material;
  ParameterKnowledge knowledge;
  /// (point) z on the strain side; the first is 0.
  std::vector<std::array<double, strain_parameters>> points{{}};
  std::vector<double> strength{0}, slope{0};   ///< z that W is known at, rising, 0 among them
  std::vector<double> worst_life{endless};     ///< W (point, strength, slope)
  std::vector<double> scatter{0};              ///< z of the scatter, likewise
  std::vector<std::array<double, 3>> planned;  ///< (scatter) log10 repeats until 10, 50, 90 % have failed

  /// W(z) - W(0) and the model's own.
  double change(const ParameterPoint& z) const;
  /// log10 of the life in repeats; infinite: without end.
  double log10_life(const ParameterPoint& z, double u) const;

  /// As one text, for an attribute of a file; and back. Errors: std::invalid_argument for a text that is no
  /// response.
  std::string text() const;
  static LifeResponse from_text(const std::string& text);
};

constexpr std::size_t life_draws = 10000;

/// What a job's lives look like, drawn.
struct DrawnLives {
  std::vector<double> log10_life;       ///< (draw) repeats
  std::array<double, 3> percentiles{};  ///< repeats until 10, 50, 90 % have failed
  /// Share of the variance of log10 life that each parameter explains by itself, and the wires' scatter the
  /// last.
  std::array<double, uncertain_count + 1> share{};
};

/// job: names what only it has. Draws of one number of draws are the same in all jobs for what these share;
/// each parameter's are spread evenly over its distribution (Latin hypercube). The same for the same names,
/// anywhere.
std::vector<double> draw_lives(const LifeResponse& response, const std::string& job,
                               std::size_t draws = life_draws);
/// The same with what follows from them. shares: which of the parameters explains how much, too.
DrawnLives drawn_lives(const LifeResponse& response, const std::string& job, std::size_t draws = life_draws);

/// Share of draws in which `one` lives longer than `other`; equal lives count half. Precondition: as many of
/// both.
double share_outliving(const std::vector<double>& one, const std::vector<double>& other);

/// "friction_inside 41 %; model 30 %; ...", largest first; those below 1 % left out.
std::string share_words(const std::array<double, uncertain_count + 1>& share);
/// The parameter that explains most: its index, uncertain_count for the wires' scatter.
std::size_t largest_share(const std::array<double, uncertain_count + 1>& share);

}  // namespace dresslife::pipeline
