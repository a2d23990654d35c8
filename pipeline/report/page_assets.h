// Scripts and style of the pages. They stand as *.js and page.css in this folder and are
// compiled in, so that a program carries its own.
#pragma once

#include <string_view>

namespace dresslife::pipeline {

std::string_view page_style();
std::string_view page_scripts();  ///< of pages with a 3D view
std::string_view study_script();  ///< of the page of a study

}  // namespace dresslife::pipeline
