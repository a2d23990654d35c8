// Studies: which stages run, which do not run again, and the effect of a failed job on the others.

#include "tests/catch.h"
#include "tests/cli/process.h"

using namespace dresslife::tests;

namespace {

const char* study_text = R"(base: job.yaml
vary:
  dresspack.bending_stiffness_Nm2: [2, 3]
)";

std::string stages_ran(const Outcome& outcome) {
  if (outcome.err.find(": 1 stage ran\n") != std::string::npos) return "1";
  const std::size_t end = outcome.err.find(" stages ran");
  if (end == std::string::npos) return outcome.err.find("nothing to do") == std::string::npos ? "?" : "0";
  return outcome.err.substr(outcome.err.rfind(' ', end - 1) + 1, end - outcome.err.rfind(' ', end - 1) - 1);
}

}  // namespace

TEST_CASE("a study runs every job, and again only what changed") {
  Scratch scratch;
  write_small_job(scratch);
  scratch.write("study.yaml", study_text);
  auto run_study = [&](const std::string& more = "") { return run(scratch, "dresslife", "run study.yaml " + more); };

  const Outcome first = run_study();
  INFO(first.err << first.out);
  REQUIRE(first.status == 0);
  CHECK(stages_ran(first) == "6");
  for (const std::string job : {"bending_stiffness_Nm2=2", "bending_stiffness_Nm2=3"})
    for (const std::string file : {"job.yaml", "motion.h5", "strain.h5", "life.h5", "log"})
      CHECK(fs::exists(scratch / ("runs/study/" + job + "/" + file)));
  for (const std::string file : {"ranking.csv", "report.html", "build.ninja"})
    CHECK(fs::exists(scratch / ("runs/study/" + file)));
  CHECK(content(scratch / "runs/study/ranking.csv")
            .rfind("job,life_repeats,life_hours,worst_segment_from_tool,worst_component,damage_per_repeat", 0) == 0);
  CHECK(first.out.find("runs/study/report.html") != std::string::npos);
  // The picture of the worst time shows every segment once, in two halves, with one segment marked.
  const std::string report = content(scratch / "runs/study/report.html");
  const auto count = [&](const std::string& words) {
    int found = 0;
    for (std::size_t at = report.find(words); at != std::string::npos; at = report.find(words, at + 1)) ++found;
    return found;
  };
  CHECK(count("<line class=\"hose-hot\"") == 2 * 2);
  CHECK(count("<line class=\"hose\"") == 2 * 2 * 11);

  CHECK(stages_ran(run_study()) == "0");
  CHECK(run_study("-n").out == "0 of 2 jobs to make; nothing was run\n");
  const std::string ranking = content(scratch / "runs/study/ranking.csv");

  // Changed settings of the last stage run only this stage.
  const std::string job = content(scratch / "job.yaml");
  scratch.write("job.yaml", job + "fatigue: {stress: elastic}\n");
  const Outcome dry = run_study("--dry-run");
  CHECK(dry.status == 0);
  CHECK(dry.out.find("fatigue.stress") != std::string::npos);
  CHECK(dry.out.find("2 of 2 jobs to make; nothing was run\n") != std::string::npos);
  CHECK(stages_ran(run_study()) == "2");
  CHECK(content(scratch / "runs/study/ranking.csv") != ranking);
  // Changed settings of the middle stage run this and the last stage.
  scratch.write("job.yaml", edited(job, "slip: stick", "slip: free"));
  CHECK(stages_ran(run_study()) == "4");
  // Changed poses beside the job run all stages. A changed remark runs none.
  scratch.write("job.yaml", "# a remark\n" + job);
  CHECK(stages_ran(run_study()) == "4");
  CHECK(content(scratch / "runs/study/ranking.csv") == ranking);
  scratch.write("job.yaml", job);
  CHECK(stages_ran(run_study()) == "0");
  scratch.write("poses.csv", edited(content(scratch / "poses.csv"), "\n0.05,", "\n0.051,"));
  CHECK(stages_ran(run_study()) == "6");
}

TEST_CASE("a dry run of a new study makes nothing") {
  Scratch scratch;
  write_small_job(scratch);
  scratch.write("study.yaml", study_text);
  const Outcome dry = run(scratch, "dresslife", "run -n study.yaml");
  CHECK(dry.status == 0);
  CHECK(dry.out.find("2 of 2 jobs to make; nothing was run\n") != std::string::npos);
  CHECK(run(scratch, "dresslife", "run -n --shard 2/2 study.yaml").out.find("1 of 1 jobs to make") !=
        std::string::npos);
  CHECK_FALSE(fs::exists(scratch / "runs"));
}

TEST_CASE("a lost result is made again, the others stay") {
  Scratch scratch;
  write_small_job(scratch);
  scratch.write("study.yaml", study_text);
  must_run(scratch, "dresslife", "run study.yaml");
  fs::remove(scratch / "runs/study/bending_stiffness_Nm2=3/strain.h5");
  const std::string life = content(scratch / "runs/study/bending_stiffness_Nm2=3/life.h5");
  CHECK(stages_ran(run(scratch, "dresslife", "run study.yaml")) == "2");
  CHECK(content(scratch / "runs/study/bending_stiffness_Nm2=3/life.h5") == life);
}

TEST_CASE("a failed job stops no other and is reported with its reason") {
  Scratch scratch;
  write_small_job(scratch);
  scratch.write("study.yaml", R"(base: job.yaml
jobs:
  good: {}
  too_short: {routing.free_length_m: 0.7}
  misspelt: {routing.free_lenght_m: 0.7}
)");
  const Outcome outcome = run(scratch, "dresslife", "run study.yaml");
  CHECK(outcome.status == 1);
  CHECK(fs::exists(scratch / "runs/study/good/life.h5"));
  CHECK(outcome.out.find("too short") != std::string::npos);
  CHECK(outcome.out.find("did you mean 'free_length_m'?") != std::string::npos);
  CHECK(outcome.err.find("2 of 3 jobs failed") != std::string::npos);

  const Outcome status = run(scratch, "dresslife", "status study.yaml");
  CHECK(status.status == 0);
  CHECK(status.out.find("1 of 3 jobs done") != std::string::npos);
  CHECK(status.out.find("too short") != std::string::npos);
}

TEST_CASE("names in a study and in --set are looked up beside the job too") {
  Scratch scratch;
  write_small_job(scratch);
  fs::create_directories(scratch / "elsewhere/materials");
  fs::rename(scratch / "poses.csv", scratch / "elsewhere/poses.csv");
  std::string copper = content(fs::path(DRESSLIFE_SOURCE_DIR) / "config/materials/copper.yaml");
  scratch.write("elsewhere/materials/our_copper.yaml", edited(copper, "name: copper", "name: our_copper"));
  scratch.write("elsewhere/job.yaml", content(scratch / "job.yaml"));
  scratch.write("study.yaml", "base: elsewhere/job.yaml\njobs: {ours: {fatigue.material: our_copper}}\n");
  const Outcome study = run(scratch, "dresslife", "run study.yaml");
  INFO(study.out << study.err);
  CHECK(study.status == 0);
  CHECK(run(scratch, "dresslife", "show elsewhere/job.yaml --set fatigue.material=our_copper").status == 0);
}

TEST_CASE("status reports to do, done and stale") {
  Scratch scratch;
  write_small_job(scratch);
  scratch.write("study.yaml", study_text);
  CHECK(run(scratch, "dresslife", "status study.yaml").out.find("0 of 2 jobs done") != std::string::npos);
  must_run(scratch, "dresslife", "run study.yaml");
  CHECK(run(scratch, "dresslife", "status study.yaml").out.find("2 of 2 jobs done") != std::string::npos);
  scratch.write("job.yaml", content(scratch / "job.yaml") + "fatigue: {stress: elastic}\n");
  const Outcome stale = run(scratch, "dresslife", "status study.yaml");
  CHECK(stale.out.find("stale") != std::string::npos);
  CHECK(stale.out.find("0 of 2 jobs done") != std::string::npos);
}

TEST_CASE("a stale job keeps its last result, and status says which key, file or program changed") {
  Scratch scratch;
  write_small_job(scratch);
  scratch.write("study.yaml", study_text);
  must_run(scratch, "dresslife", "run study.yaml");
  const std::string job = content(scratch / "job.yaml"), poses = content(scratch / "poses.csv");
  const std::string ranking = content(scratch / "runs/study/ranking.csv");
  const auto lives_of = [](const std::string& csv) {  // per row: job and lives, longest first
    std::vector<std::string> rows;
    std::istringstream lines(csv);
    for (std::string line; std::getline(lines, line);)
      rows.push_back(line.substr(0, std::min(line.find(",done,"), line.find(",stale,"))));
    return rows;
  };
  const auto status = [&] { return run(scratch, "dresslife", "status study.yaml").out; };
  const auto report = [&] {
    CHECK(run(scratch, "dresslife", "report study.yaml").status == 1);
    return content(scratch / "runs/study/ranking.csv");
  };

  scratch.write("job.yaml", job + "fatigue: {stress: elastic}\n");
  CHECK(status().find("stale    fatigue.stress cyclic -> elastic\n") != std::string::npos);
  const std::string marked = report();
  CHECK(lives_of(marked) == lives_of(ranking));
  CHECK(marked.find(",done,") == std::string::npos);
  CHECK(marked.find(",stale,stale: since this result fatigue.stress cyclic -> elastic,") != std::string::npos);
  const std::string page = content(scratch / "runs/study/report.html");
  CHECK(page.find("2 stale") != std::string::npos);
  CHECK(page.find("Damage along the dresspack") != std::string::npos);

  scratch.write("job.yaml", job);
  scratch.write("poses.csv", edited(poses, "\n0.05,", "\n0.051,"));
  CHECK(status().find("poses.csv has changed\n") != std::string::npos);
  CHECK(lives_of(report()) == lives_of(ranking));
  scratch.write("poses.csv", poses);

  // A run that fails with the current settings does not change the last result.
  scratch.write("job.yaml", edited(job, "free_length_m: ", "free_length_m: 0.1 # "));
  CHECK(run(scratch, "dresslife", "run study.yaml").status == 1);
  const std::string failed = content(scratch / "runs/study/ranking.csv");
  CHECK(lives_of(failed) == lives_of(ranking));
  CHECK(failed.find("with the present settings it failed: ") != std::string::npos);
  CHECK(failed.find("; since this result routing.free_length_m 0.9 -> 0.1") != std::string::npos);
  // A job that cannot be read does not change it either.
  scratch.write("job.yaml", job + "fatige: {}\n");
  CHECK(lives_of(report()) == lives_of(ranking));

  scratch.write("job.yaml", job);
  must_run(scratch, "dresslife", "run study.yaml");
  CHECK(content(scratch / "runs/study/ranking.csv") == ranking);
}

TEST_CASE("a study that cannot be read is refused with its place") {
  Scratch scratch;
  write_small_job(scratch);
  auto refused = [&](const std::string& text, const std::string& words) {
    scratch.write("study.yaml", text);
    const Outcome outcome = run(scratch, "dresslife", "run study.yaml");
    INFO(outcome.err);
    CHECK(outcome.status == 1);
    CHECK(outcome.err.find(words) == 0);
  };
  refused("vary: {motion: [a]}\n", "study.yaml:1:1: error: base is missing");
  refused("base: job.yaml\nvery: {}\n", "study.yaml:2:1: error: unknown key 'very' of a study; did you mean 'vary'?");
  refused("base: job.yaml\nvary: {simulation.segments: 8}\n",
          "study.yaml:2:29: error: vary.simulation.segments must be a list of values");
  refused("base: none.yaml\n", "study.yaml:1:7: error: there is no file 'none.yaml'");
}

TEST_CASE("a --set of a varied key is refused, and one that replaces a job's own value is noted") {
  Scratch scratch;
  write_small_job(scratch);
  scratch.write("varied.yaml", study_text);
  scratch.write("named.yaml", "base: job.yaml\njobs: {two: {dresspack.bending_stiffness_Nm2: 2}, other: {}}\n");
  scratch.write("duties.yaml", "study: named.yaml\nduties: [{name: d, programs: [{job: no, percent_of_time: 50}]}]\n");
  const std::string set = " --set dresspack.bending_stiffness_Nm2=4",
                    note = "note: --set dresspack.bending_stiffness_Nm2 replaces the own value of two\n";
  for (const std::string command :
       {"run varied.yaml", "run varied.yaml -n", "status varied.yaml", "improve varied.yaml", "reprogram varied.yaml",
        "submit varied.yaml", "run varied.yaml --shard 1/2"}) {
    const Outcome refused = run(scratch, "dresslife", command + set);
    INFO(command << refused.err);
    CHECK(refused.status == 1);
    CHECK(refused.err.find("error: replaces the values of dresspack.bending_stiffness_Nm2, which the study varies") !=
          std::string::npos);
  }
  CHECK_FALSE(fs::exists(scratch / "runs"));
  CHECK(must_run(scratch, "dresslife", "run named.yaml -n" + set).err == note);
  CHECK(must_run(scratch, "dresslife", "run named.yaml -n --quiet" + set).err.empty());
  CHECK(run(scratch, "dresslife", "duty duties.yaml" + set).err.starts_with(note));
  CHECK(run(scratch, "dresslife", "duty duties.yaml --quiet" + set).err.find(note) == std::string::npos);
}

TEST_CASE("clean removes what a study does not keep and jobs that it has no more, and nothing of others") {
  Scratch scratch;
  write_small_job(scratch);
  scratch.write("s.yaml", "base: job.yaml\njobs: {a: {}, b: {}}\n");
  must_run(scratch, "dresslife", "run s.yaml --quiet");
  scratch.write("runs/s/b/notes.txt", "mine");
  scratch.write("runs/s/own/notes.txt", "mine");
  scratch.write("s.yaml", "base: job.yaml\nkeep: lives\njobs: {a: {}}\n");
  const Outcome cleaned = run(scratch, "dresslife", "clean s.yaml");
  INFO(cleaned.err);
  CHECK(cleaned.status == 0);
  CHECK(cleaned.out.find("1 jobs that the study has no more") != std::string::npos);
  CHECK_FALSE(fs::exists(scratch / "runs/s/a/motion.h5"));
  CHECK_FALSE(fs::exists(scratch / "runs/s/a/life.h5"));
  CHECK_FALSE(fs::exists(scratch / "runs/s/b/life.h5"));
  CHECK_FALSE(fs::exists(scratch / "runs/s/b/.stage"));
  CHECK(content(scratch / "runs/s/b/notes.txt") == "mine");
  CHECK(content(scratch / "runs/s/own/notes.txt") == "mine");
  const Outcome status = run(scratch, "dresslife", "status s.yaml");
  CHECK(status.out.find("1 of 1 jobs done") != std::string::npos);
  const Outcome again = run(scratch, "dresslife", "run s.yaml");
  CHECK(again.err.find("nothing to do") != std::string::npos);
  CHECK(again.out.find("no such file") == std::string::npos);
}

TEST_CASE("a name of a shipped job and a study means the job, in every command, and a note says so") {
  const Scratch scratch;
  const std::string note =
      "bending_cable: note: is a job and a study; the job is taken. The study is studies/bending_cable\n";
  for (const char* command : {"run -n", "status", "show", "preview"}) {
    const Outcome told = run(scratch, "dresslife", std::string(command) + " bending_cable");
    CAPTURE(command, told.err);
    CHECK(told.err.find(note) == 0);
  }
  CHECK(run(scratch, "dresslife", "status bending_cable").out.find("thesis") == std::string::npos);
  const Outcome study = run(scratch, "dresslife", "status studies/bending_cable");
  CHECK(study.out.find("thesis") != std::string::npos);
  CHECK(study.err.empty());
  CHECK(run(scratch, "dresslife", "status two_robots").err.empty());
  CHECK(run(scratch, "dresslife", "status jobs/bending_cable").err.empty());
}

TEST_CASE("two files of one name do not replace each other's results") {
  Scratch scratch;
  write_small_job(scratch);
  fs::create_directories(scratch / "a"), fs::create_directories(scratch / "b");
  fs::copy(scratch / "poses.csv", scratch / "a/poses.csv");
  fs::copy(scratch / "poses.csv", scratch / "b/poses.csv");
  scratch.write("a/job.yaml", content(scratch / "job.yaml"));
  scratch.write("b/job.yaml", edited(content(scratch / "job.yaml"), "slip: stick", "slip: free"));
  must_run(scratch, "dresslife", "run a/job.yaml");
  const std::string of_a = content(scratch / "runs/job/job/life.h5");
  for (const std::string command : {"run", "run -n", "status", "report", "clean", "submit --only-write"}) {
    const Outcome refused = run(scratch, "dresslife", command + " b/job.yaml");
    INFO(command << ": " << refused.err);
    CHECK(refused.status == 1);
    CHECK(refused.err.find("runs/job: error: holds the results of another file, a/job.yaml, not of b/job.yaml") !=
          std::string::npos);
    CHECK(refused.err.find("-o FOLDER") != std::string::npos);
    CHECK(content(scratch / "runs/job/job/life.h5") == of_a);
  }
  must_run(scratch, "dresslife", "run b/job.yaml -o other");
  // An edited file, a copy of all files at another place, and a moved file keep their folder.
  scratch.write("a/job.yaml", "# a remark\n" + content(scratch / "a/job.yaml"));
  CHECK(stages_ran(run(scratch, "dresslife", "run a/job.yaml")) == "0");
  CHECK(run_shell(scratch,
                  "mkdir copy && cp -rp a runs copy && cd copy && '" DRESSLIFE_BIN_DIR "/dresslife' status a/job.yaml")
            .status == 0);
  fs::rename(scratch / "a", scratch / "moved");
  CHECK(run(scratch, "dresslife", "status moved/job.yaml").status == 0);
  CHECK(run(scratch, "dresslife", "run moved/job.yaml").status == 0);
  // The user forces it.
  CHECK(run(scratch, "dresslife", "run b/job.yaml --force").status == 0);
  CHECK(content(scratch / "runs/job/job/life.h5") != of_a);
  CHECK(run(scratch, "dresslife", "status moved/job.yaml").status == 1);
}

TEST_CASE("a stale result says what changed, also of settings that are not kept and of files that are new") {
  Scratch scratch;
  write_small_job(scratch);
  const std::string job = content(scratch / "job.yaml");
  scratch.write("lives.yaml", "base: job.yaml\nkeep: lives\njobs: {one: {}}\n");
  must_run(scratch, "dresslife", "run lives.yaml --quiet");
  scratch.write("job.yaml", job + "fatigue: {stress: elastic}\n");
  CHECK(run(scratch, "dresslife", "status lives.yaml")
            .out.find("stale    its settings have changed (keep: lives keeps no old ones)\n") != std::string::npos);

  scratch.write(
      "weld.src",
      "DEF weld()\nPTP {A1 0,A2 -90,A3 90,A4 0,A5 60,A6 0}\nPTP {A1 20,A2 -90,A3 90,A4 0,A5 60,A6 0}\ngrip()\nEND\n");
  scratch.write("cell.yaml",
                "robot: kuka_kr16_2\nmotion: weld.src\ndresspack: sensor_cable\nrouting:\n"
                "  base_clamp: {link: link_3, position_m: [0.083, 0.037, 0.191], direction: [0.87, 0.47, 0.17]}\n"
                "  tool_clamp: {link: link_6, position_m: [0.233, -0.135, 0.134], direction: [0.08, -0.89, 0.46]}\n"
                "  free_length_m: 1.205\nsimulation: {segments: 12}\n");
  must_run(scratch, "dresslife", "run cell.yaml --quiet");
  const auto state = [&] { return run(scratch, "dresslife", "status cell.yaml").out; };
  scratch.write("weld_old.src", content(scratch / "weld.src"));
  CHECK(state().find(" done\n") != std::string::npos);
  scratch.write("grip.src", "DEF grip()\nEND\n");
  CHECK(state().find(" stale    grip.src is new beside the program\n") != std::string::npos);
}

TEST_CASE("the preview of a job that failed says nothing beside the table's reason") {
  Scratch scratch;
  scratch.write("bad.src", "DEF bad()\nPTP {A1 0,, A2 -90,A3 90,A4 0,A5 60,A6 0}\nEND\n");
  scratch.write("bad.yaml",
                "robot: kuka_kr16_2\nmotion: bad.src\ndresspack: sensor_cable\nrouting:\n"
                "  base_clamp: {link: link_3, position_m: [0.083, 0.037, 0.191], direction: [0.87, 0.47, 0.17]}\n"
                "  tool_clamp: {link: link_6, position_m: [0.233, -0.135, 0.134], direction: [0.08, -0.89, 0.46]}\n"
                "  free_length_m: 1.205\n");
  const Outcome failed = run(scratch, "dresslife", "run bad.yaml --quiet");
  CHECK(failed.status == 1);
  CHECK(failed.out.find("bad.src:2:11: error: ") != std::string::npos);
  CHECK(failed.err ==
        "bad.yaml: error: 1 of 1 jobs failed (their reasons are in the table); see the log in each job's folder\n");
}

TEST_CASE("a study that refuses all jobs names no logs, and its status is that of a dry run") {
  Scratch scratch;
  write_small_job(scratch);
  scratch.write("bad.yaml", "base: job.yaml\nvary: {dresspack.mass_kg_per_m: [-1, -2]}\n");
  CHECK_THAT(run(scratch, "dresslife", "run bad.yaml --quiet").err,
             Catch::Contains("2 of 2 jobs failed (their reasons are in the table); none of them ran: correct"));
  for (const std::string command : {"status bad.yaml", "run bad.yaml -n"})
    CHECK_THAT(run(scratch, "dresslife", command).out, Catch::Contains(" refused "));
}
