// Converts program text to UTF-8. Input encodings: UTF-8 with or without a byte order mark, UTF-16 of either byte
// order, or one byte per letter (Windows-1252, which contains ISO 8859-1). Other multibyte encodings (GBK) are read
// as single bytes: their letters change, which has no effect inside comments.
#pragma once

#include <string>
#include <string_view>

namespace dresslife::sim {

inline constexpr std::string_view utf8_mark = "\xEF\xBB\xBF";  ///< byte order mark of UTF-8

/// Returns the text in UTF-8 without a byte order mark. Half a surrogate pair becomes U+FFFD.
std::string decoded_text(std::string bytes);

}  // namespace dresslife::sim
