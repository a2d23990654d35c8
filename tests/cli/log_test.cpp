// A log of joint angles as a study and a file of duties, and the life of its dresspack.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/catch.h"
#include "tests/cli/process.h"

using namespace dresslife::tests;

namespace {

/// Returns a log of three cycles of 8 s that turn axes 5 and 6, with rests, on the robot of irb6640_spot_welding.
std::string log_text() {
  std::string text = "Zeit;Achse_1 [deg];Achse_2 [deg];Achse_3 [deg];Achse_4 [deg];Achse_5 [deg];Achse_6 [deg]\n";
  for (int k = 0; k < 300; ++k) {
    const double t = 0.1 * k,
                 wave = std::fmod(t, 10) < 8 ? (1 - std::cos(2 * std::numbers::pi * std::fmod(t, 10) / 8)) / 2 : 0;
    std::string row = fmt::format("{:.1f};0;-10;10;0;{:.4f};{:.4f}", t, 35 - 10 * wave, 40 * wave);
    std::replace(row.begin(), row.end(), '.', ',');
    text += row + "\n";
  }
  return text;
}

const std::string job = "irb6640_spot_welding.yaml";

void write_log(const Scratch& scratch) {
  scratch.write("log.csv", log_text());
  scratch.write(job, content(fs::path(DRESSLIFE_SOURCE_DIR) / "config/jobs" / job));
}

}  // namespace

TEST_CASE("log: the life of a log of one cycle is that of the cycle") {
  const Scratch scratch;
  write_log(scratch);
  const Outcome read = must_run(scratch, "dresslife", "import log.csv --log " + job + " -o shift.yaml --recordings 1");
  INFO(read.err);
  // The estimate comes before the log is read, the table of the axes after it.
  CHECK_THAT(read.err,
             Catch::StartsWith("log.csv: ") && Catch::Contains("about 300 rows in 29.9 s") && Catch::Contains("MB"));
  CHECK_THAT(read.out, Catch::Contains("joint_5  Achse_5 [deg]       25.0 .. 35.0     -120 .. 120"));
  CHECK_THAT(read.out,
             Catch::Contains("cycle_1: 3 times") && Catch::Contains("no rest") && Catch::Contains("estimate"));
  CHECK_THAT(content(scratch / "shift.yaml"),
             Catch::Contains("{job: cycle_1, repeats_per_hour: 3"));  // 3 in 30 s: nearly 360
  CHECK_THAT(content(scratch / "shift/study.yaml"),
             Catch::Contains("routing.mounting_pose_deg: [0.000, -10.000, 10.000, 0.000, 35.000, 0.000]}"));
  const Outcome life = run(scratch, "dresslife",
                           "duty shift.yaml --quiet --set simulation.segments=10 --set "
                           "simulation.time_step_ms=10 --set strain.surface_fibres=0 --set "
                           "strain.cable_elements_per_segment=1");
  INFO(life.err);
  CHECK(life.status == 0);
  CHECK_THAT(life.out, Catch::Contains("shift"));
}

TEST_CASE("log: cycles with product changes, a stop and jogging have the damage of one motion of all") {
  const Scratch scratch;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-1, 1);
  std::string text = "t,J1_deg,J2_deg,J3_deg,J4_deg,J5_deg,J6_deg\n";
  int row = 0;
  /// Moves axes 4 to 6 to these angles [deg] and back.
  const auto swing = [&](double seconds, const std::array<double, 3>& to) {
    for (int k = 0, rows = static_cast<int>(10 * seconds); k < rows; ++k, ++row) {
      const double wave = (1 - std::cos(2 * std::numbers::pi * k / rows)) / 2;
      text += fmt::format("{:.1f},0,-10,10", 0.1 * row);
      for (int axis = 0; axis < 3; ++axis)
        text += fmt::format(",{:.4f}", (axis == 1 ? 35 : 0) + to[axis] * wave + 0.02 * any(random));
      text += '\n';
    }
  };
  const auto product = [&](int cycles, const std::array<double, 3>& to) {
    for (int k = 0; k < cycles; ++k) {
      const double off = 0.2 * any(random);
      swing(8 + 0.2 * any(random), {to[0] + off, to[1], to[2] + off});
      swing(1.5 + any(random), {});
    }
  };
  const std::array<double, 3> first{20, -10, 60}, second{-15, 5, 40};
  product(5, first), swing(12, {}), product(4, second);
  swing(6, {7, 0, 0}), swing(2, {}), swing(5, {0, 0, -6});  // moved by hand
  product(4, first);
  scratch.write("log.csv", text);
  scratch.write("hose.yaml", edited(thin_hose, "    count: 2\n", "    count: 2\n    position: held\n"));
  scratch.write("job.yaml", R"(robot: abb_irb6640_185_280
motion: easy
dresspack: hose.yaml
routing:
  mounting_pose_deg: [0, -10, 10, 0, 35, 0]
  base_clamp: {link: link_3, position_m: [-0.1, 0, 0.45], direction: [1, 0, 0.45]}
  tool_clamp: {link: link_6, position_m: [0.144, 0, 0.174], direction: [1, 0, -0.45]}
  free_length_m: 2.035
simulation: {segments: 12, time_step_ms: 10, sample_rate_Hz: 25}
strain: {slip: stick}
fatigue: {robot_life_hours: 1.0e+7}
uncertainty: {friction_inside: 1, friction_hose: 1, slack: 1, play: 1, grip: 1, rest: 0, hose_stiffness: 1, ratings: none}
)");
  const auto life = [&](const std::string& name, const std::string& options) {
    must_run(scratch, "dresslife", "import log.csv --log job.yaml -o " + name + ".yaml --quiet " + options);
    must_run(scratch, "dresslife", "duty " + name + ".yaml --quiet");
    std::istringstream table(content(scratch / "runs" / name / ("duty_" + name + ".csv")));
    std::string line, cell;
    std::getline(table, line), std::getline(table, line);
    std::istringstream cells(line);
    for (int k = 0; k < 7; ++k) std::getline(cells, cell, ',');
    return std::stod(cell);
  };
  const double all = life("all", "--alike 0.001"), shift = life("shift", "");
  CHECK(content(scratch / "all.yaml").find("cycle_") == std::string::npos);
  CHECK_THAT(content(scratch / "shift.yaml"), Catch::Contains("cycle_2") && Catch::Contains("recording_of: cycle_1"));
  REQUIRE(std::isfinite(all));
  CHECK(all / shift == Approx(1).margin(0.05));  // damage as a duty / damage as one motion
}

TEST_CASE("log: files of the user stay, and what is no log is refused") {
  const Scratch scratch;
  write_log(scratch);
  const std::string line = "import log.csv --log " + job + " -o shift.yaml --quiet";
  scratch.write("shift/cycle_1.csv", "mine\n");
  const Outcome refused = run(scratch, "dresslife", line);
  CHECK(refused.status == 1);
  CHECK_THAT(refused.err, Catch::Contains("cycle_1.csv: error: is there already"));
  CHECK(content(scratch / "shift/cycle_1.csv") == "mine\n");
  CHECK_FALSE(fs::exists(scratch / "shift.yaml"));
  fs::remove(scratch / "shift/cycle_1.csv");
  must_run(scratch, "dresslife", line);
  CHECK(run(scratch, "dresslife", line).status == 0);  // unchanged files of the program may be overwritten
  scratch.write("shift.yaml", content(scratch / "shift.yaml") + "# edited\n");
  CHECK(run(scratch, "dresslife", line).status == 1);
  const auto words = [&](const std::string& arguments) {
    const Outcome outcome = run(scratch, "dresslife", "import " + arguments);
    CHECK(outcome.status == 1);
    return outcome.err;
  };
  CHECK_THAT(words("log.csv --log " + job + " -o shift.csv"), Catch::Contains("is no name for a file of duties"));
  CHECK_THAT(words("log.csv --log " + job + " -o a.yaml --smooth 5 --value unit=rad"),
             Catch::Contains("must be within"));
  CHECK(run(scratch, "dresslife", "import log.csv --log " + job + " -o a.yaml --alike 0.0009").status == 2);
  CHECK_THAT(words("log.csv --log " + job + " -o a.yaml --value speed=7"), Catch::Contains("is no value of a log"));
  CHECK_THAT(words("log.csv --log " + job + " -o a.yaml --set robot=x"), Catch::Contains("does not change a log"));
  const std::string length = "      free_length_m: 2.02\n";
  scratch.write("two.yaml", edited(content(fs::path(DRESSLIFE_SOURCE_DIR) / "config/jobs/irb6640_two_dresspacks.yaml"),
                                   length, "      mounting_pose_deg: [0, -10, 10, 0, 35, 0]\n" + length));
  must_run(scratch, "dresslife", "import log.csv --log two.yaml -o pair.yaml --quiet");
  CHECK_THAT(content(scratch / "pair/study.yaml"),  // only the second lacks it
             Catch::Contains("dresspacks.2.routing.mounting_pose_deg") &&
                 !Catch::Contains("dresspacks.1.routing.mounting_pose_deg"));
  scratch.write("still.csv", "t,J1,J2,J3,J4,J5,J6\n0,0,-10,10,0,35,0\n9,0,-10,10,0,35,0\n");
  CHECK_THAT(words("still.csv --log " + job + " -o a.yaml --value unit=deg"), Catch::Contains("does not move"));
}
