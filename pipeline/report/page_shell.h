// An HTML file that needs nothing else: style, scripts and data in it, and three.js, which draws its 3D view,
// as the Debian package libjs-three has installed it. Without that package the page says how to get it and
// shows the rest.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace dresslife::pipeline {

/// Folder of three.min.js: where Debian installs it, or what the environment variable DRESSLIFE_THREE names.
std::filesystem::path three_folder();

/// Text that changes when style, scripts or the installed three.js do.
std::string shell_digest();

/// title: plain text; made_from: a digest that made_from_of() finds again; body: HTML; data: JSON (json.h).
std::string whole_page(const std::string& title, const std::string& made_from, const std::string& body,
                       const std::string& data);

/// Of a page that whole_page() made and that holds what was written; empty: there is none, it was not, or it was
/// changed. Errors: those of PlainFile.
std::string made_from_of(const std::filesystem::path& page);

/// A page of whole_page() with a change.
std::string changed_page(std::string_view page, const std::function<void(std::string&)>& change);

}  // namespace dresslife::pipeline
