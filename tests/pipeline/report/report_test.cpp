#include "pipeline/report/report.h"

#include <chrono>
#include <map>
#include <regex>
#include <set>

#include "pipeline/base/constants.h"
#include "pipeline/base/ownership.h"
#include "pipeline/report/life_charts.h"
#include "pipeline/report/plot.h"
#include "tests/catch.h"
#include "tests/pipeline/sample_life.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::pipeline {
namespace {

std::string page_of(const std::string& study, const std::vector<RankingRow>& rows) {
  std::vector<ReportProblem> problems;
  return report_page(study, rows, problems);
}

/// Upper bound of a job's section without its settings: charts of a history of any length.
constexpr std::size_t largest_section = 150'000;

JobResult job_with(const Scratch& scratch, const std::string& file, const SampleLife& life,
                   const std::string& name = "") {
  write_sample_life(scratch / (file + ".h5"), life);
  return {name.empty() ? file : name, scratch / (file + ".h5"), ""};
}

/// Returns the first place where a tag is not closed in the order of opening or an attribute is not quoted; "" if none.
std::string first_fault(const std::string& page) {
  std::vector<std::string> open;
  for (std::size_t at = page.find('<'); at != std::string::npos; at = page.find('<', at + 1)) {
    const std::size_t end = page.find('>', at);
    if (end == std::string::npos) return "unclosed tag";
    const std::string tag = page.substr(at + 1, end - at - 1);
    const std::string name = tag.substr(tag.starts_with('/'), tag.find_first_of(" >/", 1) - tag.starts_with('/'));
    if (tag.starts_with('!') || tag.ends_with('/') || name == "meta" || name == "br") continue;
    if (count_of(tag, "\"") % 2) return "odd quotes in <" + tag + ">";
    if (!tag.starts_with('/')) {
      open.push_back(name);
    } else {
      if (open.empty() || open.back() != name)
        return "</" + name + "> closes " + (open.empty() ? "nothing" : open.back());
      open.pop_back();
    }
    if ((name == "style" || name == "script") && !tag.starts_with('/')) at = page.find("</" + name + ">", at) - 1;
  }
  return open.empty() ? "" : open.back() + " stays open";
}

void check_page(const std::string& page) {
  CHECK(first_fault(page) == "");
  for (const char* word : {"http", "src=", "url(", "@import", "<link", "nan", "\"inf", "-inf"}) {
    INFO(word);
    CHECK(page.find(word) == std::string::npos);
  }
  CHECK(count_of(page, "<script") == 1);  // the page's own, at its end
  CHECK(page.find("<script>\n\"use strict\";") != std::string::npos);
}

TEST_CASE("report: which joint and which clamp cost the life, and the hose beside the wires") {
  const Scratch scratch;
  SampleLife life;
  life.causes = true;
  life.hose_hours = 3400;
  write_sample_life(scratch / "one.h5", life);
  const auto rows = read_ranking({{"one", scratch / "one.h5", ""}});
  const std::string page = page_of("causes", rows);
  CHECK(page.find("What moved while the damage was done: a correlation") != std::string::npos);
  CHECK(page.find(" By the nearest clamp: base clamp 25 %; tool clamp 75 %.") != std::string::npos);
  CHECK(page.find("<td>hose&#39;s wall†</td><td class=\"number\">-</td><td class=\"number\">3,400</td>") !=
        std::string::npos);
  CHECK(page.find("<td>weld spot") != std::string::npos);
  CHECK(page.find("The strain of this wire follows joint_5 most. That is a correlation, no cause.") !=
        std::string::npos);
  const std::string table = std::regex_replace(ranking_table(rows), std::regex("\n +"), " ");
  CHECK(table.find("The strain of this wire follows joint_5 most. That is a correlation, no cause.") !=
        std::string::npos);
  CHECK_THAT(table, Catch::Contains("hose's wall†") && Catch::Contains(" 3,400 "));
  CHECK(ranking_csv(rows).find(",joint_5,0.8,,,,,") != std::string::npos);
  life.causes = false;
  life.hose_hours = 0;
  write_sample_life(scratch / "old.h5", life);
  const std::string old = page_of("old", read_ranking({{"old", scratch / "old.h5", ""}}));
  CHECK(old.find("What moved") == std::string::npos);
  CHECK(old.find("wall†") == std::string::npos);
}

TEST_CASE(
    "report: a wall's life that is not credible has no number, and the legend of * names the modes that may come first") {
  const Scratch scratch;
  UnvalidatedMode wall, jacket;
  wall.mode = UnvalidatedMode::wall, wall.hours = {UnvalidatedMode::unknown, 157.25, UnvalidatedMode::unknown};
  wall.bends_at_limit = 2980, wall.place = "hose 6", wall.segment_from_tool = 1;
  jacket.mode = UnvalidatedMode::jacket, jacket.hours = {200, 5000, 90000};
  jacket.place = "power cable 1";
  SampleLife life;
  life.unvalidated = unvalidated_text({jacket, wall});
  write_sample_life(scratch / "one.h5", life);
  const auto rows = read_ranking({{"one", scratch / "one.h5", ""}});
  const std::string page = page_of("wall", rows), csv = ranking_csv(rows);
  const std::string table = std::regex_replace(ranking_table(rows), std::regex("\n +"), " ");
  CHECK(page.find(">157<") == std::string::npos);
  CHECK(table.find("157") == std::string::npos);
  CHECK(csv.find(",157.25,") == std::string::npos);
  for (const std::string& text : {page, table}) CHECK(text.find("wall†") != std::string::npos);
  CHECK(page.find("Not predicted: the only known law") != std::string::npos);
  CHECK(page.find("confirms their laws: jacket wear, hose") != std::string::npos);
  CHECK(page.find("* marks jobs in which one of them may come first: jacket wear in 1 job.") != std::string::npos);
  // If the law agrees with the test, every place shows the number.
  wall.bends_at_limit = 2e7;
  life.unvalidated = unvalidated_text({jacket, wall});
  write_sample_life(scratch / "two.h5", life);
  const auto known = read_ranking({{"two", scratch / "two.h5", ""}});
  CHECK(page_of("wall", known).find(">157</td>") != std::string::npos);
  CHECK(ranking_csv(known).find(",157.25,") != std::string::npos);
}

TEST_CASE("report: of several dresspacks each has its shortest life and the worst one is named") {
  const Scratch scratch;
  SampleLife life;
  life.causes = true;
  life.dresspacks = {"main hose", "sensor <cable>"};
  write_sample_life(scratch / "two.h5", life);
  const auto rows = read_ranking({{"two", scratch / "two.h5", ""}});
  CHECK(rows[0].worst_dresspack == "sensor <cable>");
  const std::string csv = ranking_csv(rows);
  CHECK(
      csv.substr(0, csv.find('\n')).find(",worst_dresspack,settings,largest_force_share,clamp_moment_share,force_ok") !=
      std::string::npos);
  CHECK(csv.find(",joint_5,0.8,sensor <cable>,,,,") != std::string::npos);
  const std::string page = page_of("two", rows);
  check_page(page);
  CHECK(page.find("Life by dresspack</h3>") != std::string::npos);
  const auto cells = [&](const std::string& name, double repeats) {
    return "<tr><td>" + name + "</td><td class=\"number\">" + printed(rows[0].hours_of(repeats)) +
           "</td><td class=\"number\">" + printed(repeats) + "</td>";
  };
  CHECK(page.find(cells("main hose", 8 * life.repeats)) != std::string::npos);
  CHECK(page.find(cells("sensor &lt;cable&gt;", life.repeats)) != std::string::npos);
  CHECK(page.find("segment 3 from the tool (0.12 m) of the sensor &lt;cable&gt;") != std::string::npos);
  CHECK(page.find("Damage along the sensor &lt;cable&gt;</h3>") != std::string::npos);
  // Only along the worst dresspack, with its own clamps and the damage of its own worst segment over time.
  const LifeSummary told = read_life(scratch / "two.h5");
  CHECK(told.segment_length.size() == 25);
  CHECK(*std::max_element(told.segment_damage.begin(), told.segment_damage.end()) == 1 / life.repeats);
  CHECK(*std::max_element(told.damage_rate.begin(), told.damage_rate.end()) > 0);
  CHECK(page.find(" By the nearest clamp: base clamp 25 %; tool clamp 75 %.") != std::string::npos);
  // A job's only dresspack needs no table.
  life.dresspacks.clear();
  write_sample_life(scratch / "one.h5", life);
  const std::string one = page_of("one", read_ranking({{"one", scratch / "one.h5", ""}}));
  CHECK(one.find("Life by dresspack") == std::string::npos);
  CHECK(one.find("Damage along the dresspack</h3>") != std::string::npos);
}

TEST_CASE("report: a page for a study stands alone and is whole") {
  const Scratch scratch;
  SampleLife calm;
  calm.repeats = 4e6;
  SampleLife easy;
  easy.repeats = infinity;
  const auto rows = read_ranking({job_with(scratch, "robot_1", {}),
                                  job_with(scratch, "robot_2", calm),
                                  job_with(scratch, "easy", easy),
                                  {"too_short", "", "job.yaml:12:3: error: 0.213 m too short; lengthen it"}});
  const std::string page = page_of("two_robots", rows);
  check_page(page);
  CHECK(page.find("3 of 4 jobs done") != std::string::npos);
  CHECK(page.find("job.yaml:12:3: error: 0.213 m too short; lengthen it") != std::string::npos);
  CHECK(count_of(page, "<section") == 3);
  CHECK(count_of(page, "Strain of the worst wire over time</h3>") == 3);
  CHECK(count_of(page, "Damage along the dresspack</h3>") == 2);  // only for jobs with damage
  CHECK(count_of(page, "Program lines that cost most</h3>") == 2);
  CHECK(page.find("prefers-color-scheme: dark") != std::string::npos);
  CHECK(page.find("Lives compared") != std::string::npos);
  for (std::size_t i = 1; i <= 3; ++i)
    CHECK(count_of(page, "job-" + std::to_string(i) + "\"") == 2);  // link and target
  CHECK(page_of("two_robots", rows) == page);
}

TEST_CASE("report: each kind of line that is drawn has a rule, as a path without one is not seen") {
  const Scratch scratch;
  SampleLife calm;
  calm.repeats = 1e9;
  const std::string page =
      page_of("two", read_ranking({job_with(scratch, "robot_1", {}), job_with(scratch, "robot_2", calm)}));
  const std::string rules = page.substr(0, page.find("</style>")), begin = "<path class=\"";
  std::set<std::string> kinds;
  for (std::size_t at = page.find(begin); at != std::string::npos; at = page.find(begin, at + 1)) {
    const std::size_t word = at + begin.size();
    kinds.insert(page.substr(word, page.find('"', word) - word));
  }
  CHECK(kinds.count("whisker") == 1);
  for (const std::string& kind : kinds) {
    INFO(kind);
    CHECK((rules.find("." + kind + " ") != std::string::npos || rules.find("." + kind + ",") != std::string::npos));
  }
}

TEST_CASE("report: words of jobs, wires, programs and settings are harmless") {
  const Scratch scratch;
  SampleLife hostile;
  hostile.worst_component = "<script>alert(1)</script>/\"wire\" 1";
  hostile.line_name = "R&D's <b>spot</b>";
  hostile.job = "name: </pre><script>\n";
  const auto rows =
      read_ranking({job_with(scratch, "a", hostile, "<i>job</i>"), {"<u>bad</u>", "", "<script>why</script>"}});
  const std::string page = page_of("<study> & \"more\"", rows);
  check_page(page);
  CHECK(page.find("<i>") == std::string::npos);
  CHECK(page.find("<u>") == std::string::npos);
  CHECK(page.find("&lt;study&gt; &amp; &quot;more&quot;") != std::string::npos);
  CHECK(page.find("R&amp;D&#39;s &lt;b&gt;spot&lt;/b&gt;") != std::string::npos);
}

TEST_CASE("report: nothing to show is said, not drawn") {
  const Scratch scratch;
  check_page(page_of("empty", {}));
  CHECK(page_of("empty", {}).find("0 of 0 jobs done") != std::string::npos);
  SampleLife no_wires;
  no_wires.wires = false;
  const std::string page = page_of("hose", read_ranking({job_with(scratch, "hose", no_wires)}));
  check_page(page);
  CHECK(page.find("no wires") != std::string::npos);
  CHECK(page.find("no damage") == std::string::npos);
  CHECK(page.find("Cycles of the worst wire") == std::string::npos);
}

TEST_CASE("report: extreme lives and tiny files keep the page whole") {
  const Scratch scratch;
  std::vector<JobResult> jobs;
  for (const double repeats : {1e-6, 0.5, 1e15, 1e300}) {
    SampleLife life;
    life.repeats = repeats;
    life.segments = 4;
    life.lines = 1;
    life.samples = 3;
    jobs.push_back(job_with(scratch, fmt::format("job {}", jobs.size()), life));
  }
  check_page(page_of("extremes", read_ranking(jobs)));
}

TEST_CASE("report: a life file that went away since the ranking says so in its place") {
  const Scratch scratch;
  const auto rows = read_ranking({job_with(scratch, "gone", {}), job_with(scratch, "here", {})});
  std::filesystem::remove(scratch / "gone.h5");
  const std::string page = page_of("study", rows);
  check_page(page);
  CHECK(page.find((scratch / "gone.h5").string() + ": error: is not there") != std::string::npos);
  CHECK(count_of(page, "Cycles of the worst wire</h3>") == 1);
}

TEST_CASE("report: the page stays small for long motions and large studies") {
  const Scratch scratch;
  SampleLife lengthy;
  lengthy.samples = 400'000;
  lengthy.lines = 3000;
  lengthy.segments = 10;
  const std::string page = page_of("long", read_ranking({job_with(scratch, "long", lengthy)}));
  check_page(page);
  CHECK(page.size() < largest_section);

  const JobResult one = job_with(scratch, "one", {});
  std::vector<JobResult> jobs;
  for (int k = 0; k < 200; ++k) jobs.push_back({fmt::format("job {:03}", k), one.life_file, ""});
  const std::string large = page_of("large", read_ranking(jobs));
  check_page(large);
  CHECK(count_of(large, "<section") == 40);
  CHECK(large.find("charts for the 20 best and the 20 worst of them") != std::string::npos);
  CHECK(large.find("job 100") != std::string::npos);  // it is still in the ranking
}

TEST_CASE("report: of thousands of rows the first hundred are laid out, the others wait in a template") {
  const Scratch scratch;
  const RankingRow row = read_ranking({job_with(scratch, "one", {})}).front();
  std::vector<RankingRow> rows(2000, row);
  for (std::size_t k = 0; k < rows.size(); ++k) rows[k].job = fmt::format("job {:04}", k);
  const std::string page = page_of("many", rows);
  check_page(page);
  const std::size_t waiting = page.find("<template");
  CHECK(count_of(page.substr(0, waiting), "<tr data-rank") == 100);
  CHECK(count_of(page.substr(waiting, page.find("</template>") - waiting), "<tr data-rank") == 1900);
  CHECK(page_of("few", {rows.begin(), rows.begin() + 100}).find("<template") == std::string::npos);
}

TEST_CASE("report: a study over two keys is a matrix of lives, numbers in their order, failures and warnings marked") {
  const Scratch scratch;
  const RankingRow row = read_ranking({job_with(scratch, "one", {})}).front();
  std::vector<RankingRow> rows;
  for (const char* length : {"length_m=1.2", "length_m=0.95", "length_m=10"})
    for (const char* motion : {"easy", "hard"}) {
      rows.push_back(row);
      rows.back().job = fmt::format("{}-{}", length, motion);
      rows.back().life_hours = 1000.0 * static_cast<double>(rows.size());
      rows.back().varied = {{"routing.length_m", length}, {"motion", motion}, {"fatigue.stress", "cyclic"}};
    }
  rows[1].failure = "too short";
  rows.erase(rows.begin() + 4);  // not all combinations of both keys
  const std::string page = page_of("two keys", rows);
  check_page(page);
  const std::size_t begin = page.find("<table id=\"matrix\">");
  REQUIRE(begin != std::string::npos);
  const std::string matrix = page.substr(begin, page.find("</table>", begin) - begin);
  CHECK(matrix.find("length_m=0.95") < matrix.find("length_m=1.2"));
  CHECK(matrix.find("length_m=1.2") < matrix.find("length_m=10"));
  CHECK(matrix.find("<th scope=\"col\">easy</th><th scope=\"col\">hard</th>") != std::string::npos);
  CHECK(matrix.find("<a href=\"#job-1\">1,000</a>") != std::string::npos);
  CHECK(matrix.find("#eb9146") != std::string::npos);  // the shortest life
  CHECK(matrix.find("#78b4dc") != std::string::npos);  // the longest life
  CHECK(count_of(matrix, "class=\"failed\"") == 1);
  CHECK(count_of(matrix, "<td>-</td>") == 1);
  CHECK(count_of(matrix, "</td>") == 6);
  CHECK(page_of("one key", {rows.begin(), rows.begin() + 1}).find("id=\"matrix\"") == std::string::npos);
}

TEST_CASE("report: the file is left untouched when nothing changed") {
  const Scratch scratch;
  const auto rows = read_ranking({job_with(scratch, "one", {})});
  write_report(scratch / "report.html", "study", rows);
  CHECK("<!DOCTYPE html>\n" + std::string(without_mark(bytes_of(scratch / "report.html"))) == page_of("study", rows));
  const auto long_ago = std::filesystem::last_write_time(scratch / "report.html") - std::chrono::hours(1);
  std::filesystem::last_write_time(scratch / "report.html", long_ago);
  write_report(scratch / "report.html", "study", rows);
  CHECK(std::filesystem::last_write_time(scratch / "report.html") == long_ago);
}

TEST_CASE("report: the summary of a life file holds the worst wire's cycles and its segment's damage") {
  const Scratch scratch;
  const SampleLife sample;
  write_sample_life(scratch / "a.h5", sample);
  const LifeSummary life = read_life(scratch / "a.h5");
  CHECK(life.cycles.size() == 240);
  double cycles = 0, rate = 0, runs = 0;
  for (const WorstCycle& cycle : life.cycles) cycles += cycle.damage;
  for (const double damage : life.damage_rate) rate += damage;
  for (const ProgramRun& run : program_runs(life)) runs += run.damage;
  constexpr double rounding = 1e-13;  // sums of some thousand doubles
  CHECK(cycles == Approx(1 / sample.repeats).epsilon(rounding));
  CHECK(rate == Approx(1 / sample.repeats).epsilon(rounding));
  CHECK(runs == Approx(1 / sample.repeats).epsilon(rounding));
}

TEST_CASE("report: charts of no damage and of no cycles are none") {
  LifeSummary life;
  life.segment_length = life.segment_damage = {0, 0, 0, 0};
  CHECK(segment_chart(life, 0).empty());
  CHECK(cycle_chart(life).empty());
  life.time = {0, 1}, life.strain = {0, 0};
  CHECK(strain_chart(life).empty());
}

TEST_CASE("report: damage that is much the same all along is said to be") {
  LifeSummary life;
  life.segment_length = {0.5, 0.5, 0.5, 0.5};
  life.segment_damage = {9e-6, 1e-5, 1e-6, 8.5e-6};
  CHECK(nearly_worst_share(life) == 0.75);
  life.segment_damage = {0, 0, 0, 0};
  CHECK(nearly_worst_share(life) == 0);
}

TEST_CASE("report: each fact of a job has the row's own number") {
  const Scratch scratch;
  SampleLife life;
  life.planned_hours = 44;
  write_sample_life(scratch / "planned.h5", life);
  std::vector<RankingRow> rows = read_ranking({{"planned", scratch / "planned.h5", ""}});
  CHECK(page_of("planned", rows).find("<b>44.0</b></td>") != std::string::npos);
  RankingRow& row = rows[0];
  row.scatter_hours = {51, 52, 53}, row.life_shares = "strength 60 %", row.failing_mode_share = 0.75;
  row.planned_months = 6, row.life_hours = 71, row.life_repeats = 7100, row.repeat_seconds = 36, row.life_months = 7;
  row.glued_hours = {11, 12, 13}, row.free_hours = {111, 112, 113};
  row.life_repeats_all_stick = 1400, row.life_repeats_all_free = 15000;
  row.estimates = "mass", row.hours_mean_stress_kept = 61, row.hours_without_mean_stress = 62;
  row.largest_force_share = 0.11, row.clamp_moment_share = 0.12, row.strain_relief_share = 0.13,
  row.loose_mesh_error = 0.014;
  row.first_wire_hours = {31, 32, 33}, row.conductor_hours = {41, 42, 43}, row.not_evaluated = "water hose";
  row.worst_shear_range = 0.015, row.worst_time = 16.5, row.worst_step = "weld";
  const std::string page = page_of("planned", rows);
  check_page(page);
  std::map<std::string, std::string> facts;
  const std::regex fact("<dt>([^<]*)</dt><dd>(.*)</dd>");
  for (std::sregex_iterator at(page.begin(), page.end(), fact), end; at != end; ++at)
    facts[(*at)[1]] = std::regex_replace((*at)[2].str(), std::regex("</?b>"), "");
  const std::string by_scatter = " of such dresspacks, by the scatter of wires alone",
                    glued = " if everything inside the cables were glued, ", free = " if it slipped without friction";
  for (
      const auto& [name, text] : std::map<std::string, std::string>{
          {"life",
           "44.0 h of motion = 6.00 months by the calendar until 10 % of such dresspacks have a conductor that has lost its share of wires at one place; "
           "66.0 h until half have, 110 h until 90 %; likeliest signal cable 3/conductor 2, 0.75 m from the tool"},
          {"worst wire",
           "71.0 h of motion = 7,100 repeats of 36.0 s = 7.00 months by the calendar, median of the worst wire"},
          {"by the scatter of wires alone",
           "by 51.0 h in 10 %, 52.0 h in half, 53.0 h in 90 % of such dresspacks, everything else with the job's own values"},
          {"its causes", "strength 60 %"},
          {"fails first",
           "wires of signal cable, in 75 % of the samples that fail, likeliest signal cable 3/conductor 2, 0.75 m from the tool"},
          {"bounds of 10 % failed", "11.0 h" + glued + "111 h" + free},
          {"bounds of half failed", "12.0 h" + glued + "112 h" + free},
          {"bounds of 90 % failed", "13.0 h" + glued + "113 h" + free},
          {"bounds of the worst wire", "14.0 h" + glued + "150 h" + free},
          {"ESTIMATE, not in the dresspack", "mass"},
          {"mean stress", "61.0 h if none of it relaxed, 62.0 h without any, median of the same wire"},
          {"forces of cables",
           "at most 0.11 of the force that breaks a cable; at the clamps 0.12 times the moment that the hose carries"},
          {"pull at clamps", "0.13 of what a strain relief of type A has to hold (EN 50262)"},
          {"mesh of loose cables", "discretisation error of their curvature: 1.4 % (a warning above 1 %)"},
          {"first broken wire", "by 31.0 h in 10 %, 32.0 h in half, 33.0 h in 90 %" + by_scatter},
          {"share of a conductor broken anywhere in it",
           "by 41.0 h in 10 %, 42.0 h in half, 43.0 h in 90 %" + by_scatter},
          {"not evaluated", "water hose"},
          {"breaks first", "signal cable 3/conductor 2/layer 1/wire 17 (its surface is sheared by 1.50 % to and fro)"},
          {"where", "segment 3 from the tool (0.12 m)"},
          {"when", "at 16.5 s, during 'weld'"}}) {
    INFO(name);
    CHECK(facts[name] == text);
  }
  row.strain_relief_share = 1.1, row.clamp_moment_share = 0.21;
  const std::string strained = page_of("planned", rows);
  for (const char* words :
       {"Check that the clamps hold the cables", "Above a fifth of either, the forces are unrealistic"})
    CHECK((page.find(words) == std::string::npos && strained.find(words) != std::string::npos));
  constexpr double infinite = std::numeric_limits<double>::infinity();
  row.planned_hours = row.first_wire_hours = {infinite, infinite, infinite}, row.conductor_hours[2] = infinite;
  row.free_hours = {1.1e4, infinite, infinite}, row.life_repeats_all_free = infinite;
  CHECK_THAT(page_of("planned", rows),
             Catch::Contains("<dd>in more than 90 % of the samples no conductor fails</dd>") &&
                 Catch::Contains("<dt>bounds of half failed</dt><dd>12.0 h" + glued + "never" + free) &&
                 Catch::Contains("<dt>bounds of the worst wire</dt><dd>14.0 h" + glued + "no damage" + free) &&
                 Catch::Contains("<dd>in fewer than 10 %" + by_scatter) &&
                 Catch::Contains("<dd>by 41.0 h in 10 %, 42.0 h in half" + by_scatter));
  const std::string from = "Paths in warnings are relative to the folder of this report, planned.";
  row.warnings = {{WarningKind::motion, "", "too fast"}, {WarningKind::program, "spot.mod:6", "skipped"}};
  CHECK_THAT(page_of("planned", rows), !Catch::Contains(from));
  row.warnings = {{WarningKind::motion, "one/job.yaml:4:3", "too fast"}};
  CHECK_THAT(page_of("planned", rows), Catch::Contains("one/job.yaml:4:3: too fast") && Catch::Contains(from));
}

}  // namespace

TEST_CASE("report: under what fails first stands the conductor that fails, not the worst wire of another cable") {
  const Scratch scratch;
  SampleLife life;
  life.planned_hours = 50;
  write_sample_life(scratch / "one.h5", life);
  std::vector<RankingRow> rows = read_ranking({{"one", scratch / "one.h5", ""}});
  rows[0].worst_component = "power cable 1/wire 7";
  const std::string page = page_of("places", rows);
  CHECK_THAT(
      page,
      Catch::Contains("wires of signal cable (75 %)<br>signal cable 3/conductor 2, 0.75 m from the tool</td><td><span "
                      "class=\"soft\">worst wire:</span> power cable 1/wire 7<br>") &&
          Catch::Contains(
              "wires of signal cable, in 75 % of the samples that fail, likeliest signal cable 3/conductor 2, 0.75 m from the tool"));
}

}  // namespace dresslife::pipeline
