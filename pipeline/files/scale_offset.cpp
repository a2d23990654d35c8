#include "pipeline/files/scale_offset.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

namespace dresslife::pipeline {
namespace {

static_assert(std::endian::native == std::endian::little, "headers and numbers are written as they lie in memory");

constexpr std::size_t header_bytes = 21;
constexpr int word_bits = 64;
template <class T>
constexpr int whole = 8 * sizeof(T);  // bits of an unchanged number
// A number with at most seven other bits before it in its first byte ends within eight bytes, and a double represents this number
// of steps exactly.
template <class T>
constexpr int most_bits = std::min(whole<T> - 1, 52);

std::size_t chunk_bytes(std::size_t numbers, int bits) { return header_bytes + numbers * bits / 8 + 1; }

template <class T>
using Steps = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;
/// Returns the number of steps from the smallest number.
template <class T>
Steps<T> steps_of(T number, T smallest, T scale) {
  return static_cast<Steps<T>>((number - smallest) * scale + T{0.5});
}

/// Returns the number of bits for numbers up to `largest`; `whole` if the steps have more digits than T.
template <class T>
int bits_for(T largest, T smallest, T scale) {
  const T most_steps = std::exp2(T{std::numeric_limits<T>::digits - 1});
  const T span = (largest - smallest) * scale + T{0.5};
  return span < most_steps ? std::bit_width(static_cast<std::uint64_t>(steps_of(largest, smallest, scale))) : whole<T>;
}

template <class T>
void pack(std::span<const T> numbers, int decimals, std::vector<char>& chunk) {
  T smallest = numbers[0], largest = numbers[0];
  for (const T number : numbers) {
    smallest = number < smallest ? number : smallest;
    largest = number > largest ? number : largest;
  }
  const T scale = static_cast<T>(std::pow(10.0, decimals));
  const std::int32_t bits = bits_for(largest, smallest, scale);
  chunk.assign(chunk_bytes(numbers.size(), bits) + sizeof(std::uint64_t), 0);  // the last word may end beyond the chunk
  std::memcpy(chunk.data(), &bits, sizeof(bits));
  chunk[4] = 8;
  std::memcpy(chunk.data() + 5, &smallest, sizeof(smallest));
  char* out = chunk.data() + header_bytes;
  if (bits == whole<T>) {
    std::memcpy(out, numbers.data(), numbers.size_bytes());
  } else if (bits > 0) {
    std::uint64_t word = 0;
    int left = word_bits;  // bits of `word` that are free
    const auto put = [&] {
      const std::uint64_t swapped = __builtin_bswap64(word);
      std::memcpy(out, &swapped, sizeof(swapped));
    };
    for (const T number : numbers) {
      const auto step = static_cast<std::uint64_t>(steps_of(number, smallest, scale));
      left -= bits;
      if (left >= 0) {
        word |= step << left;
        continue;
      }
      word |= step >> -left;
      put();
      out += sizeof(word);
      left += word_bits;
      word = step << left;
    }
    put();
  }
  chunk.resize(chunk_bytes(numbers.size(), bits));
}

template <class T>
bool unpack(std::span<const char> chunk, int decimals, std::span<T> numbers) {
  if (chunk.size() < header_bytes) return false;
  std::int32_t bits;
  T smallest;
  std::memcpy(&bits, chunk.data(), sizeof(bits));
  std::memcpy(&smallest, chunk.data() + 5, sizeof(smallest));
  const bool possible = (bits >= 0 && bits <= most_bits<T>) || bits == whole<T>;
  if (!possible || chunk.size() + 1 < chunk_bytes(numbers.size(), bits)) return false;
  const std::span<const char> stream = chunk.subspan(header_bytes);
  if (bits == whole<T>) {
    std::memcpy(numbers.data(), stream.data(), numbers.size_bytes());
    return true;
  }
  const T scale = static_cast<T>(std::pow(10.0, decimals));
  std::array<Steps<T>, 256> steps{};  // of the next numbers; the compiler vectorises the second loop
  for (std::size_t first = 0; first < numbers.size(); first += steps.size()) {
    const std::size_t count = std::min(steps.size(), numbers.size() - first);
    for (std::size_t k = 0; k < count && bits > 0; ++k) {
      const std::size_t bit = (first + k) * static_cast<std::size_t>(bits);
      std::uint64_t word = 0;
      if (bit / 8 + sizeof(word) <= stream.size())
        std::memcpy(&word, stream.data() + bit / 8, sizeof(word));
      else  // the last words may end beyond the chunk
        std::memcpy(&word, stream.data() + bit / 8, stream.size() - bit / 8);
      steps[k] = static_cast<Steps<T>>(__builtin_bswap64(word) << bit % 8 >> (word_bits - bits));
    }
    for (std::size_t k = 0; k < count; ++k) numbers[first + k] = static_cast<T>(steps[k]) / scale + smallest;
  }
  return true;
}

}  // namespace

void pack_chunk(std::span<const float> numbers, int decimals, std::vector<char>& chunk) {
  pack(numbers, decimals, chunk);
}
void pack_chunk(std::span<const double> numbers, int decimals, std::vector<char>& chunk) {
  pack(numbers, decimals, chunk);
}

bool unpack_chunk(std::span<const char> chunk, int decimals, std::span<float> numbers) {
  return unpack(chunk, decimals, numbers);
}
bool unpack_chunk(std::span<const char> chunk, int decimals, std::span<double> numbers) {
  return unpack(chunk, decimals, numbers);
}

}  // namespace dresslife::pipeline
