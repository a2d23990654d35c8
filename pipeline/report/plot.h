// Charts as inline SVG: axes, ticks, lines and bars. Classes of the page define colours and fonts, so that a chart
// follows the reader's light or dark scheme. Lengths are in units of the picture, about one pixel each.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace dresslife::pipeline {

/// The size of a chart over the width of a page, with room for the words of its axes [px].
constexpr double chart_width = 960, chart_left = 78, chart_panel = chart_width - chart_left - 14, x_axis_height = 44;

/// Text escaped for HTML text and quoted attributes.
std::string escaped(const std::string& text);

/// 10^exponent as text: "10⁻⁶".
std::string power_of_ten(int exponent);

/// readable() as pages write it: "4.56·10¹²" instead of "4.56e+12".
std::string printed(double value, int figures = 3);
/// life_text() and hours_text() as pages write them.
std::string printed_life(double life);
std::string printed_hours(double hours);

struct Tick {
  double value;
  std::string label;  ///< empty: a mark only
};

/// One axis of a chart, in the unit of its title. Precondition: low < high; 0 < low when logarithmic.
struct PlotAxis {
  std::string title;
  double low = 0, high = 1;
  bool logarithmic = false;
  bool reversed = false;  ///< high at the left or bottom end

  /// At round values, at most about `most` of them with a label.
  std::vector<Tick> ticks(int most) const;
};

/// An axis from 0 (or below) to the round value above `high`.
PlotAxis linear_axis(std::string title, double low, double high, int most_ticks = 6);

/// An axis over whole decades around [low, high].
PlotAxis decades_axis(std::string title, double low, double high);

/// A picture under construction.
class Picture {
 public:
  /// title, description: for screen readers.
  Picture(double width, double height, std::string title, std::string description);

  enum class Anchor { start, middle, end };
  void line(double x1, double y1, double x2, double y2, const char* style);
  /// hint: shown when the pointer rests on it.
  void box(double x, double y, double width, double height, const char* style, const std::string& hint = "");
  void dot(double x, double y, double radius, const char* style, const std::string& hint = "");
  void curve(const std::vector<std::pair<double, double>>& points, const char* style);
  /// most_width: longer text is drawn narrower, not cut; 0: no limit.
  void text(double x, double y, const std::string& words, const char* style, Anchor anchor = Anchor::start,
            double most_width = 0);
  void upright_text(double x, double y, const std::string& words,
                    const char* style);  ///< reads upwards, centred

  double width() const { return width_; }
  std::string svg() const;

 private:
  double width_, height_;
  std::string title_, description_, body_;
};

/// Upper bound of a text's width at the size of the charts' labels.
double text_width(const std::string& words);

/// A rectangle of a picture with a scale along each side.
struct Panel {
  double left, top, width, height;
  PlotAxis x, y;

  double across(double value) const;  ///< from x to the picture, clamped to the panel
  double down(double value) const;    ///< from y to the picture, clamped to the panel
  double bottom() const { return top + height; }
  double right() const { return left + width; }

  /// Grid, tick marks, labels and titles of both axes.
  void draw_axes(Picture& picture, bool with_x_labels = true) const;
  /// Of the axis along x alone: lines over the whole height at its ticks, labels and title below.
  void draw_upright_grid(Picture& picture) const;
};

/// The extremes of each of `columns` equal intervals of a history, in their order: the same curve at that width with at
/// most two points per column.
std::vector<std::pair<double, double>> thinned(const std::vector<double>& time,
                                               const std::vector<double>& value, std::size_t columns);

}  // namespace dresslife::pipeline
