// A complete HTML file with style, scripts, data and three.js (from the Debian package libjs-three) for the 3D view.
// Without that package the page names the package and contains everything but the 3D view.
#pragma once

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>

namespace dresslife::pipeline {

/// Returns the folder of three.min.js: that of Debian, or the environment variable DRESSLIFE_THREE.
std::filesystem::path three_folder();

/// Returns a digest that changes when style, scripts or the installed three.js change.
std::string shell_digest();

/// Returns a page. title: plain text; made_from: a digest that made_from_of() reads; body: HTML; data: JSON (json.h).
std::string whole_page(const std::string& title, const std::string& made_from, const std::string& body,
                       const std::string& data);

/// Returns the digest of an unchanged page of whole_page(); empty: no page, another file, or a changed page. Errors: those of
/// PlainFile.
std::string made_from_of(const std::filesystem::path& page);

/// Returns a page of whole_page() after `change` has changed its text.
std::string changed_page(std::string_view page, const std::function<void(std::string&)>& change);

/// Returns a table that scrolls if it is wider than the page. Heads that begin with # belong to columns of numbers. rows: HTML.
std::string wide_table(std::initializer_list<std::string_view> heads, const std::string& rows);

}  // namespace dresslife::pipeline
