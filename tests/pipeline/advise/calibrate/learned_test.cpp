// From rows of a ranking to the numbers of a calibration, against closed forms.
#include "pipeline/advise/calibrate/learned.h"

#include <Eigen/LU>
#include <array>
#include <cmath>

#include "pipeline/advise/calibrate/emulation.h"
#include "pipeline/advise/calibrate/learned_walls.h"
#include "pipeline/advise/calibrate/learning.h"
#include "pipeline/base/statistics.h"
#include "pipeline/job/job.h"
#include "pipeline/life/first_failure.h"
#include "pipeline/study/ranking.h"
#include "tests/catch.h"
#include "tests/pipeline/life/straight_response.h"
#include "tests/pipeline/sample_job.h"
#include "tests/pipeline/sample_life.h"
#include "tests/pipeline/sample_strain.h"
#include "tests/pipeline/scratch.h"

using namespace dresslife::pipeline;

namespace {

constexpr double decile = 1.2815515655446004;  // of a normal distribution, in deviations

/// Returns the job of a row.
std::string indented_job() {
  std::string text, line;
  for (std::istringstream lines(sample_job); std::getline(lines, line);)
    text += line.empty() ? "" : "      " + line + "\n";
  return text;
}

struct Made {
  /// centre: of every parameter [deviations].
  explicit Made(const std::string& observed, double centre = 0, bool typical = false) {
    tests = read_observed_tests(
        scratch.write("o.yaml", "observations:\n  - name: bench\n    what: bent\n    source: a book\n" + observed +
                                    "    job:\n" + indented_job()));
    tests[0].typical = typical;
    round.emplace(tests, std::vector<std::string>{}, "round", Eigen::VectorXd::Constant(uncertain_count, centre),
                  Eigen::VectorXd::Constant(uncertain_count, 0.5));
  }
  /// Returns a row of the only job: half have failed after `median` hours; the deviation of ln life is `spread`.
  RankingRow row(double median, double spread) const {
    RankingRow made;
    made.job = round->study().jobs.at(0).name;
    made.repeat_seconds = 36, made.worst_segment_from_tool = 1;
    made.conductor_hours = {median * std::exp(-decile * spread), median, median * std::exp(decile * spread)};
    return made;
  }
  Scratch scratch;
  std::vector<ObservedTest> tests;
  std::optional<RoundOfJobs> round;
};

}  // namespace

TEST_CASE("learned: a life without a response is that of its row, with the spread of its deciles") {
  const Made hours("    hours: 300\n");
  const StudyPlaces places{hours.scratch.folder(), {}};
  for (const double spread : {0.2, 0.9}) {
    const auto made = emulate(hours.tests, *hours.round, {hours.row(500, spread)}, places);
    REQUIRE(made.size() == 1);
    REQUIRE(made[0].life);
    CHECK(made[0].life->log_life == Approx(std::log(300)));
    REQUIRE(made[0].life->variants.size() == 1);
    const LifeAt life = made[0].life->variants[0](Eigen::VectorXd::Constant(uncertain_count, 0.7));
    CHECK(life.log_median == Approx(std::log(500)));
    CHECK(life.spread == Approx(spread));
  }
  // 36 s per repeat with two cycles: 200 cycles per hour.
  const Made cycles("    cycles: 300\n    cycles_per_repeat: 2\n");
  const auto made = emulate(cycles.tests, *cycles.round, {cycles.row(500, 0.4)}, places);
  CHECK(made[0].life->variants[0](Eigen::VectorXd::Zero(uncertain_count)).log_median == Approx(std::log(500 * 200)));
}

TEST_CASE("learned: the response of a row counts from the parameters that the row was computed at") {
  LifeResponse bent = straight_response(0.1, 0.2, 0.3);
  for (std::size_t k = 0; k < bent.worst_life.size(); ++k)
    if (k % bent.strength.size() == 0) bent.worst_life[k] -= 0.5;  // steeper for weaker wires
  std::vector<LifeAt> lives;
  for (const double centre : {0.0, 0.25, 1.0}) {
    const Made made("    hours: 300\n", centre, true);
    RankingRow row = made.row(500, 0.4);
    row.life_response = bent.text();
    const auto emulated = emulate(made.tests, *made.round, {row}, {made.scratch.folder(), {}});
    lives.push_back(emulated[0].life->variants[0](Eigen::VectorXd::Constant(uncertain_count, centre - 0.8)));
  }
  CHECK(lives[0].log_median < std::log(500));
  CHECK(lives[0].between > 0);
  for (const LifeAt& life : {lives[1], lives[2]}) {
    CHECK(life.log_median == Approx(lives[0].log_median));
    CHECK(life.spread == Approx(lives[0].spread));
    CHECK(life.between == Approx(lives[0].between));
  }
}

TEST_CASE("learned: a life counts from the median of all rests, not from the rest of the job") {
  constexpr std::size_t rest = index_of(Uncertain::rest);
  constexpr double slope = 0.4;  // [decades]
  const auto at_rest = [&](double mean, double median = 5) {
    LifeResponse response = straight_response(0, 0, 0, median);
    for (const double z : {-5.0, 5.0}) {  // beyond all values: lives end at the outermost rests
      response.points.emplace_back()[rest] = z, response.inside.push_back(Inside::as_is);
      response.worst_life.insert(response.worst_life.end(), response.strength.size(),
                                 response.worst_life.front() + slope * z);
    }
    response.knowledge.mean[rest] = mean;
    return response.text();
  };
  const double ln10 = std::log(10.0);
  for (const double centre : {0.0, 0.25}) {
    Made made("    hours: 300\n    vary: {routing.free_length_m: [1.2, 1.3]}\n", centre);
    Eigen::VectorXd z = Eigen::VectorXd::Constant(own_spread_place + 1, centre);
    z[rest] = 0.3, z[own_spread_place] = own_spread_as_is;
    std::vector<RankingRow> rows;
    for (const std::size_t k : {0u, 1u}) {
      RankingRow& row = rows.emplace_back(made.row(500, 0.4));
      row.job = made.round->study().jobs.at(k).name;
      row.life_response = at_rest(k == 0 ? 0.5 : -1.0);
    }
    const StudyPlaces places{made.scratch.folder(), {}};
    const auto alone = emulate(made.tests, *made.round, rows, places).at(0).life->variants;
    CHECK(alone.at(0)(z).log_median == Approx(std::log(500) + slope * (0.5 + 0.3) * ln10));
    CHECK(alone.at(1)(z).log_median == Approx(std::log(500) + slope * (-1.0 + 0.3) * ln10));
    // In service each dresspack has its own rest. 1e5 repeats of 36 s under each program alone, in equal shares of the time.
    made.tests[0].observation.service = {{200, 0, true}};
    for (ObservedTest::Variant& program : made.tests[0].variants) program.share_of_time = 0.5;
    made.round.emplace(made.tests, std::vector<std::string>{}, "round",
                       Eigen::VectorXd::Constant(uncertain_count, centre), Eigen::VectorXd::Ones(uncertain_count));
    const auto own = emulate(made.tests, *made.round, rows, places).at(0).life->variants;
    double mean = 0;
    const double median = std::log(1000 / (0.5 * std::pow(10, -0.5 * slope) + 0.5 * std::pow(10, 1.0 * slope)));
    for (const LifeVariant& each : own) mean += each(z).log_median / double(own.size());
    // The own values of rest and motion have a mean of 0, and ln life is linear in both.
    CHECK(mean == Approx(median).margin(1e-6));
  }
}

TEST_CASE("learned: the likelihood of a life has all that an observation states, and its words have what moves it") {
  const double ln10 = std::log(10.0), spread = 0.5;
  for (const auto& [outcome, end] : {std::pair("broken", LifeEnd::broken),
                                     {"broken_by", LifeEnd::at_most},
                                     {"run_out", LifeEnd::at_least},
                                     {"rating", LifeEnd::at_least}}) {
    Made made(std::string("    hours: 300\n    unshared_log10: 0.2\n    outcome: ") + outcome + "\n");
    made.tests[0].observation.specimens = 3;
    RankingRow row = made.row(500, spread);
    row.failing_mode = "wires of lead", row.failing_mode_share = 0.75;
    row.life_response = straight_response(0.1, 0.2, 0.3).text();
    const EmulatedTest test = emulate(made.tests, *made.round, {row}, {made.scratch.folder(), {}}).at(0);
    const Fatigue& fatigue = made.round->study().jobs[0].job->fatigue;
    CHECK(test.life->end == end);
    CHECK(test.life->specimens == (outcome == std::string("rating") ? 1 : 3));
    CHECK(test.life->unshared_spread == Approx(0.2 * ln10));
    CHECK(test.life->common_share ==
          Approx(fatigue.scatter_shared * std::pow(fatigue.scatter_log10 * ln10 / spread, 2)));
    CHECK(test.fails_first == "wires of lead, 75 %");
    CHECK(test.moved_by ==
          "motion 3.7, model 2.0, strength 2.0, slack 1.6");  // no friction: its cables are glued or free
  }
  // Of dresspacks in service: 1e5 repeats of 36 s, four fifths of the time, and 2e5 of 72 s, one fifth. Own values have a mean of 0.
  for (const double centre : {0.0, 0.25}) {
    Made made("    hours: 300\n    vary: {routing.free_length_m: [1.2, 1.3]}\n", centre);
    made.tests[0].observation.service = {{200, 0, true}};
    made.tests[0].variants[0].share_of_time = 0.8, made.tests[0].variants[1].share_of_time = 0.2;
    made.round.emplace(made.tests, std::vector<std::string>{}, "round",
                       Eigen::VectorXd::Constant(uncertain_count, centre), Eigen::VectorXd::Ones(uncertain_count));
    std::vector<RankingRow> rows;
    for (const std::size_t k : {0u, 1u}) {
      RankingRow& row = rows.emplace_back(made.row(1000, 0.4));
      row.job = made.round->study().jobs.at(k).name, row.repeat_seconds = k == 0 ? 36 : 72;
      row.life_response = straight_response(0, 0.2, 0.3, std::log10(k == 0 ? 1e5 : 2e5)).text();
    }
    const EmulatedTest test = emulate(made.tests, *made.round, rows, {made.scratch.folder(), {}}).at(0);
    CHECK(test.moved_by ==
          "motion (each dresspack's own) 3.7, model 2.0, strength 2.0, slack (each dresspack's own) 1.6");
    for (const double strength : {-0.8, 0.0, 0.5}) {
      Eigen::VectorXd z = Eigen::VectorXd::Constant(own_spread_place + 1, centre), narrow = z;
      z[index_of(Uncertain::strength)] += strength;
      z[own_spread_place] = own_spread_as_is, narrow[own_spread_place] = own_spread_z(0.5);
      double mean = 0, variance = 0, narrowed = 0;
      for (const LifeVariant& each : test.life->variants)
        mean += each(z).log_median / double(test.life->variants.size());
      for (const LifeVariant& each : test.life->variants) {
        variance += std::pow(each(z).log_median - mean, 2);
        narrowed += std::pow(each(narrow).log_median - (mean - 0.3 * ln10 * strength), 2);
        CHECK(each(narrow).spread < each(z).spread);
      }
      CHECK(std::sqrt(narrowed / variance) == Approx(0.5).epsilon(1e-5));
      const double per_hour = 0.8 * 3600 / 36 / 1e5 + 0.2 * 3600 / 72 / 2e5;
      CHECK(mean == Approx(-std::log(per_hour) + 0.3 * ln10 * strength).epsilon(1e-5));
    }
  }
}

TEST_CASE(
    "learned: of straight responses the posterior, and what each test says of the other, are those of normal distributions") {
  Made made("    hours: 300\n    unshared_log10: 0.2\n");
  // With the default deviations, and of jobs that state a measured strength and no uncertainty of the motion.
  const bool stated = GENERATE(false, true);
  CAPTURE(stated);
  if (stated) made.tests[0].variants[0].job["uncertainty"] = parse_yaml("{strength: 1.1, motion: 1}", "stated");
  ObservedTest other = made.tests[0];
  other.observation.name = other.variants[0].name = "other";
  other.variants[0].job["routing"]["free_length_m"] = parse_yaml("1.3", "other");
  made.tests.push_back(other);
  // ln life = ln 500 + k z, and its deviation with what each test has of its own, of both tests.
  constexpr std::array<double, 2> scatter{0.5, 0.7}, of_strength{0.3, 0.15};
  // The second test's life depends on slack, so it has the residual of the response.
  const std::array<double, 2> spread{std::hypot(0.5, 0.2 * std::log(10.0)),
                                     std::hypot(0.7, 0.2 * std::log(10.0), residual_decades * std::log(10.0))};
  const auto place = [](Uncertain parameter) { return Eigen::Index(index_of(parameter)); };
  std::array<Eigen::VectorXd, 2> k;
  for (const std::size_t t : {0u, 1u}) {
    k[t] = Eigen::VectorXd::Zero(uncertain_count);
    k[t][place(Uncertain::strength)] = of_strength[t] * std::log(10.0);
    k[t][place(Uncertain::slack)] = t == 0 ? 0 : -0.2 * std::log(10.0);
    k[t][place(Uncertain::model)] = std::log(2.0), k[t][place(Uncertain::motion)] = std::log(3.7);
  }
  std::array<double, 2> observed{300, 900};
  for (const std::size_t t : {0u, 1u}) made.tests[t].observation.hours = observed[t];
  const StudyPlaces places{made.scratch.folder() / "round", {}};
  const Learned learned = learn(made.tests, {}, places, [&](const Study& study) {
    std::vector<RankingRow> rows;
    for (const std::size_t t : {0u, 1u}) {
      RankingRow& row = rows.emplace_back(made.row(500, scatter[t]));
      row.job = study.jobs.at(t).name, row.failing_mode = t == 0 ? "wires of a" : "wires of b",
      row.failing_mode_share = 1;
      row.life_response = straight_response(0, t == 0 ? 0 : 0.2, of_strength[t]).text();
      SampleLife life;
      life.segments = 4, life.lines = 1, life.samples = 3;
      std::filesystem::create_directories(places.job(row.job));
      write_sample_life(places.life(row.job), life);
      write_sample_strain(places.job(row.job) / "strain.h5", sample_job, t == 0 ? 0.4 : 0.5, 0);
    }
    return rows;
  });
  REQUIRE(learned.rounds == 1);  // the rows above are those of the first centre
  CHECK(learned.settled);
  struct Normal {
    Eigen::MatrixXd covariance;
    Eigen::VectorXd mean;
  };
  const auto of_tests = [&](const std::vector<std::size_t>& which) {
    Eigen::MatrixXd information = Eigen::MatrixXd::Identity(uncertain_count, uncertain_count);
    if (stated) {
      information(place(Uncertain::strength), place(Uncertain::strength)) = std::pow(std::log(1.3) / std::log(1.1), 2);
      information(place(Uncertain::motion), place(Uncertain::motion)) = 1e12;  // known
    }
    Eigen::VectorXd moved = Eigen::VectorXd::Zero(uncertain_count);
    for (const std::size_t t : which) {
      information += k[t] * k[t].transpose() / std::pow(spread[t], 2);
      moved += k[t] * std::log(observed[t] / 500) / std::pow(spread[t], 2);
    }
    return Normal{information.inverse(), information.inverse() * moved};
  };
  const Normal both = of_tests({0, 1});
  constexpr double of_mean = 0.09, of_spread = 0.06;  // of draws worth 1,500 (posterior_test.cpp)
  const LearnedWithin& within = learned.calibration.within;
  CHECK(within.largest_curvature.value() == Approx(0.5));
  CHECK(within.largest_twist.value() == Approx(2).epsilon(1e-3));
  CHECK(within.least_strain_range.value() == Approx(0.018));  // of sample_life.h
  CHECK_FALSE(within.fewest_cycles);
  std::size_t i = 0, shared = 0;
  for (std::size_t p = 0; p < uncertain_count; ++p) {
    INFO(uncertain_parameters()[p].name);
    if (!learned.axes[p].learned) {
      CHECK(both.mean[Eigen::Index(p)] == Approx(0).margin(1e-9));
      continue;
    }
    const auto at = Eigen::Index(i++), all = Eigen::Index(p);
    const double deviation = std::sqrt(both.covariance(all, all)),
                 before = std::sqrt(of_tests({}).covariance(all, all));
    CHECK(learned.posterior.laplace.most_likely[at] == Approx(both.mean[all]).margin(1e-3));
    CHECK(learned.posterior.mean[at] == Approx(both.mean[all]).margin(of_mean * deviation));
    CHECK(learned.axes[p].narrowed == Approx(deviation / before).epsilon(of_spread));
    CHECK(learned.axes[p].before[0] == Approx(uncertain_parameters()[p].value(-decile * before)));
    // The next dresspack has its own slack, grip, rest and motion.
    if (uncertain_parameters()[p].shared == SharedBy::installation) continue;
    const LearnedParameter& kept = learned.calibration.parameters.at(shared++);
    CHECK(kept.covariance.size() == learned.calibration.parameters.size());
    CHECK(kept.covariance.at(shared - 1) == Approx(learned.posterior.covariance(at, at)).margin(1e-6));
    CHECK(kept.name == uncertain_parameters()[p].name);
    CHECK(kept.mean == Approx(learned.posterior.mean[at]).margin(1e-6));
    CHECK(kept.value == Approx(learned.axes[p].after[1]).epsilon(1e-3));
    CHECK(kept.value_p10 == Approx(learned.axes[p].after[0]).epsilon(1e-3));
    CHECK(kept.value_p90 == Approx(learned.axes[p].after[2]).epsilon(1e-3));
  }
  CHECK(shared == learned.calibration.parameters.size());
  CHECK(shared < i);
  for (const std::size_t t : {0u, 1u}) {
    const LearnedTest& test = learned.tests[t];
    INFO(test.observation.name);
    CHECK(test.fails_first == (t == 0 ? "wires of a, 100 %" : "wires of b, 100 %"));
    if (stated)
      CHECK(test.moved_by == (t == 0 ? "model 2.0, strength 1.3" : "model 2.0, slack 1.6, strength 1.1"));
    else
      CHECK(test.moved_by ==
            (t == 0 ? "motion 3.7, model 2.0, strength 2.0" : "motion 3.7, model 2.0, slack 1.6, strength 1.4"));
    const auto check = [&](const PredictedDeciles& deciles, const Normal& of) {
      const double middle = std::log(500) + k[t].dot(of.mean),
                   deviation = std::hypot(std::sqrt(k[t].dot(of.covariance * k[t])), spread[t]);
      // Deciles of 2,000 draws are known to 4 % of the deviation, three times that.
      for (int side : {-1, 0, 1})
        CHECK(std::log(deciles[std::size_t(side + 1)]) ==
              Approx(middle + side * decile * deviation).margin(0.12 * deviation));
    };
    check(test.before, of_tests({}));
    check(test.after, both);
    check(test.by_others, of_tests({1 - t}));
  }
}

TEST_CASE("learned: each parameter that a test depends on has its own quantiles and its own width") {
  const Made hours("    hours: 300\n");
  const Axes axes(*hours.round);
  REQUIRE(axes.size() >= 2);
  Posterior posterior;
  posterior.covariance = Eigen::MatrixXd::Constant(axes.size(), axes.size(), 0.01);
  posterior.median.resize(axes.size());
  for (Eigen::Index i = 0; i < axes.size(); ++i) {
    posterior.covariance(i, i) = std::pow(0.1 * double(i + 1), 2);
    posterior.median[i] = 0.05 * double(i + 1);
  }
  posterior.low = posterior.median.array() - 0.3;
  posterior.high = posterior.median.array() + 0.4;
  const std::vector<LearnedAxis> learned = learned_axes(posterior, axes);
  REQUIRE(learned.size() == uncertain_count);
  std::size_t found = 0;
  for (std::size_t p = 0; p < uncertain_count; ++p) {
    const UncertainParameter& parameter = uncertain_parameters()[p];
    CHECK(learned[p].before[0] == Approx(parameter.value(-decile)));
    CHECK(learned[p].before[1] == Approx(parameter.value(0)));
    CHECK(learned[p].before[2] == Approx(parameter.value(decile)));
    if (!learned[p].learned) {
      CHECK(learned[p].after == learned[p].before);
      CHECK(learned[p].narrowed == 1);
      continue;
    }
    const double place = double(++found);
    CHECK(learned[p].narrowed == Approx(0.1 * place));
    CHECK(learned[p].after[0] == Approx(parameter.value(0.05 * place - 0.3)));
    CHECK(learned[p].after[1] == Approx(parameter.value(0.05 * place)));
    CHECK(learned[p].after[2] == Approx(parameter.value(0.05 * place + 0.4)));
  }
  CHECK(found == static_cast<std::size_t>(axes.size()));
}

TEST_CASE("learned: a surprise is counted in deviations of its own side, and only where the outcome bounds that side") {
  LearnedTest test;
  test.before = {100, 200, 800};  // ln 2 and ln 4 to the deciles
  const auto surprise_of = [&](double hours, ObservedEnd end) {
    test.observation.hours = hours;
    test.observation.outcome = end;
    return surprise(test);
  };
  CHECK(surprise_of(200, ObservedEnd::broken) == 0);
  CHECK(surprise_of(50, ObservedEnd::broken) == Approx(2 * decile));
  CHECK(surprise_of(3200, ObservedEnd::broken) == Approx(2 * decile));
  CHECK(surprise_of(50, ObservedEnd::run_out) == 0);  // a run-out agrees with any longer life
  CHECK(surprise_of(3200, ObservedEnd::run_out) == Approx(2 * decile));
  CHECK(surprise_of(50, ObservedEnd::broken_by) == Approx(2 * decile));
  CHECK(surprise_of(3200, ObservedEnd::broken_by) == 0);  // a break found late agrees with any earlier break
  test.before[2] = std::numeric_limits<double>::infinity();
  CHECK(surprise_of(50, ObservedEnd::broken) == 0);
  test.before[2] = 800;
  test.observation = {};
  test.observation.stiffness = 1;
  CHECK(surprise(test) == 0);  // a measured 0 has no logarithm
}

TEST_CASE("learned: the largest moment of a loop is as surprising in either direction") {
  const auto surprise_of = [](double measured, PredictedDeciles before) {
    LearnedTest test;
    test.observation.bending = "loop.csv";
    test.measured = measured, test.before = before;
    return surprise(test);
  };
  const double above = surprise_of(0.07, {0.01, 0.02, 0.04}), below = surprise_of(0.005, {0.01, 0.02, 0.04});
  CHECK(above > 2);
  CHECK(below > 2);
  CHECK(surprise_of(-0.07, {-0.04, -0.02, -0.01}) == Approx(above));
  CHECK(surprise_of(-0.005, {-0.04, -0.02, -0.01}) == Approx(below));
  CHECK(std::isinf(surprise_of(-0.02, {0.01, 0.02, 0.04})));  // in the wrong direction
}

TEST_CASE("learned: a row that only the other rows contradict has a note") {
  const Made hours("    hours: 300\n");
  const Axes axes(*hours.round);
  const auto notes_of = [&](const PredictedDeciles& by_others) {
    Learned learned;
    learned.posterior.covariance = Eigen::MatrixXd::Identity(axes.size(), axes.size());
    learned.posterior.median = learned.posterior.laplace.most_likely = Eigen::VectorXd::Zero(axes.size());
    LearnedTest test;
    test.observation.name = "flex";
    test.observation.hours = 100;
    test.observation.outcome = ObservedEnd::broken;
    test.before = {10, 200, 4000};
    test.by_others = by_others;
    learned.tests.push_back(test);
    add_doubts(learned, axes);
    return learned.notes;
  };
  CHECK(notes_of({50, 200, 800}).empty());  // ln 2 is as far as the decile
  const std::vector<std::string> notes = notes_of({1000, 2000, 8000});
  REQUIRE(notes.size() == 1);
  CHECK(notes[0].find("'flex' contradicts the other observations, which predict 1,000 (2,000, 8,000)") == 0);
}

TEST_CASE("learned: a row that the model does not reproduce after it learned from it has a warning") {
  EmulatedTest curve;
  Measurement& measured = curve.bending.emplace_back();
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(1);
  measured.log_quantities.emplace_back(0 * one, one, 0, -one, one);  // ln of the quantity is z
  const auto misfit_at = [&](std::size_t points, double off) {
    measured.numbers.assign(points, {1 + off, 0.1, {{0, 1.0}}});
    return least_misfit(curve, Eigen::Vector2d(0, -1));  // the first sample is nearer
  };
  CHECK(misfit_at(1, 0.2) == Approx(2));
  CHECK(usual_misfit(curve) == Approx(3).epsilon(0.02));
  CHECK(misfit_at(10, -0.2) == Approx(2));
  CHECK(usual_misfit(curve) == Approx(std::sqrt(2.69)).epsilon(0.02));  // chi^2 of ten numbers: 26.9 for 1 of 370
  LearnedTest test;
  test.observation.name = "loop", test.observation.bending = "loop.csv";
  test.measured = 0.037, test.after = {0.027, 0.028, 0.03};
  test.misfit = 1.6, test.usual_misfit = 1.64;
  CHECK(misfit_of(test).empty());
  test.misfit = 3.5;
  CHECK_THAT(misfit_of(test), Catch::Contains("'loop'") && Catch::Contains("observed a largest moment of 0.0370 N m") &&
                                  Catch::Contains("by 3.5 times its noise_percent (limit 1.6)") &&
                                  Catch::Contains("instead of the curve"));
  LearnedTest life;
  life.observation.name = "flex", life.observation.hours = 100, life.observation.outcome = ObservedEnd::broken;
  for (const double deviations : {2.9, 3.1}) {  // the lower decile is half of the middle
    life.after[1] = 100 * std::pow(2, deviations / normal_decile);
    life.after[0] = life.after[1] / 2, life.after[2] = 2 * life.after[1];
    CHECK(misfit_of(life).empty() == (deviations < 3));
  }
}

TEST_CASE("learned: runs repeat the doubt of an observation that is farther off than 1 of 100") {
  LearnedTest test;
  test.observation.name = "flex";
  test.observation.hours = 100;
  test.observation.outcome = ObservedEnd::broken;
  const auto off_by = [&](double deviations) {  // the lower decile is half of the middle
    test.before = {100, 200, 400};
    test.by_others[1] = 100 * std::pow(2, deviations / normal_decile);
    test.by_others[0] = test.by_others[1] / 2, test.by_others[2] = 2 * test.by_others[1];
    return doubt_of(test, 2.6);
  };
  CHECK(off_by(2.59).empty());
  CHECK_THAT(off_by(2.61), Catch::Contains("'flex' contradicts the other observations"));
}

TEST_CASE("learned: hoses that had not cracked move the strength of their wall as the closed form says") {
  // One hose survived until ln life = 9; ln median life = 8 + 2 z, deviation 0.5. With c = 2/0.5 and b = (8 - 9)/0.5 the
  // likelihood is Phi(b + c z). With q = b/sqrt(1 + c^2) the mean of z is c/sqrt(1 + c^2) phi(q)/Phi(q).
  EmulatedTest hose;
  hose.walls["wall"].service = {{9, false, 1}};
  hose.walls["wall"].variants = {[](const Eigen::VectorXd& z) {
    return LifeAt{8 + 2 * z[index_of(Uncertain::strength)], 0.5};
  }};
  const auto walls = learned_walls({hose, EmulatedTest{}});
  REQUIRE(walls.size() == 1);
  const double b = -2, c = 4, root = std::hypot(1, c), q = b / root, rate = normal_density(q) / normal_share(q);
  CHECK(walls[0].mean == Approx(c / root * rate).epsilon(1e-4));
  CHECK(walls[0].deviation == Approx(std::sqrt(1 - c * c / (1 + c * c) * rate * (rate + q))).epsilon(1e-4));
  CHECK(walls[0].low < walls[0].median);
  CHECK(walls[0].median < walls[0].high);
  CHECK(learned_walls({EmulatedTest{}}).empty());
}

TEST_CASE("learned: a life says of the hoses' walls that they lived at least as long") {
  Made made("    hours: 300\n    outcome: run_out\n    specimens: 4\n");
  LifeResponse wall = straight_response(0, 0, 1.5);
  wall.mode = UnvalidatedMode::wall, wall.material = "wall strength of pa (0.01 1000)";
  SampleLife life;
  life.wall_response = modes_text({wall});
  RankingRow row = made.row(500, 0.4);
  row.life_file = made.scratch / "life.h5";
  write_sample_life(row.life_file, life);
  const auto walls_of = [&](const Made& of) {
    return emulate(of.tests, *of.round, {row}, {of.scratch.folder(), {}}).at(0).walls;
  };
  const auto walls = walls_of(made);
  REQUIRE(walls.size() == 1);
  const ObservedLife& lived = walls.at(wall.material);
  REQUIRE(lived.service.size() == 1);
  CHECK(lived.service[0].log_age == Approx(std::log(300)));
  CHECK(lived.service[0].count == 4);
  CHECK_FALSE(lived.service[0].failed);
  Eigen::VectorXd stronger = Eigen::VectorXd::Zero(own_spread_place + 1);
  stronger[index_of(Uncertain::strength)] = 1;
  // 1e5 repeats of 36 s; a deviation is 1.5 decades. The median factor of the motion is 1.
  double median = 0;
  for (const LifeVariant& each : lived.variants) {
    median += each(Eigen::VectorXd::Zero(uncertain_count)).log_median / double(lived.variants.size());
    CHECK(each(stronger).log_median - each(Eigen::VectorXd::Zero(uncertain_count)).log_median ==
          Approx(1.5 * std::log(10)));
  }
  CHECK(median == Approx(std::log(1e5 * 36 / 3600)));
  // Records of a plant: one failed by its wires; one was installed before the records began.
  Made plant("    hours: 300\n");
  plant.tests[0].observation.service = {{200, 0, true}, {300, 100, false}};
  plant.round.emplace(plant.tests, std::vector<std::string>{}, "round", Eigen::VectorXd::Zero(uncertain_count),
                      Eigen::VectorXd::Ones(uncertain_count));
  const auto service = walls_of(plant).at(wall.material).service;
  REQUIRE(service.size() == 3);
  constexpr double within = 0.025;  // ages are grouped within 5 %
  for (const auto& [k, hours, count] :
       {std::tuple{0u, 100.0, -1}, std::tuple{1u, 200.0, 1}, std::tuple{2u, 300.0, 1}}) {
    CHECK(service[k].log_age == Approx(std::log(hours)).margin(within));
    CHECK(service[k].count == count);
    CHECK_FALSE(service[k].failed);
  }
  Made rated("    hours: 300\n    outcome: rating\n");
  CHECK(walls_of(rated).empty());
  Made below("    hours: 300\n    outcome: broken_by\n");
  CHECK(walls_of(below).empty());  // the wires failed first, so there is no information about the hose
}

TEST_CASE(
    "learned: failures of a plant are as likely as Poisson's numbers, and those in use reach their ages as often as new ones") {
  // Lives with known median and deviation of ln: one failed, two survive, one of them installed before the records began.
  constexpr double median = 1000, spread = 0.8;
  const std::vector<ServiceRecord> records{{800, 0, true}, {1500, 0, false}, {3000, 2000, false}};
  const auto alive = [&](double hours) { return normal_share(std::log(median / hours) / spread); };
  ObservedLife life;
  life.variants.push_back([](const Eigen::VectorXd&) { return LifeAt{std::log(median), spread}; });
  life.service = {{std::log(800.0), true, 1},
                  {std::log(1500.0), false, 1},
                  {std::log(3000.0), false, 1},
                  {std::log(2000.0), false, -1}};
  const ServiceChance chance = service_chance(life, records, Eigen::MatrixXd::Zero(3, uncertain_count));
  const double mean = -std::log(alive(800) * alive(1500) * alive(3000) / alive(2000));
  CHECK(chance.few == Approx(std::exp(-mean) * (1 + mean)).epsilon(1e-9));
  CHECK(chance.many == Approx(1 - std::exp(-mean)).epsilon(1e-9));
  CHECK(chance.reach == Approx(alive(2000)).epsilon(0.06));  // ages in a group differ by 2.5 %, S by 2.3 times as much
  // 1,000 failures where 1,000 are expected: half of the plants have fewer, half more, by the normal limit within 0.6/sqrt(1,000).
  ObservedLife large;
  large.variants = life.variants;
  const double log_age = std::log(median);  // half live longer: each expects ln 2 failures
  large.service = {{log_age, true, 1000}, {log_age, false, static_cast<int>(std::lround(1000 / std::log(2.0))) - 1000}};
  const ServiceChance even = service_chance(large, {{median, 0, true}}, Eigen::MatrixXd::Zero(1, uncertain_count));
  CHECK(even.few == Approx(0.5).margin(0.02));
  CHECK(even.many == Approx(0.5).margin(0.02));
  CHECK(service_chance(life, {{3000, 0, false}}, Eigen::MatrixXd::Zero(1, uncertain_count)).reach == 1);
}
