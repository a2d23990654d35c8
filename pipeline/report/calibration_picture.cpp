#include "pipeline/report/calibration_picture.h"

#include <fmt/format.h>

#include <algorithm>

#include "pipeline/base/readable.h"
#include "pipeline/report/plot.h"

namespace dresslife::pipeline {
namespace {

constexpr double bar_height = 26, bars_top = 44, bars_left = 170, bars_width = 460, words_width = 250;
constexpr double least_life = 1e2, most_life = 1e14;  // that are shown; beyond, a bar ends at the edge

constexpr const char* bars_style = R"(<style>
svg { font: 12px sans-serif; background: #fff }
.grid { stroke: #e2e2e2; fill: none } .tick, .axis-title, .name { fill: #333 } .axis-title { font-weight: bold }
.before { fill: #c9d3de } .after { fill: #5b8dc0 } .median { stroke: #1b3f66; stroke-width: 2; fill: none }
.observed { fill: #111 } .arrow { stroke: #111; stroke-width: 1.5; fill: none } .open { fill: #666 }
</style>
)";

/// Rows of two bars, the wide one before, the narrow one after, on one axis.
class Bars {
 public:
  Bars(Picture& picture, double from_top, std::size_t rows, PlotAxis axis)
      : picture_(picture), panel_{bars_left, from_top, bars_width, bar_height * static_cast<double>(rows),
                                  {},   {}} {
    panel_.x = std::move(axis);
    for (const Tick& tick : panel_.x.ticks(8)) {
      picture_.line(panel_.across(tick.value), panel_.top, panel_.across(tick.value), panel_.bottom(),
                    "grid");
      picture_.text(panel_.across(tick.value), panel_.bottom() + 17, tick.label, "tick",
                    Picture::Anchor::middle);
    }
    picture_.text(bars_left + bars_width / 2, panel_.bottom() + 36, panel_.x.title, "axis-title",
                  Picture::Anchor::middle);
  }

  /// Returns the middle of the row, from the top.
  double add(const std::string& name, const PredictedDeciles& before, const PredictedDeciles* after,
             const std::string& words) {
    const double y = panel_.top + bar_height * (static_cast<double>(rows_++) + 0.5);
    picture_.text(bars_left - 8, y + 4, name, "name", Picture::Anchor::end, bars_left - 12);
    bar(y, 16, before, "before");
    if (after) {
      bar(y, 8, *after, "after");
      picture_.line(across((*after)[1]), y - 7, across((*after)[1]), y + 7, "median");
    }
    picture_.text(bars_left + bars_width + 10, y + 4, words, "open");
    return y;
  }
  double across(double value) const { return panel_.across(std::clamp(value, panel_.x.low, panel_.x.high)); }
  double bottom() const { return panel_.bottom(); }

 private:
  void bar(double y, double height, const PredictedDeciles& of, const char* kind) {
    picture_.box(across(of[0]), y - height / 2, std::max(2.0, across(of[2]) - across(of[0])), height, kind);
  }

  Picture& picture_;
  Panel panel_;
  std::size_t rows_ = 0;
};

/// Many lives have words only.
void add_seen(Picture& picture, const Bars& bars, double y, const Observation& observation) {
  if (!observation.service.empty()) return;
  const double at = bars.across(observation.cycles ? *observation.cycles : *observation.hours);
  if (observation.outcome != ObservedEnd::broken) {
    const double way = bounds_below(observation.outcome) ? 16 : -16, end = at + way;
    picture.line(at, y, end, y, "arrow");
    picture.line(end, y, end - way / 4, y - 4, "arrow");
    picture.line(end, y, end - way / 4, y + 4, "arrow");
  }
  picture.dot(at, y, 4.5, "observed");
}

/// Parameters on an axis of z, so that all priors look alike.
PredictedDeciles in_deviations(const UncertainParameter& parameter, const PredictedDeciles& key) {
  return {parameter.z_of(key[0]), parameter.z_of(key[1]), parameter.z_of(key[2])};
}

}  // namespace

std::string calibration_picture(const Learned& learned) {
  const auto tests = static_cast<std::size_t>(
      std::count_if(learned.tests.begin(), learned.tests.end(),
                    [](const LearnedTest& test) { return test.observation.is_life(); }));
  const double second = bars_top + bar_height * static_cast<double>(uncertain_count) + 78;
  Picture picture(bars_left + bars_width + words_width, second + bar_height * static_cast<double>(tests) + 48,
                  "What observations have taught", "Parameters, and lives predicted, before and after");
  picture.text(bars_left, 18, "wide bars: range before (8 of 10 cases); narrow: after, with its middle value",
               "tick");
  PlotAxis deviations;
  deviations.title = "parameter [standard deviations of its range before]";
  deviations.low = -4, deviations.high = 4;
  Bars parameters(picture, bars_top, uncertain_count, deviations);
  for (std::size_t p = 0; p < uncertain_count; ++p) {
    const UncertainParameter& parameter = uncertain_parameters()[p];
    const LearnedAxis& axis = learned.axes[p];
    const PredictedDeciles before = in_deviations(parameter, axis.before),
                   after = in_deviations(parameter, axis.after);
    parameters.add(std::string(parameter.name), before, axis.learned ? &after : nullptr,
                   axis.learned ? fmt::format("{} ({} .. {})", readable(axis.after[1]),
                                              readable(axis.after[0]), readable(axis.after[2]))
                                : std::string(why_not_learned(axis)));
  }
  if (tests > 0) {
    picture.text(bars_left, second - 10, "dot: observed; arrow to the right: at least, to the left: at most",
                 "tick");
    Bars lives(picture, second, tests,
               decades_axis("life of one specimen [cycles of the test, or hours]", least_life, most_life));
    for (const LearnedTest& test : learned.tests)
      if (test.observation.is_life())
        add_seen(picture, lives,
                 lives.add(test.observation.name, test.before, &test.after, observed_text(test.observation)),
                 test.observation);
  }
  std::string text = picture.svg();
  text.insert(text.find('>'),
              fmt::format(" xmlns=\"http://www.w3.org/2000/svg\" width=\"{:.0f}\"", picture.width()));
  return text.insert(text.find('>') + 1, std::string("\n") + bars_style);
}

}  // namespace dresslife::pipeline
