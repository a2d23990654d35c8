#include "pipeline/report/validation_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/base/readable.h"
#include "pipeline/report/plot.h"

namespace dresslife::pipeline {
namespace {

constexpr double row_height = 26, top = 44, left = 170, plot_width = 560, verdicts = 190;
constexpr double least = 1e2, most = 1e14;  // lives that are shown; beyond, a line ends at the edge

constexpr const char* rows_style = R"(<style>
svg { font: 12px sans-serif; background: #fff }
.grid { stroke: #e2e2e2; fill: none } .mark { stroke: #444; fill: none }
.tick, .axis-title, .name { fill: #333 } .axis-title { font-weight: bold }
.bounds { stroke: #b9c7d6; stroke-width: 2; fill: none } .range { fill: #7fa6cc } .median { stroke: #1b4f82; stroke-width: 2; fill: none }
.observed { fill: #111 } .arrow { stroke: #111; stroke-width: 1.5; fill: none }
.miss { fill: #b3261e; font-weight: bold } .agrees { fill: #2e6b2e } .open { fill: #666 }
</style>
)";

double shown_life(double life) { return std::isnan(life) ? least : std::clamp(life, least, most); }

class Rows {
 public:
  explicit Rows(std::size_t count)
      : picture_(left + plot_width + verdicts, top + row_height * static_cast<double>(count) + 52,
                 "Predicted and observed lives",
                 "One line per observation: range of predictions, and what was seen"),
        panel_{left, top, plot_width, row_height * static_cast<double>(count), {}, {}} {
    panel_.x = decades_axis("life [cycles of the test]", least, most);
  }

  void axis() {
    for (const Tick& tick : panel_.x.ticks(8)) {
      picture_.line(panel_.across(tick.value), top, panel_.across(tick.value), panel_.bottom(), "grid");
      picture_.text(panel_.across(tick.value), panel_.bottom() + 17, tick.label, "tick",
                    Picture::Anchor::middle);
    }
    picture_.text(left + plot_width / 2, panel_.bottom() + 38, panel_.x.title, "axis-title",
                  Picture::Anchor::middle);
    picture_.text(
        left, 18,
        "bar: predicted, 10 .. 90 % over all that is not known; lines in it: medians of the variants; thin: all "
        "glued .. all free inside",
        "tick");
    picture_.text(left, 34, "dot: observed; arrow to the right: at least, to the left: at most", "tick");
  }

  void add(const Observation& observation, const Prediction& prediction) {
    const double y = top + row_height * (static_cast<double>(rows_++) + 0.5);
    picture_.text(left - 8, y + 4, observation.name, "name", Picture::Anchor::end);
    if (prediction.failed > 0) {
      picture_.text(left + plot_width + 8, y + 4, "not computed", "open");
      return;
    }
    const auto at = [&](double life) { return panel_.across(shown_life(life)); };
    picture_.line(at(prediction.stuck), y, at(prediction.free), y, "bounds");
    picture_.box(at(prediction.low), y - 6, std::max(2.0, at(prediction.high) - at(prediction.low)), 12,
                 "range");
    for (const double median : {prediction.shortest, prediction.median, prediction.longest})
      picture_.line(at(median), y - 7, at(median), y + 7, "median");
    const double life = observation.cycles ? *observation.cycles : *observation.hours;
    if (observation.outcome != ObservedEnd::broken) {
      const double way = bounds_below(observation.outcome) ? 16 : -16, end = at(life) + way;
      picture_.line(at(life), y, end, y, "arrow");
      picture_.line(end, y, end - way / 4, y - 4, "arrow");
      picture_.line(end, y, end - way / 4, y + 4, "arrow");
    }
    picture_.dot(at(life), y, 4.5, "observed");
    const Judgement judgement = judged(observation, prediction);
    const char* kind = judgement.agreement == Agreement::agrees ? "agrees"
                       : judgement.agreement == Agreement::open ? "open"
                                                                : "miss";
    picture_.text(left + plot_width + 8, y + 4, words_of(judgement), kind);
  }

  std::string svg() const {
    std::string text = picture_.svg();
    const std::size_t open = text.find('>');
    text.insert(open,
                fmt::format(" xmlns=\"http://www.w3.org/2000/svg\" width=\"{:.0f}\"", picture_.width()));
    return text.insert(text.find('>') + 1, std::string("\n") + rows_style);
  }

 private:
  Picture picture_;
  Panel panel_;
  std::size_t rows_ = 0;
};

}  // namespace

std::string validation_picture(const ValidationStudy& validation, const std::vector<RankingRow>& rows) {
  Rows lines(validation.observations.size());
  lines.axis();
  for (const Observation& observation : validation.observations)
    lines.add(observation, predicted(observation, validation.study, rows));
  return lines.svg();
}

}  // namespace dresslife::pipeline
