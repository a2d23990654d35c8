// A log of joint angles as a study and a file of duties, and the life of its dresspack.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "tests/catch.h"
#include "tests/cli/process.h"

using namespace dresslife::tests;

namespace {

/// Three cycles of 8 s that turn axes 5 and 6, with stands, on the robot of irb6640_spot_welding.
std::string log_text() {
  std::string text =
      "Zeit;Achse_1 [deg];Achse_2 [deg];Achse_3 [deg];Achse_4 [deg];Achse_5 [deg];Achse_6 [deg]\n";
  for (int k = 0; k < 300; ++k) {
    const double t = 0.1 * k, wave = std::fmod(t, 10) < 8
                                         ? (1 - std::cos(2 * std::numbers::pi * std::fmod(t, 10) / 8)) / 2
                                         : 0;
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
  const Outcome read = must_run(scratch, "dresslife", "import log.csv --log " + job + " -o shift.yaml");
  INFO(read.err);
  // The estimate comes before the log is read, the table of the axes behind it.
  CHECK_THAT(read.err, Catch::StartsWith("log.csv: ") && Catch::Contains("about 300 rows in 29.9 s") &&
                           Catch::Contains("MB"));
  CHECK_THAT(read.out, Catch::Contains("joint_5  Achse_5 [deg]       25.0 .. 35.0     -120 .. 120"));
  CHECK_THAT(read.out, Catch::Contains("cycle_1: 3 times") && Catch::Contains("no rest") &&
                           Catch::Contains("estimate"));
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
  CHECK(run(scratch, "dresslife", line).status == 0);  // its own files may be written again
  scratch.write("shift.yaml", content(scratch / "shift.yaml") + "# edited\n");
  CHECK(run(scratch, "dresslife", line).status == 1);
  const auto words = [&](const std::string& arguments) {
    const Outcome outcome = run(scratch, "dresslife", "import " + arguments);
    CHECK(outcome.status == 1);
    return outcome.err;
  };
  CHECK_THAT(words("log.csv --log " + job + " -o shift.csv"),
             Catch::Contains("is no name for a file of duties"));
  CHECK_THAT(words("log.csv --log " + job + " -o a.yaml --smooth 5 --value unit=rad"),
             Catch::Contains("must be within"));
  CHECK(run(scratch, "dresslife", "import log.csv --log " + job + " -o a.yaml --alike 0.0009").status == 2);
  CHECK_THAT(words("log.csv --log " + job + " -o a.yaml --value speed=7"),
             Catch::Contains("is no value of a log"));
  CHECK_THAT(words("log.csv --log " + job + " -o a.yaml --set robot=x"),
             Catch::Contains("does not change a log"));
  const std::string length = "      free_length_m: 2.035\n";
  scratch.write("two.yaml", edited(content(fs::path(DRESSLIFE_SOURCE_DIR) / "config/jobs/irb6640_two_dresspacks.yaml"), length,
                                   "      mounting_pose_deg: [0, -10, 10, 0, 35, 0]\n" + length));
  must_run(scratch, "dresslife", "import log.csv --log two.yaml -o pair.yaml --quiet");
  CHECK_THAT(content(scratch / "pair/study.yaml"),  // only the second lacks it
             Catch::Contains("dresspacks.2.routing.mounting_pose_deg") && !Catch::Contains("dresspacks.1.routing.mounting_pose_deg"));
  scratch.write("still.csv", "t,J1,J2,J3,J4,J5,J6\n0,0,-10,10,0,35,0\n9,0,-10,10,0,35,0\n");
  CHECK_THAT(words("still.csv --log " + job + " -o a.yaml --value unit=deg"),
             Catch::Contains("does not move"));
}
