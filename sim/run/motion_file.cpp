#include "sim/run/motion_file.h"

#include "pipeline/base/joined.h"

#include <array>
#include <cmath>

namespace dresslife::sim {
namespace {

void put(std::vector<double>& row, const Vector3& v) { row.insert(row.end(), {v.x(), v.y(), v.z()}); }
void put(std::vector<double>& row, const Quaternion& q) { row.insert(row.end(), {q.w(), q.x(), q.y(), q.z()}); }

}  // namespace

MotionFile::MotionFile(pipeline::FileWriter& file, const RunDescription& description)
    : file_(file), description_(description) {
  file_.set_axis("segment", description.segment_length.size());
  file_.set_axis("clamp", description.clamp_segment.size());
  file_.set_axis("hose_link", description.links);
  file_.set_axis("dresspack", description.dresspacks.size());
  if (description.joints > 0) {
    file_.set_axis("joint", description.joints);
    file_.set_axis("link", description.link_names.size());
  }
  file_.append("/segment/length", std::span<const double>(description.segment_length));
  file_.append("/segment/dresspack", std::span<const std::int32_t>(description.dresspack));
  file_.append("/dresspack/name", std::span<const std::string>(description.dresspacks));
  file_.append("/dresspack/bending_stiffness", std::span<const double>(description.bending_stiffness));
  file_.append("/dresspack/torsional_stiffness", std::span<const double>(description.torsional_stiffness));
  file_.append("/dresspack/axial_stiffness", std::span<const double>(description.axial_stiffness));
  if (description.clamp_segment.size() > 2)
    file_.append("/clamp/segment",
                 std::span<const std::int32_t>(description.clamp_segment.data(), description.clamp_segment.size()));
  file_.append("/program/text", std::span<const std::string>(description.step_texts));
  for (const MotionLoop& loop : description.loops)
    file_.append("/program/loop", std::array{loop.begin, loop.round, static_cast<double>(loop.rounds)});
}

void MotionFile::add(const Sample& sample) {
  const auto rows = [&](const char* dataset, std::span<const double> values) { file_.append(dataset, values); };
  positions_.clear();
  orientations_.clear();
  for (const Vector3& position : sample.state.position) put(positions_, position);
  for (const Quaternion& orientation : sample.state.orientation) put(orientations_, orientation);
  rows("/time", std::array{sample.time});
  rows("/segment/position", positions_);
  rows("/segment/orientation", orientations_);
  positions_.clear();
  orientations_.clear();
  for (const Frame& clamp : sample.clamps) {
    put(positions_, clamp.position);
    put(orientations_, clamp.orientation);
  }
  rows("/clamp/position", positions_);
  rows("/clamp/orientation", orientations_);
  if (!sample.travel.empty()) rows("/clamp/travel", sample.travel);
  if (description_.joints > 0) add_robot(sample.pose);
  file_.append("/program/step", std::span<const std::int32_t>(std::array<std::int32_t, 1>{sample.step}));
  file_.append("/contact/count", std::span<const std::int32_t>(std::array<std::int32_t, 1>{sample.contacts}));
  rows("/contact/max_depth", std::array{sample.max_depth});
  add_touch(sample.touch);
  rows("/energy", std::array{sample.energy.kinetic, sample.energy.elastic, sample.energy.gravitational});
  rows("/tension", sample.tension);
  rows("/check/net_twist", std::array{sample.net_twist});
}

void MotionFile::finish(const RunSummary& summary, const std::function<int(double)>& step_at) {
  file_.attribute("repeats", summary.repeats);
  if (summary.returns) file_.attribute("repeat_distance", summary.distance);
  if (summary.time_step > 0) file_.attribute("time_step", summary.time_step);
  if (std::isfinite(summary.curvature_error)) file_.attribute("curvature_error", summary.curvature_error);
  add_extremes("/check/curvature", summary.curvature);
  add_extremes("/check/twist", summary.twist);
  add_extremes("/check/tension", summary.tension);
  add_checks(summary.checks, step_at);
  add_touch_of_motion();
  add_rubbed(summary);
}

void MotionFile::add_extremes(const std::string& group, const std::vector<Extreme>& extremes) {
  std::vector<double> values, times;
  for (const Extreme& extreme : extremes) {
    values.push_back(extreme.value);
    times.push_back(extreme.time);
  }
  file_.append(group, std::span<const double>(values));
  file_.append(group + "_time", std::span<const double>(times));
}

void MotionFile::add_checks(const std::vector<Check>& checks, const std::function<int(double)>& step_at) {
  std::vector<std::string> names, units;
  std::vector<double> values, limits, times, positions;
  std::vector<std::int32_t> warnings, steps, dresspacks;
  for (const Check& check : checks) {
    names.push_back(check.name);
    units.push_back(check.unit);
    values.push_back(check.value);
    limits.push_back(check.limit);
    warnings.push_back(check.warning);
    times.push_back(check.time);
    steps.push_back(step_at(check.time));
    positions.push_back(check.position);
    dresspacks.push_back(check.dresspack);
  }
  file_.append("/check/name", std::span<const std::string>(names));
  file_.append("/check/unit", std::span<const std::string>(units));
  file_.append("/check/value", std::span<const double>(values));
  file_.append("/check/limit", std::span<const double>(limits));
  file_.append("/check/warning", std::span<const std::int32_t>(warnings));
  file_.append("/check/time", std::span<const double>(times));
  file_.append("/check/step", std::span<const std::int32_t>(steps));
  file_.append("/check/position", std::span<const double>(positions));
  file_.append("/check/dresspack", std::span<const std::int32_t>(dresspacks));
}

void MotionFile::add_touch(const Touch& touch) {
  file_.append("/contact/force", std::span<const double>(touch.sample_force()));
  file_.append("/contact/rubbing", std::span<const double>(touch.sample_work()));
  file_.append("/contact/obstacle", std::span<const std::int32_t>(touch.sample_obstacle()));
  obstacles_ = touch.obstacles(), work_ = touch.work(), largest_force_ = touch.largest_force();
}

void MotionFile::add_touch_of_motion() {
  file_.set_axis("obstacle", obstacles_.size());
  file_.append("/contact/work", std::span<const double>(work_));
  file_.append("/contact/largest_force", std::span<const double>(largest_force_));
  file_.dataset_attribute("/contact/work", "obstacles", pipeline::joined(obstacles_, ","));
}

void MotionFile::add_rubbed(const RunSummary& summary) {
  if (summary.obstacles.empty()) return;  // a prescribed deformation has no contact
  std::vector<std::int32_t> dresspack;
  std::vector<double> place, work, time;
  std::vector<std::string> obstacle;
  for (const RubbedPatch& patch : summary.rubbed) {
    dresspack.push_back(patch.dresspack);
    place.insert(place.end(), {patch.position, patch.length, patch.angle, patch.width});
    obstacle.push_back(summary.obstacles[patch.obstacle]);
    work.push_back(patch.work);
    time.push_back(patch.time);
  }
  file_.append("/rubbing/dresspack", std::span<const std::int32_t>(dresspack));
  file_.append("/rubbing/place", std::span<const double>(place));
  file_.append("/rubbing/obstacle", std::span<const std::string>(obstacle));
  file_.append("/rubbing/work", std::span<const double>(work));
  file_.append("/rubbing/time", std::span<const double>(time));
}

void MotionFile::add_robot(const Pose& pose) {
  poses_.clear();
  for (const Frame& link : pose.links) {
    put(poses_, link.position);
    put(poses_, link.orientation);
  }
  file_.append("/robot/joint_position",
               std::span<const double>(pose.joints.data(), static_cast<size_t>(description_.joints)));
  file_.append("/robot/link_pose", std::span<const double>(poses_));
  if (links_named_) return;
  file_.dataset_attribute("/robot/link_pose", "links", pipeline::joined(description_.link_names, ","));
  links_named_ = true;
}

}  // namespace dresslife::sim
