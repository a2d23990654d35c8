// The build graph with stages that are shell scripts: what runs when, and what a failure does.
#include "pipeline/study/build_graph.h"

#include <catch2/catch.hpp>
#include <thread>

#include "tests/pipeline/sample_job.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

/// Writes its settings and its input into its output, leaves an equal output untouched, as the real stages
/// do.
const std::string fake_stage = R"(#!/bin/sh
name=$(basename "$0"); stage=${name#dresslife-}
input=$1
while [ $# -gt 0 ]; do [ "$1" = -o ] && output=$2; shift; done
folder=$(dirname "$output")
echo "$stage" >> "$folder/calls"
if [ -e "$folder/fail-$stage" ]; then echo "note first"; echo "job.yaml:1:1: error: $stage broke; mend it"; exit 1; fi
{ cat "$folder/.stage/$stage.yaml"; [ "$stage" = sim ] || cat "$input"; } > "$output.part"
if cmp -s "$output.part" "$output"; then rm "$output.part"; else mv "$output.part" "$output"; fi
)";

class Bench {
 public:
  Bench() {
    for (const char* stage : {"sim", "strain", "fatigue"}) write_stage(stage, fake_stage);
    places_ = {scratch_ / "re sults $x 'y' a:b/study", scratch_ / "pro grams $x 'q'"};
  }
  void write_stage(const std::string& stage, const std::string& text) {
    const auto file = scratch_.write("pro grams $x 'q'/dresslife-" + stage, text);
    fs::permissions(file, fs::perms::owner_all);
  }
  Study study(const std::vector<std::pair<std::string, std::string>>& jobs) const {
    Study made;
    made.name = "study";
    for (const auto& [name, set] : jobs)
      made.jobs.push_back({name, job_from(parse_yaml(sample_job, "job.yaml"), {set}), ""});
    return made;
  }
  BuildResult run(const Study& of, bool dry = false) {
    // File times are the graph's clock; a change within the same tick of it would not be seen.
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    write_build_graph(of, places_);
    return run_build_graph(places_, 2, dry,
                           [this](const BuildEvent& event) { events_.push_back(event.what); });
  }
  std::string calls(const std::string& job) const {
    std::string text = bytes_of(places_.job(job) / "calls");
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
  }
  const StudyPlaces& places() const { return places_; }
  const std::vector<std::string>& events() const { return events_; }
  const Scratch& scratch() const { return scratch_; }

 private:
  Scratch scratch_;
  StudyPlaces places_;
  std::vector<std::string> events_;
};

TEST_CASE("build graph: every stage of every job runs once, in folders of any name") {
  Bench bench;
  const Study study = bench.study({{"one", "simulation.segments=20"}, {"two", "simulation.segments=40"}});
  const BuildResult result = bench.run(study);
  CHECK(result.executed == 6);
  CHECK(result.failures.empty());
  CHECK(bench.calls("one") == "sim strain fatigue ");
  CHECK(bench.calls("two") == "sim strain fatigue ");
  CHECK(bytes_of(bench.places().job("two") / "job.yaml") == job_text(study.jobs[1].job));
  CHECK(std::count(bench.events().begin(), bench.events().end(), "fatigue two") == 1);
  CHECK(bench.run(study).executed == 0);
  CHECK(bench.calls("one") == "sim strain fatigue ");
}

TEST_CASE("build graph: a changed setting reruns what depends on it and nothing else") {
  Bench bench;
  bench.run(bench.study({{"one", "simulation.segments=20"}, {"two", "simulation.segments=40"}}));
  CHECK(bench.run(bench.study({{"one", "fatigue.stress=elastic"}, {"two", "simulation.segments=40"}}))
            .executed == 1);
  CHECK(bench.calls("one") == "sim strain fatigue fatigue ");
  CHECK(bench.calls("two") == "sim strain fatigue ");
  CHECK(bench.run(bench.study({{"one", "strain.gate=0.01"}, {"two", "simulation.segments=40"}})).executed ==
        2);
  CHECK(bench.run(bench.study({{"one", "motion.zone_deg=3"}, {"two", "simulation.segments=40"}})).executed ==
        3);
  CHECK(bench.calls("two") == "sim strain fatigue ");
}

TEST_CASE("build graph: an output that comes out the same ends the chain") {
  Bench bench;
  const Study study = bench.study({{"one", "simulation.segments=20"}});
  bench.run(study);
  fs::remove(bench.places().job("one") / "motion.h5");
  bench.run(study);
  // The motion is new to the graph's clock, the strain made from it is not.
  CHECK(bench.calls("one") == "sim strain fatigue sim strain ");
}

TEST_CASE(
    "build graph: a program built anew with other bytes reruns its stage, with the same bytes nothing") {
  Bench bench;
  const Study study = bench.study({{"one", "simulation.segments=20"}});
  bench.run(study);
  bench.write_stage("strain", fake_stage);
  CHECK(bench.run(study).executed == 0);
  bench.write_stage("strain", fake_stage + "# newer\n");
  CHECK(bench.run(study).executed == 1);
  CHECK(bench.calls("one") == "sim strain fatigue strain ");
}

TEST_CASE("build graph: a failed stage stops its job only, is told with its reason and tried again") {
  Bench bench;
  const Study study = bench.study({{"bad", "simulation.segments=20"}, {"good", "simulation.segments=40"}});
  bench.scratch().write(
      fs::relative(bench.places().job("bad"), bench.scratch() / ".").string() + "/fail-strain", "");
  const BuildResult result = bench.run(study);
  CHECK(result.failures ==
        std::map<std::string, std::string>{{"bad", "job.yaml:1:1: error: strain broke; mend it"}});
  CHECK(bench.calls("bad") == "sim strain ");
  CHECK(bench.calls("good") == "sim strain fatigue ");
  CHECK(pending_state(study.jobs[0], bench.places()) ==
        "failed   job.yaml:1:1: error: strain broke; mend it");
  join_logs(study, bench.places());
  CHECK(bytes_of(bench.places().job("bad") / "log").find("== dresslife-strain\nnote first\n") !=
        std::string::npos);
  fs::remove(bench.places().job("bad") / "fail-strain");
  const BuildResult again = bench.run(study);
  CHECK(again.failures.empty());
  CHECK(bench.calls("bad") == "sim strain strain fatigue ");
}

TEST_CASE("build graph: a stage that is killed is told") {
  Bench bench;
  bench.write_stage("sim", "#!/bin/sh\nkill -9 $$\n");
  const BuildResult result = bench.run(bench.study({{"one", "simulation.segments=20"}}));
  REQUIRE(result.failures.count("one") == 1);
  CHECK(result.failures.at("one") == "it was killed (out of memory?)");
}

TEST_CASE("build graph: a stage that fails without a word is told") {
  Bench bench;
  bench.write_stage("sim", "#!/bin/sh\nexit 3\n");
  CHECK(bench.run(bench.study({{"one", "simulation.segments=20"}})).failures.at("one") ==
        "it ended without a word (killed?)");
}

TEST_CASE("build graph: a dry run tells what is pending and runs nothing") {
  Bench bench;
  const Study study = bench.study({{"one", "simulation.segments=20"}, {"two", "simulation.segments=40"}});
  bench.run(study);
  const Study changed = bench.study({{"one", "fatigue.stress=elastic"}, {"two", "simulation.segments=40"}});
  const BuildResult result = bench.run(changed, true);
  CHECK(result.pending == std::vector<std::string>{"one"});
  CHECK(bench.calls("one") == "sim strain fatigue ");
  CHECK(pending_state(changed.jobs[0], bench.places()) == "stale");
}

TEST_CASE("build graph: jobs that cannot be run are left out, programs that are not there refused") {
  Bench bench;
  Study study = bench.study({{"one", "simulation.segments=20"}});
  study.jobs.push_back({"broken", {}, "why"});
  CHECK(bench.run(study).executed == 3);
  CHECK_FALSE(fs::exists(bench.places().job("broken")));
  StudyPlaces nowhere = bench.places();
  nowhere.programs = bench.scratch() / "nowhere";
  CHECK(message_of([&] { write_build_graph(study, nowhere); }) ==
        (nowhere.programs / "dresslife-sim").string() +
            ": error: is not there (the stages stand beside dresslife); build it: scripts/build");
}

}  // namespace
}  // namespace dresslife::pipeline
