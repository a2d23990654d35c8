// A user's files at the places where commands write remain unchanged.
#include <sys/stat.h>

#include <iostream>
#include <map>
#include <random>

#include "tests/catch.h"
#include "tests/cli/process.h"
#include "tests/faults/failing_calls.h"

using namespace dresslife::tests;

namespace {

struct Command {
  std::string program, arguments;
  bool after_a_run = false;  ///< requires results
};
const std::vector<Command> commands{
    {"dresslife", "run study.yaml -j 2 --quiet"},
    {"dresslife", "run study.yaml -j 2 --quiet --set strain.gate=0.0007", true},
    {"dresslife", "report study.yaml", true},
    {"dresslife", "duty duties.yaml --quiet", true},
    {"dresslife", "plan fleet.csv --duties duties.yaml --today 2026-11-23 --windows 2027-01-05 --quiet", true},
    {"dresslife", "submit study.yaml --only-write"},
    {"dresslife", "page runs/study/a", true},
    {"dresslife", "plot runs/study/a --what cycles -o cycles.svg", true},
    {"dresslife", "export runs/study/a --paraview job.xdmf", true},
    {"dresslife", "preview job.yaml -o job.html"},
    {"dresslife", "draw hose.yaml -o hose.svg"},
    {"dresslife-sim", "job.yaml -o motion.h5"},
    {"dresslife-sim", "job.yaml -o motion.h5 --receipt sim.receipt"},
    {"dresslife-strain", "runs/study/a/motion.h5 -o strain.h5", true},
    {"dresslife-fatigue", "runs/study/a/strain.h5 -o life.h5", true},
    {"dresslife-import", "swing.mod -o swing.yaml"}};
/// Commands that run stages for seconds: tested only in the long form.
const std::vector<Command> long_commands{{"dresslife", "rate hose.yaml"}, {"dresslife", "validate lives.yaml"}};

/// Writes the files of a study beside the small job.
void write_inputs(const Scratch& scratch) {
  write_small_job(scratch);
  scratch.write("study.yaml", "base: job.yaml\njobs: {a: {}, b: {}}\n");
  scratch.write("duties.yaml", "study: study.yaml\nduties: [{name: d, programs: [{job: a, percent_of_time: 0.1}]}]\n");
  scratch.write("fleet.csv", "name,duty,installed\nr,d,\n");
  write_small_hose(scratch);
  scratch.write(
      "lives.yaml",
      "observations:\n  - name: flex\n    what: data sheet\n    job:\n      motion: {rig: {kind: rolling_flex, "
      "radius_diameters: 10, travel_m: 1}}\n      dresspack: {cable: control_cable}\n    cycles: 1e+7\n    outcome: "
      "rating\n    source: made for the tests\n");
  scratch.write("swing.mod",
                "MODULE swing\n"
                "  CONST jointtarget home := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
                "  PROC main()\n    MoveAbsJ home, v500, fine, tool0;\n  ENDPROC\nENDMODULE\n");
}

/// Returns every file, link and folder below a folder, with its content.
std::map<std::string, std::string> things_in(const fs::path& folder) {
  std::map<std::string, std::string> things;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = fs::relative(entry.path(), folder).string();
    if (name == ".out" || name == ".err" || name == "call.sh") continue;
    things[name] = entry.is_symlink()        ? "link to " + fs::read_symlink(entry.path()).string()
                   : entry.is_directory()    ? "folder"
                   : entry.is_regular_file() ? "file " + content(entry.path())
                                             : "device or pipe";
  }
  return things;
}

enum class Thing { file, folder, link, pipe };
constexpr std::array all_things{Thing::file, Thing::folder, Thing::link, Thing::pipe};

void put(const Scratch& scratch, const std::string& name, Thing thing) {
  fs::remove_all(scratch / name);
  fs::create_directories((scratch / name).parent_path());
  if (thing == Thing::file) scratch.write(name, "mine\n");
  if (thing == Thing::folder) scratch.write(name + "/mine", "mine\n");
  if (thing == Thing::link) {
    scratch.write("target", "mine\n");
    fs::create_symlink(scratch / "target", scratch / name);
  }
  if (thing == Thing::pipe) REQUIRE(::mkfifo((scratch / name).c_str(), 0600) == 0);
}

bool is_below(const std::string& name, const std::string& folder) {
  return name == folder || name.starts_with(folder + "/");
}

}  // namespace

TEST_CASE("no command replaces, empties or removes what is not ours, and each names it") {
  Scratch before, after;
  write_inputs(before);
  write_inputs(after);
  must_run(after, "dresslife", "run study.yaml -j 2 --quiet");
  const unsigned seed = std::random_device{}();
  std::mt19937 random(seed);
  std::cout << "things of the user with seed " << seed;
  std::vector<Command> tried = commands;
  if (rounds(1) > 1) tried.insert(tried.end(), long_commands.begin(), long_commands.end());
  int tries = 0, refused = 0;
  for (const Command& command : tried) {
    const auto in_a_copy = [&](const auto& act) {
      Scratch copy;
      fs::copy(command.after_a_run ? after.folder() : before.folder(), copy.folder(),
               fs::copy_options::recursive | fs::copy_options::overwrite_existing);
      act(copy);
    };
    INFO(command.program << " " << command.arguments);
    // Outputs of the command: all files that are new or changed afterwards.
    std::vector<std::string> outputs;
    in_a_copy([&](const Scratch& scratch) {
      const auto was = things_in(scratch.folder());
      must_run(scratch, command.program, command.arguments);
      for (const auto& [name, thing] : things_in(scratch.folder()))
        if (thing != "folder" && (!was.contains(name) || was.at(name) != thing)) outputs.push_back(name);
      REQUIRE(!holds_parts(scratch.folder()));
    });
    for (const int k : some_of(static_cast<int>(outputs.size()), rounds(4), random)) {
      const std::string& name = outputs[static_cast<std::size_t>(k) - 1];
      if (name.find(".stage/") != std::string::npos && command.after_a_run) continue;  // inside a folder of the program
      for (const Thing thing : all_things) {
        if (thing != Thing::file && random() % 4 != 0 && rounds(1) == 1) continue;
        in_a_copy([&](const Scratch& scratch) {
          put(scratch, name, thing);
          const auto was = things_in(scratch.folder());
          const Outcome outcome = run(scratch, command.program, command.arguments);
          INFO(name << " as thing " << static_cast<int>(thing) << ": " << outcome.status << outcome.err);
          const auto now = things_in(scratch.folder());
          for (const auto& [other, held] : was)
            if (is_below(other, name) || other == "target") REQUIRE((now.contains(other) && now.at(other) == held));
          if (thing == Thing::file) {
            REQUIRE(outcome.status == 1);
            const std::string named = name.substr(0, name.find(".stage/"));
            std::string answer =
                outcome.err + outcome.out;  // the table of a study's jobs states the reason in wrapped lines
            answer.erase(std::remove_if(answer.begin(), answer.end(), [](char c) { return c == ' ' || c == '\n'; }),
                         answer.end());
            REQUIRE(answer.find(fs::path(named).filename().string()) != std::string::npos);
            REQUIRE(answer.find("moveitaway") != std::string::npos);
            ++refused;
          }
          REQUIRE(outcome.status < 128);
          REQUIRE(!holds_parts(scratch.folder()));
          ++tries;
        });
      }
    }
  }
  std::cout << ": " << tries << " things in the way of " << tried.size() << " commands, " << refused
            << " files refused by name, 0 lost\n";
}

TEST_CASE("a run that would replace a file of the user ends before it computes") {
  for (const std::string name : {"ranking.csv", "report.html", "a/log", "a/page.html"}) {
    Scratch scratch;
    write_small_job(scratch);
    scratch.write("study.yaml", "base: job.yaml\njobs: {a: {}}\n");
    scratch.write("runs/study/" + name, "mine\n");
    const Outcome outcome = run(scratch, "dresslife", "run study.yaml --quiet");
    INFO(name << ": " << outcome.err);
    CHECK(outcome.status == 1);
    CHECK(outcome.err.find(name + ": error: is there already") != std::string::npos);
    CHECK(content(scratch / ("runs/study/" + name)) == "mine\n");
    CHECK_FALSE(fs::exists(scratch / "runs/study/a/motion.h5"));
  }
}

TEST_CASE("files of the user beside results stay through every command, whatever goes of the results") {
  Scratch scratch;
  write_inputs(scratch);
  must_run(scratch, "dresslife", "run study.yaml -j 2 --quiet");
  std::vector<std::string> mine;
  for (const auto& [name, thing] : things_in(scratch / "runs"))
    if (thing == "folder") mine.push_back("runs/" + name + "/mine");
  for (const std::string& name : mine) scratch.write(name, "mine\n");
  scratch.write("runs/study/b/log", "my own log\n");
  fs::create_directories(scratch / "runs/study/c/.stage");
  scratch.write("runs/study/c/job.yaml", "robot:\n  name: mine\n");
  const auto check = [&](const std::string& after) {
    INFO(after);
    for (const std::string& name : mine) CHECK(content(scratch / name) == "mine\n");
    CHECK(content(scratch / "runs/study/b/log") == "my own log\n");
    CHECK(content(scratch / "runs/study/c/job.yaml") == "robot:\n  name: mine\n");
  };
  for (const Command& command : commands) {
    run(scratch, command.program, command.arguments);
    check(command.program + " " + command.arguments);
  }
  // The study contains neither of these jobs now.
  scratch.write("study.yaml", "base: job.yaml\njobs: {d: {}}\nkeep: lives\n");
  const Outcome clean = run(scratch, "dresslife", "clean study.yaml");
  INFO(clean.out << clean.err);
  CHECK(clean.status == 0);
  check("clean");
  for (const char* gone : {"a/life.h5", "a/job.yaml", "a/page.html", "b/motion.h5", "a/.stage/sim.receipt"})
    CHECK_FALSE(fs::exists(scratch / (std::string("runs/study/") + gone)));
}

TEST_CASE("force: it replaces a file of the user, and never one that the command reads") {
  Scratch scratch;
  write_inputs(scratch);
  scratch.write("hose.svg", "mine\n");
  CHECK(run(scratch, "dresslife", "draw hose.yaml -o hose.svg --force").status == 0);
  CHECK(content(scratch / "hose.svg").starts_with("<!-- Written by dresslife"));
  const std::string hose = content(scratch / "hose.yaml");
  CHECK(run(scratch, "dresslife", "draw hose.yaml -o hose.yaml --force").status == 1);
  CHECK(content(scratch / "hose.yaml") == hose);
  // The base of a job lies in the folder of the job's results.
  fs::create_directories(scratch / "study/a");
  fs::rename(scratch / "job.yaml", scratch / "study/a/job.yaml");
  fs::rename(scratch / "poses.csv", scratch / "study/a/poses.csv");
  const std::string job = content(scratch / "study/a/job.yaml");
  scratch.write("study.yaml", "base: study/a/job.yaml\njobs: {a: {}}\n");
  for (const char* force : {"", " --force"}) {
    const Outcome outcome = run(scratch, "dresslife", std::string("run study.yaml -o .") + force);
    INFO(outcome.err);
    CHECK(outcome.status == 1);
    CHECK(is_one_error(outcome.err));
    CHECK(outcome.err.starts_with("./study/a/job.yaml: error: is one of the files that are read"));
    CHECK(content(scratch / "study/a/job.yaml") == job);
    CHECK_FALSE(fs::exists(scratch / "study/a/motion.h5"));
  }
  // In its own folder the same study runs, also over results of the user if the user forces it.
  for (const std::string name : {"motion.h5", "strain.h5", "life.h5"}) {
    scratch.write("runs/study/a/" + name, "mine\n");
    const Outcome outcome = run(scratch, "dresslife", "run study.yaml");
    INFO(name << ": " << outcome.out << outcome.err);
    CHECK(outcome.status == 1);
    CHECK(outcome.out.find("a/" + name + ": error: is there already and was not written by dresslife") !=
          std::string::npos);
    CHECK(content(scratch / ("runs/study/a/" + name)) == "mine\n");
    fs::remove_all(scratch / "runs");
  }
  scratch.write("runs/study/a/life.h5", "mine\n");
  CHECK(run(scratch, "dresslife", "run study.yaml --force").status == 0);
}

TEST_CASE("a command that would replace a file of the user names its own option or another way") {
  Scratch scratch;
  write_inputs(scratch);
  scratch.write("mine.yaml", "mine: 1\n");
  scratch.write("job_improved.yaml", "mine: 1\n");
  for (const auto& [program, words, remedy] :
       {std::tuple("dresslife", "new --robot abb_irb2600_12_165 mine.yaml", "name another job"),
        std::tuple("dresslife", "improve job.yaml", "run in another folder"),
        std::tuple("dresslife-sim", "job.yaml -o m.h5 --receipt mine.yaml", "name another file with --receipt"),
        std::tuple("dresslife-sim", "job.yaml -o mine.yaml", "name another place with -o")}) {
    const Outcome outcome = run(scratch, program, words);
    INFO(words << ": " << outcome.err);
    CHECK(outcome.status == 1);
    CHECK(outcome.err.ends_with(std::string("; move it away, ") + remedy + ", or replace it with --force\n"));
  }
}

TEST_CASE("a file of ours that a user edits is theirs, one without edits is made again when it is damaged") {
  Scratch scratch;
  write_inputs(scratch);
  must_run(scratch, "dresslife", "run study.yaml -j 2 --quiet");
  must_run(scratch, "dresslife-import", "swing.mod -o swing.yaml");
  const std::string imported = content(scratch / "swing.yaml") + "# a note of mine\n";
  scratch.write("swing.yaml", imported);
  CHECK(run(scratch, "dresslife-import", "swing.mod -o swing.yaml").status == 1);
  CHECK(content(scratch / "swing.yaml") == imported);
  const std::string edited = content(scratch / "runs/study/a/job.yaml") + "# mine\n";
  scratch.write("runs/study/a/job.yaml", edited);
  const Outcome refused = run(scratch, "dresslife", "run study.yaml --set strain.gate=0.0007");
  INFO(refused.err);
  CHECK(refused.status == 1);
  CHECK(refused.err.find("a/job.yaml: error: is there already and was not written by dresslife, or was changed "
                         "since; move it away") != std::string::npos);
  CHECK(content(scratch / "runs/study/a/job.yaml") == edited);
  fs::remove(scratch / "runs/study/a/job.yaml");
  must_run(scratch, "dresslife", "run study.yaml");
  for (const std::string name : {"ranking.csv", "report.html", "a/page.html", "build.ninja"}) {
    const fs::path file = scratch / ("runs/study/" + name);
    const std::string right = content(file);
    std::string wrong = right;
    wrong[wrong.size() * 2 / 3] ^= 1;
    scratch.write("runs/study/" + name, wrong);
    const Outcome mended = run(scratch, "dresslife", "run study.yaml");
    INFO(name << mended.err);
    CHECK(mended.status == 0);
    CHECK((content(file) == right || name == "build.ninja"));  // which only a run with work to do needs
  }
}
