// Duties through the whole chain: the life of a duty against the lives of its programs.
#include "tests/catch.h"
#include "tests/cli/process.h"

using namespace dresslife::tests;

namespace {

/// Returns a cell of the first row that has this text in its first or second column.
std::string cell(const std::string& csv, const std::string& row, const std::string& column) {
  std::istringstream lines(csv);
  std::string title, line;
  std::getline(lines, title);
  const auto cells = [](const std::string& text) {
    std::vector<std::string> all;
    std::istringstream stream(text);
    for (std::string one; std::getline(stream, one, ',');) all.push_back(one);
    return all;
  };
  const auto titles = cells(title);
  const auto at = static_cast<std::size_t>(std::find(titles.begin(), titles.end(), column) - titles.begin());
  while (std::getline(lines, line))
    if (line.starts_with(row)) return cells(line).at(at);
  return "";
}

double number(const std::string& text) { return std::stod(text); }

void write_study(const Scratch& scratch) {
  write_small_job(scratch);
  std::string job = content(scratch / "job.yaml");
  job.replace(job.find("strain: {slip: stick}"), 21, "strain: {slip: stick}\nfatigue: {robot_life_hours: 1.0e+7}");
  scratch.write("job.yaml", job);
  std::string swing = content(scratch / "poses.csv");
  scratch.write("study.yaml",
                "base: job.yaml\njobs:\n  one: {}\n  other: {motion.clamp_poses: twin.csv}\n"
                "  stiff: {dresspack.bending_stiffness_Nm2: 3}\n");
  scratch.write("twin.csv", swing);
}

}  // namespace

TEST_CASE("programs of a duty that start in different poses ask for the pose in which the hose is mounted") {
  const Scratch scratch;
  // The check comes before the simulation, which would refuse this length.
  const auto warned = [&](const std::string& angle, const std::string& pose) {
    const std::string home = "{joints_deg: [0, -10, 10, 0, 25, 0]}", away = "{joints_deg: [5, -10, 10, 0, 25, 0]}";
    scratch.write("job.yaml",
                  "robot: abb_irb6640_185_280\ndresspack: handling\nrouting:\n"
                  "  base_clamp: {link: link_3, position_m: [-0.1, 0, 0.45], direction: [1, 0, 0.45]}\n"
                  "  tool_clamp: {link: link_6, position_m: [0.144, 0, 0.174], direction: [1, 0, -0.45]}\n"
                  "  free_length_m: 0.2\n" +
                      pose + "motion: {steps: [" + home + ", " + away + "]}\n");
    scratch.write("study.yaml",
                  "base: job.yaml\njobs:\n  one: {}\n  other: {motion.steps: [{joints_deg: [0, -10, 10, 0, 25, " +
                      angle + "]}, " + away + "]}\n");
    scratch.write("duties.yaml",
                  "study: study.yaml\nduties:\n  - name: d\n    programs: [{job: one, percent_of_time: 50}, "
                  "{job: other, percent_of_time: 50}]\n");
    return run(scratch, "dresslife", "duty duties.yaml").err.find("routing.mounting_pose_deg: the joint angles") !=
           std::string::npos;
  };
  CHECK_FALSE(warned("15", ""));
  CHECK(warned("25", ""));
  CHECK_FALSE(warned("25", "  mounting_pose_deg: [0, -10, 10, 0, 25, 0]\n"));
}

TEST_CASE("programs in files: poses come from the run, and one pose of all programs needs no warning") {
  const Scratch scratch;
  const auto program = [&](const std::string& file, const std::string& first, const std::string& then) {
    const auto move = [](const std::string& joints) {
      return "MoveAbsJ [[" + joints + "],[9E9,9E9,9E9,9E9,9E9,9E9]],v500,fine,tool0;\n";
    };
    scratch.write(file, "MODULE m\nPROC main()\n" + move(first) + move(then) + move(first) + "ENDPROC\nENDMODULE\n");
  };
  program("one.mod", "0,-10,10,0,35,0", "0,-10,10,0,35,5");
  program("same.mod", "0,-10,10,0,35,15", "0,-10,10,0,35,20");
  program("away.mod", "0,-10,10,0,35,25", "0,-10,10,0,35,20");
  scratch.write("job.yaml", R"(robot: abb_irb6640_185_280
motion: one.mod
dresspack: handling
routing:
  base_clamp: {link: link_3, position_m: [-0.1, 0, 0.45], direction: [1, 0, 0.45]}
  tool_clamp: {link: link_6, position_m: [0.144, 0, 0.174], direction: [1, 0, -0.45]}
  free_length_m: 2.035
simulation: {segments: 8, sample_rate_Hz: 25}
strain: {slip: stick}
)");
  scratch.write("study.yaml",
                "base: job.yaml\njobs:\n  one: {}\n  same: {motion: same.mod}\n  away: {motion: away.mod}\n");
  const auto errors = [&](const std::string& programs) {
    scratch.write("duties.yaml", "study: study.yaml\nduties:\n  - {name: d, programs: [" + programs + "]}\n");
    return must_run(scratch, "dresslife", "duty duties.yaml --quiet").err;
  };
  const std::string one = "{job: one, percent_of_time: 40}", same = "{job: same, percent_of_time: 30}",
                    away = "{job: away, percent_of_time: 30}",
                    mounted = "is mounted without twist in the first pose of 'one'";
  CHECK(errors(one).find("mounted without twist") == std::string::npos);
  CHECK(errors(one + ", " + same).find("mounted without twist") == std::string::npos);
  const std::string warned = errors(one + ", " + same + ", " + away);
  CHECK(warned.find(mounted + " and again in that of 'away' (an axis differs by more than 20 deg)") !=
        std::string::npos);
  CHECK(warned.find("mounted without twist") == warned.rfind("mounted without twist"));
  // The page contains the warnings for which it says not to plan.
  scratch.write("job.yaml", content(scratch / "job.yaml") + "dresspack.least_bend_radius_mm: 590\n");
  const auto json = [&] { return must_run(scratch, "dresslife", "duty duties.yaml --json --quiet").out; };
  errors(one);
  CHECK_THAT(json(), Catch::Contains("\"do_not_plan\":[\"one (bend radius") &&
                         Catch::Contains("{\"kind\":\"bend_radius\",\"where\":null,\"text\":\"smallest bend radius: "));
  CHECK(content(scratch / "runs/study/duty_duties.html").find("<p class=\"failed\">one: smallest bend radius: ") !=
        std::string::npos);
}

TEST_CASE("a duty of one program in all of the time has the life of its job, and so have two equal programs") {
  const Scratch scratch;
  write_study(scratch);
  scratch.write("duties.yaml", R"(study: study.yaml
duties:
  - {name: alone, programs: [{job: one, percent_of_time: 100}]}
  - {name: beside none, programs: [{job: one, percent_of_time: 100}, {job: other, percent_of_time: 0}]}
  - name: halves
    programs: [{job: one, percent_of_time: 50}, {job: other, percent_of_time: 50}]
    history: [{duty: alone, hours: 0.0001}]
)");
  const Outcome outcome = must_run(scratch, "dresslife", "duty duties.yaml --quiet");
  INFO(outcome.out << outcome.err);
  must_run(scratch, "dresslife", "run study.yaml --quiet");
  const std::string ranking = content(scratch / "runs/study/ranking.csv"),
                    duty = content(scratch / "runs/study/duty_duties.csv");
  constexpr double kept_digits = 2e-5;  // a life response has six digits of log10 of a life: 5e-6 ln 10
  for (const char* p : {"p10", "p50", "p90"}) {
    const double life = number(cell(ranking, "one,", std::string("life_hours_") + p));
    REQUIRE(std::isfinite(life));
    CHECK(number(cell(duty, "alone,one", std::string("life_hours_") + p)) == Approx(life).epsilon(kept_digits));
    CHECK(cell(duty, "beside none,one", std::string("life_hours_") + p) ==
          cell(duty, "alone,one", std::string("life_hours_") + p));
    CHECK(number(cell(duty, "halves,other", std::string("life_hours_") + p)) == Approx(life).epsilon(kept_digits));
  }
  CHECK(outcome.out.find("These hours begin now") != std::string::npos);
  CHECK_THAT(
      run(scratch, "dresslife", "duty duties.yaml --json --quiet").out,
      Catch::Contains("\"duty\":\"alone\"") &&
          Catch::Contains(
              "\"do_not_plan\":[\"one (bend radius, forces, calibration)\"],\"confirm_first\":[],\"warning_list\":[{"));
}

TEST_CASE(
    "programs in their order: a program after itself adds nothing, one after another adds cycles across the change") {
  const Scratch scratch;
  // In each program the hose bends to one side. Between the programs it moves from one side to the other.
  const auto motion = [](const std::string& to, const std::string& at) {
    return "{speed_percent: 20, steps: [{joints_deg: [" + to + "]}, {joints_deg: [" + at +
           "]}, {dwell_s: 1}, {joints_deg: [" + to + "]}]}";
  };
  const std::string left = motion("0, -10, 10, 0, 35, 30", "0, -10, 10, 0, 35, 50"),
                    right = motion("0, -10, 10, 0, 35, -30", "0, -10, 10, 0, 35, -50");
  scratch.write("job.yaml", R"(robot: abb_irb6640_185_280
motion: easy
dresspack: handling
routing:
  mounting_pose_deg: [0, -10, 10, 0, 35, 0]
  base_clamp: {link: link_3, position_m: [-0.1, 0, 0.45], direction: [1, 0, 0.45]}
  tool_clamp: {link: link_6, position_m: [0.144, 0, 0.174], direction: [1, 0, -0.45]}
  free_length_m: 2.035
simulation: {segments: 12, sample_rate_Hz: 25}
strain: {slip: stick}
fatigue: {robot_life_hours: 1.0e+7}
)");
  scratch.write("study.yaml", "base: job.yaml\njobs:\n  left: {motion: " + left + "}\n  same: {motion: " + left +
                                  "}\n  right: {motion: " + right + "}\n");
  const std::string programs =
      "    programs: [{job: left, repeats_per_hour: 60}, {job: same, repeats_per_hour: 60}, {job: right, repeats_per_hour: 60}]\n";
  scratch.write("duties.yaml", "study: study.yaml\nduties:\n  - name: apart\n" + programs + "  - name: after itself\n" +
                                   programs + "    order: [{job: left}, {job: same}]\n" + "  - name: in turns\n" +
                                   programs + "    order: [{job: left}, {job: right}]\n" + "  - name: batches\n" +
                                   programs + "    order: [{job: left, repeats: 10}, {job: right, repeats: 10}]\n");
  const Outcome outcome = run(scratch, "dresslife", "duty duties.yaml --quiet");
  INFO(outcome.out << outcome.err);
  REQUIRE(outcome.status == 0);
  const std::string table = content(scratch / "runs/study/duty_duties.csv");
  const auto damage = [&](const std::string& duty) {
    return 1 / number(cell(table, duty + ",left", "life_hours_p50"));
  };
  const double apart = damage("apart");
  REQUIRE(apart > 0);
  constexpr double by_rows = 0.02;  // a spline through rows at 25 Hz changes the swing of the hose
  CHECK(damage("after itself") == Approx(apart).epsilon(by_rows));
  CHECK(damage("in turns") > 2 * apart);
  // A tenth of the changes. Another place may be the worst, so the damage is between the line and its ends.
  CHECK(damage("batches") > apart);
  CHECK(damage("batches") <= apart + 0.1 * (damage("in turns") - apart) * (1 + by_rows));
  CHECK(outcome.out.find("Changes between the programs make the damage of wires") != std::string::npos);
  CHECK(run(scratch, "dresslife", "run study.yaml --quiet").status == 0);  // rounds are not jobs of the study
  CHECK(content(scratch / "runs/study/ranking.csv").find("left+right") == std::string::npos);
  // An order is refused if the joint angles of the programs are unknown.
  write_study(scratch);
  scratch.write(
      "duties.yaml",
      "study: study.yaml\nduties:\n  - name: d\n    order: [{job: one}, {job: other}]\n    programs: [{job: one, percent_of_time: 5}, "
      "{job: other, percent_of_time: 5}]\n");
  CHECK(run(scratch, "dresslife", "duty duties.yaml -o other --quiet").err.find("no robot moves in 'one'") !=
        std::string::npos);
}

TEST_CASE("duties that cannot be added up are refused before anything runs") {
  const Scratch scratch;
  write_study(scratch);
  const auto refusal = [&](const std::string& programs, const std::string& more = "") {
    scratch.write("duties.yaml", "study: study.yaml\nduties:\n  - name: d\n    programs: " + programs + "\n" + more);
    const Outcome outcome = run(scratch, "dresslife", "duty duties.yaml --quiet");
    CHECK(outcome.status == 1);
    CHECK(outcome.out.empty());
    return outcome.err;
  };
  CHECK(refusal("[{job: one, percent_of_time: 5}, {job: stiff, percent_of_time: 5}]").find("differ in dresspack") !=
        std::string::npos);
  CHECK(refusal("[{job: onee, percent_of_time: 5}]").find("did you mean 'one'?") != std::string::npos);
  const std::string too_many = refusal("[{job: one, repeats_per_hour: 10000}, {job: other, percent_of_time: 5}]");
  CHECK_THAT(too_many, Catch::Contains("duties.yaml:3") && Catch::Contains("minutes of each hour (10,000 x") &&
                           Catch::Contains("of 'other'"));
  CHECK_FALSE(fs::exists(scratch / "runs"));
  const std::string outlived = refusal("[{job: one, percent_of_time: 5}]", "    history: [{duty: d, hours: 9.0e+6}]\n");
  CHECK(outlived.find("the model contradicts this dresspack") != std::string::npos);
  scratch.write("two_robots.yaml", "");
  scratch.write("duties.yaml", "study: two_robots\nduties: [{name: d, programs: [{job: hard, percent_of_time: 5}]}]\n");
  CHECK(run(scratch, "dresslife", "duty duties.yaml").err.find("two_robots.yaml is a file beside this one") !=
        std::string::npos);
}

TEST_CASE(
    "a plan names what to replace in a window, writes a table and a calendar, and refuses what it does not know") {
  const Scratch scratch;
  write_study(scratch);
  // With a known stiffness lives have no residual, so that old dresspacks fail more often than new ones.
  scratch.write("job.yaml", content(scratch / "job.yaml") + "uncertainty: {hose_stiffness: 1}\n");
  scratch.write("duties.yaml",
                "study: study.yaml\nduties: [{name: d, programs: [{job: one, percent_of_time: 0.1}]}]\n");
  scratch.write("fleet.csv", "# a, b, c\nname,duty,installed\nnew one,d,\n# seen\n#7,d,\nold one,d,2026-11-22\n");
  const std::string plan = "plan fleet.csv --duties duties.yaml --today 2026-11-23 --quiet --windows ";
  const Outcome outcome = must_run(scratch, "dresslife", plan + "2026-12-21..2026-12-23,2027-03-01");
  INFO(outcome.out << outcome.err);
  CHECK_THAT(outcome.err, Catch::Contains("note: fleet.csv: comments, because they begin with #: lines 5\n"));
  CHECK(outcome.out.find("2026-12-21 .. 2026-12-23: replace 2\n  new one, old one\n") != std::string::npos);
  const std::string table = content(scratch / "runs/study/plan_fleet.csv");
  CHECK(cell(table, "old one", "replace_in") == "2026-12-21");
  CHECK(number(cell(table, "new one", "fails_before_first_window")) > 0);
  CHECK(content(scratch / "runs/study/plan_fleet.ics").find("DTSTART;VALUE=DATE:20261221") != std::string::npos);
  // With costs, a test has a value, and a plan of another fleet is compared.
  scratch.write("fleet.csv",
                "name,duty,installed,planned_cost,unplanned_cost\nnew one,d,,10,90\nold one,d,2026-11-22,10,90\n");
  scratch.write(
      "other.csv",
      "name,duty,installed,planned_cost,unplanned_cost\nnew one,d,,10,90\nold one,d,2026-11-22,10,90\n0012,d,,10,90\n");
  const Outcome beside = must_run(scratch, "dresslife", plan + "2026-12-21 --what-if other.csv");
  INFO(beside.out << beside.err);
  CHECK((beside.out.find("A test before the first window saves, on average, until") != std::string::npos ||
         beside.out.find("No test in a laboratory saves") != std::string::npos));
  CHECK(beside.out.find("what if") != std::string::npos);
  CHECK(beside.out.find("0012: ") != std::string::npos);
  CHECK(content(scratch / "runs/study/plan_fleet_what_if.csv").find("\n0012,d,") != std::string::npos);
  const std::string json = run(scratch, "dresslife", plan + "2026-12-21 --what-if other.csv --json").out;
  CHECK(json.starts_with("{\"plan\":[{\"name\":\"new one\""));
  CHECK(json.find(",\"what_if\":[{\"name\":\"new one\"") != std::string::npos);
  CHECK(json.find("{\"name\":\"0012\",\"duty\":\"d\"") !=
        std::string::npos);  // a name that resembles a number stays text
  const std::string window = "[{\"first_day\":\"2026-12-21\",\"last_day\":\"2026-12-21\",\"replace\":[";
  CHECK_THAT(json, Catch::Contains("\"windows\":" + window) && Catch::Contains("\"replace_of_later\":") &&
                       Catch::Contains("\"what_if_windows\":" + window));
  CHECK(must_run(scratch, "dresslife", plan + "2026-12-21 --what-if other.csv --what-if-from 2027-01-01")
            .out.find("What if other from 2027-01-01 were the fleet") != std::string::npos);
  CHECK(run(scratch, "dresslife", plan + "2026-12-21 --what-if other.csv --what-if-from 2026-11-01")
            .err.find("is before 2026-11-23, the first day of the plan") != std::string::npos);
  const Outcome late = run(scratch, "dresslife", plan + "2026-12-21 --what-if other.csv --what-if-from 2028-01-01");
  CHECK(late.status == 1);
  CHECK(late.err.find("2028-01-01 is not before 2027-12-21, the end of the plan") != std::string::npos);
  CHECK(run(scratch, "dresslife", plan + "2026-12-21 --what-if-from 2027-01-01").err.find("add --what-if OTHER.csv") !=
        std::string::npos);
  scratch.write("other.csv", "name,duty,installed\nmore,d,\n");
  CHECK(run(scratch, "dresslife", plan + "2026-12-21 --what-if other.csv")
            .err.find("other.csv:1:1: error: has no costs, but fleet.csv has some") != std::string::npos);
  // With another setting the same folder takes the results, and a note says so.
  const Outcome changed = must_run(scratch, "dresslife", plan + "2026-12-21 --set fatigue.failed_wires_percent=20");
  INFO(changed.err);
  CHECK(
      unwrapped(changed.err)
          .find(
              "note: 3 earlier results are replaced. Changed since that of 'one': fatigue.failed_wires_percent 10 -> 20") !=
      std::string::npos);
  CHECK(run(scratch, "dresslife", plan + "2026-12-21").err.find("3 earlier results are replaced") != std::string::npos);
  CHECK(run(scratch, "dresslife", plan + "2026-12-21").err.find("earlier result") == std::string::npos);
  // Twenty dresspacks that have lived for 32 weeks leave 12 of 1,000 samples, and 50 of 4,000. For three years none remains.
  const auto survivors = [&](const std::string& since) {
    std::string twenty = "name,duty,installed\n";
    for (int k = 0; k < 20; ++k) twenty += "r" + std::to_string(k) + ",d," + since + "\n";
    scratch.write("fleet.csv", twenty);
    return run(scratch, "dresslife", plan + "2026-12-21");
  };
  CHECK(survivors("2026-04-13").status == 0);
  CHECK(survivors("2023-11-20").err.find("of 4000 samples explain them; learn from them first") != std::string::npos);
  CHECK(run(scratch, "dresslife", plan + "2026-11-22").status == 1);
  CHECK(outcome.err.find("duties.yaml:2:") != std::string::npos);
  CHECK(outcome.err.find("percent_of_time of 'one' is 0.1 (limit 1 or more)") != std::string::npos);
  const Outcome share = run(scratch, "dresslife", plan + "2026-12-21 --risk 0.1");
  CHECK(share.err.find("--risk: warning: the risk is 0.1 % (limit 1 .. 50)") != std::string::npos);
  scratch.write("fleet.csv", "name,duty,installed\none,dd,\n");
  const Outcome unknown = run(scratch, "dresslife", plan + "2026-11-25");
  CHECK(unknown.status == 1);
  CHECK(unknown.err.find("fleet.csv:2:1: error: there is no duty 'dd'; did you mean 'd'?") != std::string::npos);
  scratch.write("fleet.csv", "name,duty,installed\none,something else,\n");
  CHECK(run(scratch, "dresslife", plan + "2026-11-25").err.find("'something else'; the file's duties: d") !=
        std::string::npos);
}
