// A complete HTML file with style, scripts, data and three.js (from the Debian package libjs-three) for the 3D view.
// Without that package the page names it and shows the rest.
#pragma once

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>

namespace dresslife::pipeline {

/// Folder of three.min.js: that of Debian, or of the environment variable DRESSLIFE_THREE.
std::filesystem::path three_folder();

/// Text that changes when style, scripts or the installed three.js do.
std::string shell_digest();

/// title: plain text; made_from: a digest that made_from_of() finds again; body: HTML; data: JSON (json.h).
std::string whole_page(const std::string& title, const std::string& made_from, const std::string& body,
                       const std::string& data);

/// The digest of an unchanged page of whole_page(); empty: no page, another file, or a changed page. Errors: those of
/// PlainFile.
std::string made_from_of(const std::filesystem::path& page);

/// A page of whole_page() with changed text.
std::string changed_page(std::string_view page, const std::function<void(std::string&)>& change);

/// A table that scrolls where it is wider than the page. Heads that begin with # stand above numbers. rows: as HTML.
std::string wide_table(std::initializer_list<std::string_view> heads, const std::string& rows);

}  // namespace dresslife::pipeline
