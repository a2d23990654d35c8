// The response of a life: every point against the exact lives of all wires, and the rest of loose cables as a parameter.
#include "fatigue/response.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>

#include "fatigue/relaxation.h"
#include "pipeline/base/statistics.h"
#include "pipeline/job/job.h"
#include "pipeline/life/first_failure.h"
#include "tests/catch.h"
#include "tests/fatigue/materials.h"
#include "tests/fatigue/part_of_strain.h"
#include "tests/pipeline/scratch.h"

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
    for (const VariedStrains& at : varied) response.points.push_back(at.z), response.inside.push_back(at.inside);
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
  for (const VariedStrains& at : varied) response.points.push_back(at.z), response.inside.push_back(at.inside);
  fatigue::put_rests(response, varied, {3, 1, 1});
  const double most = 5 * std::log10(1 + std::pow(10, (4 - 10.7) / 5));  // by the strain of the worst rest
  pipeline::ParameterPoint z{};
  for (const double at : {-3.0, -1.0, 0.0, 1.0, 3.0}) {
    z[rest] = at;
    CHECK(LifeSurface(response).log10_life(z, 0, Inside::glued) == Approx(4).margin(most));
    CHECK(LifeSurface(response).log10_life(z, 0) > 10);
  }
}

TEST_CASE("rests: each strength and slope of the material has its own lives, and the order is that of the medians") {
  std::vector<VariedStrains> varied(3);
  varied[0].rest = 1, varied[1].rest = 2, varied[2].rest = 2, varied[2].z[hose] = 1.5;
  LifeResponse response;
  response.knowledge = pipeline::prior_of({});
  response.strength = {-1, 0}, response.slope = {-1, 0, 1};  // the median is the fifth of six
  response.worst_life = {9, 8, 7, 8, 6, 5, /**/ 1, 2, 3, 4, 7, 6, /**/ 8, 7, 6, 5, 5, 3, /**/ 7, 8, 5, 6, 6, 4};
  const std::vector<double> own = response.worst_life;
  for (const VariedStrains& at : varied) response.points.push_back(at.z), response.inside.push_back(at.inside);
  fatigue::put_rests(response, varied, {4, 3, 1});
  // Lives 5, 6 and 7 at the medians: rests 2, 0 and 1, of 1, 4 and 3 starts.
  const double zero = pipeline::normal_quantile(3. / 8);
  CHECK(response.points[1][rest] == Approx(pipeline::normal_quantile(6.5 / 8) - zero));
  CHECK(response.points[2][rest] == Approx(pipeline::normal_quantile(0.5 / 8) - zero));
  CHECK(response.knowledge.mean[rest] == Approx(-zero));
  for (std::size_t node = 0; node < 6; ++node)
    CHECK(response.worst_life[18 + node] ==
          Approx(pipeline::together(own[12 + node], std::array{own[18 + node], own[node]})));
}

TEST_CASE(
    "variations are read as written, with the wires that count, and each number that the file does not hold is refused") {
  const pipeline::Format format = fatigue_tests::part_of_strain(
      {"/variation/z", "/variation/inside", "/variation/rest", "/variation/stiffness", "/start/rest",
       "/variation/row/variation", "/variation/row/site", "/variation/row/turning", "/variation/strain"});
  const pipeline::Scratch folder;
  const std::vector<double> z{0, 1, 2, 3, 4, -5, -6, -7, -8, -9, 10, 11, 12, 13, 14}, stiffness{0.5, 0, -0.5};
  const std::vector<std::int32_t> inside{0, 2, 1}, rest_of{1, 0, 2}, start{0, 2, 1, 1};
  const std::vector<std::uint32_t> variation{1, 0, 1, 2}, site{3, 1, 0, 3}, turning{2, 3, 1, 2};
  const std::vector<float> strain{1, 2, 3, 4, 5, 6, 7, 8};
  const auto reads = [&](const auto&... lists) {
    const auto [of_inside, of_rest, of_start, of_variation, of_site, of_turning] = std::tuple(lists...);
    {
      pipeline::FileWriter file(folder / "strain.h5", format);
      file.append("/variation/z", z), file.append("/variation/inside", of_inside),
          file.append("/variation/rest", of_rest);
      file.append("/variation/stiffness", stiffness), file.append("/start/rest", of_start);
      file.append("/variation/row/variation", of_variation), file.append("/variation/row/site", of_site);
      file.append("/variation/row/turning", of_turning), file.append("/variation/strain", strain);
      for (const char* name : {"job", "history", "input_sha256"}) file.attribute(name, "");
      file.commit();
    }
    const pipeline::FileReader file(folder / "strain.h5", format);
    fatigue::read_rests(file);
    return fatigue::read_variations(file, 4);
  };
  const std::vector<VariedStrains> all = reads(inside, rest_of, start, variation, site, turning);
  REQUIRE(all.size() == 3);
  for (std::size_t v = 0; v < 3; ++v) {
    for (std::size_t p = 0; p < rest; ++p) CHECK(all[v].z[p] == z[5 * v + p]);
    CHECK(all[v].z[rest] == 0);
    CHECK(all[v].z[index_of(Uncertain::hose_stiffness)] == stiffness[v]);
    CHECK(static_cast<std::int32_t>(all[v].inside) == inside[v]);
    CHECK(static_cast<std::int32_t>(all[v].rest) == rest_of[v]);
  }
  CHECK(all[0].site == std::vector<std::size_t>{1});
  CHECK(all[1].site == std::vector<std::size_t>{3, 0});
  CHECK(all[1].strains == std::vector<std::vector<float>>{{1, 2}, {6}});
  CHECK(all[2].strains == std::vector<std::vector<float>>{{7, 8}});
  const std::vector<VariedStrains> some = fatigue::only(all, {true, false, true, false});
  CHECK((some[0].strains.empty() && some[2].site.empty()));
  CHECK(some[1].site == std::vector<std::size_t>{0});
  CHECK(some[1].strains == std::vector<std::vector<float>>{{6}});
  CHECK((some[2].z == all[2].z && some[2].inside == all[2].inside && some[2].rest == all[2].rest));
  const auto changed = [](auto list, std::size_t at, auto to) {
    list[at] = to;
    return list;
  };
  const auto refusal = [&](const auto&... lists) { return pipeline::message_of([&] { reads(lists...); }); };
  for (const std::int32_t wrong : {-1, 3}) {
    CHECK_THAT(refusal(changed(inside, 1, wrong), rest_of, start, variation, site, turning),
               Catch::Contains("/variation/inside is " + std::to_string(wrong)));
    CHECK_THAT(refusal(inside, changed(rest_of, 1, wrong), start, variation, site, turning),
               Catch::Contains("/variation/rest is " + std::to_string(wrong)));
    const std::int32_t of_start = wrong < 0 ? wrong : 4;
    CHECK_THAT(refusal(inside, rest_of, changed(start, 2, of_start), variation, site, turning),
               Catch::Contains("/start/rest is " + std::to_string(of_start)));
  }
  CHECK_THAT(refusal(inside, rest_of, start, changed(variation, 1, 3u), site, turning),
             Catch::Contains("/variation/row names"));
  CHECK_THAT(refusal(inside, rest_of, start, variation, changed(site, 1, 4u), turning),
             Catch::Contains("/variation/row names"));
  CHECK_THAT(refusal(inside, rest_of, start, variation, site, changed(turning, 3, 3u)),
             Catch::Contains("/variation/row names"));
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

namespace {

/// Sites of a strain file with their reversals, of two materials in turns.
struct Sites {
  pipeline::Job job;
  std::vector<std::vector<float>> strains;
  const pipeline::Scratch folder;

  Sites() {
    auto cu = fatigue_tests::copper(), al = fatigue_tests::aluminium();
    cu.name = "copper", al.name = "aluminium";
    cu.relaxation_threshold_strain = 0.002, cu.relaxation_exponent = 0.1;
    job.dresspacks[0].dresspack.materials = {cu, al};
    pipeline::Component& cable = job.dresspacks[0].dresspack.components.emplace_back();
    cable.name = "cable", cable.components.resize(1);
    cable.components[0].layer = "layer 1";
  }
  static std::string material(std::size_t site) { return site / 3 % 2 == 0 ? "copper" : "aluminium"; }
  static const pipeline::Format& format() {
    static const pipeline::Format part =
        fatigue_tests::part_of_strain({"/site/segment", "/site/component", "/site/material", "/reversal/strain",
                                       "/reversal/offset", "/segment/length"});
    return part;
  }
  void write(const std::filesystem::path& path) const {
    pipeline::FileWriter file(path, format());
    std::vector<std::uint64_t> offset{0};
    for (std::size_t site = 0; site < strains.size(); ++site) {
      file.append("/site/segment", std::vector<std::int32_t>{0});
      file.append("/site/component", std::vector<std::string>{"cable 1/layer 1/wire 1"});
      file.append("/reversal/strain", strains[site]);
      offset.push_back(offset.back() + strains[site].size());
    }
    std::vector<std::string> materials;
    for (std::size_t site = 0; site < strains.size(); ++site) materials.push_back(material(site));
    file.append("/site/material", materials);
    file.append("/reversal/offset", offset);
    file.append("/segment/length", std::vector<double>{1});
    for (const char* name : {"job", "history", "input_sha256"}) file.attribute(name, "");
    file.commit();
  }

  /// Returns the damage of a site by the exact curves. safe: compression has no effect.
  double damage(std::size_t site, const std::vector<float>& of, const pipeline::Job& moved, bool safe) const {
    const pipeline::Material m = pipeline::material_of(moved, material(site));
    const auto reversals = fatigue::find_reversals(std::vector<double>(of.begin(), of.end()));
    const fatigue::StrainLife life(m, moved.fatigue.mean_stress, moved.fatigue.endurance_strain);
    const auto at_share = [&](double share) {
      double sum = 0;
      for (const fatigue::DamagingCycle& c : fatigue::evaluate_cycles(reversals, m, moved.fatigue, share)) {
        const double compressive = safe ? std::min(c.stress_mean, 0.0) : 0;
        sum +=
            c.cycle.count * life.damage({c.cycle.range() / 2, c.stress_max - compressive, c.stress_mean - compressive});
      }
      return sum;
    };
    const fatigue::Relaxation relaxation(m, moved.fatigue);
    if (relaxation.never()) return at_share(1);
    const auto [low, high] = std::minmax_element(of.begin(), of.end());
    return 1 / fatigue::relaxing_life(relaxation.exponent((double(*high) - double(*low)) / 2),
                                      [&](std::span<const double> share, std::span<double> damage) {
                                        for (std::size_t k = 0; k < share.size(); ++k) damage[k] = at_share(share[k]);
                                      });
  }
};

}  // namespace

TEST_CASE("response: every point has the life of its worst wire, with every strength and slope of the material") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> size(0.002, 0.004);
  for (const bool relaxes : {false, true}) {
    Sites sites;
    if (relaxes) sites.job.fatigue.mean_stress_relaxation = pipeline::MeanStressRelaxation::power_law;
    sites.job.fatigue.strength_factor = 1.1, sites.job.fatigue.slope_change = 0.004;
    const auto history = [&](std::size_t k, double times) {
      const double a = times * size(random), offset = (k % 2 ? 0.8 : -0.8) * a;
      std::vector<float> turns{0, float(a + offset)};
      for (std::size_t inner = 0; inner < k % 4; ++inner)
        turns.insert(turns.end(), {float(0.3 * a + offset), float(0.5 * a + offset)});
      turns.insert(turns.end(), {float(offset - a), 0});
      return turns;
    };
    for (std::size_t k = 0; k < 40; ++k) sites.strains.push_back(history(k, 1));
    VariedStrains own;
    for (std::size_t k = 0; k < 40; ++k) own.site.push_back(k), own.strains.push_back(sites.strains[k]);
    std::vector<VariedStrains> varied(4);
    for (std::size_t v = 0; v < 4; ++v) {
      varied[v].z[v] = 1.5 - double(v);
      varied[v].inside = static_cast<Inside>(v % 3);
      for (std::size_t k = v; k < 40; k += v + 2)
        varied[v].site.push_back(k), varied[v].strains.push_back(history(k, 1 + 0.3 * double(v)));
    }
    sites.write(sites.folder / "strain.h5");
    const pipeline::FileReader file(sites.folder / "strain.h5", Sites::format());
    const fatigue::SiteSet set(file, "");
    LifeResponse response;
    fatigue::fill_response(response, own, varied, set, fatigue::read_column(file, "/site/component"), sites.job, 2);
    REQUIRE(response.points.size() == 5);
    const std::size_t slopes = response.slope.size(), nodes = response.strength.size() * slopes;
    REQUIRE(response.worst_life.size() == 5 * nodes);
    for (std::size_t point = 0; point < 5; ++point) {
      const VariedStrains& at = point == 0 ? own : varied[point - 1];
      CHECK(response.points[point] == at.z);
      CHECK(response.inside[point] == at.inside);
      for (std::size_t node = 0; node < nodes; ++node) {
        pipeline::Job moved = sites.job;
        moved.fatigue.strength_factor *= std::pow(1.3, response.strength[node / slopes]);
        moved.fatigue.slope_change += 0.01 * response.slope[node % slopes];
        double worst = 0;
        for (std::size_t k = 0; k < at.site.size(); ++k)
          worst = std::max(worst, sites.damage(at.site[k], at.strains[k], moved, at.inside == Inside::glued));
        CAPTURE(relaxes, point, node);
        CHECK(response.worst_life[point * nodes + node] ==
              Approx(-std::log10(worst)).margin(fatigue::DamageCounter::table_error));
      }
    }
  }
}

TEST_CASE("response: a hose that is pulled tight lives one repeat, and softer ones no longer") {
  constexpr std::size_t stiffness = index_of(Uncertain::hose_stiffness), inside = index_of(Uncertain::friction_inside);
  LifeResponse response;
  response.planned = {{6, 6, 6}};
  response.points = {{}, {}, {}, {}};
  response.points[1][stiffness] = -0.8, response.points[2][stiffness] = 1.6, response.points[3][inside] = 1.5;
  response.inside.assign(4, Inside::as_is);
  response.worst_life = {6, 7, 4, 8};  // by the line through these, a softer hose lives longer
  response.bound = {6, 4, 7};
  response.knowledge = pipeline::prior_of({});
  const auto life = [&](double z, double friction, Inside of) {
    pipeline::ParameterPoint at{};
    at[stiffness] = z, at[inside] = friction;
    return LifeSurface(response).log10_life(at, 0, of);
  };
  CHECK(life(-1.6, 0, Inside::as_is) == Approx(8));
  fatigue::put_taut(response, {-1.6});
  const LifeResponse read = LifeResponse::from_text(response.text());  // as a plan reads it
  CHECK(read.points == response.points);
  CHECK(life(0, 0, Inside::as_is) == 6);
  CHECK(life(1.6, 0, Inside::as_is) == Approx(4));
  CHECK(life(-0.8, 0, Inside::as_is) == Approx(7));
  CHECK(life(-1.2, 0, Inside::as_is) == Approx(3.5));
  for (const double z : {-1.6, -2.5, -3.5, -9.0}) {
    CAPTURE(z);
    CHECK(life(z, 0, Inside::as_is) == Approx(0).margin(1e-12));
    CHECK(life(z, 1.5, Inside::as_is) < 0.5);
    CHECK(life(z, 0, Inside::glued) < 0.5);
  }
  const LifeResponse before = response;
  fatigue::put_taut(response, {});
  CHECK(response.points == before.points);
  // Nothing is known of stiffer hoses.
  response.points = {{}, {}}, response.inside.assign(2, Inside::as_is), response.worst_life = {6, 8};
  response.points[1][inside] = 1.5;
  fatigue::put_taut(response, {-0.8});
  CHECK(life(-0.4, 0, Inside::as_is) == Approx(3));
  CHECK(life(-0.8, 0, Inside::as_is) == Approx(0).margin(1e-12));
  for (const double z : {0.8, 1.6, 3.5}) CHECK(life(z, 0, Inside::as_is) == Approx(6));
}
