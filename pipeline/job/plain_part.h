// Parts of a dresspack without wires: hoses for air and water, optical fibres, fillers. They have mass and
// stiffness, take room, push cables aside and pull at the clamps. No life is computed for them.
#pragma once

#include <optional>
#include <string_view>

#include "pipeline/base/words.h"
#include "pipeline/settings/document.h"

namespace dresslife::pipeline {

class Fields;

enum class PlainKind { filler, hose, fibre };
constexpr std::string_view word(PlainKind value) { return word_at({"filler", "hose", "fibre"}, value); }

enum class Medium { air, water };
constexpr std::string_view word(Medium value) { return word_at({"air", "water"}, value); }

struct PlainPart {
  PlainKind kind = PlainKind::filler;
  std::optional<double> bore;               ///< inner diameter of a hose [m]; absent: two thirds of the outer
  Medium medium = Medium::air;              ///< that fills it
  std::optional<double> bending_stiffness;  ///< E I [N m2]; absent: of polymer
  Where where;
};

void describe(Fields& f, PlainPart& part);

/// Errors: InputError for a bore that does not fit, or in what is no hose.
void check_plain_part(const PlainPart& part, double radius, std::string_view name);

}  // namespace dresslife::pipeline
