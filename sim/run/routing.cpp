#include "sim/run/routing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/base/warning_words.h"
#include "pipeline/cable/plain_properties.h"
#include "pipeline/cable/warmth.h"
#include "pipeline/job/setup.h"
#include "pipeline/resolve/plausible_job.h"

namespace dresslife::sim {
namespace {

RodProperties properties_of(const pipeline::MountedDresspack& mounted, const pipeline::SimulationSettings& settings) {
  const pipeline::Dresspack& hose = mounted.dresspack;
  RodProperties properties;
  properties.segments = settings.segments;
  properties.length = mounted.routing.free_length;
  properties.mass_per_length = hose.mass_per_length;
  properties.diameter = hose.diameter;
  properties.bending_stiffness = settings.stiffness_factor * pipeline::elastic_bending_stiffness(hose);
  for (const pipeline::BendingFriction& friction : hose.bending_friction)
    properties.friction.push_back({settings.stiffness_factor * friction.stiffness, friction.slides_at});
  properties.loss_factor = hose.loss_factor.value_or(0);
  properties.torsional_stiffness = hose.torsional_stiffness;
  properties.axial_stiffness = hose.axial_stiffness;
  properties.damping_time = hose.damping_time;
  properties.gravity = settings.gravity;
  properties.rest_curvature = {0, hose.rest_curvature, 0};  // a rotation about y moves z toward x
  return properties;
}

std::vector<RodProperties> spans_of(const RodProperties& whole, const pipeline::Routing& routing) {
  std::vector<double> ends;
  for (const pipeline::IntermediateClamp& clamp : routing.clamps) ends.push_back(clamp.at_length);
  ends.push_back(whole.length);
  const std::vector<std::array<pipeline::BendRelief, 2>> reliefs = pipeline::bend_reliefs(routing);
  std::vector<RodProperties> spans;
  double begin = 0;
  for (const double end : ends) {
    const auto before = [&](double s) { return static_cast<int>(std::lround(whole.segments * s / whole.length)); };
    RodProperties span = whole;
    span.length = end - begin;
    span.segments = std::max(fewest_segments, before(end) - before(begin));
    const std::array<pipeline::BendRelief, 2> relief = reliefs[spans.size()];
    span.stiff_ends = {StiffEnd{relief[0].length, relief[0].stiffness},
                       StiffEnd{relief[1].length, relief[1].stiffness}};
    spans.push_back(span);
    begin = end;
  }
  if (const auto& unit = routing.retraction)
    spans.front().slider =
        SlidingClamp{unit->force, unit->spring, unit->stroke, unit->damping, unit->friction, unit->mass};
  if (!is_clamped(routing.tool_end)) {
    spans.back().tool_end = End::free;
    spans.back().tip_mass = routing.tool_mass;
  }
  return spans;
}

void append(std::vector<Vector3>& to, const std::vector<Vector3>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

Rod rod_of(const pipeline::Setup& setup) {
  std::vector<RodProperties> all;
  std::vector<int> first_of_dresspack;
  for (const pipeline::MountedDresspack& mounted : setup.dresspacks) {
    first_of_dresspack.push_back(static_cast<int>(all.size()));
    const std::vector<RodProperties> spans = spans_of(properties_of(mounted, setup.simulation), mounted.routing);
    all.insert(all.end(), spans.begin(), spans.end());
  }
  return Rod(all, first_of_dresspack);
}

std::vector<RoutedRing> routed_rings(const pipeline::Setup& setup) {
  std::vector<RoutedRing> routed;
  int first_span = 0;
  for (const pipeline::MountedDresspack& mounted : setup.dresspacks) {
    const pipeline::Routing& routing = mounted.routing;
    for (const pipeline::GuideRing& ring : routing.rings) {
      const auto before = std::ranges::count_if(routing.clamps, [&](const pipeline::IntermediateClamp& clamp) {
        return ring.at_length && clamp.at_length <= *ring.at_length;
      });
      routed.push_back({ring, first_span + static_cast<int>(before), ring.radius - mounted.dresspack.diameter / 2});
    }
    first_span += static_cast<int>(routing.clamps.size()) + 1;
  }
  return routed;
}

std::vector<double> shortest_ways(const pipeline::Setup& setup, const Rod& rod, const ClampFrames& clamps,
                                  const std::vector<Frame>& rings) {
  const std::vector<RoutedRing> routed = routed_rings(setup);
  std::vector<double> ways;
  for (int k = 0; k < static_cast<int>(rod.spans().size()); ++k) {
    std::vector<Vector3> through;
    double saved = 0;
    for (size_t r = 0; r < rings.size(); ++r)
      if (routed[r].span == k) {
        through.push_back(rings[r].position);
        saved += 2 * routed[r].clearance;
      }
    ways.push_back(shortest_way(rod, clamps, k, through) - saved);
  }
  return ways;
}

RodState joined(const Rod& rod, const std::vector<RodState>& spans) {
  RodState whole = spans.front();
  whole.memory.clear();
  whole.clamps.between.resize(2 * spans.size() - 2);
  for (size_t k = 1; k < spans.size(); ++k) {
    const RodState& span = spans[k];
    append(whole.position, span.position);
    whole.orientation.insert(whole.orientation.end(), span.orientation.begin(), span.orientation.end());
    append(whole.velocity, span.velocity);
    append(whole.angular_velocity, span.angular_velocity);
    append(whole.link_force, span.link_force);
    whole.travel.insert(whole.travel.end(), span.travel.begin(), span.travel.end());
    append(whole.clamp_velocity, span.clamp_velocity);
    append(whole.clamp_angular_velocity, span.clamp_angular_velocity);
  }
  for (int k = 0; k < static_cast<int>(rod.spans().size()); ++k) {
    whole.clamps.end(2 * k) = spans[k].clamps.base;
    whole.clamps.end(2 * k + 1) = spans[k].clamps.tool;
  }
  return whole;
}

std::vector<Frame> listed_clamps(const Rod& rod, const ClampFrames& clamps) {
  std::vector<Frame> list;
  for (int k = 0; k < static_cast<int>(rod.spans().size()); ++k) {
    if (rod.spans()[k].first_arc == 0) list.push_back(clamps.end(2 * k));
    list.push_back(clamps.end(2 * k + 1));
  }
  return list;
}

std::vector<int> clamp_segments(const Rod& rod) {
  std::vector<int> list;
  for (const Span& span : rod.spans()) {
    if (span.first_arc == 0) list.push_back(span.first_segment);
    list.push_back(span.first_segment + span.segments());
  }
  return list;
}

std::vector<pipeline::Warning> one_link_warnings(const pipeline::Setup& setup) {
  std::vector<pipeline::Warning> warnings;
  for (std::size_t d = 0; d < setup.dresspacks.size(); ++d) {
    const pipeline::Routing& routing = setup.dresspacks[d].routing;
    const pipeline::Clamp* const wrong = pipeline::clamp_on_wrong_link(routing, setup.robot);
    if (!wrong) continue;
    const std::string& link = wrong->link;
    const bool base = wrong == &*routing.base_clamp;
    const auto is_there = [&](const auto& place) { return place.link == link; };
    if (!std::ranges::all_of(routing.rings, is_there) ||
        !std::ranges::all_of(routing.clamps, [&](const auto& of) { return is_there(of.clamp); }))
      continue;
    warnings.push_back(pipeline::warning_of(
        pipeline::WarningKind::motion, wrong->where.text(),
        fmt::format("both clamps of {} are on {}, so that no axis bends it: its life is that of its swing alone",
                    pipeline::dresspack_words(setup, d), link),
        "one of the clamps names another link than it is mounted on",
        fmt::format("routing.{}.link{} with a link {} the axes that bend the dresspack, for example {}",
                    base ? "base_clamp" : "tool_clamp", setup.dresspacks[d].name.empty() ? "" : " of this dresspack",
                    base ? "before" : "beyond", pipeline::probable_link(*wrong, setup.robot))));
  }
  return warnings;
}

std::string warmth_words(const pipeline::Setup& setup) {
  constexpr double far = 10;  // [K]: 16 % of the modulus of a polymer (F36)
  const double temperature = setup.cell.temperature;
  if (std::abs(temperature - pipeline::Cell::usual_temperature) < far) return "";
  return fmt::format(
      "cell.temperature_C: {:g} (a polymer's stiffness from the construction is {:.2g} times that at {:g} C)",
      temperature, pipeline::stiffness_at(temperature), pipeline::Cell::usual_temperature);
}

}  // namespace dresslife::sim
