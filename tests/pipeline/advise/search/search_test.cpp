// Searches on functions with known minima.
#include <algorithm>
#include <cmath>

#include "pipeline/advise/search/minimise.h"
#include "pipeline/advise/search/surrogate_search.h"
#include "pipeline/base/constants.h"
#include "pipeline/base/random.h"
#include "tests/catch.h"

using namespace dresslife;
using namespace dresslife::pipeline;
using Eigen::VectorXd;

namespace {

struct Problem {
  const char* name;
  VectorXd low, high;
  double least;  ///< value at the best place
  std::function<double(const VectorXd&)> aim;
  std::function<std::vector<double>(const VectorXd&)> beyond;

  VectorXd at(const VectorXd& place) const { return low + place.cwiseProduct(high - low); }
  Candidate candidate(const VectorXd& place) const {
    const VectorXd x = at(place);
    return {place, true, {aim(x)}, beyond(x)};
  }
};

VectorXd vector_of(std::initializer_list<double> values) {
  VectorXd made(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), made.data());
  return made;
}

/// The example of NLopt's tutorial: its COBYLA needs 31 evaluations to reach 0.5443.
Problem tutorial() {
  return {"NLopt's tutorial",
          vector_of({-2, 0}),
          vector_of({2, 3}),
          std::sqrt(8.0 / 27),
          [](const VectorXd& x) { return std::sqrt(x[1]); },
          [](const VectorXd& x) {
            return std::vector<double>{std::pow(2 * x[0], 3) - x[1], std::pow(1 - x[0], 3) - x[1]};
          }};
}

/// g24, g08 and g04 of the Congress on Evolutionary Computation 2006 (J. Liang et al., Problem definitions for
/// constrained real-parameter optimization, 2006), which are also examples of pagmo.
Problem g24() {
  return {"g24",
          vector_of({0, 0}),
          vector_of({3, 4}),
          -5.50801327159536,
          [](const VectorXd& x) { return -x[0] - x[1]; },
          [](const VectorXd& x) {
            const double a = x[0], a2 = a * a, a3 = a2 * a, a4 = a3 * a;
            return std::vector<double>{-2 * a4 + 8 * a3 - 8 * a2 + x[1] - 2,
                                       -4 * a4 + 32 * a3 - 88 * a2 + 96 * a + x[1] - 36};
          }};
}
Problem g08() {
  return {"g08",
          vector_of({0.1, 0.1}),
          vector_of({10, 10}),
          -0.0958250414180359,
          [](const VectorXd& x) {
            return -std::pow(std::sin(2 * pi * x[0]), 3) * std::sin(2 * pi * x[1]) /
                   (std::pow(x[0], 3) * (x[0] + x[1]));
          },
          [](const VectorXd& x) {
            return std::vector<double>{x[0] * x[0] - x[1] + 1, 1 - x[0] + (x[1] - 4) * (x[1] - 4)};
          }};
}
Problem g04() {
  return {"g04",
          vector_of({78, 33, 27, 27, 27}),
          vector_of({102, 45, 45, 45, 45}),
          -30665.538671783317,
          [](const VectorXd& x) {
            return 5.3578547 * x[2] * x[2] + 0.8356891 * x[0] * x[4] + 37.293239 * x[0] - 40792.141;
          },
          [](const VectorXd& x) {
            const double u = 85.334407 + 0.0056858 * x[1] * x[4] + 0.0006262 * x[0] * x[3] - 0.0022053 * x[2] * x[4];
            const double v = 80.51249 + 0.0071317 * x[1] * x[4] + 0.0029955 * x[0] * x[1] + 0.0021813 * x[2] * x[2];
            const double w = 9.300961 + 0.0047026 * x[2] * x[4] + 0.0012547 * x[0] * x[2] + 0.0019085 * x[2] * x[3];
            return std::vector<double>{u - 92, -u, v - 110, 90 - v, w - 25, 20 - w};
          }};
}

/// Two springs with six variables: neither may be slack or overstretched, both must fit together, and more bending gives a
/// shorter life. A thousandth of the box keeps all limits.
Problem springs() {
  const auto bow = [](const VectorXd& x, Eigen::Index k) {
    return x[k] + x[k + 1] * x[k + 1] - 1.2 * std::sin(2 * x[k + 2]);
  };
  return {"springs",
          VectorXd::Zero(6),
          VectorXd::Ones(6),
          0,
          [=](const VectorXd& x) { return x.squaredNorm() + bow(x, 0); },
          [=](const VectorXd& x) {
            return std::vector<double>{std::abs(bow(x, 0) + 0.55) - 0.1, std::log((bow(x, 3) + 2) / 1.25),
                                       std::abs(x[0] - x[3] + 0.3 * x[1]) - 0.2, 0.9 - x[2] - 0.3 * x[5]};
          }};
}

/// Its low-fidelity evaluation: the first three limits, with a small error.
Candidate short_run_of(const Problem& problem, const VectorXd& place) {
  std::vector<double> beyond = problem.beyond(problem.at(place));
  for (std::size_t k = 0; k < 3; ++k) beyond[k] += 0.03 * std::cos(5 * place[static_cast<Eigen::Index>(k)]) - 0.05;
  beyond[3] = std::nan("");
  return {place, true, {}, beyond};
}

const ShortRuns short_runs_of_springs = [](const std::vector<VectorXd>& places) {
  std::vector<Candidate> told;
  for (const VectorXd& place : places) told.push_back(short_run_of(springs(), place));
  return told;
};

const Screen nothing_rejected = [](const std::vector<VectorXd>& places) {
  return std::vector<double>(places.size(), 0.0);
};

/// Uniform random candidates: the baseline for other searches.
class RandomSearch : public Search {
 public:
  /// screen: of some draws for each candidate, the one with the smallest violation is returned.
  RandomSearch(Eigen::Index variables, std::uint64_t seed, Screen screen)
      : variables_(variables), numbers_(seed), screen_(std::move(screen)) {}
  std::vector<VectorXd> ask(int count) override {
    std::vector<VectorXd> places;
    while (places.size() < static_cast<std::size_t>(count)) {
      std::vector<VectorXd> drawn(16, VectorXd(variables_));
      for (VectorXd& place : drawn)
        for (double& u : place) u = numbers_.uniform();
      const std::vector<double> beyond = screen_(drawn);
      places.push_back(drawn[static_cast<std::size_t>(std::ranges::min_element(beyond) - beyond.begin())]);
    }
    return places;
  }
  void tell(const std::vector<Candidate>&) override {}

 private:
  Eigen::Index variables_;
  RandomNumbers numbers_;
  Screen screen_;
};

std::vector<Candidate> searched(Search& search, const Problem& problem, int candidates, int at_a_time) {
  std::vector<Candidate> all;
  while (static_cast<int>(all.size()) < candidates) {
    std::vector<Candidate> told;
    for (const VectorXd& place : search.ask(at_a_time)) told.push_back(problem.candidate(place));
    search.tell(told);
    all.insert(all.end(), told.begin(), told.end());
  }
  return all;
}

Candidate best_of(const std::vector<Candidate>& candidates) {
  return *std::min_element(candidates.begin(), candidates.end(), better);
}

SurrogateSearch surrogate(const Problem& problem, std::uint64_t seed) {
  SurrogateSettings settings;
  settings.seed = seed;
  return {problem.low.size(), settings, nothing_rejected};
}

/// Returns the value that NLopt's COBYLA finds alone in this number of evaluations from a start; limits are kept to 1e-6.
double found_by_cobyla(const Problem& problem, const VectorXd& start, int evaluations) {
  const auto size = problem.low.size();
  double best = HUGE_VAL;
  int count = 0;
  const auto seen = [&](const VectorXd& place) {
    const Candidate candidate = problem.candidate(place);
    constexpr double kept = 1e-6;
    if (++count <= evaluations && candidate.violation() <= kept) best = std::min(best, candidate.aims.front());
    return candidate;
  };
  LimitFunctions limits;
  limits.count = static_cast<int>(problem.beyond(problem.at(start)).size());
  limits.beyond = [&](const VectorXd& place) {
    const std::vector<double> g = problem.beyond(problem.at(place));
    return Eigen::Map<const VectorXd>(g.data(), static_cast<Eigen::Index>(g.size())).eval();
  };
  minimised([&](const VectorXd& place) { return seen(place).aims.front(); }, limits,
            {VectorXd::Zero(size), VectorXd::Ones(size)}, start, 0.25, evaluations);
  return best;
}

}  // namespace

TEST_CASE("the surrogate search ends where the best places of known problems are, COBYLA not nearer") {
  // Tolerances as shares of the span of the values over the box. Where a limit decides, the models are smooth to this share.
  constexpr double share = 1e-4;
  struct Asked {
    Problem problem;
    int candidates;
    double span;
  };
  for (const Asked& asked : {Asked{tutorial(), 100, 1.7}, Asked{g24(), 100, 7}, Asked{g04(), 100, 7000}})
    for (const std::uint64_t seed : {1, 2, 3}) {
      SurrogateSearch search = surrogate(asked.problem, seed);
      const std::vector<Candidate> candidates = searched(search, asked.problem, asked.candidates, 2);
      const Candidate best = best_of(candidates);
      INFO(asked.problem.name << ", seed " << seed);
      CHECK(best.feasible());
      CHECK(best.aims.front() >= asked.problem.least - share * asked.span);
      CHECK(best.aims.front() - asked.problem.least < share * asked.span);
      const double cobyla = found_by_cobyla(asked.problem, candidates.front().place, asked.candidates);
      CHECK(best.aims.front() < cobyla + share * asked.span);
    }
}

TEST_CASE("with many valleys it mostly ends in the deepest, where chance does not come near") {
  // The second deepest minimum is higher by 0.066. Three seeds in four end in the deepest to 1e-3 (17 and 19 of 24 were counted,
  // in two versions that differ only in rounding). At these odds fewer than four of eight occur in 3 % of cases.
  int deepest = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    SurrogateSearch search = surrogate(g08(), seed);
    const Candidate best = best_of(searched(search, g08(), 100, 4));
    RandomSearch chance(2, seed, nothing_rejected);
    const Candidate by_chance = best_of(searched(chance, g08(), 100, 4));
    INFO("seed " << seed);
    CHECK(best.feasible());
    CHECK((!by_chance.feasible() || by_chance.aims.front() > best.aims.front()));
    deepest += best.aims.front() - g08().least < 1e-3;
  }
  CHECK(deepest >= 4);
}

TEST_CASE("candidates that do not run lead the search to candidates that run") {
  // The tutorial's problem, of which only a part of the box can be evaluated. Its best place lies at the part's edge.
  const Problem problem = tutorial();
  SurrogateSearch search = surrogate(problem, 1);
  std::vector<Candidate> all;
  while (all.size() < 80) {
    std::vector<Candidate> told;
    for (const VectorXd& place : search.ask(4)) {
      Candidate candidate = problem.candidate(place);
      const double far = 0.5 - problem.at(place)[0];  // runs from x0 = 0.5 on
      if (far > 0) candidate = {place, false, {}, {far}};
      told.push_back(candidate);
    }
    search.tell(told);
    all.insert(all.end(), told.begin(), told.end());
  }
  const Candidate best = best_of(all);
  REQUIRE(best.feasible());
  CHECK(best.aims.front() == Approx(1.0).margin(0.02));  // there x1 >= (2 x0)^3 = 1
}

TEST_CASE("if a thousandth of the range is feasible, short runs lead there within a few evaluations") {
  const Problem problem = springs();
  RandomSearch draws(6, 99, nothing_rejected);
  int kept = 0;
  constexpr int drawn = 200'000;
  for (const VectorXd& place : draws.ask(drawn)) kept += problem.candidate(place).feasible();
  INFO(kept << " of " << drawn);
  CHECK(kept > drawn / 2000);
  CHECK(kept < drawn / 700);
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    INFO("seed " << seed);
    SurrogateSettings settings;
    settings.seed = seed;
    SurrogateSearch search(6, settings, nothing_rejected, short_runs_of_springs);
    RandomSearch chance(6, seed, nothing_rejected);
    const std::vector<Candidate> candidates = searched(search, problem, 20, 4);
    const auto first = std::find_if(candidates.begin(), candidates.end(),
                                    [](const Candidate& candidate) { return candidate.feasible(); });
    CHECK(first - candidates.begin() < 8);
    // At most the allowed number before the first candidate, and a few per candidate.
    CHECK(search.short_runs().size() <= 150 + 20 * 12);
    CHECK_FALSE(best_of(searched(chance, problem, 20, 4)).feasible());
    // Without short runs it needs more candidates, but less than a thousand random ones.
    SurrogateSearch alone = surrogate(problem, seed);
    CHECK(best_of(searched(alone, problem, 60, 4)).feasible());
  }
}

TEST_CASE("where a limit is the largest of many, its pieces lead to where it is kept") {
  // A small polytope in a box of eight variables: each face is a piece of the one limit.
  constexpr Eigen::Index variables = 8, faces = 24;
  Eigen::MatrixXd normals(faces, variables);
  RandomSearch chance(variables, 5, nothing_rejected);
  const std::vector<VectorXd> drawn = chance.ask(faces);
  for (Eigen::Index k = 0; k < faces; ++k)
    normals.row(k) = (drawn[static_cast<std::size_t>(k)].array() - 0.5).matrix().normalized().transpose();
  const VectorXd centre = VectorXd::Constant(variables, 0.3);
  const auto pieces_at = [&](const VectorXd& place) {
    const VectorXd g = (normals * (place - centre)).array() - 0.03;
    return std::vector<double>(g.begin(), g.end());
  };
  const auto largest_at = [&](const VectorXd& place) {
    const std::vector<double> g = pieces_at(place);
    return *std::max_element(g.begin(), g.end());
  };
  const auto short_runs_until_one_is_within = [&](bool in_pieces, std::uint64_t seed) {
    int count = 0, first = 0;
    const ShortRuns make_short_runs = [&](const std::vector<VectorXd>& places) {
      std::vector<Candidate> told;
      for (const VectorXd& place : places) {
        told.push_back({place, true, {}, {largest_at(place)}});
        if (in_pieces) told.back().pieces = {pieces_at(place)};
        ++count;
        if (first == 0 && largest_at(place) <= 0) first = count;
      }
      return told;
    };
    SurrogateSettings settings;
    settings.seed = seed;
    settings.short_runs = 200;
    SurrogateSearch search(variables, settings, nothing_rejected, make_short_runs);
    search.ask(1);
    return first == 0 ? 1000 : first;
  };
  for (const std::uint64_t seed : {1, 2, 3}) {
    const int whole = short_runs_until_one_is_within(false, seed), pieces = short_runs_until_one_is_within(true, seed);
    INFO("seed " << seed << ": after " << pieces << " in pieces, " << whole << " as a whole");
    CHECK(pieces <
          60);  // a plane over eight variables needs nine points, and has errors between for some batches of eight
    CHECK(2 * pieces < whole);
  }
}

TEST_CASE("a search is a function of its seed and of the results that it gets") {
  const Problem problem = g24();
  SurrogateSearch whole = surrogate(problem, 7), first = surrogate(problem, 7);
  const std::vector<Candidate> candidates = searched(whole, problem, 40, 4);
  // A search that is killed after five results and restarted from its notes continues as if uninterrupted.
  SurrogateSearch again = surrogate(problem, 7);
  for (std::size_t k = 0; k < candidates.size(); k += 4) {
    const std::vector<VectorXd> places = again.ask(4);
    for (std::size_t j = 0; j < 4; ++j) CHECK(places[j] == candidates[k + j].place);
    again.tell(
        {candidates.begin() + static_cast<std::ptrdiff_t>(k), candidates.begin() + static_cast<std::ptrdiff_t>(k + 4)});
  }
  SurrogateSearch other = surrogate(problem, 8);
  CHECK_FALSE(other.ask(1).front() == first.ask(1).front());
}

TEST_CASE("a search with short runs goes on where it was killed, too") {
  SurrogateSettings settings;
  SurrogateSearch whole(6, settings, nothing_rejected, short_runs_of_springs),
      again(6, settings, nothing_rejected, short_runs_of_springs);
  const std::vector<Candidate> candidates = searched(whole, springs(), 12, 4);
  for (std::size_t k = 0; k < candidates.size(); k += 4) {
    const std::vector<VectorXd> places = again.ask(4);
    for (std::size_t j = 0; j < 4; ++j) CHECK(places[j] == candidates[k + j].place);
    again.tell(
        {candidates.begin() + static_cast<std::ptrdiff_t>(k), candidates.begin() + static_cast<std::ptrdiff_t>(k + 4)});
  }
}

TEST_CASE(
    "of many short runs of which none keeps its limits the nearest are looked at, and none that the "
    "models forgot") {
  // A narrow valley around one corner of a box of six variables, which never keeps the limit. Short runs are exact.
  const auto beyond = [](const VectorXd& place) {
    return 0.1 + std::abs(std::log(((place.array() - 0.2).abs().maxCoeff() + 0.05) / 0.3));
  };
  const ShortRuns make_short_runs = [&](const std::vector<VectorXd>& places) {
    std::vector<Candidate> told;
    for (const VectorXd& place : places) told.push_back({place, true, {}, {beyond(place)}});
    return told;
  };
  SurrogateSettings settings;
  settings.short_runs = 480;  // twice as many as the models use
  SurrogateSearch search(6, settings, nothing_rejected, make_short_runs);
  const std::vector<VectorXd> asked = search.ask(4);
  CHECK(search.short_runs().size() >= 480);
  for (const VectorXd& place : asked) CHECK(beyond(place) < 0.15);  // 0.1 is the valley's floor, 1.9 its rim
}

TEST_CASE("short runs that do not run or give no information do not mislead the search") {
  // Runs only where x0 > 0.5. Elsewhere the limits are unknown.
  const Problem problem = g24();
  const auto runs = [](const VectorXd& place) { return place[0] > 0.5; };
  const ShortRuns make_short_runs = [&](const std::vector<VectorXd>& places) {
    std::vector<Candidate> told;
    for (const VectorXd& place : places)
      told.push_back({place,
                      runs(place),
                      {},
                      runs(place) ? std::vector<double>(2, std::nan("")) : std::vector<double>{0.5 - place[0]}});
    return told;
  };
  SurrogateSearch search(2, {}, nothing_rejected, make_short_runs);
  std::vector<Candidate> all;
  while (all.size() < 40) {
    std::vector<Candidate> told;
    for (const VectorXd& place : search.ask(4))
      told.push_back(runs(place) ? problem.candidate(place) : Candidate{place, false, {}, {0.5 - place[0]}});
    search.tell(told);
    all.insert(all.end(), told.begin(), told.end());
  }
  const Candidate best = best_of(all);
  CHECK(best.feasible());
  CHECK(best.aims.front() - problem.least < 0.05);  // its best place, x0 = 2.33, runs
}

TEST_CASE("a search gives up after a third of its short runs where none runs or is near its limits") {
  const auto short_runs_until_it_asks = [](const ShortRuns& make_short_runs, bool gives_up) {
    SurrogateSettings settings;
    settings.short_runs = 90;
    SurrogateSearch search(2, settings, nothing_rejected, make_short_runs);
    CHECK(search.ask(4).empty() == gives_up);
    return search.short_runs().size();
  };
  const auto all = [](bool run, double least) {
    return [run, least](const std::vector<VectorXd>& places) {
      std::vector<Candidate> told;
      for (const VectorXd& place : places) told.push_back({place, run, {}, {least + place[0]}});
      return told;
    };
  };
  constexpr std::size_t third = 30, together = 8;
  for (const bool run : {false, true}) {
    const std::size_t count = short_runs_until_it_asks(all(run, 1), true);
    CHECK(count >= third);
    CHECK(count < third + together);
  }
  CHECK(short_runs_until_it_asks(all(true, 0.5), false) >
        third + together);  // the limit is missed by less, so it continues
}

TEST_CASE("places that are rejected beforehand are not asked for") {
  const Screen right_half = [](const std::vector<VectorXd>& places) {
    std::vector<double> beyond;
    for (const VectorXd& place : places) beyond.push_back(std::max(0.0, 0.5 - place[0]));
    return beyond;
  };
  SurrogateSettings settings;
  SurrogateSearch search(2, settings, right_half);
  RandomSearch chance(2, 1, right_half);
  const Problem problem = g24();
  for (Search* of : {static_cast<Search*>(&search), static_cast<Search*>(&chance)})
    for (const Candidate& candidate : searched(*of, problem, 40, 4)) CHECK(candidate.place[0] >= 0.5);
}

TEST_CASE("two aims give the front between them") {
  // Distances from (0.2, 0.5) and (0.8, 0.5): the front is the line between them, where their sum is 0.6.
  const auto look_at = [](const VectorXd& place) {
    const VectorXd a = vector_of({0.2, 0.5}), b = vector_of({0.8, 0.5});
    return Candidate{place, true, {(place - a).norm(), (place - b).norm()}, {-1}};
  };
  SurrogateSettings settings;
  settings.aims = 2;
  SurrogateSearch search(2, settings, nothing_rejected);
  std::vector<Candidate> all;
  while (all.size() < 80) {
    std::vector<Candidate> told;
    for (const VectorXd& place : search.ask(4)) told.push_back(look_at(place));
    search.tell(told);
    all.insert(all.end(), told.begin(), told.end());
  }
  const std::vector<std::size_t> best = front(all);
  REQUIRE(best.size() >= 5);
  double least = 1, most = 0;
  for (const std::size_t k : best) {
    CHECK(all[k].aims[0] + all[k].aims[1] < 0.7);
    least = std::min(least, all[k].aims[0]);
    most = std::max(most, all[k].aims[0]);
  }
  CHECK(least < 0.1);
  CHECK(most > 0.5);
}

TEST_CASE("what ran is better than what did not, what keeps its limits than what does not") {
  const auto candidate = [](bool ran, double aim, double g) { return Candidate{vector_of({0}), ran, {aim}, {g}}; };
  CHECK(better(candidate(true, 5, 1), candidate(false, 0, 0.1)));
  CHECK(better(candidate(true, 5, -1), candidate(true, 0, 0.1)));
  CHECK(better(candidate(true, 0, 0.1), candidate(true, 0, 0.2)));
  CHECK(better(candidate(true, 0, -1), candidate(true, 1, -2)));
  CHECK(better(candidate(false, 0, 0.1), candidate(false, 0, 0.2)));
  CHECK(front({candidate(true, 1, 0), candidate(true, 0, 1), candidate(true, 2, 0)}) == std::vector<std::size_t>{0});
}

TEST_CASE("functions of the same places are modelled as each by itself, with one shape") {
  Eigen::MatrixXd points(7, 2), values(7, 2);
  points << 0, 0.3, 0.2, 0.9, 0.4, 0.1, 0.6, 0.6, 0.8, 0.2, 1, 0.7, 0.5, 0.5;
  values.col(0) = (points.col(0).array() * 3).sin() + points.col(1).array();
  values.col(1) = 40 - 7 * (points.col(1).array() * 2).exp();
  const auto shape = GaussianProcess::likeliest_shape(points, values, GaussianProcess::usual_shape(2), 100);
  const GaussianProcess both(points, values, shape);
  for (const VectorXd& place : {vector_of({0.1, 0.8}), vector_of({0.5, 0.5}), vector_of({0.9, 0.9})}) {
    const GaussianProcess::Predictions told = both.of_each(place);
    for (Eigen::Index k = 0; k < 2; ++k) {
      const VectorXd own = values.col(k);
      const GaussianProcess::Prediction alone = GaussianProcess(points, own, shape).at(place);
      CHECK(told.means[k] == Approx(alone.mean).epsilon(1e-12));
      CHECK(told.deviations[k] == Approx(alone.deviation).epsilon(1e-12).margin(1e-15));
    }
  }
  // Scaling of one aim, or a copy of it, does not change the shape.
  Eigen::MatrixXd again(7, 3);
  again << 1000 * values.col(0), values.col(1), values.col(1);
  Eigen::MatrixXd once(7, 3);
  once << values.col(0), values.col(1), values.col(1);
  const auto usual = GaussianProcess::usual_shape(2);
  CHECK((GaussianProcess::likeliest_shape(points, again, usual, 60) -
         GaussianProcess::likeliest_shape(points, once, usual, 60))
            .norm() < 1e-6);
}

TEST_CASE("the usual length of a Gaussian process is half the diagonal of the unit box") {
  for (const Eigen::Index variables : {1, 4, 9}) {
    const auto shape = GaussianProcess::usual_shape(variables);
    REQUIRE(shape.size() == variables + 1);
    const double diagonal = VectorXd::Ones(variables).norm();
    for (Eigen::Index k = 0; k < variables; ++k) CHECK(std::exp(shape[k]) == Approx(diagonal / 2));
  }
}

TEST_CASE("a Gaussian process passes through what was seen and is sure there alone") {
  Eigen::MatrixXd points(6, 1);
  points << 0, 0.2, 0.4, 0.6, 0.8, 1;
  const VectorXd values = (points.array() * 5).sin();
  const auto shape = GaussianProcess::likeliest_shape(points, values, GaussianProcess::usual_shape(1), 200);
  const GaussianProcess model(points, values, shape);
  for (Eigen::Index k = 0; k < 6; ++k) {
    CHECK(model.at(points.row(k).transpose()).mean == Approx(values[k]).margin(1e-3));
    CHECK(model.at(points.row(k).transpose()).deviation < 0.02);
  }
  CHECK(model.at(vector_of({0.5})).mean == Approx(std::sin(2.5)).margin(0.05));
  CHECK(model.at(vector_of({0.5})).deviation > model.at(vector_of({0.4})).deviation);
  // Equal values at all places.
  const VectorXd same = VectorXd::Constant(6, 3.0);
  const GaussianProcess flat(points, same, GaussianProcess::likeliest_shape(points, same, shape, 50));
  CHECK(flat.at(vector_of({0.5})).mean == Approx(3));
}
