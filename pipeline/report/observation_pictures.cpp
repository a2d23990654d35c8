#include "pipeline/report/observation_pictures.h"

#include <fmt/format.h>

#include <algorithm>

#include "pipeline/base/readable.h"
#include "pipeline/report/plot.h"

namespace dresslife::pipeline {
namespace {

constexpr double row_height = 26, first_row = 44, names = 170, below = 52;
constexpr double least_life = 1e2, most_life = 1e14;  // shown lives; a bar beyond them ends at the edge
constexpr const char* arrows = "dot: observed; arrow to the right: at least, to the left: at most";

constexpr const char* rows_style = R"(<style>
svg { font: 12px sans-serif; background: #fff }
.grid { stroke: #e2e2e2; fill: none } .tick, .axis-title, .name { fill: #333 } .axis-title { font-weight: bold }
.before { fill: #c9d3de } .after { fill: #5b8dc0 } .median { stroke: #1b3f66; stroke-width: 2; fill: none }
.bounds { stroke: #b9c7d6; stroke-width: 2; fill: none } .range { fill: #7fa6cc }
.observed { fill: #111 } .arrow { stroke: #111; stroke-width: 1.5; fill: none }
.miss { fill: #b3261e; font-weight: bold } .agrees { fill: #2e6b2e } .open { fill: #666 }
</style>
)";

/// Rows on one axis, each with a name, bars, marks and text.
class Rows {
 public:
  Rows(Picture& picture, double from_top, std::size_t rows, double width, PlotAxis axis)
      : picture_(picture), panel_{names, from_top, width, row_height * static_cast<double>(rows), std::move(axis), {}} {
    panel_.draw_upright_grid(picture_);
  }

  void begin(const std::string& name) {
    y_ = panel_.top + row_height * (static_cast<double>(rows_++) + 0.5);
    picture_.text(names - 8, y_ + 4, name, "name", Picture::Anchor::end, names - 12);
  }
  void bar(double low, double high, double height, const char* kind) {
    const double from = panel_.across(low);
    picture_.box(from, y_ - height / 2, std::max(2.0, panel_.across(high) - from), height, kind);
  }
  void line(double low, double high, const char* kind) {
    picture_.line(panel_.across(low), y_, panel_.across(high), y_, kind);
  }
  void median(double value) { picture_.line(panel_.across(value), y_ - 7, panel_.across(value), y_ + 7, "median"); }
  void words(const std::string& text, const char* kind) { picture_.text(panel_.right() + 8, y_ + 4, text, kind); }

  /// Draws one observed life. Rows with service records, which have many lives, have text only.
  void observed(const Observation& observation) {
    if (!observation.service.empty()) return;
    const double at = panel_.across(observation.cycles ? *observation.cycles : *observation.hours);
    if (observation.outcome != ObservedEnd::broken) {
      const double way = bounds_below(observation.outcome) ? 16 : -16, end = at + way;
      picture_.line(at, y_, end, y_, "arrow");
      for (const double side : {-4, 4}) picture_.line(end, y_, end - way / 4, y_ + side, "arrow");
    }
    picture_.dot(at, y_, 4.5, "observed");
  }

 private:
  Picture& picture_;
  Panel panel_;
  std::size_t rows_ = 0;
  double y_ = 0;
};

std::string as_file(const Picture& picture) {
  std::string text = picture.svg();
  text.insert(text.find('>'), fmt::format(" xmlns=\"http://www.w3.org/2000/svg\" width=\"{:.0f}\"", picture.width()));
  return text.insert(text.find('>') + 1, std::string("\n") + rows_style);
}

/// Returns the deciles of a parameter as values of z, so that all priors have the same picture.
PredictedDeciles in_deviations(const UncertainParameter& parameter, const PredictedDeciles& key) {
  return {parameter.z_of(key[0]), parameter.z_of(key[1]), parameter.z_of(key[2])};
}

void add_before_and_after(Rows& rows, const PredictedDeciles& before, const PredictedDeciles* after,
                          const std::string& words) {
  rows.bar(before[0], before[2], 16, "before");
  if (after) rows.bar((*after)[0], (*after)[2], 8, "after"), rows.median((*after)[1]);
  rows.words(words, "open");
}

}  // namespace

std::string validation_picture(const ValidationStudy& validation, const std::vector<RankingRow>& rows) {
  constexpr double width = 560, verdicts = 190;
  const std::size_t count = validation.observations.size();
  Picture picture(names + width + verdicts, first_row + row_height * static_cast<double>(count) + below,
                  "Predicted and observed lives", "One line per observation: range of predictions, and what was seen");
  Rows lines(picture, first_row, count, width, decades_axis("life [cycles of the test]", least_life, most_life));
  picture.text(
      names, 18,
      "bar: predicted, 10 .. 90 % over all that is not known; lines in it: medians of the variants; thin: all glued .. all "
      "free inside",
      "tick");
  picture.text(names, 34, arrows, "tick");
  for (const Observation& observation : validation.observations) {
    const Prediction prediction = predicted(observation, validation.study, rows);
    lines.begin(observation.name);
    if (prediction.failed > 0) {
      lines.words("not computed", "open");
      continue;
    }
    lines.line(prediction.stuck, prediction.free, "bounds");
    lines.bar(prediction.low, prediction.high, 12, "range");
    for (const double median : {prediction.shortest, prediction.median, prediction.longest}) lines.median(median);
    lines.observed(observation);
    const Judgement judgement = judged(observation, prediction);
    lines.words(words_of(judgement), judgement.agreement == Agreement::agrees ? "agrees"
                                     : judgement.agreement == Agreement::open ? "open"
                                                                              : "miss");
  }
  return as_file(picture);
}

std::string calibration_picture(const Learned& learned) {
  constexpr double width = 460, results = 250;
  const auto tests = static_cast<std::size_t>(
      std::ranges::count_if(learned.tests, [](const LearnedTest& test) { return test.observation.is_life(); }));
  const double second = first_row + row_height * static_cast<double>(uncertain_count) + 78;
  Picture picture(names + width + results, second + row_height * static_cast<double>(tests) + below,
                  "What observations have taught", "Parameters, and lives predicted, before and after");
  picture.text(names, 18, "wide bars: range before (8 of 10 cases); narrow: after, with its middle value", "tick");
  Rows parameters(picture, first_row, uncertain_count, width,
                  {"parameter [standard deviations of its range before]", -4, 4});
  for (std::size_t p = 0; p < uncertain_count; ++p) {
    const UncertainParameter& parameter = uncertain_parameters()[p];
    const LearnedAxis& axis = learned.axes[p];
    const PredictedDeciles after = in_deviations(parameter, axis.after);
    parameters.begin(std::string(parameter.name));
    add_before_and_after(parameters, in_deviations(parameter, axis.before), axis.learned ? &after : nullptr,
                         axis.learned ? fmt::format("{} ({} .. {})", readable(axis.after[1]), readable(axis.after[0]),
                                                    readable(axis.after[2]))
                                      : std::string(why_not_learned(axis)));
  }
  if (tests == 0) return as_file(picture);
  picture.text(names, second - 10, arrows, "tick");
  Rows lives(picture, second, tests, width,
             decades_axis("life of one specimen [cycles of the test, or hours]", least_life, most_life));
  for (const LearnedTest& test : learned.tests) {
    if (!test.observation.is_life()) continue;
    lives.begin(test.observation.name);
    add_before_and_after(lives, test.before, &test.after, observed_text(test.observation));
    lives.observed(test.observation);
  }
  return as_file(picture);
}

}  // namespace dresslife::pipeline
