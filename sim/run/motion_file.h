// Writes the samples of a run to motion.h5 (the format's table is in pipeline/files/formats.cpp).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pipeline/files/files.h"
#include "sim/run/simulate.h"

namespace dresslife::sim {

/// Adds the numbers of a vector (x, y, z) or an orientation (w, x, y, z) to a row.
void put(std::vector<double>& row, const Vector3& v);
void put(std::vector<double>& row, const Quaternion& q);

class MotionFile {
 public:
  /// Writes the data that are valid for all samples. Precondition: the file outlives this object; the caller commits it.
  MotionFile(pipeline::FileWriter& file, const RunDescription& description);

  void add(const Sample& sample);
  /// Writes checks and the summary of the run. Precondition: all samples were added. step_at: returns the program line at a time
  /// [s].
  void finish(const RunSummary& summary, const std::function<int(double)>& step_at);

 private:
  void add_robot(const Pose& pose);
  void add_touch(const Touch& touch);
  void add_touch_of_motion();
  void add_rubbed(const RunSummary& summary);
  void add_extremes(const std::string& group, const std::vector<Extreme>& extremes);
  void add_checks(const std::vector<Check>& checks, const std::function<int(double)>& step_at);

  pipeline::FileWriter& file_;
  const RunDescription description_;
  bool links_named_ = false;
  std::vector<std::string> obstacles_;
  std::vector<double> work_, largest_force_;  // (segment, obstacle) values so far
  std::vector<double> positions_, orientations_, poses_;
};

}  // namespace dresslife::sim
