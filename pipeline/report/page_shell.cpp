#include "pipeline/report/page_shell.h"

#include <fmt/format.h>

#include <cstdlib>
#include <string_view>

#include "pipeline/base/digest.h"
#include "pipeline/base/installation.h"
#include "pipeline/base/ownership.h"
#include "pipeline/base/plain_file.h"
#include "pipeline/report/chart_style.h"
#include "pipeline/report/glossary.h"
#include "pipeline/report/page_assets.h"
#include "pipeline/report/plot.h"

namespace dresslife::pipeline {
namespace {

constexpr std::string_view doctype = "<!DOCTYPE html>\n",
                           before_digest = "<html lang=\"en\">\n<!-- dresslife page made from ";
constexpr std::size_t digest_digits = 32;

/// Returns the text of a file; empty if it is not installed.
std::string text_of(const std::filesystem::path& file) {
  return kind_of(file) == FileKind::file ? read_text(file) : "";
}

/// Returns both scripts; empty if one is missing.
std::string three_scripts() {
  const std::string three = text_of(three_folder() / "three.min.js"),
                    controls = text_of(three_folder() / "examples/js/controls/OrbitControls.js");
  for (const std::string* text : {&three, &controls})
    if (text->empty() || text->find("</script") != std::string::npos) return "";
  return fmt::format("<script>{}</script>\n<script>{}</script>\n", three, controls);
}

}  // namespace

std::filesystem::path three_folder() {
  const char* const named = std::getenv("DRESSLIFE_THREE");
  return named && *named ? named : "/usr/share/javascript/three";
}

std::string shell_digest() {
  return xxh3(fmt::format("{}{}{}{}{}{}", chart_style(), page_style(), page_scripts(), three_scripts(), glossary_html(),
                          version()));
}

std::string whole_page(const std::string& title, const std::string& made_from, const std::string& body,
                       const std::string& data) {
  const std::string page = fmt::format(
      "{}{}{} -->\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width, "
      "initial-scale=1\">\n<title>{}</title>\n<style>{}</style>\n</head>\n<body>\n{}"
      "{}<p class=\"soft\">dresslife {} \u00b7 <a href=\"#words\">what the words mean</a></p>\n<script type=\"application/json\" id=\"data\">{}</script>\n"
      "{}<script>{}</script>\n</body>\n</html>\n",
      doctype, before_digest, made_from, escaped(title), chart_style() + std::string(page_style()), body,
      glossary_html(), version(), data, three_scripts(), page_scripts());
  return with_mark(page, Mark::page);
}

std::string wide_table(std::initializer_list<std::string_view> heads, const std::string& rows) {
  std::string head;
  for (const std::string_view one : heads)
    head += one.starts_with('#') ? fmt::format("<th class=\"number\">{}</th>", one.substr(1))
                                 : fmt::format("<th>{}</th>", one);
  return fmt::format("<div class=\"wide\"><table>\n<thead><tr>{}</tr></thead>\n<tbody>\n{}</tbody></table></div>\n",
                     head, rows);
}

std::string made_from_of(const std::filesystem::path& page) {
  if (!state_of(page).exists()) return "";
  const std::string text = read_text(page);
  const std::string_view rest = without_mark(text);
  if (!is_as_marked(text) || !rest.starts_with(before_digest)) return "";
  return std::string(rest.substr(before_digest.size(), digest_digits));
}

std::string changed_page(std::string_view page, const std::function<void(std::string&)>& change) {
  std::string text = std::string(doctype) + std::string(without_mark(page));
  change(text);
  return with_mark(text, Mark::page);
}

}  // namespace dresslife::pipeline
