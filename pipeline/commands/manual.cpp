#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "pipeline/advise/plan/duty.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/text.h"
#include "pipeline/commands/command.h"
#include "pipeline/commands/options.h"
#include "pipeline/files/files.h"
#include "pipeline/job/cluster.h"
#include "pipeline/resolve/data_sheet.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/settings/fields.h"
#include "pipeline/settings/problems.h"
#include "pipeline/stage/program_manual.h"
#include "pipeline/study/ranking_columns.h"
#include "pipeline/study/study.h"
namespace dresslife::pipeline {
namespace {

/// Keys that a first job needs. All other keys have a default or belong to a special case.
const WordSet first_keys = word_set(
    "motion robot dresspack routing study.base study.vary study.jobs study.table motion.program motion.modules "
    "motion.routine motion.speed_percent motion.steps motion.steps[].joints_deg motion.steps[].speed_percent "
    "motion.steps[].dwell_s dresspack.diameter_mm dresspack.inner_diameter_mm dresspack.components "
    "dresspack.components[].name dresspack.components[].count dresspack.components[].radius_mm "
    "dresspack.components[].slack_percent dresspack.components[].measured_bending_stiffness_Nm2 "
    "dresspack.components[].without_wires dresspack.components[].without_wires.kind "
    "dresspack.components[].without_wires.bore_mm dresspack.components[].without_wires.filled_with "
    "dresspack.components[].data_sheet.cores dresspack.components[].data_sheet.cross_section_mm2 "
    "dresspack.components[].data_sheet.conductor_class dresspack.components[].data_sheet.outer_diameter_mm "
    "routing.free_length_m routing.base_clamp routing.base_clamp.link routing.base_clamp.position_m "
    "routing.base_clamp.direction routing.tool_clamp simulation.segments fatigue.operating_hours_per_week "
    "fatigue.robot_life_hours calibration");

/// Returns the path of a key as on a command line: "motion.program"; for a key of the job itself "motion".
std::string path_of(const KeyRow& row) { return row.map == "job" ? row.key : row.map + "." + row.key; }

std::vector<KeyRow> every_key() {
  std::vector<KeyRow> rows;
  for (const std::vector<KeyRow>& some : {study_keys(), job_keys(), duty_keys(), key_rows<Cluster>("cluster")})
    rows.insert(rows.end(), some.begin(), some.end());
  return rows;
}

/// Returns the manual page: the keys of a first job by their paths, then the other keys by map.
std::string keys_page() {
  std::vector<KeyRow> first, others;
  for (KeyRow& row : every_key()) {
    const std::string path = path_of(row);
    if (!first_keys.contains(path))
      others.push_back(std::move(row));
    else
      first.push_back({"Keys of a first job", path, row.unit, row.allowed, row.fallback, row.meaning});
  }
  return key_tables(first) + "\n" + key_tables(others);
}

/// Returns the path in the form of the manual, with or without numbers of list items: "components.2.count" gives
/// "components[].count".
std::string as_in_manual(const std::string& key) {
  std::string path;
  for (const std::string& part : parts_between(key, "."))
    if (!part.empty() && part.find_first_not_of("0123456789") == std::string::npos)
      path += "[]";
    else
      path += (path.empty() ? "" : ".") + part;
  return path.starts_with("job.") ? path.substr(4) : path;
}

/// Returns the key with this path; else all keys whose path ends with it; else all keys with its last name; else the keys of a map; else
/// the keys whose meaning mentions it as a short form.
/// Errors: InputError with the nearest name if no key is found.
std::vector<KeyRow> keys_of(const std::string& wanted) {
  const std::vector<KeyRow> all = every_key();
  const std::string path = as_in_manual(wanted);
  const std::string last = path.substr(path.rfind('.') + 1);
  std::vector<KeyRow> found;
  const auto take = [&](const auto& fits) {
    if (found.empty()) std::copy_if(all.begin(), all.end(), std::back_inserter(found), fits);
  };
  take([&](const KeyRow& row) { return path_of(row) == path; });
  take([&](const KeyRow& row) { return ("." + path_of(row)).ends_with("." + path); });
  take([&](const KeyRow& row) { return row.key == last; });
  if (found.size() == 1) {  // a list of maps: the keys of an item say how to write it
    const std::string item = path_of(found[0]) + "[]";
    std::copy_if(all.begin(), all.end(), std::back_inserter(found), [&](const KeyRow& row) { return row.map == item; });
  }
  take([&](const KeyRow& row) {
    return ("." + row.map).ends_with("." + path);
  });  // all keys of a map that is not a key itself
  // a short form that stands for other keys, such as `place: auto`
  take([&](const KeyRow& row) {
    return row.meaning.find("`" + last + ":") != std::string::npos ||
           row.meaning.find("'" + last + ":") != std::string::npos;
  });
  if (!found.empty()) return found;
  std::vector<std::string> names = mapped(all, &KeyRow::key);
  for (const RankingColumn& column : ranking_columns()) names.push_back(column.name);
  const std::string near = nearest_word(last, names);
  throw InputError({"dresslife manual"}, fmt::format("there is no key or column '{}'", wanted),
                   near.empty() ? "see 'dresslife manual keys' and 'dresslife manual ranking.csv'"
                                : fmt::format("did you mean '{}'?", near));
}

std::string keys_text(const std::string& wanted) {
  std::string text;
  const std::vector<KeyRow> rows = keys_of(wanted);
  if (rows.size() > 1 && rows.front().map.ends_with(".data_sheet")) text = sheet_syntax();
  for (const KeyRow& row : rows)
    text += fmt::format("{}{}\n  {}\n  allowed: {}{}\n  default: {}\n", &row == &rows.front() ? "" : "\n", path_of(row),
                        row.meaning, row.allowed, row.unit.empty() ? "" : ", unit " + row.unit, row.fallback);
  return text;
}

/// Returns the column of ranking.csv with this name; null: none, or a key has this name.
const RankingColumn* column_named(const std::string& name) {
  const std::vector<KeyRow> keys = every_key();
  return find_in(keys, &KeyRow::key, name) ? nullptr : find_in(ranking_columns(), &RankingColumn::name, name);
}

int manual(const Command& program, const std::string& what) {
  if (what == "keys")
    print(keys_page());
  else if (what == "files")
    print(file_manual());
  else if (what == "ranking.csv")
    print(ranking_manual());
  else if (std::ranges::find(manual_kinds(), what) != manual_kinds().end())
    print(program_manual(program, what));
  else if (const RankingColumn* const column = column_named(what))
    print(fmt::format("column {} of ranking.csv\n  {}\n  unit: {}\n", column->name, column->meaning, column->unit));
  else
    print(keys_text(what));
  return 0;
}

}  // namespace

Command manual_command(const Command& program) {
  const auto what = std::make_shared<std::string>();
  std::vector<std::string> references{"keys", "files", "ranking.csv"};
  references.insert(references.end(), manual_kinds().begin(), manual_kinds().end());
  return {
      "manual",
      "print a reference: one KEY, such as slack_percent, or COLUMN of ranking.csv; all keys, all files or the columns of "
      "ranking.csv (Markdown); the man page, a shell's completion",
      {{"what",
        "",
        "KEY, COLUMN, keys, files, ranking.csv, man, bash or zsh",
        what.get(),
        {.required = true, .choices = references, .other_values = true}}},
      [&program, what] { return manual(program, *what); }};
}

}  // namespace dresslife::pipeline
