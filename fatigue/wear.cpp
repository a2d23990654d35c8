#include "fatigue/wear.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

namespace dresslife::fatigue {
namespace {

using pipeline::Counterface;

constexpr double on_links = 1, at_rings = 0.25, in_hose = 10;  // length of the footprint over the diameter

bool is_ring(const std::string& obstacle) { return obstacle.starts_with("ring "); }

Counterface counterface(const std::string& obstacle) {
  if (is_ring(obstacle)) return Counterface::ring;
  for (const Counterface one : {Counterface::floor, Counterface::dresspack, Counterface::cell, Counterface::hose})
    if (obstacle == word(one)) return one;
  return Counterface::robot;
}

/// Wear of a dresspack by one obstacle per repeat.
struct Field {
  std::vector<double> area;     ///< (cell, sector) per length [m2]
  std::vector<double> volume;   ///< (cell) at the place of the rubbing [m3]
  std::vector<double> largest;  ///< (cell) largest volume of one patch [m3]
  std::vector<double> time;     ///< (cell) time of this patch [s]
};

/// Cells of equal length along a dresspack, sectors of equal width around it.
struct Grid {
  double length = 0, width = 0;
  std::size_t cells = 0, sectors = 0;

  /// least: minimum length of the grid [m].
  Grid(const std::vector<RubbedPatch>& patches, double least) {
    double end = least;
    length = std::numeric_limits<double>::infinity();
    for (const RubbedPatch& patch : patches) {
      length = std::min(length, patch.length);
      end = std::max(end, patch.position + patch.length / 2);
    }
    width = patches[0].width;
    cells = static_cast<std::size_t>(end / length) + 1;
    sectors = static_cast<std::size_t>(std::lround(2 * std::numbers::pi / width));
  }
  std::size_t at(std::size_t cell, std::size_t sector) const { return cell * sectors + sector % sectors; }

  /// Adds a patch. Its work is divided among the cells that it overlaps.
  void add(Field& field, const RubbedPatch& patch, double rate) const {
    field.area.resize(cells * sectors);
    for (std::vector<double>* of : {&field.volume, &field.largest, &field.time}) of->resize(cells);
    const auto sector = static_cast<std::size_t>(patch.angle / width);
    const double from = (patch.position - patch.length / 2) / length, to = from + patch.length / length;
    for (auto cell = static_cast<std::size_t>(std::max(0.0, from)); cell < cells && static_cast<double>(cell) < to;
         ++cell) {
      const auto begin = static_cast<double>(cell);
      const double share = (std::min(to, begin + 1) - std::max(from, begin)) / (to - from);
      const double volume = rate * patch.work * share;
      field.area[at(cell, sector)] += volume / length;
      field.volume[cell] += volume;
      if (volume > field.largest[cell]) field.largest[cell] = volume, field.time[cell] = patch.time;
    }
  }
  std::size_t cells_of(double footprint) const {
    return std::clamp<std::size_t>(static_cast<std::size_t>(std::lround(footprint / length)), 1, cells);
  }
  /// Returns the first of `wide` cells around a cell.
  std::size_t first_of(std::size_t wide, std::size_t cell) const {
    return std::min(cell - std::min(cell, wide / 2), cells - wide);
  }
  /// Replaces the area by its means over `wide` cells along the hose.
  void spread(Field& field, std::size_t wide) const {
    std::vector<double> sum(cells + 1);
    for (std::size_t sector = 0; sector < sectors; ++sector) {
      for (std::size_t cell = 0; cell < cells; ++cell) sum[cell + 1] = sum[cell] + field.area[at(cell, sector)];
      for (std::size_t cell = 0; cell < cells; ++cell) {
        const std::size_t first = first_of(wide, cell);
        field.area[at(cell, sector)] = std::max(0.0, sum[first + wide] - sum[first]) / static_cast<double>(wide);
      }
    }
  }
};

}  // namespace

double WornLayer::area(double depth, double arc) const {
  constexpr double cap = 4.0 / 3;
  if (crest == 0) return depth * (arc + cap * std::sqrt(2 * radius * depth));
  return depth * (std::numbers::pi * depth * std::sqrt(radius * crest) + cap * arc * std::sqrt(2 * crest * depth)) /
         pitch;
}

std::optional<WornMaterial> worn_of(const pipeline::Dresspack& dresspack) {
  WornMaterial worn{};
  worn.layer.radius = dresspack.diameter / 2;
  if (dresspack.sleeve) {
    worn.layer.thickness = dresspack.sleeve->thickness;
    worn.material = find_material(dresspack, dresspack.sleeve->material);
  } else if (dresspack.hose_corrugation) {
    worn.layer.thickness = dresspack.hose_corrugation->wall;
    worn.layer.pitch = dresspack.hose_corrugation->pitch;
    worn.layer.crest = worn.layer.pitch / 4;
    worn.material = find_material(dresspack, dresspack.hose_material);
  }
  if (!dresspack.sleeve)
    for (const pipeline::Component& part : dresspack.components)
      if (is_surface(dresspack, part)) return jacket_of(dresspack, part);
  if (!worn.material || worn.material->wear.empty()) return {};
  return worn;
}

bool is_hose(const pipeline::Dresspack& dresspack) {
  return dresspack.hose_corrugation || dresspack.inner_diameter || !dresspack.hose_material.empty();
}

bool is_surface(const pipeline::Dresspack& dresspack, const pipeline::Component& part) {
  constexpr double rounding = 1e-6;
  return !is_hose(dresspack) && std::abs(2 * part.radius - dresspack.diameter) < rounding * dresspack.diameter;
}

std::optional<WornMaterial> jacket_of(const pipeline::Dresspack& dresspack, const pipeline::Component& cable) {
  if (!cable.jacket) return {};
  const pipeline::Material* const material = find_material(dresspack, cable.jacket->material);
  if (!material || material->wear.empty()) return {};
  return WornMaterial{{cable.radius, cable.jacket->thickness, 0, 0}, material, {}};
}

const pipeline::WearRate& wear_rate(const pipeline::Material& material, const std::string& obstacle) {
  const auto of = [&](Counterface against) {
    return std::ranges::find(material.wear, against, &pipeline::WearRate::against);
  };
  const auto found = of(counterface(obstacle));
  return found != material.wear.end() ? *found : *of(Counterface::robot);
}

Abrasion abrasion(const WornMaterial& worn, const std::vector<RubbedPatch>& patches) {
  Abrasion worst;
  worst.repeats = std::numeric_limits<double>::infinity();
  if (patches.empty()) return worst;
  const WornLayer& layer = worn.layer;
  const Grid grid(patches, 2 * layer.radius);
  const auto footprint = [&](const std::string& obstacle) {
    const double share = is_ring(obstacle) ? at_rings : obstacle == word(Counterface::hose) ? in_hose : on_links;
    return grid.cells_of(share * 2 * layer.radius);
  };
  std::map<std::string, Field> fields;
  for (const RubbedPatch& patch : patches)
    grid.add(fields[patch.obstacle], patch, worn.warm.factor * wear_rate(*worn.material, patch.obstacle).rate);
  std::vector<double> all(grid.cells * grid.sectors);
  for (auto& [obstacle, field] : fields) {
    grid.spread(field, footprint(obstacle));
    for (std::size_t k = 0; k < all.size(); ++k) all[k] += field.area[k];
  }
  std::vector<double> arc, through;  // (number of sectors of an arc, minus one)
  for (std::size_t count = 0; count < grid.sectors; ++count) {
    arc.push_back(static_cast<double>(count) * grid.width * layer.radius);
    through.push_back(layer.area(layer.thickness, arc.back()));
  }
  std::size_t worst_cell = 0, worst_arc = 0;
  for (std::size_t cell = 0; cell < grid.cells; ++cell)
    for (std::size_t first = 0; first < grid.sectors; ++first) {
      double area = 0;
      if (all[grid.at(cell, first)] == 0) continue;  // a narrower arc contains as much
      for (std::size_t count = 0; count < grid.sectors; ++count) {
        area += all[grid.at(cell, first + count)];
        if (through[count] < worst.repeats * area)
          worst.repeats = through[count] / area, worst_cell = cell, worst_arc = count;
      }
    }
  double most = 0;
  for (const auto& [obstacle, field] : fields) {
    const std::size_t wide = footprint(obstacle), first = grid.first_of(wide, worst_cell);
    const auto begin = field.volume.begin() + static_cast<std::ptrdiff_t>(first),
               end = begin + static_cast<std::ptrdiff_t>(wide);
    double volume = 0, moment = 0;
    for (auto cell = begin; cell < end; ++cell)
      volume += *cell, moment += *cell * static_cast<double>(cell - field.volume.begin());
    const double area = volume / static_cast<double>(wide);
    if (area <= most) continue;
    most = area;
    worst.obstacle = obstacle;
    worst.position = (moment / volume + 0.5) * grid.length;
    worst.time = field.time[static_cast<std::size_t>(std::max_element(begin, end) - field.volume.begin())];
  }
  worst.arc = arc[worst_arc];
  // The area is a power of the thickness, which is nearly constant within the spread.
  const double power = std::log2(layer.area(layer.thickness * 2, worst.arc) / through[worst_arc]);
  worst.log10_spread =
      std::hypot(std::hypot(std::log10(wear_rate(*worn.material, worst.obstacle).factor), power * thickness_spread),
                 worn.warm.log10_spread);
  return worst;
}

}  // namespace dresslife::fatigue
