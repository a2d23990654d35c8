#include "sim/recording/cycles.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>

namespace dresslife::sim {
namespace {

using Eigen::VectorXf;

constexpr double sample = 0.05;                                             // [s]
constexpr double longest = 3600;                                            // [s] longest cycle
constexpr double slowest_step = 0.4, fastest_step = 1.8, free_samples = 3;  // (L1)
constexpr std::size_t at_the_end =
    4;                               // number of samples of the last pose that are added, so that a cycle may end there
constexpr float slow_step = 0.035f;  // [rad] (L2): 2 deg per sample are 40 deg/s
constexpr std::size_t tried_ends = 20,
                      tried_repeats = 50;  // limits, because the robot may pass the same pose in other motions

/// Samples of the motion in the course.
struct Samples {
  Eigen::MatrixXf values;      // (axis, sample) [rad]
  std::vector<double> begins;  // [s] of the course; for a sample after a standstill the end of the standstill
  std::size_t count() const { return begins.size(); }

  Samples(const Course& course, float finest) {
    std::vector<float> poses;
    VectorXf last = VectorXf::Constant(static_cast<long>(course.axes()), INFINITY);
    const auto take = [&](double time) {
      const VectorXf pose = course.at(time).cast<float>();
      if ((pose - last).lpNorm<Eigen::Infinity>() < finest) return;
      begins.push_back(time);
      poses.insert(poses.end(), pose.begin(), pose.end());
      last = pose;
    };
    double next = 0;  // motion time of the next sample
    const std::vector<double>& knots = course.knots();
    for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
      if (course.stands(k)) continue;
      for (; next < knots[k + 1] - knots[k]; next += sample) take(knots[k] + next);
      next -= knots[k + 1] - knots[k];
    }
    for (std::size_t k = 0; k < at_the_end; ++k) {
      begins.push_back(course.duration());
      const VectorXf pose = course.at(course.duration()).cast<float>();
      poses.insert(poses.end(), pose.begin(), pose.end());
    }
    values = Eigen::Map<const Eigen::MatrixXf>(poses.data(), static_cast<long>(course.axes()),
                                               static_cast<long>(begins.size()));
  }

  VectorXf at(double position) const {
    const long k = std::clamp<long>(static_cast<long>(position), 0, values.cols() - 2);
    const float u = static_cast<float>(position - static_cast<double>(k));
    return values.col(k) + u * (values.col(k + 1) - values.col(k));
  }
  double time(double position) const {
    const std::size_t k = std::min(static_cast<std::size_t>(position), count() - 2);
    return std::min(begins[k] + (position - static_cast<double>(k)) * sample, begins[k + 1]);
  }
  /// Returns the largest step of an axis next to a sample.
  float step(std::size_t k) const {
    const long at = static_cast<long>(k), last = values.cols() - 1;
    const VectorXf here = values.col(at);
    return std::max((values.col(std::min(at + 1, last)) - here).lpNorm<Eigen::Infinity>(),
                    (values.col(std::max(at - 1, 0l)) - here).lpNorm<Eigen::Infinity>());
  }
};

/// Finds samples by their pose, with cells over the two axes that move most.
class Places {
 public:
  Places(const Samples& samples, double bound) : samples_(samples), cell_(2 * bound) {
    const VectorXf range = samples.values.rowwise().maxCoeff() - samples.values.rowwise().minCoeff();
    std::vector<long> axes(static_cast<std::size_t>(range.size()));
    std::iota(axes.begin(), axes.end(), 0);
    std::ranges::stable_sort(axes, [&](long a, long b) { return range[a] > range[b]; });
    first_ = axes[0], second_ = axes[std::min<std::size_t>(1, axes.size() - 1)];
    for (std::size_t k = 0; k < samples.count(); ++k)
      sorted_.emplace_back(key(cell(first_, k), cell(second_, k)), static_cast<std::uint32_t>(k));
    std::ranges::sort(sorted_);
  }

  /// Returns later samples, from `from` on, at which the axes come nearest to those of sample k, in their order; one sample for
  /// each visit.
  std::vector<std::size_t> visits(std::size_t k, std::size_t from, std::size_t most) const {
    std::vector<std::uint32_t> near;
    for (int a = -1; a <= 1; ++a)
      for (int b = -1; b <= 1; ++b) {
        const std::uint64_t wanted = key(cell(first_, k) + a, cell(second_, k) + b);
        auto at = std::ranges::lower_bound(sorted_, std::pair(wanted, static_cast<std::uint32_t>(from)));
        for (; at != sorted_.end() && at->first == wanted && near.size() < 4096; ++at)
          if (distance(k, at->second) <= cell_) near.push_back(at->second);
      }
    std::ranges::sort(near);
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < near.size();) {
      std::size_t best = near[i], end = i + 1;
      for (; end < near.size() && near[end] <= near[end - 1] + 2; ++end)
        if (distance(k, near[end]) < distance(k, best)) best = near[end];
      found.push_back(best);
      if (found.size() == most) break;
      i = end;
    }
    return found;
  }

 private:
  std::int64_t cell(long axis, std::size_t k) const {
    return static_cast<std::int64_t>(std::floor(samples_.values(axis, static_cast<long>(k)) / cell_));
  }
  static std::uint64_t key(std::int64_t a, std::int64_t b) {
    return static_cast<std::uint64_t>(a + (1 << 20)) << 32 | static_cast<std::uint64_t>(b + (1 << 20));
  }
  float distance(std::size_t a, std::size_t b) const {
    return (samples_.values.col(static_cast<long>(a)) - samples_.values.col(static_cast<long>(b)))
        .lpNorm<Eigen::Infinity>();
  }

  const Samples& samples_;
  double cell_;
  long first_ = 0, second_ = 0;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> sorted_;
};

struct Match {
  double end;         // position of the end
  double difference;  // [rad]
};

/// A cycle, defined by its first occurrence.
struct Known {
  double begin;
  std::size_t length;  // samples
};

struct Part {
  std::size_t cycle;
  double begin, end, difference;
};

class Search {
 public:
  Search(const Samples& samples, const CycleOptions& options, const std::function<void(double)>& progress)
      : samples_(samples), options_(options), progress_(progress), places_(samples, options.bound) {}

  std::vector<Part> run() {
    pass(true);
    return pass(false);
  }
  std::size_t known() const { return known_.size(); }

 private:
  /// Returns the position nearest to a pose, around `expected` and between `low` and `high`.
  double nearest(const VectorXf& pose, double expected, double low, double high) const {
    const float pull = static_cast<float>(0.01 * options_.bound * options_.bound);
    double best = expected, least = INFINITY;
    for (long k = static_cast<long>(low); k <= static_cast<long>(high) && k + 1 < samples_.values.cols(); ++k) {
      const VectorXf step = samples_.values.col(k + 1) - samples_.values.col(k), off = pose - samples_.values.col(k);
      const float ahead = static_cast<float>(expected - static_cast<double>(k));
      float u = (step.dot(off) + pull * ahead) / (step.squaredNorm() + pull);
      u = std::clamp(u, std::max(0.f, static_cast<float>(low - static_cast<double>(k))),
                     std::min(1.f, static_cast<float>(high - static_cast<double>(k))));
      const float cost = (off - u * step).squaredNorm() + pull * (u - ahead) * (u - ahead);
      if (cost < least) least = cost, best = static_cast<double>(k) + u;
    }
    return best;
  }

  /// Returns the part (L1) that begins near the position `at`.
  std::optional<Match> match(const Known& cycle, double at) const {
    const double last = static_cast<double>(samples_.count() - 1);
    const double begin = nearest(samples_.at(cycle.begin), at, std::max(0.0, at - 1), std::min(last, at + 1));
    double position = begin, difference = 0;
    for (std::size_t k = 0; k <= cycle.length; ++k) {
      const VectorXf pose = samples_.at(cycle.begin + static_cast<double>(k));
      if (k > 0) {
        if (position + slowest_step > last) return {};
        position = nearest(pose, position + 1, position + slowest_step, std::min(last, position + fastest_step));
      }
      const double off = (samples_.at(position) - pose).lpNorm<Eigen::Infinity>();
      if (off > options_.bound ||
          std::abs(position - begin - static_cast<double>(k)) > options_.warp * static_cast<double>(k) + free_samples)
        return {};
      difference = std::max(difference, off);
    }
    return Match{position, difference};
  }

  /// Returns the cycle (L2) that begins at a sample. Precondition: no known cycle begins there.
  std::optional<Known> found_at(std::size_t k) const {
    const std::size_t least = static_cast<std::size_t>(options_.shortest / sample),
                      most = static_cast<std::size_t>(longest / sample);
    const std::vector<std::size_t> visits = places_.visits(k, k + least, tried_ends + tried_repeats);
    for (std::size_t i = 0; i < std::min(visits.size(), tried_ends); ++i) {
      if (visits[i] - k > most) break;
      const Known cycle{static_cast<double>(k), visits[i] - k};
      if (!closes(cycle)) continue;
      for (std::size_t j = i; j < visits.size(); ++j)
        if (match(cycle, static_cast<double>(visits[j]))) return cycle;
    }
    return {};
  }
  bool closes(const Known& cycle) const {
    return (samples_.at(cycle.begin + static_cast<double>(cycle.length)) - samples_.at(cycle.begin))
               .lpNorm<Eigen::Infinity>() <= options_.bound;
  }

  std::vector<Part> pass(bool is_first) {
    std::vector<Part> parts;
    for (double position = 0; position + 1 < static_cast<double>(samples_.count());) {
      const std::size_t k = static_cast<std::size_t>(std::lround(position));
      if (progress_ && (k & 1023) == 0)
        progress_((is_first ? 0 : 0.5) + 0.5 * static_cast<double>(k) / static_cast<double>(samples_.count()));
      if (samples_.step(k) <= slow_step) {
        std::optional<Part> best = repeated(position);
        if (!best && is_first)
          if (const auto found = found_at(k)) {
            known_.push_back(*found);
            best = Part{known_.size() - 1, found->begin, found->begin + static_cast<double>(found->length), 0};
          }
        if (best) {
          position = best->end;
          parts.push_back(*best);
          continue;
        }
      }
      position = static_cast<double>(k + 1);
    }
    return parts;
  }

  /// Returns the part that repeats the longest known cycle from a position.
  std::optional<Part> repeated(double position) const {
    std::optional<Part> best;
    const VectorXf here = samples_.at(position);
    for (std::size_t cycle = 0; cycle < known_.size(); ++cycle) {
      if ((here - samples_.at(known_[cycle].begin)).lpNorm<Eigen::Infinity>() > 3 * options_.bound) continue;
      if (best && known_[cycle].length <= known_[best->cycle].length) continue;
      const auto found = match(known_[cycle], position);
      if (found) best = Part{cycle, position, found->end, found->difference};
    }
    return best;
  }

  const Samples& samples_;
  const CycleOptions& options_;
  const std::function<void(double)>& progress_;
  Places places_;
  std::vector<Known> known_;
};

}  // namespace

Cycles cycles_of(const Course& course, const CycleOptions& options, const std::function<void(double)>& progress) {
  const Samples samples(course, static_cast<float>(options.bound / 10));
  Cycles made;
  if (samples.count() < 3) return made;
  Search search(samples, options, progress);
  const std::vector<Part> parts = search.run();
  std::vector<double> length(search.known());
  std::vector<std::size_t> appears(search.known());
  for (const Part& part : parts) length[part.cycle] += part.end - part.begin, ++appears[part.cycle];
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < search.known(); ++k)
    if (appears[k] > 1) order.push_back(k);
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return length[a] > length[b]; });
  made.count = order.size();
  for (const Part& part : parts) {
    const auto rank = std::ranges::find(order, part.cycle);
    if (rank == order.end()) continue;
    made.parts.push_back({static_cast<std::size_t>(rank - order.begin()), samples.time(part.begin),
                          samples.time(part.end), part.difference});
  }
  return made;
}

}  // namespace dresslife::sim
