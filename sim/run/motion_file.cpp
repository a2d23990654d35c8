#include "sim/run/motion_file.h"

#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"

#include <array>
#include <cmath>

namespace dresslife::sim {

using pipeline::mapped;

void put(std::vector<double>& row, const Vector3& v) { row.insert(row.end(), {v.x(), v.y(), v.z()}); }
void put(std::vector<double>& row, const Quaternion& q) { row.insert(row.end(), {q.w(), q.x(), q.y(), q.z()}); }

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
  file_.append("/segment/length", description.segment_length);
  file_.append("/segment/dresspack", description.dresspack);
  file_.append("/dresspack/name", description.dresspacks);
  file_.append("/dresspack/bending_stiffness", description.bending_stiffness);
  file_.append("/dresspack/torsional_stiffness", description.torsional_stiffness);
  file_.append("/dresspack/axial_stiffness", description.axial_stiffness);
  if (description.clamp_segment.size() > 2) file_.append("/clamp/segment", description.clamp_segment);
  file_.append("/program/text", description.step_texts);
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
  file_.append("/program/step", std::array{sample.step});
  file_.append("/contact/count", std::array{sample.contacts});
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
  file_.append(group, mapped(extremes, &Extreme::value));
  file_.append(group + "_time", mapped(extremes, &Extreme::time));
}

void MotionFile::add_checks(const std::vector<Check>& checks, const std::function<int(double)>& step_at) {
  file_.append("/check/name", mapped(checks, &Check::name));
  file_.append("/check/unit", mapped(checks, &Check::unit));
  file_.append("/check/value", mapped(checks, &Check::value));
  file_.append("/check/limit", mapped(checks, &Check::limit));
  file_.append("/check/warning", mapped(checks, [](const Check& check) { return int{check.warning}; }));
  file_.append("/check/time", mapped(checks, &Check::time));
  file_.append("/check/step", mapped(checks, [&](const Check& check) { return step_at(check.time); }));
  file_.append("/check/position", mapped(checks, &Check::position));
  file_.append("/check/dresspack", mapped(checks, &Check::dresspack));
}

void MotionFile::add_touch(const Touch& touch) {
  file_.append("/contact/force", touch.sample_force());
  file_.append("/contact/rubbing", touch.sample_work());
  file_.append("/contact/obstacle", touch.sample_obstacle());
  obstacles_ = touch.obstacles(), work_ = touch.work(), largest_force_ = touch.largest_force();
}

void MotionFile::add_touch_of_motion() {
  file_.set_axis("obstacle", obstacles_.size());
  file_.append("/contact/work", work_);
  file_.append("/contact/largest_force", largest_force_);
  file_.dataset_attribute("/contact/work", "obstacles", pipeline::joined(obstacles_, ","));
}

void MotionFile::add_rubbed(const RunSummary& summary) {
  if (summary.obstacles.empty()) return;  // a prescribed deformation has no contact
  const std::vector<RubbedPatch>& rubbed = summary.rubbed;
  std::vector<double> place;
  for (const RubbedPatch& patch : rubbed)
    place.insert(place.end(), {patch.position, patch.length, patch.angle, patch.width});
  file_.append("/rubbing/dresspack", mapped(rubbed, &RubbedPatch::dresspack));
  file_.append("/rubbing/place", place);
  file_.append("/rubbing/obstacle",
               mapped(rubbed, [&](const RubbedPatch& patch) { return summary.obstacles[patch.obstacle]; }));
  file_.append("/rubbing/work", mapped(rubbed, &RubbedPatch::work));
  file_.append("/rubbing/time", mapped(rubbed, &RubbedPatch::time));
}

void MotionFile::add_robot(const Pose& pose) {
  poses_.clear();
  for (const Frame& link : pose.links) {
    put(poses_, link.position);
    put(poses_, link.orientation);
  }
  file_.append("/robot/joint_position",
               std::span<const double>(pose.joints.data(), static_cast<size_t>(description_.joints)));
  file_.append("/robot/link_pose", poses_);
  if (links_named_) return;
  file_.dataset_attribute("/robot/link_pose", "links", pipeline::joined(description_.link_names, ","));
  links_named_ = true;
}

}  // namespace dresslife::sim
