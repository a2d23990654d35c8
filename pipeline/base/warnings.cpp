#include "pipeline/base/warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "pipeline/base/csv_rows.h"
#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/readable.h"
#include "pipeline/base/screen.h"
#include "pipeline/base/text.h"
#include "pipeline/base/warning_words.h"

namespace dresslife::pipeline {
namespace {

constexpr std::size_t most_bytes = 60'000;  // HDF5 allows 64 kB in an attribute
constexpr std::string_view cause_mark = ". Likely cause: ", remedy_mark = ". Remedy: ";
constexpr const char* separator = ": ";            // between key and value
constexpr std::string_view amount_key = "amount";  // no key of a job

struct KindTexts {
  WarningKind kind;
  const char *word, *title;
  bool spoils_plan;
};
constexpr KindTexts kinds[] = {
    {WarningKind::program, "program", "skipped instructions", true},
    {WarningKind::bend_radius, "bend_radius", "bend radius", true},
    {WarningKind::twist, "twist", "twist", true},
    {WarningKind::tension, "tension", "tension", true},
    {WarningKind::slack, "slack", "slack", true},
    {WarningKind::periodic, "periodic", "not periodic", true},
    // nominal cross-sections; real cables deform
    {WarningKind::overlap, "overlap", "overlapping parts", false},
    {WarningKind::mesh, "mesh", "numerical error", false},  // the message states the size of the error
    {WarningKind::force, "force", "forces", true},
    {WarningKind::material, "material", "doubtful input", false},  // the constants may be right
    {WarningKind::strain, "strain", "strain", true},
    {WarningKind::calibration, "calibration", "calibration", false},  // the uncertainty of the prior applies
    {WarningKind::motion, "motion", "unusual motion", true},
    {WarningKind::side, "side", "two sides", true},
    // The message states the share of such dresspacks and the measurement that rules them out.
    {WarningKind::other_values, "other_values", "limits at other values", false},
};
static_assert(std::size(kinds) == warning_kinds_count);
static_assert(std::ranges::is_sorted(kinds, {}, &KindTexts::kind));

const KindTexts& texts_of(WarningKind kind) { return kinds[static_cast<std::size_t>(kind)]; }

std::optional<WarningKind> kind_named(std::string_view name) {
  for (int k = 0; k < warning_kinds_count; ++k)
    if (name == word(static_cast<WarningKind>(k))) return static_cast<WarningKind>(k);
  return std::nullopt;
}

/// Replaces control characters, because tabs and line feeds are separators.
std::string plain(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 0x20; }, ' ');
  return text;
}

}  // namespace

const char* word(WarningKind kind) { return texts_of(kind).word; }
const char* title(WarningKind kind) { return texts_of(kind).title; }
bool spoils_plan(WarningKind kind) { return texts_of(kind).spoils_plan; }

std::string Warning::line() const { return where.empty() ? "warning: " + words : where + ": warning: " + words; }
std::string paragraph(const std::string& of) {
  const std::size_t columns = screen_columns();
  const std::string indent = "    ";
  std::string rest = of, text;
  for (const std::string_view begin : {cause_mark, remedy_mark})
    if (const std::size_t at = rest.find(begin); at != std::string::npos) {
      text += wrapped(rest.substr(0, at + 1), columns, indent);
      rest.erase(0, at + 2);
    }
  return (text + wrapped(rest, columns, indent)).substr(indent.size());
}
std::string Warning::text() const { return where.empty() ? words : where + ": " + words; }

std::string Remedy::text() const {
  return preferred + joined(mapped(values, [](const KeyValue& of) { return of.key + separator + of.value; }), " and ") +
         words;
}

Warning warning_of(WarningKind kind, std::string where, const std::string& what, const std::string& cause,
                   const Remedy& remedy) {
  return {kind, std::move(where), what + std::string(cause_mark) + cause + std::string(remedy_mark) + remedy.text(),
          remedy.values};
}
Warning warning_of(WarningKind kind, std::string where, const std::string& what, const std::string& cause,
                   const std::string& remedy) {
  return warning_of(kind, std::move(where), what, cause, Remedy{{}, remedy});
}

void WarningsOfKind::operator()(const Where& where, const std::string& what, const std::string& cause,
                                const std::string& remedy) const {
  warnings_->push_back(warning_of(kind_, where.text(), what, cause, remedy));
}

void WarningsOfKind::number(const Where& where, std::string_view key, std::string_view of, double value,
                            const Limits& limits, std::initializer_list<OtherUnit> units,
                            const Otherwise& otherwise) const {
  constexpr double rounding = 1e-9;  // relative: of conversions between SI and the unit of a key
  const auto keeps = [&](double x) {
    return x >= limits.low - rounding * std::abs(limits.low) && x <= limits.high + rounding * std::abs(limits.high);
  };
  if (keeps(value)) return;
  const auto text = [](double x) {  // as it is written, if that is short
    const std::string whole = fmt::format("{:g}", x);
    return whole.size() <= 6 ? whole : fmt::format("{:.4g}", x);
  };
  const bool both = limits.high < no_limit && limits.low > -no_limit && (limits.low != 0 || value < 0);
  const std::string range = both                      ? text(limits.low) + " .. " + text(limits.high)
                            : limits.high == no_limit ? text(limits.low) + " or more"
                                                      : text(limits.high) + " or less";
  std::string cause, remedy;
  for (const OtherUnit& unit : units)
    if (const double meant = unit.factor * value; keeps(meant)) {
      if (cause.empty()) cause = unit.cause;
      remedy +=
          fmt::format("{} {} if that was {}", remedy.empty() ? fmt::format("{}:", key) : ",", text(meant), unit.unit);
    }
  if (!remedy.empty())
    remedy += otherwise.also;
  else
    cause = otherwise.cause,
    remedy = otherwise.remedy.empty() ? fmt::format("{}: {}", key, range) : std::string(otherwise.remedy);
  (*this)(where, fmt::format("{}{} is {} (limit{} {}{})", key, of, text(value), both ? "s" : "", range, limits.reason),
          cause, remedy);
}

void WarningsOfKind::week(const Where& where, std::string_view key, std::string_view of, double hours) const {
  if (hours > hours_of_day) return;
  const bool share = hours < 1;
  const double meant = (share ? 168 : 5) * hours;
  (*this)(where, fmt::format("{}{} is {:g} (limit more than {:g})", key, of, hours, hours_of_day),
          share ? "a share of the week" : "hours of a day",
          fmt::format("{}: {}; leave it if the robot runs so little", key,
                      meant > hours_of_day
                          ? fmt::format("{:g} if that was {}", meant, share ? "a share" : "per working day")
                          : "80, or the hours of a week"));
}

WarningParts parts_of(std::string words) {
  WarningParts parts;
  const auto cut = [&](std::string_view mark, std::string& part) {
    const std::size_t at = words.find(mark);
    if (at == std::string::npos) return;
    part = words.substr(at + mark.size());
    words.erase(at);
  };
  cut(remedy_mark, parts.remedy);
  cut(cause_mark, parts.cause);
  parts.problem = std::move(words);
  return parts;
}

std::string warnings_text(const std::vector<Warning>& warnings) {
  std::string text;
  for (std::size_t k = 0; k < warnings.size(); ++k) {
    std::string line = fmt::format("{}{}\t{}\t{}", k ? "\n" : "", word(warnings[k].kind), plain(warnings[k].where),
                                   plain(warnings[k].words));
    for (const KeyValue& of : warnings[k].remedy) line += "\t" + plain(of.key + separator + of.value);
    if (warnings[k].amount) line += fmt::format("\t{}{}{}", amount_key, separator, *warnings[k].amount);
    if (text.size() + line.size() > most_bytes)
      return text +
             fmt::format("{}{}\t\tand {} more warnings", k ? "\n" : "", word(warnings[k].kind), warnings.size() - k);
    text += line;
  }
  return text;
}

std::vector<Warning> warnings_from(const std::string& text) {
  std::vector<Warning> warnings;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::vector<std::string> fields = parts_between(line, "\t");
    if (fields.size() < 3) continue;
    const auto kind = kind_named(fields[0]);
    if (!kind) continue;
    Warning warning{*kind, fields[1], fields[2]};
    for (std::size_t k = 3; k < fields.size(); ++k)
      if (const std::size_t at = fields[k].find(separator); at != std::string::npos) {
        KeyValue of{fields[k].substr(0, at), fields[k].substr(at + std::string_view(separator).size())};
        if (of.key == amount_key)
          warning.amount = number_in(of.value);
        else
          warning.remedy.push_back(std::move(of));
      }
    warnings.push_back(std::move(warning));
  }
  return warnings;
}

std::vector<Warning> joined(std::vector<Warning> earlier, const std::vector<Warning>& own) {
  for (const Warning& warning : own)
    if (std::ranges::find(earlier, warning) == earlier.end()) earlier.push_back(warning);
  return earlier;
}

}  // namespace dresslife::pipeline
