// Charts as inline SVG: axes, ticks, lines and bars. Classes of the page define colours and fonts, so that a chart
// follows the reader's light or dark scheme. Lengths are in units of the picture, about one pixel each.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace dresslife::pipeline {

/// Size of a chart with the width of a page, and margins for the text of its axes [px].
constexpr double chart_width = 960, chart_left = 78, chart_panel = chart_width - chart_left - 14, x_axis_height = 44;

/// Returns text escaped for HTML text and quoted attributes.
std::string escaped(const std::string& text);

/// Returns 10^exponent as text: "10⁻⁶".
std::string power_of_ten(int exponent);

/// Returns readable() in the notation of pages: "4.56·10¹²" instead of "4.56e+12".
std::string printed(double value, int figures = 3);
/// Return life_text() and hours_text() in the notation of pages.
std::string printed_life(double life);
std::string printed_hours(double hours);

struct Tick {
  double value;
  std::string label;  ///< empty: a tick mark without label
};

/// One axis of a chart, in the unit of its title. Preconditions: low < high; 0 < low if logarithmic.
struct PlotAxis {
  std::string title;
  double low = 0, high = 1;
  bool logarithmic = false;
  bool reversed = false;  ///< the high value is at the left or bottom end

  /// Returns ticks at round values, at most about `most` of them with a label.
  std::vector<Tick> ticks(int most) const;
};

/// Returns an axis from 0 (or below) to the round value above `high`.
PlotAxis linear_axis(std::string title, double low, double high, int most_ticks = 6);

/// Returns an axis over whole decades around [low, high].
PlotAxis decades_axis(std::string title, double low, double high);

/// A picture under construction.
class Picture {
 public:
  /// title, description: texts for screen readers.
  Picture(double width, double height, std::string title, std::string description);

  enum class Anchor { start, middle, end };
  void line(double x1, double y1, double x2, double y2, const char* style);
  /// hint: shown when the pointer rests on the box.
  void box(double x, double y, double width, double height, const char* style, const std::string& hint = "");
  void dot(double x, double y, double radius, const char* style, const std::string& hint = "");
  void curve(const std::vector<std::pair<double, double>>& points, const char* style);
  /// most_width: longer text is drawn with narrower letters; 0: no limit.
  void text(double x, double y, const std::string& words, const char* style, Anchor anchor = Anchor::start,
            double most_width = 0);
  void upright_text(double x, double y, const std::string& words,
                    const char* style);  ///< text that reads upwards, centred at (x, y)

  double width() const { return width_; }
  std::string svg() const;

 private:
  double width_, height_;
  std::string title_, description_, body_;
};

/// Returns an upper bound of a text's width at the font size of the charts' labels.
double text_width(const std::string& words);

/// A rectangle of a picture with a scale along each side.
struct Panel {
  double left, top, width, height;
  PlotAxis x, y;

  double across(double value) const;  ///< position in the picture of a value of x, clamped to the panel
  double down(double value) const;    ///< position in the picture of a value of y, clamped to the panel
  double bottom() const { return top + height; }
  double right() const { return left + width; }

  /// Draws grid, tick marks, labels and titles of both axes.
  void draw_axes(Picture& picture, bool with_x_labels = true) const;
  /// Draws only the axis along x: lines over the whole height at its ticks, labels and title below.
  void draw_upright_grid(Picture& picture) const;
};

/// Returns the extremes of a history in each of `columns` equal intervals, in the order of time: the same curve at that width,
/// with at most two points per column.
std::vector<std::pair<double, double>> thinned(const std::vector<double>& time, const std::vector<double>& value,
                                               std::size_t columns);

}  // namespace dresslife::pipeline
