// Pictures of a plan, of a moment and of a motion: the positions of their lines, read back from the text.
#include <algorithm>
#include <cmath>
#include <regex>

#include "pipeline/base/statistics.h"
#include "pipeline/cable/stiffness.h"
#include "pipeline/files/motion_layout.h"
#include "pipeline/job/job.h"
#include "pipeline/report/bending_chart.h"
#include "pipeline/report/duty_page.h"
#include "pipeline/report/file_summary.h"
#include "pipeline/report/motion_data.h"
#include "pipeline/report/plan_page.h"
#include "pipeline/report/plot.h"
#include "pipeline/report/scene.h"
#include "pipeline/resolve/job_text.h"
#include "tests/catch.h"
#include "tests/pipeline/sample_job.h"
#include "tests/pipeline/sample_strain.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::pipeline {
namespace {

/// Returns the numbers of the path of this class.
std::vector<double> path_of(const std::string& page, const std::string& style) {
  const std::string begin = "<path class=\"" + style + "\" d=\"";
  const std::size_t at = page.find(begin);
  if (at == std::string::npos) return {};
  std::string path = page.substr(at + begin.size(), page.find('"', at + begin.size()) - at - begin.size());
  std::replace_if(
      path.begin(), path.end(), [](char c) { return c == 'M' || c == 'L'; }, ' ');
  std::istringstream in(path);
  std::vector<double> numbers;
  for (double number; in >> number;) numbers.push_back(number);
  return numbers;
}

/// Writes two samples of a straight hose along y: three segments of 0.2 m from y = 1 m; then shifted by 0.5 m along y.
void write_motion(const std::filesystem::path& name) {
  FileWriter file(name, motion_format());
  file.set_axis("segment", 3);
  file.set_axis("clamp", 2);
  file.append("/time", std::vector<double>{0, 1});
  file.append("/contact/max_depth", std::vector<double>(2));
  std::vector<double> centres, clamps, upright, turns;
  for (const double farther : {0.0, 0.5}) {
    for (const double y : {1.1, 1.3, 1.5}) centres.insert(centres.end(), {1, y + farther, 1});
    for (const double y : {1.0, 1.6}) clamps.insert(clamps.end(), {1, y + farther, 1});
    for (int i = 0; i < 3; ++i) turns.insert(turns.end(), {1, 0, 0, 0});
    for (int i = 0; i < 2; ++i) upright.insert(upright.end(), {1, 0, 0, 0});
  }
  file.append("/segment/position", centres);
  file.append("/segment/orientation", turns);
  file.append("/segment/length", std::vector<double>(3, 0.2));
  file.append("/clamp/position", clamps);
  file.append("/clamp/orientation", upright);
  for (const char* dataset : {"/program/step", "/contact/count"}) file.append(dataset, std::vector<std::int32_t>{0, 0});
  file.append("/program/text", std::vector<std::string>{"home"});
  file.append("/energy", std::vector<double>(6));
  file.append("/tension", std::vector<double>(6));
  file.attribute("job", sample_job);
  for (const char* attribute : {"history", "input_sha256"}) file.attribute(attribute, "");
  file.commit();
}

}  // namespace

TEST_CASE("pictures: a plan's failures are stairs, a step per week from today to the end") {
  Fleet fleet;
  Plan plan;
  plan.today = *day_from("2026-11-23");
  plan.end = plan.today + std::chrono::days(28);
  fleet.rows.push_back({{}, "robot 7", "day", plan.today, {}, 1, 10});
  plan.rows.resize(1);
  plan.rows[0].fails_in_week = {0, 0.002, 0.05, 0.5};
  plan.rows[0].fails_until_next = {0.5};
  plan.failures_in_week = {1, 2, 3, 2};
  plan.failures_in_week_without_windows = {1, 2, 4, 8};
  const std::string page = plan_page("line", fleet, plan, {}, "plan.csv");
  for (const auto& [style, heights] :
       {std::pair("curve", plan.failures_in_week), std::pair("curve-hot", plan.failures_in_week_without_windows)}) {
    const std::vector<double> path = path_of(page, style);
    REQUIRE(path.size() == 2 * 2 * heights.size());
    const double week = path[2] - path[0];
    CHECK(week > 0);
    const double unit = (path[1] - path[1 + 4]) / (heights[1] - heights[0]);  // length of one failure, upward
    constexpr double written = 0.2;                                           // coordinates have one decimal
    for (std::size_t k = 0; k < heights.size(); ++k)
      for (std::size_t end : {0, 1}) {
        const std::size_t at = 4 * k + 2 * end;
        CHECK(path[at] == Approx(path[0] + week * double(k + end)).margin(written * double(k + end + 1)));
        CHECK(path[at + 1] == Approx(path[1] - unit * (heights[k] - heights[0])).margin(written * heights[k]));
      }
  }
  // The row's cells: no colour, then one colour per factor of ten of probability.
  CHECK(count_of(page, "robot 7, 2026-11-23 ..") == 0);
  for (const auto& [style, day] :
       {std::pair("p2", "2026-11-30"), std::pair("p3", "2026-12-07"), std::pair("p4", "2026-12-14")})
    CHECK(
        std::regex_search(page, std::regex(fmt::format("class=\"{}\"[^\n]*\n?[^\n]*robot 7, {} \\.\\.", style, day))));
}

TEST_CASE("the page of a plan counts in a window the replacements of dresspacks that are put in later") {
  Fleet fleet;
  Plan plan;
  plan.today = *day_from("2026-11-23");
  plan.end = plan.today + std::chrono::days(28);
  plan.windows = {{plan.today + std::chrono::days(14), plan.today + std::chrono::days(15)}};
  fleet.rows.push_back({{}, "robot 7", "day", plan.today, {}, 1, 10});
  plan.rows.resize(1);
  plan.rows[0].fails_in_week = {0, 0.002, 0.05, 0.5};
  plan.rows[0].fails_until_next = {0.5};
  plan.failures_in_week = plan.failures_in_week_without_windows = {1, 2, 3, 2};
  plan.later_in_window = {15};
  std::string page = plan_page("line", fleet, plan, {}, "plan.csv");
  CHECK(page.find("<td class=\"number\">0</td><td class=\"number\">15</td><td>none of today's dresspacks</td>") !=
        std::string::npos);
  plan.later_in_window = {0};
  page = plan_page("line", fleet, plan, {}, "plan.csv");
  CHECK(page.find("<td class=\"number\">0</td><td class=\"number\">0</td><td>nothing to replace</td>") !=
        std::string::npos);
}

TEST_CASE("pictures: each program of a duty has its own name and its own bars") {
  DutyResult duty;
  duty.name = "shift", duty.robot_life_hours = 40000;
  duty.parts = {{"easy", 30, 0.8, {}, {}, {{0, {5e4, 9e4}}, {1, {2e4, 4e4}}}},
                {"hard", 10, 0.2, {}, {}, {{0, {5e4, 9e4}}, {1, {1e3, 2e3}}}}};
  duty.modes = {"wires"}, duty.changes = {1}, duty.damage.same_place = {1};
  duty.lives.share = {0.25, 0.75};
  duty.lives.percentiles = {1e4, 2e4};
  std::string chart = duty_page("duties.yaml", {duty}, "duty.csv");
  const std::size_t begin = chart.find("Share of the time and of the damage");
  REQUIRE(begin != std::string::npos);
  chart = chart.substr(begin, chart.find("</svg>", begin) - begin);
  std::vector<std::string> names;
  const std::regex name("<text class=\"name\"[^>]*>([^<]*)</text>");
  for (std::sregex_iterator at(chart.begin(), chart.end(), name), end; at != end; ++at) names.push_back((*at)[1]);
  CHECK(names == std::vector<std::string>{"easy", "hard"});
  const auto widths = [&](const std::string& style) {
    std::vector<double> found;
    const std::regex box("<rect class=\"" + style + "\"[^>]* width=\"([^\"]*)\"");
    for (std::sregex_iterator at(chart.begin(), chart.end(), box), end; at != end; ++at)
      found.push_back(std::stod((*at)[1]));
    return found;
  };
  const std::vector<double> times = widths("dark"), damages = widths("bar-hot");  // the first width is the legend's
  REQUIRE(times.size() == 3);
  REQUIRE(damages.size() == 3);
  constexpr double printed = 0.01;  // coordinates have one decimal of a pixel
  CHECK(times[1] / times[2] == Approx(0.8 / 0.2).epsilon(printed));
  CHECK(damages[1] / damages[2] == Approx(0.25 / 0.75).epsilon(printed));
}

TEST_CASE("a file's summary has its numbers as they are") {
  const Scratch scratch;
  write_motion(scratch / "motion.h5");
  const std::string text = file_summary(scratch / "motion.h5");
  INFO(text);
  CHECK(std::regex_search(text, std::regex("\n/segment/length +\\(segment 3\\) 0\\.2(0)*  m\n")));
  CHECK(std::regex_search(text, std::regex("\n/segment/position +\\(sample 2, segment 3, 3\\) 1 \\.\\. 2  m\n")));
}

TEST_CASE("pictures: of a scene's hose one segment is hot, counted from the tool") {
  const Scratch scratch;
  write_motion(scratch / "motion.h5");
  const std::regex hot("<line class=\"hose-hot\" x1=\"([0-9.]+)\"");
  double before = HUGE_VAL;
  for (const int from_tool : {1, 2, 3}) {
    const std::string picture = scene_picture(scratch / "motion.h5", 0, from_tool);
    CHECK(count_of(picture, "class=\"hose-hot\"") == 2);  // half a segment per sample
    CHECK(count_of(picture, "class=\"hose\"") == 4);
    std::smatch found;
    REQUIRE(std::regex_search(picture, found, hot));
    CHECK(std::abs(std::stod(found[1])) != before);  // each at a different place
    before = std::stod(found[1]);
  }
  CHECK(count_of(scene_picture(scratch / "motion.h5", 0, 0), "hose-hot") == 0);
}

TEST_CASE("pictures: a motion's data have each sample's own positions") {
  const Scratch scratch;
  write_motion(scratch / "motion.h5");
  const std::string text = motion_data(FileReader(scratch / "motion.h5", motion_format()), nullptr,
                                       setup_from(parse_yaml(sample_job, "job.yaml")))
                               .text;
  // x and z are 1 m. y is between the clamps: 1 .. 1.6 m, then 0.5 m more.
  CHECK_THAT(text, Catch::Contains(R"("keys":2)") && Catch::Contains(R"("samples":2)"));
  CHECK_THAT(text, Catch::Contains(R"("points":{"begin":0,"size":15,"low":1,"high":2.1,)"));
  CHECK_THAT(text, Catch::Contains(R"("places":[0,0.5,1.5,2.5,3])"));
}

TEST_CASE("pictures: a bending cable's loop is its first bend doubled, from end to end of the largest curvature") {
  const Scratch scratch;
  const std::string text = edited(
      edited(edited(edited(sample_job, "stiffness_Nm2: 5", "stiffness_Nm2: 0.01"), "slip: [stick, free]",
                    "slip: friction"),
             "lay_angle_deg: 25", "lay_angle_deg: 15"),
      "diameter_mm: 60",
      "diameter_mm: 60\n  inner_diameter_mm: 52\n  bending_friction: [{stiffness_Nm2: 0.02, slides_at_1_per_m: 0.25}]");
  const Dresspack dresspack = job_from(parse_yaml(text, "job.yaml")).dresspacks[0].dresspack;
  for (const double own : {0.0, 0.7}) {
    write_sample_strain(scratch / "strain.h5", text, 0.5, own);
    const std::string chart = bending_chart(scratch / "strain.h5", 0);
    const std::vector<double> loop = path_of(chart, "curve-hot"), first = path_of(chart, "curve"),
                              simulated = path_of(chart, "leader");
    REQUIRE(loop.size() == 2 * 242);
    REQUIRE(first.size() == 2 * 121);
    REQUIRE(simulated.size() == 2 * 121);
    constexpr double pixel = 0.1;  // places are written to it
    const PlotAxis axis = linear_axis("", -0.5, 0.5, 9);
    const double half = chart_panel * 0.5 / (axis.high - axis.low), x = first[0], y = first[1],
                 most = bending_moments(dresspack, 1, {0.5})[0], end = y - first[241];
    CHECK(x == Approx(chart_left + chart_panel / 2).margin(pixel));
    REQUIRE(end > 50);  // else the rounding hides the curves
    for (std::size_t k = 0; k <= 120; ++k) {
      const double share = double(k) / 120, curvature = 0.5 * share;
      CHECK(first[2 * k] == Approx(x + half * share).margin(pixel));
      CHECK(y - first[2 * k + 1] ==
            Approx(end * bending_moments(dresspack, 1, {curvature})[0] / most).margin(2 * pixel));
      // What the hose's own friction holds ends at 0.25 1/m.
      CHECK(simulated[2 * k] == Approx(first[2 * k]).margin(pixel));
      const double modelled = elastic_bending_stiffness(dresspack) * curvature + 0.02 * std::min(curvature, 0.25);
      CHECK(y - simulated[2 * k + 1] == Approx(end * modelled / most).margin(2 * pixel));
      CHECK(loop[2 * k] == Approx(x - half + 2 * half * share).margin(pixel));
      CHECK(y - loop[2 * k + 1] == Approx(2 * (y - first[2 * k + 1]) - end).margin(4 * pixel));
      CHECK(loop[2 * (121 + k)] == Approx(2 * x - loop[2 * k]).margin(2 * pixel));
      CHECK(loop[2 * (121 + k) + 1] == Approx(2 * y - loop[2 * k + 1]).margin(2 * pixel));
    }
    // In words, of the hose and of the cable: the friction's deciles are the parameter's.
    const std::regex words(
        "friction ([0-9.e-]+) N m \\(10 \\.\\. 90 %: ([0-9.e-]+) \\.\\. ([0-9.e-]+)\\); largest curvature ([0-9.]+) 1/m");
    std::vector<double> largest;
    for (std::sregex_iterator at(chart.begin(), chart.end(), words), none; at != none; ++at) {
      const UncertainParameter& friction = uncertain_parameters()[index_of(Uncertain::friction_inside)];
      constexpr double digits = 0.012;  // three of each number
      CHECK(std::stod((*at)[2]) / std::stod((*at)[1]) ==
            Approx(friction.value(-1.28155) / friction.value(0)).epsilon(digits));
      CHECK(std::stod((*at)[3]) / std::stod((*at)[1]) ==
            Approx(friction.value(1.28155) / friction.value(0)).epsilon(digits));
      largest.push_back(std::stod((*at)[4]));
    }
    CHECK(largest == std::vector<double>{0.5, own > 0 ? own : 0.5});
    CHECK((chart.find("cable (bent as the hose): E I") != std::string::npos) == (own == 0));
  }
}

}  // namespace dresslife::pipeline
