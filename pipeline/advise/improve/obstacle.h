// Why no trial keeps all limits: which limit stands against them, how near the best came, and which keys
// stand there at the ends of what they may be.
#pragma once

#include <string>
#include <vector>

#include "pipeline/advise/improve/freedom.h"
#include "pipeline/advise/improve/improvement.h"

namespace dresslife::pipeline {

/// A line each: the nearest trial, what it passes and how it lives beside the jobs as they are (the first
/// trial); each limit that no trial that ran keeps; ends of freed ranges that the nearest stands at. trials:
/// none of them feasible.
std::vector<std::string> obstacle_words(const std::vector<Trial>& trials, const Freedom& freedom);

}  // namespace dresslife::pipeline
