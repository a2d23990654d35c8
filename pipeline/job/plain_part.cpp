#include "pipeline/job/plain_part.h"

#include <fmt/format.h>

#include "pipeline/settings/fields.h"

namespace dresslife::pipeline {
void describe(Fields& f, PlainPart& part) {
  f.place(part.where);
  f.choice("kind", part.kind,
           "The kind of the part: a filler, a hose with a bore, an optical fibre, or a cable without described wires. "
           "The life of a cable or hose follows from its ratings. All but hoses are solid.");
  f.maybe_number("bore_mm", part.bore, above(0), "The inner diameter of a hose. Default: two thirds of the outer one.");
  f.choice("filled_with", part.medium, "The content of a hose: water, or air of no weight.");
  f.maybe_number("bending_stiffness_Nm2", part.bending_stiffness, above(0),
                 "E I of the part. Default: of polymer of 50 MPa. E A follows from it.");
  f.maybe_number(
      "damage_exponent", part.damage_exponent, between(1, 20),
      "For a cable or hose with ratings: a bend or twist of twice the range does 2^m times the damage. Default: 5, an "
      "ESTIMATE with a deviation of 1.5.");
  f.maybe_number(
      "least_bend_radius_mm", part.least_bend_radius, above(0),
      "The least bend radius of a hose by its maker, at its axis. A tighter bend counts as a kink. Default: the radius "
      "at which its wall kinks, an ESTIMATE from its two diameters.");
  f.maybe_number("pressure_bar", part.pressure, above(0),
                 "The largest working pressure in a hose, above that of the air outside. With most_pressure_bar.");
  f.maybe_number(
      "most_pressure_bar", part.most_pressure, above(0),
      "The working pressure that the maker of a hose allows at 20 C. Above it pressure_bar causes a warning. In a cell above 23 C "
      "the limit decreases by 1.75 % of itself per kelvin above 20 C. With pressure_bar.");
}

void check_plain_part(const PlainPart& part, double radius, std::string_view name) {
  if (part.kind != PlainKind::hose && (part.bore || part.medium != Medium::air))
    throw InputError(part.where, fmt::format("'{}' is a {} and has a bore or a filling", name, word(part.kind)),
                     "set kind: hose, or leave out bore_mm and filled_with");
  if (!has_rated_life(part.kind) && part.damage_exponent)
    throw InputError(part.where, fmt::format("'{}' is a {} and has a damage_exponent", name, word(part.kind)),
                     "set kind: cable or hose, or leave it out");
  if (part.kind != PlainKind::hose && part.least_bend_radius)
    throw InputError(part.where, fmt::format("'{}' is a {} and has a least_bend_radius_mm", name, word(part.kind)),
                     "set kind: hose, or leave it out");
  if (part.kind != PlainKind::hose && (part.pressure || part.most_pressure))
    throw InputError(part.where, fmt::format("'{}' is a {} and has a pressure", name, word(part.kind)),
                     "set kind: hose, or leave out pressure_bar and most_pressure_bar");
  if (part.pressure.has_value() != part.most_pressure.has_value())
    throw InputError(part.where,
                     fmt::format("'{}' has {}, but not {}", name, part.pressure ? "pressure_bar" : "most_pressure_bar",
                                 part.pressure ? "most_pressure_bar" : "pressure_bar"),
                     "give both, because one is compared with the other");
  if (part.least_bend_radius && *part.least_bend_radius < radius)
    throw InputError(part.where,
                     fmt::format("'{}' has least_bend_radius_mm {:.4g} (it is {:.4g} mm wide outside)", name,
                                 1e3 * *part.least_bend_radius, 2e3 * radius),
                     "give the radius of its axis, which is at least half its outer diameter");
  if (part.bore && *part.bore >= 2 * radius)
    throw InputError(
        part.where,
        fmt::format("'{}' has bore_mm {:.4g} (it is {:.4g} mm wide outside)", name, 1e3 * *part.bore, 2e3 * radius),
        "the bore is the inner diameter; radius_mm is half the outer one");
}

}  // namespace dresslife::pipeline
