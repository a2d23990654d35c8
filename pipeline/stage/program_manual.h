// The man page and the shell completions of a program, from the tables with which it reads its command line.
#pragma once

#include <string>
#include <vector>

#include "pipeline/stage/command_line.h"

namespace dresslife::pipeline {

/// What program_manual() can write: "man" (troff, section 1), "bash" and "zsh" (completions).
const std::vector<std::string>& manual_kinds();

/// kind: one of manual_kinds().
std::string program_manual(const Command& program, const std::string& kind);

}  // namespace dresslife::pipeline
