// The shipped jobs are plausible: a robot on the floor with a weld gun can reach their poses, and their dresspack stays intact.

#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "sim/run/simulate.h"
#include "tests/catch.h"

using namespace dresslife;
using namespace dresslife::sim;

namespace {

const std::vector<std::string> programs{"spot_robot_1", "spot_robot_2", "easy", "hard"};

pipeline::Job job_of(const std::string& program, const std::string& robot = "abb_irb6640_185_280") {
  return pipeline::read_job(DRESSLIFE_SOURCE_DIR "/config/jobs/irb6640_spot_welding.yaml",
                            {"motion=" + program, "robot=" + robot});
}

TEST_CASE("shipped programs: each takes about three minutes and ends where it begins") {
  for (const std::string& program : programs) {
    INFO(program);
    const pipeline::Job job = job_of(program);
    const JointMotion motion(job.motion, job.robot);
    CHECK(motion.duration() > 170);
    CHECK(motion.duration() < 190);
    CHECK(motion.position(motion.duration()) == motion.position(0));
  }
}

TEST_CASE("shipped programs: no limit of the robot is exceeded") {
  for (const std::string& program : programs) {
    const pipeline::Job job = job_of(program);
    const JointMotion motion(job.motion, job.robot);
    constexpr double limit_margin = 1e-9;  // [rad/s], [rad/s2]
    double over = -1;
    for (double t = 0; t < motion.duration(); t += 0.002) {
      const Eigen::VectorXd v = motion.velocity(t), a = motion.acceleration(t);
      for (int i = 0; i < 6; ++i) {
        over = std::max(over, std::abs(v[i]) - job.robot.joints[i].speed);
        over = std::max(over, std::abs(a[i]) - job.robot.joints[i].acceleration);
      }
    }
    INFO(program);
    CHECK(over < limit_margin);
  }
}

TEST_CASE("shipped programs: arm and weld gun stay above the floor") {
  for (const std::string& program : programs) {
    const pipeline::Job job = job_of(program);
    const RobotPath path(job);
    double lowest = 10;
    for (double t = 0; t < path.duration(); t += 0.02) {
      const Pose pose = path.at(t);
      for (size_t link = 2; link < pose.links.size(); ++link)
        for (const pipeline::Capsule& capsule : job.robot.links[link].capsules)
          for (const Vector3& end : {capsule.from, capsule.to})
            lowest = std::min(lowest, pose.links[link].point(end).z() - capsule.radius);
      // A weld gun of usual size: tips 0.7 m in front of the flange, body 0.25 m to one side.
      for (const Vector3& corner : {Vector3(0.7, 0, 0), Vector3(0.3, 0, -0.25)})
        lowest = std::min(lowest, pose.links[6].point(corner).z());
    }
    INFO(program);
    CHECK(lowest > 0.1);
  }
}

TEST_CASE("shipped programs: robot 1 turns the wrist more than robot 2, easy least, hard most") {
  const auto wrist_range = [](const std::string& program) {
    const pipeline::Job job = job_of(program);
    const JointMotion motion(job.motion, job.robot);
    Eigen::Vector3d low = motion.position(0).tail<3>(), high = low;
    for (double t = 0; t < motion.duration(); t += 0.01) {
      low = low.cwiseMin(motion.position(t).tail<3>());
      high = high.cwiseMax(motion.position(t).tail<3>());
    }
    return (high - low).sum();
  };
  const double easy = wrist_range("easy"), calm = wrist_range("spot_robot_2"), lively = wrist_range("spot_robot_1"),
               hard = wrist_range("hard");
  CHECK(2 * easy < calm);
  CHECK(2 * calm < lively);
  CHECK(lively < hard);
}

TEST_CASE("shipped programs: the dresspack goes through all of them on the IRB 6640") {
  for (const std::string& program : programs) {
    pipeline::Job job = job_of(program);
    job.simulation.most_repeats = 1;  // the first repeat is the roughest
    const Simulation simulation(job);
    double depth = 0, tension = 0, bend = 0;
    simulation.run({[&](const Sample& sample) {
      depth = std::max(depth, sample.max_depth);
      for (const double pull : sample.tension) tension = std::max(tension, std::abs(pull));
      for (int link = 0; link < simulation.rod().links(); ++link)
        bend = std::max(bend, simulation.rod().link_state(sample.state, link).turn.head<2>().norm() /
                                  simulation.rod().bending_length(link));
    }});
    INFO(program);
    CHECK(depth < 1e-3);  // less than the hose's wall yields [m]
    const pipeline::MountedDresspack& hose = job.dresspacks.front();
    const double weight = 9.81 * hose.dresspack.mass_per_length * hose.routing.free_length;
    CHECK(tension < 10 * weight);  // [N]
    // Robot cells bend such hoses to radii of 250 to 600 mm. Only the program `hard` bends more, and it must not kink the hose
    // [1/m].
    CHECK(bend < (program == "hard" ? 10 : 4));
    CHECK(bend > 0.5);  // the hose does move
  }
}

TEST_CASE("shipped programs: the IRB 6700 carries the same dresspack through the calm program") {
  const Simulation simulation(job_of("spot_robot_2", "abb_irb6700_235_265"));
  double depth = 0;
  simulation.run({[&](const Sample& sample) { depth = std::max(depth, sample.max_depth); }});
  CHECK(depth < 1e-3);
}

}  // namespace
