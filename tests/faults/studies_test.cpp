// Studies after damage to their runner, their stages or their files: which results remain valid.
#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <iostream>
#include <map>
#include <random>
#include <regex>
#include <thread>

#include "pipeline/study/ranking.h"
#include "tests/catch.h"
#include "tests/cli/process.h"
#include "tests/faults/failing_calls.h"

using namespace dresslife::tests;

namespace {

const char* study_text = R"(base: job.yaml
vary: {dresspack.bending_stiffness_Nm2: [2, 3, 4]}
)";

/// Starts a program in the scratch folder in the background. Returns its process.
pid_t start(const Scratch& scratch, const std::string& program, const std::vector<std::string>& arguments) {
  const pid_t process = ::fork();
  if (process != 0) return process;
  ::chdir(scratch.folder().c_str());
  ::signal(SIGINT, SIG_DFL);  // SIGINT is ignored where tests run in the background of a script
  const int quiet = ::open("/dev/null", O_RDWR);
  for (int stream = 0; stream < 3; ++stream) ::dup2(quiet, stream);
  const std::string path = DRESSLIFE_BIN_DIR "/" + program;
  std::vector<char*> words{const_cast<char*>(path.c_str())};
  for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  ::execv(path.c_str(), words.data());
  ::_exit(127);
}

/// Returns the processes below `process`, the nearest first.
std::vector<pid_t> descendants(pid_t process) {
  std::vector<pid_t> found{process};
  for (std::size_t k = 0; k < found.size(); ++k) {
    std::ifstream in("/proc/" + std::to_string(found[k]) + "/task/" + std::to_string(found[k]) + "/children");
    for (pid_t child; in >> child;) found.push_back(child);
  }
  return found;
}

/// Returns whether the process disappears within ten seconds. It dies at once, but on a busy machine its new parent may reap it
/// late.
bool ends(pid_t process) {
  for (int k = 0; k < 1000; ++k) {
    if (::kill(process, 0) != 0 && errno == ESRCH) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

Outcome run_study(const Scratch& scratch, const std::string& more = "") {
  return run(scratch, "dresslife", "run study.yaml " + more);
}

}  // namespace

TEST_CASE("whatever is killed when, a resumed study has the results of an undisturbed one") {
  Scratch scratch;
  write_small_job(scratch);
  scratch.write("study.yaml", study_text);
  const auto begin = std::chrono::steady_clock::now();
  REQUIRE(run_study(scratch, "-o whole").status == 0);
  const auto takes = std::chrono::steady_clock::now() - begin;
  auto whole = results(scratch / "whole/study");
  const unsigned seed = std::random_device{}();
  std::mt19937 random(seed);
  std::map<std::string, int> killed;
  const int kills = rounds(12);
  for (int round = 0; round < kills; ++round) {
    fs::remove_all(scratch / "runs");
    const pid_t runner = start(scratch, "dresslife", {"run", "study.yaml", "--quiet"});
    std::this_thread::sleep_for(takes * std::uniform_real_distribution<double>(0, 1.1)(random));
    // Kills the runner, Ninja or a stage, by a signal that can be caught or not.
    const std::vector<pid_t> all = descendants(runner);
    const std::size_t victim = std::min<std::size_t>(random() % 3, all.size() - 1);
    const int signal = std::array{SIGKILL, SIGTERM, SIGHUP, SIGINT}[random() % 4];
    ::kill(all[victim], signal);
    ::waitpid(runner, nullptr, 0);
    ++killed[victim == 0 ? "runner" : victim == 1 ? "ninja" : "stage"];
    INFO("seed " << seed << " round " << round << " victim " << victim << " signal " << signal);
    if (signal != SIGKILL && fs::exists(scratch / "runs")) REQUIRE_FALSE(holds_parts(scratch / "runs"));
    const Outcome resumed = run_study(scratch);
    REQUIRE_FALSE(holds_parts(scratch / "runs"));
    INFO("seed " << seed << " round " << round << " victim " << victim << ": " << resumed.out << resumed.err);
    REQUIRE(resumed.status == 0);
    auto again = results(scratch / "runs/study");
    REQUIRE(again.size() == whole.size());
    for (const auto& [name, bytes] : whole) {
      INFO(name);
      if (name != "report.html") REQUIRE((again.count(name) == 1 && again[name] == bytes));
    }
    // None of the started processes is still running.
    for (std::size_t k = 1; k < all.size(); ++k) CHECK(ends(all[k]));
  }
  std::cout << "killed with seed " << seed << ":";
  for (const auto& [what, times] : killed) std::cout << ' ' << what << ' ' << times;
  std::cout << "; " << kills << " resumed at once to the same bytes\n";
}

TEST_CASE("each write, sync, close and rename of the runner that fails is reported, and no old page stands as new") {
  Scratch scratch;
  write_small_job(scratch);
  scratch.write("study.yaml", edited(study_text, "[2, 3, 4]", "[2, 3]"));
  REQUIRE(run_study(scratch).status == 0);
  fs::copy(scratch / "runs", scratch / "last", fs::copy_options::recursive);
  const auto last = results(scratch / "last/study");
  std::string job = content(scratch / "job.yaml");
  // The job runs with new settings or is refused. When it is refused, pages of the last results must be marked.
  const std::string length = GENERATE("1.0", "0.3");
  const int status = length == "1.0" ? 0 : 1;
  job.replace(job.find("free_length_m: 0.9"), 18, "free_length_m: " + length);
  scratch.write("job.yaml", job);
  REQUIRE(run_study(scratch).status == status);
  const auto good = results(scratch / "runs/study");
  REQUIRE(good.at("ranking.csv") != last.at("ranking.csv"));
  const unsigned seed = std::random_device{}();
  std::mt19937 random(seed);
  std::cout << "failing calls of the runner with seed " << seed << '\n';
  for (const std::string call : {"write", "sync", "close", "rename"}) {
    const auto fail_at = [&](int at) {
      fs::remove_all(scratch / "runs");
      fs::copy(scratch / "last", scratch / "runs", fs::copy_options::recursive);
      return run_failing(scratch, call, at, "dresslife", "run study.yaml");
    };
    REQUIRE(fail_at(0).status == status);
    REQUIRE(results(scratch / "runs/study") == good);
    const int total = calls_counted(scratch);
    REQUIRE(total > 0);
    int refused = 0, whole = 0;
    for (const int at : some_of(total, rounds(8), random)) {
      const Outcome outcome = fail_at(at);
      INFO(call << " " << at << " of " << total << ": " << outcome.err);
      auto now = results(scratch / "runs/study");
      const bool told = outcome.err.find("error: cannot be ") != std::string::npos;
      REQUIRE(outcome.status == (told ? 1 : status));
      REQUIRE((told || now == good));
      ++(told ? refused : whole);
      // Beside a new ranking every page is new, or marked as outdated.
      const bool ranked = now.at("ranking.csv") != last.at("ranking.csv");
      for (const auto& [name, bytes] : now) {
        INFO(name);
        if (ranked && fs::path(name).filename() == "page.html")
          REQUIRE(((good.contains(name) && bytes == good.at(name)) || bytes.find("id=\"stale\"") != std::string::npos));
      }
      const Outcome resumed = run_study(scratch);
      INFO(resumed.out << resumed.err);
      REQUIRE(resumed.status == status);
      auto after = results(scratch / "runs/study");
      if (status != 0) {  // an outdated page that cannot be marked is removed; the report does not link to it
        for (const auto& [name, bytes] : good)
          if (fs::path(name).filename() == "page.html") after.emplace(name, bytes);
        after["report.html"] = good.at("report.html");
      }
      REQUIRE(after == good);
    }
    std::cout << "dresslife run: " << call << " failed at " << refused + whole << " of " << total
              << " places: " << refused << " refused, " << whole << " whole, 0 false\n";
  }
}

TEST_CASE("a page of another result than the ranking's says so or goes, and one that cannot be made fails the run") {
  Scratch scratch;
  write_small_job(scratch);
  const std::string job = content(scratch / "job.yaml");
  scratch.write("study.yaml", study_text);
  REQUIRE(run_study(scratch).status == 0);
  const fs::path one = scratch / "runs/study/bending_stiffness_Nm2=2", page = one / "page.html";
  const std::string right = content(page), ranking = content(scratch / "runs/study/ranking.csv");
  REQUIRE(right.find("id=\"stale\"") == std::string::npos);

  fs::remove(page);
  fs::create_directory(page);
  const Outcome in_the_way = run_study(scratch);
  CHECK(in_the_way.status == 1);
  CHECK(in_the_way.err.find("no page of bending_stiffness_Nm2=2: ") != std::string::npos);
  CHECK(content(scratch / "runs/study/ranking.csv") == ranking);
  CHECK(run(scratch, "dresslife", "report study.yaml").status == 1);
  fs::remove(page);
  REQUIRE(run_study(scratch).status == 0);
  CHECK(content(page) == right);

  scratch.write("study.yaml", std::string("keep: lives\n") + study_text);
  REQUIRE(run_study(scratch).status == 0);
  CHECK(content(page).find("id=\"stale\">ranking.csv has the present result; the files") != std::string::npos);
  scratch.write("study.yaml", study_text);
  REQUIRE(run_study(scratch).status == 0);
  CHECK(content(page) == right);

  fs::remove(one / "life.h5");
  std::string refused = job;
  refused.replace(refused.find("free_length_m: 0.9"), 18, "free_length_m: 0.3");
  scratch.write("job.yaml", refused);
  REQUIRE(run_study(scratch).status == 1);
  CHECK(content(page).find("id=\"stale\">the job has no result now: ") != std::string::npos);
}

TEST_CASE("a runner that is killed takes its stages along") {
  Scratch scratch;
  write_small_job(scratch);
  scratch.write("study.yaml", "base: job.yaml\n");
  // A minute of work.
  const pid_t runner =
      start(scratch, "dresslife",
            {"run", "study.yaml", "--set", "simulation.time_step_ms=0.01", "--set", "simulation.segments=400"});
  std::vector<pid_t> all;
  for (int k = 0; k < 1000 && all.size() < 3; ++k) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    all = descendants(runner);
  }
  REQUIRE(all.size() >= 3);
  ::kill(runner, SIGKILL);
  ::waitpid(runner, nullptr, 0);
  bool lives = true;
  for (int k = 0; k < 1000 && lives; ++k) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    lives = false;
    for (std::size_t other = 1; other < all.size(); ++other) lives = lives || ::kill(all[other], 0) == 0;
  }
  CHECK_FALSE(lives);
  CHECK(run_study(scratch).status == 0);
}

TEST_CASE("a job that takes too long or too much is reported, and the others are ranked") {
  Scratch scratch;
  write_small_job(scratch);
  scratch.write("study.yaml", R"(base: job.yaml
jobs:
  good: {}
  endless: {simulation.time_step_ms: 0.01, simulation.segments: 400}
)");
  const Outcome slow = run_study(scratch, "--job-time 3 -j 2");
  CHECK(slow.status == 1);
  CHECK(slow.out.find("dresslife-sim: error: took longer than 3 s (--job-time); look for an endless motion") !=
        std::string::npos);
  const std::string ranking = content(scratch / "runs/study/ranking.csv");
  CHECK(ranking.find("\ngood,") != std::string::npos);
  CHECK(ranking.find("\nendless,,,,,,,,,,,,failed,") != std::string::npos);
#ifndef __SANITIZE_ADDRESS__
  scratch.write("study.yaml", "base: job.yaml\n");
  const Outcome large = run_study(scratch, "--job-memory 1");
  CHECK(large.status == 1);
  CHECK(large.out.find("(--job-memory allows 1 MB)") != std::string::npos);
#endif
}

TEST_CASE("status and report work beside a run and where nothing may be written, and change nothing") {
  Scratch scratch;
  write_small_job(scratch);
  scratch.write("study.yaml", study_text);
  REQUIRE(run_study(scratch).status == 0);
  const auto before = results(scratch / "runs/study");
  // Settings of this command only: the files remain those of the study.
  const Outcome changed = run(scratch, "dresslife", "report study.yaml --set fatigue.stress=elastic");
  CHECK(changed.status == 1);
  CHECK(changed.out.find("stale") != std::string::npos);
  CHECK(changed.err.find("ranking.csv and report.html stay as the last run left them (of 3 jobs there are no results "
                         "with these --set)") != std::string::npos);
  CHECK(results(scratch / "runs/study") == before);
  CHECK(run(scratch, "dresslife", "status study.yaml --set fatigue.stress=elastic").out.find("0 of 3 jobs done") !=
        std::string::npos);
  // Changed settings of the study: the files keep the last results, with a mark.
  const std::string job = content(scratch / "job.yaml");
  scratch.write("job.yaml", job + "fatigue: {stress: elastic}\n");
  CHECK(run(scratch, "dresslife", "report study.yaml").status == 1);
  CHECK(content(scratch / "runs/study/ranking.csv")
            .find(",stale,stale: since this result fatigue.stress cyclic -> elastic,") != std::string::npos);
  scratch.write("job.yaml", job);
  CHECK(run(scratch, "dresslife", "report study.yaml").status == 0);
  CHECK(results(scratch / "runs/study") == before);
  CHECK(run_study(scratch).err.find("nothing to do") != std::string::npos);
  // Another process holds the folder's lock.
  const int lock = ::open((scratch / "runs/study/.lock").c_str(), O_RDWR | O_CLOEXEC);
  REQUIRE(lock >= 0);
  REQUIRE(::pwrite(lock, (std::to_string(::getpid()) + "\n").c_str(), std::to_string(::getpid()).size() + 1, 0) > 0);
  REQUIRE(::flock(lock, LOCK_EX | LOCK_NB) == 0);
  CHECK(run_study(scratch).err.find("is in use by another run (process " + std::to_string(::getpid()) + ")") !=
        std::string::npos);
  CHECK(run(scratch, "dresslife", "status study.yaml").out.find("3 of 3 jobs done") != std::string::npos);
  CHECK(run(scratch, "dresslife", "report study.yaml").status == 0);
  ::close(lock);
  CHECK(results(scratch / "runs/study") == before);
}

TEST_CASE("a changed input counts whatever its date, a damaged or foreign result is made again") {
  Scratch scratch;
  write_small_job(scratch);
  scratch.write("study.yaml", study_text);
  REQUIRE(run_study(scratch).status == 0);
  const auto before = results(scratch / "runs/study");
  const std::string poses = content(scratch / "poses.csv");
  const fs::file_time_type time = fs::last_write_time(scratch / "poses.csv");
  std::string moved = poses;
  moved.replace(moved.find("0.8,"), 4, "0.7,");
  scratch.write("poses.csv", moved);
  fs::last_write_time(scratch / "poses.csv", time - std::chrono::hours(24 * 365 * 20));
  CHECK(run(scratch, "dresslife", "status study.yaml").out.find("0 of 3 jobs done") != std::string::npos);
  REQUIRE(run_study(scratch).status == 0);
  CHECK(content(scratch / "runs/study/ranking.csv") != before.at("ranking.csv"));
  scratch.write("poses.csv", poses);
  fs::last_write_time(scratch / "poses.csv", time);
  REQUIRE(run_study(scratch).status == 0);
  CHECK(results(scratch / "runs/study") == before);

  const std::string one = "runs/study/bending_stiffness_Nm2=2/", two = "runs/study/bending_stiffness_Nm2=3/";
  fs::copy_file(scratch / (one + "life.h5"), scratch / (two + "life.h5"), fs::copy_options::overwrite_existing);
  const Outcome status = run(scratch, "dresslife", "status study.yaml");
  CHECK(status.out.find("damaged  life.h5 is not what its stage wrote; run makes it again") != std::string::npos);
  const Outcome report = run(scratch, "dresslife", "report study.yaml");
  CHECK(report.status == 1);  // the copy belongs to no job
  const Outcome mended = run_study(scratch);
  CHECK(mended.err.find("life.h5 is not what its stage wrote") != std::string::npos);
  CHECK(results(scratch / "runs/study") == before);
}

TEST_CASE("receipts contain everything that the ranking would read from the files") {
  Scratch scratch;
  write_small_job(scratch);
  scratch.write("study.yaml", study_text);
  REQUIRE(run_study(scratch).status == 0);
  std::vector<dresslife::pipeline::JobResult> by_files;
  for (const char* stiffness : {"2", "3", "4"}) {
    const std::string name = std::string("bending_stiffness_Nm2=") + stiffness;
    by_files.push_back({name, scratch / ("runs/study/" + name + "/life.h5"), ""});
  }
  const std::regex settings(",[0-9a-f]{12},");  // digests of settings that no file contains
  const std::string told = content(scratch / "runs/study/ranking.csv");
  REQUIRE(std::regex_search(told, settings));
  CHECK(std::regex_replace(told, settings, ",,") ==
        dresslife::pipeline::ranking_csv(dresslife::pipeline::read_ranking(by_files)));
}

TEST_CASE("names and texts are text, wherever they go") {
  Scratch scratch;
  write_small_job(scratch);
  for (const std::string name : {"build.ninja", "ranking.csv", "report.html"}) {
    scratch.write("study.yaml", "base: job.yaml\njobs: {" + name + ": {}}\n");
    const Outcome outcome = run_study(scratch);
    CHECK(outcome.status == 1);
    CHECK(outcome.err.find("a job is named '" + name + "' (a file of the study itself)") != std::string::npos);
  }
  scratch.write("study.yaml", "base: job.yaml\njobs: {-x: {}, --help: {}, '=1+1': {}, \"e\\e[31mred\": {}}\n");
  const Outcome odd = run_study(scratch, "-o 'odd | folder\n $x'");
  INFO(odd.out << odd.err);
  CHECK(odd.status == 0);
  CHECK(odd.out.find('\x1b') == std::string::npos);
  CHECK(content(scratch / "odd | folder\n $x/study/ranking.csv").find("\n=") == std::string::npos);
  CHECK(fs::exists(scratch / "odd | folder\n $x/study/_x/life.h5"));
  REQUIRE(run_shell(scratch, "mkfifo pipe.yaml").status == 0);
  scratch.write("study.yaml", "base: pipe.yaml\n");
  CHECK(run_study(scratch).err.find("pipe.yaml: error: is a device or a pipe, not a file") == 0);
}

TEST_CASE("absurd values are refused where they are read, by their keys") {
  Scratch scratch;
  write_small_job(scratch);
  const auto refused = [&](const std::string& set, const std::string& words) {
    const Outcome outcome = run(scratch, "dresslife-sim", "job.yaml -o m.h5 --set " + set);
    INFO(set << ": " << outcome.err);
    CHECK(outcome.status == 1);
    CHECK(outcome.err.find(words) != std::string::npos);
    CHECK_FALSE(fs::exists(scratch / "m.h5"));
  };
  refused("dresspack.bending_stiffness_Nm2=1e20",
          "dresspack.bending_stiffness_Nm2 is 1e20 (its size must be 1e-08 .. 10000000 N m2)");
  refused("routing.free_length_m=1e200", "routing.free_length_m is 1e200 (its size must be 1e-12 .. 1000 m)");
  refused("routing.free_length_m=1e-320", "(its size must be 1e-12 .. 1000 m)");
  refused("simulation.gravity_m_per_s2=[0,0,-1e308]", "(its size must be 0 .. 1000 m/s2)");
  refused("'cell={capsules: [{from_m: [0,0,0], to_m: [0,0,1e300], radius_mm: 1}]}'", "(its size must be 0 .. 1000 m)");
  // As long as the keys allow, and longer than memory can hold.
  scratch.write("long.csv", "0,0,0,1,1,0,0,0,0.8,0,1,1,0,0,0\n9e9,0,0,1,1,0,0,0,0.8,0,1,1,0,0,0\n");
  refused("motion.clamp_poses=long.csv", "(at most 1e+08)");
}

TEST_CASE("a run that finds nothing to do leaves every file as it is, whatever the study varies") {
  const std::map<std::string, std::string> studies{
      {"one key", "vary: {dresspack.bending_stiffness_Nm2: [2, 3]}\n"},
      {"two keys", "vary: {routing.free_length_m: [0.9, 0.95], strain.gate: [0.0005, 0.001]}\n"},
      {"jobs and a key",
       "jobs: {soft: {dresspack.bending_stiffness_Nm2: 1}, as_it_is: {}}\n"
       "vary: {strain.gate: [0.0005, 0.001]}\n"},
      {"draws", "sample: {jobs: 2, seed: 1, keys: {routing.free_length_m: !normal {mean: 0.92, deviation: 0.01}}}\n"}};
  for (const auto& [what, text] : studies) {
    Scratch scratch;
    write_small_job(scratch);
    scratch.write("study.yaml", "base: job.yaml\n" + text);
    REQUIRE(run_study(scratch).status == 0);
    const auto first = results(scratch / "runs/study");
    for (const std::string again : {"run study.yaml", "report study.yaml", "run study.yaml"}) {
      const Outcome outcome = run(scratch, "dresslife", again);
      INFO(what << ": " << again << ": " << outcome.err);
      CHECK(outcome.status == 0);
      CHECK(results(scratch / "runs/study") == first);
    }
  }
}

TEST_CASE("a study that is moved with its files stays up to date, whatever stands beside its program") {
  Scratch scratch;
  fs::create_directories(scratch / "plant/cell");
  write_small_job(scratch);
  fs::rename(scratch / "poses.csv", scratch / "plant/cell/poses.csv");
  std::string job = content(scratch / "job.yaml");
  job.replace(job.find("poses.csv"), 9, "cell/poses.csv");
  scratch.write("plant/job.yaml", job);
  scratch.write("plant/study.yaml", "base: job.yaml\n");
  const auto dresslife = [&](const std::string& folder, const std::string& command) {
    return run_shell(scratch, "cd " + folder + " && '" DRESSLIFE_BIN_DIR "/dresslife' " + command);
  };
  REQUIRE(dresslife("plant", "run study.yaml").status == 0);
  for (const auto& entry : fs::recursive_directory_iterator(scratch / "plant/runs")) {
    INFO(entry.path());
    const bool is_of_this_machine =
        entry.path().filename() == "study";  // a file of search results for this machine only
    if (entry.is_regular_file() && !is_of_this_machine)
      CHECK(content(entry.path()).find(scratch.folder().string()) == std::string::npos);
  }
  const auto before = results(scratch / "plant/runs/study");
  fs::rename(scratch / "plant", scratch / "moved");
  const Outcome moved = dresslife("moved", "run study.yaml");
  INFO(moved.err);
  CHECK(moved.err.find("nothing to do") != std::string::npos);
  CHECK(results(scratch / "moved/runs/study") == before);
  CHECK(run(scratch, "dresslife", "run moved/study.yaml -o moved/runs").err.find("nothing to do") !=
        std::string::npos);  // called from another folder
  fs::create_directory_symlink(scratch / "moved", scratch / "link");
  CHECK(run(scratch, "dresslife", "run link/study.yaml -o link/runs").err.find("nothing to do") != std::string::npos);
  const std::string poses = content(scratch / "moved/cell/poses.csv");
  scratch.write("moved/cell/poses.csv", poses + "\n");
  CHECK(dresslife("moved", "status study.yaml").out.find("cell/poses.csv has changed") != std::string::npos);
}

TEST_CASE("a job whose name is too long for a folder fails, and the others run") {
  Scratch scratch;
  write_small_job(scratch);
  scratch.write("study.yaml", "base: job.yaml\njobs: {short: {}, " + std::string(300, 'n') + ": {}}\n");
  const Outcome outcome = run_study(scratch);
  INFO(outcome.out << outcome.err);
  CHECK(outcome.status == 1);
  CHECK(outcome.out.find("a job's name has 300 letters (at most 200 fit a folder)") != std::string::npos);
  CHECK(outcome.err.find("1 of 2 jobs failed") != std::string::npos);
  CHECK(content(scratch / "runs/study/ranking.csv").find("\nshort,") != std::string::npos);
}
