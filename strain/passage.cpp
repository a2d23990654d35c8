#include "strain/passage.h"

#include <algorithm>
#include <cmath>

#include "pipeline/base/threads.h"

namespace dresslife::strain {
namespace {

// Longest motion whose lead-in can end early [s]. A cycle shows after two repeats, and 90 s before the first sample must contain
// more than that, or nothing is gained.
constexpr double longest_short = 22;

void add(std::span<Evaluation* const> all, const SpanBlock& block) { Evaluation::add(all, block); }

}  // namespace

HistoryWindow::HistoryWindow(std::size_t segments, std::size_t samples, std::size_t bytes)
    : segments_(segments),
      size_(std::clamp<std::size_t>(bytes / (samples * sizeof(Deformation)), 1, segments)),
      history_(size_, samples) {}

void HistoryWindow::begin(std::size_t samples, std::size_t bytes) {
  if (samples == history_.samples()) return;
  history_ = DeformationHistory(1, 1);  // frees its memory
  *this = HistoryWindow(segments_, samples, bytes);
}

void HistoryWindow::keep(std::size_t first_segment, std::size_t sample, const MotionBlock& block) {
  for (std::size_t k = 0; k < block.at_wires.size(); ++k)
    if (const std::size_t segment = k % segments_; segment >= first_segment && segment < first_segment + size_)
      history_.set(segment - first_segment, sample + k / segments_, block.at_wires[k]);
}

Passage::Passage(MotionReader& motion, const Shortening& shortening, Starts& starts, HistoryWindow& window,
                 std::size_t threads)
    : motion_(motion),
      shortening_(shortening),
      starts_(starts),
      window_(window),
      threads_(threads),
      loose_(std::ranges::any_of(starts.spans(0), [](const auto& evaluation) { return evaluation->any_loose(); })) {}

std::vector<Evaluation*> Passage::of_starts(std::size_t span) const {
  std::vector<Evaluation*> all{starts_.spans(0)[span].get()};
  for (Evaluation* const placed : starts_.placed(span)) all.push_back(placed);
  return all;
}

std::vector<Evaluation*> Passage::evaluated(std::size_t span) const {
  std::vector<Evaluation*> all = of_starts(span);
  if (variations_)
    for (Evaluation* const placed : variations_->placed(span)) all.push_back(placed);
  return all;
}

/// Returns whether a history of so many samples does not contain the piece.
bool Passage::leaves_out(const Shortening::Piece& piece, std::size_t samples) const {
  return piece.times == 0 && samples == shortening_.samples();
}

/// Returns the evaluations of each thread: (thread). Evaluations that share loose cables are in one thread.
std::vector<std::vector<Evaluation*>> Passage::shared_out(const std::vector<Evaluation*>& all) const {
  std::vector<std::vector<Evaluation*>> of_thread(threads_);
  std::size_t next = 0;
  for (Evaluation* const evaluation : all) {
    const auto found = std::ranges::find_if(of_thread, [&](const std::vector<Evaluation*>& own) {
      return std::ranges::any_of(
          own, [&](const Evaluation* other) { return other->cables().shares_loose(evaluation->cables()); });
    });
    (found != of_thread.end() ? *found : of_thread[next++ % threads_]).push_back(evaluation);
  }
  return of_thread;
}

/// Calls use() with those of the evaluations of each span that do not leave the piece out, for one block of it.
void Passage::each_span(const MotionBlock& block, const Shortening::Piece& piece, const OfSpan& evaluations,
                        const Use& use) const {
  const std::size_t segments = motion_.lengths().size(), count = block.deformation.size() / segments;
  std::vector<double> pull;
  std::vector<Deformation> ends;
  for (std::size_t k = 0; k < motion_.spans().size(); ++k) {
    const auto [begin, size] = std::pair(motion_.spans()[k].first_segment, motion_.spans()[k].segments);
    DeformationHistory of_span(size, count);
    pull.clear();
    ends.clear();
    for (std::size_t t = 0; t < count; ++t) {
      for (std::size_t i = 0; i < size; ++i) of_span.set(i, t, block.deformation[t * segments + begin + i]);
      for (const std::size_t i : {begin, begin + size - 1}) ends.push_back(block.at_wires[t * segments + i]);
      if (block.pull.empty()) continue;
      const auto own = block.pull.subspan((t * segments + begin) * 2, size * 2);
      pull.insert(pull.end(), own.begin(), own.end());
    }
    const SpanBlock span_block{of_span, pull, motion_.step(), ends};
    std::vector<Evaluation*> all = evaluations(k);
    std::erase_if(all, [&](Evaluation* of) {
      const bool leaves = leaves_out(piece, of->samples());
      if (leaves) of->leave_out(span_block);
      return leaves;
    });
    const std::vector<std::vector<Evaluation*>> of_thread = shared_out(all);
    pipeline::in_parallel(threads_, [&](std::size_t part) {
      if (!of_thread[part].empty()) use(of_thread[part], span_block);
    });
  }
}

/// Calls use() for blocks of each piece of the motion.
void Passage::each_piece(bool with_pull,
                         const std::function<void(const MotionBlock&, const Shortening::Piece&)>& use) const {
  for (const Shortening::Piece& piece : shortening_.pieces())
    motion_.run(
        with_pull, [&](const MotionBlock& block) { use(block, piece); }, piece.first, piece.end);
}

void Passage::keep(std::size_t first_segment, const MotionBlock& block, const Shortening::Piece& piece) const {
  if (leaves_out(piece, window_.samples())) return;
  const bool whole = window_.samples() == motion_.samples();
  window_.keep(first_segment, whole ? block.first : piece.at + block.first - piece.first, block);
}

std::size_t Passage::samples_in(double time) const {
  return static_cast<std::size_t>(std::ceil(time / motion_.step()));
}

/// Returns whether cables can stop early in the lead-in.
bool Passage::is_short() const { return motion_.samples() <= samples_in(longest_short); }

std::size_t Passage::repeats_in(double time) const {
  const std::size_t count = samples_in(time), samples = motion_.samples();
  return is_short() ? (count + samples - 1) / samples * samples : count;
}

/// Returns the evaluations of a span whose loose cables have not reached a cycle in the lead-in.
std::vector<Evaluation*> Passage::still_moving(std::size_t span) const {
  std::vector<Evaluation*> all = evaluated(span);
  std::erase_if(all, [](const Evaluation* of) { return of->cables().in_cycle(); });
  return all;
}

void Passage::lead_in(std::size_t from, std::size_t until) {
  const std::size_t samples = motion_.samples(), spans = motion_.spans().size();
  if (!loose_ || samples < 2) return;
  for (std::size_t left = from; left > until;) {
    std::size_t moving = 0, all_of_them = 0;
    for (std::size_t k = 0; k < spans; ++k) moving += still_moving(k).size(), all_of_them += evaluated(k).size();
    if (moving == 0) return;
    const std::size_t first = (samples - left % samples) % samples, count = std::min(left - until, samples - first);
    const Shortening::Piece piece{first, first + count, 0, 1};
    const auto move = [&](const MotionBlock& block) {
      each_span(
          block, piece, [&](std::size_t span) { return still_moving(span); }, Evaluation::lead_in);
      if (moving == all_of_them) starts_.merge();  // else some starts are at the end of a repeat
    };
    motion_.run(true, move, first, first + count);
    left -= count;
    if (left % samples > 0) continue;
    const auto further = static_cast<double>(left) / static_cast<double>(samples);
    for (std::size_t k = 0; k < spans; ++k) Evaluation::end_repeat(still_moving(k), is_short() ? further : HUGE_VAL);
    starts_.merge();
  }
}

void Passage::record_rubbing() const {
  for (std::size_t k = 0; k < motion_.spans().size(); ++k)
    for (Evaluation* const evaluation : of_starts(k)) evaluation->record_rubbing();
}

std::vector<Evaluation*> Passage::open(std::size_t span) const {
  std::vector<Evaluation*> all = evaluated(span);
  std::erase_if(all, [](const Evaluation* of) { return of->cables().closes(); });
  return all;
}

/// Cables that snap in the motion did not reach a cycle in the lead-in. A repeat later they usually have.
void Passage::close_cycles() {
  for (int repeat = 0; repeat < most_closing_repeats; ++repeat) {
    std::vector<std::vector<Evaluation*>> all;  // (span)
    for (std::size_t k = 0; k < motion_.spans().size(); ++k) all.push_back(open(k));
    if (std::ranges::all_of(all, &std::vector<Evaluation*>::empty)) return;
    for (const std::vector<Evaluation*>& of_span : all)
      for (Evaluation* const evaluation : of_span) evaluation->repeat();
    each_piece(true, [&](const MotionBlock& block, const Shortening::Piece& piece) {
      each_span(
          block, piece, [&](std::size_t span) { return all[span]; }, add);
    });
    starts_.merge();
  }
}

void Passage::run(const std::function<void(const MotionBlock&)>& put) {
  each_piece(loose_, [&](const MotionBlock& block, const Shortening::Piece& piece) {
    put(block);
    each_span(
        block, piece, [&](std::size_t span) { return evaluated(span); }, add);
    starts_.merge();
    keep(0, block, piece);
  });
  close_cycles();
  for (std::size_t k = 0; k < motion_.spans().size(); ++k)
    for (Evaluation* const evaluation : evaluated(k)) evaluation->end_first_pass();
  if (std::ranges::none_of(starts_.spans(0), [](const auto& evaluation) { return evaluation->wants_again(); })) return;
  each_piece(false, [&](const MotionBlock& block, const Shortening::Piece& piece) {
    each_span(
        block, piece, [&](std::size_t span) { return evaluated(span); },
        [](std::span<Evaluation* const> own, const SpanBlock& of_span) {
          for (Evaluation* const evaluation : own)
            if (evaluation->wants_again()) evaluation->add_again(of_span.deformation);
        });
  });
}

void Passage::refill(std::size_t first_segment) {
  each_piece(false,
             [&](const MotionBlock& block, const Shortening::Piece& piece) { keep(first_segment, block, piece); });
}

void Passage::choose(double z) {
  if (starts_.rests() == 1) return;
  const bool chosen = starts_.choose_by_number(z);
  for (std::size_t rest = chosen ? 1 : 0; rest < starts_.rests(); ++rest)  // variations need the other rests
    for (const auto& evaluation : starts_.spans(rest)) evaluation->find_bent();
  if (chosen) return;
  std::vector<double> damage(starts_.rests(), 0.0);
  each_segment([&](std::size_t span, std::size_t segment, std::size_t row) {
    for (std::size_t rest = 0; rest < starts_.rests(); ++rest)
      damage[rest] =
          std::max<double>(damage[rest], starts_.spans(rest)[span]->damage_of_bent(segment, window_.history(), row));
  });
  starts_.choose(z, damage);
  if (window_.size() < motion_.lengths().size()) refill(0);
}

void Passage::each_segment(const std::function<void(std::size_t, std::size_t, std::size_t)>& use) {
  const std::vector<pipeline::MotionSpan>& spans = motion_.spans();
  for (std::size_t k = 0, span = 0; k < motion_.lengths().size(); ++k) {
    if (k == spans[span].first_segment + spans[span].segments) ++span;
    if (k % window_.size() == 0 && k > 0) refill(k);
    use(span, k - spans[span].first_segment, k % window_.size());
  }
}

}  // namespace dresslife::strain
