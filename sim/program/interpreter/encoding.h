// Program text as UTF-8, whatever the controller's or the programmer's editor wrote: UTF-8 with or without a
// byte order mark, UTF-16 of either byte order, or one byte a letter (Windows-1252 and its ISO 8859-1).
// Multibyte texts of other tables (GBK) are read as single bytes: their letters become others, which harms
// nothing where they stand in comments. Source: The Unicode Standard 15, section 3.9, and RFC 3629.
#pragma once

#include <string>

namespace dresslife::sim {

/// Whether every byte belongs to a well-formed UTF-8 sequence.
bool is_utf8(const std::string& bytes);

/// The text in UTF-8, without a byte order mark. Half a surrogate pair becomes U+FFFD.
std::string decoded_text(std::string bytes);

}  // namespace dresslife::sim
