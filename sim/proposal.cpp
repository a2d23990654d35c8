#include "sim/proposal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include "sim/clamp_path.h"
#include "sim/robot/robot.h"

namespace dresslife::sim {
namespace {

constexpr int places = 3;  // base clamp, tool clamp, ring
enum Place { base, tool, ring };

/// Wished of each limit beyond keeping it, in the order of ScreenedLimit; a run bends, twists and sways on
/// top of what geometry says.
constexpr std::array<double, screened_limits> wished{0.02, 0.02, 0.25, 0.25, 0.25};

struct Candidate {
  std::array<Vector3, places> position;   // in their links [m]
  std::array<Vector3, places> direction;  // in their links
  double slack = 0;                       // share of the length
  pipeline::Routing routing{};
  Screening screening{};
  double missing = 0;
};

class Chance {
 public:
  explicit Chance(std::uint64_t seed) : bits_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(bits_() >> 11) * 0x1p-53;
  }
  std::size_t below(std::size_t count) { return bits_() % count; }
  /// Sum of twelve: nearly normal, and the same on every machine.
  double normal() {
    double sum = -6;
    for (int k = 0; k < 12; ++k) sum += between(0, 1);
    return sum;
  }
  Vector3 normal_vector() { return {normal(), normal(), normal()}; }

 private:
  std::mt19937_64 bits_;
};

class Search {
 public:
  Search(const pipeline::Setup& setup, const ProposalSettings& settings)
      : setup_(setup), settings_(settings), screener_(setup), chance_(settings.seed) {
    const pipeline::Routing& given = setup.dresspacks.front().routing;
    if (!given.base_clamp || !given.tool_clamp)
      throw pipeline::InputError(setup.motion.where,
                                 "clamps are proposed on the links of a robot, and this motion has none",
                                 "name a robot and its program");
    setup_.dresspacks.resize(1);
    diameter_ = setup_.dresspacks.front().dresspack.diameter;
    links_ = {given.base_clamp->link, given.tool_clamp->link, settings.ring_link};
    for (int k = 0; k < used(); ++k) link_[k] = find_link(setup_.robot, links_[k], given.where);
    const std::unique_ptr<ClampPath> path = path_of(setup);
    start_ = path->at(0).links;
  }

  /// As many searches as proposals, each from its own beginnings, so that they end at different places.
  std::vector<Proposal> run() {
    std::vector<Candidate> found;
    for (int k = 0; k < settings_.count; ++k)
      found.push_back(best_of(std::max(10, settings_.tried / settings_.count)));
    std::stable_sort(found.begin(), found.end(),
                     [](const Candidate& a, const Candidate& b) { return a.missing < b.missing; });
    std::vector<Proposal> proposals;
    for (const Candidate& candidate : found)
      proposals.push_back({candidate.routing, candidate.screening, candidate.missing});
    return proposals;
  }

 private:
  Candidate best_of(int tried) {
    constexpr std::size_t parents = 6;
    std::vector<Candidate> kept;
    for (int k = 0; k < tried; ++k) {
      const double share = static_cast<double>(k) / tried;
      Candidate next = share < 0.4 ? random() : changed(kept[chance_.below(kept.size())], 2 * (1 - share));
      look_at(next, kept.size() < parents ? std::numeric_limits<double>::infinity() : kept.back().missing);
      const auto place =
          std::upper_bound(kept.begin(), kept.end(), next,
                           [](const Candidate& a, const Candidate& b) { return a.missing < b.missing; });
      kept.insert(place, std::move(next));
      if (kept.size() > parents) kept.pop_back();
    }
    return kept.front();
  }

  int used() const { return settings_.ring_link.empty() ? 2 : 3; }

  Frame frame(int place) const { return start_[link_[place]]; }

  Candidate random() {
    Candidate candidate;
    for (int k = 0; k < used(); ++k) candidate.position[k] = beside(link_[k]);
    const Vector3 way =
        frame(tool).point(candidate.position[tool]) - frame(base).point(candidate.position[base]);
    for (int k = 0; k < used(); ++k) {
      const Vector3 about = way.normalized() + 0.5 * chance_.normal_vector();
      candidate.direction[k] = (frame(k).orientation.conjugate() * about).normalized();
    }
    candidate.slack = chance_.between(0.03, 0.3);
    return candidate;
  }

  /// A place beside a shape of the link; of the last link beside the flange, where tools have their brackets.
  Vector3 beside(int link) {
    const pipeline::Link& of = setup_.robot.links[link];
    const bool flange = link + 1 == static_cast<int>(setup_.robot.links.size());
    Vector3 from = Vector3::Zero(), axis = Vector3::UnitZ();
    double radius = 0, along = 0;
    if (flange || of.capsules.empty()) {
      from = setup_.robot.flange_position;
      axis = from_roll_pitch_yaw(setup_.robot.flange_orientation) * Vector3::UnitZ();
      if (!flange) from.setZero();
      along = chance_.between(0.5, 4) * diameter_;
    } else {
      const pipeline::Capsule& capsule = of.capsules[chance_.below(of.capsules.size())];
      from = capsule.from + chance_.between(0, 1) * (capsule.to - capsule.from);
      if ((capsule.to - capsule.from).norm() > 1e-6) axis = (capsule.to - capsule.from).normalized();
      radius = capsule.radius;
    }
    Vector3 out = chance_.normal_vector();
    out -= out.dot(axis) * axis;
    const double off = radius + chance_.between(flange ? 1.5 : 0.8, 4) * diameter_;
    return from + along * axis + off * out.normalized();
  }

  Candidate changed(const Candidate& from, double size) {
    Candidate candidate = from;
    for (int k = 0; k < used(); ++k) {
      if (chance_.below(2)) candidate.position[k] += size * diameter_ * chance_.normal_vector();
      if (chance_.below(2))
        candidate.direction[k] = (candidate.direction[k] + 0.4 * size * chance_.normal_vector()).normalized();
    }
    candidate.slack = std::clamp(candidate.slack + 0.05 * size * chance_.normal(), 0.02, 0.32);
    return candidate;
  }

  /// to_beat: what is worse need not be known exactly.
  void look_at(Candidate& candidate, double to_beat) {
    pipeline::Routing& routing = candidate.routing;
    routing.where = setup_.dresspacks.front().routing.where;
    routing.base_clamp = clamp(candidate, base);
    routing.tool_clamp = clamp(candidate, tool);
    routing.mounting_pose = setup_.dresspacks.front().routing.mounting_pose;
    routing.rings.clear();
    if (used() > ring) {
      pipeline::GuideRing& guide = routing.rings.emplace_back();
      guide.link = links_[ring];
      guide.position = rounded(candidate.position[ring], 1e-3);
      guide.direction = rounded(candidate.direction[ring], 1e-2);
      guide.radius = 0.75 * diameter_;
      guide.width = diameter_;
      guide.friction = setup_.dresspacks.front().dresspack.friction;
    }
    routing.free_length = 1;
    setup_.dresspacks.front().routing = routing;
    const double way = screener_.longest_ways(setup_).front();
    routing.free_length = std::max(0.1, std::ceil(200 * way / (1 - candidate.slack)) / 200);  // [5 mm]
    setup_.dresspacks.front().routing.free_length = routing.free_length;
    candidate.screening = screener_.screen(setup_);
    candidate.missing = missing(candidate.screening);
    if (candidate.missing >= to_beat) return;  // its weight would only add to that
    Screening at_rest = candidate.screening;
    double& bend = at_rest.beyond[static_cast<std::size_t>(ScreenedLimit::bend)];
    bend = std::max(bend, screener_.bend_at_rest(setup_));
    candidate.missing = missing(at_rest);
  }

  static double missing(const Screening& screening) {
    double sum = 0;
    for (int k = 0; k < screened_limits; ++k) sum += std::max(0.0, screening.beyond[k] + wished[k]);
    return sum;
  }

  /// As people write places (mm) and directions.
  static Vector3 rounded(const Vector3& v, double step) { return (v / step).array().round() * step; }

  pipeline::Clamp clamp(const Candidate& candidate, int place) const {
    return {links_[place],
            rounded(candidate.position[place], 1e-3),
            rounded(candidate.direction[place], 1e-2),
            {},
            {}};
  }

  pipeline::Setup setup_;  // with the routing that is looked at
  const ProposalSettings& settings_;
  const Screener screener_;
  Chance chance_;
  double diameter_ = 0;
  std::array<std::string, places> links_;
  std::array<int, places> link_{};
  std::vector<Frame> start_;  // of the links at the motion's begin
};

}  // namespace

std::vector<Proposal> propose(const pipeline::Setup& setup, const ProposalSettings& settings) {
  return Search(setup, settings).run();
}

}  // namespace dresslife::sim
