// Pages of tables in one style: a study, the duties of a dresspack, the plan of a plant. Complete pages without requests. A
// script sorts and filters the table with the id "ranking" (study.js). They follow the reader's light or dark scheme.
#pragma once

#include <string>
#include <vector>

namespace dresslife::pipeline {

/// Returns a page. title, head: plain text; body: HTML.
std::string table_page(const std::string& title, const std::string& head, const std::string& body);

/// Returns the table with the id "ranking". heads: its "<th>"s; rows: whole "<tr>"s with data-rank, their rank from 1; things:
/// name of the rows' subject ("jobs"); file: table file with all rows. Rows after the first 100 are laid out on request.
std::string sorted_table(const std::string& heads, const std::vector<std::string>& rows, const std::string& things,
                         const std::string& file);

/// Returns the attribute of a cell by which it is sorted; empty for NaN.
std::string sorted_by(double value);
std::string number_cell(double value, const std::string& words);

}  // namespace dresslife::pipeline
