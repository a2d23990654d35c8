#include "pipeline/files/list_deflate.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstring>
#include <utility>

namespace dresslife::pipeline {
namespace {

constexpr std::size_t least_copy = 4;      // shorter ones may cost more than what they copy
constexpr std::size_t longest_copy = 258;  // of one code
constexpr int end_of_block = 256;

/// A code of RFC 1951, 3.2.6, in the order in which its bits are written.
struct Code {
  std::uint16_t bits;
  std::uint8_t count;
};

constexpr std::uint32_t turned_round(std::uint32_t bits, int count) {
  std::uint32_t turned = 0;
  for (int k = 0; k < count; ++k) turned |= (bits >> k & 1u) << (count - 1 - k);
  return turned;
}

constexpr std::array<Code, 288> fixed_codes() {
  std::array<Code, 288> codes{};
  for (std::uint32_t symbol = 0; symbol < codes.size(); ++symbol) {
    const auto [bits, count] = symbol < 144   ? std::pair{0x30 + symbol, 8}
                               : symbol < 256 ? std::pair{0x190 + symbol - 144, 9}
                               : symbol < 280 ? std::pair{symbol - 256, 7}
                                              : std::pair{0xC0 + symbol - 280, 8};
    codes[symbol] = {static_cast<std::uint16_t>(turned_round(bits, count)), static_cast<std::uint8_t>(count)};
  }
  return codes;
}
constexpr std::array<Code, 288> codes = fixed_codes();

/// Bits in the order of deflate. The caller keeps room.
class BitWriter {
 public:
  explicit BitWriter(char* out) : out_(out) {}

  void put(std::uint32_t bits, int count) {
    held_ |= std::uint64_t{bits} << count_;
    count_ += count;
    if (count_ < 32) return;
    const auto word = static_cast<std::uint32_t>(held_);
    std::memcpy(out_, &word, sizeof(word));
    out_ += sizeof(word);
    held_ >>= 32;
    count_ -= 32;
  }
  void put_symbol(int symbol) { put(codes[symbol].bits, codes[symbol].count); }

  /// Copies `length` bytes from `distance` before; length >= least_copy.
  void put_copy(std::size_t length, std::size_t distance) {
    while (length > 0) {
      const std::size_t rest_fits = length > longest_copy + 2 ? longest_copy : longest_copy - 2;
      const std::size_t piece = length > longest_copy ? rest_fits : length;  // never leaves a rest below 3
      put_length(static_cast<std::uint32_t>(piece));
      put_distance(static_cast<std::uint32_t>(distance));
      length -= piece;
    }
  }

  char* finish() {
    put_symbol(end_of_block);
    for (; count_ > 0; count_ -= 8, held_ >>= 8) *out_++ = static_cast<char>(held_);
    return out_;
  }

 private:
  /// RFC 1951, 3.2.5: four codes for every bit of length, two for every bit of distance, the rest follows.
  void put_length(std::uint32_t length) {
    const std::uint32_t over = length - 3;
    if (length == longest_copy) return put_symbol(285);
    const int rest = over < 8 ? 0 : std::bit_width(over) - 3;
    put_symbol(257 + 4 * rest + static_cast<int>(over >> rest));
    put(over & ((1u << rest) - 1), rest);
  }
  void put_distance(std::uint32_t distance) {
    const std::uint32_t over = distance - 1;
    const int rest = over < 4 ? 0 : std::bit_width(over) - 2;
    put(turned_round(static_cast<std::uint32_t>(2 * rest) + (over >> rest), 5), 5);
    put(over & ((1u << rest) - 1), rest);
  }

  char* out_;
  std::uint64_t held_ = 0;
  int count_ = 0;
};

/// How many of the first `most` numbers are the same.
std::size_t common(const std::uint32_t* a, const std::uint32_t* b, std::size_t most) {
  constexpr std::size_t step = 8;
  std::size_t k = 0;
  for (; k + step <= most; k += step) {
    std::uint32_t differ = 0;
    for (std::size_t i = 0; i < step; ++i) differ |= a[k + i] ^ b[k + i];
    if (differ) break;
  }
  while (k < most && a[k] == b[k]) ++k;
  return k;
}

/// Bytes that are not copied from the list before: equal ones in a row become one and a copy of it.
void put_bytes(BitWriter& out, const std::vector<std::uint8_t>& bytes, std::size_t from, std::size_t to) {
  while (from < to) {
    std::size_t same = from;
    while (from > 0 && same < to && bytes[same] == bytes[from - 1]) ++same;
    if (same - from >= least_copy) {
      out.put_copy(same - from, 1);
      from = same;
    } else {
      out.put_symbol(bytes[from++]);
    }
  }
}

void put_zeros(BitWriter& out, std::size_t count) {
  for (std::size_t k = 0; k < std::min(count, least_copy); ++k) out.put_symbol(0);
  if (count > 2 * least_copy) return out.put_copy(count - least_copy, 1);
  for (std::size_t k = least_copy; k < count; ++k) out.put_symbol(0);
}

/// The check sum of RFC 1950, 8.2, carried on over bytes: a = 1 + their sum, b = sum of all a. Of n bytes x_k
///     a += sum x_k,     b += n a_before + sum (n - k) x_k.
/// Rows of 32 bytes are summed by column: with s_c the sum of column c so far, and t_c that of all s_c up to
/// the row before, sum (n - k) x_k = sum over c of 32 t_c + (32 - c) s_c.
struct CheckSum {
  std::uint32_t a = 1, b = 0;
  static constexpr std::uint32_t modulus = 65521;
  static constexpr std::size_t columns = 32, most_rows = 1024;  // sums stay below 2^32

  void add(const std::vector<std::uint8_t>& bytes) {
    std::size_t first = 0;
    while (bytes.size() - first >= columns) {
      const std::size_t rows = std::min(most_rows, (bytes.size() - first) / columns);
      add_rows(bytes.data() + first, rows);
      first += rows * columns;
    }
    for (; first < bytes.size(); ++first) add_sums(1, bytes[first], bytes[first]);
  }
  void add_zeros(std::size_t count) { add_sums(count, 0, 0); }

 private:
  void add_rows(const std::uint8_t* bytes, std::size_t rows) {
    std::array<std::uint32_t, columns> sums{}, before{};
    for (std::size_t row = 0; row < rows; ++row, bytes += columns)
      for (std::size_t c = 0; c < columns; ++c) {
        before[c] += sums[c];
        sums[c] += bytes[c];
      }
    std::uint64_t sum = 0, weighted = 0;
    for (std::size_t c = 0; c < columns; ++c) {
      sum += sums[c];
      weighted += columns * std::uint64_t{before[c]} + (columns - c) * std::uint64_t{sums[c]};
    }
    add_sums(rows * columns, sum, weighted);
  }
  void add_sums(std::uint64_t count, std::uint64_t sum, std::uint64_t weighted) {
    b = static_cast<std::uint32_t>((b + count * a + weighted) % modulus);
    a = static_cast<std::uint32_t>((a + sum) % modulus);
  }
};

/// One byte of every number.
template <int shift>
void take_bytes(std::span<const std::uint32_t> numbers, std::vector<std::uint8_t>& plane) {
  plane.resize(numbers.size());
  const std::uint32_t* const from = numbers.data();
  std::uint8_t* __restrict const to = plane.data();
  for (std::size_t k = 0; k < numbers.size(); ++k) to[k] = static_cast<std::uint8_t>(from[k] >> shift);
}

}  // namespace

void ListDeflater::find_copies(std::span<const std::uint32_t> numbers) {
  copies_.clear();
  std::size_t list = 0;   // where the present list begins
  std::size_t other = 0;  // in the list before: those ahead of it are smaller than the number at hand
  for (std::size_t at = 0, before = 0; at < numbers.size();) {
    if (at > 0 && numbers[at] <= numbers[at - 1]) {
      before = std::exchange(list, at);
      other = before;
    }
    while (other < list && numbers[other] < numbers[at]) ++other;
    const std::size_t same =
        common(numbers.data() + at, numbers.data() + other, std::min(list - other, numbers.size() - at));
    if (same >= least_copy) copies_.push_back({at, same, at - other});
    at += std::max<std::size_t>(same, 1);
  }
}

void ListDeflater::pack(std::span<const std::uint32_t> numbers, std::vector<char>& chunk) {
  assert(!numbers.empty() && numbers.size() <= most_numbers);
  const std::size_t count = numbers.size();
  constexpr std::size_t around = 16;                        // header, check sum, and the writer's last word
  chunk.resize(numbers.size_bytes() / 8 * 9 + 9 + around);  // a byte takes nine bits at most
  chunk[0] = 0x78;                                          // deflate, 32 kB of window
  chunk[1] = 0x01;
  BitWriter out(chunk.data() + 2);
  out.put(0b011, 3);  // the last block, fixed codes
  find_copies(numbers);
  std::uint32_t used = 0;  // bits
  for (const std::uint32_t number : numbers) used |= number;
  CheckSum sum;
  constexpr auto take = std::array{take_bytes<0>, take_bytes<8>, take_bytes<16>, take_bytes<24>};
  for (int byte = 0; byte < 4; ++byte) {
    if (used >> 8 * byte == 0) {
      sum.add_zeros(count);
      put_zeros(out, count);
      continue;
    }
    take[byte](numbers, plane_);
    sum.add(plane_);
    std::size_t done = 0;
    for (const Copy& copy : copies_) {
      put_bytes(out, plane_, done, copy.at);
      out.put_copy(copy.length, copy.distance);
      done = copy.at + copy.length;
    }
    put_bytes(out, plane_, done, count);
  }
  char* end = out.finish();
  const std::uint32_t check = sum.b << 16 | sum.a;
  for (const int shift : {24, 16, 8, 0}) *end++ = static_cast<char>(check >> shift);
  chunk.resize(static_cast<std::size_t>(end - chunk.data()));
}

}  // namespace dresslife::pipeline
