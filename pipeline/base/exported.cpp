#include "pipeline/base/exported.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdio>

#include "pipeline/base/csv_rows.h"
#include "pipeline/base/errors.h"
#include "pipeline/base/text.h"

namespace dresslife::pipeline {
namespace {

/// Returns whether the text is like "1,200": its first comma stands before exactly three digits at the end.
bool may_be_thousands(const std::string& text) {
  const std::size_t comma = text.find(',');
  return comma != std::string::npos && text.size() == comma + 4 &&
         std::all_of(text.begin() + static_cast<long>(comma) + 1, text.end(),
                     [](unsigned char letter) { return std::isdigit(letter); });
}

/// Removes the separators of thousands from "1.200,50" and "1,200.50". Returns any other text unchanged.
std::string without_thousands(const std::string& text) {
  constexpr std::size_t thousand = 4;  // characters: three digits and a separator
  const std::size_t first = text.find_first_of(".,"), decimal = text.find_last_of(".,");
  if (first == text.npos || first == 0 || text[first] == text[decimal]) return text;
  std::string plain;
  for (std::size_t k = 0; k < decimal; ++k) {
    const bool mark = text[k] == text[first];
    if (mark != ((decimal - k) % thousand == 0)) return text;
    if (!mark) plain += text[k];
  }
  return plain + '.' + text.substr(decimal + 1);
}

std::optional<Day> day_in_order(int year, int month, int day) {
  return day_from(fmt::format("{:04}-{:02}-{:02}", year, month, day));
}

}  // namespace

std::optional<Day> exported_day(std::string_view text) {
  const std::string date(text.substr(0, text.find_first_of(" T")));
  if (const std::optional<Day> day = day_from(date)) return day;
  int day = 0, month = 0, year = 0, used = 0;
  constexpr int first_year = 1000;  // a year of two digits has an unknown century
  if (std::sscanf(date.c_str(), "%2d.%2d.%4d%n", &day, &month, &year, &used) != 3 ||
      used != static_cast<int>(date.size()) || year < first_year)
    return std::nullopt;
  return day_in_order(year, month, day);
}

std::string day_remedy(const std::string& text) {
  const auto days_words = [](int of_year, int of_month) {
    int last = 31;
    while (last > 28 && !day_in_order(of_year, of_month, last)) --last;
    return fmt::format("{} ({:04}-{:02} has {} days)", date_remedy, of_year, of_month, last);
  };
  constexpr const char* whole_column = ". A spreadsheet can give the whole column the format YYYY-MM-DD";
  int first = 0, second = 0, year = 0, used = 0;
  char mark = 0, again = 0;
  if (std::sscanf(text.c_str(), "%2d%c%2d%c%4d%n", &first, &mark, &second, &again, &year, &used) == 5 &&
      used == static_cast<int>(text.size()) && mark == again && year >= 1000) {
    const std::optional<Day> by_day = day_in_order(year, second, first), by_month = day_in_order(year, first, second);
    if (by_day && by_month && first != second)
      return fmt::format("{}: {} if the day comes first, {} if the month does{}", date_remedy, day_text(*by_day),
                         day_text(*by_month), whole_column);
    if (by_day || by_month) return fmt::format("write {}{}", day_text(by_day ? *by_day : *by_month), whole_column);
    if (second >= 1 && second <= 12) return days_words(year, second);
  }
  int month = 0, day = 0;
  if (std::sscanf(text.c_str(), "%4d-%2d-%2d%n", &year, &month, &day, &used) == 3 &&
      used == static_cast<int>(text.size())) {
    if (day_in_order(year, month, day)) return fmt::format("write {:04}-{:02}-{:02}", year, month, day);
    return month < 1 || month > 12 ? date_remedy + std::string(" (a year has 12 months)") : days_words(year, month);
  }
  constexpr double spreadsheet_1970 = 25569, spreadsheet_2100 = 73051;  // days since 1899-12-30
  if (const std::optional<double> days = number_in(text); days && *days > spreadsheet_1970 && *days < spreadsheet_2100)
    return fmt::format("write {} if that is the number of a spreadsheet",
                       day_text(Day(std::chrono::days(static_cast<int>(*days - spreadsheet_1970)))));
  return date_remedy;
}

std::optional<double> exported_number(std::string text) {
  if (may_be_thousands(text)) return std::nullopt;
  text = without_thousands(text);
  if (text.find('.') == text.npos && std::ranges::count(text, ',') == 1) text[text.find(',')] = '.';
  return number_in(text);
}

std::string number_remedy(const std::string& text) {
  if (may_be_thousands(text)) {
    std::string whole = text, decimal = text;
    std::erase(whole, ',');
    decimal[decimal.find(',')] = '.';
    return fmt::format("write {} or {}", whole, decimal);
  }
  std::string plain;
  // In "1,200.50" and "1.200,50" the last mark is the decimal mark.
  const std::size_t last = text.find_last_of(".,");
  const bool has_both = text.find('.') != text.npos && text.find(',') != text.npos;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char letter = has_both && k == last ? '.' : text[k];
    if (has_both && k != last && (letter == '.' || letter == ',')) continue;
    if (std::isdigit(static_cast<unsigned char>(letter)) || letter == '.' || letter == '-') plain += letter;
  }
  return !plain.empty() && plain != text && number_in(plain)
             ? fmt::format("write {}, without unit, blank or comma", plain)
             : "write a number with a decimal point";
}

std::string letters_of(std::string_view text) {
  std::string letters;
  for (const unsigned char letter : text)
    if (letter < 128 && std::isalpha(letter)) letters += static_cast<char>(std::tolower(letter));
  return letters;
}

const std::vector<std::string_view>& titles_of_installation() {
  static const std::vector<std::string_view> titles = words_in(
      "installed installedon installdate installationdate installation dateinstalled mounted einbau einbaudatum "
      "eingebaut eingebautam dateofinstallation instalado instaladoel instalacion instalacin fechadeinstalacion "
      "fechadeinstalacin fechainstalacion fechainstalacin montado montadoel fechademontaje fechamontaje");
  return titles;
}

const std::vector<std::string_view>& titles_of_weekly_hours() {
  static const std::vector<std::string_view> titles = words_in(
      "hoursperweek hperweek operatinghoursperweek stundenprowoche betriebsstundenprowoche hprowoche stundenwoche "
      "wochenstunden wochenbetriebsstunden betriebsstundenwoche hwoche horasporsemana hporsemana horassemanales "
      "horassemana hsemana horasdetrabajoporsemana horasdeoperacionporsemana horasdeoperacinporsemana "
      "horasdefuncionamientoporsemana");
  return titles;
}

void check_utf8(const std::string& text, const std::string& file) {
  const std::size_t at =
      std::min(first_no_utf8(text), text.find('\0'));  // in UTF-16, each ASCII character has a byte 0
  if (at >= text.size()) return;
  const bool table = file.ends_with(".csv");
  throw InputError(
      {file, 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<long>(at), '\n')), 0},
      "is no text in UTF-8", table ? "save the table as CSV UTF-8" : "save it in UTF-8 by the editor");
}

}  // namespace dresslife::pipeline
