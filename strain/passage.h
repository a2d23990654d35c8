// Moves evaluations through one motion: samples before the first one for loose cables, the first pass, the choice of a rest
// among those of the starts, then segment by segment.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "strain/history.h"
#include "strain/motion_reader.h"
#include "strain/shortening.h"
#include "strain/starts.h"
#include "strain/variations.h"

namespace dresslife::strain {

/// Deformation over time of as many consecutive segments as fit into memory.
class HistoryWindow {
 public:
  /// bytes: memory limit; one segment always fits.
  HistoryWindow(std::size_t segments, std::size_t samples, std::size_t bytes);
  /// Makes it the window of another motion, of as many segments.
  void begin(std::size_t samples, std::size_t bytes);
  std::size_t size() const { return size_; }  ///< number of segments in it
  std::size_t samples() const { return history_.samples(); }
  const DeformationHistory& history() const { return history_; }
  /// Copies the segments from first_segment on out of a block. sample: number of its first sample in the window.
  void keep(std::size_t first_segment, std::size_t sample, const MotionBlock& block);

 private:
  std::size_t segments_, size_;
  DeformationHistory history_;
};

class Passage {
 public:
  /// The caller owns all arguments. An evaluation or window for as many samples as the shortened motion has follows that motion; each
  /// other one follows the whole motion. threads: does not change the result.
  Passage(MotionReader& motion, const Shortening& shortening, Starts& starts, HistoryWindow& window,
          std::size_t threads);
  /// From now on the evaluations of `variations` also go through the motion.
  void take_along(const Variations& variations) { variations_ = &variations; }

  bool any_loose() const { return loose_; }
  /// Moves loose cables through the samples from `from` to `until` before the first one: the end of the motion, or whole repeats.
  /// In a short motion cables that have reached a cycle (LooseCables::in_cycle()) stop at the end of a repeat; `until` must then be
  /// whole repeats. Does nothing if no cable is loose.
  void lead_in(std::size_t from, std::size_t until);
  /// Returns the number of samples in this time [s].
  std::size_t samples_in(double time) const;
  /// The same, in a short motion rounded up to whole repeats.
  std::size_t repeats_in(double time) const;
  /// Records rubbing for every start, because each can become the job's own.
  void record_rubbing() const;
  /// First pass. put: receives every block before the evaluations. Evaluations whose loose cables do not end the motion where they
  /// began it (CablePaths::closes()) follow it again, up to most_closing_repeats times.
  void run(const std::function<void(const MotionBlock&)>& put);
  static constexpr int most_closing_repeats = 2;
  /// Returns the evaluations whose loose cables still do not close after run().
  std::vector<Evaluation*> open(std::size_t span) const;
  /// The rest at the standard normal quantile z becomes the job's own (Starts::choose()).
  void choose(double z);
  /// Returns all evaluations of a span, the job's own first.
  std::vector<Evaluation*> evaluated(std::size_t span) const;
  /// Calls use() for every segment: its span, its number in the span, its row in the window. Precondition: the window contains
  /// the first segments.
  void each_segment(const std::function<void(std::size_t span, std::size_t segment, std::size_t row)>& use);

 private:
  using Use = std::function<void(std::span<Evaluation* const>, const SpanBlock&)>;
  std::vector<Evaluation*> of_starts(std::size_t span) const;
  bool leaves_out(const Shortening::Piece& piece, std::size_t samples) const;
  bool is_short() const;
  std::vector<Evaluation*> still_moving(std::size_t span) const;
  std::vector<std::vector<Evaluation*>> shared_out(const std::vector<Evaluation*>& all) const;
  using OfSpan = std::function<std::vector<Evaluation*>(std::size_t span)>;
  void each_span(const MotionBlock& block, const Shortening::Piece& piece, const OfSpan& evaluations,
                 const Use& use) const;
  void close_cycles();
  void each_piece(bool with_pull, const std::function<void(const MotionBlock&, const Shortening::Piece&)>& use) const;
  void keep(std::size_t first_segment, const MotionBlock& block, const Shortening::Piece& piece) const;
  void refill(std::size_t first_segment);

  MotionReader& motion_;
  const Shortening& shortening_;
  Starts& starts_;
  HistoryWindow& window_;
  std::size_t threads_;
  const Variations* variations_ = nullptr;
  bool loose_;
};

}  // namespace dresslife::strain
