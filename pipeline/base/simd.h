// Vectors of numbers, as long as a register of the machine: Pack has lanes of double, FloatPack has twice as many lanes of float.
// Only this file includes Google Highway, which implements the operations.
//
// Files with hot loops, which are compiled once per instruction set, include this header. Such a file defines DRESSLIFE_MACHINE
// (a name) and DRESSLIFE_TARGET (a target of Highway; default: the portable one, which is SSE4 on x86-64, number by number on
// x86-64 with clang or a sanitizer, and the target of the build elsewhere). The file puts its loops between
// DRESSLIFE_BEGIN_MACHINE and DRESSLIFE_END_MACHINE. Code from other headers must be compiled for any machine, so these headers
// are included before: the standard headers of all loops are included here. pipeline/base/instruction_set.h selects the loops for
// the machine.
#pragma once

#ifndef DRESSLIFE_MACHINE
#error "simd.h belongs to files that are compiled for one instruction set, which name it"
#endif

#include <hwy/detect_targets.h>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <new>
#include <string>
#include <vector>

#include "pipeline/base/instruction_set.h"

#if !defined(DRESSLIFE_TARGET) && defined(DRESSLIFE_PORTABLE_SSE4)
#define DRESSLIFE_TARGET HWY_SSE4
#elif !defined(DRESSLIFE_TARGET) && defined(__x86_64__)
#define DRESSLIFE_TARGET HWY_EMU128
#endif
#ifdef DRESSLIFE_TARGET
#undef HWY_TARGET
#define HWY_TARGET DRESSLIFE_TARGET
#endif
#include <hwy/highway.h>

#if HWY_TARGET == HWY_AVX3_DL  // machines with the byte permutations of this target also have bit matrices
#define DRESSLIFE_BEGIN_MACHINE \
  HWY_BEFORE_NAMESPACE();       \
  _Pragma("GCC target(\"gfni\")")
#else
#define DRESSLIFE_BEGIN_MACHINE HWY_BEFORE_NAMESPACE();
#endif
#define DRESSLIFE_END_MACHINE HWY_AFTER_NAMESPACE();

DRESSLIFE_BEGIN_MACHINE
namespace dresslife::simd {

inline namespace DRESSLIFE_MACHINE {

namespace hn = hwy::HWY_NAMESPACE;

using DoubleTag = hn::ScalableTag<double>;
using FloatTag = hn::ScalableTag<float>;
using IntTag = hn::ScalableTag<std::int32_t>;
using WordTag = hn::ScalableTag<std::uint32_t>;
using LongTag = hn::ScalableTag<std::int64_t>;
using HalfTag = hn::Rebind<float, DoubleTag>;

constexpr int pack_size = static_cast<int>(hn::MaxLanes(DoubleTag()));
constexpr int float_pack_size = static_cast<int>(hn::MaxLanes(FloatTag()));

template <class Of>
struct Vector {
  using Tag = Of;
  using Raw = hn::Vec<Tag>;
  using Value = hn::TFromD<Tag>;
  Raw raw;

  Vector() = default;
  HWY_INLINE Vector(const Raw& of) : raw(of) {}
  HWY_INLINE Vector(Value all) : raw(hn::Set(Tag(), all)) {}

  friend HWY_INLINE Vector operator+(const Vector& a, const Vector& b) { return hn::Add(a.raw, b.raw); }
  friend HWY_INLINE Vector operator-(const Vector& a, const Vector& b) { return hn::Sub(a.raw, b.raw); }
  friend HWY_INLINE Vector operator*(const Vector& a, const Vector& b) { return hn::Mul(a.raw, b.raw); }
  friend HWY_INLINE Vector operator/(const Vector& a, const Vector& b) { return hn::Div(a.raw, b.raw); }
  friend HWY_INLINE Vector operator&(const Vector& a, const Vector& b) { return hn::And(a.raw, b.raw); }
  friend HWY_INLINE Vector operator|(const Vector& a, const Vector& b) { return hn::Or(a.raw, b.raw); }
  friend HWY_INLINE Vector operator^(const Vector& a, const Vector& b) { return hn::Xor(a.raw, b.raw); }
  HWY_INLINE Vector operator-() const { return hn::Neg(raw); }
  HWY_INLINE Vector operator~() const { return hn::Not(raw); }
  HWY_INLINE Vector& operator+=(const Vector& b) { return *this = *this + b; }
  HWY_INLINE Vector& operator-=(const Vector& b) { return *this = *this - b; }
  HWY_INLINE Vector& operator*=(const Vector& b) { return *this = *this * b; }
  HWY_INLINE Vector& operator|=(const Vector& b) { return *this = *this | b; }
};

using Pack = Vector<DoubleTag>;
using FloatPack = Vector<FloatTag>;
using IntPack = Vector<IntTag>;
using LongPack = Vector<LongTag>;  ///< as many lanes as a Pack
using HalfPack = Vector<HalfTag>;  ///< a Pack in single precision

template <class Pack_>
HWY_INLINE Pack_ load(const typename Pack_::Value* from) {
  return hn::LoadU(typename Pack_::Tag(), from);
}
/// Value may be a signed or unsigned type of the size of a lane.
template <class Tag, class Value>
HWY_INLINE void store(const Vector<Tag>& pack, Value* to) {
  static_assert(sizeof(Value) == sizeof(hn::TFromD<Tag>));
  hn::StoreU(hn::BitCast(hn::Rebind<Value, Tag>(), pack.raw), hn::Rebind<Value, Tag>(), to);
}

/// Loads the first `count` numbers; the other lanes are 0.
HWY_INLINE FloatPack load_some(const float* from, std::size_t count) {
  if (count >= float_pack_size) return load<FloatPack>(from);
#if HWY_TARGET == HWY_AVX3_DL || HWY_TARGET == HWY_AVX2
  return hn::MaskedLoad(hn::FirstN(FloatTag(), count), FloatTag(), from);
#else
  float values[float_pack_size] = {};
  for (std::size_t k = 0; k < count; ++k) values[k] = from[k];
  return load<FloatPack>(values);
#endif
}

HWY_INLINE Pack in_double(const HalfPack& pack) { return hn::PromoteTo(DoubleTag(), pack.raw); }
HWY_INLINE HalfPack in_single(const Pack& pack) { return hn::DemoteTo(HalfTag(), pack.raw); }
#if HWY_TARGET != HWY_SCALAR
HWY_INLINE FloatPack joined(const HalfPack& first, const HalfPack& second) {
  return hn::Combine(FloatTag(), second.raw, first.raw);
}
#endif

// ---- masks from comparisons -------------------------------------------------------------------------------

template <class Tag>
struct MaskOf {
  hn::Mask<Tag> raw;

  friend HWY_INLINE MaskOf operator&(const MaskOf& a, const MaskOf& b) { return {hn::And(a.raw, b.raw)}; }
  friend HWY_INLINE MaskOf operator|(const MaskOf& a, const MaskOf& b) { return {hn::Or(a.raw, b.raw)}; }
};
using Mask = MaskOf<FloatTag>;         ///< of a FloatPack or an IntPack
using DoubleMask = MaskOf<DoubleTag>;  ///< of a Pack or a LongPack

template <class Tag>
HWY_INLINE MaskOf<Tag> greater(const Vector<Tag>& a, const Vector<Tag>& b) {
  return {hn::Gt(a.raw, b.raw)};
}
template <class Tag>
HWY_INLINE MaskOf<Tag> at_least(const Vector<Tag>& a, const Vector<Tag>& b) {
  return {hn::Ge(a.raw, b.raw)};
}
template <class Tag>
HWY_INLINE MaskOf<Tag> equal(const Vector<Tag>& a, const Vector<Tag>& b) {
  return {hn::Eq(a.raw, b.raw)};
}
HWY_INLINE DoubleMask equal(const LongPack& a, std::int64_t b) {
  return {hn::RebindMask(DoubleTag(), hn::Eq(a.raw, hn::Set(LongTag(), b)))};
}
HWY_INLINE Mask nonzero(const IntPack& a) { return {hn::RebindMask(FloatTag(), hn::Ne(a.raw, hn::Zero(IntTag())))}; }
template <class Tag>
HWY_INLINE Vector<Tag> select(const MaskOf<Tag>& mask, const Vector<Tag>& yes, const Vector<Tag>& no) {
  return hn::IfThenElse(mask.raw, yes.raw, no.raw);
}
HWY_INLINE IntPack select(const Mask& mask, const IntPack& yes, const IntPack& no) {
  return hn::IfThenElse(hn::RebindMask(IntTag(), mask.raw), yes.raw, no.raw);
}
HWY_INLINE LongPack select(const DoubleMask& mask, const LongPack& yes, const LongPack& no) {
  return hn::IfThenElse(hn::RebindMask(LongTag(), mask.raw), yes.raw, no.raw);
}
/// Returns a word whose bit j belongs to lane j.
template <class Tag>
HWY_INLINE unsigned bits(const MaskOf<Tag>& mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(Tag(), mask.raw, bytes);
  if constexpr (hn::MaxLanes(Tag()) <= 8) return bytes[0] & ((1u << hn::MaxLanes(Tag())) - 1);
  std::uint32_t word;
  __builtin_memcpy(&word, bytes, sizeof(word));
  return word & ((1u << hn::MaxLanes(Tag())) - 1);
}

// larger() and smaller() return b if a is not a number.
template <class Tag>
HWY_INLINE Vector<Tag> larger(const Vector<Tag>& a, const Vector<Tag>& b) {
  return HWY_ARCH_X86 ? hn::Max(a.raw, b.raw) : select(greater(a, b), a, b).raw;
}
template <class Tag>
HWY_INLINE Vector<Tag> smaller(const Vector<Tag>& a, const Vector<Tag>& b) {
  return HWY_ARCH_X86 ? hn::Min(a.raw, b.raw) : select(greater(b, a), a, b).raw;
}
HWY_INLINE float largest_lane(const FloatPack& a) { return hn::GetLane(hn::MaxOfLanes(FloatTag(), a.raw)); }
HWY_INLINE float sum_of_lanes(const FloatPack& a) { return hn::GetLane(hn::SumOfLanes(FloatTag(), a.raw)); }
HWY_INLINE double sum_of_lanes(const Pack& a) { return hn::GetLane(hn::SumOfLanes(DoubleTag(), a.raw)); }
HWY_INLINE std::int64_t first_lane(const LongPack& a) { return hn::GetLane(a.raw); }
HWY_INLINE FloatPack size_of(const FloatPack& a) { return hn::Abs(a.raw); }

// ---- rows of memory to lanes ------------------------------------------------------------------------------

/// to[step * pack_size + lane] = from[lane * stride + step] for pack_size steps and pack_size lanes.
HWY_INLINE void transpose(const float* from, std::size_t stride, float* to) {
#if HWY_TARGET == HWY_AVX3_DL || HWY_TARGET == HWY_AVX2
  const hn::CappedTag<float, 4> four;
  for (std::size_t step = 0; step < pack_size; step += 4)
    for (std::size_t lane = 0; lane < pack_size; lane += 4) {
      const float* const at = from + lane * stride + step;
      const auto a = hn::LoadU(four, at), b = hn::LoadU(four, at + stride);
      const auto c = hn::LoadU(four, at + 2 * stride), d = hn::LoadU(four, at + 3 * stride);
      const auto ab01 = hn::InterleaveLower(four, a, b), ab23 = hn::InterleaveUpper(four, a, b);
      const auto cd01 = hn::InterleaveLower(four, c, d), cd23 = hn::InterleaveUpper(four, c, d);
      float* const out = to + step * pack_size + lane;
      hn::StoreU(hn::ConcatLowerLower(four, cd01, ab01), four, out);
      hn::StoreU(hn::ConcatUpperUpper(four, cd01, ab01), four, out + pack_size);
      hn::StoreU(hn::ConcatLowerLower(four, cd23, ab23), four, out + 2 * pack_size);
      hn::StoreU(hn::ConcatUpperUpper(four, cd23, ab23), four, out + 3 * pack_size);
    }
#else
  for (std::size_t step = 0; step < pack_size; ++step)
    for (std::size_t lane = 0; lane < pack_size; ++lane) to[step * pack_size + lane] = from[lane * stride + step];
#endif
}

/// Returns the index of each lane's column in the given row: rows[row * pack_size + lane].
HWY_INLINE LongPack places(const LongPack& row) {
  constexpr int width = pack_size == 8 ? 3 : pack_size == 4 ? 2 : pack_size == 2 ? 1 : 0;
  static_assert(1 << width == pack_size);
  return LongPack(hn::ShiftLeft<width>(row.raw)) + LongPack(hn::Iota(LongTag(), 0));
}
HWY_INLINE Pack gathered(const double* rows, const LongPack& place) {
#if HWY_TARGET == HWY_AVX3_DL  // twice as fast as the gather instruction of the machine
  std::int64_t at[pack_size];
  store(place, at);
  return Pack::Raw{_mm512_setr_pd(rows[at[0]], rows[at[1]], rows[at[2]], rows[at[3]], rows[at[4]], rows[at[5]],
                                  rows[at[6]], rows[at[7]])};
#else
  return hn::GatherIndex(DoubleTag(), rows, place.raw);
#endif
}
HWY_INLINE void scattered(const Pack& pack, double* rows, const LongPack& place) {
  double values[pack_size];
  std::int64_t at[pack_size];
  store(pack, values);
  store(place, at);
  for (int lane = 0; lane < pack_size; ++lane) rows[at[lane]] = values[lane];
}

struct Four {
  Pack c0, c1, c2, c3;
};

/// Returns four numbers for each lane: those from cells[offset] on. Precondition: offset is a multiple of four.
HWY_INLINE Four gathered_fours(const double* cells, const LongPack& offset) {
#if HWY_TARGET == HWY_SCALAR
  const double* const cell = cells + first_lane(offset);
  return {cell[0], cell[1], cell[2], cell[3]};
#else
  alignas(64) std::int64_t at[pack_size];
  store(offset, at);
  asm("" : "+m"(at));  // via memory, because extracting them from the register takes twice as long
#if HWY_TARGET == HWY_AVX3_DL || HWY_TARGET == HWY_AVX2
  const hn::CappedTag<double, 4> four;
  const DoubleTag all;
  const auto rows_of = [&](int lane) HWY_ATTR {
#if HWY_TARGET == HWY_AVX3_DL
    return hn::Combine(all, hn::Load(four, cells + at[lane + 4]), hn::Load(four, cells + at[lane]));
#else
    return hn::Load(four, cells + at[lane]);
#endif
  };
  const auto a = rows_of(0), b = rows_of(1), c = rows_of(2), d = rows_of(3);
  const auto ab0 = hn::InterleaveLower(all, a, b), ab1 = hn::InterleaveUpper(all, a, b);
  const auto cd0 = hn::InterleaveLower(all, c, d), cd1 = hn::InterleaveUpper(all, c, d);
  return {hn::OddEvenBlocks(hn::SwapAdjacentBlocks(cd0), ab0), hn::OddEvenBlocks(hn::SwapAdjacentBlocks(cd1), ab1),
          hn::OddEvenBlocks(cd0, hn::SwapAdjacentBlocks(ab0)), hn::OddEvenBlocks(cd1, hn::SwapAdjacentBlocks(ab1))};
#else
  static_assert(pack_size == 2);
  const DoubleTag all;
  const auto a01 = hn::LoadU(all, cells + at[0]), a23 = hn::LoadU(all, cells + at[0] + 2);
  const auto b01 = hn::LoadU(all, cells + at[1]), b23 = hn::LoadU(all, cells + at[1] + 2);
  return {hn::InterleaveLower(all, a01, b01), hn::InterleaveUpper(all, a01, b01), hn::InterleaveLower(all, a23, b23),
          hn::InterleaveUpper(all, a23, b23)};
#endif
#endif
}

/// leading_bits returns the bits of x from bit `by` on as an integer, fraction_below the lower bits as a fraction of 1. A table
/// in octaves is indexed by these two.
template <int by>
HWY_INLINE LongPack leading_bits(const Pack& x) {
  const hn::ScalableTag<std::uint64_t> words;
  return hn::BitCast(LongTag(), hn::ShiftRight<by>(hn::BitCast(words, x.raw)));
}
template <int by>
HWY_INLINE Pack fraction_below(const Pack& x) {
  constexpr int mantissa = 52;
  const hn::ScalableTag<std::uint64_t> words;
  const auto shifted = hn::ShiftLeft<mantissa - by>(hn::BitCast(words, x.raw));
  const auto one = hn::BitCast(words, hn::Set(DoubleTag(), 1.0));
  const auto number = hn::Or(hn::And(shifted, hn::Set(words, (std::uint64_t{1} << mantissa) - 1)), one);
  return hn::Sub(hn::BitCast(DoubleTag(), number), hn::Set(DoubleTag(), 1.0));
}

// ---- words of bits, one per lane --------------------------------------------------------------------------

template <int by>
HWY_INLINE IntPack shifted_right(const IntPack& word) {
  return hn::BitCast(IntTag(), hn::ShiftRight<by>(hn::BitCast(WordTag(), word.raw)));
}

template <int by>
HWY_INLINE LongPack shifted_left(const LongPack& number) {
  return hn::ShiftLeft<by>(number.raw);
}

/// Returns the position of the only bit that is set; any number for a word without a set bit.
HWY_INLINE IntPack place_of(const IntPack& bit) {  // the exponent of the word as a float
  const FloatPack number = hn::ConvertTo(FloatTag(), bit.raw);
  return (shifted_right<23>(hn::BitCast(IntTag(), number.raw)) & 255) - 127;
}

/// Returns -1 if a is larger than b (as unsigned words), else 0.
HWY_INLINE IntPack above(const IntPack& a, const IntPack& b) {
  return hn::BitCast(IntTag(),
                     hn::VecFromMask(WordTag(), hn::Gt(hn::BitCast(WordTag(), a.raw), hn::BitCast(WordTag(), b.raw))));
}

constexpr int word = 32;                                   ///< bits
constexpr std::uint32_t first_of_word = 1u << (word - 1);  ///< a word's first sample is its highest bit

/// Records which lanes passed a test at each sample, and returns one word of bits per lane.
class WordRecord {
 public:
#if HWY_TARGET == HWY_AVX3_DL
  /// t: number of the sample in the word. bit: a word with only the bit of this sample.
  HWY_INLINE void put(int t, const IntPack&, const Mask& mask) { rows_[t] = mask.raw.raw; }

  /// Transposes the bits of 32 samples x 16 lanes. One byte has the bits of eight lanes.
  HWY_INLINE IntPack words() const {
    alignas(64) static constexpr struct Orders {
      std::uint8_t by_octets[64]{}, by_lanes[64]{};
      constexpr Orders() {
        for (int half = 0; half < 2; ++half)
          for (int octet = 0; octet < 4; ++octet)
            for (int k = 0; k < 8; ++k) {
              const int block = 8 * (4 * half + octet);
              by_octets[block + k] = static_cast<std::uint8_t>(2 * (8 * octet + k) + half);
              by_lanes[4 * (8 * half + k) + 3 - octet] = static_cast<std::uint8_t>(block + k);
            }
      }
    } orders;
    const __m512i unit = _mm512_set1_epi64(0x8040201008040201);
    const __m512i octets = _mm512_permutexvar_epi8(_mm512_load_si512(orders.by_octets), _mm512_load_si512(rows_));
    const __m512i turned = _mm512_gf2p8affine_epi64_epi8(unit, octets, 0);
    return IntPack::Raw{_mm512_permutexvar_epi8(_mm512_load_si512(orders.by_lanes), turned)};
  }

 private:
  alignas(64) __mmask16 rows_[word]{};
#else
  HWY_INLINE void put(int, const IntPack& bit, const Mask& mask) {
    words_ |= IntPack(hn::IfThenElseZero(hn::RebindMask(IntTag(), mask.raw), bit.raw));
  }
  HWY_INLINE IntPack words() const { return words_; }

 private:
  IntPack words_{};
#endif
};

// ---- square roots and reciprocals, to a few units in the last place ---------------------------------------

HWY_INLINE Pack square_root(const Pack& x) { return hn::Sqrt(x.raw); }
HWY_INLINE FloatPack square_root(const FloatPack& x) { return hn::Sqrt(x.raw); }

#if HWY_TARGET == HWY_AVX3_DL || HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX2
// The machine's approximations are accurate to 12 bits or more; one Newton step doubles the number of bits.
HWY_INLINE FloatPack inverse_root(const FloatPack& x) {
  const FloatPack rough = hn::ApproximateReciprocalSqrt(x.raw);
  return rough * (1.5f - (0.5f * x) * (rough * rough));
}
HWY_INLINE FloatPack inverse(const FloatPack& x) {
  const FloatPack rough = hn::ApproximateReciprocal(x.raw);
  return rough * (2.0f - x * rough);
}
#else
HWY_INLINE FloatPack inverse_root(const FloatPack& x) { return 1.0f / square_root(x); }
HWY_INLINE FloatPack inverse(const FloatPack& x) { return 1.0f / x; }
#endif

}  // namespace DRESSLIFE_MACHINE
}  // namespace dresslife::simd
DRESSLIFE_END_MACHINE
