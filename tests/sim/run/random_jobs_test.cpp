// Random but feasible jobs on the shipped robots: each ends with finite numbers and without growing energy, or stops with a
// message that a user can act on. Six of them run with every test; DRESSLIFE_RANDOM_JOBS=200 runs two hundred.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <random>

#include "pipeline/base/constants.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "sim/run/simulate.h"
#include "tests/catch.h"

namespace dresslife::sim {
namespace {

class Chance {
 public:
  explicit Chance(unsigned seed) : bits_(seed) {}
  double between(double low, double high) { return low + (high - low) * static_cast<double>(bits_() >> 11) * 0x1p-53; }
  template <class T, size_t n>
  T one_of(const T (&values)[n]) {
    return values[bits_() % n];
  }
  int whole(int low, int high) { return low + static_cast<int>(bits_() % static_cast<unsigned>(high - low + 1)); }

 private:
  std::mt19937_64 bits_;
};

pipeline::MotionStep random_move(Chance& chance) {
  constexpr double least[] = {-60, -20, -20, -90, -90, -150}, most[] = {60, 45, 40, 90, 90, 150};
  pipeline::MotionStep step;
  for (int joint = 0; joint < 6; ++joint) step.joints.push_back(chance.between(least[joint], most[joint]) * degree);
  step.speed_percent = chance.between(20, 100);
  step.zone = chance.one_of({0.0, 2 * degree, 10 * degree});
  return step;
}

pipeline::Motion random_motion(Chance& chance) {
  pipeline::Motion motion;
  motion.name = "random";
  motion.steps.push_back(random_move(chance));
  for (int moves = chance.whole(2, 5); moves > 0; --moves) motion.steps.push_back(random_move(chance));
  if (chance.whole(0, 1)) motion.steps.push_back(motion.steps.front());
  pipeline::MotionStep wait;
  wait.dwell = 2;
  motion.steps.push_back(wait);
  return motion;
}

double longest_chord(const ClampPath& path) {
  double longest = 0;
  for (double t = 0; t < path.duration(); t += 0.01) {
    const ClampFrames clamps = path.at(t).clamps;
    longest = std::max(longest, (clamps.tool.position - clamps.base.position).norm());
  }
  return longest;
}

pipeline::Job random_job(unsigned seed) {
  Chance chance(seed);
  pipeline::Job job =
      pipeline::read_job(DRESSLIFE_SOURCE_DIR "/config/jobs/irb6640_spot_welding.yaml",
                         {std::string("robot=") + chance.one_of({"abb_irb6640_185_280", "abb_irb6700_235_265"})});
  job.motion = random_motion(chance);
  job.dresspacks[0].dresspack.axial_stiffness = std::pow(10, chance.between(4, 6));
  job.dresspacks[0].dresspack.bending_stiffness = chance.between(2, 10);
  job.dresspacks[0].dresspack.torsional_stiffness =
      job.dresspacks[0].dresspack.bending_stiffness * chance.between(0.4, 1.5);
  job.dresspacks[0].dresspack.damping_time = chance.between(0.003, 0.03);
  job.dresspacks[0].dresspack.friction = chance.between(0, 0.6);
  job.dresspacks[0].dresspack.diameter = chance.between(0.03, 0.07);
  job.simulation.segments = chance.whole(15, 120);
  job.simulation.time_step = chance.one_of({0.001, 0.002, 0.004, 0.005, 0.008, 0.01});
  job.simulation.most_repeats = chance.whole(1, 3);
  for (int axis = 0; axis < 3; ++axis) {
    job.dresspacks[0].routing.base_clamp->position[axis] += chance.between(-0.05, 0.05);
    job.dresspacks[0].routing.base_clamp->direction[axis] += chance.between(-0.3, 0.3);
    job.dresspacks[0].routing.tool_clamp->direction[axis] += chance.between(-0.3, 0.3);
  }
  job.dresspacks[0].routing.free_length = longest_chord(RobotPath(job)) * chance.between(1.08, 1.4);
  return job;
}

/// Returns "ended" or the message's kind. Checks that an ended job has finite numbers and no growing energy while at rest.
std::string outcome(unsigned seed) {
  CAPTURE(seed);
  const pipeline::Job job = random_job(seed);
  double standing = job.motion.steps.back().dwell, at_rest = 0, highest = 0, elastic = 0;
  try {
    const Simulation simulation(job);
    const double stops = simulation.path().duration() - standing;
    bool finite = true;
    const auto take = [&](const Sample& s) {
      finite = finite && simulation.rod().finite(s.state) && std::isfinite(s.energy.total());
      if (s.time < stops) at_rest = highest = -1;
      if (s.time < stops) return;
      if (at_rest == -1) at_rest = highest = s.energy.total(), elastic = s.energy.elastic + s.energy.kinetic;
      highest = std::max(highest, s.energy.total());
    };
    const RunSummary summary = simulation.run({take});
    CHECK(finite);
    for (const Check& check : summary.checks) CHECK((std::isfinite(check.value) && !std::isnan(check.limit)));
    // While the robot is at rest, friction and damping only reduce the energy. Contact pushes overlaps of up to 1 mm apart with
    // about 100 N: 0.1 J. The leapfrog's kinetic energy belongs to half a step earlier: within 1 %.
    CHECK(highest - at_rest < 0.1 + 0.01 * elastic);
    return "ended";
  } catch (const pipeline::InputError& error) {
    for (const char* kind :
         {"is pulled tight", "mm too short", "mm deep through", "does not come to rest", "finds no equilibrium"})
      if (std::string(error.what()).find(kind) != std::string::npos) return kind;
    return error.what();
  }
}

void run_jobs(unsigned first, unsigned count, unsigned least_ended) {
  std::map<std::string, unsigned> outcomes;
  for (unsigned seed = first; seed < first + count; ++seed) ++outcomes[outcome(seed)];
  unsigned known = 0;
  for (const auto& [kind, times] : outcomes) {
    CAPTURE(kind, times);
    CHECK(kind.size() < 30);  // not an unexpected message
    known += times;
  }
  CHECK(known == count);
  CHECK(outcomes["ended"] >= least_ended);
  if (count > 100)
    for (const auto& [kind, times] : outcomes) std::printf("%4u %s\n", times, kind.c_str());
}

TEST_CASE("random jobs: as many as DRESSLIFE_RANDOM_JOBS says, or a handful, end calmly") {
  const char* wanted = std::getenv("DRESSLIFE_RANDOM_JOBS");
  const unsigned count = wanted ? static_cast<unsigned>(std::max(6, std::atoi(wanted))) : 6;
  run_jobs(1, count, count / 2);
}

}  // namespace
}  // namespace dresslife::sim
