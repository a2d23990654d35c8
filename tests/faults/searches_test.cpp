// Commands that run stages themselves, with failing calls and allocations. A command with status 0 has the output and files of
// a run without the fault. A command with status 1 states the cause. The next command without a fault is correct.
#include <iostream>
#include <random>

#include "tests/catch.h"
#include "tests/cli/process.h"
#include "tests/faults/failing_calls.h"

using namespace dresslife::tests;

namespace {

struct Command {
  std::string arguments, results;  ///< below runs/
};
const std::vector<Command> commands{
    {"rate hose.yaml --quiet", "rate_hose"},
    {"validate lives.yaml --quiet", "validate_lives"},
    {"calibrate lives.yaml --quiet", "calibrate_lives"},
    {"duty duties.yaml --quiet", "job"},
    {"plan fleet.csv --duties duties.yaml --today 2026-11-23 --windows 2027-01-05 --quiet", "job"},
    {"improve better.yaml --trials 2 --short-runs 2 --off 0 --quiet", "better_improve"},
    {"reprogram robot.yaml --lines 1 --quiet --set uncertainty.enabled=false",
     "robot_reprogram"},  // the others vary inputs
    {"route abb_irb2600_12_165 --dresspack ./hose.yaml --tried 20 --short-runs 2 --off 0 --quiet "
     "--set simulation.segments=8 --job found.yaml",
     "abb_irb2600_12_165_route"}};

void write_inputs(const Scratch& scratch) {
  write_small_job(scratch);
  scratch.write("better.yaml", R"(base: job.yaml
jobs:
  hose:
    dresspack.least_bend_radius_mm: 60
    dresspack.components.1.base_grip_N: 2
    dresspack.components.1.tool_grip_N: 2
    strain.slip: [free, stick]
free: {routing.free_length_m: 0.85 .. 0.95}
limits: {tension_N: 400}
)");
  scratch.write("duties.yaml", "study: job.yaml\nduties: [{name: d, programs: [{job: job, percent_of_time: 0.1}]}]\n");
  scratch.write("fleet.csv", "name,duty,installed\nr,d,\n");
  scratch.write("hose.yaml", thin_hose);
  scratch.write("lives.yaml", R"(observations:
  - name: wire
    job:
      motion: {rig: {kind: axial, elongation_percent: 0.2}}
      dresspack:
        cable: {name: wire, source: test, radius_mm: 0.1, components: [
          {name: strand, radius_mm: 0.1, helix_radius_mm: 0, material: copper_halved}]}
    what: pulled
    source: made for the tests
    criterion: first_wire
    cycles: 1e+6
    outcome: broken
)");
  scratch.write("turn.mod", R"(MODULE turn
  CONST jointtarget home:=[[0,-10,10,0,25,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget over:=[[0,-10,10,0,25,90],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveAbsJ home,v2000,fine,tool0;
    MoveAbsJ over,v2000,fine,tool0;
    MoveAbsJ home,v2000,fine,tool0;
  ENDPROC
ENDMODULE
)");
  scratch.write("robot.yaml", R"(robot: abb_irb6640_185_280
motion: {program: turn.mod}
dresspack: sensor_cable
routing:
  base_clamp: {link: link_3, position_m: [-0.1, 0, 0.45], direction: [1, 0, 0.45]}
  tool_clamp: {link: link_6, position_m: [0.15, 0, 0.18], direction: [1, 0, -0.35]}
  free_length_m: 2.035
simulation: {segments: 12, sample_rate_Hz: 20}
)");
  scratch.write("notes.txt", "mine\n");
}

/// Returns the kinds of faults of every command, and exhausted memory.
std::vector<std::pair<Kind, std::string>> kinds_with_memory() {
  std::vector<std::pair<Kind, std::string>> all;
  for (const Kind& kind : kinds) all.emplace_back(kind, "0");
// The sanitizers have their own allocators.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  for (const char* more : {"0", "all"}) all.emplace_back(Kind{"allocate", "", ""}, more);
#endif
  return all;
}

}  // namespace

TEST_CASE("searches and comparisons under failing calls: each is right, or refused and right the next time") {
  const unsigned seed = std::random_device{}();
  std::mt19937 random(seed);
  std::cout << "failing calls of searches with seed " << seed << '\n';
  const bool is_long = rounds(1) > 1;
  for (const Command& command : commands) DYNAMIC_SECTION(command.arguments.substr(0, command.arguments.find(' '))) {
      Scratch scratch;
      write_inputs(scratch);
      const std::map<std::string, std::string> inputs = files_in(scratch.folder());
      const Outcome right = run(scratch, "dresslife", command.arguments);
      INFO(command.arguments << ": " << right.out << right.err);
      REQUIRE(right.status == 0);
      scratch.write("runs/" + command.results + "/notes.txt", "mine\n");
      const std::map<std::string, std::string> after = files_in(scratch.folder());
      // State with the stages' results but without those of the command itself.
      const std::map<std::string, std::string> half = [&] {
        std::map<std::string, std::string> files = after;
        std::erase_if(files, [&](const auto& file) {
          const fs::path parent = fs::path(file.first).parent_path();
          return !inputs.contains(file.first) && fs::path(file.first).filename() != "notes.txt" &&
                 (parent.empty() || parent == fs::path("runs") / command.results);
        });
        return files;
      }();
      int refused = 0, whole = 0;
      long calls = 0;
      const auto check_after = [&](const Outcome& outcome) {
        const std::map<std::string, std::string> now = files_in(scratch.folder());
        REQUIRE(outcome.out == right.out);
        for (const auto& [name, bytes] : after) {
          INFO(name);
          REQUIRE((is_a_note(name) || (now.contains(name) && now.at(name) == bytes)));
        }
      };
      for (const auto& [kind, more] : kinds_with_memory())
        for (const auto* before : {&half, &inputs}) {
          // From no results each command takes seconds. scripts/faults tries all kinds; each run of the tests tries others.
          if (!is_long && (before == &inputs || random() % 32 != 0)) continue;
          const auto fail_at = [&, &kind = kind, &more = more](int at) {
            restore(scratch, *before);
            return run_failing(scratch, Fault{kind.call, at, kind.mode, kind.path, more}, "dresslife",
                               command.arguments);
          };
          fail_at(0);
          const int total = calls_counted(scratch);
          if (total == 0) continue;
          calls += total;
          for (const int at : some_of(total, before == &half ? rounds(2) : std::max(1, rounds(1) / 4), random)) {
            const Outcome outcome = fail_at(at);
            INFO(kind.call << ' ' << kind.mode << ' ' << at << " of " << total << " (" << more << " more), "
                           << (before == &half ? "resumed" : "from nothing") << ": " << outcome.status << '\n'
                           << outcome.out << outcome.err);
            REQUIRE((outcome.status == 0 || outcome.status == 1));
            REQUIRE_FALSE(holds_parts(scratch.folder()));
            for (const auto& [name, bytes] : inputs) REQUIRE(content(scratch / name) == bytes);
            if (before == &half) REQUIRE(content(scratch / ("runs/" + command.results + "/notes.txt")) == "mine\n");
            scratch.write("runs/" + command.results + "/notes.txt", "mine\n");
            if (outcome.status == 0) {
              check_after(outcome);
              ++whole;
            } else {
              REQUIRE((outcome.err + outcome.out).find("error: ") != std::string::npos);
              ++refused;
              const Outcome next = run(scratch, "dresslife", command.arguments);
              INFO("the next time: " << next.out << next.err);
              REQUIRE(next.status == 0);
              check_after(next);
            }
          }
        }
      std::cout << command.arguments.substr(0, command.arguments.find(' ')) << ": " << refused << " refused, " << whole
                << " whole, 0 false, 0 lost, of " << calls << " calls\n";
    }
}

TEST_CASE("a search takes no fault of the machine for a bad routing") {
  const std::string search = "improve better.yaml --short-runs 2 --off 0 --quiet --trials ";
  Scratch undisturbed;
  write_inputs(undisturbed);
  must_run(undisturbed, "dresslife", search + "2");
  const Outcome right = must_run(undisturbed, "dresslife", search + "4");
  const std::string allocation =
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
      "write";
#else
      "allocate";
#endif
  for (const auto& [program, call] : {std::pair{"dresslife-sim", std::string("write")},
                                      {"dresslife-strain", "write"},
                                      {"dresslife-fatigue", allocation}}) {
    Scratch scratch;
    write_inputs(scratch);
    must_run(scratch, "dresslife", search + "2");
    const Outcome failed = run_with(scratch,
                                    std::string("env ASAN_OPTIONS=verify_asan_link_order=0 FAULT_CALL=") + call +
                                        " FAULT_AT=1 FAULT_MORE=all FAULT_PROGRAM=" + program +
                                        " LD_PRELOAD='" DRESSLIFE_FAILING_CALLS "'",
                                    "dresslife", search + "4");
    INFO(program << ": " << failed.status << failed.out << failed.err);
    CHECK(failed.status == 1);
    CHECK(failed.err.find("then run again\n") != std::string::npos);
    const Outcome next = run(scratch, "dresslife", search + "4");
    INFO(next.err);
    CHECK(next.status == 0);
    CHECK(next.out == right.out);
  }
}

TEST_CASE("a file system that cannot say what a path leads to changes no patch of a program") {
  Scratch scratch;
  write_inputs(scratch);
  scratch.write("short.yaml", "base: robot.yaml\njobs: {a: {}}\n");
  must_run(scratch, "dresslife", "run short.yaml --quiet");
  const std::string arguments = "robot.yaml --ways runs/short/a/life.h5 --lines 1 -o ways.h5 --quiet";
  must_run(scratch, "dresslife-import", arguments);
  const std::string right = content(scratch / "ways.h5");
  // In the program and its folder: these calls find the files of the patch.
  for (const std::string& path : {(scratch / "turn.mod").string(), std::string("dresslife-")})
    for (const std::string call : {"look", "list"}) {
      const auto fail_at = [&](int at) {
        fs::remove(scratch / "ways.h5");
        return run_failing(scratch, Fault{call, at, "EIO", path}, "dresslife-import", arguments);
      };
      REQUIRE(fail_at(0).status == 0);
      std::mt19937 random(1);
      const int total = calls_counted(scratch);
      for (const int at : path == "dresslife-" ? some_of(total, rounds(30), random) : some_of(total, total, random)) {
        const Outcome outcome = fail_at(at);
        INFO(call << ' ' << at << " of " << total << " of " << path << ": " << outcome.status << outcome.err);
        REQUIRE((outcome.status == 1 || (outcome.status == 0 && content(scratch / "ways.h5") == right)));
        if (outcome.status == 1) REQUIRE(is_one_error(outcome.err));
      }
    }
}
