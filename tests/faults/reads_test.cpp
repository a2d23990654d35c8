// Failing reads of a disk: each result is correct, or its command fails with the disk's message.
#include <iostream>
#include <map>
#include <random>

#include "tests/catch.h"
#include "tests/cli/process.h"
#include "tests/faults/failing_calls.h"

using namespace dresslife::tests;

namespace {

struct Stage {
  std::string program, input, output;
};
const std::vector<Stage> stages{{"dresslife-sim", "job.yaml", "motion.h5"},
                                {"dresslife-strain", "motion.h5", "strain.h5"},
                                {"dresslife-fatigue", "strain.h5", "life.h5"}};

/// All silent faults of a read, and the errors of other calls.
const std::vector<Kind> kinds_of_reads{
    {"read", "EIO", ".h5"},        {"read", "end", ".h5"},       {"read", "flip", ".h5"},
    {"read", "short", ".h5"},      {"read", "EIO", ".part"},     {"read", "end", ".part"},
    {"read", "flip", ".part"},     {"look", "EIO", "dresslife"}, {"open", "EIO", "dresslife-"},
    {"list", "EIO", "dresslife-"}, {"lock", "ENOTSUP", ""}};

}  // namespace

TEST_CASE("each read, search and lock that fails in a stage fails it with a message, or has no effect") {
  Scratch scratch;
  write_small_job(scratch);
  std::map<std::string, std::string> right;
  for (const Stage& stage : stages) {
    must_run(scratch, stage.program, stage.input + " -o " + stage.output);
    right[stage.output] = content(scratch / stage.output);
  }
  fs::create_directories(scratch / "out");
  const unsigned seed = std::random_device{}();
  std::mt19937 random(seed);
  std::cout << "failing reads with seed " << seed << '\n';
  for (const Stage& stage : stages) {
    int refused = 0, whole = 0;
    for (const Kind& kind : kinds_of_reads) {
      const auto fail_at = [&](int at) {
        fs::remove_all(scratch / "out");
        fs::create_directories(scratch / "out");
        return run_failing(scratch, Fault{kind.call, at, kind.mode, kind.path}, stage.program,
                           stage.input + " -o out/" + stage.output + " --quiet");
      };
      REQUIRE(fail_at(0).status == 0);
      for (const int at : some_of(calls_counted(scratch), rounds(4), random)) {
        const Outcome outcome = fail_at(at);
        INFO(stage.program << ' ' << kind.call << ' ' << kind.mode << ' ' << kind.path << ' ' << at << ": "
                           << outcome.status << outcome.err);
        if (outcome.status == 0) {
          REQUIRE(content(scratch / "out" / stage.output) == right.at(stage.output));
          ++whole;
        } else {
          REQUIRE(outcome.status == 1);
          REQUIRE(is_one_error(outcome.err));
          REQUIRE(outcome.err.find("not an HDF5 file") == std::string::npos);
          REQUIRE_FALSE(fs::exists(scratch / "out" / stage.output));
          ++refused;
        }
        REQUIRE_FALSE(holds_parts(scratch.folder()));
      }
    }
    std::cout << stage.program << ": " << refused << " refused, " << whole << " whole, 0 false\n";
  }
}

TEST_CASE(
    "each read and search of a file that fails in a command over results is reported, and no state or page is false") {
  Scratch scratch;
  write_small_job(scratch);
  scratch.write("study.yaml", "base: job.yaml\nvary: {dresspack.bending_stiffness_Nm2: [2, 3]}\n");
  must_run(scratch, "dresslife", "run study.yaml --quiet");
  const auto right = results(scratch / "runs/study");
  const std::string status = run(scratch, "dresslife", "status study.yaml").out;
  fs::copy(scratch / "runs", scratch / "whole", fs::copy_options::recursive);
  const unsigned seed = std::random_device{}();
  std::mt19937 random(seed);
  int refused = 0, whole = 0;
  for (const std::string command : {"status study.yaml", "report study.yaml", "run study.yaml --quiet"})
    for (const Kind& kind : {Kind{"read", "EIO", "runs/study"},
                             {"read", "end", ".h5"},
                             {"look", "EIO", "runs/study"},
                             {"open", "EIO", "runs/study"}}) {
      const auto fail_at = [&](int at) {
        // A missing page is made again, which needs all files.
        fs::remove(scratch / "runs/study/bending_stiffness_Nm2=2/page.html");
        return run_failing(scratch, Fault{kind.call, at, kind.mode, kind.path}, "dresslife", command);
      };
      REQUIRE(fail_at(0).status == 0);
      for (const int at : some_of(calls_counted(scratch), rounds(6), random)) {
        const Outcome outcome = fail_at(at);
        INFO(command << ' ' << kind.call << ' ' << kind.mode << ' ' << at << ": " << outcome.status << outcome.out
                     << outcome.err);
        REQUIRE((outcome.status == 0 || outcome.status == 1));
        if (outcome.status == 0 && command.starts_with("status")) REQUIRE(outcome.out == status);
        if (outcome.status == 1) REQUIRE(outcome.err.find("error: ") != std::string::npos);
        for (const auto& [name, bytes] : results(scratch / "runs/study")) {
          INFO(name);
          if (outcome.status == 0 || name.ends_with("ranking.csv") || name.ends_with(".h5"))
            REQUIRE(bytes == right.at(name));
        }
        ++(outcome.status == 0 ? whole : refused);
        must_run(scratch, "dresslife", "run study.yaml --quiet");
        REQUIRE(results(scratch / "runs/study") == right);
      }
    }
  std::cout << "failing reads of the runner with seed " << seed << ": " << refused << " refused, " << whole
            << " whole, 0 false\n";
}

TEST_CASE("no bit that turns in a file of results while a page is made from it changes the page") {
  Scratch scratch;
  write_small_job(scratch);
  scratch.write("study.yaml", "base: job.yaml\njobs: {a: {}}\n");
  must_run(scratch, "dresslife", "run study.yaml --quiet");
  const fs::path page = scratch / "runs/study/a/page.html";
  const std::string right = content(page);
  const auto fail_at = [&](int at) {
    fs::remove(page);
    return run_failing(scratch, Fault{"read", at, "flip", "life.h5"}, "dresslife", "page runs/study/a");
  };
  REQUIRE(fail_at(0).status == 0);
  REQUIRE(content(page) == right);
  const int total = calls_counted(scratch);
  for (int at = 1; at <= total; ++at) {
    const Outcome outcome = fail_at(at);
    INFO(at << " of " << total << ": " << outcome.status << outcome.err);
    CHECK((outcome.status == 0 ? content(page) == right : is_one_error(outcome.err) && !fs::exists(page)));
  }
}

TEST_CASE("on a file system without locks everything goes on, with a note") {
  Scratch scratch;
  write_small_job(scratch);
  scratch.write("study.yaml", "base: job.yaml\n");
  for (const std::string error : {"ENOTSUP", "ENOLCK"}) {
    const Fault without_locks{"lock", 1, error, "", "all"};
    const Outcome sim = run_failing(scratch, without_locks, "dresslife-sim", "job.yaml -o motion.h5");
    CHECK(sim.status == 0);
    const Outcome study = run_failing(scratch, without_locks, "dresslife", "run study.yaml -o " + error);
    INFO(study.err);
    CHECK(study.status == 0);
    CHECK(study.err.find("lies on a file system without locks: let no two runs write there at a time") !=
          std::string::npos);
    CHECK_FALSE(holds_parts(scratch.folder()));
  }
}
