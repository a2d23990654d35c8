// Tables and charts of a life, read back from the page: every number against the same number of a random life, computed here.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <regex>

#include "pipeline/report/damage_tables.h"
#include "pipeline/report/life_charts.h"
#include "pipeline/report/plot.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

using namespace dresslife::pipeline;

namespace {

constexpr double pixel = 0.11;  // places are written to a tenth of a pixel

using Strings = std::vector<std::string>;
using Numbers = std::vector<double>;

/// All matches of an expression: its groups.
std::vector<Strings> found(const std::string& text, const std::string& expression) {
  std::vector<Strings> all;
  const std::regex regex(expression);
  for (std::sregex_iterator at(text.begin(), text.end(), regex), end; at != end; ++at)
    all.emplace_back(at->begin() + 1, at->end());
  return all;
}

/// Cells of the table below a heading, without their tags.
std::vector<Strings> table_of(const std::string& page, const std::string& heading) {
  const std::size_t begin = page.find("<tbody>", page.find("<h3>" + heading));
  REQUIRE(begin != std::string::npos);
  std::vector<Strings> rows;
  for (const Strings& row : found(page.substr(begin, page.find("</tbody>", begin) - begin), "<tr>(.*?)</tr>")) {
    rows.emplace_back();
    for (const Strings& cell : found(row[0], "<td[^>]*>(.*?)</td>"))
      rows.back().push_back(replaced_all(std::regex_replace(cell[0], std::regex("<[^>]*>"), ""), "&nbsp;", " "));
  }
  return rows;
}

struct Box {
  double x, y, width, height;
  std::string hint;
};
std::vector<Box> boxes(const std::string& picture, const std::string& styles) {
  std::vector<Box> all;
  const std::string number = "=\"([-0-9.]+)\"";
  for (const Strings& of : found(picture, "<rect class=\"(?:" + styles + ")\" x" + number + " y" + number + " width" +
                                              number + " height" + number + "><title>([^<]*)</title>"))
    all.push_back({std::stod(of[0]), std::stod(of[1]), std::stod(of[2]), std::stod(of[3]), of[4]});
  return all;
}

std::vector<std::pair<double, double>> points(const std::string& picture, const std::string& style) {
  std::vector<std::pair<double, double>> all;
  for (const Strings& path : found(picture, "<path class=\"" + style + "\" d=\"([^\"]*)\""))
    for (const Strings& of : found(path[0], "[ML]([-0-9.]+) ([-0-9.]+)"))
      all.emplace_back(std::stod(of[0]), std::stod(of[1]));
  return all;
}

double sum(const Numbers& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

/// Indices of the values above 0, the largest value first.
std::vector<std::size_t> order_of(const Numbers& values) {
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (values[k] > 0) order.push_back(k);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] > values[b]; });
  return order;
}

struct Run {
  int line;
  double begin, end, damage;
};

/// A program of 14 lines that runs through them in any order, with damage over several decades.
struct Case {
  LifeSummary life;
  std::vector<Run> runs;
  RankingRow row;

  explicit Case(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform;
    const auto some = [&](std::size_t count, double decades, double none) {
      Numbers values(count);
      for (double& value : values) value = uniform(random) < none ? 0 : 1e-5 * std::pow(10, -decades * uniform(random));
      return values;
    };
    int line = 0;
    for (std::size_t k = 0; k < 300; ++k) {
      if (uniform(random) < 0.08) line = int(15 * uniform(random)) - 1;
      const double now = 3 + 0.1 * double(k), rate = uniform(random) < 0.8 ? 0 : uniform(random) * 1e-6;
      life.time.push_back(now), life.step.push_back(line), life.damage_rate.push_back(rate),
          life.strain.push_back(0.004 * uniform(random) - 0.001);
      if (!runs.empty()) runs.back().end = now;
      if (runs.empty() || runs.back().line != line) runs.push_back({line, now, now, 0});
      runs.back().damage += rate;
    }
    for (int k = 0; k < 14; ++k) life.step_text.push_back("move " + std::to_string(k));
    life.step_damage = some(14, 4, 0.2), life.step_opened = some(14, 4, 0.2);
    life.cause = {"joint_1", "joint_2", "joint_3", "carrying"};
    life.cause_damage = {3e-6, 0, -1e-6, 5e-7}, life.explained = seed % 2 ? 0.75 : 0.85;
    for (int k = 0; k < 14; ++k) {
      Numbers share{uniform(random), 0.3 * uniform(random), -0.2};
      share.push_back(1 - sum(share));
      for (const double of : share) life.line_cause_damage.push_back(of * life.step_damage[std::size_t(k)]);
    }
    for (int k = 0; k < 15; ++k) life.layer.push_back("layer " + std::to_string(k));
    life.layer_damage = some(15, 3, 0.1);
    for (int k = 0; k < 9; ++k) life.segment_length.push_back(0.1 + 0.1 * uniform(random));
    life.segment_damage = some(9, seed % 2 ? 1 : 5, 0.1);
    for (int k = 0; k < 60; ++k)
      life.cycles.push_back({0.02 * std::pow(10, -2 * uniform(random)), k % 3 ? 1 : 0.5, 1e-7 * uniform(random)});
    row.repeat_seconds = 40;
  }
  const Run* costliest(int line) const {
    const Run* most = nullptr;
    for (const Run& run : runs)
      if (run.line == line && (!most || run.damage > most->damage)) most = &run;
    return most;
  }
};

std::string percent(double share) { return fmt::format("{:.1f} %", 100 * share); }

}  // namespace

TEST_CASE("life numbers: every cell of the tables of lines, joints and layers, and the lengths of their bars") {
  for (const unsigned seed : {1u, 2u, 3u, 4u}) {
    const Case of(seed);
    const LifeSummary& life = of.life;
    const std::string page = damage_tables(life, of.row);
    std::vector<double> bars;
    std::vector<Strings> expected;
    Numbers damage(14);
    for (std::size_t k = 0; k < 14; ++k) damage[k] = (life.step_damage[k] + life.step_opened[k]) / 2;
    for (const std::size_t line : order_of(damage)) {
      if (expected.size() == 10 || damage[line] < 5e-4 * sum(damage)) break;  // 0.1 % when rounded
      const Run* const run = of.costliest(int(line));
      Strings causes;
      const Numbers shares(life.line_cause_damage.begin() + std::ptrdiff_t(4 * line),
                           life.line_cause_damage.begin() + std::ptrdiff_t(4 * line + 4));
      for (const std::size_t cause : order_of(shares))
        if (causes.size() < 2 && (causes.empty() || shares[cause] >= 0.1 * life.step_damage[line]))
          causes.push_back(fmt::format("{} {:.0f} %", life.cause[cause], 100 * shares[cause] / life.step_damage[line]));
      expected.push_back(
          {std::to_string(line + 1), "move " + std::to_string(line),
           std::to_string(
               std::count_if(of.runs.begin(), of.runs.end(), [&](const Run& one) { return one.line == int(line); })),
           run ? fmt::format("{:.1f} .. {:.1f} s", run->begin, run->end) : "", percent(damage[line] / sum(damage)),
           percent(life.step_opened[line] / sum(damage)), percent(life.step_damage[line] / sum(damage)),
           causes.empty() ? "" : causes[0] + (causes.size() > 1 ? ", " + causes[1] : ""), printed(damage[line])});
      bars.push_back(damage[line] / *std::max_element(damage.begin(), damage.end()));
    }
    CHECK(table_of(page, "Program lines that cost most") == expected);
    // Of 2.5e-6 in all.
    CHECK(table_of(page, "What moved while the damage was done") ==
          std::vector<Strings>{{"joint_1", "120.0 %"},
                               {"joint_3", "-40.0 %: moves against the others, relieves"},
                               {"carrying: gravity, swinging, and what the joints do not explain", "20.0 %"}});
    CHECK((page.find("the shares are rough") != std::string::npos) == (life.explained < 0.8));
    bars.insert(bars.end(), {1, 5e-7 / 3e-6});
    std::vector<Strings> layers;
    for (const std::size_t layer : order_of(life.layer_damage))
      if (layers.size() < 12)
        layers.push_back({life.layer[layer], printed(40 / life.layer_damage[layer] / 3600),
                          printed(1 / life.layer_damage[layer]), printed(life.layer_damage[layer])});
    CHECK(table_of(page, "Life by layer of wires") == layers);
    const std::vector<Strings> widths = found(page, "style=\"width:([0-9.]+)%\"");
    REQUIRE(widths.size() == bars.size());
    for (std::size_t k = 0; k < bars.size(); ++k) CHECK(std::stod(widths[k][0]) == Approx(100 * bars[k]).margin(0.051));
  }
}

TEST_CASE("life numbers: the strain over time, the program below it and the damage so far stand where they belong") {
  for (const unsigned seed : {1u, 2u, 3u, 4u}) {
    const Case of(seed);
    const LifeSummary& life = of.life;
    const std::string chart = strain_chart(life);
    const double seconds = life.time.back() - life.time.front(), all = sum(life.damage_rate);
    const auto across = [&](double now) { return chart_left + chart_panel * (now - life.time.front()) / seconds; };
    const std::vector<Box> cells = boxes(chart, "costly|dark|light");
    REQUIRE(cells.size() == of.runs.size());  // a sample is 3 px wide
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const Run& run = of.runs[k];
      CHECK(cells[k].x == Approx(across(run.begin)).margin(pixel));
      CHECK(cells[k].width == Approx(std::max(0.5, across(run.end) - across(run.begin))).margin(pixel));
      CHECK(cells[k].hint == fmt::format("{:.1f} .. {:.1f} s, line {}: {}; {} of the damage", run.begin, run.end,
                                         run.line + 1,
                                         run.line < 0 ? "no program line" : "move " + std::to_string(run.line),
                                         percent(run.damage / all)));
    }
    CHECK(boxes(chart, "costly").size() ==
          std::size_t(
              std::count_if(of.runs.begin(), of.runs.end(), [&](const Run& run) { return run.damage >= 0.03 * all; })));
    // Every sample is a point of the curve, higher by as much as its strain is.
    const auto curve = points(chart, "curve");
    REQUIRE(curve.size() == life.strain.size());
    const auto low = std::size_t(std::min_element(life.strain.begin(), life.strain.end()) - life.strain.begin()),
               high = std::size_t(std::max_element(life.strain.begin(), life.strain.end()) - life.strain.begin());
    for (std::size_t k = 0; k < curve.size(); ++k) {
      CHECK(curve[k].first == Approx(across(life.time[k])).margin(pixel));
      const double share = (life.strain[k] - life.strain[low]) / (life.strain[high] - life.strain[low]);
      CHECK(curve[k].second ==
            Approx(curve[low].second + share * (curve[high].second - curve[low].second)).margin(2 * pixel));
    }
    // A stair from the first sample's share to 100 %, which is 76 px higher than nothing.
    const auto stair = points(chart, "curve-hot");
    std::vector<std::pair<double, double>> steps;
    double so_far = 0;
    for (std::size_t k = 0; k < life.time.size(); ++k) {
      so_far += life.damage_rate[k] / all;
      if (k != 0 && k + 1 != life.time.size() && life.damage_rate[k] == 0) continue;
      if (k != 0) steps.emplace_back(across(life.time[k]), steps.back().second);
      steps.emplace_back(across(life.time[k]), so_far);
    }
    REQUIRE(stair.size() == steps.size());
    for (std::size_t k = 0; k < stair.size(); ++k) {
      CHECK(stair[k].first == Approx(steps[k].first).margin(pixel));
      CHECK(stair[k].second == Approx(stair.back().second + 76 * (1 - steps[k].second)).margin(2 * pixel));
    }
    // The four costliest lines of at least 3 % are named at the middle of their costliest run.
    std::map<double, std::string> named;
    std::size_t labels = 0;
    for (const std::size_t line : order_of(life.step_damage))
      if (const Run* const run = of.costliest(int(line));
          run && labels < 4 && life.step_damage[line] > 0.03 * sum(life.step_damage)) {
        ++labels;
        const std::string words = fmt::format("{:.0f} %: line {}, move {}",
                                              100 * life.step_damage[line] / sum(life.step_damage), line + 1, line);
        const std::vector<Strings> at = found(chart, "<text class=\"note\" x=\"([0-9.]+)\"[^>]*>" + words + "</text>");
        REQUIRE(at.size() == 1);
        CHECK(std::abs(std::stod(at[0][0]) - across((run->begin + run->end) / 2)) == Approx(5).margin(pixel));
      }
    CHECK(count_of(chart, "%: line ") == labels);
  }
}

TEST_CASE(
    "life numbers: bars along the dresspack and over the strain range are as wide and as high as what they show") {
  for (const unsigned seed : {1u, 2u, 3u, 4u}) {
    const Case of(seed);
    const LifeSummary& life = of.life;
    const std::vector<std::size_t> order = order_of(life.segment_damage);
    const int worst = 9 - int(order.front());
    const std::string along = segment_chart(life, worst);
    const std::vector<Box> bars = boxes(along, "bar|bar-hot");
    REQUIRE(bars.size() == order.size());
    CHECK(boxes(along, "bar-hot")[0].hint.starts_with(fmt::format("segment {} from", worst)));
    const bool decades = life.segment_damage[order.front()] > 30 * life.segment_damage[order.back()];
    const auto height = [&](std::size_t segment) {
      return decades ? std::log10(life.segment_damage[segment]) : life.segment_damage[segment];
    };
    std::size_t bar = 0, tallest = 0, lowest = 0;
    double from = 0;
    std::vector<std::size_t> shown;
    for (std::size_t k = 0; k < 9; from += life.segment_length[k++]) {
      if (!(life.segment_damage[k] > 0)) continue;
      const double scale = chart_panel / sum(life.segment_length), width = scale * life.segment_length[k];
      CHECK(bars[bar].x == Approx(chart_left + scale * from + 1).margin(pixel));
      CHECK(bars[bar].width == Approx(width - 2).margin(pixel));
      CHECK(bars[bar].hint == fmt::format("segment {} from the tool: damage {} per repeat, life {} repeats", 9 - k,
                                          printed(life.segment_damage[k]), printed(1 / life.segment_damage[k])));
      if (k == order.front()) tallest = bar;
      if (k == order.back()) lowest = bar;
      shown.push_back(k), ++bar;
    }
    for (std::size_t k = 0; k < bars.size(); ++k) {
      const double none = decades ? height(order.back()) : 0,
                   bottom = decades ? bars[lowest].height : 0;  // of linear bars the foot is 0
      const double share = (height(shown[k]) - none) / (height(order.front()) - none);
      CHECK(bars[k].height == Approx(bottom + share * (bars[tallest].height - bottom)).margin(3 * pixel));
      CHECK(bars[k].y + bars[k].height == Approx(26 + 180).margin(2 * pixel));
    }
    CHECK(bars[tallest].height >
          90);  // an axis ends within twice its largest value, or within a decade of at least two

    std::map<int, std::array<double, 2>> bins;  // tenths of decades of a range in %: cycles, damage
    double total = 0, count = 0;
    for (const WorstCycle& cycle : life.cycles) {
      auto& bin = bins[int(std::floor(10 * std::log10(100 * cycle.range)))];
      bin[0] += cycle.count, bin[1] += cycle.damage, total += cycle.damage, count += cycle.count;
    }
    const std::string chart = cycle_chart(life);
    CHECK(chart.find(printed(count) + " cycles per repeat.") != std::string::npos);
    const std::vector<Box> counts = boxes(chart, "bar"), shares = boxes(chart, "bar-hot");
    REQUIRE(counts.size() == bins.size());
    REQUIRE(shares.size() == bins.size());
    const int first = bins.begin()->first, past = bins.rbegin()->first + 1;
    REQUIRE(past - first > 10);  // so the axis ends with the bins
    std::size_t k = 0;
    for (const auto& [bin, of_bin] : bins) {
      const std::string hint =
          fmt::format("range {} .. {} %: {} cycles, {} % of the damage", printed(std::pow(10, bin / 10.0)),
                      printed(std::pow(10, (bin + 1) / 10.0)), printed(of_bin[0]), printed(100 * of_bin[1] / total));
      const double x = chart_left + chart_panel * (bin - first) / (past - first) + 0.5,
                   width = chart_panel / (past - first) - 1;
      const auto& largest = *std::max_element(bins.begin(), bins.end(),
                                              [](const auto& a, const auto& b) { return a.second[1] < b.second[1]; });
      const auto place_of_largest = std::size_t(std::distance(bins.begin(), bins.find(largest.first)));
      for (const Box& box : {counts[k], shares[k]}) {
        CHECK(box.hint == hint);
        CHECK(box.x == Approx(x).margin(pixel));
        CHECK(box.width == Approx(width).margin(pixel));
      }
      CHECK(shares[k].height ==
            Approx(shares[place_of_largest].height * of_bin[1] / largest.second[1]).margin(2 * pixel));
      CHECK(shares[k].y + shares[k].height == Approx(10 + 130 + 16 + 130).margin(2 * pixel));
      CHECK(counts[k].y + counts[k].height == Approx(10 + 130).margin(2 * pixel));
      ++k;
    }
  }
}
