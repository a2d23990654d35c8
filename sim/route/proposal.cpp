#include "sim/route/proposal.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <tuple>
#include <utility>

#include "pipeline/base/constants.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/threads.h"
#include "sim/contact/rubbing.h"
#include "sim/robot/robot.h"
#include "sim/route/short_run.h"
#include "sim/run/clamp_path.h"
#include "sim/run/cures.h"
#include "sim/run/quick_checks.h"

namespace dresslife::sim {
namespace {

constexpr int places = 3;  // base clamp, tool clamp, ring
enum Place { base, tool, ring };

/// Wished margin of each limit, in the order of ScreenedLimit, because a run bends, twists and sways more than
/// geometry predicts.
constexpr std::array<double, screened_limits> wished{0.02, 0.02, 0.25, 0.25, 0.25, 0, 0};

/// Wished margins in a run with few segments, which underestimates a bend.
constexpr std::array<double, screened_limits> wished_in_run{0.005, 0.005, 0.04, 0.04, 0, 0.005, 0};

/// Wished margins in the job's own run: its values are rounded when it is written.
constexpr std::array<double, screened_limits> wished_of_whole{0.001, 0.001, 0.01, 0.01, 0, 0.001, 0};

/// Margin to the least bend radius that a search prefers among routings that keep all limits. Another zone at the targets ($APO.CPTP)
/// changed the least radius by 11 % in a program of a KR 16.
constexpr double comfortable_bend = 0.15;

constexpr double ring_radius = 0.75;  // of a guide ring [diameters]
constexpr double never = std::numeric_limits<double>::infinity();
constexpr double farthest =
    4;  // largest distance of a clamp from the link that carries it, if brackets reach so far [diameters]
constexpr int drawn_places = 2000;  // number of places beside a link until one has a bracket: one second
constexpr double least_slack = 0.02, most_slack = 0.32;  // share of the length
constexpr double most_work_of_further =
    3e5;  // of each further short run on the average, in the unit of World::work: 0.15 s
constexpr double most_work_near =
    5e6;  // of short runs near a given routing, in the unit of World::work: 2.4 s of processor time
constexpr int side_by_side = 4;  // short runs at the same time, independent of the number of threads

std::array<Vector3, places> zeros() {
  std::array<Vector3, places> all;
  all.fill(Vector3::Zero());
  return all;
}

struct Candidate {
  // in the frames of their links, at places for brackets, in whole millimetres [m]; 0 without a ring
  std::array<Vector3, places> position = zeros(), direction = zeros();
  double slack = 0;  // share of the length
  pipeline::Routing routing{};
  Screening screening{};
  double missing = 0;             // violation by geometry
  RoutingRun short_run{};         // valid if it had a short run
  double missing_in_run = never;  // violation in the short run
  double missing_softer = 0;      // violation with the softer hose; 0 also if the job's own hose violates a limit
  bool whole = false;             // run with the job's own segments and repeats
};

class Chance {
 public:
  explicit Chance(std::uint64_t seed) : bits_(seed) {}
  double between(double low, double high) { return low + (high - low) * static_cast<double>(bits_() >> 11) * 0x1p-53; }
  std::size_t below(std::size_t count) { return bits_() % count; }
  /// Returns a sum of twelve numbers: nearly normal, and equal on every machine.
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
      : setup_(setup), settings_(settings), screener_(setup, true), chance_(settings.seed) {
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
    unchanged_.where = given.where;
    unchanged_.mounting_pose = given.mounting_pose;
    unchanged_.longest_bracket = given.longest_bracket;
    unchanged_.side = given.side;
  }

  /// Runs one search per proposal, each with its own first candidates, so that they end at different places.
  std::vector<Proposal> run() {
    for (int k = 0; k < used(); ++k) beside(k);  // throws for a link without such a place
    if (settings_.short_runs > 0) return proposals_of(search_by_short_runs());
    std::vector<Candidate> found;
    for (int k = 0; k < settings_.count; ++k) {
      report_progress(static_cast<double>(k) / settings_.count,
                      fmt::format("geometry, search {} of {}", k + 1, settings_.count));
      found.push_back(best_of(std::max(10, settings_.tried / settings_.count)));
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Candidate& a, const Candidate& b) { return a.missing < b.missing; });
    return proposals_of(found);
  }

  /// Changes the given routing a little until one keeps all limits.
  std::optional<pipeline::Routing> near() {
    constexpr std::size_t parents = 5;
    constexpr double first_size = 0.5;
    const pipeline::Routing given = setup_.dresspacks.front().routing;
    unchanged_ = given;
    Candidate own;
    own.position = {given.base_clamp->position, given.tool_clamp->position};
    given_places_ = own.position;
    own.direction = {given.base_clamp->direction.normalized(), given.tool_clamp->direction.normalized()};
    const double way = screener_.longest_ways(setup_).front();
    own.slack = std::clamp(1 - way / given.free_length, least_slack, most_slack);
    evaluate(own, never);
    std::vector<Candidate> kept;
    double size = first_size, work = 0;
    const auto run_all = [&](std::vector<Candidate>& all) {
      make_short_runs(all, routing_run_segments, routing_run_repeats, wished_in_run,
                      useless_bend(kept, parents, false));
      for (const Candidate& one : all) work += one.short_run.work;
    };
    std::vector<Candidate> first{own};
    run_all(first);
    keep(kept, std::move(first.front()), parents);
    for (int left = settings_.short_runs; left > 0 && work < most_work_near; left -= side_by_side) {
      std::vector<Candidate> next;
      while (static_cast<int>(next.size()) < side_by_side) next.push_back(child(kept, size));
      run_all(next);
      const Badness before = badness(kept.front());
      for (Candidate& candidate : next) keep(kept, std::move(candidate), parents);
      size = next_size(size, badness(kept.front()) < before);
      while (look_at_first_whole(kept)) work += kept.front().short_run.work;
      if (is_found(kept.front())) return kept.front().routing;
    }
    return {};
  }

 private:
  using Badness = std::tuple<double, double, double, double>;

  static std::vector<Proposal> proposals_of(const std::vector<Candidate>& found) {
    return pipeline::mapped(found, [](const Candidate& of) {
      return Proposal{of.routing, of.screening, of.missing, of.short_run};
    });
  }

  /// Makes short runs of the best candidates by geometry. Then changes the best ones a little, many times; the size of the
  /// changes adapts to their success. Of a few changes the best by geometry gets a short run; its wished radius in the geometry is
  /// increased by the radius that its parent lacked in its run.
  std::vector<Candidate> search_by_short_runs() {
    constexpr int begun = 12;         // searches by geometry only
    constexpr double hopeless = 0.5;  // violation of the best of the first third at which the search ends
    const std::size_t parents = std::max<std::size_t>(5, settings_.count);  // number of parents that are kept
    constexpr double geometry_share = 0.3;                                  // share of the time, approximately
    const int each = std::max(10, settings_.tried / begun);
    std::vector<Candidate> beginnings, kept;
    for (int k = 0; k < begun; ++k) {
      report_progress(geometry_share * k / begun, fmt::format("geometry, search {} of {}", k + 1, begun));
      beginnings.push_back(best_of(each));
    }
    if (std::all_of(beginnings.begin(), beginnings.end(), [](const Candidate& of) { return of.screening.rejected(); }))
      return excluded(std::move(beginnings), begun * each);
    double size = 1;
    int left = settings_.short_runs;
    // With 1 the proposals for two robots exceeded the bend limit with the softer hose; with 100 further runs, 6 times those of
    // `new`, they kept it. The same number applies while the best candidate rubs.
    constexpr int times_for_more = 6;
    int further = 0;
    std::vector<Candidate> found;  // keep all limits as the job; the further ones are run as the job at the end
    double further_work = 0;
    const auto goes_on = [&] {
      if (found.empty()) return left > 0;
      const bool softer_breaks = settings_.softer != 1 && !(kept.front().whole && kept.front().missing_softer == 0);
      const bool go_on = softer_breaks || rubs(kept.front());
      const int most = settings_.further * (go_on ? times_for_more : 1);
      return (left > 0 || go_on) && further < most && further_work < most * most_work_of_further;
    };
    while (goes_on()) {
      const int done = settings_.short_runs - left;
      report_progress(
          geometry_share + (1 - geometry_share) * std::min(1.0, static_cast<double>(done) / settings_.short_runs),
          fmt::format("short run {} of at most {}{}", done + 1,
                      settings_.short_runs + (found.empty() ? 0 : settings_.further * times_for_more),
                      kept.empty() ? "" : nearest_words(kept.front())));
      std::vector<Candidate> next;
      const bool begins = !beginnings.empty();
      while (static_cast<int>(next.size()) < (left > 0 ? std::min(side_by_side, left) : side_by_side)) {
        if (begins && beginnings.empty()) break;
        next.push_back(begins ? beginnings.back() : child(kept, size));
        if (begins) beginnings.pop_back();
      }
      left -= static_cast<int>(next.size());
      if (!found.empty()) further += static_cast<int>(next.size());
      make_short_runs(next, routing_run_segments, routing_run_repeats, wished_in_run,
                      useless_bend(kept, parents, !found.empty()));
      for (const Candidate& one : next) further_work += found.empty() ? 0 : one.short_run.work;
      const Badness before = kept.empty() ? Badness(never, never, never, never) : badness(kept.front());
      for (Candidate& candidate : next) keep(kept, std::move(candidate), parents);
      const bool better = badness(kept.front()) < before;
      if (!begins) size = next_size(size, better);
      while (found.empty() && look_at_first_whole(kept)) --left;
      if (!found.empty() && settings_.softer != 1 && kept.front().missing_softer == 0) look_at_first_whole(kept);
      if (found.empty() && std::count_if(kept.begin(), kept.end(), is_found) >= settings_.count)
        std::copy_if(kept.begin(), kept.end(), std::back_inserter(found), is_found);
      if (3 * left < 2 * settings_.short_runs && kept.front().missing_in_run > hopeless) break;
    }
    if (!found.empty()) {
      for (Candidate& candidate : found)
        if (std::ranges::none_of(kept, [&](const Candidate& one) { return has_same_routing(one, candidate); }))
          keep(kept, std::move(candidate), kept.size() + 1);
      while (look_at_first_whole(kept)) continue;
    }
    if (kept.size() > static_cast<std::size_t>(settings_.count)) kept.resize(settings_.count);
    return kept;
  }

  static double next_size(double size, bool better) { return std::clamp(size * (better ? 1.3 : 0.9), 0.05, 2.0); }

  /// Returns the candidates with the smallest violation if none can run, with the reason. checked: number of routings.
  std::vector<Candidate> excluded(std::vector<Candidate> all, int checked) const {
    std::stable_sort(all.begin(), all.end(),
                     [](const Candidate& a, const Candidate& b) { return a.missing < b.missing; });
    all.resize(std::min(all.size(), static_cast<std::size_t>(settings_.count)));
    for (Candidate& candidate : all) {
      std::string limits;
      for (std::size_t k = 0; k < screened_limits; ++k)
        if (const double g = candidate.screening.beyond[k]; g > surely_beyond[k])
          limits += fmt::format("{}{} by {:.2f} at {:.3f} s", limits.empty() ? "" : ", ",
                                word(static_cast<ScreenedLimit>(k)), g, candidate.screening.time[k]);
      candidate.short_run.refusal =
          fmt::format("geometry excludes all {} routings that were checked; the nearest is {}", checked, limits);
    }
    return all;
  }

  static std::string nearest_words(const Candidate& nearest) {
    if (nearest.missing_in_run == 0) return ", one keeps all limits";
    return nearest.short_run.refusal.empty()
               ? fmt::format(", nearest misses its limits by {:.2f}", nearest.missing_in_run)
               : ", none runs";
  }

  void report_progress(double share, const std::string& words) const {
    if (settings_.progress) settings_.progress(share, words);
  }

  /// Returns the order of a candidate after its short run: limits first, then those with the softer hose, then the margin of its bend,
  /// then its swing and rubbing.
  static Badness badness(const Candidate& of) {
    const double bend = of.short_run.seen.beyond[static_cast<std::size_t>(ScreenedLimit::bend)];
    // ESTIMATE: the life of wires decreases with about the fifth power of the swing. The hours until the hose is worn through decrease
    // with the first power of the rubbing.
    constexpr double power = 5;
    const double wear = std::pow(1 + of.short_run.rubbing / least_rubbing_power, 1 / power);
    return {of.missing_in_run, of.missing_softer, std::max(0.0, bend + comfortable_bend), of.short_run.swing * wear};
  }

  static bool rubs(const Candidate& of) { return of.short_run.rubbing > least_rubbing_power; }

  static bool is_found(const Candidate& candidate) { return candidate.whole && candidate.missing_in_run == 0; }

  static bool has_same_routing(const Candidate& a, const Candidate& b) {
    return a.position == b.position && a.direction == b.direction && a.slack == b.slack;
  }

  static void keep(std::vector<Candidate>& kept, Candidate&& next, std::size_t most) {
    const auto place = std::upper_bound(kept.begin(), kept.end(), next,
                                        [](const Candidate& a, const Candidate& b) { return badness(a) < badness(b); });
    kept.insert(place, std::move(next));
    if (kept.size() > most) kept.pop_back();
  }

  /// Runs the first candidate that keeps all wishes and was not yet run as the job. Returns whether such a candidate
  /// existed.
  bool look_at_first_whole(std::vector<Candidate>& kept) const {
    const auto wanted = kept.begin() + std::min<std::ptrdiff_t>(settings_.count, std::ssize(kept));
    const auto first =
        std::find_if(kept.begin(), wanted, [](const Candidate& of) { return !of.whole && of.missing_in_run == 0; });
    if (first == wanted) return false;
    std::vector<Candidate> one{*first};
    kept.erase(first);
    constexpr int as_the_job = std::numeric_limits<int>::max();
    make_short_runs(one, as_the_job, as_the_job, wished_of_whole);
    one.front().whole = true;
    if (one.front().missing_in_run == 0) one.front().missing_in_run = missing_in_checks(one.front());
    keep(kept, std::move(one.front()), kept.size() + 1);
    return true;
  }

  /// Returns the violations that the checks before a run would report.
  double missing_in_checks(const Candidate& candidate) const {
    constexpr double refused = 3;  // larger than the violation of a candidate that runs
    pipeline::Setup setup = setup_;
    setup.dresspacks.front().routing = candidate.routing;
    const QuickFindings found = quick_findings(setup);
    double sum = found.run.refusal.empty() ? 0 : refused;
    for (const Check& check : found.checks)
      if (check.warning) sum += std::abs(std::log(std::abs(check.value) / check.limit));
    return sum;
  }

  /// Returns the bend above which a candidate is not kept.
  static double useless_bend(const std::vector<Candidate>& kept, std::size_t most, bool only_limits) {
    constexpr auto bend = static_cast<std::size_t>(ScreenedLimit::bend);
    const double worst = kept.size() < most ? never : kept.back().missing_in_run;
    return (only_limits ? 0 : worst) - wished_in_run[bend];
  }

  /// useless_beyond: as in short_run_of().
  void make_short_runs(std::vector<Candidate>& candidates, int segments, int repeats,
                       const std::array<double, screened_limits>& wishes, double useless_beyond = never) const {
    const std::size_t threads = std::min(pipeline::thread_count(), candidates.size());
    pipeline::in_parallel(threads, [&](std::size_t part) {
      for (std::size_t k = part; k < candidates.size(); k += threads) {
        pipeline::Setup setup = setup_;
        Candidate& candidate = candidates[k];
        setup.dresspacks.front().routing = candidate.routing;
        candidate.short_run = short_run_of(setup, segments, repeats, false, useless_beyond);
        constexpr double refused = 3;  // larger than the violation of a candidate that runs
        candidate.missing_in_run = candidate.short_run.refusal.empty() ? missing(candidate.short_run.seen, wishes)
                                                                       : refused + candidate.missing;
        candidate.missing_softer = 0;
        if (candidate.missing_in_run > 0 || settings_.softer == 1) continue;
        setup.simulation.stiffness_factor *= settings_.softer;
        const RoutingRun softer = short_run_of(std::move(setup), segments, repeats, false);
        candidate.missing_softer = softer.refusal.empty() ? missing(softer.seen, wishes) : refused;
        candidate.short_run.work += softer.work;
      }
    });
  }

  Candidate child(const std::vector<Candidate>& kept, double size) {
    constexpr int changes = 3;
    const Candidate& parent = kept[chance_.below(std::min<std::size_t>(3, kept.size()))];
    const auto bend = static_cast<std::size_t>(ScreenedLimit::bend);
    const double lacked = parent.short_run.refusal.empty()
                              ? std::max(0.0, parent.short_run.seen.beyond[bend]) + parent.missing_softer
                              : 0;
    Candidate best;
    best.missing = never;
    for (int k = 0; k < changes || !std::isfinite(best.missing); ++k) {
      Candidate next = changed(parent, size);
      std::array<double, screened_limits> wishes = wished;
      wishes[bend] += lacked;
      evaluate(next, best.missing, wishes);
      if (next.missing < best.missing) best = std::move(next);
    }
    best.whole = false;
    return best;
  }

  Candidate best_of(int tried) {
    constexpr std::size_t parents = 6;
    std::vector<Candidate> kept;
    for (int k = 0; k < tried; ++k) {
      const double share = static_cast<double>(k) / tried;
      Candidate next = share < 0.4 ? random() : changed(kept[chance_.below(kept.size())], 2 * (1 - share));
      evaluate(next, kept.size() < parents ? std::numeric_limits<double>::infinity() : kept.back().missing);
      const auto place = std::upper_bound(kept.begin(), kept.end(), next,
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
    for (int k = 0; k < used(); ++k) candidate.position[k] = beside(k);
    const Vector3 way = frame(tool).point(candidate.position[tool]) - frame(base).point(candidate.position[base]);
    for (int k = 0; k < used(); ++k) {
      const Vector3 about = way.normalized() + 0.5 * chance_.normal_vector();
      candidate.direction[k] = (frame(k).orientation.conjugate() * about).normalized();
    }
    candidate.slack = chance_.between(0.03, 0.3);
    return candidate;
  }

  /// Returns the shapes near which a clamp is placed: the capsules of the link; for the last link the flange, where brackets of
  /// tools are, as a line of a bracket's length.
  std::vector<pipeline::Capsule> shapes_of(int link) const {
    const pipeline::Link& of = setup_.robot.links[link];
    const bool flange = is_flange(link);
    if (!flange && !of.capsules.empty()) return of.capsules;
    const Vector3 from = flange ? setup_.robot.flange_position : Vector3::Zero();
    const Vector3 axis = from_roll_pitch_yaw(setup_.robot.flange_orientation) * Vector3::UnitZ();
    return {{from + 0.5 * diameter_ * axis, from + farthest * diameter_ * axis, 0}};
  }

  bool is_flange(int link) const { return link + 1 == static_cast<int>(setup_.robot.links.size()); }

  /// Samples places beside a link until a bracket can carry one.
  Vector3 beside(int place) {
    BracketFit nearest;
    double least = never;
    for (int k = 0; k < drawn_places; ++k) {
      const Vector3 position = rounded(drawn_beside(link_[place]), millimetre);
      const BracketFit fit = bracket(place, position);
      if (fit.unbuildable > 0) continue;
      const double beyond = fit.beyond(longest_bracket(), diameter_);
      if (beyond <= 0) return position;
      if (beyond < least) least = beyond, nearest = fit;
    }
    refuse_link(place, nearest);
  }

  [[noreturn]] void refuse_link(int place, const BracketFit& nearest) const {
    const auto& links = setup_.robot.links;
    // A search samples many places, so it needs a longer bracket than that of the nearest place.
    constexpr double room_to_search = 1.25;
    std::string why = fmt::format("needs a bracket of {:.0f} mm", 1e3 * nearest.length), longer;
    if (nearest.length > longest_bracket())
      longer = fmt::format("routing.longest_bracket_mm (--bracket): {:.0f} if it can be built, ",
                           std::ceil(1e3 * room_to_search * nearest.length));
    if (nearest.clearance < 0)
      why = fmt::format("is {:.0f} mm inside {} at {:.3f} s of the program", -1e3 * nearest.clearance,
                        nearest.neighbour < 0 ? "the cell" : links[nearest.neighbour].name,
                        screener_.time_of(nearest.moment));
    throw pipeline::InputError(
        setup_.dresspacks.front().routing.where,
        fmt::format("no place within {:.0f} mm of the surface of {} stays clear of the other links and the cell: the "
                    "nearest of {} places {}",
                    1e3 * longest_bracket(), links_[place], drawn_places, why),
        longer + "another link (--from, --to, --ring), or a program that keeps away from it");
  }

  double longest_bracket() const { return longest_bracket_of(setup_.dresspacks.front().routing); }

  Vector3 drawn_beside(int link) {
    constexpr int most_steps_outward = 40;  // 20 diameters at least: farther places need too long a bracket
    const std::vector<pipeline::Capsule> shapes = shapes_of(link);
    const pipeline::Capsule& capsule = shapes[chance_.below(shapes.size())];
    const Vector3 along = capsule.to - capsule.from;
    const Vector3 axis = along.norm() > 1e-6 ? Vector3(along.normalized()) : Vector3(Vector3::UnitZ());
    Vector3 out = chance_.normal_vector();
    out -= out.dot(axis) * axis;
    double off = capsule.radius + chance_.between(is_flange(link) ? 1.5 : 0.8, farthest) * diameter_;
    if (is_flange(link)) off = std::max(off, adapter_radius(diameter_) + diameter_ / 2);
    const Vector3 beside = capsule.from + chance_.between(0, 1) * along;
    const auto place = [&] { return Vector3(beside + off * out.normalized()); };
    // The line from the flange lies inside the shapes of the last link and its tool: outward until the dresspack is outside.
    for (int k = 0; is_flange(link) && k < most_steps_outward; ++k) {
      const double inside = screener_.bracket({link, place(), diameter_ / 2}).inside;
      if (inside <= 0) break;
      off += std::max(inside, diameter_ / 2);
    }
    return place();
  }

  BracketFit bracket(int place, const Vector3& position) const {
    return screener_.bracket({link_[place], position, (place == ring ? ring_radius : 0.5) * diameter_});
  }

  Candidate changed(const Candidate& from, double size) {
    Candidate candidate = from;
    for (int k = 0; k < used(); ++k) {
      if (chance_.below(2)) {
        const Vector3 place = rounded(candidate.position[k] + size * diameter_ * chance_.normal_vector(), millimetre);
        if (is_same_place(k, place) && bracket(k, place).beyond(longest_bracket(), diameter_) <= 0)
          candidate.position[k] = place;
      }
      if (chance_.below(2))
        candidate.direction[k] = (candidate.direction[k] + 0.4 * size * chance_.normal_vector()).normalized();
    }
    candidate.slack = std::clamp(candidate.slack + 0.05 * size * chance_.normal(), least_slack, most_slack);
    return candidate;
  }

  bool is_same_place(int place, const Vector3& position) const {
    return !given_places_ || (position - (*given_places_)[place]).norm() <= same_place;
  }

  /// to_beat: a larger violation need not be computed exactly.
  void evaluate(Candidate& candidate, double to_beat, const std::array<double, screened_limits>& wishes = wished) {
    pipeline::Routing& routing = candidate.routing;
    routing = unchanged_;
    routing.base_clamp = clamp(candidate, base, unchanged_.base_clamp);
    routing.tool_clamp = clamp(candidate, tool, unchanged_.tool_clamp);
    if (used() > ring) {
      pipeline::GuideRing& guide = routing.rings.emplace_back();
      guide.link = links_[ring];
      guide.position = candidate.position[ring];
      guide.direction = rounded(candidate.direction[ring], 1e-2);
      guide.radius = ring_radius * diameter_;
      guide.width = diameter_;
      guide.friction = setup_.dresspacks.front().dresspack.friction;
    }
    routing.free_length = 1;
    setup_.dresspacks.front().routing = routing;
    const double way = screener_.longest_ways(setup_).front();
    routing.free_length = std::max(0.1, std::ceil(200 * way / (1 - candidate.slack)) / 200);  // [5 mm]
    setup_.dresspacks.front().routing.free_length = routing.free_length;
    candidate.screening = screener_.screen(setup_);
    candidate.missing = missing(candidate.screening, wishes);
    if (candidate.missing >= to_beat) return;  // the check with weight could only increase the violation
    Screening at_rest = candidate.screening;
    double& bend = at_rest.beyond[static_cast<std::size_t>(ScreenedLimit::bend)];
    bend = std::max(bend, screener_.bend_at_rest(setup_));
    candidate.missing = missing(at_rest, wishes);
  }

  static double missing(const Screening& screening, const std::array<double, screened_limits>& wishes) {
    double sum = 0;
    for (int k = 0; k < screened_limits; ++k) sum += std::max(0.0, screening.beyond[k] + wishes[k]);
    return sum;
  }

  /// Returns a place or direction rounded as in a written job.
  static Vector3 rounded(const Vector3& v, double step) { return (v / step).array().round() * step; }

  pipeline::Clamp clamp(const Candidate& candidate, int place, const std::optional<pipeline::Clamp>& given) const {
    pipeline::Clamp made = given.value_or(pipeline::Clamp{});
    made.link = links_[place];
    made.position = candidate.position[place];
    made.direction = rounded(candidate.direction[place], 1e-2);
    if (given && rounded(given->direction.normalized(), 1e-2) == made.direction) made.direction = given->direction;
    return made;
  }

  pipeline::Setup setup_;        // with the routing that is evaluated
  pipeline::Routing unchanged_;  // what every candidate has
  std::optional<std::array<Vector3, places>>
      given_places_;  // places from which clamps move by same_place at most; absent: no limit
  const ProposalSettings& settings_;
  const Screener screener_;
  Chance chance_;
  double diameter_ = 0;
  std::array<std::string, places> links_;
  std::array<int, places> link_{};
  std::vector<Frame> start_;  // link frames at the begin of the motion
};

}  // namespace

std::vector<Proposal> propose(const pipeline::Setup& setup, const ProposalSettings& settings) {
  return Search(setup, settings).run();
}

std::optional<pipeline::Routing> routing_near(const pipeline::Setup& setup) {
  constexpr int short_runs = 60;
  ProposalSettings settings;
  settings.short_runs = short_runs;
  return Search(setup, settings).near();
}

}  // namespace dresslife::sim
