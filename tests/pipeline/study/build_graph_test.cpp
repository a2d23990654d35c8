// The build graph with stages that compute nothing: which stages run, the effect of failures, which results are valid.
#include "pipeline/study/build_graph.h"

#include <csignal>
#include <set>
#include <sstream>
#include <thread>

#include "pipeline/base/ownership.h"
#include "pipeline/files/checksum.h"
#include "pipeline/files/receipt.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/study/ranking.h"
#include "pipeline/study/shared_stages.h"
#include "tests/catch.h"
#include "tests/pipeline/sample_job.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

class Bench {
 public:
  explicit Bench(const std::string& folder = "re sults $x 'y' a:b|c\nd/study") {
    places_ = {scratch_ / folder, scratch_ / "pro grams $x 'q'|r\ns"};
    fs::create_directories(places_.programs);
    for (const char* stage : {"sim", "strain", "fatigue"}) write_stage(stage);
  }
  /// Writes a copy of the stage's program with `more` bytes at its end, which do not change its behaviour.
  void write_stage(const std::string& stage, const std::string& more = "") {
    const fs::path file = places_.programs / ("dresslife-" + stage);
    fs::copy_file(DRESSLIFE_FAKE_STAGE, file, fs::copy_options::overwrite_existing);
    std::ofstream(file, std::ios::app | std::ios::binary) << more;
  }
  void write_script(const std::string& stage, const std::string& text) {
    const fs::path file = places_.programs / ("dresslife-" + stage);
    fs::remove(file);
    std::ofstream(file) << text;
    fs::permissions(file, fs::perms::owner_all);
  }
  Study study(const std::vector<std::pair<std::string, std::string>>& jobs) const {
    Study made;
    made.name = "study";
    for (const auto& [name, set] : jobs) {
      const std::shared_ptr<const Job> job =
          std::make_shared<const Job>(job_from(parse_yaml(sample_job, "job.yaml"), {set}));
      made.jobs.push_back({name, job, ""});
    }
    return made;
  }
  /// Runs the study. between: called after the states were read and before a stage runs.
  BuildResult run(const Study& of, const std::function<void()>& between = {}) {
    Digests before;
    states_ = states_of(of, places_, before);
    if (between) between();
    write_build_graph(of, places_, states_);
    const BuildResult result =
        run_build_graph(places_, 2, [this](const BuildEvent& event) { events_.push_back(event.what); });
    close_run(of, places_, result, states_, before);
    return result;
  }
  /// Runs the study with results shared from other jobs' folders.
  BuildResult run_sharing(const Study& of) {
    std::vector<JobState> states = states_of(of, places_);
    share_stages(of, places_, states);
    return run(of);
  }
  std::vector<std::string> words(const Study& of) const {
    std::vector<std::string> said;
    for (const JobState& state : states_of(of, places_)) said.push_back(state.words().line());
    return said;
  }
  /// Returns the calls of a job's stages in their order.
  std::string calls(const std::string& job) const {
    std::string text = bytes_of(places_.job(job) / "calls");
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
  }
  void report_stage(const std::string& job, const std::string& order) const {
    fs::create_directories(places_.job(job));
    std::ofstream(places_.job(job) / order) << "";
  }
  /// Switches to another study's folder beside the current one.
  void go_beside(const std::string& name) { places_.folder = places_.folder.parent_path() / name; }
  const StudyPlaces& places() const { return places_; }
  const std::vector<std::string>& events() const { return events_; }
  const Scratch& scratch() const { return scratch_; }
  const std::vector<JobState>& states() const { return states_; }

 private:
  Scratch scratch_;
  StudyPlaces places_;
  std::vector<std::string> events_;
  std::vector<JobState> states_;
};

using Words = std::vector<std::string>;

TEST_CASE("build graph: every stage of every job runs once, in folders of any name") {
  Bench bench;
  const Study study = bench.study({{"one", "simulation.segments=20"}, {"two", "simulation.segments=40"}});
  CHECK(bench.words(study) == Words{"to do", "to do"});
  const BuildResult result = bench.run(study);
  CHECK(result.executed == 6);
  CHECK(result.words == "");
  CHECK(bench.words(study) == Words{"done", "done"});
  CHECK(bench.calls("one") == "sim strain fatigue ");
  CHECK(bench.calls("two") == "sim strain fatigue ");
  CHECK(without_mark(bytes_of(bench.places().job("two") / "job.yaml")) == job_text(*study.jobs[1].job));
  CHECK(std::count(bench.events().begin(), bench.events().end(), "fatigue two") == 1);
  CHECK(bench.run(study).executed == 0);
  CHECK(bench.calls("one") == "sim strain fatigue ");
}

TEST_CASE("build graph: a changed setting reruns what depends on it and nothing else") {
  Bench bench;
  bench.run(bench.study({{"one", "simulation.segments=20"}, {"two", "simulation.segments=40"}}));
  const auto run = [&](const std::string& set) {
    return bench.run(bench.study({{"one", set}, {"two", "simulation.segments=40"}})).executed;
  };
  CHECK(run("fatigue.stress=elastic") == 1);
  CHECK(bench.calls("one") == "sim strain fatigue fatigue ");
  CHECK(bench.calls("two") == "sim strain fatigue ");
  CHECK(run("strain.gate=0.01") == 2);
  CHECK(run("motion.zone_deg=3") == 3);
  CHECK(bench.calls("two") == "sim strain fatigue ");
}

TEST_CASE("build graph: a metal's strain-life constants rerun the last stage of the jobs that are of it alone") {
  Bench bench;
  const auto study_of = [&](int strength) {
    return bench.study({{"one", fmt::format("dresspack.materials=[{{name: copper, source: s, youngs_modulus_GPa: 117, "
                                            "tensile_strength_MPa: 230, fatigue_strength_MPa: {}, "
                                            "fatigue_strength_exponent: -0.1, fatigue_ductility: 0.5, "
                                            "fatigue_ductility_exponent: -0.5}}]",
                                            strength)},
                        {"two", "simulation.segments=40"}});
  };
  bench.run(study_of(400));
  CHECK(bench.words(study_of(500)) == Words{"stale", "done"});
  CHECK(bench.run(study_of(500)).executed == 1);
  CHECK(bench.calls("one") == "sim strain fatigue fatigue ");
  CHECK(bench.calls("two") == "sim strain fatigue ");
}

TEST_CASE("build graph: what a study does not keep goes when its job is done, and is not to do for that") {
  for (const Keep keep : {Keep::histories, Keep::lives}) {
    Bench bench;
    Study study = bench.study({{"one", "simulation.segments=20"}});
    study.keep = keep;
    const fs::path folder = bench.places().job("one");
    CHECK(bench.run(study).executed == 3);
    CHECK_FALSE(fs::exists(folder / "motion.h5"));
    CHECK(fs::exists(folder / "strain.h5") == (keep == Keep::histories));
    CHECK(fs::exists(folder / "life.h5") == (keep == Keep::histories));
    CHECK(bench.words(study) == Words{"done"});
    CHECK(bench.run(study).executed == 0);
    const std::vector<RankingRow> rows = ranking_of(study, bench.places(), states_of(study, bench.places()));
    REQUIRE(rows.at(0).done());
    CHECK(rows[0].life_hours > 0);

    // Another stress law needs strain.h5: the kept file, or one computed again from the start.
    Study other = bench.study({{"one", "fatigue.stress=elastic"}});
    other.keep = keep;
    CHECK(bench.words(other) == Words{"stale"});
    CHECK(bench.run(other).executed == (keep == Keep::histories ? 1 : 3));
    CHECK(bench.words(other) == Words{"done"});

    // With Keep::all the removed files are needed again.
    other.keep = Keep::all;
    CHECK(bench.words(other) == Words{keep == Keep::histories ? "stale" : "to do"});
    bench.run(other);
    CHECK(bench.words(other) == Words{"done"});
    CHECK(fs::exists(folder / "motion.h5"));
  }
}

TEST_CASE(
    "build graph: a study that keeps lives alone notices a damaged result that is there, and keeps what "
    "failed jobs need") {
  Bench bench;
  Study study = bench.study({{"one", "simulation.segments=20"}});
  study.keep = Keep::lives;
  const fs::path folder = bench.places().job("one");
  bench.report_stage("one", "fail-fatigue");
  bench.run(study);
  CHECK(fs::exists(folder / "motion.h5"));
  CHECK(fs::exists(folder / "strain.h5"));
  fs::remove(folder / "fail-fatigue");
  CHECK(bench.run(study).executed == 1);
  CHECK_FALSE(fs::exists(folder / "motion.h5"));
  std::ofstream(folder / "life.h5") << "dresslife file\nand no more";
  CHECK(bench.words(study)[0].starts_with("damaged  life.h5"));
  fs::remove(folder / "life.h5");
  CHECK(bench.words(study) == Words{"done"});
  fs::remove(folder / ".stage/strain.receipt");
  CHECK(bench.words(study) == Words{"stale"});
  CHECK(bench.run(study).executed == 3);
}

TEST_CASE("build graph: a launcher starts every stage, and its exit status is the stage's") {
  Bench bench;
  const Study study = bench.study({{"one", "simulation.segments=20"}, {"two", "simulation.segments=40"}});
  bench.report_stage("two", "fail-strain");
  std::vector<JobState> states = states_of(study, bench.places());
  write_build_graph(
      study, bench.places(), states, {},
      "sh -c 'echo \"${DRESSLIFE_PARENT-none} $1\" >> launched; echo launcher: error: exit >&2; exec \"$@\"' --");
  const BuildResult result = run_build_graph(bench.places(), 1, {});
  close_run(study, bench.places(), result, states, {});
  CHECK(states[0].done());
  CHECK(states[1].failure.find("strain broke") !=
        std::string::npos);  // not the launcher's own message, which comes first
  CHECK(bytes_of(bench.places().job("two") / "log").find("launcher: error: exit") != std::string::npos);
  std::istringstream launched(bytes_of(bench.places().folder / "launched"));
  int lines = 0;
  for (std::string line; std::getline(launched, line);)
    if (line == "none sh") ++lines;
  CHECK(lines == 5);
}

TEST_CASE("build graph: jobs that are alike up to a stage make it once, and each is complete by itself") {
  Bench bench;
  const std::vector<std::pair<std::string, std::string>> jobs{{"one", "fatigue.stress=elastic"},
                                                              {"two", "fatigue.scatter_log10=0.3"},
                                                              {"three", "strain.gate=2e-4"},
                                                              {"four", "simulation.segments=40"}};
  const Study study = bench.study(jobs);
  CHECK(bench.run(study).executed == 2 + 3 + 4);
  CHECK(bench.calls("one") == "sim strain fatigue ");
  CHECK(bench.calls("two") == "fatigue ");
  CHECK(bench.calls("three") == "strain fatigue ");
  CHECK(bench.calls("four") == "sim strain fatigue ");
  CHECK(bench.words(study) == Words(4, "done"));
  CHECK(fs::hard_link_count(bench.places().job("one") / "motion.h5") == 3);
  CHECK(fs::hard_link_count(bench.places().job("two") / "strain.h5") == 2);
  CHECK(fs::hard_link_count(bench.places().job("four") / "motion.h5") == 1);
  CHECK(bytes_of(bench.places().job("two") / "log").find("dresslife-sim") != std::string::npos);
  CHECK(bench.run(study).executed == 0);

  // Each job continues independently.
  auto changed = jobs;
  changed[0].second = "strain.gate=3e-4";
  CHECK(bench.run(bench.study(changed)).executed == 2);
  CHECK(bench.words(bench.study(changed)) == Words(4, "done"));
  fs::remove_all(bench.places().job("one"));
  CHECK(bench.words(bench.study({jobs[1], jobs[2], jobs[3]})) == Words(3, "done"));
  std::ofstream(bench.places().job("two") / "strain.h5", std::ios::app) << "more";
  CHECK(bench.words(study)[1].starts_with("damaged  strain.h5"));
  CHECK(bench.words(study)[2] == "done");
}

TEST_CASE("build graph: jobs that share a stage share its failure, which runs once") {
  Bench bench;
  const Study study = bench.study({{"one", "fatigue.stress=elastic"}, {"two", "fatigue.scatter_log10=0.3"}});
  bench.report_stage("one", "fail-sim");
  bench.run(study);
  for (const std::string& words : bench.words(study)) {
    INFO(words);
    CHECK(words.starts_with("failed"));
    CHECK(words.find("sim broke") != std::string::npos);
  }
  CHECK(bench.calls("one") == "sim ");
  CHECK(bench.calls("two") == "");
  fs::remove(bench.places().job("one") / "fail-sim");
  bench.report_stage("one", "fail-fatigue");
  bench.run(study);
  CHECK(bench.words(study)[0].find("fatigue broke") != std::string::npos);
  CHECK(bench.words(study)[1] == "done");
}

TEST_CASE("build graph: a job that is added takes what is there, and makes what is not kept") {
  for (const Keep keep : {Keep::all, Keep::histories, Keep::lives}) {
    Bench bench;
    Study first = bench.study({{"one", "fatigue.stress=elastic"}});
    Study both = bench.study({{"one", "fatigue.stress=elastic"}, {"two", "fatigue.scatter_log10=0.3"}});
    first.keep = both.keep = keep;
    bench.run(first);
    CHECK(bench.run_sharing(both).executed == (keep == Keep::lives ? 3 : 1));
    CHECK(bench.words(both) == Words{"done", "done"});
    CHECK(fs::exists(bench.places().job("two") / "motion.h5") == (keep == Keep::all));
    CHECK(bench.run_sharing(both).executed == 0);
    CHECK(bench.calls("one") == "sim strain fatigue ");
    if (keep == Keep::all)
      CHECK(bytes_of(bench.places().job("two") / "log").find("dresslife-strain") != std::string::npos);
  }
}

TEST_CASE("build graph: a study takes what a study beside it has made, and both stay whole") {
  for (const Keep keep : {Keep::all, Keep::histories, Keep::lives}) {
    Bench bench;
    const std::string set = "simulation.segments=20";
    const Study first = bench.study({{"one", set}});
    bench.run(first);
    const StudyPlaces before = bench.places();
    bench.go_beside("other");
    Study second = bench.study({{"same", set}, {"more", "simulation.segments=40"}});
    second.keep = keep;
    CHECK(bench.run_sharing(second).executed == 1 + 3);
    CHECK(bench.words(second) == Words{"done", "done"});
    CHECK(bench.calls("same") == "fatigue ");
    CHECK(fs::hard_link_count(before.job("one") / "motion.h5") == (keep == Keep::all ? 2 : 1));
    CHECK(fs::hard_link_count(before.job("one") / "strain.h5") == (keep == Keep::lives ? 1 : 2));
    CHECK(bench.run_sharing(second).executed == 0);
    CHECK(states_of(first, before)[0].done());
    fs::remove_all(before.folder);
    CHECK(bench.words(second) == Words{"done", "done"});
  }
}

TEST_CASE("build graph: a job that takes results keeps no older output that the other job does not have") {
  for (const auto& [beside, is_empty] : {std::pair{false, false}, {true, false}, {false, true}, {true, true}}) {
    Bench bench;
    const std::pair<std::string, std::string> one{"one", "fatigue.stress=elastic"};
    const Study source = bench.study({one});
    bench.run(source);
    if (beside) bench.go_beside("other");
    bench.run(bench.study({{"two", "simulation.segments=40"}}));  // two has its motion.h5 with other settings
    Study both = bench.study({one, {"two", "fatigue.scatter_log10=0.3"}});
    if (beside) both.jobs.erase(both.jobs.begin());
    both.keep = Keep::histories;
    if (!beside) fs::remove(bench.places().job("one") / "motion.h5");
    const fs::path motion = bench.places().job("two") / "motion.h5";
    if (is_empty) fs::resize_file(motion, 0);
    std::vector<JobState> states = states_of(both, bench.places());
    share_stages(both, bench.places(), states);
    CHECK(states.back().next == (is_empty ? 0 : 2));  // 2: it has taken the strain
    CHECK(states.back().damaged == (is_empty ? "motion.h5" : ""));
    CHECK(fs::exists(motion) == is_empty);
    CHECK(bench.run(both).executed == (is_empty ? 3 : 1));
    CHECK_FALSE(fs::exists(motion));
    CHECK(bench.states().back().done());
  }
}

TEST_CASE("build graph: a user's file with the name of a result stops its own job only") {
  const std::vector<std::pair<std::string, std::string>> jobs{
      {"one", "fatigue.stress=elastic"}, {"two", "fatigue.scatter_log10=0.3"}, {"three", "fatigue.scatter_log10=0.2"}};
  for (const std::string name : {"motion.h5", "strain.h5", "life.h5"})
    for (const bool one_is_done : {true, false}) {
      INFO(name << one_is_done);
      Bench bench;
      const fs::path mine = bench.places().job("two") / name;
      if (one_is_done) bench.run(bench.study({jobs[0]}));
      fs::create_directories(mine.parent_path());
      std::ofstream(mine) << "notes of the user's";
      const Study study = bench.study(jobs);
      CHECK(bench.words(study)[1] ==
            fmt::format("foreign  {} was not written by dresslife; move it away, or run with --force", name));
      bench.run_sharing(study);
      CHECK(bench.states()[0].done());
      CHECK_THAT(bench.states()[1].failure, Catch::Contains(name + ": error: is there already"));
      CHECK(bench.states()[2].done());
      CHECK(bytes_of(mine) == "notes of the user's");
      fs::remove(mine);
      bench.run_sharing(study);
      CHECK(bench.words(study) == Words(3, "done"));
    }
}

TEST_CASE("build graph: a job with other settings of strains takes the simulation of another study") {
  Bench bench;
  bench.run(bench.study({{"one", "strain.gate=2e-4"}}));
  bench.go_beside("other");
  CHECK(bench.run_sharing(bench.study({{"two", "strain.gate=3e-4"}})).executed == 2);
  CHECK(bench.run_sharing(bench.study({{"three", "simulation.segments=21"}})).executed == 3);
}

TEST_CASE(
    "build graph: of another study nothing is taken that its receipt does not name, and nothing is written there") {
  Bench bench;
  const Study study = bench.study({{"one", "simulation.segments=20"}});
  bench.run(study);
  const StudyPlaces before = bench.places();
  const auto forget = [&] { fs::remove_all(bench.places().folder); };
  const auto notes = [&] {
    std::string all;
    for (const char* stage : {"sim", "strain"}) {
      const fs::path receipt = before.job("one") / ".stage" / (std::string(stage) + ".receipt");
      all += bytes_of(receipt) + std::to_string(state_of(receipt).changed_ns);
    }
    return all;
  };
  const std::string noted = notes();
  bench.go_beside("other");
  CHECK(bench.run_sharing(study).executed == 1);
  CHECK(notes() == noted);
  forget();

  const std::string whole = bytes_of(before.job("one") / "strain.h5");
  std::string damaged = whole;
  damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 4);
  for (const std::string& other : {damaged, whole + "x", std::string("notes of the user's")}) {
    std::ofstream(before.job("one") / "strain.h5", std::ios::binary | std::ios::trunc) << other;
    CHECK(bench.run_sharing(study).executed == 2);  // its motion is undamaged
    CHECK(bytes_of(bench.places().job("one") / "strain.h5") == whole);
    CHECK(bytes_of(before.job("one") / "strain.h5") == other);
    forget();
  }
  // A folder that no run made is not shared.
  fs::remove_all(before.folder / ".stage");
  CHECK(bench.run_sharing(study).executed == 3);
  // A user's file has the name of a result: it is not overwritten.
  fs::remove_all(before.folder);
  std::ofstream(bench.places().job("one") / "motion.h5", std::ios::trunc) << "notes of the user's";
  bench.go_beside("third");
  CHECK(bench.run_sharing(study).executed == 3);
  bench.go_beside("other");
  bench.run_sharing(study);
  CHECK(bytes_of(bench.places().job("one") / "motion.h5") == "notes of the user's");
}

TEST_CASE("build graph: what was made apart is not mixed") {
  Bench bench;
  const auto elastic = std::pair<std::string, std::string>{"one", "fatigue.stress=elastic"};
  const auto scatter = std::pair<std::string, std::string>{"two", "fatigue.scatter_log10=0.3"};
  bench.run(bench.study({elastic}));
  bench.run(bench.study({scatter}));  // its motion file holds its own settings, so its bytes differ
  fs::remove(bench.places().job("one") / "strain.h5");
  fs::remove(bench.places().job("two") / "strain.h5");
  const Study both = bench.study({elastic, scatter});
  CHECK(bench.run(both).executed >= 2);
  CHECK(bench.words(both) == Words{"done", "done"});
  fs::remove(bench.places().job("two") / "strain.h5");
  CHECK(bench.run_sharing(both).executed == 1);  // from the motion of the job that provided the strain
  CHECK(bench.words(both) == Words{"done", "done"});
}

TEST_CASE("build graph: an output that comes out the same ends the chain") {
  Bench bench;
  const Study study = bench.study({{"one", "simulation.segments=20"}});
  bench.run(study);
  fs::remove(bench.places().job("one") / "motion.h5");
  bench.run(study);
  CHECK(bench.calls("one") == "sim strain fatigue sim ");
  CHECK(bench.words(study) == Words{"done"});
}

TEST_CASE("build graph: a program with other bytes reruns its stage, one that was only touched nothing") {
  Bench bench;
  const Study study = bench.study({{"one", "simulation.segments=20"}});
  bench.run(study);
  bench.write_stage("strain");
  CHECK(bench.run(study).executed == 0);
  bench.write_stage("strain", "newer");
  bench.run(study);
  CHECK(bench.calls("one") == "sim strain fatigue strain ");  // the result is identical, so fatigue does not run
  CHECK(bench.words(study) == Words{"done"});
}

TEST_CASE("build graph: each setting of a job is in the digest of its settings, its programs are not") {
  Bench bench;
  std::set<std::string> seen;
  for (const char* set :
       {"simulation.segments=20", "simulation.segments=21", "strain.gate=2e-4", "fatigue.stress=elastic"})
    for (const char* more : {"", "more"}) {
      bench.write_stage("sim", more);
      seen.insert(states_of(bench.study({{"one", set}}), bench.places())[0].settings);
    }
  CHECK(seen.size() == 4);
  for (const std::string& settings : seen) CHECK(settings.size() == 12);
}

TEST_CASE("build graph: no time decides, only content") {
  Bench bench;
  const Study study = bench.study({{"one", "simulation.segments=20"}});
  bench.run(study);
  using namespace std::chrono_literals;
  for (const auto shift : {-24h * 365, 24h, 24h * 365 * 20}) {
    for (const auto& entry : fs::recursive_directory_iterator(bench.places().folder))
      if (entry.is_regular_file()) fs::last_write_time(entry, entry.last_write_time() + shift);
    CHECK(bench.words(study) == Words{"done"});
    CHECK(bench.run(study).executed == 0);
    // A change is noticed whatever the file times are.
    CHECK(bench.words(bench.study({{"one", "simulation.segments=24"}})) == Words{"stale"});
  }
}

/// Returns the job with recorded poses of the clamps in place of a robot.
Job with_poses(Job job, const fs::path& poses) {
  job.motion = {};
  job.motion.clamp_poses = poses;
  job.robot = {};
  job.dresspacks[0].routing.base_clamp.reset();
  job.dresspacks[0].routing.tool_clamp.reset();
  job.dresspacks[0].routing.mounting_pose.clear();
  return job;
}

TEST_CASE("build graph: a file beside the job counts by its content") {
  Bench bench;
  const fs::path poses = bench.scratch().write("poses.csv", "0, 1\n");
  Study study = bench.study({{"one", "simulation.segments=20"}});
  study.jobs[0].job = std::make_shared<const Job>(with_poses(*study.jobs[0].job, poses));
  bench.run(study);
  REQUIRE(bench.words(study) == Words{"done"});
  const auto before = fs::last_write_time(poses);
  fs::last_write_time(poses, before + std::chrono::hours(1));
  CHECK(bench.words(study) == Words{"done"});
  bench.scratch().write("poses.csv", "0, 2\n");  // same length, and by its date older than all results
  fs::last_write_time(poses, before - std::chrono::hours(24 * 365));
  CHECK(bench.words(study) == Words{"stale"});
  bench.run(study);
  CHECK(bench.calls("one") == "sim strain fatigue sim strain fatigue ");
  // Edited while the simulation runs.
  bench.scratch().write("poses.csv", "0, 3\n");
  bench.report_stage("one", "wait-sim");
  std::thread editor([&] {
    while (bench.calls("one").size() < std::string("sim strain fatigue sim strain fatigue sim ").size())
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    bench.scratch().write("poses.csv", "0, 4\n");
    fs::remove(bench.places().job("one") / "wait-sim");
  });
  bench.run(study);
  editor.join();
  CHECK_FALSE(bench.states()[0].done());
  CHECK(bench.states()[0].failure.find(
            "poses.csv: error: has changed while dresslife-sim ran; let nothing change it meanwhile, then run again") !=
        std::string::npos);
  // Edited after the run has read the states, before the stage starts.
  bench.run(study, [&] { bench.scratch().write("poses.csv", "0, 5\n"); });
  CHECK_FALSE(bench.states()[0].done());
  CHECK(bench.states()[0].failure ==
        "motion.h5: error: " + poses.string() +
            " has changed while the study ran; let nothing change it meanwhile, then run again");
  bench.run(study);
  CHECK(bench.words(study) == Words{"done"});
}

TEST_CASE("build graph: a changed input is named by its path, also if the folder of results is a link") {
  Bench bench("link/study");
  const fs::path poses = bench.scratch().write("poses.csv", "0, 1\n");
  fs::create_directories(bench.scratch() / "disk/results");
  fs::create_directory_symlink(bench.scratch() / "disk/results", bench.scratch() / "link");
  Study study = bench.study({{"one", "simulation.segments=20"}});
  study.jobs[0].job = std::make_shared<const Job>(with_poses(*study.jobs[0].job, poses));
  bench.run(study, [&] { bench.scratch().write("poses.csv", "0, 2\n"); });
  CHECK(bench.states()[0].failure ==
        "motion.h5: error: " + poses.string() +
            " has changed while the study ran; let nothing change it meanwhile, then run again");
}

TEST_CASE("build graph: a failed stage stops its job only, is reported with its reason and tried again") {
  Bench bench;
  const Study study = bench.study({{"bad", "simulation.segments=20"}, {"good", "simulation.segments=40"}});
  bench.report_stage("bad", "fail-strain");
  bench.run(study);
  CHECK(bench.states()[0].failure == "job.yaml:1:1: error: strain broke; correct it");
  CHECK(bench.states()[1].done());
  CHECK(bench.calls("bad") == "sim strain ");
  CHECK(bench.calls("good") == "sim strain fatigue ");
  CHECK(bench.words(study) == Words{"failed   job.yaml:1:1: error: strain broke; correct it", "done"});
  const Study other = bench.study({{"bad", "simulation.segments=21"}, {"good", "simulation.segments=40"}});
  CHECK(bench.words(other) == Words{"stale", "done"});  // the other settings have not failed
  CHECK(bytes_of(bench.places().job("bad") / "log").find("== dresslife-strain\njob.yaml:1:1: error: strain") !=
        std::string::npos);
  fs::remove(bench.places().job("bad") / "fail-strain");
  bench.run(study);
  CHECK(bench.words(study) == Words{"done", "done"});
  CHECK(bench.calls("bad") == "sim strain strain fatigue ");
}

TEST_CASE("build graph: a stage that is killed or ends without a word is reported") {
  Bench bench;
  const Study study = bench.study({{"one", "simulation.segments=20"}});
  bench.write_script("sim", "#!/bin/sh\nkill -9 $$\n");
  bench.run(study);
  CHECK(bench.states()[0].failure == "dresslife-sim ended without a message (killed, or out of memory?)");
  bench.write_stage("sim");
  bench.report_stage("one", "silent-sim");
  bench.run(study);
  CHECK(bench.states()[0].failure == "dresslife-sim ended without a message (killed, or out of memory?)");
}

TEST_CASE("build graph: a stage that claims success and makes nothing is not believed") {
  Bench bench;
  bench.write_script("sim", "#!/bin/sh\nexit 0\n");
  bench.run(bench.study({{"one", "simulation.segments=20"}}));
  CHECK_FALSE(bench.states()[0].done());
}

TEST_CASE("build graph: a place that one job leaves is taken by the next, however long another works") {
  Bench bench;
  const Study study = bench.study({{"a", "simulation.segments=20"},
                                   {"b", "simulation.segments=21"},
                                   {"c", "simulation.segments=22"},
                                   {"d", "simulation.segments=23"}});
  bench.report_stage("b", "wait-sim");
  bool others_ended = false;
  std::thread watcher([&] {
    constexpr int steps = 3000;  // of 10 ms; enough on any machine for stages that compute nothing
    for (int step = 0; step < steps && !others_ended; ++step) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      others_ended = bench.calls("a") + bench.calls("c") + bench.calls("d") ==
                     "sim strain fatigue sim strain fatigue sim strain fatigue ";
    }
    fs::remove(bench.places().job("b") / "wait-sim");
  });
  bench.run(study);
  watcher.join();
  CHECK(others_ended);
  CHECK(bench.words(study) == Words{"done", "done", "done", "done"});
}

TEST_CASE("build graph: when ninja dies, what it did not reach is not done and says so") {
  Bench bench;
  const auto study = [&](int segments) {
    std::vector<std::pair<std::string, std::string>> jobs;
    for (const char* job : {"a", "b", "c", "d"})
      jobs.push_back({job, fmt::format("simulation.segments={}", segments++)});
    return bench.study(jobs);
  };
  bench.run(study(20));
  const Study changed = study(24);
  bench.report_stage("a", "fail-sim");
  for (const char* job : {"b", "c", "d"}) bench.report_stage(job, "wait-sim");
  std::thread killer([&] {
    const auto begun = [&](const std::string& job) {
      return bench.calls(job).size() >= std::string("sim strain fatigue sim ").size();
    };
    constexpr int steps = 15000;  // of 2 ms, so that the test fails instead of waiting without limit
    for (int step = 0; step < steps && begun("b") + begun("c") + begun("d") < 2; ++step)
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    const std::string own = std::to_string(::getpid());
    std::ifstream children("/proc/" + own + "/task/" + own + "/children");  // Ninja is the only child
    for (pid_t child; children >> child;) ::kill(child, SIGKILL);
  });
  const BuildResult result = bench.run(changed);
  killer.join();
  CHECK(result.words == "ninja was ended by signal 9");
  std::multiset<std::string> reasons;
  for (const JobState& state : bench.states()) {
    CHECK_FALSE(state.done());
    reasons.insert(state.failure);
  }
  // Two stages run at a time. The third job still waits with the receipt of its old settings.
  CHECK(reasons == std::multiset<std::string>{"job.yaml:1:1: error: sim broke; correct it",
                                              "dresslife-sim was broken off: ninja was ended by signal 9; run again",
                                              "dresslife-sim was broken off: ninja was ended by signal 9; run again",
                                              "it was not reached: ninja was ended by signal 9; run again"});
  fs::remove(bench.places().job("a") / "fail-sim");
  for (const char* job : {"b", "c", "d"}) fs::remove(bench.places().job(job) / "wait-sim");
  bench.run(changed);
  CHECK(bench.words(changed) == Words{"done", "done", "done", "done"});
}

TEST_CASE("build graph: looking changes nothing, and needs no right to write") {
  Bench bench;
  const Study study = bench.study({{"one", "simulation.segments=20"}, {"two", "simulation.segments=40"}});
  bench.run(study);
  const auto listing = [&] {
    std::string text;
    for (const auto& entry : fs::recursive_directory_iterator(bench.places().folder)) {
      const FileState state = state_of(entry.path());
      text += fmt::format("{} {} {}\n", entry.path().string(), state.changed_ns, state.inode);
    }
    return text;
  };
  const std::string before = listing();
  CHECK(bench.words(bench.study({{"one", "fatigue.stress=elastic"}, {"two", "simulation.segments=40"}})) ==
        Words{"stale", "done"});
  CHECK(listing() == before);
  CHECK(bench.run(study).executed == 0);
}

TEST_CASE("build graph: a damaged or foreign result is named and made again") {
  Bench bench;
  const Study study = bench.study({{"one", "simulation.segments=20"}, {"two", "simulation.segments=40"}});
  bench.run(study);
  const auto file = [&](const std::string& job, const std::string& name) { return bench.places().job(job) / name; };
  for (const char* name : {"motion.h5", "strain.h5", "life.h5"}) {
    const std::string whole = bytes_of(file("one", name));
    const auto time = fs::last_write_time(file("one", name));
    std::string damaged = whole;
    damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 4);
    for (const std::string& other :
         {damaged, whole.substr(0, whole.size() / 2), bytes_of(file("two", name)), std::string()}) {
      std::ofstream(file("one", name), std::ios::binary | std::ios::trunc) << other;
      fs::last_write_time(file("one", name), time);  // restores the date, so that only the content differs
      CHECK(bench.words(study)[0] == fmt::format("damaged  {} is not what its stage wrote; run makes it again", name));
      bench.run(study);
      CHECK(bench.words(study) == Words{"done", "done"});
      CHECK(bytes_of(file("one", name)) == whole);
    }
    // A file that no program of this project wrote stays until its owner moves it.
    std::ofstream(file("one", name), std::ios::binary | std::ios::trunc) << "notes of the user's";
    CHECK(bench.words(study)[0] ==
          fmt::format("foreign  {} was not written by dresslife; move it away, or run with --force", name));
    bench.run(study);
    CHECK(bytes_of(file("one", name)) == "notes of the user's");
    fs::remove(file("one", name));
    bench.run(study);
    CHECK(bytes_of(file("one", name)) == whole);
  }
  // A copy of the whole folder is as valid as the original.
  fs::copy(bench.places().folder, bench.scratch() / "copy", fs::copy_options::recursive);
  const StudyPlaces copied{bench.scratch() / "copy", bench.places().programs};
  CHECK(states_of(study, copied)[0].done());
  CHECK(states_of(study, copied)[0].compared.size() == stage_count);
  write_build_graph(study, copied, states_of(study, copied));
  CHECK(states_of(study, copied)[0].compared.empty());
}

TEST_CASE("build graph: damage that size and times of a file do not show is repaired once a stage has failed") {
  Bench bench;
  bench.run(bench.study({{"one", "simulation.segments=20"}}));
  const fs::path folder = bench.places().job("one");
  std::string set = "fatigue.stress=elastic";
  for (const std::size_t stage : {0u, 1u}) {
    const auto [output, receipt, log] = files_of_stage(stage);
    std::string damaged = bytes_of(folder / output);
    damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 4);
    std::ofstream(folder / output, std::ios::binary | std::ios::trunc) << damaged;
    REQUIRE_FALSE(checksum_of(folder / output));
    std::this_thread::sleep_for(std::chrono::milliseconds(12));  // a tick of the file system's clock
    write_receipt(folder / receipt, *read_receipt(folder / receipt), folder / output);  // with the damaged file's state
    const Study study = bench.study({{"one", set}});
    CHECK(bench.words(study) == Words{"stale"});
    bench.report_stage("one", "fail-fatigue");
    bench.run(study);
    fs::remove(folder / "fail-fatigue");
    bench.run(study);
    CHECK(bench.words(study) == Words{"done"});
    CHECK(checksum_of(folder / output));
    set = "fatigue.scatter_log10=0.3";
  }
}

TEST_CASE("build graph: jobs that cannot be run are left out, programs that are not there refused") {
  Bench bench;
  Study study = bench.study({{"one", "simulation.segments=20"}});
  study.jobs.push_back({"broken", {}, "why"});
  CHECK(bench.run(study).executed == 3);
  CHECK_FALSE(fs::exists(bench.places().job("broken")));
  StudyPlaces nowhere = bench.places();
  nowhere.programs = bench.scratch() / "nowhere";
  CHECK(message_of([&] { states_of(study, nowhere); }) ==
        (nowhere.programs / "dresslife-sim").string() +
            ": error: is not there (the stages stand beside dresslife); build it: scripts/build");
}

TEST_CASE("receipts: a state suffices once the clock has moved on, a damaged receipt is none") {
  const Scratch scratch;
  const fs::path output = scratch.write("out.h5", "content");
  std::this_thread::sleep_for(std::chrono::milliseconds(12));  // a tick of the file system's clock
  write_receipt(scratch / "receipt", {"r", "-", "o", {}}, output);
  const std::optional<Receipt> receipt = read_receipt(scratch / "receipt");
  REQUIRE(receipt);
  CHECK(receipt->recipe == "r");
  CHECK(receipt->state == state_of(output));
  CHECK(is_as_noted(*receipt, output));  // by its state: "o" is no checksum
  Receipt unsettled = *receipt;
  unsettled.written_ns = unsettled.state.changed_ns;  // within one tick
  CHECK_FALSE(is_as_noted(unsettled, output));
  const std::string text = bytes_of(scratch / "receipt");
  for (std::size_t length = 0; length + 1 < text.size(); ++length) {
    scratch.write("cut", text.substr(0, length));
    CHECK_FALSE(read_receipt(scratch / "cut"));
  }
  // A change immediately after the receipt is noticed.
  for (int k = 0; k < 50; ++k) {
    write_receipt(scratch / "receipt", {"r", "-", "o", {}}, output);
    REQUIRE(read_receipt(scratch / "receipt")->written_ns >= state_of(output).changed_ns);
    const fs::file_time_type time = fs::last_write_time(output);
    scratch.write("out.h5", k % 2 ? "content" : "contEnt");
    fs::last_write_time(output, time);
    CHECK_FALSE(is_as_noted(*read_receipt(scratch / "receipt"), output));
  }
}

}  // namespace
}  // namespace dresslife::pipeline
