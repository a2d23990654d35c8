#include "pipeline/files/scale_offset.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

namespace dresslife::pipeline {
namespace {

static_assert(std::endian::native == std::endian::little, "headers and numbers are written as they lie in memory");

constexpr std::size_t header_bytes = 21;
constexpr int whole = 32;             // bits of an unchanged number
constexpr std::size_t group = whole;  // this many numbers fill whole words with any number of bits

std::size_t chunk_bytes(std::size_t numbers, int bits) { return header_bytes + numbers * bits / 8 + 1; }

std::uint32_t swapped(std::uint32_t word) { return __builtin_bswap32(word); }

/// Packs 32 numbers into `bits` words; unpack_group() does the inverse. All shifts are constants in the unrolled loop.
template <int bits>
void pack_group(const std::uint32_t* in, char* out) {
  std::uint64_t held = 0;
  int count = 0;  // number of bits in `held`
#pragma GCC unroll 32
  for (std::size_t k = 0; k < group; ++k) {
    held = held << bits | in[k];
    count += bits;
    if (count >= 32) {
      count -= 32;
      const std::uint32_t word = swapped(static_cast<std::uint32_t>(held >> count));
      std::memcpy(out, &word, sizeof(word));
      out += sizeof(word);
    }
  }
}

template <int bits>
void unpack_group(const char* in, std::uint32_t* out) {
  constexpr std::uint32_t mask = static_cast<std::uint32_t>((std::uint64_t{1} << bits) - 1);
  std::uint64_t held = 0;
  int count = 0;
#pragma GCC unroll 32
  for (std::size_t k = 0; k < group; ++k) {
    if (count < bits) {
      std::uint32_t word;
      std::memcpy(&word, in, sizeof(word));
      in += sizeof(word);
      held = held << 32 | swapped(word);
      count += 32;
    }
    count -= bits;
    out[k] = static_cast<std::uint32_t>(held >> count) & mask;
  }
}

template <int... bits>
constexpr auto packers(std::integer_sequence<int, bits...>) {
  return std::array{pack_group<bits + 1>...};
}
template <int... bits>
constexpr auto unpackers(std::integer_sequence<int, bits...>) {
  return std::array{unpack_group<bits + 1>...};
}
constexpr auto pack_by_bits = packers(std::make_integer_sequence<int, whole - 1>{});
constexpr auto unpack_by_bits = unpackers(std::make_integer_sequence<int, whole - 1>{});

float power_of_ten(int decimals) { return static_cast<float>(std::pow(10.0, decimals)); }

/// steps() returns the bits for a number, number_at() the number for these bits.
std::uint32_t steps(float number, float smallest, float scale) {
  return static_cast<std::uint32_t>(static_cast<std::int32_t>((number - smallest) * scale + 0.5f));
}
float number_at(std::uint32_t steps, float smallest, float scale) {
  return static_cast<float>(static_cast<std::int32_t>(steps)) / scale + smallest;
}

/// Returns the number of bits for numbers up to `largest`; `whole` if the steps have more digits than a float.
int bits_for(float largest, float smallest, float scale) {
  constexpr float most_steps = 1 << 23;
  const float span = (largest - smallest) * scale;
  return span < most_steps ? std::bit_width(steps(largest, smallest, scale)) : whole;
}

constexpr int whole_double = 64;
// A number with at most seven other bits before it in its first byte ends within eight bytes, and a double represents this number
// of steps exactly.
constexpr int most_bits_of_double = 52;

/// Returns the eight bytes at `at`, the first one as the most significant.
std::uint64_t word_at(const char* at) {
  std::uint64_t word;
  std::memcpy(&word, at, sizeof(word));
  return __builtin_bswap64(word);
}

int bits_for(double largest, double smallest, double scale) {
  const double span = (largest - smallest) * scale + 0.5;
  return span < std::exp2(most_bits_of_double) ? std::bit_width(static_cast<std::uint64_t>(span)) : whole_double;
}

/// Makes the chunk long enough for the packed numbers and `spare` more bytes, and writes its head.
/// Returns the place of the packed numbers.
template <class T>
char* begin_chunk(std::size_t count, std::int32_t bits, T smallest, std::size_t spare, std::vector<char>& chunk) {
  chunk.assign(chunk_bytes(count, bits) + spare, 0);
  std::memcpy(chunk.data(), &bits, sizeof(bits));
  chunk[4] = 8;
  std::memcpy(chunk.data() + 5, &smallest, sizeof(smallest));
  return chunk.data() + header_bytes;
}

/// The head of a chunk.
template <class T>
struct Head {
  std::int32_t bits;
  T smallest;
};
/// Returns the head; std::nullopt: the chunk is shorter than a head.
template <class T>
std::optional<Head<T>> head_of(std::span<const char> chunk) {
  if (chunk.size() < header_bytes) return std::nullopt;
  Head<T> head;
  std::memcpy(&head.bits, chunk.data(), sizeof(head.bits));
  std::memcpy(&head.smallest, chunk.data() + 5, sizeof(head.smallest));
  return head;
}

}  // namespace

void pack_chunk(std::span<const float> numbers, int decimals, std::vector<char>& chunk) {
  float smallest = numbers[0], largest = numbers[0];
  for (const float number : numbers) {
    smallest = number < smallest ? number : smallest;
    largest = number > largest ? number : largest;
  }
  const float scale = power_of_ten(decimals);
  const std::int32_t bits = bits_for(largest, smallest, scale);
  char* out = begin_chunk(numbers.size(), bits, smallest, group * sizeof(float),
                          chunk);  // the last group may be incomplete
  if (bits == whole) {
    std::memcpy(out, numbers.data(), numbers.size_bytes());
  } else if (bits > 0) {
    std::array<std::uint32_t, group> of_group{};
    for (std::size_t first = 0; first < numbers.size(); first += group, out += 4 * bits) {
      const std::size_t count = std::min(group, numbers.size() - first);
      for (std::size_t k = 0; k < count; ++k) of_group[k] = steps(numbers[first + k], smallest, scale);
      pack_by_bits[bits - 1](of_group.data(), out);
    }
  }
  chunk.resize(chunk_bytes(numbers.size(), bits));
}

bool unpack_chunk(std::span<const char> chunk, int decimals, std::span<float> numbers) {
  const auto head = head_of<float>(chunk);
  if (!head) return false;
  const auto [bits, smallest] = *head;
  if (bits < 0 || bits > whole || chunk.size() + 1 < chunk_bytes(numbers.size(), bits)) return false;
  const char* in = chunk.data() + header_bytes;
  if (bits == whole) {
    std::memcpy(numbers.data(), in, numbers.size_bytes());
    return true;
  }
  const float scale = power_of_ten(decimals);
  std::array<std::uint32_t, group> of_group{};
  std::array<char, group * sizeof(float)> rest{};
  for (std::size_t first = 0; first < numbers.size(); first += group, in += 4 * bits) {
    const std::size_t count = std::min(group, numbers.size() - first);
    if (count < group) {  // its last word may end beyond the chunk
      std::memcpy(rest.data(), in, std::min<std::size_t>(rest.size(), chunk.data() + chunk.size() - in));
      in = rest.data();
    }
    if (bits > 0) unpack_by_bits[bits - 1](in, of_group.data());
    for (std::size_t k = 0; k < count; ++k) numbers[first + k] = number_at(of_group[k], smallest, scale);
  }
  return true;
}

void pack_chunk(std::span<const double> numbers, int decimals, std::vector<char>& chunk) {
  const auto [smallest, largest] = std::ranges::minmax_element(numbers);
  const double scale = std::pow(10.0, decimals), least = *smallest;
  const std::int32_t bits = bits_for(*largest, least, scale);
  char* const out = begin_chunk(numbers.size(), bits, least, sizeof(std::uint64_t),
                                chunk);  // the last word may end beyond it
  if (bits == whole_double) {
    std::memcpy(out, numbers.data(), numbers.size_bytes());
  } else if (bits > 0) {
    std::size_t bit = 0;
    for (const double number : numbers) {
      const auto step = static_cast<std::uint64_t>((number - least) * scale + 0.5);
      char* const at = out + bit / 8;
      const std::uint64_t word = __builtin_bswap64(word_at(at) | step << (64 - bits - bit % 8));
      std::memcpy(at, &word, sizeof(word));
      bit += static_cast<std::size_t>(bits);
    }
  }
  chunk.resize(chunk_bytes(numbers.size(), bits));
}

bool unpack_chunk(std::span<const char> chunk, int decimals, std::span<double> numbers) {
  const auto head = head_of<double>(chunk);
  if (!head) return false;
  const auto bits = head->bits;
  const double smallest = head->smallest;
  const bool possible = (bits >= 0 && bits <= most_bits_of_double) || bits == whole_double;
  if (!possible || chunk.size() + 1 < chunk_bytes(numbers.size(), bits)) return false;
  const char* const in = chunk.data() + header_bytes;
  if (bits == whole_double) {
    std::memcpy(numbers.data(), in, numbers.size_bytes());
    return true;
  }
  const double scale = std::pow(10.0, decimals);
  const auto number_of = [&](std::uint64_t step) {
    return static_cast<double>(static_cast<std::int64_t>(step)) / scale + smallest;
  };
  if (bits == 0) {
    std::ranges::fill(numbers, number_of(0));
    return true;
  }
  const auto number_at = [&](const char* at, std::size_t bit) {
    return number_of(word_at(at) << bit % 8 >> (64 - bits));
  };
  // Words of the last numbers may end beyond the chunk.
  const std::size_t stream = chunk.size() - header_bytes, width = static_cast<std::size_t>(bits);
  std::array<char, 2 * sizeof(std::uint64_t)> rest{};
  const std::size_t inside =
      stream < rest.size() ? 0 : stream - sizeof(std::uint64_t);  // words begin before this offset
  std::size_t k = 0;
  for (; k < numbers.size() && k * width / 8 < inside; ++k) numbers[k] = number_at(in + k * width / 8, k * width);
  for (; k < numbers.size(); ++k) {
    const std::size_t at = k * width / 8;
    rest.fill(0);
    std::copy_n(in + at, std::min(stream - at, sizeof(std::uint64_t)), rest.data());
    numbers[k] = number_at(rest.data(), k * width);
  }
  return true;
}

}  // namespace dresslife::pipeline
