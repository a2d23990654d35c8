// Numbers side by side, as many as a register of the machine holds: arithmetic on a Pack is arithmetic on
// that many doubles, on a FloatPack on twice as many floats. The only home of Google Highway, whose
// operations these are.
//
// Included by files of hot loops that are compiled once per instruction set. Such a file includes every
// standard header it needs, defines DRESSLIFE_MACHINE (a name) and DRESSLIFE_TARGET (Highway's target; by
// default the build's own), includes this one, and puts its loops between DRESSLIFE_BEGIN_MACHINE and
// DRESSLIFE_END_MACHINE. pipeline/instruction_set.h tells which of them run on the machine at hand.
#pragma once

#ifndef DRESSLIFE_MACHINE
#error "simd.h belongs to files that are compiled for one instruction set, which name it"
#endif

#include <hwy/detect_targets.h>
#include <cmath>
#include <cstddef>
#include <cstdint>

#ifdef DRESSLIFE_TARGET
#undef HWY_TARGET
#define HWY_TARGET DRESSLIFE_TARGET
#endif
#include <hwy/highway.h>

#if HWY_TARGET == HWY_AVX3_DL  // machines with its byte permutations have bit matrices too
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
using HalfPack = Vector<HalfTag>;  ///< a Pack in single precision

template <class Pack_>
HWY_INLINE Pack_ load(const typename Pack_::Value* from) {
  return hn::LoadU(typename Pack_::Tag(), from);
}
/// Words may be read as numbers with or without a sign.
template <class Tag, class Value>
HWY_INLINE void store(const Vector<Tag>& pack, Value* to) {
  static_assert(sizeof(Value) == sizeof(hn::TFromD<Tag>));
  hn::StoreU(hn::BitCast(hn::Rebind<Value, Tag>(), pack.raw), hn::Rebind<Value, Tag>(), to);
}

HWY_INLINE HalfPack in_single(const Pack& pack) { return hn::DemoteTo(HalfTag(), pack.raw); }
HWY_INLINE FloatPack joined(const HalfPack& first, const HalfPack& second) {
  return hn::Combine(FloatTag(), second.raw, first.raw);
}

// ---- what comparisons give
// ----------------------------------------------------------------------------------------

struct Mask {
  hn::Mask<FloatTag> raw;
};

HWY_INLINE Mask greater(const FloatPack& a, const FloatPack& b) { return {hn::Gt(a.raw, b.raw)}; }
HWY_INLINE Mask nonzero(const IntPack& a) {
  return {hn::RebindMask(FloatTag(), hn::Ne(a.raw, hn::Zero(IntTag())))};
}
HWY_INLINE FloatPack select(const Mask& mask, const FloatPack& yes, const FloatPack& no) {
  return hn::IfThenElse(mask.raw, yes.raw, no.raw);
}
HWY_INLINE IntPack select(const Mask& mask, const IntPack& yes, const IntPack& no) {
  return hn::IfThenElse(hn::RebindMask(IntTag(), mask.raw), yes.raw, no.raw);
}
/// Bit j: of lane j.
HWY_INLINE unsigned bits(const Mask& mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(FloatTag(), mask.raw, bytes);
  std::uint32_t word;
  __builtin_memcpy(&word, bytes, sizeof(word));
  return word & ((1u << float_pack_size) - 1);
}
HWY_INLINE FloatPack larger(const FloatPack& a, const FloatPack& b) { return hn::Max(a.raw, b.raw); }
HWY_INLINE FloatPack smaller(const FloatPack& a, const FloatPack& b) { return hn::Min(a.raw, b.raw); }
HWY_INLINE float largest_lane(const FloatPack& a) { return hn::GetLane(hn::MaxOfLanes(FloatTag(), a.raw)); }

// ---- words of bits, one a lane
// ------------------------------------------------------------------------------------

template <int by>
HWY_INLINE IntPack shifted_right(const IntPack& word) {
  return hn::BitCast(IntTag(), hn::ShiftRight<by>(hn::BitCast(WordTag(), word.raw)));
}

/// The number of the one bit that is set; of a word without any, any number.
HWY_INLINE IntPack place_of(const IntPack& bit) {  // the exponent of the word as a float
  const FloatPack number = hn::ConvertTo(FloatTag(), bit.raw);
  return (shifted_right<23>(hn::BitCast(IntTag(), number.raw)) & 255) - 127;
}

/// -1 where a is larger than b, as words without a sign; else 0.
HWY_INLINE IntPack above(const IntPack& a, const IntPack& b) {
  return hn::BitCast(IntTag(), hn::VecFromMask(WordTag(), hn::Gt(hn::BitCast(WordTag(), a.raw),
                                                                 hn::BitCast(WordTag(), b.raw))));
}

constexpr int word = 32;                                   ///< bits
constexpr std::uint32_t first_of_word = 1u << (word - 1);  ///< a word's first sample is its highest bit

/// Which lanes passed a test, sample by sample, and then as a word a lane.
class WordRecord {
 public:
#if HWY_TARGET == HWY_AVX3_DL
  /// t: sample of the word, bit: its own.
  HWY_INLINE void put(int t, const IntPack&, const Mask& mask) { rows_[t] = mask.raw.raw; }

  /// Bits as 32 samples x 16 lanes, a byte an octet of lanes, turned octet by octet.
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
    const __m512i octets =
        _mm512_permutexvar_epi8(_mm512_load_si512(orders.by_octets), _mm512_load_si512(rows_));
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

// ---- roots and quotients, to a few units of the last place
// --------------------------------------------------------

HWY_INLINE Pack square_root(const Pack& x) { return hn::Sqrt(x.raw); }
HWY_INLINE FloatPack square_root(const FloatPack& x) { return hn::Sqrt(x.raw); }

#if HWY_TARGET == HWY_AVX3_DL || HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX2
// The machine's own are good to 12 digits or more in binary; one step of Newton's doubles them.
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
