#include "pipeline/report/plot.h"

#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "tests/catch.h"

namespace dresslife::pipeline {
namespace {

std::vector<std::string> labels(const std::vector<Tick>& ticks) {
  std::vector<std::string> words;
  for (const Tick& tick : ticks)
    if (!tick.label.empty()) words.push_back(tick.label);
  return words;
}
using Words = std::vector<std::string>;

TEST_CASE("plot: linear ticks stand at round values") {
  CHECK(labels(PlotAxis{"", 0, 1}.ticks(5)) == Words{"0.0", "0.2", "0.4", "0.6", "0.8", "1.0"});
  CHECK(labels(PlotAxis{"", 0, 180}.ticks(9)) == Words{"0", "20", "40", "60", "80", "100", "120", "140", "160", "180"});
  CHECK(labels(PlotAxis{"", 0, 40000}.ticks(4)) == Words{"0", "10,000", "20,000", "30,000", "40,000"});
  CHECK(labels(PlotAxis{"", -0.003, 0.0025}.ticks(6)) ==
        Words{"-0.003", "-0.002", "-0.001", "0.000", "0.001", "0.002"});
  CHECK(labels(PlotAxis{"", 0, 1.5e-5}.ticks(4)) == Words{"0", "0.5·10⁻⁵", "1.0·10⁻⁵", "1.5·10⁻⁵"});
  CHECK(labels(PlotAxis{"", 0, 3e7}.ticks(3)) == Words{"0", "1·10⁷", "2·10⁷", "3·10⁷"});
  CHECK(labels(PlotAxis{"", 3.1, 3.9}.ticks(3)) == Words{"3.5"});
}

TEST_CASE("plot: logarithmic ticks are decades, with 2 and 5 between them where there is room") {
  CHECK(labels(PlotAxis{"", 1, 1e4, true}.ticks(8)) == Words{"1", "10", "100", "1,000", "10,000"});
  CHECK(labels(PlotAxis{"", 0.02, 1, true}.ticks(8)) == Words{"0.02", "0.05", "0.1", "0.2", "0.5", "1"});
  CHECK(labels(PlotAxis{"", 1e-12, 1e-6, true}.ticks(3)) == Words{"10⁻¹²", "10⁻¹⁰", "10⁻⁸", "10⁻⁶"});
  CHECK(labels(PlotAxis{"", 2e-6, 6e-6, true}.ticks(3)) == Words{"2·10⁻⁶", "5·10⁻⁶"});
  CHECK(power_of_ten(12) == "10¹²");
  CHECK(power_of_ten(-305) == "10⁻³⁰⁵");
}

TEST_CASE("plot: ranges that a double cannot divide have no ticks, and end") {
  constexpr double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [low, high] : std::vector<std::pair<double, double>>{
           {0, 0}, {1, 1}, {nan, 1}, {0, nan}, {-1e308, 1e308}, {0, inf}, {1e9, 1e9 * (1 + 1e-15)}, {1, 0}}) {
    INFO(low << " .. " << high);
    CHECK(PlotAxis{"", low, high}.ticks(6).empty());
  }
  for (const auto& [low, high] : std::vector<std::pair<double, double>>{{0, 1}, {-1, 1}, {nan, 1}, {1, inf}}) {
    INFO(low << " .. " << high);
    CHECK(PlotAxis{"", low, high, true}.ticks(6).empty());
  }
}

TEST_CASE("plot: axes made for values hold them and end at ticks") {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int trial = 0; trial < 2000; ++trial) {
    const double scale = std::pow(10, 8 * uniform(random)), a = scale * uniform(random),
                 b = a + scale * std::abs(uniform(random));
    const PlotAxis axis = linear_axis("", a, b);
    const double rounding = 1e-9 * (axis.high - axis.low);
    CHECK(axis.low <= a + rounding);
    CHECK(axis.high >= b - rounding);
    CHECK(axis.high - axis.low <= 3 * (b - a) + rounding);  // at most two steps more
    const auto ticks = axis.ticks(6);
    CHECK(ticks.size() >= 2);
    CHECK(ticks.size() <= 9);
  }
  CHECK(linear_axis("", 5, 5).high > 5);
  CHECK(linear_axis("", 0, 0).high == 1);
  CHECK(decades_axis("", 0.02, 300).low == Approx(0.01));
  CHECK(decades_axis("", 0.02, 300).high == Approx(1000));
  CHECK(decades_axis("", 10, 10).high > 10);
}

TEST_CASE("plot: labels along an axis never overlap") {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int trial = 0; trial < 3000; ++trial) {
    const double scale = std::pow(10, 14 * uniform(random) - 7);
    PlotAxis axis = linear_axis("", scale * (uniform(random) - 0.5), scale);
    if (trial % 2) axis = PlotAxis{"", scale, scale * std::pow(10, 0.5 + 12 * uniform(random)), true};
    const Panel panel{0, 0, 300 + 600 * uniform(random), 100, axis, {}};
    double last_end = -INFINITY;
    for (const Tick& tick : axis.ticks(static_cast<int>(panel.width / 90))) {
      if (tick.label.empty()) continue;
      const double begin = panel.across(tick.value) - text_width(tick.label) / 2;
      INFO(axis.low << " .. " << axis.high << " on " << panel.width << ": " << tick.label);
      CHECK(begin > last_end);
      last_end = begin + text_width(tick.label);
    }
  }
}

TEST_CASE("plot: a panel maps its axes to its edges, and keeps to them") {
  Panel panel{10, 20, 100, 50, {"", 0, 2}, {"", 1, 100, true}};
  CHECK(panel.across(0) == 10);
  CHECK(panel.across(1) == 60);
  CHECK(panel.across(5) == 110);
  CHECK(panel.down(1) == 70);
  CHECK(panel.down(10) == Approx(45));
  CHECK(panel.down(1e9) == 20);
  CHECK(panel.down(0) == 70);
  CHECK(panel.down(INFINITY) == 20);
  CHECK(std::isfinite(panel.down(NAN)));
  panel.x.reversed = true;
  CHECK(panel.across(0.5) == 85);
}

TEST_CASE("plot: a thinned history keeps every extreme within its column") {
  std::vector<double> time, value;
  std::mt19937 random(6);
  for (int k = 0; k < 100000; ++k) {
    time.push_back(0.01 * k);
    value.push_back(static_cast<double>(random()) / 4294967296.0);
  }
  value[70003] = 9;
  value[123] = -9;
  const auto points = thinned(time, value, 800);
  CHECK(points.size() <= 1600);
  CHECK(std::count(points.begin(), points.end(), std::pair{time[70003], 9.0}) == 1);
  CHECK(std::count(points.begin(), points.end(), std::pair{time[123], -9.0}) == 1);
  CHECK(std::is_sorted(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.first < b.first; }));
  CHECK(thinned({0, 1, 2}, {5, 6, 7}, 800).size() == 3);
  CHECK(thinned({}, {}, 800).empty());
}

TEST_CASE("plot: text is harmless in a page") {
  CHECK(escaped("<a href=\"x\">R&D's</a>") == "&lt;a href=&quot;x&quot;&gt;R&amp;D&#39;s&lt;/a&gt;");
  CHECK(escaped("Käfig 5 µm") == "Käfig 5 µm");
  CHECK(escaped(std::string("a\0b\x1b", 4)) == "a\\x00b\\x1b");
}

TEST_CASE("plot: numbers are printed with powers of ten") {
  CHECK(printed(1.5e-7) == "1.50·10⁻⁷");
  CHECK(printed(12345) == "12,300");
  CHECK(printed(INFINITY) == "unlimited");
}

TEST_CASE("plot: a picture is SVG with a title for who cannot see it") {
  Picture picture(100, 50, "A & B", "what it shows");
  picture.line(0, 0, 10.04, 5, "grid");
  picture.box(1, 2, 3, -4, "bar", "hint <1>");
  picture.curve({{0, 0}, {1.26, 2}}, "curve");
  picture.text(5, 6, "a<b", "tick", Picture::Anchor::middle);
  CHECK(picture.svg() ==
        "<svg viewBox=\"0 0 100 50\" role=\"img\">\n<title>A &amp; B</title><desc>what it shows</desc>\n"
        "<path class=\"grid\" d=\"M0 0L10 5\"/>\n"
        "<rect class=\"bar\" x=\"1\" y=\"2\" width=\"3\" height=\"0\"><title>hint &lt;1&gt;</title></rect>\n"
        "<path class=\"curve\" d=\"M0 0L1.3 2\"/>\n"
        "<text class=\"tick\" x=\"5\" y=\"6\" text-anchor=\"middle\">a&lt;b</text>\n</svg>\n");
}

}  // namespace
}  // namespace dresslife::pipeline
