// Man page and shell completions of a program, from the tables of its command line.
#pragma once

#include <string>
#include <vector>

#include "pipeline/stage/command_line.h"

namespace dresslife::pipeline {

/// Returns the kinds that program_manual() can write: "man" (troff, section 1), "bash" and "zsh" (completions).
const std::vector<std::string>& manual_kinds();

/// Returns the text. kind: one of manual_kinds().
std::string program_manual(const Command& program, const std::string& kind);

}  // namespace dresslife::pipeline
