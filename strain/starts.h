// Rings of loose cables have several places of rest (W40): the one that is found depends on how the ring began. Several starts
// go through the motion side by side. Starts that come to the same places are one rest from then on. The rest with the
// median of damage is the job's own; the others are variations (strain/variations.h).
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "pipeline/job/job.h"
#include "strain/evaluation.h"

namespace dresslife::strain {

/// Starts besides the first one, at most; 0 where no dresspack has two cables in a hose.
std::size_t other_starts_at_most(const pipeline::Job& job);

class Starts {
 public:
  using Spans = std::vector<std::unique_ptr<Evaluation>>;  ///< of all dresspacks
  static constexpr std::size_t count = 4;

  /// own: one of the starts, and after choose() that of the job. build: makes others like it. Both stay the caller's.
  /// Without a ring there is no other start.
  Starts(Spans& own, const std::function<Spans&()>& build);

  /// Evaluations of a span, besides the job's own, that want the motion like that.
  std::vector<Evaluation*> placed(std::size_t span) const;
  /// Between two blocks of samples: starts whose rings all lie at the same places become one rest.
  void merge();
  /// All samples were added: the rest at a standard normal quantile z of the starts, 0 for the median, becomes the job's own.
  /// damage: (rest) to compare them; much of it has a low z, like short lives.
  void choose(double z, const std::vector<double>& damage);

  std::size_t rests() const { return 1 + others_.size(); }
  /// Rest 0 is the job's own.
  const Spans& spans(std::size_t rest) const { return rest == 0 ? own_ : *others_[rest - 1]; }
  /// (start) the rest that it came to; empty: there is no ring. Variations of cables go on from the first start.
  const std::vector<std::size_t>& rest_of() const { return rest_of_; }
  std::size_t rest_of_variations() const { return rest_of_.empty() ? 0 : rest_of_.front(); }

 private:
  Spans& own_;
  std::vector<Spans*> others_;  ///< (rest - 1)
  std::vector<std::size_t> rest_of_;
};

}  // namespace dresslife::strain
