#include "sim/run/step_choice.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dresslife::sim {
namespace {

constexpr double window_seconds = 3, window_share = 1.0 / 30;
constexpr double least_step = 2e-4,
                 most_step = 1e-2;  // larger steps were not tried (1 to 10 ms were)
constexpr double usual_step = 5e-3;

void append_curvatures(const Rod& rod, const RodState& state, std::vector<double>& values) {
  for (int j = 0; j < rod.links(); ++j) values.push_back(rod.curvature(rod.turn(state, j), j));
}

/// Returns, (step), the squared acceleration of all ends, by second differences.
std::vector<double> liveliness(const ClampPath& path, double h, int steps) {
  std::vector<double> squares(steps + 1);
  ClampFrames before = path.at(0).clamps, now = before;
  for (int k = 0; k <= steps; ++k) {
    const ClampFrames next = path.at((k + 1) * h).clamps;
    for (int e = 0; e < next.ends(); ++e)
      squares[k] += (next.end(e).position - 2 * now.end(e).position + before.end(e).position).squaredNorm();
    before = now;
    now = next;
  }
  return squares;
}

double step_that_fits(double h, double rate) { return 1 / (rate * std::ceil(1 / (rate * h) - 1e-9)); }

}  // namespace

RodState with_half_step(const RodState& state, const RodState& before) {
  RodState start = state;
  const auto later = [](Vector3& v, const Vector3& v_before) { v += (v - v_before) / 4; };
  for (size_t i = 0; i < state.velocity.size(); ++i) {
    later(start.velocity[i], before.velocity[i]);
    later(start.angular_velocity[i], before.angular_velocity[i]);
  }
  for (size_t k = 0; k < state.travel.size(); ++k)
    start.travel[k].speed += (state.travel[k].speed - before.travel[k].speed) / 4;
  for (size_t end = 0; end < state.clamp_velocity.size(); ++end) {
    later(start.clamp_velocity[end], before.clamp_velocity[end]);
    later(start.clamp_angular_velocity[end], before.clamp_angular_velocity[end]);
  }
  return start;
}

std::vector<StepWindow> lively_windows(const ClampPath& path, double h, int steps) {
  const int length = std::min(steps, static_cast<int>(std::lround(window_seconds / h)));
  if (length < 3) return {};  // a window begins at step 1 at the earliest, so that fewer have no second half
  const int wanted = std::max(1, static_cast<int>(window_share * steps / length));
  const std::vector<double> squares = liveliness(path, h, steps);
  std::vector<std::pair<double, int>> candidates;  // (sum over the window, its first step)
  for (int begin = 0; begin + length <= steps; begin += std::max(1, length / 4))
    candidates.emplace_back(std::accumulate(squares.begin() + begin, squares.begin() + begin + length, 0.0), begin);
  std::ranges::stable_sort(candidates, [](auto& a, auto& b) { return a.first > b.first; });
  std::vector<StepWindow> windows;
  for (const auto& [sum, begin] : candidates) {
    const bool apart =
        std::ranges::all_of(windows, [&, b = begin](const StepWindow& w) { return std::abs(w.begin - b) >= length; });
    if (apart && static_cast<int>(windows.size()) < wanted)
      windows.push_back({begin, std::max(begin + length / 2, 2), begin + length});
  }
  return windows;
}

StepError::StepError(const Rod& rod, const ClampPath& path, MakeWorld make_world, double h, int steps)
    : rod_(rod),
      path_(path),
      make_world_(std::move(make_world)),
      h_(h),
      windows_(lively_windows(path, h, steps)),
      records_(windows_.size()) {}

void StepError::see(int k, const RodState& state) {
  for (size_t w = 0; w < windows_.size(); ++w) {
    const StepWindow& window = windows_[w];
    if (k == std::max(window.begin, 1)) {
      records_[w].begin = before_.position.empty() ? state : with_half_step(state, before_);
      records_[w].curvature.clear();
    }
    if (k >= window.compare && k <= window.end) append_curvatures(rod_, state, records_[w].curvature);
  }
  const bool begins_next =
      std::ranges::any_of(windows_, [k](const StepWindow& window) { return k + 1 == std::max(window.begin, 1); });
  if (begins_next) before_ = state;
}

void StepError::add(const StepWindow& window, const Record& record, double& difference, double& size) const {
  const int begin = std::max(window.begin, 1);
  const std::unique_ptr<World> world = make_world_(record.begin, path_.at(begin * h_), h_ / 2);
  size_t at = 0;
  std::vector<double> curvature;
  for (int half = 2 * begin + 1; half <= 2 * window.end; ++half) {
    const Pose pose = path_.at(half * h_ / 2);
    if (!world->advance(pose.clamps, pose.links).finite) {
      difference = NAN;
      size = 1;
      return;
    }
    if (half % 2 == 1 || half / 2 < window.compare) continue;
    curvature.clear();
    append_curvatures(rod_, world->state(), curvature);
    for (const double exact : curvature) {
      const double off = record.curvature[at++] - exact;
      difference += off * off;
      size += exact * exact;
    }
  }
}

double StepError::estimate() const {
  double difference = 0, size = 0;
  for (size_t w = 0; w < windows_.size(); ++w) add(windows_[w], records_[w], difference, size);
  return size > 0 ? 4.0 / 3 * std::sqrt(difference / size) : 0;  // (R10)
}

double chosen_step(double h, double error, double wanted_error, double rate) {
  if (std::isnan(error)) return step_that_fits(least_step, rate);
  const double wanted = error > 0 ? h * std::sqrt(wanted_error / error) : most_step;  // (R11)
  return step_that_fits(std::clamp(wanted, least_step, most_step), rate);
}

double first_step(double rate) { return step_that_fits(usual_step, rate); }

}  // namespace dresslife::sim
