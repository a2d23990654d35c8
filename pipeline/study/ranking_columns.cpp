#include "pipeline/study/ranking_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/settings/units.h"

namespace dresslife::pipeline {
namespace {

std::string cell(double value) { return std::isnan(value) ? "" : shortest_text(value); }
std::string cell(const std::optional<double>& value) { return value ? shortest_text(*value) : ""; }
std::string cell(int value) { return std::to_string(value); }
std::string cell(const std::string& value) { return value; }

/// Returns a column whose cells are a member of the row.
template <class Member>
RankingColumn of(std::string name, std::string unit, std::string meaning, Member RankingRow::*member) {
  return {std::move(name), std::move(unit), std::move(meaning),
          [member](const RankingRow& row) { return cell(row.*member); }};
}

/// Returns a column whose cells are computed for some rows and empty for the others.
template <class Applies, class Value>
RankingColumn where(std::string name, std::string unit, std::string meaning, Applies applies, Value value) {
  return {std::move(name), std::move(unit), std::move(meaning), [=](const RankingRow& row) {
            return std::invoke(applies, row) ? cell(std::invoke(value, row)) : std::string();
          }};
}

bool always(const RankingRow&) { return true; }
bool evaluated(const RankingRow& row) { return row.has_wires(); }
/// Returns a column whose cells describe an unvalidated mode; empty in rows without this mode.
template <class Value>
RankingColumn of_mode(std::string name, std::string unit, std::string meaning, const char* mode, Value value) {
  return {std::move(name), std::move(unit), std::move(meaning), [=](const RankingRow& row) {
            const UnvalidatedMode* const found = row.unvalidated_mode(mode);
            return found ? cell(std::invoke(value, *found)) : std::string();
          }};
}
bool has_warning(const RankingRow& row, WarningKind kind) {
  return row.warnings &&
         std::ranges::any_of(*row.warnings, [&](const Warning& warning) { return warning.kind == kind; });
}
bool has_rating(const RankingRow& row) { return row.relative.has_value(); }

using Lives = std::array<double, 3>;

class Table {
 public:
  Table() {
    add_worst_wire();
    add_lives("life_hours_{}",
              "by then {} of such dresspacks have failed: `replace after`, `half failed`, `90 % failed` of the table",
              &RankingRow::planned_hours);
    add_lives(
        "conductor_life_hours_{}",
        "by then {} have a conductor that has lost its share of wires at one place, by the scatter of wires alone",
        &RankingRow::conductor_hours);
    add_hose_and_causes();
    add_lives("first_wire_life_hours_{}", "by then {} have a broken wire, by the scatter of wires alone",
              &RankingRow::first_wire_hours);
    add_failure_and_rating();
    add_lives("scatter_life_hours_{}", "life_hours_p10 with the scatter of wires only: all inputs are exact",
              &RankingRow::scatter_hours);
    add_uncertainty();
    add_warnings();
    add_rank();
    add_lives("life_hours_{}_all_glued", "life_hours_p10 if everything inside the cables were glued",
              &RankingRow::glued_hours);
    add_lives("life_hours_{}_all_free", "life_hours_p10 if everything inside the cables slipped without friction",
              &RankingRow::free_hours);
    add_test();
    add_abrasion();
    add_rating();
    add_inspection();
    add_jacket();
    for (std::size_t i = 0; i < ends.size(); ++i)
      add(where(
          fmt::format("life_error_{}", ends[i]), "1",
          i == 0 ? "standard error of life_hours_p10 as a factor, of samples and interpolation"
                 : fmt::format("the same of life_hours_{}", ends[i]),
          [i](const RankingRow& row) { return std::isfinite(row.planned_errors[i]); },
          [i](const RankingRow& row) { return row.planned_errors[i]; }));
    add_corkscrew_and_ends();
    add_kink();
    for (const auto& [end, share, i] : {std::tuple{"p10", "10", 0u}, std::tuple{"p90", "90", 2u}})
      add(of_mode(fmt::format("hose_life_hours_{}", end), "h",
                  fmt::format("hose_life_hours until {} % have cracked", share), UnvalidatedMode::wall,
                  [i = i](const UnvalidatedMode& mode) {
                    return is_credible(mode) ? mode.hours[i] : UnvalidatedMode::unknown;
                  }));
    add(of("moving_places", "1",
           "other computed places of loose cables at which they do not end the repeat where they began it",
           &RankingRow::moving_places));
    add_kind(WarningKind::other_values);
    add_kind(WarningKind::side);
    add(where("life_repeats_p10", "1", "repeats of the motion in life_hours_p10: compares jobs that do the same work",
              &RankingRow::planned, &RankingRow::headline_repeats));
  }
  std::vector<RankingColumn> columns;

 private:
  void add(RankingColumn column) { columns.push_back(std::move(column)); }

  static constexpr std::array<const char*, 3> ends{"p10", "p50", "p90"}, shares{"10 %", "50 %", "90 %"};
  /// Returns the whole meaning for the first column, with 10 % in place of {}; for the others a short one.
  static std::string meaning_of(const char* meaning, std::size_t i) {
    return i == 0 ? fmt::format(fmt::runtime(meaning), shares[i]) : fmt::format("the same for {}", shares[i]);
  }

  template <class Of>
  void add_lives(const char* name, const char* meaning, Of lives) {
    for (std::size_t i = 0; i < ends.size(); ++i)
      add(where(fmt::format(fmt::runtime(name), ends[i]), "h", meaning_of(meaning, i), always,
                [lives, i](const RankingRow& row) { return std::invoke(lives, row)[i]; }));
  }
  void add_mode_lives(const char* name, const char* meaning, const char* mode) {
    for (std::size_t i = 0; i < ends.size(); ++i)
      add(of_mode(fmt::format(fmt::runtime(name), ends[i]), "h", meaning_of(meaning, i), mode,
                  [i](const UnvalidatedMode& of) { return of.hours[i]; }));
  }

  void add_position(const std::string& name, const char* mode) {
    add(of_mode(name + "_position_from_tool_m", "m", "its place from the tool clamp", mode,
                &UnvalidatedMode::position_from_tool));
  }
  /// Adds the columns of a mode in which something wears through. name: beginning of their names. words: the mode in a sentence.
  /// preposition, place: end of the name and meaning of the column that names the place.
  void add_wear(const std::string& name, const char* mode, const char* lives, const std::string& words,
                const std::string& preposition, const char* place) {
    add_mode_lives((name + "_life_hours_{}").c_str(), lives, mode);
    add(of_mode(name + "_first_share", "1", "share of the samples in which " + words + " comes before the wires", mode,
                &UnvalidatedMode::first_share));
    add(of_mode(name + "_together_hours_p10", "h", "life_hours_p10 if " + words + " counted", mode,
                &UnvalidatedMode::together_p10));
    add(of_mode(name + "_" + preposition, "text", place, mode, &UnvalidatedMode::place));
    add_position(name, mode);
  }

  void add_abrasion() {
    add_wear("abrasion", UnvalidatedMode::abrasion,
             "by then {} of such dresspacks are worn through by abrasion; not validated", "abrasion", "on",
             "what rubs: a link, ring, floor, dresspack or cell");
    add(of("not_evaluated", "text", "parts of the dresspack and failure modes without a life",
           &RankingRow::not_evaluated));
  }

  void add_rating() {
    constexpr const char* rating = UnvalidatedMode::rating;
    add_mode_lives(
        "rating_hours_{}",
        "in {} the maker's rating of a hose or a cable without described wires covers less, a lower bound of its life; not validated",
        rating);
    add(of_mode("rating_first_share", "1", "share of the samples in which the wires of other cables outlive the rating",
                rating, &UnvalidatedMode::first_share));
    add(of_mode("rating_of", "text", "that cable", rating, &UnvalidatedMode::place));
  }

  void add_inspection() {
    constexpr const char* abrasion = UnvalidatedMode::abrasion;
    add(of_mode(
        "abrasion_found_share", "1",
        "share of the dresspacks worn through before their replacement that a visual check finds in time; not validated",
        abrasion, &UnvalidatedMode::found_share));
    add(of_mode("abrasion_unseen_share", "1",
                "share of all dresspacks that wear through before their replacement, unseen by checks", abrasion,
                &UnvalidatedMode::unseen_share));
  }

  void add_corkscrew_and_ends() {
    constexpr const char* corkscrew = UnvalidatedMode::corkscrew;
    add(of_mode("corkscrew_life_hours_p10", "h",
                "by then a cable has wound into a corkscrew in 10 % of such dresspacks; inf: none does; not validated",
                corkscrew, [](const UnvalidatedMode& mode) { return mode.hours[0]; }));
    add(of_mode("corkscrew_of", "text", "the cable that is nearest to it", corkscrew, &UnvalidatedMode::place));
    add_position("corkscrew", corkscrew);
    add(of("strain_relief_share", "1",
           "largest pull of a cable at a clamp over what EN 50262 asks a strain relief of type A to hold",
           &RankingRow::strain_relief_share));
  }

  void add_kink() {
    constexpr const char* kink = UnvalidatedMode::kink;
    add(of_mode("kink_margin", "1",
                "radius of the tightest bend over that at which a tube in the dresspack kinks; below 1 it kinks", kink,
                &UnvalidatedMode::margin));
    add(of_mode("kink_share", "1", "share of such tubes that kink", kink, &UnvalidatedMode::first_share));
    add(of_mode("kink_of", "text", "the tube that is nearest to its kink", kink, &UnvalidatedMode::place));
    add_position("kink", kink);
  }

  void add_jacket() {
    add_wear("jacket", UnvalidatedMode::jacket,
             "by then a cable's jacket has worn through inside the hose in {} of such dresspacks; not validated",
             "jacket wear", "of", "that cable");
  }

  void add_worst_wire() {
    add(of("job", "text", "name of the job in its study", &RankingRow::job));
    add(of("life_repeats", "1", "repeats of the motion until the worst wire breaks, in the median",
           &RankingRow::life_repeats));
    add(of("life_hours", "h", "the same in hours of motion", &RankingRow::life_hours));
    add(where("worst_segment_from_tool", "1", "segment of the worst wire's place, 1 is nearest to the tool", evaluated,
              &RankingRow::worst_segment_from_tool));
    add(of("worst_component", "text", "path of the worst wire, outermost part first", &RankingRow::worst_component));
    add(of("damage_per_repeat", "1", "of the worst wire", &RankingRow::damage_per_repeat));
    add(of("life_months", "months", "life_hours at the job's operating hours per week", &RankingRow::life_months));
    add(of("life_repeats_all_stick", "1",
           "life_repeats if nothing in the cables slipped and compression lengthened no life (F38)",
           &RankingRow::life_repeats_all_stick));
    add(of("life_repeats_all_free", "1", "life_repeats if everything in the cables slipped without friction",
           &RankingRow::life_repeats_all_free));
    add(where("worst_position_from_tool_m", "m", "the worst wire's place along the dresspack, from the tool clamp",
              evaluated, &RankingRow::worst_position_from_tool));
    add(where("worst_time_s", "s", "when the most damaging cycle of the worst wire closes", evaluated,
              &RankingRow::worst_time));
    add(of("worst_step", "text", "program line that runs then", &RankingRow::worst_step));
    add(where(
        "status", "text",
        "done; stale: the cells are of the job's last result; failed or to do: only job, message and settings are given",
        always, [](const RankingRow& row) { return std::string(row.stale ? "stale" : "done"); }));
    add(where("message", "text", "why it failed, or what changed since the last result", always,
              [](const RankingRow& row) { return row.stale ? stale_words(row) : std::string(); }));
  }

  void add_hose_and_causes() {
    constexpr const char* wall = UnvalidatedMode::wall;
    add(of_mode(
        "hose_life_hours", "h",
        "hours of motion until the hose's wall cracks; not validated. Empty: the law contradicts a published test",
        wall,
        [](const UnvalidatedMode& mode) { return is_credible(mode) ? mode.hours[1] : UnvalidatedMode::unknown; }));
    add(of_mode("hose_segment_from_tool", "1", "segment of the wall's worst place, 1 is nearest to the tool", wall,
                &UnvalidatedMode::segment_from_tool));
    add(of_mode("hose_position_from_tool_m", "m", "the same along the dresspack, from the tool clamp", wall,
                &UnvalidatedMode::position_from_tool));
    add(of("worst_joint", "text",
           "joint whose motion damages the worst wire most; carrying: motion of the dresspack as a whole",
           &RankingRow::worst_joint));
    add(where(
        "worst_joint_share", "1", "its share of the damage; above 1 if other joints reduce it",
        [](const RankingRow& row) { return !row.worst_joint.empty(); }, &RankingRow::worst_joint_share));
    add(of("worst_dresspack", "text", "dresspack of the worst wire, among several", &RankingRow::worst_dresspack));
    add(of("settings", "text", "digest of the settings that the row belongs to", &RankingRow::settings));
    add(of("largest_force_share", "1", "largest force of a cable over the force that tears it",
           &RankingRow::largest_force_share));
    add(of("clamp_moment_share", "1",
           "moment of all cables on the hose at a clamp over the largest that the hose carries",
           &RankingRow::clamp_moment_share));
    add(where(
        "force_ok", "yes or no", "whether both shares are realistic",
        [](const RankingRow& row) { return row.clamp_moment_share.has_value(); },
        [](const RankingRow& row) { return std::string(row.force_ok() ? "yes" : "no"); }));
    add(of("life_hours_mean_stress_kept", "h", "life_hours if the mean stress never relaxed",
           &RankingRow::hours_mean_stress_kept));
    add(of("life_hours_without_mean_stress", "h", "life_hours without any mean stress",
           &RankingRow::hours_without_mean_stress));
    add(where("life_months_p10", "months", "life_hours_p10 at the job's operating hours per week", &RankingRow::planned,
              &RankingRow::planned_months));
    add(where("life_hours_all_stick", "h", "life_repeats_all_stick in hours of motion", always,
              [](const RankingRow& row) { return row.hours_of(row.life_repeats_all_stick); }));
    add(where("life_hours_all_free", "h", "life_repeats_all_free in hours of motion", always,
              [](const RankingRow& row) { return row.hours_of(row.life_repeats_all_free); }));
  }

  void add_failure_and_rating() {
    add(of("failing_conductor", "text", "conductor that is most likely to fail first", &RankingRow::failing_conductor));
    add(where(
        "failing_position_from_tool_m", "m", "its place along the dresspack, from the tool clamp",
        [](const RankingRow& row) { return !row.failing_conductor.empty(); }, &RankingRow::failing_position_from_tool));
    add(where("rated_cycles_per_hour", "1/h", "cycles of the maker's rig that do the damage of one hour of the program",
              has_rating, [](const RankingRow& row) { return row.relative->cycles_per_hour; }));
    add(where("relative_life_hours", "h", "hours until the damage of the rated cycles is reached", has_rating,
              [](const RankingRow& row) { return row.relative->hours(); }));
    add(where("rated_cable", "text", "cable with that rating", has_rating,
              [](const RankingRow& row) { return row.relative->cable; }));
  }

  void add_uncertainty() {
    add(of("outlives_next", "1", "share of samples in which the job lives longer than that of the next row",
           &RankingRow::outlives_next));
    add(of("life_shares", "text", "shares of the uncertainty of life by cause", &RankingRow::life_shares));
    add(of("measure_next", "text", "uncertain parameter with the largest share", &RankingRow::measure_next));
    add(where(
        "measure_next_share", "1", "its share", [](const RankingRow& row) { return !row.measure_next.empty(); },
        &RankingRow::measure_next_share));
  }

  void add_warnings() {
    const auto known = [](const RankingRow& row) { return row.warnings.has_value(); };
    add(where("warnings", "1", "how many warnings the job has", known,
              [](const RankingRow& row) { return static_cast<int>(row.warnings->size()); }));
    add(where("warning_words", "text", "all warnings", known,
              [](const RankingRow& row) { return joined(mapped(*row.warnings, &Warning::text), "; "); }));
    for (int k = 0; k < warning_kinds_count; ++k) {
      const auto kind = static_cast<WarningKind>(k);
      if (kind == WarningKind::force) continue;                                      // the column force_ok contains it
      if (kind == WarningKind::other_values || kind == WarningKind::side) continue;  // among the last columns
      add_kind(kind);
    }
  }

  void add_kind(WarningKind kind) {
    add(where(
        fmt::format("{}_ok", word(kind)), "yes or no", fmt::format("no: a warning of kind {}", title(kind)),
        [](const RankingRow& row) { return row.warnings.has_value(); },
        [kind](const RankingRow& row) { return std::string(has_warning(row, kind) ? "no" : "yes"); }));
  }

  void add_rank() {
    add(of("loose_mesh_error", "1", "share of the curvature of loose cables that their mesh misses",
           &RankingRow::loose_mesh_error));
    add(of("estimates", "text", "keys that the dresspacks leave out, with their estimated values",
           &RankingRow::estimates));
    add(where(
        "rank", "1", "1 is best; jobs that cannot be separated share one",
        [](const RankingRow& row) { return row.rank > 0; },
        [](const RankingRow& row) { return static_cast<int>(row.rank); }));
    add(of("failing_mode", "text", "what fails first in most of the samples that fail", &RankingRow::failing_mode));
    add(where(
        "failing_mode_share", "1", "in which share of them",
        [](const RankingRow& row) { return !row.failing_mode.empty(); }, &RankingRow::failing_mode_share));
  }

  void add_test() {
    add(of("best_test", "text", "uncertain parameter whose test narrows the life most", &RankingRow::best_test));
    add(of("best_test_life_hours_p10", "h", "life_hours_p10 after that test, if it confirms today's estimate",
           &RankingRow::tested_p10));
    add(of("best_test_life_hours_p90", "h", "life_hours_p90 after it", &RankingRow::tested_p90));
  }
};

}  // namespace

std::string RankingColumn::text(const RankingRow& row) const {
  if (row.has_result()) return cell(row);
  return name == "job"        ? row.job
         : name == "status"   ? (row.waits() ? row.failure : "failed")
         : name == "message"  ? row.failure
         : name == "settings" ? row.settings
                              : "";
}

const std::vector<RankingColumn>& ranking_columns() {
  static const std::vector<RankingColumn> columns = Table().columns;
  return columns;
}

std::string ranking_manual() {
  std::string text = "| column | unit | meaning |\n|---|---|---|\n";
  for (const RankingColumn& column : ranking_columns())
    text += fmt::format("| `{}` | {} | {} |\n", column.name, column.unit, column.meaning);
  return text;
}

}  // namespace dresslife::pipeline
