// Numbers side by side, as many as a register of the machine holds: arithmetic on a Pack is arithmetic on
// that many doubles, on a FloatPack on twice as many floats. Here is all that instruction sets do
// differently. Included by kernels_body.h only, before helix.h.
#pragma once

#include <cmath>
#include <cstdint>

#include "strain/sizes.h"

#ifndef DRESSLIFE_REGISTER_BYTES
#error "pack.h belongs to the kernels, which name their instruction set and how wide it is"
#endif

namespace dresslife::strain {

inline namespace DRESSLIFE_MACHINE {

constexpr int register_bytes = DRESSLIFE_REGISTER_BYTES;
constexpr int pack_size = register_bytes / sizeof(double);
constexpr int float_pack_size = register_bytes / sizeof(float);
static_assert(padding % float_pack_size == 0 && lanes % float_pack_size == 0);

typedef double Pack __attribute__((vector_size(register_bytes)));
typedef float FloatPack __attribute__((vector_size(register_bytes)));
typedef std::int32_t IntPack __attribute__((vector_size(register_bytes)));
typedef float HalfPack __attribute__((vector_size(register_bytes / 2)));  ///< a Pack in single precision

template <class Vector, class Value>
inline Vector load(const Value* from) {
  Vector vector;
  __builtin_memcpy(&vector, from, sizeof(vector));
  return vector;
}

template <class Value, class Vector>
inline void store(const Vector& vector, Value* to) {
  __builtin_memcpy(to, &vector, sizeof(vector));
}

/// One after the other.
inline FloatPack joined(const HalfPack& low, const HalfPack& high) {
#if DRESSLIFE_REGISTER_BYTES == 64
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
#elif DRESSLIFE_REGISTER_BYTES == 32
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
#else
  return __builtin_shufflevector(low, high, 0, 1, 2, 3);
#endif
}

inline Pack square_root(const Pack& x) {
  Pack root;
  for (int k = 0; k < pack_size; ++k) root[k] = std::sqrt(x[k]);
  return root;
}

// ---- what comparisons give --------------------------------------------------------------------------------

#if DRESSLIFE_REGISTER_BYTES == 64

typedef __mmask16 Mask;
inline Mask greater(const FloatPack& a, const FloatPack& b) { return _mm512_cmp_ps_mask(a, b, _CMP_GT_OQ); }
inline FloatPack select(Mask mask, const FloatPack& yes, const FloatPack& no) {
  return _mm512_mask_blend_ps(mask, no, yes);
}
inline IntPack select(Mask mask, const IntPack& yes, const IntPack& no) {
  return reinterpret_cast<IntPack>(
      _mm512_mask_blend_epi32(mask, reinterpret_cast<__m512i>(no), reinterpret_cast<__m512i>(yes)));
}
inline unsigned bits(Mask mask) { return mask; }  ///< bit j: of lane j
inline Mask nonzero(const IntPack& a) {
  return _mm512_test_epi32_mask(reinterpret_cast<__m512i>(a), reinterpret_cast<__m512i>(a));
}
inline FloatPack larger(const FloatPack& a, const FloatPack& b) { return _mm512_max_ps(a, b); }
inline FloatPack smaller(const FloatPack& a, const FloatPack& b) { return _mm512_min_ps(a, b); }
inline IntPack marked(const IntPack& word, Mask where, const IntPack& bit) {
  return reinterpret_cast<IntPack>(_mm512_mask_or_epi32(reinterpret_cast<__m512i>(word), where,
                                                        reinterpret_cast<__m512i>(word),
                                                        reinterpret_cast<__m512i>(bit)));
}

#elif DRESSLIFE_REGISTER_BYTES == 32

typedef __m256 Mask;
inline Mask greater(const FloatPack& a, const FloatPack& b) { return _mm256_cmp_ps(a, b, _CMP_GT_OQ); }
inline FloatPack select(Mask mask, const FloatPack& yes, const FloatPack& no) {
  return _mm256_blendv_ps(no, yes, mask);
}
inline IntPack select(Mask mask, const IntPack& yes, const IntPack& no) {
  return reinterpret_cast<IntPack>(
      _mm256_blendv_ps(reinterpret_cast<__m256>(no), reinterpret_cast<__m256>(yes), mask));
}
inline unsigned bits(Mask mask) { return static_cast<unsigned>(_mm256_movemask_ps(mask)); }
inline Mask nonzero(const IntPack& a) { return reinterpret_cast<Mask>(a != 0); }
inline FloatPack larger(const FloatPack& a, const FloatPack& b) { return _mm256_max_ps(a, b); }
inline FloatPack smaller(const FloatPack& a, const FloatPack& b) { return _mm256_min_ps(a, b); }
inline IntPack marked(const IntPack& word, Mask where, const IntPack& bit) {
  return word | (reinterpret_cast<IntPack>(where) & bit);
}

#else

typedef IntPack Mask;
inline Mask greater(const FloatPack& a, const FloatPack& b) { return a > b; }
inline FloatPack select(const Mask& mask, const FloatPack& yes, const FloatPack& no) {
  return mask ? yes : no;
}
inline IntPack select(const Mask& mask, const IntPack& yes, const IntPack& no) { return mask ? yes : no; }
inline unsigned bits(const Mask& mask) {
  return (mask[0] & 1) | (mask[1] & 2) | (mask[2] & 4) | (mask[3] & 8);
}
inline Mask nonzero(const IntPack& a) { return a != 0; }
inline FloatPack larger(const FloatPack& a, const FloatPack& b) { return a > b ? a : b; }
inline FloatPack smaller(const FloatPack& a, const FloatPack& b) { return a < b ? a : b; }
inline IntPack marked(const IntPack& word, const Mask& where, const IntPack& bit) {
  return word | (where & bit);
}

#endif

// ---- words of bits, one a lane ----------------------------------------------------------------------------

typedef std::uint32_t WordPack __attribute__((vector_size(register_bytes)));

inline IntPack shifted_right(const IntPack& word, int by) {
  return reinterpret_cast<IntPack>(reinterpret_cast<WordPack>(word) >> static_cast<std::uint32_t>(by));
}

/// The number of the one bit that is set; of a word without any, any number.
inline IntPack place_of(const IntPack& bit) {
#if DRESSLIFE_REGISTER_BYTES == 64
  return 31 - reinterpret_cast<IntPack>(_mm512_lzcnt_epi32(reinterpret_cast<__m512i>(bit)));
#else  // the exponent of the word as a float
  const FloatPack number = __builtin_convertvector(bit, FloatPack);
  return (shifted_right(reinterpret_cast<IntPack>(number), 23) & 255) - 127;
#endif
}

/// -1 where a is larger than b, as words without a sign; else 0.
inline IntPack above(const IntPack& a, const IntPack& b) {
  return reinterpret_cast<IntPack>(reinterpret_cast<WordPack>(a) > reinterpret_cast<WordPack>(b));
}

constexpr int word = 32;                                   ///< samples
constexpr std::uint32_t first_of_word = 1u << (word - 1);  ///< a word's first sample is its highest bit

/// Which lanes passed a test, sample by sample, and then as a word a lane.
class WordRecord {
 public:
#if DRESSLIFE_REGISTER_BYTES == 64
  /// t: sample of the word, bit: its own.
  inline void put(int t, const IntPack&, Mask mask) { rows_[t] = mask; }

  /// Bits as 32 samples x 16 lanes, a byte an octet of lanes, turned octet by octet.
  inline IntPack words() const {
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
    const __m512i octets = _mm512_permutexvar_epi8(load<__m512i>(orders.by_octets), load<__m512i>(rows_));
    const __m512i turned = _mm512_gf2p8affine_epi64_epi8(unit, octets, 0);
    return reinterpret_cast<IntPack>(_mm512_permutexvar_epi8(load<__m512i>(orders.by_lanes), turned));
  }

 private:
  alignas(64) Mask rows_[word]{};
#else
  inline void put(int, const IntPack& bit, const Mask& mask) { words_ = marked(words_, mask, bit); }
  inline IntPack words() const { return words_; }

 private:
  IntPack words_{};
#endif
};

// ---- roots and quotients, to a few units of the last place ------------------------------------------------

#if DRESSLIFE_REGISTER_BYTES == 64
inline FloatPack rough_inverse_root(const FloatPack& x) { return _mm512_rsqrt14_ps(x); }
inline FloatPack rough_inverse(const FloatPack& x) { return _mm512_rcp14_ps(x); }
#elif DRESSLIFE_REGISTER_BYTES == 32
inline FloatPack rough_inverse_root(const FloatPack& x) { return _mm256_rsqrt_ps(x); }
inline FloatPack rough_inverse(const FloatPack& x) { return _mm256_rcp_ps(x); }
#endif

#if DRESSLIFE_REGISTER_BYTES > 16  // one step of Newton's doubles the digits
inline FloatPack inverse_root(const FloatPack& x) {
  const FloatPack rough = rough_inverse_root(x);
  return rough * (1.5f - (0.5f * x) * (rough * rough));
}
inline FloatPack inverse(const FloatPack& x) {
  const FloatPack rough = rough_inverse(x);
  return rough * (2.0f - x * rough);
}
#else
inline FloatPack inverse_root(const FloatPack& x) {
  FloatPack root;
  for (int k = 0; k < float_pack_size; ++k) root[k] = std::sqrt(x[k]);
  return 1.0f / root;
}
inline FloatPack inverse(const FloatPack& x) { return 1.0f / x; }
#endif

inline FloatPack square_root(const FloatPack& x) {
  FloatPack root;
  for (int k = 0; k < float_pack_size; ++k) root[k] = __builtin_sqrtf(x[k]);
  return root;
}

}  // namespace DRESSLIFE_MACHINE
}  // namespace dresslife::strain
