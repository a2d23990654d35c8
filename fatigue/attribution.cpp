#include "fatigue/attribution.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cassert>

#include "pipeline/job/setup.h"

namespace dresslife::fatigue {
namespace {

constexpr double standing = 1e-6;  // [rad] a joint with a smaller range stands still
constexpr double ridge = 1e-6;     // of the mean variance of the terms: decides only what the motion leaves open

/// Writes q_1 .. q_n, then q_i q_k for k >= i.
void fill_terms(const Eigen::VectorXd& q, Eigen::VectorXd& terms) {
  const Eigen::Index n = q.size();
  terms.head(n) = q;
  for (Eigen::Index i = 0, at = n; i < n; ++i)
    for (Eigen::Index k = i; k < n; ++k) terms[at++] = q[i] * q[k];
}

std::size_t link_index(const pipeline::Robot& robot, const std::string& name) {
  const auto found = std::ranges::find(robot.links, name, &pipeline::Link::name);
  return found - robot.links.begin();
}

}  // namespace

std::vector<bool> joints_between_clamps(const pipeline::Setup& setup, std::size_t dresspack) {
  const pipeline::Routing& routing = setup.dresspacks[dresspack].routing;
  const std::vector<pipeline::Joint>& joints = setup.robot.joints;
  std::vector<std::size_t> axis(joints.size());  // (joint) the driven axis that moves it
  for (std::size_t k = 0, next = 0; k < joints.size(); ++k)
    if (joints[k].follows.empty()) axis[k] = next++;
  for (std::size_t k = 0; k < joints.size(); ++k)
    if (!joints[k].follows.empty())
      axis[k] = axis[std::ranges::find(joints, joints[k].follows, &pipeline::Joint::name) - joints.begin()];
  std::vector<bool> between(setup.robot.axes(), false);
  if (!routing.base_clamp || !routing.tool_clamp) return between;
  const std::size_t one = link_index(setup.robot, routing.base_clamp->link),
                    other = link_index(setup.robot, routing.tool_clamp->link);
  const std::size_t last = std::min(std::max(one, other), joints.size());
  for (std::size_t joint = std::min(one, other); joint < last; ++joint)
    between[axis[joint]] = true;  // joint k moves link k + 1
  return between;
}

StrainOfJoints::StrainOfJoints(std::span<const double> position, std::span<const Reversal> known,
                               const std::vector<bool>& between)
    : position_(position), middle_(between.size()), scale_(between.size()) {
  const std::size_t joints = between.size(), samples = joints > 0 ? position.size() / joints : 0;
  assert(!known.empty() && position.size() == samples * joints);
  for (std::size_t j = 0; j < joints; ++j) {
    double low = position[j], high = low;
    for (std::size_t t = 0; t < samples; ++t) {
      low = std::min(low, position[t * joints + j]);
      high = std::max(high, position[t * joints + j]);
    }
    middle_[j] = (low + high) / 2;
    scale_[j] = high - low > standing ? (high - low) / 2 : 1;
    if (between[j] && high - low > standing) active_.push_back(j);
  }
  const auto n = static_cast<Eigen::Index>(active_.size()), terms = n + n * (n + 1) / 2;
  linear_ = Eigen::VectorXd::Zero(n);
  quadratic_ = Eigen::MatrixXd::Zero(n, n);
  if (n == 0) return;

  // Normal equations of the deviations from the means.
  Eigen::VectorXd term(terms), mean = Eigen::VectorXd::Zero(terms), right = mean;
  Eigen::MatrixXd left = Eigen::MatrixXd::Zero(terms, terms);
  double mean_strain = 0;
  for (const Reversal& at : known) {
    fill_terms(scaled(at.sample), term);
    mean += term;
    mean_strain += at.strain;
  }
  mean /= double(known.size());
  mean_strain /= double(known.size());
  double variance = 0;
  for (const Reversal& at : known) {
    fill_terms(scaled(at.sample), term);
    term -= mean;
    left.selfadjointView<Eigen::Lower>().rankUpdate(term);
    right += term * (at.strain - mean_strain);
    variance += (at.strain - mean_strain) * (at.strain - mean_strain);
  }
  left.diagonal().array() += ridge * left.diagonal().mean();
  const Eigen::VectorXd fit = left.selfadjointView<Eigen::Lower>().ldlt().solve(right);
  linear_ = fit.head(n);
  for (Eigen::Index i = 0, at = n; i < n; ++i)
    for (Eigen::Index k = i; k < n; ++k, ++at) {
      quadratic_(i, k) += fit[at] / 2;
      quadratic_(k, i) += fit[at] / 2;
    }

  if (!(variance > 0)) return;
  double left_over = 0;
  for (const Reversal& at : known) {
    fill_terms(scaled(at.sample), term);
    const double away = at.strain - mean_strain - fit.dot(term - mean);
    left_over += away * away;
  }
  explained_ = std::max(0.0, 1 - left_over / variance);
}

Eigen::VectorXd StrainOfJoints::scaled(std::size_t sample) const {
  Eigen::VectorXd q(static_cast<Eigen::Index>(active_.size()));
  for (std::size_t i = 0; i < active_.size(); ++i) {
    const std::size_t j = active_[i];
    q[static_cast<Eigen::Index>(i)] = (position_[sample * joints() + j] - middle_[j]) / scale_[j];
  }
  return q;
}

std::vector<double> StrainOfJoints::change(std::size_t from, std::size_t to) const {
  const Eigen::VectorXd begin = scaled(from), end = scaled(to);
  const Eigen::VectorXd slope = linear_ + quadratic_ * (begin + end);  // f' = b + 2 Q q at the mean q
  std::vector<double> changes(joints(), 0.0);
  for (std::size_t i = 0; i < active_.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    changes[active_[i]] = slope[at] * (end[at] - begin[at]);
  }
  return changes;
}

JointDamage damage_by_joint(std::span<const DamagingCycle> cycles, const StrainOfJoints& surface,
                            std::span<const std::int32_t> step, std::size_t lines) {
  const std::size_t causes = surface.joints() + 1;
  JointDamage result{std::vector<double>(causes, 0.0), std::vector<double>(lines * causes, 0.0)};
  for (const DamagingCycle& d : cycles) {
    const double range = d.cycle.end.strain - d.cycle.begin.strain;
    if (d.damage == 0 || range == 0) continue;
    const std::vector<double> changes = surface.change(d.cycle.begin.sample, d.cycle.end.sample);
    const std::int32_t line = step[d.cycle.end.sample];
    double left = d.damage;
    const auto put = [&](std::size_t cause, double damage) {
      result.damage[cause] += damage;
      if (line >= 0) result.by_line[static_cast<std::size_t>(line) * causes + cause] += damage;
    };
    for (std::size_t j = 0; j < changes.size(); ++j) {
      const double share = d.damage * (changes[j] / range);
      put(j, share);
      left -= share;
    }
    put(causes - 1, left);
  }
  return result;
}

std::vector<double> damage_by_clamp(std::span<const double> segment_damage, std::span<const double> length,
                                    std::span<const double> clamp_at) {
  assert(!clamp_at.empty() && std::ranges::is_sorted(clamp_at));
  std::vector<double> damage(clamp_at.size(), 0.0);
  double start = 0;
  std::size_t nearest = 0;
  for (std::size_t k = 0; k < length.size(); ++k) {
    const double centre = start + length[k] / 2;
    while (nearest + 1 < clamp_at.size() && centre >= (clamp_at[nearest] + clamp_at[nearest + 1]) / 2) ++nearest;
    damage[nearest] += segment_damage[k];
    start += length[k];
  }
  return damage;
}

std::vector<ClampPlace> clamps_of(const pipeline::Routing& routing, double length) {
  std::vector<ClampPlace> clamps{{"base clamp", 0}};
  for (const pipeline::IntermediateClamp& between : routing.clamps)
    clamps.push_back({fmt::format("clamp {} on {}", clamps.size(), between.clamp.link), between.at_length});
  if (is_clamped(routing.tool_end)) clamps.push_back({"tool clamp", length});
  return clamps;
}

}  // namespace dresslife::fatigue
