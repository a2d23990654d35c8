// The rest of loose cables as a parameter of a life.
#include "fatigue/response.h"

#include <cmath>

#include "pipeline/base/statistics.h"
#include "pipeline/life/first_failure.h"
#include "tests/catch.h"

using namespace dresslife;
using fatigue::VariedStrains;
using pipeline::Inside;
using pipeline::LifeResponse;
using pipeline::LifeSurface;
using pipeline::Uncertain;

namespace {

constexpr std::size_t rest = index_of(Uncertain::rest), slack = index_of(Uncertain::slack),
                      hose = index_of(Uncertain::friction_hose);

/// A job with life 1e6 at the rest of three of five starts, and two other rests of one start each. Slack and friction along
/// the hose are varied from rest 2.
struct Rests {
  std::vector<VariedStrains> varied{6};
  std::vector<std::size_t> starts{3, 1, 1};
  LifeResponse response;

  Rests(double of_one, double of_two) {
    varied[0].rest = 1, varied[1].rest = 2;
    for (std::size_t v = 2; v < varied.size(); ++v) varied[v].rest = 2;
    varied[2].z[slack] = varied[4].z[hose] = -1.5, varied[3].z[slack] = varied[5].z[hose] = 1.5;
    response.knowledge = pipeline::prior_of({});
    response.planned = {{5.9, 6, 6.1}};
    response.worst_life = {6, of_one, of_two, of_two - 2, of_two + 1, of_two - 2, of_two + 1};
    for (const VariedStrains& at : varied)
      response.points.push_back(at.z), response.inside.push_back(at.inside);
    fatigue::put_rests(response, varied, starts);
  }
};

}  // namespace

TEST_CASE("rests: lives over all starts have the quantiles of the starts, whichever is the job's own") {
  constexpr double rounding = 1e-12;
  const Rests beside(5, 8);
  const LifeResponse& of = beside.response;
  const double mean = of.knowledge.mean[rest];
  for (const auto& [share, life] : {std::pair(0.1, 5.0), {0.5, 6.0}, {0.9, 8.0}, {0.02, 5.0}, {0.98, 8.0}}) {
    pipeline::ParameterPoint z{};
    z[rest] = mean + pipeline::normal_quantile(share);
    CHECK(LifeSurface(of).log10_life(z, 0) == Approx(life).margin(rounding));
  }
  const Rests worse(5, 5.5);  // the job's own rest has the longest life
  CHECK(worse.response.knowledge.mean[rest] == Approx(-pipeline::normal_quantile(0.7)));
  pipeline::ParameterPoint z{};
  CHECK(LifeSurface(worse.response).log10_life(z, 0) == Approx(6));
  z[rest] = worse.response.knowledge.mean[rest] + pipeline::normal_quantile(0.3);
  CHECK(LifeSurface(worse.response).log10_life(z, 0) == Approx(5.5));
}

TEST_CASE("rests: a variation that went on from another rest counts by what it changes there") {
  const Rests of(5, 8);
  pipeline::ParameterPoint z{};
  z[hose] = -1.5;
  // From rest 2, life 1e8, to the job's own rest, life 1e6, the strain grows by f - 1. Friction along the hose multiplies it by
  // f or g.
  const double f = std::pow(10, 2. / 5), g = std::pow(10, -1. / 5);
  CHECK(LifeSurface(of.response).change(z) == Approx(2 - 5 * std::log10(f + f - 1)));
  z[hose] = 1.5;
  CHECK(LifeSurface(of.response).change(z) == Approx(2 - 5 * std::log10(f + g - 1)));
}

TEST_CASE("rests: at another slack a life stays as computed, whichever rest the cables went on from") {
  const Rests of(5, 8);
  pipeline::ParameterPoint z{};
  z[slack] = -1.5;
  CHECK(LifeSurface(of.response).log10_life(z, 0) == Approx(6));
  z[slack] = 1.5;
  CHECK(LifeSurface(of.response).log10_life(z, 0) == Approx(9));
}

TEST_CASE("rests: lives beyond anything physical shorten no other life") {
  // Like a job of two_robots: little damage at two of its three rests, and 1e4 repeats if everything is glued.
  std::vector<VariedStrains> varied(3);
  varied[0].rest = varied[2].rest = 1, varied[1].rest = 2, varied[2].inside = Inside::glued;
  LifeResponse response;
  response.knowledge = pipeline::prior_of({});
  response.planned = {{16, 16, 16}};
  response.worst_life = {16, 18.1, 10.7, 4.3};
  response.bound[static_cast<std::size_t>(Inside::glued)] = 4;
  for (const VariedStrains& at : varied)
    response.points.push_back(at.z), response.inside.push_back(at.inside);
  fatigue::put_rests(response, varied, {3, 1, 1});
  const double most = 5 * std::log10(1 + std::pow(10, (4 - 10.7) / 5));  // by the strain of the worst rest
  pipeline::ParameterPoint z{};
  for (const double at : {-3.0, -1.0, 0.0, 1.0, 3.0}) {
    z[rest] = at;
    CHECK(LifeSurface(response).log10_life(z, 0, Inside::glued) == Approx(4).margin(most));
    CHECK(LifeSurface(response).log10_life(z, 0) > 10);
  }
}

TEST_CASE("rests: they have a share in the causes when starts differ, and none when they agree") {
  const auto share_of = [](const LifeResponse& response) {
    return pipeline::summary_of({response}, "job", 2000).share[rest];
  };
  CHECK(share_of(Rests(5, 8).response) > 0.3);
  Rests agreeing(6, 6);
  CHECK(share_of(agreeing.response) < 1e-9);
  LifeResponse alone = Rests(5, 8).response;  // one start or no ring: no variation of rest
  alone.points.resize(1), alone.inside.resize(1), alone.worst_life.resize(1);
  CHECK(share_of(alone) == 0);
}
