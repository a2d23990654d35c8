// The loop of lockstep.h for one instruction set. portable.cpp, avx2.cpp and avx512.cpp include this file, each for its own set
// (pipeline/base/simd.h).
#pragma once

#include "fatigue/kernels/lockstep.h"
#include "pipeline/base/simd.h"

namespace dresslife::fatigue::DRESSLIFE_LOCKSTEP {

using namespace simd;

#define DRESSLIFE_INLINE __attribute__((always_inline)) inline

constexpr std::size_t lanes = pack_size;
constexpr unsigned all_lanes = (1u << lanes) - 1;

// ---- tables -----------------------------------------------------------------------------------------------

/// Reads a LogTable for several values. Precondition: x within the table.
inline Pack looked_up(const LogTable::View& table, const Pack& x) {
  constexpr int below = 52 - LogTable::cells_per_octave_log2;
  const LongPack cell = leading_bits<below>(x) - LongPack(static_cast<std::int64_t>(table.first));
  const Pack t = fraction_below<below>(x);
  const Four c = gathered_fours(table.cells, shifted_left<2>(cell));
  return c.c0 + t * (c.c1 + t * (c.c2 + t * c.c3));
}

// ---- material ---------------------------------------------------------------------------------------------

inline bool beyond_table(const LockstepTables& tables, double range) {
  return tables.branch.cells != nullptr && range > tables.branch.high;
}

/// Returns the stress range of a branch. Precondition: all ranges are within the table.
inline Pack branch(const LockstepTables& tables, const Pack& range) {
  const Pack straight = tables.elastic * range;
  if (tables.branch.cells == nullptr) return straight;
  const Pack low = Pack(tables.branch.low);
  return select(greater(low, range), straight, looked_up(tables.branch, larger(range, low)));
}

inline Pack branch_one_by_one(const LockstepTables& tables, const Pack& range) {
  double ranges[lanes], stress[lanes];
  store(range, ranges);
  store(branch(tables, tables.branch.cells ? smaller(range, Pack(tables.branch.high)) : range), stress);
  for (std::size_t lane = 0; lane < lanes; ++lane)
    if (beyond_table(tables, ranges[lane])) stress[lane] = tables.far_branch(tables.material, ranges[lane]);
  return load<Pack>(stress);
}

/// A closed loop in each lane.
struct LaneLoads {
  Pack amplitude, stress_max, stress_min;
};

/// Returns the damage of the lanes in `closing`; 0 for the others.
inline Pack damage_of(const LockstepTables& tables, const DoubleMask& closing, const LaneLoads& loop) {
  const LogTable::View& table = tables.damage;
  const Pack low = Pack(table.low), high = Pack(table.high);
  const Pack y = tables.times_stress_max ? loop.amplitude * loop.stress_max : loop.amplitude;
  const DoubleMask damaging = closing & at_least(y, low) & greater(loop.amplitude, Pack(tables.endurance));
  if (bits(damaging) == 0) return Pack{};
  const Pack damage = looked_up(table, smaller(larger(y, low), high));
  return select(damaging, select(at_least(y, high), Pack(tables.damage_at_high), damage), Pack{});
}

inline Pack damage_one_by_one(const LockstepTables& tables, const DoubleMask& closing, const LaneLoads& loop) {
  if (tables.damage_of == nullptr) return damage_of(tables, closing, loop);
  double amplitude[lanes], max[lanes], min[lanes], damage[lanes] = {};
  store(loop.amplitude, amplitude), store(loop.stress_max, max), store(loop.stress_min, min);
  for (unsigned left = bits(closing); left != 0; left &= left - 1) {
    const int j = __builtin_ctz(left);
    if (amplitude[j] > tables.endurance)
      damage[j] = tables.damage_of(tables.material, amplitude[j], max[j], max[j] / 2 + min[j] / 2);
  }
  return load<Pack>(damage);
}

// ---- the loops of all lanes -------------------------------------------------------------------------------

/// The reversals of open loops, (row, lane). Row d is the reversal at depth d; row 1 is the largest strain L. Rows start at -1.
struct OpenRows {
  double *strain, *stress;

  void put(std::int64_t row, const Pack& strains, const Pack& stresses) const {
    store(strains, strain + row * std::int64_t{lanes});
    store(stresses, stress + row * std::int64_t{lanes});
  }
  /// Writes a different row for each lane, without a branch, because the processor cannot predict which lanes differ.
  void put_apart(const LongPack& row, const Pack& strains, const Pack& stresses) const {
    const LongPack place = places(row);
    scattered(strains, strain, place);
    scattered(stresses, stress, place);
  }
};

/// The two topmost open reversals.
struct Top {
  Pack strain, below, stress, stress_below;

  static Top of(const OpenRows& rows, std::int64_t row) {
    const double* const e = rows.strain + row * std::int64_t{lanes};
    const double* const s = rows.stress + row * std::int64_t{lanes};
    return {load<Pack>(e), load<Pack>(e - lanes), load<Pack>(s), load<Pack>(s - lanes)};
  }
  static Top apart(const OpenRows& rows, const LongPack& row) {
    const LongPack place = places(row);
    return {gathered(rows.strain, place), gathered(rows.strain - lanes, place), gathered(rows.stress, place),
            gathered(rows.stress - lanes, place)};
  }
};

/// Processes one period of a history in each lane, which starts and ends with its largest strain L >= 0. A lane whose largest
/// strain is compression is mirrored. Row 0 is -L, with the stress from which a branch leads to that at L. The path never goes
/// beyond -L, so no loop closes below L. When a step back to L has closed every loop, the branch from row 0 leads to L again,
/// for any relaxed stress.
template <bool one_by_one>
class Loops {
 public:
  DRESSLIFE_INLINE Loops(const LockstepTables& tables, const Pack& largest, const Pack& sign,
                         const double* first_stress, const OpenRows& rows)
      : tables_(tables), rows_(rows), mirrored_(greater(Pack{}, sign)) {
    const Pack branch_to_largest = branch_of(2 * largest);
    const Pack first = first_stress ? load<Pack>(first_stress) : branch_to_largest / 2;
    constexpr double more = 1 + 0x1p-52, smallest = 0x1p-1000;
    rows_.put(-1, Pack(__builtin_inf()), first);
    rows_.put(0, -largest * more - smallest, first - branch_to_largest);
    rows_.put(1, largest, first);
    top_ = Top::of(rows_, 1);
  }

  template <bool falls>
  DRESSLIFE_INLINE void go_to(const Pack& next) {
    amiss_ = amiss_ | (falls ? greater(next, top_.strain) : greater(top_.strain, next));
    for (;;) {
      const DoubleMask closing = falls ? at_least(top_.below, next) : at_least(next, top_.below);
      if (bits(closing) == 0) break;
      close<falls>(closing);
    }
    open<falls>(next);
  }

  const Pack& sum() const { return sum_; }
  unsigned amiss() const { return bits(amiss_); }  ///< lanes with a step in the wrong direction

 private:
  DRESSLIFE_INLINE Pack branch_of(const Pack& range) const {
    return one_by_one ? branch_one_by_one(tables_, range) : branch(tables_, range);
  }

  DRESSLIFE_INLINE bool agree() const { return lanes == 1 || agree_; }

  template <bool falls>
  DRESSLIFE_INLINE void close(const DoubleMask& closing) {
    const Pack amplitude = (falls ? top_.strain - top_.below : top_.below - top_.strain) * 0.5;
    const Pack peak = falls ? top_.stress : top_.stress_below, valley = falls ? top_.stress_below : top_.stress;
    const LaneLoads loop{amplitude, select(mirrored_, -valley, peak), select(mirrored_, -peak, valley)};
    sum_ += one_by_one ? damage_one_by_one(tables_, closing, loop) : damage_of(tables_, closing, loop);
    depth_ = select(closing, depth_ - 2, depth_);
    if (agree() && bits(closing) == all_lanes) {
      common_ -= 2;
      top_ = Top::of(rows_, common_);
    } else {
      top_ = Top::apart(rows_, depth_);
      common_ = first_lane(depth_);
      agree_ = bits(equal(depth_, common_)) == all_lanes;
    }
  }

  template <bool falls>
  DRESSLIFE_INLINE void open(const Pack& next) {
    const Pack stress = branch_of(falls ? top_.strain - next : next - top_.strain);
    top_ = {next, top_.strain, falls ? top_.stress - stress : top_.stress + stress, top_.stress};
    depth_ += 1;
    ++common_;
    if (agree()) {
      rows_.put(common_, top_.strain, top_.stress);
    } else {
      rows_.put_apart(depth_, top_.strain, top_.stress);
    }
  }

  const LockstepTables tables_;
  const OpenRows rows_;
  const DoubleMask mirrored_;
  Top top_;
  Pack sum_{};
  LongPack depth_ = 1;
  std::int64_t common_ = 1;  // depth of all lanes, if they agree
  bool agree_ = true;
  DoubleMask amiss_{};
};

// ---- periods ----------------------------------------------------------------------------------------------

constexpr std::size_t float_lanes = sizeof(FloatPack) / sizeof(float);

/// Returns the index of the largest |strain|, the first one.
inline std::size_t largest_of(const StrainList& list) {
  const auto sizes_at = [&](std::size_t i) { return size_of(load_some(list.strain + i, list.size - i)); };
  FloatPack sizes = sizes_at(0);
  for (std::size_t i = float_lanes; i < list.size; i += float_lanes) sizes = larger(sizes, sizes_at(i));
  const FloatPack largest = FloatPack(largest_lane(sizes));
  for (std::size_t i = 0; i < list.size; i += float_lanes)
    if (const unsigned found = bits(equal(sizes_at(i), largest))) return i + __builtin_ctz(found);
  return 0;
}

/// One period of a history, equal to that of rotate_to_largest() for an alternating history.
struct Period {
  float largest = 0;        ///< L
  float sign = 1;           ///< -1: mirrored
  std::size_t steps = 0;    ///< number of steps from L to L
  double first_stress = 0;  ///< at L, if LockstepTables has a function for it
};

/// Returns the largest minus the smallest strain. Precondition: not empty.
inline double range_of(const StrainList& list) {
  FloatPack low(list.strain[0]), high(list.strain[0]);
  const std::size_t whole = list.size - list.size % float_lanes;
  for (std::size_t i = 0; i < whole; i += float_lanes) {
    const FloatPack now = load_some(list.strain + i, float_lanes);
    low = smaller(low, now), high = larger(high, now);
  }
  float lowest = -largest_lane(-low), highest = largest_lane(high);
  for (std::size_t i = whole; i < list.size; ++i) {
    lowest = list.strain[i] < lowest ? list.strain[i] : lowest;
    highest = list.strain[i] > highest ? list.strain[i] : highest;
  }
  return double{highest} - double{lowest};
}

/// Writes the strains after the first L, and up to float_lanes more numbers. At the joint of the history's end ... a b and its
/// begin c d ... a reversal that the next one continues or repeats is dropped.
inline Period rotated(const StrainList& list, float* to) {
  if (list.size < 2) return {};
  const float* const h = list.strain;
  const std::size_t n = list.size, at = largest_of(list);
  const float a = h[n - 2], b = h[n - 1], c = h[0], d = h[1];
  const bool drop_b = at < n - 1 && (b == c || (b > a) == (c > b));
  const bool drop_c = at > 0 && (c > (drop_b ? a : b)) == (d > c);
  const float sign = h[at] < 0 ? -1 : 1;
  std::size_t steps = 0;
  const auto copy = [&](std::size_t from, std::size_t end) {
    for (std::size_t i = from; i < end; i += float_lanes)
      store(FloatPack(sign) * load_some(h + i, end - i), to + steps + (i - from));
    steps += end - from;
  };
  copy(at + 1, drop_b ? n - 1 : n);
  copy(drop_c ? 1 : 0, at + 1);
  return {sign * h[at], sign, steps};
}

/// Data of one call: the periods of the lanes, and memory for their loops.
struct Periods {
  Period of[lanes];
  float* strains;  ///< (lane, step)
  std::size_t stride;
  OpenRows open;
};

constexpr std::size_t steps_at_once = lanes > 2 ? lanes : 2;

/// Computes the damage of the lanes in `which`. Returns the lanes with a step in the wrong direction.
template <bool one_by_one>
unsigned sum_lanes(const LockstepTables& tables, const Periods& periods, unsigned which, double* damage) {
  double largest[lanes] = {}, sign[lanes] = {}, first_stress[lanes] = {};
  std::size_t steps = 0;
  for (std::size_t j = 0; j < lanes; ++j)
    if (which >> j & 1) {
      const Period& period = periods.of[j];
      largest[j] = period.largest, sign[j] = period.sign, first_stress[j] = period.first_stress;
      steps = period.steps > steps ? period.steps : steps;
    }
  steps += steps % 2;
  for (std::size_t j = 0; j < lanes; ++j)  // shorter periods stay at L
    for (std::size_t i = which >> j & 1 ? periods.of[j].steps : 0; i < steps; ++i)
      periods.strains[j * periods.stride + i] = static_cast<float>(largest[j]);

  Loops<one_by_one> loops(tables, load<Pack>(largest), load<Pack>(sign), tables.first_stress ? first_stress : nullptr,
                          periods.open);
  for (std::size_t first = 0; first < steps; first += steps_at_once) {
    float rows[steps_at_once * lanes];
    for (std::size_t i = 0; i < steps_at_once; i += lanes)
      transpose(periods.strains + first + i, periods.stride, rows + i * lanes);
    const std::size_t count = steps - first < steps_at_once ? steps - first : steps_at_once;
    for (std::size_t i = 0; i < count; i += 2) {
      loops.template go_to<true>(in_double(load<HalfPack>(rows + i * lanes)));
      loops.template go_to<false>(in_double(load<HalfPack>(rows + (i + 1) * lanes)));
    }
  }
  double sums[lanes];
  store(loops.sum(), sums);
  for (unsigned left = which; left != 0; left &= left - 1) damage[__builtin_ctz(left)] = sums[__builtin_ctz(left)];
  return loops.amiss() & which;
}

/// Return the number of lines of one stack of open reversals, and of strains of one lane, for up to `longest` reversals.
constexpr std::size_t stack_lines(std::size_t longest) {
  return ((longest + 4) * lanes * sizeof(double) - 1) / sizeof(LockstepLine) + 1;
}
constexpr std::size_t stride_of(std::size_t longest) { return (longest / 16 + 3) * 16; }

std::size_t lines(std::size_t longest) {
  return 2 * stack_lines(longest) + stride_of(longest) * lanes * sizeof(float) / sizeof(LockstepLine);
}

unsigned sum(const LockstepTables& tables, const StrainList* histories, std::size_t count, LockstepLine* memory,
             double* damage) {
  std::size_t longest = 0;
  for (std::size_t j = 0; j < count; ++j) longest = histories[j].size > longest ? histories[j].size : longest;
  Periods periods;
  const std::size_t stack = stack_lines(longest);
  periods.stride = stride_of(longest);
  periods.strains = reinterpret_cast<float*>(memory + 2 * stack);
  periods.open = {reinterpret_cast<double*>(memory) + lanes, reinterpret_cast<double*>(memory + stack) + lanes};
  unsigned by_table = 0, one_by_one = 0;  // lanes
  for (std::size_t j = 0; j < count; ++j) {
    Period& period = periods.of[j];
    period = rotated(histories[j], periods.strains + j * periods.stride);
    if (tables.first_stress != nullptr && period.steps > 0)
      period.first_stress = tables.first_stress(tables.material, double{period.sign} * double{period.largest},
                                                range_of(histories[j]), histories[j].share);
    const bool far = beyond_table(tables, 2 * double{periods.of[j].largest});
    (far || tables.damage_of != nullptr ? one_by_one : by_table) |= 1u << j;
  }
  unsigned amiss = 0;
  if (by_table != 0) amiss |= sum_lanes<false>(tables, periods, by_table, damage);
  if (one_by_one == 0) return amiss;
  for (std::size_t j = 0; by_table != 0 && j < count; ++j)  // again, because the first pass has overwritten the strains
    rotated(histories[j], periods.strains + j * periods.stride);
  return amiss | sum_lanes<true>(tables, periods, one_by_one, damage);
}

extern const Lockstep set;
const Lockstep set{lanes, lines, sum};

}  // namespace dresslife::fatigue::DRESSLIFE_LOCKSTEP
