// A study over two keys as a table of lives: one key in rows, the other in columns.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pipeline/study/ranking.h"

namespace dresslife::pipeline {

/// Returns HTML; empty unless exactly two keys of the rows have two values or more. A cell contains the shortest life of its
/// jobs and their number. link: returns the address of a row's job; empty: none. Colours follow the logarithm of the lives, from
/// orange for the shortest to blue for the longest.
std::string life_matrix(const std::vector<RankingRow>& rows, const std::function<std::string(std::size_t row)>& link);

}  // namespace dresslife::pipeline
