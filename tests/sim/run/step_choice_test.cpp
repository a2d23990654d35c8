#include "sim/run/step_choice.h"

#include <filesystem>
#include <fstream>

#include "sim/run/simulate.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"
#include "tests/sim/rod/rod_driven_cable.h"
#include "tests/sim/simple_job.h"

using namespace dresslife;
using namespace dresslife::sim;

namespace {

using test::DrivenCable;

constexpr double begin = 3.5;  ///< in the time of the driven cable, whose ends are at rest until 4 s [s]

/// Returns the driven cable as a job: its clamps as recorded poses, with the hose hanging at rest at the begin.
pipeline::Job driven_cable(const std::filesystem::path& file) {
  {
    std::ofstream csv(file);
    for (int k = 0; k <= 2050; ++k) {
      const double t = 0.01 * k;
      csv << fmt::format("{}", t);
      const ClampFrames clamps = DrivenCable::clamps(begin + t);
      for (const Frame& f : {clamps.base, clamps.tool})
        csv << fmt::format(",{},{},{},{},{},{},{}", f.position.x(), f.position.y(), f.position.z(), f.orientation.w(),
                           f.orientation.x(), f.orientation.y(), f.orientation.z());
      csv << "\n";
    }
  }
  const RodProperties p = DrivenCable::properties(40);
  pipeline::Job job;
  job.motion.clamp_poses = file;
  job.dresspacks[0].dresspack.diameter = p.diameter;
  job.dresspacks[0].dresspack.mass_per_length = p.mass_per_length;
  job.dresspacks[0].dresspack.bending_stiffness = p.bending_stiffness;
  job.dresspacks[0].dresspack.torsional_stiffness = p.torsional_stiffness;
  job.dresspacks[0].dresspack.axial_stiffness = p.axial_stiffness;
  job.dresspacks[0].dresspack.damping_time = p.damping_time;
  job.dresspacks[0].routing.free_length = p.length;
  job.simulation.segments = 40;
  job.simulation.floor = false;
  return job;
}

struct Run {
  std::vector<double> curvature;  // (sample, link)
  RunSummary summary;
};

Run run(const pipeline::Job& job) {
  const Simulation simulation(job);
  const Rod& rod = simulation.rod();
  Run r;
  r.summary = simulation.run({[&](const Sample& s) {
                                for (int j = 0; j < rod.links(); ++j)
                                  r.curvature.push_back(rod.link_state(s.state, j).turn.head<2>().norm() /
                                                        rod.bending_length(j));
                              },
                              [&](int) { r.curvature.clear(); }});
  return r;
}

double relative_error(const std::vector<double>& a, const std::vector<double>& exact) {
  double difference = 0, size = 0;
  for (size_t k = 0; k < a.size(); ++k) {
    difference += (a[k] - exact[k]) * (a[k] - exact[k]);
    size += exact[k] * exact[k];
  }
  return std::sqrt(difference / size);
}

TEST_CASE("step choice: the stated error of the driven cable is right within a factor of two") {
  const pipeline::Scratch scratch;
  pipeline::Job job = driven_cable(scratch / "poses.csv");
  job.simulation.time_step = 0.000625;
  const Run exact = run(job);  // its own error is 1/64 of that at 5 ms
  for (const double step : {0.01, 0.005, 0.0025}) {
    job.simulation.time_step = step;
    const Run coarse = run(job);
    const double error = relative_error(coarse.curvature, exact.curvature);
    CAPTURE(step, error, coarse.summary.curvature_error);
    CHECK(coarse.summary.curvature_error > error / 2);
    CHECK(coarse.summary.curvature_error < 2 * error);
  }
  job.simulation.choose_time_step = true;
  for (const double wanted : {0.01, 0.001}) {
    job.simulation.curvature_error = 100 * wanted;
    const Run chosen = run(job);
    const double error = relative_error(chosen.curvature, exact.curvature);
    CAPTURE(wanted, chosen.summary.time_step, error, chosen.summary.curvature_error);
    CHECK(chosen.summary.curvature_error > error / 2);
    CHECK(chosen.summary.curvature_error < 2 * error);
    CHECK(chosen.summary.curvature_error < 2 * wanted);
  }
}

TEST_CASE("step choice: the chosen step follows second order and fits the sample rate") {
  CHECK(first_step(25) == Approx(0.005));
  CHECK(first_step(30) == Approx(1 / (30 * 7.0)));
  CHECK(first_step(1000) == Approx(0.001));
  CHECK(chosen_step(0.005, 0.01, 0.0025, 100) == Approx(0.0025));  // a quarter of the error: half the step
  CHECK(chosen_step(0.005, 0.01, 0.0024, 100) == Approx(0.01 / 5));
  CHECK(chosen_step(0.005, 1e-9, 0.01, 25) == Approx(0.01));  // not larger than the tested step
  CHECK(chosen_step(0.005, 1e9, 0.01, 25) == Approx(0.0002));
  CHECK(chosen_step(0.005, NAN, 0.01, 25) == Approx(0.0002));
}

TEST_CASE("step choice: the lively windows lie where the clamps accelerate") {
  pipeline::Job job = simple_job();
  job.motion.steps = {move_to(0), dwell_for(20), move_to(2), move_to(0), dwell_for(20)};
  job.dresspacks[0].routing.tool_clamp->position = {0.9, 0.1, 0};  // off the axis, so that it moves
  const RobotPath path(job);
  const double h = 0.005;
  const auto windows = lively_windows(path, h, static_cast<int>(path.duration() / h));
  REQUIRE(windows.size() == 1);
  CHECK(windows[0].begin * h > 17);
  CHECK(windows[0].end * h < path.duration() - 17);
  CHECK((windows[0].end - windows[0].begin) * h == Approx(3));
  CHECK(windows[0].compare - windows[0].begin == windows[0].end - windows[0].compare);
}

TEST_CASE("step choice: also in the shortest motions the compared states lie behind the common begin") {
  const RobotPath path(simple_job());
  for (int steps = 0; steps < 12; ++steps) {
    CAPTURE(steps);
    const auto windows = lively_windows(path, 0.005, steps);
    CHECK(windows.empty() == (steps < 3));
    for (const StepWindow& window : windows) {
      CHECK(window.compare > std::max(window.begin, 1));  // StepError begins at step 1 or later
      CHECK(window.compare < window.end);
    }
  }
}

}  // namespace
