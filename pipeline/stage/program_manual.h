// The man page and the shell completion of a program, from the very options with which it reads its command
// line.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace dresslife::pipeline {

/// Between a program's purpose and the command that shows how it is called, in its description.
inline constexpr const char* example_mark = "\n\nExample: ";

/// What program_manual() can write: "man" (troff, section 1), "bash" and "zsh" (completions).
const std::vector<std::string>& manual_kinds();

/// kind: one of manual_kinds().
std::string program_manual(const CLI::App& program, const std::string& kind);

}  // namespace dresslife::pipeline
