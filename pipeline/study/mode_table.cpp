#include "pipeline/study/mode_table.h"

#include <fmt/format.h>

#include <cmath>

#include "pipeline/study/row_words.h"

namespace dresslife::pipeline {
namespace {

bool is_buckling(const UnvalidatedMode& mode) {
  return mode.mode == UnvalidatedMode::corkscrew || mode.mode == UnvalidatedMode::kink;
}

/// Returns the life by a mode as text; "none" for a corkscrew or kink that so many dresspacks do not have.
std::string mode_life(const RankingRow& row, const UnvalidatedMode& mode, double hours) {
  if (std::isnan(hours) || !is_credible(mode)) return "-";
  return std::isinf(hours) && is_buckling(mode) ? "none" : shown_life(row, hours);
}

/// Returns "abrasion† on link_4".
std::string mode_name(const UnvalidatedMode& mode) {
  const std::string name = mode.mode + "†" + (mode.dresspack.empty() ? "" : " (" + mode.dresspack + ")");
  if (mode.mode == UnvalidatedMode::wall) return name;
  if (mode.mode == UnvalidatedMode::kink && !std::isfinite(mode.margin)) return name + ": nothing bends";
  if (mode.place.empty()) return name + ": nothing rubs";
  if (mode.mode == UnvalidatedMode::abrasion) return name + " on " + mode.place;
  return name + (is_buckling(mode) && std::isinf(mode.hours[0]) ? ", nearest: " : " of ") + mode.place;
}

std::string mode_note(const UnvalidatedMode& mode) {
  if (!is_credible(mode))
    return fmt::format(
        "Not predicted: the only known law gives {} bends from straight to the limit of the bend radius, and a published "
        "hose endured {} without damage. Keep the maker's bend radius. A bending test by the maker, as strain_life_table "
        "of the material of the wall, would give a life.",
        readable(mode.bends_at_limit), readable(published_wall_bends));
  const std::string words = (mode.mode == UnvalidatedMode::rating ? "A lower bound of its life. " : "") + mode.note;
  return words.substr(0, words.find_last_not_of(' ') + 1);
}

/// Returns "57 %" or "0.5 %". A share above zero is never "0 %", because even half a per cent changes the 10 % value.
std::string share_text(double share) {
  const double percent = 100 * share;
  if (percent > 0 && percent < 0.05) return "under 0.1 %";
  return fmt::format("{:.{}f} %", percent, percent > 0 && percent < 0.95 ? 1 : 0);
}

ModeLine line_of(const RankingRow& row, const UnvalidatedMode& mode) {
  ModeLine line;
  line.mode = mode_name(mode);
  for (std::size_t i = 0; i < line.hours.size(); ++i) line.hours[i] = mode_life(row, mode, mode.hours[i]);
  line.note = mode_note(mode);
  if (mode.place.empty()) {
    if (mode.mode != UnvalidatedMode::wall) line.hours.fill("none");
    return line;
  }
  if (row.has_wires() && !std::isnan(mode.first_share)) line.before_wires = share_text(mode.first_share);
  if (row.has_wires() && !std::isnan(mode.together_p10)) line.with_it = shown_life(row, mode.together_p10);
  line.from_tool = fmt::format("{:.2f}", mode.position_from_tool);
  if (mode.mode != UnvalidatedMode::wall) line.time = fmt::format("{:.1f}", mode.time);
  line.step = mode.step;
  line.early = is_credible(mode) && mode.early_hours() < replacement_hours(row);
  return line;
}

}  // namespace

std::string cell_legend(const std::vector<ModeLine>& lines) {
  bool unknown = false, none = false;
  for (const ModeLine& line : lines)
    for (const std::string& cell : line.hours) unknown = unknown || cell == "-", none = none || cell == "none";
  return std::string(none ? " none: so many dresspacks never fail by this mode." : "") +
         (unknown ? " -: not predicted." : "");
}

std::vector<ModeLine> mode_lines(const RankingRow& row) {
  std::vector<ModeLine> lines;
  if (row.planned()) {
    ModeLine wires;
    wires.mode = !row.failing_conductor.empty() ? "wires of " + row.failing_conductor : "wires";
    if (row.failing_conductor.empty() && !row.failing_mode.empty()) wires.mode = row.failing_mode;
    for (std::size_t i = 0; i < wires.hours.size(); ++i) wires.hours[i] = shown_life(row, row.planned_hours[i]);
    wires.with_it = wires.hours[0];
    if (!row.failing_conductor.empty()) wires.from_tool = fmt::format("{:.2f}", row.failing_position_from_tool);
    lines.push_back(wires);
  }
  for (const UnvalidatedMode& mode : row.unvalidated) lines.push_back(line_of(row, mode));
  return lines;
}

std::string mode_table(const RankingRow& row, std::size_t width, const std::string& indent) {
  const std::vector<ModeLine> lines = mode_lines(row);
  if (lines.empty() || row.unvalidated.empty()) return "";
  std::array<Column, 7> columns{{{"fails by", false, {}},
                                 {"10 % [h]", true, {}},
                                 {"half [h]", true, {}},
                                 {"90 % [h]", true, {}},
                                 {"before wires", true, {}},
                                 {"from tool [m]", true, {}},
                                 {"at [s]", true, {}}}};
  for (const ModeLine& line : lines) {
    const std::array cells{line.mode,         line.hours[0],  line.hours[1], line.hours[2],
                           line.before_wires, line.from_tool, line.time};
    for (std::size_t i = 0; i < cells.size(); ++i) columns[i].cells.push_back(cells[i]);
  }
  std::string text = indent + table_line(columns, [](const Column& column) { return column.title; });
  for (std::size_t k = 0; k < lines.size(); ++k)
    text += indent + table_line(columns, [k](const Column& column) { return column.cells[k]; });
  for (const ModeLine& line : lines)
    if (line.early && !line.note.empty())
      text += wrapped(fmt::format("{}: {}", line.mode.substr(0, line.mode.find("†")), line.note), width, indent);
  return text;
}

std::string mode_legend(const std::vector<RankingRow>& rows, std::size_t width, const std::string& indent) {
  std::vector<ModeLine> all;
  for (const RankingRow& row : rows)
    if (row.has_result() && !row.unvalidated.empty())
      for (ModeLine& line : mode_lines(row)) all.push_back(std::move(line));
  if (all.empty()) return "";
  return wrapped(
      "† No test confirms the law of this mode: 'replace after' leaves it out." + cell_legend(all) +
          " before wires: share of the samples in which the mode comes before broken wires. at: time of its largest load. "
          "wires: hours until a conductor has lost its share of wires. The worst wire is that of the shortest median life with the "
          "job's own values. It may be in another conductor.",
      width, indent);
}

}  // namespace dresslife::pipeline
