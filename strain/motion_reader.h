// Reads the motion block by block and computes the deformation of every segment.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pipeline/cable/cable_pull.h"
#include "pipeline/files/motion_layout.h"
#include "pipeline/job/job.h"
#include "strain/cable_paths.h"
#include "strain/deformation.h"

namespace dresslife::strain {

constexpr std::size_t motion_block_samples = 512;  // rows per read

/// Consecutive samples of all segments.
struct MotionBlock {
  std::size_t first;                         ///< number of its first sample
  std::span<const Deformation> deformation;  ///< (sample, segment) deformation at the segment's centre
  std::span<const Deformation>
      at_wires;                  ///< (sample, segment) deformation where the segment's wires are evaluated (W39)
  std::span<const double> pull;  ///< (sample, segment, 2), see SpanBlock; empty: not wanted
};

class MotionReader {
 public:
  /// group: group of motion.h5 with the poses of segments and clamps; empty: the job's own motion. file: must outlive the reader.
  MotionReader(const pipeline::FileReader& file, const pipeline::Job& job, std::string group = "");

  std::size_t samples() const { return samples_; }
  double step() const { return step_; }                            ///< time between samples [s]
  const std::vector<double>& lengths() const { return lengths_; }  ///< (segment) [m]
  const std::vector<pipeline::MotionSpan>& spans() const { return spans_; }
  std::vector<double> lengths_of(const pipeline::MotionSpan& span) const;
  /// Returns the factor on the bending stiffness of the hose in this motion.
  double stiffness_factor() const { return stiffness_factor_; }
  KnownEnds known_ends(std::size_t span) const { return gauges_[span].knows_ends(); }
  /// Returns whether no clamp holds the tool end of span k.
  bool ends_freely(const pipeline::Job& job, std::size_t k) const;

  /// Calls put() for one block after the other, over all samples or over [from, end). with_pull: fills MotionBlock::pull.
  void run(bool with_pull, const std::function<void(const MotionBlock&)>& put) { run(with_pull, put, 0, samples_); }
  void run(bool with_pull, const std::function<void(const MotionBlock&)>& put, std::size_t from, std::size_t end);

 private:
  void measure_pull(std::size_t first, std::size_t count, const std::vector<double>& orientation,
                    std::vector<double>& pull) const;
  std::optional<Eigen::Vector3d> free_end(const pipeline::Job& job, std::size_t k) const;

  const pipeline::FileReader& file_;
  std::string group_;
  double stiffness_factor_;
  std::vector<double> lengths_;
  std::size_t samples_;
  double step_;
  Eigen::Vector3d gravity_;
  std::vector<pipeline::MotionSpan> spans_;
  std::vector<DeformationGauge> gauges_;               // (span)
  std::vector<pipeline::TwistShortening> shortening_;  // (span) of a simulated cable without pull (W44)
  // (span) E A of a simulated cable [N]; 0: the elongation is that of the poses. A step of h leaves gaps of (omega h)^2/2 between
  // segments that turn with omega: 7e-4 at 7 rad/s and 5 ms, as much as a pull of 190 N on a cable of 12 x 0.25 mm2. Motions at
  // other stiffnesses have no tension in the file. They use that of the job's own motion, by weight and inertia: 1 N there.
  std::vector<double> pulled_stiffness_;
};

}  // namespace dresslife::strain
