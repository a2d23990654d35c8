// The largest straight way over a motion, against a search of all moments that leaves none out.
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

/// Returns the longest ways over the moments at which longest_ways() may look.
std::vector<LongestWay> of_all_moments(const pipeline::Job& job, const Rod& rod, const RobotPath& path, double step) {
  std::vector<LongestWay> longest(rod.spans().size());
  for (const MotionPiece& piece : path.motion().pieces())
    for (int k = 0; k * step < piece.duration; ++k) {
      const double time = piece.start + k * step;
      const Pose pose = path.at(time);
      const std::vector<double> ways = shortest_ways(job, rod, pose.clamps, pose.rings);
      for (std::size_t span = 0; span < ways.size(); ++span)
        if (rod.spans()[span].properties.tool_end != End::free && ways[span] > longest[span].way) longest[span] = {ways[span], time};
    }
  return longest;
}

TEST_CASE("the longest way that leaves out moments is that of all moments") {
  const std::vector<pipeline::Job> jobs{
      shipped("irb6640_spot_welding"),
      shipped("side_panel"),                                // straight and circular paths of the tool
      shipped("irb6640_guided"),                            // two spans, a ring
      shipped("irb6640_two_dresspacks"),
      shipped("irb6640_spot_welding", {"motion=hard", "robot=abb_irb6700_235_265"}),
      shipped("irb6640_spot_welding", {"routing.retraction={force_N: 100, stroke_m: 0.3}"})};
  for (const pipeline::Job& job : jobs) {
    const Rod rod = rod_of(job);
    const RobotPath path(job);
    constexpr double step = 0.004;
    const std::vector<LongestWay> found = longest_ways(job, rod, path, step), all = of_all_moments(job, rod, path, step);
    REQUIRE(found.size() == all.size());
    for (std::size_t span = 0; span < all.size(); ++span) {
      CHECK(found[span].way == Approx(all[span].way).margin(1e-9));  // ways that are nearer to each other count as equal
      const Pose pose = path.at(found[span].time);
      CHECK(shortest_ways(job, rod, pose.clamps, pose.rings)[span] == Approx(found[span].way).margin(1e-9));
    }
  }
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
