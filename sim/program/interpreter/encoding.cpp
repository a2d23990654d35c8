#include "sim/program/interpreter/encoding.h"

#include <algorithm>
#include <cstdint>
#include <iterator>

#include "pipeline/base/text.h"

namespace dresslife::sim {
namespace {

constexpr std::uint32_t replacement = 0xFFFD;

/// Letters of Windows-1252 from 0x80 to 0x9F; 0: no letter. The other bytes are ISO 8859-1.
constexpr std::uint32_t windows_letters[] = {0x20AC, 0,      0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021,
                                             0x02C6, 0x2030, 0x0160, 0x2039, 0x0152, 0,      0x017D, 0,
                                             0,      0x2018, 0x2019, 0x201C, 0x201D, 0x2022, 0x2013, 0x2014,
                                             0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0,      0x017E, 0x0178};
static_assert(std::size(windows_letters) == 0xA0 - 0x80);

std::uint8_t byte_at(const std::string& bytes, std::size_t at) { return static_cast<std::uint8_t>(bytes[at]); }

void append(std::string& text, std::uint32_t letter) {
  const auto tail = [&](int shift) { text += static_cast<char>(0x80 | (letter >> shift & 0x3F)); };
  if (letter < 0x80) {
    text += static_cast<char>(letter);
  } else if (letter < 0x800) {
    text += static_cast<char>(0xC0 | letter >> 6);
    tail(0);
  } else if (letter < 0x10000) {
    text += static_cast<char>(0xE0 | letter >> 12);
    tail(6), tail(0);
  } else {
    text += static_cast<char>(0xF0 | letter >> 18);
    tail(12), tail(6), tail(0);
  }
}

std::string from_utf16(const std::string& bytes, std::size_t begin, bool big_endian) {
  const auto unit = [&](std::size_t at) -> std::uint32_t {
    const std::uint32_t a = byte_at(bytes, at), b = byte_at(bytes, at + 1);
    return big_endian ? a << 8 | b : b << 8 | a;
  };
  std::string text;
  for (std::size_t at = begin; at + 1 < bytes.size(); at += 2) {
    std::uint32_t letter = unit(at);
    const bool high = letter >= 0xD800 && letter < 0xDC00, low = letter >= 0xDC00 && letter < 0xE000;
    if (high && at + 3 < bytes.size() && unit(at + 2) >= 0xDC00 && unit(at + 2) < 0xE000) {
      letter = 0x10000 + ((letter - 0xD800) << 10) + (unit(at + 2) - 0xDC00);
      at += 2;
    } else if (high || low) {
      letter = replacement;
    }
    append(text, letter);
  }
  return text;
}

std::string from_single_bytes(const std::string& bytes) {
  std::string text;
  text.reserve(bytes.size() + bytes.size() / 8);
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    const std::uint8_t byte = byte_at(bytes, at);
    const std::uint32_t letter = byte >= 0x80 && byte < 0xA0 ? windows_letters[byte - 0x80] : byte;
    append(text, letter ? letter : replacement);
  }
  return text;
}

/// Whether the bytes are probably UTF-16 without a byte order mark: program text is almost only ASCII, so almost every
/// second byte is 0 ('A': 41 00 or 00 41).
bool every_other_byte_is_zero(const std::string& bytes, std::size_t first) {
  const std::size_t looked_at = std::min<std::size_t>(bytes.size(), 512);
  if (looked_at < 4) return false;
  std::size_t zeros = 0, others = 0;
  for (std::size_t at = 0; at < looked_at; ++at)
    if (bytes[at] == '\0') (at % 2 == first ? zeros : others) += 1;
  return others == 0 && zeros * 10 >= looked_at / 2 * 9;
}

}  // namespace

std::string decoded_text(std::string bytes) {
  if (bytes.starts_with(utf8_mark)) bytes.erase(0, utf8_mark.size());
  if (bytes.starts_with("\xFF\xFE")) return from_utf16(bytes, 2, false);
  if (bytes.starts_with("\xFE\xFF")) return from_utf16(bytes, 2, true);
  if (every_other_byte_is_zero(bytes, 1)) return from_utf16(bytes, 0, false);
  if (every_other_byte_is_zero(bytes, 0)) return from_utf16(bytes, 0, true);
  if (bytes.find('\n') == std::string::npos) std::ranges::replace(bytes, '\r', '\n');  // old line ends
  return pipeline::first_no_utf8(bytes) == bytes.size() ? bytes : from_single_bytes(bytes);
}

}  // namespace dresslife::sim
