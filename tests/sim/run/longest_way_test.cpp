// The largest straight way over a motion.
#include "sim/run/longest_way.h"

#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "sim/run/routing.h"
#include "tests/catch.h"

namespace dresslife::sim {
namespace {

pipeline::Job shipped(const std::string& name, const std::vector<std::string>& sets = {}) {
  return pipeline::read_job(DRESSLIFE_SOURCE_DIR "/config/jobs/" + name + ".yaml", sets);
}

TEST_CASE("the longest way of a loop is that of its first repeats") {
  pipeline::Job job = shipped("irb6640_spot_welding");
  const pipeline::MotionStep home = job.motion.steps.front();
  pipeline::MotionStep loop;
  loop.steps.assign(job.motion.steps.begin(), job.motion.steps.begin() + 6);
  job.motion.steps = {home, loop};
  const auto longest = [&](int repeats) {
    job.motion.steps.back().repeat = repeats;
    const RobotPath path(job);
    return longest_ways(job, rod_of(job), path, 0.004).front();
  };
  const LongestWay few = longest(3), many = longest(300);
  CHECK(many.way == Approx(few.way).margin(1e-9));
  CHECK(many.time == Approx(few.time).margin(1e-6));
}

}  // namespace
}  // namespace dresslife::sim
