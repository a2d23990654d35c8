// An HTML file that needs nothing else: style, scripts and data in it, and three.js, which draws its 3D view,
// as the Debian package libjs-three has installed it. Without that package the page says how to get it and
// shows the rest.
#pragma once

#include <filesystem>
#include <string>

namespace dresslife::pipeline {

/// Folder of three.min.js: where Debian installs it, or what the environment variable DRESSLIFE_THREE names.
std::filesystem::path three_folder();

/// Text that changes when style, scripts or the installed three.js do.
std::string shell_digest();

/// title: plain text; made_from: a digest that made_from_of() finds again; body: HTML; data: JSON (json.h).
std::string whole_page(const std::string& title, const std::string& made_from, const std::string& body,
                       const std::string& data);

/// Of a page that whole_page() made; empty: there is none, or it was not.
std::string made_from_of(const std::filesystem::path& page);

}  // namespace dresslife::pipeline
