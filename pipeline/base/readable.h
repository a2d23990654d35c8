// Numbers as people read them, for tables, axes and the report. Files that programs read use units.h instead.
#pragma once

#include <string>

namespace dresslife::pipeline {

/// `figures` significant figures: "0.0123", "1.5", "12,300", "4.56e+12" from ten digits on. Infinity is
/// "unlimited", NaN is "-".
std::string readable(double value, int figures = 3);

/// A life in any unit: readable(), or "no damage" for infinity. hours_text: the same with its unit,
/// "1,234 h".
std::string life_text(double life, int figures = 3);
std::string hours_text(double hours);

/// A time in calendar months as people say it: "5.7 years", "13.2 months", "1.6 days", "less than a day",
/// "unlimited".
std::string calendar_words(double months);
/// The same of a life: "no damage" for infinity.
std::string calendar_text(double months);

/// With at most so many decimals, without zeros at its end: "0.25", "2", "0" for -0.0001.
std::string short_decimal(double value, int most_decimals);

/// The digits of a whole part in groups of three: "1234567.5" -> "1,234,567.5".
std::string grouped(std::string digits);

/// Columns that UTF-8 text takes in a terminal where every character is one wide.
std::size_t columns_of(const std::string& text);

/// Text in lines of at most `columns`, broken at spaces, each begun with `indent`; ends with a line feed. A
/// word that is longer stays whole. Empty: empty.
std::string wrapped(const std::string& text, std::size_t columns, const std::string& indent);

/// Text cut at a character to at most `columns`, "..." at its end when something was cut.
std::string shortened(const std::string& text, std::size_t columns);

}  // namespace dresslife::pipeline
