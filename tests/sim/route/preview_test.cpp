#include "sim/route/preview.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "pipeline/base/warnings.h"
#include "pipeline/files/files.h"
#include "pipeline/resolve/job_text.h"
#include "sim/run/checks.h"
#include "sim/run/cures.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"
#include "tests/sim/simple_job.h"

namespace dresslife::sim {
namespace {

pipeline::FileReader preview_of(const pipeline::Scratch& scratch, const pipeline::Job& job) {
  {
    pipeline::FileWriter file(scratch / "preview.h5", pipeline::preview_format());
    write_preview(job, file);
    file.attribute("job", "");
    file.attribute("history", "");
    file.attribute("input_sha256", "");
    file.commit();
  }
  return pipeline::FileReader(scratch / "preview.h5", pipeline::preview_format());
}

TEST_CASE("preview: lengths that work leave the slack that the checks ask for") {
  const WorkingLength range = working_length(0.98);
  CHECK(range.least == Approx(1));    // slack of 0.02 of 1 m
  CHECK(range.most == Approx(1.47));  // slack of 0.49 m, a third of it
  CHECK(working_length(0).most == 0);
}

TEST_CASE("preview: a weightless hose between tangents of a circle rests in its arc") {
  // The tried length k is c/0.98 (0.98 1.5)^(k/15) with the chord c. For k = 3 the arc over the chord has the half angle a with
  // a / sin a = this ratio.
  const double ratio = 1 / 0.98 * std::pow(0.98 * 1.5, 3.0 / 15);
  double a = 1;
  for (int i = 0; i < 50; ++i)
    a -= (a / std::sin(a) - ratio) * std::sin(a) * std::sin(a) / (std::sin(a) - a * std::cos(a));
  pipeline::Job job = simple_job();
  job.motion.steps = {move_to(0, "start"), dwell_for(0.5)};
  job.simulation.gravity = {0, 0, 0};
  job.simulation.segments = 32;
  pipeline::Routing& routing = job.dresspacks[0].routing;
  routing.base_clamp->direction = {std::cos(a), 0, std::sin(a)};
  routing.tool_clamp->direction = {std::cos(a), 0, -std::sin(a)};
  routing.free_length = 0.9 * ratio;
  const pipeline::Scratch scratch;
  const pipeline::FileReader file = preview_of(scratch, job);
  CHECK(file.text_attribute("refusal") == "");
  CHECK(file.read<double>("/span/working_length")[2] == Approx(0.9 / 0.98));
  const auto lengths = file.read<double>("/scan/length"), radii = file.read<double>("/scan/bend_radius");
  REQUIRE(lengths.size() == 16);
  CHECK(lengths[3] == Approx(routing.free_length));
  // Links of l = L/32 turn by l/r each. Stretch and rest tolerance are below 1e-3; the corrections of the ends are of order
  // (l/r)^2.
  CHECK(radii[3] == Approx(0.45 / std::sin(a)).epsilon(0.01));
}

TEST_CASE("preview: the moment at which the clamps are farthest apart is among its samples") {
  // The tool clamp is 0.3 m from the spindle's axis: distance^2 = 0.9^2 + (0.6 sin(q/2))^2, largest at the largest q.
  pipeline::Job job = simple_job();
  job.dresspacks[0].routing.base_clamp->position = {0, 0, 1.3};
  job.dresspacks[0].routing.tool_clamp->position = {0.9, 0, 0.3};
  job.dresspacks[0].routing.free_length = 1;
  const pipeline::Scratch scratch;
  const pipeline::FileReader file = preview_of(scratch, job);
  const auto ways = file.read<double>("/span/way"), times = file.read<double>("/time");
  const double farthest = std::hypot(0.9, 0.6 * std::sin(1));
  CHECK(*std::max_element(ways.begin(), ways.end()) == Approx(farthest));
  CHECK(ways.front() == Approx(0.9));
  const std::string refusal = file.text_attribute("refusal");
  CHECK(refusal.find(fmt::format("{:.1f} mm too short", 1e3 * (farthest - 1))) != std::string::npos);
  const double when = file.number_attribute("refusal_time");
  CHECK(std::find(times.begin(), times.end(), when) != times.end());
  CHECK(refusal.find(fmt::format("at {:.3f} s", when)) != std::string::npos);
}

TEST_CASE("preview: a mounting pose of its own comes before the program") {
  pipeline::Job job = simple_job();
  job.dresspacks[0].routing.mounting_pose = {1};
  const pipeline::Scratch scratch;
  const pipeline::FileReader file = preview_of(scratch, job);
  CHECK(file.read<double>("/time").front() == -1);
  CHECK(file.read<double>("/time")[1] == 0);
  CHECK(file.read<double>("/robot/joint_position").front() == 1);
}

/// Returns the warnings of `dresslife check` on the motion of a job.
std::vector<pipeline::Warning> warnings_in(const pipeline::Job& job) {
  const pipeline::Scratch scratch;
  return pipeline::warnings_from(preview_of(scratch, job).text_attribute("warnings"));
}

TEST_CASE("a remedy of check is applied and checked again: no warning is left") {
  const std::filesystem::path file =
      std::filesystem::path(DRESSLIFE_SOURCE_DIR) / "config/jobs/irb6640_spot_welding.yaml";
  std::vector<std::string> sets{"simulation.segments=40", "routing.free_length_m=1.86"};
  const std::vector<pipeline::Warning> warnings = warnings_in(pipeline::read_job(file, sets));
  REQUIRE_FALSE(warnings.empty());
  std::string words;
  for (const pipeline::Warning& warning : warnings) {
    words += warning.words + "\n";
    for (const pipeline::KeyValue& value : warning.remedy) sets.push_back(value.key + "=" + value.value);
  }
  INFO(words);
  CHECK(sets.size() > 2);
  CHECK(warnings_in(pipeline::read_job(file, sets)) == std::vector<pipeline::Warning>{});
}

}  // namespace
}  // namespace dresslife::sim
