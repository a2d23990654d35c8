#include "sim/run/checks.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "pipeline/cable/bend_limit.h"
#include "pipeline/files/check_names.h"

namespace dresslife::sim {
namespace {

using pipeline::WarningKind;
namespace check_name = pipeline::check_name;

constexpr double unlimited = std::numeric_limits<double>::infinity();

using Places = std::span<const Extreme>;

const Extreme& largest(Places places) { return *std::ranges::max_element(places, {}, &Extreme::value); }

const Extreme& largest_by_size(Places places) {
  return *std::ranges::max_element(
      places, [](const Extreme& a, const Extreme& b) { return std::abs(a.value) < std::abs(b.value); });
}

}  // namespace

WorkingLength working_length(double longest_way) {
  return {longest_way / (1 - least_slack_share), longest_way / (1 - most_slack_share)};
}

void Extreme::see(double candidate, bool larger, double when, int where) {
  if (seen && !larger) return;
  value = candidate;
  time = when;
  place = where;
  seen = true;
}

MotionLimits limits_of(const pipeline::Dresspack& dresspack) {
  return {pipeline::least_bend_radius(dresspack), dresspack.most_twist.value_or(most_twist),
          dresspack.most_tension.value_or(unlimited)};
}

MotionChecks::MotionChecks(const Rod& rod, std::vector<MotionLimits> limits)
    : rod_(rod),
      limits_(std::move(limits)),
      whole_(rod.dresspacks()),
      curvature_(rod.links()),
      twist_(rod.links()),
      tension_(rod.links()),
      least_slack_(rod.spans().size()),
      most_slack_(rod.spans().size()),
      travel_(rod.spans().size()),
      line_(rod.links()) {
  assert(static_cast<int>(limits_.size()) == rod.dresspacks());
}

double MotionChecks::net_twist() const {
  return std::accumulate(whole_.begin(), whole_.end(), 0.0,
                         [](double sum, const Whole& whole) { return sum + whole.net_twist; });
}

void MotionChecks::see(const RodState& state, const std::vector<Contact>& contacts, double time,
                       const std::vector<double>& ways) {
  see_links(state, time);
  see_spans(state, time, ways);
  for (const Contact& contact : contacts) {
    see_contact(contact.segment, contact, time);
    if (contact.other >= 0) see_contact(contact.other, contact, time);
  }
  begun_ = true;
  end_ = time;
}

void MotionChecks::see_links(const RodState& state, double time) {
  for (Whole& whole : whole_) whole.net_twist = 0;
  const std::vector<double> pull = rod_.tensions(state);
  for (int j = 0; j < rod_.links(); ++j) {
    const Vector3 turn = rod_.turn(state, j);
    whole_[rod_.span_of_link(j).dresspack].net_twist += turn.z();
    const double curvature = rod_.curvature(turn, j);
    const double twist = turn.z() / rod_.bending_length(j);
    if (!curvature_[j].seen || curvature > curvature_[j].value) line_[j] = line_at(state, j);
    curvature_[j].see(curvature, curvature > curvature_[j].value, time, j);
    twist_[j].see(twist, std::abs(twist) > std::abs(twist_[j].value), time, j);
    tension_[j].see(pull[j], pull[j] > tension_[j].value, time, j);
  }
  for (Whole& whole : whole_) {
    whole.most_net_twist.see(whole.net_twist, std::abs(whole.net_twist) > std::abs(whole.most_net_twist.value), time,
                             -1);
    if (!begun_) whole.net_twist_at_begin = whole.lowest = whole.highest = whole.net_twist;
    whole.lowest = std::min(whole.lowest, whole.net_twist);
    whole.highest = std::max(whole.highest, whole.net_twist);
  }
}

std::optional<double> MotionChecks::line_at(const RodState& state, int link) const {
  const Span& span = rod_.span_of_link(link);
  const int inward = link == span.first_link ? 1 : link == span.last_link() ? -1 : 0;
  if (inward == 0 || span.segments() < 4) return {};
  const auto bend = [&](int j) -> Eigen::Vector2d { return rod_.turn(state, j).head<2>() / rod_.bending_length(j); };
  const Eigen::Vector2d at_clamp = bend(link);
  if (at_clamp.norm() == 0) return {};
  return at_clamp.normalized().dot(2 * bend(link + inward) - bend(link + 2 * inward));
}

void MotionChecks::see_spans(const RodState& state, double time, const std::vector<double>& ways) {
  for (int k = 0; k < static_cast<int>(rod_.spans().size()); ++k) {
    const RodProperties& p = rod_.spans()[k].properties;
    if (p.slider) travel_[k].see(state.travel[k].way, state.travel[k].way > travel_[k].value, time, k);
    if (p.tool_end == End::free) continue;
    const Vector3 way = state.clamps.end(2 * k + 1).position - state.clamps.end(2 * k).position;
    const double slack = p.length - (ways.empty() ? way.norm() : ways[k]);
    least_slack_[k].see(slack, slack < least_slack_[k].value, time, k);
    most_slack_[k].see(slack, slack > most_slack_[k].value, time, k);
  }
}

void MotionChecks::see_contact(int segment, const Contact& contact, double time) {
  Whole& whole = whole_[rod_.span_of(segment).dresspack];
  if (contact.depth > whole.depth.value) whole.depth.see(contact.depth, true, time, segment);
  if (contact.normal_force > whole.force.value) whole.force.see(contact.normal_force, true, time, segment);
}

std::vector<Check> MotionChecks::table() const {
  std::vector<Check> checks;
  for (int d = 0; d < rod_.dresspacks(); ++d) {
    const size_t first = checks.size();
    add_lines(d, checks);
    add_slack(d, checks);
    for (size_t line = first; line < checks.size(); ++line) checks[line].dresspack = d;
  }
  return checks;
}

void MotionChecks::add_lines(int dresspack, std::vector<Check>& checks) const {
  const auto link = [&](const Extreme& e) { return rod_.link_arc(e.place); };
  const auto segment = [&](const Extreme& e) { return e.place < 0 ? -1 : rod_.span_of(e.place).arc(e.place); };
  const int first = rod_.spans()[rod_.first_span(dresspack)].first_link;
  const int last = rod_.spans()[rod_.first_span(dresspack + 1) - 1].last_link();
  const auto of = [&](const std::vector<Extreme>& links) { return Places(links).subspan(first, last + 1 - first); };
  const Extreme &bend = largest(of(curvature_)), &twist = largest_by_size(of(twist_)), &pull = largest(of(tension_));
  const MotionLimits& limits = limits_[dresspack];
  const Whole& whole = whole_[dresspack];
  const double radius = bend.value > 0 ? 1 / bend.value : unlimited;
  const Check lines[] = {
      {WarningKind::bend_radius, check_name::bend_radius, "m", radius, limits.least_bend_radius,
       radius < limits.least_bend_radius, bend.time, link(bend)},
      {WarningKind::twist, check_name::twist, "rad/m", twist.value, limits.most_twist,
       std::abs(twist.value) > limits.most_twist, twist.time, link(twist)},
      {{},
       check_name::net_twist,
       "rad",
       whole.most_net_twist.value,
       unlimited,
       false,
       whole.most_net_twist.time,
       -1,
       dresspack,
       (whole.lowest + whole.highest) / 2},
      {{}, check_name::twist_left, "rad", whole.net_twist - whole.net_twist_at_begin, unlimited, false, end_, -1},
      {WarningKind::tension, check_name::tension, "N", pull.value, limits.most_tension,
       pull.value > limits.most_tension, pull.time, link(pull)},
      {{}, check_name::contact_depth, "m", whole.depth.value, unlimited, false, whole.depth.time, segment(whole.depth)},
      {{}, check_name::contact_force, "N", whole.force.value, unlimited, false, whole.force.time, segment(whole.force)},
  };
  checks.insert(checks.end(), std::begin(lines), std::end(lines));
  Check& radius_line = checks[checks.size() - std::size(lines)];
  radius_line.line = line_[bend.place];
  radius_line.segment = rod_.span_of_link(bend.place).segment_length;
}

void MotionChecks::add_slack(int dresspack, std::vector<Check>& checks) const {
  const auto length = [&](const Extreme& e) { return rod_.spans()[e.place].properties.length; };
  const auto share = [&](const Extreme& e) { return e.value / length(e); };
  const int first = rod_.first_span(dresspack), end = rod_.first_span(dresspack + 1);
  const auto middle = [&](const Extreme& e) {
    return end == first + 1 ? -1 : rod_.spans()[e.place].first_arc + length(e) / 2;
  };
  const Extreme *tight = nullptr, *loose = nullptr, *most = nullptr;
  for (int k = first; k < end; ++k) {
    const Extreme &least = least_slack_[k], &greatest = most_slack_[k];
    if (!least.seen) continue;  // a free end has no slack
    if (!tight || share(least) < share(*tight)) tight = &least;
    if (!loose || share(least) > share(*loose)) loose = &least;
    if (!most || share(greatest) > share(*most)) most = &greatest;
  }
  if (tight) {
    const double shortest = least_slack_share * length(*tight), longest = most_slack_share * length(*loose);
    checks.push_back({WarningKind::slack, check_name::too_short, "m", tight->value, shortest, tight->value < shortest,
                      tight->time, middle(*tight)});
    checks.push_back({WarningKind::slack, check_name::too_long, "m", loose->value, longest, loose->value > longest,
                      loose->time, middle(*loose)});
    checks.push_back({{}, check_name::most_slack, "m", most->value, unlimited, false, most->time, middle(*most)});
  }
  if (const Extreme& travel = travel_[first]; travel.seen) {
    const double stroke = rod_.spans()[first].properties.slider->stroke;
    checks.push_back({WarningKind::slack, check_name::travel, "m", travel.value, stroke, travel.value >= stroke,
                      travel.time, rod_.spans()[first].first_arc});
  }
}

}  // namespace dresslife::sim
