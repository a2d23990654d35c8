#include "pipeline/advise/route/routing_search.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/advise/improve/rehearsed.h"
#include "pipeline/advise/improve/screened.h"
#include "pipeline/advise/route/scaled.h"
#include "pipeline/advise/search/surrogate_search.h"
#include "pipeline/settings/units.h"

namespace dresslife::pipeline {
namespace {

using Eigen::VectorXd;

/// Of a routing box: five for each clamp and ring, and the slack.
constexpr Eigen::Index variables_per_place = 5;

/// Wished of each limit of geometry beyond keeping it: too short, too long, bend, twist, overlap.
constexpr std::array wished{0.02, 0.02, 0.25, 0.25, 0.25};

constexpr double endless_hours = 1e9;  // beyond, one routing is as good as the other

class RoutingSearch {
 public:
  RoutingSearch(const Draft& draft, double factor, const RoutingRequest& request,
                const std::filesystem::path& folder)
      : job_(draft.job), request_(request), folder_(folder) {
    if (factor != 1)
      job_.dresspacks.front().dresspack = scaled(std::move(job_.dresspacks.front().dresspack), factor);
    if (draft.exercise) options_.push_back("--exercise");
    if (!request.ring_link.empty()) options_.insert(options_.end(), {"--ring", request.ring_link});
    name_ = draft.name;
  }

  RoutingFound run(const RunRouting& run) {
    const std::unique_ptr<SurrogateSearch> search = made_search();
    for (int trial = 0; trial < request_.trials && !found_.feasible(); ++trial) {
      const VectorXd place = search->ask(1).front();
      const auto known = std::find_if(short_runs_.begin(), short_runs_.end(),
                                      [&](const ShortRun& of) { return of.place == place; });
      if (known == short_runs_.end() || known->violation > 0) break;
      found_.add({known->routing, run(known->routing, found_.motion, static_cast<std::size_t>(trial))});
      search->tell({look_of(found_.trials.back().outcome, place)});
    }
    return std::move(found_);
  }

 private:
  struct ShortRun {
    VectorXd place;
    std::string routing;
    double violation;
  };

  std::unique_ptr<SurrogateSearch> made_search() {
    const Eigen::Index variables = (request_.ring_link.empty() ? 2 : 3) * variables_per_place + 1;
    SurrogateSettings settings;
    settings.seed = request_.seed;
    settings.rehearsals = request_.rehearsals;
    settings.screened = request_.tried;
    return std::make_unique<SurrogateSearch>(
        variables, settings, [this](const std::vector<VectorXd>& places) { return missed(places); },
        [this](const std::vector<VectorXd>& places) { return rehearsed(places); });
  }

  ScreenedList screened(const std::vector<VectorXd>& places, ScreenedBy by) {
    std::string list;
    for (const VectorXd& place : places) {
      list += "- {routing_at: [";
      for (Eigen::Index k = 0; k < place.size(); ++k) list += (k ? ", " : "") + shortest_text(place[k]);
      list += "]}\n";
    }
    const ScreenedList told = screening_of(job_, list, by, folder_, options_);
    if (told.candidates.size() != places.size())
      throw InputError({name_}, "no routing can be proposed (see above)", "mend what is told there");
    found_.motion = told.motion;
    return told;
  }

  /// (place) sum of what geometry misses of the wished margins.
  std::vector<double> missed(const std::vector<VectorXd>& places) {
    constexpr double no_job = 10;  // beyond every geometry that is one
    std::vector<double> sums;
    for (const ScreenedCandidate& of : screened(places, ScreenedBy::geometry).candidates) {
      double sum = of.refusal.empty() ? 0 : no_job;
      for (std::size_t k = 0; k < wished.size(); ++k) sum += std::max(0.0, of.beyond[k] + wished[k]);
      sums.push_back(sum);
    }
    return sums;
  }

  std::vector<Look> rehearsed(const std::vector<VectorXd>& places) {
    const ScreenedList list = screened(places, ScreenedBy::short_runs);
    std::vector<Look> looks;
    for (std::size_t k = 0; k < places.size(); ++k) {
      const ScreenedCandidate& candidate = list.candidates[k];
      looks.push_back({places[k], true, {}, {}});
      add_rehearsal(looks.back(), list, candidate);
      note(candidate, list, places[k]);
    }
    return looks;
  }

  void note(const ScreenedCandidate& candidate, const ScreenedList& list, const VectorXd& place) {
    if (!candidate.refusal.empty()) {
      if (found_.nearest.empty()) found_.obstacle = candidate.refusal;
      return;
    }
    short_runs_.push_back({place, candidate.changes, candidate.violation()});
    if (candidate.violation() >= found_.violation) return;
    found_.violation = candidate.violation();
    found_.nearest = candidate.changes;
    found_.obstacle = list.words(candidate);
  }

  static Look look_of(const Outcome& outcome, const VectorXd& place) {
    Look look{place, outcome.failure.empty(), {}, outcome.beyond};
    if (look.ran) look.aims.push_back(-std::log(std::clamp(outcome.hours, 1 / endless_hours, endless_hours)));
    return look;
  }

  Job job_;
  const RoutingRequest& request_;
  const std::filesystem::path& folder_;
  std::string name_;
  std::vector<std::string> options_;  // of dresslife-sim
  std::vector<ShortRun> short_runs_;  // that ran
  RoutingFound found_;
};

}  // namespace

bool better(const RoutingTrial& a, const RoutingTrial& b) {
  if (a.outcome.violation() != b.outcome.violation()) return a.outcome.violation() < b.outcome.violation();
  return a.outcome.hours > b.outcome.hours;
}

void RoutingFound::add(RoutingTrial trial) {
  trials.push_back(std::move(trial));
  if (!trials.back().outcome.failure.empty()) return;
  if (!best || better(trials.back(), trials[*best])) best = trials.size() - 1;
}

RoutingFound find_routing(const Draft& draft, double factor, const RoutingRequest& request,
                          const std::filesystem::path& folder, const RunRouting& run) {
  return RoutingSearch(draft, factor, request, folder).run(run);
}

}  // namespace dresslife::pipeline
