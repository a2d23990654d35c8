// Dates and numbers as spreadsheets and maintenance systems export them, and what to write instead of a text that is none.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "pipeline/base/days.h"

namespace dresslife::pipeline {

/// "2027-07-12" or "12.7.2027". A time of day behind it does not count. Absent: no date, or one whose order is not known (7/12/2027).
std::optional<Day> exported_day(std::string_view text);
/// "write 2027-07-12", for a text that is no exported_day().
std::string day_remedy(const std::string& text);

/// With a decimal point or a decimal comma, and with marks between thousands where both occur (1.200,50). Absent: no number, or one whose
/// comma may separate thousands (1,200).
std::optional<double> exported_number(std::string text);
/// "write 1200 or 1.2", for a text that is no exported_number().
std::string number_remedy(const std::string& text);

/// Spreadsheets save letters beyond ASCII as Windows-1252, which no page and calendar shows. Errors: InputError at the line of the first such letter.
void check_utf8(const std::string& text, const std::string& file);

}  // namespace dresslife::pipeline
