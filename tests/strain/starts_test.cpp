// The choice among rests of loose cables (W40).
#include "strain/starts.h"

#include <algorithm>
#include <cmath>
#include <list>

#include "pipeline/base/constants.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/settings/document.h"
#include "tests/catch.h"
#include "tests/pipeline/sample_job.h"

using namespace dresslife;
using strain::Evaluation;
using strain::Starts;

namespace {

constexpr std::size_t segments = 8, samples = 2;

pipeline::Job ring_job() {
  std::string text = pipeline::sample_job;
  const auto replace = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace("helix_radius_mm: 18.45\n", "helix_radius_mm: 18.45\n      slack_percent: 2\n");
  replace("  damping_time_ms: 10\n", "  damping_time_ms: 10\n  inner_diameter_mm: 52\n");
  replace("slip: [stick, free]", "slip: free");
  return pipeline::job_from(pipeline::parse_yaml(text, "job.yaml"), {});
}

/// Four starts of a ring. Starts with equal seeds come to one rest.
struct FourStarts {
  pipeline::Job job = ring_job();
  strain::Construction construction{job.dresspacks[0].dresspack, job.strain.kinematics};
  std::list<Starts::Spans> all;  // (start)
  Starts starts;

  explicit FourStarts(const std::vector<std::uint64_t>& seeds)
      : starts(build(), [&]() -> Starts::Spans& { return build(); }) {
    strain::DeformationHistory history(segments, samples);
    for (std::size_t segment = 0; segment < segments; ++segment)
      for (std::size_t t = 0; t < samples; ++t) history.set(segment, t, {2, 0, 0, 0});
    std::vector<Evaluation*> evaluations;
    for (Starts::Spans& spans : all) evaluations.push_back(spans[0].get());
    for (std::size_t start = 0; start < seeds.size(); ++start) evaluations[start]->wind(seeds[start]);
    Evaluation::add(evaluations, {history});
    starts.merge();
  }
  Starts::Spans& build() {
    const std::vector<double> lengths(segments, 0.15);
    all.emplace_back().push_back(std::make_unique<Evaluation>(construction, job.strain, lengths, samples));
    return all.back();
  }
  const Evaluation* own() const { return starts.spans(0)[0].get(); }
};

}  // namespace

TEST_CASE("a rest to which most starts came is the median one for any damages") {
  for (const std::vector<std::uint64_t>& seeds : {std::vector<std::uint64_t>{1, 1, 2, 1}, {1, 2, 2, 2}}) {
    const std::size_t frequent = seeds[1] == 2;
    FourStarts by_number(seeds);
    REQUIRE(by_number.starts.rests() == 2);
    const Evaluation* const expected = by_number.starts.spans(frequent)[0].get();
    CHECK_FALSE(by_number.starts.choose_by_number(-2));  // near the most damaged start the damages decide
    CHECK_FALSE(by_number.starts.choose_by_number(2));
    CHECK(by_number.starts.choose_by_number(0));
    CHECK(by_number.own() == expected);
    for (const std::vector<double>& damage : {std::vector<double>{1, 2}, {2, 1}}) {
      FourStarts by_damage(seeds);
      const Evaluation* const same = by_damage.starts.spans(frequent)[0].get();
      by_damage.starts.choose(0, damage);
      CHECK(by_damage.own() == same);
      CHECK(by_damage.starts.rest_of() == by_number.starts.rest_of());
    }
  }
  FourStarts even({1, 1, 2, 2});
  REQUIRE(even.starts.rests() == 2);
  CHECK_FALSE(even.starts.choose_by_number(0));
}

namespace {

constexpr std::size_t cycle = 40;  // samples

/// Returns a repeat of a motion that moves all segments alike.
strain::DeformationHistory one_repeat() {
  strain::DeformationHistory history(segments, cycle);
  for (std::size_t segment = 0; segment < segments; ++segment)
    for (std::size_t t = 0; t < cycle; ++t) {
      const double w = 2 * dresslife::pi * static_cast<double>(t) / cycle;
      history.set(segment, t, {1.5 + 0.5 * std::sin(w), 0.8 * std::cos(w), 1.2 * std::sin(w), 0});
    }
  return history;
}

}  // namespace

TEST_CASE("cables stop in a lead-in when the rest of it would change them by less than 1 %") {
  constexpr int repeats = 60;
  pipeline::Job job = ring_job();
  const strain::Construction construction(job.dresspacks[0].dresspack, job.strain.kinematics);
  const strain::DeformationHistory history = one_repeat();
  const auto build = [&] { return Evaluation(construction, job.strain, std::vector<double>(segments, 0.15), cycle); };
  const auto repeat = [&](Evaluation& evaluation, double further) {
    Evaluation* const alone = &evaluation;
    Evaluation::lead_in({&alone, 1}, {history});
    Evaluation::end_repeat({&alone, 1}, further);
    return evaluation.cables().in_cycle();
  };
  double after_one = 0;  // distance from the cycle after one repeat, the largest of all seeds
  for (const std::uint64_t seed : {1, 2, 3}) {
    Evaluation once = build(), stops = build(), goes_on = build();
    for (Evaluation* const evaluation : {&once, &stops, &goes_on}) evaluation->wind(seed);
    CHECK_FALSE(repeat(once, 0));  // no repeat before to compare with
    int done = 1;
    while (!repeat(stops, repeats - done)) ++done;
    for (int k = 0; k < repeats; ++k) CHECK_FALSE(repeat(goes_on, HUGE_VAL));
    INFO("seed " << seed << ": " << done << " repeats");
    CHECK(done < 10);
    CHECK(stops.cables().apart(goes_on.cables()) < 1e-2);
    after_one = std::max(after_one, once.cables().apart(goes_on.cables()));
  }
  CHECK(after_one > 1e-2);
}

TEST_CASE("cables into which slack is fed do not stop in a lead-in") {
  pipeline::Job job = ring_job();
  const strain::Construction construction(job.dresspacks[0].dresspack, job.strain.kinematics);
  pipeline::StrainFactors more;
  more.slack = 1.5;
  const strain::Construction longer(job.dresspacks[0].dresspack, job.strain.kinematics, more);
  job.strain.cable_elements = 4;  // of both
  const strain::DeformationHistory history = one_repeat();
  const std::vector<double> lengths(segments, 0.15);
  Evaluation own(construction, job.strain, lengths, cycle), fed(longer, job.strain, lengths, cycle);
  own.wind(3);
  const auto in_cycle_after = [&](Evaluation& evaluation, int repeats) {
    Evaluation* const alone = &evaluation;
    for (int k = 0; k < repeats; ++k) {
      Evaluation::lead_in({&alone, 1}, {history});
      Evaluation::end_repeat({&alone, 1}, 0);
    }
    return evaluation.cables().in_cycle();
  };
  REQUIRE(in_cycle_after(own, 2));
  fed.go_on_from(own);
  constexpr double of_repeat = cycle * 0.04;                   // [s]
  constexpr int while_fed = static_cast<int>(15 / of_repeat);  // slack is fed in over 15 s
  CHECK_FALSE(in_cycle_after(fed, while_fed));
  CHECK(in_cycle_after(fed, 2));
}

TEST_CASE("an evaluation that follows the motion again has the strains of one that followed it before as a lead-in") {
  pipeline::Job job = ring_job();
  const strain::Construction construction(job.dresspacks[0].dresspack, job.strain.kinematics);
  const strain::DeformationHistory history = one_repeat();
  for (const pipeline::Slip slip : {pipeline::Slip::free, pipeline::Slip::friction}) {
    job.strain.slip = {slip};
    std::vector<std::vector<float>> strains;  // (evaluation)
    std::vector<double> changed;
    for (const bool again : {false, true}) {
      Evaluation evaluation(construction, job.strain, std::vector<double>(segments, 0.15), cycle);
      Evaluation* const alone = &evaluation;
      evaluation.wind(3);
      evaluation.record_rubbing();
      if (again) {
        evaluation.add({history});
        evaluation.repeat();
      } else {
        Evaluation::lead_in({&alone, 1}, {history});
        Evaluation::end_repeat({&alone, 1}, 0);
      }
      evaluation.add({history});
      evaluation.end_first_pass();
      if (evaluation.wants_again()) evaluation.add_again(history);
      changed.push_back(evaluation.cables().changed());
      std::vector<float>& own = strains.emplace_back();
      strain::Sink sink;
      sink.sites = [&](const strain::SiteRows& rows) { own.insert(own.end(), rows.strain.begin(), rows.strain.end()); };
      sink.bound_stick = sink.bound_free = [](const strain::SiteRows&) {};
      sink.probe = [](const strain::Probe&) {};
      for (std::size_t segment = 0; segment < segments; ++segment) evaluation.evaluate(segment, history, segment, sink);
    }
    CHECK(strains[0].size() > 500);
    CHECK(strains[0] == strains[1]);
    CHECK(changed[0] == changed[1]);
    CHECK(changed[0] > 0);
  }
}
