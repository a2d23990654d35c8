// The loop of lockstep.h for one instruction set. Included once by each lockstep_*.cpp, which names the
// instruction set and how wide its registers are.
#pragma once

#ifndef DRESSLIFE_REGISTER_BYTES
#error "lockstep_body.h belongs to the files that name their instruction set and how wide it is"
#endif

namespace dresslife::fatigue::DRESSLIFE_MACHINE {

#define DRESSLIFE_INLINE __attribute__((always_inline)) inline

// ---- numbers side by side: all that instruction sets do differently --------------------------------------

constexpr std::size_t lanes = DRESSLIFE_REGISTER_BYTES / sizeof(double);
constexpr unsigned all_lanes = (1u << lanes) - 1;

template <class Vector, class Value>
inline Vector load(const Value* from) {
  Vector vector;
  __builtin_memcpy(&vector, from, sizeof(vector));
  return vector;
}

template <class Vector, class Value>
inline void store(const Vector& vector, Value* to) {
  __builtin_memcpy(to, &vector, sizeof(vector));
}

#if DRESSLIFE_REGISTER_BYTES == 64

typedef double Pack __attribute__((vector_size(64)));
typedef std::int64_t IntPack __attribute__((vector_size(64)));
typedef std::uint64_t WordPack __attribute__((vector_size(64)));
typedef __mmask8 Mask;
inline Pack filled(double value) { return _mm512_set1_pd(value); }
inline Mask at_least(const Pack& a, const Pack& b) { return _mm512_cmp_pd_mask(a, b, _CMP_GE_OQ); }
inline Mask greater(const Pack& a, const Pack& b) { return _mm512_cmp_pd_mask(a, b, _CMP_GT_OQ); }
inline Mask equal(const IntPack& a, std::int64_t b) {
  return _mm512_cmpeq_epi64_mask(reinterpret_cast<__m512i>(a), _mm512_set1_epi64(b));
}
inline unsigned bits(Mask mask) { return mask; }  ///< bit j: of lane j
inline Pack select(Mask mask, const Pack& yes, const Pack& no) { return _mm512_mask_blend_pd(mask, no, yes); }
inline IntPack two_less(Mask where, const IntPack& from) {
  const __m512i a = reinterpret_cast<__m512i>(from);
  return reinterpret_cast<IntPack>(_mm512_mask_sub_epi64(a, where, a, _mm512_set1_epi64(2)));
}
// Where a is no number, b:
inline Pack larger(const Pack& a, const Pack& b) { return _mm512_max_pd(a, b); }
inline Pack smaller(const Pack& a, const Pack& b) { return _mm512_min_pd(a, b); }
inline Pack widened(const float* from) { return _mm512_cvtps_pd(_mm256_loadu_ps(from)); }

typedef float FloatPack __attribute__((vector_size(64)));
inline FloatPack filled_floats(float value) { return _mm512_set1_ps(value); }
/// The first `count` of them, then zeros.
inline FloatPack load_some(const float* from, std::size_t count) {
  return _mm512_maskz_loadu_ps(count < 16 ? (1u << count) - 1 : 0xffff, from);
}
inline FloatPack size_of(const FloatPack& a) { return _mm512_abs_ps(a); }
inline FloatPack larger(const FloatPack& a, const FloatPack& b) { return _mm512_max_ps(a, b); }
inline float largest_lane(const FloatPack& a) { return _mm512_reduce_max_ps(a); }
inline unsigned equal(const FloatPack& a, const FloatPack& b) { return _mm512_cmp_ps_mask(a, b, _CMP_EQ_OQ); }
/// to[step * lanes + lane] = from[lane * stride + step] of `lanes` steps.
inline void transpose(const float* from, std::size_t stride, float* to) {
  const auto half = [&](std::size_t lane, std::size_t half_lane) {  // four steps of two lanes
    const __m128 first = _mm_loadu_ps(from + lane * stride + half_lane);
    const __m128 second = _mm_loadu_ps(from + (lane + 4) * stride + half_lane);
    return _mm256_insertf128_ps(_mm256_castps128_ps256(first), second, 1);
  };
  for (std::size_t step = 0; step < 8; step += 4) {
    const __m256 a = half(0, step), b = half(1, step), c = half(2, step), d = half(3, step);
    const __m256 ab01 = _mm256_unpacklo_ps(a, b), ab23 = _mm256_unpackhi_ps(a, b);
    const __m256 cd01 = _mm256_unpacklo_ps(c, d), cd23 = _mm256_unpackhi_ps(c, d);
    _mm256_storeu_ps(to + 8 * step, _mm256_shuffle_ps(ab01, cd01, 0x44));
    _mm256_storeu_ps(to + 8 * step + 8, _mm256_shuffle_ps(ab01, cd01, 0xee));
    _mm256_storeu_ps(to + 8 * step + 16, _mm256_shuffle_ps(ab23, cd23, 0x44));
    _mm256_storeu_ps(to + 8 * step + 24, _mm256_shuffle_ps(ab23, cd23, 0xee));
  }
}

#elif DRESSLIFE_REGISTER_BYTES == 32

typedef double Pack __attribute__((vector_size(32)));
typedef std::int64_t IntPack __attribute__((vector_size(32)));
typedef std::uint64_t WordPack __attribute__((vector_size(32)));
typedef IntPack Mask;
inline Pack filled(double value) { return _mm256_set1_pd(value); }
inline Mask at_least(const Pack& a, const Pack& b) { return a >= b; }
inline Mask greater(const Pack& a, const Pack& b) { return a > b; }
inline Mask equal(const IntPack& a, std::int64_t b) { return a == b; }
inline unsigned bits(const Mask& mask) { return _mm256_movemask_pd(reinterpret_cast<__m256d>(mask)); }
inline Pack select(const Mask& mask, const Pack& yes, const Pack& no) {
  return _mm256_blendv_pd(no, yes, reinterpret_cast<__m256d>(mask));
}
inline IntPack two_less(const Mask& where, const IntPack& from) { return from + where + where; }
inline Pack larger(const Pack& a, const Pack& b) { return _mm256_max_pd(a, b); }
inline Pack smaller(const Pack& a, const Pack& b) { return _mm256_min_pd(a, b); }
inline Pack widened(const float* from) { return _mm256_cvtps_pd(_mm_loadu_ps(from)); }

typedef float FloatPack __attribute__((vector_size(32)));
inline FloatPack filled_floats(float value) { return _mm256_set1_ps(value); }
/// The first `count` of them, then zeros.
inline FloatPack load_some(const float* from, std::size_t count) {
  if (count >= 8) return _mm256_loadu_ps(from);
  const __m256i place = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  return _mm256_maskload_ps(from, _mm256_cmpgt_epi32(_mm256_set1_epi32(static_cast<int>(count)), place));
}
inline FloatPack size_of(const FloatPack& a) { return _mm256_andnot_ps(_mm256_set1_ps(-0.0f), a); }
inline FloatPack larger(const FloatPack& a, const FloatPack& b) { return _mm256_max_ps(a, b); }
inline float largest_lane(const FloatPack& a) {
  const __m128 four = _mm_max_ps(_mm256_castps256_ps128(a), _mm256_extractf128_ps(a, 1));
  const __m128 two = _mm_max_ps(four, _mm_movehl_ps(four, four));
  return _mm_cvtss_f32(_mm_max_ss(two, _mm_movehdup_ps(two)));
}
inline unsigned equal(const FloatPack& a, const FloatPack& b) {
  return _mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_EQ_OQ));
}
/// to[step * lanes + lane] = from[lane * stride + step] of `lanes` steps.
inline void transpose(const float* from, std::size_t stride, float* to) {
  __m128 a = _mm_loadu_ps(from), b = _mm_loadu_ps(from + stride);
  __m128 c = _mm_loadu_ps(from + 2 * stride), d = _mm_loadu_ps(from + 3 * stride);
  _MM_TRANSPOSE4_PS(a, b, c, d);
  _mm_storeu_ps(to, a), _mm_storeu_ps(to + 4, b), _mm_storeu_ps(to + 8, c), _mm_storeu_ps(to + 12, d);
}

#else  // one lane: packs of two numbers gain nothing over the tables' look-ups

typedef double Pack;
typedef std::int64_t IntPack;
typedef std::uint64_t WordPack;
typedef bool Mask;
inline Pack filled(double value) { return value; }
inline Mask at_least(Pack a, Pack b) { return a >= b; }
inline Mask greater(Pack a, Pack b) { return a > b; }
inline Mask equal(IntPack a, IntPack b) { return a == b; }
inline unsigned bits(Mask mask) { return mask; }
inline Pack select(Mask mask, Pack yes, Pack no) { return mask ? yes : no; }
inline IntPack two_less(Mask where, IntPack from) { return where ? from - 2 : from; }
inline Pack larger(Pack a, Pack b) { return a > b ? a : b; }
inline Pack smaller(Pack a, Pack b) { return a < b ? a : b; }
inline Pack widened(const float* from) { return *from; }

typedef float FloatPack __attribute__((vector_size(16)));
inline FloatPack filled_floats(float value) { return FloatPack{value, value, value, value}; }
/// The first `count` of them, then zeros.
inline FloatPack load_some(const float* from, std::size_t count) {
  if (count >= 4) return load<FloatPack>(from);
  return FloatPack{count > 0 ? from[0] : 0, count > 1 ? from[1] : 0, count > 2 ? from[2] : 0, 0};
}
inline FloatPack size_of(const FloatPack& a) { return a < 0.0f ? -a : a; }
inline FloatPack larger(const FloatPack& a, const FloatPack& b) { return a > b ? a : b; }
inline float largest_lane(const FloatPack& a) {
  const float first = a[0] > a[1] ? a[0] : a[1], second = a[2] > a[3] ? a[2] : a[3];
  return first > second ? first : second;
}
inline unsigned equal(const FloatPack& a, const FloatPack& b) {
  const auto same = a == b;
  return (same[0] & 1) | (same[1] & 2) | (same[2] & 4) | (same[3] & 8);
}
inline void transpose(const float* from, std::size_t, float* to) { *to = *from; }

#endif

inline std::int64_t first_of(const IntPack& a) { return load<std::int64_t>(&a); }

// ---- tables -----------------------------------------------------------------------------------------------

struct Cubic {
  Pack c0, c1, c2, c3;
};

/// Of each lane j the four numbers that lie offset[j] bytes on.
inline Cubic gathered(const double* cells, const WordPack& offset) {
#if DRESSLIFE_REGISTER_BYTES == 8
  const double* const c = cells + offset / sizeof(double);
  return {c[0], c[1], c[2], c[3]};
#else
  std::uint64_t at[lanes];
  store(offset, at);
  asm("" : "+m"(at));  // through memory: taking them out of the register costs twice as much
  const auto cell = [&](std::size_t lane) { return cells + at[lane] / sizeof(double); };
#endif
#if DRESSLIFE_REGISTER_BYTES == 64
  const auto two = [&](std::size_t lane) {
    const __m256d first = _mm256_load_pd(cell(lane)), second = _mm256_load_pd(cell(lane + 4));
    return _mm512_insertf64x4(_mm512_castpd256_pd512(first), second, 1);
  };
  const __m512d a = two(0), b = two(1), c = two(2), d = two(3);
  const __m512d ab0 = _mm512_unpacklo_pd(a, b), ab1 = _mm512_unpackhi_pd(a, b);
  const __m512d cd0 = _mm512_unpacklo_pd(c, d), cd1 = _mm512_unpackhi_pd(c, d);
  const __m512i low = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
  const __m512i high = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
  return {_mm512_permutex2var_pd(ab0, low, cd0), _mm512_permutex2var_pd(ab1, low, cd1),
          _mm512_permutex2var_pd(ab0, high, cd0), _mm512_permutex2var_pd(ab1, high, cd1)};
#elif DRESSLIFE_REGISTER_BYTES == 32
  const __m256d a = _mm256_load_pd(cell(0)), b = _mm256_load_pd(cell(1));
  const __m256d c = _mm256_load_pd(cell(2)), d = _mm256_load_pd(cell(3));
  const __m256d ab0 = _mm256_unpacklo_pd(a, b), ab1 = _mm256_unpackhi_pd(a, b);
  const __m256d cd0 = _mm256_unpacklo_pd(c, d), cd1 = _mm256_unpackhi_pd(c, d);
  return {_mm256_permute2f128_pd(ab0, cd0, 0x20), _mm256_permute2f128_pd(ab1, cd1, 0x20),
          _mm256_permute2f128_pd(ab0, cd0, 0x31), _mm256_permute2f128_pd(ab1, cd1, 0x31)};
#endif
}

/// As LogTable. Precondition: x within the table.
inline Pack looked_up(const LogTable::View& table, const Pack& x) {
  constexpr std::uint64_t mantissa = (std::uint64_t{1} << 52) - 1, one = std::uint64_t{0x3ff} << 52;
  constexpr int in_octave = LogTable::cells_per_octave_log2;
  constexpr std::uint64_t cell_bytes = 4 * sizeof(double);
  WordPack word;
  __builtin_memcpy(&word, &x, sizeof(x));
  const WordPack offset = (word >> (52 - in_octave)) * cell_bytes - table.first * cell_bytes;
  const WordPack fraction = ((word << in_octave) & mantissa) | one;
  Pack t;
  __builtin_memcpy(&t, &fraction, sizeof(t));
  t = t - 1.0;
  const Cubic c = gathered(table.cells, offset);
  return c.c0 + t * (c.c1 + t * (c.c2 + t * c.c3));
}

// ---- material ---------------------------------------------------------------------------------------------

inline bool beyond_table(const LockstepTables& tables, double range) {
  return tables.branch.cells != nullptr && range > tables.branch.high;
}

/// Stress range of a branch. Precondition: none of the ranges is beyond the table.
inline Pack branch(const LockstepTables& tables, const Pack& range) {
  const Pack straight = tables.elastic * range;
  if (tables.branch.cells == nullptr) return straight;
  const Pack low = filled(tables.branch.low);
  return select(greater(low, range), straight, looked_up(tables.branch, larger(range, low)));
}

inline Pack branch_one_by_one(const LockstepTables& tables, const Pack& range) {
  double ranges[lanes], stress[lanes];
  store(range, ranges);
  store(branch(tables, tables.branch.cells ? smaller(range, filled(tables.branch.high)) : range), stress);
  for (std::size_t lane = 0; lane < lanes; ++lane)
    if (beyond_table(tables, ranges[lane])) stress[lane] = tables.far_branch(tables.material, ranges[lane]);
  return load<Pack>(stress);
}

/// A closed loop in each lane.
struct Load {
  Pack amplitude, stress_max, stress_min;
};

/// Of the lanes in `closing`; of the others 0.
inline Pack damage_of(const LockstepTables& tables, const Mask& closing, const Load& loop) {
  const LogTable::View& table = tables.damage;
  const Pack low = filled(table.low), high = filled(table.high);
  const Pack y = tables.times_stress_max ? loop.amplitude * loop.stress_max : loop.amplitude;
  const Mask damaging = closing & at_least(y, low) & greater(loop.amplitude, filled(tables.endurance));
  if (bits(damaging) == 0) return Pack{};
  const Pack damage = looked_up(table, smaller(larger(y, low), high));
  return select(damaging, select(at_least(y, high), filled(tables.damage_at_high), damage), Pack{});
}

inline Pack damage_one_by_one(const LockstepTables& tables, const Mask& closing, const Load& loop) {
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

/// The reversals of the loops still open, (row, lane): row d holds the one number d, row 1 being the largest
/// strain L. Rows from -1 on.
struct OpenRows {
  double *strain, *stress;

  void put(std::int64_t row, const Pack& strains, const Pack& stresses) const {
    store(strains, strain + row * std::int64_t{lanes});
    store(stresses, stress + row * std::int64_t{lanes});
  }
  void put_where(const Mask& where, std::int64_t row, const Pack& strains, const Pack& stresses) const {
    put(row, select(where, strains, load<Pack>(strain + row * std::int64_t{lanes})),
        select(where, stresses, load<Pack>(stress + row * std::int64_t{lanes})));
  }
};

/// The two topmost of them, and where they are.
struct Top {
  Pack strain, below, stress, stress_below;

  static Top of(const OpenRows& rows, std::int64_t row) {
    const double* const e = rows.strain + row * std::int64_t{lanes};
    const double* const s = rows.stress + row * std::int64_t{lanes};
    return {load<Pack>(e), load<Pack>(e - lanes), load<Pack>(s), load<Pack>(s - lanes)};
  }
};

/// Top::of(), where lanes are at different rows.
DRESSLIFE_INLINE void take_apart(const OpenRows& rows, const IntPack& depth, Top& top) {
  std::int64_t row[lanes];
  store(depth, row);
  for (unsigned left = all_lanes; left != 0;) {
    const std::int64_t of = row[__builtin_ctz(left)];
    const Mask same = equal(depth, of);
    const Top there = Top::of(rows, of);
    top.strain = select(same, there.strain, top.strain);
    top.below = select(same, there.below, top.below);
    top.stress = select(same, there.stress, top.stress);
    top.stress_below = select(same, there.stress_below, top.stress_below);
    left &= ~bits(same);
  }
}

DRESSLIFE_INLINE void put_apart(const OpenRows& rows, const IntPack& depth, const Pack& strain,
                                const Pack& stress) {
  std::int64_t row[lanes];
  store(depth, row);
  for (unsigned left = all_lanes; left != 0;) {
    const std::int64_t of = row[__builtin_ctz(left)];
    const Mask same = equal(depth, of);
    rows.put_where(same, of, strain, stress);
    left &= ~bits(same);
  }
}

/// Goes through one period of a history in each lane, which starts and ends with its largest strain L >= 0;
/// where that was compression the lane is mirrored. Row 0 holds the mirrored tip of the outermost loop, -L on
/// the cyclic curve: the path never goes beyond it, so nothing closes below L, and when a step back to L has
/// closed everything, the branch from there leads to L again.
template <bool one_by_one>
class Loops {
 public:
  DRESSLIFE_INLINE Loops(const LockstepTables& tables, const Pack& largest, const Pack& sign,
                         const OpenRows& rows)
      : tables_(tables), rows_(rows), mirrored_(greater(Pack{}, sign)) {
    const Pack first = branch_of(2 * largest) / 2;
    constexpr double more = 1 + 0x1p-52, smallest = 0x1p-1000;
    rows_.put(-1, filled(__builtin_inf()), first);
    rows_.put(0, -largest * more - smallest, -first);
    rows_.put(1, largest, first);
    top_ = Top::of(rows_, 1);
  }

  template <bool falls>
  DRESSLIFE_INLINE void go_to(const Pack& next) {
    amiss_ |= falls ? greater(next, top_.strain) : greater(top_.strain, next);
    for (;;) {
      const Mask closing = falls ? at_least(top_.below, next) : at_least(next, top_.below);
      if (bits(closing) == 0) break;
      close<falls>(closing);
    }
    open<falls>(next);
  }

  const Pack& sum() const { return sum_; }
  unsigned amiss() const { return bits(amiss_); }  ///< lanes in which a step went the wrong way

 private:
  DRESSLIFE_INLINE Pack branch_of(const Pack& range) const {
    return one_by_one ? branch_one_by_one(tables_, range) : branch(tables_, range);
  }

  DRESSLIFE_INLINE bool agree() const { return lanes == 1 || agree_; }

  template <bool falls>
  DRESSLIFE_INLINE void close(const Mask& closing) {
    const Pack amplitude = (falls ? top_.strain - top_.below : top_.below - top_.strain) * 0.5;
    const Pack peak = falls ? top_.stress : top_.stress_below,
               valley = falls ? top_.stress_below : top_.stress;
    const Load loop{amplitude, select(mirrored_, -valley, peak), select(mirrored_, -peak, valley)};
    sum_ += one_by_one ? damage_one_by_one(tables_, closing, loop) : damage_of(tables_, closing, loop);
    depth_ = two_less(closing, depth_);
    if (agree() && bits(closing) == all_lanes) {
      common_ -= 2;
      top_ = Top::of(rows_, common_);
    } else {
      take_apart(rows_, depth_, top_);
      common_ = first_of(depth_);
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
      put_apart(rows_, depth_, top_.strain, top_.stress);
    }
  }

  const LockstepTables tables_;
  const OpenRows rows_;
  const Mask mirrored_;
  Top top_;
  Pack sum_{};
  IntPack depth_ = IntPack{} + 1;
  std::int64_t common_ = 1;  // depth of all lanes, where they agree
  bool agree_ = true;
  Mask amiss_{};
};

// ---- periods ----------------------------------------------------------------------------------------------

constexpr std::size_t float_lanes = sizeof(FloatPack) / sizeof(float);

/// Where the largest |strain| is, the first such.
inline std::size_t largest_of(const StrainList& list) {
  const auto sizes_at = [&](std::size_t i) { return size_of(load_some(list.strain + i, list.size - i)); };
  FloatPack sizes = sizes_at(0);
  for (std::size_t i = float_lanes; i < list.size; i += float_lanes) sizes = larger(sizes, sizes_at(i));
  const FloatPack largest = filled_floats(largest_lane(sizes));
  for (std::size_t i = 0; i < list.size; i += float_lanes)
    if (const unsigned found = equal(sizes_at(i), largest)) return i + __builtin_ctz(found);
  return 0;
}

/// One period of a history, as rotate_to_largest() makes it of one that alternates.
struct Period {
  float largest = 0;      ///< L
  float sign = 1;         ///< -1: mirrored
  std::size_t steps = 0;  ///< from L to L
};

/// Writes the strains after the first L, and up to float_lanes numbers more. Only the joint of the history's
/// end ... a b and its begin c d ... needs care: a reversal there that the next one continues, or repeats, is
/// none.
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
      store(filled_floats(sign) * load_some(h + i, end - i), to + steps + (i - from));
    steps += end - from;
  };
  copy(at + 1, drop_b ? n - 1 : n);
  copy(drop_c ? 1 : 0, at + 1);
  return {sign * h[at], sign, steps};
}

/// What a call works on: the lanes' periods, and memory for their loops.
struct Periods {
  Period of[lanes];
  float* strains;  ///< (lane, step)
  std::size_t stride;
  OpenRows open;
};

constexpr std::size_t steps_at_once = lanes > 2 ? lanes : 2;

/// Damage of the lanes in `which`. Returns those that go the wrong way somewhere.
template <bool one_by_one>
unsigned sum_lanes(const LockstepTables& tables, const Periods& periods, unsigned which, double* damage) {
  double largest[lanes] = {}, sign[lanes] = {};
  std::size_t steps = 0;
  for (std::size_t j = 0; j < lanes; ++j)
    if (which >> j & 1) {
      const Period& period = periods.of[j];
      largest[j] = period.largest, sign[j] = period.sign;
      steps = period.steps > steps ? period.steps : steps;
    }
  steps += steps % 2;
  for (std::size_t j = 0; j < lanes; ++j)  // shorter ones stay at L
    for (std::size_t i = which >> j & 1 ? periods.of[j].steps : 0; i < steps; ++i)
      periods.strains[j * periods.stride + i] = static_cast<float>(largest[j]);

  Loops<one_by_one> loops(tables, load<Pack>(largest), load<Pack>(sign), periods.open);
  for (std::size_t first = 0; first < steps; first += steps_at_once) {
    float rows[steps_at_once * lanes];
    for (std::size_t i = 0; i < steps_at_once; i += lanes)
      transpose(periods.strains + first + i, periods.stride, rows + i * lanes);
    const std::size_t count = steps - first < steps_at_once ? steps - first : steps_at_once;
    for (std::size_t i = 0; i < count; i += 2) {
      loops.template go_to<true>(widened(rows + i * lanes));
      loops.template go_to<false>(widened(rows + (i + 1) * lanes));
    }
  }
  double sums[lanes];
  store(loops.sum(), sums);
  for (unsigned left = which; left != 0; left &= left - 1)
    damage[__builtin_ctz(left)] = sums[__builtin_ctz(left)];
  return loops.amiss() & which;
}

/// Lines of one stack of open reversals, and strains of one lane, for histories of up to this many.
constexpr std::size_t stack_lines(std::size_t longest) {
  return ((longest + 4) * lanes * sizeof(double) - 1) / sizeof(LockstepLine) + 1;
}
constexpr std::size_t stride_of(std::size_t longest) { return (longest / 16 + 3) * 16; }

std::size_t lines(std::size_t longest) {
  return 2 * stack_lines(longest) + stride_of(longest) * lanes * sizeof(float) / sizeof(LockstepLine);
}

unsigned sum(const LockstepTables& tables, const StrainList* histories, std::size_t count,
             LockstepLine* memory, double* damage) {
  std::size_t longest = 0;
  for (std::size_t j = 0; j < count; ++j) longest = histories[j].size > longest ? histories[j].size : longest;
  Periods periods;
  const std::size_t stack = stack_lines(longest);
  periods.stride = stride_of(longest);
  periods.strains = reinterpret_cast<float*>(memory + 2 * stack);
  periods.open = {reinterpret_cast<double*>(memory) + lanes,
                  reinterpret_cast<double*>(memory + stack) + lanes};
  unsigned by_table = 0, one_by_one = 0;  // lanes
  for (std::size_t j = 0; j < count; ++j) {
    periods.of[j] = rotated(histories[j], periods.strains + j * periods.stride);
    const bool far = beyond_table(tables, 2 * double{periods.of[j].largest});
    (far || tables.damage_of != nullptr ? one_by_one : by_table) |= 1u << j;
  }
  unsigned amiss = 0;
  if (by_table != 0) amiss |= sum_lanes<false>(tables, periods, by_table, damage);
  if (one_by_one == 0) return amiss;
  for (std::size_t j = 0; by_table != 0 && j < count; ++j)  // once more
    rotated(histories[j], periods.strains + j * periods.stride);
  return amiss | sum_lanes<true>(tables, periods, one_by_one, damage);
}

extern const Lockstep set;
const Lockstep set{lanes, lines, sum};

}  // namespace dresslife::fatigue::DRESSLIFE_MACHINE
