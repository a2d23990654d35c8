#include "sim/motion_file.h"

#include <fmt/ranges.h>

#include <array>

namespace dresslife::sim {
namespace {

void put(std::vector<double>& row, const Vector3& v) { row.insert(row.end(), {v.x(), v.y(), v.z()}); }
void put(std::vector<double>& row, const Quaternion& q) {
  row.insert(row.end(), {q.w(), q.x(), q.y(), q.z()});
}

}  // namespace

MotionFile::MotionFile(pipeline::FileWriter& file, const RunDescription& description)
    : file_(file), description_(description) {
  file_.set_axis("segment", description.segment_length.size());
  file_.set_axis("clamp", 2);
  if (description.joints > 0) {
    file_.set_axis("joint", description.joints);
    file_.set_axis("link", description.link_names.size());
  }
  file_.append("/segment/length", std::span<const double>(description.segment_length));
  file_.append("/program/text", std::span<const std::string>(description.step_texts));
}

void MotionFile::add(const Sample& sample) {
  const auto rows = [&](const char* dataset, std::span<const double> values) {
    file_.append(dataset, values);
  };
  positions_.clear();
  orientations_.clear();
  for (const Vector3& position : sample.state.position) put(positions_, position);
  for (const Quaternion& orientation : sample.state.orientation) put(orientations_, orientation);
  rows("/time", std::array{sample.time});
  rows("/segment/position", positions_);
  rows("/segment/orientation", orientations_);
  positions_.clear();
  orientations_.clear();
  for (const Frame& clamp : {sample.pose.clamps.base, sample.pose.clamps.tool}) {
    put(positions_, clamp.position);
    put(orientations_, clamp.orientation);
  }
  rows("/clamp/position", positions_);
  rows("/clamp/orientation", orientations_);
  if (description_.joints > 0) add_robot(sample.pose);
  file_.append("/program/step", std::span<const std::int32_t>(std::array<std::int32_t, 1>{sample.step}));
  file_.append("/contact/count", std::span<const std::int32_t>(std::array<std::int32_t, 1>{sample.contacts}));
  rows("/contact/max_depth", std::array{sample.max_depth});
  rows("/energy", std::array{sample.energy.kinetic, sample.energy.elastic, sample.energy.gravitational});
  rows("/tension", sample.tension);
}

void MotionFile::add_robot(const Pose& pose) {
  poses_.clear();
  for (const Frame& link : pose.links) {
    put(poses_, link.position);
    put(poses_, link.orientation);
  }
  file_.append("/robot/joint_position",
               std::span<const double>(pose.joints.data(), static_cast<size_t>(pose.joints.size())));
  file_.append("/robot/link_pose", std::span<const double>(poses_));
  if (links_named_) return;
  file_.dataset_attribute("/robot/link_pose", "links",
                          fmt::format("{}", fmt::join(description_.link_names, ",")));
  links_named_ = true;
}

}  // namespace dresslife::sim
