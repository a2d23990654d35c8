// Style of charts: colours and rules of the classes of life_charts, scene and plot. A page contains these rules once for all
// of its charts; a single chart file contains its own copy.
#pragma once

#include <string>

namespace dresslife::pipeline {

/// Returns rules for a page's style sheet, with colours for the light and the dark scheme.
std::string chart_style();

/// Return a chart for a page, in a size with legible text; and a picture without text, which shrinks with the page.
std::string chart_in_page(const std::string& svg);
std::string picture_in_page(const std::string& svg);

/// Returns a chart, "<svg viewBox=...", as a separate file in light colours with a background.
std::string standalone(const std::string& chart);

/// Returns an SVG file as the bytes of a PNG, made with rsvg-convert. Errors: InputError if the program fails or is not
/// installed; the message names its package.
std::string png_of(const std::string& svg);

}  // namespace dresslife::pipeline
