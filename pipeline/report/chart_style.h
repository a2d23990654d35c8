// Style of charts: colours and rules of the classes of life_charts, scene and plot. A page contains them once for all
// of its charts; a single chart contains them itself.
#pragma once

#include <string>

namespace dresslife::pipeline {

/// Rules for a page's style sheet, with colours for light and dark readers.
std::string chart_style();

/// A chart in a page, in a size with legible text; a picture without text, which shrinks with the page.
std::string chart_in_page(const std::string& svg);
std::string picture_in_page(const std::string& svg);

/// A chart, "<svg viewBox=...", as a separate file: in light colours and with a background.
std::string standalone(const std::string& chart);

/// A file of SVG as the bytes of a PNG, by rsvg-convert. Errors: InputError if it fails or is not installed, with its
/// package.
std::string png_of(const std::string& svg);

}  // namespace dresslife::pipeline
