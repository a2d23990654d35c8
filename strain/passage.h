// Evaluations go through one motion: samples before the first one for loose cables, then the first pass, then the choice of a
// rest among those of the starts, then segment by segment.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "strain/history.h"
#include "strain/motion_reader.h"
#include "strain/starts.h"
#include "strain/variations.h"

namespace dresslife::strain {

/// Deformation over time of as many consecutive segments as fit into memory.
class HistoryWindow {
 public:
  /// bytes: that it may take, at least those of one segment.
  HistoryWindow(std::size_t segments, std::size_t samples, std::size_t bytes);
  std::size_t size() const { return size_; }  ///< segments in it
  const DeformationHistory& history() const { return history_; }
  /// Takes from a block what belongs to the segments from first_segment on.
  void keep(std::size_t first_segment, const MotionBlock& block);

 private:
  std::size_t segments_, size_;
  DeformationHistory history_;
};

class Passage {
 public:
  /// All stay the caller's. threads: any number gives the same.
  Passage(MotionReader& motion, Starts& starts, HistoryWindow& window, std::size_t threads);
  /// From now on these go through the motion, too.
  void take_along(const Variations& variations) { variations_ = &variations; }

  bool any_loose() const { return loose_; }
  /// Loose cables go through the time from `from` to `until` before the first sample [s]: the end of the motion, or whole
  /// repeats. Nothing where no cable is loose.
  void rehearse(double from, double until);
  /// Every start, since each may become the job's own.
  void record_rubbing() const;
  /// The first pass. put: gets every block before the evaluations.
  void run(const std::function<void(const MotionBlock&)>& put);
  /// The rest at the standard normal quantile z becomes the job's own (Starts::choose()).
  void choose(double z);
  /// use: of every segment its span, its number there, and its row in the window. The window has the first segments before.
  void each_segment(const std::function<void(std::size_t span, std::size_t segment, std::size_t row)>& use);

 private:
  using Use = std::function<void(std::span<Evaluation* const>, const SpanBlock&)>;
  std::vector<Evaluation*> of_starts(std::size_t span) const;
  std::vector<Evaluation*> evaluated(std::size_t span) const;
  std::vector<std::vector<Evaluation*>> shared_out(std::size_t span) const;
  void each_span(const MotionBlock& block, const Use& use) const;
  void refill(std::size_t first_segment);

  MotionReader& motion_;
  Starts& starts_;
  HistoryWindow& window_;
  std::size_t threads_;
  const Variations* variations_ = nullptr;
  bool loose_;
};

}  // namespace dresslife::strain
