#include "pipeline/study/ranking.h"
#include "pipeline/study/mode_table.h"
#include "pipeline/study/ranking_columns.h"
#include "pipeline/study/row_warnings.h"
#include "pipeline/study/row_words.h"

#include <algorithm>
#include <cmath>
#include <regex>
#include <sstream>

#include "pipeline/base/constants.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/readable.h"
#include "pipeline/life/first_failure.h"
#include "tests/catch.h"
#include "tests/pipeline/sample_life.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::pipeline {
namespace {

JobResult job_with(const Scratch& scratch, const std::string& name, const SampleLife& life) {
  write_sample_life(scratch / (name + ".h5"), life);
  return {name, scratch / (name + ".h5"), ""};
}

SampleLife living(double repeats) {
  SampleLife life;
  life.repeats = repeats;
  life.samples = 200;
  return life;
}

std::vector<std::string> names(const std::vector<RankingRow>& rows) {
  std::vector<std::string> list;
  for (const RankingRow& row : rows) list.push_back(row.job);
  return list;
}

TEST_CASE("ranking: best life first, equal lives by name, failed jobs last") {
  const Scratch scratch;
  const auto rows = read_ranking({job_with(scratch, "short", living(10)),
                                  {"broken", "", "why"},
                                  job_with(scratch, "endless", living(infinity)),
                                  job_with(scratch, "twin b", living(500)),
                                  {"aborted", "", "why"},
                                  job_with(scratch, "twin a", living(500))});
  CHECK(names(rows) == std::vector<std::string>{"endless", "twin a", "twin b", "short", "aborted", "broken"});
  CHECK(mapped(rows, &RankingRow::rank) == std::vector<std::size_t>{1, 2, 2, 4, 0, 0});
}

TEST_CASE("ranking: a row of a study says how its job stands and which values it has") {
  const Scratch scratch;
  Study study;
  study.varied = {"length", "slip"};
  study.jobs = {{"done", nullptr, "", {"2", "free"}},
                {"invalid", nullptr, "no robot"},
                {"failed", nullptr, "", {"3", "stick"}},
                {"old", nullptr, "", {"4", "free"}},
                {"new", nullptr, "", {"5", "free"}}};
  std::filesystem::create_directories(scratch / "done");
  std::filesystem::create_directories(scratch / "old");
  write_sample_life(scratch / "done" / "life.h5", living(10));
  write_sample_life(scratch / "old" / "life.h5", living(20));
  std::vector<JobState> states(5);
  states[0].next = stage_count;
  states[2].failure = "it burst";
  states[3].has_last = true, states[3].changed = "length 1 -> 4";
  StudyPlaces places;
  places.folder = scratch / "";
  const std::vector<RankingRow> rows = ranking_of(study, places, states);
  REQUIRE(rows.size() == 5);
  CHECK(names(rows) == std::vector<std::string>{"done", "old", "failed", "invalid", "new"});
  CHECK(rows[0].failure.empty());
  CHECK(rows[1].failure == "stale");
  CHECK(rows[1].stale);
  CHECK(rows[1].waits());
  CHECK_THAT(stale_words(rows[1]), Catch::Contains("stale: since this result length 1 -> 4"));
  CHECK(rows[2].failure == "it burst");
  CHECK_FALSE(rows[2].waits());
  CHECK(rows[3].failure == "no robot");
  CHECK(rows[4].failure == "to do");
  using Varied = std::vector<std::pair<std::string, std::string>>;
  CHECK(rows[0].varied == Varied{{"length", "2"}, {"slip", "free"}});
  CHECK(rows[2].varied == Varied{{"length", "3"}, {"slip", "stick"}});
  CHECK(rows[3].varied.empty());
}

TEST_CASE("ranking: of several unvalidated modes of one name the first to fail counts") {
  RankingRow row;
  const auto add = [&](const char* mode, double median) {
    UnvalidatedMode& one = row.unvalidated.emplace_back();
    one.mode = mode, one.hours = {1, median, 9};
  };
  add("abrasion", 5), add("wall", 1), add("abrasion", 3), add("abrasion", 4);
  CHECK(row.unvalidated_mode("abrasion") == &row.unvalidated[2]);
  CHECK(row.unvalidated_mode("wall") == &row.unvalidated[1]);
  CHECK(row.unvalidated_mode("kinks") == nullptr);
  // Half never kink: the hours until 10 % have, then the share of the samples.
  for (const auto& [early, share] :
       {std::pair(infinity, 0.01), {infinity, 0.08}, {400.0, 0.2}, {300.0, 0.2}, {500.0, 0.3}}) {
    UnvalidatedMode& kink = row.unvalidated.emplace_back();
    kink.mode = UnvalidatedMode::kink, kink.hours = {early, infinity, infinity}, kink.first_share = share;
  }
  CHECK(row.unvalidated_mode(UnvalidatedMode::kink) == &row.unvalidated[7]);
  row.unvalidated.resize(6);
  CHECK(row.unvalidated_mode(UnvalidatedMode::kink) == &row.unvalidated[5]);
  CHECK(force_words(row).empty());
  for (const double share : {0.19, 0.21, 3.0})
    for (const bool pull : {true, false}) {
      RankingRow forced;
      (pull ? forced.largest_force_share : forced.clamp_moment_share) = share;
      CHECK(forced.force_ok() == (share < 0.2));
      CHECK(force_words(forced).empty() == (share < 0.2));
      if (share > 0.2) CHECK((force_words(forced).find("cables carry ") == 0) == pull);
    }
}

TEST_CASE("ranking: a row holds what the life file says") {
  const Scratch scratch;
  const RankingRow row = read_ranking({job_with(scratch, "one", living(12000))})[0];
  CHECK(row.done());
  CHECK(row.life_repeats == 12000);
  CHECK(row.repeat_seconds == 199 / 25.0);
  CHECK(row.life_hours == Approx(12000 * row.repeat_seconds / 3600).epsilon(1e-15));
  CHECK(row.life_repeats_all_stick == 30);
  CHECK(row.life_repeats_all_free == 18000);
  CHECK(row.damage_per_repeat == 1.0 / 12000);
  CHECK(row.worst_segment_from_tool == 3);
  CHECK(row.worst_position_from_tool == Approx(2.5 * 2.4 / 50));
  CHECK(row.worst_component == "signal cable 3/conductor 2/layer 1/wire 17");
  CHECK_FALSE(row.worst_step.empty());
}

TEST_CASE("ranking: a missing or damaged life file is a failed job with its reason") {
  const Scratch scratch;
  const auto rows = read_ranking({{"lost", scratch / "lost.h5", ""}, {"cut", scratch.write("cut.h5", "no file"), ""}});
  CHECK(rows[0].failure ==
        (scratch / "cut.h5").string() +
            ": error: is not an HDF5 file, or is cut off; make the file again with dresslife-fatigue, then run again");
  CHECK(rows[1].failure ==
        (scratch / "lost.h5").string() + ": error: is not there; check the path, or make it with dresslife-fatigue");
  CHECK(read_ranking({}).empty());
}

TEST_CASE("ranking: a dresspack without wires has no life and no rank, and comes after those with one") {
  const Scratch scratch;
  SampleLife life = living(10);
  life.wires = false;
  const JobResult hose = job_with(scratch, "empty hose", life);
  const auto rows = read_ranking({hose});
  CHECK(rows[0].done());
  CHECK(std::isnan(rows[0].headline_hours()));
  CHECK(rows[0].worst_segment_from_tool == 0);
  CHECK(ranking_csv(rows).find("\nempty hose,,,,,0,,,,,,,done,,") != std::string::npos);
  CHECK(ranking_table(rows).starts_with("No part was evaluated."));
  CHECK_THAT(ranking_table(rows), Catch::Contains("no wires"));
  const auto both = read_ranking({hose, job_with(scratch, "short", living(10))});
  CHECK(both[0].job == "short");
  CHECK(both[0].rank == 1);
  CHECK(both[1].rank == 0);
}

/// Reads CSV by RFC 4180: an independent reader for the round trip.
std::vector<std::vector<std::string>> read_csv(const std::string& text) {
  std::vector<std::vector<std::string>> table{{""}};
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::string& cell = table.back().back();
    if (quoted && text[i] == '"' && i + 1 < text.size() && text[i + 1] == '"') {
      cell += '"';
      ++i;
    } else if (text[i] == '"') {
      quoted = !quoted;
    } else if (!quoted && text[i] == ',') {
      table.back().emplace_back();
    } else if (!quoted && text[i] == '\n') {
      table.push_back({""});
    } else {
      cell += text[i];
    }
  }
  table.pop_back();
  return table;
}

TEST_CASE("ranking: the CSV has the contract's columns first and reads back exactly") {
  const Scratch scratch;
  SampleLife awkward = living(1.0 / 3);
  awkward.worst_component = "cable \"A\", red 1/wire 2";
  awkward.line_name = "weld, \"spot\"";
  const auto rows = read_ranking({job_with(scratch, "a,b", awkward), {"bad\njob", "", "line 1\nline \"2\""}});
  const auto table = read_csv(ranking_csv(rows));
  REQUIRE(table.size() == 3);
  CHECK(ranking_csv(rows).starts_with(
      "job,life_repeats,life_hours,worst_segment_from_tool,worst_component,damage_per_repeat,"));
  for (const auto& line : table) CHECK(line.size() == table[0].size());
  CHECK(table[1][0] == "a,b");
  CHECK(std::stod(table[1][1]) == rows[0].life_repeats);
  CHECK(std::stod(table[1][2]) == rows[0].life_hours);
  CHECK(table[1][3] == "3");
  CHECK(table[1][4] == "cable \"A\", red 1/wire 2");
  CHECK(std::stod(table[1][5]) == rows[0].damage_per_repeat);
  CHECK(table[1][11] == rows[0].worst_step);
  CHECK(table[1][12] == "done");
  CHECK(table[2][0] == "bad\njob");
  CHECK(table[2][1].empty());
  CHECK(table[2][12] == "failed");
  CHECK(table[2][13] == "line 1\nline \"2\"");
  CHECK(table[0][20] == "hose_life_hours");
  CHECK(table[1][20].empty());
  CHECK(ranking_csv({}) == ranking_csv(rows).substr(0, ranking_csv(rows).find('\n') + 1));
}

TEST_CASE("ranking: every column is described, and no column was renamed, moved or taken away") {
  // Column order for other programs that read the table: new columns come last.
  const std::string known =
      "job,life_repeats,life_hours,worst_segment_from_tool,worst_component,damage_per_repeat,"
      "life_months,life_repeats_all_stick,life_repeats_all_free,worst_position_from_tool_m,"
      "worst_time_s,worst_step,status,message,life_hours_p10,life_hours_p50,life_hours_p90,"
      "conductor_life_hours_p10,conductor_life_hours_p50,conductor_life_hours_p90,hose_life_hours,"
      "hose_segment_from_tool,hose_position_from_tool_m,worst_joint,worst_joint_share,worst_dresspack,"
      "settings,largest_force_share,clamp_moment_share,force_ok,life_hours_mean_stress_kept,"
      "life_hours_without_mean_stress,life_months_p10,life_hours_all_stick,life_hours_all_free,"
      "first_wire_life_hours_p10,first_wire_life_hours_p50,first_wire_life_hours_p90,"
      "failing_conductor,failing_position_from_tool_m,rated_cycles_per_hour,relative_life_hours,"
      "rated_cable,scatter_life_hours_p10,scatter_life_hours_p50,scatter_life_hours_p90,outlives_next,"
      "life_shares,measure_next,measure_next_share,warnings,warning_words,program_ok,bend_radius_ok,"
      "twist_ok,tension_ok,slack_ok,periodic_ok,overlap_ok,mesh_ok,material_ok,strain_ok,"
      "calibration_ok,motion_ok,loose_mesh_error,estimates,rank,failing_mode,failing_mode_share,"
      "life_hours_p10_all_glued,life_hours_p50_all_glued,life_hours_p90_all_glued,"
      "life_hours_p10_all_free,life_hours_p50_all_free,life_hours_p90_all_free,best_test,"
      "best_test_life_hours_p10,best_test_life_hours_p90";
  const std::string header = ranking_csv({});
  CHECK(header.starts_with(known));
  std::string names;
  const std::string page = ranking_manual();
  std::size_t at = 0;
  for (const RankingColumn& column : ranking_columns()) {
    CAPTURE(column.name);
    names += (names.empty() ? "" : ",") + column.name;
    CHECK(!column.meaning.empty());
    const std::size_t line = page.find("\n| `" + column.name + "` | " + column.unit + " | ", at);
    CHECK(line != std::string::npos);
    at = line == std::string::npos ? at : line;
  }
  CHECK(header == names + "\n");
}

TEST_CASE("ranking: last results of stale jobs stand behind those of now, marked, before jobs without any") {
  const Scratch scratch;
  const auto stale = [&](const std::string& name, double repeats, const std::string& standing) {
    JobResult result = job_with(scratch, name, living(repeats));
    result.failure = standing;
    result.stale = true;
    result.changed = "routing.free_length_m 2 -> 2.1";
    return result;
  };
  const auto rows = read_ranking({stale("old", 900, "stale"),
                                  {"aborted", "", "why"},
                                  job_with(scratch, "now", living(10)),
                                  stale("older", 1000, "too short")});
  CHECK(names(rows) == std::vector<std::string>{"now", "older", "old", "aborted"});
  CHECK_FALSE(rows[1].done());
  CHECK(rows[1].life_repeats == 1000);
  const auto table = read_csv(ranking_csv(rows));
  for (const auto& cells : table) CHECK(cells.size() == table[0].size());
  CHECK(table[1][12] == "done");
  CHECK(table[2][12] == "stale");
  CHECK(table[2][13] ==
        "stale: with the present settings it failed: too short; since this result routing.free_length_m 2 -> 2.1");
  CHECK(table[3][1] == "900");
  CHECK(table[3][13] == "stale: since this result routing.free_length_m 2 -> 2.1");
  CHECK(table[4][12] == "failed");
}

TEST_CASE("ranking: no text of the CSV is a formula or acts on a terminal, and a job that waits has not failed") {
  const Scratch scratch;
  SampleLife awkward = living(12000);
  awkward.worst_component = "=HYPERLINK(\"x\")";
  const auto table = read_csv(ranking_csv(read_ranking({job_with(scratch, "a", awkward),
                                                        {"@b", "", "+1\x1b[31m"},
                                                        {"c", "", "stale", "0123456789ab"},
                                                        {"d", "", "to do"}})));
  CHECK(table[1][4] == "'=HYPERLINK(\"x\")");
  CHECK(table[2][0] == "'@b");
  CHECK(table[2][13] == "'+1\\x1b[31m");
  CHECK(table[3][12] == "stale");
  CHECK(table[4][12] == "to do");
  const auto settings =
      static_cast<std::size_t>(std::find(table[0].begin(), table[0].end(), "settings") - table[0].begin());
  REQUIRE(settings < table[0].size());
  for (const auto& cells : table) CHECK(cells.size() == table[0].size());
  CHECK(table[1][settings].empty());
  CHECK(table[3][settings] == "0123456789ab");
}

TEST_CASE("ranking: the hose's wall has columns and a line of its own and does not rank its job") {
  const Scratch scratch;
  SampleLife with_hose = living(12000);
  with_hose.hose_hours = 2.5;
  SampleLife sound = living(11000);
  sound.hose_hours = infinity;
  const auto rows = read_ranking({job_with(scratch, "short hose", with_hose), job_with(scratch, "sound", sound),
                                  job_with(scratch, "unknown", living(10000))});
  CHECK(names(rows) == std::vector<std::string>{"short hose", "sound", "unknown"});
  REQUIRE(rows[0].unvalidated_mode(UnvalidatedMode::wall));
  CHECK(rows[2].unvalidated.empty());
  const auto table = read_csv(ranking_csv(rows));
  CHECK(table[1][20] == "2.5");
  CHECK(table[1][21] == "2");
  CHECK(std::stod(table[1][22]) == rows[0].unvalidated[0].position_from_tool);
  CHECK(table[2][20] == "inf");
  const std::string text = ranking_table(rows);
  CHECK_THAT(text, Catch::Contains("hose's wall†") && Catch::Contains(" 2.50 ") && Catch::Contains(" no damage "));
}

/// Returns the line of a mode in a job of undamaged wires on a robot with a life of 40,000 h.
ModeLine line_of(const UnvalidatedMode& mode) {
  RankingRow row;
  row.robot_life_hours = 40000;
  row.planned_hours.fill(1e5);
  row.unvalidated = {mode};
  return mode_lines(row).back();
}

TEST_CASE("ranking: a wall's life by a law that contradicts the published test is not stated") {
  UnvalidatedMode wall;
  wall.mode = UnvalidatedMode::wall;
  wall.hours[1] = 0.37;
  const auto line = [&](double bends, double hours) {
    wall.bends_at_limit = bends, wall.hours[1] = hours;
    return line_of(unvalidated_from(unvalidated_text({wall}))[0]);
  };
  CHECK(line(1.08e6, 0.37).hours == std::array<std::string, 3>{"-", "-", "-"});
  CHECK(!line(1.08e6, 0.37).early);
  CHECK_THAT(
      line(1.08e6, 0.37).note,
      Catch::StartsWith(
          "Not predicted: the only known law gives 1,080,000 bends from straight to the limit of the bend radius, and a "
          "published hose endured 16,000,000 without damage. Keep the maker's bend radius."));
  for (const auto& [bends, hours, shown] : {std::tuple{17e6, 0.37, "0.370"},  // the law agrees with the test
                                            {0.0, 0.37, "0.370"},             // unknown, as in older files
                                            {1.08e6, 2e5, "over 40,000"}}) {
    CHECK(line(bends, hours).hours == std::array<std::string, 3>{"-", shown, "-"});
    CHECK(line(bends, hours).note.empty());
  }
  wall.bends_at_limit = 1.08e6, wall.hours = {3e5, 2e6, 8e7};
  CHECK(line_of(wall).hours[0] == "over 40,000");
  wall.hours[0] = 4e4;  // in 1 of 10 cases before the end of any robot
  CHECK(line_of(wall).hours[0] == "-");
}

TEST_CASE("ranking: abrasion has words and columns, and the first action names it where it may come first") {
  const Scratch scratch;
  UnvalidatedMode worn;
  worn.mode = UnvalidatedMode::abrasion;
  worn.hours = {300, 2400, 51000};
  worn.first_share = 0.43, worn.together_p10 = 280;
  worn.segment_from_tool = 4, worn.position_from_tool = 0.13;
  worn.place = "link_4", worn.time = 2.5, worn.step = "weld\tspot";
  worn.found_share = 0.97, worn.unseen_share = 0.02, worn.visible_from = 0.35, worn.note = "A check finds it.";
  UnvalidatedMode untouched = worn;
  untouched.hours = {infinity, infinity, infinity}, untouched.place = "", untouched.first_share = 0;
  CHECK(unvalidated_from(unvalidated_text({worn, untouched}))[0].step == "weld spot");
  CHECK(unvalidated_from(unvalidated_text({worn, untouched}))[1] == [&] {
    UnvalidatedMode same = untouched;
    same.step = "weld spot";
    return same;
  }());
  CHECK_THROWS_AS(unvalidated_from("abrasion\t1"), std::invalid_argument);
  SampleLife rubs = living(12000), free = living(11000);
  rubs.planned_hours = 1e5, rubs.robot_life_hours = 40000;
  free.planned_hours = 9e4, free.robot_life_hours = 40000;
  rubs.unvalidated = unvalidated_text({worn}), free.unvalidated = unvalidated_text({untouched});
  SampleLife broken = living(9000);
  broken.unvalidated = "abrasion\tx\n";
  const auto rows = read_ranking(
      {job_with(scratch, "rubs", rubs), job_with(scratch, "free", free), job_with(scratch, "broken", broken)});
  CHECK(rows[2].failure.find("attribute 'unvalidated_modes' is no list of modes") != std::string::npos);
  CHECK(
      action_words(rows[0]) ==
      "The hose may wear through on link_4, 0.13 m from the tool, after 300 .. 51,000 h (10 .. 90 %, not validated): inspect it there from 300 h on. "
      "The wires last longer than the robot (40,000 h). Not evaluated: water hose, kinks.");
  const std::string both = ranking_table(rows, 200);
  CHECK_THAT(
      both,
      Catch::Contains("*over 40,000") &&
          Catch::Contains(
              "* Plan with this number, and inspect for modes that are not validated. rubs, abrasion: from 300 h."));
  CHECK(both.find("*over 40,000") == both.rfind("*over 40,000"));  // only the row with rubbing
  CHECK(action_words(rows[1]) ==
        "The evaluated parts last longer than the robot (40,000 h). Not evaluated: water hose, kinks.");
  const std::vector<ModeLine> lines = mode_lines(rows[0]);
  REQUIRE(lines.size() == 2);
  CHECK(lines[0].hours[0] == "over 40,000");
  CHECK(lines[1].mode == "abrasion† on link_4");
  CHECK(lines[1].hours == std::array<std::string, 3>{"300", "2,400", "over 40,000"});
  CHECK(lines[1].before_wires == "43 %");
  CHECK(lines[1].with_it == "280");
  CHECK(lines[1].from_tool + " " + lines[1].time + " " + lines[1].step == "0.13 2.5 weld spot");
  CHECK_THAT(ranking_table({rows[0]}),
             Catch::Contains("abrasion: A check finds it.") && !Catch::Contains("Plan with this number"));
  CHECK(mode_lines(rows[1])[1].mode == "abrasion†: nothing rubs");
  // A dresspack that is replaced before is not inspected.
  RankingRow weak = rows[0];
  weak.planned_hours[0] = 299;
  CHECK_THAT(ranking_table({weak}), !Catch::Contains("A check finds it."));
  CHECK(plan_mark(weak).empty());
  const auto table = read_csv(ranking_csv(rows));
  const auto column = [&](const std::string& name) {
    return static_cast<std::size_t>(std::find(table[0].begin(), table[0].end(), name) - table[0].begin());
  };
  CHECK(table[1].at(column("abrasion_life_hours_p50")) == "2400");
  CHECK(table[1].at(column("abrasion_first_share")) == "0.43");
  CHECK(table[1].at(column("abrasion_on")) == "link_4");
  CHECK(table[1].at(column("abrasion_found_share")) == "0.97");
  CHECK(table[1].at(column("abrasion_unseen_share")) == "0.02");
  CHECK(table[2].at(column("abrasion_life_hours_p10")) == "inf");
  CHECK(table[1].at(column("not_evaluated")) == "water hose, kinks");
}

TEST_CASE("ranking: jacket wear has words and columns, and the first action names it where it may come first") {
  const Scratch scratch;
  UnvalidatedMode worn;
  worn.mode = UnvalidatedMode::jacket;
  worn.hours = {300, 2400, 51000};
  worn.first_share = 0.43, worn.together_p10 = 280;
  worn.position_from_tool = 0.13, worn.place = "signal cable 3", worn.time = 2.5, worn.step = "weld";
  UnvalidatedMode still = worn;
  still.hours = {infinity, infinity, infinity}, still.place = "";
  SampleLife rubs = living(12000);
  rubs.planned_hours = 1e5, rubs.robot_life_hours = 40000, rubs.unvalidated = unvalidated_text({worn});
  const auto rows = read_ranking({job_with(scratch, "rubs", rubs)});
  CHECK(
      action_words(rows[0]) ==
      "The jacket of signal cable 3 may wear through in the hose, 0.13 m from the tool, after 300 .. 51,000 h (10 .. 90 %, not "
      "validated): open the hose there from 300 h on. The wires last longer than the robot (40,000 h). Not evaluated: water hose, kinks.");
  UnvalidatedMode abraded = worn;
  abraded.mode = UnvalidatedMode::abrasion, abraded.place = "link_4", abraded.hours = {25000, 90000, 1e6};
  UnvalidatedMode late = worn;
  late.mode = UnvalidatedMode::corkscrew, late.hours = {40001, 90000, 1e6};  // after the robot's life
  SampleLife both = rubs;
  both.unvalidated = unvalidated_text({abraded, worn, late});
  const auto listed = read_ranking({job_with(scratch, "both", both)});
  CHECK_THAT(
      action_words(listed[0]),
      Catch::Contains(
          "51,000 h (10 .. 90 %, not validated): open the hose there from 300 h on. Inspect also for: abrasion: from "
          "25,000 h. The wires last longer"));
  CHECK(
      marks_note(listed) ==
      "* Plan with this number, and inspect for modes that are not validated. jacket wear: from 300 h, abrasion: from 25,000 h.");
  // A row that is not valid for planning is not marked as one.
  auto marked = read_ranking({job_with(scratch, "both", both), job_with(scratch, "bent", both)});
  marked[1].warnings = std::vector<Warning>{{WarningKind::bend_radius, "", "smallest bend radius"}};
  CHECK(plan_mark(marked[0]) == "*");
  CHECK(plan_mark(marked[1]) == "!");
  CHECK(
      marks_note(marked) ==
      fmt::format(
          "* Plan with this number, and inspect for modes that are not validated. {}, jacket wear: from 300 h, abrasion: from "
          "25,000 h. ! Do not plan with this number before its warnings are cured. {}, bend radius.",
          marked[0].job, marked[1].job));
  // A job outside the tests of its calibration is one for planning, a job whose calibration its records contradict is none.
  marked[1].warnings = std::vector<Warning>{{WarningKind::calibration, "", "the curvature is outside of the tests"}};
  CHECK(plan_mark(marked[1]) == "*");
  marked[1].warnings =
      std::vector<Warning>{{WarningKind::calibration, "", std::string("'cell': ") + records_contradict}};
  CHECK(plan_mark(marked[1]) == "!");
  marked[1].warnings = std::vector<Warning>{{WarningKind::bend_radius, "", "smallest bend radius"}};
  const std::string printed = ranking_table(marked);
  CHECK_THAT(printed, Catch::Contains("*over 40,000") && Catch::Contains("!over 40,000"));
  CHECK_THAT(unvalidated_legend(marked),
             Catch::Contains("* marks jobs in which one of them may come first: jacket wear in 1 job."));
  CHECK(line_of(worn).mode == "jacket wear† of signal cable 3");
  CHECK(line_of(worn).hours[0] == "300");
  CHECK(line_of(still).mode == "jacket wear†: nothing rubs");
  const auto table = read_csv(ranking_csv(rows));
  const auto cell = [&](const std::string& name) {
    return table[1].at(static_cast<std::size_t>(std::find(table[0].begin(), table[0].end(), name) - table[0].begin()));
  };
  CHECK(cell("jacket_life_hours_p50") == "2400");
  CHECK(cell("jacket_first_share") == "0.43");
  CHECK(cell("jacket_of") == "signal cable 3");
  CHECK(cell("abrasion_on").empty());
}

TEST_CASE("ranking: a corkscrew has words and columns, also if none occurs") {
  const Scratch scratch;
  UnvalidatedMode coil;
  coil.mode = UnvalidatedMode::corkscrew, coil.hours = {300, 600, 1200}, coil.first_share = 1, coil.together_p10 = 300;
  coil.position_from_tool = 0.4, coil.place = "signal cable 2", coil.time = 2,
  coil.note = "A repeat leaves 10 degrees of twist.";
  SampleLife life = living(12000);
  life.planned_hours = 1e5, life.robot_life_hours = 40000, life.unvalidated = unvalidated_text({coil});
  const auto rows = read_ranking({job_with(scratch, "coiled", life)});
  CHECK_THAT(action_words(rows[0]),
             Catch::Contains("Twist may wind signal cable 2 into a corkscrew in the hose, 0.40 m from the tool, "
                             "after 300 .. 1,200 h (10 .. 90 %, not validated): open the hose there."));
  CHECK(line_of(coil).mode == "corkscrew† of signal cable 2");
  CHECK(line_of(coil).hours == std::array<std::string, 3>{"300", "600", "1,200"});
  CHECK(line_of(coil).note == "A repeat leaves 10 degrees of twist.");
  coil.hours[2] = std::numeric_limits<double>::infinity();
  life.unvalidated = unvalidated_text({coil});
  CHECK_THAT(
      action_words(read_ranking({job_with(scratch, "some", life)})[0]),
      Catch::Contains(
          "0.40 m from the tool, in 1 of 10 dresspacks after 300 h, and in some never (not validated): open the hose there."));
  const auto table = read_csv(ranking_csv(rows));
  const auto column = std::find(table[0].begin(), table[0].end(), "corkscrew_life_hours_p10");
  REQUIRE(column != table[0].end());
  CHECK(table[1].at(static_cast<std::size_t>(column - table[0].begin())) == "300");
  coil.hours.fill(infinity), coil.note = "Forces and twist 10 times as large would wind it.";
  CHECK(line_of(coil).mode == "corkscrew†, nearest: signal cable 2");
  CHECK(line_of(coil).hours == std::array<std::string, 3>{"none", "none", "none"});
}

TEST_CASE("ranking: a kink has words and columns, also if none occurs") {
  const Scratch scratch;
  UnvalidatedMode kink;
  kink.mode = UnvalidatedMode::kink, kink.hours = {0.01, 0.01, infinity}, kink.first_share = 0.7,
  kink.together_p10 = 0.01;
  kink.position_from_tool = 0.4, kink.place = "air hose", kink.time = 2, kink.margin = 0.88;
  kink.note = "Its tightest bend has a radius of 25 mm. By its two diameters half of such tubes kink at 28.5 mm.";
  SampleLife life = living(12000);
  life.planned_hours = 1e5, life.robot_life_hours = 40000, life.unvalidated = unvalidated_text({kink});
  const auto rows = read_ranking({job_with(scratch, "kinked", life)});
  CHECK_THAT(action_words(rows[0]),
             Catch::Contains("air hose may kink in the hose, 0.40 m from the tool. Its tightest bend has"));
  CHECK(line_of(kink).mode == "kink† of air hose");
  CHECK(line_of(kink).hours == std::array<std::string, 3>{"0.0100", "0.0100", "none"});
  CHECK(line_of(kink).note == kink.note);
  const auto table = read_csv(ranking_csv(rows));
  const auto column = std::find(table[0].begin(), table[0].end(), "kink_margin");
  REQUIRE(column != table[0].end());
  CHECK(table[1].at(static_cast<std::size_t>(column - table[0].begin())) == "0.88");
  kink.margin = infinity, kink.note.clear();
  CHECK(line_of(kink).mode == "kink†: nothing bends");
  CHECK(line_of(kink).note.empty());
}

TEST_CASE("ranking: ratings have words and columns, and the first action names a rating that may end first") {
  const Scratch scratch;
  UnvalidatedMode rated;
  rated.mode = UnvalidatedMode::rating;
  rated.hours = {5000, 9000, 16000}, rated.first_share = 0.9, rated.together_p10 = 5000;
  rated.place = "power cable", rated.position_from_tool = 0.4, rated.time = 3, rated.note = "20 % of that\tis twist.";
  SampleLife life = living(12000);
  life.planned_hours = 1e5, life.robot_life_hours = 40000;
  life.unvalidated = unvalidated_text({rated});
  const auto rows = read_ranking({job_with(scratch, "rated", life)});
  CHECK(
      action_words(rows[0]) ==
      "The maker's rating of power cable covers only 5,000 .. 16,000 h (10 .. 90 %, not validated): test or replace it by then. The "
      "wires last longer than the robot (40,000 h). Not evaluated: water hose, kinks.");
  CHECK(mode_lines(rows[0])[1].mode == "maker's rating† of power cable");
  CHECK(mode_lines(rows[0])[1].note == "A lower bound of its life. 20 % of that is twist.");
  const auto table = read_csv(ranking_csv(rows));
  const auto cell = [&](const std::string& name) {
    return table[1].at(static_cast<std::size_t>(std::find(table[0].begin(), table[0].end(), name) - table[0].begin()));
  };
  CHECK(cell("rating_hours_p50") == "9000");
  CHECK(cell("rating_of") == "power cable");
  CHECK(cell("abrasion_life_hours_p50").empty());
  rated.hours.fill(infinity);
  CHECK(line_of(rated).hours[0] == "over 40,000");
}

TEST_CASE("ranking: the relative life of a rated cable has columns and words, empty without a rating") {
  const Scratch scratch;
  auto rows = read_ranking({job_with(scratch, "rated", living(12000)), job_with(scratch, "unrated", living(10000))});
  rows[0].relative = RelativeLife{"lead", "torsion: twist_deg_per_m 180", 1250, 5e6};
  const auto table = read_csv(ranking_csv(rows));
  const auto title = std::find(table[0].begin(), table[0].end(), "rated_cycles_per_hour");
  REQUIRE(table[0].end() - title > 2);
  const auto at = static_cast<std::size_t>(title - table[0].begin());
  CHECK(table[1][at] == "1250");
  CHECK(table[1][at + 1] == "4000");
  CHECK(table[1][at + 2] == "lead");
  CHECK((table[2][at] + table[2][at + 1] + table[2][at + 2]).empty());
  CHECK(
      ranking_table(rows).find("\n   one hour does the damage of 1,250 rated cycles of lead; 5,000,000 rated: 4,000 h "
                               "(torsion: twist_deg_per_m 180)\n") != std::string::npos);
  rows[0].relative->cycles_per_hour = 0;
  CHECK(relative_words(*rows[0].relative).ends_with("rated: no damage (torsion: twist_deg_per_m 180)"));
}

TEST_CASE("ranking: what the mesh of loose cables leaves out has a column, empty where none lies loose") {
  const Scratch scratch;
  auto rows = read_ranking(
      {job_with(scratch, "loose", living(12000)), job_with(scratch, "held", living(10000)), {"broken", "", "why"}});
  rows[0].loose_mesh_error = 0.0125;
  const auto table = read_csv(ranking_csv(rows));
  const auto title = std::find(table[0].begin(), table[0].end(), "loose_mesh_error");
  REQUIRE(title != table[0].end());
  const auto at = static_cast<std::size_t>(title - table[0].begin());
  CHECK(table[1][at] == "0.0125");
  CHECK(table[2][at].empty());
  CHECK(table[3].size() == table[0].size());
}

TEST_CASE("ranking: the terminal's table is aligned, within its width, and says what breaks") {
  const Scratch scratch;
  SampleLife wordy = living(4.2e9);
  wordy.worst_component =
      "a cable with a very long name indeed 3/a conductor with a long name 2/the outermost layer 1/wire 17";
  const auto rows = read_ranking({job_with(scratch, "robot 1", living(12000)),
                                  job_with(scratch, "Käfig mit sehr langem Namen und noch mehr", wordy),
                                  job_with(scratch, "easy", living(infinity)),
                                  {"short", "", "job.yaml:3:1: error: too short; make it longer"}});
  const std::string table = ranking_table(rows);
  std::istringstream lines(table);
  std::vector<std::string> all;
  for (std::string line; std::getline(lines, line);) all.push_back(line);
  for (std::size_t i = 0; i < all.size(); ++i) {
    INFO(all[i]);
    CHECK(columns_of(all[i]) <= 120);
    CHECK(!all[i].ends_with(' '));
  }
  // The numbers of a column end below its title.
  const auto up_to = [&](const std::string& line, const std::string& title) {
    return line.substr(0, line.size() - all[0].size() + all[0].find(title) + title.size());
  };
  REQUIRE(all.size() > 5);
  CHECK(all[1].substr(0, all[0].find("replace after [h]") + 17).ends_with("no damage"));
  CHECK(all[2] == "   Käfig mit sehr langem Namen und noch mehr");  // complete, in its own line
  CHECK(up_to(all[3], "replace after [h]").ends_with(" " + readable(rows[1].life_hours)));
  CHECK(up_to(all[4], "replace after [h]").ends_with(" " + readable(rows[2].life_hours)));
  CHECK(all[5].find("failed") != std::string::npos);
  CHECK(table.find("\n\neasy\n   No replacement is foreseen: no wire is damaged.\n") != std::string::npos);
  CHECK(table.find("\n\nrobot 1\n   The worst wire is signal cable 3/conductor 2/layer 1/wire 17, ") !=
        std::string::npos);
  CHECK(std::regex_replace(table, std::regex("\n +"), " ").find("outermost layer 1/wire 17") != std::string::npos);
  CHECK(table.find("...") == std::string::npos);
  CHECK(table.find("\n\nshort\n   job.yaml:3:1: error: too short; make it longer\n") != std::string::npos);
}

TEST_CASE("ranking: a bound that fewer than 10 % reach is no life without damage") {
  RankingRow row;
  row.life_hours = 5e5, row.planned_hours = {5e4, infinity, infinity}, row.planned_months = 150;
  row.robot_life_hours = 4e4, row.glued_hours = {2410, 1e6, infinity}, row.free_hours = {infinity, infinity, infinity};
  CHECK_THAT(uncapped_words(row),
             Catch::Contains("1 of 10 after 2,410 h with everything in the cables glued, never with everything free."));
  CHECK(shown_range(row, row.glued_hours[0], row.free_hours[0]) == "2,410 .. over 40,000");
  row.planned_hours[0] = infinity;
  CHECK(shown_range(row, row.glued_hours[0], row.free_hours[0]) == "2,410 .. never");
}

TEST_CASE(
    "ranking: jobs are ranked and reported by the life that 10 % do not reach, without a plan by the worst wire") {
  const Scratch scratch;
  SampleLife weak = living(20000), strong = living(10000);
  weak.planned_hours = 50, strong.planned_hours = 60;
  const auto rows = read_ranking({job_with(scratch, "long worst wire", weak), job_with(scratch, "strong", strong),
                                  job_with(scratch, "old", living(10000))});
  REQUIRE(names(rows).size() == 3);
  const RankingRow& first = rows[rows[0].job == "old" ? 1 : 0];
  CHECK(first.job == "strong");
  CHECK(first.headline_hours() == 60);
  CHECK(first.headline_repeats() == Approx(60 * 3600 / first.repeat_seconds));
  CHECK(first.first_wire_hours[2] == Approx(37.5));
  CHECK(first.failing_conductor == "signal cable 3/conductor 2");
  const RankingRow& old =
      *std::find_if(rows.begin(), rows.end(), [](const RankingRow& row) { return row.job == "old"; });
  CHECK_FALSE(old.planned());
  CHECK(old.headline_hours() == old.life_hours);

  const auto table = read_csv(ranking_csv(rows));
  const auto cell = [&](const std::string& job, const std::string& column) {
    const auto at = static_cast<std::size_t>(std::find(table[0].begin(), table[0].end(), column) - table[0].begin());
    for (const auto& cells : table)
      if (cells[0] == job) return cells.at(at);
    return std::string("no such job");
  };
  CHECK(cell("strong", "life_hours_p10") == "60");
  CHECK(cell("strong", "life_hours_p90") == "150");
  CHECK(cell("strong", "first_wire_life_hours_p10") == "15");
  CHECK(std::stod(cell("strong", "life_hours_all_stick")) == Approx(first.life_hours / 400));
  CHECK(std::stod(cell("strong", "life_hours")) == first.life_hours);  // the worst wire's, also with a planned life
  CHECK(cell("strong", "failing_position_from_tool_m") == "0.75");
  CHECK(cell("old", "life_months_p10").empty());
  const std::string text = ranking_table(rows);
  CHECK(text.find("replace after [h]") != std::string::npos);
  CHECK(
      text.find(
          "With the job's own values, by the scatter of wires alone, a first wire breaks after 15.0 .. 37.5 h (10 .. 90 %).") !=
      std::string::npos);
  CHECK_THAT(
      std::regex_replace(text, std::regex("\n +"), " "),
      Catch::Contains(
          "Fails first: wires of signal cable, in 75 % of the samples that fail, likeliest signal cable 3/conductor 2, 0.75 m from the tool."));
  CHECK(cell("strong", "life_hours_p90_all_glued") == "15");
  CHECK(cell("strong", "life_hours_p10_all_free") == "600");
  CHECK(cell("strong", "failing_mode") == "wires of signal cable");
  CHECK(cell("old", "life_hours_p10_all_glued").empty());
  CHECK(cell("strong", "rank") == (rows[0].job == "strong" ? "1" : "2"));
}

constexpr std::size_t motion = index_of(Uncertain::motion);

/// Returns the response of a job whose lives are all 10^log10_life repeats, with the prior's uncertainty.
/// swings: variance of the swing, which jobs with different simulations do not share.
std::string response_of(double log10_life, double swings = 0) {
  LifeResponse response;
  response.knowledge = prior_of({});
  response.knowledge.covariance(motion, motion) = swings;
  response.worst_life = {log10_life};
  response.planned = {{log10_life, log10_life, log10_life}};
  return response.text();
}

TEST_CASE("ranking: how sure an order is, what makes a life uncertain, and what to measure next") {
  const Scratch scratch;
  SampleLife longer = living(20000), shorter = living(10000), certain = living(5000);
  longer.planned_hours = 60, shorter.planned_hours = 50, certain.planned_hours = 40;
  longer.life_response = response_of(4.5), shorter.life_response = response_of(4);
  auto rows = read_ranking({job_with(scratch, "shorter", shorter), job_with(scratch, "longer", longer),
                            job_with(scratch, "certain", certain)});
  REQUIRE(names(rows) == std::vector<std::string>{"longer", "shorter", "certain"});
  CHECK(rows[0].outlives_next == 1);  // both jobs share all uncertain parameters
  CHECK_FALSE(rows[1].outlives_next);
  CHECK(rows[0].scatter_hours[1] == Approx(150));
  CHECK(rows[0].headline_hours() == 60);
  const std::string table = ranking_table(rows);
  CHECK(
      std::regex_replace(table, std::regex("\n +"), " ")
          .find(
              "53 % of the uncertainty is the friction inside the cables. The measurement that narrows the range most: one "
              "bending test of a cable (one hour). If it confirms the estimate, the range becomes about 66.0 .. 102 h (now "
              "60.0 .. 150 h).") != std::string::npos);
  CHECK(table.find("\n   Lives longer than the next job in 100 of 100 samples.\n") != std::string::npos);
  const auto csv = read_csv(ranking_csv(rows));
  CHECK(csv[0].size() == csv[1].size());
  const auto column = std::find(csv[0].begin(), csv[0].end(), "measure_next_share");
  REQUIRE(column != csv[0].end());
  const auto at = static_cast<std::size_t>(column - csv[0].begin());
  CHECK(csv[1][at] == "0.53");
  CHECK(csv[3][at].empty());
  shorter.life_response = "point 1";
  rows = read_ranking({job_with(scratch, "shorter", shorter), job_with(scratch, "longer", longer)});
  CHECK(rows[1].failure.find("'life_response' is no response") != std::string::npos);
}

TEST_CASE("ranking: jobs that cannot be separated share a rank, those that can do not") {
  const Scratch scratch;
  SampleLife first = living(30000), second = living(20000), third = living(10000);
  first.planned_hours = 60, second.planned_hours = 50, third.planned_hours = 40;
  // Different dresspacks: friction is sampled independently for each, with one factor of e^0.9 in life.
  const auto uncertain = [](double log10_life, const char* construction) {
    LifeResponse response;
    response.construction = construction;
    response.knowledge = prior_of({});
    response.knowledge.covariance(motion, motion) = 0;
    response.points = {{0}, {-1.5}, {1.5}};
    response.inside.assign(3, Inside::as_is);
    response.worst_life = {log10_life, log10_life + 0.6, log10_life - 0.6};
    response.planned = {{log10_life, log10_life, log10_life}};
    return response.text();
  };
  first.life_response = uncertain(4.5, "a"), second.life_response = uncertain(4.4, "b");
  third.life_response = uncertain(2, "c");
  const auto rows = read_ranking({job_with(scratch, "first", first),
                                  job_with(scratch, "second", second),
                                  job_with(scratch, "third", third),
                                  {"broken", "", "why"}});
  REQUIRE(names(rows) == std::vector<std::string>{"first", "second", "third", "broken"});
  CHECK(rows[0].rank == 1);
  CHECK(rows[1].rank == 1);
  CHECK(rows[2].rank == 3);
  CHECK(rows[3].rank == 0);
  // Of the difference 0.1 +- 0.4 sqrt(2) decades 57 % are positive.
  CHECK(*rows[0].outlives_next == Approx(0.57).margin(0.02));
  CHECK(order_words(rows[0]).ends_with("of 100 samples: no clear difference."));
  CHECK(*rows[1].outlives_next > 0.99);
}

TEST_CASE("ranking: more than a thousand jobs are ranked with certainty, too") {
  const Scratch scratch;
  SampleLife longer = living(20000), shorter = living(10000);
  longer.planned_hours = 60, shorter.planned_hours = 50;
  longer.life_response = response_of(4.5), shorter.life_response = response_of(4);
  const JobResult of_long = job_with(scratch, "long", longer), of_short = job_with(scratch, "short", shorter);
  constexpr std::size_t half = 600;
  std::vector<JobResult> results;
  for (std::size_t k = 0; k < half; ++k)
    for (JobResult result : {of_long, of_short}) {
      result.name += std::to_string(k);
      results.push_back(result);
    }
  const std::vector<RankingRow> rows = read_ranking(results);
  REQUIRE(rows.size() == 2 * half);
  CHECK(rows[0].outlives_next == 0.5);
  CHECK(rows[half - 1].rank == 1);
  CHECK(rows[half - 1].outlives_next == 1);
  CHECK(rows[half].rank == half + 1);
}

TEST_CASE("ranking: p10 orders the jobs within the robot's life, shares of the samples those beyond it") {
  const Scratch scratch;
  SampleLife early = living(20000), late = living(20000);
  early.life_response = response_of(4.5), late.life_response = response_of(4);
  early.planned_hours = 50000, late.planned_hours = 60000;  // late: better p10, shorter samples
  const auto ranked = [&](double robot_life) {
    early.robot_life_hours = late.robot_life_hours = robot_life;
    return read_ranking({job_with(scratch, "early", early), job_with(scratch, "late", late)});
  };
  const auto within = ranked(100000), beyond = ranked(40000), between = ranked(55000);
  CHECK(names(beyond) == std::vector<std::string>{"early", "late"});
  CHECK(beyond[0].outlives_next == 1);
  CHECK(beyond[1].rank == 2);
  CHECK(order_words(beyond[0]) == "Lives longer than the next job in 100 of 100 samples.");
  for (const auto& rows : {within, between}) {
    CHECK(names(rows) == std::vector<std::string>{"late", "early"});
    CHECK(rows[0].outlives_next == 0);
    CHECK(rows[1].rank == 1);  // both statements contradict each other
    CHECK(order_words(rows[0]) ==
          "The next job lives longer in 100 of 100 samples, but 1 of 10 of its dresspacks fails earlier.");
  }
}

TEST_CASE("ranking: jobs with one simulation are compared with one swing of the hose") {
  const Scratch scratch;
  SampleLife longer = living(20000), shorter = living(10000);
  longer.planned_hours = 60, shorter.planned_hours = 50;
  longer.life_response = response_of(4.2, 1), shorter.life_response = response_of(4, 1);
  std::vector<JobResult> results{job_with(scratch, "thick wires", shorter), job_with(scratch, "thin wires", longer)};
  CHECK(*read_ranking(results)[0].outlives_next < 0.7);
  results[0].simulated = "a recipe", results[1].simulated = "another";
  CHECK(*read_ranking(results)[0].outlives_next < 0.7);
  results[1].simulated = results[0].simulated;
  CHECK(read_ranking(results)[0].outlives_next == 1);
}

TEST_CASE("ranking: of one job the first words say what to do, forces that cannot be stop a plan") {
  const Scratch scratch;
  SampleLife life = living(20000);
  life.planned_hours = 1300, life.life_response = response_of(4);
  auto rows = read_ranking({job_with(scratch, "one", life)});
  CHECK(ranking_table(rows).starts_with("Plan a replacement after 1,300 h of motion (3.74 months).\n"));
  rows[0].worst_joint = "joint_5";
  CHECK(ranking_table(rows).starts_with(
      "Plan a replacement after 1,300 h of motion (3.74 months). dresslife improve JOB searches for better clamps"));
  rows[0].file = "weld.yaml";
  CHECK_THAT(ranking_table(rows, 1000), Catch::Contains("dresslife improve weld.yaml searches") &&
                                            Catch::Contains("dresslife reprogram weld.yaml for") &&
                                            Catch::Contains("dresslife run weld.yaml -o held") &&
                                            !Catch::Contains("JOB"));
  rows[0].warnings = std::vector<Warning>{{WarningKind::material, "", "diameter_mm is 300"}};
  CHECK(
      ranking_table(rows, 1000)
          .starts_with(
              "Do not use this result before you have confirmed or corrected its doubtful input (diameter_mm) (see the warnings). Plan"));
  rows[0].warnings = std::vector<Warning>{{WarningKind::force, "", "cables pull"}};
  CHECK(ranking_table(rows).starts_with("Do not plan with 1,300 h: forces (see the warnings).\n"));
  rows[0].planned_hours[0] = 55000, rows[0].robot_life_hours = 40000;
  CHECK(ranking_table(rows).starts_with("Do not plan with this result: forces (see the warnings).\n"));
}

TEST_CASE("ranking: the worst wire is in the likeliest conductor, also if only the wire's path counts the cable") {
  const Scratch scratch;
  RankingRow row = read_ranking({job_with(scratch, "one", living(12000))}).front();
  row.failing_mode = "wires", row.failing_conductor = "cable/layer 1/core 6";
  row.worst_component = "cable 1/layer 1/core 6/layer 1/wire 13";
  CHECK_THAT(failure_words(row), Catch::Contains("The worst wire is cable 1"));
  row.worst_component = "cable 1/layer 1/core 7/layer 1/wire 13";
  CHECK_THAT(failure_words(row), Catch::Contains("another wire is the worst"));
}

TEST_CASE(
    "ranking: infinite lives are no numbers of hours or repeats, and own values without damage are named as such") {
  const Scratch scratch;
  SampleLife life = living(12000);
  life.planned_hours = 60, life.life_response = response_of(4);
  RankingRow row = read_ranking({job_with(scratch, "one", life)}).front();
  row.damage_per_repeat = 0;
  CHECK(
      failure_words(row) ==
      "Fails first: wires of signal cable, in 75 % of the samples that fail, likeliest signal cable 3/conductor 2, 0.75 m "
      "from the tool. With the job's own values no wire is damaged.");
  constexpr double infinite = std::numeric_limits<double>::infinity();
  row.tested_p10 = row.tested_p90 = infinite;
  CHECK_THAT(
      uncertainty_words(row),
      Catch::Contains("If it confirms the estimate, fewer than 1 of 10 such dresspacks fail (now 60.0 .. 150 h)."));
  row.failing_mode = "", row.planned_hours.fill(infinite);
  CHECK(failure_words(row) == "No wire is damaged.");
  CHECK(repeat_words(row) == "");
  row.outlives_next = 0.502;
  CHECK(order_words(row) == "In most samples neither this job nor the next one fails: no clear difference.");
  row.outlives_next = 0.6;
  CHECK(order_words(row) == "Lives longer than the next job in 60 of 100 samples: no clear difference.");
}

TEST_CASE("ranking: a warning names a file of the study from the folder of the user") {
  const Scratch scratch;
  RankingRow row = read_ranking({job_with(scratch, "one", living(12000))}).front();
  std::filesystem::create_directories(scratch / "study/one");
  scratch.write("study/one/job.yaml", "");
  row.life_file = scratch / "study/one/life.h5";
  row.warnings = std::vector<Warning>{{WarningKind::mesh, "one/job.yaml:4:9", "first"},
                                      {WarningKind::mesh, "cell.yaml:4:9", "second"}};
  const std::string lines = std::regex_replace(warning_lines({row}), std::regex("\n +"), " ");
  CHECK_THAT(lines, Catch::Contains((scratch / "study/one/job.yaml:4:9: first").string()) &&
                        Catch::Contains("warning: cell.yaml:4:9: second"));
}

TEST_CASE("ranking: a life that equals one of its bounds is named, another one is not") {
  const Scratch scratch;
  RankingRow row = read_ranking({job_with(scratch, "one", living(12000))}).front();
  CHECK_THAT(action_words(row), !Catch::Contains("bound"));
  row.life_repeats = row.life_repeats_all_free;
  row.estimates = "";  // no rating was evaluated under the job's slip: the best estimate may be longer
  CHECK_THAT(action_words(row),
             Catch::Contains("equals its upper bound without the ratings of cable makers, at which nothing rubs") &&
                 Catch::Contains("If the job sets strain.slip, leave it out") &&
                 Catch::Contains("it may be longer than this life"));
  row.estimates = "uncertainty.ratings typical (strength x 1.2)";
  CHECK_THAT(action_words(row),
             Catch::Contains("equals its upper bound, at which nothing rubs") && !Catch::Contains("ratings"));
  row.life_repeats = row.life_repeats_all_stick;
  CHECK_THAT(action_words(row),
             Catch::Contains("equals its lower bound, at which nothing slips") && !Catch::Contains("may be longer"));
  row.life_repeats_all_free = 1.11 * row.life_repeats_all_stick;
  CHECK_THAT(action_words(row), Catch::Contains("equals its lower bound"));
  row.life_repeats_all_free = 1.09 * row.life_repeats_all_stick;  // no difference that matters
  CHECK_THAT(action_words(row), !Catch::Contains("bound"));
}

TEST_CASE("ranking: what the calculation leaves uncertain stands beside the causes, where it is known") {
  const Scratch scratch;
  RankingRow row = read_ranking({job_with(scratch, "one", living(12000))}).front();
  row.planned_errors = {5.754, std::nan(""), 58.0};
  CHECK_THAT(
      uncertainty_words(row),
      Catch::Contains(
          "numerical error, because lives change abruptly with stiffness, slack and friction, and only some values of these are computed: "
          "the 10 % value by a factor of 5.8, the 90 % value by a factor of 58.") &&
          !Catch::Contains("50 % value"));
  CHECK_THAT(uncertainty_words(row), !Catch::Contains("come to a cycle"));
  CHECK_THAT(uncertainty_words(row), !Catch::Contains("estimated_lay_factor"));
  row.estimates = "data_sheet of lead: lay_length_mm 69";
  row.measure_next = "strength", row.measure_next_share = 0.5;
  CHECK_THAT(uncertainty_words(row),
             Catch::Contains("Not in the range: the lay lengths") &&
                 Catch::Contains("dresslife run JOB -o lay --set dresspack.estimated_lay_factor=0.67"));
  row.moving_places = 3;
  CHECK_THAT(uncertainty_words(row),
             Catch::Contains("loose cables do not come to a cycle at 3 of the computed values"));
  row.planned_errors.fill(std::nan(""));
  CHECK_THAT(uncertainty_words(row), !Catch::Contains("by a factor of"));
}

TEST_CASE(
    "ranking: a life beyond the robot's own is shown as such, with its hours below the table and in ranking.csv") {
  const Scratch scratch;
  SampleLife life = living(500);
  life.robot_life_hours = 40000;
  const auto shown = [&](double planned_hours) {
    life.planned_hours = planned_hours;
    return read_ranking({job_with(scratch, "one", life)});
  };
  const auto long_lived = shown(50000), last_within = shown(40000), short_lived = shown(1000);
  const std::string table = ranking_table(long_lived, 200);
  CHECK_THAT(table, Catch::StartsWith("The evaluated parts last longer than the robot (40,000 h)."));
  CHECK_THAT(table, Catch::Contains(
                        "over 40,000  over 9.6 years      over 40,000      over 40,000          5,000 .. over 40,000"));
  CHECK_THAT(
      table,
      Catch::Contains(
          "1 of 10 such dresspacks has failed after 50,000 h of motion (12 years), half after 75,000 h, 90 % after 125,000 h"));
  CHECK_THAT(table, Catch::Contains("Hours beyond the robot's life (40,000 h) only compare jobs."));
  CHECK_THAT(ranking_csv(long_lived), Catch::Contains("50000"));
  CHECK_THAT(ranking_table(last_within, 200), Catch::StartsWith("Plan a replacement after 40,000 h"));
  CHECK_THAT(ranking_table(short_lived, 200), !Catch::Contains("over 40,000") && !Catch::Contains("only compare jobs"));
  life.robot_life_hours = 0;
  CHECK_THAT(ranking_table(shown(50000), 200), Catch::StartsWith("Plan a replacement after 50,000 h"));
}

TEST_CASE("ranking: samples that live a decade longer or shorter than with the job's own values are named") {
  RankingRow row;
  CHECK(own_values_words(row) == "");
  row.first_wire_hours = {10, 20, 40}, row.scatter_hours = {30, 50, 80};
  const std::string first =
      "With the job's own values, by the scatter of wires alone, a first wire breaks after 10.0 .. 40.0 h (10 .. 90 %).";
  const double infinite = std::numeric_limits<double>::infinity();
  for (
      const auto& [half, more] :
      {std::pair{400.0, std::string()},
       {6.0, ""},
       {7500.0,
        " Half of the samples live 150 times longer than with these values: most other values damage the wires less."},
       {infinite, " Half of the samples are not damaged: most other values damage the wires less."},
       {2.5,
        " Half of the samples fail 20 times sooner than with these values: most other values damage the wires more."}}) {
    row.planned_hours = {1, half, infinite};
    CHECK(own_values_words(row) == first + more);
  }
}

TEST_CASE("ranking: the joint that a strain follows is no cause, and the words name the run that tries it") {
  RankingRow row;
  row.worst_component = "cable 1/wire 1", row.damage_per_repeat = 1;
  row.worst_joint = "joint_4";
  for (const double share : {0.413, 1.29}) {
    row.worst_joint_share = share;
    CHECK(
        joint_words(row) ==
        "The strain of this wire follows joint_4 most. That is a correlation, no cause. This job without the axis shows what it costs: "
        "dresslife run JOB -o held --set motion.hold_joint=joint_4");
  }
  row.worst_joint = "carrying";
  CHECK(
      joint_words(row) ==
      "The damage follows the swing of the hose more than the position of any axis. That is a correlation, no cause. This job without "
      "the axis shows what it costs: dresslife run JOB -o held --set motion.hold_joint=AXIS");
  CHECK(held_words(row).empty());
  row.held_joint = "joint_4";
  CHECK(joint_words(row).empty());
  CHECK_THAT(held_words(row), Catch::StartsWith("joint_4 is held") && Catch::Contains("not with other jobs"));
}

TEST_CASE("ranking: jobs whose repeats differ by more than 2 % are compared by repeats") {
  const auto row_with = [](double seconds) {
    RankingRow row;
    row.damage_per_repeat = 1, row.repeat_seconds = seconds;
    return row;
  };
  for (const auto& rows : {std::vector{row_with(10), row_with(30)}, std::vector{row_with(30), row_with(10)}})
    CHECK_THAT(comparison_words(rows), Catch::Contains("10.0 .. 30.0 s"));
  CHECK(comparison_words({row_with(100), row_with(101)}).empty());
  CHECK_FALSE(comparison_words({row_with(100), row_with(103)}).empty());
  RankingRow failed = row_with(1);
  failed.failure = "no motion";
  CHECK(comparison_words({row_with(10), failed}).empty());
}

TEST_CASE("ranking: a remark states that ranks without uncertain parameters compare the jobs' own values") {
  RankingRow row;
  row.damage_per_repeat = 1, row.repeat_seconds = 10, row.worst_component = "wire 1";
  RankingRow alone = row, uncertain = row, undamaged = row;
  uncertain.life_response = "known", undamaged.damage_per_repeat = 0;
  CHECK_THAT(comparison_words({row, alone}), Catch::Contains("own values only (uncertainty.enabled: false)"));
  CHECK_THAT(comparison_words({uncertain, row}), Catch::Contains("own values only"));
  for (const auto& rows : {std::vector{row}, std::vector{uncertain, uncertain}, std::vector{uncertain, undamaged}})
    CHECK(comparison_words(rows).empty());
  RankingRow rated = uncertain, stronger = uncertain;
  rated.job = "rated", stronger.job = "stronger";
  rated.estimates = "slack_percent 1; uncertainty.ratings typical (strength x 1.33)";
  CHECK(comparison_words({rated, rated}).empty());
  CHECK_THAT(
      comparison_words({rated, stronger}),
      Catch::Contains("in the same way: rated (strength x 1.33), stronger (no change). Do not compare these jobs."));
}

TEST_CASE("ranking: a small share of samples in which a mode comes first is not printed as zero") {
  UnvalidatedMode mode;
  mode.mode = UnvalidatedMode::corkscrew;
  mode.place = "signal cable 3";
  for (const auto& [share, text] :
       {std::pair{0.0, "0 %"}, {0.0004, "under 0.1 %"}, {0.005, "0.5 %"}, {0.0096, "1 %"}, {0.574, "57 %"}}) {
    mode.first_share = share;
    RankingRow row;
    row.unvalidated = {mode}, row.worst_segment_from_tool = 1;
    CHECK(mode_lines(row).back().before_wires == text);
  }
}

TEST_CASE("ranking: the legend explains none and - where a line has them") {
  ModeLine line;
  line.hours = {"300", "over 40,000", "over 40,000"};
  CHECK(cell_legend({line}).empty());
  line.hours[2] = "none";
  CHECK(cell_legend({line}) == " none: so many dresspacks never fail by this mode.");
  line.hours[0] = "-";
  CHECK(cell_legend({line}) == " none: so many dresspacks never fail by this mode. -: not predicted.");
}

}  // namespace

TEST_CASE("ranking: warnings are counted, told in full, and each kind says whether it is as it should be") {
  const Scratch scratch;
  auto rows = read_ranking({job_with(scratch, "warned", living(12000)), job_with(scratch, "silent", living(10000)),
                            job_with(scratch, "older", living(8000))});
  rows[0].warnings = std::vector<Warning>{{WarningKind::program, "a.mod:3", "skipped: \"SearchL\", and waits"},
                                          {WarningKind::program, "a.mod:9", "skipped: WaitSyncTask"},
                                          {WarningKind::twist, "", "largest twist: 200 deg/m"}};
  rows[1].warnings.emplace();
  const auto table = read_csv(ranking_csv(rows));
  const auto cell = [&](std::size_t row, const std::string& column) {
    const auto title = std::find(table[0].begin(), table[0].end(), column);
    REQUIRE(title != table[0].end());
    return table[row][static_cast<std::size_t>(title - table[0].begin())];
  };
  CHECK(cell(1, "warnings") == "3");
  CHECK(cell(1, "warning_words") ==
        "a.mod:3: skipped: \"SearchL\", and waits; a.mod:9: skipped: WaitSyncTask; largest twist: 200 deg/m");
  CHECK(cell(1, "program_ok") == "no");
  CHECK(cell(1, "twist_ok") == "no");
  CHECK(cell(1, "periodic_ok") == "yes");
  CHECK(cell(2, "warnings") == "0");
  CHECK(cell(2, "twist_ok") == "yes");
  CHECK(cell(3, "warnings").empty());  // unknown
  CHECK(cell(3, "twist_ok").empty());
  CHECK(warning_kinds(rows[0]) == "skipped instructions x2, twist");
  CHECK(warning_kinds(rows[1]).empty());
  RankingRow doubtful = rows[1];
  doubtful.warnings = {{WarningKind::material, "", "least_bend_radius_mm is 160, 2.94 diameters"}};
  CHECK(warning_kinds(doubtful) == "doubtful input (least_bend_radius_mm)");
  doubtful.warnings->push_back({WarningKind::material, "", "material copper: K' and n' disagree"});
  CHECK(warning_kinds(doubtful) == "doubtful input x2");
  CHECK(ranking_table(rows).find("\n   WARNING: skipped instructions x2, twist\n") != std::string::npos);
  CHECK(warning_lines(rows) ==
        "warned: warning: a.mod:3: skipped: \"SearchL\", and waits\nwarned: warning: a.mod:9: skipped: WaitSyncTask\n"
        "warned: warning: largest twist: 200 deg/m\n");
  RankingRow stale = rows[0];  // its hours are shown, so its warnings mark them, but the run does not print them
  stale.failure = "stale", stale.stale = true;
  CHECK(plan_mark(rows[0]) == "!");
  CHECK(plan_mark(stale) == "!");
  CHECK(marks_note({stale}).find("skipped instructions x2, twist") != std::string::npos);
  CHECK(warning_lines({stale, stale}).empty());
  const std::vector<RankingRow> many(5, rows[0]);  // 15 lines: the first of each kind represents the others
  CHECK(warning_lines(many) ==
        "5 jobs, skipped instructions: warned: warning: a.mod:3: skipped: \"SearchL\", and waits\n"
        "5 jobs, twist: warned: warning: largest twist: 200 deg/m\n"
        "15 warnings in all: in ranking.csv, in the report and in the jobs' logs\n");
  std::vector<RankingRow> two = many;  // 6 of them do
  for (std::size_t k = 2; k < two.size(); ++k) two[k].warnings.emplace();
  two[0].warnings->insert(two[0].warnings->end(), 10, two[0].warnings->back());
  CHECK_THAT(warning_lines(two),
             Catch::StartsWith("2 jobs, skipped instructions: ") && Catch::Contains("\n2 jobs, twist: "));
  two[1].warnings.emplace();
  CHECK_THAT(warning_lines(two), Catch::StartsWith("warned: ") && Catch::Contains("\nwarned: "));

  std::vector<RankingRow> other(2, rows[0]);
  for (RankingRow& row : other) row.warnings = {{WarningKind::other_values, "", "twist with half the slack"}};
  CHECK(warning_kinds(other[0]).empty());
  CHECK(warning_lines(other) ==
        "2 jobs, limits at other values: warned: warning: twist with half the slack\n"
        "2 warnings on limits at other values: in ranking.csv, in the report and in the jobs' logs\n");
  // Of one job each is printed, and its first paragraph points to them.
  other[0].warnings->push_back({WarningKind::other_values, "", "bent with half the stiffness"});
  CHECK(warning_lines({other[0]}) ==
        "warned: warning: twist with half the slack\nwarned: warning: bent with half the stiffness\n");
  CHECK_THAT(
      action_words(other[0]),
      Catch::Contains("With other stiffness, slack or friction some dresspacks exceed a limit (see the warnings)."));
  other[0].warnings.emplace();
  CHECK_THAT(action_words(other[0]), !Catch::Contains("see the warnings"));
}

}  // namespace dresslife::pipeline
