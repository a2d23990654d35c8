#include "strain/motion_reader.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "pipeline/job/parts_room.h"

namespace dresslife::strain {
namespace {

double step_of(const pipeline::FileReader& file, const pipeline::Job& job) {
  std::vector<double> two;
  if (file.rows("/time") < 2) return 1 / job.simulation.sample_rate;
  file.read_rows("/time", 0, 2, two);
  return two[1] - two[0];
}

/// Returns the factor on the bending stiffness of the hose in a group of motion.h5.
double factor_in(const pipeline::FileReader& file, const pipeline::Job& job, const std::string& group) {
  const double own = job.simulation.stiffness_factor;
  if (group.empty()) return own;
  const auto& stiffness = pipeline::uncertain_parameters()[index_of(pipeline::Uncertain::hose_stiffness)];
  return own * stiffness.value(file.number_attribute(group.substr(1) + "_z"));
}

}  // namespace

MotionReader::MotionReader(const pipeline::FileReader& file, const pipeline::Job& job, std::string group)
    : file_(file),
      group_(std::move(group)),
      stiffness_factor_(factor_in(file, job, group_)),
      lengths_(file.read<double>("/segment/length")),
      samples_(file.rows("/time")),
      step_(step_of(file, job)),
      gravity_(job.simulation.gravity) {
  if (lengths_.empty()) return;
  spans_ = pipeline::motion_spans(file);
  for (std::size_t k = 0; k < spans_.size(); ++k)
    gauges_.emplace_back(lengths_of(spans_[k]), job.strain.deformation, free_end(job, k));
  shortening_.resize(spans_.size());
  pulled_stiffness_.resize(spans_.size());
  if (job.motion.is_prescribed()) return;
  for (std::size_t k = 0; k < spans_.size(); ++k) {
    const auto of = static_cast<std::size_t>(spans_[k].dresspack);
    if (of >= job.dresspacks.size() || !pipeline::is_single_cable(job.dresspacks[of].dresspack)) continue;
    shortening_[k] = pipeline::twist_shortening(job.dresspacks[of].dresspack);
    pulled_stiffness_[k] = job.dresspacks[of].dresspack.axial_stiffness;
  }
}

std::vector<double> MotionReader::lengths_of(const pipeline::MotionSpan& span) const {
  return {lengths_.begin() + span.first_segment, lengths_.begin() + span.first_segment + span.segments};
}

bool MotionReader::ends_freely(const pipeline::Job& job, std::size_t k) const {
  const auto dresspack = static_cast<std::size_t>(spans_[k].dresspack);
  const bool last = k + 1 == spans_.size() || spans_[k + 1].dresspack != spans_[k].dresspack;
  if (dresspack >= job.dresspacks.size()) return false;  // check() reports it
  return last && !is_clamped(job.dresspacks[dresspack].routing.tool_end);
}

void MotionReader::run(bool with_pull, const std::function<void(const MotionBlock&)>& put, std::size_t from,
                       std::size_t end) {
  const std::size_t segments = lengths_.size();
  const std::size_t clamps = file_.row_size("/clamp/position") / 3;
  std::vector<double> position, orientation, clamp_position, clamp_orientation;
  std::vector<Deformation> deformation, at_wires;
  std::vector<double> pull, tension;
  const bool any_pulled = std::ranges::any_of(pulled_stiffness_, [](double of) { return of > 0; });
  for (std::size_t first = from; first < end; first += motion_block_samples) {
    const std::size_t count = std::min(motion_block_samples, end - first);
    file_.read_rows(group_ + "/segment/position", first, count, position);
    file_.read_rows(group_ + "/segment/orientation", first, count, orientation);
    file_.read_rows(group_ + "/clamp/position", first, count, clamp_position);
    file_.read_rows(group_ + "/clamp/orientation", first, count, clamp_orientation);
    if (any_pulled) file_.read_rows("/tension", first, count, tension);
    deformation.resize(count * segments);
    at_wires.resize(count * segments);
    for (std::size_t t = 0; t < count; ++t) {
      auto row = [&](const std::vector<double>& of, std::size_t size) { return std::span(of).subspan(t * size, size); };
      for (std::size_t k = 0; k < spans_.size(); ++k) {
        const auto& [dresspack, begin, size, base, tool] = spans_[k];
        const std::size_t held = tool - base + 1;  // includes the first and the last clamp of the span
        const auto own = [&, first = t * segments + begin, count = size](std::vector<Deformation>& of) {
          return std::span(of).subspan(first, count);
        };
        gauges_[k].measure({row(position, 3 * segments).subspan(3 * begin, 3 * size),
                            row(orientation, 4 * segments).subspan(4 * begin, 4 * size),
                            row(clamp_position, 3 * clamps).subspan(3 * base, 3 * held),
                            row(clamp_orientation, 4 * clamps).subspan(4 * base, 4 * held)},
                           own(deformation));
        if (pulled_stiffness_[k] > 0)
          for (std::size_t i = 0; Deformation & of : own(deformation))
            of.elongation = tension[t * segments + begin + i++] / pulled_stiffness_[k] - shortening_[k].at(of.twist);
        std::ranges::copy(own(deformation), own(at_wires).begin());
        gauges_[k].move_to_ends(own(at_wires));
      }
    }
    if (with_pull) measure_pull(first, count, orientation, pull);
    put({first, deformation, at_wires, pull});
  }
}

/// Computes gravity minus acceleration in each segment's frame. The first and the last sample get the acceleration of their
/// neighbour.
void MotionReader::measure_pull(std::size_t first, std::size_t count, const std::vector<double>& orientation,
                                std::vector<double>& pull) const {
  const std::size_t segments = lengths_.size(), row = 3 * segments;
  const std::size_t before = first > 0 ? 1 : 0, after = first + count < samples_ ? 1 : 0;
  std::vector<double> position;
  file_.read_rows(group_ + "/segment/position", first - before, count + before + after, position);
  const std::size_t rows = position.size() / row;
  pull.assign(count * segments * 2, 0.0);
  for (std::size_t t = 0; t < count; ++t) {
    const std::size_t middle = rows < 3 ? 0 : std::clamp<std::size_t>(t + before, 1, rows - 2);
    for (std::size_t i = 0; i < segments; ++i) {
      Eigen::Vector3d force = gravity_;
      for (std::size_t d = 0; rows >= 3 && d < 3; ++d) {
        const double* const at = position.data() + middle * row + 3 * i + d;
        force[static_cast<Eigen::Index>(d)] -= (at[row] - 2 * at[0] + *(at - row)) / (step_ * step_);
      }
      const double* const q = orientation.data() + (t * segments + i) * 4;
      const Eigen::Vector3d own = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).conjugate() * force;
      pull[(t * segments + i) * 2] = own.x();
      pull[(t * segments + i) * 2 + 1] = own.y();
    }
  }
}

/// Returns the rates of the unloaded dresspack if the tool end of span k is free; else std::nullopt.
std::optional<Eigen::Vector3d> MotionReader::free_end(const pipeline::Job& job, std::size_t k) const {
  if (!ends_freely(job, k)) return {};
  return Eigen::Vector3d(0, job.dresspacks[spans_[k].dresspack].dresspack.rest_curvature, 0);
}

}  // namespace dresslife::strain
