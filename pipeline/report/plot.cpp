#include "pipeline/report/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/base/limits.h"
#include "pipeline/base/readable.h"

namespace dresslife::pipeline {
namespace {

constexpr double label_character = 6.6;  // upper bound of the average width of common sans serif fonts at 12 px
constexpr double close_to_tick = 1e-9;   // tolerance for rounding errors of the step, relative to the range

/// Returns the smallest step of 1, 2 or 5 times a power of ten that divides `span` into at most `most` steps.
double round_step(double span, int most) {
  const double raw = span / std::max(1, most);
  const double power = std::pow(10, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (raw <= factor * power * (1 + close_to_tick)) return factor * power;
  return 10 * power;
}

/// power: exponent of a common power of ten that is written behind the digits; 0: none.
std::string linear_label(double value, double step, int power) {
  if (std::abs(value) < step * close_to_tick) value = 0;
  if (power != 0 && value == 0) return "0";
  const double scale = std::pow(10, power);
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step / scale) + close_to_tick)));
  const std::string digits = grouped(fmt::format("{:.{}f}", value / scale, decimals));
  return power == 0 ? digits : digits + "·" + power_of_ten(power);
}

/// Returns the exponent for labels: 0 (digits only) from a thousandth to a million, else a power of ten that shortens them.
int power_of_labels(double low, double high) {
  const double largest = std::max(std::abs(low), std::abs(high));
  if (!(largest > 0) || !std::isfinite(largest)) return 0;
  const int exponent = static_cast<int>(std::floor(std::log10(largest) + close_to_tick));
  return exponent < -3 || exponent > 6 ? exponent : 0;
}

std::string logarithmic_label(int factor, int exponent) {
  if (exponent >= -3 && exponent <= 5)
    return grouped(fmt::format("{:.{}f}", factor * std::pow(10, exponent), std::max(0, -exponent)));
  return (factor == 1 ? "" : fmt::format("{}·", factor)) + power_of_ten(exponent);
}

std::vector<Tick> linear_ticks(double low, double high, int most) {
  const double step = round_step(high - low, most);
  constexpr double resolved = 1e12;  // number of steps from 0 beyond which a step is lost in the rounding of a double
  if (!(step > 0) || !std::isfinite(step) || !(std::max(std::abs(low), std::abs(high)) < resolved * step)) return {};
  const int power = power_of_labels(low, high);
  std::vector<Tick> ticks;
  for (double k = std::ceil(low / step - close_to_tick); k * step <= high + step * close_to_tick; ++k)
    ticks.push_back({k * step, linear_label(k * step, step, power)});
  return ticks;
}

std::vector<Tick> logarithmic_ticks(double low, double high, int most) {
  const double decades = std::log10(high) - std::log10(low);
  if (!(low > 0) || !std::isfinite(decades)) return {};
  const int every = std::max(1, static_cast<int>(std::ceil(decades / most)));
  const bool narrow = decades < 2.5;
  const bool room = decades < 0.4 * most;  // room between 1 and 2, the two closest labels
  std::vector<Tick> ticks;
  for (int exponent = static_cast<int>(std::floor(std::log10(low) - 1)); exponent <= std::log10(high) + 1; ++exponent)
    for (const int factor : {1, 2, 5}) {
      const double value = factor * std::pow(10, exponent);
      if (value < low * (1 - close_to_tick) || value > high * (1 + close_to_tick)) continue;
      const bool labelled = factor == 1 ? exponent % every == 0 : narrow && room;
      if (factor == 1 || narrow) ticks.push_back({value, labelled ? logarithmic_label(factor, exponent) : ""});
    }
  return ticks;
}

const char* anchor_word(Picture::Anchor anchor) {
  constexpr std::array words{"start", "middle", "end"};
  return words[static_cast<std::size_t>(anchor)];
}

std::string hinted(const std::string& element, const std::string& hint) {
  if (hint.empty()) return "<" + element + "/>\n";
  const std::string name = element.substr(0, element.find(' '));
  return fmt::format("<{}><title>{}</title></{}>\n", element, escaped(hint), name);
}

/// Returns a length with a tenth of a pixel, which is precise enough and keeps the page small.
std::string at(double length) { return short_decimal(length, 1); }

double share_of(const PlotAxis& axis, double value) {
  const double share = axis.logarithmic ? std::log(value / axis.low) / std::log(axis.high / axis.low)
                                        : (value - axis.low) / (axis.high - axis.low);
  const double inside = std::isnan(share) ? 0 : std::clamp(share, 0.0, 1.0);
  return axis.reversed ? 1 - inside : inside;
}

}  // namespace

std::string escaped(const std::string& text) {
  constexpr std::string_view special = "&<>\"'";
  constexpr std::array entities{"&amp;", "&lt;", "&gt;", "&quot;", "&#39;"};
  std::string out;
  for (const char letter : shown(text)) {
    const std::size_t at = special.find(letter);
    out += at == special.npos ? std::string(1, letter) : entities[at];
  }
  return out;
}

std::string power_of_ten(int exponent) {
  constexpr std::array digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "10⁻" : "10";
  for (const char digit : std::to_string(std::abs(exponent))) text += digits[static_cast<std::size_t>(digit - '0')];
  return text;
}

std::string printed(double value, int figures) {
  const std::string text = readable(value, figures);
  const std::size_t exponent = text.find("e");
  if (exponent == std::string::npos || !std::isfinite(value)) return text;
  return text.substr(0, exponent) + "·" + power_of_ten(std::stoi(text.substr(exponent + 1)));
}

std::string printed_life(double life) { return std::isinf(life) ? life_text(life) : printed(life); }

std::string printed_hours(double hours) { return std::isinf(hours) ? hours_text(hours) : printed(hours) + " h"; }

std::vector<Tick> PlotAxis::ticks(int most) const {
  return logarithmic ? logarithmic_ticks(low, high, most) : linear_ticks(low, high, most);
}

PlotAxis linear_axis(std::string title, double low, double high, int most_ticks) {
  if (!(high > low)) high = low + (low == 0 ? 1 : std::abs(low));
  const double step = round_step(high - low, most_ticks);
  return {std::move(title), step * std::floor(low / step + close_to_tick),
          step * std::ceil(high / step - close_to_tick), false};
}

PlotAxis decades_axis(std::string title, double low, double high) {
  double from = std::floor(std::log10(low) + close_to_tick), to = std::ceil(std::log10(high) - close_to_tick);
  if (to <= from) to = from + 1;
  return {std::move(title), std::pow(10, from), std::pow(10, to), true};
}

double text_width(const std::string& words) { return label_character * static_cast<double>(columns_of(words)); }

// ---- picture ----------------------------------------------------------------------------------------------

Picture::Picture(double width, double height, std::string title, std::string description)
    : width_(width), height_(height), title_(std::move(title)), description_(std::move(description)) {}

void Picture::line(double x1, double y1, double x2, double y2, const char* style) {
  body_ += fmt::format("<path class=\"{}\" d=\"M{} {}L{} {}\"/>\n", style, at(x1), at(y1), at(x2), at(y2));
}

void Picture::box(double x, double y, double width, double height, const char* style, const std::string& hint) {
  body_ += hinted(fmt::format("rect class=\"{}\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"", style, at(x), at(y),
                              at(std::max(0.0, width)), at(std::max(0.0, height))),
                  hint);
}

void Picture::dot(double x, double y, double radius, const char* style, const std::string& hint) {
  body_ +=
      hinted(fmt::format("circle class=\"{}\" cx=\"{}\" cy=\"{}\" r=\"{}\"", style, at(x), at(y), at(radius)), hint);
}

void Picture::curve(const std::vector<std::pair<double, double>>& points, const char* style) {
  if (points.empty()) return;
  std::string path;
  for (const auto& [x, y] : points) path += fmt::format("{}{} {}", path.empty() ? "M" : "L", at(x), at(y));
  body_ += fmt::format("<path class=\"{}\" d=\"{}\"/>\n", style, path);
}

void Picture::text(double x, double y, const std::string& words, const char* style, Anchor anchor, double most_width) {
  const std::string narrower = most_width > 0 && text_width(words) > most_width
                                   ? fmt::format(" textLength=\"{}\" lengthAdjust=\"spacingAndGlyphs\"", at(most_width))
                                   : "";
  body_ += fmt::format("<text class=\"{}\" x=\"{}\" y=\"{}\" text-anchor=\"{}\"{}>{}</text>\n", style, at(x), at(y),
                       anchor_word(anchor), narrower, escaped(words));
}

void Picture::upright_text(double x, double y, const std::string& words, const char* style) {
  body_ +=
      fmt::format("<text class=\"{}\" transform=\"translate({} {}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
                  style, at(x), at(y), escaped(words));
}

std::string Picture::svg() const {
  return fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\">\n<title>{}</title><desc>{}</desc>\n{}</svg>\n",
                     at(width_), at(height_), escaped(title_), escaped(description_), body_);
}

// ---- panel ------------------------------------------------------------------------------------------------

double Panel::across(double value) const { return left + width * share_of(x, value); }
double Panel::down(double value) const { return bottom() - height * share_of(y, value); }

void Panel::draw_axes(Picture& picture, bool with_x_labels) const {
  constexpr double x_spacing = 90, y_spacing = 32;  // distance between labels [px]
  double widest = 0;
  for (const Tick& tick : y.ticks(static_cast<int>(height / y_spacing))) {
    picture.line(left, down(tick.value), right(), down(tick.value), "grid");
    picture.text(left - 6, down(tick.value) + 4, tick.label, "tick", Picture::Anchor::end);
    widest = std::max(widest, text_width(tick.label));
  }
  picture.upright_text(left - 16 - widest, top + height / 2, y.title, "axis-title");
  for (const Tick& tick : x.ticks(static_cast<int>(width / x_spacing))) {
    picture.line(across(tick.value), bottom(), across(tick.value), bottom() + 4, "mark");
    if (with_x_labels) picture.text(across(tick.value), bottom() + 17, tick.label, "tick", Picture::Anchor::middle);
  }
  picture.line(left, bottom(), right(), bottom(), "mark");
  if (with_x_labels) picture.text(left + width / 2, bottom() + 36, x.title, "axis-title", Picture::Anchor::middle);
}

void Panel::draw_upright_grid(Picture& picture) const {
  for (const Tick& tick : x.ticks(8)) {
    picture.line(across(tick.value), top, across(tick.value), bottom(), "grid");
    picture.text(across(tick.value), bottom() + 17, tick.label, "tick", Picture::Anchor::middle);
  }
  picture.text(left + width / 2, bottom() + 36, x.title, "axis-title", Picture::Anchor::middle);
}

// ---- curves -----------------------------------------------------------------------------------------------

std::vector<std::pair<double, double>> thinned(const std::vector<double>& time, const std::vector<double>& value,
                                               std::size_t columns) {
  std::vector<std::pair<double, double>> points;
  const std::size_t samples = std::min(time.size(), value.size());
  if (samples <= 2 * columns) {
    for (std::size_t k = 0; k < samples; ++k) points.emplace_back(time[k], value[k]);
    return points;
  }
  for (std::size_t column = 0; column < columns; ++column) {
    const std::size_t first = column * samples / columns, last = (column + 1) * samples / columns;
    const auto [low, high] = std::minmax_element(value.begin() + first, value.begin() + last);
    const std::size_t a = std::min(low, high) - value.begin(), b = std::max(low, high) - value.begin();
    points.emplace_back(time[a], value[a]);
    if (b != a) points.emplace_back(time[b], value[b]);
  }
  return points;
}

}  // namespace dresslife::pipeline
