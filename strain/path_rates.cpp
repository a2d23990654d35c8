#include "strain/path_rates.h"

#include <algorithm>
#include <cmath>

namespace dresslife::strain {
namespace {

constexpr double places_per_turn = 6, least_places = 4;

/// Returns the length along the dresspack of the shortest turn of any part from the dresspack to a member [m].
double shortest_turn(const Construction& construction, int parent, const std::vector<PathMember>& members) {
  double shortest = std::numeric_limits<double>::infinity();
  const auto consider = [&](int layer, int in) {
    shortest = std::min(shortest, construction.layers()[layer].pitch() / construction.length_rate(in));
  };
  for (int part = parent; part != dresspack_itself; part = construction.parts()[part].parent)
    consider(construction.parts()[part].layer, construction.parts()[part].parent);
  for (const PathMember& member : members) consider(member.layer, parent);
  return shortest;
}

}  // namespace

PathRates::PathRates(const Construction& construction, const std::vector<LayerSlip>& plan, int parent,
                     std::vector<PathMember> members, const std::vector<double>& lengths,
                     const std::vector<double>& arcs)
    : count_(members.size()), places_(lengths.size()), rest_(lengths.size() * members.size(), 0.0) {
  const double turn = shortest_turn(construction, parent, members);
  for (std::size_t segment = 0; segment < lengths.size(); ++segment) {
    const double length = lengths[segment];
    const double places = std::isinf(turn) ? 1 : std::max(least_places, std::ceil(places_per_turn * length / turn));
    weights_.push_back(length / places);
    for (double place = 0; place < places; ++place) {
      const double arc = arcs[segment] + length * ((place + 0.5) / places - 0.5);
      BundleNesting nesting = nesting_to(construction, plan, parent, arc, surface_fibres(0));
      for (std::size_t n = 0; n < count_; ++n) {
        const PathMember& member = members[n];
        nesting.nodes.push_back(
            node_at(construction, plan, nesting, member.layer, member.number, parent, arc, member.turn));
        rest_[segment * count_ + n] += weights_.back() * nesting.nodes.back().rest_rate;
      }
      places_[segment].push_back(std::move(nesting));
    }
  }
}

}  // namespace dresslife::strain
