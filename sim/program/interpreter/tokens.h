// The tokens of a program: identifiers, numbers, texts and signs, each with its place.
#pragma once

#include <string_view>
#include <vector>

#include "pipeline/base/text.h"
#include "sim/program/interpreter/program.h"

namespace dresslife::sim {

struct Token {
  enum class Kind { word, number, text, sign, line_end, end };
  Kind kind = Kind::end;
  std::string_view text;  ///< part of the source; for Kind::text without the quotes
  double number = 0;
  int line = 0, column = 0;
};

struct TokenRules {
  char comment;            ///< first character of a comment, which ends at the line's end
  std::string_view extra;  ///< characters that may begin a word besides letters
  bool line_ends;          ///< whether a line's end ends a statement
  bool based_numbers;      ///< 'H1F' and 'B0110'
};

/// Splits a file into tokens. A character that begins no token becomes a problem and is skipped. The last token is
/// Kind::end. The tokens point into `source`.
std::vector<Token> tokens_of(const SourceFile& source, const TokenRules& rules, Problems& problems);

using pipeline::lower_case;
using pipeline::same_word;
using pipeline::trimmed;
using pipeline::upper_case;

}  // namespace dresslife::sim
