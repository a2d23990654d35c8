// How charts look: the colours and rules of the classes in which life_charts, scene and plot draw. A page
// holds them once for all of its charts; a chart by itself brings them along.
#pragma once

#include <string>

namespace dresslife::pipeline {

/// Rules for a page's style sheet, with colours for light and dark readers.
std::string chart_style();

/// A chart in a page, at a size at which its words can be read; a picture without words to read, which
/// shrinks with the page.
std::string chart_in_page(const std::string& svg);
std::string picture_in_page(const std::string& svg);

/// A chart, "<svg viewBox=...", as a file of its own: in the light colours, which all programs that show SVG
/// understand, on their ground.
std::string standalone(const std::string& chart);

/// A file of SVG as the bytes of a PNG, drawn by rsvg-convert. Errors: InputError with the package that
/// brings it when it is not there, or when it fails.
std::string png_of(const std::string& svg);

}  // namespace dresslife::pipeline
