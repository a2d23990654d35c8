#include "pipeline/report/life_matrix.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <utility>

#include "pipeline/base/readable.h"
#include "pipeline/report/plot.h"
#include "pipeline/study/row_warnings.h"

namespace dresslife::pipeline {
namespace {

constexpr std::size_t most_cells = 4000;  // enough for 2,000 jobs if half of the combinations are missing

using Colour = std::array<double, 3>;
/// Orange, near white, blue: distinct for colour-blind readers; black text is legible on each.
constexpr std::array<Colour, 3> stops{{{235, 145, 70}, {245, 240, 232}, {120, 180, 220}}};

std::string colour_of(double part) {
  const double place = std::clamp(part, 0.0, 1.0) * (stops.size() - 1);
  const std::size_t k = std::min<std::size_t>(static_cast<std::size_t>(place), stops.size() - 2);
  const auto mixed = [&](std::size_t c) {
    return std::lround(stops[k][c] + (place - static_cast<double>(k)) * (stops[k + 1][c] - stops[k][c]));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", mixed(0), mixed(1), mixed(2));
}

/// A key and its values, in the order of the rows, which are sorted by name.
struct Key {
  std::size_t index = 0;
  std::vector<std::string> values;

  std::size_t place(const std::string& value) const {
    return static_cast<std::size_t>(std::ranges::find(values, value) - values.begin());
  }
};

/// Orders "free_length_m=1.05" before "free_length_m=1.2": by number if both end in a number after the same word.
bool before(const std::string& a, const std::string& b) {
  const std::size_t equals = a.find('=');
  if (equals == std::string::npos || a.compare(0, equals, b, 0, b.find('=')) != 0) return a < b;
  const auto number = [&](const std::string& text) {
    const double value = std::strtod(text.c_str() + equals + 1, nullptr);
    return std::isnan(value) ? 0 : value;
  };
  return number(a) != number(b) ? number(a) < number(b) : a < b;
}

/// Returns the keys with two values or more.
std::vector<Key> axes_of(const std::vector<RankingRow>& rows) {
  std::vector<Key> axes;
  const std::size_t keys = rows.empty() ? 0 : rows.front().varied.size();
  for (std::size_t key = 0; key < keys; ++key) {
    Key axis{key, {}};
    for (const RankingRow& row : rows)
      if (row.varied.size() == keys) axis.values.push_back(row.varied[key].second);
    std::ranges::sort(axis.values, before);
    axis.values.erase(std::unique(axis.values.begin(), axis.values.end()), axis.values.end());
    if (axis.values.size() > 1) axes.push_back(std::move(axis));
  }
  return axes;
}

/// The row with the shortest life (a failed row counts as shortest), and the number of jobs in the cell.
struct MatrixCell {
  std::size_t row = 0, jobs = 0;
};

bool shorter(const RankingRow& a, const RankingRow& b) {
  if (a.done() != b.done()) return !a.done();
  return a.headline_hours() < b.headline_hours();
}

/// Returns the logarithms of the shortest and the longest finite life among the cells; std::nullopt if none is finite.
std::optional<std::pair<double, double>> span_of(
    const std::vector<RankingRow>& rows, const std::map<std::pair<std::size_t, std::size_t>, MatrixCell>& cells) {
  std::optional<std::pair<double, double>> span;
  for (const auto& [place, cell] : cells) {
    const double hours = rows[cell.row].headline_hours();
    if (!rows[cell.row].done() || !(hours > 0) || std::isinf(hours)) continue;
    const double log = std::log(hours);
    span = span ? std::pair(std::min(span->first, log), std::max(span->second, log)) : std::pair(log, log);
  }
  return span;
}

std::string cell_text(const RankingRow& row, const MatrixCell& cell,
                      const std::optional<std::pair<double, double>>& span, const std::string& address) {
  const auto linked = [&](const std::string& words) {
    return address.empty() ? words : fmt::format("<a href=\"{}\">{}</a>", address, words);
  };
  const std::string many = cell.jobs > 1 ? fmt::format("<br><small>shortest of {}</small>", cell.jobs) : "";
  const double hours = row.headline_hours();
  if (!row.done())
    return fmt::format("<td title=\"{}: {}\"><span class=\"failed\">{}</span>{}</td>", escaped(row.job),
                       escaped(row.stale ? stale_words(row) : row.failure),
                       linked(row.stale     ? fmt::format("stale {}", printed_life(hours))
                              : row.waits() ? row.failure
                                            : "failed"),
                       many);
  const bool spread = span && span->second > span->first;
  const double between = spread ? (std::log(hours) - span->first) / (span->second - span->first) : 0.5;
  const double part = !(hours > 0) ? 0 : std::isinf(hours) ? 1 : between;
  const std::string kinds = warning_kinds(row);
  return fmt::format("<td class=\"coloured\" style=\"background:{}\" title=\"{}{}{}\">{}{}{}</td>", colour_of(part),
                     escaped(row.job), kinds.empty() ? "" : "; warnings: ", escaped(kinds), linked(printed_life(hours)),
                     kinds.empty() ? "" : " <span aria-label=\"has warnings\">\u26a0</span>", many);
}

}  // namespace

std::string life_matrix(const std::vector<RankingRow>& rows, const std::function<std::string(std::size_t row)>& link) {
  std::vector<Key> axes = axes_of(rows);
  if (axes.size() != 2 || axes[0].values.size() * axes[1].values.size() > most_cells) return "";
  if (axes[0].values.size() < axes[1].values.size()) std::swap(axes[0], axes[1]);
  const Key &down = axes[0], &across = axes[1];
  std::map<std::pair<std::size_t, std::size_t>, MatrixCell> cells;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (rows[k].varied.size() <= std::max(down.index, across.index)) continue;
    MatrixCell& cell =
        cells[{down.place(rows[k].varied[down.index].second), across.place(rows[k].varied[across.index].second)}];
    if (cell.jobs++ == 0 || shorter(rows[k], rows[cell.row])) cell.row = k;
  }
  const auto span = span_of(rows, cells);
  const auto& names = rows.front().varied;
  std::string head, body;
  for (const std::string& value : across.values) head += fmt::format("<th scope=\"col\">{}</th>", escaped(value));
  for (std::size_t r = 0; r < down.values.size(); ++r) {
    body += fmt::format("<tr><th scope=\"row\">{}</th>", escaped(down.values[r]));
    for (std::size_t c = 0; c < across.values.size(); ++c) {
      const auto cell = cells.find({r, c});
      body += cell == cells.end() ? "<td>-</td>"
                                  : cell_text(rows[cell->second.row], cell->second, span, link(cell->second.row));
    }
    body += "</tr>\n";
  }
  return fmt::format(
      "<h3>{0} by {1}</h3>\n<p class=\"soft\">p10 life in hours of motion, orange the shortest, blue the longest (by its "
      "logarithm); \u26a0 has warnings (in the ranking).</p>\n<div class=\"wide\"><table id=\"matrix\">\n<thead><tr><th "
      "scope=\"col\">{0} \\ {1}</th>{2}</tr></thead>\n<tbody>\n{3}</tbody></table></div>\n",
      escaped(names[down.index].first), escaped(names[across.index].first), head, body);
}

}  // namespace dresslife::pipeline
