// Programs that run out of memory at any allocation, in their own code or in a library.
#include <iostream>
#include <random>

#include "tests/catch.h"
#include "tests/cli/process.h"
#include "tests/faults/failing_calls.h"

using namespace dresslife::tests;

// The sanitizers have their own allocators.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

TEST_CASE("an allocation that fails, or all from one on, ends each program with one line, and leaves no part") {
  Scratch scratch;
  write_small_job(scratch);
  scratch.write("study.yaml", "base: job.yaml\n");
  scratch.write("swing.mod",
                "MODULE swing\n  CONST jointtarget home := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
                "  PROC main()\n    MoveAbsJ home, v500, fine, tool0;\n  ENDPROC\nENDMODULE\n");
  must_run(scratch, "dresslife", "run study.yaml --quiet");
  const unsigned seed = std::random_device{}();
  std::mt19937 random(seed);
  std::cout << "failing allocations with seed " << seed << '\n';
  struct Call {
    std::string program, arguments;
  };
  for (const Call& call :
       {Call{"dresslife-sim", "job.yaml -o out/motion.h5 --quiet"},
        Call{"dresslife-strain", "runs/study/study/motion.h5 -o out/strain.h5 --quiet"},
        Call{"dresslife-fatigue", "runs/study/study/strain.h5 -o out/life.h5 --quiet"},
        Call{"dresslife-import", "swing.mod -o out/swing.yaml --quiet"}, Call{"dresslife", "run study.yaml --quiet"},
        Call{"dresslife", "report study.yaml"}, Call{"dresslife", "status study.yaml"},
        Call{"dresslife", "plot runs/study/study --what cycles -o out/cycles.svg"}}) {
    const auto fail_at = [&](int at, const char* more) {
      fs::remove_all(scratch / "out");
      fs::create_directories(scratch / "out");
      return run_failing(scratch, Fault{"allocate", at, "", "", more}, call.program, call.arguments);
    };
    const Outcome right = fail_at(0, "0");
    REQUIRE(right.status == 0);
    const int total = calls_counted(scratch);
    REQUIRE(total > 100);
    int refused = 0, whole = 0;
    for (const char* more : {"0", "all"})
      for (const int at : some_of(total, rounds(6), random)) {
        const Outcome outcome = fail_at(at, more);
        INFO(call.program << ' ' << call.arguments << ": allocation " << at << " of " << total << " (" << more
                          << " more): " << outcome.status << outcome.err);
        if (outcome.status == 0) {  // an allocation of the shell, or one whose failure has no effect
          REQUIRE(outcome.out == right.out);
          ++whole;
        } else {
          REQUIRE(outcome.status == 1);
          // A study's warnings may come before the error.
          REQUIRE(outcome.err.ends_with(call.program +
                                        ": error: out of memory; run fewer jobs at a time, ask for fewer segments or "
                                        "samples, or allow more, then run again\n"));
          REQUIRE(outcome.err.find("error: ") == outcome.err.rfind("error: "));
          ++refused;
        }
        REQUIRE_FALSE(holds_parts(scratch.folder()));
      }
    std::cout << call.program << ' ' << call.arguments.substr(0, call.arguments.find(' ')) << ": " << refused << " of "
              << refused + whole << " refused, of " << total << " allocations\n";
    CHECK(refused > 0);
  }
}

#endif
