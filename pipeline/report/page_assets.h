// Scripts and style of the pages, compiled from *.js and page.css of this folder.
#pragma once

#include <string_view>

namespace dresslife::pipeline {

std::string_view page_style();
std::string_view page_scripts();  ///< scripts of pages with a 3D view
std::string_view study_script();  ///< script of pages with a table

}  // namespace dresslife::pipeline
