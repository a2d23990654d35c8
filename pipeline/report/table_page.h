// Pages of tables in one style: a study, the duties of a dresspack, the plan of a plant. Complete pages without requests. A
// script sorts and filters the table with the id "ranking" (study.js). They follow the reader's light or dark scheme.
#pragma once

#include <string>
#include <vector>

namespace dresslife::pipeline {

/// title, head: plain text; body: HTML.
std::string table_page(const std::string& title, const std::string& head, const std::string& body);

/// The table with the id "ranking". heads: its "<th>"s; rows: whole "<tr>"s with data-rank, their place from 1; things: what
/// a row is about ("jobs"); file: in which all rows are. Beyond the first 100, rows are laid out when the reader asks.
std::string sorted_table(const std::string& heads, const std::vector<std::string>& rows, const std::string& things,
                         const std::string& file);

/// The attribute of a cell that it is sorted by; not a number: nothing.
std::string sorted_by(double value);
std::string number_cell(double value, const std::string& words);

}  // namespace dresslife::pipeline
