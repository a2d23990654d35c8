// Rings of loose cables have several rests (W40). Which one is found depends on the start of the ring. Several starts go
// through the motion side by side. Starts that come to the same places are one rest from then on. The rest with the
// median damage is the job's own; the others are variations (strain/variations.h).
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "pipeline/job/job.h"
#include "strain/evaluation.h"

namespace dresslife::strain {

/// Returns the largest number of starts besides the first one; 0 if no dresspack has two cables in a hose.
std::size_t other_starts_at_most(const pipeline::Job& job);

class Starts {
 public:
  using Spans = std::vector<std::unique_ptr<Evaluation>>;  ///< of all dresspacks
  static constexpr std::size_t count = 4;

  /// own: the first start; after choose() the start of the job. build: creates another start. The caller owns both. Without a
  /// ring only the first start exists.
  Starts(Spans& own, const std::function<Spans&()>& build);
  /// Only the first start.
  explicit Starts(Spans& own) : own_(own) {}

  /// Returns the evaluations of a span that need the motion in addition to the job's own.
  std::vector<Evaluation*> placed(std::size_t span) const;
  /// Joins starts whose rings all lie at the same places into one rest. Call between two blocks of samples.
  void merge();
  /// Makes the rest the job's own to which so many starts came that choose() takes it for any damages. Returns whether there is
  /// such a rest.
  bool choose_by_number(double z);
  /// Makes the rest at the standard normal quantile z of the starts the job's own; z = 0: the median. damage: (rest); large
  /// damage has a low z, like a short life. Precondition: all samples were added.
  void choose(double z, const std::vector<double>& damage);

  std::size_t rests() const { return 1 + others_.size(); }
  /// Rest 0 is the job's own.
  const Spans& spans(std::size_t rest) const { return rest == 0 ? own_ : *others_[rest - 1]; }
  /// (start) number of its rest; empty: there is no ring. The cables of variations continue from the first start.
  const std::vector<std::size_t>& rest_of() const { return rest_of_; }
  std::size_t rest_of_variations() const { return rest_of_.empty() ? 0 : rest_of_.front(); }

 private:
  std::size_t place_of(double z) const;
  void make_own(std::size_t rest);

  Spans& own_;
  std::vector<Spans*> others_;  ///< (rest - 1)
  std::vector<std::size_t> rest_of_;
};

}  // namespace dresslife::strain
