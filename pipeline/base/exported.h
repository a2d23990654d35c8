// Reads dates and numbers as spreadsheets and maintenance systems export them. Suggests a correction for texts that cannot be
// read.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/base/days.h"

namespace dresslife::pipeline {

/// Reads "2027-07-12" or "12.7.2027". A time of day behind the date is ignored. Returns std::nullopt for a text that is no date,
/// and for a date whose order of day and month is ambiguous (7/12/2027).
std::optional<Day> exported_day(std::string_view text);
/// Returns a remedy such as "write 2027-07-12" for a text that exported_day() cannot read.
std::string day_remedy(const std::string& text);

/// Reads a number with a decimal point or a decimal comma. Separators of thousands are allowed if the number has both signs
/// (1.200,50). Returns std::nullopt for any other text, and for a number whose comma may separate thousands (1,200).
std::optional<double> exported_number(std::string text);
/// Returns a remedy such as "write 1200 or 1.2" for a text that exported_number() cannot read.
std::string number_remedy(const std::string& text);

/// Returns the letters of a text that are a to z, in lower case: "stundenwoche" for "Stunden/Woche".
std::string letters_of(std::string_view text);
/// Return the titles, as letters_of() returns them, under which maintenance systems export the day of installation and the hours
/// of operation per week.
const std::vector<std::string_view>& titles_of_installation();
const std::vector<std::string_view>& titles_of_weekly_hours();

/// Checks that a text is UTF-8. Spreadsheets save characters beyond ASCII as Windows-1252, which pages and calendars cannot show.
/// Errors: InputError with the line of the first byte that is not UTF-8.
void check_utf8(const std::string& text, const std::string& file);

}  // namespace dresslife::pipeline
