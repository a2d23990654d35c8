// Files of a stage after a failure of the disk, of memory or by another writer: the output is complete, or does not exist.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <random>

#include "pipeline/files/files.h"
#include "tests/catch.h"
#include "tests/cli/process.h"
#include "tests/faults/failing_calls.h"

using namespace dresslife::tests;
using dresslife::pipeline::FileReader;

namespace {

struct Stage {
  std::string program, input, output;
  std::string command(const std::string& to) const { return input + " -o " + to + " --quiet"; }
};
const std::vector<Stage> stages{{"dresslife-sim", "job.yaml", "motion.h5"},
                                {"dresslife-strain", "motion.h5", "strain.h5"},
                                {"dresslife-fatigue", "strain.h5", "life.h5"}};

/// A small job and the output files of its stages.
class Chain {
 public:
  Chain() {
    write_small_job(scratch);
    for (const Stage& stage : stages) {
      must_run(scratch, stage.program, stage.command(stage.output));
      files[stage.output] = content(scratch / stage.output);
    }
  }
  Scratch scratch;
  std::map<std::string, std::string> files;  ///< bytes of each file
};

int entries(const fs::path& folder) {
  return static_cast<int>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

constexpr int ended_by_signal = 128;  // a shell's status for signals begins here

}  // namespace

TEST_CASE("each write, sync, close, cut and rename that fails fails the stage, or does no harm") {
  const Chain chain;
  const Scratch& scratch = chain.scratch;
  fs::create_directories(scratch / "out");
  const unsigned seed = std::random_device{}();
  std::mt19937 random(seed);
  std::cout << "failing calls with seed " << seed << '\n';
  for (const Stage& stage : stages)
    for (const std::string call : {"write", "sync", "close", "cut", "rename"}) {
      const auto fail_at = [&](int at) {
        return run_failing(scratch, call, at, stage.program, stage.command("out/" + stage.output));
      };
      REQUIRE(fail_at(0).status == 0);
      const int total = calls_counted(scratch);
      fs::remove(scratch / "out" / stage.output);
      INFO(stage.program << " " << call);
      REQUIRE(total > 0);
      int failed = 0, whole = 0;
      for (const int at : some_of(total, rounds(16), random)) {
        const Outcome outcome = fail_at(at);
        INFO(stage.program << " " << call << " " << at << " of " << total << ": " << outcome.err);
        REQUIRE(outcome.status < ended_by_signal);
        if (outcome.status == 0) {
          REQUIRE(content(scratch / "out" / stage.output) == chain.files.at(stage.output));
          ++whole;
        } else {
          REQUIRE(outcome.status == 1);
          REQUIRE(outcome.err.find("out/" + stage.output + ": error: cannot be written (") == 0);
          ++failed;
        }
        fs::remove(scratch / "out" / stage.output);
        REQUIRE(entries(scratch / "out") == 0);
      }
      std::cout << stage.program << ": " << call << " failed at " << failed + whole << " of " << total
                << " places: " << failed << " refused, " << whole << " whole, 0 false\n";
      // A descriptor is closed once more after the file has its name. At this time all data are on the disk.
      CHECK(whole <= (call == "close" ? 1 : 0));
    }
}

TEST_CASE("a file that may not grow ends no stage with a signal, and leaves nothing") {
  const Chain chain;
  const Scratch& scratch = chain.scratch;
  fs::create_directories(scratch / "out");
  int tried = 0;
  for (const Stage& stage : stages) {
    const auto blocks = static_cast<int>(chain.files.at(stage.output).size() / 512);  // of ulimit -f
    // From 1 block on, because the stage's messages also go to a file.
    for (int size = 1; size < blocks; size += std::max(1, blocks / 6)) {
      const Outcome outcome = run_with(scratch, "ulimit -f " + std::to_string(size) + ";", stage.program,
                                       stage.command("out/" + stage.output) + " 2>&1 | cat >&2; exit 0");
      INFO(stage.program << " " << size << ": " << outcome.err);
      CHECK(outcome.err.find("cannot be written (File too large); free space on the disk") != std::string::npos);
      CHECK(outcome.err.find("egmentation") == std::string::npos);
      CHECK(entries(scratch / "out") == 0);
      ++tried;
    }
  }
  std::cout << "files that may not grow: " << tried << " sizes, all refused\n";
}

TEST_CASE("two writers of one output: both end well, and the file is whole") {
  const Chain chain;
  const Scratch& scratch = chain.scratch;
  fs::create_directories(scratch / "out");
  for (const Stage& stage : stages)
    for (int round = 0; round < rounds(6); ++round) {
      const std::string call = "'" DRESSLIFE_BIN_DIR "/" + stage.program + "' " + stage.command("out/" + stage.output);
      const Outcome outcome =
          run_shell(scratch, call + " & first=$!; " + call + "; second=$?; wait $first && exit $second");
      INFO(stage.program << ": " << outcome.err);
      REQUIRE(outcome.status == 0);
      REQUIRE(content(scratch / "out" / stage.output) == chain.files.at(stage.output));
      fs::remove(scratch / "out" / stage.output);
      REQUIRE(entries(scratch / "out") == 0);
    }
}

TEST_CASE("no bit of a file can turn without a word") {
  const Chain chain;
  const Scratch& scratch = chain.scratch;
  const int flips = rounds(100);
  const unsigned seed = std::random_device{}();
  std::mt19937_64 random(seed);
  std::cout << "bits turned with seed " << seed;
  const std::map<std::string, const dresslife::pipeline::Format*> formats{
      {"motion.h5", &dresslife::pipeline::motion_format()},
      {"strain.h5", &dresslife::pipeline::strain_format()},
      {"life.h5", &dresslife::pipeline::life_format()}};
  for (const auto& [name, format] : formats) {
    int noticed = 0;
    for (int flip = 0; flip < flips; ++flip) {
      std::string bytes = chain.files.at(name);
      // The first bytes are few among many, so they get an extra share of the changes.
      const std::size_t at = flip % 5 == 0 ? random() % 600 : random() % bytes.size();
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
      const fs::path file = scratch.write("flipped.h5", bytes);
      try {
        const FileReader reader(file, *format);
      } catch (const dresslife::pipeline::InputError&) {
        ++noticed;
      }
    }
    CHECK(noticed == flips);
    std::cout << "; " << name << " " << noticed << " of " << flips << " noticed";
  }
  std::cout << '\n';
  // The error in the form that a user sees.
  std::string bytes = chain.files.at("motion.h5");
  bytes[bytes.size() / 2] ^= 1;
  scratch.write("flipped.h5", bytes);
  const Outcome outcome = run(scratch, "dresslife-strain", "flipped.h5 -o out.h5");
  CHECK(outcome.status == 1);
  CHECK(outcome.err ==
        "flipped.h5: error: is damaged or was edited (its bytes are not those of its checksum); make the "
        "file again "
        "with dresslife-sim, then run again\n");
  CHECK_FALSE(fs::exists(scratch / "out.h5"));
}

TEST_CASE("an output replaces a result and nothing else") {
  const Chain chain;
  const Scratch& scratch = chain.scratch;
  const auto refused = [&](const std::string& arguments, const std::string& words) {
    const Outcome outcome = run(scratch, "dresslife-strain", "motion.h5 " + arguments);
    INFO(arguments << ": " << outcome.err);
    CHECK(outcome.status == 1);
    CHECK(outcome.err.find(words) != std::string::npos);
  };
  const std::string job = content(scratch / "job.yaml");
  refused("--job job.yaml -o job.yaml", "is one of the files that are read");
  refused("--job job.yaml -o job.yaml --force", "is one of the files that are read");
  CHECK(content(scratch / "job.yaml") == job);
  refused("-o motion.h5 --force", "is one of the files that are read");
  const std::string poses = content(scratch / "poses.csv");
  refused("-o poses.csv",
          "is there already and was not written by dresslife, or was changed since; move it away, name another place "
          "with -o, or replace it with --force");
  CHECK(content(scratch / "poses.csv") == poses);
  CHECK(run(scratch, "dresslife-sim", "job.yaml -o poses.csv --force").status == 1);  // the job reads this file
  CHECK(content(scratch / "poses.csv") == poses);
  scratch.write("mine.txt", "mine");
  fs::create_symlink("mine.txt", scratch / "link.h5");
  refused("-o link.h5 --force", "is a link to another file");
  CHECK(content(scratch / "mine.txt") == "mine");
  REQUIRE(run_shell(scratch, "mkfifo pipe.h5").status == 0);
  refused("-o pipe.h5 --force", "is a device or a pipe");
  refused("-o /dev/null", "is a device or a pipe");
  CHECK(fs::is_character_file("/dev/null"));
  refused("-o .", "is a folder");
  CHECK(run(scratch, "dresslife-strain", "motion.h5 -o mine.txt --force").status == 0);
  CHECK(content(scratch / "mine.txt") == chain.files.at("strain.h5"));
  CHECK(run(scratch, "dresslife-strain", "motion.h5 -o strain.h5").status ==
        0);                       // a result is overwritten without a question
  scratch.write("empty.h5", "");  // an empty file, as mktemp makes it
  CHECK(run(scratch, "dresslife-strain", "motion.h5 -o empty.h5").status == 0);
}

TEST_CASE("what killed writers left is cleared away, what lives is not") {
  const Chain chain;
  const Scratch& scratch = chain.scratch;
  scratch.write("dresslife-99999-0.part", "left behind");
  scratch.write("motion.h5.part", "not ours");
  CHECK(run(scratch, "dresslife-sim", "job.yaml -o motion.h5").status == 0);
  CHECK_FALSE(fs::exists(scratch / "dresslife-99999-0.part"));
  CHECK(content(scratch / "motion.h5.part") == "not ours");
}

TEST_CASE("a stage that runs out of its time or memory says so and leaves nothing") {
  const Chain chain;
  const Scratch& scratch = chain.scratch;
  fs::create_directories(scratch / "out");
  const Outcome slow = run(scratch, "dresslife-sim",
                           "job.yaml -o out/m.h5 --quiet --job-time 1 --set simulation.time_step_ms=0.01 "
                           "--set simulation.segments=400");
  CHECK(slow.status == 1);
  CHECK(slow.err.find("dresslife-sim: error: took longer than 1 s (--job-time)") == 0);
  CHECK(entries(scratch / "out") == 0);
  // The sanitizers use more address space than these limits leave.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  for (const Stage& stage : stages)
    for (const int kilobytes : {48'000, 50'000, 53'000, 57'000, 62'000, 68'000, 75'000}) {
      const Outcome large = run_with(scratch, "ulimit -v " + std::to_string(kilobytes) + ";", stage.program,
                                     stage.command("out/" + stage.output));
      INFO(stage.program << ' ' << kilobytes << ": " << large.status << large.err);
      if (large.status != 0) {
        CHECK(large.status == 1);
        CHECK(large.err.find(stage.program + ": error: ") == 0);
      }
      fs::remove(scratch / "out" / stage.output);
      CHECK(entries(scratch / "out") == 0);
    }
#endif
}

TEST_CASE("closed and full streams are survived and reported by the exit status") {
  const Chain chain;
  const Scratch& scratch = chain.scratch;
  const std::string bin = "'" DRESSLIFE_BIN_DIR "/dresslife";
  CHECK(run_shell(scratch, bin + "-sim' absent.yaml -o m.h5 2>&-").status == 1);
  const Outcome closed = run_shell(scratch, bin + "-strain' motion.h5 -o s.h5 <&- >&- 2>&-");
  CHECK(closed.status == 0);
  CHECK(content(scratch / "s.h5") == chain.files.at("strain.h5"));  // no message was written into it
  scratch.write("study.yaml", "base: job.yaml\n");
  must_run(scratch, "dresslife", "run study.yaml");
  for (const std::string what : {"run study.yaml", "status study.yaml", "report study.yaml", "manual keys", "--help"}) {
    const Outcome full = run_shell(scratch, bin + "' " + what + " > /dev/full");
    INFO(what << full.err);
    CHECK(full.status == 1);
    CHECK(full.err.find("standard output: error: cannot be written (No space left on device)") != std::string::npos);
  }
}

// The sanitizers use more address space than these limits leave.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST_CASE("with too few threads a stage does the work on those that it has") {
  const Chain chain;
  const Scratch& scratch = chain.scratch;
  // Each thread needs a stack of 8 MB: with these limits of address space some threads cannot start.
  for (const int kilobytes : {70000, 76500, 90000, 120000, 200000}) {
    const Outcome outcome = run_with(scratch, "ulimit -v " + std::to_string(kilobytes) + "; DRESSLIFE_THREADS=8",
                                     "dresslife-fatigue", "strain.h5 -o few.h5");
    INFO(kilobytes << ": " << outcome.status << outcome.err);
    CHECK(outcome.status < ended_by_signal);
    if (outcome.status == 0)
      CHECK(content(scratch / "few.h5") == chain.files.at("life.h5"));
    else
      CHECK(outcome.err.find("damaged") == std::string::npos);
    fs::remove(scratch / "few.h5");
  }
}
#endif

// The sanitizers find the limits of stack and memory in /proc. Without it they report errors that are none.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST_CASE("programs find themselves and their catalogue where no /proc is mounted") {
  const Scratch scratch;
  write_small_job(scratch);
  scratch.write("study.yaml", "base: job.yaml\n");
  const std::string hidden = "unshare -m sh -c 'mount -t tmpfs none /proc && ";
  if (run_shell(scratch, hidden + "true'").status != 0) {
    WARN("this system lets nobody hide /proc: not tried");
    return;
  }
  const std::string dresslife = "\"" DRESSLIFE_BIN_DIR "/dresslife\" ";
  const Outcome version = run_shell(scratch, hidden + dresslife + "--version'");
  CHECK(version.status == 0);
  CHECK(version.out.find("\ncatalogue: /") != std::string::npos);
  const Outcome study = run_shell(scratch, hidden + dresslife + "run study.yaml'");
  INFO(study.err);
  CHECK(study.status == 0);
  // The results are also up to date on systems with /proc: both methods find the same programs.
  CHECK(run(scratch, "dresslife", "run study.yaml").err.find("nothing to do") != std::string::npos);
}
#endif
