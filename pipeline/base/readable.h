// Formats numbers for people: tables, axes and the report. Files for programs use units.h instead.
#pragma once

#include <string>

namespace dresslife::pipeline {

/// Returns a number with `figures` significant figures: "0.0123", "1.5", "12,300"; "4.56e+12" from ten digits on. Infinity is
/// "unlimited", NaN is "-".
std::string readable(double value, int figures = 3);

/// life_text returns a life in any unit: readable(), or "no damage" for infinity. hours_text adds the unit: "1,234 h".
std::string life_text(double life, int figures = 3);
std::string hours_text(double hours);

/// Returns a calendar time in words: "5.7 years", "13.2 months", "1.6 days", "less than a day", "unlimited".
std::string calendar_words(double months);
/// Returns a life in words: calendar_words(), or "no damage" for infinity.
std::string calendar_text(double months);

/// Returns a number with at most `most_decimals` decimals and without trailing zeros: "0.25", "2", "0" for -0.0001.
std::string short_decimal(double value, int most_decimals);

/// Groups the digits before the decimal point in threes: "1234567.5" -> "1,234,567.5".
std::string grouped(std::string digits);

/// Returns the number of terminal columns of a UTF-8 text. Assumes that every character is one column wide.
std::size_t columns_of(const std::string& text);

/// Breaks a text at spaces into lines of at most `columns` that begin with `indent`. The result ends with a line feed. A longer
/// word stays whole. An empty text stays empty.
std::string wrapped(const std::string& text, std::size_t columns, const std::string& indent);
/// Breaks the lines that are wider than `columns`. Their further parts begin four blanks behind the first.
std::string wrapped_lines(const std::string& text, std::size_t columns);

/// Shortens a text to at most `columns` whole characters; a shortened text ends with "...".
std::string shortened(const std::string& text, std::size_t columns);

}  // namespace dresslife::pipeline
