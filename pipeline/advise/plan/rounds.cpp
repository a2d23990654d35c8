#include "pipeline/advise/plan/rounds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "pipeline/base/digest.h"
#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/plain_file.h"
#include "pipeline/base/whole_file.h"
#include "pipeline/files/files.h"
#include "pipeline/job/job.h"

namespace dresslife::pipeline {
namespace {

constexpr double share_of_speed = 0.5, share_of_acceleration = 0.25;  // for moves between programs
constexpr double same_pose = 1e-3 * std::numbers::pi / 180;           // [rad]: a hundred times the rounding of a row
constexpr std::size_t longest_name = 150;                             // of a folder's name

class Recording {
 public:
  Recording(const std::vector<Joint>& axes, double interval) : axes_(axes), interval_(interval) {
    text_ = "time_s";
    for (std::size_t axis = 0; axis < axes.size(); ++axis) text_ += fmt::format(",axis_{}_deg", axis + 1);
    text_ += '\n';
  }

  /// Adds a program. The robot stands for one interval before it begins: the spline has zero speed between equal rows.
  void add(const JointCourse& program) {
    const std::size_t axes = axes_.size();
    move_to({program.angles.begin(), program.angles.begin() + static_cast<std::ptrdiff_t>(axes)});
    const double begin = pose_.empty() ? 0 : time_ + interval_;
    for (std::size_t k = 0; k < program.times.size(); ++k) {
      const auto row = program.angles.begin() + static_cast<std::ptrdiff_t>(k * axes);
      put(begin + program.times[k], {row, row + static_cast<std::ptrdiff_t>(axes)});
    }
  }

  /// Adds a move from the present pose. Does nothing before the first row, or if the robot is already there.
  void move_to(const std::vector<double>& target) {
    if (pose_.empty()) return;
    constexpr double top_speed = 15.0 / 8,
                     top_acceleration =
                         5.7735;  // maxima of the derivatives of 10 u^3 - 15 u^4 + 6 u^5; the second is 10/sqrt(3)
    const std::vector<double> from = pose_;
    double seconds = 0, way = 0;
    for (std::size_t axis = 0; axis < axes_.size(); ++axis) {
      const double turn = std::abs(target[axis] - from[axis]);
      way = std::max(way, turn);
      seconds = std::max({seconds, top_speed * turn / (share_of_speed * axes_[axis].speed),
                          std::sqrt(top_acceleration * turn / (share_of_acceleration * axes_[axis].acceleration))});
    }
    if (way < same_pose) return;
    const int steps = static_cast<int>(std::ceil(seconds / interval_));
    const double begin = time_ + interval_;
    for (int i = 0; i <= steps; ++i) {
      const double u = double(i) / steps, share = u * u * u * (10 + u * (6 * u - 15));
      std::vector<double> pose = from;
      for (std::size_t axis = 0; axis < pose.size(); ++axis) pose[axis] += share * (target[axis] - from[axis]);
      put(begin + i * interval_, std::move(pose));
    }
  }

  const std::string& text() const { return text_; }

 private:
  void put(double time, std::vector<double> pose) {
    text_ += fmt::format("{:.6f}", time);
    for (const double angle : pose) text_ += fmt::format(",{:.5f}", angle * 180 / std::numbers::pi);
    text_ += '\n';
    time_ = time, pose_ = std::move(pose);
  }

  const std::vector<Joint>& axes_;
  double interval_;  ///< [s] between rows of a move
  std::string text_;
  double time_ = 0;
  std::vector<double> pose_;  ///< pose of the last row [rad]
};

std::vector<Joint> driven(const Robot& robot) {
  return filtered(robot.joints, [](const Joint& joint) { return joint.follows.empty(); });
}

/// Returns the joint angles of a program from its strain file, which is kept longer than its motion file.
JointCourse course_of(const OrderedProgram& program, const std::vector<RankingRow>& rows, std::size_t axes) {
  const RankingRow* const row = find_in(rows, &RankingRow::job, program.job);
  if (!row || !row->done())
    throw InputError(program.where,
                     fmt::format("job '{}' has no result{}", program.job, row ? ": " + row->failure : ""),
                     "correct the job and run again");
  const std::filesystem::path strain = row->life_file.parent_path() / "strain.h5";
  if (kind_of(strain) != FileKind::file)
    throw InputError(program.where,
                     fmt::format("'{}' has no strain.h5, from which an order takes its joint angles", program.job),
                     "keep: histories, or all, in the study");
  const FileReader file(strain, strain_format());
  if (!file.has("/robot/joint_position"))
    throw InputError(program.where,
                     fmt::format("no robot moves in '{}', so what it does between programs is not known", program.job),
                     "leave out the order, or give one motion of all programs");
  JointCourse course{file.read<double>("/time"), file.read<double>("/robot/joint_position")};
  if (course.times.size() < 2 || course.angles.size() != course.times.size() * axes)
    throw InputError(program.where, fmt::format("'{}' does not move", program.job), "leave it out of the order");
  return course;
}

}  // namespace

std::string round_name(const Duty& duty) {
  const std::string name = joined(mapped(duty.order, &OrderedProgram::job), "+");
  return name.size() <= longest_name ? name : "round_" + xxh3(name).substr(0, 16);
}

std::vector<double> repeats_in_rounds(const Duty& duty, const std::vector<double>& repeats_per_hour) {
  std::vector<double> repeats = repeats_per_hour;
  if (duty.order.empty()) return repeats;
  const std::size_t programs = duty.programs.size();
  std::vector<double> runs(programs, 0), in_round(programs, 0);
  for (const OrderedProgram& program : duty.order)
    for (std::size_t k = 0; k < programs; ++k)
      if (duty.programs[k].job == program.job) ++runs[k], in_round[k] += program.repeats;
  double rounds = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < programs; ++k)
    if (in_round[k] > 0) rounds = std::min(rounds, repeats[k] / in_round[k]);
  for (std::size_t k = 0; k < programs; ++k) repeats[k] = std::max(0.0, repeats[k] - rounds * runs[k]);
  repeats.push_back(rounds);
  return repeats;
}

std::string round_csv(const std::vector<JointCourse>& programs, const std::vector<Joint>& axes) {
  const JointCourse& first = programs.front();
  Recording recording(axes, first.times[1] - first.times[0]);
  for (const JointCourse& program : programs) recording.add(program);
  recording.move_to({first.angles.begin(), first.angles.begin() + static_cast<std::ptrdiff_t>(axes.size())});
  return recording.text();
}

void evaluate_at_medians(Job& job) {
  job.uncertainty.enabled = false;
  job.uncertainty.ratings = KnownRatings::none;
  job.calibration.reset();
}

Study study_of_rounds(const DutyFile& file, const Study& study, const std::vector<RankingRow>& rows,
                      const std::filesystem::path& folder) {
  Study rounds{study.name, {}, study.keep};
  std::set<std::string> known;
  for (const Duty& duty : file.duties) {
    const std::string name = round_name(duty);
    if (name.empty() || !known.insert(name).second) continue;
    const StudyJob* const first = find_in(study.jobs, &StudyJob::name, duty.order.front().job);
    if (!first || !first->job)
      throw InputError(duty.order.front().where, fmt::format("job '{}' cannot be made", duty.order.front().job),
                       "correct it: dresslife status STUDY gives the reason");
    Job job = *first->job;
    if (!job.robot.external_axes.empty())
      throw InputError(duty.order.front().where, "an order is not evaluated for a robot with external axes",
                       "give a job with one motion of all programs, and its repeats_per_hour");
    const std::vector<Joint> axes = driven(job.robot);
    const std::vector<JointCourse> courses =
        mapped(duty.order, [&](const OrderedProgram& program) { return course_of(program, rows, axes.size()); });
    Motion motion;
    motion.name = name;
    motion.source = "the programs of a duty in their order";
    motion.program = folder / (name + ".csv");
    motion.rows = RecordedRows::spline;
    write_text_if_changed(motion.program, with_mark(round_csv(courses, axes), Mark::yaml));
    job.motion = std::move(motion);
    evaluate_at_medians(job);
    rounds.jobs.push_back({name, std::make_shared<const Job>(std::move(job)), ""});
  }
  return rounds;
}

}  // namespace dresslife::pipeline
