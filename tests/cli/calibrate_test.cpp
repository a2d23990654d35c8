// `dresslife calibrate`, and jobs that use its calibration, run as a user runs them.
#include <fmt/format.h>

#include <cmath>
#include <random>

#include "pipeline/advise/calibrate/measured_bending.h"
#include "pipeline/base/days.h"
#include "pipeline/files/files.h"
#include "tests/catch.h"
#include "tests/cli/process.h"

using namespace dresslife::tests;
using dresslife::pipeline::day_from;
using dresslife::pipeline::day_text;
using dresslife::pipeline::FileReader;
using dresslife::pipeline::log_decrement_by_slip;
using dresslife::pipeline::log_moment;
using dresslife::pipeline::strain_format;

namespace {

const std::string wire_job =
    "{motion: {rig: {kind: axial, elongation_percent: 0.2}}, dresspack: {cable: {name: wire, source: test, radius_mm: 0.1, "
    "components: [{name: strand, radius_mm: 0.1, helix_radius_mm: 0, material: copper_halved}]}}}";

std::string row(const std::string& name, const std::string& more, const std::string& job = wire_job) {
  return "  - name: " + name + "\n    job: " + job + "\n    what: pulled\n    source: made for the tests\n" +
         (more.find("cycles:") == std::string::npos ? "" : "    criterion: first_wire\n") + more;
}

/// Returns the number after `key: ` in the entry of a parameter.
double learned(const std::string& calibration, const std::string& parameter, const std::string& key) {
  const std::size_t entry = calibration.find("name: " + parameter + "\n");
  REQUIRE(entry != std::string::npos);
  return std::stod(calibration.substr(calibration.find("\n    " + key + ": ", entry) + key.size() + 7));
}

/// Returns a number of the job in ranking.csv.
double ranked(const Scratch& scratch, const std::string& column) {
  const std::string csv = content(scratch / "runs/job/ranking.csv");
  std::istringstream keys(csv.substr(0, csv.find('\n'))), cells(csv.substr(csv.find('\n') + 1));
  std::string key, cell;
  while (std::getline(keys, key, ',') && std::getline(cells, cell, ','))
    if (key == column) return std::stod(cell);
  FAIL("no " + column);
  return 0;
}

double life_hours(const Scratch& scratch, const std::string& sets) {
  must_run(scratch, "dresslife", "run job.yaml --quiet --set uncertainty.enabled=false " + sets);
  return ranked(scratch, "life_hours");
}

/// Compares deciles in the table of a calibration, such as "2,900 (4,600, 7,400) ...", with those of the job's run.
void check_deciles(const Scratch& scratch, std::string text) {
  std::erase(text, ',');
  std::istringstream numbers(text);
  char bracket = 0;
  double early = 0, median = 0, late = 0;
  numbers >> early >> bracket >> median >> late;
  INFO(text);
  // Three standard errors of a decile of 2,000 samples, each 0.04 of a deviation of the logarithm; plus rounding to two digits.
  const double deviation = std::log(ranked(scratch, "life_hours_p90") / ranked(scratch, "life_hours_p10")) / 2.56;
  const double within = 3 * 0.04 * deviation + 0.05;
  CHECK(std::abs(std::log(early / ranked(scratch, "life_hours_p10"))) < within);
  CHECK(std::abs(std::log(median / ranked(scratch, "life_hours_p50"))) < within);
  CHECK(std::abs(std::log(late / ranked(scratch, "life_hours_p90"))) < within);
}

}  // namespace

TEST_CASE("calibrate: wires that lived longer than predicted lengthen what a job that names them lives") {
  Scratch scratch;
  scratch.write("job.yaml", wire_job);
  const double before = life_hours(scratch, "");
  const double cycles = before * 3600 / 2;  // 30 per minute
  scratch.write("o.yaml", "observations:\n" +
                              row("long", "    cycles: " + std::to_string(10 * cycles) +
                                              "\n    outcome: broken\n    specimens: 3\n    unshared_log10: 0.05\n"));
  const Outcome outcome = must_run(scratch, "dresslife", "calibrate o.yaml --quiet");
  INFO(outcome.err);
  CHECK(outcome.out.find("friction_inside") != std::string::npos);
  CHECK(outcome.out.find("no test depends on it") != std::string::npos);
  const std::string file = unmarked_content(scratch / "runs/calibrate_o/calibration.yaml");
  CHECK(file.starts_with("format: dresslife-calibration\nformat_version: 3\n"));
  CHECK(learned(file, "strength", "value") > 1.05);
  CHECK(learned(file, "model", "value") > 1.05);
  CHECK(file.find("name: slack") == std::string::npos);
  CHECK(unmarked_content(scratch / "runs/calibrate_o/calibration.svg").starts_with("<svg "));
  // Most of the factor of ten: 0.37 decades of strength and 0.3 of the model's factor against 0.2 of scatter.
  const double after = life_hours(scratch, "--set calibration=runs/calibrate_o/calibration.yaml");
  CHECK(after > 4 * before);
  CHECK(after < 13 * before);
  // Friction that was learned with slipping parts is not valid for parts that stick.
  const Outcome other_slip =
      run(scratch, "dresslife",
          "check job.yaml --set calibration=runs/calibrate_o/calibration.yaml --set strain.slip=stick");
  CHECK(other_slip.status == 1);
  CHECK(other_slip.err.find("was learned with strain.slip: friction (this job has stick); set strain.slip as") !=
        std::string::npos);
  // The second call has nothing to compute and prints the same text. With other rows it learns again, and the job runs again.
  const Outcome again = run(scratch, "dresslife", "calibrate o.yaml");
  CHECK(again.out == outcome.out);
  CHECK(again.err.find(" ran\n") == std::string::npos);
  scratch.write("o.yaml", "observations:\n" +
                              row("as_predicted", "    cycles: " + std::to_string(cycles) + "\n    outcome: broken\n"));
  must_run(scratch, "dresslife", "calibrate o.yaml --quiet");
  const double other = life_hours(scratch, "--set calibration=runs/calibrate_o/calibration.yaml");
  CHECK(other > 0.5 * before);
  CHECK(other < 2 * before);
}

TEST_CASE("calibrate: a bending test with 5 % of noise gives the friction, at 1.6 times the shipped pressures") {
  // Thirty weights in a first bend and on the way back.
  Scratch scratch;
  const std::string cable =
      "dresspack: {cable: {from: spot_welding, part: signal cable}}\nstrain: {slip: [free, friction, friction]";
  scratch.write("job.yaml",
                "motion: {rig: {kind: axial, elongation_percent: 0.01}}\n" + cable + ", friction_factor: 1.6}\n");
  must_run(scratch, "dresslife-sim", "job.yaml -o motion.h5 --quiet");
  must_run(scratch, "dresslife-strain", "motion.h5 -o strain.h5 --quiet");
  const FileReader strain(scratch / "strain.h5", strain_format());
  const auto curvature = strain.read<double>("/bending/curvature"), moment = strain.read<double>("/bending/moment");
  CHECK(moment.front() < moment.back());
  const auto first = [&](double k) { return std::exp(log_moment(curvature, moment, k)); };
  std::mt19937 random(4);
  std::normal_distribution<double> number;
  std::string table = "curvature_1_per_m,moment_Nm\n";
  const auto add = [&](double k, double m) { table += fmt::format("{},{}\n", k, m * (1 + 0.05 * number(random))); };
  for (double k = 0.1; k < 1.55; k += 0.1) add(k, first(k));
  for (double k = 1.4; k > -0.05; k -= 0.1) add(k, first(1.5) - 2 * first((1.5 - k) / 2));
  scratch.write("bend.csv", table);
  scratch.write(
      "o.yaml",
      "observations:\n" +
          row("bend", "    bending: bend.csv\n",
              "{dresspack: {cable: {from: spot_welding, part: signal cable}}, strain: {slip: [free, friction, friction]}}"));
  const Outcome bent = must_run(scratch, "dresslife", "calibrate o.yaml --quiet");
  CHECK(unwrapped(bent.out + bent.err).find("does not reproduce") == std::string::npos);
  const std::string file = content(scratch / "runs/calibrate_o/calibration.yaml");
  const double friction = learned(file, "friction_inside", "value");
  CHECK(friction > 1.6 / 1.3);
  CHECK(friction < 1.6 * 1.3);
  CHECK(learned(file, "friction_inside", "value_p10") < 1.6);
  CHECK(learned(file, "friction_inside", "value_p90") > 1.6);
  CHECK(file.find("name: strength") == std::string::npos);

  // A curve that turns as no model of friction does has a warning, also in the jobs that use the calibration.
  table = "curvature_1_per_m,moment_Nm\n";
  for (double k = 0.1; k < 1.55; k += 0.1) add(k, first(1.5));
  for (double k = 1.4; k > -0.05; k -= 0.1) add(k, first(1.5));
  scratch.write("bend.csv", table);
  const Outcome odd = must_run(scratch, "dresslife", "calibrate o.yaml --quiet");
  CHECK(unwrapped(odd.out + odd.err).find("'bend': the model does not reproduce this row") != std::string::npos);
  CHECK(content(scratch / "runs/calibrate_o/calibration.yaml").find("the model does not reproduce") !=
        std::string::npos);

  // A decay test of this cable gives the same information, but less of it: its loss depends less on friction.
  const double decrement = std::exp(log_decrement_by_slip(curvature, moment, 1)) + 0.03;
  scratch.write(
      "o.yaml",
      "observations:\n" +
          row("swing", fmt::format("    decrement: {}\n    decrement_without_slip: 0.03\n", decrement),
              "{dresspack: {cable: {from: spot_welding, part: signal cable}}, strain: {slip: [free, friction, friction]}}"));
  must_run(scratch, "dresslife", "calibrate o.yaml --quiet");
  const std::string swung = content(scratch / "runs/calibrate_o/calibration.yaml");
  CHECK(learned(swung, "friction_inside", "value_p10") < 1.6);
  CHECK(learned(swung, "friction_inside", "value_p90") > 1.6);

  CHECK(run(scratch, "dresslife", "validate o.yaml").err.find("holds no observed lives") != std::string::npos);
}

TEST_CASE("calibrate: the prior predicts the hours that a run predicts") {
  // Friction and slack interact here: their effects do not add.
  const Scratch scratch;
  const std::string job =
      "{motion: {rig: {kind: torsion, length_m: 1, twist_deg_per_m: 180}}, dresspack: spot_welding, strain: {cable_elements_per_segment: 2}}";
  scratch.write("job.yaml", job);
  must_run(scratch, "dresslife", "run job.yaml --quiet --set uncertainty.ratings=none");
  scratch.write(
      "o.yaml",
      "observations:\n  - name: one\n    job: " + job +
          "\n    what: twisted\n    source: made for the tests\n    hours: 1\n    outcome: run_out\n    unshared_log10: 0.01\n");
  const Outcome outcome = must_run(scratch, "dresslife", "calibrate o.yaml --quiet");
  INFO(outcome.out << outcome.err);
  const std::string line = outcome.out.substr(outcome.out.find("\none ") + 5);
  check_deciles(scratch, line.substr(line.find(" h ") + 3));
}

TEST_CASE("calibrate: a maintenance system's table in one command teaches the job that names the result") {
  Scratch scratch;
  std::string job = wire_job;
  job.insert(job.size() - 1, ", fatigue: {operating_hours_per_week: 0.1}");
  scratch.write("job.yaml", job);
  const double before = life_hours(scratch, "");
  // Ten dresspacks lived about ten times as long as predicted, and two are in use.
  const auto day = [](double hours) {  // from 2000-01-03 on
    return day_text(*day_from("2000-01-03") + std::chrono::days(std::llround(7 * hours / 0.1)));
  };
  std::string table = "Robot;Installed;Replaced;Reason\n";
  for (int k = 0; k < 10; ++k) table += fmt::format("R{};03.01.2000;{};failed\n", k, day(before * (8 + 0.4 * k)));
  table += "R0;" + day(before * 8) + ";;\nR1;" + day(before * 8.4) + ";;\n";
  scratch.write("plant.csv", table);
  const std::string command = "calibrate plant.csv --quiet --records-since 2000-01-03 --today " + day(before * 13);
  const Outcome outcome = must_run(scratch, "dresslife", command);
  INFO(outcome.out << outcome.err);
  CHECK(outcome.err.find("12 dresspacks: 10 failed, 0 were removed without a failure, 2 are in use") !=
        std::string::npos);
  CHECK(outcome.out.find("Compare 'predicted after' with the 'replace after' that dresslife run prints") !=
        std::string::npos);
  CHECK(outcome.out.find("10 of 12 failed") != std::string::npos);
  CHECK(outcome.out.find("The life of 'job' depends most on ") != std::string::npos);
  const double after = life_hours(scratch, "--set calibration=runs/calibrate_plant/calibration.yaml");
  // The prior of ln life has a deviation of ln 6 to ln 10, the mean of ten lives one of some tenths.
  CHECK(after > 6 * before);
  CHECK(after < 13 * before);
  // A run with the calibration predicts what the calibration predicts: its samples are those of the posterior.
  must_run(scratch, "dresslife", "run job.yaml --quiet --set calibration=runs/calibrate_plant/calibration.yaml");
  std::string row_text = outcome.out.substr(outcome.out.find("10 of 12 failed") + 15);
  for (int group = 0; group < 2; ++group) row_text = row_text.substr(row_text.find(')') + 1);
  check_deciles(scratch, row_text);
  // The same rows in two tables teach the same. A table that is given twice is doubted.
  std::istringstream rows(table);
  std::string title, line;
  std::getline(rows, title);
  std::array<std::string, 2> halves{title + "\n", title + "\n"};
  for (int k = 0; std::getline(rows, line); ++k) halves[static_cast<std::size_t>(k % 2)] += line + "\n";
  scratch.write("odd.csv", halves[0]), scratch.write("even.csv", halves[1]);
  const std::string options = " --job job.yaml --quiet --records-since 2000-01-03 --today " + day(before * 13);
  const Outcome joined = must_run(scratch, "dresslife", "calibrate odd.csv even.csv" + options);
  CHECK_THAT(joined.out, Catch::Contains("job, even "));
  CHECK_THAT(joined.err, !Catch::Contains("a row that was copied"));
  const double after_both = life_hours(scratch, "--set calibration=runs/calibrate_odd/calibration.yaml");
  CHECK(after_both == Approx(after).epsilon(0.05));  // medians of 48,000 correlated samples
  scratch.write("again.csv", halves[0]);
  CHECK_THAT(must_run(scratch, "dresslife", "calibrate odd.csv again.csv" + options).err,
             Catch::Contains("a row that was copied"));
  // Eight dresspacks live thirty times as long as predicted. Records of their last hours contradict what was learned.
  std::string alive = "robot,installed,replaced\n";
  for (int k = 0; k < 8; ++k) alive += fmt::format("R{},2000-01-03,\n", k);
  scratch.write("alive.csv", alive);
  const auto of_alive = [&](double since) {
    return must_run(scratch, "dresslife",
                    "calibrate alive.csv --job job.yaml --quiet --today " + day(before * 30) + " --records-since " +
                        day(before * since))
        .out;
  };
  const std::string late = of_alive(28), all = of_alive(0);
  INFO(late << all);
  CHECK(late.find("warning: 'job': 8 dresspacks were in use when the records begin") != std::string::npos);
  CHECK(all.find("were in use when the records begin") == std::string::npos);
  CHECK(
      all.find(
          "warning: 'job': fewer failures than predicted (0 of 8 failed): without any observation (makers' ratings, too) 1 of ") !=
      std::string::npos);
  // Thirty lives differ by 4 %. Lives of equal wires differ more.
  std::string equal = "Robot;Installed;Replaced;Reason\n";
  for (int k = 0; k < 30; ++k) equal += fmt::format("R{};03.01.2000;{};failed\n", k, day(before * (8 + 0.01 * k)));
  scratch.write("equal.csv", equal);
  const Outcome refused =
      run(scratch, "dresslife",
          "calibrate equal.csv --job job.yaml --quiet --records-since 2000-01-03 --today " + day(before * 13));
  INFO(refused.err);
  CHECK(refused.status == 1);
  CHECK(refused.err.find("it would need a scatter ") != std::string::npos);
  CHECK(refused.err.find("correct the reasons (preventive)") != std::string::npos);
  CHECK(refused.err.find("until then plan with the observed hours: 10 % had failed by ") != std::string::npos);
  CHECK(run(scratch, "dresslife", "calibrate plant.csv --job job.yaml --records-since soon")
            .err.find("'soon' is no date") != std::string::npos);
  scratch.write("o.yaml", "observations:\n" + row("as_predicted", "    cycles: 5\n"));
  CHECK(run(scratch, "dresslife", "calibrate o.yaml --job job.yaml")
            .err.find("--job: error: is of a maintenance system's table") != std::string::npos);
}

TEST_CASE("calibrate: rows that cannot be used are named at their place") {
  Scratch scratch;
  const auto refused = [&](const std::string& text) {
    scratch.write("o.yaml", text);
    const Outcome bad = run(scratch, "dresslife", "calibrate o.yaml --quiet");
    CHECK(bad.status == 1);
    return bad.err;
  };
  const auto has = [](const std::string& text, const std::string& words) {
    return text.find(words) != std::string::npos;
  };
  CHECK(has(refused("observations:\n" + row("x", "    outcome: broken\n")),
            "o.yaml:2:5: error: 'x' must have either cycles or hours (or stiffness_Nm2, decrement or bending)"));
  CHECK(has(refused("observations:\n" + row("d", "    decrement: 0.1\n    decrement_without_slip: 0.1\n")),
            "o.yaml:2:5: error: 'd': nothing of decrement is left for slip; give"));
  CHECK(has(refused("observations:\n" + row("e", "    cycles: 5\n    decrement_without_slip: 0.1\n")),
            "o.yaml:8:5: error: 'e': decrement_without_slip has no effect on a row with cycles; leave it out"));
  std::string job = wire_job;
  job.insert(job.size() - 1, ", fatigue: {strength_factor: 2}");
  CHECK(has(refused("observations:\n" + row("ok", "    cycles: 5\n") + row("y", "    cycles: 5\n", job)),
            "o.yaml:8:5: error: 'y': its job gives a key that is to be learned; leave"));
  CHECK(has(refused("observations:\n" + row("z", "    cycles: 5\n", "nowhere.yaml")), "nowhere.yaml"));
  job = wire_job;
  job.insert(job.size() - 1, ", uncertainty: {friction_inside: 2}");
  CHECK(has(
      refused("observations:\n" + row("ok", "    cycles: 5\n") + row("u", "    cycles: 5\n", job)),
      "o.yaml:8:5: error: 'u': its job gives other uncertainties than the first job, but all rows of a calibration must have "
      "the same; give"));
  job = wire_job;
  job.replace(job.find("copper_halved"), 13, "unobtainium");
  CHECK(has(refused("observations:\n" + row("m", "    cycles: 5\n", job)), "'m': its job cannot be made"));
  const std::string far = refused("observations:\n" + row("far", "    cycles: 1e+11\n"));
  INFO(far);
  CHECK(has(far, "o.yaml:2:5: error: 'far': the observation (1.00e+11) contradicts the prediction ("));
  CHECK(has(far, "correct the unit of the observation, or its job"));
  for (const char* command : {"calibrate", "validate"}) {
    scratch.write("o.yaml", "observations:\n" + row("few", "    cycles: 50\n    outcome: run_out\n"));
    const Outcome doubted = run(scratch, "dresslife", std::string(command) + " o.yaml --quiet");
    CHECK(doubted.status == 0);
    CHECK(has(doubted.err, "o.yaml:2:5: warning: cycles of 'few' is 50 (limit 100 or more)"));
  }
  CHECK(run(scratch, "dresslife", "calibrate").status == 2);
}
