// The report of a search about its results.
#include "pipeline/advise/improve/story.h"

#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::pipeline {
namespace {

using Modes = std::vector<ModeLife>;

struct Life {
  double hours;
  Modes modes{};
};

/// A search with trials; the first trial is the job as it is.
struct Searched {
  Improvement found;
  Finals finals;
  explicit Searched(const std::vector<Life>& lives, std::optional<double> longer_in = {}) : longer_in_(longer_in) {
    found.name = "job";
    found.freed = {"routing.free_length_m"}, found.own = {"0.9"};
    found.front = {0};
    for (std::size_t k = 0; k < lives.size(); ++k) {
      Trial& one = found.trials.emplace_back();
      if (k > 0) one.sets = {"routing.free_length_m=0.95"};
      one.worst.hours = lives[k].hours, one.worst.modes = lives[k].modes, one.worst.robot_life = 40000;
      one.worst.beyond.assign(outcome_limits, -1.0);
    }
    for (std::size_t k = 0; k < lives.size(); ++k)
      finals.of.push_back(Final{{k == 0 ? "before" : "final"}, lives[k].hours, k, found.merit(k)});
  }
  ImprovementStory story() const {
    ImprovementStory of = story_of(found, finals, SecondAim::none, {});
    if (!longer_in_) return of;
    of.longer_in = longer_in_;
    of.gain = gain_words(finals.best()->merit, found.trials[finals.best()->trial].worst, finals.of.front().merit,
                         found.trials.front().worst, longer_in_);
    return of;
  }
  std::string words(const MountingTolerance& tolerance = tolerance_of(0, 0)) const {
    // Long lines are broken, with four blanks before their further parts.
    return replaced_all(
        replaced_all(improvement_words(found, finals, story(), SecondAim::none, tolerance, {}), "\n    --", "\n--"),
        "\n    ", " ");
  }

 private:
  std::optional<double> longer_in_;
};

Searched searched_of(const std::vector<Life>& lives, std::optional<double> longer_in = {}) {
  return Searched(lives, longer_in);
}

TEST_CASE("improve: the changes of a trial are listed only if it is clearly better") {
  CHECK(
      searched_of({{1000}, {800}}).words() ==
      "As it is: 1,000 h, all limits kept\nKeep the job as it is. Nothing that was tried is clearly better. The best of it is trial 1 of 2: "
      "800 h, all limits kept\nThe wires live 0.8 times as long. First of the modes that are not validated: none in the robot's life "
      "(as it is: none in the robot's life).\n");
  CHECK_THAT(searched_of({{1000}, {1050}}).words(),
             Catch::Contains("Keep the job as it is") && !Catch::Contains("--set"));
  CHECK_THAT(searched_of({{1000}, {1500}}).words(),
             Catch::Contains("\nTrial 1 of 2: 1,500 h") && Catch::Contains("--set 'routing.free_length_m=0.95'") &&
                 Catch::Contains("The wires live 1.5 times as long") && !Catch::Contains("Keep the job"));
}

TEST_CASE("improve: a life beyond the robot's is no gain, and what a gain costs stands beside it") {
  const Modes own{{"abrasion", HUGE_VAL}, {"jacket wear", 5890}};
  // Trial 1 wears the hose through, trial 2 reduces the wear of the jacket.
  const std::string words = searched_of({{449000, own},
                                         {1940000, {{"abrasion", 25000}, {"jacket wear", 8750}}},
                                         {654000, {{"abrasion", HUGE_VAL}, {"jacket wear", 9110}}}})
                                .words();
  CHECK_THAT(
      words,
      Catch::Contains("As it is: 449,000 h, all limits kept; not validated: jacket wear from 5,890 h\n") &&
          Catch::Contains("\nTrial 2 of 3: 654,000 h, all limits kept; not validated: jacket wear from 9,110 h\n") &&
          Catch::Contains(
              "In both the wires outlive the robot (40,000 h). A longer life of the wires is no gain. First of the "
              "modes that are not validated: jacket wear after 9,110 h (as it is: jacket wear after 5,890 h).\n") &&
          Catch::Contains(
              "\nTrial 1 was not chosen: its wires live longer (1,940,000 h), but abrasion comes after 25,000 h "
              "(as it is: never).\n"));
  // With trial 1 only, the job as it is remains.
  CHECK_THAT(searched_of({{449000, own}, {1940000, {{"abrasion", 25000}, {"jacket wear", 8750}}}}).words(),
             Catch::Contains("Keep the job as it is") && Catch::Contains("Trial 1 was not chosen") &&
                 !Catch::Contains("--set"));
}

TEST_CASE("improve: a trial that alone keeps all limits and wears through earlier is not recommended") {
  Searched searched = searched_of({{9e5, {{"abrasion", 1790}}}, {9e5, {{"abrasion", 1100}}}});
  searched.found.trials[0].worst.beyond[0] = 0.02;
  searched.finals.of[0].merit = searched.found.merit(0);
  CHECK_THAT(
      searched.words(),
      Catch::Contains(
          "Nothing that was tried is recommended: what keeps all limits fails earlier than the job as it is. "
          "The best of it is trial 1 of 2: ") &&
          Catch::Contains("First of the modes that are not validated: abrasion after 1,100 h (as it is: abrasion after "
                          "1,790 h).") &&
          !Catch::Contains("--set"));
}

TEST_CASE("improve: a difference that few samples show is no clear one") {
  CHECK_THAT(
      searched_of({{1000}, {1500}}, 0.71).words(),
      Catch::Contains("The wires live 1.5 times as long. They live longer in 71 of 100 samples: no clear difference."));
  CHECK_THAT(searched_of({{1000}, {1500}}, 0.95).words(),
             Catch::Contains("They live longer in 95 of 100 samples. First"));
  CHECK_THAT(searched_of({{1000}, {90000}}, 0.95).words(),
             Catch::Contains("The wires live 40 times as long, up to the robot's life (40,000 h)."));
}

TEST_CASE("improve: a trial that is better as drawn and worse within the tolerance loses, and both lives are named") {
  Searched searched = searched_of({{1000}, {3000}, {2000}});
  const auto judge = [&](std::size_t k, double worst) {
    Outcome outcome = searched.found.trials[k].worst;
    outcome.hours = worst;
    searched.finals.of[k].tolerance =
        WithinTolerance{{{"length, + 10 mm", true, worst / searched.found.trials[k].worst.hours, "", "", 0}},
                        {0},
                        merit_of(outcome, searched.found.trials.front().worst),
                        outcome,
                        true};
  };
  judge(1, 50), judge(2, 1800);
  CHECK_THAT(
      searched.words(tolerance_of(10, 10)),
      Catch::Contains("\nTrial 2 of 3: 2,000 h") &&
          Catch::Contains("the wires live at least 0.9 times as long (length, + 10 mm)") &&
          Catch::Contains(
              "\nTrial 1 is better as drawn (3,000 h, all limits kept), but worse within that tolerance (50.0 h, all "
              "limits kept)\n"));
  // The job as it is wins if it is better within the tolerance.
  judge(2, 700), judge(0, 900);
  CHECK_THAT(searched.words(tolerance_of(10, 10)), Catch::Contains("Keep the job as it is") &&
                                                       !Catch::Contains("--set") &&
                                                       !Catch::Contains("The proposed job"));
  judge(0, 300);
  CHECK_THAT(
      searched.words(tolerance_of(10, 10)),
      Catch::Contains("\nTrial 2 of 3") && Catch::Contains("--set") &&
          Catch::Contains("The proposed job, within the mounting tolerance, at worst: 700 h, all limits kept\n"
                          "The job as it is, within the mounting tolerance, at worst: 300 h, all limits kept\n"));
  // The page agrees, also if both lives of the proposed job are shorter without deviation.
  searched.found.trials[2].worst.hours = searched.finals.of[2].hours = 900;
  const std::string chosen = improvement_page(searched.story());
  CHECK_THAT(
      chosen,
      Catch::Contains("<p>The wires live 0.9 times as long.") &&
          Catch::Contains("<p>The proposed job, within the mounting tolerance, at worst: 700 h, all limits kept</p>") &&
          Catch::Contains("<p>The job as it is, within the mounting tolerance, at worst: 300 h, all limits kept</p>"));
  judge(0, 900);
  CHECK_THAT(improvement_page(searched.story()),
             Catch::Contains("<p><b>Keep the job as it is. Nothing that was tried is clearly better") &&
                 Catch::Contains("<td>best of the trials</td>"));
}

}  // namespace
TEST_CASE("story: a remedy after a search names no clamps that were searched") {
  CHECK(
      remedy_after_search(
          "other clamps (`route` searches them; all): no length keeps it (best: 1 m; required: 2 m); or A: 1, which dresslife improve tries; or B: 2") ==
      "A: 1; or B: 2");
  CHECK(remedy_after_search("other clamps: no length keeps it").empty());
  CHECK(remedy_after_search("free_length_m: 2; or B: 2") == "free_length_m: 2; or B: 2");
}

TEST_CASE("story: a proposal states whether more dresspacks exceed a limit at other values than before") {
  const auto beyond = [](int percent) {
    Outcome of;
    of.exceeding = percent / 100.0;
    return of;
  };
  CHECK(
      beyond_words(beyond(44), beyond(29)) ==
      "Worse at other values than the job as it is. The limit that most dresspacks exceed at other values: 44 % of them (as it is: 29 %).\n");
  CHECK(beyond_words(beyond(10), beyond(29)) ==
        "The limit that most dresspacks exceed at other values: 10 % of them (as it is: 29 %).\n");
  CHECK(beyond_words(beyond(10), beyond(0)).find("Worse at other values than the job as it is.") == 0);
  CHECK(beyond_words(beyond(0), beyond(29)).empty());
  Outcome broken = beyond(5);
  broken.beyond = {0.2};
  CHECK(beyond_words(beyond(10), broken).empty());
}

TEST_CASE(
    "finals: no candidate that exceeds limits at other values more often is a gain, also if a mode of the job gets worse within "
    "the tolerance") {
  // Within the tolerance a mode of the original job gets worse, so its merit is no better than that of the candidates.
  const auto final_of = [](double hours, bool exceeds_more) {
    Final of;
    of.merit.kept = exceeds_more ? Kept::limits : Kept::modes;
    of.merit.counted_hours = of.merit.first_hours = of.merit.hours = hours;
    of.tolerance.emplace().whole = true;
    of.tolerance->worst = of.merit;
    of.tolerance->worst.kept = Kept::limits;
    of.exceeds_more = exceeds_more;
    return of;
  };
  Finals finals;
  finals.of = {final_of(7'000, false), final_of(80'000, true)};
  CHECK_FALSE(finals.is_gain(finals.of[1]));
  CHECK(finals.best() == &finals.of[1]);
  finals.of.push_back(final_of(20'000, false));
  CHECK(finals.best() == &finals.of[2]);
  CHECK(finals.is_gain(finals.of[2]));
}

}  // namespace dresslife::pipeline
