// Parts of a dresspack without wires: hoses for air and water, optical fibres, fillers, and cables of unknown construction. They
// have mass and stiffness, need space, displace cables and pull at the clamps. Only cables and hoses with ratings have a life
// (fatigue/rated_cables.h). Hoses kink (pipeline/cable/kink.h).
#pragma once

#include <optional>
#include <string_view>

#include "pipeline/base/words.h"
#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

class Fields;

enum class PlainKind { filler, hose, fibre, cable };
constexpr std::string_view word(PlainKind value) { return word_at({"filler", "hose", "fibre", "cable"}, value); }

/// Returns whether a maker's ratings give such a part a life.
constexpr bool has_rated_life(PlainKind kind) { return kind == PlainKind::cable || kind == PlainKind::hose; }

enum class Medium { air, water };
constexpr std::string_view word(Medium value) { return word_at({"air", "water"}, value); }

struct PlainPart {
  PlainKind kind = PlainKind::filler;
  std::optional<double> bore;               ///< inner diameter of a hose [m]; absent: two thirds of the outer diameter
  Medium medium = Medium::air;              ///< content of a hose
  std::optional<double> bending_stiffness;  ///< E I [N m2]; absent: that of polymer
  std::optional<double> damage_exponent;    ///< m of (F31); absent: usual_damage_exponent
  std::optional<double>
      least_bend_radius{};  ///< of a hose's axis, from its maker [m]; absent: see pipeline/cable/kink.h
  std::optional<double> pressure{},
      most_pressure{};          ///< of a hose: in operation, and allowed by its maker at 20 C [Pa]
  double stiffness_factor = 1;  ///< of its polymer at the cell's temperature (pipeline/cable/warmth.h)
  Where where{};
};

/// Exponent of damage over the range of a bend or twist. ESTIMATE: the strain-life curve of copper_halved has 3.1 at 1e5, 4.8 at
/// 1e6 and 6.8 at 1e7 cycles.
constexpr double usual_damage_exponent = 5, damage_exponent_deviation = 1.5;

void describe(Fields& f, PlainPart& part);

/// Errors: InputError for a bore or a least bend radius that does not fit or belongs to no hose, and for a damage exponent that
/// belongs to no cable.
void check_plain_part(const PlainPart& part, double radius, std::string_view name);

}  // namespace dresslife::pipeline
