// Warnings of forces at other values of the uncertain parameters, against a count of dresspacks by integration.
#include "fatigue/varied_forces.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <random>

#include "fatigue/cable_cures.h"
#include "pipeline/base/statistics.h"
#include "pipeline/cable/believable.h"
#include "pipeline/job/job.h"
#include "pipeline/life/life_response.h"
#include "tests/catch.h"
#include "tests/fatigue/materials.h"
#include "tests/fatigue/part_of_strain.h"
#include "tests/pipeline/scratch.h"

using namespace dresslife;
using namespace dresslife::fatigue;
using pipeline::Uncertain;

namespace {

constexpr std::size_t cables = 3, spans = 2;
constexpr std::size_t hose_friction = index_of(Uncertain::friction_hose), slack = index_of(Uncertain::slack),
                      play = index_of(Uncertain::play), grip = index_of(Uncertain::grip),
                      stiffness = index_of(Uncertain::hose_stiffness);

struct Variation {
  std::array<double, pipeline::strain_parameters> z{};
  std::int32_t rest = 0;
  std::array<double, cables> tension{};  // over the limit of each cable
  std::array<double, spans> moment{};    // of the cables over the limit by the hose
  std::int32_t inside = 0;
};

/// A job with three cables of different strength, and the variations of its strain file.
struct Varied {
  pipeline::Job job;
  std::vector<Variation> all;
  std::vector<std::int32_t> rest_of_start;
  std::vector<pipeline::CableForce> force;
  std::vector<CableFacts> facts;
  ForceShares own{0.5 * pipeline::believable_share, 0.4 * pipeline::believable_share};
  const pipeline::Scratch folder;
  std::size_t wrong_sample = 0, wrong_cable = 0;

  Varied() {
    pipeline::Dresspack& dresspack = job.dresspacks[0].dresspack;
    auto copper = fatigue_tests::copper();
    copper.name = "copper", copper.tensile_strength = 230e6;
    dresspack.materials = {copper};
    for (std::size_t k = 0; k < cables; ++k) {
      pipeline::Component& cable = dresspack.components.emplace_back();
      cable.name = fmt::format("cable {}", k + 1), cable.radius = 3e-3;
      pipeline::Component& wires = cable.components.emplace_back();
      wires.name = "wire", wires.material = "copper", wires.count = 50 * static_cast<int>(k + 1), wires.radius = 1e-4;
    }
    for (std::size_t k = 0; k < cables; ++k) {
      const pipeline::Component& cable = dresspack.components[k];
      force.emplace_back(dresspack, cable);
      facts.push_back({cable.name, "dresspack", std::to_string(k + 1), &cable, &dresspack});
    }
  }

  static double hose_moment(std::size_t variation, std::size_t span) {
    return 2.0 + double(variation) + 7 * double(span);
  }

  template <class Use>
  auto with_file(Use use) const {
    static const pipeline::Format format = fatigue_tests::part_of_strain(
        {"/time", "/program/step", "/program/text", "/start/rest", "/variation/z", "/variation/stiffness",
         "/variation/rest", "/variation/inside", "/variation/tension", "/variation/tension_place",
         "/variation/tension_sample", "/variation/clamp_moment", "/variation/clamp_moment_place",
         "/variation/clamp_moment_tension"});
    const auto path = folder / "strain.h5";
    {
      pipeline::FileWriter file(path, format);
      file.set_axis("cable", cables), file.set_axis("cable_span", spans);
      std::vector<double> time;
      std::vector<std::int32_t> step;
      for (std::size_t t = 0; t < 10 * all.size() + 10; ++t)
        time.push_back(0.5 * double(t)), step.push_back(std::int32_t(t % 2));
      file.append("/time", time), file.append("/program/step", step);
      file.append("/program/text", std::vector<std::string>{"even", "odd"});
      if (!rest_of_start.empty()) file.append("/start/rest", rest_of_start);
      for (std::size_t v = 0; v < all.size(); ++v) {
        const Variation& of = all[v];
        file.append("/variation/z", std::vector<double>(of.z.begin(), of.z.begin() + 5));
        file.append("/variation/stiffness", std::vector<double>{of.z[stiffness]});
        file.append("/variation/rest", std::vector<std::int32_t>{of.rest});
        file.append("/variation/inside", std::vector<std::int32_t>{of.inside});
        std::vector<double> tension, place, moments, pulls;
        std::vector<std::uint32_t> sample, places;
        for (std::size_t k = 0; k < cables; ++k) {
          tension.push_back(of.tension[k] * pipeline::believable_share * force[k].strength());
          place.push_back(k == 2 ? -1 : 0.1 * double(v) + 0.01 * double(k));
          sample.push_back(static_cast<std::uint32_t>(10 * v + k + wrong_sample));
        }
        for (std::size_t span = 0; span < spans; ++span) {
          moments.insert(moments.end(),
                         {of.moment[span] * pipeline::believable_share * hose_moment(v, span), hose_moment(v, span)});
          places.insert(places.end(), {static_cast<std::uint32_t>(10 * v + 5 + span),
                                       static_cast<std::uint32_t>(2 - span + wrong_cable)});
          pulls.push_back(span == 0 ? 12 : -13);
        }
        file.append("/variation/tension", tension), file.append("/variation/tension_place", place);
        file.append("/variation/tension_sample", sample);
        file.append("/variation/clamp_moment", moments), file.append("/variation/clamp_moment_place", places);
        file.append("/variation/clamp_moment_tension", pulls);
      }
      for (const char* name : {"job", "history", "input_sha256"}) file.attribute(name, "");
      file.commit();
    }
    const pipeline::FileReader strain(path, format);
    const std::vector<std::int32_t> span(cables, 0);
    return use(strain, FileCables{facts, force, span});
  }
  std::optional<pipeline::Remedy> remedy() const {
    return with_file([&](const auto& strain, const FileCables& of) { return slack_remedy(strain, job, of, own); });
  }
  std::vector<pipeline::Warning> warnings() const {
    return with_file([&](const auto& strain, const FileCables& of) {
      return varied_force_warnings(strain, job, of, own, slack_remedy(strain, job, of, own));
    });
  }
  std::string text() const {
    std::string words;
    for (const pipeline::Warning& warning : warnings()) words += warning.line() + "\n";
    return words;
  }
  Variation& add(std::size_t parameter, double z) {
    all.emplace_back().z[parameter] = z;
    return all.back();
  }
};

double largest(const std::array<double, cables>& tension) {
  double most = 0;
  for (const double one : tension) most = std::max(most, std::abs(one));
  return most;
}

/// Returns the share of dresspacks above the limit, by steps through the distribution of z. load: at -reach, 0 and reach.
double counted(const std::array<double, 3>& load, double reach, double deviation) {
  double beyond = 0;
  constexpr double step = 1e-3;
  for (double u = -8; u < 8; u += step) {
    const double z = u * deviation, slope = z < 0 ? (load[1] - load[0]) / reach : (load[2] - load[1]) / reach;
    if (load[1] + slope * z > 1) beyond += pipeline::normal_density(u) * step;
  }
  return beyond;
}

double number_after(const std::string& text, const std::string& words) {
  const std::size_t at = text.find(words);
  return at == std::string::npos ? 0 : std::stod(text.substr(at + words.size()));
}

}  // namespace

TEST_CASE("forces at other values: the share, the leading cause and its worst cable are those of all variations") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> of_load(0, 1.6);
  const std::vector<std::pair<std::size_t, double>> nodes{
      {hose_friction, 1.5}, {slack, 1.5}, {play, 1.5}, {grip, 1.5}, {stiffness, 1.65}};
  int warned = 0, several = 0;
  Varied varied;
  varied.job.uncertainty.spread[slack] = 2.25,
  varied.job.uncertainty.spread[grip] = std::sqrt(2.0);  // deviations of z: 2 and 0.5
  varied.job.strain.factors.hose_friction = 0.5, varied.job.strain.factors.slack = 1.1,
  varied.job.strain.factors.play = 1.2;
  varied.job.strain.factors.grip = 1.3, varied.job.simulation.stiffness_factor = 1.4;
  const std::vector<double> own_values{0.5, 1.1, 1.2, 1.3, 1.4}, deviations{1, 2, 1, 0.5, 1};
  for (int round = 0; round < 30; ++round) {
    varied.all.clear();
    double within = 1, most = 0;
    std::string expected;
    int causes = 0;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const auto [parameter, reach] = nodes[k];
      std::array<double, 3> load{0, 0.5, 0};
      std::size_t worst = 0;
      for (const int side : {0, 2}) {
        Variation& at = varied.add(parameter, (side - 1) * reach);
        for (double& tension : at.tension) tension = (random() % 2 ? 1 : -1) * of_load(random);
        load[std::size_t(side)] = largest(at.tension);
        if (worst == 0 || load[std::size_t(side)] > load[0]) worst = varied.all.size();
      }
      const double share = std::max(load[0], load[2]) > 1 ? counted(load, reach, deviations[k]) : 0;
      if (share < 0.01) continue;
      within *= 1 - share, ++causes;
      if (share <= most) continue;
      most = share;
      const Variation& at = varied.all[worst - 1];
      std::size_t cable = 0;
      for (std::size_t c = 1; c < cables; ++c)
        if (std::abs(at.tension[c]) > std::abs(at.tension[cable])) cable = c;
      const double value = pipeline::uncertain_parameters()[parameter].value(at.z[parameter]);
      expected = fmt::format("{}: {:.3g}) 'cable {}' is {} with {:.0f} % of its breaking force",
                             pipeline::uncertain_parameters()[parameter].key, own_values[k] * value, cable + 1,
                             at.tension[cable] < 0 ? "compressed" : "pulled",
                             100 * pipeline::believable_share * std::abs(at.tension[cable]));
      const std::size_t sample = 10 * (worst - 1) + cable;
      expected += "\n" + (cable == 2 ? std::string("over its whole length")
                                     : fmt::format("{:.2f} m from the base clamp",
                                                   0.1 * double(worst - 1) + 0.01 * double(cable)));
      expected += fmt::format("\nat {:.3f} s, program step {} '{}'", 0.5 * double(sample), sample % 2 + 1,
                              sample % 2 ? "odd" : "even");
    }
    const std::string text = varied.text();
    INFO(text);
    if (most == 0) {
      CHECK(text == "");
      continue;
    }
    ++warned, several += causes > 1;
    for (std::size_t begin = 0; begin < expected.size();) {
      const std::size_t end = std::min(expected.find('\n', begin), expected.size());
      CHECK_THAT(text, Catch::Contains(expected.substr(begin, end - begin)));
      begin = end + 1;
    }
    constexpr double whole_percent = 0.55;  // the text has whole per cents; the integral's step adds 0.04
    CHECK(number_after(text, "; about ") == Approx(100 * (1 - within)).margin(whole_percent));
    if (causes > 1) CHECK(number_after(text, " exceed this limit (") == Approx(100 * most).margin(whole_percent));
    CHECK(pipeline::count_of(text, "in the distribution") == 1);
    CHECK(pipeline::count_of(text, " % with ") == std::size_t(causes - 1));
  }
  CHECK(warned > 10);
  CHECK(several > 5);
}

TEST_CASE("forces at other values: of two parameters together only if neither exceeds the limit by itself") {
  Varied varied;
  for (const std::size_t parameter : {slack, play}) varied.add(parameter, -1.5).tension = {0.6, 0.2, -0.7};
  Variation& both = varied.add(slack, -1.5);
  both.z[play] = 1.5, both.tension = {1.5, -0.9, 0};
  // The load is 1 half-way from the job's 0.5 to 1.5: at -0.75 and 0.75, each with a quarter of the standard normal distribution.
  const double share = std::pow(pipeline::normal_share(-0.75), 2);
  CHECK_THAT(varied.text(), Catch::Contains("(strain.slack_factor: 0.544) and 1.7 times") &&
                                Catch::Contains("(strain.play_factor: 1.66) 'cable 1' is pulled") &&
                                Catch::Contains(fmt::format("about {:.0f} % of such dresspacks", 100 * share)));
  varied.all[1].tension[2] = -1.4;  // play by itself
  CHECK_THAT(varied.text(), Catch::Contains("(strain.play_factor: 0.604) 'cable 3' is compressed") &&
                                !Catch::Contains("slack_factor"));
  varied.all[1].tension[2] = 0, varied.all[2].tension[0] = 1;  // at the limit, not beyond it
  CHECK(varied.text() == "");
}

TEST_CASE("forces at other values: rests count by their starts, and variations inside cables count nothing") {
  Varied varied;
  varied.rest_of_start = {0, 0, 1, 2, 2, 2, 0, 1};
  for (const int rest : {1, 2}) varied.add(slack, 0).rest = rest;
  varied.all[0].tension = {0, 1.2, 0}, varied.all[1].tension = {0.9, 0.9, 0.9};
  CHECK_THAT(varied.text(),
             Catch::Contains("with another of the places at which the loose cables come to rest 'cable 2' is pulled") &&
                 Catch::Contains("about 25 % of such dresspacks"));
  varied.all[1].tension = {0.9, 0.9, -1.1};
  CHECK_THAT(varied.text(), Catch::Contains("about 62 % of such dresspacks") && Catch::Contains("'cable 2' is pulled"));
  for (Variation& of : varied.all) of.inside = 1;
  CHECK(varied.text() == "");
  for (Variation& of : varied.all) of.inside = 0, of.rest = 0, of.z[index_of(Uncertain::friction_inside)] = 1;
  CHECK(varied.text() == "");
}

TEST_CASE(
    "forces at other values: moments at a clamp name their span, moment and cable, and limits that the job exceeds are left out") {
  Varied varied;
  varied.add(grip, -1.5).moment = {0.3, 0.9}, varied.add(grip, 1.5).moment = {1.3, 1.9};
  // The larger load is 0.9, 0.4 and 1.9 at -1.5, 0 and 1.5: it is 1 at -1.8 and 0.6.
  CHECK_THAT(
      varied.text(),
      Catch::Contains(
          "bend a clamp with 0.38 times the moment of the hose (3.80 of 10.0 N m, limit 0.2 times) at 8.000 s, program step "
          "1 'even', which is unrealistic; 'cable 2' presses most, with 13.0 N") &&
          Catch::Contains(fmt::format("about {:.0f} % of such",
                                      100 * (pipeline::normal_share(-0.6) + pipeline::normal_share(-1.8)))));
  varied.all[1].moment = {1.9, 1.3};
  CHECK_THAT(varied.text(), Catch::Contains("(1.14 of 3.00 N m") &&
                                Catch::Contains("at 7.500 s, program step 2 'odd'") &&
                                Catch::Contains("'cable 3' pulls most, with 12.0 N"));
  varied.all[1].tension = {0, 0, 3};
  CHECK(varied.warnings().size() == 2);
  varied.own.moment = 1.01 * pipeline::believable_share;
  CHECK_THAT(varied.text(), !Catch::Contains("bend a clamp"));
  varied.own.force = 1.01 * pipeline::believable_share;
  CHECK(varied.text() == "");
  varied.own = {}, varied.job.uncertainty.enabled = false;
  CHECK(varied.text() == "");
}

TEST_CASE("forces at other values: a sample or a cable outside the file is refused") {
  Varied varied;
  varied.add(grip, 1.5);
  const auto refusal = [&] { return pipeline::message_of([&] { varied.warnings(); }); };
  varied.wrong_sample = 17;  // the last cable's sample is 19, the last of the file
  CHECK(refusal() == "");
  varied.wrong_sample = 18;
  CHECK_THAT(refusal(), Catch::Contains("of variation 1 has a sample or a cable that is not in the file"));
  varied.wrong_sample = 0, varied.wrong_cable = 1;
  CHECK_THAT(refusal(), Catch::Contains("of variation 1 has a sample or a cable that is not in the file"));
}

namespace {

/// Three cables with 1, 2 and no slack, and loads of both limits over the z of the slack: geometric between those at -1.5, 0 and 1.5.
struct Slack : Varied {
  explicit Slack(const std::array<double, 3>& loads) : load(loads) {
    for (std::size_t k = 0; k < 2; ++k) job.dresspacks[0].dresspack.components[k].laying.slack = double(k + 1);
    lay(0);
  }
  double at(double z) const { return load[1] * std::pow((z < 0 ? load[0] : load[2]) / load[1], std::abs(z) / 1.5); }
  /// The run with another slack.
  void lay(double shift) {
    all.clear();
    for (const double z : {-1.5, 1.5}) {
      Variation& of = add(slack, z);
      of.tension = {0, at(z + shift), 0}, of.moment = {0, at(z + shift)};
    }
    own.force = own.moment = at(shift) * pipeline::believable_share;
  }
  std::array<double, 3> load;
};

}  // namespace

TEST_CASE("forces at other values: the slack of all cables together that cures them, and the next run has no warning") {
  Slack tight({1.4, 0.5, 0.2});
  // The load at -1.5 + 0.5 is 1.4 (0.5 / 1.4)^(1/3) = 0.993, and at -1.5 + 0.45 1.028. 1.5^0.5 = 1.22.
  CHECK_THAT(tight.text(),
             Catch::Contains(
                 "too little slack: 1.09 % instead of 2 %. Remedy: dresspack.components.1.slack_percent: 1.3 "
                 "and dresspack.components.2.slack_percent: 2.5 (now 1, 2; all of them, by the forces at "
                 "0.54 .. 1.8 times the slack of all cables together; more slack rubs more, so jackets wear through "
                 "sooner)\n"));
  const std::vector<pipeline::KeyValue> cure{{"dresspack.components.1.slack_percent", "1.3"},
                                             {"dresspack.components.2.slack_percent", "2.5"}};
  REQUIRE(tight.warnings().size() == 2);  // of the force and of the moment at a clamp
  for (const pipeline::Warning& warning : tight.warnings()) CHECK(warning.remedy == cure);
  tight.lay(0.5);
  CHECK(tight.text() == "");
  tight.lay(0);
  tight.job.dresspacks[0].dresspack.components[1].laying.slack = 4.5;  // 1.22 times 4.5 % is more than any usual slack
  const std::vector<pipeline::KeyValue> with_measurement = tight.remedy()->values;
  REQUIRE(with_measurement.size() == 3);
  CHECK(std::stod(with_measurement[1].value) < 5);
  CHECK(with_measurement[2] == pipeline::KeyValue{"uncertainty.slack", "1.16"});
}

TEST_CASE("forces at other values: a force of the job's own values is cured by the slack of all cables, too") {
  Slack loose({0.2, 1.1, 2});
  CHECK(loose.text() == "");  // of the job's own values dresslife-fatigue warns elsewhere
  const std::vector<pipeline::KeyValue> values = loose.remedy()->values;
  REQUIRE(values.size() >= 2);
  CHECK(std::stod(values[0].value) < 1);
  CHECK(std::stod(values[1].value) < 2);
}

TEST_CASE("forces at other values: friction on the hose is cured by a slack, too") {
  Slack rough({0.9, 0.5, 0.2});
  rough.add(hose_friction, 1.5).tension = {0, 1.4, 0};
  // 1.25 times 1.4 becomes 1 where the load without friction falls from 0.5 to 0.286, at 0.92. 1.5^0.95 = 1.47.
  CHECK_THAT(
      rough.text(),
      Catch::Contains("friction keeps the cable from moving its slack to the bends that need it. Remedy: "
                      "dresspack.components.1.slack_percent: 1.5 and dresspack.components.2.slack_percent: 3 ("));
  for (pipeline::Component& cable : rough.job.dresspacks[0].dresspack.components) cable.laying.slack = 0;
  CHECK_THAT(rough.text(), Catch::Contains("Remedy: dresspack.components.2.slack_percent (run dresslife-strain"));
}

TEST_CASE(
    "forces at other values: a slack between too little and too much is measured, and without such a slack the bore is too small") {
  Slack narrow({0.9, 0.5, 1.3});
  CHECK_THAT(narrow.text(),
             Catch::Contains("too much slack: 3.67 % instead of 2 %. Remedy: uncertainty.slack: 1.16, if this "
                             "measurement confirms the job's values: The length of each cable measured against the "
                             "hose (half an hour). No slack keeps the limits without it") &&
                 !Catch::Contains("slack_percent"));
  narrow.job.uncertainty.spread[slack] = 1.16;
  CHECK(narrow.text() == "");
  // A softer hose at less slack exceeds the limit. A run with a measured stiffness has a hose that is nearer to the job's own.
  Slack soft({0.9, 0.5, 0.9});
  Variation& both = soft.add(slack, -1.5);
  both.z[stiffness] = -1.65, both.tension = {0, 4, 0};
  const std::vector<pipeline::KeyValue> known{{"uncertainty.slack", "1.16"}, {"uncertainty.hose_stiffness", "1.16"}};
  CHECK(soft.remedy()->values == known);
  const Slack none({1.5, 0.9, 1.5});
  CHECK_THAT(
      none.text(),
      Catch::Contains(
          "Remedy: no slack keeps the limits of force and moment (by the forces at 0.54 .. 1.8 times "
          "the slack of all cables together; with the best, 1 times, 50 % of such dresspacks exceed one): a hose with "
          "a larger bore or a stiffer wall, softer cables") &&
          !Catch::Contains("uncertainty.slack"));  // it was tried
  CHECK(none.remedy()->values.empty());
}
