#include "strain/shortening.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "pipeline/job/job.h"
#include "strain/memory.h"

namespace dresslife::strain {
namespace {

// Time in a loop before its first part, in which loose cables lose most of the influence of the motion before (W42) [s]. With 60 s the
// p10 of the program hard changes by 1e-3, as the rounds of cables with little slack differ by themselves.
constexpr double forgetting = 15;
// Largest difference between a part and its whole rounds [samples]. A smooth peak of strain between two samples is missed by its second
// derivative times half of the squared distance: by a hundredth of what samples miss in any case.
constexpr double most_drift = 0.1;
// Largest jump in time where the motion goes on behind the last part [samples]: less than one step.
constexpr double most_jump = 0.5;
constexpr double fewest_samples = 3;  // of a round that has a rise and a fall
// Largest difference of the hose's deformation between two equal parts over the rms of its variation: rms over a part in each segment,
// and at any sample. The simulation accepts an error of its time step of 5e-3 rms. In the program hard, whose hose hits the robot, equal
// rounds differ by at most 2.7e-3 rms, and by 0.04 where the hose snaps.
constexpr double same_rms = 5e-3, same_sample = 0.1;

/// Adds a turning point. If the strain goes on in the direction of the last one, it replaces the last one. A plateau counts at its
/// first sample.
void join(SiteRows& rows, std::size_t first, float strain, std::uint32_t sample) {
  const std::size_t size = rows.strain.size() - first;
  const float* const last = rows.strain.data() + rows.strain.size() - 1;
  if (size > 0 && strain == *last) return;
  const bool goes_on = size > 1 && (strain > *last) == (*last > *(last - 1));
  if (goes_on) rows.strain.pop_back(), rows.sample.pop_back();
  rows.strain.push_back(strain);
  rows.sample.push_back(sample);
}

std::vector<ProgramLoop> program_loops(const pipeline::FileReader& file, double step) {
  std::vector<ProgramLoop> loops;
  if (!file.has("/program/loop")) return loops;
  const auto rows = file.read<double>("/program/loop");
  for (std::size_t k = 0; k + 3 <= rows.size(); k += 3)
    loops.push_back(
        {rows[k] / step, rows[k + 1] / step, static_cast<std::size_t>(std::clamp(rows[k + 2], 0.0, most_numbered))});
  return loops;
}

using Vector = Eigen::Vector4d;  // curvatures, twist [1/m]; elongation over the radius of the hose [1/m]

/// Differences between two successive parts, and variation of the first one, by segment.
class PartsDifference {
 public:
  explicit PartsDifference(std::size_t segments) : of_(segments) {}
  void add(std::size_t segment, const Vector& before, const Vector& difference) {
    Sums& of = of_[segment];
    of.sum += before, of.squares += before.squaredNorm(), of.difference += difference.squaredNorm();
    largest_ = std::max(largest_, difference.norm());
  }
  /// samples: of a part.
  bool equal(double samples) const {
    double variation = 0, difference = 0;
    for (const Sums& of : of_) {
      variation = std::max(variation, (of.squares - of.sum.squaredNorm() / samples) / samples);
      difference = std::max(difference, of.difference / samples);
    }
    return std::sqrt(difference) <= same_rms * std::sqrt(variation) && largest_ <= same_sample * std::sqrt(variation);
  }

 private:
  struct Sums {
    Vector sum = Vector::Zero();
    double squares = 0, difference = 0;
  };
  std::vector<Sums> of_;
  double largest_ = 0;
};

/// Compares successive equal parts of the hose's motion.
class PartsCheck {
 public:
  PartsCheck(MotionReader& motion, const pipeline::Job& job) : motion_(motion) {
    for (const pipeline::MotionSpan& span : motion.spans())
      radius_.insert(radius_.end(), span.segments, job.dresspacks[span.dresspack].dresspack.diameter / 2);
  }

  /// Returns the number of the last part in which the hose does not move as in the part before; 0: in the last round of the first part
  /// not as in the round before that part; nothing: it moves equally in all. round: [samples].
  std::optional<std::size_t> last_different(const EqualParts& parts, std::size_t round) const {
    for (std::size_t part = parts.count - 1; part > 0; --part)
      if (!equal(parts, parts.first + part * parts.length, parts.length)) return part;
    if (!equal(parts, parts.first + parts.length - round + 1, round - 1)) return 0;
    return {};
  }

 private:
  /// Compares `samples` samples from `begin` on with those one part before.
  bool equal(const EqualParts& parts, std::size_t begin, std::size_t samples) const {
    const std::size_t segments = radius_.size();
    PartsDifference difference(segments);
    for (std::size_t first = begin; first < begin + samples; first += motion_block_samples) {
      const std::size_t count = std::min(motion_block_samples, begin + samples - first);
      const std::vector<Vector> now = read(first, first + count),
                                around = read(first - parts.length - 1, first - parts.length + count + 1);
      for (std::size_t k = 0; k < now.size(); ++k) {
        const Vector &last = around[k], &before = around[k + segments], &next = around[k + 2 * segments];
        const Vector expected =  // by the parabola through three samples, because parts drift against their rounds
            before + parts.drift / 2 * (next - last) + parts.drift * parts.drift / 2 * (next - 2 * before + last);
        difference.add(k % segments, before, now[k] - expected);
      }
    }
    return difference.equal(static_cast<double>(samples));
  }

  /// Returns the deformation (sample, segment).
  std::vector<Vector> read(std::size_t from, std::size_t end) const {
    std::vector<Vector> all;
    const auto put = [&](const MotionBlock& block) {
      for (const Deformation& of : block.deformation)
        all.push_back({of.curvature1, of.curvature2, of.twist, of.elongation / radius_[all.size() % radius_.size()]});
    };
    motion_.run(false, put, from, end);
    return all;
  }

  MotionReader& motion_;
  std::vector<double> radius_;  // (segment) of the hose [m]
};

}  // namespace

std::optional<EqualParts> equal_parts(const ProgramLoop& loop, std::size_t lead) {
  std::optional<EqualParts> best;
  if (!(loop.round >= fewest_samples)) return best;
  for (std::size_t rounds = 1; lead + 2 * rounds < loop.rounds; ++rounds) {
    const double length = static_cast<double>(rounds) * loop.round, drift = std::round(length) - length;
    if (!(std::abs(drift) <= most_drift)) continue;
    EqualParts parts{static_cast<std::size_t>(std::ceil(loop.begin + static_cast<double>(lead) * loop.round)),
                     static_cast<std::size_t>(std::round(length)), (loop.rounds - lead - 1) / rounds, drift};
    const auto fits = [&] {
      return static_cast<double>(parts.end()) <= loop.end() + 1 &&
             static_cast<double>(parts.count - 1) * std::abs(drift) <= most_jump;
    };
    while (parts.count > 1 && !fits()) --parts.count;
    if (parts.count > 1 && (!best || parts.left_out() > best->left_out())) best = parts;
  }
  return best;
}

Shortening::Shortening(std::size_t samples, const std::vector<EqualParts>& parts) {
  const auto add = [&](std::size_t first, std::size_t end, std::size_t times) {
    if (first == end) return;
    pieces_.push_back({first, end, samples_, times});
    if (times > 0) samples_ += end - first;
  };
  std::size_t from = 0;
  for (const EqualParts& of : parts) {
    add(from, of.first, 1);
    add(of.first, of.first + of.length, of.count);
    add(of.first + of.length, of.end(), 0);
    from = of.end();
  }
  add(from, samples, 1);
}

std::size_t Shortening::in_motion(std::size_t sample) const {
  for (const Piece& piece : pieces_)
    if (piece.times > 0 && sample < piece.at + (piece.end - piece.first)) return piece.first + sample - piece.at;
  return sample;
}

DeformationHistory Shortening::shortened(const DeformationColumns& whole) const {
  DeformationHistory history(1, samples_);
  for (const Piece& piece : pieces_)
    for (std::size_t t = piece.first; piece.times > 0 && t < piece.end; ++t)
      history.set(0, piece.at + t - piece.first,
                  {whole.curvature1[t], whole.curvature2[t], whole.twist[t], whole.elongation[t]});
  return history;
}

SiteRows Shortening::whole(const SiteRows& rows) const {
  SiteRows all;
  std::size_t next = 0;
  for (const std::uint64_t turning : rows.turning) {
    const std::size_t end = next + turning, first = all.strain.size();
    for (const Piece& piece : pieces_) {
      if (piece.times == 0) continue;
      const std::size_t length = piece.end - piece.first, from = next;
      while (next < end && rows.sample[next] < piece.at + length) ++next;
      for (std::size_t time = 0; time < piece.times; ++time)
        for (std::size_t k = from; k < next; ++k)
          join(all, first, rows.strain[k],
               static_cast<std::uint32_t>(rows.sample[k] - piece.at + piece.first + time * length));
    }
    if (const auto last = static_cast<std::uint32_t>(pieces_.back().end - 1);
        turning > 1 && all.sample.back() != last) {
      all.strain.push_back(rows.strain[end - 1]);
      all.sample.push_back(last);
    }
    all.turning.push_back(all.strain.size() - first);
  }
  return all;
}

Shortening shortening_of(const pipeline::FileReader& file, MotionReader& motion, const pipeline::Job& job) {
  std::vector<EqualParts> all;
  const PartsCheck check(motion, job);
  for (const ProgramLoop& loop : program_loops(file, motion.step())) {
    if (!(loop.begin >= 0 && loop.round > 0 && loop.end() <= static_cast<double>(motion.samples()))) continue;
    auto lead = static_cast<std::size_t>(std::ceil(forgetting / motion.step() / loop.round));
    while (const std::optional<EqualParts> parts = equal_parts(loop, lead)) {
      const auto round = static_cast<std::size_t>(loop.round);
      const std::optional<std::size_t> different = check.last_different(*parts, round);
      if (!different) {
        all.push_back(*parts);
        break;
      }
      lead += (*different + 1) * (parts->length / round);
    }
  }
  return Shortening(motion.samples(), all);
}

}  // namespace dresslife::strain
