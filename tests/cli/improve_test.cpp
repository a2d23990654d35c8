// dresslife improve: jobs with longer lives, and a search that is killed.
#include <map>
#include <regex>

#include "pipeline/files/files.h"
#include "tests/catch.h"
#include "tests/cli/process.h"

using namespace dresslife::tests;
using dresslife::pipeline::FileReader;
using dresslife::pipeline::life_format;

namespace {

/// Writes the small job with cables held so loosely that nothing breaks. Its length is free.
void write_small_study(const Scratch& scratch) {
  write_small_job(scratch);
  scratch.write("better.yaml", R"(base: job.yaml
jobs:
  hose:
    dresspack.least_bend_radius_mm: 60
    dresspack.components.1.base_grip_N: 2
    dresspack.components.1.tool_grip_N: 2
    strain.slip: [free, stick]
free:
  routing.free_length_m: 0.85 .. 0.95
limits: {tension_N: 400}
)");
}

std::size_t lines_of(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// Returns the time of the last receipt of each stage of a search's jobs.
std::map<fs::path, fs::file_time_type> notes_of(const fs::path& folder) {
  std::map<fs::path, fs::file_time_type> notes;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".receipt") notes[entry.path()] = fs::last_write_time(entry.path());
  return notes;
}

/// Returns the names of result files (life.h5 and the like) in the search's job folders whose names begin with `jobs`.
std::vector<std::string> results_of(const fs::path& folder, const std::string& jobs) {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".h5" && entry.path().parent_path().filename().string().starts_with(jobs))
      names.push_back(entry.path().filename().string());
  return names;
}

}  // namespace

TEST_CASE("improve finds a job that lives longer, and says by what") {
  Scratch scratch;
  write_small_study(scratch);
  const Outcome told = must_run(scratch, "dresslife", "improve better.yaml --trials 10 --quiet");
  INFO(told.out << told.err);
  CHECK(told.out.find("As it is: ") == 0);
  CHECK(told.out.find("    --set 'routing.free_length_m=0.9") != std::string::npos);
  CHECK_THAT(told.out,
             Catch::Contains("\nThe wires live ") || Catch::Contains("\nIn both the wires outlive the robot ("));
  const std::string table = content(scratch / "runs/better_improve/improve.csv");
  CHECK(lines_of(table) == 11);  // including its header
  CHECK(table.find("\n0,1,") != std::string::npos);
  CHECK(fs::exists(scratch / "runs/better_improve/report.html"));
  CHECK(fs::exists(scratch / "runs/better_improve/before/life.h5"));
  // Its page compares both, and states the effect of mounting errors in the length (a recording moves this job's clamps).
  CHECK(
      unwrapped(told.out).find(
          "With a clamp or length off by 10 mm, a clamp tilted by 5.7 deg or an end turned by 10 deg the wires live at least ") !=
      std::string::npos);
  const std::string page = content(scratch / "runs/better_improve/improve.html");
  CHECK(page.find("<iframe src=\"before/page.html\"") != std::string::npos);
  CHECK(page.find("<td><code>routing.free_length_m</code></td><td>0.9</td><td>0.9") != std::string::npos);
  CHECK(page.find("<tr><td>length, + 10 mm</td><td class=\"number\">× ") != std::string::npos);

  // Trials keep only their receipts; the best few keep all files.
  CHECK(results_of(scratch / "runs/better_improve", "trial_").empty());
  CHECK(results_of(scratch / "runs/better_improve", "off_").empty());
  CHECK(results_of(scratch / "runs/better_improve", "before").size() == 3);

  // The same search again runs nothing. The study itself ignores the section `free`.
  const auto notes = notes_of(scratch / "runs/better_improve");
  const Outcome again = run(scratch, "dresslife", "improve better.yaml --trials 10 --quiet");
  CHECK(again.out == told.out);
  for (const auto& [note, time] : notes_of(scratch / "runs/better_improve")) {
    INFO(note);
    CHECK((notes.contains(note) && notes.at(note) == time));
  }
  CHECK(run(scratch, "dresslife", "run better.yaml --quiet").status == 0);
}

/// Writes a short motion of a wound cable, whose end is turned by 55 deg. This angle is free.
void write_turned_study(const Scratch& scratch) {
  scratch.write("short.yaml", R"(name: short
source: made for the tests
speed_percent: 20
steps:
  - {text: home, joints_deg: [0, -10, 10, 0, 25, 0]}
  - {text: roll the gun over, joints_deg: [0, -10, 10, 0, 25, 40]}
  - {text: home, joints_deg: [0, -10, 10, 0, 25, 0]}
)");
  scratch.write("job.yaml", R"(robot: abb_irb6640_185_280
motion: ./short.yaml
dresspack: sensor_cable
routing:
  base_clamp: {link: link_3, position_m: [-0.1, 0, 0.45], direction: [1, 0, 0.45]}
  tool_clamp: {link: link_6, position_m: [0.15, 0, 0.18], direction: [1, 0, -0.35]}
  free_length_m: 2.035
  pre_twist_deg: 55
simulation: {segments: 20, sample_rate_Hz: 25, most_repeats: 1, periodic_tolerance_mm: 1000}
)");
  scratch.write("turn.yaml", R"(base: job.yaml
jobs:
  turn:
    dresspack.least_bend_radius_mm: 30
    dresspack.most_twist_deg_per_m: 300
    strain.slip: free
    fatigue.robot_life_hours: 10000000
free:
  routing.pre_twist_deg: -40 .. 60
)");
}

TEST_CASE("improve states the worst life within the tolerance of a turned end, as its neighbours live it") {
  Scratch scratch;
  write_turned_study(scratch);
  const Outcome told =
      must_run(scratch, "dresslife", "improve turn.yaml --trials 3 --short-runs 0 --off 0 --off-deg 10 --quiet");
  INFO(told.out);
  std::smatch stated, turn;
  const std::string out = unwrapped(told.out);
  REQUIRE(std::regex_search(
      out, stated, std::regex("With an end turned by 10 deg the wires live at least ([0-9.]+) times as long")));
  REQUIRE(std::regex_search(told.out, turn, std::regex("--set 'routing.pre_twist_deg=([-0-9.]+)'")));
  const double best = std::stod(turn[1]);
  std::string reliefs;  // of the winner, for its neighbours
  const std::regex relief("    (--set '[^']*bend_relief=[^']*')");
  for (std::sregex_iterator found(told.out.begin(), told.out.end(), relief), end; found != end; ++found)
    reliefs += " " + (*found)[1].str();
  const auto life = [&](double degrees) {
    const std::string at = std::to_string(degrees);
    must_run(scratch, "dresslife",
             "run turn.yaml --quiet -o 'at " + at + "' --set routing.pre_twist_deg=" + at + reliefs);
    return FileReader(scratch / ("at " + at) / "turn/turn/life.h5", life_format()).number_attribute("life_hours_p10");
  };
  const double worst = std::min({life(best), life(best - 10), life(best + 10)}) / life(best);
  CHECK(std::stod(stated[1]) == Approx(worst).epsilon(0.05));  // two digits
}

TEST_CASE("a search that is killed ends where it would have ended") {
  Scratch scratch;
  write_small_study(scratch);
  const std::string line = "improve better.yaml --trials 6 --quiet -j 2 -o ";
  must_run(scratch, "dresslife", line + "whole");
  // Killed after the third trial, then restarted.
  const Outcome killed =
      run_shell(scratch, "'" DRESSLIFE_BIN_DIR "/dresslife' " + line +
                             "killed & pid=$!\n"
                             "for k in $(seq 600); do\n"
                             "  [ -e killed/better_improve/trial_0003/.stage/fatigue.receipt ] && break\n"
                             "  sleep 0.1\n"
                             "done\n"
                             "kill -9 $pid; wait $pid; echo $?");
  REQUIRE(killed.out == "137\n");
  REQUIRE_FALSE(fs::exists(scratch / "killed/better_improve/improve.csv"));
  must_run(scratch, "dresslife", line + "killed");
  CHECK(content(scratch / "killed/better_improve/improve.csv") ==
        content(scratch / "whole/better_improve/improve.csv"));
}

TEST_CASE("improve writes the best as drawn before it is verified, and a killed search replaces it when it goes on") {
  Scratch scratch;
  write_turned_study(scratch);
  std::string job = content(scratch / "job.yaml");
  scratch.write("job.yaml",
                job +
                    "dresspack.least_bend_radius_mm: 30\ndresspack.most_twist_deg_per_m: 300\nstrain: {slip: free}\n"
                    "fatigue: {robot_life_hours: 10000000}\n");
  const std::string line =
      "improve job.yaml --free 'routing.pre_twist_deg=-40 .. 60' --trials 3 --short-runs 0 --off 0 --off-deg 10 --quiet -j 1";
  const Outcome killed =
      run_shell(scratch, "'" DRESSLIFE_BIN_DIR "/dresslife' " + line +
                             " & pid=$!\n"
                             "for k in $(seq 3000); do\n"
                             "  grep -qs 'Not yet verified within the mounting tolerance' job_improved.yaml && break\n"
                             "  kill -0 $pid || break\n"
                             "  sleep 0.1\n"
                             "done\n"
                             "kill -9 $pid; wait $pid; echo $?");
  INFO(killed.out << killed.err);
  REQUIRE(killed.out.ends_with("137\n"));
  const std::string early = content(scratch / "job_improved.yaml");
  CHECK_THAT(early,
             Catch::Contains(
                 "# Not yet verified within the mounting tolerance. The command replaces this file at its end.\n"));
  CHECK_THAT(must_run(scratch, "dresslife", "show job_improved.yaml").out,
             Catch::Contains("pre_twist_deg: "));  // a complete job
  const auto notes = notes_of(scratch / "runs/job_improve");
  const Outcome ended = must_run(scratch, "dresslife", line);
  CHECK_THAT(ended.out, Catch::Contains("\nShort job: job_improved.yaml\n"));
  const std::string last = content(scratch / "job_improved.yaml");
  CHECK_THAT(last, !Catch::Contains("Not yet verified") && Catch::Contains("pre_twist_deg: "));
  // Finished trials are not run again.
  const auto after = notes_of(scratch / "runs/job_improve");
  CHECK_FALSE(notes.empty());
  for (const auto& [stage, time] : notes)
    if (stage.string().find("trial_") != std::string::npos) CHECK((after.contains(stage) && after.at(stage) == time));
}

TEST_CASE("a search whose file changes ends with what it found, and names the file") {
  Scratch scratch;
  write_small_study(scratch);
  const Outcome ended = run_shell(scratch, "'" DRESSLIFE_BIN_DIR
                                           "/dresslife' improve better.yaml --trials 200 --quiet -j 2 &\n"
                                           "pid=$!\n"
                                           "for k in $(seq 600); do\n"
                                           "  [ -e runs/better_improve/trial_0006/.stage/fatigue.receipt ] && break\n"
                                           "  sleep 0.1\n"
                                           "done\n"
                                           "echo '# of another day' >> poses.csv; wait $pid");
  INFO(ended.out << ended.err);
  CHECK(ended.status == 1);
  CHECK(ended.err.find(
            "poses.csv: error: has changed during the search; let nothing change it meanwhile, then run again\n") !=
        std::string::npos);
  CHECK(std::regex_search(
      ended.out, std::regex("^The best of the [0-9]+ trials before is trial [0-9]+: [^\n]* all limits kept;")));
  CHECK(ended.out.find("\n    --set 'routing.free_length_m=0.") != std::string::npos);
  CHECK(lines_of(content(scratch / "runs/better_improve/improve.csv")) > 5);
}

TEST_CASE("improve and route keep the results of jobs of one name in two folders apart") {
  Scratch scratch;
  for (const char* folder : {"a", "b"})
    scratch.write(std::string(folder) + "/job.yaml",
                  "robot: abb_irb6640_185_280\ndresspack: sensor_cable\nmotion: easy\n");
  for (const std::string command : {"improve", "route"}) {
    const std::string few = command == "route" ? " --tried 1 --off 0" : "";
    run(scratch, "dresslife", command + " a/job.yaml --quiet --short-runs 1" + few);  // the result does not matter
    const Outcome refused = run(scratch, "dresslife", command + " b/job.yaml --quiet --short-runs 1" + few);
    CHECK(refused.status == 1);
    CHECK_THAT(
        refused.err,
        Catch::Contains("runs/job_" + command +
                        ": error: holds the results of another file, a/job.yaml, not of b/job.yaml; choose another "
                        "folder with -o FOLDER; to replace those results, run with --force\n"));
  }
}

TEST_CASE("improve prints the Pareto front of two objectives, which may contain the original jobs") {
  Scratch scratch;
  write_small_study(scratch);
  const Outcome told = must_run(
      scratch, "dresslife",
      "improve better.yaml --trials 4 --short-runs 0 --second hose_length --off 0 --quiet");  // the fifth: 1 mm shorter, not worse
  INFO(told.out << told.err);
  CHECK(told.out.find("\nLongest lives for their hose_length:\n") != std::string::npos);
  CHECK(told.out.find("\n    as it is  ") != std::string::npos);
  CHECK(told.out.find(" 0 h ") == std::string::npos);
}

TEST_CASE("improve keeps trials whole where the study says so") {
  Scratch scratch;
  write_small_study(scratch);
  scratch.write("whole.yaml", content(scratch / "better.yaml") + "keep: all\n");
  must_run(scratch, "dresslife", "improve whole.yaml --trials 3 --short-runs 0 --off 0 --quiet");
  CHECK(results_of(scratch / "runs/whole_improve", "trial_").size() == 9);
}

TEST_CASE("improve takes a job, and names of shipped ones") {
  Scratch scratch;
  write_small_job(scratch);
  // In a job that is moved by a recording only the length can change.
  const Outcome job = run(scratch, "dresslife", "improve job.yaml --trials 2 --short-runs 0 --off 0 --quiet");
  INFO(job.out << job.err);
  CHECK(content(scratch / "runs/job_improve/improve.csv").find(",routing.free_length_m\n") != std::string::npos);
  const Outcome shipped = run(scratch, "dresslife", "improve irb6640_spot_welding --free nonsense");
  CHECK(shipped.err.find("--free nonsense: error: ") == 0);
  CHECK(run(scratch, "dresslife", "status irb6640_spot_welding").out.find("irb6640_spot_welding") != std::string::npos);
}

TEST_CASE("improve refuses what it cannot search") {
  Scratch scratch;
  write_small_study(scratch);
  CHECK(
      run(scratch, "dresslife", "improve better.yaml --free routing.free_length_m=2").err ==
      "--free routing.free_length_m=2: error: free.routing.free_length_m is '2'; write LOW .. HIGH, SPREAD around, ANGLE "
      "deg around, LOW .. HIGH along LINK (or along [x, y, z]), or a list [A, B, ...]\n");
  CHECK(run(scratch, "dresslife", "improve better.yaml --free nonsense").status == 1);
  CHECK(run(scratch, "dresslife", "improve better.yaml --trials 1").status == 2);
  scratch.write("bad.yaml", "base: job.yaml\nfree: {routing.free_length_m: 1 .. 2}\nlimits: {force_N: 4}\n");
  CHECK(run(scratch, "dresslife", "improve bad.yaml").err.find("bad.yaml:3:10: error: unknown key 'limits.force_N'") ==
        0);
  // A mounting tolerance is that of one routing.
  scratch.write("two.yaml",
                "base: job.yaml\njobs: {a: {}, b: {routing.free_length_m: 0.93}}\n"
                "free: {routing.nothing_m: 1 .. 2}\n");
  CHECK_THAT(run(scratch, "dresslife", "improve two.yaml").err,
             Catch::StartsWith("note: the mounting tolerance is not tried"));
  CHECK_THAT(run(scratch, "dresslife", "improve two.yaml --off 0").err, !Catch::Contains("mounting tolerance"));
  // No trial keeps the limit, and the exit status states this. If it is exceeded by far, no trial is run.
  const auto improved = [&](const std::string& radius) {
    return run(scratch, "dresslife",
               "improve better.yaml --trials 3 --short-runs 20 --quiet --set dresspack.least_bend_radius_mm=" + radius);
  };
  const Outcome hopeless = improved("5000");
  CHECK(hopeless.status == 1);
  CHECK(hopeless.out.find("No other job that keeps all limits was found in 1 trial and ") != std::string::npos);
  CHECK(hopeless.out.find("\nThe search stopped early: of ") != std::string::npos);
  const Outcome none = improved("250");
  CHECK(none.status == 1);
  INFO(none.out);
  CHECK(none.out.find("No other job that keeps all limits was found in 3 trials and ") != std::string::npos);
  CHECK(none.out.find("\nNo trial keeps bend radius: the best violates it by ") != std::string::npos);
  CHECK(none.out.find("\nA free key is at the end of its range: routing.free_length_m, at least 0.85; widen it\n") !=
        std::string::npos);
}

TEST_CASE("reprogram tries the costly lines in other ways, and names them by file and line") {
  Scratch scratch;
  scratch.write("short.yaml", R"(name: short
source: made for the tests
speed_percent: 100
steps:
  - {text: home, joints_deg: [0, -10, 10, 0, 25, 0]}
  - {text: roll the gun over, joints_deg: [0, -10, 10, 0, 25, 90]}
  - {text: home, joints_deg: [0, -10, 10, 0, 25, 0]}
)");
  scratch.write("job.yaml", R"(robot: abb_irb6640_185_280
motion: ./short.yaml
dresspack: sensor_cable
routing:
  base_clamp: {link: link_3, position_m: [-0.1, 0, 0.45], direction: [1, 0, 0.45]}
  tool_clamp: {link: link_6, position_m: [0.15, 0, 0.18], direction: [1, 0, -0.35]}
  free_length_m: 2.035
simulation: {segments: 12, sample_rate_Hz: 25, most_repeats: 2}
)");
  const Outcome ways =
      must_run(scratch, "dresslife", "reprogram job.yaml --quiet --lines 1 --set uncertainty.enabled=false");
  INFO(ways.out << ways.err);
  const std::string table = content(scratch / "runs/job_reprogram/as_it_is.csv");
  CHECK(
      table.find(
          "lines,way,life_hours_p10,times_as_long,cycle_s,cycle_won_s,beyond,sets,patch,first_mode,first_mode_hours,doubt\n") ==
      0);
  CHECK(table.find("\nall lines,") != std::string::npos);
  CHECK(table.find("wrist over: ") != std::string::npos);
  CHECK(table.find("\nshort.yaml:") != std::string::npos);
  CHECK(table.find("at 50 % of its speed") != std::string::npos);
  CHECK(ways.out.find("Ways: runs/job_reprogram/as_it_is.csv\n") != std::string::npos);
  CHECK(ways.out.find("numerical error") == std::string::npos);  // not known without uncertainty
}

TEST_CASE("reprogram takes a program with places of the tool, leaves it alone, and patches it in its own language") {
  Scratch scratch;
  scratch.write("short.mod", R"(MODULE short
  PERS tooldata gun:=[TRUE,[[180,0,550],[1,0,0,0]],[140,[120,0,320],[1,0,0,0],9,12,7]];
  PERS wobjdata panel:=[FALSE,TRUE,"",[[1600,-400,500],[0.7071068,0,0,0.7071068]],[[0,0,0],[1,0,0,0]]];
  CONST robtarget above:=[[1893.17,-78.66,35.30],[0.2648630,0.2827270,0.9214859,-0.0278697],[0,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget at:=[[1804.91,69.53,-241.87],[0.1706843,0.2897467,0.9400796,0.0562504],[0,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveAbsJ [[0,-10,10,0,40,290],[9E9,9E9,9E9,9E9,9E9,9E9]],v2000,fine,gun;
    MoveJ above,v1500,z50,gun\WObj:=panel;
    MoveL at,v500,fine,gun\WObj:=panel;
    MoveL above,v500,z50,gun\WObj:=panel;
  ENDPROC
ENDMODULE
)");
  scratch.write("job.yaml", R"(robot: abb_irb6640_185_280
motion: {program: short.mod}
dresspack: thesis_welding
routing:
  base_clamp: {link: link_3, position_m: [-0.1, 0, 0.45], direction: [1, 0, 0.45]}
  tool_clamp: {link: link_6, position_m: [0.15, 0, 0.18], direction: [1, 0, -0.35]}
  free_length_m: 2.5
simulation: {segments: 12, sample_rate_Hz: 12.5, most_repeats: 2}
strain: {cable_elements_per_segment: 1, surface_fibres: 0}
)");
  const std::string program = content(scratch / "short.mod");
  const Outcome ways = must_run(
      scratch, "dresslife",
      "reprogram job.yaml --quiet --lines 1 --set dresspack.least_bend_radius_mm=100 --set uncertainty.enabled=false");
  INFO(ways.out << ways.err);
  CHECK(content(scratch / "short.mod") == program);
  const std::string table = content(scratch / "runs/job_reprogram/as_it_is.csv");
  INFO(table);
  CHECK(table.find("\nshort.mod:8,at 50 % of its speed,") != std::string::npos);
  const fs::path patch = scratch / "runs/job_reprogram/as_it_is_01.patch";
  REQUIRE(fs::exists(patch));
  CHECK(content(patch).find("\n--- a/short.mod\n+++ b/short.mod\n@@ ") != std::string::npos);
  // The patch fits the program, and the result is a program again.
  CHECK(ways.out.find("patch: runs/job_reprogram/as_it_is_01.patch, for patch -p1 in .\n") != std::string::npos);
  REQUIRE(run_shell(scratch, "patch -s -o changed.mod short.mod runs/job_reprogram/as_it_is_01.patch").status == 0);
  const Outcome read = run(scratch, "dresslife-import", "changed.mod -o changed.yaml");
  INFO(read.out << read.err);
  CHECK(read.status == 0);

  // Wires and abrasion that outlive the robot gain nothing from a longer life: no patch is left of those above.
  const Outcome enough = must_run(scratch, "dresslife",
                                  "reprogram job.yaml --quiet --lines 1 --set dresspack.least_bend_radius_mm=100 --set "
                                  "uncertainty.enabled=false --set fatigue.robot_life_hours=1000");
  INFO(enough.out);
  CHECK(ways.out.find("; abrasion from ") != std::string::npos);
  CHECK(enough.out.find("; abrasion from ") == std::string::npos);
  CHECK(enough.out.find("patch: ") == std::string::npos);
  CHECK(!fs::exists(patch));

  // dresslife-import provides the ways, and reports missing inputs.
  const std::string life = " --ways runs/job_reprogram/as_it_is/life.h5";
  CHECK(run(scratch, "dresslife-import", "job.yaml" + life).err ==
        "--ways: error: has no file to write to; name one with -o ways.h5\n");
  scratch.write("steps.yaml",
                "robot: abb_irb6640_185_280\nmotion: hard\n" +
                    content(scratch / "job.yaml").substr(content(scratch / "job.yaml").find("dresspack: ")));
  CHECK_THAT(run(scratch, "dresslife-import", "steps.yaml -o ways.h5" + life).err,
             Catch::Contains("error: the motion is no robot program; give a job with motion: {program: FILE}"));
  CHECK(run(scratch, "dresslife-import", "job.yaml -o ways.h5 --lines 1" + life).status == 0);
  CHECK(run(scratch, "dresslife", "show ways.h5").out.find("dresslife-ways version 1") != std::string::npos);
}
