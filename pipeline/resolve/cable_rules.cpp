#include "pipeline/resolve/cable_rules.h"

#include <algorithm>
#include <iterator>

namespace dresslife::pipeline {
namespace {

/// Length [mm] up to this section [mm2].
struct Step {
  double section, length;
};

constexpr Step wires_of_class_5[] = {{0.499, 0.16}, {1, 0.21},   {2.5, 0.26}, {6, 0.31},
                                     {50, 0.41},    {400, 0.51}, {630, 0.61}};
constexpr Step wires_of_class_6[] = {{0.499, 0.11}, {4, 0.16}, {35, 0.21}, {150, 0.31}, {300, 0.41}};
constexpr Step insulations[] = {{0.499, 0.3}, {1, 0.6},   {1.5, 0.7}, {6, 0.8},   {16, 1.0},  {35, 1.2}, {70, 1.4},
                                {120, 1.6},   {150, 1.8}, {185, 2.0}, {240, 2.2}, {300, 2.4}, {400, 2.6}};
constexpr double below_the_limit = 0.01;                    // [mm], of real strands
constexpr double jacket_slope = 0.035, jacket_base = 1e-3;  // [1], [m]
constexpr double rounding = 1e-6;                           // relative, of a section

template <class Table>
double length_at(const Table& table, double section) {
  const double square_millimetres = 1e6 * section;
  const auto found = std::ranges::find_if(
      table, [&](const Step& entry) { return square_millimetres <= entry.section * (1 + rounding); });
  return found == std::end(table) ? 0 : found->length / 1e3;
}

}  // namespace

double thickest_wire(int conductor_class, double section) {
  return conductor_class == flexible_class ? length_at(wires_of_class_5, section)
                                           : length_at(wires_of_class_6, section);
}

double usual_wire(int conductor_class, double section) {
  return thickest_wire(conductor_class, section) - below_the_limit / 1e3;
}

double usual_insulation(double section) {
  const double length = length_at(insulations, section);
  return length > 0 ? length : std::prev(std::end(insulations))->length / 1e3;
}

double usual_jacket(double bundle) { return jacket_slope * bundle + jacket_base; }

double bundle_in(double outer_diameter) { return (outer_diameter - 2 * jacket_base) / (1 + 2 * jacket_slope); }

}  // namespace dresslife::pipeline
