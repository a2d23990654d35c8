#include "pipeline/report/table_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "pipeline/base/installation.h"
#include "pipeline/report/chart_style.h"
#include "pipeline/report/page_assets.h"
#include "pipeline/report/plot.h"
#include "pipeline/settings/units.h"

namespace dresslife::pipeline {
namespace {

/// Rows that a browser lays out at first; the reader can request the others.
constexpr std::size_t rows_at_once = 100;

constexpr const char* table_style = R"(
body { margin: 0 auto; max-width: 96rem; padding: 1.5rem 1rem 4rem; background: var(--page); color: var(--ink);
  font: 16px/1.5 system-ui, "Segoe UI", "DejaVu Sans", Arial, sans-serif; }
h1 { font-size: 1.7rem; margin: 0 0 .3rem; } h2 { font-size: 1.3rem; margin: 3rem 0 .3rem; padding-top: .8rem;
  border-top: 2px solid var(--rule); }
h3 { font-size: 1rem; margin: 1.6rem 0 .2rem; } p { margin: .3rem 0 .6rem; max-width: 46rem; } .chart { max-width: 68rem; }
.soft { color: var(--soft); font-size: .9rem; }
a { color: var(--blue); } .wide { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-size: .9rem; font-variant-numeric: tabular-nums; }
th, td { text-align: left; padding: .3rem .6rem .3rem 0; border-bottom: 1px solid var(--rule); vertical-align: top; }
th { color: var(--soft); font-weight: 600; vertical-align: bottom; } .number { text-align: right;
  white-space: nowrap; } th.number, .certainty { white-space: normal; }
.certainty { display: block; max-width: 9rem; margin-left: auto; } #ranking td:nth-child(n + 7) { min-width: 8rem; }
#ranking td:nth-child(2) { min-width: 9rem; overflow-wrap: anywhere; } #ranking td:is(:nth-child(4), :nth-child(5), :nth-child(6)) { white-space: normal; } .failed { color: var(--hot); font-weight: 600; }
dl { display: grid; grid-template-columns: max-content minmax(0, 1fr); gap: .1rem 1rem; margin: .5rem 0; }
dt { color: var(--soft); } dd { margin: 0; overflow-wrap: anywhere; }
@media (max-width: 40rem) { dl { grid-template-columns: minmax(0, 1fr); } dd { margin-bottom: .5rem; } }
[id^=job-] { content-visibility: auto; contain-intrinsic-size: auto 60rem; }
details { margin: .8rem 0; } summary { cursor: pointer; color: var(--soft); }
pre { background: var(--band); padding: .8rem; overflow-x: auto; font-size: .8rem; line-height: 1.35; }
.tools { display: flex; flex-wrap: wrap; gap: .4rem 1rem; align-items: center; margin: .8rem 0; font-size: .9rem; }
.tools input[type=search] { font: inherit; padding: .2rem .5rem; min-width: 14rem; color: inherit;
  background: var(--page); border: 1px solid var(--rule); border-radius: .3rem; }
.sort { font: inherit; color: inherit; text-align: inherit; background: none; border: 0; padding: 0;
  cursor: pointer; }
.sort::after { content: ""; } [aria-sort=ascending] .sort::after { content: " \25B2"; }
[aria-sort=descending] .sort::after { content: " \25BC"; }
.pick { margin-right: .3rem; } caption { text-align: left; color: var(--soft); padding: .6rem 0 .2rem; }
tbody th { font-weight: 400; vertical-align: top; }
#compared td { overflow-wrap: anywhere; } #ranking details { margin: 0; } #ranking summary { color: var(--hot); }
#matrix { width: auto; } #matrix td, #matrix th { padding: .25rem .6rem; } #matrix td { text-align: right;
  border: 1px solid var(--page); } #matrix thead th { overflow-wrap: anywhere; }
#matrix .coloured, #matrix .coloured a { color: #111; } #ranking ul { margin: .2rem 0; padding-left: 1rem; }
@media print { [id^=job-] { content-visibility: visible; } .tools, .pick, .sort::after { display: none; }
  details, template { display: none; } td details { display: block; } summary { list-style: none; } h2 { break-before: page; break-after: avoid; }
  tr, dd { break-inside: avoid; } #ranking { font-size: 9px; } #ranking td { white-space: normal; }
  #ranking td:nth-child(n + 7) { min-width: 0; } h3, h3 + p { break-after: avoid; }
  body { max-width: none; padding: 0; font-size: 12px; } .soft { font-size: 11px; } thead { display: table-header-group; }
  .wide { overflow: visible; } #matrix .coloured { print-color-adjust: exact; -webkit-print-color-adjust: exact; }  }
)";

}  // namespace

std::string table_page(const std::string& title, const std::string& head, const std::string& body) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{}</title>\n"
      "<style>{}</style>\n</head>\n<body>\n<h1>{}</h1>\n{}"
      "<p class=\"soft\">dresslife {}</p>\n<script>\n\"use strict\";\n(() => {{\n{}}})();\n</script>\n"
      "</body>\n</html>\n",
      escaped(title), chart_style() + table_style, escaped(head), body, version(), study_script());
}

std::string sorted_table(const std::string& heads, const std::vector<std::string>& rows, const std::string& things,
                         const std::string& file) {
  const auto middle = rows.begin() + static_cast<std::ptrdiff_t>(std::min(rows.size(), rows_at_once));
  std::string text = fmt::format(
      "<div class=\"wide\"><table id=\"ranking\" data-things=\"{}\">\n<thead><tr>{}</tr></thead>\n<tbody>\n{}</tbody></table></div>\n",
      things, heads, fmt::join(rows.begin(), middle, ""));
  if (middle != rows.end())
    text += fmt::format(
        "<noscript><p>The first {} of {} {}; {} holds all.</p></noscript>\n<template id=\"more-jobs\">\n{}</template>\n",
        rows_at_once, rows.size(), things, file, fmt::join(middle, rows.end(), ""));
  return text;
}

std::string sorted_by(double value) {
  return fmt::format(" data-value=\"{}\"", std::isnan(value)   ? ""
                                           : std::isinf(value) ? "Infinity"
                                                               : shortest_text(value));
}

std::string number_cell(double value, const std::string& words) {
  return fmt::format("<td class=\"number\"{}>{}</td>", sorted_by(value), words);
}

}  // namespace dresslife::pipeline
