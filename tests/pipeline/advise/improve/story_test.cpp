// What a search says of its results.
#include "pipeline/advise/improve/story.h"

#include "tests/catch.h"

namespace dresslife::pipeline {
namespace {

/// A search of two trials beside the job as it is, which lives 1,000 h.
struct Searched {
  Improvement found;
  Finals finals;
  explicit Searched(double best_hours) {
    const auto trial = [](double hours, const std::string& set) {
      Trial one;
      if (!set.empty()) one.sets = {set};
      one.worst.hours = hours;
      one.worst.beyond.assign(outcome_limits, -1.0);
      return one;
    };
    found.name = "job";
    found.freed = {"routing.free_length_m"}, found.own = {"0.9"};
    found.trials = {trial(1000, ""), trial(best_hours, "routing.free_length_m=0.95")};
    found.front = {0};
    finals.of = {Final{{"before"}, 1000}, Final{{"final_0001"}, best_hours, 1}};
  }
  std::string words() const { return improvement_words(found, finals, {}, SecondAim::none, 0, {}); }
};

}  // namespace

TEST_CASE("improve: the changes of a trial are listed only if it lives longer") {
  const std::string shorter = Searched(800).words();
  CHECK(shorter ==
        "As it is: 1,000 h, all limits kept\nNothing that was tried lives longer. Keep the job as it is. The best of 2 trials, trial 1: "
        "800 h.\n");
  const std::string longer = Searched(1500).words();
  CHECK_THAT(longer, Catch::Contains("Trial 1 of 2: 1,500 h") && Catch::Contains("--set 'routing.free_length_m=0.95'") &&
                         !Catch::Contains("Nothing that was tried"));
}

}  // namespace dresslife::pipeline
