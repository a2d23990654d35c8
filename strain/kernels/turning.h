// From strains to turning points, sixteen wires side by side (W14), for one instruction set. This file is a part of body.h.
//
// A slot of the gate's width g follows the strain x of a wire. Its upper edge h moves only when x reaches an end of the
// slot:
//     h <- min(max(h, x), x + g)
// If h rises, x is a new highest strain; if it falls, a new lowest strain. The last sample before h changes its direction
// is a turning point. The loop over samples therefore keeps only one bit for rising and one for falling. 32 of each are a
// word per wire, and the turning points are found in the words. The strain at the last movement follows from the
// edge: h after a rise, h - g after a fall.
//
// The first turn is known when a wire has moved by the gate. A slot that starts in a valley (h = x + g) is right if the first
// movement is a rise; one that starts on a peak (h = x) is right if it is a fall. After the first movement both are equal. The
// second slot runs only until then, and gives the peak before the fall.
#pragma once

#include "pipeline/base/simd.h"
// simd.h declares the functions that the templates below use
#include "strain/kernels/kernels.h"

namespace dresslife::strain {
namespace DRESSLIFE_MACHINE_KERNELS {
namespace {

using namespace simd;

/// Returns the number in its word of the sample of a single bit; undefined if no bit is set.
inline IntPack sample_of(const IntPack& bit) { return word - 1 - place_of(bit); }

/// Source of a run's strains: waves. WaveShape has their factors for a pack of wires (W13).
struct FromWaves {
  static constexpr bool are_waves = true;
  const float* waves;

  FromWaves() = default;
  explicit FromWaves(const LaneRun& run) : waves(run.waves) {}
  inline __attribute__((always_inline)) float wave(std::size_t w, std::size_t t) const {
    return waves[w * block_samples + t];
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

  /// The part of the strain that is equal at the opposite angle, and the part that has the opposite sign there.
  inline __attribute__((always_inline)) FloatPack even(const FromWaves& from, std::size_t t) const {
    return from.wave(0, t) + from.wave(2, t) * cosine1 + from.wave(4, t) * cosine2;
  }
  inline __attribute__((always_inline)) FloatPack odd(const FromWaves& from, std::size_t t) const {
    return from.wave(1, t) * sine1 + from.wave(3, t) * sine2;
  }
  inline __attribute__((always_inline)) FloatPack at(const FromWaves& from, std::size_t t) const {
    return even(from, t) + odd(from, t);
  }
};

/// Source of a run's strains: given strains.
struct FromStrains {
  static constexpr bool are_waves = false;
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

/// A pack of the wires of a run; its first wire is lane `lane`.
struct PackOf {
  const LaneRun* run;
  int lane;
};

/// The strains of separate packs.
template <class Shape, class Source, int packs>
struct Apart {
  static constexpr int side = packs;
  Shape shape[side];
  Source source[side];

  explicit Apart(const PackOf* of) {
    for (int k = 0; k < side; ++k) {
      shape[k] = Shape(*of[k].run->state, of[k].lane);
      source[k] = Source(*of[k].run);
    }
  }
  inline __attribute__((always_inline)) void at(std::size_t t, FloatPack* x) const {
    for (int k = 0; k < side; ++k) x[k] = shape[k].at(source[k], t);
  }
};

/// The strains of a pack of wires and of its mirror images, which share the products.
struct Mirrored {
  static constexpr int side = 2;
  WaveShape shape;
  FromWaves source;

  explicit Mirrored(const PackOf* of) : shape(*of[0].run->state, of[0].lane), source(*of[0].run) {}
  inline __attribute__((always_inline)) void at(std::size_t t, FloatPack* x) const {
    const FloatPack even = shape.even(source, t), odd = shape.odd(source, t);
    x[0] = even + odd;
    x[1] = even - odd;
  }
};

/// Two sets of packs side by side.
template <class First, class Second>
struct Both {
  static constexpr int side = First::side + Second::side;
  First first;
  Second second;

  explicit Both(const PackOf* of) : first(of), second(of + First::side) {}
  inline __attribute__((always_inline)) void at(std::size_t t, FloatPack* x) const {
    first.at(t, x);
    second.at(t, x + First::side);
  }
};

/// Calls use(strains, packs) for all packs of the runs, up to `most` (2 or 4) at a time: the result of a sample depends on the
/// previous one, and a single pack would wait for it.
template <int most, class Shape, class Source, class Use>
inline void for_packs(const LaneRun* runs, std::size_t run_count, const Use& use) {
  const LaneRun* const end = runs + run_count;
  PackOf pair[4], single[4];  // packs that wait for others
  int pairs = 0, singles = 0;
  for (const LaneRun* run = runs; run != end; ++run) {
    const LaneRun* const images = run + 1 != end && run[1].mirrors ? run + 1 : nullptr;
    const int imaged = images ? images->state->used : 0;
    for (int lane = 0; lane < run->state->used; lane += float_pack_size) {
      if constexpr (Source::are_waves)
        if (lane < imaged) {
          pair[2 * pairs] = {run, lane};
          pair[2 * pairs + 1] = {images, lane};
          if (2 * ++pairs < most) continue;
          if constexpr (most == 4)
            use(Both<Mirrored, Mirrored>(pair), pair);
          else
            use(Mirrored(pair), pair);
          pairs = 0;
          continue;
        }
      single[singles++] = {run, lane};
      if (singles < most) continue;
      use(Apart<Shape, Source, most>(single), single);
      singles = 0;
    }
    if (images) ++run;
  }
  if constexpr (Source::are_waves && most == 4) {
    if (pairs == 1 && singles >= 2) {
      pair[2] = single[--singles];
      pair[3] = single[--singles];
      use(Both<Mirrored, Apart<Shape, Source, 2>>(pair), pair);
    } else if (pairs == 1) {
      use(Mirrored(pair), pair);
    }
  }
  if (singles >= 2) {
    singles -= 2;
    use(Apart<Shape, Source, 2>(single + singles), single + singles);
  }
  if (singles == 1) use(Apart<Shape, Source, 1>(single), single);
}

/// Movements of the edge: one bit per sample.
struct Moves {
  IntPack up, down;
};

/// Scans one pack.
template <class Shape, class Source>
struct Scan {
  LaneState& state;
  Source source;
  int lane;
  TurningPoint** end;
  alignas(64) float strain[word + 1][float_pack_size];  ///< (sample of the word, wire); the last row: no sample

  explicit Scan(const PackOf& of) : state(*of.run->state), source(*of.run), lane(of.lane), end(of.run->end) {}

  unsigned used() const { return (((1u << state.used) - 1) >> lane) & ((1u << float_pack_size) - 1); }

  /// Follows the edge that starts on a peak, along the stored strains.
  Moves follow_top(int count) {
    FloatPack edge = load<FloatPack>(state.top_edge + lane);
    WordRecord up, down;
    for (int t = 0; t < count; ++t) {
      const FloatPack x = load<FloatPack>(strain[t]), above = x + state.below_gate;
      const IntPack bit = IntPack{} + static_cast<std::int32_t>(first_of_word >> t);
      up.put(t, bit, greater(x, edge));
      down.put(t, bit, greater(edge, above));
      edge = smaller(larger(edge, x), above);
    }
    store(edge, state.top_edge + lane);
    return {up.words(), down.words()};
  }

  /// Decides the first turn of undecided wires that move by the gate within a word. first: number of its first sample.
  void decide(unsigned open, const Moves& valley, int count, std::int32_t first) {
    const Moves top = follow_top(count);
    alignas(64) std::uint32_t rises[float_pack_size], peaks[float_pack_size], falls[float_pack_size];
    store(valley.up, rises);
    store(top.up, peaks);
    store(top.down, falls);
    for (; open != 0; open &= open - 1) {
      const int wire = __builtin_ctz(open), of = lane + wire;
      const std::uint32_t rise = rises[wire], fall = falls[wire];
      const bool falls_first = fall > rise;  // no sample is both rise and fall: the higher bit is earlier
      std::uint32_t before = peaks[wire];
      if (falls_first) before &= ~(0xffffffffu >> __builtin_clz(fall));
      if (before != 0) {
        const int at = word - 1 - __builtin_ctz(before);
        state.top[of] = strain[at][wire];
        state.top_at[of] = first + at;
      }
      if (falls_first && state.top_at[of] > 0)
        *end[of]++ = {state.top[of], static_cast<std::uint32_t>(state.top_at[of])};
      if ((rise | fall) != 0) state.decided |= 1u << of;
    }
  }

  /// Writes the extremes that are turns according to the moves of a word. first: number of its first sample.
  ///
  /// A rise is a turn if the next move is a fall. In down - up - 1 = down + ~up the bit of a fall carries through all
  /// bits without a rise up to the rise before it, and sets that bit. A rise that is followed by another rise gets no
  /// carry. Falls are found in the same way in up + ~down.
  inline void put_turns(const Moves& moves, std::int32_t first) {
    const IntPack event = moves.up | moves.down, last = event & -event;
    const IntPack away = moves.down - moves.up;
    const IntPack turns = (moves.up & (away - 1)) | (moves.down & ~away);
    // The extreme of earlier words is a turn if the first move leads away from it.
    const IntPack rose = load<IntPack>(state.rises + lane);
    const unsigned moved = bits(nonzero(event));
    const unsigned old = bits(nonzero(above(moves.up, moves.down) ^ rose)) & moved;
    const unsigned any = (old | bits(nonzero(turns))) & used();
    if (any != 0) put(any, old, turns, first);
    const Mask moves_on = nonzero(event), rises = nonzero(moves.up & last);
    const IntPack rising = select(moves_on, select(rises, IntPack{} - 1, IntPack{}), rose);
    const FloatPack edge = load<FloatPack>(state.edge + lane);
    store(rising, state.rises + lane);
    store(select(moves_on, first + sample_of(last), load<IntPack>(state.extreme_at + lane)), state.extreme_at + lane);
    store(select(nonzero(rising), edge, edge - state.below_gate), state.extreme + lane);
  }

  /// Writes turns. Two turns of a word are always written, also if they do not exist, because then the branch is rarely
  /// mispredicted.
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
        const int at = left != 0 ? __builtin_clz(left) : word;
        to[place] = {strain[at][wire], static_cast<std::uint32_t>(first + at)};
        left &= ~(static_cast<std::uint64_t>(first_of_word) >> at);
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

  /// Finds the turns of samples [from, from + count). Precondition: follow() of these samples.
  __attribute__((noinline)) void turn(const Moves& moves, std::size_t from, int count) {
    const std::int32_t first = state.sample + static_cast<std::int32_t>(from);
    if (const unsigned open = used() & ~(state.decided >> lane); open != 0) decide(open, moves, count, first);
    put_turns(moves, first);
  }
};

/// Computes the strains of samples [from, from + count) and the movements of the edges.
template <class Strains, class One>
inline __attribute__((always_inline)) void follow(const Strains& strains, One* scans, std::size_t from, int count,
                                                  Moves* moves) {
  constexpr int side = Strains::side;
  FloatPack edge[side], gate[side], x[side];
  WordRecord up[side], down[side];
  for (int k = 0; k < side; ++k) {
    const LaneState& state = scans[k].state;
    edge[k] = load<FloatPack>(state.edge + scans[k].lane);
    gate[k] = FloatPack{} + state.below_gate;
  }
  IntPack bit = IntPack{} + static_cast<std::int32_t>(first_of_word);
  for (int t = 0; t < count; ++t, bit = shifted_right<1>(bit)) {
    strains.at(from + t, x);
#pragma GCC unroll 4
    for (int k = 0; k < side; ++k) {
      const FloatPack above = x[k] + gate[k];
      store(x[k], scans[k].strain[t]);
      up[k].put(t, bit, greater(x[k], edge[k]));
      down[k].put(t, bit, greater(edge[k], above));
      edge[k] = smaller(larger(edge[k], x[k]), above);
    }
  }
  for (int k = 0; k < side; ++k) {
    store(edge[k], scans[k].state.edge + scans[k].lane);
    moves[k] = {up[k].words(), down[k].words()};
  }
}

template <class Shape, class Source, class Strains>
void scan_packs(const Strains& strains, const PackOf* packs, std::size_t count) {
  using One = Scan<Shape, Source>;
  constexpr int side = Strains::side;
  alignas(64) unsigned char room[side * sizeof(One)];
  auto* const scans = reinterpret_cast<One*>(room);
  Moves moves[side];
  for (int k = 0; k < side; ++k) {
    new (scans + k) One(packs[k]);
    if (scans[k].state.sample == 0) scans[k].start();
  }
  for (std::size_t from = 0; from < count; from += word) {
    const int here = count - from < word ? static_cast<int>(count - from) : word;
    if (here == word)
      follow(strains, scans, from, word, moves);
    else
      follow(strains, scans, from, here, moves);
    for (int k = 0; k < side; ++k) scans[k].turn(moves[k], from, here);
  }
  for (int k = 0; k < side; ++k)
    store(Shape(scans[k].state, scans[k].lane).at(scans[k].source, count - 1), scans[k].state.last + scans[k].lane);
}

template <class Shape, class Source>
void scan_all(const LaneRun* runs, std::size_t run_count, std::size_t count) {
  constexpr int most = float_pack_size == 16 ? 4 : 2;  // as many as the registers allow
  for_packs<most, Shape, Source>(runs, run_count, [&](const auto& strains, const PackOf* packs) {
    scan_packs<Shape, Source>(strains, packs, count);
  });
  for (const LaneRun* run = runs; run != runs + run_count; ++run)
    run->state->sample += static_cast<std::int32_t>(count);
}

void scan(const LaneRun* runs, std::size_t run_count, std::size_t count) {
  scan_all<WaveShape, FromWaves>(runs, run_count, count);
}

void scan_strains(const LaneRun* runs, std::size_t run_count, std::size_t count) {
  scan_all<StrainShape, FromStrains>(runs, run_count, count);
}

// ---- ranking of wires -------------------------------------------------------------------------------------

/// Returns the contribution of a range between two turning points to StrainMeasures::cycle_sum.
inline FloatPack cycle_share(const FloatPack& before, const FloatPack& now) {
  const FloatPack product = larger(larger(before, now), FloatPack{}) * (now - before);
  return larger(product, -product) * product * product;
}

/// Returns the contribution of a range between two turning points to StrainMeasures::range_sum.
inline FloatPack range_share(const FloatPack& before, const FloatPack& now) {
  const FloatPack range = now - before;
  return larger(range, -range) * range * range;
}

/// Ranks a pack of wires without a list of turns. A wire is followed as strain times its direction. The highest value is a
/// turning point when the strain has fallen from it by the gate. The first direction is assumed, which can miss one range below
/// the gate.
struct Ranking {
  const LaneRun* run;
  int lane;
  FloatPack below_gate, direction, turn, extreme, cycle_sum, range_sum, low, high;

  Ranking() = default;
  /// first: strain at the first sample of the history.
  Ranking(const PackOf& of, const FloatPack& first)
      : run(of.run), lane(of.lane), below_gate(FloatPack{} + of.run->state->below_gate) {
    const LaneRanks& ranks = *run->ranks;
    direction = load<FloatPack>(ranks.direction + lane);
    turn = load<FloatPack>(ranks.turn + lane);
    extreme = load<FloatPack>(ranks.extreme + lane);
    cycle_sum = load<FloatPack>(ranks.cycle_sum_to_turn + lane);
    range_sum = load<FloatPack>(ranks.range_sum_to_turn + lane);
    low = load<FloatPack>(ranks.low + lane);
    high = load<FloatPack>(ranks.high + lane);
    if (run->state->sample != 0) return;
    direction = FloatPack{} + 1.0f;
    cycle_sum = range_sum = FloatPack{};
    low = high = turn = extreme = first;
  }

  /// Takes the next strain. Returns the wires that have turned, for which turn_at() must follow.
  inline __attribute__((always_inline)) Mask next(const FloatPack& x) {
    const FloatPack y = direction * x;
    low = smaller(low, x);
    high = larger(high, x);
    extreme = larger(extreme, y);
    return greater(extreme - y, below_gate);
  }

  /// x: the strain at which they turned.
  inline void turn_at(const Mask& turned, const FloatPack& x) {
    const FloatPack now = direction * extreme;
    cycle_sum += select(turned, cycle_share(turn, now), FloatPack{});
    range_sum += select(turned, range_share(turn, now), FloatPack{});
    turn = select(turned, now, turn);
    extreme = select(turned, -(direction * x), extreme);
    direction = select(turned, -direction, direction);
  }

  void keep(const FloatPack& last) const {
    LaneRanks& ranks = *run->ranks;
    store(direction, ranks.direction + lane);
    store(turn, ranks.turn + lane);
    store(extreme, ranks.extreme + lane);
    store(cycle_sum, ranks.cycle_sum_to_turn + lane);
    store(range_sum, ranks.range_sum_to_turn + lane);
    store(low, ranks.low + lane);
    store(high, ranks.high + lane);
    const FloatPack peak = direction * extreme;
    store(FloatPack(cycle_sum + cycle_share(turn, peak) + cycle_share(peak, last)), ranks.cycle_sum + lane);
    store(FloatPack(range_sum + range_share(turn, peak) + range_share(peak, last)), ranks.range_sum + lane);
  }
};

template <class Strains>
void rank_packs(const Strains& strains, const PackOf* packs, std::size_t count) {
  constexpr int side = Strains::side;
  FloatPack x[side];
  Ranking ranking[side];
  strains.at(0, x);
  for (int k = 0; k < side; ++k) ranking[k] = Ranking(packs[k], x[k]);
  for (std::size_t t = 0; t < count; ++t) {
    strains.at(t, x);
    Mask turned[side];
    unsigned any = 0;
    for (int k = 0; k < side; ++k) {
      turned[k] = ranking[k].next(x[k]);
      any |= bits(turned[k]);
    }
    if (any == 0) continue;  // a wire turns at one of a hundred samples
    for (int k = 0; k < side; ++k) ranking[k].turn_at(turned[k], x[k]);
  }
  for (int k = 0; k < side; ++k) ranking[k].keep(x[k]);
}

template <class Shape, class Source>
void rank_all(const LaneRun* runs, std::size_t run_count, std::size_t count) {
  constexpr int most = float_pack_size == 16 ? 4 : 2;
  for_packs<most, Shape, Source>(runs, run_count,
                                 [&](const auto& strains, const PackOf* packs) { rank_packs(strains, packs, count); });
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
