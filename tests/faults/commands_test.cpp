// Commands of dresslife that take at most a second, with every kind of failing call. With status 0 their output and files must
// equal those without the fault. With status 1 they state the cause. No file is half written, and no file of the user is lost.
#include <iostream>
#include <random>

#include "tests/catch.h"
#include "tests/cli/process.h"
#include "tests/faults/failing_calls.h"

using namespace dresslife::tests;

namespace {

struct Command {
  std::string program, arguments;
};
const std::vector<Command> commands{{"dresslife", "status study.yaml"},
                                    {"dresslife", "report study.yaml"},
                                    {"dresslife", "page runs/study/a"},
                                    {"dresslife", "plot runs/study/a --what cycles -o cycles.svg"},
                                    {"dresslife", "export runs/study/a --paraview job.xdmf"},
                                    {"dresslife", "preview job.yaml -o job.html"},
                                    {"dresslife", "draw hose.yaml -o hose.svg"},
                                    {"dresslife", "show job.yaml"},
                                    {"dresslife", "show runs/study/a"},
                                    {"dresslife", "check job.yaml"},
                                    {"dresslife", "new --robot abb_irb6640_185_280 --program swing.mod new.yaml"},
                                    {"dresslife", "submit study.yaml --only-write"},
                                    {"dresslife", "clean lives.yaml"},
                                    {"dresslife", "run study.yaml --quiet"},
                                    {"dresslife-sim", "job.yaml --preview -o preview.h5 --quiet"},
                                    {"dresslife-sim", "job.yaml --screen list.yaml -o screening.h5 --quiet"},
                                    {"dresslife-import", "swing.mod -o swing.yaml"},
                                    {"dresslife-import", "asks.mod -o asks.yaml --answers answers.yaml"}};
/// Writes results of a study and files of the user beside them.
void write_inputs(const Scratch& scratch) {
  write_small_job(scratch);
  write_small_hose(scratch);
  scratch.write("study.yaml", "base: job.yaml\njobs: {a: {}}\n");
  const std::string module =
      "MODULE swing\n  CONST jointtarget home := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n  PROC main()\n    "
      "MoveAbsJ home, v500, fine, tool0;\n";
  scratch.write("swing.mod", module + "  ENDPROC\nENDMODULE\n");
  scratch.write(
      "asks.mod",
      module + "    IF di1=1 THEN\n      MoveAbsJ home, v100, fine, tool0;\n    ENDIF\n  ENDPROC\nENDMODULE\n");
  scratch.write("list.yaml", "- {routing.free_length_m: 0.95}\n");
  must_run(scratch, "dresslife", "run study.yaml --quiet");
  // A study that keeps fewer files has the same results.
  scratch.write("lives.yaml", "base: job.yaml\njobs: {a: {}}\nkeep: lives\n");
  must_run(scratch, "dresslife", "run lives.yaml --quiet");
  // The second study has linked files of the first one, which compares their bytes once.
  must_run(scratch, "dresslife", "run study.yaml --quiet");
  scratch.write("runs/study/a/notes.txt", "mine\n");
  scratch.write("runs/lives/a/notes.txt", "mine\n");
  scratch.write("notes.txt", "mine\n");
}

}  // namespace

TEST_CASE(
    "each call that fails in each command is reported or does no harm: no result is false, no file of the user goes") {
  Scratch scratch;
  write_inputs(scratch);
  const std::map<std::string, std::string> before = files_in(scratch.folder());
  const unsigned seed = std::random_device{}();
  std::mt19937 random(seed);
  std::cout << "failing calls of commands with seed " << seed << '\n';
  const bool is_long = rounds(1) > 1;
  for (const Command& command : commands) {
    restore(scratch, before);
    const Outcome right = run(scratch, command.program, command.arguments);
    const std::map<std::string, std::string> after = files_in(scratch.folder());
    const bool asks = command.arguments.find("--answers") != std::string::npos;
    INFO(command.program << ' ' << command.arguments << ": " << right.err);
    REQUIRE(right.status == (asks ? 1 : 0));
    int refused = 0, whole = 0;
    long calls = 0;
    for (const Kind& kind : kinds) {
      if (!is_long && random() % 4 != 0) continue;
      const auto fail_at = [&](int at) {
        restore(scratch, before);
        return run_failing(scratch, Fault{kind.call, at, kind.mode, kind.path}, command.program, command.arguments);
      };
      fail_at(0);
      const int total = calls_counted(scratch);
      if (total == 0) continue;
      calls += total;
      for (const int at : some_of(total, rounds(2), random)) {
        const Outcome outcome = fail_at(at);
        const std::map<std::string, std::string> now = files_in(scratch.folder());
        INFO(command.program << ' ' << command.arguments << ": " << kind.call << ' ' << kind.mode << ' ' << at << " of "
                             << total << ": " << outcome.status << '\n'
                             << outcome.err);
        REQUIRE((outcome.status == 0 || outcome.status == 1));
        REQUIRE_FALSE(holds_parts(scratch.folder()));
        if (outcome.status == right.status && (!asks || outcome.err == right.err)) {
          REQUIRE(outcome.out == right.out);
          for (const auto& [name, bytes] : after) {
            INFO(name);
            REQUIRE((is_a_note(name) || (now.contains(name) && now.at(name) == bytes)));
          }
          ++whole;
        } else {
          REQUIRE(outcome.status == 1);
          REQUIRE(outcome.err.find("error: ") != std::string::npos);
          ++refused;
        }
        // Each file is unchanged, or new and complete, or a removed file of the program.
        for (const auto& [name, bytes] : before) {
          INFO(name);
          const bool as_it_was = now.contains(name) && now.at(name) == bytes;
          const bool as_it_is_to_be =
              after.contains(name) ? now.contains(name) && now.at(name) == after.at(name) : !now.contains(name);
          REQUIRE((as_it_was || as_it_is_to_be || is_a_note(name) || name.ends_with(".html")));
        }
        for (const auto& [name, bytes] : now) {
          INFO(name);
          REQUIRE((before.contains(name) || is_a_note(name) || name.ends_with(".html") ||
                   (after.contains(name) && after.at(name) == bytes)));
        }
      }
    }
    std::cout << command.program << ' ' << command.arguments << ": " << refused << " refused, " << whole
              << " whole, 0 false, 0 lost, of " << calls << " calls\n";
  }
}

TEST_CASE("a system that refuses while a routing is checked is no fault of the routing") {
  Scratch scratch;
  write_inputs(scratch);
  const auto fail_at = [&](int at) {
    return run_failing(scratch, Fault{"make", at, "ENOSPC", "dresslife-"}, "dresslife",
                       "new --robot abb_irb6640_185_280 --program swing.mod new.yaml");
  };
  REQUIRE(fail_at(0).status == 0);
  fs::remove(scratch / "new.yaml");
  const int total = calls_counted(scratch);
  REQUIRE(total > 1);
  for (int at = 1; at <= total; ++at) {
    const Outcome outcome = fail_at(at);
    INFO(at << " of " << total << ": " << outcome.err);
    CHECK(outcome.status == 1);
    CHECK(is_one_error(outcome.err));
    CHECK(outcome.err.find("takes no temporary folder (No space left on device)") != std::string::npos);
    CHECK_FALSE(fs::exists(scratch / "new.yaml"));
  }
}

TEST_CASE("a temporary folder is removed, whatever in it cannot be opened or read") {
  Scratch scratch;
  write_small_job(scratch);
  const fs::path temporary = scratch / "tmp";
  fs::create_directories(temporary);
  for (const std::string call : {"open", "read"})
    for (int at = 1; at <= 8; ++at) {
      const Outcome outcome =
          run_with(scratch,
                   "env TMPDIR='" + temporary.string() + "' FAULT_CALL=" + call + " FAULT_AT=" + std::to_string(at) +
                       " FAULT_PATH=/tmp/dresslife- FAULT_PROGRAM=dresslife LD_PRELOAD='" DRESSLIFE_FAILING_CALLS "'",
                   "dresslife", "preview job.yaml -o job.html");
      INFO(call << ' ' << at << ": " << outcome.err);
      CHECK((outcome.status == 0 || outcome.status == 1));
      CHECK(fs::is_empty(temporary));
    }
}

TEST_CASE("output that cannot be printed ends with status 1 and the reason") {
  Scratch scratch;
  write_inputs(scratch);
  for (const Command& command : commands) {
    const Outcome right = run(scratch, command.program, command.arguments);
    if (right.out.empty()) continue;
    const Outcome outcome = run_with(scratch, "", command.program, command.arguments + " >/dev/full");
    INFO(command.program << ' ' << command.arguments << ": " << outcome.err);
    CHECK(outcome.status == 1);
    CHECK(outcome.err.find("standard output: error: cannot be written (No space left on device)") != std::string::npos);
  }
}
