// A study over two keys as a table of lives: one key down, the other across.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pipeline/study/ranking.h"

namespace dresslife::pipeline {

/// HTML; empty unless exactly two keys of the rows take two values or more. Of jobs that share both values
/// the shortest life is told, and how many they are. link: address of what a row's job is told by; empty:
/// nothing. Cells are coloured by the logarithm of their lives, orange for the shortest to blue for the
/// longest.
std::string life_matrix(const std::vector<RankingRow>& rows,
                        const std::function<std::string(std::size_t row)>& link);

}  // namespace dresslife::pipeline
