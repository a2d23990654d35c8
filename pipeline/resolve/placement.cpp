#include "pipeline/resolve/placement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "pipeline/base/constants.h"
#include "pipeline/base/halving.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/order.h"
#include "pipeline/job/parts_room.h"
#include "pipeline/settings/units.h"

namespace dresslife::pipeline {
namespace {

constexpr double touching_of_radius = 1e-9;  // relative to a radius
constexpr int halvings = 60;

/// Returns the sum of the angles that parts need on a circle [rad]; infinite: two of them touch across the circle.
double asked(const std::vector<double>& radii, double circle) {
  double sum = 0;
  for (std::size_t k = 0; k < radii.size(); ++k) {
    const double share = (radii[k] + radii[(k + 1) % radii.size()]) / (2 * circle);
    if (share > 1) return HUGE_VAL;
    sum += 2 * std::asin(share);
  }
  return sum;
}

/// Returns thick and thin parts in turn, which distributes the weight.
std::vector<std::size_t> spread(const std::vector<double>& radii, std::vector<std::size_t> parts) {
  std::ranges::stable_sort(parts, [&](std::size_t a, std::size_t b) { return radii[a] > radii[b]; });
  if (radii[parts.front()] == radii[parts.back()]) return parts;
  std::vector<std::size_t> order;
  for (std::size_t front = 0, back = parts.size(); front < back;) {
    order.push_back(parts[front++]);
    if (front < back) order.push_back(parts[--back]);
  }
  return order;
}

/// Returns the circle of a ring in a bore; std::nullopt: the parts do not fit, or would reach into the core. Precondition: two or
/// more parts.
std::optional<double> circle_of(const std::vector<double>& radii, double bore, double core) {
  const double thickest = *std::ranges::max_element(radii);
  const double widest = bore - thickest;
  if (widest <= 0 || asked(radii, widest) > 2 * pi * (1 + touching_of_radius)) return std::nullopt;
  const double least_circle =
      halved(0, widest, halvings, [&](double circle) { return asked(radii, circle) > 2 * pi; }).high;
  const double least = std::max(least_circle, core + thickest);
  if (least > widest * (1 + touching_of_radius)) return std::nullopt;
  const auto leaves_more_outside = [&](double circle) {
    const double gap = circle * (2 * pi - asked(radii, circle)) / static_cast<double>(radii.size());
    return widest - circle > gap / 2;
  };
  return halved(std::min(least, widest), widest, halvings, leaves_more_outside).low;
}

std::vector<double> chosen(const std::vector<double>& radii, const std::vector<std::size_t>& parts) {
  return mapped(parts, [&](std::size_t part) { return radii[part]; });
}

void place_on(double circle, const std::vector<double>& radii, const std::vector<std::size_t>& order,
              std::vector<PlacedPart>& places) {
  const std::vector<double> of = chosen(radii, order);
  const double gap = std::max(0.0, 2 * pi - asked(of, circle)) / static_cast<double>(order.size());
  double phase = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    places[order[k]] = {circle, phase};
    phase += 2 * std::asin((of[k] + of[(k + 1) % of.size()]) / (2 * circle)) + gap;
  }
}

/// Fills the bore with parts: in one ring, around the thickest part, or around further rings.
bool fill(const std::vector<double>& radii, std::vector<std::size_t> parts, double bore, double core,
          std::vector<PlacedPart>& places) {
  if (parts.empty()) return true;
  if (parts.size() == 1) {
    const double radius = radii[parts[0]];
    if (core == 0) {
      places[parts[0]] = {};
      return radius <= bore * (1 + touching_of_radius);
    }
    places[parts[0]] = {(bore + core) / 2, 0};
    return 2 * radius <= (bore - core) * (1 + touching_of_radius);
  }
  const auto sum = [&](const auto& of) { return sum_of(parts, [&](std::size_t part) { return of(radii[part]); }); };
  if (sum([](double r) { return r * r; }) > bore * bore - core * core) return false;  // by area
  std::ranges::stable_sort(parts, [&](std::size_t a, std::size_t b) { return radii[a] > radii[b]; });
  // First the thickest part is put into the middle, then more and more parts inside of the ring.
  double in_ring = sum([](double r) { return r; }), too_narrow = 0;
  for (std::size_t inside = 0; inside < parts.size(); in_ring -= radii[parts[inside++]]) {
    const double widest_part = radii[parts[inside]];
    if (inside > 0 && in_ring > pi * (bore - widest_part) * (1 + touching_of_radius))
      continue;  // asin(x) >= x in asked()
    const std::vector<std::size_t> within(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(inside)),
        order = spread(radii, {parts.begin() + static_cast<std::ptrdiff_t>(inside), parts.end()});
    if (order.size() < 2) break;
    const std::vector<double> ring = chosen(radii, order);
    if (inside == 0) {
      if (const auto circle = circle_of(ring, bore, core)) return place_on(*circle, radii, order, places), true;
      continue;
    }
    // A ring at the wall leaves the largest space inside. Afterwards the ring moves to the circle that its own parts need.
    if (asked(ring, bore - widest_part) > 2 * pi * (1 + touching_of_radius)) continue;
    const double space = bore - 2 * widest_part;
    if (space <= too_narrow) continue;  // for fewer parts
    if (!fill(radii, within, space, core, places)) {
      too_narrow = space;
      continue;
    }
    const double taken =
        largest_of(within, core, [&](std::size_t part) { return places[part].helix_radius + radii[part]; });
    if (const auto circle = circle_of(ring, bore, taken)) return place_on(*circle, radii, order, places), true;
  }
  return false;
}

double number_of(const Node& map, const char* key) {
  const Node* value = map.find(key);
  return value ? std::strtod(value->text.c_str(), nullptr) : 0;
}

std::string millimetres(double metres) { return shortest_text(std::round(1e6 * metres) / 1e3); }

struct AutoPart {
  std::size_t component;
  int number;  ///< number of the part in its component, 0 first
};

/// Returns the parts with `place: auto`, in the order of the components. Adds problems of their keys.
std::vector<AutoPart> auto_parts(const Node& components, const std::string& path, double& core, Problems& problems) {
  std::vector<AutoPart> parts;
  for (std::size_t i = 0; i < components.items.size(); ++i) {
    const Node& component = components.items[i];
    const std::string key = fmt::format("{}.components[{}]", path, i + 1);
    if (!component.is_map()) continue;
    const Node* place = component.find("place");
    if (!place) {
      if (number_of(component, "helix_radius_mm") == 0)
        core = std::max(core, number_of(component, "radius_mm") / 1e3);
      else
        problems.add(component.where, "lies off the axis at a place of its own, beside parts with place: auto",
                     "write place: auto for it, too, or give all places", key);
      continue;
    }
    if (place->text != "auto")
      problems.add(place->where, fmt::format("place is '{}' (must be auto)", place->text),
                   "write auto, or helix_radius_mm and phase_deg instead of place", key);
    for (const char* other : {"helix_radius_mm", "phase_deg", "lay_angle_deg"})
      if (const Node* given = component.find(other))
        problems.add(given->where, fmt::format("both place and {} are given", other), "keep one of the two", key);
    if (!(number_of(component, "radius_mm") > 0) &&
        !component.find("data_sheet"))  // a remaining data sheet was refused already
      problems.add(component.where, "has place: auto and no radius_mm", "give radius_mm, or a data_sheet", key);
    if (const double most = unit_of_key("radius_mm").most; number_of(component, "radius_mm") > most)
      problems.add(component.where, fmt::format("has place: auto and a radius_mm of more than {:g}", most),
                   "give the radius of the part", key);
    const Node* const given_count = component.find("count");
    // Parts of a split component lose the key, so it is checked here.
    if (given_count && given_count->text.find_first_not_of("0123456789") != std::string::npos)
      problems.add(given_count->where, fmt::format("count is '{}' (must be a whole number)", given_count->text),
                   "give the number of equal parts", key);
    constexpr double most = 1000;  // as describe() of a component allows
    const double count = given_count ? number_of(component, "count") : 1;
    if (count > most)
      problems.add(given_count->where, fmt::format("count is {} (must be 1 .. {:g})", given_count->text, most),
                   "correct it", key);
    for (int number = 0; number < static_cast<int>(std::clamp(count, 1.0, most)); ++number)
      parts.push_back({i, number});
  }
  return parts;
}

void set_place(Node& component, const PlacedPart& place) {
  std::erase_if(component.entries, [](const Entry& entry) { return entry.key == "place"; });
  component["helix_radius_mm"] = scalar(millimetres(place.helix_radius));
  component["phase_deg"] = scalar(shortest_text(std::round(1e3 * place.phase * 180 / pi) / 1e3));
  for (const char* key : {"helix_radius_mm", "phase_deg"}) component[key].where = component.where;
}

/// Returns "a", "b", .. "z", "aa", ..
std::string letter(int number) {
  std::string text;
  for (; number >= 0; number = number / 26 - 1) text.insert(text.begin(), static_cast<char>('a' + number % 26));
  return text;
}

/// Returns whether places are evenly spaced on one circle, in their order.
bool even(const std::vector<PlacedPart>& places) {
  for (std::size_t k = 0; k < places.size(); ++k) {
    const double off = std::remainder(
        places[k].phase - places[0].phase - 2 * pi * static_cast<double>(k) / static_cast<double>(places.size()),
        2 * pi);
    if (std::abs(places[k].helix_radius - places[0].helix_radius) > touching_of_radius || std::abs(off) > 1e-6)
      return false;
  }
  return true;
}

}  // namespace

double bore_of(const Node& dresspack) {
  if (dresspack.find("inner_diameter_mm")) return number_of(dresspack, "inner_diameter_mm");
  const Node* profile = dresspack.find("hose_corrugation");
  if (!profile || !profile->is_map()) return 0;
  return number_of(dresspack, "diameter_mm") - 2 * number_of(*profile, "height_mm");
}

std::string wider_hose_of(const Node& dresspack, double bore) {
  const Node* profile = dresspack.find("hose_corrugation");
  return wider_hose(bore, profile && profile->is_map() ? number_of(*profile, "height_mm") : 0,
                    dresspack.find("inner_diameter_mm") != nullptr);
}

std::optional<std::vector<PlacedPart>> pack_in_bore(const std::vector<double>& radii, double bore, double core) {
  std::vector<PlacedPart> places(radii.size());
  std::vector<std::size_t> parts = indices_of(radii.size());
  if (!fill(radii, parts, bore, core, places)) return std::nullopt;
  return places;
}

void expand_places(Node& dresspack, const std::string& path, Problems& problems) {
  Node* components = dresspack.is_map() ? dresspack.find("components") : nullptr;
  if (!components || !components->is_list()) return;
  const auto asks = [](const Node& component) { return component.is_map() && component.find("place"); };
  const auto first = std::ranges::find_if(components->items, asks);
  if (first == components->items.end()) return;
  const Where where = first->where;
  Problems own;
  double core = number_of(dresspack, "core_diameter_mm") / 2e3;
  const double bore = bore_of(dresspack) / 2e3;
  const std::vector<AutoPart> parts = auto_parts(*components, path, core, own);
  if (const double diameter = number_of(dresspack, "diameter_mm");
      bore < 0 && diameter > 0 && !dresspack.find("inner_diameter_mm")) {
    constexpr double in_metres = 1;  // [mm]: no hose is thinner
    own.add(
        where,
        fmt::format("place: auto is given, and hose_corrugation leaves no bore in the hose (diameter_mm is {:g})",
                    diameter),
        fmt::format("give diameter_mm: {:g} if {}, or check height_mm: the diameter is the bore and twice the height",
                    (diameter < in_metres ? 1000 : 10) * diameter,
                    diameter < in_metres ? "that was metres" : "a zero was lost"),
        path);
  } else if (!(bore > 0)) {
    Dresspack hose;
    hose.diameter = number_of(dresspack, "diameter_mm") / 1e3;
    own.add(where, "place: auto is given, and the hose's bore is not (how much room there is is not known)",
            fmt::format("give inner_diameter_mm or hose_corrugation of the dresspack{}",
                        hose.diameter > 0
                            ? fmt::format(", of {:g} mm usually hose_material: hose_polyamide and {} (ESTIMATE)",
                                          1e3 * hose.diameter, corrugation_line(usual_corrugation(hose)))
                            : ""),
            path);
  }
  if (!problems.attempt(path + ".components", where, [&] { own.finish(); })) return;
  if (std::ranges::any_of(components->items, [](const Node& of) { return of.is_map() && of.find("data_sheet"); })) {
    for (Node& component : components->items)
      if (asks(component)) set_place(component, {});  // their places depend on the cable whose data sheet was refused
    return;
  }
  const std::vector<double> radii = mapped(
      parts, [&](const AutoPart& part) { return number_of(components->items[part.component], "radius_mm") / 1e3; });
  const auto places = pack_in_bore(radii, bore, core);
  if (!places) {
    double enough = 2 * bore;
    while (!pack_in_bore(radii, enough, core)) enough *= 2;
    for (double low = bore; enough - low > 1e-5;) {
      const double middle = (low + enough) / 2;
      (pack_in_bore(radii, middle, core) ? enough : low) = middle;
    }
    problems.add(
        where, fmt::format("{} parts with place: auto do not fit into the bore of {:.4g} mm", parts.size(), 2e3 * bore),
        fmt::format("take fewer or thinner parts, or a hose with {}", wider_hose_of(dresspack, 2e3 * enough)),
        path + ".components");
    return;
  }
  std::vector<Node> placed;
  std::vector<std::size_t> entries;  // of the placed parts, from 1
  for (std::size_t i = 0; i < components->items.size(); ++i) {
    std::vector<PlacedPart> own_places;
    for (std::size_t k = 0; k < parts.size(); ++k)
      if (parts[k].component == i) own_places.push_back((*places)[k]);
    Node component = components->items[i];
    if (own_places.empty()) {
      placed.push_back(component);
      entries.push_back(i + 1);
      continue;
    }
    if (own_places.size() == 1 || even(own_places)) {
      set_place(component, own_places.front());
      placed.push_back(component);
      entries.push_back(i + 1);
      continue;
    }
    std::erase_if(component.entries, [](const Entry& entry) { return entry.key == "count"; });
    const std::string name = component.find("name") ? component.find("name")->text : "part";
    for (std::size_t k = 0; k < own_places.size(); ++k) {
      Node single = component;
      single["name"].text = name + " " + letter(static_cast<int>(k));
      set_place(single, own_places[k]);
      placed.push_back(single);
      entries.push_back(i + 1);
    }
  }
  // Remedies name keys of the user's list, which has fewer entries then.
  if (placed.size() > components->items.size())
    for (std::size_t k = 0; k < placed.size(); ++k) placed[k]["entry"] = scalar(std::to_string(entries[k]));
  components->items = std::move(placed);
}

}  // namespace dresslife::pipeline
