// From strains to turning points, sixteen wires side by side (W14), for one instruction set: part of
// kernels_body.h.
//
// A wire that moves to and fro carries a slot of the gate's width g along, whose upper edge h only moves when
// strain x pushes against one of its ends:
//     h <- min(max(h, x), x + g)
// Where h rises x is a new highest strain, where it falls a new lowest one; the last place before it changes
// its direction is a turning point. So one bit each for rising and falling is all that the loop over samples
// keeps; 32 of them make a word per wire, and the turning points are found in the words.
//
// The first turn: a wire is decided once it has moved by the gate. Started in a valley (h = x + g), h rises
// where the wire is decided by a rise; started on a peak (h = x), it falls where it is decided by a fall.
// From there on both are the same, so the second only has to run until then, for the peak before the fall.
#pragma once

#include "strain/pack.h"
// pack.h declares what the templates below are used with
#include "strain/kernels.h"

namespace dresslife::strain {
namespace DRESSLIFE_MACHINE_KERNELS {
namespace {

constexpr int word = 32;  ///< samples

/// Where a run's strains come from: waves, and their factors for a pack of wires (W13).
struct FromWaves {
  const float* wave[waves_per_layer];

  FromWaves() = default;
  explicit FromWaves(const LaneRun& run) {
    for (int w = 0; w < waves_per_layer; ++w) wave[w] = run.waves.at[w];
  }
};
struct WaveShape {
  FloatPack sine1, cosine1, sine2, cosine2;

  WaveShape() = default;
  WaveShape(const LaneState& state, int lane)
      : sine1(load<FloatPack>(state.shape[0] + lane)),
        cosine1(load<FloatPack>(state.shape[1] + lane)),
        sine2(load<FloatPack>(state.shape[2] + lane)),
        cosine2(load<FloatPack>(state.shape[3] + lane)) {}

  inline __attribute__((always_inline)) FloatPack at(const FromWaves& from, std::size_t t) const {
    return (from.wave[0][t] + from.wave[1][t] * sine1 + from.wave[2][t] * cosine1) +
           (from.wave[3][t] * sine2 + from.wave[4][t] * cosine2);
  }
};

/// The same for strains that are there already.
struct FromStrains {
  const float* strain;

  FromStrains() = default;
  explicit FromStrains(const LaneRun& run) : strain(run.strain) {}
};
struct StrainShape {
  int lane;

  StrainShape() = default;
  StrainShape(const LaneState&, int first_lane) : lane(first_lane) {}

  inline __attribute__((always_inline)) FloatPack at(const FromStrains& from, std::size_t t) const {
    return load<FloatPack>(from.strain + t * lanes + lane);
  }
};

/// Which way the edge moved, a bit per sample.
struct Moves {
  IntPack up{}, down{};
};

/// A pack of the wires of one LaneRun, the first of them lane `lane`.
template <class Shape, class Source>
struct Scan {
  LaneState& state;
  Source source;
  int lane;
  TurningPoint** end;
  alignas(64) float strain[word + 1][float_pack_size];  ///< the last: no sample

  Scan(const LaneRun& run, int first) : state(*run.state), source(run), lane(first), end(run.end) {}

  unsigned used() const { return (((1u << state.used) - 1) >> lane) & ((1u << float_pack_size) - 1); }

  /// The same edge started on a peak, along strains that are known.
  Moves follow_top(int count) {
    FloatPack edge = load<FloatPack>(state.top_edge + lane);
    Moves moves;
    for (int t = 0; t < count; ++t) {
      const FloatPack x = load<FloatPack>(strain[t]), above = x + state.below_gate;
      const IntPack bit = IntPack{} + static_cast<std::int32_t>(1u << t);
      moves.up = marked(moves.up, greater(x, edge), bit);
      moves.down = marked(moves.down, greater(edge, above), bit);
      edge = smaller(larger(edge, x), above);
    }
    store(edge, state.top_edge + lane);
    return moves;
  }

  /// Undecided wires of which samples [state.sample + from, + count) decide.
  void decide(unsigned open, const Moves& valley, int count, std::int32_t first) {
    const Moves top = follow_top(count);
    alignas(64) std::uint32_t rises[float_pack_size], peaks[float_pack_size], falls[float_pack_size];
    store(valley.up, rises);
    store(top.up, peaks);
    store(top.down, falls);
    for (; open != 0; open &= open - 1) {
      const int wire = __builtin_ctz(open), of = lane + wire;
      const std::uint32_t rise = rises[wire], fall = falls[wire];
      const bool falls_first = fall != 0 && (rise == 0 || __builtin_ctz(fall) < __builtin_ctz(rise));
      std::uint32_t before = peaks[wire];
      if (falls_first) before &= (fall & -fall) - 1;
      if (before != 0) {
        const int at = 31 - __builtin_clz(before);
        state.top[of] = strain[at][wire];
        state.top_at[of] = first + at;
      }
      if (falls_first && state.top_at[of] > 0)
        *end[of]++ = {state.top[of], static_cast<std::uint32_t>(state.top_at[of])};
      if ((rise | fall) != 0) state.decided |= 1u << of;
    }
  }

  /// Puts the extremes of which the moves of `count` samples from `first` on tell that they are turns.
  inline void put_turns(const Moves& moves, std::int32_t first) {
    const IntPack event = moves.up | moves.down;
    // Of each sample, whether there is a later event in the word and whether the next one is a rise: from the
    // right neighbour, from two to the right, four, ..., where it is not known yet.
    IntPack known = shifted_right(event, 1), rises = shifted_right(moves.up, 1);
    for (int step = 1; step < word; step *= 2) {
      rises |= shifted_right(rises, step) & ~known;
      known |= shifted_right(known, step);
    }
    const IntPack turns = (moves.up & known & ~rises) | (moves.down & rises);
    // The extreme from the words before turns if the first event leads away from it.
    const IntPack first_event = event & -event;
    const IntPack rose = load<IntPack>(state.rises + lane);
    const Mask old_turns = nonzero(first_event & ((moves.down & rose) | (moves.up & ~rose)));
    const unsigned old = bits(old_turns), any = (old | bits(nonzero(turns))) & used();
    if (any != 0) put(any, old, turns, first);
    const Mask moved = nonzero(event);
    const IntPack last = highest_bit(event);
    store(select(moved, first + last, load<IntPack>(state.extreme_at + lane)), state.extreme_at + lane);
    store(select(moved, gathered(strain, last), load<FloatPack>(state.extreme + lane)), state.extreme + lane);
    const Mask up = nonzero(moves.up & ((IntPack{} + 1) << last));
    store(select(moved, select(up, IntPack{} - 1, IntPack{}), rose), state.rises + lane);
  }

  /// Two turns of a word are written whether they are there or not: that is rarely guessed wrong.
  inline void put(unsigned any, unsigned old, const IntPack& turns, std::int32_t first) {
    alignas(64) std::uint32_t of_wire[float_pack_size];
    store(turns, of_wire);
    for (; any != 0; any &= any - 1) {
      const int wire = __builtin_ctz(any), of = lane + wire;
      TurningPoint* to = end[of];
      *to = {state.extreme[of], static_cast<std::uint32_t>(state.extreme_at[of])};
      to += (old >> wire & 1) & (state.extreme_at[of] > 0);
      std::uint32_t left = of_wire[wire];
      const auto put_next = [&](int place) {
        const int at = left != 0 ? __builtin_ctz(left) : word;
        to[place] = {strain[at][wire], static_cast<std::uint32_t>(first + at)};
        left &= left - 1;
      };
      const int count = __builtin_popcount(left);
      put_next(0);
      put_next(1);
      for (int more = 2; more < count; ++more) put_next(more);
      end[of] = to + count;
    }
  }

  void start() {
    const FloatPack x = Shape(state, lane).at(source, 0);
    store(FloatPack(x + state.below_gate), state.edge + lane);
    store(x, state.top_edge + lane);
    store(x, state.extreme + lane);
    store(x, state.top + lane);
    for (auto* at : {state.extreme_at, state.top_at, state.rises}) store(IntPack{}, at + lane);
    for (int wire = lane; wire < state.used && wire < lane + float_pack_size; ++wire)
      *end[wire]++ = {state.extreme[wire], 0};
  }

  /// After follow() of samples [from, from + count).
  void turn(const Moves& moves, std::size_t from, int count) {
    const std::int32_t first = state.sample + static_cast<std::int32_t>(from);
    if (const unsigned open = used() & ~(state.decided >> lane); open != 0) decide(open, moves, count, first);
    put_turns(moves, first);
  }
};

/// Strains of samples [from, from + count), and how they move the edge, of `side` packs at a time: each waits
/// for its edge at the sample before, the others fill the gaps.
template <int side, class Shape, class Source>
inline __attribute__((always_inline)) void follow(Scan<Shape, Source>* scans, std::size_t from, int count,
                                                  Moves* moves) {
  Source source[side];
  FloatPack edge[side], gate[side];
  Shape shape[side];
  Moves moved[side];
  for (int k = 0; k < side; ++k) {
    const LaneState& state = scans[k].state;
    source[k] = scans[k].source;
    shape[k] = Shape(state, scans[k].lane);
    edge[k] = load<FloatPack>(state.edge + scans[k].lane);
    gate[k] = FloatPack{} + state.below_gate;
  }
  IntPack bit = IntPack{} + 1;
  for (int t = 0; t < count; ++t, bit += bit)
#pragma GCC unroll 4
    for (int k = 0; k < side; ++k) {
      const FloatPack x = shape[k].at(source[k], from + t), above = x + gate[k];
      store(x, scans[k].strain[t]);
      moved[k].up = marked(moved[k].up, greater(x, edge[k]), bit);
      moved[k].down = marked(moved[k].down, greater(edge[k], above), bit);
      edge[k] = smaller(larger(edge[k], x), above);
    }
  for (int k = 0; k < side; ++k) {
    store(edge[k], scans[k].state.edge + scans[k].lane);
    moves[k] = moved[k];
  }
}

template <int side, class Shape, class Source>
void scan_packs(Scan<Shape, Source>* scans, std::size_t count) {
  Moves moves[side];
  for (int k = 0; k < side; ++k)
    if (scans[k].state.sample == 0) scans[k].start();
  for (std::size_t from = 0; from < count; from += word) {
    const int here = count - from < word ? static_cast<int>(count - from) : word;
    if (here == word)
      follow<side>(scans, from, word, moves);
    else
      follow<side>(scans, from, here, moves);
    for (int k = 0; k < side; ++k) scans[k].turn(moves[k], from, here);
  }
  for (int k = 0; k < side; ++k)
    store(Shape(scans[k].state, scans[k].lane).at(scans[k].source, count - 1),
          scans[k].state.last + scans[k].lane);
}

template <class Shape, class Source>
void scan_all(const LaneRun* runs, std::size_t run_count, std::size_t count) {
  constexpr int side = 2;
  alignas(64) unsigned char room[side * sizeof(Scan<Shape, Source>)];
  auto* const scans = reinterpret_cast<Scan<Shape, Source>*>(room);
  int waiting = 0;
  for (const LaneRun* run = runs; run != runs + run_count; ++run)
    for (int lane = 0; lane < run->state->used; lane += float_pack_size) {
      new (scans + waiting++) Scan<Shape, Source>(*run, lane);
      if (waiting < side) continue;
      scan_packs<side>(scans, count);
      waiting = 0;
    }
  if (waiting != 0) scan_packs<1>(scans, count);
  for (const LaneRun* run = runs; run != runs + run_count; ++run)
    run->state->sample += static_cast<std::int32_t>(count);
}

void scan(const LaneRun* runs, std::size_t run_count, std::size_t count) {
  scan_all<WaveShape, FromWaves>(runs, run_count, count);
}

void scan_strains(const LaneRun* runs, std::size_t run_count, std::size_t count) {
  scan_all<StrainShape, FromStrains>(runs, run_count, count);
}

// ---- what ranks wires -------------------------------------------------------------------------------------

/// What a range from one turning point to the next adds to StrainMeasures::cycle_sum.
inline FloatPack cycle_share(const FloatPack& before, const FloatPack& now) {
  const FloatPack product = larger(larger(before, now), FloatPack{}) * (now - before);
  return larger(product, -product) * product * product;
}

/// Here turns need no list: a wire is followed as strain times its direction, whose highest value is the
/// turning point once it has fallen from there by the gate. The first direction is a guess that can cost one
/// range below the gate.
template <class Shape, class Source>
struct Ranking {
  const LaneRun* run;
  int lane;
  Shape shape;
  Source source;
  FloatPack below_gate, direction, turn, extreme, sum, low, high;

  Ranking() = default;
  Ranking(const LaneRun& of, int first)
      : run(&of),
        lane(first),
        shape(*of.state, first),
        source(of),
        below_gate(FloatPack{} + of.state->below_gate) {
    const LaneRanks& ranks = *run->ranks;
    direction = load<FloatPack>(ranks.direction + lane);
    turn = load<FloatPack>(ranks.turn + lane);
    extreme = load<FloatPack>(ranks.extreme + lane);
    sum = load<FloatPack>(ranks.sum + lane);
    low = load<FloatPack>(ranks.low + lane);
    high = load<FloatPack>(ranks.high + lane);
    if (run->state->sample != 0) return;
    direction = FloatPack{} + 1.0f;
    sum = FloatPack{};
    low = high = turn = extreme = shape.at(source, 0);
  }

  inline __attribute__((always_inline)) void next(std::size_t t) {
    const FloatPack x = shape.at(source, t), y = direction * x;
    low = smaller(low, x);
    high = larger(high, x);
    extreme = larger(extreme, y);
    const Mask turned = greater(extreme - y, below_gate);
    const FloatPack now = direction * extreme;
    sum += select(turned, cycle_share(turn, now), FloatPack{});
    turn = select(turned, now, turn);
    extreme = select(turned, -y, extreme);
    direction = select(turned, -direction, direction);
  }

  void keep(std::size_t count) const {
    LaneRanks& ranks = *run->ranks;
    store(direction, ranks.direction + lane);
    store(turn, ranks.turn + lane);
    store(extreme, ranks.extreme + lane);
    store(sum, ranks.sum + lane);
    store(low, ranks.low + lane);
    store(high, ranks.high + lane);
    const FloatPack last = shape.at(source, count - 1), peak = direction * extreme;
    store(FloatPack(sum + cycle_share(turn, peak) + cycle_share(peak, last)), ranks.cycle_sum + lane);
  }
};

/// Packs two at a time: each waits for itself at the sample before.
template <class Shape, class Source>
void rank_all(const LaneRun* runs, std::size_t run_count, std::size_t count) {
  using One = Ranking<Shape, Source>;
  const LaneRun* waiting = nullptr;
  int waiting_lane = 0;
  for (const LaneRun* run = runs; run != runs + run_count; ++run)
    for (int lane = 0; lane < run->state->used; lane += float_pack_size) {
      if (waiting == nullptr) {
        waiting = run, waiting_lane = lane;
        continue;
      }
      One a(*waiting, waiting_lane), b(*run, lane);
      for (std::size_t t = 0; t < count; ++t) a.next(t), b.next(t);
      a.keep(count), b.keep(count);
      waiting = nullptr;
    }
  if (waiting != nullptr) {
    One a(*waiting, waiting_lane);
    for (std::size_t t = 0; t < count; ++t) a.next(t);
    a.keep(count);
  }
  for (const LaneRun* run = runs; run != runs + run_count; ++run)
    run->state->sample += static_cast<std::int32_t>(count);
}

void rank(const LaneRun* runs, std::size_t run_count, std::size_t count) {
  rank_all<WaveShape, FromWaves>(runs, run_count, count);
}

void rank_strains(const LaneRun* runs, std::size_t run_count, std::size_t count) {
  rank_all<StrainShape, FromStrains>(runs, run_count, count);
}

}  // namespace
}  // namespace DRESSLIFE_MACHINE_KERNELS
}  // namespace dresslife::strain
